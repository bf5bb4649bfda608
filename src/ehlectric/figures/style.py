"""What all figures share: style, colours, axes, units of axes and labels."""

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

# How the title of what is no solution is written.
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
    """What has a half-width for its positions: a result, or a run of roughness that moves."""

    @property
    def conditions(self) -> Conditions | PointConditions:
        """Those of the contact."""
        ...


@contextmanager
def style() -> Iterator[None]:
    """Context in which figures have the package's sizes of text and lines.

    The settings of matplotlib belong to the whole process and are restored at the end. Threads that draw
    take turns, so that none restores the settings of another.
    """
    with _turn, mpl.rc_context(_STYLE), warnings.catch_warnings():  # type: ignore[arg-type]
        # A title may use letters that the font does not have.
        warnings.filterwarnings("ignore", message="Glyph .* missing")
        yield


def new_panels(rows: int, columns: int, size: tuple[float, float]) -> list[Axes]:
    """Axes of a new figure of a size in inches, row by row."""
    figure = Figure(figsize=size)
    FigureCanvasAgg(figure)
    return list(figure.subplots(rows, columns, squeeze=False).ravel())


def axes_or_new(ax: Axes | None) -> Axes:
    """The axes given, or those of a new figure."""
    return new_panels(1, 1, (6.3, 3.4))[0] if ax is None else ax


def figure_of(ax: Axes) -> Figure:
    """The whole figure that axes are part of."""
    figure = ax.get_figure(root=True)
    assert figure is not None
    return figure


def name_over(ax: Axes, text: str, *, converged: bool = True) -> None:
    """Title over all panels of a figure, in red where what it shows is no solution."""
    how: dict[str, Any] = {} if converged else NOT_CONVERGED
    figure_of(ax).suptitle(text, x=0.01, ha="left", size=9.0, parse_math=False, **how)


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure as a PNG file, whole or not at all."""
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
    ehlectric.errors.InputError: figure: got 'field.png', takes one of film.png
    """
    if name not in drawings:
        raise InputError("figure", got=shown(name), takes=f"one of {', '.join(drawings)}")
    return drawings[name]


def legend_above(ax: Axes, handles: Sequence[Artist] | None = None, columns: int = 2) -> None:
    """Legend above the axes, where no data are, of these or of all that is labelled."""
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
    """Positions in half-widths."""
    return x / result.conditions.half_width


def label_position(result: OfContact, ax: Axes, axis: str = "x") -> None:
    """Label of a horizontal axis of positions in half-widths, with the half-width."""
    factor, unit = unit_for(result.conditions.half_width, "m", least=1.0)
    ax.set_xlabel(f"${axis}/b$   ($b$ = {factor * result.conditions.half_width:.4g} {unit})")
