"""Mean of film factors, parallel circuit of an impedance: against numbers by hand and simulated rows."""

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.cases.film_factors import mean_factor, slope_of
from ehlectric.cases.measurements import capacitance_of, parallel_circuit, read_measurement
from ehlectric.errors import InputError
from tests.helpers.each import each


@given(st.floats(1e-13, 1e-8), st.floats(1e2, 1e9), st.floats(1e2, 1e7))
def test_magnitude_and_phase_of_a_parallel_circuit_give_it_back(c, r, f):
    z = 1.0 / (1.0 / r + 2j * math.pi * f * c)
    if not -90.0 < math.degrees(np.angle(z)) < -0.01:
        return
    found_c, found_r = parallel_circuit(np.array([abs(z)]), np.array([np.angle(z)]), np.array([f]))
    assert found_c[0] == pytest.approx(c, rel=1e-6)
    # Close to -90 deg the resistance hangs on the last digits of the phase.
    assert found_r[0] == pytest.approx(r, rel=1e-6 + 1e-12 * r * 2 * math.pi * f * c)


def test_uncertainty_of_an_impedance_is_that_of_its_capacitance():
    """Against differences of C(|Z|, phase, f)."""
    at, errors = (2e4, math.radians(-75.0), 2e4), (200.0, math.radians(0.5), 100.0)
    frame = pd.DataFrame(
        {
            "impedance [ohm]": [at[0]],
            "phase [rad]": [at[1]],
            "frequency [Hz]": [at[2]],
            "impedance uncertainty [ohm]": [errors[0]],
            "phase uncertainty [rad]": [errors[1]],
            "frequency uncertainty [Hz]": [errors[2]],
        }
    )
    found = capacitance_of(read_measurement(frame))

    def value(*point):
        return parallel_circuit(*(np.array([one]) for one in point))[0][0]

    parts = []
    for k, error in enumerate(errors):
        ends = [value(*(x + sign * error * (k == j) for j, x in enumerate(at))) for sign in (0.5, -0.5)]
        parts.append(ends[0] - ends[1])
    assert found.value[0] == pytest.approx(value(*at))
    assert found.uncertainty[0] == pytest.approx(math.hypot(*parts), rel=1e-3)


CS, RS, OMEGA = np.array([5.0e-10, 4.4e-10]), np.array([300.0, 280.0]), 2e5 * math.pi


@each(
    "columns",
    [
        {"Cs [F]": CS, "Rs [ohm]": RS},
        {"Cs [pF]": 1e12 * CS, "dissipation [-]": OMEGA * RS * CS},
        {"Cs [F]": CS, "D [-]": OMEGA * RS * CS},
        {"Rs [ohm]": RS, "Xs [ohm]": -1.0 / (OMEGA * CS)},
        {"R [ohm]": RS, "X [ohm]": -1.0 / (OMEGA * CS)},
        {"Cs_F": CS, "ESR_ohm": RS},
    ],
)
def test_values_in_series_become_a_parallel_capacitance(columns):
    """The closed form Cp = Cs/(1 + (omega Rs Cs)^2): 495.6 pF and 437.4 pF."""
    frame = pd.DataFrame({**columns, "Frequency [Hz]": 1e5})
    found = capacitance_of(read_measurement(frame))
    assert found.value == pytest.approx(CS / (1.0 + (OMEGA * RS * CS) ** 2), rel=1e-12)
    assert 1e12 * found.value == pytest.approx([495.6, 437.4], abs=0.05)
    assert found.resistance == pytest.approx(RS * (1.0 + 1.0 / (OMEGA * RS * CS) ** 2), rel=1e-9)


def test_uncertainty_of_a_capacitance_in_series():
    """The derivative of the closed form: dCp/dCs = (1 - q)/(1 + q)^2 with q = (omega Rs Cs)^2."""
    frame = pd.DataFrame({"Cs [F]": CS, "Rs [ohm]": RS, "f [Hz]": 1e5, "frequency [Hz]": 1e5})
    frame["uncertainty [%]"] = 2.0
    q = (OMEGA * RS * CS) ** 2
    found = capacitance_of(read_measurement(frame))
    assert found.uncertainty == pytest.approx(0.02 * CS * (1.0 - q) / (1.0 + q) ** 2, rel=1e-6)


