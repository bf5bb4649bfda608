"""Table of the kinds of bearings, with the functions that differ between balls and rollers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ehlectric.arrays import Numbers
from ehlectric.bearing.loads.ball_loads import ball_equilibrium
from ehlectric.bearing.loads.geometry import BallBearing, RollerBearing
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.roller_loads import roller_equilibrium
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.ring_contacts import (
    BallContact,
    RingContacts,
    RollerContact,
    rigid_ball,
    rigid_roller,
)
from ehlectric.cases.bearing_inputs import ANGULAR, ROLLERS, Bearing

G = TypeVar("G", BallBearing, RollerBearing)
C = TypeVar("C", BallContact, RollerContact)


@dataclass(frozen=True)
class Kind(Generic[G, C]):
    """Functions of a solution that differ between bearings with balls and with rollers."""

    geometry: Callable[[Bearing], G]  # table ``[bearing]`` -> internal geometry
    # Geometry, operation, reduced modulus [Pa] and density of the elements [kg/m^3] -> loads of all elements.
    equilibrium: Callable[[G, Operation, float, float], Equilibrium]
    contact: Callable[[RingContacts[G], Numbers], C]  # contacts with a ring and load [N] -> contact
    # Contacts with a ring and gaps [m] -> capacitances in vacuum [F] of rigid elements and the raceway.
    rigid_capacitance: Callable[[RingContacts[G], Numbers], Numbers]
    loads: int  # number of loads that are solved for each ring, without those of light elements
    # Exponents of the load in the Hertz pressure and in the semi-axes along and across the rolling direction.
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
    rigid_capacitance=rigid_ball,
    loads=5,
    dry_exponents=(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0),
)
_ROLLERS = Kind[RollerBearing, RollerContact](
    geometry=_roller_geometry,
    equilibrium=roller_equilibrium,
    contact=RollerContact,
    rigid_capacitance=rigid_roller,
    loads=10,
    dry_exponents=(0.5, 0.5, 0.0),
)

# Kinds of bearings by ``bearing.kind`` of a bearing file.
KINDS: dict[str, Kind[Any, Any]] = {"deep-groove ball": _BALLS, ANGULAR: _BALLS, ROLLERS: _ROLLERS}


def kind_of(ring: RingContacts[Any]) -> Kind[Any, Any]:
    """Kind of the bearing of a ring."""
    return KINDS[ring.conditions.bearing.kind]
