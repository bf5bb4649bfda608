"""Answers of the contact page are the numbers of the command."""

import math
import pickle
import tomllib
from dataclasses import replace

import pytest

from ehlectric import Case
from ehlectric.app.compute.answer_parts import concerned
from ehlectric.app.compute.contact_answers import (
    answer_of,
    by_formula,
    contact_case,
    cuts_of,
    quick_answer,
    solve_contact,
)
from ehlectric.app.form_fields.contact_fields import geometry_of, groups_of, switched
from ehlectric.app.form_fields.field import written_text
from ehlectric.app.form_fields.field_defaults import default_of
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import contact_start
from ehlectric.contact.solver import solve
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import CODES
from ehlectric.quantities.units import to_si
from ehlectric.runs.by_kind import run_contact
from ehlectric.runs.preview import preview_of
from ehlectric.runs.solve import load
from ehlectric.runtime.progress import silent
from ehlectric.tables.contact_tables import result_rows
from tests.helpers.each import each
from tests.helpers.hot_cases import HOT_LINE
from tests.helpers.places import EXAMPLES


def table_of(name, **tables):
    table = tomllib.loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))
    for key, values in tables.items():
        table[key] = table.get(key, {}) | values
    if "nodes" in table["grid"]:
        table["grid"].pop("error", None)
    return table


# A point contact on a coarse grid, which is solved in a fraction of a second.
SMALL = {"nodes": 65}


def number(answer, key):
    (found,) = (one for one in answer.shown if one.key == key)
    return found


def check_contact(table, folder):
    """Answer by formula about a contact with the files of its session in a folder."""
    return by_formula(contact_case(table, folder))


def solved_at_once(table, folder):
    """Solved answer of a contact on a small grid, with the files of its session in a folder."""
    return answer_of(solve(contact_case(table, folder)))


def words(answer):
    """All sentences of a verdict."""
    return " ".join([answer.verdict.heading, answer.meaning, answer.verdict.rest()])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "quick"), [("line_contact", True), ("ball_contact", False), ("discharge", True)]
)
def test_answer_at_once_is_that_of_the_check(name, quick, tmp_path):
    answer = check_contact(table_of(name), str(tmp_path))
    expected = preview_of(Case.from_toml(EXAMPLES / f"{name}.toml"))
    assert [(row.name, row.text) for row in answer.lines] == [(row.name, row.text) for row in expected.rows]
    assert float(number(answer, "hertz.max_pressure").text) == pytest.approx(
        expected.summary["hertz"]["max_pressure"] / 1e9, rel=1e-3
    )
    assert (answer.solved, answer.solvable) == (False, True)
    # Another contact than a smooth line is solved on request.
    at_once = quick_answer(table_of(name), str(tmp_path))
    assert (at_once.solved, at_once.solvable) == (quick, not quick)
    assert any("(Pan-Hamrock)" in one.label or "(Chittenden" in one.label for one in answer.shown)


