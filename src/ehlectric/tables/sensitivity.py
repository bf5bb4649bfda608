"""Rows of the spread of a value, and the table of its sensitivity indices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ehlectric.quantities.quantity import Bound
from ehlectric.quantities.rows import Row
from ehlectric.sweep.breakdown_keys import breakdown_of
from ehlectric.sweep.labels import label_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.sensitivity import Sensitivity

if TYPE_CHECKING:
    from rich.table import Table


def spread_rows(results: SweepResults, sensitivity: Sensitivity) -> list[Row]:
    """Rows of the spread of a value over its samples, all in one unit."""
    label, spread = label_of(sensitivity.value, results.case), sensitivity.spread
    scale = label.scaled(np.array([spread.minimum, spread.maximum]))
    values = {"mean": spread.mean, "standard deviation": spread.standard_deviation}
    values |= {"minimum": spread.minimum, "maximum": spread.maximum}
    values |= {f"{100.0 * q:g} % quantile": at for q, at in spread.quantiles.items()}
    rows = [Row("samples", str(spread.samples))]
    breakdown = breakdown_of(results.case, sensitivity.value)
    at_most = sensitivity.value in (breakdown.value, breakdown.margin)
    for name, value in values.items():
        # Real films break down at lower voltages; that says nothing about how much the voltages scatter.
        bound: Bound = "≤" if at_most and name != "standard deviation" else ""
        rows.append(Row(f"{label.name}, {name}", f"{scale.factor * value:.4g}", scale.unit, bound=bound))
    share = sensitivity.share_below_voltage
    if share is not None:
        voltage = breakdown.voltage_name
        rows.append(Row(f"samples below the {voltage}", share, "%", digits=".3g"))
    return rows


def indices_table(results: SweepResults, sensitivity: Sensitivity) -> Table:
    """Table of the sensitivity indices of the varied inputs, sorted by decreasing total index."""
    from rich.table import Table
    from rich.text import Text

    title = f"Sobol indices: share of the variance of the {label_of(sensitivity.value, results.case).name}"
    table = Table(title=Text(title), title_justify="left", box=None, padding=(0, 2, 0, 0))
    table.add_column("input")
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
