"""Table of the kinds of bearings: the steps that balls and rollers take each in their own way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ehlectric.bearing.by_formula import ball_by_formula, roller_by_formula
from ehlectric.bearing.contacts import ContactSolution, ball_case, roller_case, solve_ball, solve_roller
from ehlectric.bearing.domain import ball_fits, roller_fits
from ehlectric.bearing.loads.balls import ball_equilibrium
from ehlectric.bearing.loads.geometry import BallBearing, RollerBearing
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.rollers import roller_equilibrium
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.ring_contacts import (
    BallContact,
    RingContacts,
    RollerContact,
    rigid_ball,
    rigid_roller,
)
from ehlectric.cases.bearing import ANGULAR, ROLLERS, Bearing
from ehlectric.cases.case import Case

G = TypeVar("G", BallBearing, RollerBearing)
C = TypeVar("C", BallContact, RollerContact)


@dataclass(frozen=True)
class Kind(Generic[G, C]):
    """Steps of a solution that differ between bearings with balls and with rollers.

    Attributes
    ----------
    geometry : callable
        Internal geometry of the table of a bearing file.
    equilibrium : callable
        Loads of all elements of a geometry in an operation, with the reduced modulus [Pa] and the density of
        the elements [kg/m^3].
    contact : callable
        Contact of an element with a ring at a load [N].
    case : callable
        Case of a contact, with the table ``[solver]`` of the bearing file.
    solve, by_formula : callable
        Solution of a contact, of its film and field with the table ``[solver]``, or of film formulas.
    fits : callable
        Whether the domain holds the length over which a contact's film builds up.
    rigid_capacitance : callable
        Capacitance in vacuum [F] of an element and its raceway, rigid and a gap [m] apart.
    film_exponent : float
        Exponent of the entrainment product in the film thickness.
    dry_exponents : tuple of float
        Exponents of the load in the Hertz pressure and in the semi-axes along and across the rolling.
    """

    geometry: Callable[[Bearing], G]
    equilibrium: Callable[[G, Operation, float, float], Equilibrium]
    contact: Callable[[RingContacts[G], float], C]
    case: Callable[[C, dict[str, Any]], Case]
    solve: Callable[[C, dict[str, Any]], ContactSolution]
    by_formula: Callable[[C], ContactSolution]
    fits: Callable[[C], bool]
    rigid_capacitance: Callable[[RingContacts[G], float], float]
    film_exponent: float
    dry_exponents: tuple[float, float, float]


def _ball_geometry(bearing: Bearing) -> BallBearing:
    assert bearing.inner_groove is not None and bearing.outer_groove is not None
    return BallBearing(
        bearing.elements,
        bearing.element_diameter,
        bearing.pitch_diameter,
        bearing.inner_groove,
        bearing.outer_groove,
        bearing.radial_clearance,
        bearing.contact_angle,
    )


def _roller_geometry(bearing: Bearing) -> RollerBearing:
    assert bearing.roller_length is not None and bearing.radial_clearance is not None
    assert bearing.profile is not None
    return RollerBearing(
        bearing.elements,
        bearing.element_diameter,
        bearing.pitch_diameter,
        bearing.roller_length,
        bearing.radial_clearance,
        bearing.profile,
    )


_BALLS = Kind[BallBearing, BallContact](
    geometry=_ball_geometry,
    equilibrium=ball_equilibrium,
    contact=BallContact,
    case=ball_case,
    solve=solve_ball,
    by_formula=ball_by_formula,
    fits=ball_fits,
    rigid_capacitance=rigid_ball,
    # Hamrock and Dowson, of points.
    film_exponent=0.67,
    dry_exponents=(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0),
)
_ROLLERS = Kind[RollerBearing, RollerContact](
    geometry=_roller_geometry,
    equilibrium=roller_equilibrium,
    contact=RollerContact,
    case=roller_case,
    solve=solve_roller,
    by_formula=roller_by_formula,
    fits=roller_fits,
    rigid_capacitance=rigid_roller,
    # Dowson and Toyoda, of lines.
    film_exponent=0.69,
    dry_exponents=(0.5, 0.5, 0.0),
)

# By bearing.kind of a bearing file.
KINDS: dict[str, Kind[Any, Any]] = {"deep-groove ball": _BALLS, ANGULAR: _BALLS, ROLLERS: _ROLLERS}


def kind_of(ring: RingContacts[Any]) -> Kind[Any, Any]:
    """Kind of the bearing that a ring is of."""
    return KINDS[ring.conditions.bearing.kind]
