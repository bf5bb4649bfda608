"""Solution of a bearing: contacts of all elements, circuits, capacitance, lambda ratio, and accuracy."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers, as_float, labels
from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.circuit import Circuit, series
from ehlectric.bearing.conditions import BearingConditions, gap_breakdown
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.quick_contacts import formula_factor, outside_atlas
from ehlectric.bearing.ring_contacts import ContactCurve, ContactSolution, ContactValues, RingContacts
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_kinds import has_rollers
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.lubrication_states import (
    BOUNDARY,
    BOUNDARY_LIMIT,
    FORMER_WORDS,
    FREQUENT,
    FULL,
    FULL_FILM_LIMIT,
    GAP,
    MIXED,
)
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runtime.display import Values, read_only_property
from ehlectric.version import __version__

# Part of a film that is left under its summits at least: no number is divided by 0 where there is no voltage.
_LEAST_PART = 1e-9

# Part of the area around the films that is filled with oil, by the name of the filling.
_PARTS = {"oil": 1.0, "air": 0.0}


@dataclass(frozen=True, eq=False, repr=False)
class RingState(Values):
    """Contacts of all n elements with one ring at one position of the cage; of many points shape (..., n)."""

    # load and gap: load of each contact [N], and distance between element and ring [m]; it is 0 where they
    # touch, shape (..., n).
    load: Array = field(metadata=stored("", "N", "not negative"))
    gap: Array = field(metadata=stored("", "m", "not negative"))
    # Whether the contact is loaded and has a solved film and field. The others are gaps between rigid bodies,
    # shape (..., n).
    solved: Mask = field(metadata=stored("", "", "0 or 1"))
    # Films, capacitances and voltages, shape (..., n). Pressure, semi-axes and plate are 0 without load.
    values: ContactValues[Array]

    @property
    def least_film(self) -> Numbers:
        """Smallest film thickness of the loaded contacts, shape (...) [m]; infinite where none is loaded."""
        films = self.values.minimum_thickness
        least: Numbers = np.min(films, axis=-1, where=self.solved, initial=np.inf)
        return least

    def capacitance(self, fill: Numbers | str) -> Array:
        """Capacitance of each contact with a filling around the film, shape (..., n) [F].

        The filling is "oil", "air", or the part of the area around the film that is filled with oil.
        """
        values, part = self.values, oil_part(fill)
        whole: Array = values.inside + part * values.outside_oil + (1.0 - part) * values.outside_air
        return whole

    def part_left(self, summits: Numbers) -> Array:
        """Gap under the highest summits over the minimum film of each contact, shape (..., n); at least
        ``_LEAST_PART``. ``summits``, their height [m], shape (...).
        """
        height = np.asarray(summits)[..., np.newaxis]
        part: Array = np.maximum(1.0 - height / self.values.minimum_thickness, _LEAST_PART)
        return part

    def oil_capacitance(self, fill: Numbers | str) -> Array:
        """Part of ``capacitance`` that is filled with oil, and leaks as it does, shape (..., n) [F]."""
        oil: Array = self.values.inside + oil_part(fill) * self.values.outside_oil
        return oil


def oil_part(fill: Numbers | str) -> Numbers:
    """Part of the area around the films that is filled with oil: 1 for "oil", 0 for "air", or a number.

    An array of numbers gets an axis for the elements.

    Examples
    --------
    >>> oil_part("oil"), oil_part("air"), oil_part(0.3)
    (1.0, 0.0, 0.3)
    """
    if isinstance(fill, str):
        return _PARTS[fill]
    return fill if np.ndim(fill) == 0 else np.asarray(fill)[..., np.newaxis]


def ring_state(
    ring: RingContacts[Any], curve: ContactCurve, *, load: Array, gap: Array, room: Array
) -> RingState:
    """State of the contacts of all elements with one ring, from the load [N] and the gap [m] of each, shape
    (..., n), and from the ``room`` [m] of each element, the sum of its gaps to both rings.

    A pressed element has the film of its load, as long as the film is thinner than the room. An element
    without a load is a rigid body at its gap. Between both limits all values are continuous.
    """
    solved = load > 0.0
    pressed, trend = curve.at(load), _trend(ring, curve, load)
    film = _positive(pressed.central_thickness * trend)
    thinnest = _positive(curve.values.central_thickness[..., -1:])
    within = _widened(np.where(solved, room, gap), 2.0 * thinnest)
    # Film without a bound over the room. However light a load is, a small part of its contact has a film.
    over = np.where(solved, np.minimum(film / within, _FREE - _SMALL), _FREE)
    apart = within * _bounded(over)
    free = _freedom(over)
    ratio = apart / np.where(solved, film, apart)
    return RingState(load, gap, solved, _values(ring, curve, load, (pressed, trend, ratio), (apart, free)))


def _positive(films: Array) -> Array:
    """Films [m], NaN of contacts beyond the model, which have none."""
    return np.where((films > 0.0) & np.isfinite(films), films, np.nan)


# Film over room up to which a film has the thickness that follows from its load, and from which on it has the
# thickness of the room.
_PRESSED, _FREE, _SMALL = 0.8, 1.2, 1e-4


def _widened(gap: Array, films: Array) -> Array:
    """Room for the film of an element at a gap [m]; films widen a narrow gap, shape (..., n).

    The films of the most loaded element, one with each ring, keep the rings apart, so that an element that
    touches without a load has the room of about two such films. The room is the gap from twice ``films`` on.
    """
    return np.where(gap < 2.0 * films, films + gap**2 / (4.0 * films), gap)


def _bounded(over: Array) -> Array:
    """Film over room from the film without a bound over room, dimensionless, with a continuous slope."""
    beyond = np.clip(over, _PRESSED, _FREE) - _PRESSED
    return np.where(over < _PRESSED, over, _PRESSED + beyond - beyond**2 / (2.0 * (_FREE - _PRESSED)))


def _freedom(over: Array) -> Array:
    """Part of a contact that is a gap of rigid bodies, 0 to 1, from the film without a bound over room."""
    part = (np.clip(over, _PRESSED, _FREE) - _PRESSED) / (_FREE - _PRESSED)
    return part**2 * (3.0 - 2.0 * part)


# Load over the least solved load below which the film of the formulas is thicker than every gap.
_NO_LOAD = 1e-6


def _trend(ring: RingContacts[Any], curve: ContactCurve, load: Array) -> Array:
    """Film at loads [N] over the film of ``curve.at``, shape (..., n): 1 from the least solved load on.

    The films of lighter contacts change as the formulas that hold down to rigid bodies.
    """
    least = np.asarray(curve.least_load)[..., np.newaxis]
    light = (load > 0.0) & (load < least)
    if not np.any(light):
        return np.ones(load.shape)
    loads = np.where(light, np.maximum(load, _NO_LOAD * least), least)
    films = _of_points(
        lambda each: kind_of(ring).contact(ring, each).film, np.concatenate([loads, least], -1)
    )
    return np.where(light, films[..., :-1] / films[..., -1:], 1.0)


def _of_points(law: Callable[[Array], Numbers], values: Array) -> Array:
    """Law of many points, which takes numbers with the points last, at numbers of shape (..., n)."""
    return np.moveaxis(np.asarray(law(np.moveaxis(values, -1, 0))), 0, -1)


def _values(
    ring: RingContacts[Any],
    curve: ContactCurve,
    load: Array,
    pressed: tuple[ContactValues[Array], Array, Array],
    gaps: tuple[Array, Array],
) -> ContactValues[Array]:
    """Values of contacts, shape (..., n).

    ``pressed``, values of ``curve.at``, trend of the film from there to the load, and film over the film of
    the load; ``gaps``, film or gap [m], and the part of the contact that is a gap of rigid bodies.
    """
    values, trend, ratio = pressed
    apart, free = gaps
    conditions, held = ring.conditions, 1.0 - free
    lighter = np.minimum(1.0, load / np.asarray(curve.least_load)[..., np.newaxis])
    pressure, along, across = (
        np.where(load > 0.0, lighter**exponent, 0.0) for exponent in kind_of(ring).dry_exponents
    )
    vacuum, at_least = _rigid(ring, curve, np.where((free > 0.0) | (lighter < 1.0), apart, np.nan))
    # Capacitances of contacts that are lighter than the least solved one change as capacitances of rigid
    # bodies.
    wider = held * np.where(lighter < 1.0, vacuum / at_least, 1.0)
    vacuum = _part(free, vacuum)
    permittivity = np.asarray(conditions.oil.relative_permittivity)[..., np.newaxis]
    thinner = trend * ratio
    area = along * across / thinner
    of_gap = _of_points(lambda gaps: gap_breakdown(conditions.discharge, gaps), apart)
    return ContactValues(
        max_pressure=values.max_pressure * pressure,
        semi_axis_x=values.semi_axis_x * along,
        semi_axis_y=values.semi_axis_y * across,
        minimum_thickness=held * values.minimum_thickness * thinner + free * apart,
        central_thickness=apart,
        inside=wider * values.inside,
        outside_oil=wider * values.outside_oil + vacuum * permittivity,
        outside_air=wider * values.outside_air + vacuum,
        plate=held * values.plate * area,
        strength_per_volt=1.0 / (held * thinner / values.strength_per_volt + free * apart),
        breakdown_voltage=_part(held, values.breakdown_voltage * thinner) + _part(free, of_gap),
        hertz=held * values.hertz * area,
    )


def _part(share: Array, values: Array) -> Array:
    """Share of values, some of which are infinite or unknown; 0 where the share is 0."""
    shape = np.broadcast_shapes(share.shape, values.shape)
    return np.multiply(share, values, out=np.zeros(shape), where=share != 0.0)


def _rigid(ring: RingContacts[Any], curve: ContactCurve, apart: Array) -> tuple[Array, Array]:
    """Capacitances in vacuum [F] of rigid bodies at gaps [m], shape (..., n), NaN of the others, and at the
    film of the least solved load, shape (..., 1).
    """
    gaps = np.concatenate([apart, np.asarray(curve.thickest_film)[..., np.newaxis]], axis=-1)
    vacuum = _of_points(lambda gaps: kind_of(ring).rigid_capacitance(ring, gaps), gaps)
    return vacuum[..., :-1], vacuum[..., -1:]


@dataclass(frozen=True, eq=False, repr=False)
class Position(Values):
    """Bearing at one position of its cage."""

    equilibrium: Equilibrium
    inner: RingState
    outer: RingState
    shape: Numbers | None = None  # shape parameter of a Weibull strength; None for a strength without scatter
    # Contacts of an element with one ring: two of a four-point contact bearing, whose states contain the
    # states of one diagonal after the states of the other.
    tracks: int = 1

    @property
    def rings(self) -> tuple[RingState, RingState]:
        """Contacts with the inner and with the outer ring."""
        return self.inner, self.outer

    def circuit(self, fill: Numbers | str, summits: Numbers = 0.0) -> Circuit:
        """Circuit of the bearing with "oil" or "air" around the films, or a part of it oil.

        ``summits``, height of the highest summits [m], shape (...), under which films break down.
        """
        (inner, _), (outer, _) = self.capacitances(fill)
        first, second = (
            self._weakest(ring.values.breakdown_voltage * ring.part_left(summits)) for ring in self.rings
        )
        return Circuit(inner, outer, first, second, self.shape)

    def capacitances(self, fill: Numbers | str) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Capacitances of each element to the inner and to the outer ring, and the parts of them in oil,
        shape (..., elements) [F].

        All contacts of an element with one ring are in parallel, as it conducts.
        """
        inner, outer = (
            (self.summed(ring.capacitance(fill)), self.summed(ring.oil_capacitance(fill)))
            for ring in self.rings
        )
        return inner, outer

    def inner_share(self, circuit: Circuit) -> Array:
        """Share of the bearing voltage on each contact with the inner ring, shape (..., n)."""
        return np.asarray(np.concatenate([circuit.inner_share] * self.tracks, axis=-1))

    def summed(self, values: Array) -> Array:
        """Sum over the contacts of each element with a ring, shape (..., elements)."""
        if self.tracks == 1:
            return values
        return np.asarray(np.sum(values.reshape(*values.shape[:-1], self.tracks, -1), axis=-2))

    def _weakest(self, voltages: Array) -> Array:
        """Breakdown voltage of the contacts of each element with a ring together, which have the same
        voltage, shape (..., elements) [V]: the voltage of the weaker contact, or less where their strength
        scatters.
        """
        if self.tracks == 1:
            return voltages
        each: Array = voltages.reshape(*voltages.shape[:-1], self.tracks, -1)
        least: Array = np.min(each, axis=-2)
        if self.shape is None:
            return least
        # Exponents of Weibull's law add up; powers of the voltages themselves would overflow.
        finite = np.where(np.isfinite(least), least, 1.0)[..., np.newaxis, :]
        shape = np.asarray(self.shape)[..., np.newaxis]
        number = np.sum((finite / each) ** shape[..., np.newaxis], axis=-2)
        return np.asarray(np.where(np.isfinite(least), least * number ** (-1.0 / shape), least))


