"""Impedance of a solved bearing over frequency, where its oil leaks. SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.circuit import leaking_admittance
from ehlectric.bearing.solution import BearingSolution, lubrication
from ehlectric.discharge.laws import relaxation_time

# Frequencies that it is given up to [Hz], and from, over that of the oil's corner; how many.
_HIGHEST, _BELOW_CORNER, _COUNT = 1e7, 1e-2, 400


@dataclass(frozen=True)
class Impedance:
    """Impedance of a bearing over frequency.

    Attributes
    ----------
    frequency : ndarray, shape (n,)
        [Hz].
    values : ndarray of complex, shape (n,)
        [Ohm], of the mean admittance over the positions of the cage.
    corner : float
        1/(2 pi tau) of the oil alone [Hz]: that of the bearing where the oil fills it, and above the
        bearing's own where there is air, which does not leak.
    """

    frequency: Array
    values: Array
    corner: float

    @property
    def magnitude(self) -> Array:
        """abs(Z) [Ohm]."""
        return np.abs(self.values)

    @property
    def phase(self) -> Array:
        """From 0, a resistor, to -90 degrees, a capacitor."""
        return np.degrees(np.angle(self.values))


def oil_relaxation_time(solution: BearingSolution) -> float | None:
    """Relaxation time eps0 eps_r/sigma of the oil of a bearing [s]; None without a conductivity."""
    conductivity = solution.case.discharge.conductivity
    permittivity = solution.conditions.lubricant.relative_permittivity
    return None if conductivity is None else relaxation_time(permittivity, conductivity)


def impedance_of(solution: BearingSolution) -> Impedance | None:
    """Impedance of a bearing, around its films what ``fill`` says.

    Parameters
    ----------
    solution : BearingSolution
        A solved bearing.

    Returns
    -------
    Impedance or None
        None without a conductivity, where surfaces touch, and of ceramic elements.
    """
    tau = oil_relaxation_time(solution)
    if tau is None or solution.conditions.ceramic or lubrication(solution) == "conducting":
        return None
    corner = 1.0 / (2.0 * np.pi * tau)
    frequency = np.geomspace(_BELOW_CORNER * corner, max(_HIGHEST, corner / _BELOW_CORNER), _COUNT)
    fill = solution.case.bearing.fill
    y = np.zeros(frequency.shape, dtype=complex)
    for position in solution.positions:
        inner, outer = (
            (ring.capacitance(fill), ring.capacitance("oil") if fill == "oil" else ring.values.inside)
            for ring in position.rings
        )
        y = y + leaking_admittance(inner, outer, tau, frequency)
    return Impedance(frequency, len(solution.positions) / y, corner)
