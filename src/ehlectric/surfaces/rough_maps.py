"""Roughness of a point contact: the height of each rough surface as a function of position (x, y).

A measured map is used whole. A measured profile, or one line of a map, is extended along the lay, across its
own direction. Lengths are in metres, and x runs along entrainment.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.roughness import GENERATORS, SHAPES, Roughness
from ehlectric.errors import InputError, ResultWarning
from ehlectric.surfaces import made_maps as map_generators
from ehlectric.surfaces.continuation import MapHeight, continued_map
from ehlectric.surfaces.domain import Domain, turned
from ehlectric.surfaces.files import Surface, read_surface
from ehlectric.surfaces.maps import Map, processed_map, statistics
from ehlectric.surfaces.profiles import Profile
from ehlectric.surfaces.profiles import statistics as of_profile
from ehlectric.surfaces.rough_profiles import measured
from ehlectric.surfaces.steps import MOST_OF_DOMAIN, processing_of, step_warnings

# Points of a generated map beyond each side of the domain. The effect of the end conditions of a spline there
# is 1e-18 of the heights.
_MARGIN = 32


@dataclass(frozen=True)
class RoughMap:
    """Rough surface of a point contact.

    Attributes
    ----------
    surface : int
        Number of the surface, 1 (lower) or 2 (upper).
    at : callable
        Height [m] as a function of positions x and y [m] whose shapes broadcast, positive out of the body.
    surface_read : Surface or None
        Content of the file; None for a generated surface.
    steps : list of (str, Map) or list of (str, Profile)
        Description of each processing step and the surface after it: a map, or the profile that is extended.
        Empty for an exact shape.
    extent : tuple of float
        Lengths along the surface's own x and y axes before its continuation [m]. Infinite for an exact shape,
        and along the lay of a profile.
    orientation : float
        Angle of the surface's own x axis, counter-clockwise [degrees].
    voids : float or None
        Fraction of the points used that have no data in the file; None for a generated surface.
    warnings : tuple of ResultWarning
        Warnings about the file and the processing steps.
    """

    surface: int
    at: MapHeight
    surface_read: Surface | None
    steps: Sequence[tuple[str, Map | Profile]]
    extent: tuple[float, float]
    orientation: float = 0.0
    voids: float | None = None
    warnings: tuple[ResultWarning, ...] = ()

    def height(self, x: Array, y: Array) -> Array:
        """Heights of the surface at the nodes of a grid.

        Parameters
        ----------
        x : ndarray, shape (nx,)
            Positions along entrainment [m], zero at the centre of the contact.
        y : ndarray, shape (ny,)
            Positions across entrainment [m].

        Returns
        -------
        ndarray, shape (nx, ny)
            Heights [m], positive out of the body.
        """
        return self.at(*np.meshgrid(x, y, indexing="ij"))

    def describe(self) -> dict[str, Any]:
        """Source, processing steps and statistics of the surface in SI units, for the files of a result."""
        read = self.surface_read
        return {
            "surface": self.surface,
            "source": None if read is None else read.source,
            "size": None if read is None else list(read.heights.shape),
            "voids": self.voids,
            "height_step": None if read is None else read.height_step,
            "steps": [{"step": name} | _described(step) for name, step in self.steps],
        }


def _described(step: Map | Profile) -> dict[str, Any]:
    if isinstance(step, Profile):
        return {"points": step.heights.size, "spacing": step.spacing} | vars(of_profile(step))
    nx, ny = step.heights.shape
    size = {"points_x": nx, "points_y": ny, "spacing_x": step.spacing_x, "spacing_y": step.spacing_y}
    return size | vars(statistics(step))


def rough_maps(tables: Sequence[Roughness], domain: Domain) -> list[RoughMap]:
    """Read or generate the roughness of a point contact.

    Parameters
    ----------
    tables : sequence of Roughness
        Tables ``[[roughness]]`` of the case.
    domain : Domain
        Domain of the film [m].

    Returns
    -------
    list of RoughMap
        One surface per table, in their order.

    Raises
    ------
    InputError
        If a file cannot be used, or a shape does not fit the domain.

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
    if table.file is not None:
        return measured_map(table)
    if table.generator in SHAPES:
        return RoughMap(table.surface, _shape(table, domain), None, [], (np.inf, np.inf))
    return _of_map(table, _random(table, domain), None)


