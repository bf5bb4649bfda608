"""Load ratings that makers print for bearings of the library and of the usual series, with their makers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from ehlectric.cases import library
from ehlectric.cases.library.bearing_catalogue import catalogue_bearing
from ehlectric.cases.library.estimated_bearings import estimated_geometry, rating_factors, series


@dataclass(frozen=True)
class PrintedRatings:
    """Printed basic load ratings of a bearing, and the elements to which the rules of ISO 281 relate them."""

    maker: str
    designation: str
    kind: str
    # dynamic and static: basic load ratings [N], as ``bearing.life`` takes them.
    dynamic: float
    static: float
    elements: int
    # element_diameter, pitch_diameter and roller_length: dimensions [m].
    element_diameter: float
    pitch_diameter: float
    roller_length: float | None
    contact_angle: float | None  # [rad]

    @property
    def source(self) -> str:
        """Words for the origin of the ratings."""
        return f"printed by {self.maker} for the {self.designation}"


@cache
def printed_ratings(
    base: str | None, dynamic: float | None = None, static: float | None = None
) -> PrintedRatings | None:
    """Printed load ratings of a bearing by its name; None if no maker's ratings are known.

    ``dynamic`` and ``static``, ratings of a file that replace the printed ones in the estimate of elements
    [N].

    Examples
    --------
    >>> found = printed_ratings("6809")
    >>> found.dynamic, found.source
    (6600.0, 'printed by NSK for the 6809')
    """
    if base is None:
        return None
    if base in library.bearing_names():
        known = catalogue_bearing(base)
        if known.rating is None:
            return None
        return PrintedRatings(
            maker=known.rating.maker,
            designation=known.rating.designation,
            kind=known.kind,
            dynamic=known.rating.dynamic,
            static=known.rating.static,
            elements=known.elements,
            element_diameter=known.element_diameter,
            pitch_diameter=known.pitch_diameter,
            roller_length=known.roller_length,
            contact_angle=known.contact_angle,
        )
    if base not in series():
        return None
    bearing = series()[base]
    geometry = estimated_geometry(bearing, dynamic, static)
    factors = rating_factors(bearing.kind)
    return PrintedRatings(
        maker=_maker(base, bearing.series),
        designation=base.upper(),
        kind=bearing.kind,
        dynamic=factors[0] * bearing.dynamic,
        static=factors[1] * bearing.static,
        elements=geometry.elements,
        element_diameter=geometry.element_diameter,
        pitch_diameter=geometry.pitch_diameter,
        roller_length=geometry.roller_length,
        contact_angle=bearing.contact_angle,
    )


def _maker(name: str, of_series: str) -> str:
    """Maker whose ratings ``series.csv`` contains for a bearing."""
    makers = {row["name"]: row["maker"] for row in library.rows("rating_makers.csv")}
    return makers.get(name) or makers.get(of_series) or makers["other"]
