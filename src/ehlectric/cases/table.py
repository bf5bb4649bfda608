"""Base class of the tables of a case file, their title, and validation errors as one line for the user."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from inspect import Parameter, Signature
from itertools import islice, pairwise
from pathlib import Path
from types import MappingProxyType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self, Union, get_args, get_origin

import tomli
from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    GetJsonSchemaHandler,
    ValidationError,
    ValidationInfo,
    create_model,
)
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema, ErrorDetails, InitErrorDetails

from ehlectric.cases.amounts import WRITTEN, Amount, AmountOrWord, Amounts, Count, with_bounds
from ehlectric.cases.key_names import ADVICE, refuse_deep, refuse_long_keys
from ehlectric.errors import MOST_NAMED, InputError, printable, short, shown, unseen
from ehlectric.quantities.inputs import aliases, inputs
from ehlectric.quantities.units import ROTATION
from ehlectric.runtime.display import Tabled
from ehlectric.runtime.reading import read_text

if TYPE_CHECKING:
    from ehlectric.arrays import Array

# Names that completion need not list: names of pydantic, many of them deprecated, and internal ones.
_HIDDEN = frozenset(name for name in dir(BaseModel) if not name.startswith("__")) | {
    "BOOK",
    "all_inputs",
    "NAMED_BY",
    "arrays",
    "check_alternatives",
    "check_not_replaced",
    "check_together",
    "check_over",
    "connections",
    "described_toml",
    "first_grid",
    "from_written",
    "known_keys",
    "law_values",
    "of_file",
    "of_name",
    "user_laws",
    "plain_tables",
    "shape",
    "missing_table_hint",
    "single",
    "toml_text",
    "unused_keys",
    "with_arrays",
    "with_laws",
    "with_values",
}


class _Unstated:
    """Default of a key in a signature, where it would be longer than the rest of the line."""

    def __repr__(self) -> str:
        return "..."


# Types of numbers as fields have them, without "| None".
_NUMBERS = ("float", "int", "tuple[float, ...]")


def _with_bounds(annotation: str, table: str, key: str) -> Any:
    """Annotation of a field; the annotation of a number gets the unit and the bounds of the book."""
    plain = annotation.removesuffix(" | None")
    if plain not in _NUMBERS:
        if "float" in annotation and not annotation.startswith("Annotated["):
            raise TypeError(
                f"{table}.{key}: {annotation} has no bounds of the book; write {' or '.join(_NUMBERS)}"
            )
        return annotation
    about = inputs()[table][key]
    number: Any
    match plain:
        case "float":
            number = Annotated[float, with_bounds(Amount, about)]
        case "int":
            number = Annotated[int, with_bounds(Count, about)]
        case _:
            number = Annotated[tuple[float, ...], Amounts(with_bounds(Amount, about), least=2)]
    return number if plain == annotation else number | None


if TYPE_CHECKING:
    from pydantic._internal._model_construction import ModelMetaclass as _Listed
else:

    class _Listed(type(BaseModel)):
        """Class of tables, of which ``dir`` and ``help`` list what is theirs and not what is pydantic's.

        ``book`` is the name of the table in the book of inputs, which has units and bounds of its numbers;
        ``named_by`` is the key with a name of the library that a text instead of the table stands for.
        """

        def __new__(
            mcs,
            name: str,
            bases: Any,
            namespace: dict[str, Any],
            *,
            book: str = "",
            named_by: str = "",
            **kwargs: Any,
        ):
            if named_by:
                namespace["NAMED_BY"] = named_by
            if book:
                namespace["BOOK"] = book
                annotations = namespace["__annotations__"]
                for key, annotation in annotations.items():
                    annotations[key] = _with_bounds(annotation, book, key)
            return super().__new__(mcs, name, bases, namespace, **kwargs)

        def __dir__(cls) -> list[str]:
            return [name for name in super().__dir__() if name not in _HIDDEN and not name.startswith("_")]


class Table(BaseModel, metaclass=_Listed):
    """Frozen table of a case file; unknown keys are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)

    # Name of the table in the book of inputs, and key that a text instead of the table stands for.
    BOOK: ClassVar[str] = ""
    NAMED_BY: ClassVar[str] = ""
    # Lists of tables in whose errors keys have the number of the table, from 1.
    _numbered: ClassVar[tuple[str, ...]] = ()

    def __init__(self, /, **table: Any) -> None:
        refuse_deep(table)
        try:
            super().__init__(**table)
        except ValidationError as error:
            raise first_error(error, type(self), table) from None

    # Pydantic makes tables within tables without calling __init__, so that an error has its whole key.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    if TYPE_CHECKING:

        def __init_subclass__(cls, *, book: str = "", named_by: str = "", **kwargs: Any) -> None: ...

    else:

        def __setattr__(self, name: str, value: Any) -> None:
            if not name.startswith("__"):
                raise _frozen(name)
            super().__setattr__(name, value)

        def __delattr__(self, name: str) -> None:
            raise _frozen(name)

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: Any) -> None:
        """Give the class a signature of one line, without the annotations that pydantic reads."""
        super().__pydantic_init_subclass__(**kwargs)
        kind = Parameter.KEYWORD_ONLY
        parameters = [
            Parameter(name, kind, default=Parameter.empty if field.is_required() else _Unstated())
            for name, field in cls.model_fields.items()
        ]
        cls.__signature__ = Signature(parameters)

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if name not in _HIDDEN]

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Schema for editors: the first sentence of the docstring, and no required key next to a base."""
        schema = dict(handler.resolve_ref_schema(handler(core)))
        schema["description"] = (cls.__doc__ or "").partition("\n\n")[0]
        if "base" in cls.model_fields:
            schema.pop("required", None)
        return schema

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Make an instance from nested tables, as read from a TOML file.

        A value is a number in SI units, a string with its unit, or a quantity of pint. A rotational speed is
        a string, a quantity, or a float in rad/s; a whole number is refused, because it is nearly always
        meant in rpm. An ``InputError`` names each wrong key, its value, and what is allowed.
        """
        return cls._validated(table, written=False)

    @classmethod
    def from_written(cls, table: Mapping[str, Any]) -> Self:
        """Make an instance from tables that a person wrote into a file.

        It differs from ``from_dict`` in one rule: a rotational speed must have its unit.

        Parameters
        ----------
        table : mapping
            Nested tables, as read from a TOML file.

        Returns
        -------
        Table
            Instance of this class, with numbers in SI units.

        Raises
        ------
        InputError
            If the tables are not valid; the message names the key, its value, and what is allowed.
        """
        return cls._validated(table, written=True)

    @classmethod
    def _validated(
        cls, table: Mapping[str, Any], *, written: bool, context: Mapping[str, Any] | None = None
    ) -> Self:
        refuse_deep(table)
        try:
            return cls.model_validate(dict(table), context={WRITTEN: written, **(context or {})})
        except ValidationError as error:
            raise first_error(error, cls, table) from None

    def check_over(self, key: str, values: str) -> Self:
        """Table itself, if the numbers of a key increase, and another key has as many values."""
        places, numbers = getattr(self, key), getattr(self, values)
        if any(b <= a for a, b in pairwise(places)):
            raise InputError(key, got=list(places), takes="increasing values")
        if len(numbers) != len(places):
            got = f"{len(numbers)} values over {len(places)} of {key}"
            raise InputError(values, got=got, takes="as many")
        return self

    def check_together(self, *keys: str) -> None:
        """Raise an InputError where one of some keys is given, and another one is not."""
        given = [key for key in keys if getattr(self, key) is not None]
        missing = [key for key in keys if key not in given]
        if given and missing:
            raise InputError.missing(missing[0], f"a value; {given[0]} is given")

    def check_alternatives(self, keys: Sequence[str], takes: str, *, needed: bool = False) -> None:
        """Raise an InputError where several of some keys are given, or none though one is needed."""
        given = [key for key in keys if getattr(self, key) is not None]
        if len(given) > 1 or (needed and not given):
            got = f"{' and '.join(given)} together" if given else None
            raise InputError(given[0] if given else keys[0], got=got, takes=takes)

    def arrays(self) -> dict[str, Array]:
        """Arrays of the keys that have a number for each of many points, by dotted key; none by default."""
        arrays: dict[str, Array] = {}
        for name, value in (*self.__dict__.items(), *(self.__pydantic_extra__ or {}).items()):
            if isinstance(value, Table):
                arrays |= {f"{name}.{key}": array for key, array in value.arrays().items()}
            elif getattr(value, "ndim", 0):
                arrays[name] = value
        return arrays

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Copy with values of dotted keys in its tables, which are not checked."""
        direct, within = by_table(values)
        inner = {name: getattr(self, name).with_values(changes) for name, changes in within.items()}
        return self.model_copy(update=direct | inner)

    def single(self, index: int) -> Self:
        """Table of one of many points, with its numbers as floats, which are not checked."""
        return self.with_values({key: float(array[index]) for key, array in self.arrays().items()})

    @classmethod
    def of_name(cls, table: Any) -> Any:
        """Table with the name of the library, if a text stands for the table; otherwise the given value."""
        return {cls.NAMED_BY: table} if cls.NAMED_BY and isinstance(table, str) else table

    @classmethod
    def missing_table_hint(cls, key: str, given: Mapping[str, Any]) -> str:  # noqa: ARG003
        """Text about why a missing key is expected next to the given keys; empty by default."""
        return ""

    @classmethod
    def unused_keys(cls, given: Mapping[str, Any]) -> set[str]:
        """Return the dotted keys that a table with given values cannot use, such as keys of another geometry.

        ``given``, values or tables by key, which may be wrong. Messages do not propose these keys.
        """
        unused: set[str] = set()
        for name, field in cls.known_keys().items():
            inner, entries = table_of(field.annotation), as_mapping(given.get(name))
            if inner is not None:
                unused |= {f"{name}.{key}" for key in inner.unused_keys(entries)}
        return unused

    @classmethod
    def known_keys(cls) -> dict[str, FieldInfo]:
        """Keys of the table, each with its field (annotation and default)."""
        return dict(cls.model_fields)


def as_mapping(table: Any) -> Mapping[str, Any]:
    """Values of a table by key; none of what is no table."""
    if isinstance(table, Table):
        return table.__dict__
    return table if isinstance(table, Mapping) else {}


class CaseFile(Tabled, Table):
    """Table of a whole file: a case of a contact, a bearing or a drive."""

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Read a case from a TOML file; files that it names are relative to its folder."""
        return cls.of_file(read_toml(path), Path(path))

    @classmethod
    def of_file(cls, table: dict[str, Any], path: Path) -> Self:
        """Make a case from the tables of the file at a path."""
        raise NotImplementedError

    def to_dict(self) -> dict[str, Any]:
        """Return the given values as nested tables in SI units; InputError for many points or own laws."""
        self._check_file()
        return self.plain_tables()

    def _check_file(self) -> None:
        """Raise an InputError if a file cannot contain the case; no error by default."""

    def plain_tables(self) -> dict[str, Any]:
        """Return all values that a file can contain as nested tables, in SI units."""
        if arrays := self.arrays():
            raise InputError(
                next(iter(arrays)),
                got="an array",
                takes="a number; single(index) gives the values of a point",
            )
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Return the case as TOML text, which ``from_toml`` reads back to an equal case."""
        self._check_file()
        return self.toml_text()

    def described_toml(self) -> str:
        """Return the case as TOML text for a report, also of a case that no file can contain."""
        return self.to_toml()

    def toml_text(self, **further: Any) -> str:
        """Return the values that a file can contain as TOML text, with further tables."""
        import tomli_w

        table = self.plain_tables() | further
        # A rotational speed without a unit is refused in a file.
        for within, key in self._speeds(table):
            value = within[key]
            listed = isinstance(value, list)
            within[key] = [f"{item!r} {ROTATION}" for item in value] if listed else f"{value!r} {ROTATION}"
        return tomli_w.dumps(table)

    def _speeds(self, table: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:  # noqa: ARG002
        """Tables that hold a rotational speed or a list of them, each with its key; none by default."""
        yield from ()


def by_table(values: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    """Values of dotted keys: of a table itself, and of each table within it by its name.

    Examples
    --------
    >>> by_table({"title": "A", "bearing.base": "6208"})
    ({'title': 'A'}, {'bearing': {'base': '6208'}})
    """
    direct: dict[str, Any] = {}
    within: dict[str, dict[str, Any]] = {}
    for key, value in values.items():
        first, _, rest = key.partition(".")
        if rest:
            within.setdefault(first, {})[rest] = value
        else:
            direct[first] = value
    return direct, within


def _frozen(name: str) -> InputError:
    """Error of an assignment to a key of a table."""
    return InputError.worded(name, "cannot be assigned: a case is frozen; its replace returns a changed copy")


def read_toml(path: str | Path) -> dict[str, Any]:
    """Read the nested tables of a TOML file. Raises InputError if the file cannot be read or is not TOML."""
    return tables_of_text(read_text(path), path)


def tables_of_text(text: str, name: object) -> dict[str, Any]:
    """Nested tables of a text in TOML, which errors name as the file ``name``. Raises InputError if the text
    is not TOML.
    """
    try:
        refuse_long_keys(text)
        table = tomli.loads(text)
        refuse_deep(table)
    except InputError as error:
        raise InputError(name, str(error)) from None
    except tomli.TOMLDecodeError as error:
        raise InputError(name, f"is not TOML, {_syntax(str(error), text)}") from None
    except (ValueError, RecursionError):
        raise InputError(name, "is not TOML that can be read, some value is too long or too deep") from None
    return table


# Place in the message of tomli, and numbers in a line of TOML that stand without quotes.
_PLACE = re.compile(r"\(at line (\d+), column \d+\)")
_QUOTED = re.compile(r'"[^"]*"|\'[^\']*\'')
_COMMA_NUMBER = re.compile(r"=\s*([-+]?\d+,\d+\b[^,\]#]*)")
_UNIT_NUMBER = re.compile(
    r"[=\[,]\s*([-+]?\d[\d.]*(?:[eE][-+]?\d+)?\s*(?:[^\W\d_]|[°%/\u2100-\u214f\u3300-\u33ff])[^,\]#]*)"
)


def _syntax(message: str, text: str) -> str:
    """Message of tomli about a text, with the wrong line and, for a number, how to write it."""
    place = _PLACE.search(message)
    lines = text.splitlines()
    if place is None or not (line := " ".join(lines[int(place[1]) - 1].split())):
        return short(message)
    bare = _QUOTED.sub('""', line)
    comma, unit = _COMMA_NUMBER.search(bare), _UNIT_NUMBER.search(bare)
    if comma is not None:
        value = short(comma[1].strip().replace(",", "."))
        quoted = f'"{value}"' if re.search(r"[^\d.]", value) else value
        return f"line {place[1]} is {shown(line)}: decimal comma, write {quoted}"
    if unit is not None:
        number = short(unit[1].strip())
        return f'line {place[1]} is {shown(line)}: write a number with a unit in quotes, "{number}"'
    return f"{short(message)}: {shown(line)}"


def nearest(name: str, known: Iterable[str]) -> str:
    """Known name that is most similar to ``name``, of which the first 100 characters count."""
    return difflib.get_close_matches(name[:100], list(known), n=1, cutoff=0.0)[0]


def first_error(error: ValidationError, model: type[Table], given: Mapping[str, Any]) -> InputError:
    """Convert a validation error of given tables to one InputError, with all that the user should correct.

    An unknown key comes before a missing key, because it is often the missing key with a wrong name.
    """
    # A default that is made from other keys says nothing in addition to the errors of these keys.
    details = [detail for detail in error.errors() if detail["type"] != "default_factory_not_called"]
    details.sort(key=lambda detail: detail["type"] != "extra_forbidden")
    unknown = [detail["loc"] for detail in details if detail["type"] == "extra_forbidden"]
    if len(unknown) > MOST_NAMED:
        # The search for keys that were meant takes milliseconds for each.
        places = ([part + 1 if isinstance(part, int) else part for part in loc] for loc in unknown)
        first, *others = (".".join(map(str, loc)) for loc in islice(places, MOST_NAMED))
        named = ", ".join(map(short, others))
        text = f"unknown key, one of {len(unknown)} in this file; the next are {named}"
        return InputError.worded(first, text)
    return InputError.together([_numbered(_error(detail, model, given), detail, model) for detail in details])


def _numbered(error: InputError, detail: ErrorDetails, model: type[Table]) -> InputError:
    """Error whose key has the number of its table in a list, as ``bearing.3.at``, if the model numbers it."""
    name, number = (*detail["loc"], None, None)[:2]
    if name not in model._numbered or not isinstance(number, int):
        return error
    if error.several:
        return InputError.together([_numbered(each, detail, model) for each in error.several])
    return error.with_text(f"{name}.{number + 1}{(error.key or '').removeprefix(str(name))}", error.text)


def details_of(error: ValidationError) -> list[InitErrorDetails]:
    """Errors in a validation error, from which another one can be made."""
    return [
        InitErrorDetails(
            type=detail["type"], loc=detail["loc"], input=detail["input"], ctx=detail.get("ctx", {})
        )
        for detail in error.errors()
    ]


def _error(detail: ErrorDetails, model: type[Table], given: Mapping[str, Any]) -> InputError:
    # The number of an item in a list is omitted, because it does not help the user.
    key = ".".join(_shown_key(part) for part in detail["loc"] if isinstance(part, str))
    value = shown(detail["input"])
    match detail["type"]:
        case "extra_forbidden":
            return _unknown(key, model, given)
        case "missing" if isinstance(detail["loc"][-1], str):
            return _missing(key, model, detail["input"])
        case "value_error":
            # The error of a quantity has no key, and the error of a table lacks the name of the table.
            wrong = detail["ctx"]["error"]
            return (wrong if isinstance(wrong, InputError) else InputError(str(wrong))).under(key)
        case "literal_error":
            return InputError(key, got=value, takes=detail["ctx"]["expected"])
        case "model_type" | "model_attributes_type" | "dict_type":
            named = name_key(key, model) != key
            takes = "a table, or a name of the library as a string" if named else "a table"
            return InputError(key, got=value, takes=takes)
        case "string_type":
            return InputError(key, got=value, takes="a string")
        case "missing" | "tuple_type" | "too_long" | "too_short":
            kind = (
                f"tables, each headed [[{key}]]" if _kind(key, model) == "table" else "a list of two numbers"
            )
            return InputError(key, got=value, takes=kind)
    return InputError(key, got=f"{value}, {detail['msg']}")


def _missing(key: str, model: type[Table], given: Any) -> InputError:
    """Error of a required key, with the values that it takes."""
    field = field_within(model, key)
    sign = model.missing_table_hint(key, given) if isinstance(given, Mapping) else ""
    return InputError.missing(key, _takes(key, field, model) + sign)


def _takes(key: str, field: FieldInfo | None, model: type[Table]) -> str:
    """Values that a required key takes."""
    if _kind(key, model) == "table" or field is None or get_origin(field.annotation) is Mapping:
        return "a table"
    if get_origin(field.annotation) is Literal:
        return f"one of {', '.join(map(repr, get_args(field.annotation)))}"
    for part in field.metadata:
        # Amounts, whole numbers and names of laws say what they take.
        if takes := getattr(part, "takes", None):
            return str(takes)
    return "a text" if field.annotation is str else "a list"


def _unknown(key: str, model: type[Table], given: Mapping[str, Any]) -> InputError:
    """Error of an unknown key: advice for a key that users look for, else the nearest known key."""
    advice = advice_for(key, model)
    return (
        InputError.worded(key, f"unknown key; {advice}")
        if advice
        else InputError.unknown(key, nearest_key(key, model, given))
    )


def advice_for(key: str, model: type[Table]) -> str | None:
    """Advice for an unknown key, of the table or of one within it, such as a bearing in a drive."""
    first, _, rest = key.partition(".")
    field = model.known_keys().get(first)
    inner = None if field is None else table_of(field.annotation)
    return ADVICE.get((model.BOOK, key)) or (None if inner is None else ADVICE.get((inner.BOOK, rest)))


def _shown_key(key: str) -> str:
    """Key as the user wrote it; quoted and shortened if it is long or not printable."""
    return key if key and key.isprintable() and len(key) <= 60 else shown(key)


# Similarity of two names from which one may be a slip of the other, and letters of a name that begins others.
_SIMILAR, _LEAST_LETTERS = 0.65, 3


def nearest_key(key: str, model: type[Table], given: Mapping[str, Any] = MappingProxyType({})) -> str:
    """Known keys that an unknown key may mean, as a text of a message, empty without one; see ``meant``."""
    return any_of(meant(key, model, given))


def any_of(keys: Sequence[str]) -> str:
    """Keys as a text of a message.

    Examples
    --------
    >>> any_of(["a", "b", "c"])
    'a, b or c'
    """
    if not keys:
        return ""
    *first, last = keys
    return f"{', '.join(first)} or {last}" if first else last


def meant(key: str, model: type[Table], given: Mapping[str, Any] = MappingProxyType({})) -> list[str]:
    """Known keys that an unknown key may mean, and that a file with the given tables can use.

    Keys of ``aliases`` come first, then a key with the same name in another table, then the most similar
    key in the same table. The list is empty if no key is similar, because a wrong hint is worse than none.
    """
    unused = model.unused_keys(given) if given else ()
    return similar_keys(key, [name for name in fields_within(model) if name not in unused])


def similar_keys(key: str, known: Sequence[str]) -> list[str]:
    """Keys of a list of known ones that an unknown key may mean; see ``meant``.

    Examples
    --------
    >>> similar_keys("duty.path", ["duty.file"]), similar_keys("duty.speed", ["duty.file"])
    (['duty.file'], [])
    """
    table, _, leaf = key.rpartition(".")
    for before, name in (("", key), tuple(key.partition(".")[::2])):
        prefix = f"{before}." if before else ""
        alias = [prefix + other for other in aliases().get(name.lower(), ()) if prefix + other in known]
        if alias:
            return alias
    return _nearest_of(key, table, leaf, known)


def _nearest_of(key: str, table: str, leaf: str, known: Sequence[str]) -> list[str]:
    """Known key with the same name as an unknown key in another table, else the most similar one, if any."""
    elsewhere = [name for name in known if name.rpartition(".")[2] == leaf]
    if elsewhere:
        return elsewhere[:1]
    inside = {name.rpartition(".")[2]: name for name in known if name.rpartition(".")[0] == table}
    begun = [begin for begin in inside if len(leaf) >= _LEAST_LETTERS and begin.startswith(leaf)]
    close = difflib.get_close_matches(leaf[:100], [*inside], n=1, cutoff=_SIMILAR)
    if begun or close:
        return [inside[name] for name in (close or begun)[:1]]
    # The name of the table may be wrong.
    return [] if table in known else difflib.get_close_matches(key[:100], list(known), n=1, cutoff=_SIMILAR)


def fields_within(model: type[Table], prefix: str = "") -> dict[str, FieldInfo]:
    """Fields of a table and of the tables in it, by dotted key."""
    fields: dict[str, FieldInfo] = {}
    for name, field in model.known_keys().items():
        fields[prefix + name] = field
        inner = table_of(field.annotation)
        if inner is not None:
            fields |= fields_within(inner, f"{prefix}{name}.")
    return fields


def field_within(model: type[Table], key: str) -> FieldInfo | None:
    """Field of a dotted key of a table or of the tables in it; None for an unknown key.

    Numbers of a list have its key with their place from 1, as ``gear.flank_ra.1``.
    """
    inner: type[Table] | None = model
    field: FieldInfo | None = None
    for name in key.split("."):
        field = item_of(field, name) if inner is None else inner.known_keys().get(name)
        inner = None if field is None else table_of(field.annotation)
    return field


def item_of(field: FieldInfo | None, place: str) -> FieldInfo | None:
    """Field of a number of both gears at a place, as "1" for gear 1; None where the field is no such list."""
    annotation = None if field is None else annotation_of(field)
    if not isinstance(annotation, Amounts) or not annotation.numbered or place not in ("1", "2"):
        return None
    return FieldInfo.from_annotation(Annotated[float, annotation.each])  # type: ignore[arg-type]


def name_key(key: str, model: type[Table]) -> str:
    """Dotted key of the name that a text stands for: for a table, the key in it; otherwise the same key.

    Examples
    --------
    >>> from ehlectric.cases.case import Case
    >>> name_key("lubricant", Case), name_key("grid", Case), name_key("title", Case)
    ('lubricant.base', 'grid', 'title')
    """
    inner: type[Table] | None = model
    for name in key.split("."):
        field = None if inner is None else inner.model_fields.get(name)
        inner = None if field is None else table_of(field.annotation)
    return key if inner is None or not inner.NAMED_BY else f"{key}.{inner.NAMED_BY}"


def with_name_keys(changes: Mapping[str, Any], model: type[Table]) -> dict[str, Any]:
    """Values by dotted key, in which a name of the library that stands for a table is a key of it. Raises
    InputError if a name is also given by its own key.

    Examples
    --------
    >>> from ehlectric.cases.case import Case
    >>> with_name_keys({"lubricant": "paper", "title": "A"}, Case)
    {'lubricant.base': 'paper', 'title': 'A'}
    """
    keys: dict[str, Any] = {}
    for key, value in changes.items():
        name = name_key(key, model) if isinstance(value, str) else key
        if name != key and name in changes:
            raise InputError.worded(name, f"is given twice, also as {key}", takes="one of the two")
        keys[name] = value
    return keys


def opened_names(tables: Mapping[str, Any], model: type[Table]) -> dict[str, Any]:
    """Nested tables, in which a name of the library that stands for a table is the key of this table.

    Examples
    --------
    >>> from ehlectric.cases.case import Case
    >>> opened_names({"contact": {"body_1": "steel"}, "title": "A"}, Case)
    {'contact': {'body_1': {'material': 'steel'}}, 'title': 'A'}
    """
    opened = dict(tables)
    for key, value in tables.items():
        field = model.model_fields.get(key)
        inner = None if field is None else table_of(field.annotation)
        if inner is not None:
            table = inner.of_name(value)
            opened[key] = opened_names(table, inner) if isinstance(table, Mapping) else table
    return opened


def _kind(key: str, model: type[Table]) -> str:
    """Kind of a key: "table" or "value"."""
    return "table" if any(name.startswith(key + ".") for name in fields_within(model)) else "value"


def parser_of(field: FieldInfo, key: str) -> Callable[..., Table]:
    """Function that makes a table of one value by the rules of a field, under the last part of its key."""
    annotation = Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation
    keys: Any = {leaf_of(key): (annotation, ...)}
    model: type[Table] = create_model("Value", __base__=Table, **keys)
    return partial(_parsed, model, key)


def _parsed(model: type[Table], key: str, value: object, *, written: bool = False) -> Table:
    table, leaf = key.rpartition(".")[0], leaf_of(key)
    try:
        return model.from_written({leaf: value}) if written else model.from_dict({leaf: value})
    except InputError as error:
        if not key.endswith(leaf):
            raise error.with_text(key, error.text) from None
        raise error.under(table) if table else error from None


def leaf_of(key: str) -> str:
    """Last part of a dotted key, or a name for the place of a number in a list.

    Examples
    --------
    >>> leaf_of("gear.helix_angle"), leaf_of("gear.flank_ra.1")
    ('helix_angle', 'number')
    """
    leaf = key.rpartition(".")[2]
    return "number" if leaf.isdecimal() else leaf


def table_of(annotation: Any) -> type[Table] | None:
    """Table class in an annotation, where it may be an alternative or the item of a list; else None."""
    candidates = get_args(annotation) if get_origin(annotation) in (Union, UnionType, tuple) else [annotation]
    for candidate in candidates:
        if isinstance(candidate, type) and issubclass(candidate, Table):
            return candidate
    return None


def number_of(field: FieldInfo) -> Amount | Count | None:
    """Quantity or count of a field that is, or may be, one number; None for a text, a list or a choice.

    Examples
    --------
    >>> from ehlectric.cases.input_keys import input_field
    >>> number_of(input_field("contact.entrainment_speed")).unit
    'm/s'
    """
    annotation = None if get_origin(field.annotation) is tuple else annotation_of(field)
    if isinstance(annotation, Amounts):
        return annotation.each if annotation.single else None
    return annotation.each if isinstance(annotation, AmountOrWord) else annotation


def annotation_of(field: FieldInfo) -> Amount | Amounts | AmountOrWord | Count | None:
    """Annotation of a field that is or may be a number or a list of numbers; None for other fields."""
    parts = [field, *(part for part in get_args(field.annotation) if hasattr(part, "__metadata__"))]
    for part in parts:
        for item in getattr(part, "__metadata__", ()) or getattr(part, "metadata", ()):
            if isinstance(item, Amount | Amounts | AmountOrWord | Count):
                return item
    return None


# Longest title [characters].
LONGEST = 200

# Unicode categories that no title has: control characters, and halves of pairs, which no file can hold.
_NEVER = frozenset({"Cc", "Cs"})


def _title(text: str, info: ValidationInfo) -> str:
    """Title that is one line.

    A title that a person writes into a file has no character that is not seen either, such as one that turns
    the direction of the text: every program that shows the files of the result would obey it. Titles of
    earlier results may have such characters; they are escaped where they are shown.
    """
    written = bool(info.context and info.context.get(WRITTEN))
    if len(text) > LONGEST or any(unicodedata.category(letter) in _NEVER for letter in text):
        raise InputError(got=shown(text), takes=f"at most {LONGEST} printable characters on one line")
    hidden = next(filter(unseen, text), "") if written else ""
    if hidden:
        name = unicodedata.name(hidden, "a character without a name").lower()
        got = f"{shown(text)} with {printable(hidden)} ({name}), which is not seen"
        raise InputError(got=got, takes="a title without it")
    return text


# Title of files and figures, on one line.
Title = Annotated[str, AfterValidator(_title)]
