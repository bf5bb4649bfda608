"""Doubts about the samples of waveforms: clipped or coarse ones, edges of few samples, repeated records."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.drive.waveform.waveform import Waveform
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable

# Fewest different voltages of a waveform that is not called coarse: an eighth of the range of eight bits.
# Short records have few of them anyhow.
_LEVELS, _LONG = 32, 256

# A flat top or bottom is clipped if its longest run has at least _RUN samples and _RUNS times as many as the
# longest run at any other voltage, and if _FLAT times as many samples lie on it as within _BAND of the range
# next to it. Of a smooth top, which is a parabola, the last level has 2.4 times as many as the one before.
_RUN, _RUNS, _FLAT, _BAND = 6, 4, 6.0, 0.005

# Least share of samples between the extremes by which flat extremes differ from a computed square wave.
_QUALITY_BETWEEN = 0.05

# An edge has at least this share of the range as its height, and is resolved by this many samples. Without
# them, one of its steps is at least a quarter of its height. The range omits this share of samples at each
# end, and steps of noise are below this many medians of all steps.
_EDGE, _RESOLVED = 0.2, 3
_STEP, _OUTLIERS, _NOISE = 0.25, 1e-3, 6.0

# Samples to each side of an edge within which it comes and goes, and most edges that are looked at.
_AROUND, _MOST_REPEATED = 4, 100_000

# Least jump from the end of a repeated record to its start that is reported, as a part of its range, and
# least time beyond the record, as a part of it, for which it is reported at all.
_SEAM, _BEYOND = 0.05, 1e-3


def quality_warnings(source: str, waveform: Waveform) -> Iterator[ResultWarning]:
    """Warnings about clipped, coarse and badly resolved waveforms, each at most once."""
    values = waveform.values
    clipped = [
        f"{count} samples at exactly {readable(level, 6)} V"
        for level, count in clipped_levels(values).items()
    ]
    if clipped:
        yield ResultWarning.of("waveform-clipped", file=source, plateaus=" and ".join(clipped))
    levels = few_levels(values)
    if levels is not None:
        yield ResultWarning.of("waveform-coarse", file=source, levels=levels, span=np.ptp(values))
    yield from edge_warnings(source, waveform)


def edge_warnings(source: str, waveform: Waveform) -> Iterator[ResultWarning]:
    """Warning "edges-unresolved" about steep edges with too few samples."""
    unresolved, edges = unresolved_edges(waveform.values)
    if unresolved:
        yield ResultWarning.of(
            "edges-unresolved",
            file=source,
            edges=edges,
            unresolved=unresolved,
            samples=_RESOLVED,
            interval=waveform.step,
        )


def repeat_warnings(source: str, waveform: Waveform, duration: float | None) -> Iterator[ResultWarning]:
    """Warning "record-repeated" about a record that is repeated, and does not end where it begins.

    The ``duration`` is the time that is simulated [s]; None stands for the time of the record.
    """
    if duration is None or duration <= (1.0 + _BEYOND) * waveform.duration:
        return
    jump = float(waveform.values[0] - waveform.values[-1])
    if abs(jump) > _SEAM * float(np.ptp(waveform.values)):
        yield ResultWarning.of(
            "record-repeated", file=source, record=waveform.duration, duration=duration, jump=jump
        )


def clipped_levels(values: Array) -> dict[float, int]:
    """Extremes at which a waveform is probably clipped, with the numbers of samples on them.

    A plateau with noise touches its extremes in short runs only. A waveform without any noise that consists
    of its two extremes and a few samples between them is taken for a computed square wave, not for a clipped
    one. ``values`` are voltages [V], shape (n,), not all equal. Returns the number of samples at each clipped
    voltage [V]; empty where nothing is clipped.

    Examples
    --------
    >>> wave = np.sin(np.linspace(0.0, 20.0, 1000)) + np.random.default_rng(1).normal(0.0, 0.01, 1000)
    >>> clipped_levels(wave), list(clipped_levels(np.minimum(wave, 0.8)))
    ({}, [0.8])
    """
    low, high = float(np.min(values)), float(np.max(values))
    extremes = {level: values == level for level in (low, high)}
    between = ~(extremes[low] | extremes[high])
    if np.count_nonzero(between) < _QUALITY_BETWEEN * values.size:
        return {}
    same = np.concatenate([values[1:] == values[:-1], [False]])
    elsewhere = longest_run(same & between) + 1
    clipped = {}
    for level, on in extremes.items():
        if longest_run(on) >= max(_RUN, _RUNS * elsewhere):
            distances = np.abs(values[between] - level)
            # At least the nearest of the other levels, where levels are coarser than the band.
            near = np.count_nonzero(distances <= max(_BAND * (high - low), float(np.min(distances))))
            count = int(np.count_nonzero(on))
            if count > _FLAT * near:
                clipped[level] = count
    return clipped


def longest_run(on: Mask) -> int:
    """Length of the longest run of consecutive true entries.

    Examples
    --------
    >>> longest_run(np.array([True, True, False, True]))
    2
    """
    changes = np.flatnonzero(np.diff(on.astype(np.int8), prepend=0, append=0))
    return int(np.max(changes[1::2] - changes[::2], initial=0))


def few_levels(values: Array) -> int | None:
    """Number of different voltages if it is below 32; None for finer and for short waveforms."""
    if values.size < _LONG:
        return None
    known: Array = np.empty(0)
    for begin in range(0, values.size, 1 << 16):
        known = np.union1d(known, values[begin : begin + (1 << 16)])
        if known.size >= _LEVELS:
            return None
    return int(known.size)


def unresolved_edges(values: Array) -> tuple[int, int]:
    """Number of steep edges with fewer than three samples between 10 and 90 % of their height, and of all.

    A steep edge moves by a fifth of the range or more, and by a quarter of this between two samples; slower
    ones are resolved. The range omits 0.1 % of the samples at each end, as a few peaks may be much higher. Of
    more than 100 000 edges, the first ones count. The voltages have the shape (n,).

    Examples
    --------
    >>> steps = np.repeat([0.0, 1.0, 0.0], 20)
    >>> unresolved_edges(steps)
    (2, 2)
    >>> unresolved_edges(np.interp(np.arange(60.0), [20.0, 26.0], [0.0, 1.0]))
    (0, 1)
    """
    steps = np.diff(values)
    np.abs(steps, out=steps)
    low, high = np.quantile(values, [_OUTLIERS, 1.0 - _OUTLIERS])
    least = _EDGE * float(high - low)
    steep = np.flatnonzero(
        steps >= max(_STEP * least, _NOISE * float(np.median(steps)), np.finfo(float).tiny)
    )
    edges = _largest_of_groups(steep, steps)[:_MOST_REPEATED]
    if not edges.size:
        return 0, 0
    offsets = np.arange(-_AROUND, _AROUND + 2)
    around = values[np.clip(edges[:, np.newaxis] + offsets, 0, values.size - 1)]
    before, after = around[:, :1], around[:, -1:]
    height = after - before
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (around - before) / height
    inside = np.count_nonzero((share > 0.1) & (share < 0.9), axis=1)
    # A spike that comes back within the window has no height of its own: nothing resolves it.
    none = np.abs(height[:, 0]) < 0.5 * steps[edges]
    high_enough = np.maximum(np.abs(height[:, 0]), steps[edges]) >= least
    unresolved = ((inside < _RESOLVED) | none) & high_enough
    return int(np.count_nonzero(unresolved)), int(np.count_nonzero(high_enough))


def _largest_of_groups(places: IntArray, steps: Array) -> IntArray:
    """Place of the largest step of each group of places that are at most an edge's width apart."""
    if not places.size:
        return places
    group = np.concatenate([[0], np.cumsum(np.diff(places) > _AROUND)])
    order = np.lexsort((-steps[places], group))
    return places[order[np.searchsorted(group, np.unique(group))]]
