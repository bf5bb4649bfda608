"""Probability that each element of an axle breaks down, and that it is the first, over uncertain inputs.

At each point of a Sobol design the whole axle is solved: loads, films, network and voltages. An element with
the voltage U and the breakdown voltage V_b breaks down if U is at least V_b; an element whose summits touch
discharges at any voltage. The first element has the largest r = U/V_b, infinite where summits touch under a
voltage. Which of two elements A and B is first depends on

    D = (r_A - r_B)/(r_A + r_B),

which does not contain the dielectric strength. D is 1 if the summits of A touch, and -1 if the summits of B
touch. The shares of the inputs in the variance of D rank the measurements that decide which of the two
elements is first. In the same way the inputs have shares in the variance of r/(1 + r) of the first element.
Both functions are bounded: a logarithm would not be near the inputs at which summits touch.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.axle.film_capacitances import FilmCapacitances
from ehlectric.axle.many_axles import FilmScales, solve_axles
from ehlectric.axle.solution import AxleSolution, SolvedFilms, solve_films
from ehlectric.bearing import (
    FILMS,
    MOTOR,
    SEED,
    STAGES,
    Change,
    Names,
    UncertainInput,
    Uncertainty,
    at_point,
    clearance_change,
    grade_changes,
    label_of,
    load_change,
    logs_of_factors,
    proportional_to_strength,
    spread_at,
    strength_changes,
    summit_changes,
    temperature_change,
)
from ehlectric.cases.axle_case import AxleCase, changed_axle, changed_bearings
from ehlectric.cases.input_keys import is_quantity
from ehlectric.discharge.breakdown_rule import INTERVAL
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.drive import firsts, times_strength, voltage_ratios
from ehlectric.errors import InputError
from ehlectric.formulas.sobol import sobol_points
from ehlectric.formulas.variance_shares import variance_shares
from ehlectric.gear import AREA_FACTOR, reference_area_of
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.runtime.files import plain

# Keys of inputs that act on the scales of films and flanks.
SUMMITS, AREA = "mesh.gear.summit_height", "mesh.gear.contact.reference_area"

# Keys of the errors of the films of bearings and of meshes.
FILMS_OF = {"bearings": f"{FILMS}.bearings", "meshes": f"{FILMS}.meshes"}

_OF_MOTOR = "engineering judgement: data sheets do not have it, and few measure it"
_OF_AREA = "engineering judgement: the area of the measurement is known to a factor of 3"

# Operating point of the case: no other inputs.
_HERE: Mapping[str, float] = MappingProxyType({})

# Share of the variance of r/(1 + r) whose prediction ends the refinement, and from which the shares of the
# inputs recommend a measurement (engineering judgement).
_PREDICTED = 0.5

# Least share of the points at which an element of two has a voltage and can break down, and the summits of at
# most one of both touch, so that their ratios are compared (engineering judgement).
_LEAST_COMPARED = 0.05

# Inputs with a smaller share of the variance are not listed.
_LEAST_SHARE = 0.03


@dataclass(frozen=True)
class UncertainKey:
    """Uncertain input of an axle: its range, and the keys of bearings that change by the same step."""

    change: Change
    bearings: Mapping[int, Mapping[str, float]] = field(default_factory=dict)  # values in the case

    def value(self, part: float) -> float:
        """Value at a part of the range; the logarithm of the reference area is evenly distributed."""
        low, high = self.change.ends
        return low * (high / low) ** part if self.change.key == AREA else low + (high - low) * part

    def values(self, value: float) -> dict[int, dict[str, float]]:
        """Values of the keys of bearings at a value of the input."""
        step = value - self.change.value
        return {
            number: {key: nominal + step for key, nominal in keys.items()}
            for number, keys in self.bearings.items()
        }


@dataclass(frozen=True)
class ElementChance:
    """What the points of a design say of an element."""

    element: str
    breakdown: float  # probability of a voltage of at least the breakdown voltage, or of touching summits
    first: float  # probability that the element is the first
    touching: float  # probability that summits touch, and the element does not conduct
    conduction: float  # probability that the element conducts
    # Voltage divided by breakdown voltage at 5 %, 50 % and 95 %, infinite where summits touch.
    ratios: tuple[float, float, float]


@dataclass(frozen=True)
class Deciding:
    """Inputs that decide which of two elements is first, the largest share first."""

    elements: tuple[str, str]
    # Key and label of the inputs, with their total shares of the variance of D.
    shares: tuple[tuple[str, str, float], ...]
    predicted: float  # share of the variance that the polynomial behind the shares predicts


@dataclass(frozen=True)
class AxleUncertainty(Uncertainty):
    """Distribution of the margin of the first element, with the probabilities of all elements.

    The margin is 0 at a point at which summits touch under a voltage, and infinite if no element with a
    breakdown voltage has a voltage.
    """

    elements: tuple[ElementChance, ...] = field(kw_only=True)
    deciding: Deciding | None = field(kw_only=True)  # None if one element is the first at almost all points

    @property
    def ranks_inputs(self) -> bool:
        """Whether the shares of the inputs are good enough to recommend a measurement."""
        return self.predicted >= _PREDICTED

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``uncertainty`` of summary.json, SI units."""
        deciding = self.deciding
        return dict(
            plain(
                {
                    **super().summary(),
                    "elements": [_row(each) for each in self.elements],
                    "none_first_probability": max(1.0 - math.fsum(each.first for each in self.elements), 0.0),
                    "deciding_elements": [] if deciding is None else list(deciding.elements),
                    "deciding": [
                        {"key": key, "label": label, "total": total}
                        for key, label, total in (() if deciding is None else deciding.shares)
                    ],
                    "deciding_predicted": None if deciding is None else deciding.predicted,
                }
            )
        )


