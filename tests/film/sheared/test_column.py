"""Stress and flux of one column of the film, against closed forms and against quadrature of Yang and Wen."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from ehlectric.film.across_film import Across, Quadrature, to_points
from ehlectric.film.shear_flow import flux_of as flux_of_faces
from ehlectric.film.shear_laws import Rheology
from ehlectric.film.shear_stress import (
    EvenStress,
    column_flux,
    even_flux,
    middle_stress,
    middle_stresses,
    plane_flux,
    uniform_eyring,
)
from tests.helpers.each import each

EYRING = Rheology("eyring", {"eyring_stress": 1.0})
CARREAU = Rheology("carreau", {"carreau_stress": 1.0, "carreau_exponent": 0.5})
LIMITING = Rheology("limiting", {"limiting_coefficient": 0.05})
LAWS = [Rheology(), EYRING, CARREAU, LIMITING]


def flux_of(rheology, *columns):
    """Flux along one axis by the module of the law."""
    if rheology.law.even:
        fluidity, weight, gradient, slip = columns
        return even_flux(rheology, fluidity, weight, gradient[np.newaxis], slip[np.newaxis])
    return column_flux(rheology, *columns)


POINTS = Quadrature.gauss()
OFFSET = POINTS.offset[:, np.newaxis]


def varying(rng, columns):
    """Fluidity and weight at the Gauss points of columns with viscosity and density that vary across."""
    s = OFFSET
    fluidity = np.exp(rng.normal(size=columns) + 2.0 * rng.normal(size=columns) * s + s**2)
    return fluidity, s * (1.0 + 0.1 * rng.normal(size=columns) * s)


def rate_factor(rheology, stress):
    factor, _ = rheology.law.factor(np.atleast_1d(stress) ** 2, rheology.constants)
    return factor[0]


def test_couette_flow_has_the_stress_of_eyring():
    """Without a gradient tau = tau_0 asinh(eta gamma_dot/tau_0), for viscosities over ten decades."""
    fluidity = np.geomspace(1e-10, 1.0, 11)
    slip = np.full(11, 0.3)
    found = middle_stress(EYRING, fluidity[np.newaxis], np.zeros(11), slip, POINTS)
    np.testing.assert_allclose(found, np.arcsinh(slip / fluidity), rtol=1e-13)


@each("gradient", [1e-3, 0.2, 1.0, 10.0, 60.0, 100.0])
@each("slip", [0.0, 1e-3, 1.0, 1e3])
def test_quadrature_gives_the_closed_form_of_eyring(gradient, slip):
    """The closed form and the Gauss points agree in the flux and its derivatives."""
    fluidity, gradient, slip = np.array([0.7]), np.array([gradient]), np.array([slip])
    closed = uniform_eyring(fluidity, gradient, slip)
    summed = column_flux(EYRING, fluidity[np.newaxis], OFFSET, gradient, slip)
    np.testing.assert_allclose(summed.flux, closed.flux, rtol=1e-11)
    np.testing.assert_allclose(summed.by_gradient, closed.by_gradient, rtol=1e-11)
    size = abs(closed.flux[0])
    np.testing.assert_allclose(summed.by_slip, closed.by_slip, rtol=1e-9, atol=1e-12 * size)
    np.testing.assert_allclose(summed.by_viscosity, closed.by_viscosity, rtol=1e-9, atol=1e-12 * size)


def test_flux_of_eyring_in_a_slot():
    """Two resting plates: the flux per width over that of a Newtonian fluid, by hand.

    u_z = (tau_0/mu) sinh(z p_x/tau_0), so that Int u dz = -(2 tau_0 (h/2)^2/mu) (Y cosh Y - sinh Y)/Y^2 with
    Y = h p_x/(2 tau_0); over the Newtonian h^3 p_x/(12 mu): 3 (Y cosh Y - sinh Y)/Y^3.
    """
    y = np.array([0.01, 0.5, 2.0, 20.0])
    found = uniform_eyring(np.ones(4), 2.0 * y, np.zeros(4)).flux / (2.0 * y / 12.0)
    np.testing.assert_allclose(found, 3.0 * (y * np.cosh(y) - np.sinh(y)) / y**3, rtol=1e-9)


def test_flux_stays_finite_at_any_gradient():
    """Iterates of Newton's method may have any gradient."""
    found = uniform_eyring(np.ones(2), np.array([1e4, -1e6]), np.array([0.0, 1.0]))
    assert np.all(np.isfinite([found.flux, found.by_gradient[0]]))
    summed = column_flux(EYRING, np.ones((1, 2)), OFFSET, np.array([1e4, -1e6]), np.array([0.0, 1.0]))
    assert np.all(np.isfinite([summed.flux, summed.by_gradient[0]]))


