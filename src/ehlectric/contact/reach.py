"""Error that the refinement of a grid can reach, and its time, said before it begins and while it runs."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ehlectric.contact.refinement import finer_grids
from ehlectric.contact.setup import Setup
from ehlectric.errors import ResultWarning
from ehlectric.film.accuracy.expected import expected_error, expected_nodes
from ehlectric.film.estimates import MINIMUM_ORDER
from ehlectric.film.mesh import Mesh
from ehlectric.film.problem import FilmProblem

# Time that a film takes for each node that is solved for [s], on one core of a workstation, until the
# times of the coarser grids are known.
_SECONDS_A_NODE = {"line": 2e-5, "point": 1e-4}

# Power of the number of nodes with which the time of a grid grows.
_GROWTH = 1.1


@dataclass(frozen=True)
class ExpectedGrid:
    """Grid of a refinement before it is solved.

    Attributes
    ----------
    nodes : int
        Number of nodes along entrainment, over the whole domain.
    solved : float
        Number of nodes that are solved for.
    error : float or None
        Relative discretisation error of the film that is expected on this grid; None if it is not known.
    """

    nodes: int
    solved: float
    error: float | None


@dataclass(frozen=True)
class Reach:
    """Grids of a refinement and what is expected of them, before the film is solved.

    Attributes
    ----------
    key : str
        Key of the grid that asks for the error, "error" or "refine".
    target : float
        Relative error that is asked for.
    grids : tuple of ExpectedGrid
        All grids up to the finest one that is allowed.
    seconds_a_node : float
        Time that the film takes for each node [s].
    """

    key: str
    target: float
    grids: tuple[ExpectedGrid, ...]
    seconds_a_node: float

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
        yield ResultWarning(
            "error-out-of-reach",
            f"grid.{self.key}: an error of {_percent(self.target)} is probably out of reach, because the "
            f"film is thin for its contact; about {_percent(finest.error)} is expected on the finest grid, "
            f"with {finest.nodes} nodes, after about {_duration(self.seconds(0, len(self.grids)))}; raise "
            f"grid.{self.key}, end sooner with a smaller grid.most_nodes, or take the film of the atlas "
            "(ehlectric film) or of formulas (ehlectric check)",
        )


def reach_of(setup: Setup, geometry: str, problem: FilmProblem) -> Reach:
    """Expected errors and times of the grids of a refinement.

    Parameters
    ----------
    setup : Setup
        Setup of the contact, whose grid has a target.
    geometry : str
        Geometry of the contact, "line" or "point".
    problem : FilmProblem
        Film problem of the contact on its first grid.
    """
    assert setup.grid.target is not None
    grids, _ = finer_grids(setup, geometry, problem.physics)
    return Reach(
        "refine" if setup.grid.refine else "error",
        setup.grid.target,
        tuple(
            ExpectedGrid(grid.nodes_along, expected_nodes(problem, 2**k), expected_error(problem, 2**k))
            for k, grid in enumerate(grids)
        ),
        _SECONDS_A_NODE[geometry],
    )


class FilmProgress:
    """Progress of a contact's film in words: its grid, the error so far, and about the time that is left.

    Parameters
    ----------
    reach : Reach or None
        Expected errors of the grids; None of a grid that is not refined.
    clock : callable
        Function that returns the time [s].
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
        told = "" if self._error is None else f"; error {_percent(self._error)} so far"
        reach = self._reach
        if reach is None or self._done >= len(reach.grids):
            return f"film: {now}{told}"
        last = reach.last(self._done, self._error)
        if last is None:
            return f"film: grid {self._done + 1}, {now}{told}"
        if last <= self._done:
            return f"film: {now}{told}"
        left = reach.seconds(self._done, last, self._measured) - (self._clock() - self._started)
        reached = reach.expected(last, self._done, self._error)
        if reached is not None and reached > reach.target:
            told += f", about {_percent(reached)} in reach"
        return f"film: grid {self._done + 1} of {last}, {now}{told}; about {_duration(max(left, 1.0))} left"


def _percent(error: float) -> str:
    return f"{100.0 * error:.0f} %" if error >= 0.1 else f"{100.0 * error:.2g} %"


def _duration(seconds: float) -> str:
    """Time in words, in seconds, minutes or hours."""
    for unit, name in ((3600.0, "h"), (60.0, "min")):
        if seconds >= 1.5 * unit:
            return f"{seconds / unit:.0f} {name}"
    return f"{max(seconds, 1.0):.0f} s"
