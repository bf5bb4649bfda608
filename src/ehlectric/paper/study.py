"""Study of the paper's eight contacts, solved in parallel.

The contacts are solved smooth and rough, with a constant permittivity, and by the paper's own methods.
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
from ehlectric.contact import Result, field_problem, film_problem, resolve, solve
from ehlectric.field import solve_field
from ehlectric.film import solve_film
from ehlectric.paper import fas, sor
from ehlectric.paper.paper_contacts import CONTACTS, ROUGH_NODES, SMOOTH_NODES, PaperContact, measured_profile
from ehlectric.runtime.tasks import run_all

# Residual down to which the V-cycles of the paper's multigrid are counted.
COUNTED = 1e-6

# Differences from Young's damping factor that are tried, to find the fewest sweeps. Young's factor suits the
# slowest mode in the largest gap, of which the linear initial guess contains little.
_FACTORS = np.arange(-0.24, 0.021, 0.02)

# Number of nodes of the rough contacts with a moved profile, and distances that it is moved by [m].
PLACED_NODES = (ROUGH_NODES - 1) // 2 + 1
PLACEMENTS = (0.0, 50e-6, 100e-6, 150e-6)


@dataclass(frozen=True)
class Placed:
    """Result of a rough contact with its profile moved, or on another grid."""

    minimum_thickness: float  # minimum film thickness h_min [m]
    largest: float  # largest dimensionless field strength, E_max h_min/V12
    converged: bool


@dataclass(frozen=True)
class Methods:
    """Convergence of the paper's own methods on one contact, and their differences from ehlectric's solvers.

    Both films have the first-order wedge.
    """

    cycles: int  # number of V-cycles to a residual of 1e-6 on the finest grid
    factor: float  # mean reduction of the residual by a cycle, from the third cycle on
    film_difference: float  # largest relative difference between the two films
    unknowns: int  # number of unknowns of the Cartesian grid
    sweeps: int  # fewest sweeps of the over-relaxation
    damping: float  # damping factor of the fewest sweeps
    # capacitance_difference and strength_difference: relative differences of the capacitance and of the
    # largest field from ehlectric's solver.
    capacitance_difference: float
    strength_difference: float


@dataclass(frozen=True)
class Study:
    """Results of the study by contact; a part that was not requested is empty."""

    # Smooth contacts with the second-order wedge.
    smooth: dict[PaperContact, Result] = field(default_factory=dict)
    # Smooth contacts with the first-order wedge of the paper.
    first_order: dict[PaperContact, Result] = field(default_factory=dict)
    # Smooth contacts with twice the number of intervals.
    fine: dict[PaperContact, Result] = field(default_factory=dict)
    rough: dict[PaperContact, Result] = field(default_factory=dict)
    # Rough contacts on half the number of intervals, with the profile as it is and moved.
    placed: dict[PaperContact, tuple[Placed, ...]] = field(default_factory=dict)
    # Smooth contacts with a constant permittivity.
    constant: dict[PaperContact, Result] = field(default_factory=dict)
    # Comparison of the paper's own methods with the solvers of ehlectric.
    methods: dict[PaperContact, Methods] = field(default_factory=dict)

    @property
    def converged(self) -> bool:
        """Whether every film is converged."""
        parts = (self.smooth, self.first_order, self.fine, self.rough, self.constant)
        results = all(result.converged for part in parts for result in part.values())
        return results and all(each.converged for places in self.placed.values() for each in places)


def run_study(parts: Iterable[str], *, progress: Callable[[int, int, str], None] | None = None) -> Study:
    """Solve parts of the study in parallel, with one process for each core. Raises LostError if the process
    of a contact was killed four times.
    """
    requested = dict.fromkeys(parts)
    with measured_profile() as profile:
        tasks: dict[str, Callable[[PaperContact], object]] = {
            "rough": partial(_variant, partial(PaperContact.rough_case, profile=profile)),
            "placed": partial(_placed, profile),
            **_TASKS,
        }
        work = [(part, contact, tasks[part]) for part in requested for contact in CONTACTS]
        # Long tasks go first, so that no core idles while the last one is solved.
        work.sort(key=lambda item: item[0] not in ("rough", "placed", "methods"))
        solved: dict[tuple[str, PaperContact], Any] = {}

        def done(number: int, result: Any) -> None:
            part, contact, _ = work[number]
            solved[part, contact] = result
            if progress is not None:
                progress(len(solved), len(work), f"{part.replace('_', ' ')}: {contact.name}")

        if work:
            run_all([partial(task, contact) for _, contact, task in work], done, what="contact")
    # The results are in the order of the contacts, not in the order of completion.
    return Study(**{part: {contact: solved[part, contact] for contact in CONTACTS} for part in requested})


def straight_line(result: Result) -> Array:
    """Field strength on a straight line at mid-film, the second reading of the paper's definition.

    The line lies half of the average film thickness above the average lower surface, both averaged over the
    Hertz zone.

    Returns abs(E) at the columns of the field [V/m]; NaN where the line is outside the film, shape (nx,).

    Between smooth equal bodies, with surfaces at -h/2 and h/2, this is the line s = 1/2.
    """
    field, b = result.field, result.conditions.half_width
    zone = np.abs(field.x) <= b
    lower = float(np.trapezoid(field.y[zone, 0], field.x[zone]) / np.ptp(field.x[zone]))
    return field.strength_at(lower + 0.5 * result.film.mean_thickness)


def readings_differ_by(result: Result) -> float:
    """Largest relative difference between the field strengths of the two readings of mid-film.

    The readings are the line s = 1/2 and a straight line. Columns where the straight line is outside the film
    are skipped.
    """
    field, straight = result.field, straight_line(result)
    inside = field.inner & np.isfinite(straight)
    return float(np.max(np.abs(straight[inside] / field.middle_strength[inside] - 1.0)))


def _line(case: Case, *, beside_smooth: bool = True) -> Result:
    """Solve a line contact; with ``beside_smooth``, a rough contact is also solved with smooth surfaces."""
    result = solve(case, beside_smooth=beside_smooth)
    assert isinstance(result, Result)
    return result


def _variant(case: Callable[[PaperContact], Case], contact: PaperContact) -> Result:
    """Result of a contact with the case that a function makes of it."""
    return _line(case(contact))


def _placed(profile: Path, contact: PaperContact) -> tuple[Placed, ...]:
    """Results of a rough contact on half the number of intervals, with the profile as it is and moved."""
    cases = (contact.rough_case(profile, nodes=PLACED_NODES, shift=shift) for shift in PLACEMENTS)
    results = [_line(case, beside_smooth=False) for case in cases]
    return tuple(Placed(r.film.minimum_thickness, r.max_dimensionless, r.converged) for r in results)


def _methods(contact: PaperContact) -> Methods:
    """Comparison of the paper's own methods with the solvers of ehlectric on a smooth contact."""
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
    field, reference = sor.field_from(problem, stencil, best.potential), solve_field(problem)
    return Methods(
        cycles=int(np.count_nonzero(residuals > COUNTED)),
        factor=float((late[-1] / late[0]) ** (1.0 / max(late.size - 1, 1))),
        film_difference=float(np.max(np.abs(theirs.thickness / ours.thickness - 1.0))),
        unknowns=stencil.grid.column.size,
        sweeps=best.sweeps,
        damping=float(best.factor),
        capacitance_difference=field.capacitance / reference.capacitance - 1.0,
        strength_difference=field.max_strength / reference.max_strength - 1.0,
    )


_TASKS: dict[str, Callable[[PaperContact], object]] = {
    "smooth": partial(_variant, PaperContact.case),
    "first_order": partial(_variant, partial(PaperContact.case, wedge="first-order")),
    "fine": partial(_variant, partial(PaperContact.case, nodes=2 * SMOOTH_NODES - 1)),
    "constant": partial(_variant, PaperContact.constant_case),
    "methods": _methods,
}
