"""Drive files: what they take, what they refuse, and how they change."""

import pytest

from ehlectric import InputError
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.drive_inputs import Circuit
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

TABLE = {
    "source": {
        "dc_link": "560 V",
        "modulation": "sinusoidal",
        "switching_frequency": "10 kHz",
        "fundamental_frequency": "50 Hz",
        "modulation_index": 0.8,
        "rise_time": "100 ns",
    },
    "circuit": {"winding_rotor_capacitance": "50 pF", "rotor_frame_capacitance": "500 pF"},
    "breakdown": {"arc_resistance": 10.0, "extinction_current": "10 mA", "recovery_time": "100 ns"},
}
FILE = """\
[drive]
speed = "1500 rpm"
[source]
dc_link = "560 V"
modulation = "sinusoidal"
switching_frequency = "10 kHz"
fundamental_frequency = "50 Hz"
modulation_index = 0.8
rise_time = "100 ns"
[circuit]
winding_rotor_capacitance = "50 pF"
rotor_frame_capacitance = "500 pF"
[breakdown]
arc_resistance = "10 ohm"
extinction_current = "10 mA"
recovery_time = "100 ns"
[drive_end]
file = "bearing.toml"
bearing.radial_load = "1 kN"
"""


@pytest.fixture
def file(tmp_path):
    (tmp_path / "bearing.toml").write_text((EXAMPLES / "bearing_6208.toml").read_text("utf-8"), "utf-8")
    (tmp_path / "drive.toml").write_text(FILE)
    return tmp_path / "drive.toml"


def test_a_file_names_its_bearing_and_changes_it(file):
    case = DriveCase.from_toml(file)
    first, second = case.bearings
    assert first == second
    assert first.bearing.radial_load == 1000.0
    assert first.bearing.inner_speed == pytest.approx(157.07963)
    assert case.drive_end.bearing.inner_speed == pytest.approx(314.15927)
    assert case.breakdown.lowest_voltage == pytest.approx(0.1)


def test_a_case_is_written_and_read_back(file, tmp_path):
    case = DriveCase.from_toml(file)
    (tmp_path / "again.toml").write_text(case.to_toml(), "utf-8")
    assert DriveCase.from_toml(tmp_path / "again.toml") == case
    assert DriveCase.from_dict(case.to_dict()) == case


def test_changes_of_one_end_and_of_both(file):
    case = DriveCase.from_toml(file)
    one = case.replace({"non_drive_end.bearing.radial_load": "500 N", "drive.seed": 3})
    assert [end.bearing.radial_load for end in one.bearings] == [1000.0, 500.0]
    assert one.drive.seed == 3
    both = case.replace({"bearings.bearing.radial_load": "700 N"})
    assert [end.bearing.radial_load for end in both.bearings] == [700.0, 700.0]
    assert case.replace({"breakdown.extinction_voltage": "1 V"}).breakdown.extinction_current is None


@each(
    "speed, base, frequency, index",
    [
        ("1500 rpm", None, 50.0, 0.8),
        ("3000 rpm", None, 100.0, 0.8),
        ("750 rpm", "100 Hz", 25.0, 0.2),
        ("3000 rpm", "100 Hz", 100.0, 0.8),
        ("6000 rpm", "100 Hz", 200.0, 0.8),
    ],
)
def test_frequency_and_index_follow_the_speed(file, speed, base, frequency, index):
    """Two pairs of poles: two periods in a turn of the rotor; a constant flux up to the base frequency."""
    changes = {"source.pole_pairs": 2, "drive.speed": speed}
    case = DriveCase.from_toml(file).replace(changes | ({"source.base_frequency": base} if base else {}))
    assert case.source.fundamental_frequency is None
    running = case.running_source
    assert running.fundamental_frequency == pytest.approx(frequency, rel=1e-12)
    assert running.modulation_index == pytest.approx(index, rel=1e-12)
    assert (
        running
        == case.replace({"source.fundamental_frequency": running.fundamental_frequency}).running_source
    )
    assert DriveCase.from_dict(case.to_dict()) == case


def test_a_frequency_that_follows_the_speed_is_not_that_of_its_rounding(file):
    """50 Hz are 50 Hz at 1500 rpm, so that periods of the carrier are whole ones."""
    case = DriveCase.from_toml(file).replace({"source.pole_pairs": 2})
    assert case.running_source.fundamental_frequency == 50.0


def test_the_motor_of_a_bearing_file_is_left_out(file):
    """Its common-mode voltage belongs to another estimate; the drive has its own."""
    plain = DriveCase.from_toml(file)
    case = plain.replace(
        {
            "bearings.motor.common_mode_voltage": "300 V",
            "bearings.motor.winding_rotor_capacitance": "1 nF",
            "bearings.motor.rotor_frame_capacitance": "1 nF",
        }
    )
    assert case.drive_end.motor is not None
    assert case.bearings == plain.bearings


def test_without_a_speed_of_the_drive_the_source_follows_that_of_the_drive_end(file):
    file.write_text(FILE.replace('speed = "1500 rpm"\n', ""))
    case = DriveCase.from_toml(file).replace(
        {"source.pole_pairs": 3, "drive_end.bearing.inner_speed": "600 rpm"}
    )
    assert case.running_source.fundamental_frequency == pytest.approx(30.0, rel=1e-12)


def test_a_missing_bearing_file_is_told_with_its_table(file):
    (file.parent / "bearing.toml").unlink()
    with pytest.raises(InputError, match="drive_end"):
        DriveCase.from_toml(file)


MACHINE = {
    "stack_length": "120 mm", "bore_diameter": "110 mm", "air_gap": "0.5 mm", "slots": 36,
    "slot_opening": "3 mm", "copper_depth": "2 mm", "slot_permittivity": 2, "liner_width": "50 mm",
    "liner_thickness": "0.3 mm", "liner_permittivity": 3.5,
}  # fmt: skip


def test_capacitances_that_are_not_given_are_those_of_the_geometry():
    whole = Circuit.from_dict({"machine": MACHINE})
    assert whole.estimated == tuple(whole.capacitances)
    assert len(whole.estimated) == 3
    some = Circuit.from_dict({"machine": MACHINE, "winding_rotor_capacitance": "40 pF"})
    assert some.capacitances == whole.capacitances | {"winding_rotor_capacitance": 40e-12}
    assert some.estimated == ("rotor_frame_capacitance", "winding_frame_capacitance")