def test_verdict_by_formula_has_the_error_of_the_formula(tmp_path):
    # examples/discharge.toml: margin 1.03, which 40 % of film and 20 % of strength take across 1.
    answer = check_contact(table_of("discharge"), str(tmp_path))
    assert answer.verdict.level == "yellow"
    assert "With the film-thickness formula" in words(answer)
    # 40 % of the film and 20 % of the strength, either way.
    margin = float(number(answer, answer.deciding.key).text)
    ends = (margin * 0.8 / 1.4, margin * 1.2 / 0.6)
    assert answer.deciding.gauge.interval == pytest.approx(ends, rel=5e-3)
    strong = table_of("discharge", discharge={"dielectric_strength": "90 V/um"})
    # Far above 1; a film by formula is an upper bound of a real one, and the light says so.
    answer = check_contact(strong, str(tmp_path))
    assert (answer.verdict.level, "ideal film" in answer.verdict.heading) == ("green", True)
    weak = table_of("discharge", discharge={"dielectric_strength": "3 V/um"})
    assert check_contact(weak, str(tmp_path)).verdict.level == "red"


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("name", ["line_contact", "ball_contact"])
def test_solved_answer_is_that_of_the_command(name, tmp_path):
    grid = {} if name == "line_contact" else SMALL
    told = []
    view = solve_contact(
        table_of(name, grid=grid), str(tmp_path), str(tmp_path / "app"), lambda *it: told.append(it)
    )
    case = Case.from_toml(EXAMPLES / f"{name}.toml")
    outcome = run_contact(case.replace({"grid.nodes": 65}) if grid else case, tmp_path / "command")
    expected = [(row.name, row.text) for row in result_rows(outcome.result) if row.name != "computing time"]
    assert [(row.name, row.text) for row in view.lines if row.name != "computing time"] == expected
    film, field = outcome.summary["film"], outcome.summary["field"]
    capacitance = ("capacitance_per_length", "F/m") if name == "line_contact" else ("capacitance", "F")
    shown = {
        "film.minimum_thickness": (film["minimum_thickness"], "m"),
        "film.max_pressure": (film["max_pressure"], "Pa"),
        "field.max_strength": (field["max_strength"], "V/m"),
        f"field.{capacitance[0]}": (field[capacitance[0]], capacitance[1]),
    }
    for key, (value, unit) in shown.items():
        one = number(view, key)
        assert to_si(f"{one.text} {one.unit}", unit) == pytest.approx(value, rel=1e-3, abs=0.0), key
    assert {path.name for path in (tmp_path / "app").iterdir()} >= {"summary.json", "result.nc", "film.csv"}
    assert told[-1] == (0, 0, "drawing")
    assert answer_of(load(tmp_path / "app")).shown == view.shown
    assert pickle.loads(pickle.dumps(view)) == view


def test_answer_without_files_is_that_with_files(tmp_path):
    table = table_of("discharge", grid={"nodes": 401})
    at_once = solved_at_once(table, str(tmp_path))
    assert not list(tmp_path.iterdir())
    stored = solve_contact(table, str(tmp_path), str(tmp_path / "line"), silent)
    assert at_once.shown == stored.shown
    assert at_once.figures == stored.figures


@pytest.mark.slow
def test_bound_of_a_solved_contact_is_told_and_its_level_is_that_of_the_command(tmp_path):
    strong = table_of("discharge", discharge={"dielectric_strength": "90 V/um"})
    view = solved_at_once(strong, str(tmp_path))
    assert number(view, "discharge.breakdown_voltage").bound == "≤"
    solve_contact(strong, str(tmp_path), str(tmp_path / "result"), silent)
    verdict = load(tmp_path / "result").verdict
    assert view.verdict == verdict
    assert (verdict.level, verdict.bound_note) == ("green", "upper bound")
    assert "ideal film" in verdict.heading


def test_breakdown_voltage_by_formula_is_an_upper_bound(tmp_path):
    answer = check_contact(table_of("discharge"), str(tmp_path))
    assert number(answer, "breakdown_by_formula.breakdown_voltage").bound == "≤"
    assert "Upper bound" in answer.verdict.assumed


@pytest.mark.parametrize(
    ("discharge", "told"),
    [
        (None, "dielectric strength"),
        (
            {"strength_table": {"pressure": ["0 GPa", "1 GPa"], "strength": ["15 V/um", "25 V/um"]}},
            "solved film",
        ),
    ],
)
def test_missing_verdict_by_formula_says_why(discharge, told, tmp_path):
    table = table_of("ball_contact") | ({} if discharge is None else {"discharge": discharge})
    answer = check_contact(table, str(tmp_path))
    assert (answer.verdict.level, told in words(answer)) == ("grey", True)


def test_contact_without_a_strength_is_told_to_give_one(tmp_path):
    view = solved_at_once(table_of("line_contact", grid={"nodes": 401}), str(tmp_path))
    assert "dielectric strength" in words(view)
    assert view.deciding.key == "film.minimum_thickness"
    # The examples have potentials of -1 V and 1 V.
    assert "2 V" in number(view, "field.max_strength").note


def solved_coarsely(tmp_path):
    table = table_of(
        "ball_contact", grid=SMALL | {"wedge": "second-order"}, discharge={"dielectric_strength": "15 V/um"}
    )
    return solved_at_once(table, str(tmp_path))


