"""Table ``circuit`` of a drive file: capacitances of the machine, and what else the current passes."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount
from ehlectric.cases.drives.machine import Geometry
from ehlectric.cases.table import Table
from ehlectric.errors import InputError

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
