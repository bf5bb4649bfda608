"""Error of the maximum field in results: summary, warnings, table, verdict and files."""

import dataclasses

import pytest

from ehlectric import Case, load, save, solve
from ehlectric.cases.grid_inputs import Grid
from ehlectric.contact.film_warnings import accuracy_warnings, inaccurate_field
from ehlectric.contact.solver import DEFAULT_SOLVERS
from ehlectric.contact.solver import solve as solve_with
from ehlectric.errors import ConvergenceError
from ehlectric.tables.contact_tables import result_rows

CONTACT = {
    "reduced_radius": "14.1 mm",
    "reduced_modulus": "226 GPa",
    "max_hertz_pressure": "0.5 GPa",
    "entrainment_speed": "26 m/s",
}


@pytest.fixture(scope="module")
def result():
    tables = {"contact": CONTACT | {"entrainment_speed": "4 m/s"}, "lubricant": {"base": "paper"}}
    discharge = {"dielectric_strength": "1.5 V/um"}
    return solve(Case.from_dict(tables | {"grid": {"nodes": 401}, "discharge": discharge}))


def with_error(result, error, degree=6):
    field = dataclasses.replace(result.field, strength_error=error, sufficient_degree=degree)
    return dataclasses.replace(result, field=field)


def test_a_smooth_contact_has_a_small_error_that_its_summary_states(result):
    summary = result.summary()
    assert 0.0 < summary["field"]["max_strength_error"] < 1e-3
    assert summary["field"]["degree"] == 6
    assert summary["discharge"]["breakdown_field_error"] == summary["field"]["max_strength_error"]


@pytest.mark.slow
@pytest.mark.gate
def test_the_error_is_saved_and_is_unknown_in_files_without_it(result, tmp_path):
    save(result, tmp_path)
    assert load(tmp_path / "result.nc").field.strength_error == result.field.strength_error
    unknown = with_error(result, None, None)
    save(unknown, tmp_path)
    again = load(tmp_path / "result.nc")
    assert again.field.strength_error is None
    assert again.summary()["discharge"]["breakdown_field_error"] is None
    rows = {row.name: row for row in result_rows(again)}
    assert rows["error of the maximum field"].value == "unknown"


def test_the_table_has_the_error_and_its_share_of_the_breakdown_voltage(result):
    rows = {row.name: row for row in result_rows(with_error(result, 0.031))}
    assert rows["error of the maximum field"].value == 0.031
    assert rows["error of the breakdown voltage, field"].value == 0.031
    assert "error of the breakdown voltage, field" not in {row.name for row in result_rows(result)}


def test_an_error_above_two_percent_is_a_warning(result):
    grid = result.case.grid
    assert not list(accuracy_warnings(grid, with_error(result, 0.019).field))
    (warning,) = accuracy_warnings(grid, with_error(result, 0.031, 14).field)
    assert warning.code == "field-unresolved"
    assert "the error of the maximum field is estimated at 3.1 %" in warning.text
    assert warning.text.endswith("Raise grid.field_degree to 14, or use more grid.nodes.")
    (warning,) = accuracy_warnings(grid, with_error(result, 0.031, 6).field)
    assert warning.text.endswith("too high. Use more grid.nodes.")
    assert "grid.field_nodes" in inaccurate_field(Grid(field_nodes=801), 0.03).text
    assert inaccurate_field(grid, 0.03, 40, 48).text.endswith("as by a cutoff_short.")


def test_an_error_that_should_be_known_but_is_not_is_a_warning(result):
    unknown = with_error(result, None, None).field
    (warning,) = accuracy_warnings(result.case.grid, unknown)
    assert warning.code == "field-unresolved"
    assert warning.text.startswith("the error of the maximum field is not known, because a finer solution")
    assert not list(accuracy_warnings(result.case.grid, unknown, estimated=False))


def test_a_contact_whose_windows_do_not_converge_has_the_warning(result, monkeypatch):
    def failing(*_arguments):
        raise ConvergenceError("the electric field did not converge")

    monkeypatch.setattr("ehlectric.field.field_accuracy._peak_error", failing)
    found = solve(result.case)
    assert found.field.strength_error is None
    assert found.field.max_strength == pytest.approx(result.field.max_strength, rel=1e-9)
    assert [w.code for w in found.warnings].count("field-unresolved") == 1


def test_a_margin_within_the_error_of_the_field_is_possible_only(result):
    margin = result.verdict.margin
    strength = 1.5e6 / margin * 1.01
    case = result.case.replace({"discharge.dielectric_strength": strength})
    near = dataclasses.replace(result, case=case)
    assert near.verdict.margin == pytest.approx(1.01)
    assert "maximum field may be" not in near.verdict.text
    wide = dataclasses.replace(near, field=with_error(near, 0.03).field)
    assert wide.verdict.level == "yellow"
    assert "The maximum field may be 3 % off on this grid." in wide.verdict.text


def test_a_solver_without_an_estimate_says_unknown_and_does_not_warn(result):
    """The field solver of this stand-in is ours, but it drops the estimate, as the paper's has none."""

    def without(problem):
        field = DEFAULT_SOLVERS.field["line"](problem)
        return dataclasses.replace(field, strength_error=None, sufficient_degree=None)

    other = dataclasses.replace(DEFAULT_SOLVERS, name="paper", field={"line": without})
    found = solve_with(result.case, solvers=other)
    assert not any(warning.code == "field-unresolved" for warning in found.warnings)
    rows = {row.name: row for row in result_rows(found)}
    assert rows["error of the maximum field"].value == "unknown"


@pytest.mark.slow
def test_waves_of_a_quarter_of_the_film_have_the_right_field():
    """20 nm waves of 0.7 um in a film of 2.6 um: the field of degree 6 is 5.5 % too low."""
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "0.7 um"}
    tables = {"contact": CONTACT, "lubricant": {"base": "paper"}, "roughness": [wave]}
    given = {"grid": {"nodes": 8601}, "discharge": {"dielectric_strength": "15 V/um"}}
    found = solve(Case.from_dict(tables | given), beside_smooth=False)
    fine = solve(
        Case.from_dict(tables | given | {"grid": {"nodes": 8601, "field_degree": 30}}), beside_smooth=False
    )
    assert found.field.s.size == 15
    assert found.field.strength_error < 0.01
    assert found.field.max_strength == pytest.approx(fine.field.max_strength, rel=0.005)
    assert not any(warning.code == "field-unresolved" for warning in found.warnings)