@dataclass(frozen=True, eq=False, repr=False)
class BearingSolution(Values):
    """Solved bearing at several positions of its cage within one pitch of the elements."""

    case: BearingCase
    conditions: BearingConditions[Any]  # geometry, materials, oil and dielectric strength
    inner: RingContacts[Any]
    outer: RingContacts[Any]
    # inner_curve and outer_curve: solved contacts with both rings over the load.
    inner_curve: ContactCurve
    outer_curve: ContactCurve
    positions: tuple[Position, ...]
    seconds: float = field(compare=False)  # computing time [s]
    version: str = __version__

    @property
    def curves(self) -> tuple[ContactCurve, ContactCurve]:
        """Solved contacts over the load, with the inner and with the outer ring."""
        return self.inner_curve, self.outer_curve

    @property
    def refused(self) -> Mask | bool:
        """Points of many with a contact beyond the model, shape (...); their numbers have no meaning."""
        return self.inner_curve.refused | self.outer_curve.refused

    @property
    def converged(self) -> bool:
        """Whether the films of all contacts are converged."""
        return all(bool(np.all(curve.converged)) for curve in self.curves)

    @read_only_property
    def least_film(self) -> Numbers:
        """Smallest film thickness of the loaded contacts, at all positions of the cage, shape (...) [m]."""
        films = [ring.least_film for position in self.positions for ring in position.rings]
        least: Numbers = np.min(np.array(films), axis=0)
        return least

    def circuits(self, fill: Numbers | str | None = None) -> tuple[Circuit, ...]:
        """Circuit at each position, with "oil" or "air" around the films; by default ``fill`` of the case."""
        if fill is None:
            return self._circuits_of_case
        return tuple(position.circuit(fill, self.summits) for position in self.positions)

    @property
    def summits(self) -> Numbers:
        """Height of the highest summits in the contacts [m], shape (...); 0 for smooth films."""
        return self.case.bearing.summit_height * self.case.bearing.composite_rq

    @read_only_property
    def _circuits_of_case(self) -> tuple[Circuit, ...]:
        """Circuits with ``fill`` of the case, which most numbers of a bearing need."""
        return self.circuits(self.case.bearing.fill)


