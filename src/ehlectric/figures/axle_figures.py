"""Figures of an axle: its elements by their voltages, its network, and the forces on its shafts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.axle import CONDUCTIONS, AxleResult, Element
from ehlectric.errors import printable
from ehlectric.figures.axle_discharges import axle_discharges, discharges_finding
from ehlectric.figures.axle_duty import axle_duty, duty_finding
from ehlectric.figures.axle_remedies import axle_remedies, remedies_finding
from ehlectric.figures.figure_names import (
    AXLE_DISCHARGES_FIGURE,
    AXLE_DUTY_FIGURE,
    AXLE_FIGURE_FILES,
    AXLE_REMEDIES_FIGURE,
    FORCES_FIGURE,
)
from ehlectric.figures.network_picture import network_picture
from ehlectric.figures.shaft_forces import shaft_forces, torques_of
from ehlectric.figures.style import drawing_of, legend_above, new_panels, note, style, titled
from ehlectric.quantities.formats import amount
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.quantities.palette import BLACK, BLUE, GREY, ORANGE, WHITE
from ehlectric.readable import readable

# Part of the axis at its ends, and height of the bars.
_ROOM, _HEIGHT = 1.6, 0.6


def elements(result: AxleResult, ax: Axes) -> None:
    """Draw a bar for each element, the first to break down on top; ranges from all meshes to none conducting
    are lines.
    """
    solution = result.solution
    ranked = [name for name, _ in solution.ranking()]
    ratios, *bounds = (solution.ratios(conduction) for conduction in CONDUCTIONS)
    rest = [each.name for each in solution.elements if each.name not in ratios]
    names = [*ranked, *(name for name in rest if name not in ranked)]
    first = next((name for name, _ in solution.discharging()), None)
    positive = [value for table in (ratios, *bounds) for value in table.values() if value > 0.0]
    low, high = min([*positive, 1.0]) / _ROOM, max([*positive, 1.0]) * _ROOM
    lines = solution.ratio_ends()
    for place, name in enumerate(names):
        ratio, colour = ratios.get(name, 0.0), ORANGE if name == first else BLUE
        if ratio > 0.0:
            ax.barh(place, ratio - low, _HEIGHT, left=low, color=colour)
        if name in lines:
            ax.plot(lines[name], [place, place], color=BLACK, lw=1.6, marker="|", ms=8.0)
        if name in rest:
            element = next(each for each in solution.elements if each.name == name)
            _write_without_ratio(ax, place, element, colour if name in ranked else GREY)
    ax.axvline(1.0, color=BLACK, ls="--", lw=1.0)
    ax.set(xscale="log", xlim=(low, high), ylim=(len(names) - 0.4, -0.6))
    ax.set_yticks(range(len(names)), [printable(name) for name in names])
    ax.set_xlabel(f"voltage after an edge of {readable(result.solution.edge.voltage)} V / breakdown voltage")
    legend_above(
        ax,
        [
            Patch(color=ORANGE, label="first element"),
            Patch(color=BLUE, label="other elements"),
            Line2D([], [], color=BLACK, marker="|", label="all meshes or no mesh conducts"),
        ],
        columns=3,
    )


def _write_without_ratio(ax: Axes, place: int, element: Element, colour: str) -> None:
    """Write why an element has no bar: it conducts, its summits touch, or it has no breakdown voltage."""
    if element.state == CONDUCTS:
        text = element.state
    elif element.touching:
        text = f"summits touch, {element.state}: discharges at any voltage"
    else:
        text = f"{element.state}, no breakdown voltage"
    look: dict[str, Any] = {"va": "center", "fontsize": "medium", "zorder": 3.0}
    box = {"facecolor": WHITE, "edgecolor": "none", "pad": 1.0}
    note(ax, 0.02, place, text, data_axis="y", color=colour, bbox=box, **look)


def _draw_elements(result: AxleResult) -> Axes:
    (ax,) = new_panels(1, 1, (8.0, 1.8 + 0.4 * len(result.solution.elements)))
    elements(result, ax)
    return ax


def _first(result: AxleResult) -> str:
    """Sentence about the element that discharges first."""
    ranking = result.solution.discharging()
    if not ranking:
        return "No bearing or mesh with a voltage breaks down"
    name, ratio = ranking[0]
    if name not in result.solution.breakdown_voltages:
        voltage = readable(result.solution.voltage_of(name), 3)
        return f"{name}: summits touch and discharge at any voltage, here {voltage} V after an edge"
    return f"{name}: {readable(ratio, 3)} times the breakdown voltage after an edge, the largest ratio"


def _torques(result: AxleResult) -> str:
    """Sentence about the torques of the figure of forces."""
    torques = " and at ".join(amount(torque, "N m") for torque in torques_of(result.case))
    return f"Forces on the shafts at {torques} of the rotor"


# Functions that draw each figure, and sentences with its finding, by the names of the files.
FIGURES: Mapping[str, tuple[Callable[[AxleResult], Axes], Callable[[AxleResult], str]]] = dict(
    zip(
        AXLE_FIGURE_FILES,
        (
            (_draw_elements, _first),
            (network_picture, _first),
            (shaft_forces, _torques),
            (axle_duty, duty_finding),
            (axle_remedies, remedies_finding),
            (axle_discharges, discharges_finding),
        ),
        strict=True,
    )
)


def drawings_of(result: AxleResult) -> list[str]:
    """Names of the figures of an axle; of gears, a cycle, remedies and discharges only if it has them."""
    present = {
        FORCES_FIGURE: bool(result.case.loaded_shafts),
        AXLE_DUTY_FIGURE: result.case.duty is not None,
        AXLE_REMEDIES_FIGURE: bool(result.remedies),
        AXLE_DISCHARGES_FIGURE: result.discharges is not None,
    }
    return [name for name in FIGURES if present.get(name, True)]


def figure(result: AxleResult, name: str) -> Figure:
    """Figure of an axle. Raises InputError where there is no figure of this name."""
    draw, finding = drawing_of({each: FIGURES[each] for each in drawings_of(result)}, name)
    with style():
        return titled(
            draw(result), "\n".join(filter(None, [finding(result), result.case.title])), converged=True
        )
