"""Style, colours, titles, legends, ticks and position axes of all figures."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from functools import lru_cache
from io import BytesIO
from pathlib import Path
from typing import Any, Literal, Protocol, TypeVar, cast

import matplotlib as mpl
import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, ListedColormap, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patheffects import AbstractPathEffect
from matplotlib.text import Annotation
from matplotlib.textpath import text_to_path
from matplotlib.ticker import (
    FixedLocator,
    FuncFormatter,
    MaxNLocator,
    NullFormatter,
    NullLocator,
    ScalarFormatter,
)
from matplotlib.transforms import Bbox, offset_copy

from ehlectric.arrays import Array
from ehlectric.contact import Conditions, PointConditions
from ehlectric.errors import InputError, printable, shown
from ehlectric.figures.fallback_fonts import give_fonts
from ehlectric.figures.figure_names import STYLES, in_formats, with_units_kept
from ehlectric.figures.tones import Outline, exchange_colours
from ehlectric.quantities.palette import BLACK, DARK, GREY, RED, WHITE, legible
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable
from ehlectric.runtime.files import write
from ehlectric.runtime.threads import Turn, local_filters
from ehlectric.runtime.undrawn import drawing

D = TypeVar("D")

# Text properties of the title of a figure whose result is not converged.
NOT_CONVERGED: dict[str, Any] = {"color": RED, "weight": "bold"}

# Metadata of a file of each format. Without a date, two runs of a case write the same bytes.
_WITHOUT_DATE: Mapping[str, dict[str, Any]] = {
    "png": {},
    "svg": {"Date": None},
    "pdf": {"CreationDate": None},
}


@dataclass(frozen=True)
class _Look:
    """Look of figures: settings of matplotlib, and how large they are on the page."""

    settings: Mapping[str, Any]
    titled: bool = True  # whether titles are drawn. They are in the metadata of the file in any case
    # Widths of a figure in one column and across two columns of a page [inches]; as drawn if None.
    columns: tuple[float, float] | None = None
    height: float = 1.0  # ratio of the height of a figure in one column to its height on the screen
    stacked: float = 1.0  # the same ratio of the panels of a figure that stand below each other in one column
    tones: Mapping[str, str] = field(default_factory=dict)  # colours by their colours on paper


def _settings(name: str) -> dict[str, Any]:
    """Settings of matplotlib of a style sheet of this folder."""
    sheet = Path(__file__).with_name(f"{name}.mplstyle")
    return dict(mpl.rc_params_from_file(sheet, use_default_template=False).items())


# Widths of one column and of two columns of a journal, and largest height of a figure [inches].
_COLUMNS, _PAGE = (84.0 / 25.4, 174.0 / 25.4), 234.0 / 25.4

_SCREEN = _settings("screen")
_LOOKS: Mapping[str, _Look] = {
    "screen": _Look(_SCREEN),
    "journal": _Look(
        _SCREEN | _settings("journal"), titled=False, columns=_COLUMNS, height=0.75, stacked=0.65
    ),
    "dark": _Look(_SCREEN | _settings("dark"), tones=DARK),
}
assert tuple(_LOOKS) == STYLES

# Width on the screen above which a figure takes two columns of a journal [inches].
_COLUMN_LIMIT = 6.5

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
    """Context manager in which figures use the text sizes, line widths and page sizes of a style.

    Each style starts from the defaults of matplotlib: a matplotlibrc of the user changes no figure. The
    settings of matplotlib belong to the whole process and are restored at the end. Threads that draw
    wait for each other, so that none restores the settings of another.

    ``name``, name of the style, "screen", "journal" or "dark"; the style of the context around this one if
    omitted, which is "screen" outside of any. Raises InputError where there is no style of this name.
    """
    name = _style.get() if name is None else name
    if name not in _LOOKS:
        raise InputError("style", got=shown(name), takes=f"one of {', '.join(_LOOKS)}")
    with _turn.taken(), mpl.rc_context(), local_filters():
        _set_all(_LOOKS[name].settings)
        # A note names characters that no font has, see fallback_fonts.py.
        warnings.filterwarnings("ignore", message="Glyph .* missing")
        token = _style.set(name)
        try:
            yield
        finally:
            _style.reset(token)


def _set_all(settings: Mapping[str, Any]) -> None:
    """Set all settings of matplotlib that belong to figures: to these values, and else to their defaults."""
    program = mpl.rcParams[
        "animation.ffmpeg_path"
    ]  # it names a program of the machine, and belongs to no look
    mpl.rcdefaults()
    mpl.rcParams.update(cast("Any", {**settings, "animation.ffmpeg_path": program}))


def page_width(width: float, panels: int = 1) -> float:
    """Width of a figure in the style that is in use, from its width on the screen [inches].

    Panels next to each other take two columns of a journal.
    """
    columns = _LOOKS[_style.get()].columns
    return width if columns is None else columns[width > _COLUMN_LIMIT or panels > 1]


def page_size(size: tuple[float, float], panels: int = 1) -> tuple[float, float]:
    """Width and height of a figure in the style that is in use, from those on the screen [inches]."""
    width = page_width(size[0], panels)
    return width, size[1] * (_LOOKS[_style.get()].height if width < 0.75 * size[0] else 1.0)


def new_panels(rows: int, columns: int, size: tuple[float, float], *, exact: bool = False) -> list[Axes]:
    """Axes of a new figure, row by row. ``size``, width and height of the figure on the screen [inches].

    In the style "journal", panels side by side stand below each other in one column, if they fit on the
    page.
    """
    look = _LOOKS[_style.get()]
    stacked = (size[0] / columns, size[1] * columns * look.stacked)
    if look.columns and columns > 1 and not exact and stacked[1] <= _PAGE:
        rows, columns, size, exact = rows * columns, 1, (page_width(stacked[0]), stacked[1]), True
    figure = new_figure(size if exact else page_size(size, columns))
    return list(figure.subplots(rows, columns, squeeze=False).ravel())


def new_figure(size: tuple[float, float]) -> Figure:
    """Empty figure of a width and height [inches], with the colours of the style that is in use."""
    figure = _StyledFigure(_style.get(), size)
    FigureCanvasAgg(figure)
    return figure


class _StyledFigure(Figure):
    """Figure that is drawn with the settings of its style, also outside of the context of the style.

    Matplotlib makes ticks and measures texts only when it draws a figure. The settings of a notebook would
    change them.
    """

    def __init__(self, name: str, size: tuple[float, float]) -> None:
        super().__init__(figsize=size)
        self._look = name

    def draw(self, renderer: Any) -> None:
        """Draw the figure, in the colours of its page."""
        with style(self._look):
            give_fonts(self)
            if tones := _LOOKS[self._look].tones:
                exchange_colours(self, tones)
            super().draw(renderer)


def outlined(width: float, colour: str = WHITE) -> list[AbstractPathEffect]:
    """Edge of a line or text [pt], which keeps it visible on any colour."""
    return [cast("AbstractPathEffect", Outline(width, colour))]


def text_colour(colour: str) -> str:
    """Shade of a colour of a line in which its name can be read in the style that is in use."""
    tones = _LOOKS[_style.get()].tones
    return legible(tones.get(colour, colour), tones.get(WHITE, WHITE))


def note(
    ax: Axes,
    x: float,
    y: float,
    text: str,
    *,
    data_axis: str = "",
    fontsize: float | str = "small",
    color: str = BLACK,
    **look: Any,
) -> None:
    """Write a small text at a place in parts of the axes; along ``data_axis``, "x" or "y", in data units."""
    look["color"] = text_colour(color)
    places = {"": ax.transAxes, "x": ax.get_xaxis_transform(), "y": ax.get_yaxis_transform()}
    ax.text(x, y, text, transform=places[data_axis], fontsize=fontsize, **look)


class _Inside(Annotation):
    """Text next to a point, which changes to the other side of it where it would leave the axes."""

    def draw(self, renderer: Any) -> None:
        """Draw the text on the side of its point where there is room."""
        ax = self.axes
        assert ax is not None
        box, place = self.get_window_extent(renderer), self.xyann
        if box.x1 > ax.bbox.x1 or box.x0 < ax.bbox.x0:
            other = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}
            self.xyann = (-place[0], -place[1])
            self.set(**{way: other.get(at := getattr(self, f"get_{way}")(), at) for way in ("ha", "va")})
        super().draw(renderer)


def label_point(
    ax: Axes, at: tuple[float, float], text: str, offset: tuple[float, float], **look: Any
) -> None:
    """Write a text next to a point of axes [data units], an offset away from it [pt]; opposite to the offset
    where it would leave the axes otherwise.
    """
    defaults: dict[str, Any] = {"ha": "left", "va": "center", "in_layout": False}
    ax.add_artist(_Inside(text, at, offset, textcoords="offset points", **(defaults | look)))


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

    In the style "journal" the title is not drawn, because a caption says it. The metadata of the file contain
    it in every style. If the result is not converged, its first line is drawn in every style.
    """
    figure = figure_of(ax)
    text = "\n".join(map(printable, text.split("\n")))
    figure.set_label(text.replace("\n", ". "))
    first, *others = with_units_kept(text).split("\n")
    if not _LOOKS[_style.get()].titled:
        if converged:
            return
        others = []
    room = _FULL * 72.0 * figure.get_figwidth()
    finding = _even(first, _FINDING, room)
    below = [part for line in others for part in _even(line, _BELOW, room)]
    how: dict[str, Any] = {} if converged else NOT_CONVERGED
    # Empty lines keep the room for the smaller ones, which are drawn next to them.
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


