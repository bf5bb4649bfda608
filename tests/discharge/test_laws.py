"""Breakdown voltage and probability, energy, pit and leakage against closed forms and numbers by hand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.discharge.discharge_laws import (
    WeakestLink,
    breakdown_voltage,
    melted_volume,
    pit_diameter,
    relaxation_time,
    stored_energy,
)
from ehlectric.field.zones import part_widths
from tests.field.exact_fields import near
from tests.helpers.each import each


def link(strength, areas, *, shape, voltage=1.0, scale=1.0, reference_area=1.0):
    fields, parts = np.array(strength, dtype=float), np.array(areas, dtype=float)
    return WeakestLink.of(voltage, fields, parts, scale, shape, reference_area)


def test_breakdown_is_where_the_strength_is_used_most():
    """3/10, 8/40 and 5/12 of it used at 2 V: 2 V times 12/5, though the largest field is another's."""
    strength, withstood = np.array([3.0, 8.0, 5.0]), np.array([10.0, 40.0, 12.0])
    assert breakdown_voltage(2.0, strength, withstood) == near(4.8, 1e-15)


@each("shape", [0.5, 1.0, 5.0, 200.0])
def test_uniform_film(shape):
    """P = 1 - exp(-(V/(h E0))^m A/A0), with plates 1 um apart, 10 V/um and three reference areas."""
    gap, scale, reference_area = 1e-6, 10e6, 2e-9
    law = link(np.full(7, 4.0 / gap), np.full(7, 3.0 / 7.0 * reference_area),
               shape=shape, voltage=4.0, scale=scale, reference_area=reference_area)  # fmt: skip
    for voltage in (0.5, 4.0, 9.0, 9.9, 12.0):
        exact = -math.expm1(-((voltage / (gap * scale)) ** shape) * 3.0)
        assert law.probability(voltage) == near(exact, 1e-11)
    assert law.characteristic_voltage == near(gap * scale * 3.0 ** (-1.0 / shape), 1e-13)


def test_two_patches_survive_independently():
    """1 - P is the product over the patches: exp(-(1/2)^3 2) exp(-(3/2)^3 (1/3)) at scale and area 1."""
    survival = math.exp(-2.0 / 8.0) * math.exp(-27.0 / 8.0 / 3.0)
    law = link([0.5, 1.5], [2.0, 1.0 / 3.0], shape=3.0)
    assert law.probability(1.0) == near(1.0 - survival, 1e-13)


def test_small_probabilities_keep_their_digits():
    """1 - exp(-x) is x(1 - x/2) below the rounding of 1."""
    assert link([1e-4], [1.0], shape=5.0).probability(1.0) == near(1e-20, 1e-12)


@pytest.mark.parametrize("shape", [2.5, 9.2, 17.6])
def test_linear_field(shape):
    """E = E0 x/L over 0 < x < L: the exponent at 1 V is 1/(m + 1); the sum is of second order."""
    errors = []
    for cells in (64, 128, 256, 512):
        x = np.linspace(0.0, 1.0, cells + 1)
        exponent = link(x, part_widths(x, -np.inf, np.inf), shape=shape).characteristic_voltage ** -shape
        errors.append(abs(exponent * (shape + 1.0) - 1.0))
    assert errors[-1] < 1.05 * shape * (shape + 1.0) / 12.0 / 512**2
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders[-2:] == pytest.approx(2.0, abs=0.05)


@pytest.mark.parametrize("shape", [1.0, 4.0, 12.0])
def test_field_over_an_area(shape):
    """E = E0 exp(-(x + y)/L) over a square: the exponent is ((1 - exp(-m))/m)^2."""
    x = np.linspace(0.0, 1.0, 801)
    widths = part_widths(x, -np.inf, np.inf)
    law = link(np.exp(-(x[:, np.newaxis] + x)), np.outer(widths, widths), shape=shape)
    exact = ((1.0 - math.exp(-shape)) / shape) ** 2
    assert law.characteristic_voltage**-shape == near(exact, 1.01 * shape**2 / 6.0 / 800**2)


def test_large_shapes_are_a_constant_strength():
    """The largest field reaches the scale at 2 V; m = 200 would overflow at 5e6 V/m to its power."""
    strength, areas = np.array([1e6, 5e6, 3e6]), np.full(3, 1e-9)
    constant = breakdown_voltage(1.0, strength, 10e6)
    assert constant == 2.0
    before = np.inf
    for shape in (2.0, 20.0, 200.0):
        law = link(strength, areas, shape=shape, scale=10e6, reference_area=1e-9)
        assert abs(law.characteristic_voltage - constant) < before
        before = abs(law.characteristic_voltage - constant)
    assert law.characteristic_voltage == near(constant, 1e-12)
    assert law.probability(0.95 * constant) < 1e-4  # 0.95^200 = 3.5e-5
    assert law.probability(1.05 * constant) == 1.0
    # Far beyond either end, without a warning.
    assert (law.probability(1e-300), law.probability(1e300)) == (0.0, 1.0)


