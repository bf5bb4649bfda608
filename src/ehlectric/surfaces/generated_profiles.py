"""Generated profiles for line contacts, positive out of the body: exact shapes, and random ones by a seed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.cases.roughness_inputs import Roughness
from ehlectric.errors import InputError
from ehlectric.surfaces.profiles import Profile, convolved


@dataclass(frozen=True)
class Domain:
    """Domain of the film, over which the heights of rough surfaces are needed."""

    # inlet and outlet: ends along x [m].
    inlet: float
    outlet: float
    side: float = np.inf  # distance from y = 0 to either side [m]; infinite for a line contact

    @property
    def length(self) -> float:
        """Length along x [m]."""
        return self.outlet - self.inlet

    @property
    def shorter(self) -> float:
        """Length of the shorter side of the domain [m]."""
        return min(self.length, 2.0 * self.side)

    def reach(self, table: Roughness) -> tuple[float, float]:
        """Half-lengths [m] that a surface needs along its own x and y axes to cover the domain.

        ``table`` has the shift and the orientation of the surface.
        """
        x = np.array([self.inlet, self.outlet]) - table.shift
        y = np.array([-self.side, self.side]) - table.shift_y
        along, across = turned(x[:, np.newaxis], y, table.orientation or 0.0)
        return float(np.max(np.abs(along))), float(np.max(np.abs(across)))


def turned(x: ArrayLike, y: ArrayLike, orientation: float) -> tuple[Array, Array]:
    """Coordinates of positions (x, y) along axes that are rotated counter-clockwise. ``x`` and ``y`` [m];
    ``orientation``, angle of rotation of the axes [degrees]. Returns positions along the two rotated axes
    [m], shape (...).

    Examples
    --------
    >>> [round(float(value), 12) for value in turned(0.0, 1.0, 90.0)]
    [1.0, 0.0]
    """
    angle = np.deg2rad(orientation)
    x, y = np.asarray(x, float), np.asarray(y, float)
    return x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)


_FOUR_LN_2 = 4.0 * np.log(2.0)

# Points per correlation length of a Gaussian profile, and per shortest wavelength of a self-affine profile.
POINTS_IN_CORRELATION, POINTS_IN_SHORTEST = 16, 4

# Largest number of points of a generated profile; it takes about 1 GB of memory.
MOST_POINTS = 10_000_000

# Length of the kernel of a self-affine profile on each side, in roll-off wavelengths. The part that is cut
# off is less than a thousandth of Rq.
_REACH = 8.0


def sinusoid(x: ArrayLike, *, amplitude: float, wavelength: float, phase: float = 0.0) -> Array:
    """Sinusoidal waviness of a surface, z = amplitude sin(2 pi x/wavelength + phase). ``x``, position [m],
    zero at the centre of the contact, shape (...); ``amplitude`` and ``wavelength`` [m]; ``phase`` [rad].
    Returns height [m], shape (...).

    Examples
    --------
    >>> float(sinusoid(1e-5, amplitude=2e-8, wavelength=4e-5))
    2e-08
    """
    height: Array = amplitude * np.sin(2.0 * np.pi * np.asarray(x, dtype=float) / wavelength + phase)
    return height


def asperity(x: ArrayLike, *, height: float, width: float, position: float = 0.0) -> Array:
    """Single Gaussian asperity, z = height exp(-4 ln 2 ((x - position)/width)^2). ``x`` [m], shape (...);
    ``height`` and ``width``, height of the asperity, and its width at half height [m]; ``position`` [m].
    Returns height [m], shape (...).

    Examples
    --------
    >>> round(float(asperity(0.5e-6, height=1e-7, width=1e-6)) / 1e-7, 9)
    0.5
    """
    distance = (np.asarray(x, dtype=float) - position) / width
    heights: Array = height * np.exp(-_FOUR_LN_2 * distance**2)
    return heights


def pit(x: ArrayLike, *, depth: float, width: float, rim: float = 0.0, position: float = 0.0) -> Array:
    """Single pit with a rim, as an electric discharge leaves it.

    The pit is a Gaussian bowl, ``depth`` deep and ``width`` wide at half depth. The rim is a Gaussian
    asperity on each side, of height ``rim`` and of half the width of the pit. Its top is one ``width`` from
    the middle.

    ``x`` [m], shape (...); ``depth``, ``width`` and ``rim`` [m]; ``position``, position of the middle of the
    pit [m]. Returns height [m], shape (...).

    Examples
    --------
    >>> round(float(pit(0.0, depth=1e-7, width=2e-6)) / 1e-7, 9)
    -1.0
    """
    left = asperity(x, height=rim, width=0.5 * width, position=position - width)
    right = asperity(x, height=rim, width=0.5 * width, position=position + width)
    return left + right - asperity(x, height=depth, width=width, position=position)


# Shapes by the name of the generator in a case; the keyword arguments are the keys of the generator.
SHAPES: dict[str, Callable[..., Array]] = {"sinusoid": sinusoid, "pit": pit, "asperity": asperity}


def gaussian(*, rq: float, correlation_length: float, length: float, seed: int) -> Profile:
    """Random profile of Gaussian heights with the autocorrelation exp(-(distance/correlation_length)^2).

    ``rq``, root mean square height of the random process [m]; ``correlation_length``, distance at which the
    autocorrelation is 1/e [m]; ``length``, smallest length of the profile [m]. Returns profile with sixteen
    points per correlation length, one of them at x = 0. Raises InputError if the profile has more than
    ``MOST_POINTS`` points.

    Examples
    --------
    >>> import numpy as np
    >>> heights = gaussian(rq=1e-8, correlation_length=1e-5, length=1.0, seed=1).heights
    >>> round(float(np.std(heights)) * 1e9, 1)
    10.0
    """
    spacing = correlation_length / POINTS_IN_CORRELATION
    # This Gaussian convolved with itself is the autocorrelation; at four correlation lengths it is 1e-14.
    kernel = np.exp(-2.0 * (np.arange(-64, 65) / POINTS_IN_CORRELATION) ** 2)
    return _folded(kernel, spacing, length, rq, seed, "correlation_length")


def self_affine(
    *, rq: float, hurst: float, rolloff_wavelength: float, length: float, seed: int, shortest: float
) -> Profile:
    """Random self-affine profile with a power spectrum of q^(-1 - 2 hurst) beyond the roll-off.

    q is the wavenumber. Below the roll-off wavenumber the spectrum is constant.

    ``rq``, root mean square height of the random process [m]; ``rolloff_wavelength``, roll-off wavelength,
    above which the spectrum is constant [m]; ``length``, smallest length of the profile [m]; ``shortest``
    [m]. Returns profile with four points per shortest wavelength, one of them at x = 0. Raises InputError if
    the profile has more than ``MOST_POINTS`` points.

    Examples
    --------
    >>> import numpy as np
    >>> made = dict(rq=1e-8, hurst=0.8, rolloff_wavelength=1e-4, length=1.0, seed=1, shortest=1e-5)
    >>> round(float(np.std(self_affine(**made).heights)) * 1e9, 1)
    10.0
    """
    spacing = shortest / POINTS_IN_SHORTEST
    reach = int(np.ceil(_REACH * rolloff_wavelength / spacing))
    _check_points(2 * reach, spacing, 2.0 * reach * spacing, "shortest_wavelength")
    # The kernel is the inverse cosine transform of the square root of the spectrum. It is computed over four
    # times the length that is kept, as the transform is periodic.
    n = scipy.fft.next_fast_len(8 * reach, real=True)
    q = scipy.fft.rfftfreq(n, spacing)
    root = np.maximum(q, 1.0 / rolloff_wavelength) ** (-0.5 - hurst) * (q <= 1.0 / shortest)
    # The outer half of the kernel is faded out, so that it has no step at its ends.
    fade = np.clip(2.0 - 2.0 * np.arange(reach + 1) / reach, 0.0, 1.0)
    half = scipy.fft.irfft(root, n)[: reach + 1] * (0.5 - 0.5 * np.cos(np.pi * fade))
    return _folded(np.concatenate([half[:0:-1], half]), spacing, length, rq, seed, "shortest_wavelength")


def _folded(kernel: Array, spacing: float, length: float, rq: float, seed: int, key: str) -> Profile:
    """Convolution of white noise with a symmetric kernel, on points that are counted from x = 0.

    The noise on the right and on the left comes from two streams, so that a longer profile only adds points
    at its ends. The heights are scaled with their theoretical variance, the sum of the squares of the kernel.
    ``key`` is the key of the case that an error names.
    """
    reach = kernel.size // 2
    half = int(np.ceil(0.5 * length / spacing))
    _check_points(2 * (half + reach), spacing, length, key)
    right, left = (
        np.random.default_rng(stream).standard_normal(half + reach + side)
        for side, stream in zip((1, 0), np.random.SeedSequence(seed).spawn(2), strict=True)
    )
    noise = np.concatenate([left[::-1], right])
    heights = convolved(noise, kernel)[kernel.size - 1 : noise.size]
    return Profile(spacing, heights * (rq / np.sqrt(np.sum(kernel**2))))


def _check_points(points: int, spacing: float, length: float, key: str) -> None:
    if points > MOST_POINTS:
        raise InputError(
            key,
            f"asks for {points:.3g} points, {spacing:.3g} m apart over {length:.3g} m;",
            takes=f"a longer one, which needs at most {MOST_POINTS:.0e}",
        )
