"""Capacitance of many elements' gaps in bearings of one size, by polynomials through few integrals.

On the raceway of one bearing the capacitance around a film that is a dry gap widened by a number depends on
the contact angle, on the semi-axis b of the dry contact, on this number, and on the domain of the film. The
ends of this domain follow from one length, sqrt(2 R h) of the film by a formula, and are cut off on both
sides. For each combination of ends that are cut off or not, the capacitance is an analytic function of four
numbers, and an even one of the contact angle. It is not analytic where the domain reaches the shoulder of the
groove: these contacts are integrated, and so are few contacts. In bearings of different sizes the radius of
the ball is the unit of lengths, and the ratio of pitch diameter to ball diameter is a further variable; if
their grooves are not similar, their contacts are also integrated.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, overload

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, Numbers
from ehlectric.bearing.ball_gaps import (
    DomainLaw,
    UnitContact,
    around_directly,
    around_ellipse_directly,
    between_directly,
)
from ehlectric.bearing.gaps import (
    Raceway,
    RollerRaceway,
    groove_capacitance,
    roller_capacitance,
    roller_tail,
)
from ehlectric.constants import EPSILON_0
from ehlectric.contact import Ends
from ehlectric.formulas.hertz import line_gap, reduced_radius
from ehlectric.formulas.smooth_tables import Function, SmoothTable, smooth_table
from ehlectric.runtime.display import read_only_property

# Least number of rollers and of unloaded balls for which polynomials of three or more variables are made,
# which need the integrals of a hundred contacts.
LEAST = 200

# Largest error of polynomials over the value in the middle of their box: for capacitances around short and
# around long domains, which are 1 to 30 % and 15 to 60 % of the capacitance of the whole contact; and for
# integrals between two domains. Largest relative error of integrals around an ellipse and of rigid balls.
_SHORT, _LONG, _BETWEEN, _RELATIVE = 1e-8, 2e-8, 2e-8, 3e-9

# Steps to which the ends of boxes are rounded outwards, so that similar batches have the same ones: of
# logarithms and of squares of angles.
_STEP, _STEP_SQUARE = 0.125, 2.0**-8

# Tables of two variables take few integrals, so that wide boxes serve all batches of a bearing. Around
# ellipses: length of the intervals of the logarithm of the ratio of the radii, and range of the logarithm of
# the film over b^2/Rx. Of rigid balls: step of the square of the angle, and least range of the logarithm of
# the gap over the radius of the ball.
_CELL, _FILMS, _OF_GAP = 0.5, (-10.0, 5.0), (2.0**-6, (-13.0, -5.0))

# Numbers of polynomials along each variable that tables are expected to have.
_IN_ELLIPSE, _IN_GAP = (4, 30), (5, 18)
_AROUND_SHORT, _AROUND_LONG, _BETWEEN_BOTH = (2, 4, 4, 4), (2, 4, 6, 4), (2, 6, 4)

# Box of the variables of a table: least and largest value of each.
_Box = tuple[tuple[float, ...], tuple[float, ...]]


@dataclass(frozen=True)
class _Size:
    """Dimensions of a raceway that all points have, and names of those that are variables of the tables."""

    # Radii of ball, groove and pitch [m], over the radius of the ball where this varies; angle of the
    # shoulder and angle at which the groove begins [rad], None where it is symmetric.
    ball_radius: float
    groove_radius: float
    pitch_radius: float
    shoulder_angle: float
    first_angle: float | None
    outer: bool
    # "pitch_radius" as a logarithm, and "first_angle", in the order of their variables.
    varying: tuple[str, ...] = ()

    def race(self, square: Array, more: Array) -> Raceway:
        """Raceway at squares of contact angles [rad^2], and at values of what varies, shape (varying, m)."""
        fields: dict[str, Any] = {"pitch_radius": self.pitch_radius, "first_angle": self.first_angle}
        for name, values in zip(self.varying, more, strict=True):
            fields[name] = np.exp(values) if name == "pitch_radius" else values
        angle = np.sqrt(np.maximum(0.0, square))
        sizes = self.ball_radius, self.groove_radius, fields["pitch_radius"], self.shoulder_angle
        return Raceway(*sizes, angle, self.outer, fields["first_angle"])


# Relative difference of ratios of dimensions that is rounding.
_EQUAL = 1e-12


# Raceways of which the points are kept: the raceways of both rings of some bearings.
_KEPT = 8


@lru_cache(maxsize=_KEPT)
def _points(race: Raceway) -> tuple[Raceway, UnitContact, tuple[int, ...]]:
    """Raceways of all points in one row, their unit contacts, shape (n,), and the shape (...) of the points.

    They are computed once for all loads and gaps of the same raceway.
    """
    shape = np.broadcast_shapes(*(np.shape(value) for value in vars(race).values()))
    varies: dict[str, Any] = {
        k: np.broadcast_to(v, shape).ravel() for k, v in vars(race).items() if np.ndim(v)
    }
    row, size = replace(race, **varies), int(np.prod(shape, dtype=int))
    radii = (np.broadcast_to(radius, (size,)) for radius in (row.radius_x, row.radius_y))
    return row, UnitContact.of(*radii), shape


def _is_single(values: Numbers | None) -> bool:
    """Whether all points have one value, up to rounding; so they have where there is none."""
    return values is None or np.ndim(values) == 0 or bool(np.ptp(values) <= _EQUAL * np.max(np.abs(values)))


def _single(values: Numbers) -> float:
    """Value that all points have."""
    return float(np.ravel(values)[0])


@dataclass(frozen=True)
class _Contacts:
    """Contacts of many points in one row."""

    race: Raceway  # numbers of the points, shape (n,), or numbers that do not vary
    unit: UnitContact  # contacts of the points, shape (n,)
    point: IntArray  # point of each contact, shape (m,)
    shape: tuple[int, ...]  # shape (...) of the m contacts
    single: bool  # whether there is one point, which shares no polynomials with others

    @classmethod
    def of(cls, race: Raceway, *numbers: Numbers) -> _Contacts:
        """Contacts with numbers that broadcast with the numbers of their raceways."""
        row, unit, points = _points(race)
        shape = np.broadcast_shapes(points, *map(np.shape, numbers))
        point = np.broadcast_to(np.arange(np.size(unit.ratio)).reshape(points), shape).ravel()
        return cls(row, unit, point, shape, points == ())

    @property
    def angles(self) -> Array:
        """Angles of the points [rad], shape (n,)."""
        return np.broadcast_to(np.abs(self.race.contact_angle), np.shape(self.unit.ratio))

    @read_only_property
    def size(self) -> _Size | None:
        """Dimensions of the raceway; None where the ratio of the radii or the shoulder varies."""
        race, unit = self.race, self.length
        groove, pitch = race.groove_radius / unit, race.pitch_radius / unit
        if not (_is_single(groove) and _is_single(race.shoulder_angle)):
            return None
        first = race.first_angle
        varying = [
            name for name, value in (("pitch_radius", pitch), ("first_angle", first)) if not _is_single(value)
        ]
        return _Size(
            ball_radius=_single(race.ball_radius / unit),
            groove_radius=_single(groove),
            pitch_radius=0.0 if "pitch_radius" in varying else _single(pitch),
            shoulder_angle=_single(race.shoulder_angle),
            first_angle=None if first is None or "first_angle" in varying else _single(first),
            outer=race.outer,
            varying=tuple(varying),
        )

    @read_only_property
    def length(self) -> Numbers:
        """Unit of lengths [m]: 1, or the radius of the ball of each point where it varies."""
        return 1.0 if np.ndim(self.race.ball_radius) == 0 else self.race.ball_radius

    def varying(self, rows: Any = slice(None)) -> list[Array]:
        """Return the varying values of the contacts ``rows``, in the order of the table variables."""
        sizes: dict[str, Any] = {
            "pitch_radius": np.log(self.race.pitch_radius / self.length),
            "first_angle": self.race.first_angle,
        }
        return [self.of_point(sizes[name])[rows] for name in (self.size.varying if self.size else ())]

    def row(self, numbers: Numbers) -> Array:
        """Numbers of all contacts in one row, shape (m,)."""
        return np.broadcast_to(numbers, self.shape).ravel()

    @overload
    def of_point(self, numbers: Mask) -> Mask: ...

    @overload
    def of_point(self, numbers: Numbers) -> Array: ...

    def of_point(self, numbers: Numbers | Mask) -> Array | Mask:
        """Numbers of the points for each contact, shape (m,)."""
        return np.broadcast_to(numbers, self.angles.shape)[self.point]

    def races(self, contacts: Mask) -> Raceway:
        """Raceway of some of the contacts."""
        return self.race.at(self.point[contacts])


def around_of_balls(race: Raceway, b: Numbers, ends: Ends, films: Numbers, law: DomainLaw) -> Array:
    """Capacitance between balls and raceway outside the domains of films: dry gaps widened by a number.

    The numbers equal the numbers of ``around_directly``. Many contacts of bearings of one size have
    polynomials through them instead, with errors of about 1e-8 of the capacitance of the whole contact.

    ``race``, raceways of the points; ``b``, semi-axis of the dry contact along entrainment [m]; ``ends``,
    inlet and outlet over b and side over the semi-axis across entrainment, as they follow from ``law``;
    ``films``, film thickness in the middle [m]; all of them broadcast to the shape (...). Returns capacitance
    in vacuum [F], shape (...); NaN where a number is NaN or the contact is not in the groove.
    """
    contacts = _Contacts.of(race, b, films, *ends)
    b, films, inlet, outlet, side = map(contacts.row, (b, films, *ends))
    unit, size, angles = contacts.unit.at(contacts.point), contacts.size, contacts.angles
    edge, middle = b * unit.ratio * side, films * contacts.of_point(race.radius_x) / b**2
    unit_length = contacts.of_point(contacts.length)
    integral, left = np.full(b.shape, np.nan), np.isfinite(edge * middle * inlet * outlet)
    left &= contacts.of_point(contacts.race.holds)
    reach, at = edge / contacts.of_point(contacts.race.groove_radius), angles[contacts.point]
    inside = left & (at + reach < contacts.of_point(contacts.race.shoulder_angle))
    inside &= at - reach > contacts.of_point(contacts.race.begins)
    for state, rows in _states(law.states((inlet, outlet, side), unit), inside, law.least):
        if size is None:
            break
        length = law.length(state, (inlet[rows], outlet[rows], side[rows]), unit.at(rows))
        edges = np.log(edge[rows] / unit_length[rows])
        lengths = _logarithms(state, length, middle[rows])
        variables = np.square(angles), edges, *lengths, *contacts.varying(rows)
        table = _around(size, law, state, _box(variables))
        if table is not None:
            whole = table(*variables, group=contacts.point[rows])
            integral[rows], left[rows] = unit_length[rows] * whole, False
    ends = -inlet[left], outlet[left], side[left]
    integral[left] = around_directly(contacts.races(left), b[left], ends, films[left], nodes=law.nodes)[0]
    return integral.reshape(contacts.shape)


def between_domains(race: Raceway, ends: Ends, middle: Numbers, law: DomainLaw) -> Array:
    """Integral of dA/h over Rx between default domains and wider ones, as of ``between_directly``.

    ``race``, raceways of the points; ``ends``, inlet and outlet over b and side over the semi-axis across
    entrainment, as they follow from ``law``; ``middle``, film thickness in the middle over b^2/Rx; all of
    them broadcast to the shape (...). Returns the integral, dimensionless, shape (...); NaN where a number is
    NaN. Polynomials have errors of about 1e-8 of the integral over the whole contact.
    """
    contacts = _Contacts.of(race, middle, *ends)
    middle, inlet, outlet, side = map(contacts.row, (middle, *ends))
    unit, radius_ratio = contacts.unit.at(contacts.point), np.log(contacts.unit.radius_ratio)
    integral, left = np.full(middle.shape, np.nan), np.isfinite(middle * inlet * outlet * side)
    states = law.states((inlet, outlet, side), unit)
    integral[left & (states == 0)], left = 0.0, left & (states > 0)
    for state, rows in _states(states, left, law.least):
        length = law.length(state, (inlet[rows], outlet[rows], side[rows]), unit.at(rows))
        variables = radius_ratio, *_logarithms(state, length, middle[rows])
        table = _between(law, state, _box(variables))
        if table is not None:
            integral[rows], left[rows] = table(*variables, group=contacts.point[rows]), False
    part = unit.at(np.flatnonzero(left))
    shape = np.shape(part.ratio)
    near = np.full(shape, law.inlet), np.full(shape, law.outlet), law.side(part.ratio)
    integral[left] = between_directly(part, near, (inlet[left], outlet[left], side[left]), middle[left])
    return integral.reshape(contacts.shape)


def around_ellipses(race: Raceway, middle: Numbers, law: DomainLaw) -> tuple[Array, Array]:
    """Integrals of dA/h over Rx before and behind the middle of contacts, outside the ellipse and inside the
    default domain of films that are dry gaps widened by a number.

    ``race``, raceways of the points; ``middle``, film thickness in the middle over b^2/Rx; they broadcast to
    the shape (...). Returns both integrals, dimensionless, shape (...); NaN where a number is NaN.
    Polynomials have a relative error of about 3e-9.
    """
    contacts = _Contacts.of(race, middle)
    middle = contacts.row(middle)
    valid = np.isfinite(middle) & (middle > 0.0)
    ratio = np.log(contacts.unit.radius_ratio)
    integrals = np.full((2, middle.size), np.nan)
    # A table for each interval of the ratio: a number does not depend on the other contacts.
    film, cells = np.log(middle, out=np.full(middle.shape, np.nan), where=valid), np.floor(ratio / _CELL)
    inside = (film >= _FILMS[0]) & (film <= _FILMS[1]) & (not contacts.single)
    for cell in np.unique(cells[np.isfinite(cells)]).tolist():
        rows = np.flatnonzero(inside & (cells == cell)[contacts.point])
        box = (cell * _CELL, _FILMS[0]), ((cell + 1.0) * _CELL, _FILMS[1])
        tables = [_ellipse(law, part, box) for part in range(2)] if rows.size else []
        for values, table in zip(integrals, tables, strict=False):
            if table is not None:
                values[rows] = np.exp(table(ratio, film[rows], group=contacts.point[rows]))
    left = np.flatnonzero(valid & np.isnan(integrals).any(axis=0))
    several = np.asarray(contacts.unit.radius_ratio)[contacts.point[left]]
    integrals[:, left] = around_ellipse_directly(several, middle[left], law)
    inlet, outlet = integrals.reshape(2, *contacts.shape)
    return inlet, outlet


def rigid_balls(race: Raceway, gap: Numbers) -> Array:
    """Capacitance in vacuum [F] between unloaded, rigid balls and raceway, as of ``groove_capacitance``.

    ``race``, raceways of the points; ``gap``, gap at the contact angle [m]; they broadcast to the shape
    (...). Returns capacitance [F], shape (...); NaN if a number is NaN or not positive, the gap is above the
    radius of the ball, or the contact angle is not in the groove. Polynomials have a relative error of about
    3e-9.
    """
    contacts = _Contacts.of(race, gap)
    gap, size = contacts.row(gap), contacts.size
    radius = contacts.of_point(contacts.race.ball_radius)
    valid = (gap > 0.0) & (gap <= radius) & contacts.of_point(contacts.race.holds)
    capacitance, table = np.full(gap.shape, np.nan), None
    unit_length, over = contacts.of_point(contacts.length)[valid], gap[valid] / radius[valid]
    variables = np.square(contacts.angles), np.log(over), *contacts.varying(valid)
    least = LEAST if size is None or size.varying else 1
    if size is not None and not contacts.single and np.count_nonzero(valid) >= least:
        table = _rigid(size, _box(variables, *_OF_GAP))
    if table is None:
        capacitance[valid] = groove_capacitance(contacts.races(valid), gap[valid])
    else:
        capacitance[valid] = unit_length * np.exp(table(*variables, group=contacts.point[valid]))
    return capacitance.reshape(contacts.shape)


def _states(states: IntArray, valid: Mask, least: int) -> Iterator[tuple[tuple[int, ...], IntArray]]:
    """States of ends that ``least`` contacts or more have, with the rows of these contacts."""
    for number, count in enumerate(np.bincount(states[valid], minlength=1)):
        if count >= least:
            yield (number // 9, number // 3 % 3, number % 3), np.flatnonzero(valid & (states == number))


def _logarithms(state: tuple[int, ...], length: Numbers, middle: Array) -> tuple[Array, Array]:
    """Variables of domains and films: the length from which ends follow and the film over the film of this
    length, or only the film where no end follows from a length.
    """
    if 1 not in state:
        return np.log(middle), np.zeros_like(middle)
    return np.log(length), np.log(2.0 * middle / length**2)


def _length_and_middle(state: tuple[int, ...], first: Array, second: Array) -> tuple[Array, Array]:
    """Length and film in the middle from the variables of ``_logarithms``."""
    if 1 not in state:
        return np.ones_like(first), np.exp(first)
    return np.exp(first), 0.5 * np.exp(2.0 * first + second)


def _box(
    variables: tuple[Array, ...], step: float = _STEP_SQUARE, least: tuple[float, float] | None = None
) -> _Box:
    """Box of variables; a variable with one value keeps it.

    ``step``, step of the first one, which may be a square; ``least``, range of the second one that the box
    holds in any case.
    """
    low, high = [], []
    for number, values in enumerate(variables):
        ends = float(np.nanmin(values)), float(np.nanmax(values))
        size = _STEP if number else step
        if least is not None and number == 1:
            ends, size = (min(ends[0], least[0]), max(ends[1], least[1])), 1.0
        same = ends[1] - ends[0] <= 1e-12 * max(1.0, abs(ends[1]))
        low.append(ends[0] if same else size * float(np.floor(ends[0] / size)))
        high.append(ends[1] if same else size * float(np.ceil(ends[1] / size)))
    return tuple(low), tuple(high)


@lru_cache(maxsize=128)
def _around(size: _Size, law: DomainLaw, state: tuple[int, ...], box: _Box) -> SmoothTable | None:
    """Capacitance around films [F] over squared angle, logarithms of side, domain and film, and what varies.

    Where the radius of the ball varies, it is the unit of lengths, also of the capacitance over eps0.
    """

    def capacitance(at: Array) -> Array:
        race = size.race(at[0], at[4:])
        unit = UnitContact.of(race.radius_x, np.broadcast_to(race.radius_y, at[0].shape))
        length, middle = _length_and_middle(state, at[2], at[3])
        inlet, outlet, side = law.ends(state, length, unit)
        b = np.exp(at[1]) / (unit.ratio * side)
        films = middle * b**2 / race.radius_x
        ends = -inlet, outlet, side
        return around_directly(race, b, ends, films, shoulders=False, nodes=law.nodes)[0]

    numbers = _expected(_AROUND_LONG if 1 in state else _AROUND_SHORT, box)
    return _normalised(capacitance, box, law.coarseness * (_LONG if state[0] else _SHORT), numbers)


@lru_cache(maxsize=128)
def _between(law: DomainLaw, state: tuple[int, ...], box: _Box) -> SmoothTable | None:
    """Integrals between domains over logarithms of the ratio of the radii, and of the domain and the film."""

    def integral(at: Array) -> Array:
        unit = UnitContact.of(np.ones_like(at[0]), np.exp(at[0]))
        length, middle = _length_and_middle(state, at[1], at[2])
        near = np.full(length.shape, law.inlet), np.full(length.shape, law.outlet), law.side(unit.ratio)
        far = tuple(np.broadcast_to(end, length.shape) for end in law.ends(state, length, unit))
        return between_directly(unit, near, (far[0], far[1], far[2]), middle)

    return _normalised(integral, box, law.coarseness * _BETWEEN, _BETWEEN_BOTH)


@lru_cache(maxsize=64)
def _ellipse(law: DomainLaw, part: int, box: _Box) -> SmoothTable | None:
    """Logarithm of an integral around ellipses over logarithms of the ratio of the radii and the film."""

    def logarithm(at: Array) -> Array:
        return np.asarray(np.log(around_ellipse_directly(np.exp(at[0]), np.exp(at[1]), law)[part]))

    low, high = map(np.array, box)
    return smooth_table(logarithm, low, high, law.coarseness * _RELATIVE, _IN_ELLIPSE)


@lru_cache(maxsize=64)
def _rigid(size: _Size, box: _Box) -> SmoothTable | None:
    """Logarithm of the capacitance [F] of rigid balls over the squared angle, the logarithm of gap over ball
    radius, and what varies.
    """

    def logarithm(at: Array) -> Array:
        race = size.race(at[0], at[2:])
        return np.asarray(np.log(groove_capacitance(race, size.ball_radius * np.exp(at[1]))))

    return smooth_table(logarithm, np.array(box[0]), np.array(box[1]), _RELATIVE, _expected(_IN_GAP, box))


def _expected(numbers: tuple[int, ...], box: _Box) -> tuple[int, ...]:
    """Expected numbers along all variables of a box; few along further ones that vary."""
    return (*numbers, *(2 for _ in box[0][len(numbers) :]))


def _normalised(
    function: Function, box: _Box, tolerance: float, expected: tuple[int, ...] = ()
) -> SmoothTable | None:
    """Table of a function, with a tolerance over its value in the middle of the box."""
    low, high = map(np.array, box)
    scale = float(function(0.5 * (low + high)[:, np.newaxis])[0])
    table = smooth_table(lambda at: function(at) / scale, low, high, tolerance, expected)
    return None if table is None else replace(table, coefficients=scale * table.coefficients)


# Radii of roller and raceway [m], and whether the raceway is the outer one.
_RollerSize = tuple[float, float, bool]

# End of a domain over the radius of the roller below which tails have polynomials; tails end at the radius.
_NEAR = 0.5


def around_of_rollers(
    race: RollerRaceway, b: Numbers, ends: tuple[Numbers, Numbers], films: Numbers
) -> Array:
    """Capacitance per length between rollers and raceway outside the domains of films: dry gaps widened by a
    number.

    The numbers equal the numbers of ``roller_tails``. Many contacts of bearings of one size have polynomials
    through them instead, with errors of about 1e-8 of the capacitance of the whole contact.

    ``race``, raceways of the points; ``b``, half-width of the dry contact [m]; ``ends``, inlet and outlet
    over b, positive; ``films``, film thickness in the middle [m]; all of them broadcast to the shape (...).
    Returns capacitance per length in vacuum [F/m], shape (...); NaN where a number is NaN.
    """
    shape = np.broadcast_shapes(*map(np.shape, (b, films, *ends, race.roller_radius, race.race_radius)))
    b, films, *lengths = (np.broadcast_to(value, shape).ravel() for value in (b, films, *ends))
    races, size = _roller_races(race, shape), _roller_size(race)
    total = np.zeros(b.shape)
    for length in lengths:
        capacitance, left = np.full(b.shape, np.nan), np.isfinite(b * films * length)
        inside = left & (b * length < _NEAR * races.roller_radius) & (size is not None)
        # Default ends are alike: they need no variable of their own.
        shortest = np.min(length, initial=np.inf, where=inside)
        for rows in (inside & (length == shortest), inside & (length > shortest)):
            if size is None or np.count_nonzero(rows) < LEAST:
                continue
            end = b[rows] * length[rows]
            middle = np.log(films[rows] * np.asarray(races.roller_radius)[rows] / end**2)
            variables = np.zeros(1), np.log(end), np.log(length[rows]), middle
            table = _tail(size, _box(variables))
            if table is not None:
                capacitance[rows], left[rows] = table(*variables), False
        capacitance[left] = _tail_of_side(races.at(left), b[left], length[left], films[left])
        total += capacitance
    return total.reshape(shape)


def rigid_rollers(race: RollerRaceway, gap: Numbers) -> Array:
    """Capacitance per length in vacuum [F/m] between unloaded, rigid rollers and raceway.

    ``race``, raceways of the points; ``gap``, smallest gap [m]; they broadcast to the shape (...). Returns
    the numbers of ``roller_capacitance``, shape (...); NaN where a gap is NaN or not positive. Polynomials
    have a relative error of about 3e-9.
    """
    shape = np.broadcast_shapes(np.shape(gap), np.shape(race.roller_radius), np.shape(race.race_radius))
    races, size = _roller_races(race, shape), _roller_size(race)
    gap = np.broadcast_to(gap, shape).ravel()
    valid = np.isfinite(gap) & (gap > 0.0)
    capacitance, table = np.full(gap.shape, np.nan), None
    variables = np.zeros(1), np.log(gap[valid])
    if size is not None and np.count_nonzero(valid) >= LEAST:
        table = _rigid_roller(size, _box(variables))
    if table is None:
        capacitance[valid] = roller_capacitance(races.at(valid), gap[valid])
    else:
        capacitance[valid] = np.exp(table(*variables))
    return capacitance.reshape(shape)


def _roller_size(race: RollerRaceway) -> _RollerSize | None:
    """Dimensions of the raceway; None where they vary."""
    if np.ndim(race.roller_radius) or np.ndim(race.race_radius):
        return None
    return float(race.roller_radius), float(race.race_radius), race.outer


def _roller_races(race: RollerRaceway, shape: tuple[int, ...]) -> RollerRaceway:
    """Raceways of all contacts in one row."""
    radii = (np.broadcast_to(value, shape).ravel() for value in (race.roller_radius, race.race_radius))
    return RollerRaceway(next(radii), next(radii), race.outer)


def _tail_of_side(race: RollerRaceway, b: Array, length: Array, films: Array) -> Array:
    """Capacitance per length [F/m] beyond one end of the domains of films, at a length over b."""
    reduced = reduced_radius(race.roller_radius, -1.0 / race.curvature)
    thickness = films + b**2 / reduced * line_gap(length)
    return np.asarray(EPSILON_0 * roller_tail(race, b, b * length, thickness))


@lru_cache(maxsize=64)
def _tail(size: _RollerSize, box: _Box) -> SmoothTable | None:
    """Capacitance per length beyond one end [F/m] over logarithms of its end, this end over b, and film."""

    def capacitance(at: Array) -> Array:
        films = np.exp(at[3] + 2.0 * at[1]) / size[0]
        return _tail_of_side(RollerRaceway(*size), np.exp(at[1] - at[2]), np.exp(at[2]), films)

    return _normalised(capacitance, box, _LONG)


@lru_cache(maxsize=64)
def _rigid_roller(size: _RollerSize, box: _Box) -> SmoothTable | None:
    """Logarithm of the capacitance per length of rigid rollers [F/m] over the logarithm of the gap."""

    def logarithm(at: Array) -> Array:
        return np.asarray(np.log(roller_capacitance(RollerRaceway(*size), np.exp(at[1]))))

    return smooth_table(logarithm, np.array(box[0]), np.array(box[1]), _RELATIVE)
