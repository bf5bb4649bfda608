"""Reading of input files and tables that describe either a contact or a bearing."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.recognition import bearing_key
from ehlectric.cases.case import Case
from ehlectric.cases.roughness import find_files
from ehlectric.cases.table import read_toml

AnyCase = Case | BearingCase


def case_of_dict(table: Mapping[str, Any], *, written: bool = False) -> AnyCase:
    """Make a bearing case from tables with a key of bearing files, else a case of a contact.

    Parameters
    ----------
    table : mapping
        Nested tables, as read from a TOML file.
    written : bool
        Whether a person wrote the tables, as ``Table.from_written`` reads them.

    Returns
    -------
    Case or BearingCase
        Case of the contact or of the bearing.

    Raises
    ------
    InputError
        If the tables are not valid; the message names the key, its value, and what is allowed.
    """
    model = BearingCase if "bearing" in table or bearing_key(table) is not None else Case
    return model.from_written(table) if written else model.from_dict(table)


def case_of_file(path: str | Path) -> AnyCase:
    """Read a case of a contact or of a bearing from a TOML file.

    Parameters
    ----------
    path : str or Path
        TOML file.

    Returns
    -------
    Case or BearingCase
        Case of the contact or of the bearing.

    Raises
    ------
    InputError
        If the file cannot be read, is not TOML, or is not a valid case of a contact or of a bearing.
    """
    table = read_toml(path)
    find_files(table, Path(path).parent)
    return case_of_dict(table, written=True)
