"""Transfers between grids and the V-cycle as a solver."""

import dataclasses
import itertools

import numpy as np
import pytest

from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import film_problem
from ehlectric.film import multigrid, reynolds
from ehlectric.film.deflection import LINE, Deflection
from ehlectric.film.face_flow import Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.isothermal_film import solve_film
from ehlectric.film.levels import COARSEST, DIPOLE, SECOND_DIFFERENCE, hierarchy, interpolation
from ehlectric.film.problem import FilmProblem
from ehlectric.film.unsteady import in_time
from ehlectric.lubricant.density import incompressible
from ehlectric.lubricant.viscosity import barus
from tests.helpers.each import each


@each("coarse, fine", [(5, 9), (6, 10), (51, 100), (33, 64), (7, 7)])
def test_interpolation_is_exact_for_straight_lines(coarse, fine):
    matrix = interpolation(coarse, fine)
    line = np.linspace(-1.0, 3.0, coarse)
    np.testing.assert_allclose(matrix @ line, np.linspace(-1.0, 3.0, fine), atol=1e-13)


@each("nodes", [65, 101, 102, 1000, 3200, 3201])
def test_hierarchy_halves_down_to_the_coarsest(nodes):
    levels = hierarchy(nodes, inlet=-4.0, outlet=2.0, geometry=LINE, wedge_order=2)
    sizes = [level.nodes for level in levels]
    assert sizes[0] == nodes
    assert len(sizes) >= 2
    assert sizes[-1] <= COARSEST
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
    np.testing.assert_allclose(operator.matrix @ pressure.ravel(), direct.ravel(), rtol=1e-10)


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
    return at_solution(problem)


def at_solution(problem):
    """The Jacobian on every grid at the solution of a problem."""
    film = solve_film(problem)
    assert film.converged
    pressure = (film.pressure / film.scales.pressure)[:, np.newaxis]
    thickness = (film.thickness / film.scales.thickness)[:, np.newaxis]
    levels = hierarchy(problem.nodes, inlet=-4.0, outlet=2.0, geometry=LINE, wedge_order=2)
    return multigrid.linearise_levels(
        levels,
        problem.fluid,
        flow(problem.fluid, pressure, thickness, levels[0].mesh),
        pressure=pressure,
        thickness=thickness,
        full_film=~film.cavitated[:, np.newaxis],
    )


def relinearised(jacobian, level):
    """The Jacobian at a film that was made up, on a level that may be one of time."""
    x = level.mesh.x[:, np.newaxis]
    fluid = Fluid(
        incompressible,
        lambda p: barus(p, pressure_viscosity_coefficient=8.0),
        velocity_parameter=0.05,
        ambient_pressure=0.0,
    )
    pressure = np.where(jacobian.full_film, np.sqrt(np.clip(1.0 - x**2, 0.0, 1.0)), 0.0)
    thickness = 0.1 + 0.5 * np.clip(np.abs(x) - 1.0, 0.0, None) ** 1.5
    at_faces = flow(fluid, pressure, thickness, level.mesh)
    return multigrid.Linearised.of(Gap(level, thickness), at_faces, jacobian.full_film)


def three_lines(jacobian):
    """The same grid with three identical lines along x that do not feel each other."""
    level = jacobian.level
    nx = level.nodes
    apart = np.zeros((nx, 3))
    apart[:, :1] = level.deflection.influence
    wide = dataclasses.replace(
        level,
        weights=np.repeat(level.weights, 3, axis=1),
        deflection=Deflection.from_influence(apart),
    )
    nodal = ("full_film", "poiseuille", "scale", "unscale", "resolved")
    changes = {name: np.repeat(getattr(jacobian, name), 3, axis=1) for name in nodal}
    for name in ("by_p", "by_h"):
        coefficients = np.repeat(getattr(jacobian, name).coefficients, 3, axis=2)
        changes[name] = reynolds.Stencil(coefficients)
    thickness = np.repeat(jacobian.gap.thickness, 3, axis=1)
    return dataclasses.replace(jacobian, gap=Gap(wide, thickness), **changes)


@pytest.mark.parametrize(("distribution", "moments"), [(DIPOLE, (0.0, 1.0)), (SECOND_DIFFERENCE, (0.0, 0.0))])
def test_what_is_distributed_is_a_dipole_or_a_second_difference(distribution, moments):
    """Neither carries load, and a second difference no moment."""
    assert dict(distribution)[0] == 1.0
    assert tuple(sum(part * offset**k for offset, part in distribution) for k in range(2)) == moments


