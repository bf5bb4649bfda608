"""Answers about a drive: the numbers of the commands check and drive, and figures of them."""

import json
from dataclasses import asdict
from unittest import mock

import pytest

from ehlectric.app.compute.drive_answers import quick_answer, simulate
from ehlectric.app.pages.frame import DRIVE
from ehlectric.app.session import SURFACES
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.quick_estimate import expected, quick_drive
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.readable import readable
from ehlectric.runs.by_kind import run
from ehlectric.runs.preview import preview_of
from tests.helpers.readable import number_in

SHORT = DRIVE.changed({"drive.duration": "2 ms"})


def case_of(inputs):
    return DriveCase.from_written(inputs.table)


def quick(**changes):
    return quick_answer(DRIVE.changed(changes).table)


@pytest.fixture(scope="module")
def simulated(tmp_path_factory):
    """Answer of a simulation, the folder of its files, and the progress that was told."""
    folder, told = tmp_path_factory.mktemp("session"), []
    answer = simulate(dict(SHORT.table), folder, folder / "out", lambda *one: told.append(one))
    return answer, folder / "out", told


def number(text):
    """Number of a text with its unit, in the unit of the text."""
    return number_in(text)


@pytest.mark.slow
def test_the_first_answer_has_the_numbers_of_check():
    answer, meaning = quick(), preview_of(case_of(DRIVE))
    about = meaning.summary["drive_end"]
    assert number(answer.number("end.voltage_at_peak").text) == pytest.approx(
        about["voltage_at_peak"], rel=5e-3
    )
    assert number(answer.number("end.breakdown_voltage").text) == pytest.approx(
        about["breakdown_voltage"], rel=5e-3
    )
    assert number(answer.number("end.capacitance").text) == pytest.approx(
        1e12 * about["capacitance"], rel=5e-3
    )
    bound = quick(**{"drive_end.bearing.film_factor": "none"}).number("end.breakdown_voltage").bound
    assert (answer.number("end.breakdown_voltage").bound, bound) == ("", "≤")
    assert [(line.name, line.text) for line in answer.lines] == [(row.name, row.text) for row in meaning.rows]
    assert [one.code for one in answer.warnings if one.code] == [one.code for one in meaning.warnings]
    assert (answer.simulated, answer.figures, answer.remedies) == (False, {}, None)


@pytest.mark.slow
def test_both_ends_are_told_apart():
    other = {**DRIVE.value("drive_end"), "bearing": {**DRIVE.value("drive_end.bearing"), "base": "6206"}}
    answer = quick(non_drive_end=other)
    note = answer.number("end.capacitance").note
    assert "drive end; non-drive end: " in note
    found = preview_of(case_of(DRIVE.changed({"non_drive_end": other}))).summary
    assert number(note.rpartition(": ")[2]) == pytest.approx(
        1e12 * found["non_drive_end"]["capacitance"], rel=5e-3
    )


def test_a_warning_of_both_ends_stands_once():
    other = {**DRIVE.value("drive_end"), "bearing": {**DRIVE.value("drive_end.bearing"), "base": "6206"}}
    told = [one for one in quick(non_drive_end=other).warnings if one.code == "atlas-contacts"]
    assert len(told) == 1
    assert "drive_end: " in told[0].text
    assert "non_drive_end: " in told[0].text


def level(**changes):
    """Level and text of the verdict with smooth films before a simulation, and its margin by the divider."""
    case = case_of(DRIVE.changed(changes | {"drive_end.bearing.summit_height": 0.0}))
    found = preview_of(case).summary
    verdict = expected(case, found)
    return verdict.level, verdict.text, verdict.margin


