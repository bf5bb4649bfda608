"""Figures of drives: by name, and as files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive import discharges, findings, remedies, voltages
from ehlectric.figures.drive.histogram import time_above, time_at_voltage
from ehlectric.figures.drive.spectrum import has_spectrum, shaft_spectrum
from ehlectric.figures.names import DRIVE_FIGURE_FILES
from ehlectric.figures.style import drawing_of, new_panels, save_figure, share_below, style, titled

Draw = Callable[[DriveResult, Axes], Axes]


def _no_legend(_axes: list[Axes]) -> None:
    """The panels have legends of their own."""


@dataclass(frozen=True)
class _Drawing:
    """Figure of a drive: its panels, how they stand, its size [inches], its title, and its legend."""

    panels: tuple[Draw, ...]
    rows: int
    size: tuple[float, float]
    finding: Callable[[DriveResult], str]
    legend: Callable[[list[Axes]], None] = _no_legend
    shared: bool = False


def drive_figures_of(result: DriveResult) -> dict[str, _Drawing]:
    """Figures of a drive by the names of their files.

    Figures with nothing to show are left out: a spectrum in a file of version 1.0, distributions without
    discharges, remedies where the file has none, and voltages over time where no time was recorded.
    """
    over_time, over_voltage, over_frequency, of_events, side_by_side = DRIVE_FIGURE_FILES
    found: dict[str, _Drawing] = {}
    if len(result.solution.record.trace) > 1:
        panels = voltages.VOLTAGE_PANELS
        found[over_time] = _Drawing(panels, 3, (6.3, 5.4), findings.voltages, voltages.legend_of, shared=True)
    found[over_voltage] = _Drawing((time_at_voltage, time_above), 2, (6.3, 5.0), findings.histogram)
    if has_spectrum(result):
        found[over_frequency] = _Drawing((shaft_spectrum,), 1, (6.3, 3.6), findings.spectrum)
    if len(result.solution.record.events):
        found[of_events] = _Drawing(
            discharges.DISTRIBUTIONS, 2, (6.3, 5.0), findings.discharges, discharges.legend_of
        )
    if result.remedies:
        height = 1.7 + 0.5 * (1 + len(result.remedies))
        found[side_by_side] = _Drawing(
            (remedies.rates, remedies.energies), 1, (6.9, height), findings.remedies, remedies.legend_of
        )
    return found


def figure(result: DriveResult, name: str) -> Figure:
    """Figure of a drive.

    Parameters
    ----------
    result : DriveResult
        Result of the drive.
    name : str
        Name of its file, such as "drive_voltages.png".

    Returns
    -------
    Figure
        The figure, with its title.

    Raises
    ------
    InputError
        Where the drive has no figure of this name.
    """
    drawing = drawing_of(drive_figures_of(result), name)
    lines = [drawing.finding(result), *findings.case_lines(result)]
    if drawing.finding is findings.discharges:
        lines.append(findings.arc_line(result))
    with style():
        axes = new_panels(drawing.rows, len(drawing.panels) // drawing.rows, drawing.size)
        for draw, ax in zip(drawing.panels, axes, strict=True):
            draw(result, ax)
        drawing.legend(axes)
        if drawing.shared:
            share_below(axes)
        return titled(axes[0], "\n".join(lines), converged=result.converged)


def save_drive_figures(result: DriveResult, folder: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Draw the figures of a drive as files.

    Parameters
    ----------
    result : DriveResult
        Result of the drive.
    folder : Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".

    Returns
    -------
    list of Path
        Files written: those of ``drive_figures_of``.
    """
    names = drive_figures_of(result)
    return [file for name in names for file in save_figure(figure(result, name), folder / name, formats)]
