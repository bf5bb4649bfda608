"""Default figure of each kind of result: the figure that tells most about it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ehlectric.bearing.result import BearingResult
from ehlectric.cases.measurements.factors import FilmFactors
from ehlectric.contact.results import PointResult, Result
from ehlectric.drive.result import DriveResult
from ehlectric.errors import InputError
from ehlectric.figures.bearing.save import bearing_figures_of
from ehlectric.figures.drive.save import drive_figures_of
from ehlectric.figures.names import MEASURED_FIGURE, SENSITIVITY_FIGURE, map_files
from ehlectric.motion.result import MotionResult
from ehlectric.sweep.breakdown_keys import main_value
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import known_values

# Name of a figure, and options to draw it with.
_Default = tuple[str, dict[str, Any]]

# Value of a sweep without breakdown voltages, by the kind of its case.
_VALUES = ("film.minimum_thickness", "bearing.capacitance")


def default_figure(result: Any, **options: Any) -> _Default:
    """Name and options of the figure that tells most about a result.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, MotionResult or SweepResults
        Result.
    **options
        Options of a sweep that are given: ``value``, ``x`` and ``y`` are not chosen then.

    Returns
    -------
    name : str
        Name of the figure.
    options : dict
        Options of ``figure``; empty for results other than sweeps.
    """
    choose = next(choice for kind, choice in _CHOICES.items() if isinstance(result, kind))
    return choose(result, options)


def _of_line(result: Result, _options: Mapping[str, Any]) -> _Default:
    return ("field_profiles.png" if result.discharge is not None else "film.png"), {}


def _of_point(result: PointResult, _options: Mapping[str, Any]) -> _Default:
    return ("field_map.png" if result.discharge is not None else "film_map.png"), {}


def _of_bearing(result: BearingResult, _options: Mapping[str, Any]) -> _Default:
    """Breakdown over speed where there is a breakdown voltage, else the loads."""
    if result.breaks()["first_break"] is not None:
        return "breakdown_over_speed.png", {}
    return next(iter(bearing_figures_of(result))), {}


def _of_drive(result: DriveResult, _options: Mapping[str, Any]) -> _Default:
    """Voltages over time, else how long which voltages last."""
    return next(iter(drive_figures_of(result))), {}


def _of_motion(_result: MotionResult, _options: Mapping[str, Any]) -> _Default:
    return "motion_history.png", {}


def _of_sweep(results: SweepResults, options: Mapping[str, Any]) -> _Default:
    """Sensitivity of a Sobol design, lines over one varied key, or a map over two."""
    if results.design == "sobol":
        return SENSITIVITY_FIGURE, {}
    value = options.get("value") or _value_of(results)
    over = default_axes(results, options)
    if not over:
        raise InputError("x", "no varied key has numbers;", takes="a figure by its name")
    files = map_files(value)
    return files[0 if "y" in over and results.design == "grid" else 1], over | {"value": value}


def default_axes(results: SweepResults, options: Mapping[str, Any]) -> dict[str, str]:
    """Varied keys along the axes of a figure: those that are given, else the first ones with numbers.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep.
    options : mapping
        Options of the figure, of which ``x`` and ``y`` are kept.

    Returns
    -------
    dict of str to str
        ``x``, and ``y`` where there is a second key; empty where no key has numbers.
    """
    x, y = options.get("x"), options.get("y")
    at = options.get("at") or {}
    free = [key for key in _numeric(results) if key not in (x, y, *at)]
    keys = [x] if x else free[:1]
    if not keys:
        return {}
    others = [y] if y else [key for key in free if key not in keys]
    return {"x": keys[0]} | ({"y": others[0]} if others else {})


def _value_of(results: SweepResults) -> str:
    """Breakdown voltage, where there is one, else the film or the capacitance."""
    known, breakdown = known_values(results), main_value(results.case)
    for value in (breakdown, *_VALUES, *known):
        if value in known:
            return value
    raise InputError(f"no point of {len(results.points)} is solved, there is nothing to show")


def _numeric(results: SweepResults) -> list[str]:
    """Varied keys with numbers that differ."""
    columns = {key: {repr(point.inputs[key]) for point in results.points} for key in results.varied}
    first = results.points[0].inputs
    return [key for key, values in columns.items() if len(values) > 1 and isinstance(first[key], int | float)]


_CHOICES: Mapping[type, Callable[[Any, Mapping[str, Any]], _Default]] = {
    Result: _of_line,
    PointResult: _of_point,
    BearingResult: _of_bearing,
    DriveResult: _of_drive,
    MotionResult: _of_motion,
    SweepResults: _of_sweep,
    FilmFactors: lambda _factors, _options: (MEASURED_FIGURE, {}),
}
