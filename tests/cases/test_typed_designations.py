"""Designations as they were typed: kept in every form of a case, and dropped with their bearing."""

import copy
import json
import pickle
import tomllib

import pytest

import ehlectric
from ehlectric import BearingCase, DriveCase, InputError, Sweep, check, evaluate, load, run_sweep, save, solve
from ehlectric.app.catalogue import designated
from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field_rules import changed, custom_values
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.library.designations import as_typed, parts_of
from ehlectric.cases.table import opened_names
from ehlectric.report.build import report_of
from ehlectric.report.written_report import html_of
from ehlectric.runs.example_files import example_text
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

TYPED = "SKF 6208-2RS1/C3"
REST = {
    "radial_load": "1 kN",
    "inner_speed": "3000 rpm",
    "temperature": "70 degC",
    "composite_rq": "0.03 um",
    "lubricant": {"base": "fva-3"},
    "contacts": "formula",
}
LIFE = {"contamination_factor": 0.5}
CODE = "ratings-of-other-maker"
EXAMPLE = Inputs(tomllib.loads(example_text("bearing_6208")))


def case_of(base=TYPED, **keys):
    return BearingCase.of(**{"base": base, **REST, **keys})


def kept(case):
    return case.bearing.base, case.bearing.designation, case.bearing.clearance_class


@each(
    ("text", "typed"),
    [
        ("  skf\u00a06208-2rs1 / c3 ", "SKF 6208-2RS1 / C3"),
        ("FAG® 6208–2RSR", "FAG 6208-2RSR"),
        ("6208\u3000ＺＺ", "6208 ZZ"),
    ],
)
def test_a_designation_is_kept_in_capital_letters_with_single_spaces(text, typed):
    assert as_typed(text) == typed
    assert kept(case_of(text))[:2] == ("6208", typed)


def test_words_of_makers_keep_their_letters():
    assert as_typed("FAG 7208-B x-life") == "FAG 7208-B X-LIFE"


@each(("base", "keys"), [("6208", {}), ("nu-208", {"profile": "none"}), ("NU 208", {"profile": "none"})])
def test_a_name_of_the_library_is_no_designation(base, keys):
    assert case_of(base, **keys).bearing.designation is None


@each("text", [TYPED.lower(), "6208-C3", "NTN-SNR 6208 ZZ", "6208 ZZ SKF"])
def test_copies_of_a_case_are_equal(text, tmp_path):
    case = case_of(text)
    path = tmp_path / "case.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    assert BearingCase.from_toml(path) == case == BearingCase.from_dict(case.to_dict())
    assert pickle.loads(pickle.dumps(case)) == copy.deepcopy(case) == case
    assert case.replace() == case
    assert BearingCase.from_toml(path).bearing.designation == as_typed(text)


def test_a_designation_alone_is_the_base():
    assert case_of(None, designation=TYPED) == case_of() == case_of("6208", designation=TYPED)
    assert kept(case_of(None, designation="6208")) == ("6208", None, "CN")


@each(
    "keys",
    [
        {"base": "6209", "designation": TYPED},
        {"base": "6208-2Z", "designation": TYPED},
        {"base": "6208", "designation": "SKF 22208 E"},
        {"base": None, "designation": "6208 XYZ"},
        {"base": None, "designation": "22208 E"},
        {"base": None, "designation": 6208},
    ],
)
def test_a_designation_of_no_or_another_bearing_is_refused(keys):
    with pytest.raises(InputError) as caught:
        case_of(**keys)
    assert caught.value.key == "bearing.designation"
    with pytest.raises(InputError) as caught:
        case_of("6310").replace({f"bearing.{key}": value for key, value in keys.items() if value})
    assert caught.value.key == "bearing.designation"


def test_a_designation_with_another_class_is_refused():
    with pytest.raises(InputError) as caught:
        case_of("6208", designation=TYPED, clearance_class="C4")
    assert caught.value.key == "bearing.clearance_class"


def test_a_long_designation_is_refused():
    with pytest.raises(InputError) as caught:
        case_of("6208" + " C3" * 100)
    assert caught.value.key == "bearing.base"


