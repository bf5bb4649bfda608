"""Table [film]: heat and shear are off by default, and a missing property is refused by its key."""

import pytest

from ehlectric import Case, InputError
from tests.conftest import PAPER_CONTACT

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


def without(table, name, key):
    """Case of a thermal film without one key."""
    part = {each: value for each, value in table[name].items() if each != key}
    return {**table, name: part}


def test_heat_and_shear_are_off_by_default():
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}})
    assert case.film is None
    assert "film" not in case.to_dict()
    table = Case.from_dict(SHEARED | {"film": {}}).film
    assert (table.thermal, table.rheology) == (False, "newtonian")


@pytest.mark.parametrize(
    ("rheology", "keys"),
    [
        ("eyring", ["eyring_stress"]),
        ("carreau", ["carreau_stress", "carreau_exponent"]),
        ("limiting", ["limiting_coefficient"]),
    ],
)
def test_a_rheology_needs_its_constants(rheology, keys):
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
    for key in keys:
        with pytest.raises(InputError, match=rf"^lubricant\.{key}: missing; .*'{rheology}' needs"):
            Case.from_dict(without(table, "lubricant", key))


@pytest.mark.parametrize("rheology", ["Eyring", "ree-eyring", 1, None])
def test_other_rheologies_are_refused(rheology):
    with pytest.raises(InputError, match=r"^film\.rheology: got .*expected 'newtonian', 'eyring'"):
        Case.from_dict(SHEARED | {"film": {"rheology": rheology}})


@pytest.mark.parametrize(
    ("table", "key"),
    [
        ("contact", "temperature"),
        ("lubricant", "density"),
        ("lubricant", "thermal_conductivity"),
        ("lubricant", "heat_capacity"),
    ],
)
def test_a_thermal_film_needs_the_oil(table, key):
    whole = Case.from_dict(HOT)
    assert whole.film.thermal
    case = without(HOT, table, key)
    if key == "density":
        # The heat capacity of a mass would need the density, too.
        case = without(case, "lubricant", "heat_capacity")
    with pytest.raises(InputError) as caught:
        Case.from_dict(case)
    assert caught.value.key == f"{table}.{key}"


def test_a_thermal_film_needs_a_viscosity_over_temperature():
    oil = {key: value for key, value in OIL.items() if key not in ("atmospheric_law", "roelands_s0")}
    with pytest.raises(InputError, match=r"^lubricant\.atmospheric_law: missing; .*temperature\]"):
        Case.from_dict(HOT | {"lubricant": oil})


@pytest.mark.parametrize("name", ["body_1", "body_2"])
def test_a_thermal_film_needs_both_bodies(name):
    with pytest.raises(InputError, match=rf'^contact\.{name}\.thermal_conductivity: missing; .*"steel"'):
        Case.from_dict(without(HOT, "contact", name))
    part = {"thermal_conductivity": 20.0, "heat_capacity": 700.0}
    table = HOT | {"contact": HOT["contact"] | {name: part}}
    with pytest.raises(InputError, match=rf"^contact\.{name}\.density: missing"):
        Case.from_dict(table)


def test_a_material_is_one_of_the_library_with_thermal_properties():
    for name in ("chrome", "aluminium"):
        table = HOT | {"contact": HOT["contact"] | {"body_1": {"material": name}}}
        with pytest.raises(InputError, match=rf"^contact\.body_1\.material: got '{name}'; .*steel"):
            Case.from_dict(table)


def test_temperatures_of_the_surfaces_belong_to_a_thermal_film():
    warm = PAPER_CONTACT | {"temperature_1": "60 degC"}
    with pytest.raises(InputError, match=r"^contact\.temperature_1: is used by a thermal film only"):
        Case.from_dict({"contact": warm, "lubricant": {"base": "paper"}})
    assert Case.from_dict(HOT | {"contact": HOT["contact"] | warm}).contact.temperature_1 == 333.15


def test_a_motion_has_no_heat():
    table = SHEARED | {"film": {"rheology": "eyring"}, "motion": {"passes": 1.0}, "grid": {"nodes": 801}}
    rough = [{"surface": 1, "generator": "sinusoid", "amplitude": "50 nm", "wavelength": "50 um"}]
    with pytest.raises(InputError, match=r"^film: is not used with \[motion\]"):
        Case.from_dict(table | {"roughness": rough})


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