def dry_areas(solution: BearingSolution, ring: RingState) -> Array:
    """Area of each dry contact with a ring, shape (..., n) [m^2]; 0 without load."""
    factor = 4.0 if has_rollers(solution.case.bearing.kind) else np.pi
    return factor * ring.values.semi_axis_x * ring.values.semi_axis_y


def lambda_ratio(solution: BearingSolution) -> Numbers:
    """Lambda ratio: smallest film of the loaded contacts over ``composite_rq``, shape (...)."""
    return solution.least_film / solution.case.bearing.composite_rq


def contact_limit(summit_height: Numbers) -> Numbers:
    """Return the lambda ratio up to which asperity contact is frequent, so that no voltage is computed.

    ``summit_height`` in units of the composite Rq, shape (...).

    Examples
    --------
    >>> float(contact_limit(2.0)), float(contact_limit(0.0))
    (2.0, 1.0)
    """
    return np.maximum(BOUNDARY_LIMIT, summit_height)


def full_film_limit(summit_height: Numbers) -> Numbers:
    """Return the lambda ratio from which a film is full, shape (...), as ``lubrication_states.limits``.

    ``summit_height`` in units of the composite Rq, shape (...).

    Examples
    --------
    >>> float(full_film_limit(2.0)), float(full_film_limit(4.0))
    (3.0, 4.0)
    """
    return np.maximum(FULL_FILM_LIMIT, summit_height)


