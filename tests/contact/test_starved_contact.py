"""Starved contacts as results: summary, files, warnings, tables, sweeps, and solvers that refuse them."""

import json

import numpy as np
import pytest

from ehlectric import Case, InputError, load, save, solve
from ehlectric.cases.measurements import read_measurement
from ehlectric.contact.measured_film import contact_factors
from ehlectric.paper.paper_contacts import PAPER
from ehlectric.sweep.run import run_sweep
from ehlectric.sweep.sweep_inputs import Sweep
from ehlectric.tables.contact_tables import result_rows

LINE = Case.line(
    reduced_radius="14.1 mm",
    reduced_modulus="226 GPa",
    max_hertz_pressure="1 GPa",
    entrainment_speed="4 m/s",
    lubricant="paper",
    grid={"nodes": 401},
    discharge={"dielectric_strength": "30 V/um", "outlet": "fingers"},
)
POINT = Case.point(
    radius_x="10 mm",
    radius_y="10 mm",
    reduced_modulus="226 GPa",
    load="20 N",
    entrainment_speed="2 m/s",
    lubricant="paper",
    grid={"nodes": 65, "nodes_y": 65},
)
KEYS = {"oil_layer", "film_ratio", "meniscus", "flooded"}


def codes(result):
    return {warning.code for warning in result.warnings}


@pytest.fixture(scope="module")
def flooded():
    return solve(LINE)


@pytest.fixture(scope="module")
def starved():
    return solve(LINE.replace({"inlet.oil_layer": "0.3 um"}))


def test_summary_has_the_flooded_film_beside(starved, flooded):
    film, summary = starved.film, starved.summary()["film"]
    assert set(summary) >= KEYS
    assert summary["oil_layer"] == pytest.approx(3e-7, rel=1e-12)
    assert summary["flooded"]["central_thickness"] == pytest.approx(flooded.film.central_thickness, rel=1e-9)
    assert summary["flooded"]["minimum_thickness"] == pytest.approx(flooded.film.minimum_thickness, rel=1e-9)
    ratio = film.central_thickness / flooded.film.central_thickness
    assert summary["film_ratio"] == pytest.approx(ratio, rel=1e-9)
    # The film of the Hertzian zone is the layer, compressed as the oil is.
    density = float(np.interp(0.0, film.x, film.density))
    assert film.central_thickness * density == pytest.approx(3e-7 * film.density[0], rel=1e-3)
    assert film.x[0] < summary["meniscus"] < -starved.conditions.half_width
    assert not KEYS & set(flooded.summary()["film"])


def test_content_of_oil(starved, flooded):
    """The layer before the meniscus, a full film in the contact, and the oil that passed behind it."""
    film = starved.film
    before = film.x < film.starvation.meniscus
    oil = film.film_fraction * film.thickness * film.density
    # The node before the meniscus has the oil that flows back, too.
    assert oil[before][:-1] == pytest.approx(3e-7 * film.density[0], rel=1e-9)
    inside = np.abs(film.x) < 0.9 * starved.conditions.half_width
    assert np.all(film.film_fraction[inside] == 1.0)
    assert oil[-2] == pytest.approx(3e-7 * film.density[0], rel=1e-8)
    assert flooded.film.film_fraction is None
    assert flooded.film.starvation is None


def test_oil_between_the_walls_counts_for_the_capacitance(starved):
    """With gas beside the oil the inlet has less capacitance than full of oil; the Hertzian zone has not."""
    full = solve(starved.case.replace({"discharge.outlet": "full"})).discharge.capacitances
    fingers = starved.discharge.capacitances
    assert fingers.capacitance_hertz == pytest.approx(full.capacitance_hertz, rel=1e-9)
    assert fingers.capacitance_inlet < 0.9 * full.capacitance_inlet


