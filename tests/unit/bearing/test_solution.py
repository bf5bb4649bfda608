"""Contacts of all elements with a ring, between and beyond the loads that were solved, by laws of Hertz."""

import numpy as np
import pytest

from ehlectric.bearing.ring_contacts import ContactCurve
from ehlectric.bearing.solution import ring_state
from ehlectric.formulas.hertz import dry_contact, line_half_width, line_max_pressure
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, contact_solution, rigid_capacitance, ring_of

FILM = 6e-7


def curve_of(axes_and_pressure, loads):
    """Contacts with the dry ones of their loads and films of a power of it."""
    rows = []
    for load in loads:
        b, a, pressure = axes_and_pressure(load)
        film = FILM * (load / loads[0]) ** -0.07
        rows.append(
            contact_solution(
                load=load, max_pressure=pressure, semi_axis_x=b, semi_axis_y=a, minimum_thickness=0.9 * film,
                central_thickness=film, inside=2e-11 * load**0.4, outside_oil=1.2e-11, outside_air=5e-12,
                plate=1e-11, strength_per_volt=1.0 / (0.9 * film), breakdown_voltage=15e6 * 0.9 * film,
                error=0.01, moes_m=10.0, moes_l=10.0, mismatch=0.0, converged=True, warnings=(),
            )
        )  # fmt: skip
    return ContactCurve.of(tuple(rows))


def state_of(tables, axes_and_pressure, load, gap, **changes):
    ring = ring_of(bearing_case(tables, **changes), speed=4.5)
    curve = curve_of(axes_and_pressure, [10.0, 100.0, 1000.0])
    state = ring_state(ring, curve, load=np.array(load), gap=np.array(gap))
    return state, lambda apart: rigid_capacitance(ring, apart)


def of_balls(load):
    dry = dry_contact(load, 5e-3, 0.15, 226e9)
    return dry.semi_axis_x, dry.semi_axis_y, dry.max_pressure


def of_rollers(load):
    width = load / 10e-3
    return line_half_width(width, 5e-3, 226e9), 5e-3, line_max_pressure(width, 5e-3, 226e9)


@pytest.mark.parametrize(("tables", "law"), [(BALLS, of_balls), (ROLLERS, of_rollers)])
def test_every_load_has_its_own_dry_contact(tables, law):
    """Powers of the load, 1/3 of an ellipse and 1/2 of a line, below the least load that was solved too."""
    loads = [0.01, 1.0, 10.0, 55.0, 1000.0]
    state, _ = state_of(tables, law, loads, np.zeros(5))
    expected = np.array([law(load) for load in loads]).T
    np.testing.assert_allclose(state.values.semi_axis_x, expected[0], rtol=1e-9)
    np.testing.assert_allclose(state.values.semi_axis_y, expected[1], rtol=1e-9)
    np.testing.assert_allclose(state.values.max_pressure, expected[2], rtol=1e-9)
    # Films and what goes with them are those of the least one there.
    films = FILM * np.maximum(1.0, np.array(loads) / 10.0) ** -0.07
    np.testing.assert_allclose(state.values.central_thickness, films, rtol=1e-9)
    np.testing.assert_allclose(state.values.minimum_thickness, 0.9 * films, rtol=1e-9)
    np.testing.assert_allclose(state.values.breakdown_voltage, 15e6 * 0.9 * films, rtol=1e-9)
    np.testing.assert_allclose(state.values.strength_per_volt, 1.0 / (0.9 * films), rtol=1e-9)
    np.testing.assert_allclose(state.values.inside, 2e-11 * np.maximum(10.0, loads) ** 0.4, rtol=1e-9)
    np.testing.assert_allclose(state.capacitance("oil"), state.values.inside + 1.2e-11, rtol=1e-9)
    np.testing.assert_allclose(state.capacitance("air"), state.values.inside + 5e-12, rtol=1e-9)


@pytest.mark.parametrize(("tables", "law"), [(BALLS, of_balls), (ROLLERS, of_rollers)])
def test_no_gap_is_narrower_than_the_film_of_the_least_load(tables, law):
    """0.6 um where bodies are 0.1 um apart; 20 um stay 20 um. Of strength times gap, and no Hertz contact."""
    state, rigid = state_of(tables, law, [100.0, 0.0, 0.0], [0.0, 1e-7, 2e-5])
    np.testing.assert_array_equal(state.solved, [True, False, False])
    for k, apart in ((1, FILM), (2, 2e-5)):
        assert state.values.central_thickness[k] == pytest.approx(apart, rel=1e-12, abs=0.0)
        assert state.values.minimum_thickness[k] == pytest.approx(apart, rel=1e-12, abs=0.0)
        assert state.values.breakdown_voltage[k] == pytest.approx(15e6 * apart, rel=1e-12, abs=0.0)
        assert state.values.strength_per_volt[k] == pytest.approx(1.0 / apart, rel=1e-12, abs=0.0)
        assert state.capacitance("air")[k] == pytest.approx(rigid(apart), rel=1e-12, abs=0.0)
        assert state.capacitance("oil")[k] == pytest.approx(2.4 * rigid(apart), rel=1e-12, abs=0.0)
        nothing = [
            state.values.max_pressure[k],
            state.values.semi_axis_x[k],
            state.values.semi_axis_y[k],
            state.values.plate[k],
        ]
        assert nothing == [0.0] * 4
    np.testing.assert_array_equal(state.gap, [0.0, 1e-7, 2e-5])


def test_without_a_strength_gaps_do_not_break():
    state, _ = state_of(BALLS, of_balls, [100.0, 0.0], [0.0, 1e-5], discharge=None)
    assert state.values.breakdown_voltage[1] == np.inf
