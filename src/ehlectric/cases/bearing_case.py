"""Case of a rolling bearing, read from TOML, written back, and changed."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import field_serializer, field_validator, model_validator

from ehlectric.cases.bearing import Bearing, BearingDischarge, BearingLubricant, Motor
from ehlectric.cases.case import Title
from ehlectric.cases.changes import Groups, displace, set_keys
from ehlectric.cases.discharge import STRENGTHS, TABLES
from ehlectric.cases.grid import Solver
from ehlectric.cases.ranges import InputRange, ranges_of
from ehlectric.cases.row import value_at
from ehlectric.cases.table import Table, read_toml
from ehlectric.errors import InputError

# Alternative keys, by table: a key that changes replaces its alternatives.
_ALTERNATIVES: dict[str, Groups] = {
    "lubricant": ((("viscosity",), ("temperature",)),),
    "discharge": (STRENGTHS, TABLES),
}

# Keys of [discharge] that a bearing file may not have.
_NOT_OF_BEARINGS = ("length", "external_capacitance", "peak_current", "pit")


class BearingCase(Table):
    """Rolling bearing in its machine: all inputs on which its capacitance and breakdown voltage depend."""

    title: Title = ""
    contacts: Literal["solved", "formula"] = "solved"
    bearing: Bearing
    lubricant: BearingLubricant
    discharge: BearingDischarge = BearingDischarge()
    motor: Motor | None = None
    solver: Solver = Solver()
    ranges: tuple[InputRange, ...] | None = None

    @field_validator("ranges", mode="plain")
    @classmethod
    def _parsed(cls, tables: Any) -> tuple[InputRange, ...] | None:
        """Ranges of inputs in SI units."""
        return None if tables is None else ranges_of(tables, cls) or None

    @field_serializer("ranges")
    def _as_table(self, ranges: tuple[InputRange, ...] | None) -> dict[str, list[float]] | None:
        return None if ranges is None else {one.key: [one.low, one.high] for one in ranges}

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key in _NOT_OF_BEARINGS:
            if getattr(self.discharge, key) is not None:
                raise InputError(f"discharge.{key}", got="it for a bearing, which has no use for it")
        if self.bearing.film_factor == "inlet-shear":
            oil = self.lubricant.temperature
            if oil is None or oil.thermal_conductivity is None:
                raise InputError.worded(
                    "lubricant.temperature.thermal_conductivity",
                    "missing, film_factor 'inlet-shear' takes it",
                )
        table = self.to_dict() if self.ranges else {}
        for one in self.ranges or ():
            if not _is_number(value_at(table, one.key)):
                raise InputError(
                    f"ranges.{one.key}", got="a range", takes=f"a number for {one.key} in the file too"
                )
        return self

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Read a bearing case from a TOML file.

        Parameters
        ----------
        path : str or Path
            TOML file.

        Returns
        -------
        BearingCase
            Case with the values of the file, in SI units.

        Raises
        ------
        InputError
            If the file cannot be read, is not TOML, or is not a valid bearing case.
        """
        table = read_toml(path)
        if "contact" in table and "bearing" not in table:
            raise InputError(
                path, "is the file of a contact", takes="that of a bearing; ehlectric run solves it"
            )
        return cls.from_dict(table)

    def to_dict(self) -> dict[str, Any]:
        """Return all values that are set as nested tables, in SI units."""
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Return the case as TOML text, which ``from_toml`` reads back to an equal case."""
        import tomli_w

        return tomli_w.dumps(self.to_dict())

    def replace(self, changes: Mapping[str, Any]) -> Self:
        """Return a changed copy of the case.

        Parameters
        ----------
        changes : mapping
            New values by dotted key, as in ``{"bearing.radial_load": "1 kN"}``. A new key replaces its
            alternative; a new ``lubricant.base`` replaces all values of the lubricant. A range of a replaced
            value is left out.

        Returns
        -------
        BearingCase
            Case with the new values.

        Raises
        ------
        InputError
            If a key is unknown, or the changed case is not valid.
        """
        table = self.to_dict()
        if "lubricant.base" in changes:
            table["lubricant"] = {}
        displace(table, changes, _ALTERNATIVES)
        set_keys(table, changes)
        if "ranges" in table and "ranges" not in changes:
            table["ranges"] = {
                key: ends
                for key, ends in table["ranges"].items()
                if key not in changes and _is_number(value_at(table, key))
            }
        return self.from_dict(table)


def _is_number(value: Any) -> bool:
    """Whether the value of an input is a number, and not missing, a choice, a list or a table."""
    return isinstance(value, int | float) and not isinstance(value, bool)
