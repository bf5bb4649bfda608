"""Inputs of the files, from ``inputs.toml``: label, symbol and meaning of every key, form fields.

Errors, forms, axes, schemas and the documentation look inputs up here, and have no labels of their own. The
tables of the package ``cases`` take the SI unit and the bounds of a number from here. The unit and bounds of
a parameter of a law of the lubricant stand with the law.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal

from ehlectric.quantities import units
from ehlectric.quantities.quantity import Bounds, Quantity, data_file

# Tables of the bearings of a drive file, and the name that stands for both.
ENDS = ("drive_end", "non_drive_end")
BOTH = "bearings"

# Speed of the shaft and temperature of the oil in a bearing file.
SPEED, TEMPERATURE = "bearing.inner_speed", "bearing.temperature"

# Keys of a bearing file that a key of a drive replaces at both ends. Keys that columns of duty cycles replace
# are in ``measured_columns.toml``.
REPLACED = {SPEED: "drive.speed", TEMPERATURE: "drive.temperature", "contacts": "drive.contacts"}
_REPLACING = {above: key for key, above in REPLACED.items()}

# Tables of the keys that stand in no table.
_FILES = ("case_file", "bearing_file", "drive_file", "gear_file", "axle_file")

# Attributes of an entry that are no fields of ``Input``; ``attributes`` returns them.
_FURTHER = frozenset(
    ("aliases", "default", "each", "field", "help", "in_results", "lists", "only", "only_given", "row_of")
)

# Tables that a file has several times, with the words for one of them.
_NUMBERED = {"contact.body": "of body", "roughness": "of rough surface"}


@dataclass(frozen=True, kw_only=True)
class Input(Bounds, Quantity):
    """Input of a file with its unit and bounds, and its field in the app if it has one.

    ``shown`` is the unit of the number in the field, as the file takes it; ``slider`` are the ends of its
    slider in this unit, spaced by logarithms if ``log``. ``choices`` are empty where the library contains
    them. ``field_note`` stands next to the field, and an ``optional`` field may be left empty.
    """

    kind: Literal["number", "count", "choice", "text"] = "number"
    slider: tuple[float, float] = (0.0, 1.0)
    log: bool = False
    choices: tuple[str, ...] = ()
    field_note: str = ""
    optional: bool = False

    @property
    def absolute(self) -> bool:
        """Whether the value is a temperature on a scale with a zero, and no difference of temperatures."""
        return self.unit == "K" and not self.difference


def _contents() -> dict[str, dict[str, Any]]:
    return data_file("ehlectric.quantities", "inputs.toml")


@cache
def inputs() -> Mapping[str, Mapping[str, Input]]:
    """Inputs by table and key; numbered tables, such as a body of a contact, stand there once.

    Examples
    --------
    >>> inputs()["contact"]["load"].meaning, inputs()["contact.body"]["heat_capacity"].label
    ('load of a point contact', 'heat capacity')
    """
    return {
        name: {key: _input(key, **entry) for key, entry in table.items()}
        for name, table in _contents().items()
        if name != "forms"
    }


# Values typical in machines reach that far below and above the slider.
_BELOW, _ABOVE = 1.0 / 30.0, 10.0


def _input(key: str, **entry: Any) -> Input:
    entry = {name: value for name, value in entry.items() if name not in _FURTHER}
    entry["typical"] = _typical(entry)
    for name in ("slider", "choices"):
        entry[name] = tuple(entry[name]) if name in entry else getattr(Input, name)
    return Input(**{"label": key.replace("_", " "), **entry})


def _typical(entry: Mapping[str, Any]) -> tuple[float, float] | None:
    """Typical values of an input in its SI unit: its own, or the range of its slider and somewhat beyond."""
    factor = units.known_factor(entry.get("shown", ""), entry.get("unit", "").replace("**", "^"))
    if factor is None or ("typical" not in entry and "slider" not in entry):
        return None
    if "typical" in entry:
        low, high = entry["typical"]
    else:
        low, high = max(0.0, _BELOW * entry["slider"][0]), _ABOVE * max(map(abs, entry["slider"]))
    return factor * low, factor * high


@cache
def attributes(name: str) -> Mapping[str, Any]:
    """Return an attribute's values by dotted key, for entries that have it and for both bodies.

    Examples
    --------
    >>> attributes("default")["drive.seed"], attributes("only")["contact.body_2.radius_x"]
    (0, 'point')
    """
    return {
        f"{table}{key}": entry[name]
        for head, entries in _contents().items()
        if head != "forms"
        for table in _PLACES.get(head, (f"{head}.",))
        for key, entry in entries.items()
        if name in entry
    }


# Beginnings of the dotted keys of a table of entries, if they are not its name.
_PLACES = {"contact.body": ("contact.body_1.", "contact.body_2.")} | dict.fromkeys((*_FILES, "sweep"), ("",))


@cache
def aliases() -> Mapping[str, tuple[str, ...]]:
    """Keys that a wrong name may mean, by the dotted name.

    Examples
    --------
    >>> aliases()["contact.force"]
    ('contact.load', 'contact.load_per_length', 'contact.max_hertz_pressure')
    """
    meant: dict[str, tuple[str, ...]] = {}
    for key, names in attributes("aliases").items():
        table = key.rpartition(".")[0]
        for name in names:
            dotted = name.removeprefix(".") if "." in name or not table else f"{table}.{name}"
            meant[dotted] = (*meant.get(dotted, ()), key)
    read = data_file("ehlectric.quantities", "key_aliases.toml")["aliases"]
    return meant | {name: tuple(keys) for name, keys in read.items()}


def form(name: str) -> Mapping[str, tuple[str, ...]]:
    """Return the keys of each group in a form of the app, by group title.

    Examples
    --------
    >>> form("line")["Materials"][0]
    'contact.reduced_modulus'
    """
    return {title: tuple(keys) for title, keys in _contents()["forms"][name].items()}


def end_and_key(key: str) -> tuple[str, str]:
    """Name of the bearing of a drive before a dotted key, and the key in a bearing file.

    Keys of an axle have the name of a shaft, a number or a kind before them: "bearing.SHAFT", "shaft.SHAFT",
    "mesh.NUMBER", "force.NUMBER" and "link.KIND". "bearing.*" and "mesh.*" stand for all bearings and for all
    gear files.

    Examples
    --------
    >>> end_and_key("drive_end.bearing.temperature"), end_and_key("source.dc_link")
    (('drive_end', 'bearing.temperature'), ('', 'source.dc_link'))
    >>> end_and_key("bearing.rotor.composite_rq"), end_and_key("mesh.1.gear.flank_ra")
    (('bearing.rotor', 'bearing.composite_rq'), ('mesh.1', 'gear.flank_ra'))
    >>> end_and_key("bearing.rotor.lubricant.base")
    ('bearing.rotor', 'lubricant.base')
    >>> end_and_key("bearings.composite_rq"), end_and_key("link.ring.resistance")
    (('bearing.*', 'bearing.composite_rq'), ('link.ring', 'axle.link.resistance'))
    """
    first, _, rest = key.partition(".")
    name, _, inner = rest.partition(".")
    bearing = inputs()["bearing"]
    if first in (*ENDS, BOTH) and rest:
        of_axle = first == BOTH and (name in bearing or f"bearing.{name}" in inputs())
        return (_ALL_BEARINGS, f"bearing.{rest}") if of_axle else (first, rest)
    if not inner:
        return "", key
    if first == "mesh" and name == "gear":
        return _ALL_MESHES, rest
    if first == "mesh" and name.isdecimal():
        return f"mesh.{name}", inner
    if first in ("shaft", "link", "force") and f"axle.{first}" in inputs():
        return f"{first}.{name}", f"axle.{first}.{inner}"
    if first == "bearing" and name not in bearing and f"bearing.{name}" not in inputs():
        of_oil = inner.partition(".")[0] in ("lubricant", "discharge")
        return f"bearing.{name}", inner if of_oil else f"bearing.{inner}"
    return "", key


# Names before the keys of all bearings and of all gear files of an axle.
_ALL_BEARINGS, _ALL_MESHES = "bearing.*", "mesh.*"


def with_end(end: str, inner: str) -> str:
    """Dotted key of a name and a key of ``end_and_key``.

    Examples
    --------
    >>> with_end("drive_end", "bearing.base"), with_end("bearing.rotor", "bearing.base")
    ('drive_end.bearing.base', 'bearing.rotor.base')
    >>> with_end(*end_and_key("bearings.base")), with_end(*end_and_key("link.1.resistance"))
    ('bearings.base', 'link.1.resistance')
    """
    kind = end.partition(".")[0]
    if end == _ALL_MESHES:
        return f"mesh.{inner}"
    if kind in ("bearing", "shaft", "link", "force"):
        name = inner.removeprefix("axle.").removeprefix(f"{kind}.")
        return f"{BOTH if end == _ALL_BEARINGS else end}.{name}"
    return f"{end}.{inner}" if end else inner


def key_of_drive(key: str) -> str:
    """Key of a drive file that changes a key of a bearing file at both ends.

    Examples
    --------
    >>> key_of_drive("bearing.inner_speed"), key_of_drive("bearing.radial_load")
    ('drive.speed', 'bearings.bearing.radial_load')
    """
    return REPLACED.get(key, f"{BOTH}.{key}")


def end_and_replaced(key: str) -> tuple[str, str]:
    """Name of the bearing of a drive that a dotted key changes, and the key in its bearing file.

    Examples
    --------
    >>> end_and_replaced("drive.speed"), end_and_replaced("drive_end.bearing.temperature")
    (('bearings', 'bearing.inner_speed'), ('drive_end', 'bearing.temperature'))
    """
    return (BOTH, _REPLACING[key]) if key in _REPLACING else end_and_key(key)


def table_and_key(key: str) -> tuple[str, str, str]:
    """Table and name of a dotted key in ``inputs``, and the number of the table where it is one of several.

    Examples
    --------
    >>> table_and_key("contact.body_2.density"), table_and_key("roughness.1.rq")
    (('contact.body', 'density', '2'), ('roughness', 'rq', '1'))
    """
    table, _, name = end_and_key(key)[1].rpartition(".")
    head, _, number = table.replace("contact.body_", "contact.body.").rpartition(".")
    return (head, name, number) if number.isdecimal() else (table, name, "")


def key_of_list(key: str) -> str:
    """Key of a list with a value of each gear, from the key of one value; any other key itself.

    Examples
    --------
    >>> key_of_list("gear.teeth.2"), key_of_list("gear.helix_angle")
    ('gear.teeth', 'gear.helix_angle')
    """
    table, _, number = key.rpartition(".")
    return table if number in ("1", "2") and table in attributes("each") else key


def input_at(key: str) -> Input | None:
    """Input of a dotted key; None where there is no such key.

    Examples
    --------
    >>> input_at("drive_end.bearing.radial_load").label, input_at("contact.body_2.density").label
    ('radial load', 'density of body 2')
    >>> input_at("film.minimum_thickness") is None, input_at("gear.teeth.1").label
    (True, 'teeth of gear 1')
    """
    whole = key_of_list(key)
    if whole != key and (listed := input_at(whole)) is not None:
        return replace(listed, label=f"{attributes('each')[whole]} {key[-1]}")
    table, name, number = table_and_key(key)
    places = (table, f"axle.{table}") if table else _FILES
    entry = next((inputs()[book][name] for book in places if name in inputs().get(book, {})), None)
    if entry is None or not number:
        return entry
    return replace(entry, label=f"{entry.label} {_NUMBERED[table]} {number}") if table in _NUMBERED else None


# Commands of LaTeX in descriptions, as plain text.
_LATEX = {
    r"\\(?:mathrm|text)\{([^}]*)\}": r"\1",
    r"\\sqrt\{((?:[^{}]|\{[^}]*\})*)\}": r"√(\1)",
    r"\\eta": "η",
    r"\\tau": "τ",
    r"\\mu": "µ",
    r"\\Lambda": "Λ",
    r"\\nu": "ν",
    r"\\omega": "ω",
    r"\\sigma": "σ",
    r"\\alpha": "α",
    r"\\beta": "β",
    r"\\epsilon": "ϵ",
    r"\\rho": "ρ",
    r"\\zeta": "ζ",
    r"\\lambda": "λ",
    r"\\(?:var)?epsilon": "ε",
    r"\\ln": "ln ",
    r"\^2": "²",
    r"[${}`]": "",
}


def plain_text(text: str) -> str:
    """Text without the marks of Markdown and LaTeX."""
    for pattern, plain in _LATEX.items():
        text = re.sub(pattern, plain, text)
    return text


def first_clause(text: str) -> str:
    """Return the definition in a meaning: the text up to the first semicolon or full stop.

    Examples
    --------
    >>> first_clause("radial clearance before mounting. Give this key or `bearing.clearance_class`.")
    'radial clearance before mounting'
    """
    return re.split(r"; |\. ", text)[0].rstrip(".")
