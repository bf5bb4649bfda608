"""How results and cases show themselves: one line, a table in a notebook, figures and tables of pandas."""
# ruff: noqa: E501

import re
from dataclasses import replace
from html import escape
from io import BytesIO

import numpy as np
import openpyxl
import pytest
from matplotlib.figure import Figure

from ehlectric import InputError, Sweep, solve, solve_motion
from ehlectric.app.charts.line_charts import main_numbers
from ehlectric.runs.workbooks import workbook
from ehlectric.runtime.display import WIDTH
from ehlectric.sweep.points import Range
from ehlectric.tables.bearing_tables import total_rows
from ehlectric.tables.contact_tables import result_rows
from ehlectric.tables.motion_tables import run_rows
from ehlectric.tables.sweep_summary import sweep_rows
from tests.conftest import PAPER_CONTACT
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.sweep_models import LOAD, SPEED, breakdown, grid, sobol
from tests.runs.test_solve import MOTION

CONTACT = {
    "contact": PAPER_CONTACT,
    "lubricant": {"base": "paper"},
    "title": "A <b> & c",
    "grid": {"nodes": 401},
}
BALL = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": 20, "reduced_modulus": 226e9}
POINT = CONTACT | {"contact": BALL | {"entrainment_speed": 2.0}, "grid": {"nodes": 65}}
STRENGTH = {"discharge": {"dielectric_strength": "15 V/um"}}
KINDS = ("line", "point", "bearing", "motion", "sweep")


@pytest.fixture(scope="module")
def results():
    """A result of every kind."""
    return {
        "line": solve(CONTACT),
        "point": solve(POINT),
        "bearing": solve(bearing_case(BALLS, contacts="formula")),
        "motion": solve_motion(MOTION),
        "sweep": grid({SPEED: (1.0, 2.0, 4.0), LOAD: (1e6, 2e6)}),
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "parts"),
    [
        ("line", ("<Result 'A <b> & c': line contact", "minimum film 0.6", "maximum pressure 1.9", "V/µm", "converged")),
        ("point", ("<PointResult", "point contact", "converged>")),
        ("bearing", ("<BearingResult", "3000 rpm", "capacitance", "first breakdown", "shaft voltage", "converged")),
        ("motion", ("<MotionResult", "moving roughness", "time steps to", "minimum film", "complete>")),
        ("sweep", ("<SweepResults 'A sweep'", "grid of 6 points over entrainment speed, load per length", "6 solved")),
    ],
)  # fmt: skip
def test_representation_is_one_short_line(results, kind, parts):
    text = repr(results[kind])
    assert len(text) <= WIDTH
    assert "\n" not in text
    assert str(results[kind]) == text
    for part in parts:
        assert part in text


@pytest.mark.parametrize(("error", "text"), [(0.012, "error 1.2 %"), (1.17, "not resolved by the grid")])
def test_every_view_has_the_error_of_the_maximum_pressure(error, text):
    solved = solve(CONTACT)
    result = replace(solved, film=replace(solved.film, max_pressure_error=error))
    assert re.search(rf"maximum pressure [\d.]+ GPa \({text}\)", repr(result))
    assert re.search(rf"maximum pressure in the film<.*GPa, {text}", result._repr_html_())
    assert text in main_numbers(result)
    rows = openpyxl.load_workbook(BytesIO(workbook(result)))["summary"].iter_rows(values_only=True)
    found = {row[0]: row[2:4] for row in rows}
    assert found["film.max_pressure_error"] == (pytest.approx(100.0 * error), "%")


def test_representation_of_what_is_not_converged():
    result = solve(CONTACT | {"solver": {"max_iterations": 1}})
    assert "NOT CONVERGED (stalled)>" in repr(result)


