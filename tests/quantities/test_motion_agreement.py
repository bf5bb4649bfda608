"""A contact over time has one label, unit, digits and bound for each quantity in every output."""

import json
from html import escape

import pytest

from ehlectric.cases.input_keys import kind_of
from ehlectric.motion.result import MotionResult
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import read_motion
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import CONTACT_BOOK, MOTION_BOOK, MOTION_KEYS
from ehlectric.quantities.rows import shown_unit, value_at
from ehlectric.quantities.sheets import MOTION, MOTION_CHECK
from ehlectric.report.report_content import Table
from ehlectric.report.report_facts import row_tables
from ehlectric.sweep.axis_labels import label_of
from ehlectric.tables.html_tables import html_of
from ehlectric.tables.motion_tables import run_rows
from tests.helpers.moving_cases import POINT, moving
from tests.helpers.places import ROOT
from tests.tables.test_tables import PRIVATE

STORED = ROOT / "tests" / "data" / "releases" / "1.0.0" / "motion"


@pytest.fixture(scope="module", params=["stored", "fresh"])
def result(request, tmp_path_factory):
    if request.param == "stored":
        return MotionResult.of(read_motion(STORED))
    folder = tmp_path_factory.mktemp("moved")
    electric = {"potential_2": "2 V"}
    case = moving(motion={"passes": 1.0, "steps": 16, "record": 5}, electric=electric)
    run_motion(case.replace({"discharge.dielectric_strength": "15 V/um"}), folder)
    return MotionResult.of(read_motion(folder))


@pytest.fixture(scope="module")
def rows(result):
    summary = json.loads(json.dumps(result.summary()))
    return {row.key: row for row in run_rows(summary) if row.key}


@pytest.mark.slow
def test_rows_are_those_of_the_book(result, rows):
    geometry = result.case.contact.geometry
    keys = {key for section in MOTION for key in section.keys}
    for key, row in rows.items():
        about = MOTION_BOOK[geometry][key] if key in keys else CONTACT_BOOK[geometry][key]
        assert row.name == about.label, key
        if key in keys:
            assert row.bound == about.bound, key
        if not isinstance(row.value, str):
            assert (row.unit, row.digits) == (shown_unit(about, row.value), about.digits), key


@pytest.mark.slow
@pytest.mark.gate
def test_values_are_those_of_the_summary(result, rows):
    summary = result.summary()
    for key, row in rows.items():
        stored = value_at(summary, key)
        if isinstance(row.value, float) and isinstance(stored, float) and not key.startswith("inputs."):
            assert row.value == stored, key


@pytest.mark.slow
def test_bounds_are_shown_in_every_output(rows):
    assert rows["field.max_strength"].bound == "≥"
    if "discharge.breakdown_voltage" in rows:
        assert rows["discharge.breakdown_voltage"].bound == rows["discharge.margin"].bound == "≤"


def test_notebook_and_report_have_the_rows_of_the_terminal(result, rows):
    html = html_of(result)
    tables = [table for table in row_tables(rows.values(), "") if isinstance(table, Table)]
    report = {row[0]: [cell.replace("\xa0", " ") for cell in row] for table in tables for row in table.rows}
    for key, row in rows.items():
        assert escape(row.name) in html, key
        assert escape(row.bounded) in html, key
        assert report[row.name][:3] == [row.name, row.bounded, row.unit], key


def test_sweeps_have_the_labels_of_the_rows(result, rows):
    """Of results that a summary stores under a key that no input has."""
    for key, row in rows.items():
        if key in MOTION_KEYS[result.case.contact.geometry] and kind_of(key) is None:
            assert label_of(key, result.case).name == row.name


@pytest.mark.parametrize("geometry", ["line", "point"])
def test_labels_are_understood_alone(geometry):
    for sheet in (MOTION, MOTION_CHECK):
        quantities = [key_of(MOTION_BOOK[geometry], key) for section in sheet for key in section.keys]
        labels = [one.label for one in quantities]
        assert len(set(labels)) == len(labels)
        assert max(map(len, labels)) <= 40
        assert not [label for label in labels if PRIVATE.search(label)]


@pytest.mark.slow
def test_a_point_contact_has_its_rows(tmp_path):
    run_motion(moving(POINT, motion={"passes": 1.0, "steps": 16, "record": 5}), tmp_path)
    result = MotionResult.of(read_motion(tmp_path))
    keys = {row.key for row in run_rows(result.summary())}
    assert {"film.minimum_thickness", "field.max_strength", "seconds"} <= keys
