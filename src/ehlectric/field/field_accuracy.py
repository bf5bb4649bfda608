"""Electric field of a gap, and the error estimate of its largest field strength.

The places where the field may be largest are found from a solution that may be too coarse. To first order in
the heights of the walls, the field at a wall follows from integrals over the walls. It does not depend on the
polynomial degree. It shows where a coarse solution lacks the rise at a crest.

A wave on a wall raises the field next to it. This rise decays within 1/k from the wall, where k is the wave
number. If the gap is much wider than the wave, the polynomial across the gap must resolve a boundary layer.
The columns must resolve the wave along the gap. Both errors are estimated in windows of a few gaps around
the places where the field may be largest, so that the estimate costs little.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

import numpy as np

from ehlectric.arrays import Array, largest_nearby
from ehlectric.errors import ConvergenceError
from ehlectric.formulas.akima import with_middles
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.runtime.display import Values

if TYPE_CHECKING:
    from ehlectric.field.poisson import FieldProblem
    from ehlectric.field.poisson_3d import PointFieldProblem

    GapProblem: TypeAlias = FieldProblem | PointFieldProblem

# Long names in files of results.
_POSITION = "position along entrainment, columns of the field"
_FRACTION = "fraction of the gap, from surface 1 to surface 2"
_STRENGTH = "electric field strength"


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class GapField(Values):
    """Electric potential and field strength in the gap of a contact, in SI units.

    The two walls are the surfaces of the contact; both are conductors of constant potential. Values of
    columns have the shape (nx,) in a line contact and (nx, ny) in a point contact; values in the gap have a
    last axis across it, of length ns.
    """

    # x and s: position along the gap [m]; height above the lower wall over the gap, from 0 to 1,
    # shapes (nx,).
    x: Array = field(metadata=stored("x_field", "m", "increasing", _POSITION, name="x_field"))
    s: Array = field(metadata=stored("s", "1", "increasing", _FRACTION))
    # permittivity and potential: relative permittivity and potential [V], shape (..., ns).
    permittivity: Array = field(metadata=stored("columns s", "1", "positive", "relative permittivity"))
    potential: Array = field(metadata=stored("columns s", "V", "finite", "electric potential"))
    # field_x, field_y and strength: components of E = -grad V and its magnitude [V/m], shape (..., ns).
    field_x: Array = field(metadata=stored("columns s", "V/m", "finite", "electric field along x"))
    field_y: Array = field(metadata=stored("columns s", "V/m", "finite", "electric field along y"))
    strength: Array = field(metadata=stored("columns s", "V/m", "not negative", _STRENGTH))
    middle_strength: Array = field(
        metadata=stored("columns", "V/m", "not negative", f"{_STRENGTH} at mid-film")
    )  # abs(E) at s = 1/2 [V/m]
    thin_gap_strength: Array = field(
        metadata=stored("columns", "V/m", "positive", "voltage / film thickness")
    )  # voltage over the gap of each column [V/m]
    # Charge of wall 2 per area and voltage [F/m^2].
    capacitance_density: Array = field(metadata=stored("columns", "F/m^2", "finite", "capacitance per area"))
    # Magnitude of the potential difference of the walls [V].
    voltage: float = field(metadata=number("positive"))
    # capacitance and capacitance_by_charge: capacitance [F], of a line contact per length [F/m], from the
    # energy of the field and from the charge of wall 2
    capacitance: float = field(metadata=number("positive"))
    capacitance_by_charge: float = field(metadata=number("finite"))
    # Integral of eps0 eps/h over the columns [F or F/m].
    thin_gap_capacitance: float = field(metadata=number("positive"))
    # Estimated relative error of the largest field strength; None if it is not known, which it is only for a
    # permittivity that is constant across the gap, without charge and without prescribed potentials of the
    # end faces.
    strength_error: float | None = field(default=None, metadata=number())
    # Polynomial degree across the gap at which its part of that error is below 0.5 %; None if it is not
    # known.
    sufficient_degree: int | None = field(default=None, metadata=number())

    @property
    def column_strength(self) -> Array:
        """Largest abs(E) of each column, on either wall or at mid-film [V/m]."""
        strength: Array = np.max(self._sections, axis=0)
        return strength

    @property
    def max_strength(self) -> float:
        """Largest abs(E) on either wall or at mid-film [V/m]."""
        return float(np.max(self._sections))

    @property
    def max_strength_wall(self) -> str:
        """Location of the largest abs(E) across the film: "surface 1", "mid-film" or "surface 2"; the
        first one of those that are equal within rounding, as both walls of equal bodies.
        """
        largest = np.max(self._sections.reshape(3, -1), axis=1)
        first = int(np.argmax(largest >= (1.0 - _EQUAL) * np.max(largest)))
        return ("surface 1", "mid-film", "surface 2")[first]

    @property
    def _sections(self) -> Array:
        return np.stack([self.strength[..., 0], self.middle_strength, self.strength[..., -1]])


# Relative difference of two field strengths that are equal within rounding.
_EQUAL = 1e-6

# Fraction of the largest field. Places with less, even after correction, are skipped. Columns are also
# skipped if their thin-gap field is lower than the second fraction: a cylinder of any size doubles the field
# at its top.
_LOW = 0.7
_LOW_THIN = 0.5

# Distance up to which walls are integrated, in gaps: the integrands decay with exp(-pi distance/gap).
_REACH = 1.5

# Largest number of columns of the integrals on either side.
_MOST_COLUMNS = 200

# Distance between places, in gaps, and their largest number.
_APART = 0.5
_MOST_PLACES = 100

# Factor of the rise of first order, for the terms of higher order.
HIGHER_ORDER = 1.25


@dataclass(frozen=True)
class Place:
    """Place where the field may be largest."""

    column: tuple[int, ...]
    strength: float  # largest field strength of the solution within half a gap [V/m]
    missing: float  # relative rise by which the field of first order exceeds ``strength``, at least 0


def places(problem: GapProblem, strength: Array) -> list[Place]:
    """Places where the field may be largest; the first has the largest field of the solution.

    ``strength`` [V/m] is the largest field strength of each column, shape (nx,) or (nx, ny). The other places
    are local maxima of the higher of ``strength`` and the field of first order, which is raised for terms of
    higher order. They are sorted by this bound, the highest first.
    """
    first_order = first_order_strength(problem, strength)
    return [
        _place(problem, strength, first_order, column) for column in _columns(problem, strength, first_order)
    ]


def _columns(problem: GapProblem, strength: Array, first_order: Array) -> Iterator[tuple[int, ...]]:
    bound = strength + HIGHER_ORDER * np.maximum(first_order - strength, 0.0)
    summits = (bound == largest_nearby(bound)) & (bound > _LOW * float(np.max(strength)))
    left = np.where(summits, bound, 0.0)
    column = tuple(int(k) for k in np.unravel_index(np.argmax(strength), strength.shape))
    for _ in range(_MOST_PLACES):
        yield column
        left[around(problem, column, reach=_APART, least=1)] = 0.0
        column = tuple(int(k) for k in np.unravel_index(np.argmax(left), left.shape))
        if left[column] == 0.0:
            return


def _place(problem: GapProblem, strength: Array, first_order: Array, column: tuple[int, ...]) -> Place:
    near = around(problem, column, reach=_APART, least=1)
    highest = float(np.max(strength[near]))
    return Place(column, highest, max(float(np.max(first_order[near])) / highest - 1.0, 0.0))


def around(
    problem: GapProblem, column: tuple[int, ...], *, reach: float, least: int, most: int | None = None
) -> tuple[slice, ...]:
    """Indices of the columns within ``reach`` gaps of a column along every axis.

    There are at least ``least`` and at most ``most`` columns on either side.
    """
    distance = reach * float(problem.upper[column] - problem.lower[column])
    parts = []
    for at, axis in zip(column, problem.positions.values(), strict=True):
        start, stop = np.searchsorted(axis, [axis[at] - distance, axis[at] + distance])
        start, stop = min(int(start), at - least), max(int(stop), at + least + 1)
        if most is not None:
            start, stop = max(start, at - most), min(stop, at + most + 1)
        parts.append(slice(max(start, 0), min(stop, axis.size)))
    return tuple(parts)


def first_order_strength(problem: GapProblem, strength: Array) -> Array:
    """Larger field strength of both walls to first order in their heights [V/m]. ``strength``, field strength
    of each column of a solution [V/m], shape (nx,) or (nx, ny). Returns 0 where the thin-gap field is below
    half the largest ``strength``, shape (nx,) or (nx, ny).

    Waves ``a cos kx`` on the lower wall and ``b cos kx`` on the upper wall of a gap h change the field at the
    lower wall by the factor ``1 + a k coth kh - b k / sinh kh``. The change of the thin-gap field accounts
    for ``(a - b)/h``. The Fourier transforms of the rest are integrals over the differences of height from
    the column, weighted by ``pi/(4 h^2) / sinh^2(pi t/2h)`` for the same wall and ``1/cosh^2`` for the other.
    On maps, the integrals along both axes are added: the wave number is at most the sum of its components.

    Examples
    --------
    Waves with a k = 0.1 on the wall of a wide gap raise the field at their crests by 10 %:

    >>> import numpy as np
    >>> from ehlectric.field.poisson import FieldProblem
    >>> x = np.linspace(-4.0, 4.0, 129)
    >>> flat = 0.0 * x
    >>> waves = FieldProblem(x, 0.1 / np.pi * np.cos(np.pi * x), flat + 2.0, flat + 1.0, 0.0, 1.0)
    >>> round(float(first_order_strength(waves, flat)[64]) * 2.0, 1)
    1.1
    """
    gap = problem.upper - problem.lower
    thin = abs(problem.potential_2 - problem.potential_1) / gap
    high = thin >= _LOW_THIN * float(np.max(strength))
    rises = np.zeros((2, *gap.shape))
    if np.any(high):
        widest = float(np.max(gap[high]))
        for axis, positions in enumerate(problem.positions.values()):
            walls = [np.moveaxis(wall, axis, 0) for wall in (problem.lower, -problem.upper)]
            along = _rises(positions, walls[0], walls[1], widest)
            rises += np.moveaxis(along, 1, axis + 1)
    return np.where(high, thin * (1.0 + np.max(rises, axis=0)), 0.0)


def _rises(x: Array, lower: Array, upper: Array, widest: float) -> Array:
    """Relative rises at both walls from waves along the first axis, beyond the rises of the thin-gap field.

    ``upper`` is the negative height of the upper wall, so that crests are positive on both walls.
    """
    most = min(_columns_within(x, _REACH * widest), x.size - 1)
    far = np.pad(x, most, mode="reflect", reflect_type="odd")
    ends = [(most, most)] + [(0, 0)] * (lower.ndim - 1)
    far_walls = [np.pad(wall, ends, mode="reflect") for wall in (lower, upper)]
    weight = np.gradient(far)
    shape = (-1,) + (1,) * (lower.ndim - 1)
    gap = -upper - lower
    rises = np.zeros((2, *lower.shape))
    for k in (*range(-most, 0), *range(1, most + 1)):
        there = slice(most + k, most + k + x.size)
        distance = np.abs(far[there] - x).reshape(shape)
        # Beyond a distance of 20 gaps sinh^2 is as good as infinite.
        scaled = np.minimum(0.5 * np.pi * distance / gap, 20.0)
        factor = 0.25 * np.pi / gap**2 * weight[there].reshape(shape)
        same, other = factor / np.sinh(scaled) ** 2, factor / np.cosh(scaled) ** 2
        differences = [wall - padded[there] for wall, padded in zip((lower, upper), far_walls, strict=True)]
        rises[0] += same * differences[0] - other * differences[1]
        rises[1] += same * differences[1] - other * differences[0]
        if abs(k) == 1:
            # The column itself: the limit of the integrand, half from either side.
            part = weight[most : most + x.size].reshape(shape) / (2.0 * np.pi * distance**2)
            rises += part * np.array(differences)
    return rises


def _columns_within(x: Array, distance: float) -> int:
    """Largest number of columns within a distance on one side, from 1 to a bound."""
    inside = np.searchsorted(x, x + distance, side="right") - np.arange(x.size) - 1
    return int(np.clip(np.max(inside), 1, _MOST_COLUMNS))


# Largest number of windows, by the number of axes.
_MOST_WINDOWS = {1: 8, 2: 5}

# Relative rise above the largest corrected field that does not need a further window.
_NEGLIGIBLE = 1e-3


# Smallest number of columns of a window on either side of its peak; and the largest, by the number of axes.
_LEAST_COLUMNS = 3
_MOST_WINDOW_COLUMNS = {1: 200, 2: 16}

# Steps in which the degree is raised in a window, relative change of the field at which this ends, and
# largest degree in a window.
_DEGREE_STEP = 4
_SETTLED = 1e-3
_MOST_DEGREE = 48

# Error of the columns over its change when their distances are halved. Linear elements have errors of second
# order, of which a quarter remains: 4/3. The walls between the columns are not known: a quarter more.
_HALVED = 5.0 / 3.0

# Relative error of the largest field, from the degree, above which the degree is raised.
TOLERANCE = 5e-3


# Field problem of a line contact or of a point contact.
ProblemT = TypeVar("ProblemT", bound="GapProblem")
FieldT = TypeVar("FieldT", bound=GapField)


@dataclass(frozen=True)
class StrengthError:
    """Estimated relative error of the largest field strength of a gap."""

    # by_degree and by_columns: part from the polynomial degree across the gap, and part from the spacing of
    # the columns.
    by_degree: float
    by_columns: float
    # Polynomial degree at which the first part is below ``TOLERANCE``, as far as the estimate shows.
    degree: int
    total_there: float  # both parts at that degree

    @property
    def total(self) -> float:
        """Sum of both parts, dimensionless."""
        return self.by_degree + self.by_columns


def strength_error(
    problem: ProblemT, strength: Array, solve: Callable[[ProblemT], GapField]
) -> StrengthError | None:
    """Estimate the error of the largest field strength of a solved field problem. ``strength``, largest field
    strength of each column of the solution [V/m], shape (nx,) or (nx, ny). Returns the estimate; None if a
    finer solution in a window does not converge.

    In a window, the degree is raised until the field settles; then the distances of the columns are halved.
    The magnitudes of both changes are added. The first window lies around the largest field. The next one
    lies where the field of first order, which does not depend on the degree, promises the highest field.
    This goes on until no other place promises more than the largest corrected field, or to a number of
    windows; then the best promise counts as error. A lower place counts with the part of its rise by which
    it exceeds the largest field.
    """
    try:
        return _error_of(problem, strength, solve)
    except ConvergenceError:
        return None


def _error_of(problem: ProblemT, strength: Array, solve: Callable[[ProblemT], GapField]) -> StrengthError:
    largest = float(np.max(strength))
    degrees: Sequence[int] = range(problem.degree, _MOST_DEGREE + 1, _DEGREE_STEP)
    first, *left = places(problem, strength)
    tried: list[tuple[Place, StrengthError]] = []
    worst, highest = StrengthError(0.0, 0.0, problem.degree, 0.0), largest
    place: Place | None = first
    while place is not None:
        error, degrees = _peak_error(_Window.around(problem, place.column), degrees, solve)
        tried.append((place, error))
        corrected = place.strength * (1.0 + error.total)
        if corrected > highest:
            highest = corrected
            part = (corrected / largest - 1.0) / error.total
            worst = replace(error, by_degree=part * error.by_degree, by_columns=part * error.by_columns)
        place = max(left, key=lambda candidate: _promise(candidate, tried), default=None)
        excess = 0.0 if place is None else _promise(place, tried) / highest - 1.0
        if place is None or excess <= _NEGLIGIBLE:
            break
        if len(tried) == _MOST_WINDOWS[strength.ndim]:
            missed = excess * highest / largest
            return replace(worst, by_degree=worst.by_degree + missed, total_there=worst.total_there + excess)
        left.remove(place)
    return worst


def _promise(place: Place, tried: Sequence[tuple[Place, StrengthError]]) -> float:
    """Field strength that a finer solution may have at a place [V/m].

    It lacks the same share of the rise of first order as places that lack at least half as much. The error
    by the columns is at least the error of the other places.
    """
    shares = [
        error.total / other.missing
        for other, error in tried
        if other.missing > 0.0 and other.missing >= 0.5 * place.missing
    ]
    share = max(shares, default=HIGHER_ORDER)
    columns = max(error.by_columns for _, error in tried)
    return place.strength * (1.0 + max(share * place.missing, columns))


@dataclass(frozen=True)
class _Window(Generic[ProblemT]):
    """Part of a field problem around a peak, and the ends of the central part whose field is compared [m]."""

    problem: ProblemT
    ends: tuple[tuple[float, float], ...]

    @classmethod
    def around(cls, problem: ProblemT, peak: tuple[int, ...]) -> _Window[ProblemT]:
        most = _MOST_WINDOW_COLUMNS[len(peak)]
        parts = around(problem, peak, reach=_REACH, least=_LEAST_COLUMNS, most=most)
        axes: dict[str, Any] = {
            name: axis[part] for (name, axis), part in zip(problem.positions.items(), parts, strict=True)
        }
        center = around(problem, peak, reach=0.5, least=1, most=most // 2)
        inside = [axis[part] for axis, part in zip(problem.positions.values(), center, strict=True)]
        return cls(
            replace(
                problem,
                lower=problem.lower[parts],
                upper=problem.upper[parts],
                permittivity=problem.permittivity[parts],
                **axes,
            ),
            tuple((float(axis[0]), float(axis[-1])) for axis in inside),
        )

    def of_degree(self, degree: int) -> _Window[ProblemT]:
        """The window with another polynomial degree."""
        return replace(self, problem=replace(self.problem, degree=degree))

    def halved(self) -> _Window[ProblemT]:
        """The window with a further column between neighbours; its walls are interpolated.

        The logarithm of the gap is interpolated, so that the walls cannot cross.
        """
        values = [
            0.5 * (self.problem.lower + self.problem.upper),
            np.log(self.problem.upper - self.problem.lower),
            self.problem.permittivity,
        ]
        changed: dict[str, Any] = {}
        for k, (name, axis) in enumerate(self.problem.positions.items()):
            fine = np.empty(2 * axis.size - 1)
            fine[::2], fine[1::2] = axis, 0.5 * (axis[:-1] + axis[1:])
            values = [with_middles(axis, value, k) for value in values]
            changed[name] = fine
        middle, gap, permittivity = values[0], np.exp(values[1]), values[2]
        changed |= {"lower": middle - 0.5 * gap, "upper": middle + 0.5 * gap, "permittivity": permittivity}
        return replace(self, problem=replace(self.problem, **changed))

    def strength(self, solve: Callable[[ProblemT], GapField]) -> float:
        """Largest field strength of the central part [V/m]."""
        strength = solve(self.problem).column_strength
        for k, (axis, (start, stop)) in enumerate(
            zip(self.problem.positions.values(), self.ends, strict=True)
        ):
            strength = np.compress((axis >= start) & (axis <= stop), strength, axis=k)
        return float(np.max(strength))


def _peak_error(
    window: _Window[ProblemT], degrees: Sequence[int], solve: Callable[[ProblemT], GapField]
) -> tuple[StrengthError, Sequence[int]]:
    """Estimated error of the field at one place, and the degrees to compare at other places.

    The first of ``degrees`` is the degree of the solution; the others are tried until the field settles.
    """
    strengths: list[float] = []
    for degree in degrees:
        strengths.append(window.of_degree(degree).strength(solve))
        if len(strengths) > 1 and abs(strengths[-1] - strengths[-2]) <= _SETTLED * strengths[-2]:
            break
    last, tried = strengths[-1], degrees[: len(strengths)]
    near = [abs(last / strength - 1.0) <= TOLERANCE for strength in strengths].index(True)
    halved = window.of_degree(tried[near]).halved().strength(solve)
    by_columns = _HALVED * abs(halved / strengths[near] - 1.0)
    error = StrengthError(
        by_degree=abs(last / strengths[0] - 1.0),
        by_columns=by_columns,
        degree=tried[near],
        total_there=abs(last / strengths[near] - 1.0) + by_columns,
    )
    return error, sorted({degrees[0], tried[near], tried[-1], *degrees[len(tried) :]})


def with_error(problem: ProblemT, solve: Callable[[ProblemT], FieldT]) -> FieldT:
    """Solve a field problem with as high a degree as its largest field needs, and estimate the error. Returns
    the field with its ``strength_error`` and ``sufficient_degree``; both are None for a problem that is not
    ``plain``, and where the estimate did not converge.
    """
    field = solve(problem)
    if not problem.plain:
        return field
    error = strength_error(problem, field.column_strength, solve)
    most = problem.degree if problem.most_degree is None else problem.most_degree
    if error is not None and problem.degree < min(error.degree, most):
        problem = replace(problem, degree=min(error.degree, most))
        field = solve(problem)
        if problem.degree == error.degree:
            return replace(field, strength_error=error.total_there, sufficient_degree=error.degree)
        error = strength_error(problem, field.column_strength, solve)
    if error is None:
        return field
    return replace(field, strength_error=error.total, sufficient_degree=error.degree)
