"""Values of an oil that are given twice, or that no law would use: one line, and no silent choice."""

import math

import pytest

from ehlectric import Case
from ehlectric.cases.case_oil import Lubricant, depends_on_temperature
from ehlectric.contact.preparation import prepare
from tests.helpers.each import each

SHEET = {
    "kinematic_viscosity_40": "46 mm^2/s",
    "kinematic_viscosity_100": "6.8 mm^2/s",
    "density_15": "870 kg/m^3",
}
OVER_T = {"temperature": ["40 degC", "100 degC"], "conductivity": ["1e-12 S/m", "1e-11 S/m"]}
CONTACT = {
    "reduced_radius": "10 mm",
    "reduced_modulus": "226 GPa",
    "load_per_length": "100 N/mm",
    "entrainment_speed": "1 m/s",
}


def test_the_density_of_a_data_sheet_serves_the_heat_capacity():
    oil = Lubricant.from_dict({"base": "paper", "temperature": SHEET, "heat_capacity": "2000 J/kg/K"})
    density = 870.0 * (1.0 - 6.5e-4 * 45.0)
    assert oil.at(333.15).heat_capacity == pytest.approx(2000.0 * density, rel=1e-12)


def test_the_density_of_a_data_sheet_takes_the_place_of_that_of_the_base():
    oil = Lubricant.from_dict({"base": "fva-3", "temperature": SHEET})
    assert oil.at(313.15).density == pytest.approx(870.0 * (1.0 - 6.5e-4 * 25.0), rel=1e-12)


@each(
    "oil, follows",
    [
        ({"base": "paper"}, False),
        ({"base": "paper", "reference_temperature": "20 degC"}, False),
        ({"base": "paper", "temperature": SHEET}, True),
        # A given viscosity, and a pressure law over temperature.
        ({"base": "fva-3", "viscosity": "0.1 Pa s"}, True),
        ({"base": "paper", "thermal_expansion": "7e-4 1/K", "reference_temperature": "20 degC"}, True),
    ],
)
def test_what_makes_an_oil_depend_on_its_temperature(oil, follows):
    table = Lubricant.from_dict(oil)
    assert depends_on_temperature(table) is follows
    warm, hot = table.at(313.15), table.at(333.15)
    numbers = [(o.viscosity, o.alpha, o.relative_permittivity) for o in (warm, hot)]
    assert (numbers[0] != numbers[1]) is follows


@each(
    "oil, kelvin, codes",
    [
        ({"base": "paper"}, None, []),
        ({"base": "paper"}, 313.15, ["temperature-unused"]),
        ({"base": "fva-3"}, 313.15, []),
        ({"base": "fva-3", "viscosity": "0.1 Pa s"}, 313.15, ["temperature-unused"]),
    ],
)
def test_a_temperature_that_does_not_change_the_viscosity_is_told(oil, kelvin, codes):
    at = {} if kelvin is None else {"temperature": kelvin}
    case = Case.from_dict({"contact": CONTACT | at, "lubricant": oil})
    assert [one.code for one in prepare(case).warnings() if one.code.startswith("temp")] == codes


EPS = {"temperature": ["40 degC", "80 degC"], "relative_permittivity": [2.07, 2.03]}
WARM = CONTACT | {"temperature": 333.15}


@each(
    "oil, changes, value",
    [
        ({"base": "fva-3"}, {"lubricant.viscosity": "0.05 Pa s"}, ("viscosity", 0.05)),
        ({"base": "fva-3"}, {"lubricant.temperature": SHEET}, ("density", 870.0 * (1.0 - 6.5e-4 * 45.0))),
        ({"base": "fva-3"}, {"lubricant.permittivity_table": EPS}, ("relative_permittivity", 2.05)),
        (
            {"base": "paper", "conductivity_table": OVER_T},
            {"lubricant.conductivity": "1e-9 S/m"},
            ("conductivity", 1e-9),
        ),
        (
            {
                "base": "paper",
                "conductivity": "1e-9 S/m",
                "conductivity_law": "arrhenius",
                "conductivity_activation": "50 kJ/mol",
                "conductivity_temperature": "60 degC",
            },
            {"lubricant.conductivity": "2e-9 S/m"},
            ("conductivity", 2e-9),
        ),
        (
            {
                "base": "paper",
                "viscosity": "0.05 Pa s",
                "atmospheric_law": "roelands",
                "reference_temperature": "60 degC",
                "roelands_s0": 1.1,
            },
            {"lubricant.viscosity": "0.03 Pa s"},
            ("viscosity", 0.03),
        ),
        # Within a data sheet the coefficient of the case stays.
        (
            {"base": "paper", "temperature": SHEET, "pressure_viscosity_coefficient": "20 1/GPa"},
            {"lubricant.temperature.density_15": "880 kg/m^3"},
            ("alpha", 20e-9),
        ),
    ],
)
def test_a_new_way_to_give_a_value_replaces_the_old_one(oil, changes, value):
    case = Case.from_dict({"contact": WARM, "lubricant": oil}).replace(changes)
    name, expected = value
    assert getattr(case.oil, name) == pytest.approx(expected, rel=1e-12)


def test_a_law_over_temperature_leaves_the_coefficient_of_another_temperature_out():
    """Base "paper" has 22 1/GPa at 40 mPa s; with its z of 0.67 there is less at a smaller viscosity."""
    vogel = {"vogel_viscosity": "0.062 mPa s", "vogel_b": "1021.7 K", "vogel_c": "171.6 K"}
    oil = Lubricant.from_dict({"base": "paper", "atmospheric_law": "vogel"} | vogel).at(353.15)
    assert oil.alpha == pytest.approx(0.67 * (math.log(oil.viscosity) + 9.67) / 0.198e9, rel=1e-12)
