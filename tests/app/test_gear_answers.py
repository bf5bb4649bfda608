"""Form and answers of a gear pair, against the drawing and against the command."""

import tomllib

import numpy as np
import pytest

from ehlectric import GearCase, InputError, solve_gear
from ehlectric.app.charts.gear_charts import flank_figure
from ehlectric.app.compute.gear_answers import meaning_of, quick_answer, solve_pair, whole_answer
from ehlectric.app.compute.page_files import uploaded
from ehlectric.app.compute.sweep_answers import choices
from ehlectric.app.form_fields import GEAR_GROUPS
from ehlectric.app.form_fields.field_defaults import default_of
from ehlectric.app.form_fields.field_rules import Memory, changed
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import GEAR
from ehlectric.app.view_models import PENDING, WITHOUT_PROBABILITY
from ehlectric.figures.gear_panels import flank_map
from ehlectric.quantities.sheets import GEAR_CARDS
from ehlectric.quantities.verdict import Verdict
from ehlectric.runs.example_files import example_text
from ehlectric.runs.preview import preview_of
from tests.helpers.each import each

FIELDS = {field.key: field for group in GEAR_GROUPS for field in group.fields}
SPUR = Inputs(tomllib.loads(example_text("gear_spur")))


def answer(inputs):
    return quick_answer(dict(inputs.table))


def number(found, key):
    return next(one for one in found.shown if one.key == key)


@pytest.fixture(scope="module")
def example():
    return answer(GEAR)


def test_numbers_are_those_of_the_command(example):
    mesh = solve_gear(GearCase.from_written(GEAR.table), probable=False).summary()["mesh"]
    assert float(number(example, "mesh.margin").text) == pytest.approx(mesh["margin"], rel=5e-3)
    assert float(number(example, "mesh.lambda_ratio").text) == pytest.approx(mesh["lambda_ratio"], rel=5e-3)
    assert number(example, "mesh.state").text == mesh["state"]
    assert [one.key for one in example.shown] == list(GEAR_CARDS)
    assert example.deciding.key == "mesh.margin"
    assert example.deciding.gauge.value == pytest.approx(mesh["margin"])
    assert set(example.figures) == {"film", "flank", "mesh", "path"}
    assert not example.solved


@each(
    ("changes", "key"),
    [
        ({"gear.tip_diameter": ["82 mm"]}, "gear.tip_diameter.2"),
        ({"gear.tip_diameter": ["", "118 mm"]}, "gear.tip_diameter.1"),
        ({"gear.profile_shift": [0.2], "gear.centre_distance": None}, "gear.profile_shift.2"),
        ({"gear.profile_shift": ["", 0.2]}, "gear.profile_shift.1"),
    ],
)
def test_a_value_for_one_gear_only_is_refused_at_the_empty_field(changes, key):
    with pytest.raises(InputError) as refused:
        answer(SPUR.changed(changes))
    assert refused.value.key == key


def test_one_shift_and_one_roughness_are_enough():
    """The other shift follows from the centre distance, and one roughness holds for both gears."""
    inputs = SPUR.changed({"gear.profile_shift": [0.1817], "gear.flank_ra": ["0.2 um"]})
    assert number(answer(inputs), "mesh.lambda_ratio").text


def test_what_follows_from_a_drawing_is_that_of_its_equations():
    """By hand: without centre distance and shifts, both shifts are 0, a = m_n (z1 + z2)/(2 cos beta), and
    d_a = d + 2 m_n.
    """
    spur = {"gear.centre_distance": None, "gear.profile_shift": None, "gear.tip_diameter": None}
    follows = answer(SPUR.changed(spur)).follows
    assert follows["gear.centre_distance"] == "90 mm"
    assert [follows[f"gear.profile_shift.{n}"] for n in (1, 2)] == ["0", "0"]
    assert [follows[f"gear.tip_diameter.{n}"] for n in (1, 2)] == ["81 mm", "117 mm"]
    # One shift of FZG type C, 0.1817, and the centre distance: the drawing has 0.1715 with some backlash.
    follows = answer(SPUR.changed({"gear.profile_shift": [0.1817]})).follows
    assert float(follows["gear.profile_shift.2"]) == pytest.approx(0.1715, abs=1e-3)