@pytest.mark.slow
def test_verdict_by_the_divider():
    """The divider is linear in the voltage of the DC link: the margin is inversely proportional to it."""
    red, text, margin = level()
    assert (red, "above their breakdown voltage" in text) == ("red", True)
    low, text, other = level(**{"source.dc_link": "56 V"})
    assert other == pytest.approx(10.0 * margin)
    assert "below their breakdown voltage" in text
    # Weibull's law of the example, with a shape of 5, leaves a chance at a quarter of the breakdown voltage.
    assert low == "yellow"
    assert level(**{"source.dc_link": "56 V", "breakdown.weibull_shape": None})[0] == "green"
    assert level(**{"source.dc_link": "10 V"})[0] == "green"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "grade", "told"),
    [
        ({"circuit.grounding_ring_resistance": "1 ohm"}, "grey", "grounding ring"),
        ({"circuit.common_mode_inductance": "1 mH"}, "grey", "ring together"),
        ({"circuit.ground_inductance": "1 uH"}, "grey", "ring together"),
        (
            {
                "drive_end.bearing.element_material": "silicon-nitride",
                "drive_end.bearing.element_capacitance": "5 pF",
            },
            "green",
            "ceramic",
        ),
        (
            {
                "source.dc_link": "10 V",
                "source.overshoot": "20 %",
                "source.ringing_frequency": "2 MHz",
                "source.ringing_time": "1 us",
            },
            "yellow",
            "ringing",
        ),
    ],
    ids=str,
)
def test_what_the_divider_leaves_out_is_told(changes, grade, told):
    found, text, _ = level(**changes)
    assert found == grade
    assert told in text


@pytest.mark.slow
def test_behind_an_inductance_the_divider_gives_no_verdict():
    changes = {"circuit.common_mode_inductance": "1 mH", "circuit.common_mode_resistance": "100 ohm"}
    found, text, _ = level(**changes)
    assert found == "grey"
    assert "ring together" in text
    # The capacitances share a slow edge as they do without the inductance.
    assert quick(**changes).number("end.voltage_ratio").text == quick().number("end.voltage_ratio").text


def test_films_that_have_to_be_solved_are_told_at_their_key():
    changes = {"drive_end.lubricant.viscosity_law": "constant"}
    assert quick_drive(case_of(DRIVE.changed(changes)))[1] == "drive_end.lubricant.viscosity_law"
    with pytest.raises(InputError, match="solved contacts") as caught:
        quick(**changes)
    assert caught.value.key == "drive_end.lubricant.viscosity_law"


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("source.rise_time", "-1 ns", "source.rise_time"),
        ("drive_end.bearing.radial_load", "much", "drive_end.bearing.radial_load"),
        ("remedies", [{"title": "wrong", "changes": {"circuit.ring": 1}}], "remedies.1.changes.circuit.ring"),
    ],
)
def test_a_wrong_value_is_told_at_its_key(key, value, told):
    with pytest.raises(InputError) as caught:
        quick(**{key: value})
    assert caught.value.key == told


@pytest.mark.slow
@pytest.mark.gate
def test_a_simulation_has_the_numbers_of_the_command(simulated, tmp_path):
    answer, out, told = simulated
    path = tmp_path / "drive.toml"
    path.write_text(SHORT.toml(), encoding="utf-8")
    summary = run(path, tmp_path / "out").summary
    page = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    for found in (summary, page):
        del found["seconds"]
    assert page == json.loads(json.dumps(summary))
    assert (out / "events.csv").read_bytes() == (tmp_path / "out" / "events.csv").read_bytes()
    one = summary["drive_end"]
    # The worse end decides: its rate and interval stand first, and the rate of the other one beside them.
    worse, other = sorted(ENDS, key=lambda end: -summary[end]["events_per_second"])
    rate, interval = answer.number("end.events_per_second"), dict(answer.deciding.facts)["95 % interval"]
    assert number(rate.text) == pytest.approx(summary[worse]["events_per_second"], rel=5e-3)
    assert number(rate.note.rpartition(": ")[2]) == pytest.approx(
        summary[other]["events_per_second"], rel=5e-3
    )
    assert number(interval) == pytest.approx(summary[worse]["events_per_second_low"], rel=5e-3)
    assert (answer.deciding.key, answer.deciding.said) == (rate.key, ("rates",))
    assert number(answer.number("end.peak_voltage").text) == pytest.approx(one["peak_voltage"], rel=5e-3)
    assert number(answer.number("end.energy_mean").text) == pytest.approx(1e9 * one["energy_mean"], rel=5e-3)
    assert answer.verdict.level == "red"
    assert f"{readable(one['events_per_second'])} a second" in answer.verdict.numbers
    assert "is an input that is seldom measured" in answer.verdict.assumed
    parts = [done for done, of, _ in told if of]
    assert parts == sorted(parts)
    assert parts[-1] == 100


