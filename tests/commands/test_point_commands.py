"""Point contacts as a user runs them: output, files and exit status."""

import json

import numpy as np
import pytest

from ehlectric import load
from ehlectric.figures.figure_names import POINT_FIGURE_FILES, ROUGHNESS_FIGURE
from tests.commands.test_commands import DATA, one_line
from tests.helpers.each import each

POINT = """\
title = "A ball"
[contact]
geometry = "point"
load = "20 N"
radius_x = "10 mm"
radius_y = "12 mm"
reduced_modulus = "226 GPa"
entrainment_speed = "4 m/s"
[lubricant]
base = "paper"
[grid]
nodes = 65
"""
PIT = '[[roughness]]\nsurface = 1\ngenerator = "pit"\ndepth = "0.1 um"\nwidth = "60 um"\n'
FIGURES = {*POINT_FIGURE_FILES, ROUGHNESS_FIGURE}


@pytest.fixture
def point_file(tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(POINT)
    return path


def names_in(folder):
    return {path.name for path in folder.iterdir()}


@pytest.mark.slow
@pytest.mark.gate
def test_run_writes_everything(ehlectric, point_file, tmp_path):
    done = ehlectric("run", point_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    assert names_in(tmp_path / "out") >= DATA
    assert names_in(tmp_path / "out") - DATA <= FIGURES
    for text in ("minimum film", "semi-axis across", "maximum field", "Hamrock-Dowson", "65 x 65", "pF"):
        assert text in done.stdout
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert (summary["converged"], summary["status"], summary["title"]) == (True, "converged", "A ball")
    result = load(tmp_path / "out" / "result.nc")
    assert result.summary() == summary
    table = np.loadtxt(tmp_path / "out" / "film.csv", delimiter=",", skiprows=1)
    assert table[:, 3].min() == pytest.approx(summary["film"]["minimum_thickness"], rel=1e-11, abs=0.0)
    assert len(table) == 65 * 65
    said = [line.removeprefix("warning: ") for line in done.stderr.splitlines()]
    assert said == summary["warnings"]


@pytest.mark.slow
def test_json_is_the_summary_alone_and_plot_redraws(ehlectric, point_file, tmp_path):
    done = ehlectric("run", point_file, "-o", "out", "--no-plots", "--json")
    assert names_in(tmp_path / "out") == DATA
    assert json.loads(done.stdout) == json.loads((tmp_path / "out" / "summary.json").read_text())
    done = ehlectric("plot", "out/result.nc", "-o", "figures")
    assert done.returncode == 0, done.stderr
    assert names_in(tmp_path / "figures") <= FIGURES


@pytest.mark.slow
def test_rough_run(ehlectric, point_file, tmp_path):
    point_file.write_text(POINT + PIT)
    done = ehlectric("run", point_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    assert names_in(tmp_path / "out") >= DATA
    roughness = json.loads((tmp_path / "out" / "summary.json").read_text())["roughness"]
    assert roughness["rq_1"] > 0.0
    assert roughness["rq_2"] == 0.0


@pytest.mark.slow
def test_not_converged_is_exit_3_with_all_files(ehlectric, point_file, tmp_path):
    point_file.write_text(POINT.replace("nodes = 65", "nodes = 65\n[solver]\nmax_iterations = 1"))
    done = ehlectric("run", point_file, "-o", "out", "--no-plots")
    assert done.returncode == 3
    assert names_in(tmp_path / "out") >= DATA
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert summary["converged"] is False
    assert f"error: not converged: {summary['status']}" in done.stderr
    assert all(line.startswith(("warning: ", "error: ")) for line in done.stderr.splitlines())
    assert "NOT CONVERGED" in done.stdout
    assert summary["status"] == "stalled"


@pytest.mark.slow
def test_films_thinner_than_the_boundary_film_are_contact(ehlectric, point_file, tmp_path):
    point_file.write_text(POINT.replace('"4 m/s"', '"1e-4 m/s"'))
    done = ehlectric("run", point_file, "-o", "out")
    assert done.returncode == 0, done.stderr
    assert names_in(tmp_path / "out") >= DATA | {"spots.png"}
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert summary["film"]["minimum_thickness"] == pytest.approx(1e-9, rel=1e-6)
    assert 0.99 < summary["asperities"]["load_share"] <= 1.0
    assert "error of the oil balance" in done.stdout


BAD = [
    ('radius_y = "12 mm"', "", "contact.radius_y: missing"),
    ("nodes = 65", "nodes = 65\nside = 9.0", "grid.nodes: got 65 across 18 semi-axes"),
    ('geometry = "point"', 'geometry = "line"', "is not used by a line contact"),
]


@each("old, new, message", BAD)
def test_bad_case_is_one_line_and_nothing_is_written(typed, point_file, tmp_path, old, new, message):
    point_file.write_text(POINT.replace(old, new))
    assert message in one_line(typed("run", point_file, "-o", "out"))
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_an_error_out_of_reach_is_said_before_the_run_and_by_check(ehlectric, tmp_path):
    """65 x 65 nodes, and no more of them, for an error of 0.01 %."""
    text = """
        [contact]
        geometry = "point"
        radius_x = "10 mm"
        radius_y = "10 mm"
        reduced_modulus = "226 GPa"
        max_hertz_pressure = "0.5 GPa"
        entrainment_speed = "1 m/s"
        [lubricant]
        base = "paper"
        [grid]
        nodes = 65
        refine = "0.01 %"
        most_nodes = 65
    """
    (tmp_path / "ball.toml").write_text(text, encoding="utf-8")
    for command in (("check", "ball.toml"), ("run", "ball.toml", "--no-plots")):
        done = ehlectric(*command)
        assert done.returncode == 0, done.stderr
        first = done.stderr.splitlines()[0]
        assert first.startswith("warning: grid.refine: ")
        assert "0.01 %" in first
        assert "65 nodes" in first
    # The run says at its end what it reached.
    assert done.stderr.count("grid.refine: ") == 2
    assert "grid.refine" not in ehlectric("run", "ball.toml", "--no-plots", "--quiet").stderr
