"""Schedule of moving roughness: time steps, speeds, and when the contact is covered, by hand."""

import math
import re

import pytest

from ehlectric import InputError
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.motion.moving_contact import schedule_of
from tests.helpers.each import each
from tests.helpers.moving_cases import LINE, POINT, moving

SRR = "contact.slide_to_roll_ratio"
# b = 4 R p_h/E', of a line contact.
HALF_WIDTH = 4.0 * 14.1e-3 * 0.5e9 / 226e9
# a^3 = 3 F R/(2 E'), of a sphere of radius r on a plane; 1/R = 1/r along and across, so that R = r/2 there.
SEMI_AXIS = (3.0 * 20.0 * 5e-3 / 226e9) ** (1.0 / 3.0)
BUMP = {"generator": "asperity", "height": 5e-8, "width": 6e-5}


def schedule(case):
    """The schedule of a line or a point contact, without its surfaces."""
    point = case.contact.geometry == "point"
    return schedule_of(case, resolve_point(case) if point else resolve(case))


def rough(*tables):
    """The roughness of a case: tables with the number of their surface."""
    return {"roughness": [{"surface": surface} | table for surface, table in tables]}


def test_the_time_grid_follows_from_the_grid():
    """64 intervals over six half-widths, so that a pass takes 64 steps."""
    found = schedule(moving(LINE, motion={"passes": 1.5, "record": 5}))
    assert (found.end, found.steps, found.courant) == (9.0, 96, 1.0)
    assert found.step == 6.0 / 64.0
    assert found.time == pytest.approx(HALF_WIDTH / 4.0, rel=1e-12)
    # Quarters, and the step at which all lies as the case has it.
    assert found.recorded.tolist() == [0, 24, 48, 64, 72, 96]
    point = schedule(moving(POINT, motion={"passes": 1.5, "record": 2}))
    assert point.time == pytest.approx(SEMI_AXIS / 2.0, rel=1e-12)
    assert point.recorded.tolist() == [0, 64, 96]


def test_a_duration_is_rounded_to_whole_steps_or_taken_as_it_is():
    time = HALF_WIDTH / 4.0
    found = schedule(moving(LINE, motion={"duration": 3.02 * time}))
    # 3.02 half-widths are 32.2 intervals of 6/64.
    assert (found.steps, found.courant) == (32, 1.0)
    assert found.end == pytest.approx(3.0, rel=1e-12)
    found = schedule(moving(LINE, motion={"duration": 3.02 * time, "steps": 100}))
    assert found.end == pytest.approx(3.02, rel=1e-12)
    assert found.courant == pytest.approx(3.02 / 100 * 64 / 6, rel=1e-12)
    with pytest.raises(InputError, match=r"^motion\.duration: .* s"):
        schedule(moving(LINE, motion={"duration": 1e-3 * time}))


@each(
    "slide, surfaces, parts",
    [(0.0, (1,), 1), (0.8, (1,), 1), (2.0, (1,), 2), (4.0, (1,), 3), (4.0, (2,), 2), (-6.0, (1, 2), 4)],
)
def test_steps_are_shorter_for_surfaces_that_move_fast(slide, surfaces, parts):
    """u1 = 1 + s/2 and u2 = 1 - s/2 mean speeds: the rough one travels about a grid spacing in a step."""
    bumps = rough(*((surface, BUMP) for surface in surfaces))
    found = schedule(moving(LINE, {SRR: slide}, motion={"passes": 1.0}, **bumps))
    assert (found.steps, found.courant) == (64 * parts, pytest.approx(1.0 / parts, rel=1e-12))
    assert found.end == pytest.approx(6.0, rel=1e-12)


def test_rounding_moves_no_surface_and_loses_no_end():
    nearly = schedule(moving(LINE, {SRR: 2.0 - 1e-10}, **rough((1, BUMP), (2, BUMP))))
    assert (nearly.speed_of(1), nearly.speed_of(2)) == (pytest.approx(2.0), 0.0)
    duration = 6.0 * (1.0 - 1e-12) * HALF_WIDTH / 4.0
    assert schedule(moving(LINE, motion={"duration": duration, "steps": 49})).coincident == 6.0
    assert schedule(moving(LINE, motion={"duration": 0.999 * duration, "steps": 49})).coincident == math.inf


