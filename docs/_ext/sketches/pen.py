"""Colours, arrows and symbols that all sketches share."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

INK, STEEL, EDGE, OIL = "#14263d", "#cfd8e3", "#34527a", "#f6dfae"
BLUE, RED, GREEN, GREY = "#0072b2", "#c23b22", "#007a5a", "#6b7684"
SIZE = 9.5


def sheet(width: float, height: float, widths: tuple[float, ...] = (1.0,)) -> tuple[Figure, list[Axes]]:
    """Figure [inch] with panels beside each other, without frames."""
    figure = Figure(figsize=(width, height), layout="constrained")
    grid = figure.add_gridspec(1, len(widths), width_ratios=widths)
    axes = [figure.add_subplot(grid[0, k]) for k in range(len(widths))]
    for ax in axes:
        ax.axis("off")
    return figure, axes


def words(ax: Axes, x: float, y: float, text: str, **options: Any) -> None:
    """Text centred at a place."""
    ax.text(
        x, y, text, **({"ha": "center", "va": "center", "size": SIZE, "color": INK, "zorder": 9} | options)
    )


def arrow(
    ax: Axes, start: tuple[float, float], stop: tuple[float, float], style: str = "-|>", **options: Any
) -> None:
    """Arrow between two places; style "<|-|>" is a measure."""
    props = {
        "arrowstyle": style,
        "lw": 1.1,
        "color": INK,
        "shrinkA": 0.0,
        "shrinkB": 0.0,
        "mutation_scale": 10.0,
    }
    ax.annotate("", stop, start, arrowprops=props | options, zorder=8)


def measure(ax: Axes, start: tuple[float, float], stop: tuple[float, float], **options: Any) -> None:
    """Double arrow that marks a length."""
    arrow(ax, start, stop, "<|-|>", **({"lw": 0.9, "mutation_scale": 8.0} | options))


def pointed(ax: Axes, place: tuple[float, float], at: tuple[float, float], text: str, **options: Any) -> None:
    """Text with a thin line to the place it names."""
    props = {"arrowstyle": "-", "lw": 0.8, "color": GREY, "shrinkA": 1.0, "shrinkB": 0.0}
    settings = {"ha": "center", "va": "center", "size": SIZE, "color": INK, "zorder": 9} | options
    ax.annotate(text, place, at, arrowprops=props, **settings)


def wire(ax: Axes, *places: tuple[float, float], **options: Any) -> None:
    """Straight conductors through places."""
    x, y = zip(*places, strict=True)
    ax.plot(x, y, **({"color": INK, "lw": 1.2, "solid_capstyle": "round", "zorder": 3} | options))


def capacitor(
    ax: Axes, x: float, low: float, high: float, text: str = "", *, side: float = 0.3, **options: Any
) -> None:
    """Capacitor between two heights of a vertical conductor, with its name beside it."""
    middle, gap, plate = 0.5 * (low + high), 0.09, 0.26
    colour = options.pop("color", INK)
    wire(ax, (x, low), (x, middle - gap), color=colour)
    wire(ax, (x, middle + gap), (x, high), color=colour)
    for y in (middle - gap, middle + gap):
        wire(ax, (x - plate, y), (x + plate, y), lw=2.2, color=colour)
    if text:
        words(
            ax,
            x + np.copysign(0.08 + plate, side),
            middle,
            text,
            ha="left" if side > 0 else "right",
            color=colour,
        )


def node(ax: Axes, x: float, y: float) -> None:
    """Dot where conductors meet."""
    ax.plot([x], [y], "o", ms=4.5, color=INK, zorder=4)


def ground(ax: Axes, x: float, y: float) -> None:
    """Earthed frame."""
    for k, half in enumerate((0.28, 0.18, 0.08)):
        wire(ax, (x - half, y - 0.09 * k), (x + half, y - 0.09 * k), lw=1.6)


def spark(ax: Axes, x: float, y: float, height: float, **options: Any) -> None:
    """Zigzag of a discharge."""
    shape = np.array([(0.05, 0.5), (-0.13, 0.06), (0.03, 0.08), (-0.05, -0.5), (0.15, -0.02), (0.0, -0.04)])
    ax.fill(
        x + height * shape[:, 0] * 1.5,
        y + height * shape[:, 1],
        **({"color": RED, "zorder": 7, "lw": 0.0} | options),
    )


def frame(ax: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    """Limits of a panel, with equal scales."""
    ax.set_xlim(*x)
    ax.set_ylim(*y)
    ax.set_aspect("equal")
