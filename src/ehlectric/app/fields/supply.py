"""Fields of the supply of oil to the contacts of a bearing."""

from __future__ import annotations

from ehlectric.app.fields.field import Field, Way
from ehlectric.app.inputs import Inputs

# Ways of supply in words, by the value of ``bearing.supply``.
_WAYS = {
    "flooded": "Fully flooded",
    "oil-bath": "Low oil bath",
    "oil-jet": "Oil jet",
    "grease": "Grease",
    "oil-air": "Oil and air",
}


def _share(inputs: Inputs) -> bool:
    return inputs.value("bearing.supply") not in (None, *_WAYS)


SUPPLY = (
    Field(
        "bearing.supply_way",
        "Supply of oil",
        kind="ways",
        ways=(
            *(Way(words, {"bearing.supply": way}, "bearing.supply", way) for way, words in _WAYS.items()),
            Way("A share of the flooded film", {"bearing.supply": 0.6}, "bearing.supply"),
            Way("Fully flooded", listed=False),
        ),
    ),
    Field("bearing.supply", "Film over the flooded one", low=0.05, high=1.0, when=_share, strict=True),
)
