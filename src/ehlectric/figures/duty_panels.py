"""Panels of a bearing over a duty cycle: speed, lambda ratio, margin, and bands of the states of its film."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.duty_cycle import (
    PARTIAL_FILM,
    STANDSTILL,
    TOUCHING,
    DutyResult,
    edges_of,
)
from ehlectric.bearing.solution import CONDUCTING, PARTIAL
from ehlectric.figures.data import Along, Area, Curve, Panel, is_wide
from ehlectric.quantities.palette import BLACK, BLUE, GREY, MIDDLE_GREY, OCHRE, ORANGE
from ehlectric.quantities.units import RPM

# Longest cycle whose time is in seconds; that of a longer one is in hours [s].
_LONGEST = 7200.0

# Bands of the states: number, name with the lambda ratio up to which surfaces touch, colour and opacity. A
# full film has none.
_BANDS = (
    (STANDSTILL, "standstill", MIDDLE_GREY, 0.35),
    (TOUCHING, "touching, λ < {touching:g}", ORANGE, 0.35),
    (PARTIAL_FILM, "partial film, λ from {touching:g} to 3", OCHRE, 0.15),
)


def time_axis(duty: DutyResult) -> Along:
    """Axis of the time of a duty cycle."""
    factor, unit = _unit(duty)
    time = factor * duty.rows.time
    return Along("time", unit, (float(time[0]), float(time[-1])))


def duty_panels(duty: DutyResult) -> Iterator[Panel]:
    """Speed, lambda ratio and, where any row has one, margin over time."""
    rows = duty.rows
    yield _panel(duty, "speed", "rpm", rows.speed / RPM, BLACK)
    yield _panel(duty, "lambda ratio", "", rows.lambda_ratio, BLUE, (_touching(duty), PARTIAL))
    if rows.has_margin:
        yield _panel(duty, "margin", "", rows.margin, BLACK, (1.0,))


def _panel(
    duty: DutyResult, title: str, unit: str, values: Array, colour: str, limits: tuple[float, ...] = ()
) -> Panel:
    """Panel of a quantity over time, with dashed lines at limits."""
    time = _unit(duty)[0] * duty.rows.time
    ends = time[[0, -1]]
    lines = [Curve("", ends, np.full(2, limit), GREY, "dash", 0.8) for limit in limits]
    low, high = float(np.nanmin(values, initial=0.0)), float(np.nanmax(values, initial=1.0))
    return Panel(
        title,
        unit,
        [*lines, Curve(title, time, values, colour, width=0.9)],
        1.08 * high,
        1.08 * low,
        areas=tuple(_bands(duty)),
        log=bool(limits) and is_wide(values),
    )


def _bands(duty: DutyResult) -> Iterator[Area]:
    """Bands of the times in each state, between the edges of the rows."""
    edges = np.repeat(_unit(duty)[0] * edges_of(duty.rows.time), 2)[1:-1]
    for state, name, colour, opacity in _BANDS:
        within = np.repeat(duty.rows.state == state, 2)
        if np.any(within):
            yield Area(name.format(touching=_touching(duty)), edges, within, colour, opacity)


def _touching(duty: DutyResult) -> float:
    """Lambda ratio up to which surfaces are called touching."""
    return CONDUCTING if duty.touching_ratio is None else duty.touching_ratio


def _unit(duty: DutyResult) -> tuple[float, str]:
    """Factor from seconds to the unit of the time, and this unit."""
    return (1.0, "s") if duty.rows.time[-1] - duty.rows.time[0] <= _LONGEST else (1.0 / 3600.0, "h")
