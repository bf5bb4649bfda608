"""Operating point of a drive, its rotor with its weight and forces, and the loads of its bearings by them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, Self

from pydantic import model_validator

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import Contacts
from ehlectric.cases.table import Table, as_mapping
from ehlectric.errors import InputError, for_all
from ehlectric.formulas.shaft_statics import bearing_loads, on_axis, weight_at
from ehlectric.quantities.formats import amount
from ehlectric.quantities.inputs import BOTH, ENDS, end_and_key

# Loads of a bearing.
LOADS = ("radial_load", "axial_load")

# Forces that are no load of a bearing [N], and the difference of two loads that is rounding.
_NO_FORCE, _ROUNDING = 1e-6, 1e-9

# Loads with which other keys of a bearing are checked if its loads are not known [N].
_ANY_LOADS = dict(zip(LOADS, (100.0, 0.0), strict=True))


class Operation(Table, book="drive"):
    """Operating point of the drive, and how long it is looked at."""

    speed: float | None = None
    temperature: float | None = None
    contacts: Contacts | None = None
    duration: float | None = None
    seed: int = 0
    gravity_direction: float = -0.5 * math.pi


class Force(Table, book="axle.force"):
    """Force on a shaft at a place on its axis, with its components along x, y and z."""

    at: float
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class Rotor(Table, book="rotor"):
    """Rotor whose bearings carry its weight and further forces."""

    drive_end_at: float
    non_drive_end_at: float
    mass: float | None = None
    mass_at: float | None = None
    locating: Literal["drive_end", "non_drive_end"] | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_together("mass", "mass_at")
        return self

    def loads(self, forces: Sequence[Force], gravity: float) -> dict[str, dict[str, float]]:
        """Return the loads of a bearing file by the ends [N]; ``gravity``, direction of the weight [rad].

        Raises InputError for bearings at one place, a bearing without a load, and an axial force that no
        bearing locates.
        """
        places = self.drive_end_at, self.non_drive_end_at
        on_rotor = [on_axis(each.at, each.x, each.y, each.z) for each in forces]
        if self.mass is not None and self.mass_at is not None:
            on_rotor.append(weight_at(self.mass, self.mass_at, gravity))
        try:
            carried = bearing_loads(on_rotor, places)
        except InputError:
            raise InputError(
                "rotor.non_drive_end_at",
                got=f"{amount(places[1], 'm')}, the place of the other bearing",
                takes="another place: two bearings at one place carry no moment",
            ) from None
        axial = abs(carried.axial) if abs(carried.axial) > _NO_FORCE else 0.0
        if axial and self.locating is None:
            takes = f"'{ENDS[0]}' or '{ENDS[1]}', the bearing that carries the axial forces"
            raise InputError.missing("rotor.locating", takes)
        loads = {
            end: {LOADS[0]: radial, LOADS[1]: axial if end == self.locating else 0.0}
            for end, radial in zip(ENDS, carried.radial, strict=True)
        }
        for end, of_end in loads.items():
            if max(of_end.values()) <= _NO_FORCE:
                raise InputError(
                    "rotor",
                    got=f"weight and forces that do not load the bearing at {end}",
                    takes="mass and mass_at, or a table [[force]], that load both bearings: a bearing "
                    "without a load has no film that is computed",
                )
        return loads


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
    ends = {end: _loaded(tables.get(end, tables.get(ENDS[0])), loads[end]) for end in ENDS}
    return {**tables, **{end: bearing for end, bearing in ends.items() if bearing is not None}}


def _loads_of(tables: Mapping[str, Any]) -> dict[str, dict[str, float]]:
    forces = tables.get("force") or ()
    return Rotor.from_dict(as_mapping(tables["rotor"])).loads(
        [Force.from_dict(as_mapping(each)) for each in (forces if isinstance(forces, list | tuple) else ())],
        Operation.from_dict(as_mapping(tables.get("drive"))).gravity_direction,
    )


def _given_loads(tables: Mapping[str, Any]) -> Iterator[str]:
    """Dotted keys of loads in the tables of bearings."""
    for end in ENDS:
        table = tables.get(end)
        if isinstance(table, Mapping):
            of_bearing, ranges = (as_mapping(table.get(name)) for name in ("bearing", "ranges"))
            yield from (f"{end}.bearing.{load}" for load in LOADS if of_bearing.get(load) is not None)
            yield from (f"{end}.ranges.bearing.{load}" for load in LOADS if f"bearing.{load}" in ranges)


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


def _loaded(bearing: Any, loads: Mapping[str, float]) -> Any:
    """Bearing of a drive, a case or its tables, with loads [N]."""
    if isinstance(bearing, BearingCase):
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
