"""The command ehlectric drive for an axle: files, tables, figure, and files that it refuses."""

import csv
import json
import shutil

import pytest

from ehlectric import InputError, export, figure, save, solve
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

EXAMPLE = EXAMPLES / "e_axle.toml"


@pytest.fixture(scope="module")
def result():
    return solve(EXAMPLE)


def test_the_example_is_solved(typed, tmp_path, result):
    done = typed("drive", EXAMPLE, "-o", "out", "--no-plots")
    assert done.returncode == 0
    assert "mesh of rotor and intermediate first" in done.stdout
    assert "Hybrid" in done.stdout
    folder = tmp_path / "out"
    assert sorted(path.name for path in folder.iterdir()) == ["elements.csv", "shafts.csv", "summary.json"]
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    assert summary["elements"] == result.summary()["elements"]
    with (folder / "elements.csv").open(encoding="utf-8", newline="") as file:
        heads, *rows = csv.reader(file)
    place = heads.index("voltage [V]")
    assert [float(row[place]) for row in rows] == [row["voltage"] for row in summary["elements"]]
    with (folder / "shafts.csv").open(encoding="utf-8", newline="") as file:
        assert len(list(csv.reader(file))) == 4


def test_films_by_formulas(typed, tmp_path):
    """``check`` uses the atlas for contacts that the file solves."""
    for name in ("e_axle_stage_1.toml", "e_axle_stage_2.toml"):
        shutil.copy(EXAMPLES / name, tmp_path / name)
    text = EXAMPLE.read_text("utf-8")
    solved = text.replace('torque = "30 N m"', 'torque = "30 N m"\ncontacts = "solved"')
    (tmp_path / "axle.toml").write_text(solved, "utf-8")
    assert "atlas" in typed("check", "axle.toml").stderr
    done = typed("drive", "axle.toml", "-o", "out", "--no-plots", "--contacts", "formula")
    assert done.returncode == 0
    assert "formulas" in done.stderr


def test_check_shows_the_verdict_and_writes_nothing(typed, tmp_path):
    done = typed("check", EXAMPLE)
    assert done.returncode == 0
    assert "Breakdown expected" in done.stdout
    assert list(tmp_path.iterdir()) == []


def test_wrong_files_are_refused_in_one_line(typed, tmp_path):
    for name in ("e_axle_stage_1.toml", "e_axle_stage_2.toml"):
        shutil.copy(EXAMPLES / name, tmp_path / name)
    text = EXAMPLE.read_text("utf-8")
    for before, after, key in (
        ('gears = ["rotor", "intermediate"]', 'gears = ["rotor", "wheel"]', "mesh.1.gears"),
        ('file = "e_axle_stage_1.toml"', 'file = "missing.toml"', "mesh.1.file"),
        ("[source]", "[breakdown]\narc_resistance = 10.0\n[source]", "breakdown"),
    ):
        assert before in text
        (tmp_path / "axle.toml").write_text(text.replace(before, after), "utf-8")
        done = typed("drive", "axle.toml", "-o", "out")
        assert done.returncode == 2
        assert len(done.stderr.splitlines()) == 1
        assert key in done.stderr
        assert not (tmp_path / "out").exists()


def test_the_figure_has_a_bar_for_each_element_with_a_breakdown_voltage(result):
    (ax,) = figure(result, "axle_elements").axes
    names = [label.get_text() for label in ax.get_yticklabels()]
    ranked = [name for name, _ in result.solution.ranking()]
    assert names[: len(ranked)] == ranked
    assert len(names) == len(result.solution.elements)
    widths = [bar.get_x() + bar.get_width() for bar in ax.patches]
    assert widths == pytest.approx([ratio for _, ratio in result.solution.ranking()])


def test_results_in_notebooks_and_files(result, tmp_path):
    assert "mesh of rotor and intermediate" in repr(result)
    assert "breakdown voltage" in result._repr_html_()
    assert "drive.speed" in result.case._repr_html_()
    assert {path.name for path in save(result, tmp_path)} == {"summary.json", "elements.csv", "shafts.csv"}


def test_a_netlist_is_written(typed, tmp_path):
    done = typed("spice", EXAMPLE, "-o", "axle.lib", "--bench", "bench.cir", "--contacts", "formula")
    assert done.returncode == 0
    assert "C_bearing_1_of_rotor" in done.stdout
    assert "no switches" in done.stderr
    assert "formulas" in done.stderr
    assert '.include "axle.lib"' in (tmp_path / "bench.cir").read_text("ascii")
    done = typed("spice", EXAMPLE, "-o", "axle.lib", "--arc-resistance", "1 ohm")
    assert done.returncode == 2
    assert "--arc-resistance" in done.stderr


@each("what", ["export", "plot", "laws"])
def test_what_axles_do_not_have_is_refused(what, result, tmp_path):
    save(result, tmp_path / "out")
    ways = {
        "export": lambda: export(result, tmp_path / "axle.mat"),
        "plot": lambda: export(tmp_path / "out", tmp_path / "axle.mat"),
        "laws": lambda: solve(EXAMPLE, solvers="paper"),
    }
    with pytest.raises(InputError, match="axle"):
        ways[what]()
