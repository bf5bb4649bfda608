"""Error of the internal geometry that is estimated from load ratings, by leaving out each bearing in turn.

Each bearing of the library with load ratings is estimated from its designation alone, with the constants of
the estimate fitted to the others. Ball bearing 209 of Hamrock's book has no ratings, and gets those of the
6209 of another maker, as a user would give them. Writes docs/data/estimated_bearings.csv.

python -m benchmarks.estimated_bearings
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import Any

from ehlectric.bearing.bearing_discharges import breakdown_of
from ehlectric.bearing.solution import capacitance
from ehlectric.bearing.solving import solution_of
from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.library.bearing_catalogue import CatalogueBearing, bearing_catalogue
from ehlectric.cases.library.estimated_bearings import (
    EstimatedGeometry,
    Rules,
    SeriesBearing,
    estimated_geometry,
    series,
)

TABLE = Path(__file__).parents[1] / "docs" / "data" / "estimated_bearings.csv"

# Designation whose ratings a bearing without its own gets.
OTHER_MAKER = {"209-hamrock": "6209"}

# Gaps between rollers over their diameter that are tried.
_GAPS = [0.01 * step for step in range(5, 51)]

# Point of operation at which capacitance and breakdown voltage are compared; the load is 5 % of C_0.
_LOAD = 0.05
_OPERATION: dict[str, Any] = {
    "inner_speed": "3000 rpm",
    "temperature": "70 degC",
    "composite_rq": "0.05 um",
    "summit_height": 0.0,
}
_OIL = {
    "base": "paper",
    "temperature": {"iso_vg": 46, "viscosity_index": 100, "density_15": "870 kg/m^3"},
    "relative_permittivity": 2.2,
}


@dataclass(frozen=True)
class LeftOut:
    """Bearing of the library, and the estimate of it that the others give."""

    bearing: CatalogueBearing
    of_series: SeriesBearing
    estimate: EstimatedGeometry

    @property
    def deviations(self) -> dict[str, float]:
        """Relative deviations of the estimated number and dimensions from those of the library."""
        names = ("elements", "element_diameter", "pitch_diameter", "roller_length")
        pairs = [(name, getattr(self.estimate, name), getattr(self.bearing, name)) for name in names]
        return {name: own / true - 1.0 for name, own, true in pairs if true is not None}


def left_out() -> Iterator[LeftOut]:
    """Bearings of the library, each estimated with constants that are fitted to the others."""
    every = bearing_catalogue()
    for bearing in every:
        name = OTHER_MAKER.get(bearing.name, bearing.name)
        if name in series():
            rules = fitted([other for other in every if other is not bearing])
            of_series = series()[name]
            yield LeftOut(bearing, of_series, estimated_geometry(of_series, rules=rules))


def fitted(bearings: Sequence[CatalogueBearing]) -> Rules:
    """Constants that suit bearings of known geometry: the median ratio of pitch circle and mean diameter, and
    the middle of those gaps between rollers that give the most of their numbers.
    """
    balls = [one for one in bearings if one.roller_length is None]
    rollers = [one for one in bearings if one.roller_length is not None]
    pitch = median(2.0 * one.pitch_diameter / (one.bore + one.outer_diameter) for one in balls)
    misses = {gap: sum(_miss(one, gap) for one in rollers) for gap in _GAPS}
    best = [gap for gap, miss in misses.items() if miss == min(misses.values())]
    return Rules(pitch, median(best))


def _miss(bearing: CatalogueBearing, gap: float) -> int:
    """Rollers by which the number with a gap is wrong."""
    number = math.pi * bearing.pitch_diameter / ((1.0 + gap) * bearing.element_diameter)
    return abs(math.floor(number) - bearing.elements)


@dataclass(frozen=True)
class Row:
    """Row of the table: diameters in mm, deviations in per cent."""

    bearing: str
    known: str  # kind of the source of the known geometry
    elements: int
    estimated_elements: int
    diameter: float
    estimated_diameter: float
    pitch_error: float
    length_error: float | None
    capacitance_error: float
    breakdown_error: float


def rows() -> Iterator[Row]:
    """Rows of the table, with capacitance and breakdown voltage by the formulas of films."""
    for one in left_out():
        known, own = (_electric(one, estimate) for estimate in (None, one.estimate))
        off = {name: round(100.0 * value, 1) for name, value in one.deviations.items()}
        yield Row(
            one.bearing.name,
            str(one.bearing.internal_kind),
            one.bearing.elements,
            one.estimate.elements,
            round(1e3 * one.bearing.element_diameter, 3),
            round(1e3 * one.estimate.element_diameter, 3),
            off["pitch_diameter"],
            off.get("roller_length"),
            *(round(100.0 * (new / old - 1.0), 1) for new, old in zip(own, known, strict=True)),
        )


def _electric(one: LeftOut, estimate: EstimatedGeometry | None) -> tuple[float, float]:
    """Capacitance [F] and first breakdown voltage [V] of a bearing with its known or estimated geometry."""
    load = f"{_LOAD * one.of_series.static:g} N"
    table = library.bearing(one.bearing.name) | _OPERATION | {"radial_load": load}
    if one.bearing.roller_length is not None:
        table["profile"] = "logarithmic"
    if one.bearing.contact_angle:
        table["axial_load"] = load
    elif "radial_clearance" not in table:
        table["clearance_class"] = "CN"
    if estimate is not None:
        sizes = {key: value for key, value in asdict(estimate).items() if value is not None}
        table |= sizes
    case = {"bearing": table, "lubricant": _OIL, "contacts": "formula"}
    case["discharge"] = {"dielectric_strength": "15 V/um"}
    solution = solution_of(BearingCase.from_dict(case))
    breakdown = breakdown_of(solution)
    assert breakdown is not None
    return float(capacitance(solution)), float(breakdown.first_break)


def main() -> None:
    """Write the table, and print the largest deviations."""
    found = [asdict(row) for row in rows()]
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(found[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(found)
    for name in ("pitch_error", "length_error", "capacitance_error", "breakdown_error"):
        values = [row[name] for row in found if row[name] is not None]
        print(f"{name}: {min(values):+.1f} to {max(values):+.1f} %")


if __name__ == "__main__":
    main()
