"""Circuit between shaft and housing: capacitors in series and parallel by hand, limits, and general laws."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.bearing.circuit import Circuit, Path, shaft_first_break, shaft_ring_to_ring_breakdown

CAPACITANCES = st.floats(1e-13, 1e-6)


def circuit_of(*columns):
    return Circuit(*(np.array(values, dtype=float) for values in columns))


def test_films_behind_a_coating_beside_a_cage():
    """300 pF behind 600 pF: 200 pF, two thirds of the voltage; 50 pF beside both."""
    path = Path(coating=600e-12, parallel=50e-12)
    assert path.film_share(300e-12) == pytest.approx(2.0 / 3.0, rel=1e-12)
    assert path.total(300e-12) == pytest.approx(250e-12, rel=1e-12)
    # 1.2 nF of a motor behind the same coating: 400 pF.
    assert path.behind_coating(1.2e-9) == pytest.approx(400e-12, rel=1e-12)


def test_without_coating_nothing_changes():
    circuit = circuit_of([1e-10, 3e-10], [2e-10, 1e-10], [5.0, 9.0], [8.0, 3.0])
    assert Path().film_share(circuit.capacitance) == 1.0
    assert Path().total(circuit.capacitance) == circuit.capacitance
    assert shaft_first_break(circuit, Path()) == circuit.first_break
    assert shaft_ring_to_ring_breakdown(circuit, Path()) == circuit.ring_to_ring_breakdown


def test_two_elements_behind_a_coating():
    """Elements of 100 pF and 50 pF, coating 150 pF: half of the shaft voltage, until one contact is shorted.

    The first element breaks at its inner contact, at 2 x 4 V on the films. Its outer contact, 200 pF, then
    stands beside the 50 pF: the films have 150/(150 + 250) = 3/8 of the shaft voltage, and 12 V need 32 V.
    """
    circuit = circuit_of([2e-10, 1e-10], [2e-10, 1e-10], [4.0, 90.0], [12.0, 90.0])
    path = Path(coating=150e-12)
    assert circuit.first_break == pytest.approx(8.0, rel=1e-12)
    assert shaft_first_break(circuit, path) == pytest.approx(16.0, rel=1e-12)
    assert shaft_ring_to_ring_breakdown(circuit, path) == pytest.approx(32.0, rel=1e-12)


@given(films=CAPACITANCES, coating=CAPACITANCES, parallel=CAPACITANCES)
def test_a_coating_never_raises_what_is_across_the_films(films, coating, parallel):
    path = Path(coating=coating, parallel=parallel)
    assert 0.0 <= path.film_share(films) <= 1.0
    assert path.total(films) <= (films + parallel) * (1.0 + 1e-9)
    assert path.total(films) <= (coating + parallel) * (1.0 + 1e-9)
    assert Path(coating=2.0 * coating).film_share(films) >= path.film_share(films)


@given(
    capacitances=st.lists(st.tuples(CAPACITANCES, CAPACITANCES), min_size=1, max_size=5),
    breakdown=st.floats(0.1, 1e3),
    coating=CAPACITANCES,
    parallel=CAPACITANCES,
)
def test_a_cage_never_changes_a_breakdown_and_a_coating_never_lowers_it(
    capacitances, breakdown, coating, parallel
):
    inner, outer = zip(*capacitances, strict=True)
    circuit = circuit_of(inner, outer, [breakdown] * len(inner), [2.0 * breakdown] * len(inner))
    coated, beside = Path(coating=coating), Path(coating=coating, parallel=parallel)
    for of_shaft, of_films in (
        (shaft_first_break, circuit.first_break),
        (shaft_ring_to_ring_breakdown, circuit.ring_to_ring_breakdown),
    ):
        assert of_shaft(circuit, beside) == of_shaft(circuit, coated)
        assert of_shaft(circuit, coated) >= of_films * (1.0 - 1e-12)
    first, through = (law(circuit, coated) for law in (shaft_first_break, shaft_ring_to_ring_breakdown))
    assert through >= first * (1.0 - 1e-12)


def test_impedance_of_a_coating_at_both_ends_of_the_frequency():
    """At zero frequency 1 GOhm of oil and 50 MOhm of coating in series; high up all capacitors."""
    path = Path(coating=1e-9, parallel=20e-12, resistance=50e6)
    frequency = np.array([0.0, 1e9])
    films = 1e-9 + 2j * math.pi * frequency * 250e-12
    y = path.admittance(films, frequency)
    assert 1.0 / y[0].real == pytest.approx(1.05e9, rel=1e-12)
    assert y[1].imag / (2.0 * math.pi * 1e9) == pytest.approx(220e-12, rel=1e-6)
