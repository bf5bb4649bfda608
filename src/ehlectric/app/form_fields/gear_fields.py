"""Fields for a gear pair, in the order of a drawing, and the lists with values of both gears."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.app.form_fields.field import equal, given, group_of, unequal
from ehlectric.app.form_fields.oil_fields import oil
from ehlectric.app.page_inputs import Inputs
from ehlectric.quantities.inputs import form, key_of_list

_BULK = "gear.operation.bulk_temperature"
_sheet = given("lubricant.temperature")

# When fields are shown.
_SHOWN: dict[str, dict[str, Any]] = {
    **{f"gear.flank_ra.{n}": {"when": given("gear.flank_ra")} for n in (1, 2)},
    "gear.rq_over_ra": {"when": given("gear.flank_ra")},
    _BULK: {"when": unequal(_BULK, None, "iso"), "strict": True},
    "gear.contact.reference_area": {"when": equal("gear.contact.conduction", None, "by-film")},
}

GEAR_GROUPS = tuple(
    oil("gear", **{"temperature.thermal_conductivity": {"when": _sheet}})
    if title == "Oil"
    else group_of("gear", title, _SHOWN)
    for title in form("gear")
)


def with_lists(inputs: Inputs, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Changes in which a value of one gear is a change of its list; a single value holds for both gears.

    Examples
    --------
    >>> with_lists(Inputs({"gear": {"profile_shift": [0.3]}}), {"gear.profile_shift.2": 0.1})
    {'gear.profile_shift': [0.3, 0.1]}
    >>> with_lists(Inputs({"gear": {"tip_relief": "8 um"}}), {"gear.tip_relief.1": None})
    {'gear.tip_relief': None}
    """
    result: dict[str, Any] = {}
    for key, value in changes.items():
        name = key_of_list(key)
        if name == key:
            result[key] = value
            continue
        before = result.get(name, inputs.value(name))
        listed = before if isinstance(before, list) else [] if before is None else [before]
        pair = [*listed, "", ""][:2]
        pair[int(key[-1]) - 1] = "" if value is None else value
        while pair and pair[-1] == "":
            pair.pop()
        result[name] = pair or None
    return result
