"""Case of a drive, read from TOML, written back, and changed, and the cases of every kind."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self

from pydantic import Field, model_validator

from ehlectric.cases.axle_keys import ADJUSTED, LOADS
from ehlectric.cases.bearing_case import BearingCase, bearing_key, open_tables
from ehlectric.cases.case import Case
from ehlectric.cases.drive_inputs import Breakdown, Circuit, Operation, Rotor, ShaftForce, Source
from ehlectric.cases.duty_inputs import Duty
from ehlectric.cases.key_names import refuse_deep
from ehlectric.cases.keywords import with_keys
from ehlectric.cases.measured_inputs import Measured
from ehlectric.cases.roughness_inputs import find_files
from ehlectric.cases.table import CaseFile, Table, Title, as_mapping
from ehlectric.cases.table_edits import displace, flattened, set_keys
from ehlectric.errors import InputError, for_all, shown, within
from ehlectric.quantities.alternatives import ALTERNATIVES, DESCRIBED
from ehlectric.quantities.formats import operating_point
from ehlectric.quantities.inputs import BOTH as BOTH
from ehlectric.quantities.inputs import ENDS as ENDS
from ehlectric.quantities.inputs import REPLACED, end_and_key
from ehlectric.runtime.display import headline

# Tables of a bearing file that a drive does not use.
NOT_IN_DRIVES = ("motor", "duty", "measured")

# Keys of its table of discharges that a drive does not use, as the drive computes discharges over time.
NOT_OF_DISCHARGES = ("external_capacitance", "peak_current", "pit")


class Remedy(Table, book="remedies"):
    """Changed copy of the drive that is computed for comparison."""

    title: Title
    changes: dict[str, Any]

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.changes:
            takes = 'values by dotted key, such as { "drive.speed" = "1500 rpm" }'
            raise InputError(
                "changes", got=f"none in the mitigation measure {shown(self.title)}", takes=takes
            )
        return self


@dataclass(frozen=True)
class Connection:
    """Connection of two nodes of a network."""

    name: str
    first: str
    second: str
    capacitance: float = 0.0  # [F]
    conducts: bool = False
    conductance: float = 0.0  # [S]


def within_remedy(number: int) -> AbstractContextManager[None]:
    """Context in which errors get their key in the changes of a remedy, by its number in the file; with 0, of
    the case without a remedy, they keep it.
    """
    return within(f"remedies.{number}.changes") if number else nullcontext()


class NetworkCase(CaseFile):
    """Case of a source, a machine and its films, which is a drive or an axle, with changed copies of it.

    Its network has the nodes of the machine and the shafts, and connections between them.
    """

    if TYPE_CHECKING:
        title: Title
        drive: Any
        source: Source
        circuit: Circuit
        remedies: tuple[Remedy, ...]

        def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
            """Return a changed copy."""

    @property
    def rotor_name(self) -> str:
        """Name of the shaft of the rotor."""
        return "rotor"

    @property
    def shaft_names(self) -> tuple[str, ...]:
        """Names of all shafts."""
        return (self.rotor_name,)

    def connections(self) -> Iterator[Connection]:
        """Yield connections of shafts with each other and with the housing, in addition to the machine."""
        yield from ()

    @property
    def running_speed(self) -> float:
        """Speed of the rotor [rad/s]."""
        raise NotImplementedError

    @property
    def running_source(self) -> Source:
        """Source at the speed of the rotor, with the frequency and the modulation index that follow it."""
        return self.source.at_speed(self.running_speed)

    @property
    def running_circuit(self) -> Circuit:
        """Circuit at the speed of the rotor, with the resistance that its grounding ring has there."""
        return self.circuit.at_speed(self.running_speed)

    @property
    def numbered_remedies(self) -> tuple[tuple[int, Remedy], ...]:
        """Remedies that apply to the source and are computed, with their numbers in the file, from 1."""
        return tuple(
            (number, remedy)
            for number, remedy in enumerate(self.remedies, 1)
            if not self.described_changes(remedy)
        )

    def described_changes(self, remedy: Remedy) -> tuple[str, ...]:
        """Dotted keys by which a remedy changes a described source, if the source is measured.

        A remedy that also changes ``source.file`` has none: it replaces the source.
        """
        changes = flattened(remedy.changes)
        if not self.source.measured or "source.file" in changes:
            return ()
        return tuple(key for name in DESCRIBED if (key := f"source.{name}") in changes)

    def variants(self) -> tuple[Self, ...]:
        """Return changed copies without remedies, one for each of ``numbered_remedies``."""
        return tuple(for_all(self._changed, self.numbered_remedies))

    def _changed(self, numbered: tuple[int, Remedy]) -> Self:
        number, remedy = numbered
        with within_remedy(number):
            return self.replace({**remedy.changes, "remedies": []})


class DriveCase(NetworkCase, book="drive_file"):
    """Drive: inverter, motor and both bearings; all inputs on which discharges over time depend.

    A case is made from a file by ``from_toml``, or from nested tables by ``from_dict``. Wrong inputs raise an
    ``InputError`` that names their keys. A case is frozen; ``replace`` returns a changed copy. Numbers are in
    SI units.

    Parameters
    ----------
    source, circuit, breakdown : mapping
        Common-mode voltage; circuit of the motor; arc and threshold of the films.
    drive_end : BearingCase or mapping
        Bearing at the drive end.
    non_drive_end : BearingCase or mapping, optional
        Bearing at the other end; the same as at the drive end if not given.
    rotor : mapping, optional
        Mass of the rotor and places of its bearings, from which their loads follow.
    force : sequence of mapping, optional
        Further forces on the rotor.
    drive : mapping, optional
        Speed and temperature of both bearings, duration and seed.
    title : str, optional
        Title of tables and figures.
    remedies : sequence of mapping, optional
        Changes that are computed in addition to the drive, each with its title.
    duty : mapping, optional
        Duty cycle over which discharges are expected.
    measured : mapping, optional
        Measured values that correct the ranges of uncertain inputs.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.DriveCase.from_toml(ehlectric.example("drive.toml"))
    >>> longer = case.replace({"drive.duration": "1 s"})
    >>> longer.drive.duration, case.circuit.winding_rotor_capacitance
    (1.0, 5e-11)
    """

    if TYPE_CHECKING:

        def __init__(self, **tables: Any) -> None: ...

    _numbered: ClassVar[tuple[str, ...]] = ("force",)

    title: Title = ""
    drive: Operation = Operation()
    rotor: Rotor | None = None
    force: tuple[ShaftForce, ...] = ()
    source: Source
    circuit: Circuit
    breakdown: Breakdown
    drive_end: BearingCase
    # If only one bearing is given, it is used at both ends.
    non_drive_end: BearingCase = Field(default_factory=lambda given: _other_end(given))
    remedies: tuple[Remedy, ...] = ()
    duty: Duty | None = None
    measured: Measured | None = None

    @model_validator(mode="before")
    @classmethod
    def _with_loads(cls, tables: Any) -> Any:
        """Bearings have the loads that follow from the rotor and its forces."""
        if not isinstance(tables, Mapping):
            return tables
        forces = tables.get("force") or ()
        for number, force in enumerate(forces if isinstance(forces, list | tuple) else (), 1):
            if as_mapping(force).get("shaft") is not None:
                text = "is not used: a drive has one shaft, its rotor"
                raise InputError.worded(f"force.{number}.shaft", text)
        if tables.get("rotor") is None and forces:
            raise InputError.missing("rotor", "a table with the places of both bearings, for [[force]]")
        return tables if tables.get("rotor") is None else with_rotor_loads(tables)

    @model_validator(mode="after")
    def _check_rotor(self) -> Self:
        """Check the forces on the rotor, and the kinds of its bearings."""
        if self.rotor is None:
            return self
        self.rotor.loads(self.force, self.drive.gravity_direction)
        for end in ENDS:
            bearing = getattr(self, end).bearing
            if bearing.kind in ADJUSTED and bearing.pair is None:
                raise InputError(
                    f"{end}.bearing.base",
                    got=f"a single {bearing.kind} bearing with [rotor]",
                    takes="one whose axial load does not depend on the other bearing; or radial_load and "
                    "axial_load instead of [rotor]; or an axle of one shaft, which computes both",
                )
        return self

    def plain_tables(self) -> dict[str, Any]:
        """Return all values that a file can contain as nested tables, in SI units."""
        tables = super().plain_tables()
        for end in ENDS if self.rotor is not None else ():
            for load in LOADS:
                tables[end]["bearing"].pop(load, None)
        return tables

    def check_not_replaced(self, key: str) -> None:
        """Raise an InputError for a load of a bearing that follows from the rotor."""
        if self.rotor is not None:
            check_no_load(key)

    @property
    def with_given_loads(self) -> Self:
        """Drive whose bearings have their loads as inputs, without a rotor and its mitigation measures."""
        if self.rotor is None:
            return self
        kept = [
            each.model_dump()
            for each in self.remedies
            if not any(key.startswith(("rotor", "force")) for key in each.changes)
        ]
        return self.replace({"rotor": None, "force": [], "remedies": kept})

    @property
    def bearings(self) -> tuple[BearingCase, BearingCase]:
        """Bearings at the drive end and the non-drive end, at the speed and temperature of the drive.

        Without a table ``motor`` of their own, whose voltage belongs to another estimate.
        """
        first, second = (
            _in_drive(bearing, self.replaced) for bearing in (self.drive_end, self.non_drive_end)
        )
        return first, second

    @property
    def replaced(self) -> dict[str, Any]:
        """Values that the drive gives for both bearings, by their keys in a bearing file."""
        given = {key: getattr(self.drive, above.partition(".")[2]) for key, above in REPLACED.items()}
        return {key: value for key, value in given.items() if value is not None}

    def key_at(self, end: str, key: str) -> str:
        """Return the key of the drive for a key of the bearing file at an end, or of both bearings."""
        return REPLACED[key] if key in self.replaced else f"{end}.{key}"

    def all_inputs(self) -> dict[str, Any]:
        """Return the tables in SI units, also with the Rq of both bearings that follows from an Ra."""
        return self.to_dict() | {end: getattr(self, end).all_inputs() for end in ENDS}

    @property
    def running_speed(self) -> float:
        """Speed of the rotor [rad/s]: of the drive, else of the bearing at the drive end."""
        speed = self.drive.speed
        return self.drive_end.bearing.inner_speed if speed is None else speed

    @model_validator(mode="after")
    def _check_source(self) -> Self:
        with within("source"):
            self.running_source  # noqa: B018
        return self

    def _headline(self) -> str:
        bearing = self.bearings[0].bearing
        return headline(
            self.title,
            self.source.modulation or self.source.file or "",
            *operating_point(bearing.inner_speed, bearing.oil_temperature, "degC"),
        )

    @classmethod
    def of_file(cls, table: dict[str, Any], path: Path) -> Self:
        """Make a drive case from the tables of the file at a path."""
        return cls.from_written(with_files(table, path.parent))

    def _speeds(self, table: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
        yield from ((table[end]["bearing"], "inner_speed") for end in ENDS)
        if self.drive.speed is not None:
            yield table["drive"], "speed"
        if self.circuit.grounding_ring_table is not None:
            yield table["circuit"]["grounding_ring_table"], "speed"

    def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
        """Return a changed copy of the case.

        Parameters
        ----------
        changes : mapping, optional
            New values by dotted key, as in ``{"drive.speed": "1500 rpm"}``. Keys that begin with
            ``drive_end`` or ``non_drive_end`` are keys of a bearing file; ``bearings`` stands for both ends.
        **tables
            New values by table, as in ``drive={"seed": 2}``.
        """
        refuse_deep({**tables, "changes": changes})
        flat = flattened(tables) | dict(changes or {})
        ends = {end: _of_end(flat, end) for end in ENDS}
        of_drive = {key: value for key, value in flat.items() if key.partition(".")[0] not in (*ENDS, BOTH)}
        table = self.to_dict()
        displace(table, of_drive, {name: ALTERNATIVES[name] for name in ("source", "circuit", "breakdown")})
        set_keys(table, of_drive)
        if table.get("rotor") is not None:
            for_all(check_no_load, flattened(flat))
        for end, change in ends.items():
            with within(end):
                table[end] = getattr(self, end).replace(change)
        return self.from_dict(table)


with_keys(
    DriveCase,
    {
        "drive": Operation,
        "rotor": Rotor,
        "source": Source,
        "circuit": Circuit,
        "breakdown": Breakdown,
        "duty": Duty,
        "measured": Measured,
    },
)


def with_files(table: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Tables of a file with the bearings of its bearing files, and the paths of other files.

    Names are relative to a folder. Raises InputError if a bearing file cannot be read or is not valid.
    """
    tables = deepcopy(dict(table))
    find_files(tables, folder)
    for end in ENDS:
        if isinstance(tables.get(end), Mapping) and "file" in tables[end]:
            if tables.get("rotor") is not None:
                for_all(check_no_load, flattened({end: tables[end]}))
            tables[end] = _bearing_of(tables[end], folder, end)
    return tables


