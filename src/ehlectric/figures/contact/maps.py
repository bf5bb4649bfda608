"""What the figures of point contacts share: how a contact lies on the page, maps, marks on them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, cast

import numpy as np
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import QuadMesh
from matplotlib.colorbar import Colorbar
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import Transform, offset_copy

from ehlectric.arrays import Array
from ehlectric.cases.quantity import unit_for
from ehlectric.contact.conditions import PointConditions
from ehlectric.contact.results import PointResult
from ehlectric.figures.style import figure_of, label_position, new_panels

# An ellipse longer than this across entrainment lies along the page: entrainment then points down.
_TURNED = 1.2

# Maps are at least about so high by their width, one alone and several: where that takes more than one scale,
# the axis says so.
_LEAST_HEIGHT, _LEAST_OF_SEVERAL = 0.42, 0.25

# Maps lower than this by their width take the page's: below each other, their colour bar below them.
_LOW = 0.5

# Widths of a figure of maps: of one, for every further one beside it, and of low ones [inches].
_WIDTH, _FURTHER, _WIDE = 5.8, 1.6, 7.2

# Beside the maps: labels and a colour bar; above and below them: title and labels, a row of a legend, such a
# bar [inches].
_BESIDE, _ABOVE, _ROW, _BAR = 1.6, 0.85, 0.2, 0.45

# Around the Hertz ellipse: before and behind it in semi-axes along entrainment, as in the line contact.
_BEFORE, _BEHIND = -2.0, 1.5
Range = tuple[float, float]


class OfPointContact(Protocol):
    """What lies on the page as a point contact does: its result, or a run of roughness that moves."""

    @property
    def conditions(self) -> PointConditions:
        """Those of the contact."""
        ...


def turned(result: OfPointContact) -> bool:
    """Whether a contact is drawn with entrainment pointing down, y to the right."""
    return result.conditions.ratio > _TURNED


def film_window(result: PointResult) -> tuple[Range, Range]:
    """Ranges of x/b and y/b around the contact, within the domain."""
    b, film, ratio = result.conditions.semi_axis_x, result.film, result.conditions.ratio
    side = min(ratio + 0.6 * float(np.sqrt(ratio)), float(film.y[-1]) / b)
    return (max(float(film.x[0]) / b, _BEFORE), min(float(film.x[-1]) / b, _BEHIND)), (-side, side)


def field_window(result: PointResult) -> tuple[Range, Range]:
    """Ranges of x/b and y/b in which the field was solved."""
    b, field = result.conditions.semi_axis_x, result.field
    x, y = field.x / b, field.y / b
    return (float(x[0]), float(x[-1])), (float(y[0]), float(y[-1]))


def map_panels(
    result: OfPointContact, number: int, window: tuple[Range, Range], *, rows: int = 0
) -> list[Axes]:
    """Axes of a new figure for maps of one window, of a size that they fill: beside or below each other.

    ``rows`` are those of a legend above them.
    """
    shape, _ = _shape(result, number, window)
    more = _ABOVE + _ROW * rows
    if on_low_page(result, number, window):
        high = number * ((_WIDE - 0.7) * shape + 0.3)
        panels = new_panels(number, 1, (_WIDE, high + more + _BAR))
    else:
        wide = _WIDTH + _FURTHER * (number - 1)
        panels = new_panels(1, number, (wide, (wide - _BESIDE) / number * shape + more))
    # Colour bars as high as their maps, whose axes shrink to keep their scale.
    figure_of(panels[0]).set_layout_engine("compressed")
    return panels


def on_low_page(result: OfPointContact, number: int, window: tuple[Range, Range]) -> bool:
    """Whether maps of one window take the width of the page, with their colour bar below them."""
    return _shape(result, number, window)[0] < _LOW


def _shape(result: OfPointContact, number: int, window: tuple[Range, Range]) -> tuple[float, float]:
    """Height of each of several maps over its width, and the scale of its vertical axis.

    The scale is that by which it is stretched: 1, or more in steps of a half.
    """
    width, height = _on_page(result, *(high - low for low, high in window))
    shape = float(height / width)
    least = _LEAST_HEIGHT if number == 1 else _LEAST_OF_SEVERAL
    stretch = max(1.0, 0.5 * round(2.0 * least / shape))
    return stretch * shape, stretch


def _on_page(result: OfPointContact, along: Any, across: Any) -> tuple[Any, Any]:
    """What goes with the horizontal axis of a map and what with the vertical one."""
    return (across, along) if turned(result) else (along, across)


def draw_map(
    result: OfPointContact,
    ax: Axes,
    position: tuple[Array, Array],
    values: Array,
    *,
    colours: str,
    limits: Range,
    window: tuple[Range, Range],
    number: int = 1,
) -> QuadMesh:
    """Values (nx, ny) at positions x, y [m] as colours, one of so many maps, its axes in semi-axes b.

    Both are to one scale, but for long ellipses: their narrow axis is stretched, and its label says so.

    Returns
    -------
    QuadMesh
        For a colour bar.
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
    ax.set(xlim=horizontal, ylim=vertical[::-1] if turned(result) else vertical)
    _, stretch = _shape(result, number, window)
    ax.set_aspect(stretch)
    _label_map(result, ax, stretch)
    return mesh


