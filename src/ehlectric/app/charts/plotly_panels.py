"""Common look of the figures of pages: colours, axes, numbers, and curves in panels that share an axis."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from html import escape
from itertools import pairwise
from textwrap import wrap
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.figures.data import Along, Area, Curve, Limit, MapPanel, Mesh, Panel, with_unit
from ehlectric.quantities.palette import MIDDLE_GREY, ORANGE, faint
from ehlectric.readable import readable

# Maps of colours: film, pressure and field. Plotly has no Plasma of its own.
FILM_COLOURS, PRESSURE_COLOURS = "Viridis", "Cividis"
_PLASMA = "#0d0887 #46039f #7201a8 #9c179e #bd3786 #d8576b #ed7953 #fb9f3a #fdca26 #f0f921"
FIELD_COLOURS = [[round(k / 9.0, 4), colour] for k, colour in enumerate(_PLASMA.split())]

# Lines of the grid and of axes: seen on white and on black.
_GRID, _LINE = "rgba(128,128,128,0.25)", "rgba(128,128,128,0.7)"

# Colour of texts in figures of three dimensions, which the styles of the page do not reach: readable on
# white and on black.
INK = "#808080"

# Text across a figure of a film that did not converge.
NO_SOLUTION = "NOT CONVERGED<br>do not use these values"

# Largest number of pixels along a side of a map that a page receives.
MOST_PIXELS = 160

# Height of a panel, and gap between panels as a part of the height of the figure [px].
_PANEL, _GAP = 190, 0.05

# Number of the first of the hidden axes from 0 to 1 over each panel, behind the axes of panels; height of the
# marks of points without a value on a hidden axis, and its name in a figure of one panel.
_HIDDEN, STRIP, STRIP_AXIS = 11, 0.04, "y11"

# Pixels of a line that is a point wide, and largest number of intervals of a curve whose extremes are kept.
_PIXELS, _INTERVALS = 5.0 / 3.0, 1500

# Ends of the decades of a logarithmic axis that have ticks, and most decades with ticks at 1, 2 and 5.
_ALL_TICKS, _DECADES = (1e-6, 1e9), 4

# Longest line of the title of an axis [characters], and symbol in the name of a quantity.
_TITLE = 30
_SYMBOL = re.compile(r" ?\$[^$]*\$")

# Letters on a line of the name of a row, and lines after which it is cut.
_LETTERS, _LINES = 16, 3

# Text at the pointer, letters on the colours of a map, and height of a map [px].
_TEXT, _ON_MAP, _MAP = "%{text}<extra></extra>", {"color": "#ffffff", "size": 11}, 430

# Largest number of nodes along an axis between which the lines of a map are straight.
_NODES = 41

# Node that separates two outlines in one curve.
_GAP_NODE = np.array([np.nan])

# Margins of figures in boxes [px].
NARROW = {"l": 8, "r": 8, "t": 8, "b": 8}

_CONFIG: dict[str, Any] = {
    "displaylogo": False,
    "modeBarButtonsToRemove": ["select2d", "lasso2d", "autoScale2d"],
    "toImageButtonOptions": {"format": "svg", "filename": "ehlectric"},
}

Plot = dict[str, Any]
Indices = NDArray[np.intp]


def plot(data: Iterable[Mapping[str, Any]], *, height: int, converged: bool = True, **layout: Any) -> Plot:
    """Figure of Plotly with the look of the app: data, layout and config. ``height`` is in pixels.

    Where the result did not converge, words across the figure state it. Texts have no colours: the styles of
    the page set them, in light and dark.
    """
    whole: Plot = {
        "height": height,
        "margin": {"l": 62, "r": 16, "t": 36, "b": 48},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"size": 13},
        "legend": {"orientation": "h", "x": 0.0, "y": 1.02, "yanchor": "bottom"},
        "hoverlabel": {"font": {"size": 13}},
        "modebar": {"bgcolor": "rgba(0,0,0,0)"},
        "uirevision": "same",
        # The decimal point, and a space that breaks no line between groups of three digits.
        "separators": ".\xa0",
        **layout,
    }
    if not converged:
        middle = {"xref": "paper", "yref": "paper", "x": 0.5, "y": 0.5, "showarrow": False, "textangle": -12}
        text = {"text": NO_SOLUTION, "font": {"size": 26}, "opacity": 0.85}
        whole["annotations"] = [*whole.get("annotations", ()), middle | text]
    return {"data": [dict(trace) for trace in data], "layout": whole, "config": _CONFIG}


def axis(title: str = "", **more: Any) -> Plot:
    """Axis of a figure; ``title`` has its unit in brackets."""
    look: Plot = {"gridcolor": _GRID, "zerolinecolor": _LINE, "linecolor": _LINE, "ticks": "outside"}
    look |= {"tickcolor": _LINE, "automargin": True, "showline": True}
    look |= {"separatethousands": True, "minexponent": 6}
    return look | ({"title": {"text": title, "standoff": 6}} if title else {}) | more


def log_ticks(*, log: bool, ends: tuple[float, float] | None = None) -> Plot:
    """Type of an axis, and ticks of a logarithmic one, whose numbers are written in full.

    Between ``ends``, the ticks are 1, 2 and 5 of each decade, and over many decades some powers of ten.
    """
    if not log:
        return {"type": "linear"}
    low, high = ends or _ALL_TICKS
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    many = ends is not None and len(powers) > _DECADES
    chosen = powers[:: max(1, len(powers) // _DECADES)] if many else powers
    ticks = [float(f"{digit}e{power}") for power in chosen for digit in ((1,) if many else (1, 2, 5))]
    if ends is not None:
        within = [tick for tick in ticks if low * 0.999 <= tick <= high * 1.001]
        ticks = within if len(within) > 1 else [low, high]
    texts = [readable(tick, 12) for tick in ticks]
    return {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": texts}


def plain(title: str, unit: str) -> str:
    r"""Name of a quantity with its unit, in lines, and without the symbols that only Matplotlib writes.

    Examples
    --------
    >>> plain(r"breakdown voltage $V_\mathrm{b}$", "V"), plain("time with\nmetallic contact", "%")
    ('breakdown voltage [V]', 'time with<br>metallic contact [%]')
    """
    lines = with_unit(_SYMBOL.sub("", title).rstrip(), unit).splitlines()
    return "<br>".join(part for line in lines for part in wrap(line, _TITLE))


def vertical(at: float, **more: Any) -> Plot:
    """Dashed line across all panels at a position, such as the edge of the dry contact."""
    line = {"color": MIDDLE_GREY, "width": 1, "dash": "dash"}
    return {"type": "line", "x0": at, "x1": at, "yref": "paper", "y0": 0.0, "y1": 1.0, "line": line} | more


def scatter(
    x: Any,
    y: Any,
    *,
    digits: tuple[int, int] = (7, 7),
    hover: str = "",
    label: str = "",
    polar: bool = False,
    **more: Any,
) -> Plot:
    """Trace over positions: a line where it has the key ``line``, else markers.

    ``digits`` are the digits of x and y, ``hover`` is the text at the pointer with a ``label`` next to it,
    and ``more`` are further keys. The positions of a polar trace are angles [deg] and radii.
    """
    first, second = ("theta", "r") if polar else ("x", "y")
    return {
        "type": "scatterpolar" if polar else "scatter",
        "mode": "lines" if "line" in more else "markers",
        first: values(x, digits[0]),
        second: values(y, digits[1]),
        **({"hovertemplate": f"{hover}<extra>{label}</extra>"} if hover else {"hoverinfo": "skip"}),
        **more,
    }


def axis_name(number: int, stem: str = "y") -> str:
    """Name of the y axis of a panel, counted from 0; Plotly numbers axes from the second on."""
    return f"{stem}{number + 1}" if number else stem


def domains(count: int) -> list[list[float]]:
    """Ends of panels one above the other, the highest first, as parts of the height of a figure."""
    share = (1.0 - _GAP * (count - 1)) / count
    tops = (1.0 - number * (share + _GAP) for number in range(count))
    return [[max(0.0, top - share), top] for top in tops]


def values(array: Any, digits: int = 7) -> list[Any]:
    """Numbers of an array as nested lists, with a number of digits; None where there is none.

    Examples
    --------
    >>> values([1.23456789, float("nan"), 0.0], 4)
    [1.235, None, 0.0]
    """
    numbers = np.asarray(array, dtype=float)
    finite = np.isfinite(numbers)
    size = np.abs(np.where(finite & (numbers != 0.0), numbers, 1.0))
    factor = 10.0 ** np.clip(digits - 1 - np.floor(np.log10(size)), -300, 300)
    rounded = np.where(finite, np.round(np.where(finite, numbers, 0.0) * factor) / factor, 0.0)
    whole: NDArray[Any] = rounded
    if not finite.all():
        whole = rounded.astype(object)
        whole[~finite] = None
    listed: list[Any] = whole.tolist()
    return listed


def thinned(curves: Sequence[Array], most: int) -> Indices:
    """Increasing indices of nodes along a line, of which every curve keeps its smallest and largest values.

    The curves are values over the same nodes, shape (n,), NaN where a curve has a gap. Both ends are kept, a
    node of each gap, and all nodes where they are few.

    Examples
    --------
    >>> wave = np.sin(np.linspace(0.0, 9.0, 10001))
    >>> kept = thinned([wave], 100)
    >>> kept.size < 210, bool(np.max(wave[kept]) == np.max(wave))
    (True, True)
    """
    number = curves[0].size
    if number <= 2 * most:
        return np.arange(number)
    edges = np.linspace(0, number, most + 1).astype(int)
    kept = {0, number - 1}
    for curve in curves:
        gaps = np.isnan(curve)
        low, high = np.where(gaps, np.inf, curve), np.where(gaps, -np.inf, curve)
        for first, last in pairwise(edges):
            part = slice(first, last)
            kept |= {first + int(np.argmin(low[part])), first + int(np.argmax(high[part]))}
            if np.any(gaps[part]):
                kept.add(first + int(np.argmax(gaps[part])))
    return np.array(sorted(kept))


def kept_nodes(number: int, most: int, also: Iterable[int] = ()) -> Indices:
    """Indices of at most ``most`` nodes of a number, evenly spaced, with both ends and some others.

    Examples
    --------
    >>> kept_nodes(17, 6, [3]).tolist()
    [0, 3, 4, 8, 12, 16]
    """
    if number <= most:
        return np.arange(number)
    further = sorted(set(also))
    even = np.round(np.linspace(0, number - 1, max(2, most - len(further)))).astype(int)
    return np.unique(np.concatenate([even, np.array(further, dtype=int)]))


def coarser(heights: Array, most: int = MOST_PIXELS) -> tuple[Array, tuple[int, int]]:
    """Map of fewer pixels, each with the value of its block that is farthest from the mean of the map.

    The map has NaN where it has no value, shape (nx, ny). The pixels, shape (mx, my), contain its largest and
    its smallest value; with them come the points along the sides of a block.

    Examples
    --------
    >>> import numpy as np
    >>> surface = np.zeros((100, 30))
    >>> surface[71, 11] = -2.0
    >>> pixels, block = coarser(surface, 50)
    >>> pixels.shape, block, float(pixels[35, 11])
    ((50, 30), (2, 1), -2.0)
    """
    block = tuple(math.ceil(n / most) for n in heights.shape)
    shape = tuple(math.ceil(n / size) for n, size in zip(heights.shape, block, strict=True))
    whole = np.full([n * size for n, size in zip(shape, block, strict=True)], np.nan)
    whole[: heights.shape[0], : heights.shape[1]] = heights
    there = np.isfinite(heights)
    mean = float(np.mean(heights[there])) if np.any(there) else 0.0
    blocks = whole.reshape(shape[0], block[0], shape[1], block[1]).swapaxes(1, 2).reshape(*shape, -1)
    away = np.where(np.isfinite(blocks), np.abs(blocks - mean), -1.0)
    pixels: Array = np.take_along_axis(blocks, np.argmax(away, axis=-1)[..., np.newaxis], axis=-1)[..., 0]
    return pixels, (block[0], block[1])


def stack(along: Along, panels: Sequence[Panel], *, converged: bool = True, **more: Any) -> Plot:
    """Figure with at most four panels, in which the pointer shows the values of all of them at one position.

    Of a result that did not converge, all curves are grey, and words across the figure state it; ``more`` are
    further keys of the layout.
    """
    layout: dict[str, Any] = {
        "xaxis": axis(
            plain(along.name, along.unit),
            anchor=axis_name(len(panels) - 1),
            unifiedhovertitle={"text": f"{along.name} = %{{x:,.5~r}} {along.unit}"},
            **axis_range(along.window, log=along.log),
            **log_ticks(log=along.log, ends=along.window),
        ),
        "hovermode": "x unified",
        "hoversubplots": "axis",
        "hoverdistance": 30,
        "shapes": [vertical(edge, layer="below") for edge in along.edges],
        "height": _PANEL * len(panels) + 110,
    }
    data: list[Plot] = []
    for number, (panel, ends_of_panel) in enumerate(zip(panels, domains(len(panels)), strict=True)):
        name, hidden = axis_name(number), f"y{_HIDDEN + number}"
        domain = {"domain": ends_of_panel, "anchor": "x"}
        ends = axis_range(panel.ends, log=panel.log)
        text = plain(panel.title, "")
        unit = f"{'<br>' if len(panels) > 1 and '<br>' not in text else ' '}[{panel.unit}]"
        title = f"{text}{unit if panel.unit else ''}"
        ticks = _row_names(panel.rows) if panel.rows else log_ticks(log=panel.log, ends=panel.ends)
        layout["yaxis" + name[1:]] = axis(title, **domain, **ends, **ticks)
        data += [_shaded(area, name, hidden) for area in panel.areas]
        data += [_trace(curve, panel.unit, name, converged=converged) for curve in panel.curves]
        data += [
            scatter(
                [line.at] * 2,
                [0.0, 1.0],
                yaxis=hidden,
                name=line.name,
                showlegend=bool(line.name),
                line={"color": line.colour, "width": 2.0, "dash": line.dash},
            )
            for line in panel.uprights
        ]
        data += [
            _trace(replace(curve, y=np.full(curve.x.size, STRIP)), None, hidden, converged=converged)
            for curve in panel.missing
        ]
        if panel.areas or panel.uprights or panel.missing:
            whole = {"overlaying": name, "range": [0.0, 1.0], "visible": False, "fixedrange": True}
            layout["yaxis" + hidden[1:]] = whole | domain
    return plot(data, converged=converged, **layout | more)


# Looks of markers. Those with a symbol that is open have no face.
_MARKERS: Mapping[str, Plot] = {
    "dots": {"size": 6, "line": {"width": 0}},
    "ring": {"size": 9, "symbol": "circle-open"},
    "star": {"size": 15, "symbol": "star", "line": {"color": "white", "width": 1}},
    "circle": {"size": 6, "symbol": "circle-open"},
    "wide circle": {"size": 13, "symbol": "circle-open"},
    "square": {"size": 8, "symbol": "square-open"},
    "diamond": {"size": 9, "symbol": "diamond-open"},
    "plus": {"size": 10, "symbol": "cross-thin"},
    "cross": {"size": 8, "symbol": "x-thin"},
    "triangle": {"size": 8, "symbol": "triangle-down", "line": {"color": "#000000", "width": 1}},
    "wide cross": {"size": 9, "symbol": "x", "line": {"color": "#000000", "width": 1}},
    "full square": {"size": 6, "symbol": "square", "line": {"width": 0}},
    "full diamond": {"size": 7, "symbol": "diamond", "line": {"width": 0}},
    "bound": {"size": 8, "symbol": "triangle-left-open", "line": {"width": 1}},
}


def _row_names(names: Sequence[str]) -> Plot:
    """Ticks of rows; texts of Plotly take some marks of HTML, which a name must not make."""
    texts = [
        "<br>".join(wrap(escape(name, quote=False), _LETTERS, max_lines=_LINES, placeholder=" ..."))
        for name in names
    ]
    return {"tickmode": "array", "tickvals": list(range(len(names))), "ticktext": texts, "ticks": ""}


def axis_range(ends: tuple[float, float] | None, *, log: bool) -> Plot:
    """Ends of an axis as Plotly takes them; none where they are not known."""
    if ends is None:
        return {}
    return {"range": [math.log10(end) for end in ends] if log else list(ends)}


def polar_traces(panel: Panel) -> list[Plot]:
    """Traces of a panel over angles [rad]."""
    areas = [replace(area, x=np.degrees(area.x)) for area in panel.areas]
    curves = [replace(curve, x=np.degrees(curve.x)) for curve in panel.curves]
    return [
        *(_shaded(area, "", "", polar=True) for area in areas),
        *(_trace(curve, panel.unit, "", converged=True, polar=True) for curve in curves),
    ]


def _trace(curve: Curve, unit: str | None, yaxis: str, *, converged: bool, polar: bool = False) -> Plot:
    colour = curve.colour if converged else MIDDLE_GREY
    kept = thinned([curve.y], _INTERVALS)
    height = "r" if polar else "y"
    hover = f"%{{{height}:,.4~r}} {unit}" if unit is not None and curve.name and curve.x.size > 1 else ""
    if curve.marker:
        marker = {"color": colour, **_MARKERS[curve.marker]}
        edge = {"color": colour, "width": 2, **marker.get("line", {})}
        look: Plot = {"marker": marker | {"size": curve.size * marker["size"], "line": edge}}
    else:
        shape = {"shape": "hv"} if curve.steps else {}
        look = {"line": {"color": colour, "dash": curve.dash, "width": _PIXELS * curve.width} | shape}
    if curve.texts:
        look["text"] = [escape(curve.texts[k], quote=False).replace("\n", "<br>") for k in kept]
    look |= {"cliponaxis": False} if polar else {"yaxis": yaxis}
    return scatter(
        curve.x[kept],
        curve.y[kept],
        # The name of a single mark has its value.
        hover="%{text}" if curve.texts else hover,
        label="" if curve.texts else curve.name,
        polar=polar,
        name=curve.name,
        showlegend=bool(curve.name),
        **look,
    )


def _shaded(area: Area, yaxis: str, hidden: str, *, polar: bool = False) -> Plot:
    """Outlines of all spans of an area with gaps between them, filled."""
    look: Plot = {"fillcolor": faint(area.colour, area.opacity)}
    if area.hatched:
        look["fillpattern"] = {"shape": "/", "size": 8, "fgcolor": area.colour, "fgopacity": 0.5}
        look["fillpattern"]["bgcolor"] = look["fillcolor"]
    outline: list[tuple[Array, Array]] = []
    for span in _spans(area.within):
        x = area.x[span]
        if area.ends is None:
            x, low, high = x[[0, -1]], np.zeros(2), np.ones(2)
        else:
            low, high = area.ends[0][span], area.ends[1][span]
        outline += [(_around(x, x), _around(low, high)), (_GAP_NODE, _GAP_NODE)]
    x, y = (np.concatenate([part[k] for part in outline[:-1]]) if outline else np.empty(0) for k in (0, 1))
    look |= {} if polar else {"yaxis": hidden if area.ends is None else yaxis}
    return scatter(
        x,
        y,
        polar=polar,
        fill="toself",
        line={"width": 0},
        name=area.name,
        showlegend=bool(area.name) and bool(outline),
        **look,
    )


def _spans(within: Mask) -> Iterator[slice]:
    """Nodes of the intervals in which a condition holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], within, [False]])))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield slice(int(begin), int(end))


