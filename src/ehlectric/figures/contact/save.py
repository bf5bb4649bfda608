"""The figures of any result as PNG files."""

from __future__ import annotations

import textwrap
from pathlib import Path

from matplotlib.axes import Axes

from ehlectric.contact.results import PointResult, Result
from ehlectric.figures.contact.line import figures_of
from ehlectric.figures.contact.point import point_figures_of
from ehlectric.figures.style import NOT_CONVERGED, name_over, save_figure, style


def save_figures(result: Result | PointResult, folder: Path) -> list[Path]:
    """Draw all figures as PNG files.

    Parameters
    ----------
    result : Result or PointResult
        What to draw.
    folder : Path
        Where to; it must be there.

    Returns
    -------
    list of Path
        The files written.
    """
    drawn = point_figures_of(result) if isinstance(result, PointResult) else figures_of(result)
    title = textwrap.shorten(result.case.title, 45, placeholder=" ...")
    files = []
    with style():
        for name, draw in drawn.items():
            ax = draw(result)
            _name(ax, result, title)
            save_figure(ax, folder / name)
            files.append(folder / name)
    return files


def _name(ax: Axes, result: Result | PointResult, title: str) -> None:
    """Title of a figure: over its axes, or over all of its panels."""
    converged = result.converged
    text = title if converged else "NOT CONVERGED"
    if isinstance(result, PointResult):
        name_over(ax, text, converged=converged)
    else:
        ax.set_title(text, loc="left", parse_math=False, **({} if converged else NOT_CONVERGED))
