"""Supply of oil of a solved film as an attribute of a result file, and back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from functools import partial
from typing import Any

from ehlectric.film.accuracy.starved import Starvation
from ehlectric.runtime.checks.schema import is_number_or_null, is_table, json_of


def starvation_attribute(starvation: Starvation | None) -> dict[str, str]:
    """Attribute of a result file with the supply of oil; empty without a supply."""
    return {} if starvation is None else {"starvation": json.dumps(vars(starvation))}


def check_starvation(attributes: Mapping[Any, Any]) -> None:
    """Check the supply of oil in the attributes of a result file, if it has one; raises an UnfitError."""
    if "starvation" in attributes:
        others = {each.name: is_number_or_null for each in fields(Starvation)}
        json_of(attributes, "starvation", partial(is_table, columns={}, others=others))


def starvation_of(attributes: Mapping[Any, Any]) -> Starvation | None:
    """Supply of oil from the attributes of a result file; None if it has none."""
    return Starvation(**json.loads(attributes["starvation"])) if "starvation" in attributes else None
