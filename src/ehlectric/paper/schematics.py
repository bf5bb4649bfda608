"""Figures 2 and 3 of the paper, drawn anew: schematics of the film model and of the field model."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.arrays import Array
from ehlectric.figures.style import figure_of, new_panels
from ehlectric.quantities.palette import BODY, OIL

_INK = "black"


def _canvas(size: tuple[float, float]) -> Axes:
    """Axes without frame of a new figure of size (width, height) [inches]."""
    (ax,) = new_panels(1, 1, size)
    ax.set_axis_off()
    return ax


def _arrow(ax: Axes, start: tuple[float, float], stop: tuple[float, float], style: str = "-|>") -> None:
    """Draw an arrow between two points."""
    ax.annotate(
        "",
        xy=stop,
        xytext=start,
        arrowprops={"arrowstyle": style, "color": _INK, "lw": 1.0, "mutation_scale": 12},
    )


def _text(ax: Axes, x: float, y: float, text: str, **options: object) -> None:
    """Write a text centred at a point."""
    ax.text(x, y, text, ha="center", va="center", **options)  # type: ignore[arg-type]


def _gap(x: Array) -> Array:
    """Half of a schematic film thickness: flat from x = -1 to 1 with an exit constriction, wider outside."""
    outside = np.maximum(np.abs(x) - 1.0, 0.0)
    gap: Array = 0.16 + 0.35 * outside**1.5 - 0.05 * np.exp(-(((x - 0.95) / 0.12) ** 2))
    return gap


def film_model() -> Figure:
    """Draw Figure 2: two loaded cylinders, the film between them, and the boundary conditions at its ends."""
    ax = _canvas((8.0, 4.4))
    x = np.linspace(-4.0, 2.0, 601)
    half = _gap(x)
    ax.fill_between(x, -half, half, color=OIL, lw=0.0)
    for sign in (-1.0, 1.0):
        ax.fill_between(x, sign * half, sign * 2.6, color=BODY, lw=0.0)
        ax.plot(x, sign * half, color=_INK, lw=1.2)
    pressure = 0.16 + 1.3 * np.sqrt(np.maximum(0.0, 1.0 - x**2))
    ax.plot(x[np.abs(x) <= 1.0], pressure[np.abs(x) <= 1.0], color=_INK, lw=1.0, ls="--")
    _text(ax, 0.0, 1.12, "pressure $p(x)$")
    for sign, k, where in ((1.0, 2, 2.0), (-1.0, 1, -2.0)):
        _text(ax, 0.0, where, f"body {k}: $E_{k}$, $\\nu_{k}$, $R_{k}$")
        _arrow(ax, (-2.3, sign * 1.35), (-1.5, sign * 1.35))
        _text(ax, -2.5, sign * 1.35, f"$u_{k}$")
    _arrow(ax, (0.0, 3.3), (0.0, 2.65))
    _text(ax, 0.25, 3.05, "$w$")
    _arrow(ax, (0.0, -3.3), (0.0, -2.65))
    _text(ax, 0.25, -3.05, "$w$")
    _arrow(ax, (0.35, -0.75), (0.35, -0.16))
    _arrow(ax, (0.35, 0.75), (0.35, 0.16))
    _text(ax, 0.35, 0.0, "$h(x)$", fontsize=8.0)
    for end, side in ((-4.0, "inlet"), (2.0, "outlet")):
        ax.plot([end, end], [-_gap(np.array([end]))[0], _gap(np.array([end]))[0]], color=_INK, lw=1.0, ls=":")
        _text(ax, end, -3.05, f"{side}, $x/b = {end:g}$\n$p = p_\\mathrm{{atm}}$")
    _text(ax, -2.6, 0.0, "lubricant: $\\eta(p)$, $\\rho(p)$")
    _text(ax, 1.62, 0.0, "cavitated", fontsize=8.0)
    _arrow(ax, (-4.75, -0.4), (-4.25, -0.4))
    _arrow(ax, (-4.75, -0.4), (-4.75, 0.4))
    _text(ax, -4.15, -0.4, "$x$")
    _text(ax, -4.75, 0.6, "$y$")
    ax.set(xlim=(-4.9, 2.9), ylim=(-3.5, 3.5))
    return figure_of(ax)


def field_model() -> Figure:
    """Draw Figure 3: the film as a dielectric between two conductors, and the boundary conditions."""
    ax = _canvas((8.0, 3.6))
    x = np.linspace(-1.25, 1.25, 501)
    half = _gap(x)
    ax.fill_between(x, -half, half, color=OIL, lw=0.0)
    for level in np.linspace(-1.0, 1.0, 9)[1:-1]:
        ax.plot(x, level * half, color="#b08800", lw=0.5)
    for column in np.linspace(-1.25, 1.25, 26):
        reach = float(_gap(np.array([column]))[0])
        ax.plot([column, column], [-reach, reach], color="#b08800", lw=0.5)
    for sign, k, volts in ((-1.0, 1, "−1"), (1.0, 2, "+1")):
        ax.fill_between(x, sign * half, sign * 0.62, color=BODY, lw=0.0)
        ax.plot(x, sign * half, color=_INK, lw=1.2)
        _text(
            ax,
            -0.45,
            sign * 0.42,
            f"surface {k}, conductor: $V = V_{k}$ = {volts} V on $y = {'+-'[k == 1]}h/2$",
        )
    for column in (-0.75, 0.05, 0.95):
        reach = float(_gap(np.array([column]))[0])
        _arrow(ax, (column, reach), (column, -reach))
    _text(ax, 0.13, 0.0, "$E$", backgroundcolor=OIL)
    for end, side in ((-1.25, "right"), (1.25, "left")):
        ax.text(end * 1.04, 0.0, "$\\partial V/\\partial n = 0$", ha=side, va="center")
    _text(
        ax,
        0.0,
        -0.75,
        "film: $\\nabla\\cdot(\\varepsilon\\nabla V) = 0$, permittivity $\\varepsilon(\\rho(p(x)))$; "
        "constriction at the exit, right",
    )
    ax.set(xlim=(-1.75, 1.75), ylim=(-0.85, 0.68))
    return figure_of(ax)
