"""What every film whose surfaces may touch fulfils, for random contacts on small grids."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, event, given, settings
from hypothesis import strategies as st

from tests.helpers.mixed_films import gaussian, mixed_film, on_few_nodes, rough_line, rough_point, sinusoid

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
@pytest.mark.parametrize("speed", [2e-3, 1e-2])
def test_symmetric_roughness_has_a_symmetric_film(speed):
    """Bumps symmetric about y = 0: solved on the whole contact and on half of it."""
    half, whole = halved_and_whole(speed)
    np.testing.assert_allclose(whole.gap, half.mesh.mirrored(half.gap), rtol=1e-6)
    np.testing.assert_allclose(whole.pressure, half.mesh.mirrored(half.pressure), atol=1e-7)
    np.testing.assert_allclose(whole.gap, whole.gap[:, ::-1], rtol=1e-6)
    assert whole.share == pytest.approx(half.share, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [1e-3, 5e-3, 7e-3])
def test_films_of_the_same_contact_differ_at_single_nodes(speed):
    """Where oil forms again behind a spot, more than one film may fulfil the equations of a grid.

    The film found is symmetric. Solved on half of the contact, another one may be found: the load share and
    the mean film are nearly the same.
    """
    half, whole = halved_and_whole(speed)
    np.testing.assert_allclose(whole.gap, whole.gap[:, ::-1], rtol=1e-6)
    assert whole.share == pytest.approx(half.share, rel=3e-3)
    assert np.mean(whole.gap) == pytest.approx(np.mean(half.mesh.mirrored(half.gap)), rel=3e-3)
    assert np.sum(whole.touching) == np.sum(half.mesh.mirrored(half.touching.astype(float)))


def halved_and_whole(speed):
    """Films over bumps that are symmetric about y = 0, solved on half of the contact and on all of it."""

    def bumps(x, y):
        return 0.12 * np.cos(7.0 * x + 1.0)[:, np.newaxis] * np.cos(8.0 * y)

    problem = replace(on_few_nodes(rough_point(speed=speed), 33), added_gap=bumps)
    assert problem.width.symmetric
    half, whole = (
        mixed_film(problem),
        mixed_film(replace(problem, width=replace(problem.width, symmetric=False))),
    )
    assert half.converged
    assert whole.converged
    assert half.touching.any()
    return half, whole
