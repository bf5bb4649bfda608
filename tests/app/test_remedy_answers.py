"""What the page of a bearing shows of remedies: numbers of both bearings, and the link into the drive."""

import pytest

from ehlectric.app.compute.answer_parts import drive_of
from ehlectric.app.compute.bearing_answers import quick_answer, whole_quick_answer
from ehlectric.app.compute.remedy_answers import quick_remedy, whole_remedy
from ehlectric.app.form_fields.drive_fields import BEARING_REMEDIES, remedy_at_bearing
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import BEARING, drive_with
from ehlectric.app.view_models import PENDING
from tests.helpers.each import each


def remedied(name, inputs=BEARING):
    """Drive of a bearing with the remedy of a button, as the page asks for it."""
    remedy = remedy_at_bearing(inputs, name)
    return drive_with(inputs).changed(
        {"remedies": [{"title": remedy["title"], "changes": dict(remedy["changes"])}]}
    )


def rows(answer):
    """Rows of the table, by the words before a bracket."""
    return {name.partition(" (")[0]: (now, then) for name, now, then in answer.table.rows}


def whole(name, inputs=BEARING):
    return rows(whole_remedy(inputs.table, remedied(name, inputs).table))


@pytest.fixture(scope="module")
def now():
    return whole_quick_answer(BEARING.table)


@pytest.mark.slow
@pytest.mark.parametrize("name", BEARING_REMEDIES)
def test_beside_a_remedy_stands_the_answer_of_the_page(name, now):
    found = whole(name)
    assert found["Verdict"][0] == now.verdict.heading
    assert found["Margin"][0] == now.number("bearing.margin").text
    facts = dict(now.deciding.facts)
    if "Margin in 90 of 100 cases" in found:
        assert found["Margin in 90 of 100 cases"][0] == facts["margin in 90 of 100 cases"]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "changes"), [
    ("Hybrid", {"bearing.element_material": "silicon-nitride", "bearing.element_capacitance": "5 pF"}),
    ("Insulated", {"bearing.coating": {"base": "schaeffler-j20aa", "relative_permittivity": 9.0}}),
    ("Other oil", {"lubricant": {"base": "fva-3"}}),
])  # fmt: skip
def test_the_other_column_is_the_answer_about_the_changed_bearing(name, changes):
    other, found = whole_quick_answer(BEARING.changed(changes).table), whole(name)
    assert found["Verdict"][1] == other.verdict.heading
    assert found["Shaft voltage"][1] == other.number("bearing.shaft_voltage").with_unit
    numbers = {"Margin": "bearing.margin", "Voltage on a ceramic element": "bearing.element_voltage"}
    for label, key in numbers.items():
        number = other.number(key)
        if number is not None and label in found:
            assert found[label][1] == number.with_unit


@pytest.mark.slow
def test_a_ring_takes_nearly_all_of_the_voltage():
    """40 mA, 20 pF times 200 V in 100 ns, on 1 ohm."""
    found = whole("Grounding ring")
    assert found["Shaft voltage"][1] == "0.04 V"
    assert found["Verdict"][1] == "No breakdown expected"


@pytest.mark.slow
def test_a_ring_with_a_table_has_the_resistance_at_the_speed_of_the_bearing():
    """1 ohm at 3000 rpm, half of the logarithm between 0.1 and 10 ohm."""
    table = {"speed": ["0 rpm", "6000 rpm"], "resistance": ["0.1 ohm", "10 ohm"]}
    remedy = {"title": "Brush", "changes": {"circuit.grounding_ring_table": table}}
    drive = drive_with(BEARING.changed({"bearing.inner_speed": "3000 rpm"})).changed({"remedies": [remedy]})
    assert rows(whole_remedy(BEARING.table, drive.table))["Shaft voltage"][1] == "0.04 V"


def test_what_follows_is_pending_at_once():
    found = rows(quick_remedy(BEARING.table, remedied("Insulated").table))
    assert found["Critical speed"] == found["Probability of breakdown"] == (PENDING, PENDING)
    assert (
        found["Margin"][1]
        == quick_answer(
            BEARING.changed(
                {"bearing.coating": {"base": "schaeffler-j20aa", "relative_permittivity": 9.0}}
            ).table
        )
        .number("bearing.margin")
        .text
    )


@each("name", BEARING_REMEDIES)
def test_the_link_leads_to_the_drive_with_this_remedy(name):
    from urllib.parse import parse_qsl

    drive = remedied(name)
    assert drive.linkable
    read = Inputs.of_query(parse_qsl(drive.address()))
    (remedy,) = drive_of(read.table).remedies
    assert remedy.changes == dict(remedy_at_bearing(BEARING, name)["changes"])


@each("name", BEARING_REMEDIES)
def test_what_is_assumed_is_named(name):
    assert len(remedy_at_bearing(BEARING, name)["assumed"].format(rise="100 ns")) > 50
