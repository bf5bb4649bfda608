"""Roughness of a line contact: the height of each rough surface as a function of position.

The midpoint of a profile lies at x = 0. A profile that is shorter than the domain is continued by the key
``extend`` of the case. The warnings about a profile are in ``ehlectric.surfaces.warnings``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from typing import Any

import numpy as np

from ehlectric.cases.roughness import GENERATORS, SHAPES, Roughness
from ehlectric.errors import InputError, ResultWarning
from ehlectric.surfaces import made_profiles as generators
from ehlectric.surfaces.continuation import Height, continued
from ehlectric.surfaces.domain import Domain
from ehlectric.surfaces.files import Surface, read_surface
from ehlectric.surfaces.profiles import Profile, processed, statistics
from ehlectric.surfaces.steps import MOST_OF_DOMAIN, processing_of, step_warnings

# Points of a generated profile beyond each end of the domain. The end conditions of a spline have no effect
# farther inside.
_MARGIN = 64


@dataclass(frozen=True)
class RoughSurface:
    """Rough surface of a line contact.

    Attributes
    ----------
    surface : int
        Number of the surface, 1 (lower) or 2 (upper).
    height : callable
        Height [m] as a function of position [m], positive out of the body.
    surface_read : Surface or None
        Content of the file; None for a generated surface.
    steps : list of (str, Profile)
        Description of each processing step and the profile after it; empty for an exact shape.
    extent : float
        Length of the profile before its continuation [m]; infinite for an exact shape.
    voids : float or None
        Fraction of the points of the line without data in the file; None for a generated surface.
    warnings : tuple of ResultWarning
        Warnings about the file and the processing steps.
    """

    surface: int
    height: Height
    surface_read: Surface | None
    steps: list[tuple[str, Profile]]
    extent: float
    voids: float | None = None
    warnings: tuple[ResultWarning, ...] = ()

    def describe(self) -> dict[str, Any]:
        """Source, processing steps and statistics of the surface in SI units, for the files of a result."""
        read = self.surface_read
        return {
            "surface": self.surface,
            "source": None if read is None else read.source,
            "size": None if read is None else list(read.heights.shape),
            "voids": self.voids,
            "height_step": None if read is None else read.height_step,
            "steps": [
                {"step": name, "points": profile.heights.size, "spacing": profile.spacing}
                | vars(statistics(profile))
                for name, profile in self.steps
            ],
        }


def rough_surfaces(tables: Sequence[Roughness], domain: Domain) -> list[RoughSurface]:
    """Read or generate the roughness of a line contact.

    Parameters
    ----------
    tables : sequence of Roughness
        Tables ``[[roughness]]`` of the case.
    domain : Domain
        Domain of the film [m].

    Returns
    -------
    list of RoughSurface
        One surface per table, in their order.

    Raises
    ------
    InputError
        If a file cannot be used, or a shape does not fit the domain.
    """
    return [_rough_surface(table, domain) for table in tables]


def _rough_surface(table: Roughness, domain: Domain) -> RoughSurface:
    if table.generator in SHAPES:
        return RoughSurface(table.surface, _shape(table, domain.length), None, [], np.inf)
    if table.file is not None:
        return measured(table)
    reach = max(abs(end - table.shift) for end in (domain.inlet, domain.outlet))
    return _of_profile(table, _random(table, domain.length, reach), None)


def measured(table: Roughness, surface: Surface | None = None) -> RoughSurface:
    """Rough surface from one line of a measured file, processed without reference to a contact.

    The file is read unless ``surface`` has its content. The mean height is always removed, as the zero of an
    instrument is arbitrary.

    Raises
    ------
    InputError
        If the file cannot be used.
    """
    assert table.file is not None
    if surface is None:
        surface = read_surface(table.file, x_unit=table.x_unit, z_unit=table.z_unit)
    return _of_profile(table, surface.line(table.line or 0, along=table.along), surface)


def _of_profile(table: Roughness, profile: Profile, read: Surface | None) -> RoughSurface:
    steps = processed(profile, processing_of(table))
    last = steps[-1][1]
    height = _shifted(_cut(continued(last, table.extend), table.truncate), table.shift)
    voids = None if read is None else read.line_voids(table.line or 0, along=table.along)
    warnings = (*(read.warnings if read else ()), *step_warnings(table, steps, voids))
    return RoughSurface(table.surface, height, read, steps, last.length, voids, warnings)


def _cut(height: Height, limit: float | None) -> Height:
    """Height limited to ``limit`` [m] between the points too, as a spline overshoots there."""
    return height if limit is None else lambda x: np.clip(height(x), -limit, limit)


def _shape(table: Roughness, domain: float) -> Height:
    names = chain(*GENERATORS[str(table.generator)])
    values: dict[str, Any] = {
        name: getattr(table, name) for name in names if getattr(table, name) is not None
    }
    if values.get("width", 0.0) > domain:
        raise InputError(
            "roughness.width", got=f"{values['width']:.3g} m", takes=f"less than the domain, {domain:.3g} m"
        )
    return _shifted(partial(generators.SHAPES[str(table.generator)], **values), table.shift)


def _shifted(height: Height, shift: float) -> Height:
    return height if shift == 0.0 else lambda x: height(x - shift)


def _random(table: Roughness, domain: float, reach: float) -> Profile:
    """Random profile that extends ``reach`` [m] to both sides after the trim, for a domain length [m]."""
    assert table.rq is not None and table.seed is not None
    key = "correlation_length" if table.generator == "gaussian" else "rolloff_wavelength"
    longest = getattr(table, key)
    if longest > MOST_OF_DOMAIN * domain:
        raise InputError(
            f"roughness.{key}",
            got=f"{longest:.3g} m",
            takes=f"at most {MOST_OF_DOMAIN * domain:.3g} m, a tenth of the domain: the heights of "
            "fewer waves are those of chance",
        )
    trim = table.trim if table.trim is not None else max(table.cutoff_long or 0.0, table.cutoff_short or 0.0)
    common: dict[str, Any] = {"rq": table.rq, "seed": table.seed}
    shortest = table.shortest_wavelength or longest / 100.0
    if table.generator == "gaussian":
        finest = longest / generators.POINTS_IN_CORRELATION
    else:
        finest = shortest / generators.POINTS_IN_SHORTEST
    common["length"] = 2.0 * (reach + trim + _MARGIN * finest)
    try:
        if table.generator == "gaussian":
            return generators.gaussian(correlation_length=longest, **common)
        assert table.hurst is not None
        return generators.self_affine(
            hurst=table.hurst, rolloff_wavelength=longest, shortest=shortest, **common
        )
    except InputError as error:
        raise error.under("roughness") from None
