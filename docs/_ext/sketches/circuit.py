"""Circuit of a bearing and of the motor around it."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from sketches.pen import (
    BLUE,
    EDGE,
    GREEN,
    GREY,
    RED,
    SIZE,
    STEEL,
    capacitor,
    frame,
    ground,
    node,
    sheet,
    wire,
    words,
)


def circuit() -> Figure:
    """Elements of a bearing in parallel, and the divider that makes the shaft voltage."""
    figure, (bearing, motor) = sheet(8.6, 4.0, (1.0, 1.05))
    _bearing(bearing)
    _motor(motor)
    return figure


def _bearing(ax: Axes) -> None:
    places = (0.0, 1.45, 3.75)
    for y, text in ((3.1, "inner ring = shaft"), (-0.3, "outer ring = frame")):
        ax.add_patch(Rectangle((-0.6, y), 5.4, 0.4, fc=STEEL, ec=EDGE, lw=1.2, zorder=2))
        words(ax, 2.1, y + 0.2, text)
    for x, k in zip(places, ("0", "1", "Z-1"), strict=True):
        capacitor(ax, x, 1.6, 3.1, f"$C_{{i,{k}}}$", color=BLUE)
        capacitor(ax, x, 0.1, 1.6, f"$C_{{o,{k}}}$", color=GREEN)
        node(ax, x, 1.6)
        words(ax, x, -0.55, f"element {k}" if k != "Z-1" else "element $Z-1$", size=SIZE - 1.0)
    words(ax, 2.75, 1.6, "...", size=16)
    words(ax, 0.14, 1.6, "ball", ha="left", size=SIZE - 1.0, color=GREY)
    words(ax, 2.1, 3.85, "One bearing: two films in series, $Z$ elements in parallel", size=SIZE)
    frame(ax, (-0.8, 5.0), (-0.8, 4.05))


def _motor(ax: Axes) -> None:
    words(ax, 2.25, 3.85, "In the motor: a capacitive divider", size=SIZE)
    for y, text, x0, x1 in (
        (3.1, "winding, common-mode voltage $V_\\mathrm{cm}$", 0.0, 4.5),
        (1.55, "rotor and shaft, $V_\\mathrm{shaft}$", -0.6, 5.1),
    ):
        ax.add_patch(Rectangle((x0, y), x1 - x0, 0.4, fc=STEEL, ec=EDGE, lw=1.2, zorder=2))
        words(ax, 0.5 * (x0 + x1), y + 0.2, text)
    capacitor(ax, 2.25, 1.95, 3.1, "$C_\\mathrm{wr}$, winding to rotor", color=RED)
    for x, text, colour in (
        (0.05, "$C_\\mathrm{rf}$", GREY),
        (2.0, "$C_\\mathrm{DE}$", BLUE),
        (3.95, "$C_\\mathrm{NDE}$", BLUE),
    ):
        capacitor(ax, x, 0.1, 1.55, text, color=colour)
    wire(ax, (0.05, 0.1), (3.95, 0.1))
    wire(ax, (3.0, 0.1), (3.0, -0.08))
    ground(ax, 3.0, -0.08)
    words(ax, 3.35, -0.16, "frame", ha="left")
    for x, text in ((0.05, "rotor to frame"), (1.9, "drive-end bearing"), (4.15, "other bearing")):
        words(ax, x, -0.55, text, size=SIZE - 1.0)
    frame(ax, (-0.85, 5.35), (-0.8, 4.05))
