"""Timings by pytest-benchmark: python -m pytest benchmarks"""

import pytest

from benchmarks import baselines, cases
from ehlectric.field.line_field import solve_field
from ehlectric.field.point_field import solve_point_field
from ehlectric.film.isothermal_film import solve_film, solve_point_film


@pytest.mark.parametrize("nodes", [801, 3201, 25_601, 102_401])
def test_film(benchmark, nodes):
    film = benchmark(solve_film, cases.film_problem(nodes))
    assert film.converged


@pytest.mark.parametrize("nodes", [801, 3201])
def test_film_by_dense_newton(benchmark, nodes):
    film = benchmark.pedantic(baselines.solve_film_densely, (cases.film_problem(nodes),), rounds=1)
    assert film.converged


@pytest.mark.parametrize("columns", [801, 3201, 12_801])
def test_field(benchmark, columns):
    field = benchmark(solve_field, cases.field_problem(columns))
    assert field.capacitance > 0.0


@pytest.mark.parametrize("columns", [801, 3201])
def test_field_by_superlu(benchmark, columns):
    problem = cases.field_problem(columns)
    capacitance = benchmark.pedantic(baselines.capacitance_by_superlu, (problem,), rounds=3)
    assert capacitance == pytest.approx(solve_field(problem).capacitance, rel=1e-5)


@pytest.mark.parametrize("nodes", [129, 257, 513])
@pytest.mark.parametrize("example", ["ball_contact", "ball_bearing"])
def test_point_film(benchmark, example, nodes):
    film = benchmark(solve_point_film, cases.point_film_problem(example, nodes, "second-order"))
    assert film.converged


@pytest.mark.parametrize("columns", [129, 257])
def test_point_field(benchmark, columns):
    field = benchmark(solve_point_field, cases.point_field_problem("ball_contact", columns))
    assert field.capacitance > 0.0
