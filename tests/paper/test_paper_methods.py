"""The paper's own multigrid and over-relaxation against the package's solvers: two independent ways."""

import numpy as np
import pandas as pd
import pytest

from ehlectric import ConvergenceError, solve
from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import field_problem, film_problem
from ehlectric.field.line_field import solve_field
from ehlectric.film.isothermal_film import solve_film
from ehlectric.paper import fas, paper_relaxation, sor
from ehlectric.paper.paper_contacts import PAPER
from tests.contact.test_paper_contacts import FILMS, row_name

pytestmark = pytest.mark.published


def paper_contact(paper_case, row, **changes):
    keys = {"load_per_length": "contact.load_per_length", "u_s": "contact.entrainment_speed"}
    case = paper_case.replace(
        {keys["load_per_length"]: row["load_per_length"], keys["u_s"]: 0.5 * row["u_s"]}
    )
    return case.replace({f"grid.{key}": value for key, value in changes.items()})


def film_of(case):
    return film_problem(case, resolve(case))


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("row", FILMS, ids=row_name)
def test_multigrid_and_newton_find_one_film(paper_case, row):
    problem = film_of(paper_contact(paper_case, row, wedge="first-order"))
    theirs, ours = fas.solve_film(problem), solve_film(problem)
    assert theirs.converged
    np.testing.assert_allclose(theirs.thickness, ours.thickness, rtol=1e-6)
    np.testing.assert_allclose(theirs.pressure, ours.pressure, atol=1e-6 * ours.max_pressure)
    assert theirs.load_residual < 1e-9
    assert theirs.discretisation_error == pytest.approx(ours.discretisation_error, rel=1e-3, abs=0.0)
    assert theirs.inlet_deficit == pytest.approx(ours.inlet_deficit, rel=1e-6, abs=0.0)
    # A multigrid cycle gains a digit in two cycles at the worst, whatever the contact.
    residuals = np.array([step.residual for step in theirs.steps] + [theirs.residual])
    late = residuals[2:]
    assert (late[-1] / late[0]) ** (1.0 / (late.size - 1)) < 0.32


