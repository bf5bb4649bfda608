"""Figure of a bearing's impedance over frequency, with the band of an inverter."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array
from ehlectric.bearing.discharges.leakage import shaft_leakage
from ehlectric.bearing.impedance import Impedance, impedance_of
from ehlectric.bearing.result import BearingResult
from ehlectric.figures.style import axes_or_new
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import unit_for

# Frequencies of a common inverter [Hz]: from the lowest switching frequency to those in the edges of its
# voltage, 1/(pi t) for a rise time t of 60 ns. They are no values of the case.
INVERTER = 4e3, 5e6

# The axis begins at this frequency [Hz], or lower, so that it shows a corner above _NOTED [Hz] by a decade.
_BEGIN, _NOTED = 1e3, 100.0

# A phase within this distance of that of a capacitor or of a resistor is a number, not a figure [degrees].
_CONSTANT = 2.0


def impedance_magnitude(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the magnitude of the bearing's impedance over the frequency.

    Parameters
    ----------
    result : BearingResult
        Result of a bearing whose oil has a conductivity.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with two logarithmic scales, from 1 kHz or a decade below the corner frequency. The band of a
        common inverter is shaded. The corner frequency of the oil alone, 1/(2 pi tau), is marked if it is in
        the range. With air around the films, the corner frequency of the bearing is lower.
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
    ax.text(
        (low * high) ** 0.5,
        0.95,
        "switching frequency to voltage edges\nof a common inverter",
        transform=ax.get_xaxis_transform(),
        ha="center",
        va="top",
        color=ORANGE,
        fontsize="small",
    )
    for at in read_at(result):
        value = magnitude_at(_impedance(result), at)
        ax.plot([at], [value], ls="none", marker="o", ms=4.5, color=BLUE)
        ax.annotate(
            f"{prefixed(value, 'Ω')} at {prefixed(at, 'Hz')}",
            (at, value),
            (5.0, 3.0),
            ha="left",
            va="bottom",
            textcoords="offset points",
            fontsize="small",
        )
    _over_frequency(result, ax)
    return ax


def impedance_phase(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the phase of the bearing's impedance over the frequency.

    Parameters
    ----------
    result : BearingResult
        Result of a bearing whose oil has a conductivity.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes from -90 degrees (a capacitor) to 0 (a resistor).
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
    found = _impedance(result)
    return found.mean is not None or bool(np.ptp(_shown(found)[2]) > _CONSTANT)


def read_at(result: BearingResult) -> tuple[float, ...]:
    """Frequencies at which the figure states the impedance [Hz]: 20 kHz and 1 MHz, if it shows them."""
    frequency = _shown(_impedance(result))[0]
    return tuple(at for at in (2e4, 1e6) if frequency[0] <= at <= frequency[-1])


def magnitude_at(impedance: Impedance, frequency: float) -> float:
    """Magnitude of an impedance at a frequency [Ohm], interpolated as a power of the frequency."""
    logs = np.log(impedance.frequency), np.log(impedance.magnitude)
    return float(np.exp(np.interp(np.log(frequency), *logs)))


def prefixed(value: float, unit: str, *, least: float = 1.0) -> str:
    """Text: value with three digits and a prefixed unit, in which it is at least ``least``.

    Examples
    --------
    >>> prefixed(2e4, "Hz"), prefixed(0.00749, "Hz"), prefixed(34410.0, "Ω")
    ('20 kHz', '7.49 mHz', '34.4 kΩ')
    """
    factor, name = unit_for(value, unit, least=least)
    return f"{factor * value:.3g} {name}"


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
        text = f" corner of the oil alone,\n $1/(2\\pi\\tau)$ = {prefixed(impedance.corner, 'Hz')}"
        ax.text(
            impedance.corner, 0.04, text, transform=ax.get_xaxis_transform(), fontsize="small", color=GREY
        )
    _mark_period(result, ax)
    ax.set(xlabel="frequency $f$ [Hz]", xlim=(_low(impedance), frequency[-1]))
    ax.grid(color="0.9", lw=0.6)


def _mark_period(result: BearingResult, ax: Axes) -> None:
    """Mark the switching frequency, and name its period with the time constant of the films."""
    motor, leaks = result.case.motor, shaft_leakage(result.solution)
    if motor is None or motor.switching_frequency is None or leaks is None:
        return
    at, time = motor.switching_frequency, leaks.film_time_constant
    ax.axvline(at, color=ORANGE, lw=0.9, ls=":")
    text = f" PWM period {prefixed(1.0 / at, 's')},\n films discharge in {prefixed(time, 's')}"
    if ax.get_yscale() == "log":
        # Above the name of the corner frequency, and in the upper panel only.
        ax.text(at, 0.24, text, transform=ax.get_xaxis_transform(), fontsize="small", color=ORANGE)


def _low(impedance: Impedance) -> float:
    """Lower end of the axis [Hz]."""
    return min(_BEGIN, 0.1 * impedance.corner) if impedance.corner > _NOTED else _BEGIN
