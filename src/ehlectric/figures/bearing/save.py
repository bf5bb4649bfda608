"""Figures of bearings: by name, and as files."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import insulating, lambda_ratio, lubrication
from ehlectric.bearing.speeds import over_speed
from ehlectric.errors import ResultWarning
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
from ehlectric.figures.names import in_formats, of_cut
from ehlectric.figures.style import drawing_of, figure_of, name_over, new_panels, save_figure, style

Draw = Callable[[BearingResult, Axes], Axes]

# Sizes of figures; and width, height of each panel and of the title of stacked panels [inches].
_POLAR_SIZE, _SPEED_SIZE = (6.9, 4.6), (6.3, 3.7)
_WIDTH, _HEIGHT, _TITLE = 6.3, 2.1, 0.65


def _loads(_result: BearingResult) -> tuple[Draw, ...]:
    return load_around, film_around


def _circuit(result: BearingResult) -> tuple[Draw, ...]:
    if result.solution.conditions.ceramic:
        return ()
    shares = (voltage_shares,) if insulating(result.solution) else ()
    return (contact_capacitances, *shares, *((breakdown_voltages,) if _breaks(result) else ()))


def _pitch(result: BearingResult) -> tuple[Draw, ...]:
    if result.solution.conditions.ceramic:
        return ()
    return (capacitance_over_pitch, *((breakdown_over_pitch,) if _breaks(result) else ()))


def _impedance(result: BearingResult) -> tuple[Draw, ...]:
    if result.solution.conditions.ceramic or not insulating(result.solution):
        return ()
    return () if impedance_of(result.solution) is None else (impedance_magnitude, impedance_phase)


def _breaks(result: BearingResult) -> bool:
    return result.breaks()["first_break"] is not None


# Panels of the figures by the names of their files; no panels where the bearing has nothing to show.
FIGURES: Mapping[str, Callable[[BearingResult], tuple[Draw, ...]]] = {
    "bearing_loads.png": _loads,
    "bearing_circuit.png": _circuit,
    "bearing_pitch.png": _pitch,
    "bearing_impedance.png": _impedance,
}

# Figures over the speed of the shaft.
SPEED_FIGURES: Mapping[str, Callable[..., Axes]] = {
    "capacitance_over_speed.png": capacitance_over_speed,
    "breakdown_over_speed.png": breakdown_over_speed,
}


def bearing_figures_of(result: BearingResult) -> dict[str, tuple[Draw, ...]]:
    """Panels of the figures of a bearing, by the names of their files.

    Figures with nothing to show are left out. There is no circuit of ceramic elements, no voltage where
    surfaces touch, no breakdown without a dielectric strength, and no impedance without a conductivity or
    where surfaces touch.
    """
    panels = {name: panels_of(result) for name, panels_of in FIGURES.items()}
    return {name: draws for name, draws in panels.items() if draws}


def figure(result: BearingResult, name: str) -> Figure:
    """Figure of a bearing.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing.
    name : str
        Name of its file, such as "bearing_loads.png" or "capacitance_over_speed.png". For a figure over
        speed, the bearing is solved by formula at other speeds.

    Returns
    -------
    Figure
        The figure, with its title.

    Raises
    ------
    InputError
        Where the bearing has no figure of this name.
    """
    drawings = bearing_figures_of(result)
    (name,) = in_formats([name])
    if name in SPEED_FIGURES:
        points, _ = over_speed(result.case)
        return speed_figure(points, name, result.case.title, own=_own_speed(result))
    panels = drawing_of(drawings | dict.fromkeys(SPEED_FIGURES, ()), name)
    title = _title(result, voltages=breakdown_voltages in panels or breakdown_over_pitch in panels)
    polar = panels[0] is load_around
    with style():
        axes = new_polar(len(panels), _POLAR_SIZE) if polar else _stack(len(panels))
        for draw, ax in zip(panels, axes, strict=True):
            draw(result, ax)
        if not polar:
            _share_below(axes)
        return _named(axes[0], title, converged=result.converged)


def speed_figure(points: Speeds, name: str, title: str = "", *, own: Speed | None = None) -> Figure:
    """Figure of a bearing over the speed of its shaft.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speed of the inner ring [rad/s], and the summary at this speed.
    name : str
        Name of its file, such as "capacitance_over_speed.png".
    title : str, optional
        First line of the title.
    own : (float, dict), optional
        A bearing to mark beside them, such as one with solved contacts.

    Returns
    -------
    Figure
        The figure, with its title.

    Raises
    ------
    InputError
        Where there is no figure of this name, or the bearing has no breakdown voltage at any speed.
    """
    draw = drawing_of(_speed_drawings(points), name)
    title = textwrap.shorten(title, 70, placeholder=" ...")
    title = f"{title}\ncontacts {how_found(points)}".lstrip()
    with style():
        ax = draw(points, new_panels(1, 1, _SPEED_SIZE)[0], own=own)
        return _named(ax, title, converged=all(summary["converged"] for _, summary in points))


def save_bearing_figures(
    result: BearingResult, folder: Path, formats: Sequence[str] = ("png",)
) -> list[Path]:
    """Draw the figures of a bearing at its own speed as files.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing.
    folder : Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".

    Returns
    -------
    list of Path
        Files written: those of ``bearing_figures_of``.
    """
    return [
        file
        for name in bearing_figures_of(result)
        for file in save_figure(figure(result, name), folder / name, formats)
    ]


def save_speed_figures(
    points: Speeds,
    folder: Path,
    title: str = "",
    *,
    own: Speed | None = None,
    formats: Sequence[str] = ("png",),
    at: Mapping[str, str] | None = None,
) -> list[Path]:
    """Draw capacitance and, where there are any, breakdown voltages over the speed as files.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speed of the inner ring [rad/s], and the summary at this speed.
    folder : Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".
    title : str, optional
        First line of the titles.
    own : (float, dict), optional
        A bearing to mark beside them, such as one with solved contacts.
    at : mapping of str to str, optional
        Values of further varied keys of a sweep, for the names of the files.

    Returns
    -------
    list of Path
        Files written.
    """
    return [
        file
        for name in _speed_drawings(points)
        for figure in (speed_figure(points, name, title, own=own),)
        for file in save_figure(figure, folder / of_cut(name, at), formats)
    ]


def save_over_speed(
    result: BearingResult, folder: Path, formats: Sequence[str] = ("png",)
) -> tuple[list[Path], list[ResultWarning]]:
    """Solve a bearing by formula at speeds around its own, and draw it over speed as files.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing at its own speed.
    folder : Path
        Folder of the files; it must exist.
    formats : sequence of str
        Formats of the files, of "png", "svg" and "pdf".

    Returns
    -------
    files : list of Path
        Files written; none where the formulas take no speed.
    left_out : list of ResultWarning
        Speeds that are left out, and why.
    """
    points, left_out = over_speed(result.case)
    if not points:
        return [], left_out
    own = _own_speed(result)
    return save_speed_figures(points, folder, result.case.title, own=own, formats=formats), left_out


def _speed_drawings(points: Speeds) -> dict[str, Callable[..., Axes]]:
    """Functions that draw a bearing over speed, by the names of their files; no empty figures."""
    empty = set() if breaks_anywhere(points) else {breakdown_over_speed}
    return {name: draw for name, draw in SPEED_FIGURES.items() if draw not in empty}


def _own_speed(result: BearingResult) -> Speed:
    """Speed of the inner ring of a bearing [rad/s], and its summary."""
    return result.case.bearing.inner_speed, result.summary()


def _stack(panels: int) -> list[Axes]:
    """Axes of panels below each other."""
    return new_panels(panels, 1, (_WIDTH, _HEIGHT * panels + _TITLE))


def _share_below(axes: Sequence[Axes]) -> None:
    """Remove the labels of the common axis from all stacked panels but the lowest."""
    for ax in axes[:-1]:
        ax.set_xlabel("")
        ax.tick_params(labelbottom=False)
    figure_of(axes[0]).align_ylabels(axes)


def _named(ax: Axes, title: str, *, converged: bool) -> Figure:
    """Figure of axes, with a title over all of its panels."""
    text = title if converged else f"NOT CONVERGED\n{title}"
    if text:
        name_over(ax, text, converged=converged)
    return figure_of(ax)


def _title(result: BearingResult, *, voltages: bool) -> str:
    """Title of a bearing: title of its case, loads, speed, temperature, and how its film is computed."""
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
