"""Mistakes at the command line, by the numbers of their table: each is answered with what to do."""

import json
import shutil

import numpy as np
import pytest

from ehlectric import Case
from tests.commands.conftest import CASE
from tests.helpers.places import EXAMPLES

BEARING = """\
title = "Small bearing"
contacts = "formula"
[bearing]
base = "6208"
radial_clearance = "10 um"
radial_load = "1 kN"
inner_speed = "3000 rpm"
temperature = "70 degC"
composite_rq = "0.03 um"
[lubricant]
base = "paper"
viscosity = "20 mPa s"
[discharge]
dielectric_strength = "15 V/um"
[motor]
common_mode_voltage = "300 V"
winding_rotor_capacitance = "20 pF"
rotor_frame_capacitance = "1 nF"
"""
SWEEP = """\
case = "case.toml"
[vary]
contact.entrainment_speed = ["1 m/s", "2 m/s"]
"""
CUT = """\
case = "case.toml"
[vary]
contact.entrainment_speed = ["1 m/s", "2 m/s"]
contact.max_hertz_pressure = ["0.5 GPa", "1 GPa"]
"""


@pytest.fixture
def files(tmp_path, case_file):
    """A file of each kind."""
    case_file.write_text(CASE.replace("801", "257"))
    (tmp_path / "bearing.toml").write_text(BEARING)
    (tmp_path / "sweep.toml").write_text(SWEEP)
    return tmp_path


def line(done):
    """The only line on stderr, of a command that was refused."""
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1
    return done.stderr.removeprefix("error: ").rstrip("\n")


def words_of(done):
    """Words on stdout, whatever the widths of its columns."""
    return " ".join(done.stdout.split())


@pytest.mark.slow
def test_results_given_to_run_are_told_to_be_drawn(ehlectric, files):
    """E8: a result is known by its first bytes, whatever its name, and its summary by its name."""
    assert ehlectric("run", "case.toml", "-o", "out", "--no-plots").returncode == 0
    assert "ehlectric plot out/result.nc" in line(ehlectric("run", "out/result.nc"))
    shutil.copy(files / "out" / "result.nc", files / "mine.toml")
    assert "ehlectric plot mine.toml" in line(ehlectric("check", "mine.toml"))
    assert "ehlectric plot out" in line(ehlectric("bearing", "out/summary.json"))
    assert "ehlectric plot out" in line(ehlectric("run", "out"))


@pytest.mark.slow
def test_a_bearing_is_checked_by_formula(ehlectric, files):
    """E9: the numbers of the check are those of the run by formula, and the table says what they are."""
    checked = ehlectric("check", "bearing.toml")
    assert checked.returncode == 0, checked.stderr
    for text in ("3000 rpm", "70 °C", "20 mPa s", "Hertzian pressure", "films of the contacts", "30 % off"):
        assert text in words_of(checked)
    summary = json.loads(ehlectric("check", "bearing.toml", "--json").stdout)
    assert ehlectric("bearing", "bearing.toml", "-o", "out", "--no-plots", "-q").returncode == 0
    solved = json.loads((files / "out" / "summary.json").read_text())
    assert summary["films"] == "formula"
    assert summary["bearing"] == solved["bearing"]
    assert f"{solved['bearing']['margin']:.4g}" in checked.stdout
    # For contacts that the command would solve, the check takes the atlas.
    (files / "bearing.toml").write_text(BEARING.replace('"formula"', '"solved"', 1))
    again = json.loads(ehlectric("check", "bearing.toml", "--json").stdout)
    words = ("--contacts", "atlas", "-o", "quick", "--no-plots", "-q")
    assert ehlectric("bearing", "bearing.toml", *words).returncode == 0
    quick = json.loads((files / "quick" / "summary.json").read_text())
    assert again["films"] == "atlas"
    assert again["bearing"] == quick["bearing"]


