"""What a case means: its alternatives resolved, the dry contact, the dimensionless groups."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.cases.contact import Contact
from ehlectric.cases.lubricant import effective_alpha
from ehlectric.contact.bodies import check_pressure, check_width, modulus_of, speeds_of
from ehlectric.errors import InputError
from ehlectric.formulas import film_line as film_formulas
from ehlectric.formulas import film_point as point_formulas
from ehlectric.formulas import hertz_line as hertz
from ehlectric.formulas import hertz_point

# Half of the domain's width in semi-axes across: this much beside a long ellipse, whose sides hardly matter,
# three beside a circle, and no more than the inlet has along entrainment where the ellipse is short across.
_LEAST_SIDE, _CIRCLE_SIDE, _MOST_SIDE = 1.6, 3.0, 4.5


@dataclass(frozen=True)
class Conditions:
    """Operating conditions of a line contact, SI units.

    Attributes
    ----------
    reduced_radius, reduced_modulus, load_per_length : float
        R [m], E' [Pa] with the factor two, and w [N/m].
    entrainment_speed : float
        (u1 + u2)/2 [m/s].
    slide_to_roll_ratio : float
        (u1 - u2)/entrainment_speed.
    half_width, max_pressure : float
        b [m] and p_h [Pa] of the dry contact.
    velocity_parameter : float
        lambda = 6 eta0 u_s R^2/(b^3 p_h) with u_s = u1 + u2.
    curvature_share, compliance_share : float
        Parts of 1/R and of 2/E' that are surface 1's.
    formulas : film_formulas.LineContact
        The contact as the film-thickness formulas take it.
    """

    reduced_radius: float
    reduced_modulus: float
    load_per_length: float
    entrainment_speed: float
    slide_to_roll_ratio: float
    half_width: float
    max_pressure: float
    velocity_parameter: float
    curvature_share: float
    compliance_share: float
    formulas: film_formulas.LineContact

    @property
    def semi_axes(self) -> tuple[float, ...]:
        """Half-width of the dry contact [m]."""
        return (self.half_width,)

    @property
    def thickness_scale(self) -> float:
        """b^2/R, the film thickness of H = 1 [m]."""
        return self.half_width**2 / self.reduced_radius


def resolve(case: Case) -> Conditions:
    """Operating conditions of a case.

    Parameters
    ----------
    case : Case
        A valid case.

    Returns
    -------
    Conditions
        With every alternative resolved.

    Raises
    ------
    InputError
        Where the values contradict each other: no positive reduced radius, a Hertz pressure below the
        ambient one, a dry contact wider than its bodies.

    Examples
    --------
    >>> contact = {"radius_1": "20 mm", "radius_2": "20 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "speed_1": 3.0, "speed_2": 1.0}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> conditions = resolve(case)
    >>> conditions.reduced_radius, conditions.entrainment_speed, conditions.slide_to_roll_ratio
    (0.01, 2.0, 1.0)
    """
    contact, lubricant = case.contact, case.lubricant
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
    half_width = hertz.line_half_width(load, radius, modulus)
    max_pressure = hertz.line_max_pressure(load, radius, modulus)
    bodies = [abs(r) for r in (contact.radius_1, contact.radius_2) if r is not None]
    check_width(half_width, min([radius, *bodies]))
    check_pressure(max_pressure, lubricant)
    eta0, alpha = lubricant.viscosity, effective_alpha(lubricant)
    return Conditions(
        reduced_radius=radius,
        reduced_modulus=modulus,
        load_per_length=load,
        entrainment_speed=speed,
        slide_to_roll_ratio=ratio,
        half_width=half_width,
        max_pressure=max_pressure,
        velocity_parameter=12.0 * eta0 * speed * radius**2 / (half_width**3 * max_pressure),
        curvature_share=curvature_share,
        compliance_share=compliance_share,
        formulas=film_formulas.LineContact(radius, modulus, load, speed, eta0, alpha),
    )


def _line_radius(contact: Contact) -> tuple[float, float]:
    """Reduced radius, and the part of 1/R that is surface 1's: a half where only R is known."""
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


@dataclass(frozen=True)
class PointConditions:
    """Operating conditions of a point contact, SI units; x along entrainment, y across it.

    Attributes
    ----------
    radius_x, radius_y : float
        Reduced radii [m].
    reduced_modulus : float
        E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    load : float
        F [N].
    entrainment_speed : float
        (u1 + u2)/2 [m/s].
    slide_to_roll_ratio : float
        (u1 - u2)/entrainment_speed.
    semi_axis_x, semi_axis_y, max_pressure : float
        b, a [m] and p_h [Pa] of the dry contact.
    velocity_parameter : float
        lambda = 6 eta0 u_s Rx^2/(b^3 p_h) with u_s = u1 + u2.
    compliance_share : float
        Part of 2/E' that is surface 1's; a half where only the reduced value is known.
    side : float
        Half of the domain's width, in semi-axes across.
    formulas : point_formulas.PointContact
        The contact as the film-thickness formulas take it.
    """

    radius_x: float
    radius_y: float
    reduced_modulus: float
    load: float
    entrainment_speed: float
    slide_to_roll_ratio: float
    semi_axis_x: float
    semi_axis_y: float
    max_pressure: float
    velocity_parameter: float
    compliance_share: float
    side: float
    formulas: point_formulas.PointContact

    @property
    def half_width(self) -> float:
        """The length that x is in, the semi-axis along entrainment [m]."""
        return self.semi_axis_x

    @property
    def semi_axes(self) -> tuple[float, ...]:
        """Semi-axes of the dry contact along and across entrainment [m]."""
        return self.semi_axis_x, self.semi_axis_y

    @property
    def ratio(self) -> float:
        """Ratio k of the semi-axes, across over along entrainment."""
        return self.semi_axis_y / self.semi_axis_x

    @property
    def thickness_scale(self) -> float:
        """b^2/Rx, the film thickness of H = 1 [m]."""
        return self.semi_axis_x**2 / self.radius_x


def resolve_point(case: Case) -> PointConditions:
    """Operating conditions of a case of a point contact.

    Parameters
    ----------
    case : Case
        A valid case.

    Returns
    -------
    PointConditions
        With every alternative resolved.

    Raises
    ------
    InputError
        Where the values contradict each other: no positive reduced radius in a plane, a Hertz pressure below
        the ambient one, a dry contact wider than its bodies, a grid too coarse across; or for a line contact.

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
    contact, lubricant = case.contact, case.lubricant
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
    dry = hertz_point.dry_contact(load, radius_x, radius_y, modulus)
    check_width(dry.semi_axis_x, min([radius_x, *_bodies(contact, "radius_x")]))
    check_width(dry.semi_axis_y, min([radius_y, *_bodies(contact, "radius_y")]))
    check_pressure(dry.max_pressure, lubricant)
    eta0, alpha = lubricant.viscosity, effective_alpha(lubricant)
    return PointConditions(
        radius_x=radius_x,
        radius_y=radius_y,
        reduced_modulus=modulus,
        load=load,
        entrainment_speed=speed,
        slide_to_roll_ratio=slide_to_roll,
        semi_axis_x=dry.semi_axis_x,
        semi_axis_y=dry.semi_axis_y,
        max_pressure=dry.max_pressure,
        velocity_parameter=12.0 * eta0 * speed * radius_x**2 / (dry.semi_axis_x**3 * dry.max_pressure),
        compliance_share=compliance_share,
        side=_side(case, dry.semi_axis_y / dry.semi_axis_x),
        formulas=point_formulas.PointContact(radius_x, radius_y, modulus, load, speed, eta0, alpha),
    )


def _bodies(contact: Contact, key: str) -> list[float]:
    """Radii of the bodies in one plane as far as they are given, without their signs."""
    radii = [contact.value(f"{body}.{key}") for body in ("body_1", "body_2")]
    return [abs(radius) for radius in radii if radius is not None]


def _point_radius(contact: Contact, key: str) -> float:
    """Reduced radius of one plane."""
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


def _side(case: Case, ratio: float) -> float:
    """Half of the domain's width in semi-axes across, over which the grid must resolve the Hertz zone."""
    side = case.grid.side
    if side is None:
        side = default_side(ratio)
    try:
        case.grid.check_across(side)
    except InputError as error:
        raise error.under("grid") from None
    return side


def default_side(ratio: float) -> float:
    """Half of the domain's width where the case gives none, in semi-axes across: 1.6 + 1.4/k, at most 4.5.

    Parameters
    ----------
    ratio : float
        k, the semi-axis across over that along entrainment.

    Returns
    -------
    float
        In semi-axes across, dimensionless.

    Examples
    --------
    >>> default_side(1.0), round(default_side(9.3), 2), default_side(0.2)
    (3.0, 1.75, 4.5)
    """
    return min(_MOST_SIDE, _LEAST_SIDE + (_CIRCLE_SIDE - _LEAST_SIDE) / ratio)


def point_inputs(case: Case, conditions: PointConditions) -> dict[str, Any]:
    """The case as nested tables, its alternatives resolved."""
    inputs = case.to_dict()
    names = ("radius_x", "radius_y", "reduced_modulus", "load", "entrainment_speed", "slide_to_roll_ratio")
    inputs["contact"] = {"geometry": case.contact.geometry} | {
        name: getattr(conditions, name) for name in names
    }
    inputs["grid"] |= {"side": conditions.side}
    return inputs


def point_hertz(conditions: PointConditions) -> dict[str, float]:
    """The dry contact, with the keys of summary.json."""
    return {
        "semi_axis_x": conditions.semi_axis_x,
        "semi_axis_y": conditions.semi_axis_y,
        "max_pressure": conditions.max_pressure,
    }


def resolved_inputs(case: Case, conditions: Conditions) -> dict[str, Any]:
    """The case as nested tables, its alternatives resolved."""
    inputs = case.to_dict()
    inputs["contact"] = {
        "geometry": case.contact.geometry,
        "reduced_radius": conditions.reduced_radius,
        "reduced_modulus": conditions.reduced_modulus,
        "load_per_length": conditions.load_per_length,
        "entrainment_speed": conditions.entrainment_speed,
        "slide_to_roll_ratio": conditions.slide_to_roll_ratio,
    }
    return inputs
