"""Course of the solution of a film whose surfaces may touch, on one grid: starts, and the way in time.

Newton's method converges from different starts at different speeds. Where the oil carries part of the load,
the dry contact with its pressure carried by the oil is near enough, since it has the shape that the surfaces
take. Where it carries hardly any, the dry contact itself is. In between, the film is followed in time from
the dry contact on (``ehlectric.film.mixed.filling``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ehlectric.arrays import Array
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mixed.dry import dry_contact, relieved
from ehlectric.film.mixed.filling import filled_film
from ehlectric.film.mixed.newton import mixed_newton
from ehlectric.film.mixed.touching import Asperities
from ehlectric.film.state import GridSolution, Progress, State

# Damping of the first step from a state that is likely to be close.
NEAR_DAMPING = 0.1

# Multiple of the largest number of Newton steps from each start, for the film that is followed in time.
_IN_TIME = 8


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
        close = [near]
        if levels[0].mesh.y.size > 1:
            close.insert(0, relieved(levels[0], near, asperities.boundary_film))
        for start in close:
            yield (found := solved(start, NEAR_DAMPING))
            if found.status == "converged":
                return
        if not thorough:
            return
    ambient = fluid.ambient_pressure
    dry = dry_contact(levels[0], dry_pressure, asperities.boundary_film, ambient)
    starts = [replace(dry, contact_pressure=0.0), dry]
    for start in starts if film_guess > asperities.boundary_film else starts[::-1]:
        yield (found := solved(start))
        if found.status == "converged" or not thorough:
            return
    yield filled_film(
        fluid,
        levels,
        dry,
        asperities=asperities,
        tolerance=tolerance,
        max_iterations=_IN_TIME * max_iterations,
        progress=progress,
    )
