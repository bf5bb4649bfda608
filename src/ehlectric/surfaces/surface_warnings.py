"""Warnings about rough surfaces, which need no film, and their summits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.cases.roughness_inputs import Roughness
from ehlectric.formulas.asperities import LEAST_BANDWIDTH, SpectralMoments, map_moments, profile_moments
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.surfaces.generated_profiles import Domain
from ehlectric.surfaces.maps import Map, statistics
from ehlectric.surfaces.profiles import LEAST_POINTS, Profile
from ehlectric.surfaces.profiles import statistics as profiles_statistics
from ehlectric.surfaces.rough_surfaces import RoughMap, RoughSurface

# Intervals in the table of a surface, in spacings of its points, and fewest intervals in its length.
_STEPS = (1, 2, 4, 8, 16)
_LEAST_INTERVALS = 64


def surface_moments(surface: Profile | Map, interval: float | None = None) -> SpectralMoments:
    """Spectral moments of a profile, or of the isotropic surface that stands for a map. ``interval``,
    sampling interval [m], rounded to a whole number of spacings; by default one spacing. Returns mean squares
    of height, slope and second derivative. Raises ValueError if the surface is shorter than eight intervals.

    Examples
    --------
    >>> from ehlectric.surfaces.generated_profiles import gaussian
    >>> made = gaussian(rq=1e-7, correlation_length=1e-5, length=0.1, seed=1)
    >>> round(surface_moments(made).bandwidth, 1)
    3.0
    """
    if isinstance(surface, Profile):
        return profile_moments(surface.heights, surface.spacing, interval)
    return map_moments(surface.heights, surface.spacing_x, surface.spacing_y, interval).isotropic


def summit_statistics(surface: Profile | Map) -> list[dict[str, Any]]:
    """Spectral moments and summits of a surface at sampling intervals of 1, 2, 4, 8 and 16 spacings.

    Returns for each interval that fits 64 times into the surface, and for the shortest one at least:
    ``interval`` [m], ``m0`` [m^2], ``m2``, ``m4`` [1/m^2], ``bandwidth``, ``summit_density`` [1/m^2],
    ``summit_radius`` [m], ``summit_deviation`` [m], and for a map ``slope_ratio``, the slope along x over
    that along y; bandwidth and ratio are None for a flat surface; the summits are None where the bandwidth is
    below 1.5, as no isotropic Gaussian surface has it.
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
    statistics: dict[str, Any] = {"interval": interval, "m0": moments.m0, "m2": moments.m2, "m4": moments.m4}
    statistics["bandwidth"] = None if flat else moments.bandwidth
    summits = None if flat or moments.bandwidth < LEAST_BANDWIDTH else moments.summits()
    statistics["summit_density"] = summits and summits.density
    statistics["summit_radius"] = summits and summits.radius
    statistics["summit_deviation"] = summits and summits.height_deviation
    if isinstance(surface, Map):
        both = map_moments(surface.heights, surface.spacing_x, surface.spacing_y, interval)
        statistics["slope_ratio"] = both.slope_ratio if both.along_y.m2 > 0.0 else None
    return statistics


# Minimum number of grid spacings in a correlation length, and in a wavelength or the width of a feature.
LEAST_IN_CORRELATION = 2.0
LEAST_IN_SHAPE = 8.0

# Fraction of the variance of the heights that a grid may miss without a warning.
MOST_MISSED = 0.01


def surface_warnings(
    tables: Sequence[Roughness],
    rough: Sequence[RoughSurface | RoughMap],
    domain: Domain,
    *spacings: float,
    finest: Sequence[float] = (),
) -> Iterator[ResultWarning]:
    """Warnings about the roughness of a contact on a grid with spacings along each axis [m].

    They concern files and processing steps, continuation, and roughness that is finer than the grid. If the
    grid is refined, ``finest`` are the spacings of the finest grid that is allowed [m].
    """
    for table, surface in zip(tables, rough, strict=True):
        yield from surface.warnings
        yield from _continued(table, surface, domain)
        even = list(_grid_warnings(table, surface, domain, _Nodes(tuple(finest), "finest"))) if finest else []
        nodes = _Nodes(spacings, "first" if finest else "only")
        yield from even
        for warning in _grid_warnings(table, surface, domain, nodes):
            if warning.code not in {each.code for each in even}:
                yield warning
    yield from same_seeds(tables)


