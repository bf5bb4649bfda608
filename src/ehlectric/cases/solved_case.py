"""Cases of every kind: contacts, bearings, drives, axles and gear pairs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.cases.axle_case import AxleCase, with_gear_files
from ehlectric.cases.drive_case import AnyCase, DriveCase, case_of_dict, with_files
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.table import read_toml
from ehlectric.quantities.inputs import ENDS

# Case of anything that is solved.
SolvedCase = AnyCase | DriveCase | AxleCase | GearCase


def solved_case_of_dict(table: Mapping[str, Any], *, written: bool = False) -> SolvedCase:
    """Make a drive case from tables that contain the key of one of its bearings, an axle from tables that
    contain ``shaft``, a gear case from tables that contain ``gear``, else a case of a bearing or contact.

    Raises InputError if the tables are not valid; the message names the key, its value, and what is allowed.
    """
    if any(end in table for end in ENDS):
        return DriveCase.from_written(table) if written else DriveCase.from_dict(table)
    if "shaft" in table:
        return AxleCase.from_written(table) if written else AxleCase.from_dict(table)
    if "gear" in table:
        return GearCase.from_written(table) if written else GearCase.from_dict(table)
    return case_of_dict(table, written=written)


def solved_case_of_file(path: str | Path) -> SolvedCase:
    """Read a case of any kind from a TOML file. Raises InputError if the file cannot be read, is not TOML, or
    is not a valid case.
    """
    return solved_case_of_dict(with_files_of(read_toml(path), Path(path).parent), written=True)


def with_files_of(table: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Tables of a case whose files lie relative to a folder, with absolute names and with the tables of the
    gear files of an axle. Raises InputError if a file cannot be read or is not valid.
    """
    return with_gear_files(table, folder) if "shaft" in table else with_files(table, folder)
