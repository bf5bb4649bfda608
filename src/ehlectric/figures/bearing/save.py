"""Figures of bearings: by name, and as files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.over_speed import Curves, Speed, Speeds, breaks_anywhere, curves_of
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.speeds import over_speed
from ehlectric.errors import ResultWarning
from ehlectric.figures.bearing import findings
from ehlectric.figures.bearing.circuit import breakdown_voltages, contact_capacitances
from ehlectric.figures.bearing.impedance import impedance_magnitude, impedance_phase, phase_varies
from ehlectric.figures.bearing.pitch import (
    LEAST_VARIATION,
    breakdown_over_pitch,
    capacitance_over_pitch,
    capacitances,
    first_breakdowns,
    variation,
)
from ehlectric.figures.bearing.polar import film_around, load_around, new_polar
from ehlectric.figures.bearing.speeds import breakdown_over_speed, capacitance_over_speed
from ehlectric.figures.names import in_formats, of_cut
from ehlectric.figures.style import drawing_of, new_panels, save_figure, share_below, style, titled

Draw = Callable[[BearingResult, Axes], Axes]

# Sizes of figures; and width, height of each panel and of the title of stacked panels [inches].
_POLAR_SIZE, _SPEED_SIZE = (6.9, 4.6), (6.3, 3.7)
_WIDTH, _HEIGHT, _TITLE = 6.3, 2.1, 0.65


def _loads(_result: BearingResult) -> tuple[Draw, ...]:
    return load_around, film_around


def _circuit(result: BearingResult) -> tuple[Draw, ...]:
    if result.solution.conditions.ceramic:
        return ()
    return (contact_capacitances, *((breakdown_voltages,) if _breaks(result) else ()))


def _pitch(result: BearingResult) -> tuple[Draw, ...]:
    """Panels of the quantities that vary by more than a per cent over a pitch."""
    if result.solution.conditions.ceramic:
        return ()
    varied: list[Draw] = []
    if max(variation(capacitances(result, fill)) for fill in ("oil", "air")) > LEAST_VARIATION:
        varied.append(capacitance_over_pitch)
    if _breaks(result) and variation(first_breakdowns(result)) > LEAST_VARIATION:
        varied.append(breakdown_over_pitch)
    return tuple(varied)


def _impedance(result: BearingResult) -> tuple[Draw, ...]:
    if impedance_of(result.solution) is None:
        return ()
    return (impedance_magnitude, *((impedance_phase,) if phase_varies(result) else ()))


def _breaks(result: BearingResult) -> bool:
    return result.breaks()["first_break"] is not None


# Panels of the figures by the names of their files; no panels where the bearing has nothing to show.
FIGURES: Mapping[str, Callable[[BearingResult], tuple[Draw, ...]]] = {
    "bearing_loads.png": _loads,
    "bearing_circuit.png": _circuit,
    "bearing_pitch.png": _pitch,
    "bearing_impedance.png": _impedance,
}

# First lines of the titles of the figures.
FINDINGS: Mapping[str, Callable[[BearingResult], str]] = {
    "bearing_loads.png": findings.loads,
    "bearing_circuit.png": findings.circuit,
    "bearing_pitch.png": findings.pitch,
    "bearing_impedance.png": findings.impedance,
}


@dataclass(frozen=True)
class _OverSpeed:
    """Functions that draw a figure over speed, and give the first line of its title."""

    draw: Callable[..., Axes]
    finding: Callable[[Curves, Speed | None], str]


# Figures over the speed of the shaft.
SPEED_FIGURES: Mapping[str, _OverSpeed] = {
    "capacitance_over_speed.png": _OverSpeed(capacitance_over_speed, findings.capacitance_over_speed),
    "breakdown_over_speed.png": _OverSpeed(breakdown_over_speed, findings.breakdown_over_speed),
}


def bearing_figures_of(result: BearingResult) -> dict[str, tuple[Draw, ...]]:
    """Panels of the figures of a bearing, by the names of their files.

    Figures with nothing to show are left out. There is no circuit of ceramic elements, no breakdown without a
    dielectric strength or where surfaces touch, and no impedance without a conductivity or where surfaces
    touch. What varies by less than a per cent over a pitch of the cage is not drawn over it.
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
        speed, the bearing is computed with quick contacts at other speeds.

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
        return speed_figure(points, name, _lines_over_speed(result), own=_own_speed(result))
    panels = drawing_of(drawings | dict.fromkeys(SPEED_FIGURES, ()), name)
    voltages = breakdown_voltages in panels or breakdown_over_pitch in panels
    title = "\n".join([FINDINGS[name](result), *findings.case_lines(result, voltages=voltages)])
    polar = panels[0] is load_around
    with style():
        axes = new_polar(len(panels), _POLAR_SIZE) if polar else _stack(len(panels))
        for draw, ax in zip(panels, axes, strict=True):
            draw(result, ax)
        if not polar:
            share_below(axes)
        return titled(axes[0], title, converged=result.converged)


def speed_figure(points: Speeds, name: str, title: str = "", *, own: Speed | None = None) -> Figure:
    """Figure of a bearing over the speed of its shaft.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speed of the inner ring [rad/s], and the summary at this speed.
    name : str
        Name of its file, such as "capacitance_over_speed.png".
    title : str, optional
        Lines of the title below its first one, which states the finding.
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
    drawing = drawing_of(_speed_drawings(points), name)
    curves = curves_of(points, own)
    lines = [drawing.finding(curves, own), title, findings.curves_line(points, curves, own)]
    title = "\n".join(filter(None, lines))
    with style():
        ax = drawing.draw(points, new_panels(1, 1, _SPEED_SIZE)[0], own=own)
        return titled(ax, title, converged=all(summary["converged"] for _, summary in points))


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
        Lines of the titles below the first ones, which state the findings.
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
    """Compute a bearing with quick contacts at speeds around its own, and draw it over speed as files.

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
        Files written; none where its quick contacts have no speed.
    left_out : list of ResultWarning
        Speeds that are left out, and why.
    """
    points, left_out = over_speed(result.case)
    if not points:
        return [], left_out
    own = _own_speed(result)
    title = _lines_over_speed(result)
    return save_speed_figures(points, folder, title, own=own, formats=formats), left_out


def _speed_drawings(points: Speeds) -> dict[str, _OverSpeed]:
    """Figures of a bearing over speed, by the names of their files; no empty figures."""
    empty = set() if breaks_anywhere(points) else {breakdown_over_speed}
    return {name: drawing for name, drawing in SPEED_FIGURES.items() if drawing.draw not in empty}


def _own_speed(result: BearingResult) -> Speed:
    """Speed of the inner ring of a bearing [rad/s], and its summary."""
    return result.case.bearing.inner_speed, result.summary()


def _lines_over_speed(result: BearingResult) -> str:
    """Lines about the case in the title of a figure over speed."""
    return findings.case_lines(result, voltages=_breaks(result))[0]


def _stack(panels: int) -> list[Axes]:
    """Axes of panels below each other."""
    return new_panels(panels, 1, (_WIDTH, _HEIGHT * panels + _TITLE))
