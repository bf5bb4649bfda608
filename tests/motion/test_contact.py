"""Where roughness that moves is at a time: against the case's own, by hand, and at both signs of speed."""

import math

import numpy as np
import pytest

from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.problems import domain_of, heights_of
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.surfaces import generated_profiles as generators
from ehlectric.surfaces.rough_surfaces import rough_maps, rough_surfaces
from tests.helpers.each import each
from tests.helpers.moving_cases import LINE, POINT, moving

SRR = "contact.slide_to_roll_ratio"
# b = 4 R p_h/E', of a line contact.
HALF_WIDTH = 4.0 * 14.1e-3 * 0.5e9 / 226e9
# a^3 = 3 F R/(2 E'), of a sphere of radius r on a plane; 1/R = 1/r along and across, so that R = r/2 there.
SEMI_AXIS = (3.0 * 20.0 * 5e-3 / 226e9) ** (1.0 / 3.0)

WAVES = {"generator": "sinusoid", "amplitude": 2e-8, "wavelength": 7e-5, "phase": 0.3}
RANDOM = {"generator": "gaussian", "rq": 1e-8, "correlation_length": 2e-5, "seed": 5}
BUMP = {"generator": "asperity", "height": 5e-8, "width": 6e-5}
PIT = {"generator": "pit", "depth": 1e-7, "width": 9e-5}
# Speeds of surface 1 and 2 over the mean, by the slide-to-roll ratio.
SPEEDS = {0.0: (1.0, 1.0), 1.0: (1.5, 0.5), -1.0: (0.5, 1.5), 6.0: (4.0, -2.0), -6.0: (-2.0, 4.0)}


def rough(*tables):
    """The roughness of a case: tables with the number of their surface."""
    return {"roughness": [{"surface": surface} | table for surface, table in tables]}


def of_case(case, *axes):
    """Heights as the case has them, which a film at rest is solved with."""
    if case.contact.geometry == "point":
        conditions = resolve_point(case)
        surfaces = rough_maps(case.roughness, domain_of(case, conditions))
        return heights_of(surfaces, *(conditions.semi_axis_x * axis for axis in axes))
    conditions = resolve(case)
    return heights_of(
        rough_surfaces(case.roughness, domain_of(case, conditions)), conditions.half_width * axes[0]
    )


@pytest.mark.slow
@pytest.mark.parametrize("ratio", SPEEDS)
@pytest.mark.parametrize("surface", [1, 2])
@pytest.mark.parametrize(
    ("table", "shape"),
    [
        (LINE, WAVES),
        (LINE, RANDOM),
        (LINE, BUMP | {"position": 5e-5}),
        (POINT, PIT | {"position_y": 4e-5}),
    ],
)
def test_once_everything_lies_as_the_case_has_it(table, shape, surface, ratio):
    lies_as_the_case_has_it(table, shape, surface, ratio)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", SPEEDS)
@pytest.mark.parametrize("surface", [1, 2])
def test_once_it_lies_a_random_map_is_that_of_the_case(surface, ratio):
    lies_as_the_case_has_it(POINT, RANDOM, surface, ratio)


def lies_as_the_case_has_it(table, shape, surface, ratio):
    case = moving(table, {SRR: ratio}, **rough((surface, shape)), motion={"passes": 4.0})
    motion, speed = TransientContact.of(case), SPEEDS[ratio][surface - 1]
    grid = case.grid
    # The length of the domain at its own speed.
    assert motion.schedule.coincident == pytest.approx(grid.length / abs(speed), rel=1e-14)
    x = np.linspace(*grid.ends, 101)
    axes = (x, np.linspace(-3.0, 3.0, 41)) if table is POINT else (x,)
    expected = of_case(case, *axes)
    # But the front, one half-width at the far end.
    behind = x <= grid.ends[1] - 1.0 if speed > 0.0 else x >= grid.ends[0] + 1.0
    found = motion.roughness.heights(motion.schedule.coincident, *axes)
    largest = np.max(np.abs(expected))
    assert largest > 0.0
    np.testing.assert_allclose(found[:, behind], expected[:, behind], rtol=0.0, atol=1e-9 * largest)
    assert not np.any(found[2 - surface])


