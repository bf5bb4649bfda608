"""Capacitance of a contact by zone, over the whole domain of its film."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.discharge.columns import at_columns
from ehlectric.discharge.outlet import OUTLETS, filled_permittivity, oil_fraction
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.poisson import ATOM
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm


def zone_capacitances(
    film: Film | PointFilm,
    field: Field | PointField,
    zones: tuple[Mapping[str, Array], Mapping[str, Array]],
    permittivity_law: Callable[[Array], Array],
) -> dict[str, dict[str, float]]:
    """Capacitance of each zone, by what fills the gap behind the exit.

    Inside the field range it is that of the solved field, outside it eps0 eps/h of a thin gap: the thin gap
    everywhere, and where the field was solved what that differs from it. Where gas fills a part of the gap
    both are scaled as ``filled_permittivity`` says: the walls behind the exit open slowly enough that a field
    solved anew gives the same to 1e-5.

    Parameters
    ----------
    film, field : Film and Field, or PointFilm and PointField
        The solution.
    zones : pair of mapping
        By name, the width [m] or area [m^2] of each node's part of a zone: of the film's nodes, and of the
        columns of the field.
    permittivity_law : callable
        Relative permittivity over the density ratio.

    Returns
    -------
    dict of dict
        For "full", "fingers" and "layers", the capacitance per length [F/m] or the capacitance [F] of each
        zone.
    """
    oil = permittivity_law(film.density)
    fraction = oil_fraction(film.thickness, film.density, film.cavitated)
    gap = np.maximum(film.thickness, ATOM)
    by_outlet = {}
    for outlet in OUTLETS:
        permittivity = filled_permittivity(oil, fraction, outlet)
        thin = epsilon_0 * permittivity / gap
        # Of the film's nodes, not of the field's own gap: finer columns then take away all of the thin gap.
        instead = at_columns(film, field, thin)
        correction = field.capacitance_density * at_columns(film, field, permittivity / oil) - instead
        by_outlet[outlet] = {
            name: float(np.vdot(weights, thin) + np.vdot(zones[1][name], correction))
            for name, weights in zones[0].items()
        }
    return by_outlet