def test_a_measurement_needs_all_of_an_impedance():
    with pytest.raises(InputError, match=r"series_resistance: missing.* contains 'Cs \[F\]', 'frequency"):
        capacitance_of(read_measurement(pd.DataFrame({"Cs [F]": CS, "frequency [Hz]": 1e5})))
    frame = pd.DataFrame({"impedance [ohm]": [1.0], "phase [deg]": [-80.0]})
    with pytest.raises(InputError, match="frequency: missing"):
        capacitance_of(read_measurement(frame))
    with pytest.raises(InputError, match=r"capacitance: missing.* contains 'film \[nm\]'"):
        capacitance_of(read_measurement(pd.DataFrame({"film [nm]": [1.0]})))
    both = frame.assign(**{"capacitance [pF]": 1.0, "frequency [Hz]": 1.0})
    with pytest.raises(InputError, match="a capacitance and an impedance"):
        capacitance_of(read_measurement(both))


def test_an_inductive_phase_has_no_capacitance():
    frame = pd.DataFrame({"impedance [ohm]": [1.0, 1.0], "phase [deg]": [-80.0, 10.0], "frequency [Hz]": 1e3})
    found = capacitance_of(read_measurement(frame), 0.1)
    assert np.isfinite(found.value).tolist() == [True, False]


def test_weights_are_reciprocal_variances():
    """By hand: weights 4 to 1 for uncertainties of 1 and 2 per cent."""
    mean = mean_factor(np.array([0.7, 0.72]), np.array([0.02, 0.04]))
    assert mean.value == pytest.approx(0.7**0.8 * 0.72**0.2)
    assert mean.statistical == pytest.approx(0.02 * math.sqrt(0.8))
    assert mean.low == pytest.approx(mean.value * math.exp(-1.959964 * mean.statistical), rel=1e-6)
    assert mean.basis == "stated uncertainty"


def test_scatter_above_the_stated_uncertainty_raises_it():
    factors = np.array([0.5, 0.7, 0.9])
    mean = mean_factor(factors, np.full(3, 0.01))
    assert mean.basis == "stated uncertainty, raised to the scatter"
    assert mean.statistical == pytest.approx(np.std(np.log(factors), ddof=1) / math.sqrt(3))


def test_without_uncertainty_the_interval_is_of_student():
    """t of 2 degrees of freedom is 4.303 at 95 %."""
    factors = np.array([0.68, 0.7, 0.72])
    mean = mean_factor(factors)
    error = np.std(np.log(factors), ddof=1) / math.sqrt(3)
    assert mean.high / mean.value == pytest.approx(math.exp(4.302653 * error))
    assert mean.basis == "scatter only"
    single = mean_factor(factors[:1])
    assert (single.low, single.high, single.scatter) == (None, None, None)


def test_what_rows_share_is_not_averaged_away():
    shared = {"bearing.temperature": np.full(100, 0.05), "bearing.radial_load": np.full(100, -0.12)}
    mean = mean_factor(np.full(100, 0.7), np.full(100, 0.01), shared)
    assert mean.systematic == pytest.approx(0.13)
    assert mean.statistical == pytest.approx(0.001)


def test_intervals_hold_the_true_factor_as_often_as_they_say():
    """Of 400 simulated measurements, 95 % with three standard deviations of a binomial, 0.011."""
    rng = np.random.default_rng(5)
    inside = 0
    for _ in range(400):
        stated = rng.uniform(0.02, 0.06, 12)
        factors = 0.7 * np.exp(stated * rng.standard_normal(12))
        mean = mean_factor(factors)
        inside += mean.low < 0.7 < mean.high
    assert abs(inside / 400 - 0.95) < 0.035


def test_slope_needs_three_speeds():
    u = np.array([1.0, 2.0, 2.0])
    assert slope_of(u, u) is None