@pytest.mark.slow
def test_remedies_stand_side_by_side(simulated):
    answer, out, _ = simulated
    titles = [row[0] for row in answer.remedies.rows]
    names = ["as it is", *(one["title"] for one in SHORT.value("remedies"))]
    assert titles == names
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    rates = [summary[table]["events_per_second"] for table in (*ENDS, "drive")]
    assert list(map(number_in, answer.remedies.rows[0][1:])) == pytest.approx(rates, rel=5e-3)
    chart = answer.figures["remedies"]
    # A ring leaves no discharge: its mark is the upper bound.
    ring = summary["remedies"][0]["drive_end"]
    assert ring["events"] == 0
    marks = {
        (x, round(y)) for trace in chart.plot["data"] for x, y in zip(trace["x"], trace["y"], strict=True)
    }
    assert (pytest.approx(ring["events_per_second_high"]), 1) in [(x, y) for x, y in marks]


@pytest.mark.slow
def test_figures_are_plain_and_small(simulated):
    answer, *_ = simulated
    assert {"voltages", "remedies", "histogram", "spectrum", "discharge-voltage"} <= set(answer.figures)
    for figure in answer.figures.values():
        assert len(json.dumps(figure.plot, allow_nan=False)) < 100_000
        assert figure.table.rows
        assert figure.label
    json.dumps({name: asdict(one) for name, one in answer.figures.items()}, default=dict)


@pytest.mark.slow
def test_shares_of_a_distribution_are_all_discharges(simulated):
    answer, *_ = simulated
    for name in ("discharge-voltage", "discharge-energy", "discharge-charge", "discharge-current"):
        steps = [trace for trace in answer.figures[name].plot["data"] if trace["showlegend"]]
        assert len(steps) == 2
        for trace in steps:
            assert sum(trace["y"]) == pytest.approx(100.0, rel=1e-3)


@pytest.mark.slow
def test_discharges_of_the_shown_time_are_marked(simulated):
    """Each mark is an event of the table of events."""
    answer, out, _ = simulated
    events = (out / "events.csv").read_text(encoding="utf-8").splitlines()[1:]
    volts = [float(row.split(",")[3]) for row in events]
    marks = [trace for trace in answer.figures["voltages"].plot["data"] if trace["name"] == "discharge"]
    found = [volt for trace in marks for volt in trace["y"]]
    assert found
    assert all(any(abs(volt - one) < 1e-4 * abs(one) for one in volts) for volt in found)


@pytest.mark.slow
def test_without_discharges_there_are_no_distributions(tmp_path):
    isothermal = {"drive_end.bearing.film_factor": "none"}
    calm = SHORT.changed({"source.dc_link": "20 V", "remedies": None} | isothermal)
    answer = simulate(dict(calm.table), tmp_path, tmp_path / "out", lambda *_: None)
    heads = ("No discharge expected in an ideal film", "Discharges possible even in an ideal film")
    assert answer.verdict.heading in heads
    assert "None in 2 ms" in answer.verdict.numbers
    assert answer.verdict.bound_note == "upper bound"
    assert list(answer.figures) == ["voltages", "histogram", "spectrum"]
    assert not answer.number("end.energy_mean").known


@pytest.mark.slow
def test_a_choke_is_simulated(tmp_path):
    """Right after an edge the choke has all of the voltage; the capacitances share it later."""
    changes = {"circuit.common_mode_inductance": "1 uH", "circuit.common_mode_resistance": "50 ohm"}
    choked = SHORT.changed({**changes, "remedies": None})
    answer = simulate(dict(choked.table), tmp_path, tmp_path / "out", lambda *_: None)
    # Such a choke is done within a microsecond, so that the films have nearly the voltage without it.
    assert number(answer.number("end.peak_voltage").text) > 3.0


