"""Files of every kind that together contain every key: cases, and changes of them, of ``tests/data``."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

from tests.helpers.input_keys import merged, values_in, with_value, without_value
from tests.helpers.places import DATA

Tables = dict[str, Any]

# Numbers of a profile, times and square wave of a source, and a sine wave of which the shaft has a part that
# collapses to 0 V at many times.
_WAVES = [round(30.0 * math.sin(k / 3.0), 3) for k in range(400)]
_TIMES = [f"{0.2 * k:.1f}" for k in range(4000)]
_UNEVEN = [f"{0.2 * k + 0.05 * (k % 2):.2f}" for k in range(4000)]
_LEVELS = [280.0 if (k // 250) % 2 else -280.0 for k in range(4000)]
_SINE = [280.0 * math.sin(0.002 * math.pi * k) for k in range(4000)]
_SHAFT = [0.03 * (_SINE[k] - _SINE[k - k % 170]) for k in range(4000)]


def _record(head: str, *columns: list[Any]) -> str:
    rows = (",".join(map(str, row)) for row in zip(*columns, strict=True))
    return "\n".join([head, *rows, ""])


# Contents of files by the names that stand for them.
_FILES = {
    "profile": "\n".join(f"{2 * k},{wave}" for k, wave in enumerate(_WAVES)),
    "matrix": "\n".join("\t".join(map(str, _WAVES[row : row + 200])) for row in range(150)),
    "record": _record("time [us],u_cm [V]", _TIMES, _LEVELS),
    "record without units": _record("t,u", _TIMES, _LEVELS),
    "record without times": _record("u_cm [V]", _LEVELS),
    "record of the shaft": _record("time [us],u_cm [V],u_shaft [V]", _TIMES, _SINE, _SHAFT),
    "record of the shaft without units": _record("t,u,v", _TIMES, _SINE, _SHAFT),
    "record of the shaft at uneven times": _record("time [us],u_shaft [V]", _UNEVEN, _SHAFT),
    "record of the shaft without times": _record("u_shaft [V]", _SHAFT),
    "vehicle": "time [s],vehicle speed [km/h],temperature [degC]\n0,30,50\n10,60,52\n20,90,54\n",
}

# Further tables of the gear file of an axle, by the names that stand for them.
_PAIRS: Mapping[str, Tables] = {
    "gear": {},
    "rough gear": {"gear": {"flank_ra": ["0.3 um", "0.3 um"]}},
    "measured gear": {
        "ranges": {"gear.operation.pinion_torque": ["25 N m", "35 N m"]},
        "measured": {"capacitance": "300 pF +- 20 %"},
    },
}


@cache
def _data(name: str) -> Tables:
    with (DATA / "inputs" / f"{name}.toml").open("rb") as file:
        return _with_contents(tomllib.load(file))


def _with_contents(table: Any, key: str = "") -> Any:
    """Nested tables with the contents of files instead of their names."""
    if isinstance(table, dict):
        return {name: _with_contents(value, name) for name, value in table.items()}
    if isinstance(table, list):
        return [_with_contents(value) for value in table]
    if key == "heights":
        return [1e-9 * wave for wave in _WAVES]
    if key == "pair":
        return merged(_data("gear")["base"], _PAIRS[table])
    return _FILES.get(table, table) if key == "file" else table


def _changed(tables: Tables, change: Mapping[str, Any]) -> Tables:
    """Tables without some keys, and with the values of a change."""
    for key in change.get("without", ()):
        tables = without_value(tables, key)
    return merged(tables, {key: value for key, value in change.items() if key != "without"})


def _contacts(base: Tables) -> Iterator[Tables]:
    data, oils = _data("contacts"), _data("oils")
    yield from (_changed(base, change) for change in data["changes"])
    yield from ({**base, "lubricant": oil} for oil in oils["oils"])
    hot = [merged({**base, "lubricant": oil}, data["hot"]) for oil in oils["hot"]]
    yield from (*hot, *(_changed(hot[0], change) for change in data["of_hot"]))


def _bearings(base: Tables) -> Iterator[Tables]:
    """Bearings that a bearing file, and an end of a drive, may have."""
    data, oils = _data("bearings"), _data("oils")
    yield from (_changed(base, change) for change in data["changes"])
    plain = without_value(base, "discharge.conductivity")
    yield from ({**plain, "lubricant": oil} for oil in oils["oils"])
    yield from (_changed({**base, "lubricant": oil}, data["hot"]) for oil in oils["hot"])


def _gears(base: Tables) -> Iterator[Tables]:
    plain = without_value(base, "discharge.conductivity")
    yield from ({**plain, "lubricant": oil} for oil in _data("oils")["oils"])
    hot = [merged({**base, "lubricant": oil}, _data("gears")["hot"]) for oil in _data("oils")["hot"]]
    yield from hot


def _further(kind: str) -> Iterator[Tables]:
    """Cases of a kind that change more than the tables of this kind."""
    data, base = _data(kind), _data(kind)["base"]
    if kind in ("bearing", "drive"):
        records = _data("bearings")["records"]
        plain = _changed(base, data.get("plain", {}))
        yield from (merged(plain, {"measured": {"shaft_record": record}}) for record in records)
    if kind in ("line", "point", "motion"):
        yield from _contacts(base)
        if kind == "motion":
            yield from (_changed(base, change) for change in _data("line")["changes"])
    elif kind == "bearing":
        solved = _changed(base, data["solved"])
        yield from (*_bearings(base), *(_changed(solved, change) for change in data["of_solved"]))
    elif kind == "gear":
        yield from (_changed(base, change) for change in _data("gears")["changes"])
        yield from _gears(base)
    elif kind == "drive":
        plain = _changed(base, data["plain"])
        yield from ({**plain, "drive_end": end} for end in _bearings(base["drive_end"]))
    elif kind == "axle":
        geared = _changed(base, data["geared"])
        yield geared
        yield from (_changed(geared, change) for change in data["of_geared"])
        for change in _data("gears")["changes"]:
            pair = _changed(_data("gear")["base"], change)
            yield with_value(geared, ("mesh", 0, "pair"), pair)
        parts = {"bearing": base["bearings"], "lubricant": base["lubricant"], "discharge": base["discharge"]}
        yield from (_of_axle(base, tables) for tables in _bearings(parts))


_LOADS = ("radial_load", "axial_load")


def _of_axle(base: Tables, tables: Tables) -> Tables:
    """Axle with the bearings, the oil and the strength of a bearing file."""
    of_file = without_value(tables["bearing"], "temperature")
    rows = [{**row, **{key: of_file[key] for key in _LOADS if key in of_file}} for row in base["bearing"]]
    bearings = {key: value for key, value in of_file.items() if key not in _LOADS}
    return {**base, **tables, "bearings": bearings, "bearing": rows}


@cache
def cases_of(kind: str) -> tuple[Tables, ...]:
    """Return the cases of a kind, of which the first is the one that most others change."""
    if kind.startswith("duty"):
        name = kind.partition(" of ")[2]
        base = _changed(_data(name)["base"], {"without": ["drive.duration"] if name == "axle" else []})
        base = _changed(base, _data(name).get({"axle": "geared", "drive": "plain"}.get(name), {}))
        return tuple(_changed(base, change) for change in _data("duty")[name])
    data = _data(kind)
    base = _with_case(data["base"])
    plain = _changed(base, data["plain"]) if "plain" in data else base
    changed = (_changed(plain, change) for change in data.get("changes", ()))
    return (base, *changed, *(() if kind == "sweep" else _further(kind)))


def _with_case(base: Tables) -> Tables:
    """Tables of a sweep with the tables of its case instead of their name; other tables themselves."""
    return {**base, "case": _data(base["case"])["base"]} if "case" in base else base


def refused_of(kind: str) -> Tables:
    """Return values by dotted keys that files of a kind refuse."""
    if kind == "motion":
        return _data("line")["refused"] | _data("motion")["refused"]
    name = kind.removeprefix("duty of ")
    return dict(_data("duty")["refused"][name] if name != kind else _data(kind).get("refused", {}))


def new_values(tables: Tables, base: Tables) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Values of a case, by path, that its base does not have."""
    known = dict(values_in(base))
    yield from ((path, value) for path, value in values_in(tables) if known.get(path) != value)


OF_DUTY = tuple(f"duty of {name}" for name in ("bearing", "gear", "drive", "axle"))
KINDS = ("line", "point", "motion", "bearing", "gear", "drive", "axle", "sweep", *OF_DUTY)
