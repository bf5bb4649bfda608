"""Limits of the models behind a result, in plain words, the situations they hold in, and the literature."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from ehlectric.cases.bearing_case import BearingCase
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


@dataclass(frozen=True)
class Limit:
    """Effect that a model neglects."""

    topic: str
    text: str  # what is left out, and which way it moves the numbers
    holds: Callable[[Any], bool] = lambda _case: True


# Limits of the models, in the order of a report.
LIMITS = (
    Limit(
        "heat and supply of oil",
        "The films are isothermal and fully flooded: heating, starvation and grease thickener are left out. "
        "Real films are thinner, so breakdown voltages are upper bounds (≤) and maximum fields lower bounds "
        "(≥).",
        unheated,
    ),
    Limit(
        "supply of oil",
        "The film is fully flooded: starvation and grease thickener are left out. Real films are thinner, so "
        "breakdown voltages are upper bounds (≤) and maximum fields lower bounds (≥).",
        hot_and_flooded,
    ),
    Limit(
        "heat",
        "Heat is conducted across the film and into the bodies, which take it up as moving half-spaces with "
        "the bulk temperatures of the case; conduction along the film is left out. Conductivity and "
        "relaxation time of the oil are those at the temperature of the inlet.",
        heated,
    ),
    Limit(
        "heat and supply of oil",
        "The film factor of the case stands for heat and starvation as far as it covers them; nothing else "
        "of them is computed.",
        factor,
    ),
    Limit(
        "heat and supply of oil",
        "The supply of oil is that of the case; how it is replenished is not computed. Heating is left out, "
        "which makes real films thinner.",
        starved,
    ),
    Limit(
        "contacts by formula",
        "Films are those of published formulas for smooth, fully flooded contacts, and fields are voltage "
        "divided by the minimum film. Formulas may be 30 to 40 % off a solved film.",
        by_formula,
    ),
    Limit(
        "contacts from the atlas",
        "Films are interpolated between those of smooth, fully flooded contacts that were solved for the "
        "atlas of films, with the error that the result states, and fields are voltage divided by the "
        "minimum film. Where the atlas has no film, formulas take its place, which may be 30 to 40 % off.",
        from_atlas,
    ),
    Limit("oil", "The oil is Newtonian: shear thinning, which makes films thinner, is left out.", newtonian),
    Limit(
        "oil",
        "The oil follows one law between shear stress and shear rate, with constants that depend neither on "
        "temperature nor, but for a limiting stress, on pressure.",
        sheared,
    ),
    Limit(
        "roughness",
        "Surfaces are smooth in the film. Asperities make the film thinner in places; the breakdown voltage "
        "is an upper bound (≤) for rough surfaces.",
        smooth,
    ),
    Limit(
        "roughness",
        "The roughness of the surfaces is in the film, as far as the grid resolves it. Where asperities "
        "touch, their load share and the number of their spots depend on the grid. Heat and wear of spots "
        "are left out.",
        rough,
    ),
    Limit(
        "motion",
        "The roughness stands still while the oil flows past it.",
        lambda case: rough(case) and stands(case),
    ),
    Limit(
        "motion",
        "The load is constant and balanced at every instant: inertia and vibration are left out.",
        moves,
    ),
    Limit(
        "bodies",
        "The bodies are elastic half-spaces of one material each; the ends of a line contact are left out.",
        line,
    ),
    Limit(
        "bodies",
        "The bodies are elastic half-spaces of one material each.",
        lambda case: is_contact(case) and not line(case),
    ),
    Limit(
        "mechanics of the bearing",
        "Loads are those of dry contacts between rigid rings. Tilt, flexible rings, cage forces, skidding, "
        "spin and gravity are left out.",
        is_bearing,
    ),
    Limit(
        "friction of the bearing",
        "The power loss is that of the hydrodynamic resistance to rolling alone. Spin and slip of the balls, "
        "cage, ribs, seals, churned oil and hysteresis of the steel are left out, and may be the larger part "
        "of the friction. The contacts are flooded.",
        solved_heat,
    ),
    Limit(
        "contacts of asperities",
        "The share of time in which contacts short the bearing is a fit of one test rig, or that of ideal "
        "Gaussian summits without wear. Contacts are independent of each other. How long a contact stays "
        "closed and at which voltage it discharges as it opens are left out.",
        is_bearing,
    ),
    Limit(
        "circuit",
        "The bearing is a circuit of capacitances. The field beyond the gaps, to cage, shields and "
        "neighbouring elements, is left out, and so are currents that circulate through both bearings.",
        is_bearing,
    ),
    Limit(
        "coating",
        "The coating is an ideal plate capacitor with an insulation resistance: humidity, sealing and the "
        "field at its edges are left out.",
        coated,
    ),
    Limit(
        "discharge",
        "A film breaks down as soon as its field reaches the dielectric strength of the case, which is an "
        "assumption. How a spark forms, particles, water and additives are left out.",
        has_strength,
    ),
    Limit(
        "discharge",
        "The case gives no dielectric strength, so that no breakdown voltage is computed.",
        no_strength,
    ),
    Limit(
        "oil as insulator", "The oil is a perfect dielectric in the field; leakage is assessed apart from it."
    ),
)


def limits_of(case: AnyCase) -> Iterator[Limit]:
    """Limits that hold for a case, in the order of a report."""
    return (limit for limit in LIMITS if limit.holds(case))


@dataclass(frozen=True)
class Reference:
    """Publication behind an equation."""

    topic: str
    citation: str  # authors, journal and year
    doi: str  # its DOI; empty where it has none, as a standard
    used: Callable[[Any], bool] = lambda _case: True


# Citation and DOI of the study whose equations of film and field are solved.
_MORRIS = "Morris, Leighton, Morris, Lubricants 10 (2022) 87", "10.3390/lubricants10050087"

# Publications behind the equations, in the order of a report.
REFERENCES = (
    Reference("equations of film and field, Moes' groups", *_MORRIS, lambda case: not by_formula(case)),
    Reference("permittivity law of Clausius and Mossotti", *_MORRIS, with_law("clausius-mossotti")),
    Reference("dry contact", "Johnson, Contact Mechanics, 1985", "10.1017/CBO9781139171731"),
    Reference(
        "deflection of the surfaces",
        "Love, Phil. Trans. R. Soc. Lond. A 228 (1929) 377-420",
        "10.1098/rsta.1929.0009",
        lambda case: not by_formula(case),
    ),
    Reference("film formula", "Pan and Hamrock, J. Tribol. 111 (1989) 246-251", "10.1115/1.3261900", linear),
    Reference(
        "film formula",
        "Moes, Wear 159 (1992) 57-66",
        "10.1016/0043-1648(92)90286-H",
        lambda case: linear(case) and is_contact(case),
    ),
    Reference(
        "film formula",
        "Chittenden, Dowson, Dunn, Taylor, Proc. R. Soc. Lond. A 397 (1985)",
        "10.1098/rspa.1985.0014",
        elliptical,
    ),
    Reference(
        "film formula",
        "Hamrock and Dowson, J. Lubr. Technol. 99 (1977) 264-275",
        "10.1115/1.3453074",
        lambda case: elliptical(case) and is_contact(case),
    ),
    Reference(
        "film formula",
        "Nijenbanning, Venner, Moes, Wear 176 (1994) 217-229",
        "10.1016/0043-1648(94)90150-3",
        elliptical,
    ),
    Reference(
        "heating by shear in the inlet",
        "Wilson and Sheu, J. Lubr. Technol. 105 (1983) 187-188",
        "10.1115/1.3254563",
        lambda case: isinstance(case, BearingCase) and case.bearing.heated,
    ),
    Reference(
        "rolling resistance over load, rollers",
        "Biboulet and Houpert, Proc. IMechE Part J 224 (2010), part 1: line contacts",
        "10.1243/13506501JET790",
        lambda case: solved_heat(case) and linear(case),
    ),
    Reference(
        "rolling resistance over load, balls",
        "Biboulet and Houpert, Proc. IMechE Part J 224 (2010), part 2: point contacts",
        "10.1243/13506501JET791",
        lambda case: solved_heat(case) and elliptical(case),
    ),
    Reference(
        "supply of oil",
        "SKF, Rolling bearings, PUB BU/P1 17000: kinematic replenishment factor",
        "",
        by_supply_rule,
    ),
    Reference(
        "decay of a film without supply",
        "van Zoelen, Venner, Lugt, Proc. IMechE J 223 (2009) 541",
        "",
        decaying,
    ),
    Reference(
        "flow of an oil whose viscosity varies across the film",
        "Yang and Wen, J. Tribol. 112 (1990) 631-636",
        "10.1115/1.2920308",
        lambda case: heated(case) or sheared(case) or solved_heat(case),
    ),
    Reference(
        "temperature of moving surfaces",
        "Carslaw and Jaeger, Conduction of Heat in Solids, 2nd ed., 1959",
        "",
        heated,
    ),
    Reference(
        "shear thinning after Ree and Eyring",
        "Johnson and Tevaarwerk, Proc. R. Soc. Lond. A 356 (1977) 215-236",
        "10.1098/rspa.1977.0129",
        with_rheology("eyring"),
    ),
    Reference(
        "shear thinning after Carreau",
        "Bair, Proc. IMechE Part J 219 (2005) 69",
        "",
        with_rheology("carreau"),
    ),
    Reference(
        "limiting shear stress",
        "Bair and Winer, J. Lubr. Technol. 101 (1979) 258",
        "",
        with_rheology("limiting"),
    ),
    Reference(
        "loads of balls",
        "Jones, J. Basic Eng. 82 (1960) 309-320",
        "10.1115/1.3662587",
        lambda case: is_bearing(case) and elliptical(case),
    ),
    Reference(
        "loads and kinematics of a bearing",
        "Harris and Kotzalas, Advanced Concepts of Bearing Technology, 5th ed., 2006",
        "10.1201/9781420006582",
        is_bearing,
    ),
    Reference(
        "loads and profiles of rollers",
        "ISO/TS 16281:2008, Rolling bearings - Methods for calculating the modified reference rating life "
        "for universally loaded bearings",
        "",
        lambda case: is_bearing(case) and linear(case),
    ),
    Reference(
        "viscosity over temperature",
        "ASTM D341, Walther's equation through two kinematic viscosities",
        "",
        by_data_sheet,
    ),
    Reference(
        "viscosity law of Roelands",
        "Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of lubricating "
        "oils, thesis, Delft, 1966",
        "",
        after_roelands,
    ),
    Reference(
        "viscosity law of Barus",
        "Barus, Am. J. Sci. 45 (1893) 87",
        "10.2475/ajs.s3-45.266.87",
        with_law("barus"),
    ),
    Reference(
        "viscosity law modulus",
        "Wingertszahn et al., Lubricants 11 (2023) 369",
        "10.3390/lubricants11090369",
        with_law("modulus"),
    ),
    Reference(
        "viscosity law of Doolittle",
        "Doolittle, J. Appl. Phys. 22 (1951) 1471",
        "10.1063/1.1699894",
        with_law("doolittle"),
    ),
    Reference(
        "density law of Dowson and Higginson",
        "Dowson and Higginson, Elasto-Hydrodynamic Lubrication, 1966",
        "",
        with_law("dowson-higginson"),
    ),
    Reference(
        "density law of Murnaghan",
        "Murnaghan, Proc. Natl. Acad. Sci. 30 (1944) 244",
        "10.1073/pnas.30.9.244",
        with_law("murnaghan"),
    ),
    Reference(
        "Weibull law of the strength",
        "Weibull, J. Appl. Mech. 18 (1951) 293",
        "10.1115/1.4010337",
        lambda case: case.discharge is not None and case.discharge.weibull is not None,
    ),
)


def references_of(case: AnyCase) -> Iterator[Reference]:
    """Publications behind the equations that a case uses."""
    return (reference for reference in REFERENCES if reference.used(case))
