"""Results of point contacts: their summary, dataset, files, grids that are refined, and what they warn of."""

import json
import re
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric import Case, InputError, load, save, solve
from ehlectric.contact import contact_memory
from ehlectric.contact.conditions import resolve_point
from ehlectric.contact.preparation import prepare
from ehlectric.contact.problems import point_film_problem
from ehlectric.film.isothermal_film import solve_point_film
from ehlectric.formulas import film_point
from tests.cases.test_point_case import point
from tests.conftest import PAPER_CONTACT
from tests.contact.test_files import assert_equal, powers_of_ten
from tests.helpers.each import each
from tests.helpers.strategies import discharges

SLOW = partial(pytest.param, marks=pytest.mark.slow)
FILM_KEYS = {
    "minimum_thickness", "minimum_position", "central_thickness", "mean_thickness", "max_pressure",
    "load_residual", "residual", "newton_iterations", "discretisation_error", "solver", "nodes",
    "max_pressure_error", "inlet_deficit", "side_deficit", "target_error",
}  # fmt: skip
# DESIGN: those of the line contact where they mean the same, capacitance and high_field_area in their place.
FIELD_KEYS = {
    "voltage", "max_strength", "max_strength_position", "max_dimensionless", "central_dimensionless",
    "high_field_area", "capacitance", "thin_gap_error", "columns", "max_strength_wall", "solver",
}  # fmt: skip
PIT = {"surface": 1, "generator": "pit", "depth": "0.1 um", "width": "60 um", "position_y": "30 um"}


@pytest.fixture(scope="module")
def result():
    """With different numbers of nodes along and across."""
    return solve(ellipse(73))


def ellipse(nodes, **grid):
    contact = {"radius_y": "30 mm", "load": "50 N", "entrainment_speed": "4 m/s"}
    return point(contact, grid={"nodes": nodes, "nodes_y": 49} | grid, title="An ellipse")


@pytest.fixture(scope="module")
def rough_result():
    return solve(point({"entrainment_speed": "4 m/s"}, grid={"nodes": 65}, roughness=[PIT]))


@pytest.mark.slow
@pytest.mark.gate
def test_summary_has_the_agreed_keys(result, rough_result):
    summary = json.loads(json.dumps(result.summary(), allow_nan=False))
    assert set(summary) == {
        "schema", "version", "title", "converged", "status", "warnings", "warning_codes", "inputs",
        "lubricant", "groups", "hertz", "film", "field", "film_formulas", "film_formula_ranges", "seconds",
    }  # fmt: skip
    assert summary["schema"] == "ehlectric.summary/1"
    assert (summary["converged"], summary["status"]) == (True, "converged")
    assert set(summary["groups"]) == {"moes_m", "moes_l"}
    assert set(summary["hertz"]) == {"semi_axis_x", "semi_axis_y", "max_pressure"}
    assert set(summary["film"]) == FILM_KEYS
    assert set(summary["field"]) >= FIELD_KEYS
    assert set(summary["film_formulas"]) == set(film_point.FORMULAS)
    assert set(summary["film_formulas"]) >= {"hamrock_dowson", "chittenden", "nijenbanning_venner_moes"}
    for formula in summary["film_formulas"].values():
        assert set(formula) == {"minimum_thickness", "central_thickness"}
    assert set(summary["seconds"]) == {"film", "field"}
    assert "roughness" not in summary
    rough = json.loads(json.dumps(rough_result.summary(), allow_nan=False))["roughness"]
    assert set(rough) == {
        "surfaces", "rq_1", "rq_2", "rq_combined", "combined", "lambda_ratio", "lambda_ratio_smooth",
        "smooth_minimum_thickness",
    }  # fmt: skip


