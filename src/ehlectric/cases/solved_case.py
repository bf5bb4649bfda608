"""Cases of every kind: contacts, bearings, drives and gear pairs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.cases.drive_case import AnyCase, DriveCase, case_of_dict, with_absolute_files
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.table import read_toml
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import ENDS

# Case of anything that is solved.
SolvedCase = AnyCase | DriveCase | GearCase


def solved_case_of_dict(table: Mapping[str, Any], *, written: bool = False) -> SolvedCase:
    """Make a drive case from tables that contain the key of one of its bearings, a gear case from tables that
    contain ``gear``, else a case of a bearing or contact. Raises InputError if the tables are not valid;
    the message names the key, its value, and what is allowed.
    """
    if any(end in table for end in ENDS):
        return DriveCase.from_written(table) if written else DriveCase.from_dict(table)
    if "shaft" in table:
        raise InputError(
            "shaft", "is a table of an axle", takes="a case of another kind; no sweep varies axles"
        )
    if "gear" in table:
        return GearCase.from_written(table) if written else GearCase.from_dict(table)
    return case_of_dict(table, written=written)


def solved_case_of_file(path: str | Path) -> SolvedCase:
    """Read a case of any kind from a TOML file. Raises InputError if the file cannot be read, is not TOML, or
    is not a valid case.
    """
    return solved_case_of_dict(with_absolute_files(read_toml(path), Path(path).parent), written=True)