def _around(low: Array, high: Array) -> Array:
    return np.concatenate([low, high[::-1], low[:1]])


def map_plot(panel: MapPanel, texts: Sequence[str], **more: Any) -> Plot:
    """Figure of a map, of which each point has a cell with its text at the pointer, grey without a value.

    The ``customdata`` of a cell are the number of its point; ``more`` are further keys of the layout.
    """
    (xs, i), (ys, j) = (np.unique(places, return_inverse=True) for places in panel.places)

    def cells(of_points: Any, kind: Any = float) -> NDArray[Any]:
        rows = np.full((ys.size, xs.size), None, dtype=kind)
        rows[j, i] = of_points
        return rows

    known = np.isfinite(panel.values)
    below = np.zeros_like(known) if panel.limit is None else panel.limit.margins < 1.0
    at: Plot = {"type": "heatmap", "x": values(xs, 12), "y": values(ys, 12)}
    grey = {"colorscale": [[0.0, MIDDLE_GREY], [1.0, MIDDLE_GREY]], "opacity": 0.35, "showscale": False}
    of_cells = {"text": cells(texts, object), "customdata": cells(np.arange(known.size), object)}
    about: Plot = {name: rows.tolist() for name, rows in of_cells.items()} | {"hovertemplate": _TEXT}
    shown = at | about | {"hoverongaps": False}
    traces: list[Plot] = [
        *([] if known.all() else [shown | grey | {"z": values(cells(np.where(known, np.nan, 1.0)))}]),
        *([shown | _coloured(panel, cells(panel.values))] if known.any() else []),
        # Lines of equal value between a few solved points would move with every further one.
        *(_contours(panel.between) if known.all() and not (panel.log or panel.levels) else []),
        *(line for level in panel.levels for line in _contours(panel.between, **_at(level))),
        *_limit_line(panel.limit),
    ]
    # A cell shows that a point is solved; marks of the side below the limit stand on the cells.
    marks = [mark for mark in panel.marks if mark.marker != "dots"]
    if below.any():
        name = "margin below 1: breakdown expected"
        x, y = panel.places[:, below]
        marks.append(Curve(name, x, y, "#ffffff", marker="triangle", size=panel.marks[0].size))
    traces += [_trace(mark, None, "y", converged=True) for mark in marks]
    axes: dict[str, Any] = {
        name: axis(
            plain(along.name, along.unit),
            zeroline=False,
            **log_ticks(log=along.log, ends=(float(nodes[0]), float(nodes[-1]))),
        )
        for name, along, nodes in zip(("xaxis", "yaxis"), panel.axes, (xs, ys), strict=True)
    }
    return plot(traces, height=_MAP, hovermode="closest", **axes, **more)


