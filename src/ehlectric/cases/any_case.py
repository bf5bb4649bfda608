"""Cases of contacts and of bearings: which of the two a file or a table is."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case, find_files
from ehlectric.cases.table import read_toml

AnyCase = Case | BearingCase


def case_of_dict(table: Mapping[str, Any]) -> AnyCase:
    """A bearing where the tables have one, else a contact.

    Raises
    ------
    InputError
        One line with the key, what it got and what it takes.
    """
    return (BearingCase if "bearing" in table else Case).from_dict(table)


def case_of_file(path: str | Path) -> AnyCase:
    """The case of a TOML file, a bearing's or a contact's.

    Raises
    ------
    InputError
        Where it cannot be read, is not TOML, or is neither.
    """
    table = read_toml(path)
    find_files(table, Path(path).parent)
    return case_of_dict(table)
