"""Curves of contacts of both kinds: breakdown along the film, capacitance of a meter, heat and shear."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import Patch

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.contact import Metered, PointResult, Result, meter_profile
from ehlectric.discharge.discharge_laws import WeakestLink
from ehlectric.figures import contact_profiles
from ehlectric.figures.contact_findings import AnyContact, signed, strength_limit, with_unit
from ehlectric.figures.contact_profiles import Cut, Line
from ehlectric.figures.data import Panel
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.film_section import fill_section
from ehlectric.figures.style import (
    BAR,
    LENGTH_AXIS,
    axes_or_new,
    figure_of,
    fitted_label,
    in_half_widths,
    label_position,
    legend_above,
    length_axis,
    new_panels,
    note,
    outlined,
)
from ehlectric.quantities.formats import CELSIUS
from ehlectric.quantities.palette import BLUE, BODY, GREY, ORANGE, STRENGTH
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable


def stacked_panels(size: tuple[float, float]) -> list[Axes]:
    """Axes of two panels of a new figure, the upper one higher; their size on the screen in inches."""
    panels = new_panels(2, 1, size)
    gridspec = panels[0].get_gridspec()
    assert gridspec is not None
    gridspec.set_height_ratios([3.0, 2.0])
    return panels


def enlarged_below(ax: Axes, ends: tuple[float, float], *, framed: bool = False) -> Patch:
    """Shade the range of the horizontal axis that the panel below enlarges, or frame it on filled axes."""
    look: dict[str, Any] = {"color": GREY, "alpha": 0.2, "lw": 0.0, "zorder": 0.2}
    if framed:
        look = {"facecolor": "none", "edgecolor": "black", "lw": 0.7, "ls": "--", "zorder": 3.0}
    return ax.axvspan(*ends, label="enlarged below", **look)


# A dielectric strength below this part of the maximum field is named above its line, away from the ticks.
_LOW = 0.1

# A dielectric strength above this many times the maximum field is named next to the axes instead of drawn:
# the field would be flat below it.
_FAR = 2.5

# The voltage axis ends at this many times the minimum of the breakdown voltage, or the applied voltage.
_SHOWN = 2.2


def limit_line(ax: Axes, x: Array, limit: Array, largest: float, unit: str) -> float:
    """Draw the dielectric strength as a labelled line, and return the height of the drawn line.

    ``x``, positions, in the unit of the axis, shape (n,); ``limit``, dielectric strength, in the unit of the
    axis, shape (n,). Returns largest drawn strength, or ``largest`` where the strength is so far above the
    field that an arrow at the upper edge names it instead.
    """
    near = limit[np.argmin(np.abs(x))]
    values = (
        readable(near)
        if np.ptp(limit) < 1e-9 * near
        else f"{readable(np.min(limit))} to {readable(np.max(limit))}"
    )
    text = f"dielectric strength {values} {unit}"
    look: dict[str, Any] = {"color": STRENGTH, "fontsize": 8.0}
    if np.min(limit) > _FAR * largest:
        look["arrowprops"] = {"arrowstyle": "-|>", "color": STRENGTH, "lw": 0.8, "shrinkB": 0.0}
        ax.annotate(f"{text} (above)", (0.03, 1.0), (0.03, 0.9), xycoords="axes fraction", va="top", **look)
        return largest
    ax.plot(x, limit, color=STRENGTH, lw=1.0, ls=(0, (5.0, 1.5, 1.0, 1.5)))
    # On the left half of the line, the oil is thick and its field low.
    low = float(limit[0]) < _LOW * largest
    look |= {"va": "bottom" if low else "top", "path_effects": outlined(2.0), "zorder": 5.0}
    place: dict[str, Any] = {"xycoords": ax.get_yaxis_transform(), "textcoords": "offset points"}
    ax.annotate(text, (0.03, float(limit[0])), (0.0, 2.0 if low else -2.0), **place, **look)
    return float(np.max(limit[limit <= _FAR * largest]))


def breakdown_voltages(result: AnyContact) -> Array:
    """Local breakdown voltage of the columns of the film [V]: applied voltage times strength / field. Raises
    ValueError where the case gives no dielectric strength.
    """
    limit = strength_limit(result)
    if limit is None:
        raise ValueError("the case has no dielectric strength")
    voltages: Array = result.field.voltage * limit / result.field.column_strength
    return voltages


def breakdown(result: AnyContact, axes: Sequence[Axes] | Axes | None = None) -> Axes:
    """Draw the local breakdown voltage and the applied voltage over x/b; for a point contact also over y/b.

    The local breakdown voltage is the one at which the field at this place reaches the dielectric strength.
    Its minimum, the breakdown voltage of the film, is marked.
    """
    lines = _lines(result)
    if axes is None:
        axes = new_panels(len(lines), 1, (6.3, 0.9 + 2.5 * len(lines)))
    panels = [axes] if isinstance(axes, Axes) else axes
    for ax, (axis, at, voltages, on) in zip(panels, lines, strict=True):
        _voltage_line(result, ax, at[on], voltages[on])
        label_position(result, ax, axis)
        length_axis(result, ax, axis)
    if isinstance(result, PointResult):
        _name_cuts(result, panels)
    legend_above(panels[0], lift=LENGTH_AXIS, columns=3)
    return panels[0]


def _lines(result: AnyContact) -> list[tuple[str, Array, Array, Mask]]:
    """Lines through the place that breaks down first: axis, positions in half-widths, voltages, and a mask.

    The mask excludes the ends of the field domain, whose faces disturb the field.
    """
    voltages, b = breakdown_voltages(result), result.conditions.semi_axes[0]
    if isinstance(result, Result):
        return [("x", result.field.x / b, voltages, result.field.inner)]
    weakest = np.unravel_index(np.argmin(voltages), voltages.shape)
    place = float(result.field.x[weakest[0]]), float(result.field.y[weakest[1]])
    cuts = [Cut.near(along, place, result.field.x, result.field.y) for along in "xy"]
    lines = zip(cuts, result.field.axes, strict=True)
    return [(cut.along, at / b, cut.of(voltages), cut.away(result.field)) for cut, at in lines]


def _name_cuts(result: PointResult, panels: Sequence[Axes]) -> None:
    """Write below two panels where they cut the film: through the place that breaks down first."""
    assert result.discharge is not None
    x, y = np.atleast_1d(result.discharge.zone_position) / result.conditions.semi_axis_x
    names = (
        f"along entrainment at $y/b$ = {readable(y + 0.0)}",
        f"across entrainment at $x/b$ = {readable(x + 0.0)}",
    )
    for ax, name in zip(panels, names, strict=True):
        # No-break spaces keep the name on one line.
        whole = f"{ax.get_xlabel()}, {signed(name)}".replace(" ", "\xa0").replace(",\xa0", ", ")
        ax.set_xlabel(fitted_label(ax, whole, along=True))


def _voltage_line(result: AnyContact, ax: Axes, at: Array, voltages: Array) -> None:
    """Draw local breakdown voltages along a line, the applied voltage, and the minimum."""
    applied, least = result.field.voltage, float(np.min(voltages))
    ax.plot(at, voltages, color=BLUE, label="local breakdown voltage")
    ax.axhline(applied, color=ORANGE, lw=1.2, ls="--", label=f"applied voltage, {readable(applied)} V")
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
        at[k],
        least,
        ls="none",
        marker="o",
        ms=4.5,
        mfc="white",
        color=BLUE,
        clip_on=False,
        label=f"minimum, {readable(least)} V",
    )
    ax.set_xlim(at[0], at[-1])
    ax.set_ylim(0.0, _SHOWN * max(applied, least))
    ax.set_ylabel("voltage [V]")
    ax.grid(axis="y", lw=0.4)


def probability(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the probability of breakdown by a Weibull law over the voltage, and the applied voltage. Returns
    axes with the probability in per cent; the range of voltages from 5 % to 95 % is shaded.
    """
    ax = axes_or_new(ax)
    discharge, film_breakdown, applied = result.case.discharge, result.discharge, result.field.voltage
    assert discharge is not None and discharge.weibull is not None
    assert film_breakdown is not None and film_breakdown.breakdown_voltage is not None
    low, high = film_breakdown.breakdown_voltage_low, film_breakdown.breakdown_voltage_high
    assert low is not None and high is not None
    law = WeakestLink(discharge.weibull.shape, film_breakdown.breakdown_voltage)
    voltages = np.linspace(0.0, 1.15 * max(high, applied), 401)
    ax.axvspan(
        low,
        high,
        color=STRENGTH,
        alpha=0.12,
        lw=0.0,
        label=f"5 % to 95 %: {readable(low)} to {readable(high)} V",
    )
    ax.plot(voltages, [100.0 * law.probability(at) for at in voltages], color=BLUE, label="probability")
    ax.axvline(applied, color=ORANGE, lw=1.2, ls="--", label=f"applied voltage, {readable(applied)} V")
    ax.set(xlabel="voltage [V]", ylabel="probability of breakdown [%]")
    ax.set_xlim(0.0, voltages[-1])
    ax.set_ylim(0.0, 102.0)
    legend_above(ax, columns=3)
    return ax


