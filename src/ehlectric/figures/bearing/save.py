"""The figures of a whole bearing as PNG files."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import insulating, lambda_ratio, lubrication
from ehlectric.figures.bearing.circuit import (
    breakdown_over_pitch,
    breakdown_voltages,
    capacitance_over_pitch,
    contact_capacitances,
    impedance_magnitude,
    impedance_phase,
    voltage_shares,
)
from ehlectric.figures.bearing.polar import film_around, load_around, new_polar
from ehlectric.figures.bearing.speeds import (
    Speed,
    Speeds,
    breakdown_over_speed,
    breaks_anywhere,
    capacitance_over_speed,
    how_found,
)
from ehlectric.figures.names import BEARING_FIGURE_FILES, SPEED_FIGURE_FILES
from ehlectric.figures.style import figure_of, name_over, new_panels, save_figure, style

Draw = Callable[[BearingResult, Axes], Axes]

# Size of a figure, and of each panel of those below each other [inches].
_POLAR_SIZE, _SPEED_SIZE = (6.9, 4.6), (6.3, 3.7)
_WIDTH, _HEIGHT, _TITLE = 6.3, 2.1, 0.65


def bearing_figures_of(result: BearingResult) -> dict[str, tuple[Draw, ...]]:
    """The panels of the figures of a bearing by the names of their files, those that have something to show.

    There is no circuit of ceramic elements, no voltage where surfaces touch, none of breakdown without a
    strength, and no impedance without a conductivity or where surfaces touch.
    """
    loads, circuit, pitch, impedance = BEARING_FIGURE_FILES
    found: dict[str, tuple[Draw, ...]] = {loads: (load_around, film_around)}
    if result.solution.conditions.ceramic:
        return found
    breaks = result.breaks()["first_break"] is not None
    shares = (voltage_shares,) if insulating(result.solution) else ()
    found[circuit] = (contact_capacitances, *shares, *((breakdown_voltages,) if breaks else ()))
    found[pitch] = (capacitance_over_pitch, *((breakdown_over_pitch,) if breaks else ()))
    if impedance_of(result.solution) is not None and insulating(result.solution):
        found[impedance] = (impedance_magnitude, impedance_phase)
    return found


def save_bearing_figures(result: BearingResult, folder: Path) -> list[Path]:
    """Draw all figures of a bearing as PNG files.

    Parameters
    ----------
    result : BearingResult
        What to draw.
    folder : Path
        Where to; it must be there.

    Returns
    -------
    list of Path
        The files written.
    """
    files = []
    with style():
        for name, panels in bearing_figures_of(result).items():
            title = _title(result, voltages=breakdown_voltages in panels or breakdown_over_pitch in panels)
            polar = panels[0] is load_around
            axes = new_polar(len(panels), _POLAR_SIZE) if polar else _stack(len(panels))
            for draw, ax in zip(panels, axes, strict=True):
                draw(result, ax)
            if not polar:
                _share_below(axes)
            files.append(_save(axes[0], title, folder / name, converged=result.converged))
    return files


def save_speed_figures(
    points: Speeds, folder: Path, title: str = "", *, own: Speed | None = None
) -> list[Path]:
    """Draw capacitance and, where there are any, breakdown voltages over the speed as PNG files.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speed of the inner ring [rad/s], and the summary at it.
    folder : Path
        Where to; it must be there.
    title : str, optional
        Over the figures.
    own : (float, dict), optional
        A bearing to mark beside them, as one whose contacts were solved.

    Returns
    -------
    list of Path
        The files written.
    """
    files = []
    title = textwrap.shorten(title, 70, placeholder=" ...")
    title = f"{title}\ncontacts {how_found(points)}".lstrip()
    converged = all(summary["converged"] for _, summary in points)
    with style():
        breaks = breaks_anywhere(points)
        draws = (capacitance_over_speed, *((breakdown_over_speed,) if breaks else ()))
        for name, draw in zip(SPEED_FIGURE_FILES, draws, strict=False):
            ax = draw(points, new_panels(1, 1, _SPEED_SIZE)[0], own=own)
            files.append(_save(ax, title, folder / name, converged=converged))
    return files


def _stack(panels: int) -> list[Axes]:
    return new_panels(panels, 1, (_WIDTH, _HEIGHT * panels + _TITLE))


def _share_below(axes: Sequence[Axes]) -> None:
    """Panels below each other have the label of their common axis once."""
    for ax in axes[:-1]:
        ax.set_xlabel("")
        ax.tick_params(labelbottom=False)
    figure_of(axes[0]).align_ylabels(axes)


def _save(ax: Axes, title: str, path: Path, *, converged: bool) -> Path:
    text = title if converged else f"NOT CONVERGED\n{title}"
    if text:
        name_over(ax, text, converged=converged)
    save_figure(ax, path)
    return path


def _title(result: BearingResult, *, voltages: bool) -> str:
    """Title of the case, and below it the duty and what the film is worth, and voltages where it has them."""
    bearing, factor = result.solution.case.bearing, result.solution.conditions.film_factor
    loads = ((bearing.radial_load, "radial"), (bearing.axial_load, "axial"))
    parts = [f"{load:.4g} N {way}" for load, way in loads if load]
    parts += [f"{bearing.inner_speed * 30.0 / np.pi:.4g} rpm", f"{bearing.temperature - 273.15:.4g} °C"]
    isothermal = factor == 1.0
    film = "isothermal film" if isothermal else f"film factor {factor:.3g}"
    film += f", least λ {lambda_ratio(result.solution):.2g}"
    if lubrication(result.solution) in ("conducting", "touching"):
        film += ": surfaces touch"
    elif voltages and (isothermal or lubrication(result.solution) == "partial film"):
        film += ": voltages are upper bounds"
    title = textwrap.shorten(result.solution.case.title, 70, placeholder=" ...")
    return "\n".join(filter(None, [title, ", ".join(parts), film]))
