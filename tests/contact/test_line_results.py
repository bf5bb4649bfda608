"""Results: their summary, dataset, files and what they warn of."""

import dataclasses
import json
import re
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import numpy as np
import pytest
from threadpoolctl import ThreadpoolController

from ehlectric import Case, ConvergenceError, InputError, load, save, solve
from ehlectric.contact.contact_solution import line_roughness
from ehlectric.contact.solver import solve as solve_case
from ehlectric.runtime.files import whole
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each


def test_dataset_has_units_and_provenance(paper_result):
    dataset = paper_result.to_xarray()
    for variable in dataset.variables.values():
        assert variable.attrs["units"]
        assert variable.attrs["long_name"]
    assert dataset.attrs["Conventions"].startswith("CF-")
    assert paper_result.version in dataset.attrs["history"]
    assert dataset["strength"].dims == ("x_field", "s")
    assert dataset["pressure"].attrs["units"] == "Pa"
    assert dataset.sizes["step"] == len(paper_result.film.steps)


def test_results_survive_the_disk(paper_result, tmp_path):
    files = save(paper_result, tmp_path / "new" / "folder")
    assert [path.name for path in files] == ["summary.json", "result.nc", "film.csv"]
    back = load(files[1])
    assert back.summary() == paper_result.summary()
    assert back.case == paper_result.case
    for part in ("film", "field"):
        for field in dataclasses.fields(getattr(back, part)):
            original = getattr(getattr(paper_result, part), field.name)
            read = getattr(getattr(back, part), field.name)
            if isinstance(original, np.ndarray):
                np.testing.assert_array_equal(read, original)
            else:
                assert read == original


def test_csv_has_units_in_its_header(paper_result, tmp_path):
    *_, path = save(paper_result, tmp_path)
    header, first = path.read_text().splitlines()[:2]
    assert header == "x [m],pressure [Pa],thickness [m],density ratio [-]"
    assert len(first.split(",")) == 4


@pytest.mark.slow
@pytest.mark.gate
def test_other_netcdf_files_are_refused(paper_result, tmp_path):
    paper_result.to_xarray().drop_vars("pressure").to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(InputError, match="damaged: pressure "):
        load(tmp_path / "other.nc")


@pytest.mark.slow
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_damaged_results_are_refused(paper_result, tmp_path, value):
    dataset = paper_result.to_xarray().copy(deep=True)
    dataset["thickness"][7] = value
    dataset.to_netcdf(tmp_path / "damaged.nc", engine="h5netcdf")
    paper_result.to_xarray().isel(s=slice(0, 1)).to_netcdf(tmp_path / "empty.nc", engine="h5netcdf")
    for name in ("damaged.nc", "empty.nc"):
        with pytest.raises(InputError, match="is damaged: "):
            load(tmp_path / name)


def test_file_is_whole_or_not_there(tmp_path):
    path = tmp_path / "file.txt"
    path.write_text("old")

    def write_half():
        with whole(path) as beside:
            beside.write_text("ha")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_half()
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [("file.txt", "old")]


def test_summary_is_json_without_nan(paper_result):
    broken = dataclasses.replace(
        paper_result, film=dataclasses.replace(paper_result.film, residual=float("nan"))
    )
    summary = json.loads(json.dumps(broken.summary(), allow_nan=False))
    assert summary["film"]["residual"] is None


def test_definitions_of_the_summary(paper_result):
    """The definitions again, from the arrays."""
    film, field = paper_result.film, paper_result.field
    summary = paper_result.summary()
    b = summary["hertz"]["half_width"]
    assert summary["film"]["minimum_thickness"] == film.thickness.min()
    assert film.x[np.argmin(film.thickness)] == summary["film"]["minimum_position"]
    fine = np.linspace(-b, b, 200_001)
    mean = np.mean(np.interp(fine, film.x, film.thickness))
    assert summary["film"]["mean_thickness"] == pytest.approx(mean, rel=1e-5, abs=0.0)
    load = np.trapezoid(film.pressure, film.x)
    assert load == pytest.approx(summary["inputs"]["contact"]["load_per_length"], rel=1e-9, abs=0.0)
    walls = np.max(field.strength[:, [0, -1]])
    assert summary["field"]["max_strength"] == max(walls, np.max(field.middle_strength))
    assert summary["field"]["voltage"] == 2.0


