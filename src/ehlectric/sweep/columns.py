"""Columns of a sweep: inputs and results of all points, with their units, and the dataset made of them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.cases.input_keys import kind_of, of_both_ends
from ehlectric.runtime.values import is_number
from ehlectric.sweep.labels import label_of
from ehlectric.sweep.points import SweepPoints, as_number, flat
from ehlectric.version import __version__

if TYPE_CHECKING:
    import xarray as xr


# Keys of the summary whose values are texts that may differ between points.
_TEXTS = ("bearing.lubrication", "bearing.regime", "bearing.first_break_at")

# Variables of a point besides its inputs and results, with their attributes in the CF conventions.
_OWN = {
    "number": {"long_name": "number of the point in the order of the design", "units": "1"},
    "status": {"long_name": "what became of the point"},
    "reason": {"long_name": "why it is not solved"},
    "warnings": {"long_name": "what to know before using its numbers"},
    "warning_codes": {"long_name": "codes of the warnings"},
    "seconds": {"long_name": "time it took", "units": "s"},
}


def columns_of(results: SweepPoints) -> dict[str, list[Any]]:
    """Columns of the table of a sweep, with one row for each point.

    Parameters
    ----------
    results : SweepPoints
        A sweep, finished or not.

    Returns
    -------
    dict
        Columns by name. First are number, status, reason, warnings, warning_codes and seconds; several
        warnings of a point are joined by "; ". The varied inputs and the results follow by dotted key, in SI
        units.

        A result is None if the point is not solved, or its summary has no such value. An input that
        the summary repeats has a column only if it differs between points. A value of the summary with the
        key of a varied input, such as a film factor, has no column of its own.
    """
    points = results.points
    columns: dict[str, list[Any]] = {
        "number": [point.number for point in points],
        "status": [point.status for point in points],
        "reason": [point.reason for point in points],
        "warnings": ["; ".join(map(str, point.warnings)) for point in points],
        "warning_codes": ["; ".join(warning.code for warning in point.warnings) for point in points],
        "seconds": [point.seconds for point in points],
    }
    columns |= {key: [point.inputs[key] for point in points] for key in results.varied}
    summaries = texts_of(results) | numbers_of(results)
    return columns | {key: values for key, values in summaries.items() if key not in columns}


def texts_of(results: SweepPoints) -> dict[str, list[str | None]]:
    """Texts of the summaries by dotted key, each a list over the points; only bearings have such texts."""
    rows = [flat(point.summary) if point.solved and point.summary else {} for point in results.points]
    return {key: [row.get(key) for row in rows] for key in _TEXTS if any(key in row for row in rows)}


def numbers_of(results: SweepPoints) -> dict[str, list[float | None]]:
    """Numbers of the summaries by dotted key, each a list over the points, None if a point has none.

    An input that the summaries repeat is kept only if it differs between points and is not a varied key. An
    example is a viscosity that follows from a varied temperature.
    """
    rows = [_numbers(point.summary) if point.solved and point.summary else {} for point in results.points]
    keys = dict.fromkeys(key for row in rows for key in row)
    columns = {key: [row.get(key) for row in rows] for key in keys}
    varied = {f"inputs.{key}" for one in results.varied for key in of_both_ends(one)}
    return {
        key: values
        for key, values in columns.items()
        if not key.startswith("inputs.") or (key not in varied and len({*values} - {None}) > 1)
    }


def _numbers(summary: Mapping[str, Any]) -> dict[str, float]:
    """Numbers of a summary by dotted key."""
    return {key: value for key, value in flat(summary).items() if is_number(value)}


def dataset_of(results: SweepPoints) -> xr.Dataset:
    """Convert a sweep to a dataset in SI units.

    Parameters
    ----------
    results : SweepPoints
        A sweep, finished or not.

    Returns
    -------
    xarray.Dataset
        Dataset over the varied keys for a "grid" design, else over ``point``. Numbers of the summaries have
        their dotted key as name, and are NaN where a point is not solved. ``status``, ``reason``,
        ``warnings`` and ``warning_codes`` are texts; so are the lubrication and the first contact to break of
        a bearing.
    """
    import xarray as xr

    gridded = results.design == "grid"
    dimensions = results.varied if gridded else ("point",)
    shape = tuple(len(axis) for axis in results.axes.values()) if gridded else (len(results.points),)

    def laid_out(values: list[Any]) -> tuple[tuple[str, ...], Any]:
        return dimensions, _array(values).reshape(shape)

    columns = columns_of(results)
    own = {name: (*laid_out(columns.pop(name)), attributes) for name, attributes in _OWN.items()}
    inputs = {key: columns.pop(key) for key in results.varied}
    coordinates = {
        key: (
            key if gridded else "point",
            _array(list(results.axes[key] if gridded else values)),
            _attributes(key, results),
        )
        for key, values in inputs.items()
    }
    summaries = {
        key: (*laid_out(values if key in _TEXTS else list(map(as_number, values))), _attributes(key, results))
        for key, values in columns.items()
    }
    return xr.Dataset(
        own | summaries,
        coords=coordinates,
        attrs={
            "Conventions": "CF-1.11",
            "title": results.title or results.case.title or "Sweep of a lubricated contact",
            "source": f"ehlectric {__version__}",
            "comment": "SI units; NaN where a point is not solved; see warnings before a value is used",
            "case": results.case.to_toml(),
            "design": results.design,
            "ranges": json.dumps({key: vars(over) for key, over in results.ranges.items()}),
            "samples": results.samples,
            "seed": results.seed,
        },
    )


def _array(values: list[Any]) -> Any:
    """Values as an array of numbers, or of texts if some are not numbers; lists become JSON texts."""
    numeric = [is_number(value) for value in values]
    if all(numeric):
        return np.array(values)
    return np.array([cell(value) for value in values], dtype=object)


def cell(value: Any) -> Any:
    """Text of a value in a CSV file: None as an empty text, a float with all digits, lists as JSON."""
    if value is None or isinstance(value, str):
        return value or ""
    return repr(value) if isinstance(value, float) else json.dumps(value)


def _attributes(key: str, results: SweepPoints) -> dict[str, str]:
    """CF attributes of an input or result: its name and, if it is a number, its unit."""
    label = label_of(key, results.case)
    attributes = {"long_name": label.name}
    if key in _TEXTS or (key in results.varied and kind_of(key) is None):
        return attributes
    return attributes | {"units": label.unit.replace("**", "^").replace("*", " ") or "1"}


def unit_of_column(results: SweepPoints, key: str) -> str | None:
    """SI unit of a column of numbers, empty for a dimensionless one; None for texts and for point numbers.

    Parameters
    ----------
    results : SweepPoints
        A sweep, finished or not.
    key : str
        Name of a column of ``columns_of``.
    """
    if key in _OWN:
        return "s" if key == "seconds" else None
    if key in _TEXTS or (key in results.varied and kind_of(key) is None):
        return None
    return label_of(key, results.case).unit
