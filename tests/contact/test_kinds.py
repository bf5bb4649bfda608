"""One course for line and point contacts: solved with and without a case, their surfaces read once."""

import contextlib
import json
from dataclasses import replace

import numpy as np
import pytest
import typer

from ehlectric import Case, InputError, save, solve
from ehlectric.commands.solve_commands import check, run
from ehlectric.contact.conditions import line_conditions, point_conditions
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.preparation import prepare
from ehlectric.contact.result import RESULTS
from ehlectric.contact.solver import DEFAULT_SOLVERS, solve_contact
from ehlectric.contact.solver import solve as solve_prepared
from ehlectric.surfaces import rough_surfaces
from ehlectric.surfaces.surface_files import read_surface
from tests.helpers.places import DEKTAK

CASES = {
    "line": {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "load_per_length": "0.4 MN/m",
            "entrainment_speed": "4 m/s",
        },
        "lubricant": {"base": "paper"},
        "grid": {"nodes": 401},
    },
    "point": {
        "contact": {
            "geometry": "point",
            "radius_x": "10 mm",
            "radius_y": "10 mm",
            "reduced_modulus": "226 GPa",
            "load": "20 N",
            "entrainment_speed": "2 m/s",
        },
        "lubricant": {"base": "paper"},
        "grid": {"nodes": 65, "field_degree": 3},
    },
}
ROUGH = {"surface": 1, "file": str(DEKTAK), "form": "line", "rescale_rq": "2 nm"}
MADE = {"surface": 2, "generator": "sinusoid", "amplitude": "5 nm", "wavelength": "200 um"}


def case_of(geometry, **tables):
    return Case.from_dict(CASES[geometry] | tables)


def conditions_of(geometry, lubricant, speed_factor=1.0, film_factor=1.0):
    """Conditions of the cases above from their numbers."""
    contact = case_of(geometry).contact
    given = {"reduced_modulus": 226e9, "film_factor": film_factor, "boundary_film": contact.touching_gap}
    given["entrainment_speed"] = speed_factor * contact.entrainment_speed
    if geometry == "line":
        return line_conditions(lubricant, reduced_radius=14.1e-3, load_per_length=4e5, **given)
    return point_conditions(lubricant, radii=(0.01, 0.01), load=20.0, **given)


@pytest.fixture
def read(monkeypatch):
    """Files that are read, in their order."""
    files = []

    def reading(path, **units):
        files.append(path)
        return read_surface(path, **units)

    for module in (rough_surfaces, rough_surfaces):
        monkeypatch.setattr(module, "read_surface", reading)
    return files


def test_each_table_has_the_same_kinds():
    assert (
        set(KINDS)
        == set(RESULTS)
        == set(DEFAULT_SOLVERS.film)
        == set(DEFAULT_SOLVERS.field)
        == {"line", "point"}
    )


@pytest.mark.slow
@pytest.mark.parametrize("refine", [{}, {"refine": "10 %"}], ids=["", "refined"])
@pytest.mark.parametrize("geometry", list(CASES))
def test_a_run_reads_each_file_once(read, tmp_path, geometry, refine):
    case = case_of(geometry, roughness=[ROUGH], grid=CASES[geometry]["grid"] | refine)
    path = tmp_path / "case.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    with contextlib.suppress(typer.Exit):  # of a film that did not converge
        run(path, output=tmp_path / "out", plots=False, quiet=True)
    assert (tmp_path / "out" / "summary.json").exists()
    assert read == [ROUGH["file"]]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("geometry", list(CASES))
def test_a_check_reads_each_file_once(read, tmp_path, geometry):
    path = tmp_path / "case.toml"
    path.write_text(case_of(geometry, roughness=[ROUGH]).to_toml(), encoding="utf-8")
    check(path, quiet=True)
    assert read == [ROUGH["file"]]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("geometry", list(CASES))
def test_without_a_case_the_result_is_that_of_the_case(geometry):
    case = case_of(geometry, discharge={"dielectric_strength": "15 V/um"})
    of_case = solve(case)
    conditions = conditions_of(geometry, case.oil)
    assert conditions == of_case.conditions
    given = {"grid": case.grid, "discharge": case.discharge, "electric": case.electric}
    result = solve_contact(conditions, case.oil, solver=case.solver, **given)
    for part, names in (("film", ("pressure", "thickness")), ("field", ("strength", "potential"))):
        for name in names:
            values = (getattr(getattr(one, part), name) for one in (of_case, result))
            np.testing.assert_array_equal(*values)
    summaries = [one.summary() for one in (of_case, result)]
    for key in set(summaries[0]) - {"seconds"}:
        assert json.dumps(summaries[0][key], sort_keys=True) == json.dumps(summaries[1][key], sort_keys=True)


def test_without_a_case_nothing_is_saved_that_could_not_be_loaded(tmp_path):
    case = case_of("line")
    result = solve_contact(conditions_of("line", case.oil), case.oil, grid=case.grid)
    assert "case" not in result.to_xarray().attrs
    with pytest.raises(InputError, match="solve_contact"):
        save(result, tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("geometry", "exponent"), [("line", 0.69), ("point", 0.67)])
def test_a_film_factor_is_that_of_a_slower_contact(geometry, exponent):
    """The formulas' films go with the speed to the power 0.69 or 0.67; the conditions keep the true speed."""
    case, factor = case_of(geometry), 0.8
    thinned = conditions_of(geometry, case.oil, film_factor=factor)
    slower = conditions_of(geometry, case.oil, speed_factor=factor ** (1.0 / exponent))
    assert thinned.entrainment_speed == case.contact.entrainment_speed
    films = [solve_contact(one, case.oil, grid=case.grid).film for one in (thinned, slower)]
    np.testing.assert_allclose(films[0].thickness, films[1].thickness, rtol=1e-12)
    assert films[0].central_thickness / solve(case).film.central_thickness == pytest.approx(factor, rel=0.02)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("geometry", list(CASES))
def test_prepared_surfaces_are_those_that_are_solved(geometry):
    """A contact whose surfaces were prepared for another case is solved with those."""
    case = case_of(geometry, roughness=[MADE])
    higher = prepare(case.replace({"roughness.1.amplitude": "10 nm"}))
    plain, other = (solve_prepared(one, beside_smooth=False) for one in (case, replace(higher, case=case)))
    np.testing.assert_allclose(other.roughness, 2.0 * plain.roughness, rtol=1e-12)


def test_statistics_of_the_roughness_are_those_of_its_heights():
    result = solve(case_of("line", roughness=[MADE]), beside_smooth=False)
    heights = result.roughness[:, np.abs(result.film.x) <= result.conditions.half_width]
    statistics = result.roughness_statistics
    assert statistics.rq_1 == 0.0
    assert statistics.rq_2 == pytest.approx(np.std(heights[1]))
    assert statistics.lambda_ratio == pytest.approx(np.min(result.film.thickness) / np.std(heights[1]))
    assert statistics.smooth_minimum_thickness is None
