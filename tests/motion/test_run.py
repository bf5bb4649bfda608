"""A whole transient run below the command line: what it hands back, and what it leaves in its folder."""

import json

import numpy as np
import pytest

from ehlectric.errors import ConvergenceError
from ehlectric.film.unsteady import UnsteadyFilm
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.run import run_motion, solve_to_folder
from ehlectric.motion.solver import TransientSolver
from ehlectric.motion.stored_run import read_motion
from ehlectric.runtime.result_names import MOTION
from ehlectric.surfaces import rough_surfaces
from tests.helpers.moving_cases import LINE, POINT, moving
from tests.helpers.places import DEKTAK

# Twelve steps of two grid spacings, recorded are 0, 4, 8 and 12.
CASE = moving(motion={"passes": 0.375, "steps": 12, "record": 4})


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Folder of a complete run."""
    folder = tmp_path_factory.mktemp("run")
    run_motion(CASE, folder)
    return folder


@pytest.fixture
def complete(folder, tmp_path):
    (tmp_path / MOTION).write_bytes((folder / MOTION).read_bytes())
    return tmp_path


def fail_at(monkeypatch, step):
    """Let the time step of a number fail, counted from the beginning or from where a run is resumed.

    Steps of the coarse run, which are longer, are not counted.
    """
    advance, calls = UnsteadyFilm.advance, []
    own = TransientContact.of(CASE).schedule.step

    def failing(self, history, length):
        if length > 1.5 * own:
            return advance(self, history, length)
        calls.append(length)
        if len(calls) == step:
            raise ConvergenceError("film not found")
        return advance(self, history, length)

    monkeypatch.setattr(UnsteadyFilm, "advance", failing)
    return calls


@pytest.mark.slow
def test_a_complete_run_without_a_summary_is_summed_up_alone(monkeypatch, complete):
    """As it is left by who stops a run between its last step and its summary; files of others go."""
    (complete / "result.nc").write_text("of another result")
    calls = fail_at(monkeypatch, 1)
    outcome = solve_to_folder(CASE, complete)
    assert not calls
    assert outcome.failure is None
    assert [path.name for path in outcome.files] == ["summary.json", MOTION]
    assert sorted(path.name for path in complete.iterdir()) == [MOTION, "summary.json"]
    assert json.loads(outcome.files[0].read_text()) == outcome.summary
    assert outcome.summary["motion"]["steps_done"] == outcome.result.sizes["step"] - 1 == 12


@pytest.mark.slow
def test_a_complete_run_with_a_summary_is_solved_again(monkeypatch, complete):
    (complete / "summary.json").write_text("{}")
    calls = fail_at(monkeypatch, 1)
    outcome = solve_to_folder(CASE, complete)
    assert len(calls) == 1
    assert outcome.failure == "not converged: step 1 of 12: film not found"


@pytest.mark.slow
def test_the_steps_before_a_failure_are_summed_up(monkeypatch, tmp_path):
    fail_at(monkeypatch, 7)
    told = []
    outcome = solve_to_folder(CASE, tmp_path, lambda *what: told.append(what))
    assert outcome.failure == "not converged: step 7 of 12: film not found"
    assert (outcome.summary["converged"], outcome.summary["motion"]["steps_done"]) == (False, 4)
    assert told[-1] == (4, 12, "time steps")


def test_without_a_film_before_the_motion_there_is_nothing_to_sum_up(tmp_path):
    with pytest.raises(ConvergenceError, match=r"^film before the motion, "):
        solve_to_folder(CASE.replace({"solver.max_iterations": 1}), tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_run_reads_each_surface_once(tmp_path, monkeypatch):
    """Checked, moved and at rest: one surface from one reading of its file."""
    read, paths = rough_surfaces.read_surface, []

    def counted(path, **units):
        paths.append(path)
        return read(path, **units)

    monkeypatch.setattr(rough_surfaces, "read_surface", counted)
    rough = {"surface": 1, "file": str(DEKTAK), "form": "parabola"}
    solve_to_folder(
        moving(LINE, roughness=[rough], motion={"passes": 0.25, "steps": 2, "record": 2}), tmp_path
    )
    assert list(map(str, paths)) == [str(DEKTAK)]


@pytest.mark.slow
@pytest.mark.parametrize("table", [LINE, POINT])
def test_a_table_film_without_heat_and_shear_changes_nothing(table, tmp_path):
    """A Newtonian isothermal film is what a case without the table has."""
    short = {"passes": 0.375, "steps": 12, "record": 4}
    for name, film in (("without", {}), ("plain", {"film": {}})):
        run_motion(moving(table, motion=short, **film), tmp_path / name)
    without, plain = (read_motion(tmp_path / name) for name in ("without", "plain"))
    for name in ("minimum_thickness", "thickness", "pressure", "max_strength"):
        np.testing.assert_array_equal(plain[name].values, without[name].values)


def test_the_gap_is_the_parabola_with_the_deflection():
    """h = h0 + x^2/(2R) + d of smooth surfaces, before the roughness enters, at all nodes."""
    solver = TransientSolver(TransientContact.of(moving()))
    film = solver.film(solver.start().now)
    rigid = film.thickness - film.x**2 / (2.0 * solver.contact.conditions.reduced_radius) - film.deflection
    assert np.ptp(rigid) < 1e-9 * np.ptp(film.deflection)
