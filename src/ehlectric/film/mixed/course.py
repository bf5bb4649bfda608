"""Course of the solution of a film whose surfaces may touch, on one grid: starts, and continuation in speed.

Newton's method converges from different starts at different speeds. Where the oil carries part of the load,
the dry contact with its pressure carried by the oil is near enough, since it has the shape that the surfaces
take. Where it carries hardly any, the dry contact itself is. In between the film may change all along a
streamline when its entry opens; there the speed is raised in steps from one at which the surfaces touch
nearly everywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mixed.dry import dry_contact
from ehlectric.film.mixed.newton import mixed_newton
from ehlectric.film.mixed.touching import Asperities
from ehlectric.film.state import GridSolution, Progress, State

# Speeds of the continuation as parts of the speed of the contact: the first one that is tried, the factor by
# which the next one is slower if it does not converge, and the lowest one.
_FIRST_PART, _SLOWER, _LEAST_PART = 0.1, 0.1, 1e-6

# Factor between two speeds of the continuation at first, its least logarithm, and the factor by which the
# logarithm grows where a film converges and falls where it does not.
_FASTER, _LEAST_FASTER, _GROWTH, _FALL = 4.0, 0.02, 1.5, 0.5

# Residual of the films of the continuation, and Newton steps of each.
_LOOSE, _FEW_STEPS = 1e-4, 40

# Damping of the first step from a state that is likely to be close.
_NEAR_DAMPING = 0.1

# Largest number of films of a continuation.
_MOST_SPEEDS = 40


def mixed_film(
    fluid: Fluid,
    levels: list[Level],
    dry_pressure: Array,
    *,
    asperities: Asperities,
    film_guess: float,
    tolerance: float,
    max_iterations: int,
    progress: Progress | None = None,
    near: State | None = None,
    thorough: bool = True,
) -> Iterator[GridSolution]:
    """Solutions of a film whose surfaces may touch, from one start after the other until one converges.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest.
    dry_pressure : ndarray, shape (nx, ny)
        Hertz pressure P.
    asperities : Asperities
        Boundary film and hardness.
    film_guess : float
        Film thickness of smooth surfaces by a formula, dimensionless. With less than the boundary film the
        asperities are likely to carry the load.
    tolerance : float
        Residual at which to stop, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps from each start.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every Newton step.
    near : State, optional
        State that is likely to be close, as that of a coarser grid.
    thorough : bool
        Whether to try all starts, or the first one only, as on a grid that only serves the next finer one.

    Yields
    ------
    GridSolution
        Last iterate from each start. The iteration ends with the first that converges.
    """

    def solved(start: State, damping: float = 1.0) -> GridSolution:
        return mixed_newton(
            fluid,
            levels,
            start,
            asperities=asperities,
            tolerance=tolerance,
            max_iterations=max_iterations,
            first_damping=damping,
            progress=progress,
        )

    if near is not None:
        yield (found := solved(near, _NEAR_DAMPING))
        if found.status == "converged" or not thorough:
            return
    ambient = fluid.ambient_pressure
    dry = dry_contact(levels[0], dry_pressure, asperities.boundary_film, ambient)
    starts = [replace(dry, contact_pressure=0.0), dry]
    for start in starts if film_guess > asperities.boundary_film else starts[::-1]:
        yield (found := solved(start))
        if found.status == "converged" or not thorough:
            return
    state = _faster_and_faster(fluid, levels, dry, asperities, progress)
    if state is not None:
        yield solved(state)


def _faster_and_faster(
    fluid: Fluid, levels: list[Level], dry: State, asperities: Asperities, progress: Progress | None
) -> State | None:
    """State near that of the contact, over films of lower speed from the dry contact on; None without one."""

    def solved(part: float, start: State) -> GridSolution:
        slower = replace(fluid, velocity_parameter=part * fluid.velocity_parameter)
        return mixed_newton(
            slower,
            levels,
            start,
            asperities=asperities,
            tolerance=_LOOSE,
            max_iterations=_FEW_STEPS,
            progress=progress,
        )

    part, state = _FIRST_PART, None
    while state is None and part >= _LEAST_PART:
        found = solved(part, dry)
        if found.status == "converged":
            state = found.state
        else:
            part *= _SLOWER
    step = np.log(_FASTER)
    for _ in range(_MOST_SPEEDS):
        if state is None or part >= 1.0 or step < _LEAST_FASTER:
            break
        next_part = min(1.0, part * float(np.exp(step)))
        found = solved(next_part, state)
        if found.status == "converged":
            part, state, step = next_part, found.state, _GROWTH * step
        else:
            step *= _FALL
    return state if part >= 1.0 else None
