"""Operating conditions of line and point contacts: bodies, load, speeds, and size of the Hertzian contact."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Generic

import numpy as np

from ehlectric.arrays import Numbers, V, as_float
from ehlectric.cases.case import Case
from ehlectric.cases.contact_inputs import Contact
from ehlectric.cases.dry_contacts import line_load, line_radius, modulus_of, point_load, point_radius
from ehlectric.errors import InputError, within
from ehlectric.formulas import hertz
from ehlectric.formulas.film_line import LineContact, velocity_parameter
from ehlectric.formulas.film_point import PointContact
from ehlectric.lubricant.oil import Oil
from ehlectric.readable import readable


def speeds_of(contact: Contact) -> tuple[float, float]:
    """Entrainment speed [m/s] and slide-to-roll ratio of a contact."""
    if contact.entrainment_speed is not None:
        return contact.entrainment_speed, contact.slide_to_roll_ratio or 0.0
    assert contact.speed_1 is not None and contact.speed_2 is not None
    mean = 0.5 * (contact.speed_1 + contact.speed_2)
    return mean, (contact.speed_1 - contact.speed_2) / mean


def surface_ratios(slide_to_roll_ratio: float) -> tuple[float, float]:
    """Speeds of surfaces 1 and 2, each divided by the entrainment speed.

    Examples
    --------
    >>> surface_ratios(0.5)
    (1.25, 0.75)
    """
    return 1.0 + 0.5 * slide_to_roll_ratio, 1.0 - 0.5 * slide_to_roll_ratio


def check_width(half_width: float, radius: float) -> None:
    """Raise an InputError if the half-width [m] exceeds half the smallest radius [m].

    Half-space deflection and a parabolic gap hold only for contacts that are small compared to the bodies.
    """
    if half_width > 0.5 * radius:
        raise InputError(
            "contact",
            f"the Hertzian contact would be {readable(half_width)} m wide on each side, more than half of "
            f"the smallest radius {readable(radius)} m;",
            takes="less load, a larger modulus or less conforming bodies",
        )


def check_pressure(pressure: float, oil: Oil) -> None:
    """Raise an InputError if the Hertz pressure [Pa] is near the ambient pressure.

    An InputError is also raised if the permittivity law has no value at this pressure.
    """
    least = least_pressure(oil)
    if pressure < least:
        raise InputError(
            "contact",
            f"the maximum Hertzian pressure would be {readable(pressure)} Pa",
            takes=f"a load that gives at least {readable(least)} Pa, well above the ambient "
            f"{readable(oil.ambient_pressure)} Pa",
        )
    # A permittivity law that has no value at the Hertz pressure raises its error here. A law that fails only
    # at the higher pressure spike raises it after the film has been computed.
    at = np.array([pressure])
    oil.permittivity(at, oil.density_ratio(at)[0])


def least_pressure(oil: Oil) -> float:
    """Least Hertz pressure of a contact [Pa], well above the ambient pressure."""
    return max(1e4, 10.0 * oil.ambient_pressure)


# Half of the domain's width across entrainment, in semi-axes across: 1.6 for a long ellipse, whose sides
# have almost no effect; 3.0 for a circle; at most 4.5, as long as the inlet, for an ellipse that is short
# across.
_LEAST_SIDE, _CIRCLE_SIDE, _MOST_SIDE = 1.6, 3.0, 4.5


@dataclass(frozen=True, kw_only=True)
class SharedConditions(ABC, Generic[V]):
    """Operating conditions that line and point contacts have in common, SI units.

    They are floats of one contact, or arrays of many contacts that broadcast to a shape (...).
    """

    geometry: ClassVar[str]
    # Exponent of the entrainment speed in the film thickness of hard contacts. It converts a film factor to a
    # factor of the entrainment speed.
    film_exponent: ClassVar[float]

    reduced_modulus: V  # E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2
    entrainment_speed: V  # (u1 + u2)/2 [m/s]
    slide_to_roll_ratio: V = 0.0  # (u1 - u2)/entrainment_speed, dimensionless
    # viscosity and pressure_viscosity_coefficient: viscosity eta0 at ambient pressure [Pa s], and reciprocal
    # asymptotic coefficient alpha* [1/Pa].
    viscosity: V
    pressure_viscosity_coefficient: V
    max_pressure: V  # Hertz pressure p_h of the Hertzian contact [Pa]
    # Surface 1's share of 2/E', dimensionless; 0.5 if only the reduced modulus is known.
    compliance_share: V = 0.5
    # Thickness of the boundary film [m] at which the surfaces touch; zero where they are taken not to.
    boundary_film: float = 0.0
    # Largest pressure where the surfaces touch [Pa]; None for elastic asperities.
    hardness: float | None = None
    # Film thickness divided by the thickness of an isothermal, fully flooded film, dimensionless; see
    # ``contact``
    film_factor: V = 1.0

    @property
    def _film_speed(self) -> V:
        """Entrainment speed at which a flooded film is thinner by the film factor [m/s].

        An isothermal, fully flooded film is thinner by ``film_factor`` at the entrainment speed
        u film_factor^(1/exponent).
        """
        speed: V = self.entrainment_speed * self.film_factor ** (1.0 / self.film_exponent)
        return speed

    @property
    @abstractmethod
    def semi_axes(self) -> tuple[V, ...]:
        """Half-width of a line contact, or semi-axes along and across entrainment [m]."""

    @property
    @abstractmethod
    def radius_along(self) -> V:
        """Reduced radius along entrainment [m]."""

    @property
    @abstractmethod
    def carried_load(self) -> V:
        """Load [N]; of a line contact, load per length [N/m]."""

    @property
    def velocity_parameter(self) -> V:
        """Dimensionless velocity parameter Lambda = 6 eta0 u_s R^2/(b^3 p_h), where u_s = u1 + u2."""
        return velocity_parameter(
            viscosity=self.viscosity,
            entrainment_speed=self._film_speed,
            radius=self.radius_along,
            half_width=self.semi_axes[0],
            max_pressure=self.max_pressure,
        )

    @property
    def thickness_scale(self) -> V:
        """Film thickness that corresponds to H = 1, b^2/R [m], with the radius R along entrainment."""
        return self.semi_axes[0] ** 2 / self.radius_along


@dataclass(frozen=True, kw_only=True)
class Conditions(SharedConditions[V]):
    """Operating conditions of a line contact, SI units."""

    geometry: ClassVar[str] = "line"
    film_exponent: ClassVar[float] = 0.69  # Pan and Hamrock

    reduced_radius: V  # R [m]
    load_per_length: V  # w [N/m]
    half_width: V  # half-width b of the Hertzian contact [m]
    # Surface 1's share of 1/R, dimensionless; 0.5 if only the reduced radius is known.
    curvature_share: V = 0.5

    @property
    def contact(self) -> LineContact:
        """Inputs of the film-thickness formulas and of the Reynolds equation.

        ``film_factor`` acts only here, as a lower entrainment speed.
        """
        return LineContact(
            reduced_radius=self.reduced_radius,
            reduced_modulus=self.reduced_modulus,
            load_per_length=self.load_per_length,
            entrainment_speed=self._film_speed,
            viscosity=self.viscosity,
            pressure_viscosity_coefficient=self.pressure_viscosity_coefficient,
        )

    @property
    def semi_axes(self) -> tuple[V, ...]:
        """Half-width of the Hertzian contact [m], as a tuple of one number."""
        return (self.half_width,)

    @property
    def radius_along(self) -> V:
        """Reduced radius [m]."""
        return self.reduced_radius

    @property
    def carried_load(self) -> V:
        """Load per length [N/m]."""
        return self.load_per_length


@dataclass(frozen=True, kw_only=True)
class PointConditions(SharedConditions[V]):
    """Operating conditions of a point contact, SI units; x runs along entrainment, y across it."""

    geometry: ClassVar[str] = "point"
    film_exponent: ClassVar[float] = 0.67  # Hamrock and Dowson

    # radius_x and radius_y: reduced radii along and across entrainment [m].
    radius_x: V
    radius_y: V
    load: V  # F [N]
    # semi_axis_x and semi_axis_y: semi-axes b along and a across entrainment of the Hertzian contact [m].
    semi_axis_x: V
    semi_axis_y: V
    side: V  # half of the domain's width across entrainment, in semi-axes across

    @property
    def contact(self) -> PointContact:
        """Inputs of the film-thickness formulas and of the Reynolds equation.

        ``film_factor`` acts only here, as a lower entrainment speed.
        """
        return PointContact(
            radius_x=self.radius_x,
            radius_y=self.radius_y,
            reduced_modulus=self.reduced_modulus,
            load=self.load,
            entrainment_speed=self._film_speed,
            viscosity=self.viscosity,
            pressure_viscosity_coefficient=self.pressure_viscosity_coefficient,
        )

    @property
    def half_width(self) -> V:
        """Semi-axis of the Hertzian contact along entrainment [m], which scales x and y."""
        return self.semi_axis_x

    @property
    def semi_axes(self) -> tuple[V, ...]:
        """Semi-axes of the Hertzian contact along and across entrainment [m]."""
        return self.semi_axis_x, self.semi_axis_y

    @property
    def radius_along(self) -> V:
        """Reduced radius along entrainment [m]."""
        return self.radius_x

    @property
    def carried_load(self) -> V:
        """Load [N]."""
        return self.load

    @property
    def ratio(self) -> V:
        """Ratio k = a/b of the semi-axes of the Hertzian contact, a across and b along entrainment."""
        return self.semi_axis_y / self.semi_axis_x


def line_conditions(oil: Oil, *, bodies: Sequence[float] = (), **inputs: Any) -> Conditions:
    """Operating conditions of a line contact from numbers in SI units, without a case.

    ``inputs`` are attributes of ``Conditions``; the oil and the dry contact decide the others. ``bodies`` are
    the radii of both bodies [m], if they are known, compared with which the dry contact must be small. Raises
    an InputError if it is not, or if the Hertz pressure is near the ambient pressure.

    Examples
    --------
    >>> from ehlectric.cases.case_oil import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> inputs = {"reduced_radius": 0.01, "reduced_modulus": 226e9, "load_per_length": 3e5}
    >>> conditions = line_conditions(oil, **inputs, entrainment_speed=2.0)
    >>> round(conditions.max_pressure / 1e9, 3)
    1.039
    """
    load, radius, modulus = inputs["load_per_length"], inputs["reduced_radius"], inputs["reduced_modulus"]
    dry = {"load_per_length": load, "radius": radius, "modulus": modulus}
    half_width, max_pressure = float(hertz.line_half_width(**dry)), float(hertz.line_max_pressure(**dry))
    check_width(half_width, min([inputs["reduced_radius"], *bodies]))
    check_pressure(max_pressure, oil)
    return Conditions(
        **inputs,
        viscosity=oil.viscosity,
        pressure_viscosity_coefficient=oil.alpha_star,
        half_width=half_width,
        max_pressure=max_pressure,
    )


def point_conditions(
    oil: Oil,
    *,
    radii: tuple[float, float],
    bodies: tuple[Sequence[float], Sequence[float]] = ((), ()),
    side: float | None = None,
    **inputs: Any,
) -> PointConditions:
    """Operating conditions of a point contact from numbers in SI units, without a case.

    ``radii`` are the reduced radii along and across entrainment [m], and ``inputs`` are attributes of
    ``PointConditions``; the oil and the dry contact decide the others. ``bodies`` are the radii of both
    bodies along and across [m], if known, compared with which the dry contact must be small. ``side`` is
    half of the domain's width in semi-axes across, by default ``default_side``. Raises an InputError if the
    dry contact is too wide for its bodies, or if the Hertz pressure is near the ambient pressure.

    Examples
    --------
    >>> from ehlectric.cases.case_oil import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> inputs = {"radii": (0.01, 0.01), "reduced_modulus": 226e9, "load": 20.0}
    >>> conditions = point_conditions(oil, **inputs, entrainment_speed=2.0)
    >>> round(conditions.max_pressure / 1e9, 3)
    0.791
    """
    dry = hertz.dry_contact(inputs["load"], *radii, inputs["reduced_modulus"])
    along, across, max_pressure = float(dry.semi_axis_x), float(dry.semi_axis_y), float(dry.max_pressure)
    check_width(along, min([radii[0], *bodies[0]]))
    check_width(across, min([radii[1], *bodies[1]]))
    check_pressure(max_pressure, oil)
    return PointConditions(
        **inputs,
        radius_x=radii[0],
        radius_y=radii[1],
        viscosity=oil.viscosity,
        pressure_viscosity_coefficient=oil.alpha_star,
        semi_axis_x=along,
        semi_axis_y=across,
        max_pressure=max_pressure,
        side=float(default_side(across / along)) if side is None else side,
    )


def default_side(ratio: Numbers) -> Numbers:
    """Default half-width of the domain of a point contact: 1.6 + 1.4/k, at most 4.5 semi-axes across.

    The ``ratio`` k = a/b is the ratio of the semi-axes of the Hertzian contact, a across and b along
    entrainment, dimensionless, shape (...). The result is half of the domain's width, in semi-axes across,
    dimensionless, shape (...).

    Examples
    --------
    >>> default_side(1.0), round(default_side(9.3), 2), default_side(0.2)
    (3.0, 1.75, 4.5)
    """
    return as_float(np.minimum(_MOST_SIDE, _LEAST_SIDE + (_CIRCLE_SIDE - _LEAST_SIDE) / ratio))


def resolve(case: Case) -> Conditions:
    """Compute the operating conditions of a case of a line contact.

    Two radii are converted to the reduced radius, and a Hertz pressure to the load. Two speeds are converted
    to the entrainment speed and the slide-to-roll ratio.

    Returns operating conditions, SI units. Raises InputError if the values contradict each other: no positive
    reduced radius, a Hertz pressure near the ambient pressure, or a dry contact too wide for its bodies.

    Examples
    --------
    >>> contact = {"radius_1": "20 mm", "radius_2": "20 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "speed_1": 3.0, "speed_2": 1.0}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> conditions = resolve(case)
    >>> conditions.reduced_radius, conditions.entrainment_speed, conditions.slide_to_roll_ratio
    (0.01, 2.0, 1.0)
    """
    contact, shared = case.contact, _shared(case, "line")
    radius, curvature_share = line_radius(contact)
    return line_conditions(
        case.oil,
        reduced_radius=radius,
        load_per_length=line_load(contact),
        bodies=[abs(r) for r in (contact.radius_1, contact.radius_2) if r is not None],
        curvature_share=curvature_share,
        **shared,
    )


def _shared(case: Case, geometry: str) -> dict[str, Any]:
    """Operating conditions of a case that do not depend on the geometry, which is checked."""
    contact = case.contact
    if contact.geometry != geometry:
        raise InputError(
            "contact.geometry",
            got=f"{contact.geometry!r}",
            takes=f"{geometry!r} for a {geometry} contact's conditions",
        )
    modulus, compliance_share = modulus_of(contact)
    speed, slide_to_roll_ratio = speeds_of(contact)
    return {
        "reduced_modulus": modulus,
        "compliance_share": compliance_share,
        "entrainment_speed": speed,
        "slide_to_roll_ratio": slide_to_roll_ratio,
        "boundary_film": contact.touching_gap,
        "hardness": contact.hardness,
    }


def resolve_point(case: Case) -> PointConditions:
    """Compute the operating conditions of a case of a point contact.

    The radii of two bodies are converted to the reduced radii, and a Hertz pressure to the load. Two speeds
    are converted to the entrainment speed and the slide-to-roll ratio.

    Returns operating conditions, SI units. Raises InputError if the values contradict each other: no positive
    reduced radius in a plane, a Hertz pressure near the ambient pressure, or a dry contact too wide for its
    bodies.

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
    contact, shared = case.contact, _shared(case, "point")
    conditions = point_conditions(
        case.oil,
        radii=(point_radius(contact, "radius_x"), point_radius(contact, "radius_y")),
        load=point_load(contact),
        bodies=(_bodies(contact, "radius_x"), _bodies(contact, "radius_y")),
        side=case.grid.side,
        **shared,
    )
    with within("grid"):
        case.grid.check_across(conditions.side)
    return conditions


def _bodies(contact: Contact, key: str) -> list[float]:
    """Magnitudes of those body radii [m] in one plane that the case gives."""
    radii = [contact.value(f"{body}.{key}") for body in ("body_1", "body_2")]
    return [abs(radius) for radius in radii if radius is not None]
