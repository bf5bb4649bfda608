"""Films with a layer of oil over time: what stands still, what is carried, and the balance of the oil."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film import unsteady
from ehlectric.film.face_flow import flow
from ehlectric.film.mesh import at_centre
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.runtime.threads import quiet_solution
from tests.helpers.starved_motion import layer_of, line, motion, oil_sums, point, smooth
from tests.helpers.transient_films import ridge

pytestmark = pytest.mark.convergence


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


@pytest.mark.slow
@pytest.mark.parametrize(
    ("posed", "ratio", "steps"), [(line, 0.9, 40), (line, 0.2, 40), (line, 0.05, 40), (point, 0.1, 8)]
)
@pytest.mark.usefixtures("closely")
def test_a_steady_starved_film_stays(posed, ratio, steps):
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


@pytest.mark.slow
@pytest.mark.gate
def test_a_thick_layer_gives_the_flooded_motion():
    """A layer thicker than the gap at the inlet: the same numbers as without a layer."""
    problem = line(1000.0)
    gap = ridge(0.3 * layer_of(problem) / 1000.0, 0.15, -3.0)
    *_, (moving, supplied) = motion(problem, gap, 60)
    *_, (_, flooded) = motion(replace(problem, supply=None), gap, 60)
    assert moving.layer is None
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


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "courant", "speed"),
    [pytest.param(0.8, 1.0, 1.0, marks=pytest.mark.gate), (0.4, 1.0, 0.5), (0.4, 0.7, 1.0), (0.1, 0.5, 1.5)],
)
@pytest.mark.usefixtures("closely")
def test_oil_in_minus_oil_out_is_the_change_of_content(ratio, courant, speed):
    """A ridge of half the layer passes: the sum of W over the inner nodes, and what crosses the two ends.

    With steps of c spacings the layer brings c m in, and c W of the last node leaves.
    """
    problem = line(ratio)
    gap = ridge(0.5 * layer_of(problem), 0.15, -2.0, speed)
    before, moved, errors = None, [], []
    for moving, history in motion(problem, gap, round(88 / courant), courant):
        content, dx = oil_sums(moving, history), moving.film.level.mesh.dx
        if before is not None:
            entered = courant * dx * (before[0, 0] - before[-2, 0])
            driven = courant * dx * oil_driven(moving, history.now) / dx
            change = dx * np.sum(content[1:-1] - before[1:-1])
            errors.append(change - entered + driven)
            moved.append(np.sum(np.abs(content - before)))
        before = content
    ambient = history.now.density[0, 0]
    assert before[0, 0] == pytest.approx(ambient * layer_of(problem), rel=1e-9)
    # Oil moves inside the domain by far more than the balance is off.
    assert np.max(moved) > 1e-5
    assert np.max(np.abs(errors)) < 1e-11


@pytest.mark.slow
@pytest.mark.usefixtures("closely")
def test_oil_of_a_point_contact_is_conserved():
    """A round peak passes; beside the two ends the sides of the domain may take oil."""
    problem = point(0.4)
    gap = bump(0.5 * layer_of(problem), 0.3, -3.2)
    before, moved, errors = None, [], []
    for moving, history in motion(problem, gap, 24):
        content, mesh = oil_sums(moving, history), moving.film.level.mesh
        if before is not None:
            lines = mesh.inner[1]
            entered = np.sum((before[0] - before[-2])[lines])
            driven = oil_driven(moving, history.now) / mesh.dx
            change = np.sum((content - before)[mesh.inner])
            errors.append(change - entered + driven)
            moved.append(np.sum(np.abs(content - before)))
        before = content
    assert np.max(moved) > 1e-3
    assert np.max(np.abs(errors)) < 1e-9


def with_wave(moving, history, wave, step):
    """History whose cavitated inlet carries a wave: mass times ``wave`` of X - T, at both instants."""
    x = moving.film.level.mesh.x[:, np.newaxis]
    now, before = history.now, history.before
    ahead = ~now.full_film & (x < 0.0)
    ahead[0] = False
    return replace(
        history,
        now=replace(now, mass=np.where(ahead, now.mass * wave(x), now.mass)),
        before=replace(before, mass=np.where(ahead, before.mass * wave(x + step), before.mass)),
    )


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("courant", [1.0, 2.0])
def test_a_wave_of_the_layer_travels_unchanged_to_the_meniscus(courant):
    """Between the inlet edge and the meniscus the oil is where it was a time T before, T upstream."""
    problem, steps = line(0.3), 24
    moving = MovingFilm(problem, smooth)
    mesh = moving.film.level.mesh
    step = courant * mesh.dx
    history = first = with_wave(moving, moving.start(step), lambda x: 1.0 + 0.3 * np.sin(9.0 * x), step)
    with quiet_solution():
        for _ in range(steps):
            history = moving.film.advance(history, step)
    travelled = round(steps * courant)
    meniscus = int(np.argmax(first.now.full_film[:, 0])) - 4
    arrived = history.now.mass[travelled + 1 : meniscus]
    assert len(arrived) > 15
    assert np.ptp(arrived) > 0.1 * np.mean(arrived)
    np.testing.assert_allclose(arrived, first.now.mass[1 : meniscus - travelled], rtol=1e-12)


def test_steps_between_the_nodes_carry_the_layer_upstream_weighted():
    """Half a spacing a step: a wave falls as by linear interpolation, abs(1 - c + c exp(-i k dX)) a step.

    The loss in a time is of first order in the spacing.
    """
    problem = line(0.3)
    moving = MovingFilm(problem, smooth)
    mesh = moving.film.level.mesh
    number, steps, step = 2.0 * np.pi / (10 * mesh.dx), 20, 0.5 * mesh.dx
    x = mesh.x
    mean = float(moving.start(step).now.mass[0, 0])
    history = with_wave(moving, moving.start(step), lambda x: 1.0 + 0.3 * np.sin(number * x), step)
    with quiet_solution():
        for _ in range(steps):
            history = moving.film.advance(history, step)
    growth = abs(0.5 + 0.5 * np.exp(-1j * number * mesh.dx)) ** steps
    expected = mean * (1.0 + 0.3 * growth * np.sin(number * (x - history.now.time)))
    middle = slice(25, int(np.argmax(history.now.full_film[:, 0])) - 4)
    np.testing.assert_allclose(history.now.mass[middle, 0], expected[middle], rtol=1e-9)
    assert growth < 0.9


@pytest.mark.slow
@pytest.mark.gate
def test_a_layer_that_changes_leads_to_its_own_stationary_film():
    """From the film of one layer to that of 0.8 of it: the stationary film, once other oil has left."""
    problem = line(0.5)
    thinner = replace(problem, supply=replace(problem.supply, layer=lambda y: 0.8 * problem.supply.layer(y)))
    expected = MovingFilm(thinner, smooth)
    start, then = MovingFilm(problem, smooth), MovingFilm(thinner, smooth).film
    step = start.steady.level.mesh.dx
    history = start.start(step)
    with quiet_solution():
        for _ in range(280):
            history = then.advance(history, step)
    found, steady = history.now.state.thickness, expected.steady.state.thickness
    assert np.max(np.abs(start.steady.state.thickness - steady)) > 1e-3
    mesh, filled = expected.steady.level.mesh, (history.now.full_film, expected.steady.content.filled)
    assert at_centre(mesh, found) == pytest.approx(at_centre(mesh, steady), rel=1e-5)
    # Both films may be stationary with menisci that are a node apart.
    assert abs(np.diff([np.argmax(each[:, 0]) for each in filled])[0]) <= 1
    np.testing.assert_allclose(found, steady, rtol=4e-3)


def waves(height, length, speed):
    """Gap of a sinusoid that enters behind X = -3 over one half-width."""

    def gap(time, x, y):
        behind = np.clip(-3.0 + speed * time - x, 0.0, 1.0)
        rise = np.sin(0.5 * np.pi * behind) ** 2
        shape = -height * rise * np.sin(2.0 * np.pi * (x - speed * time) / length)
        return shape[:, np.newaxis] + np.zeros_like(y)

    return gap


@pytest.mark.slow
def test_the_mean_film_under_waviness_is_the_layer():
    """A wave of a third of the film in a starved line: over its periods the mass at X = 0 is the layer's.

    The oil that the meniscus holds back in one half of a period passes in the other.
    """
    problem = line(0.3)
    layer, length = layer_of(problem), 0.5
    masses, films = [], []
    for moving, history in motion(problem, waves(layer / 3.0, length, 1.0), 260):
        now, mesh = history.now, moving.film.level.mesh
        if now.time > 260 * mesh.dx - 4.0 * length + 0.5 * mesh.dx:
            masses.append(at_centre(mesh, now.mass))
            films.append(at_centre(mesh, now.state.thickness))
    ambient, density = now.density[0, 0], at_centre(mesh, now.density)
    assert len(masses) == 80
    assert np.ptp(masses) > 1e-3 * layer
    assert np.mean(masses) == pytest.approx(ambient * layer, rel=2e-3)
    assert np.mean(films) == pytest.approx(ambient * layer / density, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_random_moving_starved_lines_run_through(seed):
    """Loads, speeds, layers, waves up to the layer, slide-to-roll ratios: no step fails."""
    random = np.random.default_rng(seed)
    problem = line(
        float(random.uniform(0.05, 0.95)),
        max_hertz_pressure=float(random.uniform(0.5e9, 2e9)),
        entrainment_speed=float(np.exp(random.uniform(np.log(0.5), np.log(10.0)))),
    )
    problem = replace(problem, tolerance=1e-9)
    speed = 1.0 + 0.5 * float(random.uniform(-1.0, 1.0))
    gap = waves(float(random.uniform(0.1, 1.0)) * layer_of(problem), float(random.uniform(0.3, 1.0)), speed)
    halvings = 0
    for _, history in motion(problem, gap, 240):
        halvings += history.effort.halvings
        assert np.min(history.now.state.thickness) > 0.0
        assert np.min(history.now.mass) >= 0.0
    assert halvings <= 5