@each(
    "changes, level, key",
    [
        ({}, "red", "mesh.margin"),
        ({"gear.contact.voltage": "50 mV"}, "green", "mesh.margin"),
        ({"gear.contact.voltage": None}, "grey", "mesh.breakdown_voltage"),
        ({"discharge": None}, "grey", "mesh.lambda_ratio"),
        ({"gear.flank_ra": ["0.3 um"]}, "red", "mesh.lambda_ratio"),
    ],
)
def test_every_verdict_has_a_number_that_decides(changes, level, key):
    found = answer(GEAR.changed(changes))
    assert (found.verdict.level, found.deciding.key) == (level, key)
    assert found.verdict.heading
    assert found.number(key) is not None


@each("code", ["discharges-expected", "discharges-likely", "discharges-possible"])
def test_touching_summits_have_a_meaning_of_their_own(code):
    assert meaning_of(Verdict("red", code)).startswith("Summits of the flanks")


def test_a_mesh_that_conducts_has_a_meaning_of_its_own():
    found = answer(SPUR)
    assert found.verdict.code == "mesh-conducts"
    assert found.meaning == meaning_of(found.verdict) != ""
    assert found.deciding.gauge is None


@each(
    "changes, expected",
    [
        ({"gear.teeth.2": 68}, {"gear.teeth": [23, 68]}),
        ({"gear.profile_shift.2": 0.1}, {"gear.profile_shift": [0.3, 0.1]}),
        ({"gear.profile_shift.1": None}, {"gear.profile_shift": None}),
        ({"gear.tip_diameter.2": None}, {"gear.tip_diameter": ["48.96 mm"]}),
        ({"gear.tip_relief.2": "5 um"}, {"gear.tip_relief": ["8 um", "5 um"]}),
        ({"gear.composite_rq": "0.1 um"}, {"gear.composite_rq": "0.1 um", "gear.flank_ra": None}),
        (
            {"gear.tip_relief.1": None, "gear.tip_relief_length": None},
            {"gear.tip_relief": None, "gear.tip_relief_length": None},
        ),
    ],
)
def test_a_value_of_one_gear_changes_its_list(changes, expected):
    after = changed(GEAR, changes)
    assert {key: after.value(key) for key in expected} == expected


def test_a_single_value_is_shown_for_both_gears():
    assert SPUR.value("gear.flank_ra.1") == "0.3 um"
    assert SPUR.value("gear.flank_ra.2") is None
    assert default_of(SPUR, "gear.flank_ra.2") == "0.3 um"
    both = changed(SPUR, {"gear.flank_ra.2": "0.2 um"})
    assert both.value("gear.flank_ra") == ["0.3 um", "0.2 um"]


def test_lists_of_alternatives_go_forth_and_back():
    memory = Memory(GEAR_GROUPS)
    memory.note(GEAR)
    temperature, roughness = FIELDS["gear.operation.way_bulk"], FIELDS["gear.way_roughness"]
    bulk = FIELDS["gear.operation.bulk_temperature"]
    estimated = changed(GEAR, memory.alternative(temperature, 0, GEAR))
    assert estimated.value(bulk.key) == "iso"
    assert not bulk.shown(estimated)
    assert temperature.alternative(estimated.changed({bulk.key: None})) == 2
    composite = changed(estimated, memory.alternative(roughness, 1, estimated))
    assert composite.value("gear.flank_ra") is None
    memory.note(composite)
    back = changed(composite, memory.alternative(roughness, 0, composite))
    back = changed(back, memory.alternative(temperature, 1, back))
    assert back == GEAR


@each(
    "changes, key",
    [
        ({"gear.teeth": [23, "many"]}, "gear.teeth.2"),
        ({"gear.teeth": ["", 67]}, "gear.teeth.1"),
        ({"gear.tip_diameter": ["48.96 mm"]}, "gear.tip_diameter"),
        ({"gear.tip_diameter": ["48.96 mm", "200 mm"]}, "gear.tip_diameter.2"),
        ({"gear.centre_distance": "70 mm"}, "gear.centre_distance"),
        ({"gear.tip_relief_length": None}, "gear.tip_relief_length"),
        ({"gear.operation.pinion_torque": "0 N m"}, "gear.operation.pinion_torque"),
        ({"lubricant.base": None}, "lubricant"),
    ],
)
def test_an_error_is_about_a_field(changes, key):
    with pytest.raises(InputError) as error:
        answer(GEAR.changed(changes))
    assert error.value.key.startswith(key)
    assert any(field.startswith(key) for field in FIELDS)


def test_tables_have_a_text_in_every_cell(example):
    for table in (example.points, example.geometry):
        assert all(cell for row in table.rows for cell in row)
        assert {len(row) for row in table.rows} == {len(table.heads)}
    assert example.points.heads[1:] == tuple("ABCDE")