def meter(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the capacitance between the bodies up to a distance from the contact.

    Returns axes with the sum over distance, with the gap outside the film's domain filled as the case says,
    and between air and oil; lines mark the edge of the Hertz zone and the nearest edge of the domain.
    """
    ax = new_panels(1, 1, (6.3, 3.6))[0] if ax is None else ax
    assert isinstance(result.case, Case) and result.meter is not None
    profile = meter_profile(Metered(result.case, result.conditions, result.film, result.field))
    factor, unit = unit_for(result.meter.capacitance, "F", least=1.0)
    at = 1e3 * profile.radius
    look: dict[str, Any] = {"color": BLUE, "alpha": 0.18, "lw": 0.0, "label": "between air and oil"}
    ax.fill_between(at, factor * profile.air, factor * profile.oil, **look)
    given = "filled as given"
    for limit, name, dashes in ((profile.oil, "oil", ":"), (profile.air, "air", "--")):
        if np.array_equal(limit, profile.filled):
            given = f"{name} outside the domain, as given"
        else:
            ax.plot(at, factor * limit, color=BLUE, lw=0.9, ls=dashes, label=f"{name} outside the domain")
    ax.plot(at, factor * profile.filled, color=BLUE, label=given)
    if result.meter.parallel_capacitance:
        whole = with_unit(result.meter.capacitance, "F")
        ax.axhline(
            factor * result.meter.capacitance, color=ORANGE, lw=1.2, label=f"with the parallel part, {whole}"
        )
    # Between both lines there may be no room for a name.
    for edge, name, side in (
        (result.conditions.half_width, "Hertzian zone", "right"),
        (profile.edge, "nearest edge of the domain", "left"),
    ):
        ax.axvline(1e3 * edge, color=GREY, lw=0.8)
        look = {"rotation": 90, "ha": side, "va": "top", "fontsize": "small", "color": GREY}
        note(ax, 1e3 * edge, 0.98, f" {name}", data_axis="x", **look)
    ax.set(xlabel="distance from the contact [mm]", ylabel=f"capacitance up to there [{unit}]", xscale="log")
    ax.set_xlim(at[0], at[-1])
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_ylim(bottom=0.0)
    ax.grid(axis="y", lw=0.4)
    legend_above(ax, columns=2)
    return ax


# Range of x/b that is drawn, and colours of temperatures.
_WINDOW, _HEAT = (-1.75, 1.25), "inferno"

# Smallest range of the colours, of a film with very little heating [K].
_LEAST_RANGE = 0.1


def temperature(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the temperature across the film, at its middle and on both surfaces, and the shear stress.

    On given axes only the temperature across the film is drawn.

    Returns axes of the map, over x/b and height with the outline of the film; of a point contact along y = 0.
    """
    if ax is not None:
        _map(result, ax)
        return ax
    above, middle, below = new_panels(3, 1, (6.3, 7.2))
    _map(result, above)
    _panel(result, contact_profiles.temperature, middle)
    shear_stress(result, below)
    return above


def shear_stress(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the shear stress at mid-film over x/b, with the pressure times the traction coefficient. Returns
    axes with the shear stress, of a point contact along y = 0.
    """
    return _panel(result, contact_profiles.shear_stress, axes_or_new(ax))


def _panel(result: AnyContact, panel_of: Callable[[Line], Panel], ax: Axes) -> Axes:
    """Draw a panel over x/b, of a point contact along y = 0."""
    draw_panel(panel_of(Line.through(result, 1.0 / result.conditions.half_width)), ax)
    ax.set_xlim(*_WINDOW)
    label_position(result, ax)
    legend_above(ax, columns=4)
    return ax


def _along(result: AnyContact, values: Array) -> Array:
    """Values (..., nx) along entrainment: of a point contact along the line of nodes nearest to y = 0."""
    if isinstance(result, PointResult):
        line: Array = values[..., int(np.argmin(np.abs(result.film.y)))]
        return line
    return values


def _map(result: AnyContact, ax: Axes) -> None:
    """Draw the temperature over position and height, with the outline of the film and its colour bar."""
    heated = result.film.heated
    assert heated is not None and heated.temperature is not None and heated.zeta is not None
    x, thickness = in_half_widths(result, result.film.x), _along(result, result.film.thickness)
    shown = (x >= _WINDOW[0]) & (x <= _WINDOW[1])
    factor, unit = unit_for(float(np.median(thickness[np.abs(x) < 1.0])), "m")
    heights = factor * thickness[:, np.newaxis] * (heated.zeta - 0.5)
    values = CELSIUS.of(_along(result, heated.temperature).T)
    limits = float(values[shown].min()), float(values[shown].max())
    limits = limits[0], max(limits[1], limits[0] + _LEAST_RANGE)
    fill_section(ax, x[shown], heights[shown], values[shown], limits=limits, colours=_HEAT)
    half = 1.6 * float(np.max(np.abs(heights[np.abs(x) < 1.0])))
    ax.set(xlim=_WINDOW, ylim=(-half, half), ylabel=f"height [{unit}]", facecolor=BODY)
    label_position(result, ax)
    colours = ScalarMappable(Normalize(*limits), _HEAT)
    figure_of(ax).colorbar(colours, cax=ax.inset_axes(BAR), label="temperature [°C]")
