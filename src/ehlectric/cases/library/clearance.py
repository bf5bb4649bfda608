"""Classes of the radial internal clearance of bearings, C2 to C5 of ISO 5753-1."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any, Literal, get_args

from ehlectric.cases.amounts import Amount
from ehlectric.errors import InputError, shown

ClearanceClass = Literal["C2", "CN", "C3", "C4", "C5"]
BORE = Amount("m", least=1e-4, most=10.0, reason="of a machine's bearing")
CLASSES: tuple[ClearanceClass, ...] = get_args(ClearanceClass)


@dataclass(frozen=True)
class ClearanceRange:
    """Radial internal clearance that a class allows, before the bearing is mounted.

    Attributes
    ----------
    least, most : float
        Smallest and largest radial internal clearance [m].
    """

    least: float
    most: float

    @property
    def middle(self) -> float:
        """Middle of the range [m]."""
        return float(f"{0.5 * (self.least + self.most):.12g}")


@cache
def _rows() -> tuple[dict[str, str], ...]:
    """Rows of the table of classes, with its comments left out."""
    path = resources.files("ehlectric.cases.library").joinpath("clearances.csv")
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return tuple(csv.DictReader(lines))


def clearance_range(kind: str, clearance_class: ClearanceClass, bore: float) -> ClearanceRange:
    """Range of the radial internal clearance of a new, unmounted bearing with a cylindrical bore.

    Parameters
    ----------
    kind : str
        Kind of the bearing: "deep-groove ball" or "cylindrical roller".
    clearance_class : str
        Class of ISO 5753-1, one of ``CLASSES``.
    bore : float
        Diameter of the bore [m].

    Returns
    -------
    ClearanceRange
        Smallest and largest clearance [m].

    Raises
    ------
    InputError
        If the table of the kind has no bearing of this bore.

    Notes
    -----
    The table is that of ISO 5753-1 as the general catalogues of SKF and NSK print it, which agree.

    Examples
    --------
    >>> clearance_range("deep-groove ball", "C3", 40e-3)
    ClearanceRange(least=1.5e-05, most=3.3e-05)
    """
    size = 1e3 * bore
    rows = [row for row in _rows() if row["kind"] == kind]
    for row in rows:
        # A bore in metres may be above a round number of millimetres by its rounding error.
        if float(row["above"]) < size - 1e-9 <= float(row["to"]):
            low, high = (float(row[f"{clearance_class}_{end}"]) for end in ("min", "max"))
            return ClearanceRange(float(f"{low * 1e-6:.12g}"), float(f"{high * 1e-6:.12g}"))
    if not rows:
        raise InputError.worded("clearance_class", f"has no table for a bearing of kind {kind!r}")
    raise InputError(
        "bore",
        got=f"{size:.6g} mm",
        takes=f"above {rows[0]['above']} and at most {rows[-1]['to']} mm with a clearance_class",
    )


def with_class(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """Table with a class that is given as ``radial_clearance`` in the key ``clearance_class``."""
    name = table.get("radial_clearance")
    if not isinstance(name, str) or name.strip().upper() not in (*CLASSES, "C0"):
        return table
    if table.get("clearance_class") is not None:
        raise InputError("radial_clearance", got=f"{name!r} with clearance_class", takes="one of the two")
    # C0 is an older name of the normal class.
    found = name.strip().upper().replace("C0", "CN")
    return {key: value for key, value in table.items() if key != "radial_clearance"} | {
        "clearance_class": found
    }


def with_clearance(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """Table with the radial clearance that follows from ``clearance_class``, the middle of its range.

    With a table ``fits`` the class is the clearance before mounting, and the table stays as it is.
    """
    name, kind = table.get("clearance_class"), table.get("kind")
    if table.get("fits") is not None or name not in CLASSES or kind not in {row["kind"] for row in _rows()}:
        return table
    if table.get("bore") is None:
        raise InputError.worded("bore", f"missing; clearance_class {name!r} needs the diameter of the bore")
    try:
        bore = BORE.parse(table["bore"])
    except InputError as error:
        raise error.under("bore") from None
    middle = clearance_range(str(kind), name, bore).middle
    given = table.get("radial_clearance")
    if given is not None and given != middle:
        raise InputError(
            "radial_clearance", got=f"{shown(given)} with clearance_class {name!r}", takes="one of the two"
        )
    return {**table, "radial_clearance": middle}
