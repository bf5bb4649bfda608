"""Tables of an axle in a drive file: operating point, shafts, mounted bearings, gear meshes and links."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, ConfigDict, model_validator

from ehlectric.cases.axle_keys import HOUSING, LOADS
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.defaults import Contacts
from ehlectric.cases.discharge_inputs import AxleDischarge
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.table import Table, Title, any_of, similar_keys
from ehlectric.errors import InputError, for_all, shown

LinkKind = Literal["ring", "brush", "seal", "spline", "coupling", "insulated"]

# Links between two shafts that turn together, and of these the links that conduct.
TURNING: tuple[LinkKind, ...] = ("spline", "coupling", "insulated")
CONDUCTING: tuple[LinkKind, ...] = ("spline", "coupling")

# Back to back, or face to face, which is assumed without a value.
Arrangement = Literal["O", "X"]
ASSUMED_ARRANGEMENT: Arrangement = "X"

# Keys of a bearing that the axle determines.
_OF_AXLE = ("inner_speed", "temperature")


def _two_names(entry: object) -> tuple[str, ...]:
    """Names of two nodes."""
    if (
        not isinstance(entry, list | tuple)
        or not all(isinstance(name, str) for name in entry)
        or len(entry) != 2
    ):
        raise InputError(
            got=shown(entry), takes=f'two names of shafts, as ["rotor", "output"], or {HOUSING!r}'
        )
    if entry[0] == entry[1]:
        raise InputError(got=f"{shown(entry[0])} twice", takes="two different ones")
    return tuple(entry)


_Names = Annotated[tuple[str, ...], BeforeValidator(_two_names)]


def _bearing_keys(keys: object) -> dict[str, Any]:
    """Keys of the table ``bearing`` of a bearing file that the axle does not determine."""
    if not isinstance(keys, Mapping):
        raise InputError(got=shown(keys), takes="a table with keys of bearings")
    for_all(_check_bearing_key, keys)
    return dict(keys)


def _check_bearing_key(key: str) -> None:
    if key in _OF_AXLE:
        raise InputError.worded(key, "is a value of the axle; give it in [drive]")
    if key not in Bearing.known_keys():
        raise InputError.unknown(key, any_of(similar_keys(key, [*Bearing.known_keys()])))


def _shared_keys(keys: object) -> dict[str, Any]:
    """Keys of all bearings, without loads."""
    shared = _bearing_keys(keys)
    for key in LOADS:
        if key in shared:
            raise InputError.worded(key, "is the load of one bearing; give it in its table [[bearing]]")
    return shared


SharedKeys = Annotated[dict[str, Any], BeforeValidator(_shared_keys)]


class AxleOperation(Table, book="axle.drive"):
    """Operating point of an axle, and how long it is simulated."""

    speed: float
    torque: float
    temperature: float
    contacts: Contacts | None = None
    duration: float | None = None
    seed: int = 0
    gravity_direction: float = -0.5 * math.pi

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_not_zero("speed", "the axle does not turn")
        return self

    def check_not_zero(self, key: str, problem: str) -> None:
        """Check that a number is not 0, which is a ``problem``."""
        if getattr(self, key) == 0.0:
            takes = "a value with a sign, about the positive z axis"
            raise InputError(key, got=f"0: {problem}", takes=takes)


class Adjustment(Table, book="axle.adjustment"):
    """Adjustment of two inclined rows against each other: arrangement, and preload or play."""

    arrangement: Arrangement | None = None
    preload: float | None = None
    axial_play: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_alternatives(("preload", "axial_play"), "either preload or axial_play", needed=True)
        return self


class Shaft(Table, book="axle.shaft"):
    """Shaft of an axle; all shafts are parallel to z."""

    name: Title
    rotor: bool = False
    housing_capacitance: float | None = None
    mass: float | None = None
    mass_at: float | None = None
    adjustment: Adjustment | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_together("mass", "mass_at")
        return self


class MountedBearing(Table, book="axle.bearing"):
    """Bearing on a shaft, with further keys of the table ``bearing`` of a bearing file."""

    model_config = ConfigDict(extra="allow")

    shaft: str
    at: float
    locating: bool = False
    lubricant: Lubricant | None = None
    discharge: AxleDischarge | None = None

    @property
    def keys(self) -> dict[str, Any]:
        """Keys of the table ``bearing`` of a bearing file."""
        return dict(self.__pydantic_extra__ or {})

    @property
    def loaded(self) -> bool:
        """Whether the table contains a load."""
        return any(key in self.keys for key in LOADS)

    @model_validator(mode="after")
    def _check(self) -> Self:
        _bearing_keys(self.keys)
        return self


class AxleMesh(Table, book="axle.mesh"):
    """Gear mesh between two shafts."""

    gears: _Names
    at: tuple[float, ...]
    direction: float = 0.0
    contact_resistance: float | None = None
    pair: GearCase

    @model_validator(mode="after")
    def _check(self) -> Self:
        if len(self.at) != 2:
            raise InputError("at", got=f"{len(self.at)} places", takes="two, of gear 1 and of gear 2")
        if self.pair.gear.helix_angle and self.pair.gear.hand is None:
            raise InputError.worded(
                "pair.gear.hand", 'missing; "left" or "right" of gear 1 determines the axial force'
            )
        return self


class Link(Table, book="axle.link"):
    """Electrical connection between two shafts, or between a shaft and the housing."""

    between: _Names
    kind: LinkKind
    resistance: float | None = None
    capacitance: float | None = None

    @property
    def turns(self) -> bool:
        """Whether the link transmits speed and torque from one shaft to the other."""
        return self.kind in TURNING

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.turns and HOUSING in self.between:
            raise InputError("kind", got=f"{self.kind!r} to the housing", takes="'ring', 'brush' or 'seal'")
        needed = {"insulated": "capacitance"}.get(self.kind, None if self.turns else "resistance")
        for key in ("resistance", "capacitance"):
            given = getattr(self, key) is not None
            if given and key != needed:
                raise InputError.worded(key, f"is not used by a link of the kind {self.kind!r}")
            if not given and key == needed:
                raise InputError.worded(key, f"missing; a link of the kind {self.kind!r} needs it")
        return self
