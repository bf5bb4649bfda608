"""Measured and computed central films over the speed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from tests.helpers.ball_on_disc import OILS, ball_on_disc, central_films
from tests.helpers.measurements import exponent, film_log, load, zero_checks

from ehlectric.quantities.palette import BLUE, GREEN
from measured_figures.look import MEASURED, decades, label, new

SPEED, FILM = "entrainment speed $u$ [m/s]", "central film [nm]"


def fva_3() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """Films of a mineral oil, with 10 % for viscosity and pressure-viscosity coefficient."""
    reference = load("ball_on_glass_fva3")
    speed, film = reference.column("speed"), reference.column("film")
    computed = central_films(ball_on_disc(OILS["fva3"]), speed)
    slopes = exponent(speed, film), exponent(speed, computed)
    figure = _over_speed(speed, film, computed, share=0.1)
    figure.axes[0].set_title(
        f"FVA 3, 25.1 °C: exponent {slopes[0]:.3f} measured, {slopes[1]:.3f} computed", loc="left"
    )
    return figure, _HEAD, _rows(speed, film, computed)


def shc_320() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """Films of a thick polyalphaolefin, which the program does not reproduce."""
    reference = load("ball_on_glass_shc320")
    speed, film = reference.column("speed"), reference.column("film")
    computed = central_films(ball_on_disc(OILS["shc320"]), speed)
    slopes = exponent(speed, film), exponent(speed, computed)
    figure = _over_speed(speed, film, computed, share=0.14)
    figure.axes[0].set_title(
        f"SHC 320, 38.8 °C: exponent {slopes[0]:.2f} measured, {slopes[1]:.2f} computed", loc="left"
    )
    return figure, _HEAD, _rows(speed, film, computed)


def thin_films() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """Films of an oil that is not named; its viscosity is fitted at the highest speed."""
    speed, logged = film_log("40C")
    film = logged - np.mean(zero_checks("40C"))
    shown = speed > 0.09
    chosen = [0, 2, 4, 6, 8, 10, 12, 15]
    case = ball_on_disc(OILS["unnamed"])
    fine, coarse = (central_films(case.replace({"grid.nodes": nodes}), speed[chosen]) for nodes in (513, 257))
    figure, ax = new()
    ax.errorbar(speed[shown], film[shown], yerr=1.0, label="measured, zero of 1.9 nm added", **MEASURED)
    ax.loglog(speed[chosen], fine, color=BLUE, label="computed, 513 × 513 nodes")
    ax.loglog(speed[chosen], coarse, color=GREEN, ls="--", label="computed, 257 × 257 nodes")
    decades(ax.xaxis, [0.1, 0.2, 0.5, 1.0])
    decades(ax.yaxis, [5, 10, 20, 50])
    label(ax, SPEED, FILM)
    ax.legend()
    head = ["speed [m/s]", "measured [nm]", "513 × 513 nodes [nm]", "257 × 257 nodes [nm]"]
    values = zip(speed[chosen], film[chosen], fine, coarse, strict=True)
    return figure, head, ([f"{u:.3f}", *(f"{h:.1f}" for h in films)] for u, *films in values)


_HEAD = ["speed [m/s]", "measured [nm]", "computed [nm]", "measured/computed"]


def _over_speed(speed: Any, film: Any, computed: Any, *, share: float) -> Figure:
    figure, ax = new()
    ax.errorbar(speed, film, yerr=share * film, label=f"measured, inputs ± {100 * share:.0f} %", **MEASURED)
    ax.loglog(speed, computed, color=BLUE, label="computed, 257 × 257 nodes")
    decades(ax.xaxis, [value for value in (0.05, 0.1, 0.2, 0.5, 1.0) if value > 0.9 * speed[0]])
    decades(ax.yaxis, [100, 200, 500, 1000])
    ax.set_ylim(0.75 * np.min(film), 1.3 * np.max(computed))
    label(ax, SPEED, FILM)
    ax.legend()
    return figure


def _rows(speed: Any, film: Any, computed: Any) -> Iterator[list[str]]:
    for u, h, found in zip(speed, film, computed, strict=True):
        yield [f"{u:.3f}", f"{h:.0f}", f"{found:.0f}", f"{h / found:.2f}"]
