"""Answers about a duty cycle: what its file has, and shares, worst stretches and figure of its result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ehlectric.app.charts.duty_charts import DUTY_HEADS, MOST_DUTY_ROWS, duty_figure, duty_rows
from ehlectric.app.compute.answer_parts import lines_of, page_warnings_of, with_session_files
from ehlectric.app.view_models import DutyAnswer, Figure, Table
from ehlectric.bearing import DutyResult
from ehlectric.cases.duty_inputs import read_cycle
from ehlectric.cases.measurements import void_rows
from ehlectric.quantities.quantity import Quantity
from ehlectric.quantities.result_bounds import bearing_bounds
from ehlectric.quantities.results import BEARING_BOOK
from ehlectric.quantities.rows import Row, row_of
from ehlectric.readable import capital, readable
from ehlectric.tables.bearing_tables import total_rows

_STRETCH = "duty.stretches"


def look(file: str, session: Path) -> str:
    """Sentence about the file of a duty cycle in the folder of a session: rows, duration and columns.

    Raises InputError where the file is no duty cycle.
    """
    cycle = read_cycle(with_session_files({"duty": {"file": file}}, session)["duty"]["file"])
    names = ", ".join(name.replace("_", " ").replace("common mode", "common-mode") for name in cycle.values)
    text = f"{cycle.time.size} rows over {readable(cycle.time[-1] - cycle.time[0], 6)} s: {names}."
    text += f" Ignored: {', '.join(cycle.ignored)}." if cycle.ignored else ""
    return text + "".join(f" {warning.text}" for warning in void_rows(cycle.read))


def shown_duty(duty: DutyResult, summary: Mapping[str, Any]) -> DutyAnswer:
    """Answer of a duty cycle from the summary of its bearing, which has its table ``duty``."""
    rows = [row for row in total_rows(summary) if row.key.startswith("duty.")]
    about = duty.rows
    names = ["speed", "lambda ratio", *(["margin"] if about.has_margin else [])]
    what = f"{', '.join(names[:-1])} and {names[-1]}"
    caption = f"{about.time.size} rows of the cycle"
    if about.time.size > MOST_DUTY_ROWS:
        caption = f"{MOST_DUTY_ROWS} of {caption}, evenly spaced; duty.csv has all"
    return DutyAnswer(
        lines=lines_of(row for row in rows if not row.key.startswith(_STRETCH)),
        stretches=_stretches_table(summary),
        figure=Figure(
            f"{capital(what)} over the duty cycle",
            f"{capital(what)} over the time, with bands of the states of lubrication",
            duty_figure(duty),
            Table(caption, DUTY_HEADS, tuple(duty_rows(duty))),
        ),
        warnings=page_warnings_of(duty.warnings),
    )


def _stretches_table(summary: Mapping[str, Any]) -> Table | None:
    """Table of the worst stretches, the worst first; None without any."""
    stretches = summary["duty"]["stretches"]
    if not stretches:
        return None
    margins = stretches[0]["least_margin"] is not None
    value = "least_margin" if margins else "lambda_ratio"
    keys = [f"{_STRETCH}.{name}" for name in ("start", "end", value, "time", "speed", "why")]
    bounds = bearing_bounds(BEARING_BOOK, summary)
    limit = "margin below 1" if margins else "lambda ratio below 3"
    return Table(
        f"Worst stretches with a {limit}, the worst first",
        tuple(_head(BEARING_BOOK[key]) for key in keys),
        tuple(tuple(_cells(stretch, keys, bounds)) for stretch in stretches),
    )


def _head(about: Quantity) -> str:
    name = about.head or about.label
    return f"{name} [{about.shown}]" if about.shown else name


def _cells(stretch: Mapping[str, Any], keys: list[str], bounds: Mapping[str, Any]) -> Iterator[str]:
    for key in keys:
        row: Row = row_of(key, BEARING_BOOK[key], stretch[key.rpartition(".")[2]], bound=bounds.get(key, ""))
        yield row.bounded or "no single input"
