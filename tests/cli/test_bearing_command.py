"""The bearing command as a user types it: what it prints and writes, and how it ends."""

import csv
import json
import math

import pytest

ROLLERS = """\
title = "Rollers"
[bearing]
kind = "cylindrical roller"
elements = 14
element_diameter = "11 mm"
pitch_diameter = "60 mm"
roller_length = "10 mm"
profile = "logarithmic"
radial_clearance = "20 um"
radial_load = "3 kN"
inner_speed = "3000 rpm"
temperature = "70 degC"
composite_rq = "0.03 um"
[lubricant]
base = "paper"
[lubricant.temperature]
kinematic_viscosity_40 = "46 mm^2/s"
kinematic_viscosity_100 = "6.8 mm^2/s"
density_15 = "870 kg/m^3"
[discharge]
dielectric_strength = "15 V/um"
conductivity = "1 pS/m"
[motor]
common_mode_voltage = "300 V"
winding_rotor_capacitance = "20 pF"
rotor_frame_capacitance = "1 nF"
"""


@pytest.fixture
def bearing_file(tmp_path):
    path = tmp_path / "bearing.toml"
    path.write_text(ROLLERS)
    return path


def test_a_bearing(ehlectric, bearing_file, tmp_path):
    done = ehlectric("bearing", bearing_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    for text in ("Rollers", "first break", "through breakdown", "shaft voltage", "lambda", "film factor"):
        assert text in done.stdout
    assert "capacitive alone" in done.stdout
    assert "Traceback" not in done.stderr
    # All warnings are told, and that these voltages are upper bounds.
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert done.stderr.count("warning:") == len(summary["warnings"])
    assert "voltages are upper bounds" in done.stderr
    assert summary["schema"] == "ehlectric.bearing/1"
    assert summary["converged"]
    assert summary["inputs"]["bearing"]["temperature"] == pytest.approx(343.15)
    found = summary["bearing"]
    # Numbers of the table are those of the file, and follow from each other.
    assert f"{found['first_break']:.4g}" in done.stdout
    assert f"{found['capacitance'] * 1e12:.4g}" in done.stdout
    ratio = 20e-12 / (20e-12 + 1e-9 + 2.0 * found["capacitance"])
    assert found["shaft_voltage"] == pytest.approx(300.0 * ratio, rel=1e-12, abs=0.0)
    with (tmp_path / "out" / "contacts.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(summary["contacts"]) == 28
    for row, same in zip(rows, summary["contacts"], strict=True):
        assert row["ring"] == same["ring"]
        assert float(row["capacitance"]) == same["capacitance"]
        # Without load there is no Hertz pressure: an empty field.
        assert (row["max_pressure"] == "") == (same["max_pressure"] is None)
    with (tmp_path / "out" / "impedance.csv").open(newline="", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    # Rollers in oil of 1 pS/m: a resistor of tau/C far below 1/(2 pi tau), a capacitor far above it.
    tau = 2.4 * 8.8541878e-12 / 1e-12
    assert float(lines[0]["frequency"]) < 0.1 / tau
    resistance = float(lines[0]["magnitude"]) * found["capacitance"]
    assert resistance == pytest.approx(tau, rel=1e-3, abs=0.0)
    omega = 2.0 * math.pi * float(lines[-1]["frequency"])
    assert omega * float(lines[-1]["magnitude"]) == pytest.approx(1.0 / found["capacitance"], rel=1e-3)
    assert float(lines[0]["phase_degrees"]) == pytest.approx(0.0, abs=1.0)
    assert float(lines[-1]["phase_degrees"]) == pytest.approx(-90.0, abs=0.1)
    # Closed formulas, g = 11/60: cage at w (1 - g)/2, rollers at w (1 - g^2)/(2 g), d_m w (1 - g^2)/4.
    g, w, speeds = 11.0 / 60.0, 100.0 * math.pi, summary["mechanics"]
    assert speeds["cage_speed"] == pytest.approx(0.5 * w * (1.0 - g), rel=1e-9, abs=0.0)
    assert speeds["element_speed"] == pytest.approx(0.5 * w * (1.0 - g**2) / g, rel=1e-9, abs=0.0)
    for ring in ("inner", "outer"):
        entrainment = 0.06 * w * (1.0 - g**2) / 4.0
        assert speeds[f"entrainment_speed_{ring}"] == pytest.approx(entrainment, rel=1e-9, abs=0.0)


@pytest.mark.slow
def test_json_on_request(ehlectric, bearing_file, tmp_path):
    done = ehlectric("bearing", bearing_file, "-o", "out", "--json", "-q")
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert json.loads(done.stdout) == json.loads((tmp_path / "out" / "summary.json").read_text())


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (
            'radial_clearance = "20 um"',
            'contact_angle = "15 deg"',
            (
                "bearing.radial_clearance: missing; a bearing of kind 'cylindrical roller' needs it: the "
                "clearance in operation, or clearance_class with bore"
            ),
        ),
        (
            "elements = 14",
            "elements = 18",
            (
                "bearing.elements: got 18; expected 3 to 17, the most of 0.011 m that a pitch circle of "
                "0.06 m holds"
            ),
        ),
        (
            "[lubricant]\n",
            '[lubricant]\nviscosity = "0.02 Pa s"\n',
            (
                "lubricant.viscosity: got viscosity and temperature together; expected either viscosity or "
                "[lubricant.temperature]"
            ),
        ),
    ],
)
def test_wrong_files_are_one_line(ehlectric, bearing_file, tmp_path, old, new, line):
    assert old in ROLLERS
    bearing_file.write_text(ROLLERS.replace(old, new))
    done = ehlectric("bearing", bearing_file, "-o", "out")
    assert done.returncode == 2
    assert done.stderr.splitlines() == [f"error: {line}"]
    assert done.stdout == ""
    assert not list(tmp_path.glob("out/*"))


def test_a_missing_file_is_one_line(ehlectric, tmp_path):
    done = ehlectric("bearing", "none.toml", "-o", "out")
    assert done.returncode == 2
    assert done.stderr.splitlines() == ["error: none.toml: cannot be read, no such file or directory"]
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("command", ["run", "check"])
def test_a_bearing_is_not_taken_for_a_contact(ehlectric, bearing_file, command):
    """The line names the command that takes it, as that one does for the file of a contact."""
    done = ehlectric(command, bearing_file)
    assert done.returncode == 2
    line = "is the file of a bearing; expected that of a contact; ehlectric bearing solves it"
    assert done.stderr.splitlines() == [f"error: {bearing_file}: {line}"]


def test_a_contact_is_not_taken_for_a_bearing(ehlectric, case_file):
    done = ehlectric("bearing", case_file)
    assert done.returncode == 2
    assert done.stderr.splitlines() == [
        f"error: {case_file}: is the file of a contact; expected that of a bearing; ehlectric run solves it"
    ]


@pytest.mark.slow
def test_not_converged(ehlectric, bearing_file, tmp_path):
    """One Newton step is not enough: status 3, and everything is written all the same."""
    bearing_file.write_text(ROLLERS + "[solver]\nmax_iterations = 1\n")
    done = ehlectric("bearing", bearing_file, "-o", "out", "-q")
    assert done.returncode == 3, done.stderr
    assert done.stderr.splitlines() == ["error: not converged: a contact of the bearing"]
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert not summary["converged"]
    assert (tmp_path / "out" / "contacts.csv").exists()
