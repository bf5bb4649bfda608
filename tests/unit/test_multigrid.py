"""Transfers between grids and the V-cycle as a solver."""

import itertools

import numpy as np
import pytest

from ehlectric import multigrid
from ehlectric.elastic import Deflection, line_influence
from ehlectric.film import FilmProblem, solve_film
from ehlectric.lubricant import barus, incompressible
from ehlectric.reynolds import Fluid, evaluate


@pytest.mark.parametrize(("coarse", "fine"), [(5, 9), (6, 10), (51, 100), (33, 64), (7, 7)])
def test_interpolation_is_exact_for_straight_lines(coarse, fine):
    matrix = multigrid.interpolation(coarse, fine)
    line = np.linspace(-1.0, 3.0, coarse)
    np.testing.assert_allclose(matrix @ line, np.linspace(-1.0, 3.0, fine), atol=1e-13)


@pytest.mark.parametrize("nodes", [65, 101, 102, 1000, 3200, 3201])
def test_hierarchy_halves_down_to_the_coarsest(nodes):
    levels = multigrid.hierarchy(nodes, inlet=-4.0, outlet=2.0, influence=line_influence, second_order=True)
    sizes = [level.x.size for level in levels]
    assert sizes[0] == nodes
    assert len(sizes) >= 2
    assert sizes[-1] <= multigrid.COARSEST
    assert all(coarse - 1 == (fine - 1 + 1) // 2 for fine, coarse in itertools.pairwise(sizes))
    for level in levels:
        assert level.weights.sum() == pytest.approx(6.0)


def test_deflection_is_the_convolution():
    random = np.random.default_rng(3)
    pressure = random.random((37, 5))
    influence = random.random((37, 5))
    operator = Deflection.from_influence(influence)
    direct = np.zeros_like(pressure)
    for i in range(37):
        for j in range(5):
            shifts = influence[np.abs(np.arange(37) - i)][:, np.abs(np.arange(5) - j)]
            direct[i, j] = np.sum(shifts * pressure)
    np.testing.assert_allclose(operator(pressure), direct, rtol=1e-10)


def jacobians(nodes):
    """Of a solved piezoviscous contact, cavitation and pressure spike included."""
    problem = FilmProblem(
        Fluid(
            incompressible,
            lambda p: barus(p, pressure_viscosity_coefficient=8.0),
            velocity_parameter=0.05,
            ambient_pressure=0.0,
        ),
        nodes,
        inlet=-4.0,
        outlet=2.0,
        thickness_guess=0.3,
    )
    film = solve_film(problem)
    assert film.converged
    pressure, thickness = film.pressure[:, np.newaxis], film.thickness[:, np.newaxis]
    return multigrid.linearise_levels(
        multigrid.hierarchy(nodes, inlet=-4.0, outlet=2.0, influence=line_influence, second_order=True),
        problem.fluid,
        coefficients=evaluate(problem.fluid, pressure, thickness),
        pressure=pressure,
        thickness=thickness,
        free=~film.cavitated[:, np.newaxis],
    )


def test_dense_solve_inverts_the_operator():
    *_, coarsest = jacobians(401)
    random = np.random.default_rng(5)
    r = np.where(coarsest.free, random.standard_normal(coarsest.free.shape), 0.0)
    dp, dh00 = coarsest.solve_dense(r, 0.3)
    change, load = coarsest(dp, dh00)
    np.testing.assert_allclose(change, r, atol=1e-9 * np.max(np.abs(coarsest.by_p.coefficients)))
    assert load == pytest.approx(0.3)
    assert np.all(dp[~coarsest.free] == 0.0)


@pytest.mark.parametrize("nodes", [401, 800, 1601, 6401])
def test_v_cycle_reduces_the_error_fivefold(nodes):
    """On every grid the same: the spectral radius of the error propagation, by power iteration."""
    levels = jacobians(nodes)
    random = np.random.default_rng(7)
    dp = np.where(levels[0].free, random.standard_normal((nodes, 1)), 0.0)
    dh00, factor = 0.1, 1.0
    for _ in range(12):
        norm = np.sqrt(np.vdot(dp, dp) + dh00**2)
        dp, dh00 = dp / norm, dh00 / norm
        correction, correction_h00 = multigrid.v_cycle(levels, *levels[0](dp, dh00))
        dp, dh00 = dp - correction, dh00 - correction_h00
        factor = np.sqrt(np.vdot(dp, dp) + dh00**2)
    assert factor < 0.2
