"""Figures of the contact page have the values of the result."""

import json
from dataclasses import replace

import numpy as np
import pytest

from ehlectric import Case
from ehlectric.app.charts.line_charts import line_figures
from ehlectric.app.charts.plotly_panels import values
from ehlectric.app.charts.point_charts import point_cuts, point_figures, reach_of
from ehlectric.app.compute.contact_answers import answer_of
from ehlectric.contact.solver import solve
from ehlectric.figures.contact_profiles import Line, heat
from tests.conftest import PAPER_CONTACT
from tests.helpers.hot_cases import HOT_LINE
from tests.helpers.places import EXAMPLES


@pytest.fixture(scope="module")
def line():
    return solve(Case.from_toml(EXAMPLES / "line_contact.toml"))


@pytest.fixture(scope="module")
def point():
    return solve(Case.from_toml(EXAMPLES / "ball_contact.toml").replace({"grid.nodes": 97}))


@pytest.fixture(scope="module")
def long_point():
    changes = {"grid.nodes": 97, "contact.radius_y": 0.08}
    return solve(Case.from_toml(EXAMPLES / "ball_contact.toml").replace(changes))


# Surfaces so rough that they touch: heights [m] and correlation length [m].
_ROUGH = {"surface": 1, "generator": "gaussian", "seed": 4}