def test_definitions_of_the_summary(result):
    """The definitions again, from the arrays."""
    film, field, summary = result.film, result.field, result.summary()
    b, a = summary["hertz"]["semi_axis_x"], summary["hertz"]["semi_axis_y"]
    assert film.thickness.shape == (73, 49)
    assert summary["film"]["nodes"] == [73, 49]
    i, j = np.unravel_index(np.argmin(film.thickness), film.thickness.shape)
    assert summary["film"]["minimum_thickness"] == film.thickness[i, j]
    assert summary["film"]["minimum_position"] == [film.x[i], film.y[j]]
    middle = np.interp(0.0, film.x, film.thickness[:, 24])
    assert film.y[24] == 0.0
    assert summary["film"]["central_thickness"] == pytest.approx(middle, rel=1e-12, abs=0.0)
    carried = np.trapezoid(np.trapezoid(film.pressure, film.y, axis=1), film.x)
    assert carried == pytest.approx(50.0, rel=1e-9, abs=0.0)
    # Of many points of the ellipse at random the mean film by linear interpolation.
    random = np.random.default_rng(1)
    u, v = random.uniform(-1.0, 1.0, (2, 400_000))
    inside = u**2 + v**2 < 1.0
    mean, spread = (f(film._at(b * u[inside], a * v[inside])) for f in (np.mean, np.std))
    error = 4.0 * spread / np.sqrt(np.count_nonzero(inside))
    assert summary["film"]["mean_thickness"] == pytest.approx(mean, rel=0.0, abs=error)
    walls = np.max(field.strength[..., [0, -1]])
    assert summary["field"]["max_strength"] == max(walls, np.max(field.middle_strength))
    assert summary["field"]["voltage"] == 2.0
    zones = summary["field"]["capacitance_by_zone"]
    assert set(zones) == {"hertz", "inlet", "outlet", "sides"}
    assert sum(zones.values()) == pytest.approx(summary["field"]["capacitance"], rel=1e-3, abs=0.0)
    assert summary["inputs"]["contact"]["load"] == 50.0
    assert summary["inputs"]["grid"]["side"] == result.conditions.side
    assert film.x[0] == pytest.approx(-4.5 * b, rel=1e-12, abs=0.0)
    assert film.y[-1] == pytest.approx(result.conditions.side * a, rel=1e-12, abs=0.0)


