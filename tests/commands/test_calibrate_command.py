"""The command calibrate as a user types it."""

import json
import shutil
import tomllib

import pytest

from tests.helpers.places import EXAMPLES

CASE = "bearing_measured.toml"


@pytest.fixture
def case_file(tmp_path):
    """Example in a folder, with its measurement."""
    shutil.copytree(EXAMPLES / "measurements", tmp_path / "measurements")
    shutil.copy(EXAMPLES / CASE, tmp_path)
    return tmp_path / CASE


@pytest.mark.slow
@pytest.mark.gate
def test_the_example_is_calibrated_and_its_file_is_a_case(ehlectric, case_file):
    """The true values of the synthetic measurement lie in the updated ranges."""
    done = ehlectric("calibrate", case_file.name, "-o", "out")
    out = case_file.parent / "out"
    names = {path.name for path in out.iterdir() if not path.name.startswith(".")}
    assert names == {"summary.json", "compared.csv", "calibrated.toml", "calibration.png"}
    summary = json.loads((out / "summary.json").read_text())
    assert summary["explained"]
    assert "temperature" in done.stdout
    inputs = {entry["key"]: entry for entry in summary["inputs"]}
    for key, true in {"bearing.temperature": 348.15, "motor.winding_rotor_capacitance": 24e-12}.items():
        low, _, high = inputs[key]["posterior"]
        assert low < true < high
        assert inputs[key]["reduction"] > 0.3
    check = ehlectric("check", "out/calibrated.toml")
    assert "3000 rpm" in check.stdout
    assert len((out / "compared.csv").read_text().splitlines()) == 1 + 2 + 4 + 3


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["bearing", "drive"])
def test_the_calibrated_file_is_taken_by_other_commands(typed, case_file, kind):
    """The file has another winding-rotor capacitance and no measured values."""
    folder = case_file.parent
    name, table, speed = CASE, "motor", "bearing.inner_speed"
    if kind == "drive":
        name, table, speed = "drive.toml", "circuit", "drive.speed"
        text = (EXAMPLES / name).read_text().replace('duration = "0.2 s"', 'duration = "0.01 s"')
        text = text[: text.index("[[remedies]]")] if "[[remedies]]" in text else text
        (folder / name).write_text(f'{text}\n[measured]\nshaft_voltage = "30 V +- 5 %"\n')
    assert typed("calibrate", name, "-o", "out", "--no-plots", "-q").returncode == 0
    original = tomllib.loads((folder / name).read_text())
    case = tomllib.loads((folder / "out" / "calibrated.toml").read_text())
    assert "measured" not in case
    assert typed("check", "out/calibrated.toml").returncode == 0
    assert typed(kind, "out/calibrated.toml", "-o", "solved", "--no-plots", "-q").returncode == 0
    assert case[table]["winding_rotor_capacitance"] != original[table]["winding_rotor_capacitance"]
    vary = f'[vary]\n"{speed}" = ["2000 rpm", "3000 rpm"]\n'
    (folder / "sweep.toml").write_text(f'case = "out/calibrated.toml"\n{vary}')
    swept = typed("sweep", "sweep.toml", "-o", "swept", "--workers", "1", "-q")
    assert swept.returncode == 0, swept.stderr
    assert len((folder / "swept" / "sweep.csv").read_text().splitlines()) >= 3


