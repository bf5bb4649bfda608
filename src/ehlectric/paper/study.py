"""The paper's contacts solved, in parallel.

Smooth, rough, with a permittivity that stays constant, and by the paper's own methods.
"""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterable
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.conditions import resolve
from ehlectric.field import solve_field
from ehlectric.film import solve_film
from ehlectric.paper import fas, sor
from ehlectric.paper.contacts import CONTACTS, SMOOTH_NODES, PaperContact, measured_profile
from ehlectric.poisson import FieldProblem
from ehlectric.result import Result
from ehlectric.solver import field_problem, film_problem, solve
from ehlectric.typing import Array

# Residual to which the paper's multigrid is counted.
COUNTED = 1e-6

# Damping factors tried for the fewest sweeps: of Young's plate, which is the slowest mode alone, downwards.
_FACTORS = np.linspace(-0.08, 0.01, 10)


@dataclass(frozen=True)
class Solved:
    """A result, and the field strength on the paper's straight line of mid-film.

    ``straight`` is abs(E) [V/m] at the columns of the field, not a number where the line is outside the film.
    """

    result: Result
    straight: Array


@dataclass(frozen=True)
class Methods:
    """How the paper's own methods did on one contact, with the first-order wedge.

    Attributes
    ----------
    cycles : int
        V-cycles to a residual of 1e-6 on the finest grid.
    factor : float
        Mean reduction of the residual by a cycle, from the third on.
    film_difference : float
        Largest relative difference of the film from ours.
    unknowns, sweeps, damping : int, int, float
        Nodes of the Cartesian grid, fewest sweeps of the over-relaxation, and the damping factor of those.
    capacitance_difference, strength_difference : float
        Relative difference from ours of the capacitance and of the largest field.
    """

    cycles: int
    factor: float
    film_difference: float
    unknowns: int
    sweeps: int
    damping: float
    capacitance_difference: float
    strength_difference: float


@dataclass(frozen=True)
class Study:
    """What was solved, by contact; empty where it was not asked for."""

    smooth: dict[PaperContact, Solved] = field(default_factory=dict)
    first_order: dict[PaperContact, Result] = field(default_factory=dict)
    fine: dict[PaperContact, Result] = field(default_factory=dict)
    rough: dict[PaperContact, Solved] = field(default_factory=dict)
    constant: dict[PaperContact, Result] = field(default_factory=dict)
    methods: dict[PaperContact, Methods] = field(default_factory=dict)

    @property
    def converged(self) -> bool:
        """Whether every film is a solution."""
        results = [*self.first_order.values(), *self.fine.values(), *self.constant.values()]
        results += [solved.result for part in (self.smooth, self.rough) for solved in part.values()]
        return all(result.converged for result in results)


def run_study(parts: Iterable[str], *, progress: Callable[[int, int, str], None] | None = None) -> Study:
    """Solve parts of the study, one process a core.

    Parameters
    ----------
    parts : iterable of str
        Attributes of ``Study``.
    progress : callable, optional
        Called with (done, of, what was done) after every contact.

    Returns
    -------
    Study
        With the parts asked for.
    """
    with measured_profile() as profile:
        tasks: dict[str, Callable[[PaperContact], object]] = {"rough": partial(_rough, profile), **_TASKS}
        work = [(part, contact, tasks[part]) for part in dict.fromkeys(parts) for contact in CONTACTS]
        # Long ones first, so that no core waits for one at the end.
        work.sort(key=lambda item: item[0] not in ("rough", "methods"))
        solved: dict[tuple[str, PaperContact], object] = {}
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(_cores(), mp_context=context) as pool:
            futures: dict[Future[object], tuple[str, PaperContact]] = {
                pool.submit(task, contact): (part, contact) for part, contact, task in work
            }
            for done, future in enumerate(as_completed(futures), 1):
                part, contact = futures[future]
                solved[part, contact] = future.result()
                if progress is not None:
                    progress(done, len(work), f"{part.replace('_', ' ')}: {contact.name}")
    return _gathered(solved)


