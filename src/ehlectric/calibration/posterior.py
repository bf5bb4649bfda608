"""Bayes' rule for inputs within their ranges, from predictions of a model and measured values.

Inputs are numbers from 0 to 1, independent and evenly distributed before the measurement. A measured value is
the prediction with a normal error. The posterior density at inputs u is then proportional to

    L(u) = exp(-chi2(u)/2),  chi2(u) = sum over i of ((p_i(u) - y_i)/s_i)^2 ,

with the predictions p_i, the measured values y_i and their standard uncertainties s_i, and is 0 outside the
ranges. Points of a Sobol design have weights w proportional to L. Their effective number is 1/sum(w^2) for
weights with the sum 1 (Kong, Liu and Wong, J. Am. Stat. Assoc. 89 (1994) 278,
doi:10.1080/01621459.1994.10476469). If it is too small, a Markov chain (J. Goodman and J. Weare, Commun.
Appl. Math. Comput. Sci. 5 (2010) 65, doi:10.2140/camcos.2010.5.65, by the library emcee) draws points for
polynomials instead of the model. The model is computed at these points, and their weights are proportional
to L of the model divided by L of the polynomials. The polynomials lack inputs that change no prediction at
some points of the design: these inputs are distributed evenly in the box of the polynomials.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.calibration.emulator import Emulator
from ehlectric.errors import InputError
from ehlectric.formulas.legendre_fit import points_of_full_degree
from ehlectric.formulas.sobol import sobol_points

# Predictions at points from 0 to 1, shape (n, k) -> (n, m); NaN where the model has none.
Predict = Callable[[Array], Array]

# Standard deviations of predictions at points, shape (n, k) -> (n, m).
Errors = Callable[[Array], Array]

# Effective number of points below which weights count as collapsed.
LEAST_EFFECTIVE = 50.0

# Effective number of points below which the uncertainties are widened.
_TOO_FEW = 5.0

# Points at which polynomials are evaluated at once, and seed of all random numbers.
_DENSE, SEED = 8192, 1

# Points at which each input is changed to see whether it has an effect.
_CHANGED = 4

# Relative difference of two predictions that count as equal: the error of interpolated capacitances.
_EQUAL = 1e-6

# Walkers of the chain for each input, at least, and steps of which the first part is not used.
_WALKERS, _LEAST_WALKERS, _STEPS, _BURN = 4, 32, 1200, 400

# Boxes in which polynomials are fitted at most, and part of the width of the chain by which a box is larger.
_ROUNDS, _PADDING = 3, 0.25

# Probability that a measurement within the ranges counts as unexplained: of 3 standard deviations.
UNEXPLAINED = float(2.0 * scipy.special.ndtr(-3.0))

# Steps of the search for the nearest prediction, and of the search for the errors of likely predictions.
_SEARCH, _WIDENED = 6, 3

# Standard uncertainties from which a value is searched on a line between smaller and larger predictions,
# number of lines, points on a line, and how often it is narrowed to two of them.
_FAR, _LINES, _ON_LINE, _NARROWED = 3.0, 4, 33, 3


def chi_squares(predictions: Array, values: Array, uncertainties: Array) -> Array:
    """Sums of squared deviations in standard uncertainties, shape (n, m) -> (n,); infinite without a
    prediction.
    """
    with np.errstate(invalid="ignore"):
        chi2 = np.sum(np.square((predictions - values) / uncertainties), axis=-1)
    return np.where(np.isfinite(chi2), chi2, np.inf)


def weights_of(chi2: Array) -> Array:
    """Weights with the sum 1, proportional to exp(-chi2/2), shape (n,)."""
    least = np.min(chi2)
    if not np.isfinite(least):
        return np.zeros_like(chi2)
    weights = np.exp(-0.5 * (chi2 - least))
    return np.asarray(weights / np.sum(weights))


def effective_number(weights: Array) -> float:
    """Effective number of points, 1/sum(w^2); 0 without weights.

    Examples
    --------
    >>> effective_number(np.full(4, 0.25)), effective_number(np.array([1.0, 0.0]))
    (4.0, 1.0)
    """
    total = float(np.sum(np.square(weights)))
    return 1.0 / total if total else 0.0


def weighted_quantiles(values: Array, weights: Array, parts: tuple[float, ...]) -> Array:
    """Quantiles of weighted values, shape (n,) -> (parts,), interpolated between the middles of the weights.

    Examples
    --------
    >>> weighted_quantiles(np.array([1.0, 3.0, 2.0]), np.array([0.25, 0.25, 0.5]), (0.5,)).tolist()
    [2.0]
    """
    order = np.argsort(values)
    cumulative = np.cumsum(weights[order])
    return np.interp(parts, cumulative - 0.5 * weights[order], values[order])


def equal_points(weights: Array, number: int) -> IntArray:
    """Places of points of equal weight, drawn systematically from weighted ones, shape (number,)."""
    steps = (np.arange(number) + 0.5) / number
    places: IntArray = np.minimum(np.searchsorted(np.cumsum(weights), steps), weights.size - 1)
    return places


@dataclass(frozen=True)
class Nearest:
    """Point within the ranges at which the predictions are nearest to the measured values."""

    at: Array  # inputs from 0 to 1, shape (k,)
    predictions: Array  # predictions of the model there, shape (m,)
    chi2: float
    freedom: int  # degrees of freedom of ``chi2``: measured values that the inputs cannot follow, at least 1

    @property
    def p_value(self) -> float:
        """Probability of a larger chi2 if the model is right within the ranges."""
        return float(scipy.special.gammaincc(0.5 * self.freedom, 0.5 * self.chi2))


@dataclass(frozen=True)
class Posterior:
    """Inputs after a measurement: weighted points, with the predictions of the model at them."""

    at: Array  # inputs from 0 to 1, shape (n, k)
    weights: Array  # with the sum 1, shape (n,)
    predictions: Array  # shape (n, m)
    prior_predictions: Array  # predictions at the points of the design, shape (samples, m)
    prior_at: Array  # points of the design, shape (samples, k)
    active: Mask  # inputs with an effect on the predictions, shape (k,)
    emulator: Emulator | None
    nearest: Nearest
    # Standard uncertainties of the measured values together with the errors of predictions, shape (m,).
    uncertainties: Array
    residuals: Array  # deviation of each nearest prediction in standard uncertainties, shape (m,)
    chain: bool  # whether the points are from a Markov chain
    widened: float = 1.0  # factor on the uncertainties, so that enough points have weight

    @property
    def effective(self) -> float:
        """Effective number of points."""
        return effective_number(self.weights)

    @property
    def explained(self) -> bool:
        """Whether inputs within the ranges explain the measurement.

        They do not if a nearest prediction is more than 3 standard uncertainties away, or if chi2 of all is
        as improbable. For m measured values the limit of a single one is larger, so that the probability of a
        false alarm stays the same (Bonferroni).
        """
        return self.nearest.p_value >= UNEXPLAINED and not np.any(np.abs(self.residuals) > self.limit)

    @property
    def limit(self) -> float:
        """Deviation of a nearest prediction above which it explains nothing, in standard uncertainties."""
        return -float(scipy.special.ndtri(0.5 * UNEXPLAINED / self.residuals.size))

    def quantiles(self, parts: tuple[float, ...]) -> Array:
        """Quantiles of the inputs, shape (k, parts)."""
        return np.stack([weighted_quantiles(column, self.weights, parts) for column in self.at.T])

    @property
    def correlation(self) -> Array:
        """Correlation of the inputs, shape (k, k)."""
        off = self.at - self.weights @ self.at
        covariance = (self.weights[:, np.newaxis] * off).T @ off
        scale = np.sqrt(np.diagonal(covariance))
        scale = np.where(scale > 0.0, scale, 1.0)
        return np.asarray(covariance / np.outer(scale, scale))


def infer(
    predict: Predict,
    width: int,
    values: Array,
    uncertainties: Array,
    *,
    samples: int = 512,
    seed: int = SEED,
    errors: Errors | None = None,
    sparing: bool = False,
) -> Posterior:
    """Update k inputs by m measured values.

    ``predict``, model; ``width``, k; ``values`` and ``uncertainties``, measured values and their standard
    uncertainties, > 0, shape (m,); ``samples``, points of the design, a power of 2; ``errors``, errors of the
    predictions, whose mean squares over the posterior points widen the uncertainties; ``sparing``, whether
    half of the points are sufficient if polynomials of the full degree can be fitted to them. Raises
    InputError where the model has no prediction at any point, or where the library of the Markov chain is
    missing.
    """
    at = sobol_points(width, samples, seed)
    first = at[: samples // 2] if sparing else at
    predictions = predict(first)
    active = _active(predict, first, predictions)
    if sparing and points_of_full_degree(int(np.count_nonzero(active))) > len(first):
        predictions = np.concatenate([predictions, predict(at[len(first) :])])
    at = at[: len(predictions)]
    uncertainties = _widened(uncertainties, at, predictions, values, errors)
    prior_predictions = predictions
    nonzero = _NonZero(predict, values > _FAR * uncertainties)
    if np.any(np.all(np.isfinite(nonzero.kept(predictions)), axis=1)):
        predict, predictions = nonzero, nonzero.kept(predictions)
    chi2 = chi_squares(predictions, values, uncertainties)
    if not np.any(np.isfinite(chi2)):
        raise InputError("measured", "has values that the model does not compute at any inputs")
    emulator = Emulator.of(at, predictions, np.zeros(width), np.ones(width), active)
    model = _Measured(predict, values, uncertainties, seed)
    nearest = model.nearest(at, predictions, emulator)
    residuals = (values - nearest.predictions) / uncertainties
    weights = weights_of(chi2)
    posterior = Posterior(
        at=at,
        weights=weights,
        predictions=predictions,
        prior_predictions=prior_predictions,
        prior_at=at,
        active=active,
        emulator=emulator,
        nearest=nearest,
        uncertainties=uncertainties,
        residuals=residuals,
        chain=False,
    )
    if not posterior.explained or posterior.effective >= LEAST_EFFECTIVE:
        return posterior
    if emulator is None:
        return (
            posterior
            if posterior.effective >= _TOO_FEW
            else _widely(posterior, predictions, values, uncertainties)
        )
    best, box = posterior, emulator
    for number in range(_ROUNDS):
        points, drawn = model.drawn(box, nearest, len(at))
        computed = predict(points)
        ratio = chi_squares(computed, values, uncertainties) - model.chi2_of(box, points)
        further = replace(
            posterior, at=points, weights=weights_of(ratio), predictions=computed, emulator=box, chain=True
        )
        if further.effective > best.effective or not best.chain:
            best = further
        if best.effective >= LEAST_EFFECTIVE or number == _ROUNDS - 1:
            break
        low, high = np.min(drawn, axis=0), np.max(drawn, axis=0)
        padding = _PADDING * (high - low) + 1e-6
        low, high = np.maximum(low - padding, 0.0), np.minimum(high + padding, 1.0)
        low, high = np.where(active, low, 0.0), np.where(active, high, 1.0)
        inside = low + (high - low) * at
        smaller = Emulator.of(inside, predict(inside), low, high, active)
        if smaller is None:
            break
        box = smaller
    return best if best.effective >= _TOO_FEW else _widely(posterior, predictions, values, uncertainties)


def _widely(posterior: Posterior, predictions: Array, values: Array, uncertainties: Array) -> Posterior:
    """Points of the design with larger uncertainties, so that enough points have weight; the posterior itself
    if there are no such points. The uncertainty of a value that few points have is enlarged most.
    """
    each = np.square((predictions - values) / uncertainties)
    known = int(np.count_nonzero(np.all(np.isfinite(each), axis=1)))
    least, most = min(LEAST_EFFECTIVE, 0.5 * known), 0.5 * math.log(max(float(np.nanmax(each)), 1.0))

    def weights(logarithms: Array) -> Array:
        chi2 = np.sum(each / np.exp(2.0 * logarithms), axis=1)
        return weights_of(np.where(np.isfinite(chi2), chi2, np.inf))

    def needed(direction: Array) -> float:
        """Length along a direction of the logarithms of all factors at which enough points have weight."""

        def missing(length: float) -> float:
            return effective_number(weights(length * direction)) - least

        longest = 2.0 * most / float(np.max(direction))
        if missing(0.0) >= 0.0 or missing(longest) < 0.0:
            return 0.0 if missing(0.0) >= 0.0 else longest
        return float(scipy.optimize.brentq(missing, 0.0, longest))

    directions = np.array([_alone(column, least, most) for column in each.T])
    if not known or not np.any(directions):
        return posterior
    logarithms = needed(directions) * directions
    if effective_number(weights(logarithms)) < 0.9 * least:
        return posterior
    return replace(posterior, weights=weights(logarithms), widened=math.exp(float(np.max(logarithms))))


def _alone(squares: Array, least: float, most: float) -> float:
    """Logarithm of the factor on the uncertainty of one value with which enough points have weight."""

    def missing(logarithm: float) -> float:
        chi2 = squares / math.exp(2.0 * logarithm)
        return effective_number(weights_of(np.where(np.isfinite(chi2), chi2, np.inf))) - least

    if missing(0.0) >= 0.0:
        return 0.0
    return most if missing(most) < 0.0 else float(scipy.optimize.brentq(missing, 0.0, most))


@dataclass(frozen=True)
class _NonZero:
    """Model that predicts nothing where a value of 0 cannot be what was measured, as the breakdown voltage of
    surfaces that touch: a measured voltage then belongs to the films that separate them.
    """

    predict: Predict
    measured: Mask  # whether a measured value is far from 0, shape (m,)

    def __call__(self, at: Array) -> Array:
        """Return predictions at points, shape (n, k) -> (n, m)."""
        return self.kept(self.predict(at))

    def kept(self, predictions: Array) -> Array:
        """Predictions, NaN instead of 0."""
        return np.where((predictions == 0.0) & self.measured, np.nan, predictions)


def _active(predict: Predict, at: Array, predictions: Array) -> Mask:
    """Inputs with an effect on a prediction, shape (k,); the first input if none has.

    At the first points of the design with predictions, each input is changed by half of its range.
    """
    known = np.flatnonzero(np.all(np.isfinite(predictions), axis=1))[:_CHANGED]
    width = at.shape[1]
    if not known.size:
        return np.ones(width, dtype=bool)
    # The points themselves are the first: all inputs unchanged.
    points = np.repeat(at[known][np.newaxis], width + 1, axis=0)
    inputs = np.arange(width)
    points[inputs + 1, :, inputs] = (points[inputs + 1, :, inputs] + 0.5) % 1.0
    values = predict(points.reshape(-1, width)).reshape(width + 1, known.size, -1)
    equal = np.isclose(values[1:], values[0], rtol=_EQUAL, atol=0.0)
    active: Mask = ~np.all(equal, axis=(1, 2))
    active[0] |= not np.any(active)
    return active


def _widened(
    uncertainties: Array, at: Array, predictions: Array, values: Array, errors: Errors | None
) -> Array:
    """Uncertainties with the errors of predictions at the points that are likely after the measurement.

    The points are weighted with the errors of a step before, from the mean error of all points.
    """
    if errors is None:
        return uncertainties
    squares = np.square(errors(at))
    wide = np.hypot(uncertainties, np.sqrt(np.mean(squares, axis=0)))
    for _ in range(_WIDENED):
        weights = weights_of(chi_squares(predictions, values, wide))
        wide = np.hypot(uncertainties, np.sqrt(weights @ squares))
    return wide


def nearest_of(
    predict: Predict,
    at: Array,
    predictions: Array,
    values: Array,
    uncertainties: Array,
    active: Mask,
    seed: int,
) -> Nearest:
    """Prediction that is nearest to measured values; ``predictions`` at points ``at`` are known, shape (n, m)
    and (n, k); ``active``, inputs with an effect, shape (k,).
    """
    width = at.shape[1]
    emulator = Emulator.of(at, predictions, np.zeros(width), np.ones(width), active)
    return _Measured(predict, values, uncertainties, seed).nearest(at, predictions, emulator)


@dataclass(frozen=True)
class _Measured:
    """Model with the values that were measured."""

    predict: Predict
    values: Array
    uncertainties: Array
    seed: int

    def chi2_of(self, emulator: Emulator, at: Array) -> Array:
        """chi2 of polynomials, whose error widens the uncertainties, shape (n,)."""
        wide = np.hypot(self.uncertainties, emulator.deviation(self.values))
        return chi_squares(emulator.at(at), self.values, wide)

    def nearest(self, at: Array, predictions: Array, emulator: Emulator | None) -> Nearest:
        """Nearest prediction, from the points of the design and by least squares.

        The polynomials are shifted to the value of the model at each point of the search.
        """
        chi2 = chi_squares(predictions, self.values, self.uncertainties)
        place = int(np.argmin(chi2))
        point, prediction, least = at[place], predictions[place], float(chi2[place])
        if emulator is None:
            return Nearest(point, prediction, least, 1)
        dense = sobol_points(at.shape[1], _DENSE, self.seed)
        start = dense[int(np.argmin(self.chi2_of(emulator, dense)))]
        starts = [point, start]
        for j in np.flatnonzero(np.abs(prediction - self.values) > _FAR * self.uncertainties).tolist():
            starts += self._between(at, predictions, j)
        for first in starts:
            now = first
            for _ in range(_SEARCH):
                known = self.predict(now[np.newaxis])[0]
                chi = float(chi_squares(known[np.newaxis], self.values, self.uncertainties)[0])
                if not math.isfinite(chi):
                    break
                if chi < least:
                    point, prediction, least = now, known, chi
                following = self._least_squares(emulator, now, known)
                if np.max(np.abs(following - now)) < 1e-6:
                    break
                now = following
        return Nearest(point, prediction, least, self._freedom(emulator, point, prediction))

    def _between(self, at: Array, predictions: Array, j: int) -> list[Array]:
        """Points where the value ``j`` is met on lines from points with a larger prediction of it to points
        with a smaller one or none; on both sides the points at which the other values are nearest.

        Voltages that fall to 0 as summits begin to touch are small in a thin layer that no point hits.
        """
        others = np.arange(self.values.size) != j
        misfit = chi_squares(predictions[:, others], self.values[others], self.uncertainties[others])
        column = np.nan_to_num(predictions[:, j])
        above, below = (
            np.flatnonzero(side & np.isfinite(misfit))
            for side in (column >= self.values[j], column <= self.values[j])
        )
        if not (above.size and below.size):
            return []
        points = []
        order = np.argsort(misfit[above] + np.square(column[above] / np.max(column)))
        for place in above[order][:_LINES].tolist():
            high = at[place]
            apart = np.sum(np.square(at[below] - high), axis=1)
            low = at[below[int(np.argmin(misfit[below] + apart))]]
            for _ in range(_NARROWED):
                line = low + np.linspace(0.0, 1.0, _ON_LINE)[:, np.newaxis] * (high - low)
                known = self.predict(line)
                larger = np.flatnonzero(known[:, j] > self.values[j])
                last = int(larger[0]) if larger.size else len(line) - 1
                low, high = line[max(last - 1, 0)], line[last]
            distances = chi_squares(known, self.values, self.uncertainties)
            if np.isfinite(distances).any():
                points.append(line[int(np.argmin(np.where(np.isfinite(distances), distances, np.inf)))])
        return points

    def _least_squares(self, emulator: Emulator, now: Array, known: Array) -> Array:
        """Inputs at which shifted polynomials are nearest to the measured values, shape (k,)."""
        shift = self._shift(emulator, now, known)

        def residuals(at: Array) -> Array:
            transformed = emulator.transformed(at[np.newaxis])[0] + shift
            logs = emulator.logs
            values = np.where(logs, np.exp(np.where(logs, transformed, 0.0)), transformed)
            return np.asarray((values - self.values) / self.uncertainties)

        inner = np.clip(now, 1e-9, 1.0 - 1e-9)
        solved: Array = scipy.optimize.least_squares(residuals, inner, bounds=(0.0, 1.0), max_nfev=60).x
        return solved

    def _shift(self, emulator: Emulator, now: Array, known: Array) -> Array:
        """Difference of the model from its polynomials at a point, shape (m,)."""
        logs = emulator.logs & (known > 0.0)
        transformed = np.where(logs, np.log(np.where(logs, known, 1.0)), known)
        shift = transformed - emulator.transformed(now[np.newaxis])[0]
        return np.where(logs == emulator.logs, shift, 0.0)

    def _freedom(self, emulator: Emulator, point: Array, prediction: Array) -> int:
        """Measured values less the directions of the inputs that change them by more than one standard
        uncertainty within the ranges; at least 1.
        """
        slopes = slopes_of(emulator, point, prediction) / self.uncertainties
        free = (point > 1e-3) & (point < 1.0 - 1e-3)
        if not np.any(free):
            return int(self.values.size)
        singular = np.linalg.svd(slopes[free].T, compute_uv=False)
        return max(int(self.values.size - np.count_nonzero(singular > 1.0)), 1)

    def drawn(self, emulator: Emulator, nearest: Nearest, number: int) -> tuple[Array, Array]:
        """Points of a Markov chain for polynomials within their box, shape (number, k), and the whole chain
        after its beginning, shape (n, k).
        """
        try:
            import emcee
        except ImportError:
            takes = "it, installed with: pip install 'ehlectric[calibration]'"
            raise InputError("calibrate", "needs the package emcee for these values", takes=takes) from None
        low, high = emulator.low, emulator.high
        width = low.size
        walkers = max(_WALKERS * width, _LEAST_WALKERS)

        def logarithm(at: Array) -> Array:
            inside = np.all((at >= low) & (at <= high), axis=1)
            chi2 = self.chi2_of(emulator, np.clip(at, low, high))
            return np.where(inside, -0.5 * chi2, -np.inf)

        random = np.random.default_rng(self.seed)
        start = self._tempered(emulator, nearest, walkers, random)
        moves = [(emcee.moves.DEMove(), 0.8), (emcee.moves.DESnookerMove(), 0.2)]
        sampler = emcee.EnsembleSampler(walkers, width, logarithm, vectorize=True, moves=moves)
        sampler.random_state = np.random.RandomState(self.seed).get_state()
        sampler.run_mcmc(start, _STEPS, skip_initial_state_check=True)
        chain: Array = sampler.get_chain(discard=_BURN, flat=True)
        points = chain[random.choice(len(chain), size=number, replace=False)]
        # Without an effect, an input is even in its box, which a design fills better than a chain.
        idle = ~emulator.active
        if np.any(idle):
            design = sobol_points(int(np.count_nonzero(idle)), number, self.seed)
            points[:, idle] = low[idle] + (high - low)[idle] * design
        return points, chain

    def _tempered(
        self, emulator: Emulator, nearest: Nearest, walkers: int, random: np.random.Generator
    ) -> Array:
        """First points of the walkers: points of a design in the box, drawn by weights L^t.

        The exponent t is halved from 1 until the effective number is at least the number of walkers.
        """
        low, high = emulator.low, emulator.high
        dense = low + (high - low) * sobol_points(low.size, _DENSE, self.seed)
        chi2, part = self.chi2_of(emulator, dense), 1.0
        while effective_number(weights_of(part * chi2)) < walkers and part > 1e-9:
            part *= 0.5
        places = random.choice(len(dense), size=walkers, replace=False, p=_positive(weights_of(part * chi2)))
        points = dense[places]
        points[0] = np.clip(nearest.at, low + 1e-9 * (high - low), high - 1e-9 * (high - low))
        return points


def _positive(weights: Array) -> Array:
    """Weights above 0 with the sum 1."""
    raised = weights + 1e-12
    return np.asarray(raised / np.sum(raised))


def slopes_of(emulator: Emulator, point: Array, prediction: Array) -> Array:
    """Change of each prediction if an input crosses its range, by the slope at a point, shape (k, m)."""
    step = 1e-4
    up, down = (point + sign * step * np.eye(point.size) for sign in (1.0, -1.0))
    slopes = (emulator.transformed(up) - emulator.transformed(down)) / (2.0 * step)
    return np.where(emulator.logs, slopes * prediction, slopes)
