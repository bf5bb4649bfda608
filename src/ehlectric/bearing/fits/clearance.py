"""Radial clearance of a bearing in operation, from the clearance before mounting, fits and temperatures."""

from __future__ import annotations

from dataclasses import dataclass

from ehlectric.bearing.fits.thick_ring import ThickRing, fit_pressure


@dataclass(frozen=True)
class Temperatures:
    """Temperatures of the parts of a mounted bearing, absolute.

    Attributes
    ----------
    inner_ring, outer_ring, elements, shaft, housing : float
        Mean temperatures of the parts [K].
    """

    inner_ring: float
    outer_ring: float
    elements: float
    shaft: float
    housing: float

    @classmethod
    def same(cls, temperature: float) -> Temperatures:
        """One temperature [K] of all parts."""
        return cls(temperature, temperature, temperature, temperature, temperature)


@dataclass(frozen=True)
class Mounting:
    """Bearing between its shaft and its housing, with all dimensions at the reference temperature.

    Attributes
    ----------
    shaft, inner_ring, outer_ring, housing : ThickRing
        Parts, each of its own diameters when free. A ring ends at its raceway: shoulders and the depth of the
        groove are left out.
    element_diameter : float
        Diameter of the rolling elements [m].
    element_expansion : float
        Coefficient of thermal expansion of the rolling elements [1/K].
    shaft_interference : float
        Effective interference of inner ring and shaft on the diameter [m]; negative for a loose fit.
    housing_interference : float
        Effective interference of outer ring and housing on the diameter [m]; negative for a loose fit.
    reference_temperature : float
        Temperature of the dimensions and interferences [K].
    """

    shaft: ThickRing
    inner_ring: ThickRing
    outer_ring: ThickRing
    housing: ThickRing
    element_diameter: float
    element_expansion: float
    shaft_interference: float
    housing_interference: float
    reference_temperature: float

    @property
    def unmounted_clearance(self) -> float:
        """Clearance before mounting at the reference temperature: the room beside two elements [m]."""
        return self.outer_ring.inner_diameter - self.inner_ring.outer_diameter - 2.0 * self.element_diameter

    def interferences(self, temperatures: Temperatures) -> tuple[float, float]:
        """Interferences of inner ring and shaft, and of outer ring and housing [m], at temperatures."""
        zero, bore, outside = (
            self.reference_temperature,
            self.inner_ring.inner_diameter,
            self.outer_ring.outer_diameter,
        )
        on_shaft = self.shaft.warmed(bore, temperatures.shaft - zero)
        on_shaft -= self.inner_ring.warmed(bore, temperatures.inner_ring - zero)
        in_housing = self.outer_ring.warmed(outside, temperatures.outer_ring - zero)
        in_housing -= self.housing.warmed(outside, temperatures.housing - zero)
        return self.shaft_interference + on_shaft, self.housing_interference + in_housing


@dataclass(frozen=True)
class Clearance:
    """Radial clearance of a mounted bearing at some temperatures.

    Attributes
    ----------
    clearance : float
        Full diametral play [m]; negative with a preload.
    shaft_interference, housing_interference : float
        Interferences at the temperatures [m]; negative where the fit is loose.
    shaft_pressure, housing_pressure : float
        Pressures between inner ring and shaft, and between outer ring and housing [Pa].
    """

    clearance: float
    shaft_interference: float
    housing_interference: float
    shaft_pressure: float
    housing_pressure: float


def clearance_at(mounting: Mounting, temperatures: Temperatures) -> Clearance:
    """Radial clearance of a mounted bearing at the temperatures of its parts.

    Parameters
    ----------
    mounting : Mounting
        Bearing, shaft and housing at the reference temperature.
    temperatures : Temperatures
        Temperatures of all parts.

    Returns
    -------
    Clearance
        Clearance, and interferences and pressures of both fits.

    Notes
    -----
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