def _row(chance: ElementChance) -> dict[str, Any]:
    """Row of an element in ``uncertainty.elements``; None for an infinite ratio."""
    ends = zip(("low", "median", "high"), chance.ratios, strict=True)
    return {
        "element": chance.element,
        "breakdown_probability": chance.breakdown,
        "first_probability": chance.first,
        "asperity_contact_probability": chance.touching,
        "conduction_probability": chance.conduction,
        **{f"voltage_ratio_{end}": value if math.isfinite(value) else None for end, value in ends},
    }


@dataclass(frozen=True)
class AxleDesign:
    """Uncertain inputs of an axle as numbers from 0 to 1, the errors of the films last of the computed."""

    case: AxleCase
    computed: tuple[UncertainKey, ...]
    factors: tuple[Change, ...]  # inputs to which all breakdown voltages are proportional
    films: tuple[float, float]  # relative errors of the films of bearings and of meshes
    capacitances: FilmCapacitances  # over the errors of the films
    assumed: Mapping[str, str]  # reasons of usual ranges by their key
    left_out: tuple[str, ...]

    @classmethod
    def of(cls, solution: AxleSolution, films: SolvedFilms | None = None) -> AxleDesign:
        """Design of a solved axle. ``films`` of the atlas or of formulas; by default they are solved."""
        case = solution.case
        quick = case.model_copy(update={"ranges": None, "remedies": (), "measured": None}).quick
        stated = {entry.key: entry for entry in case.ranges or ()}
        usual = {each.change.key: each for each in _usual(case)}
        for key, entry in stated.items():
            value = float(case.value_of(key))
            change = Change(key, label_of(key), value, (entry.low, entry.high))
            known = usual.get(key)
            usual[key] = UncertainKey(change, {} if known is None else known.bearings)
        changes = [*usual.values()]
        left_out = [each.change.key for each in changes if not is_quantity(each.change.key)]
        # If single bearings have strengths, the strength of the axle does not scale all breakdown voltages.
        factored = not any(bearing.discharge is not None for bearing in case.bearing)
        factors = [each for each in changes if factored and proportional_to_strength(each.change.key)]
        errors = tuple(
            max((each.film_error for each in solution.elements if each.kind == kind), default=0.0)
            for kind in ("bearing", "mesh")
        )
        return cls(
            quick,
            tuple(each for each in changes if is_quantity(each.change.key) and each not in factors),
            tuple(each.change for each in factors),
            (errors[0], errors[1]),
            FilmCapacitances.of(films or solve_films(quick), (errors[0], errors[1])),
            {each.change.key: each.change.reason for each in changes if each.change.key not in stated},
            tuple(f"{key}: its range has no part in the probability" for key in left_out),
        )

    @property
    def number(self) -> int:
        """Number of columns for which margins are computed."""
        return len(self.computed) + 2

    @property
    def width(self) -> int:
        """Number of uncertain inputs, with the films."""
        return self.number + len(self.factors)

    def log_factors(self, at: Array) -> Array:
        """Logarithms of the factors on the margin at points from 0 to 1, shape (n, width - number)."""
        ends = [(change.ends, change.value) for change in self.factors]
        return logs_of_factors(ends, at[:, self.number : self.width])

    def names(self) -> Iterator[Names]:
        """Names of the uncertain inputs, in the order of the columns."""
        yield from (Names.of(each.change, self.assumed) for each in self.computed)
        for (elements, key), error in zip(FILMS_OF.items(), self.films, strict=True):
            label, reason = f"films of {elements}", "largest stated error of the films"
            yield Names(key, label, 1.0 - error, 1.0 + error, assumed=True, reason=reason)
        yield from (Names.of(change, self.assumed) for change in self.factors)

    def changed(self, row: Array, at: Mapping[str, float] = _HERE) -> tuple[AxleCase, FilmScales]:
        """Changed case and scales of its films at a point from 0 to 1, shape (width,).

        ``at``, inputs of an operating point by key, SI units, by default the point of the case.
        """
        keys: dict[str, float] = {}
        bearings: dict[int, dict[str, float]] = {}
        summits, area = 0.0, 1.0
        for part, each in zip(row.tolist(), self.computed, strict=False):
            value = each.value(part)
            if each.change.key == SUMMITS:
                summits = value - each.change.value
            elif each.change.key == AREA:
                area = value / each.change.value
            elif each.bearings:
                for number, values in each.values(value).items():
                    bearings.setdefault(number, {}).update(values)
            else:
                keys[each.change.key] = value
        for key, given in at.items():
            nominal = float(self.case.value_of(key))
            keys[key] = float(at_point(key, given, keys[key], nominal)) if key in keys else given
        case = changed_axle(self.case, keys)
        if bearings:
            case = changed_bearings(case, bearings)
        of_bearings, of_meshes = self.factors_on_films(row).tolist()
        return case, FilmScales(of_bearings, of_meshes, summits, area)

    def factors_on_films(self, at: Array) -> Array:
        """Factors on the films of bearings and of meshes at points from 0 to 1, shape (..., width) ->
        (..., 2).
        """
        factors: Array = 1.0 + np.array(self.films) * (2.0 * at[..., len(self.computed) : self.number] - 1.0)
        return factors

    def solutions(self, at: Array, point: Mapping[str, float] = _HERE) -> list[AxleSolution | None]:
        """Solutions of axles at points from 0 to 1, shape (n, width), with the inputs of an operating point;
        None of an axle without a solution.
        """
        changed: dict[int, tuple[AxleCase, FilmScales]] = {}
        for place, row in enumerate(at):
            with suppress(InputError):
                changed[place] = self.changed(row, point)
        cases, scales = (
            (list(column) for column in zip(*changed.values(), strict=True)) if changed else ([], [])
        )
        solved = dict(zip(changed, solve_axles(cases, scales=scales), strict=True))
        factors = self.factors_on_films(at)
        return [
            self._scaled(outcome, factors[place])
            if isinstance(outcome := solved.get(place), AxleSolution)
            else None
            for place in range(len(at))
        ]

    def _scaled(self, solution: AxleSolution, factors: Array) -> AxleSolution:
        """Solution with the capacitances of films that are ``factors`` times as thick."""
        return replace(solution, elements=tuple(self.capacitances.scaled(solution.elements, factors)))


