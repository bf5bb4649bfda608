"""Capacitance of each zone of a contact, over the whole domain of its film."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.discharge.columns import at_columns
from ehlectric.discharge.outlet_filling import OUTLETS, filled_permittivity, oil_fraction
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
    """Capacitance of each zone, for each assumption about the filling of the gap behind the exit.

    Inside the field range the capacitance follows from the solved field, outside from a thin gap,
    eps0 eps/h per area. The thin gap is summed over the whole domain. The difference between the solved field
    and the thin gap is then added inside the field range. Where gas fills a part of the gap, both are scaled
    by ``filled_permittivity``. This agrees to 1e-5 with a field that is solved with the gas in the gap,
    because the walls diverge slowly behind the exit.

    Parameters
    ----------
    film, field : Film and Field, or PointFilm and PointField
        Solution of the contact.
    zones : pair of mapping
        Width [m] or area [m^2] of each node's part of a zone, by the name of the zone: one mapping for the
        film's nodes, and one for the columns of the field.
    permittivity_law : callable
        Function that gives the relative permittivity of the oil from its density ratio.

    Returns
    -------
    dict of dict
        Capacitance per length [F/m] of a line contact, or capacitance [F] of a point contact, by the filling
        ("full", "fingers", "layers") and by the name of the zone.
    """
    oil = permittivity_law(film.density)
    fraction = oil_fraction(film.thickness, film.density, film.cavitated)
    gap = np.maximum(film.thickness, ATOM)
    by_outlet = {}
    for outlet in OUTLETS:
        permittivity = filled_permittivity(oil, fraction, outlet)
        thin = epsilon_0 * permittivity / gap
        # The thin gap at the columns is interpolated from the film's nodes, not computed from the gap of the
        # field. It then cancels the sum over the nodes inside the field range, also if the columns are finer.
        thin_gap = at_columns(film, field, thin)
        correction = field.capacitance_density * at_columns(film, field, permittivity / oil) - thin_gap
        by_outlet[outlet] = {
            name: float(np.vdot(weights, thin) + np.vdot(zones[1][name], correction))
            for name, weights in zones[0].items()
        }
    return by_outlet
