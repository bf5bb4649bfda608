"""Domain and zones of a line contact and of a point contact."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse, Rectangle

from sketches.pen import (
    BLUE,
    EDGE,
    GREY,
    INK,
    OIL,
    RED,
    SIZE,
    STEEL,
    arrow,
    frame,
    measure,
    pointed,
    sheet,
    words,
)

_IN, _OUT, _EXIT = -3.2, 2.0, 1.06  # ends of the domain and of the full film, in half-widths


def line_contact() -> Figure:
    """Section of a line contact along entrainment: film, pressure, zones, ends of the domain."""
    figure, (ax,) = sheet(7.6, 4.6)
    x = np.linspace(_IN - 0.35, _OUT + 0.35, 1200)
    low, high = _walls(x)
    ax.fill_between(x, high, 1.9, color=STEEL, lw=0.0, zorder=1)
    ax.fill_between(x, -1.9, low, color=STEEL, lw=0.0, zorder=1)
    filled = x <= _EXIT
    ax.fill_between(x[filled], low[filled], high[filled], color=OIL, lw=0.0, zorder=1)
    _fingers(ax, x[~filled], low[~filled], high[~filled])
    for wall in (low, high):
        ax.plot(x, wall, color=EDGE, lw=1.4, zorder=2)
    _pressure(ax)
    _zones(ax, -2.35)
    _film_labels(ax)
    ax.set_xlim(_IN - 0.35, _OUT + 0.9)
    ax.set_ylim(-3.05, 3.75)
    return figure


def _walls(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Heights of both surfaces: flat inside, a constriction before the exit, Hertz's gap outside."""
    outside = np.maximum(np.abs(x), 1.0)
    hertz = outside * np.sqrt(outside**2 - 1.0) - np.log(outside + np.sqrt(outside**2 - 1.0))
    half = 0.17 + 0.15 * hertz - 0.075 * np.exp(-(((x - 0.9) / 0.13) ** 2))
    return -half, half


def _fingers(ax: Axes, x: np.ndarray, low: np.ndarray, high: np.ndarray) -> None:
    """Oil on both walls behind the rupture, with gas between."""
    layer = 0.42 * (high[0] - low[0])
    for inner, wall in ((low + layer, low), (high - layer, high)):
        ax.fill_between(x, inner, wall, color=OIL, lw=0.0, zorder=1)


def _pressure(ax: Axes) -> None:
    x = np.linspace(_IN, _OUT, 1200)
    rise, peak = -0.93, 0.82  # where Hertz's pressure begins and where the spike is
    start = np.sqrt(1.0 - rise**2)
    hertz = np.sqrt(np.clip(1.0 - x**2, 0.0, None)) + 0.33 * np.exp(-np.abs(x - peak) / 0.035)
    top = float(np.sqrt(1.0 - peak**2) + 0.33)
    left = np.clip((_EXIT - x) / (_EXIT - peak), 0.0, 1.0)
    p = np.where(x < rise, start * np.exp(-rise * (x - rise) / start**2), hertz)
    p = np.where(x > peak, top * np.exp(-(x - peak) / 0.07) * left**2, p)
    ax.plot(x, 2.2 + 1.1 * p, color=BLUE, lw=1.5, zorder=6)
    words(ax, -0.05, 2.75, "pressure $p(x)$", color=BLUE)


def _zones(ax: Axes, level: float) -> None:
    """Zones below the section and the ends of the domain."""
    for place, text in ((_IN, "grid.inlet"), (_OUT, "grid.outlet")):
        ax.plot([place, place], [level - 0.33, 2.75], color=GREY, lw=1.0, ls=(0, (5, 3)), zorder=5)
        words(ax, place, 2.95, text, family="DejaVu Sans Mono", size=SIZE - 1.0)
    for place in (-1.0, 1.0):
        ax.plot([place, place], [level - 0.33, 2.2], color=GREY, lw=0.9, ls=":", zorder=5)
    for start, stop, text in ((_IN, -1.0, "inlet"), (-1.0, 1.0, "Hertzian zone"), (1.0, _OUT, "outlet")):
        measure(ax, (start, level), (stop, level))
        words(ax, 0.5 * (start + stop), level + 0.22, text)
    for place, text in ((-1.0, "$-b$"), (0.0, "$0$"), (1.0, "$b$")):
        words(ax, place, level - 0.53, text)
    arrow(ax, (_IN - 0.3, level - 0.33), (_OUT + 0.55, level - 0.33), lw=0.8)
    words(ax, _OUT + 0.68, level - 0.33, "$x$")


