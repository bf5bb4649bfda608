"""Spectral moments of rough surfaces, and the summits that follow from them.

The moments m0, m2 and m4 are the mean squares of height, slope and curvature along a line over the surface.
For an isotropic Gaussian surface they give density, radius and heights of its summits.

No surface has these numbers of its own. Slope and curvature grow as finer waves are measured, without a limit
for most machined surfaces: m4, the density and the radius of the summits belong to the sampling interval.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from ehlectric.arrays import Array
from ehlectric.formulas.asperities.statistical import Summits

# The variance of the summit heights is (1 - 0.8968/alpha) m0, with the printed constant.
_SUMMIT_VARIANCE = 0.8968

# Least bandwidth of an isotropic Gaussian surface.
LEAST_BANDWIDTH = 1.5

# Fewest intervals in the length of a profile: over fewer the mean squares mean nothing.
_LEAST_INTERVALS = 8


@dataclass(frozen=True)
class SpectralMoments:
    """Spectral moments of a line over a rough surface; those of two surfaces add up.

    Attributes
    ----------
    m0 : float
        Mean square height about the mean, Rq^2 [m^2].
    m2 : float
        Mean square slope.
    m4 : float
        Mean square of the second derivative [1/m^2].

    Examples
    --------
    >>> both = SpectralMoments(1e-16, 1e-4, 1e9) + SpectralMoments(4e-16, 0.0, 0.0)
    >>> round(both.rq * 1e9, 2), round(both.bandwidth, 1)
    (22.36, 50.0)
    """

    m0: float
    m2: float
    m4: float

    def __add__(self, other: Self) -> Self:
        """Moments of the gap between two surfaces whose heights are independent."""
        return type(self)(self.m0 + other.m0, self.m2 + other.m2, self.m4 + other.m4)

    @property
    def rq(self) -> float:
        """Root mean square height [m]."""
        return float(np.sqrt(self.m0))

    @property
    def bandwidth(self) -> float:
        """Nayak's bandwidth alpha = m0 m4/m2^2, at least 1.5 for an isotropic Gaussian surface; nan if flat.

        Few waves of one length have a small bandwidth, a spectrum over decades of wavelengths a large one.
        """
        return float(self.m0 * self.m4 / self.m2**2) if self.m2 > 0.0 else float("nan")

    def summits(self) -> Summits:
        """Summits of an isotropic Gaussian surface with these moments.

        Returns
        -------
        Summits
            Density m4/(6 sqrt(3) pi m2), radius (3/8) sqrt(pi/m4), and standard deviation of the heights
            sqrt((1 - 0.8968/alpha) m0).

        Raises
        ------
        ValueError
            If the surface is flat, or its bandwidth below 1.5: no isotropic Gaussian surface has these
            moments.

        Notes
        -----
        P. R. Nayak, Random process model of rough surfaces, J. Lubr. Technol. 93 (1971) 398-407. J. I.
        McCool, Comparison of models for the contact of rough surfaces, Wear 107 (1986) 37-60. The radius is
        that of the mean curvature of all summits. Higher summits are sharper.

        Examples
        --------
        >>> summits = SpectralMoments(1e-14, 1e-3, 1e9).summits()
        >>> round(summits.density / 1e9, 1), round(summits.radius * 1e6, 1)
        (30.6, 21.0)
        """
        if not self.bandwidth >= LEAST_BANDWIDTH:
            raise ValueError(
                f"an isotropic Gaussian surface has a bandwidth of at least {LEAST_BANDWIDTH:g}, "
                f"got {self.bandwidth:.3g}"
            )
        return Summits(
            density=self.m4 / (6.0 * float(np.sqrt(3.0)) * np.pi * self.m2),
            radius=0.375 * float(np.sqrt(np.pi / self.m4)),
            height_deviation=float(np.sqrt((1.0 - _SUMMIT_VARIANCE / self.bandwidth) * self.m0)),
        )


def profile_moments(heights: Array, spacing: float, interval: float | None = None) -> SpectralMoments:
    """Spectral moments of a profile at a sampling interval, from differences.

    Slope and second derivative are (z(x + d) - z(x))/d and (z(x + d) - 2 z(x) + z(x - d))/d^2 with the
    interval d. Differences are the standard of the contact models, and they need no periodic profile: in a
    power spectrum the step between both ends would dominate m4. A wave of the length L has the
    slope of the wave times sin(pi d/L)/(pi d/L), so that waves shorter than about four intervals are damped.

    Parameters
    ----------
    heights : ndarray, shape (n,)
        Heights at equally spaced points [m].
    spacing : float
        Distance of the points [m].
    interval : float, optional
        Sampling interval d [m], rounded to a whole number of spacings and at least one; by default one.

    Returns
    -------
    SpectralMoments
        m0 [m^2], m2, and m4 [1/m^2].

    Raises
    ------
    ValueError
        If the profile is shorter than eight intervals.

    Notes
    -----
    Rounding of the heights to steps s adds s^2/(6 d^2) to m2 and s^2/(2 d^4) to m4, if the errors of the
    points are independent. Noise of the instrument acts in the same way. Take an interval at which that is
    small.

    Examples
    --------
    >>> wave = 1e-7 * np.sin(2 * np.pi * np.arange(1000) / 100)
    >>> moments = profile_moments(wave, 1e-7)
    >>> round(moments.rq * 1e9, 2), round(moments.bandwidth, 2)
    (70.71, 1.0)
    """
    return _line_moments(heights[np.newaxis], spacing, interval)


@dataclass(frozen=True)
class MapMoments:
    """Spectral moments of a map along x and along y.

    Attributes
    ----------
    along_x, along_y : SpectralMoments
        Moments of the lines along x and along y.
    """

    along_x: SpectralMoments
    along_y: SpectralMoments

    @property
    def isotropic(self) -> SpectralMoments:
        """Moments of the isotropic surface that stands for the map: geometric means of both directions.

        For an isotropic map this is the mean of both. For a surface with a lay it is an approximation after
        Sayles and Thomas (from memory), which keeps the product of both slopes.
        """
        x, y = self.along_x, self.along_y
        return SpectralMoments(x.m0, float(np.sqrt(x.m2 * y.m2)), float(np.sqrt(x.m4 * y.m4)))

    @property
    def slope_ratio(self) -> float:
        """Root mean square slope along x over that along y; nan for no slope. One if isotropic."""
        return float(np.sqrt(self.along_x.m2 / self.along_y.m2)) if self.along_y.m2 > 0.0 else float("nan")


def map_moments(
    heights: Array, spacing_x: float, spacing_y: float, interval: float | None = None
) -> MapMoments:
    """Spectral moments of a map along x and along y, from differences as in ``profile_moments``.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        Heights [m].
    spacing_x, spacing_y : float
        Distances of the points along x and y [m].
    interval : float, optional
        Sampling interval [m], rounded along each axis to a whole number of spacings and at least one; by
        default one spacing of each axis.

    Returns
    -------
    MapMoments
        Moments along both axes.

    Raises
    ------
    ValueError
        If a side of the map is shorter than eight intervals.

    Examples
    --------
    >>> wave = np.sin(2 * np.pi * np.arange(400) / 100)
    >>> found = map_moments(1e-7 * np.add.outer(wave, wave), 1e-7, 2e-7)
    >>> round(found.slope_ratio, 3), round(found.isotropic.rq * 1e9, 3)
    (2.0, 100.0)
    """
    return MapMoments(
        _line_moments(heights.T, spacing_x, interval), _line_moments(heights, spacing_y, interval)
    )


def _line_moments(lines: Array, spacing: float, interval: float | None) -> SpectralMoments:
    """Moments of lines along the last axis, shape (lines, n), with the mean of all heights as zero."""
    step = 1 if interval is None else max(1, round(interval / spacing))
    if lines.shape[-1] <= _LEAST_INTERVALS * step:
        raise ValueError(
            f"{lines.shape[-1]} points are fewer than {_LEAST_INTERVALS} sampling intervals of {step} points"
        )
    distance = step * spacing
    slopes = (lines[:, step:] - lines[:, :-step]) / distance
    curvatures = (slopes[:, step:] - slopes[:, :-step]) / distance
    m0, m2, m4 = float(np.var(lines)), float(np.mean(slopes**2)), float(np.mean(curvatures**2))
    return SpectralMoments(m0, m2, m4)
