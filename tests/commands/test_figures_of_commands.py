"""Commands that draw, with the settings of Matplotlib that users have, and with figures that fail."""

import json
import os
import subprocess
import sys

import pytest

from tests.commands.conftest import CASE
from tests.helpers.commands import COMMAND
from tests.helpers.places import EXAMPLES

# Settings of users that changed figures or ended them, and what no version of Matplotlib knows.
RC = """\
text.usetex: True
font.family: serif
font.size: 40
axes.facecolor: red
figure.dpi: 20
savefig.bbox: tight
backend: nonsense
no.such.key: 3
"""
POINT = (EXAMPLES / "bearing_6208.toml").read_text("utf-8")


def typed_alone(*words, cwd, **environment):
    """A command in a process of its own, because Matplotlib reads its settings when it is imported."""
    command = [COMMAND, *words]
    env = {**os.environ, **environment}
    return subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, check=False)


@pytest.mark.slow
@pytest.mark.parametrize("backend", ["module://matplotlib_inline.backend_inline", "QtAgg", "nonsense"])
def test_no_backend_of_a_notebook_ends_a_command(tmp_path, backend):
    done = typed_alone("oil", "fva-3", "-o", "out", cwd=tmp_path, MPLBACKEND=backend)
    assert (done.returncode, done.stderr) == (0, "")
    assert "viscosity" in done.stdout
    assert (tmp_path / "out" / "oil_over_pressure.png").stat().st_size > 10_000


@pytest.mark.slow
@pytest.mark.parametrize("where", ["folder", "MATPLOTLIBRC"])
def test_a_matplotlibrc_changes_no_figure(tmp_path, where):
    folder = tmp_path if where == "folder" else tmp_path / "own"
    folder.mkdir(exist_ok=True)
    environment = {"MPLBACKEND": ""} | ({} if where == "folder" else {where: str(folder)})
    drawn = []
    for text in ("", RC):
        (folder / "matplotlibrc").write_text(text)
        done = typed_alone("oil", "fva-3", "-o", "out", cwd=tmp_path, **environment)
        assert (done.returncode, done.stderr) == (0, "")
        drawn.append((tmp_path / "out" / "oil_over_pressure.png").read_bytes())
    assert drawn[0] == drawn[1]


SCRIPT = """
import json, os, sys
import ehlectric
case = ehlectric.Case.from_toml("case.toml")
result = ehlectric.solve(case)
if sys.argv[1] == "notebook":
    import matplotlib
    matplotlib.rcParams.update({"text.usetex": True, "font.size": 40, "xtick.labelsize": 30})
    before = dict(matplotlib.rcParams)
image = result.plot()._repr_png_()
import matplotlib
kept = sys.argv[1] != "notebook" or dict(matplotlib.rcParams) == before
print(json.dumps([len(image), os.environ.get("MPLBACKEND"), kept, matplotlib.get_backend(auto_select=False)]))
"""


