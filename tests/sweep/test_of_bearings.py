"""Figures of sweeps over bearings: their breakdown voltages with the voltage of the shaft."""

import csv
import dataclasses
import itertools

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.commands.command_line import app
from ehlectric.errors import InputError
from ehlectric.figures.figure_names import SPEED_FIGURE_FILES
from ehlectric.figures.sweep_figures import save_speeds
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import value_map
from ehlectric.figures.sweep_points import held_text
from ehlectric.sweep.axis_labels import label_of
from ehlectric.sweep.points import Range
from ehlectric.sweep.sensitivity_indices import sensitivity
from ehlectric.sweep.slices import select_slice
from ehlectric.sweep.sweep_inputs import CONTACT, FIRST_BREAK, THROUGH, breakdown_of
from tests.figures.sweep.test_save import line_of_breakdown
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each
from tests.helpers.sweep_models import case, grid, points, sobol

mpl.use("Agg")

SPEED, TEMPERATURE = "bearing.inner_speed", "bearing.temperature"
RPM = np.pi / 30.0
SPEEDS = tuple(RPM * rpm for rpm in (1000.0, 2000.0, 4000.0))


def model(inputs, motor=True):
    """First break of 2 V a 1000 rpm, broken through at twice that; 3 V on the shaft."""
    first = 2.0 * inputs[SPEED] / (1000.0 * RPM) * (330.0 / inputs.get(TEMPERATURE, 330.0)) ** 4
    shaft = 3.0 if motor else None
    bearing = {
        "contacts": "solved",
        "capacitance": 1e-9 / first,
        "capacitance_oil": 1e-9 / first,
        "capacitance_air": 8e-10 / first,
        "lubrication": "full film",
        "first_break": first,
        "margin": first / 3.0 if motor else None,
        "ring_to_ring_breakdown": 2.0 * first,
        "ring_to_ring_margin": 2.0 * first / 3.0 if motor else None,
        "shaft_voltage": shaft,
    }
    return {"bearing": bearing, "converged": True, "inputs": {"bearing": {"fill": "oil"}}}


def bearings(results):
    """A sweep of contacts as one of bearings."""
    return dataclasses.replace(results, case=bearing_case(BALLS))


def over(**axes):
    return bearings(grid({SPEED: SPEEDS} | axes, model))


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_what_a_value_is_set_beside():
    own = bearing_case(BALLS)
    assert breakdown_of(own) == breakdown_of(own, "bearing.margin") == FIRST_BREAK
    assert breakdown_of(own, "bearing.capacitance") == FIRST_BREAK
    assert breakdown_of(own, "bearing.ring_to_ring_breakdown") == THROUGH
    assert breakdown_of(own, "bearing.ring_to_ring_margin") == THROUGH
    assert breakdown_of(case()) == breakdown_of(case(), "film.minimum_thickness") == CONTACT


@each(
    ("value", "part", "text"),
    [
        ("bearing.first_break", 1.0, "first breakdown"),
        ("bearing.ring_to_ring_breakdown", 2.0, "ring-to-ring"),
    ],
)
def test_a_line_of_breakdown_voltages_has_that_of_the_shaft(value, part, text):
    ax = value_lines(over(), SPEED, None, value)
    assert ax.get_xlabel() == "speed of the inner ring [rpm]"
    assert text in ax.get_ylabel()
    dots = next(line for line in ax.get_lines() if line.get_marker() == "o")
    np.testing.assert_allclose(dots.get_xdata(), [1000.0, 2000.0, 4000.0], rtol=1e-12)
    np.testing.assert_allclose(dots.get_ydata(), part * np.array([2.0, 4.0, 8.0]), rtol=1e-12)
    assert "shaft voltage 3 V" in legend(ax)
    assert "below shaft voltage" in legend(ax)


def test_a_map_has_the_line_on_which_the_shaft_breaks_it_down():
    temperatures = {TEMPERATURE: (300.0, 330.0, 360.0)}
    ax = value_map(over(**temperatures), SPEED, TEMPERATURE, "bearing.margin")
    assert "margin 1 at 3 V" in legend(ax)
    ax = value_map(over(**temperatures), SPEED, TEMPERATURE, "bearing.capacitance")
    assert not any("shaft" in text for text in legend(ax))


