"""The motion table of a case: what each bad one is told, round trips, replacement, and speeds of surfaces."""

import re
from pathlib import Path

import pytest

from ehlectric import Case, InputError, Sweep, solve
from ehlectric.motion.contact import TransientContact
from ehlectric.runs.by_kind import run_motion
from ehlectric.runs.meaning import check
from tests.helpers.moving_cases import LINE, POINT, moving

TAKES_PASSES = "expected a number, above 0 and at most 10000: lengths of the domain at the mean speed"
TAKES_DURATION = "expected a number in s or a string with its unit, above 0 and at most 10000: of the motion"
TAKES_RECORD = "expected a whole number from 2 to 100000: stored instants"
EITHER = "expected either passes or duration"

# A folder that is never made.
FOLDER = Path("no-folder-of-a-refused-case")

# What is wrong with the table itself.
BAD_TABLES = [
    ({}, f"motion.passes: missing; {EITHER}"),
    ({"steps": 100, "record": 10}, f"motion.passes: missing; {EITHER}"),
    ({"passes": 1, "duration": "1 ms"}, f"motion.passes: got passes and duration together; {EITHER}"),
    ({"passes": 0}, f"motion.passes: got 0; {TAKES_PASSES}"),
    ({"passes": -1.0}, f"motion.passes: got -1.0; {TAKES_PASSES}"),
    ({"passes": 10001}, f"motion.passes: got 10001; {TAKES_PASSES}"),
    ({"passes": "1 ms"}, f"motion.passes: got '1 ms' (it is not a number); {TAKES_PASSES}"),
    ({"passes": float("nan")}, f"motion.passes: got nan (it is not finite); {TAKES_PASSES}"),
    ({"duration": 0.0}, f"motion.duration: got 0.0; {TAKES_DURATION}"),
    (
        {"duration": "1 m"},
        f"motion.duration: got '1 m' (m is not a unit of this quantity); {TAKES_DURATION}",
    ),
    ({"duration": "3 h"}, f"motion.duration: got '3 h'; {TAKES_DURATION}"),
    ({"passes": 1, "record": 1}, f"motion.record: got 1; {TAKES_RECORD}"),
    ({"passes": 1, "record": 100_001}, f"motion.record: got 100001; {TAKES_RECORD}"),
    ({"passes": 1, "record": 2.5}, f"motion.record: got 2.5; {TAKES_RECORD}"),
    ({"passes": 1, "steps": 0}, "motion.steps: got 0; expected a whole number from 1 to 100000000: of time"),
    ({"passes": 1, "speed": 2}, "motion.speed: unknown key; the nearest known one is motion.steps"),
    (3, "motion: got 3; expected a table"),
]

# What is wrong with it in its case.
BAD_CASES = [
    ({"roughness": []}, "motion: needs a rough surface: roughness is what moves"),
    (
        {"grid": {"wedge": "first-order"}},
        "grid.wedge: got 'first-order' beside motion; expected 'third-order' or 'second-order'",
    ),
    (
        {"grid": {"refine": "3 %"}},
        "grid.refine: is not used with [motion], which has a single grid; give grid.nodes",
    ),
]

# 64 intervals of the grid in one pass: seven steps are longer than the eight of them that a step may take.
TOO_FEW = (
    "motion.steps: got 7, in each of which oil would travel 9.14 grid spacings; expected at least 8, and 64 "
    "for one spacing a step"
)
AT_REST = (
    "motion: got roughness only on surfaces at rest; expected roughness on a surface that moves, or a case "
    "without motion"
)


@pytest.mark.parametrize(("motion", "message"), BAD_TABLES)
@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
def test_bad_tables_are_one_line(table, motion, message):
    with pytest.raises(InputError, match=f"^{re.escape(message)}$"):
        moving(table, motion=motion)


@pytest.mark.parametrize(("tables", "message"), BAD_CASES)
@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
def test_bad_combinations_are_one_line(table, tables, message):
    with pytest.raises(InputError, match=f"^{re.escape(message)}$"):
        moving(table, **tables)
    # It is the motion that they do not go with.
    without = {key: value for key, value in table.items() if key != "motion"}
    assert Case.from_dict(without | tables).motion is None


