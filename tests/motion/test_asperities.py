"""Runs whose surfaces touch: what asperities carry at a step, over time, and in a run that is resumed."""

import json
from contextlib import suppress

import numpy as np
import pytest

from ehlectric.app.charts import motion_charts
from ehlectric.arrays import Array
from ehlectric.figures.motion_figures import figure, of_history
from ehlectric.film.face_flow import flow
from ehlectric.film.mesh import Mesh, Width
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.film.newton import State
from ehlectric.motion.motion_touching import Toucher, TouchHistory
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.run import run_motion, solve_to_folder
from ehlectric.motion.solver import TransientSolver
from ehlectric.motion.stored import TOUCHING, solved_part
from ehlectric.motion.stored_run import MotionRun, read_motion
from ehlectric.motion.summary import run_errors, summary_of
from ehlectric.motion.warnings import touch_warnings
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import MOTION_KEYS
from ehlectric.runtime.file_rules import UnfitError
from ehlectric.runtime.result_names import MOTION_JOURNAL
from ehlectric.tables.motion_tables import run_rows
from tests.helpers.moving_cases import LINE, POINT, moving
from tests.motion.test_file import StoppedError, same
from tests.motion.test_summary import made

SLOW = {"entrainment_speed": "0.05 m/s"}
WAVE = {"surface": 1, "generator": "sinusoid", "amplitude": "0.2 um", "wavelength": "60 um"}
# The film is pierced between the steps 34 and 41.
CASE = moving(LINE, contact=LINE["contact"] | SLOW, roughness=[WAVE], motion={"passes": 0.75, "record": 8})
FULL = moving(LINE, motion={"passes": 0.75, "record": 8})


def state(mesh: Mesh, contact_pressure: Array) -> State:
    return State(np.ones(mesh.shape), 0.0, np.ones(mesh.shape), contact_pressure)


def test_two_strips_of_a_line():
    contact = TransientContact.of(CASE)
    b, mesh = contact.half_width, Mesh.over(65, -4.0, 2.0)  # nodes 3/32 apart
    pressure = np.zeros(mesh.shape)
    pressure[40:43] = 0.5
    pressure[46] = 2.0
    touch = Toucher(contact, mesh).at(state(mesh, pressure))
    width = 3.0 / 32.0
    conditions = contact.conditions
    carried = (3 * 0.5 + 2.0) * conditions.max_pressure * width * b
    assert touch.load_share == pytest.approx(carried / conditions.load_per_length)
    assert touch.area_share == pytest.approx(4 * width / 2.0)
    assert touch.spots == 2
    assert Toucher(contact, mesh).at(state(mesh, np.zeros(mesh.shape))).spots == 0


