"""Answers about a bearing: the numbers of the command, their bounds and warnings, and figures of them."""

import json
import math
import tomllib

import pytest

from ehlectric.app.charts.bearing_charts import OverSpeed, speed_rows
from ehlectric.app.compute.answer_parts import page_warnings_of
from ehlectric.app.compute.bearing_answers import (
    answer_of,
    bearing_case,
    curves_answer,
    differences,
    quick_answer,
    shown_numbers,
    solve_contacts,
    whole_quick_answer,
)
from ehlectric.app.view_models import (
    PENDING,
    BearingAnswer,
    PageWarning,
    concerning,
    counts,
    notes_of,
)
from ehlectric.bearing.result import solve_bearing
from ehlectric.errors import InputError
from ehlectric.quantities.formats import amount
from ehlectric.quantities.lubrication_states import BOUNDARY
from ehlectric.quantities.result_warnings import CODES, ResultWarning
from ehlectric.quantities.results import BEARING_BOOK
from ehlectric.quantities.units import rpm
from ehlectric.readable import ratio_text
from ehlectric.runs.by_kind import run
from ehlectric.runs.example_files import example_text

# The example with isothermal films, whose numbers are bounds.
TEXT = example_text("bearing_6208").replace("# film_factor", "film_factor")

# Coating of an outer ring.
COATING = {"base": "schaeffler-j20aa", "relative_permittivity": 9.0, "area": "45 cm^2"}


def inputs(**bearing):
    """Tables of the example with other keys of the bearing."""
    table = tomllib.loads(TEXT)
    table["bearing"] |= bearing
    return table