@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
@pytest.mark.parametrize(
    ("changes", "message"),
    [({"motion.steps": 7}, TOO_FEW), ({"contact.slide_to_roll_ratio": -2.0}, AT_REST)],
)
@pytest.mark.parametrize("refuse", [TransientContact.of, check, lambda case: run_motion(case, FOLDER)])
def test_what_cannot_be_solved_is_refused_by_all_that_look(table, changes, message, refuse):
    """Before a folder is made for its results."""
    with pytest.raises(InputError, match=f"^{re.escape(message)}$"):
        refuse(moving(table, changes))
    assert not FOLDER.exists()


def test_a_motion_that_is_none():
    with pytest.raises(InputError, match=r"^motion: missing; a case whose roughness moves needs it$"):
        TransientContact.of(moving(changes={"motion": None}))


@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
def test_a_film_at_rest_is_not_that_of_a_moving_case(table):
    text = "motion: is a table of transient contacts; expected solve_motion(case), run_motion(case, folder), "
    text += "or a case without it"
    with pytest.raises(InputError, match=f"^{re.escape(text)}$"):
        solve(moving(table))


def test_sweeps_take_no_motion():
    case = moving()
    text = "case.motion: got [motion] in a sweep, whose films are stationary; expected a case without it"
    with pytest.raises(InputError, match=f"^{re.escape(text)}$"):
        Sweep.from_dict({"case": case, "vary": {"contact.entrainment_speed": [1.0, 2.0]}})
    for key in ("motion.passes", "motion.duration", "motion.steps"):
        text = f"vary.{key}: cannot vary: the films of a sweep are stationary"
        with pytest.raises(InputError, match=f"^{re.escape(text)}$"):
            Sweep.from_dict({"case": case.replace(motion=None), "vary": {key: [1, 2]}})


MOTIONS = [
    {"passes": 1.5, "record": 200},
    {"duration": 0.002, "steps": 5000, "record": 2},
]


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
def test_a_case_is_written_and_read_back(tmp_path, table, motion):
    case = moving(table, motion=motion)
    (tmp_path / "case.toml").write_text(case.to_toml())
    assert Case.from_toml(tmp_path / "case.toml") == case
    assert case.to_dict()["motion"] == motion
    assert case != case.replace({"motion.record": 3})


def test_units_of_a_duration_and_the_default_of_what_is_kept():
    motion = moving(motion={"duration": "2 ms"}).motion
    assert (motion.duration, motion.passes, motion.steps, motion.record) == (0.002, None, None, 200)


def test_one_length_displaces_the_other():
    case = moving(motion={"passes": 2.0, "steps": 500, "record": 7})
    timed = case.replace({"motion.duration": "1 ms"})
    assert timed.motion.model_dump() == {"passes": None, "duration": 1e-3, "steps": 500, "record": 7}
    back = timed.replace(motion={"passes": 3})
    assert back.motion.model_dump() == {"passes": 3.0, "duration": None, "steps": 500, "record": 7}
    assert case.replace({"motion.record": 9}).motion.passes == 2.0
    assert case.replace(motion=None).motion is None
    with pytest.raises(InputError, match="got passes and duration together"):
        case.replace({"motion.passes": 1.0, "motion.duration": 1.0})


@pytest.mark.parametrize("geometry", ["line", "point"])
@pytest.mark.parametrize(
    ("first", "second"),
    [
        (4.0, 4.0),  # rolling
        (5.0, 3.0),
        (3.0, 5.0),
        (8.0, 0.0),  # one at rest
        (0.0, 8.0),
        (10.0, -2.0),  # opposite
        (-2.0, 10.0),
    ],
)
def test_speeds_of_the_surfaces(geometry, first, second):
    """Over the mean speed, 4 m/s, however they are given."""
    table = POINT if geometry == "point" else LINE
    contact = {key: value for key, value in table["contact"].items() if key != "entrainment_speed"}
    both = table["roughness"][0]
    rough = [both, both | {"surface": 2}]
    given = moving(table, contact=contact | {"speed_1": first, "speed_2": second}, roughness=rough)
    ratio = {"entrainment_speed": 4.0, "slide_to_roll_ratio": (first - second) / 4.0}
    for case in (given, moving(table, contact=contact | ratio, roughness=rough)):
        motion = TransientContact.of(case).schedule
        assert [motion.speed_of(1), motion.speed_of(2)] == pytest.approx([first / 4.0, second / 4.0])
        # Exactly at rest, not nearly so.
        assert (motion.speed_of(1) == 0.0, motion.speed_of(2) == 0.0) == (first == 0.0, second == 0.0)
