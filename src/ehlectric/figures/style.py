"""Style, colours, new axes, titles, legends and position axes of all figures."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any, Protocol, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.text import Annotation
from matplotlib.textpath import text_to_path
from matplotlib.transforms import offset_copy

from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.errors import InputError, printable, shown
from ehlectric.figures.names import STYLES, in_formats, with_units_kept
from ehlectric.quantities.palette import GREY
from ehlectric.runtime.files import write
from ehlectric.runtime.parallel.threads import Turn

D = TypeVar("D")

# Text properties of the title of a figure whose result is not converged.
NOT_CONVERGED: dict[str, Any] = {"color": "red", "weight": "bold"}

# Metadata of a file of each format. Without a date, two runs of a case write the same bytes.
_WITHOUT_DATE: Mapping[str, dict[str, Any]] = {
    "png": {},
    "svg": {"Date": None},
    "pdf": {"CreationDate": None},
}


@dataclass(frozen=True)
class _Look:
    """Look of figures: settings of matplotlib, and how large they are on the page.

    Attributes
    ----------
    settings : dict
        Settings of matplotlib.
    titled : bool
        Whether titles are drawn. They are in the metadata of the file in any case.
    columns : tuple of float, optional
        Widths of a figure in one column and across two columns of a page [inches]; as drawn if None.
    height : float
        Ratio of the height of a figure in one column to its height on the screen.
    """

    settings: Mapping[str, Any]
    titled: bool = True
    columns: tuple[float, float] | None = None
    height: float = 1.0


_SCREEN: dict[str, Any] = {
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "legend.fontsize": 8.0,
    "lines.linewidth": 1.2,
    "axes.linewidth": 0.7,
    "hatch.linewidth": 0.6,
    "savefig.dpi": 300,
    "figure.constrained_layout.use": True,
    # Fonts are embedded in PDF as TrueType, which keeps their text; in SVG, letters are drawn as paths, which
    # look the same on machines without the font. The salt makes the names inside an SVG file repeatable.
    "pdf.fonttype": 42,
    "svg.fonttype": "path",
    "svg.hashsalt": "ehlectric",
}
_JOURNAL: dict[str, Any] = _SCREEN | {
    "font.size": 8.0,
    "axes.labelsize": 8.0,
    "axes.titlesize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "lines.linewidth": 0.8,
    "lines.markersize": 4.2,
    "axes.linewidth": 0.5,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "hatch.linewidth": 0.4,
    "savefig.dpi": 600,
}
_LOOKS: Mapping[str, _Look] = {
    "screen": _Look(_SCREEN),
    "journal": _Look(_JOURNAL, titled=False, columns=(84.0 / 25.4, 174.0 / 25.4), height=0.75),
}
assert tuple(_LOOKS) == STYLES

# Width on the screen above which a figure takes two columns of a journal [inches].
_ONE_COLUMN = 6.5

# Sizes of the first line of a title and of the others [pt], and part of the page's width that they may take.
_FINDING, _BELOW, _FULL = 10.0, 8.5, 0.97

_turn = Turn()
_style: ContextVar[str] = ContextVar("style", default="screen")


class OfContact(Protocol):
    """Object with the conditions of a contact: a result, or a run with moving roughness."""

    @property
    def conditions(self) -> Conditions | PointConditions:
        """Conditions of the contact, of which the half-width [m] is used."""
        ...


@contextmanager
def style(name: str | None = None) -> Iterator[None]:
    """Context manager in which figures have the text sizes, line widths and page sizes of a style.

    The settings of matplotlib belong to the whole process and are restored at the end. Threads that draw
    take turns, so that none restores the settings of another.

    Parameters
    ----------
    name : str, optional
        Name of the style, "screen" or "journal"; the style of the context around this one if omitted, which
        is "screen" outside of any.

    Raises
    ------
    InputError
        Where there is no style of this name.
    """
    name = _style.get() if name is None else name
    if name not in _LOOKS:
        raise InputError("style", got=shown(name), takes=f"one of {', '.join(_LOOKS)}")
    with _turn.taken(), mpl.rc_context(_LOOKS[name].settings), warnings.catch_warnings():  # type: ignore[arg-type]
        # The title of a case may contain characters that the font lacks.
        warnings.filterwarnings("ignore", message="Glyph .* missing")
        token = _style.set(name)
        try:
            yield
        finally:
            _style.reset(token)


def page_width(width: float) -> float:
    """Width of a figure in the style that is in use, from its width on the screen [inches]."""
    columns = _LOOKS[_style.get()].columns
    return width if columns is None else columns[width > _ONE_COLUMN]


def page_size(size: tuple[float, float]) -> tuple[float, float]:
    """Width and height of a figure in the style that is in use, from those on the screen [inches]."""
    width = page_width(size[0])
    return width, size[1] * (_LOOKS[_style.get()].height if width < 0.75 * size[0] else 1.0)


def new_panels(rows: int, columns: int, size: tuple[float, float], *, exact: bool = False) -> list[Axes]:
    """Axes of a new figure, row by row.

    Parameters
    ----------
    rows, columns : int
        Rows and columns of the panels.
    size : tuple of float
        Width and height of the figure on the screen [inches]; in the style "journal" it is as wide as one or
        two columns.
    exact : bool
        Whether the size is that of the figure in any style.

    Returns
    -------
    list of Axes
        Axes of the panels.
    """
    figure = Figure(figsize=size if exact else page_size(size))
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
    """Write a title over all panels of a figure: its first line, the finding, larger than the others.

    In the style "journal" the title is not drawn, because a caption says it. The metadata of the file has it
    in every style. Where the result is not converged, its first line is drawn in every style.

    Parameters
    ----------
    ax : Axes
        Axes of one of the panels.
    text : str
        Lines of the title. Long lines are broken.
    converged : bool
        Whether the result is converged. If it is not, the first line is bold and red.
    """
    figure = figure_of(ax)
    text = "\n".join(map(printable, text.split("\n")))
    figure.set_label(text.replace("\n", ". "))
    first, *others = with_units_kept(text).split("\n")
    if not _LOOKS[_style.get()].titled:
        if converged:
            return
        others = []
    finding = _broken(figure, first, _FINDING)
    below = [part for line in others for part in _broken(figure, line, _BELOW)]
    how: dict[str, Any] = {} if converged else NOT_CONVERGED
    # Empty lines keep the room for the smaller ones, which are drawn beside them.
    lines = "\n".join([*finding, *(" " for _ in below)])
    title = figure.suptitle(lines, x=0.01, ha="left", size=_FINDING, parse_math=False, **how)
    if below:
        figure.add_artist(
            Annotation(
                "\n".join(below),
                (0.0, 0.0),
                xycoords=title,
                va="bottom",
                size=_BELOW,
                color=GREY,
                parse_math=False,
            )
        )


def _broken(figure: Figure, line: str, size: float) -> list[str]:
    """Parts of a line of text, each of which fits into the width of a figure; letters in points."""
    room = _FULL * 72.0 * figure.get_figwidth()
    letters, parts = FontProperties(size=size), [""]
    for word in filter(None, line.split(" ")):
        longer = f"{parts[-1]} {word}".lstrip()
        width, _, _ = text_to_path.get_text_width_height_descent(longer, letters, ismath=False)
        if width > room and parts[-1]:
            parts.append(word)
        else:
            parts[-1] = longer
    return parts


def titled(ax: Axes, title: str, *, converged: bool) -> Figure:
    """Figure of axes with a title over all of its panels, whose first line says if it is not converged.

    Parameters
    ----------
    ax : Axes
        Axes of one of the panels.
    title : str
        Lines of the title; a converged result may have none.
    converged : bool
        Whether the result is converged.

    Returns
    -------
    Figure
        The figure.
    """
    text = title if converged else f"NOT CONVERGED\n{title}"
    if text:
        name_over(ax, text, converged=converged)
    return figure_of(ax)


def share_below(axes: Sequence[Axes]) -> None:
    """Remove the labels of the common axis from all stacked panels but the lowest."""
    for ax in axes[:-1]:
        ax.set_xlabel("")
        ax.tick_params(labelbottom=False)
    figure_of(axes[0]).align_ylabels(axes)


def save_figure(figure: Figure, path: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Write a figure as a file of each format; an interrupted write leaves no partial file.

    Parameters
    ----------
    figure : Figure
        Figure to write.
    path : Path
        Path of the PNG file; the other files have its name with the ending of their format.
    formats : sequence of str
        Formats, of "png", "svg" and "pdf".

    Returns
    -------
    list of Path
        Files written. The title of the figure is in their metadata, and no date.

    Raises
    ------
    InputError
        Where there is no format of this name, or a file cannot be written, as on a full disk.
    """
    files = [path.parent / name for name in in_formats([path.name], formats)]
    for file in files:
        kind = file.suffix[1:]
        metadata = _WITHOUT_DATE[kind] | {"Title": figure.get_label() or printable(path.stem)}
        content = BytesIO()  # in memory: the libraries of images do not say why they cannot write
        with style():
            figure.savefig(content, format=kind, metadata=metadata)
        write(file, content.getvalue())
    return files


