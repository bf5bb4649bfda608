"""The figures of a sweep as PNG files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ehlectric.figures.bearing.save import save_speed_figures
from ehlectric.figures.style import new_panels, save_figure, style
from ehlectric.figures.sweep.lines import value_lines
from ehlectric.figures.sweep.maps import value_map
from ehlectric.figures.sweep.points import held_text, name_figure
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import Slice, take

_SPEED = "bearing.inner_speed"
_MAP_SIZE, _LINES_SIZE = (6.3, 4.7), (6.3, 4.3)


def map_files(value: str) -> tuple[str, str]:
    """Names of the files of the map and of the lines of a value.

    Examples
    --------
    >>> map_files("discharge.breakdown_voltage")
    ('map_discharge.breakdown_voltage.png', 'lines_discharge.breakdown_voltage.png')
    """
    return f"map_{value}.png", f"lines_{value}.png"


def save_maps(
    results: SweepResults,
    x: str,
    y: str | None,
    value: str,
    folder: Path,
    *,
    at: Mapping[str, str] | None = None,
) -> list[Path]:
    """Draw a value as a map and as lines.

    Parameters
    ----------
    results : SweepResults
        What to draw.
    x : str
        Varied key whose values are numbers.
    y : str or None
        Second varied key; without one, or where its values are texts, there is no map.
    value : str
        Dotted key of the summary.
    folder : Path
        Where to; it must be there.
    at : mapping, optional
        What is held, by varied key, where more vary.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        As for ``take``.
    """
    taken = take(results, x, y, value, at)
    named = held_text(results, taken)
    map_file, lines_file = map_files(value)
    files = []
    with style():
        drawn = [(lines_file, value_lines(results, x, y, value, at=at, ax=new_panels(1, 1, _LINES_SIZE)[0]))]
        if y is not None and taken.numeric:
            ax = value_map(results, x, y, value, at=at, ax=new_panels(1, 1, _MAP_SIZE)[0])
            drawn.insert(0, (map_file, ax))
        for name, ax in drawn:
            name_figure(ax, results, named)
            save_figure(ax, folder / name)
            files.append(folder / name)
    return files


def save_speeds(results: SweepResults, taken: Slice, folder: Path) -> list[Path]:
    """Draw capacitance and breakdown voltages of bearings over the speed, where a slice is over that alone.

    Parameters
    ----------
    results : SweepResults
        Of what.
    taken : Slice
        Its points; those that are not solved, and doubtful ones, are left out.
    folder : Path
        Where to; it must be there.

    Returns
    -------
    list of Path
        The files written; none of other slices.
    """
    if taken.x != _SPEED or taken.y is not None or taken.free:
        return []
    points = [
        (float(speed), dict(point.summary))
        for speed, point in zip(taken.along, taken.points, strict=True)
        if point.solved and not point.doubtful and point.summary is not None
    ]
    # Not the title of the case, which may name what is held otherwise here.
    title = ", ".join(filter(None, [results.title, held_text(results, taken).removeprefix("at ")]))
    return save_speed_figures(points, folder, title) if points else []