def test_warnings_have_a_place():
    answer = quick(**{"circuit.machine": None})
    names = {one.key for one in answer.shown}
    assert all(set(one.concerns) <= names for one in answer.warnings)


def test_estimated_capacitances_are_told_beside_them():
    geometry = {
        "stack_length": "120 mm",
        "bore_diameter": "110 mm",
        "air_gap": "0.5 mm",
        "slots": 36,
        "slot_opening": "3 mm",
        "copper_depth": "2 mm",
        "slot_permittivity": 2,
        "liner_width": "50 mm",
        "liner_thickness": "0.3 mm",
        "liner_permittivity": 3.5,
    }
    answer = quick(circuit={"machine": geometry})
    assert "capacitances-estimated" in [
        one.code for one in answer.number("circuit.winding_rotor_capacitance").warnings
    ]


@pytest.mark.slow
@mock.patch("ehlectric.drive.drive_cycle.SIMULATED", 12)
def test_a_duty_cycle_is_simulated_with_the_drive(tmp_path):
    """Its figure and rows are those of the command; the answer at once does not need its file."""
    (tmp_path / SURFACES).mkdir()
    (tmp_path / SURFACES / "cycle.csv").write_text("time [s],speed [rpm]\n0,0\n1,3000\n2,4000\n3,4000\n")
    table = dict(SHORT.changed({"duty.file": f"{SURFACES}/cycle.csv"}).table)
    assert quick_answer(table, tmp_path) == quick_answer(dict(SHORT.table), tmp_path)
    answer = simulate(table, tmp_path, tmp_path / "out", lambda *_: None)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    rows = {line.name: line.text for line in answer.lines}
    total = readable(summary["duty"]["discharges"])
    assert rows["discharges in the cycle, both bearings"] == total
    assert (tmp_path / "out" / "duty.csv").is_file()
    figure = answer.figures["duty"]
    lines = {
        trace["name"]: trace for trace in figure.plot["data"] if "fill" not in trace and trace.get("name")
    }
    assert set(lines) == {"speed", "lambda ratio", *NAMES_OF_ENDS.values()}
    assert lines["speed"]["y"] == pytest.approx([0.0, 3000.0, 4000.0, 4000.0])
    assert lines["drive end"]["y"][0] == 0.0, "no discharges at a standstill"
    shown = [trace["name"] for trace in figure.plot["data"] if trace["showlegend"]]
    assert shown == ["standstill", *NAMES_OF_ENDS.values()]
    assert len(figure.table.rows) == len(summary["duty"]["stretches"])


def test_ceramic_elements_have_their_voltage_in_the_drive_and_no_card_without_a_value():
    """Nine elements of 5 pF in each bearing, beside 50 pF and 500 pF: a part of the 280 V of the source."""
    ceramic = {"bearing.element_material": "silicon-nitride", "bearing.element_capacitance": "5 pF"}
    changes = {f"drive_end.{key}": value for key, value in ceramic.items()} | {"remedies": None}
    answer = quick_answer(DRIVE.changed(changes).table)
    number = answer.number(answer.deciding.key)
    assert (number.text, number.bound) == (f"{280.0 * 50.0 / (550.0 + 2.0 * 45.0):.3g}", "")
    assert all(one.known for one in answer.shown)
    assert "No current" in answer.meaning


def test_voltages_of_ceramic_elements_without_their_capacitance_are_lower_bounds():
    """Their capacitance is an upper bound then, and divides the voltage of the source."""
    ceramic = {"drive_end.bearing.element_material": "silicon-nitride", "remedies": None}
    answer = quick_answer(DRIVE.changed(ceramic).table)
    bounds = {one.key: one.bound for one in answer.shown}
    assert (bounds["end.voltage_at_peak"], bounds["end.voltage_ratio"]) == ("≥", "≥")
    assert bounds["end.capacitance"] == "≤"
    steel = {one.key: one.bound for one in quick_answer(DRIVE.table).shown}
    assert (steel["end.voltage_at_peak"], steel["end.capacitance"]) == ("", "")
