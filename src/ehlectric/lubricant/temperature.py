"""Temperature dependence of an oil: viscosity, density and the effect of inlet shear heating, in SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ehlectric.errors import InputError

# 15, 40 and 100 degC as absolute temperatures [K].
REFERENCE = 288.15
COLD, HOT = 313.15, 373.15

# Constant that ASTM D341 adds to the kinematic viscosity, and the smallest viscosity for which a constant is
# accurate enough [mm^2/s].
_ADDED, _LEAST = 0.7, 2.0


@dataclass(frozen=True)
class Walther:
    """Kinematic viscosity of an oil over temperature, after ASTM D341 (Walther's equation).

    log10 log10(nu + 0.7) = A - B log10 T, with nu in mm^2/s and T in K. This is the short form of ASTM D341,
    for nu of at least 2 mm^2/s.

    Attributes
    ----------
    a, b : float
        Constants A and B, dimensionless.

    Examples
    --------
    >>> oil = Walther.of(46e-6, 6.8e-6)
    >>> round(oil.viscosity(343.15) * 1e6, 2)
    14.85
    """

    a: float
    b: float

    @classmethod
    def of(cls, at_40: float, at_100: float) -> Walther:
        """Walther equation of an oil from its kinematic viscosities at 40 and 100 degC [m^2/s].

        Raises
        ------
        InputError
            If the viscosity does not fall with temperature, or is too low for the equation.
        """
        if not at_40 > at_100:
            raise InputError(
                "lubricant.temperature.kinematic_viscosity_100",
                got=f"{at_100:g} m^2/s",
                takes=f"less than kinematic_viscosity_40, {at_40:g} m^2/s",
            )
        if at_100 < 1e-6 * _LEAST:
            raise InputError(
                "lubricant.temperature.kinematic_viscosity_100",
                got=f"{at_100:g} m^2/s",
                takes=f"at least {1e-6 * _LEAST:g} m^2/s, for which ASTM D341 holds in its short form",
            )
        cold, hot = (math.log10(math.log10(1e6 * nu + _ADDED)) for nu in (at_40, at_100))
        b = (cold - hot) / math.log10(HOT / COLD)
        return cls(cold + b * math.log10(COLD), b)

    def viscosity(self, temperature: float) -> float:
        """Kinematic viscosity [m^2/s] at an absolute temperature [K].

        Raises
        ------
        InputError
            If the viscosity is too low for the equation, or the oil is solid at this temperature.
        """
        double = math.pow(10.0, self.a - self.b * math.log10(temperature))
        if double > 300.0:
            raise InputError("bearing.temperature", got=f"{temperature:g} K, at which the oil is solid")
        nu = math.pow(10.0, double) - _ADDED
        if nu < _LEAST:
            raise InputError(
                "bearing.temperature",
                got=f"{temperature:g} K, at which the oil has {nu:.3g} mm^2/s;",
                takes=f"one at which it has {_LEAST:g} mm^2/s or more, for which ASTM D341 holds in its "
                "short form",
            )
        return 1e-6 * nu

    def slope(self, temperature: float) -> float:
        """Temperature coefficient of the kinematic viscosity, -d ln(nu)/dT [1/K], at a temperature [K]."""
        total = 1e6 * self.viscosity(temperature) + _ADDED
        return math.log(total) * self.b * total / ((total - _ADDED) * temperature)


def density(at_15: float, expansion: float, temperature: float) -> float:
    """Density of an oil at a temperature, rho = rho_15 (1 - a (T - 288.15 K)).

    Parameters
    ----------
    at_15 : float
        Density rho_15 at 15 degC [kg/m^3].
    expansion : float
        Coefficient a of thermal expansion [1/K].
    temperature : float
        Absolute temperature T [K].

    Returns
    -------
    float
        Density rho [kg/m^3].

    Examples
    --------
    >>> round(density(870.0, 6.5e-4, 343.15), 1)
    838.9
    """
    return at_15 * (1.0 - expansion * (temperature - REFERENCE))


def inlet_shear_factor(viscosity: float, slope: float, speed: float, conductivity: float) -> float:
    """Reduction factor of the central film thickness due to shear heating in the inlet, in pure rolling.

    C = 1/(1 + 0.241 L^0.64) with the thermal loading parameter L = eta0 beta u^2/k

    Parameters
    ----------
    viscosity : float
        Viscosity eta0 at the inlet temperature [Pa s].
    slope : float
        Temperature coefficient of viscosity beta = -d ln(eta0)/dT [1/K].
    speed : float
        Mean speed u of both surfaces [m/s].
    conductivity : float
        Thermal conductivity k of the oil [W/(m K)].

    Returns
    -------
    float
        Central film thickness over the isothermal one, C, from 0 to 1.

    Notes
    -----
    W. R. D. Wilson and S. Sheu, Effect of inlet shear heating due to sliding on elastohydrodynamic film
    thickness, ASME J. Lubr. Technol. 105 (1983) 187, without sliding. The formula was derived for the inlet
    of a line contact; it is used for elliptical contacts too.

    Examples
    --------
    >>> round(inlet_shear_factor(0.0125, 0.0309, 15.1, 0.14), 3)
    0.848
    """
    loading = viscosity * slope * speed**2 / conductivity
    return float(1.0 / (1.0 + 0.241 * loading**0.64))
