"""Contacts of a bearing's elements with one ring: as formulas take them, and the gap around their films."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.gaps.groove import Raceway, groove_capacitance, match_film, outside_capacitance
from ehlectric.bearing.gaps.roller import RollerRace, roller_capacitance, roller_tails
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.cases.bearing import Bearing
from ehlectric.cases.lubricant import effective_alpha
from ehlectric.errors import InputError
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz_point import dry_contact


@dataclass(frozen=True)
class Race:
    """The contacts of all elements with one ring: all but the load.

    Attributes
    ----------
    inner : bool
        Which ring.
    angle : float
        Contact angle that the radii are taken at [rad].
    speed : float
        Entrainment speed [m/s], the film factor in it.
    """

    inner: bool
    angle: float
    speed: float

    @property
    def ring(self) -> str:
        """The ring's name."""
        return "inner" if self.inner else "outer"


@contextmanager
def of_contact(race: Race, load: float) -> Iterator[None]:
    """Errors of a contact at a load [N], whose case nobody wrote, as those of the bearing.

    Examples
    --------
    >>> with of_contact(Race(inner=True, angle=0.0, speed=1.0), 800.0):
    ...     raise InputError("contact", "the dry contact would be too wide")
    Traceback (most recent call last):
        ...
    ehlectric.errors.InputError: bearing: inner contact at 800 N: the dry contact would be too wide
    """
    try:
        yield
    except InputError as error:
        table = (error.key or "").partition(".")[0]
        if table not in ("contact", "contact_angle", "grid"):
            raise
        text = error.text if error.key == "contact" else str(error)
        raise error.retold("bearing", f"{race.ring} contact at {load:.4g} N: {text}") from None


def point_contact(duty: BearingDuty, race: Race, load: float) -> PointContact:
    """A ball's contact at a load [N]."""
    radii = duty.radii(race.angle, inner=race.inner)
    oil = duty.lubricant
    return PointContact(
        radii.radius_x, radii.radius_y, duty.modulus, load, race.speed, oil.viscosity, effective_alpha(oil)
    )


def line_contact(duty: BearingDuty, race: Race, load: float) -> LineContact:
    """A roller's contact at a load [N]."""
    assert isinstance(duty.geometry, RollerBearing)
    radius, oil = duty.radii(race.angle, inner=race.inner).radius_x, duty.lubricant
    width = load / duty.geometry.roller_length
    return LineContact(radius, duty.modulus, width, race.speed, oil.viscosity, effective_alpha(oil))


def raceway_of(bearing: Bearing, race: Race) -> Raceway:
    """The groove of one ring around a ball."""
    groove = bearing.inner_groove if race.inner else bearing.outer_groove
    assert groove is not None and bearing.shoulder_height is not None
    return Raceway.of(
        bearing.element_diameter,
        bearing.pitch_diameter,
        groove,
        bearing.shoulder_height,
        outer=not race.inner,
        contact_angle=race.angle,
    )


def _roller_race(duty: BearingDuty, race: Race) -> RollerRace:
    """The raceway of one ring and a roller on it."""
    radii = duty.radii(race.angle, inner=race.inner)
    return RollerRace(radii.element_x, abs(radii.ring_x), outer=not race.inner)


def around_ball(
    bearing: Bearing, contact: PointContact, race: Race, nodes: tuple[Array, Array], thickness: Array
) -> tuple[float, float]:
    """Capacitance in vacuum outside the film of a ball.

    Parameters
    ----------
    bearing, race : Bearing and Race
        Where the ball is.
    contact : PointContact
        Its contact.
    nodes : tuple of ndarray, shapes (nx,), (ny,)
        Nodes of the film along and across entrainment [m].
    thickness : ndarray, shape (nx, ny)
        Film thickness [m].

    Returns
    -------
    capacitance, mismatch : float
        [F], and the largest relative difference of the gaps at the edge of the film's domain.
    """
    raceway = raceway_of(bearing, race)
    x, y = np.meshgrid(*nodes, indexing="ij")
    rim = np.ones_like(thickness, dtype=bool)
    rim[1:-1, 1:-1] = False
    modulus = contact.reduced_modulus
    dry = dry_contact(contact.load, contact.radius_x, contact.radius_y, modulus)
    matched = match_film(raceway, dry, modulus, x=x[rim], y=y[rim], thickness=thickness[rim])
    domain = float(nodes[0][0]), float(nodes[0][-1]), float(nodes[1][-1])
    return outside_capacitance(raceway, matched, domain), matched.mismatch


def around_roller(duty: BearingDuty, race: Race, half_width: float, x: Array, thickness: Array) -> float:
    """Capacitance in vacuum outside the film of a roller [F].

    Parameters
    ----------
    duty, race : BearingDuty and Race
        Where the roller is.
    half_width : float
        Of the dry contact [m].
    x, thickness : ndarray, shape (nx,)
        Nodes of the film and its thickness [m].
    """
    assert isinstance(duty.geometry, RollerBearing)
    ends = (float(x[0]), float(x[-1])), (float(thickness[0]), float(thickness[-1]))
    return duty.geometry.roller_length * sum(roller_tails(_roller_race(duty, race), half_width, *ends))


def rigid_capacitance(bearing: Bearing, duty: BearingDuty, race: Race, gap: float) -> float:
    """Capacitance in vacuum of an element and its raceway, rigid and a gap apart [F]."""
    if isinstance(duty.geometry, RollerBearing):
        return duty.geometry.roller_length * roller_capacitance(_roller_race(duty, race), gap)
    return groove_capacitance(raceway_of(bearing, race), gap)
