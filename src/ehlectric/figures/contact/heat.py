"""Figures of the heat and the shear in the film of a contact: temperature and shear stress."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.results import PointResult
from ehlectric.figures.axes import BAR
from ehlectric.figures.contact.findings import AnyContact
from ehlectric.figures.lengths import in_half_widths, label_position
from ehlectric.figures.names import SHEAR_FIGURE, TEMPERATURE_FIGURE
from ehlectric.figures.section import section_part
from ehlectric.figures.style import BLUE, GREY, ORANGE, axes_or_new, figure_of, legend_above, new_panels
from ehlectric.quantities.units import unit_for

# Absolute temperature of 0 degC [K].
_CELSIUS = 273.15

# Range of x/b that is drawn, and colours of temperatures.
_WINDOW, _HEAT = (-1.75, 1.25), "inferno"

# Smallest range of the colours, of a film that is hardly heated [K].
_LEAST_RANGE = 0.1


def temperature(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the temperature across the film, at its middle and on both surfaces, and the shear stress.

    Parameters
    ----------
    result : Result or PointResult
        Result of a contact with a thermal film.
    ax : Axes, optional
        Axes to draw the temperature across the film on, alone; axes of a new figure with all panels if
        omitted.

    Returns
    -------
    Axes
        Axes of the map, over x/b and height with the outline of the film; of a point contact along y = 0.
        Below it, in a new figure, the temperatures at mid-film and of both surfaces, and the shear stress.
    """
    if ax is not None:
        return _map(result, ax)
    above, middle, below = new_panels(3, 1, (6.3, 7.2))
    _map(result, above)
    _temperatures(result, middle)
    shear_stress(result, below)
    return above


def shear_stress(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the shear stress at mid-film over x/b, with the pressure times the traction coefficient.

    Parameters
    ----------
    result : Result or PointResult
        Result of a contact whose case has a table ``film``.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the shear stress, of a point contact along y = 0. Both curves have the same mean over the
        contact; their difference shows where the traction comes from.
    """
    ax = axes_or_new(ax)
    heated = result.film.heated
    assert heated is not None
    x, stress = in_half_widths(result, result.film.x), _along(result, heated.shear_stress)
    shown = (x >= _WINDOW[0]) & (x <= _WINDOW[1])
    curves = [stress]
    if heated.traction_coefficient is not None:
        curves.append(heated.traction_coefficient * _along(result, result.film.pressure))
    factor, unit = unit_for(float(np.max(np.abs(np.stack(curves)[:, shown]))) or 1.0, "Pa")
    for mean in curves[1:]:
        share = f"pressure × {heated.traction_coefficient:.3g}, the traction coefficient"
        ax.plot(x, factor * mean, color=GREY, ls=":", lw=1.0, label=share.replace("-", "−"))
    ax.plot(x, factor * stress, color=BLUE, label="shear stress at mid-film")
    ax.axhline(0.0, color=GREY, lw=0.5, zorder=0.5)
    ax.set(xlim=_WINDOW, ylabel=f"shear stress [{unit}]")
    label_position(result, ax)
    legend_above(ax, columns=2)
    return ax


def _along(result: AnyContact, values: Array) -> Array:
    """Values (..., nx) along entrainment: of a point contact those of the line of nodes nearest to y = 0."""
    if isinstance(result, PointResult):
        line: Array = values[..., int(np.argmin(np.abs(result.film.y)))]
        return line
    return values


def _map(result: AnyContact, ax: Axes) -> Axes:
    """Draw the temperature over position and height, with the outline of the film and its colour bar."""
    heated = result.film.heated
    assert heated is not None and heated.temperature is not None and heated.zeta is not None
    x, thickness = in_half_widths(result, result.film.x), _along(result, result.film.thickness)
    shown = (x >= _WINDOW[0]) & (x <= _WINDOW[1])
    factor, unit = unit_for(float(np.median(thickness[np.abs(x) < 1.0])), "m")
    heights = factor * thickness[:, np.newaxis] * (heated.zeta - 0.5)
    values = _along(result, heated.temperature).T - _CELSIUS
    limits = float(values[shown].min()), float(values[shown].max())
    limits = limits[0], max(limits[1], limits[0] + _LEAST_RANGE)
    section_part(ax, x[shown], heights[shown], values[shown], limits=limits, colours=_HEAT)
    half = 1.6 * float(np.max(np.abs(heights[np.abs(x) < 1.0])))
    ax.set(xlim=_WINDOW, ylim=(-half, half), ylabel=f"height [{unit}]")
    label_position(result, ax)
    colours = ScalarMappable(Normalize(*limits), _HEAT)
    figure_of(ax).colorbar(colours, cax=ax.inset_axes(BAR), label="temperature [°C]")
    return ax


def _temperatures(result: AnyContact, ax: Axes) -> None:
    """Draw the temperatures at mid-film and of both surfaces over x/b."""
    heated = result.film.heated
    assert heated is not None and heated.mid_temperature is not None
    surfaces = heated.surface_temperatures
    assert surfaces is not None
    x = in_half_widths(result, result.film.x)
    looks: list[tuple[str, Array, dict[str, Any]]] = [
        ("mid-film", heated.mid_temperature, {"color": "black"}),
        ("surface 1", surfaces[0], {"color": BLUE, "ls": "--"}),
        ("surface 2", surfaces[1], {"color": ORANGE, "ls": (0, (5.0, 1.5))}),
    ]
    for label, values, look in looks:
        ax.plot(x, _along(result, values) - _CELSIUS, label=label, lw=1.2, **look)
    inlet = result.case.contact.temperature if isinstance(result.case, Case) else None
    if inlet is not None:
        ax.axhline(inlet - _CELSIUS, color=GREY, ls=":", lw=1.0, label="oil in the inlet")
    ax.set(xlim=_WINDOW, ylabel="temperature [°C]")
    label_position(result, ax)
    legend_above(ax, columns=4)


def heat_figures_of(result: AnyContact) -> dict[str, Callable[..., Axes]]:
    """Function that draws the heat and the shear of a film, by file name; none of a plain film."""
    heated = result.film.heated
    if heated is None:
        return {}
    return {TEMPERATURE_FIGURE: temperature} if heated.thermal else {SHEAR_FIGURE: shear_stress}