@each(
    ("changes", "expected"),
    [
        ({"bearing.base": "6209"}, ("6209", None, "C3")),
        ({"bearing": "6209"}, ("6209", None, "C3")),
        ({"bearing.base": "6208"}, ("6208", None, "C3")),
        ({"bearing.base": "fag 6209-2z"}, ("6209", "FAG 6209-2Z", "C3")),
        ({"bearing.designation": "FAG 6314/C4"}, ("6314", "FAG 6314/C4", "C4")),
        ({"bearing.base": "6314", "bearing.designation": "FAG 6314/C4"}, ("6314", "FAG 6314/C4", "C4")),
        ({"bearing.designation": None}, ("6208", None, "C3")),
        ({"bearing.clearance_class": "C4"}, ("6208", None, "C4")),
        ({"bearing.radial_clearance": "C4"}, ("6208", None, "C4")),
        ({"bearing.clearance_class": "C3"}, ("6208", TYPED, "C3")),
        ({"bearing.radial_clearance": "10 um"}, ("6208", TYPED, None)),
        ({"bearing.radial_load": "2 kN"}, ("6208", TYPED, "C3")),
    ],
)
def test_replace_keeps_or_drops_a_designation(changes, expected):
    new = case_of().replace(changes)
    assert kept(new) == expected
    assert BearingCase.from_dict(new.to_dict()) == new


def test_a_geometry_without_a_name_has_no_designation():
    own = case_of().replace({"bearing.base": None})
    assert kept(own) == (None, None, "C3")


def test_bearings_of_a_drive_keep_their_designations():
    drive = DriveCase.from_toml(EXAMPLES / "drive.toml").replace({"drive_end.bearing.base": TYPED})
    assert drive.drive_end.bearing.designation == TYPED
    assert drive.non_drive_end.bearing.designation is None
    assert DriveCase.from_dict(drive.to_dict()) == drive
    other = drive.replace({"bearings.bearing.base": "6310"})
    assert [one.bearing.designation for one in other.bearings] == [None, None]


def test_points_over_bases_are_those_of_each_bearing_alone():
    case, bases = case_of(), ["6209", "FAG 6310 C4", "6208"]
    found = evaluate(case, {"bearing.base": bases})
    alone = [solve(case.replace({"bearing.base": base})).capacitance() for base in bases]
    assert found["bearing.capacitance"].values == pytest.approx(alone, rel=1e-9)


@pytest.mark.slow
def test_a_sweep_over_bases_drops_the_designation(tmp_path):
    bases = ["6209", "FAG 6310 C4"]
    sweep = Sweep.from_dict({"case": case_of().to_dict(), "vary": {"bearing.base": bases}})
    cases = [sweep.case.replace(changes) for changes in sweep.points()]
    assert [one.bearing.designation for one in cases] == [None, "FAG 6310 C4"]
    results = run_sweep(sweep, tmp_path, workers=1)
    alone = [solve(case).capacitance() for case in cases]
    assert results.values("bearing.capacitance") == pytest.approx(alone, rel=1e-9)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("typed")
    save(solve(case_of(life=LIFE, title="A")), folder)
    return folder


def test_outputs_name_the_designation(folder):
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["inputs"]["bearing"]["base"] == "6208"
    assert summary["inputs"]["bearing"]["designation"] == TYPED
    again = load(folder)
    assert again.case == case_of(life=LIFE, title="A")
    assert TYPED in repr(again)
    assert TYPED in repr(again.case)
    assert TYPED in html_of(report_of(folder, summary=True))
    assert TYPED in [row.text for row in check(case_of()).rows]