@dataclass(frozen=True)
class _Nodes:
    """Spacings of a grid along each axis [m], and its place in a refinement: "first", "finest" or "only"."""

    spacings: tuple[float, ...]
    place: str


def _grid_warnings(
    table: Roughness, surface: RoughSurface | RoughMap, domain: Domain, nodes: _Nodes
) -> Iterator[ResultWarning]:
    """Warnings about a rough surface that is finer than a grid."""
    last = surface.steps[-1][1] if surface.steps else None
    if last is None:
        yield from _shape_warnings(table, domain, nodes)
    elif isinstance(last, Map):
        yield from _map_warnings(table, last, domain, nodes)
    elif isinstance(surface, RoughMap) and table.direction == "y":
        ends = -domain.side - table.shift_y, domain.side - table.shift_y
        yield from _profile_warnings(surface.surface, last, _Nodes(nodes.spacings[1:], nodes.place), ends)
    else:
        ends = domain.inlet - table.shift, domain.outlet - table.shift
        yield from _profile_warnings(surface.surface, last, _Nodes(nodes.spacings[:1], nodes.place), ends)


def _continued(table: Roughness, surface: RoughSurface | RoughMap, domain: Domain) -> Iterator[ResultWarning]:
    """Warning about a surface that is shorter than the domain."""
    if isinstance(surface, RoughSurface):
        reach = 2.0 * max(abs(domain.inlet - table.shift), abs(domain.outlet - table.shift))
        if surface.extent < reach:
            length, needed = surface.extent * 1e6, reach * 1e6
            yield ResultWarning.of(
                "roughness-continued",
                "profile",
                surface=table.surface,
                length=length,
                needed=needed,
                extend=table.extend,
            )
        return
    lengths = [2.0 * reach for reach in domain.reach(table)]
    short = [k for k in (0, 1) if surface.extent[k] < lengths[k]]
    if short:
        axis = short[0]
        yield ResultWarning.of(
            "roughness-continued",
            "map",
            surface=table.surface,
            length=surface.extent[axis] * 1e6,
            axis="xy"[axis],
            needed=lengths[axis] * 1e6,
            both=" (and is also too short along y)" if len(short) == 2 else "",
            extend=table.extend,
            change=("shift or raise grid.inlet", "shift_y or lower grid.side")[axis],
        )


def _shape_warnings(table: Roughness, domain: Domain, nodes: _Nodes) -> Iterator[ResultWarning]:
    """Warnings about exact shapes inside the domain that are finer than the grid."""
    whose = f"the {'rim of the ' if table.rim else ''}{table.generator} of surface {table.surface}, whose"
    spacings = nodes.spacings
    if table.wavelength is not None:
        turn = np.deg2rad(table.orientation or 0.0)
        axes = zip("xy", spacings, (abs(np.cos(turn)), abs(np.sin(turn))), strict=False)
        name, spacing, waves = max(axes, key=lambda axis: axis[1] * axis[2])
        if spacing * waves > table.wavelength / LEAST_IN_SHAPE:
            along = f" along {name}" if len(spacings) > 1 else ""
            yield _unresolved(nodes, spacing, f"{whose} wavelength{along}", table.wavelength / waves)
        return
    assert table.width is not None
    x, y = (table.position or 0.0) + table.shift, (table.position_y or 0.0) + table.shift_y
    near = 2.0 * table.width
    if not (domain.inlet - near < x < domain.outlet + near and abs(y) < domain.side + near):
        return
    # The rim of a pit is half as wide as the pit.
    finest = 0.5 * table.width if table.rim else table.width
    if max(spacings) > finest / LEAST_IN_SHAPE:
        yield _unresolved(nodes, max(spacings), f"{whose} width", finest)


