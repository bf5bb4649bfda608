"""Nested iteration: what direct solutions, kept grids, loose starts and early ends must not change."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from ehlectric import Case
from ehlectric.contact.conditions import resolve
from ehlectric.contact.preparation import prepare
from ehlectric.contact.problems import film_problem
from ehlectric.film import film_solver, nested, newton
from ehlectric.film.isothermal_film import solve_film, solve_point_film
from ehlectric.film.nested import accurate_film, nested_iteration
from ehlectric.film.shear_laws import Rheology
from tests.film.sheared.contacts import line_contact
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES


def problem_of(paper_case, **changes):
    case = paper_case.replace({"grid.nodes": 401, "grid.wedge": "third-order", **changes})
    return film_problem(case, resolve(case))


@each("nodes", [3, 4, 101])
@each("rising", [False, True])
def test_values_half_way_are_those_of_the_monotone_cubic(nodes, rising):
    values = np.random.default_rng(nodes).standard_normal((nodes, 20))
    if rising:
        values = np.cumsum(np.maximum(values, 0.0), axis=0)
    fine = np.linspace(-4.0, 2.0, 2 * nodes - 1)
    expected = PchipInterpolator(fine[::2], values, axis=0)(fine)
    np.testing.assert_allclose(nested.halved(values), expected, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("speed", ["0.5 m/s", "4 m/s"])
def test_direct_solutions_give_the_film_of_the_cycles(monkeypatch, paper_case, speed):
    problem = problem_of(paper_case, **{"contact.entrainment_speed": speed})
    direct = solve_film(problem)
    monkeypatch.setattr(nested, "DIRECT", 0)
    monkeypatch.setattr(newton, "_KEPT", (0, 0))
    cycled = solve_film(problem)
    assert direct.converged
    assert cycled.converged
    # The residual is a pressure over p_h of 1e-9 at most.
    np.testing.assert_allclose(direct.thickness, cycled.thickness, rtol=1e-6)
    assert direct.discretisation_error == pytest.approx(cycled.discretisation_error, rel=1e-3)
    # Fewer iterations: those with the own factors of a grid are one, with older factors a few.
    assert sum(step.krylov_iterations for step in direct.steps) < sum(
        step.krylov_iterations for step in cycled.steps
    )


def test_grids_that_are_kept_do_not_change(paper_case):
    """A film is the same to the last bit before and after another contact on the same grids."""
    first, other = (problem_of(paper_case, **{"contact.entrainment_speed": u}) for u in ("4 m/s", "1 m/s"))
    before = solve_film(first)
    assert not np.array_equal(solve_film(other).pressure, before.pressure)
    after = solve_film(first)
    assert np.array_equal(before.pressure, after.pressure)
    assert before.discretisation_error == after.discretisation_error
    kept, again = (nested.levels_of(problem) for problem in (first, other))
    assert all(one is two for one, two in zip(kept, again, strict=True))


def test_other_domains_and_wedges_have_other_grids(paper_case):
    problem = problem_of(paper_case)
    kept = nested.levels_of(problem)[0]
    for changes in ({"grid.inlet": -5.0}, {"grid.wedge": "first-order"}, {"grid.nodes": 403}):
        level = nested.levels_of(problem_of(paper_case, **changes))[0]
        assert level is not kept
        same = level.mesh.shape == kept.mesh.shape and np.array_equal(level.mesh.x, kept.mesh.x)
        assert not (same and np.array_equal(level.wedge.coefficients, kept.wedge.coefficients))


def test_accurate_films_keep_the_law_of_a_sheared_oil():
    """The film of the highest order replaces laws by name only: that of a thinned oil stays thinner."""
    law = Rheology("carreau", {"carreau_stress": 1e5, "carreau_exponent": 0.6})
    films = []
    for rheology in (None, law):
        problem = line_contact(rheology=rheology, nodes=201)
        start = nested_iteration(problem, None)[-1]
        films.append(accurate_film(problem, 201, start.state).state.thickness.min())
    assert films[1] < 0.8 * films[0]


@pytest.mark.parametrize(
    ("speed", "target"), [("12 mm/s", 0.2), ("12 mm/s", 0.05), ("1 m/s", 0.005), ("1 m/s", 0.02)]
)
def test_films_that_are_only_starts_lead_to_the_same_film(monkeypatch, speed, target):
    """The film of the last grid has the tolerance of the case, whatever the films of coarser grids have.

    At 12 mm/s the surfaces seem to touch on the coarsest grids, which are too coarse for this film.
    """
    case = Case.from_toml(EXAMPLES / "ball_contact.toml")
    case = case.replace({"contact.entrainment_speed": speed, "grid.error": target})
    problem = replace(prepare(case).film_problem(case), target_error=target)
    early = solve_point_film(problem)
    monkeypatch.setattr(film_solver, "_early_end", lambda *_: None)
    accurate = solve_point_film(problem)
    assert early.converged
    assert accurate.converged
    assert early.residual <= problem.tolerance
    assert early.steps[-1].nodes == accurate.steps[-1].nodes
    close = 1e-3 * accurate.discretisation_error
    assert early.minimum_thickness == pytest.approx(accurate.minimum_thickness, rel=close)
    assert early.central_thickness == pytest.approx(accurate.central_thickness, rel=close)
    assert early.discretisation_error == pytest.approx(accurate.discretisation_error, rel=1e-2)
    refined = early.steps[-1].nodes > problem.nodes
    assert len(early.steps) <= len(accurate.steps) - refined


def test_the_coarser_grids_have_one_solution_each():
    """The last one with each spacing, of solutions from coarse to fine, of which two have one grid."""
    spacings = [0.4, 0.2, 0.2, 0.1]
    grids = [
        SimpleNamespace(status="stalled", level=SimpleNamespace(mesh=SimpleNamespace(dx=dx)))
        for dx in spacings
    ]
    coarser = film_solver.RefinedSolution(problem=None, solutions=grids).coarser
    assert [id(grid) for grid in coarser] == [id(grids[2]), id(grids[0])]
