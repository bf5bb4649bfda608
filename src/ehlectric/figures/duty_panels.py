"""Panels over a duty cycle with bands for the film states, for bearings, drives and gear pairs."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import DutyResult, DutyRows, edges_of, lubrication_names
from ehlectric.drive import DriveDuty, DriveDutyRows
from ehlectric.figures.data import Along, Area, Curve, Panel, is_wide
from ehlectric.figures.figure_names import literal
from ehlectric.figures.speed_panels import STATE_LOOKS
from ehlectric.gear import MeshDuty, MeshRows, mesh_states
from ehlectric.quantities.lubrication_states import (
    AT_TIMES,
    BOUNDARY_LIMIT,
    CONDUCTS,
    FREQUENT,
    FULL,
    FULL_FILM_LIMIT,
    MIXED,
    bands,
)
from ehlectric.quantities.palette import BLACK, BLUE, GREY, ORANGE
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.quantities.units import RPM

# Rows of a duty cycle of any kind.
AnyRows = DutyRows | DriveDutyRows | MeshRows

# Longest cycle whose time is in seconds; the time of a longer one is in hours [s].
_LONGEST = 7200.0

# Colours and dashes of both bearings of a drive.
_ENDS, _DASHES = (BLUE, ORANGE), ("solid", "dash")


def cycle_lines(title: str, source: str, text: str) -> list[str]:
    """Lines below a figure over a duty cycle: title of the case, and text about the file of the cycle."""
    shown = textwrap.shorten(title, 70, placeholder=" ...")
    return [*filter(None, [shown]), f"{literal(Path(source).name)}: {text}"]


def time_axis(rows: AnyRows) -> Along:
    """Axis of the time of a duty cycle."""
    factor, unit = _unit(rows)
    time = factor * rows.time
    return Along("time", unit, (float(time[0]), float(time[-1])))


def duty_panels(duty: DutyResult) -> Iterator[Panel]:
    """Speed, lambda ratio and, where any row has one, margin over time."""
    rows, touching = duty.rows, duty.touching_ratio
    limits, areas = (touching, FULL_FILM_LIMIT), _film_bands(rows, touching)
    yield _panel(rows, areas, "speed", "rpm", rows.speed / RPM)
    yield _panel(rows, areas, "lambda ratio", "", rows.lambda_ratio, limits=limits, colours=(BLUE,))
    if rows.has_margin:
        yield _panel(rows, areas, "margin", "", rows.margin, limits=(1.0,))


def gear_duty_panels(duty: MeshDuty, summits: float) -> Iterator[Panel]:
    """Speed, torque, lambda ratio and, where any row has one, breakdown voltage of a mesh over time.

    ``summits``, height of the highest summits in units of the composite Rq, at which they touch.
    """
    rows = duty.rows
    areas = _bands(rows, mesh_states(rows), _MESH_LOOKS)
    panel = partial(_panel, rows, areas, name="")
    yield panel("speed of\ngear 1", "rpm", rows.speed / RPM)
    yield panel("torque of\ngear 1", "N m", rows.torque)
    yield panel("lambda ratio", "", rows.lambda_ratio, limits=(summits,), colours=(BLUE,))
    if np.any(rows.breakdown_voltage > 0.0):
        given = np.unique(rows.voltage[np.isfinite(rows.voltage)])
        limits = tuple(given.tolist()) if given.size == 1 else ()
        volts = np.where(rows.breakdown_voltage > 0.0, rows.breakdown_voltage, np.nan)
        yield panel("breakdown\nvoltage", "V", volts, limits=limits)


# States of a mesh with their legends and looks; a mesh that insulates has no band.
_MESH_LOOKS = [
    (name, name, look)
    for name, look in (
        ("standstill", (GREY, 0.35)),
        (CONDUCTS, STATE_LOOKS[FREQUENT.name]),
        (AT_TIMES, STATE_LOOKS[MIXED.name]),
    )
]


def drive_duty_panels(duty: DriveDuty) -> Iterator[Panel]:
    """Speed, and lambda ratios and discharges per second of both bearings over time; equal curves once."""
    rows, touching = duty.rows, duty.touching_ratio
    areas = _film_bands(rows, touching)
    yield _panel(rows, areas, "speed", "rpm", rows.speed / RPM)
    same = np.array_equal(rows.lambda_ratio[:, 0], rows.lambda_ratio[:, 1], equal_nan=True)
    ratios = rows.lambda_ratio[:, :1] if same else rows.lambda_ratio
    colours = (BLACK,) if same else _ENDS
    yield _panel(rows, areas, "lambda ratio", "", ratios, limits=(touching, FULL_FILM_LIMIT), colours=colours)
    yield _panel(rows, areas, "discharges", "1/s", rows.discharge_rate, colours=_ENDS)


def _panel(
    rows: AnyRows,
    areas: Sequence[Area],
    title: str,
    unit: str,
    values: Array,
    *,
    limits: tuple[float, ...] = (),
    colours: tuple[str, ...] = (BLACK,),
    name: str | None = None,
) -> Panel:
    """Panel of a quantity over time, shape (n,), or of both bearings, shape (n, 2), with dashed lines at
    limits, and bands of the states. ``name``, entry of the only curve in a legend, by default the title.
    """
    time = _unit(rows)[0] * rows.time
    columns = values.reshape(time.size, -1).T
    names = tuple(NAMES_OF_ENDS.values()) if len(columns) > 1 else (title if name is None else name,)
    ends = time[[0, -1]]
    lines = [Curve("", ends, np.full(2, limit), GREY, "dash", 0.8) for limit in limits]
    low, high = float(np.nanmin(values, initial=0.0)), float(np.nanmax(values, initial=1.0))
    return Panel(
        title,
        unit,
        [
            *lines,
            *(
                Curve(entry, time, column, colour, dash, 0.9)
                for entry, column, colour, dash in zip(names, columns, colours, _DASHES, strict=False)
            ),
        ],
        1.08 * high,
        1.08 * low,
        areas=tuple(areas),
        log=bool(limits) and is_wide(values),
    )


def _film_bands(rows: DutyRows | DriveDutyRows, touching: float) -> list[Area]:
    """Bands of the times in each state of the thinner film. ``touching``, lambda ratio up to which asperity
    contact is frequent.
    """
    thinner = np.min(rows.state.reshape(rows.time.size, -1), axis=1)
    ratio = np.min(rows.lambda_ratio.reshape(rows.time.size, -1), axis=1)
    looks = [("standstill", "standstill", (GREY, 0.35))]
    for state, _, _, text in bands(touching if touching > BOUNDARY_LIMIT else 0.0):
        if state is not FULL:
            looks.append((state.name, f"{state.name}, {text}", STATE_LOOKS[state.name]))
    return _bands(rows, lubrication_names(thinner, ratio), looks)


def _bands(rows: AnyRows, names: Array, looks: Sequence[tuple[str, str, tuple[str, float]]]) -> list[Area]:
    """Bands of the times in each state, between the row edges; ``names``, state of each row, shape (n,), and
    ``looks``, name, legend and look of each state.
    """
    edges = np.repeat(_unit(rows)[0] * edges_of(rows.time), 2)[1:-1]
    return [
        Area(legend, edges, np.repeat(names == state, 2), *look)
        for state, legend, look in looks
        if np.any(names == state)
    ]


def _unit(rows: AnyRows) -> tuple[float, str]:
    """Factor from seconds to the unit of the time, and this unit."""
    return (1.0, "s") if rows.time[-1] - rows.time[0] <= _LONGEST else (1.0 / 3600.0, "h")
