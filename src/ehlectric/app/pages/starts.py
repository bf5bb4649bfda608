"""Inputs with which the pages begin: the examples, so that the first answer is that of a documented case."""

from __future__ import annotations

import tomllib
from functools import cache

from ehlectric.app.inputs import Inputs
from ehlectric.runs.example_files import example_text


@cache
def start(name: str) -> Inputs:
    """Inputs of an example."""
    return Inputs(tomllib.loads(example_text(name)))


BEARING = start("bearing_6208")


def contact_start(geometry: str) -> Inputs:
    """Inputs of the example of a line contact or of a point contact."""
    return start("ball_contact" if geometry == "point" else "line_contact")


SWEEP = Inputs(
    {
        "case": dict(BEARING.changed({"contacts": "formula"}).table),
        "vary": {
            "bearing": {
                "inner_speed": {"from": "300 rpm", "to": "6000 rpm", "count": 8, "spacing": "log"},
                "radial_load": {"from": "500 N", "to": "8000 N", "count": 8},
            }
        },
    }
)
