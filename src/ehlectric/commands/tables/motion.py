"""Table of a contact whose roughness moves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table


def motion_table(summary: dict[str, Any]) -> Table:
    """The key figures of a run."""
    from ehlectric.commands.tables.layout import add_numbers, plain_table
    from ehlectric.motion.keys import LINE_KEYS
    from ehlectric.sweep.results import flat

    table, numbers = plain_table(summary["title"]), flat(summary)
    numbers["motion.halvings"] = numbers["motion.halvings"] or None
    steps, maxima = numbers["motion.steps"], numbers["field.local_maxima"]
    rows = (
        ("time", "motion.duration", "ms", f" in {steps} steps"),
        ("smallest film", "film.minimum_thickness", "µm", ""),
        ("  at", "film.minimum_time", "ms", ""),
        ("  before the motion", "film.before", "µm", ""),
        ("  held still", "stationary.minimum_thickness", "µm", ""),
        ("largest pressure", "film.max_pressure", "GPa", ""),
        ("  held still", "stationary.max_pressure", "GPa", ""),
        ("voltage", "field.voltage", "V", ""),
        ("largest field", "field.max_strength", "V/µm", ""),
        ("  at", "field.max_strength_time", "ms", ""),
        ("  before the motion", "field.before", "V/µm", ""),
        ("  held still", "stationary.max_strength", "V/µm", ""),
        ("  above 90 % of it", "field.share_above_90", "%", " of the time"),
        ("local maxima, median", "field.local_maxima_quantiles.1", "V/µm", f" of {maxima}"),
        ("  95 %", "field.local_maxima_quantiles.2", "V/µm", ""),
        ("breakdown voltage", "discharge.breakdown_voltage", "V", ", least over time"),
        ("where both lie alike, at", "beside_stationary.time", "ms", ""),
        ("  smallest film, moving", "beside_stationary.minimum_thickness", "µm", ""),
        ("  held still", "beside_stationary.minimum_thickness_stationary", "µm", ""),
        ("  largest field, moving", "beside_stationary.maximum_strength", "V/µm", ""),
        ("  held still", "beside_stationary.maximum_strength_stationary", "V/µm", ""),
        ("time steps halved", "motion.halvings", "", "times, where one was not found"),
        ("Newton steps a time step", "motion.newton_per_step", "", ""),
        ("took", "seconds", "s", ""),
    )
    add_numbers(table, LINE_KEYS, numbers, rows)
    return table
