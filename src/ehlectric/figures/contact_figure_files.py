"""Figures of stationary contacts: by name, and as files."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.contact.result import PointResult, Result
from ehlectric.figures.contact_findings import finding
from ehlectric.figures.figure_names import in_formats
from ehlectric.figures.line_figures import figures_of
from ehlectric.figures.point_figures import point_figures_of
from ehlectric.figures.style import drawing_of, figure_of, name_over, save_figure, style

# Empty edge above and below the maps [inches].
_EDGE = 0.06


def drawings_of(result: Result | PointResult) -> dict[str, Callable[..., Axes]]:
    """Functions that draw the figures of a contact, by the names of their files.

    The roughness is among them where a surface is rough.
    """
    return point_figures_of(result) if isinstance(result, PointResult) else figures_of(result)


def figure(result: Result | PointResult, name: str) -> Figure:
    """Figure of a contact. Raises InputError where the result has no figure of this name."""
    draw = drawing_of(drawings_of(result), name)
    with style():
        ax = draw(result)
        _name(ax, result, name)
        # Only maps have axes of equal scale.
        if ax.get_aspect() != "auto":
            _fit_height(figure_of(ax))
    return figure_of(ax)


def save_figures(result: Result | PointResult, folder: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Draw all figures of a contact as files."""
    return [
        file
        for name in drawings_of(result)
        for file in save_figure(figure(result, name), folder / name, formats)
    ]


def _name(ax: Axes, result: Result | PointResult, name: str) -> None:
    """Draw the title over all panels of a figure: the finding, and below it the title of the case."""
    (file,) = in_formats([name])
    title = textwrap.shorten(result.case.title, 90, placeholder=" ...")
    first = finding(result, file) if result.converged else "NOT CONVERGED"
    name_over(ax, "\n".join(filter(None, [first, title])), converged=result.converged)


def _fit_height(figure: Figure) -> None:
    """Make a figure of maps as high as what is drawn on it.

    Axes of equal scale need less height than the page has where a legend or a colour bar takes width.
    """
    figure.draw_without_rendering()
    needed = figure.get_tightbbox()
    height = float(needed.height) + 2.0 * _EDGE
    if height < figure.get_figheight():
        figure.set_figheight(height)
