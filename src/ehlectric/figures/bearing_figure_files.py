"""Figures of bearings by name and as files, with their findings as titles and the lines about the case."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend

from ehlectric.arrays import Array
from ehlectric.bearing import (
    BearingResult,
    Curves,
    Speed,
    Speeds,
    bearing_state,
    breaks_anywhere,
    conducts,
    critical_speed_of,
    curves_of,
    duty_of,
    impedance_of,
    lambda_ratio,
    lambda_text,
    opening_speed_of,
    over_speed,
    quick_case,
    shaft_capacitance,
    value_of,
)
from ehlectric.cases.defaults import HOW, OF_CONTACTS
from ehlectric.figures.bearing_figures import (
    LEAST_VARIATION,
    breakdown_over_pitch,
    breakdown_voltages,
    capacitance_over_pitch,
    capacitances,
    contact_capacitances,
    film_around,
    first_breakdowns,
    impedance_magnitude,
    impedance_phase,
    load_around,
    magnitude_at,
    new_polar,
    phase_varies,
    prefixed,
    read_at,
    variation,
    volts,
)
from ehlectric.figures.breakdown_over_speed import breakdown_over_speed as draw_breakdown_over_speed
from ehlectric.figures.breakdown_over_speed import capacitance_over_speed as draw_capacitance_over_speed
from ehlectric.figures.breakdown_over_speed import margin_over_speed
from ehlectric.figures.data import Panel
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.duty_panels import cycle_lines, duty_panels, time_axis
from ehlectric.figures.figure_names import DUTY_FIGURE, in_formats, of_cut
from ehlectric.figures.style import (
    drawing_of,
    legend_above,
    new_panels,
    save_each,
    share_below,
    style,
    titled,
)
from ehlectric.quantities.formats import operating_point, speed_text, time_share_text
from ehlectric.quantities.lubrication_states import BOUNDARY, FREQUENT, FULL, MIXED
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import ratio_text, readable

_SHORTED = (BOUNDARY.name, FREQUENT.name)


def loads(result: BearingResult) -> str:
    """Sentence: the contacts with the largest load and the minimum film, at the first cage position."""
    rows = result.contacts()
    most = max(rows, key=lambda row: row["load"])
    thinnest = min(rows, key=lambda row: row["minimum_thickness"])
    least = prefixed(thinnest["minimum_thickness"], "m", least=0.1)
    text = f"Largest load {readable(most['load'])} N ({_contact(most)})"
    text += f"; minimum film {least} ({_contact(thinnest)}), λ {lambda_text(result.solution)}"
    state = bearing_state(result.solution)
    return text + (f": {state}" if state in _SHORTED else "")


def _contact(row: Mapping[str, Any]) -> str:
    """Name of a contact of the table of contacts."""
    return f"{row['ring']}, element {row['element']}"


def circuit(result: BearingResult) -> str:
    """Sentence: whether breakdown is expected, with the margin; without one, the capacitance."""
    breaks, shaft = result.breaks(), result.shaft_voltage
    if breaks["first_break"] is None:
        if conducts(result.solution):
            return f"{bearing_state(result.solution).capitalize()}: discharges likely, no voltage computed"
        value = result.capacitance(result.case.bearing.fill)
        return f"Capacitance of the bearing: {prefixed(value, 'F')}"
    first = volts(breaks["shaft_first_break"])
    if shaft is None:
        return f"First breakdown at {first}: {breaks['first_break_at']}"
    verdict, margin, lead = result.verdict, breaks["margin"], "Margin"
    if verdict is not None and verdict.level != "grey":
        lead = f"{verdict.lead}: margin"
    return f"{lead} {ratio_text(margin)} (first breakdown {first} / shaft voltage {volts(shaft)})"


def pitch(result: BearingResult) -> str:
    """Sentence: how much capacitance and first breakdown vary over a pitch of the cage."""
    varied = 100.0 * variation(capacitances(result, result.case.bearing.fill))
    text = f"Over a pitch of the cage, the capacitance varies by {readable(varied, 2)} %"
    if result.breaks()["first_break"] is None:
        return text
    return f"{text}, the first breakdown by {readable(100.0 * variation(first_breakdowns(result)), 2)} %"


def impedance(result: BearingResult) -> str:
    """Sentence: the capacitance that the bearing is above its corner frequency, and its impedance there."""
    curve = impedance_of(result.solution)
    assert curve is not None
    shown = [(prefixed(magnitude_at(curve.mean or curve, at), "Ω"), at) for at in read_at(result)]
    values = ", ".join(f"{value} at {prefixed(at, 'Hz')}" for value, at in shown)
    if curve.mean is not None:
        share = time_share_text(float(duty_of(result.solution).touching_time_share))
        return f"An element is in contact with both rings {share}: mean |Z| = {values}"
    value = prefixed(float(shaft_capacitance(result.solution)), "F")
    return f"A capacitor of {value} above {prefixed(curve.corner, 'Hz')}: |Z| = {values}"


def margin(result: BearingResult) -> str:
    """Sentence: the probability of breakdown at the speed of the bearing, and the interval of its margin."""
    assert result.uncertainty is not None
    chance = result.uncertainty.chance
    interval = f"margin {ratio_text(chance.low)} to {ratio_text(chance.high)} in 90 of 100 cases"
    if chance.failed:
        interval = f"{chance.failed} of {chance.samples} points have no result"
    lead = result.verdict.lead
    return f"{lead} at {speed_text(result.case.bearing.inner_speed)}: probability {chance.text}, {interval}"


def duty_cycle(result: BearingResult) -> str:
    """Return a sentence with the time share of expected breakdown in a duty cycle, and a line with the shares
    of lubrication states.
    """
    assert result.duty is not None
    summary = result.duty.summary()
    names = {"full_film": FULL.name, "mixed_lubrication": MIXED.name, "asperity_contact": FREQUENT.name}
    names["standstill"] = "standstill"
    shares = [f"{name} {readable(100.0 * summary[f'{key}_share'])} %" for key, name in names.items()]
    what, share = "Breakdown expected", summary["breakdown_share"]
    if share is None:
        what, share = "Full film", summary["full_film_share"]
    return f"{what} for {readable(100.0 * share)} % of the time\n{', '.join(shares)}"


def duty_lines(result: BearingResult) -> list[str]:
    """Lines: title of the case, and how the films of its duty cycle were computed."""
    duty = result.duty
    assert duty is not None
    text = f"{duty.points} operating points, contacts {HOW[duty.contacts]}"
    if duty.interpolation_error is not None:
        text += f", interpolated within {readable(100.0 * duty.interpolation_error, 2)} %"
    return cycle_lines(result.case.title, duty.source, text)


def capacitance_over_speed(curves: Curves, at_case: Speed | None) -> str:
    """Sentence: the capacitance at the lowest and the highest speed, and at the speed of the bearing."""
    values = curves["capacitance"]
    ends = [f"{prefixed(float(values[k]), 'F')} at {speed_text(curves.speed[k])}" for k in (0, -1)]
    if at_case is not None:
        ends[1] += f"; {prefixed(at_case[1]['bearing']['capacitance'], 'F')} at {speed_text(at_case[0])}"
    return f"Capacitance {', '.join(ends)}"


def breakdown_over_speed(curves: Curves, at_case: Speed | None) -> str:
    """Sentence: at which speeds the margin is below 1, and the margin of the bearing itself."""
    margin = curves["first_break"] / curves["shaft_voltage"]
    known = np.isfinite(margin)
    case_text = ""
    if at_case is not None and (value := value_of(at_case[1], "first_break")) is not None:
        shaft = at_case[1]["bearing"]["shaft_voltage"]
        case_text = f"{volts(value)}" if shaft is None else f"margin {ratio_text(value / shaft)}"
        case_text += f" at {speed_text(at_case[0])}"
    opening = opening_speed_of(curves)
    below = "" if opening is None else f"; frequent asperity contact below {speed_text(opening)}"
    if not np.any(known):
        first = np.flatnonzero(np.isfinite(curves["first_break"]))
        ends = [f"{volts(curves['first_break'][k])} at {speed_text(curves.speed[k])}" for k in first[[0, -1]]]
        span = f"First breakdown at {case_text}" if case_text else f"First breakdown from {' to '.join(ends)}"
        return f"{span}{below}"
    text = f"{_where(curves, margin[known], curves.speed[known])}{below}"
    return f"{text} ({case_text})" if case_text else text


def _where(curves: Curves, margin: Array, speed: Array) -> str:
    """Clause: the speeds at which the margin is below 1."""
    critical = critical_speed_of(curves)
    lowest = curves.touching or max(float(speed[0]), opening_speed_of(curves) or 0.0)
    span = f"from {speed_text(lowest)} to {speed_text(float(speed[-1]))}"
    if critical is None:
        if np.all(margin >= 1.0):
            return f"Margin above 1 {span}"
        if np.all(margin < 1.0):
            return f"Margin below 1 at all speeds {span}"
        return f"Margin below 1 above {speed_text(float(speed[margin >= 1.0][-1]))}"
    some = "" if np.all(margin[speed < critical] < 1.0) else " at some speeds"
    return f"Margin below 1{some} up to about {speed_text(critical)}"


def case_lines(result: BearingResult, *, voltages: bool) -> list[str]:
    """Lines: title of the case, duty as far as the title lacks it, and how the films were computed."""
    bearing, title = result.solution.case.bearing, result.solution.case.title
    duty = [
        f"{readable(load, 4)} N {way}"
        for load, way in ((bearing.radial_load, "radial"), (bearing.axial_load, "axial"))
        if load
    ]
    duty += operating_point(bearing.inner_speed, bearing.oil_temperature)
    parts = [part for part in duty if part not in title]
    line = ", ".join([*filter(None, [textwrap.shorten(title, 70, placeholder=" ...")]), *parts])
    return [line, film_line(result, voltages=voltages)]


def film_line(result: BearingResult, *, voltages: bool) -> str:
    """Line: how the films were computed, and what that means for voltages."""
    solution = result.solution
    factor = solution.conditions.film_factor
    text = "isothermal, fully flooded film" if factor == 1.0 else f"film factor {readable(float(factor))}"
    text += f", minimum λ {lambda_text(solution)}"
    text += f", contacts {HOW[solution.case.contacts]}"
    state = bearing_state(solution)
    if state in _SHORTED:
        return f"{text}: {state}"
    return text + (": voltages are upper bounds" if voltages and solution.case.bearing.bounding else "")


def curves_line(points: Speeds, curves: Curves, at_case: Speed | None) -> str:
    """Line: how the curves over speed were computed, and how they were scaled to the bearing itself."""
    contacts = sorted({OF_CONTACTS[summary["bearing"]["contacts"]] for _, summary in points})
    text = f"curves: {' or '.join(contacts)}"
    if at_case is None or at_case[1]["bearing"]["contacts"] != "solved":
        return text
    factors = [curves.scaled[key] for key in ("capacitance", "first_break") if curves.scaled[key] != 1.0]
    if not factors:
        return text
    values = " and ".join(readable(factor) for factor in factors)
    return f"{text}, scaled by {values} to the solved contacts at {speed_text(at_case[0])} (star)"


Draw = Callable[[BearingResult, Axes], Axes]

# Sizes of figures; and width, height of each panel and of the title of stacked panels [inches].
_POLAR_SIZE, _SPEED_SIZE = (6.9, 4.6), (6.3, 3.7)

# Lines of a title and rows of a legend that polar panels have room for, and the height of each more [inches].
_LINES, _ROWS, _LINE = 3, 2, 0.2
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


def _duty(result: BearingResult) -> tuple[Draw, ...]:
    """Panels of a duty cycle; none without one."""
    duty = result.duty
    if duty is None:
        return ()

    def draw(number: int, panel: Panel) -> Draw:
        def drawn(_: BearingResult, ax: Axes) -> Axes:
            draw_panel(panel, ax, time_axis(duty.rows))
            bands = [area for area in ax.collections if not str(area.get_label()).startswith("_")]
            if bands and not number:
                legend_above(ax, bands, columns=3)
            return ax

        return drawn

    return tuple(draw(number, panel) for number, panel in enumerate(duty_panels(duty)))


def _breaks(result: BearingResult) -> bool:
    return result.breaks()["first_break"] is not None


def _margin(result: BearingResult) -> tuple[Draw, ...]:
    return () if result.margin_band is None else (margin_over_speed,)


# Functions of the panels and of the first line of the title, by the names of the files. A figure without
# panels has nothing to show.
FIGURES: Mapping[str, tuple[Callable[[BearingResult], tuple[Draw, ...]], Callable[[BearingResult], str]]] = {
    "bearing_loads.png": (_loads, loads),
    "bearing_circuit.png": (_circuit, circuit),
    "bearing_pitch.png": (_pitch, pitch),
    "bearing_impedance.png": (_impedance, impedance),
    "bearing_margin.png": (_margin, margin),
    DUTY_FIGURE: (_duty, duty_cycle),
}

# Functions that draw a figure over the speed of the shaft, and give the first line of its title.
SpeedDrawing = tuple[Callable[..., Axes], Callable[[Curves, Speed | None], str]]
SPEED_FIGURES: Mapping[str, SpeedDrawing] = {
    "capacitance_over_speed.png": (draw_capacitance_over_speed, capacitance_over_speed),
    "breakdown_over_speed.png": (draw_breakdown_over_speed, breakdown_over_speed),
}


def bearing_figures_of(result: BearingResult) -> dict[str, tuple[Draw, ...]]:
    """Panels of the figures of a bearing, by the names of their files.

    Figures with nothing to show are omitted. There is no circuit of ceramic elements, no breakdown without a
    dielectric strength or where surfaces touch, and no impedance without a conductivity or where surfaces
    touch, and no duty cycle without the table ``duty``. What varies by less than a per cent over a pitch of
    the cage is not drawn over it.
    """
    panels = {name: panels_of(result) for name, (panels_of, _) in FIGURES.items()}
    return {name: draws for name, draws in panels.items() if draws}


def default_name(result: BearingResult) -> str:
    """Name of the most informative figure of a bearing: breakdown over speed, else the loads."""
    return "breakdown_over_speed.png" if _breaks(result) else next(iter(bearing_figures_of(result)))


def names_over_speed(result: BearingResult) -> list[str]:
    """Names of the figures of a bearing over speed, as far as its estimated contacts give them."""
    case, _ = quick_case(result.case)
    if case is None:
        return []
    breaks = case.discharge.has_strength and not result.solution.conditions.ceramic
    return [name for name in SPEED_FIGURES if breaks or not name.startswith("breakdown")]


def lacking(result: BearingResult, file: str) -> str | None:
    """Why a bearing lacks a figure that other bearings have; None if no bearing has it."""
    if file not in (*FIGURES, *SPEED_FIGURES):
        return None
    if file == DUTY_FIGURE:
        return "the figure of a duty cycle needs [duty], which is missing in the case"
    if result.solution.conditions.ceramic:
        return "the others need elements that conduct, and this bearing has ceramic ones"
    if not result.case.discharge.has_strength:
        return "figures of breakdown need discharge.dielectric_strength, which the case does not give"
    return "this bearing has nothing to show in the others"


def figure(result: BearingResult, name: str) -> Figure:
    """Figure of a bearing. Raises InputError where the bearing has no figure of this name."""
    drawings = bearing_figures_of(result)
    (name,) = in_formats([name])
    if name in SPEED_FIGURES:
        points, _ = over_speed(result.case, ratio_of_case=_lambda_ratio(result))
        return speed_figure(points, name, _lines_over_speed(result), at_case=_speed_and_summary(result))
    panels = drawing_of(drawings | dict.fromkeys(SPEED_FIGURES, ()), name)
    voltages = breakdown_voltages in panels or breakdown_over_pitch in panels
    lines = duty_lines(result) if name == DUTY_FIGURE else case_lines(result, voltages=voltages)
    title = "\n".join([FIGURES[name][1](result), *lines])
    polar = panels[0] is load_around
    with style():
        axes = new_polar(len(panels), _POLAR_SIZE) if polar else _stack(len(panels))
        for draw, ax in zip(panels, axes, strict=True):
            draw(result, ax)
        if not polar:
            share_below(axes)
        drawn = titled(axes[0], title, converged=result.converged)
        if polar:
            _make_room(drawn, axes)
        return drawn


def _make_room(figure: Figure, axes: Sequence[Axes]) -> None:
    """Make a figure of polar panels higher where its title or a legend has more lines than usual."""
    legends = (ax.get_legend() for ax in axes)
    rows = max(_rows(legend) for legend in legends if legend is not None)
    lines = figure.get_suptitle().count("\n") + 1
    more = max(0, lines - _LINES) + max(0, rows - _ROWS)
    figure.set_figheight(figure.get_figheight() + _LINE * more)


def _rows(legend: Legend) -> int:
    """Number of lines of a legend whose entries fill two columns, the first column first."""
    lines = [text.get_text().count("\n") + 1 for text in legend.get_texts()]
    first = math.ceil(len(lines) / 2)
    return max(sum(lines[:first]), sum(lines[first:]))


def speed_figure(points: Speeds, name: str, title: str = "", *, at_case: Speed | None = None) -> Figure:
    """Figure of a bearing over the speed of its shaft. ``points``, speed of the inner ring [rad/s], and the
    summary at this speed. Raises InputError where there is no figure of this name, or the bearing has no
    breakdown voltage at any speed.
    """
    draw, finding = drawing_of(_speed_drawings(points), name)
    curves = curves_of(points, at_case)
    lines = [finding(curves, at_case), title, curves_line(points, curves, at_case)]
    title = "\n".join(filter(None, lines))
    with style():
        ax = draw(points, new_panels(1, 1, _SPEED_SIZE)[0], at_case=at_case)
        return titled(ax, title, converged=all(summary["converged"] for _, summary in points))


def save_speed_figures(
    points: Speeds,
    folder: Path,
    title: str = "",
    *,
    at_case: Speed | None = None,
    formats: Sequence[str] = ("png",),
    at: Mapping[str, str] | None = None,
) -> list[Path]:
    """Draw capacitance and, where there are any, breakdown voltages over the speed as files. ``points``,
    speed of the inner ring [rad/s], and the summary at this speed.
    """
    files = {of_cut(name, at): name for name in _speed_drawings(points)}
    return save_each(
        lambda file: speed_figure(points, files[file], title, at_case=at_case), files, folder, formats
    )


def save_over_speed(
    result: BearingResult, folder: Path, formats: Sequence[str] = ("png",)
) -> tuple[list[Path], list[ResultWarning]]:
    """Compute a bearing with estimated contacts at speeds around its own, and draw it over speed as files.
    Returns ``files``, files written; none where its estimated contacts have no speed; ``left_out``, speeds
    that are skipped, and why.
    """
    points, left_out = over_speed(result.case, ratio_of_case=_lambda_ratio(result))
    if not points:
        return [], left_out
    at_case = _speed_and_summary(result)
    title = _lines_over_speed(result)
    return save_speed_figures(points, folder, title, at_case=at_case, formats=formats), left_out


def _speed_drawings(points: Speeds) -> dict[str, SpeedDrawing]:
    """Figures of a bearing over speed that have something to show, by the names of their files."""
    empty = set() if breaks_anywhere(points) else {draw_breakdown_over_speed}
    return {name: pair for name, pair in SPEED_FIGURES.items() if pair[0] not in empty}


def _speed_and_summary(result: BearingResult) -> Speed:
    """Speed of the inner ring of a bearing [rad/s], and its summary."""
    return result.case.bearing.inner_speed, result.summary()


def _lambda_ratio(result: BearingResult) -> float:
    """Lambda ratio of a bearing at its own speed, to which films at other speeds are scaled."""
    return float(lambda_ratio(result.solution))


def _lines_over_speed(result: BearingResult) -> str:
    """Lines about the case in the title of a figure over speed."""
    return case_lines(result, voltages=_breaks(result))[0]


def _stack(panels: int) -> list[Axes]:
    """Axes of panels below each other."""
    return new_panels(panels, 1, (_WIDTH, _HEIGHT * panels + _TITLE))
