"""Format of a stored result: its kind and its version, in the attribute ``schema``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.errors import InputError

# No version has more digits.
_DIGITS = 6


def format_of(schema: object) -> tuple[str, int]:
    """Kind and version in a schema, as ``("ehlectric.drive.result", 1)``; ``("", 0)`` where it has none."""
    kind, _, version = str(schema).rpartition("/")
    known = version.isascii() and version.isdecimal() and len(version) <= _DIGITS
    return (kind, int(version)) if known else ("", 0)


def check_format(
    attributes: Mapping[Any, Any], schema: str, path: Path, what: str, *, unnamed: bool = False
) -> None:
    """Check that a file is of a kind, and of a version that can be read.

    Parameters
    ----------
    attributes : mapping
        Attributes of the file.
    schema : str
        Schema of the files that this version of ehlectric writes, as ``"ehlectric.drive.result/1"``.
    path : Path
        The file, named in the error.
    what : str
        What the file should be, as ``"the result of a drive"``.
    unnamed : bool
        Whether files without a schema are taken too: those of contacts before ehlectric 1.0.

    Raises
    ------
    InputError
        If the file is of another kind, or of a later version.

    Examples
    --------
    >>> own, path = "ehlectric.drive.result/2", Path("a.nc")
    >>> check_format({"schema": "ehlectric.drive.result/1"}, own, path, "the result of a drive")
    >>> check_format({"schema": "ehlectric.drive.result/3"}, own, path, "the result of a drive")
    Traceback (most recent call last):
    ehlectric.errors.InputError: a.nc: is of a later version of ehlectric; expected version 2 or
    earlier of ehlectric.drive.result, not 3
    """
    if unnamed and "schema" not in attributes:
        return
    (own, version), (kind, stored) = format_of(schema), format_of(attributes.get("schema"))
    if kind != own or not stored:
        raise InputError(path, f"is not {what} of ehlectric")
    if stored > version:
        takes = f"version {version} or earlier of {own}, not {stored}"
        raise InputError(path, "is of a later version of ehlectric", takes=takes)
