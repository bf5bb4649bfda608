"""The roughness of a case on the contact: each rough surface's height as a function of position.

A profile shorter than the domain is continued as the case says, without a step; its midpoint lies at x = 0.
``surfaces.warnings`` tells what is unreliable about it before any film is solved.
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

# Points of a made profile beyond the domain: the ends of a spline are felt no further.
_MARGIN = 64


@dataclass(frozen=True)
class RoughSurface:
    """One rough surface of a case.

    Attributes
    ----------
    surface : int
        1 (lower) or 2 (upper).
    height : callable
        Height over position [m], positive out of the body.
    surface_read : Surface or None
        What the file held.
    steps : list of (str, Profile)
        The profile after every step; empty for an exact shape.
    extent : float
        Length of the profile before it is continued [m]; infinite for an exact shape.
    voids : float or None
        Part of the line's points where the file has no data.
    warnings : tuple of ResultWarning
        What is unreliable about the file and the steps.
    """

    surface: int
    height: Height
    surface_read: Surface | None
    steps: list[tuple[str, Profile]]
    extent: float
    voids: float | None = None
    warnings: tuple[ResultWarning, ...] = ()

    def describe(self) -> dict[str, Any]:
        """What it is and what was done to it, SI units, for the files of a result."""
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
    """Read or make the roughness of a line contact.

    Parameters
    ----------
    tables : sequence of Roughness
        Of the case.
    domain : Domain
        Where the film is solved [m].

    Returns
    -------
    list of RoughSurface
        As many as there are tables.

    Raises
    ------
    InputError
        Where a file cannot be used, or a shape does not fit the domain.
    """
    return [_rough_surface(table, domain) for table in tables]


def _rough_surface(table: Roughness, domain: Domain) -> RoughSurface:
    if table.generator in SHAPES:
        return RoughSurface(table.surface, _shape(table, domain.length), None, [], np.inf)
    if table.file is not None:
        return measured(table)
    reach = max(abs(end - table.shift) for end in (domain.inlet, domain.outlet))
    return _of_profile(table, _random(table, domain.length, reach), None)


def measured(table: Roughness) -> RoughSurface:
    """The rough surface of a file, which needs no contact to be looked at.

    Its mean is taken out in any case: where the instrument's zero lies means nothing.

    Raises
    ------
    InputError
        Where the file cannot be used.
    """
    assert table.file is not None
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
    """Height within a limit between the points too, where a spline overshoots them."""
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
    """A made profile that reaches so far from its middle, whatever is trimmed."""
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
