"""Reduction of an elastohydrodynamic film by the heat of shear in its inlet, by a published formula."""

from __future__ import annotations


def inlet_shear_factor(viscosity: float, slope: float, speed: float, conductivity: float) -> float:
    """Reduction factor of the central film thickness due to shear heating in the inlet, in pure rolling.

    1/(1 + 0.241 L^0.64) with the thermal loading parameter L = eta0 beta u^2/k

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
        Central film thickness over the isothermal one, from 0 to 1.

    Notes
    -----
    W. R. D. Wilson and S. Sheu, Effect of inlet shear heating due to sliding on elastohydrodynamic film
    thickness, ASME J. Lubr. Technol. 105 (1983) 187, doi:10.1115/1.3254563, eq. (8). It was derived for the
    inlet of a line contact, and is used for elliptical contacts too. Of three published formulas it is the
    nearest to solved films in pure rolling. Solved films contradict its term of sliding, which is left out.

    Examples
    --------
    >>> round(inlet_shear_factor(0.0125, 0.0309, 15.1, 0.14), 3)
    0.848
    """
    loading = viscosity * slope * speed**2 / conductivity
    return float(1.0 / (1.0 + 0.241 * loading**0.64))
