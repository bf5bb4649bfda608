"""The commands that look at a sweep, with a folder that holds a model known in closed form."""

import json

import pytest
import typer
from typer.testing import CliRunner

from ehlectric import InputError
from ehlectric.commands.sweep_commands import draw_maps, sensitivity
from ehlectric.sweep.points import Range
from tests.helpers.each import each
from tests.helpers.sweep_models import LOAD, POTENTIAL, SPEED, breakdown, grid, sobol

VALUE = "discharge.breakdown_voltage"
GRID = grid({SPEED: (1.0, 2.0, 4.0), LOAD: (5e5, 1e6), POTENTIAL: (1.0, 4.0)})
SOBOL = sobol(
    {SPEED: Range(1.0, 4.0), LOAD: Range(5e5, 1e6)},
    64,
    breakdown,
    status=lambda i: "failed" if i[SPEED] > 3.9 else "solved",
)
FAILED = grid({SPEED: (1.0, 2.0)}, status=lambda _: "failed")


@pytest.fixture
def command(monkeypatch, tmp_path):
    """Run a command; folders are named by the sweep they hold."""
    sweeps = {"grid": GRID, "sobol": SOBOL, "failed": FAILED}

    def read_sweep(folder):
        if folder.name not in sweeps:
            raise InputError(f"{folder}: holds no sweep")
        return sweeps[folder.name]

    monkeypatch.setattr("ehlectric.sweep.read_sweep", read_sweep)
    monkeypatch.chdir(tmp_path)
    app = typer.Typer()
    app.command("map")(draw_maps)
    app.command("sensitivity")(sensitivity)

    def run(*words):
        return CliRunner().invoke(app, [str(word) for word in words], env={"COLUMNS": "100"})

    return run


@pytest.mark.slow
@pytest.mark.gate
def test_map_writes_both_figures(command, tmp_path):
    done = command("map", "grid", "--x", SPEED, "--y", LOAD, "--value", VALUE, "--at", f"{POTENTIAL}=4 V")
    assert done.exit_code == 0, done.output
    names = {f"{kind}_{VALUE}_at_{POTENTIAL}=4V.png" for kind in ("map", "lines")}
    assert {path.name for path in (tmp_path / "grid").iterdir()} == names
    assert "at potential of surface 2 = 4 V\n" in done.output
    assert all(name in done.output.partition("written to grid:")[2] for name in names)


@pytest.mark.slow
def test_map_without_y_is_lines_in_another_folder(command, tmp_path):
    held = ("--at", f"{POTENTIAL}=1", "--at", f"{LOAD}=1 MN/m")
    done = command("map", "grid", "--x", SPEED, "--value", "film.minimum_thickness", *held, "-o", "out", "-q")
    assert (done.exit_code, done.output) == (0, "")
    assert [path.name for path in (tmp_path / "out").iterdir()] == [
        f"lines_film.minimum_thickness_at_{LOAD}=1MN-m,{POTENTIAL}=1.png"
    ]


@each(
    "words, message",
    [
        (("map", "nothing", "--x", SPEED), "error: nothing: holds no sweep"),
        (("map", "failed", "--x", SPEED), "no point of 2 is solved"),
        (("map", "grid", "--x", SPEED, "--y", LOAD), f"error: at: missing, {POTENTIAL} "),
        (("map", "grid", "--x", SPEED, "--value", "discharge.voltage"), VALUE),
        (("map", "grid", "--x", "speed"), SPEED),
        (
            ("map", "grid", "--x", SPEED, "--at", POTENTIAL),
            f"error: at: got '{POTENTIAL}'; ",
        ),
        (("map", "grid", "--x", SPEED, "--at", "a=1", "--at", "a=2"), "error: at: got a twice"),
        (("sensitivity", "nothing"), "error: nothing: holds no sweep"),
        (("sensitivity", "grid"), 'error: design: got "grid"'),
        (("sensitivity", "failed"), "error: design"),
        (("sensitivity", "sobol", "--value", "film.thickness"), "film.minimum_thickness"),
    ],
)
def test_what_is_wrong_is_one_line_before_anything_is_written(command, tmp_path, words, message):
    done = command(*words)
    assert done.exit_code == 2
    assert message in done.output
    assert done.output.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_sensitivity_prints_and_writes_the_same(command, tmp_path):
    done = command("sensitivity", "sobol")
    assert done.exit_code == 0, done.output
    folder = tmp_path / "sobol"
    assert {path.name for path in folder.iterdir()} == {"sensitivity.json", "sensitivity.png"}
    found = json.loads((folder / "sensitivity.json").read_text(), parse_constant=pytest.fail)
    assert found["schema"] == "ehlectric.sensitivity/1"
    assert set(found) == {
        "schema", "value", "points", "solved", "rows", "rows_dropped", "rows_doubtful", "spread",
        "share_below_voltage", "share_below_voltage_bounds", "indices", "bootstrap",
    }  # fmt: skip
    assert (found["value"], found["rows"]) == (VALUE, 64)
    assert found["rows_dropped"] > 0
    assert list(found["indices"]) == [SPEED, LOAD]
    # The largest index is printed first, with its interval.
    index = found["indices"][SPEED]
    low, high = index["total_interval"]
    (line,) = [line for line in done.output.splitlines() if line.startswith("entrainment speed")]
    assert f"{index['first_order']:.3f}" in line
    assert f"{index['total']:.3f}  {low:.3f} to {high:.3f}" in line
    assert f"{found['spread']['quantiles']['0.5']:.4g}" in done.output
    assert f"warning: {found['rows_dropped']} of 64 rows contain a point that is not solved" in done.output
