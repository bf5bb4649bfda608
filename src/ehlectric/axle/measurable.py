"""Quantities of an axle that a user can measure, and the model that computes them at many inputs.

The capacitance of an element follows the error of its films, as in the probabilities of an axle.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle.axle_verdict import axle_verdict
from ehlectric.axle.solution import (
    AxleSolution,
    elements_of,
    solve_elements,
    solve_films,
)
from ehlectric.axle.uncertainty import (
    AREA,
    FILMS_OF,
    SUMMITS,
    AxleDesign,
    ElementChance,
    UncertainKey,
    has_chance,
    least_margins,
)
from ehlectric.bearing import (
    MARGIN,
    OF_TABLE,
    Change,
    Names,
    is_factor,
)
from ehlectric.cases.axle_case import AxleCase, changed_bearings
from ehlectric.cases.axle_keys import OF_ELEMENTS, OF_SHAFTS
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.drive import times_strength
from ehlectric.gear import reference_area_of
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.verdict import Verdict

# Heights of the summits of all bearings.
_SUMMIT_HEIGHT = "summit_height"
_OF_BEARINGS = f"bearings.{_SUMMIT_HEIGHT}"


@dataclass(frozen=True)
class _Probable:
    """Distribution of the margin of an axle, of which only the chance is known."""

    chance: Chance
    ranks_inputs: bool = True  # the calibration itself chooses the next measurement
    elements: tuple[ElementChance, ...] = ()
    deciding: None = None


@dataclass(frozen=True)
class AxleModel:
    """Axle with films from the atlas or from formulas, at many values of its uncertain inputs."""

    case: AxleCase  # axle of the file
    design: AxleDesign
    # Rows that are computed, by the operating point and the inputs from 0 to 1.
    _known: dict[Any, dict[bytes, Mapping[str, float]]] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, case: AxleCase) -> AxleModel:
        """Model of an axle file. Raises InputError where an element has no film."""
        films = solve_films(_quick(case))
        return cls(case, AxleDesign.of(elements_of(films), films))

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the measurable quantities, each with the key of its element or shaft."""
        return (
            *(f"elements.{key}.{name}" for key in self.case.keys_of_elements() for name in OF_ELEMENTS),
            *(f"shafts.{key}.{name}" for key in self.case.keys_of_shafts() for name in OF_SHAFTS),
        )

    @property
    def candidates(self) -> tuple[str, ...]:
        """Quantities that can be compared as the next to measure."""
        return self.quantities

    @property
    def changes(self) -> tuple[Change, ...]:
        """Uncertain inputs of the file."""
        return (*(each.change for each in self.design.computed), *self.design.factors)

    def names(self) -> tuple[Names, ...]:
        """Names of the uncertain inputs, in the order of the columns."""
        return tuple(self.design.names())

    def values(self, place: int, parts: Array) -> Array:
        """Values of an input at parts of its range, SI units, shape (n,)."""
        name = self.names()[place]
        for change in self.changes:
            if change.key == name.key:
                return np.array([UncertainKey(change).value(part) for part in parts.tolist()])
        error = self.design.films[[*FILMS_OF.values()].index(name.key)]
        films: Array = 1.0 + error * (2.0 * parts - 1.0)
        return films

    def numbers(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Measurable quantities, or the margin of the first element, at p operating points and n values of
        the k inputs.

        ``at``, inputs from 0 to 1, shape (n, k); ``points``, inputs of the operating points by key, SI units.
        Returns quantities in SI units, shape (n, p): NaN without a result, and breakdown voltages of 0 where
        summits touch or the element conducts.
        """
        rows = [self._rows(at, point) for point in points]
        return {
            name: np.array([[row.get(name, math.nan) for row in of_point] for of_point in rows]).T
            for name in quantities
        }

    def _rows(self, at: Array, point: Mapping[str, float]) -> list[Mapping[str, float]]:
        """Quantities and margins at n values of the inputs, none without a result; each is computed once."""
        of_point = self._known.setdefault(tuple(sorted(point.items())), {})
        keys = [row.tobytes() for row in at]
        new = [
            place
            for key, place in {key: place for place, key in enumerate(keys)}.items()
            if key not in of_point
        ]
        strength = np.exp(np.sum(self.design.log_factors(at[new]), axis=-1)).tolist()
        solutions = self.design.solutions(at[new], point)
        for place, solution, factor in zip(new, solutions, strength, strict=True):
            of_point[keys[place]] = {} if solution is None else self._row(solution, factor)
        return [of_point[key] for key in keys]

    def _row(self, solution: AxleSolution, strength: float) -> dict[str, float]:
        """Quantities and margin of an axle whose strength is a factor times as large."""
        return {
            **self._of_elements(solution, strength),
            **self._of_shafts(solution),
            MARGIN: _margin(solution, strength),
        }

    def _of_elements(self, solution: AxleSolution, strength: float) -> dict[str, float]:
        """Quantities of all elements by their names."""
        values: dict[str, float] = {}
        for key, element in zip(self.case.keys_of_elements(), solution.elements, strict=True):
            voltage = math.nan if element.breakdown_voltage is None else strength * element.breakdown_voltage
            if element.touching or element.state == CONDUCTS:
                voltage = 0.0
            numbers = {
                "capacitance": element.capacitance,
                "breakdown_voltage": voltage,
                "conducting_share": element.contact_time_share,
            }
            values |= {f"elements.{key}.{name}": number for name, number in numbers.items()}
        return values

    def _of_shafts(self, solution: AxleSolution) -> dict[str, float]:
        """Voltages of all shafts after an edge of the source [V] by their names."""
        potentials = solution.potentials()
        return {
            f"shafts.{key}.voltage": abs(potentials[name]) for key, name in self.case.keys_of_shafts().items()
        }

    def errors(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Standard deviations of quantities due to interpolation, shape (n, p): none."""
        return dict.fromkeys(quantities, np.zeros((len(at), len(points))))

    def updated(self, values: Mapping[str, float], ranges: Mapping[str, tuple[float, float]]) -> AxleCase:
        """Axle with other values of some inputs, by the keys of the columns, and other ranges of them."""
        changes, bearings = dict[str, Any](), dict[int, dict[str, float]]()
        for each in (*self.design.computed, *(UncertainKey(change) for change in self.design.factors)):
            key = each.change.key
            if key not in values:
                continue
            for number, stepped in _steps(self.design.case, each, values[key]).items():
                bearings.setdefault(number, {}).update(stepped)
            if not each.bearings or key == _OF_BEARINGS:
                changes |= _changes(self.design.case, each.change, values[key])
        kept = {entry.key: [entry.low, entry.high] for entry in self.case.ranges or ()}
        kept |= {key: [*ends] for key, ends in ranges.items() if not is_factor(key)}
        alone = self.case.model_copy(update={"measured": None, "ranges": None}).replace(changes)
        case = changed_bearings(alone, bearings)
        if all(_SUMMIT_HEIGHT in bearing.keys for bearing in case.bearing):
            kept.pop(_OF_BEARINGS, None)
        return AxleCase.from_dict(case.to_dict() | ({"ranges": kept} if kept else {}))

    def verdict(self, case: AxleCase, chance: Chance | None) -> Verdict:
        """Verdict on an axle with films that are not solved, with the probability of breakdown."""
        solution = solve_elements(_quick(case))
        return axle_verdict(solution, None if chance is None else _Probable(chance))


def _quick(case: AxleCase) -> AxleCase:
    """Axle whose films are not solved, without measured values and remedies."""
    alone = case.model_copy(update={"measured": None, "remedies": ()})
    return alone.quick


def _margin(solution: AxleSolution, strength: float) -> float:
    """Margin of the first element; NaN without a strength."""
    if not has_chance(solution.case):
        return math.nan
    voltages, limits = solution.voltages_and_limits()
    return float(least_margins(voltages[np.newaxis], times_strength(limits, strength)[np.newaxis])[0])


def _steps(case: AxleCase, each: UncertainKey, value: float) -> dict[int, dict[str, float]]:
    """Values of the keys of single bearings by their number, at a value of an input.

    Heights of summits are a key of all bearings, except of bearings with another height.
    """
    stepped = each.values(value)
    if each.change.key != _OF_BEARINGS:
        return stepped
    nominal = {_SUMMIT_HEIGHT: each.change.value}
    return {
        number: stepped.get(number, {_SUMMIT_HEIGHT: 0.0})
        for number, bearing in enumerate(case.bearing)
        if _SUMMIT_HEIGHT in bearing.keys or each.bearings.get(number) != nominal
    }


def _changes(case: AxleCase, change: Change, value: float) -> dict[str, Any]:
    """Changes of an axle that give an input another value, by key; in each gear file by the same step."""
    if change.key == OF_TABLE:
        return {OF_TABLE: [value * strength for strength in value_at(case.to_dict(), OF_TABLE)]}
    pairs = [mesh.pair for mesh in case.mesh]
    if change.key == SUMMITS:
        heights = [pair.gear.summit_height + value - change.value for pair in pairs]
        return {f"mesh.{number}.gear.summit_height": height for number, height in enumerate(heights, 1)}
    if change.key == AREA:
        areas = [reference_area_of(pair) * value / change.value for pair in pairs]
        return {f"mesh.{number}.gear.contact.reference_area": area for number, area in enumerate(areas, 1)}
    return {change.key: value}
