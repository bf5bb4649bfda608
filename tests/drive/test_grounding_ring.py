"""Grounding ring or brush whose resistance follows the speed: its table, limits by hand, and every output."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric import DriveCase, InputError, Sweep, run_sweep, solve_drive
from ehlectric.app.form_fields.drive_fields import DRIVE_GROUPS, PRESETS
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.drive_inputs import RingTable
from ehlectric.drive.drive_cycle import run_drive_cycle
from ehlectric.drive.drive_netlist_files import drive_netlist
from ehlectric.drive.drive_record import COLUMNS
from ehlectric.drive.quick_estimate import expected
from ehlectric.drive.solver import solve
from ehlectric.drive.summary import drive_summary
from ehlectric.drive.warnings import machine_warnings
from ehlectric.quantities.units import RPM
from ehlectric.report.appendix import named
from ehlectric.report.drive_report import deciding_blocks
from ehlectric.report.report_texts import limits_of
from ehlectric.runs.preview import preview_of
from tests.helpers.drives import arc, drive_system, element, from_rest, march, motor, small_drive, square
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

RING, TABLE = "circuit.grounding_ring_resistance", "circuit.grounding_ring_table"
SPEEDS, OHMS = ("0 rpm", "3000 rpm", "10000 rpm"), ("0.5 ohm", "5 ohm", "50 ohm")
BRUSH = {"speed": SPEEDS, "resistance": OHMS}


def brush(speed=SPEEDS, resistance=OHMS):
    return RingTable.from_dict({"speed": speed, "resistance": resistance})


def driven(rpm, table=BRUSH, **changes):
    """Small drive at a speed with a table of its ring."""
    return small_drive(**{TABLE: table, "drive.speed": f"{rpm} rpm"}, **changes)


def ring_of(case):
    return case.running_circuit.grounding_ring_resistance


# The table.


@each("rpm, ohm", [(0.0, 0.5), (3000.0, 5.0), (10000.0, 50.0)])
def test_the_table_is_exact_at_its_entries(rpm, ohm):
    table = brush()
    (speed,) = (one for one in table.speed if one == pytest.approx(rpm * RPM, rel=1e-12))
    assert table.at_speed(speed) == table.at_speed(-speed) == ohm


@each(
    "rpm, ohm", [(1500.0, 0.5 * math.sqrt(10.0)), (6500.0, 5.0 * math.sqrt(10.0)), (600.0, 0.5 * 10.0**0.2)]
)
def test_the_logarithm_is_linear_between_the_entries(rpm, ohm):
    assert brush().at_speed(rpm * RPM) == pytest.approx(ohm, rel=1e-12)


def test_a_table_rises_and_falls_as_its_entries_do():
    table = brush(("0 rpm", "1 krpm", "2 krpm", "3 krpm"), ("7 ohm", "0.1 ohm", "0.1 ohm", "90 ohm"))
    found = np.array([table.at_speed(speed) for speed in np.linspace(0.0, table.speed[-1], 301)])
    assert np.all(np.diff(found[:101]) < 0.0)
    assert np.all(found[101:201] == 0.1)
    assert np.all(np.diff(found[201:]) > 0.0)


@each("rpm", [0.0, 0.1, 1234.5, 9999.9, 1e5])
def test_a_table_of_one_value_has_it_everywhere(rpm):
    assert brush(resistance=("3.3 ohm",) * 3).at_speed(rpm * RPM) == 3.3


def test_beyond_the_table_its_ends_hold():
    table = brush(("1000 rpm", "2000 rpm"), ("1 ohm", "4 ohm"))
    assert [table.at_speed(rpm * RPM) for rpm in (0.0, 999.0, 2001.0, 1e5)] == [1.0, 1.0, 4.0, 4.0]
    assert [table.covers(rpm * RPM) for rpm in (999.0, 1000.0, 1500.0, 2000.0, 2001.0)] == [
        False, True, True, True, False,
    ]  # fmt: skip


# Its drive.


def test_a_table_and_one_resistance_displace_each_other():
    case = small_drive(**{RING: "2 ohm"})
    table = case.replace({TABLE: BRUSH})
    assert (table.circuit.grounding_ring_resistance, ring_of(table)) == (None, 5.0)
    assert table.replace({RING: "2 ohm"}) == case
    ring = {"title": "One resistance", "changes": {RING: "2 ohm"}}
    assert [ring_of(one) for one in table.replace({"remedies": [ring]}).variants()] == [2.0]


def test_a_file_is_written_and_read_back(tmp_path):
    case = driven(1500)
    (tmp_path / "drive.toml").write_text(case.to_toml())
    assert DriveCase.from_toml(tmp_path / "drive.toml") == case == DriveCase.from_dict(case.to_dict())


def test_without_a_speed_of_the_drive_that_of_its_bearing_counts():
    table = driven(1500).to_dict()
    table["drive"].pop("speed")
    case = DriveCase.from_dict(table).replace({"drive_end.bearing.inner_speed": "10000 rpm"})
    assert ring_of(case) == 50.0


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("rpm", "table", "ohm"), [(3000, BRUSH, 5.0), (1500, {**BRUSH, "resistance": ["7 ohm"] * 3}, 7.0)]
)
def test_a_drive_is_that_with_the_resistance_at_its_speed(rpm, table, ohm):
    """At an entry, and for a table of one value, to the last bit."""
    time = {"drive.duration": "1 ms"}
    own, other = driven(rpm, table, **time), small_drive(**{"drive.speed": f"{rpm} rpm", RING: ohm}, **time)
    found = drive_summary(solve(own))
    assert found == drive_summary(solve(other))
    assert found["circuit"]["grounding_ring_resistance"] == ohm


@each(
    "rpm, ring",
    [(0, 0.5), (1500, 0.5 * math.sqrt(10.0)), (3000, 5.0), (6500, 5.0 * math.sqrt(10.0)), (2e4, 50.0)],
)
def test_the_shaft_has_the_voltage_of_a_divider_by_hand(rpm, ring):
    """Of a sine: winding-rotor capacitance in series with the ring beside rotor, frame and both bearings."""
    circuit = motor(grounding_ring_table=BRUSH).at_speed(rpm * RPM)
    system = drive_system(circuit, [element(300e-12), element(200e-12)])
    row = system.potential("shaft rotor")
    for frequency in (50.0, 1e4, 1e6, 1e8):
        rate = 2j * math.pi * frequency
        # The states are p + k u, so that p = (i w - A)^-1 B u - k u.
        states = np.linalg.solve(rate * np.eye(len(system.force)) - system.rates, system.force) - system.jump
        below = 1.0 / (1.0 / ring + rate * (500e-12 + 300e-12 + 200e-12))
        share = below / (below + 1.0 / (rate * 50e-12))
        assert abs(row @ states) == pytest.approx(abs(share), rel=1e-6)


@each("rpm, ohm", [(1500, 0.5 * math.sqrt(10.0)), (10000, 50.0)])
def test_an_edge_leaves_the_voltage_by_hand(rpm, ohm):
    """The response of R and C to a ramp: R C_wr dV/t (1 - exp(-t/(R C)))."""
    circuit = motor(grounding_ring_table=BRUSH).at_speed(rpm * RPM)
    rise, swing, capacitance = 1e-7, 200.0, 1050e-12
    segments = from_rest(square(0.5 * swing, 1e-4, rise, 1), rise)
    record = march(circuit, [element(300e-12), element(200e-12)], arc(), segments)
    ramp = ohm * 50e-12 * swing / rise
    assert record.peak[0] == pytest.approx(ramp * -math.expm1(-rise / (ohm * capacitance)), rel=1e-6)


# What is said of it.


@each("rpm, words", [
    (500, ["500 rpm is outside", "1000 to 3000 rpm", "2 Ω at 1000 rpm"]),
    (4000, ["4000 rpm is outside", "8 Ω at 3000 rpm"]),
    (1000, []), (2000, []), (3000, []),
])  # fmt: skip
def test_a_speed_beyond_the_table_has_a_note(rpm, words):
    table = {"speed": ["1000 rpm", "3000 rpm"], "resistance": ["2 ohm", "8 ohm"]}
    case = small_drive(**{TABLE: table}).to_dict()
    case["drive"].pop("speed")
    case = DriveCase.from_dict(case).replace({"bearings.bearing.inner_speed": f"{rpm} rpm"})
    notes = [
        one for one in machine_warnings(case, [element(), element()]) if one.code == "ring-table-exceeded"
    ]
    assert len(notes) == bool(words)
    assert all(word in str(note) for note in notes for word in words)
    assert {note.severity for note in notes} <= {"note"}


@pytest.mark.slow
@pytest.mark.gate
def test_a_check_has_the_resistance_and_no_verdict_from_the_divider():
    meaning = preview_of(driven(1500))
    (row,) = (row for row in meaning.rows if row.key == RING)
    assert row.text == "1.58 Ω, by its table at this speed"
    assert "grounding ring" in expected(driven(1500), meaning.summary).text
    (plain,) = (row for row in preview_of(small_drive(**{RING: "2 ohm"})).rows if row.key == RING)
    assert plain.text == "2 Ω"
    assert not [row for row in preview_of(small_drive()).rows if row.key == RING]


def test_a_report_names_the_table_among_what_decides():
    _, table = deciding_blocks(driven(1500))
    (row,) = (row for row in table.rows if row[0] == named(TABLE))
    assert row[1:] == ("a table", "input file", "voltage that is left on the shaft")


def test_a_report_says_what_a_ring_leaves_out():
    topics = [[limit.topic for limit in limits_of(one)] for one in (driven(1500), small_drive(**{RING: 1.0}))]
    assert all("grounding ring" in found for found in topics)
    assert "grounding ring" not in [limit.topic for limit in limits_of(small_drive())]


def test_the_netlist_has_the_resistance_at_the_speed():
    lines = [*drive_netlist(driven(1500), workers=1).bench("bearings.lib")]
    (line,) = (one for one in lines if one.startswith(".param R_rotor_frame="))
    assert float(line.partition("=")[2].split()[0]) == pytest.approx(0.5 * math.sqrt(10.0), rel=1e-8)
    assert "* grounding ring: 1.581 Ohm at 1500 rpm, from its table over the speed" in lines
    constant = [*drive_netlist(small_drive(**{RING: "2 ohm"}), workers=1).bench("bearings.lib")]
    assert not [one for one in constant if "grounding ring:" in one]


# Many speeds.


@pytest.mark.slow
def test_each_point_of_a_sweep_has_its_own_resistance(tmp_path):
    """And the numbers of a single drive with this resistance."""
    speeds = ["1500 rpm", "3000 rpm", "12000 rpm"]
    quick = {"drive.duration": "1 ms", "bearings.discharge.dielectric_strength": "190 V/um"}
    sweep = Sweep.from_dict({"case": driven(3000, **quick), "vary": {"drive.speed": speeds}})
    results = run_sweep(sweep, tmp_path / "out", workers=1)
    ohms = [0.5 * math.sqrt(10.0), 5.0, 50.0]
    assert results.values(RING) == pytest.approx(ohms, rel=1e-12)
    assert ["ring-table-exceeded" in point.summary["warning_codes"] for point in results.points] == [
        False,
        False,
        True,
    ]
    for speed, ohm, peak in zip(speeds, ohms, results.values("drive_end.peak_voltage"), strict=True):
        alone = solve_drive(small_drive(**quick, **{"drive.speed": speed, RING: ohm}), workers=1)
        assert peak == pytest.approx(alone.summary()["drive_end"]["peak_voltage"], rel=1e-9)


def test_each_row_of_a_duty_cycle_has_its_own_resistance(tmp_path):
    """A note has the share of time beyond the table; at a standstill there is no edge to lead away."""
    rpm = [0.0, 6000.0, 6000.0, 12000.0, -12000.0, 6000.0]
    rows = "".join(f"{time},{speed}\n" for time, speed in enumerate(rpm))
    (tmp_path / "cycle.csv").write_text(f"time [s],speed [rpm]\n{rows}")
    seen = {}

    def recorded(case):
        seen[round(case.drive.speed / RPM)] = ring_of(case)
        record = SimpleNamespace(counts=np.ones((2, 1)), sums=np.ones((2, COLUMNS)), duration=1.0)
        return SimpleNamespace(record=record)

    duty = run_drive_cycle(driven(3000, duty={"file": str(tmp_path / "cycle.csv")}), 280.0, recorded)
    assert seen == pytest.approx({6000: 5.0 * 10.0 ** (3.0 / 7.0), 12000: 50.0}, rel=1e-9)
    (note,) = (one for one in duty.warnings if one.code == "ring-table-exceeded")
    assert "0 to 10\xa0000 rpm, for 44.4 % of the time" in str(note), "two of four and a half seconds"


def test_the_example_holds_when_slow_and_not_when_fast():
    sweep = Sweep.from_toml(EXAMPLES / "grounding_brush_speeds.toml")
    case = DriveCase.from_toml(EXAMPLES / "grounding_brush.toml")
    assert sweep.case == case.replace({"remedies": []})
    quick = {"drive.contacts": "formula", "drive.duration": "10 ms"}
    assert ring_of(case) == pytest.approx(20.0 * math.sqrt(10.0), rel=1e-12)
    slow, fast = (
        solve_drive(sweep.case.replace(quick | {"drive.speed": speed}), workers=1).summary()
        for speed in ("1500 rpm", "8000 rpm")
    )
    assert slow["drive"]["events"] == 0
    assert fast["drive"]["events_per_second"] > 1e4
    assert [ring_of(one) for one in case.variants()] == [0.5, 1e9]


# The app.


def test_the_form_has_the_table_of_a_file_until_one_resistance_replaces_it():
    fields = {field.key: field for group in DRIVE_GROUPS for field in group.fields}
    number, ways = fields[RING], fields["circuit.grounding_ring_way"]
    plain = Inputs(small_drive().to_dict())
    table = plain.changed({TABLE: {key: list(values) for key, values in BRUSH.items()}})
    assert [(one.shown(plain), one.shown(table)) for one in (number, ways)] == [(True, False), (False, True)]
    assert ways.alternative(table) == 0
    one = changed(table, ways.alternatives[1].changes)
    assert one.value(TABLE) is None
    assert (one.value(RING), ways.alternative(one), number.shown(one)) == ("1 ohm", 1, True)
    assert changed(table, PRESETS["Grounding ring"]) == one


# What is refused.


@each("table, message", [
    ({"speed": ["3000 rpm", "0 rpm"], "resistance": ["1 ohm", "2 ohm"]}, r"\.speed: .* increasing values"),
    ({"speed": ["0 rpm", "0 rpm"], "resistance": ["1 ohm", "2 ohm"]}, r"\.speed: .* increasing values"),
    ({"speed": ["-1 rpm", "1 rpm"], "resistance": ["1 ohm", "2 ohm"]}, r"\.speed: got '-1 rpm'"),
    ({"speed": [0, 3000], "resistance": ["1 ohm", "2 ohm"]}, r"\.speed: got 0; .* '0 rpm'"),
    ({"speed": SPEEDS, "resistance": ["0 ohm", "1 ohm", "2 ohm"]}, r"\.resistance: got '0 ohm'; .* above 0"),
    ({"speed": SPEEDS, "resistance": ["1 ohm", "2 ohm"]}, r"\.resistance: got 2 values over 3 of speed"),
    ({"speed": SPEEDS, "resistance": ["1 V", "1 V", "2 V"]}, r"\.resistance: got '1 V'"),
    ({"speed": SPEEDS}, r"\.resistance: missing"),
    ({"speeds": SPEEDS, "resistance": OHMS}, r"\.speeds: unknown key"),
])  # fmt: skip
def test_a_wrong_table_is_refused_with_its_key(table, message):
    with pytest.raises(InputError, match=rf"^circuit\.grounding_ring_table{message}"):
        small_drive(**{TABLE: table})


def test_a_table_beside_one_resistance_is_refused():
    table = driven(3000).to_dict()
    table["circuit"]["grounding_ring_resistance"] = 1.0
    with pytest.raises(InputError, match=rf"^{RING}: .*grounding_ring_table together"):
        DriveCase.from_dict(table)
