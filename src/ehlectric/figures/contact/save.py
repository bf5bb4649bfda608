"""Figures of stationary contacts: by name, and as files."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.contact.results import PointResult, Result
from ehlectric.figures.contact.line import figures_of
from ehlectric.figures.contact.point import point_figures_of
from ehlectric.figures.style import drawing_of, figure_of, name_over, save_figure, style


def drawings_of(result: Result | PointResult) -> dict[str, Callable[..., Axes]]:
    """Functions that draw the figures of a contact, by the names of their files.

    The roughness is among them where a surface is rough.
    """
    return point_figures_of(result) if isinstance(result, PointResult) else figures_of(result)


def figure(result: Result | PointResult, name: str) -> Figure:
    """Figure of a contact.

    Parameters
    ----------
    result : Result or PointResult
        Result of the contact.
    name : str
        Name of its file, such as "film.png".

    Returns
    -------
    Figure
        The figure, with its title.

    Raises
    ------
    InputError
        Where the result has no figure of this name.
    """
    draw = drawing_of(drawings_of(result), name)
    with style():
        ax = draw(result)
        _name(ax, result)
    return figure_of(ax)


def save_figures(result: Result | PointResult, folder: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Draw all figures of a contact as files.

    Parameters
    ----------
    result : Result or PointResult
        Result of the contact.
    folder : Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".

    Returns
    -------
    list of Path
        Files written.
    """
    return [
        file
        for name in drawings_of(result)
        for file in save_figure(figure(result, name), folder / name, formats)
    ]


def _name(ax: Axes, result: Result | PointResult) -> None:
    """Draw the title of a figure over all of its panels."""
    title = textwrap.shorten(result.case.title, 90, placeholder=" ...")
    name_over(ax, title if result.converged else f"NOT CONVERGED\n{title}", converged=result.converged)
