"""A name of the library instead of a table: as the key of the table with this name, in every way of input."""

import pytest

from ehlectric import BearingCase, Case, DriveCase, InputError, Sweep, evaluate, oil
from ehlectric.app.compute.page_files import uploaded
from ehlectric.cases.coating_inputs import Coating
from ehlectric.runs.json_schema import schema_of
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

LINE = {
    "reduced_radius": "14.1 mm",
    "reduced_modulus": 226e9,
    "max_hertz_pressure": "1 GPa",
    "entrainment_speed": 4.0,
    "temperature": "40 degC",
}
DUTY = {
    "base": "6208",
    "radial_clearance": "10 um",
    "radial_load": "1 kN",
    "inner_speed": "3000 rpm",
    "temperature": "70 degC",
    "composite_rq": 3e-8,
}
# Name instead of a table, and the dotted key that it stands for.
OF_CONTACT = [
    ("lubricant", "fva-3", "lubricant.base"),
    ("contact.body_1", "steel", "contact.body_1.material"),
]
OF_BEARING = [
    ("lubricant", "paper", "lubricant.base"),
    ("bearing", "6209", "bearing.base"),
    ("bearing", "6209-2Z/C3", "bearing.base"),
    ("bearing.coating", "alumina", "bearing.coating.base"),
]


@pytest.fixture(scope="module")
def contact():
    return Case.line(**LINE, lubricant="paper")


@pytest.fixture(scope="module")
def bearing():
    return BearingCase.of(**DUTY, lubricant="fva-3")


def nested(key, value):
    for name in reversed(key.split(".")):
        value = {name: value}
    return value


@each("key, name, own", OF_CONTACT)
def test_a_contact_is_changed_by_the_name(contact, key, name, own):
    assert (
        contact.replace({key: name}) == contact.replace(**nested(key, name)) == contact.replace({own: name})
    )


@each("key, name, own", OF_BEARING)
def test_a_bearing_is_changed_by_the_name(bearing, key, name, own):
    assert (
        bearing.replace({key: name}) == bearing.replace(**nested(key, name)) == bearing.replace({own: name})
    )


@each("key, name, own", OF_BEARING)
def test_bearings_of_a_drive_are_changed_by_the_name(key, name, own):
    case = DriveCase.from_toml(EXAMPLES / "drive.toml")
    assert case.replace({f"bearings.{key}": name}) == case.replace({f"bearings.{own}": name})


def test_the_changed_oil_is_the_oil_of_the_library(contact):
    changed = contact.replace(lubricant="fva-3")
    assert changed.oil.viscosity == oil("fva-3", "40 degC").viscosity != contact.oil.viscosity


def test_a_new_coating_replaces_the_values_of_a_coating_without_a_name(bearing):
    own = {"ring": "inner", "thickness": 2e-4, "relative_permittivity": 10.0, "strength": 1e7}
    coated = bearing.replace({"bearing.coating": own})
    assert coated.replace({"bearing.coating": "alumina"}).bearing.coating == Coating.from_dict(
        {"base": "alumina", "strength": 1e7}
    )
    other = coated.replace({"bearing.coating": "schaeffler-j20aa"}).bearing.coating
    assert (other.ring, other.strength, other.breakdown_voltage) == ("outer", None, 3000.0)


def test_files_and_tables_take_the_name(tmp_path, contact, bearing):
    for case, tables in (
        (contact, {"contact": LINE, "lubricant": "paper"}),
        (bearing, {"bearing": DUTY, "lubricant": "fva-3"}),
    ):
        assert type(case).from_dict(tables) == type(case)(**tables) == case
        file = tmp_path / "case.toml"
        file.write_text(f'lubricant = "{case.lubricant.base}"\n' + case.to_toml().partition("[lubricant]")[0])
        assert type(case).from_toml(file).lubricant == case.lubricant
        assert oil(file).viscosity == oil(case.lubricant.base, oil(file).temperature).viscosity


def test_points_take_names(bearing):
    given = {"lubricant": ["fva-3", "paper"], "bearing": ["6208", "6209"]}
    own = {f"{key}.base": names for key, names in given.items()}
    assert Sweep.from_dict({"case": bearing, "vary": given}) == Sweep.from_dict(
        {"case": bearing, "vary": own}
    )
    assert evaluate(bearing, given).identical(evaluate(bearing, own))


@each(
    "change, key, says",
    [
        (lambda case: case.replace(lubricant="fva3"), "lubricant.base", ["fva3", "fva-3"]),
        (lambda case: case.replace(lubricant=3), "lubricant", ["3", "name of the library"]),
        (lambda case: case.replace(bearing=6209), "bearing", ["6209", "string"]),
        (lambda case: case.replace(bearing=None), "bearing", ["None", "table"]),
        (lambda case: case.replace({"bearing.life": "steel"}), "bearing.life", ["steel", "table"]),
        (
            lambda case: case.replace({"lubricant": "paper", "lubricant.base": "m100"}),
            "lubricant.base",
            ["twice"],
        ),
        (lambda case: case.with_arrays({"lubricant": ["paper", "m100"]}), "lubricant", ["table", "keys"]),
        (lambda case: evaluate(case, {"bearing": [6208, 6209]}), "bearing", ["6208", "string"]),
        (
            lambda case: evaluate(case, {"lubricant": ["paper"], "lubricant.base": ["m100"]}),
            "lubricant.base",
            ["twice"],
        ),
        (
            lambda case: Sweep.from_dict({"case": case, "vary": {"lubricant": "paper"}}),
            "vary.lubricant",
            ["table", "lubricant.base"],
        ),
        (
            lambda case: Sweep.from_dict({"case": case, "vary": {"grid": ["fine", "coarse"]}}),
            "vary.grid",
            ["table"],
        ),
    ],
)
def test_what_is_no_name_is_refused(bearing, change, key, says):
    with pytest.raises(InputError) as caught:
        change(bearing)
    assert caught.value.key == key
    assert all(text in str(caught.value) for text in says), str(caught.value)


def test_a_page_shows_the_name_in_its_field(tmp_path, bearing):
    text = f'lubricant = "fva-3"\n{bearing.to_toml().partition("[lubricant]")[0]}'
    found = uploaded({"own.toml": text.encode()}, tmp_path).table
    assert found["lubricant"] == {"base": "fva-3"}
    assert BearingCase.from_written(found).lubricant == bearing.lubricant


def test_editors_take_the_name():
    ways = schema_of("bearing")["properties"]["lubricant"]["anyOf"]
    assert {"type": "string"} in ways
