"""Mean admittance of a bearing whose contacts close at times."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.intermittency.duty import RingDuty, duty_of
from ehlectric.bearing.meter.reading import shaft_path
from ehlectric.bearing.solution import BearingSolution


def mean_admittance(
    solution: BearingSolution, relaxation_time: float, frequency: Array, resistance: float
) -> Array:
    """Admittance from shaft to housing, mean over the time in which contacts are open and closed.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing with conducting elements.
    relaxation_time : float
        Charge relaxation time tau of the oil [s].
    frequency : ndarray, shape (m,)
        Frequency f [Hz].
    resistance : float
        Resistance R of one closed contact [Ohm].

    Returns
    -------
    ndarray of complex, shape (m,)
        Admittance [S], mean over the positions of the cage.

    Notes
    -----
    At each position it is (1 - s) Y_open + s Y_shorted with the share s of time in which an element touches
    both rings. A closed contact has 1/R beside its film. Open, each element has the mean admittance of its
    states in which not both of its contacts are closed. Shorted, the elements have on average what makes the
    mean of their admittances exact. A coating is in series with each of both: that is approximate where
    several elements close at once. The mean is that of the currents at a given sinusoidal voltage, so that a
    state has to last for many of its periods. What happens while a contact closes or opens is neglected:
    the charge of the film that passes through it, discharges as it opens, and the inductance of the path.
    """
    path, fill = shaft_path(solution), solution.case.bearing.fill
    omega = 2.0 * np.pi * frequency[:, np.newaxis]
    total = np.zeros(frequency.shape, dtype=complex)
    for position, rings in zip(solution.positions, duty_of(solution).rings, strict=True):
        films: list[Array] = [
            np.add(1j * omega * ring.capacitance(fill), ring.oil_capacitance(fill) / relaxation_time)
            for ring in position.rings
        ]
        share, opened, shorted = _states(films[0], films[1], rings, 1.0 / resistance)
        total += (1.0 - share) * path.admittance(opened, frequency)
        total += share * path.admittance(shorted, frequency)
    return total / len(solution.positions)


def _states(
    inner: Array, outer: Array, rings: tuple[RingDuty, RingDuty], closed: float
) -> tuple[float, Array, Array]:
    """Share of time in which a bearing is shorted, and its mean admittance open and shorted [S].

    ``inner`` and ``outer`` are the admittances of the films, shape (m, n), and ``closed`` that of a contact.
    """
    p, q = (ring.contact_time_share for ring in rings)
    both = p * q
    shares = (1.0 - p) * (1.0 - q), p * (1.0 - q), (1.0 - p) * q
    apart = (
        _series(inner, outer),
        _series(inner + closed, outer),
        _series(inner, outer + closed),
    )
    mixed = sum(part * state for part, state in zip(shares, apart, strict=True))
    # An element that always touches both rings is never open: any admittance does in its place.
    opened = np.where(both < 1.0, mixed / np.maximum(1.0 - both, np.finfo(float).tiny), apart[0])
    through = _series(inner + closed, outer + closed)
    share = float(1.0 - np.prod(1.0 - both))
    added = np.sum(both * (through - opened), axis=1) / share if share > 0.0 else 0.0
    films = np.sum(opened, axis=1)
    return share, films, films + added


def _series(first: Array, second: Array) -> Array:
    """Admittance of two admittances in series."""
    return first * second / (first + second)
