"""Oils at many points at once, against the oil of each point alone; points without a value among them."""

import math
import re

import numpy as np
import pytest

from ehlectric.cases import library
from ehlectric.cases.case_oil import Lubricant, refusals, temperature_coefficient
from ehlectric.errors import InputError
from ehlectric.lubricant.data_sheet import viscosity_at_100
from ehlectric.lubricant.law import Law, Parameter
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS
from tests.helpers.each import each
from tests.lubricant.oils import (
    DOOLITTLE,
    LARSSON_C,
    LARSSON_K,
    MODULUS,
    MURNAGHAN,
    SCALED_C,
    SCALED_K,
    TAIT,
    VOGEL,
    YASUTOMI,
)

COMPLETE = [name for name in library.lubricant_names() if name != "squalane"]
PLAIN = {"viscosity": 0.04, "viscosity_law": "barus", "pressure_viscosity_coefficient": 2e-8}
PLAIN |= {"density_law": "incompressible", "relative_permittivity": 2.2}
SHEET = {"kinematic_viscosity_40": 46e-6, "kinematic_viscosity_100": 6.8e-6, "density_15": 870.0}
TABLE = {"temperature": [300.0, 350.0, 400.0]}

# Oils that together have each law and each table.
OILS = {
    "vogel and modulus": {"atmospheric_law": "vogel", **VOGEL, "viscosity_law": "modulus", **MODULUS},
    "roelands over temperature": {
        "atmospheric_law": "roelands",
        "viscosity": 0.04,
        "reference_temperature": 313.15,
        "roelands_s0": 1.1,
        "viscosity_law": "roelands",
        "roelands_z": 0.6,
        "roelands_pressure": 0.196e9,
        "density_law": "dowson-higginson",
        "density_c1": 0.59e9,
        "density_c2": 1.34,
        "density": 870.0,
        "thermal_expansion": 7e-4,
    },
    "yasutomi and tait": {
        "viscosity_law": "yasutomi",
        **YASUTOMI,
        "density_law": "tait",
        "thermal_conductivity_law": "scaling",
        "heat_capacity_law": "scaling",
        **SCALED_K,
        **SCALED_C,
        **TAIT,
    },
    "doolittle": {
        "viscosity_law": "doolittle",
        **DOOLITTLE,
        "density_law": "tait",
        "thermal_conductivity_law": "larsson",
        "heat_capacity_law": "larsson",
        **LARSSON_K,
        **LARSSON_C,
    },
    "murnaghan": {**PLAIN, "density_law": "murnaghan", **MURNAGHAN},
    "base oil": {"temperature": SHEET | {"base_oil": "mineral-paraffinic"}, "viscosity_law": "barus"},
    "pao": {
        "temperature": SHEET | {"base_oil": "pao", "thermal_conductivity": 0.14},
        "viscosity_law": "roelands",
        "roelands_pressure": 0.196e9,
        "heat_capacity": 2000.0,
    },
    "tables": {
        **PLAIN,
        "relative_permittivity": None,
        "permittivity_table": TABLE | {"relative_permittivity": [2.3, 2.2, 2.1]},
        "conductivity_table": TABLE | {"conductivity": [1e-12, 1e-11, 1e-10]},
    },
    "arrhenius": {
        **PLAIN,
        "permittivity_law": "constant",
        "conductivity_law": "arrhenius",
        "conductivity": 1e-11,
        "conductivity_activation": 5e4,
        "conductivity_temperature": 313.15,
        "thermal_conductivity": 0.14,
    },
}


def lubricant(table):
    table = {"density_law": "incompressible", "relative_permittivity": 2.2} | table
    return Lubricant.from_dict({key: value for key, value in table.items() if value is not None})


def named(name):
    return Lubricant.from_dict({"base": name, "relative_permittivity": 2.2})


PRESSURES = np.array([[0.0], [0.3e9], [1.5e9]])


