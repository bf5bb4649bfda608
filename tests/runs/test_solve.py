"""What solve takes and gives: files, tables, cases and bearings; its progress, its log and its errors."""

import inspect
import logging
import tomllib

import numpy as np
import pytest

import ehlectric
from ehlectric import (
    BearingResult,
    Case,
    ConvergenceError,
    DriveResult,
    InputError,
    MotionResult,
    PointResult,
    Result,
    Sweep,
    load,
    run_motion,
    save,
    solve,
    solve_many,
    solve_motion,
)
from ehlectric.contact.contact_heat import physics_of
from ehlectric.contact.solver import solve as solve_stationary
from tests.conftest import PAPER_CONTACT
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.drives import small_drive
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

CONTACT = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}}
BEARING = bearing_case(BALLS, contacts="formula")
ROUGH = {"surface": 1, "generator": "sinusoid", "amplitude": "10 nm", "wavelength": "0.1 mm"}
MOTION = Case.from_dict(
    CONTACT | {"roughness": [ROUGH], "motion": {"passes": 0.5, "record": 2}, "grid": {"nodes": 201}}
)


@pytest.fixture(scope="module")
def line():
    return solve(CONTACT)


@pytest.fixture(scope="module")
def motion():
    return solve_motion(MOTION)


def test_a_contact_in_every_form(line, tmp_path):
    case = Case.from_dict(CONTACT)
    (tmp_path / "case.toml").write_text(case.to_toml(), encoding="utf-8")
    assert type(line) is Result
    for form in (case, str(tmp_path / "case.toml"), tmp_path / "case.toml"):
        assert solve(form) == line


def test_a_bearing_in_every_form(tmp_path):
    (tmp_path / "bearing.toml").write_text(BEARING.to_toml(), encoding="utf-8")
    results = [solve(form) for form in (BEARING, BEARING.to_dict(), tmp_path / "bearing.toml")]
    assert {type(result) for result in results} == {BearingResult}
    assert results[0] == results[1] == results[2]


@pytest.mark.slow
def test_a_drive_in_every_form(tmp_path):
    drive = small_drive(**{"drive.duration": "1 ms"})
    (tmp_path / "drive.toml").write_text(drive.to_toml(), encoding="utf-8")
    forms = (drive, drive.to_dict(), tmp_path / "drive.toml")
    results = [solve(form, workers=1) for form in forms]
    assert {type(result) for result in results} == {DriveResult}
    (many,) = solve_many([drive], workers=1)
    events = [result.events() for result in (*results, many.result)]
    assert events[0]
    assert all(one == events[0] for one in events)
    with pytest.raises(
        InputError, match="solvers: got 'paper'; expected 'ehlectric' for a bearing or a drive"
    ):
        solve(drive, solvers="paper")


def test_a_point_contact():
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": 20, "reduced_modulus": 226e9}
    table = {"contact": contact | {"entrainment_speed": 2}, "lubricant": {"base": "paper"}}
    assert type(solve(table | {"grid": {"nodes": 65}})) is PointResult


@each(
    ("given", "text"),
    [
        (EXAMPLES / "sweep.toml", r"sweep\.toml: .*run_sweep"),
        (tomllib.loads((EXAMPLES / "sweep.toml").read_text(encoding="utf-8")), "case: .*run_sweep"),
        (Sweep.from_dict({"case": CONTACT, "vary": {"grid.nodes": [201]}}), "run_sweep"),
        (MOTION, r"motion: .*solve_motion"),
        ("nowhere.toml", "nowhere.toml: cannot be read"),
        (5, "case: got 'int'; .*Case, .*BearingCase, .*DriveCase, .*dict"),
        ({"contcat": {}}, "contcat: unknown key"),
    ],
)  # fmt: skip
def test_what_cannot_be_solved(given, text):
    with pytest.raises(InputError, match=text):
        solve(given)


def test_solvers_by_name():
    case = Case.from_dict(CONTACT | {"grid": {"nodes": 201, "wedge": "first-order"}})
    assert solve(case, solvers="paper").film_solver == "paper"
    with pytest.raises(InputError, match="solvers: got 'papper'; expected one of ehlectric, paper"):
        solve(case, solvers="papper")
    with pytest.raises(InputError, match="solvers: got 'paper'; expected 'ehlectric' for a bearing"):
        solve(BEARING.to_dict(), solvers="paper")


def test_help_has_no_addresses():
    for function in (solve, solve_stationary, ehlectric.solve_many):
        assert " at 0x" not in str(inspect.signature(function))