def test_sections_and_thin_gap_error_again(paper_result):
    film, field = paper_result.film, paper_result.field
    # Degree 6 has a node at s = 1/2.
    assert field.s[3] == pytest.approx(0.5, abs=1e-15)
    np.testing.assert_allclose(field.middle_strength, field.strength[:, 3], rtol=1e-12)
    error = (field.max_strength - 2.0 / film.thickness.min()) / field.max_strength
    assert paper_result.summary()["field"]["thin_gap_error"] == pytest.approx(error, rel=1e-9, abs=0.0)
    assert error > 0.0  # the walls of a constriction concentrate the field
    assert paper_result.film.newton_iterations == sum(step.nodes == 3201 for step in film.steps) > 0


def test_thin_gap_error_without_the_minimum(paper_case):
    result = solve(paper_case.replace({"grid.field_range": [0.2, 0.5], "grid.nodes": 801}))
    assert result.summary()["field"]["thin_gap_error"] is None
    assert result.summary()["field"]["central_dimensionless"] is None


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("speed", [4.0, 16.0])
def test_inlet_deficit_is_what_the_film_lacks(paper_case, speed):
    """Against a domain ten times as long; a film goes with some 3/4 power of its inlet integral."""
    case = paper_case.replace({"contact.max_hertz_pressure": "0.5 GPa", "contact.entrainment_speed": speed})
    short = solve(case.replace({"grid.inlet": -3.0, "grid.nodes": 1001})).film
    long = solve(case.replace({"grid.inlet": -30.0, "grid.nodes": 6401})).film
    lacking = 1.0 - short.central_thickness / long.central_thickness
    assert lacking > 0.02
    assert 0.6 < lacking / short.inlet_deficit < 1.1


def test_surfaces_of_unequal_bodies():
    """Each wall has its own curvature and its own part of the deflection, up to a common displacement."""
    soft = {"youngs_modulus": 100e9, "poissons_ratio": 0.3}
    stiff = {"youngs_modulus": 300e9, "poissons_ratio": 0.2}
    contact = {"radius_1": 0.03, "radius_2": 0.06, "body_1": soft, "body_2": stiff}
    contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": 4.0}
    result = solve(
        Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 801}})
    )
    film, lower = result.film, result.field.y[1:-1, 0]
    inside = np.isin(film.x, result.field.x[1:-1])
    part = (1 - 0.3**2) / 100e9
    part /= part + (1 - 0.2**2) / 300e9
    expected = -(film.x**2 / (2 * 0.03) + part * film.deflection)[inside]
    np.testing.assert_allclose(lower - lower[0], expected - expected[0], atol=1e-15)
    np.testing.assert_allclose(result.field.y[1:-1, -1] - lower, film.thickness[inside], rtol=1e-12)


def test_threads_share_the_limit_on_blas(paper_case):
    """After concurrent solutions the libraries have their threads back, and the films are the same."""
    libraries = ThreadpoolController().select(user_api="blas")
    before = [library["num_threads"] for library in libraries.info()]
    case = paper_case.replace({"grid.nodes": 801})
    with ThreadPoolExecutor(4) as pool:
        films = list(pool.map(lambda _: solve(case).film.thickness, range(8)))
    assert [library["num_threads"] for library in libraries.info()] == before
    for film in films:
        np.testing.assert_array_equal(film, films[0])


@pytest.mark.slow
@pytest.mark.gate
def test_a_tolerance_below_rounding_is_not_chased(paper_case):
    case = paper_case.replace({"solver.tolerance": 1e-11, "grid.nodes": 25_601})
    film = solve(case).film
    assert film.converged
    assert film.residual < 1e-9
    assert film.minimum_thickness == pytest.approx(0.639e-6, rel=1e-3, abs=0.0)