def _coloured(panel: MapPanel, cells: Array) -> Plot:
    """Keys of the coloured cells of a map, with their bar."""
    bar = {"title": {"text": plain(panel.title, panel.unit), "side": "right"}, "thickness": 14}
    if panel.log:
        ticks = log_ticks(log=True, ends=(float(np.nanmin(cells)), float(np.nanmax(cells))))
        bar |= {"tickvals": np.log10(ticks["tickvals"]).tolist(), "ticktext": ticks["ticktext"]}
    shown = values(np.log10(cells) if panel.log else cells)
    return {"z": shown, "colorscale": FILM_COLOURS, "colorbar": bar}


def _contours(mesh: Mesh | None, **more: Any) -> list[Plot]:
    """Lines of equal value of a mesh whose nodes are a grid, with their numbers; none of another mesh."""
    if mesh is None:
        return []
    xs, ys = np.unique(mesh.x), np.unique(mesh.y)
    if xs.size * ys.size != mesh.x.size:
        return []
    inside = np.isin(np.arange(mesh.x.size), mesh.triangles)
    rows = np.where(inside, mesh.values, np.nan).reshape(xs.size, ys.size).T
    i, j = kept_nodes(xs.size, _NODES), kept_nodes(ys.size, _NODES)
    look = {
        "contours": {"coloring": "none", "showlabels": True, "labelfont": _ON_MAP, "labelformat": ".4~g"},
        "line": {"color": "rgba(255,255,255,0.75)", "width": 1},
        "ncontours": 8,
        "connectgaps": False,
        "showlegend": False,
        "showscale": False,
        "hoverinfo": "skip",
    }
    at = {"type": "contour", "x": values(xs[i]), "y": values(ys[j]), "z": values(rows[np.ix_(j, i)], 5)}
    return [at | look | more]


