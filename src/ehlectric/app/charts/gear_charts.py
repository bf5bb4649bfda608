"""Figures of a gear pair for its page: along the path of contact, on the flank, and over one pitch."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.app.charts.plotly_panels import (
    FILM_COLOURS,
    INK,
    Plot,
    axis,
    kept_nodes,
    plot,
    scatter,
    stack,
    values,
)
from ehlectric.arrays import Array
from ehlectric.figures.data import Area, Curve, Panel, with_unit
from ehlectric.figures.gear_panels import (
    PHASE_AXIS,
    film_panels,
    flank_lines,
    flank_map,
    last_colour,
    mesh_panels,
    named_points,
    path_axis,
    path_panels,
    summit_text,
)
from ehlectric.gear import GearResult, weakest
from ehlectric.quantities.palette import ON_MAP, ORANGE, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Largest numbers of places g and y on a flank that a page receives.
_ROWS, _COLUMNS = 91, 61

# Distance of the places on a line of contact, in places of the map, and height of the map [px].
_STEP, _HEIGHT = 4, 560

# Largest number of nodes of a curve along the path of contact.
_NODES = 121


def path_figure(result: GearResult) -> Plot:
    """Radii, speeds, line load and Hertzian pressure over the path of contact."""
    return _with_points(result, stack(path_axis(result), _fewer(path_panels(result))))


def film_figure(result: GearResult) -> Plot:
    """Films, height of the highest summits and lambda ratio over the path of contact."""
    return _with_points(result, stack(path_axis(result), _fewer(film_panels(result))))


def mesh_figure(result: GearResult) -> Plot:
    """Capacitance, breakdown voltage and time share of contact over a phase of the mesh."""
    return stack(PHASE_AXIS, mesh_panels(result))


def _fewer(panels: Iterable[Panel]) -> list[Panel]:
    """Panels with at most as many evenly spaced nodes as a page shows: every step of a slider sends them."""
    return [
        replace(
            panel,
            curves=[_fewer_of_curve(curve) for curve in panel.curves],
            areas=[_fewer_of_area(area) for area in panel.areas],
        )
        for panel in panels
    ]


def _fewer_of_curve(curve: Curve) -> Curve:
    kept = kept_nodes(curve.x.size, _NODES)
    return replace(curve, x=curve.x[kept], y=curve.y[kept])


def _fewer_of_area(area: Area) -> Area:
    ends = area.ends
    kept = kept_nodes(area.x.size, _NODES)
    fewer = None if ends is None else (ends[0][kept], ends[1][kept])
    return replace(area, x=area.x[kept], within=area.within[kept], ends=fewer)


def _with_points(result: GearResult, made: Plot) -> Plot:
    """Figure with the names of the points A to E above its panels, and each name once in its legend, lines
    before areas.
    """
    seen: set[str] = set()
    for trace in made["data"]:
        name = trace.get("name", "")
        trace["showlegend"] = bool(name) and name not in seen
        trace["legendrank"] = 1001 if "fill" in trace else 1000
        seen.add(name)
    look = {"yref": "paper", "y": 1.0, "yanchor": "bottom", "showarrow": False}
    letters = [{"x": place, "text": name, **look} for place, name in named_points(result)]
    legend = {"orientation": "h", "x": 0.0, "y": 1.06, "yanchor": "bottom"}
    made["layout"] |= {"annotations": letters, "legend": legend}
    return made


def flank_figure(result: GearResult) -> Plot:
    """Map of the minimum film on the flank of gear 1, with lines of contact and the smallest film."""
    shown = _Flank.of(result)
    (place, across), path = weakest(result.solution), result.solution.path
    cross = {"symbol": "x", "size": 12, "color": ORANGE, "line": {"color": ON_MAP, "width": 1}}
    smallest = scatter(
        [1e3 * across],
        [1e3 * place],
        marker=cross,
        name="minimum film",
        yaxis="y2",
        cliponaxis=False,
        hover=f"minimum film {readable(shown.least)} {shown.unit}",
    )
    ends: Plot = {"range": [1e3 * path.start, 1e3 * path.end], "zeroline": False}
    places, names = zip(*named_points(result), strict=True)
    letters: Plot = {"overlaying": "y", "side": "right", "tickvals": list(places), "ticktext": list(names)}
    dots = {"color": ON_MAP, "width": 1, "dash": "dot"}
    return plot(
        [*shown.map(), *shown.limit(summit_text(result)), *_lines(result), smallest],
        height=_HEIGHT,
        hovermode="closest",
        xaxis=axis("place y on the face width [mm]", zeroline=False, range=[0.0, shown.width]),
        yaxis=axis("place g on the path of contact [mm]", **ends),
        yaxis2=axis(**ends, **letters, showgrid=False),
        shapes=[
            *shown.background(),
            *(
                {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": at, "y1": at, "line": dots}
                for at in places[1:-1]
            ),
        ],
    )


@dataclass(frozen=True)
class _Flank:
    """Map of films on a flank as a page receives it."""

    at: Plot  # places y and g of the pixels [mm]
    films: Array  # in ``unit``; NaN without a load
    unit: str
    least: float
    most: float  # film from which on the colour is the last one
    summits: float  # height of the highest summits
    width: float  # face width [mm]

    @classmethod
    def of(cls, result: GearResult) -> _Flank:
        """Map of a gear pair, with about every fourth of its places, and with the root and the tip."""
        g, y, films = flank_map(result)
        least, last = float(np.nanmin(films)), last_colour(films)
        factor, unit = unit_for(last, "m", least=1.0)
        rows, columns = (kept_nodes(at.size, most) for at, most in ((g, _ROWS), (y, _COLUMNS)))
        at = {"x": values(1e3 * y[columns], 5), "y": values(1e3 * g[rows], 5)}
        summits, width = factor * result.solution.summits, 1e3 * result.solution.pair.face_width
        films = factor * films[np.ix_(rows, columns)]
        return cls(at, films, unit, factor * least, factor * last, summits, width)

    def map(self) -> list[Plot]:
        """Colours of the films, and grey without a load."""
        place = "y = %{x:,.4~r} mm<br>g = %{y:,.4~r} mm"
        bar = {"title": {"text": with_unit("minimum film", self.unit), "side": "right"}}
        about: Plot = self.at | {"type": "heatmap", "hoverongaps": False}
        films = about | {
            "z": values(self.films, 3),
            "zmin": self.least,
            "zmax": self.most,
            "colorscale": FILM_COLOURS,
            "colorbar": bar | {"thickness": 14, "xpad": 30},
            "hovertemplate": f"{place}<br>film %{{z:,.4~r}} {self.unit}<extra></extra>",
        }
        if not self.unloaded:
            return [films]
        grey = {"color": OUT_OF_RANGE, "symbol": "square", "size": 12}
        return [films, scatter([np.nan], [np.nan], marker=grey, name="no load")]

    @property
    def unloaded(self) -> bool:
        """Whether parts of the flank carry no load."""
        return bool(np.isnan(self.films).any())

    def background(self) -> list[Plot]:
        """Grey behind the map, which is seen without a load."""
        whole = {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "yref": "paper", "y0": 0, "y1": 1}
        look = {"fillcolor": OUT_OF_RANGE, "line": {"width": 0}, "layer": "below"}
        return [whole | look] if self.unloaded else []

    def limit(self, name: str) -> list[Plot]:
        """Line on which the film has the height of the highest summits; none if it has it nowhere."""
        if not self.least < self.summits < float(np.nanmax(self.films)):
            return []
        dashed = {"color": INK, "width": 2, "dash": "dash"}
        contours = {"coloring": "none", "start": self.summits, "end": self.summits, "size": 1.0}
        line: Plot = self.at | {
            "type": "contour",
            "z": values(self.films, 3),
            "contours": contours,
            "autocontour": False,
            "showscale": False,
            "hoverinfo": "skip",
        }
        return [
            line | {"line": {"color": ON_MAP, "width": 5}, "showlegend": False},
            line | {"line": dashed, "name": f"film of {name}", "showlegend": True},
        ]


def _lines(result: GearResult) -> list[Plot]:
    """Lines of contact, light within grey, which is seen in the legend of a light page."""
    parts = [1e3 * np.array([y, g])[:, ::_STEP] for y, g in flank_lines(result)]
    gap = np.full((2, 1), np.nan)
    x, g = np.concatenate([piece for part in parts for piece in (part, gap)], axis=1)
    edge, light = ({"color": colour, "width": width} for colour, width in ((INK, 5), (ON_MAP, 2)))
    name = "lines of contact at one phase"
    return [scatter(x, g, line=edge, name=name), scatter(x, g, line=light, showlegend=False)]
