"""File and journal of a moving contact: what is read back, and every way in which a run is resumed or not."""

import fcntl
import gzip
import json
import re
import signal
import sqlite3
import time
from contextlib import closing, suppress
from dataclasses import replace
from threading import Thread

import h5netcdf
import numpy as np
import pytest

from ehlectric import InputError, load
from ehlectric.errors import ConvergenceError, DamagedError
from ehlectric.film.unsteady import UnsteadyFilm
from ehlectric.motion import storage
from ehlectric.motion.moving_contact import LINE, TransientContact
from ehlectric.motion.run import run_motion
from ehlectric.motion.run import solve_to_folder as run_and_sum_up
from ehlectric.motion.solver import TransientSolver
from ehlectric.motion.storage import MotionJournal
from ehlectric.motion.stored_run import MotionRun, is_stored, read_motion, saved_run
from ehlectric.runtime import netcdf as netcdf_files
from ehlectric.runtime.journal import seal_of_row
from ehlectric.runtime.result_names import MOTION, MOTION_CHANGES, MOTION_JOURNAL
from tests.helpers.each import each
from tests.helpers.moving_cases import POINT, moving
from tests.helpers.places import ROOT

# Twelve steps of two grid spacings, kept are 0, 4, 8 and 12.
SHORT = {"passes": 0.375, "steps": 12, "record": 4}
CASE = moving(motion=SHORT)
MAPS = ("pressure", "thickness", "strength", "roughness_1", "roughness_2", "cavitated")


class StoppedError(Exception):
    """As a signal stops a run."""


def run(case, folder, until=None):
    """Run into a folder, stopped once so many steps are done; what the progress was told."""
    told = []

    def progress(done, of, text):
        told.append((done, of, text))
        if until is not None and done >= until and text == "time steps":
            raise StoppedError

    with suppress(StoppedError):
        run_motion(case, folder, progress=progress)
    return told


def of_step(done, of=12):
    return (done, of, "time steps")


ANEW = [(0, 12, "film before the motion"), of_step(0), of_step(4), of_step(8), of_step(12)]


