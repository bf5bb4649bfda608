"""Cuts through a point contact along and across entrainment: pressure, film and field."""

from __future__ import annotations

import math

from ehlectric.app.answers.figure import Shown
from ehlectric.app.figures.lengths import BEFORE, BEHIND, Lengths
from ehlectric.app.figures.stack import names_of, stack
from ehlectric.app.figures.touching import BEYOND
from ehlectric.contact.results import PointResult
from ehlectric.figures.contact.profiles import Line, field_strength, film_thickness, pressure, touches
from ehlectric.figures.data import Along


def point_cuts(result: PointResult, x: float, y: float) -> tuple[Shown, ...]:
    """Cuts along and across entrainment through the nodes nearest to a point.

    Parameters
    ----------
    result : PointResult
        Result of ``solve``, of a film that converged.
    x, y : float
        Point [m].

    Returns
    -------
    tuple of Shown
        Pressure, film and field along x, and along y.
    """
    return tuple(_cut(result, along, y if along == "x" else x) for along in ("x", "y"))


def _cut(result: PointResult, along: str, at: float) -> Shown:
    lengths, conditions, first = Lengths.of(result), result.conditions, along == "x"
    line = Line.through(result, lengths.factor, along, at)
    assert line.film_cut is not None
    place = line.film_cut.position
    panels = [pressure(line), film_thickness(line), field_strength(line)]
    semi = lengths.factor * conditions.semi_axes[0 if first else 1]
    edge = _edge(semi, place / conditions.semi_axes[1 if first else 0])
    window = (BEFORE * semi, BEHIND * semi) if first else (-1.5 * semi, 1.5 * semi)
    window = max(window[0], float(line.x[0])), min(window[1], float(line.x[-1]))
    fixed_name, shown = ("y" if first else "x"), lengths.factor * place
    title = f"Cut along {along} at {fixed_name} = {shown:.4g} {lengths.unit}"
    return Shown(
        f"cut-{along}",
        title,
        f"{title}. Over {along} in {lengths.unit}: {', '.join(names_of(panels))}.",
        stack(Along(along, lengths.unit, window, () if edge is None else (-edge, edge)), panels),
        " ".join(filter(None, [_told_of_edge(edge, along, lengths.unit), BEYOND if touches(result) else ""])),
    )


def _told_of_edge(edge: float | None, along: str, unit: str) -> str:
    if edge is None:
        return "This cut is outside of the dry contact."
    return f"Dashed lines: edges of the dry contact on this cut, {along} = ±{edge:.4g} {unit}."


def _edge(semi: float, off: float) -> float | None:
    """Half-length of a chord of the dry contact, ``off`` semi-axes from its middle; None outside of it."""
    return semi * math.sqrt(1.0 - off**2) if abs(off) < 1.0 else None
