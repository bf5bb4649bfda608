"""Numbers whose separator may be that of thousands are asked about, with both readings."""

import subprocess
import sys
import tomllib

import pytest

from ehlectric import BearingCase, Case, InputError, example
from ehlectric.cases.amounts import amount_at
from ehlectric.cases.measurements import CYCLE, MEASURED
from ehlectric.quantities.grouped_digits import doubt_of_column
from ehlectric.quantities.inputs import inputs
from tests.helpers.each import each


@each(
    "key, text, first, second",
    [
        ("bearing.inner_speed", "3.000 rpm", "3 rpm", "3000 rpm"),
        ("bearing.inner_speed", "1.485 min^-1", "1.4850 min^-1", "1485 min^-1"),
        ("bearing.inner_speed", "12.500 r/min", "12.5 r/min", "12500 r/min"),
        ("drive.speed", "6.000 1/min", "6 1/min", "6000 1/min"),
        ("bearing.radial_load", "1.800 N", "1.8 N", "1800 N"),
        ("contact.load", "1.234 N", "1.2340 N", "1234 N"),
        ("contact.load_per_length", "300.000 N/m", "300 N/m", "300000 N/m"),
        ("motor.common_mode_voltage", "0.500 V", "", ""),
        ("motor.common_mode_voltage", "1.000 V", "1 V", "1000 V"),
        ("motor.common_mode_voltage", "12.500 V", "", ""),
        ("source.dc_link", "1.000 V", "1 V", "1000 V"),
        ("bearing.radial_load", "2.500 lbf", "2.5 lbf", "2500 lbf"),
        ("bearing.radial_load", "1.500 kgf", "1.5 kgf", "1500 kgf"),
        ("motor.switching_frequency", "8.000 Hz", "8 Hz", "8000 Hz"),
        ("lubricant.temperature.density_15", "1.050 kg/m^3", "1.05 kg/m^3", "1050 kg/m^3"),
        ("contact.max_hertz_pressure", "1.200 MPa", "1.2 MPa", "1200 MPa"),
        ("bearing.radial_load", "0.030 N", "", ""),
        ("bearing.composite_rq", "0.030 um", "", ""),
        ("bearing.composite_rq", "1.030 um", "", ""),
        ("bearing.element_diameter", "11.906 mm", "", ""),
        ("bearing.bore", "40.000 mm", "", ""),
        ("contact.reduced_modulus", "226.000 GPa", "", ""),
        ("contact.entrainment_speed", "2.500 m/s", "", ""),
        ("contact.body_1.thermal_conductivity", "0.137 W/m/K", "", ""),
        ("source.fundamental_frequency", "50.000 Hz", "", ""),
        ("bearing.temperature", "70.000 degC", "", ""),
        ("bearing.radial_load", "1.800e3 N", "", ""),
        ("lubricant.temperature.kinematic_viscosity_40", "46.125 mm^2/s", "", ""),
        ("bearing.inner_speed", "3000.000 rpm", "", ""),
        ("bearing.inner_speed", "3.0000 rpm", "", ""),
        ("bearing.life.dynamic_rating", "32.500 kN", "", ""),
    ],
)
def test_both_readings_are_named_or_none(key, text, first, second):
    """A decimal reading is in doubt if it is unusual for the quantity, and 1000 times as much is usual."""
    number = float(text.split()[0])
    if not first:
        assert amount_at(key).parse(text) == pytest.approx(
            amount_at(key).parse(f"{number!r}0 {text.split()[1]}")
        )
        return
    with pytest.raises(InputError) as refused:
        amount_at(key).parse(text)
    assert f"'{first}' or '{second}'" in str(refused.value)
    unit = text.split(maxsplit=1)[1]
    assert amount_at(key).parse(second) == pytest.approx(1e3 * number * amount_at(key).factor(unit))


def test_both_readings_of_a_comma_are_named():
    with pytest.raises(InputError, match="write 3 rpm, or 3000 rpm"):
        amount_at("bearing.inner_speed").parse("3,000 rpm")


def test_a_load_in_kilonewtons_is_taken_with_a_word():
    """1.8 MN are the load of large bearings, and 25 MN of none."""
    with pytest.warns(UserWarning, match=r"'1\.800 kN' is read as 1\.8 kN, not as 1800 kN"):
        assert amount_at("bearing.radial_load").parse("1.800 kN") == 1800.0
    assert amount_at("bearing.radial_load").parse("25.000 kN") == 25000.0


def test_files_and_python_ask_in_one_way(tmp_path):
    text = example("bearing_6208").read_text(encoding="utf-8")
    speed = tomllib.loads(text)["bearing"]["inner_speed"]
    file = tmp_path / "bearing.toml"
    file.write_text(text.replace(speed, "3.000 rpm"), encoding="utf-8")
    with pytest.raises(InputError, match=r"^bearing\.inner_speed: .*'3 rpm' or '3000 rpm'"):
        BearingCase.from_toml(file)
    with pytest.raises(InputError, match=r"^contact\.load: .*'20 N' or '20000 N'"):
        Case.point(
            radius_x=0.01, radius_y=0.01, reduced_modulus=2e11, load="20.000 N", entrainment_speed=1.0,
            lubricant="paper",
        )  # fmt: skip


def test_what_the_program_writes_is_certain():
    """Numbers with three decimals are read back, as a speed in a file and the ends of a range."""
    table = tomllib.loads(example("bearing_6208").read_text(encoding="utf-8"))
    table["bearing"] |= {"inner_speed": "314.125 rad/s", "radial_load": "500.25 N +- 0.125 N"}
    case = BearingCase.from_dict(table)
    assert BearingCase.from_dict(tomllib.loads(case.to_toml())) == case
    assert case.ranges is not None
    slow = case.replace({"bearing.inner_speed": 1.125})
    assert BearingCase.from_dict(tomllib.loads(slow.to_toml())) == slow


@each(
    "name, unit, cells, doubtful",
    [
        ("speed", "rpm", ["1.500", "3.000", "950"], True),
        ("speed", "rpm", ["1,500", "3,000"], True),
        ("speed", "rpm", ["1.500", "3.000", "0.125"], False),
        ("speed", "rpm", ["1500.000", "3.000"], False),
        ("speed", "rpm", ["450.125", "612.500"], False),
        ("radial_load", "N", ["1.800", "2.400"], True),
        ("radial_load", "kN", ["1.800", "2.400"], False),
    ],
)
def test_columns(name, unit, cells, doubtful):
    """Columns of three decimals are usual: only one that is too low for machines is in doubt."""
    factor = {"rpm": 0.10472, "N": 1.0, "kN": 1e3}[unit]
    found = doubt_of_column(cells, CYCLE.columns[name], factor)
    assert (found is not None) == doubtful
    if name in MEASURED.columns:
        assert doubt_of_column(cells, MEASURED.columns[name], factor) == found


def test_typical_values_lie_within_the_bounds():
    for table in inputs().values():
        for entry in table.values():
            if entry.typical is not None:
                low, high = entry.typical
                assert 0.0 <= low < high


@pytest.mark.slow
def test_the_command_asks(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "ehlectric", "film", "--oil", "fva-3", "--temperature", "40 degC", "--radius",
         "10 mm", "--modulus", "226 GPa", "--load", "300.000 N/m", "--speed", "2 m/s"],
        capture_output=True, text=True, check=False, cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 2
    assert "'300 N/m' or '300000 N/m'" in done.stderr
