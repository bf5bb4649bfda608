"""A ball between its grooves, and the bearing in a plane across its axis."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Wedge

from sketches.pen import (
    BLUE,
    EDGE,
    GREEN,
    GREY,
    INK,
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

_ANGLE, _GROOVE = (
    np.deg2rad(28.0),
    1.22,
)  # contact angle and groove radius of a ball of radius 1, both exaggerated
_BALL = "#e9eef4"


def groove() -> Figure:
    """Section through a ball along the axis, and the whole bearing across it."""
    figure, (section, plan) = sheet(8.6, 4.7, (1.08, 1.0))
    _section(section)
    _plan(plan)
    return figure


def _section(ax: Axes) -> None:
    line = np.array([np.sin(_ANGLE), np.cos(_ANGLE)])
    outer, inner = -(_GROOVE - 1.0) * line, (_GROOVE - 1.0) * line
    _ring(ax, outer, 1.0)
    _ring(ax, inner, -1.0)
    ax.add_patch(Circle((0, 0), 1.0, fc=_BALL, ec=EDGE, lw=1.4, zorder=3))
    ax.plot(*np.transpose([-1.5 * line, 1.62 * line]), color=RED, lw=1.0, ls=(0, (6, 2, 1, 2)), zorder=5)
    ax.plot([0, 0], [0.0, 1.62], color=GREY, lw=0.8, ls=(0, (6, 2, 1, 2)), zorder=4)
    ax.add_patch(
        Arc((0, 0), 1.3, 1.3, theta1=90.0 - np.rad2deg(_ANGLE), theta2=90.0, color=RED, lw=1.1, zorder=6)
    )
    words(ax, 0.2, 0.79, r"$\alpha$", color=RED)
    for place in (outer, inner):
        ax.plot(*place, "o", ms=4.5, color=GREEN, zorder=7)
    for place in (line, -line):
        ax.plot(*place, "o", ms=4.0, color=RED, zorder=7)
    for centre, degrees, text, at in (
        (outer, 128.0, "$f_o D$", (-0.47, 0.12)),
        (inner, -52.0, "$f_i D$", (0.47, -0.14)),
    ):
        tip = centre + _GROOVE * np.array([np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))])
        arrow(ax, tuple(centre), tuple(tip), color=GREEN, lw=1.0)
        words(ax, *at, text, color=GREEN, ha="left" if at[0] > 0 else "right")
    pointed(ax, tuple(0.5 * (outer + inner)), (0.62, 0.22), "$A$", color=GREEN)
    ax.plot(*np.transpose([outer, inner]), color=GREEN, lw=2.4, zorder=6)
    pointed(ax, tuple(line), (1.75, 1.1), "outer contact,\nload $Q_o$", ha="left", color=RED)
    pointed(ax, tuple(-line), (-1.75, -1.1), "inner contact,\nload $Q_i$", ha="right", color=RED)
    _ring_names(ax, outer)
    ax.plot([-2.2, 2.2], [-2.75, -2.75], color=INK, lw=1.0, ls=(0, (8, 2, 1, 2)))
    words(ax, -1.55, -2.6, "bearing axis", size=SIZE - 1.0)
    measure(ax, (0.0, -2.75), (0.0, 0.0))
    words(ax, 0.1, -2.3, "$d_m/2$", ha="left", size=SIZE - 0.5)
    pointed(ax, (0.96, -0.28), (1.75, -0.28), "ball,\ndiameter $D$", ha="left")
    frame(ax, (-2.85, 2.85), (-3.0, 2.1))


def _ring(ax: Axes, centre: np.ndarray, side: float) -> None:
    """Ring with its groove; side 1 is the outer ring, -1 the inner one."""
    half = np.deg2rad(52.0)
    u = np.linspace(-half, half, 80)
    arc = centre + _GROOVE * np.stack([np.sin(u), side * np.cos(u)], axis=1)
    left, right = centre[0] - 1.5, centre[0] + 1.5
    corners = [(right, arc[-1, 1]), (right, side * 1.72), (left, side * 1.72), (left, arc[0, 1])]
    ax.add_patch(Polygon([*arc, *corners], fc=STEEL, ec=EDGE, lw=1.4, zorder=2))


def _ring_names(ax: Axes, outer: np.ndarray) -> None:
    words(ax, -0.95, 1.5, "outer ring", size=SIZE - 0.5, color=EDGE)
    words(ax, 0.95, -1.5, "inner ring", size=SIZE - 0.5, color=EDGE)
    shoulder = outer[1] + _GROOVE * np.cos(np.deg2rad(52.0))
    bottom, x = outer[1] + _GROOVE, outer[0] - 1.68
    for y, start in ((shoulder, outer[0] - 1.5), (bottom, outer[0])):
        ax.plot([start, x - 0.1], [y, y], color=GREY, lw=0.8, zorder=6)
    measure(ax, (x, shoulder), (x, bottom))
    words(ax, x - 0.12, 0.5 * (shoulder + bottom), "shoulder\nheight", ha="right", size=SIZE - 0.5)


def _plan(ax: Axes) -> None:
    pitch, ball, play = 1.55, 0.36, 0.17
    outer, inner = pitch + ball, pitch - ball - 0.5 * play
    ax.add_patch(Wedge((0, 0), outer + 0.32, 0, 360, width=0.32, fc=STEEL, ec=EDGE, lw=1.4, zorder=2))
    drop = -0.5 * play
    ax.add_patch(Wedge((0, drop), inner, 0, 360, width=0.34, fc=STEEL, ec=EDGE, lw=1.4, zorder=2))
    for k in range(9):
        psi = np.deg2rad(40.0 * k)
        place = pitch * np.array([np.sin(psi), -np.cos(psi)])
        loaded = k in (0, 1, 8)
        ax.add_patch(Circle(place, ball, fc="#f2b5a7" if loaded else _BALL, ec=EDGE, lw=1.2, zorder=3))
        words(ax, *place, str(k), size=SIZE - 0.5)
    ax.add_patch(Arc((0, 0), 1.56, 1.56, theta1=-90.0, theta2=-50.0, color=BLUE, lw=1.1, zorder=5))
    for psi in (0.0, 40.0):
        end = 1.05 * np.array([np.sin(np.deg2rad(psi)), -np.cos(np.deg2rad(psi))])
        ax.plot([0, end[0]], [0, end[1]], color=BLUE, lw=0.8, zorder=5)
    words(ax, 0.25, -0.53, r"$\psi$", color=BLUE)
    arrow(ax, (0.0, 0.62), (0.0, 0.05), color=RED, lw=1.8)
    words(ax, -0.12, 0.45, "$F_r$", color=RED, ha="right")
    ax.add_patch(Circle((0, 0), pitch - ball, fc="none", ec=GREEN, lw=1.0, ls=(0, (4, 2)), zorder=3))
    pointed(
        ax, (0.0, pitch - ball - 0.5 * play), (0.0, 2.6), "clearance $P_d$ opposite the load", color=GREEN
    )
    _sectors(ax, pitch)
    frame(ax, (-2.6, 2.6), (-2.75, 2.9))


def _sectors(ax: Axes, pitch: float) -> None:
    """Names of loaded and unloaded elements."""
    pointed(ax, (0.3, -pitch - 0.2), (1.3, -2.6), "loaded elements", color=RED)
    pointed(ax, (-1.75, -0.54), (-1.6, -2.6), "unloaded: pressed outward\nby the centrifugal force")
