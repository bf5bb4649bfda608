"""Maps of fewer pixels, of a size that a browser draws at once, which keep their extremes."""

from __future__ import annotations

import math

import numpy as np

from ehlectric.arrays import Array

# Largest number of pixels along a side of a map that a page receives.
MOST_PIXELS = 160


def coarser(heights: Array, most: int = MOST_PIXELS) -> tuple[Array, tuple[int, int]]:
    """Map of fewer pixels, each with the value of its block that is farthest from the mean of the map.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        Map, with NaN where it has no value.
    most : int
        Largest number of pixels along each side.

    Returns
    -------
    ndarray, shape (mx, my)
        Pixels. The largest and the smallest value of the map are among them.
    tuple of int
        Points along the sides of a block; those at the far ends may be smaller.

    Examples
    --------
    >>> import numpy as np
    >>> surface = np.zeros((100, 30))
    >>> surface[71, 11] = -2.0
    >>> pixels, block = coarser(surface, 50)
    >>> pixels.shape, block, float(pixels[35, 11])
    ((50, 30), (2, 1), -2.0)
    """
    block = tuple(math.ceil(n / most) for n in heights.shape)
    shape = tuple(math.ceil(n / size) for n, size in zip(heights.shape, block, strict=True))
    whole = np.full([n * size for n, size in zip(shape, block, strict=True)], np.nan)
    whole[: heights.shape[0], : heights.shape[1]] = heights
    there = np.isfinite(heights)
    mean = float(np.mean(heights[there])) if np.any(there) else 0.0
    blocks = whole.reshape(shape[0], block[0], shape[1], block[1]).swapaxes(1, 2).reshape(*shape, -1)
    away = np.where(np.isfinite(blocks), np.abs(blocks - mean), -1.0)
    pixels: Array = np.take_along_axis(blocks, np.argmax(away, axis=-1)[..., np.newaxis], axis=-1)[..., 0]
    return pixels, (block[0], block[1])