def values(oil, density):
    """Numbers of an oil, and its laws at pressures, by their names; those that are not known are left out."""
    names = ("viscosity", "alpha", "alpha_star", "relative_permittivity", "density", "conductivity")
    found = {name: getattr(oil, name) for name in (*names, "thermal_conductivity", "heat_capacity")}
    laws = (oil.log_viscosity, oil.density_ratio, oil.thermal_conductivity_law, oil.heat_capacity_law)
    for number, law in enumerate(laws):
        if law is not None:
            found[f"law {number}"], found[f"slope {number}"] = law(PRESSURES)
    found["permittivity"] = oil.permittivity(PRESSURES, density)
    return {name: value for name, value in found.items() if value is not None}


def check_each(many, single, indices):
    """Compare the oil of many points with that of each of some points, which ``single`` makes."""
    ratio = many.density_ratio(PRESSURES)[0]
    found = values(many, ratio)
    for k in indices:
        try:
            alone = single(k)
        except InputError:
            assert many.refused[k]
            assert np.isnan(many.viscosity[k])
            continue
        assert not np.ndim(many.refused) or not many.refused[k]
        expected = values(alone, np.broadcast_to(ratio, (3, len(indices)))[:, [k]])
        assert found.keys() == expected.keys()
        for name, value in expected.items():
            of_point = np.asarray(found[name])
            of_point = of_point[..., [k] if of_point.shape[-1] > 1 else [0]] if of_point.ndim else of_point
            np.testing.assert_allclose(of_point, value, rtol=1e-12, atol=1e-300, err_msg=name)


@pytest.mark.slow
@pytest.mark.parametrize("name", [*COMPLETE, *OILS])
def test_temperatures(name):
    """From glass to gas, so that many points are refused between those that are not."""
    oil = lubricant(OILS[name]) if name in OILS else named(name)
    temperatures = np.random.default_rng(3).uniform(170.0, 520.0, 60)
    check_each(oil.at(temperatures), lambda k: oil.at(float(temperatures[k])), range(60))