def test_severe_warning_stands_beside_every_number_that_it_forbids(tmp_path):
    view = solved_coarsely(tmp_path)
    assert (view.verdict.level, "must not be used" in words(view)) == ("grey", True)
    # The dry contact knows nothing of the film.
    shown = [one for one in view.shown if not one.key.startswith("hertz.")]
    assert len(shown) == 7
    for one in shown:
        assert "severe" in [told.severity for told in one.warnings], one.key
    severe = [set(cause.concerns) for cause in CODES.values() if cause.severity == "severe"]
    assert severe
    assert all({one.key for one in shown} <= keys for keys in severe)


@pytest.mark.slow
def test_quantities_that_warnings_concern_are_numbers_of_a_contact(tmp_path):
    numbers = [
        *solved_coarsely(tmp_path).shown,
        *check_contact(table_of("ball_contact"), str(tmp_path)).shown,
        *answer_of(solve(touching_case("line"))).shown,
        *answer_of(solve(Case.from_dict(HOT_LINE))).shown,
    ]
    tables = ("hertz.", "film.", "field.", "asperities.", "discharge.")
    named = {key for cause in CODES.values() for key in cause.concerns if key.startswith(tables)}
    assert named <= {concerned(one.key) for one in numbers}


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["line", "point", "switched"])
def test_contact_with_which_the_page_begins_has_no_warning(geometry, tmp_path):
    if geometry == "switched":
        inputs = switched(contact_start("line"), contact_start("point"))
    else:
        inputs = contact_start(geometry)
    view = solved_at_once(dict(inputs.table), str(tmp_path))
    assert [one.code for one in view.warnings if one.severity != "note"] == []
    assert view.verdict.level != "grey"


def touching_case(geometry, **tables):
    """Rough contact on a coarse grid whose surfaces touch."""
    rough = {"surface": 1, "generator": "gaussian", "seed": 4}
    slow = {"entrainment_speed": "0.01 m/s", "boundary_friction": 0.12}
    if geometry == "line":
        table = table_of("rough_contact", contact=slow, grid={"nodes": 401})
        table["roughness"] = [rough | {"rq": "150 nm", "correlation_length": "20 um"}]
    else:
        table = table_of("ball_contact", contact=slow, grid=SMALL)
        table["roughness"] = [rough | {"rq": "250 nm", "correlation_length": "60 um"}]
    for key, values in tables.items():
        table[key] = table.get(key, {}) | values
    return Case.from_dict(table)


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["line", "point"])
def test_numbers_of_surfaces_that_touch_are_those_of_the_summary(geometry):
    discharge = {"dielectric_strength": "15 V/um"} | ({"length": "10 mm"} if geometry == "line" else {})
    result = solve(touching_case(geometry, discharge=discharge, electric={"resistivity": "2.2e-7 ohm m"}))
    view, summary = answer_of(result), result.summary()["asperities"]
    size, per = ("µm", 1e6) if geometry == "line" else ("µm²", 1e12)
    capacitance = ("nF/m", 1e9) if geometry == "line" else ("pF", 1e12)
    assert number(view, "asperities.electrical_behaviour").text == summary["electrical_behaviour"]
    assert number(view, "asperities.spots").text == str(summary["spots"])
    for key, name, unit, factor in (
        ("asperities.contact_area", "contact_area", size, per),
        ("asperities.boundary_friction", "boundary_friction", "", 1.0),
        ("asperities.capacitance_outside", "capacitance_outside", *capacitance),
        ("asperities.breakdown_1", "breakdown_1", "V", 1.0),
        ("asperities.breakdown_5", "breakdown_5", "V", 1.0),
        ("asperities.breakdown_50", "breakdown_50", "V", 1.0),
    ):
        shown = number(view, key)
        assert (shown.unit, float(shown.text)) == (unit, pytest.approx(factor * summary[name], rel=0.05)), key
    # The load share has the digits that the grid leaves, and its change beside it; one that falls by more
    # than a third from grid to grid is an upper bound.
    share, before = summary["load_share"], summary["load_share_coarser"]
    shown = number(view, "asperities.load_share")
    if geometry == "line":
        assert float(shown.text) == pytest.approx(100.0 * share, abs=100.0 * abs(share - before))
        assert f"± {100.0 * abs(share - before):.2g} " in shown.note
    else:
        assert (shown.text, shown.note) == (f"< {math.ceil(100.0 * share)}", "30 % on half the nodes")
        assert 0.25 < before < 0.3
        assert share < before / 1.5
    prefixes = {"Ω": 1.0, "mΩ": 1e-3, "µΩ": 1e-6, "kΩ": 1e3}
    shown = number(view, "asperities.resistance")
    assert float(shown.text) * prefixes[shown.unit] == pytest.approx(summary["resistance"], rel=0.05)
    assert shown.bound == ("≤" if geometry == "line" else "")


