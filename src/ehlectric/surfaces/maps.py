"""Roughness maps of point contacts: voids, form removal, areal Gaussian filter, trimming and statistics.

A map has heights over (x, y), with x along entrainment. Heights are positive out of the body. The points are
equally spaced along x and along y, and the middle of a map lies at (0, 0). Profiles are treated in
``ehlectric.surfaces.profiles``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
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

# Residual at which the solution for the filling stops, relative to the residual of the initial guess.
_TOLERANCE = 1e-8
_MOST_STEPS = 5000


def without_void_borders(heights: Array) -> Array:
    """Heights (nx, ny), NaN at voids, without the outer rows and columns that have no data at all.

    Empty if no point has data.

    Examples
    --------
    >>> import numpy as np
    >>> heights = np.full((5, 6), np.nan)
    >>> heights[1:3, 2:6] = 0.0
    >>> without_void_borders(heights).shape
    (2, 4)
    """
    there = np.isfinite(heights)
    if not there.any():
        return heights[:0, :0]
    rows, columns = (np.flatnonzero(there.any(axis=other)) for other in (1, 0))
    return heights[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def filled(heights: Array, spacing_x: float, spacing_y: float) -> Array:
    """Map with its voids filled by a harmonic function, the shape of a soap film.

    Inside a void the discrete Laplacian of the heights is zero, and the filling joins the measured heights at
    the rim of the void. It stays between the lowest and the highest height at the rim. At a side of the map
    its slope is zero.

    Heights and spacings along x and y are in metres. Its shape is the shape (nx, ny) of the heights, and it
    contains no NaN.

    Examples
    --------
    The Laplacian of a plane is zero, so that a hole in a plane is filled exactly:

    >>> import numpy as np
    >>> plane = np.add.outer(np.arange(8.0), 2.0 * np.arange(9.0))
    >>> holed = plane.copy()
    >>> holed[2:5, 3:7] = np.nan
    >>> bool(np.allclose(filled(holed, 1.0, 1.0), plane))
    True
    """
    void = np.isnan(heights)
    if not void.any():
        return heights
    # The initial guess is the height of the nearest point with data: the zero of an instrument may be far
    # away.
    nearest = scipy.ndimage.distance_transform_edt(
        void, sampling=(spacing_x, spacing_y), return_distances=False, return_indices=True
    )
    whole: Array = heights[tuple(nearest)]
    laplacian, force = _laplacian(whole, void, spacing_x, spacing_y)
    change, _ = scipy.sparse.linalg.cg(laplacian, force, rtol=_TOLERANCE, maxiter=_MOST_STEPS)
    whole[void] += change
    return whole


def _laplacian(whole: Array, void: Mask, dx: float, dy: float) -> tuple[scipy.sparse.csr_array, Array]:
    """Negative Laplacian over the n void points as a matrix, and Laplacian of the initial guess there (n,).

    ``whole`` (nx, ny) has the initial guess at the ``void`` points and the measured heights elsewhere.
    """
    n = int(void.sum())
    number = np.full(void.shape, -1)
    number[void] = np.arange(n)
    diagonal, force = np.zeros(n), np.zeros(n)
    pairs: list[tuple[Array, IntArray, IntArray]] = []
    for axis, spacing in enumerate((dx, dy)):
        weight = (min(dx, dy) / spacing) ** 2
        halves = [(slice(None, -1), slice(1, None)) if k == axis else (slice(None),) * 2 for k in (0, 1)]
        ends = [(halves[0][k], halves[1][k]) for k in (0, 1)]
        for here, there in ((0, 1), (1, 0)):
            node, neighbour = number[ends[here]], number[ends[there]]
            rise = (whole[ends[there]] - whole[ends[here]])[node >= 0]
            node, neighbour = node[node >= 0], neighbour[node >= 0]
            diagonal[node] += weight
            force[node] += weight * rise
            both = neighbour >= 0
            pairs.append((np.full(int(both.sum()), -weight), node[both], neighbour[both]))
    pairs.append((diagonal, np.arange(n), np.arange(n)))
    values, rows, columns = (np.concatenate(part) for part in zip(*pairs, strict=True))
    return scipy.sparse.csr_array((values, (rows, columns)), shape=(n, n)), force


# Directions in which the decay of the autocorrelation is examined: one every two degrees.
_DIRECTIONS = 90


@dataclass(frozen=True)
class Map:
    """Roughness map: heights over equally spaced points."""

    # spacing_x and spacing_y: distances between neighbouring points along and across entrainment [m].
    spacing_x: float
    spacing_y: float
    heights: Array  # heights [m], positive out of the body, shape (nx, ny)

    @property
    def x(self) -> Array:
        """Positions along entrainment [m], zero in the middle, shape (nx,)."""
        return np.linspace(-0.5, 0.5, self.heights.shape[0]) * self.length_x

    @property
    def y(self) -> Array:
        """Positions across entrainment [m], zero in the middle, shape (ny,)."""
        return np.linspace(-0.5, 0.5, self.heights.shape[1]) * self.length_y

    @property
    def length_x(self) -> float:
        """Distance between the first and the last point along x [m]."""
        return float((self.heights.shape[0] - 1) * self.spacing_x)

    @property
    def length_y(self) -> float:
        """Distance between the first and the last point along y [m]."""
        return float((self.heights.shape[1] - 1) * self.spacing_y)

    def with_heights(self, heights: Array) -> Self:
        """Map with the same points and other heights [m]."""
        return replace(self, heights=heights)


@dataclass(frozen=True)
class MapStatistics:
    """Amplitude, spatial and slope parameters of a map, SI units."""

    # sq and sa: root mean square and mean absolute height about the mean [m].
    sq: float
    sa: float
    ssk: float
    sku: float
    # correlation_length_x and correlation_length_y: distances along x and along y at which the
    # autocorrelation falls to 1/e [m]; the length of the map if it does not fall so far.
    correlation_length_x: float
    correlation_length_y: float
    # Distance at which the autocorrelation falls to 1/e in the direction in which it falls fastest [m].
    correlation_length: float
    # rms_slope and largest_slope: root mean square and largest magnitude of the gradient, from differences
    # between neighbours. The gradient Sdq of ISO 25178-2 takes more points.
    rms_slope: float
    largest_slope: float


def statistics(surface: Map) -> MapStatistics:
    """Amplitude, spatial and slope parameters of a map, with heights about its mean. ``surface``, map with at
    least two points along x and along y. Returns sq, Sa, Ssk and Sku as defined in ISO 25178-2 over the whole
    map, correlation lengths and slopes.

    Examples
    --------
    The product of two sines has Sq = amplitude/2 and a kurtosis of (3/2)^2:

    >>> import numpy as np
    >>> sine = np.sin(2 * np.pi * np.arange(400) / 100)
    >>> result = statistics(Map(1e-7, 1e-7, 1e-8 * np.outer(sine, sine)))
    >>> round(result.sq / 1e-8, 6), round(result.sku, 6)
    (0.5, 2.25)
    """
    z = surface.heights - np.mean(surface.heights)
    # Both differences are taken at the same corner of each cell.
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
    """Correlation lengths along x, along y, and in the direction in which they are shortest [m]."""
    if flat:
        return centred.length_x, centred.length_y, min(centred.length_x, centred.length_y)
    z, dx, dy = centred.heights, centred.spacing_x, centred.spacing_y
    along_x, along_y = first_below(_lags(z), dx), first_below(_lags(z.T), dy)
    # The shortest correlation length is at most the shorter of these two: no lags beyond it are needed.
    reach = min(along_x, along_y)
    return along_x, along_y, min(reach, _fastest(z, dx, dy, reach))


def _lags(z: Array) -> Array:
    """Autocovariance along the first axis for the lags 0 to n - 1, shape (n,)."""
    n = z.shape[0]
    size = scipy.fft.next_fast_len(2 * n - 1, real=True)
    power = np.zeros(size // 2 + 1)
    # The map is transformed in strips: at once, a large map would need several times its memory.
    for start in range(0, z.shape[1], 256):
        power += np.sum(np.abs(scipy.fft.rfft(z[:, start : start + 256], size, axis=0)) ** 2, axis=1)
    covariance: Array = scipy.fft.irfft(power, size)[:n] / np.arange(n, 0, -1)
    return covariance


def _fastest(z: Array, dx: float, dy: float, reach: float) -> float:
    """Shortest distance in any direction at which the autocovariance falls to 1/e, up to ``reach`` [m]."""
    # One lag beyond the reach on each side, so that the spline has neighbours there.
    lags = [min(int(np.ceil(reach / d)) + 1, n - 1) for d, n in zip((dx, dy), z.shape, strict=True)]
    size = [scipy.fft.next_fast_len(n + lag, real=True) for n, lag in zip(z.shape, lags, strict=True)]
    covariance = scipy.fft.irfft2(np.abs(scipy.fft.rfft2(z, size)) ** 2, size)
    i, j = (np.arange(-lag, lag + 1) for lag in lags)
    counts = np.outer(z.shape[0] - np.abs(i), z.shape[1] - np.abs(j))
    window = covariance[np.ix_(i, j)] / counts
    step = 0.5 * min(dx, dy)
    distance = np.arange(0.0, reach + step, step)
    angle = np.pi * np.arange(_DIRECTIONS)[:, np.newaxis] / _DIRECTIONS
    at = [lags[0] + distance * np.cos(angle) / dx, lags[1] + distance * np.sin(angle) / dy]
    rays = scipy.ndimage.map_coordinates(window, at, order=3, mode="nearest")
    return min(first_below(ray, step) for ray in rays)


def without_form(surface: Map, form: Form) -> Map:
    """Map of the same size without its form, which is fitted by least squares and subtracted.

    Products of polynomials that are orthogonal over the points of each axis are orthogonal over the points of
    the map. The fit therefore needs no system of equations over all points.

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
    """Waviness of a map: areal Gaussian filter that passes wavelengths above a cutoff in all directions.

    The weight is exp(-pi (r/(alpha cutoff))^2)/(alpha cutoff)^2 with alpha = sqrt(ln 2/pi). It is the product
    of the weights of the profile filter along x and along y.

    The cutoff wavelength [m] lies between four spacings and the length of the shorter side. The waviness has
    the size of the map. Raises an InputError for any other cutoff.

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
    gaussian_weights(coarser, cutoff, shorter)  # raises before the filter if the cutoff fits only one axis
    heights = surface.heights
    for axis, spacing in enumerate((surface.spacing_x, surface.spacing_y)):
        heights = _smoothed(heights, gaussian_weights(spacing, cutoff, shorter), axis)
    return surface.with_heights(heights)


def _smoothed(heights: Array, weights: Array, axis: int) -> Array:
    reach, n = weights.size // 2, heights.shape[axis]
    kept = slice(reach, reach + n)
    column = weights[:, np.newaxis] if axis == 0 else weights[np.newaxis]
    total = scipy.signal.oaconvolve(heights, column, axes=axis)
    share = scipy.signal.oaconvolve(np.ones(n), weights)[kept]
    smooth: Array = total[kept] / share[:, np.newaxis] if axis == 0 else total[:, kept] / share
    return smooth


def trimmed(surface: Map, length: float) -> Map:
    """Map without a margin of ``length`` [m] at each of its four sides.

    Raises an InputError if fewer than 16 points are left along x or y.
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
    """Process a map, and return it after every step with a description of the step. Returns description and
    map after each step, in order; the first entry is the unprocessed map. Raises InputError if a step is not
    possible with this map.

    Examples
    --------
    >>> import numpy as np
    >>> surface = Map(1e-7, 1e-7, np.outer(np.arange(40.0), np.ones(30)) * 1e-8)
    >>> [name for name, _ in processed_map(surface, Processing(form="line", truncate=1e-8))]
    ['as read', 'form: line', 'truncate: 10 nm']
    """
    return in_order(surface, steps, Operations(without_form, waviness, trimmed))
