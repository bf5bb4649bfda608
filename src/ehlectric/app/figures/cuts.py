"""Cuts through a point contact along and across entrainment: pressure, film and field."""

from __future__ import annotations

import math

import numpy as np

from ehlectric.app.answers.figure import Shown
from ehlectric.app.figures.lengths import BEFORE, BEHIND, Lengths
from ehlectric.app.figures.line import strength_limit
from ehlectric.app.figures.look import BLUE, GREY, ORANGE, PURPLE, RED
from ehlectric.app.figures.stack import Along, Curve, Panel, names_of, stack
from ehlectric.app.figures.touching import ASPERITIES, BEYOND, SPOTS, field_scale, film_scale, touches
from ehlectric.arrays import Array, Mask
from ehlectric.contact.results import PointResult
from ehlectric.formulas.hertz_point import point_pressure
from ehlectric.quantities.units import unit_for


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
    lengths, film, field, conditions = Lengths.of(result), result.film, result.field, result.conditions
    first = along == "x"
    other_film, other_field = (film.y, field.y) if first else (film.x, field.x)
    k, m = (int(np.argmin(np.abs(other - at))) for other in (other_film, other_field))
    x = lengths.factor * (film.x if first else film.y)
    pressure, thickness = (
        values_[:, k] if first else values_[k] for values_ in (film.pressure, film.thickness)
    )
    place, b = float(other_film[k]), conditions.semi_axis_x
    unscaled = (film.x if first else film.y) / b
    fixed = np.full_like(unscaled, place / b)
    pair = (unscaled, fixed) if first else (fixed, unscaled)
    hertz = conditions.max_pressure * point_pressure(*pair, conditions.ratio)
    to_p, pressure_unit = unit_for(max(film.max_pressure, conditions.max_pressure), "Pa")
    to_h, film_unit = unit_for(film_scale(result), "m")
    spots = _spots(result, k, first=first)
    panels = [
        Panel(
            "pressure",
            pressure_unit,
            [
                Curve("pressure", x, to_p * pressure, BLUE),
                *(Curve(ASPERITIES, x, to_p * asperities, RED, width=1.2) for asperities, _ in spots),
                Curve("dry contact (Hertz)", x, to_p * hertz, GREY, "dash", 1.5),
            ],
            1.05 * to_p * max(film.max_pressure, conditions.max_pressure),
        ),
        Panel(
            "film thickness",
            film_unit,
            [
                Curve("film thickness", x, to_h * thickness, ORANGE),
                *(Curve(SPOTS, x[on], to_h * thickness[on], RED, dots=True) for _, on in spots),
            ],
            2.5 * to_h * max(film.central_thickness, film.mean_thickness),
        ),
        _field_panel(result, m, first=first),
    ]
    semi = lengths.factor * conditions.semi_axes[0 if first else 1]
    edge = _edge(semi, place / conditions.semi_axes[1 if first else 0])
    window = (BEFORE * semi, BEHIND * semi) if first else (-1.5 * semi, 1.5 * semi)
    window = max(window[0], float(x[0])), min(window[1], float(x[-1]))
    fixed_name, shown = ("y" if first else "x"), lengths.factor * place
    title = f"Cut along {along} at {fixed_name} = {shown:.4g} {lengths.unit}"
    return Shown(
        f"cut-{along}",
        title,
        f"{title}. Over {along} in {lengths.unit}: {', '.join(names_of(panels))}.",
        stack(Along(along, lengths.unit, window, () if edge is None else (-edge, edge)), panels),
        " ".join(filter(None, [_told_of_edge(edge, along, lengths.unit), *([BEYOND] if spots else [])])),
    )


def _told_of_edge(edge: float | None, along: str, unit: str) -> str:
    if edge is None:
        return "This cut is outside of the dry contact."
    return f"Dashed lines: edges of the dry contact on this cut, {along} = ±{edge:.4g} {unit}."


def _spots(result: PointResult, k: int, *, first: bool) -> list[tuple[Array, Mask]]:
    """Pressure of asperities [Pa] on a cut, and its nodes at which surfaces touch; empty without spots."""
    film = result.film
    if film.contact_pressure is None or not touches(result):
        return []
    both = film.contact_pressure, film.contact
    return [(both[0][:, k], both[1][:, k]) if first else (both[0][k], both[1][k])]


def _edge(semi: float, off: float) -> float | None:
    """Half-length of a chord of the dry contact, ``off`` semi-axes from its middle; None outside of it."""
    return semi * math.sqrt(1.0 - off**2) if abs(off) < 1.0 else None


def _field_panel(result: PointResult, index: int, *, first: bool) -> Panel:
    field, scale = result.field, field_scale(result)
    factor, unit = unit_for(scale, "V/m")
    x = Lengths.of(result).factor * (field.x if first else field.y)
    most = np.max(field.strength, axis=-1)
    along, inner = (array[:, index] if first else array[index] for array in (most, field.inner))
    curves = [Curve("maximum field across the film", x[inner], factor * along[inner], RED)]
    limit, top = strength_limit(result), factor * scale
    if limit is not None:
        strength = factor * (limit[:, index] if first else limit[index])
        curves.append(Curve("dielectric strength", x[inner], strength[inner], PURPLE, "longdash", 1.5))
        top = min(2.0 * top, max(top, float(np.min(strength))))
    return Panel("field strength", unit, curves, 1.08 * top)
