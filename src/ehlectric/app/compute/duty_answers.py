"""Answers about a duty cycle: what its file has, and shares, worst stretches and figure of its result."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.app.charts.duty_charts import (
    DUTY_HEADS,
    MESH_DUTY_HEADS,
    MOST_DUTY_ROWS,
    duty_figure,
    duty_rows,
    mesh_duty_figure,
    mesh_duty_rows,
)
from ehlectric.app.charts.plotly_panels import Plot
from ehlectric.app.compute.answer_parts import lines_of, page_warnings_of, with_session_files
from ehlectric.app.form_fields.field import form_data
from ehlectric.app.view_models import DutyAnswer, DutyLook, Figure, Line, Table
from ehlectric.bearing import DutyResult
from ehlectric.cases.duty_inputs import Duty, read_cycle
from ehlectric.cases.measurements import CYCLE, GEAR_CYCLE, VEHICLE_SPEED, read_measurement, void_rows
from ehlectric.gear import MeshDuty
from ehlectric.quantities.quantity import Quantity
from ehlectric.quantities.result_bounds import bearing_bounds
from ehlectric.quantities.results import BEARING_BOOK, GEAR_BOOK
from ehlectric.quantities.rows import Row, row_of
from ehlectric.readable import capital, readable
from ehlectric.tables.bearing_tables import total_rows
from ehlectric.tables.gear_tables import gear_rows

_STRETCH = "duty.stretches"


def look(file: str, session: Path, kind: str = "bearing") -> DutyLook:
    """Contents of the file of a duty cycle in the folder of a session.

    ``kind`` of the page, "bearing", "drive" or "gear". Raises InputError where the file is no duty cycle.
    """
    book = GEAR_CYCLE if kind == "gear" else CYCLE
    path = with_session_files({"duty": {"file": file}}, session)["duty"]["file"]
    of_vehicle = read_measurement(path, book).has(VEHICLE_SPEED)
    vehicle = form_data("first_values")["vehicle"] if of_vehicle else None
    cycle = read_cycle(Duty(file=path, vehicle=vehicle), book)
    written = {"speed": VEHICLE_SPEED} if of_vehicle else {}
    columns = (written.get(name, name) for name in cycle.values)
    names = ", ".join(name.replace("_", " ").replace("common mode", "common-mode") for name in columns)
    text = f"{cycle.time.size} rows over {readable(cycle.time[-1] - cycle.time[0], 6)} s: {names}."
    text += f" Ignored: {', '.join(cycle.ignored)}." if cycle.ignored else ""
    return DutyLook(text + "".join(f" {warning.text}" for warning in void_rows(cycle.read)), of_vehicle)


def shown_duty(duty: DutyResult, summary: Mapping[str, Any]) -> DutyAnswer:
    """Answer of a duty cycle from the summary of its bearing, which has its table ``duty``."""
    names = ["speed", "lambda ratio", *(["margin"] if duty.rows.has_margin else [])]
    cells = Table(_caption(duty), DUTY_HEADS, tuple(duty_rows(duty)))
    bounds = bearing_bounds(BEARING_BOOK, summary)
    return DutyAnswer(
        lines=_lines(total_rows(summary)),
        stretches=_stretches_table(summary, BEARING_BOOK, bounds),
        figure=_figure(names, "states of lubrication", duty_figure(duty), cells),
        warnings=page_warnings_of(duty.warnings),
    )


def shown_mesh_duty(duty: MeshDuty, summary: Mapping[str, Any], summits: float) -> DutyAnswer:
    """Answer of a duty cycle from the summary of its gear pair, which has its table ``duty``. ``summits``,
    height of the highest summits in units of the composite Rq.
    """
    has_voltage = bool(np.any(duty.rows.breakdown_voltage > 0.0))
    names = ["speed", "torque", "lambda ratio", *(["breakdown voltage"] if has_voltage else [])]
    cells = Table(_caption(duty), MESH_DUTY_HEADS, tuple(mesh_duty_rows(duty)))
    return DutyAnswer(
        lines=_lines(gear_rows(summary)),
        stretches=_stretches_table(summary, GEAR_BOOK, {}),
        figure=_figure(names, "states of the mesh", mesh_duty_figure(duty, summits), cells),
        warnings=page_warnings_of(duty.warnings),
    )


def _lines(rows: Iterable[Row]) -> tuple[Line, ...]:
    """Rows of a duty cycle without its stretches."""
    keys = ((row.key, row) for row in rows)
    return lines_of(row for key, row in keys if key.startswith("duty.") and not key.startswith(_STRETCH))


def _caption(duty: DutyResult | MeshDuty) -> str:
    """Caption of the table over the time."""
    caption = f"{duty.rows.time.size} rows of the cycle"
    if duty.rows.time.size > MOST_DUTY_ROWS:
        caption = f"{MOST_DUTY_ROWS} of {caption}, evenly spaced; duty.csv has all"
    return caption


def _figure(names: Sequence[str], states: str, plot: Plot, cells: Table) -> Figure:
    """Figure of some quantities over the time, with bands of states."""
    what = capital(f"{', '.join(names[:-1])} and {names[-1]}")
    return Figure(
        f"{what} over the duty cycle", f"{what} over the time, with bands of the {states}", plot, cells
    )


def _stretches_table(
    summary: Mapping[str, Any], book: Mapping[str, Quantity], bounds: Mapping[str, Any]
) -> Table | None:
    """Table of the worst stretches, the worst first; None without any."""
    stretches = summary["duty"]["stretches"]
    if not stretches:
        return None
    margins = stretches[0]["least_margin"] is not None
    value = "least_margin" if margins else "lambda_ratio"
    keys = [f"{_STRETCH}.{name}" for name in ("start", "end", value, "time", "speed", "why")]
    limit = "margin below 1" if margins else "lambda ratio below 3"
    return Table(
        f"Worst stretches with a {limit}, the worst first",
        tuple(_head(book[key]) for key in keys),
        tuple(tuple(_cells(stretch, keys, book, bounds)) for stretch in stretches),
    )


def _head(about: Quantity) -> str:
    name = about.head or about.label
    return f"{name} [{about.shown}]" if about.shown else name


def _cells(
    stretch: Mapping[str, Any], keys: list[str], book: Mapping[str, Quantity], bounds: Mapping[str, Any]
) -> Iterator[str]:
    for key in keys:
        row: Row = row_of(key, book[key], stretch[key.rpartition(".")[2]], bound=bounds.get(key, ""))
        yield row.bounded or "no single input"
