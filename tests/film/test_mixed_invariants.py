"""What every film whose surfaces may touch fulfils, for random contacts on small grids."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, event, given, settings
from hypothesis import strategies as st

from ehlectric.film.dry_contact import dry_contact
from ehlectric.film.nested import levels_of
from ehlectric.film.newton import State
from ehlectric.film.oil_content import Carried
from ehlectric.film.touching_film import assess_touching
from ehlectric.film.touching_newton import is_solved, newton_step
from tests.helpers.mixed_films import gaussian, mixed_film, on_few_nodes, rough_line, rough_point, sinusoid

pytestmark = pytest.mark.convergence

# Twice the tolerance of the oil's own equation in a spot, where its pressure does not move the gap.
OIL = 2e-6

exponents = st.integers(-40, 5).map(lambda tenths: 10.0 ** (0.1 * tenths))
boundary_films = st.sampled_from([0.5e-9, 1e-9, 2e-9, 5e-9])
heights = st.integers(30, 300).map(lambda nanometres: 1e-9 * nanometres)
lines = st.one_of(
    st.builds(gaussian, heights, st.integers(10, 60).map(lambda um: 1e-6 * um), seed=st.integers(0, 999)),
    st.builds(
        sinusoid,
        heights,
        st.integers(20, 120).map(lambda um: 1e-6 * um),
        phase=st.integers(0, 62).map(lambda tenth: 0.1 * tenth),
    ),
)
maps = st.builds(
    gaussian,
    st.integers(20, 150).map(lambda nanometres: 1e-9 * nanometres),
    st.integers(25, 34).map(lambda um: 1e-6 * um),
    seed=st.integers(0, 999),
)


def check(film):
    """Complementarity, cavitation and balance of a converged film, to the tolerance of its iteration."""
    event(film.last.status)
    assume(film.converged)
    problem, gap, contact = film.problem, film.gap, film.contact_pressure
    boundary, ambient = problem.boundary_film, problem.fluid.ambient_pressure
    tolerance = 2.0 * problem.tolerance
    # Change of the gap under a node by a pressure as large as the tolerance on it.
    own = tolerance * float(film.last.level.deflection.influence[0, 0])
    event("touches" if film.touching.any() else "does not touch")
    assert gap.min() > boundary - own
    assert contact.min() >= 0.0
    assert np.max(np.abs(gap - boundary), where=film.touching, initial=0.0) < own
    assert film.oil_pressure.min() > ambient - 1e-12
    assert np.max(np.abs(film.oil_pressure[film.mesh.edge] - ambient)) < 1e-12
    carried = np.sum(film.last.level.weights * film.pressure)
    assert carried == pytest.approx(problem.geometry.load, rel=0.1 * tolerance)
    assert 0.0 <= film.share <= 1.0
    # Where oil fills the gap, also in a spot, none is lost; where it does not, only oil is missing.
    residual = film.last.final.scaled
    full = film.oil_pressure > ambient + 1e-9
    assert np.max(np.abs(residual), where=full & ~film.touching, initial=0.0) < tolerance
    assert np.max(np.abs(residual), where=full & film.touching, initial=0.0) < OIL
    assert np.min(residual, where=~full & film.mesh.inner, initial=0.0) > -OIL


def test_film_that_nearly_touches_has_the_tolerance_of_its_case():
    film = mixed_film(rough_line(gaussian(30e-9, 10e-6, seed=28), nodes=201, speed=0.05))
    assert film.converged
    assert not film.touching.any()
    assert film.last.final.norm < film.problem.tolerance


@pytest.mark.slow
@pytest.mark.gate
@given(lines, exponents, boundary_films)
@settings(max_examples=20, deadline=None)
def test_lines(table, speed, boundary_film):
    check(mixed_film(rough_line(table, nodes=201, speed=speed, boundary_film=boundary_film)))


@pytest.mark.slow
@given(maps, exponents, boundary_films)
@settings(max_examples=8, deadline=None)
def test_points(table, speed, boundary_film):
    check(mixed_film(on_few_nodes(rough_point(table, speed=speed, boundary_film=boundary_film), 33)))


@pytest.mark.slow
@given(maps, exponents, boundary_films)
@settings(max_examples=40, deadline=None)
def test_more_points(table, speed, boundary_film):
    check(mixed_film(rough_point(table, speed=speed, boundary_film=boundary_film)))


@pytest.mark.slow
def test_symmetric_roughness_has_a_symmetric_film():
    """Bumps symmetric about y = 0: solved on the whole contact and on half of it.

    At this speed only one film is found, whatever the rounding.
    """
    half, whole = halved_and_whole(1e-2)
    np.testing.assert_allclose(whole.gap, half.mesh.mirrored(half.gap), rtol=1e-6)
    np.testing.assert_allclose(whole.pressure, half.mesh.mirrored(half.pressure), atol=1e-7)
    np.testing.assert_allclose(whole.gap, whole.gap[:, ::-1], rtol=1e-6)
    assert whole.share == pytest.approx(half.share, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [1e-3, pytest.param(2e-3, marks=pytest.mark.gate), 5e-3, 7e-3, 1e-2])
def test_mirror_images_of_a_film_solve_the_equations_of_the_whole_contact(speed):
    """More than one film may solve the equations of a grid, and rounding decides which one is found.

    Each film is a solution: the film of half of the contact with its mirror image, the film of the whole
    contact, and its mirror image. Their load shares and mean films are nearly equal.
    """
    half, whole = halved_and_whole(speed)
    for film, image in (
        (half, half.mesh.mirrored),
        (whole, lambda values: values),
        (whole, lambda values: values[:, ::-1]),
    ):
        now = residual_of_image(film, whole.problem, image)
        assert is_solved(now, 2.0 * whole.problem.tolerance)
    assert whole.share == pytest.approx(half.share, rel=3e-3)
    gap, touching = half.mesh.mirrored(half.gap), half.mesh.mirrored(half.touching)
    assert np.mean(whole.gap) == pytest.approx(np.mean(gap), rel=3e-4)
    outside, of_whole = whole.zone & ~touching, whole.zone & ~whole.touching
    assert np.mean(whole.gap[of_whole]) == pytest.approx(np.mean(gap[outside]), rel=2e-2)
    assert np.sum(whole.touching) == pytest.approx(np.sum(touching), rel=2e-2)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [pytest.param(2e-3, marks=pytest.mark.gate), 1e-2])
def test_newton_step_of_half_of_a_contact_is_that_of_the_whole(speed):
    """From the same film, steps that are solved closely differ by rounding only."""
    half, whole = half_and_whole_problem(speed)
    levels, whole_levels = levels_of(half), levels_of(whole)
    level, mirrored = levels[0], levels[0].mesh.mirrored
    hertz = np.broadcast_to(half.geometry.dry_pressure(level.mesh.x, level.mesh.y), level.mesh.shape)
    dry = dry_contact(level, hertz, half.boundary_film, half.fluid.ambient_pressure)
    state = replace(dry, contact_pressure=0.3 * np.asarray(dry.contact_pressure))
    for _ in range(3):
        image = State.of(
            whole_levels[0], mirrored(state.pressure), state.h00, mirrored(state.contact_pressure)
        )
        step, of_whole = one_step(half, levels, state), one_step(whole, whole_levels, image)
        np.testing.assert_allclose(of_whole.state.pressure, mirrored(step.state.pressure), atol=1e-9)
        assert of_whole.length == pytest.approx(step.length, rel=1e-6)
        state = step.state


def one_step(problem, levels, state):
    """Newton step from a film, with a linear system that is solved to ten digits."""
    now = assess_touching(problem.fluid, levels[0], state, problem.asperities)
    return newton_step(problem.fluid, levels, state, now, problem.asperities, 1e-10, 1.0)


def residual_of_image(film, problem, image):
    """Residual of an image of a film in the equations of a problem; ``image`` maps nodal values (nx, ny)."""
    last, level = film.last, levels_of(problem)[0]
    carried = last.content
    if carried is not None:
        supply = carried.supply
        upwind = np.broadcast_to(supply.upwind, film.mesh.shape)
        supply = replace(supply, mass=image(supply.mass[np.newaxis])[0], upwind=image(upwind))
        carried = Carried(supply, image(carried.filled))
    state = State.of(level, image(film.pressure), last.state.h00, image(film.contact_pressure))
    return assess_touching(problem.fluid, level, state, problem.asperities, carried)


def half_and_whole_problem(speed):
    """Problems over bumps that are symmetric about y = 0, of half of the contact and of all of it."""

    def bumps(x, y):
        return 0.12 * np.cos(7.0 * x + 1.0)[:, np.newaxis] * np.cos(8.0 * y)

    half = replace(on_few_nodes(rough_point(speed=speed), 33), added_gap=bumps)
    assert half.width.symmetric
    return half, replace(half, width=replace(half.width, symmetric=False))


def halved_and_whole(speed):
    """Films over these bumps, solved on half of the contact and on all of it."""
    half, whole = map(mixed_film, half_and_whole_problem(speed))
    assert half.converged
    assert whole.converged
    assert half.touching.any()
    return half, whole
