"""Panel of the temperature in the film of a line contact, or of its shear stress."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.app.figures.look import BLUE, GREEN, ORANGE, thinned
from ehlectric.app.figures.stack import Curve, Panel
from ehlectric.cases.case import Case
from ehlectric.contact.results import Result
from ehlectric.quantities.units import unit_for

# Largest number of intervals of a curve whose extremes are kept.
_INTERVALS = 1500


def heat_panels(result: Result, to_x: float) -> Iterator[Panel]:
    """Panel of the temperature rise over the position, or of the shear stress in an isothermal film.

    Parameters
    ----------
    result : Result
        Result of ``solve``.
    to_x : float
        Factor from a position [m] to the unit of the figure.

    Yields
    ------
    Panel
        One panel; none for an isothermal Newtonian film.
    """
    heated, film = result.film.heated, result.film
    if heated is None:
        return
    if heated.mid_temperature is None or heated.surface_temperatures is None:
        stress = np.abs(heated.shear_stress)
        factor, unit = unit_for(float(stress.max()) or 1.0, "Pa")
        kept = thinned([stress], _INTERVALS)
        curve = Curve("shear stress at mid-film", to_x * film.x[kept], factor * stress[kept], GREEN)
        yield Panel("shear stress", unit, [curve], 1.05 * factor * float(stress.max()) or 1.0)
        return
    assert isinstance(result.case, Case) and result.case.contact.temperature is not None
    first, second = heated.surface_temperatures - result.case.contact.temperature
    middle = heated.mid_temperature - result.case.contact.temperature
    kept = thinned([middle, first, second], _INTERVALS)
    x = to_x * film.x[kept]
    curves = [
        Curve("surface 1", x, first[kept], BLUE, "dash", 1.5),
        Curve("surface 2", x, second[kept], ORANGE, "dot", 1.5),
        Curve("mid-film", x, middle[kept], GREEN),
    ]
    # A body may be warmer than the film, or colder than the oil in the inlet.
    low, high = (float(end([end(curve.y) for curve in curves])) for end in (np.min, np.max))
    yield Panel("temperature rise", "K", curves, 1.05 * max(high, 0.1), 1.05 * min(low, 0.0))
