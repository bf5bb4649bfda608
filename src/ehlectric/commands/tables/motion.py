"""Table of a contact whose roughness moves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table


def motion_table(summary: dict[str, Any]) -> Table:
    """The key figures of a run."""
    from ehlectric.commands.tables.layout import plain_table

    table = plain_table(summary["title"])
    course, film, field = summary["motion"], summary["film"], summary["field"]
    still, beside = summary["stationary"] or {}, summary["beside_stationary"] or {}
    breaks = summary["discharge"] or {}
    quantiles = field["local_maxima_quantiles"] or (None, None, None)
    rows: tuple[tuple[str, float | None, float, str], ...] = (
        ("time", course["duration"], 1e3, f"ms in {course['steps']} steps"),
        ("smallest film", film["minimum_thickness"], 1e6, "µm"),
        ("  at", film["minimum_time"], 1e3, "ms"),
        ("  before the motion", film["before"], 1e6, "µm"),
        ("  held still", still.get("minimum_thickness"), 1e6, "µm"),
        ("largest pressure", film["max_pressure"], 1e-9, "GPa"),
        ("  held still", still.get("max_pressure"), 1e-9, "GPa"),
        ("voltage", field["voltage"], 1.0, "V"),
        ("largest field", field["max_strength"], 1e-6, "V/µm"),
        ("  at", field["max_strength_time"], 1e3, "ms"),
        ("  before the motion", field["before"], 1e-6, "V/µm"),
        ("  held still", still.get("max_strength"), 1e-6, "V/µm"),
        ("  above 90 % of it", field["share_above_90"], 100.0, "% of the time"),
        ("local maxima, median", quantiles[1], 1e-6, f"V/µm of {field['local_maxima']}"),
        ("  95 %", quantiles[2], 1e-6, "V/µm"),
        ("breakdown voltage", breaks.get("breakdown_voltage"), 1.0, "V, least over time"),
        ("where both lie alike, at", beside.get("time"), 1e3, "ms"),
        ("  smallest film, moving", beside.get("minimum_thickness"), 1e6, "µm"),
        ("  held still", beside.get("minimum_thickness_stationary"), 1e6, "µm"),
        ("  largest field, moving", beside.get("maximum_strength"), 1e-6, "V/µm"),
        ("  held still", beside.get("maximum_strength_stationary"), 1e-6, "V/µm"),
        ("time steps halved", course["halvings"] or None, 1.0, "times, where one was not found"),
        ("Newton steps a time step", course["newton_per_step"], 1.0, ""),
        ("took", summary["seconds"], 1.0, "s"),
    )
    for name, value, scale, unit in rows:
        if value is not None:
            table.add_row(name, f"{value * scale:.4g}", unit)
    return table