@pytest.fixture(scope="module")
def touching_line():
    contact = PAPER_CONTACT | {"load_per_length": 1.57e6, "entrainment_speed": 0.05}
    rough = {**_ROUGH, "rq": 2.5e-7, "correlation_length": 5e-6}
    table = {"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 801}}
    return solve(Case.from_dict({**table, "roughness": [rough], "discharge": {"dielectric_strength": 15e6}}))


@pytest.fixture(scope="module")
def touching_point():
    case = Case.from_toml(EXAMPLES / "ball_contact.toml").replace(
        {"grid.nodes": 65, "contact.entrainment_speed": 0.05, "discharge.dielectric_strength": 15e6}
    )
    return solve(case.replace(roughness=({**_ROUGH, "rq": 1.5e-7, "correlation_length": 15e-6},)))


def all_of(*drawn):
    return [shown for figures in drawn for shown in figures.values()]


def trace(shown, name):
    (found,) = (one for one in shown.plot["data"] if one.get("name") == name)
    return found


def written(shown):
    """Figure as a browser gets it; nothing in it is no number."""
    return json.loads(json.dumps(shown.plot, allow_nan=False))


def stopped(result):
    return replace(result, film=replace(result.film, status="stalled"))


def test_curves_of_a_line_contact_keep_their_extremes(line):
    shown = line_figures(line)["profiles"]
    written(shown)
    film, field = line.film, line.field
    assert max(trace(shown, "pressure")["y"]) == pytest.approx(film.max_pressure / 1e9, rel=1e-6)
    assert min(trace(shown, "film thickness")["y"]) == pytest.approx(film.minimum_thickness * 1e6, rel=1e-6)
    walls = max(max(trace(shown, f"field at surface {k}")["y"]) for k in (1, 2))
    assert walls == pytest.approx(field.max_strength / 1e6, rel=1e-6)
    assert max(trace(shown, "Hertzian pressure")["y"]) == pytest.approx(
        line.conditions.max_pressure / 1e9, rel=1e-6
    )
    least = trace(shown, f"minimum film, {film.minimum_thickness * 1e6:.4g} µm")
    assert least["x"] == [pytest.approx(film.minimum_position * 1e6, rel=1e-6)]


def test_panels_share_the_axis_that_is_zoomed(line):
    layout = line_figures(line)["profiles"].plot["layout"]
    assert [name for name in layout if name.startswith("xaxis")] == ["xaxis"]
    assert {layout[f"yaxis{k}"]["anchor"] for k in ("", "2", "3")} == {"x"}
    assert layout["xaxis"]["title"]["text"] == "x [µm]"


def test_map_of_the_film_has_the_field_and_its_maximum(line):
    shown = line_figures(line)["section"]
    heat = written(shown)["data"][0]
    assert heat["zmax"] == pytest.approx(line.field.max_strength / 1e6)
    drawn = [value for row in heat["z"] for value in row if value is not None]
    assert max(drawn) == pytest.approx(line.field.max_strength / 1e6, rel=1e-3)
    at = shown.plot["data"][-1]
    assert at["x"] == [pytest.approx(line.field.max_strength_position * 1e6)]
    assert len(json.dumps(shown.plot)) < 500_000


@pytest.mark.slow
def test_figures_say_in_words_what_they_show(line, point):
    for shown in all_of(line_figures(line), point_figures(point), point_cuts(point, 0.0, 0.0)):
        assert shown.title
        assert shown.label
        assert shown.caption
    text = line_figures(line)["profiles"].label
    assert f"{1e6 * line.film.minimum_thickness:.4g} µm" in text
    assert f"{1e-6 * line.field.max_strength:.4g} V/µm" in text


def test_maps_of_a_point_contact_keep_their_extremes(point):
    figures = point_figures(point)
    film, pressure, field = (written(figures[name])["data"][0] for name in _MAPS)
    assert np.min(film["z"]) == pytest.approx(point.film.minimum_thickness * 1e6, rel=1e-4)
    assert np.max(pressure["z"]) == pytest.approx(point.film.max_pressure / 1e9, rel=1e-4)
    assert np.max(field["z"]) == pytest.approx(point.field.max_strength / 1e6, rel=1e-4)
    j, i = np.unravel_index(np.argmin(film["z"]), np.shape(film["z"]))
    # The film is symmetric, so that the smallest may be on either side.
    at = np.array([film["x"][i], abs(film["y"][j])])
    assert at == pytest.approx(1e6 * np.abs(point.film.minimum_position), rel=1e-5)


_MAPS = ("film-map", "pressure-map", "field-map")


def test_thinned_surface_keeps_smallest_film_and_largest_field(point, monkeypatch):
    monkeypatch.setattr("ehlectric.app.charts.point_charts._MOST", 12)
    shown = point_figures(point)["surface"]
    surface = written(shown)["data"][0]
    gap = point.field.z[:, :, -1] - point.field.z[:, :, 0]
    assert np.shape(surface["z"]) == np.shape(surface["surfacecolor"])
    assert max(np.shape(surface["z"])) <= 12 < gap.shape[0]
    assert np.min(surface["z"]) == pytest.approx(1e6 * np.min(gap), rel=1e-5)
    assert np.max(surface["surfacecolor"]) == pytest.approx(point.field.max_strength / 1e6, rel=1e-5)
    assert f"of {gap.shape[0]} x {gap.shape[1]} nodes" in shown.caption
    # The smallest film of the whole domain is marked, whatever is drawn.
    pin = shown.plot["data"][1]
    assert pin["z"][0] == pytest.approx(1e6 * point.film.minimum_thickness)
    assert (pin["x"][0], pin["y"][0]) == (pin["x"][1], pin["y"][1])


def test_cuts_run_through_the_nodes_nearest_to_the_point(point):
    at = point.film.minimum_position
    cuts = point_cuts(point, *at)
    for name in ("cut-x", "cut-y"):
        film = trace(cuts[name], "film thickness")
        assert min(film["y"]) == pytest.approx(1e6 * point.film.minimum_thickness, rel=1e-6)
    field = trace(cuts["cut-x"], "maximum field across the film")
    x, y = point.field.max_strength_position
    through = point_cuts(point, x, y)["cut-x"]
    assert max(trace(through, "maximum field across the film")["y"]) == pytest.approx(
        point.field.max_strength / 1e6, rel=1e-6
    )
    assert max(field["y"]) <= point.field.max_strength / 1e6 * (1.0 + 1e-9)
    reach = reach_of(point)
    assert reach.at == pytest.approx([1e6 * place for place in at])
    assert reach.x[0] < 0.0 < reach.x[1]


def test_hertz_pressure_of_a_cut_is_that_of_the_dry_contact(long_point):
    cuts = point_cuts(long_point, 0.0, 0.0)
    conditions = long_point.conditions
    for name, edge in (("cut-x", conditions.semi_axis_x), ("cut-y", conditions.semi_axis_y)):
        hertz = trace(cuts[name], "Hertzian pressure")
        assert max(hertz["y"]) == pytest.approx(conditions.max_pressure / 1e9, rel=1e-3)
        inside = [abs(x) for x, y in zip(hertz["x"], hertz["y"], strict=True) if y > 0.0]
        assert max(inside) == pytest.approx(1e6 * edge, rel=0.1)


def test_dashed_lines_of_a_cut_are_the_edges_of_the_dry_contact_there(long_point):
    b, a = long_point.conditions.semi_axes
    for off in (0.0, 0.6, -0.8):
        cuts = point_cuts(long_point, off * b, off * a)
        for name, along, across in (
            ("cut-x", long_point.film.x / b, long_point.film.y / a),
            ("cut-y", long_point.film.y / a, long_point.film.x / b),
        ):
            # The cut runs through the node nearest to the point.
            place = across[np.argmin(np.abs(across - off))]
            edges = [shape["x1"] for shape in cuts[name].plot["layout"]["shapes"]]
            length = 1e6 * (b if name == "cut-x" else a)
            ends = np.array(edges) / length
            assert ends**2 + place**2 == pytest.approx([1.0, 1.0])
            assert ends[1] == -ends[0]
            assert f"{edges[1]:.4g} µm" in cuts[name].caption
            # Beyond its edges the dry contact carries nothing.
            hertz = trace(cuts[name], "Hertzian pressure")["y"]
            assert not any(np.array(hertz)[np.abs(along) > ends[1] + 1e-9])


def test_cut_beside_the_dry_contact_has_no_edges(long_point):
    b, _ = long_point.conditions.semi_axes
    cut = point_cuts(long_point, 1.3 * b, 0.0)["cut-y"]
    assert not cut.plot["layout"]["shapes"]
    assert "outside" in cut.caption


def test_long_contacts_lie_along_the_page(long_point):
    layout = point_figures(long_point)["film-map"].plot["layout"]
    assert layout["xaxis"]["title"]["text"].startswith("y [")
    low, high = layout["yaxis"]["range"]
    assert low > high  # entrainment points down
    edge = layout["shapes"][0]
    assert edge["x1"] == pytest.approx(1e6 * long_point.conditions.semi_axis_y)
    assert reach_of(long_point).turned


def test_what_did_not_converge_is_not_drawn_as_a_solution(line, point):
    (shown,) = line_figures(stopped(line)).values()
    assert "NOT CONVERGED" in shown.plot["layout"]["annotations"][0]["text"]
    assert {one["line"]["color"] for one in shown.plot["data"]} == {"#777777"}
    figures = point_figures(stopped(point))
    assert list(figures) == ["film-map", "pressure-map"]
    for one in figures.values():
        assert one.plot["data"][0]["colorscale"] == "Greys"
        assert "NOT CONVERGED" in one.plot["layout"]["annotations"][0]["text"]
    assert "did not converge" in figures["film-map"].label


def test_values_that_are_no_numbers_are_not_drawn(line, point):
    for result, figures in ((line, line_figures), (point, point_figures)):
        thickness = np.full_like(result.film.thickness, np.nan)
        broken = replace(result, film=replace(result.film, thickness=thickness, status="diverged"))
        assert figures(broken) == {}


def test_values_have_digits_and_gaps():
    assert values([1.23456789, np.nan, 0.0, -1e-9, np.inf], 4) == [1.235, None, 0.0, -1e-9, None]
    assert values(np.array([[1.0, 2.0]])) == [[1.0, 2.0]]


@pytest.mark.slow
def test_spots_of_a_line_contact_are_drawn_where_its_film_touches(touching_line):
    film = touching_line.film
    assert film.converged
    assert film.contact.any()
    shown = line_figures(touching_line)["profiles"]
    written(shown)
    spots = trace(shown, "contact spots")
    assert spots["x"] == pytest.approx(1e6 * film.x[film.contact], rel=1e-6)
    # The film is drawn in µm, although it is 1 nm thick at the spots.
    assert spots["y"] == pytest.approx([1e-3] * len(spots["x"]), rel=1e-4)
    asperities = trace(shown, "pressure of asperities")
    assert max(asperities["y"]) == pytest.approx(film.contact_pressure.max() / 1e9, rel=1e-6)
    assert np.count_nonzero(asperities["y"]) == film.contact.sum()
    # The field in the boundary film would make that of the oil a line at zero.
    top = shown.plot["layout"]["yaxis3"]["range"][1]
    assert top < 0.5 * max(max(trace(shown, f"field at surface {k}")["y"]) for k in (1, 2))
    assert "boundary film of 1 nm" in shown.caption


@pytest.mark.slow
def test_spots_of_a_point_contact_are_marked_and_the_cuts_go_through_one(touching_point):
    film = touching_point.film
    assert film.converged
    assert film.contact.any()
    shown = point_figures(touching_point)
    i, j = np.nonzero(film.contact)
    for name in ("film-map", "pressure-map", "field-map"):
        written(shown[name])
        spots = trace(shown[name], "contact spots")
        found = sorted(zip(spots["x"], spots["y"], strict=True))
        expected = sorted(zip(1e6 * film.x[i], 1e6 * film.y[j], strict=True))
        # Numbers of the page have seven digits.
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9)
    reach = reach_of(touching_point)
    for cut in point_cuts(touching_point, *(1e-6 * at for at in reach.at)).values():
        written(cut)
        most = max(trace(cut, "pressure of asperities")["y"])
        assert most == pytest.approx(film.contact_pressure.max() / 1e9, rel=1e-6)
        assert min(trace(cut, "contact spots")["y"]) == pytest.approx(1.0, rel=1e-4)
    assert reach.first == "the spot of the highest pressure"


