"""Generated maps for point contacts: exact shapes over (x, y), and random maps from a seed.

Heights are positive out of the body, and x runs along entrainment. A random map is the convolution of white
noise with a kernel of fixed size, on a lattice that is counted from (0, 0). The noise consists of square
tiles. The random stream of a tile depends on its position and on the seed, so that a larger map only adds
tiles.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.surfaces import generated_profiles as generators
from ehlectric.surfaces.generated_profiles import turned
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import convolved

# Points per correlation length of a Gaussian map, and per shortest wavelength of a self-affine map. With 8
# points the error of a cubic spline between the points is about 1e-5 of Rq.
POINTS_IN_CORRELATION, POINTS_IN_SHORTEST = 8, 4

# Largest number of points of the noise of a map; they take about 1.5 GB of memory.
MOST_POINTS = 20_000_000

# Length of the kernel of a Gaussian map on each side, in correlation lengths; its value there is 1e-14.
_GAUSSIAN_REACH = 4

# Length of the kernel of a self-affine map on each side, in roll-off wavelengths. The part that is cut off is
# about a hundredth of Rq.
_REACH = 4.0

# Roll-off wavelength over the shortest wavelength of a self-affine map, where the case does not give the
# latter.
SHORTEST_PART = 20.0

# Points along each side of a tile of noise.
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
    """Sinusoidal waviness of a surface, z = amplitude sin(2 pi s/wavelength + phase).

    s is the position along the direction ``orientation``.

    ``x`` and ``y``, position [m], zero at the centre of the contact; ``amplitude`` and ``wavelength`` [m];
    ``phase`` [rad]; ``orientation``, direction in which the wavelength is measured, from the x axis,
    counter-clockwise [degrees]. Returns height [m], shape (...).

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
    """Single round Gaussian asperity, z = height exp(-4 ln 2 (r/width)^2), at the distance r from its middle.
    ``x`` and ``y`` [m]; ``height`` and ``width``, height of the asperity, and its diameter at half height
    [m]; ``position`` and ``position_y``, position of its top along x and y [m]. Returns height [m],
    shape (...).

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
    """Single round pit with a rim around it, as an electric discharge leaves it.

    The pit is a Gaussian bowl, ``depth`` deep and ``width`` wide at half depth. The rim is a Gaussian ring of
    height ``rim`` and of half the width of the pit. Its top is one ``width`` from the middle.

    ``x`` and ``y`` [m]; ``depth``, ``width`` and ``rim`` [m]; ``position`` and ``position_y``, position of
    the middle of the pit along x and y [m]. Returns height [m], shape (...).

    Examples
    --------
    >>> round(float(pit(1e-6, 2e-6, depth=1e-7, width=2e-6, position=1e-6, position_y=2e-6)) / 1e-7, 9)
    -1.0
    """
    distance = np.hypot(np.asarray(x, float) - position, np.asarray(y, float) - position_y)
    return generators.pit(distance, depth=depth, width=width, rim=rim)


# Shapes by the name of the generator in a case; the keyword arguments are the keys of the generator.
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
    """Random map of Gaussian heights with a Gaussian autocorrelation.

    The autocorrelation at the distances x and y is
    exp(-(x/correlation_length)^2 - (y/correlation_length_y)^2).

    ``rq``, root mean square height of the random process [m]; ``correlation_length`` and
    ``correlation_length_y``, distances along x and along y at which the autocorrelation is 1/e [m];
    ``reach_x`` and ``reach_y``, smallest distances along x and y from the middle to the sides of the map [m].
    Returns map with eight points per correlation length, one of them at (0, 0). Raises InputError if the map
    needs noise at more than ``MOST_POINTS`` points.

    Examples
    --------
    >>> import numpy as np
    >>> made = gaussian(rq=1e-8, correlation_length=1e-5, reach_x=1e-3, reach_y=1e-3, seed=1)
    >>> bool(abs(np.std(made.heights) - 1e-8) < 4e-10)
    True
    """
    lengths = correlation_length, correlation_length_y or correlation_length
    spacing = lengths[0] / POINTS_IN_CORRELATION, lengths[1] / POINTS_IN_CORRELATION
    # This Gaussian convolved with itself is the autocorrelation.
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
    """Random isotropic self-affine map with a power spectrum of q^(-2 - 2 hurst) beyond the roll-off.

    q is the wavenumber. Below the roll-off wavenumber the spectrum is constant.

    ``rq``, root mean square height of the random process [m]; ``rolloff_wavelength``, roll-off wavelength,
    above which the spectrum is constant [m]; ``reach_x`` and ``reach_y``, smallest distances along x and y
    from the middle to the sides of the map [m]; ``shortest`` [m]. Returns map with four points per shortest
    wavelength, one of them at (0, 0). Raises InputError if the map needs noise at more than ``MOST_POINTS``
    points.

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
    # The kernel is the inverse transform of the square root of the spectrum. It is computed over twice the
    # size that is kept, as the transform is periodic.
    n = scipy.fft.next_fast_len(4 * far, real=True)
    q = np.hypot(scipy.fft.fftfreq(n, spacing)[:, np.newaxis], scipy.fft.rfftfreq(n, spacing))
    root = np.maximum(q, 1.0 / rolloff_wavelength) ** (-1.0 - hurst) * (q <= 1.0 / shortest)
    quarter = scipy.fft.irfft2(root, (n, n))[: far + 1, : far + 1]
    # The outer half of the kernel is faded out, so that it has no step at its edge, which is a circle.
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
    """Convolution of white noise with a kernel that is symmetric about its middle, on points from (0, 0) on.

    The heights are scaled with their theoretical variance, the sum of the squares of the kernel. ``key`` is
    the key of the case that an error names.
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
    """Tile of white noise at the position (i, j) along x and y, in tiles; both may be negative."""
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
