"""Heat and shear of a film as its solver takes them, from the case of the contact."""

from __future__ import annotations

from ehlectric.cases.case import Case
from ehlectric.cases.films.physics import thermal_properties
from ehlectric.contact.bodies import surface_ratios
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.heat.oil import hot_oil
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError
from ehlectric.film.sheared.laws import Rheology
from ehlectric.film.thermal.physics import Body, Physics, Thermal

# Keys of the temperatures of the oil in the inlet and of both bodies.
_TEMPERATURES = ("contact.temperature", "contact.temperature_1", "contact.temperature_2")


def physics_of(case: Case | Setup, conditions: Conditions | PointConditions) -> Physics | None:
    """Heat and shear of the film of a contact; None for an isothermal Newtonian one.

    Parameters
    ----------
    case : Case or Setup
        Case of the contact. A setup without a case has no heat and no shear.
    conditions : Conditions or PointConditions
        Operating conditions of the contact.

    Returns
    -------
    Physics or None
        Rheology, speeds, bodies and oil over temperature, SI units.

    Raises
    ------
    InputError
        If a surface moves against entrainment in a thermal film, or the oil has no values at its
        temperatures.

    Examples
    --------
    >>> from ehlectric.contact.resolve import resolve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "entrainment_speed": 4.0}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "slide_to_roll_ratio": 0.5}
    >>> oil = {"base": "paper", "eyring_stress": "5 MPa"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": oil, "film": {"rheology": "eyring"}})
    >>> found = physics_of(case, resolve(case))
    >>> found.speeds, found.rheology.constants
    ((5.0, 3.0), {'eyring_stress': 5000000.0})
    """
    if not isinstance(case, Case) or case.film is None:
        return None
    speed = conditions.entrainment_speed
    first, second = (speed * ratio for ratio in surface_ratios(conditions.slide_to_roll_ratio))
    return Physics(
        rheology=Rheology(case.film.rheology, case.film.constants(case.lubricant)),
        speeds=(first, second),
        viscosity=conditions.viscosity,
        thermal=_thermal(case, conditions, (first, second)) if case.film.thermal else None,
    )


def _thermal(case: Case, conditions: Conditions | PointConditions, speeds: tuple[float, float]) -> Thermal:
    """Bodies and oil of a thermal film."""
    contact = case.contact
    if min(speeds) < 0.0:
        raise InputError(
            "contact.slide_to_roll_ratio",
            got=f"{conditions.slide_to_roll_ratio:g}, at which surface {1 + speeds.index(min(speeds))} moves "
            "against entrainment",
            takes="-2 to 2 for a thermal film",
        )
    assert contact.temperature is not None
    inlet = contact.temperature
    warm = tuple(inlet if own is None else own for own in (contact.temperature_1, contact.temperature_2))
    bodies = tuple(
        Body(temperature, **thermal_properties(contact.value(name), f"contact.{name}"))
        for name, temperature in zip(("body_1", "body_2"), warm, strict=True)
    )
    return Thermal(
        bodies=(bodies[0], bodies[1]),
        inlet_temperature=inlet,
        oil=hot_oil(case.lubricant, (inlet, *warm), conditions.max_pressure, _TEMPERATURES),
    )
