"""Rolling resistance after Biboulet and Houpert: the limits that their papers print."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe

from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz import axis_ratio
from ehlectric.formulas.inlet_supply import line_rolling_force, point_rolling_force
from tests.helpers.each import each

MODULUS, RADIUS, VISCOSITY = 226e9, 0.01, 0.02


def speed_of(parameter):
    """Entrainment speed [m/s] with a speed parameter U = 2 eta0 u/(E' R)."""
    return parameter * MODULUS * RADIUS / (2.0 * VISCOSITY)


def line(parameter):
    return LineContact(
        reduced_radius=RADIUS,
        reduced_modulus=MODULUS,
        load_per_length=1.0,
        entrainment_speed=speed_of(parameter),
        viscosity=VISCOSITY,
        pressure_viscosity_coefficient=0.0,
    )


def point(parameter, across):
    """Point contact whose ellipse is ``across`` times as wide as it is long."""
    radius_y = RADIUS * brentq(lambda ratio: axis_ratio(1.0, ratio) - across, 1.0, 1e5)
    return PointContact(
        radius_x=RADIUS,
        radius_y=radius_y,
        reduced_modulus=MODULUS,
        load=1.0,
        entrainment_speed=speed_of(parameter),
        viscosity=VISCOSITY,
        pressure_viscosity_coefficient=0.0,
    )


@each("parameter", [1e-12, 1e-11, 1e-10])
@each("load", [1e-4, 5e-4])
def test_heavy_line_contacts_have_the_printed_force(parameter, load):
    """Part 1 prints 8.26e-9 (U/1e-11)^0.75 E' R for every heavy load, and the constant 1.47 before U^0.75."""
    force = line_rolling_force(line(parameter), load * MODULUS * RADIUS) / (MODULUS * RADIUS)
    assert force == pytest.approx(8.26e-9 * (parameter / 1e-11) ** 0.75, rel=5e-3, abs=0.0)
    assert force == pytest.approx(1.47 * parameter**0.75, rel=5e-3, abs=0.0)


@pytest.mark.parametrize("load", [1e-7, 5e-7])
def test_light_line_contacts_have_the_printed_force(load):
    """Part 1 prints 14.2e-9 (U/1e-10)^0.5 (W/1e-6)^0.5 E' R for rigid bodies and an oil that stays thin."""
    parameter = 1e-10
    force = line_rolling_force(line(parameter), load * MODULUS * RADIUS) / (MODULUS * RADIUS)
    assert force == pytest.approx(14.2e-9 * (load / 1e-6) ** 0.5, rel=5e-3, abs=0.0)


@pytest.mark.parametrize("load", [1e-2, 1e-1])
def test_heavy_wide_point_contacts_have_the_printed_force(load):
    """Part 2 prints 10.9e-9 (k/0.01)^-0.667 (U/1e-11)^0.75 (W/1e-5)^0.333 E' Rx^2, far beyond M = 6.6."""
    force = point_rolling_force(point(1e-11, 100.0), load * MODULUS * RADIUS**2) / (MODULUS * RADIUS**2)
    assert force == pytest.approx(10.9e-9 * (load / 1e-5) ** (1.0 / 3.0), rel=0.01, abs=0.0)


@each("across", [1.0, 3.0, 10.0])
@each("load", [1e-8, 1e-5])
def test_point_contacts_by_hand(across, load):
    """Equation (32) with the printed c = 4 E/(pi (1 + Rx/Ry)), and 2 a from the elliptic integral."""
    contact, parameter = point(1e-11, across), 1e-11
    integral = float(ellipe(1.0 - across**-2))
    flat = RADIUS / contact.radius_y
    shape = 4.0 * integral / (math.pi * (1.0 + flat))
    newton = load * MODULUS * RADIUS**2
    # Harris and Kotzalas: a^3 = 6 k^2 E Q R/(pi E'), with 1/R the sum of 1/Rx and 1/Ry.
    wide = (6.0 * across**2 * integral * newton * RADIUS / (1.0 + flat) / (math.pi * MODULUS)) ** (1.0 / 3.0)
    heavy = shape**0.25 / across * load / parameter**0.75
    light, elastic = 0.77 * shape ** (-1 / 3) * across**-0.12 * parameter ** (-1 / 12), 1.8 * shape**-0.25
    expected = 2.0 * wide / RADIUS * parameter**0.75 * (elastic + (light - elastic) / (1.0 + heavy / 6.6))
    found = point_rolling_force(contact, newton) / (MODULUS * RADIUS**2)
    assert found == pytest.approx(expected, rel=1e-9, abs=0.0)


def test_loads_are_taken_together_and_no_load_has_no_force():
    contact, loads = point(1e-11, 8.0), np.array([[0.0, 1.0], [10.0, 900.0]])
    together = point_rolling_force(contact, loads)
    assert together.shape == (2, 2)
    assert together[0, 0] == 0.0
    assert together[1, 1] == pytest.approx(float(point_rolling_force(contact, 900.0)), rel=1e-12)
    # The load of the contact is not that of the force.
    other = dataclasses.replace(contact, load=123.0)
    np.testing.assert_allclose(point_rolling_force(other, loads), together, rtol=1e-12)
    assert line_rolling_force(line(1e-11), [0.0, 1e5])[0] == 0.0
