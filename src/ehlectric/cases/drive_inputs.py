"""Tables of a drive file: operating point, rotor and its forces, source, circuit and machine, and how a film
breaks down, conducts and insulates again.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Self

from pydantic import model_validator

from ehlectric.cases.axle_keys import LOADS
from ehlectric.cases.defaults import Contacts
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.formulas.capacitances import Machine, MachineCapacitances, machine_capacitances
from ehlectric.quantities.alternatives import ALTERNATIVES, DESCRIBED, MEASURED
from ehlectric.quantities.formats import amount
from ehlectric.quantities.inputs import ENDS

if TYPE_CHECKING:
    from ehlectric.formulas.shaft_statics import BearingLoads, ForceAt

# What a described source needs; six-step operation switches at the fundamental frequency and has no index.
_NEEDED = ("dc_link", "modulation", "rise_time")
_NEEDED_BY_CARRIER = ("switching_frequency", "modulation_index")
_ONLY_BY_CARRIER = (*_NEEDED_BY_CARRIER, "base_frequency")
_RINGING = ("ringing_frequency", "overshoot", "ringing_time")


class Operation(Table, book="drive"):
    """Operating point of the drive, and how long it is looked at."""

    speed: float | None = None
    temperature: float | None = None
    contacts: Contacts | None = None
    duration: float | None = None
    seed: int = 0
    gravity_direction: float = -0.5 * math.pi


class ShaftForce(Table, book="axle.force"):
    """Force on a shaft at a place on its axis, with its components along x, y and z.

    A drive has one shaft, its rotor, and a force on it names no shaft.
    """

    shaft: str | None = None
    at: float
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


# Loads of a bearing, and forces that are none [N].
_RADIAL, _AXIAL = LOADS
_NO_FORCE = 1e-6


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

    @property
    def places(self) -> tuple[float, float]:
        """Places of both bearings on the axis [m]."""
        return self.drive_end_at, self.non_drive_end_at

    def forces_on(
        self, forces: Sequence[ShaftForce], gravity: float
    ) -> list[tuple[tuple[Literal["weight", "force"], str], ForceAt]]:
        """Return the weight and the forces, each with its kind and the number of the force.

        ``gravity`` is the direction of the weight [rad].
        """
        from ehlectric.formulas.shaft_statics import on_axis, weight_at

        on_rotor: list[tuple[tuple[Literal["weight", "force"], str], ForceAt]] = [
            (("force", str(number)), on_axis(each.at, each.x, each.y, each.z))
            for number, each in enumerate(forces, 1)
        ]
        if self.mass is not None and self.mass_at is not None:
            on_rotor.append((("weight", ""), weight_at(self.mass, self.mass_at, gravity)))
        return on_rotor

    def carried(self, forces: Sequence[ShaftForce], gravity: float) -> BearingLoads:
        """Return the loads of both bearings as vectors. Raises InputError for bearings at one place."""
        from ehlectric.formulas.shaft_statics import bearing_loads

        try:
            return bearing_loads([force for _, force in self.forces_on(forces, gravity)], self.places)
        except InputError:
            raise InputError(
                "rotor.non_drive_end_at",
                got=f"{amount(self.non_drive_end_at, 'm')}, the place of the other bearing",
                takes="another place: two bearings at one place carry no moment",
            ) from None

    def loads(self, forces: Sequence[ShaftForce], gravity: float) -> dict[str, dict[str, float]]:
        """Return the loads of a bearing file by the ends [N]; ``gravity``, direction of the weight [rad].

        Raises InputError for bearings at one place, a bearing without a load, and an axial force that no
        bearing locates.
        """
        carried = self.carried(forces, gravity)
        axial = abs(carried.axial) if abs(carried.axial) > _NO_FORCE else 0.0
        if axial and self.locating is None:
            takes = f"'{ENDS[0]}' or '{ENDS[1]}', the bearing that carries the axial forces"
            raise InputError.missing("rotor.locating", takes)
        loads = {
            end: {_RADIAL: radial, _AXIAL: axial if end == self.locating else 0.0}
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


class Source(Table, book="source"):
    """Common-mode voltage of the inverter: from its modulation, or a measured waveform."""

    dc_link: float | None = None
    modulation: Literal["sinusoidal", "space-vector", "six-step"] | None = None
    switching_frequency: float | None = None
    fundamental_frequency: float | None = None
    pole_pairs: int | None = None
    modulation_index: float | None = None
    base_frequency: float | None = None
    rise_time: float | None = None
    ringing_frequency: float | None = None
    overshoot: float | None = None
    ringing_time: float | None = None
    file: str | None = None
    column: str | int | None = None
    time_column: str | int | None = None
    step: float | None = None
    time_unit: str | None = None
    value_unit: str | None = None
    scale: float = 1.0
    resample: float | None = None

    @property
    def measured(self) -> bool:
        """Whether the source is a file."""
        return self.file is not None

    def at_speed(self, speed: float) -> Self:
        """Source at a speed of the rotor: its frequency and its modulation index follow the speed.

        With ``pole_pairs`` p the frequency is p n of a synchronous machine, without the slip of an induction
        machine. With ``base_frequency`` the index is ``modulation_index`` from this frequency on, and below
        it falls in proportion to the frequency, for a constant flux.

        The source for this speed [rad/s] has its frequency and its index, and not those two keys. Raises
        InputError if the frequency or an edge does not fit the carrier.
        """
        frequency, index, base = self.fundamental_frequency, self.modulation_index, self.base_frequency
        if self.pole_pairs is not None:
            # Without the rounding of a speed in rpm, so that 50 Hz are exactly that.
            frequency = float(f"{self.pole_pairs * abs(speed) / (2.0 * math.pi):.12g}")
        if base is not None and frequency is not None and index is not None:
            index *= min(frequency / base, 1.0)
        at_speed = {"fundamental_frequency": frequency, "modulation_index": index}
        table = self.model_dump(exclude_none=True, exclude={"pole_pairs", "base_frequency"}) | at_speed
        return self.from_dict({key: value for key, value in table.items() if value is not None})

    @classmethod
    def unused_keys(cls, given: Mapping[str, Any]) -> set[str]:
        """Return the keys of a source of the other kind, described or measured."""
        if given.get("file") is not None:
            return set(DESCRIBED)
        carrier = _ONLY_BY_CARRIER if given.get("modulation") == "six-step" else ()
        return {*carrier, *(set(MEASURED) - {"file", "scale"} if given else ())}

    @model_validator(mode="after")
    def _check(self) -> Self:
        given = [key for key in DESCRIBED if getattr(self, key) is not None]
        if self.measured:
            if given:
                raise InputError(
                    given[0], got="it together with file", takes="a described source, or a measured one"
                )
            return self
        other = [key for key in MEASURED if key != "scale" and getattr(self, key) is not None]
        if other:
            raise InputError.worded("file", f"missing; {other[0]} belongs to a measured source")
        self._check_modulation()
        self._check_edges()
        return self

    def _check_modulation(self) -> None:
        """Check that a described source is complete, and has one frequency."""
        carrier = () if self.modulation == "six-step" else _NEEDED_BY_CARRIER
        for key in (*_NEEDED, *carrier):
            if getattr(self, key) is None:
                raise InputError.missing(key, "a value; or file, a measured waveform")
        if self.fundamental_frequency is None and self.pole_pairs is None:
            takes = "a value; or pole_pairs, with which it follows the speed; or file, a measured waveform"
            raise InputError.missing("fundamental_frequency", takes)
        if self.fundamental_frequency is not None and self.pole_pairs is not None:
            raise InputError.worded(
                "pole_pairs", "is given together with fundamental_frequency; give one of them"
            )
        if self.modulation == "six-step":
            for key in _ONLY_BY_CARRIER:
                if getattr(self, key) is not None:
                    raise InputError.worded(key, "is not used by six-step modulation")

    def _check_edges(self) -> None:
        """Check the ringing, and times against the period of the carrier."""
        ringing = [key for key in _RINGING if getattr(self, key) is not None]
        if ringing and len(ringing) < len(_RINGING):
            missing = next(key for key in _RINGING if key not in ringing)
            raise InputError.worded(missing, f"missing; {ringing[0]} needs it")
        fundamental, carrier, rise = self.fundamental_frequency, self.switching_frequency, self.rise_time
        if fundamental is not None and carrier is not None and carrier < 6.0 * fundamental:
            raise InputError(
                "switching_frequency",
                got=f"{carrier:g} Hz",
                takes=f"at least six times the fundamental frequency of {fundamental:g} Hz",
            )
        period = 1.0 / (carrier or 6.0 * (fundamental or 1.0))
        if rise is not None and rise >= 0.5 * period:
            raise InputError(
                "rise_time", got=f"{rise:g} s", takes=f"less than half of the period {period:.3g} s"
            )


class Geometry(Table, book="circuit.machine"):
    """Active part of a machine: stator with slots, and a rotor that is smooth for the field."""

    stack_length: float
    bore_diameter: float
    air_gap: float
    slots: int
    slot_opening: float
    copper_depth: float
    slot_permittivity: float
    liner_width: float
    liner_thickness: float
    liner_permittivity: float

    @model_validator(mode="after")
    def _check(self) -> Self:
        pitch = math.pi * self.bore_diameter / self.slots
        if self.slot_opening >= pitch:
            takes = f"less than {amount(pitch, 'm')}, the distance between slots"
            raise InputError("slot_opening", got=amount(self.slot_opening, "m"), takes=takes)
        if self.air_gap > 0.25 * self.bore_diameter:
            takes = "at most a quarter of bore_diameter"
            raise InputError("air_gap", got=amount(self.air_gap, "m"), takes=takes)
        return self

    @property
    def capacitances(self) -> MachineCapacitances:
        """Capacitances of the machine [F], without its end windings."""
        return machine_capacitances(
            Machine(
                length=self.stack_length,
                bore=self.bore_diameter,
                gap=self.air_gap,
                slots=self.slots,
                opening=self.slot_opening,
                depth=self.copper_depth,
                permittivity=self.slot_permittivity,
                liner_width=self.liner_width,
                liner=self.liner_thickness,
                liner_permittivity=self.liner_permittivity,
            )
        )


# Capacitances that a geometry gives where they are not given themselves, and their names there.
_FROM_GEOMETRY = {
    "winding_rotor_capacitance": "winding_rotor",
    "rotor_frame_capacitance": "rotor_frame",
    "winding_frame_capacitance": "winding_frame",
}


# Relative error of a speed that was converted from revolutions per minute.
_ROUNDING = 1e-9


class RingTable(Table, book="circuit.grounding_ring_table"):
    """Resistance of a grounding ring or brush over the speed of the shaft."""

    speed: tuple[float, ...]
    resistance: tuple[float, ...]

    @model_validator(mode="after")
    def _check(self) -> Self:
        return self.check_over("speed", "resistance")

    def covers(self, speed: float) -> bool:
        """Whether the size of a speed [rad/s] is within the table, except for its rounding."""
        first, last = self.speed[0], self.speed[-1]
        return first <= (1.0 + _ROUNDING) * abs(speed) and (1.0 - _ROUNDING) * abs(speed) <= last

    def at_speed(self, speed: float) -> float:
        """Resistance at a speed of either direction [ohm].

        The logarithm of the resistance is linear in the speed between two entries, so that the resistance
        rises or falls as they do; beyond the table the value at its end holds. ``speed`` in rad/s.

        Examples
        --------
        >>> table = RingTable.from_dict({"speed": [0.0, 100.0], "resistance": ["0.5 ohm", "50 ohm"]})
        >>> [round(table.at_speed(speed), 9) for speed in (0.0, 50.0, -50.0, 100.0, 900.0)]
        [0.5, 5.0, 5.0, 50.0, 50.0]
        """
        place = bisect_right(self.speed, abs(speed))
        if place in (0, len(self.speed)):
            return self.resistance[0 if place == 0 else -1]
        (first, second), (low, high) = (row[place - 1 : place + 1] for row in (self.speed, self.resistance))
        # As a power of the ratio, which is exact at the entries and for a constant resistance.
        return low * float((high / low) ** ((abs(speed) - first) / (second - first)))


class Circuit(Table, book="circuit"):
    """Circuit of the machine around its bearings."""

    winding_rotor_capacitance: float | None = None
    rotor_frame_capacitance: float | None = None
    winding_frame_capacitance: float | None = None
    frame_earth_capacitance: float | None = None
    cable_capacitance: float | None = None
    common_mode_inductance: float | None = None
    common_mode_resistance: float = 0.0
    ground_inductance: float | None = None
    ground_resistance: float = 0.0
    grounding_ring_resistance: float | None = None
    grounding_ring_table: RingTable | None = None
    machine: Geometry | None = None

    def at_speed(self, speed: float) -> Self:
        """Circuit at a speed of the rotor [rad/s]: its grounding ring has one resistance, and no table."""
        table = self.grounding_ring_table
        if table is None:
            return self
        return self.model_copy(
            update={"grounding_ring_resistance": table.at_speed(speed), "grounding_ring_table": None}
        )

    @model_validator(mode="after")
    def _check(self) -> Self:
        rings = [row[0] for row in ALTERNATIVES["circuit"][0]]
        self.check_alternatives(rings, f"one of {' and '.join(rings)}")
        for key in ("winding_rotor_capacitance", "rotor_frame_capacitance"):
            if self.machine is None and getattr(self, key) is None:
                takes = "a value; or the table circuit.machine, the geometry of the machine"
                raise InputError.missing(key, takes)
        for path in ("common_mode", "ground"):
            resistance, inductance = f"{path}_resistance", f"{path}_inductance"
            if getattr(self, resistance) and getattr(self, inductance) is None:
                raise InputError.worded(
                    resistance, f"is given without {inductance}, with which it is in series; give both"
                )
        return self

    @property
    def inductive(self) -> bool:
        """Whether it has an inductance, behind which the winding does not follow the inverter at once."""
        return self.common_mode_inductance is not None or self.ground_inductance is not None

    @property
    def estimated(self) -> tuple[str, ...]:
        """Keys of the capacitances that are not given, and follow from the geometry of the machine."""
        return (
            () if self.machine is None else tuple(key for key in _FROM_GEOMETRY if getattr(self, key) is None)
        )

    @cached_property
    def capacitances(self) -> dict[str, float]:
        """Capacitances of the machine by their keys [F], given or from its geometry; without any others."""
        known = {key: getattr(self, key) for key in _FROM_GEOMETRY}
        if self.estimated:
            assert self.machine is not None
            by_geometry = self.machine.capacitances
            known |= {key: getattr(by_geometry, _FROM_GEOMETRY[key]) for key in self.estimated}
        return {key: value for key, value in known.items() if value is not None}


class Breakdown(Table, book="breakdown"):
    """Arc and threshold of a film."""

    arc_resistance: float
    extinction_current: float | None = None
    extinction_voltage: float | None = None
    recovery_time: float
    weibull_shape: float | None = None
    renewal_time: float | None = None
    touch_time: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.extinction_current is None) == (self.extinction_voltage is None):
            both = self.extinction_current is not None
            raise InputError(
                "extinction_current",
                got="it together with extinction_voltage" if both else "none",
                takes="one of extinction_current and extinction_voltage",
            )
        return self

    @property
    def extinction_key(self) -> str:
        """Key of the extinction that is given."""
        return "extinction_current" if self.extinction_voltage is None else "extinction_voltage"

    @property
    def lowest_voltage(self) -> float:
        """Voltage across an arc below which it goes out [V]."""
        if self.extinction_voltage is not None:
            return self.extinction_voltage
        assert self.extinction_current is not None
        return self.extinction_current * self.arc_resistance
