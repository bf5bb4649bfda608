"""Descriptions of the keys of all files: each key has one, and each belongs to a key."""

import pytest

from ehlectric import InputError
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.input_keys import describe, descriptions, input_field, tables_of_files
from ehlectric.cases.table import Table, table_of
from ehlectric.quantities.inputs import form
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each

# Keys of the forms of the app, without the title, which stands in no table.
LISTED = {
    key for name in ("bearing", "line", "point", "drive") for keys in form(name).values() for key in keys
} - {"title"}
ALL = {**tables_of_files(), "sweep": Sweep}


@each("table", ALL)
def test_every_key_has_a_description_and_every_description_a_key(table):
    assert set(descriptions(table)) == set(ALL[table].known_keys())
    assert all(text.strip() for text in descriptions(table).values())


@pytest.mark.parametrize("model", [Case, BearingCase])
def test_every_table_of_a_file_is_among_them(model):
    def tables(of):
        for field in of.known_keys().values():
            inner = table_of(field.annotation)
            if inner is not None:
                yield inner
                yield from tables(inner)

    assert all(
        any(issubclass(found, known) for known in tables_of_files().values()) for found in tables(model)
    )
    assert issubclass(model, Table)


def test_a_key_that_can_be_varied_can_be_described():
    for key in LISTED:
        input_field(key)
        assert describe(key)
    assert describe("bearings.bearing.radial_load") == describe("bearing.radial_load")
    assert describe("contact.body_2.radius_x") == describe("contact.body_1.radius_x")
    assert describe("roughness.rq") == describe("roughness.1.rq")


@each(
    "key, nearest",
    [
        ("contact.lod", "contact.load"),
        ("loads.radial_load", "bearing.radial_load"),
        ("contact", "contact."),
        ("", ""),
        ("sweep.varies", "sweep.vary"),
    ],
)
def test_a_key_that_is_none_is_refused_with_the_nearest_one(key, nearest):
    with pytest.raises(InputError, match=rf"^{key}: unknown key; the nearest known one is {nearest}"):
        describe(key)


def test_descriptions_are_plain_text_with_units():
    for table in tables_of_files():
        for leaf in descriptions(table):
            key = f"{table}.{leaf}".replace("contact.body.", "contact.body_1.")
            text = describe(key)
            assert not set("$`{}\\") & set(text), text
    assert " of the unloaded surfaces [m]. " in describe("bearing.composite_rq")
    assert "√(R_q1² + R_q2²)" in describe("bearing.composite_rq")
    assert describe("contact.body_1.youngs_modulus") == "Young's modulus E of the body [Pa]"
    assert describe("bearing.inner_speed").count("ω_i") == 1