NO_DISCHARGE = BEARING.replace('[discharge]\ndielectric_strength = "15 V/um"\n', "")
SLOW = BEARING.replace("3000 rpm", "500 rpm")
assert NO_DISCHARGE != BEARING != SLOW


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "says"),
    [
        pytest.param(NO_DISCHARGE, "no dielectric strength given, no breakdown voltage", id="E17"),
        pytest.param(SLOW, "warning: the margin is below 1: shaft voltage ", id="E23"),
    ],
)
def test_a_bearing_without_an_answer_or_with_a_bad_one_says_so(ehlectric, files, text, says):
    (files / "bearing.toml").write_text(text)
    done = ehlectric("bearing", "bearing.toml", "--contacts", "formula", "--no-plots", "-o", "out")
    assert done.returncode == 0
    assert says in " ".join((done.stdout + done.stderr).split())


@pytest.mark.slow
def test_a_bearing_whose_strength_no_formula_takes_is_checked_without_voltages(ehlectric, files):
    """E9: the field that a Weibull law needs is not known by formula; all else is."""
    weibull = '[discharge.weibull]\nscale = "15 V/um"\nshape = 10\nreference_area = "1 mm^2"\n'
    old = '[discharge]\ndielectric_strength = "15 V/um"\n'
    (files / "bearing.toml").write_text(BEARING.replace(old, weibull).replace('"formula"', '"solved"'))
    done = ehlectric("check", "bearing.toml", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)["bearing"]
    assert found["first_break"] is None
    assert found["capacitance"] > 0.0
    assert "needs solved contacts" in ehlectric("check", "bearing.toml").stdout


def test_a_typo_in_a_bearing_is_found_by_its_check(typed, files):
    """E9: before minutes are spent on its contacts."""
    (files / "bearing.toml").write_text(BEARING.replace("common_mode_voltage", "common_mode_voltag"))
    assert line(typed("check", "bearing.toml")).startswith("motor.common_mode_voltag: ")


