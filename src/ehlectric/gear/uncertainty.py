"""Probability that a gear mesh breaks down: its margin over the uncertainty of its inputs and its films."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, replace
from functools import partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import (
    FILMS,
    SEED,
    STAGES,
    Change,
    Names,
    Uncertainty,
    grade_changes,
    load_change,
    logs_of_factors,
    proportional_to_strength,
    refined,
    stated_change,
    strength_changes,
    summit_changes,
    temperature_change,
)
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import is_quantity
from ehlectric.discharge.breakdown_rule import INTERVAL, Chance
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.errors import InputError
from ehlectric.gear.gear_verdict import state_at
from ehlectric.gear.solution import (
    AREA_FACTOR,
    GearSolution,
    open_area,
    reference_area_of,
    strength_of,
)
from ehlectric.gear.solving import capacitances_over_films, solve_gear_pair, solve_gear_pairs
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.runtime.display import read_only_property
from ehlectric.runtime.files import plain

# Inputs on which films and capacitance do not depend, by the start of their keys.
_NOT_IN_FILMS = (
    "gear.flank_ra",
    "gear.composite_rq",
    "gear.rq_over_ra",
    "gear.summit_height",
    "gear.contact.",
    "discharge.",
)

_AREA = "gear.contact.reference_area"

# Share of the points with a breakdown voltage below which the inputs have no shares of the spread: the
# variance of so few margins is not the variance of the distribution (engineering judgement).
_LEAST_WITH_MARGIN = 0.05
_OF_AREA = "engineering judgement: the area of the measurement is known to a factor of 3"

# Reason for which a mesh has no distribution of its margin.
_CONDUCTS = "the mesh conducts at all points within the ranges of the inputs"


# Numbers of the points that have a result.
_sample = partial(stored, "sample")


@dataclass(frozen=True)
class MeshUncertainty(Uncertainty):
    """Distribution of the margin of a mesh, with its lambda ratio, breakdown voltage and state.

    At a point at which the mesh conducts, no voltage breaks it down, and its margin is infinite.
    """

    # Of all points with a result, shape (n,): lambda ratios, breakdown voltages [V], 0 where summits touch or
    # the mesh conducts, and whether it conducts.
    lambda_ratios: Array = field(kw_only=True, repr=False, metadata=_sample("", "not negative"))
    voltages: Array = field(kw_only=True, repr=False, metadata=_sample("V", "not negative"))
    conducting: Array = field(kw_only=True, repr=False, metadata=_sample("", "0 or 1"))
    # Mean capacitances over a phase [F].
    capacitances: Array = field(kw_only=True, repr=False, metadata=_sample("F", "not negative"))
    # Largest relative change of the capacitance by the error of the films.
    capacitance_film_error: float = field(kw_only=True, metadata=number())

    @read_only_property
    def chance(self) -> Chance:
        """Probability and interval as a verdict says them."""
        first, chance = self.inputs[0], Chance.of(self.margins, self.failed)
        low, median, high = map(_or_infinite, (chance.low, chance.median, chance.high))
        about = replace(chance, first=first.label, share=first.total, neglected=self.left_out)
        return replace(about, low=low, median=median, high=high)

    @property
    def conduction_probability(self) -> float:
        """Share of the points at which the mesh conducts."""
        return float(np.mean(self.conducting))

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``uncertainty`` of summary.json, SI units. Without margins to spread, the
        inputs have no shares.
        """
        table = super().summary() | {
            "conduction_probability": self.conduction_probability,
            "capacitance_film_error": self.capacitance_film_error,
        }
        for name, values in (
            ("lambda_ratio", self.lambda_ratios),
            ("breakdown_voltage", self.voltages),
            ("capacitance", self.capacitances),
        ):
            ends = np.quantile(values, INTERVAL).tolist()
            table |= {f"{name}_{end}": at for end, at in zip(("low", "median", "high"), ends, strict=True)}
        if np.mean(self.voltages > 0.0) < _LEAST_WITH_MARGIN:
            table |= {"indices": [], "predicted": None}
        return dict(plain(table))


