"""Case of an axle: a drive file with shafts that gear meshes connect, read from TOML and written back."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self

from pydantic import Field, field_serializer, field_validator, model_validator
from pydantic.fields import FieldInfo

from ehlectric.cases.amounts import Amount
from ehlectric.cases.axle_inputs import (
    CONDUCTING,
    Adjustment,
    AxleMesh,
    AxleOperation,
    Link,
    MountedBearing,
    Shaft,
    SharedKeys,
)
from ehlectric.cases.axle_keys import ADJUSTED, HOUSING, element_keys, shaft_keys
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Bearing, base_of, typed_base
from ehlectric.cases.bearing_kinds import KINDS_OF_BEARINGS
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.discharge_inputs import AxleDischarge
from ehlectric.cases.drive_case import Connection, NetworkCase, Remedy, with_files
from ehlectric.cases.drive_inputs import Breakdown, Circuit, ShaftForce, Source
from ehlectric.cases.duty_inputs import Duty
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.gear_inputs import Gear
from ehlectric.cases.input_ranges import (
    InputRange,
    check_range,
    field_of_values,
    flat_changes,
    is_changed,
    ranges_of,
    table_of_ranges,
)
from ehlectric.cases.key_names import refuse_deep
from ehlectric.cases.measured_inputs import AxleMeasured
from ehlectric.cases.oil_inputs import displace_oil
from ehlectric.cases.roughness_inputs import find_files
from ehlectric.cases.stated_ranges import with_stated_ranges
from ehlectric.cases.table import Table, Title, number_of
from ehlectric.cases.table_edits import displace, flattened, given_value, nested, set_keys
from ehlectric.errors import InputError, for_all, shown, within
from ehlectric.quantities.alternatives import ALTERNATIVES
from ehlectric.quantities.formats import amount, operating_point, speed_text
from ehlectric.quantities.inputs import end_and_key
from ehlectric.runtime.display import headline, is_number

# Relative difference of speeds along two paths that is rounding.
_ROUNDING = 1e-9

# Tables whose keys displace their alternatives, also keys of all bearings.
_DISPLACED = ("source", "circuit", "lubricant", "discharge", "breakdown")
_SHARED_ALTERNATIVES = {"bearings": ALTERNATIVES["bearing"]}

# Key of a mesh that replaces the same key of its gear file.
_CONTACT = "contact_resistance"

# What stands in a key for the name of one of several tables, and tables of the oil of a bearing.
_PLACES = {"bearing": "SHAFT", "shaft": "SHAFT"} | dict.fromkeys(("mesh", "link", "force"), "NUMBER")
_OF_OIL = ("lubricant", "discharge")
_TABLES_OF_OIL = tuple(f"{name}." for name in _OF_OIL)

# Resistance that removes a link.
NO_LINK = "none"

# Most shafts of an axle.
_MOST_SHAFTS = 20

# Length by which faces of gears may overlap, as rounding [m].
_LEAST_OVERLAP = 1e-6

# Properties in which two gears differ, and their units.
_UNITS_OF_GEARS = {"normal_module": "m", "teeth": "", "normal_pressure_angle": "rad", "helix_angle": "rad"}

# Torque of a gear that stands for none [N m]: oil then fills the backlash.
_NO_TORQUE = 1e-6

# Load with which the keys of a bearing are checked before its loads are known [N].
_CHECK_LOAD = 100.0


@dataclass(frozen=True)
class Turning:
    """Speed of a shaft, and the torque that it gets from the rotor, both about z."""

    speed: float  # [rad/s]
    torque: float  # [N m]


class AxleCase(NetworkCase, book="axle_file"):
    """Axle: inverter, rotor, and shafts that gear meshes connect, with all of their bearings.

    A case is made from a drive file with tables ``[[shaft]]`` by ``from_toml``, or from nested tables by
    ``from_dict``. Wrong inputs raise an ``InputError`` that names their keys. A case is frozen; ``replace``
    returns a changed copy. Numbers are in SI units.

    Parameters
    ----------
    drive : mapping
        Speed and torque of the rotor, and temperature of the oil.
    shaft, bearing, mesh, link, force : sequence of mapping
        Shafts; bearings on them; gear meshes between them; rings, couplings and other links; further forces.
    bearings : mapping, optional
        Keys of all bearings, which the keys of a bearing replace.
    source, circuit : mapping
        Common-mode voltage; capacitances of the machine.
    breakdown : mapping, optional
        Arc and threshold of the films, for discharges over time.
    lubricant : Lubricant or mapping
        Oil of all bearings and meshes.
    discharge : mapping, optional
        Dielectric strength and conductivity of the oil.
    title : str, optional
        Title of tables and figures.
    remedies : sequence of mapping, optional
        Changes that are computed in addition to the axle, each with its title.
    ranges : mapping, optional
        Ranges of uncertain inputs by dotted key, each a list of two values.
    duty : mapping, optional
        Duty cycle: the path of its ``file``.
    measured : mapping, optional
        Measured values that correct the ranges of uncertain inputs.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.AxleCase.from_toml(ehlectric.example("e_axle.toml"))
    >>> [shaft.name for shaft in case.shaft], case.replace({"drive.torque": "50 N m"}).drive.torque
    (['rotor', 'intermediate', 'output'], 50.0)
    """

    if TYPE_CHECKING:

        def __init__(self, **tables: Any) -> None: ...

    _numbered: ClassVar[tuple[str, ...]] = ("shaft", "bearing", "mesh", "link", "force", "remedies")

    title: Title = ""
    drive: AxleOperation
    shaft: tuple[Shaft, ...]
    bearing: tuple[MountedBearing, ...]
    bearings: SharedKeys = Field(default_factory=dict)
    mesh: tuple[AxleMesh, ...] = ()
    link: tuple[Link, ...] = ()
    force: tuple[ShaftForce, ...] = ()
    source: Source
    circuit: Circuit
    breakdown: Breakdown | None = None
    lubricant: Lubricant
    discharge: AxleDischarge = AxleDischarge()
    remedies: tuple[Remedy, ...] = ()
    ranges: tuple[InputRange, ...] | None = None
    duty: Duty | None = None
    measured: AxleMeasured | None = None

    @model_validator(mode="before")
    @classmethod
    def _with_uncertainties(cls, tables: Any) -> Any:
        """Inputs that are written with their uncertainty have their middle, and ``ranges`` has their ends."""
        if not isinstance(tables, Mapping):
            return tables
        stated = with_stated_ranges(tables, _quantity_of)
        if isinstance(stated.get("ranges"), Mapping):
            stated["ranges"] = {_named(key, stated): ends for key, ends in stated["ranges"].items()}
        return stated

    @field_validator("ranges", mode="plain")
    @classmethod
    def _parsed(cls, tables: Any) -> tuple[InputRange, ...] | None:
        """Ranges of inputs in SI units."""
        return None if tables is None else ranges_of(tables, cls, _field_of) or None

    @field_serializer("ranges")
    def _as_table(self, ranges: tuple[InputRange, ...] | None) -> dict[str, list[int | float]] | None:
        return table_of_ranges(ranges)

    @classmethod
    def of_file(cls, table: dict[str, Any], path: Path) -> Self:
        """Make a case from the tables of the file at a path, with the gear files that its meshes name."""
        return cls.from_written(with_gear_files(table, path.parent))

    @classmethod
    def missing_table_hint(cls, key: str, given: Mapping[str, Any]) -> str:  # noqa: ARG003
        """Return the text that a drive file names a gear file instead."""
        return "; or file, the path of a gear file" if key == "mesh.pair" else ""

    @property
    def rotor_name(self) -> str:
        """Name of the shaft of the rotor."""
        return next(shaft.name for shaft in self.shaft if shaft.rotor)

    @property
    def shaft_names(self) -> tuple[str, ...]:
        """Names of all shafts."""
        return tuple(shaft.name for shaft in self.shaft)

    def connections(self) -> Iterator[Connection]:
        """Yield capacitances of shafts to the housing, and links."""
        for shaft in self.shaft:
            if shaft.housing_capacitance is not None:
                yield Connection(f"{shaft.name} and housing", shaft.name, HOUSING, shaft.housing_capacitance)
        for number, link in enumerate(self.link, 1):
            conductance = 0.0 if link.resistance is None else 1.0 / link.resistance
            first, second = link.between
            conducts = link.kind in CONDUCTING
            yield Connection(f"link {number}", first, second, link.capacitance or 0.0, conducts, conductance)

    @property
    def geared_shafts(self) -> set[str]:
        """Names of the shafts with gears."""
        return {name for mesh in self.mesh for name in mesh.gears}

    @property
    def placed_forces(self) -> list[tuple[str, ShaftForce]]:
        """Forces with the names of their shafts."""
        return [(force.shaft or "", force) for force in self.force]

    @property
    def loaded_shafts(self) -> set[str]:
        """Names of the shafts whose bearing loads follow from statics: with gears, a mass or a force."""
        return {
            *self.geared_shafts,
            *(shaft.name for shaft in self.shaft if shaft.mass is not None),
            *(shaft for shaft, _ in self.placed_forces),
        }

    @property
    def solves_films(self) -> bool:
        """Whether films of a bearing or a mesh are solved numerically."""
        chosen = self.drive.contacts
        return "solved" in ([mesh.pair.contacts for mesh in self.mesh] if chosen is None else [chosen])

    @property
    def quick(self) -> AxleCase:
        """Axle with films from the atlas or from formulas instead of solved ones."""
        return self.replace({"drive.contacts": "atlas"}) if self.solves_films else self

    @property
    def running_speed(self) -> float:
        """Speed of the rotor [rad/s]."""
        return self.drive.speed

    @property
    def edge(self) -> float:
        """Largest edge of a described common-mode voltage [V]: a third of the DC link's voltage."""
        assert self.source.dc_link is not None
        return self.source.dc_link / 3.0

    def bearings_of(self, shaft: str) -> list[int]:
        """Return the numbers of the bearings on a shaft, from 0."""
        return [number for number, bearing in enumerate(self.bearing) if bearing.shaft == shaft]

    def names_of_bearings(self) -> list[str]:
        """Return names of all bearings: the shaft, and the number on it."""
        return [
            f"bearing {self.bearings_of(bearing.shaft).index(number) + 1} of {bearing.shaft}"
            for number, bearing in enumerate(self.bearing)
        ]

    def names_of_meshes(self) -> list[str]:
        """Return names of all meshes by their shafts."""
        return [f"mesh of {' and '.join(mesh.gears)}" for mesh in self.mesh]

    def keys_of_elements(self) -> dict[str, str]:
        """Return the names of bearings and meshes by their keys in the tables of a sweep.

        A bearing has the key "SHAFT_NUMBER", and a mesh the key "mesh_NUMBER".
        """
        keys = element_keys([bearing.shaft for bearing in self.bearing], len(self.mesh))
        return dict(zip(keys, [*self.names_of_bearings(), *self.names_of_meshes()], strict=True))

    def keys_of_shafts(self) -> dict[str, str]:
        """Return the names of shafts by their keys in the tables of a sweep."""
        names = [shaft.name for shaft in self.shaft]
        return dict(zip(shaft_keys(names), names, strict=True))

    def bearing_case(self, number: int, speed: float, radial: float, axial: float) -> BearingCase:
        """Case of a bearing at a speed [rad/s] and loads [N]."""
        loads = {"radial_load": radial, "axial_load": axial}
        operation = {"inner_speed": abs(speed), "temperature": self.drive.temperature}
        keys = loads | self.keys_of_bearing(number) | operation
        table = {
            "contacts": self.drive.contacts or "atlas",
            "bearing": keys,
            "lubricant": self.oil_of(number).model_copy(),
        }
        with self.naming(number):
            if not any(keys[load] for load in loads):
                raise InputError(
                    "bearing.at",
                    got="a place at which the forces on the shaft do not load the bearing",
                    takes="another place of this bearing, of a gear or of a force: a bearing without a load "
                    "has no film that is computed",
                )
            return BearingCase.from_dict(table | {"discharge": _tables_of(self.strength_of(number))})

    @property
    def strengths(self) -> tuple[AxleDischarge, ...]:
        """Tables ``discharge`` of all bearings."""
        return tuple(self.strength_of(number) for number in range(len(self.bearing)))

    @property
    def has_strength(self) -> bool:
        """Whether the oil of the axle, or of a bearing, has a dielectric strength."""
        return any(each.has_strength for each in (self.discharge, *self.strengths))

    def strength_in(self, name: str) -> AxleDischarge:
        """Return the table ``discharge`` of a bearing or a mesh with a name."""
        names = self.names_of_bearings()
        return self.strength_of(names.index(name)) if name in names else self.discharge

    def oil_of(self, number: int) -> Lubricant:
        """Return the oil of a bearing: its own, or the oil of the axle."""
        return self.bearing[number].lubricant or self.lubricant

    def strength_of(self, number: int) -> AxleDischarge:
        """Return the table ``discharge`` of a bearing: its own, or the table of the axle."""
        return self.bearing[number].discharge or self.discharge

    def keys_of_bearing(self, number: int) -> dict[str, Any]:
        """Return the keys of a bearing, which replace keys of all bearings and their alternatives."""
        return _set_in("bearing", deepcopy(self.bearings), self.bearing[number].keys)

    def parts(self) -> dict[str, BearingCase | GearCase]:
        """Return the cases of all bearings, with a load of 100 N, and of all meshes by their names."""
        turning, bearings, meshes = self.turning(), self.names_of_bearings(), self.names_of_meshes()
        return {
            **{
                name: self.bearing_case(number, self.drive.speed, _CHECK_LOAD, 0.0)
                for number, name in enumerate(bearings)
            },
            **{name: self.gear_case(number, turning) for number, name in enumerate(meshes)},
        }

    @contextmanager
    def naming(self, number: int) -> Iterator[None]:
        """Context in which an error names a bearing."""
        try:
            yield
        except InputError as error:
            text = f"{error.text} ({self.names_of_bearings()[number]})"
            table, dot, key = (error.key or "bearing").partition(".")
            place = f"{table}.{number + 1}" if table == "bearing" else table
            raise error.with_text(f"{place}{dot}{key}", text) from None

    def gear_case(self, number: int, turning: Mapping[str, Turning]) -> GearCase:
        """Case of the gear pair of a mesh, at the speeds and torques of all shafts by their names.

        The difference between flanks and oil is the difference in the gear file.
        """
        pair = self.mesh[number].pair
        table = pair.to_dict()
        for name in ("ranges", "duty"):
            table.pop(name, None)
        if self.drive.contacts is not None:
            table["contacts"] = self.drive.contacts
        table["gear"]["operation"] |= self.gear_operation(number, turning)
        if self.mesh[number].contact_resistance is not None:
            set_keys(table, {f"gear.contact.{_CONTACT}": self.mesh[number].contact_resistance})
        with within(f"mesh.{number + 1}.pair"):
            return GearCase.from_dict(
                table | {"lubricant": self.lubricant.model_copy(), "discharge": _tables_of(self.discharge)}
            )

    def gear_operation(self, number: int, turning: Mapping[str, Turning]) -> dict[str, float | str]:
        """Return the values of ``gear.operation`` that the axle replaces in the file of a mesh."""
        mesh, torque = self.mesh[number], self.torque_of_gear(number, turning) or _NO_TORQUE
        speed = turning[mesh.gears[0]].speed
        of_file = mesh.pair.gear.operation
        bulk = of_file.bulk_temperature
        if not isinstance(bulk, str):
            bulk += self.drive.temperature - of_file.oil_temperature
        return {
            "pinion_torque": math.copysign(torque, torque * speed),
            "pinion_speed": abs(speed),
            "oil_temperature": self.drive.temperature,
            "bulk_temperature": bulk,
        }

    def torque_of_gear(self, number: int, turning: Mapping[str, Turning]) -> float:
        """Return the torque about z with which a shaft turns gear 1 of a mesh [N m]."""
        mesh = self.mesh[number]
        first, second = (turning[name].torque for name in mesh.gears)
        # The gear that is nearer to the rotor has the torque of its shaft; the other shaft gets what is left.
        return first if _nearer(mesh.gears, turning) else second / _ratio(mesh)

    def turning(self) -> dict[str, Turning]:
        """Return speeds and torques of all shafts by their names, those nearer to the rotor first.

        A mesh of the ratio u = z_2/z_1 turns gear 2 with -omega_1/u, and gives it the torque -u T_1. Raises
        InputError for ratios that contradict each other, for a shaft that nothing turns, and for torques
        that take two paths.
        """
        done = {self.rotor_name: Turning(self.drive.speed, self.drive.torque)}
        used: set[int] = set()
        divided: list[InputError] = []
        joints = [*self._joints()]
        for name in _growing(done):
            further: dict[str, str] = {}
            for number, (key, first, second, ratio) in enumerate(joints):
                if number in used or name not in (first, second):
                    continue
                used.add(number)
                other, factor = (second, ratio) if name == first else (first, 1.0 / ratio)
                speed = done[name].speed / factor
                if other in done:
                    raise _second_path(key, other, speed, done[other].speed)
                further[other] = key
                done[other] = Turning(speed, factor * done[name].torque)
            if len(further) > 1:
                divided.append(_divided(name, further))
        if divided:
            raise divided[0]
        for number, shaft in enumerate(self.shaft, 1):
            if shaft.name not in done:
                raise InputError.worded(
                    f"shaft.{number}.name", f"shaft {shaft.name!r} has no mesh or coupling towards the rotor"
                )
        return done

    def ratio_to(self, name: str | None) -> float:
        """Return the speed of the rotor divided by the speed of a shaft, by default of the slowest one.

        Raises InputError if the axle does not contain the shaft.
        """
        speeds = {shaft: abs(turning.speed) for shaft, turning in self.turning().items()}
        if name is not None and name not in speeds:
            takes = " or ".join(repr(shaft) for shaft in speeds)
            raise InputError("duty.vehicle.shaft", got=shown(name), takes=takes)
        return speeds[self.rotor_name] / (min(speeds.values()) if name is None else speeds[name])

    def _joints(self) -> Iterator[tuple[str, str, str, float]]:
        """Joints that turn shafts: key, first and second shaft, torque of the second over the first."""
        for number, mesh in enumerate(self.mesh, 1):
            yield f"mesh.{number}.gears", mesh.gears[0], mesh.gears[1], -_ratio(mesh)
        for number, link in enumerate(self.link, 1):
            if link.turns:
                yield f"link.{number}.between", link.between[0], link.between[1], 1.0

    @model_validator(mode="after")
    def _check(self) -> Self:
        self._check_names()
        for_all(self._check_bearings, self.shaft)
        if self.mesh and not (self.force or any(shaft.mass is not None for shaft in self.shaft)):
            with within("drive"):
                self.drive.check_not_zero("torque", "no mesh carries a load")
        turning = self.turning()
        self._check_gears()
        for_all(self._check_load, range(len(self.bearing)))
        for_all(lambda number: self.gear_case(number, turning), range(len(self.mesh)))
        for_all(self._check_kind, range(len(self.bearing)))
        axial = {name for mesh in self.mesh if mesh.pair.gear.helix_angle for name in mesh.gears}
        axial |= {shaft for shaft, force in self.placed_forces if force.z}

        def check_axial(shaft: Shaft) -> None:
            if self._check_adjusted(shaft) is None:
                self._check_locating(shaft, axial=shaft.name in axial)

        for_all(check_axial, self.shaft)
        self._check_measured()
        for_all(self._check_span, self.ranges or ())
        return self

    def _check_span(self, span: InputRange) -> None:
        self.check_shared(span.key)
        check_range(span, self.value_of(span.key))

    def value_of(self, key: str) -> Any:
        """Return the value of a dotted key as ``replace`` takes it, of several parts the first."""
        end, inner = end_and_key(key)
        kind, _, name = end.partition(".")
        tables: Any = self.to_dict()
        if kind:
            number = 0 if name == "*" else self.places_of(key)[0]
            table = tables[kind][number]
            tables = {"axle": {kind: table}}
            if kind == "bearing":
                solved = {
                    "bearing": self.tables_of_bearings[number],
                    "lubricant": self.oil_of(number),
                    "discharge": self.strength_of(number),
                }
                tables = {table: values.model_dump(mode="json") for table, values in solved.items()}
            elif kind == "mesh":
                tables = table["pair"]
        return given_value(tables, inner)

    def _check_measured(self) -> None:
        """Check that measured values belong to elements and shafts of the axle."""
        if self.measured is None:
            return
        known = {"elements": self.keys_of_elements(), "shafts": self.keys_of_shafts()}
        for place, keys in known.items():
            for key in getattr(self.measured, place):
                if key not in keys:
                    raise InputError(
                        f"measured.{place}.{key}", got=shown(key), takes=f"one of {', '.join(keys)}"
                    )

    def _check_names(self) -> None:
        names = [shaft.name for shaft in self.shaft]
        twice = [name for name, count in Counter(names).items() if count > 1]
        if twice or HOUSING in names or "" in names:
            name = twice[0] if twice else HOUSING if HOUSING in names else ""
            number = len(names) - names[::-1].index(name)
            raise InputError(f"shaft.{number}.name", got=repr(name), takes="a name of its own for each shaft")
        if len(names) > _MOST_SHAFTS:
            raise InputError("shaft", got=f"{len(names)} shafts", takes=f"at most {_MOST_SHAFTS}")
        rotors = [shaft.name for shaft in self.shaft if shaft.rotor]
        if len(rotors) != 1:
            got = f"{len(rotors)} shafts with rotor = true" if rotors else "no shaft with rotor = true"
            number = names.index(rotors[-1]) + 1 if rotors else 1
            raise InputError(f"shaft.{number}.rotor", got=got, takes="one: [circuit] acts on it")
        places = (
            *((f"bearing.{n}.shaft", bearing.shaft, False) for n, bearing in enumerate(self.bearing, 1)),
            *((f"force.{n}.shaft", shaft, False) for n, (shaft, _) in enumerate(self.placed_forces, 1)),
            *((f"mesh.{n}.gears", name, False) for n, mesh in enumerate(self.mesh, 1) for name in mesh.gears),
            *(
                (f"link.{n}.between", name, True)
                for n, link in enumerate(self.link, 1)
                for name in link.between
            ),
        )

        def check_place(place: tuple[str, str, bool]) -> None:
            key, name, housing = place
            if name not in names and not (housing and name == HOUSING):
                takes = ", ".join(map(repr, [*names, HOUSING] if housing else names))
                raise InputError(key, got=repr(name) if name else None, takes=f"one of {takes}")

        for_all(check_place, places)

    def _check_bearings(self, shaft: Shaft) -> None:
        """Check that a shaft has two bearings."""
        numbers = self.bearings_of(shaft.name)
        if not numbers:
            raise InputError.worded(
                f"shaft.{self.shaft.index(shaft) + 1}.name",
                f"shaft {shaft.name!r} has no path to the housing; give it two bearings",
            )
        if len(numbers) != 2:
            raise InputError(
                f"bearing.{numbers[-1] + 1}.shaft",
                got=f"{len(numbers)} on shaft {shaft.name!r}",
                takes="two: the loads of more bearings do not follow from statics",
            )

    def _check_locating(self, shaft: Shaft, *, axial: bool) -> None:
        """Check that one bearing carries the axial force of a shaft."""
        numbers = self.bearings_of(shaft.name)
        locating = sum(self.bearing[number].locating for number in numbers)
        if locating > 1 or (axial and locating != 1):
            raise InputError(
                f"bearing.{numbers[-1] + 1}.locating",
                got=f"{locating} of the bearings of shaft {shaft.name!r}",
                takes="one, which carries the axial force of the shaft",
            )

    def _kind_of(self, number: int) -> str:
        """Kind of a bearing before its other keys are checked, given or from its ``base``."""
        keys = self.keys_of_bearing(number)
        if "kind" in keys or typed_base(keys) is None:
            return str(keys.get("kind"))
        with self.naming(number), within("bearing"):
            return str(base_of(keys)[1]["kind"])

    @cached_property
    def tables_of_bearings(self) -> tuple[Bearing, ...]:
        """Tables ``bearing`` of all bearings, with any load."""
        return tuple(
            self.bearing_case(number, self.drive.speed, _CHECK_LOAD, 0.0).bearing
            for number in range(len(self.bearing))
        )

    def _inclined(self, shaft: str) -> list[int]:
        """Numbers of the single bearings with inclined rows on a shaft whose axial loads are not given."""
        tables = {number: self.tables_of_bearings[number] for number in self.bearings_of(shaft)}
        return [
            number
            for number, bearing in tables.items()
            if bearing.kind in ADJUSTED
            and bearing.pair is None
            and "axial_load" not in self.bearing[number].keys
        ]

    def adjustment_of(self, shaft: Shaft) -> Adjustment | None:
        """Return the adjustment of both bearings of a shaft against each other; None if they are not
        adjusted.
        """
        return (shaft.adjustment or Adjustment(axial_play=0.0)) if self._inclined(shaft.name) else None

    def _check_adjusted(self, shaft: Shaft) -> Adjustment | None:
        """Adjustment of both bearings of a shaft; refuse single inclined rows that are not adjusted."""
        inclined, numbers = self._inclined(shaft.name), self.bearings_of(shaft.name)
        kinds = [self.tables_of_bearings[number].kind for number in numbers]
        names = f"{' and '.join(dict.fromkeys(kinds))} bearings on shaft {shaft.name!r}"
        if not inclined:
            if shaft.adjustment is not None:
                takes = "two tapered roller or two angular-contact ball bearings, without pair and loads"
                place = self.shaft.index(shaft) + 1
                raise InputError(f"shaft.{place}.adjustment", got=f"it with {names}", takes=takes)
            return None
        if len(inclined) == 1 or len({*kinds}) > 1:
            raise InputError(
                f"bearing.{numbers[-1] + 1}.base",
                got=names,
                takes="two of one kind, which are adjusted against each other, or a pair at one place: the "
                "axial load of a single inclined row depends on a second one",
            )
        if shaft.name not in self.loaded_shafts:
            raise InputError.worded(
                f"bearing.{numbers[0] + 1}.axial_load",
                f"missing; shaft {shaft.name!r} has no gears, no mass and no force that load its bearings",
            )
        locating = [number for number in numbers if self.bearing[number].locating]
        if locating:
            raise InputError.worded(
                f"bearing.{locating[0] + 1}.locating",
                f"is not used by {names}: both carry axial forces",
            )
        return self.adjustment_of(shaft)

    def _check_gears(self) -> None:
        """Check that the faces of a mesh overlap, and that gears at one place of a shaft are one gear with
        two meshes.
        """

        def check_overlap(place: int) -> None:
            mesh = self.mesh[place - 1]
            width = mesh.pair.gear.face_width
            if abs(mesh.at[0] - mesh.at[1]) > 0.5 * width:
                raise InputError(
                    f"mesh.{place}.at",
                    got=" and ".join(amount(at, "m") for at in mesh.at),
                    takes=f"places at most half of the face width, {amount(width, 'm')}, apart, so that the "
                    "faces overlap; z has one origin for all shafts",
                )

        for_all(check_overlap, range(1, len(self.mesh) + 1))
        placed = [
            (name, at, mesh.pair.gear.face_width, _gear_of(mesh.pair.gear, number), place)
            for place, mesh in enumerate(self.mesh, 1)
            for number, (name, at) in enumerate(zip(mesh.gears, mesh.at, strict=True))
        ]
        for (shaft, at, width, gear, _), (other, there, breadth, second, place) in combinations(placed, 2):
            if (
                shaft == other
                and gear != second
                and abs(at - there) < 0.5 * (width + breadth) - _LEAST_OVERLAP
            ):
                key = next(key for key in gear if gear[key] != second[key])
                values = " and ".join(amount(each[key], _UNITS_OF_GEARS[key]) for each in (gear, second))
                raise InputError(
                    f"mesh.{place}.at",
                    got=f"two gears at one place of shaft {shaft!r}, with {key} of {values}",
                    takes="places at least half of both face widths apart, or one gear with two meshes",
                )

    def _check_load(self, number: int) -> None:
        """Check that a bearing has no load if it follows from statics, and otherwise has one."""
        bearing, loaded = self.bearing[number], self.loaded_shafts
        load = "axial" if "axial_load" in bearing.keys and "radial_load" not in bearing.keys else "radial"
        key, name = f"bearing.{number + 1}.{load}_load", bearing.shaft
        if name in loaded and bearing.loaded:
            text = f"shaft {name!r} has gears, a mass or a force, from which its loads follow"
            raise InputError.worded(key, text)
        if name not in loaded and not bearing.loaded:
            text = f"missing; shaft {name!r} has no gears, no mass and no force that load its bearings"
            raise InputError.worded(key, text)

    def _check_kind(self, number: int) -> None:
        """Check that a bearing carries radial loads."""
        kind = self._kind_of(number)
        if kind in KINDS_OF_BEARINGS and not KINDS_OF_BEARINGS[kind].radial:
            takes = "one that carries radial loads"
            raise InputError(f"bearing.{number + 1}.base", got=f"a {kind} bearing", takes=takes)

    def _speeds(self, table: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
        yield table["drive"], "speed"
        if self.circuit.grounding_ring_table is not None:
            yield table["circuit"]["grounding_ring_table"], "speed"
        for mesh in table.get("mesh", ()):
            yield mesh["pair"]["gear"]["operation"], "pinion_speed"

    def _headline(self) -> str:
        """Title, number of shafts, torque and speed on one line."""
        count = len(self.shaft)
        return headline(
            self.title,
            "1 shaft" if count == 1 else f"{count} shafts",
            amount(self.drive.torque, "N m"),
            *operating_point(self.drive.speed, self.drive.temperature, "degC"),
        )

    def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
        """Return a changed copy of the case.

        Parameters
        ----------
        changes : mapping, optional
            New values by dotted key, as in ``{"drive.torque": "-30 N m"}``. ``bearing.SHAFT.KEY`` is a key
            of all bearings of a shaft, and ``shaft.SHAFT.KEY`` a key of the shaft. ``mesh.NUMBER.KEY`` is a
            key of the gear file of a mesh, from 1, and ``mesh.gear.KEY`` a key of all gear files.
            ``force.NUMBER.KEY`` is a key of a force, from 1.
            ``link.KIND.KEY`` is a key of all links of a kind, and ``link.NUMBER.KEY`` a key of a link;
            ``"none"`` as their resistance removes links. The tables of a list are also given as a whole, as
            in ``{"link": []}``.
        **tables
            New values by table, as in ``drive={"speed": "6000 rpm"}``.
        """
        refuse_deep({**tables, "changes": changes})
        flat = flat_changes(tables) | dict(changes or {})
        table = self.to_dict()
        if "lubricant.base" in flat or "lubricant" in flat:
            table["lubricant"] = {}
        displace_oil(table["lubricant"], nested(flat, "lubricant"))
        displace(table, flat, {name: ALTERNATIVES[name] for name in _DISPLACED} | _SHARED_ALTERNATIVES)
        lists = {
            **dict.fromkeys(("bearing", "shaft", "force"), self._change_entries),
            "mesh": self._change_mesh,
            "link": self._change_links,
        }
        inner = {key: value for key, value in flat.items() if "." in key and key.split(".")[0] in lists}
        set_keys(table, {key: value for key, value in flat.items() if key not in inner})
        if "ranges" in table and "ranges" not in flat:
            ranges = table["ranges"].items()
            table["ranges"] = {key: ends for key, ends in ranges if not is_changed(key, flat)}
        for key, value in inner.items():
            name, _, rest = (*key.split(".", 2), "", "")[:3]
            lists[name](table, key, {rest: value})
        return self.from_dict(table)

    def places_of(self, key: str) -> list[int]:
        """Return the places, from 0, of the bearings, shafts, meshes, links or forces that a key changes.

        Raises InputError if the axle does not have one.
        """
        kind, place, rest = (*key.split(".", 2), "", "")[:3]
        named: dict[str, list[int]] = {}
        for number, names in enumerate(self._names_in_keys(kind)):
            for name in names:
                named.setdefault(name, []).append(number)
        if place not in named or not rest:
            takes = f"{kind}.{_PLACES[kind]}.KEY with one of {', '.join(named)}"
            takes = takes if named else f"another key, as the axle has no {kind}"
            raise InputError(key, got=shown(place), takes=takes)
        return named[place]

    def _names_in_keys(self, kind: str) -> Iterator[tuple[str, ...]]:
        """Names in keys of each bearing, shaft, mesh, link or force, in their order."""
        entries: Sequence[Any] = getattr(self, kind)
        for number, entry in enumerate(entries, 1):
            others = {"mesh": "gear", "link": getattr(entry, "kind", "")}
            if kind in ("bearing", "shaft"):
                yield (entry.shaft if kind == "bearing" else entry.name,)
            else:
                yield (str(number), others[kind]) if kind in others else (str(number),)

    def check_shared(self, key: str) -> None:
        """Raise an InputError for a key of ``bearings`` that each bearing replaces by its own value."""
        table, _, name = key.partition(".")
        if table == "bearings" and name and all(name in bearing.keys for bearing in self.bearing):
            known = f"bearing.{self.shaft[0].name}.{name}"
            raise InputError.worded(key, f"has no effect, as each bearing has its own; vary {known}")

    def _change_entries(self, table: dict[str, Any], key: str, change: Mapping[str, Any]) -> None:
        """Change a key of a shaft, its bearings or a force in the tables of a case."""
        kind = key.partition(".")[0]
        for number in self.places_of(key):
            entry = table[kind][number]
            for name in _OF_OIL:
                # A new table of one bearing begins with the table of the axle.
                if (
                    kind == "bearing"
                    and name not in entry
                    and any(each.startswith(f"{name}.") for each in change)
                ):
                    entry[name] = deepcopy(table[name])
            _set_in(kind, entry, change)

    def _change_mesh(self, table: dict[str, Any], key: str, change: Mapping[str, Any]) -> None:
        """Change a key in the gear file of a mesh, or in all gear files, in the tables of a case."""
        of_all = key.startswith("mesh.gear.")
        changes = {f"gear.{name}": value for name, value in change.items()} if of_all else change
        if _CONTACT in change:
            table["mesh"][self.places_of(key)[0]] |= change
            return
        for number in self.places_of(key):
            mesh = table["mesh"][number]
            if f"gear.contact.{_CONTACT}" in changes:
                mesh.pop(_CONTACT, None)
            with within("mesh" if of_all else f"mesh.{number + 1}"):
                mesh["pair"] = GearCase.from_dict(mesh["pair"]).replace(changes).to_dict()

    def _change_links(self, table: dict[str, Any], key: str, change: Mapping[str, Any]) -> None:
        """Change a key in a link, or in all links of a kind, in the tables of a case; or remove links."""
        links = table.get("link", [])
        chosen = [links[number] for number in self.places_of(key)]
        if change.get("resistance") == NO_LINK:
            table["link"] = [link for link in links if not any(link is each for each in chosen)]
            return
        if "between" in change and len(chosen) > 1:
            raise InputError(key, got=f"{len(chosen)} links", takes="link.NUMBER.between, of one link")
        for link in chosen:
            link.update(change)


def _named(key: str, tables: Mapping[str, Any]) -> str:
    """Key of a shaft with its name instead of its number, from 1, in the list of shafts; or any other key.

    Raises InputError for a key of one bearing by its number: a range holds for both bearings of a shaft.

    Examples
    --------
    >>> _named("shaft.2.mass", {"shaft": [{"name": "rotor"}, {"name": "wheel"}]})
    'shaft.wheel.mass'
    """
    kind, _, rest = key.partition(".")
    number, _, inner = rest.partition(".")
    entries = tables.get(kind)
    if kind not in ("shaft", "bearing") or not number.isdecimal() or not isinstance(entries, list | tuple):
        return key
    names = [
        each.get("name" if kind == "shaft" else "shaft") for each in entries if isinstance(each, Mapping)
    ]
    if number in names or not 1 <= int(number) <= len(names):
        return key
    named = f"{kind}.{names[int(number) - 1]}.{inner}"
    if kind == "bearing":
        got = f"a range of one bearing of shaft {names[int(number) - 1]!r}"
        raise InputError(key, got=got, takes=f"a range of both, {named!r} in [ranges]")
    return named


def _field_of(key: str) -> FieldInfo:
    """Field of a dotted key of an axle, as ``replace`` takes it."""
    end, inner = end_and_key(key)
    files: Mapping[str, type[Table]] = {"bearing": BearingCase, "mesh": GearCase}
    model = files.get(end.partition(".")[0], AxleCase)
    try:
        return field_of_values(inner.removeprefix("axle."), model)
    except InputError as error:
        raise error.with_text(key, error.text) from None


def _quantity_of(key: str) -> Amount | None:
    """Quantity of a dotted key of an axle; None for a key that is none."""
    try:
        quantity = number_of(_field_of(key))
    except InputError:
        return None
    return quantity if isinstance(quantity, Amount) else None


# Tables whose numbers may change without new rules for bearings and meshes.
_QUICK: Mapping[str, type[Table]] = {
    "drive": AxleOperation,
    "circuit": Circuit,
    "discharge": AxleDischarge,
}


def changed_axle(case: AxleCase, changes: Mapping[str, Any]) -> AxleCase:
    """Changed copy of a case as ``replace`` makes it, in a tenth of the time if only numbers of ``drive``,
    ``circuit`` and ``discharge`` change that the case contains. Raises InputError as ``replace`` does.
    """
    tables: dict[str, dict[str, Any]] = {}
    for key, value in changes.items():
        name, _, leaf = key.partition(".")
        if case.ranges or name not in _QUICK or not is_number(getattr(getattr(case, name), leaf, None)):
            return case.replace(changes)
        tables.setdefault(name, {})[leaf] = value
    update = {}
    for name, values in tables.items():
        table = getattr(case, name).model_dump(mode="json", exclude_none=True)
        with within(name):
            update[name] = _QUICK[name].from_dict(table | values)
    return case.model_copy(update=update)


def changed_bearings(case: AxleCase, values: Mapping[int, Mapping[str, float]]) -> AxleCase:
    """Copy of a case with new numbers of single bearings, by the number of the bearing and the key.

    The copy has no ranges. Its bearings are checked when they are solved.
    """
    bearings = [*case.bearing]
    for number, changes in values.items():
        of_oil = {key: value for key, value in changes.items() if key.startswith(_TABLES_OF_OIL)}
        others = {key: value for key, value in changes.items() if key not in of_oil}
        keys = _set_in("bearing", dict(bearings[number].keys), others)
        mounted = bearings[number].model_copy(update=_changed_oil(case, number, of_oil) if of_oil else None)
        object.__setattr__(mounted, "__pydantic_extra__", keys)
        bearings[number] = mounted
    return case.model_copy(update={"bearing": tuple(bearings), "ranges": None})


def _changed_oil(case: AxleCase, number: int, changes: Mapping[str, float]) -> dict[str, Any]:
    """Tables of the oil of a bearing with new numbers."""
    given = {"lubricant": case.oil_of(number), "discharge": case.strength_of(number)}
    tables = {name: each.model_dump(mode="json", exclude_none=True) for name, each in given.items()}
    _set_in("bearing", tables, changes)
    names = {key.partition(".")[0] for key in changes}
    return {name: type(given[name]).from_dict(tables[name]) for name in names}


def _set_in(name: str, table: dict[str, Any], change: Mapping[str, Any]) -> dict[str, Any]:
    """Set dotted keys of a table with a name, and remove their alternatives from it and from its own oil."""
    tables, flat = {name: table}, {f"{name}.{key}": value for key, value in change.items()}
    if any(key.startswith(_TABLES_OF_OIL) for key in change):
        tables, flat = tables | table, flat | flattened(change)
        displace_oil(table.get("lubricant", {}), nested(change, "lubricant"))
    displace(tables, flat, {each: ALTERNATIVES[each] for each in tables.keys() & ALTERNATIVES.keys()})
    set_keys(table, change)
    return table


def _tables_of(discharge: AxleDischarge) -> dict[str, Any]:
    """Given keys of a table ``discharge``."""
    return discharge.model_dump(mode="json", exclude_none=True, exclude_defaults=True)


def _gear_of(gear: Gear, number: int) -> dict[str, float]:
    """Properties that gear 1 (number 0) or gear 2 of a pair has in all of its meshes; SI units."""
    mirrored = number == 1 and gear.teeth[1] > 0
    helix = gear.helix_angle * (1.0 if gear.hand == "right" else -1.0)
    return {
        "normal_module": gear.normal_module,
        "teeth": float(gear.teeth[number]),
        "normal_pressure_angle": gear.normal_pressure_angle,
        "helix_angle": -helix if mirrored else helix,
    }


def _ratio(mesh: AxleMesh) -> float:
    """Ratio z_2/z_1 of a mesh, negative with a ring."""
    first, second = mesh.pair.gear.teeth
    return second / first


def _nearer(gears: tuple[str, ...], turning: Mapping[str, Turning]) -> bool:
    """Whether the shaft of gear 1 is nearer to the rotor: it comes first."""
    order = list(turning)
    return order.index(gears[0]) < order.index(gears[1])


def _growing(names: Mapping[str, Any]) -> Iterator[str]:
    """Names of a table that grows while it is read."""
    number = 0
    while number < len(names):
        yield list(names)[number]
        number += 1


def _second_path(key: str, name: str, speed: float, known: float) -> InputError:
    """Error of a shaft that turns by two paths."""
    if abs(speed - known) > _ROUNDING * abs(known):
        return InputError(
            key,
            got=f"{speed_text(speed)} of shaft {name!r} by this path, and {speed_text(known)} by another",
            takes="ratios that agree",
        )
    return InputError.worded(key, f"shaft {name!r} turns by two paths; a torque that divides is not computed")


def _divided(name: str, driven: Mapping[str, str]) -> InputError:
    """Error of a shaft that drives several shafts; ``driven`` has their names and the keys of the joints."""
    joints = " and ".join(f"{other!r} by {key}" for other, key in driven.items())
    text = f"shaft {name!r} drives {joints}; a torque that divides is not computed, so remove one of them"
    return InputError.worded([*driven.values()][-1], text)


def with_gear_files(table: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Tables of any case with the tables of its bearing and gear files, and the paths of all other files.

    Names are relative to a folder. Raises InputError if a file cannot be read or is not valid.
    """
    tables = with_files(table, folder)
    mounted = tables.get("bearing")
    for each in mounted if isinstance(mounted, list) else ():
        if isinstance(each, dict):
            find_files(each, folder)
    meshes = tables.get("mesh")
    if not isinstance(meshes, list):
        return tables
    return {**tables, "mesh": [_with_pair(number, mesh, folder) for number, mesh in enumerate(meshes, 1)]}


def _with_pair(number: int, mesh: Any, folder: Path) -> Any:
    """Table of a mesh with the tables of the gear file that it names."""
    if not isinstance(mesh, Mapping) or "file" not in mesh:
        return mesh
    name = mesh["file"]
    if not isinstance(name, str):
        raise InputError(f"mesh.{number}.file", got=str(name), takes="the path of a gear file")
    try:
        pair = GearCase.from_toml(folder / name)
    except InputError as error:
        raise error.with_text(f"mesh.{number}.file, {error.key}", error.text) from None
    return {key: value for key, value in mesh.items() if key != "file"} | {"pair": pair}
