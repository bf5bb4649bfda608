"""Fields and groups of the forms, the conditions under which they are shown, and the texts in their boxes."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from functools import cache
from types import MappingProxyType
from typing import Any, Literal

from ehlectric.app.catalogue import bearing
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.amounts import Amount, with_bounds
from ehlectric.cases.bearing_kinds import KEYS_OF_KINDS, KINDS_OF_BEARINGS, KindOfBearing
from ehlectric.quantities.field_help import help_text
from ehlectric.quantities.grouped_digits import certain
from ehlectric.quantities.inputs import attributes, form, input_at, key_of_list
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.units import in_unit, parts, printed, rounded, si_unit, split
from ehlectric.readable import capital


@cache
def form_data(name: str) -> Any:
    """Table or list of ``form_fields.toml`` in the book of quantities, whose head says what its parts are.

    Examples
    --------
    >>> form_data("remedies")["Grounding ring"]
    {'circuit.grounding_ring_resistance': '1 ohm'}
    """
    return data_file("ehlectric.quantities", "form_fields.toml")[name]


def kind_of(inputs: Inputs) -> str:
    """Kind of the bearing; empty where the inputs do not determine it."""
    return str(inputs.value("bearing.kind") or bearing(str(inputs.value("bearing.base"))).get("kind", ""))


def facts_of(inputs: Inputs) -> KindOfBearing | None:
    """Keys and loads of the kind of bearing; None where the inputs do not name a kind."""
    return KINDS_OF_BEARINGS.get(kind_of(inputs))


def of_kind(key: str) -> When:
    """Condition that bearings of the kind have a key of ``[bearing]``."""

    def has(inputs: Inputs) -> bool:
        facts = facts_of(inputs)
        return facts is not None and key in facts.keys

    return has


def carries(load: Literal["radial", "axial"]) -> When:
    """Condition that bearings of the kind carry radial or axial loads."""

    def carried(inputs: Inputs) -> bool:
        facts = facts_of(inputs)
        return facts is not None and bool(getattr(facts, load))

    return carried


def fitted_to_kind(inputs: Inputs) -> dict[str, Any]:
    """Changes that a bearing of another kind needs: keys it does not have, and first values of keys it lacks.

    Examples
    --------
    >>> fitted_to_kind(Inputs({"bearing": {"base": "nu-208", "axial_load": "300 N"}}))
    {'bearing.axial_load': None, 'bearing.profile': 'logarithmic', 'bearing.clearance_class': 'CN',
     'bearing.composite_rq': '0.1 um'}
    """
    # The server loads no physics before a bearing is changed.
    from ehlectric.cases.library.bearing_catalogue import NORMAL_CLASS, has_classes

    facts = facts_of(inputs)
    if facts is None:
        return {}
    known = bearing(str(inputs.value("bearing.base")))
    refused = [key for key in KEYS_OF_KINDS if key not in facts.keys]
    # Without an inner ring, the shaft decides the clearance.
    classed = has_classes(kind_of(inputs)) and known.get("inner_ring") is not False
    refused += [] if classed and "radial_clearance" in facts.keys else ["clearance_class", "fits"]
    refused += [f"{load}_load" for load in ("radial", "axial") if not getattr(facts, load)]
    given = [f"bearing.{key}" for key in refused]
    changes: dict[str, Any] = {key: None for key in given if inputs.value(key) is not None}
    for name, value in form_data("kinds")[kind_of(inputs)].items():
        key = f"bearing.{name}"
        if name == "radial_clearance" and classed and _of_a_class(kind_of(inputs), known):
            key, value = _clearance(inputs, value, NORMAL_CLASS)
        if inputs.value(key) is None and name not in known:
            changes[key] = value
    return changes


def _of_a_class(kind: str, known: Mapping[str, Any]) -> bool:
    """Whether the normal class of clearance exists for the bore of a designation, or no bore is known."""
    from ehlectric.cases.amounts import amount_at
    from ehlectric.cases.library.bearing_catalogue import NORMAL_CLASS, has_class

    bore = known.get("bore")
    return bore is None or has_class(kind, NORMAL_CLASS, amount_at("bearing.bore").parse(bore))


def _clearance(inputs: Inputs, first: str, normal: str) -> tuple[str, str]:
    """Key and value of the clearance of a kind with classes: the given one, else the normal class of a
    designation, and the first value for a geometry without a designation.
    """
    before_mounting = ("bearing.clearance_class", "bearing.fits.unmounted_clearance")
    given = next((key for key in before_mounting if inputs.value(key) is not None), None)
    if given is not None:
        return given, normal
    of_class = inputs.value("bearing.base") is not None or inputs.value("bearing.fits") is not None
    if of_class and inputs.value("bearing.radial_clearance") is None:
        return "bearing.clearance_class", normal
    return "bearing.radial_clearance", first


def first_of_kind(inputs: Inputs) -> dict[str, Any]:
    """First values of the kind of bearing by dotted key; none if the inputs do not name a kind."""
    first_values = form_data("kinds").get(kind_of(inputs), {})
    return {f"bearing.{name}": value for name, value in first_values.items()}


When = Callable[[Inputs], bool]


def always(_: Inputs) -> bool:
    """Condition of a field that belongs to all inputs."""
    return True


def never(_: Inputs) -> bool:
    """Condition of a field that is shown only where its key has a value, as one of several alternatives."""
    return False


def given(*keys: str) -> When:
    """Condition that the inputs have one of the keys."""
    return lambda inputs: any(inputs.value(key) is not None for key in keys)


def equal(key: str, *values: Any) -> When:
    """Condition that a key has one of the values; None stands for a key that is not given."""
    return lambda inputs: inputs.value(key) in values


def as_given(inputs: Inputs) -> Inputs:
    """Inputs themselves, in which a field usually looks up its value."""
    return inputs


def unequal(key: str, *values: Any) -> When:
    """Condition that a key has none of the values; None stands for a key that is not given."""
    return lambda inputs: inputs.value(key) not in values


def both(first: When, second: When) -> When:
    """Condition that two conditions hold."""
    return lambda inputs: first(inputs) and second(inputs)


@dataclass(frozen=True)
class Alternative:
    """Alternative input of a quantity, one of several that exclude each other."""

    label: str
    # Values by dotted key with which the alternative begins; None removes a key.
    changes: Mapping[str, Any] = field(default_factory=dict)
    key: str = (
        ""  # key whose presence shows that the inputs use this alternative; empty for the last of the list
    )
    value: Any = None  # value of this key with which they use it; None for any
    listed: bool = True  # whether the list also contains it while the inputs do not use it

    def taken(self, inputs: Inputs) -> bool:
        """Whether the inputs use this alternative."""
        if not self.key:
            return True
        value = inputs.value(self.key)
        return value is not None if self.value is None else bool(value == self.value)


@dataclass(frozen=True)
class Field:
    """Field of a form."""

    key: str  # dotted key of the input file
    label: str
    # Unit of the number in the field, as the input file takes it; empty for a number without unit.
    unit: str = ""
    # low and high: ends of the slider, in this unit. They bound the slider only: any value that the checks
    # allow can be typed.
    low: float = 0.0
    high: float = 1.0
    log: bool = False  # whether the slider is spaced by logarithms
    # A "flag" is true or not given.
    kind: Literal["number", "count", "choice", "text", "alternatives", "flag"] = "number"
    choices: tuple[str, ...] = ()  # values of a choice; empty where they are in the library
    note: str = ""  # what a user must know next to the field
    help: str = ""  # meaning of the input, usual values, and effects of a larger value
    # Label of the entry of a choice that stands for values of one's own, without a name of the library.
    custom_label: str = ""
    alternatives: tuple[Alternative, ...] = ()
    when: When = always  # whether the field belongs to given inputs
    strict: bool = False  # whether the field is hidden when it does not belong, though its key is given
    optional: bool = False  # whether the field may be left empty
    ignored: str = ""  # regular expression of the endings of a searched name that a search may drop
    no_match_text: str = ""  # text if a search finds nothing; ``{count}`` is the number of entries
    free: bool = False  # whether a search takes a text that no entry has
    # Inputs in which the field and its alternatives are looked up, such as with values of all bearings.
    view: Callable[[Inputs], Inputs] = as_given

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
        if self.kind == "flag":
            return True if text == "yes" else None
        if text in self.choices and text.isdecimal():
            return int(text)
        amount = split(text) if self.kind in ("number", "count") else None
        if amount is None or amount[1]:
            return text or None
        number = amount[0]
        if self.unit:
            return f"{text} {self.unit}"
        return int(number) if number.is_integer() and self.kind == "count" else number

    def text(self, value: Any) -> str:
        """Text of a value of the inputs; a bare number of a quantity is one in SI units."""
        if self.kind == "flag" and value in (None, True, False):
            return "yes" if value else "no"
        if value is None:
            return ""
        if isinstance(value, int | float) and not isinstance(value, bool) and self.unit:
            if self.unit == "%":
                return f"{rounded(100.0 * value)} %"
            return certain(f"{value!r} {si_unit(self.unit)}")
        return str(value)

    def number(self, value: Any) -> float | None:
        """Number of a value of the inputs in the unit of the field; None where it is not known."""
        if not self.unit:
            amount = split(str(value)) if value is not None else None
            return None if amount is None or amount[1] else amount[0]
        return in_unit(self.text(value), self.unit)

    def shown(self, inputs: Inputs) -> bool:
        """Whether the field is shown with given inputs."""
        inputs = self.view(inputs)
        if self.when(inputs):
            return True
        return not self.strict and self.kind != "alternatives" and inputs.value(self.key) is not None

    def alternative(self, inputs: Inputs) -> int:
        """Number of the alternative that the inputs use."""
        inputs = self.view(inputs)
        return next(
            (place for place, alternative in enumerate(self.alternatives) if alternative.taken(inputs)), 0
        )


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
    values = {
        "label": capital(entry.label),
        "unit": entry.shown,
        "low": entry.slider[0],
        "high": entry.slider[1],
        "when": never if key_of_list(key) in attributes("only_given") else always,
        "note": entry.field_note,
        "help": help_text(key),
        **{name: getattr(entry, name) for name in ("log", "kind", "choices", "optional")},
        **attributes("field").get(key, {}),
    }
    return Field(key, **(values | more))


def list_of_alternatives(entry: Mapping[str, Any], when: When = always) -> Field:
    """List of the alternative inputs of a quantity, from the book."""
    alternatives = []
    for alternative in entry["alternatives"]:
        changes = {
            key: None if value == "" else value for key, value in alternative.get("changes", {}).items()
        }
        alternatives.append(Alternative(**(alternative | {"changes": changes})))
    return Field(
        entry["key"],
        entry["label"],
        kind="alternatives",
        alternatives=tuple(alternatives),
        when=when,
        help=entry["help"],
    )


@dataclass(frozen=True)
class Group:
    """Fields under one heading."""

    title: str
    fields: tuple[Field, ...]
    opened: bool = True  # whether the group is open at first
    folds: bool = False  # whether its optional fields are folded away although some are given
    table: str = ""  # table that the group switches on and off; empty for a group that is always on
    start: Mapping[str, Any] = field(default_factory=dict)  # values of the table when it is switched on
    note: str = ""  # what a user must know about the group, such as that its first values are assumptions
    # Sentence on given inputs, such as on values that hold where none are given; may be empty.
    tells: Callable[[Inputs], str] = lambda _: ""
    copies: str = ""  # table whose values are used when this table is first switched on, instead of ``start``
    when: When = always  # whether the group belongs to given inputs


# Title of the group of the vehicle of a duty cycle, and the table of its inputs.
VEHICLE, VEHICLE_TABLE = "Vehicle", "duty.vehicle"

# Note of a group whose first values are assumptions.
_ASSUMED = "The first values are assumptions: replace them with your own."


def group_of(
    form_name: str,
    title: str,
    shown: Mapping[str, Mapping[str, Any]],
    lists: Mapping[str, When] = MappingProxyType({}),
    **more: Any,
) -> Group:
    """Group of a form of the app, each field after the lists of alternatives that precede it.

    ``shown`` has further attributes of fields by their keys, such as when a field is shown; ``lists`` has the
    condition under which each list of alternatives is shown.
    """
    fields: list[Field] = []
    for key in form(form_name)[title]:
        for entry in attributes("lists").get(key, ()):
            if entry.get("form", form_name) == form_name:
                fields.append(list_of_alternatives(entry, lists.get(key, always)))
        fields.append(field_of(key, **shown.get(key, {})))
    return Group(title, tuple(fields), **(about_group(title) | more))


def about_group(title: str) -> dict[str, Any]:
    """Attributes of a group besides its fields, such as its table, first values and note."""
    about = dict(form_data("groups").get(title, {}))
    if about.pop("assumed", False):
        about["note"] = f"{_ASSUMED} {about.get('note', '')}".strip()
    return about


# Most digits of a number in a box; one with more, such as the number of a point of a sweep, is rounded there.
_MOST_DIGITS = 8

_NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


def shown_text(field: Field, text: str) -> str:
    """Text of a number in its box: with the signs of its unit, and without digits that nobody reads.

    Examples
    --------
    >>> speed = Field("bearing.inner_speed", "Speed", "rpm", 50.0, 20000.0)
    >>> shown_text(speed, "181.37993642342187 rad/s"), shown_text(speed, "300 rad/s")
    ('1732.0508 rpm', '300 rad/s')
    """
    pieces = parts(text) if field.kind == "number" and field.unit else None
    if pieces is None or not pieces[1]:
        return text
    written = pieces[0]
    number = in_unit(text, field.unit)
    if number is not None and sum(letter.isdigit() for letter in written.split("e")[0]) > _MOST_DIGITS + 2:
        return certain(f"{rounded(number, _MOST_DIGITS)} {printed(field.unit)}")
    return f"{written} {printed(pieces[1])}"


def written_text(field: Field, text: str) -> str:
    """Text as the inputs have it: the unit of the field as a keyboard writes it.

    Examples
    --------
    >>> written_text(Field("bearing.temperature", "Temperature", "degC"), "70 °C")
    '70 degC'
    """
    pieces = parts(text)
    if pieces is None or not field.unit or pieces[1] != printed(field.unit):
        return text
    return f"{pieces[0]} {field.unit}"


def _amount_at(key: str) -> Amount | None:
    """Unit and bounds of an input, from the book of inputs or the parameters of oil laws."""
    entry = input_at(key)
    if entry is not None and entry.unit:
        return with_bounds(Amount, entry)
    law = data_file("ehlectric.lubricant", "parameters.toml").get(key.rpartition("lubricant.")[2])
    return None if law is None else Amount(**{name: law[name] for name in _OF_AMOUNTS if name in law})


# Keys of the unit and bounds of an amount.
_OF_AMOUNTS = tuple(each.name for each in fields(Amount))


def in_field_unit(field: Field, text: str) -> str:
    """Text of an error with its bounds in the unit of a field.

    Examples
    --------
    >>> from ehlectric.cases.amounts import amount_at
    >>> angle = Field("gear.normal_pressure_angle", "Pressure angle", "deg", 15.0, 25.0)
    >>> in_field_unit(angle, f"got '2 deg'; expected {amount_at(angle.key).takes}")[13:107]
    'expected a number, with or without its unit, such as 20 deg, above 4.5837 deg and below 45.837'
    """
    if not field.unit or field.unit == "%":
        return text
    si, unit = si_unit(field.unit), printed(field.unit)

    def number(value: object) -> str:
        converted = in_unit(f"{value} {si}", field.unit)
        return f"{value} {si}" if converted is None else f"{rounded(converted, 5)} {unit}"

    names = "|".join(sorted({re.escape(name) for name in (si, si.replace("^", "**"))}))
    elsewhere = re.compile(rf"(?<!['\d.e+-])({_NUMBER}) (?:{names})(?![\w*^/²³])")
    amount = _amount_at(field.key)
    if amount is None:
        return text if si == field.unit else elsewhere.sub(lambda match: number(match[1]), text)
    parts_of_text = text.split(amount.takes)
    if si != field.unit:
        parts_of_text = [elsewhere.sub(lambda match: number(match[1]), part) for part in parts_of_text]
    takes = f"a number, with or without its unit, such as {rounded(field.at(0.5))} {unit}"
    return (takes + amount.bounds_text(lambda bound: number(repr(bound)))).join(parts_of_text)
