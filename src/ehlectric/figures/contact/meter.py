"""Figure of where a meter sees the capacitance of a contact: its sum up to a distance from the contact."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes

from ehlectric.cases.case import Case
from ehlectric.contact.meter.profile import meter_profile
from ehlectric.contact.meter.reading import Metered
from ehlectric.figures.contact.findings import AnyContact, with_unit
from ehlectric.figures.names import METER_FIGURE
from ehlectric.figures.style import legend_above, new_panels
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import unit_for


def meter(result: AnyContact, ax: Axes | None = None) -> Axes:
    """Draw the capacitance between the bodies up to a distance from the contact.

    Parameters
    ----------
    result : Result or PointResult
        Result of a contact whose case has a table ``meter``.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the sum over distance, with the gap outside the film's domain filled as the case says, and
        between air and oil. Lines mark the edge of the Hertz zone and the nearest edge of the domain.
    """
    ax = new_panels(1, 1, (6.3, 3.6))[0] if ax is None else ax
    assert isinstance(result.case, Case) and result.meter is not None
    profile = meter_profile(Metered(result.case, result.conditions, result.film, result.field))
    factor, unit = unit_for(result.meter.capacitance, "F", least=1.0)
    at = 1e3 * profile.radius
    ax.fill_between(at, factor * profile.air, factor * profile.oil, color=BLUE, alpha=0.18, lw=0.0)
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
    for edge, name in (
        (result.conditions.half_width, "Hertz zone"),
        (profile.edge, "nearest edge of the domain"),
    ):
        ax.axvline(1e3 * edge, color=GREY, lw=0.8)
        ax.text(
            1e3 * edge,
            0.98,
            f" {name}",
            transform=ax.get_xaxis_transform(),
            rotation=90,
            ha="right",
            va="top",
            fontsize=8.0,
            color=GREY,
        )
    ax.set(xlabel="distance from the contact [mm]", ylabel=f"capacitance up to there [{unit}]", xscale="log")
    ax.set_xlim(at[0], at[-1])
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_ylim(bottom=0.0)
    ax.grid(axis="y", lw=0.4, color="0.88")
    legend_above(ax, columns=2)
    return ax


def meter_figures_of(result: AnyContact) -> dict[str, Callable[..., Axes]]:
    """Function that draws the capacitance at a meter, by file name; empty without a table ``meter``."""
    return {} if result.meter is None else {METER_FIGURE: meter}
