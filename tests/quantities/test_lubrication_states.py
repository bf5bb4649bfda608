"""One scale of lubrication states for contacts, bearings and duty cycles."""

import numpy as np
import pytest

from ehlectric.bearing.cycle_rows import PARTIAL_FILM, TOUCHING, lubrication_names
from ehlectric.bearing.solution import contact_limit, full_film_limit, lubrication_state, touches
from ehlectric.quantities.lubrication_states import FORMER_WORDS, STATES, bands, inner_states, limits

# Height of the highest summits divided by the composite roughness, and states with their ranges by hand.
HEIGHTS = {
    0.0: {"boundary lubrication": (0.0, 1.0), "mixed lubrication": (1.0, 3.0)},
    2.0: {
        "boundary lubrication": (0.0, 1.0),
        "frequent asperity contact": (1.0, 2.0),
        "mixed lubrication": (2.0, 3.0),
    },
    4.0: {"boundary lubrication": (0.0, 1.0), "frequent asperity contact": (1.0, 4.0)},
}


@pytest.mark.parametrize("height", HEIGHTS)
def test_states_of_a_height_are_in_the_table(height):
    ratios = np.linspace(0.005, 5.005, 501)
    expected = np.full(ratios.size, "full film", dtype=object)
    for name, (low, high) in HEIGHTS[height].items():
        expected[(ratios >= low) & (ratios < high)] = name
    assert lubrication_state(ratios, height).tolist() == expected.tolist()
    table = {state.name: (low, high) for state, low, high, _ in bands(height)}
    assert {name: table[name] for name in HEIGHTS[height]} == HEIGHTS[height]
    assert set(table) == set(expected)


@pytest.mark.parametrize("height", HEIGHTS)
def test_states_without_a_voltage_are_those_of_bearings_without_one(height):
    """The rule of voltages and the scale have one limit, also exactly at it."""
    voltages = {state.name: state.voltage for state in STATES}
    for ratio in (0.999, 1.0, 1.5, height, np.nextafter(height, 9.0), 3.0, 6.0):
        if ratio > 0.0:
            assert voltages[str(lubrication_state(ratio, height))] == (not touches(ratio, height))
    assert contact_limit(height) == limits(height)[1] == next(inner_states(height))[0]
    assert full_film_limit(height) == limits(height)[2]


def test_rows_of_a_duty_cycle_are_on_the_scale():
    ratios = np.array([0.5, 1.0, 2.0, 2.5])
    state = np.where(touches(ratios, 2.0), TOUCHING, PARTIAL_FILM)
    assert lubrication_names(state, ratios).tolist() == lubrication_state(ratios, 2.0).tolist()


def test_each_state_has_a_former_word():
    assert {state.name for state in STATES} <= set(FORMER_WORDS)