def _usual(case: AxleCase) -> Iterator[UncertainKey]:
    """Usual changes: strength, temperature, grade of the oil, torque, clearances, summits, reference area of
    meshes, and capacitances of the machine.
    """
    for change in strength_changes(case.to_dict()):
        yield UncertainKey(change)
    yield UncertainKey(temperature_change("drive.temperature", case.drive.temperature))
    for change in grade_changes(case.lubricant):
        yield UncertainKey(change)
    torque = load_change("drive.torque", abs(case.drive.torque))
    if case.drive.torque < 0.0:
        low, high = torque.ends
        torque = Change(torque.key, torque.label, case.drive.torque, (-high, -low), torque.reason)
    yield UncertainKey(torque)
    for shaft in case.shaft:
        yield from (*_of_oils(case, shaft.name), *_clearances(case, shaft.name))
    yield from _summits(case)
    pairs = [mesh.pair.gear for mesh in case.mesh]
    heights = [gear.summit_height for gear in pairs]
    if heights and min(heights) > 0.0:
        yield from (UncertainKey(change) for change in summit_changes(SUMMITS, heights[0]))
    for mesh in case.mesh[:1]:
        if any(gear.contact.conduction == "by-film" for gear in pairs):
            area = reference_area_of(mesh.pair)
            ends = area / AREA_FACTOR, area * AREA_FACTOR
            yield UncertainKey(Change(AREA, "reference area of the share of time", area, ends, _OF_AREA))
    for name, value in case.circuit.capacitances.items():
        key = f"circuit.{name}"
        if name in ("winding_rotor_capacitance", "rotor_frame_capacitance") and value > 0.0:
            ends = ((1.0 - MOTOR) * value, (1.0 + MOTOR) * value)
            yield UncertainKey(Change(key, label_of(key), value, ends, _OF_MOTOR))


