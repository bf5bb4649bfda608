"""Style, colours, new axes, titles, legends and position axes of all figures."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol, TypeVar

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ehlectric.arrays import Array
from ehlectric.cases.quantity import unit_for
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.errors import InputError, shown
from ehlectric.runtime.files import whole

D = TypeVar("D")

# Colours that stay apart in print and for colour-blind readers (Okabe and Ito).
BLUE, ORANGE, GREEN, GREY = "#0072b2", "#d55e00", "#009e73", "#555555"
BODY, OIL = "#c9ced6", "#fff1cc"

# Text properties of the title of a figure whose result is not converged.
NOT_CONVERGED: dict[str, Any] = {"color": "red", "weight": "bold"}
_STYLE: dict[str, Any] = {
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "legend.fontsize": 8.0,
    "lines.linewidth": 1.2,
    "axes.linewidth": 0.7,
    "hatch.linewidth": 0.6,
    "savefig.dpi": 300,
    "figure.constrained_layout.use": True,
}

_turn = threading.RLock()


class OfContact(Protocol):
    """Object with the conditions of a contact: a result, or a run with moving roughness."""

    @property
    def conditions(self) -> Conditions | PointConditions:
        """Conditions of the contact, of which the half-width [m] is used."""
        ...


@contextmanager
def style() -> Iterator[None]:
    """Context manager in which figures have the package's text sizes and line widths.

    The settings of matplotlib belong to the whole process and are restored at the end. Threads that draw
    take turns, so that none restores the settings of another.
    """
    with _turn, mpl.rc_context(_STYLE), warnings.catch_warnings():  # type: ignore[arg-type]
        # The title of a case may contain characters that the font lacks.
        warnings.filterwarnings("ignore", message="Glyph .* missing")
        yield


def new_panels(rows: int, columns: int, size: tuple[float, float]) -> list[Axes]:
    """Axes of a new figure of size (width, height) [inches], row by row."""
    figure = Figure(figsize=size)
    FigureCanvasAgg(figure)
    return list(figure.subplots(rows, columns, squeeze=False).ravel())


def axes_or_new(ax: Axes | None) -> Axes:
    """``ax`` itself, or the axes of a new figure where ``ax`` is None."""
    return new_panels(1, 1, (6.3, 3.4))[0] if ax is None else ax


def figure_of(ax: Axes) -> Figure:
    """The figure that the axes belong to, also where they are in a subfigure."""
    figure = ax.get_figure(root=True)
    assert figure is not None
    return figure


def name_over(ax: Axes, text: str, *, converged: bool = True) -> None:
    """Write a title over all panels of a figure, in bold red where the result is not converged."""
    how: dict[str, Any] = {} if converged else NOT_CONVERGED
    figure_of(ax).suptitle(text, x=0.01, ha="left", size=9.0, parse_math=False, **how)


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure as a PNG file; an interrupted write leaves no partial file."""
    with style(), whole(path) as beside:
        figure.savefig(beside)


def drawing_of(drawings: Mapping[str, D], name: str) -> D:
    """Entry of a table of drawings by its name.

    Raises
    ------
    InputError
        Where the result has no figure of this name.

    Examples
    --------
    >>> drawing_of({"film.png": 1}, "field.png")
    Traceback (most recent call last):
    ehlectric.errors.InputError: figure: got 'field.png'; expected one of film.png
    """
    if name not in drawings:
        raise InputError("figure", got=shown(name), takes=f"one of {', '.join(drawings)}")
    return drawings[name]


def legend_above(ax: Axes, handles: Sequence[Artist] | None = None, columns: int = 2) -> None:
    """Place a legend above the axes, of the given artists, or of all that have a label."""
    ax.legend(
        handles=ax.get_legend_handles_labels()[0] if handles is None else list(handles),
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        borderaxespad=0.3,
        borderpad=0.2,
        ncols=columns,
        frameon=False,
        handlelength=2.2,
        columnspacing=1.4,
    )


def in_half_widths(result: OfContact, x: Array) -> Array:
    """Positions [m] divided by the half-width of the contact."""
    return x / result.conditions.half_width


def label_position(result: OfContact, ax: Axes, axis: str = "x") -> None:
    """Label the horizontal axis with x/b or y/b, and with the value of the half-width b."""
    factor, unit = unit_for(result.conditions.half_width, "m", least=1.0)
    ax.set_xlabel(f"${axis}/b$   ($b$ = {factor * result.conditions.half_width:.4g} {unit})")
