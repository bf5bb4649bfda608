"""Supply of oil to the inlet of a contact: a layer of oil, or the film that it should give."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ehlectric.arrays import Array


@dataclass(frozen=True)
class OilSupply:
    """Supply of oil to the inlet of a contact; either a layer or a ratio of films is given.

    Attributes
    ----------
    layer : callable or None
        Thickness H of the oil on both surfaces together at the inlet edge and at ambient pressure: function
        of Y (ny,) -> H (ny,), dimensionless.
    film_ratio : float or None
        Central film thickness over that of the flooded contact, above 0 and up to 1, for which a uniform
        layer is searched.

    Examples
    --------
    >>> OilSupply(film_ratio=0.5).layer is None
    True
    """

    layer: Callable[[Array], Array] | None = None
    film_ratio: float | None = None


@dataclass(frozen=True)
class Starvation:
    """Supply of oil of a solved film, and the flooded film beside it, SI units.

    Attributes
    ----------
    oil_layer : float
        Thickness of the layer of oil on both surfaces together, on the line y = 0 [m].
    film_ratio : float
        Central film thickness over that of the flooded film.
    meniscus : float or None
        Position of the first node on the line y = 0 that oil fills [m]; None if the film is flooded.
    flooded_minimum_thickness, flooded_central_thickness : float
        Minimum and central film thickness of the flooded film on the same grid [m].
    """

    oil_layer: float
    film_ratio: float
    meniscus: float | None
    flooded_minimum_thickness: float
    flooded_central_thickness: float
