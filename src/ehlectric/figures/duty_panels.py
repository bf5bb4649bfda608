"""Panels over a duty cycle with bands for the film states, for bearings and drives."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import PARTIAL, PARTIAL_FILM, STANDSTILL, TOUCHING, DutyResult, DutyRows, edges_of
from ehlectric.drive import DriveDuty, DriveDutyRows
from ehlectric.figures.data import Along, Area, Curve, Panel, is_wide
from ehlectric.figures.figure_names import literal
from ehlectric.quantities.palette import BLACK, BLUE, GREY, MIDDLE_GREY, OCHRE, ORANGE
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.quantities.units import RPM

# Longest cycle whose time is in seconds; the time of a longer one is in hours [s].
_LONGEST = 7200.0

# Bands of the states: number, name with the lambda ratio up to which surfaces touch, colour and opacity. A
# full film has none.
_BANDS = (
    (STANDSTILL, "standstill", MIDDLE_GREY, 0.35),
    (TOUCHING, "touching, λ < {touching:g}", ORANGE, 0.35),
    (PARTIAL_FILM, "partial film, λ from {touching:g} to 3", OCHRE, 0.15),
)


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
    limits = (touching, PARTIAL)
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
    yield _panel(rows, touching, "lambda ratio", "", ratios, limits=(touching, PARTIAL), colours=colours)
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
    limits. ``touching``, lambda ratio up to which surfaces are called touching.
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
    for state, name, colour, opacity in _BANDS:
        within = np.repeat(thinner == state, 2)
        if np.any(within):
            yield Area(name.format(touching=touching), edges, within, colour, opacity)


def _unit(rows: DutyRows | DriveDutyRows) -> tuple[float, str]:
    """Factor from seconds to the unit of the time, and this unit."""
    return (1.0, "s") if rows.time[-1] - rows.time[0] <= _LONGEST else (1.0 / 3600.0, "h")