@dataclass(frozen=True)
class Spread:
    """Distribution of the margin of a mesh, or the reason for which it has none."""

    points: MeshUncertainty | None = None
    missing: str = ""

    @classmethod
    def of(cls, solution: GearSolution) -> Spread:
        """Distribution of a solved mesh; without one if the case has no probability of breakdown."""
        if not has_chance(solution.case):
            return cls()
        try:
            return cls(uncertainty_of(solution))
        except InputError as error:
            return cls(missing=str(error))


def _or_infinite(margin: float) -> float:
    """Margin, infinite if it is a margin of meshes that conduct, or between such a margin and another one."""
    return math.inf if margin > _FINITE else margin


# Largest margin of meshes that do not conduct.
_FINITE = 1e-3 * MOST_MARGIN


@dataclass(frozen=True)
class MeshDesign:
    """Uncertain inputs of a gear pair as numbers from 0 to 1, the error of the films last of the computed."""

    case: GearCase
    computed: tuple[Change, ...]
    factors: tuple[Change, ...]  # inputs to which the margin is proportional
    films: tuple[float, float]  # ends of the factor on all films by their error
    assumed: Mapping[str, str]  # reasons of usual ranges by their key
    left_out: tuple[str, ...]

    @classmethod
    def of(cls, solution: GearSolution) -> MeshDesign:
        """Design of a solved gear pair."""
        case, off = solution.case, solution.film_error
        changes = changes_of(case)
        stated = {entry.key for entry in case.ranges or ()}
        factors = [change for change in changes if proportional_to_strength(change.key)]
        others = [change for change in changes if not proportional_to_strength(change.key)]
        left_out = [change.key for change in others if not is_quantity(change.key)]
        return cls(
            case,
            tuple(change for change in others if is_quantity(change.key)),
            tuple(factors),
            (1.0 / (1.0 + off), 1.0 + off) if case.contacts == "formula" else (1.0 - off, 1.0 + off),
            {change.key: change.reason for change in changes if change.key not in stated},
            tuple(f"{key}: its range has no part in the probability" for key in left_out),
        )

    @property
    def number(self) -> int:
        """Number of columns for which margins are computed."""
        return len(self.computed) + 1

    @property
    def width(self) -> int:
        """Number of uncertain inputs, with the films."""
        return self.number + len(self.factors)

    def changed(self, at: Array) -> Iterator[tuple[dict[str, Any], float]]:
        """Changes of the case, and the factor on its films, at points from 0 to 1, shape (n, width)."""
        low, high = self.films
        for row in at:
            changes: dict[str, Any] = {}
            for part, change in zip(row.tolist(), self.computed, strict=False):
                changes |= change.changes(value_within(change, part))
            yield changes, low + (high - low) * float(row[len(self.computed)])

    def log_factors(self, at: Array) -> Array:
        """Logarithms of the factors on the margin at points from 0 to 1, shape (n, width - number)."""
        ends = [(change.ends, change.value) for change in self.factors]
        return logs_of_factors(ends, at[:, self.number : self.width])

    def names(self) -> Iterator[Names]:
        """Names of the uncertain inputs, in the order of the columns."""
        yield from (Names.of(change, self.assumed) for change in self.computed)
        by = {"atlas": "stated error of the atlas", "formula": "stated error of the formula"}
        reason = by.get(self.case.contacts, "estimated error of the solved films")
        yield Names(FILMS, "films", *self.films, assumed=True, reason=reason)
        yield from (Names.of(change, self.assumed) for change in self.factors)


def value_within(change: Change, part: float) -> float:
    """Value of an input at a part of its range; the logarithm of the reference area is evenly distributed."""
    low, high = change.ends
    return low * (high / low) ** part if change.key == _AREA else low + (high - low) * part


