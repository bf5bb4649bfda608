"""Figures of a calibration for a page: ranges of the inputs before and after, and measured next to computed
values.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ehlectric.app.charts.plotly_panels import INK, axis, plot, vertical
from ehlectric.app.view_models import Figure
from ehlectric.calibration import Calibration, Compared
from ehlectric.cases.measurements import quantity_text
from ehlectric.quantities.palette import BLUE, LIGHT_GREY, ORANGE

# Height of a row, and of what surrounds the rows [px].
_ROW, _REST = 44, 110

# Widths of bars before and after the measurement, as parts of a row.
_WIDE, _NARROW = 0.62, 0.3

# Largest number of measured values that are drawn.
_DRAWN = 24

# Half the width of the 95 % interval of a normal distribution, in standard deviations.
_INTERVAL = 1.96


def ranges_figure(result: Calibration) -> Figure:
    """90 % ranges of the inputs before and after the measurement, in per cent of their ranges."""
    entries = [entry for entry in result.inputs if entry.posterior is not None and entry.high > entry.low]
    names = [entry.label.partition(" (")[0] for entry in entries]

    def parts(ends: Sequence[float], low: float, high: float) -> list[float]:
        return [100.0 * (end - low) / (high - low) for end in ends]

    before = [parts(entry.prior, entry.low, entry.high) for entry in entries]
    after = [parts(entry.posterior or entry.prior, entry.low, entry.high) for entry in entries]
    return Figure(
        "Ranges of the inputs before and after the measurement",
        f"90 % ranges of {len(names)} uncertain inputs before and after the measurement.",
        plot(
            [
                _bars("before", names, before, LIGHT_GREY, _WIDE),
                _bars("after", names, after, BLUE, _NARROW),
            ],
            **_layout(names, "range [%]"),
        ),
        caption="Bars extend from 5 % to 95 %, in per cent of the range of each input.",
    )


def compared_figure(result: Calibration) -> Figure:
    """Computed values divided by measured ones, with the 95 % intervals of the measured values."""
    rows = [row for row in result.rows[:_DRAWN] if row.measured]
    names = [_name(row) for row in rows]
    before = [_ratios(row, row.prior) for row in rows]
    traces = [_bars("before", names, before, LIGHT_GREY, _WIDE)]
    if result.explained:
        after = [_ratios(row, row.posterior or row.prior) for row in rows]
        traces.append(_bars("after", names, after, BLUE, _NARROW))
    else:
        nearest = [row.nearest / row.measured for row in rows]
        traces.append(_marks("nearest", names, nearest, INK, "x"))
    bars = [_INTERVAL * row.uncertainty / abs(row.measured) for row in rows]
    measured = _marks("measured (95 %)", names, [1.0] * len(rows), ORANGE, "circle")
    traces.append(measured | {"error_x": {"type": "data", "array": bars, "color": ORANGE, "width": 5}})
    of = f"{len(rows)} of {len(result.rows)}" if len(rows) < len(result.rows) else f"{len(rows)}"
    return Figure(
        "Computed / measured",
        f"Computed values divided by {of} measured values, before and after the measurement.",
        plot(
            traces,
            **_layout(names, "computed / measured"),
            shapes=[vertical(1.0)],
        ),
        caption="Bars extend from 5 % to 95 % of the computed values.",
    )


def _name(row: Compared) -> str:
    line = "" if row.line is None else f", line {row.line}"
    return f"{quantity_text(row.quantity)}{line}"


def _ratios(row: Compared, ends: Iterable[float]) -> list[float]:
    return [end / row.measured for end in ends]


def _bars(
    name: str, names: Sequence[str], ends: Sequence[Sequence[float]], colour: str, width: float
) -> Mapping[str, Any]:
    """Bars from the first to the last of three values; a bar without values is omitted."""
    low, middle, high = np.array(ends).reshape(-1, 3).T
    known = np.isfinite(low) & np.isfinite(high)
    return {
        "type": "bar",
        "orientation": "h",
        "name": name,
        "y": [text for text, has in zip(names, known, strict=True) if has],
        "base": low[known].tolist(),
        "x": (high - low)[known].tolist(),
        "width": width,
        "marker": {"color": colour},
        "customdata": np.stack([low, middle, high], axis=-1)[known].tolist(),
        "hovertemplate": f"%{{y}} {name}: %{{customdata[0]:.3g}} to %{{customdata[2]:.3g}},"
        " median %{customdata[1]:.3g}<extra></extra>",
    }


def _marks(
    name: str, names: Sequence[str], values: Sequence[float], colour: str, symbol: str
) -> dict[str, Any]:
    known = [(value, text) for value, text in zip(values, names, strict=True) if np.isfinite(value)]
    return {
        "type": "scatter",
        "mode": "markers",
        "name": name,
        "x": [value for value, _ in known],
        "y": [text for _, text in known],
        "marker": {"color": colour, "symbol": symbol, "size": 9},
        "hovertemplate": f"%{{y}} {name}: %{{x:.3g}}<extra></extra>",
    }


def _layout(names: Sequence[str], title: str) -> dict[str, Any]:
    return {
        "height": _REST + _ROW * max(1, len(names)),
        "barmode": "overlay",
        "hovermode": "closest",
        "xaxis": axis(title),
        "yaxis": axis() | {"autorange": "reversed", "type": "category"},
    }