def broken(line: str, size: float, room: float, *, math: bool = False) -> list[str]:
    """Break a line of text into parts, each of which fits into ``room`` if its words do [pt]; ``math``,
    whether parts between dollar signs are formulas.

    Examples
    --------
    >>> broken("discharges per second, drive end [1/s]", 9.0, 120.0)
    ['discharges per second,', 'drive end [1/s]']
    """
    parts = [""]
    for word in filter(None, line.split(" ")):
        longer = f"{parts[-1]} {word}".lstrip()
        # A formula with a space in it is not whole before its end, and is not broken.
        whole = not math or parts[-1].count("$") % 2 == 0
        if parts[-1] and whole and longer.count("$") % 2 == 0 and _width(longer, size, math=math) > room:
            parts.append(word)
        else:
            parts[-1] = longer
    return parts


def _even(line: str, size: float, room: float) -> list[str]:
    """Parts of a line as ``broken`` makes them, but of about the same length: no word stands alone."""
    parts = broken(line, size, room)
    for narrower in np.linspace(room, 0.5 * room, 26):
        if len(other := broken(line, size, float(narrower))) > len(parts):
            break
        parts = other
    return parts


def _width(text: str, size: float, *, math: bool = False) -> float:
    """Width of a line of text of a size [pt]."""
    family, sans_serif = mpl.rcParams["font.family"], mpl.rcParams["font.sans-serif"]
    return _width_in((*family, *sans_serif), text, size, math=math and "$" in text)


