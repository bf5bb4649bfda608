"""Tables of a drive file: source, circuit and machine, and how a film breaks down, conducts and insulates
again.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Annotated, Literal, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.formulas.capacitances import Machine, MachineCapacitances, machine_capacitances
from ehlectric.quantities.alternatives import DESCRIBED, MEASURED
from ehlectric.quantities.formats import amount

_Hertz = Amount("Hz", least=1e-3, most=1e9, reason="of an inverter")
_Time = Amount("s", least=1e-12, most=1.0, reason="of an edge of an inverter")

# What a described source needs; six-step operation switches at the fundamental frequency and has no index.
_NEEDED = ("dc_link", "modulation", "rise_time")
_NEEDED_BY_CARRIER = ("switching_frequency", "modulation_index")
_ONLY_BY_CARRIER = (*_NEEDED_BY_CARRIER, "base_frequency")
_RINGING = ("ringing_frequency", "overshoot", "ringing_time")


class Source(Table):
    """Common-mode voltage of the inverter: from its modulation, or a measured waveform."""

    dc_link: Annotated[float, Amount("V", above=0.0, most=1e6, reason="voltage of the DC link")] | None = None
    modulation: Literal["sinusoidal", "space-vector", "six-step"] | None = None
    switching_frequency: Annotated[float, _Hertz] | None = None
    fundamental_frequency: Annotated[float, _Hertz] | None = None
    pole_pairs: Annotated[int, Count(least=1, most=1000, reason="of the machine")] | None = None
    modulation_index: (
        Annotated[float, Amount("", least=0.0, most=1.5, reason="1 without overmodulation")] | None
    ) = None
    base_frequency: Annotated[float, _Hertz] | None = None
    rise_time: Annotated[float, Amount("s", least=0.0, most=1.0, reason="of an edge")] | None = None
    ringing_frequency: Annotated[float, _Hertz] | None = None
    overshoot: (
        Annotated[float, Amount("", least=0.0, most=1.0, reason="part of the step", fraction=True)] | None
    ) = None
    ringing_time: Annotated[float, _Time] | None = None
    file: str | None = None
    column: str | int | None = None
    time_column: str | int | None = None
    step: Annotated[float, _Time] | None = None
    time_unit: str | None = None
    value_unit: str | None = None
    scale: Annotated[float, Amount("", least=-1e9, most=1e9, reason="such as that of a probe")] = 1.0
    resample: Annotated[float, _Time] | None = None

    @property
    def measured(self) -> bool:
        """Whether the source is a file."""
        return self.file is not None

    def at_speed(self, speed: float) -> Self:
        """Source at a speed of the rotor: its frequency and its modulation index follow the speed.

        With ``pole_pairs`` p the frequency is p n of a synchronous machine, without the slip of an induction
        machine. With ``base_frequency`` the index is ``modulation_index`` from this frequency on, and below
        it falls in proportion to the frequency, for a constant flux.

        ``speed`` [rad/s]. Returns source with its frequency and its index, and without those two keys. Raises
        InputError if the frequency or an edge does not fit the carrier.
        """
        frequency, index, base = self.fundamental_frequency, self.modulation_index, self.base_frequency
        if self.pole_pairs is not None:
            # Without the rounding of a speed in rpm, so that 50 Hz are exactly that.
            frequency = float(f"{self.pole_pairs * abs(speed) / (2.0 * math.pi):.12g}")
        if base is not None and frequency is not None and index is not None:
            index *= min(frequency / base, 1.0)
        own = {"fundamental_frequency": frequency, "modulation_index": index}
        table = self.model_dump(exclude_none=True, exclude={"pole_pairs", "base_frequency"}) | own
        return self.from_dict({key: value for key, value in table.items() if value is not None})

    @model_validator(mode="after")
    def _check(self) -> Self:
        given = [key for key in DESCRIBED if getattr(self, key) is not None]
        if self.measured:
            if given:
                raise InputError(
                    given[0], got="it beside file", takes="a described source, or a measured one"
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
            raise InputError.worded("pole_pairs", "is given beside fundamental_frequency; give one of them")
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


_Length = Annotated[float, Amount("m", above=0.0, most=100.0, reason="of an electric machine")]
_Permittivity = Annotated[float, Amount("", least=1.0, most=100.0, reason="1 for air")]


class Geometry(Table):
    """Active part of a machine: stator with slots, and a rotor that is smooth for the field."""

    stack_length: _Length
    bore_diameter: _Length
    air_gap: _Length
    slots: Annotated[int, Count(least=3, most=2000, reason="of the stator")]
    slot_opening: _Length
    copper_depth: _Length
    slot_permittivity: _Permittivity
    liner_width: _Length
    liner_thickness: _Length
    liner_permittivity: _Permittivity

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


_Capacitance = Annotated[float, Amount("F", above=0.0, most=1e-3, reason="of an electric machine")]
_Inductance = Annotated[float, Amount("H", above=0.0, most=1e3, reason="of a path of the current")]
_Resistance = Annotated[float, Amount("ohm", least=0.0, most=1e12, reason="of a path of the current")]


# Capacitances that a geometry gives where they are not given themselves, and their names there.
_FROM_GEOMETRY = {
    "winding_rotor_capacitance": "winding_rotor",
    "rotor_frame_capacitance": "rotor_frame",
    "winding_frame_capacitance": "winding_frame",
}


class Circuit(Table):
    """Circuit of the machine around its bearings."""

    winding_rotor_capacitance: _Capacitance | None = None
    rotor_frame_capacitance: _Capacitance | None = None
    winding_frame_capacitance: _Capacitance | None = None
    frame_earth_capacitance: _Capacitance | None = None
    cable_capacitance: _Capacitance | None = None
    common_mode_inductance: _Inductance | None = None
    common_mode_resistance: _Resistance = 0.0
    ground_inductance: _Inductance | None = None
    ground_resistance: _Resistance = 0.0
    grounding_ring_resistance: (
        Annotated[float, Amount("ohm", above=0.0, most=1e12, reason="from the shaft to the frame")] | None
    ) = None
    machine: Geometry | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
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
    def estimated(self) -> tuple[str, ...]:
        """Keys of the capacitances that are not given, and follow from the geometry of the machine."""
        return (
            () if self.machine is None else tuple(key for key in _FROM_GEOMETRY if getattr(self, key) is None)
        )

    @cached_property
    def capacitances(self) -> dict[str, float]:
        """Capacitances of the machine by their keys [F], given or from its geometry; without any others."""
        found = {key: getattr(self, key) for key in _FROM_GEOMETRY}
        if self.estimated:
            assert self.machine is not None
            by_geometry = self.machine.capacitances
            found |= {key: getattr(by_geometry, _FROM_GEOMETRY[key]) for key in self.estimated}
        return {key: value for key, value in found.items() if value is not None}


class Breakdown(Table):
    """Arc and threshold of a film."""

    arc_resistance: Annotated[float, Amount("ohm", least=1e-6, most=1e9, reason="of a burning arc")]
    extinction_current: (
        Annotated[float, Amount("A", above=0.0, most=1e6, reason="at which an arc goes out")] | None
    ) = None
    extinction_voltage: (
        Annotated[float, Amount("V", above=0.0, most=1e6, reason="at which an arc goes out")] | None
    ) = None
    recovery_time: Annotated[float, Amount("s", least=0.0, most=1.0, reason="until the film insulates")]
    weibull_shape: (
        Annotated[float, Amount("", least=0.5, most=200.0, reason="the larger, the less it scatters")] | None
    ) = None
    renewal_time: (
        Annotated[float, Amount("s", least=1e-6, most=1e6, reason="after which other oil is in the contact")]
        | None
    ) = None
    touch_time: (
        Annotated[float, Amount("s", above=0.0, most=1e3, reason="for which asperities touch")] | None
    ) = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.extinction_current is None) == (self.extinction_voltage is None):
            both = self.extinction_current is not None
            raise InputError(
                "extinction_current",
                got="it beside extinction_voltage" if both else "none",
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
