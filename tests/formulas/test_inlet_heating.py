"""Formulas of the heat in the inlet: by hand, and beside solved thermal films."""

import csv

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.formulas.inlet_supply import inlet_shear_factor
from tests.formulas.inlet_heating import gupta, murch_wilson, wilson_sheu
from tests.helpers.places import ROOT

# Hertz pressure over reduced modulus of the table.
RATIO = 1.0 / 226.0


@pytest.fixture(scope="module")
def solved():
    """Columns of the table of solved films."""
    lines = (ROOT / "tests" / "data" / "inlet_heating.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def test_inlet_shear_by_hand():
    """L = 0.0125 * 0.03 * 10^2/0.15 = 0.25: 1/(1 + 0.241 * 0.25^0.64) with 0.25^0.64 = 2^-1.28 = 0.41180."""
    assert inlet_shear_factor(0.0125, 0.03, 10.0, 0.15) == pytest.approx(
        1.0 / (1.0 + 0.241 * 0.41180), rel=1e-5, abs=0.0
    )
    # At L = 1 the power is of no account.
    assert inlet_shear_factor(0.15, 1.0, 1.0, 0.15) == pytest.approx(1.0 / 1.241, rel=1e-12, abs=0.0)


def test_inlet_shear_vanishes_at_low_speed_and_grows_with_it():
    factors = [inlet_shear_factor(0.02, 0.03, speed, 0.14) for speed in (1e-9, 1.0, 5.0, 20.0, 100.0)]
    assert factors[0] == pytest.approx(1.0, rel=0.0, abs=1e-9)
    assert np.all(np.diff(factors) < 0.0)
    assert factors[-1] > 0.0


def test_inlet_heating_formulas_give_the_printed_values(solved):
    """The columns are printed with three digits, and so is their L."""
    assert wilson_sheu(solved["loading"]) == pytest.approx(solved["wilson_sheu"], rel=0.0, abs=1e-3)
    assert gupta(solved["loading"], RATIO) == pytest.approx(solved["gupta"], rel=0.0, abs=1e-3)


def test_inlet_heating_by_wilson_and_sheu_is_nearest_to_solved_films(solved):
    """In pure rolling; all three are too low, that of bearings by 2.2 % at most."""
    loading, phi = solved["loading"], solved["phi_c"]
    errors = {
        name: values / phi - 1.0
        for name, values in (
            ("wilson_sheu", wilson_sheu(loading)),
            ("murch_wilson", murch_wilson(loading)),
            ("gupta", gupta(loading, RATIO)),
        )
    }
    worst = {name: np.max(np.abs(error)) for name, error in errors.items()}
    assert worst["wilson_sheu"] < 0.022
    assert worst["wilson_sheu"] < worst["murch_wilson"] < worst["gupta"] < 0.075
    assert all(np.all(error < 0.0) for error in errors.values())


def test_sliding_of_wilson_and_sheu_is_far_from_solved_films():
    """At L = 0.185 and a slide-to-roll ratio of 0.25 solved films keep 0.961 of h_c and 0.893 of h_min."""
    # By hand: Z = 0.125, 1 + 14.8 * 0.125^0.83 = 3.634 and 0.185^0.64 = 0.3396.
    assert wilson_sheu(0.185, 0.25) == pytest.approx(1.0 / (1.0 + 0.241 * 3.634 * 0.3396), rel=1e-3)
    assert wilson_sheu(0.185, 0.25) < 0.78
    assert 0.85 < gupta(0.185, RATIO, 0.25) < 0.893


def test_murch_and_wilson_as_wilson_and_sheu_print_it():
    loading = np.geomspace(1e-3, 1e2, 20)
    np.testing.assert_allclose(murch_wilson(loading), 1.0 / (1.0 + 0.254 * loading**0.62), rtol=1e-3)


@given(loading=st.floats(1e-6, 1e2), more=st.floats(1.01, 10.0))
def test_heat_makes_films_thinner(loading, more):
    thinner, thin = (inlet_shear_factor(value, 1.0, 1.0, 1.0) for value in (more * loading, loading))
    assert 0.0 < thinner < thin <= 1.0
    assert thin == pytest.approx(wilson_sheu(loading), rel=1e-12)
