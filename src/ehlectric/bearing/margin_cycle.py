"""Margins over a duty cycle, of a bearing or a gear mesh: rows, probabilities, and the worst stretches."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.bearing.cycle_rows import (
    LEFT_OUT,
    MOST_STRETCHES,
    STANDSTILL,
    CycleRows,
    Written,
    duty_csv,
    edges_of,
    stretches_of,
    written_columns,
)
from ehlectric.bearing.duty_points import between_places, spread_places
from ehlectric.cases.defaults import QUICK
from ehlectric.cases.measurements import ColumnBook
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.quantities.formats import scale_of, speed_text
from ehlectric.quantities.lubrication_states import FREQUENT, FULL_FILM_LIMIT
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.statement import Statement
from ehlectric.quantities.units import RPM
from ehlectric.readable import ratio_text, readable
from ehlectric.runtime.display import Values
from ehlectric.runtime.files import Content

# Speed below which a shaft stands still: sensors and their filters read such speeds at rest [rad/s].
LEAST_SPEED = 0.1 * RPM

# Rows with a margin, and as many with touching surfaces, at which the probability of breakdown is computed,
# and points of the uncertain inputs at each of them, a power of 2.
NODES, SAMPLES_OF_ROW = 32, 128

# Least and largest probability of a row without a result.
_NOT_KNOWN = (0.0, 1.0)

# Units in which inputs are written, by their SI units.
_SHOWN = {"K": "°C", "N": "N", "V": "V", "N*m": "N m"}

MAYBE = "not negative or NaN"

# Difference of bounds of a probability up to which texts show one number.
_ROUNDING = 5e-4


@dataclass(frozen=True, eq=False, repr=False)
class MarginRows(CycleRows):
    """Rows of a duty cycle with lambda ratio and margin, SI units; NaN where a row has no value."""

    temperature: Array = field(metadata=stored("duty_row", "K", "positive"))
    lambda_ratio: Array = field(metadata=stored("duty_row", "", MAYBE))
    capacitance: Array = field(metadata=stored("duty_row", "F", MAYBE))
    margin: Array = field(metadata=stored("duty_row", "", MAYBE))
    # Probability of breakdown within the uncertain inputs, from 0 to 1: of a margin below 1, or surfaces that
    # touch. It is 0 without a voltage, and NaN at a standstill and where it is not known.
    breakdown_probability: Array = field(metadata=stored("duty_row", "", MAYBE))
    state: Array = field(metadata=stored("duty_row", "", "whole"))  # number of the state in ``STATES``
    # Smallest and largest probability that rows and points without a result allow; NaN at a standstill. None
    # of a result of an earlier version.
    breakdown_probability_low: Array | None = field(
        default=None, kw_only=True, metadata=stored("duty_row", "", MAYBE, needed=False)
    )
    breakdown_probability_high: Array | None = field(
        default=None, kw_only=True, metadata=stored("duty_row", "", MAYBE, needed=False)
    )

    @property
    def has_margin(self) -> bool:
        """Whether any row has a margin."""
        return bool(np.any(np.isfinite(self.margin)))

    @property
    def turns(self) -> Mask:
        """Rows at which the shaft turns, shape (n,)."""
        turns: Mask = self.state != STANDSTILL
        return turns

    @property
    def touching(self) -> Mask:
        """Rows with touching surfaces under a voltage, shape (n,)."""
        raise NotImplementedError

    @property
    def breaks(self) -> Mask:
        """Rows at which breakdown is expected under a voltage: a margin below 1, or touching surfaces."""
        breaks: Mask = (self.margin < 1.0) | self.touching
        return breaks

    @property
    def probabilities(self) -> tuple[Array, Array, Array]:
        """Probability of breakdown of each row, and its bounds, NaN at a standstill; shape (n,)."""
        middle, low, high = (
            self.breakdown_probability,
            self.breakdown_probability_low,
            self.breakdown_probability_high,
        )
        return middle, middle if low is None else low, middle if high is None else high


@dataclass(frozen=True)
class Stretch:
    """Stretch of a duty cycle with a margin below 1, or without margins with a lambda ratio below 3."""

    start: float = field(metadata=number())  # [s]
    end: float = field(metadata=number())  # [s]
    time: float = field(metadata=number())  # of the least margin, or of the least lambda ratio [s]
    least_margin: float | None = field(metadata=number())
    lambda_ratio: float = field(metadata=number())  # at this time
    speed: float = field(metadata=number())  # at this time [rad/s]
    why: str = field(metadata=number("text"))  # input that causes it, or that no single input does


Rows = TypeVar("Rows", bound=MarginRows)


@dataclass(frozen=True, eq=False, repr=False)
class MarginCycle(Values, Generic[Rows]):
    """Result of a duty cycle with margins.

    Attributes
    ----------
    rows : MarginRows
        Inputs, lambda ratio, margin and state of each row.
    stretches : tuple of Stretch
        The worst stretches, at most ten, the worst first.
    source : str
        File of the duty cycle.
    contacts : str
        "atlas" or "formula": how the films of the cycle were computed.
    points : int
        Number of operating points that were solved.
    interpolation_error : float or None
        Largest relative error of interpolated values; None where every point was solved.
    warnings : tuple of ResultWarning
        Warnings about the file and about rows that are not computed.
    """

    # SI unit and meaning of the columns of duty.csv, in their order.
    written: ClassVar[Mapping[str, Mapping[str, str]]]

    rows: Rows
    stretches: tuple[Stretch, ...]
    source: str = field(metadata=number("text"))
    contacts: str = field(metadata=number(QUICK))
    points: int = field(metadata=number("whole"))
    interpolation_error: float | None = field(metadata=number())

    @property
    def low(self) -> Mask:
        """Rows with a margin below 1, shape (n,)."""
        return self.rows.margin < 1.0

    @property
    def breakdown_probability(self) -> float | None:
        """Probability of breakdown at a random time of the cycle; None where no row has one.

        A standstill does not count as breakdown, and a row that is not known does not count at all.
        """
        return self._means(whole=True)[0]

    @property
    def turning_breakdown_probability(self) -> float | None:
        """Probability of breakdown at a random time at which the shaft turns; None where no row has one."""
        return self._means(whole=False)[0]

    def _means(self, *, whole: bool) -> tuple[float | None, float | None, float | None]:
        """Probability of breakdown and its bounds, means over the whole cycle or the time in which the shaft
        turns; None where no row has one.
        """
        rows = self.rows
        if not np.any(np.isfinite(rows.breakdown_probability)):
            return None, None, None
        still = 0.0 if whole else math.nan
        means = []
        for values in rows.probabilities:
            counted = np.where(rows.turns, values, still)
            known = np.isfinite(counted)
            means.append(float(np.average(counted[known], weights=rows.duration[known])))
        return means[0], means[1], means[2]

    @property
    def judges_breakdown(self) -> bool:
        """Whether breakdown is known at any row."""
        return self.breakdown_probability is not None

    @property
    def statement(self) -> Statement | None:
        """Statement on the cycle: probability of breakdown, share of time with breakdown; None without.

        A cycle of which no row has a result has a statement of its own.
        """
        turning = self.rows.state[self.rows.turns]
        if turning.size and np.all(turning == LEFT_OUT):
            return Statement.of("cycle-not-computed")
        probability, low, high = self._means(whole=True)
        if probability is None or low is None or high is None:
            return None
        share = self.rows.share(self.rows.breaks)
        return Statement.of("cycle", probability=(probability, low, high), share=share)

    def _probabilities(self) -> dict[str, float | None]:
        """Probabilities of breakdown with their bounds by their keys."""
        ends = ("", "_low", "_high")
        return {
            f"{name}{end}": value
            for name, whole in (("turning_breakdown_probability", False), ("breakdown_probability", True))
            for end, value in zip(ends, self._means(whole=whole), strict=True)
        }

    def about(self) -> dict[str, Any]:
        """Values about the cycle itself by the keys of the table ``duty`` of summary.json."""
        return {
            "source": self.source,
            "rows": self.rows.time.size,
            "duration": float(np.sum(self.rows.duration)),
            "contacts": self.contacts,
            "points": self.points,
            "interpolation_error": self.interpolation_error,
        }

    def margins(self) -> dict[str, float | None]:
        """Values of breakdown and margins by the keys of the table ``duty`` of summary.json."""
        rows = self.rows
        worst = int(np.nanargmin(rows.margin)) if rows.has_margin else None
        return {
            "breakdown_share": rows.share(rows.breaks) if self.judges_breakdown else None,
            "low_margin_share": rows.share(self.low) if rows.has_margin else None,
            **self._probabilities(),
            "least_margin": None if worst is None else float(rows.margin[worst]),
            "least_margin_time": None if worst is None else float(rows.time[worst]),
        }

    def bounds_warnings(self) -> Iterator[ResultWarning]:
        """Warning if only bounds of the probability of breakdown are known."""
        known = self._probabilities()
        low, high = (known[f"breakdown_probability_{end}"] for end in ("low", "high"))
        if low is not None and high is not None and high - low > _ROUNDING:
            yield ResultWarning.of("probability-bounded", "duty", low=100.0 * low, high=100.0 * high)

    def contents(self) -> dict[str, Content]:
        """Content of duty.csv by its name."""
        return duty_csv(self.columns())

    def columns(self) -> dict[str, Written]:
        """Columns of the rows with their units, without columns in which no row has a value."""
        names = {each.name for each in fields(self.rows)}
        columns = {name: getattr(self.rows, name) for name in self.written if name in names}
        given = {name: values for name, values in columns.items() if values is not None}
        known = {name: values for name, values in given.items() if np.any(np.isfinite(values))}
        return written_columns(known, self.written)


def moves(speed: Array) -> Mask:
    """Whether shafts turn at some speeds [rad/s]."""
    return np.abs(speed) >= LEAST_SPEED


def row_probabilities(
    rows: MarginRows,
    driven: Mask,
    groups: Mapping[str, tuple[Mask, Array]],
    chances: Callable[[IntArray], Array],
) -> Array:
    """Probability of breakdown of each row within the uncertain inputs, and its bounds, shape (n, 3).

    They are computed at rows that are spread over their coordinates, and interpolated between them.

    ``driven``, rows that turn under a voltage; ``groups``, rows between which probabilities are interpolated,
    shape (n,), and their coordinates, shape (n, d), by name; ``chances``, probability and bounds at m rows by
    their places, shape (m, 3), NaN for none.
    """
    probability = np.full((rows.time.size, 3), np.nan)
    for within, at in groups.values():
        known = np.flatnonzero(within)
        if known.size:
            nodes = spread_places(at[known], NODES)
            probability[known] = between_places(at[known][nodes], chances(known[nodes]), at[known])
    if np.any(np.isfinite(probability)):
        probability[rows.turns & ~driven] = 0.0
        probability[np.ix_(driven & np.isnan(probability[:, 0]), [1, 2])] = _NOT_KNOWN
    return probability


# Quantities of rows by name, from the inputs of the rows by column.
RowValues = Callable[[Mapping[str, Array]], Mapping[str, Array]]


def worst_stretches(
    rows: MarginRows,
    inputs: Mapping[str, Array],
    values: RowValues,
    book: ColumnBook,
    without: str = FREQUENT.name,
) -> Iterator[Stretch]:
    """Worst stretches of a cycle, with the least margins, or without margins with the least lambda ratios.

    ``inputs``, inputs of the rows by column; ``values``, lambda ratio and margin of rows from these;
    ``without``, text for a row with a lambda ratio and no margin.
    """
    name, limit = ("margin", 1.0) if rows.has_margin else ("lambda_ratio", FULL_FILM_LIMIT)
    measure, edges = getattr(rows, name), edges_of(rows.time)
    spans = [
        (first, after, first + int(np.argmin(measure[first:after])))
        for first, after in stretches_of(measure < limit)
    ]
    spans = sorted(spans, key=lambda span: measure[span[2]])[:MOST_STRETCHES]
    causes = _Causes(rows, inputs, values, book, without)
    reasons = causes.of(name, [worst for *_, worst in spans])
    for (first, after, worst), why in zip(spans, reasons, strict=True):
        yield Stretch(
            start=float(edges[first]),
            end=float(edges[after]),
            time=float(rows.time[worst]),
            least_margin=float(rows.margin[worst]) if rows.has_margin else None,
            lambda_ratio=float(rows.lambda_ratio[worst]),
            speed=float(rows.speed[worst]),
            why=why,
        )


@dataclass(frozen=True)
class _Causes:
    """Inputs that make margins or lambda ratios low."""

    rows: MarginRows
    inputs: Mapping[str, Array]
    values: RowValues
    book: ColumnBook
    without: str

    def of(self, name: str, places: list[int]) -> list[str]:
        """Input that makes a margin or a lambda ratio low at each of some rows: the one whose mean over the
        cycle would raise it most. The mean of absolute values gets the sign of the row.
        """
        turning = moves(self.rows.speed)
        means = {
            column: float(np.average(np.abs(given[turning]), weights=self.rows.duration[turning]))
            for column, given in self.inputs.items()
            if places and np.ptp(given[turning]) > 0.0
        }
        if not means:
            return [""] * len(places)
        changed = {column: np.repeat(given[places], len(means)) for column, given in self.inputs.items()}
        for k, (column, mean) in enumerate(means.items()):
            changed[column][k :: len(means)] = np.copysign(mean, self.inputs[column][places])
        raised_to = self.values(changed)
        results, ratios = (raised_to[key].reshape(len(places), len(means)) for key in (name, "lambda_ratio"))
        texts = []
        for place, row, ratio in zip(places, results, ratios, strict=True):
            best = int(np.argmax(np.nan_to_num(row, nan=-1.0)))
            column = list(means)[best]
            raised = _raised(float(row[best]), self.without if np.isfinite(ratio[best]) else "no result")
            texts.append(self._reason(column, abs(float(self.inputs[column][place])), means[column], raised))
        return texts

    def _reason(self, column: str, value: float, mean: float, raised: str) -> str:
        """Text: input of a row, and the margin or the lambda ratio that it would have with the mean of the
        input.
        """
        name = column.replace("_", " ").replace("common mode", "common-mode")
        unit = self.book.columns[column].unit
        return f"at {name} {_text(unit, value)} ({raised} at the mean of {_text(unit, mean)})"


def _raised(value: float, without: str) -> str:
    """Text of a margin or a lambda ratio, or why there is none.

    >>> _raised(1.7, ""), _raised(math.nan, "no result")
    ('1.70', 'no result')
    """
    return ratio_text(value) if math.isfinite(value) else without


def _text(unit: str, value: float) -> str:
    """Input in an SI unit with the unit in which it is shown.

    >>> _text("rad/s", 50.0 * RPM), _text("K", 300.0)
    ('50 rpm', '26.85 °C')
    """
    if unit == "rad/s":
        return speed_text(value)
    scale = scale_of(_SHOWN[unit])
    return f"{readable(scale.of(value), 4)} {scale.unit}"