def test_a_step_may_be_as_long_as_eight_intervals():
    assert schedule(moving(LINE, motion={"passes": 1.0, "steps": 8})).courant == 8.0


@each(
    "motion, ratio, recorded",
    [
        # D/u is step 120 of 150.
        ({"passes": 1.25, "steps": 150, "record": 4}, 0.0, [0, 50, 100, 120, 150]),
        ({"passes": 1.25, "steps": 150, "record": 6}, 0.0, [0, 30, 60, 90, 120, 150]),
        # Twice as fast, and once not at all in time; nearest to step 17.5 the even one.
        ({"passes": 1.0, "steps": 36, "record": 2}, 2.0, [0, 18, 36]),
        ({"passes": 0.4, "steps": 36, "record": 2}, 2.0, [0, 36]),
        # At the end, to rounding.
        ({"passes": 1.0, "steps": 49, "record": 2}, 0.0, [0, 49]),
        # More than there are.
        ({"passes": 1.0, "steps": 10, "record": 50}, 0.0, list(range(11))),
    ],
)
def test_which_steps_are_kept(motion, ratio, recorded):
    table = rough((1, BUMP))
    assert schedule(moving(LINE, {SRR: ratio}, **table, motion=motion)).recorded.tolist() == recorded


@each(
    "tables, ratio, covered, coincident",
    [
        # From the inlet over the Hertz zone, and the front behind it: 4 + 1 + 1.
        ([(1, BUMP)], 0.0, 6.0, 6.0),
        ([(1, BUMP)], 1.0, 4.0, 4.0),
        ([(1, BUMP), (2, BUMP)], 0.0, 6.0, 6.0),
        # The slower one is last, and they never lie together.
        ([(1, BUMP), (2, BUMP)], 1.0, 12.0, math.inf),
        # Backwards from the outlet: 2 + 1 + 1, at twice the mean speed.
        ([(1, BUMP)], -6.0, 2.0, 3.0),
        ([(1, BUMP), (2, BUMP)], -6.0, 2.0, math.inf),
        # At rest from the beginning.
        ([(1, BUMP), (2, BUMP)], 2.0, 3.0, 3.0),
        # Too slow for two passes.
        ([(1, BUMP)], -1.8, math.inf, math.inf),
    ],
)
def test_when_the_contact_is_covered_and_when_all_lies_alike(tables, ratio, covered, coincident):
    motion = schedule(moving(LINE, {SRR: ratio}, **rough(*tables), motion={"passes": 2.0}))
    assert motion.covered == pytest.approx(covered, rel=1e-12)
    assert motion.coincident == pytest.approx(coincident, rel=1e-12)


MISSING = {"surface": 1, "file": "/nowhere/profile.csv", "x_unit": "m", "z_unit": "m"}


@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
def test_a_schedule_needs_no_surface(table):
    """No file of the profile is there: its speed and the grid are all that the time steps follow from."""
    made = schedule(moving(table, motion={"passes": 1.5}))
    read = schedule(moving(table, roughness=[MISSING], motion={"passes": 1.5}))
    assert read.described() == made.described()
    assert read.recorded.tolist() == made.recorded.tolist()


def test_times_that_are_not_reached_are_none_in_a_summary_and_missing_among_the_moments():
    reached, short = (schedule(moving(LINE, motion={"passes": passes})) for passes in (2.0, 0.5))
    # T = 6 of b/u each, u = 4 m/s.
    expected = {"covered_from": 6.0 * HALF_WIDTH / 4.0, "coincident": 6.0 * HALF_WIDTH / 4.0}
    assert reached.moments() == pytest.approx(expected, rel=1e-12)
    assert short.moments() == {}
    assert {name: short.described()[name] for name in expected} == dict.fromkeys(expected)


@each("passes", [0.5, 2.0])
def test_the_stated_number_of_steps_is_the_smallest_that_is_accepted(passes):
    def steps(number):
        return schedule(moving(motion={"passes": passes, "steps": number})).steps

    with pytest.raises(InputError, match=r"^motion\.steps: ") as error:
        steps(1)
    least = int(re.search(r"at least (\d+)", str(error.value))[1])
    assert steps(least) == least
    with pytest.raises(InputError, match=r"^motion\.steps: "):
        steps(least - 1)
