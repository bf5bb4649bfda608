"""Designs: every point once and in order, within its range, seeded, and of use for sensitivity indices."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from ehlectric.sweep.points import Range
from ehlectric.sweep.sweep_inputs import between, grid, paired, shares, sobol

lists = st.lists(st.lists(st.integers(), min_size=1, max_size=4, unique=True), min_size=1, max_size=4)
linear = st.tuples(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6)).map(lambda ends: Range(ends[0], sum(ends)))
log = st.tuples(st.floats(1e-9, 1e6), st.floats(1.001, 1e6)).map(
    lambda ends: Range(ends[0], ends[0] * ends[1], "log")
)
ranges = st.lists(st.one_of(linear, log), min_size=1, max_size=5).map(
    lambda found: {f"key{k}": over for k, over in enumerate(found)}
)


@given(lists)
def test_a_grid_has_every_point_once_the_last_key_fastest(values):
    axes = {f"key{k}": axis for k, axis in enumerate(values)}
    points = list(grid(axes))
    assert len(points) == math.prod(map(len, values))
    assert len({tuple(point.values()) for point in points}) == len(points)
    for number, point in enumerate(points):
        # The number of a point in a C-ordered array of the lengths of the axes.
        places = np.unravel_index(number, [len(axis) for axis in values])
        assert point == {key: axis[k] for (key, axis), k in zip(axes.items(), places, strict=True)}


@given(st.integers(1, 5), st.integers(1, 5))
def test_pairs_are_the_values_of_one_place(keys, length):
    axes = {f"key{k}": [(k, place) for place in range(length)] for k in range(keys)}
    points = list(paired(axes))
    assert points == [{key: (k, place) for k, key in enumerate(axes)} for place in range(length)]


@given(ranges, st.integers(1, 6), st.integers(0, 2**32))
def test_a_sobol_design_is_a_then_b_then_a_with_columns_of_b(over, power, seed):
    n, d = 2**power, len(over)
    points = np.array([list(point.values()) for point in sobol(over, n, seed)])
    assert points.shape == (n * (d + 2), d)
    blocks = points.reshape(d + 2, n, d)
    first, second = blocks[:2]
    for k in range(d):
        np.testing.assert_array_equal(blocks[2 + k][:, k], second[:, k])
        others = [j for j in range(d) if j != k]
        np.testing.assert_array_equal(blocks[2 + k][:, others], first[:, others])
    for k, ends in enumerate(over.values()):
        assert points[:, k].min() >= ends.start
        assert points[:, k].max() <= ends.stop


@given(ranges, st.integers(0, 2**32))
def test_every_stratum_of_a_range_holds_one_row(over, seed):
    """Sobol's sequence is a net: each of n equal parts of a side, in the range's own spacing, has one row."""
    n = 16
    points = np.array([list(point.values()) for point in sobol(over, n, seed)])[:n]
    for k, ends in enumerate(over.values()):
        edges = between(ends, np.linspace(0.0, 1.0, n + 1))
        counts = np.histogram(points[:, k], edges)[0]
        # Values that lie on an edge to rounding may be counted beside it.
        assert counts.sum() == n
        assert np.abs(np.cumsum(counts) - np.arange(1, n + 1)).max() <= 1


def test_the_seed_alone_makes_the_points():
    over = {"a": Range(0.0, 1.0), "b": Range(1.0, 1e3, "log")}
    assert list(sobol(over, 8, 3)) == list(sobol(over, 8, 3))
    assert list(sobol(over, 8, 3)) != list(sobol(over, 8, 4))


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_indices_of_a_function_that_are_known(seed):
    """Ishigami's function with a = 7, b = 0.1, whose variance is split so (Ishigami and Homma, 1990)."""
    a, b = 7.0, 0.1
    parts = 0.5 * (1.0 + b * math.pi**4 / 5.0) ** 2, a**2 / 8.0, 8.0 * b**2 * math.pi**8 / 225.0
    total = sum(parts)
    over = dict.fromkeys("xyz", Range(-math.pi, math.pi))
    n = 4096
    x, y, z = np.array([list(point.values()) for point in sobol(over, n, seed)]).T
    values = (np.sin(x) * (1.0 + b * z**4) + a * np.sin(y) ** 2).reshape(5, 1, n)
    found = stats.sobol_indices(func={"f_A": values[0], "f_B": values[1], "f_AB": values[2:]}, n=n)
    first = np.array([parts[0], parts[1], 0.0]) / total
    both = np.array([parts[0] + parts[2], parts[1], parts[2]]) / total
    np.testing.assert_allclose(found.first_order, first, atol=0.02)
    np.testing.assert_allclose(found.total_order, both, atol=0.02)


@given(st.one_of(linear, log))
def test_ends_are_exact_and_steps_even(over):
    values = between(over, np.linspace(0.0, 1.0, 9))
    assert (values[0], values[-1]) == (over.start, over.stop)
    steps = np.diff(np.log(values) if over.spacing == "log" else values)
    scale = max(abs(over.start), abs(over.stop)) if over.spacing == "linear" else 1.0
    np.testing.assert_allclose(steps, steps.mean(), rtol=1e-9, atol=1e-13 * max(scale, 30.0))


@given(st.integers(-50, 50), st.integers(1, 9))
def test_whole_numbers_have_equal_shares(start, length):
    per = 1000
    unit = (np.arange(per * (length + 1)) + 0.5) / (per * (length + 1))
    found = shares(Range(start, start + length), unit)
    numbers, counts = np.unique(found, return_counts=True)
    assert numbers.tolist() == list(range(start, start + length + 1))
    assert set(counts) == {per}


def test_whole_keys_of_a_sobol_design_are_whole():
    over = {"nodes": Range(1, 4), "speed": Range(0.0, 1.0)}
    points = list(sobol(over, 16, 0, whole=["nodes"]))
    assert {type(point["nodes"]) for point in points} == {int}
    # Sixteen rows of a net over four equal shares: four rows each.
    counts = [sum(point["nodes"] == number for point in points[:16]) for number in range(1, 5)]
    assert counts == [4, 4, 4, 4]


def test_designs_take_their_points_as_they_come():
    """A million points are not held in memory by the grid itself."""
    points = grid({key: list(range(100)) for key in "abc"})
    assert [point["c"] for point in itertools.islice(points, 3)] == [0, 1, 2]
