"""The commands as a user types them: output, files and exit status."""

import itertools
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ehlectric import Case, load
from ehlectric.figures.fallback_fonts import fonts_for
from ehlectric.formulas import film_line
from tests.commands.conftest import CASE
from tests.helpers.commands import COMMAND
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES, SURFACES
from tests.helpers.processes import PATIENCE, wait_until

FIGURES = {"film.png", "field_strength.png", "field_profiles.png", "field_deviation.png"}
DATA = {"summary.json", "result.nc", "film.csv"}
# Keys of summary.json by table.
AGREED = {
    "": {
        "schema", "version", "title", "converged", "status", "warnings", "warning_codes", "inputs",
        "lubricant", "groups", "hertz", "film", "field", "film_formulas", "seconds",
    },
    "groups": {"moes_m", "moes_l"},
    "hertz": {"half_width", "max_pressure"},
    "film": {
        "minimum_thickness", "minimum_position", "central_thickness", "mean_thickness", "max_pressure",
        "load_residual", "residual", "newton_iterations", "discretisation_error", "solver", "nodes",
        "max_pressure_error", "target_error",
    },
    "field": {
        "voltage", "max_strength", "max_strength_position", "max_dimensionless", "central_dimensionless",
        "high_field_width", "capacitance_per_length", "thin_gap_error", "columns", "max_strength_wall",
        "solver", "max_strength_error", "degree",
    },
    "film_formulas": {"dowson_higginson", "dowson_toyoda", "pan_hamrock", "moes"},
    "seconds": {"film", "field"},
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.gate
def test_run_writes_everything_plot_redraws_and_a_folder_holds_one_result(ehlectric, case_file, tmp_path):
    done = ehlectric("run", case_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == FIGURES | DATA
    for text in ("minimum film", "maximum field", "Dowson-Higginson", "up to 40 %", "M"):
        assert text in done.stdout
    for name in FIGURES:
        assert (tmp_path / "out" / name).read_bytes().startswith(b"\x89PNG")
    done = ehlectric("plot", "out/result.nc", "-o", "figures")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "figures").iterdir()} == FIGURES
    ehlectric("run", case_file, "-o", "out", "--no-plots")
    assert {path.name for path in (tmp_path / "out").iterdir()} == DATA


@pytest.mark.slow
def test_a_run_is_printed_written_and_read_back(ehlectric, case_file, tmp_path):
    """With ``--json`` the summary is printed alone; the result is read back to the same.

    Its keys are those that scripts of users read, as was agreed for version 1: none may go.
    """
    done = ehlectric("run", case_file, "-o", "out", "--no-plots", "--json")
    assert {path.name for path in (tmp_path / "out").iterdir()} == DATA
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert json.loads(done.stdout) == summary
    assert load(tmp_path / "out" / "result.nc").summary() == summary
    assert summary["schema"] == "ehlectric.summary/1"
    assert summary["converged"] is True
    for name, keys in AGREED.items():
        assert keys - set(summary[name] if name else summary) == set()
    assert set(summary["film_formulas"]) == set(film_line.FORMULAS)
    for formula in summary["film_formulas"].values():
        assert set(formula) == {"minimum_thickness", "central_thickness"}
    # Alternatives are resolved: w = 2 pi R p_h^2/E'.
    contact = summary["inputs"]["contact"]
    assert contact["load_per_length"] == pytest.approx(2 * 3.141592653589793 * 0.0141 * 1e18 / 226e9)
    assert "max_hertz_pressure" not in contact


@pytest.mark.slow
def test_quiet_prints_nothing(ehlectric, case_file):
    done = ehlectric("run", case_file, "-o", "out", "--no-plots", "--quiet")
    assert (done.returncode, done.stdout) == (0, "")
    case_file.write_text(CASE.replace("2 m/s", "40 m/s"))
    assert "warning: the inlet is too short" in ehlectric("run", case_file, "--no-plots").stderr
    assert ehlectric("run", case_file, "--no-plots", "--quiet").stderr == ""


@pytest.mark.slow
@pytest.mark.gate
def test_not_converged_is_exit_3_with_all_files(ehlectric, case_file, tmp_path):
    case_file.write_text(CASE + "[solver]\nmax_iterations = 1\n")
    done = ehlectric("run", case_file, "-o", "out")
    assert done.returncode == 3
    assert {path.name for path in (tmp_path / "out").iterdir()} == FIGURES | DATA
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["converged"] is False
    assert summary["status"] == "stalled"
    assert "not converged" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
