"""Sensitivity analysis of a sweep: spread of a value over its input ranges, and each input's share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.discharge.breakdown_rule import bounds_of
from ehlectric.errors import InputError
from ehlectric.quantities.former_keys import current_key
from ehlectric.quantities.lubrication_states import is_shorted
from ehlectric.runtime.files import plain
from ehlectric.sweep.axis_labels import result_keys
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import numbers_of
from ehlectric.sweep.sweep_inputs import breakdown_of

SCHEMA = "ehlectric.sensitivity/1"
QUANTILES = (0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975)
LEVEL = 0.95

# With fewer complete rows the variance and its parts cannot be estimated.
_LEAST_ROWS = 16

# A smaller relative variation of a value is rounding and the tolerance of the film solver.
_CONSTANT = 1e-9


@dataclass(frozen=True)
class Spread:
    """Distribution of a value if every input is drawn from its range."""

    samples: int  # number of samples, the solved points of A and B
    # mean, standard_deviation, minimum and maximum: moments and extremes of the samples, in SI units.
    mean: float
    standard_deviation: float
    minimum: float
    maximum: float
    # Quantiles by probability, in SI units, interpolated linearly between the samples.
    quantiles: Mapping[float, float]
    failed: int = 0  # number of further samples, which have no value
    # Smallest and largest quantile that the samples without a value allow, in SI units; None without a bound.
    quantile_bounds: Mapping[float, tuple[float | None, float | None]] = field(default_factory=dict)


@dataclass(frozen=True)
class Index:
    """Sensitivity indices of one input.

    Estimates may lie slightly outside the range from 0 to 1.
    """

    key: str
    first_order: float  # part of the variance that would disappear if this input were known exactly
    # first_order_interval and total_interval: bootstrap confidence intervals of the two indices.
    first_order_interval: tuple[float, float]
    total: float  # part of the variance that would remain if all other inputs were known exactly
    total_interval: tuple[float, float]


@dataclass(frozen=True)
class Sensitivity:
    """Spread of a value, and the sensitivity indices of all varied inputs."""

    value: str  # dotted key of the summary
    points: int
    solved: int
    # rows and used: number of rows of the design, and number of complete rows, from which the indices are
    # computed.
    rows: int
    used: int
    # Number of complete rows in which the film of at least one point must not be used (severe warning).
    doubtful: int
    spread: Spread
    indices: tuple[Index, ...]  # indices of the inputs, in the order of the varied keys
    # Part of the samples with breakdown: the breakdown voltage is below the applied voltage, or the surfaces
    # touch. None if the value is not a breakdown voltage or a margin.
    share_below_voltage: float | None
    # resamples and seed: number of bootstrap samples, and seed of their random numbers.
    resamples: int
    seed: int
    # Smallest and largest part that the samples without a result allow.
    share_below_voltage_bounds: tuple[float, float] | None = None

    @property
    def dropped(self) -> int:
        """Number of incomplete rows, in which a point is not solved or does not have the value."""
        return self.rows - self.used

    def to_dict(self) -> dict[str, Any]:
        """Contents of sensitivity.json as nested tables, in SI units."""
        spread = self.spread
        return {
            "schema": SCHEMA,
            "value": self.value,
            "points": self.points,
            "solved": self.solved,
            "rows": self.rows,
            "rows_dropped": self.dropped,
            "rows_doubtful": self.doubtful,
            "spread": asdict(spread)
            | {
                name: {f"{q:g}": value for q, value in getattr(spread, name).items()}
                for name in ("quantiles", "quantile_bounds")
            },
            "share_below_voltage": self.share_below_voltage,
            "share_below_voltage_bounds": self.share_below_voltage_bounds,
            "indices": {
                index.key: {key: value for key, value in asdict(index).items() if key != "key"}
                for index in self.indices
            },
            "bootstrap": {"level": LEVEL, "resamples": self.resamples, "seed": self.seed},
        }


def sensitivity(results: SweepResults, value: str, *, resamples: int = 1000, seed: int = 0) -> Sensitivity:
    """Spread and variance-based sensitivity indices of a value over a Sobol design. Raises InputError if the
    design is not "sobol", the value is in no summary or constant, or fewer than 16 rows are complete.

    Let m and V be the mean and variance of the value y over A and B. The first-order index of input i is
    mean((y_B - m)(y_ABi - y_A))/V (Saltelli et al. 2010, doi:10.1016/j.cpc.2009.09.018, Table 2 (b)). The
    total index is mean((y_A - y_ABi)^2)/(2 V) (Jansen 1999, doi:10.1016/S0010-4655(98)00154-4).

    The intervals lie between the 2.5 % and 97.5 % quantiles of the indices of rows drawn with replacement
    (Archer, Saltelli and Sobol 1997, doi:10.1080/00949659708811825). They assume independent rows. The rows
    of a Sobol sequence are not independent, so for smooth values the intervals are too wide.
    """
    if results.design != "sobol":
        raise InputError.worded(
            "design",
            f'got "{results.design}"; sensitivity needs a sweep of the design "sobol"',
            got=results.design,
        )
    rows, inputs = results.samples, len(results.varied)
    value = current_key(value, result_keys(results.case))
    values = numbers_of(results, value)
    pages = values.reshape(inputs + 2, rows)
    complete = np.all(np.isfinite(pages), axis=0)
    used = int(np.sum(complete))
    if used < _LEAST_ROWS:
        raise InputError.worded(
            value,
            f"{used} of {rows} rows of the design are complete; sensitivity needs at least {_LEAST_ROWS}",
            got=used,
            takes=f"at least {_LEAST_ROWS}",
        )
    drawn = np.isfinite(values[: 2 * rows])
    samples = values[: 2 * rows][drawn]
    if np.ptp(samples) <= _CONSTANT * np.max(np.abs(samples)) or not np.ptp(pages[:2, complete]):
        raise InputError.worded(
            value,
            f"is {samples[0]:g} in all samples; sensitivity needs a value that varies",
            takes="a value that varies",
        )
    a, b, mixed = pages[0, complete], pages[1, complete], pages[2:, complete]
    first, total = (shares.tolist() for shares in indices(a, b, mixed))
    ends = intervals(a, b, mixed, resamples=resamples, seed=seed)
    low, high = (shares.tolist() for shares in ends)
    share, bounds = _broken(results, value, drawn) or (None, None)
    return Sensitivity(
        value=value,
        points=len(results.points),
        solved=sum(point.solved for point in results.points),
        rows=rows,
        used=used,
        doubtful=int(np.sum(np.any(results.doubtful.reshape(pages.shape)[:, complete], axis=0))),
        spread=spread_of(samples, drawn.size - samples.size),
        indices=tuple(
            Index(key, first[k], (low[0][k], high[0][k]), total[k], (low[1][k], high[1][k]))
            for k, key in enumerate(results.varied)
        ),
        share_below_voltage=share,
        resamples=resamples,
        seed=seed,
        share_below_voltage_bounds=bounds,
    )


def _broken(results: SweepResults, value: str, drawn: Mask) -> tuple[float, tuple[float, float]] | None:
    """Share of the samples with breakdown, and its bounds; None if the value has no margin.

    ``drawn``, samples with a value, shape (n,), the first points of the design.
    """
    breakdown = breakdown_of(results.case, value)
    if value not in breakdown.keys:
        return None
    margins = breakdown.margins(results)[: drawn.size]
    if not np.all(np.isfinite(margins[drawn])):
        return None
    touching = np.array(
        [point.solved and is_shorted(point.summary) for point in results.points[: drawn.size]]
    )
    margins = np.where(touching, 0.0, margins)
    known = np.isfinite(margins)
    share = float(np.mean(margins[known] < 1.0))
    return share, bounds_of(share, drawn.size, int(np.count_nonzero(~known)))


def spread_of(samples: Array, failed: int = 0) -> Spread:
    """Moments and quantiles of samples, shape (n,). ``failed``, number of further samples without a value.

    Examples
    --------
    >>> spread_of(np.arange(101.0)).quantiles[0.95]
    95.0
    >>> spread_of(np.arange(90.0), failed=10).quantile_bounds[0.5]
    (39.0, 50.0)
    """
    return Spread(
        samples=samples.size,
        mean=float(np.mean(samples)),
        standard_deviation=float(np.std(samples, ddof=1)),
        minimum=float(np.min(samples)),
        maximum=float(np.max(samples)),
        quantiles={q: float(np.quantile(samples, q)) for q in QUANTILES},
        failed=failed,
        quantile_bounds={q: _bounds(samples, failed, q) for q in QUANTILES},
    )


def _bounds(samples: Array, failed: int, q: float) -> tuple[float | None, float | None]:
    """Smallest and largest quantile of samples and ``failed`` further ones, which may have any value."""
    low = float(np.quantile(np.concatenate([np.full(failed, -np.inf), samples]), q, method="lower"))
    high = float(np.quantile(np.concatenate([samples, np.full(failed, np.inf)]), q, method="higher"))
    if not failed:
        low = high = float(np.quantile(samples, q))
    return plain(low), plain(high)


def indices(a: Array, b: Array, mixed: Array) -> tuple[Array, Array]:
    """First-order and total sensitivity indices of all inputs. ``a`` and ``b``, values at the rows of A and
    of B, shape (n,); ``mixed``, values at the rows of A with one column replaced by the column of B, for each
    input, shape (inputs, n). Returns indices of the inputs; NaN where the value does not vary,
    shape (inputs,).

    Examples
    --------
    The sum y = x1 + x2 of two inputs that are 0 or 1, at all sixteen combinations of rows of A and B:

    >>> rows = np.array(np.meshgrid(*[[0.0, 1.0]] * 4)).reshape(4, 16)
    >>> a, b = rows[:2], rows[2:]
    >>> indices(a.sum(axis=0), b.sum(axis=0), np.array([b[0] + a[1], a[0] + b[1]]))
    (array([0.5, 0.5]), array([0.5, 0.5]))
    """
    columns = _columns(a, b, mixed)
    first, total = _of_means(np.mean(columns, axis=1)[np.newaxis])
    return first[0], total[0]


def intervals(a: Array, b: Array, mixed: Array, *, resamples: int, seed: int) -> tuple[Array, Array]:
    """Bootstrap confidence intervals of the sensitivity indices, at the level of 95 %.

    ``a`` and ``b``, values at the rows of A and of B, shape (n,); ``mixed``, values at the rows of A with one
    column replaced by the column of B, for each input, shape (inputs, n). Returns lower and upper ends of the
    intervals: row 0 of the first-order indices, row 1 of the total indices, shape (2, inputs).
    """
    columns = _columns(a, b, mixed)
    generator = np.random.default_rng(seed)
    means = np.empty((resamples, len(columns)))
    for k in range(resamples):
        weights = np.bincount(generator.integers(a.size, size=a.size), minlength=a.size)
        means[k] = columns @ weights / a.size
    resampled = np.stack(_of_means(means))  # (2, resamples, inputs)
    ends = np.nanquantile(resampled, [0.5 * (1.0 - LEVEL), 0.5 * (1.0 + LEVEL)], axis=1)
    return ends[0], ends[1]


def _columns(a: Array, b: Array, mixed: Array) -> Array:
    """Quantities whose means over the rows give the indices, shape (4 + 3 inputs, n).

    The values are centred before they are squared: rounding would spoil the variance of a value that
    varies little.
    """
    middle = 0.5 * (np.mean(a) + np.mean(b))
    a, b, mixed = a - middle, b - middle, mixed - middle
    change = mixed - a
    return np.concatenate([[a, b, a**2, b**2], b * change, change, change**2])


def _of_means(means: Array) -> tuple[Array, Array]:
    """First-order and total indices from the means of ``_columns``, shape (resamples, 4 + 3 inputs).

    Both have shape (resamples, inputs).
    """
    mean = 0.5 * (means[:, 0] + means[:, 1])
    variance = 0.5 * (means[:, 2] + means[:, 3]) - mean**2
    product, change, square = np.split(means[:, 4:], 3, axis=1)
    # A bootstrap sample may repeat a single row; its variance is 0, and its indices are undefined.
    scale = np.where(variance > 0.0, variance, np.nan)[:, np.newaxis]
    return (product - mean[:, np.newaxis] * change) / scale, 0.5 * square / scale
