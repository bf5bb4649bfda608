"""From a field to its discharge: breakdown voltage and probability, energy, pit, leakage. SI units.

The field is linear in the voltage, so that one solution answers for every voltage.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array

# Lateral size of pits from discharges in bearings, the largest and the mean [m].
LARGEST_PIT, MEAN_PIT = 4.0e-6, 1.7e-6

# Film thickness below which electrons tunnel through it in numbers [m].
TUNNELLING = 2e-9

# Apparent current density above which bearings suffer, peak current over Hertz area [A/m^2].
CURRENT_DENSITY_LIMITS = (1e5, 3e5, 8e5)
_PITS = "Plazenet et al., as quoted by Morris et al. (2022), doi:10.3390/lubricants10050087"

# Where the numbers come from that neither the case nor the solution gives, by the key they stand under.
SOURCES = {
    "zone_size": "assumption: where the strength is used to 95 % of the most",
    "zone_area": "assumption: as zone_size",
    "zone_over_half_width": "assumption: as zone_size",
    "zone_over_largest_pit": f"4 um: {_PITS}; assumption: as zone_size",
    "zone_over_mean_pit": f"1.7 um: {_PITS}; assumption: as zone_size",
    "capacitance": "of the domain of the film alone: that of a point contact grows with its logarithm",
    "capacitance_plate": "assumption: the Hertz area h(0) apart, permittivity at ambient pressure",
    "capacitance_ratio": "assumption: as capacitance_plate",
    "outlet": "assumption: what fills the gap behind the exit; its extremes stand beside it",
    "capacitance_outlet_full": "assumption: oil alone behind the exit, also where its mass does not do",
    "capacitance_outlet_fingers": "assumption: oil from wall to wall beside gas; its mass is conserved",
    "capacitance_outlet_layers": "assumption: oil on the walls and gas between; its mass is conserved",
    "discharge_energy": "assumption: all of the charge runs off in one spark",
    "breakdown_energy": "assumption: all of the charge runs off in one spark",
    "pit_volume": "assumption: the energy at the voltage of the case, efficiency and melting energy as given",
    "pit_diameter": "assumption: a hemisphere",
    "current_density_limits": (
        "0.1 to 0.3 A/mm^2: Lubricants 12 (2024) 148, doi:10.3390/lubricants12050148; 0.8 A/mm^2: Busse et "
        "al. (1997), as quoted by Morris et al. (2022), who print it in A/m^2"
    ),
    "relaxation_time": "assumption: permittivity at ambient pressure, conductivity as given, at any pressure",
    "corner_frequency": "assumption: as relaxation_time",
}

# The zone that breaks first is where the strength is used to at least this part of the most.
BREAKING = 0.95


def breakdown_voltage(voltage: float, strength: Array, dielectric_strength: Array | float) -> float:
    """Voltage at which the field reaches the dielectric strength somewhere.

    V_b = V/max(E/E_b)

    Parameters
    ----------
    voltage : float
        V, at which the field was solved [V].
    strength : ndarray, shape (...)
        Field strength E [V/m].
    dielectric_strength : ndarray or float
        E_b of the same places [V/m].

    Returns
    -------
    float
        [V].

    Examples
    --------
    >>> breakdown_voltage(2.0, np.array([5e6, 10e6]), 15e6)
    3.0
    """
    return float(voltage / np.max(strength / dielectric_strength))


@dataclass(frozen=True)
class WeakestLink:
    """Weibull's law for a solved field: P(V) = 1 - exp(-(V/V_0)^m).

    The exponent is the integral of (E/E_0)^m dA/A_0, and E grows with V, so that all of the field enters
    through ``characteristic_voltage``. A larger stressed area is more likely to break.

    W. Weibull, J. Appl. Mech. 18 (1951) 293, doi:10.1115/1.4010337.

    Attributes
    ----------
    shape : float
        m.
    characteristic_voltage : float
        V_0, at which the probability is 1 - 1/e, 63.2 % [V].

    Examples
    --------
    A uniform field of half the scale over four reference areas, m = 2: the exponent is 1.

    >>> law = WeakestLink.of(10.0, np.full(4, 5e6), np.full(4, 1e-6), 10e6, 2.0, 1e-6)
    >>> law.characteristic_voltage, round(law.probability(10.0), 4)
    (10.0, 0.6321)
    """

    shape: float
    characteristic_voltage: float

    @classmethod
    def of(
        cls, voltage: float, strength: Array, areas: Array, scale: float, shape: float, reference_area: float
    ) -> WeakestLink:
        """The law of a field strength [V/m] at a voltage [V] over areas [m^2] of one shape."""
        largest = float(np.max(strength))
        # Of the largest field, whose power alone would overflow.
        area = float(np.vdot((strength / largest) ** shape, areas))
        return cls(shape, voltage * scale / largest * (reference_area / area) ** (1.0 / shape))

    def probability(self, voltage: float) -> float:
        """Probability of breakdown at a voltage [V], from 0 to 1."""
        with np.errstate(over="ignore", under="ignore"):
            exponent = np.power(voltage / self.characteristic_voltage, self.shape)
        return float(-np.expm1(-exponent))

    def voltage(self, probability: float) -> float:
        """Voltage [V] at which the probability of breakdown is this, above 0 and below 1."""
        exponent = -np.log1p(-probability)
        return float(self.characteristic_voltage * exponent ** (1.0 / self.shape))


def stored_energy(capacitance: float, voltage: float) -> float:
    """Energy of a charged capacitance, C V^2/2 [J].

    Examples
    --------
    >>> round(stored_energy(1e-9, 20.0) * 1e9, 9)
    200.0
    """
    return 0.5 * capacitance * voltage**2


def melted_volume(energy: float, efficiency: float, melting_energy: float) -> float:
    """Volume that a part of an energy heats and melts.

    Parameters
    ----------
    energy : float
        Of the discharge [J].
    efficiency : float
        Part of it that goes into melting one surface, from 0 to 1.
    melting_energy : float
        To heat and melt a volume [J/m^3].

    Returns
    -------
    float
        [m^3].

    Examples
    --------
    >>> round(melted_volume(1e-6, 0.2, 1e10) * 1e18, 9)
    20.0
    """
    return efficiency * energy / melting_energy


def pit_diameter(volume: float) -> float:
    """Diameter of a hemispherical pit of a volume [m^3]: V = pi d^3/12 [m].

    Examples
    --------
    >>> round(pit_diameter(np.pi / 12.0), 12)
    1.0
    """
    return float(np.cbrt(12.0 * volume / np.pi))


def relaxation_time(relative_permittivity: float, conductivity: float) -> float:
    """Time in which charge leaks through a dielectric, eps0 eps_r/sigma, of a conductivity in S/m [s].

    Above the frequency 1/(2 pi) of its inverse the film is a capacitor, below it a resistor.

    Examples
    --------
    >>> round(relaxation_time(2.4, 1e-12), 2)
    21.25
    """
    return epsilon_0 * relative_permittivity / conductivity
