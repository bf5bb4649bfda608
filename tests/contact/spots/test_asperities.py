"""Asperities of solved contacts: limits, balances, and what is told about them."""

import json
import re

import numpy as np
import pytest

from ehlectric import Case, load, solve
from ehlectric.contact.preparation import prepare
from ehlectric.contact.run import save
from ehlectric.contact.touching import (
    Coarser,
    about_share,
    asperities,
    digits_within,
    share_text,
    spot_warnings,
)
from ehlectric.figures import figure_names as known
from ehlectric.figures.contact_findings import finding
from ehlectric.figures.result_figures import figure, figure_names
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import CONTACT_KEYS
from ehlectric.readable import readable
from ehlectric.tables.contact_tables import result_rows
from tests.contact.spots.cases import LINE, POINT, solved
from tests.helpers.each import each

BOTH = pytest.mark.parametrize("geometry", ["line", "point"])


@pytest.mark.slow
def test_at_creeping_speed_smooth_surfaces_touch_in_the_whole_hertz_zone():
    """The dry contact of Hertz: all of the load, and the width 2 b, within the error that the grid gives."""
    contact = LINE.to_dict()["contact"] | {"entrainment_speed": 1e-6}
    case = Case.from_dict(LINE.to_dict() | {"contact": contact, "roughness": []})
    result = solve(case)
    found = result.asperities.touching
    assert found.load_share == pytest.approx(1.0, abs=0.01)
    assert found.spots == 1
    assert abs(found.contact_area - 2.0 * result.conditions.half_width) <= (
        2.0 * found.contact_area_error * found.contact_area
    )
    assert found.lambda_undeformed is None
    assert result.asperities.electrical.behaviour == "resistive"
    # However much the area changes with the grid, the whole load does not come off the spots.
    coarser = Coarser(load_share=1.0, contact_area_share=3.0 * found.contact_area_share)
    inputs = (case, result.conditions, result.film)
    again = asperities(*inputs, rq=0.0, smooth=None, coarser=coarser)
    assert again.touching.contact_area_error == pytest.approx(2.0)
    assert again.electrical.behaviour == "resistive"


@pytest.mark.slow
@BOTH
def test_oil_and_asperities_carry_the_load(geometry):
    result = solved(geometry)
    film, found = result.film, result.asperities.touching
    cell = np.prod([axis[1] - axis[0] for axis in film.axes])
    load = result.conditions.load if geometry == "point" else result.conditions.load_per_length
    assert cell * np.sum(film.pressure) == pytest.approx(load, rel=0.01)
    assert found.load_share == pytest.approx(cell * np.sum(film.contact_pressure) / load)
    assert 0.0 < found.load_share < 1.0
    assert found.spots == result.asperities.spots.number > 0
    change = abs(result.coarser.contact_area_share / found.contact_area_share - 1.0)
    assert found.contact_area_error == max(result.asperities.spots.relative_edge, change)
    assert found.contact_area == pytest.approx(cell * np.count_nonzero(film.contact))
    assert film.thickness[film.contact] == pytest.approx(1e-9, rel=1e-3)


@pytest.mark.slow
@BOTH
def test_film_around_the_spots(geometry):
    result = solved(geometry)
    film, found = result.film, result.asperities.touching
    grid = np.meshgrid(*film.axes, indexing="ij")
    zone = sum((x / a) ** 2 for x, a in zip(grid, result.conditions.semi_axes, strict=True)) < 1.0
    around = film.thickness[zone & ~film.contact]
    assert found.mean_film == pytest.approx(np.mean(around), rel=0.1)
    assert found.boundary_film <= found.least_film <= found.film_1 <= found.film_5 <= found.film_50
    assert found.film_50 == pytest.approx(np.median(around), rel=0.2)
    change = (film.thickness - result.smooth.thickness)[zone]
    assert found.rq_deformed == pytest.approx(np.std(change), rel=0.1)
    heights = result.roughness.sum(axis=0)[zone]
    assert found.rq_deformed < np.std(heights)
    assert found.lambda_deformed > found.lambda_undeformed > 0.0


