"""Figures of a result. Nothing is computed here; each function draws on the axes it is given."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ehlectric.result import Result
from ehlectric.store import whole
from ehlectric.typing import Array

if TYPE_CHECKING:
    from matplotlib.collections import QuadMesh

MICRO = 1e6
GIGA = 1e-9

# Colours that stay apart in print and for colour-blind readers (Okabe and Ito).
_BLUE, _ORANGE, _GREEN, _GREY = "#0072b2", "#d55e00", "#009e73", "#555555"

_STYLE = {
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "legend.fontsize": 8.0,
    "lines.linewidth": 1.2,
    "axes.linewidth": 0.7,
    "savefig.dpi": 300,
    "figure.constrained_layout.use": True,
}


def _axes(ax: Axes | None) -> Axes:
    if ax is None:
        figure = Figure(figsize=(6.3, 3.4))
        FigureCanvasAgg(figure)
        ax = figure.subplots()
    return ax


def _position(result: Result, x: Array) -> Array:
    return x / result.conditions.half_width


def pressure_and_film(result: Result, ax: Axes | None = None) -> Axes:
    """Pressure and film thickness over X, the Hertz pressure behind them.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Those of the pressure; the film is on a twin.
    """
    ax = _axes(ax)
    film, conditions = result.film, result.conditions
    x = _position(result, film.x)
    hertz = conditions.max_pressure * np.sqrt(np.maximum(0.0, 1.0 - x**2))
    lines = ax.plot(x, GIGA * hertz, color=_GREY, ls="--", lw=0.8, label="Hertz pressure")
    lines += ax.plot(x, GIGA * film.pressure, color=_BLUE, label="pressure")
    ax.set(xlabel="$x/b$", ylabel="pressure $p$ [GPa]", xlim=(x[0], x[-1]))
    ax.set_ylim(0.0, 1.3 * GIGA * max(film.max_pressure, conditions.max_pressure))
    twin = ax.twinx()
    lines += twin.plot(x, MICRO * film.thickness, color=_ORANGE, label="film thickness")
    lines += twin.plot(
        _position(result, np.array([film.minimum_position])),
        [MICRO * film.minimum_thickness],
        ls="",
        marker="v",
        ms=4.0,
        color=_ORANGE,
        label=rf"$h_\mathrm{{min}}$ = {MICRO * film.minimum_thickness:.3g} µm",
    )
    twin.set_ylabel("film thickness $h$ [µm]")
    twin.set_ylim(0.0, 4.0 * MICRO * film.central_thickness)
    ax.legend(handles=lines, loc="upper left", frameon=False)
    return ax


def potential(result: Result, ax: Axes | None = None) -> Axes:
    """Map of the electric potential in the film.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        With a colour bar beside them.
    """
    field = result.field
    return _map(result, field.potential, ax, label="potential $V$ [V]", cmap="viridis")


def field_strength(result: Result, ax: Axes | None = None) -> Axes:
    """Map of the dimensionless field strength in the film, abs(E) h_min/V12.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        With a colour bar beside them.

    Notes
    -----
    As Figures 5 and 6 of Morris et al. (2022), doi:10.3390/lubricants10050087.
    """
    field = result.field
    scale = result.film.minimum_thickness / field.voltage
    label = r"field strength $|E|\,h_\mathrm{min}/V_{12}$"
    ax = _map(result, scale * field.strength, ax, label=label, cmap="inferno", bottom=0.0)
    strength = rf"$V_{{12}}/h_\mathrm{{min}}$ = {1 / MICRO / scale:.3g} V/µm"
    ax.text(0.02, 0.95, strength, transform=ax.transAxes, va="top", fontsize=8.0)
    return ax


def _map(
    result: Result,
    values: Array,
    ax: Axes | None,
    *,
    label: str,
    cmap: str,
    bottom: float | None = None,
) -> Axes:
    ax = _axes(ax)
    field = result.field
    x = np.broadcast_to(_position(result, field.x)[:, np.newaxis], values.shape)
    mesh: QuadMesh = ax.pcolormesh(
        x, MICRO * field.y, values, shading="gouraud", cmap=cmap, vmin=bottom, rasterized=True
    )
    for wall in (0, -1):
        ax.plot(x[:, 0], MICRO * field.y[:, wall], color="black", lw=0.8)
    ax.set(xlabel="$x/b$", ylabel="height $y$ [µm]", xlim=(x[0, 0], x[-1, 0]))
    ax.get_figure(root=True).colorbar(mesh, ax=ax, label=label, pad=0.02)  # type: ignore[union-attr]
    return ax


def field_profiles(result: Result, ax: Axes | None = None) -> Axes:
    """Field strength at mid-film and on both walls over X, the high-field zone shaded.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        In V/µm on the left, dimensionless on the right.
    """
    ax = _axes(ax)
    field = result.field
    x = _position(result, field.x)
    to_figure = 1.0 / MICRO
    start, stop = field.high_field_zone
    zone = _position(result, np.array([start, stop]))
    width = rf"above 95 % of the maximum: {MICRO * field.high_field_width:.3g} µm"
    ax.axvspan(zone[0], zone[1], color=_GREEN, alpha=0.25, lw=0.0, label=width)
    ax.plot(x, to_figure * field.strength[:, 0], color=_BLUE, label="surface 1")
    ax.plot(x, to_figure * field.strength[:, -1], color=_ORANGE, ls="--", label="surface 2")
    ax.plot(x, to_figure * field.middle_strength, color="black", lw=0.8, ls=":", label="mid-film")
    ax.set(xlabel="$x/b$", ylabel=r"field strength $|E|$ [V/µm]", xlim=(x[0], x[-1]))
    ax.set_ylim(0.0, 1.45 * to_figure * field.max_strength)
    scale = result.film.minimum_thickness / field.voltage * MICRO
    right = ax.secondary_yaxis("right", functions=(lambda e: e * scale, lambda e: e / scale))
    right.set_ylabel(r"$|E|\,h_\mathrm{min}/V_{12}$")
    ax.legend(loc="upper left", frameon=False, ncols=2)
    return ax


FIGURES: dict[str, Callable[..., Axes]] = {
    "film.png": pressure_and_film,
    "potential.png": potential,
    "field_strength.png": field_strength,
    "field_profiles.png": field_profiles,
}


def save_figures(result: Result, folder: Path) -> list[Path]:
    """Draw all figures as PNG files.

    Parameters
    ----------
    result : Result
        What to draw.
    folder : Path
        Where to; it must be there.

    Returns
    -------
    list of Path
        The files written.
    """
    files = []
    with mpl.rc_context(_STYLE):
        for name, draw in FIGURES.items():
            ax = draw(result)
            if result.case.title:
                ax.set_title(result.case.title)
            with whole(folder / name) as path:
                ax.get_figure(root=True).savefig(path)  # type: ignore[union-attr]
            files.append(folder / name)
    return files
