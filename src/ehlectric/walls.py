"""The roughness of a case on the contact: each rough surface's height as a function of position.

A profile shorter than the domain is continued as the case says, without a step; its midpoint lies at x = 0.
What is doubtful about all this before any film is solved, ``remarks`` says.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from ehlectric import generators
from ehlectric.errors import InputError
from ehlectric.roughness import LEAST_POINTS, TAPER, Points, Processing, Profile, processed, rms, statistics
from ehlectric.roughness_inputs import GENERATORS, SHAPES, Roughness
from ehlectric.surface_domain import Domain
from ehlectric.surface_files import Surface, read_surface
from ehlectric.topography import Map
from ehlectric.typing import Array

# Part of the domain that one correlation length or roll-off wavelength may take: with fewer than ten of them
# its statistics are those of chance.
MOST_OF_DOMAIN = 0.1

# Points of a made profile beyond the domain: the ends of a spline are felt no further.
_MARGIN = 64

# Grid spacings in a correlation length, and in a wavelength or the width of a feature, below which they are
# not resolved, and the part of a profile's variance that a grid may miss.
LEAST_IN_CORRELATION = 2.0
LEAST_IN_SHAPE = 8.0
MOST_MISSED = 0.01

# Part of a profile's points that may be cut off without a word.
_MOST_CUT = 0.05

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
    voids : float or None
        Part of the line's points where the file has no data.
    remarks : tuple of str
        What is doubtful about the file and the steps.
    """

    surface: int
    height: Height
    surface_read: Surface | None
    steps: list[tuple[str, Profile]]
    extent: float
    voids: float | None = None
    remarks: tuple[str, ...] = ()

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
    doubts = (*(read.remarks if read else ()), *step_remarks(table, steps, voids))
    return RoughSurface(table.surface, height, read, steps, last.length, voids, doubts)


def processing_of(table: Roughness) -> Processing:
    """The steps a case asks for; those of a file begin with its mean where it has no form taken out."""
    steps = Processing(**{step.name: getattr(table, step.name) for step in fields(Processing)})
    return replace(steps, form="mean") if table.file is not None and steps.form == "none" else steps


def _cut(height: Height, limit: float | None) -> Height:
    """Height within a limit between the points too, where a spline overshoots them."""
    return height if limit is None else lambda x: np.clip(height(x), -limit, limit)


def step_remarks(table: Roughness, steps: Sequence[tuple[str, Points]], voids: float | None) -> Iterator[str]:
    """What is doubtful about the steps of a profile or map."""
    if voids:
        of_map = isinstance(steps[0][1], Map)
        yield (
            f"{100 * voids:.2g} % of the {'map' if of_map else 'line'} of surface {table.surface} is void; "
            f"voids within it were filled {'as a soap film hangs in them' if of_map else 'by straight lines'}"
        )
    if table.truncate is not None:
        share = float(np.mean(np.abs(steps[-2][1].heights) > table.truncate))
        if share > _MOST_CUT:
            yield (
                f"truncate cuts {100 * share:.2g} % of the points of surface {table.surface}, whose Rq is "
                f"{rms(steps[-2][1].heights) * 1e9:.3g} nm before it: what is left is another surface"
            )


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


