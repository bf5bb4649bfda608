"""Checks of what the heat in the films of a bearing needs: ``film_factor`` "inlet-shear" or "solved"."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.bearings.bearing import Bearing
from ehlectric.cases.films.physics import check_thermal_oil
from ehlectric.cases.oils.lubricant import Lubricant
from ehlectric.cases.oils.properties import Properties
from ehlectric.cases.oils.resolution import viscosity_over_temperature
from ehlectric.errors import InputError


def check_heat(bearing: Bearing, oil: Lubricant) -> None:
    """Check that a bearing file has all that its film factor needs.

    Parameters
    ----------
    bearing : Bearing
        Table of the bearing.
    oil : Lubricant
        Table of its oil.

    Raises
    ------
    InputError
        Where a property of the oil or of a material is missing.
    """
    if bearing.film_factor == "inlet-shear":
        _check_inlet(oil)
    elif bearing.film_factor == "solved":
        _check_solved(bearing, oil)


def missing_conductivity(tables: Any) -> InputError | None:
    """Error of a thermal conductivity that is missing in a bearing file whose oil lacks other values, too.

    Parameters
    ----------
    tables : mapping
        Tables of the file.

    Returns
    -------
    InputError or None
        Error with its key in the table of the oil; None if nothing is missing for the film factor.
    """
    if not isinstance(tables, Mapping):
        return None
    bearing, oil = tables.get("bearing"), tables.get("lubricant")
    if not (isinstance(bearing, Mapping) and isinstance(oil, Mapping)):
        return None
    if bearing.get("film_factor") != "inlet-shear":
        return None
    try:
        _check_conductivity(Properties.from_dict(oil))
    except InputError as error:
        key = str(error.key).removeprefix("lubricant.")
        return error.retold(key, error.text) if "thermal_conductivity" in key else None
    return None


def _check_inlet(oil: Lubricant) -> None:
    """Check that the heating by shear in the inlet is known: viscosity over temperature, conductivity."""
    if viscosity_over_temperature(oil) is None:
        needs = "film_factor 'inlet-shear' needs a viscosity that follows the temperature"
        raise InputError.worded(
            "lubricant.viscosity", f"is one for all temperatures; {needs}", takes="a data sheet or a law"
        )
    _check_conductivity(oil)


def _check_conductivity(oil: Properties) -> None:
    """Check that an oil has a thermal conductivity, of its data sheet or by a law."""
    sheet = oil.temperature
    if oil.law("thermal_conductivity_law") is None and (sheet is None or sheet.thermal_conductivity is None):
        key = "thermal_conductivity" if sheet is None else "temperature.thermal_conductivity"
        raise InputError.worded(f"lubricant.{key}", "missing; film_factor 'inlet-shear' needs it")


def _check_solved(bearing: Bearing, oil: Lubricant) -> None:
    """Check that the thermal properties of elements, rings and oil are known."""
    what, known = "film_factor 'solved'", library.solid_names(rolling=True, thermal=True)
    for key in ("element_material", "ring_material"):
        name = getattr(bearing, key)
        if name not in known:
            raise InputError.worded(
                f"bearing.{key}",
                f"{name!r} has no thermal properties in the library, and {what} needs them; use "
                f"{' or '.join(map(repr, known))} or another film_factor",
                takes=" or ".join(map(repr, known)),
            )
    for inner in (True, False):
        check_thermal_oil(oil, bearing.ring_temperature(inner=inner), what)
