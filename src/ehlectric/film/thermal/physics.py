"""Data of a film that is heated or shear-thinning: bodies, speeds, rheology and oil, in SI units."""

from __future__ import annotations

from dataclasses import dataclass

from ehlectric.film.sheared.laws import Rheology
from ehlectric.film.thermal.oil import HotOil


@dataclass(frozen=True)
class Body:
    """Body under the film that takes up its heat.

    Attributes
    ----------
    temperature : float
        Bulk temperature, that of the surface before it enters the contact [K].
    thermal_conductivity : float
        Thermal conductivity [W/(m K)].
    heat_capacity : float
        Specific heat capacity [J/(kg K)].
    density : float
        Density [kg/m^3].

    Examples
    --------
    >>> steel = Body(313.15, thermal_conductivity=46.0, heat_capacity=470.0, density=7850.0)
    >>> round(steel.diffusivity * 1e6, 2)
    12.47
    """

    temperature: float
    thermal_conductivity: float
    heat_capacity: float
    density: float

    @property
    def diffusivity(self) -> float:
        """Thermal diffusivity k/(rho c) [m^2/s]."""
        return self.thermal_conductivity / (self.density * self.heat_capacity)


@dataclass(frozen=True)
class Thermal:
    """Conditions of the energy equation.

    Attributes
    ----------
    bodies : tuple of Body
        Body a (surface 1, at z = 0) and body b (surface 2, at z = h).
    inlet_temperature : float
        Temperature of the oil that enters [K]. The laws of the film problem without heat belong to it.
    oil : HotOil
        Properties of the oil over pressure and temperature.
    """

    bodies: tuple[Body, Body]
    inlet_temperature: float
    oil: HotOil


@dataclass(frozen=True)
class Physics:
    """Rheology and heat of a film, beside its isothermal Newtonian problem.

    Attributes
    ----------
    rheology : Rheology
        Law between shear stress and shear rate, with its constants in SI units.
    speeds : tuple of float
        Speeds u_a and u_b of the surfaces 1 and 2 along x [m/s]; their mean is positive.
    viscosity : float
        Viscosity eta_0 in the velocity parameter of the problem [Pa s].
    thermal : Thermal or None
        Heat; None for an isothermal film.
    """

    rheology: Rheology
    speeds: tuple[float, float]
    viscosity: float
    thermal: Thermal | None = None

    @property
    def mean_speed(self) -> float:
        """Entrainment speed (u_a + u_b)/2 [m/s]."""
        return 0.5 * (self.speeds[0] + self.speeds[1])

    @property
    def slide_to_roll_ratio(self) -> float:
        """Slide-to-roll ratio (u_b - u_a)/u_m."""
        return (self.speeds[1] - self.speeds[0]) / self.mean_speed
