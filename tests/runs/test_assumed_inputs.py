"""Texts name an input as assumed where the file does not give it, and never where it does."""

import json
import re

from ehlectric import BearingCase, Case, DriveCase, figure, solve, solve_bearing, solve_drive
from ehlectric.report.appendix import input_sections, inputs_of
from ehlectric.tables.bearing_tables import total_rows
from ehlectric.tables.drive_tables import drive_rows
from tests.helpers.drives import small_drive
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

# What texts say of a value that the program takes, by the key that gives the value.
LABELS = {
    "bearing.rq_over_ra": r"assumed factor|assumed for Gaussian heights",
    "lubricant.temperature.thermal_conductivity": r"conductivity of the oil is not known; [^;]* is assumed",
    "bearing.coating.thickness": r"assumed values, [^;]*thickness",
    "bearing.coating.relative_permittivity": r"assumed values, [^;]*relative_permittivity",
    "motor.second_bearing_capacitance": r"second bearing of the shaft is taken as equal",
}
GIVEN = {
    "bearing.rq_over_ra": 1.2,
    "lubricant.temperature.thermal_conductivity": "0.14 W/m/K",
    "bearing.coating.thickness": "150 um",
    "bearing.coating.relative_permittivity": 8.0,
    "motor.second_bearing_capacitance": "200 pF",
}


def bare_bearing():
    """Bearing of the example without the values of ``GIVEN``."""
    bare = {
        "contacts": "formula",
        "bearing.composite_rq": None,
        "bearing.composite_ra": "0.024 um",
        "bearing.coating": "alumina",
        "bearing.outer_diameter": "80 mm",
        "bearing.width": "18 mm",
        "lubricant.temperature.thermal_conductivity": None,
    }
    return BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace(bare)


def text_of(result, rows):
    """Verdict, warnings and rows of a table, and the parts of a report on the inputs, as one text."""
    shown = [f"{row.name} {row.shown} {row.note}" for row in rows]
    sections = [json.dumps([repr(one) for one in input_sections(result.case)], ensure_ascii=False)]
    return "\n".join([result.verdict.text, *(one.text for one in result.warnings), *shown, *sections])


def labelled(text):
    """Keys whose label is in a text."""
    return {key for key, pattern in LABELS.items() if re.search(pattern, text)}


def bearing_text(case):
    result = solve_bearing(case, workers=1)
    return text_of(result, total_rows(result.summary()))


def test_the_label_of_each_input_of_a_bearing_disappears_where_it_is_given():
    case = bare_bearing()
    assert labelled(bearing_text(case)) == set(LABELS)
    for key, value in GIVEN.items():
        assert labelled(bearing_text(case.replace({key: value}))) == set(LABELS) - {key}, key
    assert labelled(bearing_text(case.replace(GIVEN))) == set()


def test_the_label_of_each_input_of_a_drive_disappears_where_it_is_given():
    """Both bearings of the drive have the same inputs; the drive itself knows its second bearing."""
    keys = [key for key in LABELS if not key.startswith(("motor.", "bearing.coating"))]
    changes = {"composite_rq": None, "composite_ra": "0.024 um"}
    bare = {f"bearings.bearing.{key}": value for key, value in changes.items()}
    bare["bearings.lubricant.temperature.thermal_conductivity"] = None
    case = small_drive(**{"drive.duration": "1 ms"}).replace(bare)

    def found(changed):
        result = solve_drive(changed, workers=1)
        return labelled(text_of(result, drive_rows(result.summary())))

    assert found(case) == set(keys)
    for key in keys:
        assert found(case.replace({f"bearings.{key}": GIVEN[key]})) == set(keys) - {key}, key


def test_given_strengths_and_arcs_are_not_called_assumed():
    """Laws of the strength and the resistance of an arc have no defaults: whoever reads them gave them."""
    bearing = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})
    drive = small_drive(**{"drive.duration": "3 ms"})
    contact = Case.from_toml(EXAMPLES / "discharge.toml").replace({"grid.nodes": 401})
    for result, name in (
        (solve_bearing(bearing, workers=1), ""),
        (solve_drive(drive, workers=1), "drive_discharges"),
        (solve(contact), "field_strength"),
    ):
        assert "seldom measured" in result.verdict.text
        title = figure(result, name).get_label() if name else ""
        text = f"{result.verdict.text} {title}"
        assert not re.search(r"(strength|arc)[^;.]*assum|assum[^;.]* arc", text), text


@each(
    "case",
    [
        BearingCase.from_toml(EXAMPLES / "bearing_6208.toml"),
        BearingCase.from_toml(EXAMPLES / "bearing_6314.toml"),
        DriveCase.from_toml(EXAMPLES / "drive.toml"),
        Case.from_toml(EXAMPLES / "oil_contact.toml"),
        Case.from_toml(EXAMPLES / "discharge.toml"),
    ],
)
def test_reports_call_no_given_input_assumed(case):
    """Each value that the library assumes is given in turn, 1 % higher."""

    def assumed(changed):
        return {one.key: one.value for one in inputs_of(changed) if one.assumed}

    first = assumed(case)
    numbers = {key: value for key, value in first.items() if isinstance(value, float)}
    assert numbers
    for key, value in numbers.items():
        assert set(assumed(case.replace({key: 1.01 * value}))) == set(first) - {key}, key
