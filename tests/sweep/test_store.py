"""A sweep on disk: keys, what is kept, what is tried again, and files that are none."""

import os
import shutil
import sqlite3
import subprocess
import sys
from dataclasses import replace

import pytest

from ehlectric import Case, InputError, read_sweep
from ehlectric.sweep.engine import Outcome, case_key, plan
from ehlectric.sweep.points import Range
from ehlectric.sweep.store import NAME, Store
from ehlectric.version import __version__
from tests.helpers.each import each
from tests.helpers.sweeps import CASE, LOAD, NODES, PRESSURE, SPEED, TABLE, speeds, sweep_over

FOUND = Outcome("solved", summary={"title": "of another", "film": {"minimum_thickness": 1e-7}}, seconds=0.5)


def begun(folder, sweep, outcomes=()):
    """A store of a sweep whose first points have these outcomes."""
    planned = list(plan(sweep))
    with Store(folder) as store:
        store.begin(sweep, planned)
        for point, outcome in zip(planned, outcomes, strict=False):
            store.write([(point.key, outcome)])
        return store.open_points(), store.counts()


def test_keys_tell_cases_apart_and_know_the_same_ones():
    same = [
        CASE,
        CASE.replace(title="Another title"),
        Case.from_dict(TABLE | {"solver": {"max_iterations": 30}}),  # its default
        CASE.replace({LOAD: "1.57 MN/m"}),
    ]
    assert len({case_key(case) for case in same}) == 1
    others = [
        CASE.replace({key: value}) for key, value in ((SPEED, 4.000000001), (NODES, 131), (PRESSURE, 1e9))
    ]
    assert len({case_key(case) for case in (CASE, *others)}) == 4


def test_a_surface_counts_by_what_its_file_holds(tmp_path):
    for name, text in (("a.txt", "0 1\n"), ("b.txt", "0 1\n"), ("c.txt", "0 2\n")):
        (tmp_path / name).write_text(text)
    rough = [
        Case.from_dict(TABLE | {"roughness": [{"surface": 1, "file": str(tmp_path / name)}]})
        for name in ("a.txt", "b.txt", "c.txt")
    ]
    keys = [case_key(case) for case in rough]
    assert keys[0] == keys[1] != keys[2]
    (tmp_path / "a.txt").write_text("0 3\n\n")
    assert case_key(rough[0]) not in keys
    (tmp_path / "a.txt").unlink()
    with pytest.raises(InputError, match=r"a\.txt: cannot be read, no such file or directory$"):
        case_key(rough[0])


def test_what_was_asked_and_found_comes_back(tmp_path):
    sweep = sweep_over({SPEED: [1, "2 m/s"], "grid.field_range": [[-1, 1], [-1.25, 1.25]]})
    outcomes = [
        FOUND,
        Outcome("not converged", "film diverged", summary=FOUND.summary),
        Outcome("failed", "unexpected: no"),
    ]
    begun(tmp_path, sweep, outcomes)
    assert sorted(path.name for path in tmp_path.iterdir()) == [NAME]
    results = read_sweep(tmp_path)
    assert (results.case, results.design) == (CASE, "grid")
    assert results.axes == sweep.axes
    assert results.varied == (SPEED, "grid.field_range")
    assert [point.number for point in results.points] == [0, 1, 2, 3]
    assert [dict(point.inputs) for point in results.points] == list(sweep.points())
    assert [point.status for point in results.points] == ["solved", "not converged", "failed", "open"]
    assert [point.reason for point in results.points] == [
        "",
        "film diverged",
        "unexpected: no",
        "",
    ]
    assert results.points[0].summary == {"title": CASE.title, "film": {"minimum_thickness": 1e-7}}
    assert (results.points[0].seconds, results.points[0].version) == (0.5, __version__)
    assert results.points[2].summary is None
    # Numbers of points that are not solved are none.
    thickness = results.values("film.minimum_thickness").tolist()
    assert thickness[0] == 1e-7
    assert [value == value for value in thickness] == [True, False, False, False]


def test_a_sobol_design_comes_back(tmp_path):
    over = {SPEED: {"from": 1, "to": 4}, LOAD: {"from": 1e5, "to": 1e6, "spacing": "log"}}
    begun(tmp_path, sweep_over(over, design="sobol", samples=4, seed=7))
    results = read_sweep(tmp_path)
    assert results.ranges == {SPEED: Range(1.0, 4.0), LOAD: Range(1e5, 1e6, "log")}
    assert (results.axes, results.samples, results.seed, len(results.points)) == ({}, 4, 7, 16)


