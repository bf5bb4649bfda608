"""Physical bounds of a solved bearing: numbers outside of them are refused with the reason.

A number outside of its bounds is an error of the program or of an input. Such a number leaves no command as
a result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Booleans, Mask, Numbers, any_of
from ehlectric.bearing.bearing_discharges import first_margin
from ehlectric.bearing.solution import BearingSolution, RingState, capacitance
from ehlectric.constants import EPSILON_0
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.readable import readable


@dataclass(frozen=True)
class _Bound:
    """Bound of a number: which points are outside, and the error of a single bearing that is."""

    outside: Any  # shape (...)
    error: Callable[[], Exception]


def outside_bounds(solution: BearingSolution) -> Mask:
    """Whether a number of a solved bearing is outside of its physical bounds, shape (...)."""
    return np.asarray(any_of(*(bound.outside for bound in _bounds(solution))))


def check_bounds(solution: BearingSolution) -> None:
    """Refuse numbers of a single bearing that are outside of their physical bounds.

    Raises ConvergenceError for a film, a capacitance or a breakdown voltage without a value, for a film
    above the radius of an element, and for a capacitance above the capacitance of a plate at the minimum
    film. Raises InputError for a margin above ``MOST_MARGIN``.
    """
    for bound in _bounds(solution):
        if bound.outside:
            raise bound.error()


def _bounds(solution: BearingSolution) -> Iterator[_Bound]:
    """Bounds of films, capacitances, breakdown voltages, and of the margin."""
    for name, unknown in _unknown(solution):
        yield _Bound(unknown, partial(_no_value, name))
    rings = [ring for position in solution.positions for ring in position.rings]
    thickest = _largest(rings, lambda ring: np.where(ring.solved, ring.values.central_thickness, 0.0))
    radius = 0.5 * solution.case.bearing.element_diameter
    yield _Bound(
        thickest > radius,
        lambda: ConvergenceError(
            f"a film of {readable(float(thickest))} m in the bearing is above the radius of its elements, "
            f"{readable(radius)} m; "
            "the result is not used"
        ),
    )
    share = _largest(rings, lambda ring: ring.capacitance(1.0) / _plate(solution, ring))
    yield _Bound(
        share > 1.0,
        lambda: ConvergenceError(
            f"the capacitance of a contact is {readable(float(share))} times the capacitance of a plate at "
            "its minimum film; the result is not used"
        ),
    )
    margin = first_margin(solution)
    if margin is not None:
        yield _Bound(
            margin > MOST_MARGIN,
            lambda: InputError(
                "motor.common_mode_voltage",
                got=f"a margin of {readable(float(margin))}",
                takes=f"voltages and capacitances with a margin of at most {MOST_MARGIN:.0e}; check [motor] "
                "and the dielectric strength",
            ),
        )


def _unknown(solution: BearingSolution) -> Iterator[tuple[str, Booleans]]:
    """Names of main numbers, and whether they have no value, shape (...)."""
    yield "minimum film", ~np.isfinite(solution.least_film)
    yield "capacitance", ~np.isfinite(capacitance(solution))
    circuits = solution.circuits()
    # A breakdown voltage is infinite without a dielectric strength.
    yield "breakdown voltage", any_of(*(np.isnan(circuit.first_break) for circuit in circuits))


def _no_value(name: str) -> ConvergenceError:
    """Error of a single bearing with a main number that has no value."""
    return ConvergenceError(
        f"the {name} of the bearing has no value; the result is not used. Raise the load, or reduce the "
        "speed or the viscosity"
    )


def _largest(rings: list[RingState], quantity: Callable[[RingState], Array]) -> Numbers:
    """Largest value of all contacts at all positions of the cage, shape (...); NaN is ignored."""
    largest: Numbers = np.fmax.reduce([np.fmax.reduce(quantity(ring), axis=-1) for ring in rings])
    return largest


def _plate(solution: BearingSolution, ring: RingState) -> Array:
    """Capacitance of plates with half of the surface of an element at the minimum films [F]."""
    bearing = solution.case.bearing
    length = bearing.element_diameter if bearing.roller_length is None else bearing.roller_length
    area = 0.5 * np.pi * bearing.element_diameter * length
    plate = EPSILON_0 * solution.conditions.oil.relative_permittivity * np.asarray(area)
    return np.asarray(plate[..., np.newaxis] / ring.values.minimum_thickness)
