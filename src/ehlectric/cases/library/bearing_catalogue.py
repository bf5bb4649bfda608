"""Catalogue of the bearings of the library: dimensions, printed load ratings and sources."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount
from ehlectric.cases.library.sources import Kind, Source, sources_of, weakest

_LENGTH = Amount("m", above=0.0, most=10.0, reason="of a bearing")
_ANGLE = Amount("rad", above=0.0, below=1.6, reason="contact angle")
_FORCE = Amount("N", above=0.0, most=1e9, reason="load rating")

# Keys of the internal geometry that decide how many contacts there are, and how large.
INTERNAL = ("elements", "element_diameter", "pitch_diameter", "roller_length")


@dataclass(frozen=True)
class Rating:
    """Basic load ratings of a bearing as its maker prints them.

    Attributes
    ----------
    maker, designation : str
        Maker, and his name of the bearing.
    dynamic, static : float
        Basic dynamic rating C_r and basic static rating C_0r [N].
    static_factor : float or None
        Factor f_0 of ISO 76, where the maker prints it.
    """

    maker: str
    designation: str
    dynamic: float
    static: float
    static_factor: float | None = None


@dataclass(frozen=True)
class CatalogueBearing:
    """Bearing of the library with its dimensions, ratings and sources.

    Attributes
    ----------
    name : str
        Name for ``bearing.base``.
    kind : str
        Kind of the bearing, as in a bearing file.
    elements : int
        Number Z of balls or rollers.
    bore, outer_diameter, width, element_diameter, pitch_diameter : float
        Dimensions [m].
    roller_length : float or None
        Effective length of a roller [m].
    contact_angle : float
        Contact angle free of load [rad]; zero of deep-groove and roller bearings.
    rating : Rating or None
        Printed load ratings; none of a bearing that no maker sells.
    sources : tuple of Source
        Sources of all values.
    """

    name: str
    kind: str
    elements: int
    bore: float
    outer_diameter: float
    width: float
    element_diameter: float
    pitch_diameter: float
    roller_length: float | None
    contact_angle: float
    rating: Rating | None
    sources: tuple[Source, ...]

    @property
    def internal_kind(self) -> Kind | None:
        """Kind of the weakest source of number, diameter, length and pitch circle of the elements."""
        return weakest(self.sources, INTERNAL)


def catalogue_bearing(name: str) -> CatalogueBearing:
    """Bearing of the library by its name.

    Parameters
    ----------
    name : str
        Name of the bearing, one of ``bearing_names()``.

    Returns
    -------
    CatalogueBearing
        Dimensions and ratings in SI units.

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
