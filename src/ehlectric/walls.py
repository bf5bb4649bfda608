"""The roughness of a case on the contact: each rough surface's height as a function of position.

A profile shorter than the domain is continued as the case says, without a step; its midpoint lies at x = 0.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from ehlectric import generators
from ehlectric.case import Case
from ehlectric.conditions import Conditions
from ehlectric.errors import InputError
from ehlectric.inputs import GENERATORS, SHAPES, Roughness
from ehlectric.roughness import Processing, Profile, processed, statistics
from ehlectric.surface_files import Surface, read_surface
from ehlectric.typing import Array

# Part of a profile over which its ends are blended or faded where it is continued.
TAPER = 0.05

Height = Callable[[Array], Array]


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
    """

    surface: int
    height: Height
    surface_read: Surface | None
    steps: list[tuple[str, Profile]]
    extent: float

    def describe(self) -> dict[str, Any]:
        """What it is and what was done to it, SI units, for the files of a result."""
        read = self.surface_read
        return {
            "surface": self.surface,
            "source": None if read is None else read.source,
            "size": None if read is None else list(read.heights.shape),
            "voids": None if read is None else read.voids,
            "height_step": None if read is None else read.height_step,
            "steps": [
                {"step": name, "points": profile.heights.size, "spacing": profile.spacing}
                | vars(statistics(profile))
                for name, profile in self.steps
            ],
        }


def rough_surfaces(case: Case, conditions: Conditions) -> list[RoughSurface]:
    """Read or make the roughness of a case.

    Parameters
    ----------
    case : Case
        Whose ``roughness`` is asked for.
    conditions : Conditions
        Of the same case.

    Returns
    -------
    list of RoughSurface
        As many as the case has.

    Raises
    ------
    InputError
        Where a file cannot be used, or a shape does not fit the domain.
    """
    return [_rough_surface(table, case, conditions) for table in case.roughness]


def _rough_surface(table: Roughness, case: Case, conditions: Conditions) -> RoughSurface:
    b, grid = conditions.half_width, case.grid
    domain = (grid.outlet - grid.inlet) * b
    if table.generator in SHAPES:
        return RoughSurface(table.surface, _shape(table, domain), None, [], np.inf)
    if table.file is not None:
        return measured(table)
    return _of_profile(table, _random(table, domain), None)


def measured(table: Roughness) -> RoughSurface:
    """The rough surface of a file, which needs no contact to be looked at.

    Raises
    ------
    InputError
        Where the file cannot be used.
    """
    assert table.file is not None
    surface = read_surface(table.file, x_unit=table.x_unit, z_unit=table.z_unit)
    return _of_profile(table, surface.line(table.line, along=table.along), surface)


def _of_profile(table: Roughness, profile: Profile, read: Surface | None) -> RoughSurface:
    steps = processed(profile, processing_of(table))
    last = steps[-1][1]
    height = _shifted(continued(last, table.extend), table.shift)
    return RoughSurface(table.surface, height, read, steps, last.length)


def processing_of(table: Roughness) -> Processing:
    """The steps a case asks for."""
    return Processing(**{step.name: getattr(table, step.name) for step in fields(Processing)})


def _shape(table: Roughness, domain: float) -> Height:
    names = chain(*GENERATORS[str(table.generator)])
    values: dict[str, Any] = {
        name: getattr(table, name) for name in names if getattr(table, name) is not None
    }
    if values.get("width", 0.0) > domain:
        raise InputError(
            f"roughness.width: got {values['width']:.3g} m, takes less than the domain, {domain:.3g} m"
        )
    return _shifted(partial(getattr(generators, str(table.generator)), **values), table.shift)


def _shifted(height: Height, shift: float) -> Height:
    return height if shift == 0.0 else lambda x: height(x - shift)


def _random(table: Roughness, domain: float) -> Profile:
    assert table.rq is not None and table.seed is not None
    # Twice the domain, so that a shift stays within it.
    common: dict[str, Any] = {"rq": table.rq, "seed": table.seed, "length": 2.0 * domain}
    if table.generator == "gaussian":
        assert table.correlation_length is not None
        return generators.gaussian(correlation_length=table.correlation_length, **common)
    assert table.hurst is not None and table.rolloff_wavelength is not None
    shortest = table.shortest_wavelength or table.rolloff_wavelength / 100.0
    return generators.self_affine(
        hurst=table.hurst, rolloff_wavelength=table.rolloff_wavelength, shortest=shortest, **common
    )


def continued(profile: Profile, extend: str) -> Height:
    """Height of a profile at any position: within it a cubic spline, beyond it continued without a step.

    Parameters
    ----------
    profile : Profile
        Its midpoint at x = 0.
    extend : str
        "mirror" reflects it at its ends; "repeat" joins its ends, blended over 5 % of its length; "flat"
        fades it to zero over 5 % of its length at each end.

    Returns
    -------
    callable
        Position [m] (n,) -> height [m] (n,).

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
        spline = CubicSpline(x, z)
        return lambda at: spline(np.abs((at + half + length) % (2.0 * length) - length) - half)
    ends = np.clip((half - np.abs(x)) / (TAPER * length), 0.0, 1.0)
    fade = 0.5 - 0.5 * np.cos(np.pi * ends)
    if extend == "flat":
        spline = CubicSpline(x, z * fade)
        return lambda at: np.where(np.abs(at) < half, spline(np.clip(at, -half, half)), 0.0)
    # Each end goes over to the mean of the two, so that the joint has neither step nor kink.
    joint = 0.5 * (z[0] + z[-1])
    spline = CubicSpline(x, joint + (z - joint) * fade)
    return lambda at: spline((at + half) % length - half)
