"""Figure of an axle: voltage of each bearing and mesh over its breakdown voltage."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.axle import AxleResult
from ehlectric.errors import printable
from ehlectric.figures.figure_names import AXLE_FIGURE
from ehlectric.figures.style import drawing_of, legend_above, new_panels, titled
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
            ax.text(max(1.0, low) * 1.05, place, text, va="center", color=GREY)
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


def figure(result: AxleResult, name: str) -> Figure:
    """Draw the figure of an axle; its only name is "axle_elements.png"."""
    draw = drawing_of({AXLE_FIGURE: elements}, name)
    (ax,) = new_panels(1, 1, (8.0, 1.8 + 0.4 * len(result.solution.elements)))
    draw(result, ax)
    return titled(ax, result.case.title, converged=True)
