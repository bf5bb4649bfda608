"""Contacts with the rings of many bearings, put together to those of many points of operation."""

from dataclasses import dataclass, replace
from functools import reduce
from types import SimpleNamespace

import numpy as np

from ehlectric.bearing.loads.geometry import ContactRadii
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.lubricant.oil import BoundLaw, OfDensity


def ring_of_points(rings):
    """Contacts with a ring of many points, from those with the rings of single bearings of one size."""
    first = rings[0]
    own = [ring.conditions.inner if ring.inner else ring.conditions.outer for ring in rings]
    changed = replace(
        own[0],
        temperature=together(one.temperature for one in own),
        oil=_oil_of([one.oil for one in own]),
        film_factor=together(one.film_factor for one in own),
    )
    conditions = replace(
        first.conditions,
        geometry=_geometry_of(rings),
        modulus=together(ring.conditions.modulus for ring in rings),
        oil=_oil_of([ring.conditions.oil for ring in rings]),
        **{"inner" if first.inner else "outer": changed},
    )
    angle, speed = (np.array([getattr(ring, name) for ring in rings]) for name in ("angle", "speed"))
    return RingContacts(conditions, first.inner, angle, speed)


def together(values):
    """Array of numbers of many points, or the number that they share."""
    values = list(values)
    return values[0] if all(value == values[0] for value in values) else np.array(values)


def _oil_of(oils):
    """Oil of many points whose laws have the parameters of single oils as arrays."""

    def law(name):
        laws = [getattr(oil, name) for oil in oils]
        return (
            _law_of(laws) if isinstance(laws[0], BoundLaw) else OfDensity(_law_of([one.law for one in laws]))
        )

    return replace(
        oils[0],
        viscosity=together(oil.viscosity for oil in oils),
        relative_permittivity=together(oil.relative_permittivity for oil in oils),
        **{name: law(name) for name in ("log_viscosity", "density_ratio", "permittivity")},
    )


def _law_of(laws):
    names = laws[0].parameters
    parameters = {name: together(law.parameters[name] for law in laws) for name in names}
    return BoundLaw(laws[0].function, parameters, laws[0].temperature)


def _geometry_of(rings):
    """Geometry with the radii at the contact angles of all points."""
    geometry = rings[0].conditions.geometry

    @dataclass(frozen=True)
    class OfPoints(type(geometry)):
        def radii(self, angle, *, inner):
            if np.ndim(angle) == 0:
                return super().radii(angle, inner=inner)
            found = [type(geometry).radii(geometry, float(one), inner=inner) for one in angle]
            names = ("element_x", "element_y", "ring_x", "ring_y")
            return ContactRadii(**{name: together(getattr(one, name) for one in found) for name in names})

    return OfPoints(**vars(geometry))


def prepared_of_points(prepared):
    """Bearings that are prepared, put together: their rings, and the loads at each position of the cage."""
    rings = tuple(ring_of_points([one.rings[k] for one in prepared]) for k in range(2))

    def at(position, *, inner):
        return SimpleNamespace(
            load=np.array([one.equilibria[position].ring(inner=inner).load for one in prepared])
        )

    equilibria = tuple(
        SimpleNamespace(ring=lambda *, inner, k=k: at(k, inner=inner))
        for k in range(len(prepared[0].equilibria))
    )
    shape = reduce(np.broadcast_shapes, (ring.shape for ring in rings))
    return SimpleNamespace(rings=rings, equilibria=equilibria, shape=shape)
