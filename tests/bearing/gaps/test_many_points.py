"""Gaps of many points at once: each has the number that it has alone, and a refused one disturbs no other."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from ehlectric.bearing.ball_gaps import (
    UnitContact,
    around_directly,
    around_ellipse_directly,
    between_directly,
)
from ehlectric.bearing.gap_tables import (
    LEAST,
    around_ellipses,
    around_of_balls,
    around_of_rollers,
    between_domains,
    rigid_balls,
    rigid_rollers,
)
from ehlectric.bearing.gaps import (
    COARSE,
    FINE,
    LoadedContact,
    Raceway,
    RollerRaceway,
    groove_capacitance,
    match_film,
    outside_capacitance,
    roller_capacitance,
    roller_tails,
)
from ehlectric.bearing.ring_contacts import BALL_DOMAINS
from ehlectric.errors import InputError
from ehlectric.formulas.hertz import axis_ratio, dry_contact, line_gap, reduced_radius
from tests.helpers.each import each

D, PITCH = 11.906e-3, 60e-3  # 6208
E = 226e9
ANGLES = np.array([0.0, 0.1, -0.25, 0.4])


def race_of(angle=0.0, *, outer=False):
    return Raceway.of(D, PITCH, 0.53 if outer else 0.52, 0.19, outer=outer, contact_angle=angle)


def alone(race, number):
    return replace(race, contact_angle=float(race.contact_angle[number]))


def test_radii_are_those_of_a_catalogues_bearing():
    """Harris: 1/Rx = 2/D +- 2 cos a/(d_m -+ D cos a), upper signs inside, and 1/Ry = 2/D - 1/(f D)."""
    for outer, sign, groove in ((False, 1.0, 0.52), (True, -1.0, 0.53)):
        race, cosine = race_of(ANGLES, outer=outer), np.cos(ANGLES)
        rolling = 2.0 / D + sign * 2.0 * cosine / (PITCH - sign * D * cosine)
        assert race.radius_x == pytest.approx(1.0 / rolling, rel=1e-13)
        assert race.radius_y == pytest.approx(D / (2.0 - 1.0 / groove), rel=1e-13)


@each("outer", [False, True])
def test_rigid_balls(outer):
    race, gaps = race_of(ANGLES, outer=outer), np.geomspace(1e-7, 1e-4, 12).reshape(3, 4)
    found = groove_capacitance(race, gaps)
    expected = [[groove_capacitance(alone(race, k), float(g)) for k, g in enumerate(row)] for row in gaps]
    assert found == pytest.approx(np.array(expected), rel=1e-13, abs=0.0)


@each("outer", [False, True])
def test_loaded_balls(outer):
    """Offsets of films and capacitances around them; loads are the first axis, points the last one."""
    race, loads = race_of(ANGLES, outer=outer), np.array([20.0, 300.0, 3000.0])[:, np.newaxis]
    dry = dry_contact(loads, race.radius_x, np.full(4, race.radius_y), E)
    b, a = dry.semi_axis_x, dry.semi_axis_y
    x = b[..., np.newaxis] * np.array([-4.5, -4.5, 0.0, 1.5])
    y = a[..., np.newaxis] * np.array([0.0, 1.7, 1.7, 0.3])
    film = 3e-7 + x**2 / (2.0 * race.radius_x[:, np.newaxis]) + y**2 / (2.0 * race.radius_y)
    matched = match_film(race, dry, E, x=x, y=y, thickness=film)
    found = outside_capacitance(race, matched, (-4.5 * b, 1.5 * b, 1.75 * a))
    for m, k in np.ndindex(3, 4):
        one = dry_contact(float(loads[m, 0]), float(race.radius_x[k]), float(race.radius_y), E)
        single = match_film(alone(race, k), one, E, x=x[m, k], y=y[m, k], thickness=film[m, k])
        assert matched.offset[m, k] == pytest.approx(float(single.offset), rel=1e-9, abs=0.0)
        assert matched.mismatch[m, k] == pytest.approx(float(single.mismatch), rel=1e-8, abs=0.0)
        ends = (-4.5 * one.semi_axis_x, 1.5 * one.semi_axis_x, 1.75 * one.semi_axis_y)
        assert found[m, k] == pytest.approx(outside_capacitance(alone(race, k), single, ends), rel=1e-11)


def test_bearings_of_different_sizes():
    sizes = np.array([1.0, 2.0])
    race = Raceway.of(sizes * D, sizes * PITCH, np.array([0.52, 0.53]), 0.19, outer=False)
    one, two = race_of(), Raceway.of(2.0 * D, 2.0 * PITCH, 0.53, 0.19, outer=False)
    expected = [groove_capacitance(one, 1e-6), groove_capacitance(two, 1e-6)]
    assert groove_capacitance(race, 1e-6) == pytest.approx(expected, rel=1e-13)
    assert rigid_balls(race, np.full(2, 1e-6)) == pytest.approx(expected, rel=1e-13)
    with pytest.raises(InputError, match=r"0\.5"):
        Raceway.of(D, PITCH, np.array([0.52, 0.5]), 0.19, outer=False)


def test_a_contact_beyond_the_shoulder_is_marked():
    """The groove ends 50.6 degrees up: arccos(1 - 0.19/0.52)."""
    race = race_of(np.array([0.1, 1.0, -0.9]))
    assert race.holds.tolist() == [True, False, False]
    found = rigid_balls(race, 1e-6)
    assert np.isnan(found).tolist() == [False, True, True]
    assert found[0] == pytest.approx(groove_capacitance(race_of(0.1), 1e-6), rel=1e-13)


def contacts(number, *, outer, seed=2):
    """Contacts of many points under loads of a hundredth to all of some thousand newtons, and their films."""
    draw = np.random.default_rng(seed)
    race = race_of(draw.uniform(-0.15, 0.15, number), outer=outer)
    b = np.geomspace(0.25, 1.0, 8)[:, np.newaxis] * draw.uniform(6e-5, 1.5e-4, number)
    formula = np.exp(draw.uniform(np.log(5e-8), np.log(1e-6), number))
    unit = UnitContact.of(race.radius_x, np.full(number, race.radius_y))
    along = np.sqrt(2.0 * race.radius_x * formula) / b
    across = along * np.sqrt(unit.radius_ratio) / unit.ratio
    side = BALL_DOMAINS.side(unit.ratio)
    ends = (
        np.maximum(4.5, np.minimum(10.0 * along, 48.0)),
        np.maximum(1.5, np.minimum(along, 4.8)),
        np.maximum(side, np.minimum(1.0 + 4.0 * across, 24.0)),
    )
    return race, b, ends, formula * draw.uniform(0.7, 1.1, b.shape)


def direct(race, b, ends, films):
    """Integrals of some points, over eps0 for those inside a domain."""
    rx = np.broadcast_to(race.radius_x, b.shape).ravel()
    unit = UnitContact.of(rx, np.full(rx.shape, race.radius_y))
    middle = films.ravel() * rx / b.ravel() ** 2
    near = (np.full(rx.shape, 4.5), np.full(rx.shape, 1.5), BALL_DOMAINS.side(unit.ratio))
    between = between_directly(unit, near, tuple(end.ravel() for end in ends), middle)
    before, behind = around_ellipse_directly(unit.radius_ratio, middle, BALL_DOMAINS)
    around, _ = around_directly(race, b, (-ends[0], *ends[1:]), films)
    hertz = np.pi * unit.ratio / middle
    whole = around + 8.854e-12 * (rx * (between + before + behind + hertz)).reshape(b.shape)
    shape = b.shape
    return around, between.reshape(shape), before.reshape(shape), behind.reshape(shape), whole


@pytest.mark.slow
@pytest.mark.parametrize("outer", [False, True])
def test_polynomials_are_the_integrals(outer):
    """Differences over the capacitance of the whole contact, of its Hertz area and of all of its gap."""
    race, b, ends, films = contacts(400, outer=outer)
    middle = films * race.radius_x / b**2
    some = slice(0, 40)
    expected = direct(race.at(some), b[:, some], tuple(end[:, some] for end in ends), films[:, some])
    around, between, before, behind, whole = expected
    inside = 8.854e-12 * race.radius_x[some]
    assert np.min(ends[0]) == 4.5
    assert np.max(ends[0]) > 30.0
    found = around_of_balls(race, b, ends, films, BALL_DOMAINS)[:, some]
    assert np.max(np.abs(found - around) / whole) < 3e-8
    found = between_domains(race, ends, middle, BALL_DOMAINS)[:, some]
    assert np.max(inside * np.abs(found - between) / whole) < 1e-8
    for found, part in zip(around_ellipses(race, middle, BALL_DOMAINS), (before, behind), strict=True):
        assert found[:, some] == pytest.approx(part, rel=1e-8, abs=0.0)


def test_few_contacts_are_integrated():
    race, b, ends, films = contacts(3, outer=False)
    around, between, before, behind, _ = direct(race, b, ends, films)
    middle = films * race.radius_x / b**2
    assert b.size < LEAST
    assert around_of_balls(race, b, ends, films, BALL_DOMAINS) == pytest.approx(around, rel=1e-12)
    assert between_domains(race, ends, middle, BALL_DOMAINS) == pytest.approx(between, rel=1e-12)
    alone = around_ellipses(race.at(0), middle[:, 0], BALL_DOMAINS)
    assert alone[0] == pytest.approx(before[:, 0], rel=1e-12)
    assert alone[1] == pytest.approx(behind[:, 0], rel=1e-12)
    # Several points share polynomials, whose box does not depend on their number.
    together = around_ellipses(race, middle, BALL_DOMAINS)
    assert together[0] == pytest.approx(before, rel=6e-9)
    assert together[1] == pytest.approx(behind, rel=6e-9)


def test_coarse_nodes():
    """Fine ones are compared with a finer quadrature in test_groove.py."""
    race, b, ends, films = contacts(6, outer=False)
    fine, coarse = (
        around_directly(race, b, (-ends[0], *ends[1:]), films, nodes=nodes)[0] for nodes in (FINE, COARSE)
    )
    assert coarse == pytest.approx(fine, rel=1e-5, abs=0.0)


@pytest.mark.slow
@pytest.mark.parametrize("outer", [False, True])
def test_polynomials_of_rigid_balls_are_the_integrals(outer):
    race, gaps = race_of(np.linspace(-0.15, 0.15, 40), outer=outer), np.geomspace(2e-8, 5e-5, 30)
    found = rigid_balls(race, gaps[:, np.newaxis] * np.linspace(1.0, 1.5, 40))
    some = slice(0, 40, 13)
    expected = groove_capacitance(race.at(some), gaps[:, np.newaxis] * np.linspace(1.0, 1.5, 40)[some])
    assert found[:, some] == pytest.approx(expected, rel=6e-9, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
def test_a_refused_contact_disturbs_no_other():
    race, b, ends, films = contacts(400, outer=False)
    found = around_of_balls(race, b, ends, films, BALL_DOMAINS)
    gone, other = b.copy(), films.copy()
    gone[2, 5], other[7, 300] = np.nan, np.nan
    again = around_of_balls(race, gone, ends, other, BALL_DOMAINS)
    assert np.argwhere(np.isnan(again)).tolist() == [[2, 5], [7, 300]]
    known = ~np.isnan(again)
    assert again[known] == pytest.approx(found[known], rel=1e-12)


@pytest.mark.slow
@pytest.mark.gate
def test_a_domain_that_reaches_the_shoulder_is_integrated():
    """At 0.45 rad a shoulder at 0.883 rad is 2.7 mm away; long domains of light contacts are wider."""
    race, b, ends, films = contacts(400, outer=False)
    wide = replace(race, contact_angle=np.full(400, 0.45))
    some = slice(0, 30)
    side = ends[2] * axis_ratio(wide.radius_x[0], float(wide.radius_y)) * b
    beyond = (side / wide.groove_radius + 0.45 > wide.shoulder_angle)[:, some]
    assert 0.0 < beyond.mean() < 1.0
    found = around_of_balls(wide, b, ends, films, BALL_DOMAINS)[:, some]
    chosen = tuple(end[:, some] for end in ends)
    expected, _ = around_directly(wide.at(some), b[:, some], (-chosen[0], *chosen[1:]), films[:, some])
    assert found[beyond] == pytest.approx(expected[beyond], rel=1e-12)


@each("outer", [False, True])
def test_many_rigid_balls(outer):
    draw = np.random.default_rng(3)
    race = race_of(draw.uniform(-0.3, 0.3, 90), outer=outer)
    gaps = np.exp(draw.uniform(np.log(1e-7), np.log(8e-5), (6, 90)))
    gaps[1, 1] = np.nan
    found = rigid_balls(race, gaps)
    assert np.argwhere(np.isnan(found)).tolist() == [[1, 1]]
    known = ~np.isnan(gaps)
    expected = groove_capacitance(race, np.where(known, gaps, 1e-6))
    assert found[known] == pytest.approx(expected[known], rel=2e-8, abs=0.0)


RACES = [RollerRaceway(5.5e-3, 27.25e-3, outer=False), RollerRaceway(5.5e-3, 38.25e-3, outer=True)]


@pytest.mark.parametrize("race", RACES)
def test_rollers(race):
    """Rollers at gaps and films on short and long domains, of which some are longer than the raceway."""
    draw = np.random.default_rng(4)
    gaps = np.exp(draw.uniform(np.log(1e-7), np.log(8e-5), 300))
    singles = [roller_capacitance(race, gap) for gap in gaps[:20].tolist()]
    assert roller_capacitance(race, gaps[:20]) == pytest.approx(singles, rel=1e-13)
    assert rigid_rollers(race, gaps) == pytest.approx(roller_capacitance(race, gaps), rel=2e-8, abs=0.0)

    b = np.exp(draw.uniform(np.log(2e-5), np.log(3e-4), (4, 200)))
    films = np.exp(draw.uniform(np.log(5e-8), np.log(2e-6), 200))
    radius = reduced_radius(race.roller_radius, -1.0 / race.curvature)
    length = np.sqrt(2.0 * radius * films) / b
    inlet, outlet = np.maximum(4.0, np.minimum(10.0 * length, 300.0)), np.maximum(2.0, 2.0 * length)
    inlet[0, 0] = 200.0 * race.roller_radius / b[0, 0]
    ends = films + b**2 / radius * line_gap(inlet), films + b**2 / radius * line_gap(outlet)
    tails = roller_tails(race, b, (-b * inlet, b * outlet), ends)
    assert tails[0][0, 0] == 0.0
    whole = tails[0] + tails[1] + 2.0 * 8.854e-12 * b / films
    found = around_of_rollers(race, b, (inlet, outlet), films)
    assert np.max(np.abs(found - tails[0] - tails[1]) / whole) < 3e-8
    for m, k in ((0, 0), (1, 3), (3, 150)):
        domain = (-float(b[m, k] * inlet[m, k]), float(b[m, k] * outlet[m, k]))
        one = roller_tails(race, float(b[m, k]), domain, (float(ends[0][m, k]), float(ends[1][m, k])))
        assert [tails[0][m, k], tails[1][m, k]] == pytest.approx(one, rel=1e-12)


def test_an_offset_of_many_values():
    """A contact that is held with several offsets has the sums of each."""
    race, dry = race_of(0.1), dry_contact(600.0, 4.77e-3, 154.8e-3, E)
    offsets = np.array([1e-7, 5e-7]) - dry.approach
    ends = (-4.5 * dry.semi_axis_x, 1.5 * dry.semi_axis_x, 1.75 * dry.semi_axis_y)
    found = outside_capacitance(race, LoadedContact(dry, E, offsets, 0.0), ends)
    for offset, one in zip(offsets.tolist(), found, strict=True):
        assert one == pytest.approx(
            outside_capacitance(race, LoadedContact(dry, E, offset, 0.0), ends), rel=1e-12
        )


@pytest.mark.parametrize("state", list(itertools.product(range(3), repeat=3)))
def test_the_length_from_which_ends_follow_is_found_again(state):
    unit = UnitContact.of(4e-3, np.array([0.05, 0.3, 2.0]))
    length = np.array([0.3, 1.2, 2.5])
    ends = BALL_DOMAINS.ends(state, length, unit)
    expected = length if 1 in state else np.ones(3)
    assert np.broadcast_to(BALL_DOMAINS.length(state, ends, unit), (3,)) == pytest.approx(expected, rel=1e-12)