def _of_oils(case: AxleCase, shaft: str) -> Iterator[UncertainKey]:
    """Changes of strengths and grades in the oils that bearings of a shaft do not share with the axle."""
    changed: dict[str, dict[int, Change]] = {}
    for number in case.bearings_of(shaft):
        mounted = case.bearing[number]
        discharge, oil = mounted.discharge, mounted.lubricant
        tables = {} if discharge is None else {"discharge": discharge.model_dump(exclude_none=True)}
        for change in (*strength_changes(tables), *(() if oil is None else grade_changes(oil))):
            changed.setdefault(change.key, {})[number] = change
    for key, changes in changed.items():
        first = next(iter(changes.values()))
        values = {number: {key: change.value} for number, change in changes.items()}
        named = replace(first, key=f"bearing.{shaft}.{key}", label=f"{first.label}, bearings of {shaft}")
        yield UncertainKey(named, values)


def _clearances(case: AxleCase, shaft: str) -> Iterator[UncertainKey]:
    """Change of the clearances of both bearings of a shaft by one step."""
    changes = {
        number: change
        for number in case.bearings_of(shaft)
        for change in clearance_change(case.tables_of_bearings[number])
    }
    if not changes:
        return
    first = next(iter(changes.values()))
    name = first.key.removeprefix("bearing.")
    values = {
        number: {change.key.removeprefix("bearing."): change.value} for number, change in changes.items()
    }
    key = f"bearing.{shaft}.{name}"
    label = f"{first.label.partition(' (')[0]}, bearings of {shaft}"
    yield UncertainKey(Change(key, label, first.value, first.ends, first.reason), values)


def _summits(case: AxleCase) -> Iterator[UncertainKey]:
    """Change of the height of the summits of all bearings by one step."""
    heights = {number: table.summit_height for number, table in enumerate(case.tables_of_bearings)}
    values = {number: {"summit_height": height} for number, height in heights.items() if height > 0.0}
    for change in summit_changes("bearings.summit_height", min(heights.values(), default=0.0)):
        yield UncertainKey(change, values)


def has_chance(case: AxleCase) -> bool:
    """Whether the elements of an axle have a probability of breakdown: the oil has a strength."""
    return case.has_strength


@dataclass
class _Rows:
    """Voltages and breakdown voltages of all elements at the points of a design, shape (n, elements)."""

    names: tuple[str, ...]
    voltages: list[Array] = field(default_factory=list)
    # Breakdown voltages, as the limits of ``voltage_ratios``.
    limits: list[Array] = field(default_factory=list)
    conducting: list[Array] = field(default_factory=list)
    touching: list[Array] = field(default_factory=list)  # summits touch, and the element does not conduct

    def add(self, solution: AxleSolution | None) -> None:
        """Add a point; NaN without a solution."""
        count = len(self.names)
        if solution is None:
            self.voltages.append(np.full(count, np.nan))
            self.limits.append(np.full(count, np.nan))
            self.conducting.append(np.zeros(count, dtype=bool))
            self.touching.append(np.zeros(count, dtype=bool))
            return
        voltages, limits = solution.voltages_and_limits()
        self.voltages.append(voltages)
        self.limits.append(limits)
        conducting = np.array([each.state == CONDUCTS for each in solution.elements])
        self.conducting.append(conducting)
        self.touching.append(np.array([each.touching for each in solution.elements]) & ~conducting)

    def margins(self) -> Array:
        """Margin of the first element at the points, shape (n,)."""
        return least_margins(np.array(self.voltages), np.array(self.limits))


def least_margins(voltages: Array, limits: Array) -> Array:
    """Margin of the first element, shape (n,), from voltages and breakdown voltages, shape (n, elements);
    NaN without a voltage.
    """
    ratios = np.max(np.nan_to_num(voltage_ratios(voltages, limits), nan=0.0, posinf=np.inf), axis=1)
    with np.errstate(divide="ignore"):
        margins = np.where(ratios > 0.0, 1.0 / ratios, MOST_MARGIN)
    return np.where(np.any(np.isnan(voltages), axis=1), np.nan, margins)


