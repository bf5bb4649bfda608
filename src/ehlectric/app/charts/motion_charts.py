"""Figures of a contact with moving roughness for a page: its instants as a movie, and its curve over time."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ehlectric.app.charts.plotly_panels import (
    FILM_COLOURS,
    NARROW,
    Plot,
    axis_name,
    domains,
    kept_nodes,
    plot,
    scatter,
    thinned,
    vertical,
)
from ehlectric.app.charts.plotly_panels import axis as plot_axis
from ehlectric.app.charts.plotly_panels import values as listed
from ehlectric.arrays import Array, IntArray
from ehlectric.contact import PointConditions
from ehlectric.figures.contact_profiles import BEFORE, BEHIND
from ehlectric.motion.motion_touching import TouchHistory
from ehlectric.motion.stored_run import MotionRun
from ehlectric.motion.summary import breakdown_voltages
from ehlectric.quantities.palette import AMBER, BLUE, GREEN, MIDDLE_GREY, ORANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Largest number of pieces of a line over time, each drawn by its lowest and its highest point.
_PIECES = 1000

# Largest number of pieces of the recorded instants.
_MOST_DOTS = 150

# Largest number of instants and of nodes along a line that a page receives, and bounds of the size of all
# instants: numbers, of some characters each.
MOST_INSTANTS, MOST_INSTANTS_OF_MAPS, _MOST_NODES = 201, 101, 600
_LINE_NUMBERS, _MAP_NUMBERS = 280_000, 320_000

# Range of a map around the ellipse of Hertz [semi-axes].
_AROUND = 1.5

# Height of a panel of the history, of what surrounds the panels, and of both kinds of movies [px].
_PANEL, _REST, _LINE_HEIGHT, _MAP_HEIGHT = 130, 60, 520, 460

Unit = tuple[float, str]


def history(run: MotionRun) -> Plot:
    """Figure of minimum film, maximum field, breakdown voltage and load share of asperities over time.

    The field is solved at the recorded instants, which are dots. Between them it follows from the minimum
    film at every time step, as in the summary. Time steps that did not converge and were halved are marked.
    The first shape is the line of the present time.
    """
    of = units(run)
    factor, unit = of["time"]
    voltages, field = breakdown_voltages(run), run.field_history
    time, film = factor * run.values("time"), run.values("minimum_thickness")
    recorded = factor * run.frame_time, run.values("max_strength")
    # Name, colour, unit, values at every time step, and values at the recorded instants.
    lines = [
        ("minimum film", BLUE, of["film"], film, None),
        ("maximum field", ORANGE, of["field"], field.strength, recorded[1]),
    ]
    if voltages is not None:
        # Breakdown voltage and maximum field are inversely proportional.
        between = voltages[0] * recorded[1][0] / field.strength
        lines.append(("breakdown voltage", GREEN, (1.0, "V"), between, voltages))
    touching = TouchHistory.of(run)
    if touching is not None:
        lines.append(("load share of asperities", AMBER, (100.0, "%"), touching.load_share, None))
    traces, titles = [], []
    for number, (name, colour, suited, values, solved) in enumerate(lines):
        drawn = _over_time(name, suited, (time, values), unit, line={"color": colour, "width": 1.5})
        traces.append(drawn | {"yaxis": axis_name(number)})
        if solved is not None:
            dots = _over_time(name, suited, (recorded[0], solved), unit, marker={"color": colour, "size": 5})
            traces.append(dots | {"yaxis": axis_name(number)})
        titles.append(f"{name}<br>[{suited[1]}]")
    halved = np.flatnonzero(run.values("halvings"))
    if halved.size:
        kept = halved[thinned([film[halved]], _PIECES)]
        traces.append(
            scatter(
                time[kept],
                of["film"][0] * film[kept],
                digits=(6, 5),
                hover=f"time step halved, t = %{{x:,.4~r}} {unit}",
                name="time step not converged at once, and halved",
                marker={"color": MIDDLE_GREY, "symbol": "x", "size": 7},
            )
        )
    return plot(
        traces,
        height=_PANEL * len(lines) + _REST,
        margin=NARROW,
        shapes=[vertical(0.0, line={"color": AMBER, "width": 2}), *_stationary(run, of)],
        showlegend=bool(halved.size),
        hovermode="closest",
        **_stacked(titles, f"time [{unit}]"),
    )


def _over_time(name: str, unit: Unit, curve: tuple[Array, Array], of_time: str, **look: Any) -> Plot:
    """Line over time, or dots at the recorded instants, at which the field was solved."""
    dots = "marker" in look
    chosen = thinned(curve[1:], _MOST_DOTS if dots else _PIECES)
    solved = ", solved" if dots else ""
    return scatter(
        curve[0][chosen],
        unit[0] * curve[1][chosen],
        digits=(6, 5),
        hover=f"{name} %{{y:,.4~r}} {unit[1]}{solved}<br>t = %{{x:,.4~r}} {of_time}",
        name=f"{name}, recorded" if dots else name,
        showlegend=False,
        **look,
    )


def _stationary(run: MotionRun, of: Mapping[str, Unit]) -> list[Plot]:
    """Lines of the film and the field of stationary roughness; none where they are not converged."""
    still = json.loads(run.dataset.attrs["stationary"])
    if still is None:
        return []
    look = {"color": MIDDLE_GREY, "width": 1, "dash": "dash"}
    values = {
        "y": of["film"][0] * still["minimum_thickness"],
        "y2": of["field"][0] * still["max_strength"],
    }
    return [
        {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "yref": axis, "y0": at, "y1": at, "line": look}
        for axis, at in values.items()
    ]


def instants(run: MotionRun) -> IntArray:
    """Recorded instants that the movie shows, with the thinnest film and with the largest field."""
    most = MOST_INSTANTS if run.kind.name == "line" else MOST_INSTANTS_OF_MAPS
    always = int(np.argmin(least_films(run))), int(np.argmax(run.values("max_strength")))
    return kept_nodes(run.frames, most, always)


def least_films(run: MotionRun) -> Array:
    """Minimum film thickness at the recorded instants, shape (frames,) [m]."""
    films: Array = run.values("minimum_thickness")[_steps(run)]
    return films


def units(run: MotionRun) -> dict[str, Unit]:
    """Factors and units of time, film, field and pressure."""
    least = 0.1 if run.kind.name == "line" else 1.0
    return {
        "time": unit_for(float(run.values("time")[-1]), "s"),
        "film": unit_for(float(run.values("minimum_thickness")[0]), "m", least=least),
        "field": unit_for(float(np.max(run.values("max_strength"))), "V/m"),
        "pressure": unit_for(float(np.max(run.values("max_pressure"))), "Pa"),
        "place": unit_for(run.conditions.half_width, "m", least=1.0),
    }


def texts(run: MotionRun, chosen: IntArray) -> list[str]:
    """Sentence about every chosen instant: its time, minimum film, maximum field and breakdown voltage."""
    of, voltages = units(run), breakdown_voltages(run)
    films, fields = least_films(run), run.values("max_strength")
    sentences = []
    for frame in chosen.tolist():
        parts = [
            f"minimum film {_amount(films[frame], of['film'])}",
            f"maximum field {_amount(fields[frame], of['field'])}",
        ]
        if voltages is not None:
            parts.append(f"breakdown voltage {readable(voltages[frame], 4)} V")
        sentences.append(f"t = {_amount(run.frame_time[frame], of['time'])}: {', '.join(parts)}")
    return sentences


def movie(run: MotionRun, chosen: IntArray) -> Plot:
    """Figure of the first chosen instant, with a frame for every one.

    A line contact shows film, pressure and field over x, a point contact the map of its film. Values are
    taken from motion.nc at every n-th node. The minimum film and the maximum field are marked where they are,
    also between these nodes.
    """
    make = _line_movie if run.kind.name == "line" else _map_movie
    return make(run, chosen, units(run))


def _steps(run: MotionRun) -> Array:
    return np.asarray(run.values("frame_step"), dtype=int)


def _amount(value: float, unit: Unit) -> str:
    return f"{readable(unit[0] * value, 4)} {unit[1]}"


def _stacked(titles: Sequence[str], along: str) -> Plot:
    """Axes of panels one above the other with the same x axis, as keys of a layout."""
    layout = {"xaxis": plot_axis(along, anchor=axis_name(len(titles) - 1), zeroline=False)}
    for number, (title, domain) in enumerate(zip(titles, domains(len(titles)), strict=True)):
        layout[axis_name(number, "yaxis")] = plot_axis(title, domain=domain, zeroline=False)
    return layout


def nodes_shown(run: MotionRun, frames: int) -> tuple[IntArray, ...]:
    """Indices of the nodes that the movie shows, along each axis."""
    axes = [run.values(axis) for axis in run.kind.axes]
    if len(axes) == 1:
        at = np.flatnonzero((run.x >= BEFORE) & (run.x <= BEHIND))
        most = min(_MOST_NODES, _LINE_NUMBERS // (3 * frames))
        return (at[:: -(-at.size // most)],)
    conditions = run.conditions
    assert isinstance(conditions, PointConditions)
    semi_axes = conditions.semi_axis_x, conditions.semi_axis_y
    windows = [
        np.flatnonzero(np.abs(axis) <= _AROUND * half) for axis, half in zip(axes, semi_axes, strict=True)
    ]
    most = int(np.sqrt(_MAP_NUMBERS / frames))
    return tuple(at[:: -(-at.size // most)] for at in windows)


def _line_movie(run: MotionRun, chosen: IntArray, of: Mapping[str, Unit]) -> Plot:
    (nodes,) = nodes_shown(run, chosen.size)
    along, length = of["place"]
    x = along * run.values("x")[nodes]
    panels = (
        ("thickness", "film", "film thickness h", BLUE),
        ("pressure", "pressure", "pressure p", GREEN),
        ("strength", "field", "field |E|", ORANGE),
    )
    values = [of[unit][0] * run.values(name)[chosen][:, nodes] for name, unit, _, _ in panels]
    traces = [
        scatter(
            x,
            rows[0],
            digits=(5, 4),
            hover=f"{label} = %{{y}} {of[unit][1]}<br>x = %{{x}} {length}",
            name=label,
            yaxis=axis_name(number),
            line={"color": colour, "width": 1.5},
        )
        for number, ((_, unit, label, colour), rows) in enumerate(zip(panels, values, strict=True))
    ]
    marks = _marks(BLUE, "#ffffff", " %{y:,.4~r}")
    marks[1]["yaxis"] = "y3"
    places = [_marked(run, frame, of) for frame in chosen.tolist()]
    frames = _frames([[{"y": listed(row, 4)} for row in rows] for rows in zip(*values, strict=True)], places)
    titles = [f"{label}<br>[{of[unit][1]}]" for _, unit, label, _ in panels]
    layout = _stacked(titles, f"x along entrainment [{length}]")
    inside = np.abs(run.x[nodes]) <= 1.0
    for number, rows in enumerate(values):
        most = float(np.nanmax(rows[:, inside] if np.any(inside) else rows))
        layout[axis_name(number, "yaxis")]["range"] = [0.0, 1.15 * most]
    data = [*traces, *(mark | place for mark, place in zip(marks, places[0], strict=True))]
    drawn = plot(data, height=_LINE_HEIGHT, margin=NARROW, showlegend=False, **layout)
    return drawn | {"frames": frames}


def _frames(pictures: Sequence[list[Plot]], places: Sequence[list[Plot]]) -> list[Plot]:
    """Frames of a movie: what changes of its traces, and the places of its marks, at each instant."""
    frames = [[*picture, *at] for picture, at in zip(pictures, places, strict=True)]
    return [
        {"name": str(number), "data": data, "traces": list(range(len(data)))}
        for number, data in enumerate(frames)
    ]


def _marks(colour: str, edge: str, value: str = "") -> list[Plot]:
    """Marks of the minimum film, of a colour, and of the maximum field, without their places."""
    looks = (("minimum film", colour, "triangle-up"), ("maximum field", ORANGE, "diamond"))
    return [
        {
            "type": "scatter",
            "mode": "markers",
            "name": name,
            "yaxis": "y",
            "marker": {"color": fill, "size": 9, "symbol": symbol, "line": {"color": edge, "width": 1}},
            "hovertemplate": f"{name}{value}<extra></extra>",
        }
        for name, fill, symbol in looks
    ]


def _marked(run: MotionRun, frame: int, of: Mapping[str, Unit]) -> list[Plot]:
    """Exact places of the minimum film and of the maximum field at an instant."""
    along = of["place"][0]
    extremes = (
        ("minimum", int(_steps(run)[frame]), of["film"][0] * least_films(run)[frame]),
        ("max_strength", frame, of["field"][0] * run.values("max_strength")[frame]),
    )
    places = []
    for name, at, value in extremes:
        numbers = {axis: along * run.values(f"{name}_{axis}")[at] for axis in run.kind.axes}
        places.append({axis: listed([number], 5) for axis, number in ({"y": value} | numbers).items()})
    return places


def _map_movie(run: MotionRun, chosen: IntArray, of: Mapping[str, Unit]) -> Plot:
    along, length = of["place"]
    factor, unit = of["film"]
    nodes = nodes_shown(run, chosen.size)
    x, y = (along * run.values(axis)[at] for axis, at in zip("xy", nodes, strict=True))
    films = factor * run.values("thickness")[chosen][:, nodes[0]][:, :, nodes[1]]
    conditions = run.conditions
    assert isinstance(conditions, PointConditions)
    a, b = along * conditions.semi_axis_x, along * conditions.semi_axis_y
    inside = films[:, (x[:, np.newaxis] / a) ** 2 + (y / b) ** 2 <= 1.0]
    trace = {
        "type": "heatmap",
        "x": listed(x, 5),
        "y": listed(y, 5),
        "z": listed(films[0].T, 3),
        "zmin": float(np.min(films)),
        "zmax": float(np.percentile(inside, 95.0)),
        "colorscale": FILM_COLOURS,
        "colorbar": {"title": {"text": f"film thickness h [{unit}]", "side": "right"}, "thickness": 12},
        "hovertemplate": f"h = %{{z}} {unit}<br>x = %{{x}} {length}<br>y = %{{y}} {length}<extra></extra>",
    }
    marks = _marks("#ffffff", "#000000")
    places = [_marked(run, frame, of) for frame in chosen.tolist()]
    frames = _frames([[{"z": listed(film.T, 3)}] for film in films], places)
    circle = {"type": "circle", "x0": -a, "x1": a, "y0": -b, "y1": b}
    data = [trace, *(mark | place for mark, place in zip(marks, places[0], strict=True))]
    drawn = plot(
        data,
        height=_MAP_HEIGHT,
        margin=NARROW,
        showlegend=False,
        xaxis=plot_axis(f"x along entrainment [{length}]", constrain="domain", zeroline=False),
        yaxis=plot_axis(f"y [{length}]", constrain="domain", zeroline=False, scaleanchor="x"),
        shapes=[circle | {"line": {"color": "#ffffff", "width": 1, "dash": "dot"}}],
    )
    return drawn | {"frames": frames}
