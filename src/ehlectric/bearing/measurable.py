"""Quantities of a solved bearing that a user can measure, and the model that computes them at many inputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.bearing_discharges import (
    bearing_voltage_ratio,
    breakdown_of,
    first_margin,
    shaft_voltage,
)
from ehlectric.bearing.bearing_touching import duty_of
from ehlectric.bearing.impedance import meter_capacitance, shaft_capacitance
from ehlectric.bearing.many_points import gathered, many_of, solved_parts
from ehlectric.bearing.margin import analyse_margin, margin_and_lambda
from ehlectric.bearing.quick_contacts import quick_case
from ehlectric.bearing.solution import BearingSolution, conducts, film_error
from ehlectric.bearing.solving import quick_solution
from ehlectric.bearing.uncertain_inputs import OF_TABLE, Change
from ehlectric.bearing.uncertainty import FILMS, Design, Names
from ehlectric.bearing.verdict_rule import bearing_verdict
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.verdict import Verdict

# Quantity of a solution, shape (...); None where no point has it.
Quantity = Callable[[BearingSolution], Numbers | None]


def _first(solution: BearingSolution) -> Numbers | None:
    breakdown = breakdown_of(solution)
    return None if breakdown is None else breakdown.shaft_first_break


def _ring_to_ring(solution: BearingSolution) -> Numbers | None:
    breakdown = breakdown_of(solution)
    return None if breakdown is None else breakdown.shaft_ring_to_ring_breakdown


def _film(solution: BearingSolution) -> Numbers:
    """Central film thickness of the most loaded contact with the inner ring [m]."""
    ring = solution.positions[0].inner
    place = np.argmax(np.atleast_1d(ring.load), axis=-1)[..., np.newaxis]
    films = np.broadcast_to(ring.values.central_thickness, np.shape(ring.load))
    thickness: Numbers = np.take_along_axis(films, place, axis=-1)[..., 0]
    return thickness


# Quantities by their names in [measured].
MEASURABLE: Mapping[str, Quantity] = MappingProxyType(
    {
        "capacitance": meter_capacitance,
        "first_breakdown_voltage": _first,
        "breakdown_voltage": _ring_to_ring,
        "shaft_voltage": shaft_voltage,
        "bearing_voltage_ratio": bearing_voltage_ratio,
        "conducting_share": lambda solution: duty_of(solution).contact_time_share,
        "inner_ring_temperature": lambda solution: solution.conditions.inner.temperature,
        "outer_ring_temperature": lambda solution: solution.conditions.outer.temperature,
        "film": _film,
    }
)

# Names of the margin, and of the capacitance by which the voltage of a motor is divided. Both are no
# measurable quantities.
MARGIN, SHAFT_CAPACITANCE = "margin", "shaft_capacitance"

# Quantities that are 0 where surfaces touch, and quantities that are proportional to the dielectric strength.
_ACROSS_FILMS = ("first_breakdown_voltage", "breakdown_voltage", "shaft_voltage", "bearing_voltage_ratio")


_OF_STRENGTH = ("first_breakdown_voltage", "breakdown_voltage", MARGIN)


@dataclass(frozen=True)
class BearingModel:
    """Bearing with contacts from the atlas or from formulas, at many values of its uncertain inputs."""

    case: BearingCase  # case with contacts that are not solved, without ranges
    design: Design

    @classmethod
    def of(cls, case: BearingCase) -> BearingModel:
        """Model of a bearing file. Raises InputError where its contacts must be solved."""
        quick, refused = quick_case(case)
        if refused is not None:
            raise refused
        assert quick is not None
        design = Design.of_case(quick, float(film_error(quick_solution(quick))))
        return cls(quick.model_copy(update={"ranges": None, "duty": None, "measured": None}), design)

    @property
    def changes(self) -> tuple[Change, ...]:
        """Uncertain inputs of the file, in the order of the columns; the error of the films follows them."""
        return (*self.design.computed, *self.design.factors)

    def names(self) -> tuple[Names, ...]:
        """Names of the uncertain inputs, in the order of the columns."""
        known = {name.key: name for name in self.design.names()}
        return tuple(known[key] for key in (*(change.key for change in self.changes), FILMS))

    def values(self, place: int, parts: Array) -> Array:
        """Values of an input at parts of its range, SI units, shape (n,)."""
        low, high = (*(change.ends for change in self.changes), self.design.films)[place]
        return low + (high - low) * parts

    @property
    def candidates(self) -> tuple[str, ...]:
        """Quantities that can be compared as the next to measure."""
        return self.quantities

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the measurable quantities."""
        return tuple(MEASURABLE)

    def numbers(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Measurable quantities, or the margin, at p operating points and n values of the k inputs.

        ``at``, inputs from 0 to 1, shape (n, k); ``points``, inputs of the operating points by key, SI units.
        Returns quantities in SI units, shape (n, p): NaN without a result, and voltages of 0 where surfaces
        touch.
        """
        count, design = len(at), self.design
        computed: dict[str, Array] = {}
        strength, place = np.ones(count), 0
        for change in self.changes:
            low, high = change.ends
            values = low + (high - low) * at[:, place]
            if change in design.factors:
                strength = strength * values / change.value
            else:
                computed |= change.changes(values)
            place += 1
        low, high = design.films
        films = low + (high - low) * at[:, place]
        columns = self._columns(computed, points, count)
        many = many_of(self.case, columns, count * len(points))
        parts = solved_parts(many, detail="coarse", films=np.tile(films, len(points)))
        rows = gathered(
            parts,
            lambda solution: [_number(solution, name) for name in quantities],
            (len(quantities), count * len(points)),
        )
        tables = rows.reshape(len(quantities), len(points), count)
        return {
            name: (strength * table if name in _OF_STRENGTH else table).T
            for name, table in zip(quantities, tables, strict=True)
        }

    def errors(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Standard deviations of quantities due to interpolation, shape (n, p): none."""
        return dict.fromkeys(quantities, np.zeros((len(at), len(points))))

    def updated(self, values: Mapping[str, float], ranges: Mapping[str, tuple[float, float]]) -> BearingCase:
        """Case with other values of some inputs, by the keys of the columns, and other ranges of them."""
        case = self.design.case
        changes: dict[str, Any] = {}
        for change in self.changes:
            if change.key == OF_TABLE and change.key in values:
                table = case.discharge.strength_table
                assert table is not None
                changes[change.key] = [values[change.key] * strength for strength in table.strength]
            elif change.key in values:
                changes |= change.changes(values[change.key])
        kept = {entry.key: [entry.low, entry.high] for entry in case.ranges or ()}
        new = {key: [*ends] for key, ends in ranges.items() if key not in (OF_TABLE, FILMS)}
        return case.model_copy(update={"measured": None, "ranges": None}).replace(
            changes, **({"ranges": kept | new} if kept or new else {})
        )

    def verdict(self, case: BearingCase, chance: Chance | None) -> Verdict:
        """Verdict on a case with contacts that are not solved, with the probability of breakdown."""
        solution = quick_solution(case)
        return bearing_verdict(solution, analyse_margin(solution), chance)

    def _columns(
        self, computed: Mapping[str, Array], points: Sequence[Mapping[str, float]], count: int
    ) -> dict[str, Array]:
        """Inputs of all points by key, shape (p n,)."""
        given = {key for point in points for key in point}
        table = self.case.to_dict()
        columns = {}
        for key in {**computed, **dict.fromkeys(given)}:
            rows = []
            for point in points:
                value = computed.get(key)
                if key in point and value is not None:
                    value = np.asarray(at_point(key, point[key], value, float(value_at(table, key))))
                elif value is None:
                    value = np.full(count, point.get(key, value_at(table, key)))
                rows.append(value)
            columns[key] = np.concatenate(rows)
        return columns


def at_point(key: str, given: float, value: Numbers, nominal: float) -> Numbers:
    """Value of an uncertain input at an operating point, SI units, shape (...).

    It deviates from the value ``given`` for the point as much as its ``value`` from the ``nominal`` value in
    the file: a load or a torque by the same part, others by the difference.

    Examples
    --------
    >>> at_point("bearing.radial_load", 1000.0, 2200.0, 2000.0)
    1100.0
    >>> at_point("bearing.temperature", 330.0, 353.0, 343.0)
    340.0
    """
    if key.endswith(("_load", "torque")) and nominal:
        return given * value / nominal
    return given + value - nominal


def _number(solution: BearingSolution, name: str) -> Numbers | None:
    """Measurable quantity, or the margin, of a solution with points; None where no point has it."""
    touching = conducts(solution)
    if name == MARGIN:
        driven = np.all(touching) or first_margin(solution) is not None
        return margin_and_lambda(solution)[0] if driven else None
    value = {**MEASURABLE, SHAFT_CAPACITANCE: shaft_capacitance}[name](solution)
    return np.where(touching, 0.0, value) if name in _ACROSS_FILMS and value is not None else value
