"""Origin of each input of a case: given, a default, or the library with its source and how good that is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.changes import flattened
from ehlectric.cases.input_keys import input_field, kind_of
from ehlectric.cases.library.sources import KINDS, Source, sources_of
from ehlectric.cases.oils.properties import Properties
from ehlectric.cases.quantity import Quantity
from ehlectric.errors import InputError

# Words for the origin of an input that is not a value of the library.
WORDS = ("given", "default", "varied")

# Kinds of sources that a reader may take for knowledge without a note.
_KNOWN = KINDS[: KINDS.index("by rule")]

# Tables that may name a base of the library: their dotted key, and the folder of the library.
_BASES = (("lubricant", "lubricant"), ("bearing", "bearing"), ("bearing.coating", "coating"))


@dataclass(frozen=True)
class Input:
    """Input of a case with its origin.

    Attributes
    ----------
    key : str
        Dotted key; the tables of rough surfaces are numbered from 1.
    value : object
        Value in SI units.
    origin : str
        One of ``WORDS``, or the name of the file of the library.
    source : Source or None
        Source of a value of the library; None for others.
    """

    key: str
    value: Any
    origin: str
    source: Source | None = None

    @property
    def assumed(self) -> bool:
        """Whether the library itself only assumes or estimates the value, or derives it by a rule."""
        return self.source is not None and self.source.kind not in _KNOWN


def inputs_of(case: Case | BearingCase) -> Iterator[Input]:
    """Inputs of a case in the order of its tables, without the title.

    A value is that of the library where it equals the one of the base that the case names, and a default
    where it equals the default of its key: a case does not keep whether somebody typed it.

    Parameters
    ----------
    case : Case or BearingCase
        Case of a contact or of a bearing.
    """
    tables = case.model_dump(mode="json", exclude_none=True, exclude_unset=True)
    of_library = _library_values(case)
    for key, value in flattened(_numbered(tables)).items():
        if key == "title" or value == {}:
            continue
        name, source, theirs = of_library.get(key, ("", None, None))
        if name and _equal(value, theirs):
            yield Input(key, value, name, source)
        else:
            yield Input(key, value, "default" if _is_default(key, value) else "given")


def _numbered(tables: Mapping[str, Any]) -> dict[str, Any]:
    """Tables in which lists of tables, as of rough surfaces, are tables by their numbers from 1."""
    return {
        key: {str(number): item for number, item in enumerate(value, 1)}
        if isinstance(value, list) and all(isinstance(item, dict) for item in value)
        else value
        for key, value in tables.items()
    }


def _equal(one: Any, other: Any) -> bool:
    """Whether two values are equal, numbers within their rounding."""
    if isinstance(one, float | int) and isinstance(other, float | int):
        return abs(one - other) <= 1e-12 * abs(one)
    return bool(one == other)


def _is_default(key: str, value: Any) -> bool:
    """Whether a value is the default of its key."""
    if key == "contacts":
        return bool(value == BearingCase.known_keys()[key].default)
    try:
        field = input_field(key)
    except InputError:
        # The key of a table or of a list has no single default.
        return False
    return not field.is_required() and _equal(value, field.default)


def _library_values(case: Case | BearingCase) -> dict[str, tuple[str, Source | None, Any]]:
    """Values of the bases that a case names, by dotted key: name of the file, source, and value."""
    found: dict[str, tuple[str, Source | None, Any]] = {}
    given = case.model_dump(mode="json", exclude_none=True, exclude_unset=True)
    for table, folder in _BASES:
        named: Any = given
        for part in table.split("."):
            named = named.get(part) if isinstance(named, Mapping) else None
        base = named.get("base") if isinstance(named, Mapping) else None
        if base is None:
            continue
        file = library.tables(folder, base)
        sources = _sources(file)
        for key, value in _values(folder, base, file[folder]).items():
            if key == "base":
                continue
            source = next((one for one in sources if key in one.keys), None)
            found[f"{table}.{key}"] = (base, source or _whole(sources), value)
    return found


def _sources(file: Mapping[str, Any]) -> tuple[Source, ...]:
    """Sources of a file of the library; a file with a single source has it for all of its values."""
    source = file.get("source")
    if not isinstance(source, Mapping):
        return sources_of(file)
    return (
        Source(
            (), "published", source.get("citation", ""), source.get("doi", ""), source.get("assumption", "")
        ),
    )


def _whole(sources: tuple[Source, ...]) -> Source | None:
    """Single source of a whole file; None where each key has its own."""
    return sources[0] if len(sources) == 1 and not sources[0].keys else None


def _values(folder: str, base: str, table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a file of the library in SI units, by dotted key."""
    if folder == "lubricant":
        oil = Properties.from_written({"base": base})
        return flattened(oil.model_dump(mode="json", exclude_none=True, exclude_unset=True))
    prefix = "bearing" if folder == "bearing" else "bearing.coating"
    values = {}
    for key, value in table.items():
        kind = kind_of(f"{prefix}.{key}")
        values[key] = kind.parse(value, written=True) if isinstance(kind, Quantity) else value
    return values


def material_sources(case: Case | BearingCase) -> Iterator[tuple[str, Source]]:
    """Names and sources of the solids of the library that a bearing or a contact is made of."""
    for name in dict.fromkeys(_materials(case)):
        for source in _sources(library.tables("solid", name)):
            yield name, source


def _materials(case: Case | BearingCase) -> Iterator[str]:
    """Solids of the library that a case names."""
    if isinstance(case, Case):
        bodies = (case.contact.body_1, case.contact.body_2)
        yield from (body.material for body in bodies if body is not None and body.material is not None)
        return
    table, known = case.to_dict()["bearing"], library.solid_names()
    keys = [key for tables in (table, table.get("fits", {})) for key in tables if key.endswith("_material")]
    values = {**table, **table.get("fits", {})}
    yield from (values[key] for key in keys if values[key] in known)
