"""Initial breakdown of bearings over speed and load; bearing, oil and temperature are not known."""

import numpy as np
import pytest

from tests.bearing.bearing_breakdown import (
    BEST,
    CANDIDATES,
    FAST,
    FLOODED,
    HOT,
    LOADS,
    NEAREST,
    SLOW,
    WARMER,
    breakdown,
    computed_exponent,
    measured,
    measured_exponents,
)

pytestmark = pytest.mark.measured

# The candidate of the same rating in the default tests, all others in the long ones.
BEARINGS = pytest.mark.parametrize(
    "bearing",
    [pytest.param(name, marks=[] if name == NEAREST else pytest.mark.slow) for name in CANDIDATES],
)


def test_measured_exponents():
    """By hand from the table: ln(5/3), ln(6/4.5), ln(2.5/3), ln(3/3.5) and ln(2/1.5) over ln 3.5."""
    found = [exponent for loads in LOADS for exponent in measured_exponents(loads)]
    assert found == pytest.approx([0.408, 0.230, -0.146, -0.123, 0.230], abs=5e-4)


@pytest.mark.slow
@pytest.mark.gate
@BEARINGS
def test_flooded_films_depend_more_on_the_speed(bearing):
    """A miss: flooded films have 0.58 to 0.73 for each candidate, with and without heat in the inlet.

    The largest measured exponent is 0.41, and half a volt of the reading is up to 0.2 of it.
    """
    most = max(exponent for loads in LOADS for exponent in measured_exponents(loads))
    for loads in LOADS:
        cold, hot = (computed_exponent(bearing, loads, effect) for effect in (FLOODED, HOT))
        assert most + 0.15 < hot < cold < 0.75


@pytest.mark.slow
@pytest.mark.gate
@BEARINGS
def test_supply_and_warmer_oil_have_the_measured_range(bearing):
    """Grease that fills the track only in part, and oil that is 0 to 40 K warmer, span the exponents."""
    found = [exponent for loads in LOADS for exponent in measured_exponents(loads)]
    for loads in LOADS:
        most, least = (computed_exponent(bearing, loads, BEST, warmer=warmer) for warmer in (0.0, WARMER))
        assert least < min(found) + 0.05
        assert most > max(found) - 0.05


def test_loads_change_the_voltage_more_than_films():
    """A miss: films change by a few per cent between the three loads, the measured voltages by up to 2.5."""
    films, volts = ([rule(loads) for loads in LOADS] for rule in (_film_voltage, _mean_measured))
    assert max(films) / min(films) < 1.1
    assert max(volts) / min(volts) > 2.3


def test_order_of_the_voltages():
    """With 15 V/um and grease the computed voltages are 5 to 9 V at 60 degC, the measured ones 1.5 to 6 V."""
    computed = [breakdown(NEAREST, loads, speed, BEST) for loads in LOADS for speed in (SLOW, FAST)]
    found = [volt for loads in LOADS for speed in (SLOW, FAST) for volt in measured(loads, speed)]
    assert 4.5 < min(computed) < max(computed) < 10.0
    assert (min(found), max(found)) == (1.5, 6.0)


def _film_voltage(loads):
    """Computed voltage at the high speed [V]."""
    return breakdown(NEAREST, loads, FAST, BEST)


def _mean_measured(loads):
    """Mean of the measured voltages at the high speed [V]."""
    return np.mean(measured(loads, FAST))
