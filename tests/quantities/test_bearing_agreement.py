"""Terminal, notebook, report, page and comparison of a bearing say the same of each quantity."""

import re
import tomllib
from html import unescape

import pytest

from ehlectric import solve
from ehlectric.app.compute.bearing_answers import answer_of
from ehlectric.app.compute.compare_answers import side
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import BEARING_BOOK
from ehlectric.report.report_facts import row_tables
from ehlectric.runs.solve import load
from ehlectric.sweep.axis_labels import label_of
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.places import ROOT

COATING = {"base": "schaeffler-j20aa", "relative_permittivity": 9.0, "area": "45 cm^2"}
# Words that no other text on lubrication or on electric breakdown uses in this sense.
PRIVATE = re.compile(r"\b(least|largest|smallest|took|over|times|first break|through breakdown|by volt)\b")
# Rows of inputs, which have names of their own, and stand below two headings.
OF_INPUTS = ("margin.effects.", "uncertainty.indices.")
CASES = ("stored", "coated", "ceramic", "touching")


@pytest.fixture(scope="module")
def results():
    """Bearing of a release, and bearings by formula whose bounds and rows differ."""
    changes = {
        "coated": {"bearing__coating": COATING, "discharge__conductivity": "1 uS/m"},
        "ceramic": {"bearing__element_material": "silicon-nitride"},
        "touching": {"bearing__inner_speed": "30 rpm"},
    }
    found = {
        name: solve(bearing_case(BALLS, contacts="formula", **change)) for name, change in changes.items()
    }
    return found | {"stored": load(ROOT / "tests" / "data" / "releases" / "1.0.0" / "bearing")}


@pytest.fixture(scope="module", params=CASES)
def result(request, results):
    return results[request.param]


@pytest.fixture(scope="module")
def rows(result):
    """Rows of the terminal without headings."""
    return [row for row in total_rows(result.summary()) if not row.heading]


@pytest.mark.slow
def test_rows_have_the_labels_and_units_of_the_book(rows):
    keys = [row.key for row in rows if not row.key.startswith(OF_INPUTS)]
    assert len(set(keys)) == len(keys) > 15
    for row in rows:
        about = key_of(BEARING_BOOK, row.key)
        if row.key.startswith(OF_INPUTS) or row.key == "margin.left_out":
            continue
        assert row.name == about.label
        assert row.bound in ("", about.bound)
        assert row.digits == (about.digits if isinstance(row.value, float) else ".4g")
        assert about.shown in ("", "prefixed", row.unit) or not row.unit


@pytest.mark.slow
def test_labels_are_understood_alone(rows):
    names = [row.name for row in rows if not row.key.startswith("uncertainty.indices.")]
    assert [name for name in names if PRIVATE.search(name) or len(name) > 40] == []
    assert len(set(names)) == len(names)


@pytest.mark.slow
def test_the_notebook_shows_the_rows_of_the_terminal(result, rows):
    cells = re.findall(r"<tr[^>]*>" + 3 * r"<td[^>]*>(.*?)</td>" + "</tr>", unescape(result._repr_html_()))
    for row in rows:
        if row.key != "seconds":
            assert (row.name, row.bounded, f"{row.unit}{row.note}") in cells


@pytest.mark.slow
def test_the_report_shows_the_rows_of_the_terminal(result, rows):
    tables = row_tables(total_rows(result.summary()), "Overview")
    cells = [
        tuple(cell.replace("\xa0", " ") for cell in cells[:3])
        for table in tables
        for cells in getattr(table, "rows", ())
    ]
    for row in rows:
        assert (row.name, row.bounded, row.unit) in cells


@pytest.mark.slow
def test_the_page_shows_the_rows_of_the_terminal(result, rows):
    answer, named = answer_of(result), {row.key: row for row in rows}
    assert [line.name for line in answer.lines if line.text] == [row.name for row in rows]
    for number in answer.shown:
        assert number.label.lower() == BEARING_BOOK[number.key].label.lower()
        if number.known:
            row = named[number.key]
            assert (number.text, number.unit, number.bound) == (row.shown, row.unit, row.bound)


@pytest.mark.slow
def test_the_comparison_shows_the_rows_of_the_terminal():
    case = bearing_case(BALLS, contacts="formula")
    named = {row.key: row for row in total_rows(solve(case).summary())}
    results = {one.key: one for one in side(tomllib.loads(case.to_toml())).results}
    assert {"bearing.margin", "bearing.lambda_ratio", "rings.inner.max_pressure"} <= set(results)
    for key in results.keys() & named.keys():
        row, one = named[key], results[key]
        assert (one.name, one.text, one.unit, one.bound) == (row.name, row.shown, row.unit, row.bound)


@pytest.mark.slow
def test_axes_have_the_labels_of_the_rows(result, rows):
    for row in rows:
        table, _, name = row.key.partition(".")
        if table == "bearing" and name not in ("minimum_thickness", "asperity_share_range", "film_factor"):
            assert label_of(row.key, result.case).name in (row.name, "parallel capacitance")