def test_surfaces_that_do_not_touch_have_no_spots(line, point):
    drawn = all_of(line_figures(line), point_figures(point), point_cuts(point, 0.0, 0.0))
    names = {one.get("name") for shown in drawn for one in shown.plot["data"]}
    assert not names & {"contact spots", "pressure of asperities"}
    assert reach_of(point).first == "the smallest film"


@pytest.mark.slow
def test_numbers_of_surfaces_that_touch_say_so(touching_line, touching_point):
    for result in (touching_line, touching_point):
        numbers = {one.key: one for one in answer_of(result).shown}
        assert (numbers["film.minimum_thickness"].text, numbers["film.minimum_thickness"].unit) == (
            "0.001",
            "µm",
        )
        assert "boundary film" in numbers["film.minimum_thickness"].note
        mean = 1e6 * result.film.mean_thickness
        assert float(numbers["film.mean_thickness"].text) == pytest.approx(mean, rel=1e-3)
        assert "boundary film" in numbers["field.max_strength"].note
        assert "discharge.breakdown_voltage" not in numbers


_TEMPERATURES = {"mid-film", "surface 1", "surface 2", "oil in the inlet"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("film", "title", "curves"),
    [
        (
            {"thermal": True, "rheology": "eyring"},
            "temperature",
            _TEMPERATURES,
        ),
        ({"rheology": "eyring"}, "shear stress", {"shear stress at mid-film", "pressure"}),
    ],
)
def test_heat_and_shear_have_a_panel(film, title, curves):
    bodies = {"temperature_1": "20 degC", "temperature_2": "120 degC"} if "thermal" in film else {}
    result = solve(Case.from_dict(HOT_LINE | {"contact": HOT_LINE["contact"] | bodies, "film": film}))
    (panel,) = heat(Line.through(result, 1.0))
    assert panel.title == title
    assert {curve.name.partition(" ×")[0] for curve in panel.curves} == curves
    values = np.concatenate([curve.y for curve in panel.curves])
    assert panel.bottom <= values.min()
    assert 0.0 < values.max() < panel.top
    assert title in line_figures(result)["profiles"].label
