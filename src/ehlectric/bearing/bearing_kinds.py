"""Table of the kinds of bearings, with the functions that differ between them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ehlectric.arrays import Numbers
from ehlectric.bearing.loads.ball_loads import ball_equilibrium, check_ball_loads
from ehlectric.bearing.loads.four_point_loads import four_point_equilibrium
from ehlectric.bearing.loads.geometry import (
    SINGLE_ROW,
    BallBearing,
    FourPointBearing,
    Geometry,
    RollerBearing,
    Rows,
    ThrustBallBearing,
)
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.roller_loads import check_roller_loads, roller_equilibrium
from ehlectric.bearing.loads.thrust_balls import check_thrust_loads, thrust_ball_equilibrium
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.ring_contacts import (
    BallContact,
    RingContacts,
    RollerContact,
    rigid_ball,
    rigid_roller,
)
from ehlectric.cases.bearing_inputs import Bearing

G = TypeVar("G", bound=Geometry)
C = TypeVar("C", BallContact, RollerContact)


@dataclass(frozen=True)
class Kind(Generic[G, C]):
    """Functions of a solution that differ between bearings with balls and with rollers."""

    geometry: Callable[[Bearing], G]  # table ``[bearing]`` -> internal geometry
    # Refuses single loads on a bearing that it cannot carry.
    check: Callable[[G, Operation], None]
    # Geometry, operation, reduced modulus [Pa] and density of the elements [kg/m^3] -> loads of all elements.
    equilibrium: Callable[[G, Operation, float, float], Equilibrium]
    contact: Callable[[RingContacts[G], Numbers], C]  # contacts with a ring and load [N] -> contact
    # Contacts with a ring and gaps [m] -> capacitances in vacuum [F] of rigid elements and the raceway.
    rigid_capacitance: Callable[[RingContacts[G], Numbers], Numbers]
    loads: int  # number of loads that are solved for each ring, without loads of light elements
    # Exponents of the load in the Hertz pressure and in the semi-axes along and across the rolling direction.
    dry_exponents: tuple[float, float, float]


def _groove_sizes(bearing: Bearing) -> tuple[int, float, float, float, float]:
    assert bearing.inner_groove is not None and bearing.outer_groove is not None
    balls = bearing.elements, bearing.element_diameter, bearing.pitch_diameter
    return *balls, bearing.inner_groove, bearing.outer_groove


def _rows(bearing: Bearing) -> Rows:
    """Rows of a bearing, or of a pair with its preload or play."""
    if bearing.pair is None:
        return SINGLE_ROW
    preload, play = bearing.pair.preload, bearing.pair.axial_clearance
    return Rows(2, 0.0 if preload is None else preload, 0.0 if play is None else play)


def _ball_geometry(bearing: Bearing) -> BallBearing:
    return BallBearing(
        *_groove_sizes(bearing),
        radial_clearance=bearing.radial_clearance,
        contact_angle=bearing.contact_angle,
        rows=_rows(bearing),
    )


def _four_point_geometry(bearing: Bearing) -> FourPointBearing:
    assert bearing.radial_clearance is not None and bearing.contact_angle is not None
    sizes = _groove_sizes(bearing)
    return FourPointBearing(
        *sizes, radial_clearance=bearing.radial_clearance, contact_angle=bearing.contact_angle
    )


def _thrust_ball_geometry(bearing: Bearing) -> ThrustBallBearing:
    return ThrustBallBearing(*_groove_sizes(bearing))


def _roller_geometry(bearing: Bearing, angle: Numbers | None = None) -> RollerBearing:
    assert bearing.roller_length is not None and bearing.profile is not None
    inclined = bearing.contact_angle if angle is None else angle
    return RollerBearing(
        bearing.elements,
        bearing.element_diameter,
        bearing.pitch_diameter,
        bearing.roller_length,
        # Inclined rollers have the preload or the play of a pair instead.
        0.0 if bearing.radial_clearance is None else bearing.radial_clearance,
        bearing.profile,
        0.0 if inclined is None else inclined,
        _rows(bearing),
    )


# Common properties of bearings with balls, and of bearings with rollers.
_OF_BALLS: dict[str, Any] = {
    "contact": BallContact,
    "rigid_capacitance": rigid_ball,
    "loads": 5,
    "dry_exponents": (1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0),
}
_OF_ROLLERS: dict[str, Any] = {
    "check": check_roller_loads,
    "equilibrium": roller_equilibrium,
    "contact": RollerContact,
    "rigid_capacitance": rigid_roller,
    "loads": 10,
    "dry_exponents": (0.5, 0.5, 0.0),
}
_RADIAL_BALLS = Kind(
    geometry=_ball_geometry, check=check_ball_loads, equilibrium=ball_equilibrium, **_OF_BALLS
)
_RADIAL_ROLLERS = Kind(geometry=_roller_geometry, **_OF_ROLLERS)

# Kinds of bearings by ``bearing.kind`` of a bearing file.
KINDS: dict[str, Kind[Any, Any]] = {
    "deep-groove ball": _RADIAL_BALLS,
    "angular-contact ball": _RADIAL_BALLS,
    "four-point contact ball": Kind(
        geometry=_four_point_geometry,
        check=check_ball_loads,
        equilibrium=four_point_equilibrium,
        **_OF_BALLS,
    ),
    "thrust ball": Kind(
        geometry=_thrust_ball_geometry,
        check=check_thrust_loads,
        equilibrium=thrust_ball_equilibrium,
        **_OF_BALLS,
    ),
    "cylindrical roller": _RADIAL_ROLLERS,
    "needle roller": _RADIAL_ROLLERS,
    "tapered roller": _RADIAL_ROLLERS,
    "thrust needle roller": Kind(
        geometry=lambda bearing: _roller_geometry(bearing, 0.5 * math.pi), **_OF_ROLLERS
    ),
}


def kind_of(ring: RingContacts[Any]) -> Kind[Any, Any]:
    """Kind of the bearing of a ring."""
    return KINDS[ring.conditions.bearing.kind]
