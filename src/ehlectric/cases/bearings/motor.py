"""Table ``motor`` of a bearing file: the common-mode voltage, and the capacitances around the bearing."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount
from ehlectric.cases.table import Table
from ehlectric.errors import InputError

_Capacitance = Annotated[float, Amount("F", above=0.0, most=1e-3, reason="of an electric machine")]


class Motor(Table):
    """Common-mode voltage and capacitances of the motor around the bearing."""

    common_mode_voltage: Annotated[float, Amount("V", above=0.0, most=1e6, reason="peak")]
    winding_rotor_capacitance: _Capacitance
    rotor_frame_capacitance: _Capacitance
    second_bearing_capacitance: _Capacitance | None = None
    switching_frequency: (
        Annotated[float, Amount("Hz", least=1.0, most=1e8, reason="of the inverter")] | None
    ) = None
    rise_time: (
        Annotated[float, Amount("s", least=1e-11, most=1.0, reason="of an edge of the inverter")] | None
    ) = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.switching_frequency is not None and self.rise_time is not None:
            period = 1.0 / self.switching_frequency
            if self.rise_time >= period:
                raise InputError(
                    "rise_time",
                    got=f"{self.rise_time:g} s",
                    takes=f"less than {period:.3g} s, a period of motor.switching_frequency",
                )
        return self
