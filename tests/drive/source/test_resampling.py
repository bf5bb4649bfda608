"""Resampling to a coarser step: what is kept, and what is suppressed."""

import numpy as np
import pytest
from scipy.signal import firwin, upfirdn

from ehlectric.drive.measured_source import HALF, resample
from ehlectric.drive.waveform.waveform import Waveform
from ehlectric.errors import InputError
from tests.helpers.each import each

STEP = 1e-9
RATIOS = [1.2, 3.0, 7.3, np.pi, 25.0, 312.5]


def sine(frequency, count, phase=0.7):
    """Sine of a frequency in cycles a new step, at the old steps."""
    return np.cos(2.0 * np.pi * frequency * np.arange(count) + phase)


def interior(waveform):
    return waveform.values[HALF + 1 : -HALF - 1]


def amplitude_and_phase(values, frequency, first):
    angles = 2.0 * np.pi * frequency * (first + np.arange(values.size))
    columns = np.column_stack([np.cos(angles), -np.sin(angles)])
    (real, imaginary), *_ = np.linalg.lstsq(columns, values, rcond=None)
    return np.hypot(real, imaginary), np.arctan2(imaginary, real)


@each("ratio", RATIOS)
@each("frequency", [0.01, 0.13, 0.29, 0.4])
def test_a_sine_below_two_fifths_of_the_new_rate_keeps_amplitude_and_phase(ratio, frequency):
    count = int(200 * ratio)
    coarse = resample(Waveform(0.0, STEP, sine(frequency / ratio, count)), ratio * STEP)
    amplitude, phase = amplitude_and_phase(interior(coarse), frequency, HALF + 1)
    assert amplitude == pytest.approx(1.0, abs=1e-3)
    assert phase == pytest.approx(0.7, abs=1e-3)


@each("ratio", RATIOS)
@each("frequency", [0.5, 0.52, 0.6, 0.97, 1.0, 1.4, 3.3])
def test_a_sine_above_the_new_limit_is_suppressed_by_60_decibels(ratio, frequency):
    if frequency > 0.5 * ratio:
        frequency = 0.5 * ratio  # the highest one that the old samples have
    coarse = resample(Waveform(0.0, STEP, sine(frequency / ratio, int(200 * ratio))), ratio * STEP)
    assert np.max(np.abs(interior(coarse))) < 1e-3


@each("ratio", RATIOS)
def test_a_constant_stays_constant_up_to_the_ends(ratio):
    coarse = resample(Waveform(-3.0, STEP, np.full(int(90 * ratio), 311.7)), ratio * STEP)
    assert np.max(np.abs(coarse.values - 311.7)) < 1e-12 * 311.7
    assert (coarse.start, coarse.step) == (-3.0, ratio * STEP)


@pytest.mark.parametrize("ratio", [2, 5, 16])
def test_the_mean_is_kept(ratio):
    """Of the record from its first to its last sample, by trapezoids, whatever its values are."""
    values = np.random.default_rng(5).normal(3.0, 40.0, 400 * ratio + 1)
    coarse = resample(Waveform(0.0, STEP, values), ratio * STEP)
    assert coarse.duration == pytest.approx(400 * ratio * STEP)
    before = np.trapezoid(values) / (values.size - 1)
    assert np.trapezoid(coarse.values) / (coarse.values.size - 1) == pytest.approx(before, abs=1e-4 * 40.0)


@pytest.mark.parametrize("ratio", [3, 10])
def test_whole_ratios_agree_with_the_polyphase_filter_of_scipy(ratio):
    values = np.random.default_rng(6).normal(size=300 * ratio + 1)
    coarse = resample(Waveform(0.0, STEP, values), ratio * STEP)
    reach = HALF * ratio
    taps = firwin(2 * reach + 1, 0.45, fs=ratio, window=("kaiser", 0.1102 * (85.0 - 8.7)))
    other = upfirdn(taps, values, down=1)[reach : reach + values.size : ratio]
    inside = slice(HALF + 1, -HALF - 1)
    assert coarse.values[inside] == pytest.approx(other[inside], abs=2e-5)


@each("ratio", [1.5, 2.0, 7.3, 40.0, np.pi])
def test_a_jump_overshoots_as_documented(ratio):
    count = int(200 * ratio)
    jump = np.where(np.arange(count) < count // 2, -50.0, 50.0)
    coarse = resample(Waveform(0.0, STEP, jump), ratio * STEP)
    assert np.max(np.abs(coarse.values)) < 50.0 + 0.11 * 100.0
    assert np.abs(coarse.values[[0, -1]]) == pytest.approx(50.0, abs=0.01)


def test_nothing_is_delayed():
    """A symmetric pulse stays symmetric about its middle."""
    values = np.zeros(2001)
    values[990:1011] = 7.0
    coarse = resample(Waveform(0.0, STEP, values), 5 * STEP).values
    assert coarse == pytest.approx(coarse[::-1], abs=1e-12)


def test_steps_that_are_refused_or_leave_the_waveform_as_it_is():
    waveform = Waveform(0.0, STEP, sine(0.01, 100))
    assert resample(waveform, STEP) is waveform
    for step in (0.5 * STEP, 0.0, -STEP, np.nan, np.inf):
        with pytest.raises(InputError, match="1e-09 s"):
            resample(waveform, step)
    with pytest.raises(InputError, match=r"^step: .* 1e-07 s.* 9\.9e-08 s"):
        resample(waveform, 100 * STEP)
    assert resample(waveform, 99 * STEP).values.size == 2


def test_records_shorter_than_the_filter_are_mirrored():
    short = resample(Waveform(0.0, STEP, np.array([1.0, 2.0, 3.0, 4.0])), 1.5 * STEP)
    assert short.values.size == 3
    assert np.all((short.values > 0.5) & (short.values < 4.5))
