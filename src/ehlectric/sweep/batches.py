"""Batches of the points of a sweep: bearings, gear pairs and axles with estimated films, solved together."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle import AxleResult, solve_axles
from ehlectric.bearing import (
    SEED,
    SUMMARY_SCHEMA,
    TOGETHER,
    SolvedPart,
    codes_of,
    is_quick,
    single_tables,
    solved_parts,
    spreads_of,
    tables_of_spread,
    warnings_of_spread,
)
from ehlectric.cases.axle_case import AxleCase, changed_axle
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.gear_case import GearCase, changed_pair
from ehlectric.cases.solved_case import SolvedCase, model_of
from ehlectric.cases.table import by_table
from ehlectric.gear import GearResult, solve_gear_pairs
from ehlectric.quantities.result_warnings import CODES, CODES_OF_TEXTS, TEXTS
from ehlectric.runtime.files import now
from ehlectric.runtime.tasks import finished_tasks
from ehlectric.runtime.worker_processes import Crew
from ehlectric.sweep.engine import Outcome, Task, planned_point, solve_point
from ehlectric.sweep.point_groups import Inputs, groups_of
from ehlectric.sweep.sweep_inputs import Sweep
from ehlectric.version import __version__


@dataclass(frozen=True)
class Batch:
    """Points that differ in quantities only, as plain data that any process takes."""

    keys: tuple[str, ...]  # keys of their cases, from ``case_key``
    table: Mapping[str, Any]  # tables of the case of one of the points
    values: Mapping[str, Array]  # numbers of the quantities, by dotted key, in SI units, shape (n,)
    uncertainty_samples: int | None = None  # samples of the probability of breakdown of each point, if any

    def changes(self) -> Iterator[dict[str, float]]:
        """Numbers of the quantities of each point, by dotted key."""
        for place in range(len(self.keys)):
            yield {key: float(column[place]) for key, column in self.values.items()}

    def table_of(self, place: int) -> dict[str, Any]:
        """Tables of the case of a point."""
        values = {key: float(column[place]) for key, column in self.values.items()}
        if model_of(self.table) is AxleCase:
            # Keys of an axle name shafts and numbers of meshes.
            return AxleCase.from_dict(self.table).replace(values).to_dict()
        return {**_with_values(self.table, values)}

    def tasks(self) -> Iterator[Task]:
        """Points one by one, each with its key and the tables of its case."""
        for place, key in enumerate(self.keys):
            yield key, self.table_of(place)


def _with_values(table: Any, values: Mapping[str, Any]) -> Any:
    """Nested tables with values of dotted keys; tables that do not change are those that were given.

    The last part of a key is the number of a gear, from 1, where a list has a value for each gear.
    """
    if isinstance(table, list):
        return [values.get(str(number), each) for number, each in enumerate(table, 1)]
    direct, within = by_table(values)
    return {
        **table,
        **direct,
        **{name: _with_values(table.get(name, {}), deep) for name, deep in within.items()},
    }


def batches_of(
    sweep: Sweep, points: Sequence[tuple[str, Inputs]]
) -> tuple[list[Batch], list[tuple[str, Inputs]]]:
    """Batches of points, given with the keys of their cases and their inputs, and the points in no batch.

    Only bearings, gear pairs and axles with estimated films are solved in batches. Each batch has points from
    the whole range of its group, in random order: the same interpolation tables of the gaps around the films
    then serve all batches.
    """
    batches, others = [], list[tuple[str, Inputs]]()
    samples = sweep.uncertainty_samples
    together = TOGETHER if samples is None else max(1, _SAMPLES_TOGETHER // samples)
    if not isinstance(sweep.case, BearingCase | GearCase | AxleCase):
        return [], list(points)
    for group in groups_of(sweep, (inputs for _, inputs in points)):
        case = sweep.case.replace(group.inputs[0])
        count = len(group.places)
        if count < 2 or not group.quantities or not _is_quick(case):
            others += [points[place] for place in group.places]
            continue
        columns = {key: np.array([inputs[key] for inputs in group.inputs]) for key in group.quantities}
        order = np.random.default_rng(0).permutation(count)
        for some in np.array_split(order, -(-count // together)):
            keys = tuple(points[group.places[k]][0] for k in some)
            values = {key: column[some] for key, column in columns.items()}
            batches.append(Batch(keys, case.to_dict(), values, samples))
    return batches, others


def _is_quick(case: SolvedCase) -> bool:
    """Whether the films of a bearing, a gear pair or an axle are not solved."""
    if isinstance(case, AxleCase):
        return not case.solves_films
    if isinstance(case, GearCase):
        return case.contacts != "solved"
    return isinstance(case, BearingCase) and is_quick(case)


# Samples of all points of a batch: a few seconds, after which its points are saved.
_SAMPLES_TOGETHER = 8 * TOGETHER


def run_batches(
    batches: Iterable[Batch], crew: Crew, done: Callable[[Sequence[tuple[str, Outcome]]], None]
) -> list[Batch]:
    """Solve batches with a crew. Returns batches whose points have to be solved one by one. Raises LostError
    if the crew cannot be reached any more.
    """
    left: list[Batch] = []
    with closing(finished_tasks(((each, each) for each in batches), crew, solve_batch, _lost)) as finished:
        for some in finished:
            outcomes: list[tuple[str, Outcome]] = []
            for batch, results in some:
                if results is None:
                    left.append(batch)
                else:
                    outcomes += zip(batch.keys, results, strict=True)
            done(outcomes)
    return left


def _lost(_reason: str) -> None:
    """Outcome of a batch whose process died: one of its points may be the cause, which is then found."""


def weight_of(batches: Sequence[Batch]) -> int:
    """Number of points in large batches that take as long as these batches."""
    return sum(len(batch.keys) * (1 + (batch.uncertainty_samples or 0)) + _BEGINNING for batch in batches)


# Points that take as long as the part of the time of a batch that does not depend on their number.
_BEGINNING = 150


def solve_batch(batch: Batch) -> list[Outcome] | None:
    """Outcomes of the points of a batch, in any process; None where they have to be solved one by one.

    Points without a result are solved one by one here, for the reason.
    """
    of_tables = _SUMMARIES.get(model_of(batch.table))
    if of_tables is not None:
        return _outcomes(batch, of_tables)
    started = time.perf_counter()
    try:
        case = BearingCase.from_dict(batch.table).with_arrays(batch.values)
        summaries: dict[int, dict[str, Any]] = {}
        for part in solved_parts(case):
            summaries |= zip(part.points.tolist(), _summaries(batch, part), strict=True)
    except Exception:
        # Alone, each point has its own reason.
        return None
    each = (time.perf_counter() - started) / len(batch.keys)
    date = now()
    return [
        Outcome(
            "solved",
            "",
            summary=summaries[place] | {"seconds": each},
            seconds=each,
            version=__version__,
            date=date,
        )
        if place in summaries
        else solve_point(batch.table_of(place), batch.uncertainty_samples)
        for place in range(len(batch.keys))
    ]


# Summary of a point, or the error of a point without a result.
_Summary = dict[str, Any] | Exception


def _gear_summaries(batch: Batch) -> Iterator[_Summary]:
    """Summaries of the gear pairs of a batch."""
    first = GearCase.from_dict(batch.table)
    for solution in solve_gear_pairs([changed_pair(first, values) for values in batch.changes()]):
        if isinstance(solution, Exception):
            yield solution
        else:
            yield GearResult(solution, probable=False).summary()


def _axle_summaries(batch: Batch) -> Iterator[_Summary]:
    """Summaries of the axles of a batch."""
    first = AxleCase.from_dict(batch.table)
    for solution in solve_axles([changed_axle(first, values) for values in batch.changes()]):
        yield (
            solution
            if isinstance(solution, Exception)
            else AxleResult(solution, probable=False).point_summary()
        )


# Summaries of the points of a batch that are solved together, by the class of its case.
_SUMMARIES: Mapping[type[Any] | None, Callable[[Batch], Iterator[_Summary]]] = {
    AxleCase: _axle_summaries,
    GearCase: _gear_summaries,
}


def _outcomes(batch: Batch, summaries: Callable[[Batch], Iterator[_Summary]]) -> list[Outcome] | None:
    """Outcomes of the gear pairs or axles of a batch; None where they have to be solved one by one."""
    started = time.perf_counter()
    try:
        results = list(summaries(batch))
    except Exception:
        # Alone, each point has its own reason.
        return None
    each = (time.perf_counter() - started) / len(batch.keys)
    about: dict[str, Any] = {"seconds": each, "version": __version__, "date": now()}
    return [
        solve_point(batch.table_of(place))
        if isinstance(result, Exception)
        else Outcome("solved", "", summary=result | {"seconds": each}, **about)
        for place, result in enumerate(results)
    ]


def seconds_of(sweep: Sweep) -> float | None:
    """Estimate the time on one core [s] for a sweep over bearings with estimated contacts, from some of its
    points.

    None where these points are no valid cases.
    """
    tried = _TRIED if sweep.uncertainty_samples is None else _UNCERTAIN_TRIED
    every = max(1, sweep.size // tried)
    some = islice(enumerate(sweep.points()), 0, tried * every, every)
    points = [point for point in (planned_point(sweep, *each) for each in some) if point.key is not None]
    if not points:
        return None
    places = groups_of(sweep, (point.inputs for point in points))[0].places
    batches, others = batches_of(sweep, [(str(place), points[place].inputs) for place in places])
    tables = [sweep.case.replace(inputs).to_dict() for _, inputs in others]
    # The first time, interpolation tables are made that later batches use.
    for _ in range(2):
        begun = time.perf_counter()
        for batch in batches:
            solve_batch(batch)
        for table in tables:
            solve_point(table, sweep.uncertainty_samples)
        seconds = time.perf_counter() - begun
    return seconds / len(places) * sweep.size


# Most points that are tried for an estimate, and where each has the probability of its breakdown.
_TRIED, _UNCERTAIN_TRIED = 256, 8


def _summaries(batch: Batch, part: SolvedPart) -> Iterator[dict[str, Any]]:
    """Summaries of points that were solved together, nested as in summary.json, without their time.

    The text of a warning is the meaning of its code: the text of a single bearing names numbers and contacts.
    """
    count, solution = part.points.size, part.solution
    codes: list[dict[str, str]] = [{} for _ in range(count)]
    for code, where in codes_of(solution):
        for place in np.flatnonzero(np.broadcast_to(where, count)).tolist():
            codes[place][code] = CODES[code].meaning
    samples, probable = batch.uncertainty_samples, list[dict[str, Any]]()
    if samples is not None:
        spreads = spreads_of(solution, samples, SEED)
        probable = [tables_of_spread(spread) for spread in spreads]
        for of_point, spread in zip(codes, spreads, strict=True):
            of_point |= {warning.code: CODES[warning.code].meaning for warning in warnings_of_spread(spread)}
    for place, (point, tables) in enumerate(zip(part.points.tolist(), single_tables(part), strict=True)):
        yield {
            "schema": SUMMARY_SCHEMA,
            "version": solution.version,
            "title": solution.case.title,
            "converged": True,
            TEXTS: list(codes[place].values()),
            CODES_OF_TEXTS: list(codes[place]),
            "inputs": batch.table_of(point),
            **tables,
            **(probable[place] if probable else {}),
        }
