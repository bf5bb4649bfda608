"""Stored form of a transient run: its journal, motion.sqlite, its file, motion.nc, and checks of the content.

The journal of a run has three tables. ``run`` contains the attributes of motion.nc as JSON, and the number
of all ``steps``. ``instants`` has a row for each recorded instant: the number of its time step, its time [s],
the computing time since the instant before [s], and ``numbers``, a JSON object with the numbers of the
instant and lists with the numbers of the time steps since the instant before, by the names of the variables
of motion.nc. ``arrays`` contains the raw bytes of arrays with their type of NumPy and their shape, by part,
time step and name. The parts are "maps" of the instants, "still", the nodes and the maps of stationary
roughness, and the films from which the run and its coarse run are resumed, "films" and "coarse films".
``seal`` is the CRC-32 of the row.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.motion.moving_contact import KINDS, Kind
from ehlectric.quantities.field_metadata import Stored, stored
from ehlectric.runtime.file_rules import (
    Rule,
    UnfitError,
    case_of,
    check_variables,
    is_list,
    is_number,
    is_number_or_null,
    is_table,
    json_of,
    number_of,
    text_of,
)
from ehlectric.runtime.journal import JournalForm, seal_of_row
from ehlectric.runtime.netcdf import Layout, Stack
from ehlectric.runtime.stored import Part, check_parts, warnings_in

if TYPE_CHECKING:
    import xarray as xr

# Format of the file: its kind and its version.
SCHEMA = "ehlectric.motion.run/1"

# Variables over the time steps that a file has from the first recorded instant on at whose steps surfaces
# touch, in the order of ``TimeStep``.
LOAD_SHARE, AREA_SHARE, SPOTS = "asperity_load_share", "contact_area_share", "spots"
COARSE_SHARE = "coarse_asperity_load_share"
TOUCHING = (LOAD_SHARE, AREA_SHARE, SPOTS, COARSE_SHARE)

# Storage of maps of recorded instants in motion.nc.
_COMPRESSED = {"compression": "gzip", "compression_opts": 1, "shuffle": True}

FORM = JournalForm(
    "run with moving roughness",
    application=0x65686C6D,  # the letters "ehlm"
    version=1,
    tables="""