def test_films_thinner_than_the_boundary_film_are_contact(ehlectric, case_file, tmp_path):
    """Smooth surfaces that the oil is far too slow to part touch: the boundary film carries the load."""
    case_file.write_text(CASE.replace("2 m/s", "1e-6 m/s"))
    done = ehlectric("run", case_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == FIGURES | DATA | {"spots.png"}
    assert all(line.startswith("warning: ") for line in done.stderr.splitlines())
    assert "asperities are in contact in 1 spot" in done.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["film"]["minimum_thickness"] == pytest.approx(1e-9, rel=1e-6)
    assert summary["asperities"]["load_share"] == pytest.approx(1.0, abs=0.01)
    assert summary["asperities"]["electrical_behaviour"] == "resistive"


@pytest.mark.slow
def test_surfaces_that_touch_are_said(ehlectric, case_file, tmp_path):
    rough = '[[roughness]]\nsurface = 2\ngenerator = "gaussian"\nrq = "150 nm"\nseed = 1\n'
    case_file.write_text(CASE.replace("2 m/s", "1 mm/s") + rough + 'correlation_length = "10 um"\n')
    done = ehlectric("run", case_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    assert "asperities depends on the grid" in done.stderr
    figures = FIGURES | {"roughness.png", "spots.png"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == figures | DATA
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert (summary["converged"], summary["status"]) == (True, "converged")
    assert 0.0 < summary["asperities"]["load_share"] < 1.0


@pytest.mark.slow
@pytest.mark.parametrize("title", ["[bold]x[/red] [/foo]", "a $\\\\bad{$ b", "油膜 ⚡", "w " * 90])
def test_any_title_is_printed_and_drawn(ehlectric, case_file, tmp_path, title):
    case_file.write_text(CASE.replace('"Test"', f'"{title}"'), encoding="utf-8")
    done = ehlectric("run", case_file, "-o", "out")
    assert done.returncode == 0
    _, missing = fonts_for(frozenset(title) - {" "})
    assert done.stderr.count("\n") == bool(missing)
    assert ("no font of this machine has" in done.stderr) == bool(missing)
    assert {path.name for path in (tmp_path / "out").iterdir()} > FIGURES


@pytest.mark.slow
@pytest.mark.gate
def test_termination_leaves_no_stray_files(case_file, tmp_path):
    process = subprocess.Popen([COMMAND, "run", case_file, "-o", tmp_path / "out"], stderr=subprocess.PIPE)
    summary = tmp_path / "out" / "summary.json"
    assert wait_until(lambda: summary.exists() or process.poll() is not None, every=0.01)
    process.terminate()
    process.communicate(timeout=PATIENCE)
    assert not [path for path in (tmp_path / "out").iterdir() if path.name.startswith(".")]


@pytest.mark.slow
def test_reader_that_leaves(case_file, tmp_path):
    """As in ``ehlectric check case.toml | head -1``."""
    process = subprocess.Popen(
        [COMMAND, "check", case_file], stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path
    )
    process.stdout.close()
    with process:
        assert process.stderr.read() == b""
    assert process.returncode == 128 + 13  # as documented, and as after SIGPIPE


@pytest.mark.slow
def test_example_is_the_first_case_of_the_paper(ehlectric, tmp_path):
    """With nodes that are given, the domain stays that of the paper, which begins at -4 half-widths."""
    example = (EXAMPLES / "line_contact.toml").read_text(encoding="utf-8")
    assert example.count('error = "0.1 %"') == 1
    (tmp_path / "paper.toml").write_text(example.replace('error = "0.1 %"', "nodes = 3201"), encoding="utf-8")
    films = []
    for case in ("paper.toml", EXAMPLES / "line_contact.toml"):
        done = ehlectric("run", case, "-o", "out", "--no-plots", "-q")
        assert done.returncode == 0
        films.append(load(tmp_path / "out" / "result.nc").film)
    # tests/data/published/line_contact_films.csv, converged.
    film, own = films
    assert film.minimum_thickness == pytest.approx(0.6390e-6, rel=1e-3, abs=0.0)
    assert film.central_thickness == pytest.approx(0.7076e-6, rel=2e-4, abs=0.0)
    # The example asks for an error, so that its domain is larger and its film has what is missing upstream.
    gained = own.central_thickness / film.central_thickness - 1.0
    assert 0.0 < gained < film.domain_loss + 1e-3
    assert own.domain_loss <= 1e-3


@pytest.mark.slow
def test_rough_example(ehlectric, tmp_path):
    done = ehlectric("run", EXAMPLES / "rough_contact.toml", "-o", "out")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == FIGURES | DATA | {"roughness.png"}
    assert "cutoff_long: 80" in done.stdout
    field = json.loads((tmp_path / "out" / "summary.json").read_text())["field"]
    # The paper's conclusion for rough films: V12/h_min is the largest field, within some per cent.
    assert field["max_dimensionless"] == pytest.approx(1.0, abs=0.02)
    assert load(tmp_path / "out" / "result.nc").summary()["field"] == field


@pytest.mark.slow
def test_rough_where_the_contact_is_not(ehlectric, case_file, tmp_path):
    bump = '[[roughness]]\nsurface = 1\ngenerator = "asperity"\nheight = "20 nm"\nwidth = "1 um"\n'
    case_file.write_text(CASE + bump + 'position = "90 mm"\n')
    done = ehlectric("run", case_file, "-o", "out")
    assert (done.returncode, done.stderr) == (0, "")
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["roughness"]["lambda_ratio"] is None


@pytest.mark.slow
def test_surface_shows_every_step(ehlectric, tmp_path):
    words = ["--form", "parabola", "--cutoff-long", "80 um", "--truncate", "0.05 um", "-o", "profile.png"]
    done = ehlectric("surface", EXAMPLES / "surfaces" / "dektak-1.csv", *words)
    assert done.returncode == 0, done.stderr
    for text in ("form: parabola", "cutoff_long: 80", "trim: 40", "truncate: 50", "9600", "0.156245"):
        assert text in done.stdout
    assert (tmp_path / "profile.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_surface_shows_its_summits(ehlectric):
    words = ["surface", EXAMPLES / "surfaces" / "dektak-1.csv", "--form", "parabola"]
    done = ehlectric(*words)
    assert done.returncode == 0, done.stderr
    assert "spectral moments and summits" in done.stdout
    assert "belong to the sampling interval" in done.stdout
    summits = json.loads(ehlectric(*words, "--json").stdout)["summits"]
    assert [round(row["interval"] / 0.156245e-6, 3) for row in summits] == [1, 2, 4, 8, 16]
    assert all(row["m4"] > after["m4"] for row, after in itertools.pairwise(summits))
    assert summits[0]["bandwidth"] == pytest.approx(
        summits[0]["m0"] * summits[0]["m4"] / summits[0]["m2"] ** 2
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "files"),
    [
        (["-o", "x.pdf"], {"x.pdf"}),
        (["-o", "x.svg", "--style", "journal"], {"x.svg"}),
        (["-o", "x.png", "--format", "png", "--format", "pdf"], {"x.png", "x.pdf"}),
        (["-o", "folder", "--format", "svg"], {"folder/profile.svg"}),
    ],
)
def test_figures_of_surfaces_have_the_format_of_their_names(ehlectric, tmp_path, words, files):
    begins = {".png": b"\x89PNG", ".pdf": b"%PDF", ".svg": b"<?xml"}
    done = ehlectric("surface", EXAMPLES / "surfaces" / "dektak-1.csv", *words)
    assert done.returncode == 0, done.stderr
    assert {str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*.*")} == files
    for name in files:
        assert (tmp_path / name).read_bytes().startswith(begins[Path(name).suffix])
        assert Path(name).name in done.stdout


@pytest.mark.slow
@pytest.mark.gate
def test_surface_shows_the_whole_map(ehlectric, tmp_path):
    """Sq 290 nm after a plane is recorded with the file; without --map its first row is shown."""
    words = ["surface", SURFACES / "al3d-1.al3d", "--form", "line", "--cutoff-long", "30 um"]
    done = ehlectric(*words, "--map", "-o", "map.png")
    assert done.returncode == 0, done.stderr
    for text in ("Sq", "200x296", "289.8", "cutoff_long: 30", "132x228", "0.438027 x 0.438027"):
        assert text in done.stdout
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    (as_read, *_) = json.loads(ehlectric(*words, "--map", "--json").stdout)["steps"]
    assert (as_read["points_x"], as_read["points_y"]) == (200, 296)
    (as_read, *_) = json.loads(ehlectric(*words, "--json").stdout)["steps"]
    assert as_read["points"] == 200
    assert "line: got 3 for a whole map" in one_line(ehlectric(*words, "--map", "--line", "3"))
    hfm = SURFACES / "hfm-1.hfm"
    assert "is a profile; expected a map" in one_line(ehlectric("surface", hfm, "--map"))


@pytest.mark.slow
def test_check_says_what_a_case_means(ehlectric, case_file):
    done = ehlectric("check", case_file)
    assert done.returncode == 0
    for text in (
        "maximum Hertzian pressure",
        "half-width",
        "load parameter (Moes)",
        "material parameter (Moes)",
        "piezoviscous-elastic",
        "parameter Λ",
    ):
        assert text in done.stdout
    summary = json.loads(ehlectric("check", case_file, "--json").stdout)
    assert summary["hertz"]["max_pressure"] == pytest.approx(1e9)
    assert summary["regime"] == "piezoviscous-elastic"


@pytest.mark.slow
def test_check_says_what_is_doubtful_about_the_roughness(ehlectric, case_file, tmp_path):
    """All of it that needs no film, as the run does."""
    bump = '[[roughness]]\nsurface = 1\ngenerator = "asperity"\nheight = "20 nm"\nwidth = "1 um"\n'
    lines = [f"{k};{k % 5}" for k in range(99) if k != 50]
    (tmp_path / "a.csv").write_text("\n".join(["x [um];z [nm]", *lines]))
    case_file.write_text(CASE + bump + '[[roughness]]\nsurface = 2\nfile = "a.csv"\n')
    checked = ehlectric("check", case_file)
    assert checked.returncode == 0
    for text in (
        "the asperity of surface 1, whose width is 1 µm",
        "does not resolve the profile of surface 2",
        "was continued by extend = 'mirror'",
        "1 of the 97 distances between positions are twice the others",
    ):
        assert text in checked.stderr
    ran = ehlectric("run", case_file, "--no-plots")
    assert set(checked.stderr.splitlines()) <= set(ran.stderr.splitlines())
    shown = ehlectric("surface", "a.csv")
    assert "warning: a.csv: 1 of the 97 distances between positions are twice the others" in shown.stderr


@pytest.mark.slow
@pytest.mark.gate
def test_init_writes_a_case_that_solves(ehlectric, tmp_path):
    assert ehlectric("init", "new.toml").returncode == 0
    assert ehlectric("check", "new.toml").returncode == 0
    assert Case.from_toml(tmp_path / "new.toml").contact.entrainment_speed == 2.0
    again = ehlectric("init", "new.toml")
    assert again.returncode == 2
    assert again.stderr.startswith("error: new.toml: ")
    assert "--force" in again.stderr
    assert ehlectric("init", "new.toml", "--force").returncode == 0


@pytest.mark.slow
def test_point_contacts_are_begun_and_checked(ehlectric, tmp_path):
    assert ehlectric("init", "ball.toml", "--geometry", "point").returncode == 0
    assert Case.from_toml(tmp_path / "ball.toml").contact.geometry == "point"
    for path in ("ball.toml", EXAMPLES / "ball_contact.toml", EXAMPLES / "ball_bearing.toml"):
        done = ehlectric("check", path)
        assert (done.returncode, done.stderr) == (0, "")
        for text in (
            "semi-axis across entrainment",
            "central film (Hamrock-Dowson)",
            "minimum film (Chittenden et al.)",
        ):
            assert text in done.stdout
        assert all(len(line.rstrip()) <= 80 for line in done.stdout.splitlines())


def test_check_of_a_point_contact_as_json(ehlectric):
    summary = json.loads(ehlectric("check", EXAMPLES / "ball_bearing.toml", "--json").stdout)
    contact = summary["inputs"]["contact"]
    # Of the bodies: 1/Rx = 1/24 + 1/5.953 per mm.
    assert contact["radius_x"] == pytest.approx(4.7699e-3, rel=1e-4, abs=0.0)


def test_version(ehlectric):
    done = ehlectric("--version")
    assert done.returncode == 0
    assert done.stdout.startswith("ehlectric ")
    module = subprocess.run([sys.executable, "-m", "ehlectric", "--version"], capture_output=True, text=True)
    assert module.stdout == done.stdout


def one_line(done):
    """The error of a refused command."""
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    lines = [line for line in done.stderr.splitlines() if line]
    assert len(lines) == 1
    assert lines[0].startswith("error: ")
    return lines[0]


PRESSURE = 'max_hertz_pressure = "1 GPa"'
BAD_FILES = [
    ('reduced_modulus = "226 GPa"', 'reduced_modulus = "226 kg"', ["contact.reduced_modulus", "'226 kg'"]),
    ("reduced_modulus", "reduced_moduls", ["contact.reduced_moduls", "contact.reduced_modulus"]),
    (PRESSURE, "", ["contact.load_per_length", "missing"]),
    (PRESSURE, "max_hertz_pressure = 0", ["contact.max_hertz_pressure", "got 0"]),
    (PRESSURE, "max_hertz_pressure = nan", ["contact.max_hertz_pressure", "got nan"]),
    ("nodes = 801", "nodes = 1e12", ["grid.nodes", "1000000000000.0"]),
    ("nodes = 801", "inlet = 3.0", ["grid.inlet", "3.0"]),
    ("nodes = 801", "field_range = [-9, 9]", ["grid.field_range", "[-9, 9]"]),
    ("[grid]", "[electric]\npotential_1 = 1\n[grid]", ["electric.potential_2"]),
    ("[lubricant]", "[lubricant", ["TOML"]),
    (
        'base = "paper"',
        'base = "paper"\nrelative_permittivity = 80',
        ["lubricant.permittivity_law", "'clausius-mossotti'"],
    ),
]


@pytest.mark.slow
@pytest.mark.gate
@each("old, new, names", BAD_FILES)
def test_bad_case_is_one_line_and_nothing_is_written(typed, case_file, tmp_path, old, new, names):
    case_file.write_text(CASE.replace(old, new))
    (tmp_path / "out").mkdir(exist_ok=True)
    (tmp_path / "out" / "summary.json").write_text("kept")
    line = one_line(typed("run", case_file, "-o", "out"))
    assert [name for name in names if name not in line] == []
    assert [path.read_text() for path in (tmp_path / "out").iterdir()] == ["kept"]


@pytest.mark.slow
def test_files_that_cannot_be_used(ehlectric, case_file, tmp_path):
    assert "no such file" in one_line(ehlectric("run", "nowhere.toml"))
    assert "is a folder; expected a TOML file" in one_line(ehlectric("run", tmp_path))
    (tmp_path / "taken").write_text("a file")
    assert "cannot be written to" in one_line(ehlectric("run", case_file, "-o", "taken"))
    assert "cannot be written to" in one_line(ehlectric("run", case_file, "-o", "taken/below"))
    assert "is not a NetCDF file" in one_line(ehlectric("plot", "taken"))
    assert "no such file" in one_line(ehlectric("plot", "nowhere.nc"))
    assert "has no result" in one_line(ehlectric("plot", tmp_path))
    assert "cannot be written to" in one_line(ehlectric("init", "taken/case.toml"))
    assert "cannot be used" in one_line(ehlectric("init", 300 * "x"))
    (tmp_path / "out" / "film.png").mkdir(parents=True)
    assert "film.png: cannot be written to" in one_line(ehlectric("run", case_file, "-o", "out"))
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["film.png"]
    (tmp_path / "dangling").symlink_to("nowhere")
    assert "no regular file" in one_line(ehlectric("init", "dangling"))
    assert "no regular file" in one_line(ehlectric("init", "/dev/null", "--force"))


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read and write everything")
def test_permissions(ehlectric, case_file, tmp_path):
    (tmp_path / "closed").mkdir(mode=0o500)
    assert "cannot be written to" in one_line(ehlectric("run", case_file, "-o", "closed"))
    case_file.chmod(0)
    assert "permission denied" in one_line(ehlectric("run", case_file))


@pytest.mark.slow
@pytest.mark.gate
def test_the_papers_solvers(ehlectric, case_file, tmp_path):
    done = ehlectric("run", case_file, "-o", "out", "--no-plots", "--solver", "paper")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["film"]["solver"] == summary["field"]["solver"] == "paper"
    assert summary["converged"]
