"""The paper's contacts solved, in parallel.

Smooth, rough, with a permittivity that stays constant, and by the paper's own methods.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.problems import field_problem, film_problem
from ehlectric.contact.resolve import resolve
from ehlectric.contact.results import Result
from ehlectric.contact.solver import solve
from ehlectric.field.line import solve_field
from ehlectric.film.line import solve_film
from ehlectric.paper import fas, sor
from ehlectric.paper.contacts import CONTACTS, ROUGH_NODES, SMOOTH_NODES, PaperContact, measured_profile
from ehlectric.runtime.workers import run_all

# Residual to which the paper's multigrid is counted.
COUNTED = 1e-6

# Damping factors tried for the fewest sweeps, from Young's for a plate as wide as the widest gap: that is the
# slowest mode alone, and the linear start has little of it.
_FACTORS = np.arange(-0.24, 0.021, 0.02)

# Nodes of the rough contacts of other placements, and how far the profile is moved [m].
PLACED_NODES = (ROUGH_NODES - 1) // 2 + 1
PLACEMENTS = (0.0, 50e-6, 100e-6, 150e-6)


@dataclass(frozen=True)
class Placed:
    """A rough contact with its profile in another place, or on another grid.

    ``minimum_thickness`` [m] and ``largest``, the largest field times h_min over the voltage.
    """

    minimum_thickness: float
    largest: float
    converged: bool


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

    smooth: dict[PaperContact, Result] = field(default_factory=dict)
    first_order: dict[PaperContact, Result] = field(default_factory=dict)
    fine: dict[PaperContact, Result] = field(default_factory=dict)
    rough: dict[PaperContact, Result] = field(default_factory=dict)
    placed: dict[PaperContact, tuple[Placed, ...]] = field(default_factory=dict)
    constant: dict[PaperContact, Result] = field(default_factory=dict)
    methods: dict[PaperContact, Methods] = field(default_factory=dict)

    @property
    def converged(self) -> bool:
        """Whether every film is a solution."""
        parts = (self.smooth, self.first_order, self.fine, self.rough, self.constant)
        results = all(result.converged for part in parts for result in part.values())
        return results and all(each.converged for places in self.placed.values() for each in places)


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

    Raises
    ------
    RuntimeError
        Where a process was killed, or a script calls this without ``if __name__ == "__main__":``.
    """
    asked = dict.fromkeys(parts)
    with measured_profile() as profile:
        tasks: dict[str, Callable[[PaperContact], object]] = {
            "rough": partial(_rough, profile),
            "placed": partial(_placed, profile),
            **_TASKS,
        }
        work = [(part, contact, tasks[part]) for part in asked for contact in CONTACTS]
        # Long ones first, so that no core waits for one at the end.
        work.sort(key=lambda item: item[0] not in ("rough", "placed", "methods"))
        solved: dict[tuple[str, PaperContact], Any] = {}

        def done(number: int, result: Any) -> None:
            part, contact, _ = work[number]
            solved[part, contact] = result
            if progress is not None:
                progress(len(solved), len(work), f"{part.replace('_', ' ')}: {contact.name}")

        if work:
            run_all([partial(task, contact) for _, contact, task in work], done)
    # In the order of the contacts, whatever order they were done in.
    return Study(**{part: {contact: solved[part, contact] for contact in CONTACTS} for part in asked})


def straight_line(result: Result) -> Array:
    """Field strength on the paper's other reading of mid-film: a straight line.

    Parameters
    ----------
    result : Result
        A solved contact.

    Returns
    -------
    ndarray
        abs(E) at the columns of its field [V/m], half of the average film above the average lower surface of
        the Hertz zone; not a number where that is outside the film.

    Notes
    -----
    Between smooth equal bodies, at -h/2 and h/2, this is the line s = 1/2.
    """
    field, b = result.field, result.conditions.half_width
    zone = np.abs(field.x) <= b
    lower = float(np.trapezoid(field.y[zone, 0], field.x[zone]) / np.ptp(field.x[zone]))
    return field.strength_at(lower + 0.5 * result.film.mean_thickness)


def readings_differ_by(result: Result) -> float:
    """Largest relative difference of the two readings of mid-film, where the straight line is in the film."""
    field, straight = result.field, straight_line(result)
    inside = field.inner & np.isfinite(straight)
    return float(np.max(np.abs(straight[inside] / field.middle_strength[inside] - 1.0)))


def _line(case: Case, *, beside_smooth: bool = True) -> Result:
    """Result of a line contact."""
    result = solve(case, beside_smooth=beside_smooth)
    assert isinstance(result, Result)
    return result


def _smooth(contact: PaperContact) -> Result:
    return _line(contact.case())


def _rough(profile: Path, contact: PaperContact) -> Result:
    return _line(contact.rough_case(profile))


def _placed(profile: Path, contact: PaperContact) -> tuple[Placed, ...]:
    """The rough contact on half of the nodes, with the profile where it is and moved."""
    return tuple(_moved(contact.rough_case(profile, nodes=PLACED_NODES, shift=shift)) for shift in PLACEMENTS)


def _moved(case: Case) -> Placed:
    result = _line(case, beside_smooth=False)
    return Placed(result.film.minimum_thickness, result.max_dimensionless, result.converged)


def _first_order(contact: PaperContact) -> Result:
    return _line(contact.case(wedge="first-order"))


def _fine(contact: PaperContact) -> Result:
    return _line(contact.case(nodes=2 * SMOOTH_NODES - 1))


def _constant(contact: PaperContact) -> Result:
    return _line(contact.constant_case())


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
        factor=float((late[-1] / late[0]) ** (1.0 / max(late.size - 1, 1))),
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
