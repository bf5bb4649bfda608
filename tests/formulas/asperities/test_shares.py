"""Fits of the load share against their printed tables."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.formulas.asperities import (
    LOAD_SHARE,
    contact_probability,
    johnson_end,
    johnson_fit,
    load_shares,
)
from tests.helpers.each import each

LAMBDA = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0]
PRINTED = {
    "patir_cheng": [0.711, 0.457, 0.165, 0.054, 0.016, 0.0012],
    "clarke": [0.724, 0.480, 0.157, 0.034, 0.005, 2e-5],
    "zhou_hoeprich": [0.546, 0.306, 0.098, 0.032, 0.011, 0.0012],
    "johnson": [0.532, 0.327, 0.117, 0.030, 0.0003, 0.0],
}


@each("law", LOAD_SHARE)
def test_printed_table(law):
    found = LOAD_SHARE[law].share(LAMBDA)
    # The last printed digit is 0.001, and 0.0001 where the share is smaller.
    for value, printed in zip(found, PRINTED[law], strict=True):
        assert value == pytest.approx(printed, abs=0.0006 if printed > 0.004 else 0.00006)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("law", LOAD_SHARE)
@given(films=st.lists(st.floats(0.0, 50.0), min_size=2, max_size=8))
def test_share_falls_from_one(law, films):
    shares = LOAD_SHARE[law].share(np.sort(films))
    assert np.all((shares >= 0.0) & (shares <= 1.0))
    assert np.all(np.diff(shares) <= 0.0)
    assert LOAD_SHARE[law].share(0.0) == 1.0
    assert LOAD_SHARE[law].source


@each("law", LOAD_SHARE)
@each("film", [-1e-3, np.nan, [1.0, -1.0]])
def test_no_share_of_a_negative_lambda(law, film):
    with pytest.raises(ValueError, match="lambda"):
        LOAD_SHARE[law].share(film)


def test_laws_agree_below_one_and_a_half():
    shares = np.array(list(load_shares([0.25, 0.5, 1.0, 1.5]).values()))
    assert np.all(shares.max(axis=0) / shares.min(axis=0) < 1.9)


def test_johnson_fit_ends_at_its_zero():
    assert 1.9 < johnson_end() < 2.1
    assert 0.0 < float(johnson_fit(johnson_end() - 1e-6)) < 1e-5
    # The expression itself is positive again at lambda = 5, where a film is not touched.
    assert 1.0 - 1.21 * 5.0**0.64 / (1.0 + 0.37 * 5.0**1.26) > 0.05
    assert float(johnson_fit(5.0)) == 0.0


def test_contact_begins_below_two():
    assert float(contact_probability(2.0)) < 0.01
    assert float(contact_probability(0.5)) > 0.4