def same(one, other):
    """Whether all that does not tell the time of day is alike to the last bit."""
    assert list(one.variables) == list(other.variables)
    for name in one.variables:
        np.testing.assert_array_equal(one[name].values, other[name].values, err_msg=name)
    told = {"date", "seconds"}
    assert {k: v for k, v in one.attrs.items() if k not in told} == {
        k: v for k, v in other.attrs.items() if k not in told
    }


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A run from its start to its end: its dataset, and its journal after each recorded instant."""
    folder = tmp_path_factory.mktemp("whole")
    told, files = [], {}

    def progress(*what):
        told.append(what)
        if what[2] == "time steps":
            files[what[0]] = (folder / MOTION_JOURNAL).read_bytes()

    run_motion(CASE, folder, progress=progress)
    assert told == ANEW
    return read_motion(folder), files


@pytest.fixture(scope="module")
def whole(written):
    return written[0]


@pytest.fixture
def stopped(written, tmp_path):
    """Puts the journal of a run that was killed after a step into the folder of the test."""

    def put(step):
        path = tmp_path / MOTION_JOURNAL
        path.write_bytes(written[1][step])
        return path

    return put


@pytest.fixture(scope="module")
def stepped():
    """The same without a file: instants by their steps."""
    solver = TransientSolver(TransientContact.of(CASE))
    history = solver.start()
    return solver, {0: history, **dict(solver.run(history))}


@pytest.mark.slow
def test_all_steps_and_the_instants_are_there(whole, stepped):
    solver, histories = stepped
    contact = solver.contact
    assert dict(whole.sizes) == {"x": 65, "step": 13, "frame": 4}
    assert whole["frame_step"].values.tolist() == [0, 4, 8, 12]
    # T = 0.375 passes of six half-widths, b/u each.
    times = np.linspace(0.0, 2.25, 13) * contact.schedule.time
    np.testing.assert_allclose(whole["time"], times, rtol=1e-12)
    np.testing.assert_allclose(whole["frame_time"], times[::4], rtol=1e-12)
    np.testing.assert_allclose(whole["x"], np.linspace(-4.0, 2.0, 65) * contact.half_width, rtol=1e-12)
    for step, history in histories.items():
        film, row = solver.film(history.now), whole.isel(step=step)
        assert row["minimum_thickness"] == np.min(film.thickness)
        assert row["minimum_x"] == film.x[np.argmin(film.thickness)]
        assert row["max_pressure"] == np.max(film.pressure)
        assert row["thin_gap_strength"] == 2.0 / np.min(film.thickness)
        effort = history.effort
        found = [int(row[f"{name}_iterations"]) for name in ("newton", "krylov")]
        assert [*found, int(row["halvings"])] == [effort.newton, effort.krylov, effort.halvings]
    assert whole["newton_iterations"].values[1:].min() >= 1


@pytest.mark.slow
def test_maps_are_those_of_the_instants_within_single_precision(whole, stepped):
    solver, histories = stepped
    contact = solver.contact
    for frame, step in enumerate([0, 4, 8, 12]):
        shot = solver.snapshot(histories[step].now)
        film, field, row = shot.film, shot.field, whole.isel(frame=frame)
        expected = {
            "pressure": film.pressure,
            "thickness": film.thickness,
            "strength": LINE.column_strength(film, field),
            "roughness_1": shot.roughness[0],
            "roughness_2": shot.roughness[1],
        }
        for name, values in expected.items():
            assert row[name].dtype == np.float32
            np.testing.assert_allclose(row[name], values, rtol=2.0**-24, atol=1e-40, err_msg=name)
        np.testing.assert_array_equal(row["cavitated"].values.astype(bool), film.cavitated)
        # Numbers are in double precision, and within the maps.
        assert row["max_strength"] == field.max_strength
        assert row["max_strength_x"] == field.max_strength_position
        assert row["capacitance"] == field.capacitance
        np.testing.assert_array_equal(np.isnan(row["strength"]), abs(whole["x"]) > 1.25 * contact.half_width)
    # Behind the exit at ambient pressure, 0.1 MPa; in the Hertz zone full.
    cavitated, x = whole["cavitated"].values.astype(bool), whole["x"].values / contact.half_width
    assert np.all(cavitated[:, x > 1.5])
    assert not np.any(cavitated[:, np.abs(x) < 0.9])
    np.testing.assert_allclose(whole["pressure"].values[cavitated], 1e5, rtol=1e-6)
    assert np.any(whole["roughness_1"].values[1:])
    assert not np.any(whole["roughness_2"].values)


@pytest.mark.slow
def test_everything_has_its_name_and_unit(whole):
    units = {name: variable.attrs["units"] for name, variable in whole.variables.items()}
    assert all(variable.attrs["long_name"] for variable in whole.variables.values())
    for surface in "12":
        assert f"surface {surface}" in whole[f"roughness_{surface}"].attrs["long_name"]
    assert units["frame_time"] == units["time"] == "s"
    assert units["capacitance"] == "F/m"
    assert units["strength"] == units["stationary_strength"] == units["max_strength"] == "V/m"
    assert units["pressure"] == units["stationary_pressure"] == "Pa"
    assert units["x"] == units["minimum_x"] == units["thickness"] == units["roughness_1"] == "m"
    assert MotionRun.of(whole).case == CASE
    assert (whole.attrs["complete"], whole.attrs["frames"]) == (1, 4)
    assert whole.attrs["seconds"] > 0.0


def test_the_held_roughness_is_that_of_the_case(whole):
    from ehlectric import solve

    still = solve(CASE.replace(motion=None))
    np.testing.assert_array_equal(whole["stationary_thickness"], still.film.thickness)
    np.testing.assert_array_equal(whole["stationary_pressure"], still.film.pressure)
    np.testing.assert_array_equal(whole["stationary_strength"], LINE.column_strength(still.film, still.field))


@pytest.mark.gate
@pytest.mark.parametrize("until", [pytest.param(0, marks=pytest.mark.slow), 4, 8])
def test_a_run_that_was_stopped_goes_on_to_the_last_bit(tmp_path, whole, stopped, until):
    if until == 4:
        assert run(CASE, tmp_path, until)[-1] == of_step(until)
    else:
        stopped(until)
    part = read_motion(tmp_path)
    assert (part.sizes["step"], part.sizes["frame"], part.attrs["complete"]) == (until + 1, until // 4 + 1, 0)
    same_part = whole.isel(step=slice(0, until + 1), frame=slice(0, until // 4 + 1))
    np.testing.assert_array_equal(part["pressure"], same_part["pressure"])
    spent = part.attrs["seconds"]
    assert run(CASE, tmp_path) == [of_step(step) for step in (0, 4, 8, 12) if step >= until]
    done = read_motion(tmp_path)
    same(done, whole)
    assert done.attrs["seconds"] > spent


# Parts of an instant in succession: maps, films of the run, films of its coarse run.
@pytest.mark.parametrize(("instant", "parts"), [(1, 2), (2, 1), pytest.param(2, 3, marks=pytest.mark.slow)])
def test_an_instant_that_is_half_written_does_not_count(
    tmp_path, monkeypatch, whole, stopped, instant, parts
):
    stopped(4 * (instant - 1))
    put, left = storage.add_arrays, parts

    def torn(*what):
        nonlocal left
        left -= 1
        if not left:
            raise StoppedError
        put(*what)

    with monkeypatch.context() as patch:
        patch.setattr(storage, "add_arrays", torn)
        run(CASE, tmp_path)
    assert left == 0
    part = read_motion(tmp_path)
    assert part["frame_step"].values.tolist() == [0, 4, 8][:instant]
    assert part.sizes["step"] == 4 * (instant - 1) + 1
    assert part.attrs["complete"] == 0
    assert run(CASE, tmp_path) == [of_step(step) for step in (0, 4, 8, 12) if step >= 4 * (instant - 1)]
    same(read_motion(tmp_path), whole)


def edited(path, statement, *values):
    with closing(sqlite3.connect(path)) as file, file:
        file.execute(statement, values)


def found(path, case):
    """What a run of a case would be resumed from."""
    with MotionJournal(path.parent, TransientContact.of(case)) as journal:
        return journal.resumed()


@pytest.mark.slow
@pytest.mark.parametrize(("name", "value"), [("version", "0.0.0"), ("rough", "[]")])
def test_another_run_is_not_resumed(stopped, name, value):
    path = stopped(4)
    assert found(path, CASE)[0] == 4
    text = json.dumps(value)
    edited(path, "UPDATE run SET value = ?, seal = ? WHERE name = ?", text, seal_of_row([name, text]), name)
    assert found(path, CASE) is None


@pytest.mark.slow
@pytest.mark.parametrize(
    "statement",
    [
        "UPDATE run SET value = '\"2026\"' WHERE name = 'date'",
        "UPDATE instants SET step = 5 WHERE step = 4",
        "UPDATE instants SET numbers = '{}'",
        "UPDATE instants SET seal = seal + 1 WHERE step = 0",
        "UPDATE arrays SET content = substr(content, 2) WHERE name = 'mass'",
        "UPDATE arrays SET shape = '[1]' WHERE name = 'pressure'",
        "UPDATE arrays SET type = 'O' WHERE name = 't'",
        "UPDATE arrays SET name = 'other' WHERE name = 'h00'",
        "DROP TABLE arrays",
        "ALTER TABLE instants RENAME COLUMN numbers TO texts",
        "CREATE VIEW other AS SELECT * FROM run",
    ],
)
def test_a_damaged_journal_is_neither_read_nor_replaced(tmp_path, stopped, statement):
    path = stopped(4)
    edited(path, statement)
    content = path.read_bytes()
    with pytest.raises(DamagedError, match=r"motion\.sqlite: is damaged: .*; compute it again$"):
        read_motion(tmp_path)
    with pytest.raises(DamagedError, match=r"motion\.sqlite: is damaged: .*; remove it to solve the case"):
        run(CASE, tmp_path, 0)
    assert path.read_bytes() == content
    assert not (tmp_path / MOTION).exists()


def test_a_journal_of_something_else_is_refused(tmp_path, stopped):
    path = stopped(4)
    edited(path, "PRAGMA user_version = 2")
    with pytest.raises(InputError, match=r"motion\.sqlite: is of a later version of ehlectric$"):
        read_motion(tmp_path)
    edited(path, "PRAGMA application_id = 7")
    with pytest.raises(InputError, match=r"is not a run with moving roughness of ehlectric$"):
        run(CASE, tmp_path)
    path.write_text("no database, but a text that is long enough" * 50)
    with pytest.raises(InputError, match=r"is not a run with moving roughness of ehlectric$"):
        read_motion(tmp_path)


@pytest.mark.slow
def test_bytes_that_change_in_a_journal_are_noticed(tmp_path, stopped, whole):
    """A changed byte is refused in one line, or lies in free space and changes nothing."""
    content, draw = stopped(8).read_bytes(), np.random.default_rng(2)
    refused = 0
    for at in draw.integers(100, len(content), 60):
        (tmp_path / MOTION).unlink(missing_ok=True)
        (tmp_path / MOTION_JOURNAL).write_bytes(
            content[:at] + bytes([content[at] ^ 1 << draw.integers(8)]) + content[at + 1 :]
        )
        try:
            part = read_motion(tmp_path)
        except InputError:
            refused += 1
        else:
            np.testing.assert_array_equal(part["pressure"], whole["pressure"][:3])
            np.testing.assert_array_equal(part["minimum_thickness"], whole["minimum_thickness"][:9])
    assert refused > 15


@each(
    "changes",
    [{"electric.potential_2": 3.0}, {"motion.record": 5}, {"grid.field_degree": 3}, {"title": "Other"}],
)
def test_another_case_is_not_gone_on_with(stopped, changes):
    path = stopped(4)
    assert found(path, CASE)[0] == 4
    assert found(path, CASE.replace(changes)) is None


@pytest.mark.gate
@pytest.mark.parametrize("complete", [False, True])
def test_the_run_of_another_case_is_not_replaced(tmp_path, stopped, complete):
    stopped(12 if complete else 4)
    if complete:
        run_motion(CASE, tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    names = MOTION if complete else MOTION_JOURNAL
    text = f"has {12 if complete else 4} saved steps of another case .* another folder.* remove {names} from"
    for solved in (run_motion, run_and_sum_up):
        with pytest.raises(InputError, match=text):
            solved(CASE.replace({"electric.potential_2": 3.0}), tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


@pytest.mark.slow
def test_a_surface_that_was_measured_again_is_solved_anew(tmp_path):
    heights = np.random.default_rng(1).normal(0.0, 1e-8, 400)
    x = 5e-6 * np.arange(400)

    def measure(values):
        np.savetxt(tmp_path / "profile.csv", np.column_stack([x, values]), delimiter=",")

    measure(heights)
    rough = {"surface": 1, "file": str(tmp_path / "profile.csv"), "x_unit": "m", "z_unit": "m"}
    case = moving(roughness=[rough | {"cutoff_short": "1 mm"}], motion=SHORT)
    run(case, tmp_path, 0)
    assert found(tmp_path / MOTION_JOURNAL, case)[0] == 0
    measure(1.1 * heights)
    assert found(tmp_path / MOTION_JOURNAL, case) is None


@pytest.mark.slow
def test_a_run_that_is_complete_is_solved_anew(tmp_path, stopped):
    stopped(12)
    assert run(CASE, tmp_path) == [of_step(12)]  # only motion.nc was missing
    assert [path.name for path in tmp_path.iterdir()] == [MOTION]
    stopped(12)  # a kill came before the journal was removed
    assert run(CASE, tmp_path, 0) == ANEW[:2]


@pytest.mark.slow
@pytest.mark.parametrize("size", [0, 100, 20_000])
def test_a_file_cut_short_is_refused_and_an_empty_one_replaced(tmp_path, stopped, size):
    stopped(12)
    run(CASE, tmp_path)
    path = tmp_path / MOTION
    path.write_bytes(path.read_bytes()[:size])
    with pytest.raises(InputError, match=r": is (not a NetCDF file|damaged: HDF5)"):
        read_motion(tmp_path)
    for _ in range(2 * (size > 0)):  # the file is left as it is
        with pytest.raises(DamagedError, match="remove it"):
            run(CASE, tmp_path, 0)
    if size:
        path.unlink()
    assert run(CASE, tmp_path, 0) == ANEW[:2]


def test_an_empty_journal_of_a_killed_run_is_used(tmp_path):
    (tmp_path / MOTION_JOURNAL).touch()
    assert not is_stored(tmp_path)
    with pytest.raises(InputError, match=r"motion\.nc: cannot be read, no such file"):
        read_motion(tmp_path)
    assert run(CASE, tmp_path, 0) == ANEW[:2]


@pytest.fixture
def of_release(tmp_path):
    """File of a run that version 1.0.0 was stopped in, after four of twelve steps."""
    content = (ROOT / "tests" / "data" / "motion" / "stopped-1.0.0.nc.gz").read_bytes()
    (tmp_path / MOTION).write_bytes(gzip.decompress(content))
    return tmp_path / MOTION


def test_a_stopped_run_of_the_first_version_is_read_and_not_resumed(tmp_path, of_release, whole):
    content = of_release.read_bytes()
    part = load(tmp_path).to_xarray()
    assert (part.attrs["complete"], part.attrs["version"]) == (0, "1.0.0")
    assert list(part.variables) == list(whole.variables)
    np.testing.assert_allclose(part["pressure"], whole["pressure"][:2], rtol=1e-6)
    np.testing.assert_allclose(part["minimum_thickness"], whole["minimum_thickness"][:5], rtol=1e-9)
    assert saved_run(tmp_path) == (4, CASE.to_toml())
    says = r"motion\.nc: contains a stopped run without motion\.sqlite, which cannot be resumed; expected an"
    with pytest.raises(InputError, match=says):
        run(CASE, tmp_path)
    assert of_release.read_bytes() == content
    assert [path.name for path in tmp_path.iterdir()] == [MOTION]
    of_release.unlink()
    assert run(CASE, tmp_path, 0) == ANEW[:2]


def test_a_file_that_the_first_version_was_killed_in_is_refused(tmp_path, of_release):
    """It may be half changed; its list of changes is read by that version only."""
    (tmp_path / MOTION_CHANGES).write_bytes(b"ehl redo 1\r\n")
    with pytest.raises(InputError, match=r"motion\.nc: has changes that a kill of version 1\.0\.0 left"):
        read_motion(tmp_path)
    of_release.unlink()
    run(CASE, tmp_path, 0)
    assert sorted(path.name for path in tmp_path.iterdir()) == [MOTION, MOTION_JOURNAL]


def test_a_killed_run_is_read_and_gets_its_file(tmp_path, stopped, whole):
    journal = stopped(8)
    content = journal.read_bytes()
    part = read_motion(tmp_path)
    assert part["frame_step"].values.tolist() == [0, 4, 8]
    assert sorted(path.name for path in tmp_path.iterdir()) == [MOTION, MOTION_JOURNAL]
    assert journal.read_bytes() == content
    from_file = read_motion(tmp_path / MOTION)
    assert from_file.identical(part)
    assert {name: from_file[name].dtype for name in part} == {name: part[name].dtype for name in part}
    assert load(tmp_path) == load(tmp_path / MOTION)
    assert run(CASE, tmp_path) == [of_step(8), of_step(12)]
    same(read_motion(tmp_path), whole)
    assert [path.name for path in tmp_path.iterdir()] == [MOTION]


def test_a_run_is_read_while_it_goes_on(tmp_path, whole):
    """Every instant is there once it is recorded; the reader writes nothing into the folder."""
    shown = []

    def progress(_done, _of, text):
        if text == "time steps":
            shown.append((load(tmp_path).frames, read_motion(tmp_path).sizes["step"], saved_run(tmp_path)[0]))
            assert not (tmp_path / MOTION).exists()

    run_motion(CASE, tmp_path, progress=progress)
    assert shown == [(1, 1, 0), (2, 5, 4), (3, 9, 8), (4, 13, 12)]
    same(read_motion(tmp_path), whole)


def test_a_full_disk_keeps_the_instants_and_says_so(tmp_path, stopped, whole):
    """SQLite itself refuses more pages, as on a full disk."""
    path = stopped(4)

    def progress(done, _of, text):
        if done == 4 and text == "time steps":
            patched(path)

    def patched(_):
        (journal,) = journals
        (pages,) = journal.file.execute("PRAGMA page_count").fetchone()
        journal.file.execute(f"PRAGMA max_page_count = {pages}")

    journals, enter = [], MotionJournal.__enter__
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(MotionJournal, "__enter__", lambda self: journals.append(self) or enter(self))
        says = r"motion\.sqlite: cannot be written to, database or disk is full; free some space, or choose"
        with pytest.raises(InputError, match=says):
            run_motion(CASE, tmp_path, progress=progress)
    assert read_motion(tmp_path)["frame_step"].values.tolist() == [0, 4]
    assert run(CASE, tmp_path) == [of_step(4), of_step(8), of_step(12)]
    same(read_motion(tmp_path), whole)


@pytest.mark.slow
def test_what_cannot_be_read_is_said(tmp_path):
    with pytest.raises(InputError, match=r"motion\.nc: .*no such file"):
        read_motion(tmp_path)
    other = tmp_path / "text.nc"
    other.write_text("mine\n" * 100)
    with pytest.raises(InputError, match=r"text\.nc: is not a NetCDF file$"):
        read_motion(other)
    with h5netcdf.File(tmp_path / "other.nc", "w") as file:
        file.dimensions = {"x": 3}
        file.create_variable("x", ("x",), "f8")
    with pytest.raises(InputError, match=r"other\.nc: is not a run with moving roughness of ehlectric$"):
        read_motion(tmp_path / "other.nc")


@pytest.mark.slow
@pytest.mark.parametrize(("name", "value"), [("frames", 0), ("case", "title = 3")])
def test_a_motion_without_an_instant_or_a_case_is_none(tmp_path, stopped, name, value):
    stopped(4)
    read_motion(tmp_path)
    with h5netcdf.File(tmp_path / MOTION, "a") as file:
        file.attrs[name] = value
    with pytest.raises(DamagedError, match=r"is damaged: .*(2 of 0|case)"):
        read_motion(tmp_path)


@pytest.mark.slow
def test_a_step_that_is_not_solved_leaves_what_was_found(tmp_path, monkeypatch, whole, stopped):
    stopped(0)
    advance, solved = UnsteadyFilm.advance, []
    own = TransientContact.of(CASE).schedule.step

    def failing(self, history, step):
        if step > 1.5 * own:  # a step of the coarse run
            return advance(self, history, step)
        if len(solved) == 6:
            raise ConvergenceError("film not found at T = 1.3")
        solved.append(step)
        return advance(self, history, step)

    with monkeypatch.context() as patch:
        patch.setattr(UnsteadyFilm, "advance", failing)
        with pytest.raises(ConvergenceError, match=r"^step 7 of 12: film not found at T = 1\.3$"):
            run(CASE, tmp_path)
    part = read_motion(tmp_path)
    assert part["frame_step"].values.tolist() == [0, 4]
    assert (part.sizes["step"], part.attrs["complete"]) == (5, 0)
    assert run(CASE, tmp_path) == [of_step(4), of_step(8), of_step(12)]
    same(read_motion(tmp_path), whole)


def test_a_film_before_the_motion_that_is_not_found(tmp_path):
    case = CASE.replace({"solver.max_iterations": 1})
    with pytest.raises(ConvergenceError, match=r"^film before the motion, "):
        run(case, tmp_path)
    assert not (tmp_path / MOTION).exists()


@pytest.mark.slow
def test_roughness_that_is_not_solved_held_still_has_no_maps(tmp_path, monkeypatch):
    from ehlectric.contact.solver import solve
    from ehlectric.motion import run as motion_run

    def never(case, **keys):
        solved = solve(case, **keys)
        return replace(solved, film=replace(solved.film, status="stalled"))

    monkeypatch.setattr(motion_run, "solve", never)
    run(CASE, tmp_path, 0)
    part = read_motion(tmp_path)
    assert not [name for name in part.variables if str(name).startswith("stationary")]
    assert part.attrs["stationary"] == "null"
    texts, codes = (json.loads(part.attrs[name]) for name in ("warnings", "warning_codes"))
    told = dict(zip(codes, texts, strict=True))["stationary-not-converged"]
    assert told.startswith("the film with stationary roughness did not converge (")


@pytest.mark.slow
def test_roughness_that_is_another_one_held_still_is_said(tmp_path):
    """Its Rq is of all that is made: three passes of it are another sample than one domain."""
    rough = {"surface": 1, "generator": "gaussian", "rq": 1e-9, "correlation_length": 6e-5, "seed": 1}
    said = "the moving roughness differs from the stationary roughness"
    for extra, expected in (({}, False), ({"rescale_rq": 1e-9}, True)):
        case = moving(roughness=[rough | extra], motion={"passes": 3.0, "steps": 24, "record": 2})
        run(case, tmp_path, 0)
        assert (said in read_motion(tmp_path).attrs["warnings"]) == expected


@pytest.mark.slow
def test_warnings_are_of_the_grid_of_the_case(tmp_path):
    """Eight intervals in a wave: as many as resolve it, however far it travels."""
    wave = 8.0 * 6.0 / 64.0 * TransientContact.of(CASE).half_width
    rough = {"surface": 1, "generator": "sinusoid", "amplitude": 1e-9, "wavelength": 1.001 * wave}
    motion = {"passes": 3.0, "steps": 24, "record": 2}
    run(moving(roughness=[rough], motion=motion), tmp_path, 0)
    assert "does not resolve" not in read_motion(tmp_path).attrs["warnings"]
    run(moving(roughness=[rough | {"wavelength": 0.95 * wave}], motion=motion), tmp_path, 0)
    assert "does not resolve" in read_motion(tmp_path).attrs["warnings"]


PITS = [{"surface": 1, "generator": "pit", "depth": "100 nm", "width": "90 um"}]


@pytest.mark.slow
@pytest.mark.parametrize("beside", [0.0, 3e-5])
def test_a_point_contact(tmp_path, beside):
    """65 x 65 nodes, a pit in the middle or beside it; what is solved in one half is there in both."""
    rough = [PITS[0] | {"position_y": beside}]
    case = moving(POINT, roughness=rough, motion={"passes": 0.5, "steps": 4, "record": 3})
    run(case, tmp_path, 2)
    told = run(case, tmp_path)
    assert told == [of_step(2, 4), of_step(4, 4)]
    shown = read_motion(tmp_path)
    assert dict(shown.sizes) == {"x": 65, "y": 65, "step": 5, "frame": 3}
    contact = TransientContact.of(case)
    assert contact.problem.width.symmetric == (beside == 0.0)
    a = contact.half_width
    np.testing.assert_allclose(shown["y"], np.linspace(-3.0, 3.0, 65) * a, rtol=1e-12, atol=1e-18)
    assert shown["capacitance"].attrs["units"] == "F"
    thickness, pressure = shown["thickness"].values, shown["pressure"].values
    alike = np.array_equal(thickness, thickness[:, :, ::-1])
    assert alike == (beside == 0.0)
    # The load, 20 N, carried at every instant; 65 nodes and single precision.
    weights = np.outer(np.gradient(shown["x"].values), np.gradient(shown["y"].values))
    np.testing.assert_allclose(np.sum(pressure * weights, axis=(1, 2)), 20.0, rtol=2e-2)
    for frame in range(3):
        depth = shown["roughness_1"].values[frame]
        at = shown["frame_time"].values[frame] / contact.schedule.time
        expected = contact.roughness.heights(at, shown["x"].values / a, shown["y"].values / a)[0]
        np.testing.assert_allclose(depth, expected, rtol=1e-6, atol=1e-20)
    least = shown.isel(step=-1)
    last = thickness[-1]
    i, j = np.unravel_index(np.argmin(last), last.shape)
    assert least["minimum_thickness"] == pytest.approx(last[i, j], rel=1e-6)
    assert least["minimum_x"] == shown["x"][i]
    assert abs(least["minimum_y"]) == abs(shown["y"][j])
    inside = np.isfinite(shown["strength"].values[-1])
    x, y = np.meshgrid(shown["x"] / a, shown["y"] / a, indexing="ij")
    np.testing.assert_array_equal(inside, (np.abs(x) <= 1.25 + 1e-9) & (np.abs(y) <= 1.25 + 1e-9))


def held(path):
    """A reader that has a file open, as HDF5 locks it."""
    reader = path.open("rb")
    fcntl.flock(reader, fcntl.LOCK_SH)
    return reader


@pytest.mark.slow
def test_who_looks_at_a_run_does_not_end_it(tmp_path, stopped, whole):
    """Also where the reader holds a transaction open when an instant is to be written."""
    path = stopped(8)
    with closing(sqlite3.connect(path, isolation_level=None, check_same_thread=False)) as reader:
        reader.execute("BEGIN")
        reader.execute("SELECT * FROM instants").fetchone()
        thread = Thread(target=lambda: (time.sleep(1.0), reader.execute("COMMIT")))
        thread.start()
        assert run(CASE, tmp_path) == [of_step(8), of_step(12)]
        thread.join()
    same(read_motion(tmp_path), whole)


@pytest.mark.slow
def test_a_run_from_the_start_leaves_the_old_file_to_who_reads_it(tmp_path, stopped):
    stopped(12)
    run(CASE, tmp_path)
    with held(tmp_path / MOTION) as reader:
        before = (tmp_path / MOTION).read_bytes()
        assert run(CASE, tmp_path, 0) == ANEW[:2]
        assert reader.read() == before
    assert read_motion(tmp_path).sizes["frame"] == 1


def test_who_does_not_close_it_is_told(tmp_path, monkeypatch, stopped):
    monkeypatch.setattr(netcdf_files, "_PATIENCE", 0.0)
    stopped(8)
    read_motion(tmp_path)
    reader = held(tmp_path / MOTION)
    assert read_motion(tmp_path).sizes["frame"] == 3
    fcntl.flock(reader, fcntl.LOCK_EX)
    text = f"{tmp_path}/motion.nc: is held open by another program, which must close it"
    with pytest.raises(InputError, match=f"^{re.escape(text)}$"):
        read_motion(tmp_path)
    reader.close()


@pytest.mark.slow
def test_a_second_run_in_the_same_folder_is_refused(tmp_path, stopped, whole):
    """Also in a call within the first one, which holds the folder already."""
    stopped(4)
    refused = []

    def progress(*what):
        if what[0] == 4:
            with pytest.raises(InputError, match=r"is being written to by another ehlectric") as error:
                run(CASE, tmp_path)
            refused.append(error.value)

    run_motion(CASE, tmp_path, progress=progress)
    assert len(refused) == 1
    same(read_motion(tmp_path), whole)


@pytest.mark.parametrize(
    "number",
    [signal.SIGTERM, *(pytest.param(n, marks=pytest.mark.slow) for n in (signal.SIGINT, signal.SIGHUP))],
)
def test_a_signal_waits_until_an_instant_is_whole(tmp_path, monkeypatch, stopped, number):
    stopped(4)
    put, left = storage.add_arrays, 2

    def signalled(*what):
        nonlocal left
        left -= 1
        if not left:
            signal.raise_signal(number)
        put(*what)

    def stop(came, _frame):
        raise StoppedError(came)

    before = signal.signal(number, stop)
    try:
        with monkeypatch.context() as patch:
            patch.setattr(storage, "add_arrays", signalled)
            with pytest.raises(StoppedError, match=f"^{int(number)}$"):
                run_motion(CASE, tmp_path)
        assert signal.getsignal(number) is stop
    finally:
        signal.signal(number, before)
    assert read_motion(tmp_path)["frame_step"].values.tolist() == [0, 4, 8]
    assert saved_run(tmp_path)[0] == 8
    assert sorted(path.name for path in tmp_path.iterdir()) == [MOTION, MOTION_JOURNAL]


def test_in_another_thread_it_runs_too(tmp_path, stopped, whole):
    stopped(8)
    thread = Thread(target=run, args=(CASE, tmp_path))
    thread.start()
    thread.join()
    same(read_motion(tmp_path), whole)


def test_only_what_is_new_is_written(tmp_path, monkeypatch, stopped):
    """Memory does not grow with the steps: each goes once."""
    stopped(0)
    append, written = MotionJournal.append, []

    def counted(self, record):
        written.append((len(record.rows), record.step))
        append(self, record)

    monkeypatch.setattr(MotionJournal, "append", counted)
    run(CASE, tmp_path)
    assert written == [(4, 4), (4, 8), (4, 12)]


def test_steps_that_are_saved(tmp_path, stopped):
    assert saved_run(tmp_path) == (0, "")
    for step in (0, 4, 12):
        stopped(step)
        assert saved_run(tmp_path) == (step, CASE.to_toml())
    run(CASE, tmp_path)
    assert saved_run(tmp_path) == (12, CASE.to_toml())
    (tmp_path / MOTION).write_text("no file of a run")
    assert saved_run(tmp_path) == (0, "")
    (tmp_path / MOTION_JOURNAL).write_text("no journal of a run")
    assert saved_run(tmp_path) == (0, "")