def _cores() -> int:
    return min(len(os.sched_getaffinity(0)), len(CONTACTS))


def _gathered(solved: dict[tuple[str, PaperContact], Any]) -> Study:
    """What was solved, in the order of the contacts, whatever order it was done in."""
    parts: dict[str, dict[PaperContact, Any]] = {}
    for contact in CONTACTS:
        for part, of in solved:
            if of == contact:
                parts.setdefault(part, {})[contact] = solved[part, of]
    return Study(**parts)


def straight_line(result: Result) -> Array:
    """Field strength on the paper's other reading of mid-film: a straight line, half the average film high.

    Parameters
    ----------
    result : Result
        A solved contact of equal bodies.

    Returns
    -------
    ndarray
        abs(E) at the columns of its field [V/m], not a number where the line is outside the film.

    Notes
    -----
    Between equal bodies, at -h/2 and h/2, a straight line in the middle is s = 1/2. The reading differs
    where the gap is drawn over a plane: the lower surface is straight but for its roughness, the upper one h
    above it.
    """
    film, of = result.film, result.field
    lower = PchipInterpolator(film.x, result.roughness[0])(of.x)
    problem = FieldProblem(
        x=of.x,
        lower=lower,
        upper=lower + of.y[:, -1] - of.y[:, 0],
        permittivity=of.permittivity[:, 0],
        potential_1=result.case.electric.potential_1,
        potential_2=result.case.electric.potential_2,
        degree=result.case.grid.field_degree,
    )
    return solve_field(problem).strength_at(0.5 * film.mean_thickness)


def largest_difference(solved: Solved) -> float:
    """Of the two readings of mid-film, relative, where the straight line is inside the film."""
    of = solved.result.field
    inside = of.inner & np.isfinite(solved.straight)
    return float(np.max(np.abs(solved.straight[inside] / of.middle_strength[inside] - 1.0)))


def _smooth(contact: PaperContact) -> Solved:
    result = solve(contact.case())
    return Solved(result, straight_line(result))


def _rough(profile: Path, contact: PaperContact) -> Solved:
    result = solve(contact.rough_case(profile))
    return Solved(result, straight_line(result))


def _first_order(contact: PaperContact) -> Result:
    return solve(contact.case(wedge="first-order"))


def _fine(contact: PaperContact) -> Result:
    return solve(contact.case(nodes=2 * SMOOTH_NODES - 1))


def _constant(contact: PaperContact) -> Result:
    return solve(contact.constant_case())


def _methods(contact: PaperContact) -> Methods:
    case = contact.case(wedge="first-order")
    conditions = resolve(case)
    equations = film_problem(case, conditions)
    ours, theirs = solve_film(equations), fas.solve_film(equations)
    residuals = np.array([step.residual for step in theirs.steps] + [theirs.residual])
    late = residuals[2:]
    problem = field_problem(case, conditions, ours, np.zeros((2, ours.x.size)))
    stencil, linear = sor.cartesian(problem, sor.ROWS)
    young = sor.young_factor(stencil.grid)
    best = min(
        (sor.over_relax(stencil, linear, factor=young + change) for change in _FACTORS),
        key=lambda relaxed: relaxed.sweeps,
    )
    field, own = sor.field_from(problem, stencil, best.potential), solve_field(problem)
    return Methods(
        cycles=int(np.count_nonzero(residuals > COUNTED)),
        factor=float((late[-1] / late[0]) ** (1.0 / (late.size - 1))),
        film_difference=float(np.max(np.abs(theirs.thickness / ours.thickness - 1.0))),
        unknowns=stencil.grid.column.size,
        sweeps=best.sweeps,
        damping=float(best.factor),
        capacitance_difference=field.capacitance / own.capacitance - 1.0,
        strength_difference=field.max_strength / own.max_strength - 1.0,
    )


_TASKS: dict[str, Callable[[PaperContact], object]] = {
    "smooth": _smooth,
    "first_order": _first_order,
    "fine": _fine,
    "constant": _constant,
    "methods": _methods,
}
