"""Limits of films whose surfaces touch: the dry rough contact at rest, and the film without contact."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.nested import grid_problem, levels_of
from ehlectric.film.newton import GridProblem, State
from ehlectric.film.touching_newton import touching_newton
from tests.film import dry_contact
from tests.helpers.mixed_films import (
    MixedFilm,
    gaussian,
    mixed_film,
    on_few_nodes,
    posed,
    rough_line,
    rough_point,
    sinusoid,
)
from tests.helpers.share import share

pytestmark = pytest.mark.convergence


def dry_limit(film, **options):
    """Pressure, gap and contact on the nodes of a film by the independent solver of dry contacts."""
    mesh, problem = film.mesh, film.problem
    options |= {"shift": problem.boundary_film, "tolerance": 1e-7}
    if mesh.y.size == 1:
        added = problem.added_gap(mesh.x, mesh.y)[:, 0]
        dry = dry_contact.line_contact(mesh.x, added, load=problem.geometry.load, **options)
        return dry.pressure[:, np.newaxis], dry.gap[:, np.newaxis]
    assert not mesh.symmetric
    added = problem.added_gap(mesh.x, mesh.y)
    dry = dry_contact.point_contact(mesh.x, mesh.y, added, load=problem.geometry.load, **options)
    return dry.pressure, dry.gap


def apart(film):
    """Distances from the dry contact: of pressure and gap, and of the area with that of its edges."""
    pressure, gap = dry_limit(film)
    mesh, weights = film.mesh, film.last.level.weights
    off = np.sum(weights * np.abs(film.pressure - pressure)) / film.problem.geometry.load
    inside = np.abs(mesh.x[:, np.newaxis]) + np.abs(mesh.y) < 1.0
    opened = np.mean(np.abs(film.gap - gap)[inside]) / np.mean(gap[inside])
    dry = pressure > 0.0
    edges = sum(np.count_nonzero(np.diff(dry, axis=axis)) for axis in (0, 1))
    cell = mesh.dx * (mesh.dy or 1.0)
    return off, opened, (film.area - np.sum(weights * dry)) / (edges * cell)


# Profiles: waves whose valleys hardly fill, and waves of which the tips touch.
PROFILES = [
    pytest.param(sinusoid("200 nm", "40 um"), id="sinusoid", marks=pytest.mark.gate),
    pytest.param(gaussian("200 nm", "20 um", seed=4), id="gaussian"),
    pytest.param(gaussian("50 nm", "20 um"), id="low"),
]


@pytest.mark.slow
@pytest.mark.parametrize("table", PROFILES)
def test_line_at_rest_is_the_dry_rough_contact(table):
    """Pressure within 0.5 %, gap within 3 % and area within the edges of the spots, as speed goes to zero."""
    films = [mixed_film(rough_line(table, speed=speed)) for speed in (1e-5, 1e-6)]
    assert all(film.converged for film in films)
    before, after = (apart(film) for film in films)
    assert before[0] < 0.05
    assert after[0] < 5e-3
    assert after[1] < 3e-2
    assert abs(after[2]) <= 0.5
    assert films[1].share > 0.99


SLOW = [
    pytest.param(sinusoid("150 nm", "40 um"), id="sinusoid"),
    pytest.param(gaussian("150 nm", "20 um", seed=4), id="gaussian"),
]


@pytest.mark.slow
@pytest.mark.parametrize("table", SLOW)
def test_film_at_its_tolerance_is_that_of_a_smaller_one(table):
    """Share and gap of a slow contact by hardly any oil, which fills the valleys all the same.

    The exact film begins with the film found: from the dry contact, Newton's method may find another one.
    """
    problem = posed(rough_line(table, speed=1e-5))
    found, finer = mixed_film(replace(problem, tolerance=1e-8)), replace(problem, tolerance=1e-12)
    levels = levels_of(finer)
    posed_exactly = replace(grid_problem(finer, levels, None, times=6), levels=levels)
    last = touching_newton(
        posed_exactly, found.last.state, first_damping=0.0, carried=found.last.content, min_iterations=1
    )
    exact = MixedFilm(finer, [last])
    assert found.converged
    assert exact.converged
    assert exact.last.final.norm <= 1e-12
    assert found.share == pytest.approx(exact.share, abs=1e-4)
    np.testing.assert_allclose(found.film_outside, exact.film_outside, rtol=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("hardness", ["0.8 GPa", "1 GPa"])
def test_hard_line_at_rest_is_the_dry_contact_with_this_hardness(hardness):
    """Both solvers hold the pressure at the hardness on the same nodes, and agree on the flattened gap."""
    film = mixed_film(rough_line(gaussian("50 nm", "20 um"), speed=1e-6, hardness=hardness))
    assert film.converged
    limit = film.problem.hardness
    pressure, gap = dry_limit(film, hardness=limit)
    flattened = pressure > limit * (1.0 - 1e-6)
    assert np.count_nonzero(flattened) >= 5
    np.testing.assert_array_equal(film.pressure > limit * (1.0 - 1e-6), flattened)
    off = np.sum(film.last.level.weights * np.abs(film.pressure - pressure)) / film.problem.geometry.load
    assert off < 2e-3
    inside = np.abs(film.mesh.x) < 1.0
    assert np.mean(np.abs(film.gap - gap)[inside]) < 1e-3 * np.mean(gap[inside])


@pytest.mark.slow
def test_point_at_rest_is_the_dry_rough_contact():
    contacts = [rough_point(gaussian("100 nm", "35 um"), speed=speed) for speed in (3e-5, 3e-6)]
    films = [mixed_film(on_few_nodes(case, 33)) for case in contacts]
    assert all(film.converged for film in films)
    before, after = (apart(film) for film in films)
    assert after[0] < before[0] < 0.05
    assert after[0] < 1e-2
    assert after[1] < 5e-2
    assert abs(after[2]) <= 0.5
    assert films[1].share > films[0].share
    assert films[1].share > 0.98


@pytest.mark.slow
@pytest.mark.parametrize("nodes", share([65, 129], 2))
def test_fine_point_at_rest_is_the_dry_rough_contact(nodes):
    film = mixed_film(rough_point(gaussian("100 nm", "30 um"), nodes=nodes, speed=1e-5))
    assert film.converged
    off, opened, area = apart(film)
    assert off < 1e-2
    assert opened < 5e-2
    assert abs(area) <= 0.5
    assert film.share > 0.98


THICK = [
    pytest.param(rough_line(sinusoid("20 nm", "40 um"), speed=2.0), id="line", marks=pytest.mark.gate),
    pytest.param(rough_line(gaussian("20 nm", "20 um"), speed=1.0), id="random line"),
    pytest.param(rough_point(gaussian("20 nm", "35 um"), speed=2.0), id="point"),
]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("case", THICK)
def test_thick_film_does_not_know_the_boundary_film(case):
    """The same steps with and without a boundary film, and the same film from the solver of touching ones."""
    without, thin, thick = (mixed_film(case, boundary_film=h) for h in (0.0, 1e-9, 5e-9))
    assert without.converged
    assert not without.touching.any()
    for film in (thin, thick):
        assert film.share == film.area == 0.0
        assert np.array_equal(film.gap, without.gap)
        assert np.array_equal(film.pressure, without.pressure)


@pytest.mark.slow
@pytest.mark.parametrize("case", THICK)
def test_solver_of_touching_surfaces_finds_a_thick_film(case):
    """To 1e-9 of the gap, and of the Hertz pressure, from a film that is a fifth thicker."""
    without = mixed_film(case, boundary_film=0.0)
    problem = replace(posed(case), tolerance=1e-11)
    levels = levels_of(problem)
    exact = mixed_film(problem, boundary_film=0.0)
    raised = State.of(levels[0], without.pressure, without.last.state.h00 + 0.2 * float(without.gap.min()))
    on_grid = GridProblem(problem.fluid, levels, 1e-11, 60, asperities=problem.asperities)
    found = touching_newton(on_grid, raised)
    assert found.status == "converged"
    assert len(found.steps) > 1
    assert not found.touches
    np.testing.assert_allclose(found.state.thickness, exact.gap, rtol=1e-9)
    np.testing.assert_allclose(found.state.pressure, exact.pressure, rtol=0.0, atol=1e-9)


def test_low_roughness_tends_to_the_smooth_film():
    """A wave of a thousandth of the film changes it in proportion to its height."""
    smooth = mixed_film(rough_line(speed=0.5))
    off = [
        np.max(np.abs(mixed_film(rough_line(sinusoid(height, "60 um"), speed=0.5)).gap / smooth.gap - 1.0))
        for height in (1e-11, 1e-12)
    ]
    assert off[0] < 2e-3
    assert off[1] == pytest.approx(0.1 * off[0], rel=0.05, abs=0.0)
