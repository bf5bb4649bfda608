"""Roughness maps: form removal, areal Gaussian filter, cutting, filling of voids, and statistics.

The counterpart of ``ehlectric.surfaces.profiles`` for heights over (x, y), x along entrainment. Heights
are positive out of the body. Points are equally spaced along x and along y, and the middle of a map lies
at (0, 0).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.surfaces.profiles import (
    FORM_DEGREES,
    LEAST_POINTS,
    Form,
    Operations,
    Processing,
    first_below,
    gaussian_weights,
    in_order,
)

# Directions in which the autocorrelation is followed to where it falls fastest: one in two degrees.
_DIRECTIONS = 90


@dataclass(frozen=True)
class Map:
    """Heights [m] over equally spaced points, positive out of the body."""

    spacing_x: float
    spacing_y: float
    heights: Array  # (nx, ny)

    @property
    def x(self) -> Array:
        """Positions along entrainment, the middle at zero [m], shape (nx,)."""
        return np.linspace(-0.5, 0.5, self.heights.shape[0]) * self.length_x

    @property
    def y(self) -> Array:
        """Positions across entrainment, the middle at zero [m], shape (ny,)."""
        return np.linspace(-0.5, 0.5, self.heights.shape[1]) * self.length_y

    @property
    def length_x(self) -> float:
        """Distance of the last point from the first along x [m]."""
        return float((self.heights.shape[0] - 1) * self.spacing_x)

    @property
    def length_y(self) -> float:
        """Distance of the last point from the first along y [m]."""
        return float((self.heights.shape[1] - 1) * self.spacing_y)

    def with_heights(self, heights: Array) -> Self:
        """The map with other heights at its points [m]."""
        return replace(self, heights=heights)


@dataclass(frozen=True)
class MapStatistics:
    """Amplitude, spatial and slope parameters of a map, SI units.

    Attributes
    ----------
    sq, sa : float
        Root mean square and mean absolute height about the mean [m].
    ssk, sku : float
        Skewness and kurtosis, 0 and 3 for Gaussian heights; 0 for a flat map.
    correlation_length_x, correlation_length_y : float
        Distance along x, and along y, at which the autocorrelation falls to 1/e [m]; the length of the map
        where it does not.
    correlation_length : float
        The same in the direction in which it falls fastest [m]. The standard's Sal falls to 0.2.
    rms_slope, largest_slope : float
        Of the gradient, by the differences between neighbours; the standard's Sdq takes more of them.
    """

    sq: float
    sa: float
    ssk: float
    sku: float
    correlation_length_x: float
    correlation_length_y: float
    correlation_length: float
    rms_slope: float
    largest_slope: float


def statistics(surface: Map) -> MapStatistics:
    """Statistics of a map about its mean.

    Parameters
    ----------
    surface : Map
        Two points at least along x and along y.

    Returns
    -------
    MapStatistics
        Sq, Sa, Ssk and Sku as defined in ISO 25178-2, over the whole map.

    Examples
    --------
    The product of two sines has Sq = amplitude/2 and a kurtosis of (3/2)^2:

    >>> import numpy as np
    >>> sine = np.sin(2 * np.pi * np.arange(400) / 100)
    >>> found = statistics(Map(1e-7, 1e-7, 1e-8 * np.outer(sine, sine)))
    >>> round(found.sq / 1e-8, 6), round(found.sku, 6)
    (0.5, 2.25)
    """
    z = surface.heights - np.mean(surface.heights)
    # Of both differences at the same corner of each cell.
    squared = np.diff(z, axis=0)[:, :-1] ** 2 / surface.spacing_x**2
    squared += np.diff(z, axis=1)[:-1] ** 2 / surface.spacing_y**2
    sq = float(np.sqrt(np.mean(z**2)))
    flat = sq == 0.0
    along_x, along_y, fastest = _correlation_lengths(surface.with_heights(z), flat=flat)
    return MapStatistics(
        sq=sq,
        sa=float(np.mean(np.abs(z))),
        ssk=0.0 if flat else float(np.mean(z**3)) / sq**3,
        sku=0.0 if flat else float(np.mean(z**4)) / sq**4,
        correlation_length_x=along_x,
        correlation_length_y=along_y,
        correlation_length=fastest,
        rms_slope=float(np.sqrt(np.mean(squared))),
        largest_slope=float(np.sqrt(np.max(squared))),
    )


def _correlation_lengths(centred: Map, *, flat: bool) -> tuple[float, float, float]:
    """Along x, along y, and in the direction in which the autocorrelation falls fastest [m]."""
    if flat:
        return centred.length_x, centred.length_y, min(centred.length_x, centred.length_y)
    z, dx, dy = centred.heights, centred.spacing_x, centred.spacing_y
    along_x, along_y = first_below(_lags(z), dx), first_below(_lags(z.T), dy)
    # It falls fastest no later than along the quicker axis: no lag beyond that is needed.
    reach = min(along_x, along_y)
    return along_x, along_y, min(reach, _fastest(z, dx, dy, reach))


def _lags(z: Array) -> Array:
    """Autocovariance along the first axis, over the lags 0 to n - 1."""
    from scipy import fft  # not needed by smooth contacts

    n = z.shape[0]
    size = fft.next_fast_len(2 * n - 1, real=True)
    power = np.zeros(size // 2 + 1)
    # In strips, as a map of many points would need its own size some times over.
    for start in range(0, z.shape[1], 256):
        power += np.sum(np.abs(fft.rfft(z[:, start : start + 256], size, axis=0)) ** 2, axis=1)
    covariance: Array = fft.irfft(power, size)[:n] / np.arange(n, 0, -1)
    return covariance


def _fastest(z: Array, dx: float, dy: float, reach: float) -> float:
    """Shortest distance at which the autocovariance falls to 1/e, over all directions, up to a reach."""
    from scipy import fft, ndimage

    # One lag beyond the reach on each side, so that the spline has neighbours there.
    lags = [min(int(np.ceil(reach / d)) + 1, n - 1) for d, n in zip((dx, dy), z.shape, strict=True)]
    size = [fft.next_fast_len(n + lag, real=True) for n, lag in zip(z.shape, lags, strict=True)]
    covariance = fft.irfft2(np.abs(fft.rfft2(z, size)) ** 2, size)
    i, j = (np.arange(-lag, lag + 1) for lag in lags)
    counts = np.outer(z.shape[0] - np.abs(i), z.shape[1] - np.abs(j))
    window = covariance[np.ix_(i, j)] / counts
    step = 0.5 * min(dx, dy)
    distance = np.arange(0.0, reach + step, step)
    angle = np.pi * np.arange(_DIRECTIONS)[:, np.newaxis] / _DIRECTIONS
    at = [lags[0] + distance * np.cos(angle) / dx, lags[1] + distance * np.sin(angle) / dy]
    rays = ndimage.map_coordinates(window, at, order=3, mode="nearest")
    return min(first_below(ray, step) for ray in rays)


def without_form(surface: Map, form: Form) -> Map:
    """The map less its form, by least squares.

    Parameters
    ----------
    surface : Map
        As measured.
    form : str
        "none", "mean", "line" (a plane) or "parabola" (a quadric, with the product of x and y).

    Returns
    -------
    Map
        Of the same size.

    Notes
    -----
    Products of polynomials that are orthogonal over the points of each axis are so over those of the map:
    no system of equations over all points is needed.

    Examples
    --------
    >>> import numpy as np
    >>> k = np.arange(20.0)
    >>> saddle = Map(1.0, 1.0, np.outer(k, k) + k**2)
    >>> bool(np.allclose(without_form(saddle, "parabola").heights, 0.0, atol=1e-9))
    True
    """
    if form == "none":
        return surface
    degree = FORM_DEGREES[form]
    p, q = (_orthogonal(n, degree) for n in surface.heights.shape)
    part = p.T @ surface.heights @ q
    total = np.add.outer(np.arange(p.shape[1]), np.arange(q.shape[1]))
    return surface.with_heights(surface.heights - p @ np.where(total <= degree, part, 0.0) @ q.T)


def _orthogonal(n: int, degree: int) -> Array:
    """Orthonormal polynomials over n equally spaced points, shape (n, degree + 1)."""
    powers = np.vander(np.linspace(-1.0, 1.0, n), min(degree, n - 1) + 1, increasing=True)
    basis: Array = np.linalg.qr(powers)[0]
    return basis


def waviness(surface: Map, cutoff: float) -> Map:
    """Areal Gaussian filter: the waves longer than a cutoff, whatever their direction.

    The weight is exp(-pi (r/(alpha cutoff))^2)/(alpha cutoff)^2 with alpha = sqrt(ln 2/pi), that of the
    profile filter along x times that along y.

    Parameters
    ----------
    surface : Map
        What to filter; near its ends the weights are those of the part that is there.
    cutoff : float
        Cutoff wavelength [m], at most the length of the shorter side.

    Returns
    -------
    Map
        Of the same size.

    Raises
    ------
    InputError
        Where the cutoff is longer than a side, or shorter than four spacings.

    Notes
    -----
    ISO 16610-61.

    Examples
    --------
    >>> import numpy as np
    >>> wave = np.sin(2 * np.pi * np.arange(400) * 0.1 / 8.0)
    >>> surface = Map(0.1, 0.1, np.tile(wave, (200, 1)))
    >>> round(float(np.max(waviness(surface, 8.0).heights[100, 100:300])), 3)
    0.5
    """
    coarser, shorter = max(surface.spacing_x, surface.spacing_y), min(surface.length_x, surface.length_y)
    gaussian_weights(coarser, cutoff, shorter)  # refuses what fits one axis only, before anything is done
    heights = surface.heights
    for axis, spacing in enumerate((surface.spacing_x, surface.spacing_y)):
        heights = _smoothed(heights, gaussian_weights(spacing, cutoff, shorter), axis)
    return surface.with_heights(heights)


def _smoothed(heights: Array, weights: Array, axis: int) -> Array:
    from scipy.signal import oaconvolve  # half a second to import, and smooth contacts need none

    reach, n = weights.size // 2, heights.shape[axis]
    kept = slice(reach, reach + n)
    column = weights[:, np.newaxis] if axis == 0 else weights[np.newaxis]
    total = oaconvolve(heights, column, axes=axis)
    share = oaconvolve(np.ones(n), weights)[kept]
    smooth: Array = total[kept] / share[:, np.newaxis] if axis == 0 else total[:, kept] / share
    return smooth


def trimmed(surface: Map, length: float) -> Map:
    """The map less a length at each of its four sides [m].

    Raises
    ------
    InputError
        Where too little would be left.
    """
    cut = [round(length / spacing) for spacing in (surface.spacing_x, surface.spacing_y)]
    left = [n - 2 * k for n, k in zip(surface.heights.shape, cut, strict=True)]
    if min(left) < LEAST_POINTS:
        rows, columns = (max(n, 0) for n in left)
        raise InputError(
            "trim",
            got=f"{length * 1e6:.4g} µm, which leaves {rows} x {columns} points of "
            f"{surface.heights.shape[0]} x {surface.heights.shape[1]};",
            takes=f"a length that leaves {LEAST_POINTS} each way",
        )
    kept = tuple(slice(k, k + n) for k, n in zip(cut, left, strict=True))
    return surface.with_heights(surface.heights[kept])


def processed_map(surface: Map, steps: Processing) -> list[tuple[str, Map]]:
    """A map after every step, with what the step was; the first is the map as it came.

    Parameters
    ----------
    surface : Map
        As read or generated.
    steps : Processing
        What to do, as for a profile; ``rescale_rq`` is then an Sq.

    Returns
    -------
    list of (str, Map)
        Descriptions and maps, in order.

    Raises
    ------
    InputError
        Where a step cannot be done.

    Examples
    --------
    >>> import numpy as np
    >>> surface = Map(1e-7, 1e-7, np.outer(np.arange(40.0), np.ones(30)) * 1e-8)
    >>> [name for name, _ in processed_map(surface, Processing(form="line", truncate=1e-8))]
    ['as read', 'form: line', 'truncate: 10 nm']
    """
    return in_order(surface, steps, Operations(without_form, waviness, trimmed))
