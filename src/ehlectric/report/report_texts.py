"""Limits of the models behind a result and the literature behind its equations, of ``report_texts.toml``.

The file contains the texts, and the names of the conditions under which they hold; this module has the
conditions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeVar

from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.library.estimated_bearings import is_estimated
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.quantities.quantity import data_file

TEXTS = data_file("ehlectric.report", "report_texts.toml")
SENTENCES = TEXTS["sentences"]

# Limits of bearings that the limits of drives say otherwise.
_REPLACED = ("contacts of asperities", "circuit", "motor", "oil as insulator")


@dataclass(frozen=True)
class Limit:
    """Effect that a model neglects, and which way it moves the numbers."""

    topic: str
    text: str
    when: tuple[str, ...] = ()  # conditions under which it holds


@dataclass(frozen=True)
class Reference:
    """Publication behind an equation."""

    topic: str
    citation: str  # authors, journal and year
    doi: str = ""  # empty where it has none, as a standard
    when: tuple[str, ...] = ()  # conditions under which the equation is used


T = TypeVar("T", Limit, Reference)


def _of_file(entry: type[T], name: str) -> tuple[T, ...]:
    """Entries of the file of one kind, in the order of a report."""
    return tuple(entry(**fields | {"when": tuple(fields.get("when", ()))}) for fields in TEXTS[name])


LIMITS, DRIVE_LIMITS = _of_file(Limit, "limits"), _of_file(Limit, "drive_limits")
REFERENCES, DRIVE_REFERENCES = _of_file(Reference, "references"), _of_file(Reference, "drive_references")


def limits_of(case: SolvedCase) -> Iterator[Limit]:
    """Limits that hold for a case; for a drive, the limits of its bearings follow, each once."""
    if isinstance(case, DriveCase):
        yield from _holding(DRIVE_LIMITS, case)
        yield from (limit for limit in _of_bearings(case, LIMITS) if limit.topic not in _REPLACED)
    else:
        yield from _holding(LIMITS, case)


def references_of(case: SolvedCase) -> Iterator[Reference]:
    """Publications behind the equations of a case; of a drive, the publications of its bearings follow, each
    once.
    """
    if isinstance(case, DriveCase):
        simulation = list(_holding(DRIVE_REFERENCES, case))
        known = {reference.doi for reference in simulation if reference.doi}
        yield from simulation
        yield from (reference for reference in _of_bearings(case, REFERENCES) if reference.doi not in known)
    else:
        yield from _holding(REFERENCES, case)


def _of_bearings(case: DriveCase, entries: tuple[T, ...]) -> Iterator[T]:
    """Entries that hold for a bearing of a drive, each once."""
    yield from dict.fromkeys(
        reference for bearing in case.bearings for reference in _holding(entries, bearing)
    )


def conditions_of(case: SolvedCase) -> dict[str, bool]:
    """Conditions of the file by name, and whether each of them holds for a case."""
    if isinstance(case, DriveCase):
        return _of_drive(case)
    if isinstance(case, AxleCase):
        conditions = {"axle": True}
    elif isinstance(case, GearCase):
        conditions = _of_gear(case)
    else:
        conditions = _of_bearing(case) if isinstance(case, BearingCase) else _of_contact(case)
    oil, discharge = case.lubricant, case.discharge
    replaced = case.user_laws.names if isinstance(case, Case) and case.user_laws is not None else {}
    laws = [
        getattr(oil, f"{name}_law")
        for name in ("viscosity", "density", "permittivity")
        if name not in replaced
    ]
    return conditions | {
        "strength": discharge is not None and discharge.has_strength,
        "weibull": discharge is not None and discharge.weibull is not None,
        # The viscosity over temperature follows from two kinematic viscosities.
        "data sheet": oil.over_temperature and oil.atmospheric_law is None and "viscosity" not in replaced,
        **{f"law {law}": True for law in laws},
        "law roelands": "roelands" in (*laws, None if "viscosity" in replaced else oil.atmospheric_law),
    }


def _holding(entries: tuple[T, ...], case: SolvedCase) -> Iterator[T]:
    """Entries whose conditions all hold for a case."""
    holds = conditions_of(case)
    for entry in entries:
        names = ((name.removeprefix("not "), not name.startswith("not ")) for name in entry.when)
        if all(holds.get(name, False) is needed for name, needed in names):
            yield entry


def _of_contact(case: Case) -> dict[str, bool]:
    film = case.film
    heated = film is not None and film.thermal
    rheology = "newtonian" if film is None else film.rheology
    return {
        "contact": True,
        "point": case.contact.geometry == "point",
        "flooded": case.inlet is None,
        "starved": case.inlet is not None,
        "heated": heated,
        "rough": bool(case.roughness),
        "moving": case.motion is not None,
        f"rheology {rheology}": True,
        "viscosity across the film": heated or rheology != "newtonian",
    }


def _of_bearing(case: BearingCase) -> dict[str, bool]:
    bearing = case.bearing
    flooded = bearing.film_factor in ("none", 1.0) and bearing.supply in ("flooded", 1.0)
    solved_heat = bearing.film_factor == "solved"
    # The rheology of a bearing is in its solved heat only.
    thinning = solved_heat and case.lubricant.eyring_stress is not None
    return {
        "bearing": True,
        f"kind {bearing.kind}": True,
        "pair": bearing.pair is not None,
        "estimated": is_estimated(bearing.base),
        "motor": case.motor is not None,
        "point": bearing.roller_length is None,
        "flooded": flooded,
        "film factor": not flooded,
        "supply": bearing.supply != "flooded",
        "supply rule": bearing.by_supply_rule,
        "formula": case.contacts == "formula",
        "atlas": case.contacts == "atlas",
        "coated": bearing.coating is not None,
        "summits": bearing.summit_height > 0.0,
        "inlet heat": bearing.heated,
        "solved heat": solved_heat,
        f"rheology {'eyring' if thinning else 'newtonian'}": True,
        "viscosity across the film": solved_heat,
    }


def _of_gear(case: GearCase) -> dict[str, bool]:
    operation = case.gear.operation
    return {
        "gear": True,
        "formula": case.contacts == "formula",
        "atlas": case.contacts == "atlas",
        "summits": case.gear.summit_height > 0.0,
        "inlet heat": case.lubricant.over_temperature,
        "rheology newtonian": True,
        f"sharing {operation.load_sharing}": True,
        "estimated flanks": isinstance(operation.bulk_temperature, str),
        "asperity contact": case.gear.contact.conduction == "by-film",
    }


def _of_drive(case: DriveCase) -> dict[str, bool]:
    scattered = any(
        bearing_case.discharge is not None and bearing_case.discharge.weibull
        for bearing_case in case.bearings
    )
    return {
        "motor": True,
        # The voltages at which the films break down scatter.
        "scatter": case.breakdown.weibull_shape is not None or scattered,
        "estimated": bool(case.circuit.estimated),
        "grounding ring": case.running_circuit.grounding_ring_resistance is not None,
        "measured source": case.source.measured,
        "space-vector": case.source.modulation == "space-vector",
        "pole pairs": case.source.pole_pairs is not None,
        "rough bearing": any(bearing_case.bearing.composite_rq is not None for bearing_case in case.bearings),
    }
