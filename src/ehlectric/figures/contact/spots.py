"""Figure of the film of a contact whose surfaces touch, with its spots."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from ehlectric.arrays import Array
from ehlectric.contact.results import PointResult, Result
from ehlectric.figures.contact.findings import AnyContact
from ehlectric.figures.contact.maps import (
    colour_bar,
    draw_map,
    entrainment,
    film_window,
    hertz_ellipse,
    legend_line,
    map_panels,
    on_page,
    round_levels,
)
from ehlectric.figures.contact.profiles import Line, film_scale, film_thickness
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.lengths import LENGTH_AXIS, label_position, length_axis
from ehlectric.figures.names import SPOTS_FIGURE
from ehlectric.figures.style import axes_or_new, legend_above
from ehlectric.quantities.palette import ORANGE
from ehlectric.quantities.units import unit_for

# Share of the Hertz zone outside of the spots whose film the colours and the axis span.
_SHOWN = 95.0

# Range of x/b of the profile of a line contact.
_LINE_WINDOW = (-1.4, 1.4)


def spots(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the film of a contact whose surfaces touch, and mark the nodes that touch.

    Parameters
    ----------
    result : Result or PointResult
        Result whose surfaces touch.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes of the map of a point contact, or of the profile of a line contact. Thicker films than those of
        95 % of the Hertz zone have the last colour, or are cut off.
    """
    return _map(result, ax) if isinstance(result, PointResult) else _profile(result, ax)


def _thick(result: AnyContact) -> float:
    """Film thickness that 95 % of the Hertz zone outside of the spots is thinner than [m]."""
    film = result.film
    axes = np.meshgrid(*film.axes, indexing="ij")
    zone = sum((x / a) ** 2 for x, a in zip(axes, result.conditions.semi_axes, strict=True)) <= 1.0
    around = film.thickness[zone & ~film.contact]
    return float(np.percentile(around if around.size else film.thickness, _SHOWN))


def _map(result: PointResult, ax: Axes | None) -> Axes:
    film, window = result.film, film_window(result)
    if ax is None:
        (ax,) = map_panels(result, 1, window, rows=1)
    top = _thick(result)
    factor, unit = unit_for(top, "m", least=1.0)
    at, limits = (film.x, film.y), (0.0, factor * top)
    mesh = draw_map(result, ax, at, factor * film.thickness, colours="viridis", limits=limits, window=window)
    touched: Array = np.where(film.contact, 1.0, np.nan)
    ax.pcolormesh(
        *on_page(result, *at), touched, shading="nearest", cmap=ListedColormap([ORANGE]), rasterized=True
    )
    edge = hertz_ellipse(result, ax, "white")
    entrainment(result, ax, "white")
    legend_above(ax, [Patch(color=ORANGE, label="surfaces touch"), legend_line(edge)])
    ticks = round_levels(*limits, 5)
    label = f"film thickness [{unit}]"
    colour_bar(result, mesh, [ax], label, window=window, ticks=ticks, extend="max")
    return ax


def _profile(result: Result, ax: Axes | None) -> Axes:
    ax = axes_or_new(ax)
    panel = film_thickness(Line.through(result, 1.0 / result.conditions.half_width))
    draw_panel(panel, ax)
    top = 1.15 * _thick(result) * unit_for(film_scale(result), "m")[0]
    ax.set(xlim=_LINE_WINDOW, ylim=(-0.03 * top, top))
    label_position(result, ax)
    length_axis(result, ax)
    legend_above(ax, lift=LENGTH_AXIS)
    return ax


def spots_figures_of(result: AnyContact) -> dict[str, Callable[..., Axes]]:
    """Figure of the spots by the name of its file; none where the surfaces do not touch."""
    return {SPOTS_FIGURE: spots} if result.converged and np.any(result.film.contact) else {}
