"""Spots in figures of a contact whose surfaces touch, and scales for the film around the spots."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.contact.results import PointResult, Result
from ehlectric.figures.contact.profiles import SPOTS, touches
from ehlectric.quantities.palette import ORANGE
from ehlectric.quantities.units import unit_for

# Sentence on a scale of the field that leaves the spots out.
BEYOND = "The scale of the field ends below the field in the spots."

# Largest number of marks of spots on a map.
_MARKS = 2000


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
    marker = {"symbol": "square", "size": 4, "color": ORANGE}
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
