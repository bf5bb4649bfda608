"""Viscosity index, viscosity grade and pressure-viscosity coefficient from the data sheet of an oil."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import scipy

from ehlectric.arrays import Array, N, Numbers, as_float
from ehlectric.errors import InputError, shown
from ehlectric.quantities.result_warnings import ResultWarning

# Viscosity grades of ISO 3448. The middle of a grade is its number in mm^2/s at 40 degC, except for the four
# thinnest, and its range is 10 % of the middle to either side.
_MIDDLES = {2: 2.2, 3: 3.2, 5: 4.6, 7: 6.8}
GRADES = (2, 3, 5, 7, 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)
GRADE_WIDTH = 0.1

# Range of viscosities at 100 degC for which ASTM D2270 gives its reference oils [mm^2/s]. Above 70 mm^2/s its
# equations have no upper end; the largest value keeps the search finite.
LEAST_AT_100, _MOST_AT_100 = 2.0, 1e4

# Error of a viscosity at 100 degC that follows from an index [mm^2/s].
_CLOSE = 1e-12

# Reference oils of ASTM D2270-10, appendix X2: viscosities at 40 degC of an oil of index 0, which is
# L = a Y^2 + b Y + c, and of one of index 100, H = d Y^2 + e Y + f, with the same viscosity Y at 100 degC, in
# mm^2/s. A row holds from its first number to the first number of the next row.
_REFERENCE = (
    (2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
    (3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
    (4.4, 2.5, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
    (5.0, 0.101, 16.635, -45.469, 0.04985, 9.1613, -18.557),
    (6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
    (7.0, 0.01191, 21.475, -72.870, 0.79762, -0.7321, 14.61),
    (7.7, 0.41858, 16.1558, -56.040, 0.05794, 10.5156, -28.240),
    (9.0, 0.88779, 7.5527, -16.600, 0.26665, 6.7015, -10.810),
    (12.0, 0.7672, 10.7972, -38.180, 0.20073, 8.4658, -22.490),
    (15.0, 0.97305, 5.3135, -2.200, 0.28889, 5.9741, -4.930),
    (18.0, 0.97256, 5.25, -0.980, 0.24504, 7.416, -16.730),
    (22.0, 0.91413, 7.4759, -21.820, 0.20323, 9.1267, -34.230),
    (28.0, 0.87031, 9.7157, -50.770, 0.18411, 10.1015, -46.750),
    (40.0, 0.84703, 12.6752, -133.310, 0.17029, 11.4866, -80.620),
    (55.0, 0.85921, 11.1009, -83.190, 0.1713, 11.368, -76.940),
    (70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
)
_FROM = [row[0] for row in _REFERENCE]

# Slope of 10^N over the index above 100 in procedure B.
_B = 0.00715


def grade_middle(grade: int) -> float:
    """Kinematic viscosity at 40 degC in the middle of the range of a viscosity grade of ISO 3448 [m^2/s].

    Examples
    --------
    >>> grade_middle(46), grade_middle(5)
    (4.6e-05, 4.6e-06)
    """
    return float(f"{1e-6 * _MIDDLES.get(grade, grade):.12g}")


def _reference(at_100: float) -> tuple[float, float]:
    """Viscosities L and H at 40 degC of the reference oils with this viscosity at 100 degC, in mm^2/s."""
    return _curves(_REFERENCE[max(bisect_right(_FROM, at_100) - 1, 0)][1:], at_100)


def _curves(row: Iterable[N], at_100: N) -> tuple[N, N]:
    """Viscosities L and H by the six constants of a row."""
    a, b, c, d, e, f = row
    return (a * at_100 + b) * at_100 + c, (d * at_100 + e) * at_100 + f


def viscosity_index(at_40: float, at_100: float) -> float:
    """Viscosity index of an oil, by procedures A (up to 100) and B (above) of ASTM D2270. ``at_40`` and
    ``at_100``, kinematic viscosities at 40 and 100 degC [m^2/s]; at 100 degC at least 2 mm^2/s. Returns
    viscosity index, dimensionless, not rounded. Raises ValueError if the viscosity at 100 degC is below 2
    mm^2/s.

    ASTM D2270-10, Standard Practice for Calculating Viscosity Index from Kinematic Viscosity at 40 and
    100 degC, with the quadratic equations of its appendix X2 for the reference oils.

    Examples
    --------
    >>> round(viscosity_index(73.3e-6, 8.86e-6)), round(viscosity_index(22.83e-6, 5.05e-6))
    (92, 156)
    """
    u, y = 1e6 * at_40, 1e6 * at_100
    if y < LEAST_AT_100:
        raise ValueError(f"ASTM D2270 needs {LEAST_AT_100:g} mm^2/s or more at 100 degC, got {y:g}")
    low, high = _reference(y)
    if u >= high:
        return 100.0 * (low - u) / (low - high)
    return 100.0 + (math.pow(10.0, math.log10(high / u) / math.log10(y)) - 1.0) / _B


def viscosity_at_100(at_40: Numbers, index: Numbers) -> Numbers:
    """Kinematic viscosity at 100 degC of an oil with a viscosity index: ASTM D2270 solved for it. ``at_40``,
    kinematic viscosity at 40 degC [m^2/s]; it and the index are floats, or arrays of shape (...) of many
    oils. Returns kinematic viscosity at 100 degC [m^2/s]. Raises ValueError if the oil has less than 2 mm^2/s
    at 100 degC, or more than the equations are solved for; of many oils, those have NaN.

    Examples
    --------
    >>> round(viscosity_at_100(46e-6, 100.0) * 1e6, 2)
    6.76
    """
    if np.ndim(at_40) or np.ndim(index):
        return _many_at_100(1e6 * np.asarray(at_40), np.asarray(index, dtype=float))
    target, of_oil = 1e6 * float(at_40), float(index)
    bottom, top = LEAST_AT_100, _MOST_AT_100
    if not _at_40(bottom, of_oil) <= target <= _at_40(top, of_oil):
        raise ValueError(
            f"an oil with {target:g} mm^2/s at 40 degC and viscosity index {index:g} has less than "
            f"{LEAST_AT_100:g} mm^2/s at 100 degC, the minimum of ASTM D2270"
        )
    return 1e-6 * float(
        scipy.optimize.brentq(lambda at_100: _at_40(at_100, of_oil) - target, bottom, top, xtol=_CLOSE)
    )


def _at_40(at_100: float, index: float) -> float:
    """Viscosity at 40 degC of the oil with a viscosity at 100 degC and an index, in mm^2/s."""
    low, high = _reference(at_100)
    if index <= 100.0:
        return low - 0.01 * index * (low - high)
    return high / math.pow(at_100, math.log10(1.0 + _B * (index - 100.0)))


def _many_at_100(target: Array, index: Array) -> Array:
    """Viscosities at 100 degC [m^2/s] of oils with viscosities at 40 degC [mm^2/s] and indices."""
    target, index = np.broadcast_arrays(target, index)
    constants = np.array(_REFERENCE)[:, 1:].T

    def difference(at_100: Array, target: Array, index: Array) -> Array:
        row = np.maximum(np.searchsorted(_FROM, at_100, side="right") - 1, 0)
        low, high = _curves(constants[:, row], at_100)
        above = high / at_100 ** np.log10(1.0 + _B * np.maximum(index - 100.0, 0.0))
        return np.asarray(np.where(index <= 100.0, low - 0.01 * index * (low - high), above) - target)

    ends = np.full(target.shape, LEAST_AT_100), np.full(target.shape, _MOST_AT_100)
    known = (difference(ends[0], target, index) <= 0.0) & (difference(ends[1], target, index) >= 0.0)
    viscosity = np.full(target.shape, np.nan)
    if np.any(known):
        of = target[known], index[known]
        bracket = ends[0][known], ends[1][known]
        # An attribute of scipy.optimize only after its import.
        from scipy.optimize.elementwise import find_root

        viscosity[known] = find_root(difference, bracket, args=of, tolerances={"xatol": _CLOSE}).x
    return 1e-6 * viscosity


# Kinematic viscosities for which the correlations were compared with measured coefficients [m^2/s].
LEAST, MOST = 2e-6, 2.5e-3

# Least kinematic viscosity to which the correlations are extrapolated [m^2/s]; So and Klaus's ends there.
THINNEST = 1e-6

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
    """Estimated value of a property, with its scatter and its source."""

    value: Numbers  # estimated value, SI units
    scatter: float  # relative deviation of measured values from the estimate, which nine of ten do not exceed
    source: str
    base_oil: str
    extrapolated: Any = False  # whether the oil is thinner than all compared oils, shape (...)
    of: ClassVar[str] = "viscosity"

    def __call__(self, max_pressure: float) -> Iterator[ResultWarning]:  # noqa: ARG002
        """Warning that the coefficient is an estimate, for a contact with any Hertz pressure [Pa]."""
        alpha, percent = 1e9 * self.value, 100.0 * self.scatter
        yield ResultWarning.of("estimated-alpha", alpha=alpha, base_oil=self.base_oil, percent=percent)
        if self.extrapolated:
            yield ResultWarning.of("alpha-extrapolated", base_oil=self.base_oil, least=1e6 * LEAST)

    def codes(self, max_pressure: Array) -> Iterator[tuple[int, str]]:
        """Places of many points with Hertz pressures [Pa], shape (n,), each with the code of the warning."""
        yield from ((place, "estimated-alpha") for place in range(max_pressure.size))
        thin = np.broadcast_to(self.extrapolated, max_pressure.shape)
        yield from ((int(place), "alpha-extrapolated") for place in np.flatnonzero(thin))


def so_klaus(kinematic_viscosity: Numbers, slope: Numbers, density: Numbers) -> Numbers:
    """Pressure-viscosity coefficient of a mineral oil after So and Klaus.

    alpha = 1.216 + 4.143 L^3.0627 + 2.848e-4 b^5.1903 L^1.5976 - 3.999 L^3.0975 rho^0.1162, in 10 1/GPa, with
    L = log10(nu), nu in mm^2/s and rho in g/cm^3

    ``kinematic_viscosity``, kinematic viscosity nu at ambient pressure and the temperature of the oil
    [m^2/s]; ``slope``, slope b of log10 log10(nu + 0.7) over log10 T, constant B of ASTM D341, dimensionless;
    ``density``, density rho at ambient pressure and the temperature of the oil [kg/m^3]. Returns
    pressure-viscosity coefficient alpha, the slope of ln(eta) at zero pressure [1/Pa].

    B. Y. C. So and E. E. Klaus, ASLE Trans. 23 (1980) 409-421, doi:10.1080/05698198008982986, as a public
    program quotes it; the paper itself was not read. Of 36 coefficients of mineral oils that ESDU 85027
    (1985) prints in table 10.2, the formula gives 0.94 to 1.38 times the printed value, 1.09 in the mean.

    Examples
    --------
    >>> round(so_klaus(96e-6, 3.585, 863.0) * 1e9, 1)
    28.1
    """
    log, grams = np.log10(1e6 * kinematic_viscosity), 1e-3 * density
    straight = 1.216 + 4.143 * log**3.0627 + 2.848e-4 * slope**5.1903 * log**1.5976
    return as_float(1e-8 * (straight - 3.999 * log**3.0975 * grams**0.1162))


@dataclass(frozen=True)
class Gold:
    """Correlation of Gold and others for a type of base oil, alpha = s nu^t.

    With nu in mm^2/s, alpha is in 1/GPa. The constants are taken from the programs GearC and Contact
    Mechanics of the University of Porto; the paper itself was not read.

    Examples
    --------
    >>> round(Gold(7.382, 0.1335)(94.1e-6, 3.0, 830.0) * 1e9, 2)
    13.54
    """

    # s and t: constants of the type of base oil, dimensionless.
    s: float
    t: float

    def __call__(self, kinematic_viscosity: Numbers, slope: Numbers, density: Numbers) -> Numbers:  # noqa: ARG002
        """Pressure-viscosity coefficient [1/Pa] at a kinematic viscosity [m^2/s]."""
        return as_float(1e-9 * self.s * (1e6 * kinematic_viscosity) ** self.t)


@dataclass(frozen=True)
class BaseOil:
    """Type of base oil: its correlation for the pressure-viscosity coefficient."""

    # Coefficient [1/Pa] as a function of kinematic viscosity [m^2/s], slope and density [kg/m^3].
    correlation: Callable[[Numbers, Numbers, Numbers], Numbers]
    scatter: float  # relative deviation that nine of ten measured coefficients do not exceed
    source: str


BASE_OILS = {
    "mineral-paraffinic": BaseOil(so_klaus, 0.3, SO_KLAUS),
    "mineral-naphthenic": BaseOil(so_klaus, 0.3, SO_KLAUS),
    "pao": BaseOil(Gold(7.382, 0.1335), 0.45, GOLD),
    "ester": BaseOil(Gold(6.605, 0.1360), 0.3, GOLD),
    "polyglycol": BaseOil(Gold(5.489, 0.1485), 0.7, GOLD),
}


def alpha_estimate(
    base_oil: str, kinematic_viscosity: Numbers, *, slope: Numbers, density: Numbers
) -> Estimate:
    """Pressure-viscosity coefficient of an oil, estimated from its type of base oil.

    ``kinematic_viscosity``, kinematic viscosity at ambient pressure and the temperature of the oil [m^2/s];
    ``slope``, constant B of ASTM D341, dimensionless; see ``Walther``; ``density``, density at ambient
    pressure and the temperature of the oil [kg/m^3]. Returns coefficient [1/Pa], with its scatter and its
    source; the arguments are floats, or arrays of shape (...) of many points. Raises InputError if the type
    is not known, or the viscosity is outside the range in which the correlations were compared with
    measurements; of many points, points outside have NaN. Below 2 mm^2/s, the correlations are extrapolated
    down to 1 mm^2/s, and the estimate is marked.

    The publications' own scatter could not be read. The scatter given here was computed from the coefficients
    in the unit tests of this module: table 10.2 of ESDU 85027 (1985) with 13 mineral oils, castor oil, a
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
    outside = ~(np.greater_equal(kinematic_viscosity, THINNEST) & np.less_equal(kinematic_viscosity, MOST))
    if np.ndim(kinematic_viscosity):
        kinematic_viscosity = np.where(outside, np.nan, kinematic_viscosity)
    elif outside:
        raise InputError(
            "temperature.base_oil",
            got=f"an oil with {1e6 * kinematic_viscosity:.3g} mm^2/s at its temperature",
            takes=f"{1e6 * THINNEST:g} to {1e6 * MOST:g} mm^2/s, for which the pressure-viscosity "
            "coefficient can be estimated; give pressure_viscosity_coefficient",
        )
    kind = BASE_OILS[base_oil]
    value = kind.correlation(kinematic_viscosity, slope, density)
    thin = np.less(kinematic_viscosity, LEAST)
    return Estimate(value, kind.scatter, kind.source, base_oil, thin if np.ndim(thin) else bool(thin))
