"""Figures of any result: their names, the default figure of each kind, and their files.

The functions of a kind are imported when a result of this kind is drawn.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

from matplotlib.figure import Figure

from ehlectric.cases.table import nearest
from ehlectric.errors import InputError, shown
from ehlectric.figures.figure_names import MEASURED_FIGURE, in_formats
from ehlectric.figures.style import save_each
from ehlectric.figures.style import style as styled
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.display import ResultKind
from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
from ehlectric.runtime.undrawn import Drawn

if TYPE_CHECKING:
    import xarray as xr

    from ehlectric.axle import AxleResult
    from ehlectric.bearing import BearingResult
    from ehlectric.calibration import Calibration
    from ehlectric.cases.film_factors import FilmFactors
    from ehlectric.contact import PointResult, Result
    from ehlectric.drive import DriveResult
    from ehlectric.gear import GearResult
    from ehlectric.motion.stored_run import MotionRun
    from ehlectric.sweep import SweepResults

    AnyResult = (
        Result
        | PointResult
        | BearingResult
        | DriveResult
        | GearResult
        | AxleResult
        | xr.Dataset
        | MotionRun
        | SweepResults
        | FilmFactors
        | Calibration
    )


def default_figure(result: AnyResult, **options: Any) -> tuple[str, dict[str, Any]]:
    """Name and options of the most informative figure of a result. Returns ``name``, name of the figure;
    ``options``, options of ``figure``; empty for results other than sweeps.
    """
    return _draws_of(result).default(result, options)


def figure(result: AnyResult, name: str, *, style: str = "screen", **options: Any) -> Figure:
    """Draw a figure of a result.

    Parameters
    ----------
    result : any result
        Result
        Result of a contact, bearing, gear pair, drive, transient contact, sweep or measurement.
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
    if draws.completed is not None:
        options = draws.completed(result, _stem(name), options)
    elif _stem(name) not in figure_names(result):
        raise _no_figure(result, draws, name)
    with styled(style):
        return draws.figure(draws.opened(result), name, **options)


def figure_names(result: AnyResult) -> list[str]:
    """Return the names of the figures of a result.

    Figures of a bearing include its figures over speed, which are drawn from contacts that are not solved.
    Figures of a sweep are maps and lines of each value that has a name, over the first varied keys; ``x`` and
    ``y`` choose others.

    Parameters
    ----------
    result : any result
        Result
        Result of a contact, bearing, gear pair, drive, transient contact, sweep or measurement.

    Returns
    -------
    list of str
        Names for ``figure``, without the ending of a file.

    Examples
    --------
    >>> from ehlectric import Case, figure_names, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> "film" in figure_names(solve(case))
    True
    """
    draws = _draws_of(result)
    opened = draws.opened(result)
    return [_stem(name) for name in (*draws.names(opened), *draws.more_names(opened))]


