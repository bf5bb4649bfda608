"""Fields of an oil: one of the library, or that of a data sheet."""

from __future__ import annotations

from ehlectric.app.catalogue import oil_needs
from ehlectric.app.fields.field import Field, Group, Way
from ehlectric.app.inputs import Inputs

_SHEET = "lubricant.temperature"

# Grades of ISO 3448 that oils for bearings have.
_GRADES = ("10", "15", "22", "32", "46", "68", "100", "150", "220", "320", "460", "680", "1000")


def _sheet(inputs: Inputs) -> bool:
    return inputs.value(_SHEET) is not None


def _needs_permittivity(inputs: Inputs) -> bool:
    return "relative_permittivity" in oil_needs(str(inputs.value("lubricant.base")))


def _needs_exponent(inputs: Inputs) -> bool:
    return "roelands_z" in oil_needs(str(inputs.value("lubricant.base")))


def _heated(inputs: Inputs) -> bool:
    return _sheet(inputs) and inputs.value("bearing.film_factor") == "inlet-shear"


def _no(_: Inputs) -> bool:
    return False


OIL = Group(
    "Oil",
    (
        Field("lubricant.base", "Oil", kind="choice", own="From a data sheet"),
        Field(
            f"{_SHEET}.way_40",
            "At 40 °C given as",
            kind="ways",
            ways=(
                Way("ISO viscosity grade", {f"{_SHEET}.iso_vg": 46}, f"{_SHEET}.iso_vg"),
                Way("Kinematic viscosity", {f"{_SHEET}.kinematic_viscosity_40": "46 mm^2/s"}),
            ),
            when=_sheet,
        ),
        Field(f"{_SHEET}.iso_vg", "ISO viscosity grade", kind="choice", choices=_GRADES, when=_no),
        Field(
            f"{_SHEET}.kinematic_viscosity_40",
            "Viscosity at 40 °C",
            "mm^2/s",
            5.0,
            500.0,
            log=True,
            when=_no,
        ),
        Field(
            f"{_SHEET}.way_100",
            "At 100 °C given as",
            kind="ways",
            ways=(
                Way("Viscosity index", {f"{_SHEET}.viscosity_index": 100.0}, f"{_SHEET}.viscosity_index"),
                Way("Kinematic viscosity", {f"{_SHEET}.kinematic_viscosity_100": "6.8 mm^2/s"}),
            ),
            when=_sheet,
        ),
        Field(f"{_SHEET}.viscosity_index", "Viscosity index", "", 60.0, 200.0, when=_no),
        Field(
            f"{_SHEET}.kinematic_viscosity_100",
            "Viscosity at 100 °C",
            "mm^2/s",
            1.5,
            60.0,
            log=True,
            when=_no,
        ),
        Field(f"{_SHEET}.density_15", "Density at 15 °C", "kg/m^3", 750.0, 1100.0, when=_sheet),
        Field(
            f"{_SHEET}.base_oil",
            "Type of base oil",
            kind="choice",
            choices=("mineral-paraffinic", "mineral-naphthenic", "pao", "ester", "polyglycol"),
            when=_sheet,
            optional=True,
        ),
        Field(
            f"{_SHEET}.thermal_conductivity",
            "Thermal conductivity",
            "W/m/K",
            0.08,
            0.3,
            when=_heated,
            optional=True,
        ),
        Field(
            "lubricant.relative_permittivity", "Relative permittivity", "", 1.8, 6.0, when=_needs_permittivity
        ),
        Field("lubricant.roelands_z", "Roelands' exponent z", "", 0.3, 1.0, when=_needs_exponent),
    ),
)
