"""Roughness under the pressure of the film: each wave keeps a share of its amplitude."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ehlectric.arrays import Array


def line_amplitude_ratio(wavelength: ArrayLike, half_width: float, moes_m: float, moes_l: float) -> Array:
    """Share of its amplitude that a wave across entrainment keeps in a line contact in pure rolling.

    A_d/A_i = 1/(1 + 0.17 N + 0.03 N^2) with N = (wavelength/b) M^(3/4) L^(-1/2). Short waves keep their
    amplitude, long waves are pressed flat.

    Parameters
    ----------
    wavelength : array_like, shape (...)
        Wavelength [m], > 0; infinite gives 0.
    half_width : float
        Half-width b of the dry contact [m].
    moes_m, moes_l : float
        Moes' groups M and L of the contact, dimensionless, > 0; L with the slope of ln(eta) at no pressure.

    Returns
    -------
    ndarray, shape (...)
        Amplitude in the film over that of the undeformed wave, from 0 to 1.

    Notes
    -----
    C. H. Venner, F. Couhier, A. A. Lubrecht and J. A. Greenwood (1997), doi:10.1016/S0167-8922(08)70440-1.
    The authors give the fit for ratios up to 0.5. Of 25 waves solved with this program the ratios up to 0.5
    are within 0.05 of it, the others up to 0.2 above it. The waves do not touch the other surface.

    Examples
    --------
    >>> line_amplitude_ratio([1e-6, 1e-4], 1e-4, 100.0, 10.0).round(3).tolist()
    [0.983, 0.175]
    """
    group = np.asarray(wavelength, dtype=float) / half_width * moes_m**0.75 / np.sqrt(moes_l)
    with np.errstate(over="ignore"):
        ratio: Array = 1.0 / (1.0 + 0.17 * group + 0.03 * group**2)
    return ratio


def point_amplitude_ratio(wavelength: ArrayLike, half_width: float, moes_m: float, moes_l: float) -> Array:
    """Share of its amplitude that isotropic waviness keeps in a circular contact in pure rolling.

    A_d/A_i = 1/(1 + 0.15 N + 0.015 N^2) with N = (wavelength/b) (M/L)^(1/2).

    Parameters
    ----------
    wavelength : array_like, shape (...)
        Wavelength [m], > 0; infinite gives 0.
    half_width : float
        Semi-axis b of the dry contact along entrainment [m].
    moes_m, moes_l : float
        Moes' groups M and L of the contact, dimensionless, > 0; L with the slope of ln(eta) at no pressure.

    Returns
    -------
    ndarray, shape (...)
        Amplitude in the film over that of the undeformed wave, from 0 to 1.

    Notes
    -----
    C. H. Venner and A. A. Lubrecht, Proc. IMechE J 214 (2000); constants from memory and not checked. For an
    ellipse it is an approximation.

    Examples
    --------
    >>> point_amplitude_ratio([1e-6, 1e-4], 1e-4, 1000.0, 10.0).round(3).tolist()
    [0.985, 0.25]
    """
    group = np.asarray(wavelength, dtype=float) / half_width * np.sqrt(moes_m / moes_l)
    with np.errstate(over="ignore"):
        ratio: Array = 1.0 / (1.0 + 0.15 * group + 0.015 * group**2)
    return ratio


def flattened(heights: Array, spacing: float | tuple[float, float], ratio: Callable[[Array], Array]) -> Array:
    """Heights of a profile or a map under the pressure of the film, about their mean.

    Parameters
    ----------
    heights : ndarray, shape (n,) or (nx, ny)
        Undeformed heights [m].
    spacing : float or (float, float)
        Distance of the points [m], of a map along x and y.
    ratio : callable
        Share of the amplitude that a wave keeps, as a function of its wavelength [m], array of shape (...).
        The wavelength of a map is that along the direction of its wave; infinity is that of the mean.

    Returns
    -------
    ndarray, shape of ``heights``
        Deformed heights [m].

    Notes
    -----
    The surface is continued by reflection at its sides, so that there is no step. Waves are flattened
    independently of each other, which holds for amplitudes below the film thickness. A contact that touches
    is extrapolated.

    Examples
    --------
    >>> wave = np.cos(2 * np.pi * (np.arange(100) + 0.5) / 50)
    >>> half = flattened(wave, 1e-6, lambda wavelength: np.where(wavelength > 1e-5, 0.5, 1.0))
    >>> bool(np.allclose(half, 0.5 * wave))
    True
    """
    spacings = np.broadcast_to(np.asarray(spacing, dtype=float), (heights.ndim,))
    # The k-th cosine of the transform has k half waves in the n points.
    numbers = [np.arange(n) / (2.0 * n * d) for n, d in zip(heights.shape, spacings, strict=True)]
    whole = np.sqrt(sum(each**2 for each in np.meshgrid(*numbers, indexing="ij")))
    with np.errstate(divide="ignore"):
        kept = ratio(1.0 / whole)
    deformed: Array = fft.idctn(kept * fft.dctn(heights - np.mean(heights)))
    return deformed