def drawing_of(drawings: Mapping[str, D], name: str) -> D:
    """Entry of a table of drawings by its name, with or without the ending of a format.

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
    (file,) = in_formats([name])
    if file not in drawings:
        raise InputError("figure", got=shown(name), takes=f"one of {', '.join(drawings)}")
    return drawings[file]


def legend_above(
    ax: Axes, handles: Sequence[Any] | None = None, columns: int = 2, *, lift: float = 0.0, **options: Any
) -> None:
    """Place a legend above the axes, of the given artists, or of all that have a label.

    Parameters
    ----------
    ax : Axes
        Axes of the legend.
    handles : sequence of Artist or tuple of Artist, optional
        Artists in the legend, those of a tuple drawn over each other; all that have a label if omitted.
    columns : int
        Columns of the legend; fewer where the page is too narrow for them.
    lift : float
        Height of the legend above the axes [pt], which leaves room for an axis on top of them.
    **options
        Further options of a legend of matplotlib.
    """
    entries: list[Any] = ax.get_legend_handles_labels()[0] if handles is None else list(handles)
    labels = options.get("labels") or [str(entry.get_label()) for entry in entries]
    ax.legend(
        handles=entries,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        bbox_transform=offset_copy(ax.transAxes, figure_of(ax), y=lift, units="points"),
        borderaxespad=0.3,
        borderpad=0.2,
        ncols=_fitting(labels, columns, 0.84 * 72.0 * figure_of(ax).get_figwidth() / _side_by_side(ax)),
        frameon=False,
        handlelength=2.2,
        columnspacing=1.4,
        **options,
    )


def _fitting(labels: Sequence[str], columns: int, room: float) -> int:
    """Number of columns of a legend with these labels, at most ``columns``, that fit into ``room`` [pt]."""
    size = FontProperties(size=mpl.rcParams["legend.fontsize"]).get_size_in_points()
    for number in range(columns, 1, -1):
        of_columns = [column for column in np.array_split(np.array(labels), number) if column.size]
        # A letter is about half as wide as its size; the handle and the space around it take eight letters.
        if sum(0.52 * size * (8.0 + max(map(len, column))) for column in of_columns) <= room:
            return number
    return 1


def _side_by_side(ax: Axes) -> int:
    """Number of axes side by side in the figure of some axes."""
    spec = ax.get_subplotspec()
    return 1 if spec is None else int(spec.get_gridspec().ncols)
