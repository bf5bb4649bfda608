"""Figure of the loads of a pair of tapered roller bearings, and of capacitances of bearings of five kinds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from measured_figures.look import decades, label
from sphinx.application import Sphinx

from ehlectric.arrays import Array
from ehlectric.bearing.solution import BearingSolution
from ehlectric.bearing.solving import solution_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.palette import BLUE, GREEN, MIDDLE_GREY, ORANGE, PURPLE, SKY
from ehlectric.runtime.files import prepare

PAIR = "tapered_pair"
# Example, name and colour of each bearing whose capacitances are drawn.
BEARINGS = (
    (PAIR, "tapered rollers 32208,\nfirst row of the pair", BLUE),
    ("thrust", "thrust balls 51208", SKY),
    ("four_point", "four-point balls QJ 208", GREEN),
    ("6314", "deep-groove balls 6314", ORANGE),
    ("needle", "needles HK 2020", PURPLE),
)


def _around(ax: Axes, angle: Array, values: Array, colour: str) -> float:
    """Draw values of elements over the whole turn; returns the value at its end."""
    degrees = np.degrees(angle) % 360.0 - 180.0
    order = np.argsort(degrees)
    turns = np.concatenate([degrees[order] + turn for turn in (-360.0, 0.0, 360.0)])
    drawn = np.tile(values[order], 3)
    ax.plot(turns, drawn, "o-", color=colour, ms=4, lw=1.2)
    return float(np.interp(180.0, turns, drawn))


def _look(ax: Axes, title: str, quantity: str) -> None:
    ax.set_xlim(-180.0, 180.0)
    ax.set_xticks(np.arange(-180, 181, 90))
    label(ax, "angle from the radial load [deg]", quantity)
    ax.set_title(title, fontsize=10)


def _loads(ax: Axes, solution: BearingSolution) -> None:
    at, bearing = solution.positions[0].equilibrium, solution.case.bearing
    assert bearing.pair is not None
    assert bearing.pair.preload is not None
    for row, colour in ((slice(0, bearing.elements), BLUE), (slice(bearing.elements, None), ORANGE)):
        _around(ax, at.position[row] + np.pi, at.inner_load[row], colour)
    each = bearing.pair.preload / bearing.elements / np.sin(at.inner_angle[0])
    ax.axhline(each, color=MIDDLE_GREY, lw=1.0, ls="--")
    most = float(np.max(at.inner_load))
    ax.annotate("first row", (60.0, 0.72 * most), color=BLUE)
    ax.annotate("second row", (0.0, 0.41 * most), color=ORANGE, ha="center")
    ax.annotate(
        "preload\nalone",
        (180.0, each),
        (6.0, 0.0),
        textcoords="offset points",
        color=MIDDLE_GREY,
        va="center",
    )
    ax.set_ylim(-15.0)
    _look(ax, "Pair 32208: the axial load presses the first row", "load of a roller on the inner ring [N]")


def _capacitances(ax: Axes, solutions: dict[str, BearingSolution]) -> None:
    for example, name, colour in BEARINGS:
        at, row = solutions[example].positions[0], slice(0, solutions[example].case.bearing.elements)
        (inner, _), (outer, _) = at.capacitances("oil")
        each = 1e12 * inner * outer / (inner + outer)
        end = _around(ax, at.equilibrium.position[row] + np.pi, each[row], colour)
        ax.annotate(name, (180.0, end), (6.0, 0.0), textcoords="offset points", color=colour, va="center")
    ax.set_yscale("log")
    decades(ax.yaxis, [10.0, 20.0, 50.0, 100.0, 200.0])
    _look(ax, "Loaded elements have most of the capacitance", "capacitance of an element [pF]")


def _write(app: Sphinx) -> None:
    root = Path(app.srcdir).parent
    files = {example: root / "examples" / f"bearing_{example}.toml" for example, _, _ in BEARINGS}
    solutions = {
        example: solution_of(BearingCase.from_toml(path), positions=1) for example, path in files.items()
    }
    figure = Figure(figsize=(10.2, 3.6))
    left, right = figure.subplots(1, 2)
    _loads(left, solutions[PAIR])
    _capacitances(right, solutions)
    figure.subplots_adjust(wspace=0.44)
    folder = prepare(root / "docs" / "_generated")
    figure.savefig(folder / "kinds_of_bearings.png", dpi=200, facecolor="white", bbox_inches="tight")


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
