"""Constructors of cases that take keywords: their signatures and tables, and types for type checkers.

A value is a float in SI units, a text with a unit, or a quantity of pint. Every other value is refused when
the case is made, by the checks of a case file.
"""

from __future__ import annotations

import functools
import inspect
import re
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, Protocol, TypeAlias, TypeVar, cast, get_args, get_origin

from pydantic.fields import FieldInfo

from ehlectric.cases.defaults import Contacts
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import first_clause, inputs, plain_text
from ehlectric.quantities.units import printed

F = TypeVar("F", bound=Callable[..., Any])
T = TypeVar("T", bound=Table)


class HasUnit(Protocol):
    """Number with a unit, such as a quantity of pint."""

    @property
    def magnitude(self) -> Any:
        """Number in the unit of the quantity."""
        ...

    def to(self, other: Any = None, /) -> Any:
        """Quantity in another unit."""
        ...


# Value of a key: a float in SI units, a text with a unit, or a quantity.
Value: TypeAlias = float | str | HasUnit

# Tables by key, as in a case file.
Keys: TypeAlias = Mapping[str, Any]

# Fields of keywords by the names of their tables in the book of inputs, in the order in which ``help`` lists
# them; None for a table.
Fields: TypeAlias = Mapping[str, Mapping[str, FieldInfo | None]]


# Types of keywords as ``help`` shows them, by their annotation without "None" and without tables.
_TYPES = {
    "Value": "number",
    "float | str": "number or str",
    "str": "str",
    "int": "int",
    "bool": "bool",
    "Keys": "mapping",
    "Keys | str": "mapping or name",
    "OwnLaws": "Laws",
    "Contacts": f"{{{', '.join(map(repr, get_args(Contacts)))}}}",
}

# Meanings of keywords that no file contains.
_MEANINGS = {"laws": "functions of your own for the oil, instead of laws of the lubricant"}

# Width of a line of ``help``, and length from which a meaning ends at its first colon [characters].
_WIDTH, _LONG = 104, 150


def takes(keys: type, fields: Fields) -> Callable[[F], F]:
    """Decorator that shows the keys of a ``TypedDict`` in signature and help of a function of ``**keywords``.

    Editors and ``help`` then list them by name, with types, units and meanings of the book of inputs. A call
    without the lubricant raises an InputError.
    """

    def decorated(function: F) -> F:
        signature = inspect.signature(function)
        *first, _ = signature.parameters.values()
        kind = inspect.Parameter.KEYWORD_ONLY
        named = [inspect.Parameter(key, kind, default=None) for key in keys_of(keys)]

        @functools.wraps(function)
        def called(*values: Any, **keywords: Any) -> Any:
            if "lubricant" not in keywords:
                raise InputError.missing(
                    "lubricant", "its table, or the name of one of the library, as 'paper'"
                )
            return function(*values, **keywords)

        called.__signature__ = signature.replace(parameters=[*first, *named])  # type: ignore[attr-defined]
        if called.__doc__ is not None:
            head, _, examples = inspect.cleandoc(called.__doc__).partition("\nExamples\n")
            listed = "\n".join(_listed(keys, fields))
            called.__doc__ = f"{head}\nParameters\n----------\n{listed}\n\nExamples\n{examples}"
        return cast("F", called)

    return decorated


def _listed(keys: type, fields: Fields) -> Iterator[str]:
    """Lines of ``help`` about the keys of a ``TypedDict``: name, type, unit and meaning."""
    names = [(book, key) for book, listed in fields.items() for key in listed if key in keys.__annotations__]
    for book, key in [*names, *(("", key) for key in _MEANINGS if key in keys.__annotations__)]:
        given = _type_of(keys.__annotations__[key], fields.get(book, {}).get(key))
        unit = printed(inputs()[book][key].unit) if book and inputs()[book][key].unit else ""
        meaning = _MEANINGS[key] if not book else plain_text(inputs()[book][key].meaning)
        clause = first_clause(meaning)
        short = clause.partition(": ")[0] if len(clause) > _LONG else clause
        yield _entry(f"{key} : {given}{f' [{unit}]' if unit else ''}", short)


def _entry(head: str, text: str) -> str:
    """Entry of ``help`` about a parameter, on one line if it fits on one."""
    line = f"{head}, {text}"
    if len(line) <= _WIDTH:
        return line
    name, _, choices = head.partition(" : ")
    if len(head) > _WIDTH:
        head, text = f"{name} : str", f"{text}: one of {choices.strip('{}')}"
    indent = "    "
    return f"{head}\n{textwrap.fill(text, _WIDTH, initial_indent=indent, subsequent_indent=indent)}"


def with_keys(model: type[T], tables: Mapping[str, type[Table]]) -> type[T]:
    """Class of a file whose ``help`` lists the keys of its tables, with their units, behind the parameters.

    ``tables``, tables by their keys in the file.
    """
    if model.__doc__ is not None:
        parts = []
        for name, table in tables.items():
            entries = inputs()[table.BOOK]
            units = {key: printed(entries[key].unit) for key in table.model_fields if key in entries}
            keys = [f"{key} [{unit}]" if unit else key for key, unit in units.items()]
            parts.append(textwrap.fill(f"{name}: {', '.join(keys)}.", _WIDTH))
        text = "\n\n".join(parts)
        model.__doc__ = f"{inspect.cleandoc(model.__doc__)}\n\nNotes\n-----\nKeys of the tables:\n\n{text}\n"
    return model


def _type_of(annotation: Any, field: FieldInfo | None) -> str:
    """Type of a keyword in words; of a key with few values, these values."""
    choices = [] if field is None else [field.annotation, *get_args(field.annotation)]
    for choice in choices:
        if get_origin(choice) is Literal:
            return f"{{{', '.join(map(repr, get_args(choice)))}}}"
    text = re.sub(r"Required\[(.*)\]", r"\1", annotation.__forward_arg__).removesuffix(" | None")
    if text.startswith("Sequence"):
        return "sequence of mapping"
    return _TYPES[" | ".join(part for part in text.split(" | ") if not part[0].isupper() or part in _TYPES)]


def keys_of(keys: type) -> Sequence[str]:
    """Names of the keys of a ``TypedDict``."""
    return list(keys.__annotations__)


def split(keywords: Mapping[str, Any], names: type) -> tuple[dict[str, Any], dict[str, Any]]:
    """Keywords that a ``TypedDict`` names, and all others.

    Keywords of the ``TypedDict`` that are None are omitted.

    Examples
    --------
    >>> from typing import TypedDict
    >>> Tables = TypedDict("Tables", {"lubricant": str, "discharge": None})
    >>> split({"lubricant": "paper", "discharge": None, "load": 1.0}, Tables)
    ({'lubricant': 'paper'}, {'load': 1.0})
    """
    tables = {name: keywords[name] for name in keys_of(names) if keywords.get(name) is not None}
    return tables, {name: value for name, value in keywords.items() if name not in names.__annotations__}
