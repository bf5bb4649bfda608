"""Figure of a drive and its remedies side by side: discharges per second with their bounds."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

from ehlectric.app.answers.bearing import Figure, Table
from ehlectric.app.figures.look import Plot, axis, plot
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive import findings
from ehlectric.figures.drive.looks import COLOURS, NAMES
from ehlectric.figures.drive.remedies import variants
from ehlectric.quantities.formats import number_text

# Height of a row, and of what surrounds the rows [px]; letters on a line of a name.
_ROW, _REST, _LETTERS = 62, 110, 16

# Distance of both bearings from the middle of their row.
_BESIDE = 0.14

# Ends at which a name is cut.
_MOST_LINES = 3


def remedies_figure(result: DriveResult) -> Figure:
    """Discharges per second of the drive as it is and with each remedy."""
    rows = list(variants(result))
    names = [_broken(name) for name, _ in rows]
    ends = [end for _, pair in rows for end in pair]
    known = [end[f"events_per_second{bound}"] for end in ends for bound in ("", "_low", "_high")]
    positive = [value for value in known if value > 0.0]
    low, high = 0.5 * min(positive), 2.0 * max(positive)
    data = [trace for b in range(2) for trace in _traces(rows, b)]
    layout: dict[str, Any] = {
        "xaxis": axis(
            "discharges per second",
            type="log",
            range=[math.log10(low), math.log10(high)],
            dtick=1,
            exponentformat="power",
        ),
        "yaxis": axis(
            tickmode="array",
            tickvals=list(range(len(names))),
            ticktext=names,
            range=[len(names) - 0.5, -0.5],
            ticks="",
        ),
        "hovermode": "closest",
    }
    table = Table(
        "Discharges per second with bounds of 95 %",
        ("", *(f"{name} [1/s]" for name in NAMES)),
        tuple((name, *(_cell(end) for end in pair)) for name, pair in rows),
    )
    found = findings.remedies(result)
    caption = f"{found}. Bars are bounds of 95 %; an open triangle is an upper bound without any discharge."
    return Figure(
        "Remedies side by side",
        f"Discharges per second of the drive as it is and with each remedy. {found}.",
        plot(data, height=_REST + _ROW * len(rows), **layout),
        table,
        caption,
    )


def _traces(rows: Sequence[tuple[str, Sequence[Mapping[str, Any]]]], b: int) -> list[Plot]:
    """Rates of one bearing with their bounds, and upper bounds where nothing discharged."""
    own = [(row, name, pair[b]) for row, (name, pair) in enumerate(rows)]
    with_events = [one for one in own if one[2]["events"]]
    without = [one for one in own if not one[2]["events"]]
    found = []
    if with_events:
        rates = [end["events_per_second"] for _, _, end in with_events]
        bars = {
            "type": "data",
            "symmetric": False,
            "array": [end["events_per_second_high"] - end["events_per_second"] for _, _, end in with_events],
            "arrayminus": [
                end["events_per_second"] - end["events_per_second_low"] for _, _, end in with_events
            ],
        }
        marker = {"symbol": ("circle", "square")[b], "size": 9}
        found.append(_trace(with_events, rates, b, marker) | {"error_x": bars})
    if without:
        highest = [end["events_per_second_high"] for _, _, end in without]
        marker = {"symbol": "triangle-left-open", "size": 10}
        found.append(_trace(without, highest, b, marker) | {"showlegend": not with_events})
    return found


def _trace(
    own: Sequence[tuple[int, str, Mapping[str, Any]]], rates: Sequence[float], b: int, marker: Plot
) -> Plot:
    return {
        "type": "scatter",
        "mode": "markers",
        "x": list(rates),
        "y": [row + (_BESIDE if b else -_BESIDE) for row, _, _ in own],
        "name": NAMES[b],
        "marker": {"color": COLOURS[b], **marker},
        "text": [f"{name}, {NAMES[b]}: {_cell(end)} per second" for _, name, end in own],
        "hovertemplate": "%{text}<extra></extra>",
    }


def _cell(end: Mapping[str, Any]) -> str:
    high = number_text(end["events_per_second_high"])
    if not end["events"]:
        return f"none, at most {high}"
    low = number_text(end["events_per_second_low"])
    return f"{number_text(end['events_per_second'])} ({low} to {high})"


def _broken(name: str) -> str:
    """Name on few short lines; texts of Plotly take some marks of HTML, which a title must not make."""
    plain = name.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return "<br>".join(textwrap.wrap(plain, _LETTERS, max_lines=_MOST_LINES, placeholder=" ..."))
