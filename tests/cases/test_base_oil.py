"""Coefficient of an oil from its data sheet and its type of base oil, where the case gives no other."""

import math
from typing import get_args

import pytest

from ehlectric import InputError
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.oil_inputs import OilTemperature
from ehlectric.lubricant.data_sheet import BASE_OILS

SHEET = {
    "kinematic_viscosity_40": "32 mm^2/s",
    "kinematic_viscosity_100": "5.35 mm^2/s",
    "density_15": "870 kg/m^3",
    "expansion": "7e-4 1/K",
    "base_oil": "pao",
}
LAWS = {
    "viscosity_law": "roelands",
    "roelands_pressure": "0.196 GPa",
    "density_law": "incompressible",
    "relative_permittivity": 2.2,
}


def _oil(**changed):
    return Lubricant.from_dict(LAWS | {"temperature": SHEET} | changed).at(313.15)


def test_coefficient_and_exponent_by_hand():
    """7.382 32^0.1335 1/GPa at 40 degC, and z of Roelands' relation for 32 mm^2/s and 854.775 kg/m^3."""
    oil = _oil()
    alpha = 7.382e-9 * 32.0**0.1335
    assert oil.alpha == pytest.approx(alpha, rel=1e-9, abs=0.0)
    exponent = alpha * 0.196e9 / (math.log(32e-6 * 854.775) + 9.67)
    (_, slope), p = oil.log_viscosity([5e8]), 5e8
    shape = (1.0 + p / 0.196e9) ** (exponent - 1.0)
    assert slope[0] == pytest.approx(alpha * shape, rel=1e-9, abs=0.0)


def test_the_estimate_follows_the_temperature():
    table = Lubricant.from_dict(LAWS | {"temperature": SHEET})
    nu = 1e6 * table.at(333.15).viscosity / (870.0 * (1.0 - 7e-4 * 45.0))
    assert table.at(333.15).alpha == pytest.approx(7.382e-9 * nu**0.1335, rel=1e-9, abs=0.0)


def test_an_estimate_warns():
    assert [warning.code for warning in _oil().warnings(1e9)] == ["estimated-alpha"]


@pytest.mark.parametrize(
    ("given", "alpha"),
    [
        ({"pressure_viscosity_coefficient": "16 1/GPa"}, 16e-9),
        ({"roelands_z": 0.5}, 0.5 * (math.log(32e-6 * 854.775) + 9.67) / 0.196e9),
    ],
)
def test_a_given_value_leaves_nothing_to_estimate(given, alpha):
    oil = _oil(**given)
    assert oil.alpha == pytest.approx(alpha, rel=1e-9, abs=0.0)
    assert not list(oil.warnings(1e9))


def test_the_base_oil_of_a_case_replaces_the_exponent_of_the_library():
    """The oil of the paper has z = 0.67; a data sheet with a type of base oil is another oil."""
    changed = Lubricant.from_dict({"base": "paper", "temperature": SHEET}).at(313.15)
    assert changed.alpha == pytest.approx(7.382e-9 * 32.0**0.1335, rel=1e-9, abs=0.0)
    plain = {key: value for key, value in SHEET.items() if key != "base_oil"}
    oil = Lubricant.from_dict({"base": "paper", "temperature": plain}).at(313.15)
    assert oil.alpha == pytest.approx(0.67 * (math.log(32e-6 * 854.775) + 9.67) / 0.198e9, rel=1e-9, abs=0.0)


def test_without_a_type_the_message_names_it():
    plain = {key: value for key, value in SHEET.items() if key != "base_oil"}
    with pytest.raises(InputError, match=r"^pressure_viscosity_coefficient: missing; .*temperature.base_oil"):
        _oil(temperature=plain)