def test_what_is_tried_again(tmp_path):
    outcomes = [
        FOUND,
        Outcome("not converged", "film diverged", summary={}),
        Outcome("failed", "not solved: no field"),
        Outcome("failed", "its process was killed", again=True),
        Outcome("failed", "not solved: no field", version="0.0.1"),
        replace(FOUND, version="0.0.1"),
    ]
    remaining, counts = begun(tmp_path, speeds(7), outcomes)
    assert [inputs[SPEED] for _, inputs in remaining] == [4.0, 5.0, 7.0]
    assert counts == {"solved": 2, "not converged": 1, "failed": 1, "open": 3}


def test_points_that_are_one_case_are_solved_once(tmp_path):
    twice = sweep_over({SPEED: [1, 1, 2], LOAD: [1e6, 1e6, 1e6]}, design="paired")
    remaining, counts = begun(tmp_path, twice)
    assert [inputs[SPEED] for _, inputs in remaining] == [1.0, 2.0]
    assert counts == {"open": 3}
    begun(tmp_path, twice, [FOUND])
    assert [point.status for point in read_sweep(tmp_path).points] == ["solved", "solved", "open"]


def test_points_that_are_no_case_are_failed_with_their_reason(tmp_path):
    sweep = sweep_over({NODES: [129, 400], "grid.outlet": [2.0, 20.0]})
    remaining, counts = begun(tmp_path, sweep)
    assert (len(remaining), counts) == (3, {"failed": 1, "open": 3})
    refused = read_sweep(tmp_path).points[1]
    # 24 half-widths hold 8 nodes each at least: 193 of them.
    assert (refused.status, refused.summary) == ("failed", None)
    assert refused.reason.startswith("grid.nodes: got 129 over 24 half-widths; expected at least 193")


def test_a_changed_sweep_keeps_what_it_shares(tmp_path):
    begun(tmp_path, speeds(3), [FOUND] * 3)
    remaining, _ = begun(tmp_path, sweep_over({SPEED: [5.0, 2.0], NODES: [129, 131]}))
    assert [tuple(inputs.values()) for _, inputs in remaining] == [(5.0, 129), (5.0, 131), (2.0, 131)]
    assert [point.status for point in read_sweep(tmp_path).points] == ["open", "open", "solved", "open"]
    # And back: nothing is lost of what was found before.
    assert begun(tmp_path, speeds(3))[1] == {"solved": 3}


def test_a_reader_beside_the_writer(tmp_path):
    sweep = speeds(3)
    planned = list(plan(sweep))
    with Store(tmp_path) as store:
        store.begin(sweep, planned)
        for done, point in enumerate(planned):
            assert [p.status for p in read_sweep(tmp_path).points].count("solved") == done
            store.write([(point.key, FOUND)])


