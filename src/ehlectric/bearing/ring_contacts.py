"""Contacts of a bearing's elements with one ring: operating conditions, and the gap around their films."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingConditions, G_co, RingConditions
from ehlectric.bearing.gaps.groove import groove_capacitance, match_film, outside_capacitance
from ehlectric.bearing.gaps.raceway import Raceway
from ehlectric.bearing.gaps.roller import RollerRaceway, roller_capacitance, roller_tails
from ehlectric.bearing.loads.geometry import BallBearing, ContactRadii, RollerBearing
from ehlectric.cases.discharge import Discharge
from ehlectric.cases.grid import Grid
from ehlectric.contact.bodies import check_pressure, check_width
from ehlectric.contact.conditions import Conditions, PointConditions, default_side
from ehlectric.contact.memory import check_grid
from ehlectric.errors import InputError
from ehlectric.formulas.film_line import moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes
from ehlectric.formulas.hertz_line import line_half_width, line_max_pressure
from ehlectric.formulas.hertz_point import DryContact, dry_contact
from ehlectric.lubricant.oil import Oil

# Largest film thickness over (f - 1/2) D, the difference of the radii of groove and ball, at which the film
# does not change contact angle and gap. For a roller, the largest length sqrt(2 R h) over which the film
# builds up, over the roller's radius, at which the roller is still a parabola.
_ROOM = 0.1

# Least entrainment speed of a contact [m/s], the same as in a case: slower contacts have no film, and the
# numbers of their film equations leave the range of floating-point arithmetic.
_LEAST_SPEED = 1e-9


@dataclass(frozen=True)
class RingContacts(Generic[G_co]):
    """Contacts of all elements with one ring, without their loads.

    Attributes
    ----------
    conditions : BearingConditions
        Conditions that all contacts of the bearing share.
    inner : bool
        True for the inner ring, False for the outer ring.
    angle : float
        Contact angle at which the radii are taken [rad].
    speed : float
        Entrainment speed (u1 + u2)/2 [m/s].
    """

    conditions: BearingConditions[G_co]
    inner: bool
    angle: float
    speed: float

    @property
    def name(self) -> str:
        """Name of the ring, "inner" or "outer"."""
        return "inner" if self.inner else "outer"

    @property
    def _own(self) -> RingConditions:
        return self.conditions.inner if self.inner else self.conditions.outer

    @property
    def oil(self) -> Oil:
        """Oil in the contacts, at the temperature of the ring."""
        return self._own.oil

    @property
    def discharge(self) -> Discharge:
        """Dielectric strength and conductivity in the contacts, at the temperature of the ring."""
        return self._own.discharge

    @property
    def film_factor(self) -> float:
        """Film thickness over that of isothermal, fully flooded oil, dimensionless, at most 1."""
        return self._own.film_factor

    @property
    def radii(self) -> ContactRadii:
        """Radii of element and ring at the contact angle [m]."""
        return self.conditions.radii(self.angle, inner=self.inner)


@dataclass(frozen=True)
class BallContact:
    """Contact of a ball with a ring under a load.

    Attributes
    ----------
    ring : RingContacts
        Contacts with the ring.
    load : float
        Load of the contact [N].
    """

    ring: RingContacts[BallBearing]
    load: float

    @cached_property
    def dry(self) -> DryContact:
        """Dry contact under the load."""
        radii = self.ring.radii
        return dry_contact(self.load, radii.radius_x, radii.radius_y, self.ring.conditions.modulus)

    @cached_property
    def conditions(self) -> PointConditions:
        """Operating conditions of the point contact, which ``check_contact`` may still refuse."""
        bearing, oil, radii, dry = self.ring.conditions, self.ring.oil, self.ring.radii, self.dry
        return PointConditions(
            radius_x=radii.radius_x,
            radius_y=radii.radius_y,
            reduced_modulus=bearing.modulus,
            load=self.load,
            entrainment_speed=self.ring.speed,
            slide_to_roll_ratio=0.0,
            viscosity=oil.viscosity,
            pressure_viscosity_coefficient=oil.alpha_star,
            semi_axis_x=dry.semi_axis_x,
            semi_axis_y=dry.semi_axis_y,
            max_pressure=dry.max_pressure,
            side=default_side(dry.semi_axis_y / dry.semi_axis_x),
            compliance_share=bearing.ring_share,
            film_factor=self.ring.film_factor,
        )

    @property
    def widths(self) -> tuple[tuple[float, float], ...]:
        """Semi-axes of the dry contact along and across, each with the smallest radius in its plane [m]."""
        radii, dry = self.ring.radii, self.dry
        along = min(radii.radius_x, abs(radii.ring_x), abs(radii.element_x))
        across = min(radii.radius_y, abs(radii.ring_y), abs(radii.element_y))
        return (dry.semi_axis_x, along), (dry.semi_axis_y, across)

    @cached_property
    def film(self) -> float:
        """Central film thickness [m] by the formula of Nijenbanning, Venner and Moes.

        The formula holds for light contacts too.
        """
        return nijenbanning_venner_moes(self.conditions.contact).central_thickness

    @property
    def thickest_film(self) -> float:
        """Largest film thickness [m] for which there is room between ball and groove."""
        return _ROOM * self.ring.conditions.geometry.offsets[0 if self.ring.inner else 1]


@dataclass(frozen=True)
class RollerContact:
    """Contact of a roller with a ring under a load.

    Attributes
    ----------
    ring : RingContacts
        Contacts with the ring.
    load : float
        Load of the contact [N].
    """

    ring: RingContacts[RollerBearing]
    load: float

    @property
    def length(self) -> float:
        """Length of the roller [m]."""
        return self.ring.conditions.geometry.roller_length

    @cached_property
    def conditions(self) -> Conditions:
        """Operating conditions of the line contact, which ``check_contact`` may still refuse."""
        bearing, oil, radii = self.ring.conditions, self.ring.oil, self.ring.radii
        radius, modulus, load_per_length = radii.radius_x, bearing.modulus, self.load / self.length
        return Conditions(
            reduced_radius=radius,
            reduced_modulus=modulus,
            load_per_length=load_per_length,
            entrainment_speed=self.ring.speed,
            slide_to_roll_ratio=0.0,
            viscosity=oil.viscosity,
            pressure_viscosity_coefficient=oil.alpha_star,
            half_width=line_half_width(load_per_length, radius, modulus),
            max_pressure=line_max_pressure(load_per_length, radius, modulus),
            curvature_share=radius / radii.ring_x,
            compliance_share=bearing.ring_share,
            film_factor=self.ring.film_factor,
        )

    @property
    def widths(self) -> tuple[tuple[float, float], ...]:
        """Half-width of the dry contact, with the smallest radius in its plane [m]."""
        radii = self.ring.radii
        return ((self.conditions.half_width, min(radii.radius_x, abs(radii.ring_x), abs(radii.element_x))),)

    @cached_property
    def film(self) -> float:
        """Central film thickness [m] by the formula of Moes, which holds for light contacts too."""
        return moes(self.conditions.contact).central_thickness

    @property
    def thickest_film(self) -> float:
        """Largest film thickness [m] for which the roller is a parabola where its film builds up."""
        radius = 0.5 * self.ring.conditions.geometry.roller_diameter
        return (_ROOM * radius) ** 2 / (2.0 * self.conditions.reduced_radius)


Contact: TypeAlias = BallContact | RollerContact


def check_contact(contact: Contact, grid: Grid | None = None) -> None:
    """Refuse a contact that is beyond the model, or whose grid does not fit into the memory.

    Parameters
    ----------
    contact : BallContact or RollerContact
        Contact and load.
    grid : Grid, optional
        Grid of film and field, where these are to be solved.

    Raises
    ------
    InputError
        Where the contact is too slow for a film, too wide for its bodies, or its Hertz pressure too low, with
        ring and load; where the permittivity of the oil has no value at the Hertz pressure.
    MemoryLimitError
        Where the machine cannot hold film and field on the grid.
    """
    conditions = contact.conditions
    try:
        _check_speed(conditions.contact.entrainment_speed)
        for half_width, radius in contact.widths:
            check_width(half_width, radius)
        check_pressure(conditions.max_pressure, contact.ring.oil)
        if grid is not None:
            check_grid(conditions.geometry, grid, rough=False)
    except InputError as error:
        raise error_of_contact(contact, error) from None


def _check_speed(speed: float) -> None:
    """Refuse a contact without a film, by the entrainment speed [m/s] of isothermal oil with its film."""
    if speed < _LEAST_SPEED:
        raise InputError(
            "contact",
            f"the film would be that of an entrainment speed of {speed:.3g} m/s",
            takes=f"an inner_speed and a film_factor that give at least {_LEAST_SPEED:g} m/s",
        )


def error_of_contact(contact: Contact, error: InputError) -> InputError:
    """Error of a contact or its grid as an error of the bearing that names ring and load.

    Errors about other tables, such as the oil of the bearing file, stay as they are.
    """
    table = (error.key or "").partition(".")[0]
    if table not in ("contact", "grid"):
        return error
    text = error.text if error.key == "contact" else str(error)
    where = f"{contact.ring.name} contact at {contact.load:.4g} N"
    return error.retold("bearing", f"{where}: {text}")


def raceway_of(ring: RingContacts[BallBearing]) -> Raceway:
    """Groove of one ring, with a ball at the contact angle."""
    geometry, shoulder_height = ring.conditions.geometry, ring.conditions.bearing.shoulder_height
    assert shoulder_height is not None
    return Raceway.of(
        geometry.ball_diameter,
        geometry.pitch_diameter,
        geometry.inner_groove if ring.inner else geometry.outer_groove,
        shoulder_height,
        outer=not ring.inner,
        contact_angle=ring.angle,
    )


def _roller_raceway(ring: RingContacts[RollerBearing]) -> RollerRaceway:
    """Raceway of one ring, with a roller on it."""
    radii = ring.radii
    return RollerRaceway(radii.element_x, abs(radii.ring_x), outer=not ring.inner)


def around_ball(contact: BallContact, nodes: tuple[Array, Array], thickness: Array) -> tuple[float, float]:
    """Capacitance between ball and groove outside the domain of the film, in vacuum.

    Parameters
    ----------
    contact : BallContact
        Contact of the ball.
    nodes : tuple of ndarray, shapes (nx,), (ny,)
        Nodes of the film along and across entrainment [m].
    thickness : ndarray, shape (nx, ny)
        Film thickness [m].

    Returns
    -------
    capacitance : float
        Capacitance in vacuum [F].
    mismatch : float
        Largest relative difference, at the edge of the domain, between the film thickness and the gap
        outside.
    """
    x, y = np.meshgrid(*nodes, indexing="ij")
    rim = np.ones_like(thickness, dtype=bool)
    rim[1:-1, 1:-1] = False
    domain = float(nodes[0][0]), float(nodes[0][-1]), float(nodes[1][-1])
    found = around_balls(contact.ring, contact.dry, domain, (x[rim], y[rim]), thickness[rim])
    return float(found[0]), float(found[1])


def around_balls(
    ring: RingContacts[BallBearing],
    dry: DryContact,
    domain: tuple[float | Array, float | Array, float | Array],
    rim: tuple[Array, Array],
    thickness: Array,
    opened: Array | None = None,
) -> tuple[Array, Array]:
    """Capacitances as of ``around_ball``, for balls under several loads at once.

    Parameters
    ----------
    ring : RingContacts
        Contacts of the balls with one ring.
    dry : DryContact
        Dry contacts, values of shape (...).
    domain : tuple of float or ndarray, shape (...)
        Inlet, outlet and side of the domains [m].
    rim : tuple of ndarray, shape (..., n)
        Points on the edges of the domains, along and across entrainment [m].
    thickness : ndarray, shape (..., n)
        Film thickness at the points [m].
    opened : ndarray, shape (..., n), optional
        Deflection at the points, where it is known [m].

    Returns
    -------
    capacitance, mismatch : ndarray, shape (...)
        Values as of ``around_ball``.
    """
    raceway, (x, y) = raceway_of(ring), rim
    modulus = ring.conditions.modulus
    matched = match_film(raceway, dry, modulus, x=x, y=y, thickness=thickness, opened=opened)
    return outside_capacitance(raceway, matched, domain), np.asarray(matched.mismatch)


def around_roller(ring: RingContacts[RollerBearing], half_width: float, x: Array, thickness: Array) -> float:
    """Capacitance between roller and raceway outside the domain of the film, in vacuum.

    Parameters
    ----------
    ring : RingContacts
        Contacts of the rollers with one ring.
    half_width : float
        Half-width of the dry contact [m].
    x, thickness : ndarray, shape (nx,)
        Nodes of the film and its thickness [m].

    Returns
    -------
    float
        Capacitance in vacuum over the length of the roller [F].
    """
    ends = (float(x[0]), float(x[-1])), (float(thickness[0]), float(thickness[-1]))
    tails = roller_tails(_roller_raceway(ring), half_width, *ends)
    return ring.conditions.geometry.roller_length * sum(tails)


def rigid_ball(ring: RingContacts[BallBearing], gap: float) -> float:
    """Capacitance in vacuum [F] of a rigid ball and its groove, a gap [m] apart."""
    return groove_capacitance(raceway_of(ring), gap)


def rigid_roller(ring: RingContacts[RollerBearing], gap: float) -> float:
    """Capacitance in vacuum [F] of a rigid roller and its raceway, a gap [m] apart."""
    return ring.conditions.geometry.roller_length * roller_capacitance(_roller_raceway(ring), gap)
