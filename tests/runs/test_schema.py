"""JSON Schemas of files: all files of the package are valid by them, and mistakes are not."""

import json
import tomllib

import pytest
from jsonschema import Draft7Validator

from ehlectric.cases.input_keys import descriptions, tables_of_files
from ehlectric.commands.start_commands import TEMPLATES, template
from ehlectric.runs.file_kinds import kind_of_tables
from ehlectric.runs.json_schema import SCHEMAS, schema_of
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

FILES = sorted({*EXAMPLES.glob("*.toml"), *(template(kind) for kind in TEMPLATES)})


def read(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def kind_of(table):
    return {None: "contact", "motion": "contact"}.get(kind_of_tables(table), kind_of_tables(table))


@pytest.fixture(scope="module")
def validators():
    return {kind: Draft7Validator(schema_of(kind)) for kind in SCHEMAS}


@pytest.mark.slow
@each("kind", SCHEMAS)
def test_schemas_are_of_draft_7(kind):
    Draft7Validator.check_schema(schema_of(kind))


@pytest.mark.slow
@each("path", FILES, ids=lambda path: path.stem)
def test_files_of_the_package_are_valid(validators, path):
    table = read(path)
    assert [error.message for error in validators[kind_of(table)].iter_errors(table)] == []


@each(
    ("name", "place", "value"),
    [
        ("bearing_6208", ("bearing", "radial_lode"), "1 N"),
        ("bearing_6208", ("bearing", "elements"), 2),
        ("bearing_6208", ("bearing", "inner_speed"), 3000),
        ("line_contact", ("grid", "nodes"), 64),
        ("line_contact", ("contact", "geometry"), "circle"),
        ("drive", ("source", "modulation"), "sine"),
        ("drive", ("circuit", "grounding_ring_resistence"), "1 ohm"),
        ("drive", ("drive", "seed"), -1),
        ("sweep", ("design",), "random"),
    ],
)
def test_mistakes_are_seen(validators, name, place, value):
    """Unknown keys, numbers out of bounds, words that are not allowed, and a speed without a unit."""
    table = read(EXAMPLES / f"{name}.toml")
    *inside, key = place
    inner = table
    for part in inside:
        inner = inner.setdefault(part, {})
    inner[key] = value
    (error,) = validators[kind_of(table)].iter_errors(table)
    assert key in list(error.absolute_path) or key in error.message


def test_a_drive_may_name_its_bearings(validators):
    table = read(EXAMPLES / "drive.toml")
    table["drive_end"] = {"file": "bearing.toml", "bearing": {"radial_load": "1 kN"}}
    assert list(validators["drive"].iter_errors(table)) == []
    table["drive_end"]["file"] = 3
    assert list(validators["drive"].iter_errors(table)) != []


def test_keys_have_their_texts_units_and_examples():
    """Beside each other: what a key is, its bounds in words, and values of the examples."""
    load = schema_of("bearing")["definitions"]["Bearing"]["properties"]["radial_load"]
    assert load["description"].startswith(
        "radial load F_r: force on the inner ring perpendicular to the axis\n"
        "a number in N or a string with its unit"
    )
    assert "1800 N" in load["examples"]
    assert {"type": "string"} in load["anyOf"]


@pytest.mark.slow
@each("kind", SCHEMAS)
def test_every_key_is_explained(kind):
    schema = schema_of(kind)
    for name, table in {kind: schema, **schema["definitions"]}.items():
        for key, own in table.get("properties", {}).items():
            assert own.get("description"), f"{name}.{key}"


def test_every_table_has_texts():
    assert all(descriptions(name) for name in tables_of_files())


@pytest.mark.slow
def test_nothing_refers_to_a_table_that_is_not_there():
    for kind in SCHEMAS:
        schema = schema_of(kind)
        names = {part.partition('"')[0] for part in json.dumps(schema).split("#/definitions/")[1:]}
        assert names == set(schema["definitions"])