@pytest.mark.parametrize("distribution", [DIPOLE, SECOND_DIFFERENCE])
def test_a_line_is_relaxed_by_the_band_of_its_jacobian_in_distributed_unknowns(distribution):
    """P = D q, where D adds parts of an unknown beside it: the band of J D, by elimination in full."""
    line = jacobians(401)[1]
    level = line.level
    if distribution is SECOND_DIFFERENCE:
        level = in_time(level, 1.0 / level.mesh.dx)
    copy = relinearised(line, level)
    n, free, distributed = level.nodes, copy.full_film[:, 0], copy.relax.distributed[:, 0]
    # Some are, and some are not: in the inlet the flow decides.
    assert 0.1 < np.mean(distributed) < np.mean(free) < 1.0
    changes = np.eye(n)
    for j in np.flatnonzero(distributed):
        assert all(free[j + offset] for offset, _ in distribution)
        for offset, part in distribution:
            changes[j + offset, j] = part
    jacobian = np.stack([copy(unit[:, np.newaxis], 0.0)[0][:, 0] for unit in np.eye(n)], axis=1)
    apart = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    band = np.where(apart <= copy.relax.half_band, jacobian @ changes, 0.0)
    band[~free] = np.eye(n)[~free]
    r = np.where(free, np.random.default_rng(17).standard_normal(n), 0.0)
    expected = np.where(free, changes @ np.linalg.solve(band, r), 0.0)
    largest = np.max(np.abs(expected))
    np.testing.assert_allclose(copy.relax(r[:, np.newaxis])[:, 0], expected, rtol=0.0, atol=1e-9 * largest)


def test_lines_side_by_side_are_relaxed_as_one():
    line = jacobians(401)[0]
    random = np.random.default_rng(11)
    r = np.where(line.full_film, random.standard_normal(line.full_film.shape), 0.0)
    together = three_lines(line).relax(r * np.array([1.0, -2.0, 0.5]))
    np.testing.assert_allclose(together, line.relax(r) * np.array([1.0, -2.0, 0.5]), rtol=1e-10, atol=1e-14)


def test_dense_solve_of_lines_side_by_side():
    wide = three_lines(jacobians(401)[-1])
    random = np.random.default_rng(13)
    r = np.where(wide.full_film, random.standard_normal(wide.full_film.shape), 0.0)
    dp, dh00 = wide.solve_dense(r, 0.3)
    change, load = wide(dp, dh00)
    np.testing.assert_allclose(change, r, atol=1e-9 * np.max(np.abs(wide.by_p.coefficients)))
    assert load == pytest.approx(0.3)


def test_dense_solve_inverts_the_operator():
    *_, coarsest = jacobians(401)
    random = np.random.default_rng(5)
    r = np.where(coarsest.full_film, random.standard_normal(coarsest.full_film.shape), 0.0)
    dp, dh00 = coarsest.solve_dense(r, 0.3)
    change, load = coarsest(dp, dh00)
    np.testing.assert_allclose(change, r, atol=1e-9 * np.max(np.abs(coarsest.by_p.coefficients)))
    assert load == pytest.approx(0.3)
    assert np.all(dp[~coarsest.full_film] == 0.0)


@each("part", [slice(40, 43), slice(0, 60), slice(150, 201), slice(61, 200), None])
def test_dense_solve_with_cavitated_nodes_anywhere(part):
    """Inside the full film, before it, behind it, all but a part of it, and all but one node."""
    *_, coarsest = jacobians(401)
    full_film = coarsest.full_film.copy()
    if part is None:
        full_film[np.flatnonzero(full_film)[1:]] = False
    else:
        full_film[part] = False
    by_p, by_h = (stencil.on_rows(full_film) for stencil in (coarsest.by_p, coarsest.by_h))
    copy = dataclasses.replace(coarsest, full_film=full_film, by_p=by_p, by_h=by_h)
    r = np.where(full_film, np.random.default_rng(6).standard_normal(full_film.shape), 0.0)
    dp, dh00 = copy.solve_dense(r, 0.3)
    change, load = copy(dp, dh00)
    np.testing.assert_allclose(change, r, atol=1e-9 * np.max(np.abs(by_p.coefficients)))
    assert load == pytest.approx(0.3)
    assert np.all(dp[~full_film] == 0.0)


def convergence_factor(levels):
    """Spectral radius of the error propagation of a V-cycle, by power iteration."""
    random = np.random.default_rng(7)
    dp = np.where(levels[0].full_film, random.standard_normal(levels[0].full_film.shape), 0.0)
    dh00, factor = 0.1, 1.0
    for _ in range(12):
        norm = np.sqrt(np.vdot(dp, dp) + dh00**2)
        dp, dh00 = dp / norm, dh00 / norm
        correction, correction_h00 = multigrid.v_cycle(levels, *levels[0](dp, dh00))
        dp, dh00 = dp - correction, dh00 - correction_h00
        factor = np.sqrt(np.vdot(dp, dp) + dh00**2)
    return factor


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("nodes", [401, 800, 1601, 6401])
def test_v_cycle_reduces_the_error_fivefold(nodes):
    assert convergence_factor(jacobians(nodes)) < 0.2


@pytest.mark.slow
@pytest.mark.parametrize("nodes", [801, 3201, 12_801])
@pytest.mark.parametrize(("wedge", "factor"), [("second-order", 0.4), ("third-order", 0.45)])
def test_v_cycle_on_the_paper_contact(paper_case, nodes, wedge, factor):
    """The spike of 2 GPa is the hard case: one slow error beside it, which GMRES takes in an iteration."""
    case = paper_case.replace({"grid.nodes": nodes, "grid.wedge": wedge})
    levels = at_solution(film_problem(case, resolve(case)))
    assert convergence_factor(levels) < factor