def _map_warnings(table: Roughness, last: Map, domain: Domain, nodes: _Nodes) -> Iterator[ResultWarning]:
    """Warnings about a map that is finer than the grid along one of the axes of the grid."""
    turn, spacing = table.orientation or 0.0, nodes.spacings
    lengths = _correlation_lengths(last, turn)
    worst = max((0, 1), key=lambda k: spacing[k] / lengths[k])
    if spacing[worst] > lengths[worst] / LEAST_IN_CORRELATION:
        whose = f"the map of surface {table.surface}, whose correlation length along {'xy'[worst]}"
        yield _unresolved(nodes, spacing[worst], whose, lengths[worst])
    within = _inside(table, last, domain)
    missed = map_variance_beyond(within, 0.5 / spacing[0], 0.5 / spacing[1], turn)
    yield from _variance_missed(table.surface, missed, nodes)


def _variance_missed(surface: int, missed: float, nodes: _Nodes) -> Iterator[ResultWarning]:
    """Warning about the part of the variance of a surface that a grid misses."""
    if missed > MOST_MISSED:
        yield ResultWarning.of(
            "variance-missed",
            nodes.place,
            spacings=" x ".join(f"{each * 1e6:.3g}" for each in nodes.spacings),
            percent=100 * missed,
            surface=surface,
            cutoff=4e6 * max(nodes.spacings),
        )


def _correlation_lengths(last: Map, orientation: float) -> list[float]:
    """Correlation lengths along the axes of the grid of a map that is turned [m]."""
    parameters = statistics(last)
    inverse = 1.0 / parameters.correlation_length_x**2, 1.0 / parameters.correlation_length_y**2
    turn = np.deg2rad(orientation)
    squares = np.cos(turn) ** 2, np.sin(turn) ** 2
    return [float((squares[k] * inverse[0] + squares[1 - k] * inverse[1]) ** -0.5) for k in (0, 1)]


def shortest_wave(table: Roughness, rough: RoughSurface | RoughMap) -> float:
    """Length along entrainment that stands for the shortest wave of a rough surface [m].

    It is the wavelength, the width of a pit or an asperity, half of it if the pit has a rim, or four
    correlation lengths. It is infinite for a surface that is uniform along entrainment.

    ``table`` [roughness].
    """
    if table.wavelength is not None:
        along = abs(np.cos(np.deg2rad(table.orientation or 0.0)))
        return table.wavelength / along if along > 1e-6 else np.inf
    if table.width is not None:
        return 0.5 * table.width if table.rim else table.width
    last, in_correlation = rough.steps[-1][1], LEAST_IN_SHAPE / LEAST_IN_CORRELATION
    if isinstance(last, Map):
        assert isinstance(rough, RoughMap)
        return in_correlation * _correlation_lengths(last, rough.orientation)[0]
    if isinstance(rough, RoughMap) and table.direction == "y":
        return np.inf
    return in_correlation * profiles_statistics(last).correlation_length


def _inside(table: Roughness, last: Map, domain: Domain) -> Map:
    """Part of a map inside the domain.

    A map that is rotated, or has fewer than 16 points inside along an axis, is returned whole.
    """
    x, y = last.x + table.shift, last.y + table.shift_y
    rows = np.flatnonzero((x >= domain.inlet) & (x <= domain.outlet))
    columns = np.flatnonzero(np.abs(y) <= domain.side)
    if table.orientation or min(rows.size, columns.size) < LEAST_POINTS:
        return last
    return last.with_heights(last.heights[np.ix_(rows, columns)])