@pytest.mark.parametrize("changes", [{}, {"grid.refine": 0.01, "grid.nodes": 201}, {"roughness": (ROUGH,)}])
def test_progress_never_decreases(changes):
    seen = []
    solve(Case.from_dict(CONTACT).replace(changes), progress=lambda *told: seen.append(told))
    done = [now for now, _, _ in seen]
    assert {of for _, of, _ in seen} == {100}
    assert done == sorted(done)
    assert done[0] == 0
    assert done[-1] == 100
    assert len(set(done)) > 4
    assert "nodes, step" in seen[0][2]


def test_convergence_can_be_required():
    case = Case.from_dict(CONTACT | {"solver": {"max_iterations": 1}})
    assert not solve(case).converged
    with pytest.raises(ConvergenceError, match="stalled"):
        solve(case, require_convergence=True)


def test_a_contact_is_prepared_once(tmp_path, monkeypatch):
    """Heat and shear of its film are those of the preparation; warnings and solution take them from there."""
    cases = []

    def counted(case, conditions):
        cases.append(case)
        return physics_of(case, conditions)

    monkeypatch.setattr("ehlectric.contact.preparation.physics_of", counted)
    path = tmp_path / "case.toml"
    path.write_text(Case.from_dict(CONTACT).to_toml())
    for given in (path, CONTACT, Case.from_dict(CONTACT)):
        cases.clear()
        solve(given)
        assert len(cases) == 1


def test_warnings_are_logged_once(caplog):
    case = Case.from_dict(CONTACT | {"title": "Slow", "grid": {"nodes": 129}})
    with caplog.at_level(logging.WARNING, logger="ehlectric"):
        result = solve(case)
        logged = [record.getMessage() for record in caplog.records]
    assert result.warnings
    assert logged == [f"Slow: {warning} [{warning.code}]" for warning in result.warnings]
    caplog.clear()
    with caplog.at_level(logging.WARNING, logger="ehlectric"):
        solve_stationary(case)
    assert not caplog.records


def test_steps_are_logged(caplog):
    with caplog.at_level(logging.DEBUG, logger="ehlectric"):
        solve(CONTACT)
    levels = [record.levelno for record in caplog.records if "nodes" in record.getMessage()]
    assert levels.count(logging.INFO) == 1
    assert levels.count(logging.DEBUG) > 4


def test_nothing_is_printed_without_a_handler(capfd):
    """The standard library prints warnings of a logger without any handler on stderr."""
    assert solve(CONTACT | {"grid": {"nodes": 129}}).warnings
    assert capfd.readouterr() == ("", "")


@pytest.mark.slow
def test_a_motion_in_memory(motion, tmp_path):
    """The same as the file that run_motion writes, and as the folder is loaded."""
    assert motion.converged
    run_motion(MOTION, tmp_path)
    stored = load(tmp_path)
    assert type(stored) is type(motion) is MotionResult
    for name in ("pressure", "strength", "minimum_thickness"):
        np.testing.assert_array_equal(stored.values(name), motion.values(name))
    assert motion.summary()["film"] == stored.summary()["film"]
    assert motion == MotionResult.of(motion.to_xarray())


def test_a_motion_needs_one():
    with pytest.raises(InputError, match="motion: missing; expected it, or solve for a stationary contact"):
        solve_motion(Case.from_dict(CONTACT))


@pytest.mark.slow
def test_a_motion_that_ends_early_says_so(monkeypatch, caplog):
    def stopped(case, folder, *, progress):
        run_motion(case, folder, progress=progress)
        raise ConvergenceError("time step 9")

    monkeypatch.setattr("ehlectric.runs.solve.run_motion", stopped)
    with caplog.at_level(logging.WARNING, logger="ehlectric"):
        solve_motion(MOTION)
    assert "motion: the run ends early, time step 9" in caplog.messages


@pytest.mark.slow
@pytest.mark.parametrize("table", [CONTACT, BEARING], ids=["contact", "bearing"])
def test_saved_results_are_equal(table, tmp_path):
    result = solve(table)
    files = save(result, tmp_path)
    assert {path.parent for path in files} == {tmp_path}
    assert load(tmp_path) == load(next(path for path in files if path.suffix == ".nc")) == result


@pytest.mark.slow
def test_what_is_not_saved(motion, tmp_path):
    with pytest.raises(
        InputError, match="result: got 'MotionResult'; expected a result of a contact, a bear"
    ):
        save(motion, tmp_path)


def test_results_differ_where_their_numbers_do(line):
    other = solve(Case.from_dict(CONTACT).replace({"contact.entrainment_speed": "3.9 m/s"}))
    assert line != other
    assert line.film != other.film
    assert line.field != other.field
    assert line == solve(CONTACT)


def test_a_progress_that_cannot_be_called_is_refused():
    for function, case in ((ehlectric.solve, CONTACT), (ehlectric.solve_motion, MOTION)):
        with pytest.raises(InputError, match=r"^progress: got True; expected a function "):
            function(case, progress=True)
