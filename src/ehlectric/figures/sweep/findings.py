"""Findings of the figures of a sweep, one sentence each."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.intermittency.words import OF_TIME, time_text
from ehlectric.discharge.verdict import ratio_text
from ehlectric.figures.sweep.paths import LinePath, joined, lines_of
from ehlectric.figures.sweep.points import labelled, voltage_text
from ehlectric.figures.sweep.time_shares import TIME_SHARES
from ehlectric.quantities.formats import number_text
from ehlectric.sweep.breakdown_keys import breakdown_of
from ehlectric.sweep.interpolation import spaced_log
from ehlectric.sweep.labels import label_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.sensitivity import Sensitivity
from ehlectric.sweep.slices import Slice


def of_slice(results: SweepResults, selection: Slice) -> str:
    """Sentence: range of the drawn value; of a discharge, where breakdown is expected."""
    margin = selection.margin[np.isfinite(selection.margin)]
    if not (selection.of_discharge and margin.size):
        label, scale = labelled(results, selection.value, selection.values)
        finite = selection.values[np.isfinite(selection.values)]
        if selection.value in TIME_SHARES:
            return _of_time(finite)
        low, high = (number_text(scale.of(float(of(finite)))) for of in (np.min, np.max))
        ends = low if low == high else f"{low} to {high}"
        return f"{label.name[:1].upper()}{label.name[1:]}: {ends} {scale.unit}".rstrip()
    return _of_margins(results, selection, margin) + _intermittent(selection)


def _of_time(shares: Array) -> str:
    """Sentence: range of the shares of time in which contacts short bearings."""
    low, high = (time_text(float(of(shares))) for of in (np.min, np.max))
    ends = high if low == high else f"{low.removesuffix(OF_TIME)} to {high}"
    return f"Contacts short the bearing {ends}"


def _intermittent(selection: Slice) -> str:
    """Clause: the number of points at which contacts open and close, so that no voltage is computed."""
    count = int(np.sum(selection.intermittent))
    return f"; at {count} more, contacts open and close (λ < 1), discharges are likely" if count else ""


def _of_margins(results: SweepResults, selection: Slice, margin: Array) -> str:
    """Sentence: where breakdown is expected, from the margins of the points that have one."""
    below = int(np.sum(margin < 1.0))
    applied = f"{selection.breakdown.voltage_name} {voltage_text(selection)}"
    points = f"{margin.size} points" + " with a voltage" * bool(np.any(selection.intermittent))
    everywhere = f"at all {points}" if margin.size > 1 else "at the point"
    least, most = (ratio_text(float(of(margin))) for of in (np.min, np.max))
    if not below:
        return f"No breakdown expected {everywhere}: minimum margin {least} ({applied})"
    if below == margin.size:
        return f"Breakdown expected {everywhere}: maximum margin {most} ({applied})"
    where = _where(results, selection) or f"at {below} of {margin.size} points"
    return f"Breakdown expected {where} ({applied})"


def _where(results: SweepResults, selection: Slice) -> str:
    """Clause: the values of x below or above which breakdown is expected, if there is one for each line."""
    log_x = spaced_log(results, selection.x, selection.along)
    numbers = selection.y is not None and selection.numeric
    log_y = numbers and spaced_log(results, str(selection.y), np.array(selection.across))
    margins = replace(selection, value=selection.breakdown.margin)
    lines = lines_of(margins, log=log_y)
    if not joined(margins, lines):
        return ""
    path = LinePath(results, margins, log_x, log_y)
    crossings = [crossing(*path.values(line)) for line in lines]
    found = [one for one in crossings if one is not None]
    sides = {side for _, side in found}
    if len(found) < len(lines) or len(sides) > 1:
        return ""
    label, scale = labelled(results, selection.x, selection.along)
    places = sorted(scale.of(at) for at, _ in found)
    texts = list(dict.fromkeys(f"{float(f'{places[k]:.3g}'):g}" for k in (0, -1)))
    clause = f"{sides.pop()} {' to '.join(texts)} {scale.unit or label.name}"
    if len(texts) == 1 or selection.y is None:
        return clause
    return f"{clause}, depending on {label_of(selection.y, results.case).name}"


def crossing(x: Array, margin: Array) -> tuple[float, str] | None:
    """Place at which a margin passes 1, with "below" or "above" for the side of breakdown.

    None where it does not pass 1 exactly once, or has gaps.

    Examples
    --------
    >>> crossing(np.array([1.0, 2.0, 3.0]), np.array([0.5, 0.9, 1.1]))
    (2.5, 'below')
    """
    if not np.all(np.isfinite(margin)):
        return None
    low = margin < 1.0
    (changes,) = np.nonzero(low[:-1] != low[1:])
    if changes.size != 1:
        return None
    k = int(changes[0])
    part = (1.0 - margin[k]) / (margin[k + 1] - margin[k])
    return round(float(x[k] + part * (x[k + 1] - x[k])), 12), "below" if low[0] else "above"


def of_sensitivity(results: SweepResults, analysis: Sensitivity) -> str:
    """Sentence: the input with the largest part of the variance, and the share of samples that break down."""
    most: Any = max(analysis.indices, key=lambda index: index.total)
    value = label_of(analysis.value, results.case).name
    name = label_of(most.key, results.case).name
    text = f"{name[:1].upper()}{name[1:]} has {100.0 * most.total:.0f} % of the variance"
    if analysis.share_below_voltage is None:
        return f"{text} of the {value}"
    voltage = breakdown_of(results.case, analysis.value).voltage_name
    return f"{text}; {100.0 * analysis.share_below_voltage:.3g} % of the samples are below the {voltage}"
