"""Capacitances of a solved bearing from shaft to housing: with smooth films, and as a meter reads them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.circuit import series
from ehlectric.bearing.meter.path import Path, path_of
from ehlectric.bearing.solution import (
    BearingSolution,
    RingState,
    capacitance,
    capacitance_is_bound,
    lubrication,
)
from ehlectric.discharge.roughness_factor import LEAST_RATIO, roughness_factor


def shaft_path(solution: BearingSolution) -> Path:
    """Circuit between shaft and housing of a solved bearing, beside its films."""
    return path_of(solution.case.bearing)


def film_share(solution: BearingSolution) -> float | None:
    """Share of the shaft voltage across the films of a solved bearing, dimensionless; 1 without a coating.

    None where surfaces touch, and where only an upper bound of the capacitance is known.
    """
    if lubrication(solution) == "conducting" or capacitance_is_bound(solution):
        return None
    return shaft_path(solution).film_share(capacitance(solution))


def shaft_capacitance(solution: BearingSolution) -> float:
    """Capacitance from shaft to housing with smooth films, coating and parallel capacitance [F]."""
    return shaft_path(solution).total(capacitance(solution))


def rough_capacitance(solution: BearingSolution) -> float | None:
    """Capacitance of the films with the roughness in their Hertz areas, mean over the positions of the cage.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    float or None
        Capacitance [F]. None for ceramic elements; for results that do not have the capacitance of the Hertz
        areas; and where a loaded contact has a central film of less than twice ``composite_rq``, at which
        asperities touch.

    Notes
    -----
    The capacitance of each Hertz area is multiplied by ``roughness_factor`` of central film thickness over
    ``composite_rq``. Around the Hertz areas the gap grows within a fraction of their size, and is taken as
    smooth.
    """
    if solution.conditions.ceramic:
        return None
    bearing = solution.case.bearing

    def of_contacts(quantity: Callable[[RingState], Array]) -> Array:
        """Quantity of all contacts, shape (positions, 2, n)."""
        return np.array([[quantity(ring) for ring in position.rings] for position in solution.positions])

    ratio = of_contacts(lambda ring: ring.values.central_thickness) / bearing.composite_rq
    hertz = of_contacts(lambda ring: ring.values.hertz)
    solved = of_contacts(lambda ring: ring.load) > 0.0
    if np.any(ratio[solved] < LEAST_RATIO) or np.any(np.isnan(hertz)):
        return None
    smooth = of_contacts(lambda ring: ring.capacitance(bearing.fill))
    rough = smooth + hertz * (roughness_factor(ratio) - 1.0)
    return float(np.mean(np.sum(series(rough[:, 0], rough[:, 1]), axis=1)))


def meter_capacitance(solution: BearingSolution) -> float | None:
    """Capacitance that a meter reads from shaft to housing, with rough films.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    float or None
        Capacitance [F]; None as ``rough_capacitance``. For ceramic elements it follows from
        ``element_capacitance``, and is None without this key.
    """
    return meter_reading(solution, rough_capacitance(solution))


def meter_reading(solution: BearingSolution, rough: float | None) -> float | None:
    """Capacitance that a meter reads [F], from the ``rough_capacitance`` of a solved bearing [F]."""
    if solution.conditions.ceramic:
        return None if capacitance_is_bound(solution) else shaft_capacitance(solution)
    return None if rough is None else shaft_path(solution).total(rough)