def film_unit(result: PointResult) -> tuple[float, str]:
    """Factor and unit of film thicknesses: those of interferograms are in nanometres."""
    return unit_for(max(result.film.central_thickness, result.film.mean_thickness), "m", least=1.0)


def on_page(result: OfPointContact, x: Array, y: Array) -> tuple[Array, Array]:
    """Positions x, y [m] of the nodes of a grid on the page, in semi-axes b, shape (nx, ny)."""
    b = result.conditions.semi_axis_x
    along, across = np.meshgrid(x / b, y / b, indexing="ij")
    return _on_page(result, along, across)


def _label_map(result: OfPointContact, ax: Axes, stretch: float) -> None:
    """Labels of the axes of a map."""
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
    """Colour bar of the maps of one window on ``axes``: beside them, or below low ones."""
    place: dict[str, Any] = {"pad": 0.02}
    if on_low_page(result, len(axes), window):
        place = {"location": "bottom", "aspect": 60, "pad": 0.03}
    # Given, not found: those found change with the height of the bar, after room was made for them.
    first, last = mappable.get_clim()
    shown = ticks[(ticks >= first) & (ticks <= last)]
    figure = figure_of(axes[0])
    return figure.colorbar(mappable, ax=list(axes), label=label, ticks=shown, extend=extend, **place)


def hertz_ellipse(result: OfPointContact, ax: Axes, ink: str = "black") -> Ellipse:
    """The edge of the dry contact, dashed."""
    edge = Ellipse(
        (0.0, 0.0),
        *_on_page(result, 2.0, 2.0 * result.conditions.ratio),
        fill=False,
        edgecolor=ink,
        linestyle=(0, (6.0, 3.0)),
        linewidth=0.8,
        path_effects=_outlined(ink, 2.0),
        label="Hertz ellipse",
    )
    return cast("Ellipse", ax.add_patch(edge))


def legend_line(patch: Ellipse) -> Line2D:
    """How a dashed edge is shown in a legend."""
    return Line2D([], [], color="black", ls=patch.get_linestyle(), lw=0.8, label=str(patch.get_label()))


def _outlined(ink: str, width: float) -> list[patheffects.AbstractPathEffect]:
    """An edge that keeps black or white ink apart from what is under it, of so many points."""
    edge = "white" if ink == "black" else "black"
    return [patheffects.withStroke(linewidth=width, foreground=edge)]


def mark(result: OfPointContact, ax: Axes, at: Array, label: str) -> Line2D:
    """Marker at positions x, y [m], shape (n, 2)."""
    along, across = (at / result.conditions.semi_axis_x).T
    (line,) = ax.plot(
        *_on_page(result, along, across),
        ls="none",
        marker="x",
        ms=5.0,
        mew=1.1,
        color="black",
        path_effects=_outlined("black", 2.4),
        label=label,
    )
    return line


def extreme_positions(x: Array, y: Array, values: Array) -> Array:
    """Positions of the largest of values (nx, ny): one, or the two of a map that is its own mirror image."""
    i, j = np.nonzero(values == np.max(values))
    return np.column_stack([x[i], y[j]])[[0, -1][: min(i.size, 2)]]


def entrainment(result: OfPointContact, ax: Axes, ink: str = "black") -> None:
    """Arrow along entrainment in a corner of the inlet."""
    down = turned(result)
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
        fontsize=8.0,
        va=va,
        transform=off(*where),
        path_effects=_outlined(ink, 1.8),
    )


def round_levels(low: float, high: float, number: int) -> Array:
    """About ``number`` values at steps of 1, 2 or 5 times a power of ten, from ``low`` or below to ``high``
    or above.

    Examples
    --------
    >>> round_levels(271.0, 455.0, 10)
    array([260., 280., 300., 320., 340., 360., 380., 400., 420., 440., 460.])
    """
    levels = MaxNLocator(number, steps=[1, 2, 5, 10]).tick_values(low, high)
    return np.asarray(levels, dtype=float)


def panel_name(ax: Axes, name: str) -> None:
    """Name of one of several panels, in a corner of it."""
    ax.text(
        0.98,
        0.97,
        name,
        transform=ax.transAxes,
        ha="right",
        va="top",
        fontsize=8.0,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.9, "pad": 1.5},
    )