# Difference of two loads that is rounding, relative and absolute [N].
_ROUNDING, _NO_FORCE = 1e-9, 1e-6

# Loads with which other keys of a bearing are checked if its loads are not known [N].
_ANY_LOADS = dict(zip(LOADS, (100.0, 0.0), strict=True))


def with_rotor_loads(tables: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of a drive whose bearings have the loads that follow from ``rotor`` and ``force``.

    If these tables are wrong, the loads are any ones. Raises InputError for a load in a table of a bearing;
    loads of a bearing case are replaced.
    """
    try:
        loads = _loads_of(tables)
    except InputError:
        loads = dict.fromkeys(ENDS, _ANY_LOADS)
    else:
        for_all(lambda key: _check_given(key, tables, loads), [*_given_loads(tables)])
    return {**tables, **{end: _loaded(tables[end], end, loads[end]) for end in ENDS if end in tables}}


def _loads_of(tables: Mapping[str, Any]) -> dict[str, dict[str, float]]:
    forces = tables.get("force") or ()
    return Rotor.from_dict(as_mapping(tables["rotor"])).loads(
        [
            ShaftForce.from_dict(as_mapping(each))
            for each in (forces if isinstance(forces, list | tuple) else ())
        ],
        Operation.from_dict(as_mapping(tables.get("drive"))).gravity_direction,
    )


def _other_end(given: dict[str, Any]) -> BearingCase:
    """Bearing at the non-drive end of a drive with one bearing, with its load by the rotor."""
    bearing: BearingCase = given["drive_end"]
    rotor: Rotor | None = given.get("rotor")
    if rotor is None:
        return bearing
    try:
        loads = rotor.loads(given["force"], given["drive"].gravity_direction)
    except InputError:
        # The case names the error.
        return bearing
    other: BearingCase = _loaded(bearing, ENDS[1], loads[ENDS[1]])
    return other


def _given_loads(tables: Mapping[str, Any]) -> Iterator[str]:
    """Dotted keys of loads in the tables of bearings."""
    for end in ENDS:
        table = tables.get(end)
        if isinstance(table, Mapping):
            of_bearing, ranges = (as_mapping(table.get(name)) for name in ("bearing", "ranges"))
            yield from (f"{end}.bearing.{load}" for load in LOADS if of_bearing.get(load) is not None)
            yield from (
                f"{end}.ranges.bearing.{load}" for load in LOADS if f"bearing.{load}" in flattened(ranges)
            )


def _check_given(key: str, tables: Mapping[str, Any], loads: Mapping[str, Mapping[str, float]]) -> None:
    """Refuse a load in the table of a bearing, except one that is equal to its load by statics."""
    end, table, *inner = key.split(".")
    value = tables[end][table].get(inner[0])
    if table == "ranges" or not (
        isinstance(value, float | int)
        and math.isclose(value, loads[end][inner[0]], rel_tol=_ROUNDING, abs_tol=_NO_FORCE)
    ):
        raise _follows(key)


def check_no_load(key: str) -> None:
    """Raise an InputError for a load of a bearing of a drive, which follows from the rotor."""
    if is_load(key):
        raise _follows(key)


def _follows(key: str) -> InputError:
    return InputError.worded(key, "follows from the tables rotor and force; remove it, or these tables")


def _loaded(bearing: Any, end: str, loads: Mapping[str, float]) -> Any:
    """Bearing of a drive, a case or its tables, with loads [N]."""
    if isinstance(bearing, BearingCase):
        with within(end):
            return bearing.replace({f"bearing.{load}": value for load, value in loads.items()})
    if isinstance(bearing, Mapping) and isinstance(bearing.get("bearing"), Mapping):
        return {**bearing, "bearing": {**bearing["bearing"], **loads}}
    return bearing


def is_load(key: str) -> bool:
    """Whether a dotted key of a drive is a load of its bearings, or the range of one.

    Examples
    --------
    >>> is_load("bearings.bearing.radial_load"), is_load("drive_end.bearing.composite_rq")
    (True, False)
    """
    end, inner = end_and_key(key)
    return end in (*ENDS, BOTH) and inner.removeprefix("ranges.") in [f"bearing.{load}" for load in LOADS]


def _in_drive(bearing: BearingCase, changes: Mapping[str, Any]) -> BearingCase:
    """Bearing with changes, without the duty cycle and the motor of its own file, and what belongs to it."""
    if bearing.duty is not None or bearing.measured is not None:
        bearing = bearing.model_copy(update={"duty": None, "measured": None})
    if bearing.motor is not None:
        table = {key: part for key, part in open_tables(bearing).items() if key not in ("motor", "ranges")}
        table["discharge"].pop("pit", None)
        bearing = BearingCase.from_dict(table)
    return bearing.replace(changes) if changes else bearing


def _of_end(flat: Mapping[str, Any], end: str) -> dict[str, Any]:
    """Changes of the bearing at one end, by the keys of a bearing file."""
    of_end = {}
    for key, value in flat.items():
        first, _, rest = key.partition(".")
        if first in (end, BOTH):
            if not rest:
                raise InputError(
                    key, got="a table", takes="dotted keys, as in 'bearings.bearing.temperature'"
                )
            of_end[rest] = value
    return of_end


def _bearing_of(table: Mapping[str, Any], folder: Path, end: str) -> BearingCase:
    """Bearing of the file that a table names, with the other keys of the table instead of its own."""
    name = table["file"]
    if not isinstance(name, str):
        raise InputError(f"{end}.file", got=str(name), takes="the path of a bearing file")
    try:
        case = BearingCase.from_toml(folder / name)
    except InputError as error:
        raise error.with_text(f"{end}.file, {error.key}", error.text) from None
    with within(end):
        changes = flattened({key: value for key, value in table.items() if key != "file"})
        return case.replace(changes) if changes else case


AnyCase = Case | BearingCase


def case_of_dict(table: Mapping[str, Any], *, written: bool = False) -> AnyCase:
    """Make a bearing case from tables with a key of bearing files, else a case of a contact. Raises
    InputError if the tables are not valid; the message names the key, its value, and what is allowed.
    """
    model = BearingCase if "bearing" in table or bearing_key(table) is not None else Case
    return model.from_written(table) if written else model.from_dict(table)
