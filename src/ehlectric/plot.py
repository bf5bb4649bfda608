"""Figures of a result. Nothing is computed here; each function draws on the axes it is given."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ehlectric.result import Result
from ehlectric.store import whole
from ehlectric.typing import Array

MICRO = 1e6
GIGA = 1e-9

# Colours that stay apart in print and for colour-blind readers (Okabe and Ito).
_BLUE, _ORANGE, _GREEN, _GREY = "#0072b2", "#d55e00", "#009e73", "#555555"

_STYLE: dict[str, Any] = {
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


def _figure(ax: Axes) -> Figure:
    figure = ax.get_figure(root=True)
    assert figure is not None
    return figure


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
    """Map of the electric potential in the film, with ten equipotential lines.

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
    field, electric = result.field, result.case.electric
    low, high = sorted((electric.potential_1, electric.potential_2))
    ax = _map(result, field.potential, ax, label="potential $V$ [V]", limits=(low, high))
    lines = np.linspace(low, high, 12)[1:-1]
    x = np.broadcast_to(_position(result, field.x)[:, np.newaxis], field.y.shape)
    ax.contour(x, MICRO * field.y, field.potential, lines, colors="white", linewidths=0.4, linestyles="-")
    return ax


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
    values = scale * field.strength
    label = r"field strength $|E|\,h_\mathrm{min}/V_{12}$"
    ax = _map(result, values, ax, label=label, limits=(0.0, max(1.0, float(np.max(values)))))
    ax.set_title(rf"$V_{{12}}/h_\mathrm{{min}}$ = {1 / MICRO / scale:.3g} V/µm", loc="right")
    return ax


def _map(result: Result, values: Array, ax: Axes | None, *, label: str, limits: tuple[float, float]) -> Axes:
    ax = _axes(ax)
    field = result.field
    x = np.broadcast_to(_position(result, field.x)[:, np.newaxis], values.shape)
    levels = np.linspace(*limits, 401)
    # Rounding may put a wall beyond its own potential, and so out of the levels.
    filled = ax.contourf(
        x, MICRO * field.y, np.clip(values, *limits), levels, cmap="viridis", antialiased=False
    )
    for wall in (0, -1):
        ax.plot(x[:, 0], MICRO * field.y[:, wall], color="black", lw=0.8)
    ax.set(xlabel="$x/b$", ylabel="height $y$ [µm]", xlim=(x[0, 0], x[-1, 0]))
    bar = _figure(ax).colorbar(filled, ax=ax, label=label, pad=0.02)
    bar.set_ticks(list(np.linspace(*limits, 6)))
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
    right = ax.secondary_yaxis(
        "right", functions=(lambda e: np.asarray(e) * scale, lambda e: np.asarray(e) / scale)
    )
    right.set_ylabel(r"$|E|\,h_\mathrm{min}/V_{12}$")
    ax.legend(loc="upper left", frameon=False, ncols=2)
    return ax


def field_deviation(result: Result, ax: Axes | None = None) -> Axes:
    """Deviation of the field strength from the thin-gap estimate V12/h over X.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        In per mille of V12/h.
    """
    ax = _axes(ax)
    field = result.field
    x = _position(result, field.x)
    sections = (
        ("surface 1", field.strength[:, 0], _BLUE, "-"),
        ("surface 2", field.strength[:, -1], _ORANGE, "--"),
        ("mid-film", field.middle_strength, "black", ":"),
    )
    # The end faces disturb the field over about two gaps; that is not the film's doing.
    gap = field.voltage / field.thin_gap_strength
    start = np.searchsorted(field.x, field.x[0] + 3.0 * gap[0])
    stop = np.searchsorted(field.x, field.x[-1] - 3.0 * gap[-1])
    for label, strength, color, style in sections:
        deviation = 1e3 * (strength / field.thin_gap_strength - 1.0)
        ax.plot(x[start:stop], deviation[start:stop], color=color, ls=style, label=label)
    ax.set(xlabel="$x/b$", ylabel=r"$|E|\,h/V_{12} - 1$ [‰]", xlim=(x[0], x[-1]))
    ax.legend(loc="lower left", frameon=False)
    return ax


FIGURES: dict[str, Callable[..., Axes]] = {
    "film.png": pressure_and_film,
    "potential.png": potential,
    "field_strength.png": field_strength,
    "field_profiles.png": field_profiles,
    "field_deviation.png": field_deviation,
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
    with mpl.rc_context(_STYLE):  # type: ignore[arg-type]
        for name, draw in FIGURES.items():
            ax = draw(result)
            if result.case.title:
                ax.set_title(result.case.title, loc="left")
            with whole(folder / name) as path:
                _figure(ax).savefig(path)
            files.append(folder / name)
    return files
