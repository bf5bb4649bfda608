"""Oil over pressure and temperature, the data of a heated or sheared film, and its result in SI units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache, cached_property

import numpy as np
from numpy.polynomial import chebyshev

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.film.shear_laws import Rheology
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.runtime.display import Values

# Number of temperatures. With it ln(viscosity) of Roelands, Vogel and Yasutomi over 300 K is exact to 1e-6.
_TEMPERATURES = 12


# Coefficient of a series over its largest one below which it is rounding, and the least number that is kept:
# a second derivative takes three.
_ROUNDING, _LEAST = 1e-14, 3


@dataclass(frozen=True, eq=False)
class Temperatures:
    """Temperatures in the film on the range of the oil, with what the series of all properties have alike."""

    t: Array  # temperature on the range, mapped to -1 ... 1
    count: int  # largest number of terms of a series

    @cached_property
    def inside(self) -> Array:
        """Nearest temperatures of the range."""
        return np.clip(self.t, -1.0, 1.0)

    @cached_property
    def polynomials(self) -> Array:
        """Chebyshev polynomials at the temperatures, shape (count, nz, ...)."""
        return _polynomials(self.inside, self.count)

    @cached_property
    def beyond(self) -> Array | None:
        """Distance from the range, or None where all temperatures are inside."""
        beyond = self.t - self.inside
        return beyond if beyond.any() else None


@dataclass(frozen=True, eq=False)
class Property:
    """Property of the oil over temperature at given pressures, computed as far as it is asked for."""

    # values and slopes: Chebyshev coefficients of the property and of its derivative by pressure,
    # shape (n, ...).
    values: Array
    slopes: Array
    at: Temperatures
    half_range: float  # [K]
    # Whether the property goes on beyond the range as a parabola, up to its vertex, instead of a line.
    curved: bool = False

    def _series(self, coefficients: Array) -> Array:
        """Chebyshev series (m, ...) at the temperatures, m <= n."""
        of_each = self.at.polynomials[: len(coefficients)]
        return np.asarray(np.einsum("k...,k...->...", of_each, coefficients), dtype=np.float64)

    @cached_property
    def _by_t(self) -> Array:
        return self._series(_derived(self.values))

    @cached_property
    def _curvature(self) -> Array:
        """Second derivative by ``t`` at the end of the range, of parabolas; zero for straight lines."""
        return self._series(_derived(_derived(self.values))) if self.curved else np.zeros_like(self.at.t)

    @cached_property
    def _reach(self) -> Array:
        """Distance from the range, of a parabola at most the distance of its vertex."""
        beyond = self.at.t - self.at.inside
        if not self.curved:
            return beyond
        slope, curvature = self._by_t, self._curvature
        vertex = np.divide(-slope, curvature, out=np.full_like(slope, np.inf), where=curvature != 0.0)
        towards = np.sign(vertex) * np.sign(beyond) > 0.0
        return np.where(towards, np.sign(beyond) * np.minimum(abs(beyond), abs(vertex)), beyond)

    @cached_property
    def value(self) -> Array:
        """Values of the property."""
        inside = self._series(self.values)
        if self.at.beyond is None:
            return inside
        return inside + (self._by_t + 0.5 * self._curvature * self._reach) * self._reach

    @cached_property
    def by_pressure(self) -> Array:
        """Derivative by pressure [1/Pa]."""
        inside = self._series(self.slopes)
        if self.at.beyond is None:
            return inside
        return inside + self._series(_derived(self.slopes)) * self.at.beyond

    @cached_property
    def by_temperature(self) -> Array:
        """Derivative by temperature [1/K]."""
        if self.at.beyond is None:
            return self._by_t / self.half_range
        return (self._by_t + self._curvature * self._reach) / self.half_range


@dataclass(frozen=True, eq=False)
class HotOil:
    """Oil over pressure and temperature.

    Each property is a polynomial in temperature through the oils at the Chebyshev temperatures. Beyond the
    range it goes on as a straight line.

    Examples
    --------
    An oil whose viscosity falls by 3 % per kelvin:

    >>> from ehlectric.lubricant.density import incompressible
    >>> from ehlectric.lubricant.oil import BoundLaw, OfDensity
    >>> from ehlectric.lubricant.electrical_laws import constant_permittivity
    >>> from ehlectric.lubricant.viscosity import barus
    >>> eps = OfDensity(BoundLaw(constant_permittivity, {"relative_permittivity": 2.2}))
    >>> law = BoundLaw(barus, {"pressure_viscosity_coefficient": 2e-8})
    >>> constant = lambda value: lambda p: (np.full_like(p, value), np.zeros_like(p))
    >>> def at(temperature):
    ...     viscosity = 0.04 * np.exp(-0.03 * (temperature - 313.15))
    ...     return Oil(viscosity, 2.2, 1e5, law, BoundLaw(incompressible, {}), eps, density=870.0,
    ...                thermal_conductivity_law=constant(0.14), heat_capacity_law=constant(1.7e6))
    >>> oil = HotOil.through(at, 273.15, 473.15)
    >>> found = oil.log_viscosity(np.array([1e8]), np.array([333.15]))
    >>> round(float(found.value[0] - np.log(0.04)), 6), round(float(found.by_temperature[0]), 6)
    (1.4, -0.03)
    """

    oils: tuple[Oil, ...]  # oils at the Chebyshev temperatures between ``lowest`` and ``highest``
    # lowest and highest: range of temperature [K].
    lowest: float
    highest: float
    # Whether properties go on beyond the range as parabolas, up to their vertices, instead of lines.
    curved: bool = False

    @classmethod
    def through(cls, oil_at: Callable[[float], Oil], lowest: float, highest: float) -> HotOil:
        """Oil through the oils at Chebyshev temperatures. ``oil_at`` [K]; ``lowest`` and ``highest``, range
        of temperature [K]. Raises InputError if the oil has no density, thermal conductivity or heat
        capacity.
        """
        at = 0.5 * (lowest + highest) + 0.5 * (highest - lowest) * chebyshev.chebpts1(_TEMPERATURES)
        oils = tuple(oil_at(float(temperature)) for temperature in at)
        for key, value in (
            ("lubricant.density", oils[0].density),
            ("lubricant.thermal_conductivity", oils[0].thermal_conductivity_law),
            ("lubricant.heat_capacity", oils[0].heat_capacity_law),
        ):
            if value is None:
                raise InputError(key, got="no value", takes="a value: the heat in the film depends on it")
        return cls(oils, lowest, highest)

    def at(self, temperature: Array) -> Temperatures:
        """Temperatures [K] for several properties."""
        half = 0.5 * (self.highest - self.lowest)
        return Temperatures((temperature - self.lowest) / half - 1.0, len(self.oils))

    def log_viscosity(self, pressure: Array, temperature: Array | Temperatures) -> Property:
        """Natural logarithm of the viscosity in Pa s.

        ``pressure`` [Pa] has the shape (...), ``temperature`` [K] the shape (..., ) or (nz, ...).
        """

        def law(oil: Oil) -> tuple[Array, Array]:
            value, slope = oil.log_viscosity(pressure)
            return value + np.log(oil.viscosity), slope

        return self._between(law, pressure, temperature)

    def density(self, pressure: Array, temperature: Array | Temperatures) -> Property:
        """Density [kg/m^3]; pressure and temperature as for ``log_viscosity``."""

        def law(oil: Oil) -> tuple[Array, Array]:
            value, slope = oil.density_ratio(pressure)
            assert oil.density is not None
            return oil.density * value, oil.density * slope

        return self._between(law, pressure, temperature)

    def thermal_conductivity(self, pressure: Array, temperature: Array | Temperatures) -> Property:
        """Thermal conductivity [W/(m K)]; pressure and temperature as for ``log_viscosity``."""

        def law(oil: Oil) -> tuple[Array, Array]:
            assert oil.thermal_conductivity_law is not None
            return oil.thermal_conductivity_law(pressure)

        return self._between(law, pressure, temperature)

    def heat_capacity(self, pressure: Array, temperature: Array | Temperatures) -> Property:
        """Volumetric heat capacity [J/(m^3 K)]; pressure and temperature as for ``log_viscosity``."""

        def law(oil: Oil) -> tuple[Array, Array]:
            assert oil.heat_capacity_law is not None
            return oil.heat_capacity_law(pressure)

        return self._between(law, pressure, temperature)

    @cached_property
    def _to_coefficients(self) -> Array:
        """Matrix from the values at the Chebyshev temperatures to the coefficients of the series."""
        n = len(self.oils)
        return np.asarray(np.linalg.inv(chebyshev.chebvander(chebyshev.chebpts1(n), n - 1)), dtype=np.float64)

    def _between(
        self, law: Callable[[Oil], tuple[Array, Array]], pressure: Array, temperature: Array | Temperatures
    ) -> Property:
        """Property at temperatures, from the values and derivatives by pressure that a law has for an oil."""
        values = np.empty((len(self.oils), *pressure.shape))
        slopes = np.empty_like(values)
        for k, oil in enumerate(self.oils):
            values[k], slopes[k] = law(oil)
        return Property(
            _without_rounding(np.tensordot(self._to_coefficients, values, axes=1)),
            _without_rounding(np.tensordot(self._to_coefficients, slopes, axes=1)),
            temperature if isinstance(temperature, Temperatures) else self.at(temperature),
            0.5 * (self.highest - self.lowest),
            self.curved,
        )


def _without_rounding(coefficients: Array) -> Array:
    """Series (m, ...) without last terms that are rounding: most properties are polynomials of low degree."""
    sizes = np.max(np.abs(coefficients).reshape(len(coefficients), -1), axis=1, initial=0.0)
    terms = np.flatnonzero(sizes > _ROUNDING * np.max(sizes))
    return coefficients[: max(_LEAST, int(terms[-1]) + 1 if terms.size else 0)]


def _derived(coefficients: Array) -> Array:
    """Coefficients of the derivative of a Chebyshev series (n, ...), shape (n - 1, ...)."""
    return np.tensordot(_derivative(len(coefficients)), coefficients, axes=1)


@cache
def _derivative(count: int) -> Array:
    """Matrix from the coefficients of a Chebyshev series to the coefficients of its derivative, (count - 1,
    count).
    """
    return np.asarray(chebyshev.chebder(np.eye(count), axis=0))


def _polynomials(t: Array, count: int) -> Array:
    """Chebyshev polynomials of degree 0, 1, ... at t, shape (count, ...)."""
    values = np.empty((count, *t.shape))
    values[0], values[1] = 1.0, t
    double = 2.0 * t
    for k in range(2, count):
        np.multiply(double, values[k - 1], out=values[k])
        values[k] -= values[k - 2]
    return values


@dataclass(frozen=True)
class Body:
    """Body under the film that takes up its heat.

    Examples
    --------
    >>> steel = Body(313.15, thermal_conductivity=46.0, heat_capacity=470.0, density=7850.0)
    >>> round(steel.diffusivity * 1e6, 2)
    12.47
    """

    temperature: float  # bulk temperature: of the surface before it enters the contact [K]
    thermal_conductivity: float  # [W/(m K)]
    heat_capacity: float  # specific heat capacity [J/(kg K)]
    density: float  # [kg/m^3]

    @property
    def diffusivity(self) -> float:
        """Thermal diffusivity k/(rho c) [m^2/s]."""
        return self.thermal_conductivity / (self.density * self.heat_capacity)


@dataclass(frozen=True)
class Thermal:
    """Conditions of the energy equation."""

    bodies: tuple[Body, Body]  # body a (surface 1, at z = 0) and body b (surface 2, at z = h)
    # Temperature of the oil that enters [K]. The laws of the film problem without heat belong to it.
    inlet_temperature: float
    oil: HotOil  # properties of the oil over pressure and temperature


@dataclass(frozen=True)
class Physics:
    """Rheology and heat of a film, in addition to its isothermal Newtonian problem."""

    rheology: Rheology  # law between shear stress and shear rate, with its constants in SI units
    # Speeds u_a and u_b of the surfaces 1 and 2 along x [m/s]; their mean is positive.
    speeds: tuple[float, float]
    viscosity: float  # viscosity eta_0 in the velocity parameter of the problem [Pa s]
    thermal: Thermal | None = None  # heat; None for an isothermal film
    # Friction coefficient where the surfaces touch and slide, for its heat; None where it is not known.
    boundary_friction: float | None = None

    @property
    def plain(self) -> bool:
        """Whether the oil is Newtonian and the film isothermal: shear does not change such a film."""
        return self.thermal is None and self.rheology.name == "newtonian"

    @property
    def mean_speed(self) -> float:
        """Entrainment speed (u_a + u_b)/2 [m/s]."""
        return 0.5 * (self.speeds[0] + self.speeds[1])

    @property
    def slide_to_roll_ratio(self) -> float:
        """Slide-to-roll ratio (u_b - u_a)/u_m."""
        return (self.speeds[1] - self.speeds[0]) / self.mean_speed


_ACROSS = "from surface 1 to surface 2"


@dataclass(frozen=True, eq=False, repr=False)
class HeatedFilm(Values):
    """Heat and shear of a film in SI units, with nodal values (nx,), or (nx, ny) of a point contact."""

    # Name of the law between shear stress and shear rate, such as "eyring"
    rheology: str = field(metadata=number("text"))
    shear_stress: Array = field(
        metadata=stored("nodes", "Pa", "finite", "shear stress at mid-film along entrainment", needed=False)
    )  # shear stress at mid-film along entrainment [Pa], positive where surface 1 is the faster one
    # Mean shear stress at mid-film divided by the mean pressure, dimensionless; its sign is the sign of the
    # stress. None, as the other friction, if the film did not converge.
    traction_coefficient: float | None = field(metadata=number())
    # Rolling friction over the load, dimensionless, of each of the two surfaces.
    rolling_coefficient: float | None = field(metadata=number())
    # Power that the film turns into heat [W]; of a line contact per length [W/m].
    power_loss: float | None = field(metadata=number("not negative or null"))
    # isothermal_minimum_thickness and isothermal_central_thickness: film thicknesses of the same contact with
    # an isothermal Newtonian film [m]; None if that film did not converge.
    isothermal_minimum_thickness: float | None = field(metadata=number("positive or null"))
    isothermal_central_thickness: float | None = field(metadata=number("positive or null"))
    # Number of alternations between the film and its temperature.
    outer_iterations: int = field(metadata=number("whole"))
    # Positions across the film from surface 1, at 0, to surface 2, at 1. None for an isothermal film,
    # shape (nz,).
    zeta: Array | None = field(
        default=None,
        metadata=stored("zeta", "1", "increasing", f"fraction of the film, {_ACROSS}", needed=False),
    )
    # Temperature in the film [K]; its first and last rows are the temperatures of the surfaces, shape (nz,
    # nx) or (nz, nx, ny).
    temperature: Array | None = field(
        default=None,
        metadata=stored("zeta nodes", "K", "positive", f"temperature in the film, {_ACROSS}", needed=False),
    )
    mid_temperature: Array | None = field(
        default=None, metadata=stored("nodes", "K", "positive", "temperature at mid-film", needed=False)
    )  # [K]
    # Largest temperature at mid-film less the temperature of the oil in the inlet [K].
    max_temperature_rise: float | None = field(default=None, metadata=number())
    # Estimated error of ``max_temperature_rise`` by the grids along and across the film, the iteration and
    # extrapolated properties of the oil [K]; None if unknown.
    temperature_rise_error: float | None = field(default=None, metadata=number())
    # Heat that the film makes or loses by the discretisation, over the heat of compression and shear.
    energy_imbalance: float | None = field(default=None, metadata=number())
    # Last change of temperature [K], and the position x and y over the half-width, of the node at which the
    # temperature did not settle while the film of each turn converged; None of other films, and in files.
    unsettled: tuple[float, float, float] | None = None

    @property
    def thermal(self) -> bool:
        """Whether the temperature in the film was computed."""
        return self.temperature is not None

    @property
    def surface_temperatures(self) -> Array | None:
        """Temperatures of surfaces 1 and 2 [K], shape (2, nx) or (2, nx, ny); None of an isothermal film."""
        return None if self.temperature is None else self.temperature[[0, -1]]

    @property
    def temperature_range(self) -> tuple[float, float] | None:
        """Lowest and highest temperature in the film [K]; None of an isothermal film."""
        if self.temperature is None:
            return None
        return float(np.min(self.temperature)), float(np.max(self.temperature))
