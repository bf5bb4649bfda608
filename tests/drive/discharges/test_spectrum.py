"""Spectrum of the shaft voltage: Fourier series of simple sources, and Parseval's equation."""

import numpy as np
import pytest

from ehlectric.bearing.circuit import Path
from ehlectric.drive.discharges.event_loop import LINES, empty_means
from tests.helpers.drives import arc, capacitive_divider, element, march, motor, square

PERIOD, PERIODS = 1e-4, 20


@pytest.mark.parametrize("rise", [1e-7, 5e-6, 0.5 * PERIOD])
def test_lines_of_a_trapezoid_are_those_of_its_fourier_series(rise):
    """4/(pi n) sinc(n rise/period) of the level for odd n; from a square wave to a triangle."""
    bearings, circuit = [element(), element(100e-12)], motor()
    found = march(circuit, bearings, arc(), square(100.0, PERIOD, rise, PERIODS)).spectrum
    n = np.arange(1, 61, 2)
    level = 100.0 * capacitive_divider(circuit, bearings)[0]
    expected = level * 4.0 / (np.pi * n) * np.abs(np.sinc(n * rise / PERIOD))
    assert found[n * PERIODS] == pytest.approx(expected, rel=2e-4, abs=1e-6 * level)
    assert np.max(np.delete(found, np.arange(PERIODS, found.size, 2 * PERIODS))) < 1e-6 * level


def test_the_sum_of_the_lines_is_the_rms_voltage():
    """Parseval's equation, with arcs that burn; 10 MHz is far above the rates of the arcs."""
    bearings = [element(breakdown=8.0, shape=4.0), element(100e-12, breakdown=9.0, shape=4.0)]
    record = march(motor(), bearings, arc(), square(100.0, PERIOD, 1e-6, PERIODS), seed=1)
    assert np.sum(record.counts) > 20
    mean, *lines = record.spectrum
    assert np.sqrt(mean**2 + 0.5 * np.sum(np.square(lines))) == pytest.approx(record.rms[0], rel=2e-3)


def test_it_is_the_voltage_of_the_shaft_and_not_that_of_the_films():
    """With coatings of the capacitance of the films, these have half of the voltage of the shaft."""
    bearings = [element(300e-12, path=Path(coating=300e-12)) for _ in range(2)]
    circuit = motor()
    record = march(circuit, bearings, arc(), square(100.0, PERIOD, 1e-7, PERIODS))
    films = 100.0 * capacitive_divider(circuit, bearings)[0]
    assert record.spectrum[PERIODS] == pytest.approx(2.0 * films * 4.0 / np.pi, rel=2e-4)


def test_a_long_time_has_the_most_lines_and_a_short_one_those_up_to_the_highest_frequency():
    assert empty_means(1.0).size == 8 * LINES
    assert empty_means(1e-3).size == 8 * 10_000
    assert empty_means(1e-9).size == 8