def test_surfaces_of_equal_bodies_lie_at_half_the_film(paper_result):
    field, film = paper_result.field, paper_result.film
    # The two ends of the range lie between nodes of the film.
    half = 0.5 * np.interp(field.x, film.x, film.thickness)[1:-1]
    np.testing.assert_allclose(field.y[1:-1, -1], half, rtol=1e-12)
    np.testing.assert_allclose(field.y[1:-1, 0], -half, rtol=1e-12)


def test_equal_walls_have_one_name_whatever_the_rounding(paper_result):
    """Both walls of equal bodies have the same field, whose last digit depends on the processor."""
    field = paper_result.field
    assert np.max(field.strength[..., 0]) == pytest.approx(np.max(field.strength[..., -1]), rel=1e-9)
    for wall in (0, -1):
        strength = field.strength.copy()
        strength[..., wall] *= 1.0 + 1e-12
        assert dataclasses.replace(field, strength=strength).max_strength_wall == "surface 1"


def test_film_nodes_carry_the_field(paper_result):
    inside = paper_result.field.x[1:-1]
    assert np.all(np.isin(inside, paper_result.film.x))


def test_field_nodes_on_request(paper_case, paper_result):
    result = solve(paper_case.replace({"grid.field_nodes": 4001, "grid.field_range": [-1.0, 1.1]}))
    b = result.conditions.half_width
    np.testing.assert_allclose(result.field.x, b * np.linspace(-1.0, 1.1, 4001))
    assert result.field.max_strength == pytest.approx(paper_result.field.max_strength, rel=1e-4, abs=0.0)


