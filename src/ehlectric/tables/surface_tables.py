"""Tables of a rough surface: its statistics after every processing step, and its summits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ehlectric.errors import printable
from ehlectric.quantities.sheets import SURFACES
from ehlectric.readable import readable
from ehlectric.tables.measured_tables import columns_table

if TYPE_CHECKING:
    from rich.table import Table

# Title of the table of the summits, and sentences below it.
SUMMITS_TITLE, SUMMITS_NOTE = SURFACES["summits_title"], SURFACES["summits_note"]


def surface_table(surface: dict[str, Any]) -> Table:
    """Table of a profile or map: its source and size, and its statistics after every processing step."""
    source = printable(surface["source"] or "generated")
    title = f"surface {surface['surface']}: {source}\n{size_text(surface)}"
    return columns_table(*statistics_rows(surface), title)


def summits_table(summits: Sequence[Mapping[str, float | None]]) -> Table:
    """Table of spectral moments and summits, a row for each sampling interval; a dash for no summits."""
    return columns_table(*summits_rows(summits), SUMMITS_TITLE, left=())


def summits_rows(
    summits: Sequence[Mapping[str, float | None]],
) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads of the moments and summits with their units, and a row for every sampling interval."""
    columns = [column for column in SURFACES["summits"] if column[1] in summits[0]]
    rows = [tuple(_number(row[key], factor, how) for _, key, factor, how in columns) for row in summits]
    return tuple(head for head, *_ in columns), rows


def size_text(surface: Mapping[str, Any]) -> str:
    """Points, spacing, voids and height resolution of a surface with processing steps."""
    first = surface["steps"][0]
    axes = ("spacing_x", "spacing_y") if "sq" in first else ("spacing",)
    spacing = " x ".join(readable(first[axis] * 1e6, 6) for axis in axes)
    parts = [*filter(None, [_size(surface["size"])]), f"spacing {spacing} µm"]
    if surface["voids"]:
        parts.append(f"{readable(100 * surface['voids'], 2)} % voids")
    if surface["height_step"] is not None:
        parts.append(f"height resolution {readable(surface['height_step'] * 1e9, 2)} nm")
    return ", ".join(parts)


def statistics_rows(surface: Mapping[str, Any]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads of the statistics of a profile or map with their units, and a row for every processing step."""
    of_map = "sq" in surface["steps"][0]
    columns = SURFACES["map" if of_map else "profile"]
    heads = ("step", "points", *(head for head, *_ in columns))
    rows = []
    for step in surface["steps"]:
        points = f"{step['points_x']}x{step['points_y']}" if of_map else str(step["points"])
        rows.append(
            (
                step["step"],
                points,
                *(
                    _number(step[key], factor, ".0f" if factor == 1e9 and step[key] >= 1e-6 else how)
                    for _, key, factor, how in columns
                ),
            )
        )
    return heads, rows


def _size(size: list[int] | None) -> str:
    """Number of points that were read, of a map along both directions."""
    if size is None:
        return ""
    return " x ".join(str(count) for count in size if count > 1 or len(size) == 1) + " points"


def _number(value: float | None, factor: float, how: str) -> str:
    """Number in its shown unit; a dash where there is none."""
    return "\N{EN DASH}" if value is None else format(value * factor, how)