def changes_of(case: GearCase) -> tuple[Change, ...]:
    """Changes of all inputs that are uncertain, each once: a range of the file replaces the usual one."""
    table = case.to_dict()
    changes = {change.key: change for change in _usual_changes(case, table)}
    for entry in case.ranges or ():
        changes[entry.key] = stated_change(table, entry)
    return tuple(changes.values())


def _usual_changes(case: GearCase, table: Mapping[str, Any]) -> Iterator[Change]:
    """Changes of strength, temperature, grade of the oil, torque, summits, and reference area."""
    operation = case.gear.operation
    yield from strength_changes(table)
    bulk, oil = "gear.operation.bulk_temperature", "gear.operation.oil_temperature"
    given = operation.bulk_temperature
    yield (
        temperature_change(oil, operation.oil_temperature)
        if isinstance(given, str)
        else temperature_change(bulk, given)
    )
    yield from grade_changes(case.lubricant)
    yield load_change("gear.operation.pinion_torque", operation.pinion_torque)
    yield from summit_changes("gear.summit_height", case.gear.summit_height)
    if case.gear.contact.conduction == "by-film":
        area = reference_area_of(case)
        ends = area / AREA_FACTOR, area * AREA_FACTOR
        yield Change(_AREA, "reference area of the share of time", area, ends, _OF_AREA)


def has_chance(case: GearCase) -> bool:
    """Whether a mesh has a probability of breakdown: a strength, and a voltage that it does not short."""
    contact = case.gear.contact
    return case.discharge.has_strength and contact.voltage is not None and contact.conduction != "always"


def uncertainty_of(
    solution: GearSolution, *, samples: int | None = None, seed: int = SEED
) -> MeshUncertainty:
    """Distribution of the margin of a solved mesh over its uncertain inputs.

    Ranges are the ranges of the file, and usual ranges for all other inputs. Films at other inputs are from
    the atlas or from formulas, and scaled to the films of the solution. By default the design is refined as
    for bearings; ``samples``, number of points, a power of 2. Raises InputError where no point has a result,
    or where the mesh conducts at all points.
    """
    design = MeshDesign.of(solution)
    meshes = Meshes.of(solution, design.films)
    rows: list[Array] = []

    def computed(at: Array) -> Array:
        rows.append(meshes.rows(list(design.changed(at))))
        return rows[-1][:, 0]

    touching = not np.any(np.nanmin(solution.gap) > 0.0)
    stages = STAGES if samples is None else (samples,)
    uncertainty, _, at = refined(design, computed, stages=stages, seed=seed, touching=touching)
    table = np.concatenate(rows)
    solved = ~np.isnan(table[:, 0])
    conducting = table[:, 3] == 1.0
    if np.all(conducting[solved]):
        raise InputError.worded(None, _CONDUCTS)
    factors = np.exp(np.sum(design.log_factors(at[: len(table)]), axis=-1))
    values = {each.name: getattr(uncertainty, each.name) for each in fields(uncertainty)}
    return MeshUncertainty(
        **values,
        lambda_ratios=table[solved, 1],
        voltages=(table[:, 2] * factors)[solved],
        conducting=conducting[solved],
        capacitances=table[solved, 5],
        capacitance_film_error=meshes.capacitance_error,
    )


def chance_of(solution: GearSolution, samples: int) -> tuple[float, float, float] | None:
    """Probability of breakdown of a solved mesh within its uncertain inputs, and its bounds.

    It is 0 for a mesh that conducts at all points, and None where no point has a result. ``samples``, number
    of points, a power of 2.
    """
    try:
        uncertainty = uncertainty_of(solution, samples=samples)
    except InputError as error:
        return (0.0, 0.0, 0.0) if error.text == _CONDUCTS else None
    return uncertainty.probability, *uncertainty.bounds


