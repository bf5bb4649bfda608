"""Figure of a contact with moving roughness over time: minimum film, maximum field, breakdown voltage."""

from __future__ import annotations

import json
from collections.abc import Mapping

import numpy as np

from ehlectric.app.figures.look import Plot, plot, thinned
from ehlectric.app.figures.look import values as listed
from ehlectric.app.figures.motion import MARGIN, Unit, axis_name, stacked, units
from ehlectric.arrays import Array
from ehlectric.motion.asperities import TouchHistory
from ehlectric.motion.stored_run import MotionRun
from ehlectric.motion.summary import breakdown_voltages
from ehlectric.quantities.palette import AMBER, BLUE, GREEN, MIDDLE_GREY, ORANGE

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
