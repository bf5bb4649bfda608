"""Contact of two rough surfaces after Greenwood and Tripp, for comparison with the model of the program."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.formulas.asperities import AsperityContact, Summits, greenwood_integral


def greenwood_tripp(separation: ArrayLike, summits: Summits, reduced_modulus: float) -> AsperityContact:
    """Contact of two rough surfaces after Greenwood and Tripp: caps that meet off their axes.

    Both surfaces have the same density n and radius beta. With l = d/sigma_s, E* = E'/2 and
    F_n of ``greenwood_integral``: pressure (16 sqrt(2) pi/15) (n beta sigma_s)^2 sqrt(sigma_s/beta) E*
    F_5/2(l), real area fraction pi^2 (n beta sigma_s)^2 F_2(l), spots per area 4 pi n^2 beta sigma_s F_1(l).

    Parameters
    ----------
    separation : array_like, shape (...)
        Distance d of the mean planes of the summits of both surfaces [m], >= -12 standard deviations. See
        ``summit_separation`` for that of the mean planes of the surfaces.
    summits : Summits
        Density and radius of each surface alone, and the standard deviation of the sum of both summit
        heights.
    reduced_modulus : float
        Reduced modulus E' = 2 E* [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    AsperityContact
        Asperity pressure, area fraction and spots per area.

    Raises
    ------
    ValueError
        If a separation is below -12 standard deviations.

    Notes
    -----
    J. A. Greenwood and J. H. Tripp, The contact of two nominally flat rough surfaces, Proc. Inst. Mech. Eng.
    185 (1970) 625-633. The factors follow from Hertz: two caps with the offset r overlap by
    w = z1 + z2 - d - r^2/(4 beta), carry (4/3) E* (beta/2)^(1/2) w^(3/2) on the area pi (beta/2) w, and
    n^2 2 pi r dr of them have this offset. Caps are elastic, have no effect on each other and do not merge.

    Examples
    --------
    >>> rough = Summits(density=2e11, radius=2e-6, height_deviation=100e-9)
    >>> contact = greenwood_tripp(200e-9, rough, 226e9)
    >>> round(float(contact.pressure) / 1e6, 2), round(float(contact.spots_per_area) / 1e9, 3)
    (1.04, 0.854)
    """
    level = np.asarray(separation, dtype=float) / summits.height_deviation
    n, beta, sigma = summits.density, summits.radius, summits.height_deviation
    roughness = summits.roughness_parameter**2
    stiffness = 16.0 * np.sqrt(2.0) * np.pi / 15.0 * roughness * np.sqrt(sigma / beta) * 0.5 * reduced_modulus
    return AsperityContact(
        pressure=stiffness * greenwood_integral(2.5, level, summits.highest),
        area_fraction=np.pi**2 * roughness * greenwood_integral(2.0, level, summits.highest),
        spots_per_area=4.0 * np.pi * n**2 * beta * sigma * greenwood_integral(1.0, level, summits.highest),
    )
