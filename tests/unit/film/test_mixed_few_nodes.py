"""Rough contacts under so light a load that a node or two carry it, also one at the edge of the domain."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import Case, load, save, solve
from ehlectric.film.mixed.dry import dry_contact
from ehlectric.film.nested import levels_of
from tests.helpers.mixed_films import posed

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
    level = levels_of(problem, roughness=1.0)[0]
    pressure = problem.geometry.dry_pressure(level.mesh.x, level.mesh.y)
    ambient = problem.fluid.ambient_pressure
    dry = dry_contact(level, pressure, problem.boundary_film, ambient)
    assert 1 <= np.count_nonzero(dry.touching) <= 2
    excess = dry.thickness - problem.boundary_film
    assert excess[level.mesh.inner].min() > -1e-12
    assert np.max(np.abs(excess[dry.touching])) < 1e-12
    assert np.vdot(level.weights, dry.pressure) == pytest.approx(level.load, rel=1e-9)


def test_surfaces_that_touch_at_the_edge_of_the_domain_are_no_solution(tmp_path):
    table = LIGHT["roughness"][0] | {"correlation_length": 6.014948025679727e-06, "seed": 2}
    result = solve(Case.from_dict(LIGHT | {"roughness": [table]}))
    assert result.film.thickness[-1] == pytest.approx(1e-9)
    assert result.film.thickness.min() > 0.99e-9
    assert not result.film.converged
    (told,) = [each.text for each in result.warnings if each.code == "not-converged"]
    assert "surfaces touch at the edge of the domain" in told
    back = load(save(result, tmp_path)[1])
    assert back.film.status == result.film.status