# A transaction that outgrows its cache, so that half of it is in the file when its process is killed.
HALF_WRITTEN = """
import os, signal, sqlite3, sys
file = sqlite3.connect(sys.argv[1], isolation_level=None)
file.execute("PRAGMA cache_size = 1")
file.execute("BEGIN IMMEDIATE")
file.execute("UPDATE points SET inputs = 'broken'")
for number in range(1000, 4000):
    file.execute("INSERT INTO points VALUES (?, ?, NULL, '')", (number, "x" * 400))
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signal that cannot be caught")
def test_what_a_kill_left_half_written_is_taken_back_by_the_next_reader(tmp_path):
    begun(tmp_path, speeds(3), [FOUND])
    before = read_sweep(tmp_path)
    subprocess.run([sys.executable, "-c", HALF_WRITTEN, str(tmp_path / NAME)], check=False)
    assert (tmp_path / f"{NAME}-journal").stat().st_size > 0
    assert read_sweep(tmp_path) == before


def test_two_writers_are_one_too_many(tmp_path):
    with (
        Store(tmp_path),
        pytest.raises(InputError, match=r": is being written to by another ehlectric; expected a folder "),
    ):
        Store(tmp_path)
    Store(tmp_path).__exit__()


def refused_by_both(folder, message):
    for opening in (Store, read_sweep):
        with pytest.raises(InputError, match=message) as caught:
            opening(folder)
        assert "\n" not in str(caught.value)


@each("content", [b"number,status\n" * 100, b"\x00" * 4096, b"SQLite format 3\x00" * 99])
def test_files_that_are_no_database(tmp_path, content):
    (tmp_path / NAME).write_bytes(content)
    refused_by_both(tmp_path, r"sweep\.sqlite: is not a sweep of ehlectric")
    assert (tmp_path / NAME).read_bytes() == content


def test_databases_of_others(tmp_path):
    with sqlite3.connect(tmp_path / NAME) as other:
        other.execute("CREATE TABLE mine (a)")
    other.close()
    refused_by_both(tmp_path, r"sweep\.sqlite: is not a sweep of ehlectric$")


def test_sweeps_of_a_later_version(tmp_path):
    begun(tmp_path, speeds(1))
    with sqlite3.connect(tmp_path / NAME) as file:
        file.execute("PRAGMA user_version = 99")
    file.close()
    refused_by_both(tmp_path, r"sweep\.sqlite: is of a later version of ehlectric$")


@each("statement", ["DELETE FROM sweep", "UPDATE points SET inputs = '{'", "DROP TABLE results"])
def test_damage_within(tmp_path_factory, statement):
    folder = tmp_path_factory.mktemp("damaged")
    begun(folder, speeds(2), [FOUND])
    with sqlite3.connect(folder / NAME) as file:
        file.execute(statement)
    file.close()
    with pytest.raises(InputError, match=r"sweep\.sqlite: is damaged: "):
        read_sweep(folder)


def test_damaged_pages(tmp_path):
    begun(tmp_path, speeds(50), [FOUND] * 50)
    path = tmp_path / NAME
    content = bytearray(path.read_bytes())
    content[4096:] = b"\xa5" * (len(content) - 4096)
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"is damaged: its pages do not fit together; compute it again$"):
        read_sweep(tmp_path)


def test_no_sweep_at_all(tmp_path):
    with pytest.raises(InputError, match=r"sweep\.sqlite: cannot be read, no such file or directory$"):
        read_sweep(tmp_path)
    assert not list(tmp_path.iterdir())


def test_a_file_that_nothing_was_written_to_is_begun_anew(tmp_path):
    """As a process leaves it that is killed before its first commit."""
    (tmp_path / NAME).touch()
    with pytest.raises(InputError, match=r"is not a sweep of ehlectric$"):
        read_sweep(tmp_path)
    begun(tmp_path, speeds(1))
    assert len(read_sweep(tmp_path).points) == 1


def test_something_else_in_its_place(tmp_path):
    (tmp_path / NAME).mkdir()
    with pytest.raises(InputError, match=r"sweep\.sqlite: cannot be written to, it is no regular file$"):
        Store(tmp_path)


@pytest.mark.slow
def test_a_full_disk_is_one_line_and_loses_nothing(tmp_path):
    """A limit on the size of files stands in for the disk: SQLite meets the same failed write."""
    code = f"""
import resource, sys
from pathlib import Path
sys.path[:0] = {sys.path!r}
from ehlectric import InputError
from tests.sweep.test_store import FOUND, Store, plan, speeds
from dataclasses import replace
sweep, folder = speeds(400), Path({str(tmp_path)!r})
planned, saved = list(plan(sweep)), 0
with Store(folder) as store:
    store.begin(sweep, planned)
    resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))
    try:
        for point in planned:
            store.write([(point.key, replace(FOUND, reason="x" * 1000))])
            saved += 1
    except InputError as error:
        print(error)
print(saved)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    message, saved = done.stdout.splitlines()
    assert message.startswith(
        f"{tmp_path / NAME}: cannot be written to, d"
    )  # "disk I/O error", or that it is full
    assert 50 < int(saved) < 400
    statuses = [point.status for point in read_sweep(tmp_path).points]
    assert statuses == ["solved"] * int(saved) + ["open"] * (400 - int(saved))


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_a_folder_to_read_only(tmp_path):
    begun(tmp_path, speeds(2), [FOUND])
    tmp_path.chmod(0o500)
    try:
        assert [point.status for point in read_sweep(tmp_path).points] == ["solved", "open"]
        with pytest.raises(InputError, match=r"cannot be used, "):
            begun(tmp_path, speeds(3))
    finally:
        tmp_path.chmod(0o700)


def test_the_one_file_is_the_whole_sweep(tmp_path):
    begun(tmp_path, speeds(2), [FOUND])
    (tmp_path / "other").mkdir()
    shutil.copy(tmp_path / NAME, tmp_path / "other")
    assert read_sweep(tmp_path / "other") == read_sweep(tmp_path)
