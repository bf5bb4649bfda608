"""Voltages over a piece, written for many times, against its modes moved to each time."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.drive.circuit_equations import FORCE_ROW, RATE_ROW, VOLTAGE_ROWS
from ehlectric.drive.discharges.compiled import compiled
from ehlectric.drive.discharges.voltages_in_time import (
    FORCE,
    FURTHER,
    NOW,
    RATE,
    SLOPE,
    START,
    WEIGHTS,
    all_at,
    begin,
    empty_piece,
    empty_series,
    move,
    unfold,
)

# Voltages of both films and of the shaft.
VOLTAGES = 3

SIZES = st.floats(-1.0, 1.0)
# Rates times the duration of the piece, from modes that do not change to those that are over at once.
CHANGES = st.one_of(st.just(0.0), st.floats(-10.0, 3.0).map(lambda power: 10.0**power))


@compiled
def three_ways(piece, series, duration, times, found):
    unfold(piece, duration, series)
    for k in range(times.size):
        move(piece, times[k], found[2, k])
        for b in range(VOLTAGES):
            for m in range(piece.shape[1]):
                found[1, k, b] += (piece[WEIGHTS + b, m] * piece[NOW, m]).real
        all_at(series, times[k], found[0, k])


@compiled
def filled(rows, squares, x, source, ring, piece):
    begin(rows, squares, 0, x, source[0], source[1], ring, piece)


@pytest.mark.parametrize(("rate", "force", "slope"), [(-2e5, 3e6, 4e9), (-1e3, -2e4, 5e7), (0.0, 1e3, -1e6)])
def test_the_curvature_of_a_mode_is_its_second_derivative(rate, force, slope):
    """y' = r y + f + s t has y'' = r (r y + f) + s at the begin, of a voltage 0.5 y."""
    rows, squares = np.zeros((1, VOLTAGE_ROWS + 2, 3), dtype=complex), np.ones((1, 4, 1, 1), dtype=complex)
    rows[0, RATE_ROW, 0], rows[0, FORCE_ROW, 0], rows[0, VOLTAGE_ROWS, 0] = rate, 1.0, 0.5
    piece = empty_piece(1, 1)
    ring = np.zeros(2, dtype=complex)
    filled(rows, squares, np.array([0.7]), np.array([force, slope]), ring, piece)
    curvature = abs(0.5 * (rate * (rate * 0.7 + force) + slope))
    assert piece[WEIGHTS + 1, 0].real == pytest.approx(curvature, rel=1e-12)


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
            column = empty_piece(0, VOLTAGES)[:, 0]
            # The steady part of a fast mode is of volts too.
            size = max(change, 1.0) / duration
            column[[RATE, START, FORCE, SLOPE]] = rate, start, force * size, slope * size / duration
            column[WEIGHTS : WEIGHTS + VOLTAGES] = weight, 0.5 * weight, -0.25 * weight
            columns.append(column)
    times = duration * np.linspace(0.0, 1.0, 7)
    piece = np.array(columns).T.copy()
    found, moved, by_move = all_ways = np.zeros((3, times.size, VOLTAGES))
    three_ways(piece, empty_series(piece.shape[1] - FURTHER, VOLTAGES), duration, times, all_ways)
    assert found == pytest.approx(moved, rel=0.0, abs=3e-12)
    assert np.array_equal(by_move, moved)
