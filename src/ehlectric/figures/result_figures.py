"""Figures of any result: their names, the default figure of each kind, and their files."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from ehlectric.bearing.quick_contacts import quick_case
from ehlectric.bearing.result import BearingResult
from ehlectric.cases.film_factors import FilmFactors
from ehlectric.cases.table import nearest
from ehlectric.contact.result import PointResult, Result
from ehlectric.drive.result import DriveResult
from ehlectric.errors import InputError, shown
from ehlectric.figures import bearing_figure_files as bearing
from ehlectric.figures import contact_figure_files as contact
from ehlectric.figures import drive_figures as drive
from ehlectric.figures import measured_figures as measured
from ehlectric.figures import motion_figures as motion
from ehlectric.figures import sweep_figures as sweep
from ehlectric.figures.figure_names import (
    BEARING_FIGURE_FILES,
    DUTY_FIGURE,
    MEASURED_FIGURE,
    SENSITIVITY_FIGURE,
    SPEED_FIGURE_FILES,
    in_formats,
    map_files,
)
from ehlectric.figures.style import save_each
from ehlectric.figures.style import style as styled
from ehlectric.motion.result import MotionResult
from ehlectric.motion.stored_run import MotionRun
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
from ehlectric.runtime.undrawn import Drawn
from ehlectric.sweep.axis_labels import label_of
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import known_values
from ehlectric.sweep.sweep_inputs import main_value

# Name of a figure, and options to draw it with.
_Default = tuple[str, dict[str, Any]]

# Value of a sweep without breakdown voltages, by the kind of its case.
_VALUES = ("film.minimum_thickness", "bearing.capacitance")


def default_figure(result: Any, **options: Any) -> _Default:
    """Name and options of the figure that tells most about a result. Returns ``name``, name of the figure;
    ``options``, options of ``figure``; empty for results other than sweeps.
    """
    if isinstance(result, SweepResults):
        return _of_sweep(result, options)
    choose = next(choice for kind, choice in _DEFAULTS.items() if isinstance(result, kind))
    return choose(result), {}


def _of_bearing(result: BearingResult) -> str:
    """Breakdown over speed where there is a breakdown voltage, else the loads."""
    if result.breaks()["first_break"] is not None:
        return "breakdown_over_speed.png"
    return next(iter(bearing.bearing_figures_of(result)))


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
    """Varied keys along the axes of a figure: those that are given, else the first ones with numbers. Returns
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


# Default figure of each kind of result. That of a drive is the first of its figures: voltages over time, else
# how long which voltages last.
_DEFAULTS: Mapping[type, Callable[[Any], str]] = {
    Result: lambda result: "film.png" if result.discharge is None else "field_profiles.png",
    PointResult: lambda result: "film_map.png" if result.discharge is None else "field_map.png",
    BearingResult: _of_bearing,
    DriveResult: lambda result: next(iter(drive.drive_figures_of(result))),
    MotionResult: lambda _: "motion_history.png",
    FilmFactors: lambda _: MEASURED_FIGURE,
}


AnyResult = (
    Result | PointResult | BearingResult | DriveResult | xr.Dataset | MotionRun | SweepResults | FilmFactors
)


def figure(result: AnyResult, name: str, *, style: str = "screen", **options: Any) -> Figure:
    """Figure of a result.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, DriveResult, Dataset, MotionRun, SweepResults or FilmFactors
        Result of a contact, bearing, drive, transient contact, sweep or measurement.
    name : str
        Name of its file, such as "film.png" of a line contact, or "film" for short; ``figure_names`` lists
        the names.
    style : str
        "screen", "dark": light on a dark page, or "journal": as wide as one or two columns of a journal (84
        or 174 mm), in small type, without the title.
    **options
        Options of the figures of a sweep, such as ``x`` and ``y``: varied keys along the axes.

    Returns
    -------
    Figure
        The figure, with its title, in the style of the package. The settings of matplotlib stay as they are.

    Raises
    ------
    InputError
        Where the result has no figure of this name, or there is no such style.

    Examples
    --------
    >>> from ehlectric import Case, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> figure(solve(case), "film.png").axes[0].get_xlabel()[:5]
    '$x/b$'
    """
    draws = _draws_of(result)
    _check_options(result, draws, options)
    if isinstance(result, SweepResults):
        options = _with_axes(result, name, options)
    elif _stem(name) not in figure_names(result):
        raise _no_figure(result, name)
    with styled(style):
        return draws.figure(_opened(result), name, **options)


def figure_names(result: AnyResult) -> list[str]:
    """Names of the figures that a result has.

    Those of a bearing include its figures over speed, which are drawn from contacts that are not solved.
    Those of a sweep are maps and lines of each value that has a name, over the first varied keys; ``x`` and
    ``y`` choose others.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, DriveResult, Dataset, MotionRun, SweepResults or FilmFactors
        Result of a contact, bearing, drive, transient contact, sweep or measurement.

    Returns
    -------
    list of str
        Names for ``figure``, without the ending of a file.
    """
    draws, opened = _draws_of(result), _opened(result)
    return [_stem(name) for name in (*draws.names(opened), *draws.more_names(opened))]


