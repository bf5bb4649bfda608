"""Time in which the film of the most loaded contact halves if no oil returns to its track."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ehlectric.bearing.conditions import BearingConditions
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.bearing.solution import BearingSolution, RingState
from ehlectric.cases.bearings.bearing import ROLLERS
from ehlectric.formulas.replenishment import decay_rate, film_half_time


def half_time(solution: BearingSolution) -> float | None:
    """Time [s] after which the film of the most loaded contact of a ring has halved without supply.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    float or None
        Smaller time of both rings; None for a flooded bearing, whose tracks are filled up at every passage,
        and for rollers, from whose contacts hardly any oil flows to the sides.

    Notes
    -----
    All contacts are taken as loaded like the most loaded one, so that real films decay more slowly.
    """
    bearing = solution.case.bearing
    if bearing.supply == "flooded" or bearing.kind == ROLLERS:
        return None
    rings = zip((solution.inner, solution.outer), solution.positions[0].rings, strict=True)
    return min(_half_time(ring, state) for ring, state in rings)


def _half_time(ring: RingContacts[Any], state: RingState) -> float:
    """Time in which the most loaded film of a ring halves [s]."""
    most, values = int(np.argmax(state.load)), state.values
    axes = float(values.semi_axis_x[most]), float(values.semi_axis_y[most])
    return contact_half_time(
        ring, float(values.max_pressure[most]), axes, float(values.central_thickness[most])
    )


def contact_half_time(
    ring: RingContacts[Any], max_pressure: float, semi_axes: tuple[float, float], thickness: float
) -> float:
    """Time in which the film of a contact with a ring halves if no oil returns to its track [s].

    Parameters
    ----------
    ring : RingContacts
        Contacts with the ring, with their oil.
    max_pressure : float
        Hertz pressure of the contact [Pa].
    semi_axes : tuple of float
        Semi-axes of the contact along and across the track [m].
    thickness : float
        Central film thickness at the start [m].
    """
    rate = decay_rate(
        max_pressure=max_pressure,
        semi_axes=semi_axes,
        viscosity=ring.oil.viscosity,
        pressure_viscosity_coefficient=ring.oil.alpha_star,
        density_ratio=float(ring.oil.density_ratio(max_pressure)[0]),
        track_length=track_length(ring.conditions, ring.angle, inner=ring.inner),
    )
    return float(film_half_time(thickness, rate))


def track_length(conditions: BearingConditions[Any], angle: float, *, inner: bool) -> float:
    """Length of track on both surfaces from which one contact with a ring presses oil [m].

    All Z contacts with the ring share its track of the length pi (d_m -+ D cos a), and both contacts of an
    element share that of the length pi D on its surface.
    """
    bearing = conditions.bearing
    sign = -1.0 if inner else 1.0
    race = bearing.pitch_diameter + sign * bearing.element_diameter * math.cos(angle)
    return math.pi * (race / bearing.elements + 0.5 * bearing.element_diameter)
