"""Measured and computed films while a dent passes."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure
from tests.motion.microdent import DENTS, MICRO, OPTICS_END, at, measured, passage

from ehlectric.quantities.palette import BLUE, ORANGE
from measured_figures.look import label, new


def dent_in_rolling() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """A deep dent that moves with the oil."""
    return _passage("rolling", 2.0)


def slow_dent() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """A shallow dent that moves at half of the speed of the oil."""
    return _passage("sliding", 1.5)


def _passage(name: str, clear: float) -> tuple[Figure, list[str], Iterator[list[str]]]:
    dent = DENTS[name]
    with tempfile.TemporaryDirectory() as folder:
        x, middle, films = passage(dent, folder, nodes=129)
    figure, axes = new(9.0, 2.6, columns=5)
    rows = []
    for ax, (place, film, where) in zip(axes, measured(name), strict=True):
        computed = films[0] if where is None else at(middle, films, where)
        ax.plot(x, computed, color=BLUE, label="computed")
        ax.plot(place, film, ".", ms=3, color=ORANGE, label="measured")
        ax.axhline(OPTICS_END, color="#999999", lw=0.6, ls=":")
        ax.set_xlim(-170, 170)
        ax.set_ylim(0, 450)
        ax.set_title("no dent" if where is None else f"dent at {where:.0f} µm".replace("-", "\N{MINUS SIGN}"))
        label(ax, "$x$ [µm]", "film [nm]" if ax is axes[0] else "")
        away = np.inf if where is None else clear * dent.radius / MICRO
        kept = (np.abs(place) < 110.0) & (film < OPTICS_END)
        kept &= True if where is None else np.abs(place - where) > away
        off = np.interp(place[kept], x, computed) - film[kept]
        instant = "no dent" if where is None else f"{where:.0f}"
        rows.append(
            [instant, f"{np.mean(film[kept]):.0f}", f"{np.mean(off):+.0f}", f"{np.sqrt(np.mean(off**2)):.0f}"]
        )
    axes[0].legend(loc="lower left")
    head = [
        "dent at [µm]",
        "mean measured film [nm]",
        "computed − measured, mean [nm]",
        "root mean square [nm]",
    ]
    return figure, head, iter(rows)
