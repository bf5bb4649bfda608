"""Common-mode voltage by modulation: its levels, its mean and its edges, against laws of modulation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.cases.drive_inputs import Source
from ehlectric.drive.inverter import edge_rate, sinusoidal, space_vector, steps_of
from ehlectric.drive.source_pieces import Ringing, edges
from tests.helpers.each import each

LINK = 600.0


def source(modulation="sinusoidal", **keys):
    own = {"dc_link": LINK, "modulation": modulation, "fundamental_frequency": 50.0, "rise_time": 1e-7}
    if modulation != "six-step":
        own |= {"switching_frequency": 2000.0, "modulation_index": 0.8}
    return Source.from_dict(own | keys)


def levels(one, duration):
    """Times of all steps, and the voltage after each; first of all that at the start."""
    start, intervals = steps_of(one, duration)
    steps = list(intervals)
    time, step = (np.concatenate([getattr(part, name) for part in steps]) for name in ("time", "step"))
    return np.append(0.0, time), start + np.append(0.0, np.cumsum(step))


@pytest.mark.parametrize("modulation", ["sinusoidal", "space-vector"])
def test_levels_of_a_carrier(modulation):
    """Three switches give -1/2, -1/6, 1/6 and 1/2 of the link; six edges in each period of the carrier."""
    time, voltage = levels(source(modulation), 0.02)
    assert np.unique(np.round(voltage / LINK, 9)) == pytest.approx([-1 / 2, -1 / 6, 1 / 6, 1 / 2])
    assert time.size - 1 == 6 * 40
    assert np.all(np.diff(time) > 0.0)
    assert voltage[-1] == pytest.approx(-LINK / 2.0)


def test_levels_of_six_steps():
    """A sixth of the link, alternately positive and negative, in six equal parts of the period."""
    time, voltage = levels(source("six-step"), 0.1)
    assert time == pytest.approx(np.arange(30) / 300.0)
    assert voltage == pytest.approx(LINK / 6.0 * np.where(np.arange(30) % 2 == 0, 1.0, -1.0))


@each(
    "one, rate",
    [
        # All phases switch together.
        (source(modulation_index=0.0), 2 * 2000.0),
        (source(modulation_index=0.9), 6 * 2000.0),
        (source("space-vector", modulation_index=0.9), 6 * 2000.0),
        (source("six-step"), 6 * 50.0),
    ],
)
def test_rate_of_edges(one, rate):
    assert edge_rate(one) == pytest.approx(rate, rel=1e-12)


def test_clamped_phases_have_no_edges():
    """At an index of 1.5 a sine is above the carrier, and below it, for acos(2/3)/pi of the time each."""
    switched = 1.0 - 2.0 * np.arccos(2.0 / 3.0) / np.pi
    one = source(modulation_index=1.5, switching_frequency=200e3)
    assert edge_rate(one) == pytest.approx(switched * 6 * 200e3, rel=1e-3)


@given(index=st.floats(0.0, 1.0), angle=st.floats(-10.0, 10.0))
def test_space_vectors_have_the_line_voltages_of_sines(index, angle):
    """What is taken off is common to all phases, and centres them."""
    sines, vectors = sinusoidal(np.array([angle]), index)[0], space_vector(np.array([angle]), index)[0]
    assert np.diff(vectors) == pytest.approx(np.diff(sines), abs=1e-12)
    assert np.max(vectors) == pytest.approx(-np.min(vectors), abs=1e-12)


def test_mean_of_the_common_mode_voltage():
    """Sines add up to zero, so that the mean over each period of the carrier is zero."""
    time, voltage = levels(source(modulation_index=0.9), 0.02)
    lengths = np.diff(np.append(time, 0.02))
    assert np.sum(voltage * lengths) / 0.02 == pytest.approx(0.0, abs=1e-9 * LINK)


@pytest.mark.parametrize("rise", [0.0, 1e-7, 5e-5])
def test_segments_are_the_edges(rise):
    """Also where pulses are shorter than their edges: the voltage is that of the steps, averaged."""
    one = source("space-vector")
    start, intervals = steps_of(one, 0.02, 0.003)
    pieces = list(edges(start, intervals, rise))
    duration = np.concatenate([piece.duration for piece in pieces])
    level = np.concatenate([piece.level for piece in pieces])
    slope = np.concatenate([piece.slope for piece in pieces])
    assert np.sum(duration) == pytest.approx(0.02, rel=1e-12)
    ends = np.append(0.0, np.cumsum(duration))
    time, steps = levels(one, 0.02)
    for at in np.linspace(1e-5, 0.0199, 997):
        k = np.searchsorted(ends, at, side="right") - 1
        mine = level[k] + slope[k] * (at - ends[k])
        passed = np.clip((at - time[1:]) / rise, 0.0, 1.0) if rise else (time[1:] <= at).astype(float)
        assert mine == pytest.approx(steps[0] + np.sum(np.diff(steps) * passed), abs=1e-6)


def test_an_edge_excites_its_ringing():
    """From its end on, Re(r) begins at zero and rises as A omega t."""
    start, intervals = steps_of(source("six-step"), 0.02)
    ringing = Ringing(overshoot=0.25, frequency=1e6, time=1e-6)
    (piece,) = edges(start, intervals, 1e-7, ringing)
    rings = piece.ring[piece.ring != 0.0]
    assert rings.real == pytest.approx(np.zeros(rings.size))
    slope = (rings * ringing.rate).real
    assert np.abs(slope) == pytest.approx(
        np.full(rings.size, 0.25 * LINK / 3.0 * 2.0 * np.pi * 1e6), rel=1e-12
    )
