"""Files of calibrated cases: lines of the user with their units and comments, and updated values."""

from __future__ import annotations

import pytest
from tests.helpers.places import EXAMPLES

from ehlectric import BearingCase, DriveCase
from ehlectric.calibration.calibrated_files import kept_text

TEXT = """\
title = "Pump"            # a title
contacts = "atlas"

[bearing]
base = "6208"
radial_clearance = "10 um"
# measured at the shaft
radial_load = "500 N"   # belt
inner_speed = "3000 rpm"
temperature = "60 degC"
composite_rq = "0.03 um"

[lubricant]
base = "iso-vg-32"

[measured]
# by a bridge
capacitance = "120 pF +- 5 %"

[discharge]
dielectric_strength = "15 V/um +- 20 %"
"""


def _kept(text, changes, ranges, path):
    """Text of the file with changes and ranges, and the case that it gives."""
    path.write_text(text)
    case = BearingCase.from_toml(path)
    updated = case.model_copy(update={"measured": None}).replace(changes, ranges=ranges)
    kept = kept_text(text, case, updated, path)
    assert kept is not None
    path.write_text(kept)
    return kept, BearingCase.from_toml(path)


def test_updated_lines_keep_units_and_comments(tmp_path):
    """A load of 550 N and a temperature of 65 °C, with ranges of both and of the strength."""
    ranges = {
        "bearing.radial_load": ["500 N", "600 N"],
        "bearing.temperature": ["62 degC", "68 degC"],
        "discharge.dielectric_strength": ["12 V/um", "14 V/um"],
    }
    changes = {"bearing.radial_load": 550.0, "bearing.temperature": 338.15}
    kept, case = _kept(TEXT, changes | {"discharge.dielectric_strength": 13e6}, ranges, tmp_path / "a.toml")
    assert 'radial_load = "550 N"   # belt' in kept
    assert "# measured at the shaft" in kept
    assert 'title = "Pump"            # a title' in kept
    assert "measured]" not in kept
    assert "bridge" not in kept
    assert case.measured is None
    assert case.bearing.temperature == pytest.approx(338.15)
    assert {entry.key: (entry.low, entry.high) for entry in case.ranges} == {
        "bearing.radial_load": pytest.approx((500.0, 600.0)),
        "bearing.temperature": pytest.approx((335.15, 341.15)),
        "discharge.dielectric_strength": pytest.approx((12e6, 14e6)),
    }


def test_a_key_that_the_file_lacks_is_below_the_last_line_of_its_table(tmp_path):
    ranges = {"discharge.dielectric_strength": ["12 V/um", "18 V/um"]}
    kept, case = _kept(TEXT, {"bearing.parallel_capacitance": 120e-12}, ranges, tmp_path / "a.toml")
    lines = kept.splitlines()
    place = lines.index('parallel_capacitance = "120 pF"')
    assert lines[place - 1] == 'composite_rq = "0.03 um"'
    assert case.bearing.parallel_capacitance == pytest.approx(120e-12)


def test_the_second_bearing_of_a_drive_equals_the_first_one(tmp_path):
    """The example has no table of the bearing at the non-drive end."""
    path = EXAMPLES / "drive.toml"
    case = DriveCase.from_toml(path)
    changes = {f"{end}.bearing.radial_load": 1700.0 for end in ("drive_end", "non_drive_end")}
    updated = case.replace(changes | {"circuit.winding_rotor_capacitance": 60e-12})
    kept = kept_text(path.read_text(), case, updated, tmp_path / "drive.toml")
    assert "[non_drive_end]" not in [line.strip() for line in kept.splitlines()]
    old, new = path.read_text().splitlines(), kept.splitlines()
    changed = [line.partition("=")[0].strip() for line in new if line not in old]
    assert changed == ["winding_rotor_capacitance", "radial_load"]


def test_a_text_that_cannot_be_changed_line_by_line_is_not_kept(tmp_path):
    """An inline table contains the changed value."""
    path = tmp_path / "a.toml"
    inline = TEXT.replace('[lubricant]\nbase = "iso-vg-32"\n', "")
    capacitances = 'winding_rotor_capacitance = "20 pF", rotor_frame_capacitance = "1 nF"'
    inline = f'motor = {{ common_mode_voltage = "9 V", {capacitances} }}\n{inline}'
    inline = f'lubricant = {{ base = "iso-vg-32" }}\n{inline}'
    path.write_text(inline)
    case = BearingCase.from_toml(path)
    updated = case.model_copy(update={"measured": None}).replace({"motor.common_mode_voltage": 8.0})
    assert kept_text(inline, case, updated, path) is None
