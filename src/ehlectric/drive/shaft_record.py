"""Record of a shaft voltage: its peak and its rms, and the discharges at which it collapses."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.measured_inputs import ShaftFile
from ehlectric.drive.drive_record import event_rate
from ehlectric.drive.waveform.waveform import Waveform
from ehlectric.drive.waveform.waveform_file import read_waveform
from ehlectric.errors import InputError
from ehlectric.quantities.formats import amount
from ehlectric.quantities.result_warnings import ResultWarning

# A collapse removes at least this part of the voltage, within the time [s] or within two samples. It is
# faster than the edges of the record by this factor.
_PART, _WITHIN, _SHORTEST, _FASTER = 0.5, 50e-9, 2, 1.5

# Least voltage before a collapse: in standard deviations of the noise, and as a part of the largest voltage.
_NOISE, _LEAST = 6.0, 0.1

# Part of the largest voltage above which the least visible collapse means that the samples are too slow.
_HIDDEN = 0.5

# Edges from which a ratio is estimated: least change of the common-mode voltage and of the shaft voltage, as
# parts of large changes; least share of these edges with one ratio; this share of all edges if the edges are
# not resolved: their change in two samples is a large part of their change in eight samples.
_HIGH, _MOVED, _AGREE = 0.5, 0.3, 0.2
_AGREE_UNRESOLVED, _LARGE_PART, _EIGHT = 0.8, 0.6, 8

# Least change of the shaft voltage by an edge, in standard deviations of the noise of a change.
_RESOLVED = 10.0

# Quantiles of the ratios: one whose distance is the error by arcs, and one that may be larger by this factor.
_UPPER, _SPREAD = (0.75, 0.9), 1.2

# Change of an edge in standard deviations of the noise that gives a clear ratio, and least growth of the
# change in twice the time.
_CLEAR, _GROWS = 30.0, 1.5

# Quantile of the steps of edges that a collapse has to exceed.
_STEEP = 0.9

# Equal blocks of time whose scatter widens the uncertainties of rms and rate.
_BLOCKS = 10

# Probability of the quantile of breakdown voltages: the scale of a Weibull distribution, 1 - 1/e. Fewest
# discharges from which it is estimated.
_SCALE, _FEW = 1.0 - math.exp(-1.0), 10

# Two-sided 95 % of a normal distribution, in standard deviations, and factor from the median absolute
# deviation to the standard deviation.
_NORMAL, _ROBUST = 1.96, 1.4826

# Samples of the moving median that removes noise from the peak.
_MEDIAN = 5


# Quantities of the table [measured] that a record may give.
RECORDED = (
    "shaft_voltage_rms",
    "bearing_voltage_ratio",
    "shaft_voltage",
    "discharge_rate",
    "first_breakdown_voltage",
)


@dataclass(frozen=True)
class Estimate:
    """Value and its standard uncertainty, SI units."""

    value: float
    uncertainty: float


@dataclass(frozen=True, eq=False)
class ShaftRecord:
    """Quantities of a record of the shaft voltage; None where the record does not determine one."""

    step: float  # sampling interval [s]
    duration: float  # [s]
    noise: float  # standard deviation of the noise and of the resolution [V]
    threshold: float  # least voltage before a collapse that is counted [V]
    slow: bool  # whether the samples are too slow to distinguish collapses from edges
    times: Array  # times of the collapses from the first sample [s], shape (m,)
    voltages: Array  # absolute voltages before the collapses [V], shape (m,)
    rms: Estimate
    ratio: Estimate | None  # shaft voltage divided by the common-mode voltage
    peak: Estimate | None  # peak without discharges [V]
    rate: Estimate | None  # discharges in a second [1/s]
    breakdown: Estimate | None  # 63.2 % quantile of the voltages before collapses [V]
    inverted: bool = False  # whether a probe is connected the wrong way round, by the edges

    def measured(self) -> dict[str, Estimate]:
        """Return the quantities that a calibration compares, by their names in the table [measured].

        The peak is omitted if the ratio is known: both follow from one number.
        """
        peak = self.peak if self.ratio is None else None
        estimates = (self.rms, self.ratio, peak, self.rate, self.breakdown)
        known = zip(RECORDED, estimates, strict=True)
        return {name: estimate for name, estimate in known if estimate is not None}


def shaft_record(
    shaft: Array,
    step: float,
    common_mode: Array | None = None,
    *,
    threshold: float | None = None,
    gain: float = 0.0,
) -> ShaftRecord:
    """Quantities of a record of the shaft voltage against the frame.

    A discharge is a collapse of the voltage: within 50 ns, or two samples if these take longer, the absolute
    voltage U falls to less than half of its value before. Edges of the inverter also reduce the voltage. A
    collapse therefore has to be 1.5 times as large as the growth of U in this time by the steep edges of the
    record, the 90 % quantile of all edges. If the common-mode voltage u is given, the change a du that it
    explains is subtracted first, with the ratio a = dU/du of most edges. If more edges share a negative ratio
    than a positive one, a probe is inverted: the shaft voltage is turned.

    With N collapses in the time T, the rate is N/T. Its standard uncertainty is the half-width of the 95 %
    interval of ``event_rate`` (Poisson, or the scatter of ten blocks) divided by 1.96. The voltage of the
    breakdown is the quantile p = 63.2 % of the voltages before collapses, the scale of a Weibull law. Its
    statistical uncertainty is half of the distance between the order statistics N p +- sqrt(N p (1 - p)).
    It contains no voltage above the largest one of the record.

    Parameters
    ----------
    shaft : ndarray, shape (n,)
        Shaft voltage at equal steps of time [V].
    step : float
        Sampling interval [s].
    common_mode : ndarray, shape (n,), optional
        Common-mode voltage at the same times [V].
    threshold : float, optional
        Least voltage before a collapse that counts [V]. The default is the larger of six standard deviations
        of the noise and a tenth of the largest voltage.
    gain : float
        Relative standard uncertainty of the probe and the oscilloscope, dimensionless.

    Returns
    -------
    ShaftRecord
        Quantities with their standard uncertainties.

    Raises
    ------
    InputError
        If the common-mode voltage has another number of samples or is constant.

    Examples
    --------
    A sine of 10 V that collapses at three times, and increases from 0 V after each:

    >>> time = 1e-7 * np.arange(20_000)
    >>> sine = 10.0 * np.sin(2.0 * np.pi * 1e3 * time)
    >>> reset = np.zeros_like(time)
    >>> for place in (2500, 7500, 12_500):
    ...     reset[place:] = sine[place]
    >>> record = shaft_record(sine - reset, 1e-7)
    >>> record.voltages.round(3).tolist(), round(record.rate.value)
    ([10.0, 20.0, 20.0], 1500)
    """
    noise = _noise(shaft)
    largest = float(np.max(np.abs(shaft)))
    ratio, explained, doubt, inverted = None, np.zeros_like(shaft), noise, False
    if common_mode is not None:
        noise_of_source = _noise(common_mode)
        turned = _ratio(-shaft, common_mode, noise, noise_of_source)
        direct = _ratio(shaft, common_mode, noise, noise_of_source)
        inverted = turned is not None and (direct is None or turned[1] > direct[1])
        shaft = -shaft if inverted else shaft
        known = turned if inverted else direct
        if known is not None:
            ratio, _ = known
            explained = ratio.value * common_mode
            # The change that the source explains has the noise of two samples.
            doubt = math.hypot(noise, math.sqrt(2.0) * ratio.value * noise_of_source)
    least = max(_NOISE * doubt, _LEAST * largest) if threshold is None else threshold
    widths = _widths(step)
    if ratio is None:
        least = max(least, _FASTER * _edge(shaft, widths[-1], least))
    slow = least > _HIDDEN * largest
    places, voltages, error = np.empty(0, dtype=np.intp), np.empty(0), 0.0
    if not slow:
        places = _collapses(shaft, explained, widths, least, given=ratio is not None)
        voltages, error = _before(shaft, explained, places)
    duration = step * shaft.size
    statistics = _Statistics(noise, gain)
    return ShaftRecord(
        step=step,
        duration=duration,
        noise=noise,
        threshold=least,
        slow=slow,
        times=step * places.astype(np.float64),
        voltages=voltages,
        rms=statistics.rms(shaft),
        ratio=None if ratio is None else statistics.with_gain(ratio.value, ratio.uncertainty, channels=2),
        peak=_peak(shaft, common_mode, ratio, statistics, undisturbed=not slow and not places.size),
        rate=None if slow else _rate(places, shaft.size, duration),
        breakdown=None if slow else statistics.breakdown(voltages, error),
        inverted=inverted,
    )


@dataclass(frozen=True)
class _Statistics:
    """Uncertainties of a record by its noise [V] and by the gain of its channel, dimensionless."""

    noise: float
    gain: float

    def with_gain(self, value: float, error: float, channels: int = 1) -> Estimate:
        """Value with an error, and with the error of the gains of independent channels."""
        return Estimate(value, math.hypot(error, math.sqrt(channels) * self.gain * value))

    def rms(self, shaft: Array) -> Estimate:
        """Root mean square: scatter of ten blocks, and the part by which noise increases it."""
        squares = [float(np.mean(block**2)) for block in np.array_split(shaft, _BLOCKS)]
        value = math.sqrt(float(np.mean(squares)))
        scatter = float(np.std(squares, ddof=1)) / math.sqrt(_BLOCKS) / (2.0 * value)
        excess = value - math.sqrt(max(value**2 - self.noise**2, 0.0))
        return self.with_gain(value, math.hypot(scatter, excess))

    def breakdown(self, voltages: Array, common: float) -> Estimate | None:
        """Quantile of the voltages before collapses, which have a ``common`` error [V]; None for a few."""
        count = voltages.size
        if count < _FEW:
            return None
        ordered = np.sort(voltages)
        half = math.sqrt(_SCALE * (1.0 - _SCALE) / count)
        low, value, high = np.quantile(ordered, [max(_SCALE - half, 0.0), _SCALE, min(_SCALE + half, 1.0)])
        error = math.hypot(0.5 * float(high - low), self.noise, common)
        return self.with_gain(float(value), error)


def _noise(values: Array) -> float:
    """Standard deviation of noise and resolution [V]: the larger one of two estimates.

    Second differences of white noise have six times its variance. Equal steps q of a converter have the
    standard deviation q/sqrt(12).
    """
    second = np.abs(np.diff(values, n=2))
    levels = np.unique(values[:: max(1, values.size // 200_000)])
    quantum = float(np.min(np.diff(levels))) if levels.size > 1 else 0.0
    return max(_ROBUST * float(np.median(second)) / math.sqrt(6.0), quantum / math.sqrt(12.0))


def _widths(step: float) -> tuple[int, ...]:
    """Numbers of samples in which a collapse may happen: powers of 2 up to 50 ns, at least two samples."""
    most = max(_SHORTEST, int(_WITHIN / step))
    return tuple(2**power for power in range(1, most.bit_length()) if 2**power <= most)


def _edge(values: Array, width: int, least: float) -> float:
    """Growth of the absolute voltage in some samples by steep edges [V]; the largest growth of slow ones."""
    change = np.abs(values[width:] - values[:-width])
    change[np.abs(values[width:]) <= np.abs(values[:-width])] = 0.0
    steep = np.flatnonzero(change >= least)
    if not steep.size:
        return float(np.max(change, initial=0.0))
    tops = [float(np.max(change[group])) for group in _groups(steep, width)]
    return float(np.quantile(tops, _STEEP))


def _groups(places: IntArray, distance: int) -> list[IntArray]:
    """Groups of increasing places that are at most a distance apart."""
    return np.split(places, np.flatnonzero(np.diff(places) > distance) + 1) if places.size else []


def _ratio(
    shaft: Array, common_mode: Array, noise: float, noise_of_source: float
) -> tuple[Estimate, int] | None:
    """Change of the shaft voltage divided by the change of the common-mode voltage, at most edges, and how
    many samples share this positive ratio. None if edges have no ratio in common, as where all films break
    down within a sample.

    While an arc burns, the shaft voltage does not follow an edge: only changes that are large count. The
    half-sample mode is robust against edges with a collapse (D. R. Bickel and R. Fruehwirth, Comput. Stat.
    Data Anal. 50 (2006) 3500, doi:10.1016/j.csda.2005.07.011).
    """
    if common_mode.shape != shaft.shape:
        what = f"{common_mode.size} samples"
        raise InputError("common_mode", got=what, takes=f"{shaft.size} samples, as the shaft voltage has")
    width = _width_of_edges(common_mode, noise_of_source)
    rise, moved = (values[width:] - values[:-width] for values in (common_mode, shaft))
    largest = float(np.max(np.abs(rise), initial=0.0))
    if largest == 0.0:
        raise InputError("common_mode", got="a constant voltage", takes="the voltage of an inverter")
    edges = np.abs(rise) >= _HIGH * largest
    all_edges = int(np.count_nonzero(edges))
    strong = _MOVED * float(np.quantile(np.abs(moved[edges]), 0.95))
    # A collapse goes against the edge at which the film broke down.
    edges &= moved * np.sign(rise) >= max(strong, _NOISE * noise)
    if not np.any(edges):
        return None
    ratios = moved[edges] / rise[edges]
    mode = _half_sample_mode(np.sort(ratios))
    doubt = math.hypot(noise, mode * noise_of_source)
    near = np.abs(ratios - mode) <= max(3.0 * math.sqrt(2.0) * doubt / (_HIGH * largest), 0.02 * abs(mode))
    size = np.abs(rise[edges][near])
    value = float(np.sum(ratios[near] * size) / np.sum(size))
    changes = (_largest_change(common_mode, each) for each in (_SHORTEST, _EIGHT))
    resolved = next(changes) < _LARGE_PART * next(changes)
    least = _AGREE * ratios.size if resolved else _AGREE_UNRESOLVED * all_edges
    # Arcs within the difference reduce a ratio, so that an undisturbed one is among the largest.
    upper, highest = np.quantile(ratios, _UPPER).tolist()
    if size.size < least or not highest <= _SPREAD * value:
        return None
    if value * float(np.median(size)) < _RESOLVED * math.sqrt(2.0) * noise:
        # Of changes within the noise, only those that it enlarges are above the least one.
        return None
    scatter = _ROBUST * float(np.median(np.abs(ratios[near] - value))) * math.sqrt(0.5 * math.pi / size.size)
    return Estimate(value, math.hypot(scatter, max(upper - value, 0.0))), int(size.size)


def _width_of_edges(common_mode: Array, noise: float) -> int:
    """Number of samples in which edges change by much more than the noise, but not as a whole."""
    width, least = _SHORTEST, _CLEAR * noise
    while 4 * width < common_mode.size:
        now, then = (_largest_change(common_mode, each) for each in (width, 2 * width))
        if now >= least or then < _GROWS * now:
            break
        width *= 2
    return width


def _largest_change(values: Array, width: int) -> float:
    """Largest absolute change in some samples [V]."""
    return float(np.max(np.abs(values[width:] - values[:-width]), initial=0.0))


def _half_sample_mode(values: Array) -> float:
    """Mode of increasing values: the densest half of the densest half, and so on."""
    while values.size > 2:
        half = (values.size + 1) // 2
        begin = int(np.argmin(values[half - 1 :] - values[: values.size - half + 1]))
        values = values[begin : begin + half]
    return float(np.mean(values))


def _collapses(
    shaft: Array, explained: Array, widths: tuple[int, ...], least: float, *, given: bool
) -> IntArray:
    """Last samples before collapses. ``explained``, voltage by the source; ``given``, whether it is known."""
    falls: Mask = np.zeros(shaft.size, dtype=bool)
    for width in widths:
        first, last = shaft[:-width], shaft[width:]
        expected = first + explained[width:] - explained[:-width]
        size = np.abs(expected)
        fall = np.sign(expected) * (expected - last)
        limit = 0.0 if given else _FASTER * _edge(shaft, width, least)
        fallen = (size >= least) & (fall >= np.maximum(_PART * size, limit)) & (np.abs(last) <= _PART * size)
        if given:
            fallen &= _lasting(shaft, explained, width)
        falls[:-width] |= fallen
    groups = _groups(np.flatnonzero(falls), 2 * widths[-1])
    tops = (group[0] + int(np.argmax(np.abs(shaft[group[0] : group[-1] + 1]))) for group in groups)
    return np.fromiter(tops, dtype=np.intp, count=len(groups))


def _before(shaft: Array, explained: Array, places: IntArray) -> tuple[Array, float]:
    """Absolute voltages before collapses [V], and their common standard error [V].

    A collapse begins between two samples, while the source may change the voltage: the middle is used.
    """
    if not places.size:
        return np.empty(0), 0.0
    now, after = shaft[places], np.minimum(places + 1, shaft.size - 1)
    size = np.abs(now)
    most = np.maximum(size, np.abs(now + explained[after] - explained[places]))
    return 0.5 * (size + most), float(np.mean(most - size)) / math.sqrt(12.0)


def _lasting(shaft: Array, explained: Array, width: int) -> Mask:
    """Whether a change that the source does not explain is still there after twice the time: a difference
    between the delays of two channels is not.
    """
    rest = shaft - explained
    later = np.append(rest[2 * width :], np.full(width, rest[-1]))
    now, then = rest[width:] - rest[:-width], later - rest[:-width]
    lasting: Mask = now * then >= _PART * now**2
    return lasting


def _peak(
    shaft: Array,
    common_mode: Array | None,
    ratio: Estimate | None,
    statistics: _Statistics,
    *,
    undisturbed: bool,
) -> Estimate | None:
    """Peak of the shaft voltage without discharges [V]: of a record without any, or by the ratio."""
    if ratio is not None and common_mode is not None:
        highest = _smooth_peak(common_mode)
        return statistics.with_gain(ratio.value * highest, ratio.uncertainty * highest)
    if not undisturbed:
        return None
    return statistics.with_gain(_smooth_peak(shaft), statistics.noise)


def _smooth_peak(values: Array) -> float:
    """Largest absolute value of a moving median, which removes noise and single samples."""
    return float(np.max(np.abs(scipy.ndimage.median_filter(values, _MEDIAN, mode="nearest"))))


def _rate(places: IntArray, samples: int, duration: float) -> Estimate:
    """Collapses in a second, with the uncertainty of their number."""
    counts, _ = np.histogram(places, _BLOCKS, (0.0, float(samples)))
    rate = event_rate(counts.astype(float), duration)
    return Estimate(rate.mean, (rate.high - rate.low) / (2.0 * _NORMAL))


def measured_shaft(record: ShaftFile) -> tuple[dict[str, Estimate], tuple[ResultWarning, ...]]:
    """Quantities of the record in a file by their names in the table [measured], and the warnings about it.

    Raises InputError if the file cannot be read; its key begins with ``measured.shaft_record``.
    """
    key = "measured.shaft_record"
    try:
        shaft, warnings = _read(record, record.column, record.scale)
        common_mode = None
        if record.common_mode_column is not None:
            source, _ = _read(record, record.common_mode_column, record.common_mode_scale)
            common_mode = source.values
    except InputError as error:
        if error.key == str(Path(record.file)):
            raise error.with_text(f"{key}.file", f"{error.key} {error.text}") from None
        raise error.under(key) from None
    result = shaft_record(
        shaft.values,
        shaft.step,
        common_mode,
        threshold=record.threshold,
        gain=record.gain_uncertainty,
    )
    # The simulation of a drive is not concerned by edges that are not resolved.
    others = (warning for warning in warnings if warning.code != "edges-unresolved")
    return result.measured(), (*others, *_notes(record, result))


def _read(
    record: ShaftFile, column: str | int | None, scale: float
) -> tuple[Waveform, Sequence[ResultWarning]]:
    """Waveform of a channel of the file of a record, and warnings about it."""
    return read_waveform(
        record.file,
        column=column,
        time_column=record.time_column,
        step=record.step,
        time_unit=record.time_unit,
        value_unit=record.value_unit,
        scale=scale,
        resample=record.resample,
    )


def _notes(record: ShaftFile, result: ShaftRecord) -> Iterator[ResultWarning]:
    """Notes on the counted discharges, and on quantities that the record does not determine."""
    file = Path(record.file).name
    if result.slow:
        yield ResultWarning.of("shaft-record-slow", file=file, step=amount(result.step, "s"))
    else:
        yield ResultWarning.of(
            "shaft-record",
            "counted",
            file=file,
            count=result.times.size,
            duration=amount(result.duration, "s"),
            threshold=amount(float(f"{result.threshold:.3g}"), "V"),
            noise=amount(float(f"{result.noise:.2g}"), "V"),
        )
        if result.breakdown is None:
            yield ResultWarning.of("shaft-record", "few", file=file, least=_FEW)
    if result.peak is None and record.common_mode_column is None:
        yield ResultWarning.of("shaft-record", "peak", file=file)
    if result.inverted and result.ratio is not None:
        yield ResultWarning.of("shaft-record", "inverted", file=file, ratio=-result.ratio.value)
    if record.common_mode_column is not None and result.ratio is None:
        yield ResultWarning.of("shaft-record", "ratio", file=file, step=amount(result.step, "s"))