@pytest.mark.slow
def test_a_sweep_is_checked_with_its_first_point(ehlectric, files):
    """E7: number of points, what is varied, and the first point."""
    done = ehlectric("check", "sweep.toml", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["sweep"]["points"] == 2
    assert found["sweep"]["inputs"] == {"contact.entrainment_speed": {"values": 2, "first": 1.0, "last": 2.0}}
    assert found["first_point"]["inputs"]["contact"]["entrainment_speed"] == 1.0
    shown = ehlectric("check", "sweep.toml")
    for text in (
        "contact.entrainment_speed",
        "1 to 2 m/s",
        "in 2 values",
        "first point:",
        "Hertzian pressure",
    ):
        assert text in words_of(shown)
    # Points that are no case are counted, with the reason of the first.
    factors = 'case = "bearing.toml"\n[vary]\nbearing.film_factor = ["none", "inlet-shear", 0.8]\n'
    (files / "sweep.toml").write_text(factors)
    refused = json.loads(ehlectric("check", "sweep.toml", "--json").stdout)["sweep"]
    assert (refused["points"], refused["points_refused"]) == (3, 1)
    assert refused["reason"].startswith("lubricant.viscosity: is one for all temperatures")


@pytest.mark.slow
def test_the_breakdown_of_a_contact_is_estimated_by_formula(ehlectric, files):
    """The strength times the film of the formula; none for a law that needs the solved field."""
    case = files / "case.toml"
    discharge = '[electric]\npotential_2 = "8 V"\n[discharge]\ndielectric_strength = "15 V/um"\n'
    case.write_text(case.read_text() + discharge)
    found = json.loads(ehlectric("check", "case.toml", "--json").stdout)
    film = found["film_formulas"]["pan_hamrock"]["minimum_thickness"]
    estimate = found["breakdown_by_formula"]
    assert estimate["breakdown_voltage"] == pytest.approx(15e6 * film, rel=1e-12, abs=0.0)
    voltage = Case.from_toml(case).electric.voltage
    assert estimate["margin"] == pytest.approx(15e6 * film / abs(voltage), rel=1e-12, abs=0.0)
    # A line of a terminal ends within the words.
    assert "from the film-thickness formula" in " ".join(ehlectric("check", "case.toml").stdout.split())
    table = '[discharge.strength_table]\npressure = ["0 GPa", "1 GPa"]\nstrength = ["15 V/um", "20 V/um"]\n'
    case.write_text(case.read_text().replace('[discharge]\ndielectric_strength = "15 V/um"\n', table))
    assert "breakdown_by_formula" not in json.loads(ehlectric("check", "case.toml", "--json").stdout)


@pytest.mark.slow
def test_lambda_of_a_rough_contact_is_estimated_by_formula(ehlectric, files):
    """A wave has an Rq of its amplitude over the root of two; the film is that of smooth surfaces."""
    case = files / "case.toml"
    assert "lambda_by_formula" not in json.loads(ehlectric("check", "case.toml", "--json").stdout)
    wave = 'generator = "sinusoid"\nwavelength = "10 um"\namplitude = "500 nm"\n'
    case.write_text(case.read_text() + "[[roughness]]\nsurface = 1\n" + wave)
    found = json.loads(ehlectric("check", "case.toml", "--json").stdout)
    estimate = found["lambda_by_formula"]
    assert estimate["rq"] == pytest.approx(500e-9 / np.sqrt(2.0), rel=0.01)
    film = found["film_formulas"]["pan_hamrock"]["minimum_thickness"]
    assert estimate["lambda_ratio"] == pytest.approx(film / estimate["rq"], rel=1e-12)
    assert ("asperity contact is likely" in words_of(ehlectric("check", "case.toml"))) == (
        film < estimate["rq"]
    )


@pytest.mark.slow
def test_a_folder_never_has_two_results(ehlectric, files):
    """E18: files of an earlier result of another kind go, in all formats; those of others stay."""
    out = files / "out"
    assert ehlectric("run", "case.toml", "-o", "out", "--no-plots", "-q").returncode == 0
    kept = ["notes.txt", "map_of_berlin.png", "result.svg", "lines_0.png"]
    gone = ["film.svg", "map_film.minimum_thickness.png", "sensitivity.json", "sweep.csv", "motion_maps.pdf"]
    gone += ["lines_bearing.margin_at_bearing.temperature=70degC.pdf"]
    gone += ["breakdown_over_speed_at_bearing.temperature=70degC.png"]
    for name in (*kept, *gone):
        (out / name).write_text("x")
    assert ehlectric("bearing", "bearing.toml", "-o", "out", "--no-plots", "-q").returncode == 0
    written = ["bearing.nc", "contacts.csv", "summary.json"]
    assert sorted(path.name for path in out.iterdir()) == sorted([*written, *kept])
    # And back, while a wrong input removes nothing.
    (files / "wrong.toml").write_text(CASE.replace("2 m/s", "-2 m/s"))
    line(ehlectric("run", "wrong.toml", "-o", "out"))
    assert sorted(path.name for path in out.iterdir()) == sorted([*written, *kept])
    assert ehlectric("run", "case.toml", "-o", "out", "--no-plots", "-q").returncode == 0
    assert sorted(path.name for path in out.iterdir()) == sorted(
        ["film.csv", "result.nc", "summary.json", *kept]
    )


@pytest.mark.slow
def test_a_sweep_is_not_destroyed_by_another_run(ehlectric, files):
    """E18: it may have taken hours; the same sweep again keeps its points and draws no stale map."""
    assert ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", 1, "-q").returncode == 0
    before = {path.name: path.read_bytes() for path in (files / "out").iterdir()}
    for words in (("run", "case.toml"), ("bearing", "bearing.toml")):
        told = line(ehlectric(*words, "-o", "out"))
        assert [part for part in ("out: ", "2 points", "-o", "sweep.sqlite") if part not in told] == []
    assert {path.name: path.read_bytes() for path in (files / "out").iterdir()} == before
    (files / "out" / "lines_film.minimum_thickness.png").write_text("of fewer points")
    assert ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", 1, "-q").returncode == 0
    assert {path.name for path in (files / "out").iterdir()} == set(before)


@pytest.mark.slow
def test_two_cuts_of_a_sweep_have_two_names(ehlectric, files):
    """E19: the second map does not overwrite the first."""
    (files / "sweep.toml").write_text(CUT)
    assert ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", 1, "-q").returncode == 0
    words = ("map", "out", "--x", "contact.entrainment_speed", "--value", "film.minimum_thickness")
    for load in ("0.5 GPa", "1 GPa"):
        done = ehlectric(*words, "--at", f"contact.max_hertz_pressure={load}", "--format", "svg")
        assert done.returncode == 0, done.stderr
    stem = "lines_film.minimum_thickness_at_contact.max_hertz_pressure"
    drawn = {path.name for path in (files / "out").glob("*.svg")}
    assert drawn == {f"{stem}=0.5GPa.svg", f"{stem}=1GPa.svg"}


@pytest.mark.slow
def test_two_cuts_over_the_speed_of_a_bearing_have_two_names(ehlectric, files):
    """E19: its figures over speed too."""
    text = 'case = "bearing.toml"\n[vary]\nbearing.inner_speed = ["1000 rpm", "6000 rpm"]\n'
    (files / "sweep.toml").write_text(text + 'bearing.radial_load = ["1 kN", "2 kN"]\n')
    assert ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", 1, "-q").returncode == 0
    words = ("map", "out", "--x", "bearing.inner_speed", "--at", "bearing.radial_load=2 kN")
    assert ehlectric(*words).returncode == 0
    names = ("lines_bearing.first_break", "capacitance_over_speed", "breakdown_over_speed")
    drawn = {path.name for path in (files / "out").glob("*.png")}
    assert drawn == {f"{name}_at_bearing.radial_load=2kN.png" for name in names}


@pytest.mark.slow
def test_kinds_of_warnings_of_a_sweep_are_counted(ehlectric, files):
    """E22: what all points have by the choice of the film is a note, and is told once."""
    text = 'case = "bearing.toml"\n[vary]\nbearing.inner_speed = ["200 rpm", "6000 rpm"]\n'
    (files / "sweep.toml").write_text(text)
    done = ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", 1)
    assert done.returncode == 0, done.stderr
    lines = done.stderr.splitlines()
    assert [text for text in lines if text.startswith("note: isothermal-film at 2 of 2 ")]
    counted = [text for text in lines if "partial-film" in text]
    assert len(counted) == 1
    assert counted[0].startswith("warning: partial-film at 1 of 2 solved points: ")


@pytest.mark.slow
def test_a_folder_is_drawn_whatever_it_is_of(ehlectric, files):
    """A contact, and a sweep with its lines over the key that it varies."""
    assert ehlectric("run", "case.toml", "-o", "out", "--no-plots", "-q").returncode == 0
    done = ehlectric("plot", "out", "--format", "pdf", "--format", "svg", "--style", "journal")
    assert done.returncode == 0, done.stderr
    drawn = {path.name for path in (files / "out").iterdir()}
    assert {"film.pdf", "film.svg"} <= drawn
    assert "film.png" not in drawn
    assert ehlectric("sweep", "sweep.toml", "-o", "swept", "--workers", 1, "-q").returncode == 0
    assert "result.nc" in line(ehlectric("plot", "."))
    (files / "out" / "bearing.nc").write_text("x")
    told = line(ehlectric("plot", "out"))
    assert [part for part in ("out: ", "result.nc", "bearing.nc") if part not in told] == []


@pytest.mark.slow
def test_a_sweep_is_drawn_from_its_folder(ehlectric, files):
    text = f'case = "{EXAMPLES / "discharge.toml"}"\n[vary]\ncontact.entrainment_speed = ["2 m/s", "4 m/s"]\n'
    (files / "sweep.toml").write_text(text + "grid.nodes = [801]\n")
    done = ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", 1, "--plots")
    assert done.returncode == 0, done.stderr
    lines = "lines_discharge.breakdown_voltage.png"
    assert lines in done.stdout
    (files / "out" / lines).unlink()
    done = ehlectric("plot", "out", "--format", "svg")
    assert done.returncode == 0, done.stderr
    assert (files / "out" / lines.replace("png", "svg")).is_file()
