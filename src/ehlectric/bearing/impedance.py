"""Capacitance, admittance and impedance of a solved bearing from shaft to housing, and what a meter reads."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Numbers, where
from ehlectric.bearing.bearing_touching import RingDuty, duty_of
from ehlectric.bearing.circuit import Path, leaking_admittance, series
from ehlectric.bearing.solution import (
    BearingSolution,
    RingState,
    capacitance,
    capacitance_is_bound,
    conducts,
)
from ehlectric.discharge.discharge_laws import known, leakage
from ehlectric.discharge.film_capacitance import LEAST_RATIO, roughness_factor


def shaft_path(solution: BearingSolution) -> Path:
    """Circuit between shaft and housing of a solved bearing, next to its films."""
    bearing = solution.case.bearing
    coating = bearing.coating
    return Path(
        coating=bearing.coating_capacitance(),
        parallel=0.0 if bearing.parallel_capacitance is None else bearing.parallel_capacitance,
        resistance=math.inf if coating is None or coating.resistance is None else coating.resistance,
        coating_breakdown=None if coating is None else coating.voltage,
    )


def film_share(solution: BearingSolution) -> Numbers | None:
    """Share of the shaft voltage across the films of a solved bearing, dimensionless; 1 without a coating.

    None where surfaces touch, and where only an upper bound of the capacitance is known; of many points NaN
    where surfaces touch.
    """
    if capacitance_is_bound(solution):
        return None
    share = shaft_path(solution).film_share(capacitance(solution))
    return where(~np.asarray(conducts(solution)), share)


def shaft_capacitance(solution: BearingSolution) -> Numbers:
    """Capacitance from shaft to housing with smooth films, coating and parallel capacitance [F]."""
    return shaft_path(solution).total(capacitance(solution))


def rough_capacitance(solution: BearingSolution) -> Numbers | None:
    """Capacitance of the films with the roughness in their Hertz areas, mean over the positions of the cage.

    Returns capacitance [F]; None for ceramic elements; for results that do not have the capacitance of the
    Hertz areas; and where a loaded contact has a central film of less than twice ``composite_rq``, at which
    asperities touch.

    The capacitance of each Hertz area is multiplied by ``roughness_factor`` of central film thickness over
    ``composite_rq``. Around the Hertz areas the gap grows within a fraction of their size, and is taken as
    smooth.
    """
    if solution.conditions.ceramic:
        return None
    bearing = solution.case.bearing

    def of_contacts(quantity: Callable[[RingState], Array]) -> Array:
        """Quantity of all contacts, shape (2, ..., positions, n)."""
        rings = zip(*(position.rings for position in solution.positions), strict=True)
        return np.stack([np.stack([quantity(state) for state in ring], axis=-2) for ring in rings])

    rq = np.asarray(bearing.composite_rq)[..., np.newaxis, np.newaxis]
    ratio = of_contacts(lambda ring: ring.values.central_thickness) / rq
    hertz = of_contacts(lambda ring: ring.values.hertz)
    solved = of_contacts(lambda ring: ring.load) > 0.0
    # Axes of rings, positions and elements.
    known = ~np.any((solved & (ratio < LEAST_RATIO)) | np.isnan(hertz), axis=(0, -2, -1))
    if not np.any(known):
        return None
    smooth = of_contacts(lambda ring: ring.capacitance(bearing.fill))
    rough = smooth + hertz * (roughness_factor(np.maximum(ratio, LEAST_RATIO)) - 1.0)
    mean: Numbers = np.mean(np.sum(series(rough[0], rough[1]), axis=-1), axis=-1)
    return where(known, mean)


def meter_capacitance(solution: BearingSolution) -> Numbers | None:
    """Capacitance that a meter reads from shaft to housing, with rough films [F].

    None as ``rough_capacitance``. For ceramic elements it follows from ``element_capacitance``, and is None
    without this key.
    """
    return meter_reading(solution, rough_capacitance(solution))


def meter_reading(solution: BearingSolution, rough: Numbers | None) -> Numbers | None:
    """Capacitance that a meter reads [F], from the ``rough_capacitance`` of a solved bearing [F]."""
    if solution.conditions.ceramic:
        return None if capacitance_is_bound(solution) else shaft_capacitance(solution)
    return None if rough is None else shaft_path(solution).total(rough)


def mean_admittance(
    solution: BearingSolution, relaxation_time: float, frequency: Array, resistance: float
) -> Array:
    """Admittance from shaft to housing, mean over the time in which contacts are open and closed.
    ``relaxation_time``, charge relaxation time tau of the oil [s]; ``frequency`` [Hz], shape (m,);
    ``resistance``, resistance R of one closed contact [Ohm]. Returns admittance [S], mean over the positions
    of the cage, shape (m,).

    At each position it is (1 - s) Y_open + s Y_shorted with the share s of time in which an element touches
    both rings. A closed contact has 1/R in parallel to its film. Open, each element has the mean admittance
    of its states in which not both of its contacts are closed. Shorted, the elements have on average what
    makes the mean of their admittances exact. A coating is in series with each of both: that is approximate
    where several elements close at once. The mean is taken over the currents at a given sinusoidal voltage,
    so that a state has to last for many of its periods. What happens while a contact closes or opens is
    neglected: the charge of the film that passes through it, discharges as it opens, and the inductance of
    the path. Both diagonals of a four-point contact bearing count as elements of their own here.
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

    ``inner`` and ``outer`` are the admittances of the films, shape (m, n), and ``closed`` the admittance of a
    contact.
    """
    p, q = (ring.contact_time_share for ring in rings)
    both = p * q
    shares = (1.0 - p) * (1.0 - q), p * (1.0 - q), (1.0 - p) * q
    apart = series(inner, outer), series(inner + closed, outer), series(inner, outer + closed)
    mixed = sum(part * state for part, state in zip(shares, apart, strict=True))
    # An element that always touches both rings is never open: any admittance serves.
    opened = np.where(both < 1.0, mixed / np.maximum(1.0 - both, np.finfo(float).tiny), apart[0])
    through = series(inner + closed, outer + closed)
    share = float(1.0 - np.prod(1.0 - both))
    added = np.sum(both * (through - opened), axis=1) / share if share > 0.0 else 0.0
    films = np.sum(opened, axis=1)
    return share, films, films + added


# Frequencies reach up to at least _HIGHEST [Hz], and down to _BELOW_CORNER times the corner frequency of the
# oil; _COUNT is their number.
_HIGHEST, _BELOW_CORNER, _COUNT = 1e7, 1e-2, 400


@dataclass(frozen=True)
class Impedance:
    """Impedance of a bearing over frequency."""

    frequency: Array  # frequencies [Hz], shape (n,)
    # Impedance from shaft to housing, from the mean admittance of the films over the positions of the cage, a
    # coating in series, and a parallel capacitance [Ohm], shape (n,).
    values: Array
    corner: float  # corner frequency 1/(2 pi tau) of only the oil [Hz]
    # Reciprocal of the mean admittance over the time in which contacts are open and closed; None without
    # ``bearing.contact_resistance``
    mean: Impedance | None = None

    @property
    def magnitude(self) -> Array:
        """Magnitude of the impedance, abs(Z), shape (n,) [Ohm]."""
        return np.abs(self.values)

    @property
    def phase(self) -> Array:
        """Phase of the impedance, shape (n,) [degrees]: 0 for a resistor, -90 for a capacitor."""
        return np.degrees(np.angle(self.values))


def oil_relaxation_time(solution: BearingSolution) -> Numbers | None:
    """Charge relaxation time eps0 eps_r/sigma of a bearing's oil [s]; None without a conductivity."""
    return leakage(solution.case.discharge, solution.conditions.oil).relaxation_time


