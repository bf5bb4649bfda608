"""Figure of the breakdown of a contact: local breakdown voltage along the film beside the applied voltage."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from ehlectric.arrays import Array, Mask
from ehlectric.contact.results import PointResult, Result
from ehlectric.discharge.laws import WeakestLink
from ehlectric.figures.contact.findings import AnyContact, signed, strength_limit
from ehlectric.figures.lengths import LENGTH_AXIS, label_position, length_axis
from ehlectric.figures.names import BREAKDOWN_FIGURE
from ehlectric.figures.style import legend_above, new_panels
from ehlectric.quantities.palette import BLUE, ORANGE, STRENGTH

# White edge of a text, which keeps it readable on a line.
_OUTLINE = [withStroke(linewidth=2.0, foreground="white")]

# A dielectric strength below this part of the maximum field is named above its line, away from the ticks.
_LOW = 0.1

# A dielectric strength above this many times the maximum field is named beside the axes instead of drawn: the
# field would be flat below it.
_FAR = 2.5

# The voltage axis ends at this many times the minimum of the breakdown voltage, or the applied voltage.
_SHOWN = 2.2


def limit_line(ax: Axes, x: Array, limit: Array, largest: float, unit: str) -> float:
    """Draw the dielectric strength as a labelled line, and return the height of the drawn line.

    Parameters
    ----------
    ax : Axes
        Axes with field strengths.
    x : ndarray, shape (n,)
        Positions, in the unit of the axis.
    limit : ndarray, shape (n,)
        Dielectric strength, in the unit of the axis.
    largest : float
        Maximum field strength, in the unit of the axis.
    unit : str
        Unit of the axis.

    Returns
    -------
    float
        Largest drawn strength, or ``largest`` where the strength is so far above the field that an arrow at
        the upper edge names it instead.
    """
    near = limit[np.argmin(np.abs(x))]
    values = f"{near:.3g}" if np.ptp(limit) < 1e-9 * near else f"{np.min(limit):.3g} to {np.max(limit):.3g}"
    text = f"dielectric strength {values} {unit}"
    if np.min(limit) > _FAR * largest:
        ax.annotate(
            f"{text} (above)",
            (0.03, 1.0),
            (0.03, 0.9),
            xycoords="axes fraction",
            color=STRENGTH,
            fontsize=8.0,
            va="top",
            arrowprops={"arrowstyle": "-|>", "color": STRENGTH, "lw": 0.8, "shrinkB": 0.0},
        )
        return largest
    ax.plot(x, limit, color=STRENGTH, lw=1.0, ls=(0, (5.0, 1.5, 1.0, 1.5)))
    # On the left half of the line, the oil is thick and its field low.
    low = float(limit[0]) < _LOW * largest
    ax.annotate(
        text,
        (0.03, float(limit[0])),
        (0.0, 2.0 if low else -2.0),
        xycoords=ax.get_yaxis_transform(),
        textcoords="offset points",
        color=STRENGTH,
        fontsize=8.0,
        va="bottom" if low else "top",
        path_effects=_OUTLINE,
        zorder=5.0,
    )
    return float(np.max(limit[limit <= _FAR * largest]))


def breakdown_voltages(result: AnyContact) -> Array:
    """Local breakdown voltage of the columns of the film [V]: applied voltage times strength / field.

    Raises
    ------
    ValueError
        Where the case gives no dielectric strength.
    """
    limit = strength_limit(result)
    if limit is None:
        raise ValueError("the case has no dielectric strength")
    voltages: Array = result.field.voltage * limit / result.field.column_strength
    return voltages


def breakdown(result: AnyContact, axes: Sequence[Axes] | Axes | None = None) -> Axes:
    """Draw the local breakdown voltage over x/b beside the applied voltage; for a point contact over y/b too.

    The local breakdown voltage is the one at which the field at this place reaches the dielectric strength.
    Its minimum, the breakdown voltage of the film, is marked.

    Parameters
    ----------
    result : Result or PointResult
        Result of a contact whose case gives a dielectric strength.
    axes : Axes or sequence of Axes, optional
        Axes to draw on, two of them for a point contact; axes of a new figure if omitted.

    Returns
    -------
    Axes
        The first axes. The voltage axis ends where breakdown is far above the applied voltage. Where the line
        lies below the applied voltage, the film breaks down, and the range between them is shaded.
    """
    if axes is None:
        rows = 2 if isinstance(result, PointResult) else 1
        axes = new_panels(rows, 1, (6.3, 0.9 + 2.5 * rows))
    panels = [axes] if isinstance(axes, Axes) else list(axes)
    for ax, (axis, at, voltages, on) in zip(panels, _lines(result), strict=True):
        _voltage_line(result, ax, at[on], voltages[on])
        label_position(result, ax, axis)
        length_axis(result, ax, axis)
    if isinstance(result, PointResult):
        _name_cuts(result, panels)
    legend_above(panels[0], lift=LENGTH_AXIS, columns=3)
    return panels[0]


def _lines(result: AnyContact) -> list[tuple[str, Array, Array, Mask]]:
    """Lines through the place that breaks down first: axis, positions in half-widths, voltages, and a mask.

    The mask leaves out the ends of the field domain, whose faces disturb the field.
    """
    voltages, field, b = breakdown_voltages(result), result.field, result.conditions.semi_axes[0]
    if isinstance(result, Result):
        return [("x", result.field.x / b, voltages, result.field.inner)]
    k, j = np.unravel_index(np.argmin(voltages), voltages.shape)
    x, y = field.axes
    return [
        ("x", x / b, voltages[:, j], _or_all(field.inner[:, j])),
        ("y", y / b, voltages[k], _or_all(field.inner[k])),
    ]


def _name_cuts(result: PointResult, panels: Sequence[Axes]) -> None:
    """Write below two panels where they cut the film: through the place that breaks down first."""
    assert result.discharge is not None
    x, y = np.atleast_1d(result.discharge.zone_position) / result.conditions.semi_axis_x
    names = (f"along entrainment at $y/b$ = {y + 0.0:.3g}", f"across entrainment at $x/b$ = {x + 0.0:.3g}")
    for ax, name in zip(panels, names, strict=True):
        ax.set_xlabel(f"{ax.get_xlabel()}, {signed(name)}")


def _or_all(mask: Mask) -> Mask:
    return mask if np.count_nonzero(mask) > 2 else np.ones_like(mask)


def _voltage_line(result: AnyContact, ax: Axes, at: Array, voltages: Array) -> None:
    """Draw local breakdown voltages along a line, the applied voltage, and the minimum."""
    applied, least = result.field.voltage, float(np.min(voltages))
    ax.plot(at, voltages, color=BLUE, label="local breakdown voltage")
    ax.axhline(applied, color=ORANGE, lw=1.2, ls="--", label=f"applied voltage, {applied:.3g} V")
    below = voltages < applied
    if np.any(below):
        ax.fill_between(
            at,
            voltages,
            applied,
            where=below,
            interpolate=True,
            color=STRENGTH,
            alpha=0.25,
            lw=0.0,
            label="breaks down",
        )
    k = int(np.argmin(voltages))
    ax.plot(
        at[k], least, ls="none", marker="o", ms=4.5, mfc="white", color=BLUE, label=f"minimum, {least:.3g} V"
    )
    ax.set_xlim(at[0], at[-1])
    ax.set_ylim(0.0, _SHOWN * max(applied, least))
    ax.set_ylabel("voltage [V]")
    ax.grid(axis="y", lw=0.4, color="0.88")


def probability(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the probability of breakdown by a Weibull law over the voltage, and the applied voltage.

    Parameters
    ----------
    result : Result or PointResult
        Result of a contact whose case gives a Weibull law.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the probability in per cent. The range of voltages from 5 % to 95 % is shaded.
    """
    ax = new_panels(1, 1, (6.3, 3.4))[0] if ax is None else ax
    discharge, found, applied = result.case.discharge, result.discharge, result.field.voltage
    assert discharge is not None and discharge.weibull is not None
    assert found is not None and found.breakdown_voltage is not None
    low, high = found.breakdown_voltage_low, found.breakdown_voltage_high
    assert low is not None and high is not None
    law = WeakestLink(discharge.weibull.shape, found.breakdown_voltage)
    voltages = np.linspace(0.0, 1.15 * max(high, applied), 401)
    ax.axvspan(low, high, color=STRENGTH, alpha=0.12, lw=0.0, label=f"5 % to 95 %: {low:.3g} to {high:.3g} V")
    ax.plot(voltages, [100.0 * law.probability(at) for at in voltages], color=BLUE, label="probability")
    ax.axvline(applied, color=ORANGE, lw=1.2, ls="--", label=f"applied voltage, {applied:.3g} V")
    ax.set(xlabel="voltage [V]", ylabel="probability of breakdown [%]")
    ax.set_xlim(0.0, voltages[-1])
    ax.set_ylim(0.0, 102.0)
    legend_above(ax, columns=3)
    return ax


def breakdown_figures_of(result: AnyContact) -> dict[str, Callable[..., Axes]]:
    """Function that draws the breakdown of a contact, by file name.

    Empty if the case gives neither a dielectric strength nor a Weibull law.
    """
    discharge = result.case.discharge
    if discharge is not None and discharge.weibull is not None:
        return {BREAKDOWN_FIGURE: probability}
    return {} if strength_limit(result) is None else {BREAKDOWN_FIGURE: breakdown}
