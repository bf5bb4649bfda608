"""What must not change: a contact of the same groups, and one seen from its other surface."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric import Case, solve

LUBRICANT = {
    "viscosity": 0.04,
    "viscosity_law": "roelands",
    "pressure_viscosity_coefficient": 22e-9,
    "roelands_z": 0.67,
    "roelands_pressure": 0.198e9,
    "density_law": "dowson-higginson",
    "density_c1": 0.59e9,
    "density_c2": 1.34,
    "relative_permittivity": 2.4,
    "ambient_pressure": 1e5,
}
CONTACT = {
    "reduced_radius": 14.1e-3,
    "reduced_modulus": 226e9,
    "load_per_length": 4e5,
    "entrainment_speed": 2.0,
}


def scaled(*, radius=1.0, modulus=1.0, load=1.0, viscosity=1.0):
    """A contact of the same M and L, and of the same laws over p/p_h.

    ``load`` multiplies W = w/(E' R). M = W U^(-1/2) then asks for U = eta0 u_s/(E' R) times its square; p_h
    is E' sqrt(W/(2 pi)), and every pressure of the lubricant goes with it.
    """
    pressure = modulus * np.sqrt(load)
    contact = {
        "reduced_radius": radius * CONTACT["reduced_radius"],
        "reduced_modulus": modulus * CONTACT["reduced_modulus"],
        "load_per_length": load * modulus * radius * CONTACT["load_per_length"],
        "entrainment_speed": load**2 * modulus * radius / viscosity * CONTACT["entrainment_speed"],
    }
    lubricant = LUBRICANT | {
        name: pressure * LUBRICANT[name] for name in ("roelands_pressure", "density_c1", "ambient_pressure")
    }
    lubricant["viscosity"] *= viscosity
    lubricant["pressure_viscosity_coefficient"] /= pressure
    return Case.from_dict({"contact": contact, "lubricant": lubricant, "grid": {"nodes": 801}})


def dimensionless(result):
    """P and H of a result."""
    conditions = result.conditions
    return result.film.pressure / conditions.max_pressure, result.film.thickness / conditions.thickness_scale


@cache  # no fixture: hypothesis would write it out
def unscaled():
    return solve(scaled())


factor = st.floats(0.25, 4.0)


@pytest.mark.slow
@settings(deadline=None, max_examples=25)
@given(radius=factor, modulus=factor, load=factor, viscosity=factor)
def test_the_film_depends_on_m_and_l_alone(radius, modulus, load, viscosity):
    result = solve(scaled(radius=radius, modulus=modulus, load=load, viscosity=viscosity))
    for group in ("moes_m", "moes_l"):
        expected = getattr(unscaled().conditions.contact, group)
        assert getattr(result.conditions.contact, group) == pytest.approx(expected, rel=1e-12, abs=0.0)
    for values, expected in zip(dimensionless(result), dimensionless(unscaled()), strict=True):
        np.testing.assert_allclose(values, expected, rtol=1e-10)


@pytest.mark.slow
@pytest.mark.gate
@settings(deadline=None, max_examples=10)
@given(radius=factor, modulus=factor, viscosity=factor)
def test_the_field_of_similar_contacts_is_similar(radius, modulus, viscosity):
    """Of the same W the gaps are copies of each other, b/R included, and so are their fields."""
    result = solve(scaled(radius=radius, modulus=modulus, viscosity=viscosity))
    ours, theirs = result.summary()["field"], unscaled().summary()["field"]
    for name in ("max_dimensionless", "central_dimensionless", "capacitance_per_length", "thin_gap_error"):
        assert ours[name] == pytest.approx(theirs[name], rel=1e-9, abs=0.0)
    assert ours["high_field_width"] == pytest.approx(radius * theirs["high_field_width"], rel=1e-9, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
@settings(deadline=None, max_examples=10)
@given(voltage=st.floats(1e-3, 1e3), common=st.floats(-1e3, 1e3), sign=st.sampled_from([-1.0, 1.0]))
def test_the_field_of_a_contact_is_linear_in_the_voltage(voltage, common, sign):
    potentials = {"electric.potential_1": common, "electric.potential_2": common + sign * voltage}
    result = solve(scaled().replace(potentials))
    # Of potentials a thousand volts off, the voltage has its own rounding.
    scale = result.field.voltage / unscaled().field.voltage
    np.testing.assert_array_equal(result.film.thickness, unscaled().film.thickness)
    np.testing.assert_allclose(result.field.strength, scale * unscaled().field.strength, rtol=1e-9)
    ours, theirs = result.summary()["field"], unscaled().summary()["field"]
    for name in ("max_dimensionless", "high_field_width", "capacitance_per_length", "thin_gap_error"):
        assert ours[name] == pytest.approx(theirs[name], rel=1e-9, abs=0.0)
    assert ours["max_strength_position"] == theirs["max_strength_position"]


BODIES = (
    {"youngs_modulus": 80e9, "poissons_ratio": 0.25},
    {"youngs_modulus": 400e9, "poissons_ratio": 0.15},
)
WAVES = {"generator": "sinusoid", "amplitude": 30e-9, "wavelength": 120e-6}


def of_two_bodies(*, exchanged):
    """Two bodies that differ in everything, in either order; the first is the lower one."""
    first, second = (1, 0) if exchanged else (0, 1)
    radii, speeds, potentials = (0.02, 0.05), (3.0, 1.0), (-2.0, 5.0)
    contact = {
        "radius_1": radii[first],
        "radius_2": radii[second],
        "body_1": BODIES[first],
        "body_2": BODIES[second],
        "speed_1": speeds[first],
        "speed_2": speeds[second],
        "max_hertz_pressure": 0.8e9,
    }
    return Case.from_dict(
        {
            "contact": contact,
            "lubricant": LUBRICANT,
            "roughness": [{"surface": 1 + first, **WAVES}],
            "electric": {"potential_1": potentials[first], "potential_2": potentials[second]},
            "grid": {"nodes": 801},
        }
    )


def test_exchange_of_the_surfaces_turns_the_contact_upside_down():
    field, mirrored = (solve(of_two_bodies(exchanged=e)).field for e in (False, True))
    np.testing.assert_allclose(mirrored.y, -field.y[:, ::-1], atol=1e-15)
    np.testing.assert_allclose(mirrored.potential, field.potential[:, ::-1], atol=1e-10)
    np.testing.assert_allclose(mirrored.strength, field.strength[:, ::-1], rtol=1e-9)
    for name in ("capacitance", "capacitance_by_charge", "max_strength", "high_field_width"):
        assert getattr(mirrored, name) == pytest.approx(getattr(field, name), rel=1e-9, abs=0.0)
    assert {field.max_strength_wall, mirrored.max_strength_wall} == {"surface 1", "surface 2"}