@pytest.fixture(scope="module")
def summary(tmp_path_factory) -> dict:
    """Summary that ``ehlectric bearing FILE --contacts atlas`` writes for the example."""
    folder = tmp_path_factory.mktemp("command")
    path = folder / "case.toml"
    path.write_text(TEXT, encoding="utf-8")
    run(path, folder / "result", contacts="atlas")
    return json.loads((folder / "result" / "summary.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def quick() -> BearingAnswer:
    return quick_answer(inputs())


@pytest.fixture(scope="module")
def whole() -> BearingAnswer:
    return whole_quick_answer(inputs())


@pytest.mark.slow
@pytest.mark.gate
def test_the_answer_at_once_has_the_numbers_of_the_command(quick, summary):
    assert quick.numbers == summary["bearing"]
    assert list(quick.contact_rows) == summary["contacts"]
    assert [told.code for told in quick.warnings] == summary["warning_codes"]
    assert (quick.contacts, quick.whole, quick.margin, quick.converged) == ("atlas", False, None, True)


def test_a_case_by_formula_keeps_its_choice():
    """Its films differ from those of the atlas, and their error is that of the formula."""
    answer = quick_answer(inputs() | {"contacts": "formula"})
    assert answer.contacts == "formula"
    assert "formula" in answer.how
    assert "30 %" in answer.how
    assert "formula-contacts" in [told.code for told in answer.warnings]


@pytest.mark.slow
@pytest.mark.gate
def test_the_whole_answer_has_the_verdict_of_the_command(whole, summary):
    assert (whole.verdict.text, whole.verdict.level) == (summary["verdict"], summary["margin"]["level"])
    assert whole.margin == summary["margin"]
    assert whole.numbers == summary["bearing"]
    verdict = whole.verdict
    assert verdict.level == whole.verdict.level == summary["verdict_level"]
    assert [one["code"] for one in summary["verdict_reasons"]] == [
        one.code for one in (verdict.answer, *verdict.reasons, *verdict.assumptions)
    ]
    lead, _, film = verdict.heading.partition(" even in ")
    assert ("ideal film" in film, verdict.bound_note) == (True, "upper bound")
    sentences = [f"{lead}: ", verdict.numbers, *verdict.sentences(), verdict.assumed]
    assert "".join(sentences).replace(" ", "").lower() == whole.verdict.text.replace(" ", "").lower()


@pytest.mark.slow
@pytest.mark.gate
def test_numbers_are_shown_with_their_units_and_bounds(quick, summary):
    totals = summary["bearing"]
    shown = {number.key: (number.bound, f"{number.text} {number.unit}".strip()) for number in quick.shown}
    assert shown == {
        "bearing.capacitance": ("", amount(totals["capacitance"], "F")),
        "bearing.first_break": ("≤", amount(totals["first_break"], "V")),
        "bearing.shaft_voltage": ("", amount(totals["shaft_voltage"], "V")),
        "bearing.margin": ("≤", f"{totals['margin']:.4g}"),
        # The films are isothermal, fully flooded and smooth.
        "bearing.lambda_ratio": ("≤", f"{totals['lambda_ratio']:.3g}"),
        "bearing.electrical_behaviour": ("", totals["electrical_behaviour"]),
        "margin.critical_speed": ("", "…"),
    }
    note = quick.number("bearing.capacitance").note
    assert amount(totals["capacitance_air"], "F") in note
    assert amount(totals["capacitance_oil"], "F") in note
    assert "upper bound: isothermal" in quick.number("bearing.first_break").note


def test_the_best_estimate_has_no_bounds(quick):
    """Films of the example with heat in the inlet: thinner than the isothermal ones, and no upper bounds."""
    best = quick_answer(tomllib.loads(example_text("bearing_6208")))
    assert {number.bound for number in best.shown} == {""}
    assert (best.verdict.bound_note, best.verdict.assumed[:14]) == ("", "Best estimate:")
    assert "ideal" not in best.verdict.heading
    assert best.numbers["inlet_shear_factor"] == best.numbers["film_factor"]
    # The smooth film breaks down in proportion to its thickness, and the rough one under its highest summits.
    rough = 1.0 - 2.0 / best.numbers["lambda_ratio"]
    ratio = best.numbers["first_break"] / quick.numbers["first_break"]
    assert ratio == pytest.approx(rough * best.numbers["film_factor"], rel=5e-3)


@pytest.mark.slow
def test_the_critical_speed_comes_with_the_whole_answer(quick, whole, summary):
    assert "capacitive" not in quick.number("bearing.electrical_behaviour").note
    speed = rpm(summary["margin"]["capacitive_speed"])
    # Real films are thinner than these, and touch up to higher speeds.
    assert whole.number("bearing.electrical_behaviour").note.endswith(f" ≥ {float(f'{speed:.3g}'):g} rpm")
    found = whole.number("margin.critical_speed")
    critical = rpm(summary["margin"]["critical_speed"])
    assert (found.known, found.bound) == (True, "≥")
    assert float(found.text) == pytest.approx(critical, rel=5e-3)
    assert found.unit == "rpm"


@pytest.mark.slow
@pytest.mark.gate
def test_the_details_are_the_rows_that_the_command_prints(whole, quick):
    from ehlectric.tables.bearing_tables import total_rows

    result = solve_bearing(bearing_case(inputs(), "atlas"), workers=1)
    rows = [(row.name, row.text) for row in total_rows(result.summary()) if row.name != "computing time"]
    assert [(line.name, line.text) for line in whole.lines if line.name != "computing time"] == rows
    assert len(quick.lines) < len(whole.lines)


@pytest.mark.slow
def test_without_ranges_the_verdict_at_once_has_the_level_of_the_whole_one(quick, whole):
    assert quick.verdict.level == whole.verdict.level == "yellow"


@pytest.mark.slow
def test_with_ranges_the_verdict_at_once_is_not_green():
    strong = {"discharge": {"dielectric_strength": "40 V/um"}}
    table = inputs() | strong | {"ranges": {"bearing.radial_load": ["1700 N", "1900 N"]}}
    quick, whole = quick_answer(table), whole_quick_answer(table)
    assert quick.verdict.level == "yellow"
    assert "follows" in quick.verdict.text
    assert "follows" in quick.number("bearing.margin").note
    # The narrow range changes nothing: a bearing with this strength is green without it.
    assert (whole.verdict.level, "follows" in whole.verdict.text) == ("green", False)
    assert "within the stated ranges" in whole.number("bearing.margin").note


def test_the_voltage_that_ceramic_elements_must_insulate_decides():
    """Nine of 5 pF each beside 20 pF and 1 nF, at 300 V; without their capacitance a bound."""
    given = quick_answer(inputs(element_material="silicon-nitride", element_capacitance="5 pF"))
    assert (given.verdict.level, given.verdict.heading) == ("green", "No discharge expected")
    assert given.deciding.key == "bearing.element_voltage"
    assert given.number("bearing.element_voltage").with_unit == f"{300.0 * 20.0 / 1110.0:.3g} V"
    bound = quick_answer(inputs(element_material="silicon-nitride"))
    assert bound.number("bearing.element_voltage").with_unit == f"≤ {300.0 * 20.0 / 1020.0:.3g} V"
    capacitance = bound.number("bearing.capacitance")
    assert (capacitance.bound, "≤" in capacitance.note) == ("≤", True)
    assert "capacitance-bound" in [told.code for told in capacitance.warnings]


@pytest.mark.slow
@pytest.mark.parametrize("motor", [True, False])
def test_no_card_of_ceramic_elements_is_none(motor):
    table = inputs(element_material="silicon-nitride")
    answer = whole_quick_answer(table if motor else {**table, "motor": None})
    assert all(one.known for one in answer.shown)
    assert answer.number(answer.deciding.key) is not None


def test_touching_surfaces_have_no_voltage_and_no_green():
    quick = quick_answer(inputs(inner_speed="60 rpm"))
    assert quick.verdict.level == "red"
    first = quick.number("bearing.first_break")
    assert not first.known
    codes = [told.code for told in first.warnings]
    assert "touching" in codes
    assert "isothermal-film" not in codes, "there is no voltage that it would bound"
    assert "touching" in [told.code for told in quick.number("bearing.capacitance").warnings]
    assert "touching" in [told.code for told in quick.number("bearing.lambda_ratio").warnings]


def test_warnings_concern_quantities_of_the_book():
    concerned = {key for about in CODES.values() for key in about.concerns}
    assert {key for key in concerned if key.startswith(("bearing.", "margin."))} <= {*BEARING_BOOK}


@pytest.mark.slow
def test_warnings_stand_beside_the_numbers_they_concern(quick):
    found = {number.key: [told.code for told in number.warnings] for number in quick.shown}
    assert found["bearing.capacitance"] == ["atlas-contacts"]
    for key in ("bearing.first_break", "bearing.margin", "bearing.lambda_ratio"):
        assert found[key] == ["atlas-contacts", "isothermal-film"]
    notes = notes_of(quick.shown, quick.warnings)
    assert [note.warning for note in notes] == list(quick.warnings), "each stands once, in this order"
    names = {number.name.lower() for number in quick.shown}
    for note in notes:
        assert bool(note.letter) is bool(note.names)
        assert {name.lower() for name in note.names} <= names
    marked = {note.warning.code: note.names for note in notes if note.letter}
    assert {code for codes in found.values() for code in codes} == marked.keys()
    assert "capacitance of the bearing" in marked["atlas-contacts"]
    assert len({note.letter for note in notes if note.letter}) == len(marked)


@pytest.mark.slow
def test_places_are_numbers_that_the_page_shows(quick):
    places = {key for told in quick.warnings for key in told.concerns}
    assert places
    assert places <= {number.key for number in quick.shown}


def test_severe_warnings_come_first_and_each_once():
    warnings = [ResultWarning("speed-high", "fast"), ResultWarning("not-converged", "no")] * 2
    told = page_warnings_of(warnings)
    assert [one.code for one in told] == ["not-converged", "speed-high"]
    assert counts(told) == "1 severe warning, 1 warning"
    assert concerning(told, "bearing.margin") == told[:1]


@pytest.mark.slow
def test_films_that_are_not_converged_are_no_numbers_and_no_figures(summary):
    told = (PageWarning("not-converged", "severe", "no solution", CODES["not-converged"].concerns),)
    for number in shown_numbers(summary | {"converged": False}, told, whole=True):
        assert not number.known
        assert number.bound == ""
        assert "not converged" in number.note


def test_no_figures_of_films_that_are_not_converged(monkeypatch):
    from ehlectric.bearing.solution import BearingSolution

    monkeypatch.setattr(BearingSolution, "converged", False)
    result = solve_bearing(bearing_case(inputs(), "atlas"), workers=1)
    answer = answer_of(result, analysed=False, curves=False)
    assert (answer.verdict.level, answer.figures) == ("grey", {})


@pytest.mark.slow
def test_figures_around_the_shaft_have_the_contacts_of_the_summary(quick, summary):
    for name, key in (("load", "load"), ("film", "minimum_thickness")):
        figure = quick.figures[name]
        factor = {"[N]": 1.0, "[kN]": 1e-3, "[µm]": 1e6, "[nm]": 1e9}[figure.title.split()[-1]]
        traces = {trace["name"]: trace for trace in figure.plot["data"] if trace["mode"] == "markers"}
        for ring in ("inner", "outer"):
            for label, loaded in ((f"{ring} contact", True), (f"{ring}, unloaded", False)):
                rows = [row for row in summary["contacts"] if (row["ring"], row["solved"]) == (ring, loaded)]
                if not rows or (name == "film" and not loaded):
                    assert label not in traces
                    continue
                trace = traces[label]
                assert trace["r"] == pytest.approx([factor * row[key] for row in rows], rel=1e-6)
                assert trace["theta"] == pytest.approx([math.degrees(row["position"]) for row in rows])
                texts = [
                    f"element {row['element']}<br>" in text
                    for row, text in zip(rows, trace["text"], strict=True)
                ]
                assert all(texts)


@pytest.mark.slow
@pytest.mark.gate
def test_the_figure_over_speed_passes_through_the_bearing_itself(whole, summary):
    data = whole.figures["breakdown"].plot["data"]
    (star,) = (trace for trace in data if trace.get("marker", {}).get("symbol") == "star")
    assert star["x"][0] == pytest.approx(3000.0, rel=1e-6)
    assert star["y"][0] == pytest.approx(summary["bearing"]["first_break"], rel=1e-6)
    critical = rpm(summary["margin"]["critical_speed"])
    (line,) = (trace for trace in data if str(trace.get("name")).startswith("critical speed"))
    assert line["x"] == pytest.approx([critical] * 2, rel=1e-6)


@pytest.mark.slow
def test_no_voltage_is_drawn_where_surfaces_touch():
    slow = whole_quick_answer(inputs(inner_speed="600 rpm"))
    data = slow.figures["breakdown"].plot["data"]
    (hatched,) = (trace for trace in data if "λ < 1" in str(trace.get("name")))
    assert hatched["fillpattern"]["shape"]
    begin, end = min(hatched["x"]), max(hatched["x"])
    lines = [t for t in data if t["mode"] == "lines" and "break" in t["name"] and t["yaxis"] == "y"]
    (line,) = (trace for trace in lines if "first" in trace["name"])
    known = [x for x, y in zip(line["x"], line["y"], strict=True) if y is not None]
    assert known
    assert all(x >= end for x in known)
    for speed, *_, first, _, _, state in slow.figures["breakdown"].table.rows:
        if begin <= float(speed) < 0.99 * end:
            assert (first, state) == ("none", BOUNDARY.name)


@pytest.mark.slow
def test_figures_are_json_without_nan(whole):
    for figure in whole.figures.values():
        text = json.dumps(figure.plot, allow_nan=False)
        assert json.loads(text) == figure.plot
        assert figure.label
        assert figure.table.rows
        assert all(len(row) == len(figure.table.heads) for row in figure.table.rows)


def test_a_wrong_input_passes_with_its_key():
    with pytest.raises(InputError) as caught:
        quick_answer(inputs(radial_load="-1 N"))
    assert caught.value.key == "bearing.radial_load"


def test_a_table_without_a_bearing_is_refused():
    with pytest.raises(InputError) as caught:
        quick_answer({"bearing": {}})
    assert caught.value.key


@pytest.mark.slow
def test_differences_of_solved_contacts(summary):
    totals = summary["bearing"]
    thinner = {"capacitance": 1.1 * totals["capacitance"], "margin": None, "lambda_ratio": 0.8}
    solved = summary | {"bearing": totals | thinner | {"first_break": 0.5 * totals["first_break"]}}
    quick = summary | {"bearing": totals | {"lambda_ratio": 1.0}}
    found = {one.name: one.change for one in differences(quick, solved)}
    assert found == {
        "capacitance of the bearing": "+10.0 %",
        "first breakdown voltage": "-50.0 %",
        "shaft voltage": "+0.0 %",
        "margin (first breakdown / shaft voltage)": "only from the atlas",
        "minimum film thickness": "-20.0 %",
    }


@pytest.mark.slow
def test_only_the_verdict_says_how_likely_a_breakdown_is():
    """Yellow is likely and red is expected. The margin, the effects and the figure state where it is 1."""
    likely = whole_quick_answer(inputs(inner_speed="1200 rpm"))
    weak = tomllib.loads(TEXT) | {"discharge": {"dielectric_strength": "4 V/um"}}
    for answer, level, word in (
        (likely, "yellow", "likely"),
        (whole_quick_answer(weak), "red", "expected"),
    ):
        assert (answer.verdict.level, word in answer.verdict.heading) == (level, True)
        assert word in answer.meaning
        (told,) = (
            one for one in answer.number("bearing.margin").warnings if one.code == "breakdown-expected"
        )
        assert told.meaning == "The margin is below 1."
        names = [str(trace.get("name")) for trace in answer.figures["breakdown"].plot["data"]]
        assert "margin below 1" in names
        assert answer.effects.caption.endswith("; breakdown below 1")


@pytest.mark.slow
def test_the_effects_have_the_value_that_belongs_to_each_margin(whole, quick, summary):
    assert quick.effects is None
    effects = summary["margin"]["effects"]
    assert [row[0] for row in whole.effects.rows] == [one["label"] for one in effects]
    for (_, lowest, at, highest, other), one in zip(whole.effects.rows, effects, strict=True):
        margins = sorted((one["low_margin"], one["high_margin"]))
        assert [lowest, highest] == [f"≤ {ratio_text(margin)}" for margin in margins]
        falls = one["low_margin"] > one["high_margin"]
        low, high = (float(text.split()[0]) for text in ((other, at) if falls else (at, other)))
        assert low < high
    found = {row[0]: row for row in whole.effects.rows}
    assert found["temperature of the oil"][2::2] == ("80 °C", "60 °C"), "hot oil has thinner films"
    assert found["dielectric strength"][2::2] == ("12 V/µm", "18 V/µm")


def test_a_coating_has_its_own_name_for_the_voltage_on_the_shaft():
    coated = inputs(coating=COATING)
    quick = quick_answer(coated)
    films, shaft = quick.number("bearing.first_break"), quick.number("bearing.shaft_first_break")
    assert "shaft" in shaft.label.lower()
    assert f"{shaft.text} {shaft.unit}" == amount(quick.numbers["shaft_first_break"], "V")
    assert f"{films.text} {films.unit}" == amount(quick.numbers["first_break"], "V")
    assert (films.bound, shaft.bound) == ("≤", "≤")


@pytest.mark.slow
def test_the_figure_over_speed_says_what_it_draws():
    table = inputs()
    del table["discharge"]
    figure = whole_quick_answer(table).figures["breakdown"]
    assert "breakdown" not in (figure.title + figure.label + figure.caption).lower()
    assert "upper bound" not in figure.caption.lower()


def test_a_purely_axial_load_points_out_of_the_figure():
    axial = inputs(radial_load="0 N", axial_load="500 N")
    figure = quick_answer(axial).figures["load"]
    assert "axial" in figure.caption
    assert "0° (load)" not in figure.plot["layout"]["polar"]["angularaxis"]["ticktext"]


@pytest.mark.slow
def test_states_over_speed_are_those_of_the_scaled_lambda_ratio(summary):
    """By formula 2.5 is a partial film; scaled by 1.4 to solved contacts, it is a full one."""
    speed = summary["inputs"]["bearing"]["inner_speed"]

    def at(factor, ratio, contacts):
        state = "mixed lubrication" if ratio < 3.0 else "full film"
        changed = {"lambda_ratio": ratio, "lubrication": state, "contacts": contacts}
        return factor * speed, summary | {"bearing": summary["bearing"] | changed}

    points = [at(0.5, 2.5, "formula"), at(1.0, 4.0, "formula")]
    over = OverSpeed.of(points, at(1.0, 5.6, "solved"))
    assert [row[1] for row in speed_rows(over)] == ["3.5", "5.6"]
    assert [row[-1] for row in speed_rows(over)] == ["full film", "full film"]


@pytest.mark.slow
def test_solved_contacts_are_the_result_of_the_command(tmp_path):
    # Line contacts of rollers are solved faster than those of balls.
    table = inputs(base="nu-205", axial_load="0 N", radial_clearance="20 um", profile="none")
    told = []
    answer = solve_contacts(table, tmp_path, tmp_path / "solved", lambda *one: told.append(one))
    summary = json.loads((tmp_path / "solved" / "summary.json").read_text(encoding="utf-8"))
    assert (answer.contacts, answer.whole, answer.numbers) == ("solved", True, summary["bearing"])
    assert (answer.verdict.text, answer.margin) == (summary["verdict"], summary["margin"])
    contacts = [one for one in told if one[2] == "contacts"]
    assert contacts[0][0] == 0
    assert contacts[-1][0] == contacts[-1][1] > 4
    assert {one.name for one in answer.differences} >= {
        "capacitance of the bearing", "minimum film thickness"
    }  # fmt: skip


@pytest.mark.slow
def test_the_margin_decides_with_its_interval(quick, whole, summary):
    """Its gauge is within the interval that the command writes; the sentences on these are said once."""
    assert [name for name, _ in quick.deciding.facts] == [name for name, _ in whole.deciding.facts]
    assert {text for _, text in quick.deciding.facts} == {PENDING}
    assert (quick.deciding.gauge.value, quick.deciding.gauge.interval) == (summary["bearing"]["margin"], None)
    gauge, within = whole.deciding.gauge, summary["uncertainty"]
    assert gauge.value == within["margin_median"]
    assert gauge.interval == (within["margin_low"], within["margin_high"])
    low, high = map(ratio_text, gauge.interval)
    assert whole.deciding.facts[0][1] == f"{low} to {high}"
    assert f"{low} to {high}" in gauge.label
    left = whole.verdict.sentences(whole.deciding.said)
    assert sum(f"{low} to {high}" in one for one in whole.verdict.sentences()) == 1
    assert not any(f"{low} to {high}" in one for one in left)
    assert whole.deciding.figure in whole.figures


def test_without_a_motor_the_first_breakdown_decides():
    table = inputs()
    del table["motor"]
    answer = quick_answer(table)
    assert (answer.deciding.key, answer.deciding.gauge) == ("bearing.first_break", None)
    touching = quick_answer(inputs(inner_speed="60 rpm"))
    assert (touching.deciding.key, touching.number("bearing.margin").known) == ("", False)


@pytest.mark.slow
def test_the_curves_come_before_the_probability():
    table = inputs()
    first, before, whole = quick_answer(table), curves_answer(table), whole_quick_answer(table)
    assert [(one.has_curves, one.analysed, one.whole) for one in (first, before, whole)] == [
        (False, False, False),
        (True, False, False),
        (True, True, True),
    ]
    assert before.figures.keys() - first.figures.keys() == {"breakdown", "capacitance"}
    assert before.figures["capacitance"] == whole.figures["capacitance"]
    assert (before.shown, before.verdict, before.effects) == (first.shown, first.verdict, None)
    assert "probability-follows" in [one.code for one in first.verdict.reasons]
    assert not any("probability of breakdown is" in one for one in first.verdict.sentences())
    assert any("probability of breakdown is" in one for one in whole.verdict.sentences())
