"""Equality and representation of results with arrays."""

from dataclasses import dataclass, field

import numpy as np
import pytest
import xarray as xr

from ehlectric.runtime.display import WIDTH, Values, same
from tests.helpers.each import each


@dataclass(frozen=True, eq=False, repr=False)
class Film(Values):
    thickness: np.ndarray
    parts: tuple = ()
    seconds: float = field(default=0.0, compare=False)


@dataclass(frozen=True, eq=False, repr=False)
class Other(Values):
    thickness: np.ndarray


ONES = np.ones(3)


def test_arrays_are_equal_to_the_last_bit():
    assert Film(ONES) == Film(ONES.copy())
    assert Film(ONES) != Film(np.nextafter(ONES, 2.0))
    assert Film(ONES) != Film(ONES.astype(np.float32))
    assert Film(ONES) != Film(np.ones((1, 3)))
    assert Film(np.array([np.nan])) == Film(np.array([np.nan]))


def test_fields_that_do_not_count():
    """Two solutions of one case took different times."""
    assert Film(ONES, seconds=1.0) == Film(ONES, seconds=2.0)


def test_other_classes_are_not_equal():
    assert Film(ONES) != Other(ONES)
    assert Film(ONES) != 1


@each(
    "one, other",
    [
        ([ONES], [ONES, ONES]),
        ({"a": ONES}, {"b": ONES}),
        ({"a": ONES}, {"a": 2 * ONES}),
        ((1, "a"), (1, "b")),
        (float("nan"), 0.0),
        (xr.Dataset({"a": ("x", ONES)}), xr.Dataset({"a": ("x", 2 * ONES)})),
        (None, ONES),
    ],
)
def test_values_within_values(one, other):
    assert same(one, one)
    assert not same(one, other)
    assert Film(ONES, (one,)) != Film(ONES, (other,))


def test_results_cannot_be_hashed():
    """A hash of the address would make equal results different keys."""
    with pytest.raises(TypeError, match="unhashable"):
        hash(Film(ONES))


def test_representation_is_short():
    assert repr(Film(ONES, ("a",))) == "Film(thickness=float64 (3,), parts=<tuple>, seconds=0.0)"
    assert len(repr(Other("a b " * 200))) <= WIDTH
