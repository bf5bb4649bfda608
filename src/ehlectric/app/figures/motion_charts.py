"""Figures of a contact with moving roughness for a page: its instants as a movie, and its curve over time."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

import numpy as np

from ehlectric.app.figures.charts import Plot, kept_nodes, plot, thinned
from ehlectric.app.figures.charts import axis as plot_axis
from ehlectric.app.figures.charts import values as listed
from ehlectric.arrays import Array, IntArray
from ehlectric.contact.conditions import PointConditions
from ehlectric.motion.motion_touching import TouchHistory
from ehlectric.motion.stored_run import MotionRun
from ehlectric.motion.summary import breakdown_voltages
from ehlectric.quantities.palette import AMBER, BLUE, GREEN, MIDDLE_GREY, ORANGE
from ehlectric.quantities.units import unit_for

# Largest number of pieces of a line over time, each drawn by its lowest and its highest point.
_PIECES = 1000

# Largest number of pieces of the recorded instants.
_MOST_DOTS = 150

# Height of a panel and of what surrounds them [px].
_PANEL, _REST = 130, 60


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
        look = {"yaxis": axis_name(number)}
        traces.append(look | _over_time(name, colour, suited, time, values, unit))
        if solved is not None:
            traces.append(look | _dots(name, colour, suited, recorded[0], solved, unit))
        titles.append(f"{name}<br>[{suited[1]}]")
    halved = np.flatnonzero(run.values("halvings"))
    if halved.size:
        traces.append(_halved(time[halved], of["film"][0] * film[halved], unit))
    return plot(
        traces,
        height=_PANEL * len(lines) + _REST,
        margin=MARGIN,
        shapes=[_present(0.0), *_stationary(run, of)],
        showlegend=bool(halved.size),
        hovermode="closest",
        **stacked(titles, f"time [{unit}]"),
    )


def _dots(name: str, colour: str, unit: Unit, time: Array, values: Array, of_time: str) -> Plot:
    chosen = thinned([values], _MOST_DOTS)
    return {
        "type": "scatter",
        "mode": "markers",
        "name": f"{name}, recorded",
        "x": listed(time[chosen], 6),
        "y": listed(unit[0] * values[chosen], 5),
        "marker": {"color": colour, "size": 5},
        "hovertemplate": f"{name} %{{y:.4g}} {unit[1]}, solved<br>t = %{{x:.4g}} {of_time}<extra></extra>",
        "showlegend": False,
    }


def _over_time(name: str, colour: str, unit: Unit, time: Array, values: Array, of_time: str) -> Plot:
    chosen = thinned([values], _PIECES)
    return {
        "type": "scatter",
        "mode": "lines",
        "name": name,
        "x": listed(time[chosen], 6),
        "y": listed(unit[0] * values[chosen], 5),
        "line": {"color": colour, "width": 1.5},
        "hovertemplate": f"{name} %{{y:.4g}} {unit[1]}<br>t = %{{x:.4g}} {of_time}<extra></extra>",
        "showlegend": False,
    }


def _halved(time: Array, film: Array, unit: str) -> Plot:
    chosen = thinned([film], _PIECES)
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "time step not converged at once, and halved",
        "x": listed(time[chosen], 6),
        "y": listed(film[chosen], 5),
        "marker": {"color": MIDDLE_GREY, "symbol": "x", "size": 7},
        "hovertemplate": f"time step halved, t = %{{x:.4g}} {unit}<extra></extra>",
    }


def _present(time: float) -> Plot:
    """Line of the present time over all panels."""
    return {
        "type": "line",
        "x0": time,
        "x1": time,
        "y0": 0,
        "y1": 1,
        "yref": "paper",
        "line": {"color": AMBER, "width": 2},
    }


def _stationary(run: MotionRun, of: Mapping[str, Unit]) -> list[Plot]:
    """Lines of the film and the field of stationary roughness; none where they are not converged."""
    still = json.loads(run.dataset.attrs["stationary"])
    if still is None:
        return []
    values = (
        ("y", of["film"][0] * still["minimum_thickness"]),
        ("y2", of["field"][0] * still["max_strength"]),
    )
    return [
        {
            "type": "line",
            "x0": 0,
            "x1": 1,
            "xref": "paper",
            "y0": value,
            "y1": value,
            "yref": axis,
            "line": {"color": MIDDLE_GREY, "width": 1, "dash": "dash"},
        }
        for axis, value in values
    ]


# Largest number of instants and of nodes along a line that a page receives, and bounds of the size of all
# instants: numbers, of some characters each.
MOST_INSTANTS, MOST_INSTANTS_OF_MAPS, _MOST_NODES = 201, 101, 600
_LINE_NUMBERS, _MAP_NUMBERS = 280_000, 320_000

# Range of x of a line contact [half-widths], as in the figures of the command.
_BEFORE, _BEHIND = -2.0, 1.5

# Range of a map around the ellipse of Hertz [semi-axes].
_AROUND = 1.5

# Heights of the figures and their margins [px].
_LINE_HEIGHT, _MAP_HEIGHT = 520, 460
MARGIN = {"l": 8, "r": 8, "t": 8, "b": 8}

Unit = tuple[float, str]


def instants(run: MotionRun) -> IntArray:
    """Recorded instants that the movie shows: with those of the thinnest film and of the largest field."""
    most = MOST_INSTANTS if run.kind.name == "line" else MOST_INSTANTS_OF_MAPS
    always = int(np.argmin(least_films(run))), int(np.argmax(run.values("max_strength")))
    return kept_nodes(run.frames, most, always)


def least_films(run: MotionRun) -> Array:
    """Minimum film thickness at the recorded instants, shape (frames,) [m]."""
    found: Array = run.values("minimum_thickness")[_steps(run)]
    return found


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
    found = []
    for frame in chosen.tolist():
        parts = [
            f"minimum film {_told(films[frame], of['film'])}",
            f"maximum field {_told(fields[frame], of['field'])}",
        ]
        if voltages is not None:
            parts.append(f"breakdown voltage {voltages[frame]:.4g} V")
        found.append(f"t = {_told(run.frame_time[frame], of['time'])}: {', '.join(parts)}")
    return found


def movie(run: MotionRun, chosen: IntArray) -> Plot:
    """Figure of the first chosen instant, with a frame for every one.

    A line contact shows film, pressure and field over x, a point contact the map of its film. Values are
    those of motion.nc at every n-th node. The minimum film and the maximum field are marked where they are,
    also between these nodes.
    """
    make = _line_movie if run.kind.name == "line" else _map_movie
    return make(run, chosen, units(run))


def axis_name(number: int, stem: str = "y") -> str:
    """Name of the y axis of a panel, counted from 0."""
    return f"{stem}{number + 1}" if number else stem


def _steps(run: MotionRun) -> Array:
    return np.asarray(run.values("frame_step"), dtype=int)


def _told(value: float, unit: Unit) -> str:
    return f"{unit[0] * value:.4g} {unit[1]}"


def stacked(titles: Sequence[str], along: str) -> Plot:
    """Axes of panels one above the other with the same x axis, as keys of a layout."""
    gap, count = 0.05, len(titles)
    each = (1.0 - gap * (count - 1)) / count
    layout = {"xaxis": plot_axis(along, anchor=axis_name(count - 1), zeroline=False)}
    for number, title in enumerate(titles):
        top = 1.0 - number * (each + gap)
        layout[axis_name(number, "yaxis")] = plot_axis(
            title, domain=[max(0.0, top - each), top], zeroline=False
        )
    return layout


def nodes_shown(run: MotionRun, frames: int) -> tuple[IntArray, ...]:
    """Indices of the nodes that the movie shows, along each axis."""
    axes = [run.values(axis) for axis in run.kind.axes]
    if len(axes) == 1:
        at = np.flatnonzero((run.x >= _BEFORE) & (run.x <= _BEHIND))
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
    x = listed(along * run.values("x")[nodes], 5)
    panels = (
        ("thickness", "film", "film thickness h", BLUE),
        ("pressure", "pressure", "pressure p", GREEN),
        ("strength", "field", "field |E|", ORANGE),
    )
    values = [of[unit][0] * run.values(name)[chosen][:, nodes] for name, unit, _, _ in panels]
    traces = [
        {
            "type": "scatter",
            "mode": "lines",
            "name": label,
            "x": x,
            "y": listed(rows[0], 4),
            "yaxis": axis_name(number),
            "line": {"color": colour, "width": 1.5},
            "hovertemplate": f"{label} = %{{y}} {of[unit][1]}<br>x = %{{x}} {length}<extra></extra>",
        }
        for number, ((_, unit, label, colour), rows) in enumerate(zip(panels, values, strict=True))
    ]
    marks = [_mark("minimum film", "y", BLUE, "triangle-up"), _mark("maximum field", "y3", ORANGE, "diamond")]
    places = [_marked(run, frame, of) for frame in chosen.tolist()]
    frames = [
        {
            "name": str(number),
            "data": [*({"y": listed(rows[number], 4)} for rows in values), *places[number]],
            "traces": [0, 1, 2, 3, 4],
        }
        for number in range(chosen.size)
    ]
    titles = [f"{label}<br>[{of[unit][1]}]" for _, unit, label, _ in panels]
    layout = stacked(titles, f"x along entrainment [{length}]")
    inside = np.abs(run.x[nodes]) <= 1.0
    for number, rows in enumerate(values):
        most = float(np.nanmax(rows[:, inside] if np.any(inside) else rows))
        layout[axis_name(number, "yaxis")]["range"] = [0.0, 1.15 * most]
    data = [*traces, *(mark | place for mark, place in zip(marks, places[0], strict=True))]
    drawn = plot(data, height=_LINE_HEIGHT, margin=MARGIN, showlegend=False, **layout)
    return drawn | {"frames": frames}


def _mark(name: str, axis: str, colour: str, symbol: str) -> Plot:
    return {
        "type": "scatter",
        "mode": "markers",
        "name": name,
        "yaxis": axis,
        "marker": {"color": colour, "size": 9, "symbol": symbol, "line": {"color": "#ffffff", "width": 1}},
        "hovertemplate": f"{name} %{{y:.4g}}<extra></extra>",
    }


def _marked(run: MotionRun, frame: int, of: Mapping[str, Unit]) -> list[Plot]:
    """Places of the minimum film and of the maximum field at an instant, exact."""
    along, step = of["place"][0], int(_steps(run)[frame])
    thin, strong = run.values("minimum_x")[step], run.values("max_strength_x")[frame]
    return [
        {"x": listed(np.array([along * thin]), 5),
         "y": listed(np.array([of["film"][0] * least_films(run)[frame]]), 5)},
        {"x": listed(np.array([along * strong]), 5),
         "y": listed(np.array([of["field"][0] * run.values("max_strength")[frame]]), 5)},
    ]  # fmt: skip


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
        "colorscale": "Viridis",
        "colorbar": {"title": {"text": f"film thickness h [{unit}]", "side": "right"}, "thickness": 12},
        "hovertemplate": f"h = %{{z}} {unit}<br>x = %{{x}} {length}<br>y = %{{y}} {length}<extra></extra>",
    }
    marks = [
        _mark("minimum film", "y", "#ffffff", "triangle-up"),
        _mark("maximum field", "y", ORANGE, "diamond"),
    ]
    for mark in marks:
        mark["marker"]["line"] = {"color": "#000000", "width": 1}
        mark["hovertemplate"] = f"{mark['name']}<extra></extra>"
    places = [_marked_in_plane(run, frame, along) for frame in chosen.tolist()]
    frames = [
        {
            "name": str(number),
            "data": [{"z": listed(film.T, 3)}, *places[number]],
            "traces": [0, 1, 2],
        }
        for number, film in enumerate(films)
    ]
    circle = {"type": "circle", "x0": -a, "x1": a, "y0": -b, "y1": b}
    data = [trace, *(mark | place for mark, place in zip(marks, places[0], strict=True))]
    drawn = plot(
        data,
        height=_MAP_HEIGHT,
        margin=MARGIN,
        showlegend=False,
        xaxis=plot_axis(f"x along entrainment [{length}]", constrain="domain", zeroline=False),
        yaxis=plot_axis(f"y [{length}]", constrain="domain", zeroline=False, scaleanchor="x"),
        shapes=[circle | {"line": {"color": "#ffffff", "width": 1, "dash": "dot"}}],
    )
    return drawn | {"frames": frames}


def _marked_in_plane(run: MotionRun, frame: int, along: float) -> list[Plot]:
    step = int(_steps(run)[frame])
    places = (("minimum", step), ("max_strength", frame))
    return [
        {axis: listed(np.array([along * run.values(f"{name}_{axis}")[at]]), 5) for axis in "xy"}
        for name, at in places
    ]
