"""Elastic rings under pressure, and the radial clearance of a bearing from fits and temperatures.

Dimensions, pressures and temperatures are floats, or arrays of shape (...) of many points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Numbers, as_float


@dataclass(frozen=True)
class ThickRing:
    """Plain ring, shaft or housing of one material, in plane stress.

    With the pressures p_i in the bore d and p_o on the outside D, Lame's solution for a ring whose faces are
    free (plane stress) has the circumferential strain

        E e(r) = (1 - nu) (p_i d^2 - p_o D^2)/(D^2 - d^2)
                 + (1 + nu) (p_i - p_o) d^2 D^2/(D^2 - d^2)/(2 r)^2,

    and a diameter 2 r grows by 2 r e(r). R. Beardmore, Roymech, "Cylinders",
    http://www.roymech.co.uk/Useful_Tables/Mechanics/Cylinders.html, derives the same equations.
    """

    inner_diameter: Numbers  # diameter of the bore [m]; 0 for a solid shaft
    outer_diameter: Numbers  # outer diameter [m]; infinite for a housing without an end
    youngs_modulus: float  # young's modulus E [Pa]
    poissons_ratio: float  # poisson's ratio, dimensionless
    expansion: float  # coefficient of thermal expansion [1/K]

    def growth(
        self, diameter: Numbers, *, bore_pressure: Numbers = 0.0, outside_pressure: Numbers = 0.0
    ) -> Numbers:
        """Growth of a diameter of the ring under pressure from inside and from outside. ``diameter``,
        diameter in the ring [m], from the bore to the outer diameter; ``bore_pressure`` and
        ``outside_pressure`` [Pa]. Returns change of the diameter [m], negative where it shrinks.

        Examples
        --------
        A thin ring of 1 m and 10 mm grows by p d^2/(2 t E), here 1 MPa (1 m)^2/(20 mm 200 GPa):

        >>> thin = ThickRing(1.0, 1.02, 200e9, 0.3, 12e-6)
        >>> round(1e6 * thin.growth(1.0, bore_pressure=1e6))
        254
        """
        square = self.inner_diameter**2
        ratio = (self.inner_diameter / self.outer_diameter) ** 2
        mean = (bore_pressure * ratio - outside_pressure) / (1.0 - ratio)
        # A solid shaft has no second term, and its centre a diameter of 0.
        around = as_float(np.where(np.equal(square, 0.0), 1.0, diameter))
        other = (bore_pressure - outside_pressure) * square / (1.0 - ratio) / around
        nu = self.poissons_ratio
        return ((1.0 - nu) * mean * diameter + (1.0 + nu) * other) / self.youngs_modulus

    def warmed(self, diameter: Numbers, rise: Numbers) -> Numbers:
        """Growth of a diameter [m] of the free ring under a rise of its temperature [K]."""
        return self.expansion * rise * diameter


def fit_pressure(within: ThickRing, around: ThickRing, interference: Numbers) -> Numbers:
    """Pressure in an interference fit of two rings. ``interference``, diameter of the inner one less the bore
    of the outer one, both free [m]; negative for a loose fit. Returns pressure [Pa]; 0 for a loose fit.

    The pressure at which the bore of the outer one grows, and the outside of the inner one shrinks, by the
    interference together.

    Examples
    --------
    For a solid shaft and a ring of the same material, p = E delta (1 - d^2/D^2)/(2 d):

    >>> shaft = ThickRing(0.0, 40e-3, 208e9, 0.3, 12.5e-6)
    >>> ring = ThickRing(40e-3, 48e-3, 208e9, 0.3, 12.5e-6)
    >>> pressure = fit_pressure(shaft, ring, 10e-6)
    >>> round(pressure / (208e9 * 10e-6 * (1 - (40 / 48) ** 2) / (2 * 40e-3)), 12)
    1.0
    """
    diameter = around.inner_diameter
    compliance = around.growth(diameter, bore_pressure=1.0) - within.growth(
        within.outer_diameter, outside_pressure=1.0
    )
    return as_float(np.maximum(interference, 0.0) / compliance)


@dataclass(frozen=True)
class Temperatures:
    """Temperatures of the parts of a mounted bearing, absolute."""

    # inner_ring, outer_ring, elements, shaft and housing: mean temperatures of the parts [K].
    inner_ring: Numbers
    outer_ring: Numbers
    elements: Numbers
    shaft: Numbers
    housing: Numbers

    @classmethod
    def same(cls, temperature: Numbers) -> Temperatures:
        """One temperature [K] of all parts."""
        return cls(temperature, temperature, temperature, temperature, temperature)


@dataclass(frozen=True)
class Mounting:
    """Bearing between its shaft and its housing, with all dimensions at the reference temperature."""

    # shaft, inner_ring, outer_ring and housing: parts, each of its own diameters when free. A ring ends at
    # its raceway: shoulders and the depth of the groove are neglected.
    shaft: ThickRing
    inner_ring: ThickRing
    outer_ring: ThickRing
    housing: ThickRing
    element_diameter: Numbers  # diameter of the rolling elements [m]
    element_expansion: float  # coefficient of thermal expansion of the rolling elements [1/K]
    # Effective interference of inner ring and shaft on the diameter [m]; negative for a loose fit.
    shaft_interference: Numbers
    # Effective interference of outer ring and housing on the diameter [m]; negative for a loose fit.
    housing_interference: Numbers
    reference_temperature: Numbers  # temperature of the dimensions and interferences [K]

    @property
    def unmounted_clearance(self) -> Numbers:
        """Clearance before mounting at the reference temperature: the room next to two elements [m]."""
        return self.outer_ring.inner_diameter - self.inner_ring.outer_diameter - 2.0 * self.element_diameter

    def interferences(self, temperatures: Temperatures) -> tuple[Numbers, Numbers]:
        """Interferences of inner ring and shaft, and of outer ring and housing [m], at temperatures."""
        zero = self.reference_temperature
        bore, outside = self.inner_ring.inner_diameter, self.outer_ring.outer_diameter
        on_shaft = self.shaft.warmed(bore, temperatures.shaft - zero)
        on_shaft -= self.inner_ring.warmed(bore, temperatures.inner_ring - zero)
        in_housing = self.outer_ring.warmed(outside, temperatures.outer_ring - zero)
        in_housing -= self.housing.warmed(outside, temperatures.housing - zero)
        return self.shaft_interference + on_shaft, self.housing_interference + in_housing


@dataclass(frozen=True)
class Clearance:
    """Radial clearance of a mounted bearing at some temperatures."""

    clearance: Numbers  # full diametral play [m]; negative with a preload
    # shaft_interference and housing_interference: interferences at the temperatures [m]; negative where the
    # fit is loose.
    shaft_interference: Numbers
    housing_interference: Numbers
    # shaft_pressure and housing_pressure: pressures between inner ring and shaft, and between outer ring and
    # housing [Pa].
    shaft_pressure: Numbers
    housing_pressure: Numbers


def clearance_at(mounting: Mounting, temperatures: Temperatures) -> Clearance:
    """Radial clearance of a mounted bearing at the temperatures of its parts, and the state of both fits.

    Every part expands freely with its own temperature, which changes both interferences. The pressures of the
    fits widen the inner raceway and narrow the outer one. Stresses and expansions are small, so both add up.

    Examples
    --------
    A steel bearing whose inner ring is 10 K warmer loses 10 K 12.5e-6/K 48 mm = 6 um of its clearance, and
    1.5 um by its elements, which are 5 K warmer:

    >>> steel = 208e9, 0.3, 12.5e-6
    >>> mounting = Mounting(
    ...     shaft=ThickRing(0.0, 40e-3, *steel),
    ...     inner_ring=ThickRing(40e-3, 48e-3, *steel),
    ...     outer_ring=ThickRing(72.02e-3, 80e-3, *steel),
    ...     housing=ThickRing(80e-3, 120e-3, *steel),
    ...     element_diameter=12e-3,
    ...     element_expansion=12.5e-6,
    ...     shaft_interference=0.0,
    ...     housing_interference=0.0,
    ...     reference_temperature=293.15,
    ... )
    >>> warm = Temperatures(303.15, 293.15, 298.15, 303.15, 293.15)
    >>> round(1e6 * clearance_at(mounting, warm).clearance, 3)
    12.5
    """
    inner, outer, zero = mounting.inner_ring, mounting.outer_ring, mounting.reference_temperature
    inner_rise, outer_rise = temperatures.inner_ring - zero, temperatures.outer_ring - zero
    on_shaft, in_housing = mounting.interferences(temperatures)
    shaft_pressure = fit_pressure(mounting.shaft, inner, on_shaft)
    housing_pressure = fit_pressure(outer, mounting.housing, in_housing)
    element = mounting.element_expansion * (temperatures.elements - zero) * mounting.element_diameter
    clearance = (
        mounting.unmounted_clearance
        + outer.warmed(outer.inner_diameter, outer_rise)
        + outer.growth(outer.inner_diameter, outside_pressure=housing_pressure)
        - inner.warmed(inner.outer_diameter, inner_rise)
        - inner.growth(inner.outer_diameter, bore_pressure=shaft_pressure)
        - 2.0 * element
    )
    return Clearance(clearance, on_shaft, in_housing, shaft_pressure, housing_pressure)
