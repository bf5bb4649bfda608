"""Fields of the page of an axle: groups by shaft, bearing, mesh and link, and rules for its inputs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from copy import deepcopy
from dataclasses import replace
from typing import Any

from ehlectric.app.form_fields.bearing_fields import BEARING_GROUPS
from ehlectric.app.form_fields.drive_fields import DRIVE_GROUPS, force_fields, force_title
from ehlectric.app.form_fields.field import (
    Field,
    Group,
    When,
    about_group,
    always,
    equal,
    field_of,
    form_data,
    group_of,
    kind_of,
)
from ehlectric.app.form_fields.field_defaults import field_at
from ehlectric.app.form_fields.gear_fields import GEAR_GROUPS
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.axle_keys import ADJUSTED, HOUSING, element_keys, shaft_keys
from ehlectric.cases.bearing_kinds import KINDS_OF_BEARINGS
from ehlectric.errors import InputError
from ehlectric.quantities.alternatives import ALTERNATIVES
from ehlectric.quantities.alternatives import MEASURED as MEASURED_SOURCE
from ehlectric.quantities.inputs import form
from ehlectric.quantities.units import in_unit, rounded

# Table of the measured values.
MEASURED = "measured"

# Lists of tables of an axle.
LISTS = ("shaft", "bearing", "mesh", "link", "force")

# Keys of a gear file that the axle replaces, without their mesh.
REPLACED_IN_GEAR_FILES = (
    *("title", "contacts", "lubricant", "discharge", "ranges"),
    *(f"gear.operation.{key}" for key in ("pinion_torque", "pinion_speed")),
)

_WITH_RESISTANCE, _WITH_CAPACITANCE = ("ring", "brush", "seal"), ("insulated",)

# Groups of the axle itself, by their titles, with the keys of the book.
AXLE_TEMPLATES = tuple(group_of("axle", title, {}) for title in form("axle"))
_TEMPLATES = {group.title: group.fields for group in AXLE_TEMPLATES}
_OF_BEARING = {field.key: field for group in BEARING_GROUPS for field in group.fields}
# Resistance of a mesh in its gear file, which the table of the mesh replaces.
_CONTACT = "gear.contact.contact_resistance"
_OF_GEAR = {
    field.key: field
    for group in GEAR_GROUPS
    if group.title in ("Gear pair", "Flanks", "Electrical contact", "Operation")
    for field in group.fields
    if field.key not in (*REPLACED_IN_GEAR_FILES, "gear.contact.voltage", _CONTACT)
}

# Fields of a mounted bearing: always shown, and folded away until they are given.
_BEARING = (
    *("bearing.base", "bearing.clearance", "bearing.radial_clearance", "bearing.clearance_class"),
    *("bearing.way_roughness", "bearing.composite_rq", "bearing.composite_ra", "bearing.rq_over_ra"),
)
_BEARING_MORE = (
    *("bearing.profile", "bearing.element_material", "bearing.element_capacitance"),
    *("bearing.radial_load", "bearing.axial_load", "bearing.contact_resistance"),
)

# Fields of a gear pair that are shown at first.
_GEAR = (
    *("gear.normal_module", "gear.teeth.1", "gear.teeth.2", "gear.helix_angle", "gear.hand"),
    *(
        "gear.centre_distance",
        "gear.profile_shift.1",
        "gear.face_width",
        "gear.flank_ra.1",
        "gear.flank_ra.2",
    ),
    "gear.composite_rq",
)


def names_of(inputs: Inputs) -> list[str]:
    """Names of the shafts; an empty name for what is no table of a shaft."""
    return [str(shaft.get("name", "")) for shaft in _tables(inputs, "shaft")]


def _tables(inputs: Inputs, name: str) -> list[dict[str, Any]]:
    """Tables of a list; an empty one for what is no table, and none where the inputs have no list."""
    tables = inputs.value(name)
    listed = tables if isinstance(tables, list) else []
    return [table if isinstance(table, dict) else {} for table in listed]


def _pair_of(table: Mapping[str, Any], key: str) -> tuple[str, str]:
    """Both names of a mesh or a link."""
    names = table.get(key)
    both = [*map(str, names), "", ""] if isinstance(names, list) else ["", ""]
    return both[0], both[1]


def shape_of(inputs: Inputs) -> tuple[Any, ...]:
    """What the groups of an axle depend on: its shafts, and the places of its bearings, meshes and links."""
    return (
        tuple(names_of(inputs)),
        tuple(_shafts_of_bearings(inputs)),
        tuple(_pair_of(mesh, "gears") for mesh in _tables(inputs, "mesh")),
        len(_tables(inputs, "link")),
        len(_tables(inputs, "force")),
    )


def axle_groups(inputs: Inputs) -> tuple[Group, ...]:
    """Groups of an axle: operating point, each shaft with its bearings, meshes, links, inverter, machine and
    oil.
    """
    names, bearings = names_of(inputs), _tables(inputs, "bearing")
    groups = [Group("Operation", tuple(_fields("Operation", "axle.", "")))]
    for number, name in enumerate(names, 1):
        groups.append(Group(shaft_title(name), tuple(_shaft_fields(number)), opened=False))
        mounted = [n for n, bearing in enumerate(bearings, 1) if str(bearing.get("shaft", "")) == name]
        for place, n in enumerate(mounted, 1):
            groups.append(_bearing_group(n, bearing_title(place, name), names))
    lost = [n for n, bearing in enumerate(bearings, 1) if str(bearing.get("shaft", "")) not in names]
    groups += [_bearing_group(n, f"Bearing {n} without a shaft", names) for n in lost]
    groups += [_mesh_group(n, names) for n in range(1, len(_tables(inputs, "mesh")) + 1)]
    groups += [_force_group(n, names) for n in range(1, len(_tables(inputs, "force")) + 1)]
    groups += [_link_group(n, [*names, HOUSING]) for n in range(1, len(_tables(inputs, "link")) + 1)]
    return (*groups, *_OF_MACHINE)


def measured_places(inputs: Inputs) -> dict[str, dict[str, str]]:
    """Keys of elements and shafts in the table [measured], with words that follow the label of a quantity.

    Examples
    --------
    >>> axle = Inputs({"shaft": [{"name": "hollow shaft"}], "bearing": [{"shaft": "hollow shaft"}]})
    >>> measured_places(axle)["elements"]
    {'hollow_shaft_1': 'of bearing 1 of hollow shaft'}
    """
    names, bearings = names_of(inputs), _shafts_of_bearings(inputs)
    meshes = range(1, len(_tables(inputs, "mesh")) + 1)
    elements = [
        *(f"of bearing {bearings[: n + 1].count(name)} of {name}" for n, name in enumerate(bearings)),
        *(f"of {mesh_title(number).lower()}" for number in meshes),
    ]
    return {
        "elements": dict(zip(element_keys(bearings, len(meshes)), elements, strict=True)),
        "shafts": dict(zip(shaft_keys(names), names, strict=True)),
    }


def _shafts_of_bearings(inputs: Inputs) -> list[str]:
    """Name of the shaft of each bearing."""
    return [str(bearing.get("shaft", "")) for bearing in _tables(inputs, "bearing")]


def shaft_title(name: str) -> str:
    """Title of the group of a shaft."""
    return f"Shaft {name}"


def bearing_title(place: int, name: str) -> str:
    """Title of the group of a bearing, by its place on a shaft from 1."""
    return f"Bearing {place} of {name}"


def _fields(title: str, before: str, after: str) -> Iterator[Field]:
    """Fields of a template at another place."""
    for field in _TEMPLATES[title]:
        yield replace(field, key=f"{after}{field.key.removeprefix(before)}")


def _shaft_fields(number: int) -> Iterator[Field]:
    for field in _fields("Shaft", "axle.", ""):
        table, name = field.key.split(".")
        if table == "adjustment":
            yield replace(
                field,
                key=f"shaft.{number}.adjustment.{name}",
                optional=False,
                when=lambda inputs: _are_adjusted(inputs, number),
            )
        else:
            kind = "flag" if name == "rotor" else field.kind
            yield replace(field, key=f"shaft.{number}.{name}", kind=kind)


def _mounted(inputs: Inputs, number: int) -> dict[int, str]:
    """Kinds of the bearings on a shaft, by their numbers; all numbers are from 1. A kind is empty for a
    bearing that carries its axial load without a second bearing, and for an unknown one.
    """
    names, bearings = names_of(inputs), _tables(inputs, "bearing")
    kinds = {}
    for n, bearing in enumerate(bearings, 1):
        if number <= len(names) and str(bearing.get("shaft", "")) == names[number - 1]:
            alone = bearing.get("pair") is not None or bearing.get("axial_load") is not None
            kinds[n] = "" if alone else kind_of(Inputs({"bearing": bearing}))
    return kinds


def _are_adjusted(inputs: Inputs, number: int) -> bool:
    """Whether both bearings of a shaft, by its number from 1, are adjusted against each other."""
    kinds = [*_mounted(inputs, number).values()]
    return len(kinds) == 2 and len({*kinds}) == 1 and kinds[0] in ADJUSTED


def request_of_rows(inputs: Inputs, error: InputError) -> InputError:
    """Error that asks for the second of two adjusted bearings of a shaft, if only one has its designation,
    or for their preload or play with the labels of the fields; any other error itself.

    Examples
    --------
    >>> bearings = [{"base": base, "shaft": "a"} for base in ("32008", "6307")]
    >>> error = InputError("bearing.2.base", got="tapered roller and ball bearings")
    >>> request_of_rows(Inputs({"shaft": [{"name": "a"}], "bearing": bearings}), error).text
    'missing; expected a tapered roller bearing, which is adjusted against bearing 1 of a'
    """
    for number, name in enumerate(names_of(inputs), 1):
        if error.key == f"shaft.{number}.adjustment.preload" and error.is_missing:
            return InputError.missing(error.key, "a preload or an axial play; rows without play just touch")
        kinds = _mounted(inputs, number)
        inclined = [n for n, kind in kinds.items() if kind in ADJUSTED]
        if len(kinds) != 2 or "" in kinds.values() or len({*kinds.values()}) == 1 or not inclined:
            continue
        if error.key in [f"bearing.{n}.base" for n in kinds]:
            (other,) = kinds.keys() - {inclined[0]}
            against = f"bearing {[*kinds].index(inclined[0]) + 1} of {name}"
            takes = f"a {kinds[inclined[0]]} bearing, which is adjusted against {against}"
            return InputError.missing(f"bearing.{other}.base", takes)
    return error


def _fitted_to_rows(before: Inputs, after: Inputs) -> Inputs:
    """Inputs in which bearings that become adjusted against each other have an arrangement, and no locating
    bearing; other bearings have no adjustment. A new preload replaces the axial play, and the reverse.

    Examples
    --------
    >>> bearings = [{"base": base, "shaft": "a", "locating": True} for base in ("32008", "6307")]
    >>> before = Inputs({"shaft": [{"name": "a"}], "bearing": bearings})
    >>> after = fitted_axle(before, before.changed({"bearing.2.base": "32207"}))
    >>> after.value("shaft.1.adjustment"), after.value("bearing.1.locating")
    ({'arrangement': 'O'}, None)
    """
    if len(names_of(before)) != len(names_of(after)):
        return after
    changes: dict[str, Any] = {}
    for number in range(1, len(names_of(after)) + 1):
        key, kinds = f"shaft.{number}.adjustment", _mounted(after, number)
        given = after.value(key) is not None
        if _are_adjusted(after, number) and not _are_adjusted(before, number):
            flags = (f"bearing.{n}.locating" for n in kinds)
            changes |= {flag: None for flag in flags if after.value(flag) is not None}
            changes |= {} if given else {f"{key}.arrangement": "O"}
        elif given and "" not in kinds.values() and {*kinds.values()}.isdisjoint(ADJUSTED):
            changes[key] = None
            carrying = (n for n, kind in kinds.items() if KINDS_OF_BEARINGS[kind].axial)
            if not any(after.value(f"bearing.{n}.locating") for n in kinds) and (n := next(carrying, None)):
                changes[f"bearing.{n}.locating"] = True
        names = [f"{key}.{name}" for name in ("preload", "axial_play")]
        if given and None not in map(after.value, names):
            changes |= {name: None for name in names if after.value(name) == before.value(name)}
    return after.changed(changes) if changes else after


def _bearing_group(number: int, title: str, names: Iterable[str]) -> Group:
    end = f"bearing.{number}"
    mounted = {field.key.rpartition(".")[2]: field for field in _fields("Bearing", "axle.bearing", end)}
    fields = [
        replace(
            field_at(_OF_BEARING[key], end),
            optional=key in _BEARING_MORE,
            custom_label="",
            view=lambda inputs: with_common(inputs, number),
        )
        for key in (*_BEARING, *_BEARING_MORE)
    ]
    placed = [mounted["at"], replace(mounted["locating"], kind="flag")]
    shaft = replace(mounted["shaft"], kind="choice", choices=tuple(names), optional=True)
    return Group(title, (fields[0], *placed, *fields[1:], shaft), opened=False, folds=True)


def with_common(inputs: Inputs, number: int) -> Inputs:
    """Inputs in which the keys of all bearings are also keys of a bearing, by its number from 1.

    Keys of the bearing replace keys of all bearings and their alternatives.

    Examples
    --------
    >>> axle = Inputs({"bearings": {"composite_rq": "0.1 um"}, "bearing": [{}, {"composite_ra": "0.2 um"}]})
    >>> [with_common(axle, number).value(f"bearing.{number}") for number in (1, 2)]
    [{'composite_rq': '0.1 um'}, {'composite_ra': '0.2 um'}]
    """
    common = inputs.value("bearings")
    bearings = _tables(inputs, "bearing")
    if not isinstance(common, Mapping) or number > len(bearings):
        return inputs
    given = bearings[number - 1]
    replaced = {
        key
        for rows in ALTERNATIVES["bearing"]
        if any(key in given for row in rows for key in row)
        for row in rows
        for key in row
    }
    bearings[number - 1] = {key: value for key, value in common.items() if key not in replaced} | given
    return Inputs({**inputs.table, "bearing": bearings})


def _mesh_group(number: int, names: Iterable[str]) -> Group:
    of_mesh = tuple(
        replace(field, kind="choice", choices=tuple(names)) if ".gears." in field.key else field
        for field in _fields("Mesh", "axle.mesh", f"mesh.{number}")
    )
    gear = [
        replace(field_at(field, f"mesh.{number}.pair"), optional=key not in _GEAR)
        for key, field in _OF_GEAR.items()
    ]
    return Group(mesh_title(number), (*of_mesh, *gear), opened=False)


def mesh_title(number: int) -> str:
    """Title of the group of a mesh."""
    return f"Gear mesh {number}"


def _force_group(number: int, names: Iterable[str]) -> Group:
    fields = (
        replace(field, kind="choice", choices=tuple(names)) if field.key.endswith(".shaft") else field
        for field in force_fields(number)
    )
    return Group(force_title(number), tuple(fields))


def link_title(number: int) -> str:
    """Title of the group of a link."""
    return f"Link {number}"


def _link_group(number: int, nodes: Iterable[str]) -> Group:
    fields = []
    when: Mapping[str, When] = {
        "resistance": equal(f"link.{number}.kind", *_WITH_RESISTANCE),
        "capacitance": equal(f"link.{number}.kind", *_WITH_CAPACITANCE),
    }
    for field in _fields("Link", "axle.link", f"link.{number}"):
        name = field.key.split(".")[2]
        if name == "between":
            field = replace(field, kind="choice", choices=tuple(nodes))
        fields.append(replace(field, when=when.get(name, always)))
    return Group(link_title(number), tuple(fields))


def _of_drive(title: str, keys: Iterable[str], shown: Iterable[str]) -> Group:
    """Group on the page of a drive with some fields; fields that are not ``shown`` are folded away."""
    (group,) = (group for group in DRIVE_GROUPS if group.title == title)
    fields = {field.key: field for field in group.fields}
    kept = tuple(replace(fields[key], optional=key not in shown) for key in keys)
    return replace(group, fields=kept, opened=title != "Ring, choke and ground")


# Groups of the inverter, the machine and the oil.
_MACHINE = ("circuit.winding_rotor_capacitance", "circuit.rotor_frame_capacitance")
_RING = ("circuit.grounding_ring_resistance",)
_WINDING = ("circuit.winding_frame_capacitance",)
_CHOKE = ("circuit.common_mode_inductance", "circuit.common_mode_resistance")
_GROUND = (
    *("circuit.cable_capacitance", "circuit.frame_earth_capacitance", "circuit.ground_inductance"),
    "circuit.ground_resistance",
)
_SOURCE = (
    *("source.way", "source.dc_link", "source.rise_time", "source.modulation", "source.switching_frequency"),
    *("source.frequency_way", "source.pole_pairs", "source.fundamental_frequency", "source.modulation_index"),
    *("source.base_frequency", *(f"source.{key}" for key in MEASURED_SOURCE if key != "file")),
)
# Title of the group of the simulated time and its arcs, and its keys that are always shown.
SIMULATED = "Discharges over time"
_ARC_SHOWN = ("breakdown.arc_resistance", "breakdown.extinction_current", "breakdown.recovery_time")


def _simulated() -> Group:
    """Group of the simulated time and the arcs of discharges, which is switched on as a whole."""
    (arc,) = (group for group in DRIVE_GROUPS if group.title == "Arc of a discharge")
    of_time = (field_of("drive.duration"), replace(field_of("drive.seed"), optional=True))
    of_arc = (
        replace(field, optional=field.optional or field.key not in _ARC_SHOWN)
        if field.kind != "alternatives"
        else field
        for field in arc.fields
    )
    return Group(SIMULATED, (*of_time, *of_arc), **about_group(SIMULATED))


_COMMON = {group.title: group for group in BEARING_GROUPS}
_OF_MACHINE = (
    _of_drive("Source", _SOURCE, _SOURCE[:3]),
    _of_drive("Machine", (*_MACHINE, *_WINDING), _MACHINE),
    replace(_of_drive("Ring, choke and ground", _RING, _RING), title="Grounding ring on the rotor"),
    replace(_of_drive("Ring, choke and ground", (*_CHOKE, *_GROUND), _CHOKE), title="Choke and ground"),
    _COMMON["Oil"],
    Group("Breakdown", _COMMON["Breakdown"].fields[:1], note=_COMMON["Breakdown"].note),
    _simulated(),
    _COMMON["Title"],
)


def summary_of(inputs: Inputs, title: str) -> str:
    """Short text about the element of a group, next to its title."""
    for number, mesh in enumerate(_tables(inputs, "mesh"), 1):
        if title == mesh_title(number):
            teeth = inputs.value(f"mesh.{number}.pair.gear.teeth")
            ratio = ":".join(map(str, teeth)) if isinstance(teeth, list) else ""
            return ", ".join(filter(None, [" and ".join(_pair_of(mesh, "gears")), ratio]))
    for number, link in enumerate(_tables(inputs, "link"), 1):
        if title == link_title(number):
            return f"{link.get('kind', '')}, {' and '.join(_pair_of(link, 'between'))}"
    for number, shaft in enumerate(_tables(inputs, "shaft"), 1):
        name = names_of(inputs)[number - 1]
        if title == shaft_title(name):
            return "rotor" if shaft.get("rotor") is True else ""
        mounted = [bearing for bearing in _tables(inputs, "bearing") if bearing.get("shaft") == name]
        for place, bearing in enumerate(mounted, 1):
            if title == bearing_title(place, name):
                parts = [bearing.get("designation", bearing.get("base", "")), bearing.get("at", "")]
                return ", ".join(map(str, [*parts, *(["axial"] if bearing.get("locating") is True else [])]))
    return ""


def other_inputs(inputs: Inputs) -> dict[str, Any]:
    """Inputs by dotted key with the numbers of tables, without what the axle replaces in gear files."""
    flat = {key: value for key, value in inputs.flat().items() if key not in (*LISTS, "remedies")}
    for name in LISTS:
        for number, table in enumerate(_tables(inputs, name), 1):
            for key, value in Inputs(table).flat().items():
                inner = key.removeprefix("pair.")
                replaced = inner.startswith(REPLACED_IN_GEAR_FILES) and name == "mesh" and inner != key
                if not replaced:
                    flat[f"{name}.{number}.{key}"] = value
    return flat


def fitted_axle(before: Inputs, after: Inputs) -> Inputs:
    """Inputs in which a new name of a shaft, the only rotor and the only locating bearing of a shaft hold.

    Examples
    --------
    >>> shafts = [{"name": "a", "rotor": True}, {"name": "b"}]
    >>> before = Inputs({"shaft": shafts, "bearing": [{"shaft": "b"}]})
    >>> after = before.changed({"shaft.2.name": "c", "shaft.2.rotor": True})
    >>> fitted = fitted_axle(before, after)
    >>> fitted.value("bearing.1.shaft"), fitted.value("shaft.1.rotor")
    ('c', None)
    """
    if before == after or not _tables(after, "shaft"):
        return after
    old, new = names_of(before), names_of(after)
    if len(old) == len(new):
        changed = [(a, b) for a, b in zip(old, new, strict=True) if a != b]
        if len(changed) == 1 and changed[0][1] not in old and changed[0][1]:
            after = _renamed(after, *changed[0])
    after = _fitted_to_rows(before, _fitted_to_time(before, after))
    if before.value(MEASURED) == after.value(MEASURED):
        after = _with_measured(before, after)
    after = _single(before, after, "shaft", "rotor", lambda _: "")
    return _single(before, after, "bearing", "locating", lambda table: str(table.get("shaft", "")))


def _with_measured(before: Inputs, after: Inputs, removed: Collection[tuple[str, int]] = ()) -> Inputs:
    """Inputs whose measured values have the present keys of their elements and shafts.

    ``removed`` contains the lists and numbers, from 1, of the tables that ``after`` lacks.

    Examples
    --------
    >>> before = Inputs({"shaft": [{"name": "a"}], "bearing": [{"shaft": "a"}, {"shaft": "a"}]})
    >>> before = before.changed({"measured.elements.a_2.capacitance": "90 pF +- 5 %"})
    >>> without_table(before, "bearing", 1).value("measured")
    {'elements': {'a_1': {'capacitance': '90 pF +- 5 %'}}}
    """
    measured = after.value(MEASURED)
    if not isinstance(measured, Mapping):
        return after
    old, new = _keys_of_tables(before), _keys_of_tables(after)
    table = dict(measured)
    for place, keys in old.items():
        given = measured.get(place)
        if not isinstance(given, Mapping):
            continue
        now = {
            key: new[place].get((name, n - sum(other == name and m < n for other, m in removed)), key)
            for (name, n), key in keys.items()
            if (name, n) not in removed
        }
        unknown = given.keys() - {*keys.values()}
        table[place] = {
            now.get(key, key): each for key, each in given.items() if key in now or key in unknown
        }
    table = {key: value for key, value in table.items() if value != {}}
    return after if table == measured else after.changed({MEASURED: table or None})


def _keys_of_tables(inputs: Inputs) -> dict[str, dict[tuple[str, int], str]]:
    """Keys of elements and of shafts in the table of measured values, by list and number from 1."""
    places = measured_places(inputs)
    tables = {"elements": ("bearing", "mesh"), "shafts": ("shaft",)}
    return {
        place: dict(
            zip(
                [(name, n) for name in names for n in range(1, len(_tables(inputs, name)) + 1)],
                places[place],
                strict=True,
            )
        )
        for place, names in tables.items()
    }


def _fitted_to_time(before: Inputs, after: Inputs) -> Inputs:
    """Inputs with a simulated time if they have arcs, and with the resistances of meshes that it needs.

    Examples
    --------
    >>> before = Inputs({"shaft": [{"name": "a"}]})
    >>> after = fitted_axle(before, before.changed({"breakdown.arc_resistance": "10 ohm"}))
    >>> after.value("drive.duration"), fitted_axle(after, before).value("drive.duration")
    ('50 ms', None)
    """
    had, has = (inputs.value("breakdown") is not None for inputs in (before, after))
    if had == has:
        return after
    if not has:
        return after.changed({"drive.duration": None, "drive.seed": None})
    first = form_data("first_values")
    values = dict(first["simulated_time"])
    for number in range(1, len(_tables(after, "mesh")) + 1):
        if after.value(f"mesh.{number}.pair.{_CONTACT}") is None:
            values |= {f"mesh.{number}.{key}": value for key, value in first["simulated_meshes"].items()}
    return after.changed({key: value for key, value in values.items() if after.value(key) is None})


def _renamed(inputs: Inputs, old: str, new: str) -> Inputs:
    """Inputs in which all tables refer to a shaft by its new name."""

    def renamed(value: Any) -> Any:
        if isinstance(value, list):
            return [renamed(item) for item in value]
        if isinstance(value, Mapping):
            return {_renamed_key(str(key), old, new): renamed(item) for key, item in value.items()}
        return new if value == old else value

    changes: dict[str, Any] = {}
    keys_of_names = {"bearing": "shaft", "mesh": "gears", "link": "between", "force": "shaft"}
    for name, of_names in keys_of_names.items():
        tables = _tables(inputs, name)
        if tables:
            changes[name] = [
                {key: renamed(value) if key == of_names else value for key, value in table.items()}
                for table in tables
            ]
    remedies = _tables(inputs, "remedies")
    if remedies:
        changes["remedies"] = [
            {key: renamed(value) if key == "changes" else value for key, value in remedy.items()}
            for remedy in remedies
        ]
    return inputs.changed(changes)


def _renamed_key(key: str, old: str, new: str) -> str:
    """Key of a change with the new name of a shaft."""
    first, _, rest = key.partition(".")
    if first in ("bearing", "shaft") and rest.startswith(f"{old}."):
        return f"{first}.{new}.{rest.removeprefix(f'{old}.')}"
    return key


def _single(before: Inputs, after: Inputs, name: str, key: str, group: Any) -> Inputs:
    """Inputs in which a newly set flag is the only one among the tables of its group."""
    old, new = _tables(before, name), _tables(after, name)
    if len(old) != len(new):
        return after
    turned_on = [n for n, (a, b) in enumerate(zip(old, new, strict=True)) if b.get(key) and not a.get(key)]
    if len(turned_on) != 1:
        return after
    (number,) = turned_on
    others = {
        f"{name}.{n}.{key}": None
        for n, table in enumerate(new, 1)
        if n != number + 1 and table.get(key) and group(table) == group(new[number])
    }
    return after.changed(others)


def with_shaft(inputs: Inputs) -> Inputs:
    """Inputs with a further shaft: copies of the bearings and of the mesh of the last shaft."""
    names = names_of(inputs)
    name = next(text for n in range(len(names) + 1, 1000) if (text := f"shaft {n}") not in names)
    last = names[-1] if names else ""
    bearings, meshes = _tables(inputs, "bearing"), _tables(inputs, "mesh")
    copies = [{**deepcopy(bearing), "shaft": name} for bearing in bearings if bearing.get("shaft") == last]
    changes: dict[str, Any] = {
        "shaft": [*_tables(inputs, "shaft"), {"name": name}],
        "bearing": [*bearings, *copies],
    }
    if meshes:
        copied = deepcopy(meshes[-1])
        places = copied.get("at")
        if isinstance(places, list) and len(places) == 2:
            copied["at"] = [_next_to(places[1], copied)] * 2
        changes["mesh"] = [*meshes, {**copied, "gears": [last, name]}]
    return inputs.changed(changes)


# Distances between two gears, and between two bearings, on a shaft [mm].
_BETWEEN_GEARS, _BETWEEN_BEARINGS = 10.0, 100.0


def _next_to(place: Any, mesh: Mapping[str, Any]) -> Any:
    """Place of a gear next to the last gear of a mesh; the place itself without a known width."""
    width = in_unit(str(Inputs(mesh).value("pair.gear.face_width")), "mm")
    at = in_unit(str(place), "mm")
    if width is None or at is None:
        return place
    step = width + _BETWEEN_GEARS
    return f"{rounded(at - step if at >= step else at + step)} mm"


def without_shaft(inputs: Inputs, number: int) -> Inputs:
    """Inputs without a shaft, by its number from 1, and without its bearings, meshes, links and remedies."""
    name, bearings = names_of(inputs)[number - 1], _shafts_of_bearings(inputs)
    lost = [
        ("mesh", n) for n, each in enumerate(_tables(inputs, "mesh"), 1) if name in _pair_of(each, "gears")
    ]
    lost += [("force", n) for n, each in enumerate(_tables(inputs, "force"), 1) if each.get("shaft") == name]
    for kind, n in reversed(lost):
        inputs = without_table(inputs, kind, n)
    removed = [("shaft", number), *(("bearing", n) for n, shaft in enumerate(bearings, 1) if shaft == name)]
    changes: dict[str, Any] = {
        f"shaft.{number}": None,
        "bearing": [each for each in _tables(inputs, "bearing") if each.get("shaft") != name] or None,
        "link": [each for each in _tables(inputs, "link") if name not in _pair_of(each, "between")] or None,
        "remedies": [each for each in _tables(inputs, "remedies") if not _refers(each, name)] or None,
        "ranges": _without_ranges(inputs, name) or None,
    }
    return _with_measured(inputs, inputs.changed(changes), removed)


def _without_ranges(inputs: Inputs, name: str) -> dict[str, Any]:
    """Ranges, except ranges of inputs of a shaft and its bearings."""
    ranges, gone = inputs.value("ranges"), (f"bearing.{name}.", f"shaft.{name}.")
    kept = ranges.items() if isinstance(ranges, Mapping) else ()
    return {key: ends for key, ends in kept if not key.startswith(gone)}


def _refers(remedy: Mapping[str, Any], name: str) -> bool:
    """Whether a remedy changes a shaft or a link to it."""
    changes = remedy.get("changes")
    if not isinstance(changes, Mapping):
        return False
    links = changes.get("link")
    linked = isinstance(links, list) and any(
        isinstance(link, Mapping) and name in _pair_of(link, "between") for link in links
    )
    return linked or any(key.startswith((f"bearing.{name}.", f"shaft.{name}.")) for key in changes)


def without_table(inputs: Inputs, name: str, number: int) -> Inputs:
    """Inputs without a bearing, mesh, force or link, by its number from 1; numbers in keys of remedies and of
    ranges follow.
    """
    remedies = [
        {**remedy, "changes": changes}
        for remedy in _tables(inputs, "remedies")
        if (changes := _renumbered(remedy.get("changes"), name, number))
    ]
    changes = {f"{name}.{number}": None, "remedies": remedies or None}
    changes["ranges"] = _renumbered(inputs.value("ranges"), name, number) or None
    return _with_measured(inputs, inputs.changed(changes), [(name, number)])


def _renumbered(values: Any, name: str, number: int) -> dict[str, Any]:
    """Values by dotted key after a mesh, a link or a force was removed, without its own keys."""
    kept = {}
    for key, value in values.items() if isinstance(values, Mapping) else ():
        first, _, rest = key.partition(".")
        place, _, inner = rest.partition(".")
        if first == name and place.isdecimal() and name in ("mesh", "link", "force"):
            if int(place) == number:
                continue
            key = f"{name}.{int(place) - (int(place) > number)}.{inner}"
        kept[key] = value
    return kept


def with_bearing(inputs: Inputs, shaft: str) -> Inputs:
    """Inputs with a further bearing on a shaft, at another place: a copy of its first bearing."""
    bearings = _tables(inputs, "bearing")
    on_shaft = [bearing for bearing in bearings if bearing.get("shaft") == shaft]
    copied = deepcopy((on_shaft or bearings or [{"base": "6208"}])[0])
    copied.pop("locating", None)
    if (at := in_unit(str(copied.get("at")), "mm")) is not None:
        copied["at"] = f"{rounded(at + _BETWEEN_BEARINGS)} mm"
    return inputs.changed({"bearing": [*bearings, {**copied, "shaft": shaft}]})


def with_mesh(inputs: Inputs) -> Inputs:
    """Inputs with a further mesh of the last two shafts, a copy of the last mesh."""
    meshes, names = _tables(inputs, "mesh"), names_of(inputs)
    copied = deepcopy(meshes[-1]) if meshes else {"at": ["0 mm", "0 mm"], "pair": {}}
    return inputs.changed({"mesh": [*meshes, {**copied, "gears": names[-2:]}]})


def with_force(inputs: Inputs) -> Inputs:
    """Inputs with a further force, on the last shaft, whose bearings then have no loads of their own."""
    name = (names_of(inputs) or [""])[-1]
    force = {"shaft": name, "at": "0 mm", "x": "100 N"}
    bearings = [
        {
            key: value
            for key, value in each.items()
            if f"bearing.{key}" not in _LOADS or each.get("shaft") != name
        }
        for each in _tables(inputs, "bearing")
    ]
    return inputs.changed({"force": [*_tables(inputs, "force"), force], "bearing": bearings})


def with_link(inputs: Inputs) -> Inputs:
    """Inputs with a further link: a ring from the last shaft to the housing."""
    names = names_of(inputs) or [""]
    link = {"between": [names[-1], HOUSING], "kind": "ring", "resistance": "1 ohm"}
    return inputs.changed({"link": [*_tables(inputs, "link"), link]})


def remedy_presets(inputs: Inputs) -> dict[str, dict[str, Any]]:
    """Usual remedies of an axle by their titles, with what they change."""
    presets: dict[str, dict[str, Any]] = {}
    shafts, links = _tables(inputs, "shaft"), _tables(inputs, "link")
    for shaft, name in zip(shafts, names_of(inputs), strict=True):
        rotor = shaft.get("rotor") is True
        words = "rotor" if rotor else name if name.endswith("shaft") else f"{name} shaft"
        link = {"between": [name, HOUSING], "kind": "ring", "resistance": "1 ohm"}
        ring = {"circuit.grounding_ring_resistance": "1 ohm"} if rotor else {"link": [*links, link]}
        presets[f"Ring on the {words}"] = ring
        presets[f"Hybrid bearings on the {words}"] = {
            f"bearing.{name}.element_material": "silicon-nitride",
            f"bearing.{name}.element_capacitance": "5 pF",
        }
    for number in range(1, len(_tables(inputs, "mesh")) + 1):
        presets[f"Superfinished flanks of gear mesh {number}"] = {
            f"mesh.{number}.gear.flank_ra": ["0.05 um", "0.05 um"]
        }
    return presets


# Loads of a bearing, which follow from the gears of its shaft.
_LOADS = ("bearing.radial_load", "bearing.axial_load")


def without_first_values(inputs: Inputs, before: Inputs, after: Inputs, changes: Mapping[str, Any]) -> Inputs:
    """Inputs of a bearing without first values of its kind that the axle gives: loads, and keys of all
    bearings.

    Examples
    --------
    >>> axle = Inputs({"bearings": {"composite_rq": "0.1 um"}})
    >>> bearing = Inputs({"bearing": {"base": "6208"}})
    >>> after = bearing.changed({"bearing.composite_rq": "0.03 um"})
    >>> without_first_values(axle, bearing, after, {"bearing.base": "6208"}) == bearing
    True
    """
    common = inputs.value("bearings")
    names = common if isinstance(common, Mapping) else {}
    keys = (*_LOADS, *(f"bearing.{name}" for name in names))
    return after.changed({key: None for key in keys if before.value(key) is None and key not in changes})