def impedance_of(solution: BearingSolution) -> Impedance | None:
    """Impedance of a solved bearing, with ``fill`` around its films, a coating and a parallel capacitance.
    Returns None without a conductivity, for ceramic elements, and where surfaces touch unless the case has
    the resistance of a closed contact; ``values`` are the values of the smooth films, as if none touched.
    """
    tau = known(float, oil_relaxation_time(solution))
    resistance = solution.case.bearing.contact_resistance
    if tau is None or solution.conditions.ceramic:
        return None
    if resistance is None and conducts(solution):
        return None
    corner = 1.0 / (2.0 * np.pi * tau)
    frequency = np.geomspace(_BELOW_CORNER * corner, max(_HIGHEST, corner / _BELOW_CORNER), _COUNT)
    fill = solution.case.bearing.fill
    y = np.zeros(frequency.shape, dtype=complex)
    for position in solution.positions:
        inner, outer = position.capacitances(fill)
        y = y + leaking_admittance(inner, outer, tau, frequency)
    films = y / len(solution.positions)
    mean = None
    if resistance is not None:
        mean = Impedance(frequency, 1.0 / mean_admittance(solution, tau, frequency, resistance), corner)
    return Impedance(frequency, 1.0 / shaft_path(solution).admittance(films, frequency), corner, mean)
