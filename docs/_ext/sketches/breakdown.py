"""First breakdown and ring-to-ring breakdown of one element."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from sketches.pen import BLUE, EDGE, GREEN, INK, OIL, RED, SIZE, STEEL, arrow, frame, sheet, spark, words

_INNER, _OUTER = 3.15, 0.75  # heights of the two films


def two_steps() -> Figure:
    """One element below its first breakdown, after it, and after ring-to-ring breakdown."""
    figure, axes = sheet(8.6, 4.2, (1.0, 1.0, 1.0))
    heads = (
        "1  Both films insulate",
        "2  First breakdown, $V_1 \\leq V < V_2$",
        "3  Ring-to-ring breakdown, $V \\geq V_2$",
    )
    texts = (
        "The films share the voltage:\n$s_i V$ on the inner film,\n$s_o V = (1 - s_i) V$ on the outer one",
        "One film conducts. The full voltage $V$\nis across the other film.\nNo path from ring to ring yet",
        (
            "Both films conduct:\ncurrent $i$ flows from ring to ring.\n"
            "If the second film withstands less\nthan $V_1$, both fail at once: $V_2 = V_1$"
        ),
    )
    for k, (ax, head, text) in enumerate(zip(axes, heads, texts, strict=True)):
        _element(ax)
        words(ax, 1.5, 4.6, head, weight="bold", size=SIZE)
        words(ax, 1.5, -0.35, text, size=SIZE - 0.5, va="top")
        if k >= 1:
            spark(ax, 1.5, _INNER, 0.5)
        if k == 2:
            spark(ax, 1.5, _OUTER, 0.5)
        _voltages(ax, k)
        frame(ax, (-0.35, 3.35), (-1.75, 4.85))
    return figure


def _element(ax: Axes) -> None:
    """Ball between the inner ring above and the outer ring below, films not to scale."""
    for y, text in ((3.3, "inner ring, voltage $V$"), (0.0, "outer ring, 0 V")):
        ax.add_patch(Rectangle((0.0, y), 3.0, 0.6, fc=STEEL, ec=EDGE, lw=1.3, zorder=3))
        words(ax, 1.5, y + 0.3, text, size=SIZE - 0.5)
    for y in (3.0, 0.6):
        ax.add_patch(Rectangle((0.75, y), 1.5, 0.3, fc=OIL, ec="none", zorder=1))
    ax.add_patch(Circle((1.5, 1.95), 1.05, fc="#e9eef4", ec=EDGE, lw=1.3, zorder=2))
    words(ax, 1.5, 1.95, "element", size=SIZE - 0.5)


def _voltages(ax: Axes, state: int) -> None:
    """Voltage on each film, by the length of a bar at the right."""
    colours = (BLUE, GREEN)
    held = (("$s_i V$", "$s_o V$"), ("0", "$V$"), ("0", "0"))[state]
    for y, text, colour, name in zip(
        (_INNER, _OUTER), held, colours, ("inner film", "outer film"), strict=True
    ):
        broken = text == "0"
        words(
            ax,
            2.42,
            y,
            text if not broken else "0 V",
            ha="left",
            color=RED if broken else colour,
            size=SIZE + 0.5,
        )
        words(ax, 0.62, y, name, ha="right", color=INK, size=SIZE - 1.5)
    if state == 2:
        arrow(ax, (0.22, 2.85), (0.22, 1.05), color=RED, lw=1.6)
        words(ax, 0.1, 1.95, "$i$", color=RED, ha="right")
