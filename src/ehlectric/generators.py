"""Made surfaces: exact shapes as functions of position, and seeded random profiles.

Heights are positive out of the body.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ehlectric.roughness import Profile
from ehlectric.typing import Array

_FOUR_LN_2 = 4.0 * np.log(2.0)


def sinusoid(x: ArrayLike, *, amplitude: float, wavelength: float, phase: float = 0.0) -> Array:
    """Sinusoidal waviness, amplitude sin(2 pi x/wavelength + phase).

    Parameters
    ----------
    x : array_like, shape (...)
        Position [m], zero at the centre of the contact.
    amplitude, wavelength : float
        Amplitude and wavelength [m].
    phase : float
        Phase at x = 0 [rad].

    Returns
    -------
    ndarray, shape (...)
        Height [m].

    Examples
    --------
    >>> float(sinusoid(1e-5, amplitude=2e-8, wavelength=4e-5))
    2e-08
    """
    height: Array = amplitude * np.sin(2.0 * np.pi * np.asarray(x, dtype=float) / wavelength + phase)
    return height


def asperity(x: ArrayLike, *, height: float, width: float, position: float = 0.0) -> Array:
    """A single Gaussian asperity, height exp(-4 ln 2 ((x - position)/width)^2).

    Parameters
    ----------
    x : array_like, shape (...)
        Position [m].
    height, width : float
        Height, and width at half of it [m].
    position : float
        Where its top is [m].

    Returns
    -------
    ndarray, shape (...)
        Height [m].

    Examples
    --------
    >>> round(float(asperity(0.5e-6, height=1e-7, width=1e-6)) / 1e-7, 9)
    0.5
    """
    distance = (np.asarray(x, dtype=float) - position) / width
    heights: Array = height * np.exp(-_FOUR_LN_2 * distance**2)
    return heights


def pit(x: ArrayLike, *, depth: float, width: float, rim: float = 0.0, position: float = 0.0) -> Array:
    """A single pit with a rim, as a discharge leaves it.

    A Gaussian bowl of ``depth`` below the surface and ``width`` at half of it, and on each side a Gaussian
    rim of height ``rim`` and half that width, one width from the middle.

    Parameters
    ----------
    x : array_like, shape (...)
        Position [m].
    depth, width, rim : float
        Depth, width at half depth and height of the rim [m].
    position : float
        Where its middle is [m].

    Returns
    -------
    ndarray, shape (...)
        Height [m].

    Examples
    --------
    >>> round(float(pit(0.0, depth=1e-7, width=2e-6)) / 1e-7, 9)
    -1.0
    """
    left = asperity(x, height=rim, width=0.5 * width, position=position - width)
    right = asperity(x, height=rim, width=0.5 * width, position=position + width)
    return left + right - asperity(x, height=depth, width=width, position=position)


def gaussian(*, rq: float, correlation_length: float, length: float, seed: int) -> Profile:
    """A random profile of Gaussian heights with the autocorrelation exp(-(distance/correlation_length)^2).

    Parameters
    ----------
    rq : float
        Root mean square height [m], met by the profile itself.
    correlation_length : float
        Distance at which the autocorrelation is 1/e [m].
    length : float
        Length of the profile [m]; it is periodic over a little more.
    seed : int
        The same seed, rq and lengths give the same profile.

    Returns
    -------
    Profile
        With sixteen points a correlation length.

    Examples
    --------
    >>> import numpy as np
    >>> heights = gaussian(rq=1e-8, correlation_length=1e-5, length=1e-3, seed=1).heights
    >>> round(float(np.std(heights)) * 1e9, 6)
    10.0
    """
    spacing = correlation_length / 16.0
    return _spectral(spacing, length, rq, seed, lambda q: np.exp(-((q * correlation_length) ** 2) / 4.0))


def self_affine(
    *, rq: float, hurst: float, rolloff_wavelength: float, length: float, seed: int, shortest: float
) -> Profile:
    """A random self-affine profile: power spectrum constant below the roll-off, then q^(-1 - 2 hurst).

    Parameters
    ----------
    rq : float
        Root mean square height [m], met by the profile itself.
    hurst : float
        Hurst exponent, from 0 (rough) to 1 (smooth).
    rolloff_wavelength : float
        Wavelength above which the spectrum is flat [m].
    length : float
        Length of the profile [m]; it is periodic over a little more.
    seed : int
        The same seed and lengths give the same profile.
    shortest : float
        Shortest wavelength [m].

    Returns
    -------
    Profile
        With four points in the shortest wavelength.

    Examples
    --------
    >>> import numpy as np
    >>> made = dict(rq=1e-8, hurst=0.8, rolloff_wavelength=1e-4, length=1e-3, seed=1, shortest=1e-6)
    >>> round(float(np.std(self_affine(**made).heights)) * 1e9, 6)
    10.0
    """
    rolloff, cut = 2.0 * np.pi / rolloff_wavelength, 2.0 * np.pi / shortest

    def spectrum(q: Array) -> Array:
        return np.maximum(q, rolloff) ** (-1.0 - 2.0 * hurst) * (q <= cut)

    return _spectral(shortest / 4.0, length, rq, seed, spectrum)


def _spectral(
    spacing: float, length: float, rq: float, seed: int, spectrum: Callable[[Array], Array]
) -> Profile:
    """Filtered white noise of a power spectrum, scaled to its Rq; periodic, so that no end is special."""
    n = fft.next_fast_len(int(np.ceil(length / spacing)) + 1, real=True)
    noise = np.random.default_rng(seed).standard_normal(n)
    q = 2.0 * np.pi * fft.rfftfreq(n, spacing)
    shape = np.sqrt(spectrum(q))
    shape[0] = 0.0
    heights = fft.irfft(fft.rfft(noise) * shape, n)
    return Profile(spacing, heights * (rq / np.sqrt(np.mean(heights**2))))