@pytest.mark.slow
def test_figures_of_python_keep_the_settings_of_a_notebook(tmp_path):
    """A backend that is not installed ends no script; one that is there stays, and so do all settings."""
    (tmp_path / "case.toml").write_text(CASE.replace("801", "401"))
    found = {}
    for name, backend in (("script", "module://matplotlib_inline.backend_inline"), ("notebook", "svg")):
        command = [sys.executable, "-c", SCRIPT, name]
        env = {**os.environ, "MPLBACKEND": backend}
        done = subprocess.run(command, cwd=tmp_path, env=env, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        size, kept_name, kept, chosen = json.loads(done.stdout)
        assert (kept_name, kept) == (backend, True)
        found[name] = (size, chosen)
    assert found["notebook"][1] == "svg"
    # The figure is the same to the byte.
    assert found["notebook"][0] == found["script"][0]


def broken(*_, **__):
    raise RuntimeError("Failed to process string with tex\nsecond line")


def assert_figure_is_missing(done, name, *texts):
    """The table and the other files are there, and one line names the figure."""
    assert done.returncode == 4
    (line,) = done.stderr.strip().splitlines()[-1:]
    assert line == f"error: {name}: could not be drawn, RuntimeError: Failed to process string with tex"
    for text in texts:
        assert text in done.stdout


@pytest.mark.slow
@pytest.mark.gate
def test_a_figure_of_an_oil_that_fails_takes_nothing_else(typed, tmp_path, monkeypatch):
    monkeypatch.setattr("ehlectric.figures.oil_figures.over_pressure", broken)
    done = typed("oil", "fva-3", "-o", "out")
    assert_figure_is_missing(done, "oil_over_pressure.png", "viscosity", "oil_over_temperature.png")
    assert {path.name for path in (tmp_path / "out").iterdir() if not path.name.startswith(".")} == {
        "oil.csv",
        "oil_over_temperature.png",
    }


@pytest.mark.slow
@pytest.mark.gate
def test_an_answer_is_read_before_its_figures_are_drawn(tmp_path):
    """The verdict comes through the pipe while no figure exists; a reader that leaves then loses none."""
    (tmp_path / "bearing.toml").write_text(POINT)
    words = ("bearing", "bearing.toml", "--contacts", "formula", "-o", "out")
    process = subprocess.Popen([COMMAND, *words], cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    with process:
        while not process.stdout.readline().startswith("  model  "):
            assert process.poll() is None
        assert not list((tmp_path / "out").glob("*.png"))
        process.stdout.close()
    assert process.returncode == 128 + 13  # the list of figures finds no reader
    assert (tmp_path / "out" / "breakdown_over_speed.png").is_file()


@pytest.mark.slow
def test_a_figure_of_a_result_that_fails_takes_nothing_else(typed, tmp_path, monkeypatch):
    """The table, the verdict, the other figures and the report of a bearing are there."""
    (tmp_path / "bearing.toml").write_text(POINT)
    with monkeypatch.context() as patch:
        patch.setattr("ehlectric.figures.bearing_figure_files.speed_figure", broken)
        done = typed("bearing", "bearing.toml", "--contacts", "formula", "-o", "out")
        assert done.returncode == 4
        assert "capacitance" in done.stdout
        lines = done.stdout.splitlines()
        verdict = next(number for number, line in enumerate(lines) if line.startswith("  model  "))
        # Files of figures are listed after the answer.
        assert lines[verdict + 1] == "written to out:"
        assert "bearing_loads.png" in lines[verdict + 2]
        missing = [
            line.split(":")[1].strip() for line in done.stderr.splitlines() if line.startswith("error")
        ]
        assert missing == ["capacitance_over_speed.png", "breakdown_over_speed.png"]
        assert (tmp_path / "out" / "summary.json").is_file()
        assert list((tmp_path / "out").glob("*.png"))
        done = typed("report", "out")
        assert done.returncode == 4
        assert (tmp_path / "out" / "report.pdf").is_file()
        assert "capacitance_over_speed could not be drawn" in (tmp_path / "out" / "report.html").read_text(
            "utf-8"
        )
    # The message of a figure that fails when it is drawn, not when it is made.
    monkeypatch.setattr("matplotlib.text.Text.draw", broken)
    done = typed("plot", "out")
    assert done.returncode == 4
    assert len(done.stderr.splitlines()) >= 3


@pytest.mark.slow
def test_a_figure_of_a_surface_that_fails_takes_nothing_else(typed, monkeypatch):
    monkeypatch.setattr("ehlectric.figures.surface_figures.profile", broken)
    surface = EXAMPLES / "surfaces" / "dektak-1.csv"
    done = typed("surface", surface, "-o", "out/")
    assert_figure_is_missing(done, "profile.png", "Rq")


def test_python_raises_what_fails_in_a_figure(tmp_path):
    from ehlectric.figures.style import save_each

    with pytest.raises(RuntimeError, match="Failed to process"):
        save_each(broken, ["film.png"], tmp_path)
