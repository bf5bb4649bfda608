"""Oils of the library with the source of every value, and viscosity grades of ISO 3448."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from ehlectric.cases import library
from ehlectric.cases.amounts import scalar
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.data_sheet import GRADES
from ehlectric.runtime.display import is_number

_WRITTEN = re.compile(r"\s*(?:ISO[ -]?)?(?:VG[ -]?)?(\d{1,4})\s*", re.IGNORECASE)


@dataclass(frozen=True)
class Grade:
    """Pydantic annotation of a viscosity grade: 46, "46", "VG 46" or "ISO VG 46"."""

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.parse)

    def __get_pydantic_json_schema__(self, _: CoreSchema, __: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"anyOf": [{"type": "integer", "enum": list(GRADES)}, {"type": "string"}]}

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"a viscosity grade of ISO 3448: {', '.join(map(str, GRADES))}"

    def parse(self, entry: object) -> int:
        """Grade as a whole number. Raises InputError if the entry is not a grade of ISO 3448.

        Examples
        --------
        >>> Grade().parse("ISO VG 46")
        46
        """
        item = scalar(entry)
        match = _WRITTEN.fullmatch(item) if isinstance(item, str) else None
        grade = int(match[1]) if match else item
        if not is_number(grade) or grade not in GRADES:
            raise InputError(got=shown(entry), takes=self.takes)
        return int(grade)


Kind = Literal["measured", "read off a diagram", "fitted", "published", "by rule", "estimated", "assumed"]

# Kinds of a source, the best first.
KINDS: tuple[Kind, ...] = get_args(Kind)


@dataclass(frozen=True)
class Source:
    """Source of some values of a file of the library."""

    keys: tuple[str, ...]
    kind: Kind  # one of ``KINDS``; "by rule" follows from published values by a rule that the note states
    citation: str = ""  # where the values were read; empty where they are assumed
    doi: str = ""
    note: str = ""  # what else has to be known, such as the rule or the reason for an assumption


def sources_of(table: Mapping[str, Any]) -> tuple[Source, ...]:
    """Sources of a file of the library, in the order of its ``[[source]]`` tables. Raises InputError if a
    source has a kind that does not exist, or no citation; an assumed value needs a note at least.
    """
    return tuple(_source(entry) for entry in table.get("source", ()))


def _source(entry: Mapping[str, Any]) -> Source:
    source = Source(**{**entry, "keys": tuple(entry["keys"])})
    if source.kind not in KINDS:
        raise InputError("source.kind", got=shown(source.kind), takes=f"one of {', '.join(KINDS)}")
    if not (source.citation or (source.kind == "assumed" and source.note)):
        raise InputError.missing("source", f"a citation for {', '.join(source.keys)}, or a note if assumed")
    return source


def weakest(sources: Iterable[Source], keys: Iterable[str]) -> Kind | None:
    """Kind of the weakest source among the sources of some keys; none where the keys have no source."""
    names = set(keys)
    kinds = [source.kind for source in sources if names & set(source.keys)]
    return max(kinds, key=KINDS.index, default=None)


# Tables of [lubricant] whose keys have sources of their own, as dotted keys.
_NESTED = ("temperature",)


@dataclass(frozen=True)
class LibraryOil:
    """Oil of the library.

    Examples
    --------
    >>> oil = library_oil("paper")
    >>> oil.source("roelands_z").kind, oil.needs
    ('assumed', ())
    """

    name: str
    title: str
    table: Mapping[str, Any]  # table ``[lubricant]`` in the form of a case file
    sources: tuple[Source, ...]
    # Keys of ``[lubricant]`` that a case must give, because no source of them was found.
    needs: tuple[str, ...] = ()

    def values(self) -> dict[str, Any]:
        """Values of the oil as the file contains them, by dotted key."""
        return values_of(self.table)

    @property
    def weakest(self) -> Kind | None:
        """Kind of the weakest source of all values."""
        return weakest(self.sources, self.values())

    def source(self, key: str) -> Source:
        """Source of the value of a dotted key. Raises KeyError if the oil has no value of this key."""
        for source in self.sources:
            if key in source.keys:
                return source
        raise KeyError(key)


def values_of(table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a table ``[lubricant]`` by dotted key, as sources name them.

    Examples
    --------
    >>> values_of({"base": "paper", "temperature": {"iso_vg": 46}})
    {'base': 'paper', 'temperature.iso_vg': 46}
    """
    return dict(_values(table))


def _values(table: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for key, value in table.items():
        if key in _NESTED and isinstance(value, Mapping):
            yield from ((f"{key}.{inner}", item) for inner, item in value.items())
        else:
            yield key, value


def library_oil(name: str) -> LibraryOil:
    """Oil of the library with its sources.

    Examples
    --------
    >>> library_oil("paper").title
    'Lubricant of the paper, similar to a mineral oil'
    """
    file = library.tables("lubricant", name)
    return LibraryOil(name, file["title"], file["lubricant"], sources_of(file), tuple(file.get("needs", ())))


def library_oils() -> list[LibraryOil]:
    """All oils of the library, by name."""
    return [library_oil(name) for name in library.lubricant_names()]
