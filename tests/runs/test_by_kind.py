"""Runs of files of every kind by one signature: what is recognised, solved, written, told and loaded back."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import ehlectric
from ehlectric import InputError, read_sweep
from ehlectric.commands.draw_commands import load_and_draw
from ehlectric.commands.solve_commands import check as typed_check
from ehlectric.runs.by_kind import RUNS, draw_outcome, run, run_contact
from ehlectric.runs.file_kinds import read_input
from ehlectric.runs.solve import load
from ehlectric.runtime.progress import RunOutcome
from ehlectric.runtime.reading import regular
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

CASE = """\
title = "By file"
[contact]
reduced_radius = "14.1 mm"
reduced_modulus = "226 GPa"
max_hertz_pressure = "0.5 GPa"
entrainment_speed = "4 m/s"
[lubricant]
base = "paper"
[grid]
nodes = 65
field_degree = 2
"""
MOTION = """\
[[roughness]]
surface = 1
generator = "asperity"
height = "50 nm"
width = "60 um"
[motion]
passes = 0.375
steps = 12
record = 4
"""
BEARING = """\
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
"""
DRIVE = """\
[drive]
duration = "2 ms"
[source]
dc_link = "560 V"
modulation = "space-vector"
switching_frequency = "10 kHz"
fundamental_frequency = "500 Hz"
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
discharge.dielectric_strength = "15 V/um"
"""
SWEEP = """\
case = "contact.toml"
[vary]
"contact.entrainment_speed" = ["2 m/s", "4 m/s"]
"""
GEAR = """\
[gear]
normal_module = "4.5 mm"
teeth = [16, 24]
normal_pressure_angle = "20 deg"
profile_shift = [0.18, 0.17]
face_width = "14 mm"
flank_ra = "0.3 um"
material = "steel"
[gear.operation]
pinion_torque = "100 N m"
pinion_speed = "2000 rpm"
oil_temperature = "80 degC"
bulk_temperature = "80 degC"
[lubricant]
base = "fva-3"
"""
AXLE = """\
[drive]
speed = "6000 rpm"
torque = "30 N m"
temperature = "60 degC"
[[shaft]]
name = "rotor"
rotor = true
[[bearing]]
shaft = "rotor"
at = "0 mm"
base = "6208"
radial_clearance = "10 um"
radial_load = "800 N"
composite_rq = "0.03 um"
[[bearing]]
shaft = "rotor"
at = "80 mm"
base = "6208"
radial_clearance = "10 um"
radial_load = "400 N"
composite_rq = "0.03 um"
[source]
dc_link = "800 V"
modulation = "space-vector"
switching_frequency = "10 kHz"
pole_pairs = 2
modulation_index = 0.6
rise_time = "50 ns"
[circuit]
winding_rotor_capacitance = "100 pF"
rotor_frame_capacitance = "1 nF"
[lubricant]
base = "fva-3"
[discharge]
dielectric_strength = "15 V/um"
"""
FILES = {
    "contact": CASE,
    "motion": CASE + MOTION,
    "bearing": BEARING,
    "drive": DRIVE,
    "gear": GEAR,
    "axle": AXLE,
    "sweep": SWEEP,
}
WRITTEN = {
    "contact": ["summary.json", "result.nc", "film.csv"],
    "motion": ["summary.json", "motion.nc"],
    "bearing": ["summary.json", "contacts.csv", "bearing.nc"],
    "drive": ["summary.json", "events.csv", "spectrum.csv", "drive.nc"],
    "gear": ["summary.json", "path.csv", "mesh.csv", "gear.nc"],
    "axle": ["summary.json", "elements.csv", "shafts.csv", "axle.nc"],
    "sweep": ["sweep.csv", "sweep.parquet", "sweep.nc"],
}


@pytest.fixture
def files(tmp_path):
    for kind, text in FILES.items():
        (tmp_path / f"{kind}.toml").write_text(text)
    return {kind: tmp_path / f"{kind}.toml" for kind in FILES}


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("kind", FILES)
def test_a_file_of_each_kind_is_run_the_same_way(kind, files, tmp_path):
    """Nothing is drawn; what the progress is told last is the end."""
    told = []
    options = {"workers": 1} if kind in ("bearing", "drive", "sweep") else {}
    outcome = run(files[kind], tmp_path / "out", lambda *at: told.append(at), **options)
    assert isinstance(outcome, RunOutcome)
    assert outcome.converged
    assert outcome.failure is None
    assert [file.name for file in outcome.files] == WRITTEN[kind]
    assert all(file.is_file() for file in outcome.files)
    assert not list((tmp_path / "out").glob("*.png"))
    assert all(isinstance(done, int) and isinstance(of, int) and text is not None for done, of, text in told)
    assert told[-1][0] == told[-1][1]
    if kind != "sweep":
        assert json.loads(outcome.files[0].read_text()) == outcome.summary
        assert list(map(str, outcome.warnings)) == outcome.summary["warnings"]
    else:
        assert outcome.summary == {"solved": 2}
        assert outcome.result == read_sweep(tmp_path / "out")


@each("kind", FILES)
def test_a_kind_is_recognised_by_its_tables(kind, files):
    assert read_input(files[kind]).kind == kind
    assert set(RUNS) == set(FILES)


def test_kinds_of_the_examples():
    kinds = {path.stem: read_input(path).kind for path in EXAMPLES.glob("*.toml")}
    expected = {
        "line_contact": "contact",
        "bearing_6208": "bearing",
        "bearing_greased": "bearing",
        "bearing_regime_map": "sweep",
        "gear_map": "sweep",
        "bearing_thin_oil": "bearing",
        "breakdown_probability_map": "sweep",
        "duty_wltc": "bearing",
        "duty_drive": "drive",
        "duty_gear": "gear",
        "belt_drive": "drive",
        "drive": "drive",
        "drive_map": "sweep",
        "e_axle": "axle",
        "e_axle_map": "sweep",
        "duty_e_axle": "axle",
        "e_axle_stage_1": "gear",
        "grounding_brush": "drive",
        "grounding_brush_speeds": "sweep",
        "moving_roughness": "motion",
        "sweep": "sweep",
        "traction_curve": "sweep",
        "uncertainty": "sweep",
    }
    assert {name: kinds[name] for name in expected} == expected


@pytest.fixture
def reads(monkeypatch):
    """Names of the files that are opened."""
    names = []

    def counted(path):
        names.append(Path(path).name)
        return regular(path)

    monkeypatch.setattr("ehlectric.runtime.reading.regular", counted)
    return names


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("kind", FILES)
def test_a_file_is_read_once(kind, files, reads):
    """By the command and by Python; files that it names are read once each, too."""
    further = {"drive": ["bearing.toml"], "sweep": ["contact.toml"]}.get(kind, [])
    typed_check(files[kind], quiet=True)
    assert reads == [f"{kind}.toml", *further]
    reads.clear()
    ehlectric.check(files[kind])
    assert reads == [f"{kind}.toml", *further]


def test_files_of_no_kind_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"no\.toml: cannot be read, no such file or directory$"):
        read_input(tmp_path / "no.toml")
    (tmp_path / "text.toml").write_text("a text")
    with pytest.raises(InputError, match=r"text\.toml: is not TOML, "):
        run(tmp_path / "text.toml", tmp_path / "out")


def test_solvers_are_chosen_by_name(files, tmp_path):
    with pytest.raises(InputError, match=r"^--solver: got 'none'; expected one of ehlectric, paper$"):
        run(files["contact"], tmp_path / "out", solver="none")
    with pytest.raises(InputError, match=r"^--solver: got 'paper' for a case with motion; expected "):
        run(files["motion"], tmp_path / "out", solver="paper")
    assert not (tmp_path / "out").exists()


def test_a_film_that_is_no_solution_is_a_failure_with_its_files(files, tmp_path):
    files["contact"].write_text(CASE + "[solver]\nmax_iterations = 1\n")
    outcome = run(files["contact"], tmp_path / "out")
    assert not outcome.converged
    assert outcome.failure == f"not converged: {outcome.result.film.status}"
    assert "not-converged" in [warning.code for warning in outcome.warnings]
    assert [file.name for file in outcome.files] == WRITTEN["contact"]
    assert outcome.summary["converged"] is False


@pytest.mark.slow
def test_no_point_that_is_solved_is_a_failure(files, tmp_path):
    files["contact"].write_text(CASE + "[solver]\nmax_iterations = 1\n")
    outcome = run(files["sweep"], tmp_path / "out", workers=1)
    assert (outcome.failure, outcome.summary) == ("none of 2 points was solved", {"not converged": 2})


def test_a_folder_holds_one_result(files, tmp_path):
    """Figures of another result go when a contact is solved, and stay where it is refused."""
    folder = tmp_path / "out"
    folder.mkdir()
    old = [folder / name for name in ("film_map.png", "roughness.png", "motion_maps.png", "motion.nc")]
    for path in [*old, folder / "notes.txt"]:
        path.write_text("old")
    with pytest.raises(InputError):
        run(files["contact"], folder, solver="none")
    assert all(path.exists() for path in old)
    run(files["contact"], folder)
    assert sorted(path.name for path in folder.iterdir()) == sorted([*WRITTEN["contact"], "notes.txt"])


@pytest.mark.slow
def test_figures_of_a_run_are_drawn_after_its_results(files, tmp_path):
    case = RUNS["contact"].read(read_input(files["contact"]))
    told = []

    def progress(_done, _of, text):
        told.append(text)

    plain = run_contact(case, tmp_path, progress)
    drawn = draw_outcome(plain, tmp_path, progress)
    assert [file.name for file in plain.files] == WRITTEN["contact"]
    assert drawn.files[0].name == "film.png"
    assert told[-2:] == ["writing results", "drawing figures"]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["contact", "bearing", "drive"])
def test_a_result_is_loaded_whatever_it_is_of(kind, files, tmp_path):
    outcome = run(files[kind], tmp_path / "out")
    file = tmp_path / "out" / {"contact": "result.nc", "bearing": "bearing.nc", "drive": "drive.nc"}[kind]
    result = load(file)
    assert ehlectric.load is load
    assert type(result) is type(outcome.result)
    assert result.summary() == outcome.summary
    drawn = load_and_draw(file, tmp_path / "drawn")
    assert drawn.files
    assert not drawn.undrawn
    assert all(path.parent == tmp_path / "drawn" for path in drawn.files)
    assert list(map(str, drawn.warnings))[: len(outcome.warnings)] == outcome.summary["warnings"]


def test_a_file_that_is_no_result_is_not_loaded(files, tmp_path):
    with pytest.raises(InputError, match=r"no\.nc: cannot be read, no such file or directory$"):
        load(tmp_path / "no.nc")
    with pytest.raises(InputError, match=r"contact\.toml: is not a NetCDF file$"):
        load(files["contact"])
    (tmp_path / "motion.nc").write_bytes(b"damaged")
    with pytest.raises(InputError, match=r"motion\.nc: is not a NetCDF file$"):
        load(tmp_path)
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match=r"empty: has no result; expected a folder with one of result\.nc, "):
        load(tmp_path / "empty")


@pytest.mark.slow
def test_runs_need_no_terminal_and_no_figures():
    code = "import sys, ehlectric.runs.by_kind; print(*sys.modules)"
    loaded = set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.split())
    assert "ehlectric.runs.by_kind" in loaded
    assert not loaded & {"typer", "rich", "matplotlib", "xarray", "scipy"}
