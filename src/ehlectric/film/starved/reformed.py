"""Flooded films that form again behind a cavity, as between the peaks of a rough surface.

The wedge term of ``ehlectric.film.newton`` counts a cavitated gap as full. That is exact where no oil fills
the gap any more behind a cavity. Elsewhere it makes the oil that is missing in the cavity. There the content
of oil is carried through the cavity, as in a starved film (``ehlectric.film.starved.content``) whose inlet is
flooded.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.starved.content import Supply
from ehlectric.film.starved.newton import assess_content, starved_newton
from ehlectric.film.state import GridSolution, Progress, State

# Largest number of Newton steps from a solution whose scheme has lower order at some nodes.
_AGAIN = 15

# Part of the tolerance to which it is solved then.
_CLOSER = 0.01


def forms_again(full_film: Mask) -> bool:
    """Whether oil fills a node behind a cavitated one on its line along entrainment, inside of the domain.

    Examples
    --------
    Behind the exit the film is cavitated up to the end of the domain; in the second film it forms again:

    >>> once = np.array([[False], [True], [True], [False], [False], [False]])
    >>> again = np.array([[False], [True], [False], [True], [False], [False]])
    >>> forms_again(once), forms_again(again)
    (False, True)
    """
    inner = full_film[1:-1]
    behind = np.logical_or.accumulate(~inner, axis=0)
    return bool(np.any(inner & behind))


def conserving_film(
    fluid: Fluid,
    levels: list[Level],
    start: tuple[State, Mask],
    *,
    order: int,
    tolerance: float,
    max_iterations: int,
    progress: Progress | None = None,
) -> GridSolution:
    """Film that conserves the mass of the oil, on the first of ``levels``.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest.
    start : (State, ndarray)
        Initial guess, and the nodes (nx, ny) that oil fills in it.
    order : int
        Order of the wedge term where oil fills the gap.
    tolerance : float
        Residual at which to stop, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every step.

    Returns
    -------
    GridSolution
        Last iterate, with its oil fraction.
    """
    supply = flooded_inlet(levels[0], order)

    def solved(state: State, filled: Mask, most: int, tolerance: float) -> GridSolution:
        found, content = starved_newton(
            fluid,
            levels,
            replace(state, contact_pressure=0.0),
            with_inlet(filled),
            supply=supply,
            tolerance=tolerance,
            max_iterations=most,
            progress=progress,
        )
        return replace(found, fraction=content.fraction(found.state.thickness))

    return of_full_order(solved(*start, max_iterations, tolerance), solved, tolerance)


def of_full_order(
    found: GridSolution, solved: Callable[[State, Mask, int, float], GridSolution], tolerance: float
) -> GridSolution:
    """Solution whose nodes have no upwind difference that it does not need, and whose oil balances closely.

    Nodes that went round in circles got such a difference. A residual that is small as a pressure may be much
    oil where the gap is wide. ``solved`` solves the film again from a state, its filled nodes, with a largest
    number of Newton steps and to a residual; where that misses the ``tolerance``, the solution stays.
    """
    if found.status != "converged":
        return found
    for closer in (_CLOSER * tolerance, tolerance):
        again = solved(found.state, found.final.full_film, _AGAIN, closer)
        if again.status == "converged":
            return replace(again, steps=found.steps + again.steps)
    return found


def flooded_inlet(level: Level, order: int, *, first_order: bool = False) -> Supply:
    """Supply of more oil than any gap takes, at the lines of a grid; ``first_order`` as in ``Supply``."""
    return Supply(np.full(level.mesh.y.size, np.inf), order, first_order=first_order)


def with_inlet(filled: Mask) -> Mask:
    """Mask of filled nodes (nx, ny) with the nodes of the inlet edge."""
    flooded = filled.copy()
    flooded[0] = True
    return flooded


def oil_fraction(fluid: Fluid, solution: GridSolution, order: int) -> Array:
    """Part of the gap that oil fills, shape (nx, ny), also of a solution that does not carry it."""
    if solution.fraction is not None:
        return solution.fraction
    level, state = solution.level, solution.state
    filled = with_inlet(solution.final.full_film)
    return assess_content(fluid, level, state, filled, flooded_inlet(level, order)).fraction(state.thickness)
