"""Quantities of a gear mesh that a user can measure, and the model that computes them at many inputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import FILMS, MARGIN, OF_TABLE, Change, Names, at_point
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.table_edits import given_value
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.gear.gear_verdict import gear_verdict
from ehlectric.gear.solving import solve_gear_pair
from ehlectric.gear.uncertainty import MeshDesign, Meshes, value_within
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.verdict import Verdict

# Columns of the rows of meshes, by the names of the quantities.
_COLUMNS: Mapping[str, int] = MappingProxyType(
    {MARGIN: 0, "breakdown_voltage": 2, "conducting_share": 4, "capacitance": 5}
)


@dataclass(frozen=True)
class _Probable:
    """Distribution of the margin of a mesh, of which only the chance is known."""

    chance: Chance
    conduction_probability: float = 0.0


@dataclass(frozen=True)
class GearModel:
    """Gear pair with films from the atlas or from a formula, at many values of its uncertain inputs."""

    case: GearCase
    design: MeshDesign
    meshes: Meshes

    @classmethod
    def of(cls, case: GearCase) -> GearModel:
        """Model of a gear file."""
        quick = case.replace({"contacts": "atlas"}) if case.contacts == "solved" else case
        solution = solve_gear_pair(quick)
        design = MeshDesign.of(solution)
        return cls(quick, design, Meshes.of(solution, design.films))

    @property
    def candidates(self) -> tuple[str, ...]:
        """Quantities that can be compared as the next to measure."""
        return self.quantities

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the measurable quantities."""
        return tuple(name for name in _COLUMNS if name != MARGIN)

    @property
    def changes(self) -> tuple[Change, ...]:
        """Uncertain inputs of the file."""
        return (*self.design.computed, *self.design.factors)

    def names(self) -> tuple[Names, ...]:
        """Names of the uncertain inputs, in the order of the columns."""
        return tuple(self.design.names())

    def values(self, place: int, parts: Array) -> Array:
        """Values of an input at parts of its range, SI units, shape (n,)."""
        name = self.names()[place]
        for change in self.changes:
            if change.key == name.key:
                return np.array([value_within(change, part) for part in parts.tolist()])
        low, high = self.design.films
        return low + (high - low) * parts

    def numbers(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Measurable quantities, or the margin, at p operating points and n values of the k inputs.

        ``at``, inputs from 0 to 1, shape (n, k); ``points``, inputs of the operating points by key, SI units.
        Returns quantities in SI units, shape (n, p), NaN without a result.
        """
        strength = np.exp(np.sum(self.design.log_factors(at), axis=-1))
        table = self.case.to_dict()
        changed = [
            (_at_point(changes, point, table), films)
            for point in points
            for changes, films in self.design.changed(at)
        ]
        rows = self.meshes.rows(changed).reshape(len(points), len(at), -1)
        return {
            name: (rows[..., _COLUMNS[name]] * (strength if name in _OF_STRENGTH else 1.0)).T
            for name in quantities
        }

    def errors(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Standard deviations of quantities due to interpolation, shape (n, p): none."""
        return dict.fromkeys(quantities, np.zeros((len(at), len(points))))

    def updated(self, values: Mapping[str, float], ranges: Mapping[str, tuple[float, float]]) -> GearCase:
        """Case with other values of some inputs, by the keys of the columns, and other ranges of them."""
        case, changes = self.design.case, {}
        for change in self.changes:
            if change.key == OF_TABLE and change.key in values:
                strengths = value_at(case.to_dict(), OF_TABLE)
                changes[change.key] = [values[change.key] * strength for strength in strengths]
            elif change.key in values:
                changes |= change.changes(values[change.key])
        kept = {entry.key: [entry.low, entry.high] for entry in case.ranges or ()}
        new = {key: [*ends] for key, ends in ranges.items() if key not in (OF_TABLE, FILMS)}
        alone = case.model_copy(update={"measured": None, "ranges": None})
        return alone.replace(changes, **({"ranges": kept | new} if kept or new else {}))

    def verdict(self, case: GearCase, chance: Chance | None) -> Verdict:
        """Verdict on a case with films that are not solved, with the probability of breakdown."""
        return gear_verdict(solve_gear_pair(case), None if chance is None else _Probable(chance))


# Quantities that are proportional to the dielectric strength.
_OF_STRENGTH = ("breakdown_voltage", MARGIN)


def _at_point(
    changes: Mapping[str, Any], point: Mapping[str, float], table: Mapping[str, Any]
) -> dict[str, Any]:
    """Changes of the case at an operating point."""
    both = changes.keys() & point.keys()
    deviating = {key: at_point(key, point[key], changes[key], float(given_value(table, key))) for key in both}
    return {**changes, **point, **deviating}
