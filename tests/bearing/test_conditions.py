"""A bearing file in numbers: materials and geometry by hand, of bearings whose two sides differ."""

import dataclasses
import math

import numpy as np
import pytest

from ehlectric.bearing.loads.geometry import BallBearing
from ehlectric.bearing.preparation import equilibria_of, resolve_bearing
from ehlectric.formulas.inlet_supply import inlet_shear_factor
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, changed, contact_of, ring_of

D, PITCH = 11.906e-3, 60e-3
SPEED = 3000.0 * 2.0 * math.pi / 60.0
CERAMIC = {"bearing__element_material": "silicon-nitride"}
ANGULAR = changed(
    BALLS,
    bearing__kind="angular-contact ball",
    bearing__contact_angle="40 deg",
    bearing__radial_clearance=None,
    bearing__outer_groove=0.53,
)


def test_ceramic_balls_in_steel_rings():
    """2/E' = (1 - 0.26^2)/315 GPa + (1 - 0.3^2)/208 GPa; 3200 kg/m^3 on 30 mm at the cage's speed."""
    case = bearing_case(BALLS, **CERAMIC)
    conditions = resolve_bearing(case)
    by_hand = 2.0 / ((1.0 - 0.26**2) / 315e9 + (1.0 - 0.3**2) / 208e9)
    assert conditions.modulus == pytest.approx(by_hand, rel=1e-12, abs=0.0)
    assert (conditions.element.youngs_modulus, conditions.ring.youngs_modulus) == (315e9, 208e9)
    assert (conditions.element.conducting, conditions.ring.conducting) == (False, True)
    at = equilibria_of(conditions, 1)[0]
    mass = 3200.0 * math.pi / 6.0 * D**3
    assert at.centrifugal_force == pytest.approx(mass * 0.5 * PITCH * at.cage_speed**2, rel=1e-9, abs=0.0)


@pytest.mark.parametrize(("material", "density"), [("steel", 7830.0), ("silicon-nitride", 3200.0)])
def test_centrifugal_force_of_a_files_rollers(material, density):
    """rho pi D^2 L/4 on d_m/2 at (1 - D/d_m)/2 of 3000 rpm."""
    case = bearing_case(ROLLERS, bearing__element_material=material)
    at = equilibria_of(resolve_bearing(case), 1)[0]
    cage = 0.5 * (1.0 - 11.0 / 60.0) * SPEED
    force = density * math.pi * 11e-3**2 * 10e-3 / 4.0 * 30e-3 * cage**2
    assert at.centrifugal_force == pytest.approx(force, rel=1e-9, abs=0.0)


def test_each_groove_is_that_of_its_ring():
    """1/Ry = 2/D - 1/(f D); 1/Rx of Harris at the angle that is asked for."""
    conditions = resolve_bearing(bearing_case(ANGULAR))
    own = dataclasses.replace(conditions.geometry, contact_angle=math.radians(40.0))
    assert conditions.geometry.contact_angle == pytest.approx(math.radians(40.0), rel=1e-12, abs=0.0)
    assert own == BallBearing(9, D, PITCH, 0.52, 0.53, contact_angle=math.radians(40.0))
    for inner, groove, sign in ((True, 0.52, 1.0), (False, 0.53, -1.0)):
        for angle in (0.0, 0.7):
            radii = conditions.geometry.radii(angle, inner=inner)
            c = math.cos(angle)
            rolling = 1.0 / (2.0 / D + sign * 2.0 * c / (PITCH - sign * D * c))
            assert radii.radius_x == pytest.approx(rolling, rel=1e-12, abs=0.0)
            assert radii.radius_y == pytest.approx(1.0 / (2.0 / D - 1.0 / (groove * D)), rel=1e-12, abs=0.0)