def test_an_oil_too_thick_for_the_estimate():
    thick = SHEET | {"kinematic_viscosity_40": "2600 mm^2/s", "kinematic_viscosity_100": "120 mm^2/s"}
    with pytest.raises(InputError, match=r"2.6e\+03 mm\^2/s") as caught:
        _oil(temperature=thick)
    assert caught.value.key == "lubricant.temperature.base_oil"


def test_types_of_the_table_are_those_with_a_correlation():
    annotation = OilTemperature.model_fields["base_oil"].annotation
    (names,) = [get_args(part) for part in get_args(annotation) if get_args(part)]
    assert names == tuple(BASE_OILS)


def test_the_oil_of_a_table_is_made_once_for_each_temperature():
    table = {"kinematic_viscosity_40": "46 mm^2/s", "kinematic_viscosity_100": "6.8 mm^2/s"}
    lubricant, thin = (
        Lubricant.from_dict({"base": "paper", "temperature": {**table, **given, "density_15": "870 kg/m^3"}})
        for given in ({}, {"kinematic_viscosity_40": "32 mm^2/s", "kinematic_viscosity_100": "5.4 mm^2/s"})
    )
    cold, again = lubricant.at(313.15), lubricant.at(313.15)
    assert again is cold
    assert lubricant.at(343.15).viscosity < 0.5 * cold.viscosity
    assert thin.at(313.15).viscosity < 0.8 * cold.viscosity
    assert lubricant.at(313.15).viscosity == cold.viscosity


ROELANDS = {
    "atmospheric_law": "roelands",
    "reference_temperature": "40 degC",
    "roelands_s0": 1.1,
    "viscosity": "0.04 Pa s",
}


def test_a_law_with_the_viscosity_of_the_base_keeps_its_coefficient():
    """Roelands' relation changes it with ln(viscosity) + 9.67 where the temperature does."""
    oil = Lubricant.from_dict({"base": "paper", **ROELANDS})
    assert oil.at(313.15).alpha == pytest.approx(22e-9, rel=1e-9)
    hot = oil.at(353.15)
    ratio = (math.log(hot.viscosity) + 9.67) / (math.log(0.04) + 9.67)
    assert hot.alpha == pytest.approx(22e-9 * ratio, rel=1e-9)
    without = {key: value for key, value in ROELANDS.items() if key != "viscosity"}
    assert Lubricant.from_dict({"base": "paper", **without}).at(313.15).viscosity == pytest.approx(0.04)


def test_a_coefficient_of_barus_changes_with_the_viscosity_too():
    table = LAWS | ROELANDS | {"viscosity_law": "barus", "pressure_viscosity_coefficient": 2e-8}
    hot = Lubricant.from_dict(table).at(353.15)
    ratio = (math.log(hot.viscosity) + 9.67) / (math.log(0.04) + 9.67)
    assert hot.alpha == pytest.approx(2e-8 * ratio, rel=1e-9)


def test_values_of_the_base_stay_beside_a_viscosity_of_ones_own():
    """Its type of base oil and thermal conductivity do; one of its viscosities beside one's own does not."""
    sheet = {"kinematic_viscosity_40": "32 mm^2/s", "kinematic_viscosity_100": "5.35 mm^2/s"}
    oil = Lubricant.from_dict({"base": "e-axle-fluid", "temperature": sheet})
    assert (oil.temperature.base_oil, oil.temperature.density_15) == ("pao", 840.0)
    assert oil.at(313.15).thermal_conductivity == 0.154
    assert oil.at(313.15).alpha == pytest.approx(7.382e-9 * 32.0**0.1335, rel=1e-9)
    single = {"viscosity": "10 mPa s", "pressure_viscosity_coefficient": "15 1/GPa", "roelands_z": 0.6}
    assert Lubricant.from_dict({"base": "e-axle-fluid", **single}).at(313.15).thermal_conductivity == 0.154
    with pytest.raises(InputError, match=r"^temperature.kinematic_viscosity_100: missing"):
        Lubricant.from_dict({"base": "e-axle-fluid", "temperature": {"iso_vg": 32}})
