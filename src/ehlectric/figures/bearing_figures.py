"""Figures of bearings: loads and films around the shaft, circuit, impedance, and a turn by one pitch."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.projections.polar import PolarAxes
from matplotlib.text import Text
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from ehlectric.arrays import Array
from ehlectric.bearing import (
    BearingResult,
    Impedance,
    impedance_of,
    shaft_first_break,
    shaft_leakage,
    shaft_path,
    shaft_ring_to_ring_breakdown,
)
from ehlectric.figures import contact_findings
from ehlectric.figures.data import Panel, is_wide, with_unit
from ehlectric.figures.draw import draw_area, draw_curves, line_look
from ehlectric.figures.figure_names import broken
from ehlectric.figures.ring_panels import film_panel, load_panel
from ehlectric.figures.speed_panels import SHAFT, breakdown_lines
from ehlectric.figures.style import (
    axes_or_new,
    figure_of,
    label_point,
    legend_above,
    new_figure,
    note,
    outlined,
    page_size,
    round_numbers,
    text_colour,
)
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Text: value with three digits and a prefixed unit, in which it is at least 1.
prefixed = partial(contact_findings.with_unit, least=1.0)


def volts(value: float) -> str:
    """Text: voltage with three digits.

    Examples
    --------
    >>> volts(5.8617)
    '5.86 V'
    """
    return f"{value:#.3g}".rstrip(".") + " V"


class _End(Text):
    """Name of a line at the right edge of axes, at the height of the line or next to the names around it."""

    names: Sequence[_End]  # names at the edge of these axes, from the lowest line to the highest
    end: float  # value at the end of the line

    def draw(self, renderer: Any) -> None:
        """Draw the name clear of the others, whatever height the layout gives the axes."""
        ax = self.axes
        assert ax is not None
        low, high = ax.bbox.y0, ax.bbox.y1
        half = np.array([0.55 * name.get_window_extent(renderer).height for name in self.names])
        at = [ax.transData.transform((1.0, np.clip(name.end, *ax.get_ylim())))[1] for name in self.names]
        apart = half[1:] + half[:-1]
        for k in range(1, len(at)):
            at[k] = max(at[k], at[k - 1] + apart[k - 1])
        # The highest name ends with the axes, and no name stands in what is above them.
        at[-1] = min(at[-1], high - half[-1])
        for k in range(len(at) - 2, -1, -1):
            at[k] = min(at[k], at[k + 1] - apart[k])
        self.set_y((at[list(self.names).index(self)] - low) / (high - low))
        super().draw(renderer)


def label_ends(ax: Axes, ends: Sequence[tuple[float, str, str]]) -> None:
    """Write the names of lines next to the right edge of the axes, at their heights and without overlap."""
    look: dict[str, Any] = {"transform": ax.transAxes, "fontsize": "small", "va": "center"}
    ordered = sorted(ends)
    names = [_End(1.015, 0.5, text, color=text_colour(colour), **look) for _, text, colour in ordered]
    for name, (value, _, _) in zip(names, ordered, strict=True):
        name.names, name.end = names, value
        name.set_clip_on(False)
        ax.add_artist(name)


def fill_text(fill: float | str) -> str:
    """Text about what fills the gap around the films.

    Examples
    --------
    >>> fill_text("air"), fill_text(0.3)
    ('air fill', '30 % oil fill')
    """
    return f"{fill} fill" if isinstance(fill, str) else f"{readable(100.0 * fill)} % oil fill"


# Radius of the inner circle, at which the scale begins, over the radius of the outer circle.
_CORE = 0.3

# With more round numbers than this along a logarithmic radius, only powers of ten have ticks.
_MOST_TICKS = 7


def new_polar(columns: int, size: tuple[float, float]) -> list[Axes]:
    """Polar axes side by side in a new figure, whose size on the screen is in inches."""
    figure = new_figure(page_size(size))
    return list(figure.subplots(1, columns, squeeze=False, subplot_kw={"projection": "polar"}).ravel())


def load_around(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the load of both contacts of the elements around the shaft. Returns polar axes on which the radial
    load on the inner ring points down.
    """
    return _draw_around(result, load_panel(result), ax)


