"""The figures of roughness that moves as PNG files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.axes import Axes

from ehlectric.figures.motion.beside import (
    coincidence_text,
    field_beside,
    film_beside,
    pressure_beside,
    roughness_at,
)
from ehlectric.figures.motion.history import largest_field, least_film, places
from ehlectric.figures.motion.maps import map_figure, sampling_text
from ehlectric.figures.motion.panels import name_run, share_below
from ehlectric.figures.names import MOTION_FIGURE_FILES
from ehlectric.figures.style import new_panels, save_figure, style
from ehlectric.motion.record import MotionRun, coincident_frame

if TYPE_CHECKING:
    import xarray as xr


# Width of panels below each other, height of each, and of the title above them [inches].
_WIDTH, _HEIGHT, _TITLE = 7.2, 2.1, 0.75


def history(run: MotionRun) -> Axes:
    """Least film, largest field and its place over time.

    Parameters
    ----------
    run : MotionRun
        What to draw.

    Returns
    -------
    Axes
        The first of three.
    """
    axes = _stack(3)
    for draw, ax in zip((least_film, largest_field, places), axes, strict=True):
        draw(run, ax)
    share_below(axes)
    name_run(axes[0], run)
    return axes[0]


def maps(run: MotionRun) -> Axes:
    """Film, pressure and field over position and time.

    Parameters
    ----------
    run : MotionRun
        With two recorded instants or more.

    Returns
    -------
    Axes
        The first of three.
    """
    ax = map_figure(run)
    name_run(ax, run, sampling_text(run))
    return ax


def beside_stationary(run: MotionRun) -> Axes:
    """Film, pressure, field and roughness at the instant at which the surfaces lie as the case has them.

    Parameters
    ----------
    run : MotionRun
        With such an instant, and the film and field of the same roughness held still.

    Returns
    -------
    Axes
        The first of four.
    """
    axes = _stack(4)
    for draw, ax in zip((film_beside, pressure_beside, field_beside), axes[:3], strict=True):
        draw(run, ax)
    frame = coincident_frame(run)
    assert frame is not None
    roughness_at(run, frame, axes[3])
    share_below(axes)
    name_run(axes[0], run, coincidence_text(run))
    return axes[0]


def save_motion_figures(dataset: xr.Dataset, folder: Path) -> list[Path]:
    """Draw all figures of roughness that moves as PNG files.

    Parameters
    ----------
    dataset : xarray.Dataset
        As a run was stored, whether it is complete or not.
    folder : Path
        Where to; it must be there.

    Returns
    -------
    list of Path
        The files written: no maps of one instant, nothing beside the stationary film where that is not there
        or the surfaces never lie as the case has them.

    Raises
    ------
    InputError
        Where the dataset is no such run.
    """
    run = MotionRun.of(dataset)
    drawn = dict(zip(MOTION_FIGURE_FILES, (history, maps, beside_stationary), strict=True))
    if run.frames < 2:
        del drawn[MOTION_FIGURE_FILES[1]]
    if coincident_frame(run) is None:
        del drawn[MOTION_FIGURE_FILES[2]]
    files = []
    with style():
        for name, draw in drawn.items():
            save_figure(draw(run), folder / name)
            files.append(folder / name)
    return files


def _stack(panels: int) -> Sequence[Axes]:
    return new_panels(panels, 1, (_WIDTH, _HEIGHT * panels + _TITLE))