def test_temperatures_are_in_degrees_celsius():
    """On the axis, in the legend of lines, and where one is held; the axis is never logarithmic."""
    found = over(**{TEMPERATURE: (293.15, 343.15, 403.15)})
    ax = value_map(found, SPEED, TEMPERATURE, "bearing.first_break")
    assert ax.get_ylabel().endswith("[°C]")
    dots = np.concatenate([line.get_xydata() for line in ax.lines if line.get_marker() == "o"])
    np.testing.assert_allclose(sorted(set(np.round(dots[:, 1], 9))), [20.0, 70.0, 130.0])
    assert ax.get_yscale() == "linear"
    line = line_of_breakdown(ax)
    # 2 V n/(1000 rpm) (330 K/T)^4 is 3 V at the speed of each temperature at which points are.
    for celsius in (20.0, 70.0, 130.0):
        rpm = 1500.0 * ((celsius + 273.15) / 330.0) ** 4
        if 1000.0 < rpm < 4000.0:
            assert np.min(np.hypot(line[:, 0] / rpm - 1.0, (line[:, 1] - celsius) / 100.0)) < 5e-3
    lines = value_lines(found, SPEED, TEMPERATURE, "bearing.first_break")
    (named,) = [child for child in lines.artists if hasattr(child, "get_title")]
    assert [text.get_text() for text in named.get_texts()] == ["130", "70", "20"]
    assert (
        held_text(found, select_slice(found, SPEED, None, "bearing.first_break", {TEMPERATURE: "343"}))
        == "temperature of the oil = 70 °C"
    )


def test_words_that_are_held_are_read_as_words():
    found = over(contacts=("formula",))
    assert (
        held_text(found, select_slice(found, SPEED, None, "bearing.first_break"))
        == "contacts from the film-thickness formula"
    )


def test_without_a_motor_there_is_no_voltage_of_the_shaft():
    axes = {SPEED: SPEEDS, TEMPERATURE: (300.0, 330.0)}
    rows = [dict(zip(axes, values, strict=True)) for values in itertools.product(*axes.values())]
    found = dataclasses.replace(over(**axes), points=points(rows, lambda inputs: model(inputs, motor=False)))
    assert not any(
        "shaft" in text for text in legend(value_map(found, SPEED, TEMPERATURE, "bearing.first_break"))
    )
    assert not any(
        "shaft" in text for text in legend(value_lines(found, SPEED, TEMPERATURE, "bearing.first_break"))
    )
    ranges = {SPEED: Range(SPEEDS[0], SPEEDS[-1]), TEMPERATURE: Range(300.0, 330.0)}
    design = bearings(sobol(ranges, 64, lambda inputs: model(inputs, motor=False)))
    assert sensitivity(design, "bearing.first_break").share_below_voltage is None


def test_the_share_of_samples_below_the_voltage_of_the_shaft():
    """3 V are at 1500 rpm: a sixth of the range from 1000 to 4000 rpm."""
    design = bearings(sobol({SPEED: Range(SPEEDS[0], SPEEDS[-1])}, 256, model))
    assert sensitivity(design, "bearing.first_break").share_below_voltage == pytest.approx(
        1.0 / 6.0, abs=0.01
    )


@pytest.mark.slow
def test_speeds_alone_are_drawn_as_capacitance_and_breakdown_voltages(tmp_path):
    found = over(**{TEMPERATURE: (300.0, 330.0)})
    held = select_slice(found, SPEED, None, "bearing.first_break", {TEMPERATURE: "330"})
    files = save_speeds(found, held, tmp_path)
    assert [file.name for file in files] == list(SPEED_FIGURE_FILES)
    assert all(file.read_bytes().startswith(b"\x89PNG") for file in files)
    assert save_speeds(found, select_slice(found, SPEED, TEMPERATURE, "bearing.first_break"), tmp_path) == []


