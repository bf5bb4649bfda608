"""Baselines of the benchmarks: each solves the problem of our solver, and gives its numbers."""

import numpy as np
import pytest
from benchmarks.measure import peak_memory

from benchmarks import baselines, cases, public_solvers
from ehlectric.field.line_field import solve_field
from ehlectric.film import isothermal_film, newton


def test_a_film_by_dense_newton_is_that_of_the_multigrid():
    before = newton._direction, isothermal_film.quiet_solution
    problem = cases.film_problem(201)
    dense, film = baselines.solve_film_densely(problem), isothermal_film.solve_film(problem)
    assert dense.converged
    assert film.converged
    assert sum(step.krylov_iterations for step in film.steps) > 0
    assert sum(step.krylov_iterations for step in dense.steps) == 0
    np.testing.assert_allclose(dense.thickness, film.thickness, rtol=1e-9)
    assert (newton._direction, isothermal_film.quiet_solution) == before


@pytest.mark.slow
def test_a_capacitance_by_a_sparse_factorisation_is_that_of_the_field():
    problem = cases.field_problem(401)
    assert baselines.capacitance_by_superlu(problem) == pytest.approx(solve_field(problem).capacitance, 1e-5)


@pytest.mark.slow
def test_memory_is_that_of_a_process_that_solves():
    """The solution of 6401 nodes needs at least its own arrays, of some 50 kB each."""
    whole, added = peak_memory(isothermal_film.solve_film, cases.film_problem, 6401)
    assert 1.0 > whole > added > 5e-4


def test_the_contact_for_public_packages_is_that_of_the_example():
    """20 N on a ball of 10 mm with E' = 226 GPa: b = (3 F R/(2 E'))^(1/3), p = 3 F/(2 pi b^2)."""
    contact = public_solvers.contact()
    half_width = (3.0 * 20.0 * 0.01 / (2.0 * 226e9)) ** (1.0 / 3.0)
    assert contact["half_width"] == pytest.approx(half_width, 1e-9)
    assert contact["max_pressure"] == pytest.approx(1.5 * 20.0 / (np.pi * half_width**2), 1e-9)
    # Oil of the paper, with the laws of Roelands: eta0 = 0.04 Pa s, alpha = 22/GPa, z = 0.67, p0 = 198 MPa.
    assert [contact[key] for key in ("viscosity", "alpha", "roelands_z", "roelands_pressure")] == [
        0.04,
        2.2e-08,
        0.67,
        1.98e8,
    ]
