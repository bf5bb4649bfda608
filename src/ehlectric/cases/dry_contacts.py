"""Dry contact of the table ``contact``: reduced modulus and radii, load, and Hertz pressure."""

from __future__ import annotations

import math

from ehlectric.cases.contact_inputs import Contact
from ehlectric.errors import InputError
from ehlectric.formulas import hertz


def modulus_of(contact: Contact) -> tuple[float, float]:
    """Reduced modulus E' [Pa], and surface 1's share of 2/E': 0.5 if only E' is known."""
    if contact.reduced_modulus is not None:
        return contact.reduced_modulus, 0.5
    first, second = (
        hertz.body_compliance(
            contact.value(f"{body}.youngs_modulus"), contact.value(f"{body}.poissons_ratio")
        )
        for body in ("body_1", "body_2")
    )
    return hertz.reduced_modulus(first, second), first / (first + second)


def line_radius(contact: Contact) -> tuple[float, float]:
    """Reduced radius R [m], and surface 1's share of 1/R: 0.5 if only R is known."""
    if contact.reduced_radius is not None:
        return contact.reduced_radius, 0.5
    r1, r2 = contact.radius_1, contact.radius_2
    assert r1 is not None and r2 is not None
    if math.isinf(r1) and math.isinf(r2):
        raise _planes("radius_1", "a finite radius of one body: two planes do not touch along a line")
    if not 1.0 / r1 + 1.0 / r2 > 0.0:
        raise _gapless("radius_1", f"{r1:g} m with radius_2 {r2:g} m", "1/radius_1 + 1/radius_2")
    radius = hertz.reduced_radius(r1, r2)
    return radius, radius / r1


def point_radius(contact: Contact, key: str) -> float:
    """Reduced radius in one plane [m]; ``key`` is "radius_x" or "radius_y"."""
    reduced: float | None = contact.value(key)
    if reduced is not None:
        return reduced
    r1, r2 = (contact.value(f"{body}.{key}") for body in ("body_1", "body_2"))
    if math.isinf(r1) and math.isinf(r2):
        takes = "a finite radius of one body; a cylinder on a plane has geometry = 'line'"
        raise _planes(f"body_1.{key}", takes)
    if not 1.0 / r1 + 1.0 / r2 > 0.0:
        curvatures = "1/radius of body_1 + 1/radius of body_2"
        raise _gapless(f"body_1.{key}", f"{r1:g} m with {r2:g} m of body_2", curvatures)
    radius: float = hertz.reduced_radius(r1, r2)
    return radius


def _planes(key: str, takes: str) -> InputError:
    """Error of two bodies without curvature in a direction."""
    return InputError(f"contact.{key}", got="two planes: the radii of both bodies are infinite", takes=takes)


def _gapless(key: str, got: str, curvatures: str) -> InputError:
    """Error of two bodies whose curvatures leave no gap."""
    takes = f"radii with {curvatures} above 0: a concave body must be wider than the other"
    return InputError(f"contact.{key}", got=got, takes=takes)


def line_load(contact: Contact) -> float:
    """Load per length of a line contact [N/m], given or from its Hertz pressure."""
    if contact.load_per_length is not None:
        return contact.load_per_length
    assert contact.max_hertz_pressure is not None
    radius, _ = line_radius(contact)
    return hertz.line_load(contact.max_hertz_pressure, radius, modulus_of(contact)[0])


def point_load(contact: Contact) -> float:
    """Load of a point contact [N], given or from its Hertz pressure."""
    if contact.load is not None:
        return contact.load
    assert contact.max_hertz_pressure is not None
    radii = point_radius(contact, "radius_x"), point_radius(contact, "radius_y")
    return hertz.point_load(contact.max_hertz_pressure, *radii, modulus_of(contact)[0])


def hertz_pressure(contact: Contact) -> float:
    """Maximum pressure of the dry contact [Pa]. Raises InputError if a reduced radius is not positive.

    Examples
    --------
    >>> line = {"reduced_radius": 0.01, "reduced_modulus": 226e9, "load_per_length": 3e5}
    >>> round(hertz_pressure(Contact.from_dict(line | {"entrainment_speed": 2.0})) / 1e9, 3)
    1.039
    """
    modulus, _ = modulus_of(contact)
    if contact.geometry == "line":
        return float(
            hertz.line_max_pressure(
                load_per_length=line_load(contact), radius=line_radius(contact)[0], modulus=modulus
            )
        )
    radii = point_radius(contact, "radius_x"), point_radius(contact, "radius_y")
    return float(hertz.dry_contact(point_load(contact), *radii, modulus).max_pressure)
