"""Films with a layer of oil over time: what stands still, what is carried, and the balance of the oil."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film import unsteady
from ehlectric.film.flow import flow
from tests.helpers.starved_motion import layer_of, line, motion, oil_sums, point, smooth
from tests.helpers.transient_films import ridge


@pytest.fixture
def closely(monkeypatch):
    """Time steps that are solved to rounding."""
    monkeypatch.setattr(unsteady, "STEP_TOLERANCE", 1e-12)


def bump(height, width, start, speed=1.0):
    """Gap of a round peak, centred at X = start + speed T and Y = 0, its height in units of H."""

    def gap(time, x, y):
        along = (x[:, np.newaxis] - start - speed * time) / width
        return -height * np.exp(-(along**2) - (y / width) ** 2)

    return gap


@pytest.mark.parametrize(
    ("posed", "ratio", "steps"), [(line, 0.9, 40), (line, 0.2, 40), (line, 0.05, 40), (point, 0.1, 8)]
)
def test_a_steady_starved_film_stays(closely, posed, ratio, steps):
    """Without roughness and with steps of one spacing: P, H, the content and the filled nodes."""
    problem = posed(ratio)
    instants = [history.now for _, history in motion(problem, smooth, steps)]
    first, last = instants[0], instants[-1]
    assert np.any(~first.full_film[: first.mass.shape[0] // 4, 0])
    np.testing.assert_array_equal(last.full_film, first.full_film)
    assert np.max(np.abs(last.state.thickness - first.state.thickness)) < 1e-11
    assert np.max(np.abs(last.state.pressure - first.state.pressure)) < 1e-10
    inner = slice(1, -1)
    assert np.max(np.abs(last.mass - first.mass)[inner]) < 1e-11


def test_a_thick_layer_gives_the_flooded_motion():
    """A layer thicker than the gap at the inlet: the same numbers as without a layer."""
    problem = line(1000.0)
    gap = ridge(0.3 * layer_of(problem) / 1000.0, 0.15, -3.0)
    *_, (moving, supplied) = motion(problem, gap, 60)
    *_, (_, flooded) = motion(replace(problem, supply=None), gap, 60)
    assert moving.starved is None
    np.testing.assert_array_equal(supplied.now.state.pressure, flooded.now.state.pressure)
    np.testing.assert_array_equal(supplied.now.state.thickness, flooded.now.state.thickness)
    np.testing.assert_array_equal(supplied.now.mass, flooded.now.mass)


def oil_driven(moving, instant):
    """Oil that the pressure drives out of the inner nodes in a unit of time: the flow through the edges.

    Of the half of a symmetric point contact, in which no oil flows through y = 0.
    """
    state, mesh = instant.state, moving.film.level.mesh
    found = flow(moving.problem.fluid, state.pressure, state.thickness, mesh)
    lines = np.ones(mesh.shape[1], dtype=bool) if mesh.dy is None else mesh.inner[1]
    along = found.along.flux[:, lines]
    out = np.sum(along[0] - along[-1]) * mesh.dx
    if found.across is None:
        return out
    return out - np.sum(found.across.divergence().T[1:-1]) * mesh.dx**2


@pytest.mark.parametrize(
    ("ratio", "courant", "speed"), [(0.8, 1.0, 1.0), (0.4, 1.0, 0.5), (0.4, 0.7, 1.0), (0.1, 0.5, 1.5)]
)
def test_oil_in_minus_oil_out_is_the_change_of_content(closely, ratio, courant, speed):
    """A ridge of half the film passes: the sum of W over the inner nodes, and what crosses the two ends.

    With steps of a part c of a spacing the layer brings c m in, and c W of the last node leaves; a ridge as
    high is pressed flat, and the content may change by more than a per cent.
    """
    problem = line(ratio)
    gap = ridge(0.5 * layer_of(problem), 0.15, -3.2, speed)
    before, changes, errors = None, [], []
    for moving, history in motion(problem, gap, round(160 / courant), courant):
        content, dx = oil_sums(moving, history), moving.film.level.mesh.dx
        if before is not None:
            entered = courant * dx * (before[0, 0] - before[-2, 0])
            driven = courant * dx * oil_driven(moving, history.now) / dx
            change = dx * np.sum(content[1:-1] - before[1:-1])
            errors.append(change - entered + driven)
            changes.append(change)
        before = content
    assert before[0, 0] == pytest.approx(layer_of(problem), rel=1e-9)
    assert np.max(np.abs(changes)) > 1e-5
    assert np.max(np.abs(errors)) < 1e-10