def part_over_summits(ratio: Numbers, summit_height: Numbers) -> Array:
    """Gap under the highest summits over the film, by its lambda ratio, shape (...); NaN where there is none.

    Examples
    --------
    >>> part_over_summits(np.array([4.0, 2.0]), 2.0).tolist()
    [0.5, nan]
    """
    part = 1.0 - summit_height / ratio
    return np.where(part > 0.0, part, np.nan)


def touches(ratio: Numbers, summit_height: Numbers) -> Any:
    """Whether surfaces touch so that no voltage is given, by their lambda ratio, shape (...).

    The voltage falls to 0 where the film is as thin as the highest summits are high.

    Examples
    --------
    >>> [bool(touches(ratio, height)) for ratio, height in ((0.9, 0.0), (1.0, 0.0), (2.0, 2.0), (2.1, 2.0))]
    [True, False, True, False]
    """
    return (np.asarray(ratio) < BOUNDARY_LIMIT) | (ratio <= np.asarray(summit_height))


def lambda_text(solution: BearingSolution) -> str:
    """Lambda ratio as text, with the digits of ``shown_lambda``."""
    return readable(shown_lambda(solution))


def shown_lambda(solution: BearingSolution) -> float:
    """Lambda ratio with two digits, and with three where the state of lubrication changes nearby."""
    ratio, limits = lambda_ratio(solution), (BOUNDARY_LIMIT, solution.case.bearing.summit_height)
    near = any(0.9 * limit < ratio < 1.1 * limit for limit in limits)
    return float(f"{ratio:.{3 if near else 2}g}")