@dataclass(frozen=True)
class Meshes:
    """Meshes of a gear pair at changed inputs, with tabulated films."""

    case: GearCase  # case without solved films
    mesh: GearSolution  # solution of the case
    scale: float  # smallest film of the solution divided by the smallest film of the case
    # Logarithms of factors on all films, and of the capacitance of the case with them, divided by the
    # capacitance without a factor; the first and the last factor are the ends of the error of the films.
    log_factors: Array
    log_capacitances: Array

    @classmethod
    def of(cls, solution: GearSolution, films: tuple[float, float]) -> Meshes:
        """Meshes around a solution; ``films``, ends of the factor on all films by their error."""
        case, atlas, scale = solution.case.model_copy(update={"ranges": None, "duty": None}), solution, 1.0
        if case.contacts == "solved":
            case = case.replace({"contacts": "atlas"})
            atlas = solve_gear_pair(case)
            scale = float(np.nanmin(solution.films.minimum) / np.nanmin(atlas.films.minimum))
        factors = scale * np.linspace(*films, _FILM_FACTORS)
        capacitances = capacitances_over_films(atlas, np.append(factors, 1.0))
        return cls(case, atlas, scale, np.log(factors), np.log(capacitances[:-1] / capacitances[-1]))

    @property
    def capacitance_error(self) -> float:
        """Largest relative change of the capacitance by the error of the films."""
        middle = np.interp(math.log(self.scale), self.log_factors, self.log_capacitances)
        return float(np.max(np.abs(np.expm1(self.log_capacitances[[0, -1]] - middle))))

    def _numbers(self, case: GearCase, mesh: GearSolution, factor: float) -> tuple[float, ...]:
        """Numbers of a mesh with films ``factor`` times as thick as the films of the solution."""
        factor *= self.scale
        ratio = math.exp(float(np.interp(math.log(factor), self.log_factors, self.log_capacitances)))
        return *_numbers(case, mesh, factor), ratio * mesh.loads.mean(mesh.capacitance)

    def rows(self, changed: Sequence[tuple[Mapping[str, Any], float]]) -> Array:
        """Margin, lambda ratio, breakdown voltage [V], whether the mesh conducts, share of time in which it
        does, and mean capacitance [F].

        They are at changed inputs and factors on the films, shape (n, 6), and NaN where a pair has no result.
        Margin and breakdown voltage are NaN without a voltage or a strength.
        """
        rows, cases = np.full((len(changed), 6), math.nan), dict(self._cases(changed))
        same = [k for k in cases if all(key.startswith(_NOT_IN_FILMS) for key in changed[k][0])]
        others = sorted(cases.keys() - set(same))
        for k in same:
            rows[k] = self._numbers(cases[k], self.mesh, changed[k][1])
        meshes = solve_gear_pairs((cases[k] for k in others), unloaded=False)
        for k, mesh in zip(others, meshes, strict=True):
            if isinstance(mesh, GearSolution):
                rows[k] = self._numbers(cases[k], mesh, changed[k][1])
        return rows

    def _cases(self, changed: Sequence[tuple[Mapping[str, Any], float]]) -> Iterator[tuple[int, GearCase]]:
        """Changed cases that are valid, with their places."""
        for k, (changes, _) in enumerate(changed):
            with suppress(InputError):
                yield k, self.case.replace(changes)


# Factors on the films at which the capacitance is computed.
_FILM_FACTORS = 5


def _numbers(case: GearCase, mesh: GearSolution, factor: float) -> tuple[float, float, float, float, float]:
    """Margin, lambda ratio, breakdown voltage [V], whether the mesh conducts, and the share of time in which
    it does, with films ``factor`` times as thick.
    """
    loads, films = mesh.loads, mesh.films
    gear, strength, voltage = case.gear, strength_of(case), case.gear.contact.voltage
    film = factor * float(np.nanmin(films.minimum))
    share = loads.mean(-np.expm1(open_area(loads, films, gear.rq / factor) / reference_area_of(case)))
    conducts = state_at(share, gear.contact.conduction) == CONDUCTS
    breakdown = math.nan if strength is None else strength * max(film - gear.summit_height * gear.rq, 0.0)
    breakdown = 0.0 if conducts else breakdown
    margin = MOST_MARGIN if conducts else breakdown / (voltage or math.nan)
    return margin, film / gear.rq, breakdown, float(conducts), share