@each("ratio", SPEEDS)
@each("table, shape", [(LINE, WAVES), (POINT, WAVES)])
def test_nothing_is_there_at_first(table, shape, ratio):
    case = moving(table, {SRR: ratio}, **rough((1, shape), (2, shape)), motion={"passes": 2.0})
    motion = TransientContact.of(case)
    x = np.linspace(*case.grid.ends, 101)
    axes = (x, np.linspace(-3.0, 3.0, 5)) if table is POINT else (x,)
    assert not np.any(motion.roughness.heights(0.0, *axes))
    assert not np.any(motion.moving_gap(0.0, x, np.linspace(-3.0, 3.0, 5) if table is POINT else np.zeros(1)))
    # And soon after something at the ends from which it comes, and nowhere else.
    soon = motion.roughness.heights(0.05, *axes)
    for surface, speed in enumerate(SPEEDS[ratio]):
        near = x <= -4.0 + 0.05 * speed if speed > 0.0 else x >= case.grid.ends[1] + 0.05 * speed
        near = x <= case.grid.ends[0] + 0.05 * speed if speed > 0.0 else near
        assert np.any(soon[surface][near])
        assert not np.any(soon[surface][~near])


@each("ratio, time", [(0.0, 2.6), (1.0, 1.7), (6.0, 0.55), (-6.0, 1.3)])
def test_waves_behind_their_front(ratio, time):
    """Amplitude sin(2 pi (b (X - s))/wavelength + phase), s the way of what began one domain away."""
    case = moving(LINE, {SRR: ratio}, **rough((1, WAVES)), motion={"passes": 3.0})
    motion, speed = TransientContact.of(case), SPEEDS[ratio][0]
    assert motion.half_width == pytest.approx(HALF_WIDTH, rel=1e-12)
    x = np.linspace(-4.0, 2.0, 301)
    away = speed * time - 6.0 if speed > 0.0 else speed * time + 6.0
    waves = 2e-8 * np.sin(2.0 * np.pi * HALF_WIDTH * (x - away) / 7e-5 + 0.3)
    # The front began at the end at which it comes in; a quarter of a wave of sin^2 over one half-width.
    depth = -4.0 + speed * time - x if speed > 0.0 else x - (2.0 + speed * time)
    rise = np.where(depth <= 0.0, 0.0, np.where(depth >= 1.0, 1.0, 0.5 - 0.5 * np.cos(np.pi * depth)))
    assert 0.0 < np.mean(rise) < 1.0
    np.testing.assert_allclose(motion.roughness.heights(time, x)[0], waves * rise, rtol=0.0, atol=1e-18)


@each("ratio", SPEEDS)
@each("part", [0.4, 0.9])
@each("table", [LINE, POINT])
def test_two_surfaces_travel_each_at_its_own_speed(table, ratio, part):
    """Their tops, one domain away from the centre at first, on the side from which the surface comes."""
    case = moving(table, {SRR: ratio}, **rough((1, BUMP), (2, BUMP)), motion={"passes": 1.0})
    motion = TransientContact.of(case)
    assert motion.schedule.end == 6.0
    x = np.linspace(*case.grid.ends, 6001)
    heights = motion.roughness.heights(6.0 * part, *((x, np.zeros(1)) if table is POINT else (x,)))
    for surface, speed in enumerate(SPEEDS[ratio]):
        top = speed * 6.0 * part - math.copysign(6.0, speed)
        if case.grid.ends[0] < top < case.grid.ends[1] - 1.0:
            found = heights[surface].ravel()
            assert x[np.argmax(found)] == pytest.approx(top, abs=1e-3)
            assert np.max(found) == pytest.approx(5e-8, rel=1e-4)


def test_heights_of_one_surface_add():
    both = TransientContact.of(moving(**rough((1, WAVES), (1, BUMP), (2, PIT))))
    alone = [
        TransientContact.of(moving(**rough((1, WAVES)))),
        TransientContact.of(moving(**rough((1, BUMP)))),
    ]
    x = np.linspace(-4.0, 2.0, 65)
    expected = sum(motion.roughness.heights(5.5, x)[0] for motion in alone)
    np.testing.assert_allclose(both.roughness.heights(5.5, x)[0], expected, atol=1e-20)


@pytest.mark.parametrize("table", [LINE, POINT])
def test_a_surface_at_rest_stays(table):
    """Surface 2, with its waves; only the bump of surface 1 moves, twice as fast as the mean."""
    case = moving(table, {SRR: 2.0}, **rough((1, BUMP), (2, WAVES)))
    motion = TransientContact.of(case)
    x, y = np.linspace(*case.grid.ends, 61), np.linspace(-3.0, 3.0, 5)
    axes = (x, y) if table is POINT else (x,)
    resting = of_case(case, *axes)[1]
    for time in (0.0, 1.0, 3.0, 6.0):
        np.testing.assert_allclose(motion.roughness.heights(time, *axes)[1], resting, rtol=1e-12)
    scale = motion.conditions.thickness_scale
    across = y if table is POINT else np.zeros(1)
    standing = motion.problem.added_gap(x, across)
    np.testing.assert_allclose(standing, -resting.reshape(standing.shape) / scale, rtol=1e-12)
    gap = motion.moving_gap(3.0, x, across)
    # As the case has it again: 2 u T = D.
    expected = -motion.roughness.heights(3.0, *axes)[0].reshape(gap.shape) / scale
    np.testing.assert_allclose(gap, expected, rtol=1e-12, atol=1e-12)
    assert motion.schedule.coincident == 3.0
    assert np.max(-gap) == pytest.approx(5e-8 / scale, rel=1e-3)


