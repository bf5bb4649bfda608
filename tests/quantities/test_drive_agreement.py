"""A drive has one label, unit, digits and bound for each quantity in every output."""

import json
from html import escape

import pytest

from ehlectric import load, solve_drive
from ehlectric.app.compute.drive_answers import drive_numbers, ends_table
from ehlectric.drive.preparation import prepare
from ehlectric.drive.summary import checked_summary
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import DRIVE_BOOK, DRIVE_KEYS, NAMES_OF_ENDS
from ehlectric.quantities.rows import shown_unit
from ehlectric.quantities.sheets import DRIVE, DRIVE_CARDS, DRIVE_CHECK
from ehlectric.report.drive_report import number_tables
from ehlectric.report.report_content import Table
from ehlectric.tables.drive_tables import drive_rows, prepared_rows
from ehlectric.tables.drive_tables import ends_table as printed_table
from ehlectric.tables.html_tables import html_of
from tests.helpers.drives import small_drive
from tests.helpers.places import ROOT
from tests.tables.test_tables import PRIVATE

STORED = ROOT / "tests" / "data" / "releases" / "1.0.0" / "drive"


@pytest.fixture(scope="module", params=["stored", "fresh"])
def result(request):
    if request.param == "stored":
        return load(STORED)
    # Isothermal films, as those of the stored drive, are upper bounds.
    return solve_drive(small_drive(**{"bearings.bearing.film_factor": "none"}), workers=1)


@pytest.fixture(scope="module")
def summary(result):
    return json.loads(json.dumps(result.summary()))


def rows_by_key(rows):
    """Rows by key; the bearing at either end has the key of the book."""
    return {row.key: row for row in rows if row.key}


def of_book(key):
    end, _, name = key.partition(".")
    return f"end.{name}" if end in ENDS else key


def reported(summary):
    """Rows of the tables of a report by label."""
    tables = [table for table in number_tables(summary) if isinstance(table, Table)]
    return {row[0]: row for table in tables for row in table.rows}


# Capacitance, and voltages that it divides: bounds with ceramic elements, and none in ideal films alone.
DIVIDED = ("capacitance", "voltage_ratio", "voltage_at_peak", "peak_voltage", "rms_voltage")


@pytest.mark.slow
@pytest.mark.gate
def test_rows_are_those_of_the_book(summary):
    for key, row in rows_by_key(drive_rows(summary)).items():
        about = DRIVE_BOOK[of_book(key)]
        bound = "" if key.rpartition(".")[2] in DIVIDED else about.bound
        assert (row.name, row.bound) == (about.label, bound), key
        if not isinstance(row.value, str):
            assert (row.unit, row.digits) == (shown_unit(about, row.value), about.digits), key


def test_the_breakdown_voltage_is_a_bound_in_every_output(result, summary):
    rows = rows_by_key(drive_rows(summary))
    shown = [rows[f"{end}.breakdown_voltage"].bounded for end in ENDS]
    assert all(text.startswith("≤ ") for text in shown)
    tables = reported(summary)
    label = DRIVE_BOOK["end.breakdown_voltage"].label
    assert [cell.replace("\xa0", " ") for cell in tables[label][1:3]] == shown
    page = {row[0].strip(): row for row in ends_table(summary, DRIVE).rows}
    assert list(page[label][1:3]) == shown
    card = next(one for one in drive_numbers(summary, DRIVE, ()) if one.key == "end.breakdown_voltage")
    assert f"{card.bound} {card.text}" == shown[0]
    assert all(text in html_of(result) for text in shown)


def test_the_report_and_the_tables_of_both_ends_have_the_rows_of_the_notebook(result, summary):
    rows = rows_by_key(drive_rows(summary))
    report = reported(summary)
    page = {row[0].strip(): row for row in ends_table(summary, DRIVE).rows}
    printed = {
        str(cells[0]).strip(): [str(cell) for cell in cells[1:]]
        for cells in zip(*(list(column.cells) for column in printed_table(summary).columns), strict=True)
    }
    html = html_of(result)
    for key, row in rows.items():
        bounded = row.bounded.replace("\xa0", " ")
        assert row.name in html, key
        assert escape(row.bounded) in html, key
        told = [cell.replace("\xa0", " ") for cell in report[row.name]]
        if of_book(key) == key:
            assert told[:3] == [row.name, bounded, row.unit], key
            continue
        column = 1 + ENDS.index(key.partition(".")[0])
        for cells in (told, page[row.name], [row.name, *printed[row.name]]):
            assert (cells[column].replace("\xa0", " "), cells[3]) == (bounded, row.unit), key


def agree_with_rows(numbers, rows):
    """Numbers are the rows of the drive, or of its drive end; rates are those of the worse end."""
    for number in numbers:
        ends = [rows.get(number.key.replace("end.", f"{end}.", 1)) for end in ENDS]
        if number.key == "end.events_per_second":
            ends.sort(key=lambda row: -row.value)
        row = rows.get(number.key) or ends[0]
        if row is None:
            assert not number.known, number.key
            continue
        assert number.label == f"{row.name[:1].upper()}{row.name[1:]}"
        assert (number.text, number.unit, number.bound) == (row.shown, row.unit, row.bound), number.key


def test_cards_are_rows(summary):
    numbers = drive_numbers(summary, DRIVE, ())
    assert {"end.events_per_second", "end.breakdown_voltage", "source.peak"} <= {one.key for one in numbers}
    agree_with_rows(numbers, rows_by_key(drive_rows(summary)))


def test_cards_before_a_simulation_are_rows():
    summary = checked_summary(prepare(small_drive(), workers=1))
    numbers, rows = drive_numbers(summary, DRIVE_CHECK, ()), rows_by_key(prepared_rows(summary))
    assert {"end.voltage_at_peak", "circuit.winding_rotor_capacitance"} <= {one.key for one in numbers}
    agree_with_rows(numbers, rows)


def test_sheets_and_cards_have_quantities_of_the_book():
    keys = [key for sheet in (DRIVE, DRIVE_CHECK) for section in sheet for key in section.keys]
    assert {*keys, *DRIVE_CARDS} <= set(DRIVE_BOOK)
    assert set(DRIVE_CARDS) <= set(keys)


def test_labels_are_understood_alone():
    for sheet in (DRIVE, DRIVE_CHECK):
        labels = [DRIVE_BOOK[key].label for section in sheet for key in section.keys]
        assert len(set(labels)) == len(labels)
        assert max(map(len, labels)) <= 40
        assert not [label for label in labels if PRIVATE.search(label)]


def test_sweeps_name_the_end_beside_the_same_label():
    for end, place in NAMES_OF_ENDS.items():
        for key, about in DRIVE_BOOK.items():
            swept = DRIVE_KEYS.get(key.replace("end.", f"{end}.", 1)) if key.startswith("end.") else None
            if swept is not None and about.label:
                assert swept.label == f"{about.label}, {place}"
                assert (swept.unit, swept.shown, swept.digits) == (about.unit, about.shown, about.digits)
