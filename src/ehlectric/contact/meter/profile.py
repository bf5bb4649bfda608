"""Where a meter sees the capacitance: its sum over all places up to a distance from the contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.contact.meter.reading import Metered


@dataclass(frozen=True)
class MeterProfile:
    """Capacitance between the bodies up to a distance from the contact, without what lies in parallel.

    Attributes
    ----------
    radius : ndarray, shape (n,)
        Distance from the middle of the contact, increasing [m].
    filled, air, oil : ndarray, shape (n,)
        Capacitance up to this distance, with the gap outside the domain filled as the case says, with air,
        and with oil [F].
    edge : float
        Smallest distance of the edge of the film's domain from the contact [m].
    """

    radius: Array
    filled: Array
    air: Array
    oil: Array
    edge: float


def meter_profile(contact: Metered, distances: int = 80) -> MeterProfile:
    """Capacitance between the bodies of a solved contact up to a distance from it.

    Parameters
    ----------
    contact : Metered
        Solved contact, whose case has a table ``meter``.
    distances : int
        Number of distances, in equal ratios.

    Returns
    -------
    MeterProfile
        Capacitance [F] over distance [m]. The last values are those of the whole gap.
    """
    coating = contact.layers.coating
    near, within = contact.nodes()
    outside = {
        "filled": contact.filled(coating),
        "air": contact.outside(1.0, coating),
        "oil": contact.outside(contact.case.oil.relative_permittivity, coating),
    }
    edges = [abs(float(end)) for axis in contact.film.axes for end in (axis[0], axis[-1])]
    farthest = max(float(np.max(at)) for at, _ in ((near, within), *outside.values()))
    radius = np.geomspace(0.05 * min(contact.conditions.semi_axes), farthest, distances)
    inner = _up_to(radius, near, within)
    return MeterProfile(
        radius=radius,
        **{name: inner + _up_to(radius, at, values) for name, (at, values) in outside.items()},
        edge=min(edges),
    )


def _up_to(radius: Array, at: Array, values: Array) -> Array:
    """Sum of the values at distances up to each radius; at the distance of a node half of its value."""
    order = np.argsort(at)
    sums = np.cumsum(values[order])
    total: Array = np.interp(radius, at[order], sums - 0.5 * values[order], left=0.0)
    return np.where(radius >= at[order][-1], sums[-1], total)
