"""Panels around the shaft of a bearing: loads and films of the contacts with both rings over their angles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.bearing import (
    BearingResult,
    RingState,
    around_in_rows,
)
from ehlectric.figures.data import Area, Curve, Panel, is_wide
from ehlectric.quantities.lubrication_states import inner_states
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Name of each ring, with its colour, the width of its line, and the marks of its contacts with and without
# load. The loads of both rings are nearly equal: the inner one is drawn over the wider line of the outer one.
_Ring = tuple[str, str, float, str, str]
_RINGS: tuple[_Ring, ...] = (
    ("outer", ORANGE, 2.2, "full square", "square"),
    ("inner", BLUE, 1.1, "dots", "ring"),
)

# Sizes of the marks of the inner and of the outer ring.
_SIZES = {"dots": 1.15, "ring": 0.85, "full square": 1.75, "square": 1.5}

# The circle of a lambda ratio is shown if the smallest film is below this many times its film thickness.
_FAR = 4.0

# Angles of a circle, and of the sectors without load, one for half a degree [rad].
_CIRCLE = np.linspace(0.0, 2.0 * np.pi, 181)
_SECTORS = np.linspace(0.0, 2.0 * np.pi, 721)


def load_panel(result: BearingResult) -> Panel:
    """Loads of the contacts with both rings over the angle [rad] from the radial load."""
    largest = max(float(np.max(race.load)) for ring in _RINGS for race in _races(result, ring[0]))
    factor, unit = unit_for(largest, "N", least=1.0)
    rings = [(ring, [factor * race.load for race in _races(result, ring[0])]) for ring in _RINGS]
    curves = [curve for ring, loads in rings for curve in _lines(result, ring, loads)]
    marks = [mark for ring, loads in rings for mark in _marks(result, ring, loads[0], f"load = {{}} {unit}")]
    return Panel("contact load", unit, [*curves, *marks], 1.06 * factor * largest)


def film_panel(result: BearingResult) -> Panel:
    """Minimum films of the loaded contacts with both rings over the angle [rad] from the radial load.

    Circles are lambda ratios. Contacts without load have a gap instead of a film: their sector is shaded.
    """
    bearing = result.solution.case.bearing
    rq, limits = bearing.composite_rq, dict(inner_states(float(bearing.summit_height)))
    races = {ring: _races(result, ring[0]) for ring in _RINGS}
    films = np.concatenate(
        [race.values.minimum_thickness[race.solved] for of_ring in races.values() for race in of_ring]
    )
    factor, unit = unit_for(float(films.min()), "m")
    # Circles far below the films are omitted, because they would leave little room for the films.
    ratios = [ratio for ratio in limits if films.min() < _FAR * ratio * rq]
    curves = [
        Curve(
            f"λ = {ratio:g}: {limits[ratio].name} inside",
            _CIRCLE,
            np.full(_CIRCLE.size, factor * ratio * rq),
            GREY,
            "dash" if limits[ratio].voltage else "dot",
            0.9,
        )
        for ratio in ratios
    ]
    marks: list[Curve] = []
    areas: list[Area] = []
    everything = factor * np.concatenate([films, rq * np.array(ratios)])
    low, high = float(np.min(everything)), float(np.max(everything))
    bottom, top = (0.8 * low, 1.2 * high) if is_wide(everything) else (0.0, 1.06 * high)
    for ring, of_ring in races.items():
        values = [np.where(race.solved, factor * race.values.minimum_thickness, np.nan) for race in of_ring]
        curves += _lines(result, ring, values)
        marks += _marks(result, ring, values[0], f"h_min = {{}} {unit}")
        areas += _unloaded(result, ring, (bottom, top))
    return Panel(
        r"minimum film $h_\mathrm{min}$", unit, [*curves, *marks], top, bottom, areas, log=bottom > 0.0
    )


def largest_gap(result: BearingResult, ring: str) -> float | None:
    """Largest gap of the contacts without load with a ring [m]; None if the ring loads all elements."""
    races = _races(result, ring)
    gaps = np.concatenate([race.values.minimum_thickness[~race.solved] for race in races])
    return float(gaps.max()) if gaps.size else None


def _races(result: BearingResult, ring: str) -> list[RingState]:
    """Contacts with a ring at each position of the cage."""
    return [getattr(position, ring) for position in result.solution.positions]


def _around(result: BearingResult, values: Sequence[Array | Mask]) -> tuple[Array, Any]:
    """Angles of the elements of each row at all positions of the cage from 0 to 2 pi, and values in their
    order, shape (rows, n).
    """
    rows = result.solution.conditions.geometry.groups
    angles, order = around_in_rows([p.equilibrium.position for p in result.solution.positions], rows)
    return angles[order].reshape(rows, -1), np.concatenate(values)[order].reshape(rows, -1)


def _lines(result: BearingResult, ring: _Ring, values: Sequence[Array]) -> Iterator[Curve]:
    """Closed lines over all positions of the cage, a turn for each row: solid, and dotted without load."""
    (_, colour, width, *_), races = ring, _races(result, ring[0])
    angle, along = _around(result, values)
    loaded = _around(result, [race.solved for race in races])[1]
    gap = np.full((len(angle), 1), np.nan)
    closed = np.hstack([angle, angle[:, :1] + 2.0 * np.pi, gap]).ravel()[:-1]
    for dash, on in (("solid", loaded), ("dot", ~loaded)):
        part = np.where(on, along, np.nan)
        yield Curve("", closed, np.hstack([part, part[:, :1], gap]).ravel()[:-1], colour, dash, width)


def _marks(result: BearingResult, ring: _Ring, values: Array, text: str) -> Iterator[Curve]:
    """Marks of the contacts with a ring at the first position of the cage, hollow ones without load."""
    name, colour, _, full, hollow = ring
    at, loaded = result.solution.positions[0].equilibrium.position, _races(result, ring[0])[0].solved
    angles = np.degrees(at)
    for label, marker, on in ((f"{name} contact", full, loaded), (f"{name}, unloaded", hollow, ~loaded)):
        on = on & np.isfinite(values)
        texts = [
            f"{name} contact of element {k}\nat {angles[k]:.0f}°\n{text.format(readable(values[k], 4))}"
            for k in np.flatnonzero(on)
        ]
        if texts:
            yield Curve(label, at[on], values[on], colour, marker=marker, size=_SIZES[marker], texts=texts)


def _unloaded(result: BearingResult, ring: _Ring, ends: tuple[float, float]) -> Iterator[Area]:
    """Sector in which a ring loads no element, with the largest gap there; none if it loads all elements."""
    gap = largest_gap(result, ring[0])
    if gap is None:
        return
    (angle, *_), each = _around(result, [race.solved for race in _races(result, ring[0])])
    # All rows have the same angles; the nearest one decides.
    edges = 0.5 * (angle + np.append(angle[1:], angle[0] + 2.0 * np.pi))
    loaded = np.any(each, axis=0)[np.searchsorted(edges, _SECTORS) % angle.size]
    factor, unit = unit_for(gap, "m")
    low, high = (np.full(_SECTORS.size, end) for end in ends)
    name = f"{ring[0]} unloaded: gap to {readable(factor * gap, 2)} {unit}"
    yield Area(name, _SECTORS, ~loaded, ring[1], 0.10, (low, high))