@pytest.mark.slow
def test_friction_of_the_asperities():
    line, point = solved("line").asperities.touching, solved("point").asperities.touching
    assert line.boundary_friction == pytest.approx(0.12 * line.load_share)
    assert point.boundary_friction is None
    assert not any("friction" in row.name for row in result_rows(solved("point")))


@pytest.mark.slow
def test_the_coarser_grid_is_that_of_half_the_nodes():
    alone = solve(LINE.replace(grid={"nodes": 201}), beside_smooth=False).asperities.touching
    coarser = solved("line").coarser
    assert coarser.load_share == pytest.approx(alone.load_share, rel=1e-5)
    assert coarser.contact_area_share == pytest.approx(alone.contact_area_share)


@pytest.mark.slow
@BOTH
def test_every_key_of_the_summary_is_described(geometry, tmp_path):
    result = solved(geometry)
    table = result.summary()["asperities"]
    described = CONTACT_KEYS[geometry]
    assert all(key_of(described, f"asperities.{name}") for name in table)
    assert {name for name in described if name.startswith("asperities.")} == {
        f"asperities.{name}" for name in table
    }
    files = save(result, tmp_path)
    assert json.loads(files[0].read_text(encoding="utf-8"))["asperities"] == table
    again = load(files[1])
    assert again.coarser == result.coarser
    assert again.summary()["asperities"] == table


@pytest.mark.slow
@BOTH
def test_what_is_told(geometry):
    result = solved(geometry)
    codes = [warning.code for warning in result.warnings]
    assert "asperities-touch" in codes
    # Of the boundary film, of which these would speak.
    assert not {"grid-too-coarse", "grid-far-too-coarse", "field-above-insulators"} & set(codes)
    assert result.film_error is None
    assert result.summary()["film"]["discretisation_error"] is None
    rows = {row.key: row for row in result_rows(result)}
    assert rows["asperities.electrical_behaviour"].value == result.asperities.electrical.behaviour
    assert rows["film.minimum_thickness"].text.endswith("in the boundary film")
    assert "in the boundary film" in rows["field.max_strength"].text
    assert "field.max_strength_error" not in rows
    assert "field.max_dimensionless" not in rows
    spots = result.asperities.spots.number
    assert f"{spots} contact spots, {result.asperities.electrical.behaviour}" in repr(result)
    assert "with asperity contact" in rows["film.discretisation_error"].text


@pytest.mark.slow
def test_a_share_that_depends_on_the_grid_is_told():
    result = solved()
    share = result.asperities.touching.load_share

    def codes(coarser):
        told = spot_warnings(POINT, result.conditions, result.film, coarser)
        return [one.code for one in told if one.code != "oil-not-conserved"]

    assert codes(Coarser(share, 0.1)) == ["asperities-touch"]
    for coarser in (Coarser(1.2 * share + 0.01, 0.1), None):
        assert codes(coarser) == ["asperities-touch", "load-share-unresolved"]


@each(
    "share, coarser, text",
    [
        (0.23691, 0.2369, "23.7"),
        (0.23691, 0.22, "24"),
        (0.23691, 0.4, "< 24"),
        (0.23691, 0.12, "20"),
        (0.656, 1.0, "< 66"),
        (0.23691, None, "20"),
        (0.0, None, "0"),
        (4e-7, 0.03, "< 0.01"),
    ],
)
def test_digits_of_a_share(share, coarser, text):
    assert share_text(share, coarser) == text


def test_solutions_that_differ_by_their_asperities_print_the_same_digits():
    """A ball on 65 nodes has solutions with these load shares and median films, by rounding of its inputs.

    Their spread of 0.5 and 1 % is far below the change of 300 and 48 % from half the nodes.
    """
    shares = (0.095061, 0.095113, 0.095216, 0.095253, 0.095311, 0.095504)
    assert {share_text(share, 0.39651) for share in shares} == {"< 9.6"}
    assert {readable(film, digits_within(0.48)) for film in (6.418, 6.479)} == {"6"}