def test_loads_and_speed_of_the_file_are_the_rings():
    """The balls' forces add up to 1800 N radial and 300 N axial; entrainment w d_m (1 - g^2)/4."""
    case = bearing_case(BALLS)
    for at in equilibria_of(resolve_bearing(case), 3):
        q = at.inner_load
        assert q @ (np.cos(at.inner_angle) * np.cos(at.position)) == pytest.approx(1800.0, rel=1e-8, abs=0.0)
        assert q @ np.sin(at.inner_angle) == pytest.approx(300.0, rel=1e-7, abs=0.0)
        gamma = D / PITCH * np.cos(0.5 * (at.inner_angle + at.outer_angle))
        np.testing.assert_allclose(
            at.speeds.inner_entrainment, SPEED * PITCH / 4.0 * (1.0 - gamma**2), rtol=1e-12
        )


@pytest.mark.parametrize("celsius", [40.0, 70.0, 100.0])
def test_the_oil_is_that_of_the_bearings_temperature(celsius):
    """46 and 6.8 mm^2/s at 40 and 100 degC, 14.85 by hand between them, times the density there."""
    lubricant = resolve_bearing(bearing_case(BALLS, bearing__temperature=f"{celsius} degC")).oil
    kinematic = {40.0: 46e-6, 70.0: 14.85e-6, 100.0: 6.8e-6}[celsius]
    eta = kinematic * 870.0 * (1.0 - 6.5e-4 * (celsius - 15.0))
    assert lubricant.viscosity == pytest.approx(eta, rel=2e-4, abs=0.0)
    alpha = 0.67 * (math.log(eta) + 9.67) / 0.198e9
    assert lubricant.alpha == pytest.approx(alpha, rel=1e-4, abs=0.0)


@pytest.mark.parametrize(("tables", "exponent"), [(BALLS, 0.67), (ROLLERS, 0.69)])
def test_film_factor_of_balls_and_of_rollers(tables, exponent):
    """Half of the film is that at 0.5^(1/0.67) of the speed, or 0.5^(1/0.69); the speed itself stays."""
    ring = ring_of(bearing_case(tables, bearing__film_factor=0.5), speed=4.5)
    conditions = contact_of(ring, 800.0).conditions
    assert ring.conditions.film_factor == conditions.film_factor == 0.5
    assert ring.speed == conditions.entrainment_speed == 4.5
    assert conditions.contact.entrainment_speed == pytest.approx(
        4.5 * 0.5 ** (1.0 / exponent), rel=1e-12, abs=0.0
    )


def test_heat_of_the_inlet_of_an_angular_contact_bearing():
    """At 40 degrees and 12 000 rpm: u = w d_m (1 - g^2)/4 with g = D cos a/d_m, beta of nu and of rho."""
    case = bearing_case(
        ANGULAR,
        bearing__film_factor="inlet-shear",
        bearing__inner_speed="12000 rpm",
        lubricant__temperature__thermal_conductivity="0.14 W/m/K",
        lubricant__temperature__expansion="2e-3 1/K",
    )
    conditions = resolve_bearing(case)
    gamma = D / PITCH * math.cos(math.radians(40.0))
    speed = 4.0 * SPEED * PITCH / 4.0 * (1.0 - gamma**2)
    eta = [case.lubricant.at(343.15 + d).viscosity for d in (-0.05, 0.05)]
    expected = inlet_shear_factor(conditions.oil.viscosity, math.log(eta[0] / eta[1]) / 0.1, speed, 0.14)
    assert expected < 0.9
    # Expansion goes by the density at 15 degC, of which there is 11 % less at 70 degC: 1 % of beta.
    assert conditions.film_factor == pytest.approx(expected, rel=2e-3, abs=0.0)


def test_inlet_shear_factor_with_an_oil_that_has_laws():
    """FVA 3 at 70 degC by Vogel's law: eta = K exp(B/(T - C)), beta = B/(T - C)^2, and k = 0.134 W/(m K)."""
    case = bearing_case(BALLS, bearing__film_factor="inlet-shear", lubricant={"base": "fva-3"})
    above = 343.15 - 171.5983
    eta, beta = 6.2e-5 * math.exp(1021.7 / above), 1021.7 / above**2
    speed = math.pi * 50.0 * (0.06**2 - 0.011906**2) / (2.0 * 0.06)
    expected = 1.0 / (1.0 + 0.241 * (eta * beta * speed**2 / 0.134) ** 0.64)
    # The speed of the program is that at the free contact angle.
    assert resolve_bearing(case).film_factor == pytest.approx(expected, rel=2e-4)
