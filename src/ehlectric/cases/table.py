"""Tables of a case file, and their errors as one line for the user: which key, what it got, what it takes."""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from types import UnionType
from typing import Any, Self, Union, get_args, get_origin

from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ehlectric.errors import InputError, shown
from ehlectric.runtime.files import reading


class Table(BaseModel):
    """A frozen table of a case file that refuses unknown keys."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Validated input of nested tables, as a TOML parser gives them.

        Raises
        ------
        InputError
            One line with the key, what it got and what it takes.
        """
        try:
            return cls.model_validate(dict(table))
        except ValidationError as error:
            raise first_error(error, cls) from None

    @classmethod
    def known_keys(cls) -> dict[str, FieldInfo]:
        """Keys of the table, each with its annotation and default."""
        return dict(cls.model_fields)


def read_toml(path: str | Path) -> dict[str, Any]:
    """Nested tables of a TOML file.

    Raises
    ------
    InputError
        Where the file cannot be read or is not TOML.
    """
    path = Path(path)
    try:
        with reading(path):
            return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except InputError:
        raise
    except UnicodeDecodeError:
        raise InputError(path, "is not a text file in UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(path, f"is not TOML, {error}") from None
    except (ValueError, RecursionError):
        raise InputError(path, "is not TOML that can be read, some value is too long or too deep") from None


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name that is most like ``name``."""
    return difflib.get_close_matches(name, list(known), n=1, cutoff=0.0)[0]


def first_error(error: ValidationError, model: type[Table]) -> InputError:
    """The first thing to mend: an unknown key before a missing one, which it often is."""
    first, *others = sorted(error.errors(), key=lambda e: e["type"] != "extra_forbidden")
    wrong, more = _error(first, model), ""
    if first["type"] == "missing":
        table = first["loc"][:-1]
        also = [other for other in others if other["type"] == "missing" and other["loc"][:-1] == table]
        if also:
            more = "; missing too: " + ", ".join(str(other["loc"][-1]) for other in also)
        others = [other for other in others if other not in also]
    more += f" (and {len(others)} more)" if others else ""
    return wrong.retold(wrong.key, wrong.text + more)


def _error(detail: ErrorDetails, model: type[Table]) -> InputError:
    # The place within a list is of no use to somebody who wrote the list.
    key = ".".join(_shown_key(part) for part in detail["loc"] if isinstance(part, str))
    given = shown(detail["input"])
    match detail["type"]:
        case "extra_forbidden":
            return InputError.unknown(key, nearest_key(key, model))
        case "missing" if isinstance(detail["loc"][-1], str):
            return InputError.missing(key, f"a {_kind(key, model)}")
        case "value_error":
            # A quantity does not know the key that it is the value of, a table not its own name.
            wrong = detail["ctx"]["error"]
            return (wrong if isinstance(wrong, InputError) else InputError(str(wrong))).under(key)
        case "literal_error":
            return InputError(key, got=given, takes=detail["ctx"]["expected"])
        case "model_type" | "model_attributes_type" | "dict_type":
            return InputError(key, got=given, takes="a table")
        case "string_type":
            return InputError(key, got=given, takes="a text")
        case "missing" | "tuple_type" | "too_long" | "too_short":
            kind = (
                f"tables, each headed [[{key}]]" if _kind(key, model) == "table" else "a list of two numbers"
            )
            return InputError(key, got=given, takes=kind)
    return InputError(key, got=f"{given}, {detail['msg']}")


def _shown_key(key: str) -> str:
    """A key as it was written, unless it would break the line."""
    return key if key and key.isprintable() and len(key) <= 60 else shown(key)


def nearest_key(key: str, model: type[Table]) -> str:
    """The known key nearest to an unknown one: in its own table, or of the same name elsewhere."""
    table, _, leaf = key.rpartition(".")
    known = list(_keys(model))
    elsewhere = [name for name in known if name.rpartition(".")[2] == leaf]
    if elsewhere:
        return elsewhere[0]
    return nearest(key, [name for name in known if name.rpartition(".")[0] == table] or known)


def _keys(model: type[Table], prefix: str = "") -> Iterator[str]:
    for name, field in model.known_keys().items():
        yield prefix + name
        inner = table_of(field.annotation)
        if inner is not None:
            yield from _keys(inner, f"{prefix}{name}.")


def _kind(key: str, model: type[Table]) -> str:
    """Whether a key is a table or a value."""
    return "table" if any(name.startswith(key + ".") for name in _keys(model)) else "value"


def table_of(annotation: Any) -> type[Table] | None:
    """The table that an annotation holds, alone, as an alternative or in a list; None where it holds none."""
    candidates = get_args(annotation) if get_origin(annotation) in (Union, UnionType, tuple) else [annotation]
    for candidate in candidates:
        if isinstance(candidate, type) and issubclass(candidate, Table):
            return candidate
    return None