@pytest.mark.slow
@pytest.mark.parametrize("row", FILMS[::4] + FILMS[3::4], ids=row_name)
def test_multigrid_solves_the_second_order_film_too(paper_case, row):
    problem = film_of(paper_contact(paper_case, row, wedge="second-order"))
    theirs, ours = fas.solve_film(problem), solve_film(problem)
    assert theirs.converged
    np.testing.assert_allclose(theirs.thickness, ours.thickness, rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("row", [FILMS[0], pytest.param(FILMS[3], marks=pytest.mark.gate)], ids=row_name)
def test_cycles_do_not_grow_with_the_grid(paper_case, row):
    films = [
        fas.solve_film(film_of(paper_contact(paper_case, row, wedge="first-order", nodes=n)))
        for n in (801, 3201, 12_801)
    ]
    assert all(film.converged for film in films)
    assert films[-1].newton_iterations <= films[0].newton_iterations + 1


@pytest.mark.slow
@pytest.mark.gate
def test_wrong_sign_of_eq_19_does_not_balance_the_load(paper_case, monkeypatch):
    """As printed, with c > 0, the load runs away."""
    monkeypatch.setattr(paper_relaxation, "LOAD_DAMPING", 0.2)
    film = fas.solve_film(film_of(paper_contact(paper_case, FILMS[4], wedge="first-order", nodes=801)))
    assert not film.converged


def test_film_that_is_not_found_says_so(paper_case):
    problem = film_of(paper_case.replace({"contact.entrainment_speed": 1e-3, "grid.nodes": 801}))
    film = fas.solve_film(problem)
    assert film.status in ("stalled", "diverged", "film collapsed")
    assert film.x.size == 801
    assert film.discretisation_error is None


def film_and_field(paper_case, row, field_nodes):
    result = solve(paper_contact(paper_case, row, wedge="second-order", field_nodes=field_nodes))
    problem = field_problem(result.case, result.conditions, result.film, result.roughness)
    return problem, solve_field(problem)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("row", FILMS, ids=row_name)
def test_field_of_over_relaxation_is_ours_to_its_grid_error(paper_case, row):
    """The capacitance's error shrinks fourfold; largest and mid-film field agree all along."""
    errors = []
    for columns, rows in ((401, 4), (801, 8), (1601, 16)):
        problem, ours = film_and_field(paper_case, row, columns)
        theirs = sor.solve_field(problem, rows=rows)
        errors.append(abs(theirs.capacitance / ours.capacitance - 1.0))
        assert theirs.max_strength == pytest.approx(ours.max_strength, rel=2e-5, abs=0.0)
        assert theirs.max_strength_position == pytest.approx(ours.max_strength_position, abs=2e-6)
        inner = ours.inner
        np.testing.assert_allclose(theirs.middle_strength[inner], ours.middle_strength[inner], rtol=3e-4)
        assert theirs.capacitance_by_charge == pytest.approx(theirs.capacitance, rel=2e-5, abs=0.0)
        assert theirs.high_field_width == pytest.approx(ours.high_field_width, rel=1e-3, abs=0.0)
    assert errors[0] < 2e-4
    assert errors[0] / errors[1] > 3.0
    assert errors[1] / errors[2] > 3.0


@pytest.mark.slow
@pytest.mark.gate
def test_a_case_takes_either_solver(paper_case):
    case = paper_contact(paper_case, FILMS[0], wedge="first-order", nodes=801)
    theirs, ours = solve(case, solvers=PAPER), solve(case)
    assert theirs.summary()["film"]["solver"] == "paper"
    assert ours.summary()["film"]["solver"] == "ehlectric"
    flat = [pd.json_normalize(result.summary()).iloc[0] for result in (theirs, ours)]
    assert list(flat[0].index) == list(flat[1].index)
    for key in ("film.minimum_thickness", "film.central_thickness", "field.max_strength"):
        assert flat[0][key] == pytest.approx(flat[1][key], rel=1e-5, abs=0.0)


@pytest.mark.slow
def test_over_relaxation_of_a_rough_film_converges_with_its_columns(paper_case):
    """A wave of 10 µm on one wall: capacitance and largest field come nearer to ours threefold or more."""
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": 20e-9, "wavelength": 10e-6}
    case = paper_contact(paper_case, FILMS[3], nodes=12_801).replace(roughness=(wave,))
    result = solve(case)

    def problem(columns):
        on_columns = case.replace({"grid.field_nodes": columns})
        return field_problem(on_columns, result.conditions, result.film, result.roughness)

    reference = solve_field(problem(25_601))
    fields = [sor.solve_field(problem(columns), rows=8) for columns in (1601, 3201, 6401)]
    for name, first in (("capacitance", 5e-5), ("max_strength", 5e-3)):
        errors = [abs(getattr(field, name) / getattr(reference, name) - 1.0) for field in fields]
        assert errors[0] < first
        assert errors[0] / errors[1] > 3.0
        assert errors[1] / errors[2] > 3.0


def test_grid_that_would_be_too_large(paper_case):
    problem, _ = film_and_field(paper_case, FILMS[0], 801)
    with pytest.raises(ConvergenceError, match="Cartesian grid would have"):
        sor.solve_field(problem, rows=100_000)


def test_film_that_was_not_found_has_a_field_all_the_same(paper_case):
    """The over-relaxation is spared a gap of atoms: everything is written, and the status says why."""
    case = paper_case.replace(
        {"contact.entrainment_speed": 1e-3, "grid.nodes": 801, "grid.wedge": "first-order"}
    )
    result = solve(case, solvers=PAPER)
    assert not result.converged
    assert (result.film_solver, result.field_solver) == ("paper", "ehlectric")
    assert np.all(np.isfinite(result.field.strength))
