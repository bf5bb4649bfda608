"""Bearing before its contacts are solved: equilibria, limits of the model, and the loads to solve."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers, as_float
from ehlectric.bearing.bearing_kinds import KINDS, kind_of
from ehlectric.bearing.conditions import BearingConditions, RingConditions, Solid
from ehlectric.bearing.film_factor import factors_of
from ehlectric.bearing.loads.geometry import Geometry
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.totals import Equilibrium, check_balance, mirrored
from ehlectric.bearing.mounted_clearance import mounted_clearance
from ehlectric.bearing.quick_contacts import check_quick, is_quick
from ehlectric.bearing.ring_contacts import BallContact, Contact, RingContacts
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.constants import GRAVITY
from ehlectric.errors import InputError
from ehlectric.formulas.hertz import reduced_modulus
from ehlectric.lubricant.law import is_many, same
from ehlectric.lubricant.oil import BoundLaw, OfDensity, Oil
from ehlectric.readable import readable

# Contacts with less than this part of the largest load may have their centre beyond the shoulder.
_LIGHT = 0.02

# Part of the clearance, or of the elastic approach of preloaded elements, that films may take up without a
# warning.
TAKEN = 1.0 / 3.0


def too_light(conditions: BearingConditions[Geometry]) -> Mask:
    """Whether loads are below the weight of one element, which the equilibrium neglects, shape (...)."""
    bearing = conditions.bearing
    return np.asarray(np.hypot(bearing.radial_load, bearing.axial_load) < element_weight(conditions))


def element_weight(conditions: BearingConditions[Geometry]) -> Numbers:
    """Weight of one element [N]."""
    return conditions.geometry.element_mass(conditions.element.density) * GRAVITY


def check_load(conditions: BearingConditions[Geometry]) -> None:
    """Refuse a load of a single bearing below the weight of one element, because the equilibrium neglects
    weights. Raises InputError where the load is too small; the message states the weight.
    """
    bearing = conditions.bearing
    if too_light(conditions):
        weight = element_weight(conditions)
        raise InputError(
            "bearing.radial_load",
            got=f"{bearing.radial_load:g} N, with {bearing.axial_load:g} N axial;",
            takes=f"more than {readable(float(weight), 2)} N, the weight of an element, which is neglected",
        )


def shoulder_angle(bearing: Bearing, *, inner: bool) -> Numbers:
    """Angle from the bottom of a ball's groove to its shoulder, arccos(1 - H/f), shape (...) [rad].

    H is the height of the shoulder over the diameter of the ball, and f the osculation. The angle is infinite
    for a cylindrical raceway, which has no shoulder.

    Examples
    --------
    Inner ring of a 6208, in degrees:

    >>> bearing = Bearing.from_dict(
    ...     {
    ...         "base": "6208", "radial_clearance": 1e-5, "radial_load": 1000.0, "inner_speed": 300.0,
    ...         "temperature": 343.15, "composite_rq": 3e-8,
    ...     }
    ... )
    >>> round(math.degrees(shoulder_angle(bearing, inner=True)), 1)
    50.6
    """
    if bearing.shoulder_height is None:
        return math.inf
    return as_float(np.arccos(1.0 - bearing.shoulder_height / groove_ratio(bearing, inner=inner)))


def groove_ratio(bearing: Bearing, *, inner: bool) -> Numbers:
    """Osculation f: groove radius over ball diameter, shape (...); infinite for a cylinder."""
    groove = bearing.inner_groove if inner else bearing.outer_groove
    return math.inf if groove is None else groove


def furthest_angle(geometry: Geometry, at: Equilibrium, *, inner: bool) -> Numbers:
    """Largest angle from the bottom of the groove of the contacts with a ring that are not light, shape (...)
    [rad].
    """
    ring = at.ring(inner=inner)
    loaded = ring.load > _LIGHT * np.max(ring.load, axis=-1, keepdims=True)
    aside = np.abs(ring.angle - geometry.bottom_angle)
    return as_float(np.max(aside, axis=-1, where=loaded, initial=0.0))


def beyond_shoulders(conditions: BearingConditions[Any], at: Equilibrium) -> Mask:
    """Whether the centre of a contact that is not light is beyond the shoulder of its groove, shape (...)."""
    bearing, geometry = conditions.bearing, conditions.geometry
    inner, outer = (
        furthest_angle(geometry, at, inner=inner) >= shoulder_angle(bearing, inner=inner)
        for inner in (True, False)
    )
    return np.asarray(inner | outer)


def check_shoulders(conditions: BearingConditions[Any], equilibria: tuple[Equilibrium, ...]) -> None:
    """Refuse ball contacts of a single bearing outside the groove. Raises InputError where the centre of a
    contact is beyond the shoulder. Its text has no angle of a contact, so that the points of a sweep have one
    reason; ``got`` contains the largest angle.
    """
    bearing, geometry = conditions.bearing, conditions.geometry
    for name, inner in (("inner", True), ("outer", False)):
        furthest = max(furthest_angle(geometry, at, inner=inner) for at in equilibria)
        end = shoulder_angle(bearing, inner=inner)
        if furthest >= end:
            height, degrees = f"{bearing.shoulder_height:g}", math.degrees(end)
            *others, last = "a higher shoulder", *_within_shoulders(conditions, len(equilibria))
            remedies = " or ".join(filter(None, [", ".join(others), last]))
            raise InputError.worded(
                "bearing.shoulder_height",
                f"got {height}, with which the {name} groove ends {degrees:.1f} deg up, and a contact is "
                f"further up; expected {remedies}",
                got=f"{height}, an {name} groove that ends {degrees:.1f} deg up, and a contact "
                f"{math.degrees(furthest):.1f} deg up",
                takes=remedies,
            )


# Parts of a value to which a remedy may reduce it, and parts of the load by which an axial load may rise.
_REDUCED, _ADDED = (0.9, 0.75, 0.5, 0.25), (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)


def _within_shoulders(conditions: BearingConditions[Any], positions: int) -> list[str]:
    """Changes that keep the contacts of a bearing within its grooves, computed for several sizes of each.

    The centrifugal force raises inner contact angles, and most at small axial loads; at low speeds an axial
    load raises the angles with both rings. Less axial load, which may take the load off balls, is a remedy
    only where more of it is none.
    """
    bearing = conditions.bearing
    load = math.hypot(bearing.radial_load, bearing.axial_load)
    tried = {
        "more axial load": [("axial_load", bearing.axial_load + part * load) for part in _ADDED],
        "less axial load": [("axial_load", part * bearing.axial_load) for part in _REDUCED],
        "less radial load": [("radial_load", part * bearing.radial_load) for part in _REDUCED],
        "a lower speed": [("inner_speed", part * bearing.inner_speed) for part in _REDUCED],
    }
    if bearing.contact_angle is not None:
        tried["a smaller contact angle"] = [
            ("contact_angle", part * bearing.contact_angle) for part in _REDUCED
        ]
    # Each entry changes one quantity; its other quantities are unchanged.
    changes = [change for sizes in tried.values() for change in sizes]
    arrays = {
        name: np.array([value if key == name else getattr(bearing, name) for key, value in changes])
        for name in dict(changes)
    }
    changed = bearing.model_copy(update=arrays)
    running = {} if conditions.clearance is None else {"radial_clearance": conditions.geometry.clearance}
    geometry = KINDS[bearing.kind].geometry(changed.model_copy(update=running))
    many = replace(conditions, bearing=changed, geometry=geometry)
    refused = np.zeros(len(changes), dtype=bool)
    for at in equilibria_of(many, positions):
        refused |= np.logical_not(at.balanced) | beyond_shoulders(many, at)
    names = (name for name, sizes in tried.items() for _ in sizes)
    helpful = list(dict.fromkeys(name for name, no in zip(names, refused, strict=True) if not no))
    return [name for name in helpful if name != "less axial load" or "more axial load" not in helpful]


def too_thick(contact: Contact) -> Mask:
    """Whether films are too thick for the space between element and raceway, or unknown."""
    return np.asarray(np.logical_not(contact.film <= contact.thickest_film))


def check_film(contact: Contact) -> None:
    """Refuse films that are too thick for the space between element and raceway. Raises InputError where the
    film of a ball is thicker than a tenth of (f - 1/2) D, or the film of a roller builds up over more than a
    tenth of its radius.
    """
    film, most, ring = contact.film, contact.thickest_film, contact.ring
    if too_thick(contact):
        oil, load, speed = float(ring.oil.viscosity), float(contact.load), float(ring.speed)
        raise InputError(
            "bearing",
            got=f"an {ring.name} film of {readable(float(1e6 * film))} um, at {readable(load)} N, "
            f"{readable(speed)} m/s and {readable(oil)} Pa s; the bodies have room for at most "
            f"{readable(float(1e6 * most))} um",
            takes="a thinner film; raise the load or the temperature, or reduce the speed or the viscosity",
        )


# Least load over the largest of those that are not the loads of light elements.
_LEAST = 0.02

# Number of loads down to it whose contacts come from the atlas or from formulas, and number of light loads
# below the others. They are fewer in a coarse bearing, whose ratios of margins are within 1e-4.
_QUICK_LOADS, _COARSE_LOADS = 16, 6
_QUICK_LIGHT, _COARSE_LIGHT = 10, 5

# Least load that is solved over the largest. Lighter contacts have the trend of a formula.
_LIGHTEST = 0.002

# Light contacts that are solved: at most so many, and about one for each of these ratios of their loads.
_SOLVED_LIGHT, _BETWEEN = 5, 1.5

# Exponent of the distances of light loads, which are shortest at the light end. There the film of rigid
# bodies, which is proportional to 1/Q for a roller and to 1/Q^2 for a ball, turns into the film of bodies
# that deform.
_CROWDED = 1.5

# Power of the load that is the weight of an element in the contact angle and speed of a ring's contacts.
_WEIGHT = 16

# Light loads are solved if the least one is below this part of the others.
_BELOW = 0.98

# Exponents of ten between which a load is searched [N], step at which the search ends, and most steps.
_EXPONENTS, _CLOSE, _MOST_STEPS = (-6.0, 6.0), 1e-9, 60

# Ratio of the largest to the least load below which all loads count as equal.
_ALIKE = 1.001


@dataclass(frozen=True)
class PreparedBearing:
    """Bearing with its equilibria, whose contacts are not solved yet."""

    conditions: BearingConditions[Any]  # geometry, materials, oil and strength
    # Equilibrium at each position of the cage; at the first, an element is on the load line.
    equilibria: tuple[Equilibrium, ...]
    rings: tuple[RingContacts[Any], RingContacts[Any]]  # contacts with the inner and with the outer ring

    @property
    def refused(self) -> Mask:
        """Points of many that are beyond the limits of the model, shape (...).

        ``prepare_bearing`` of the single case of such a point raises its error.
        """
        conditions = self.conditions
        refused = conditions.refused | too_light(conditions) | films_too_thick(self)
        refused = refused | np.equal(conditions.oil.alpha, 0.0)
        for at in self.equilibria:
            refused = refused | np.logical_not(at.balanced) | beyond_shoulders(conditions, at)
        return np.asarray(refused)


def resolve_bearing(case: BearingCase) -> BearingConditions[Any]:
    """Conditions of a bearing file: geometry and materials, oil and strength at its temperatures. Raises
    InputError where the elements do not fit, or the oil or its strength has no value at the temperature; of
    many points, points at which it has none are ``BearingConditions.refused``.
    """
    bearing, kind = case.bearing, KINDS[case.bearing.kind]
    element, ring = Solid.of(bearing.element_material), Solid.of(bearing.ring_material)
    with _keys_of_bearing():
        clearance = mounted_clearance(bearing)
        running = {} if clearance is None else {"radial_clearance": clearance.running.clearance}
        geometry = kind.geometry(bearing.model_copy(update=running))
    key, (first, second) = bearing.temperature_key(), _ring_temperatures(bearing)
    oil = _oil(case, bearing.oil_temperature, key)
    discharge = case.discharge.at(bearing.oil_temperature, key)
    inner = _ring_conditions(case, geometry, (oil, discharge), inner=True)
    # Rings of one temperature have the same conditions.
    alike = same(first, second)
    outer = inner if alike else _ring_conditions(case, geometry, (oil, discharge), inner=False)
    return BearingConditions(
        bearing=bearing,
        geometry=geometry,
        element=element,
        ring=ring,
        modulus=reduced_modulus(element.compliance, ring.compliance),
        oil=oil,
        discharge=discharge,
        inner=inner,
        outer=outer,
        clearance=clearance,
    )


def _ring_temperatures(bearing: Bearing) -> tuple[Numbers, Numbers]:
    """Temperatures of the inner and the outer ring [K]."""
    return bearing.ring_temperature(inner=True), bearing.ring_temperature(inner=False)


def _oil(case: BearingCase, temperature: Numbers, key: str) -> Oil:
    """Oil at a temperature [K]; the ambient pressure acts on the bodies from all sides, and is omitted."""
    oil = replace(case.lubricant.at(temperature, key), ambient_pressure=0.0)
    law = getattr(oil.permittivity, "law", None)
    if not case.shape or not isinstance(law, BoundLaw) or is_many(*law.parameters.values()):
        return oil
    # A permittivity with a pole is an error of one point, and NaN of each of many with their own values.
    parameters = {name: np.full(case.shape, value) for name, value in law.parameters.items()}
    return replace(oil, permittivity=OfDensity(replace(law, parameters=parameters)))


def _ring_conditions(
    case: BearingCase, geometry: Geometry, outside: tuple[Oil, Discharge], *, inner: bool
) -> RingConditions:
    """Conditions of the contacts with a ring, at its temperature. ``outside``, oil outside of the films and
    its discharge, which a ring of equal temperature also has.
    """
    bearing = case.bearing
    temperature, key = bearing.ring_temperature(inner=inner), bearing.temperature_key(inner=inner)
    oil, discharge = outside
    if not same(temperature, bearing.oil_temperature):
        oil, discharge = _oil(case, temperature, key), case.discharge.at(temperature, key)
    return RingConditions(temperature, oil, discharge, **factors_of(case, geometry, oil, temperature))


@contextmanager
def _keys_of_bearing() -> Iterator[None]:
    """Context in which the keys of errors about geometry and loads get their table, ``bearing``."""
    try:
        yield
    except InputError as error:
        raise error.under("bearing") from None


def equilibria_of(conditions: BearingConditions[Any], positions: int) -> tuple[Equilibrium, ...]:
    """Equilibria at evenly spaced positions of the cage over one pitch of the elements.

    At the first position an element is on the load line. The second half mirrors the first.
    """
    bearing, geometry, kind = conditions.bearing, conditions.geometry, KINDS[conditions.bearing.kind]
    duty = {name: getattr(bearing, name) for name in ("radial_load", "axial_load", "inner_speed")}
    solid = conditions.modulus, conditions.element.density
    shape = np.broadcast_shapes(*map(np.shape, (*duty.values(), *solid, *geometry.dimensions)))
    angles = 2.0 * math.pi / bearing.elements * np.arange(positions) / positions
    solved = positions // 2 + 1
    with _keys_of_bearing():
        # All positions are solved at once, along the first axis.
        cage = angles[:solved].reshape(-1, *(1 for _ in shape))
        operation = Operation(**duty, cage_angle=cage)
        if not shape:
            kind.check(geometry, operation)
        at = kind.equilibrium(geometry, operation, *solid)
        equilibria = [at.at(k) for k in range(solved)]
        for equilibrium in equilibria:
            check_balance(equilibrium)

    def turned(k: int) -> Equilibrium:
        angle = Operation(**duty, cage_angle=angles[k]).positions(bearing.elements, geometry.groups)
        return mirrored(equilibria[positions - k], angle, geometry.groups)

    return (*equilibria, *map(turned, range(solved, positions)))


def prepare_bearing(case: BearingCase, positions: int) -> PreparedBearing:
    """Conditions of a bearing, its equilibria at positions of the cage, and the contacts with both rings.

    Returns bearing whose contacts can be solved, or the bearings of many points, some of which may be
    ``refused``. Raises, for a single bearing, InputError where the bearing cannot carry its load, or is
    beyond the limits of the model; ConvergenceError where the film that ``film_factor`` "solved" needs does
    not converge.
    """
    conditions = resolve_bearing(case)
    if is_quick(case):
        check_quick(case.contacts, conditions.discharge, conditions.oil)
    if not case.shape:
        check_load(conditions)
    equilibria = equilibria_of(conditions, positions)
    if not case.shape:
        check_shoulders(conditions, equilibria)
    inner, outer = (_contacts_with(conditions, equilibria[0], inner=inner) for inner in (True, False))
    prepared = PreparedBearing(conditions, equilibria, (inner, outer))
    if case.bearing.film_factor == "solved":
        # Late: bearings of the atlas do not need it.
        from ehlectric.bearing.heated_contact import solved_contact

        factors = [solved_contact(case, ring, float(largest_load(prepared, ring))) for ring in prepared.rings]
        # The friction of a bearing is the friction of both rings, or it is not known.
        known = all(friction is not None for _, friction in factors)
        rings = zip(conditions.rings, factors, strict=True)
        return _with_rings(
            prepared,
            *(ring.heated(factor, friction if known else None) for ring, (factor, friction) in rings),
        )
    _check_films(prepared)
    return prepared


def with_film_factor(prepared: PreparedBearing, factor: float) -> PreparedBearing:
    """Bearing whose films are thinner or thicker by a factor; loads and speeds do not depend on it.

    ``factor``, film thickness divided by the isothermal, fully flooded film thickness, dimensionless, > 0,
    which contains heat and supply. Returns bearing with the same equilibria. Raises InputError where the
    films leave no room between the bodies.
    """
    rings = prepared.conditions.rings
    return _with_rings(
        prepared, *(RingConditions(ring.temperature, ring.oil, ring.discharge, factor) for ring in rings)
    )


def with_films_times(prepared: PreparedBearing, factors: Array) -> PreparedBearing:
    """Bearings whose films are ``factors`` times as thick as computed, shape (...)."""
    rings = prepared.conditions.rings
    return _with_rings(prepared, *(replace(ring, film_factor=factors * ring.film_factor) for ring in rings))


def _with_rings(prepared: PreparedBearing, *rings: RingConditions) -> PreparedBearing:
    """Bearing with other conditions of its contacts with the inner and the outer ring."""
    conditions = replace(prepared.conditions, inner=rings[0], outer=rings[1])
    inner, outer = (replace(ring, conditions=conditions) for ring in prepared.rings)
    changed = replace(prepared, conditions=conditions, rings=(inner, outer))
    _check_films(changed)
    return changed


def _check_films(prepared: PreparedBearing) -> None:
    """Refuse films of a single bearing for which there is no room between the bodies."""
    for ring in prepared.rings:
        if not ring.shape:
            check_film(kind_of(ring).contact(ring, largest_load(prepared, ring)))


def films_too_thick(prepared: PreparedBearing) -> Mask:
    """Whether the films of bearings leave no room between the bodies, shape (...)."""
    inner, outer = (
        too_thick(kind_of(ring).contact(ring, largest_load(prepared, ring))) for ring in prepared.rings
    )
    return inner | outer


def _contacts_with(conditions: BearingConditions[Any], at: Equilibrium, *, inner: bool) -> RingContacts[Any]:
    """Contacts with one ring, at the contact angle and speed of the most loaded elements.

    Both are means with a high power of the load as the weight: they have no steps if another element becomes
    the most loaded one. Angles in a second row are negative, and its grooves are mirrored ones.
    """
    ring, most = at.ring(inner=inner), np.max(at.inner_load, axis=-1, keepdims=True)
    weights = (at.inner_load / most) ** _WEIGHT
    weights = weights / np.sum(weights, axis=-1, keepdims=True)
    angle, speed = (
        as_float(np.sum(weights * values, axis=-1)) for values in (np.abs(ring.angle), ring.entrainment_speed)
    )
    return RingContacts(conditions, inner, angle, speed)


def largest_load(prepared: PreparedBearing, ring: RingContacts[Any]) -> Numbers:
    """Load of the most loaded contact with a ring [N], at the first position of the cage, shape (...)."""
    return as_float(np.max(prepared.equilibria[0].ring(inner=ring.inner).load, axis=-1))


def least_load(ring: RingContacts[Any]) -> Numbers:
    """Least load at which the domain holds the length over which the film builds up [N], shape (...).

    Lighter contacts have thicker films, so that the breakdown voltage at this load is a lower bound of
    theirs. It changes with the speed without steps. It is infinite where the domain never holds this length.
    """
    # The heavier the load, the shorter the length over which the film builds up, relative to the contact.
    return _load_where(ring, lambda contact: contact.part_needed)


def _load_where(ring: RingContacts[Any], ratio: Callable[[Contact], Numbers]) -> Numbers:
    """Load [N] from which on a ratio that falls with the load is at most 1; infinite if it always exceeds 1.

    The logarithms of both are nearly straight lines. The root is found by false position with the weights of
    N. Anderson and A. Bjorck, BIT 13 (1973) 253, doi:10.1007/BF01951936.
    """
    kind = kind_of(ring)

    def excess(exponent: Numbers) -> Array:
        return np.asarray(np.log(ratio(kind.contact(ring, 10.0**exponent))))

    ends = [excess(exponent) for exponent in _EXPONENTS]
    always, never = ends[0] <= 0.0, ~(ends[1] <= 0.0)
    sought = ~(always | never)
    low, high = (np.full(sought.shape, exponent) for exponent in _EXPONENTS)
    above, below = (np.where(sought, end, sign) for end, sign in zip(ends, (1.0, -1.0), strict=True))
    at, last = low, np.zeros(sought.shape, dtype=np.int8)
    for _ in range(_MOST_STEPS):
        before, at = at, np.where(sought, (low * below - high * above) / (below - above), at)
        sought = sought & (np.abs(at - before) > _CLOSE)
        if not np.any(sought):
            break
        value = excess(at)
        side = np.where(value > 0.0, 1, -1)
        # An end that stays for a second time gets a weight.
        weight = 1.0 - value / np.where(sought, np.where(side > 0, above, below), 1.0)
        weight = np.where(side == last, np.where(weight > 0.0, weight, 0.5), 1.0)
        low, above = np.where(side > 0, at, low), np.where(side > 0, value, weight * above)
        high, below = np.where(side > 0, high, at), np.where(side > 0, weight * below, value)
        sought, last = sought & (value != 0.0), side
    # Beyond the root, so that rounding leaves the ratio below 1.
    load = 10.0 ** np.where(always, _EXPONENTS[0], at + _CLOSE)
    return as_float(np.where(never, np.inf, load))


def loads_to_solve(
    prepared: PreparedBearing, ring: RingContacts[Any], *, quick: bool, coarse: bool = False
) -> tuple[Array, Mask]:
    """Loads of a ring's contacts to solve [N], by increasing load, and which of them are in use.

    The loads of the kind, or more for estimated contacts unless they are ``coarse``, are evenly spaced in
    their logarithm. Lighter loads come before them if any element carries less than 2 % of the largest load,
    or none. The evenly spaced loads of balls have no film that is too thick for the room between the bodies.
    All loads are continuous functions of the loads of the elements.

    Returns loads and mask, shape (..., m), or (m,) for one bearing, whose loads are all in use. Points with
    fewer loads than others have the least one of them in the places before, which are not in use.
    """
    all_loads = np.concatenate([at.ring(inner=ring.inner).load for at in prepared.equilibria], axis=-1)
    largest, smallest = np.max(all_loads, axis=-1), np.min(all_loads, axis=-1)
    least = _with_room(ring, np.maximum(smallest, _LEAST * largest))
    alike = ~(largest > _ALIKE * least)
    least = np.where(alike, largest, least)
    number = (_COARSE_LOADS if coarse else _QUICK_LOADS) if quick else kind_of(ring).loads
    loads = np.geomspace(least, largest, number, axis=-1)
    heavy = ~alike[..., np.newaxis] | (np.arange(number) == number - 1)
    lightest = np.maximum(smallest, _least_light(ring, largest, least, quick=quick))
    lighter, light = _lighter(lightest, least, (_COARSE_LIGHT if coarse else _QUICK_LIGHT) if quick else None)
    loads, used = np.concatenate([lighter, loads], axis=-1), np.concatenate([light, heavy], axis=-1)
    # Places in use last, as few as the point with the most loads has.
    most = int(np.max(np.count_nonzero(used, axis=-1)))
    order = np.argsort(used, axis=-1, kind="stable")[..., -most:]
    loads, used = np.take_along_axis(loads, order, -1), np.take_along_axis(used, order, -1)
    first = np.take_along_axis(loads, np.argmax(used, axis=-1)[..., np.newaxis], -1)
    return np.where(used, loads, first), used


def _least_light(ring: RingContacts[Any], largest: Array, least: Array, *, quick: bool) -> Array:
    """Least load at which a contact of light elements is computed [N], shape (...)."""
    if not np.any(least > _LIGHTEST * largest):
        return least
    floor = least_load(ring)
    return np.asarray(floor if quick else np.maximum(floor, _LIGHTEST * largest))


def _with_room(ring: RingContacts[Any], load: Array) -> Array:
    """Loads [N], of balls at least the least load whose film is not too thick for the room, shape (...)."""
    contact = kind_of(ring).contact(ring, load)
    # Rollers have a gap at every film, also at films that build up beyond a parabola.
    if not isinstance(contact, BallContact) or not np.any(too_thick(contact)):
        return load
    return np.maximum(load, _load_where(ring, lambda contact: contact.film / contact.thickest_film))


def _lighter(lightest: Array, least: Array, number: int | None) -> tuple[Array, Mask]:
    """Loads [N] from ``lightest`` up to below ``least``, and which of them are in use, shape (..., k).

    ``number``, number of the loads; None if it depends on the ratio of both loads. No load is in use if both
    are close. The loads in use come last.
    """
    most = _SOLVED_LIGHT if number is None else number
    some = lightest < _BELOW * least
    ratio = np.log(least / np.where(some, lightest, least))
    needed = np.minimum(most, 1.0 + np.floor(ratio / math.log(_BETWEEN))) if number is None else float(most)
    count = np.where(some, needed, 1.0)[..., np.newaxis]
    place = np.arange(most) - (most - count)
    part = np.maximum(place, 0.0) / count
    loads = np.where(some, lightest, least)[..., np.newaxis] * np.exp(ratio[..., np.newaxis] * part**_CROWDED)
    return loads, (place >= 0.0) & some[..., np.newaxis]
