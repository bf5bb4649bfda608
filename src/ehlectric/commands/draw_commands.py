"""Figures of stored results of every kind, drawn again from a file or from a folder."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlectric.errors import InputError
from ehlectric.figures.figure_names import (
    ALL_FIGURES,
    BEARING_FIGURE_FILES,
    DRIVE_FIGURE_FILES,
    MOTION_FIGURE_FILES,
    SENSITIVITY_FIGURE,
    SPEED_FIGURE_FILES,
    in_formats,
    map_files,
)
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.display import is_number
from ehlectric.runtime.files import prepare
from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
from ehlectric.runtime.undrawn import Drawn, kept_going

if TYPE_CHECKING:
    from ehlectric.sweep import SweepResults


def load_and_draw(
    path: str | Path, folder: str | Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> Drawn:
    """Draw the figures of a stored result again.

    ``folder``, folder of the figures; it is made if it does not exist. Returns files, warnings of the result
    and of its figures, and figures that failed. Raises InputError if the file is not a result,
    the folder cannot be used, another command draws into it, or a sweep varies too many keys for a map.
    """
    from ehlectric.runs.result_folders import stored_result

    path = stored_result(path)
    with alone_in(folder, locks=[FIGURE_LOCK]) as folder:
        return _load_and_draw(path, folder, formats, style)


def draw_sweep(
    results: SweepResults, folder: Path, formats: Sequence[str] = ("png",), style: str = "screen"
) -> Drawn:
    """Draw the figures of a sweep into its folder, as ``load_and_draw`` does and with its errors."""
    with alone_in(folder, locks=[FIGURE_LOCK]) as target:
        return _draw_sweep(results, target, folder, formats, style)


def _load_and_draw(path: Path, folder: Path, formats: Sequence[str], style: str) -> Drawn:
    """Draw the figures of a result from its NetCDF file or database."""
    from ehlectric.bearing import BearingResult
    from ehlectric.drive import DriveResult
    from ehlectric.motion.stored_run import read_motion
    from ehlectric.runs.solve import load
    from ehlectric.runtime.result_names import MOTION
    from ehlectric.runtime.stored import warnings_in
    from ehlectric.sweep import NAME, read_sweep

    if path.name == NAME:
        return _draw_sweep(read_sweep(path.parent), folder, path.parent, formats, style)
    if path.name == MOTION:
        dataset = read_motion(path)
        warnings: Sequence[ResultWarning] = warnings_in(dataset.attrs)
        return _draw(dataset, folder, MOTION_FIGURE_FILES, warnings, formats, style)
    result = load(path)
    names: Iterable[str] = ALL_FIGURES
    if isinstance(result, BearingResult):
        names = (*BEARING_FIGURE_FILES, *SPEED_FIGURE_FILES)
    elif isinstance(result, DriveResult):
        names = DRIVE_FIGURE_FILES
    return _draw(result, folder, names, result.warnings, formats, style)


def _draw(
    result: Any,
    folder: str | Path,
    names: Iterable[str],
    warnings: Sequence[ResultWarning],
    formats: Sequence[str],
    style: str,
) -> Drawn:
    """Draw figures of these names; warnings of the figures follow the warnings of the result."""
    folder = prepare(folder, in_formats(names, formats))
    drawn = Drawn(())
    with kept_going() as undrawn:
        from ehlectric.figures.result_figures import draw_figures

        drawn = draw_figures(result, folder, formats=formats, style=style)
    return Drawn(drawn.files, (*warnings, *drawn.warnings), tuple(undrawn))


def _draw_sweep(results: SweepResults, folder: Path, home: Path, formats: Sequence[str], style: str) -> Drawn:
    """Draw the maps and lines of a sweep over one or two keys, or the sensitivity of a Sobol design."""
    from ehlectric.sweep import main_value, ranked_value, select_slice, sensitivity, sensitivity_warnings

    files: list[Path] = []
    if results.ranges:
        indices = sensitivity(results, ranked_value(results.case))
        prepare(folder, in_formats([SENSITIVITY_FIGURE], formats))
        with kept_going(SENSITIVITY_FIGURE) as undrawn:
            from ehlectric.figures.style import style as styled
            from ehlectric.figures.sweep_figures import save_sensitivity

            with styled(style):
                files += save_sensitivity(results, indices, folder / SENSITIVITY_FIGURE, formats)
        return Drawn(tuple(files), tuple(sensitivity_warnings(indices)), tuple(undrawn))
    value = main_value(results.case)
    x, y = _axes(results, home)
    taken = select_slice(results, x, y, value)
    prepare(folder, in_formats((*map_files(value), *SPEED_FIGURE_FILES), formats))
    with kept_going() as undrawn:
        from ehlectric.figures.style import style as styled
        from ehlectric.figures.sweep_figures import save_maps, save_speeds

        with styled(style):
            files += save_maps(results, x, y, value, folder, formats=formats)
            files += save_speeds(results, taken, folder, formats)
    return Drawn(tuple(files), undrawn=tuple(undrawn))


def _axes(results: SweepResults, home: Path) -> tuple[str, str | None]:
    """Keys along the axes of the map of a sweep that varies one or two keys. Raises InputError if it varies
    more keys, so that somebody has to choose.
    """
    keys = sorted(results.axes, key=lambda key: not _numeric(results.axes[key]))
    if len(keys) > 2:
        text = f"varies {', '.join(keys)}"
        command = f"ehlectric map {home} --x KEY --y KEY --at KEY=VALUE"
        raise InputError(home, text, takes=f"one or two varied keys; choose with: {command}")
    return keys[0], keys[1] if len(keys) == 2 else None


def _numeric(values: Sequence[Any]) -> bool:
    return all(map(is_number, values))
