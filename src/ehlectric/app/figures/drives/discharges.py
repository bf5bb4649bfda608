"""Figures of the discharges of a drive: distributions of voltage, charge, energy and peak current."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ehlectric.app.answers.bearing import Figure, Table
from ehlectric.app.figures.look import Plot, axis, plot, values
from ehlectric.arrays import Array
from ehlectric.drive.result import DriveResult
from ehlectric.drive.summary import end_summary
from ehlectric.figures.drive import findings
from ehlectric.figures.drive.discharges import QUANTITIES, bins_of
from ehlectric.figures.drive.looks import COLOURS, NAMES, events_of, number_of_events
from ehlectric.quantities.drive_results import EVENT_KEYS, STATISTICS
from ehlectric.quantities.formats import formatted
from ehlectric.quantities.palette import BLUE, faint
from ehlectric.quantities.units import unit_for

# Quantities of a discharge by the names of their figures.
_FIGURES = {
    "discharge-voltage": "voltage",
    "discharge-energy": "energy",
    "discharge-charge": "charge",
    "discharge-current": "peak_current",
}

_HEIGHT = 300


def distributions(result: DriveResult) -> dict[str, Figure]:
    """Figures of the discharges by their names; none without a discharge."""
    if not len(result.solution.record.events):
        return {}
    return {name: _distribution(result, key) for name, key in _FIGURES.items()}


def _distribution(result: DriveResult, key: str) -> Figure:
    about, column = EVENT_KEYS[key], dict(QUANTITIES)[key]
    words = f"{about.label[:1].upper()}{about.label[1:]}"
    own = [np.abs(events_of(result, b)[:, column]) for b in range(2)]
    edges, log = bins_of(np.concatenate(own))
    factor, prefixed = unit_for(float(edges[-1]), about.unit, least=1.0)
    data = [_bars(factor * edges, part, factor, b, prefixed) for b, part in enumerate(own) if part.size]
    title = f"{about.label} [{prefixed}]"
    layout: dict[str, Any] = {
        "xaxis": axis(title, **(_decades() if log else {"range": [factor * edges[0], factor * edges[-1]]})),
        "yaxis": axis("discharges [%]", rangemode="tozero"),
        "hovermode": "x",
    }
    ends = [end_summary(result.solution, b) for b in range(2)]
    rows = [
        (name, *(_cell(end, f"{key}_{short}", factor, about.digits) for end in ends))
        for short, name in STATISTICS.items()
    ]
    caption = ", ".join(f"{NAMES[b]}: {number_of_events(result, b)} discharges" for b in range(2))
    lead = caption
    if key in ("energy", "charge", "peak_current"):
        line = findings.arc_line(result)
        caption = f"{caption}. {line[:1].upper()}{line[1:]}."
    heads = ("", *(f"{name} [{prefixed}]" for name in NAMES))
    return Figure(
        words,
        f"Distribution of the {about.label}; {lead}",
        plot(data, height=_HEIGHT, **layout),
        Table(words, heads, tuple(rows)),
        caption,
    )


def _cell(end: Mapping[str, Any], key: str, factor: float, digits: str) -> str:
    return formatted(factor * end[key], digits) if end["events"] else "none"


def _decades() -> Plot:
    ticks = [digit * 10.0**power for power in range(-6, 10) for digit in (1.0, 2.0, 5.0)]
    text = [f"{tick:.12g}" for tick in ticks]
    return {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": text}


def _bars(edges: Array, own: Array, factor: float, b: int, unit: str) -> Plot:
    """Share of the discharges in each bin, as steps."""
    counts, _ = np.histogram(np.clip(factor * own, edges[0], edges[-1]), edges)
    share = np.append(100.0 * counts / own.size, 0.0)
    fill = {"fill": "tozeroy", "fillcolor": faint(BLUE, 0.25)} if b == 0 else {}
    return {
        "type": "scatter",
        "mode": "lines",
        "x": values(edges, 5),
        "y": values(share, 4),
        "name": NAMES[b],
        "line": {"color": COLOURS[b], "width": 2.0, "shape": "hv", "dash": ("solid", "dash")[b]},
        "hovertemplate": f"%{{y:.3g}} % from %{{x:.4g}} {unit}<extra>{NAMES[b]}</extra>",
        **fill,
    }
