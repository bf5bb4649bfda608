"""Sweeps of drives on their page: what may vary, the run, and the case of a point."""

from urllib.parse import parse_qsl

import pytest

from ehlectric.app.compute import sweep_answers
from ehlectric.app.page_inputs import Inputs, Range, case_of_link, with_ranges
from ehlectric.app.pages.frame import DRIVE
from ehlectric.cases.drive_case import DriveCase
from ehlectric.sweep.drive_sweep_verdict import swept_verdict
from ehlectric.sweep.engine import case_key
from ehlectric.sweep.store import read_sweep

CASE = dict(DRIVE.changed({"drive.duration": "1 ms", "remedies": None}).table)
OTHER = {**CASE["drive_end"], "bearing": {**CASE["drive_end"]["bearing"], "radial_load": "900 N"}}
TABLE = {
    "case": CASE,
    "vary": {
        "drive": {"speed": {"from": "1500 rpm", "to": "3000 rpm", "count": 2}},
        "bearings": {"bearing": {"radial_load": {"from": "900 N", "to": "1800 N", "count": 2}}},
    },
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = str(tmp_path_factory.mktemp("sweep") / "out")
    found = sweep_answers.solved(TABLE, place, 1, lambda *_: None)
    assert found["solved"] == 4
    return place


def test_first_inputs_and_results():
    found = sweep_answers.choices(CASE)
    assert found.kind == "drive"
    assert [one.key for one in found.variables[:3]] == [
        "drive.speed",
        "drive.temperature",
        "bearings.bearing.radial_load",
    ]
    assert next(iter(found.values.items())) == (
        "drive.events_per_second",
        "Discharges per second, both bearings",
    )
    # The table of the drive gives speed and temperature of both bearings.
    keys = {one.key for one in found.variables}
    assert not keys & {"bearings.bearing.inner_speed", "bearings.bearing.temperature"}


def test_bearings_that_differ_have_keys_of_their_own():
    keys = {one.key for one in sweep_answers.choices({**CASE, "non_drive_end": OTHER}).variables}
    assert {"drive_end.bearing.radial_load", "non_drive_end.bearing.radial_load"} <= keys
    assert not any(key.startswith("bearings.") for key in keys)


def test_offered_ranges_are_valid():
    offered = sweep_answers.choices(CASE).variables
    assert len(offered) > 20
    for one in offered:
        asked = with_ranges(Inputs({"case": CASE}), [Range(one.key, one.low, one.high, 2)])
        assert sweep_answers.sweep_of(dict(asked.table)).size == 2


def test_the_size_is_told_before_the_run():
    found = sweep_answers.planned(TABLE, 1)
    assert (found.points, found.refused, found.seconds) == (4, 0, None)


@pytest.mark.slow
def test_every_offered_result_has_a_value(folder):
    results = read_sweep(folder)
    for key in sweep_answers.choices(CASE).values:
        view = sweep_answers.seen(folder, key, TABLE)
        assert view is not None
        assert len(view.chart.points) == 4
    assert results.values("drive_end.peak_voltage").min() > 0.0


@pytest.mark.slow
def test_the_verdict_is_that_of_the_report(folder):
    view = sweep_answers.seen(folder, "drive.events_per_second", TABLE)
    verdict = swept_verdict(read_sweep(folder))
    assert view.verdict.level == verdict.level
    assert verdict.text.startswith(view.verdict.heading)
    assert view.number is None


@pytest.mark.slow
def test_the_link_of_a_point_is_its_case(folder):
    results = read_sweep(folder)
    base = DriveCase.from_written(CASE)
    for number, one in enumerate(results.points):
        found = sweep_answers.point(folder, TABLE, number)
        assert found.path == "/drive"
        table = Inputs.of_query(parse_qsl(found.query)).table
        assert "bearings" not in table
        assert case_key(DriveCase.from_written(table)) == case_key(base.replace(one.inputs))


def test_a_link_of_the_page_of_drives_is_a_base_case():
    assert case_of_link(f"http://localhost:8080/drive?{Inputs(CASE).address()}") == CASE