def uncertainty_of(
    solution: AxleSolution, *, stages: Sequence[int] = STAGES, seed: int = SEED
) -> AxleUncertainty:
    """Margin of the first element, and probabilities of all elements, within the uncertain inputs.

    Ranges are the ranges of the file, and usual ranges for all other inputs. Films at other inputs are from
    the atlas or from formulas. ``stages``, numbers of points of the design, which is refined as for bearings.
    Raises InputError where no point has a result.
    """
    design = AxleDesign.of(solution)
    rows = _Rows(tuple(each.name for each in solution.elements))

    at = sobol_points(design.width, stages[-1], seed)
    for count in stages:
        before = len(rows.voltages)
        _add(rows, design, at[before:count])
        spread = spread_at(design, rows.margins(), at[:count], seed)
        inputs, predicted = _inputs(design, at[:count], rows.margins())
        if spread.chance.is_settled(touching=False) and predicted >= _PREDICTED:
            break
    at = at[: len(rows.voltages)]
    strength = np.exp(np.sum(design.log_factors(at), axis=-1))
    voltages, limits = np.array(rows.voltages), times_strength(np.array(rows.limits), strength[:, np.newaxis])
    solved = np.all(np.isfinite(voltages), axis=1)
    states = np.array(rows.conducting)[solved], np.array(rows.touching)[solved]
    first = firsts(voltages[solved], limits[solved])
    elements = tuple(_chances(rows.names, voltages[solved], limits[solved], states, first))
    deciding = _deciding(design, at[solved], voltages[solved], limits[solved], elements)
    known = {each.name: getattr(spread, each.name) for each in fields(spread)}
    known |= {"inputs": inputs, "predicted": predicted}
    return AxleUncertainty(**known, elements=elements, deciding=deciding)


def _inputs(design: AxleDesign, at: Array, computed: Array) -> tuple[tuple[UncertainInput, ...], float]:
    """Uncertain inputs with their shares of the variance of r/(1 + r), the largest first, and the share of
    this variance that is predicted. ``computed``, margins without the factors, NaN without a result.
    """
    known = np.isfinite(computed)
    margins = computed[known] * np.exp(np.sum(design.log_factors(at[known]), axis=-1))
    shares = variance_shares(2.0 * at[known] - 1.0, 1.0 / (1.0 + margins))
    inputs = [
        UncertainInput(**vars(names), first_order=float(first), total=float(total))
        for names, first, total in zip(design.names(), shares.first, shares.total, strict=True)
    ]
    return tuple(sorted(inputs, key=lambda each: -each.total)), float(shares.predicted)


def _add(rows: _Rows, design: AxleDesign, at: Array) -> None:
    """Add the solutions of axles at points from 0 to 1, shape (n, width)."""
    for outcome in design.solutions(at):
        rows.add(outcome)


def _chances(
    names: Sequence[str], voltages: Array, limits: Array, states: tuple[Array, Array], first: IntArray
) -> Iterator[ElementChance]:
    """Probabilities of all elements; ``states``, whether they conduct, and whether their summits touch."""
    conducting, touching = states
    ratios = voltage_ratios(voltages, limits)
    for number, name in enumerate(names):
        low, median, high = np.quantile(ratios[:, number], INTERVAL, method="higher").tolist()
        yield ElementChance(
            name,
            float(np.mean(ratios[:, number] >= 1.0)),
            float(np.mean(first == number)),
            float(np.mean(touching[:, number])),
            float(np.mean(conducting[:, number])),
            (low, median, high),
        )


def _deciding(
    design: AxleDesign, at: Array, voltages: Array, limits: Array, elements: Sequence[ElementChance]
) -> Deciding | None:
    """Inputs that decide which of the two elements that are most often the first is the first."""
    order = sorted(range(len(elements)), key=lambda number: -elements[number].first)
    if len(order) < 2 or not elements[order[1]].first:
        return None
    both = order[:2]
    (first, second), (low, high) = voltages[:, both].T, limits[:, both].T
    # (r_A - r_B)/(r_A + r_B) times both breakdown voltages.
    with np.errstate(invalid="ignore"):
        ratios = first * high, second * low
        difference = (ratios[0] - ratios[1]) / (ratios[0] + ratios[1])
    known = np.isfinite(difference)
    if np.mean(known) < _LEAST_COMPARED or not np.ptp(difference[known]):
        return None
    shares = variance_shares(2.0 * at[known, : design.number] - 1.0, difference[known])
    rows = [
        (names.key, names.label, float(total))
        for names, total in zip(design.names(), shares.total, strict=False)
        if total >= _LEAST_SHARE
    ]
    return Deciding(
        (elements[both[0]].element, elements[both[1]].element),
        tuple(sorted(rows, key=lambda row: -row[2])),
        float(shares.predicted),
    )
