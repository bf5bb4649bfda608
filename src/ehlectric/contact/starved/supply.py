"""Dimensionless supply of oil of a film problem, from the table ``inlet`` of a case."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.films.inlet import Inlet
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.film.problem import OilSupply


def oil_supply(inlet: Inlet | None, conditions: Conditions | PointConditions) -> OilSupply | None:
    """Supply of oil of a film problem; None where the inlet is flooded.

    Parameters
    ----------
    inlet : Inlet or None
        Table ``inlet`` of a case.
    conditions : Conditions or PointConditions
        Operating conditions, whose scales make the layer dimensionless.

    Returns
    -------
    OilSupply or None
        Layer over Y = y/b in units of b^2/R, or the ratio of films. Beyond the ends of a table its first and
        last thickness hold.

    Examples
    --------
    >>> oil_supply(None, None) is None
    True
    """
    if inlet is None:
        return None
    if inlet.film_ratio is not None:
        return OilSupply(film_ratio=inlet.film_ratio)
    length, scale = conditions.half_width, conditions.thickness_scale
    given, table = inlet.oil_layer, inlet.layer_table

    def layer(y: Array) -> Array:
        if table is None:
            return np.full(y.shape, given) / scale
        return np.interp(length * y, table.y, table.thickness) / scale

    return OilSupply(layer=layer)


def is_even(inlet: Inlet | None, y: Array) -> bool:
    """Whether the layer of oil is symmetric about y = 0 at positions y [m] that are so."""
    if inlet is None or inlet.layer_table is None:
        return True
    layer = np.interp(y, inlet.layer_table.y, inlet.layer_table.thickness)
    return bool(np.allclose(layer, layer[::-1], rtol=1e-9, atol=0.0))
