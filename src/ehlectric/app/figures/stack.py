"""Curves over one position in panels above each other, which share the axis along which they are zoomed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from ehlectric.app.figures.look import GREY, Plot, axis, plot, values, vertical

# Height of a panel, and gap between panels as a part of the height of the figure [px].
_PANEL, _GAP = 190, 0.05

# Text before the signs of the axes; Plotly numbers axes from the second on.
_AXES = ("y", "y2", "y3", "y4")


@dataclass(frozen=True)
class Curve:
    """Curve of a panel.

    Attributes
    ----------
    name : str
        Name in the legend and beside the pointer.
    x, y : ndarray, shape (n,)
        Positions and values, in shown units.
    colour, dash : str
        Look of the line.
    width : float
        Width of the line [px].
    mark : bool
        Whether it is a single marked point, with its value as text.
    dots : bool
        Whether it is many points without a line.
    """

    name: str
    x: NDArray[Any]
    y: NDArray[Any]
    colour: str
    dash: str = "solid"
    width: float = 2.0
    mark: bool = False
    dots: bool = False


@dataclass(frozen=True)
class Panel:
    """Panel of a figure.

    Attributes
    ----------
    title, unit : str
        Quantity of its axis, and its unit.
    curves : sequence of Curve
        Curves.
    top, bottom : float
        Ends of its axis at first.
    """

    title: str
    unit: str
    curves: Sequence[Curve] = field(repr=False)
    top: float
    bottom: float = 0.0


@dataclass(frozen=True)
class Along:
    """Axis that all panels share.

    Attributes
    ----------
    name, unit : str
        Name and unit of the position.
    window : tuple of float
        Range that is shown at first.
    edges : tuple of float
        Places of dashed lines, such as the edges of the dry contact.
    """

    name: str
    unit: str
    window: tuple[float, float]
    edges: tuple[float, ...] = ()


def stack(along: Along, panels: Sequence[Panel], *, converged: bool = True) -> Plot:
    """Figure with panels above each other.

    Parameters
    ----------
    along : Along
        Axis of all panels.
    panels : sequence of Panel
        Panels from above, at most four.
    converged : bool
        Whether the result converged; if not, all curves are grey, and words across the figure say so.

    Returns
    -------
    dict
        Figure of Plotly, in which the pointer shows the values of all panels at one position.
    """
    layout: dict[str, Any] = {
        "xaxis": axis(
            f"{along.name} [{along.unit}]",
            range=list(along.window),
            anchor=_AXES[len(panels) - 1],
            unifiedhovertitle={"text": f"{along.name} = %{{x:.5g}} {along.unit}"},
        ),
        "hovermode": "x unified",
        "hoversubplots": "axis",
        "hoverdistance": 30,
        "shapes": [vertical(edge, layer="below") for edge in along.edges],
    }
    share = (1.0 - _GAP * (len(panels) - 1)) / len(panels)
    for number, panel in enumerate(panels):
        top = 1.0 - number * (share + _GAP)
        title = f"{panel.title}<br>[{panel.unit}]"
        ends = {"domain": [max(0.0, top - share), top], "range": [panel.bottom, panel.top], "anchor": "x"}
        layout["yaxis" + _AXES[number][1:]] = axis(title, **ends)
    data = [
        _trace(curve, panel, _AXES[number], converged=converged)
        for number, panel in enumerate(panels)
        for curve in panel.curves
    ]
    return plot(data, height=_PANEL * len(panels) + 110, converged=converged, **layout)


def _trace(curve: Curve, panel: Panel, axis_name: str, *, converged: bool) -> dict[str, Any]:
    colour = curve.colour if converged else GREY
    trace: dict[str, Any] = {
        "type": "scatter",
        "x": values(curve.x),
        "y": values(curve.y),
        "yaxis": axis_name,
    }
    trace["name"] = curve.name
    if curve.mark:
        marker = {"color": "rgba(0,0,0,0)", "size": 9, "line": {"color": colour, "width": 2}}
        return trace | {"mode": "markers", "marker": marker, "hoverinfo": "skip"}
    if curve.dots:
        return trace | {"mode": "markers", "marker": {"color": colour, "size": 4}, "hoverinfo": "skip"}
    trace |= {"mode": "lines", "line": {"color": colour, "dash": curve.dash, "width": curve.width}}
    return trace | {"hovertemplate": f"%{{y:.4g}} {panel.unit}<extra>{curve.name}</extra>"}


def names_of(panels: Sequence[Panel]) -> Iterator[str]:
    """Names of the quantities of panels, for a text that says what a figure shows."""
    for panel in panels:
        yield f"{panel.title} in {panel.unit}"
