"""Figure of a calibration: ranges of the inputs before and after, and measured next to computed values."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.calibration import Calibration, Compared
from ehlectric.cases.measurements import quantity_text
from ehlectric.figures.figure_names import CALIBRATION_FIGURE, in_formats
from ehlectric.figures.style import drawing_of, figure_of, legend_above, name_over, new_panels, style
from ehlectric.quantities.palette import BLUE, GREY, LIGHT_GREY, ORANGE

# Width of the figure and height of a bar with its label [inches], and heights of the bars in rows.
_WIDTH, _ROW, _WIDE, _NARROW = 9.0, 0.34, 0.62, 0.3

# Largest number of measured values that are drawn.
_DRAWN = 24


def figure(result: Calibration, name: str) -> Figure:
    """Figure of a calibration. Returns on the left the 90 % ranges of the inputs, as parts of their ranges;
    on the right computed values divided by measured ones, with the 95 % intervals of the measured values.
    Raises InputError where there is no figure of this name.
    """
    drawing_of({CALIBRATION_FIGURE: figure}, in_formats([name])[0])
    rows = result.rows[:_DRAWN]
    with style():
        height = 1.6 + _ROW * max(len(result.inputs), len(rows))
        left, right = new_panels(1, 2, (_WIDTH, height))
        _inputs(result, left)
        _compared(rows, right)
        name_over(left, "\n".join(_title(result)))
        return figure_of(left)


def _title(result: Calibration) -> list[str]:
    first = "Nothing within the ranges explains the measurement"
    if result.explained:
        first = "Ranges after the measurement"
        if result.before is not None and result.after is not None:
            before, after = result.before.brief, result.after.brief
            first = f"Probability of breakdown {before} before and {after} after the measurement"
    return [first, result.title]


def _inputs(result: Calibration, ax: Axes) -> None:
    """Draw the ranges of the inputs before and after the measurement, from 5 % to 95 %."""
    for place, entry in enumerate(result.inputs):
        width = entry.high - entry.low
        for ends, height, colour in (
            (entry.prior, _WIDE, LIGHT_GREY),
            (entry.posterior, _NARROW, BLUE),
        ):
            if ends is None or not width > 0.0:
                continue
            low, middle, high = ((end - entry.low) / width for end in ends)
            label = {LIGHT_GREY: "before", BLUE: "after"}[colour] if place == 0 else ""
            ax.barh(place, high - low, height, left=low, color=colour, label=label)
            if colour == BLUE:
                ax.plot([middle], [place], color=GREY, marker="|", ms=9.0, ls="none")
    ax.set_yticks(range(len(result.inputs)), [entry.label.partition(" (")[0] for entry in result.inputs])
    ax.invert_yaxis()
    ax.set_xlim(0.0, 1.0)
    ax.set_xlabel("90 % ranges, part of the range of the input")
    legend_above(ax, columns=2)


def _compared(rows: tuple[Compared, ...], ax: Axes) -> None:
    """Draw computed values divided by measured ones."""
    # Bars end within the axes, and not at their edge, where they would seem to be cut.
    ax.use_sticky_edges = False
    labels = []
    for place, row in enumerate(rows):
        line = "" if row.line is None else f", line {row.line}"
        labels.append(f"{quantity_text(row.quantity)}{line}")
        if not row.measured:
            continue
        for ends, height, colour in ((row.prior, _WIDE, LIGHT_GREY), (row.posterior, _NARROW, BLUE)):
            if ends is None or not all(math.isfinite(end) for end in ends):
                continue
            low, high = ends[0] / row.measured, ends[2] / row.measured
            ax.barh(place, high - low, height, left=low, color=colour)
        bar = 1.96 * row.uncertainty / abs(row.measured)
        label = "measured (95 %)" if place == 0 else ""
        ax.errorbar([1.0], [place], xerr=[bar], color=ORANGE, ls="none", marker="o", ms=3.5, label=label)
        nearest = row.nearest / row.measured
        if row.posterior is None and math.isfinite(nearest):
            label = "nearest" if place == 0 else ""
            ax.plot([nearest], [place], color=GREY, marker="x", ls="none", label=label)
    ax.set_yticks(range(len(rows)), labels)
    ax.invert_yaxis()
    ax.set_xlabel("computed / measured")
    legend_above(ax, columns=2)
