"""Table ``grid``: nodes that are given, and errors of the film to which a grid is refined."""

import pytest

from ehlectric import Case, solve
from tests.helpers.each import each

LINE = {
    "contact": {
        "reduced_radius": 0.0141,
        "reduced_modulus": 226e9,
        "load_per_length": 1.57e6,
        "entrainment_speed": 4.0,
    },
    "lubricant": {"base": "paper"},
}
POINT = {
    "contact": {
        "geometry": "point",
        "radius_x": 0.01,
        "radius_y": 0.01,
        "reduced_modulus": 226e9,
        "load": 20.0,
        "entrainment_speed": 2.0,
    },
    "lubricant": {"base": "paper"},
}
WAVE = {"surface": 1, "generator": "sinusoid", "amplitude": "50 nm", "wavelength": "50 um"}


def grid_of(tables, **grid):
    return Case.from_dict({**tables, "grid": grid}).grid


@each(
    "tables, grid, target, nodes",
    [
        (LINE, {}, 0.01, 401),
        (POINT, {}, 0.02, 129),
        (LINE, {"error": "0.5 %"}, 0.005, 401),
        (LINE, {"nodes": 801}, None, 801),
        (POINT, {"nodes": 65}, None, 65),
        (POINT, {"nodes_y": 129}, None, 257),
        (LINE, {"nodes": 801, "refine": "2 %"}, 0.02, 801),
        (LINE, {"refine": "2 %"}, 0.02, 401),
    ],
)
def test_a_grid_has_nodes_or_an_error_of_the_film(tables, grid, target, nodes):
    found = grid_of(tables, **grid)
    assert found.target == target
    assert found.first().nodes == nodes
    assert found.nodes == grid.get("nodes")


def test_the_first_grid_of_a_long_domain_has_no_larger_spacing():
    """The default domain is six half-widths long and has 400 intervals."""
    for inlet in (-3.0, -4.0, -10.0, -30.0, -200.0):
        grid = grid_of(LINE, inlet=inlet)
        assert grid.length / (grid.first().nodes - 1) <= 1.01 * 6.0 / 400


def test_nodes_and_error_replace_one_another():
    case = Case.from_dict({**LINE, "grid": {"error": 0.02}})
    given = case.replace({"grid.nodes": 801})
    assert (given.grid.nodes, given.grid.error, given.grid.target) == (801, None, None)
    again = given.replace({"grid.error": 0.03})
    assert (again.grid.nodes, again.grid.target) == (None, 0.03)


def test_roughness_and_motion_begin_on_a_grid_that_can_have_waves():
    rough = Case.from_dict({**LINE, "roughness": [WAVE]})
    assert (rough.first_grid.nodes, rough.grid.target) == (3201, 0.01)
    smooth = rough.replace({"roughness": []})
    assert (smooth.first_grid.nodes, smooth.grid.target) == (401, 0.01)
    moving = {**POINT, "roughness": [WAVE], "motion": {"passes": 1.0}}
    assert Case.from_dict(moving).first_grid.nodes == 257
    assert Case.from_dict(moving).grid.target is None


@pytest.mark.slow
@pytest.mark.parametrize(("tables", "asked"), [(LINE, 0.01), (LINE, 0.001), (POINT, 0.02)])
def test_the_error_that_was_asked_for_is_reached_and_said(tables, asked):
    case = Case.from_dict(tables if asked != 0.001 else {**tables, "grid": {"error": asked}})
    result = solve(case)
    film = result.summary()["film"]
    assert film["target_error"] == asked
    assert film["discretisation_error"] <= asked
    x, y = (result.film.axes[0] / result.film.scales.length, result.film.axes[-1])
    given = {"grid.inlet": x[0], "grid.outlet": x[-1], "grid.nodes": 3201}
    if tables is POINT:
        given |= {"grid.side": y[-1] / result.film.semi_axis_y, "grid.nodes": 257}
    fine = solve(case.replace(given)).film
    for name in ("minimum_thickness", "central_thickness"):
        assert getattr(result.film, name) == pytest.approx(getattr(fine, name), rel=asked)


def test_a_rough_grid_that_needs_too_many_nodes_says_so(monkeypatch):
    """The roughness of noise is never resolved, so its refinement ends after some grids."""
    monkeypatch.setattr("ehlectric.contact.contact_refinement._MOST_DOUBLED_ROUGH", {"line": 1})
    result = solve(
        Case.from_dict({**LINE, "roughness": [WAVE], "grid": {"error": 1e-4}}), beside_smooth=False
    )
    assert result.film.x.size == 6401
    said = [str(warning) for warning in result.warnings if warning.code == "refine-not-reached"]
    assert said[0].startswith("grid.error: ")
    assert " 0.01 % " in said[0]
    assert " 6401 nodes" in said[0]
