"""A bearing before its contacts are solved: conditions, equilibria, and the loads to solve."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.bearing.by_formula import check_formula
from ehlectric.bearing.conditions import BearingConditions, Solid
from ehlectric.bearing.kinds import KINDS, kind_of
from ehlectric.bearing.limits import check_film, check_load, check_shoulders
from ehlectric.bearing.loads.geometry import Geometry
from ehlectric.bearing.loads.kinematics import rolling_speeds
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.lubricant import Lubricant
from ehlectric.errors import InputError
from ehlectric.formulas.hertz_line import reduced_modulus
from ehlectric.lubricant.temperature import inlet_shear_factor

# Loads of each ring that are solved, but for those of light elements, and the least of them over the largest.
LOADS, _LEAST = 6, 0.02

# The least load over the largest: below it films hardly change any more what a bearing's circuit sees.
_LIGHTEST = 0.002

# Loads between that one and the six: about one for each of these ratios, up to six. They crowd at the light
# end, where the film of rigid bodies, which goes with 1/Q, turns into that of bodies that deform: a power of
# their number, since halving the distance there is worth more than elsewhere.
_BETWEEN, _MOST_BETWEEN, _CROWDED = 1.5, 6, 1.5

# Loads closer than this ratio are one.
_ALIKE = 1.001


@dataclass(frozen=True)
class PreparedBearing:
    """A bearing whose contacts are not solved yet.

    Attributes
    ----------
    conditions : BearingConditions
        Geometry, materials, oil and strength.
    equilibria : tuple of BallEquilibrium or RollerEquilibrium
        One for each position of the cage, the first with an element on the load line.
    inner, outer : RingContacts
        Contacts with both rings.
    """

    conditions: BearingConditions[Any]
    equilibria: tuple[Equilibrium, ...]
    inner: RingContacts[Any]
    outer: RingContacts[Any]

    @property
    def rings(self) -> tuple[RingContacts[Any], RingContacts[Any]]:
        """Contacts with the inner and with the outer ring."""
        return self.inner, self.outer


def resolve_bearing(case: BearingCase) -> BearingConditions[Any]:
    """Conditions of a bearing file: its geometry, and materials, oil and strength at its temperature.

    Raises
    ------
    InputError
        Where the elements do not fit, or the oil or its strength are not known at the temperature.
    """
    bearing, kind = case.bearing, KINDS[case.bearing.kind]
    element, ring = Solid.of(bearing.element_material), Solid.of(bearing.ring_material)
    lubricant = case.lubricant.at(bearing.temperature)
    with _keys_of_bearing():
        geometry = kind.geometry(bearing)
    factor = _film_factor(case, geometry, lubricant)
    return BearingConditions(
        bearing=bearing,
        geometry=geometry,
        element=element,
        ring=ring,
        modulus=reduced_modulus(element.compliance, ring.compliance),
        lubricant=lubricant,
        discharge=case.discharge.at(bearing.temperature),
        film_factor=factor,
        entrainment_factor=factor ** (1.0 / kind.film_exponent),
    )


@contextmanager
def _keys_of_bearing() -> Iterator[None]:
    """Errors of geometry and loads, which name a key, with the table of it."""
    try:
        yield
    except InputError as error:
        raise error.under("bearing") from None


def _film_factor(case: BearingCase, geometry: Geometry, lubricant: Lubricant) -> float:
    """Part of the isothermal film, of what the file says."""
    given = case.bearing.film_factor
    if isinstance(given, float):
        return given
    if given == "none":
        return 1.0
    oil = case.lubricant.temperature
    assert oil is not None and oil.thermal_conductivity is not None
    bearing = case.bearing
    # The speed of pure rolling at the free contact angle: it hardly changes with the loaded one.
    speeds = rolling_speeds(
        bearing.element_diameter,
        bearing.pitch_diameter,
        bearing.inner_speed,
        contact_angle=geometry.free_angle,
    )
    slope = case.lubricant.walther().slope(case.bearing.temperature) + oil.expansion
    return inlet_shear_factor(
        lubricant.viscosity, slope, float(speeds.inner_entrainment), oil.thermal_conductivity
    )


def equilibria_of(conditions: BearingConditions[Any], positions: int) -> tuple[Equilibrium, ...]:
    """Equilibrium at positions of the cage over a pitch, the first with an element on the load line."""
    bearing, kind = conditions.bearing, KINDS[conditions.bearing.kind]
    pitch = 2.0 * math.pi / bearing.elements
    with _keys_of_bearing():
        operations = [
            Operation(bearing.radial_load, bearing.axial_load, bearing.inner_speed, cage_angle=angle)
            for angle in pitch * np.arange(positions) / positions
        ]
        given = conditions.modulus, conditions.element.density
        return tuple(kind.equilibrium(conditions.geometry, operation, *given) for operation in operations)


def prepare_bearing(case: BearingCase, positions: int) -> PreparedBearing:
    """Conditions and equilibria of a bearing at positions of its cage, and the contacts with both rings.

    Raises
    ------
    InputError
        Where the bearing cannot carry its load, or is beyond the limits of the model.
    """
    conditions = resolve_bearing(case)
    if case.contacts == "formula":
        check_formula(conditions.discharge, conditions.lubricant)
    check_load(conditions)
    equilibria = equilibria_of(conditions, positions)
    for at in equilibria:
        check_shoulders(conditions.bearing, at)
    inner, outer = (_ring_contacts(conditions, equilibria[0], inner=inner) for inner in (True, False))
    prepared = PreparedBearing(conditions, equilibria, inner, outer)
    for ring in prepared.rings:
        check_film(kind_of(ring).contact(ring, largest_load(prepared, ring)))
    return prepared


def _ring_contacts(conditions: BearingConditions[Any], at: Equilibrium, *, inner: bool) -> RingContacts[Any]:
    """The contacts with one ring, their radii at the contact angle of the most loaded one."""
    most, ring = int(np.argmax(at.inner_load)), at.ring(inner=inner)
    speed = float(ring.entrainment_speed[most]) * conditions.entrainment_factor
    return RingContacts(conditions, inner, float(ring.angle[most]), speed)


def largest_load(prepared: PreparedBearing, ring: RingContacts[Any]) -> float:
    """Load of the most loaded contact with a ring [N], cage at its first position."""
    return float(np.max(prepared.equilibria[0].ring(inner=ring.inner).load))


def least_load(ring: RingContacts[Any]) -> float:
    """Load [N] below which a contact's film builds up over more than its domain can hold, to a third.

    Lighter contacts have thicker films than this one's, so that its voltage is a lower bound of theirs.
    """
    kind = kind_of(ring)
    for load in np.geomspace(1e-6, 1e6, 121):
        if kind.fits(kind.contact(ring, float(load))):
            return float(load)
    return math.inf


def loads_to_solve(prepared: PreparedBearing, ring: RingContacts[Any]) -> list[float]:
    """Loads of a ring's contacts to solve [N]: evenly in their logarithm, and lighter ones below them."""
    all_loads = np.concatenate([at.ring(inner=ring.inner).load for at in prepared.equilibria])
    largest = float(np.max(all_loads))
    least = float(np.min(all_loads[all_loads >= _LEAST * largest]))
    loads = np.geomspace(least, largest, LOADS) if largest / least > _ALIKE else np.array([largest])
    # Elements that their centrifugal force alone presses outward have a film of their own.
    light = all_loads[(all_loads > 0.0) & (all_loads < _LEAST * largest)]
    lightest = least_load(ring)
    own = max(float(np.min(light)), _LIGHTEST * largest, lightest) if light.size else math.inf
    return [*_lighter(own, float(loads[0])), *(float(load) for load in loads)]


def _lighter(own: float, least: float) -> list[float]:
    """Loads [N] from that of light elements up to the least of the others; none where they are close."""
    if own >= 0.5 * least:
        return []
    ratio = math.log(least / own)
    number = 1 + min(_MOST_BETWEEN, int(ratio / math.log(_BETWEEN)))
    return [own * math.exp(ratio * (k / number) ** _CROWDED) for k in range(number)]