@pytest.mark.slow
def test_a_measurement_beyond_the_ranges_is_reported(ehlectric, case_file):
    text = case_file.read_text().replace('file = "measurements/bearing_6208_points.csv"\n', "")
    case_file.write_text(text.replace("2.9 V +- 0.2 V", "29 V +- 0.2 V"))
    done = ehlectric("calibrate", case_file.name, "-o", "out", "--no-plots")
    assert done.returncode == 3
    assert "not explained" in done.stdout
    summary = json.loads((case_file.parent / "out" / "summary.json").read_text())
    # Ten times the value of the example is explained by a probe.
    causes = {cause["key"]: cause for cause in summary["unexplained"]["causes"]}
    assert causes["first_breakdown_voltage"]["needed"] == 10.0
    assert "cause" in done.stdout
    assert not (case_file.parent / "out" / "calibrated.toml").exists()


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("2.9 V +- 0.2 V", "2.9 V", "measured.first_breakdown_voltage"),
        ("2.9 V +- 0.2 V", "2.9 pF +- 0.2 pF", "measured.first_breakdown_voltage"),
        ("74 degC +- 2 K", "74 degC +- 0 K", "measured.outer_ring_temperature"),
        ("bearing_6208_points", "missing", "missing.csv"),
        ("first_breakdown_voltage =", "discharge_rate = '3 1/s +- 1 1/s' #", "measured.discharge_rate"),
        ("first_breakdown_voltage =", "breakdown = ", "measured.breakdown"),
    ],
)
def test_a_wrong_measurement_is_refused(typed, case_file, old, new, named):
    case_file.write_text(case_file.read_text().replace(old, new))
    done = typed("calibrate", case_file.name)
    assert done.returncode == 2
    assert named in done.stderr


@pytest.mark.parametrize(
    ("head", "named"),
    [
        ("speed [rpm],capacitance [pF]", "uncertainty of capacitance"),
        ("speed [rpm],remark", "measured quantity"),
        ("speed [V],capacitance [pF]", "speed [V]"),
    ],
)
def test_a_wrong_file_of_points_is_refused(typed, case_file, head, named):
    (case_file.parent / "points.csv").write_text(f"{head}\n3000,250\n")
    done = typed("calibrate", case_file.name, "--measured", "points.csv")
    assert done.returncode == 2
    assert named in done.stderr


def test_a_case_without_a_measurement_is_refused(typed, case_file):
    text = case_file.read_text()
    case_file.write_text(text[: text.index("[measured]")])
    done = typed("calibrate", case_file.name)
    assert done.returncode == 2
    assert "measured: missing" in done.stderr


@pytest.mark.parametrize(
    ("options", "named"),
    [
        (("--background", "400 pF"), "above the background"),
        (("--background", "12 V"), "background"),
        (("--uncertainty", "300 %"), "uncertainty"),
    ],
)
def test_a_wrong_option_is_refused(typed, case_file, options, named):
    done = typed("calibrate", case_file.name, *options)
    assert done.returncode == 2
    assert named in done.stderr


@pytest.mark.slow
def test_a_record_of_the_shaft_voltage_is_counted_and_explained(ehlectric, case_file):
    """The record was simulated with 36 discharges, a divider of 0.04035, 40 V/um and 44 pF."""
    shutil.copy(EXAMPLES / "drive_scope.toml", case_file.parent)
    done = ehlectric("calibrate", "drive_scope.toml", "-o", "out", "--no-plots")
    assert "36 discharges in 200 µs" in done.stderr
    summary = json.loads((case_file.parent / "out" / "summary.json").read_text("utf-8"))
    assert summary["explained"]
    measured = {row["quantity"]: row for row in summary["measured"]}
    ratio = measured["bearing_voltage_ratio"]
    assert abs(ratio["measured"] - 0.040346) < 2.0 * ratio["uncertainty"]
    assert measured["discharge_rate"]["measured"] == pytest.approx(36 / 200e-6, rel=1e-3)
    # The page shaft_record.md states about 30 to 80 V/um, and 33 to 54 pF.
    for end, true, ends in (
        ("dielectric_strength", 40e6, (30e6, 80e6)),
        ("winding_rotor_capacitance", 44e-12, (33e-12, 54e-12)),
    ):
        (entry,) = (entry for entry in summary["inputs"] if entry["key"].endswith(end))
        low, _, high = entry["posterior"]
        assert low < true < high
        assert (low, high) == pytest.approx(ends, rel=0.2)


def test_a_record_in_a_case_of_another_kind_is_refused(typed, case_file):
    text = (EXAMPLES / "gear_spur.toml").read_text("utf-8")
    record = '[measured]\nshaft_record = { file = "measurements/shaft_voltage.csv", column = "CH2" }\n'
    (case_file.parent / "gear.toml").write_text(f"{text}\n{record}", "utf-8")
    done = typed("calibrate", "gear.toml", "-o", "out")
    assert done.returncode == 2
    assert "measured.shaft_record" in done.stderr
