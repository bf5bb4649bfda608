"""Probability that a bearing breaks down: its margin over the uncertainty of its inputs and its films."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any, Protocol, TypeVar

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.bearing_discharges import ROUGHNESS, first_margin, margin_apart
from ehlectric.bearing.curve_nodes import where_it_bends
from ehlectric.bearing.many_points import gathered, many_of, reason_of, solved_parts
from ehlectric.bearing.margin import ONLY_SOLVED, QuickMargins, film_factors, margin_and_lambda
from ehlectric.bearing.perturbed_bearings import LEAST, MOST
from ehlectric.bearing.solution import BearingSolution, conducts, film_error
from ehlectric.bearing.solving import NOT_IN_FILMS
from ehlectric.bearing.uncertain_inputs import OF_TABLE, Change, changes_of, proportional_to_strength
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.input_keys import is_quantity
from ehlectric.discharge.breakdown_rule import UNLIKELY, Chance
from ehlectric.errors import InputError
from ehlectric.formulas.sobol import sobol_points
from ehlectric.formulas.variance_shares import variance_shares
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.quantities.inputs import SPEED
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.display import read_only_property
from ehlectric.runtime.files import plain
from ehlectric.runtime.threads import one_blas_thread

# Numbers of points of the design, powers of 2, to which it is refined, and the seed of its scrambling. The
# first one is enough for terms of the third degree in eight inputs.
STAGES, SEED = (512, 1024, 2048), 1

# Share of the variance that the polynomial behind the shares of the inputs has to predict.
_PREDICTED = 0.99

# Points of the estimate at once, in which the films stay as they are.
QUICK_SAMPLES = 256

# Least and largest number of points of the design where it is asked for.
LEAST_SAMPLES, MOST_SAMPLES = 32, 4096

# Speeds at which the margin is computed at first for its curve, and points at each speed, a power of 2.
_SPEEDS, _AT_EACH = 7, 128

# Largest error of the logarithms of quantiles between two speeds, least distance of the logarithms of two
# speeds, and least quantile that is drawn.
_BEND, _CLOSEST, _DRAWN = 0.05, 0.05, 0.05

# Reason for which a bearing has no distribution of its margin.
NO_MARGINS = "the margin has no value within the ranges of the inputs"

# Names of uncertainties in addition to the inputs of a file.
FILMS, SCATTER = "films", "scatter"


def is_factor(key: str) -> bool:
    """Whether the values of an uncertain input are factors on a table of strengths or on films.

    Examples
    --------
    >>> is_factor("films"), is_factor("films.meshes"), is_factor("bearing.temperature")
    (True, True, False)
    """
    return key == OF_TABLE or key.partition(".")[0] == FILMS


@dataclass(frozen=True)
class UncertainInput:
    """Input within its range, and what it contributes to the spread of the margin."""

    # Dotted key; "films" for their error, "scatter" for a Weibull law.
    key: str = field(metadata=number("text"))
    label: str = field(metadata=number("text"))
    # low and high: ends of the range, SI units; factors on all films for "films"; None for "scatter".
    low: float | None = field(metadata=number())
    high: float | None = field(metadata=number())
    # Whether the range is the usual one, as the file states none.
    assumed: bool = field(metadata=number("truth"))
    # Source of the usual range; empty for a range of the file.
    reason: str = field(metadata=number("text"))
    # Shares of the variance of ln(margin), dimensionless: that would disappear if the input were known, and
    # that would remain if all others were known.
    first_order: float = field(metadata=number())
    total: float = field(metadata=number())


@dataclass(frozen=True)
class MarginBand:
    """Margin over the speed of the inner ring, within the uncertain inputs."""

    speed: Array  # [rad/s], shape (n,)
    # low, median and high: margin at 5 %, 50 % and 95 %, see ``Chance``, dimensionless, shape (n,).
    low: Array
    median: Array
    high: Array
    probability: Array  # probability of a margin below 1, shape (n,)


@dataclass(frozen=True)
class MarginSpread:
    """Distribution of the margin of a bearing over the uncertainty of its inputs and its films.

    Inputs are independent and evenly distributed over their ranges. What follows from an input, such as the
    viscosity from the temperature, changes with it. A point whose surfaces touch counts as breakdown.
    """

    # Margins of all points with a result, 0 where surfaces touch, dimensionless, shape (n,).
    margins: Array = field(repr=False, metadata=stored("sample", "", "not negative"))
    touching: float = field(metadata=number())  # share of points whose surfaces touch
    failed: int = field(metadata=number("whole"))  # number of points without a result
    samples: int = field(metadata=number("whole"))
    seed: int = field(metadata=number("whole"))
    left_out: tuple[str, ...] = ()  # ranges that are not in the distribution, and why
    # Why one of the points has no result; empty where it is not known.
    reason: str = field(default="", metadata=number("text"))

    @property
    def median(self) -> float:
        """Margin that half of the points have at least, dimensionless."""
        return self.chance.median

    @property
    def interval(self) -> tuple[float, float]:
        """Margins between which 90 % of the points are, dimensionless; see ``Chance``."""
        return self.chance.low, self.chance.high

    @property
    def probability(self) -> float:
        """Probability of breakdown, of the points with a result."""
        return self.chance.probability

    @property
    def bounds(self) -> tuple[float, float]:
        """Smallest and largest probability of breakdown that the points without a result allow."""
        return self.chance.bounds

    @property
    def probability_error(self) -> float:
        """Sampling error of the probability at a confidence of 95 %: the error of as many random points.

        Half of Wilson's interval; the points of a Sobol design have a smaller one.
        """
        return self.chance.error

    @property
    def margin_error(self) -> float:
        """Largest relative sampling error of the median and both ends of the interval, at 95 % confidence.

        As many random points have this error; a Sobol design has a smaller error.
        """
        return self.chance.margin_error

    @read_only_property
    def chance(self) -> Chance:
        """Probability and interval as a verdict says them."""
        return Chance.of(self.margins, self.failed, neglected=self.left_out)

    @property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warning of points without a result; none if all points have one."""
        if not self.failed:
            return ()
        low, high = self.bounds
        warning = ResultWarning.of(
            "probability-bounded",
            "bearing",
            failed=self.failed,
            samples=self.samples,
            low=100.0 * low,
            high=100.0 * high,
            reason=f" ({self.reason})" if self.reason else "",
        )
        return (warning,)

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``uncertainty`` of summary.json, SI units."""
        (low, high), (least, most) = self.interval, self.bounds
        return {
            "margin_median": self.median,
            "margin_low": low,
            "margin_high": plain(high),
            "margin_error": self.margin_error,
            "breakdown_probability": self.probability,
            "breakdown_probability_low": least,
            "breakdown_probability_high": most,
            "breakdown_probability_error": self.probability_error,
            "asperity_contact_probability": self.touching,
            **self._shares(),
            "samples": self.samples,
            "failed": self.failed,
            "seed": self.seed,
            "left_out": list(self.left_out),
        }

    def _shares(self) -> dict[str, Any]:
        """Values of the table that are about single inputs; none without their shares of the variance."""
        return {}


@dataclass(frozen=True)
class Uncertainty(MarginSpread):
    """Distribution of the margin of a bearing, with the contribution of each input to its spread."""

    inputs: tuple[UncertainInput, ...] = field(kw_only=True)  # the largest contribution first
    # Share of the variance of ln(margin) that the polynomial behind the shares of the inputs predicts.
    predicted: float = field(kw_only=True, metadata=number())

    @read_only_property
    def chance(self) -> Chance:
        """Probability and interval as a verdict says them."""
        first = self.inputs[0]
        about = {"first": first.label, "share": first.total, "neglected": self.left_out}
        return Chance.of(self.margins, self.failed, **about)

    def _shares(self) -> dict[str, Any]:
        return {"indices": [asdict(entry) for entry in self.inputs], "predicted": self.predicted}


# Distribution with or without the contributions of the inputs.
_Spread = TypeVar("_Spread", bound=MarginSpread)


@dataclass(frozen=True)
class Names:
    """Key, label and range of an uncertain input; see ``UncertainInput``."""

    key: str
    label: str
    low: float | None
    high: float | None
    assumed: bool
    reason: str

    @classmethod
    def of(cls, change: Change, assumed: Mapping[str, str]) -> Names:
        """Names of a changed input. ``assumed``, reasons of usual ranges by their key."""
        known = change.key in assumed
        return cls(change.key, change.label, *change.ends, assumed=known, reason=assumed.get(change.key, ""))


class Sampled(Protocol):
    """Uncertain inputs as numbers from 0 to 1: columns for which margins are computed, then factors."""

    @property
    def left_out(self) -> tuple[str, ...]:
        """Ranges that are not in the distribution, and why."""

    @property
    def width(self) -> int:
        """Number of uncertain inputs."""

    @property
    def number(self) -> int:
        """Number of columns for which margins are computed."""

    def log_factors(self, at: Array) -> Array:
        """Logarithms of the factors on the margin at points from 0 to 1, shape (n, width - number)."""

    def names(self) -> Iterable[Names]:
        """Names of the uncertain inputs, in the order of the columns."""


def logs_of_factors(ends: Sequence[tuple[tuple[float, float], float]], at: Array) -> Array:
    """Logarithms of inputs over their values, at points from 0 to 1 of their ranges, shape (n, inputs).

    ``ends``, both ends of the range of each input, and its value.
    """
    low, high, value = np.array([(*both, middle) for both, middle in ends]).reshape(-1, 3).T
    logs: Array = np.log((low + (high - low) * at) / value)
    return logs


@dataclass(frozen=True)
class Design:
    """Uncertain inputs of a bearing, and how its margin follows from numbers from 0 to 1 for each of them."""

    case: BearingCase
    computed: tuple[Change, ...]  # inputs for which films or circuits are computed
    factors: tuple[Change, ...]  # inputs to which the margin is proportional
    films: tuple[float, float]  # ends of the factor on all films by their error
    shape: float | None  # shape of a Weibull law of the strength
    assumed: Mapping[str, str]  # reasons of usual ranges by their key
    left_out: tuple[str, ...]

    @classmethod
    def of(cls, solution: BearingSolution, *, same_films: bool = False) -> Design:
        """Design of a solved bearing; with ``same_films``, of the inputs on which its films do not depend."""
        return cls.of_case(solution.case, film_error(solution), same_films=same_films)

    @classmethod
    def of_case(cls, case: BearingCase, off: Numbers, *, same_films: bool = False) -> Design:
        """Design of a bearing whose films are ``off`` by at most this part either way."""
        left_out, computed, factors = [], [], []
        stated = {entry.key for entry in case.ranges or ()}
        changes = changes_of(case)
        for change in changes:
            if proportional_to_strength(change.key):
                factors.append(change)
            elif is_quantity(change.key) and change.key not in ONLY_SOLVED:
                if not same_films or change.key.startswith(NOT_IN_FILMS):
                    computed.append(change)
            else:
                left_out.append(f"{change.key}: its range has no part in the probability")
        weibull = case.discharge.weibull
        assumed = {change.key: change.reason for change in changes if change.key not in stated}
        return cls(
            case,
            tuple(computed),
            tuple(factors),
            film_factors(case, float(off)),
            None if weibull is None else weibull.shape,
            assumed,
            tuple(left_out),
        )

    @property
    def width(self) -> int:
        """Number of uncertain inputs, with the films and the scatter of the strength."""
        return len(self.computed) + len(self.factors) + 1 + (self.shape is not None)

    @property
    def rough(self) -> bool:
        """Whether the films have summits, over which the margin is not proportional to the film: then the
        error of the films stands behind the computed inputs, and otherwise behind the factors.
        """
        return self.case.bearing.summit_height > 0.0 or any(
            change.key == "bearing.summit_height" for change in self.computed
        )

    @property
    def number(self) -> int:
        """Number of columns for which margins are computed."""
        return len(self.computed) + self.rough

    def film_scale(self, at: Array) -> Numbers:
        """Factor on all films of which the margin is no simple factor, shape (n,); 1 for smooth films."""
        low, high = self.films
        return low + (high - low) * at[:, len(self.computed)] if self.rough else 1.0

    def arrays(self, at: Array, scale: Numbers = 1.0) -> dict[str, Array]:
        """Inputs of the case by key at points from 0 to 1, shape (n, width). ``scale``, further factor on all
        films that summits are compared with, shape (...).
        """
        arrays: dict[str, Array] = {}
        for k, change in enumerate(self.computed):
            low, high = change.ends
            arrays |= change.changes(low + (high - low) * at[:, k])
        if self.rough or ROUGHNESS in arrays:
            given = arrays.get(ROUGHNESS, np.full(len(at), self.case.bearing.composite_rq))
            arrays[ROUGHNESS] = given / (scale * self.film_scale(at))
        return arrays

    def log_factors(self, at: Array) -> Array:
        """Logarithms of the factors on the margin at points from 0 to 1, shape (n, width - number)."""
        ends = [(change.ends, change.value) for change in self.factors]
        if not self.rough:
            ends.append((self.films, 1.0))
        factors = logs_of_factors(ends, at[:, self.number : self.number + len(ends)])
        if self.shape is None:
            return factors
        # Part of the strength at 63.2 % at which a share of equal films has broken down.
        shares = np.log(-np.log1p(-at[:, self.number + len(ends)])) / self.shape
        return np.column_stack([factors, shares])

    def names(self) -> Iterator[Names]:
        """Names of the uncertain inputs, in the order of the columns."""
        by = {"atlas": "stated error of the atlas", "formula": "stated error of the formula"}
        reason = by.get(self.case.contacts, "estimated error of the solved films")
        films = [Names(FILMS, "films", *self.films, assumed=True, reason=reason)]
        computed, factors = (
            [Names.of(change, self.assumed) for change in changes]
            for changes in (self.computed, self.factors)
        )
        yield from (*computed, *films, *factors) if self.rough else (*computed, *factors, *films)
        if self.shape is not None:
            yield Names(SCATTER, "scatter of the dielectric strength", None, None, assumed=False, reason="")


def uncertainty_of(
    solution: BearingSolution,
    margins: QuickMargins,
    *,
    samples: int | None = None,
    seed: int = SEED,
) -> Uncertainty:
    """Distribution of the margin of a solved bearing over its uncertain inputs.

    Ranges are the ranges of the file, and the usual ranges of ``changes_of`` for all other inputs. Films at
    other inputs are from the atlas or from formulas, and scaled to the films of the solution. ``margins``,
    margins of the solution at changed inputs; ``samples``, number of points, a power of 2; ``seed`` of the
    design.

    By default the design is refined from 512 points up to 2048, until the sampling error of the probability
    cannot change the level of the verdict, and the shares of the inputs predict 99 % of the variance.

    Raises InputError where no point has a result.
    """
    design, touching = Design.of(solution), bool(conducts(solution))
    stages = STAGES if samples is None else (samples,)
    uncertainty, computed, at = refined(
        design, lambda at: _computed(design, margins, at), stages=stages, seed=seed, touching=touching
    )
    return _with_reason(uncertainty, design, margins, computed, at)


def refined(
    design: Sampled, compute: Callable[[Array], Array], *, stages: Sequence[int], seed: int, touching: bool
) -> tuple[Uncertainty, Array, Array]:
    """Distribution of the margin over a design that is refined from stage to stage, numbers of its points.

    ``compute``, margins at points from 0 to 1, shape (n, width), without the factors of the design, shape
    (n,): 0 where surfaces touch, NaN without a result. ``touching``, whether the level of the verdict follows
    ``touching_rule``. The design is refined until the sampling error of the probability cannot change this
    level, and the shares of the inputs predict 99 % of the variance. Returns also the margins and the points.
    """
    at, computed = sobol_points(design.width, stages[-1], seed), np.empty(0)
    for count in stages:
        computed = np.concatenate([computed, compute(at[computed.size : count])])
        inputs, predicted = _inputs(design, computed, at[:count])
        spread = spread_at(design, computed, at[:count], seed)
        uncertainty = Uncertainty(**vars(spread), inputs=inputs, predicted=predicted)
        if predicted >= _PREDICTED and uncertainty.chance.is_settled(touching=touching):
            break
    return uncertainty, computed, at


def _with_reason(
    spread: _Spread, design: Design, margins: QuickMargins, computed: Array, at: Array
) -> _Spread:
    """Distribution with the reason of the first of its points that has no result."""
    if not spread.failed:
        return spread
    first = np.flatnonzero(~np.isfinite(computed))[:1]
    many = many_of(margins.quick_case, design.arrays(at[first], margins.lambda_factor), 1)
    return replace(spread, reason=reason_of(many.single(0)))


def uncertainty_of_result(solution: BearingSolution) -> Uncertainty | None:
    """Distribution of the margin of a solved bearing; None where ``has_chance`` is not. Raises InputError
    where it has no margin at any other inputs.
    """
    return uncertainty_of(solution, QuickMargins.of(solution)) if has_chance(solution) else None


def has_chance(solution: BearingSolution) -> bool:
    """Whether a bearing has a probability of breakdown: its films are converged, and have a margin unless
    their surfaces touch.
    """
    return solution.converged and margin_apart(solution) is not None


def spread_of_result(solution: BearingSolution, samples: int, seed: int = SEED) -> MarginSpread | None:
    """Distribution of the margin of a solved bearing as ``uncertainty_of_result``, without the shares of its
    inputs, at so many points.
    """
    if not has_chance(solution):
        return None
    margins, design = QuickMargins.of(solution), Design.of(solution)
    at = sobol_points(design.width, samples, seed)
    computed = _computed(design, margins, at)
    return _with_reason(spread_at(design, computed, at, seed), design, margins, computed, at)


def spread_at(design: Sampled, computed: Array, at: Array, seed: int) -> MarginSpread:
    """Distribution of the margin from margins at points from 0 to 1, shape (n, width).

    ``computed``, margins without the factors, 0 where surfaces touch, NaN without a result, shape (n,).
    Raises InputError where no point has a result.
    """
    margins = _with_factors(design, computed, at)
    solved = np.isfinite(margins)
    margins = margins[solved]
    touching, failed = float(np.mean(margins == 0.0)), int(np.count_nonzero(~solved))
    return MarginSpread(margins, touching, failed, len(at), seed, design.left_out)


def _with_factors(design: Sampled, computed: Array, at: Array) -> Array:
    """Margins with the factors of the design; see ``spread_at``."""
    if not np.any(np.isfinite(computed)):
        raise InputError.worded(None, NO_MARGINS)
    margins: Array = computed * np.exp(np.sum(design.log_factors(at), axis=-1))
    return margins


def without_spread(reason: object) -> str:
    """Text that says why a bearing with a margin has no distribution of it."""
    return f"probability of breakdown: {reason}"


def quick_chance(solution: BearingSolution, *, samples: int = QUICK_SAMPLES) -> Chance | None:
    """Chance of a solved bearing at once, with its own films at all points: what changes them is neglected,
    as temperature, load and clearance. None where ``has_chance`` is not.
    """
    if not has_chance(solution):
        return None
    design = Design.of(solution, same_films=True)
    at = sobol_points(design.width, samples, SEED)
    arrays = design.arrays(at)
    case = solution.case.with_arrays(arrays) if arrays else solution.case
    margins = first_margin(replace(solution, case=case))
    # Points whose surfaces touch count as breakdown.
    margin = design.film_scale(at) * np.nan_to_num(np.zeros(len(at)) if margins is None else margins)
    return Chance.of(margin * np.exp(np.sum(design.log_factors(at), axis=-1)))


def _computed(design: Design, margins: QuickMargins, at: Array, speed: Array | None = None) -> Array:
    """Margins without the factors, 0 where the surfaces touch, NaN without a result, shape (n,).

    ``speed`` of the inner ring at the points [rad/s], by default the speed of the case.
    """
    arrays = design.arrays(at, margins.lambda_factor)
    if speed is not None:
        arrays[SPEED] = speed
    many = many_of(margins.quick_case, arrays, len(at))
    margin, _ = gathered(solved_parts(many, detail="coarse"), margin_and_lambda, (2, len(at)))
    return np.asarray(margins.margin_factor * design.film_scale(at) * margin)


def _inputs(design: Sampled, computed: Array, at: Array) -> tuple[tuple[UncertainInput, ...], float]:
    """Uncertain inputs with their shares of the variance of ln(margin), the largest first, and the share of
    this variance that is predicted.
    """
    number = design.number
    separated = computed > 0.0
    separate = np.var(design.log_factors(at), axis=0)
    first, total, variance, missed = np.zeros(number), np.zeros(number), 0.0, 0.0
    if number and np.count_nonzero(separated) > 1:
        logs = np.log(computed[separated])
        with one_blas_thread(of_scipy=False):
            decomposition = variance_shares(2.0 * at[separated, :number] - 1.0, logs)
        first, total, variance = decomposition.first, decomposition.total, decomposition.variance
        missed = (1.0 - decomposition.predicted) * float(np.var(logs))
    whole = variance + float(np.sum(separate)) or 1.0
    shares = [*zip(variance * first, variance * total, strict=True), *zip(separate, separate, strict=True)]
    inputs = [
        UncertainInput(**vars(names), first_order=float(part / whole), total=float(all_ / whole))
        for names, (part, all_) in zip(design.names(), shares, strict=True)
    ]
    return tuple(sorted(inputs, key=lambda part: -part.total)), 1.0 - missed / whole


def margin_band(
    solution: BearingSolution,
    margins: QuickMargins,
    speeds: Sequence[float] | None = None,
    *,
    seed: int = SEED,
) -> MarginBand:
    """Compute the margin at speeds from a tenth of the speed of the case to four times it, within what is
    uncertain.

    The temperature does not change with the speed. Every speed has the same 128 points of the other inputs.
    By default, speeds are added until straight lines between the logarithms of the quantiles are within 5 %.
    The result does not contain a speed at which 5 % of the points or more have no result, because its
    quantiles are not known.
    """
    design = Design.of(solution)
    at = sobol_points(design.width, _AT_EACH, seed)

    def quantiles(speed: Array) -> Array:
        """Quantiles and probability of ``Chance``, shape (4, n); NaN where they are not known."""
        computed = _computed(design, margins, np.tile(at, (speed.size, 1)), np.repeat(speed, _AT_EACH))
        rows = _with_factors(design, computed, np.tile(at, (speed.size, 1))).reshape(speed.size, _AT_EACH)
        columns = np.full((4, speed.size), np.nan)
        for k, row in enumerate(rows):
            solved = np.isfinite(row)
            failed = int(np.count_nonzero(~solved))
            if failed < UNLIKELY * row.size:
                chance = Chance.of(row[solved], failed)
                columns[:, k] = chance.low, chance.median, chance.high, chance.probability
        return columns

    if speeds is not None:
        speed = np.asarray(speeds, dtype=float)
        columns = quantiles(speed)
    else:
        speed_of_case = solution.case.bearing.inner_speed
        speed, columns = _drawn_quantiles(quantiles, speed_of_case * np.geomspace(LEAST, MOST, _SPEEDS))
    known = np.isfinite(columns[0])
    return MarginBand(speed[known], *columns[:, known])


def _drawn_quantiles(quantiles: Callable[[Array], Array], speed: Array) -> tuple[Array, Array]:
    """Return the given speeds [rad/s] with further ones where a quantile bends, shape (n,), and the quantiles
    with the probability at all of them, shape (4, n).
    """
    speeds, columns = [speed], [quantiles(speed)]

    def logs(log: Array) -> Array:
        """Logarithms of the quantiles at logarithms of further speeds, shape (3, n)."""
        speeds.append(np.exp(log))
        columns.append(quantiles(speeds[-1]))
        return _drawn(columns[-1])

    where_it_bends(logs, np.log(speed), _drawn(columns[0]), tolerance=_BEND, closest=_CLOSEST)
    every, quantiles_of_all = np.concatenate(speeds), np.concatenate(columns, axis=1)
    order = np.argsort(every)
    return every[order], quantiles_of_all[:, order]


def _drawn(quantiles_of_all: Array) -> Array:
    """Logarithms of the quantiles that a figure shows, shape (3, n)."""
    return np.asarray(np.log(np.maximum(quantiles_of_all[:-1], _DRAWN)))