@pytest.mark.slow
def test_representation_of_parts_of_a_result(results):
    for part in (results["line"].film, results["point"].field, results["bearing"].solution):
        assert len(repr(part)) <= WIDTH


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("kind", "rows_of"),
    [
        ("line", result_rows),
        ("point", result_rows),
        ("bearing", lambda result: total_rows(result.summary())),
        ("motion", lambda result: run_rows(result.summary())),
        ("sweep", sweep_rows),
    ],
)
def test_a_notebook_shows_the_rows_of_the_command(results, kind, rows_of):
    result = results[kind]
    html, rows = result._repr_html_(), rows_of(result)
    assert html.count("<tr") == html.count("</tr>") == len(rows) > 2
    for row in rows:
        for text in (row.name.strip(), row.shown, row.unit):
            assert f"{escape(text)}" in html
    if kind == "bearing":
        assert html.count("warning: ") + html.count("note: ") == len(result.warnings)


def test_a_lambda_ratio_below_one_is_boundary_lubrication():
    """Three digits, and no word that reads as a state of the oil."""
    slow = bearing_case(BALLS, contacts="formula", bearing__inner_speed="30 rpm")
    summary = solve(slow).summary()
    (row,) = (row for row in total_rows(summary) if row.key == "bearing.lambda_ratio")
    ratio = summary["bearing"]["lambda_ratio"]
    assert ratio < 1.0
    assert row.text.startswith(f"≤ {ratio:.3g}, ")
    assert row.text.endswith(", boundary lubrication (no voltage computed)")


@pytest.mark.slow
def test_titles_are_no_markup(results):
    html = results["line"]._repr_html_()
    assert "A &lt;b&gt; &amp; c" in html
    assert "<b> &" not in html


def test_a_verdict_is_shown():
    result = solve(CONTACT | {"discharge": {"dielectric_strength": "1 V/um"}})
    assert result.verdict.level == "red"
    assert repr(result).endswith("verdict red>")
    html = result._repr_html_()
    assert escape(result.verdict.text) in html
    assert "#d55e00" in html


@pytest.mark.slow
def test_the_line_of_a_bearing_is_the_same_before_and_after_its_verdict_is_known(results):
    """The verdict solves bearings at other inputs, for which a line of text does not wait."""
    result = replace(results["bearing"])
    before = repr(result)
    html = result._repr_html_()
    assert escape(result.verdict.text) in html
    assert repr(result) == before
    assert "verdict" not in before


@pytest.mark.slow
def test_cases_show_what_was_given(results):
    case = results["line"].case
    html = case._repr_html_()
    assert "contact.reduced_radius" in html
    assert ">14.1</td>" in html
    assert "solver." not in html
    for text in ("<Case 'A <b> & c'", "load_per_length 1.57 MN/m", "entrainment_speed 4 m/s"):
        assert text in repr(case)
    bearing = results["bearing"].case
    assert "3000 rpm" in repr(bearing)
    assert "rpm</td>" in bearing._repr_html_()
    sweep = Sweep.from_dict({"case": case, "vary": {SPEED: {"from": 1, "to": 8, "count": 8}}})
    assert "grid of 8 points over contact.entrainment_speed" in repr(sweep)
    assert "1, 2, 3, 4, 5, 6, ... (8 values)" in sweep._repr_html_()
    spread = {"case": case, "vary": {SPEED: {"from": 1, "to": 8}}, "design": "sobol", "samples": 2}
    assert "1 to 8" in Sweep.from_dict(spread)._repr_html_()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "label"),
    [
        ("line", "pressure"),
        ("point", "y/b"),
        ("bearing", "V"),
        ("motion", "film"),
        ("sweep", "load per length"),
    ],
)
def test_plot_draws_the_figure_that_tells_most(results, kind, label):
    figure = results[kind].plot()
    assert isinstance(figure, Figure)
    texts = [text for ax in figure.axes for text in (ax.get_ylabel(), ax.get_xlabel())]
    assert any(label in text for text in texts), texts


@pytest.mark.slow
def test_a_notebook_shows_the_figure(results):
    """A figure of a canvas without a window has no image of its own in a notebook."""
    assert results["line"].plot()._repr_png_().startswith(b"\x89PNG")


