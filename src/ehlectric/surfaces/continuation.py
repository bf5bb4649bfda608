"""Heights of a profile or a map between its points and beyond its ends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np
from scipy.interpolate import CubicSpline

from ehlectric.arrays import Array
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import TAPER, Profile

# Positions x and y that fit each other [m] -> height [m].
MapHeight: TypeAlias = Callable[[Array, Array], Array]
Height = Callable[[Array], Array]


def continued_map(surface: Map, extend: str) -> MapHeight:
    """Height of a map at any position: within it a bicubic spline, beyond it continued without a step.

    Parameters
    ----------
    surface : Map
        Its middle at (0, 0).
    extend : str
        "mirror" reflects it at its sides; "repeat" joins opposite sides, blended over 5 % of the length;
        "flat" fades it to zero over 5 % of the length at each side.

    Returns
    -------
    callable
        Positions x and y that fit each other [m] -> height [m].

    Examples
    --------
    >>> import numpy as np
    >>> ramp = Map(1.0, 1.0, np.add.outer(np.linspace(-1.0, 1.0, 21), np.zeros(21)))
    >>> np.round(continued_map(ramp, "mirror")(np.array([10.0, 15.0, 30.0]), np.zeros(3)), 2)
    array([ 1. ,  0.5, -1. ])
    """
    from scipy import ndimage  # not needed by smooth contacts

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
    """From zero at both ends to one within the taper, over n points."""
    ends = np.clip((0.5 - np.abs(np.linspace(-0.5, 0.5, n))) / TAPER, 0.0, 1.0)
    fade: Array = 0.5 - 0.5 * np.cos(np.pi * ends)
    return fade


def _joined(z: Array, fade: Array) -> Array:
    """Heights whose first and last rows go over to the mean of the two, with neither step nor kink."""
    joint = 0.5 * (z[0] + z[-1])
    joined: Array = joint + (z - joint) * fade[:, np.newaxis]
    return joined


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
