"""Rows for a sweep and the spread of a value, and the table of its sensitivity indices."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.quantities.formats import scale_of
from ehlectric.quantities.rows import Row
from ehlectric.readable import SAME_NUMBER, readable
from ehlectric.sweep import Sensitivity, SweepResults, breakdown_of, label_of
from ehlectric.tables.measured_tables import columns_table

if TYPE_CHECKING:
    from rich.table import Table


# Maximum number of reasons that are shown; sweep.csv has all of them.
_REASONS = 5

# Numbers, in which reasons of the same kind differ.
_NUMBER = re.compile(r"\d[\d.e+-]*")


def sweep_rows(results: SweepResults) -> list[Row]:
    """Return the rows with the number of points for each status, and the reasons for unsolved points. Returns
    a row for each status, followed by rows for the most frequent reasons of the points with this status.
    """
    rows = []
    for status in ("solved", "not converged", "failed"):
        reasons = [point.reason for point in results.points if point.status == status]
        rows.append(Row(f"points {status}", str(len(reasons)), note=f"of {len(results.points)}"))
        rows += [
            Row(f"  reason, {_points(count)}", note=reason) for count, reason in grouped_reasons(reasons)
        ]
    return rows


def _points(count: int) -> str:
    return "1 point" if count == 1 else f"{count} points"


def grouped_reasons(reasons: Iterable[str]) -> Iterator[tuple[int, str]]:
    """Most frequent reasons with the number of their points; reasons that differ in numbers are one."""
    groups: dict[str, list[str]] = {}
    for reason in filter(None, reasons):
        groups.setdefault(_NUMBER.sub("", reason), []).append(reason)
    ordered = sorted(groups.values(), key=len, reverse=True)
    for group in ordered[:_REASONS]:
        yield len(group), group[0] if len(set(group)) == 1 else f"for example {group[0]}"
    if others := sum(map(len, ordered[_REASONS:])):
        yield others, "other reasons, see sweep.csv"


def spread_rows(results: SweepResults, sensitivity: Sensitivity) -> list[Row]:
    """Rows of the spread of a value over its samples, all in one unit."""
    label, spread = label_of(sensitivity.value, results.case), sensitivity.spread
    scale = label.scaled(np.array([spread.minimum, spread.maximum]))
    values = {"mean": spread.mean, "standard deviation": spread.standard_deviation}
    values |= {"minimum": spread.minimum, "maximum": spread.maximum}
    values |= {f"{100.0 * q:g} % quantile": at for q, at in spread.quantiles.items()}
    unknown = f", {spread.failed} more have no value, and the quantiles do not contain them"
    rows = [Row("samples", str(spread.samples), note=unknown if spread.failed else "")]
    breakdown = breakdown_of(results.case, sensitivity.value)
    at_most = sensitivity.value in (breakdown.value, breakdown.margin)
    for name, value in values.items():
        # Real films break down at lower voltages; that says nothing about how much the voltages scatter.
        bound = label.bound if at_most and name != "standard deviation" else ""
        used = scale_of("K") if label.absolute and name == "standard deviation" else scale
        rows.append(Row(f"{label.name}, {name}", readable(used.of(value), 4), used.unit, bound=bound))
    share = sensitivity.share_below_voltage
    if share is not None:
        voltage = breakdown.voltage_name
        low, high = sensitivity.share_below_voltage_bounds or (share, share)
        shown = share if high - low < SAME_NUMBER else f"{readable(100.0 * low)} to {readable(100.0 * high)}"
        rows.append(Row(f"samples below the {voltage}", shown, "%", digits=".3g"))
    return rows


def indices_table(results: SweepResults, sensitivity: Sensitivity) -> Table:
    """Table of the sensitivity indices of the varied inputs, sorted by decreasing total index."""
    title = f"Sobol indices: share of the variance of the {label_of(sensitivity.value, results.case).name}"
    heads = ("input", "first order", "95 % interval", "total", "95 % interval")
    rows = (
        (
            label_of(index.key, results.case).name,
            f"{index.first_order:.3f}",
            "{:.3f} to {:.3f}".format(*index.first_order_interval),
            f"{index.total:.3f}",
            "{:.3f} to {:.3f}".format(*index.total_interval),
        )
        for index in sorted(sensitivity.indices, key=lambda index: -index.total)
    )
    return columns_table(heads, rows, title, wrapped=(0,), padding=2)
