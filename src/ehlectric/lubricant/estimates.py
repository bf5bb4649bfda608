"""Estimate of the pressure-viscosity coefficient of an oil from its data sheet and its type of base oil."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ClassVar

from ehlectric.errors import InputError, ResultWarning, shown

# Kinematic viscosities for which the correlations were compared with measured coefficients [m^2/s].
LEAST, MOST = 2e-6, 2.5e-3

SO_KLAUS = (
    "B. Y. C. So and E. E. Klaus, Viscosity-pressure correlation of liquids, ASLE Trans. 23 (1980) 409-421, "
    "doi:10.1080/05698198008982986"
)
GOLD = (
    "P. W. Gold, A. Schmidt, H. Dicke, J. Loos and C. Assmann, Viscosity-pressure-temperature behaviour of "
    "mineral and synthetic oils, J. Synth. Lubr. 18 (2001) 51-79"
)


@dataclass(frozen=True)
class Estimate:
    """Estimated value of a property, with its scatter and its source.

    Attributes
    ----------
    value : float
        Estimated value, SI units.
    scatter : float
        Relative deviation of measured values from the estimate, which nine of ten do not exceed.
    source : str
        Publication of the correlation.
    base_oil : str
        Type of base oil for which the estimate holds.
    """

    value: float
    scatter: float
    source: str
    base_oil: str
    of: ClassVar[str] = "viscosity"

    def __call__(self, max_pressure: float) -> Iterator[ResultWarning]:  # noqa: ARG002
        """Warning that the coefficient is an estimate, for a contact with any Hertz pressure [Pa]."""
        yield ResultWarning(
            "estimated-alpha",
            f"the pressure-viscosity coefficient, {1e9 * self.value:.3g} 1/GPa, is estimated for base_oil "
            f"{self.base_oil!r} and may be wrong by {100.0 * self.scatter:.0f} %; a film thickness goes with "
            "its power 0.5; give lubricant.pressure_viscosity_coefficient if it is known",
        )


def so_klaus(kinematic_viscosity: float, slope: float, density: float) -> float:
    """Pressure-viscosity coefficient of a mineral oil after So and Klaus.

    alpha = 1.216 + 4.143 L^3.0627 + 2.848e-4 b^5.1903 L^1.5976 - 3.999 L^3.0975 rho^0.1162, in 10 1/GPa, with
    L = log10(nu), nu in mm^2/s and rho in g/cm^3

    Parameters
    ----------
    kinematic_viscosity : float
        Kinematic viscosity nu at ambient pressure and the temperature of the oil [m^2/s].
    slope : float
        Slope b of log10 log10(nu + 0.7) over log10 T, constant B of ASTM D341, dimensionless.
    density : float
        Density rho at ambient pressure and the temperature of the oil [kg/m^3].

    Returns
    -------
    float
        Pressure-viscosity coefficient alpha, the slope of ln(eta) at zero pressure [1/Pa].

    Notes
    -----
    B. Y. C. So and E. E. Klaus, ASLE Trans. 23 (1980) 409-421, doi:10.1080/05698198008982986, as a public
    program quotes it; the paper itself was not read. Of 36 coefficients of mineral oils that ESDU 85027
    (1985) prints in table 10.2, the formula gives 0.94 to 1.38 times the printed value, 1.09 in the mean.

    Examples
    --------
    >>> round(so_klaus(96e-6, 3.585, 863.0) * 1e9, 1)
    28.1
    """
    log, grams = math.log10(1e6 * kinematic_viscosity), 1e-3 * density
    straight = 1.216 + 4.143 * log**3.0627 + 2.848e-4 * slope**5.1903 * log**1.5976
    return float(1e-8 * (straight - 3.999 * log**3.0975 * grams**0.1162))


@dataclass(frozen=True)
class Gold:
    """Correlation of Gold and others for a type of base oil, alpha = s nu^t.

    With nu in mm^2/s, alpha is in 1/GPa. The constants are those of the programs GearC and Contact Mechanics
    of the University of Porto; the paper itself was not read.

    Attributes
    ----------
    s, t : float
        Constants of the type of base oil, dimensionless.

    Examples
    --------
    >>> round(Gold(7.382, 0.1335)(94.1e-6, 3.0, 830.0) * 1e9, 2)
    13.54
    """

    s: float
    t: float

    def __call__(self, kinematic_viscosity: float, slope: float, density: float) -> float:  # noqa: ARG002
        """Pressure-viscosity coefficient [1/Pa] at a kinematic viscosity [m^2/s]."""
        return 1e-9 * self.s * float((1e6 * kinematic_viscosity) ** self.t)


@dataclass(frozen=True)
class BaseOil:
    """Type of base oil: its correlation for the pressure-viscosity coefficient.

    Attributes
    ----------
    correlation : callable
        Coefficient [1/Pa] as a function of kinematic viscosity [m^2/s], slope and density [kg/m^3].
    scatter : float
        Relative deviation that nine of ten measured coefficients do not exceed.
    source : str
        Publication of the correlation.
    """

    correlation: Callable[[float, float, float], float]
    scatter: float
    source: str


BASE_OILS = {
    "mineral-paraffinic": BaseOil(so_klaus, 0.3, SO_KLAUS),
    "mineral-naphthenic": BaseOil(so_klaus, 0.3, SO_KLAUS),
    "pao": BaseOil(Gold(7.382, 0.1335), 0.45, GOLD),
    "ester": BaseOil(Gold(6.605, 0.1360), 0.3, GOLD),
    "polyglycol": BaseOil(Gold(5.489, 0.1485), 0.7, GOLD),
}


def alpha_estimate(base_oil: str, kinematic_viscosity: float, *, slope: float, density: float) -> Estimate:
    """Pressure-viscosity coefficient of an oil, estimated from its type of base oil.

    Parameters
    ----------
    base_oil : str
        Type of base oil, one of ``BASE_OILS``.
    kinematic_viscosity : float
        Kinematic viscosity at ambient pressure and the temperature of the oil [m^2/s].
    slope : float
        Constant B of ASTM D341, dimensionless; see ``Walther``.
    density : float
        Density at ambient pressure and the temperature of the oil [kg/m^3].

    Returns
    -------
    Estimate
        Coefficient [1/Pa], with its scatter and its source.

    Raises
    ------
    InputError
        If the type is not known, or the viscosity is outside the range in which the correlations were
        compared with measurements.

    Notes
    -----
    The publications' own scatter could not be read. The scatter given here is that of the coefficients in
    the unit tests of this module: table 10.2 of ESDU 85027 (1985) with 13 mineral oils, castor oil, a
    sebacate and polyglycols, the oils FVA 3, M100, N100 and PAO100 of the library, and four polyalphaolefins
    of a public program. Mineral oils have in the mean 0.92 times their estimate, and the others more than
    theirs. The estimates do not hold for phthalates and phosphate esters, which have up to twice as much.

    Examples
    --------
    >>> found = alpha_estimate("mineral-paraffinic", 46e-6, slope=3.6, density=860.0)
    >>> round(found.value * 1e9, 1), found.scatter
    (23.9, 0.3)
    """
    if base_oil not in BASE_OILS:
        raise InputError(
            "temperature.base_oil", got=shown(base_oil), takes=f"one of {', '.join(map(repr, BASE_OILS))}"
        )
    if not LEAST <= kinematic_viscosity <= MOST:
        raise InputError(
            "temperature.base_oil",
            got=f"an oil with {1e6 * kinematic_viscosity:.3g} mm^2/s at its temperature",
            takes=f"{1e6 * LEAST:g} to {1e6 * MOST:g} mm^2/s, for which the pressure-viscosity coefficient "
            "can be estimated; give pressure_viscosity_coefficient",
        )
    kind = BASE_OILS[base_oil]
    value = kind.correlation(kinematic_viscosity, slope, density)
    return Estimate(value, kind.scatter, kind.source, base_oil)
