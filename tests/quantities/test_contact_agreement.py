"""Terminal, notebook, report and page say the same about each quantity of a contact: that of the book."""

from html import unescape

import pytest

from ehlectric.app.compute.contact_answers import answer_of
from ehlectric.cases.input_keys import kind_of
from ehlectric.contact.result import PointResult
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.result_bounds import contact_bounds
from ehlectric.quantities.results import CONTACT_BOOK
from ehlectric.quantities.rows import shown_unit
from ehlectric.quantities.sheets import CHECK, CONTACT, CONTACT_CARDS, SPOT_CARDS, TOUCHING_CARDS
from ehlectric.report.report_content import Table
from ehlectric.report.report_facts import row_tables
from ehlectric.runs.solve import load
from ehlectric.sweep.axis_labels import label_of
from ehlectric.tables.contact_tables import result_rows
from tests.helpers.each import each
from tests.helpers.places import ROOT

STORED = ("line", "rough", "starved", "hot", "touching")


@pytest.fixture(scope="module")
def results():
    """Results that version 1.0.0 stored."""
    return {name: load(ROOT / "tests/data/releases/1.0.0" / name) for name in STORED}


def plain(text):
    return " ".join(unescape(text).replace("\xa0", " ").split())


@pytest.mark.slow
@pytest.mark.parametrize("name", STORED)
def test_every_output_has_the_label_unit_digits_and_bound_of_the_book(results, name):
    result = results[name]
    geometry = "point" if isinstance(result, PointResult) else "line"
    book, summary = CONTACT_BOOK[geometry], result.summary()
    rows = [row for row in result_rows(result) if row.key]
    bounds = contact_bounds(book, summary)
    html = plain(result._repr_html_())
    cells = {row[0]: row for one in row_tables(rows, "all") if isinstance(one, Table) for row in one.rows}
    view = answer_of(result)
    large = {number.key: number for number in view.shown}
    assert len(rows) > 25
    for row in rows:
        about = key_of(book, row.key)
        if not row.key.startswith("film_formulas."):
            assert row.name == about.label, row.key
        if isinstance(row.value, float):
            assert (row.unit, row.digits) == (shown_unit(about, row.value), about.digits), row.key
        assert row.bound == bounds.get(row.key, ""), row.key
        assert f"{row.name}</td>" in html, row.key
        assert plain(cells[row.name][1]) == plain(row.bounded), row.key
        assert plain(cells[row.name][2]) == row.unit, row.key
        if row.key in large:
            number = large[row.key]
            assert number.label.lower() == row.name.lower()
            assert (number.text, number.unit, number.bound) == (row.shown, row.unit, row.bound)
        if row.key in summary_keys(summary) and kind_of(row.key) is None:
            label = label_of(row.key, result.case)
            assert (label.name, label.unit) == (about.label, about.unit), row.key
    assert set(large) <= {row.key for row in rows}


def summary_keys(summary, prefix=""):
    """Dotted keys of the tables of a summary."""
    for name, value in summary.items():
        if isinstance(value, dict):
            yield from summary_keys(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}"


@each("geometry", ["line", "point"])
def test_every_key_of_a_sheet_is_in_the_book_with_a_label(geometry):
    other = CONTACT_BOOK[{"line": "point", "point": "line"}[geometry]]
    keys = [key for section in (*CHECK, *CONTACT) for key in section.keys]
    for key in keys:
        about = CONTACT_BOOK[geometry].get(key) or other[key]
        assert about.label, key
    assert len(set(keys)) == len({*keys})
    assert {*CONTACT_CARDS, *TOUCHING_CARDS, *SPOT_CARDS} <= {
        key for section in CONTACT for key in section.keys
    }
