"""Film and temperature in turns are given up: their changes are large, and long without a smaller one."""

import pytest

from ehlectric.film.heated_film import goes_round, is_stale

FALLING = [100.0 * 0.9**turn for turn in range(40)]


@pytest.mark.parametrize(
    ("changes", "allowed", "expected"),
    [
        (FALLING, 1.0, False),
        (FALLING + [80.0] * 19, 1.0, False),  # the last smaller one is 20 turns ago
        (FALLING + [80.0] * 20, 1.0, True),
        (FALLING + [80.0] * 20, 10.0, False),  # near what is allowed
        ([300.0] * 20, 1.0, False),  # nothing to compare with yet
        ([300.0] * 21, 1.0, True),
        ([299.0] + [300.0] * 20, 1.0, True),
        ([300.0, 299.0] * 20, 1.0, True),
    ],
)
def test_changes_without_a_smaller_one(changes, allowed, expected):
    assert goes_round(changes, allowed) is expected


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        (FALLING, False),
        (FALLING + [80.0] * 6, True),
        (FALLING + [80.0] * 5, False),  # the last smaller one is 6 turns ago
        ([300.0] * 6, False),  # nothing to compare with yet
        ([300.0] * 7, True),
        ([300.0] * 7 + [299.0], False),
    ],
)
def test_turns_without_a_smaller_change_are_not_combined(changes, expected):
    assert is_stale(changes) is expected
