"""Figures of sweeps: by name, and as files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.errors import InputError, shown
from ehlectric.figures.bearing.save import save_speed_figures
from ehlectric.figures.names import SENSITIVITY_FIGURE, in_formats, map_files
from ehlectric.figures.style import figure_of, new_panels, save_figure, style
from ehlectric.figures.sweep import findings
from ehlectric.figures.sweep.lines import value_lines
from ehlectric.figures.sweep.maps import value_map
from ehlectric.figures.sweep.points import held_text, name_figure
from ehlectric.figures.sweep.sensitivity import sensitivity_figure
from ehlectric.sweep.breakdown_keys import ranked_value
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.sensitivity import sensitivity
from ehlectric.sweep.slices import Slice, take

_SPEED = "bearing.inner_speed"

# Functions that draw a value over varied keys, by the first word of the file's name; sizes [inches].
FIGURES: Mapping[str, Callable[..., Axes]] = {"map": value_map, "lines": value_lines}
_SIZES = {"map": (6.3, 4.7), "lines": (6.3, 4.3)}


def figure(
    results: SweepResults,
    name: str,
    *,
    x: str = "",
    y: str | None = None,
    value: str = "",
    at: Mapping[str, str] | None = None,
) -> Figure:
    """Figure of a sweep.

    Parameters
    ----------
    results : SweepResults
        Results of the sweep.
    name : str
        Name of its file: "map_KEY.png" or "lines_KEY.png" with a dotted key of the summary, or
        "sensitivity.png".
    x : str, optional
        Varied key along the horizontal axis of a map or of lines.
    y : str, optional
        Second varied key; a map needs it.
    value : str, optional
        Dotted key of the summary whose sensitivity is drawn; by default a breakdown voltage.
    at : mapping of str to str, optional
        Values of the other varied keys.

    Returns
    -------
    Figure
        The figure, with its title.

    Raises
    ------
    InputError
        Where there is no figure of this name, or as ``take`` and ``sensitivity`` raise it.
    """
    (name,) = in_formats([name])
    if name == SENSITIVITY_FIGURE:
        indices = sensitivity(results, value or ranked_value(results.case))
        return sensitivity_figure(results, indices)
    kind, _, key = name.removesuffix(".png").partition("_")
    if kind not in FIGURES or name not in map_files(key):
        allowed = f"map_KEY.png, lines_KEY.png or {SENSITIVITY_FIGURE}"
        raise InputError("figure", got=shown(name), takes=allowed)
    if kind == "map" and y is None:
        raise InputError.missing("y", "a varied key, for a map")
    taken = take(results, x, y, key, at)
    with style():
        ax = new_panels(1, 1, _SIZES[kind])[0]
        FIGURES[kind](results, x, y, key, at=at, ax=ax)
        name_figure(ax, results, findings.of_slice(results, taken), held_text(results, taken))
    return figure_of(ax)


def save_maps(
    results: SweepResults,
    x: str,
    y: str | None,
    value: str,
    folder: Path,
    *,
    at: Mapping[str, str] | None = None,
    formats: Sequence[str] = ("png",),
) -> list[Path]:
    """Draw a value of a sweep as a map and as lines, as files.

    Parameters
    ----------
    results : SweepResults
        Results of the sweep.
    x : str
        Varied key whose values are numbers.
    y : str or None
        Second varied key. There is no map without it, or where its values are texts.
    value : str
        Dotted key of the summary.
    folder : Path
        Folder of the files; it must exist.
    at : mapping of str to str, optional
        Values of the other varied keys.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        As ``take`` raises it.
    """
    numeric = take(results, x, y, value, at).numeric
    pairs = zip(map_files(value), map_files(value, at), strict=True)
    wanted = [pair for pair in pairs if (y is not None and numeric) or pair[0].startswith("lines_")]
    return [
        file
        for name, path in wanted
        for file in save_figure(figure(results, name, x=x, y=y, at=at), folder / path, formats)
    ]


def save_speeds(
    results: SweepResults,
    taken: Slice,
    folder: Path,
    formats: Sequence[str] = ("png",),
    *,
    at: Mapping[str, str] | None = None,
) -> list[Path]:
    """Draw capacitance and breakdown voltages of bearings over the speed, as files.

    Parameters
    ----------
    results : SweepResults
        Results of the sweep.
    taken : Slice
        Points to draw. Points that are not solved or must not be used are left out.
    folder : Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".
    at : mapping of str to str, optional
        Values of the other varied keys, for the names of the files.

    Returns
    -------
    list of Path
        Files written; none where the slice is not over the speed of a bearing alone.
    """
    if taken.x != _SPEED or taken.y is not None or taken.free:
        return []
    points = [
        (float(speed), dict(point.summary))
        for speed, point in zip(taken.along, taken.points, strict=True)
        if point.solved and not point.doubtful and point.summary is not None
    ]
    # The title of the case may name values that the sweep changes.
    title = ", ".join(filter(None, [results.title, held_text(results, taken).removeprefix("at ")]))
    return save_speed_figures(points, folder, title, formats=formats, at=at) if points else []
