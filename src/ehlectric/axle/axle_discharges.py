"""Discharges of an axle over the simulated time: films of its elements, and what a simulation records.

In an axle with meshes, an element keeps its positions if its capacitance or its breakdown voltage changes by
more than 2 %; otherwise it has its mean values. A bearing has positions of its rolling elements, and a mesh
has phases of one pitch.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle.solution import AxleSolution, SolvedFilms, solve_films
from ehlectric.bearing import Path
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.drive_case import within_remedy
from ehlectric.cases.drive_inputs import Breakdown
from ehlectric.drive import (
    HOUSING,
    BearingElement,
    NetworkInTime,
    Record,
    SourceInTime,
    TimedFilm,
    bearing_element,
    check_extinction,
    event_rows,
    fed_by_arcs,
    film_row,
    shaft_row,
    whole_row,
)
from ehlectric.errors import InputError, printable
from ehlectric.gear import GearSolution, state_at
from ehlectric.quantities.lubrication_states import INSULATES
from ehlectric.runtime.progress import Progress, silent

# Relative change over the positions below which an element has mean values.
_CONSTANT = 0.02

# Positions of a spur mesh over one pitch.
_PHASES = 8


def _name_of(key: str) -> str:
    """Key of an axle for a key of ``film_row``: its largest current is called a current."""
    return key.replace("peak_current", "current")


# Keys of a shaft over time.
_OF_SHAFTS = ("rms_voltage", "peak_voltage", "mean_voltage", "lowest_voltage", "highest_voltage")

# Share of time with metallic contact below which it is neglected.
_NEVER = 1e-6


@dataclass(frozen=True, eq=False)
class AxleDischarges:
    """Discharges of an axle over time.

    Attributes
    ----------
    names : tuple of str
        Elements, of which ``record`` has a film each.
    shafts : tuple of str
        Shafts, whose voltages ``record`` has.
    record : Record
        What happened over the simulated time.
    """

    names: tuple[str, ...]
    shafts: tuple[str, ...]
    record: Record

    def summary(self) -> dict[str, Any]:
        """Return the table ``simulation`` of summary.json, SI units; None without a discharge."""
        rows = [film_row(self.record, b) for b in range(len(self.names))]
        shafts = [shaft_row(*row) for row in self.record.shafts.tolist()]
        return {
            "duration": self.record.duration,
            **whole_row(self.record),
            "elements": [
                {"element": name, **{_name_of(key): value for key, value in row.items()}}
                for name, row in zip(self.names, rows, strict=True)
            ],
            "shafts": [
                {"shaft": name, **{key: row[key] for key in _OF_SHAFTS}}
                for name, row in zip(self.shafts, shafts, strict=True)
            ],
        }

    def events(self) -> list[dict[str, Any]]:
        """Return the discharges in the order of time, SI units; the first 200 000 of them."""
        return event_rows(self.record, "element", self.names)

    @cached_property
    def trace(self) -> tuple[Array, Array, Mapping[str, Array]]:
        """Times [s], voltage of the source, and voltages of the shafts by their names [V], in a short stretch
        around a discharge.
        """
        table = self.record.trace
        first = 2 + len(self.names)
        shafts = {name: table[:, first + k] for k, name in enumerate(self.shafts)}
        return table[:, 0], table[:, 1], shafts


def simulate_axle(
    solution: AxleSolution, progress: Progress = silent, *, films: SolvedFilms | None = None
) -> AxleDischarges | None:
    """Simulate the discharges of a solved axle for the duration of its case; None if all shafts are connected
    to the housing by metal, so that nothing discharges.

    ``films``, solved films of the axle; by default they are solved. ``progress`` is called with a percentage,
    100, and a text. Raises InputError if an element lacks a value that discharges need.
    """
    case, network = solution.case, solution.network()
    breakdown = case.breakdown
    if breakdown is None:
        raise InputError.missing("breakdown", _NO_ARC)
    source = SourceInTime.of(case, breakdown)
    solved = solve_films(case) if films is None else films
    timed = _films_in_time(solved, breakdown, _conducting(solution))
    names = {each.name for each in timed}
    fixed = replace(network, elements=tuple(each for each in network.elements if each.name not in names))
    axle = NetworkInTime(fixed, tuple(timed), breakdown, source.ring_rate)
    if not axle.floating:
        return None
    divider = max((abs(value) for value in network.potentials(1.0).values()), default=0.0)
    record = axle.record(source, divider, case.drive.seed, progress)
    return AxleDischarges(tuple(each.name for each in axle.active), axle.floating, record)


def simulate_axles(
    solutions: Sequence[AxleSolution],
    films: Sequence[SolvedFilms] | None = None,
    progress: Progress = silent,
) -> tuple[AxleDischarges | None, ...]:
    """Discharges of a solved axle and of its remedies, in this order, as of ``simulate_axle``.

    Values that are missing in several of them are named at once, before the first simulation.
    """
    films = [solve_films(solution.case) for solution in solutions] if films is None else films
    case, missing = solutions[0].case, list[InputError]()
    in_file = [0, *(number for number, _ in case.numbered_remedies)]
    if case.breakdown is None:
        missing.append(InputError.missing("breakdown", _NO_ARC))
    for number, (solution, solved) in enumerate(zip(solutions, films, strict=True)):
        lacking, known = list[InputError](), {each.key for each in missing}
        breakdown = solution.case.breakdown or Breakdown.from_dict(_ANY_ARC)
        with within_remedy(in_file[number]), _collecting(lacking):
            _films_in_time(solved, breakdown, _conducting(solution))
        missing += [
            _of_remedy(each, case, number)
            for error in lacking
            for each in error.several or (error,)
            if each.key not in known
        ]
    if missing:
        raise InputError.together(missing)
    return tuple(
        simulate_axle(solution, progress, films=solved)
        for solution, solved in zip(solutions, films, strict=True)
    )


# Reason for a missing table of arcs, and an arc with which other missing values are found.
_NO_ARC = "the arc of the films; drive.duration needs it"
_ANY_ARC = {"arc_resistance": "1 ohm", "extinction_voltage": "1 uV", "recovery_time": "1 us"}


def _of_remedy(error: InputError, case: AxleCase, number: int) -> InputError:
    """Error of a missing value that names one of the remedies that apply, from 1; 0 is the axle itself."""
    if not number:
        return error
    title = printable(case.numbered_remedies[number - 1][1].title)
    text = error.text.removeprefix("missing")
    return error.with_text(error.key, f"missing with the mitigation measure {title!r}{text}")


def _conducting(solution: AxleSolution) -> set[str]:
    """Names of bearings and meshes that conduct for good."""
    return {each.name for each in solution.films() if each.conducts}


def _films_in_time(solved: SolvedFilms, breakdown: Breakdown, conducting: set[str]) -> list[TimedFilm]:
    """Films of all bearings and meshes, except those that conduct for good.

    Raises an InputError that names the missing values of all of them.
    """
    case, films, missing = solved.case, list[TimedFilm](), list[InputError]()
    for number, (name, bearing) in enumerate(zip(case.names_of_bearings(), case.bearing, strict=True)):
        if name not in conducting:
            with _collecting(missing), case.naming(number):
                element = bearing_element(solved.bearings[number], breakdown)
                element = _few_positions(element) if case.mesh else element
                stream = _stream_of_bearing(case, number)
                films.append(TimedFilm(name, bearing.shaft, HOUSING, element, stream))
    for number, (name, mesh) in enumerate(zip(case.names_of_meshes(), case.mesh, strict=True)):
        if name not in conducting:
            with _collecting(missing):
                film = _few_positions(mesh_film(solved.meshes[number], breakdown, f"mesh.{number + 1}"))
                stream = f"mesh of {' and '.join(sorted(mesh.gears))}"
                films.append(TimedFilm(name, mesh.gears[0], mesh.gears[1], film, stream))
    if missing:
        raise InputError.together(missing)
    for each in films:
        check_extinction(breakdown, each.film.breakdown, each.name)
    return films


@contextmanager
def _collecting(missing: list[InputError]) -> Iterator[None]:
    """Context in which the error of a missing value is added to a list."""
    try:
        yield
    except InputError as error:
        if not error.is_missing:
            raise
        missing.append(error)


def _stream_of_bearing(case: AxleCase, number: int) -> int | str:
    """Number or name from which the random numbers of a bearing follow, whatever the order in the file.

    The bearings of the rotor have the random numbers of the bearings of a drive.
    """
    shaft = case.bearing[number].shaft
    place = sorted(case.bearings_of(shaft), key=lambda each: case.bearing[each].at).index(number)
    return place if shaft == case.rotor_name else f"bearing {place} of {shaft}"


def _few_positions(film: BearingElement) -> BearingElement:
    """Film with mean values instead of values that are constant within 2 %."""
    capacitance, limit = (
        np.array([np.mean(values)]) if np.ptp(values) <= _CONSTANT * np.mean(values) else values
        for values in (film.capacitance, np.nan_to_num(film.breakdown, posinf=1e300))
    )
    return replace(film, capacitance=capacitance, breakdown=np.where(limit >= 1e299, math.inf, limit))


def mesh_film(gears: GearSolution, breakdown: Breakdown, mesh: str) -> BearingElement:
    """Film of a solved mesh, at positions over one pitch; ``mesh``, key of its table.

    Under high summits it breaks down at the lowest voltage of an arc. Oil passes the Hertz zone in the time
    2 b_H/u_m, in which a contact stays closed, and other oil with another threshold arrives. Raises
    InputError without a dielectric strength, and without ``contact_resistance`` of a mesh that conducts at
    times. Without it, the short contacts of a mesh that insulates are neglected.
    """
    limits, gear, operation = gears.breakdown_voltage, gears.case.gear, gears.case.gear.operation
    if limits is None:
        raise InputError.missing("discharge.dielectric_strength", "the strength of the oil")
    share = float(gears.loads.mean(gears.contact_time_share()))
    touching = share if gear.contact.conduction == "by-film" and share > _NEVER else 0.0
    if touching and gear.contact.contact_resistance is None:
        if state_at(share, gear.contact.conduction) != INSULATES:
            raise InputError.missing(
                f"{mesh}.contact_resistance", "the resistance of the mesh while it conducts, about 1 ohm"
            )
        touching = 0.0
    phases = np.arange(_PHASES) * limits.size // _PHASES
    smooth = np.asarray(gears.strength) * gears.loads.least(gears.films.minimum)
    capacitance, tau = np.asarray(gears.capacitance)[phases], gears.relaxation_time
    width, speed = gears.films.half_width[gears.thinnest], gears.films.mean_speed[gears.thinnest]
    pitch = 2.0 * math.pi / (gears.pair.teeth[0] * operation.pinion_speed)
    return BearingElement(
        capacitance=capacitance,
        conductance=0.0 if tau is None else float(np.mean(capacitance)) / tau,
        breakdown=fed_by_arcs(smooth[phases], limits[phases], breakdown.lowest_voltage),
        shape=breakdown.weibull_shape or math.inf,
        step=pitch / _PHASES,
        path=Path(),
        touching=touching,
        touch_resistance=gear.contact.contact_resistance or math.inf,
        hertz_area=0.0,
        largest_area=0.0,
        transit=float(2.0 * width / speed),
    )
