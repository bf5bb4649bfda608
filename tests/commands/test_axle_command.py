"""The command ehlectric drive for an axle: files, tables, figure, and files that it refuses."""

import csv
import json
import pickle
import shutil

import numpy as np
import pytest
from scipy.io import loadmat

from ehlectric import InputError, export, figure, load, save, solve, solve_axle
from ehlectric.readable import readable
from ehlectric.tables.axle_tables import remedied_simulation_cells
from tests.axle.axles import two_stages
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
    assert sorted(path.name for path in folder.iterdir()) == [
        "axle.nc",
        "elements.csv",
        "shafts.csv",
        "summary.json",
    ]
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
    assert {path.name for path in save(result, tmp_path)} == {
        "summary.json",
        "elements.csv",
        "shafts.csv",
        "axle.nc",
    }


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


def same(found, expected):
    """Whether two summaries are equal; times of computation do not count."""
    return {**found, "seconds": 0.0} == {**expected, "seconds": 0.0}


def test_a_saved_result_is_loaded_drawn_and_exported(typed, tmp_path, result):
    """One number in all files: summary.json, axle.nc, a table of pandas, MATLAB and a pickle."""
    save(result, tmp_path / "out")
    loaded = load(tmp_path / "out")
    assert same(loaded.summary(), result.summary())
    assert same(json.loads((tmp_path / "out" / "summary.json").read_text("utf-8")), result.summary())
    assert same(pickle.loads(pickle.dumps(loaded)).summary(), result.summary())
    ratios = [row["voltage_ratio"] for row in result.summary()["elements"]]
    table = loaded.to_dataframe()
    assert table["voltage_ratio"].tolist() == pytest.approx(
        [r if r else float("nan") for r in ratios], nan_ok=True
    )
    export(tmp_path / "out", tmp_path / "axle.mat")
    values = loadmat(tmp_path / "axle.mat", squeeze_me=True)
    capacitances = [row["capacitance"] for row in result.summary()["elements"]]
    assert values["capacitance"][0].tolist() == capacitances
    assert typed("plot", tmp_path / "out").returncode == 0
    assert (tmp_path / "out" / "axle_elements.png").exists()


@pytest.mark.slow
def test_reports_contain_elements_probabilities_and_remedies(typed, tmp_path, result):
    save(result, tmp_path / "out")
    done = typed("report", tmp_path / "out", "-o", "axle.html")
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "axle.html").read_text("utf-8")
    for words in (
        "Which bearing or gear mesh",
        "bearing 2 of output",
        "Probabilities of",
        "Ring on the rotor",
    ):
        assert words in text


def test_damaged_files_are_refused(tmp_path, result):
    dataset = result.to_xarray()
    for damaged in (
        dataset.drop_vars("capacitance"),
        dataset.assign_attrs(warnings="{}"),
        dataset.assign_attrs(schema="ehlectric.axle.result/9"),
        dataset.isel(element=slice(3)),
    ):
        damaged.to_netcdf(tmp_path / "axle.nc", engine="h5netcdf")
        with pytest.raises(InputError, match=r"axle\.nc"):
            load(tmp_path / "axle.nc")


def test_other_solvers_are_refused():
    with pytest.raises(InputError, match="axle"):
        solve(EXAMPLE, solvers="paper")


# Simulation of the example for some periods of the carrier.
SIMULATED = {
    "drive.duration": "2 ms",
    "breakdown": {"arc_resistance": "10 ohm", "extinction_current": "10 mA", "recovery_time": "100 ns"},
    "bearings.contact_resistance": "1 ohm",
    "mesh.1.gear.contact.contact_resistance": "1 ohm",
    "remedies": [],
}


