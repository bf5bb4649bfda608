"""Table [film]: heat and shear are off by default, and a missing property is refused by its key."""

import pytest

from ehlectric import Case, InputError
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each

SHEARED = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper", "eyring_stress": "5 MPa"}}
OIL = {
    "base": "paper",
    "viscosity": 0.04,
    "atmospheric_law": "roelands",
    "roelands_s0": 1.1,
    "reference_temperature": 313.15,
    "density": 870.0,
    "thermal_expansion": 6.5e-4,
    "thermal_conductivity": 0.14,
    "heat_capacity": 2000.0,
}
STEEL = {"material": "steel"}
HOT = {
    "contact": PAPER_CONTACT | {"temperature": 313.15, "body_1": STEEL, "body_2": STEEL},
    "lubricant": OIL,
    "film": {"thermal": True},
}


def test_heat_and_shear_are_off_by_default():
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}})
    assert case.film is None
    assert "film" not in case.to_dict()
    table = Case.from_dict(SHEARED | {"film": {}}).film
    assert (table.thermal, table.rheology) == (False, "newtonian")
    assert Case.from_dict(HOT).film.thermal
    with pytest.raises(InputError, match=r"^film\.rheology: "):
        Case.from_dict(SHEARED | {"film": {"rheology": None}})


@each(
    "rheology, keys",
    [
        ("eyring", ["eyring_stress"]),
        ("carreau", ["carreau_stress", "carreau_exponent"]),
        ("limiting", ["limiting_coefficient"]),
    ],
)
def test_a_rheology_has_its_constants(rheology, keys):
    values = {
        "eyring_stress": "5 MPa",
        "carreau_stress": "6 MPa",
        "carreau_exponent": 0.5,
        "limiting_coefficient": 0.05,
    }
    oil = {"base": "paper"} | {key: values[key] for key in keys}
    table = {"contact": PAPER_CONTACT, "lubricant": oil, "film": {"rheology": rheology}}
    case = Case.from_dict(table)
    assert list(case.film.constants(case.lubricant)) == keys


def test_a_thermal_film_has_temperatures_of_its_surfaces():
    warm = PAPER_CONTACT | {"temperature_1": "60 degC"}
    assert Case.from_dict(HOT | {"contact": HOT["contact"] | warm}).contact.temperature_1 == 333.15


def test_thermal_properties_stay_where_the_elasticity_is_given_in_another_way():
    case = Case.from_dict(HOT).replace({"contact.body_1.thermal_conductivity": 30.0})
    assert case.contact.reduced_modulus is not None
    elastic = {"youngs_modulus": 206e9, "poissons_ratio": 0.3}
    changes = {
        f"contact.{body}.{key}": value for body in ("body_1", "body_2") for key, value in elastic.items()
    }
    bodies = case.replace(changes)
    assert bodies.contact.reduced_modulus is None
    again = bodies.replace({"contact.reduced_modulus": 226e9})
    assert again.contact == case.contact