@pytest.mark.slow
def test_resistance_of_spots_says_what_it_needs():
    metal = {"resistivity": "2.2e-7 ohm m"}
    for given, told in (({}, "resistivity"), (metal, "length of the contact")):
        shown = number(answer_of(solve(touching_case("line", electric=given))), "asperities.resistance")
        assert (shown.text, told in shown.note) == ("not known", True)


@pytest.mark.slow
def test_breakdown_around_spots_by_a_weibull_law():
    law = {"scale": "15 V/um", "shape": 8.0, "reference_area": "1e-8 m^2"}
    result = solve(touching_case("point", discharge={"weibull": law}, electric={"potential_2": "1 V"}))
    view, summary = answer_of(result), result.summary()["asperities"]
    shown = number(view, "asperities.breakdown_voltage")
    assert float(shown.text) == pytest.approx(summary["breakdown_voltage"], rel=0.05)
    shown = number(view, "asperities.breakdown_probability")
    assert float(shown.text) == pytest.approx(100.0 * summary["breakdown_probability"], rel=0.05)


def test_surfaces_that_do_not_touch_have_no_spots():
    case = touching_case("line", contact={"entrainment_speed": "20 m/s"})
    result = solve(case)
    assert result.rough
    assert result.converged
    assert result.spots is None
    assert not [one for one in answer_of(result).shown if one.key.startswith("asperities.")]


@each("geometry", ["line", "point"])
@each(
    "key, typed, value",
    [
        ("contact.hardness", "7", 7e9),
        ("contact.boundary_friction", "0.12", 0.12),
        ("electric.resistivity", "2.2e-7", 2.2e-7),
        ("electric.mean_free_path", "8", 8e-9),
        ("electric.tribofilm_resistance", "1e-9 Ω m²", 1e-9),
    ],
)
def test_fields_of_surfaces_that_touch_reach_the_case(geometry, key, typed, value, tmp_path):
    field = field_of(geometry, key)
    text = field.from_text(written_text(field, typed))
    inputs = changed(contact_start(geometry), {key: text})
    table, name = key.split(".")
    assert getattr(getattr(contact_case(inputs.table, ""), table), name) == pytest.approx(value)
    check_contact(dict(inputs.table), str(tmp_path))
    other = switched(inputs, contact_start("point" if geometry == "line" else "line"))
    assert other.value(key) == text


def test_length_of_a_line_contact_is_left_when_it_becomes_a_point():
    line = changed(contact_start("line"), {"discharge.length": field_of("line", "discharge.length").at(0.5)})
    point = switched(line, contact_start("point"))
    assert point.value("discharge.length") is None
    assert point.value("discharge.dielectric_strength") == line.value("discharge.dielectric_strength")
    assert contact_case(point.table, "").discharge.length is None


@pytest.mark.slow
def test_warning_about_the_domain_stands_beside_the_films(tmp_path):
    table = table_of("ball_contact", grid={"nodes": 129, "inlet": -2.5, "side": 2.0})
    view = solved_at_once(table, str(tmp_path))
    codes = {one.key: [told.code for told in one.warnings] for one in view.shown}
    (code,) = {code for found in codes.values() for code in found if code.startswith("domain-")}
    assert code in codes["film.minimum_thickness"]
    assert code in codes["film.central_thickness"]
    assert code in [told.code for told in view.warnings]


def test_film_that_did_not_converge_has_no_numbers():
    case = Case.from_toml(EXAMPLES / "line_contact.toml").replace({"grid.nodes": 401})
    result = solve(case)
    bad = replace(result, film=replace(result.film, status="stalled"))
    view = answer_of(bad)
    assert (view.converged, view.verdict.level, view.shown, view.cuts) == (False, "grey", (), {})
    assert "do not use" in words(view).lower()
    assert view.lines[0].alarm


