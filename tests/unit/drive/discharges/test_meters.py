"""What is measured over time: histograms that widen by themselves, and the trace around a discharge."""

import numpy as np
import pytest

from ehlectric.drive.discharges.record import ON, VOLTAGE
from tests.helpers.drives import arc, element, march, motor, square

PERIOD = 1e-4


@pytest.mark.parametrize("highest", [0.01, 20.0, 5e4])
def test_a_triangle_is_at_all_of_its_voltages_for_the_same_time(highest):
    """Whatever voltage was expected: the first range is 2^-12 of it, and doubles up to the triangle's."""
    triangle = square(100.0, PERIOD, 0.5 * PERIOD, 20)
    record = march(motor(), [element(), element(100e-12)], arc(), triangle, highest=highest)
    reach, peak = record.edges[-1], record.peak
    assert reach >= max(peak)
    if highest < 1e4:
        assert reach < 2.0 * max(peak)
    width = record.edges[1] - record.edges[0]
    assert record.edges[0] == -reach
    for b in range(2):
        inside = np.abs(record.edges[:-1] + 0.5 * width) < peak[b] - width
        assert np.sum(inside) > 20
        assert record.histogram[b, inside] == pytest.approx(
            record.duration * width / (2.0 * peak[b]), rel=2e-3
        )
        assert np.sum(record.histogram[b]) == pytest.approx(record.duration)


def test_the_histogram_and_the_limits_agree():
    """Edges of bins that are limits have the same time above them."""
    bearings = [element(breakdown=6.0, shape=4.0), element(breakdown=9.0, shape=4.0)]
    wave = square(100.0, PERIOD, 1e-6, 200)
    edges = march(motor(), bearings, arc(), wave, seed=2).edges
    limits = tuple(float(edge) for edge in edges[edges.size // 2 + 1 :: 20])
    record = march(motor(), bearings, arc(), wave, seed=2, limits=limits)
    half = record.histogram.shape[1] // 2
    both = record.histogram[:, half:] + record.histogram[:, half - 1 :: -1]
    for k in range(len(limits)):
        assert np.sum(both[:, 1 + 20 * k :], axis=1) == pytest.approx(record.above[:, k], abs=1e-12)


def test_the_trace_is_around_one_of_the_first_discharges():
    """It is a part of the trace of the whole time, to the last bit, also in a later chunk of the source."""
    bearings = [element(breakdown=12.0, shape=4.0), element(breakdown=13.0, shape=4.0)]
    chunks = [square(50.0, PERIOD, 1e-6, 10), *(square(100.0, PERIOD, 1e-6, 10) for _ in range(3))]
    whole = march(motor(), bearings, arc(), chunks, seed=3, trace=np.inf)
    part = march(motor(), bearings, arc(), chunks, seed=3, trace=2.0 * PERIOD, at_event=True)
    assert np.array_equal(part.events, whole.events)
    assert np.array_equal(part.histogram, whole.histogram)
    begin, end = part.trace[0, 0], part.trace[-1, 0]
    assert PERIOD < end - begin <= 2.0 * PERIOD
    first = part.events[:5]
    seen = first[(first[:, ON] >= begin) & (first[:, ON] <= end)]
    assert len(seen)
    assert begin > 10.0 * PERIOD
    same = whole.trace[(whole.trace[:, 0] >= begin) & (whole.trace[:, 0] <= end)]
    assert np.array_equal(part.trace, same)
    # The voltage of a film is its threshold when the arc begins.
    at = part.trace[np.searchsorted(part.trace[:, 0], seen[0, ON])]
    assert seen[0, VOLTAGE] in at[2:]


def test_the_trace_is_at_the_begin_where_nothing_discharges():
    record = march(motor(), [element(), element()], arc(), square(100.0, PERIOD, 1e-6, 10),
                   trace=2.0 * PERIOD, at_event=True)  # fmt: skip
    assert record.trace[0, 0] == 0.0
    assert record.trace[-1, 0] < 2.0 * PERIOD
