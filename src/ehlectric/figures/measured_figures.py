"""Figure of a measurement: measured and computed values, and the film factor, over speed or time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.cases.defaults import HOW
from ehlectric.cases.film_factors import FilmFactors, factor_text
from ehlectric.figures.data import is_wide
from ehlectric.figures.figure_names import MEASURED_FIGURE, in_formats
from ehlectric.figures.style import (
    drawing_of,
    figure_of,
    legend_above,
    name_over,
    new_panels,
    scale_axis,
    share_below,
    style,
)
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable

# Width and height [inches].
_SIZE = (6.3, 5.2)

# Factor from a standard uncertainty to the half-width of a 95 % interval of a normal distribution.
_TWO_SIDED = 1.96


@dataclass(frozen=True)
class _Scale:
    """Values along the lower axis, in the unit of their label, and the order in which lines join them."""

    values: Array
    text: str
    log: bool
    order: NDArray[np.intp]


def figure(factors: FilmFactors, name: str) -> Figure:
    """Figure of a measurement compared with computed values. Returns above measured values with error bars,
    and computed lines at film factor 1 and at the mean with its 95 % band; below the film factor of every
    row. Raises InputError where there is no figure of this name.
    """
    drawing_of({MEASURED_FIGURE: figure}, in_formats([name])[0])
    with style():
        above, below = new_panels(2, 1, _SIZE)
        scale = _scale(factors)
        _values(factors, scale, above)
        speeds = above.get_xlim()
        _factors(factors, scale, below)
        # Rows without a film factor are drawn only above, and also belong to the figure.
        below.set_xlim(speeds)
        above.set_xlim(speeds)
        share_below([above, below])
        name_over(above, "\n".join(_title(factors)))
        return figure_of(above)


def _title(factors: FilmFactors) -> list[str]:
    text = factor_text(factors.mean)
    what = "Capacitance" if factors.quantity == "capacitance" else "Central film"
    error = factors.formula_error
    films = "solved contacts"
    if error is not None:
        films = f"films {HOW[factors.contacts]}, up to {readable(100.0 * error, 2)} % off"
    fitted = int(factors.found.sum())
    rows = f"{fitted} of {len(factors.reasons)} rows of {Path(factors.source).name}"
    how = f"{films}, isothermal and fully flooded at film factor 1"
    return [f"{what}: {text}", factors.title, f"{rows}; {how}"]


def _scale(factors: FilmFactors) -> _Scale:
    """Speeds along the axis; the time where the speed does not change and a time was measured."""
    speeds = factors.columns[factors.speed_key]
    if "time" in factors.columns and len(np.unique(speeds)) == 1:
        time = factors.columns["time"]
        return _Scale(time, "time [s]", log=False, order=np.argsort(time, kind="stable"))
    turns = factors.quantity == "capacitance"
    values = np.array([rpm(speed) for speed in speeds]) if turns else speeds
    text = "speed of the inner ring [rpm]" if turns else "entrainment speed [m/s]"
    return _Scale(values, text, log=is_wide(values), order=np.argsort(values, kind="stable"))


def _values(factors: FilmFactors, scale: _Scale, ax: Axes) -> None:
    """Draw measured and computed values."""
    columns = factors.columns
    electric = factors.quantity == "capacitance"
    key, unit, factor = ("capacitance", "pF", 1e12) if electric else ("film", "nm", 1e9)
    x, order = scale.values, scale.order
    measured = factor * columns[key]
    ax.plot(
        x[order], factor * columns["computed"][order], color=GREY, lw=1.0, label="computed, film factor 1"
    )
    if factors.mean is not None:
        fitted = factors.found[order]
        at = x[order][fitted]
        if "fitted_low" in columns and "fitted_high" in columns:
            ends = (factor * columns[name][order][fitted] for name in ("fitted_low", "fitted_high"))
            ax.fill_between(at, *ends, color=BLUE, alpha=0.18, lw=0.0)
        text = f"computed, film factor {readable(factors.mean.value)}"
        ax.plot(at, factor * columns["fitted"][order][fitted], color=BLUE, label=text)
    _dots(scale, ax, measured, columns.get(f"{key}_uncertainty"), factor, "measured")
    shown = np.concatenate([measured, factor * columns["computed"]])
    log = is_wide(shown)
    name = "capacitance" if electric else "central film thickness"
    name += "\nwithout background" if factors.background else ""
    scale_axis(ax.yaxis, f"{name} [{unit}]", values=shown, log=log)
    if not log:
        ax.set_ylim(0.0, 1.15 * float(np.nanmax(shown)))
    legend_above(ax, columns=3)


def _factors(factors: FilmFactors, scale: _Scale, ax: Axes) -> None:
    """Draw the film factors of the rows, and their mean with its interval."""
    columns, mean = factors.columns, factors.mean
    ax.axhline(1.0, color=GREY, lw=0.8)
    if mean is not None:
        if mean.low is not None and mean.high is not None:
            ax.axhspan(mean.low, mean.high, color=BLUE, alpha=0.18, lw=0.0)
        ax.axhline(mean.value, color=BLUE)
    _dots(scale, ax, columns["film_factor"], columns.get("factor_uncertainty"))
    tops = [1.0, *columns["film_factor"][factors.found].tolist()]
    tops += [] if mean is None or mean.high is None else [mean.high]
    ax.set_ylim(0.0, 1.15 * max(tops))
    ax.set_ylabel("film factor")


def _dots(
    scale: _Scale, ax: Axes, values: Array, error: Array | None, factor: float = 1.0, label: str = ""
) -> None:
    """Draw measured values with the bars of their 95 % intervals, and label the lower axis."""
    bars = None if error is None else _TWO_SIDED * factor * error
    ax.errorbar(
        scale.values, values, yerr=bars, color=ORANGE, ls="none", marker="o", ms=3.5, lw=0.9, label=label
    )
    scale_axis(ax.xaxis, scale.text, values=scale.values, log=scale.log)
