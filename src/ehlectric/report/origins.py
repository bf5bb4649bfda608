"""Origin of each input of a case: given, a default, or the library with its source and how good that is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.changes import flattened
from ehlectric.cases.drives.case import BOTH, ENDS, DriveCase
from ehlectric.cases.drives.swept import SweptCase
from ehlectric.cases.input_keys import input_field, kind_of
from ehlectric.cases.library.sources import KINDS, Source, sources_of
from ehlectric.cases.oils.properties import Properties
from ehlectric.errors import InputError, printable
from ehlectric.figures.names import with_units_kept
from ehlectric.quantities.inputs import end_and_key
from ehlectric.runtime.values import is_number
from ehlectric.tables.html import input_row

# Words for the origin of an input that is not a value of the library.
WORDS = ("given", "default", "varied")

# Kinds of sources that a reader may take for knowledge without a note.
_KNOWN = KINDS[: KINDS.index("by rule")]

# Tables that may name a base of the library: their dotted key, and the folder of the library.
_BASES = (("lubricant", "lubricant"), ("bearing", "bearing"), ("bearing.coating", "coating"))

# What stands before the keys of two equal bearings of a drive, and the keys of a bearing whose place a key of
# the table drive takes.
_BOTH = f"{BOTH}."
_REPLACED = {"bearing.inner_speed": "speed", "bearing.temperature": "temperature", "contacts": "contacts"}


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


def inputs_of(case: SweptCase, *, apart: bool = False) -> Iterator[Input]:
    """Inputs of a case in the order of its tables, without the title and the remedies of a drive.

    A value is that of the library where it equals the one of the base that the case names, and a default
    where it equals the default of its key: a case does not keep whether somebody typed it.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Case of a contact, of a bearing or of a drive.
    apart : bool
        Whether two equal bearings of a drive have keys of their own; otherwise their keys begin with
        "bearings".
    """
    tables = _tables(case, apart=apart)
    of_library = {
        f"{before}{key}": value
        for before, own in _parts(case, apart=apart).items()
        for key, value in _library_values(own).items()
    }
    for key, value in flattened(_numbered(tables)).items():
        if end_and_key(key)[1] == "title" or value == {}:
            continue
        name, source, theirs = of_library.get(key, ("", None, None))
        if name and _equal(value, theirs):
            yield Input(key, value, name, source)
        else:
            yield Input(key, value, "default" if _is_default(key, value) else "given")


def _tables(case: SweptCase, *, apart: bool) -> dict[str, Any]:
    """Nested tables of the inputs that are set; two equal bearings of a drive are one."""
    tables = case.model_dump(mode="json", exclude_none=True, exclude_unset=True)
    tables.pop("remedies", None)
    if isinstance(case, DriveCase):
        bearings = {before[:-1]: tables[ENDS[0]] for before in _parts(case, apart=apart) if before == _BOTH}
        if bearings:
            tables = {key: value for key, value in tables.items() if key not in ENDS} | bearings
    return tables


def _parts(case: SweptCase, *, apart: bool = False) -> dict[str, Case | BearingCase]:
    """Cases of contacts or bearings in a case, by what stands before their keys."""
    if not isinstance(case, DriveCase):
        return {"": case}
    if case.drive_end == case.non_drive_end and not apart:
        return {_BOTH: case.drive_end}
    return {f"{end}.": getattr(case, end) for end in ENDS}


def input_text(case: SweptCase, key: str, value: Any) -> str:
    """Value of an input as a report shows it, in a unit that suits it.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Case with the input.
    key : str
        Dotted key of the input.
    value : object
        Value in SI units.
    """
    text = input_row(case, key, value).text
    return with_units_kept(printable(text.replace("ohm", "Ω") if is_number(value) else text))


def replaced_by(case: SweptCase, key: str) -> str:
    """Key of a drive whose value takes the place of that of its bearings; empty where none does.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Case with the input.
    key : str
        Dotted key of the input.
    """
    end, own = end_and_key(key)
    if not end or own not in _REPLACED or not isinstance(case, DriveCase):
        return ""
    name = _REPLACED[own]
    return f"drive.{name}" if getattr(case.drive, name) is not None else ""


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
    if end_and_key(key)[1] == "contacts":
        return bool(value == BearingCase.known_keys()["contacts"].default)
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
        values[key] = kind.parse(value, written=True) if isinstance(kind, Amount) else value
    return values


def material_sources(case: SweptCase) -> Iterator[tuple[str, Source]]:
    """Names and sources of the solids of the library that bearings or a contact are made of."""
    for name in dict.fromkeys(name for part in _parts(case).values() for name in _materials(part)):
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
