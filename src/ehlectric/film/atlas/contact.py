"""Film of a line or point contact in SI units, from the atlas."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ehlectric.film.atlas.coefficient import OilGroups
from ehlectric.film.atlas.film import AtlasFilm, atlas_film
from ehlectric.film.atlas.groups import Groups
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz_point import axis_ratio
from ehlectric.lubricant.oil import Oil


@dataclass(frozen=True)
class ContactFilm:
    """Film of a contact from the atlas, in SI units.

    Attributes
    ----------
    central_thickness, minimum_thickness, mean_thickness : float
        Film thickness at x = y = 0, smallest film thickness, and mean over the Hertz zone [m].
    groups : Groups
        M, L and k, with L made with the coefficient of the atlas.
    film : AtlasFilm
        Dimensionless film, with the errors.
    """

    central_thickness: float
    minimum_thickness: float
    mean_thickness: float
    groups: Groups
    film: AtlasFilm

    @property
    def errors(self) -> dict[str, float]:
        """Relative errors of the films by "central", "minimum" and "mean", and of the other numbers."""
        return self.film.errors


def contact_film(contact: LineContact | PointContact, oil: Oil) -> ContactFilm:
    """Film of a smooth, fully flooded, isothermal contact, interpolated in the atlas.

    Parameters
    ----------
    contact : LineContact or PointContact
        Radii, modulus, load and speed; its coefficient is replaced by that of the oil's laws.
    oil : Oil
        Oil at the temperature of the contact.

    Returns
    -------
    ContactFilm
        Films [m], with the relative error of each.

    Raises
    ------
    InputError
        If the contact is outside the atlas.

    Examples
    --------
    >>> from ehlectric.cases.oils.lubricant import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> ball = PointContact(10e-3, 10e-3, 226e9, 20.0, 2.0, oil.viscosity, 0.0)
    >>> film = contact_film(ball, oil)
    >>> round(film.central_thickness * 1e6, 2)
    0.42
    """
    laws = (oil.log_viscosity, oil.density_ratio)
    groups_of_oil = _groups_of(oil)
    moved = replace(contact, pressure_viscosity_coefficient=groups_of_oil.alpha)
    if isinstance(moved, LineContact):
        radius, ratio = moved.reduced_radius, None
    else:
        radius, ratio = moved.radius_x, axis_ratio(moved.radius_x, moved.radius_y)
    groups = Groups(moved.moes_m, moved.moes_l, ratio)
    film = atlas_film(groups, laws, groups_of_oil)
    unit = radius * float(np.sqrt(2.0 * moved._u))
    return ContactFilm(unit * film.central, unit * film.minimum, unit * film.mean, groups, film)


@lru_cache(maxsize=64)
def _groups_of(oil: Oil) -> OilGroups:
    """Groups of an oil, kept because a bearing asks for the same oil many times."""
    return OilGroups.of(oil.log_viscosity, oil.density_ratio)
