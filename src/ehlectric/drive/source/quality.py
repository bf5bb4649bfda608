"""Doubts about a measured waveform: clipped, coarse in voltage, too few samples on an edge, or repeated."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.drive.source.waveform import Waveform
from ehlectric.errors import ResultWarning

# Fewest different voltages of a waveform that is not called coarse: an eighth of the range of eight bits.
# Short records have few of them anyhow.
_LEVELS, _LONG = 32, 256

# A flat top or bottom is clipped if its longest run has at least _RUN samples and _RUNS times as many as the
# longest run at any other voltage, and if _FLAT times as many samples lie on it as within _BAND of the range
# next to it. Of a smooth top, which is a parabola, the last level has 2.4 times as many as the one before.
_RUN, _RUNS, _FLAT, _BAND = 6, 4, 6.0, 0.005

# Least share of samples between the extremes by which flat extremes can be told from a computed square wave.
_BETWEEN = 0.05

# An edge moves by at least this share of the range between two samples; it is resolved by this many samples.
_EDGE, _RESOLVED = 0.2, 3

# Samples to each side of an edge within which it comes and goes, and most edges that are looked at.
_AROUND, _MOST = 4, 100_000

# Least jump from the end of a repeated record to its start that is told, as a part of its range, and least
# time beyond the record, as a part of it, for which it is told at all.
_SEAM, _BEYOND = 0.05, 1e-3


def quality_warnings(source: str, waveform: Waveform) -> Iterator[ResultWarning]:
    """Warnings about clipped, coarse and badly resolved waveforms.

    Parameters
    ----------
    source : str
        Name of the file, for the texts.
    waveform : Waveform
        Samples that are not constant.

    Yields
    ------
    ResultWarning
        "waveform-clipped", "waveform-coarse" and "edges-unresolved", each at most once.
    """
    values = waveform.values
    clipped = [f"{count} samples at exactly {level:.6g} V" for level, count in clipped_levels(values).items()]
    if clipped:
        yield ResultWarning(
            "waveform-clipped",
            f"{source} has {' and '.join(clipped)}, its extremes: the range of the oscilloscope was probably "
            "exceeded; measure with a larger range",
        )
    levels = few_levels(values)
    if levels is not None:
        yield ResultWarning(
            "waveform-coarse",
            f"{source} has only {levels} different voltages in {np.ptp(values):.4g} V: measure with a "
            "smaller range, or with more bits",
        )
    yield from edge_warnings(source, waveform)


def edge_warnings(source: str, waveform: Waveform) -> Iterator[ResultWarning]:
    """Warning "edges-unresolved" about steep edges with too few samples.

    Parameters
    ----------
    source : str
        Name of the file, for the text.
    waveform : Waveform
        Samples that are not constant.
    """
    unresolved, edges = unresolved_edges(waveform.values)
    if unresolved:
        yield ResultWarning(
            "edges-unresolved",
            f"{source}: of {edges} steep edges, {unresolved} have fewer than {_RESOLVED} samples between 10 "
            f"and 90 % of their height at a sampling interval of {waveform.step:.3g} s: rise times and peaks "
            "are not resolved; measure or resample with a higher sampling rate",
        )


def repeat_warnings(source: str, waveform: Waveform, duration: float | None) -> Iterator[ResultWarning]:
    """Warning "record-repeated" about a record that is repeated, and does not end where it begins.

    Parameters
    ----------
    source : str
        Name of the file, for the text.
    waveform : Waveform
        Samples that are not constant.
    duration : float or None
        Time that is simulated [s]; None for that of the record.
    """
    if duration is None or duration <= (1.0 + _BEYOND) * waveform.duration:
        return
    jump = float(waveform.values[0] - waveform.values[-1])
    if abs(jump) > _SEAM * float(np.ptp(waveform.values)):
        yield ResultWarning(
            "record-repeated",
            f"{source} lasts {waveform.duration:.4g} s and is repeated up to {duration:.4g} s; from its end "
            f"to its start the voltage jumps by {jump:.4g} V, an edge that the inverter does not have: cut "
            "the record to whole periods, or leave drive.duration out",
        )


def clipped_levels(values: Array) -> dict[float, int]:
    """Extremes at which a waveform is probably clipped, with the numbers of samples on them.

    A plateau with noise touches its extremes in short runs only. A waveform without any noise that consists
    of its two extremes and a few samples between them is taken for a computed square wave, not for a clipped
    one.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Voltages, not constant.

    Returns
    -------
    dict of float to int
        Number of samples by voltage; empty for a waveform that is not clipped.

    Examples
    --------
    >>> wave = np.sin(np.linspace(0.0, 20.0, 1000)) + np.random.default_rng(1).normal(0.0, 0.01, 1000)
    >>> clipped_levels(wave), list(clipped_levels(np.minimum(wave, 0.8)))
    ({}, [0.8])
    """
    low, high = float(np.min(values)), float(np.max(values))
    band = _BAND * (high - low)
    extremes = {level: values == level for level in (low, high)}
    between = ~(extremes[low] | extremes[high])
    if np.count_nonzero(between) < _BETWEEN * values.size:
        return {}
    same = np.concatenate([values[1:] == values[:-1], [False]])
    elsewhere = longest_run(same & between) + 1
    found = {}
    for level, on in extremes.items():
        count = int(np.count_nonzero(on))
        longest = longest_run(on)
        if longest < max(_RUN, _RUNS * elsewhere):
            continue
        beside = values[between]
        distances = np.abs(beside - level)
        # At least the nearest of the other levels, where levels are coarser than the band.
        near = np.count_nonzero(distances <= max(band, float(np.min(distances))))
        if count > _FLAT * near:
            found[level] = count
    return found


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

    Parameters
    ----------
    values : ndarray, shape (n,)
        Voltages.

    Returns
    -------
    unresolved, edges : int
        Edges that move by a fifth of the range or more between two samples; slower ones are resolved. Of more
        than 100 000 edges, the first ones count.

    Examples
    --------
    >>> steps = np.repeat([0.0, 1.0, 0.0], 20)
    >>> unresolved_edges(steps)
    (2, 2)
    >>> unresolved_edges(np.interp(np.arange(60.0), [20.0, 26.0], [0.0, 1.0]))
    (0, 0)
    """
    steps = np.diff(values)
    np.abs(steps, out=steps)
    steep = np.flatnonzero(steps >= _EDGE * np.ptp(values))
    edges = _largest_of_groups(steep, steps)[:_MOST]
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
    return int(np.count_nonzero((inside < _RESOLVED) | none)), int(edges.size)


def _largest_of_groups(places: IntArray, steps: Array) -> IntArray:
    """Place of the largest step of each group of places that are at most an edge's width apart."""
    if not places.size:
        return places
    begins = np.concatenate([[0], np.flatnonzero(np.diff(places) > _AROUND) + 1])
    largest = np.maximum.reduceat(steps[places], begins)
    group = np.repeat(np.arange(begins.size), np.diff(np.append(begins, places.size)))
    hits = np.flatnonzero(steps[places] == largest[group])
    _, first = np.unique(group[hits], return_index=True)
    return places[hits[first]]
