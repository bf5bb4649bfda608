"""Conditions of many points of a bearing at once, against those of each point alone, and refused points."""

from collections import defaultdict

import numpy as np
import pytest

from ehlectric.bearing.conditions import gap_breakdown
from ehlectric.bearing.fits import ThickRing, fit_pressure
from ehlectric.bearing.mounted_clearance import mounted_clearance
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.discharge_inputs import BearingDischarge
from ehlectric.discharge.film_breakdown import dielectric_strength
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS_IN_SI as BALLS

STRENGTH = {"temperature": [293.15, 333.15, 393.15], "strength": [2e7, 1.6e7, 1e7]}
OIL = {"base": "iso-vg-46", "temperature": {"thermal_conductivity": 0.14}, "relative_permittivity": 2.2}
FITS = {
    "unmounted_clearance": 3e-5,
    "shaft_interference": 1e-5,
    "housing_interference": -5e-6,
    "housing_material": "steel",
    "shaft_bore": 0.0,
}
NUMBER = 60


def case(**changes):
    tables = {"bearing": dict(BALLS), "lubricant": OIL, "discharge": {"strength_table": STRENGTH}}
    return BearingCase.from_dict(tables).replace(changes)


def drawn(low, high, seed):
    return np.random.default_rng(seed).uniform(low, high, NUMBER)


CASES = {
    "one temperature": (
        {"bearing.film_factor": "inlet-shear", "bearing.supply": "grease"},
        {"bearing.temperature": (270.0, 420.0), "bearing.inner_speed": (10.0, 3000.0)},
    ),
    "rings and oil": (
        {"bearing.film_factor": "none", "bearing.supply": "oil-bath"},
        {
            "bearing.temperature": (280.0, 400.0),
            "bearing.inner_ring_temperature": (280.0, 400.0),
            "bearing.outer_ring_temperature": (280.0, 400.0),
            "lubricant.temperature.kinematic_viscosity_40": (30e-6, 60e-6),
            "lubricant.relative_permittivity": (2.0, 4.0),
        },
    ),
    "a given factor": (
        {"bearing.film_factor": 0.7, "bearing.supply": 0.5},
        {"bearing.temperature": (300, 390)},
    ),
    "dimensions of the supply": (
        {"bearing.supply": "grease"},
        {"bearing.bore": (0.038, 0.042), "bearing.outer_diameter": (0.078, 0.082)},
    ),
    "a load": ({"bearing.film_factor": "inlet-shear"}, {"bearing.radial_load": (500.0, 3000.0)}),
}


def of_ring(ring):
    """Numbers of the contacts with a ring, its oil and its strength, by name."""
    factors = {name: getattr(ring, name) for name in ("film_factor", "heat_factor", "supply_factor")}
    strength = dielectric_strength(ring.discharge, np.zeros(()))
    own = {"temperature": ring.temperature, "viscosity": ring.oil.viscosity, "strength": strength}
    return {**factors, **own, "alpha_star": ring.oil.alpha_star}


# The slope of the viscosity, on which the heat depends, is a difference of nearly equal numbers.
CLOSE = defaultdict(lambda: 1e-12, film_factor=1e-10, heat_factor=1e-10)


def at(value, index):
    return value if np.ndim(value) == 0 else value[index]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("name", CASES)
def test_points_are_those_of_single_bearings(name):
    changes, ends = CASES[name]
    values = {key: drawn(*end, seed) for seed, (key, end) in enumerate(ends.items())}
    many = case(**changes).with_arrays(values)
    found = resolve_bearing(many)
    for index in range(NUMBER):
        single = many.single(index)
        try:
            alone = resolve_bearing(BearingCase.from_dict(single.to_dict()))
        except InputError:
            assert found.refused[index]
            continue
        assert not at(found.refused, index)
        for ring, expected in zip(found.rings, alone.rings, strict=True):
            numbers = of_ring(ring)
            for key, value in of_ring(expected).items():
                if value is None:
                    assert numbers[key] is None
                else:
                    np.testing.assert_allclose(at(numbers[key], index), value, rtol=CLOSE[key], err_msg=key)
        np.testing.assert_allclose(at(found.film_factor, index), alone.film_factor, rtol=1e-10)
        np.testing.assert_allclose(
            at(found.part_of_film_factor("supply_factor"), index),
            alone.part_of_film_factor("supply_factor"),
            rtol=1e-12,
        )
        np.testing.assert_allclose(at(found.oil.viscosity, index), alone.oil.viscosity, rtol=1e-12)


