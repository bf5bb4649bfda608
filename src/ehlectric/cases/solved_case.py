"""Cases of every kind: contacts, bearings, drives, axles and gear pairs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.cases.axle_case import AxleCase, with_gear_files
from ehlectric.cases.drive_case import AnyCase, DriveCase, case_of_dict
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.table import read_toml
from ehlectric.quantities.inputs import ENDS

# Case of anything that is solved.
SolvedCase = AnyCase | DriveCase | AxleCase | GearCase


# Tables of which a file of a kind contains one.
_TABLES: Mapping[type[DriveCase | AxleCase | GearCase], tuple[str, ...]] = {
    DriveCase: ENDS,
    AxleCase: ("shaft",),
    GearCase: ("gear",),
}


def model_of(table: Mapping[str, Any]) -> type[DriveCase | AxleCase | GearCase] | None:
    """Return the class of a drive, an axle or a gear pair from tables; None for a bearing or a contact.

    Examples
    --------
    >>> model_of({"shaft": [], "drive": {}}).__name__, model_of({"bearing": {}})
    ('AxleCase', None)
    """
    return next((model for model, names in _TABLES.items() if any(name in table for name in names)), None)


def solved_case_of_dict(table: Mapping[str, Any], *, written: bool = False) -> SolvedCase:
    """Make a case of the kind of its tables.

    Raises InputError if the tables are not valid; the message names the key, its value, and what is allowed.
    """
    model = model_of(table)
    if model is None:
        return case_of_dict(table, written=written)
    return model.from_written(table) if written else model.from_dict(table)


def solved_case_of_file(path: str | Path) -> SolvedCase:
    """Read a case of any kind from a TOML file. Raises InputError if the file cannot be read, is not TOML, or
    is not a valid case.
    """
    return solved_case_of_dict(with_gear_files(read_toml(path), Path(path).parent), written=True)
