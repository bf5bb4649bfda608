"""Roughness of a contact: the height of each rough surface as a function of position.

The midpoint of a profile or map lies at the centre of the contact, and x runs along entrainment. A surface
that is shorter than the domain is continued by the key ``extend`` of the case. In a point contact a measured
map is used whole. A measured profile, or one line of a map, is extended along the lay, across its own
direction. Lengths are in metres.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from itertools import chain
from typing import Any, Literal, TypeAlias

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.cases.roughness_inputs import GENERATORS, SHAPES, Roughness
from ehlectric.errors import InputError, within
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.surfaces import generated_maps as map_generators
from ehlectric.surfaces import generated_profiles as generators
from ehlectric.surfaces.generated_profiles import Domain, turned
from ehlectric.surfaces.maps import Map, processed_map
from ehlectric.surfaces.maps import statistics as map_statistics
from ehlectric.surfaces.profiles import TAPER, Points, Processing, Profile, processed, rms, statistics
from ehlectric.surfaces.surface_files import Surface, read_surface, surface_of

# Height of a map [m] as a function of positions x and y [m] whose shapes broadcast, and height of a profile
# [m] as a function of position x [m].
MapHeight: TypeAlias = Callable[[Array, Array], Array]
Height = Callable[[Array], Array]


def continued_map(surface: Map, extend: str) -> MapHeight:
    """Height [m] of a map at any position x and y [m]: a bicubic spline inside, and its continuation outside.

    Examples
    --------
    >>> import numpy as np
    >>> ramp = Map(1.0, 1.0, np.add.outer(np.linspace(-1.0, 1.0, 21), np.zeros(21)))
    >>> np.round(continued_map(ramp, "mirror")(np.array([10.0, 15.0, 30.0]), np.zeros(3)), 2)
    array([ 1. ,  0.5, -1. ])
    """
    z = surface.heights
    mode: Literal["mirror", "grid-wrap"] = "mirror"
    fades = [_fade(n) for n in z.shape]
    if extend == "flat":
        z = z * np.outer(*fades)
    elif extend == "repeat":
        z, mode = _joined(_joined(z, fades[0]).T, fades[1]).T[:-1, :-1], "grid-wrap"
    coefficients = scipy.ndimage.spline_filter(z, order=3, mode=mode)
    middle = [0.5 * (n - 1) for n in surface.heights.shape]

    def height(x: Array, y: Array) -> Array:
        places = x / surface.spacing_x + middle[0], y / surface.spacing_y + middle[1]
        at = np.array(np.broadcast_arrays(*places))
        heights: Array = scipy.ndimage.map_coordinates(coefficients, at, order=3, mode=mode, prefilter=False)
        if extend == "flat":
            heights[(np.abs(x) > 0.5 * surface.length_x) | (np.abs(y) > 0.5 * surface.length_y)] = 0.0
        return heights

    return height


def _fade(n: int) -> Array:
    """Factors over n points, shape (n,): zero at both ends, one inside, with a smooth taper between."""
    ends = np.clip((0.5 - np.abs(np.linspace(-0.5, 0.5, n))) / TAPER, 0.0, 1.0)
    fade: Array = 0.5 - 0.5 * np.cos(np.pi * ends)
    return fade


def _joined(z: Array, fade: Array) -> Array:
    """Heights (n, m) blended near the first and the last row into the mean of both, without step or kink."""
    joint = 0.5 * (z[0] + z[-1])
    joined: Array = joint + (z - joint) * fade[:, np.newaxis]
    return joined


def continued(profile: Profile, extend: str) -> Height:
    """Height [m] of a profile at any position [m]: a cubic spline inside, and its continuation outside.

    Examples
    --------
    >>> import numpy as np
    >>> ramp = Profile(1.0, np.linspace(-1.0, 1.0, 21))
    >>> np.round(continued(ramp, "mirror")(np.array([5.0, 12.0, 30.0])), 12)
    array([ 0.5,  0.8, -1. ])
    """
    x, z = profile.x, profile.heights
    half, length = 0.5 * profile.length, profile.length
    if extend == "mirror":
        spline = scipy.interpolate.CubicSpline(x, z)
        return lambda at: spline(np.abs((at + half + length) % (2.0 * length) - length) - half)
    ends = np.clip((half - np.abs(x)) / (TAPER * length), 0.0, 1.0)
    fade = 0.5 - 0.5 * np.cos(np.pi * ends)
    if extend == "flat":
        spline = scipy.interpolate.CubicSpline(x, z * fade)
        return lambda at: np.where(np.abs(at) < half, spline(np.clip(at, -half, half)), 0.0)
    # Both ends are blended into the mean of the two, so that the joint has neither step nor kink.
    joint = 0.5 * (z[0] + z[-1])
    spline = scipy.interpolate.CubicSpline(x, joint + (z - joint) * fade)
    return lambda at: spline((at + half) % length - half)


# Largest correlation length or roll-off wavelength, as a fraction of the domain. With fewer than ten of them
# in the domain, the statistics of the heights there are random.
MOST_OF_DOMAIN = 0.1

# Largest credible root-mean-square height of a measured surface after all steps [m].
_ROUGHEST = 1e-3

# Fraction of the points that ``truncate`` may cut off without a warning.
_MOST_CUT = 0.05


def processing_of(table: Roughness) -> Processing:
    """Processing steps of a table ``[[roughness]]``.

    For a file without form removal the mean is removed.
    """
    steps = Processing(**{step.name: getattr(table, step.name) for step in fields(Processing)})
    return replace(steps, form="mean") if table.is_measured and steps.form == "none" else steps


def step_warnings(
    table: Roughness, steps: Sequence[tuple[str, Points]], voids: float | None
) -> Iterator[ResultWarning]:
    """Warnings about voids that were filled and peaks that were cut off in a profile or a map.

    ``steps`` has the surface after every processing step, ``voids`` the fraction of points without data.
    """
    if voids:
        whose, how = "line", "linear"
        if isinstance(steps[0][1], Map):
            whose, how = "map", "harmonic"
        yield ResultWarning.of(
            "voids-filled", percent=100 * voids, part=whose, surface=table.surface, method=how
        )
    rq = rms(steps[-1][1].heights)
    if table.is_measured and rq > _ROUGHEST:
        yield ResultWarning.of("heights-large", surface=table.surface, rq=rq * 1e3)
    if table.truncate is not None:
        share = float(np.mean(np.abs(steps[-2][1].heights) > table.truncate))
        if share > _MOST_CUT:
            yield ResultWarning.of(
                "heights-cut", percent=100 * share, surface=table.surface, rq=rms(steps[-2][1].heights) * 1e9
            )


# Points of a generated profile beyond each end of the domain. The end conditions of a spline have no effect
# farther inside.
_MARGIN = 64


@dataclass(frozen=True, kw_only=True)
class _Rough:
    """Rough surface of a line or a point contact: its source and processing steps."""

    surface: int  # number of the surface, 1 (lower) or 2 (upper)
    surface_read: Surface | None = None  # content of the file; None for a generated surface
    # Description of each processing step and the surface after it: a map, or the profile that is extended.
    # Empty for an exact shape.
    steps: Sequence[tuple[str, Map | Profile]] = ()
    # Fraction of the points used that have no data in the file; None for a generated surface.
    voids: float | None = None
    warnings: tuple[ResultWarning, ...] = ()  # warnings about the file and the processing steps

    def describe(self) -> dict[str, Any]:
        """Source, processing steps and statistics of the surface in SI units, for the files of a result."""
        read = self.surface_read
        return {
            "surface": self.surface,
            "source": None if read is None else read.source,
            "size": None if read is None else list(read.heights.shape),
            "voids": self.voids,
            "height_step": None if read is None else read.height_step,
            "steps": [{"step": name} | _described_step(step) for name, step in self.steps],
        }


@dataclass(frozen=True, kw_only=True)
class RoughSurface(_Rough):
    """Rough surface of a line contact."""

    height: Height  # height [m] as a function of position [m], positive out of the body
    steps: Sequence[tuple[str, Profile]] = ()
    extent: float = np.inf  # length of the profile before its continuation [m]; infinite for an exact shape


def rough_surfaces(tables: Sequence[Roughness], domain: Domain) -> list[RoughSurface]:
    """Rough surfaces of a line contact, read or generated, one for each table.

    Raises an InputError if a file cannot be used, or a shape does not fit the domain.
    """
    return [_rough_surface(table, domain) for table in tables]


def _rough_surface(table: Roughness, domain: Domain) -> RoughSurface:
    if table.generator in SHAPES:
        shape = _exact_shape(table, generators.SHAPES, ("the domain", domain.length))
        return RoughSurface(surface=table.surface, height=_shifted(shape, table.shift))
    if table.is_measured:
        return measured(table)
    reach = max(abs(end - table.shift) for end in (domain.inlet, domain.outlet))
    return _of_profile(table, _random(table, domain.length, reach), None)


def measured(table: Roughness, surface: Surface | None = None) -> RoughSurface:
    """Rough surface from one line of a measured file, processed without reference to a contact.

    The file is read unless ``surface`` has its content. The mean height is always removed, as the zero of an
    instrument is arbitrary.

    Raises InputError if the file cannot be used.
    """
    if surface is None:
        surface = read_of(table)
    return _of_profile(table, surface.line(table.line or 0, along=table.along), surface)


def read_of(table: Roughness) -> Surface:
    """Measured surface of a table, from its file or heights. Raises InputError if these cannot be used."""
    if table.heights is not None:
        assert table.spacing is not None
        return surface_of(table.heights.values, table.spacing, table.spacing_y)
    assert table.file is not None
    return read_surface(
        table.file,
        x_unit=table.x_unit,
        z_unit=table.z_unit,
        spacing=table.spacing,
        spacing_y=table.spacing_y,
    )


def _of_profile(table: Roughness, profile: Profile, read: Surface | None) -> RoughSurface:
    steps = processed(profile, processing_of(table))
    last = steps[-1][1]
    height = _shifted(_cut(continued(last, table.extend), table.truncate), table.shift)
    voids = None if read is None else read.line_voids(table.line or 0, along=table.along)
    return RoughSurface(**_attributes(table, read, steps, voids), height=height, extent=last.length)


def _attributes(
    table: Roughness, read: Surface | None, steps: Sequence[tuple[str, Points]], voids: float | None
) -> dict[str, Any]:
    """Attributes that rough profiles and maps have in common."""
    return {
        "surface": table.surface,
        "surface_read": read,
        "steps": steps,
        "voids": voids,
        "warnings": (*(read.warnings if read else ()), *step_warnings(table, steps, voids)),
    }


def _cut(height: Height, limit: float | None) -> Height:
    """Height limited to ``limit`` [m] between the points too, as a spline overshoots there."""
    return height if limit is None else lambda x: np.clip(height(x), -limit, limit)


def _exact_shape(
    table: Roughness, shapes: Mapping[str, Callable[..., Array]], widest: tuple[str, float]
) -> Callable[..., Array]:
    """Exact shape of a table; ``widest`` is the name and the length [m] that bound its width."""
    names = chain(*GENERATORS[str(table.generator)])
    values: dict[str, Any] = {
        name: getattr(table, name) for name in names if getattr(table, name) is not None
    }
    if values.get("width", 0.0) > widest[1]:
        raise InputError(
            "roughness.width",
            got=f"{values['width']:.3g} m",
            takes=f"less than {widest[0]}, {widest[1]:.3g} m",
        )
    return partial(shapes[str(table.generator)], **values)


def _shifted(height: Height, shift: float) -> Height:
    return height if shift == 0.0 else lambda x: height(x - shift)


def _random(table: Roughness, domain: float, reach: float) -> Profile:
    """Random profile that extends ``reach`` [m] to both sides after the trim, for a domain length [m]."""
    smooth = table.generator == "gaussian"
    key = "correlation_length" if smooth else "rolloff_wavelength"
    longest = getattr(table, key)
    shortest = table.shortest_wavelength or longest / 100.0
    finest = (
        longest / generators.POINTS_IN_CORRELATION if smooth else shortest / generators.POINTS_IN_SHORTEST
    )
    length = 2.0 * (reach + _trim(table) + _MARGIN * finest)
    common: dict[str, Any] = {"rq": table.rq, "seed": table.seed, "length": length}
    with within("roughness"):
        _check_waves(key, longest, ("the domain", domain))
        if smooth:
            return generators.gaussian(correlation_length=longest, **common)
        assert table.hurst is not None
        return generators.self_affine(
            hurst=table.hurst, rolloff_wavelength=longest, shortest=shortest, **common
        )


# Points of a generated map beyond each side of the domain. The effect of the end conditions of a spline there
# is 1e-18 of the heights.
_MAP_MARGIN = 32


@dataclass(frozen=True, kw_only=True)
class RoughMap(_Rough):
    """Rough surface of a point contact."""

    # Height [m] as a function of positions x and y [m] whose shapes broadcast, positive out of the body.
    at: MapHeight
    # Lengths along the surface's own x and y axes before its continuation [m]. Infinite for an exact shape,
    # and along the lay of a profile.
    extent: tuple[float, float] = (np.inf, np.inf)
    orientation: float = 0.0  # angle of the surface's own x axis, counter-clockwise [degrees]

    def height(self, x: Array, y: Array) -> Array:
        """Heights (nx, ny) at the nodes x (nx,) and y (ny,) of a grid, all [m], positive out of the body."""
        return self.at(*np.meshgrid(x, y, indexing="ij"))


def _described_step(step: Map | Profile) -> dict[str, Any]:
    if isinstance(step, Profile):
        return {"points": step.heights.size, "spacing": step.spacing} | vars(statistics(step))
    nx, ny = step.heights.shape
    size = {"points_x": nx, "points_y": ny, "spacing_x": step.spacing_x, "spacing_y": step.spacing_y}
    return size | vars(map_statistics(step))


def rough_maps(tables: Sequence[Roughness], domain: Domain) -> list[RoughMap]:
    """Rough surfaces of a point contact, read or generated, one for each table.

    Raises an InputError if a file cannot be used, or a shape does not fit the domain.

    Examples
    --------
    >>> import numpy as np
    >>> bump = Roughness(surface=2, generator="asperity", height=2e-8, width=1e-5, position_y=1e-5)
    >>> (rough,) = rough_maps([bump], Domain(-4e-4, 2e-4, 3e-4))
    >>> rough.height(np.zeros(1), np.array([5e-6, 1e-5])).round(12)
    array([[1.e-08, 2.e-08]])
    """
    return [_rough_map(table, domain) for table in tables]


def _rough_map(table: Roughness, domain: Domain) -> RoughMap:
    if table.is_measured:
        return measured_map(table)
    if table.generator in SHAPES:
        side = "the shorter side of the domain", domain.shorter
        made = _exact_shape(table, map_generators.SHAPES, side)
        return RoughMap(surface=table.surface, at=lambda x, y: made(x - table.shift, y - table.shift_y))
    return _of_map(table, _random_map(table, domain), None)


def measured_map(table: Roughness) -> RoughMap:
    """Rough surface from a measured file, processed without reference to a contact.

    The mean height is always removed, as the zero of an instrument is arbitrary.

    Raises InputError if the file cannot be used.
    """
    read = read_of(table)
    if read.spacing_y is None or table.line is not None:
        return _extended(table, read)
    return whole_map(table, read)


def whole_map(table: Roughness, read: Surface | None = None) -> RoughMap:
    """Rough surface from a whole measured map.

    The file is read unless ``read`` has its content.

    Raises InputError if the file has no map, or the table asks for one line of it.
    """
    if table.line is not None:
        raise InputError("line", got=f"{table.line} for a whole map", takes="one or the other")
    if table.direction == "y":
        raise InputError(
            "roughness.direction",
            got="'y' for a whole map",
            takes="along = 'column' to turn it, or a line of it",
        )
    if read is None:
        read = read_of(table)
    return _of_map(table, read.map(along=table.along), read)


def _extended(table: Roughness, read: Surface) -> RoughMap:
    """Rough surface from one measured line, constant along the lay, which is perpendicular to the line."""
    across = table.direction == "y"
    # Along y the position of the profile is y, and its shift is the shift along y.
    line = measured(table.model_copy(update={"shift": table.shift_y if across else table.shift}), read)

    def at(x: Array, y: Array) -> Array:
        along, other = (y, x) if across else (x, y)
        return np.broadcast_to(line.height(along), np.broadcast_shapes(along.shape, other.shape))

    extent = (np.inf, line.extent) if across else (line.extent, np.inf)
    of_line = {each.name: getattr(line, each.name) for each in fields(_Rough)}
    return RoughMap(**of_line, at=at, extent=extent)


def _of_map(table: Roughness, made: Map, read: Surface | None) -> RoughMap:
    steps = processed_map(made, processing_of(table))
    last = steps[-1][1]
    turn = table.orientation or 0.0
    height = continued_map(last, table.extend)

    def at(x: Array, y: Array) -> Array:
        heights = height(*turned(x - table.shift, y - table.shift_y, turn))
        # The limit is applied between the points too, as the spline overshoots there.
        return heights if table.truncate is None else np.clip(heights, -table.truncate, table.truncate)

    attributes = _attributes(table, read, steps, None if read is None else read.voids)
    return RoughMap(**attributes, at=at, extent=(last.length_x, last.length_y), orientation=turn)


def _random_map(table: Roughness, domain: Domain) -> Map:
    """Random map that covers the domain after its ends have been trimmed."""
    make: Callable[..., Map]
    if table.generator == "gaussian":
        assert table.correlation_length is not None
        lengths = table.correlation_length, table.correlation_length_y or table.correlation_length
        key, longest = "correlation_length", min(lengths)
        spacings = [length / map_generators.POINTS_IN_CORRELATION for length in lengths]
        make = partial(
            map_generators.gaussian, correlation_length=lengths[0], correlation_length_y=lengths[1]
        )
    else:
        assert table.hurst is not None and table.rolloff_wavelength is not None
        key, longest = "rolloff_wavelength", table.rolloff_wavelength
        shortest = table.shortest_wavelength or longest / map_generators.SHORTEST_PART
        spacings = [shortest / map_generators.POINTS_IN_SHORTEST] * 2
        make = partial(
            map_generators.self_affine, hurst=table.hurst, rolloff_wavelength=longest, shortest=shortest
        )
    needed = zip(domain.reach(table), spacings, strict=True)
    reach_x, reach_y = (reach + _trim(table) + _MAP_MARGIN * spacing for reach, spacing in needed)
    with within("roughness"):
        _check_waves(key, longest, ("the shorter side of the domain", domain.shorter))
        return make(rq=table.rq, seed=table.seed, reach_x=reach_x, reach_y=reach_y)


def _trim(table: Roughness) -> float:
    """Length that is cut off at each end of a generated surface [m], at most."""
    return table.trim if table.trim is not None else max(table.cutoff_long or 0.0, table.cutoff_short or 0.0)


def _check_waves(key: str, length: float, side: tuple[str, float]) -> None:
    """Raise an InputError if a wave [m] is longer than a tenth of a ``side``, its name and length [m]."""
    most = MOST_OF_DOMAIN * side[1]
    if length > most:
        raise InputError(
            key,
            got=f"{length:.3g} m",
            takes=f"at most {most:.3g} m, a tenth of {side[0]}: the heights of fewer waves depend on chance",
        )
