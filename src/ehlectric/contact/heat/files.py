"""Heat and shear of a film in the file of a result: variables, their rules, and numbers."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from ehlectric.film.thermal.result import HeatedFilm
from ehlectric.runtime.checks.schema import Rule, is_number, is_number_or_null, is_table, json_of

if TYPE_CHECKING:
    import xarray as xr

# Attribute of the file that holds the numbers.
_NUMBERS = "heated"

# Variables: whether they have a value at every position across the film, name of the quantity, and unit.
_NODAL: Mapping[str, tuple[bool, str, str]] = {
    "temperature": (True, "temperature in the film, from surface 1 to surface 2", "K"),
    "mid_temperature": (False, "temperature at mid-film", "K"),
    "shear_stress": (False, "shear stress at mid-film along entrainment", "Pa"),
}
_ZETA = "fraction of the film, from surface 1 to surface 2"


def _null_or(values: str) -> Callable[[Any], bool]:
    """Check of a value that is null or a number of some kind."""
    return lambda value: value is None or is_number(value, values=values)


# What the numbers are; those not named here may be null.
_KINDS: Mapping[str, Callable[[Any], bool]] = {
    "rheology": lambda value: isinstance(value, str),
    "traction_coefficient": is_number_or_null,
    "rolling_coefficient": is_number_or_null,
    "power_loss": _null_or("not negative"),
    "isothermal_minimum_thickness": _null_or("positive"),
    "isothermal_central_thickness": _null_or("positive"),
    "outer_iterations": partial(is_number, values="whole"),
}
_OPTIONAL = ("max_temperature_rise", "temperature_rise_error", "energy_imbalance")


def heated_variables(heated: HeatedFilm | None, grid: tuple[str, ...]) -> dict[str, Any]:
    """Arrays of heat and shear in the form that xarray expects; none of an isothermal Newtonian film.

    Parameters
    ----------
    heated : HeatedFilm or None
        Heat and shear of the film.
    grid : tuple of str
        Dimensions of values at the film's nodes.

    Returns
    -------
    dict
        Variables by name: dimensions, values, long name and unit.
    """
    if heated is None:
        return {}
    found: dict[str, Any] = {}
    for name, (across, long_name, unit) in _NODAL.items():
        values = getattr(heated, name)
        if values is not None:
            dims = ("zeta", *grid) if across else grid
            found[name] = (dims, values, {"long_name": long_name, "units": unit})
    if heated.zeta is not None:
        found["zeta"] = ("zeta", heated.zeta, {"long_name": _ZETA, "units": "1"})
    return found


def heated_rules(grid: tuple[str, ...]) -> dict[str, Rule]:
    """Rules for the variables of heat and shear, none of which a file must have."""
    found = {
        name: Rule(
            ("zeta", *grid) if across else grid, "positive" if unit == "K" else "finite", unit, needed=False
        )
        for name, (across, _, unit) in _NODAL.items()
    }
    return found | {"zeta": Rule(("zeta",), "increasing", "1", needed=False)}


def heated_attributes(heated: HeatedFilm | None) -> dict[str, str]:
    """Attribute with the numbers of heat and shear as JSON; none of an isothermal Newtonian film."""
    if heated is None:
        return {}
    return {_NUMBERS: json.dumps({name: getattr(heated, name) for name in (*_KINDS, *_OPTIONAL)})}


def check_heated(dataset: xr.Dataset) -> None:
    """Check the numbers of heat and shear in a file.

    Raises
    ------
    UnfitError
        Where they are not as they were written, or the file has only a part of the variables.
    """
    if _NUMBERS in dataset.attrs:
        others = dict.fromkeys(_OPTIONAL, is_number_or_null)
        json_of(dataset.attrs, _NUMBERS, partial(is_table, columns=_KINDS, others=others))


def heated_of(dataset: xr.Dataset) -> HeatedFilm | None:
    """Heat and shear of the film in a file; None if it has none."""
    if _NUMBERS not in dataset.attrs:
        return None
    arrays: dict[str, Any] = {n: dataset[n].values for n in (*_NODAL, "zeta") if n in dataset}
    return HeatedFilm(**json.loads(dataset.attrs[_NUMBERS]), **arrays)