@pytest.mark.slow
def test_films_around_the_spots_have_the_digits_that_half_the_nodes_leave():
    """The mean film of half the nodes is that of the contact with this grid."""
    result = solved("line")
    found = result.summary()["asperities"]
    change = abs(found["mean_film"] - found["mean_film_coarser"]) / found["mean_film"]
    (row,) = (row for row in result_rows(result) if row.name == "mean film outside of the spots")
    value, note = row.text.split(" nm, in the Hertzian zone, ± ")
    assert float(value) == pytest.approx(1e9 * found["mean_film"], rel=5.0 * 10.0 ** -digits_within(change))
    assert note == f"{readable(100.0 * change, 2)} % by the grid"
    table = result.case.to_dict()
    half = solve(Case.from_dict(table | {"grid": table["grid"] | {"nodes": result.film.x.size // 2 + 1}}))
    assert half.summary()["asperities"]["mean_film"] == pytest.approx(found["mean_film_coarser"], rel=1e-3)


@pytest.mark.slow
def test_tiny_shares_are_told_as_bounds():
    result = solved()
    coarser = Coarser(1e-6, 0.1)
    told = {one.code: one.text for one in spot_warnings(POINT, result.conditions, result.film, coarser)}
    assert "it was less than 0.01 % on a grid with half the nodes" in told["load-share-unresolved"]
    assert about_share(0.2369, 0.22) == "about 24 %"
    assert not re.search(r"e-\d", " ".join(told.values()))


@pytest.mark.parametrize("case", [LINE, POINT])
def test_a_hardness_below_the_hertz_pressure_is_told_before_the_solution(case):
    def codes(hardness):
        table = case.to_dict()
        table["contact"]["hardness"] = hardness
        return [warning.code for warning in prepare(Case.from_dict(table)).warnings()]

    assert "hardness-low" in codes(0.3e9)
    assert "hardness-low" not in codes(7e9)


@pytest.mark.slow
@BOTH
def test_titles_name_the_field_of_the_boundary_film(geometry):
    result = solved(geometry)
    figures = ("field_map.png", "cuts.png") if geometry == "point" else ("field_strength.png",)
    for name in (*figures, *(("field_profiles.png",) if geometry == "line" else ())):
        title = finding(result, name)
        assert "at the contact spots, in the boundary film of 1 nm" in title
        assert "Maximum" not in title


@pytest.mark.slow
def test_verdict_speaks_of_the_spots():
    result = solve(POINT.replace(discharge={"dielectric_strength": "15 V/um"}), beside_smooth=False)
    verdict, found = result.verdict, result.asperities
    assert verdict.level == "red"
    assert f"asperities are in contact in {found.spots.number} spot" in verdict.text
    assert f"The contact is {found.electrical.behaviour}" in verdict.text
    # The heading of the traffic light says the same.
    lead = {"resistive": "The spots conduct", "intermittent": "Discharges expected"}[
        found.electrical.behaviour
    ]
    assert verdict.heading == lead
    rows = {row.key: row for row in result_rows(result)}
    assert "discharge.breakdown_voltage" not in rows
    assert rows["asperities.breakdown_5"].value == found.electrical.breakdown_5
    assert f"{found.electrical.breakdown_5:.2g} V" in finding(result, known.BREAKDOWN_FIGURE)
    assert "breakdown-expected" not in [warning.code for warning in result.warnings]


def test_surfaces_that_do_not_touch_have_no_spots():
    fast = LINE.to_dict()["contact"] | {"entrainment_speed": 4.0}
    rough = LINE.to_dict()["roughness"][0] | {"amplitude": 1e-8}
    table = LINE.to_dict() | {"contact": fast, "roughness": [rough], "grid": {"nodes": 401}}
    result = solve(Case.from_dict(table), beside_smooth=False)
    found = result.asperities
    assert (found.spots.number, found.touching.load_share, found.coarser) == (0, 0.0, None)
    assert found.electrical.behaviour == "capacitive"
    assert not any("asperities" in row.name for row in result_rows(result))
    assert known.SPOTS_FIGURE not in [f"{name}.png" for name in figure_names(result)]
    assert solve(Case.from_dict(table | {"roughness": []})).asperities is None


@pytest.mark.slow
@BOTH
def test_figure_of_the_spots(geometry):
    result = solved(geometry)
    assert f"{figure_names(result)[-1]}.png" == known.SPOTS_FIGURE
    drawn = figure(result, known.SPOTS_FIGURE)
    legend = [text.get_text() for text in drawn.axes[0].get_legend().get_texts()]
    assert "contact spots" in legend
