"""Plan of a sweep: the points to solve, the key of each case, and what comes of a point."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ehlectric.cases.drives.swept import SweptCase
from ehlectric.errors import InputError
from ehlectric.runtime.reading import regular
from ehlectric.sweep.inputs import Sweep
from ehlectric.sweep.results import Status
from ehlectric.version import __version__

# Points whose tables are kept from the plan to the solution, about 10 MB. The others are made twice.
_TABLES_KEPT = 2000


@dataclass(frozen=True)
class Planned:
    """Point of a sweep before it is solved.

    Attributes
    ----------
    number : int
        Number of the point in the order of the design, from 0.
    inputs : mapping
        Values of the varied keys, by dotted key of the case, in SI units.
    key : str or None
        Key of its case, from ``case_key``; None if these inputs make no valid case.
    refused : str
        Reason why the inputs make no valid case; empty if they do.
    table : mapping or None
        Tables of its case, for the first points only, which would fill the memory of a large sweep.
    """

    number: int
    inputs: Mapping[str, Any]
    key: str | None
    refused: str = ""
    table: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class Outcome:
    """Outcome of a point that was tried.

    Attributes
    ----------
    status : str
        "solved", "not converged" or "failed".
    reason : str
        Reason why the point is not solved; empty if it is.
    again : bool
        Whether another try may succeed, as after a killed process.
    summary : mapping or None
        Nested tables, as in summary.json; None if the point failed.
    seconds : float
        Time taken by the solution [s].
    version : str
        Version of ehlectric that tried the point.
    date : str
        Date and time of the outcome, ISO 8601.
    """

    status: Status
    reason: str = ""
    again: bool = False
    summary: Mapping[str, Any] | None = None
    seconds: float = 0.0
    version: str = __version__
    date: str = ""


def case_key(case: SweptCase) -> str:
    """Hash of everything that the solution of a case depends on.

    The hash covers all inputs, with their defaults, and the contents of files, but not the title and the
    paths of files.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        A valid case.

    Returns
    -------
    str
        SHA-256 hash, hexadecimal.

    Raises
    ------
    InputError
        If a file of the case cannot be read.

    Examples
    --------
    >>> from ehlectric.cases.any_case import case_of_dict
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = case_of_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> case_key(case) == case_key(case.replace(title="Another", solver={"max_iterations": 30}))
    True
    """
    table = case.to_dict()
    del table["title"]
    # Rough surfaces, and the measured voltage of a drive.
    for holder in (*table.get("roughness", ()), table.get("source", {})):
        if "file" in holder:
            path = Path(holder["file"])
            with regular(path) as file:
                status = os.fstat(file.fileno())
            holder["file"] = _contents(path, status.st_mtime_ns, status.st_size)
    text = json.dumps(table, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


@cache
def _contents(path: Path, _changed: int, _size: int) -> str:
    """SHA-256 hash of a file; it is read again only when its time of change or size differs."""
    with regular(path) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def plan(sweep: Sweep) -> Iterator[Planned]:
    """Points of a sweep, each with the key of its case, or with the reason why it is no valid case."""
    for number, inputs in enumerate(sweep.points()):
        try:
            case = sweep.case.replace(inputs)
            table = case.to_dict() if number < _TABLES_KEPT else None
            yield Planned(number, inputs, case_key(case), table=table)
        except InputError as error:
            yield Planned(number, inputs, None, str(error))
