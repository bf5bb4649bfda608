"""The motion table of a case: what each bad one is told, round trips, replacement, and speeds of surfaces."""

from pathlib import Path

import pytest

from ehlectric import Case, InputError, solve
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.runs.by_kind import run_motion
from ehlectric.runs.preview import preview_of
from tests.helpers.each import each
from tests.helpers.moving_cases import LINE, POINT, moving

# A folder that is never made.
FOLDER = Path("no-folder-of-a-refused-case")


@each("table", [LINE, POINT])
@each("tables", [{"roughness": []}, {"grid": {"wedge": "first-order"}}, {"grid": {"refine": "3 %"}}])
def test_what_does_not_go_with_a_motion_goes_without(table, tables):
    with pytest.raises(InputError):
        moving(table, **tables)
    without = {key: value for key, value in table.items() if key != "motion"}
    assert Case.from_dict(without | tables).motion is None


@each("table", [LINE, POINT])
@each(
    "changes, key",
    [
        # 64 intervals of the grid in one pass: seven steps are longer than the eight that one may take.
        ({"motion.steps": 7}, "motion.steps"),
        # Roughness is on a surface at rest only.
        ({"contact.slide_to_roll_ratio": -2.0}, "motion"),
    ],
)
@each("refuse", [TransientContact.of, preview_of, lambda case: run_motion(case, FOLDER)])
def test_what_cannot_be_solved_is_refused_by_all_that_look(table, changes, key, refuse):
    """Before a folder is made for its results."""
    with pytest.raises(InputError) as refused:
        refuse(moving(table, changes))
    assert refused.value.key == key
    assert not FOLDER.exists()


def test_a_motion_that_is_none():
    with pytest.raises(InputError, match=r"^motion: missing"):
        TransientContact.of(moving(changes={"motion": None}))


@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
def test_a_film_at_rest_is_not_that_of_a_moving_case(table):
    with pytest.raises(InputError, match=r"^motion: .*solve_motion\(case\)"):
        solve(moving(table))


MOTIONS = [
    {"passes": 1.5, "record": 200},
    {"duration": 0.002, "steps": 5000, "record": 2},
]


@each("motion", MOTIONS)
@each("table", [LINE, POINT])
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


@each("geometry", ["line", "point"])
@each(
    "first, second",
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
