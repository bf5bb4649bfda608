"""The bearing command as a user types it: what it prints and writes, and how it ends."""

import csv
import json
import math
import re

import pytest

from ehlectric import load
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

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
film_factor = "none"
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


def by_formula(text):
    """The file with contacts by formula."""
    return 'contacts = "formula"\n' + text


@pytest.mark.slow
def test_a_bearing_that_breaks_down_says_so_last(ehlectric, bearing_file, tmp_path):
    """A margin below one is a warning, and the last lines are the answer."""
    bearing_file.write_text(by_formula(ROLLERS.replace("15 V/um", "1 V/um")))
    done = ehlectric("bearing", bearing_file, "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    lines = load(tmp_path / "out" / "bearing.nc").verdict.lines()
    shown = [" ".join(line) for line in lines]
    assert [" ".join(line.split()) for line in done.stdout.splitlines()[-len(shown) :]] == [
        " ".join(line.split()) for line in shown
    ]
    assert shown[0].startswith(" Breakdown expected even in an ideal film at ")
    assert summary["verdict"].startswith("Breakdown expected: shaft voltage ")
    assert summary["verdict_level"] == "red"
    assert summary["margin"]["level"] == "red"
    assert "breakdown-expected" in summary["warning_codes"]
    assert "warning: the margin is below 1: shaft voltage " in done.stderr
    margin = summary["bearing"]["margin"]
    assert f"margin (first breakdown / shaft voltage) ≤ {margin:.4g}" in " ".join(done.stdout.split())
    # Every input whose effect is in the file has a row with its range in printed units.
    assert "dielectric strength, 0.8 to 1.2 V/µm" in done.stdout
    assert "temperature of the oil, 60 to 80 °C" in done.stdout
    assert len(summary["margin"]["effects"]) == 6
    again = ehlectric("bearing", bearing_file, "-o", "out", "--no-plots", "--json")
    assert json.loads(again.stdout)["verdict"] == summary["verdict"]


@pytest.mark.slow
def test_a_bearing_without_a_strength_says_so(ehlectric, bearing_file):
    bearing_file.write_text(by_formula(ROLLERS.replace('dielectric_strength = "15 V/um"\n', "")))
    done = ehlectric("bearing", bearing_file, "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    assert "dielectric strength not given, no breakdown voltage is computed" in " ".join(done.stdout.split())
    assert "  why          no dielectric strength given, no breakdown voltage" in done.stdout.splitlines()[-1]


@pytest.mark.slow
def test_a_speed_in_rad_per_second_is_seen_at_once(ehlectric, bearing_file):
    """The table has the speed in rpm, whatever the title says."""
    text = ROLLERS.replace('"Rollers"', '"3000 rpm"').replace(
        '"3000 rpm"\ntemperature', '"3000 rad/s"\ntemperature'
    )
    bearing_file.write_text(by_formula(text))
    done = ehlectric("bearing", bearing_file, "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    assert "speed of the inner ring 28 650 rpm" in " ".join(done.stdout.split())
    assert " at 28\xa0650 rpm, 70 °C\n  " in done.stdout


@pytest.mark.slow
@pytest.mark.gate
def test_a_bearing(ehlectric, bearing_file, tmp_path):
    done = ehlectric("bearing", bearing_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    for text in (
        "Rollers",
        "first breakdown",
        "ring-to-ring breakdown",
        "shaft voltage",
        "lambda",
        "film factor",
    ):
        assert text in done.stdout
    # The inputs that decide stand at the head of the totals, in the units of a catalogue.
    for line in ("speed of the inner ring 3000 rpm", "radial load 3000 N", "temperature of the oil 70 °C"):
        assert line in " ".join(done.stdout.split())
    assert "Traceback" not in done.stderr
    # All warnings are told, and that these voltages are upper bounds.
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert len(re.findall("^(?:warning|note): ", done.stderr, re.M)) == len(summary["warnings"])
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
        assert float(row["capacitance [F]"]) == same["capacitance"]
        # Without load there is no Hertz pressure: an empty field.
        assert (row["max_pressure [Pa]"] == "") == (same["max_pressure"] is None)
    with (tmp_path / "out" / "impedance.csv").open(newline="", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    # Rollers in oil of 1 pS/m: a resistor of tau/C far below 1/(2 pi tau), a capacitor far above it.
    tau = 2.4 * 8.8541878e-12 / 1e-12
    assert float(lines[0]["frequency [Hz]"]) < 0.1 / tau
    resistance = float(lines[0]["magnitude [ohm]"]) * found["capacitance"]
    assert resistance == pytest.approx(tau, rel=1e-3, abs=0.0)
    omega = 2.0 * math.pi * float(lines[-1]["frequency [Hz]"])
    assert omega * float(lines[-1]["magnitude [ohm]"]) == pytest.approx(1.0 / found["capacitance"], rel=1e-3)
    assert float(lines[0]["phase_degrees [deg]"]) == pytest.approx(0.0, abs=1.0)
    assert float(lines[-1]["phase_degrees [deg]"]) == pytest.approx(-90.0, abs=0.1)
    # Closed formulas, g = 11/60: cage at w (1 - g)/2, rollers at w (1 - g^2)/(2 g), d_m w (1 - g^2)/4.
    g, w, speeds = 11.0 / 60.0, 100.0 * math.pi, summary["mechanics"]
    assert speeds["cage_speed"] == pytest.approx(0.5 * w * (1.0 - g), rel=1e-9, abs=0.0)
    assert speeds["element_speed"] == pytest.approx(0.5 * w * (1.0 - g**2) / g, rel=1e-9, abs=0.0)
    for ring in ("inner", "outer"):
        entrainment = 0.06 * w * (1.0 - g**2) / 4.0
        assert speeds[f"entrainment_speed_{ring}"] == pytest.approx(entrainment, rel=1e-9, abs=0.0)


@pytest.mark.slow
def test_a_peak_current_next_to_a_motor(ehlectric, bearing_file, tmp_path):
    """The published limits of the current density are a list, which the curves over the speed contain."""
    bearing_file.write_text(by_formula(ROLLERS.replace("[discharge]", '[discharge]\npeak_current = "1 A"')))
    for command in (("bearing", bearing_file, "-o", "out"), ("plot", "out"), ("report", "out")):
        done = ehlectric(*command)
        assert done.returncode == 0, done.stderr
        assert "Traceback" not in done.stderr
    found = json.loads((tmp_path / "out" / "summary.json").read_text())["bearing"]
    assert found["current_density_limits"] == [1e5, 3e5, 8e5]
    for name in ("capacitance_over_speed.png", "breakdown_over_speed.png", "report.html"):
        assert (tmp_path / "out" / name).exists()


@pytest.mark.slow
def test_json_on_request(ehlectric, bearing_file, tmp_path):
    done = ehlectric("bearing", bearing_file, "-o", "out", "--json", "-q")
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert json.loads(done.stdout) == json.loads((tmp_path / "out" / "summary.json").read_text())


@each(
    "old, new, key, names",
    [
        (
            'radial_clearance = "20 um"',
            'contact_angle = "15 deg"',
            "bearing.radial_clearance",
            ["missing", "clearance_class", "[bearing.fits]"],
        ),
        ("elements = 14", "elements = 18", "bearing.elements", ["18", "3 to 17", "0.011 m", "0.06 m"]),
        (
            "[lubricant]\n",
            '[lubricant]\nviscosity = "0.02 Pa s"\n',
            "lubricant.viscosity",
            ["temperature", "atmospheric_law"],
        ),
    ],
)
def test_wrong_files_are_one_line(typed, bearing_file, tmp_path, old, new, key, names):
    assert old in ROLLERS
    bearing_file.write_text(ROLLERS.replace(old, new))
    done = typed("bearing", bearing_file, "-o", "out")
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert done.stderr.startswith(f"error: {key}: ")
    assert [name for name in names if name not in done.stderr] == []
    assert not list(tmp_path.glob("out/*"))


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
    done = ehlectric("report", "out", "--format", "html", "-q")
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert '<tr class="alarm"><th scope="row">NOT CONVERGED</th>' in page


@pytest.mark.slow
def test_a_load_with_two_readings_warns_in_one_line(ehlectric, tmp_path):
    text = (EXAMPLES / "bearing_6208.toml").read_text("utf-8").replace('"1800 N"', '"1.800 kN"')
    (tmp_path / "bearing.toml").write_text(text, "utf-8")
    lines = ehlectric("check", "bearing.toml").stderr.splitlines()
    assert [line for line in lines if "1.800 kN" in line] == [
        "warning: '1.800 kN' is read as 1.8 kN, not as 1800 kN"
    ]
    assert not any(".py" in line for line in lines)


def test_a_designation_is_printed_and_written_as_typed(ehlectric, tmp_path):
    """The ratings of the library are those of NSK, and the bearing is one of SKF."""
    (tmp_path / "typed.toml").write_text(
        'contacts = "formula"\n[bearing]\nbase = "skf  6208-2rs1/c3"\nradial_load = "1 kN"\n'
        'inner_speed = "3000 rpm"\ntemperature = "70 degC"\ncomposite_rq = "0.03 um"\n'
        '[bearing.life]\ncontamination_factor = 0.5\n[lubricant]\nbase = "fva-3"\n'
    )
    for command in (("check", "typed.toml"), ("bearing", "typed.toml", "-o", "out", "--no-plots")):
        done = ehlectric(*command)
        assert done.returncode == 0
        assert "SKF 6208-2RS1/C3" in done.stdout
        assert "catalogue of NSK, but the bearing is from SKF" in " ".join(done.stderr.split())
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["inputs"]["bearing"]["base"] == "6208"
    assert summary["inputs"]["bearing"]["designation"] == "SKF 6208-2RS1/C3"
