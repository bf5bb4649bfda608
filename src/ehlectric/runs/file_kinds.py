"""Kinds of files: how each is recognised, and the message for a file given to the wrong command.

The kinds are the cases of a contact, with or without motion, bearing files, drive files with or without the
shafts of an axle, gear files and sweep files.
Results are recognised by the first bytes of their files, so that their names do not matter.
"""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from ehlectric.cases.table import read_toml, tables_of_text
from ehlectric.errors import InputError
from ehlectric.runtime.reading import read_text

FileKind = Literal["contact", "motion", "bearing", "drive", "gear", "axle", "sweep"]

# Tables and keys that only sweep files have.
_OF_SWEEPS = ("case", "vary", "design")

# Tables that only drive files have.
_OF_DRIVES = ("source", "circuit", "breakdown", "drive", "drive_end", "non_drive_end")

# Name of a file of each kind, and the command that solves it.
_NAMES: Mapping[FileKind, tuple[str, str]] = MappingProxyType(
    {
        "contact": ("a case of a contact", "run"),
        "motion": ("a case of a contact", "run"),
        "bearing": ("a bearing file", "bearing"),
        "drive": ("a drive file", "drive"),
        "gear": ("a gear file", "gear"),
        "axle": ("a drive file of an axle", "drive"),
        "sweep": ("a sweep file", "sweep"),
    }
)

# First bytes of results, what they are, and how they are drawn.
_RESULTS = (
    (b"\x89HDF", "a NetCDF file, such as a result", "plot {file}"),
    (b"CDF", "a NetCDF file, such as a result", "plot {file}"),
    (b"SQLite format 3", "the database of a sweep or of moving roughness", "plot {folder}"),
)
_SUMMARY = "summary.json"


@dataclass(frozen=True)
class InputFile:
    """TOML file of a user with its tables, which are read once."""

    path: Path
    table: dict[str, Any]
    kind: FileKind


def read_input(path: str | Path) -> InputFile:
    """Read a TOML file of any kind, which follows from its tables. Raises InputError if the file cannot be
    read or is not TOML.
    """
    table = read_toml(path)
    return InputFile(Path(path), table, kind_of_tables(table) or "contact")


def expect(path: Path, *kinds: FileKind) -> InputFile:
    """Read the TOML file of a command, which solves some kinds; the error of another kind names the right
    command. Raises InputError if the file cannot be read, is a result, is not TOML, or is of another kind.
    """
    if path.is_dir():
        raise InputError(path, "is a folder", takes=f"a TOML file; draw results with: {_typed('plot', path)}")
    table = tables_of_text(read_text(path, refuse=partial(_refuse_result, path)), path)
    kind = kind_of_tables(table) or kinds[0]
    if kind not in kinds:
        name, command = _NAMES[kind]
        names = [*dict.fromkeys(_NAMES[each][0] for each in kinds)]
        expected = " or ".join(filter(None, [", ".join(names[:-1]), names[-1]]))
        raise InputError(path, f"is {name}", takes=f"{expected}; solve it with: {_typed(command, path)}")
    return InputFile(path, table, kind)


def command_of_file(path: str | Path) -> str:
    """Command that solves a TOML file, such as "run" or "bearing". Raises InputError if the file cannot be
    read or is not TOML.
    """
    return _NAMES[read_input(path).kind][1]


def refuse_input(path: Path) -> None:
    """Refuse a TOML file where a result is expected, and name the command that solves it. Raises InputError
    if the suffix of the file is a suffix of TOML files.
    """
    if path.suffix.lower() == ".toml" and path.is_file():
        name, command = _NAMES[read_input(path).kind]
        raise InputError(path, f"is {name}", takes=f"a result; solve it with: {_typed(command, path)}")


def kind_of_tables(table: Mapping[str, Any]) -> FileKind | None:
    """Kind of the tables of a file; None if none of them determines it."""
    if any(key in table for key in _OF_SWEEPS):
        return "sweep"
    if "shaft" in table:
        return "axle"
    if any(key in table for key in _OF_DRIVES):
        return "drive"
    if "gear" in table:
        return "gear"
    if "bearing" in table:
        return "bearing"
    if "motion" in table:
        return "motion"
    if "contact" in table:
        return "contact"
    # Bearing files load the physics of bearings, which few files without a table of a kind need.
    from ehlectric.cases.bearing_case import bearing_key

    return None if bearing_key(table) is None else "bearing"


def _refuse_result(path: Path, start: bytes) -> None:
    """Refuse a result where a TOML file is expected, by its first bytes, and name the command that draws
    it.
    """
    for first, name, command in _RESULTS:
        if start.startswith(first):
            draw = "ehlectric " + command.format(file=_quoted(path), folder=_quoted(path.parent))
            raise InputError(path, f"is {name}", takes=f"a TOML file; draw it with: {draw}")
    if path.name == _SUMMARY:
        draw = _typed("plot", path.parent)
        raise InputError(path, "is the summary of a result", takes=f"a TOML file; draw it with: {draw}")


def _typed(command: str, path: Path) -> str:
    """Command line that gives a file to a command."""
    return f"ehlectric {command} {_quoted(path)}"


def _quoted(path: Path) -> str:
    return shlex.quote(str(path))
