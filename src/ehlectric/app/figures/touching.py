"""Spots in figures of a contact whose surfaces touch, and scales for the film around the spots."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.app.figures.look import RED
from ehlectric.arrays import Array, Mask
from ehlectric.contact.results import PointResult, Result
from ehlectric.quantities.units import unit_for

# Name of the pressure between asperities, and of the nodes at which surfaces touch, in legends.
ASPERITIES, SPOTS = "pressure of asperities", "surfaces touch"

# Sentence on a scale of the field that leaves the spots out.
BEYOND = "The scale of the field ends below the field in the spots."

# Part of the Hertz zone [%] whose field lies within the scale of a film with spots.
_WITHIN = 90.0

# Largest number of marks of spots on a map.
_MARKS = 2000


def touches(result: Result | PointResult) -> bool:
    """Whether the surfaces of a result touch."""
    return bool(np.any(result.film.contact))


def film_scale(result: Result | PointResult) -> float:
    """Film thickness [m] that tells the unit and the reach of figures.

    It is the central film, or the mean film where the surfaces touch: a spot may lie in the middle.
    """
    film = result.film
    return max(film.central_thickness, film.mean_thickness) if touches(result) else film.central_thickness


def field_scale(result: Result | PointResult) -> float:
    """Field strength [V/m] that tells the unit and the reach of figures.

    It is the largest field. Where the surfaces touch, that is the voltage over the boundary film, beside
    which the field of the film could not be seen; most of the Hertz zone has less than the field given here.
    """
    field = result.field
    if not touches(result):
        return field.max_strength
    most = np.max(field.strength, axis=-1)
    inside = _hertz_columns(result)
    scale = float(np.percentile(most[inside], _WITHIN)) if inside.any() else 0.0
    return min(field.max_strength, 1.5 * scale) or field.max_strength


def _hertz_columns(result: Result | PointResult) -> Mask:
    """Columns of the field in the dry contact that do not lie on spots."""
    field, film = result.field, result.film
    if isinstance(result, PointResult):
        inside: Mask = np.asarray(result.zones["hertz"](field.x[:, np.newaxis], field.y))
    else:
        inside = np.abs(field.x) <= result.conditions.half_width
    gap = heights(result)
    return inside & (gap > 1.5 * film.minimum_thickness)


def heights(result: Result | PointResult) -> Array:
    """Thickness [m] of the film at the columns of the field."""
    if isinstance(result, PointResult):
        return np.asarray(result.field.z[..., -1] - result.field.z[..., 0])
    return np.asarray(result.field.y[..., -1] - result.field.y[..., 0])


def spot_position(result: PointResult) -> tuple[float, float]:
    """Point [m] through which cuts go at first: highest pressure of asperities, or the minimum film."""
    film = result.film
    if film.contact_pressure is None or not touches(result):
        return film.minimum_position
    i, j = np.unravel_index(np.argmax(film.contact_pressure), film.contact_pressure.shape)
    return float(film.x[i]), float(film.y[j])


def spot_marks(result: PointResult, factor: float, *, turned: bool) -> list[dict[str, Any]]:
    """Marks at the nodes of a map at which the surfaces touch; at most 2000, spread evenly over all of them.

    Parameters
    ----------
    result : PointResult
        Result of ``solve``.
    factor : float
        Factor from metres to the unit of the map.
    turned : bool
        Whether the map has y to the right.
    """
    if not touches(result):
        return []
    i, j = np.nonzero(result.film.contact)
    kept: NDArray[np.intp] = np.unique(np.linspace(0, i.size - 1, min(i.size, _MARKS)).astype(np.intp))
    x, y = (
        np.round(factor * axis[at[kept]], 6).tolist()
        for axis, at in zip(result.film.axes, (i, j), strict=True)
    )
    marker = {"symbol": "square", "size": 4, "color": RED}
    return [
        {
            "type": "scatter",
            "mode": "markers",
            "x": y if turned else x,
            "y": x if turned else y,
            "marker": marker,
            "name": SPOTS,
            "showlegend": True,
            "hoverinfo": "skip",
        }
    ]


def told_of_spots(result: Result | PointResult) -> str:
    """Sentence below a figure about spots; empty where the surfaces do not touch."""
    if not touches(result):
        return ""
    least = result.film.minimum_thickness
    factor, unit = unit_for(least, "m")
    return f"Surfaces touch where the film is the boundary film of {factor * least:.3g} {unit}."
