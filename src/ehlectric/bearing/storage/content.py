"""Content of bearing.nc: rules for its variables and attributes, which hold before any of them is used."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.bearing.conditions import ContactFriction
from ehlectric.bearing.contacts import ContactValues
from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.loads.kinematics import Speeds
from ehlectric.bearing.loads.rollers import RollerEquilibrium
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.runtime.checks.schema import (
    VALUES,
    Rule,
    UnfitError,
    check_variables,
    is_list,
    is_table,
    is_text,
    json_of,
    number_of,
    text_of,
)
from ehlectric.runtime.stored_warnings import CODES_OF_TEXTS, TEXTS

if TYPE_CHECKING:
    import xarray as xr

RINGS = ("inner", "outer")

# Attribute with the solved factors of the heat of both rings, where a case has them solved.
HEAT = "heat_factor"

# Prefix of the attributes with the friction of the contacts whose heat is solved, a number for each ring.
# Files of earlier versions do not have them.
FRICTION = "solved_"

EQUILIBRIA: Mapping[str, type[Equilibrium]] = {
    kind.__name__: kind for kind in (BallEquilibrium, RollerEquilibrium)
}
UNITS = {
    "load": "N", "gap": "m", "max_pressure": "Pa", "semi_axis_x": "m", "semi_axis_y": "m",
    "minimum_thickness": "m", "central_thickness": "m", "inside": "F", "outside_oil": "F", "outside_air": "F",
    "plate": "F", "strength_per_volt": "1/m", "breakdown_voltage": "V", "hertz": "F",
}  # fmt: skip

# What values of variables are; any others are finite.
_OF_ELEMENTS = {
    "load": "not negative",
    "gap": "not negative",
    "solved": "0 or 1",
    "max_pressure": "not negative",
    "semi_axis_x": "not negative",
    "semi_axis_y": "not negative",
    "minimum_thickness": "not negative",
    "central_thickness": "not negative",
    "inside": "not negative",
    "outside_oil": "not negative",
    "outside_air": "not negative",
    "plate": "not negative",
    "strength_per_volt": "not negative",
    "breakdown_voltage": "positive or infinite",
    "hertz": "not negative or NaN",
}
# Quantities of loaded contacts; only the breakdown voltage is infinite.
_LOADED = "positive or infinite"
_OF_CURVES = {
    "load": "increasing",
    "error": "not negative or NaN",
    "moes_m": "not negative",
    "moes_l": "not negative",
    "mismatch": "finite or NaN",
    "converged": "0 or 1",
    "hertz": "not negative or NaN",
}

# Quantities that files of earlier versions do not have. They are NaN there.
LATER = {"hertz"}

# Dimensions of quantities of an equilibrium, beside the positions of the cage.
_OF_EQUILIBRIA = ((), ("element",), ("slice",), ("element", "slice"))


def check(dataset: xr.Dataset) -> None:
    """Check the content of a bearing.nc before any of it is used.

    Raises
    ------
    UnfitError
        Where a variable or an attribute is missing, or is not as it was written.
    """
    attributes = dataset.attrs
    over = ("cage_position", "ring", "element")
    quantities = [field.name for field in dataclasses.fields(ContactValues)]
    rules = {
        name: Rule(over, _OF_ELEMENTS.get(name, "finite"), UNITS.get(name), needed=name not in LATER)
        for name in ("load", "gap", "solved", *quantities)
    }
    for ring in RINGS:
        rules |= {
            f"{ring}_curve_{name}": Rule(
                (f"{ring}_load",), _OF_CURVES.get(name, _LOADED), UNITS.get(name), needed=name not in LATER
            )
            for name in (*quantities, *_OF_CURVES)
        }
    check_variables(dataset, rules | _equilibrium_rules(dataset))
    if dataset.sizes["ring"] != len(RINGS):
        raise UnfitError(f"it has {dataset.sizes['ring']} rings")
    solved = dataset["solved"].values.astype(bool)
    if not solved.any(axis=dataset["solved"].get_axis_num("element")).all():
        raise UnfitError("no contact of a ring is loaded")
    for name in ("load", *(quantity for quantity in quantities if quantity not in LATER)):
        if not VALUES[_LOADED](dataset[name].values[solved]):
            raise UnfitError(f"{name} of a loaded contact is not {_LOADED}")
    number_of(attributes, "seconds")
    text_of(attributes, "version")
    for name in ("contact_angle", "entrainment_speed"):
        _check_pair(attributes, name)
    _check_heat(attributes)
    _check_shape(text_of(attributes, "weibull_shape"))
    lengths = [dataset.sizes[f"{ring}_load"] for ring in RINGS]
    json_of(attributes, "warnings", partial(_are_warnings, lengths=lengths))


def _equilibrium_rules(dataset: xr.Dataset) -> dict[str, Rule]:
    """Rules for the variables of the equilibria, whose number of dimensions follows from the file."""
    name = text_of(dataset.attrs, "equilibrium")
    if name not in EQUILIBRIA:
        raise UnfitError("equilibrium is no kind of equilibrium")
    fields = [field.name for field in dataclasses.fields(EQUILIBRIA[name])]
    speeds = [f"speeds_{field.name}" for field in dataclasses.fields(Speeds)]
    rules = {}
    for each in (*[field for field in fields if field != "speeds"], *speeds):
        variable = f"equilibrium_{each}"
        dims = tuple(map(str, dataset[variable].dims)) if variable in dataset else ()
        known = dims[:1] == ("cage_position",) and dims[1:] in _OF_EQUILIBRIA
        rules[variable] = Rule(dims if known else ("cage_position",))
    return rules


def _check_heat(attributes: Mapping[Any, Any]) -> None:
    """Check the attributes of contacts whose heat is solved, where a file has them."""
    load = FRICTION + "load"
    if HEAT in attributes:
        _check_pair(attributes, HEAT)
    if load in attributes:
        for field in dataclasses.fields(ContactFriction):
            _check_pair(attributes, FRICTION + field.name, unknown=field.name == "temperature_rise_error")
    for name in (HEAT, load):
        if name in attributes and not VALUES["positive"](np.asarray(attributes[name])):
            raise UnfitError(f"{name} is not positive")


def _check_pair(attributes: Mapping[Any, Any], name: str, *, unknown: bool = False) -> None:
    """Check an attribute with a number for each ring, which may be NaN where it can be ``unknown``."""
    if name not in attributes:
        raise UnfitError(f"{name} is missing")
    values = np.asarray(attributes[name])
    allowed = VALUES["finite or NaN" if unknown else "finite"]
    if values.dtype.kind not in "fiu" or values.shape != (len(RINGS),) or not allowed(values):
        raise UnfitError(f"{name} is not a number for each ring")


def _check_shape(text: str) -> None:
    """Check the shape parameter of a Weibull distribution; the text is empty where there is none."""
    try:
        shape = float(text) if text else 1.0
    except ValueError:
        shape = 0.0
    if not 0.0 < shape < np.inf:
        raise UnfitError("weibull_shape is not positive")


def _are_warnings(value: Any, lengths: list[int]) -> bool:
    """Whether a value of JSON holds the warnings of each contact of each curve."""
    texts = partial(is_list, right=is_text)
    each = partial(is_table, columns={TEXTS: texts}, others={CODES_OF_TEXTS: texts})
    return is_list(value, partial(is_list, right=each)) and [len(curve) for curve in value] == lengths
