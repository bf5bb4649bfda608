"""Keys of the files of every kind, the values of nested tables by path, and other values that a key takes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, Literal, get_args, get_origin

from ehlectric.cases.axle_inputs import MountedBearing
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.table import Table, table_of

# Keys and places in lists that lead to a value of nested tables; the last place may be a column of a file.
Path = tuple[str | int, ...]

# Tables whose keys are dotted keys of the file.
_DOTTED = ("ranges", "vary", "changes")

# Tables of an axle that one of its bearings may have, too.
_OF_OIL = ("lubricant", "discharge")

# A number at the beginning of a text with a unit.
_NUMBER = re.compile(r"[-+]?\d+(\.\d*)?([eE][-+]?\d+)?(?= |$)")

# Factors of a number, and what is added to a count, of which the first that the file accepts is taken.
_FACTORS = (1.1, 0.9, 1.01, 0.99, 2.0, 0.5)
_STEPS = (1, -1, 2, -2)


def keys_of(model: type[Table], prefix: str = "") -> dict[str, Any]:
    """Annotations of the keys of a file and of the tables in it, by dotted key without places in lists."""
    fields = {name: field.annotation for name, field in model.known_keys().items()}
    if "bearings" in fields:
        fields["bearings"] = Bearing
    if model is MountedBearing:
        # The oil of one bearing has the keys of the oil of its axle.
        fields = {name: annotation for name, annotation in fields.items() if name not in _OF_OIL}
    keys: dict[str, Any] = {}
    for name, annotation in fields.items():
        of_names = get_origin(annotation) is dict
        inner = table_of(get_args(annotation)[1] if of_names else annotation)
        key = f"{prefix}{name}.*" if of_names and inner else prefix + name
        keys |= {key: annotation} if inner is None or name in _DOTTED else keys_of(inner, f"{key}.")
    return keys


def key_at(path: Path) -> str:
    """Dotted key of a path, without places in lists and names that the user chooses.

    Examples
    --------
    >>> key_at(("roughness", 0, "rq")), key_at(("ranges", "bearing.fill", 1))
    ('roughness.rq', 'ranges')
    >>> key_at(("measured", "elements", "rotor_1", "capacitance"))
    'measured.elements.*.capacitance'
    """
    names: list[str] = []
    for name in path:
        if isinstance(name, str):
            names.append("*" if names[-2:] in (["measured", "elements"], ["measured", "shafts"]) else name)
        if name in _DOTTED:
            break
    of_axle = path[0] == "bearing" and len(path) > 1 and isinstance(path[1], int)
    if of_axle and names[1] in _OF_OIL:
        return ".".join(names[1:])
    if of_axle and names[1] not in MountedBearing.model_fields:
        names[0] = "bearings"
    return ".".join(names)


def values_in(table: Any, path: Path = ()) -> Iterator[tuple[Path, Any]]:
    """Values of nested tables by path: one for each end of a list of two, and for each column of a file."""
    if isinstance(table, Mapping):
        for key, value in table.items():
            yield from values_in(value, (*path, key))
    elif isinstance(table, list) and (len(table) == 2 or isinstance(table[0], Mapping)):
        for place, value in enumerate(table):
            yield from values_in(value, (*path, place))
    elif isinstance(table, str) and "\n" in table and "[" in table:
        for place in range(table.partition("\n")[0].count(",") + 1):
            yield (*path, place), table
    else:
        yield path, table


def with_value(table: Any, path: Path, value: Any) -> Any:
    """Copy of nested tables with a value at a path; the text of a file is replaced as a whole."""
    if not path or isinstance(table, str):
        return value
    name, *rest = path
    copy: Any = [*table] if isinstance(table, list) else dict(table)
    if isinstance(copy, list) and name == len(copy):
        copy.append({})
    inner = copy.get(name) if isinstance(copy, dict) else copy[name]
    empty: Any = [] if rest and isinstance(rest[0], int) else {}
    copy[name] = with_value(empty if inner is None else inner, tuple(rest), value)
    return copy


def without_value(table: Mapping[str, Any], key: str) -> dict[str, Any]:
    """Copy of nested tables without a dotted key, and without a table that has no other key."""
    name, _, rest = key.partition(".")
    inner = without_value(table.get(name, {}), rest) if rest else {}
    return {**table, name: inner} if inner else {each: table[each] for each in table if each != name}


def merged(table: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Nested tables with changes in them."""
    copy = dict(table)
    for key, value in changes.items():
        inner = copy.get(key)
        both = isinstance(value, Mapping) and isinstance(inner, Mapping)
        copy[key] = merged(inner, value) if both else value
    return copy


def others(path: Path, value: Any, choices: tuple[Any, ...]) -> Iterator[Any]:
    """Other values of the same key; ``choices``, texts that the key may take."""
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield from (value + step for step in _STEPS)
    elif isinstance(value, float):
        yield from (value * factor for factor in _FACTORS)
    elif isinstance(value, list):
        yield from (scaled(value, factor) for factor in _FACTORS)
    elif "\n" in value and "[" in value:
        yield from (_with_column(value, int(path[-1]), factor) for factor in _FACTORS)
    elif "\n" in value:
        yield "\n".join(",".join(scaled(cell, 1.1) for cell in row.split(",")) for row in value.splitlines())
    elif _NUMBER.match(value):
        yield from (scaled(value, factor) for factor in _FACTORS)
    yield from (choice for choice in choices if choice != value)


def scaled(value: Any, factor: float) -> Any:
    """Number, list of numbers, or text of a number with its unit, times a factor; another value itself."""
    if isinstance(value, list):
        return [scaled(each, factor) for each in value]
    if isinstance(value, bool):
        return value
    if isinstance(value, int):
        return round(value * factor)
    if isinstance(value, str):
        return _NUMBER.sub(lambda number: f"{float(number[0]) * factor:.12g}", value, count=1)
    return value * factor


def _with_column(text: str, place: int, factor: float) -> str:
    """Text of a table whose numbers in a column are multiplied by a factor."""
    head, *rows = text.splitlines()
    cells = [row.split(",") for row in rows]
    changed = [
        ",".join(scaled(cell, factor) if k == place else cell for k, cell in enumerate(row)) for row in cells
    ]
    return "\n".join([head, *changed, ""])


def choices_of(annotation: Any) -> tuple[Any, ...]:
    """Values of an annotation that is or contains a literal type; none of another one."""
    if get_origin(annotation) is Literal:
        return get_args(annotation)
    return tuple(choice for part in get_args(annotation) for choice in choices_of(part))
