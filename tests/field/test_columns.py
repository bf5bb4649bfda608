"""Columns of the field among the nodes of the film."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import Case, solve
from ehlectric.field.mesh import ENOUGH, thinned


@given(st.integers(3, 4001), st.floats(-1.0, 1.0))
def test_thinned_columns_are_some_of_all(number, place):
    """With both ends and the column nearest to the place; a few more than enough at the most."""
    columns = np.linspace(-1.0, 1.0, number)
    found = thinned(columns, [place])
    assert np.all(np.isin(found, columns))
    assert np.all(np.diff(found) > 0.0)
    assert np.min(np.abs(found - place)) <= 1.0 / (number - 1) + 1e-12
    assert (found[0], found[-1]) == (-1.0, 1.0)
    assert min(number, ENOUGH) <= found.size < 2 * ENOUGH + 4


@given(st.integers(1, 2000), st.floats(0.0, 1.0))
def test_symmetric_columns_stay_symmetric(half, place):
    columns = np.linspace(-1.0, 1.0, 2 * half + 1)
    columns = 0.5 * (columns - columns[::-1])
    found = thinned(columns, [-place, place])
    np.testing.assert_array_equal(found, -found[::-1])
    assert 0.0 in found


@pytest.mark.slow
def test_field_on_fewer_columns_is_that_on_all(monkeypatch):
    """Of a thin film, whose constriction needs a fine patch."""
    contact = {
        "geometry": "point",
        "radius_x": 0.01,
        "radius_y": 0.01,
        "reduced_modulus": 226e9,
        "load": 160.0,
        "entrainment_speed": 0.8,
    }
    case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"error": "1 %"}})
    few = solve(case).field
    monkeypatch.setattr("ehlectric.field.mesh.ENOUGH", 10_000)
    every = solve(case).field
    assert few.x.size * few.y.size < 0.3 * every.x.size * every.y.size
    assert few.capacitance == pytest.approx(every.capacitance, rel=1e-3)
    assert few.max_strength == pytest.approx(every.max_strength, rel=1e-5)
    assert few.max_strength_position == every.max_strength_position
