"""Case of a gear pair, read from TOML, written back, and changed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeVar

from pydantic import field_serializer, field_validator, model_validator

from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.defaults import Contacts
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.duty_inputs import Duty
from ehlectric.cases.gear_inputs import Gear, GearOperation
from ehlectric.cases.input_ranges import (
    InputRange,
    check_ranges,
    drop_ranges,
    flat_changes,
    quantity_at,
    ranges_of,
    table_of_ranges,
)
from ehlectric.cases.key_names import refuse_deep
from ehlectric.cases.measured_inputs import Measured
from ehlectric.cases.oil_inputs import displace_oil
from ehlectric.cases.roughness_inputs import find_files
from ehlectric.cases.stated_ranges import with_stated_ranges
from ehlectric.cases.table import CaseFile, Title, annotation_of, with_name_keys
from ehlectric.cases.table_edits import displace, nested, set_keys
from ehlectric.errors import InputError, within
from ehlectric.quantities.alternatives import ALTERNATIVES
from ehlectric.quantities.formats import amount, operating_point
from ehlectric.runtime.display import headline

# Keys of [discharge] that a gear file may not have.
_NOT_OF_GEARS = ("weibull", "external_capacitance", "length", "peak_current", "pit")


class GearCase(CaseFile, book="gear_file"):
    """Pair of cylindrical gears at an operating point: all inputs on which its film and its field depend.

    A case is made from a file by ``from_toml``, or from nested tables by ``from_dict``. Wrong inputs raise an
    ``InputError`` that names their keys. A case is frozen; ``replace`` returns a changed copy. Numbers are in
    SI units.

    Parameters
    ----------
    gear : mapping
        Drawing of the gear pair, with the tables ``operation`` and ``contact``.
    lubricant : Lubricant or mapping
        Laws of the oil, or ``base``, the name of a lubricant of the library.
    title : str, optional
        Title of tables and figures.
    contacts : str, optional
        "atlas" for films from the atlas, "formula" for a film-thickness formula, or "solved" for films that
        are solved at the points of the path of contact and at the smallest film.
    discharge : mapping, optional
        Dielectric strength and conductivity of the oil.
    ranges : mapping, optional
        Ranges of uncertain inputs by dotted key, each a list of two values.
    duty : mapping, optional
        ``file``, the file of a duty cycle.
    measured : mapping, optional
        Measured values that correct the ranges of uncertain inputs.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.GearCase.from_toml(ehlectric.example("gear_pair.toml"))
    >>> case.gear.teeth, case.replace({"gear.flank_ra.1": "0.1 um"}).gear.flank_ra
    ((23, 67), (1e-07, 5e-08))
    """

    if TYPE_CHECKING:

        def __init__(self, **tables: Any) -> None: ...

    title: Title = ""
    contacts: Contacts = "atlas"
    gear: Gear
    lubricant: Lubricant
    discharge: Discharge = Discharge()
    ranges: tuple[InputRange, ...] | None = None
    duty: Duty | None = None
    measured: Measured | None = None

    @model_validator(mode="before")
    @classmethod
    def _with_uncertainties(cls, tables: Any) -> Any:
        """Inputs that are written with their uncertainty have their middle, and ``ranges`` has their ends."""
        return (
            with_stated_ranges(tables, partial(quantity_at, cls)) if isinstance(tables, Mapping) else tables
        )

    @field_validator("ranges", mode="plain")
    @classmethod
    def _parsed(cls, tables: Any) -> tuple[InputRange, ...] | None:
        """Ranges of inputs in SI units."""
        return None if tables is None else ranges_of(tables, cls) or None

    @field_serializer("ranges")
    def _as_table(self, ranges: tuple[InputRange, ...] | None) -> dict[str, list[int | float]] | None:
        return table_of_ranges(ranges)

    @classmethod
    def of_file(cls, table: dict[str, Any], path: Path) -> Self:
        """Make a gear case from the tables of the file at a path."""
        find_files(table, path.parent)
        return cls.from_written(table)

    @classmethod
    def unused_keys(cls, given: Mapping[str, Any]) -> set[str]:
        """Return the dotted keys that a gear pair does not have."""
        return super().unused_keys(given) | {f"discharge.{key}" for key in (*_NOT_OF_GEARS, "outlet")}

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key in _NOT_OF_GEARS:
            if getattr(self.discharge, key) is not None:
                raise InputError.worded(f"discharge.{key}", "is not used by a gear pair")
        if self.discharge.outlet != "full":
            raise InputError(
                "discharge.outlet",
                got=f"{self.discharge.outlet!r}",
                takes="'full': oil fills all gaps",
            )
        table = self.discharge.strength_table
        if table is not None and table.over == "pressure":
            raise InputError(
                "discharge.strength_table",
                got="a strength over pressure",
                takes="dielectric_strength, or a table over temperature: the field in the film is not solved",
            )
        check_ranges(self.ranges, self.to_dict)
        return self

    def _speeds(self, table: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
        yield table["gear"]["operation"], "pinion_speed"

    def _headline(self) -> str:
        """Title, teeth, torque and speed on one line."""
        operation, teeth = self.gear.operation, "/".join(map(str, self.gear.teeth))
        return headline(
            self.title,
            f"{teeth} teeth",
            amount(operation.pinion_torque, "N m"),
            *operating_point(operation.pinion_speed, operation.oil_temperature, "degC"),
        )

    def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
        """Return a changed copy of the case.

        Parameters
        ----------
        changes : mapping, optional
            New values by dotted key, as in ``{"gear.operation.pinion_torque": "100 N m"}``. A new
            ``lubricant.base`` replaces all values of the lubricant.
        **tables
            New values by table, as in ``gear={"helix_angle": 0.0}``.
        """
        refuse_deep({**tables, "changes": changes})
        changes = with_name_keys(flat_changes(tables) | dict(changes or {}), GearCase)
        table = self.to_dict()
        if "lubricant.base" in changes:
            table["lubricant"] = {}
        displace_oil(table["lubricant"], nested(changes, "lubricant"))
        displace(table, changes, {name: ALTERNATIVES[name] for name in ("gear", "lubricant", "discharge")})
        set_keys(table, changes)
        drop_ranges(table, changes)
        return self.from_dict(table)


# Tables whose numbers are checked within their table only, by the start of their keys.
_OPERATION, _GEAR = "gear.operation.", "gear."

_Numbers = TypeVar("_Numbers", Gear, GearOperation)


def changed_pair(case: GearCase, changes: Mapping[str, Any], *, parsed: bool = False) -> GearCase:
    """Changed copy of a case as ``replace`` makes it, in a tenth of the time if all changes are numbers of
    [gear] and [gear.operation] that the case contains. ``parsed``, whether values are as a case stores them.
    Raises InputError as ``replace`` does.
    """
    of_operation = {key: value for key, value in changes.items() if key in _NUMBERS[_OPERATION]}
    of_gear = {key: value for key, value in changes.items() if key in _NUMBERS[_GEAR]}
    new = any(getattr(case.gear, key.removeprefix(_GEAR)) is None for key in of_gear)
    if new or len(of_operation) + len(of_gear) < len(changes) or case.ranges or None in changes.values():
        return case.replace(changes)
    gear, operation = case.gear, case.gear.operation
    operation = _with_numbers(operation, _OPERATION, of_operation, parsed=parsed)
    gear = _with_numbers(gear.model_copy(update={"operation": operation}), _GEAR, of_gear, parsed=parsed)
    return case.model_copy(update={"gear": gear})


def _with_numbers(table: _Numbers, start: str, changes: Mapping[str, Any], *, parsed: bool) -> _Numbers:
    """Copy of a table with other numbers, by their dotted keys, which begin with ``start``."""
    with within(start[:-1]):
        values = {}
        for key, value in changes.items():
            name = key.removeprefix(start)
            values[name] = tuple(value) if isinstance(value, list) else value
            if not parsed:
                with within(name):
                    values[name] = _NUMBERS[start][key].parse(value)
        return table.model_copy(update=values).checked()


# Annotations of numbers by dotted key, by the start of their keys.
_NUMBERS = {
    start: {
        f"{start}{name}": annotation
        for name, field in table.known_keys().items()
        if (annotation := annotation_of(field)) is not None
    }
    for start, table in ((_OPERATION, GearOperation), (_GEAR, Gear))
}
