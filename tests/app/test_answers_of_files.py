"""Immediate answers that read files: a changed file changes the answer, and no kept outcome hides it."""

import asyncio
import tomllib

import pytest

from ehlectric.app import calls
from ehlectric.app.calls import Call
from ehlectric.app.compute import contact_answers, motion_answers, sweep_answers
from ehlectric.app.compute.page_files import uploaded
from ehlectric.app.session import SURFACES
from ehlectric.app.work import Limits, Work, key_of
from ehlectric.runs.example_files import example_text
from ehlectric.runtime.progress import silent
from tests.helpers.moving_cases import LINE
from tests.helpers.processes import PATIENCE

CALLS = {name: call for name, call in vars(calls).items() if isinstance(call, Call)}

# Jobs, which nothing keeps, and an estimate of a time, which depends on what else the machine does.
ANEW = {
    "AXLE_SIMULATED",
    "BEARING_SOLVED",
    "CALIBRATED",
    "CONTACT_SOLVED",
    "DRIVE_SIMULATED",
    "FILES_CONVERTED",
    "FILES_DRAWN",
    "FILES_UPLOADED",
    "FILES_WRITTEN",
    "GEAR_SOLVED",
    "MOTION_RUN",
    "SWEEP_PLANNED",
    "SWEEP_SOLVED",
}

BALL = tomllib.loads(example_text("ball_contact")) | {"grid": {"nodes": 65}}
BEARING = tomllib.loads(example_text("bearing_6208")) | {"contacts": "formula"}
SWEEP = {"case": BEARING, "vary": {"bearing": {"inner_speed": ["600 rpm", "1200 rpm"]}}}
MOVING = LINE | {
    "discharge": {"dielectric_strength": "20 V/um"},
    "motion": {"passes": 1.0, "steps": 16, "record": 8},
}
PROFILE = {"surface": 1, "file": f"{SURFACES}/profile.csv"}


def stored(name, text):
    def change(folder):
        (folder / SURFACES).mkdir(exist_ok=True)
        (folder / SURFACES / name).write_text(text, encoding="utf-8")

    return change


def swept(*speeds):
    """Change of the sweep of a folder to one with other speeds, as by a second run into it."""
    table = SWEEP | {"vary": {"bearing": {"inner_speed": list(speeds)}}}
    return lambda folder: sweep_answers.solved(table, str(folder / "sweep"), 1, silent)


def solved_ball(load):
    table = BALL | {"contact": BALL["contact"] | {"load": load}}
    return lambda folder: contact_answers.solve_contact(table, folder, folder / "solved", silent)


def moved_in_time(folder):
    motion_answers.run(MOVING, str(folder), silent)


def of_heights(step):
    lines = "".join(f"{number},{step * (number % 7)}\n" for number in range(64))
    return stored("profile.csv", f"x [um],z [nm]\n{lines}")


def written(text):
    def change(folder):
        (folder / "out").mkdir(exist_ok=True)
        for number in range(len(text)):
            (folder / "out" / f"{number}.csv").write_text(text)

    return change


# Values of each call in a folder, and two changes of the files in it.
CHANGES = {
    "CONTACT_CUTS": (
        lambda folder: (str(folder / "solved"), 0.0, 0.0),
        solved_ball("20 N"),
        solved_ball("30 N"),
    ),
    "DUTY_LOOK": (
        lambda folder: (f"{SURFACES}/cycle.csv", folder, "bearing"),
        stored("cycle.csv", "time [s],speed [rpm]\n0,600\n10,3000\n"),
        stored("cycle.csv", "time [s],speed [rpm]\n0,600\n20,3000\n"),
    ),
    "FILES_PACKED": (
        lambda folder: (folder / "out", "csv", BEARING, "title", folder),
        written("1"),
        written("12"),
    ),
    "MOTION_STORED": (lambda folder: (MOVING, str(folder)), lambda _: None, moved_in_time),
    "SURFACE": (
        lambda folder: (PROFILE, BALL, str(folder), "profile.csv"),
        of_heights(1.0),
        of_heights(2.0),
    ),
    "SWEEP_FILES": (
        lambda folder: (str(folder / "sweep"),),
        swept("600 rpm"),
        lambda folder: (folder / "sweep" / "sweep.nc").unlink(),
    ),
    "SWEEP_POINT": (
        lambda folder: (str(folder / "sweep"), SWEEP, 1),
        swept("600 rpm", "1200 rpm"),
        swept("600 rpm"),
    ),
    "SWEEP_SEEN": (
        lambda folder: (str(folder / "sweep"), "", SWEEP),
        swept("600 rpm"),
        swept("600 rpm", "1200 rpm"),
    ),
}


def answered(name, folder):
    """Answer, or text of the error, after each change of the files of a call: by one process."""
    values, *changes = CHANGES[name]

    async def use():
        work = Work(Limits(patience=PATIENCE))
        try:
            share, answers = work.share(), []
            for change in changes:
                change(folder)
                outcome = await asyncio.gather(
                    share.quick(CALLS[name], *values(folder)), return_exceptions=True
                )
                answers += map(str, outcome)
            return answers
        finally:
            work.close()

    return asyncio.run(use())


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("name", CHANGES)
def test_a_changed_file_changes_the_answer(name, tmp_path):
    before, after = answered(name, tmp_path)
    assert before != after


def test_every_call_declares_what_its_outcome_depends_on():
    kept = {name for name, call in CALLS.items() if call.kept}
    assert set(CALLS) == kept | CHANGES.keys() | ANEW
    assert not kept & (CHANGES.keys() | ANEW)
    assert not any(key_of(CALLS[name], ("a folder", 1)) for name in CALLS.keys() - kept)


def test_an_uploaded_file_of_a_known_name_keeps_both_contents(tmp_path):
    table = 'duty = { file = "cycle.csv" }\n' + example_text("bearing_6208")
    contents = [f"time [s],speed [rpm]\n0,600\n{end},3000\n".encode() for end in (10, 20)]
    names = [
        uploaded({"a.toml": table.encode(), "cycle.csv": content}, tmp_path).table["duty"]["file"]
        for content in (contents[0], contents[1], contents[1])
    ]
    assert names[0] != names[1] == names[2]
    assert [(tmp_path / name).read_bytes() for name in names[:2]] == contents
    # A case alone takes the last content of its name.
    assert uploaded({"a.toml": table.encode()}, tmp_path).table["duty"]["file"] == names[1]
