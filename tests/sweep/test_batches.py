"""Sweeps of bearings with quick contacts: points that are solved together, and what a folder has of them."""

import os
import signal
from contextlib import nullcontext
from dataclasses import replace

import pytest

from ehlectric import read_sweep
from ehlectric.quantities.result_warnings import CODES
from ehlectric.runtime.worker_processes import Crew, processes, this_process
from ehlectric.sweep.batches import Batch, batches_of, run_batches, seconds_of, solve_batch
from ehlectric.sweep.engine import plan, solve_point
from ehlectric.sweep.point_groups import plan_together
from ehlectric.sweep.run import solve_to_folder
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case
from tests.helpers.each import each

SPEED, LOAD, RQ = "bearing.inner_speed", "bearing.radial_load", "bearing.composite_rq"


def swept(case, vary, **keys):
    return Sweep.from_dict({"case": case, "vary": vary} | keys)


def batched(sweep):
    """Batches of a sweep, and its points in none of them."""
    return batches_of(sweep, [(point.key, point.inputs) for point in plan_together(sweep)])


def check_equal(one, other, key=""):
    """Compare two values of summaries: tables, lists, texts and numbers."""
    if isinstance(one, dict):
        assert list(one) == list(other), key
        for name, value in one.items():
            check_equal(value, other[name], f"{key}.{name}")
    elif key.endswith("residual"):
        assert max(one, other) < 1e-9
    elif isinstance(one, float):
        # An estimate of an error is a difference of numbers that are nearly equal.
        assert one == pytest.approx(other, rel=1e-6 if key.endswith("_error") else 1e-8, abs=1e-300), key
    else:
        assert one == other, key


def check_same(together, single):
    """Compare the outcome of a point in a batch with that of the point alone."""
    assert (together.status, together.reason, together.again) == (single.status, single.reason, single.again)
    if single.summary is None:
        assert together.summary is None
        return
    one, other = dict(together.summary), dict(single.summary)
    for summary in (one, other):
        texts = summary.pop("warnings")
        assert len(texts) == len(summary["warning_codes"])
        summary["warning_codes"] = set(summary["warning_codes"])
        del summary["seconds"]
    check_equal(one, other)


@pytest.mark.slow
@pytest.mark.parametrize("shape", [BALLS, ROLLERS])
@pytest.mark.parametrize("contacts", ["atlas", "formula"])
def test_a_batch_has_the_numbers_and_codes_of_its_points(shape, contacts):
    """At random points, from touching surfaces to full films, and at loads that no bearing carries."""
    case = bearing_case(shape, contacts=contacts)
    ranges = {
        SPEED: {"from": "100 rpm", "to": "20000 rpm", "spacing": "log"},
        LOAD: {"from": "100 N", "to": "20 kN", "spacing": "log"},
        RQ: {"from": "0.02 um", "to": "0.3 um", "spacing": "log"},
    }
    (batch,), others = batched(swept(case, ranges, design="sobol", samples=4, seed=3))
    assert not others
    found = solve_batch(batch)
    assert {outcome.status for outcome in found} >= {"solved"}
    for outcome, (_, table) in zip(found, batch.tasks(), strict=True):
        check_same(outcome, solve_point(table))


@pytest.mark.slow
@pytest.mark.gate
def test_points_without_a_result_have_the_reason_that_they_have_alone():
    """The grooves of a bearing end before the contact of a ball with a load of tons."""
    loads = {LOAD: ["1 kN", "30 kN", "300 kN"], "bearing.axial_load": ["0 N", "300 kN"]}
    (batch,), others = batched(swept(bearing_case(BALLS, contacts="formula"), loads))
    assert not others
    found = solve_batch(batch)
    assert {outcome.status for outcome in found} == {"solved", "failed"}
    for outcome, (_, table) in zip(found, batch.tasks(), strict=True):
        check_same(outcome, solve_point(table))


def test_names_and_whole_numbers_have_batches_of_their_own():
    """A group of one point is none; a point with solved contacts is in no batch."""
    vary = {
        "contacts": ["formula", "atlas"],
        "bearing.elements": [8, 9],
        SPEED: ["1000 rpm", "2000 rpm", "3000 rpm"],
        "bearing.film_factor": ["none", 0.9],
    }
    sweep = swept(bearing_case(BALLS), vary)
    batches, others = batched(sweep)
    assert not others
    assert [len(batch.keys) for batch in batches] == [3] * 8
    assert {tuple(batch.values) for batch in batches} == {(SPEED,)}
    tables = dict(task for batch in batches for task in batch.tasks())
    assert tables == {point.key: sweep.case.replace(point.inputs).to_dict() for point in plan(sweep)}
    sweep = swept(bearing_case(BALLS), {"contacts": ["atlas", "solved"], SPEED: [100.0, 200.0]})
    (batch,), others = batched(sweep)
    assert batch.table["contacts"] == "atlas"
    assert [inputs["contacts"] for _, inputs in others] == ["solved", "solved"]
    batches, others = batched(swept(bearing_case(BALLS, contacts="atlas"), {"bearing.elements": [8, 9]}))
    assert (batches, len(others)) == ([], 2)


