"""Largest edge of a record: fine and coarse samples, noise, slow edges, rests, ringing."""

import math

import numpy as np
import pytest

from ehlectric.drive.waveform.waveform import Waveform


def staircase(times, edge=100.0, rise=1e-7, rest=5e-6, count=3):
    """Voltage of several edges in one direction, with rests between them."""
    return sum(edge * np.clip((times - k * rest - 2e-6) / rise, 0.0, 1.0) for k in range(count))


@pytest.mark.parametrize("step", [1e-9, 5e-9, 2e-8, 1e-7])
@pytest.mark.parametrize("noise", [0.0, 0.5, 2.0])
@pytest.mark.parametrize("count", [1, 2, 3])
def test_one_edge_of_several(step, noise, count):
    """Noise of a standard deviation s adds at most 11 s, of the extremes of all samples."""
    times = np.arange(0.0, 4e-5, step)
    values = staircase(times, count=count) + noise * np.random.default_rng(1).normal(size=times.size)
    edge = Waveform(0.0, step, values).largest_edge
    assert 100.0 - 1e-9 <= edge.voltage <= 100.0 + 11.0 * noise + 1e-9
    assert edge.rise_time == pytest.approx(1e-7, abs=1.2 * step + 0.1 * noise * 1e-7)


def test_a_slow_edge_is_larger_than_a_fast_one():
    """100 V in 4 us, and 30 V in 20 ns."""
    times = np.arange(0.0, 1e-4, 2e-8)
    values = 100.0 * np.clip((times - 2e-5) / 4e-6, 0.0, 1.0) + 30.0 * (times > 6e-5)
    edge = Waveform(0.0, 2e-8, values).largest_edge
    assert edge == pytest.approx((100.0, 4e-6), rel=0.01)


def test_the_first_overshoot_belongs_to_an_edge():
    """A step response that rings at 2 MHz: 1 + exp(-t/T) at its first peak."""
    times = np.arange(0.0, 4e-5, 5e-9)
    since = np.maximum(times - 1e-5, 0.0)
    values = 100.0 * (1.0 - np.exp(-since / 1e-6) * np.cos(4e6 * math.pi * since))
    edge = Waveform(0.0, 5e-9, values).largest_edge
    assert edge.voltage == pytest.approx(100.0 * (1.0 + math.exp(-0.25)), rel=0.01)


def test_records_without_an_edge():
    """A constant has none, and a sine has the height of half a period."""
    assert Waveform(0.0, 1e-6, np.ones(50)).largest_edge == (0.0, 0.0)
    sine = np.sin(2.0 * np.pi * np.arange(3000) / 500.0)
    assert Waveform(0.0, 1e-6, sine).largest_edge.voltage == pytest.approx(2.0, rel=0.01)