@pytest.mark.slow
def test_a_sweep_of_bearings_is_mapped_by_its_first_break(tmp_path):
    """By the command, from the file to the figures; the file names no value."""
    (tmp_path / "bearing.toml").write_text(
        bearing_case(BALLS, contacts="formula").to_toml(), encoding="utf-8"
    )
    (tmp_path / "sweep.toml").write_text(
        'case = "bearing.toml"\n[vary]\nbearing.inner_speed = ["1000 rpm", "3000 rpm"]\n', encoding="utf-8"
    )
    out = tmp_path / "out"
    swept = CliRunner().invoke(app, ["sweep", str(tmp_path / "sweep.toml"), "-o", str(out), "--workers", "1"])
    assert swept.exit_code == 0, swept.output
    done = CliRunner().invoke(app, ["map", str(out), "--x", SPEED])
    assert done.exit_code == 0, done.output
    assert {path.name for path in out.glob("*.png")} == {"lines_bearing.first_break.png", *SPEED_FIGURE_FILES}


@pytest.mark.slow
def test_tables_have_texts_and_a_film_factor_beside_the_one_that_was_varied(tmp_path):
    """Inlet shear thins the film, and a roughness of 0.3 um lets it touch; what was asked for stays."""
    thermal = {"lubricant__temperature__thermal_conductivity": "0.14 W/m/K"}
    base = bearing_case(BALLS, contacts="formula", **thermal).replace({"bearing.radial_load": "1 kN"})
    (tmp_path / "bearing.toml").write_text(base.to_toml(), encoding="utf-8")
    (tmp_path / "sweep.toml").write_text(
        'case = "bearing.toml"\n[vary]\nbearing.film_factor = ["none", "inlet-shear", 0.5]\n'
        'bearing.composite_rq = ["0.01 um", "0.3 um"]\n',
        encoding="utf-8",
    )
    out = tmp_path / "out"
    swept = CliRunner().invoke(app, ["sweep", str(tmp_path / "sweep.toml"), "-o", str(out), "--workers", "1"])
    assert swept.exit_code == 0, swept.output
    with (out / "sweep.csv").open(newline="", encoding="utf-8") as file:
        rows = [{key.partition(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(file)]
    assert [row["bearing.film_factor"] for row in rows] == ["none"] * 2 + ["inlet-shear"] * 2 + ["0.5"] * 2
    factors = [float(row["lubricant.film_factor"]) for row in rows]
    assert factors[:2] == [1.0, 1.0]
    resolved = resolve_bearing(base.replace({"bearing.film_factor": "inlet-shear"})).film_factor
    assert factors[2:4] == pytest.approx([resolved, resolved], rel=1e-12)
    assert factors[4:] == [0.5, 0.5]
    assert [row["bearing.lubrication"] for row in rows] == ["full film", "conducting"] * 3
    # Where surfaces touch nothing breaks; else the heaviest contact with the smaller radius.
    assert [row["bearing.first_break_at"] for row in rows] == ["inner contact of element 0", ""] * 3
    with xr.open_dataset(out / "sweep.nc", engine="h5netcdf") as found:
        touching = found["bearing.lubrication"].to_numpy().tolist()
        assert touching == [["full film", "conducting"]] * 3
        assert found["lubricant.temperature"].attrs["units"] == "K"
        assert found["mechanics.element_speed"].attrs["units"] == "rad/s"


def test_units_of_a_bearing():
    own = bearing_case(BALLS)
    for key, unit in {
        "bearing.first_break": "V",
        "bearing.ring_to_ring_breakdown_mean": "V",
        "bearing.shaft_voltage": "V",
        "bearing.bearing_voltage_ratio": "",
        "bearing.strength_per_volt": "1/m",
        "bearing.max_strength": "V/m",
        "bearing.capacitance_air": "F",
        "bearing.margin": "",
    }.items():
        assert label_of(key, own).unit == unit, key


def test_a_key_of_contacts_is_answered_with_that_of_bearings():
    match = r"nearest is bearing\.margin; of a bearing it is bearing\.first_break and bearing\.margin$"
    with pytest.raises(InputError, match=match):
        over().plot(value="discharge.margin")
