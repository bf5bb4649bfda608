"""Situations of a case, on which the limits and the references of a report depend."""

from __future__ import annotations

from collections.abc import Callable

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case

AnyCase = Case | BearingCase


def is_bearing(case: AnyCase) -> bool:
    """Whether a case is that of a bearing."""
    return isinstance(case, BearingCase)


def is_contact(case: AnyCase) -> bool:
    """Whether a case is that of a contact."""
    return isinstance(case, Case)


def flooded(case: AnyCase) -> bool:
    """Whether the inlet is flooded, and no film factor of a bearing reduces its films."""
    if isinstance(case, Case):
        return case.inlet is None
    return case.bearing.film_factor in ("none", 1.0) and case.bearing.supply in ("flooded", 1.0)


def factor(case: AnyCase) -> bool:
    """Whether a film factor or the supply of oil reduces the films of a bearing."""
    return isinstance(case, BearingCase) and not flooded(case)


def starved(case: AnyCase) -> bool:
    """Whether a contact is given the oil that it finds at its inlet."""
    return isinstance(case, Case) and case.inlet is not None


def by_supply_rule(case: AnyCase) -> bool:
    """Whether a published rule gives the supply of oil of a bearing."""
    return isinstance(case, BearingCase) and case.bearing.by_supply_rule


def decaying(case: AnyCase) -> bool:
    """Whether the decay of films without supply is given for a bearing."""
    return isinstance(case, BearingCase) and case.bearing.supply != "flooded" and elliptical(case)


def smooth(case: AnyCase) -> bool:
    """Whether the surfaces are smooth in the films."""
    return isinstance(case, BearingCase) or not case.roughness


def rough(case: AnyCase) -> bool:
    """Whether the roughness of the surfaces is in the film."""
    return not smooth(case)


def moves(case: AnyCase) -> bool:
    """Whether the roughness moves."""
    return isinstance(case, Case) and case.motion is not None


def stands(case: AnyCase) -> bool:
    """Whether the film is stationary."""
    return isinstance(case, Case) and case.motion is None


def by_formula(case: AnyCase) -> bool:
    """Whether the contacts of a bearing are computed by formula."""
    return isinstance(case, BearingCase) and case.contacts == "formula"


def from_atlas(case: AnyCase) -> bool:
    """Whether the contacts of a bearing have the films of the atlas."""
    return isinstance(case, BearingCase) and case.contacts == "atlas"


def line(case: AnyCase) -> bool:
    """Whether the case is that of a line contact."""
    return isinstance(case, Case) and case.contact.geometry == "line"


def has_strength(case: AnyCase) -> bool:
    """Whether the case gives a dielectric strength."""
    return case.discharge is not None and case.discharge.has_strength


def no_strength(case: AnyCase) -> bool:
    """Whether the case gives no dielectric strength."""
    return not has_strength(case)


def coated(case: AnyCase) -> bool:
    """Whether a ring of the bearing is coated."""
    return isinstance(case, BearingCase) and case.bearing.coating is not None


def heated(case: AnyCase) -> bool:
    """Whether the temperature in the film is computed."""
    return isinstance(case, Case) and case.film is not None and case.film.thermal


def solved_heat(case: AnyCase) -> bool:
    """Whether the film factor of a bearing is that of a film with its temperature."""
    return isinstance(case, BearingCase) and case.bearing.film_factor == "solved"


def unheated(case: AnyCase) -> bool:
    """Whether the films are isothermal and flooded, without a film factor."""
    return flooded(case) and not heated(case)


def hot_and_flooded(case: AnyCase) -> bool:
    """Whether the temperature in a flooded film is computed."""
    return flooded(case) and heated(case)


def sheared(case: AnyCase) -> bool:
    """Whether the oil thins where it is sheared."""
    return _rheology(case) != "newtonian"


def _rheology(case: AnyCase) -> str:
    """Name of the law between shear stress and shear rate; that of a bearing is in its solved heat only."""
    if isinstance(case, BearingCase):
        return "eyring" if solved_heat(case) and case.lubricant.eyring_stress is not None else "newtonian"
    return "newtonian" if case.film is None else case.film.rheology


def newtonian(case: AnyCase) -> bool:
    """Whether the oil is Newtonian."""
    return not sheared(case)


def with_rheology(name: str) -> Callable[[AnyCase], bool]:
    """Function of a case: whether the rheology of its film has this name."""

    def used(case: AnyCase) -> bool:
        return _rheology(case) == name

    return used


def with_law(name: str) -> Callable[[AnyCase], bool]:
    """Whether the oil of a case has a law of this name for viscosity, density or permittivity."""

    def used(case: AnyCase) -> bool:
        oil = case.lubricant
        return name in (oil.viscosity_law, oil.density_law, oil.permittivity_law)

    return used


def elliptical(case: AnyCase) -> bool:
    """Whether the contacts are those of balls, not of rollers."""
    if isinstance(case, BearingCase):
        return case.bearing.roller_length is None
    return case.contact.geometry == "point"


def linear(case: AnyCase) -> bool:
    """Whether the contacts are those of rollers or other lines."""
    return not elliptical(case)


def by_data_sheet(case: AnyCase) -> bool:
    """Whether the viscosity over temperature follows from two kinematic viscosities."""
    return case.lubricant.over_temperature and case.lubricant.atmospheric_law is None


def after_roelands(case: AnyCase) -> bool:
    """Whether the viscosity follows Roelands, over pressure or over temperature."""
    return "roelands" in (case.lubricant.viscosity_law, case.lubricant.atmospheric_law)