def thicknesses(film):
    return np.array([film.minimum_thickness, film.central_thickness])


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("wedge", [SLOW("first-order"), "second-order"])
def test_discretisation_error_is_richardsons(wedge):
    """From two solutions of their own; of first order with the distance from the third order."""

    def film(nodes, wedge):
        case = ellipse(nodes, nodes_y=nodes, wedge=wedge)
        return solve_point_film(point_film_problem(case, resolve_point(case)))

    better = "third-order" if wedge == "first-order" else wedge
    fine, coarse = (film(nodes, better) for nodes in (129, 65))
    estimates = np.abs(thicknesses(coarse) / thicknesses(fine) - 1.0) / (2.0 ** np.array([1.25, 2.0]) - 1.0)
    found = fine
    if wedge == "first-order":
        found = film(129, wedge)
        estimates += np.abs(thicknesses(found) / thicknesses(fine) - 1.0)
    # The coarser of one solution is solved less closely than one for itself.
    assert found.discretisation_error == pytest.approx(max(estimates), rel=1e-3, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
def test_dataset_has_dimensions_and_units(rough_result):
    dataset = rough_result.to_xarray()
    for variable in dataset.variables.values():
        assert variable.attrs["units"]
        assert variable.attrs["long_name"]
    for name in (
        "pressure",
        "thickness",
        "density",
        "deflection",
        "cavitated",
        "roughness_1",
        "smooth_pressure",
    ):
        assert dataset[name].dims == ("x", "y"), name
    for name in ("strength", "potential", "field_x", "field_y", "field_z", "permittivity", "z"):
        assert dataset[name].dims == ("x_field", "y_field", "s"), name
    for name in ("middle_strength", "thin_gap_strength", "capacitance_density", "smooth_middle_strength"):
        assert dataset[name].dims == ("x_field", "y_field"), name
    assert set(dataset.coords) == {"x", "y", "x_field", "y_field", "s", "z"}
    units = {"x": "m", "y": "m", "pressure": "Pa", "thickness": "m", "strength": "V/m", "potential": "V"}
    units |= {"capacitance_density": "F/m^2", "cavitated": "1", "z": "m"}
    assert {name: dataset[name].attrs["units"] for name in units} == units
    assert dataset.attrs["title"] == "Film and electric field of a point contact"
    assert dataset.sizes["step"] == len(rough_result.film.steps)
    film = rough_result.film
    np.testing.assert_array_equal(dataset["thickness"].sel(x=0.0, method="nearest"), film.thickness[48])
    np.testing.assert_array_equal(
        dataset["strength"].values, np.sqrt(sum(dataset[f"field_{axis}"].values ** 2 for axis in "xyz"))
    )


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("kind", ["smooth", "rough"])
def test_results_survive_the_disk(request, kind, tmp_path):
    original = request.getfixturevalue("result" if kind == "smooth" else "rough_result")
    files = save(original, tmp_path / "new" / "folder")
    assert [path.name for path in files] == ["summary.json", "result.nc", "film.csv"]
    back = load(files[1])
    assert_equal(back, original)
    assert back.summary() == json.loads(files[0].read_text(encoding="utf-8"), parse_constant=pytest.fail)


def test_csv_is_the_film_node_by_node(result, tmp_path):
    *_, path = save(result, tmp_path)
    assert path.read_text().splitlines()[0] == "x [m],y [m],pressure [Pa],thickness [m],density ratio [-]"
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    film = result.film
    assert table.shape == (73 * 49, 5)
    for column, values in enumerate(
        (film.x[:, np.newaxis] + 0.0 * film.y, film.y + 0.0 * film.x[:, np.newaxis], film.pressure)
    ):
        np.testing.assert_allclose(table[:, column].reshape(73, 49), values, rtol=1e-11)
    np.testing.assert_allclose(table[:, 3].reshape(73, 49), film.thickness, rtol=1e-11)


@pytest.mark.slow
def test_damaged_results_are_refused(result, tmp_path):
    dataset = result.to_xarray()
    dataset["thickness"][7, 3] = np.nan
    damaged = {
        "nan.nc": dataset,
        "empty.nc": result.to_xarray().isel(y=slice(0, 1)),
        "other.nc": result.to_xarray().drop_vars("capacitance_density"),
    }
    for name, values in damaged.items():
        values.to_netcdf(tmp_path / name, engine="h5netcdf")
        with pytest.raises(InputError, match="is damaged: "):
            load(tmp_path / name)


# What is solved and what is not, what is rough and what is not: written alike.
contacts = st.fixed_dictionaries(
    {
        "contact": st.fixed_dictionaries(
            {
                "geometry": st.just("point"),
                "radius_x": st.just(0.01),
                "radius_y": powers_of_ten(-2.7, -1.0),
                "reduced_modulus": powers_of_ten(10.5, 12.0),
                "max_hertz_pressure": powers_of_ten(7.5, 9.5),
                "entrainment_speed": powers_of_ten(-5.0, 1.5),
            }
        ),
        "lubricant": st.fixed_dictionaries(
            {"base": st.just("paper"), "viscosity_law": st.sampled_from(["roelands", "barus", "constant"])}
        ),
        "electric": st.fixed_dictionaries(
            {"potential_1": st.just(0.0), "potential_2": powers_of_ten(-2.0, 6.0)}
        ),
        "discharge": discharges.map(lambda table: {k: v for k, v in table.items() if k != "length"}),
        "grid": st.fixed_dictionaries(
            {
                "nodes": st.integers(65, 72),
                "nodes_y": st.integers(73, 80),
                "wedge": st.sampled_from(["first-order", "second-order", "third-order"]),
            }
        ),
        "solver": st.fixed_dictionaries({"max_iterations": st.sampled_from([1, 5, 20])}),
    }
)


@pytest.mark.slow
@settings(deadline=None, max_examples=25)
@given(table=contacts)
def test_any_result_survives_the_disk(table, tmp_path_factory):
    found = solve(Case.from_dict(table))
    folder = tmp_path_factory.getbasetemp() / "round-trip-of-points"
    summary_file, result_file, _ = save(found, folder)
    written = json.loads(summary_file.read_text(encoding="utf-8"), parse_constant=pytest.fail)
    back = load(result_file)
    assert_equal(back, found)
    assert written == back.summary()
    assert written["converged"] == found.film.converged == (written["status"] == "converged")
    if not found.converged:
        assert any("the iteration did not converge" in text for text in written["warnings"])


WARNINGS = [
    ({"grid.inlet": -2.2}, " % ",
     "domain-too-small"),
    SLOW({"grid.inlet": -1.5}, "do not use", "domain-far-too-small"),
    SLOW({"grid.side": 1.3, "grid.field_side": 1.2}, "grid.inlet .*grid.side",
         "domain-too-small"),
    ({"grid.outlet": 1.01, "grid.field_range": [-1.1, 1.0]}, "cavitate", "outlet-too-short"),
    ({"contact.entrainment_speed": 0.5, "grid.wedge": "second-order"},
     "do not use", "grid-far-too-coarse"),
    SLOW({"contact.entrainment_speed": 0.1}, "do not use",
         "coarser-grid-unsolved"),
    SLOW({"grid.field_nodes": 20}, "grid.field_nodes .* 20", "field-grid-too-coarse"),
    ({"grid.field_nodes_y": 20}, "grid.field_nodes_y .* 20", "field-grid-too-coarse"),
    ({"solver.max_iterations": 1}, "do not use .*stalled", "not-converged"),
    SLOW({"contact.load": 0.02}, "isoviscous-rigid", "regime"),
    SLOW({"grid.field_side": 0.5}, "grid.field_range .*grid.field_side", "field-range-too-narrow"),
    ({"electric.potential_2": 1e4}, "insulator", "field-above-insulators"),
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("keys", "message", "code"), WARNINGS)
def test_warnings(keys, message, code):
    result = solve(point(grid={"nodes": 65}).replace(keys))
    found = [warning.code for warning in result.warnings if re.search(message, warning.text)]
    assert code in found, result.warnings
    assert result.summary()["warning_codes"] == [warning.code for warning in result.warnings]


@pytest.mark.slow
def test_domain_loss_is_about_the_true_one():
    """Against a domain with a longer inlet and wider sides: within a factor 3, where it warns."""
    near = solve(point({"entrainment_speed": "6 m/s"}, grid={"nodes": 65, "inlet": -2.5, "side": 1.5})).film
    far = solve(point({"entrainment_speed": "6 m/s"},
                      grid={"nodes": 161, "nodes_y": 257, "inlet": -8.5, "side": 6.0})).film  # fmt: skip
    assert near.x[1] - near.x[0] == pytest.approx(far.x[1] - far.x[0], rel=1e-9, abs=0.0)
    lost = 1.0 - near.central_thickness / far.central_thickness
    assert lost / 3.0 < near.domain_loss < 3.0 * lost
    assert near.domain_loss > 0.015 > far.domain_loss


LINE = {"contact": PAPER_CONTACT | {"entrainment_speed": 1.0}, "lubricant": {"base": "paper"}}
# The domain is given, so that no larger one with other nodes is taken.
OWN_DOMAIN = {"nodes": 65, "inlet": -4.5, "outlet": 1.5}
STARTS = {
    "line": (Case.from_dict(LINE | {"grid": {"nodes": 401}}), 0.01),
    "point": (point({"entrainment_speed": "4 m/s"}, grid=OWN_DOMAIN), 0.002),
    "across": (point({"entrainment_speed": "4 m/s"}, grid=OWN_DOMAIN | {"nodes_y": 81}), 0.002),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["line", "point", SLOW("across")])
def test_refined_until_the_error_is_small(kind):
    """On the first grid of twice as many intervals whose estimate is below the target, not before."""
    case, target = STARTS[kind]
    result = solve(case.replace({"grid.refine": target}))
    film = result.film
    assert film.converged
    assert film.discretisation_error <= target
    assert not any("grid.refine" in text for text in map(str, result.warnings))
    # A point contact is refined on a patch: the smallest spacing counts.
    intervals = np.ptp(film.x) / np.min(np.diff(film.x))
    doubled = intervals / (case.grid.nodes - 1)
    assert doubled == pytest.approx(round(doubled), rel=1e-9)
    assert round(doubled) in (2, 4, 8)
    before = {"grid.nodes": round(intervals) // 2 + 1}
    if kind == "across":
        assert np.ptp(film.y) / np.min(np.diff(film.y)) == pytest.approx(80 * doubled, rel=1e-9)
        before["grid.nodes_y"] = 80 * round(doubled) // 2 + 1
    coarse = solve(case.replace(before)).film
    assert coarse.discretisation_error is None or coarse.discretisation_error > target
    # What was asked for stays in the case, what came of it in the summary.
    assert result.case.grid.nodes == case.grid.nodes
    assert np.atleast_1d(result.summary()["film"]["nodes"])[0] == film.x.size


@pytest.mark.slow
def test_refined_results_survive_the_disk(tmp_path):
    case, target = STARTS["across"]
    result = solve(case.replace({"grid.refine": target, "roughness": [PIT]}))
    assert result.film.x.size > 65
    assert result.roughness.shape[1:] == result.film.thickness.shape == result.smooth.thickness.shape
    save(result, tmp_path)
    assert_equal(load(tmp_path / "result.nc"), result)


@pytest.mark.parametrize("kind", ["line", SLOW("point")])
def test_refinement_of_what_has_no_film_ends(kind):
    """Not at the memory of the machine, after hours, but after three grids without a film."""
    case = STARTS[kind][0].replace({"solver.max_iterations": 1, "grid.refine": 0.01})
    result = solve(case)
    assert not result.converged
    assert result.film.x.size == 4 * case.grid.nodes - 3
    assert any("the error is unknown on 3 grids in succession" in text for text in map(str, result.warnings))


@pytest.mark.parametrize("kind", ["line", SLOW("point")])
def test_refinement_that_does_not_get_there_is_said(kind, monkeypatch):
    """On a machine that holds the first two grids alone."""
    case, _ = STARTS[kind]
    case = case.replace({"grid.refine": 1e-4, "grid.field_nodes": 60})
    second, third = 2 * case.grid.nodes - 1, 4 * case.grid.nodes - 3

    def fits(nodes, size):
        monkeypatch.setattr(contact_memory, "available_memory", lambda: size)
        try:
            contact_memory.check_memory(case.replace({"grid.nodes": nodes}))
        except InputError:
            return False
        return True

    enough = next(size for size in np.geomspace(1e5, 1e12, 200) if fits(second, size))
    assert not fits(third, enough)
    assert fits(second, enough)
    result = solve(case)
    x = result.film.x
    assert np.ptp(x) / np.min(np.diff(x)) + 1.0 == pytest.approx(second, rel=1e-9)
    (said,) = (text for text in map(str, result.warnings) if text.startswith("grid.refine"))
    assert f"0.01 % was not reached with {second} nodes" in said
    assert "expected a grid that fits into" in said


@each("load, radius_y, inlet", [(0.05, "10 mm", -4.5), (0.02, "30 mm", -4.5), (0.05, "10 mm", -6.0)])
def test_ambient_pressure_carries_its_product_with_the_area_of_the_domain(load, radius_y, inlet):
    case = point({"load": load, "radius_y": radius_y}, grid={"nodes": 65, "inlet": inlet})
    conditions = resolve_point(case)
    (text,) = (one.text for one in prepare(case).warnings() if one.code == "ambient-pressure")
    length, width = case.grid.length * conditions.semi_axis_x, 2.0 * conditions.side * conditions.semi_axis_y
    percent = float(re.search(r"carries ([\d.]+) % of the load", text)[1])
    assert percent == pytest.approx(100.0 * 101325.0 * length * width / load, rel=0.05)