@pytest.mark.slow
@pytest.mark.gate
def test_discharges_over_time(typed, tmp_path):
    """Rates and powers of summary.json are those of the discharges in events.csv."""
    (tmp_path / "axle.toml").write_text(two_stages(**SIMULATED).to_toml(), "utf-8")
    done = typed("drive", "axle.toml", "-o", "out")
    assert done.returncode == 0
    assert "peak [V]" in done.stdout
    table = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))["simulation"]
    with (tmp_path / "out" / "events.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert table["duration"] == pytest.approx(2e-3)
    for each in table["elements"]:
        own = [float(row["energy [J]"]) for row in rows if row["element"] == each["element"]]
        assert each["events"] == len(own)
        assert each["events_per_second"] == pytest.approx(len(own) / 2e-3)
        assert each["power"] == pytest.approx(sum(own) / 2e-3)
    assert table["events"] == len(rows) > 20
    # A bearing of the rotor has the voltage of its shaft.
    (rotor,) = (each for each in table["shafts"] if each["shaft"] == "rotor")
    (bearing,) = (each for each in table["elements"] if each["element"] == "bearing 1 of rotor")
    assert bearing["peak_voltage"] == pytest.approx(rotor["peak_voltage"], rel=1e-6)
    assert (tmp_path / "out" / "axle_discharges.png").stat().st_size > 10_000
    assert load(tmp_path / "out").summary()["simulation"] == table


@pytest.fixture(scope="module")
def simulated():
    """Result over time, also with a ring on the rotor and with a first mesh that conducts."""
    remedies = [two_stages().remedies[number] for number in (0, 3)]
    return solve_axle(two_stages(**SIMULATED | {"drive.duration": "1 ms", "remedies": remedies}))


@pytest.mark.slow
@pytest.mark.gate
def test_a_loaded_result_is_not_simulated_again(simulated, tmp_path, monkeypatch):
    """Its discharges are stored to the last digit, also with each remedy."""
    save(simulated, tmp_path)
    monkeypatch.setattr("ehlectric.axle.result.simulate_axles", None)
    loaded = load(tmp_path)
    assert same(loaded.summary(), simulated.summary())
    assert loaded.discharges.events() == simulated.discharges.events()
    for found, expected in zip(loaded.discharges.trace[:2], simulated.discharges.trace[:2], strict=True):
        assert found.tolist() == expected.tolist()
    assert figure(loaded, "axle_discharges").axes


@pytest.mark.slow
def test_no_mark_of_a_discharge_hides_another(simulated):
    """Each discharge in the figure has a mark for each of its shafts, above the voltage of the shaft."""
    drawn = figure(simulated, "axle_discharges")
    times = simulated.discharges.trace[0]
    ends = {each.name: {each.first, each.second} - {"housing"} for each in simulated.solution.elements}
    shown = [row for row in simulated.discharges.events() if times[0] <= row["time"] <= times[-1]]
    marks = []
    for ax in drawn.axes[1:]:
        volts, *rows = ax.lines
        heights = [float(row.get_ydata()[0]) for row in rows]
        assert len(set(heights)) == len(rows)
        assert min(heights, default=np.inf) > np.max(volts.get_ydata())
        marks += [mark for row in rows for mark in row.get_xdata()]
    assert len(marks) == sum(len(ends[row["element"]]) for row in shown) > 10


@pytest.mark.slow
def test_each_remedy_is_simulated_with_the_seed_of_the_axle(simulated):
    """The same numbers as of the changed axle alone; a mesh that conducts has no discharges."""
    for variant, discharges in zip(simulated.case.variants(), simulated.remedied_discharges, strict=True):
        alone = solve_axle(variant).discharges
        assert alone.record.events.tolist() == discharges.record.events.tolist()
        assert alone.summary() == discharges.summary()
    summary = simulated.summary()
    ring, mesh = (
        {row["element"]: row["events"] for row in table["simulation"]["elements"]}
        for table in summary["remedies"]
    )
    rotor = ("bearing 1 of rotor", "bearing 2 of rotor")
    assert sum(ring[name] for name in rotor) < simulated.discharges.summary()["events"]
    assert "mesh of rotor and intermediate" not in mesh
    heads, *rows = remedied_simulation_cells(summary)
    assert len(heads) == 4
    cells = {row[0]: row[1:] for row in rows}
    assert cells["mesh of rotor and intermediate"][2] == "conducts"
    assert cells["power of all [µW]"][0] == readable(1e6 * summary["simulation"]["power"])


@pytest.mark.slow
def test_damaged_discharges_are_refused(simulated, tmp_path):
    dataset = simulated.to_xarray()
    names = json.loads(dataset.attrs["simulation"])
    events = dataset["simulation_event_film"]
    for damaged in (
        dataset.drop_vars("simulation_block_events"),
        dataset.drop_attrs().assign_attrs({**dataset.attrs, "remedy_2_simulation": "{}"}),
        dataset.assign_attrs(simulation=json.dumps(names | {"elements": names["elements"][1:]})),
        dataset.assign_attrs(simulation=json.dumps(names | {"elements": ["other"] * len(names["elements"])})),
        dataset.assign(simulation_event_film=0 * events + 40),
        dataset.isel(simulation_voltage=slice(2)),
    ):
        damaged.to_netcdf(tmp_path / "axle.nc", engine="h5netcdf")
        with pytest.raises(InputError, match=r"axle\.nc"):
            load(tmp_path / "axle.nc")


def test_a_simulation_without_an_arc_is_refused(typed, tmp_path):
    (tmp_path / "axle.toml").write_text(two_stages(**{"drive.duration": "1 ms"}).to_toml(), "utf-8")
    done = typed("drive", "axle.toml", "-o", "out")
    assert done.returncode == 2
    assert "breakdown" in done.stderr
