"""Cases that a sweep varies: those of contacts, bearings and drives, read from files and tables."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.cases.any_case import AnyCase, case_of_dict
from ehlectric.cases.drives.case import ENDS, DriveCase, with_files
from ehlectric.cases.roughness import find_files
from ehlectric.cases.table import read_toml

SweptCase = AnyCase | DriveCase


def swept_case_of_dict(table: Mapping[str, Any], *, written: bool = False) -> SweptCase:
    """Make a drive case from tables with the key of one of its bearings, else a case of a bearing or contact.

    Parameters
    ----------
    table : mapping
        Nested tables, as read from a TOML file.
    written : bool
        Whether a person wrote the tables, as ``Table.from_written`` reads them.

    Returns
    -------
    Case, BearingCase or DriveCase
        Case of the contact, of the bearing or of the drive.

    Raises
    ------
    InputError
        If the tables are not valid; the message names the key, its value, and what is allowed.
    """
    if not any(end in table for end in ENDS):
        return case_of_dict(table, written=written)
    return DriveCase.from_written(table) if written else DriveCase.from_dict(table)


def swept_case_of_file(path: str | Path) -> SweptCase:
    """Read a case of a contact, of a bearing or of a drive from a TOML file.

    Parameters
    ----------
    path : str or Path
        TOML file.

    Returns
    -------
    Case, BearingCase or DriveCase
        Case of the contact, of the bearing or of the drive.

    Raises
    ------
    InputError
        If the file cannot be read, is not TOML, or is not a valid case.
    """
    return swept_case_of_dict(with_found_files(read_toml(path), Path(path).parent), written=True)


def with_found_files(table: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Tables of a case of any kind whose files lie relative to a folder.

    Parameters
    ----------
    table : dict
        Nested tables of a file in the folder.
    folder : Path
        Folder of the file.

    Returns
    -------
    dict
        Tables with absolute names of surfaces and waveforms, and with the bearings of bearing files.

    Raises
    ------
    InputError
        If a bearing file of a drive cannot be read or is not valid.
    """
    find_files(table, folder)
    return with_files(table, folder)
