"""Impedance of a solved bearing from shaft to housing over frequency, with the conductivity of its oil."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.circuit import leaking_admittance
from ehlectric.bearing.intermittency.admittance import mean_admittance
from ehlectric.bearing.meter.reading import shaft_path
from ehlectric.bearing.solution import BearingSolution, lubrication
from ehlectric.discharge.leakage import leakage

# Frequencies reach up to at least _HIGHEST [Hz], and down to _BELOW_CORNER times the corner frequency of the
# oil; _COUNT is their number.
_HIGHEST, _BELOW_CORNER, _COUNT = 1e7, 1e-2, 400


@dataclass(frozen=True)
class Impedance:
    """Impedance of a bearing over frequency.

    Attributes
    ----------
    frequency : ndarray, shape (n,)
        Frequencies [Hz].
    values : ndarray of complex, shape (n,)
        Impedance from shaft to housing, from the mean admittance of the films over the positions of the cage,
        a coating in series, and a parallel capacitance [Ohm].
    corner : float
        Corner frequency 1/(2 pi tau) of the oil alone [Hz]. A bearing filled with oil has the same corner
        frequency; air around the films, which does not conduct, and a parallel capacitance make it lower.
    mean : Impedance or None
        Reciprocal of the mean admittance over the time in which contacts are open and closed; None without
        ``bearing.contact_resistance``.
    """

    frequency: Array
    values: Array
    corner: float
    mean: Impedance | None = None

    @property
    def magnitude(self) -> Array:
        """Magnitude of the impedance, abs(Z), shape (n,) [Ohm]."""
        return np.abs(self.values)

    @property
    def phase(self) -> Array:
        """Phase of the impedance, shape (n,) [degrees]: 0 for a resistor, -90 for a capacitor."""
        return np.degrees(np.angle(self.values))


def oil_relaxation_time(solution: BearingSolution) -> float | None:
    """Charge relaxation time eps0 eps_r/sigma of a bearing's oil [s]; None without a conductivity."""
    return leakage(solution.case.discharge, solution.conditions.oil).relaxation_time


def impedance_of(solution: BearingSolution) -> Impedance | None:
    """Impedance of a solved bearing, with ``fill`` around its films, a coating and a parallel capacitance.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    Impedance or None
        None without a conductivity, for ceramic elements, and where surfaces touch unless the case has the
        resistance of a closed contact. ``values`` are those of the smooth films, as if none touched.
    """
    tau, resistance = oil_relaxation_time(solution), solution.case.bearing.contact_resistance
    if tau is None or solution.conditions.ceramic:
        return None
    if resistance is None and lubrication(solution) == "conducting":
        return None
    corner = 1.0 / (2.0 * np.pi * tau)
    frequency = np.geomspace(_BELOW_CORNER * corner, max(_HIGHEST, corner / _BELOW_CORNER), _COUNT)
    fill = solution.case.bearing.fill
    y = np.zeros(frequency.shape, dtype=complex)
    for position in solution.positions:
        inner, outer = ((ring.capacitance(fill), ring.oil_capacitance(fill)) for ring in position.rings)
        y = y + leaking_admittance(inner, outer, tau, frequency)
    films = y / len(solution.positions)
    mean = None
    if resistance is not None:
        mean = Impedance(frequency, 1.0 / mean_admittance(solution, tau, frequency, resistance), corner)
    return Impedance(frequency, 1.0 / shaft_path(solution).admittance(films, frequency), corner, mean)
