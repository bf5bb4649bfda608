"""Table `discharge` of a case and of a bearing file: dielectric strength, outlet, conductivity, circuit,
pit.
"""

from __future__ import annotations

from typing import Literal, Self

import numpy as np
from pydantic import model_validator

from ehlectric.arrays import Numbers
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.quantities.alternatives import ALTERNATIVES

# Keys that need the length of a line contact.
_OF_LENGTH = ("weibull", "external_capacitance", "peak_current", "pit")


class StrengthTable(Table, book="discharge.strength_table"):
    """Dielectric strength over the pressure or the temperature of the film, interpolated linearly."""

    pressure: tuple[float, ...] | None = None
    temperature: tuple[float, ...] | None = None
    strength: tuple[float, ...]

    @property
    def over(self) -> Literal["pressure", "temperature"]:
        """Variable of the table: "pressure" or "temperature"."""
        return "pressure" if self.temperature is None else "temperature"

    @property
    def places(self) -> tuple[float, ...]:
        """Pressures [Pa] or temperatures [K] at which the table gives the dielectric strength."""
        places = self.pressure if self.temperature is None else self.temperature
        assert places is not None
        return places

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_alternatives(("pressure", "temperature"), "either pressure or temperature", needed=True)
        return self.check_over(self.over, "strength")


class Weibull(Table, book="discharge.weibull"):
    """Weibull law of breakdown, probability 1 - exp(-integral of (E/scale)^shape dA/reference_area)."""

    scale: float
    shape: float
    reference_area: float


class Pit(Table, book="discharge.pit"):
    """Efficiency and melting energy, from which the volume that a discharge melts is computed."""

    efficiency: float
    melting_energy: float


class Discharge(Table, book="discharge"):
    """Inputs of the assessment of a discharge; no property of a material has a default."""

    dielectric_strength: float | None = None
    strength_table: StrengthTable | None = None
    weibull: Weibull | None = None
    temperature: float | None = None
    outlet: Literal["full", "fingers", "layers"] = "full"
    conductivity: float | None = None
    external_capacitance: float | None = None
    length: float | None = None
    peak_current: float | None = None
    pit: Pit | None = None

    @property
    def has_strength(self) -> bool:
        """Whether the case gives a constant dielectric strength or a strength table."""
        return self.dielectric_strength is not None or self.strength_table is not None

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = [row[0] for row in ALTERNATIVES["discharge"][0]]
        self.check_alternatives(names, f"one of {', '.join(names)}")
        self._check_pit()
        self._check_temperature()
        return self

    def _check_pit(self) -> None:
        if self.pit is not None and self.external_capacitance is None:
            raise InputError.worded(
                "external_capacitance",
                "missing; pit needs it: a discharge also drains what is connected to the contact; "
                "give 0 if nothing is connected",
            )

    def _check_temperature(self) -> None:
        table = self.strength_table
        if table is None or table.over == "pressure":
            if self.temperature is not None:
                raise InputError(
                    "temperature",
                    got=f"{self.temperature:g} K",
                    takes="a temperature only with a strength_table over temperature",
                )
            return
        low, high = table.places[0], table.places[-1]
        if self.temperature is None:
            raise InputError.worded("temperature", "missing; a strength_table over temperature needs it")
        if not low <= self.temperature <= high:
            raise InputError(
                "temperature",
                got=f"{self.temperature:g} K",
                takes=f"one within the strength_table, {low:g} to {high:g} K",
            )

    def check_geometry(self, geometry: str) -> None:
        """Check that a point contact has no length, and that a line contact has one if a key needs it. Raises
        InputError if a point contact has a length, or a line contact lacks a length that a key needs.
        """
        if geometry == "point":
            if self.length is not None:
                raise InputError.worded("discharge.length", "is not used: a point contact has no length")
        elif self.length is None:
            needing = [name for name in _OF_LENGTH if getattr(self, name) is not None]
            if needing:
                raise InputError.worded(
                    "discharge.length",
                    f"missing; {needing[0]} needs it: the length of the line contact",
                )


# Inputs of a discharge that a bearing reads itself, and not at the temperature of its films.
_OF_WHOLE_BEARING = {"external_capacitance", "peak_current", "pit"}


class AxleDischarge(Discharge):
    """Discharge of bearings and meshes, which have different temperatures."""

    def _check_temperature(self) -> None:
        if self.strength_table is not None and self.strength_table.over == "temperature":
            raise InputError(
                "strength_table",
                got="a table over temperature for an axle",
                takes="a table over pressure, or dielectric_strength",
            )
        super()._check_temperature()


class BearingDischarge(Discharge):
    """Discharge of a bearing; a strength table over temperature is read at the bearing's temperature."""

    def _check_pit(self) -> None:
        """Accept a pit without an external capacitance: a motor may give what is connected to the shaft."""

    def _check_temperature(self) -> None:
        if self.temperature is not None:
            raise InputError(
                "temperature",
                got=f"{self.temperature:g} K for a bearing",
                takes="bearing.temperature instead, which determines the strength",
            )

    def at(self, temperature: Numbers, key: str = "bearing.temperature") -> Discharge:
        """Inputs of the discharge at a temperature [K], at which a strength table over temperature is read;
        of many points, shape (n,). Raises InputError if the temperature is outside this table; of many
        points, points outside have NaN for their temperature and their strength.

        Examples
        --------
        >>> table = {"temperature": ["20 degC", "120 degC"], "strength": ["20 V/um", "10 V/um"]}
        >>> BearingDischarge.from_dict({"strength_table": table}).at(343.15).temperature
        343.15
        """
        names = Discharge.model_fields.keys() - _OF_WHOLE_BEARING
        kept = {name: value for name in names if (value := getattr(self, name)) is not None}
        table, many = self.strength_table, bool(np.ndim(temperature))
        if table is not None and table.over == "temperature":
            outside = np.less(temperature, table.places[0]) | np.greater(temperature, table.places[-1])
            kept["temperature"] = np.where(outside, np.nan, temperature) if many else temperature
        # All other rules hold for this table, which was checked with them.
        discharge = Discharge.model_construct(**kept)
        if not many:
            try:
                discharge._check_temperature()
            except InputError as error:
                raise error.with_text(key, error.text) from None
        return discharge
