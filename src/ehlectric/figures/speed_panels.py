"""Panels of a bearing over its speed: breakdown and shaft voltage, and capacitance, for files and pages."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import (
    Curves,
    MarginBand,
    Speed,
    Speeds,
    critical_speed_of,
    is_coated,
    nearly_equal,
    value_of,
)
from ehlectric.figures.data import Along, Area, Curve, Panel, Upright, is_wide
from ehlectric.quantities.formats import speed_text
from ehlectric.quantities.lubrication_states import BOUNDARY, FREQUENT, FULL, MIXED, bands
from ehlectric.quantities.palette import AMBER, BLACK, BLUE, GREEN, MIDDLE_GREY, OCHRE, ORANGE
from ehlectric.quantities.units import RPM, unit_for

# Colour, dash and width [pt] of a line.
Look = tuple[str, str, float]

# Lines of the voltages of the whole bearing in all figures. The voltages are often equal, so the line drawn
# first is the wider one.
FIRST: Look = (BLACK, "solid", 1.1)
THROUGH: Look = (OCHRE, "solid", 3.0)
SHAFT: Look = (GREEN, "dash", 1.4)


# Smallest voltage that is drawn, divided by the largest one: a breakdown voltage begins at 0.
_LEAST_VOLTAGE = 0.01

# Smallest margin that is drawn: films break down at any smaller one, however small.
_LEAST_MARGIN = 0.05


# Colours and opacities of the states of lubrication; a full film has none.
STATE_LOOKS = {BOUNDARY.name: (ORANGE, 0.18), FREQUENT.name: (AMBER, 0.22), MIXED.name: (MIDDLE_GREY, 0.15)}


class BreakdownLine(NamedTuple):
    """Line of a breakdown voltage of a bearing."""

    key: str  # of the curves over the speed
    name: str
    values: Array  # voltages [V]
    look: Look


def breakdown_lines(first: Array, through: Array) -> list[BreakdownLine]:
    """Lines of the first and of the ring-to-ring breakdown [V]; one line where they are equal."""
    if nearly_equal(first, through):
        return [BreakdownLine("first_break", "first and\nring-to-ring\nbreakdown", first, FIRST)]
    return [
        BreakdownLine("ring_to_ring_breakdown", "ring-to-ring\nbreakdown", through, THROUGH),
        BreakdownLine("first_break", "first\nbreakdown", first, FIRST),
    ]


def speed_axis(curves: Curves) -> Along:
    """Axis of the speed of a bearing."""
    return Along("speed of the inner ring", "rpm", log=is_wide(curves.speed))


def breakdown_panel(points: Speeds, curves: Curves, at_case: Speed | None) -> Panel:
    """First and ring-to-ring breakdown with the shaft voltage, and where the margin is below 1."""
    first, through, shaft = (
        curves[key] for key in ("first_break", "ring_to_ring_breakdown", "shaft_voltage")
    )
    voltages = np.concatenate([first, through, shaft])
    value = None if at_case is None else value_of(at_case[1], "first_break")
    least = _LEAST_VOLTAGE * float(np.nanmax(voltages, initial=0.0))
    least = least if value is None else min(least, 0.5 * value)
    drawn = [*_curves(curves, "shaft_voltage", "shaft voltage", SHAFT)]
    for line in breakdown_lines(first, through):
        drawn += _curves(curves, line.key, line.name.replace("\n", " "), line.look, least=least)
    critical, marked = critical_speed_of(curves), []
    if critical is not None:
        at = critical / RPM
        drawn.append(_mark(critical, curves.at("shaft_voltage", critical), ORANGE, "ring"))
        marked.append(Upright(f"critical speed {speed_text(critical)}", at, ORANGE, "dot"))
    if at_case is not None and value is not None:
        drawn.append(_mark(at_case[0], value, BLACK, "star"))
    nodes, low = curves.between("first_break")
    _, high = curves.between("shaft_voltage")
    danger = Area("margin below 1", nodes / RPM, high > low, ORANGE, 0.2, (np.maximum(low, least), high))
    return Panel(
        f"{'shaft' if is_coated(points) else 'bearing'} voltage",
        "V",
        drawn,
        1.1 * float(np.nanmax(voltages, initial=0.0)),
        areas=(*([danger] if np.any(danger.within) else []), *_contacts_open(curves)),
        uprights=marked,
        log=is_wide(voltages[voltages >= least]),
    )


def margin_panel(band: MarginBand, at_case: tuple[float, float] | None = None) -> Panel:
    """Margin over the speed within the uncertain inputs, and of the bearing itself at its speed [rad/s]."""
    rpm, ones = band.speed / RPM, np.ones_like(band.speed)
    # Surfaces that touch have a margin of 0, which a logarithmic axis does not have.
    least = max(0.5 * float(np.min(band.median, where=band.median > 0.0, initial=1.0)), _LEAST_MARGIN)
    low, median, high = (np.maximum(values, least) for values in (band.low, band.median, band.high))
    even = np.clip(1.0, low, high)
    drawn = [
        Curve("margin 1", rpm, ones, MIDDLE_GREY, "dash"),
        Curve("median", rpm, np.where(band.median > least, median, np.nan), BLACK, width=1.4),
    ]
    if at_case is not None:
        drawn.append(_mark(at_case[0], at_case[1], BLACK, "star"))
    areas: tuple[Area, ...] = (
        Area("90 of 100 cases", rpm, high > 1.0, BLUE, 0.2, (even, high)),
        Area("of these, breakdown", rpm, low < 1.0, ORANGE, 0.25, (low, even)),
    )
    touching = Area("frequent asperity contact: ≥ 5 of 100 cases", rpm, band.low == 0.0, MIDDLE_GREY, 0.2)
    if np.any(touching.within):
        areas = (*areas, touching)
    top = 1.1 * float(np.max(high, initial=1.0))
    return Panel("margin", "", drawn, top, least, areas=areas, log=True)


def capacitance_panel(points: Speeds, curves: Curves, at_case: Speed | None) -> Panel:
    """Capacitance, with its range from air to oil around the films; the curve of the bearing is bold."""
    nodes, air = curves.between("capacitance_air")
    _, oil = curves.between("capacitance_oil")
    factor, unit = unit_for(float(np.nanmax(oil)), "F", least=1.0)
    fills = {str(summary["inputs"]["bearing"]["fill"]) for _, summary in points}
    drawn: list[Curve] = []
    for fill in ("oil", "air"):
        bold = fills == {fill}
        look: Look = (BLUE, "solid", 1.4 if bold else 0.7)
        drawn += _curves(curves, f"capacitance_{fill}", f"{fill} around the films", look, factor, dots=bold)
    if fills not in ({"oil"}, {"air"}):
        drawn += _curves(curves, "capacitance", "this bearing", (BLACK, "solid", 1.4), factor)
    if at_case is not None:
        drawn.append(_mark(at_case[0], factor * at_case[1]["bearing"]["capacitance"], BLACK, "star"))
    everything = factor * np.concatenate([curves[key] for key in ("capacitance_oil", "capacitance_air")])
    band = Area(
        "between air and oil", nodes / RPM, np.isfinite(oil - air), BLUE, 0.15, (factor * air, factor * oil)
    )
    return Panel(
        "capacitance",
        unit,
        drawn,
        1.1 * float(np.nanmax(everything)),
        areas=(band, *_contacts_open(curves)),
        log=is_wide(everything),
    )


def _curves(
    curves: Curves,
    key: str,
    name: str,
    look: Look,
    factor: float = 1.0,
    *,
    dots: bool = True,
    least: float = 0.0,
) -> Iterator[Curve]:
    """Line between the speeds and dots at them, of values of at least some; none if no speed has a value."""
    if np.any(np.isfinite(curves[key])):
        nodes, between = curves.between(key)
        yield Curve(name, nodes / RPM, factor * np.where(between >= least, between, np.nan), *look)
        if dots and curves.few:
            yield Curve("", curves.speed / RPM, factor * curves[key], look[0], marker="dots")


def _mark(speed: float, value: float, colour: str, marker: str) -> Curve:
    return Curve("", np.array([speed / RPM]), np.array([value]), colour, marker=marker)


def _contacts_open(curves: Curves) -> Iterator[Area]:
    """Speeds at which asperity contact is possible or frequent: such speeds must not read as safe."""
    nodes, ratio = curves.between("lambda_ratio")
    for state, low, high, text in bands(curves.summit_height):
        if state is FULL:
            continue
        within = (ratio >= low) & (ratio < high)
        # Up to the next node, so that no gap is left between both.
        within[1:] |= within[:-1] & np.isfinite(ratio[1:])
        if np.any(within):
            name = f"{text}: {state.name}"
            yield Area(name, nodes / RPM, within, *STATE_LOOKS[state.name], hatched=state is BOUNDARY)
