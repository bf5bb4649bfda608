"""Tables of a calibration: ranges before and after, and measured next to computed values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ehlectric.calibration import CalibratedInput, Calibration, Compared
from ehlectric.cases.measurements import quantity_text
from ehlectric.quantities.formats import amount_text
from ehlectric.quantities.rows import Row
from ehlectric.readable import readable
from ehlectric.tables.measured_tables import columns_table
from ehlectric.tables.probability_rows import input_range

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
        removed = f"{100.0 * max(entry.reduction, 0.0):.0f} %"
        before, after = (range_text(entry, ends) for ends in (entry.prior, entry.posterior))
        yield entry.label.partition(" (")[0], before, after, removed, _correlated(result, place)


def calibration_rows(result: Calibration) -> Iterator[Row]:
    """Rows of the inputs with their ranges, and of measured next to computed values."""
    for entry in result.inputs:
        after = "" if entry.posterior is None else f", after {range_text(entry, entry.posterior)}"
        yield Row(entry.label.partition(" (")[0], f"before {range_text(entry, entry.prior)}", note=after)
    for row in result.rows[:_PRINTED]:
        computed = row.nearest if row.posterior is None else row.posterior[1]
        note = f", computed {amount_text(computed, row.unit)}, residual {row.residual:+.1f}"
        yield Row(f"measured {quantity_text(row.quantity)}", amount_text(row.measured, row.unit), note=note)


def _correlated(result: Calibration, place: int) -> str:
    """Labels of the inputs that are correlated with one after the measurement."""
    texts = []
    for other, entry in enumerate(result.inputs):
        r = float(result.correlation[place, other])
        if other != place and abs(r) >= _CORRELATED:
            texts.append(f"{entry.label.partition(' (')[0]} ({r:.2f})")
    return ", ".join(texts)


def range_text(entry: CalibratedInput, ends: tuple[float, float, float]) -> str:
    """Range of an input from 5 % to 95 % as text, with its unit."""
    return input_range({"key": entry.key, "low": ends[0], "high": ends[2]})


def compared_table(result: Calibration) -> Table:
    """Table of measured next to computed values."""
    heads, *rows = compared_cells(result)
    title = "Measured and computed"
    if len(result.rows) > _PRINTED:
        title += f": {_PRINTED} of {len(result.rows)} values"
    return columns_table(heads, rows[:_PRINTED], title, left=(0, 6), wrapped=(0, 6), padding=2)


def compared_cells(result: Calibration) -> Iterator[tuple[str, ...]]:
    """Heads, and all measured values next to computed ones, as texts."""
    labels = {entry.key: entry.label.partition(" (")[0] for entry in result.inputs}
    third = "after (90 %)" if result.explained else "nearest"
    yield "measured", "value", "+-", "before (90 %)", third, "residual\n/ s", "decides"
    yield from (_row(row, labels) for row in result.rows)


def _row(row: Compared, labels: dict[str, str]) -> tuple[str, ...]:
    """Row of a measured value; its uncertainty is a difference."""
    place = "" if row.line is None else f", line {row.line}"
    unit = row.unit
    error = f"{readable(row.uncertainty, 2)} K" if unit == "K" else amount_text(row.uncertainty, unit)
    third = amount_text(row.nearest, unit) if row.posterior is None else _interval(row.posterior, unit)
    decided = f"{labels[row.decided]} ({100.0 * row.decided_share:.0f} %)" if row.decided else ""
    return (
        f"{quantity_text(row.quantity)}{place}",
        amount_text(row.measured, unit),
        error,
        _interval(row.prior, unit),
        third,
        f"{row.residual:+.1f}",
        decided,
    )


def _interval(ends: tuple[float, float, float], unit: str) -> str:
    """Range from 5 % to 95 % as text."""
    return f"{amount_text(ends[0], unit)} to {amount_text(ends[2], unit)}"