def test_field_across_a_bent_gap(paper_result):
    """A roller in a tight concave ring: the gap is bent as a whole, and its normal width is h cos(slope)."""
    contact = PAPER_CONTACT | {"radius_1": 14.1e-3 / 3, "radius_2": -14.1e-3 / 2}
    del contact["reduced_radius"]
    grid = {"nodes": 3201}
    result = solve(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": grid}))
    np.testing.assert_allclose(result.film.thickness, paper_result.film.thickness, rtol=1e-9)
    assert abs(result.field.y[:, 0]).max() > 5 * abs(paper_result.field.y[:, 0]).max()
    slope = result.film.minimum_position / (14.1e-3 / 2.5)
    expected = paper_result.field.max_strength * np.hypot(1.0, slope)
    assert result.field.max_strength == pytest.approx(expected, rel=1e-3, abs=0.0)


SLOW, ISOVISCOUS = {"contact.entrainment_speed": 0.5}, {"lubricant.viscosity_law": "constant"}
# Changes of the case, words of a warning, and its code.
WARNINGS = [
    ({"grid.inlet": -1.3, "contact.entrainment_speed": 40.0}, "inlet", "inlet-far-too-short"),
    ({"grid.inlet": -1.5}, r"grid.inlet .* -1.5 .* -[2-4]", "inlet-too-short"),
    ({"grid.outlet": 1.01, "grid.field_range": [-1.1, 1.0]}, "cavitate", "outlet-too-short"),
    (
        {"grid.nodes": 129, "contact.entrainment_speed": 0.5},
        "do not use",
        "coarser-grid-unsolved",
    ),
    (
        {"grid.nodes": 401, "grid.wedge": "second-order", "contact.entrainment_speed": 0.5},
        "do not use",
        "grid-far-too-coarse",
    ),
    ({"grid.field_nodes": 50}, "grid.field_nodes .* 50", "field-grid-too-coarse"),
    (
        {"solver.max_iterations": 1},
        "do not use .*stalled",
        "not-converged",
    ),
    (
        {"lubricant.viscosity_law": "constant", "contact.load_per_length": 1e5},
        "isoviscous-elastic",
        "regime",
    ),
    ({"grid.field_range": [0.2, 0.975]}, "grid.field_range", "field-range-too-narrow"),
    ({"contact.load_per_length": "3 kN/m"}, "isoviscous-rigid", "regime"),
]


@pytest.mark.slow
@pytest.mark.gate
@each("keys, message, code", WARNINGS)
def test_warnings(paper_case, keys, message, code):
    case = paper_case.replace({"grid.nodes": 801} | keys)
    result = solve(case)
    found = [warning.code for warning in result.warnings if re.search(message, warning.text)]
    assert code in found, result.warnings
    summary = result.summary()
    assert summary["warnings"] == [warning.text for warning in result.warnings]
    assert summary["warning_codes"] == [warning.code for warning in result.warnings]


def test_paper_result_needs_no_warning(paper_result):
    assert paper_result.warnings == ()


@pytest.mark.slow
def test_roughness_higher_than_the_film_touches(paper_case):
    """The smooth film stands beside it; the minimum is the boundary film, and its error is not known."""
    rough = {"surface": 2, "generator": "gaussian", "rq": "400 nm", "correlation_length": "20 um", "seed": 1}
    changes = {"contact.max_hertz_pressure": "1 GPa", "contact.entrainment_speed": 0.02, "grid.nodes": 801}
    result = solve(paper_case.replace(changes | {"roughness": [rough]}))
    assert result.converged
    assert result.smooth is not None
    assert 1e-9 < result.smooth.minimum_thickness < 200e-9
    assert result.film.minimum_thickness == pytest.approx(1e-9, rel=1e-6)
    assert result.summary()["film"]["discretisation_error"] is None
    assert "asperities-touch" in [warning.code for warning in result.warnings]


def test_the_caller_may_ask_for_a_solution_or_nothing(paper_case):
    case = paper_case.replace({"solver.max_iterations": 1, "grid.nodes": 401})
    assert not solve(case).converged
    with pytest.raises(ConvergenceError, match="stalled"):
        solve(case, require_convergence=True)


def test_progress_is_reported(paper_case):
    seen = []
    solve_case(paper_case.replace({"grid.nodes": 801}), progress=lambda *step: seen.append(step))
    nodes, steps, residuals = zip(*seen, strict=True)
    assert nodes[-1] == 801
    assert steps[0] == 0
    assert all(residual > 0 for residual in residuals)


def test_results_are_reproducible(paper_case, paper_result):
    again = solve(paper_case)
    np.testing.assert_array_equal(again.film.thickness, paper_result.film.thickness)
    np.testing.assert_array_equal(again.field.strength, paper_result.field.strength)


def test_dataset_shares_no_array_with_the_result(paper_case):
    result = solve(paper_case.replace({"grid.nodes": 801}))
    dataset = result.to_xarray()
    dataset["thickness"][:] = 1.0
    assert result.film.minimum_thickness < 1e-5


def test_film_that_gapes_is_no_reason_to_stop():
    """A film not found, metres wide over columns of nanometres: everything is given back all the same."""
    contact = {"reduced_radius": 0.01, "reduced_modulus": 1e12}
    contact |= {"max_hertz_pressure": 1.26e6, "entrainment_speed": 1e4}
    lubricant = {"base": "paper", "viscosity_law": "barus"}
    result = solve(Case.from_dict({"contact": contact, "lubricant": lubricant, "grid": {"nodes": 85}}))
    assert not result.converged
    assert np.all(np.isfinite(result.field.strength))


@each("sign", [1.0, -1.0])
def test_the_combined_roughness_of_equal_surfaces_is_twice_theirs_or_none(sign):
    """Heights add up: Rq of u + u is 2 Rq, and of u - u zero, within the half-width only."""
    x, lone = np.linspace(-2.0, 2.0, 81), 9.0 * (np.abs(np.linspace(-2.0, 2.0, 81)) > 1.0)
    wave = 1e-7 * (np.cos(7.0 * x) + lone)
    film, conditions = SimpleNamespace(x=x, minimum_thickness=3e-7), SimpleNamespace(half_width=1.0)
    rough = SimpleNamespace(
        film=film, conditions=conditions, roughness=np.stack([wave, sign * wave]), smooth=None
    )
    found, rq = line_roughness(rough), np.std(1e-7 * np.cos(7.0 * x[np.abs(x) <= 1.0]))
    assert (found.rq_1, found.rq_2) == pytest.approx((rq, rq), rel=1e-12)
    assert found.rq_combined == pytest.approx((1.0 + sign) * rq, rel=1e-9, abs=1e-20)
    assert found.lambda_ratio == (pytest.approx(3e-7 / (2.0 * rq), rel=1e-9) if sign > 0.0 else None)