@lru_cache(maxsize=4096)
def _width_in(_fonts: tuple[str, ...], text: str, size: float, *, math: bool) -> float:
    """Width of a line of text of a size [pt]; kept, because a title is broken at many widths.

    The fonts follow Matplotlib's settings: their change makes a new measurement.
    """
    letters = FontProperties(size=size)
    return float(text_to_path.get_text_width_height_descent(text, letters, ismath=math)[0])


def _size_of(setting: str) -> float:
    """Size of the letters of a setting of Matplotlib [pt]."""
    return FontProperties(size=mpl.rcParams[cast("Any", setting)]).get_size_in_points()


def titled(ax: Axes, title: str, *, converged: bool) -> Figure:
    """Figure of axes with a title over all of its panels, whose first line says if it is not converged."""
    text = title if converged else f"NOT CONVERGED\n{title}"
    if text:
        name_over(ax, text, converged=converged)
    return figure_of(ax)


def share_below(axes: Sequence[Axes]) -> None:
    """Remove the labels of the common axis from all stacked panels except the lowest."""
    for ax in axes[:-1]:
        ax.set_xlabel("")
        ax.tick_params(labelbottom=False)
    figure_of(axes[0]).align_ylabels(axes)


def save_figure(figure: Figure, path: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Write a figure as a file of each format; an interrupted write leaves no partial file. Returns files
    written; the title of the figure is in their metadata, and no date. Raises InputError where there is no
    format of this name, or a file cannot be written, as on a full disk.
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


def save_each(
    figure_by: Callable[[str], Figure], names: Iterable[str], folder: Path, formats: Sequence[str] = ("png",)
) -> list[Path]:
    """Draw the figures of some names, and write each as a file of each format.

    Within ``collected``, a figure that fails does not end the others.
    """
    files = []
    for name in names:
        with drawing(name):
            files += save_figure(figure_by(name), folder / name, formats)
    return files


def drawing_of(drawings: Mapping[str, D], name: str) -> D:
    """Entry of a table of drawings by its name, with or without the ending of a format. Raises InputError
    where the result has no figure of this name.

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

    ``handles``, artists in the legend, artists of a tuple drawn over each other with the label of the last;
    all that have a label if omitted; ``columns``, columns of the legend; fewer where the page is too narrow
    for them, and a figure of a journal is then higher by the rows more; ``lift``, height of the legend above
    the axes [pt], which leaves room for an axis on top of them.
    """
    entries: list[Any] = ax.get_legend_handles_labels()[0] if handles is None else list(handles)
    # Bars and lines with error bars are subclasses of tuple with labels of their own.
    named = [entry[-1] if type(entry) is tuple else entry for entry in entries]
    labels = options.pop("labels", None) or [str(entry.get_label()) for entry in named]
    figure, size = figure_of(ax), _size_of("legend.fontsize")
    fitting = _fitting(labels, columns, 72.0 * figure.get_figwidth() / side_by_side(ax) - _LEFT)
    more = math.ceil(len(labels) / fitting) - math.ceil(len(labels) / columns)
    if _LOOKS[_style.get()].columns is not None:
        figure.set_figheight(figure.get_figheight() + more * _ROW * size / 72.0)
    legend = ax.legend(
        entries,
        labels,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        bbox_transform=offset_copy(ax.transAxes, figure, y=lift, units="points"),
        borderaxespad=0.3,
        borderpad=0.2,
        ncols=fitting,
        frameon=False,
        handlelength=_HANDLE,
        handletextpad=_PAD,
        columnspacing=_SPACING,
        **options,
    )
    whole = legend.get_tightbbox

    def above(renderer: Any = None) -> Bbox:
        """Box of the legend for the layout, which makes room for it above the axes, not next to them."""
        box, axes_box = cast("Bbox", whole(renderer)), ax.get_window_extent()
        return Bbox.from_extents(min(box.x0, axes_box.x1), box.y0, min(box.x1, axes_box.x1), box.y1)

    legend.get_tightbbox = above  # type: ignore[method-assign]


# Room for the labels of axes left of a legend [pt]; and height of a row of a legend, lengths of its handles,
# and spaces after handles and between columns, in sizes of its letters.
_LEFT = 52.0
_ROW, _HANDLE, _PAD, _SPACING = 1.7, 2.2, 0.8, 1.4


def _fitting(labels: Sequence[str], columns: int, room: float) -> int:
    """Number of columns of a legend with these labels, at most ``columns``, that fit into ``room`` [pt]."""
    size = _size_of("legend.fontsize")
    widths = np.array([(_HANDLE + _PAD) * size + _width(label, size, math=True) for label in labels])
    for number in range(columns, 1, -1):
        of_columns = [column for column in np.array_split(widths, number) if column.size]
        if sum(map(np.max, of_columns)) + _SPACING * size * (len(of_columns) - 1) <= room:
            return number
    return 1


def side_by_side(ax: Axes) -> int:
    """Number of axes side by side in the figure of some axes."""
    spec = ax.get_subplotspec()
    return 1 if spec is None else int(spec.get_gridspec().ncols)


COLOURS = colormaps["viridis"]


def line_colours() -> ListedColormap:
    """Colours of lines and dots: without the lightest ones, which are almost invisible on white, or on a dark
    page without the darkest ones.
    """
    ends = (0.38, 1.0) if _LOOKS[_style.get()].tones else (0.0, 0.85)
    return ListedColormap(COLOURS(np.linspace(*ends, 256)))


# An axis has a tick at each value where there are at most so many, each of at most so many characters.
_FEW_VALUES, _SHORT = 8, 4

# Place of a colour bar next to the axes, in parts of them.
BAR = (1.025, 0.0, 0.04, 1.0)

# Round numbers of a decade: three, six and twelve of them.
_FEW, _SOME = (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)
_MANY = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)


