"""Sensitivity indices against closed forms, against SciPy, and what happens where points failed."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import sobol_indices

from ehlectric import InputError
from ehlectric.sweep.points import Range
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.sensitivity_indices import LEVEL, _of_means, indices, intervals, sensitivity
from tests.helpers.sweep_models import LOAD, SPEED, breakdown, grid, sobol

VALUE = "model.y"


def of(function, ranges, samples, **how):
    """A sweep whose value is a function of the varied inputs in their order."""
    return sobol(ranges, samples, lambda row: {"model": {"y": function(*row.values())}}, **how)


def first_and_total(found):
    return [i.first_order for i in found.indices], [i.total for i in found.indices]


def without(results: SweepResults, numbers):
    """The sweep with some points failed."""
    changed = [
        dataclasses.replace(point, status="failed", summary=None) if point.number in numbers else point
        for point in results.points
    ]
    return dataclasses.replace(results, points=tuple(changed))


def test_ishigami():
    """Ishigami and Homma 1990, doi:10.1109/ISUMA.1990.151285: the integrals of its parts, by hand."""
    a, b = 7.0, 0.1
    v1, v2 = 0.5 * (1.0 + b * math.pi**4 / 5.0) ** 2, a**2 / 8.0
    v13 = 8.0 * b**2 * math.pi**8 / 225.0
    variance = v1 + v2 + v13
    span = Range(-math.pi, math.pi)
    found = sensitivity(
        of(
            lambda x, y, z: math.sin(x) + a * math.sin(y) ** 2 + b * z**4 * math.sin(x),
            {"x": span, "y": span, "z": span},
            2048,
        ),
        VALUE,
    )
    first, total = first_and_total(found)
    assert first == pytest.approx([v1 / variance, v2 / variance, 0.0], abs=0.01)
    assert total == pytest.approx([(v1 + v13) / variance, v2 / variance, v13 / variance], abs=0.01)
    for index in found.indices:
        assert index.first_order_interval[0] <= index.first_order <= index.first_order_interval[1]
        assert index.total_interval[0] <= index.total <= index.total_interval[1]
    assert found.spread.mean == pytest.approx(a / 2.0, abs=0.02)
    assert found.spread.standard_deviation == pytest.approx(math.sqrt(variance), rel=0.01)


def test_additive_model():
    """y = sum a_i x_i: first order and total are both a_i^2 var_i over their sum, var = width^2/12."""
    slopes, ranges = (3.0, -2.0, 0.5), {"x": Range(0.0, 1.0), "y": Range(2.0, 5.0), "z": Range(-1.0, 1.0)}
    parts = np.array([(a * (r.stop - r.start)) ** 2 for a, r in zip(slopes, ranges.values(), strict=True)])
    found = sensitivity(
        of(lambda *x: sum(a * v for a, v in zip(slopes, x, strict=True)), ranges, 1024), VALUE
    )
    for got in first_and_total(found):
        assert got == pytest.approx(list(parts / parts.sum()), abs=0.005)


def test_product_model():
    """y = prod (1 + c_i x_i), x_i uniform in (-1, 1): variance prod(1 + c_i^2/3) - 1, so for its parts."""
    c = np.array([1.0, 0.6, 0.3])
    factors = 1.0 + c**2 / 3.0
    variance = factors.prod() - 1.0
    span = Range(-1.0, 1.0)
    results = of(
        lambda *x: math.prod(1.0 + k * v for k, v in zip(c, x, strict=True)),
        {"x": span, "y": span, "z": span},
        4096,
    )
    first, total = first_and_total(sensitivity(results, VALUE, resamples=10))
    assert first == pytest.approx(list((factors - 1.0) / variance), abs=0.01)
    assert total == pytest.approx(list((factors - 1.0) * factors.prod() / factors / variance), abs=0.01)


def some_rows(inputs=3, rows=64, seed=1):
    """Values at A, B and the mixed rows of a function that is no sum, at independent rows."""
    x = np.random.default_rng(seed).random((2, inputs, rows))
    mixed = np.repeat(x[:1], inputs, axis=0)
    for k in range(inputs):
        mixed[k, k] = x[1, k]

    def y(x):
        return np.exp(x[..., 0, :]) * (1.0 + x[..., 1, :]) + x[..., -1, :] ** 2

    return y(x[0]), y(x[1]), y(mixed)


def test_complete_design_as_scipy_has_it():
    a, b, mixed = some_rows()
    theirs = sobol_indices(func={"f_A": a[None], "f_B": b[None], "f_AB": mixed[:, None]}, n=a.size)
    first, total = indices(a, b, mixed)
    np.testing.assert_allclose(first, theirs.first_order.ravel(), rtol=1e-10)
    np.testing.assert_allclose(total, theirs.total_order.ravel(), rtol=1e-10)


@pytest.mark.slow
@pytest.mark.gate
@given(
    scale=st.floats(1e-6, 1e6),
    sign=st.sampled_from([-1.0, 1.0]),
    shift=st.floats(-100.0, 100.0),
    seed=st.integers(0, 99),
)
def test_unit_and_zero_of_the_value_do_not_matter(scale, sign, shift, seed):
    a, b, mixed = some_rows(seed=seed)
    slope = sign * scale
    plain = [indices(a, b, mixed), intervals(a, b, mixed, resamples=20, seed=3)]
    moved = [slope * (v + shift) for v in (a, b, mixed)]
    other = [indices(*moved), intervals(*moved, resamples=20, seed=3)]
    np.testing.assert_allclose(np.ravel(other[0]), np.ravel(plain[0]), atol=1e-9)
    np.testing.assert_allclose(np.ravel(other[1]), np.ravel(plain[1]), atol=1e-9)


@pytest.mark.slow
@pytest.mark.gate
@given(seed=st.integers(0, 999), inputs=st.integers(2, 5))
def test_totals_are_no_less_than_first_order(seed, inputs):
    """Of the true indices; of estimates but for their scatter: twice both of their intervals, four standard
    deviations of either.
    """
    low, high = intervals(*some_rows(inputs, seed=seed), resamples=100, seed=0)
    reach = high - low
    assert np.all(high[1] + 0.5 * reach[1] >= low[0] - 0.5 * reach[0])
    assert np.all(low <= high)
    assert np.all(low[1] >= 0.0)


@pytest.mark.slow
def test_intervals_hold_the_truth_as_often_as_they_say():
    """y = 2 x1 + x2 has the indices 4/5 and 1/5. Of 400 designs of independent rows, 95 % should hold each;
    three standard deviations of a count are 3.3 %, and percentile intervals are known to be a little short.
    """
    held = np.zeros((2, 2))
    for seed in range(400):
        x = np.random.default_rng(seed).random((2, 2, 256))
        values = [2.0 * x[i, 0] + x[j, 1] for i, j in ((0, 0), (1, 1), (1, 0), (0, 1))]
        low, high = intervals(values[0], values[1], np.array(values[2:]), resamples=200, seed=seed)
        held += (low <= [0.8, 0.2]) & (high >= [0.8, 0.2])
    assert np.all(held / 400 > LEVEL - 0.05)
    assert np.all(held / 400 < LEVEL + 0.035)


def test_failed_points_take_their_rows_along():
    """The same numbers as from the rows that are left, by the formulas as they are printed."""
    ranges = {"x": Range(0.0, 1.0), "y": Range(0.0, 2.0)}
    n = 64
    results = of(lambda x, y: x * math.exp(y), ranges, n)
    failed = {3, n + 7, 2 * n + 20, 3 * n + 20, 3 * n + 63}
    found = sensitivity(without(results, failed), VALUE)
    assert (found.rows, found.used, found.dropped, found.solved) == (64, 60, 4, 4 * n - 5)
    kept = np.delete(np.arange(n), [3, 7, 20, 63])
    a, b, *mixed = results.values(VALUE).reshape(4, n)[:, kept]
    both = np.concatenate([a, b])
    middle, variance = both.mean(), both.var()
    for k, index in enumerate(found.indices):
        first = np.mean((b - middle) * (mixed[k] - a)) / variance
        total = 0.5 * np.mean((a - mixed[k]) ** 2) / variance
        assert (index.first_order, index.total) == pytest.approx((first, total), rel=1e-10)
    # A point of A and one of B are not solved.
    assert found.spread.samples == 2 * n - 2


def test_spread_of_a_uniform_value():
    """From 10 to 30: mean 20, standard deviation 20/sqrt(12), quantiles on a line, within one part of n."""
    found = sensitivity(of(lambda x: 10.0 + 20.0 * x, {"x": Range(0.0, 1.0)}, 512), VALUE, resamples=10)
    spread = found.spread
    assert spread.samples == 1024
    assert spread.mean == pytest.approx(20.0, abs=0.01)
    assert spread.standard_deviation == pytest.approx(20.0 / math.sqrt(12.0), rel=2e-3)
    for q, value in spread.quantiles.items():
        assert value == pytest.approx(10.0 + 20.0 * q, abs=20.0 / 512)
    assert 10.0 <= spread.minimum < 10.05
    assert 29.95 < spread.maximum <= 30.0


def test_share_of_samples_that_break_down():
    """10 V (u/(4 m/s))^0.7 is below 5 V under 4 (1/2)^(1/0.7) m/s: a fixed part of a range."""
    ranges = {SPEED: Range(0.5, 4.5), LOAD: Range(1e6, 1e6 + 1e-3)}
    part = (4.0 * 0.5 ** (1.0 / 0.7) - 0.5) / 4.0
    for value in ("discharge.breakdown_voltage", "discharge.margin"):
        found = sensitivity(sobol(ranges, 256, breakdown), value, resamples=10)
        assert found.share_below_voltage == pytest.approx(part, abs=2.0 / 256)
    assert sensitivity(sobol(ranges, 256, breakdown), "film.minimum_thickness").share_below_voltage is None


def test_samples_that_are_not_solved_leave_bounds():
    """All samples below 1 m/s fail: they may break down or not, and any quantile may be one of them."""
    ranges = {SPEED: Range(0.5, 4.5), LOAD: Range(1e6, 1e6 + 1e-3)}
    whole = sobol(ranges, 256, breakdown)
    samples = whole.points[:512]
    failed = [point.number for point in samples if point.inputs[SPEED] < 1.0]
    below = sum(10.0 * (point.inputs[SPEED] / 4.0) ** 0.7 < 5.0 for point in samples)
    assert 0 < len(failed) < below
    found = sensitivity(without(whole, failed), "discharge.margin", resamples=10)
    low, high = found.share_below_voltage_bounds
    assert (low, high) == pytest.approx(((below - len(failed)) / 512.0, below / 512.0))
    assert low < found.share_below_voltage < high
    known = sensitivity(whole, "discharge.margin", resamples=10).spread
    assert found.spread.failed == len(failed)
    for q, (least, most) in found.spread.quantile_bounds.items():
        assert least is None or least <= known.quantiles[q]
        assert most is None or most >= known.quantiles[q]
        assert (least is None) == (q < len(failed) / 512.0)


def test_same_seed_same_intervals():
    rows = some_rows()
    one, same, other = (intervals(*rows, resamples=50, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, same)
    assert not np.array_equal(one, other)


def test_refusals():
    ranges = {SPEED: Range(0.5, 4.5), LOAD: Range(2e5, 2e6, "log")}
    results = sobol(ranges, 32, breakdown)
    value = "discharge.breakdown_voltage"
    refused = {
        r'design: got "grid"; sensitivity needs a sweep of the design "sobol"': (grid({SPEED: [1.0]}), value),
        r"nearest is discharge\.breakdown_voltage": (results, "discharge.breakdown_volts"),
        r"15 of 32 rows of the design are complete": (without(results, range(17)), value),
        r"field\.voltage: is 5 in all samples": (results, "field.voltage"),
        r"no point of 128 is solved": (without(results, range(128)), value),
    }
    for message, (given_results, key) in refused.items():
        with pytest.raises(InputError, match=message):
            sensitivity(given_results, key)


def test_rows_with_a_film_that_is_not_to_be_used_are_counted():
    """Points 3 of A and 5 of B are, and 3 of A with a column of B: two rows; a third is not complete."""
    results = of(lambda x, y: x + y, {"x": Range(0.0, 1.0), "y": Range(0.0, 1.0)}, 32)
    told = {"warnings": ["the film may be 32 % off"], "warning_codes": ["grid-far-too-coarse"]}
    points = [
        dataclasses.replace(point, summary={**point.summary, **told})
        if point.number in (3, 32 + 5, 64 + 3, 7)
        else point
        for point in results.points
    ]
    found = sensitivity(without(dataclasses.replace(results, points=tuple(points)), (32 + 7,)), VALUE)
    assert (found.doubtful, found.used, found.dropped) == (2, 31, 1)
    assert found.to_dict()["rows_doubtful"] == 2


def test_indices_do_not_depend_on_the_zero_of_the_value():
    """The means of a value and of the value plus 3, without centring, give equal indices."""
    a, b, *mixed = np.random.default_rng(3).standard_normal((4, 64))
    columns = []
    for shift in (0.0, 3.0):
        first, second, others = a + shift, b + shift, np.array(mixed) + shift
        change = others - first
        rows = [[first, second, first**2, second**2], second * change, change, change**2]
        columns.append(np.mean(np.concatenate(rows), axis=1)[np.newaxis])
    one, other = (_of_means(means) for means in columns)
    assert other[0] == pytest.approx(one[0], rel=1e-9)
    assert other[1] == pytest.approx(one[1], rel=1e-9)
