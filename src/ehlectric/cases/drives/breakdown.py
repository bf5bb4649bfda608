"""Table ``breakdown`` of a drive file: how a film breaks down, conducts and insulates again."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount
from ehlectric.cases.table import Table
from ehlectric.errors import InputError


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
