"""Made surfaces of point contacts: exact shapes as functions of (x, y), and seeded random maps.

Heights are positive out of the body, x along entrainment. A random map is white noise on a lattice counted
from (0, 0), folded with a kernel of fixed size. The noise comes in square tiles, each from a stream of its
own that its place and the seed choose: a larger map only has more of them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.surfaces import made_profiles as generators
from ehlectric.surfaces.domain import turned
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import convolved

# Points of a made map in a correlation length, and in the shortest wave of a self-affine one. A cubic spline
# between the former is right to some 1e-5 of Rq.
POINTS_IN_CORRELATION, POINTS_IN_SHORTEST = 8, 4

# Points of noise beyond which a map is refused: some 1.5 GB are then in use.
MOST_POINTS = 20_000_000

# Correlation lengths after which the kernel of a Gaussian map is cut: it is 1e-14 there.
_GAUSSIAN_REACH = 4

# Roll-off wavelengths after which the kernel of a self-affine map is cut: some hundredth of Rq is beyond.
_REACH = 4.0

# The shortest wavelength of a self-affine map, in parts of the roll-off, where it is not given.
SHORTEST_PART = 20.0
_TILE = 128


def sinusoid(
    x: ArrayLike,
    y: ArrayLike,
    *,
    amplitude: float,
    wavelength: float,
    phase: float = 0.0,
    orientation: float = 0.0,
) -> Array:
    """Plane sinusoidal wave, amplitude sin(2 pi s/wavelength + phase), s along its orientation.

    Parameters
    ----------
    x, y : array_like, shapes that fit each other
        Position [m], zero at the centre of the contact.
    amplitude, wavelength : float
        Amplitude and wavelength [m].
    phase : float
        Phase at (0, 0) [rad].
    orientation : float
        Direction in which the wavelength is measured, from the x axis, counter-clockwise [degrees]; the
        ridges lie across it.

    Returns
    -------
    ndarray
        Height [m].

    Examples
    --------
    >>> float(sinusoid(0.0, 1e-5, amplitude=2e-8, wavelength=4e-5, orientation=90.0))
    2e-08
    """
    along, _ = turned(x, y, orientation)
    return generators.sinusoid(along, amplitude=amplitude, wavelength=wavelength, phase=phase)


def asperity(
    x: ArrayLike, y: ArrayLike, *, height: float, width: float, position: float = 0.0, position_y: float = 0.0
) -> Array:
    """A single round Gaussian asperity, height exp(-4 ln 2 (r/width)^2), r from its middle.

    Parameters
    ----------
    x, y : array_like, shapes that fit each other
        Position [m].
    height, width : float
        Height, and diameter at half of it [m].
    position, position_y : float
        Where its top is [m].

    Returns
    -------
    ndarray
        Height [m].

    Examples
    --------
    >>> round(float(asperity(3e-7, 4e-7, height=1e-7, width=1e-6)) / 1e-7, 9)
    0.5
    """
    distance = np.hypot(np.asarray(x, float) - position, np.asarray(y, float) - position_y)
    return generators.asperity(distance, height=height, width=width)


def pit(
    x: ArrayLike,
    y: ArrayLike,
    *,
    depth: float,
    width: float,
    rim: float = 0.0,
    position: float = 0.0,
    position_y: float = 0.0,
) -> Array:
    """A single round pit with a rim around it, as a discharge leaves it: the pit of a profile, turned round.

    Parameters
    ----------
    x, y : array_like, shapes that fit each other
        Position [m].
    depth, width, rim : float
        Depth, diameter at half depth and height of the rim [m]; the top of the rim is one width from the
        middle.
    position, position_y : float
        Where its middle is [m].

    Returns
    -------
    ndarray
        Height [m].

    Examples
    --------
    >>> round(float(pit(1e-6, 2e-6, depth=1e-7, width=2e-6, position=1e-6, position_y=2e-6)) / 1e-7, 9)
    -1.0
    """
    distance = np.hypot(np.asarray(x, float) - position, np.asarray(y, float) - position_y)
    return generators.pit(distance, depth=depth, width=width, rim=rim)


# Shapes by the name of their generator in a case; their keywords are its keys.
SHAPES: dict[str, Callable[..., Array]] = {"sinusoid": sinusoid, "pit": pit, "asperity": asperity}


def gaussian(
    *,
    rq: float,
    correlation_length: float,
    reach_x: float,
    reach_y: float,
    seed: int,
    correlation_length_y: float | None = None,
) -> Map:
    """A random map of Gaussian heights, its autocorrelation exp(-(x/correlation_length)^2 - (y/its own)^2).

    Parameters
    ----------
    rq : float
        Root mean square height of all such maps together [m]; a small one has another of its own.
    correlation_length, correlation_length_y : float
        Distances along x and along y at which the autocorrelation is 1/e [m]; one for both where the second
        is not given.
    reach_x, reach_y : float
        Distances from the middle to which the map reaches [m], at the least.
    seed : int
        The same seed, rq and correlation lengths give the same height at the same position, whatever the
        size.

    Returns
    -------
    Map
        With eight points a correlation length, one of them at (0, 0).

    Raises
    ------
    InputError
        Where that would be too many points.

    Examples
    --------
    >>> import numpy as np
    >>> made = gaussian(rq=1e-8, correlation_length=1e-5, reach_x=1e-3, reach_y=1e-3, seed=1)
    >>> bool(abs(np.std(made.heights) - 1e-8) < 4e-10)
    True
    """
    lengths = correlation_length, correlation_length_y or correlation_length
    spacing = lengths[0] / POINTS_IN_CORRELATION, lengths[1] / POINTS_IN_CORRELATION
    # Two of these Gaussians folded give the autocorrelation.
    far = _GAUSSIAN_REACH * POINTS_IN_CORRELATION
    side = np.exp(-2.0 * (np.arange(-far, far + 1) / POINTS_IN_CORRELATION) ** 2)
    return _folded(np.outer(side, side), spacing, (reach_x, reach_y), rq, seed, "correlation_length")


def self_affine(
    *,
    rq: float,
    hurst: float,
    rolloff_wavelength: float,
    reach_x: float,
    reach_y: float,
    seed: int,
    shortest: float,
) -> Map:
    """A random isotropic self-affine map: power spectrum constant below the roll-off, then q^(-2 - 2 hurst).

    Parameters
    ----------
    rq : float
        Root mean square height of all such maps together [m]; a small one has another of its own.
    hurst : float
        Hurst exponent, from 0 (rough) to 1 (smooth).
    rolloff_wavelength : float
        Wavelength above which the spectrum is flat [m].
    reach_x, reach_y : float
        Distances from the middle to which the map reaches [m], at the least.
    seed : int
        With the same seed and wavelengths the height at a position is the same, whatever the size.
    shortest : float
        Shortest wavelength [m]; shorter ones are weaker by some orders of magnitude.

    Returns
    -------
    Map
        With four points in the shortest wavelength, one of them at (0, 0).

    Raises
    ------
    InputError
        Where that would be too many points.

    Examples
    --------
    >>> import numpy as np
    >>> made = dict(rq=1e-8, hurst=0.8, rolloff_wavelength=1e-4, seed=1, shortest=2e-5)
    >>> heights = self_affine(**made, reach_x=2e-3, reach_y=2e-3).heights
    >>> bool(abs(np.std(heights) - 1e-8) < 5e-10)
    True
    """
    spacing = shortest / POINTS_IN_SHORTEST
    far = int(np.ceil(_REACH * rolloff_wavelength / spacing))
    _check_points((2 * far, 2 * far), (spacing, spacing), "shortest_wavelength")
    # The kernel is the inverse transform of the spectrum's root, over twice what is kept of it.
    n = fft.next_fast_len(4 * far, real=True)
    q = np.hypot(fft.fftfreq(n, spacing)[:, np.newaxis], fft.rfftfreq(n, spacing))
    root = np.maximum(q, 1.0 / rolloff_wavelength) ** (-1.0 - hurst) * (q <= 1.0 / shortest)
    quarter = fft.irfft2(root, (n, n))[: far + 1, : far + 1]
    # Faded over its outer half, so that it has no step at its end, which is a circle.
    distance = np.hypot(*np.ogrid[: far + 1, : far + 1]) / far
    quarter *= 0.5 - 0.5 * np.cos(np.pi * np.clip(2.0 - 2.0 * distance, 0.0, 1.0))
    kernel = np.pad(quarter, ((far, 0), (far, 0)), mode="reflect")
    return _folded(kernel, (spacing, spacing), (reach_x, reach_y), rq, seed, "shortest_wavelength")


def _folded(
    kernel: Array,
    spacing: tuple[float, float],
    reach: tuple[float, float],
    rq: float,
    seed: int,
    key: str,
) -> Map:
    """White noise folded with a kernel that is symmetric about its middle, on points counted from (0, 0).

    The variance is that of theory, the sum of the kernel's squares.
    """
    half = [int(np.ceil(length / d)) for length, d in zip(reach, spacing, strict=True)]
    outer = [k + n // 2 for k, n in zip(half, kernel.shape, strict=True)]
    _check_points((2 * outer[0] + 1, 2 * outer[1] + 1), spacing, key)
    kept = tuple(slice(n - 1, n + 2 * k) for n, k in zip(kernel.shape, half, strict=True))
    heights = convolved(_noise(outer[0], outer[1], seed), kernel)[kept]
    return Map(*spacing, heights * (rq / np.sqrt(np.sum(kernel**2))))


def _noise(far_x: int, far_y: int, seed: int) -> Array:
    """White noise at the points from -far to far along both axes, shape (2 far_x + 1, 2 far_y + 1)."""
    first = [-(far // _TILE) - 1 for far in (far_x, far_y)]
    last = [far // _TILE for far in (far_x, far_y)]
    tiles = [[_tile(i, j, seed) for j in range(first[1], last[1] + 1)] for i in range(first[0], last[0] + 1)]
    corner = [-far - _TILE * k for far, k in zip((far_x, far_y), first, strict=True)]
    return np.block(tiles)[corner[0] : corner[0] + 2 * far_x + 1, corner[1] : corner[1] + 2 * far_y + 1]


def _tile(i: int, j: int, seed: int) -> Array:
    """The tile of noise in column i and row j, either of which may be negative."""
    place = tuple(2 * k if k >= 0 else -2 * k - 1 for k in (i, j))
    stream = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=place))
    return stream.standard_normal((_TILE, _TILE))


def _check_points(points: tuple[int, int], spacing: tuple[float, float], key: str) -> None:
    if points[0] * points[1] > MOST_POINTS:
        raise InputError(
            key,
            f"asks for {points[0]} x {points[1]} points, {spacing[0]:.3g} and {spacing[1]:.3g} m apart;",
            takes=f"a longer one, which needs at most {MOST_POINTS:.0e} in all",
        )
