"""Uncertainty: how far a value spreads over stated ranges of the inputs, and which input it comes from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.sweep.breakdown import breakdown_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import numbers_of

SCHEMA = "ehlectric.sensitivity/1"
QUANTILES = (0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975)
LEVEL = 0.95

# Fewer complete rows say nothing about a variance, let alone about its parts.
_LEAST_ROWS = 16

# A value that varies by less, relatively, is constant but for rounding and the tolerance of the film.
_CONSTANT = 1e-9


@dataclass(frozen=True)
class Spread:
    """How a value is distributed where every input is drawn from its range.

    Attributes
    ----------
    samples : int
        Solved points of A and B that it is taken over.
    mean, standard_deviation, minimum, maximum : float
        SI.
    quantiles : mapping
        By probability, SI; interpolated linearly between the samples.
    """

    samples: int
    mean: float
    standard_deviation: float
    minimum: float
    maximum: float
    quantiles: Mapping[float, float]


@dataclass(frozen=True)
class Index:
    """Parts of the variance that are due to one input.

    Attributes
    ----------
    key : str
        Of the case.
    first_order, total : float
        Part that would go if this input were known, and part that would be left if it alone were not. An
        estimate may lie a little outside of 0 to 1.
    first_order_interval, total_interval : (float, float)
        Their bootstrap confidence intervals.
    """

    key: str
    first_order: float
    first_order_interval: tuple[float, float]
    total: float
    total_interval: tuple[float, float]


@dataclass(frozen=True)
class Sensitivity:
    """Spread of a value and the indices of all varied inputs.

    Attributes
    ----------
    value : str
        Dotted key of the summary.
    points, solved : int
        Of the design, and how many of them are solved.
    rows, used : int
        Rows of the design, and how many are complete: the indices are of these.
    doubtful : int
        How many of the complete ones have a point with a warning not to use its film.
    spread : Spread
        Of the value.
    indices : tuple of Index
        In the order of the varied keys.
    share_below_voltage : float or None
        Part of the samples whose breakdown voltage is below the applied one; None of other values.
    resamples, seed : int
        Of the bootstrap.
    """

    value: str
    points: int
    solved: int
    rows: int
    used: int
    doubtful: int
    spread: Spread
    indices: tuple[Index, ...]
    share_below_voltage: float | None
    resamples: int
    seed: int

    @property
    def dropped(self) -> int:
        """Rows of which some point is not solved or has no such value."""
        return self.rows - self.used

    def to_dict(self) -> dict[str, Any]:
        """Everything as sensitivity.json has it, SI."""
        spread = self.spread
        return {
            "schema": SCHEMA,
            "value": self.value,
            "points": self.points,
            "solved": self.solved,
            "rows": self.rows,
            "rows_dropped": self.dropped,
            "rows_doubtful": self.doubtful,
            "spread": {
                "samples": spread.samples,
                "mean": spread.mean,
                "standard_deviation": spread.standard_deviation,
                "minimum": spread.minimum,
                "maximum": spread.maximum,
                "quantiles": {f"{q:g}": value for q, value in spread.quantiles.items()},
            },
            "share_below_voltage": self.share_below_voltage,
            "indices": {
                index.key: {
                    "first_order": index.first_order,
                    "first_order_interval": list(index.first_order_interval),
                    "total": index.total,
                    "total_interval": list(index.total_interval),
                }
                for index in self.indices
            },
            "bootstrap": {"level": LEVEL, "resamples": self.resamples, "seed": self.seed},
        }


def sensitivity(results: SweepResults, value: str, *, resamples: int = 1000, seed: int = 0) -> Sensitivity:
    """Spread and variance-based sensitivity indices of a value over a Sobol design.

    Parameters
    ----------
    results : SweepResults
        Of the design "sobol".
    value : str
        Dotted key of the summary.
    resamples, seed : int
        Of the bootstrap.

    Returns
    -------
    Sensitivity
        A row of the design (a point of A, of B, and of A with each column of B) of which some point is not
        solved is left out of the indices as a whole; the spread is that of all solved points of A and B.

    Raises
    ------
    InputError
        Where the design is another, the value is nowhere or constant, or fewer than 16 rows are complete.

    Notes
    -----
    With V the variance of the value y over A and B, centred by their mean m: first order
    mean((y_B - m)(y_ABi - y_A))/V (Saltelli et al. 2010, doi:10.1016/j.cpc.2009.09.018, Table 2 (b)), total
    mean((y_A - y_ABi)^2)/(2 V) (Jansen 1999, doi:10.1016/S0010-4655(98)00154-4). Intervals are those between
    the 2.5 and 97.5 % quantiles of rows drawn with replacement (Archer, Saltelli and Sobol 1997,
    doi:10.1080/00949659708811825): for rows that are independent, thus too wide for smooth values at those of
    a Sobol sequence.
    """
    if results.design != "sobol":
        raise InputError.worded(
            "design",
            f'got "{results.design}", sensitivity takes a sweep of the design "sobol"',
            got=results.design,
        )
    rows, inputs = results.samples, len(results.varied)
    values = numbers_of(results, value)
    pages = values.reshape(inputs + 2, rows)
    complete = np.all(np.isfinite(pages), axis=0)
    used = int(np.sum(complete))
    if used < _LEAST_ROWS:
        raise InputError.worded(
            value,
            f"{used} of {rows} rows of the design are complete, sensitivity takes at least {_LEAST_ROWS}",
            got=used,
            takes=f"at least {_LEAST_ROWS}",
        )
    drawn = np.isfinite(values[: 2 * rows])
    samples = values[: 2 * rows][drawn]
    if np.ptp(samples) <= _CONSTANT * np.max(np.abs(samples)) or not np.ptp(pages[:2, complete]):
        raise InputError.worded(
            value,
            f"is {samples[0]:g} in all samples, sensitivity takes a value that varies",
            takes="a value that varies",
        )
    a, b, mixed = pages[0, complete], pages[1, complete], pages[2:, complete]
    first, total = indices(a, b, mixed)
    low, high = intervals(a, b, mixed, resamples=resamples, seed=seed)
    breakdown = breakdown_of(results.case, value)
    margins = breakdown.margins(results)[: 2 * rows][drawn]
    told = value in breakdown.keys and bool(np.all(np.isfinite(margins)))
    return Sensitivity(
        value=value,
        points=len(results.points),
        solved=sum(point.solved for point in results.points),
        rows=rows,
        used=used,
        doubtful=int(np.sum(np.any(results.doubtful.reshape(pages.shape)[:, complete], axis=0))),
        spread=spread_of(samples),
        indices=tuple(
            Index(
                key=key,
                first_order=float(first[k]),
                first_order_interval=(float(low[0, k]), float(high[0, k])),
                total=float(total[k]),
                total_interval=(float(low[1, k]), float(high[1, k])),
            )
            for k, key in enumerate(results.varied)
        ),
        share_below_voltage=float(np.mean(margins < 1.0)) if told else None,
        resamples=resamples,
        seed=seed,
    )


def spread_of(samples: Array) -> Spread:
    """Moments and quantiles of samples, shape (n,).

    Examples
    --------
    >>> spread_of(np.arange(101.0)).quantiles[0.95]
    95.0
    """
    return Spread(
        samples=samples.size,
        mean=float(np.mean(samples)),
        standard_deviation=float(np.std(samples, ddof=1)),
        minimum=float(np.min(samples)),
        maximum=float(np.max(samples)),
        quantiles={q: float(np.quantile(samples, q)) for q in QUANTILES},
    )


def indices(a: Array, b: Array, mixed: Array) -> tuple[Array, Array]:
    """First-order and total indices.

    Parameters
    ----------
    a, b : ndarray, shape (n,)
        Values at the rows of A and of B.
    mixed : ndarray, shape (inputs, n)
        Values at A with one column of B, for each input.

    Returns
    -------
    first, total : ndarray, shape (inputs,)
        Not a number where the value does not vary.

    Examples
    --------
    Of y = x1 + x2, each at 0 and 1, at all sixteen rows of A and B:

    >>> rows = np.array(np.meshgrid(*[[0.0, 1.0]] * 4)).reshape(4, 16)
    >>> a, b = rows[:2], rows[2:]
    >>> indices(a.sum(axis=0), b.sum(axis=0), np.array([b[0] + a[1], a[0] + b[1]]))
    (array([0.5, 0.5]), array([0.5, 0.5]))
    """
    columns = _columns(a, b, mixed)
    first, total = _of_means(np.mean(columns, axis=1)[np.newaxis])
    return first[0], total[0]


def intervals(a: Array, b: Array, mixed: Array, *, resamples: int, seed: int) -> tuple[Array, Array]:
    """Bootstrap confidence intervals of the indices at the level of 95 %.

    Parameters
    ----------
    a, b : ndarray, shape (n,)
        Values at the rows of A and of B.
    mixed : ndarray, shape (inputs, n)
        Values at A with one column of B, for each input.
    resamples : int
        How often the rows are drawn again.
    seed : int
        Of the draws.

    Returns
    -------
    low, high : ndarray, shape (2, inputs)
        Ends of the intervals of the first-order and of the total indices.
    """
    columns = _columns(a, b, mixed)
    generator = np.random.default_rng(seed)
    means = np.empty((resamples, len(columns)))
    for k in range(resamples):
        weights = np.bincount(generator.integers(a.size, size=a.size), minlength=a.size)
        means[k] = columns @ weights / a.size
    found = np.stack(_of_means(means))  # (2, resamples, inputs)
    ends = np.nanquantile(found, [0.5 * (1.0 - LEVEL), 0.5 * (1.0 + LEVEL)], axis=1)
    return ends[0], ends[1]


def _columns(a: Array, b: Array, mixed: Array) -> Array:
    """What the indices take the means of, shape (4 + 3 inputs, n).

    Centred before anything is squared: a value that varies little would lose its digits.
    """
    middle = 0.5 * (np.mean(a) + np.mean(b))
    a, b, mixed = a - middle, b - middle, mixed - middle
    change = mixed - a
    return np.concatenate([[a, b, a**2, b**2], b * change, change, change**2])


def _of_means(means: Array) -> tuple[Array, Array]:
    """Indices, shape (resamples, inputs), of means of the columns, shape (resamples, 4 + 3 inputs)."""
    mean = 0.5 * (means[:, 0] + means[:, 1])
    variance = 0.5 * (means[:, 2] + means[:, 3]) - mean**2
    product, change, square = np.split(means[:, 4:], 3, axis=1)
    # Rows drawn again may all be alike; their indices have no meaning.
    scale = np.where(variance > 0.0, variance, np.nan)[:, np.newaxis]
    return (product - mean[:, np.newaxis] * change) / scale, 0.5 * square / scale
