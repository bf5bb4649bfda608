"""Tables of a calibration: ranges before and after, and measured next to computed values."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ehlectric.bearing import is_factor
from ehlectric.calibration import CalibratedInput, Calibration, Compared
from ehlectric.cases.input_keys import unit_of
from ehlectric.cases.measurements import quantity_text
from ehlectric.quantities.formats import amount_text, suited
from ehlectric.quantities.rows import Row
from ehlectric.readable import readable
from ehlectric.tables.measured_tables import columns_table
from ehlectric.tables.probability_rows import interval_text

if TYPE_CHECKING:
    from rich.table import Table

# Largest number of measured values that are printed; compared.csv has all of them.
_PRINTED = 30

# Largest correlations that are printed, and least one that is.
_CORRELATED = 0.5


def inputs_table(result: Calibration) -> Table:
    """Table of the inputs with their 90 % ranges before and after the measurement."""
    heads, *rows = input_cells(result)
    return columns_table(heads, rows, "Uncertain inputs", left=(0, 1, 2, 4), wrapped=(0, 4), padding=2)


def input_cells(result: Calibration) -> Iterator[tuple[str, ...]]:
    """Heads, and the inputs with their 90 % ranges before and after the measurement, as texts."""
    yield "input", "before (90 %)", "after (90 %)", "variance\nremoved", "correlated with"
    for place, entry in enumerate(result.inputs):
        if entry.posterior is None or entry.reduction is None:
            continue
        removed = f"{_part(max(entry.reduction, 0.0))} ± {_part(entry.reduction_error or 0.0)} %"
        before = range_text(entry, entry.prior)
        after = range_text(entry, entry.posterior) if entry.updated else "as before"
        yield entry.label.partition(" (")[0], before, after, removed, _correlated(result, place)


def calibration_rows(result: Calibration) -> Iterator[Row]:
    """Rows of the inputs with their ranges, and of measured next to computed values."""
    for entry in result.inputs:
        after = f", after {range_text(entry, entry.posterior)}" if entry.posterior and entry.updated else ""
        yield Row(entry.label.partition(" (")[0], f"before {range_text(entry, entry.prior)}", note=after)
    for row in result.rows[:_PRINTED]:
        computed = row.nearest if row.posterior is None else row.posterior[1]
        note = f", computed {amount_text(computed, row.unit)}, residual {_signed(row.residual)}"
        yield Row(f"measured {quantity_text(row.quantity)}", amount_text(row.measured, row.unit), note=note)


def _correlated(result: Calibration, place: int) -> str:
    """Labels of the inputs that are correlated with one after the measurement."""
    if not result.inputs[place].updated:
        return ""
    texts = []
    for other, entry in enumerate(result.inputs):
        r = float(result.correlation[place, other])
        if other != place and abs(r) >= _CORRELATED:
            texts.append(f"{entry.label.partition(' (')[0]} ({r:.2f})")
    return ", ".join(texts)


def range_text(entry: CalibratedInput, ends: tuple[float, float, float]) -> str:
    """Range of an input from 5 % to 95 % as text, with its unit."""
    return interval_text(ends[0], ends[2], "" if is_factor(entry.key) else unit_of(entry.key), 3)


def compared_table(result: Calibration) -> Table:
    """Table of measured next to computed values, a line for each value."""
    heads, *rows = compared_cells(result)
    title = "Measured and computed"
    if len(result.rows) > _PRINTED:
        title += f": {_PRINTED} of {len(result.rows)} values"
    # The inputs that the values decide are in compared.csv: their labels need more than the width of a line.
    kept = ([*row[:-1]] for row in rows[:_PRINTED])
    return columns_table(heads[:-1], kept, title, wrapped=(0,), padding=2)


def compared_cells(result: Calibration) -> Iterator[tuple[str, ...]]:
    """Heads, and all measured values next to computed ones, as texts."""
    labels = {entry.key: entry.label.partition(" (")[0] for entry in result.inputs}
    third = "after (90 %)" if result.explained else "nearest"
    yield "measured", "value", "before (90 %)", third, "residual", "decides"
    yield from (_row(row, labels) for row in result.rows)


def _row(row: Compared, labels: dict[str, str]) -> tuple[str, ...]:
    """Row of a measured value."""
    place = "" if row.line is None else f", line {row.line}"
    unit = row.unit
    third = amount_text(row.nearest, unit) if row.posterior is None else _interval(row.posterior, unit)
    decided = f"{labels[row.decided]} ({100.0 * row.decided_share:.0f} %)" if row.decided else ""
    return (
        f"{quantity_text(row.quantity)}{place}",
        _with_uncertainty(row),
        _interval(row.prior, unit),
        third,
        _signed(row.residual),
        decided,
    )


def _with_uncertainty(row: Compared) -> str:
    """Measured value with its uncertainty, which is a difference."""
    if row.unit == "K":
        return f"{amount_text(row.measured, row.unit)} ± {readable(row.uncertainty, 2)} K"
    factor, unit = suited(row.measured, row.unit)
    value, error = readable(factor * row.measured, 4), readable(factor * row.uncertainty, 2)
    return f"{value} ± {error} {unit}".rstrip()


def _signed(residual: float) -> str:
    """Residual with its sign; a sum with 0 has no negative zero."""
    return f"{round(residual, 1) + 0.0:+.1f}"


def _part(share: float) -> str:
    return f"{100.0 * share:.0f}"


def _interval(ends: tuple[float, float, float], unit: str) -> str:
    """Range from 5 % to 95 % as text."""
    low, _, high = ends
    if not math.isfinite(low):
        return "none"
    factor, prefixed = suited(high, unit)
    if unit == "K" or factor == 1.0:
        return interval_text(low, high, unit, 3)
    return f"{readable(factor * low)} to {readable(factor * high)} {prefixed}"
