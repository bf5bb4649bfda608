"""One film of a contact in mixed lubrication: from any start, on half or the whole of it, by any rounding."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.mesh import Mesh
from ehlectric.film.nested import levels_of, mixed_from_dry
from ehlectric.film.oil_content import Supply
from ehlectric.runtime.threads import quiet_solution
from tests.helpers.mixed_films import MixedFilm, gaussian, mixed_film, posed, rough_line, rough_point

BALL = rough_point(gaussian(200e-9, 30e-6, seed=3), speed=0.02, boundary_film=3e-9)


def symmetric(problem, *, whole):
    """Contact with the mean of its surface and its mirror image, solved on half or on the whole domain."""
    added, width = problem.added_gap, replace(problem.width, symmetric=not whole)
    return replace(problem, added_gap=lambda x, y: 0.5 * (added(x, y) + added(x, -y)), width=width)


def rounded(problem):
    """Contact with heights that differ by rounding."""
    added = problem.added_gap

    def changed(x, y):
        return added(x, y) * (1.0 + 1e-13 * np.sin(331.0 * x[:, np.newaxis]) * np.cos(217.0 * y))

    return replace(problem, added_gap=changed)


def mean_film(film):
    """Mean gap over the Hertz zone outside the spots, dimensionless."""
    weights = np.where(film.zone & ~film.touching, film.last.level.weights, 0.0)
    return float(np.vdot(weights, film.gap) / np.sum(weights))


def from_dry(problem):
    """Film that starts from the dry contact on the finest grid alone."""
    with quiet_solution():
        return MixedFilm(problem, mixed_from_dry(problem, levels_of(problem)))


@pytest.mark.slow
@pytest.mark.gate
def test_a_ball_in_mixed_lubrication_has_one_film():
    """The film follows from the equations, so that all ways to solve them agree."""
    problem = symmetric(posed(BALL), whole=False)
    usual = mixed_film(problem)
    assert usual.converged
    assert 0.001 < usual.share < 0.5
    others = {
        "dry": from_dry(problem),
        "rounded": mixed_film(rounded(problem)),
        "whole": mixed_film(symmetric(posed(BALL), whole=True)),
    }
    for name, film in others.items():
        assert film.converged, name
        # A node at the edge of a cavity may still have two states. With formulas that jump there, films
        # differ by up to 3 %.
        assert film.share == pytest.approx(usual.share, rel=5e-4), name
        assert mean_film(film) == pytest.approx(mean_film(usual), rel=5e-4), name


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_rough_line_has_one_film(seed):
    """A film without contact is the same film from the coarser grid and from the dry contact."""
    problem = posed(rough_line(gaussian(200e-9, 20e-6, seed=seed), nodes=401, speed=0.5))
    usual, other = mixed_film(problem), from_dry(problem)
    assert usual.converged
    assert other.converged
    np.testing.assert_allclose(other.gap, usual.gap, rtol=1e-6)


def _state(random):
    """Mass of full gaps and excess pressures of nodes, about half of which are close to ambient pressure."""
    mass = np.exp(0.3 * random.normal(size=(40, 1)))
    excess = np.exp(2.0 * random.normal(size=(40, 1))) * 1e-3 * (random.random((40, 1)) < 0.9)
    return mass, excess


@pytest.mark.parametrize("order", [2, 3])
@pytest.mark.parametrize("steep", [False, True])
def test_derivative_of_the_wedge_by_the_pressure_of_its_nodes(order, steep):
    """Against central differences, at random pressures and gaps with cavities."""
    random, mesh = np.random.default_rng(2), Mesh.over(40, 0.0, 1.0)
    mass, excess = _state(random)
    filled = random.random((40, 1)) < 0.9
    change = 1e-3 * random.normal(size=(40, 1)) * filled
    supply = Supply(np.array([np.inf]), order)
    if steep:
        supply = supply.at_gap(mass)
    full = np.where(filled, mass, 0.0)

    def at(excess):
        return supply.at_state(excess, mass, 1e4 * np.ones_like(mass), 40.0)

    def wedge(excess):
        return at(excess).wedge(mesh, filled)(full)

    derivative = at(excess).by_fullness(mesh, filled, full)(change)
    numerical = (wedge(excess + 1e-6 * change) - wedge(excess - 1e-6 * change)) / 2e-6
    np.testing.assert_allclose(derivative, numerical, rtol=1e-5, atol=1e-5 * np.abs(derivative).max())


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("steep", [False, True])
@pytest.mark.parametrize("node", range(5, 35, 3))
def test_flow_does_not_jump_where_a_node_cavitates(order, steep, node):
    """A filled node at ambient pressure and a cavitated one that is just full pass on the same mass."""
    mass, excess = _state(np.random.default_rng(node))
    excess[node] = 0.0
    mesh, ones = Mesh.over(40, 0.0, 1.0), np.ones_like(mass)
    supply = Supply(np.array([np.inf]), order)
    if steep:
        supply = supply.at_gap(mass)
    supply = supply.at_state(excess, mass, 1e4 * ones, 40.0)
    filled = np.ones(mass.shape, dtype=bool)
    without = filled.copy()
    without[node] = False
    as_filled = supply.wedge(mesh, filled)(mass)
    as_cavitated = supply.wedge(mesh, without)(np.where(without, mass, 0.0))
    # The mass that the cavitated node passes on, of which its content follows.
    passed = _passed_on(supply, without, mass, node)
    as_cavitated[node] += passed / mesh.dx
    as_cavitated[node + 1] -= passed / mesh.dx
    np.testing.assert_allclose(as_cavitated, as_filled, rtol=1e-10, atol=1e-10 / mesh.dx)


def _passed_on(supply, filled, mass, node):
    """Mass that a cavitated node passes on if its content is the mass of the full gap, by bisection."""
    low, high = 0.0, 10.0 * float(mass.max())
    for _ in range(200):
        middle = 0.5 * (low + high)
        flow = np.where(filled, mass, middle)
        content = float(supply.at_rupture(filled, flow)[node, 0])
        low, high = (middle, high) if content < mass[node, 0] else (low, middle)
    return 0.5 * (low + high)


def test_oil_through_the_inlet_is_the_oil_through_the_contact():
    """The first face takes the mean mass of its two nodes, as the layer that a flooded film takes does."""
    film = mixed_film(posed(rough_line(gaussian(200e-9, 20e-6, seed=1), nodes=401, speed=0.5)))
    final = film.last.final
    mass = (final.coefficients.density * film.gap)[:, 0]
    driven = film.mesh.dx * final.flow.along.flux[:, 0]
    through_inlet = 0.5 * (mass[0] + mass[1]) - driven[0]
    # Of third order, where the pressure is far above ambient pressure.
    i = int(np.argmax(film.oil_pressure[:, 0]))
    through = (3.0 * mass[i + 1] + 6.0 * mass[i] - mass[i - 1]) / 8.0 - driven[i]
    assert film.last.content is not None
    assert through_inlet == pytest.approx(through, rel=1e-4)
