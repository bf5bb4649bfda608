"""Rough contacts under so light a load that a node or two carry it, also one at the edge of the domain."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import Case, load, save, solve
from ehlectric.film.dry_contact import dry_contact, relieved
from ehlectric.film.nested import levels_of
from ehlectric.film.newton import GridProblem, State
from ehlectric.film.touching_newton import touching_newton
from tests.helpers.mixed_films import gaussian, posed, rough_point

# Half-width 13 um, and waves higher than the indentation.
LIGHT = {
    "contact": {
        "reduced_radius": 0.01,
        "reduced_modulus": 10.0**10.5,
        "max_hertz_pressure": 10e6,
        "entrainment_speed": 1e-4,
    },
    "lubricant": {"base": "paper"},
    "roughness": [
        {"surface": 2, "generator": "gaussian", "rq": 1e-7, "correlation_length": 0.796e-6, "seed": 0}
    ],
    "grid": {"nodes": 66, "wedge": "second-order"},
}


@pytest.mark.parametrize("nodes", [18, 34])
def test_dry_contact_on_a_node_or_two(nodes):
    """No node is pierced, those in contact have the gap of the boundary film, and the load is carried."""
    problem = replace(posed(Case.from_dict(LIGHT)), nodes=nodes)
    level = levels_of(problem)[0]
    pressure = problem.geometry.dry_pressure(level.mesh.x, level.mesh.y)
    ambient = problem.fluid.ambient_pressure
    dry = dry_contact(level, pressure, problem.boundary_film, ambient)
    assert 1 <= np.count_nonzero(dry.touching) <= 2
    excess = dry.thickness - problem.boundary_film
    assert excess[level.mesh.inner].min() > -1e-12
    assert np.max(np.abs(excess[dry.touching])) < 1e-12
    assert np.vdot(level.weights, dry.pressure) == pytest.approx(level.load, rel=1e-9)


@pytest.mark.slow
def test_surfaces_that_touch_at_the_edge_of_the_domain_are_told(tmp_path):
    """An asperity at the last node has the gap of the boundary film, and no pressure."""
    table = LIGHT["roughness"][0] | {"correlation_length": 6.014948025679727e-06, "seed": 2}
    result = solve(Case.from_dict(LIGHT | {"roughness": [table]}))
    film = result.film
    assert film.converged
    assert film.thickness[-1] == pytest.approx(1e-9, rel=1e-12)
    assert film.thickness.min() > 1e-9 * (1.0 - 1e-9)
    (told,) = [each.text for each in result.warnings if each.code == "domain-too-small"]
    assert told.startswith("asperities are in contact at the edge of the domain")
    wide = solve(Case.from_dict(LIGHT | {"roughness": [table], "grid": LIGHT["grid"] | {"outlet": 4.0}}))
    assert "domain-too-small" not in [each.code for each in wide.warnings]
    np.testing.assert_array_equal(load(save(result, tmp_path)[1]).film.thickness, film.thickness)


@pytest.mark.slow
@pytest.mark.parametrize("steps", [1, 2, 3])
def test_no_iterate_that_did_not_converge_is_given_with_a_film_below_the_boundary_film(steps):
    """After few Newton steps asperities are still pressed into each other; the gap is that of the flow."""
    problem = posed(rough_point(gaussian("100 nm", "35 um"), nodes=65))
    levels = levels_of(problem)
    pressure = (
        problem.geometry.dry_pressure(levels[0].mesh.x, levels[0].mesh.y) + problem.fluid.ambient_pressure
    )
    pierced = State.of(levels[0], np.broadcast_to(pressure, levels[0].mesh.shape).copy(), -1.0)
    hs = problem.boundary_film
    on_grid = GridProblem(problem.fluid, levels, 1e-6, steps, asperities=problem.asperities)
    solution = touching_newton(on_grid, pierced)
    assert solution.status == "stalled"
    sunk = State.of(levels[0], solution.state.pressure, solution.state.h00).thickness
    assert sunk.min() < 0.0
    np.testing.assert_array_equal(solution.state.thickness, np.maximum(sunk, hs))


def test_asperities_that_pierce_a_film_are_relieved():
    """The rough surface pressed into a smooth film: no node is left pierced, and others push nowhere."""
    problem = posed(rough_point(gaussian("100 nm", "35 um"), nodes=65))
    level = levels_of(problem)[0]
    pressure = problem.geometry.dry_pressure(level.mesh.x, level.mesh.y) + problem.fluid.ambient_pressure
    pierced = State.of(level, np.broadcast_to(pressure, level.mesh.shape).copy(), -1.0)
    hs, inner = problem.boundary_film, level.mesh.inner
    assert pierced.thickness[inner].min() < -10.0 * hs
    state = relieved(level, pierced, hs)
    assert state.h00 == pierced.h00
    assert state.thickness[inner].min() > 0.99 * hs
    assert np.max(np.abs(state.thickness[state.touching] - hs)) < 0.01 * hs
    np.testing.assert_allclose(state.oil_pressure, pierced.pressure, rtol=0.0, atol=1e-12)