def measured_map(table: Roughness) -> RoughMap:
    """Rough surface from a measured file, processed without reference to a contact.

    The mean height is always removed, as the zero of an instrument is arbitrary.

    Raises
    ------
    InputError
        If the file cannot be used.
    """
    assert table.file is not None
    read = read_surface(table.file, x_unit=table.x_unit, z_unit=table.z_unit)
    if read.spacing_y is None or table.line is not None:
        return _extended(table, read)
    return whole_map(table, read)


def whole_map(table: Roughness, read: Surface | None = None) -> RoughMap:
    """Rough surface from a whole measured map.

    The file is read unless ``read`` has its content.

    Raises
    ------
    InputError
        If the file has no map, or the table asks for one line of it.
    """
    assert table.file is not None
    if table.line is not None:
        raise InputError("line", got=f"{table.line} for a whole map", takes="one or the other")
    if table.direction == "y":
        raise InputError(
            "roughness.direction",
            got="'y' for a whole map",
            takes="along = 'column' to turn it, or a line of it",
        )
    if read is None:
        read = read_surface(table.file, x_unit=table.x_unit, z_unit=table.z_unit)
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
    return RoughMap(
        table.surface, at, line.surface_read, line.steps, extent, voids=line.voids, warnings=line.warnings
    )


def _of_map(table: Roughness, made: Map, read: Surface | None) -> RoughMap:
    steps = processed_map(made, processing_of(table))
    last = steps[-1][1]
    turn = table.orientation or 0.0
    height = continued_map(last, table.extend)

    def at(x: Array, y: Array) -> Array:
        heights = height(*turned(x - table.shift, y - table.shift_y, turn))
        # The limit is applied between the points too, as the spline overshoots there.
        return heights if table.truncate is None else np.clip(heights, -table.truncate, table.truncate)

    voids = None if read is None else read.voids
    warnings = (*(read.warnings if read else ()), *step_warnings(table, steps, voids))
    extent = last.length_x, last.length_y
    return RoughMap(table.surface, at, read, steps, extent, turn, voids=voids, warnings=warnings)


def _shape(table: Roughness, domain: Domain) -> MapHeight:
    names = chain(*GENERATORS[str(table.generator)])
    values: dict[str, Any] = {
        name: getattr(table, name) for name in names if getattr(table, name) is not None
    }
    if values.get("width", 0.0) > domain.shorter:
        raise InputError(
            "roughness.width",
            got=f"{values['width']:.3g} m",
            takes=f"less than the shorter side of the domain, {domain.shorter:.3g} m",
        )
    made: MapHeight = partial(map_generators.SHAPES[str(table.generator)], **values)
    return lambda x, y: made(x - table.shift, y - table.shift_y)


def _random(table: Roughness, domain: Domain) -> Map:
    """Random map that covers the domain after its ends have been trimmed."""
    assert table.rq is not None and table.seed is not None
    trim = table.trim if table.trim is not None else max(table.cutoff_long or 0.0, table.cutoff_short or 0.0)
    reach = [length + trim for length in domain.reach(table)]
    try:
        if table.generator == "gaussian":
            assert table.correlation_length is not None
            lengths = table.correlation_length, table.correlation_length_y or table.correlation_length
            _check_waves("correlation_length", min(lengths), domain)
            beyond = [_MARGIN * length / map_generators.POINTS_IN_CORRELATION for length in lengths]
            return map_generators.gaussian(
                rq=table.rq,
                correlation_length=lengths[0],
                correlation_length_y=lengths[1],
                reach_x=reach[0] + beyond[0],
                reach_y=reach[1] + beyond[1],
                seed=table.seed,
            )
        assert table.hurst is not None and table.rolloff_wavelength is not None
        _check_waves("rolloff_wavelength", table.rolloff_wavelength, domain)
        shortest = table.shortest_wavelength or table.rolloff_wavelength / map_generators.SHORTEST_PART
        margin = _MARGIN * shortest / map_generators.POINTS_IN_SHORTEST
        return map_generators.self_affine(
            rq=table.rq,
            hurst=table.hurst,
            rolloff_wavelength=table.rolloff_wavelength,
            reach_x=reach[0] + margin,
            reach_y=reach[1] + margin,
            seed=table.seed,
            shortest=shortest,
        )
    except InputError as error:
        raise error.under("roughness") from None


def _check_waves(key: str, length: float, domain: Domain) -> None:
    most = MOST_OF_DOMAIN * domain.shorter
    if length > most:
        raise InputError(
            key,
            got=f"{length:.3g} m",
            takes=f"at most {most:.3g} m, a tenth of the shorter side of the domain: the heights of "
            "fewer waves are those of chance",
        )