def scale_axis(axis: Axis, text: str, *, values: Array, log: bool) -> None:
    """Label an axis; where ``log`` is set, make it logarithmic with ticks at round numbers."""
    ax = axis.axes
    assert ax is not None
    along = axis is ax.xaxis
    axis.set_label_text(fitted_label(ax, text, along=along))
    if not log:
        # An offset or a power above the axis would lie below a legend.
        if isinstance(plain := axis.get_major_formatter(), ScalarFormatter):
            plain.set_useOffset(False)
            plain.set_powerlimits(_PLAIN)
        return
    (ax.set_xscale if along else ax.set_yscale)("log")
    ticks = _ticks(np.unique(values[np.isfinite(values) & (values > 0.0)]))
    axis.set_major_locator(_ApartLocator(list(ticks)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


# Powers of ten between which the numbers of an axis are written out.
_PLAIN = -6, 7

# Part of the width or height of a panel with what is around it that the label of its axis may take.
_LABEL = 0.72


def fitted_label(ax: Axes, text: str, *, along: bool) -> str:
    """Label of the horizontal axis where ``along``, or of the vertical one, broken into lines where it is
    longer than a panel.
    """
    spec, figure = ax.get_subplotspec(), figure_of(ax)
    rows, columns = (1, 1) if spec is None else spec.get_gridspec().get_geometry()
    page = figure.get_figwidth() / columns if along else figure.get_figheight() / rows
    lines = text.split("\n")
    size, room = _size_of("axes.labelsize"), _LABEL * 72.0 * page
    return "\n".join(part for line in lines for part in broken(line, size, room, math=True))


class _ApartLocator(FixedLocator):
    """Ticks of a logarithmic axis whose labels do not touch on the page; the largest ones stay."""

    def __call__(self) -> Sequence[float]:
        """Ticks whose labels are at least as far apart as a letter is wide, or a part of a line is high."""
        ticks = [float(tick) for tick in super().__call__()]
        axis = cast("Axis", self.axis)
        assert axis.axes is not None
        along = axis is axis.axes.xaxis
        size, (low, high) = _size_of(f"{'x' if along else 'y'}tick.labelsize"), axis.get_view_interval()
        box = axis.axes.bbox
        length = box.width if along else box.height
        scale = 72.0 / figure_of(axis.axes).dpi * length / math.log(high / low)
        kept: list[tuple[float, float]] = []  # places of ticks and half of the room of their labels [pt]
        shown = []
        for tick in ticks[::-1]:
            room = _width(f"{tick:g}", size) + _LETTER * size if along else _LINE * size
            at, half = scale * math.log(tick), 0.5 * room
            if not kept or kept[-1][0] - at >= kept[-1][1] + half:
                kept.append((at, half))
                shown.append(tick)
        return shown[::-1]


# Width of a digit, and distance of lines, in sizes of their letters.
_LETTER, _LINE = 0.64, 1.3


def _ticks(values: Array) -> Array:
    """Ticks of a logarithmic axis: the values themselves where they are few and short, else round numbers."""
    if values.size <= _FEW_VALUES and all(len(f"{value:g}") <= _SHORT for value in values):
        return values
    return np.asarray(round_numbers(float(values[0]), float(values[-1])))


def round_numbers(low: float, high: float) -> Array:
    """Round numbers from ``low`` to ``high``, at least four, about evenly spaced in their logarithm.

    Over a wide range they are powers of ten. Over a range too narrow for four such numbers they are evenly
    spaced, and the first and last may lie outside of it.

    Examples
    --------
    >>> round_numbers(0.2, 2.0)
    array([0.2, 0.5, 1. , 2. ])
    """
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    slack = 1e-9
    for steps in ((1.0,), _FEW, _SOME, _MANY):
        all_steps = np.array([float(f"{step}e{decade}") for decade in decades for step in steps])
        inside = all_steps[(all_steps >= low * (1.0 - slack)) & (all_steps <= high * (1.0 + slack))]
        if inside.size >= 4:
            return inside
    return np.asarray(MaxNLocator(5).tick_values(low, high))


def levels_of(values: Array, *, log: bool) -> Array:
    """Round levels that enclose all finite values. ``values``, of which at least one is finite; all positive
    where ``log``.

    Examples
    --------
    >>> levels_of(np.array([3.0, 9.5]), log=False)
    array([3. , 3.5, 4. , 4.5, 5. , 5.5, 6. , 6.5, 7. , 7.5, 8. , 8.5, 9. ,
           9.5])
    >>> levels_of(np.array([0.03, 20.0]), log=True)
    array([ 0.02,  0.05,  0.1 ,  0.2 ,  0.5 ,  1.  ,  2.  ,  5.  , 10.  ,
           20.  ])
    """
    finite = values[np.isfinite(values)]
    low, high = float(finite.min()), float(finite.max())
    if log:
        steps = (1.0,) if high > 1e5 * low else _FEW if high > 300.0 * low else _SOME
        decades = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 2)
        levels = np.array([float(f"{step}e{decade}") for decade in decades for step in steps])
    else:
        room = 0.0 if high - low > 1e-6 * abs(high) else 0.01 * abs(high) or 1.0
        levels = np.asarray(MaxNLocator(14, steps=[1, 2, 2.5, 5, 10]).tick_values(low - room, high + room))
        low, high = low - room, high + room
    first = int(np.searchsorted(levels, low, side="right")) - 1
    last = int(np.searchsorted(levels, high, side="left"))
    return levels[max(first, 0) : max(last, first + 1) + 1]


def norm_of(levels: Array, *, log: bool) -> Normalize:
    """Normalisation of colours from the first level to the last."""
    return LogNorm(levels[0], levels[-1]) if log else Normalize(levels[0], levels[-1])


def colour_bar(
    ax: Axes,
    norm: Normalize,
    text: str,
    levels: Array,
    colours: Colormap = COLOURS,
    *,
    extend: Literal["neither", "max"] = "neither",
) -> None:
    """Add a colour bar with ticks at round levels, at every second or third one where there are many; with an
    arrow at its upper end for values above it where ``extend`` is max.
    """
    # Next to the axes themselves, a wide legend above them does not push the bar away.
    bar_axes = ax.inset_axes(BAR)
    bar = figure_of(ax).colorbar(
        ScalarMappable(norm, colours),
        cax=bar_axes,
        label=fitted_label(ax, text, along=False),
        extend=extend,
    )
    ticks = levels if levels.size <= 9 else levels[:: 2 if levels.size <= 18 else 3]
    bar.set_ticks(list(ticks), labels=[readable(level, 6) for level in ticks])
    bar.ax.minorticks_off()


def in_half_widths(result: OfContact, x: Array) -> Array:
    """Positions [m] divided by the half-width of the contact."""
    return np.asarray(x / result.conditions.half_width)


def label_position(result: OfContact, ax: Axes, axis: str = "x", *, line: str = "") -> None:
    """Label the horizontal axis with x/b or y/b, the ``line`` that it lies on, and the half-width b."""
    factor, unit = unit_for(result.conditions.half_width, "m", least=1.0)
    ax.set_xlabel(f"${axis}/b$   ({line}$b$ = {readable(factor * result.conditions.half_width, 4)} {unit})")


# Room that the axis of lengths above the axes takes [pt], and place of its name next to its numbers [pt].
LENGTH_AXIS, _LENGTH_NAME = 18.0, (-4.0, 6.0)


# Part of an axis of lengths at its left end within which a number would run into the name of the axis.
_NAME_REACH = 0.035


class _ClearOfName(ScalarFormatter):
    """Numbers of an axis of lengths, without those that would run into its name at the left end."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        left, right = cast("Axis", self.axis).get_view_interval()
        near = abs(x - left) < _NAME_REACH * abs(right - left)
        return "" if near else super().__call__(x, pos)


def length_axis(result: OfContact, ax: Axes, axis: str = "x") -> None:
    """Add an axis above the axes with the position as a length, in micrometres or millimetres."""
    b = result.conditions.half_width
    factor, unit = unit_for(b * max(abs(end) for end in ax.get_xlim()), "m", least=1.0)
    top = ax.secondary_xaxis(
        "top", functions=(lambda x: np.asarray(x) * factor * b, lambda x: np.asarray(x) / (factor * b))
    )
    top.xaxis.set_major_formatter(_ClearOfName())
    top.set_xlabel(f"${axis}$ [{unit}]", ha="right", va="bottom")
    left, up = _LENGTH_NAME
    shifted = offset_copy(ax.transAxes, figure_of(ax), x=left, y=up, units="points")
    top.xaxis.set_label_coords(0.0, 1.0, transform=shifted)
