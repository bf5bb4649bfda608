"""Voltages over a piece, written for many times, against its modes moved to each time."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.drive.discharges.compiled import compiled
from ehlectric.drive.discharges.voltages_in_time import (
    FILMS,
    FORCE,
    NOW,
    RATE,
    ROWS,
    SLOPE,
    START,
    VOLTAGES,
    all_at,
    empty_piece_voltages,
    move,
    unfold,
    voltages,
)

SIZES = st.floats(-1.0, 1.0)
# Rates times the duration of the piece, from modes that do not change to those that are over at once.
CHANGES = st.one_of(st.just(0.0), st.floats(-10.0, 3.0).map(lambda power: 10.0**power))


@compiled
def three_ways(piece, course, duration, times, found):
    unfold(piece, duration, course)
    for k in range(times.size):
        move(piece, times[k])
        for b in range(VOLTAGES):
            for m in range(piece.shape[1]):
                found[1, b, k] += (piece[FILMS + b, m] * piece[NOW, m]).real
        found[0, 0, k], found[0, 1, k], found[0, 2, k] = all_at(course, times[k])
        found[2, 0, k], found[2, 1, k] = voltages(piece)


@given(
    modes=st.lists(st.tuples(CHANGES, SIZES, SIZES, SIZES, SIZES, st.booleans()), min_size=1, max_size=4),
    duration=st.floats(-9.0, 0.0).map(lambda power: 10.0**power),
)
def test_a_course_is_the_voltage_of_its_modes(modes, duration):
    """To rounding of the largest part: oscillating modes come in pairs, and forces change modes by volts."""
    columns = []
    for change, start, force, slope, weight, oscillates in modes:
        rates = [-change / duration]
        if oscillates and change:
            rates = [(-0.3 + 1.0j) * change / duration, (-0.3 - 1.0j) * change / duration]
        for rate in rates:
            column = np.zeros(ROWS, dtype=complex)
            # The steady part of a fast mode is of volts too.
            size = max(change, 1.0) / duration
            column[[RATE, START, FORCE, SLOPE]] = rate, start, force * size, slope * size / duration
            column[FILMS : FILMS + VOLTAGES] = weight, 0.5 * weight, -0.25 * weight
            columns.append(column)
    times = duration * np.linspace(0.0, 1.0, 7)
    piece = np.array(columns).T.copy()
    found, moved, both_moved = all_ways = np.zeros((3, VOLTAGES, times.size))
    three_ways(piece, empty_piece_voltages(piece.shape[1]), duration, times, all_ways)
    assert found == pytest.approx(moved, rel=0.0, abs=3e-12)
    assert np.array_equal(both_moved[:2], moved[:2])
