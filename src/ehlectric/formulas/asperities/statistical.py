"""Contact of randomly rough surfaces: pressure, real area and number of spots against separation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.formulas.asperities.integrals import greenwood_integral


@dataclass(frozen=True, kw_only=True)
class Summits:
    """Summits of a rough surface: spherical caps of one radius with Gaussian heights.

    Attributes
    ----------
    density : float
        Number of summits per area n [1/m^2], > 0.
    radius : float
        Radius of the caps beta [m], > 0.
    height_deviation : float
        Standard deviation of the summit heights [m], > 0. Of two rough surfaces it is that of the sum of both
        heights, sqrt(sigma_s1^2 + sigma_s2^2).
    highest : float, optional
        Height above the mean of the summits, in standard deviations, to which all higher summits are worn
        down; by default none is. Above this separation nothing touches. Run-in surfaces have lost their
        highest peaks, and the number of spots of a thin film depends on them alone. Worn summits keep their
        radius here, though they are blunt.
    """

    density: float
    radius: float
    height_deviation: float
    highest: float = np.inf

    @property
    def roughness_parameter(self) -> float:
        """Product n beta sigma_s, dimensionless; 0.03 to 0.05 for many surfaces."""
        return self.density * self.radius * self.height_deviation


@dataclass(frozen=True)
class AsperityContact:
    """Contact of the summits at one separation or an array of separations.

    Attributes
    ----------
    pressure : ndarray, shape (...)
        Asperity load per nominal area [Pa].
    area_fraction : ndarray, shape (...)
        Real contact area over nominal area, dimensionless. The models hold while it is small.
    spots_per_area : ndarray, shape (...)
        Number of contact spots per nominal area [1/m^2].
    """

    pressure: Array
    area_fraction: Array
    spots_per_area: Array


def greenwood_williamson(separation: ArrayLike, summits: Summits, reduced_modulus: float) -> AsperityContact:
    """Contact of a rough surface and a flat one after Greenwood and Williamson.

    With l = d/sigma_s and E* = E'/2: pressure (4/3) n sqrt(beta) sigma_s^(3/2) E* F_3/2(l), real area
    fraction pi n beta sigma_s F_1(l), spots per area n F_0(l). Two rough surfaces are taken as the sum of
    both heights against a flat: then ``summits`` are those of the sum.

    Parameters
    ----------
    separation : array_like, shape (...)
        Distance d of the mean plane of the summits to the flat [m], >= -12 standard deviations. See
        ``summit_separation`` for that of the mean plane of the surface.
    summits : Summits
        Summits of the rough surface, or of the sum of two.
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
    J. A. Greenwood and J. B. P. Williamson, Contact of nominally flat surfaces, Proc. R. Soc. A 295 (1966)
    300-319, doi:10.1098/rspa.1966.0242. Caps are elastic, have no effect on each other and do not merge.

    Examples
    --------
    >>> rough = Summits(density=2e11, radius=2e-6, height_deviation=100e-9)
    >>> contact = greenwood_williamson(200e-9, rough, 226e9)
    >>> round(float(contact.pressure) / 1e6, 2), round(float(contact.spots_per_area) / 1e9, 3)
    (8.96, 4.55)
    """
    level = np.asarray(separation, dtype=float) / summits.height_deviation
    n, beta, sigma = summits.density, summits.radius, summits.height_deviation
    stiffness = 4.0 / 3.0 * n * np.sqrt(beta) * sigma**1.5 * 0.5 * reduced_modulus
    return AsperityContact(
        pressure=stiffness * greenwood_integral(1.5, level, summits.highest),
        area_fraction=np.pi * summits.roughness_parameter * greenwood_integral(1.0, level, summits.highest),
        spots_per_area=n * greenwood_integral(0.0, level, summits.highest),
    )


def summit_separation(separation: ArrayLike, rq: float, bandwidth: float) -> Array:
    """Distance of the mean plane of the summits for a distance of the mean plane of the surface.

    Summits lie higher than the surface. For an isotropic Gaussian surface their mean height above the mean
    plane is 4 Rq/sqrt(pi alpha), with Nayak's bandwidth alpha = m0 m4/m2^2.

    Parameters
    ----------
    separation : array_like, shape (...)
        Distance of the mean plane of the surface to the other one [m].
    rq : float
        Rq of the surface, or of the sum of two surfaces [m].
    bandwidth : float
        Nayak's bandwidth alpha of the same heights, dimensionless, >= 1.5.

    Returns
    -------
    ndarray, shape (...)
        Distance of the mean plane of the summits to the other one [m].

    Notes
    -----
    J. I. McCool, Comparison of models for the contact of rough surfaces, Wear 107 (1986) 37-60.

    Examples
    --------
    >>> round(float(summit_separation(200e-9, 100e-9, 10.0)) * 1e9, 1)
    128.6
    """
    distance: Array = np.asarray(separation, dtype=float) - 4.0 * rq / np.sqrt(np.pi * bandwidth)
    return distance