@each("rheology", [Rheology(), EYRING, CARREAU], ids=lambda law: law.name)
@each("gradient, slip", [(0.4, 0.0), (0.8, 0.9), (-1.2, 0.5)])
def test_generalised_reynolds_equation(rheology, gradient, slip):
    """The integrals of Yang and Wen (1990), with effective viscosities, by adaptive quadrature.

    The mid-film stress is found by bisection; then eta_e, eta_e', rho', rho'' follow by nested quadrature.
    With them the mass flux relative to the mean speed is h^3 p_x (rho_e' eta_e/eta_e' - rho_e'') less the
    Couette part (rho_e' eta_e - rho_e/2) (u_b - u_a).
    """

    def mu(z):
        return np.exp(0.8 * (z - 0.5) - 1.5 * (z - 0.5) ** 2)

    def rho(z):
        return 1.0 + 0.2 * z - 0.1 * z**2

    def rate(z, t):
        stress = t + gradient * (z - 0.5)
        return stress * rate_factor(rheology, stress) / mu(z)

    def closing(t):
        return quad(rate, 0.0, 1.0, args=(t,), epsabs=1e-12, epsrel=1e-11)[0] - slip

    middle = brentq(closing, -1.2, 2.0, xtol=1e-13)

    def fluidity(z):
        return rate_factor(rheology, middle + gradient * (z - 0.5)) / mu(z)

    def inner(z, power):
        return quad(lambda s: s**power * fluidity(s), 0.0, z, epsabs=1e-12, epsrel=1e-11)[0]

    eta_e, eta_e_prime = 1.0 / inner(1.0, 0), 1.0 / inner(1.0, 1)
    density = quad(rho, 0.0, 1.0)[0]
    first, second = (quad(lambda z, k=k: rho(z) * inner(z, k), 0.0, 1.0, epsabs=1e-11)[0] for k in (0, 1))
    expected = gradient * (eta_e / eta_e_prime * first - second) - slip * (first * eta_e - 0.5 * density)

    zeta = POINTS.offset + 0.5
    below = zeta + 0.1 * zeta**2 - 0.1 / 3.0 * zeta**3 - 0.5 * density
    columns = (np.exp(-np.log(mu(zeta)))[:, np.newaxis], below[:, np.newaxis])
    arguments = np.array([gradient]), np.array([slip])
    assert flux_of(rheology, *columns, *arguments).flux[0] == pytest.approx(expected, rel=1e-8)
    if not rheology.law.even:
        assert middle_stress(rheology, columns[0], *arguments, POINTS)[0] == pytest.approx(middle, abs=1e-9)


@pytest.mark.slow
@pytest.mark.gate
@given(
    law=st.sampled_from(LAWS),
    log_gradient=st.floats(-3.0, 0.5),
    log_slip=st.floats(-4.0, 2.0),
    sign=st.sampled_from([-1.0, 1.0]),
    seed=st.integers(0, 1000),
)
def test_derivatives_of_a_column(law, log_gradient, log_slip, sign, seed):
    """Central differences by gradient, slip, and the viscosity and density at one point across the film."""
    rng = np.random.default_rng(seed)
    fluidity, weight = varying(rng, 1)
    point = rng.integers(len(OFFSET))
    gradient, slip = np.array([sign * 10.0**log_gradient]), np.array([10.0**log_slip])
    at_point = np.zeros_like(OFFSET)
    at_point[point] = 1.0

    def flux(by_q=0.0, by_g=0.0, by_mu=0.0, by_w=0.0):
        return flux_of(
            law,
            fluidity * np.exp(-by_mu * at_point),
            weight + by_w * at_point,
            gradient + by_q,
            slip + by_g,
        ).flux[0]

    found = flux_of(law, fluidity, weight, gradient, slip)
    e = 1e-5
    steps = {"by_q": e * abs(gradient[0]), "by_g": e * slip[0], "by_mu": e, "by_w": e}
    derivatives = (
        found.by_gradient[0, 0],
        found.by_slip[0, 0],
        found.by_viscosity[point, 0],
        found.by_weight[point, 0],
    )
    for (name, step), derivative in zip(steps.items(), derivatives, strict=True):
        difference = (flux(**{name: step}) - flux(**{name: -step})) / (2.0 * step)
        rounding = 1e-13 * np.sum(np.abs(found.by_weight * weight)) / step
        assert derivative == pytest.approx(difference, rel=2e-4, abs=10.0 * rounding + 1e-12), name


