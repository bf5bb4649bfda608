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


def state_of(tables, axes_and_pressure, load, gap, room=None, **changes):
    ring = ring_of(bearing_case(tables, **changes), speed=4.5)
    curve = curve_of(axes_and_pressure, [10.0, 100.0, 1000.0])
    gap = np.array(gap)
    state = ring_state(
        ring, curve, load=np.array(load), gap=gap, room=gap if room is None else np.array(room)
    )
    return state, lambda apart: rigid_capacitance(ring, apart)


def of_balls(load):
    dry = dry_contact(load, 5e-3, 0.15, 226e9)
    return dry.semi_axis_x, dry.semi_axis_y, dry.max_pressure


def of_rollers(load):
    width = load / 10e-3
    return (
        line_half_width(load_per_length=width, radius=5e-3, modulus=226e9),
        5e-3,
        line_max_pressure(load_per_length=width, radius=5e-3, modulus=226e9),
    )


# Film of the largest load. An element that touches without a load has the film of twice this film.
THIN = FILM * 100.0**-0.07

KINDS = pytest.mark.parametrize(("tables", "law"), [(BALLS, of_balls), (ROLLERS, of_rollers)])


@KINDS
def test_every_load_has_its_own_dry_contact(tables, law):
    """Powers of the load, 1/3 of an ellipse and 1/2 of a line, also below the least solved load."""
    loads = [0.01, 1.0, 10.0, 55.0, 1000.0]
    state, _ = state_of(tables, law, loads, np.zeros(5), room=np.full(5, 1e-3))
    expected = np.array([law(load) for load in loads]).T
    np.testing.assert_allclose(state.values.semi_axis_x, expected[0], rtol=1e-9)
    np.testing.assert_allclose(state.values.semi_axis_y, expected[1], rtol=1e-9)
    np.testing.assert_allclose(state.values.max_pressure, expected[2], rtol=1e-9)
    # From the least solved load on, films and what goes with them are those of the curve.
    films = FILM * (np.array(loads[2:]) / 10.0) ** -0.07
    np.testing.assert_allclose(state.values.central_thickness[2:], films, rtol=1e-9)
    np.testing.assert_allclose(state.values.minimum_thickness[2:], 0.9 * films, rtol=1e-9)
    np.testing.assert_allclose(state.values.breakdown_voltage[2:], 15e6 * 0.9 * films, rtol=1e-9)
    np.testing.assert_allclose(state.values.strength_per_volt[2:], 1.0 / (0.9 * films), rtol=1e-9)
    np.testing.assert_allclose(state.values.inside[2:], 2e-11 * np.array(loads[2:]) ** 0.4, rtol=1e-9)
    np.testing.assert_allclose(state.capacitance("oil")[2:], state.values.inside[2:] + 1.2e-11, rtol=1e-9)
    np.testing.assert_allclose(state.capacitance("air")[2:], state.values.inside[2:] + 5e-12, rtol=1e-9)


@pytest.mark.parametrize(("tables", "law", "exponent"), [(BALLS, of_balls, 2.0), (ROLLERS, of_rollers, 1.0)])
def test_light_films_become_those_of_rigid_bodies(tables, law, exponent):
    """Isoviscous oil between rigid bodies: 1/Q^2 of a ball and, by Martin, 1/Q of a roller."""
    loads = np.array([10.0, 9.999999, 0.6, 0.3])
    state, rigid = state_of(tables, law, loads, np.zeros(4), room=np.full(4, 1e-2))
    films = state.values.central_thickness
    assert films[1] == pytest.approx(films[0], rel=1e-6)
    assert films[3] / films[2] == pytest.approx(2.0**exponent, rel=0.01)
    assert state.values.breakdown_voltage / films == pytest.approx(0.9 * 15e6, rel=1e-9)
    # Capacitances change as those of rigid bodies with these gaps.
    ratio = rigid(films[3]) / rigid(films[2])
    assert state.capacitance("oil")[3] / state.capacitance("oil")[2] == pytest.approx(ratio, rel=1e-9)


@KINDS
def test_an_element_without_a_load_has_its_gap(tables, law):
    """20 um stay 20 um. Where bodies touch, the gap is twice the film of the largest load, and 0.1 um
    widen it by the square. Of strength times gap, and no Hertz contact.
    """
    state, rigid = state_of(tables, law, [100.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1e-7, 2e-5])
    np.testing.assert_array_equal(state.solved, [True, False, False, False])
    touching = 2.0 * THIN
    for k, apart in ((1, touching), (2, touching + 1e-14 / (4.0 * touching)), (3, 2e-5)):
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
    np.testing.assert_array_equal(state.gap, [0.0, 0.0, 1e-7, 2e-5])


@KINDS
def test_no_film_is_thicker_than_the_room_of_its_element(tables, law):
    """A ball that is pressed by 1 mN in a clearance of 20 um; thin films do not depend on the room."""
    state, _ = state_of(tables, law, [1e-3, 1e-3, 1000.0, 1000.0], np.zeros(4), room=[2e-5, 2e-6, 2e-6, 0.0])
    assert state.values.central_thickness == pytest.approx([2e-5, 2e-6, THIN, THIN], rel=2e-8)


@KINDS
def test_an_element_lifts_off_without_a_jump(tables, law):
    """From 0.1 mN without a gap to a gap of 0.1 nm without a load; the curve bends, and has no step."""
    loads, gaps = [1e-1, 1e-4, 1e-7, 0.0, 0.0], [0.0, 0.0, 0.0, 1e-10, 1e-8]
    state, _ = state_of(tables, law, loads, gaps)
    for values in (
        state.capacitance("oil"),
        state.capacitance("air"),
        state.values.central_thickness,
        state.values.minimum_thickness,
        state.values.breakdown_voltage,
        state.values.strength_per_volt,
    ):
        assert values[1:] == pytest.approx(values[3], rel=1e-3)


@KINDS
def test_films_change_little_with_a_little_load(tables, law):
    """By not more than the fourth power of the load, from 10 N down to nothing."""
    loads = np.geomspace(1e-4, 10.0, 20001)
    state, _ = state_of(tables, law, loads, np.zeros(20001), room=np.full(20001, 5e-6))
    for values in (state.values.central_thickness, state.values.breakdown_voltage):
        assert np.max(np.abs(np.diff(np.log(values)))) < 4.0 * np.log(loads[1] / loads[0])
        assert np.all(np.isfinite(values))


def test_without_a_strength_gaps_do_not_break():
    state, _ = state_of(BALLS, of_balls, [100.0, 0.0], [0.0, 1e-5], discharge=None)
    assert state.values.breakdown_voltage[1] == np.inf
