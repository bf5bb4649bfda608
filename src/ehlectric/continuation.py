"""Heights of a map between its points and beyond its sides."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np

from ehlectric.roughness import TAPER
from ehlectric.topography import Map
from ehlectric.typing import Array

# Positions x and y that fit each other [m] -> height [m].
MapHeight: TypeAlias = Callable[[Array, Array], Array]


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
