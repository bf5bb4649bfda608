"""Limits of the models behind a result, in plain words, and the literature behind its equations."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case

Kind = Literal["contact", "motion", "bearing", "sweep"]

AnyCase = Case | BearingCase


@dataclass(frozen=True)
class Limit:
    """Effect that a model neglects.

    Attributes
    ----------
    topic : str
        Part of the model.
    text : str
        What is left out, and which way it moves the numbers.
    holds : callable
        Whether the limit holds for a case.
    """

    topic: str
    text: str
    holds: Callable[[AnyCase], bool] = lambda _case: True


def _is_bearing(case: AnyCase) -> bool:
    return isinstance(case, BearingCase)


def _is_contact(case: AnyCase) -> bool:
    return isinstance(case, Case)


def _no_factor(case: AnyCase) -> bool:
    if isinstance(case, Case):
        return case.inlet is None
    return case.bearing.film_factor in ("none", 1.0)


def _factor(case: AnyCase) -> bool:
    return isinstance(case, BearingCase) and case.bearing.film_factor not in ("none", 1.0)


def _starved(case: AnyCase) -> bool:
    return isinstance(case, Case) and case.inlet is not None


def _smooth(case: AnyCase) -> bool:
    return isinstance(case, BearingCase) or not case.roughness


def _rough(case: AnyCase) -> bool:
    return not _smooth(case)


def _moves(case: AnyCase) -> bool:
    return isinstance(case, Case) and case.motion is not None


def _stands(case: AnyCase) -> bool:
    return isinstance(case, Case) and case.motion is None


def _by_formula(case: AnyCase) -> bool:
    return isinstance(case, BearingCase) and case.contacts == "formula"


def _from_atlas(case: AnyCase) -> bool:
    return isinstance(case, BearingCase) and case.contacts == "atlas"


def _line(case: AnyCase) -> bool:
    return isinstance(case, Case) and case.contact.geometry == "line"


def _has_strength(case: AnyCase) -> bool:
    return case.discharge is not None and case.discharge.has_strength


def _no_strength(case: AnyCase) -> bool:
    return not _has_strength(case)


def _coated(case: AnyCase) -> bool:
    return isinstance(case, BearingCase) and case.bearing.coating is not None


# Limits of the models, in the order of a report.
LIMITS = (
    Limit(
        "heat and supply of oil",
        "The films are isothermal and fully flooded: heating, starvation and grease thickener are left out. "
        "Real films are thinner, so breakdown voltages are upper bounds (≤) and maximum fields lower bounds "
        "(≥).",
        _no_factor,
    ),
    Limit(
        "heat and supply of oil",
        "The film factor of the case stands for heat and starvation as far as it covers them; nothing else "
        "of them is computed.",
        _factor,
    ),
    Limit(
        "heat and supply of oil",
        "The film is isothermal: heating is left out, which makes real films thinner. The supply of oil is "
        "that of the case; how it is replenished is not computed.",
        _starved,
    ),
    Limit(
        "contacts by formula",
        "Films are those of published formulas for smooth, fully flooded contacts, and fields are voltage "
        "divided by the minimum film. Formulas may be 30 to 40 % off a solved film.",
        _by_formula,
    ),
    Limit(
        "contacts from the atlas",
        "Films are interpolated between those of smooth, fully flooded contacts that were solved for the "
        "atlas of films, with the error that the result states, and fields are voltage divided by the "
        "minimum film. Where the atlas has no film, formulas take its place, which may be 30 to 40 % off.",
        _from_atlas,
    ),
    Limit("oil", "The oil is Newtonian: shear thinning, which makes films thinner, is left out."),
    Limit(
        "roughness",
        "Surfaces are smooth in the film. Asperities make the film thinner in places; the breakdown voltage "
        "is an upper bound (≤) for rough surfaces.",
        _smooth,
    ),
    Limit(
        "roughness",
        "The roughness of the surfaces is in the film, as far as the grid resolves it. Where asperities "
        "touch, their load share and the number of their spots depend on the grid. Heat and wear of spots "
        "are left out.",
        _rough,
    ),
    Limit(
        "motion",
        "The roughness stands still while the oil flows past it.",
        lambda case: _rough(case) and _stands(case),
    ),
    Limit(
        "motion",
        "The load is constant and balanced at every instant: inertia and vibration are left out.",
        _moves,
    ),
    Limit(
        "bodies",
        "The bodies are elastic half-spaces of one material each; the ends of a line contact are left out.",
        _line,
    ),
    Limit(
        "bodies",
        "The bodies are elastic half-spaces of one material each.",
        lambda case: _is_contact(case) and not _line(case),
    ),
    Limit(
        "mechanics of the bearing",
        "Loads are those of dry contacts between rigid rings. Tilt, flexible rings, cage forces, skidding, "
        "spin and gravity are left out.",
        _is_bearing,
    ),
    Limit(
        "contacts of asperities",
        "The share of time in which contacts short the bearing is a fit of one test rig, or that of ideal "
        "Gaussian summits without wear. Contacts are independent of each other. How long a contact stays "
        "closed and at which voltage it discharges as it opens are left out.",
        _is_bearing,
    ),
    Limit(
        "circuit",
        "The bearing is a circuit of capacitances. The field beyond the gaps, to cage, shields and "
        "neighbouring elements, is left out, and so are currents that circulate through both bearings.",
        _is_bearing,
    ),
    Limit(
        "coating",
        "The coating is an ideal plate capacitor with an insulation resistance: humidity, sealing and the "
        "field at its edges are left out.",
        _coated,
    ),
    Limit(
        "discharge",
        "A film breaks down as soon as its field reaches the dielectric strength of the case, which is an "
        "assumption. How a spark forms, particles, water and additives are left out.",
        _has_strength,
    ),
    Limit(
        "discharge",
        "The case gives no dielectric strength, so that no breakdown voltage is computed.",
        _no_strength,
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
    """Publication behind an equation.

    Attributes
    ----------
    topic : str
        What is taken from it.
    citation : str
        Authors, journal and year.
    doi : str
        Its DOI; empty where it has none, as a standard.
    used : callable
        Whether it is used in a case.
    """

    topic: str
    citation: str
    doi: str
    used: Callable[[AnyCase], bool] = lambda _case: True


def _with_law(name: str) -> Callable[[AnyCase], bool]:
    """Whether the oil of a case has a law of this name for viscosity, density or permittivity."""

    def used(case: AnyCase) -> bool:
        oil = case.lubricant
        return name in (oil.viscosity_law, oil.density_law, oil.permittivity_law)

    return used


def _elliptical(case: AnyCase) -> bool:
    """Whether the contacts are those of balls, not of rollers."""
    if isinstance(case, BearingCase):
        return case.bearing.roller_length is None
    return case.contact.geometry == "point"


def _linear(case: AnyCase) -> bool:
    return not _elliptical(case)


def _by_data_sheet(case: AnyCase) -> bool:
    """Whether the viscosity over temperature follows from two kinematic viscosities."""
    return case.lubricant.over_temperature and case.lubricant.atmospheric_law is None


def _after_roelands(case: AnyCase) -> bool:
    return "roelands" in (case.lubricant.viscosity_law, case.lubricant.atmospheric_law)


# Citation and DOI of the study whose equations of film and field are solved.
_MORRIS = "Morris, Leighton, Morris, Lubricants 10 (2022) 87", "10.3390/lubricants10050087"

# Publications behind the equations, in the order of a report.
REFERENCES = (
    Reference("equations of film and field, Moes' groups", *_MORRIS, lambda case: not _by_formula(case)),
    Reference("permittivity law of Clausius and Mossotti", *_MORRIS, _with_law("clausius-mossotti")),
    Reference("dry contact", "Johnson, Contact Mechanics, 1985", "10.1017/CBO9781139171731"),
    Reference(
        "deflection of the surfaces",
        "Love, Phil. Trans. R. Soc. Lond. A 228 (1929) 377-420",
        "10.1098/rsta.1929.0009",
        lambda case: not _by_formula(case),
    ),
    Reference("film formula", "Pan and Hamrock, J. Tribol. 111 (1989) 246-251", "10.1115/1.3261900", _linear),
    Reference(
        "film formula",
        "Moes, Wear 159 (1992) 57-66",
        "10.1016/0043-1648(92)90286-H",
        lambda case: _linear(case) and _is_contact(case),
    ),
    Reference(
        "film formula",
        "Chittenden, Dowson, Dunn, Taylor, Proc. R. Soc. Lond. A 397 (1985)",
        "10.1098/rspa.1985.0014",
        _elliptical,
    ),
    Reference(
        "film formula",
        "Hamrock and Dowson, J. Lubr. Technol. 99 (1977) 264-275",
        "10.1115/1.3453074",
        lambda case: _elliptical(case) and _is_contact(case),
    ),
    Reference(
        "film formula",
        "Nijenbanning, Venner, Moes, Wear 176 (1994) 217-229",
        "10.1016/0043-1648(94)90150-3",
        _elliptical,
    ),
    Reference(
        "heating by shear in the inlet",
        "Wilson and Sheu, J. Lubr. Technol. 105 (1983) 187",
        "",
        lambda case: isinstance(case, BearingCase) and case.bearing.film_factor == "inlet-shear",
    ),
    Reference(
        "loads of balls",
        "Jones, J. Basic Eng. 82 (1960) 309-320",
        "10.1115/1.3662587",
        lambda case: _is_bearing(case) and _elliptical(case),
    ),
    Reference(
        "loads and kinematics of a bearing",
        "Harris and Kotzalas, Advanced Concepts of Bearing Technology, 5th ed., 2006",
        "10.1201/9781420006582",
        _is_bearing,
    ),
    Reference(
        "loads and profiles of rollers",
        "ISO/TS 16281:2008, Rolling bearings - Methods for calculating the modified reference rating life "
        "for universally loaded bearings",
        "",
        lambda case: _is_bearing(case) and _linear(case),
    ),
    Reference(
        "viscosity over temperature",
        "ASTM D341, Walther's equation through two kinematic viscosities",
        "",
        _by_data_sheet,
    ),
    Reference(
        "viscosity law of Roelands",
        "Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of lubricating "
        "oils, thesis, Delft, 1966",
        "",
        _after_roelands,
    ),
    Reference(
        "viscosity law of Barus",
        "Barus, Am. J. Sci. 45 (1893) 87",
        "10.2475/ajs.s3-45.266.87",
        _with_law("barus"),
    ),
    Reference(
        "viscosity law modulus",
        "Wingertszahn et al., Lubricants 11 (2023) 369",
        "10.3390/lubricants11090369",
        _with_law("modulus"),
    ),
    Reference(
        "viscosity law of Doolittle",
        "Doolittle, J. Appl. Phys. 22 (1951) 1471",
        "10.1063/1.1699894",
        _with_law("doolittle"),
    ),
    Reference(
        "density law of Dowson and Higginson",
        "Dowson and Higginson, Elasto-Hydrodynamic Lubrication, 1966",
        "",
        _with_law("dowson-higginson"),
    ),
    Reference(
        "density law of Murnaghan",
        "Murnaghan, Proc. Natl. Acad. Sci. 30 (1944) 244",
        "10.1073/pnas.30.9.244",
        _with_law("murnaghan"),
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
