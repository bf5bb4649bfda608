"""Viscosity index of an oil after ASTM D2270, and the viscosity grades of ISO 3448; viscosities in m^2/s."""

from __future__ import annotations

import math
from bisect import bisect_right

from scipy.optimize import brentq

# Viscosity grades of ISO 3448. The middle of a grade is its number in mm^2/s at 40 degC, except for the four
# thinnest, and its range is 10 % of the middle to either side.
_MIDDLES = {2: 2.2, 3: 3.2, 5: 4.6, 7: 6.8}
GRADES = (2, 3, 5, 7, 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)
GRADE_WIDTH = 0.1

# Range of viscosities at 100 degC for which ASTM D2270 gives its reference oils [mm^2/s]. Above 70 mm^2/s its
# equations have no upper end; the largest value keeps the search finite.
LEAST_AT_100, _MOST_AT_100 = 2.0, 1e4

# Reference oils of ASTM D2270-10, appendix X2: viscosities at 40 degC of an oil of index 0, which is
# L = a Y^2 + b Y + c, and of one of index 100, H = d Y^2 + e Y + f, with the same viscosity Y at 100 degC, in
# mm^2/s. A row holds from its first number to that of the next row.
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

    Parameters
    ----------
    grade : int
        Viscosity grade, one of ``GRADES``.

    Returns
    -------
    float
        Kinematic viscosity at 40 degC [m^2/s].

    Examples
    --------
    >>> grade_middle(46), grade_middle(5)
    (4.6e-05, 4.6e-06)
    """
    return float(f"{1e-6 * _MIDDLES.get(grade, grade):.12g}")


def _reference(at_100: float) -> tuple[float, float]:
    """Viscosities L and H at 40 degC of the reference oils with this viscosity at 100 degC, in mm^2/s."""
    _, a, b, c, d, e, f = _REFERENCE[max(bisect_right(_FROM, at_100) - 1, 0)]
    return (a * at_100 + b) * at_100 + c, (d * at_100 + e) * at_100 + f


def viscosity_index(at_40: float, at_100: float) -> float:
    """Viscosity index of an oil, by procedures A (up to 100) and B (above) of ASTM D2270.

    Parameters
    ----------
    at_40, at_100 : float
        Kinematic viscosities at 40 and 100 degC [m^2/s]; at 100 degC at least 2 mm^2/s.

    Returns
    -------
    float
        Viscosity index, dimensionless, not rounded.

    Raises
    ------
    ValueError
        If the viscosity at 100 degC is below 2 mm^2/s.

    Notes
    -----
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


def viscosity_at_100(at_40: float, index: float) -> float:
    """Kinematic viscosity at 100 degC of an oil with a viscosity index: ASTM D2270 solved for it.

    Parameters
    ----------
    at_40 : float
        Kinematic viscosity at 40 degC [m^2/s].
    index : float
        Viscosity index, from 0.

    Returns
    -------
    float
        Kinematic viscosity at 100 degC [m^2/s].

    Raises
    ------
    ValueError
        If the oil has less than 2 mm^2/s at 100 degC, or more than the equations are solved for.

    Examples
    --------
    >>> round(viscosity_at_100(46e-6, 100.0) * 1e6, 2)
    6.76
    """
    target = 1e6 * at_40
    bottom, top = LEAST_AT_100, _MOST_AT_100
    if not _at_40(bottom, index) <= target <= _at_40(top, index):
        raise ValueError(
            f"an oil with {target:g} mm^2/s at 40 degC and viscosity index {index:g} has less than "
            f"{LEAST_AT_100:g} mm^2/s at 100 degC, the least of ASTM D2270"
        )
    return 1e-6 * float(brentq(lambda at_100: _at_40(at_100, index) - target, bottom, top, xtol=1e-12))


def _at_40(at_100: float, index: float) -> float:
    """Viscosity at 40 degC of the oil with a viscosity at 100 degC and an index, in mm^2/s."""
    low, high = _reference(at_100)
    if index <= 100.0:
        return low - 0.01 * index * (low - high)
    return high / math.pow(at_100, math.log10(1.0 + _B * (index - 100.0)))
