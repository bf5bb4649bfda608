"""Measured tables of a property of an oil over temperature."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount, Amounts
from ehlectric.cases.oils.laws import quantity_of
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.lubricant.conductivity import CONDUCTIVITY
from ehlectric.lubricant.permittivity import RELATIVE_PERMITTIVITY

TEMPERATURE = Amount("K", least=100.0, most=1000.0, reason="absolute, of the oil")

_Temperatures = Annotated[tuple[float, ...], Amounts(TEMPERATURE, least=2)]


def _check(temperatures: tuple[float, ...], name: str, values: tuple[float, ...]) -> None:
    """Check that temperatures increase, and that there are as many values of a property."""
    if any(b <= a for a, b in pairwise(temperatures)):
        raise InputError("temperature", got=list(temperatures), takes="increasing values")
    if len(values) != len(temperatures):
        raise InputError(
            name, got=f"{len(values)} values over {len(temperatures)} of temperature", takes="as many"
        )


class PermittivityTable(Table):
    """Measured relative permittivity over temperature at ambient pressure, interpolated linearly."""

    temperature: _Temperatures
    relative_permittivity: Annotated[tuple[float, ...], Amounts(quantity_of(RELATIVE_PERMITTIVITY), least=2)]

    @model_validator(mode="after")
    def _check(self) -> Self:
        _check(self.temperature, "relative_permittivity", self.relative_permittivity)
        return self


class ConductivityTable(Table):
    """Measured electrical conductivity over temperature; its logarithm is interpolated over 1/T."""

    temperature: _Temperatures
    conductivity: Annotated[tuple[float, ...], Amounts(quantity_of(CONDUCTIVITY), least=2)]

    @model_validator(mode="after")
    def _check(self) -> Self:
        _check(self.temperature, "conductivity", self.conductivity)
        return self
