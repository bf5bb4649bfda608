"""Causes of measured values that nothing within the ranges explains.

A cause is one change after which inputs within their ranges explain all measured values: an input outside of
its range, a capacitance in parallel to a bearing or a mesh, or a factor on the values of one quantity. All
causes are judged by the same rule as the measurement itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from types import MappingProxyType

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.bearing import FILMS, Names
from ehlectric.calibration.models import Model
from ehlectric.calibration.posterior import (
    Nearest,
    Posterior,
    Predict,
    chi_squares,
    nearest_of,
    weighted_quantiles,
    weights_of,
)
from ehlectric.calibration.result import Cause
from ehlectric.cases.measured_inputs import MeasuredValue
from ehlectric.cases.measurements import calibrated, quantity_text
from ehlectric.discharge.breakdown_rule import INTERVAL
from ehlectric.errors import InputError
from ehlectric.formulas.sobol import sobol_points
from ehlectric.runtime.progress import Progress

# Largest number of measured values that may contradict the others, and largest number of causes.
_COMPARED, _CAUSES = 6, 3

# Steps of an input beyond its range, in parts of its width: least, largest and number; number of steps
# between the neighbours of the best one, and of steps to which these are interpolated.
_STEPS, _REFINED, _BETWEEN = (0.02, 20.0, 9), 7, 2001

# Largest part of the distance to 0 by which an input leaves its range.
_KEPT = 0.98

# Largest step of a temperature beyond its range [K] (engineering judgement: an error of a thermometer).
_WARMER = 60.0

# Largest parallel capacitance, divided by the median of the computed capacitances (engineering judgement: a
# larger one is an error of the unit), and number of points at which its interval is computed.
_PARALLEL, _DENSE = 5.0, 8192

# Difference of chi2 below which two causes explain the measurement equally well: two standard deviations of
# one parameter.
_EQUAL = 4.0

# Largest step of an input, in parts of its range, that is the most probable cause.
_NEAR = 0.5

# Factors of wrong prefixes.
_PREFIXES = tuple((10.0**power, "factor-wrong-prefix") for power in (3, -3, 6, -6))
_DECIMAL = ((10.0, "factor-decimal-point"), (0.1, "factor-decimal-point"))
_PROBE = ((10.0, "factor-probe"), (0.1, "factor-probe"))
_PERCENT = ((100.0, "factor-per-cent"), (0.01, "factor-per-cent"))

# Factors of usual mistakes, and the code of each mistake, by the quantity: peak and root mean square of a
# sine differ by the square root of 2, peak to peak and peak by 2.
_OF_PEAK = (
    (2.0, "factor-peak-to-peak"),
    (0.5, "factor-half-peak"),
    (0.5**0.5, "factor-rms"),
    (2.0**0.5, "factor-peak-and-rms"),
    (8.0**0.5, "factor-peak-to-peak-for-rms"),
    *_PROBE,
    *_PREFIXES,
)
_OF_BREAKDOWN = ((2.0, "factor-peak-to-peak"), *_PROBE, *_PREFIXES)
FACTORS: Mapping[str, tuple[tuple[float, str], ...]] = MappingProxyType(
    {
        "capacitance": ((2.0, "factor-two-bearings"), *_DECIMAL, *_PREFIXES),
        "first_breakdown_voltage": _OF_BREAKDOWN,
        "breakdown_voltage": _OF_BREAKDOWN,
        "shaft_voltage": _OF_PEAK,
        "voltage": _OF_PEAK,
        "shaft_voltage_rms": (
            *(
                (2.0**0.5, "factor-peak-for-rms"),
                (8.0**0.5, "factor-peak-to-peak-for-rms"),
                *_PROBE,
                *_PREFIXES,
            ),
        ),
        "bearing_voltage_ratio": (
            *((2.0, "factor-peak-to-peak"), (0.5, "factor-half-peak"), (2.0**0.5, "factor-peak-and-rms")),
            *((0.5**0.5, "factor-peak-and-rms"), *_PERCENT, *_PROBE),
        ),
        "discharge_rate": (
            *(
                (60.0, "factor-per-minute"),
                (1.0 / 60.0, "factor-per-minute"),
                (0.5, "factor-single-bearing"),
                (2.0, "factor-twice"),
            ),
            *(*_DECIMAL, *_PREFIXES),
        ),
        "conducting_share": (*_PERCENT, *_DECIMAL),
        "film": (*_DECIMAL, *_PREFIXES),
    }
)


@dataclass(frozen=True)
class CauseSearch:
    """Search for the causes of measured values that nothing within the ranges explains."""

    model: Model
    rows: tuple[MeasuredValue, ...]
    predict: Predict
    posterior: Posterior
    seed: int
    progress: Progress

    @property
    def values(self) -> Array:
        """Measured values, SI units, shape (m,)."""
        return np.array([row.value for row in self.rows])

    @property
    def errors(self) -> Array:
        """Standard uncertainties of measured values and predictions, SI units, shape (m,)."""
        return self.posterior.uncertainties

    def contradicting(self) -> Iterator[int]:
        """Places of measured values without which inputs within the ranges explain the others. Only the
        values with the largest residuals are examined.
        """
        farthest = np.argsort(-np.abs(self.posterior.residuals))[:_COMPARED]
        for place in sorted(farthest.tolist()):
            others = np.arange(self.values.size) != place

            def predict(at: Array, others: Array = others) -> Array:
                return self.predict(at)[:, others]

            values, errors = self.values[others], self.errors[others]
            nearest = self._nearest(predict, self.posterior.prior_predictions[:, others], values, errors)
            if self._judged(nearest, values, errors).explained:
                yield place

    def causes(self, contradicting: Sequence[int]) -> tuple[Cause, ...]:
        """Causes that explain all measured values, the most probable first.

        A cause with a smaller chi2 comes first. If two explain the values equally well, an input near its
        range is more probable than a parallel capacitance, then a factor, then an input far from its range.
        """
        known = [*self._of_inputs(contradicting), *self._parallel(), *self._of_factors()]
        least = min((chi2 for _, chi2, _ in known), default=0.0)
        known.sort(key=lambda each: (each[1] > least + _EQUAL, each[0], each[1]))
        return tuple(cause for _, _, cause in known[:_CAUSES])

    def _of_factors(self) -> Iterator[tuple[float, float, Cause]]:
        """Factors that all values of one quantity need: rank, chi2 and cause of the most probable one."""
        for quantity, mask in self._quantities():
            usual = FACTORS.get(quantity.rpartition(".")[2], ())
            known = [(self._evidence(mask, factor), factor, meaning) for factor, meaning in usual]
            for _, factor, meaning in sorted(known, reverse=True)[:2]:
                scale = np.where(mask, factor, 1.0)
                values, errors = self.values / scale, self.errors / scale
                nearest = self._nearest(self.predict, self.posterior.prior_predictions, values, errors)
                judged = self._judged(nearest, values, errors)
                if judged.explained:
                    label, left = quantity_text(quantity), _left(judged)
                    yield (
                        2.0,
                        nearest.chi2,
                        Cause("factor", quantity, label, factor, None, *left, meaning=meaning),
                    )
                    break

    def _evidence(self, mask: Mask, factor: float) -> float:
        """Logarithm of the mean likelihood within the ranges, if some values are divided by a factor."""
        scale = np.where(mask, factor, 1.0)
        predictions = self.posterior.prior_predictions
        chi2 = chi_squares(predictions, self.values / scale, self.errors / scale)
        return float(scipy.special.logsumexp(-0.5 * chi2[np.isfinite(chi2)]))

    def _parallel(self) -> Iterator[tuple[float, float, Cause]]:
        """Parallel capacitance that a meter reads in addition: rank, chi2 and cause."""
        posterior = self.posterior
        width = posterior.prior_at.shape[1]
        for quantity, mask in self._quantities():
            if calibrated(quantity).unit != "F" or np.all(posterior.residuals[mask] <= 0.0):
                continue
            self.progress(0, 0, f"searching for a cause: {quantity_text(quantity)} in parallel")
            most = _PARALLEL * float(np.nanmedian(posterior.prior_predictions[:, mask]))

            def added(at: Array, most: float = most, mask: Mask = mask) -> Array:
                return most * at[:, width:] * mask

            def predict(at: Array, added: Callable[[Array], Array] = added) -> Array:
                return self.predict(at[:, :width]) + added(at)

            parts = sobol_points(width + 1, len(posterior.prior_at), self.seed)[:, width:]
            at = np.concatenate([posterior.prior_at, parts], axis=1)
            predictions = posterior.prior_predictions + added(at)
            active = np.append(posterior.active, True)
            nearest = nearest_of(predict, at, predictions, self.values, self.errors, active, self.seed)
            judged = self._judged(nearest, self.values, self.errors)
            if judged.explained:
                needed = most * float(nearest.at[width])
                ends = self._interval(mask, most, needed)
                text = quantity_text(quantity)
                yield 1.0, nearest.chi2, Cause("parallel", quantity, text, needed, ends, *_left(judged))

    def _interval(self, mask: Mask, most: float, needed: float) -> tuple[float, float]:
        """Parallel capacitance at 5 % and 95 % after the measurement [F]."""
        emulator = self.posterior.emulator
        if emulator is None:
            return needed, needed
        dense = sobol_points(self.posterior.prior_at.shape[1] + 1, _DENSE, self.seed)
        added = most * dense[:, -1]
        predictions = emulator.at(dense[:, :-1]) + added[:, np.newaxis] * mask
        errors = np.hypot(self.errors, emulator.deviation(self.values))
        weights = weights_of(chi_squares(predictions, self.values, errors))
        low, _, high = weighted_quantiles(added, weights, INTERVAL).tolist()
        return min(low, needed), max(high, needed)

    def _of_inputs(self, contradicting: Sequence[int]) -> Iterator[tuple[float, float, Cause]]:
        """Inputs that explain the measurement outside of their ranges: rank, chi2 and cause of each.

        The other inputs stay at the nearest prediction, or at the point of the design that is nearest without
        one of the ``contradicting`` values. If no value contradicts the others, this is the value with the
        largest residual. Of both directions and of several points, the smallest step counts.
        """
        values, errors, posterior = self.values, self.errors, self.posterior
        starts = [posterior.nearest.at]
        largest = int(np.argmax(np.abs(posterior.residuals)))
        for place in contradicting or ([largest] if values.size > 1 else []):
            others = np.arange(values.size) != place
            chi2 = chi_squares(posterior.prior_predictions[:, others], values[others], errors[others])
            starts.append(posterior.prior_at[int(np.argmin(chi2))])
        names = self.model.names()
        for place in np.flatnonzero(posterior.active).tolist():
            name = names[place]
            self.progress(0, 0, f"searching for a cause: {name.label.partition(' (')[0]}")
            steps = self._steps(place, [*product(starts, (1.0, -1.0))])
            if not steps:
                continue
            step, sign, nearest = min(steps, key=lambda each: each[0])
            needed = float(self.model.values(place, np.array([0.5 + sign * (0.5 + step)]))[0])
            left = _left(self._judged(nearest, values, errors))
            label = f"factor on the {name.label}" if name.key.partition(".")[0] == FILMS else name.label
            cause = Cause("input", name.key, label, needed, ends_of(name), *left)
            yield (0.0 if step <= _NEAR else 3.0), nearest.chi2, cause

    def _steps(self, place: int, ways: Sequence[tuple[Array, float]]) -> list[tuple[float, float, Nearest]]:
        """Steps of an input beyond its range with the smallest chi2, in parts of the range, their signs and
        the predictions there; one for each start and sign that explains the measurement.
        """
        values, errors = self.values, self.errors
        least, most, number = _STEPS
        first = [
            np.concatenate([[0.0], np.geomspace(least, max(self._most(place, sign, most), least), number)])
            for _, sign in ways
        ]
        better, requested = [*ways], first
        lines = self._on_lines(place, better, requested)
        # The second time also between the last step that is computed and the first one that is refused.
        for _ in range(2):
            kept, brackets = [], []
            for way, line, (steps, predictions) in zip(better, requested, lines, strict=True):
                best = int(np.argmin(chi_squares(predictions, values, errors))) if len(steps) else 0
                if best:
                    kept.append(way)
                    high = line[min(best + 1, len(line) - 1)]
                    brackets.append(np.linspace(steps[best - 1], high, _REFINED))
            better, requested = kept, brackets
            lines = self._on_lines(place, better, requested)
        better = [way for way, (steps, _) in zip(better, lines, strict=True) if len(steps)]
        ends = []
        for steps, predictions in lines:
            if not len(steps):
                continue
            fine = np.linspace(steps[0], steps[-1], _BETWEEN)
            between = np.stack([np.interp(fine, steps, column) for column in predictions.T], axis=-1)
            ends.append(fine[[int(np.argmin(chi_squares(between, values, errors)))]])
        explained = []
        for (_, sign), (step, predictions) in zip(better, self._on_lines(place, better, ends), strict=True):
            if len(step):
                chi2 = float(chi_squares(predictions, values, errors)[0])
                nearest = replace(self.posterior.nearest, predictions=predictions[0], chi2=chi2)
                if self._judged(nearest, values, errors).explained:
                    explained.append((float(step[0]), sign, nearest))
        return explained

    def _most(self, place: int, sign: float, most: float) -> float:
        """Largest step of an input beyond an end of its range, in parts of the range: it keeps its sign."""
        low, high = self.model.values(place, np.array([0.0, 1.0])).tolist()
        end = high if sign > 0.0 else low
        if sign * end * (high - low) < 0.0:
            most = min(most, _KEPT * abs(end / (high - low)))
        if self.model.names()[place].key.endswith("temperature"):
            most = min(most, _WARMER / abs(high - low))
        return most

    def _on_lines(
        self, place: int, ways: Sequence[tuple[Array, float]], lines: Sequence[Array]
    ) -> list[tuple[Array, Array]]:
        """Steps of an input beyond its range, and the predictions there, shape (n,) and (n, m), of lines from
        starts in directions. Steps end before a point that is refused or has no prediction.
        """
        rows = []
        for (start, sign), steps in zip(ways, lines, strict=True):
            at = np.tile(start, (steps.size, 1))
            at[:, place] = 0.5 + sign * (0.5 + steps)
            rows.append(at)
        if not rows:
            return []
        try:
            predictions = self.predict(np.concatenate(rows))
        except InputError:
            parts = [self._before_refusal(at) for at in rows]
        else:
            parts = np.split(predictions, np.cumsum([len(at) for at in rows])[:-1])
        answers = []
        for steps, part in zip(lines, parts, strict=True):
            known = np.all(np.isfinite(part), axis=1)
            count = len(part) if np.all(known) else int(np.argmin(known))
            answers.append((steps[:count], part[:count]))
        return answers

    def _before_refusal(self, at: Array) -> Array:
        """Predictions at the first points of a line, before a point that is refused, shape (<= n, m)."""
        for count in range(len(at), 0, -1):
            try:
                return self.predict(at[:count])
            except InputError:
                continue
        return np.empty((0, self.values.size))

    def _quantities(self) -> Iterator[tuple[str, Mask]]:
        """Measured quantities, each with its rows, shape (m,)."""
        for quantity in dict.fromkeys(row.quantity for row in self.rows):
            yield quantity, np.array([row.quantity == quantity for row in self.rows])

    def _nearest(self, predict: Predict, predictions: Array, values: Array, errors: Array) -> Nearest:
        """Prediction within the ranges that is nearest to some values."""
        at, active = self.posterior.prior_at, self.posterior.active
        return nearest_of(predict, at, predictions, values, errors, active, self.seed)

    def _judged(self, nearest: Nearest, values: Array, errors: Array) -> Posterior:
        """Posterior with another nearest prediction of some values."""
        residuals = (values - nearest.predictions) / errors
        return replace(self.posterior, nearest=nearest, residuals=residuals)


def _left(judged: Posterior) -> tuple[float, float]:
    """Largest deviation in standard uncertainties, and probability of a larger chi2."""
    return float(np.max(np.abs(judged.residuals))), judged.nearest.p_value


def ends_of(name: Names) -> tuple[float, float]:
    """Ends of the range of an input; NaN of an input without a range."""
    low, high = (float("nan") if end is None else end for end in (name.low, name.high))
    return low, high
