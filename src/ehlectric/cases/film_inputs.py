"""Tables of a case about its film: supply of oil at the inlet, heat and shear."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Literal, Self

from pydantic import model_validator

from ehlectric.cases import library
from ehlectric.cases.case_oil import Lubricant, density_at, viscosity_over_temperature
from ehlectric.cases.contact_inputs import Body, Contact
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.quantities.alternatives import ALTERNATIVES
from ehlectric.quantities.units import to_si


class LayerTable(Table, book="inlet.layer_table"):
    """Layer of oil at the inlet of a point contact over the position across entrainment, linear between."""

    y: tuple[float, ...]
    thickness: tuple[float, ...]

    @model_validator(mode="after")
    def _check(self) -> Self:
        return self.check_over("y", "thickness")


class Inlet(Table, book="inlet"):
    """Oil that is supplied to a contact: a layer on its surfaces, or the film that it gives without motion.

    Examples
    --------
    >>> Inlet.from_dict({"oil_layer": "200 nm"}).oil_layer
    2e-07
    """

    oil_layer: float | None = None
    layer_table: LayerTable | None = None
    film_ratio: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = [row[0] for row in ALTERNATIVES["inlet"][0]]
        self.check_alternatives(names, f"one of {', '.join(names)}", needed=True)
        return self

    def check(self, contact: Contact, *, tables: Collection[str]) -> None:
        """Check that the table fits the other tables of its case. Raises InputError if a line contact has a
        layer over y, surfaces move in opposite directions, a contact with motion has a ratio of films, or the
        case has the table ``meter`` or ``film``.
        """
        if contact.opposed:
            raise InputError(
                "inlet",
                got="[inlet] with surfaces that move in opposite directions",
                takes="a slide-to-roll ratio from -2 to 2: one surface moves the oil away from the contact",
            )
        if self.layer_table is not None and contact.geometry == "line":
            raise InputError("inlet.layer_table", got="a line contact", takes="inlet.oil_layer")
        if "motion" in tables and self.film_ratio is not None:
            raise InputError(
                "inlet.film_ratio",
                got=f"{self.film_ratio:g} with [motion], in which the film changes with time",
                takes="inlet.oil_layer or inlet.layer_table; the same case without [motion] finds the layer",
            )
        if "meter" in tables:
            raise InputError("inlet", got="[inlet] with [meter]", takes="a flooded contact there")


# Constants of the lubricant that each rheology needs.
CONSTANTS: Mapping[str, tuple[str, ...]] = {
    "newtonian": (),
    "eyring": ("eyring_stress",),
    "carreau": ("carreau_stress", "carreau_exponent"),
    "limiting": ("limiting_coefficient",),
}

# Constants of laws of shear that films of bearings and gears lack: they are Newtonian or Eyring fluids.
_NOT_OF_MACHINES = ("carreau_stress", "carreau_exponent", "limiting_coefficient")


def shear_unused(oil: Lubricant) -> list[str]:
    """Return the dotted keys of shear constants of an oil that films of bearings and gears do not use.

    Examples
    --------
    >>> shear_unused(Lubricant.from_dict({"base": "paper", "limiting_coefficient": 0.05}))
    ['lubricant.limiting_coefficient']
    """
    return [f"lubricant.{key}" for key in _NOT_OF_MACHINES if getattr(oil, key) is not None]


# Thermal properties of a body and their units.
_OF_BODIES = {"thermal_conductivity": "W/m/K", "heat_capacity": "J/kg/K", "density": "kg/m**3"}


class FilmPhysics(Table, book="film"):
    """Heat and shear of the oil in the film; without the table it is isothermal and Newtonian.

    Examples
    --------
    >>> FilmPhysics.from_dict({"rheology": "eyring"}).thermal
    False
    """

    thermal: bool = False
    rheology: Literal["newtonian", "eyring", "carreau", "limiting"] = "newtonian"

    def check(self, contact: Contact, lubricant: Lubricant, by_law: Collection[str] = ()) -> None:
        """Check that a case has all that a film with heat or shear needs. Raises InputError if a property of
        the oil, of a body or a temperature is missing. ``by_law``, properties with a law of the user's own.
        """
        for key in CONSTANTS[self.rheology]:
            if getattr(lubricant, key) is None:
                raise InputError.missing(
                    f"lubricant.{key}", f"a value, which rheology {self.rheology!r} needs"
                )
        if self.thermal:
            if contact.temperature is None:
                raise InputError.missing(
                    "contact.temperature", "the temperature of the oil in the inlet; a thermal film needs it"
                )
            check_thermal_oil(lubricant, contact.temperature, by_law=by_law)
            for name in ("body_1", "body_2"):
                thermal_properties(getattr(contact, name), f"contact.{name}")

    def constants(self, lubricant: Lubricant) -> dict[str, float]:
        """Constants of the rheology of an oil by their keys, SI units."""
        return {key: getattr(lubricant, key) for key in CONSTANTS[self.rheology]}


def check_film(
    film: FilmPhysics | None, contact: Contact, oil: Lubricant, by_law: Collection[str] = ()
) -> None:
    """Raise an InputError if the table ``film``, or its absence, does not fit the rest of a case. ``by_law``,
    properties with a law of the user's own.
    """
    if film is None or not film.thermal:
        _refuse_unused(contact)
    if film is not None:
        film.check(contact, oil, by_law)


def _refuse_unused(contact: Contact) -> None:
    """Raise an InputError for temperatures of the surfaces, which an isothermal film does not use."""
    for key in ("temperature_1", "temperature_2"):
        if getattr(contact, key) is not None:
            raise InputError.worded(
                f"contact.{key}",
                "is used by a thermal film only; give [film] thermal = true, or only contact.temperature",
            )


def check_thermal_oil(
    oil: Lubricant, temperature: float, what: str = "a thermal film", by_law: Collection[str] = ()
) -> None:
    """Raise an InputError if a property of the oil, over temperature, is missing for ``what``. ``by_law``,
    properties with a law of the user's own.
    """
    if "viscosity" not in by_law and viscosity_over_temperature(oil) is None:
        of_contact = what == "a thermal film"
        also = ", or in Python the viscosity of Case.line(..., laws=Laws(...))" if of_contact else ""
        raise InputError.missing(
            "lubricant.atmospheric_law",
            f"it or [lubricant.temperature]{also}: {what} needs the viscosity over temperature",
        )
    for key, ways in _missing(oil, temperature):
        raise InputError.missing(f"lubricant.{key}", f"{ways}; {what} needs it")


def _missing(oil: Lubricant, temperature: float) -> Iterator[tuple[str, str]]:
    """Keys of thermal properties that an oil lacks, each with the ways to give it."""
    if density_at(oil, temperature) is None:
        yield "density", "the density of the oil"
    sheet = oil.temperature
    if oil.law("thermal_conductivity_law") is None and (sheet is None or sheet.thermal_conductivity is None):
        yield "thermal_conductivity", "it or thermal_conductivity_law"
    if oil.law("heat_capacity_law") is None:
        yield "heat_capacity", "it or heat_capacity_law"


def thermal_properties(body: Body | None, name: str) -> dict[str, float]:
    """Thermal properties of a body: its own, or the properties of its material. Returns
    ``thermal_conductivity`` [W/(m K)], ``heat_capacity`` [J/(kg K)] and ``density`` [kg/m^3]. Raises
    InputError if one of them is missing.

    Examples
    --------
    >>> thermal_properties(Body.from_dict({"material": "steel", "density": 7850.0}), "contact.body_1")
    {'thermal_conductivity': 46.0, 'heat_capacity': 470.0, 'density': 7850.0}
    """
    material = {} if body is None or body.material is None else library.solid(body.material)
    properties: dict[str, float] = {}
    for key, unit in _OF_BODIES.items():
        given = None if body is None else getattr(body, key)
        if given is None and key not in material:
            raise InputError.missing(
                f"{name}.{key}", f'a value, or {name}.material = "steel"; a thermal film needs it'
            )
        properties[key] = to_si(material[key], unit) if given is None else given
    return properties
