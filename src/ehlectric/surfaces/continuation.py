"""Interpolation of a profile or a map between its points, and its continuation beyond its ends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np
from scipy.interpolate import CubicSpline

from ehlectric.arrays import Array
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import TAPER, Profile

# Height of a map [m] as a function of positions x and y [m] whose shapes broadcast, and height of a profile
# [m] as a function of position x [m].
MapHeight: TypeAlias = Callable[[Array, Array], Array]
Height = Callable[[Array], Array]


def continued_map(surface: Map, extend: str) -> MapHeight:
    """Height of a map at any position: a bicubic spline inside the map, and its continuation outside.

    Parameters
    ----------
    surface : Map
        Map, with its middle at (0, 0).
    extend : str
        Continuation beyond the sides. "mirror" reflects the map at its sides. "repeat" repeats the map; near
        opposite sides, over 5 % of the length, the heights are blended so that they join. "flat" continues
        with zero; the map fades to zero over 5 % of the length at each side.

    Returns
    -------
    callable
        Height [m] as a function of positions x and y [m] whose shapes broadcast.

    Examples
    --------
    >>> import numpy as np
    >>> ramp = Map(1.0, 1.0, np.add.outer(np.linspace(-1.0, 1.0, 21), np.zeros(21)))
    >>> np.round(continued_map(ramp, "mirror")(np.array([10.0, 15.0, 30.0]), np.zeros(3)), 2)
    array([ 1. ,  0.5, -1. ])
    """
    from scipy import ndimage  # imported here, as smooth contacts do not need it

    z = surface.heights
    mode: Literal["mirror", "grid-wrap"] = "mirror"
    fades = [_fade(n) for n in z.shape]
    if extend == "flat":
        z = z * np.outer(*fades)
    elif extend == "repeat":
        z, mode = _joined(_joined(z, fades[0]).T, fades[1]).T[:-1, :-1], "grid-wrap"
    coefficients = ndimage.spline_filter(z, order=3, mode=mode)
    middle = [0.5 * (n - 1) for n in surface.heights.shape]

    def height(x: Array, y: Array) -> Array:
        places = x / surface.spacing_x + middle[0], y / surface.spacing_y + middle[1]
        at = np.array(np.broadcast_arrays(*places))
        heights: Array = ndimage.map_coordinates(coefficients, at, order=3, mode=mode, prefilter=False)
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
    """Height of a profile at any position: a cubic spline inside the profile, and its continuation outside.

    Parameters
    ----------
    profile : Profile
        Profile, with its midpoint at x = 0.
    extend : str
        Continuation beyond the ends. "mirror" reflects the profile at its ends. "repeat" repeats the profile;
        near the ends, over 5 % of the length, the heights are blended so that they join. "flat" continues
        with zero; the profile fades to zero over 5 % of the length at each end.

    Returns
    -------
    callable
        Height [m], shape (n,), as a function of positions [m], shape (n,).

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
    # Both ends are blended into the mean of the two, so that the joint has neither step nor kink.
    joint = 0.5 * (z[0] + z[-1])
    spline = CubicSpline(x, joint + (z - joint) * fade)
    return lambda at: spline((at + half) % length - half)