@each(
    "vary",
    [
        {SPEED: [10.0, 20.0, 30.0], LOAD: [0.0, 1e3, 2e3]},
        {SPEED: [10.0, 20.0, 30.0], "bearing.film_factor": ["none", 0.9, 0.8]},
        # Some bores are larger than the inner raceway.
        {"bearing.bore": [0.03, 0.05, 0.055], "bearing.pitch_diameter": [0.05, 0.06, 0.07]},
        {"bearing.axial_load": [0.0, 10.0, 20.0], LOAD: [0.0, 1e3, 2e3]},
    ],
)
def test_points_planned_together_are_those_planned_one_by_one(vary):
    sweep = swept(bearing_case(BALLS, contacts="atlas"), vary)
    one_by_one = [replace(point, table=None) for point in plan(sweep)]
    assert [replace(point, table=None) for point in plan_together(sweep)] == one_by_one


def speeds(count, **keys):
    return swept(bearing_case(BALLS, contacts="formula", **keys), {SPEED: [100.0 + k for k in range(count)]})


@pytest.mark.slow
def test_what_a_batch_stores_is_read_as_that_of_single_points(tmp_path):
    """The texts of warnings are the meanings of their codes; tables have the columns of a point alone."""
    results = solve_to_folder(speeds(3), tmp_path, solvers=nullcontext(this_process())).result
    assert [point.status for point in results.points] == ["solved"] * 3
    for point in results.points:
        assert [one.text for one in point.warnings] == [CODES[one.code].meaning for one in point.warnings]
        assert point.seconds > 0.0
    alone = solve_to_folder(speeds(1), tmp_path / "alone", solvers=nullcontext(this_process())).result
    assert list(results.to_dataframe()) == list(alone.to_dataframe())
    assert results.values("bearing.margin")[0] == pytest.approx(alone.values("bearing.margin")[0], rel=1e-8)
    assert (results.verdict.level, read_sweep(tmp_path)) == (alone.verdict.level, results)


@pytest.mark.slow
def test_an_interrupted_sweep_keeps_the_batches_that_are_done(tmp_path, monkeypatch):
    monkeypatch.setattr("ehlectric.sweep.batches.TOGETHER", 4)
    solved = []

    def submit(call, batch):
        if len(solved) == 2:
            raise KeyboardInterrupt
        solved.append(batch.keys)
        return here.submit(call, batch)

    here = this_process()
    with pytest.raises(KeyboardInterrupt):
        solve_to_folder(speeds(12), tmp_path, solvers=nullcontext(Crew(submit, here.width)))
    kept = {point.number for point in read_sweep(tmp_path).points if point.solved}
    assert len(kept) == 8
    solved.clear()
    told = []
    resumed = Crew(lambda call, batch: solved.append(batch.keys) or here.submit(call, batch), here.width)
    results = solve_to_folder(
        speeds(12), tmp_path, lambda *values: told.append(values[:2]), solvers=nullcontext(resumed)
    )
    assert [len(keys) for keys in solved] == [4]
    assert told[0] == (8, 12)
    assert told[-1] == (12, 12)
    assert all(point.solved for point in results.result.points)
    solved.clear()
    solve_to_folder(speeds(12), tmp_path, solvers=nullcontext(resumed))
    assert solved == []


def kill(batch):
    if isinstance(batch, Batch):
        os.kill(os.getpid(), signal.SIGKILL)
    return solve_point(batch)


@pytest.mark.slow
def test_points_of_a_batch_whose_process_dies_are_solved_one_by_one(tmp_path):
    with processes(1) as crew:
        deadly = replace(
            crew,
            shares_memory=False,
            submit=lambda call, *values: crew.submit(kill if values else call, *values),
        )
        results = solve_to_folder(speeds(3), tmp_path, solvers=nullcontext(deadly)).result
    assert [point.status for point in results.points] == ["solved"] * 3


def test_a_batch_that_cannot_be_solved_is_left_for_its_points():
    (batch,), _ = batched(speeds(3))
    (left,) = run_batches([replace(batch, values={SPEED: -batch.values[SPEED]})], this_process(), print)
    assert left.keys == batch.keys


def test_the_time_of_a_sweep_is_estimated_from_some_of_its_points():
    assert 0.0 < seconds_of(speeds(3)) < 30.0
    wide = {"bearing.bore": [0.05, 0.055], "bearing.pitch_diameter": [0.05]}
    assert seconds_of(swept(bearing_case(BALLS, contacts="atlas"), wide)) is None