CREATE TABLE IF NOT EXISTS run (name TEXT PRIMARY KEY, value TEXT NOT NULL, seal INTEGER NOT NULL);
CREATE TABLE IF NOT EXISTS instants (
    step INTEGER PRIMARY KEY, time REAL NOT NULL, seconds REAL NOT NULL, numbers TEXT NOT NULL,
    seal INTEGER NOT NULL
);
CREATE TABLE IF NOT EXISTS arrays (
    part TEXT, step INTEGER, name TEXT, type TEXT NOT NULL, shape TEXT NOT NULL, content BLOB NOT NULL,
    seal INTEGER NOT NULL, PRIMARY KEY (part, step, name)
);
""",
    columns={
        "run": ("name", "value", "seal"),
        "instants": ("step", "time", "seconds", "numbers", "seal"),
        "arrays": ("part", "step", "name", "type", "shape", "content", "seal"),
    },
)
STILL, MAPS, FILMS, COARSE = "still", "maps", "films", "coarse films"

_SINCE = "time since the roughness began to enter"
_LEAST, _STRONGEST = "position of the minimum film thickness", "position of the maximum field strength"
_ALONG, _ACROSS = "along entrainment", "across entrainment"
_OF_COARSE_RUN, _IN_COARSE_RUN = (f"{word} the coarse run, NaN between its steps" for word in ("of", "in"))
_BETWEEN = "minimum film thickness between the nodes"
_CENTRAL = "film thickness at the centre"
_CARRIED = "part of the load that asperities carry"
_TOUCHED = "part of the Hertzian zone in which asperities are in contact"
_SPOTS = "number of contact spots"
_MENISCUS = "position on the centre line from which oil fills the gap, NaN if flooded"
_FILLED = "part of the gap that oil fills"
_WARM = "largest temperature rise at mid-film above the oil in the inlet"
_ERROR = "estimated relative error of the maximum field strength, NaN if unknown"
_HEIGHTS = "roughness of surface {}, out of the body"


@dataclass(frozen=True)
class TimeStep:
    """Values of a time step, SI units; None where the contact or the run has none."""

    time: float = field(metadata=stored("", "s", "increasing", _SINCE))
    minimum_thickness: float = field(metadata=stored("", "m", "positive", "minimum film thickness"))
    minimum_x: float = field(metadata=stored("", "m", "finite", f"{_LEAST}, {_ALONG}"))
    minimum_y: float | None = field(metadata=stored("", "m", "finite", f"{_LEAST}, {_ACROSS}"))
    lowest_thickness: float = field(metadata=stored("", "m", "finite", _BETWEEN))
    central_thickness: float = field(metadata=stored("", "m", "positive", f"{_CENTRAL} of the contact"))
    coarse_lowest_thickness: float = field(
        metadata=stored("", "m", "finite or NaN", f"{_BETWEEN} {_OF_COARSE_RUN}")
    )
    coarse_central_thickness: float = field(
        metadata=stored("", "m", "not negative or NaN", f"{_CENTRAL} {_OF_COARSE_RUN}")
    )
    max_pressure: float = field(metadata=stored("", "Pa", "not negative", "maximum pressure"))
    thin_gap_strength: float = field(
        metadata=stored("", "V/m", "positive", "voltage / minimum film thickness")
    )
    newton_iterations: int = field(metadata=stored("", "1", "whole", "Newton steps of a time step"))
    krylov_iterations: int = field(metadata=stored("", "1", "whole", "GMRES iterations of a time step"))
    halvings: int = field(metadata=stored("", "1", "whole", "number of halvings of a time step"))
    asperity_load_share: float = field(metadata=stored("", "1", "not negative", _CARRIED, needed=False))
    contact_area_share: float = field(metadata=stored("", "1", "not negative", _TOUCHED, needed=False))
    spots: int = field(metadata=stored("", "1", "whole", _SPOTS, needed=False))
    coarse_asperity_load_share: float = field(
        metadata=stored("", "1", "not negative or NaN", f"{_CARRIED} {_IN_COARSE_RUN}", needed=False)
    )
    meniscus: float | None = field(metadata=stored("", "m", "finite or NaN", _MENISCUS, needed=False))
    temperature_rise: float | None = field(metadata=stored("", "K", "finite", _WARM, needed=False))


@dataclass(frozen=True)
class Maps:
    """Film and field over the nodes of the film, SI units; NaN is the strength beyond the field range."""

    pressure: Array = field(metadata=stored("nodes", "Pa", "not negative", "pressure"))
    thickness: Array = field(metadata=stored("nodes", "m", "positive", "film thickness"))
    strength: Array = field(
        metadata=stored("nodes", "V/m", "not negative or NaN", "maximum field strength across the film")
    )


@dataclass(frozen=True)
class Frame(Maps):
    """Values of a recorded instant, SI units; None where the contact or the film has none."""

    roughness_1: Array = field(metadata=stored("nodes", "m", "finite", _HEIGHTS.format(1)))
    roughness_2: Array = field(metadata=stored("nodes", "m", "finite", _HEIGHTS.format(2)))
    cavitated: Mask = field(metadata=stored("nodes", "1", "0 or 1", "cavitated: pressure at ambient"))
    film_fraction: Array | None = field(metadata=stored("nodes", "1", "0 to 1", _FILLED, needed=False))
    temperature: Array | None = field(
        metadata=stored("nodes", "K", "positive", "temperature at mid-film", needed=False)
    )
    frame_time: float = field(metadata=stored("", "s", "increasing", _SINCE))
    frame_step: int = field(metadata=stored("", "1", "increasing", "number of the time step"))
    max_strength: float = field(metadata=stored("", "V/m", "positive", "maximum field strength"))
    max_strength_x: float = field(metadata=stored("", "m", "finite", f"{_STRONGEST}, {_ALONG}"))
    max_strength_y: float | None = field(metadata=stored("", "m", "finite", f"{_STRONGEST}, {_ACROSS}"))
    capacitance: float = field(metadata=stored("", None, "positive", "capacitance within the field range"))
    max_strength_error: float = field(metadata=stored("", "1", "not negative or NaN", _ERROR))


# Variables of which a line contact has none.
_ACROSS_ONLY = ("minimum_y", "max_strength_y")


@dataclass(frozen=True)
class Parts:
    """Parts of the file of a line or of a point contact, and its nodes along each axis."""

    axes: Mapping[str, Stored]
    steps: Part
    frames: Part
    stationary: Part

    @classmethod
    def of(cls, kind: Kind) -> Self:
        """Parts for one kind of contact."""
        axes = {"nodes": kind.axes}
        lacking = {} if len(kind.axes) > 1 else {name: {"needed": False} for name in _ACROSS_ONLY}
        maps = Part(Maps).fields
        return cls(
            axes={
                name: Stored((name,), "m", "increasing", f"position {where}", name)
                for name, where in zip(kind.axes, (_ALONG, _ACROSS), strict=False)
            },
            steps=Part(TimeStep, ("step",), changed=lacking),
            frames=Part(
                Frame, ("frame",), "", axes, lacking | {"capacitance": {"unit": kind.capacitance_unit}}
            ),
            stationary=Part(
                Maps,
                (),
                "stationary_",
                axes,
                {name: {"text": f"{entry.text}, stationary roughness"} for name, entry in maps.items()},
            ),
        )


def check_rows(file: sqlite3.Connection) -> None:
    """Check the seals of all rows of a journal; raises UnfitError if a row is not as it was written."""
    for table, columns in FORM.columns.items():
        for *row, seal in file.execute(f"SELECT {', '.join(columns)} FROM {table}"):
            if seal_of_row(row) != seal:
                raise UnfitError(f"a row of the table {table} is not as it was written")


def add_rows(file: sqlite3.Connection, table: str, rows: Iterable[Sequence[Any]]) -> None:
    """Add rows with their seals to a table of a journal, in an open transaction."""
    places = ", ".join("?" * len(FORM.columns[table]))
    sealed = ((*row, seal_of_row(row)) for row in rows)
    file.executemany(f"INSERT OR REPLACE INTO {table} VALUES ({places})", sealed)


def add_arrays(file: sqlite3.Connection, part: str, step: int, arrays: Mapping[str, Array]) -> None:
    """Add arrays by their names to a part of a journal, in an open transaction."""
    rows = ((name, np.ascontiguousarray(values)) for name, values in arrays.items())
    add_rows(
        file,
        "arrays",
        ((part, step, name, a.dtype.str, json.dumps(a.shape), a.tobytes()) for name, a in rows),
    )


def arrays_in(file: sqlite3.Connection, part: str, step: int) -> dict[str, Array]:
    """Arrays of a part of a journal at a time step by their names."""
    rows = file.execute(
        "SELECT name, type, shape, content FROM arrays WHERE part = ? AND step = ?", (part, step)
    )
    return {name: _array(*row) for name, *row in rows}


def _array(dtype: str, shape: str, content: bytes) -> Array:
    return np.frombuffer(content, dtype).reshape(json.loads(shape))


def attributes_in(file: sqlite3.Connection) -> dict[str, Any]:
    """Attributes of motion.nc in a journal, and the number of all ``steps``."""
    return {name: json.loads(value) for name, value in file.execute("SELECT name, value FROM run")}


def layout_of(file: sqlite3.Connection) -> Layout:
    """Content of motion.nc from a journal, in an open transaction. Its maps are read when they are used.

    Raises UnfitError if the journal has no instant, or a row is not as it was written.
    """
    check_rows(file)
    attributes = attributes_in(file)
    rows = file.execute("SELECT step, seconds, numbers FROM instants ORDER BY step").fetchall()
    if not rows:
        raise UnfitError("it has no recorded instant")
    values: dict[str, Array | Stack] = {**arrays_in(file, STILL, 0)}
    values |= _numbers_of([json.loads(row[2]) for row in rows])
    for name in arrays_in(file, MAPS, 0):
        values[name] = _maps_in(file, name, len(rows))
    parts = Parts.of(KINDS[case_of(attributes, Case.from_dict).contact.geometry])
    fields = (parts.axes, parts.steps.fields, parts.frames.fields, parts.stationary.fields)
    entries = [entry for part in fields for entry in part.values() if entry.name in values]
    complete = int(rows[-1][0] == attributes.pop("steps"))
    return Layout(
        {entry.name: (entry.dims, values[entry.name], entry.attributes) for entry in entries},
        {"frames": len(rows), "complete": complete, **attributes, "seconds": sum(row[1] for row in rows)},
        storage={entry.name: {"fillvalue": None, **_storage(values[entry.name], entry)} for entry in entries},
    )


def _maps_in(file: sqlite3.Connection, name: str, instants: int) -> Stack:
    """Maps of a name at all recorded instants. Raises UnfitError unless each instant has one of one shape."""
    of = "FROM arrays WHERE part = ? AND name = ?", (MAPS, name)
    kinds = file.execute(f"SELECT type, shape, count(*) {of[0]} GROUP BY type, shape", of[1]).fetchall()
    if len(kinds) != 1 or kinds[0][2] != instants:
        raise UnfitError(f"{name} is not a map at each recorded instant")
    ((dtype, shape, _),) = kinds

    def entries() -> Iterator[Array]:
        for row in file.execute(f"SELECT type, shape, content {of[0]} ORDER BY step", of[1]):
            yield _array(*row)

    return Stack((instants, *json.loads(shape)), np.dtype(dtype), entries)


def _numbers_of(instants: Sequence[Mapping[str, Any]]) -> dict[str, Array]:
    """Values over the recorded instants, and over the time steps, by the names of their variables.

    Variables of asperities are omitted if surfaces touch at no step of the run or of its coarse run.
    """
    values: dict[str, Array] = {}
    for name, first in instants[0].items():
        items: Iterable[Any] = (instant[name] for instant in instants)
        items = chain.from_iterable(items) if isinstance(first, list) else items
        values[name] = np.array(list(items), dtype=float)
    if not (np.any(values[SPOTS]) or np.any(values[COARSE_SHARE] > 0.0)):
        values = {name: array for name, array in values.items() if name not in TOUCHING}
    return values


def _storage(values: Array | Stack, entry: Stored) -> Mapping[str, Any]:
    """Options of the variable of maps over the recorded instants; none of another variable."""
    return {"chunks": (1, *values.shape[1:]), **_COMPRESSED} if _is_map(entry) else {}


def _is_map(entry: Stored) -> bool:
    return entry.dims[0] == "frame" and len(entry.dims) > 1


def numbers_and_maps(
    parts: Parts, frame: Frame, steps: Sequence[TimeStep]
) -> tuple[dict[str, Any], dict[str, Array]]:
    """Values of an instant and of the steps before it as a journal has them; maps have single precision."""
    numbers: dict[str, Any] = {}
    for name in parts.steps.fields:
        column = [getattr(step, name) for step in steps]
        if column[0] is not None:
            numbers[name] = column
    maps = {}
    for name, entry in parts.frames.fields.items():
        value = getattr(frame, name)
        if value is None:
            continue
        if _is_map(entry):
            maps[name] = np.asarray(value, dtype="<i1" if entry.rule == "0 or 1" else "<f4")
        else:
            numbers[name] = value
    return numbers, maps


_is_positive = partial(is_number, values="positive")
_STATIONARY: Mapping[str, Callable[[Any], bool]] = {
    "minimum_thickness": _is_positive,
    "minimum_position": lambda value: is_number(value) or is_list(value, is_number),
    "max_pressure": _is_positive,
    "max_strength": _is_positive,
    "capacitance": _is_positive,
}


def solved_part(dataset: xr.Dataset) -> xr.Dataset:
    """Part of the dataset of a file with the solved steps and the recorded instants, after it is checked.
    Raises UnfitError where a variable or an attribute is missing, or is not as a run writes it.
    """
    attributes = dataset.attrs
    kind = KINDS[case_of(attributes, Case.from_dict).contact.geometry]
    check_variables(dataset, {"frame_step": Rule(("frame",), "finite or NaN", "1")})
    frames = number_of(attributes, "frames", "whole")
    recorded = dataset["frame_step"].values[: int(frames)]
    if not 1 <= frames == recorded.size:
        raise UnfitError(f"it has {dataset.sizes['frame']} of {frames:.0f} recorded instants")
    steps = dataset.sizes.get("step", 0)
    if not (recorded[0] == 0.0 and recorded[-1] < steps and np.all(recorded == np.floor(recorded))):
        raise UnfitError("frame_step is not the numbers of time steps")
    part = dataset.isel(frame=slice(0, int(frames)), step=slice(0, int(recorded[-1]) + 1))
    parts = Parts.of(kind)
    rules = {name: Rule(entry.dims, entry.rule, entry.unit) for name, entry in parts.axes.items()}
    stationary = [parts.stationary] if "stationary_thickness" in dataset else []
    check_parts(part, [parts.steps, parts.frames, *stationary], rules, dict.fromkeys(kind.axes, 2))
    maps = part["strength"].values.reshape(int(frames), -1)
    if not np.all(np.any(np.isfinite(maps), axis=1)):
        raise UnfitError("strength has no value at an instant")
    _check_attributes(attributes)
    return part


def _check_attributes(attributes: Mapping[Any, Any]) -> None:
    for name in ("version", "date", "title"):
        text_of(attributes, name)
    number_of(attributes, "seconds")
    number_of(attributes, "complete", "0 or 1")
    for name in ("covered_from", "coincident"):
        if name in attributes:
            number_of(attributes, name, "finite or NaN")
    others = {"discretisation_error": is_number_or_null}
    json_of(
        attributes,
        "stationary",
        lambda value: value is None or is_table(value, columns=_STATIONARY, others=others),
    )
    json_of(attributes, "rough", partial(is_list, right=lambda item: isinstance(item, dict)))
    warnings_in(attributes)