def map_variance_beyond(
    surface: Map, frequency_x: float, frequency_y: float, orientation: float = 0.0
) -> float:
    """Fraction of the variance of a map in waves that are too short for a grid, from the periodogram.
    ``frequency_x`` and ``frequency_y``, largest spatial frequencies along the axes of the grid [1/m];
    ``orientation``, angle from the x axis of the grid to the x axis of the map, counter-clockwise [degrees].

    Examples
    --------
    >>> import numpy as np
    >>> k = np.arange(800)
    >>> waves = 3e-8 * np.sin(k / 20)[:, np.newaxis] + 1e-8 * np.sin(k[:200] / 2)
    >>> [round(map_variance_beyond(Map(1e-7, 1e-7, waves), 1e9, f), 3) for f in (4e5, 1e6)]
    [0.1, 0.0]
    """
    z = surface.heights - np.mean(surface.heights)
    # A Hann window removes the effect of the step between opposite sides.
    power = np.abs(np.fft.rfft2(z * np.outer(*(np.hanning(n) for n in z.shape)))) ** 2
    # rfft2 omits negative frequencies along y: waves with a component along y count twice.
    power[:, 1 : (z.shape[1] + 1) // 2] *= 2.0
    f_x = np.fft.fftfreq(z.shape[0], surface.spacing_x)[:, np.newaxis]
    f_y = np.fft.rfftfreq(z.shape[1], surface.spacing_y)
    turn = np.deg2rad(orientation)
    waves_x = f_x * np.cos(turn) - f_y * np.sin(turn)
    waves_y = f_x * np.sin(turn) + f_y * np.cos(turn)
    beyond = (np.abs(waves_x) > frequency_x) | (np.abs(waves_y) > frequency_y)
    total = float(np.sum(power))
    return float(np.sum(power[beyond])) / total if total > 0.0 else 0.0


def same_seeds(tables: Iterable[Roughness]) -> Iterator[ResultWarning]:
    """Warnings about generated surfaces that share a seed and so are not independent of each other."""
    for seed, times in Counter(table.seed for table in tables if table.seed is not None).items():
        if times > 1:
            yield ResultWarning.of("seed-repeated", times=times, seed=seed)


def _unresolved(nodes: _Nodes, spacing: float, what: str, length: float) -> ResultWarning:
    """Warning that one of the spacings of a grid does not resolve a ``length`` of the roughness [m]."""
    return ResultWarning.of(
        "roughness-unresolved", nodes.place, spacing=spacing * 1e6, what=what, length=length * 1e6
    )


def _profile_warnings(
    surface: int, last: Profile, nodes: _Nodes, ends: tuple[float, float]
) -> Iterator[ResultWarning]:
    """Warnings about a profile that is finer than the grid after its last processing step.

    ``surface`` is the number of the surface, ``nodes`` has the spacing along the profile, and ``ends`` is
    the range of positions that the domain covers [m].
    """
    (spacing,), length = nodes.spacings, profiles_statistics(last).correlation_length
    if spacing > length / LEAST_IN_CORRELATION:
        whose = f"the profile of surface {surface}, whose correlation length"
        yield _unresolved(nodes, spacing, whose, length)
    yield from _variance_missed(surface, profile_variance_beyond(last, 0.5 / spacing, ends), nodes)


def profile_variance_beyond(profile: Profile, frequency: float, ends: tuple[float, float]) -> float:
    """Fraction of the variance of a profile in waves above a spatial frequency, from the periodogram.
    ``frequency`` [1/m]; ``ends``, ends of the part of the profile that counts [m].

    Examples
    --------
    >>> import numpy as np
    >>> k = np.arange(4000)
    >>> two_waves = Profile(1e-7, 3e-8 * np.sin(k / 50) + 1e-8 * np.sin(k / 2))
    >>> round(profile_variance_beyond(two_waves, 1e5, (-1.0, 1.0)), 3)
    0.1
    """
    inside = (profile.x >= ends[0]) & (profile.x <= ends[1])
    z = profile.heights[inside] if np.count_nonzero(inside) >= LEAST_POINTS else profile.heights
    # A Hann window removes the effect of the step between the last and the first point.
    power = np.abs(np.fft.rfft((z - np.mean(z)) * np.hanning(z.size))) ** 2
    total = float(np.sum(power))
    waves = np.fft.rfftfreq(z.size, profile.spacing)
    return float(np.sum(power[waves > frequency])) / total if total > 0.0 else 0.0
