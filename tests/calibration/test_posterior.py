"""Bayes' rule for inputs within their ranges, compared with closed forms."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric.calibration.causes import CauseSearch
from ehlectric.calibration.posterior import Nearest, chi_squares, infer, nearest_of, weights_of
from ehlectric.formulas.sobol import sobol_points
from ehlectric.runtime.progress import silent

ENDS = (0.05, 0.5, 0.95)

# Quantile of a standard normal distribution at 95 %.
Z95 = 1.6448536269514722


@pytest.mark.parametrize("error", [0.2, 0.02, 0.002])
def test_a_value_without_noise_gives_the_inverse_of_a_monotone_relation(error):
    """y = exp(2 u) is measured as exp(2 u0): ln y is about normal, so that u is N(u0, (error/2)^2)."""
    u0 = 0.45
    value = np.exp(2.0 * u0)
    posterior = infer(lambda at: np.exp(2.0 * at[:, :1]), 1, np.array([value]), np.array([error * value]))
    # The density of u is exp(-((exp(2u) - y)/(error y))^2/2), whose quantiles a fine grid gives.
    grid = np.linspace(0.0, 1.0, 200_001)
    weights = weights_of(
        chi_squares(np.exp(2.0 * grid[:, None]), np.array([value]), np.array([error * value]))
    )
    expected = np.interp(ENDS, np.cumsum(weights), grid)
    assert posterior.explained
    assert posterior.quantiles(ENDS)[0] == pytest.approx(expected, abs=0.15 * error)
    if error < 0.1:
        assert expected[1] == pytest.approx(u0, abs=0.1 * error)
        assert expected[2] - u0 == pytest.approx(0.5 * Z95 * error, rel=0.05)


@pytest.mark.parametrize("error", [0.1, 0.02])
def test_a_linear_model_has_the_conjugate_posterior(error):
    """Within wide ranges the posterior of y = A u is normal: covariance s^2 (A^T A)^-1, mean A^-1 y."""
    slopes = np.array([[1.0, 0.6], [0.2, 1.0]])
    true = np.array([0.5, 0.45])
    posterior = infer(lambda at: at @ slopes.T, 2, slopes @ true, np.full(2, error))
    covariance = error**2 * np.linalg.inv(slopes.T @ slopes)
    widths = np.sqrt(np.diagonal(covariance))
    quantiles = posterior.quantiles(ENDS)
    assert quantiles[:, 1] == pytest.approx(true, abs=0.2 * error)
    assert 0.5 * (quantiles[:, 2] - quantiles[:, 0]) == pytest.approx(Z95 * widths, rel=0.1)
    assert posterior.correlation[0, 1] == pytest.approx(covariance[0, 1] / np.prod(widths), abs=0.1)


def test_a_value_that_is_unknown_before_and_after_leaves_the_range():
    """A measured value with a large uncertainty changes nothing: quantiles of an even distribution."""
    posterior = infer(lambda at: at[:, :1], 2, np.array([0.5]), np.array([100.0]))
    assert posterior.quantiles(ENDS) == pytest.approx(np.array([ENDS, ENDS]), abs=0.01)
    assert posterior.effective == pytest.approx(512.0, rel=1e-3)


@pytest.mark.parametrize(("value", "explained"), [(2.05, True), (2.145, True), (2.155, False), (3.0, False)])
def test_a_value_more_than_three_uncertainties_beyond_the_range_is_not_explained(value, explained):
    """The model 1 + u reaches 2, and 3 standard uncertainties of 0.05 are 0.15."""
    posterior = infer(lambda at: 1.0 + at[:, :1], 2, np.array([value]), np.array([0.05]))
    assert posterior.explained == explained
    assert posterior.nearest.predictions[0] == pytest.approx(2.0, abs=1e-6)


def test_values_that_contradict_each_other_are_not_explained():
    """The nearest prediction of 0.3 and 0.7 with equal uncertainties is their mean."""
    posterior = infer(lambda at: at[:, [0, 0]], 2, np.array([0.3, 0.7]), np.full(2, 0.05))
    assert not posterior.explained
    assert posterior.nearest.predictions == pytest.approx(np.array([0.5, 0.5]), abs=1e-4)
    assert posterior.nearest.chi2 == pytest.approx(2.0 * 4.0**2, rel=1e-6)


def _model(at):
    """Smooth functions of three inputs, as a capacitance, a voltage and a temperature are."""
    a, b, c = at.T
    return np.stack([np.exp(a - 0.5 * b), 1.0 / (0.5 + b + c), 300.0 + 20.0 * a * c], axis=-1)


def test_true_inputs_lie_in_the_interval_of_90_per_cent():
    """Of 50 simulated measurements with known inputs, 40 to 49 have each input within its 90 % interval: the
    binomial distribution has 97 % of its probability there.
    """
    random = np.random.default_rng(7)
    inside = np.zeros(3, dtype=int)
    for _ in range(50):
        true = random.random(3)
        values = _model(true[np.newaxis])[0]
        errors = np.array([0.05, 0.05, 0.01]) * values
        posterior = infer(_model, 3, values + errors * random.standard_normal(3), errors, samples=256)
        low, _, high = posterior.quantiles(ENDS).T
        inside += (low <= true) & (true <= high)
    assert np.all((inside >= 40) & (inside <= 49)), inside


@pytest.mark.parametrize("sparing", [False, True])
def test_an_input_without_effect_keeps_its_even_distribution(sparing):
    """The input that the model exp(A u) ignores is even after a measurement that needs the Markov chain. The
    other two are about normal with the covariance s^2 (A^T A)^-1, as the relative error s of exp(A u) is the
    error of A u.
    """
    slopes, error = np.array([[1.0, 0.6], [0.2, 1.0]]), 0.02
    values = np.exp(slopes @ np.array([0.5, 0.45]))

    def predict(at):
        return np.exp(at[:, [0, 2]] @ slopes.T)

    posterior = infer(predict, 3, values, error * values, sparing=sparing)
    widths = error * np.sqrt(np.diagonal(np.linalg.inv(slopes.T @ slopes)))
    low, median, high = posterior.quantiles(ENDS).T
    assert posterior.chain
    assert posterior.active.tolist() == [True, False, True]
    assert len(posterior.prior_at) == (256 if sparing else 512)
    assert [low[1], median[1], high[1]] == pytest.approx(ENDS, abs=0.03)
    assert 0.5 * (high - low)[[0, 2]] == pytest.approx(Z95 * widths, rel=0.12)


def test_polynomials_of_many_inputs_get_the_whole_design():
    """Degree 3 in seven inputs needs 3 * 10!/(7! 3!) = 360 points, more than half of 512."""
    calls = []

    def predict(at):
        calls.append(len(at))
        return np.sum(at, axis=1, keepdims=True)

    posterior = infer(predict, 7, np.array([3.5]), np.array([0.5]), sparing=True)
    assert len(posterior.prior_at) == 512
    assert calls[0] == 256
    assert 256 in calls[1:]


@pytest.mark.parametrize("chi2", [0.2, 3.0, 11.0])
def test_probability_of_a_larger_chi2(chi2):
    """Closed forms: erfc(sqrt(x/2)) with one degree of freedom, and exp(-x/2) sum (x/2)^k/k! with 2, 4, 6."""
    half, at = 0.5 * chi2, np.zeros(1)
    series = np.cumsum([1.0, half, half**2 / 2.0]) * np.exp(-half)
    expected = [math.erfc(math.sqrt(half)), *series]
    found = [Nearest(at, at, chi2, freedom).p_value for freedom in (1, 2, 4, 6)]
    assert found == pytest.approx(expected, rel=1e-12)


def test_the_nearest_prediction_of_a_linear_model_is_its_inverse():
    """Two values of two inputs by 1 + 3a + b and 2 - a + 2b, measured at a = 0.4 and b = 0.7."""

    def predict(at):
        return np.array([1.0, 2.0]) + at @ np.array([[3.0, -1.0], [1.0, 2.0]])

    at, measured = sobol_points(2, 64, 1), predict(np.array([0.4, 0.7]))
    found = nearest_of(predict, at, predict(at), measured, np.full(2, 0.01), np.ones(2, dtype=bool), 1)
    assert found.at == pytest.approx([0.4, 0.7], abs=1e-3)
    assert found.predictions == pytest.approx(measured, abs=1e-3)


def test_a_voltage_of_summits_that_almost_touch_is_explained():
    """Breakdown voltage of a film h less summits s, 0 where they touch; both from 0 to 1.

    A value near 0 means h = s, whatever s is: s keeps its range of 0.05 to 0.95, and h follows s.
    """

    def predict(at):
        return np.maximum(2.0 * (at[:, :1] - at[:, 1:]), 0.0)

    values, uncertainties = np.array([2.4e-3]), np.array([1.2e-4])
    posterior = infer(predict, 2, values, uncertainties, samples=512)
    assert posterior.explained
    assert abs(posterior.nearest.predictions[0] - values[0]) < 3.0 * uncertainties[0]
    assert posterior.correlation[0, 1] > 0.9
    assert posterior.quantiles((0.05, 0.95))[1] == pytest.approx([0.05, 0.95], abs=0.1)
    assert posterior.effective >= 5.0
    # A value beyond the ranges is still unexplained, and one of touching summits as well.
    assert not infer(predict, 2, np.array([2.2]), np.array([0.01]), samples=64).explained
    touching = infer(lambda at: 0.0 * predict(at), 2, values, uncertainties, samples=64)
    assert (touching.explained, touching.nearest.predictions.tolist()) == (False, [0.0])


def test_a_line_without_a_prediction_at_its_start_has_no_step():
    """Points that are computed together with others may have no prediction, though they had one alone."""
    rounds = iter(range(9))

    def predict(at):
        return 2.0 * at if next(rounds) < 2 else np.full(at.shape, np.nan)

    row = SimpleNamespace(value=3.0, quantity="capacitance")
    names = [SimpleNamespace(key="films", label="films")]
    model = SimpleNamespace(names=lambda: names, values=lambda _, at: 1.0 + at)
    posterior = infer(lambda at: 2.0 * at, 1, np.array([3.0]), np.array([0.1]), samples=64)
    search = CauseSearch(model, (row,), predict, posterior, 1, silent)
    assert search._steps(0, [(posterior.nearest.at, 1.0), (posterior.nearest.at, -1.0)]) == []


@pytest.mark.parametrize("second", [1.2, 1.9, 2.5])
def test_a_small_voltage_and_a_second_value_are_explained_together(second):
    """v = max(2 (a - b), 0) and c = 1 + d + a: b = a, and d follows from c."""

    def predict(at):
        return np.stack([np.maximum(2.0 * (at[:, 0] - at[:, 1]), 0.0), 1.0 + at[:, 2] + at[:, 0]], axis=-1)

    posterior = infer(predict, 3, np.array([2.4e-3, second]), np.array([1.2e-4, 0.01]))
    assert posterior.explained
    assert np.max(np.abs(posterior.residuals)) < 3.0
    assert posterior.effective >= 5.0
    # The second value, which many points have, moves its mean of 2 before by more than a third of the way.
    mean = posterior.weights @ (1.0 + posterior.at[:, 2] + posterior.at[:, 0])
    assert abs(mean - second) < 2.0 / 3.0 * abs(2.0 - second) + 0.1


def test_few_points_with_a_prediction_are_not_one_point():
    """A film that is separated at 1 % of the points only."""
    values, errors = np.array([0.01]), np.array([0.0005])
    posterior = infer(lambda at: 2.0 * np.maximum(at[:, :1] - 0.99, 0.0), 1, values, errors)
    assert posterior.explained
    assert posterior.effective > 2.0
    assert posterior.widened > 1.0
