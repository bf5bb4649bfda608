"""Table ``circuit.machine`` of a drive file: geometry from which capacitances of the machine follow."""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.formulas.machine_capacitances import Machine, MachineCapacitances, machine_capacitances
from ehlectric.quantities.formats import amount

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