def _random(table: Roughness, domain: float, reach: float) -> Profile:
    """A made profile that reaches so far from its middle, whatever is trimmed."""
    assert table.rq is not None and table.seed is not None
    key = "correlation_length" if table.generator == "gaussian" else "rolloff_wavelength"
    longest = getattr(table, key)
    if longest > MOST_OF_DOMAIN * domain:
        raise InputError(
            f"roughness.{key}: got {longest:.3g} m, takes at most {MOST_OF_DOMAIN * domain:.3g} m, a tenth "
            "of the domain: the heights of fewer waves are those of chance"
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
        raise InputError(f"roughness.{error}") from None


def remarks(
    tables: Sequence[Roughness], rough: Sequence[RoughSurface], domain: Domain, dx: float
) -> Iterator[str]:
    """What a user should know about the roughness of a line contact before it is solved, one text each."""
    for table, surface in zip(tables, rough, strict=True):
        yield from surface.remarks
        ends = domain.inlet - table.shift, domain.outlet - table.shift
        reach = 2.0 * max(map(abs, ends))
        if surface.extent < reach:
            yield (
                f"the profile of surface {surface.surface} is {surface.extent * 1e6:.4g} µm long and the "
                f"domain needs {reach * 1e6:.4g} µm: it was continued by extend = {table.extend!r}"
            )
        if surface.steps:
            yield from profile_remarks(surface.surface, surface.steps[-1][1], dx, ends)
        else:
            yield from _shape_remarks(table, dx, ends)
    yield from same_seeds(tables)


def same_seeds(tables: Iterable[Roughness]) -> Iterator[str]:
    """Made surfaces that are not independent of each other."""
    for seed, times in Counter(table.seed for table in tables if table.seed is not None).items():
        if times > 1:
            yield (
                f"{times} rough surfaces have the seed {seed}: they are made of the same random numbers and "
                "are not independent of each other"
            )


def unresolved(dx: float, what: str, length: float) -> str:
    """That a grid is too coarse for something; the text before its length is ``what``."""
    return (
        f"the grid, {dx * 1e6:.3g} µm, does not resolve {what} is {length * 1e6:.3g} µm: its error estimate "
        "means nothing yet"
    )


def _shape_remarks(table: Roughness, dx: float, ends: tuple[float, float]) -> Iterator[str]:
    """Exact shapes finer than the grid, where they lie within the domain."""
    name, length = ("wavelength", table.wavelength) if table.wavelength else ("width", table.width)
    assert length is not None
    position = table.position or 0.0
    if name == "width" and not ends[0] - 2.0 * length < position < ends[1] + 2.0 * length:
        return
    # The rim of a pit is half as wide as the pit.
    finest = 0.5 * length if table.rim else length
    if dx > finest / LEAST_IN_SHAPE:
        whose = f"the {'rim of the ' if table.rim else ''}{table.generator} of surface {table.surface}"
        yield unresolved(dx, f"{whose}, whose {name}", finest)


def profile_remarks(surface: int, last: Profile, dx: float, ends: tuple[float, float]) -> Iterator[str]:
    """A surface whose profile, after the last step, is finer than the grid."""
    length = statistics(last).correlation_length
    if dx > length / LEAST_IN_CORRELATION:
        whose = f"the profile of surface {surface}, whose correlation length"
        yield unresolved(dx, whose, length)
    missed = variance_beyond(last, 0.5 / dx, ends)
    if missed > MOST_MISSED:
        yield (
            f"the grid, {dx * 1e6:.3g} µm, misses {100 * missed:.2g} % of the variance of surface "
            f"{surface}, in waves shorter than two spacings; take more grid.nodes, or a cutoff_short "
            f"of {4e6 * dx:.3g} µm or more"
        )


def variance_beyond(profile: Profile, frequency: float, ends: tuple[float, float]) -> float:
    """Part of a profile's variance in waves of more than a spatial frequency [1/m], from its periodogram.

    Parameters
    ----------
    profile : Profile
        Heights.
    frequency : float
        Waves per length [1/m].
    ends : tuple of float
        Between which it counts [m]; all of it where it has no sixteen points there.

    Returns
    -------
    float
        From 0 to 1.

    Examples
    --------
    >>> import numpy as np
    >>> k = np.arange(4000)
    >>> two_waves = Profile(1e-7, 3e-8 * np.sin(k / 50) + 1e-8 * np.sin(k / 2))
    >>> round(variance_beyond(two_waves, 1e5, (-1.0, 1.0)), 3)
    0.1
    """
    inside = (profile.x >= ends[0]) & (profile.x <= ends[1])
    z = profile.heights[inside] if np.count_nonzero(inside) >= LEAST_POINTS else profile.heights
    # Hann's window, so that a step from the last to the first point counts for nothing.
    power = np.abs(np.fft.rfft((z - np.mean(z)) * np.hanning(z.size))) ** 2
    total = float(np.sum(power))
    waves = np.fft.rfftfreq(z.size, profile.spacing)
    return float(np.sum(power[waves > frequency])) / total if total > 0.0 else 0.0


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