@given(seed=st.integers(0, 10_000), law=st.sampled_from([EYRING, CARREAU]))
def test_stresses_of_a_plane_give_the_slip(seed, law):
    """Both conditions of slip hold for gradients to 300, slips over 14 decades and fluidities over 11."""
    rng = np.random.default_rng(seed)
    fluidity = np.exp(-rng.uniform(0.0, 25.0, 20) + rng.uniform(-3.0, 3.0, 20) * np.cos(3.0 * OFFSET))
    gradient = rng.choice([-1.0, 1.0], (2, 20)) * 10.0 ** rng.uniform(-3.0, 2.5, (2, 20))
    slip = rng.choice([-1.0, 0.0, 1.0], (2, 20)) * 10.0 ** rng.uniform(-10.0, 4.0, (2, 20))
    t = middle_stresses(law, fluidity, gradient, slip, POINTS)

    def slips(t):
        stress = t[:, np.newaxis] + OFFSET * gradient[:, np.newaxis]
        factor, _ = law.law.factor(np.sum(stress**2, axis=0), law.constants)
        rate = POINTS.weights[:, np.newaxis] * fluidity * factor * stress
        return np.sum(rate, axis=1), np.sum(np.abs(rate), axis=1)

    found, size = slips(t)
    # The rates at both surfaces may be far larger than their difference: an error of 1e-11 in t is allowed.
    moved, _ = slips(t * (1.0 + 1e-11) + 1e-11)
    assert np.all(np.abs(found - slip) <= np.abs(moved - found) + 1e-11 * size + 1e-12 * np.abs(slip))


@pytest.mark.slow
@pytest.mark.gate
@given(seed=st.integers(0, 10_000), law=st.sampled_from([EYRING, CARREAU]))
def test_stresses_along_one_axis_are_those_of_a_line(seed, law):
    """Without slip and gradient along y the plane has the flux of a line contact, and its derivatives."""
    rng = np.random.default_rng(seed)
    fluidity, weight = varying(rng, 5)
    gradient, slip = 5.0 * rng.normal(size=5), rng.normal(size=5)
    zero = np.zeros(5)
    line = column_flux(law, fluidity, weight, gradient, slip)
    plane = plane_flux(law, fluidity, weight, np.stack([gradient, zero]), np.stack([slip, zero]))
    np.testing.assert_allclose(plane.flux, line.flux, rtol=1e-10, atol=1e-13)
    np.testing.assert_allclose(plane.by_gradient[0], line.by_gradient[0], rtol=1e-10)
    np.testing.assert_allclose(plane.by_slip[0], line.by_slip[0], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(plane.by_viscosity, line.by_viscosity, rtol=1e-8, atol=1e-11)


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=30)
@given(seed=st.integers(0, 10_000), law=st.sampled_from([EYRING, CARREAU]))
def test_derivatives_of_a_plane(seed, law):
    """Central differences by both gradients, both slips and a common factor of the viscosity."""
    rng = np.random.default_rng(seed)
    fluidity, weight = varying(rng, 4)
    arguments = [2.0 * rng.normal(size=(2, 4)), rng.normal(size=(2, 4))]

    def flux(which, axis, step):
        changed = [values.copy() for values in arguments]
        changed[which][axis] += step
        return plane_flux(law, fluidity, weight, *changed).flux

    found = plane_flux(law, fluidity, weight, *arguments)
    for which, derivative in enumerate((found.by_gradient, found.by_slip)):
        for axis in (0, 1):
            difference = (flux(which, axis, 1e-5) - flux(which, axis, -1e-5)) / 2e-5
            np.testing.assert_allclose(derivative[axis], difference, rtol=1e-5, atol=1e-8)
    thicker, thinner = (plane_flux(law, fluidity * np.exp(e), weight, *arguments).flux for e in (-1e-5, 1e-5))
    np.testing.assert_allclose(
        found.by_viscosity.sum(axis=0), (thicker - thinner) / 2e-5, rtol=1e-5, atol=1e-8
    )


