"""Tables of the terminal made from rows of data, and tables of a measurement next to computed values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ehlectric.cases.defaults import HOW
from ehlectric.cases.film_factors import RAISED, SCATTER, FilmFactors, MeanFactor
from ehlectric.errors import printable
from ehlectric.quantities.formats import amount
from ehlectric.quantities.rows import Row, Summary
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.runtime.progress import RunOutcome


def table_of(rows: Iterable[Row], title: str = "") -> Table:
    """Table of rows for the terminal: names, and next to them values with units and notes. Returns two
    columns, both aligned to the left; values in their shown units.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(
        title=Text(printable(title)) if title else None, show_header=False, title_justify="left", box=None
    )
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    indent = ""
    for row in rows:
        if row.heading:
            table.add_row(Text(printable(row.name)), "", style="bold")
            indent = "  "
        else:
            # Text keeps rich from reading brackets as a style.
            cells = Text(indent + printable(row.name)), Text(printable(row.text))
            table.add_row(*cells, style="red" if row.alarm else None)
    return table


def status_rows(summary: Summary) -> Iterator[Row]:
    """Row that warns of a film that is not converged."""
    if not summary["converged"]:
        status = summary.get("status", "the film of a contact")
        yield Row("NOT CONVERGED", note=f"{status}: do not use these numbers", alarm=True)


def columns_table(
    heads: Sequence[str],
    rows: Iterable[Iterable[str]],
    title: str = "",
    *,
    left: Sequence[int] = (0,),
    wrapped: Sequence[int] = (),
    padding: int = 1,
) -> Table:
    """Table of columns for the terminal. ``left`` are the numbers of columns aligned to the left, ``wrapped``
    of those whose texts may be broken into lines; a row of a single cell is a heading.
    """
    from rich.table import Table
    from rich.text import Text

    # Text keeps rich from reading brackets as a style.
    table = Table(
        title=Text(title) if title else None, title_justify="left", box=None, padding=(0, padding, 0, 0)
    )
    for k, head in enumerate(heads):
        table.add_column(
            Text(head),
            justify="left" if k in left else "right",
            no_wrap=k not in wrapped,
            overflow="fold" if k in wrapped else "ellipsis",
        )
    for row in rows:
        cells = [Text(cell) for cell in row]
        table.add_row(*cells, style="bold" if len(cells) == 1 else None)
    return table


# Largest number of rows that are printed; measured.csv has all of them.
_PRINTED = 30


def measured_tables(outcome: RunOutcome[Any]) -> Iterator[Table]:
    """Tables of the film factors for a result; none without a measurement."""
    for factors in outcome.further_results:
        if isinstance(factors, FilmFactors):
            yield rows_table(factors)
            yield table_of(factor_rows(factors), "Measured and computed")


def rows_table(factors: FilmFactors) -> Table:
    """Table of the rows of a measurement with their film factors."""
    electric = factors.quantity == "capacitance"
    measured, unit, scale = ("capacitance", "pF", 1e12) if electric else ("film", "nm", 1e9)
    speed = "speed\n[rpm]" if electric else "u\n[m/s]"
    heads = ("line", speed, f"measured\n[{unit}]", f"computed\n[{unit}]", "film factor", "±")
    columns, rows = factors.columns, []
    for k in range(min(len(factors.reasons), _PRINTED)):
        at = float(columns[factors.speed_key][k])
        error = columns["factor_uncertainty"][k] if "factor_uncertainty" in columns else math.nan
        rows.append(
            (
                f"{columns['line'][k]:.0f}",
                readable(rpm(at) if electric else at, 4),
                _number(scale * columns[measured][k]),
                _number(scale * columns["computed"][k]),
                "none" if factors.reasons[k] else f"{columns['film_factor'][k]:.3f}",
                _number(error, ".2g"),
            )
        )
    return columns_table(heads, rows, "Rows of the measurement", left=(), padding=2)


def _number(value: float, digits: str = ".4g") -> str:
    return "" if math.isnan(value) else format(value, digits)


def factor_rows(factors: FilmFactors) -> Iterator[Row]:
    """Rows of the mean film factor of a measurement, and how it was found."""
    mean = factors.mean
    yield Row("measurement", factors.source, note=_counted(factors))
    if factors.background is not None:
        yield Row("background subtracted", amount(factors.background, "F"))
    if mean is None:
        yield Row("mean film factor", "none", alarm=True)
    else:
        yield Row("mean film factor", f"{mean.value:.3f}")
        yield Row("95 % interval", _interval(mean), note=_film_error_note(factors))
        if mean.statistical is not None:
            yield Row("standard uncertainty of the rows", mean.statistical, "%", digits=".2g")
        if mean.systematic:
            yield Row("and of the ranges of the case", mean.systematic, "%", digits=".2g")
        elif mean.low is not None:
            yield Row("inputs of the case", "treated as exact", note="; add [ranges] for a wider interval")
    if factors.slope is not None:
        slope, error = factors.slope
        yield Row("film factor over speed", f"speed^({readable(slope, 2)} ± {readable(error, 1)})")
    how = f"{factors.solves} solved" if factors.contacts == "solved" else HOW[factors.contacts]
    yield Row("contacts" if factors.quantity == "capacitance" else "films", how)


def _film_error_note(factors: FilmFactors) -> str:
    """Note on the error of films that are not solved, which is not in the interval."""
    error = factors.formula_error
    return "" if error is None else f"; the {factors.contacts} adds up to {readable(100.0 * error, 2)} %"


def _counted(factors: FilmFactors) -> str:
    points = int(factors.found.sum())
    return f", {points} of {len(factors.reasons)} rows with a film factor"


def _interval(mean: MeanFactor) -> str:
    if mean.low is None or mean.high is None:
        return "none: one row without a stated uncertainty"
    from_rows = {
        SCATTER: ", from the scatter of the rows only",
        RAISED: ", widened to the scatter of the rows",
    }
    return f"{mean.low:.3f} to {mean.high:.3f}{from_rows.get(mean.basis, '')}"
