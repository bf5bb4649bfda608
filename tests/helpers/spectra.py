"""Spectral moments of periodic surfaces from their power spectra, to compare those of the program with."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ehlectric.arrays import Array
from ehlectric.formulas.asperities import SpectralMoments


def periodic_moments(
    heights: Array, spacing: float | Sequence[float], shortest: float | None = None
) -> SpectralMoments:
    """Spectral moments of a periodic profile or isotropic periodic map, from its power spectrum.

    The spectrum gives the derivatives of all waves exactly and can be cut off sharply at a wavelength. It
    takes the surface as periodic: use it for generated surfaces, and ``profile_moments`` for measured ones.

    Parameters
    ----------
    heights : ndarray, shape (n,) or (nx, ny)
        Heights over one period [m].
    spacing : float or (float, float)
        Distance of the points [m], of a map along x and y.
    shortest : float, optional
        Cutoff wavelength [m]: shorter waves are left out. By default no wave is.

    Returns
    -------
    SpectralMoments
        m0 [m^2], m2, and m4 [1/m^2]; of a map, of the lines of any direction over an isotropic surface with
        its spectrum: m2 is half the mean square gradient, and m4 is 3/8 of the mean square Laplacian.

    Examples
    --------
    >>> wave = 1e-7 * np.sin(2 * np.pi * np.arange(100) / 100)
    >>> moments = periodic_moments(wave, 1e-7)
    >>> exact = 0.5e-14 * (2 * np.pi / 1e-5) ** 4
    >>> bool(abs(moments.m4 / exact - 1) < 1e-12)
    True
    """
    spacings = np.broadcast_to(np.asarray(spacing, dtype=float), (heights.ndim,))
    axes = [2.0 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(heights.shape, spacings, strict=True)]
    squared = np.zeros(heights.shape)
    for axis, numbers in enumerate(axes):
        squared += np.expand_dims(numbers**2, [k for k in range(heights.ndim) if k != axis])
    power = np.abs(np.fft.fftn(heights - np.mean(heights))) ** 2 / heights.size**2
    if shortest is not None:
        power = np.where(squared <= (2.0 * np.pi / shortest) ** 2 * (1.0 + 1e-12), power, 0.0)
    # Means of cos^2 and of cos^4 over all directions of a map, 1/2 and 3/8; one for a profile.
    second, fourth = (1.0, 1.0) if heights.ndim == 1 else (0.5, 0.375)
    return SpectralMoments(
        float(np.sum(power)),
        second * float(np.sum(power * squared)),
        fourth * float(np.sum(power * squared**2)),
    )