@each("slip", [0.0, 0.1, 3.0, 300.0])
@each("law, error", [(EYRING, 1e-9), (CARREAU, 1e-6)])
def test_few_points_suffice_for_small_gradients(law, error, slip):
    """Columns with stress differences below 2 and a hot film have the flux of many points. The error of the
    derivative is the root of the error of the flux.
    """
    gradient = np.array([[1.9, -1.999, 0.01], [1.0, 1.5, 0.3]])
    slips = np.array([[slip] * 3, [0.0] * 3])
    zeta = Across.of(8).zeta
    ratio = np.repeat(-3.0 * (zeta * (1.0 - zeta))[:, np.newaxis], 3, axis=1)
    layers = np.repeat(1.0 - 0.1 * zeta[:, np.newaxis], 3, axis=1)
    values, below = to_points(8)
    few = flux_of_faces(law, np.ones(3), gradient, slips, (ratio, layers))
    many = plane_flux(law, np.exp(-values @ ratio), below @ layers, gradient, slips)
    np.testing.assert_allclose(few.flux, many.flux, rtol=error, atol=1e-12 * slip)
    np.testing.assert_allclose(few.by_gradient[0], many.by_gradient[0], rtol=3e-4)
    uniform = flux_of_faces(law, np.ones(3), gradient, slips)
    exact = plane_flux(law, np.ones((1, 3)), OFFSET, gradient, slips)
    np.testing.assert_allclose(uniform.flux, exact.flux, rtol=error)


def test_limit_bounds_the_mean_stress():
    """Uniform viscosity: the mid-film stress is x/(1 + x^5)^(1/5), whatever the pressure gradient is."""
    x = np.array([[1e-3, 0.5, 1.0, 30.0]])
    found = EvenStress.of(LIMITING, np.full((1, 4), 0.1), np.array([[0.0, 1.0, -5.0, 9.0]]), 0.1 * x, POINTS)
    np.testing.assert_allclose(found.middle, x / (1.0 + x**5) ** 0.2, rtol=1e-13)
    np.testing.assert_allclose(found.factor, x[0] / found.middle[0], rtol=1e-13)


@given(seed=st.integers(0, 10_000))
def test_derivatives_of_an_even_plane(seed):
    """Central differences at a limiting stress by both gradients and both slips."""
    rng = np.random.default_rng(seed)
    fluidity, weight = varying(rng, 4)
    arguments = [rng.normal(size=(2, 4)), rng.normal(size=(2, 4))]
    found = even_flux(LIMITING, fluidity, weight, *arguments)
    for which, derivative in enumerate((found.by_gradient, found.by_slip)):
        for axis in (0, 1):
            sides = []
            for step in (1e-5, -1e-5):
                changed = [values.copy() for values in arguments]
                changed[which][axis] += step
                sides.append(even_flux(LIMITING, fluidity, weight, *changed).flux)
            difference = (sides[0] - sides[1]) / 2e-5
            np.testing.assert_allclose(derivative[axis], difference, rtol=1e-5, atol=1e-8)


@each("law", [CARREAU, LIMITING])
@each("fluidity", [1e-3, 1.0, 30.0])
@each("gradient, slip", [(0.2, 0.5), (0.3, -4.0), (2.0, 0.01)])
def test_the_rates_at_the_stress_of_a_column_add_up_to_its_slip(law, fluidity, gradient, slip):
    """The column flows as much as its surfaces slide, at any viscosity."""
    slip *= fluidity * (1e-2 if law is LIMITING else 1.0)
    layers, gradient = fluidity * (1.0 + OFFSET), gradient * (1e-2 if law is LIMITING else 1.0)
    middle = middle_stress(law, layers, np.array([gradient]), np.array([slip]), POINTS)
    stress = middle[0] + gradient * POINTS.offset
    rates = layers[:, 0] * stress * law.law.factor(stress**2, law.constants)[0]
    assert POINTS.weights @ rates == pytest.approx(slip, rel=1e-9)
