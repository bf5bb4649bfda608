"""Preview of a sweep: its size, and the preview of its first point."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np

from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import HOW, QUICK
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.quantities.rows import Row
from ehlectric.readable import readable
from ehlectric.runs.preview import Preview, preview_of
from ehlectric.runtime.worker_processes import cores
from ehlectric.sweep import Planned, Sweep, label_of, lacking_point, plan

# Largest number of points of a sweep that are checked one by one.
_MOST_CHECKED = 2000

# Largest number of points of which the first one with a preview is shown.
_MOST_PREVIEWED = 50


def preview(sweep: Sweep) -> Preview:
    """Return the preview of a sweep: its size, and the preview of the first point that is not refused.

    Raises InputError if no point is a case, or if all points are refused.
    """
    started = time.perf_counter()
    planned = list(islice(plan(sweep), _MOST_CHECKED))
    cases = [point for point in planned if point.key is not None]
    if not cases:
        raise InputError("vary", f"no point is a case; of the first, {planned[0].refused}")
    each = (time.perf_counter() - started) / len(planned)
    refused = [point.refused for point in planned if point.key is None]
    for first in cases[:_MOST_PREVIEWED]:
        begun = time.perf_counter()
        try:
            preview = preview_of(sweep.case.replace(first.inputs))
            break
        except InputError as error:
            refused.append(str(error))
            reason = error
    else:
        raise reason
    seconds = time.perf_counter() - begun + each
    described = _described(sweep, len(planned), refused, first)
    lacking = lacking_point(sweep, planned)
    described["lacking"] = None if lacking is None else str(lacking)
    rows = (*_sweep_rows(sweep, described, seconds), Row("first point:"), *preview.rows)
    summary = {"sweep": described, "first_point": preview.summary}
    return replace(preview, title=sweep.title or preview.title, rows=rows, summary=summary, verdict=None)


def _described(sweep: Sweep, checked: int, refused: list[str], first: Planned) -> dict[str, Any]:
    """Size and inputs of a sweep as a table, and why points are refused."""
    return {
        "points": sweep.size,
        "design": sweep.design,
        "inputs": {key: _values(value) for key, value in sweep.vary.items()},
        "points_checked": checked,
        "points_refused": len(refused),
        "reason": refused[0] if refused else None,
        "first_point": {"number": first.number, "inputs": dict(first.inputs)},
    }


def _values(value: Any) -> dict[str, Any]:
    """Values of a varied key: the ends of its range, or the number of values with first and last."""
    if isinstance(value, tuple):
        return {"values": len(value), "first": value[0], "last": value[-1]}
    return {"from": value.start, "to": value.stop, "spacing": value.spacing}


def _sweep_rows(sweep: Sweep, described: Mapping[str, Any], seconds: float) -> Iterator[Row]:
    yield Row("points", str(sweep.size), note=f"{sweep.design} design")
    for key, value in described["inputs"].items():
        yield Row(f"  {key}", *_shown(key, value, sweep))
    if described["points_refused"]:
        refused = f"of {described['points_checked']} checked points are no valid case: {described['reason']}"
        yield Row("  refused", str(described["points_refused"]), note=refused, alarm=True)
    if described["lacking"] is not None:
        yield Row("  points fail", note=described["lacking"], alarm=True)
    if isinstance(sweep.case, BearingCase) and sweep.case.contacts in QUICK:
        whole = sweep.size * seconds / cores()
        yield Row(
            "time, estimated", whole, "s", f", {HOW[sweep.case.contacts]} on {cores()} cores", digits=".2g"
        )
    else:
        command = _COMMANDS.get(type(sweep.case), "run")
        note = f"about {sweep.size} times one ehlectric {command}, on {cores()} cores"
        yield Row("time", note=note)


# Commands that solve base cases other than contacts.
_COMMANDS = {BearingCase: "bearing", DriveCase: "drive", AxleCase: "drive", GearCase: "gear"}


def _shown(key: str, value: Mapping[str, Any], sweep: Sweep) -> tuple[str, str, str]:
    """Value, unit and note of the row of a varied key."""
    ends = [value["from"], value["to"]] if "from" in value else [value["first"], value["last"]]
    texts, unit = _in_units(key, ends, sweep)
    if "from" in value:
        note = ", spaced by logarithms" if value["spacing"] == "log" else ""
    else:
        note = f" in {value['values']} values" if value["values"] > 1 else ""
    return " to ".join(dict.fromkeys(texts)), unit, note


def _in_units(key: str, values: list[Any], sweep: Sweep) -> tuple[list[str], str]:
    """Values as texts in the unit that an engineer uses; other values than numbers as they are."""
    if not all(isinstance(value, float) for value in values):
        return [str(value) for value in values], ""
    scale = label_of(key, sweep.case).scaled(np.array(values))
    return [readable(scale.of(value), 4) for value in values], scale.unit
