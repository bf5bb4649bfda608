"""Domains of a bearing's contacts: as long as what their pressure builds up over, sqrt(2 R h), by hand."""

import math

import numpy as np
import pytest

from ehlectric import BearingCase, solve
from ehlectric.bearing.preparation import least_load
from ehlectric.cases.grid_inputs import Grid
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.formulas.film_line import LineContact, moes
from ehlectric.formulas.film_point import PointContact, nijenbanning_venner_moes
from ehlectric.formulas.hertz import dry_contact
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, changed, contact_case, contact_of, ring_of
from tests.helpers.each import each
from tests.helpers.oils import alpha_star
from tests.helpers.places import EXAMPLES

D, PITCH, ROLLER, LENGTH = 11.906e-3, 60e-3, 11e-3, 10e-3
MODULUS = 208e9 / (1.0 - 0.3**2)
VISCOSITY = 14.847e-6 * 838.90
ALPHA = alpha_star(0.67 * (math.log(VISCOSITY) + 9.67) / 0.198e9)
SPEED = 4.5
UNLIKE = changed(BALLS, bearing__outer_groove=0.53)


def of(tables, *, inner):
    return ring_of(bearing_case(tables), inner=inner, speed=SPEED)


def roller(load, *, inner):
    """Half-width and the length sqrt(2 R h) of a roller's contact [m]."""
    sign = 1.0 if inner else -1.0
    radius = 1.0 / (2.0 / ROLLER + sign * 2.0 / (PITCH - sign * ROLLER))
    film = moes(
        LineContact(
            reduced_radius=radius,
            reduced_modulus=MODULUS,
            load_per_length=load / LENGTH,
            entrainment_speed=SPEED,
            viscosity=VISCOSITY,
            pressure_viscosity_coefficient=ALPHA,
        )
    ).central_thickness
    return math.sqrt(8.0 * load / LENGTH * radius / (math.pi * MODULUS)), math.sqrt(2.0 * radius * film)


def ball(load, *, inner):
    """Semi-axes and the lengths along and across of a ball's contact [m]."""
    sign, groove = (1.0, 0.52) if inner else (-1.0, 0.53)
    rx = 1.0 / (2.0 / D + sign * 2.0 / (PITCH - sign * D))
    ry = 1.0 / (2.0 / D - 1.0 / (groove * D))
    contact = PointContact(
        radius_x=rx,
        radius_y=ry,
        reduced_modulus=MODULUS,
        load=load,
        entrainment_speed=SPEED,
        viscosity=VISCOSITY,
        pressure_viscosity_coefficient=ALPHA,
    )
    film = nijenbanning_venner_moes(contact).central_thickness
    dry = dry_contact(load, rx, ry, MODULUS)
    return dry.semi_axis_x, dry.semi_axis_y, math.sqrt(2.0 * rx * film), math.sqrt(2.0 * ry * film)


@pytest.mark.parametrize("inner", [True, False])
def test_heavy_contacts_have_the_domain_of_others(inner):
    """4 and 2 half-widths of a roller; 4.5 and 1.5 semi-axes of a ball, across 1.6 + 1.4/k of them."""
    found = contact_of(of(ROLLERS, inner=inner), 20e3).grid
    assert found == Grid(inlet=-4.0, outlet=2.0, nodes=801, field_range=(-1.25, 1.25), refine=0.02)
    found = contact_of(of(UNLIKE, inner=inner), 5000.0).grid
    b, a, _, _ = ball(5000.0, inner=inner)
    assert (found.inlet, found.outlet, found.nodes, found.field_side) == (-4.5, 1.5, 129, 1.25)
    assert found.side == pytest.approx(1.6 + 1.4 * b / a, rel=1e-9, abs=0.0)