@pytest.mark.slow
def test_plot_by_name(results):
    line = results["line"]
    for name in ("field_strength", "field_strength.png"):
        assert line.plot(name).axes[0].get_xlabel() == line.plot("field_strength").axes[0].get_xlabel()
    with pytest.raises(InputError, match=r"figure: got 'fild'; .* nearest is film$"):
        line.plot("fild")


def test_discharges_are_drawn_by_their_field():
    result = solve(CONTACT | STRENGTH)
    assert "field" in result.plot().axes[0].get_ylabel()


@pytest.mark.slow
def test_plot_of_sweeps():
    lines = grid({SPEED: (1.0, 2.0, 4.0)}).plot()
    assert "breakdown voltage" in lines.axes[0].get_ylabel()
    assert "entrainment speed" in lines.axes[0].get_xlabel()
    swept = grid({SPEED: (1.0, 2.0, 4.0), LOAD: (1e6, 2e6)})
    assert "minimum film" in swept.plot(value="film.minimum_thickness").axes[0].child_axes[0].get_ylabel()
    assert "load" in swept.plot(x=LOAD).axes[0].get_xlabel()
    assert sobol({SPEED: Range(1.0, 4.0), LOAD: Range(1e6, 2e6)}, 16, breakdown).plot().axes
    with pytest.raises(InputError, match="of 3 "):
        grid({SPEED: (1.0, 2.0, 4.0)}, status=lambda _: "failed").plot()


@pytest.mark.slow
def test_tables_of_pandas(results):
    line, bearing, motion = (results[kind].to_dataframe() for kind in ("line", "bearing", "motion"))
    film = results["line"].film
    np.testing.assert_array_equal(line["thickness"], film.thickness)
    assert line.attrs["units"] == {"x": "m", "pressure": "Pa", "thickness": "m", "density": ""}
    contacts = results["bearing"].contacts()
    assert len(bearing) == len(contacts)
    assert bearing["load"].tolist() == [row["load"] for row in contacts]
    assert bearing.attrs["units"]["contact_angle"] == "rad"
    assert bearing["max_pressure"].dtype == float
    assert set(bearing.attrs["units"]) == set(bearing) - {
        "element",
        "ring",
        "regime",
        "lubrication_state",
        "solved",
    }
    np.testing.assert_array_equal(motion["minimum_thickness"], results["motion"].values("minimum_thickness"))
    assert motion.attrs["units"]["minimum_thickness"] == "m"


@pytest.mark.slow
def test_a_map_node_by_node(results):
    film = results["point"].film
    frame = results["point"].to_dataframe()
    assert len(frame) == film.thickness.size
    row = frame.iloc[film.y.size + 2]
    assert (row["x"], row["y"], row["thickness"]) == (film.x[1], film.y[2], film.thickness[1, 2])


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_result_has_a_summary_and_a_dataset(results, kind):
    result = results[kind]
    assert isinstance(result.summary(), dict)
    assert result.to_xarray().attrs["case"]


@pytest.mark.slow
def test_dataset_of_a_bearing_has_units(results):
    dataset = results["bearing"].to_xarray()
    assert dataset["load"].attrs["units"] == "N"
    positions = results["bearing"].solution.positions
    np.testing.assert_array_equal(dataset["load"][0, 0], positions[0].inner.load)


def test_units_of_a_notebook_are_those_of_an_engineer():
    """No prefix on one, 300 V in place of 0.3 kV, and sweeps in rpm and °C."""
    case = bearing_case(BALLS, contacts="formula")
    html = case._repr_html_()
    for number, unit in (("870", "kg/m³"), ("300", "V"), ("70", "°C"), ("3000", "rpm"), ("46", "mm²/s")):
        assert f'>{number}</td><td style="text-align:left">{unit}</td>' in html
    vary = {"bearing.inner_speed": ["1000 rpm", "2000 rpm"], "bearing.temperature": ["40 degC", "80 degC"]}
    html = Sweep.from_dict({"case": case, "vary": vary})._repr_html_()
    assert '>1000, 2000</td><td style="text-align:left">rpm</td>' in html
    assert '>40, 80</td><td style="text-align:left">°C</td>' in html
