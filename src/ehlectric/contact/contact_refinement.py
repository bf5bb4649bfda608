"""Grid of a contact, refined until the error of the film is small enough, and the error that it can reach."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ehlectric.cases.grid_inputs import Grid
from ehlectric.contact.contact_memory import check_grid
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError, within
from ehlectric.film import (
    MINIMUM_ORDER,
    UNKNOWN,
    Film,
    FilmProblem,
    Mesh,
    PointFilm,
    expected_error,
    expected_nodes,
    is_too_fine,
)
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable

# How often the intervals of a grid are doubled at the most, with smooth and with rough surfaces. A film whose
# estimate does not fall, such as one under white noise, would take them up to the memory of the machine.
_MOST_DOUBLED = {"line": 8, "point": 5}
_MOST_DOUBLED_ROUGH = {"line": 3, "point": 2}


@dataclass(frozen=True)
class Refined:
    """Film of the last grid of a refinement, and the setup with this grid."""

    film: Any
    # first and setup: setup with the first grid and with the last one, which have no target.
    first: Setup
    setup: Setup
    warnings: tuple[ResultWarning, ...]  # a warning if the target error was not reached


@dataclass(frozen=True)
class Refinement:
    """Film problem of a contact, and the grids from the first one up to the last one that is allowed."""

    setup: Setup
    first: Setup  # setup with the first grid, which has no target
    problem: FilmProblem
    grids: Sequence[Grid]
    refusal: str  # reason why there is no finer grid

    @classmethod
    def of(cls, setup: Setup, geometry: str, problem_of: Callable[[Setup], FilmProblem]) -> Refinement:
        """Make the refinement of a setup. A grid without a target has only one grid.

        ``problem_of``, function that makes the film problem: setup -> problem.
        """
        target, first = setup.grid.target, replace(setup, grid=_fixed(setup.first_grid))
        problem = problem_of(first)
        if target is None:
            return cls(setup, first, problem, (first.grid,), "")
        grids, refusal = finer_grids(setup, geometry, problem)
        problem = replace(problem, target_error=target, most_nodes=grids[-1].nodes_along)
        return cls(setup, first, problem, grids, refusal)

    def refined(self, film: Film | PointFilm) -> Refined:
        """Film of the last grid, with the setup of this grid, and a warning if the target error was not
        reached.
        """
        target = self.setup.grid.target
        if target is None:
            return Refined(film, self.first, self.first, ())
        closest = (film.x[-1] - film.x[0]) / float(np.min(np.diff(film.x)))
        grid = min(self.grids, key=lambda grid: abs(grid.nodes_along - 1 - closest))
        warnings: tuple[ResultWarning, ...] = ()
        if film.discretisation_error is None or film.discretisation_error > target:
            missed = ResultWarning.of(
                "refine-not-reached",
                key=_target_key(self.setup),
                percent=100 * target,
                nodes=grid.nodes_along,
                reason=self.refusal if grid is self.grids[-1] else _reason(film),
            )
            warnings = (missed,)
        return Refined(film, self.first, replace(self.first, grid=grid), warnings)


def _reason(film: Film | PointFilm) -> str:
    """Reason for the end of a refinement on a grid of which a finer one is allowed."""
    if film.discretisation_error is None:
        return f"the error is unknown on {UNKNOWN} grids in succession"
    if np.any(film.contact):
        return "asperities are in contact, and a finer grid has other contact spots"
    return "no film that conserves its oil was found on the next grid"


def finer_grids(setup: Setup, geometry: str, problem: FilmProblem) -> tuple[list[Grid], str]:
    """Grids of a refinement from the first one up to the last one that is allowed, and why it is the last.
    Returns grids, each with twice as many intervals as the grid before, and the reason why there is no finer
    one. ``problem``, film problem on the first grid.
    """
    physics = problem.physics
    heat = None if physics is None else "sheared" if physics.thermal is None else "thermal"
    if heat is not None and geometry == "point" and setup.inlet is None:
        heat = "patch"
    grids, rough = [_fixed(setup.first_grid)], bool(setup.roughness)
    most = (_MOST_DOUBLED_ROUGH if rough else _MOST_DOUBLED)[geometry]
    while True:
        if len(grids) > most:
            kind = "rough" if rough else "smooth"
            return grids, f"a {kind} contact is refined {most} times at the most; begin with more grid.nodes"
        if is_too_fine(problem, 2 ** len(grids)):
            return grids, "a film with heat or shear takes minutes on the next grid"
        try:
            finer = _doubled(grids[-1])
            check_grid(geometry, finer, rough=rough, heat=heat)
        except InputError as error:
            return grids, str(error)
        if setup.grid.most_nodes is not None and finer.nodes_along > setup.grid.most_nodes:
            return grids, f"the next grid has {finer.nodes_along} nodes, more than grid.most_nodes"
        grids.append(finer)


def _fixed(grid: Grid) -> Grid:
    """Grid with the same nodes that is not refined."""
    return grid.model_copy(update={"refine": None, "error": None, "most_nodes": None})


def _target_key(setup: Setup) -> str:
    """Key of the grid that asks for the error of a refinement."""
    return "refine" if setup.grid.refine else "error"


def _doubled(grid: Grid) -> Grid:
    """Grid with twice as many intervals.

    Raises an InputError if the finer grid exceeds the bounds of a case.
    """
    table = grid.model_dump(mode="json", exclude_none=True)
    table |= {key: 2 * table[key] - 1 for key in ("nodes", "nodes_y") if key in table}
    with within("grid"):
        return Grid.from_dict(table)


# Time that a film takes for each node that is solved for [s], on one core of a workstation, until the
# times of the coarser grids are known.
_SECONDS_A_NODE = {"line": 2e-5, "point": 1e-4}

# Power of the number of nodes with which the time of a grid grows.
_GROWTH = 1.1


@dataclass(frozen=True)
class ExpectedGrid:
    """Grid of a refinement before it is solved."""

    nodes: int  # number of nodes along entrainment, over the whole domain
    solved: float
    # Relative discretisation error of the film that is expected on this grid; None if it is not known.
    error: float | None


@dataclass(frozen=True)
class Reach:
    """Grids of a refinement and what is expected of them, before the film is solved."""

    key: str  # key of the grid that asks for the error, "error" or "refine"
    target: float  # relative error that is asked for
    grids: tuple[ExpectedGrid, ...]  # all grids up to the finest one that is allowed
    seconds_a_node: float  # time that the film takes for each node [s]

    def last(self, done: int = 0, error: float | None = None) -> int | None:
        """Number of the grid on which the refinement will end, counted from 1; None if it is not known.

        The first ``done`` grids are solved, and the last one of them has the ``error``.
        """
        if done and error is not None and error <= self.target:
            return done
        for number in range(done + 1, len(self.grids) + 1):
            expected = self.expected(number, done, error)
            if expected is None:
                return None
            if expected <= self.target:
                return number
        return len(self.grids)

    def expected(self, number: int, done: int = 0, error: float | None = None) -> float | None:
        """Error that is expected on a grid by its number; an error on a coarser grid corrects it."""
        grid = self.grids[number - 1]
        if error is None:
            return grid.error
        known = self.grids[done - 1].error
        if grid.error is None or known is None:
            return error * float(0.5 ** (MINIMUM_ORDER * (number - done)))
        return float(error * grid.error / known)

    def seconds(self, done: int, until: int, measured: float | None = None) -> float:
        """Time of the grids after the first ``done`` ones [s], up to a grid by its number.

        ``measured`` is the time of the last grid that is done.
        """
        a_node, at = self.seconds_a_node, self.grids[0].solved
        if done and measured is not None:
            at = self.grids[done - 1].solved
            a_node = measured / at
        solved = np.array([grid.solved for grid in self.grids[done:until]])
        return float(np.sum(a_node * solved * (solved / at) ** (_GROWTH - 1.0)))

    def warnings(self) -> Iterator[ResultWarning]:
        """Warning where the error that is asked for is probably out of reach."""
        finest = self.grids[-1]
        if finest.error is None or finest.error <= self.target:
            return
        yield ResultWarning.of(
            "error-out-of-reach",
            key=self.key,
            target=_percent(self.target),
            error=_percent(finest.error),
            nodes=finest.nodes,
            time=_duration(self.seconds(0, len(self.grids))),
        )


def reach_of(refinement: Refinement, geometry: str) -> Reach | None:
    """Expected errors and times of the grids of a refinement; None of a grid that is not refined."""
    setup, problem = refinement.setup, refinement.problem
    if setup.grid.target is None:
        return None
    return Reach(
        _target_key(setup),
        setup.grid.target,
        tuple(
            ExpectedGrid(grid.nodes_along, expected_nodes(problem, 2**k), expected_error(problem, 2**k))
            for k, grid in enumerate(refinement.grids)
        ),
        _SECONDS_A_NODE[geometry],
    )


class FilmProgress:
    """Progress of a contact's film in words: its grid, the error so far, and about the time that is left.
    ``reach``, expected errors of the grids; None of a grid that is not refined; ``clock``, function that
    returns the time [s].
    """

    def __init__(self, reach: Reach | None, clock: Callable[[], float] = time.perf_counter) -> None:
        self._reach, self._clock = reach, clock
        self._done, self._started = 0, clock()
        self._error: float | None = None
        self._measured: float | None = None

    def on_grid(self, _mesh: Mesh, error: float | None) -> None:
        """Note that a grid of the refinement is solved, and its discretisation error."""
        now = self._clock()
        self._measured, self._started = now - self._started, now
        self._done, self._error = self._done + 1, error

    def text(self, nodes: int, step: int, residual: float) -> str:
        """Line about a Newton step: nodes of its grid along entrainment, its number, and the residual."""
        now = f"{nodes} nodes, step {step + 1}, residual {residual:.1e}"
        accuracy = "" if self._error is None else f"; error {_percent(self._error)} so far"
        reach = self._reach
        if reach is None or self._done >= len(reach.grids):
            return f"film: {now}{accuracy}"
        last = reach.last(self._done, self._error)
        if last is None:
            return f"film: grid {self._done + 1}, {now}{accuracy}"
        if last <= self._done:
            return f"film: {now}{accuracy}"
        left = reach.seconds(self._done, last, self._measured) - (self._clock() - self._started)
        reached = reach.expected(last, self._done, self._error)
        if reached is not None and reached > reach.target:
            accuracy += f", about {_percent(reached)} in reach"
        return (
            f"film: grid {self._done + 1} of {last}, {now}{accuracy}; about {_duration(max(left, 1.0))} left"
        )


def _percent(error: float) -> str:
    return f"{100.0 * error:.0f} %" if error >= 0.1 else f"{readable(100.0 * error, 2)} %"


def _duration(seconds: float) -> str:
    """Time in words, in seconds, minutes or hours."""
    for unit, name in ((3600.0, "h"), (60.0, "min")):
        if seconds >= 1.5 * unit:
            return f"{seconds / unit:.0f} {name}"
    return f"{max(seconds, 1.0):.0f} s"
