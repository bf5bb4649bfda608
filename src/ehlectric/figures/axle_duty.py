"""Figure of the duty cycle of an axle: speed, torque, first element, and U/V_b of all elements over time."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from ehlectric.axle import AxleDuty, AxleResult
from ehlectric.errors import printable
from ehlectric.figures.category_maps import colours_of_names
from ehlectric.figures.style import legend_above, new_panels, note
from ehlectric.quantities.palette import BLACK
from ehlectric.quantities.units import RPM
from ehlectric.readable import capital, readable

# Smallest ratio that is drawn.
_LEAST = 0.05

# Height of the dots for summits that touch, as a part of the panel, and room above and below the ratios.
_TOUCHING, _ABOVE = 0.96, 0.2


def axle_duty(result: AxleResult) -> Axes:
    """Draw speed and torque of the rotor, and U/V_b of all elements, with the colour of the first element."""
    duty = result.duty
    assert duty is not None
    axes = new_panels(3, 1, (8.0, 7.0))
    for ax, values, label in (
        (axes[0], duty.speed / RPM, "speed of the\nrotor [rpm]"),
        (axes[1], duty.torque, "torque of the\nrotor [N m]"),
    ):
        ax.plot(duty.time, values, color=BLACK, lw=0.9)
        ax.set(ylabel=label, xlim=(duty.time[0], duty.time[-1]))
        ax.tick_params(labelbottom=False)
    _ratios(duty, axes[2])
    handles = [
        Patch(facecolor=colour, label=printable(name))
        for name, colour in zip(duty.names, colours_of_names(duty.names), strict=True)
    ]
    legend_above(axes[0], handles, columns=2)
    return axes[0]


def _ratios(duty: AxleDuty, ax: Axes) -> None:
    """Draw U/V_b of the elements; the first element has dots, and the other elements have thin lines.

    Dots in a row above all ratios belong to a first element whose summits touch.
    """
    ratios = np.where(~duty.touching & (duty.ratios >= _LEAST), duty.ratios, np.nan)
    first = duty.first
    for number, colour in enumerate(colours_of_names(duty.names)):
        ax.plot(duty.time, ratios[:, number], color=colour, lw=0.5, alpha=0.6)
        rows = first == number
        touching = rows & duty.touching[:, number]
        dots: dict[str, Any] = {"color": colour, "ls": "none", "marker": "o", "ms": 2.5}
        ax.plot(duty.time[rows], ratios[rows, number], **dots)
        above = np.full(np.count_nonzero(touching), _TOUCHING)
        ax.plot(duty.time[touching], above, transform=ax.get_xaxis_transform(), **dots)
    if np.any(duty.touching):
        ax.margins(y=_ABOVE)
        note(ax, 0.01, _TOUCHING - 0.03, "dots above: summits of the first element touch", va="top")
    ax.axhline(1.0, color=BLACK, ls="--", lw=1.0)
    ax.set(
        yscale="log",
        xlim=(duty.time[0], duty.time[-1]),
        xlabel="time [s]",
        ylabel="voltage / breakdown voltage",
    )


def duty_finding(result: AxleResult) -> str:
    """Sentence about the element that is the first for the longest time."""
    assert result.duty is not None
    shares = {row["element"]: row["first_share"] for row in result.duty.summary()["elements"]}
    name = max(shares, key=lambda each: shares[each])
    return capital(f"{name} is the first for {readable(100.0 * shares[name], 2)} % of the time")
