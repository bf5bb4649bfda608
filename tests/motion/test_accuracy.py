"""Estimate of the error of a run: its coarse run against a run of its own, and made-up films by hand."""

import numpy as np
import pytest

from ehlectric.motion.coarse_run import CoarseRun
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import MotionRun, read_motion
from ehlectric.motion.summary import estimated, run_errors, summary_of
from tests.helpers.moving_cases import LINE, POINT, moving


def solved(case, folder):
    return read_motion(run_motion(case, folder))


@pytest.mark.slow
@pytest.mark.parametrize(("table", "steps"), [(LINE, 32), (LINE, 33), (POINT, 8)])
def test_the_coarse_run_is_a_run_on_every_second_node_with_twice_the_step(table, steps, tmp_path):
    """As solved from a case of its own; the last step of an odd number has no coarse run."""
    duration = 1.2 * TransientContact.of(moving(table)).schedule.time
    fine = {"duration": duration, "steps": steps, "record": 2}
    coarse = {"duration": duration * (steps // 2 * 2) / steps, "steps": steps // 2, "record": 2}
    run = solved(moving(table, {"grid.nodes": 129}, motion=fine), tmp_path / "fine")
    alone = solved(moving(table, motion=coarse), tmp_path / "coarse")
    for name in ("lowest_thickness", "central_thickness"):
        beside = run[f"coarse_{name}"].values
        assert np.all(np.isnan(beside[1::2]))
        np.testing.assert_allclose(beside[::2], alone[name].values, rtol=1e-6)


def test_of_a_second_order_film_more_than_the_third_of_the_change_is_estimated():
    """An error of e on the run is 4 e on its coarse run; here 1 % and 2 %."""
    ones = np.ones(5)
    errors = estimated((0.99 * ones, 0.96 * ones), (1.02 * ones, 1.08 * ones), 0.99)
    assert 0.01 / 0.99 < errors.minimum < 3.0 * 0.01
    assert 0.02 / 1.02 < errors.central < 3.0 * 0.02
    assert errors.largest == errors.central


def test_minima_that_agree_by_chance_still_differ_over_time():
    """The lowest values are equal; those of other instants, within 5 % of them, are 3 % apart."""
    fine, coarse = np.array([1.2, 1.03, 1.0]), np.array([1.1, 1.0, 1.03])
    errors = estimated((fine, coarse), (fine, fine), 1.0)
    assert errors.minimum == pytest.approx(0.03 / (2.0**1.25 - 1.0))
    assert 0.0 < errors.central < 1e-4


def test_the_place_between_the_nodes_counts():
    fine = np.array([1.0, 0.98])
    assert estimated((fine, fine), (fine, fine), 1.0).minimum == pytest.approx(0.02)


@pytest.mark.slow
def test_a_coarse_run_that_does_not_converge_leaves_the_error_unknown(tmp_path, monkeypatch):
    case = moving(motion={"passes": 0.25, "steps": 8, "record": 3})
    after = CoarseRun.after
    monkeypatch.setattr(CoarseRun, "after", lambda self, n, h: None if n == 6 else after(self, n, h))
    run = MotionRun.of(solved(case, tmp_path))
    assert run_errors(run) is None
    summary = summary_of(run.dataset)
    assert summary["converged"]
    assert summary["film"]["discretisation_error"] is None
    assert "error-unknown" in summary["warning_codes"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lag", "code"), [(0.005, None), (0.03, "grid-too-coarse"), (0.3, "grid-far-too-coarse")]
)
def test_a_large_error_is_warned_of(lag, code, tmp_path):
    case = moving(motion={"passes": 0.25, "steps": 8, "record": 3})
    dataset = solved(case, tmp_path)
    for name in ("lowest", "central"):
        dataset[f"coarse_{name}_thickness"] = (1.0 + lag) * dataset[f"{name}_thickness"]
    codes = summary_of(dataset)["warning_codes"]
    assert [one for one in codes if one in ("grid-too-coarse", "grid-far-too-coarse")] == [code] * bool(code)
