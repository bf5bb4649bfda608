"""Figures of any result: by name, and as files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from ehlectric.bearing.result import BearingResult
from ehlectric.contact.results import PointResult, Result
from ehlectric.errors import ResultWarning
from ehlectric.figures.bearing import save as bearing
from ehlectric.figures.contact import save as contact
from ehlectric.figures.motion import save as motion
from ehlectric.figures.names import in_formats
from ehlectric.figures.style import style as styled
from ehlectric.figures.sweep import save as sweep
from ehlectric.motion.stored_run import MotionRun
from ehlectric.sweep.results import SweepResults

AnyResult = Result | PointResult | BearingResult | xr.Dataset | MotionRun | SweepResults


@dataclass(frozen=True)
class Drawn:
    """Figures of a result as files.

    Attributes
    ----------
    files : tuple of Path
        Files written.
    warnings : tuple of ResultWarning
        Warnings about what the figures leave out.
    """

    files: tuple[Path, ...]
    warnings: tuple[ResultWarning, ...] = ()


def figure(result: AnyResult, name: str, *, style: str = "screen", **options: Any) -> Figure:
    """Figure of a result.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, Dataset, MotionRun or SweepResults
        Result of a contact, bearing, transient contact or sweep.
    name : str
        Name of its file, such as "film.png" of a line contact, or "film" for short; ``figure_names`` lists
        the names.
    style : str
        "screen", or "journal": as wide as one or two columns of a journal (84 or 174 mm), in small type,
        without the title.
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
    with styled(style):
        return _draws_of(result).figure(_opened(result), name, **options)


def figure_names(result: AnyResult) -> list[str]:
    """Names of the figures that a result has.

    The names of figures of a sweep, which depend on a value, and of a bearing over speed are not among them.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, Dataset, MotionRun or SweepResults
        Result of a contact, bearing, transient contact or sweep.

    Returns
    -------
    list of str
        Names for ``figure``.
    """
    return list(_draws_of(result).names(_opened(result)))


def draw_figures(
    result: AnyResult, folder: str | Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> Drawn:
    """Draw all figures of a result as files.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, Dataset, MotionRun or SweepResults
        Result of a contact, bearing, transient contact or sweep.
    folder : str or Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".
    style : str
        "screen", or "journal": as wide as one or two columns of a journal (84 or 174 mm), in small type,
        without the title, which the metadata of the files have in any style.

    Returns
    -------
    Drawn
        Files, and warnings about speeds that the figures of a bearing leave out. There are no figures of a
        sweep here: they need the keys of their axes.

    Raises
    ------
    InputError
        Where there is no such format or style.
    """
    in_formats((), formats)
    with styled(style):
        return _draws_of(result).save(result, Path(folder), formats)


def save_figures(
    result: AnyResult, folder: str | Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> list[Path]:
    """Draw all figures of a result as files.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, Dataset, MotionRun or SweepResults
        Result of a contact, bearing, transient contact or sweep.
    folder : str or Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".
    style : str
        "screen", or "journal": as wide as one or two columns of a journal (84 or 174 mm), in small type,
        without the title, which the metadata of the files have in any style.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        Where there is no such format or style.
    """
    return list(draw_figures(result, folder, formats, style).files)


@dataclass(frozen=True)
class _Draws:
    """Functions that draw one kind of result: a figure by name, the names, and all figures as files."""

    figure: Callable[..., Figure]
    names: Callable[[Any], Any]
    save: Callable[[Any, Path, Sequence[str]], Drawn]


def _save_contact(result: Result | PointResult, folder: Path, formats: Sequence[str]) -> Drawn:
    return Drawn(tuple(contact.save_figures(result, folder, formats)))


def _save_bearing(result: BearingResult, folder: Path, formats: Sequence[str]) -> Drawn:
    files = bearing.save_bearing_figures(result, folder, formats)
    over_speed, left_out = bearing.save_over_speed(result, folder, formats)
    return Drawn((*files, *over_speed), tuple(left_out))


def _save_motion(result: xr.Dataset | MotionRun, folder: Path, formats: Sequence[str]) -> Drawn:
    dataset = result.dataset if isinstance(result, MotionRun) else result
    return Drawn(tuple(motion.save_motion_figures(dataset, folder, formats)))


_CONTACT = _Draws(contact.figure, contact.drawings_of, _save_contact)
_MOTION = _Draws(motion.figure, motion.drawings_of, _save_motion)
_DRAWS: dict[type, _Draws] = {
    Result: _CONTACT,
    PointResult: _CONTACT,
    BearingResult: _Draws(bearing.figure, bearing.bearing_figures_of, _save_bearing),
    xr.Dataset: _MOTION,
    MotionRun: _MOTION,
    SweepResults: _Draws(sweep.figure, lambda _results: (), lambda _results, _folder, _formats: Drawn(())),
}


def _draws_of(result: AnyResult) -> _Draws:
    """Functions that draw a result, by its type."""
    return next(draws for kind, draws in _DRAWS.items() if isinstance(result, kind))


def _opened(result: AnyResult) -> AnyResult:
    """Result, with the dataset of a transient contact as a run."""
    return MotionRun.of(result) if isinstance(result, xr.Dataset) else result