laws = st.builds(
    link,
    st.lists(st.floats(1e5, 1e8), min_size=3, max_size=3),
    st.lists(st.floats(1e-12, 1e-6), min_size=3, max_size=3),
    shape=st.floats(0.5, 200.0),
    voltage=st.floats(1e-3, 1e3),
    scale=st.floats(1e5, 1e9),
    reference_area=st.floats(1e-12, 1e-4),
)
percent = st.floats(1e-6, 1.0 - 1e-6)


@given(law=laws, probability=percent)
def test_voltage_and_probability_are_inverse(law, probability):
    assert law.probability(law.voltage(probability)) == near(probability, 1e-9)


def test_band_by_hand():
    """m = 2 and V0 = 1: sqrt(-ln 0.95) and sqrt(-ln 0.05) at 5 and 95 %; 1 - 1/e at V0."""
    law = WeakestLink(2.0, 1.0)
    assert law.voltage(0.05) == near(0.226480229, 1e-8)
    assert law.voltage(0.95) == near(1.730818383, 1e-8)
    assert law.probability(1.0) == near(0.632120559, 1e-8)


parts = st.lists(st.tuples(st.floats(1e5, 1e8), st.floats(1e-12, 1e-6)), min_size=1, max_size=5)


@given(parts=parts, shape=st.floats(0.5, 200.0), more=st.floats(1.01, 100.0))
def test_what_makes_a_breakdown_more_likely(parts, shape, more):
    """A larger voltage, area and field; a smaller scale and reference area."""
    strength, areas = np.transpose(parts)
    keys = {"shape": shape, "scale": 3e6, "reference_area": 1e-9}
    law = link(strength, areas, **keys)
    at = law.voltage(0.3)
    assert law.probability(more * at) > 0.3 * (1.0 + 1e-6)
    for stressed in (
        link(strength, more * areas, **keys),
        link(more * strength, areas, **keys),
        link(np.append(strength, strength.max()), np.append(areas, areas.max()), **keys),
        link(strength, areas, **keys | {"scale": 3e6 / more}),
        link(strength, areas, **keys | {"reference_area": 1e-9 / more}),
    ):
        assert stressed.probability(at) > 0.3 * (1.0 + 1e-9)


@given(law_parts=parts, shape=st.floats(0.5, 200.0), times=st.floats(1e-3, 1e3))
def test_voltage_falls_with_the_area_by_one_over_the_shape(law_parts, shape, times):
    """V ~ A^(-1/m), at any probability."""
    strength, areas = np.transpose(law_parts)
    one, other = (link(strength, a, shape=shape) for a in (areas, times * areas))
    for probability in (0.05, 0.5, 0.95):
        ratio = other.voltage(probability) / one.voltage(probability)
        assert ratio == near(times ** (-1.0 / shape), 1e-10)


def test_the_voltage_of_the_solution_does_not_matter():
    """Field and voltage grow together."""
    strength, areas = [2.0, 3.0], [1.0, 4.0]
    one = link(strength, areas, shape=6.0, voltage=1.0)
    other = link(10.0 * np.array(strength), areas, shape=6.0, voltage=10.0)
    assert other.characteristic_voltage == near(one.characteristic_voltage, 1e-14)


def test_costs_by_hand():
    """1 nF at 20 V holds 200 nJ; a hemisphere of 4 um has pi d^3/12 = 16.755 um^3, that is 171 nJ of iron
    at 10.2 GJ/m^3, 934 nJ of which 0.183 melt it.
    """
    assert stored_energy(1e-9, 20.0) == near(200e-9, 1e-14)
    assert pit_diameter(16.755e-18) == near(4e-6, 1e-5)
    energy = 16.755e-18 * 10.2e9 / 0.183
    assert energy == near(934e-9, 1e-3)
    assert pit_diameter(melted_volume(energy, 0.183, 10.2e9)) == near(4e-6, 1e-5)
    # A sphere of this diameter has twice the volume.
    assert near(math.pi * 4e-6**3 / 6.0, 1e-4) == 2.0 * 16.755e-18


def test_leakage_by_hand():
    """8.854 pF/m times 2.2 over 1 pS/m: 19.5 s, which is 8.17 mHz."""
    time = relaxation_time(2.2, 1e-12)
    assert time == near(19.479, 1e-4)
    assert 1.0 / (2.0 * math.pi * time) == near(8.1706e-3, 1e-4)
