"""Figures of a gear pair for its page: along the path of contact, on the flank, and over one pitch."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.app.charts.plotly_panels import FILM_COLOURS, Plot, axis, plot, scatter, stack, values
from ehlectric.figures.data import with_unit
from ehlectric.figures.gear_panels import (
    ENDS_OF_FLANK,
    LAST_COLOUR,
    PHASE_AXIS,
    film_panels,
    flank_lines,
    flank_map,
    mesh_panels,
    named_points,
    path_axis,
    path_panels,
    summit_text,
)
from ehlectric.gear import GearResult, weakest
from ehlectric.quantities.palette import ON_MAP, ORANGE, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for

# Rows and columns of the map that a page receives, and its height [px].
_ROWS, _COLUMNS, _HEIGHT = 90, 60, 430


def path_figure(result: GearResult) -> Plot:
    """Radii, speeds, line load and Hertzian pressure over the path of contact."""
    return _with_points(result, stack(path_axis(result), path_panels(result)))


def film_figure(result: GearResult) -> Plot:
    """Films, height of the highest summits and lambda ratio over the path of contact."""
    return _with_points(result, stack(path_axis(result), film_panels(result)))


def mesh_figure(result: GearResult) -> Plot:
    """Capacitance, breakdown voltage and time share of contact over a phase of the mesh."""
    return stack(PHASE_AXIS, mesh_panels(result))


def _with_points(result: GearResult, made: Plot) -> Plot:
    """Figure with the names of the points A to E above its panels, and each name once in its legend."""
    seen: set[str] = set()
    for trace in made["data"]:
        name = trace.get("name", "")
        trace["showlegend"] = bool(name) and name not in seen
        seen.add(name)
    look = {"yref": "paper", "y": 1.0, "yanchor": "bottom", "showarrow": False}
    letters = [{"x": place, "text": name, **look} for place, name in named_points(result)]
    legend = {"orientation": "h", "x": 0.0, "y": 1.06, "yanchor": "bottom"}
    made["layout"] |= {"annotations": letters, "legend": legend}
    return made


def flank_figure(result: GearResult) -> Plot:
    """Map of the minimum film on the flank of gear 1, with lines of contact and the smallest film."""
    g, y, films = flank_map(result)
    rows = np.linspace(0, g.size - 1, _ROWS).round().astype(int)
    columns = np.linspace(0, y.size - 1, _COLUMNS).round().astype(int)
    most = LAST_COLOUR * float(np.nanmin(films))
    factor, unit = unit_for(min(most, float(np.nanmax(films))), "m", least=1.0)
    shown = factor * films[np.ix_(rows, columns)]
    at: dict[str, Any] = {"x": values(1e3 * y[columns], 5), "y": values(1e3 * g[rows], 5)}
    place, across = weakest(result.solution)
    path, width = result.solution.path, result.solution.pair.face_width
    thinnest, level = factor * float(np.nanmin(films)), factor * result.solution.summits
    text = f"y = %{{x:,.4~r}} mm<br>g = %{{y:,.4~r}} mm<br>film %{{z:,.4~r}} {unit}<extra></extra>"
    heat = at | {
        "type": "heatmap",
        "z": values(shown, 4),
        "zmin": thinnest,
        "zmax": min(factor * most, float(np.nanmax(shown))),
        "colorscale": FILM_COLOURS,
        "colorbar": {"title": {"text": with_unit("minimum film", unit), "side": "right"}, "thickness": 14},
        "hovertemplate": text,
        "hoverongaps": False,
    }
    traces: list[Plot] = [heat]
    if thinnest < level < float(np.nanmax(shown)):
        contours = {"coloring": "none", "start": level, "end": level, "size": 1.0}
        look = {"color": "#ffffff", "width": 2, "dash": "dash"}
        traces.append(
            at
            | {
                "type": "contour",
                "z": values(shown, 4),
                "contours": contours,
                "autocontour": False,
                "line": look,
                "showscale": False,
                "hoverinfo": "skip",
                "name": f"film of {summit_text(result)}",
                "showlegend": True,
            }
        )
    lines = [np.array([[np.nan], [np.nan]])]
    for of_y, of_g in flank_lines(result):
        lines += [1e3 * np.array([of_y, of_g])[:, ::8], lines[0]]
    x, height = np.concatenate(lines[1:-1], axis=1)
    traces.append(
        scatter(x, height, line={"color": ON_MAP, "width": 2}, name="lines of contact at one phase")
    )
    cross = {"symbol": "x", "size": 11, "color": ORANGE, "line": {"color": ON_MAP, "width": 1}}
    traces.append(
        scatter(
            [1e3 * across],
            [1e3 * place],
            marker=cross,
            name="minimum film",
            cliponaxis=False,
            hover=f"minimum film {thinnest:.4g} {unit}",
        )
    )
    ends = [1e3 * path.start, 1e3 * path.end]
    return plot(
        traces,
        height=_HEIGHT,
        hovermode="closest",
        xaxis=axis("place y on the face width [mm]", zeroline=False, range=[0.0, 1e3 * width]),
        yaxis=axis("place g on the path of contact [mm]", zeroline=False, range=ends),
        plot_bgcolor=OUT_OF_RANGE if np.any(np.isnan(shown)) else "rgba(0,0,0,0)",
        annotations=[*_names(result)],
    )


def _names(result: GearResult) -> list[Plot]:
    """Names of the points A to E at the left edge of a map."""
    low, high = 1e3 * result.solution.path.start, 1e3 * result.solution.path.end
    look = {"xref": "paper", "x": 0.01, "xanchor": "left", "showarrow": False, "font": {"color": ON_MAP}}
    room = 0.04 * (high - low)
    return [
        {
            "y": min(max(place, low + room), high - room),
            "text": f"{name}, {ENDS_OF_FLANK[name]}" if name in ENDS_OF_FLANK else name,
            **look,
        }
        for place, name in named_points(result)
    ]
