"""Spectral moments and summits of a measured or generated surface, against the sampling interval."""

from __future__ import annotations

from typing import Any

from ehlectric.formulas.asperities.spectrum import (
    LEAST_BANDWIDTH,
    SpectralMoments,
    map_moments,
    profile_moments,
)
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Profile

# Intervals in the table of a surface, in spacings of its points, and fewest intervals in its length.
_STEPS = (1, 2, 4, 8, 16)
_LEAST_INTERVALS = 64


def surface_moments(surface: Profile | Map, interval: float | None = None) -> SpectralMoments:
    """Spectral moments of a profile, or of the isotropic surface that stands for a map.

    Parameters
    ----------
    surface : Profile or Map
        Surface after its processing. A profile is taken as a line over an isotropic surface.
    interval : float, optional
        Sampling interval [m], rounded to a whole number of spacings; by default one spacing.

    Returns
    -------
    SpectralMoments
        Mean squares of height, slope and second derivative.

    Raises
    ------
    ValueError
        If the surface is shorter than eight intervals.

    Examples
    --------
    >>> from ehlectric.surfaces.made_profiles import gaussian
    >>> made = gaussian(rq=1e-7, correlation_length=1e-5, length=0.1, seed=1)
    >>> round(surface_moments(made).bandwidth, 1)
    3.0
    """
    if isinstance(surface, Profile):
        return profile_moments(surface.heights, surface.spacing, interval)
    return map_moments(surface.heights, surface.spacing_x, surface.spacing_y, interval).isotropic


def summit_statistics(surface: Profile | Map) -> list[dict[str, Any]]:
    """Spectral moments and summits of a surface at sampling intervals of 1, 2, 4, 8 and 16 spacings.

    Parameters
    ----------
    surface : Profile or Map
        Surface after its processing.

    Returns
    -------
    list of dict
        For each interval that fits 64 times into the surface, and for the shortest one at least: ``interval``
        [m], ``m0`` [m^2], ``m2``, ``m4`` [1/m^2], ``bandwidth``, ``summit_density`` [1/m^2],
        ``summit_radius`` [m], ``summit_deviation`` [m], and for a map ``slope_ratio``, the slope along x over
        that along y. Bandwidth and ratio are None for a flat surface; the summits are None where the
        bandwidth is below 1.5, as no isotropic Gaussian surface has it.
    """
    if isinstance(surface, Profile):
        spacing, length = surface.spacing, surface.length
    else:
        spacing = max(surface.spacing_x, surface.spacing_y)
        length = min(surface.length_x, surface.length_y)
    steps = [step for step in _STEPS if step == 1 or step * spacing * _LEAST_INTERVALS <= length]
    return [_at_interval(surface, step * spacing) for step in steps]


def _at_interval(surface: Profile | Map, interval: float) -> dict[str, Any]:
    moments = surface_moments(surface, interval)
    flat = moments.m2 == 0.0
    found: dict[str, Any] = {"interval": interval, "m0": moments.m0, "m2": moments.m2, "m4": moments.m4}
    found["bandwidth"] = None if flat else moments.bandwidth
    summits = None if flat or moments.bandwidth < LEAST_BANDWIDTH else moments.summits()
    found["summit_density"] = summits and summits.density
    found["summit_radius"] = summits and summits.radius
    found["summit_deviation"] = summits and summits.height_deviation
    if isinstance(surface, Map):
        both = map_moments(surface.heights, surface.spacing_x, surface.spacing_y, interval)
        found["slope_ratio"] = both.slope_ratio if both.along_y.m2 > 0.0 else None
    return found