def bearing_state(solution: BearingSolution) -> Any:
    """Return the lubrication state of a bearing as a text; many points have an array of texts."""
    return lubrication_state(lambda_ratio(solution), solution.case.bearing.summit_height)


def lubrication_state(ratio: Numbers, summit_height: Numbers = 0.0, *, loaded: Any = True) -> Any:
    """Return the name of the state of lubrication at a lambda ratio, one of ``lubrication_states``.

    A contact without load is a "gap". Many points have an array of texts.

    Examples
    --------
    >>> [lubrication_state(ratio, 2.0) for ratio in (3.0, 2.1, 2.0)]
    ['full film', 'mixed lubrication', 'frequent asperity contact']
    >>> lubrication_state(1.0), lubrication_state(0.9), lubrication_state(90.0, loaded=False)
    ('mixed lubrication', 'boundary lubrication', 'gap')
    """
    return labels(
        (np.logical_not(loaded), GAP),
        (np.asarray(ratio) < BOUNDARY_LIMIT, BOUNDARY.name),
        (ratio <= np.asarray(summit_height), FREQUENT.name),
        (ratio < full_film_limit(summit_height), MIXED.name),
        FULL.name,
    )


def conducts(solution: BearingSolution, *, film_scale: Numbers = 1.0) -> Any:
    """Return whether asperity contacts short a bearing so often that no voltage is computed, shape (...).

    Ceramic elements insulate. ``film_scale`` is a factor on all films, for films of estimated contacts that
    are scaled to solved films.
    """
    touching = touches(film_scale * lambda_ratio(solution), solution.case.bearing.summit_height)
    return touching & (not solution.conditions.ceramic)


def former_state(state: Any, *, conducting: Any = False) -> Any:
    """Return the word of a state of lubrication in the former keys of summary.json, shape (...).

    Examples
    --------
    >>> former_state("mixed lubrication"), former_state("boundary lubrication", conducting=True)
    ('partial film', 'conducting')
    """
    words = [(np.asarray(state) == name, word) for name, word in FORMER_WORDS.items()]
    return labels((conducting, "conducting"), *words, "")