def film_around(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the minimum film thickness of the loaded contacts of the elements around the shaft. Returns polar
    axes on which the radial load points down.
    """
    return _draw_around(result, film_panel(result), ax)


def _draw_around(result: BearingResult, panel: Panel, ax: Axes | None) -> Axes:
    ax = _polar_or_new(result, ax)
    for line in draw_curves(panel.curves, ax):
        # The marks of contacts without load lie on the inner circle.
        line.set_clip_on(line.get_marker() == "None")
    for area in panel.areas:
        draw_area(area, ax)
    _radius(ax, panel, _between(result))
    ax.set_title(with_unit(panel.title, panel.unit))
    _legend_below(ax)
    return ax


def _polar_or_new(result: BearingResult, ax: Axes | None) -> PolarAxes:
    polar = new_polar(1, (3.6, 4.2))[0] if ax is None else ax
    assert isinstance(polar, PolarAxes)
    # The radial load points down.
    polar.set_theta_zero_location("S")
    angles = np.arange(0, 360, 45)
    load = "radial load, 0°" if result.solution.case.bearing.radial_load else "0°"
    polar.set_thetagrids(angles, [load, *(f"{angle}°" for angle in angles[1:])])
    polar.grid(lw=0.6)
    return polar


def _between(result: BearingResult) -> float:
    """Angle near the top, halfway between two elements at the first position of the cage [rad]."""
    first_row = result.solution.positions[0].equilibrium.position[: result.solution.case.bearing.elements]
    at = np.sort(np.mod(first_row, 2.0 * np.pi))
    halfway = 0.5 * (at + np.append(at[1:], at[0] + 2.0 * np.pi))
    return float(halfway[np.argmin(np.abs(halfway - np.pi))])


def _radius(ax: Axes, panel: Panel, at: float) -> None:
    """Scale the radius from an inner circle outwards, and write a few numbers along an angle [rad]."""
    assert isinstance(ax, PolarAxes)
    low, high = panel.bottom, panel.top
    if panel.log:
        ax.set_rscale("log")
        ticks = round_numbers(low, high)
        if ticks.size > _MOST_TICKS:
            ticks = np.array([tick for tick in ticks if math.isclose(math.log10(tick) % 1.0, 0.0)])
        origin = low * (low / high) ** (_CORE / (1.0 - _CORE))
    else:
        step = 10.0 ** math.floor(math.log10(high))
        step *= next(part for part in (0.2, 0.5, 1.0, 2.0) if high <= 5.0 * part * step)
        ticks = np.arange(0.0, high, step)
        origin = -high * _CORE / (1.0 - _CORE)
    ax.set_rlim(low, high)
    ax.set_rorigin(origin)
    ax.yaxis.set_major_locator(FixedLocator(list(ticks)))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.tick_params(axis="y", labelleft=False)
    # Labels of an axis would lie below the lines: these texts lie above them.
    for tick in ticks:
        where: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": "small", "zorder": 6.0}
        ax.text(at, tick, f"{tick:g}", path_effects=outlined(2.4), **where)


# Letters of a line, and lines of an entry, of a legend with two columns below one of two rings.
_LETTERS, _LINES = 30, 2


def _legend_below(ax: Axes) -> None:
    handles, labels = ax.get_legend_handles_labels()
    order = sorted(range(len(labels)), key=lambda k: ("inner" not in labels[k], "outer" not in labels[k], k))
    ax.legend(
        [handles[k] for k in order],
        [broken(labels[k], _LETTERS, _LINES) for k in order],
        loc="upper center",
        bbox_to_anchor=(0.5, -0.1),
        ncols=2,
        frameon=False,
        columnspacing=1.0,
        labelspacing=0.35,
        borderpad=0.1,
        handlelength=1.5,
    )


# Largest number of elements that have a tick on the axis of a figure of this width [inches]. Fewer have one
# in a narrower figure.
_NUMBERED, _WIDTH = 16, 6.0


def contact_capacitances(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the capacitance of both contacts of every element, with the cage at its first position. Returns
    axes that state the capacitance of the bearing at this position of the cage.
    """
    ax = axes_or_new(ax)
    fill = result.solution.case.bearing.fill
    circuit = result.solution.circuits(fill)[0]
    inner, outer = (ring.capacitance(fill) for ring in result.solution.positions[0].rings)
    factor, unit = unit_for(float(max(np.max(inner), np.max(outer))), "F", least=1.0)
    at = np.arange(inner.size)
    ax.bar(at - 0.2, factor * inner, 0.4, color=BLUE, label="inner contact")
    ax.bar(at + 0.2, factor * outer, 0.4, color=ORANGE, label="outer contact")
    ax.set_ylabel(f"capacitance\n[{unit}]")
    _elements(result, ax)
    # The capacitance in summary.json is the mean over a pitch, the capacitance at this position differs.
    here, mean = circuit.capacitance, result.capacitance(fill)
    total, of = unit_for(mean, "F", least=1.0)
    text = f"bearing, {fill_text(fill)}: mean {readable(total * mean, 4)} {of}\n"
    text += f"at this cage position {readable(float(total * here), 4)} {of}"
    ax.set_ylim(0.0, 1.4 * ax.dataLim.ymax)
    note(ax, 0.5, 0.97, text, ha="center", va="top")
    legend_above(ax)
    return ax


def breakdown_voltages(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the bearing voltage at which each contact breaks down under its share of the voltage.

    With a coating on a ring it is the shaft voltage, of which the coating has a part.

    Returns axes with the contacts at the first position of the cage.
    """
    ax = axes_or_new(ax)
    circuit, position = result.solution.circuits()[0], result.solution.positions[0]
    shaft, path = result.shaft_voltage, shaft_path(result.solution)
    share, inner_part = path.film_share(circuit.capacitance), position.inner_share(circuit)
    at, summits = np.arange(inner_part.size), result.solution.summits
    inner, outer = (
        ring.values.breakdown_voltage * ring.part_left(summits) / part / share
        for ring, part in zip(position.rings, (inner_part, 1.0 - inner_part), strict=True)
    )
    everything = np.concatenate([inner, outer, [] if shaft is None else [shaft]])
    if is_wide(everything):
        ax.set_yscale("log")
        ax.set_ylim(0.6 * np.min(everything), 1.5 * np.max(everything))
        ax.yaxis.set_major_locator(FixedLocator(list(round_numbers(*ax.get_ylim()))))
        ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        ax.yaxis.set_minor_locator(NullLocator())
    else:
        ax.set_ylim(0.0, 1.15 * np.max(everything))
    if shaft is not None:
        ax.axhspan(ax.get_ylim()[0], shaft, color=ORANGE, alpha=0.12, lw=0.0, zorder=0.0)
        text, edge = "below the shaft voltage: breakdown", outlined(2.0)  # marks may lie where it stands
        note(ax, 0.01, 0.03, text, color=ORANGE, path_effects=edge, zorder=5.0)
    for name, values, ring, shift, marker, colour in (
        ("inner", inner, position.inner, -0.12, "o", BLUE),
        ("outer", outer, position.outer, 0.12, "s", ORANGE),
    ):
        look: dict[str, Any] = {"ls": "none", "ms": 6.0, "zorder": 4.0, "marker": marker, "color": colour}
        ax.plot(at + shift, values, label=f"{name} contact", **look)
        free = ~ring.solved
        if np.any(free):
            ax.plot(
                (at + shift)[free], values[free], **(look | {"mfc": "white", "label": f"{name}, unloaded"})
            )
    _levels(result, ax)
    ax.set_ylabel(f"{'shaft' if path.coated else 'bearing'} voltage at\nbreakdown [V]")
    _elements(result, ax)
    legend_above(ax, [line for line in ax.get_lines() if line.get_marker() != "None"], columns=4)
    return ax


def _levels(result: BearingResult, ax: Axes) -> None:
    """Draw lines at the voltages of the whole bearing, as far as there are any, and name them at the edge."""
    breaks, shaft = result.breaks(), result.shaft_voltage
    first, through = breaks["shaft_first_break"], breaks["shaft_ring_to_ring_breakdown"]
    levels = [] if shaft is None else [("shaft voltage", shaft, SHAFT)]
    lines = breakdown_lines(np.array([first]), np.array([through]))
    levels += [(name, float(value), look) for _, name, (value,), look in lines]
    for name, value, look in levels:
        ax.axhline(value, label=name.replace("\n", " "), **line_look(*look))
    label_ends(ax, [(value, f"{name}\n{volts(value)}", look[0]) for name, value, look in levels])


def _elements(result: BearingResult, ax: Axes) -> None:
    """Label the axis of the elements with their numbers and their angles from the radial load."""
    angles = np.degrees(result.solution.positions[0].equilibrium.position)
    numbered = _NUMBERED * min(1.0, figure_of(ax).get_figwidth() / _WIDTH)
    ticks = np.arange(0, angles.size, math.ceil(angles.size / numbered))
    ax.set_xticks(ticks, [f"{k}\n{angles[k]:.0f}°" for k in ticks])
    ax.set_xlim(-0.6, angles.size - 0.4)
    radial = result.solution.case.bearing.radial_load > 0.0
    ax.set_xlabel("element, and its angle" + (" from the radial load" if radial else ""))


# A quantity that varies by less than this part of its mean over a pitch is a number, not a figure.
LEAST_VARIATION = 0.01


def capacitances(result: BearingResult, fill: float | str) -> Array:
    """Capacitance of the bearing at each position of the cage, with "oil" or "air" around the films [F]."""
    return np.array([circuit.capacitance for circuit in result.solution.circuits(fill)])


def first_breakdowns(result: BearingResult) -> Array:
    """Voltage of the first breakdown at each position of the cage, on the bearing with its coating [V]."""
    path = shaft_path(result.solution)
    return np.array([shaft_first_break(circuit, path) for circuit in result.solution.circuits()])


def variation(values: Array) -> float:
    """Difference of the largest and the smallest value, divided by their mean, dimensionless.

    Examples
    --------
    >>> variation(np.array([9.0, 10.0, 11.0]))
    0.2
    """
    return float(np.ptp(values) / np.mean(values))


def capacitance_over_pitch(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the capacitance of the bearing while the cage turns by one pitch of the elements. Returns axes
    with the difference from the mean in per cent, for oil and for air around the films.
    """
    ax = axes_or_new(ax)
    for fill, look in (("oil", {"color": BLUE}), ("air", {"color": GREY, "ls": "--"})):
        values = capacitances(result, fill)
        mean = float(np.mean(values))
        factor, unit = unit_for(mean, "F", least=1.0)
        label = f"{fill} around the films, mean {readable(factor * mean, 4)} {unit}"
        _over_pitch(result, ax, 100.0 * (values / mean - 1.0), label, look)
    ax.axhline(0.0, color="black", lw=0.6)
    ax.set_ylabel("capacitance,\ndifference from\nthe mean [%]")
    legend_above(ax)
    return ax


def breakdown_over_pitch(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw first and ring-to-ring breakdown while the cage turns by one pitch of the elements. Returns axes
    that also show the shaft voltage if there is one.
    """
    ax = axes_or_new(ax)
    first = first_breakdowns(result)
    path = shaft_path(result.solution)
    through = np.array(
        [shaft_ring_to_ring_breakdown(circuit, path) for circuit in result.solution.circuits()]
    )
    lines = breakdown_lines(first, through)
    for _, name, values, look in lines:
        _over_pitch(result, ax, values, name.replace("\n", " "), line_look(*look))
    shaft = result.shaft_voltage
    ends = [
        (float(values[0]), f"{name}\nmin. {volts(np.min(values))}", look[0])
        for _, name, values, look in lines
    ]
    if shaft is not None:
        ax.axhline(shaft, label="shaft voltage", **line_look(*SHAFT))
        ends.append((shaft, f"shaft voltage\n{volts(shaft)}", SHAFT[0]))
    ax.set_ylim(0.0, 1.15 * max(float(np.max(through)), shaft or 0.0))
    ax.set_ylabel(f"{'shaft' if path.coated else 'bearing'} voltage [V]")
    label_ends(ax, ends)
    return ax


def _over_pitch(result: BearingResult, ax: Axes, values: Array, label: str, look: dict[str, Any]) -> None:
    """Draw values over the positions of the cage; the end of the pitch has the first value again."""
    pitch = 360.0 / result.solution.case.bearing.elements
    angle = np.linspace(0.0, pitch, values.size + 1)
    ax.plot(angle, np.append(values, values[0]), marker="o", ms=4.0, clip_on=False, label=label, **look)
    ax.set(xlim=(0.0, pitch), xlabel="turn of the cage from its first position [°]")


# Frequencies of a common inverter [Hz]: from the lowest switching frequency to those in the edges of its
# voltage, 1/(pi t) for a rise time t of 60 ns. They are no values of the case.
INVERTER = 4e3, 5e6

# The axis begins at this frequency [Hz], or lower, so that it shows a corner above _NOTED [Hz] by a decade.
_BEGIN, _NOTED = 1e3, 100.0

# A phase within this distance of the phase of a capacitor or of a resistor is a number, not a figure
# [degrees].
_CONSTANT = 2.0


def impedance_magnitude(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the magnitude of the bearing's impedance over the frequency. Returns axes with two logarithmic
    scales, from 1 kHz or a decade below the corner frequency.
    """
    ax = axes_or_new(ax)
    frequency, magnitude, _ = _shown(_impedance(result))
    mean = _impedance(result).mean
    ax.loglog(frequency, magnitude, color=BLUE)
    if mean is not None:
        ax.loglog(
            mean.frequency, mean.magnitude, color=ORANGE, ls="--", label="mean, with contacts of asperities"
        )
        ax.legend(loc="lower left", fontsize="small")
    ax.set_ylabel(r"magnitude $|Z|$ [Ω]")
    low, high = INVERTER
    text = "switching frequency to voltage edges\nof a common inverter"
    note(ax, (low * high) ** 0.5, 0.95, text, data_axis="x", ha="center", va="top", color=ORANGE)
    for at in read_at(result):
        value = magnitude_at(_impedance(result), at)
        ax.plot([at], [value], ls="none", marker="o", ms=4.5, color=BLUE)
        text = f"{prefixed(value, 'Ω')} at {prefixed(at, 'Hz')}"
        label_point(ax, (at, value), text, (5.0, 3.0), va="bottom", fontsize="small")
    _over_frequency(result, ax)
    return ax


def impedance_phase(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the phase of the bearing's impedance over the frequency. Returns axes from -90 degrees (a
    capacitor) to 0 (a resistor).
    """
    ax = axes_or_new(ax)
    frequency, _, phase = _shown(_impedance(result))
    mean = _impedance(result).mean
    ax.semilogx(frequency, phase, color=BLUE)
    if mean is not None:
        ax.semilogx(mean.frequency, mean.phase, color=ORANGE, ls="--")
    ax.set(ylabel="phase [°]", ylim=(-95.0, 5.0), yticks=[-90, -60, -45, -30, 0])
    _over_frequency(result, ax)
    return ax


def phase_varies(result: BearingResult) -> bool:
    """Whether the phase in the drawn range differs by more than two degrees, or contacts change it."""
    curve = _impedance(result)
    return curve.mean is not None or bool(np.ptp(_shown(curve)[2]) > _CONSTANT)


def read_at(result: BearingResult) -> tuple[float, ...]:
    """Frequencies at which the figure states the impedance [Hz]: 20 kHz and 1 MHz, if it shows them."""
    frequency = _shown(_impedance(result))[0]
    return tuple(at for at in (2e4, 1e6) if frequency[0] <= at <= frequency[-1])


def magnitude_at(impedance: Impedance, frequency: float) -> float:
    """Magnitude of an impedance at a frequency [Ohm], interpolated as a power of the frequency."""
    logs = np.log(impedance.frequency), np.log(impedance.magnitude)
    return float(np.exp(np.interp(np.log(frequency), *logs)))


def _impedance(result: BearingResult) -> Impedance:
    impedance = impedance_of(result.solution)
    assert impedance is not None
    return impedance


def _shown(impedance: Impedance) -> tuple[Array, Array, Array]:
    """Frequency, magnitude and phase in the range of the figure."""
    # The node before the lower end is among them, so that the line reaches this end.
    first = max(int(np.searchsorted(impedance.frequency, _low(impedance), side="right")) - 1, 0)
    shown = slice(first, None)
    return impedance.frequency[shown], impedance.magnitude[shown], impedance.phase[shown]


def _over_frequency(result: BearingResult, ax: Axes) -> None:
    """Label the axis of the frequency, shade the band of an inverter, and mark the corner frequency."""
    impedance = _impedance(result)
    frequency = _shown(impedance)[0]
    ax.axvspan(*INVERTER, color=ORANGE, alpha=0.08, lw=0.0, zorder=0.0)
    if impedance.corner > _NOTED:
        ax.axvline(impedance.corner, color=GREY, lw=0.9, ls="--")
        text = f" corner of the oil only,\n $1/(2\\pi\\tau)$ = {prefixed(impedance.corner, 'Hz')}"
        note(ax, impedance.corner, 0.04, text, data_axis="x", color=GREY)
    _mark_period(result, ax)
    ax.set(xlabel="frequency $f$ [Hz]", xlim=(_low(impedance), frequency[-1]))
    ax.grid(lw=0.6)


def _mark_period(result: BearingResult, ax: Axes) -> None:
    """Mark the switching frequency, and name its period with the time constant of the films."""
    motor, leaks = result.case.motor, shaft_leakage(result.solution)
    if motor is None or motor.switching_frequency is None or leaks is None:
        return
    at, time = motor.switching_frequency, leaks.film_time_constant
    ax.axvline(at, color=ORANGE, lw=0.9, ls=":")
    text = f" PWM period {prefixed(1.0 / at, 's')},\n films discharge in {prefixed(float(time), 's')}"
    if ax.get_yscale() == "log":
        # Above the name of the corner frequency, and in the upper panel only.
        note(ax, at, 0.24, text, data_axis="x", color=ORANGE)


def _low(impedance: Impedance) -> float:
    """Lower end of the axis [Hz]."""
    return min(_BEGIN, 0.1 * impedance.corner) if impedance.corner > _NOTED else _BEGIN