def test_a_gear_file_is_opened_and_belongs_to_its_page(tmp_path):
    found = uploaded({"pair.toml": example_text("gear_pair").encode()}, tmp_path)
    assert (found.kind, found.missing) == ("gear", ())
    assert Inputs(found.table) == GEAR
    with pytest.raises(InputError, match=r"gear\.teeth"):
        uploaded({"pair.toml": example_text("gear_pair").replace("23, 67", "2, 67").encode()}, tmp_path)


def test_the_map_of_the_flank_has_the_dashed_line_of_its_summits():
    """Summits just below the largest film, which is at an edge of the flank."""
    case = GearCase.from_written(
        GEAR.changed({"gear.tip_relief": None, "gear.tip_relief_length": None}).table
    )
    result = solve_gear(case, probable=False)
    highest = float(np.nanmax(flank_map(result)[2])) / result.solution.rq
    for height, lines in ((0.9999 * highest, 1), (1.0001 * highest, 0)):
        drawn = flank_figure(solve_gear(case.replace({"gear.summit_height": height}), probable=False))["data"]
        dashes = [trace for trace in drawn if trace.get("line", {}).get("dash") == "dash"]
        assert len(dashes) == lines


def test_the_caption_of_the_flank_names_one_colour_only_if_films_have_it():
    for relief, capped in (("8 um", True), (None, False)):
        lists = {"gear.tip_relief": relief, "gear.tip_relief_length": relief and "1 mm"}
        caption = answer(GEAR.changed(lists)).figures["flank"].caption
        assert ("one colour" in caption) == capped


@pytest.mark.slow
def test_the_probability_follows_and_is_that_of_the_result(example):
    assert not example.whole
    assert ("probability of breakdown", PENDING) in example.deciding.facts
    assert ("margin, within the ranges of the inputs", PENDING) in example.deciding.facts
    assert example.deciding.gauge.interval is None
    whole = whole_answer(dict(GEAR.changed({"gear.contact.voltage": "0.7 V"}).table))
    case = GearCase.from_written(GEAR.table).replace({"gear.contact.voltage": "0.7 V"})
    chance = solve_gear(case).summary()["uncertainty"]["breakdown_probability"]
    shown = dict(whole.deciding.facts)["probability of breakdown"]
    assert whole.whole
    assert float(shown.removesuffix(" %")) == pytest.approx(100.0 * chance, rel=0.05)
    assert whole.deciding.gauge.interval == whole.verdict.interval
    assert PENDING not in dict(whole.deciding.facts).values()
    assert WITHOUT_PROBABILITY not in {reason.code for reason in whole.verdict.reasons}


@pytest.mark.slow
@each("changes", [{}, {"gear.flank_ra": ["0.12 um"]}])
def test_the_page_and_the_commands_give_one_verdict(changes):
    """The whole answer is the answer of ``gear`` and of ``check``, and the answer at once states that it has
    no probability of breakdown.
    """
    inputs = GEAR.changed(changes)
    case = GearCase.from_written(inputs.table)
    whole, first = whole_answer(dict(inputs.table)).verdict, answer(inputs).verdict
    assert whole.text == solve_gear(case).verdict.text
    assert whole.text == preview_of(case).verdict.text
    assert first.level == whole.level == "red"
    stated = [
        WITHOUT_PROBABILITY in {reason.code for reason in verdict.reasons} for verdict in (first, whole)
    ]
    assert stated == [True, False]


@pytest.mark.slow
def test_solved_films_are_those_of_the_command(tmp_path):
    found = solve_pair(dict(GEAR.table), None, tmp_path / "out", lambda *_: None)
    case = GearCase.from_written(GEAR.table).replace({"contacts": "solved"})
    assert found.solved
    mesh = solve_gear(case, probable=False).summary()["mesh"]
    assert float(number(found, "mesh.margin").text) == pytest.approx(mesh["margin"], rel=5e-3)
    assert (tmp_path / "out" / "gear.nc").is_file()


def test_a_sweep_can_vary_torque_and_speed():
    offered = choices(dict(GEAR.table))
    ends = {one.key: (one.low, one.high) for one in offered.variables}
    # A third and three times the values of the example.
    assert ends["gear.operation.pinion_torque"] == ("10 N m", "90 N m")
    assert ends["gear.operation.pinion_speed"] == ("4700 rpm", "42000 rpm")
    assert (offered.kind, "mesh.margin" in offered.values) == ("gear", True)
