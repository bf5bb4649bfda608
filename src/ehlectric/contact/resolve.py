"""Operating conditions of a case, computed from whichever alternative inputs the case gives."""

from __future__ import annotations

from ehlectric.cases.case import Case
from ehlectric.cases.contact import Contact
from ehlectric.contact.bodies import modulus_of, speeds_of
from ehlectric.contact.conditions import Conditions, PointConditions, line_conditions, point_conditions
from ehlectric.errors import InputError
from ehlectric.formulas import hertz_line as hertz
from ehlectric.formulas import hertz_point


def resolve(case: Case) -> Conditions:
    """Compute the operating conditions of a case of a line contact.

    Two radii are converted to the reduced radius, and a Hertz pressure to the load. Two speeds are converted
    to the entrainment speed and the slide-to-roll ratio.

    Parameters
    ----------
    case : Case
        A valid case of a line contact.

    Returns
    -------
    Conditions
        Operating conditions, SI units.

    Raises
    ------
    InputError
        If the values contradict each other: no positive reduced radius, a Hertz pressure near the ambient
        pressure, or a dry contact too wide for its bodies. Also if the case is of a point contact.

    Examples
    --------
    >>> contact = {"radius_1": "20 mm", "radius_2": "20 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "speed_1": 3.0, "speed_2": 1.0}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> conditions = resolve(case)
    >>> conditions.reduced_radius, conditions.entrainment_speed, conditions.slide_to_roll_ratio
    (0.01, 2.0, 1.0)
    """
    contact = case.contact
    if contact.geometry != "line":
        raise InputError(
            "contact.geometry", got=f"{contact.geometry!r}", takes="'line' for a line contact's conditions"
        )
    radius, curvature_share = _line_radius(contact)
    modulus, compliance_share = modulus_of(contact)
    speed, ratio = speeds_of(contact)
    load = contact.load_per_length
    if load is None:
        assert contact.max_hertz_pressure is not None
        load = hertz.line_load(contact.max_hertz_pressure, radius, modulus)
    return line_conditions(
        case.oil,
        reduced_radius=radius,
        reduced_modulus=modulus,
        load_per_length=load,
        entrainment_speed=speed,
        slide_to_roll_ratio=ratio,
        bodies=[abs(r) for r in (contact.radius_1, contact.radius_2) if r is not None],
        curvature_share=curvature_share,
        compliance_share=compliance_share,
        boundary_film=contact.touching_gap,
        hardness=contact.hardness,
    )


def _line_radius(contact: Contact) -> tuple[float, float]:
    """Reduced radius R [m], and surface 1's share of 1/R: 0.5 if only R is known."""
    if contact.reduced_radius is not None:
        return contact.reduced_radius, 0.5
    r1, r2 = contact.radius_1, contact.radius_2
    assert r1 is not None and r2 is not None
    if not 1.0 / r1 + 1.0 / r2 > 0.0:
        raise InputError(
            "contact.radius_1",
            got=f"{r1:g} m with radius_2 {r2:g} m",
            takes="radii with 1/radius_1 + 1/radius_2 above 0: a concave body must be wider than the other",
        )
    radius = hertz.reduced_radius(r1, r2)
    return radius, radius / r1


def resolve_point(case: Case) -> PointConditions:
    """Compute the operating conditions of a case of a point contact.

    The radii of two bodies are converted to the reduced radii, and a Hertz pressure to the load. Two speeds
    are converted to the entrainment speed and the slide-to-roll ratio.

    Parameters
    ----------
    case : Case
        A valid case of a point contact.

    Returns
    -------
    PointConditions
        Operating conditions, SI units.

    Raises
    ------
    InputError
        If the values contradict each other: no positive reduced radius in a plane, a Hertz pressure near the
        ambient pressure, or a dry contact too wide for its bodies. Also if the grid is too coarse across
        entrainment, or the case is of a line contact.

    Examples
    --------
    A ball in the groove of an inner ring:

    >>> ball, ring = {"radius_x": 6e-3, "radius_y": 6e-3}, {"radius_x": 24e-3, "radius_y": -6.24e-3}
    >>> contact = {"geometry": "point", "body_1": ring, "body_2": ball, "reduced_modulus": "226 GPa"}
    >>> contact |= {"load": "600 N", "entrainment_speed": "4 m/s"}
    >>> conditions = resolve_point(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}))
    >>> round(conditions.radius_x, 6), round(conditions.radius_y, 6), round(conditions.ratio, 2)
    (0.0048, 0.156, 9.32)
    """
    contact = case.contact
    if contact.geometry != "point":
        raise InputError(
            "contact.geometry", got=f"{contact.geometry!r}", takes="'point' for a point contact's conditions"
        )
    radius_x, radius_y = _point_radius(contact, "radius_x"), _point_radius(contact, "radius_y")
    modulus, compliance_share = modulus_of(contact)
    speed, slide_to_roll = speeds_of(contact)
    load = contact.load
    if load is None:
        assert contact.max_hertz_pressure is not None
        load = hertz_point.point_load(contact.max_hertz_pressure, radius_x, radius_y, modulus)
    conditions = point_conditions(
        case.oil,
        radii=(radius_x, radius_y),
        reduced_modulus=modulus,
        load=load,
        entrainment_speed=speed,
        slide_to_roll_ratio=slide_to_roll,
        bodies=(_bodies(contact, "radius_x"), _bodies(contact, "radius_y")),
        side=case.grid.side,
        compliance_share=compliance_share,
        boundary_film=contact.touching_gap,
        hardness=contact.hardness,
    )
    try:
        case.grid.check_across(conditions.side)
    except InputError as error:
        raise error.under("grid") from None
    return conditions


def _bodies(contact: Contact, key: str) -> list[float]:
    """Magnitudes of those body radii [m] in one plane that the case gives."""
    radii = [contact.value(f"{body}.{key}") for body in ("body_1", "body_2")]
    return [abs(radius) for radius in radii if radius is not None]


def _point_radius(contact: Contact, key: str) -> float:
    """Reduced radius in one plane [m]; ``key`` is "radius_x" or "radius_y"."""
    reduced: float | None = contact.value(key)
    if reduced is not None:
        return reduced
    r1, r2 = (contact.value(f"{body}.{key}") for body in ("body_1", "body_2"))
    if not 1.0 / r1 + 1.0 / r2 > 0.0:
        raise InputError(
            f"contact.body_1.{key}",
            got=f"{r1:g} m with {r2:g} m of body_2",
            takes="radii with 1/radius of body_1 + 1/radius of body_2 above 0: a concave body must be "
            "wider than the other",
        )
    return hertz.reduced_radius(r1, r2)