def test_result_is_saved_and_loaded(starved, tmp_path):
    paths = save(starved, tmp_path)
    again = load(paths[1])
    assert again.film.starvation == starved.film.starvation
    np.testing.assert_array_equal(again.film.film_fraction, starved.film.film_fraction)
    assert json.loads(paths[0].read_text(encoding="utf-8"))["film"] == again.summary()["film"]
    assert again.case == starved.case


def test_table_and_verdict(starved):
    names = [row.name for row in result_rows(starved)]
    assert "layer of oil before the contact" in names
    assert "minimum film thickness, flooded" in names
    assert "flooded" not in starved.verdict.text


def test_thick_layer_is_told():
    result = solve(LINE.replace({"inlet.oil_layer": "2 um"}))
    assert "oil-layer-thick" in codes(result)
    assert result.film.starvation.meniscus is None
    assert result.film.film_fraction is None
    assert any(row.value == "none: flooded" for row in result_rows(result))


@pytest.mark.slow
@pytest.mark.gate
def test_meniscus_at_the_edge_of_the_hertz_zone_and_of_the_domain(starved):
    assert "meniscus-at-edge" not in codes(starved)
    (text,) = [
        warning.text
        for warning in solve(LINE.replace({"inlet.oil_layer": "5 nm"})).warnings
        if warning.code == "meniscus-at-edge"
    ]
    assert "at the edge of the Hertzian zone" in text
    short = LINE.replace({"inlet.film_ratio": 0.99, "grid.inlet": -1.8})
    (text,) = [w.text for w in solve(short).warnings if w.code == "meniscus-at-edge"]
    assert "at the edge of the domain" in text
    # Where the film is flooded to a tenth of a percent the meniscus may lie there.
    nearly = LINE.replace({"inlet.film_ratio": 0.9995, "grid.inlet": -2.3})
    assert "meniscus-at-edge" not in codes(solve(nearly))


def test_a_short_inlet_of_the_flooded_film_is_told():
    """It is that of the film, if this is a part of the flooded one; else of the ratio of films alone."""
    short = LINE.replace({"grid.inlet": -1.3})
    flooded, part = solve(short), solve(short.replace({"inlet.film_ratio": 0.7}))
    assert part.film.inlet_deficit == pytest.approx(flooded.film.inlet_deficit, rel=1e-9)
    assert "inlet-far-too-short" in codes(part)
    layer = solve(short.replace({"inlet.oil_layer": "0.2 um"}))
    assert layer.film.inlet_deficit == 0.0
    assert not {"inlet-too-short", "inlet-far-too-short"} & codes(layer)
    assert "flooded-film-wrong" in codes(layer)


def test_a_flooded_film_that_did_not_converge_has_no_part():
    few = LINE.replace({"solver.max_iterations": 3})
    part = solve(few.replace({"inlet.film_ratio": 0.7}))
    assert not part.converged
    assert {"not-converged", "flooded-film-wrong"} <= codes(part)
    layer = solve(few.replace({"inlet.oil_layer": "0.3 um"}))
    assert layer.converged
    assert "flooded-film-wrong" in codes(layer)
    film = layer.summary()["film"]
    assert film["film_ratio"] is None
    assert film["flooded"] == {"minimum_thickness": None, "central_thickness": None}
    rows = {row.name: row.value for row in result_rows(layer)}
    assert rows["starved / flooded central film"] == "unknown"


def test_the_whole_flooded_film_has_the_layer_that_passes(flooded):
    """In a line contact that is the mass of the film; the least one of a point depends on its domain."""
    film = solve(LINE.replace({"inlet.film_ratio": 1.0})).film
    at_centre = np.interp(0.0, film.x, film.thickness * film.density) / film.density[0]
    assert film.starvation.oil_layer == pytest.approx(at_centre, rel=2e-3)
    np.testing.assert_array_equal(film.thickness, flooded.film.thickness)
    assert solve(POINT.replace({"inlet.film_ratio": 1.0})).film.starvation.oil_layer is None


