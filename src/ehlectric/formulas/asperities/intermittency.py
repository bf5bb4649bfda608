"""Share of time with metallic contact: of a contact from its expected spots, and of a whole bearing."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.formulas.asperities.statistical import AsperityContact


def expected_spots(spots_per_area: ArrayLike, area: ArrayLike) -> Array:
    """Expected number of simultaneous spots in an area.

    Parameters
    ----------
    spots_per_area : array_like, shape (...)
        Spots per nominal area [1/m^2], >= 0, as in ``AsperityContact``.
    area : array_like, shape (...)
        Area of the contact, such as the area of the Hertz ellipse [m^2], >= 0.

    Returns
    -------
    ndarray, shape (...)
        Expected number of spots, dimensionless.

    Examples
    --------
    >>> float(expected_spots(1e9, 1e-9))
    1.0
    """
    number: Array = np.multiply(spots_per_area, area)
    return number


def contact_time_share(expected: ArrayLike) -> Array:
    """Share of time with at least one spot, 1 - exp(-N), where N spots are expected at a time.

    Spots come and go independently of each other, so that their number is a Poisson variable. Asperities of
    a wavy or directional surface come in groups: then this share is an upper bound at the same N.

    Parameters
    ----------
    expected : array_like, shape (...)
        Expected number N of simultaneous spots, dimensionless, >= 0.

    Returns
    -------
    ndarray, shape (...)
        Share of time, dimensionless, from 0 to 1; accurate for small N too.

    Raises
    ------
    ValueError
        If a number is negative.

    Examples
    --------
    >>> contact_time_share([0.0, 0.1, 1.0]).round(4).tolist()
    [0.0, 0.0952, 0.6321]
    """
    number = np.asarray(expected, dtype=float)
    if not np.all(number >= 0.0):
        raise ValueError("the expected number of spots is at least 0")
    share: Array = -np.expm1(-number)
    return share


def area_while_touching(contact: AsperityContact, area: ArrayLike) -> Array:
    """Mean real area of contact while there is at least one spot, A f/(1 - exp(-N)).

    With the real area fraction f and the number N = n A of spots that are expected in the nominal area A. Of
    few expected spots it is the mean area of one, f/n; of many it is A f.

    Parameters
    ----------
    contact : AsperityContact
        Real area fraction and spots per area, shape (...).
    area : array_like, shape (...)
        Nominal area, such as that of the Hertz ellipse [m^2], >= 0.

    Returns
    -------
    ndarray, shape (...)
        Real area [m^2]; 0 where no spot is expected.

    Examples
    --------
    Spots of 1e-13 m^2 each, of which a millionth, and of which a hundred are expected:

    >>> from ehlectric.formulas.asperities.statistical import AsperityContact
    >>> density = np.array([1e3, 1e11])
    >>> spots = AsperityContact(pressure=np.zeros(2), area_fraction=1e-13 * density, spots_per_area=density)
    >>> area_while_touching(spots, 1e-9).round(18).tolist()
    [1e-13, 1e-11]
    """
    nominal = np.asarray(area, dtype=float)
    share = contact_time_share(expected_spots(contact.spots_per_area, nominal))
    real = contact.area_fraction * nominal
    found: Array = np.divide(real, share, out=np.zeros(np.broadcast(real, share).shape), where=share > 0.0)
    return found


def bearing_time_share(inner: ArrayLike, outer: ArrayLike, axis: int = -1) -> Array:
    """Share of time in which a bearing conducts, 1 - prod_j (1 - p_inner_j p_outer_j) over its elements.

    An element conducts while both its contacts do; they are in series. One conducting element shorts the
    bearing; its elements are in parallel. All contacts are taken as independent of each other.

    Parameters
    ----------
    inner, outer : array_like, shape (..., elements)
        Shares of time with contact at the inner and outer ring, for each element, dimensionless, 0 to 1.
        They broadcast against each other.
    axis : int, optional
        Axis of the elements.

    Returns
    -------
    ndarray, shape (...)
        Share of time in which the bearing conducts, dimensionless; accurate for small shares too.

    Raises
    ------
    ValueError
        If a share is not from 0 to 1.

    Notes
    -----
    A vibration or a change of load thins several films at once. Where both contacts of an element close
    together, the element conducts more often than p_inner p_outer; where several elements close together,
    the bearing conducts less often than elements that take turns.

    Examples
    --------
    >>> round(float(bearing_time_share([0.5, 0.1], [0.2, 0.1])), 6)
    0.109
    """
    p, q = np.asarray(inner, dtype=float), np.asarray(outer, dtype=float)
    for each in (p, q):
        if not np.all((each >= 0.0) & (each <= 1.0)):
            raise ValueError("a share of time lies between 0 and 1")
    with np.errstate(divide="ignore"):  # the logarithm of no open time is minus infinity
        open_time = np.sum(np.log1p(-p * q), axis=axis)
    share: Array = -np.expm1(open_time)
    return share
