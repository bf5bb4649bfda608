"""Gap around the film of a case, between the whole bodies that the case describes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.contact import Contact
from ehlectric.cases.meter import Meter, body_radii
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.discharge.gaps.bodies import Bodies, Body
from ehlectric.discharge.gaps.outside import Outside, around_line, around_point
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.formulas.hertz_point import dry_contact

Ring = tuple[float, float]
_EVERYWHERE: Ring = (0.0, np.inf)


def bodies_of(contact: Contact) -> Bodies:
    """Bodies of a contact; if the case gives reduced radii only, a body with these radii on a plane."""
    first, second = (Body(1.0 / along, 1.0 / across) for along, across in body_radii(contact))
    return Bodies.of(first, second)


def body_text(contact: Contact) -> str:
    """Words for the two bodies that face each other outside the film.

    Examples
    --------
    >>> given = {"reduced_radius": "10 mm", "reduced_modulus": "226 GPa", "load_per_length": 1e5}
    >>> body_text(Contact.from_dict(given | {"entrainment_speed": 1.0}))
    'cylinder of 10 mm on a plane'
    """
    return " on a ".join(_words(*radii) for radii in _smaller_first(contact))


def _smaller_first(contact: Contact) -> Iterator[tuple[float, float]]:
    yield from sorted(body_radii(contact), key=lambda radii: -1.0 / radii[0])


def _words(along: float, across: float) -> str:
    """Words for a body with these radii [m]."""
    if np.isinf(along) and np.isinf(across):
        return "plane"
    if np.isinf(across):
        return f"{'hollow ' if along < 0.0 else ''}cylinder of {abs(along) * 1e3:.4g} mm"
    if along == across > 0.0:
        return f"ball of {along * 1e3:.4g} mm"
    return f"body of {along * 1e3:.4g} mm along and {across * 1e3:.4g} mm across entrainment"


def gap_around(
    contact: Contact,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    meter: Meter,
    length: float | None,
    ring: Ring = _EVERYWHERE,
) -> tuple[Outside, float]:
    """Gap between the bodies outside the domain of a film.

    Parameters
    ----------
    contact : Contact
        Table of the contact, for the radii of both bodies.
    conditions : Conditions or PointConditions
        Operating conditions of the contact.
    film : Film or PointFilm
        Film whose domain is left out, and whose thickness the gap continues.
    meter : Meter
        Inputs of the meter, for the width of the bodies.
    length : float or None
        Length across entrainment of a line contact [m].
    ring : tuple of float
        Smallest and largest distance from the contact of the part that is wanted [m].

    Returns
    -------
    outside : Outside
        Gap at nodes outside the domain.
    mismatch : float
        Largest relative difference between gap and film at the edge of the domain; zero for a line contact.
    """
    bodies = bodies_of(contact)
    if isinstance(film, PointFilm):
        assert isinstance(conditions, PointConditions)
        radii, modulus = (conditions.radius_x, conditions.radius_y), conditions.reduced_modulus
        dry = dry_contact(conditions.load, *radii, modulus)
        nodes: tuple[Array, Array, Array] = (film.x, film.y, film.thickness)
        return around_point(bodies, dry, modulus, nodes, width=meter.length, ring=ring)
    assert isinstance(conditions, Conditions) and length is not None
    ends = film.x, film.thickness
    half_width, radius = conditions.half_width, conditions.reduced_radius
    return around_line(bodies, half_width, radius, ends, length=length, ring=ring), 0.0
