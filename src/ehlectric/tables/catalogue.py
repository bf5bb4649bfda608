"""Table of the bearings of the library."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Any

from rich.table import Table
from rich.text import Text

from ehlectric.cases.library.bearing_catalogue import CatalogueBearing

# Heads of the columns after the name.
_HEADS = ("bore\n[mm]", "outer\n[mm]", "width\n[mm]", "elements\n[mm]", "pitch\n[mm]", "angle\n[deg]")
_RATINGS = ("C\n[kN]", "C0\n[kN]")


def described(bearing: CatalogueBearing) -> dict[str, Any]:
    """Values of a bearing by name, as ``ehlectric bearings --json`` prints them: SI units, angles in rad."""
    rating = bearing.rating
    lengths = ("bore", "outer_diameter", "width", "element_diameter", "roller_length", "pitch_diameter")
    return {
        "name": bearing.name,
        "kind": bearing.kind,
        "elements": bearing.elements,
        **{key: getattr(bearing, key) for key in lengths},
        "contact_angle": bearing.contact_angle,
        "dynamic_rating": rating and rating.dynamic,
        "static_rating": rating and rating.static,
        "rating_of": rating and f"{rating.maker} {rating.designation}",
        "internal_geometry": bearing.internal_kind,
    }


def catalogue_tables(bearings: Iterable[CatalogueBearing]) -> Iterator[Table]:
    """Tables of bearings, one for each kind, with dimensions, printed ratings and kind of the sources.

    Parameters
    ----------
    bearings : iterable of CatalogueBearing
        Bearings of the library.

    Yields
    ------
    rich.table.Table
        Table of one kind of bearing, at most 80 characters wide.
    """
    ordered = sorted(bearings, key=lambda bearing: bearing.kind)
    for kind, group in groupby(ordered, key=lambda bearing: bearing.kind):
        title = Text(f"{kind} bearings")
        table = Table(title=title, title_justify="left", title_style="bold", box=None, padding=(0, 1, 0, 0))
        table.add_column("name", no_wrap=True)
        for head in (*_HEADS, *_RATINGS):
            table.add_column(Text(head), justify="right", no_wrap=True)
        table.add_column("elements\nare", no_wrap=True)
        for bearing in group:
            table.add_row(bearing.name, *_cells(bearing), bearing.internal_kind or "")
        yield table


def _cells(bearing: CatalogueBearing) -> Iterator[str]:
    yield from (_millimetres(size) for size in (bearing.bore, bearing.outer_diameter, bearing.width))
    sizes = filter(None, (bearing.element_diameter, bearing.roller_length))
    yield " x ".join([str(bearing.elements), *map(_millimetres, sizes)])
    yield _millimetres(bearing.pitch_diameter)
    yield f"{math.degrees(bearing.contact_angle):.4g}" if bearing.contact_angle else ""
    rating = bearing.rating
    yield from ("", "") if rating is None else (f"{1e-3 * f:.4g}" for f in (rating.dynamic, rating.static))


def _millimetres(length: float) -> str:
    return f"{1e3 * length:.5g}"
