"""Formulas of rough films: smooth limits, published shares, and ranges."""

import numpy as np
import pytest
from benchmarks.film_mixed import (
    MixedFilm,
    RoughBodies,
    masjedi_khonsari_line,
    masjedi_khonsari_point,
)
from hypothesis import given
from hypothesis import strategies as st
from scipy import optimize

from ehlectric.formulas.film_line import LineContact, pan_hamrock
from ehlectric.formulas.film_point import PointContact, hamrock_dowson
from tests.helpers.each import each

RADIUS, MODULUS, G = 10e-3, 226e9, 4500.0


def line(w, u, g=G):
    return LineContact(
        reduced_radius=RADIUS,
        reduced_modulus=MODULUS,
        load_per_length=w * MODULUS * RADIUS,
        entrainment_speed=1.0,
        viscosity=u * MODULUS * RADIUS,
        pressure_viscosity_coefficient=g / MODULUS,
    )


def point(w, u, ratio=1.0, g=G):
    return PointContact(
        radius_x=RADIUS,
        radius_y=ratio * RADIUS,
        reduced_modulus=MODULUS,
        load=w * MODULUS * RADIUS**2,
        entrainment_speed=1.0,
        viscosity=u * MODULUS * RADIUS,
        pressure_viscosity_coefficient=g / MODULUS,
    )


def bodies(sigma, v=0.02):
    return RoughBodies(roughness=sigma, hardness=v * MODULUS)


def share_at(formula, contact, lam, v):
    """Asperity share at a lambda of the central film, on the branch on which lambda falls."""

    def excess(log_sigma):
        film = formula(contact, bodies(float(np.exp(log_sigma)), v)).central_thickness
        return film / np.exp(log_sigma) - lam

    smooth = formula(contact, bodies(0.0)).central_thickness
    root = optimize.brentq(excess, np.log(0.1 * smooth), np.log(2.0 * smooth))
    return formula(contact, bodies(float(np.exp(root)), v)).asperity_share


@each("w", [1e-6, 2e-6, 5e-6])
@each("u", [1e-12, 1e-11, 1e-10])
def test_smooth_circle_is_that_of_hamrock_and_dowson(w, u):
    found = masjedi_khonsari_point(point(w, u), bodies(0.0))
    reference = hamrock_dowson(point(w, u)).central_thickness
    assert found.central_thickness == pytest.approx(reference, rel=0.05)
    assert found.asperity_share == 0.0


def test_smooth_circles_are_within_three_per_cent_in_the_mean():
    ratios = [
        masjedi_khonsari_point(point(w, u), bodies(0.0)).central_thickness
        / hamrock_dowson(point(w, u)).central_thickness
        for w in (1e-6, 2e-6, 5e-6)
        for u in (1e-12, 1e-11, 1e-10)
    ]
    assert np.sqrt(np.mean((np.array(ratios) - 1.0) ** 2)) < 0.03


@pytest.mark.parametrize("ratio", [5.0, 25.0])
def test_smooth_ellipse(ratio):
    found = masjedi_khonsari_point(point(2e-6, 1e-11, ratio), bodies(0.0)).central_thickness
    assert found == pytest.approx(hamrock_dowson(point(2e-6, 1e-11, ratio)).central_thickness, rel=0.15)


@each("w", [5e-5, 1e-4, 5e-4])
@each("u", [1e-12, 1e-11, 1e-10])
def test_smooth_line_is_that_of_pan_and_hamrock(w, u):
    found, reference = masjedi_khonsari_line(line(w, u), bodies(0.0)), pan_hamrock(line(w, u))
    assert found.central_thickness == pytest.approx(reference.central_thickness, rel=0.12)
    assert found.minimum_thickness == pytest.approx(reference.minimum_thickness, rel=0.15)
    assert found.asperity_share == 0.0


def test_published_share_of_a_line():
    """17 % at lambda 0.94, of a contact whose inputs are not known: loads of steel contacts enclose it."""
    heavy, light = (share_at(masjedi_khonsari_line, line(w, 1e-11), 0.94, 0.02) for w in (5e-4, 1e-4))
    assert heavy < 0.17 < light < 0.34


def test_published_share_of_a_point():
    """35 % at lambda 0.93, of a contact whose inputs are not known: loads of steel contacts enclose it."""
    heavy, light = (share_at(masjedi_khonsari_point, point(w, 1e-11), 0.93, 0.02) for w in (5e-6, 1e-6))
    assert heavy < 0.35 < light < 0.7


@pytest.mark.parametrize(("formula", "contact"), [
    (masjedi_khonsari_line, line(2e-4, 1e-11)),
    (masjedi_khonsari_point, point(2e-6, 1e-11)),
])  # fmt: skip
@given(low=st.floats(1e-9, 4e-7), factor=st.floats(1.01, 3.0))
def test_rougher_bodies(formula, contact, low, factor):
    """A rougher contact has a thicker film of the mean planes, and more load on its asperities."""
    one, two = formula(contact, bodies(low)), formula(contact, bodies(low * factor))
    if two.central_thickness is not None:
        assert one.central_thickness < two.central_thickness
        assert one.central_thickness / low > two.central_thickness / (low * factor)
        assert 0.0 <= one.asperity_share <= two.asperity_share <= 1.0


def test_film_of_the_line_in_the_paper_s_terms():
    """Powers and factors once more, from the logarithm of each term."""
    w, u, s, v = 2e-4, 1e-11, 2e-5, 0.02
    logs = np.log([w, u, G, s, v])
    smooth = np.exp(np.log(2.691) + logs @ [-0.135, 0.705, 0.556, 0, 0])
    rough = np.exp(np.log(0.2) + logs @ [-0.229, -0.748, -0.842, 1.222, 0.223])
    found = masjedi_khonsari_line(line(w, u), bodies(s * RADIUS, v))
    assert found.central_thickness == pytest.approx(RADIUS * smooth * (1 + rough), rel=1e-9)
    least = np.exp(np.log(1.652) + logs @ [-0.077, 0.716, 0.695, 0, 0])
    rough = np.exp(np.log(0.026) + logs @ [-0.312, -0.809, -0.977, 1.120, 0.185])
    assert found.minimum_thickness == pytest.approx(RADIUS * least * (1 + rough), rel=1e-9)
    per_cent = np.exp(np.log(0.005) + logs @ [-0.408, -0.088, 0.103, 0, 0])
    per_cent *= np.log(1 + np.exp(np.log(4470) + logs @ [0.485, -3.741, -2.898, 6.015, 1.168]))
    assert 100 * found.asperity_share == pytest.approx(per_cent, rel=1e-9)


@pytest.mark.parametrize(("formula", "contact"), [
    (masjedi_khonsari_line, line),
    (masjedi_khonsari_point, point),
])  # fmt: skip
def test_no_film_where_the_formula_does_not_hold(formula, contact):
    assert formula(contact(1e-4, 1e-11, g=0.0), bodies(1e-7)) == MixedFilm()
    assert formula(contact(1e-4, 1e-11), bodies(1e-4)) == MixedFilm()
