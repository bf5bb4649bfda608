"""JSON Schema of files of each kind, by which editors complete and explain their keys."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any, Literal

import tomli
from pydantic.json_schema import models_json_schema

from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.discharge_inputs import AxleDischarge, BearingDischarge
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import descriptions, phrase, tables_of_files
from ehlectric.cases.table import Table, name_key
from ehlectric.errors import InputError, shown
from ehlectric.quantities.inputs import ENDS
from ehlectric.runs.example_files import examples_folder
from ehlectric.runs.file_kinds import kind_of_tables
from ehlectric.sweep import Sweep

# Tables of each kind of file; a case of a contact may have motion or not.
SCHEMAS: Mapping[str, type[Table]] = MappingProxyType(
    {
        "contact": Case,
        "bearing": BearingCase,
        "drive": DriveCase,
        "axle": AxleCase,
        "gear": GearCase,
        "sweep": Sweep,
    }
)

# How pydantic names a schema of what is read.
_Mode = Literal["validation", "serialization"]

# Kind whose keys the book of inputs describes under its own name.
_SWEEP = "sweep"

# Tables of bearing and axle files whose keys have the texts of a table of contacts.
_ALIKE: tuple[tuple[str, type[Table]], ...] = (("discharge", BearingDischarge), ("discharge", AxleDischarge))

# Examples that are shown of a key.
_EXAMPLES = 3

# Marks of pydantic that say nothing to a reader of a file.
_MARKS = ("title", "default")

_DIALECT = "http://json-schema.org/draft-07/schema#"


def schema_of(kind: str) -> dict[str, Any]:
    """JSON Schema of a kind of file: its keys with texts, units, bounds and examples.

    It is made from the tables by which files are checked. What a schema cannot state, such as the bounds of a
    value with its unit, or keys that exclude each other, is checked where the file is read.

    Returns schema of draft 7, with plain JSON values. Raises InputError if there is no such kind.

    Examples
    --------
    >>> schema = schema_of("bearing")
    >>> schema["definitions"]["Bearing"]["properties"]["radial_load"]["examples"][0]
    '1800 N'
    """
    if kind not in SCHEMAS:
        raise InputError("kind", got=shown(kind), takes=f"one of {', '.join(SCHEMAS)}")
    model = SCHEMAS[kind]
    described: dict[str, type[Table]] = {**tables_of_files(), **({_SWEEP: model} if kind == _SWEEP else {})}
    models: list[type[Table]] = [
        *tables_of_files().values(),
        *(table_model for _, table_model in _ALIKE),
        model,
    ]
    keys: list[tuple[type[Table], _Mode]] = [
        (table_model, "validation") for table_model in dict.fromkeys(models)
    ]
    places, whole = models_json_schema(keys, ref_template="#/definitions/{model}")
    tables = {name: _tidied(table) for name, table in whole["$defs"].items()}
    tagged: list[tuple[str, type[Table]]] = [*described.items(), *_ALIKE]
    for name, table_model in tagged:
        _describe(tables[_named(places[table_model, "validation"])], name, table_model)
    root = _named(places[model, "validation"])
    schema = {**tables.pop(root), "definitions": tables}
    _as_written(schema, kind)
    for table in _examples(kind):
        _show(schema, schema, table)
    used = {root} | set(_used(schema, tables))
    schema["definitions"] = {name: tables[name] for name in sorted(used & set(tables))}
    return {"$schema": _DIALECT, "title": f"{kind} file of ehlectric", **schema}


def _named(place: Mapping[str, Any]) -> str:
    """Name of the table that a reference points to."""
    return str(place["$ref"]).rpartition("/")[2]


def _tidied(schema: Any) -> Any:
    """Schema without null, which TOML does not have, and without marks that say nothing."""
    if isinstance(schema, list):
        return [_tidied(item) for item in schema]
    if not isinstance(schema, Mapping):
        return schema
    tidied = {
        name: {key: _tidied(item) for key, item in value.items()} if name == "properties" else _tidied(value)
        for name, value in schema.items()
        if name not in _MARKS or (name == "default" and _says_something(value))
    }
    if "anyOf" not in tidied:
        return tidied
    ways: list[Any] = []
    for way in tidied.pop("anyOf"):
        # Nested alternatives are alternatives of the key itself.
        plain = isinstance(way, Mapping) and set(way) <= {"anyOf", "description"}
        ways += way["anyOf"] if plain and "anyOf" in way else [way]
        if plain and "description" in way:
            tidied.setdefault("description", way["description"])
    ways = [way for way in ways if way != {"type": "null"}]
    return {**tidied, **ways[0]} if len(ways) == 1 else {**tidied, "anyOf": ways}


def _says_something(default: Any) -> bool:
    """Whether a default is a value that one can write; a table or a list has the defaults of its keys."""
    return default not in (None, "") and not isinstance(default, dict | list)


def _describe(table: dict[str, Any], name: str, model: type[Table]) -> None:
    """Put the descriptions of the book of inputs before what the keys take."""
    for key in descriptions(name):
        if key in table.get("properties", {}):
            entry = table["properties"][key]
            takes = entry.get("description", "")
            if "$ref" in entry:
                # Next to a reference, draft 7 reads nothing else.
                inner = {"$ref": entry.pop("$ref")}
                named = name_key(key, model) != key
                entry |= {"anyOf": [{"type": "string"}, inner]} if named else {"allOf": [inner]}
                takes = ""
            entry["description"] = "\n".join(filter(None, (phrase(name, key), takes)))


def _as_written(schema: dict[str, Any], kind: str) -> None:
    """Allow what a file may have besides the tables of a case: names of other files."""
    properties = schema["properties"]
    if kind == "drive":
        schema["required"] = [key for key in schema["required"] if key != ENDS[1]]
        for end in ENDS:
            bearing = properties[end]
            properties[end] = {
                "description": bearing.get("description", ""),
                "anyOf": [
                    {
                        "type": "object",
                        "required": ["file"],
                        "properties": {"file": {"type": "string", "description": "path of a bearing file"}},
                    },
                    {"$ref": "#/definitions/BearingCase"},
                ],
            }
    if viscosities := schema["definitions"].get("ViscosityTable"):
        # A file contains them.
        viscosities["required"] = []
    if kind == "axle":
        mesh = schema["definitions"]["AxleMesh"]
        mesh["required"] = [key for key in mesh["required"] if key != "pair"]
        mesh["properties"]["file"] = {"type": "string", "description": "path of a gear file, instead of pair"}
    if kind == _SWEEP:
        case = properties["case"]
        case["anyOf"] = [{"type": "string"}, *case["anyOf"]]


def _examples(kind: str) -> Iterator[dict[str, Any]]:
    """Tables of the examples of a kind of file."""
    for path in sorted(examples_folder().glob("*.toml")):
        table = tomli.loads(path.read_text(encoding="utf-8"))
        table_kind = kind_of_tables(table) or "contact"
        if table_kind == kind or (table_kind == "motion" and kind == "contact"):
            yield table


def _show(whole: Mapping[str, Any], schema: dict[str, Any], table: Mapping[str, Any]) -> None:
    """Show the values of an example at their keys."""
    for key, value in table.items():
        entry = schema.get("properties", {}).get(key)
        if entry is None:
            continue
        inner = value[0] if isinstance(value, list) and value else value
        if isinstance(inner, Mapping):
            for each in _tables_of(whole, entry):
                _show(whole, each, inner)
        elif value not in entry.setdefault("examples", []) and len(entry["examples"]) < _EXAMPLES:
            entry["examples"].append(value)


def _tables_of(whole: Mapping[str, Any], schema: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Tables that a key may be, or of which it may be a list."""
    if "$ref" in schema:
        yield whole["definitions"][_named(schema)]
    for way in (*schema.get("anyOf", ()), *schema.get("allOf", ()), *filter(None, [schema.get("items")])):
        yield from _tables_of(whole, way)


def _used(schema: Any, tables: Mapping[str, Any], seen: frozenset[str] = frozenset()) -> Iterator[str]:
    """Names of the tables that a schema refers to, themselves and through others."""
    for name in {name for name in _references(schema) if name not in seen and name in tables}:
        yield name
        yield from _used(tables[name], tables, seen | {name})


def _references(schema: Any) -> Iterator[str]:
    if isinstance(schema, Mapping):
        if isinstance(schema.get("$ref"), str):
            yield _named(schema)
        for key, value in schema.items():
            if key != "definitions":
                yield from _references(value)
    elif isinstance(schema, list):
        for item in schema:
            yield from _references(item)
