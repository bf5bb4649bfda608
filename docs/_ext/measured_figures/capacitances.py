"""Measured and computed capacitances of contacts, and what the equation of state does to them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from tests.contact.equation_of_state import values
from tests.helpers.ball_on_disc import OILS, STEEL, ball_on_disc, capacitances
from tests.helpers.measurements import Reference, load

from ehlectric.quantities.palette import BLUE, GREEN, ORANGE
from measured_figures.look import MEASURED, decades, label, new

_METER = {"fill": "oil"}
_BAND = "computed, from air to oil around the film"
_SECOND = MEASURED | {"color": GREEN, "marker": "s"}
_RUNS = {
    "1": ("PAO4, run 1", MEASURED),
    "2": ("PAO4, run 2", _SECOND),
    "mixture": ("PAO4 and PAO40", MEASURED | {"color": "#555555", "marker": "D"}),
}


def ball_on_steel() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """Ball on a steel disc: two set-ups between air and oil around the film."""
    reference = load("ball_on_steel_capacitance")
    speed = reference.column("speed")
    case = ball_on_disc(OILS["fva3_library"], disc=STEEL, temperature="40 degC", meter=_METER)
    film, air, oil = capacitances(case, speed)
    figure, ax = new()
    ax.fill_between(speed, air, oil, color=BLUE, alpha=0.2, lw=0, label=_BAND)
    first, second = reference.column("setup_1"), reference.column("setup_2")
    ax.errorbar(speed - 0.003, first, yerr=0.5, label="measured, set-up 1", **MEASURED)
    ax.errorbar(speed + 0.003, second, yerr=0.5, label="measured, set-up 2", **_SECOND)
    ax.set_ylim(0.0, 17.0)
    label(ax, "entrainment speed $u$ [m/s]", "capacitance [pF]")
    ax.legend(loc="lower left")
    head = [
        "speed [m/s]",
        "film, computed [nm]",
        "set-up 1 [pF]",
        "set-up 2 [pF]",
        "computed, air [pF]",
        "computed, oil [pF]",
    ]
    columns = zip(speed, film, first, second, air, oil, strict=True)
    return figure, head, ([f"{u:.3f}", f"{h:.0f}", *(f"{c:.1f}" for c in rest)] for u, h, *rest in columns)


def chromium_disc() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """Ball on a glass disc with chromium: capacitance over the film measured by interferometry."""
    reference = load("chromium_disc_capacitance")
    case = ball_on_disc(OILS["pao4"], meter=_METER)
    film, air, oil = capacitances(case, (0.07, 0.13, 0.25, 0.6, 1.2, 2.4))
    figure, ax = new()
    ax.fill_between(film, air, oil, color=BLUE, alpha=0.25, lw=0, label=_BAND)
    for run, part in reference.table.groupby("run"):
        name, look = _RUNS[str(run)]
        ax.errorbar(part["film"], part["capacitance"], yerr=1.5, label=name, **look | {"ms": 3})
    ax.set_xscale("log")
    ax.set_yscale("log")
    decades(ax.xaxis, [15, 20, 30, 50, 100, 200, 300])
    decades(ax.yaxis, [15, 20, 30, 50, 100])
    label(ax, "central film, by interferometry [nm]", "capacitance [pF]")
    ax.legend()
    head = ["film [nm]", "measured, mean of the runs [pF]", "computed, air [pF]", "computed, oil [pF]"]
    return figure, head, _at_films(reference, film, air, oil)


def _at_films(reference: Reference, film: Any, air: Any, oil: Any) -> Iterator[list[str]]:
    """Rows at round films; measured values are interpolated between the points of all runs."""
    table = reference.table.groupby("film")["capacitance"].mean()
    for at in (25.0, 40.0, 60.0, 100.0, 150.0, 250.0):
        curves = [(table.index.to_numpy(), table.to_numpy()), (film, air), (film, oil)]
        found = [np.exp(np.interp(np.log(at), np.log(x), np.log(y))) for x, y in curves]
        yield [f"{at:.0f}", *(f"{value:.1f}" for value in found)]


def equation_of_state() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """Film and pressure of a contact at 2 GPa with both equations of state."""
    simple, tait = (values(tait=law) for law in (False, True))
    figure, ax = new()
    for found, colour, name in ((simple, ORANGE, "Dowson and Higginson"), (tait, BLUE, "Tait")):
        ax.plot(found["x"], found["film"] * 1e9, color=colour, label=name)
    ax.set_xlim(-1.3, 1.3)
    ax.set_ylim(0.0, 400.0)
    label(ax, "position along entrainment $x/b$", "film [nm]")
    ax.legend(title="equation of state")
    head = ["", "Dowson and Higginson", "Tait", "change"]
    rows = (
        ("density ratio at the centre", "density", 1.0, ".3f"),
        ("relative permittivity at the centre", "permittivity", 1.0, ".2f"),
        ("central film [nm]", "central film", 1e9, ".1f"),
        ("minimum film [nm]", "minimum film", 1e9, ".1f"),
        ("capacitance per area at the centre [pF/mm²]", "capacitance, centre", 1e6, ".0f"),
        ("capacitance per area of the Hertzian zone [pF/mm²]", "capacitance, zone", 1e6, ".0f"),
    )
    return (
        figure,
        head,
        (
            [
                name,
                format(simple[key] * unit, form),
                format(tait[key] * unit, form),
                f"{100.0 * (tait[key] / simple[key] - 1.0):+.1f} %",
            ]
            for name, key, unit, form in rows
        ),
    )