def insulating(solution: BearingSolution) -> Any:
    """Whether the films carry voltages: the elements conduct, and the surfaces do not touch, shape (...)."""
    touching = touches(lambda_ratio(solution), solution.case.bearing.summit_height)
    return (not solution.conditions.ceramic) & ~touching


def capacitance(solution: BearingSolution, fill: Numbers | str | None = None) -> Numbers:
    """Capacitance of the smooth films of a solved bearing, mean over the positions of the cage.

    For ceramic elements it follows from ``element_capacitance``, or is an upper bound without this key.

    Returns capacitance [F], shape (...).
    """
    bearing = solution.case.bearing
    if bearing.element_capacitance is not None:
        return bearing.rows * bearing.elements * bearing.element_capacitance
    mean: Numbers = np.mean(np.array([circuit.capacitance for circuit in solution.circuits(fill)]), axis=0)
    return mean


def capacitance_is_bound(solution: BearingSolution) -> bool:
    """Whether the capacitance is only an upper bound: ceramic elements without ``element_capacitance``."""
    return solution.case.bearing.capacitance_is_bound


def plate_capacitance(solution: BearingSolution) -> Numbers | None:
    """Capacitance of plates with the Hertz areas at the distance h(0), mean over the positions [F].

    Elements count where both contacts are loaded. None for ceramic elements, which insulate.
    """
    if solution.conditions.ceramic:
        return None
    totals = []
    for position in solution.positions:
        inner, outer = (position.summed(ring.values.plate) for ring in position.rings)
        loaded = (inner > 0.0) & (outer > 0.0)
        together = series(np.where(loaded, inner, 1.0), np.where(loaded, outer, 1.0))
        totals.append(np.sum(together, axis=-1, where=loaded))
    mean: Numbers = np.mean(totals, axis=0)
    return mean


def film_error(solution: BearingSolution) -> Numbers:
    """Estimated error of the films of a bearing, relative, at most 1, shape (...).

    For solved contacts it is the largest estimated error of the films, and of their interpolation over loads
    from 2 % of the largest load on: lighter contacts never break down first. Contacts from the atlas have the
    errors that the atlas states at these loads; contacts from formulas have the error of the formula.
    """
    if solution.case.contacts == "formula":
        return formula_factor(solution.case.bearing.kind) - 1.0
    counted = [curve.counted for curve in solution.curves]
    sources = counted if solution.case.contacts == "atlas" else solution.curves
    of_films, between = (
        np.maximum(*map(np.asarray, errors))
        for errors in (
            (curve.largest_error for curve in sources),
            (curve.interpolation_error for curve in counted),
        )
    )
    return as_float(np.minimum(1.0, of_films + between))


def error_text(solution: BearingSolution) -> str:
    """Text of ``film_error``, such as "30 %" or "5.9 %"."""
    return percent(float(film_error(solution)))


def percent(error: float) -> str:
    """Text of a relative error, with two digits.

    Examples
    --------
    >>> percent(0.3), percent(0.0237)
    ('30 %', '2.4 %')
    """
    return f"{readable(100.0 * error, 2)} %"


def with_light(curves: Iterable[ContactCurve]) -> list[tuple[ContactSolution, ...]]:
    """Contacts of each ring with equal warnings on all rings about those that the atlas does not have; a
    light contact has a note instead of its warning.
    """
    rings = [(curve.solutions, set(curve.loads[curve.counted.used].tolist())) for curve in curves]
    errors: dict[bool, list[float]] = {True: [0.0], False: [0.0]}
    for contacts, heavy in rings:
        for contact in contacts:
            if any(warning.code == "atlas-left" for warning in contact.warnings):
                errors[contact.load in heavy].append(contact.error or 0.0)
    counts, light = (outside_atlas(max(errors[is_heavy]), light=not is_heavy) for is_heavy in (True, False))

    def named(contact: ContactSolution, heavy: set[float], warning: ResultWarning) -> ResultWarning:
        if warning.code != "atlas-left":
            return warning
        return counts if contact.load in heavy else light

    return [
        tuple(
            replace(contact, warnings=tuple(named(contact, heavy, warning) for warning in contact.warnings))
            for contact in contacts
        )
        for contacts, heavy in rings
    ]