@pytest.mark.slow
def test_a_film_that_is_flooded_on_the_centre_line_alone_is_starved():
    table = {"y": ["-60 um", "-50 um", "50 um", "60 um"], "thickness": ["0.2 um", "15 um", "15 um", "0.2 um"]}
    few = {"grid.field_degree": 2, "grid.field_nodes": 17, "grid.field_nodes_y": 17}
    result = solve(POINT.replace({"inlet.layer_table": table, **few}))
    assert result.film.starvation.meniscus is None
    assert result.film.film_fraction is not None
    assert result.film.inlet_deficit > 0.0
    assert not {"oil-layer-thick", "film-ratio-missed"} & codes(result)
    # The table ends within the Hertzian zone, whose semi-axis is 0.11 mm.
    assert "layer-table-short" in codes(result)
    (text,) = [warning.text for warning in result.warnings if warning.code == "layer-table-short"]
    assert all(number in text for number in ("-60", "60", "-110", "110"))
    (text,) = [warning.text for warning in result.warnings if warning.code == "meniscus-at-edge"]
    assert "on y = 0 already" in text
    assert any(row.value == "at the inlet edge on y = 0" for row in result_rows(result))


@pytest.mark.slow
@pytest.mark.parametrize("case", [LINE, POINT], ids=["line", "point"])
def test_layer_for_a_ratio_of_films(case):
    result = solve(case.replace({"inlet.film_ratio": 0.6}))
    assert result.film.starvation.film_ratio == pytest.approx(0.6, rel=1e-3)
    assert "film-ratio-missed" not in codes(result)
    given = solve(case.replace({"inlet.oil_layer": result.film.starvation.oil_layer}))
    # Far less than the discretisation error: the meniscus of a point contact may differ by a node.
    assert given.film.central_thickness == pytest.approx(result.film.central_thickness, rel=1e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_a_layer_over_y_may_differ_on_both_sides():
    table = {"y": ["-0.2 mm", "0.2 mm"], "thickness": ["0.4 um", "0.1 um"]}
    result = solve(POINT.replace({"inlet.layer_table": table}))
    film = result.film
    assert film.converged
    assert "layer-table-short" not in codes(result)
    assert film.starvation.oil_layer == pytest.approx(0.25e-6, rel=1e-9)
    middle = int(np.argmin(np.abs(film.x)))
    side = 0.5 * film.semi_axis_y
    low, high = (np.interp(place, film.y, film.thickness[middle]) for place in (side, -side))
    assert low < 0.8 * high
    assert np.all((film.film_fraction >= 0.0) & (film.film_fraction <= 1.0))


def test_solvers_and_measurements_that_need_a_flooded_contact(tmp_path):
    case = LINE.replace({"inlet.oil_layer": "0.3 um"})
    with pytest.raises(InputError, match=r"inlet: .* for the solver 'paper'"):
        solve(case, solvers=PAPER)
    file = tmp_path / "film.csv"
    file.write_text("entrainment speed [m/s],film [nm]\n4,300\n", encoding="utf-8")
    with pytest.raises(InputError, match="inlet: is not used with a measurement"):
        contact_factors(case, read_measurement(file), contacts="formula")


@pytest.mark.slow
def test_sweep_over_the_layer(tmp_path):
    """A key of a table that the case does not have; the central film is proportional to a thin layer."""
    case = LINE.replace({"grid.nodes": 201})
    sweep = Sweep.from_dict({"case": case, "vary": {"inlet.oil_layer": ["0.1 um", "0.2 um"]}})
    results = run_sweep(sweep, tmp_path / "out", workers=1)
    films = [point.summary["film"] for point in results.points]
    assert [film["oil_layer"] for film in films] == pytest.approx([1e-7, 2e-7], rel=1e-9)
    assert films[1]["central_thickness"] == pytest.approx(2.0 * films[0]["central_thickness"], rel=1e-3)