def draw_figures(
    result: AnyResult, folder: str | Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> Drawn:
    """Draw all figures of a result as files.

    ``folder``, folder of the files; it is made if it does not exist. Returns files, and warnings about speeds
    that the figures of a bearing leave out; there are no figures of a sweep here: they need the keys of their
    axes. Raises InputError where there is no such format or style, the folder cannot be used, or another
    command draws into it.
    """
    in_formats((), formats)
    with alone_in(folder, locks=[FIGURE_LOCK]) as folder, styled(style):
        draws, opened = _draws_of(result), _opened(result)
        files = save_each(partial(draws.figure, opened), draws.names(opened), folder, formats)
        over_speed, left_out = draws.save_more(opened, folder, formats)
        return Drawn((*files, *over_speed), tuple(left_out))


def save_figures(
    result: AnyResult, folder: str | Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> list[Path]:
    """Draw all figures of a result as files.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, DriveResult, Dataset, MotionRun, SweepResults or FilmFactors
        Result of a contact, bearing, drive, transient contact, sweep or measurement.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".
    style : str
        "screen", "dark": light on a dark page, or "journal": as wide as one or two columns of a journal (84
        or 174 mm), in small type, without the title, which the metadata of the files have in any style.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        Where there is no such format or style, the folder cannot be used, or another command draws into it.
    """
    return list(draw_figures(result, folder, formats, style).files)


@dataclass(frozen=True)
class _Draws:
    """Functions that draw one kind of result."""

    figure: Callable[..., Figure]  # a figure by its name
    names: Callable[[Any], Iterable[str]]  # names of the figures that are drawn as files
    # Names of the figures over speeds or varied keys, and the function that draws those over speeds as files.
    more_names: Callable[[Any], list[str]] = lambda _: []
    save_more: Callable[..., tuple[list[Path], list[ResultWarning]]] = lambda *_: ([], [])


def _names_over_speed(result: BearingResult) -> list[str]:
    """Names of the figures of a bearing over speed, as far as its quick contacts have them."""
    case, _ = quick_case(result.case)
    if case is None:
        return []
    breaks = case.discharge.has_strength and not result.solution.conditions.ceramic
    return [name for name in bearing.SPEED_FIGURES if breaks or not name.startswith("breakdown")]


def _names_of_sweep(results: SweepResults) -> list[str]:
    """Names of the figures of a sweep over its default axes."""
    axes = default_axes(results, {})
    known = (value for value in known_values(results) if not value.startswith("inputs."))
    values = [value for value in known if label_of(value, results.case).name != value]
    names = []
    for value in values if axes else ():
        on_map, lines = map_files(value)
        names += [on_map, lines] if "y" in axes and results.design == "grid" else [lines]
    return [SENSITIVITY_FIGURE, *names] if results.design == "sobol" else names


def _check_options(result: AnyResult, draws: _Draws, options: Mapping[str, Any]) -> None:
    """Raise an InputError for an option that the figures of a result do not have."""
    _, _, *known = inspect.signature(draws.figure).parameters
    for option in options:
        if option not in known:
            takes = f"one of {', '.join(known)}" if known else f"none but style for a {type(result).__name__}"
            raise InputError(option, "is no option of this figure", takes=takes)


def _with_axes(results: SweepResults, name: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Options of a figure of a sweep, with the default axes where none are given. Raises InputError if the
    name is not that of a figure but that of a value.
    """
    stem = _stem(name)
    if stem in known_values(results):
        raise InputError("figure", got=f"{shown(stem)}, a value;", takes=f"value={stem!r} in place of a name")
    if not stem.startswith(("map_", "lines_")):
        return dict(options)
    if options.get("x") and (stem.startswith("map_") or results.design != "grid"):
        return dict(options)
    return {**default_axes(results, options), **options}


def _no_figure(result: AnyResult, name: str) -> InputError:
    """Error of a name that is none of the figures of a result, with the nearest name and the cause."""
    names, (file,) = figure_names(result), in_formats([name])
    of_bearings = isinstance(result, BearingResult) and file in (*BEARING_FIGURE_FILES, *SPEED_FIGURE_FILES)
    cause = _lacking(result, file) if of_bearings else f"nearest is {nearest(_stem(name), names)}"
    return InputError("figure", got=shown(name), takes=f"one of {', '.join(names)}; {cause}")


def _lacking(result: Any, file: str) -> str:
    """Why a bearing lacks a figure that other bearings have."""
    if file == DUTY_FIGURE:
        return "that of a duty cycle needs [duty], which the case does not have"
    if result.solution.conditions.ceramic:
        return "the others need elements that conduct, and those of this bearing are ceramic"
    if not result.case.discharge.has_strength:
        return "those of breakdown need discharge.dielectric_strength, which the case does not give"
    return "this bearing has nothing to show in the others"


def _stem(name: str) -> str:
    """Name of a figure without the ending of a format."""
    return in_formats([name])[0].removesuffix(".png")


_CONTACT = _Draws(contact.figure, contact.drawings_of)
_MOTION = _Draws(motion.figure, motion.drawings_of)
_DRAWS: dict[type, _Draws] = {
    Result: _CONTACT,
    PointResult: _CONTACT,
    BearingResult: _Draws(
        bearing.figure, bearing.bearing_figures_of, _names_over_speed, bearing.save_over_speed
    ),
    DriveResult: _Draws(drive.figure, drive.drive_figures_of),
    FilmFactors: _Draws(measured.figure, lambda _: [MEASURED_FIGURE]),
    xr.Dataset: _MOTION,
    MotionRun: _MOTION,
    SweepResults: _Draws(sweep.figure, lambda _: [], _names_of_sweep),
}


def _draws_of(result: AnyResult) -> _Draws:
    """Functions that draw a result, by its type."""
    return next(draws for kind, draws in _DRAWS.items() if isinstance(result, kind))


def _opened(result: AnyResult) -> AnyResult:
    """Result, with the dataset of a transient contact as a run."""
    return MotionRun.of(result) if isinstance(result, xr.Dataset) else result