@pytest.mark.parametrize("inner", [True, False])
def test_a_light_rollers_domain(inner):
    """Ten lengths before it and two behind, with sixteen nodes over its contact."""
    load = 60.0
    found = contact_of(of(ROLLERS, inner=inner), load).grid
    b, length = roller(load, inner=inner)
    assert length > b
    assert -found.inlet * b == pytest.approx(10.0 * length, rel=1e-4, abs=0.0)
    assert found.outlet * b == pytest.approx(2.0 * length, rel=1e-4, abs=0.0)
    assert 2.0 * (found.nodes - 1) / (found.outlet - found.inlet) >= 16.0
    np.testing.assert_allclose(np.array(found.field_range) * b, [-length, length], rtol=1e-4)
    # A hardly loaded one has eight lengths beyond a hundred half-widths, and three hundred at the most.
    for hardly in (5.0, 1.6):
        b, length = roller(hardly, inner=inner)
        expected = min(10.0 * length, max(100.0 * b, 8.0 * length), 300.0 * b)
        inlet = -contact_of(of(ROLLERS, inner=inner), hardly).grid.inlet * b
        assert inlet == pytest.approx(expected, rel=1e-4, abs=0.0)
        # Where the roller falls away from its parabola, at half of its radius, the domain would end too.
        assert inlet < 0.25 * ROLLER


@pytest.mark.parametrize("inner", [True, False])
def test_a_light_balls_domain(inner):
    """Ten lengths before it and one behind; beside it four of those across, from the ellipse's end."""
    load = 10.0
    found = contact_of(of(UNLIKE, inner=inner), load).grid
    b, a, along, across = ball(load, inner=inner)
    assert -found.inlet * b == pytest.approx(10.0 * along, rel=1e-4, abs=0.0)
    assert found.outlet * b == pytest.approx(max(1.5 * b, along), rel=1e-4, abs=0.0)
    assert found.side * a == pytest.approx(a + 4.0 * across, rel=1e-4, abs=0.0)
    # Eight cells over each semi-axis, or 256 in all.
    assert found.nodes - 1 >= 8.0 * (found.outlet - found.inlet)
    assert found.nodes - 1 >= 16.0 * found.side
    # What a grid holds: 48 semi-axes before and 24 beside.
    hardly = contact_of(of(UNLIKE, inner=inner), 1e-3).grid
    ends = [hardly.inlet, hardly.outlet, hardly.side]
    assert ends == pytest.approx([-48.0, 4.8, 24.0], rel=1e-12, abs=0.0)


@pytest.mark.parametrize("inner", [True, False])
def test_the_least_load_is_the_first_that_fits(inner):
    """Its lengths fit into the domain's end, those of a slightly smaller load do not."""
    least = least_load(of(ROLLERS, inner=inner))

    def fits(load):
        b, length = roller(load, inner=inner)
        return min(10.0 * length, max(100.0 * b, 8.0 * length)) <= min(0.25 * ROLLER, 300.0 * b)

    assert fits(1.00001 * least)
    assert not fits(0.99999 * least)


@each("inner", [True, False])
@each("load", [1e-3, 1.0, 30.0, 900.0])
def test_cases_take_these_domains(inner, load):
    """In the units of the case: half-widths, or semi-axes along and across."""
    for tables in (UNLIKE, ROLLERS):
        made = contact_case(of(tables, inner=inner), load, {})
        # Grids are refined until the estimated error of the least film is below 2 %.
        assert made.grid.refine == 0.02
        if tables is ROLLERS:
            assert resolve(made).half_width == pytest.approx(roller(load, inner=inner)[0], rel=1e-9, abs=0.0)
        else:
            conditions, (b, a, *_) = resolve_point(made), ball(load, inner=inner)
            assert [conditions.semi_axis_x, conditions.semi_axis_y] == pytest.approx(
                [b, a], rel=1e-9, abs=0.0
            )


def test_films_of_light_contacts_change_with_the_speed_without_steps():
    """The least load that is solved was one of 10^0.1 to the other: from 0.83 to 0.57 um within 10 rpm."""
    films = []
    for speed in (2180.0, 2190.0, 2200.0):
        case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
        case = case.replace({"contacts": "atlas", "bearing.inner_speed": f"{speed:g} rpm"})
        curve = solve(case).solution.outer_curve
        films.append(curve.at(curve.loads[:1]).central_thickness[0])
    assert films[2] / films[0] == pytest.approx(1.0, abs=0.02)
    assert films[1] / films[0] == pytest.approx(1.0, abs=0.01)
