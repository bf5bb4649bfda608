"""Fields of the forms as data: inputs of the book, and when they are shown."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from ehlectric.app.inputs import Inputs
from ehlectric.quantities.inputs import input_at
from ehlectric.quantities.units import in_unit, rounded, si_unit, split

When = Callable[[Inputs], bool]


def always(_: Inputs) -> bool:
    """Whether a field is shown that belongs to all inputs."""
    return True


def never(_: Inputs) -> bool:
    """Whether a field is shown that appears only with a value, such as the one of an alternative."""
    return False


def _nothing(_: Inputs) -> str:
    return ""


@dataclass(frozen=True)
class Way:
    """Way to give a quantity, one of several that exclude each other.

    Attributes
    ----------
    label : str
        Name of the way in the list.
    changes : mapping
        Values by dotted key with which the way begins; None removes a key.
    key : str
        Key whose presence tells this way; empty for the way of inputs that have no other.
    value : object
        Value of the key that tells this way; None for any.
    listed : bool
        Whether the list has this way also while it is not taken.
    """

    label: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    key: str = ""
    value: Any = None
    listed: bool = True

    def taken(self, inputs: Inputs) -> bool:
        """Whether the inputs take this way."""
        if not self.key:
            return True
        found = inputs.value(self.key)
        return found is not None if self.value is None else bool(found == self.value)


@dataclass(frozen=True)
class Field:
    """Field of a form.

    Attributes
    ----------
    key : str
        Dotted key of the input file.
    label : str
        Name of the quantity.
    unit : str
        Unit of the number in the field, as the input file takes it; empty for a number without unit.
    low, high : float
        Ends of the slider, in this unit. They bound the slider only: any value that the checks allow can be
        typed.
    log : bool
        Whether the slider is spaced by logarithms.
    kind : str
        "number", "count" (a whole number), "choice", "text" or "ways".
    choices : tuple of str
        Values of a choice; empty where the library has them.
    note : str
        What a user must know beside the field.
    own : str
        Label of the entry of a choice that stands for values of one's own, without a name of the library.
    ways : tuple of Way
        Ways of a field of kind "ways". The first whose key is given is taken.
    when : callable
        Whether the field belongs to given inputs.
    strict : bool
        Whether the field is hidden when it does not belong, though its key is given.
    optional : bool
        Whether the field may be left empty.
    ignored : str
        Regular expression of the endings of a searched name that a search may leave out.
    lacks : str
        What is told where a search finds nothing; ``{count}`` is the number of entries.
    """

    key: str
    label: str
    unit: str = ""
    low: float = 0.0
    high: float = 1.0
    log: bool = False
    kind: Literal["number", "count", "choice", "text", "ways"] = "number"
    choices: tuple[str, ...] = ()
    note: str = ""
    own: str = ""
    ways: tuple[Way, ...] = ()
    when: When = always
    strict: bool = False
    optional: bool = False
    ignored: str = ""
    lacks: str = ""

    def at(self, place: float) -> float:
        """Value at a place of the slider from 0 to 1, with three digits."""
        if self.log:
            value = self.low * (self.high / self.low) ** place
        else:
            value = self.low + (self.high - self.low) * place
        value = float(f"{value:.3g}")
        return float(round(value)) if self.kind == "count" else value

    def place(self, value: float) -> float:
        """Place of a value on the slider, from 0 to 1."""
        if self.log:
            part = math.log(max(value, 1e-300) / self.low) / math.log(self.high / self.low)
        else:
            part = (value - self.low) / (self.high - self.low)
        return min(1.0, max(0.0, part))

    def from_slider(self, place: float) -> Any:
        """Value for the inputs at a place of the slider, as a person would write it."""
        value = self.at(place)
        if self.kind == "count":
            return round(value)
        if self.unit:
            return f"{rounded(value)} {self.unit}"
        return int(value) if value.is_integer() else value

    def from_text(self, text: str) -> Any:
        """Value for the inputs of a typed text; None for an empty one.

        A bare number gets the unit of the field. What is no number stays as it is, and the checks refuse it.
        """
        text = text.strip()
        if text in self.choices and text.isdecimal():
            return int(text)
        found = split(text) if self.kind in ("number", "count") else None
        if found is None or found[1]:
            return text or None
        number = found[0]
        if self.unit:
            return f"{text} {self.unit}"
        return int(number) if number.is_integer() and self.kind == "count" else number

    def text(self, value: Any) -> str:
        """Text of a value of the inputs; a bare number of a quantity is one in SI units."""
        if value is None:
            return ""
        if isinstance(value, int | float) and not isinstance(value, bool) and self.unit:
            if self.unit == "%":
                return f"{rounded(100.0 * value)} %"
            return f"{value!r} {si_unit(self.unit)}"
        return str(value)

    def number(self, value: Any) -> float | None:
        """Number of a value of the inputs in the unit of the field; None where it is not known."""
        if not self.unit:
            found = split(str(value)) if value is not None else None
            return None if found is None or found[1] else found[0]
        return in_unit(self.text(value), self.unit)

    def shown(self, inputs: Inputs) -> bool:
        """Whether the field is shown with given inputs."""
        if self.when(inputs):
            return True
        return not self.strict and self.kind != "ways" and inputs.value(self.key) is not None

    def way(self, inputs: Inputs) -> int:
        """Number of the way that the inputs take."""
        return next((place for place, way in enumerate(self.ways) if way.taken(inputs)), 0)


def field_of(key: str, **more: Any) -> Field:
    """Field of an input as the book has it; ``more`` says when it is shown, and what its list needs.

    Examples
    --------
    >>> field_of("bearing.radial_load").label, field_of("bearing.radial_load").high
    ('Radial load', 10000)
    """
    entry = input_at(key)
    if entry is None:
        raise KeyError(key)
    own = {
        "label": entry.label[0].upper() + entry.label[1:],
        "unit": entry.shown,
        "low": entry.slider[0],
        "high": entry.slider[1],
        **{name: getattr(entry, name) for name in ("log", "kind", "choices", "note", "optional")},
    }
    return Field(key, **(own | more))


def fields_of(
    keys: Iterable[str], shown: Mapping[str, Mapping[str, Any]], ways: Mapping[str, Field]
) -> tuple[Field, ...]:
    """Fields of keys in their order.

    Parameters
    ----------
    keys : iterable of str
        Keys of a group of a form.
    shown : mapping
        What ``field_of`` takes for some of the keys.
    ways : mapping
        Fields of kind "ways", by the key before which they stand.
    """
    fields: list[Field] = []
    for key in keys:
        if key in ways:
            fields.append(ways[key])
        fields.append(field_of(key, **shown.get(key, {})))
    return tuple(fields)


@dataclass(frozen=True)
class Group:
    """Fields under one heading.

    Attributes
    ----------
    title : str
        Heading.
    fields : tuple of Field
        Fields in their order.
    opened : bool
        Whether the group is open at first.
    table : str
        Table that the group switches on and off; empty for a group that is always on.
    start : mapping
        Values of the table when it is switched on.
    note : str
        What a user must know about the group, such as that its first values are assumptions.
    tells : callable
        Sentence on given inputs, such as on values that hold where none are given; may be empty.
    copies : str
        Table whose values the table has when it is first switched on, in place of ``start``.
    when : callable
        Whether the group belongs to given inputs.
    """

    title: str
    fields: tuple[Field, ...]
    opened: bool = True
    table: str = ""
    start: Mapping[str, Any] = field(default_factory=dict)
    note: str = ""
    tells: Callable[[Inputs], str] = _nothing
    copies: str = ""
    when: When = always
