"""Figures of the heat and the shear in the film of a contact: temperature and shear stress."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from ehlectric.arrays import Array
from ehlectric.contact.results import PointResult
from ehlectric.figures.axes import BAR
from ehlectric.figures.contact import profiles
from ehlectric.figures.contact.findings import AnyContact
from ehlectric.figures.contact.profiles import Line
from ehlectric.figures.data import Panel
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.lengths import in_half_widths, label_position
from ehlectric.figures.names import SHEAR_FIGURE, TEMPERATURE_FIGURE
from ehlectric.figures.section import section_part
from ehlectric.figures.style import axes_or_new, figure_of, legend_above, new_panels
from ehlectric.quantities.units import unit_for

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
    _panel(result, profiles.temperature, middle)
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
    return _panel(result, profiles.shear_stress, axes_or_new(ax))


def _panel(result: AnyContact, panel_of: Callable[[Line], Panel], ax: Axes) -> Axes:
    """Draw a panel over x/b, of a point contact along y = 0."""
    draw_panel(panel_of(Line.through(result, 1.0 / result.conditions.half_width)), ax)
    ax.set_xlim(*_WINDOW)
    label_position(result, ax)
    legend_above(ax, columns=4)
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
    values = _along(result, heated.temperature).T - profiles.CELSIUS
    limits = float(values[shown].min()), float(values[shown].max())
    limits = limits[0], max(limits[1], limits[0] + _LEAST_RANGE)
    section_part(ax, x[shown], heights[shown], values[shown], limits=limits, colours=_HEAT)
    half = 1.6 * float(np.max(np.abs(heights[np.abs(x) < 1.0])))
    ax.set(xlim=_WINDOW, ylim=(-half, half), ylabel=f"height [{unit}]")
    label_position(result, ax)
    colours = ScalarMappable(Normalize(*limits), _HEAT)
    figure_of(ax).colorbar(colours, cax=ax.inset_axes(BAR), label="temperature [°C]")
    return ax


def heat_figures_of(result: AnyContact) -> dict[str, Callable[..., Axes]]:
    """Function that draws the heat and the shear of a film, by file name; none of a plain film."""
    heated = result.film.heated
    if heated is None:
        return {}
    return {TEMPERATURE_FIGURE: temperature} if heated.thermal else {SHEAR_FIGURE: shear_stress}