def _film_labels(ax: Axes) -> None:
    low, high = (float(wall[0]) for wall in _walls(np.array([0.0])))
    measure(ax, (0.0, low), (0.0, high))
    words(ax, 0.12, 0.0, "$h(0)$", ha="left")
    pointed(ax, (0.9, -0.05), (0.25, -0.85), "constriction:\nminimum film $h_\\mathrm{min}$")
    pointed(ax, (_EXIT, 0.0), (1.5, -1.3), "rupture, then\ncavitated film")
    words(ax, 1.8, 0.0, "gas", color=GREY)
    for y, text in ((0.95, "$u_2$"), (-1.5, "$u_1$")):
        arrow(ax, (-1.0, y), (-0.2, y), color=RED, lw=1.6)
        words(ax, -0.05, y, text, color=RED, ha="left")
    words(ax, -2.1, 1.6, "surface 2", color=EDGE, ha="left", size=SIZE - 0.5)
    words(ax, -2.1, -1.6, "surface 1", color=EDGE, ha="left", size=SIZE - 0.5)
    words(ax, -2.4, 0.0, "oil", color=INK)


def point_contact() -> Figure:
    """Plan of a point contact: domain, dry ellipse and the zones by which capacitances are given."""
    figure, (ax,) = sheet(7.6, 4.3)
    a, side = 1.45, 2.35
    ax.add_patch(Rectangle((_IN, -side), _OUT - _IN, 2 * side, fc="#eef2f7", ec=EDGE, lw=1.5, zorder=1))
    ax.add_patch(Rectangle((_IN, -a), _OUT - _IN, 2 * a, fc=OIL, ec="none", alpha=0.6, zorder=2))
    ax.add_patch(Ellipse((0, 0), 2.0, 2 * a, fc="#f2b5a7", ec=RED, lw=1.4, zorder=3))
    for y in (-a, a):
        ax.plot([_IN, _OUT], [y, y], color=GREY, lw=0.9, ls=":", zorder=4)
    for x, y, text in ((-2.0, -0.75, "inlet"), (0.0, -0.62, "Hertz\nellipse"), (1.5, -0.75, "outlet")):
        words(ax, x, y, text)
    for y in (-0.5 * (a + side), 0.5 * (a + side)):
        words(ax, -1.9, y, "sides")
    measure(ax, (0.0, 0.0), (1.0, 0.0))
    words(ax, 0.45, 0.17, "$b$")
    measure(ax, (0.0, 0.0), (0.0, a))
    words(ax, 0.16, 0.75, "$a$")
    arrow(ax, (_IN - 1.35, 0.0), (_IN - 0.2, 0.0), color=RED, lw=1.8)
    words(ax, _IN - 0.8, 0.25, "entrainment", color=RED)
    _sizes(ax, side)
    frame(ax, (_IN - 1.5, _OUT + 1.5), (-side - 0.75, side + 0.35))
    return figure


def _sizes(ax: Axes, side: float) -> None:
    """Keys that set the size of the domain, and the axes."""
    mono = {"family": "DejaVu Sans Mono", "size": SIZE - 1.0}
    below = -side - 0.28
    for x in (_IN, 0.0, _OUT):
        ax.plot([x, x], [-side, below - 0.12], color=GREY, lw=0.8)
    measure(ax, (_IN, below), (0.0, below))
    measure(ax, (0.0, below), (_OUT, below))
    words(ax, 0.5 * _IN, below - 0.27, "grid.inlet", **mono)
    words(ax, 0.5 * _OUT, below - 0.27, "grid.outlet", **mono)
    right = _OUT + 0.28
    for y in (0.0, side):
        ax.plot([_OUT, right + 0.12], [y, y], color=GREY, lw=0.8)
    measure(ax, (right, 0.0), (right, side))
    words(ax, right + 0.12, 0.5 * side, "grid.side", ha="left", **mono)
    arrow(ax, (right + 0.3, -1.9), (right + 1.0, -1.9), lw=0.9)
    arrow(ax, (right + 0.3, -1.9), (right + 0.3, -1.2), lw=0.9)
    words(ax, right + 1.13, -1.9, "$x$")
    words(ax, right + 0.3, -1.05, "$y$")
