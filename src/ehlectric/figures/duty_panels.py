"""Panels over a duty cycle with bands for the film states, for bearings and drives."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import DutyResult, DutyRows, edges_of, lubrication_names
from ehlectric.drive import DriveDuty, DriveDutyRows
from ehlectric.figures.data import Along, Area, Curve, Panel, is_wide
from ehlectric.figures.figure_names import literal
from ehlectric.figures.speed_panels import STATE_LOOKS
from ehlectric.quantities.lubrication_states import BOUNDARY_LIMIT, FULL, FULL_FILM_LIMIT, bands
from ehlectric.quantities.palette import BLACK, BLUE, GREY, ORANGE
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.quantities.units import RPM

# Longest cycle whose time is in seconds; the time of a longer one is in hours [s].
_LONGEST = 7200.0

# Colours and dashes of both bearings of a drive.
_ENDS, _DASHES = (BLUE, ORANGE), ("solid", "dash")


def cycle_lines(title: str, source: str, text: str) -> list[str]:
    """Lines below a figure over a duty cycle: title of the case, and text about the file of the cycle."""
    shown = textwrap.shorten(title, 70, placeholder=" ...")
    return [*filter(None, [shown]), f"{literal(Path(source).name)}: {text}"]


def time_axis(rows: DutyRows | DriveDutyRows) -> Along:
    """Axis of the time of a duty cycle."""
    factor, unit = _unit(rows)
    time = factor * rows.time
    return Along("time", unit, (float(time[0]), float(time[-1])))


def duty_panels(duty: DutyResult) -> Iterator[Panel]:
    """Speed, lambda ratio and, where any row has one, margin over time."""
    rows, touching = duty.rows, duty.touching_ratio
    limits = (touching, FULL_FILM_LIMIT)
    yield _panel(rows, touching, "speed", "rpm", rows.speed / RPM)
    yield _panel(rows, touching, "lambda ratio", "", rows.lambda_ratio, limits=limits, colours=(BLUE,))
    if rows.has_margin:
        yield _panel(rows, touching, "margin", "", rows.margin, limits=(1.0,))


def drive_duty_panels(duty: DriveDuty) -> Iterator[Panel]:
    """Speed, and lambda ratios and discharges per second of both bearings over time; equal curves once."""
    rows, touching = duty.rows, duty.touching_ratio
    yield _panel(rows, touching, "speed", "rpm", rows.speed / RPM)
    same = np.array_equal(rows.lambda_ratio[:, 0], rows.lambda_ratio[:, 1], equal_nan=True)
    ratios = rows.lambda_ratio[:, :1] if same else rows.lambda_ratio
    colours = (BLACK,) if same else _ENDS
    yield _panel(
        rows, touching, "lambda ratio", "", ratios, limits=(touching, FULL_FILM_LIMIT), colours=colours
    )
    yield _panel(rows, touching, "discharges", "1/s", rows.discharge_rate, colours=_ENDS)


def _panel(
    rows: DutyRows | DriveDutyRows,
    touching: float,
    title: str,
    unit: str,
    values: Array,
    *,
    limits: tuple[float, ...] = (),
    colours: tuple[str, ...] = (BLACK,),
) -> Panel:
    """Panel of a quantity over time, shape (n,), or of both bearings, shape (n, 2), with dashed lines at
    limits. ``touching``, lambda ratio up to which asperity contact is frequent.
    """
    time = _unit(rows)[0] * rows.time
    columns = values.reshape(time.size, -1).T
    names = tuple(NAMES_OF_ENDS.values()) if len(columns) > 1 else (title,)
    ends = time[[0, -1]]
    lines = [Curve("", ends, np.full(2, limit), GREY, "dash", 0.8) for limit in limits]
    low, high = float(np.nanmin(values, initial=0.0)), float(np.nanmax(values, initial=1.0))
    return Panel(
        title,
        unit,
        [
            *lines,
            *(
                Curve(name, time, column, colour, dash, 0.9)
                for name, column, colour, dash in zip(names, columns, colours, _DASHES, strict=False)
            ),
        ],
        1.08 * high,
        1.08 * low,
        areas=tuple(_bands(rows, touching)),
        log=bool(limits) and is_wide(values),
    )


def _bands(rows: DutyRows | DriveDutyRows, touching: float) -> Iterator[Area]:
    """Yield bands of the times in each state of the thinner film, between the row edges."""
    edges = np.repeat(_unit(rows)[0] * edges_of(rows.time), 2)[1:-1]
    thinner = np.min(rows.state.reshape(rows.time.size, -1), axis=1)
    ratio = np.min(rows.lambda_ratio.reshape(rows.time.size, -1), axis=1)
    names = lubrication_names(thinner, ratio)
    looks = [("standstill", "standstill", (GREY, 0.35))]
    for state, _, _, text in bands(touching if touching > BOUNDARY_LIMIT else 0.0):
        if state is not FULL:
            looks.append((state.name, f"{state.name}, {text}", STATE_LOOKS[state.name]))
    for state_name, legend, look in looks:
        within = np.repeat(names == state_name, 2)
        if np.any(within):
            yield Area(legend, edges, within, *look)


def _unit(rows: DutyRows | DriveDutyRows) -> tuple[float, str]:
    """Factor from seconds to the unit of the time, and this unit."""
    return (1.0, "s") if rows.time[-1] - rows.time[0] <= _LONGEST else (1.0 / 3600.0, "h")
