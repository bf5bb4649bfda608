"""State equations of circuits: closed forms, and conservation of charge and energy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from ehlectric.drive.circuit_equations import INVERSE, RATE_ROW, SHAPES, Element, modes_of, state_space
from ehlectric.drive.circuit_states import MOVED
from tests.helpers.drives import arc, element, motor, rotor_network


def test_capacitive_divider():
    """A jump of the source is shared by the reciprocal capacitances: C1/(C1 + C2)."""
    own = [Element("capacitor", "a", "b", 1e-10), Element("capacitor", "b", "frame", 3e-10)]
    system = state_space(own, ("a", "frame"))
    # The states p + k u do not jump, so that p jumps by -k u.
    assert -system.jump == pytest.approx([0.25], rel=1e-14)
    assert system.rates == pytest.approx(np.zeros((1, 1)))


def test_series_resonance():
    """L i' = u - v, C v' = i: an oscillator, damped by R/(2 L)."""
    inductance, capacitance, resistance = 1e-3, 1e-9, 100.0
    system = state_space(
        [
            Element("inductor", "a", "b", inductance, resistance),
            Element("capacitor", "b", "frame", capacitance),
        ],
        ("a", "frame"),
    )
    damping = resistance / (2.0 * inductance)
    omega = np.sqrt(1.0 / (inductance * capacitance) - damping**2)
    own = np.linalg.eigvals(system.rates)
    assert sorted(own.imag) == pytest.approx([-omega, omega], rel=1e-9)
    assert own.real == pytest.approx([-damping, -damping], rel=1e-9)


def test_a_source_between_two_free_nodes():
    """A source on a floating node shares its voltage between equal capacitors to the frame."""
    own = [Element("capacitor", "a", "frame", 1e-9), Element("capacitor", "b", "frame", 1e-9)]
    system = state_space(own, ("a", "b"))
    assert -system.jump == pytest.approx([-0.5], rel=1e-14)


def test_a_node_without_capacitors_is_refused():
    own = [Element("conductor", "a", "b", 1.0), Element("conductor", "b", "frame", 1.0)]
    with pytest.raises(ValueError, match="no path of capacitors"):
        state_space(own, ("a", "frame"))


@given(values=st.lists(st.floats(-3.0, 3.0), min_size=7, max_size=7), time=st.floats(1e-9, 1e-3))
def test_modes_are_the_exponential_of_the_rates(values, time):
    """Any circuit of capacitors, resistors and an inductor; expm is an independent method."""
    c1, c2, c3, g1, g2, length, loss = (10.0**value for value in values)
    own = [
        Element("capacitor", "winding", "rotor", 1e-10 * c1),
        Element("capacitor", "rotor", "frame", 1e-9 * c2),
        Element("capacitor", "rotor", "ring", 1e-9 * c3),
        Element("capacitor", "ring", "frame", 1e-9),
        Element("capacitor", "winding", "frame", 1e-9),
        Element("conductor", "rotor", "ring", 1e-6 * g1),
        Element("conductor", "rotor", "frame", 1e-6 * g2),
        Element("inductor", "source", "winding", 1e-5 * length, loss),
    ]
    system = state_space(own, ("source", "frame"))
    modes = modes_of(system, [("rotor", "ring"), ("rotor", "frame")])
    # Scaled by the root of their energy, states are of the same size.
    scale = np.sqrt(np.diag(system.capacitance))
    exact = expm(system.rates * time * scale[:, None] / scale[None, :])
    rates = modes.rows[RATE_ROW, :-2]
    mine = (modes.squares[SHAPES] * np.exp(rates * time)) @ modes.squares[INVERSE]
    np.testing.assert_allclose((mine * scale[:, None] / scale[None, :]).real, exact, atol=1e-7)
    assert np.all(rates.real <= 0.0)


@pytest.mark.parametrize("burning", range(5))
def test_modes_of_shafts_that_nothing_discharges(burning):
    """Without leakage, and with an arc in one film, two rates are zero; expm is an independent method."""
    ends = [("a", "frame"), ("a", "b"), ("b", "frame"), ("b", "c"), ("c", "frame")]
    values = (0.5e-9, 1e-9, 5e-9, 4e-9, 11e-9)
    own = [Element("capacitor", *pair, value) for pair, value in zip(ends, values, strict=True)]
    own += [Element("capacitor", "winding", "a", 1e-10), Element("conductor", *ends[burning], 0.1)]
    system = state_space(own, ("winding", "frame"))
    modes = modes_of(system, ends)
    exact = expm(system.rates * 1e-8)
    mine = (modes.squares[SHAPES] * np.exp(modes.rows[RATE_ROW, :-2] * 1e-8)) @ modes.squares[INVERSE]
    np.testing.assert_allclose(mine.real, exact, atol=1e-9)


def test_a_film_that_moves_has_its_next_capacitance():
    """The state after each move is the first state of a film whose capacitances begin further along."""
    capacitances = np.array([1e-10, 2e-10, 5e-10])
    states, state = rotor_network(motor(), [element(capacitances), element()], arc()).states(), 0
    for moves in (1, 2, 3):
        states.make(state, 0, MOVED)
        state = int(states.links[state, 0, MOVED])
        turned = element(np.roll(capacitances, -moves))
        expected = rotor_network(motor(), [turned, element()], arc()).states()
        np.testing.assert_array_equal(states.rows[state], expected.rows[0])
    assert state == 0
