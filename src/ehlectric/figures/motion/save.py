"""Figures of transient contacts: by name, and as files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.figures.motion import findings
from ehlectric.figures.motion.beside import (
    compared_frame,
    field_beside,
    film_beside,
    instant_text,
    pressure_beside,
    roughness_at,
)
from ehlectric.figures.motion.history import asperities, largest_field, least_film, places, places_vary
from ehlectric.figures.motion.maps import map_figure, sampling_text
from ehlectric.figures.motion.panels import name_run, share_below
from ehlectric.figures.style import drawing_of, figure_of, new_panels, save_figure, style
from ehlectric.motion.asperities import TouchHistory
from ehlectric.motion.stored_run import MotionRun, coincident_frame

if TYPE_CHECKING:
    import xarray as xr


# Width of stacked panels, height of each of them, and height of the title above them [inches].
_WIDTH, _HEIGHT, _TITLE = 7.2, 2.1, 0.75


def history(run: MotionRun) -> Axes:
    """Draw minimum film thickness, maximum field strength and their places over time, and asperities.

    Parameters
    ----------
    run : MotionRun
        The run to draw.

    Returns
    -------
    Axes
        The first of three panels, or of two where the places do not change; one more where surfaces touch.
    """
    touching = (asperities,) if TouchHistory.of(run) is not None else ()
    panels = (least_film, *touching, largest_field, *((places,) if places_vary(run) else ()))
    axes = _stack(len(panels))
    for draw, ax in zip(panels, axes, strict=True):
        draw(run, ax)
    share_below(axes)
    name_run(axes[0], run, findings.of_history(run), findings.field_line(run))
    return axes[0]


def maps(run: MotionRun) -> Axes:
    """Draw film, pressure and field over position and time.

    Parameters
    ----------
    run : MotionRun
        A run with at least two recorded instants.

    Returns
    -------
    Axes
        The first of three panels.
    """
    ax = map_figure(run)
    name_run(ax, run, findings.of_maps(run), sampling_text(run))
    return ax


def beside_stationary(run: MotionRun) -> Axes:
    """Compare moving with stationary roughness at the instant of the largest difference in minimum film.

    Parameters
    ----------
    run : MotionRun
        A run that reaches the instant at which the surfaces are at their positions in the case, with film and
        field of stationary roughness.

    Returns
    -------
    Axes
        The first of four panels: film, pressure, field and roughness.
    """
    axes = _stack(4)
    for draw, ax in zip((film_beside, pressure_beside, field_beside), axes[:3], strict=True):
        draw(run, ax)
    frame = compared_frame(run)
    assert frame is not None
    roughness_at(run, frame, axes[3], stationary=coincident_frame(run))
    share_below(axes)
    name_run(axes[0], run, findings.of_comparison(run, frame), instant_text(run))
    return axes[0]


FIGURES: Mapping[str, Callable[[MotionRun], Axes]] = {
    "motion_history.png": history,
    "motion_maps.png": maps,
    "motion_beside_stationary.png": beside_stationary,
}


def drawings_of(run: MotionRun) -> dict[str, Callable[[MotionRun], Axes]]:
    """Functions that draw the figures of a transient run, by the names of their files.

    There are no maps where a single instant is recorded, and no comparison with stationary roughness where
    its film is missing or the surfaces never lie where the case puts them.
    """
    empty = [maps] if run.frames < 2 else []
    empty += [beside_stationary] if coincident_frame(run) is None else []
    return {name: draw for name, draw in FIGURES.items() if draw not in empty}


def figure(run: MotionRun, name: str) -> Figure:
    """Figure of a transient run.

    Parameters
    ----------
    run : MotionRun
        The run to draw.
    name : str
        Name of its file, such as "motion_history.png".

    Returns
    -------
    Figure
        The figure, with its title.

    Raises
    ------
    InputError
        Where the run has no figure of this name.
    """
    draw = drawing_of(drawings_of(run), name)
    with style():
        return figure_of(draw(run))


def save_motion_figures(dataset: xr.Dataset, folder: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Draw all figures of a transient run as files.

    Parameters
    ----------
    dataset : xarray.Dataset
        A run, complete or not, as ``read_motion`` gives it.
    folder : Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".

    Returns
    -------
    list of Path
        Files written: those of ``drawings_of``, in each format.

    Raises
    ------
    InputError
        Where the dataset is not a run of moving roughness.
    """
    run = MotionRun.of(dataset)
    return [
        file for name in drawings_of(run) for file in save_figure(figure(run, name), folder / name, formats)
    ]


def _stack(panels: int) -> Sequence[Axes]:
    """Axes of panels below each other."""
    return new_panels(panels, 1, (_WIDTH, _HEIGHT * panels + _TITLE))
