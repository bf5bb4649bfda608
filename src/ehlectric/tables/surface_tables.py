"""Tables of a rough surface: its statistics after every processing step, and its summits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ehlectric.errors import printable
from ehlectric.tables.measured_tables import columns_table

if TYPE_CHECKING:
    from rich.table import Table

# Columns of the statistics of a profile and of a map: head, key, factor to the shown unit, and format.
# Heights from 1 µm on have no decimals.
_PROFILE_COLUMNS = (
    ("Rq\n[nm]", "rq", 1e9, ".1f"),
    ("Ra\n[nm]", "ra", 1e9, ".1f"),
    ("Rsk", "rsk", 1.0, ".2f"),
    ("Rku", "rku", 1.0, ".1f"),
    ("corr.\nlength\n[µm]", "correlation_length", 1e6, ".3g"),
    ("max.\nslope", "largest_slope", 1.0, ".2g"),
)
_MAP_COLUMNS = (
    ("Sq\n[nm]", "sq", 1e9, ".1f"),
    ("Sa\n[nm]", "sa", 1e9, ".1f"),
    ("Ssk", "ssk", 1.0, ".2f"),
    ("Sku", "sku", 1.0, ".1f"),
    ("corr.\nlength\nx [µm]", "correlation_length_x", 1e6, ".3g"),
    ("corr.\nlength\ny [µm]", "correlation_length_y", 1e6, ".3g"),
    ("max.\nslope", "largest_slope", 1.0, ".2g"),
)

# Columns of the summits: head, key, factor to the shown unit, and format.
_SUMMIT_COLUMNS = (
    ("interval\n[µm]", "interval", 1e6, ".3g"),
    ("m0\n[nm²]", "m0", 1e18, ".3g"),
    ("m2\n[1e-6]", "m2", 1e6, ".3g"),
    ("m4\n[1/mm²]", "m4", 1e-6, ".3g"),
    ("band-\nwidth", "bandwidth", 1.0, ".3g"),
    ("summits\n[1/mm²]", "summit_density", 1e-6, ".3g"),
    ("radius\n[µm]", "summit_radius", 1e6, ".3g"),
    ("height dev.\n[nm]", "summit_deviation", 1e9, ".3g"),
    ("slope\nx/y", "slope_ratio", 1.0, ".2f"),
)

# Title of the table of the summits, and sentences below it.
SUMMITS_TITLE = "spectral moments and summits after the last step"
SUMMITS_NOTE = (
    "Bandwidth, density and radius belong to the sampling interval: name it with the numbers. They hold for "
    "Gaussian heights (skewness 0, kurtosis 3). A dash stands where no isotropic Gaussian surface has the "
    "bandwidth, below 1.5."
)


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
    columns = [column for column in _SUMMIT_COLUMNS if column[1] in summits[0]]
    rows = [tuple(_number(row[key], factor, how) for _, key, factor, how in columns) for row in summits]
    return tuple(head for head, *_ in columns), rows


def size_text(surface: Mapping[str, Any]) -> str:
    """Points, spacing, voids and height resolution of a surface with processing steps."""
    first = surface["steps"][0]
    axes = ("spacing_x", "spacing_y") if "sq" in first else ("spacing",)
    spacing = " x ".join(f"{first[axis] * 1e6:.6g}" for axis in axes)
    parts = [*filter(None, [_size(surface["size"])]), f"spacing {spacing} µm"]
    if surface["voids"]:
        parts.append(f"{100 * surface['voids']:.2g} % voids")
    if surface["height_step"] is not None:
        parts.append(f"height resolution {surface['height_step'] * 1e9:.2g} nm")
    return ", ".join(parts)


def statistics_rows(surface: Mapping[str, Any]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Heads of the statistics of a profile or map with their units, and a row for every processing step."""
    of_map = "sq" in surface["steps"][0]
    columns = _MAP_COLUMNS if of_map else _PROFILE_COLUMNS
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