def test_a_spot_of_half_a_contact_counts_on_both_sides():
    contact = TransientContact.of(moving(POINT))
    mesh = Mesh.over(61, -4.0, 2.0, Width(61, 3.0))  # nodes 0.1 apart
    assert mesh.symmetric
    pressure = np.zeros(mesh.shape)
    pressure[40, 4] = 1.0
    touch = Toucher(contact, mesh).at(state(mesh, pressure))
    assert touch.spots == 2
    # The load of Hertz' ellipse is 2/3 of its area times the largest pressure.
    assert touch.load_share == pytest.approx(2 * 0.01 / (2.0 / 3.0 * np.pi), rel=1e-3)
    assert touch.area_share == pytest.approx(2 * 0.01 / np.pi, rel=0.01)
    pressure[40, 4], pressure[40, 0] = 0.0, 1.0
    assert Toucher(contact, mesh).at(state(mesh, pressure)).spots == 1


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A run from its start to its end: its outcome, and its journal after the steps 34 and 41."""
    folder, files = tmp_path_factory.mktemp("touching"), {}

    def progress(done, _of, text):
        if text == "time steps" and done in (34, 41):
            files[done] = (folder / MOTION_JOURNAL).read_bytes()

    return solve_to_folder(CASE, folder, progress), files


@pytest.mark.slow
def test_every_step_has_what_its_film_has(written):
    dataset = written[0].result
    solver = TransientSolver(TransientContact.of(CASE))
    load = solver.contact.conditions.load_per_length
    inside = np.abs(dataset["x"].values) < solver.contact.half_width
    for step, history in solver.run(solver.start()):
        film, row = solver.film(history.now), dataset.isel(step=step)
        cell = film.x[1] - film.x[0]
        carried = 0.0 if film.contact_pressure is None else cell * np.sum(film.contact_pressure)
        assert float(row["asperity_load_share"]) == pytest.approx(carried / load)
        # Edges of a strip: a node in contact after one that is not.
        assert int(row["spots"]) == np.count_nonzero(np.diff(film.contact.astype(int)) == 1)
        part = np.count_nonzero(film.contact & inside) / np.count_nonzero(inside)
        assert float(row["contact_area_share"]) == pytest.approx(part, abs=0.06)
    assert dataset["spots"].values[34] == 0 < dataset["spots"].values[41]


@pytest.mark.slow
def test_oil_is_kept_where_surfaces_come_into_contact():
    """Change of the oil of every node by the Couette flow, less what the pressure drives in: nothing is left.

    Oil moves by one node in a step. The masses of cavitated nodes and of those in contact count as well.
    """
    contact = TransientContact.of(CASE)
    moving_film, step = MovingFilm(contact.problem, contact.moving_gap), contact.schedule.step
    history, mesh = moving_film.start(step), moving_film.film.level.mesh
    assert step == pytest.approx(mesh.dx)
    spots = []
    for _ in range(contact.schedule.steps):
        earlier, last = history.before.mass, history.now.mass
        history = moving_film.film.advance(history, step)
        now = history.now
        if history.effort.halvings or not now.state.touching.any():
            continue
        spots.append(np.count_nonzero(now.state.touching))
        change = (1.5 * now.mass[3:-1] - 2.0 * last[2:-2] + 0.5 * earlier[1:-3]) / step
        gap = np.maximum(now.state.thickness, contact.problem.boundary_film)
        driven = flow(contact.problem.fluid, now.state.oil_pressure, gap, mesh).along.divergence()[2:]
        flown = np.mean(now.mass[np.abs(mesh.x) < 1.0])
        assert mesh.dx * np.abs(change - driven).sum() < 1e-6 * flown
    assert len(spots) > 5
    assert max(spots) > 1


@pytest.mark.slow
def test_balance_of_the_load_with_asperities(written):
    """Oil and asperities carry the load at all recorded instants, some with a quarter of it in spots."""
    dataset = written[0].result
    cell = float(np.diff(dataset["x"].values[:2])[0])
    load = MotionRun.of(dataset).conditions.load_per_length
    carried = cell * dataset["pressure"].values.astype(float).sum(axis=1)
    assert carried == pytest.approx(np.full(carried.size, load), rel=1e-4)
    assert dataset["asperity_load_share"].values.max() > 0.05


@pytest.mark.slow
@pytest.mark.parametrize("step", [34, 41], ids=["before spots", "among spots"])
def test_a_resumed_run_has_the_same_asperities(written, step, tmp_path):
    outcome, files = written
    (tmp_path / MOTION_JOURNAL).write_bytes(files[step])
    assert ("spots" in read_motion(tmp_path)) == (step == 41)
    told = []
    run_motion(CASE, tmp_path, progress=lambda done, _of, _text: told.append(done))
    assert told[0] == step
    same(read_motion(tmp_path), outcome.result)


@pytest.mark.slow
def test_the_summary_tables_figures_and_warnings_say_it(written):
    outcome, _ = written
    summary, dataset = outcome.summary, outcome.result
    found = summary["asperities"]
    assert all(key_of(MOTION_KEYS["line"], f"asperities.{name}") for name in found)
    late = dataset["time"].values >= MotionRun.of(dataset).field_history.settled_from
    assert found["load_share_mean"] == pytest.approx(dataset["asperity_load_share"].values[late].mean())
    assert found["load_share_largest"] == dataset["asperity_load_share"].values.max()
    assert "asperities-touch" in summary["warning_codes"]
    # The minimum is the boundary film, whose error means nothing.
    assert not {"grid-far-too-coarse", "error-unknown", "stationary-error"} & set(summary["warning_codes"])
    assert summary["film"]["discretisation_error"] is None
    rows = {row.key: row for row in run_rows(summary)}
    assert rows["asperities.spots_mean"].value == found["spots_mean"]
    assert f"of {found['steps']} evaluated time steps" in rows["asperities.time_share"].text
    assert rows["film.minimum_thickness"].text.endswith("in the boundary film")
    moving_run = MotionRun.of(dataset)
    assert "Asperities are in contact" in of_history(moving_run)
    labels = [ax.get_ylabel() for ax in figure(moving_run, "motion_history.png").axes]
    assert "share [%]" in labels
    assert "load share of asperities" in [
        trace["name"] for trace in motion_charts.history(moving_run)["data"]
    ]


@pytest.mark.slow
def test_a_run_that_never_touches_says_nothing(tmp_path):
    """Its file, its table and its figure have nothing of asperities; its summary has no time with a spot."""
    outcome = solve_to_folder(FULL, tmp_path)
    assert not set(TOUCHING) & set(outcome.result.variables)
    found = outcome.summary["asperities"]
    assert (found["time_share"], found["load_share_mean"], found["load_share_largest_time"]) == (
        0.0,
        0.0,
        None,
    )
    assert "asperities-touch" not in outcome.summary["warning_codes"]
    assert not any("asperit" in row.name or "spot" in row.name for row in run_rows(outcome.summary))
    labels = [ax.get_ylabel() for ax in figure(MotionRun.of(outcome.result), "motion_history.png").axes]
    assert "share [%]" not in labels
    drawn = motion_charts.history(MotionRun.of(outcome.result))["data"]
    assert "load share of asperities" not in [trace["name"] for trace in drawn]


# The Hertz zone is covered from T = 6 on.
LONG = moving(LINE, motion={"passes": 2.0})
TIMES = [0.0, 3.0, 6.0, 7.0, 8.0, 9.0]


def touching(spots, *, load=None, coarse=None):
    spots = np.asarray(spots, dtype=float)
    load = 0.1 * spots if load is None else load
    values = (load, 0.05 * spots, spots, load if coarse is None else coarse)
    found = {name: ("step", np.asarray(each, float)) for name, each in zip(TOUCHING, values, strict=True)}
    return made(LONG, times=TIMES).assign(found)


def test_statistics_over_time():
    """Steps before the contact is covered do not count; the largest load share is that of all steps."""
    found = summary_of(touching([0, 3, 0, 1, 2, 0]))["asperities"]
    assert found["steps"] == 4
    assert found["load_share_mean"] == pytest.approx(0.3 / 4)
    assert found["load_share_largest"] == pytest.approx(0.3)
    assert found["load_share_largest_time"] == touching([0] * 6)["time"].values[1]
    assert found["contact_area_share_mean"] == pytest.approx(0.15 / 4)
    assert found["spots_mean"] == pytest.approx(0.75)
    assert found["time_share"] == 0.5


def test_the_load_share_of_the_coarse_run():
    """At every second step; a change of the share by above a tenth is told, and a lack of it."""

    def of(coarse):
        found = summary_of(touching([0, 0, 1, 1, 2, 0], coarse=coarse))
        return found["asperities"]["load_share_mean_coarser"], found["warning_codes"]

    nan = np.nan
    share, codes = of([0.0, nan, 0.1, nan, 0.2, nan])
    assert share == pytest.approx(0.15)
    assert "load-share-unresolved" not in codes
    share, codes = of([0.0, nan, 0.1, nan, 0.25, nan])
    assert share == pytest.approx(0.175)
    assert "load-share-unresolved" in codes
    share, codes = of([0.0, nan, 0.1, nan, nan, nan])
    assert share is None
    assert "load-share-unresolved" in codes


def test_spots_of_the_coarse_run_alone_change_nothing():
    """On its coarse grid a film may touch that does not on the grid of the run."""
    without = made(LONG, times=TIMES)
    coarse = touching([0] * 6, coarse=[0.5] * 6)
    assert TouchHistory.of(MotionRun.of(coarse)) is None
    found = summary_of(coarse)
    assert found["asperities"].pop("load_share_mean_coarser") == 0.5
    expected = summary_of(without)
    assert expected["asperities"].pop("load_share_mean_coarser") is None
    assert json.dumps(found) == json.dumps(expected)


def test_a_run_that_touches_has_no_error_of_its_minimum():
    """The minimum between the nodes may be negative beside a spot, as that of a parabola."""
    names = ("lowest_thickness", "coarse_lowest_thickness", "central_thickness", "coarse_central_thickness")
    values = {name: ("step", np.full(6, -1e-9 if "lowest" in name else 1e-8)) for name in names}
    assert run_errors(MotionRun.of(touching([0, 0, 1, 1, 1, 1]).assign(values))) is None


@pytest.mark.slow
@pytest.mark.parametrize(("name", "value"), [("spots", 1.5), ("asperity_load_share", -0.1)])
def test_damaged_values_are_refused(written, name, value, tmp_path):
    (tmp_path / MOTION_JOURNAL).write_bytes(written[1][41])
    dataset = read_motion(tmp_path)
    wrong = np.where(np.arange(dataset.sizes["step"]) == 3, value, dataset[name].values)
    with pytest.raises(UnfitError, match=name):
        solved_part(dataset.assign({name: ("step", wrong, dataset[name].attrs)}))


@pytest.mark.slow
def test_a_point_contact(tmp_path):
    """An asperity that enters touches; a run that is stopped then goes on as if it had not been."""
    asperity = {"surface": 1, "generator": "asperity", "height": "300 nm", "width": "60 um"}
    table = POINT | {"contact": POINT["contact"] | SLOW, "roughness": [asperity]}
    case = moving(table, motion={"passes": 1.0, "record": 8})

    def until(done, _of, text):
        if text == "time steps" and done >= 56:
            raise StoppedError

    outcome = solve_to_folder(case, tmp_path / "whole")
    with suppress(StoppedError):
        run_motion(case, tmp_path / "parts", progress=until)
    run_motion(case, tmp_path / "parts")
    same(read_motion(tmp_path / "parts"), outcome.result)
    found = outcome.summary["asperities"]
    assert 0.0 < found["time_share"] < 1.0
    assert found["spots_mean"] == pytest.approx(found["time_share"])
    last = outcome.result.isel(frame=-1)
    touched = last["thickness"].values <= 1.0001e-9
    assert np.any(touched)
    assert outcome.result["spots"].values[-1] >= 1


@pytest.mark.parametrize("filled", [True, False])
def test_a_run_that_the_roughness_never_fills_is_told(filled):
    share, counted = np.full(3, 0.2), np.ones(3, dtype=bool)
    found = TouchHistory(np.arange(3.0), share, share, np.ones(3), share, counted, filled)
    told = next(touch_warnings(found)).text
    assert ("more motion.passes" in told) != filled
