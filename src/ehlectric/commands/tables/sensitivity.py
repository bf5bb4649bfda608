"""Rows of the spread of a value, and the table of its sensitivity indices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ehlectric.cases.row import Row
from ehlectric.sweep.breakdown_keys import breakdown_of
from ehlectric.sweep.labels import label_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.sensitivity import Sensitivity

if TYPE_CHECKING:
    from rich.table import Table


def spread_rows(results: SweepResults, sensitivity: Sensitivity) -> list[Row]:
    """Rows of the spread of a value over its samples, as texts in a unit that fits all of them."""
    label, spread = label_of(sensitivity.value, results.case), sensitivity.spread
    scale = label.scaled(np.array([spread.minimum, spread.maximum]))
    values = {"mean": spread.mean, "standard deviation": spread.standard_deviation, "least": spread.minimum}
    values |= {f"{100.0 * q:g} %": at for q, at in spread.quantiles.items()} | {"largest": spread.maximum}
    rows = [Row(label.name, str(spread.samples), note="samples")]
    rows += [Row(f"  {name}", f"{scale.factor * value:.4g}", scale.unit) for name, value in values.items()]
    share = sensitivity.share_below_voltage
    if share is not None:
        voltage = breakdown_of(results.case, sensitivity.value).voltage_name
        rows.append(Row(f"  below the {voltage}", share, "%", " of samples", digits=".3g"))
    return rows


def indices_table(results: SweepResults, sensitivity: Sensitivity) -> Table:
    """Table of the sensitivity indices of the varied inputs, the largest total index first."""
    from rich.table import Table

    table = Table(title=None, box=None, padding=(0, 2, 0, 0))
    table.add_column("part of the variance")
    for head in ("first order", "95 % interval", "total", "95 % interval"):
        table.add_column(head, justify="right", no_wrap=True)
    for index in sorted(sensitivity.indices, key=lambda one: -one.total):
        table.add_row(
            label_of(index.key, results.case).name,
            f"{index.first_order:.3f}",
            "{:.3f} to {:.3f}".format(*index.first_order_interval),
            f"{index.total:.3f}",
            "{:.3f} to {:.3f}".format(*index.total_interval),
        )
    return table