def draw_figures(
    result: AnyResult, folder: str | Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> Drawn:
    """Draw all figures of a result as files.

    ``folder``, folder of the files; it is made if it does not exist. Returns files, and warnings about speeds
    that the figures of a bearing omit; there are no figures of a sweep here: they need the keys of their
    axes. Raises InputError where there is no such format or style, the folder cannot be used, or another
    command draws into it.
    """
    in_formats((), formats)
    with alone_in(folder, locks=[FIGURE_LOCK]) as folder, styled(style):
        draws = _draws_of(result)
        opened = draws.opened(result)
        files = save_each(partial(draws.figure, opened), draws.names(opened), folder, formats)
        over_speed, left_out = draws.save_more(opened, folder, formats)
        return Drawn((*files, *over_speed), tuple(left_out))


def save_figures(
    result: AnyResult, folder: str | Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> list[Path]:
    """Draw all figures of a result as files.

    Parameters
    ----------
    result : any result
        Result
        Result of a contact, bearing, gear pair, drive, transient contact, sweep or measurement.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".
    style : str
        "screen", "dark": light on a dark page, or "journal": as wide as one or two columns of a journal (84
        or 174 mm), in small type, without the title, which the metadata of the files contain in any style.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        Where there is no such format or style, the folder cannot be used, or another command draws into it.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from ehlectric import Case, save_figures, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     files = save_figures(solve(case), folder)
    >>> "film.png" in [file.name for file in files]
    True
    """
    return list(draw_figures(result, folder, formats, style).files)


@dataclass(frozen=True)
class _Draws:
    """Functions that draw one kind of result."""

    figure: Callable[..., Figure]  # a figure by its name
    names: Callable[[Any], Iterable[str]]  # names of the figures that are drawn as files
    # Name and options of the most informative figure of a result, from the options that are given.
    default: Callable[[Any, Mapping[str, Any]], tuple[str, dict[str, Any]]]
    # Names of the figures over speeds or varied keys, and the function that draws those over speeds as files.
    more_names: Callable[[Any], list[str]] = lambda _: []
    save_more: Callable[..., tuple[list[Path], list[ResultWarning]]] = lambda *_: ([], [])
    # Why a result lacks the figure of a file that other results have; None if no result has it.
    lacking: Callable[[Any, str], str | None] = lambda *_: None
    # Options of the figure of a name, completed; None if the figures have no options.
    completed: Callable[[Any, str, Mapping[str, Any]], dict[str, Any]] | None = None
    # Result as the functions above take it.
    opened: Callable[[Any], Any] = lambda result: result


def _check_options(result: AnyResult, draws: _Draws, options: Mapping[str, Any]) -> None:
    """Raise an InputError for an option that the figures of a result do not have."""
    _, _, *known = inspect.signature(draws.figure).parameters
    for option in options:
        if option not in known:
            takes = (
                f"one of {', '.join(known)}" if known else f"none except style for a {type(result).__name__}"
            )
            raise InputError(option, "is no option of this figure", takes=takes)


def _no_figure(result: AnyResult, draws: _Draws, name: str) -> InputError:
    """Error of a name that is none of the figures of a result, with the nearest name and the cause."""
    names, (file,) = figure_names(result), in_formats([name])
    cause = draws.lacking(result, file) or f"nearest is {nearest(_stem(name), names)}"
    return InputError("figure", got=shown(name), takes=f"one of {', '.join(names)}; {cause}")


def _stem(name: str) -> str:
    """Name of a figure without the ending of a format."""
    return in_formats([name])[0].removesuffix(".png")


def _without_options(
    name_of: Callable[[Any], str],
) -> Callable[[Any, Mapping[str, Any]], tuple[str, dict[str, Any]]]:
    """Default figure of results whose figures have no options, from the function of its name."""
    return lambda result, _: (name_of(result), {})


def _of_contacts() -> _Draws:
    from ehlectric.figures import contact_figure_files as contact

    return _Draws(contact.figure, contact.drawings_of, _without_options(contact.default_name))


def _of_bearings() -> _Draws:
    from ehlectric.figures import bearing_figure_files as bearing

    return _Draws(
        bearing.figure,
        bearing.bearing_figures_of,
        _without_options(bearing.default_name),
        more_names=bearing.names_over_speed,
        save_more=bearing.save_over_speed,
        lacking=bearing.lacking,
    )


def _of_drives() -> _Draws:
    from ehlectric.figures import drive_figures as drive

    # Voltages over time, else how long which voltages last.
    first = _without_options(lambda result: next(iter(drive.drive_figures_of(result))))
    return _Draws(drive.figure, drive.drive_figures_of, first)


def _of_gears() -> _Draws:
    from ehlectric.figures import gear_figures as gear
    from ehlectric.figures.figure_names import GEAR_FLANK_FIGURE

    return _Draws(
        gear.figure,
        gear.gear_figures_of,
        _without_options(lambda _: GEAR_FLANK_FIGURE),
        lacking=gear.lacking,
    )


def _of_axles() -> _Draws:
    from ehlectric.figures import axle_figures as axle
    from ehlectric.figures.figure_names import AXLE_FIGURE

    return _Draws(axle.figure, axle.drawings_of, _without_options(lambda _: AXLE_FIGURE))


def _of_measurements() -> _Draws:
    from ehlectric.figures import measured_figures as measured

    return _Draws(measured.figure, lambda _: [MEASURED_FIGURE], _without_options(lambda _: MEASURED_FIGURE))


def _of_calibrations() -> _Draws:
    from ehlectric.figures import calibration_figures as calibration
    from ehlectric.figures.figure_names import CALIBRATION_FIGURE

    name = _without_options(lambda _: CALIBRATION_FIGURE)
    return _Draws(calibration.figure, lambda _: [CALIBRATION_FIGURE], name)


def _of_motions() -> _Draws:
    from ehlectric.figures import motion_figures as motion

    history = _without_options(lambda _: "motion_history.png")
    return _Draws(motion.figure, motion.drawings_of, history)


def _of_datasets() -> _Draws:
    from ehlectric.motion.stored_run import MotionRun

    return replace(_of_motions(), opened=MotionRun.of)


def _of_sweeps() -> _Draws:
    from ehlectric.figures import sweep_figures as sweep

    return _Draws(
        sweep.figure,
        lambda _: [],
        sweep.default_figure,
        more_names=sweep.default_names,
        completed=sweep.with_axes,
    )


# Functions that draw each kind of result; a dataset is a stored run with moving roughness.
_KINDS: Mapping[ResultKind | Literal["dataset"], Callable[[], _Draws]] = MappingProxyType(
    {
        "contact": _of_contacts,
        "bearing": _of_bearings,
        "drive": _of_drives,
        "gear": _of_gears,
        "axle": _of_axles,
        "motion": _of_motions,
        "dataset": _of_datasets,
        "sweep": _of_sweeps,
        "measurement": _of_measurements,
        "calibration": _of_calibrations,
    }
)


def _draws_of(result: AnyResult) -> _Draws:
    """Functions that draw a result, by its kind. Raises InputError if it is no result."""
    kind = getattr(type(result), "result_kind", None)
    if kind is not None:
        return _KINDS[kind]()
    import xarray as xr

    if isinstance(result, xr.Dataset):
        return _KINDS["dataset"]()
    raise InputError("result", got=shown(type(result).__name__), takes="a result of ehlectric")
