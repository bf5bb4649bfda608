"""Maps of point contacts: their place and scale on the page, colours and marks, and spots that touch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, cast

import numpy as np
import scipy
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import QuadMesh
from matplotlib.colorbar import Colorbar
from matplotlib.colors import Colormap, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch
from matplotlib.patheffects import AbstractPathEffect
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import Transform, offset_copy

from ehlectric.arrays import Array
from ehlectric.contact import PointConditions, PointResult, Result
from ehlectric.figures.contact_findings import AnyContact
from ehlectric.figures.contact_profiles import Line, film_scale, film_thickness, is_turned, shown_range
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.style import (
    LENGTH_AXIS,
    axes_or_new,
    figure_of,
    fitted_label,
    label_point,
    label_position,
    legend_above,
    length_axis,
    new_panels,
    note,
    outlined,
    page_width,
)
from ehlectric.quantities.palette import MAP_EDGE, ON_MAP, ORANGE
from ehlectric.quantities.units import unit_for

# Nodes along each side of a map, about: enough that no cell of the grid can be seen in print.
_NODES = 480


def refined(
    position: tuple[Array, Array], values: Array, window: tuple[tuple[float, float], tuple[float, float]]
) -> tuple[tuple[Array, Array], Array]:
    """Values on a finer grid within a window, by bicubic splines.

    Between nodes, lines of equal value are smooth instead of a chain of cells. A spline through a pressure
    spike may swing by several per cent of the spike on its flanks.

    ``position``, positions x, shape (nx,), and y, shape (ny,), of the nodes [m]; ``values``, values at the
    nodes, shape (nx, ny); ``window``, ranges of x and of y that are shown [m]. Returns ``position``,
    positions x, shape (mx,), and y, shape (my,), on the finer grid [m]; it contains all nodes of the window
    and the next ones around it; ``values``, values on the finer grid, shape (mx, my).
    """
    columns, rows = (_around(axis, ends) for axis, ends in zip(position, window, strict=True))
    x, y = position[0][columns], position[1][rows]
    spline = scipy.interpolate.RectBivariateSpline(
        x, y, values[columns, rows], kx=min(3, x.size - 1), ky=min(3, y.size - 1)
    )
    finer = _finer(x), _finer(y)
    fine: Array = spline(finer[0], finer[1])
    return finer, fine


def _around(axis: Array, ends: tuple[float, float]) -> slice:
    """Nodes within a range, and two more on either side."""
    first, last = np.searchsorted(axis, ends)
    return slice(max(int(first) - 2, 0), int(last) + 2)


def _finer(axis: Array) -> Array:
    """Nodes with further ones between them."""
    between = max(1, round(_NODES / axis.size))
    at = np.arange(between * (axis.size - 1) + 1) / between
    finer: Array = np.interp(at, np.arange(axis.size), axis)
    return finer


def smoothed(values: Array) -> Array:
    """Values at nodes (nx, ny), smoothed over about one spacing: filtered, plus the filtered rest.

    The second filtering gives back most of what the first takes off a round maximum.

    Of a mask as zeros and ones, the line of one half is the edge of the mask without the steps of the grid,
    less than a node away from it.
    """
    smooth: Array = scipy.ndimage.gaussian_filter(values, 1.0, mode="nearest")
    rest: Array = scipy.ndimage.gaussian_filter(values - smooth, 1.0, mode="nearest")
    return smooth + rest


# Smallest ratio of height to width, approximately, of a single map and of several maps side by side. If this
# needs different scales in x and y, the label of the axis states it.
_LEAST_HEIGHT, _LEAST_OF_SEVERAL = 0.42, 0.25

# Maps whose ratio of height to width is below this take the whole width of the page. They are drawn below
# each other, with the colour bar below them.
_LOW = 0.5

# Widths of a figure: with one map, what each further map next to it adds, and with low maps [inches].
_WIDTH, _FURTHER, _WIDE = 5.8, 1.6, 7.2

# Room around the maps: at their sides for labels and a colour bar; above and below them for title and labels,
# for each row of a legend, and for a colour bar [inches].
_SIDES, _ABOVE, _ROW, _BAR = 1.6, 0.85, 0.2, 0.45


Range = tuple[float, float]


class OfPointContact(Protocol):
    """Object with the conditions of a point contact: a result, or a run with moving roughness."""

    @property
    def conditions(self) -> PointConditions:
        """Conditions of the contact, of which the semi-axes are used."""
        ...


def film_window(result: PointResult) -> tuple[Range, Range]:
    """Ranges of x/b and y/b around the Hertz ellipse that maps of the film show, within the domain."""
    b, film, ratio = result.conditions.semi_axis_x, result.film, result.conditions.ratio
    side = min(ratio + 0.6 * float(np.sqrt(ratio)), float(film.y[-1]) / b)
    return shown_range(film.x / b), (-side, side)


def field_window(result: PointResult) -> tuple[Range, Range]:
    """Ranges of x/b and y/b over which the field was solved."""
    b, field = result.conditions.semi_axis_x, result.field
    x, y = field.x / b, field.y / b
    return (float(x[0]), float(x[-1])), (float(y[0]), float(y[-1]))


def map_panels(
    result: OfPointContact, number: int, window: tuple[Range, Range], *, rows: int = 0
) -> list[Axes]:
    """Axes of a new figure for maps of one window, next to or below each other.

    The maps fill the figure.
    """
    shape, _ = _shape(result, number, window)
    more = _ABOVE + _ROW * rows
    if on_low_page(result, number, window):
        wide = page_width(_WIDE)
        high = number * ((wide - 0.7) * shape + 0.3)
        panels = new_panels(number, 1, (wide, high + more + _BAR), exact=True)
    else:
        wide, columns = page_width(_WIDTH + _FURTHER * (number - 1)), number
        if page_width(_WIDTH) < _WIDTH:
            # In a column of a journal the maps stand below each other.
            wide, columns = page_width(_WIDTH), 1
        high = number // columns * (wide - _SIDES) / columns * shape + more
        panels = new_panels(number // columns, columns, (wide, high), exact=True)
    # Axes of equal scale shrink; this layout makes the colour bars as high as the shrunk axes.
    figure_of(panels[0]).set_layout_engine("compressed")
    return panels


def on_low_page(result: OfPointContact, number: int, window: tuple[Range, Range]) -> bool:
    """Whether maps of a window are so low that each takes the whole width of the page."""
    return _shape(result, number, window)[0] < _LOW


def _shape(result: OfPointContact, number: int, window: tuple[Range, Range]) -> tuple[float, float]:
    """Ratio of height to width of each map, and the factor by which its vertical axis is stretched.

    The factor is 1 if both axes have the same scale, else a multiple of 0.5.
    """
    width, height = _on_page(result, *(high - low for low, high in window))
    shape = float(height / width)
    least = _LEAST_HEIGHT if number == 1 else _LEAST_OF_SEVERAL
    stretch = max(1.0, 0.5 * round(2.0 * least / shape))
    return stretch * shape, stretch


def _on_page(result: OfPointContact, along: Any, across: Any) -> tuple[Any, Any]:
    """Quantities of the horizontal and of the vertical axis of a map, in this order.

    ``along`` belongs to x, along entrainment, and ``across`` to y; a turned contact has them swapped.
    """
    return (across, along) if is_turned(result.conditions) else (along, across)


def draw_map(
    result: OfPointContact,
    ax: Axes,
    position: tuple[Array, Array],
    values: Array,
    *,
    colours: str | Colormap,
    limits: Range,
    window: tuple[Range, Range],
    number: int = 1,
) -> QuadMesh:
    """Draw values as colours over x/b and y/b.

    Both axes have the same scale, except for long ellipses: their narrow axis is stretched, and its label
    states it.

    ``position``, positions x, shape (nx,), and y, shape (ny,), of the nodes [m]; ``values``, values at the
    nodes, shape (nx, ny). Returns the coloured mesh, from which a colour bar can be made.
    """
    mesh = ax.pcolormesh(
        *on_page(result, *position),
        values,
        shading="gouraud",
        cmap=colours,
        vmin=limits[0],
        vmax=limits[1],
        rasterized=True,
    )
    horizontal, vertical = _on_page(result, *window)
    ax.set(xlim=horizontal, ylim=vertical[::-1] if is_turned(result.conditions) else vertical)
    _, stretch = _shape(result, number, window)
    ax.set_aspect(stretch)
    _label_map(result, ax, stretch)
    return mesh


def film_unit(result: PointResult) -> tuple[float, str]:
    """Factor from metres, and unit, that suit the film thicknesses of a contact.

    Film thicknesses below a micrometre are in nanometres, as in interferograms.
    """
    return unit_for(max(result.film.central_thickness, result.film.mean_thickness), "m", least=1.0)


def on_page(result: OfPointContact, x: Array, y: Array) -> tuple[Array, Array]:
    """Horizontal and vertical positions on the page of nodes x, y [m], in semi-axes b, each (nx, ny)."""
    b = result.conditions.semi_axis_x
    along, across = np.meshgrid(x / b, y / b, indexing="ij")
    return _on_page(result, along, across)


def _label_map(result: OfPointContact, ax: Axes, stretch: float) -> None:
    """Label both axes of a map, with the scale if the vertical one is stretched."""
    horizontal, vertical = _on_page(result, "x", "y")
    label_position(result, ax, horizontal)
    ax.set_ylabel(f"${vertical}/b$" + ("" if stretch == 1.0 else f", scale {stretch:g}:1"))


def colour_bar(
    result: OfPointContact,
    mappable: ScalarMappable,
    axes: Sequence[Axes],
    label: str,
    *,
    window: tuple[Range, Range],
    ticks: Array,
    extend: str = "neither",
) -> Colorbar:
    """Add one colour bar for the maps on ``axes``: next to them, or below them if they are low."""
    place: dict[str, Any] = {"pad": 0.02}
    below = on_low_page(result, len(axes), window)
    if below:
        place = {"location": "bottom", "aspect": 60, "pad": 0.03, "shrink": 0.8}
    # Ticks are set here: those that matplotlib chooses change with the height of the bar, after the layout
    # has made room for their labels.
    first, last = mappable.get_clim()
    inside = ticks[(ticks >= first) & (ticks <= last)]
    figure = figure_of(axes[0])
    label = fitted_label(axes[0], label, along=below)
    return figure.colorbar(mappable, ax=list(axes), label=label, ticks=inside, extend=extend, **place)


def hertz_ellipse(result: OfPointContact, ax: Axes, ink: str = MAP_EDGE) -> Ellipse:
    """Draw the Hertz ellipse, the edge of the dry contact, as a dashed line."""
    edge = Ellipse(
        (0.0, 0.0),
        *_on_page(result, 2.0, 2.0 * result.conditions.ratio),
        fill=False,
        edgecolor=ink,
        linestyle=(0, (6.0, 3.0)),
        linewidth=0.8,
        path_effects=_outlined(ink, 2.0),
        label="Hertzian ellipse",
    )
    return cast("Ellipse", ax.add_patch(edge))


def legend_line(patch: Ellipse) -> Line2D:
    """Legend entry of a dashed ellipse."""
    return Line2D([], [], color="black", ls=patch.get_linestyle(), lw=0.8, label=str(patch.get_label()))


def _outlined(ink: str, width: float) -> list[AbstractPathEffect]:
    """Outline of a line or text on a map [pt]: dark around the light ink, light around the dark one."""
    return outlined(width, MAP_EDGE if ink == ON_MAP else ON_MAP)


def mark(result: OfPointContact, ax: Axes, at: Array, label: str) -> Line2D:
    """Draw crosses at positions ``at``, the rows x, y [m] of shape (n, 2); returns their legend entry."""
    along, across = (at / result.conditions.semi_axis_x).T
    (line,) = ax.plot(
        *_on_page(result, along, across),
        ls="none",
        marker="x",
        ms=5.0,
        mew=1.1,
        color=MAP_EDGE,
        path_effects=_outlined(MAP_EDGE, 2.4),
        label=label,
    )
    return line


def say(result: OfPointContact, ax: Axes, at: Array, text: str) -> None:
    """Write a text next to each of the positions ``at``, the rows x, y [m] of shape (n, 2).

    The text is on the side of the outlet: right of the marks, or below them where entrainment points down.
    Close marks share one text.
    """
    places = np.column_stack(_on_page(result, *(at / result.conditions.semi_axis_x).T))
    down = is_turned(result.conditions)
    offset, align = ((0.0, -11.0), {"ha": "center", "va": "top"}) if down else ((7.0, 0.0), {})
    side, ends = (0, ax.get_xlim()) if down else (1, ax.get_ylim())
    if np.ptp(places[:, side]) < 0.2 * np.ptp(ends):
        places = np.mean(places, axis=0, keepdims=True)
    for x, y in places:
        edge = _outlined(MAP_EDGE, 2.0)
        label_point(ax, (x, y), text, offset, color=MAP_EDGE, fontsize="small", path_effects=edge, **align)


def extreme_positions(x: Array, y: Array, values: Array) -> Array:
    """Positions x, y of the maximum of values (nx, ny), shape (1, 2) or (2, 2).

    A map that is symmetric about y = 0 has its maximum at two positions.
    """
    i, j = np.nonzero(values == np.max(values))
    return np.column_stack([x[i], y[j]])[[0, -1][: min(i.size, 2)]]


def entrainment(result: OfPointContact, ax: Axes, ink: str = MAP_EDGE) -> None:
    """Draw an arrow in the direction of entrainment, in a corner of the map at the inlet."""
    down = is_turned(result.conditions)
    corner = (0.0, 1.0) if down else (0.0, 0.0)

    def off(x: float, y: float) -> Transform:
        return offset_copy(ax.transAxes, figure_of(ax), x=x, y=y, units="points")

    tail, tip = ((8.0, -5.0), (8.0, -27.0)) if down else ((6.0, 8.0), (32.0, 8.0))
    arrow: dict[str, Any] = {"arrowstyle": "-|>", "color": ink, "lw": 1.0, "shrinkA": 0.0, "shrinkB": 0.0}
    ax.annotate(
        "",
        corner,
        xycoords=off(*tip),
        xytext=corner,
        textcoords=off(*tail),
        arrowprops=arrow | {"path_effects": _outlined(ink, 1.8)},
    )
    where, va = ((14.0, -5.0), "top") if down else ((6.0, 12.0), "bottom")
    ax.text(
        *corner,
        "entrainment",
        color=ink,
        fontsize="small",
        va=va,
        transform=off(*where),
        path_effects=_outlined(ink, 1.8),
    )


def round_levels(low: float, high: float, number: int) -> Array:
    """Round levels that enclose the range from ``low`` to ``high``, about ``number`` of them.

    The step between them is 1, 2 or 5 times a power of ten.

    Examples
    --------
    >>> round_levels(271.0, 455.0, 10)
    array([260., 280., 300., 320., 340., 360., 380., 400., 420., 440., 460.])
    """
    levels = MaxNLocator(number, steps=[1, 2, 5, 10]).tick_values(low, high)
    return np.asarray(levels, dtype=float)


def panel_name(ax: Axes, name: str) -> None:
    """Write the name of a panel in its upper right corner."""
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.9, "pad": 1.5}
    note(ax, 0.98, 0.97, name, ha="right", va="top", fontsize=8.0, bbox=box)


# Share of the Hertz zone outside of the spots whose film the colours and the axis span.
_SHOWN = 95.0

# Range of x/b of the profile of a line contact.
_LINE_WINDOW = (-1.4, 1.4)


def spots(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the film of a contact whose surfaces touch, and mark the nodes that touch. Returns axes of the map
    of a point contact, or of the profile of a line contact; thicker films than in 95 % of the Hertz
    zone have the last colour, or are cut off.
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
    ax = map_panels(result, 1, window, rows=1)[0] if ax is None else ax
    top = _thick(result)
    factor, unit = unit_for(top, "m", least=1.0)
    at, limits = (film.x, film.y), (0.0, factor * top)
    mesh = draw_map(result, ax, at, factor * film.thickness, colours="viridis", limits=limits, window=window)
    touched: Array = np.where(film.contact, 1.0, np.nan)
    ax.pcolormesh(
        *on_page(result, *at), touched, shading="nearest", cmap=ListedColormap([ORANGE]), rasterized=True
    )
    edge = hertz_ellipse(result, ax, ON_MAP)
    entrainment(result, ax)
    legend_above(ax, [Patch(color=ORANGE, label="contact spots"), legend_line(edge)])
    ticks = round_levels(*limits, 5)
    label = f"film thickness [{unit}]"
    colour_bar(result, mesh, [ax], label, window=window, ticks=ticks, extend="max")
    return ax


def _profile(result: Result, ax: Axes | None) -> Axes:
    ax = axes_or_new(ax)
    draw_panel(film_thickness(Line.through(result, 1.0 / result.conditions.half_width)), ax)
    top = 1.15 * _thick(result) * unit_for(film_scale(result), "m")[0]
    ax.set(xlim=_LINE_WINDOW, ylim=(-0.03 * top, top))
    label_position(result, ax)
    length_axis(result, ax)
    legend_above(ax, lift=LENGTH_AXIS)
    return ax
