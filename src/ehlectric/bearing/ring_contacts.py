"""Contacts of a bearing's elements with one ring: as formulas take them, and the gap around their films."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingConditions, G_co
from ehlectric.bearing.gaps.groove import Raceway, groove_capacitance, match_film, outside_capacitance
from ehlectric.bearing.gaps.roller import RollerRaceway, roller_capacitance, roller_tails
from ehlectric.bearing.loads.geometry import BallBearing, ContactRadii, RollerBearing
from ehlectric.cases.lubricant import effective_alpha
from ehlectric.errors import InputError
from ehlectric.formulas.film_line import LineContact, moes
from ehlectric.formulas.film_point import PointContact, nijenbanning_venner_moes
from ehlectric.formulas.hertz_line import line_half_width
from ehlectric.formulas.hertz_point import DryContact, dry_contact

# A film is without influence on contact angles and gap up to this part of (f - 1/2) D, the difference of the
# radii of groove and ball; a roller is a parabola where its film builds up over a length sqrt(2 R h) of up to
# this part of its radius.
_ROOM = 0.1


@dataclass(frozen=True)
class RingContacts(Generic[G_co]):
    """Contacts of all elements with one ring, without their loads.

    Attributes
    ----------
    conditions : BearingConditions
        The bearing.
    inner : bool
        Whether the ring is the inner one.
    angle : float
        Contact angle at which the radii are taken [rad].
    speed : float
        Entrainment speed [m/s], the film factor in it.
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
    def radii(self) -> ContactRadii:
        """Radii of element and ring at the contact angle."""
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
    def point(self) -> PointContact:
        """Contact as film formulas take it."""
        radii, conditions = self.ring.radii, self.ring.conditions
        oil = conditions.lubricant
        return PointContact(
            radii.radius_x,
            radii.radius_y,
            conditions.modulus,
            self.load,
            self.ring.speed,
            oil.viscosity,
            effective_alpha(oil),
        )

    @cached_property
    def dry(self) -> DryContact:
        """Dry contact of the load."""
        return dry_contact(self.load, self.point.radius_x, self.point.radius_y, self.point.reduced_modulus)

    @cached_property
    def film(self) -> float:
        """Central film thickness [m] by a formula that holds for light contacts too."""
        return nijenbanning_venner_moes(self.point).central_thickness

    @property
    def thickest_film(self) -> float:
        """Film thickness [m] beyond which ball and groove leave the film no room."""
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

    @cached_property
    def line(self) -> LineContact:
        """Contact as film formulas take it."""
        conditions = self.ring.conditions
        oil, load_per_length = conditions.lubricant, self.load / self.length
        return LineContact(
            self.ring.radii.radius_x,
            conditions.modulus,
            load_per_length,
            self.ring.speed,
            oil.viscosity,
            effective_alpha(oil),
        )

    @property
    def length(self) -> float:
        """Length of the roller [m]."""
        return self.ring.conditions.geometry.roller_length

    @cached_property
    def half_width(self) -> float:
        """Half-width b of the dry contact [m]."""
        line = self.line
        return line_half_width(line.load_per_length, line.reduced_radius, line.reduced_modulus)

    @cached_property
    def film(self) -> float:
        """Central film thickness [m] by a formula that holds for light contacts too."""
        return moes(self.line).central_thickness

    @property
    def thickest_film(self) -> float:
        """Film thickness [m] beyond which the roller is no parabola where its film builds up."""
        radius = 0.5 * self.ring.conditions.geometry.roller_diameter
        return (_ROOM * radius) ** 2 / (2.0 * self.line.reduced_radius)


Contact: TypeAlias = BallContact | RollerContact


@contextmanager
def of_contact(contact: Contact) -> Iterator[None]:
    """Errors of a contact, whose case nobody wrote, as errors of the bearing that name ring and load."""
    try:
        yield
    except InputError as error:
        table = (error.key or "").partition(".")[0]
        if table not in ("contact", "contact_angle", "grid"):
            raise
        text = error.text if error.key == "contact" else str(error)
        where = f"{contact.ring.name} contact at {contact.load:.4g} N"
        raise error.retold("bearing", f"{where}: {text}") from None


def raceway_of(ring: RingContacts[BallBearing]) -> Raceway:
    """The groove of one ring around a ball."""
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
    """The raceway of one ring and a roller on it."""
    radii = ring.radii
    return RollerRaceway(radii.element_x, abs(radii.ring_x), outer=not ring.inner)


def around_ball(contact: BallContact, nodes: tuple[Array, Array], thickness: Array) -> tuple[float, float]:
    """Capacitance in vacuum outside the film of a ball.

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
    capacitance, mismatch : float
        [F], and the largest relative difference of the gaps at the edge of the film's domain.
    """
    raceway, modulus = raceway_of(contact.ring), contact.ring.conditions.modulus
    x, y = np.meshgrid(*nodes, indexing="ij")
    rim = np.ones_like(thickness, dtype=bool)
    rim[1:-1, 1:-1] = False
    matched = match_film(raceway, contact.dry, modulus, x=x[rim], y=y[rim], thickness=thickness[rim])
    domain = float(nodes[0][0]), float(nodes[0][-1]), float(nodes[1][-1])
    return outside_capacitance(raceway, matched, domain), matched.mismatch


def around_roller(ring: RingContacts[RollerBearing], half_width: float, x: Array, thickness: Array) -> float:
    """Capacitance in vacuum outside the film of a roller.

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
        [F].
    """
    ends = (float(x[0]), float(x[-1])), (float(thickness[0]), float(thickness[-1]))
    tails = roller_tails(_roller_raceway(ring), half_width, *ends)
    return ring.conditions.geometry.roller_length * sum(tails)


def rigid_ball(ring: RingContacts[BallBearing], gap: float) -> float:
    """Capacitance in vacuum [F] of a ball and its groove, rigid and a gap [m] apart."""
    return groove_capacitance(raceway_of(ring), gap)


def rigid_roller(ring: RingContacts[RollerBearing], gap: float) -> float:
    """Capacitance in vacuum [F] of a roller and its raceway, rigid and a gap [m] apart."""
    return ring.conditions.geometry.roller_length * roller_capacitance(_roller_raceway(ring), gap)
