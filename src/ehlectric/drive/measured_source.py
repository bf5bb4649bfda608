"""Measured source of a drive: waveform of an oscilloscope, its resampling, and its warnings."""

from __future__ import annotations

from functools import cache, lru_cache
from pathlib import Path

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray
from ehlectric.cases.drive_inputs import Source
from ehlectric.drive.waveform.sample_quality import edge_warnings, repeat_warnings
from ehlectric.drive.waveform.waveform import Edge, Waveform
from ehlectric.drive.waveform.waveform_file import read_waveform
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import ResultWarning

# Low-pass filter: up to _PASS of the new sampling rate voltages keep their amplitude, above the half of it
# they are suppressed. With the attenuation [dB], the width of this transition gives the half length of the
# filter after Kaiser, in new steps.
_PASS, _STOP, _ATTENUATION = 0.4, 0.5, 85.0
HALF = int(np.ceil((_ATTENUATION - 8.0) / (2.285 * 2.0 * np.pi * (_STOP - _PASS)) / 2.0))

# Values of the filter in a new step. Linear interpolation between them has an error of 2e-7 of the largest.
_TABLE = 2048

# Largest number of products that are held at once: it bounds the memory [numbers].
_AT_ONCE = 4_000_000

# Relative difference below which two steps are equal, and distances are whole numbers of steps.
_SAME_STEP = 1e-9


