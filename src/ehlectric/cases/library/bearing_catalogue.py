"""Catalogue of the bearings of the library: dimensions, load ratings, sources, and classes of clearance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, get_args

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount, amount_at
from ehlectric.cases.bearing_kinds import KINDS_OF_BEARINGS
from ehlectric.cases.library.library_oils import Kind, Source, sources_of, weakest
from ehlectric.errors import InputError, shown, within

ClearanceClass = Literal["C2", "CN", "C3", "C4", "C5", "CM"]
CLASSES: tuple[ClearanceClass, ...] = get_args(ClearanceClass)

# Class of a bearing whose designation names none.
NORMAL_CLASS: ClearanceClass = "CN"


@dataclass(frozen=True)
class ClearanceRange:
    """Radial internal clearance that a class allows, before the bearing is mounted."""

    # least and most: smallest and largest radial internal clearance [m].
    least: float
    most: float

    @property
    def middle(self) -> float:
        """Middle of the range [m]."""
        return float(f"{0.5 * (self.least + self.most):.12g}")


# Kinds whose clearances are in the table of another kind.
_TABLE_OF = {"needle roller": "cylindrical roller"}


def clearance_range(kind: str, clearance_class: ClearanceClass, bore: float) -> ClearanceRange:
    """Range of the radial internal clearance [m] of a new, unmounted bearing with a cylindrical bore [m].
    Raises InputError if the table of the kind has no bearing of this bore.

    The table is the table of ISO 5753-1 as the general catalogues of SKF and NSK print it, which agree; the
    table of cylindrical roller bearings also holds for needle roller bearings with an inner ring.

    Examples
    --------
    >>> clearance_range("deep-groove ball", "C3", 40e-3)
    ClearanceRange(least=1.5e-05, most=3.3e-05)
    """
    rows = _clearance_rows(kind, clearance_class)
    row = _row_of_bore(rows, bore)
    if row is not None:
        low, high = (float(row[f"{clearance_class}_{end}"]) for end in ("min", "max"))
        return ClearanceRange(float(f"{low * 1e-6:.12g}"), float(f"{high * 1e-6:.12g}"))
    if not rows:
        of_class = f" of class {clearance_class}" if has_classes(kind) else ""
        text = f"has no table{of_class} for a bearing of kind {kind!r}"
        takes = "radial_clearance, if the kind has one"
        raise InputError.worded("clearance_class", f"{text}; expected {takes}", takes=takes)
    raise InputError(
        "bore",
        got=f"{1e3 * bore:.6g} mm",
        takes=f"above {rows[0]['above']} and at most {rows[-1]['to']} mm with the clearance_class "
        f"{clearance_class!r}; or radial_clearance",
    )


def _clearance_rows(kind: str, clearance_class: ClearanceClass) -> list[Mapping[str, str]]:
    """Rows of the table of a kind that contain a class; the class CM is not printed for needle bearings."""
    if clearance_class == "CM" and kind in _TABLE_OF:
        return []
    rows = (row for row in library.rows("clearances.csv") if row["kind"] == _TABLE_OF.get(kind, kind))
    return [row for row in rows if row[f"{clearance_class}_min"]]


def _row_of_bore(rows: Sequence[Mapping[str, str]], bore: float) -> Mapping[str, str] | None:
    """Row that contains a bore [m]."""
    # A bore in metres may be above a round number of millimetres by its rounding error.
    size = 1e3 * bore - 1e-9
    return next((row for row in rows if float(row["above"]) < size <= float(row["to"])), None)


def has_class(kind: str, clearance_class: ClearanceClass, bore: float) -> bool:
    """Whether the table of a kind contains a class for a bore [m].

    Examples
    --------
    >>> has_class("deep-groove ball", "CN", 8e-3), has_class("deep-groove ball", "CN", 5e-3)
    (True, False)
    """
    return _row_of_bore(_clearance_rows(kind, clearance_class), bore) is not None


def has_classes(kind: str) -> bool:
    """Whether bearings of a kind have a table of classes of clearance.

    Examples
    --------
    >>> has_classes("deep-groove ball"), has_classes("tapered roller")
    (True, False)
    """
    return any(row["kind"] == _TABLE_OF.get(kind, kind) for row in library.rows("clearances.csv"))


def with_class(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """Table with a class that is given as ``radial_clearance`` in the key ``clearance_class``."""
    name = table.get("radial_clearance")
    if not isinstance(name, str) or name.strip().upper() not in (*CLASSES, "C0"):
        return table
    if table.get("clearance_class") is not None:
        raise InputError("radial_clearance", got=f"{name!r} with clearance_class", takes="one of the two")
    # C0 is an older name of the normal class.
    class_name = name.strip().upper().replace("C0", "CN")
    return {key: value for key, value in table.items() if key != "radial_clearance"} | {
        "clearance_class": class_name
    }


def with_clearance(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """Table with the radial clearance that follows from ``clearance_class``, the middle of its range.

    With a table ``fits`` the class is the clearance before mounting, and the table stays as it is.
    """
    name, kind = table.get("clearance_class"), KINDS_OF_BEARINGS.get(str(table.get("kind")))
    if name not in CLASSES or kind is None or "radial_clearance" not in kind.keys:
        return table
    if table.get("inner_ring") is False:
        raise InputError.worded(
            "clearance_class",
            "is not known without an inner ring, as the shaft decides the clearance",
            takes="radial_clearance",
        )
    if table.get("fits") is not None:
        return table
    if table.get("bore") is None:
        raise InputError.worded("bore", f"missing; clearance_class {name!r} needs the diameter of the bore")
    with within("bore"):
        bore = amount_at("bearing.bore").parse(table["bore"])
    middle = clearance_range(table["kind"], name, bore).middle
    given = table.get("radial_clearance")
    if given is not None and given != middle:
        raise InputError(
            "radial_clearance", got=f"{shown(given)} with clearance_class {name!r}", takes="one of the two"
        )
    return {**table, "radial_clearance": middle}


_LENGTH = Amount("m", above=0.0, most=10.0, reason="of a bearing")
_ANGLE = Amount("rad", above=0.0, below=1.6, reason="contact angle")
_FORCE = Amount("N", above=0.0, most=1e9, reason="load rating")

# Keys of the internal geometry that decide how many contacts there are, and how large.
INTERNAL = ("elements", "element_diameter", "pitch_diameter", "roller_length")


@dataclass(frozen=True)
class Rating:
    """Basic load ratings of a bearing as its maker prints them."""

    # maker and designation: maker, and his name of the bearing.
    maker: str
    designation: str
    # dynamic and static: basic dynamic rating C_r and basic static rating C_0r [N].
    dynamic: float
    static: float
    static_factor: float | None = None  # factor f_0 of ISO 76, where the maker prints it


@dataclass(frozen=True)
class CatalogueBearing:
    """Bearing of the library with its dimensions, ratings and sources."""

    name: str
    kind: str
    elements: int  # number Z of balls or rollers
    # bore, outer_diameter, width, element_diameter and pitch_diameter: dimensions [m].
    bore: float
    outer_diameter: float
    width: float
    element_diameter: float
    pitch_diameter: float
    roller_length: float | None  # effective length of a roller [m]
    contact_angle: float  # contact angle free of load [rad]; zero of deep-groove and roller bearings
    rating: Rating | None  # printed load ratings; none of a bearing that no maker sells
    sources: tuple[Source, ...]

    @property
    def internal_kind(self) -> Kind | None:
        """Kind of the weakest source of number, diameter, length and pitch circle of the elements."""
        return weakest(self.sources, INTERNAL)


def catalogue_bearing(name: str) -> CatalogueBearing:
    """Bearing of the library by its name, with its dimensions and ratings in SI units.

    Examples
    --------
    >>> bearing = catalogue_bearing("6208")
    >>> bearing.elements, bearing.outer_diameter, bearing.rating.static
    (9, 0.08, 17900.0)
    """
    tables = library.tables("bearing", name)
    bearing = tables["bearing"]
    lengths = ("bore", "outer_diameter", "width", "element_diameter", "pitch_diameter")
    roller_length, angle = bearing.get("roller_length"), bearing.get("contact_angle")
    return CatalogueBearing(
        name=name,
        kind=bearing["kind"],
        elements=bearing["elements"],
        **{key: _LENGTH.parse(bearing[key]) for key in lengths},
        roller_length=None if roller_length is None else _LENGTH.parse(roller_length),
        contact_angle=0.0 if angle is None else _ANGLE.parse(angle),
        rating=_rating(tables["rating"]) if "rating" in tables else None,
        sources=sources_of(tables),
    )


def _rating(table: Mapping[str, Any]) -> Rating:
    loads = {key: _FORCE.parse(table[key]) for key in ("dynamic", "static")}
    return Rating(**{**table, **loads})


def bearing_catalogue() -> tuple[CatalogueBearing, ...]:
    """All bearings of the library, by name."""
    return tuple(catalogue_bearing(name) for name in library.bearing_names())