def test_the_points_of_one_case_are_refused_for_their_own_reasons():
    """In order: a good point, an oil outside of its table of strength, cold oil at a speed at which the rule
    ends its supply, and a good point. Neighbours are not disturbed.
    """
    values = {
        "bearing.temperature": [343.15, 400.0, 295.0, 333.15],
        "bearing.inner_speed": [300.0] * 2 + [9e3, 62.8],
    }
    many = case(**{"bearing.supply": "grease"}).with_arrays(values)
    found = resolve_bearing(many)
    assert found.refused.tolist() == [False, True, True, False]
    for index, key in ((1, "bearing.temperature"), (2, "bearing.supply")):
        with pytest.raises(InputError) as error:
            resolve_bearing(many.single(index))
        assert error.value.key == key


def test_rings_of_one_temperature_share_their_oil():
    found = resolve_bearing(case().with_arrays({"bearing.temperature": [333.15, 343.15]}))
    assert found.inner.oil is found.outer.oil is found.oil
    other = case(**{"bearing.inner_ring_temperature": 353.15})
    assert resolve_bearing(other).inner.oil is not resolve_bearing(other).oil


def test_heat_of_many_points_is_not_solved():
    solved = case(**{"bearing.film_factor": "solved", "lubricant.heat_capacity": 2000.0})
    with pytest.raises(InputError, match=r"^bearing\.film_factor: got 'solved' for many points"):
        resolve_bearing(solved.with_arrays({"bearing.inner_speed": [100.0, 200.0]}))


def test_a_permittivity_of_one_oil_is_that_of_each_point():
    """A density ratio beyond the pole of Clausius and Mossotti, at 3 for a permittivity of 2.5."""
    polar = case(
        **{"lubricant.relative_permittivity": 2.5, "lubricant.permittivity_law": "clausius-mossotti"}
    )
    permittivity = resolve_bearing(
        polar.with_arrays({"bearing.radial_load": [500.0, 600.0]})
    ).inner.oil.permittivity
    assert np.isnan(permittivity(1e9, np.array([1.2, 4.0]))).tolist() == [False, True]
    with pytest.raises(InputError, match="pole"):
        resolve_bearing(polar).inner.oil.permittivity(1e9, np.array([1.2, 4.0]))


def test_clearances_of_many_points():
    """Interferences and temperatures; point 7 has a housing that presses and no outer diameter of it."""
    fitted = case().replace({"bearing.fits": FITS})
    values = {
        "bearing.fits.shaft_interference": drawn(-5e-6, 3e-5, 1),
        "bearing.fits.unmounted_clearance": drawn(1e-5, 6e-5, 2),
        "bearing.inner_ring_temperature": drawn(300.0, 380.0, 3),
        "bearing.temperature": drawn(300.0, 310.0, 4),
        "bearing.fits.shaft_bore": np.where(np.arange(NUMBER) % 2, 0.0, 0.01),
        "bearing.fits.housing_interference": np.where(np.arange(NUMBER) == 7, 2e-5, -2e-5),
    }
    many = fitted.with_values(values).bearing
    found = mounted_clearance(many)
    assert np.flatnonzero(np.isnan(found.running.clearance)).tolist() == [7]
    for index in range(NUMBER):
        if index == 7:
            with pytest.raises(InputError, match="housing_diameter"):
                mounted_clearance(many.single(index))
            continue
        alone = mounted_clearance(many.single(index))
        for state in ("mounted", "running"):
            for name, value in vars(getattr(alone, state)).items():
                np.testing.assert_allclose(at(getattr(getattr(found, state), name), index), value, rtol=1e-12)


def test_pressures_of_fits_with_and_without_a_bore():
    """Rings of one material: p = E delta (1 - d^2/D^2)/(2 d) on a solid shaft, and none on a loose fit."""
    shaft = ThickRing(np.array([0.0, 0.0, 0.02]), 0.04, 208e9, 0.3, 12e-6)
    ring = ThickRing(0.04, 0.048, 208e9, 0.3, 12e-6)
    pressure = fit_pressure(shaft, ring, np.array([1e-5, -1e-5, 1e-5]))
    assert pressure[0] == pytest.approx(208e9 * 1e-5 * (1.0 - (40 / 48) ** 2) / 0.08, rel=1e-12)
    assert pressure[1] == 0.0
    assert 0.0 < pressure[2] < pressure[0]


def test_strengths_of_many_temperatures():
    discharge = BearingDischarge.from_dict({"strength_table": STRENGTH}).at(np.array([293.15, 363.15, 500.0]))
    strength = dielectric_strength(discharge, np.zeros((2, 1)))
    np.testing.assert_allclose(strength, [[2e7, 1.3e7, np.nan]] * 2, rtol=1e-12)
    gaps = np.array([[1e-6, 2e-6], [1e-6, 3e-6], [1e-6, 1e-6]])
    expected = [[20.0, 40.0], [13.0, 39.0], [np.nan, np.nan]]
    np.testing.assert_allclose(gap_breakdown(discharge, gaps.T).T, expected, rtol=1e-12)
    assert gap_breakdown(BearingDischarge.from_dict({"dielectric_strength": 1e7}).at(300.0), 1e-6) == 10.0
