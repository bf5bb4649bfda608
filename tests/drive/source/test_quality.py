"""Doubts about measured waveforms: what is told, and what is not."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.drive.waveform.sample_quality import (
    clipped_levels,
    few_levels,
    longest_run,
    quality_warnings,
    repeat_warnings,
    unresolved_edges,
)
from ehlectric.drive.waveform.waveform import Waveform
from tests.helpers.each import each

COUNT = 20_000


def noisy(values, size, seed=2):
    return values + np.random.default_rng(seed).normal(0.0, size, values.size)


def square(period=400, rise=20):
    """Two levels, -1 and 1, with edges of some samples."""
    phase = np.arange(COUNT) % period
    return np.interp(phase, [0, rise, period // 2, period // 2 + rise, period], [-1.0, 1.0, 1.0, -1.0, -1.0])


def staircase(period=600, rise=20):
    """Four levels of the common-mode voltage of an inverter."""
    points = np.array([0, 100, 200, 300, 400, 500])
    levels = np.array([-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0, 1.0 / 3.0, -1.0 / 3.0])
    x = np.stack([points, points + 100 - rise], axis=1).ravel()
    return np.interp(np.arange(COUNT) % period, np.append(x, period), np.append(np.repeat(levels, 2), -1.0))


def quantised(values, bits, span=2.4):
    size = span / 2**bits
    return np.rint(values / size) * size


SINE = np.sin(2.0 * np.pi * np.arange(COUNT) / 3000.0)

SOUND = {
    "sine": SINE,
    "noisy sine": noisy(SINE, 0.01),
    "sine of 8 bits": quantised(SINE, 8),
    "noisy sine of 8 bits": quantised(noisy(SINE, 0.01), 8),
    "sine of 12 bits": quantised(SINE, 12),
    "slow sine of 12 bits": quantised(np.sin(2.0 * np.pi * np.arange(COUNT) / COUNT), 12),
    "square with noise": noisy(square(), 0.01),
    "square with noise of 8 bits": quantised(noisy(square(), 0.01), 8),
    "square with little noise of 8 bits": quantised(noisy(square(), 0.003), 8),
    "square without noise": square(rise=4),
    "staircase with noise": noisy(staircase(), 0.01),
    "staircase with noise of 8 bits": quantised(noisy(staircase(), 0.01), 8),
    "staircase without noise": staircase(),
    "sawtooth": (np.arange(COUNT) % 100) / 100.0,
}


@each("name", SOUND)
def test_waveforms_that_are_not_clipped(name):
    assert clipped_levels(SOUND[name]) == {}


CUT = {
    "sine": (SINE, 0.9),
    "noisy sine": (noisy(SINE, 0.01), 0.8),
    "sine of 8 bits": (quantised(noisy(SINE, 0.01), 8), 0.75),
    "staircase": (noisy(staircase(), 0.01), 0.9),
    "square with ringing": (
        noisy(square(), 0.02)
        + 0.3 * np.sin(np.arange(COUNT) / 3.0) * np.exp(-(np.arange(COUNT) % 200) / 60.0),
        0.95,
    ),
}


@each("name", CUT)
def test_clipped_waveforms_are_told_at_each_end(name):
    values, level = CUT[name]
    assert list(clipped_levels(np.minimum(values, level))) == [level]
    assert list(clipped_levels(np.maximum(values, -level))) == [-level]
    both = np.clip(values, -level, level)
    assert clipped_levels(both) == {
        -level: np.count_nonzero(both == -level),
        level: np.count_nonzero(both == level),
    }


@given(st.lists(st.booleans(), max_size=40))
def test_longest_run_by_counting(entries):
    runs = "".join("x" if entry else " " for entry in entries).split()
    assert longest_run(np.array(entries, dtype=bool)) == max(map(len, runs), default=0)


def test_levels_are_counted_over_the_whole_record():
    assert few_levels(quantised(noisy(SINE, 0.01), 4)) == 15
    assert few_levels(quantised(noisy(SINE, 0.01), 8)) is None
    late = np.zeros(200_000)
    late[-40:] = np.arange(40)
    assert few_levels(late) is None
    late[-30:] = 0.0
    assert few_levels(late) == 10
    assert few_levels(np.arange(100.0) % 7) is None


@each("samples, unresolved", [(0, True), (1, True), (2, True), (3, False), (4, False), (6, False)])
def test_edges_with_fewer_than_three_samples(samples, unresolved):
    """An edge that is straight between two samples with a given number of samples between 10 and 90 %."""
    width = samples + 1
    values = np.interp(np.arange(100.0), [40.0, 40.0 + width], [-300.0, 300.0])
    inside = np.count_nonzero((values > -240.0) & (values < 240.0))
    assert inside == samples
    found, edges = unresolved_edges(values)
    assert (found, edges) == (int(unresolved), 1)


@each("samples", [0, 1, 2, 3, 5])
@each("peak", [0.0, 4.0, 40.0])
def test_edges_of_a_staircase_all_count(samples, peak):
    """Six edges in a period of 600 samples, each a third of the range, and a few much higher peaks."""
    values = staircase(rise=samples + 1)
    inside = np.count_nonzero((values[:150] > -1.0 + 0.2 / 3.0) & (values[:150] < -1.0 + 1.8 / 3.0))
    assert inside == samples
    edges = 2 * (COUNT // 600) * 3 + 2
    values[300:COUNT:5000] += peak
    found, counted = unresolved_edges(noisy(values, 0.003))
    # The four peaks count as well, or hide the edge next to them.
    assert abs(counted - edges) <= 5
    assert abs(found - (edges if samples < 3 else 0)) <= 5


def test_edges_between_neighbouring_levels_count_by_their_own_height():
    values = np.repeat([-300.0, -100.0, 100.0, 300.0], 30)
    assert unresolved_edges(values) == (3, 3)
    assert unresolved_edges(noisy(values, 1.0)) == (3, 3)
    assert unresolved_edges(noisy(SINE, 0.01)) == (0, 0)


def test_a_spike_of_one_sample_is_not_resolved():
    values = noisy(np.zeros(1000), 0.01)
    values[500] = 3.0
    found, _ = unresolved_edges(values)
    assert found == 1


@each(
    "cut, duration, told",
    [(0, None, False), (0, 3e-5, False), (25, None, False), (25, 7.4e-6, False), (25, 3e-5, True)],
)
def test_a_seam_of_a_repeated_record_is_told(cut, duration, told):
    """A record of whole periods ends where it begins; one that is cut jumps back by its swing."""
    values = np.cos(2.0 * np.pi * np.arange(100 - cut + 1) / 100.0)
    found = list(repeat_warnings("scope.csv", Waveform(0.0, 1e-7, values), duration))
    assert [one.code for one in found] == (["record-repeated"] if told else [])
    if told:
        assert [part for part in ("7.5e-06 s", "3e-05 s", " 1 V") if part not in str(found[0])] == []


def test_each_doubt_is_told_once_with_its_numbers():
    values = np.clip(quantised(noisy(square(rise=1), 0.3), 4), -1.05, 1.05)
    told = {
        warning.code: warning.text for warning in quality_warnings("scope.csv", Waveform(0.0, 1e-8, values))
    }
    assert "edges-unresolved" in told
    assert " 1e-08 s" in told["edges-unresolved"]
    assert " 2.1 V" in told["waveform-coarse"]
    assert not list(quality_warnings("scope.csv", Waveform(0.0, 1e-8, noisy(SINE, 0.01))))


@each("first", [0, 1, 5])
def test_an_edge_at_the_beginning_of_a_record_has_its_first_sample(first):
    """Of samples at 0, 25, 50, 75 and 100 % three are between 10 and 90 %."""
    values = np.interp(np.arange(40.0), [first, first + 4.0], [0.0, 100.0])
    assert unresolved_edges(values) == (0, 1)
    assert unresolved_edges(values[::-1]) == (0, 1)
