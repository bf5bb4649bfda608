"""Solved contacts in place of quick ones: a table over the film factor that corrects the quick ones."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.arrays import Array
from ehlectric.bearing.measured.forward import FilmState, OperatingPoint
from ehlectric.bearing.measured.inverse import NoFactorError, film_factor_of
from ehlectric.bearing.preparation import with_film_factor
from ehlectric.bearing.solution import BearingSolution
from ehlectric.bearing.solving.contacts_and_circuit import solution_of_prepared
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.runtime.progress import Progress

# Number of bearings that are solved: three, and one more for each factor of two in the capacitance.
_LEAST, _MOST = 3, 6

# Difference of the logarithms of two capacitances below which the later one replaces the earlier.
_SAME = 1e-4


@dataclass(frozen=True, eq=False)
class Correction:
    """Ratio of solved numbers to quick ones, from the atlas or by formula, over the quick capacitance.

    Attributes
    ----------
    logs : ndarray, shape (k,)
        Logarithm of the quick capacitance [F], increasing; empty for quick contacts alone.
    ratios : ndarray, shape (k, 2)
        Logarithm of the ratio solved/quick of capacitance and of lambda ratio.
    solves : int
        Number of contacts that were solved.
    """

    logs: Array
    ratios: Array
    solves: int = 0

    @classmethod
    def none(cls) -> Correction:
        """Correction that leaves quick numbers as they are."""
        return cls(np.zeros(0), np.zeros((0, 2)))

    def of(self, state: FilmState) -> FilmState:
        """State with solved contacts from a quick state; beyond the table its end counts."""
        if not self.logs.size:
            return state
        at = float(np.clip(math.log(state.capacitance), self.logs[0], self.logs[-1]))
        single = self.logs.size == 1
        logs = self.ratios[0] if single else PchipInterpolator(self.logs, self.ratios, axis=0)(at)
        capacity, ratio = np.exp(logs)
        return FilmState(state.capacitance * float(capacity), state.lambda_ratio * float(ratio))

    def extended(self, formula: FilmState, solution: BearingSolution) -> Correction:
        """Correction with one more solved bearing, whose quick state is known."""
        own = FilmState.of(solution)
        log = math.log(formula.capacitance)
        ratio = own.capacitance / formula.capacitance, own.lambda_ratio / formula.lambda_ratio
        solves = self.solves + sum(len(curve.solutions) for curve in solution.curves)
        others = np.abs(self.logs - log) > _SAME
        logs = np.append(self.logs[others], log)
        ratios = np.vstack([self.ratios[others], np.log(ratio)])
        order = np.argsort(logs)
        return Correction(logs[order], ratios[order], solves)


def solved_correction(
    case: BearingCase,
    rows: Sequence[Mapping[str, Any]],
    targets: Array,
    progress: Progress,
    workers: int | None = None,
) -> Correction:
    """Solve a bearing at a few measured rows, and compare it with quick contacts.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing.
    rows : sequence of mapping, length n
        Changes of the case that make each row, its speed [rad/s] and temperature [K].
    targets : ndarray, shape (n,)
        Measured capacitances without background [F]; those that are not positive do not count.
    progress : callable
        Called with the number of solved contacts, of all contacts of a bearing, and a text.
    workers : int, optional
        Number of processes.

    Returns
    -------
    Correction
        Table of two to six solved bearings.

    Raises
    ------
    InputError
        Where the bearing cannot be solved, or quick contacts reach none of the capacitances.
    ConvergenceError
        Where a contact does not converge.

    Notes
    -----
    Each bearing is solved at the speed of a row, with the film factor that explains it by quick contacts
    and the table so far. Between these rows the ratio solved/quick depends on the film, of which the
    capacitance is the measure, and hardly on the speed.
    """
    correction, places = Correction.none(), _spread(targets)
    for number, place in enumerate(places, 1):
        text = f"solved bearing {number} of {len(places)}"
        point = OperatingPoint.of(case, rows[place])
        try:
            factor = film_factor_of(_capacitance(point, correction), float(targets[place]))
        except NoFactorError:
            continue
        prepared = with_film_factor(point.prepared, factor)
        solution = solution_of_prepared(
            # What is in parallel is taken off the measured values.
            case.replace({**rows[place], "contacts": "solved", "bearing.parallel_capacitance": None}),
            prepared,
            progress=partial(_told, progress, text),
            workers=workers,
        )
        if not solution.converged:
            raise ConvergenceError(f"a contact of the bearing at film factor {factor:.3g}")
        correction = correction.extended(point.at(factor), solution)
    if not correction.logs.size:
        raise InputError("measured", "has no capacitance that films of the atlas or of a formula explain")
    return correction


def _told(progress: Progress, text: str, done: int, of: int, _: str) -> None:
    """Progress of one of several bearings."""
    progress(done, of, text)


def _capacitance(point: OperatingPoint, correction: Correction) -> Callable[[float], float]:
    return lambda factor: correction.of(point.at(factor)).capacitance


def _spread(targets: Array) -> list[int]:
    """Places of rows that are spread over the logarithm of their capacitance; a single one counts twice.

    The second time its film factor is that of the corrected table.
    """
    values, first = np.unique(np.where(targets > 0.0, targets, np.nan), return_index=True)
    known = np.isfinite(values)
    logs, first = np.log(values[known]), first[known]
    number = min(_MOST, _LEAST + int((logs[-1] - logs[0]) / math.log(2.0)))
    wanted = np.linspace(logs[0], logs[-1], number) if len(logs) > number else logs
    places = [int(first[k]) for k in np.unique([int(np.argmin(np.abs(logs - at))) for at in wanted])]
    return places if len(places) > 1 else 2 * places
