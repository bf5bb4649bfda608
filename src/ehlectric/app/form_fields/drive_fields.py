"""Fields of the page of a drive: source, circuit, arc and bearings, its remedies, and rules of its inputs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.catalogue import oil_title
from ehlectric.app.form_fields.bearing_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field import (
    VEHICLE,
    VEHICLE_TABLE,
    Field,
    Group,
    always,
    both,
    equal,
    form_data,
    given,
    group_of,
    unequal,
)
from ehlectric.app.form_fields.field_defaults import DRIVE_END, NON_DRIVE_END, field_at, group_at
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.axle_keys import LOADS
from ehlectric.quantities.alternatives import ALTERNATIVES, DESCRIBED, MEASURED, dotted
from ehlectric.quantities.inputs import REPLACED, form
from ehlectric.quantities.units import rounded, split

# Groups of alternatives of a drive: inputs have the keys of one row of each.
DRIVE_ALTERNATIVES = (
    *dotted("source", ((DESCRIBED, MEASURED), *ALTERNATIVES["source"])),
    *dotted("circuit", ALTERNATIVES["circuit"]),
    *dotted("breakdown", ALTERNATIVES["breakdown"]),
)

# Keys of a described source that six-step modulation has not, with first values of those that others need.
OF_CARRIER = {"switching_frequency": "10 kHz", "modulation_index": 0.9, "base_frequency": None}

SWITCHING = "source.switching_frequency"

# Title of the remedy whose frequency follows the frequency of the drive.
HALF = "Half the switching frequency"

# Usual remedies by their titles, with what they change.
PRESETS: Mapping[str, Mapping[str, Any]] = form_data("remedies")


def fitted_to_source(inputs: Inputs) -> dict[str, Any]:
    """Changes that the modulation of a described source needs.

    Examples
    --------
    >>> fitted_to_source(Inputs({"source": {"modulation": "six-step", "modulation_index": 0.9}}))
    {'source.modulation_index': None}
    """
    modulation = inputs.value("source.modulation")
    values = {key: inputs.value(f"source.{key}") for key in OF_CARRIER}
    if modulation == "six-step":
        return {f"source.{key}": None for key, value in values.items() if value is not None}
    if modulation is None:
        return {}
    lacking = (key for key, first in OF_CARRIER.items() if values[key] is None and first is not None)
    return {f"source.{key}": OF_CARRIER[key] for key in lacking}


# Buttons of the page of a bearing, with the titles of their remedies and what these assume.
BEARING_REMEDIES: Mapping[str, Mapping[str, str]] = form_data("bearing_remedies")

# Oils that the page of a bearing compares, thickest last: the first that differs from the oil of the bearing.
_OILS = ("fva-3", "mobil-shc-320")


def remedy_at_bearing(inputs: Inputs, name: str, oil: str = "") -> Mapping[str, Any] | None:
    """Title and changes of a remedy of the drive of a bearing, and what they assume; None where the bearing
    has it already, or lacks the motor that it needs. ``oil``, another oil of the library; empty for a usual
    one of higher viscosity.

    Examples
    --------
    >>> remedy_at_bearing(Inputs({"lubricant": {"base": "fva-3"}}), "Other oil")["title"]
    'Oil mobil-shc-320'
    """
    title, assumed = (BEARING_REMEDIES[name][key] for key in ("title", "assumed"))
    has = {
        "Ceramic balls": inputs.value("bearing.element_material") == "silicon-nitride",
        "Coated rings": inputs.value("bearing.coating") is not None,
        "Grounding ring": inputs.value("motor") is None,
    }
    if has.get(title):
        return None
    if title in PRESETS:
        return {"title": title, "changes": PRESETS[title], "assumed": assumed}
    present_oil = None if inputs.value("lubricant.temperature") else inputs.value("lubricant.base")
    oil = oil or next(candidate for candidate in _OILS if candidate != present_oil)
    changes = {"bearings.lubricant.base": oil}
    return {"title": f"{title} {oil}", "changes": changes, "assumed": f"{assumed} {oil_title(oil)}."}


def times(value: object, factor: float) -> str | None:
    """Multiple of a quantity as a person writes it; None where it is no number with a unit.

    Examples
    --------
    >>> times("10 kHz", 0.5), times("fast", 0.5), times(None, 2.0)
    ('5 kHz', None, None)
    """
    amount = split(str(value))
    return f"{rounded(factor * amount[0], 12)} {amount[1]}" if amount is not None and amount[1] else None


def remedies_of(inputs: Inputs) -> dict[str, Mapping[str, Any]]:
    """Changes of the remedies of a drive by their titles; what is no remedy is skipped."""
    tables = [table for table in _remedies(inputs) if isinstance(table, Mapping)]
    return {
        str(table.get("title", "")): table["changes"]
        for table in tables
        if isinstance(table.get("changes"), Mapping)
    }


def _remedies(inputs: Inputs) -> list[Any]:
    """Entries of the list of remedies; none where the inputs have no list."""
    remedies = inputs.value("remedies")
    return remedies if isinstance(remedies, list) else []


def changes_of(inputs: Inputs, title: str) -> Mapping[str, Any] | None:
    """Changes of a usual remedy; None where the inputs do not have what it changes.

    Examples
    --------
    >>> changes_of(Inputs({"source": {"switching_frequency": "10 kHz"}}), HALF)
    {'source.switching_frequency': '5 kHz'}
    """
    if title != HALF:
        return PRESETS[title]
    half = times(inputs.value(SWITCHING), 0.5)
    return None if half is None else {SWITCHING: half}


def is_applicable(inputs: Inputs, changes: Mapping[str, Any]) -> bool:
    """Whether a remedy applies to the source: a measured one has no input that describes it.

    Examples
    --------
    >>> is_applicable(Inputs({"source": {"file": "scope.csv"}}), {"source.switching_frequency": "5 kHz"})
    False
    """
    measured = inputs.value("source.file") is not None and "source.file" not in changes
    return not (measured and any(f"source.{key}" in changes for key in DESCRIBED))


def with_remedy(inputs: Inputs, title: str, changes: Mapping[str, Any]) -> list[Any]:
    """List of the remedies with a further one."""
    return [*_remedies(inputs), {"title": title, "changes": dict(changes)}]


def without_remedy(inputs: Inputs, title: str) -> list[Any]:
    """List of the remedies without remedies of a title."""
    return [
        remedy
        for remedy in _remedies(inputs)
        if not isinstance(remedy, Mapping) or str(remedy.get("title", "")) != title
    ]


def with_fitted_remedies(before: Inputs, after: Inputs) -> Inputs:
    """Inputs whose remedy with half the switching frequency follows a new frequency."""
    old, new = before.value(SWITCHING), after.value(SWITCHING)
    remedies = _remedies(after)
    # A measured source has no frequency, and the remedy then keeps the frequency of the described one.
    if old == new or new is None or not remedies:
        return after
    return after.changed(
        {"remedies": [_fitted(remedy, times(old, 0.5), times(new, 0.5)) for remedy in remedies]}
    )


def _fitted(remedy: Any, old: str | None, new: str | None) -> Any:
    """Remedy with another frequency where it had half the old one and nothing else."""
    changes = remedy.get("changes") if isinstance(remedy, Mapping) else None
    if not isinstance(changes, Mapping) or old is None or new is None or dict(changes) != {SWITCHING: old}:
        return remedy
    return {**remedy, "changes": {SWITCHING: new}}


_measured = given("source.file")
_described = equal("source.file", None)
_capacitances = equal("circuit.machine", None)
_RINGING = ("overshoot", "ringing_frequency", "ringing_time")
_SHOWN: dict[str, dict[str, Any]] = {
    **{f"source.{key}": {"when": _described} for key in DESCRIBED},
    **{f"source.{key}": {"when": _measured} for key in MEASURED},
    **{
        f"source.{key}": {"when": both(_described, unequal("source.modulation", "six-step"))}
        for key in OF_CARRIER
    },
    "source.pole_pairs": {"when": both(_described, given("source.pole_pairs"))},
    "source.fundamental_frequency": {"when": both(_described, equal("source.pole_pairs", None))},
    **{f"source.{key}": {"when": both(_described, given("source.overshoot"))} for key in _RINGING},
    **{key: {"when": _capacitances} for key in form("drive")["Machine"]},
    "circuit.grounding_ring_resistance": {"when": equal("circuit.grounding_ring_table", None)},
    "breakdown.extinction_current": {"when": given("breakdown.extinction_current")},
    "breakdown.extinction_voltage": {"when": equal("breakdown.extinction_current", None)},
    **{key: {"optional": False} for key in ("rotor.mass", "rotor.mass_at")},
}
_LISTS = {
    "source.pole_pairs": _described,
    "source.overshoot": _described,
    "circuit.grounding_ring_resistance": given("circuit.grounding_ring_table"),
}
_CONDITIONS = {"Geometry of the machine": given("circuit.machine"), VEHICLE: given(VEHICLE_TABLE)}


_OF_DRIVE = tuple(
    group_of("drive", title, _SHOWN, _LISTS, when=_CONDITIONS.get(title, always)) for title in form("drive")
)


# Group of the rotor, and the most forces that a page shows.
ROTOR = "Weight and forces of the rotor"
MOST_FORCES = 8


def force_title(number: int) -> str:
    """Title of the group of a force."""
    return f"Force {number}"


def force_fields(number: int) -> Iterator[Field]:
    """Fields of a force by its number from 1, in a drive or an axle; first the shaft, which a drive lacks."""
    for field in group_of("axle", "Force", {}).fields:
        yield replace(field, key=f"force.{number}.{field.key.removeprefix('axle.force.')}")


def forces_of(inputs: Inputs) -> list[Any]:
    """Tables of the forces of a drive or an axle; none where the inputs have no list."""
    forces = inputs.value("force")
    return forces if isinstance(forces, list) else []


def with_rotor_force(inputs: Inputs) -> Inputs:
    """Inputs of a drive with a further force on its rotor, up to the number that a page shows."""
    if len(forces_of(inputs)) >= MOST_FORCES:
        return inputs
    return inputs.changed({"force": [*forces_of(inputs), form_data("first_values")["rotor_force"]]})


def _force_group(number: int) -> Group:
    """Group of a force on the rotor of a drive, which belongs to inputs that have this force."""
    _, *fields = force_fields(number)
    return Group(force_title(number), tuple(fields), when=lambda inputs: len(forces_of(inputs)) >= number)


# Loads of a bearing in the table of its ranges.
_RANGED = tuple(f"bearing.{load}" for load in LOADS)


def with_loads(before: Inputs, after: Inputs) -> Inputs:
    """Inputs of a drive whose bearings have loads, except with a rotor from which their loads follow.

    Examples
    --------
    >>> given = Inputs({"drive_end": {"bearing": {"base": "6208", "radial_load": "2 kN"}}})
    >>> rotor = with_loads(given, given.changed({"rotor.mass": "9 kg"}))
    >>> rotor.value("drive_end.bearing.radial_load")
    >>> with_loads(rotor, rotor.changed({"rotor": None})).value("drive_end.bearing.radial_load")
    '1000 N'
    """
    had, has = (inputs.value("rotor") is not None for inputs in (before, after))
    ends = [end for end in (DRIVE_END, NON_DRIVE_END) if after.value(f"{end}.bearing") is not None]
    keys = [f"{end}.bearing.{load}" for end in ends for load in LOADS]
    ranged = {end: after.value(f"{end}.ranges") for end in ends}
    if has:
        dropped: dict[str, Any] = dict.fromkeys(key for key in keys if after.value(key) is not None)
        for end, ranges in ranged.items():
            kept = {key: each for key, each in (ranges or {}).items() if key not in _RANGED}
            dropped |= {f"{end}.ranges": kept or None} if ranges and kept != ranges else {}
        dropped |= _without_remedies(after, lambda key: key.endswith(_RANGED))
        return after.changed(dropped) if dropped else after
    if had:
        first = form_data("first_values")["bearing_load"].items()
        loads = {f"{end}.{key}": load for end in ends for key, load in first}
        lacking = {key: load for key, load in loads.items() if after.value(key) is None}
        gone = _without_remedies(after, lambda key: key.startswith(("rotor.", "force.")))
        return after.changed({"force": None} | lacking | gone)
    return after


def _without_remedies(inputs: Inputs, changes: Callable[[str], bool]) -> dict[str, Any]:
    """Change that removes remedies with some keys; empty if no remedy has such a key."""
    remedies = _remedies(inputs)
    kept = [each for each in remedies if not any(map(changes, each.get("changes", {})))]
    return {"remedies": kept or None} if len(kept) < len(remedies) else {}


def _fields_at(group: Group, end: str) -> Iterator[Field]:
    """Fields of a bearing at one end; those that the drive replaces are hidden where it gives them."""
    for field in group.fields:
        if field.key in REPLACED:
            yield field_at(field, end, when=equal(REPLACED[field.key], None), strict=True)
        elif field.key.removeprefix("bearing.") in LOADS:
            placed = field_at(field, end)
            yield replace(placed, when=both(placed.when, equal("rotor", None)))
        elif field.key != "discharge.peak_current":
            # The simulation computes the current of a discharge.
            yield field_at(field, end)


# Titles of the groups of a bearing in a drive, whose circuit has the capacitances of the motor.
_TITLES = {
    "Bearing": "bearing",
    "Operation": "load",
    "Oil": "oil",
    "Films": "films",
    "Clearance": "clearance",
    "Breakdown": "strength of the oil",
    "Insulating coating": "coating",
    "Summits of the roughness": "summits",
}
_OPENED = ("Bearing", "Operation")

# Groups of the page of a bearing by their titles.
_OF_BEARING = {group.title: group for group in BEARING_GROUPS}


def _bearing(end: str, name: str) -> Iterator[Group]:
    """Groups of the bearing at an end; a drive needs a strength, so that its group is always on."""
    for bearing_title, words in _TITLES.items():
        group = _OF_BEARING[bearing_title]
        title, fields = f"{name}: {words}", tuple(_fields_at(group, end))
        opened = group.title in _OPENED and end == DRIVE_END
        placed = group_at(group, end, title, fields, opened=opened)
        if group.title == "Breakdown":
            placed = Group(title, fields, note=group.note, opened=False)
        # The other end has these groups only where it has a bearing of its own.
        yield placed if end == DRIVE_END else replace(placed, when=given(NON_DRIVE_END))


def _which(inputs: Inputs) -> str:
    if inputs.value(NON_DRIVE_END) is not None:
        return ""
    return "The bearing at the non-drive end is the same as at the drive end."


OTHER = Group(
    "Another bearing at the non-drive end",
    (),
    table=NON_DRIVE_END,
    copies=DRIVE_END,
    tells=_which,
    opened=False,
)

DRIVE_GROUPS = (
    *_OF_DRIVE,
    *_bearing(DRIVE_END, "Drive end"),
    OTHER,
    *_bearing(NON_DRIVE_END, "Non-drive end"),
    _OF_BEARING["Title"],
)


def _with_forces() -> Iterator[Group]:
    """Groups of a drive, in which forces follow the rotor."""
    for group in DRIVE_GROUPS:
        yield group
        if group.title == ROTOR:
            yield from map(_force_group, range(1, MOST_FORCES + 1))


# Groups of the page of a drive.
PAGE_GROUPS = tuple(_with_forces())
