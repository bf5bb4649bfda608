"""Modified interpolation of Akima, which overshoots less than a spline next to a step."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array


def with_middles(nodes: Array, values: Array, axis: int = 0) -> Array:
    """Return values at the nodes and half-way between them, shape (..., 2 n - 1, ...) for n nodes on an axis.

    The values between the nodes are from the piecewise cubic of H. Akima, J. ACM 17 (1970) 589,
    doi:10.1145/321607.321609, with the modified weights that
    ``scipy.interpolate.Akima1DInterpolator`` calls "makima". There are at least three nodes, which increase.

    Examples
    --------
    >>> with_middles(np.arange(4.0), np.array([0.0, 0.0, 1.0, 1.0])).tolist()
    [0.0, -0.109375, 0.0, 0.5, 1.0, 1.109375, 1.0]
    """
    known = np.moveaxis(values, axis, -1)
    step = np.diff(nodes)
    chord = np.diff(known) / step
    # Two more chords at each end, on a straight line with the two chords there.
    for _ in range(2):
        first, last = 2.0 * chord[..., :1] - chord[..., 1:2], 2.0 * chord[..., -1:] - chord[..., -2:-1]
        chord = np.concatenate([first, chord, last], axis=-1)
    weight = np.abs(np.diff(chord)) + 0.5 * np.abs(chord[..., 1:] + chord[..., :-1])
    before, after = weight[..., 2:], weight[..., :-2]
    total = before + after
    mean = before * chord[..., 1:-2] + after * chord[..., 2:-1]
    slope = np.divide(mean, total, out=np.zeros_like(mean), where=total > 0.0)
    fine = np.empty((*known.shape[:-1], 2 * nodes.size - 1))
    fine[..., ::2] = known
    fine[..., 1::2] = 0.5 * (known[..., 1:] + known[..., :-1]) + 0.125 * step * -np.diff(slope)
    return np.moveaxis(fine, -1, axis)