def test_a_workbook_names_the_designation(folder, tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    ehlectric.export(load(folder), tmp_path / "out.xlsx")
    book = openpyxl.load_workbook(tmp_path / "out.xlsx")
    cells = {cell.value for sheet in book for row in sheet.iter_rows() for cell in row}
    assert TYPED in cells


@each(
    ("text", "maker"),
    [
        ("FAG 6208", "FAG"),
        ("6208-2Z SKF", "SKF"),
        ("NTN-SNR 6208", "NTN-SNR"),
        ("lager 6208", ""),
        ("6208", ""),
    ],
)
def test_the_maker_of_a_designation(text, maker):
    assert parts_of(text).maker == maker


@each(
    ("keys", "noted"),
    [
        # The ratings of the library and of most series are those of NSK.
        ({"base": TYPED, "life": LIFE}, True),
        ({"base": "6208-2RS1 SKF", "life": LIFE}, True),
        ({"base": "NSK 6208ZZ", "life": LIFE}, False),
        ({"base": "6208-2RS1/C3", "life": LIFE}, False),
        ({"base": TYPED}, False),
        ({"base": TYPED, "life": {**LIFE, "dynamic_rating": "32.5 kN"}}, True),
        ({"base": TYPED, "life": {**LIFE, "dynamic_rating": "32.5 kN", "static_rating": "19 kN"}}, False),
        # The elements of a bearing that is not in the library follow from its ratings.
        ({"base": "FAG 6314"}, True),
        ({"base": "NSK 6314"}, False),
        ({"base": "ZEN HK 2020", "radial_clearance": "20 um", "profile": "none"}, False),
        ({"base": "INA HK 2020", "radial_clearance": "20 um", "profile": "none"}, True),
    ],
)
def test_the_note_of_ratings_of_another_maker(keys, noted):
    assert [one.code for one in check(case_of(**keys)).warnings].count(CODE) == noted


@each("text", [TYPED, "fag 6314-c3"])
def test_a_form_keeps_the_designation_as_a_file(text):
    found = changed(EXAMPLE, {"bearing.base": text})
    assert designated(text)["designation"] == as_typed(text)
    assert found.value("bearing.designation") == as_typed(text)
    assert changed(EXAMPLE, {"bearing.designation": text}) == found


@each(
    "changes",
    [
        {"bearing.base": "6209"},
        {"bearing.base": "6208"},
        {"bearing.clearance_class": "C4"},
        {"bearing.designation": None},
    ],
)
def test_a_form_drops_the_designation_of_another_bearing(changes):
    found = changed(changed(EXAMPLE, {"bearing.base": TYPED}), changes)
    assert found.value("bearing.designation") is None


def test_a_form_with_an_own_geometry_has_no_designation():
    inputs = changed(EXAMPLE, {"bearing.base": TYPED})
    own = changed(inputs, custom_values(inputs, "bearing.base"))
    assert own.value("bearing.designation") is None


def test_a_form_shows_the_designation_where_there_is_one():
    [field] = [one for group in BEARING_GROUPS for one in group.fields if one.key == "bearing.designation"]
    assert field.kind == "text"
    other = changed(changed(EXAMPLE, {"bearing.base": TYPED}), {"bearing.radial_load": "2 kN"})
    assert other.value(field.key) == TYPED


def test_a_file_with_a_designation_alone_is_shown_as_its_bearing():
    table = EXAMPLE.changed({"bearing.base": None, "bearing.radial_clearance": None}).table
    opened = Inputs(
        opened_names({**table, "bearing": {**table["bearing"], "designation": TYPED}}, BearingCase)
    )
    assert (opened.value("bearing.base"), opened.value("bearing.designation")) == (TYPED, TYPED)
    assert kept(BearingCase.from_written(opened.table)) == ("6208", TYPED, "C3")


@each(
    ("base", "keys", "noted"),
    [
        ("SKF 6208-2RS1/C3", {}, True),
        ("6309-2Z", {}, True),
        ("NSK 6208ZZ", {}, True),
        ("6208-RS1", {}, False),
        ("6208/C3", {}, False),
        ("6208-2Z", {"supply": "grease"}, False),
    ],
)
def test_a_bearing_greased_for_life_with_flooded_films_has_a_note(base, keys, noted):
    """One seal leaves a side open to oil; with a supply of grease the film is starved already."""
    result = solve(case_of(base, **keys).replace({"contacts": "formula"}))
    assert ("sealed-flooded" in [one.code for one in result.warnings]) == noted


def test_a_temperature_in_quotes_without_a_unit_is_told_the_unit():
    """The same advice as for a bare number."""
    for value in ("85", 85):
        with pytest.raises(InputError, match=r"expected a temperature with its unit, as '85 °C'"):
            case_of("6208", temperature=value)
