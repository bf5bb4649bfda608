"""Tables of a sensitivity."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.sweep.results import SweepResults
    from ehlectric.sweep.sensitivity import Sensitivity


def sensitivity_tables(results: SweepResults, found: Sensitivity) -> list[Table]:
    """Spread and indices."""
    import numpy as np
    from rich.table import Table

    from ehlectric.commands.tables.layout import plain_table
    from ehlectric.sweep.breakdown import breakdown_of
    from ehlectric.sweep.labels import label_of

    about = breakdown_of(results.case, found.value)
    label, spread = label_of(found.value, results.case), found.spread
    scale = label.scaled(np.array([spread.minimum, spread.maximum]))
    numbers = plain_table(results.title)
    rows = {"mean": spread.mean, "standard deviation": spread.standard_deviation, "least": spread.minimum}
    rows |= {f"{100.0 * q:g} %": at for q, at in spread.quantiles.items()} | {"largest": spread.maximum}
    numbers.add_row(label.name, f"{spread.samples}", "samples")
    for name, number in rows.items():
        numbers.add_row(f"  {name}", f"{scale.factor * number:.4g}", scale.unit)
    if found.share_below_voltage is not None:
        numbers.add_row(
            "  below the " + about.voltage_name, f"{100.0 * found.share_below_voltage:.3g}", "% of samples"
        )
    parts = Table(title=None, box=None, padding=(0, 2, 0, 0))
    parts.add_column("part of the variance")
    for head in ("first order", "95 % interval", "total", "95 % interval"):
        parts.add_column(head, justify="right", no_wrap=True)
    for index in sorted(found.indices, key=lambda one: -one.total):
        parts.add_row(
            label_of(index.key, results.case).name,
            f"{index.first_order:.3f}",
            "{:.3f} to {:.3f}".format(*index.first_order_interval),
            f"{index.total:.3f}",
            "{:.3f} to {:.3f}".format(*index.total_interval),
        )
    return [numbers, parts]
