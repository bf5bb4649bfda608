"""Figures of an axle: its elements by their voltages, its network, and the forces on its shafts."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.axle import AxleResult
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
from ehlectric.figures.shaft_forces import shaft_forces
from ehlectric.figures.style import drawing_of, legend_above, new_panels, note, style, titled
from ehlectric.quantities.formats import amount
from ehlectric.quantities.palette import BLACK, BLUE, GREY, ORANGE
from ehlectric.readable import readable

# Part of the axis at its ends, and height of the bars.
_ROOM, _HEIGHT = 1.6, 0.6


def elements(result: AxleResult, ax: Axes) -> None:
    """Draw a bar for each element, the first to break down on top; ranges from all meshes to none conducting
    are lines.
    """
    solution = result.solution
    ratios = dict(solution.ranking())
    bounds = [dict(solution.ranking(conduction)) for conduction in ("always", "never")]
    rest = [each.name for each in solution.elements if each.name not in ratios]
    names = [*ratios, *rest]
    positive = [value for table in (ratios, *bounds) for value in table.values() if value > 0.0]
    low, high = min([*positive, 1.0]) / _ROOM, max([*positive, 1.0]) * _ROOM
    for place, name in enumerate(names):
        ratio = ratios.get(name, 0.0)
        if ratio > 0.0:
            ax.barh(place, ratio - low, _HEIGHT, left=low, color=ORANGE if place == 0 else BLUE)
        ends = [table[name] for table in bounds if table.get(name, 0.0) > 0.0]
        if len(ends) == 2:
            ax.plot(ends, [place, place], color=BLACK, lw=1.6, marker="|", ms=8.0)
        if name in rest:
            element = next(each for each in solution.elements if each.name == name)
            text = f"summits touch, {element.state}" if element.touching else element.state
            note(ax, 0.02, place, text, data_axis="y", va="center", color=GREY, fontsize="medium")
    ax.axvline(1.0, color=BLACK, ls="--", lw=1.0)
    ax.set(xscale="log", xlim=(low, high), ylim=(len(names) - 0.4, -0.6))
    ax.set_yticks(range(len(names)), [printable(name) for name in names])
    ax.set_xlabel(f"voltage after an edge of {readable(result.case.edge)} V / breakdown voltage")
    legend_above(
        ax,
        [
            Patch(color=ORANGE, label="first element"),
            Patch(color=BLUE, label="other elements"),
            Line2D([], [], color=BLACK, marker="|", label="all meshes or no mesh conducts"),
        ],
        columns=3,
    )


def _draw_elements(result: AxleResult) -> Axes:
    (ax,) = new_panels(1, 1, (8.0, 1.8 + 0.4 * len(result.solution.elements)))
    elements(result, ax)
    return ax


def _first(result: AxleResult) -> str:
    """Sentence about the element that breaks down first."""
    ranking = [(name, ratio) for name, ratio in result.solution.ranking() if ratio > 0.0]
    if not ranking:
        return "No bearing or mesh has a voltage and a breakdown voltage"
    name, ratio = ranking[0]
    return f"{name}: {readable(ratio, 3)} times the breakdown voltage after an edge, the largest ratio"


def _torques(result: AxleResult) -> str:
    """Sentence about the torques of the figure of forces."""
    torque = result.case.drive.torque
    return f"Forces on the shafts at {amount(torque, 'N m')} and at {amount(-torque, 'N m')} of the rotor"


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
        FORCES_FIGURE: bool(result.case.mesh),
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