def resample(waveform: Waveform, step: float) -> Waveform:
    """Waveform at a larger sampling interval, after a low-pass filter without delay.

    ``step``, new sampling interval [s], at least the interval of the waveform. Returns samples at ``start``,
    ``start + step`` and so on up to the last time of the waveform. Raises InputError if the new interval is
    smaller, or leaves fewer than two samples.

    The filter is a sinc function with a Kaiser window, evaluated at the distances between new and old samples
    (J. F. Kaiser, Proc. IEEE ISCAS 1974, 20-23). Up to 0.4 of the new sampling rate, amplitudes change by
    less than 0.1 %; from half of it on, they are 1/1000 or less. It is symmetric and shifts no phase. Its
    weights are divided by their sum, so that a constant does not change. Beyond both ends the waveform is
    mirrored at its first and last sample, which keeps the mean; the ends within 27 new steps are less
    accurate. A voltage that jumps overshoots by about 9 % of the jump, at most 11 % (Gibbs).

    Examples
    --------
    >>> wave = Waveform(0.0, 1e-6, np.sin(2.0 * np.pi * 50.0 * 1e-6 * np.arange(100_001)))
    >>> coarse = resample(wave, 1e-3)
    >>> coarse.values.size, round(float(coarse.values[45]), 3)
    (101, 1.0)
    """
    ratio = step / waveform.step
    if not 1.0 - _SAME_STEP <= ratio < np.inf:
        raise InputError("step", got=f"{step:g} s", takes=f"{waveform.step:g} s or more, as the waveform has")
    if ratio <= 1.0 + _SAME_STEP:
        return waveform
    count = int((waveform.values.size - 1) / ratio + _SAME_STEP * waveform.values.size) + 1
    if count < 2:
        raise InputError(
            "step", got=f"{step:g} s", takes=f"at most {waveform.duration:g} s, the whole waveform"
        )
    reach = int(np.ceil(HALF * ratio))
    values = np.empty(count)
    # As many new samples at once as the bound on products allows, at least one.
    many = max(1, _AT_ONCE // (2 * reach + 1))
    for begin in range(0, count, many):
        places = ratio * np.arange(begin, min(begin + many, count), dtype=np.float64)
        values[begin : begin + many] = _filtered(waveform.values, places, ratio, reach)
    return Waveform(waveform.start, step, values)


def _filtered(values: Array, places: Array, ratio: float, reach: int) -> Array:
    """Filtered values at places between the samples, in old steps."""
    centres = np.rint(places).astype(np.intp)
    offsets = np.arange(-reach, reach + 1)
    at = _mirrored(np.arange(centres[0] - reach, centres[-1] + reach + 1), values.size)
    nearby = values[at]
    windows = np.lib.stride_tricks.sliding_window_view(nearby, offsets.size)[centres - centres[0]]
    # New samples at equal positions between old ones have equal filters.
    shares, which = np.unique(np.round(places - centres, 7), return_inverse=True)
    weights = _filter(np.abs(offsets - shares[:, np.newaxis]) / ratio)
    weights /= np.sum(weights, axis=1, keepdims=True)
    if shares.size == 1:
        return np.asarray(windows @ weights[0])
    return np.asarray(np.einsum("ij,ij->i", windows, weights[which]))


def _mirrored(places: IntArray, size: int) -> IntArray:
    """Places of samples within a record that is mirrored at its first and last sample, again and again."""
    period = 2 * (size - 1)
    folded = places % period
    return np.minimum(folded, period - folded)


def _filter(distances: Array) -> Array:
    """Weights of samples by their distance from a new sample [new steps]."""
    table = _table()
    at = np.minimum(distances * _TABLE, table.size - 2.0)
    below = at.astype(np.intp)
    share = at - below
    return np.asarray(table[below] * (1.0 - share) + table[below + 1] * share)


@cache
def _table() -> Array:
    """Weights at 0, 1/2048, ... of a new step up to the end of the filter, and a zero behind it."""
    # Both take a while to import.

    distances = np.arange(HALF * _TABLE + 1) / _TABLE
    beta = scipy.signal.kaiser_beta(_ATTENUATION)
    window = scipy.special.i0(beta * np.sqrt(1.0 - (distances / HALF) ** 2)) / scipy.special.i0(beta)
    cutoff = _PASS + _STOP
    return np.append(cutoff * np.sinc(cutoff * distances) * window, [0.0, 0.0])


def measured_waveform(
    source: Source, duration: float | None
) -> tuple[Waveform | None, tuple[ResultWarning, ...]]:
    """Measured waveform and the warnings about its file; None for a described source. ``duration``, time that
    is simulated [s]; None for the time of the record. Raises InputError if the file cannot be read or
    resampled; its key begins with ``source``.
    """
    if source.file is None:
        return None, ()
    try:
        waveform, warnings = read_waveform(
            source.file,
            column=source.column,
            time_column=source.time_column,
            step=source.step,
            time_unit=source.time_unit,
            value_unit=source.value_unit,
            scale=source.scale,
            resample=source.resample,
        )
    except InputError as error:
        if error.key == str(Path(source.file)):
            raise error.with_text("source.file", f"{error.key} {error.text}") from None
        raise error.under("source") from None
    if source.resample is not None:
        waveform, warnings = _resampled(waveform, warnings, source.file, source.resample)
    return waveform, (*warnings, *repeat_warnings(source.file, waveform, duration))


def measured_edge(source: Source) -> tuple[Edge | None, tuple[ResultWarning, ...]]:
    """Largest edge of a measured waveform, and the warnings about its file; None for a described source.

    Raises the errors of ``measured_waveform``.
    """
    if source.file is None:
        return None, ()
    try:
        changed = Path(source.file).stat().st_mtime_ns
    except OSError:
        changed = 0
    edge, warnings = _edge_of(source.model_copy(update={"scale": 1.0}), changed)
    return edge._replace(voltage=abs(source.scale) * edge.voltage), warnings


# Files whose largest edge is remembered.
_FILES = 16


@lru_cache(maxsize=_FILES)
def _edge_of(source: Source, changed: int) -> tuple[Edge, tuple[ResultWarning, ...]]:  # noqa: ARG001
    """Largest edge of the file of a source, which was ``changed`` at a time."""
    waveform, warnings = measured_waveform(source, None)
    assert waveform is not None
    return waveform.largest_edge, warnings


def _resampled(
    waveform: Waveform, warnings: tuple[ResultWarning, ...], file: str, step: float
) -> tuple[Waveform, tuple[ResultWarning, ...]]:
    """Waveform at a coarser step, and the warnings about its samples: its own edges are judged."""
    try:
        coarse = resample(waveform, step)
    except InputError as error:
        raise error.with_text("source.resample", error.text) from None
    others = (warning for warning in warnings if warning.code != "edges-unresolved")
    return coarse, (*others, *edge_warnings(file, coarse))
