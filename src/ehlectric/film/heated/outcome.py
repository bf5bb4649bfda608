"""Conversion of a heated or sheared film to SI units at the nodes of the whole domain."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.film.heated.nested import HeatedSolution
from ehlectric.film.state import Status
from ehlectric.film.thermal.result import HeatedFilm


def film_status_of(found: HeatedSolution, status: Status) -> Status:
    """Status of a film, "converged" only if its temperature converged with it and its surfaces are apart.

    The equations of heat and shear know no surfaces that touch: a film thinner than the boundary film is no
    solution of them.
    """
    if status != "converged":
        return status
    pierced = float(np.min(found.refined.last.state.thickness)) < found.refined.problem.boundary_film
    return "stalled" if pierced else found.status


def heated_film(
    found: HeatedSolution,
    shaped: Callable[[NDArray[Any]], NDArray[Any]],
    *,
    status: Status,
    minimum_thickness: float | None,
    central_thickness: float | None,
) -> HeatedFilm:
    """Heat and shear of a solution, at the nodes of the whole domain.

    Parameters
    ----------
    found : HeatedSolution
        Film with its temperature and shear stress.
    shaped : callable
        Function that brings nodal values (nx, ny) into their shape in the film.
    status : str
        Status of the film; without "converged" it has no friction.
    minimum_thickness, central_thickness : float or None
        Film thicknesses without heat and shear [m]; None if the film without them did not converge.

    Returns
    -------
    HeatedFilm
        Nodal values and totals, SI units.
    """
    physics = found.refined.problem.physics
    assert physics is not None
    converged = status == "converged"
    rows, bodies = found.temperature, () if physics.thermal is None else physics.thermal.bodies
    # Equal surfaces drag none of each other. The iteration leaves a stress of its tolerance.
    alike = physics.slide_to_roll_ratio == 0.0 and len(set(bodies)) <= 1
    return HeatedFilm(
        rheology=physics.rheology.name,
        # A slide-to-roll ratio is positive where surface 1 is the faster one.
        shear_stress=-shaped(found.shear_stress),
        traction_coefficient=(0.0 if alike else -found.traction_coefficient) if converged else None,
        rolling_coefficient=found.rolling_coefficient if converged else None,
        power_loss=found.power_loss if converged else None,
        isothermal_minimum_thickness=minimum_thickness,
        isothermal_central_thickness=central_thickness,
        outer_iterations=found.outer_iterations,
        zeta=None if rows is None else found.zeta,
        temperature=None if rows is None else np.stack([shaped(row) for row in rows]),
        mid_temperature=None if found.mid_temperature is None else shaped(found.mid_temperature),
        max_temperature_rise=found.max_temperature_rise,
        temperature_rise_error=found.temperature_rise_error,
        energy_imbalance=found.energy_imbalance,
    )