@each(
    "key, value, told",
    [
        ("contact.load_per_length", "-1 MN/m", "contact.load_per_length"),
        ("contact.load", "20 N", "contact.load"),
        ("lubricant.base", "no such oil", "lubricant.base"),
        ("grid.nodes", 3, "grid.nodes"),
    ],
)
def test_errors_have_their_key(key, value, told, tmp_path):
    table = dict(Inputs(table_of("line_contact")).changed({key: value}).table)
    with pytest.raises(InputError) as error:
        check_contact(table, str(tmp_path))
    assert error.value.key == told


@each("name", ["/etc/passwd", "../secret.csv", "sub/profile.csv", "..\\secret.csv"])
def test_files_outside_of_the_session_are_refused(name, tmp_path):
    table = table_of("line_contact") | {"roughness": [{"surface": 1, "file": name}]}
    with pytest.raises(InputError, match="uploaded"):
        check_contact(table, str(tmp_path))


def test_a_bearing_is_no_contact(tmp_path):
    with pytest.raises(InputError, match="one contact"):
        check_contact({"bearing": {"base": "6208"}}, str(tmp_path))


def test_cuts_need_a_point_contact(tmp_path):
    table = table_of("line_contact", grid={"nodes": 401})
    solve_contact(table, str(tmp_path), str(tmp_path / "line"), silent)
    with pytest.raises(InputError, match="point contact"):
        cuts_of(str(tmp_path / "line"), 0.0, 0.0)


def test_change_of_geometry_keeps_what_both_have():
    line, ball = Inputs(table_of("discharge")), Inputs(table_of("ball_contact"))
    point = switched(line.changed({"contact.entrainment_speed": "3 m/s"}), ball)
    assert geometry_of(point) == "point"
    assert point.value("contact.entrainment_speed") == "3 m/s"
    assert point.value("discharge.dielectric_strength") == "15 V/um"
    assert point.value("contact.load") == "20 N"
    assert point.value("contact.load_per_length") is None
    assert point.value("grid.error") == "2 %"
    assert contact_case(point.table).contact.geometry == "point"
    back = switched(point, line)
    assert back.value("contact.load_per_length") == "1.57 MN/m"
    assert back.value("discharge.length") == line.value("discharge.length")
    assert contact_case(back.table).contact.geometry == "line"


@pytest.mark.parametrize("geometry", ["line", "point"])
def test_fields_of_a_contact_are_keys_of_a_case(geometry):
    name = "line_contact" if geometry == "line" else "ball_contact"
    keys = [field.key for group in groups_of(geometry) for field in group.fields]
    assert len(set(keys)) == len(keys)
    given = set(Inputs(table_of(name)).flat())
    assert {key for key in given if key.startswith("contact.")} - {"contact.geometry"} <= set(keys)


@pytest.mark.parametrize("geometry", ["line", "point"])
def test_every_way_of_a_field_is_a_valid_case(geometry, tmp_path):
    inputs = Inputs(table_of("line_contact" if geometry == "line" else "ball_contact"))
    fields = [
        field for group in groups_of(geometry) for field in group.fields if field.kind == "alternatives"
    ]
    for field in fields:
        if not field.when(inputs):
            continue
        for place, way in enumerate(field.alternatives):
            inputs = changed(inputs, way.changes)
            assert field.alternative(inputs) == place
            check_contact(dict(inputs.table), str(tmp_path))
    assert len(fields) > 3


def field_of(geometry, key):
    (found,) = (one for group in groups_of(geometry) for one in group.fields if one.key == key)
    return found


@pytest.mark.parametrize("geometry", ["line", "point"])
def test_boundary_film_of_a_form_is_that_of_the_command(geometry):
    inputs = contact_start(geometry)
    field = field_of(geometry, "contact.boundary_film")
    # What the form shows where nothing is given is what the solver takes.
    default = contact_case(inputs.table, "").contact.touching_gap
    assert 1e-9 * field.number(default_of(inputs, field.key)) == pytest.approx(default)
    typed = changed(inputs, {field.key: field.from_text("2.5")})
    assert contact_case(typed.table, "").contact.touching_gap == pytest.approx(2.5e-9)
    other = "point" if geometry == "line" else "line"
    assert switched(typed, contact_start(other)).value(field.key) == "2.5 nm"
