"""Fields of the heat and the shear in the film of a contact."""

from __future__ import annotations

from ehlectric.app.catalogue import oil
from ehlectric.app.fields.field import Field, Group, Way, When
from ehlectric.app.inputs import Inputs

_RHEOLOGIES = ("newtonian", "eyring", "carreau", "limiting")

# Material of both bodies when the heat is switched on, as in the examples; an assumption.
_STEEL = {f"contact.body_{number}.material": "steel" for number in (1, 2)}


def _hot(inputs: Inputs) -> bool:
    return inputs.value("film.thermal") is True


def _follows(inputs: Inputs) -> bool:
    """Whether the viscosity of the oil follows its temperature, without which no heat can be computed."""
    if any(inputs.value(f"lubricant.{key}") is not None for key in ("temperature", "atmospheric_law")):
        return True
    known = oil(str(inputs.value("lubricant.base")))
    return bool(known) and "viscosity" not in known and inputs.value("lubricant.viscosity") is None


def _sheared(name: str) -> When:
    """Whether the oil is sheared after a law."""
    return lambda inputs: inputs.value("film.rheology") == name


def _of_body(number: int) -> tuple[Field, ...]:
    """Fields of the heat of one body."""
    body = f"contact.body_{number}"
    return (
        Field(f"contact.temperature_{number}", f"Temperature of body {number}", "degC", 0.0, 150.0,
              note="far below its surface; none: that of the oil", when=_hot, optional=True),
        Field(f"{body}.material", f"Material of body {number}", kind="choice", when=_hot, optional=True,
              own="Own values"),
        Field(f"{body}.thermal_conductivity", f"Thermal conductivity of body {number}", "W/m/K", 1.0, 100.0,
              log=True, note="none: that of the material", when=_hot, optional=True),
        Field(f"{body}.heat_capacity", f"Heat capacity of body {number}", "J/kg/K", 300.0, 1000.0,
              note="none: that of the material", when=_hot, optional=True),
        Field(f"{body}.density", f"Density of body {number}", "kg/m^3", 2000.0, 9000.0,
              note="none: that of the material", when=_hot, optional=True),
    )  # fmt: skip


HEAT = Group(
    "Heat and shear",
    (
        Field("film.rheology", "Shear of the oil", kind="choice", choices=_RHEOLOGIES),
        Field("lubricant.eyring_stress", "Eyring stress", "MPa", 1.0, 20.0, log=True,
              when=_sheared("eyring")),
        Field("lubricant.carreau_stress", "Carreau stress G", "MPa", 0.01, 20.0, log=True,
              when=_sheared("carreau")),
        Field("lubricant.carreau_exponent", "Carreau exponent n", "", 0.2, 1.0, when=_sheared("carreau")),
        Field("lubricant.limiting_coefficient", "Limiting shear stress over pressure", "", 0.01, 0.15,
              log=True, when=_sheared("limiting")),
        Field(
            "film.way_thermal",
            "Temperature of the film",
            kind="ways",
            ways=(
                Way("Computed", {"film.thermal": True, **_STEEL}, "film.thermal", value=True),
                Way("That of the oil in the inlet", {"film.thermal": None}),
            ),
            when=_follows,
        ),
        Field("lubricant.thermal_conductivity", "Thermal conductivity of the oil", "W/m/K", 0.08, 0.3,
              when=_hot, optional=True, note="none: that of the oil of the library"),
        Field("lubricant.heat_capacity", "Heat capacity of the oil", "J/kg/K", 1000.0, 3000.0, when=_hot,
              optional=True, note="about 2000 J/kg/K; needs a density"),
        *_of_body(1),
        *_of_body(2),
    ),
    opened=False,
    table="film",
    start={"rheology": "newtonian"},
    note="Without it the film is isothermal and Newtonian. Temperatures are computed with an oil whose "
    "viscosity follows its temperature.",
)  # fmt: skip

# Keys of the heat within the table of the contact, which line and point contacts share.
HEAT_OF_CONTACT = (
    *("temperature_1", "temperature_2"),
    *(
        f"body_{number}.{key}"
        for number in (1, 2)
        for key in ("material", "thermal_conductivity", "heat_capacity", "density")
    ),
)