def _at(level: float, **more: Any) -> Plot:
    """Keys of lines of one value only, with its number in per cent."""
    look = {"coloring": "none", "showlabels": True, "labelfont": _ON_MAP, "labelformat": ".0%"}
    return {"contours": look | {"start": level, "end": level, "size": 1.0} | more, "autocontour": False}


def _limit_line(limit: Limit | None) -> list[Plot]:
    """Line along which the margin is 1, red within white; none where the margin does not cross 1."""
    mesh = None if limit is None else limit.between
    if limit is None or mesh is None:
        return []
    # A hole of the map may lie between both sides.
    below = mesh.values[mesh.triangles] < 1.0
    if not np.any(np.any(below, axis=1) & ~np.all(below, axis=1)):
        return []
    # By logarithms, as margins are nearly powers of speed and load.
    log, line = replace(mesh, values=np.log10(mesh.values)), _at(0.0, showlabels=False)
    return [
        *_contours(log, **line, line={"color": "#ffffff", "width": 6}),
        *_contours(log, **line, line={"color": ORANGE, "width": 3}, showlegend=True, name=limit.line),
    ]


def names_of(panels: Sequence[Panel]) -> Iterator[str]:
    """Names of the quantities of panels, for a text that says what a figure shows."""
    for panel in panels:
        yield f"{panel.title} in {panel.unit}"