VARIED = {
    "vogel and modulus": ("vogel_viscosity", "vogel_b", "vogel_c", *MODULUS),
    "roelands over temperature": ("viscosity", "roelands_s0", "roelands_z", "density_c1", "density"),
    "yasutomi and tait": (*YASUTOMI, *TAIT, *(key for key in SCALED_K if key.startswith("scaling"))),
    "doolittle": (*DOOLITTLE, *LARSSON_K, *LARSSON_C),
    "murnaghan": (*MURNAGHAN, "viscosity", "relative_permittivity", "pressure_viscosity_coefficient"),
    "base oil": ("temperature.kinematic_viscosity_40", "temperature.density_15", "temperature.expansion"),
    "pao": ("temperature.kinematic_viscosity_100", "roelands_pressure", "heat_capacity"),
    "arrhenius": ("conductivity", "conductivity_activation", "thermal_conductivity", "relative_permittivity"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", VARIED)
@pytest.mark.parametrize("scatter", [1e-3, 0.3])
def test_properties(name, scatter):
    """Parameters of each point; far ones give oils that rise with temperature, and other ones that have no
    value.
    """
    oil, random = lubricant(OILS[name]), np.random.default_rng(5)
    changes = {}
    for key in VARIED[name]:
        table, leaf = (oil.temperature, key.partition(".")[2]) if "." in key else (oil, key)
        given = table.parameter(leaf) if table is oil else getattr(table, leaf)
        changes[key] = given * (1.0 + scatter * random.uniform(-1.0, 1.0, 40))
    many = oil.with_values(changes)
    check_each(many.at(343.15), lambda k: many.single(k).at(343.15), range(40))


def test_the_temperature_coefficient():
    oil, temperatures = named("fva-3"), np.array([300.0, 340.0, 150.0])
    found = temperature_coefficient(oil, temperatures)
    alone = [temperature_coefficient(oil, float(at)) for at in temperatures[:2]]
    np.testing.assert_allclose(found, [*alone, np.nan], rtol=1e-12)


def test_an_index_of_each_oil():
    """ASTM D2270, solved for each oil; 3.2 mm^2/s at 40 degC is too thin for an index of 100."""
    found = viscosity_at_100(np.array([46e-6, 3.2e-6, 220e-6]), np.array([100.0, 100.0, 95.0]))
    alone = [viscosity_at_100(46e-6, 100.0), math.nan, viscosity_at_100(220e-6, 95.0)]
    np.testing.assert_allclose(found, alone, rtol=1e-11)
    sheet = {"iso_vg": 46, "viscosity_index": 100.0, "density_15": 870.0}
    oil = lubricant({"temperature": sheet, "viscosity_law": "barus", "pressure_viscosity_coefficient": 2e-8})
    many = oil.with_values({"temperature.viscosity_index": np.array([80.0, 120.0])}).at(333.15)
    each = (oil.with_values({"temperature.viscosity_index": index}) for index in (80.0, 120.0))
    assert many.viscosity == pytest.approx([one.at(333.15).viscosity for one in each], rel=1e-12)


@pytest.mark.parametrize("name", ["iso-vg-46", "fva-3", "shell-t9"])
def test_errors_of_points_are_those_of_each_alone(name):
    oil, temperatures = named(name), np.array([343.15, 60.0, 190.0, 300.0, 700.0])
    errors = refusals(oil, temperatures, "bearing.temperature")
    for at, error in zip(temperatures, errors, strict=True):
        if error is None:
            assert oil.at(float(at), "bearing.temperature").viscosity > 0.0
            continue
        with pytest.raises(InputError, match=re.escape(str(error))):
            oil.at(float(at), "bearing.temperature")


def test_a_permittivity_beyond_its_pole_is_that_of_its_point():
    """(eps + 2)/(eps - 1) is 1.04 for 80, and no density ratio of an oil for 2.2."""
    oil = lubricant(PLAIN).with_values({"relative_permittivity": np.array([2.2, 80.0])}).at(343.15)
    found = oil.permittivity(1e9, np.array([1.2, 1.2]))
    assert found[0] == lubricant(PLAIN).at(343.15).permittivity(1e9, 1.2)
    assert np.isnan(found[1])


def test_equal_temperatures_are_asked_for_once():
    oil, temperatures = named("fva-3"), np.array([300.0, 340.0])
    assert oil.at(temperatures) is oil.at(temperatures)
    assert oil.at(temperatures) is not oil.at(temperatures.copy())


@each("oil", ["iso-vg-46", "fva-3", "e-axle-fluid"])
def test_codes_of_many_points_are_those_of_each(oil):
    temperatures, pressures = np.linspace(295.0, 380.0, 12), np.geomspace(1e8, 3e9, 12)
    given = named(oil)
    many = given.at(temperatures)
    assert many.inputs == {}
    found = dict(many.codes(pressures))
    for k, (temperature, pressure) in enumerate(zip(temperatures, pressures, strict=True)):
        alone = {warning.code for warning in given.at(float(temperature)).warnings(float(pressure))}
        assert {code for code, mask in found.items() if mask[k]} == alone


def by_floats(pressure, temperature=None, *, stiffness):
    """Law that takes a float of each parameter and of the temperature."""
    alpha = 1.0 / stiffness if temperature > 300.0 else 2.0 / stiffness
    return alpha * np.asarray(pressure), np.full_like(pressure, alpha, dtype=float)


def test_a_law_that_takes_no_arrays_is_called_point_by_point(monkeypatch):
    stiffness = Parameter("stiffness", "Pa", meaning="of the oil", above=0.0)
    law = Law(by_floats, (stiffness,), needs_temperature=True)
    monkeypatch.setitem(VISCOSITY_LAWS, "by floats", law)
    oil = lubricant({"viscosity": 0.04, "viscosity_law": "by floats", "stiffness": 5e7})
    temperatures = np.array([290.0, 310.0])
    check_each(oil.at(temperatures), lambda k: oil.at(float(temperatures[k])), range(2))
    many = oil.with_values({"stiffness": np.array([5e7, 4e7])})
    np.testing.assert_allclose(many.at(310.0).alpha, [2e-8, 2.5e-8])
