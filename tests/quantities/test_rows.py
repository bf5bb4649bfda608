"""Rows of a table as data: numbers in SI units beside the unit in which they are shown."""

import subprocess
import sys
from dataclasses import replace

import pytest

from ehlectric.quantities.formats import UNITS
from ehlectric.quantities.quantity import Quantity
from ehlectric.quantities.results import BEARING_BOOK, CONTACT_BOOK, DRIVE_BOOK, MOTION_BOOK
from ehlectric.quantities.rows import Row, RowTexts, Section, sheet_rows, shown_unit, value_at
from ehlectric.quantities.units import to_si
from ehlectric.tables.measured_tables import table_of
from tests.helpers.each import each

KEY = "film.minimum_thickness"
KEYS = {KEY: Quantity("smallest film", "m", "minimum film")}
SHEET = [Section("film", (KEY,))]


@each("unit", [unit for unit in UNITS if unit not in ("", "%", "°C")])
def test_units_are_those_of_case_files(unit):
    si, factor = UNITS[unit]
    assert to_si(f"1 {unit}", si) * factor == pytest.approx(1.0, rel=1e-14)


def test_a_number_is_kept_in_si_and_shown_in_its_unit():
    row = Row("minimum film", 1.23456e-7, "nm", digits=".3g")
    assert (row.value, row.shown) == (1.23456e-7, "123")
    assert Row("share", 0.125, "%").shown == "12.5"
    assert Row("grid", "65 x 65", note="nodes").shown == "65 x 65"
    assert Row("discharge").shown == ""


def test_a_number_in_an_unknown_unit_is_refused():
    with pytest.raises(ValueError, match=r"^'eV' is no unit of a row"):
        Row("power", 1.0, "eV")
    assert Row("position", "1, 2", "x/b").shown == "1, 2"


def test_rows_of_a_summary():
    summary, words = {"film": {"minimum_thickness": 2e-7}}, RowTexts(notes={KEY: lambda _: ", of all"})
    row = Row("minimum film", 2e-7, "µm", ", of all", key=KEY)
    assert list(sheet_rows(SHEET, KEYS, summary, words)) == [Row("film"), row]
    assert list(sheet_rows(SHEET, KEYS, {"film": {"minimum_thickness": None}})) == []
    assert list(sheet_rows(SHEET, KEYS, {"film": None})) == []
    wrong = {KEY: replace(KEYS[KEY], shown="V")}
    with pytest.raises(ValueError, match=r"^minimum film in m is not shown in V$"):
        list(sheet_rows(SHEET, wrong, summary))


@each(
    "book",
    [*CONTACT_BOOK.values(), *MOTION_BOOK.values(), BEARING_BOOK, DRIVE_BOOK],
)
def test_every_quantity_is_shown_in_a_unit_of_its_own(book):
    for key, about in book.items():
        assert shown_unit(about, 1.0) is not None, key


def test_values_by_dotted_key():
    table = {"a": {"b": [1.0, {"c": 2.0}]}, "n": None}
    assert value_at(table, "a.b.1.c") == 2.0
    assert [value_at(table, key) for key in ("a.b.2", "a.b.x", "a.c", "n.b")] == [None] * 4


@each(
    "row, text",
    [
        (Row("minimum film", 1e-6, "µm", ", here"), "1 µm, here"),
        (Row("minimum film", 1e-6, "µm", " at x/b = 1"), "1 µm at x/b = 1"),
        (Row("residual", 1e-9, note="after 3 steps", digits=".1e"), "1.0e-09 after 3 steps"),
        (Row("ratio", 0.5, note=", of all"), "0.5, of all"),
        (Row("WRONG", note="x", alarm=True), "x"),
        (Row("film"), ""),
    ],
)
def test_value_unit_and_note_are_one_string(row, text):
    assert row.text == text
    assert row.heading == (text == "")


def test_a_terminal_shows_names_values_and_headings():
    rows = [
        Row("first", 1e-6, "µm", ", here"),
        Row("film"),
        Row("h [m]", 2.0),
        Row("WRONG", note="x", alarm=True),
    ]
    table = table_of(rows, "Title [m]")
    cells = [[str(cell) for cell in column.cells] for column in table.columns]
    assert cells == [["first", "film", "  h [m]", "  WRONG"], ["1 µm, here", "", "2", "x"]]
    assert [row.style for row in table.rows] == [None, "bold", None, "red"]
    assert [column.justify for column in table.columns] == ["left", "left"]
    assert str(table.title) == "Title [m]"


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["contact", "bearing", "motion", "drive"])
def test_rows_are_made_without_a_terminal(kind):
    code = f"import sys, ehlectric.tables.{kind}_tables; print('rich' in sys.modules, 'typer' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["False", "False"]