@pytest.mark.parametrize(("table", "scale"), [(LINE, HALF_WIDTH**2 / 14.1e-3), (POINT, SEMI_AXIS**2 / 10e-3)])
def test_peaks_narrow_the_gap_by_their_height_over_the_scale(table, scale):
    """H = h R/b^2, of a point contact h Rx/a^2; both surfaces count, and nothing stands still."""
    case = moving(table, **rough((1, BUMP), (2, BUMP | {"height": 2e-8})))
    motion = TransientContact.of(case)
    gap = motion.moving_gap(6.0, np.zeros(1), np.zeros(1))
    assert gap.shape == (1, 1)
    assert gap[0, 0] == pytest.approx(-7e-8 / scale, rel=1e-12)
    still = motion.problem.added_gap
    assert still is None or not np.any(still(np.linspace(-4.0, 1.0, 9), np.zeros(1)))


@pytest.mark.parametrize("ratio", [0.0, 6.0])
def test_a_random_profile_is_as_long_as_it_travels(ratio):
    """No mirror image and no repetition within five domains: one made far longer has the same heights."""
    case = moving(LINE, {SRR: ratio}, **rough((1, RANDOM), (2, RANDOM | {"seed": 6})), motion={"passes": 5.0})
    motion = TransientContact.of(case)
    x = np.linspace(-4.0, 2.0, 65)
    for surface, speed in enumerate(SPEEDS[ratio]):
        whole = generators.gaussian(rq=1e-8, correlation_length=2e-5, length=0.05, seed=5 + surface)
        for time in (6.0, 12.0, 30.0):
            away = speed * time - math.copysign(6.0, speed)
            expected = np.interp(HALF_WIDTH * (x - away), whole.x, whole.heights)
            found = motion.roughness.heights(time, x)[surface]
            if speed * time == 6.0 * math.copysign(1.0, speed):
                found, expected = found[10:-11], expected[10:-11]  # behind the front
            # Straight lines between sixteen points of a correlation length miss less than this.
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=2e-2 * 1e-8 * 3.0)
    fast, slow = SPEEDS[ratio]
    grid = motion.travelled.grid
    assert grid.ends[0] == -4.0 - max(fast * 30.0, slow * 30.0) + 6.0
    assert grid.ends[1] == (2.0 if slow > 0.0 else 2.0 + 2.0 * 30.0 - 6.0)


def test_what_moves_is_looked_at_as_finely_as_the_grid():
    motion = TransientContact.of(moving(LINE, motion={"passes": 2.5}))
    grid = motion.travelled.grid
    # The domain and one and a half beside it, 64 intervals each six half-widths.
    assert (grid.ends, grid.nodes) == ((-13.0, 2.0), 161)
    same = TransientContact.of(moving(LINE, motion={"passes": 0.5}))
    assert same.travelled.grid.ends == same.case.grid.ends
    assert same.travelled.grid.nodes == same.case.grid.nodes


@each(
    "tables, symmetric, passes",
    [
        ([(1, PIT)], True, 1.0),
        ([(1, PIT), (2, WAVES)], True, 40.0),
        ([(1, PIT | {"position_y": 3e-5})], False, 1.0),
        ([(1, WAVES | {"orientation": 10.0})], False, 1.0),
        ([(1, RANDOM)], False, 1.0),
        # A pit beside the middle may lie between nodes that are as many as those of the domain.
        ([(1, WAVES), (2, PIT | {"width": 4e-5, "position_y": 3e-5})], False, 40.0),
        ([(1, PIT | {"position_y": 3e-5}), (1, PIT | {"position_y": -3e-5})], True, 1.0),
    ],
)
def test_half_is_solved_only_where_all_that_comes_is_its_own_image(tables, symmetric, passes):
    motion = TransientContact.of(moving(POINT, **rough(*tables), motion={"passes": passes}))
    width = motion.problem.width
    assert (width.symmetric, width.nodes) == (symmetric, 65)


def test_what_rests_may_be_alike_while_what_moves_is_not():
    tables = rough((1, PIT | {"position_y": 3e-5}), (2, PIT))
    motion = TransientContact.of(moving(POINT, {SRR: 2.0}, **tables))
    assert not motion.problem.width.symmetric
