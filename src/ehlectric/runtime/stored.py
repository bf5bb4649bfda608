"""Stored form of dataclasses: the metadata of a field say how a file holds its values.

An array is a variable of a NetCDF file, a number is in an attribute. A ``Part`` of a
file has the fields of one class: it writes them, checks them and reads them.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from operator import attrgetter
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.quantities.field_metadata import Stored, arrays_of, rules_of_numbers
from ehlectric.quantities.result_warnings import (
    CODES_OF_TEXTS,
    TEXTS,
    ResultWarning,
    texts_and_codes,
    warnings_of,
)
from ehlectric.runtime.file_rules import (
    VALUES,
    Rule,
    UnfitError,
    check_variables,
    is_list,
    is_number,
    is_table,
    is_text,
    json_of,
    unfit_error,
)
from ehlectric.runtime.files import plain

if TYPE_CHECKING:
    import xarray as xr

_EMPTY: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Part:
    """Variables of a file that hold the fields of one class."""

    kind: type[Any]  # dataclass whose fields have metadata of ``stored``
    # Dimensions over which the file contains many objects of the class; empty for one object.
    over: tuple[str, ...] = ()
    prefix: str = ""  # first letters of the names of variables that have none of their own
    # Dimensions instead of a name in the metadata.
    axes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    # Options that differ from the metadata, by the name of the field.
    changed: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    @cached_property
    def fields(self) -> dict[str, Stored]:
        """Variable of each field by the name of the field."""
        return {name: self._placed(name, entry) for name, entry in arrays_of(self.kind).items()}

    def _placed(self, name: str, entry: Stored) -> Stored:
        entry = replace(entry, **self.changed.get(name, _EMPTY))
        named_axes = [axis for dim in entry.dims for axis in self.axes.get(dim, (dim,))]
        dims = (*(() if entry.count else self.over), *named_axes)
        return replace(entry, name=entry.name or self.prefix + name, dims=dims)

    @property
    def rules(self) -> dict[str, Rule]:
        """Rules for the variables by their names."""
        rules = {}
        for entry in self.fields.values():
            needed = entry.needed and not entry.count
            rules[entry.name] = Rule(entry.dims, entry.rule, entry.unit, needed=needed)
            if entry.count:
                rules[entry.count] = Rule(self.over, "whole", needed=entry.needed)
        return rules

    def written(self, objects: Any) -> dict[str, Any]:
        """Variables of an object, or of nested lists of them, in the form that xarray expects.

        A field that is None has no variable, and neither have values without a length.
        """
        variables: dict[str, Any] = {}
        for name, entry in self.fields.items():
            values = _mapped(objects, attrgetter(name))
            if values is None and not entry.unknown:
                continue
            if entry.count:
                variables[entry.count] = (self.over, np.array(_mapped(values, len)))
                values = np.concatenate(list(_leaves(values)))
                if not len(values):
                    continue
            kind = entry.dtype or ("f8" if entry.unknown else None)
            variables[entry.name] = (entry.dims, np.array(values, dtype=kind), entry.attributes)
        return variables

    def check(self, thing: Any) -> None:
        """Check the values of one object by the rules of its variables; raises an UnfitError."""
        for name, entry in self.fields.items():
            value = getattr(thing, name)
            if value is not None and not VALUES[entry.rule](np.atleast_1d(value)):
                raise unfit_error(entry.name, np.asarray(value), entry.rule)

    def read(self, values: Mapping[str, Array], *at: int) -> dict[str, Any]:
        """Arguments of the class for the object at some place, without those that a file does not have."""
        fields_read: dict[str, Any] = {}
        for name, entry in self.fields.items():
            if entry.count:
                fields_read[name] = _part(values, entry, at)
            elif entry.name in values:
                fields_read[name] = _value(entry, values[entry.name][at])
        return fields_read


def values_of(dataset: xr.Dataset) -> dict[str, Array]:
    """Values of all variables of a dataset by their names."""
    return {str(name): np.asarray(variable.values) for name, variable in dataset.variables.items()}


def check_parts(
    dataset: xr.Dataset,
    parts: Sequence[Part],
    further: Mapping[str, Rule] = MappingProxyType({}),
    least: Mapping[str, int] = MappingProxyType({}),
) -> None:
    """Check the variables of the parts of a file, and further ones; raises an UnfitError.

    ``least`` has the smallest size of dimensions; of others it is 1.
    """
    rules = {name: rule for part in parts for name, rule in part.rules.items()}
    check_variables(dataset, {**rules, **further}, least)
    for entry in (entry for part in parts for entry in part.fields.values() if entry.count):
        total = int(np.sum(dataset[entry.count].values)) if entry.count in dataset else 0
        if total != dataset.sizes.get(entry.dims[0], 0):
            raise UnfitError(f"{entry.count} is not the number of values along {entry.dims[0]}")
        if total and entry.name not in dataset:
            raise UnfitError(f"{entry.name} is missing")


def numbers_of(thing: Any) -> str:
    """Numbers of an object as the JSON text of an attribute."""
    return json.dumps(_numbers(thing))


def many_numbers_of(things: Iterable[Any]) -> str:
    """Numbers of objects of a class as the JSON text of an attribute, a list."""
    return json.dumps([_numbers(thing) for thing in things])


def _numbers(thing: Any) -> dict[str, Any]:
    """Numbers and texts of an object; None instead of NaN, which JSON does not have."""
    numbers: dict[str, Any] = plain({name: getattr(thing, name) for name in rules_of_numbers(type(thing))})
    return numbers


def read_numbers(kind: type[Any], attributes: Mapping[Any, Any], name: str) -> dict[str, Any]:
    """Numbers of an object of a class in an attribute of a file; raises an UnfitError.

    A number that may be null may also be missing.
    """
    numbers: dict[str, Any] = json_of(attributes, name, _is_object_of(kind))
    return numbers


def read_many_numbers(kind: type[Any], attributes: Mapping[Any, Any], name: str) -> list[dict[str, Any]]:
    """Numbers of objects of a class in an attribute of a file, a list; raises an UnfitError."""
    rows: list[dict[str, Any]] = json_of(attributes, name, partial(is_list, right=_is_object_of(kind)))
    return rows


def _is_object_of(kind: type[Any]) -> Callable[[Any], bool]:
    """Whether a value of JSON has the numbers of an object of a class."""
    rules = rules_of_numbers(kind)
    checks: dict[str, Callable[[Any], bool]] = {key: partial(_fits, rule=rule) for key, rule in rules.items()}
    optional = {key: check for key, check in checks.items() if check(None)}
    needed = {key: check for key, check in checks.items() if key not in optional}
    return partial(is_table, columns=needed, others=optional)


def warnings_as_attributes(warnings: Iterable[ResultWarning]) -> dict[str, str]:
    """Attributes of a NetCDF file for warnings: texts and codes, each as JSON."""
    return {name: json.dumps(values) for name, values in texts_and_codes(warnings).items()}


def warnings_in(attributes: Mapping[Any, Any]) -> tuple[ResultWarning, ...]:
    """Warnings in the attributes of a NetCDF file; raises an UnfitError where they are no warnings."""
    texts = partial(is_list, right=is_text)
    return _warnings({name: json_of(attributes, name, texts) for name in (TEXTS, CODES_OF_TEXTS)})


def warnings_in_tables(attributes: Mapping[Any, Any], depth: int = 1, name: str = TEXTS) -> Any:
    """Lists of warnings, nested to some depth, in one attribute of a file; raises an UnfitError."""
    texts = partial(is_list, right=is_text)
    right: Callable[[Any], bool] = partial(is_table, columns={TEXTS: texts, CODES_OF_TEXTS: texts})
    for _ in range(depth):
        right = partial(is_list, right=right)
    return _mapped(json_of(attributes, name, right), _warnings)


def _warnings(table: Mapping[str, Any]) -> tuple[ResultWarning, ...]:
    if len(table[TEXTS]) != len(table[CODES_OF_TEXTS]):
        raise UnfitError(f"{CODES_OF_TEXTS} is not as it was written")
    return warnings_of(table)


def _fits(value: Any, rule: str | tuple[str, ...]) -> bool:
    """Whether a value of JSON is as the rule of ``number`` says."""
    if isinstance(rule, tuple) or rule == "text":
        return isinstance(value, str) and (rule == "text" or value in rule)
    if rule == "truth":
        return isinstance(value, bool)
    if value is None:
        return rule.endswith(" or null")
    return is_number(value, rule.removesuffix(" or null"))


def _mapped(things: Any, function: Callable[[Any], Any]) -> Any:
    """Nested lists with the result of a function instead of each item."""
    if isinstance(things, list | tuple):
        return [_mapped(thing, function) for thing in things]
    return function(things)


def _leaves(things: Any) -> Iterator[Any]:
    if isinstance(things, list | tuple):
        for thing in things:
            yield from _leaves(thing)
    else:
        yield things


def _value(entry: Stored, value: Any) -> Any:
    """Convert the value of a variable to the value of its field: Python numbers, boolean masks."""
    if entry.rule == "0 or 1":
        value = value.astype(bool)
    elif entry.rule == "0 to 1":
        value = np.clip(value, 0.0, 1.0)
    value = value.item() if value.ndim == 0 else value
    return None if entry.unknown and np.ndim(value) == 0 and np.isnan(value) else value


def _part(values: Mapping[str, Array], entry: Stored, at: tuple[int, ...]) -> Array:
    """Values of one of the arrays that follow each other in a variable; none where the file contains none."""
    if entry.name not in values:
        return np.zeros(0)
    counts = values[entry.count]
    before = np.ravel_multi_index(at, counts.shape)
    ends = np.concatenate([[0], np.cumsum(counts)]).astype(int)
    return values[entry.name][ends[before] : ends[before + 1]]
