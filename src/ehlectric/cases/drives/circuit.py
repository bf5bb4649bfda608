"""Table ``circuit`` of a drive file: capacitances of the machine, and what else the current passes."""

from __future__ import annotations

from typing import Annotated

from ehlectric.cases.quantity import Quantity
from ehlectric.cases.table import Table

_Capacitance = Annotated[float, Quantity("F", above=0.0, most=1e-3, reason="of an electric machine")]
_Inductance = Annotated[float, Quantity("H", above=0.0, most=1e3, reason="of a path of the current")]
_Resistance = Annotated[float, Quantity("ohm", least=0.0, most=1e12, reason="of a path of the current")]


class Circuit(Table):
    """Circuit of the machine around its bearings."""

    winding_rotor_capacitance: _Capacitance
    rotor_frame_capacitance: _Capacitance
    winding_frame_capacitance: _Capacitance | None = None
    frame_earth_capacitance: _Capacitance | None = None
    cable_capacitance: _Capacitance | None = None
    common_mode_inductance: _Inductance | None = None
    common_mode_resistance: _Resistance = 0.0
    ground_inductance: _Inductance | None = None
    ground_resistance: _Resistance = 0.0
    grounding_ring_resistance: (
        Annotated[float, Quantity("ohm", above=0.0, most=1e12, reason="from the shaft to the frame")] | None
    ) = None
