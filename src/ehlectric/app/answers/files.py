"""Files that come into a page and that a page offers, as data."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from ehlectric.app.answers.told import Told

# Largest uploaded files: of a case, and of a surface that a case names [bytes].
MOST_CASE, MOST_SURFACE = 200_000, 20_000_000

# Files that are opened at once.
MOST_FILES = 12

# Kinds of downloads from a folder of results.
Download = Literal["csv", "netcdf", "summary", "figures", "all"]


@dataclass(frozen=True)
class Uploaded:
    """Uploaded case or sweep.

    Attributes
    ----------
    name : str
        Name of its file.
    kind : str
        "contact", "motion", "bearing" or "sweep".
    table : mapping
        Its tables; names of files are relative to the folder of the session.
    missing : tuple of str
        Names of files that the case names and that are still to be uploaded. The tables are checked once
        none is missing.
    """

    name: str
    kind: str
    table: Mapping[str, Any]
    missing: tuple[str, ...] = ()


@dataclass(frozen=True)
class Written:
    """Files of a result as the command writes them.

    Attributes
    ----------
    folder : str
        Folder of the files.
    names : tuple of str
        Their names.
    failure : str
        What was not solved; empty where all was.
    warnings : tuple of Told
        Warnings of the result and of its figures.
    """

    folder: str
    names: tuple[str, ...]
    failure: str = ""
    warnings: tuple[Told, ...] = ()


def file_title(title: object) -> str:
    """Name of files from the title of a case: small letters, digits and hyphens.

    Examples
    --------
    >>> file_title("Ball bearing, 6208 / VG 46"), file_title("../.."), file_title(None)
    ('ball-bearing-6208-vg-46', 'case', 'case')
    """
    words = re.findall(r"[a-z0-9]+", str(title).lower()) if title else []
    return "-".join(words)[:60].strip("-") or "case"
