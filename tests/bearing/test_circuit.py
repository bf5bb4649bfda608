"""The circuit of a bearing by hand; its breakdown against a voltage that is raised until contacts break."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.bearing.bearing_discharges import voltage_ratio
from ehlectric.bearing.circuit import Circuit, leaking_admittance
from tests.helpers.each import each

capacitances = st.floats(1e-12, 1e-9)
strengths = st.floats(0.5, 500.0)
elements = st.tuples(capacitances, capacitances, strengths, strengths)


def circuit_of(*rows):
    return Circuit(*np.array(rows, dtype=float).T)


def raised(inner, outer, inner_breakdown, outer_breakdown):
    """Voltages at which the first contact of one element breaks, and at which the second is gone too.

    A ramp in steps of one part in a thousand, the voltages from the charges: both contacts carry the same
    while they hold, and one that has broken down has no voltage.
    """
    first = None
    broken = {"inner": False, "outer": False}
    voltage = 1e-3
    while not all(broken.values()):
        while True:
            charge = voltage / (1.0 / inner + 1.0 / outer)
            on = {"inner": charge / inner, "outer": charge / outer}
            for name, other in (("inner", "outer"), ("outer", "inner")):
                if broken[other]:
                    on[name] = voltage
            new = [
                name
                for name, holds in (("inner", inner_breakdown), ("outer", outer_breakdown))
                if not broken[name] and on[name] >= holds
            ]
            if not new:
                break
            # One breaks after the other, the one furthest beyond its strength before.
            holds = {"inner": inner_breakdown, "outer": outer_breakdown}
            broken[max(new, key=lambda name: on[name] / holds[name])] = True
            first = voltage if first is None else first
        voltage *= 1.001
    return first, voltage / 1.001


@pytest.mark.slow
@given(element=elements)
def test_breakdown_of_an_element_as_its_voltage_is_raised(element):
    first, through = raised(*element)
    found = circuit_of(element)
    # The ramp finds both within its step, from above.
    assert found.first_break <= first * (1.0 + 1e-9)
    assert found.first_break == pytest.approx(first, rel=1.1e-3, abs=0.0)
    assert found.ring_to_ring_breakdown <= through * (1.0 + 1e-9)
    assert found.ring_to_ring_breakdown == pytest.approx(through, rel=1.1e-3, abs=0.0)


@given(rows=st.lists(elements, min_size=1, max_size=12))
def test_a_bearing_is_its_elements(rows):
    """Capacitances of parallel elements add; the bearing breaks where its weakest element does."""
    found = circuit_of(*rows)
    alone = [circuit_of(row) for row in rows]
    assert found.capacitance == pytest.approx(sum(one.capacitance for one in alone), rel=1e-12, abs=0.0)
    assert found.first_break == min(one.first_break for one in alone)
    assert found.ring_to_ring_breakdown == min(one.ring_to_ring_breakdown for one in alone)
    assert found.ring_to_ring_breakdown >= found.first_break
    # 1/C = 1/C_i + 1/C_o, and both shares of a voltage are all of it.
    series = [1.0 / (1.0 / row[0] + 1.0 / row[1]) for row in rows]
    np.testing.assert_allclose(found.elements, series, rtol=1e-12)
    inner = found.inner_share * found.inner
    np.testing.assert_allclose(inner, (1.0 - found.inner_share) * found.outer, rtol=1e-6)


@given(rows=st.lists(elements, min_size=2, max_size=8), scale=st.floats(0.1, 10.0))
def test_scales(rows, scale):
    """Capacitances alone say nothing of the voltages but by their ratios; strengths scale them."""
    one = circuit_of(*rows)
    larger = Circuit(scale * one.inner, scale * one.outer, one.inner_breakdown, one.outer_breakdown)
    assert larger.capacitance == pytest.approx(scale * one.capacitance, rel=1e-12, abs=0.0)
    assert larger.first_break == pytest.approx(one.first_break, rel=1e-9, abs=0.0)
    stronger = Circuit(one.inner, one.outer, scale * one.inner_breakdown, scale * one.outer_breakdown)
    assert stronger.first_break == pytest.approx(scale * one.first_break, rel=1e-9, abs=0.0)
    assert stronger.ring_to_ring_breakdown == pytest.approx(
        scale * one.ring_to_ring_breakdown, rel=1e-9, abs=0.0
    )


def test_one_element_by_hand():
    """100 and 300 pF: 75 pF, three quarters of the voltage on the smaller one.

    It breaks at 9/0.75 = 12 V, the other one would at 8/0.25 = 32 V; alone it holds 8 V, less than there is.
    """
    found = circuit_of((100e-12, 300e-12, 9.0, 8.0))
    assert found.capacitance == pytest.approx(75e-12, rel=1e-12, abs=0.0)
    assert found.inner_share[0] == pytest.approx(0.75, rel=1e-12, abs=0.0)
    assert found.first_break == pytest.approx(12.0, rel=1e-12, abs=0.0)
    assert found.ring_to_ring_breakdown == pytest.approx(12.0, rel=1e-12, abs=0.0)
    # The stronger one is the first, for what it has to carry.
    assert found.inner_first[0]
    # With 20 V the other one holds on until the bearing has 20 V.
    assert circuit_of((100e-12, 300e-12, 9.0, 20.0)).ring_to_ring_breakdown == pytest.approx(20.0, rel=1e-12)
    # Rings exchanged.
    turned = circuit_of((300e-12, 100e-12, 20.0, 9.0))
    assert not turned.inner_first[0]
    assert not circuit_of((300e-12, 100e-12, 8.0, 9.0)).inner_first[0]
    assert turned.first_break == pytest.approx(12.0, rel=1e-12, abs=0.0)
    assert turned.ring_to_ring_breakdown == pytest.approx(20.0, rel=1e-12, abs=0.0)


@each("number", [1, 3, 9, 100])
def test_all_equal(number):
    """n elements of two equal contacts: n C/2, twice the strength of one, and both break at once."""
    found = circuit_of(*[(50e-12, 50e-12, 4.0, 4.0)] * number)
    assert found.capacitance == pytest.approx(number * 25e-12, rel=1e-12, abs=0.0)
    np.testing.assert_allclose(found.inner_share, 0.5)
    assert found.first_break == found.ring_to_ring_breakdown == pytest.approx(8.0, rel=1e-12, abs=0.0)
    # Rounding does not decide which contact of two equal ones is named.
    for rounding in (1.0 - 1e-12, 1.0, 1.0 + 1e-12):
        assert circuit_of(*[(50e-12, 50e-12, 4.0 * rounding, 4.0)] * number).inner_first.all()


def test_contacts_without_a_strength_never_break():
    nothing = circuit_of((1e-10, 2e-10, np.inf, np.inf))
    assert nothing.first_break == nothing.ring_to_ring_breakdown == np.inf
    # One that breaks, beside one that does not: 3/(2/3) = 4.5 V, and never through.
    one = circuit_of((1e-10, 2e-10, 3.0, np.inf))
    assert one.first_break == pytest.approx(4.5, rel=1e-12, abs=0.0)
    assert one.ring_to_ring_breakdown == np.inf


@given(
    wr=capacitances,
    rf=capacitances,
    first=capacitances,
    second=capacitances,
)
def test_voltage_ratio_is_the_charge_of_the_divider(wr, rf, first, second):
    """Winding at 1 V, frame at 0: the rotor's voltage at which all its charges add to nothing."""
    rotor = voltage_ratio(wr, rf, first, second)
    charges = wr * (rotor - 1.0) + (rf + first + second) * rotor
    assert abs(charges) < 1e-12 * (wr + rf + first + second)
    assert 0.0 < rotor < 1.0


def test_voltage_ratio_by_hand():
    """20/(20 + 1000 + 70 + 110) = 1/60."""
    found = voltage_ratio(20e-12, 1e-9, 70e-12, 110e-12)
    assert found == pytest.approx(1.0 / 60.0, rel=1e-12, abs=0.0)


@given(rows=st.lists(elements, min_size=1, max_size=12), shape=st.floats(0.5, 200.0))
def test_the_first_break_of_a_weibull_strength_is_at_63_2_per_cent(rows, shape):
    """The probability that all contacts hold, one by one, at that bearing voltage: 1/e."""
    whole = circuit_of(*rows)
    found = Circuit(whole.inner, whole.outer, whole.inner_breakdown, whole.outer_breakdown, shape)
    hold = 1.0
    for inner, outer, inner_breakdown, outer_breakdown in rows:
        on_inner = found.first_break * outer / (inner + outer)
        hold *= np.exp(-((on_inner / inner_breakdown) ** shape))
        hold *= np.exp(-(((found.first_break - on_inner) / outer_breakdown) ** shape))
    assert hold == pytest.approx(np.exp(-1.0), rel=1e-6, abs=0.0)
    # Each of 2 n contacts alone breaks at no less than the first of a certain strength.
    assert found.first_break <= whole.first_break * (1.0 + 1e-12)
    assert found.first_break >= whole.first_break * (2 * len(rows)) ** (-1.0 / shape) * (1.0 - 1e-12)
    assert found.ring_to_ring_breakdown == whole.ring_to_ring_breakdown


@pytest.mark.parametrize("shape", [1.0, 3.0, 10.0])
def test_equal_contacts_break_sooner_by_the_root_of_their_number(shape):
    """N equal contacts, half of the voltage each: 2 V N^(-1/m)."""
    rows = [(1e-10, 1e-10, 5.0, 5.0)] * 9
    arrays = np.array(rows).T
    assert Circuit(*arrays, shape=shape).first_break == pytest.approx(
        10.0 * 18.0 ** (-1.0 / shape), rel=1e-12, abs=0.0
    )


def test_a_strength_that_does_not_scatter_has_no_weaker_links():
    arrays = np.array([(1e-10, 1e-10, 5.0, 6.0), (1e-10, 2e-10, 9.0, 8.0)]).T
    assert Circuit(*arrays, shape=200.0).first_break == pytest.approx(10.0, rel=1e-12, abs=0.0)
    # Contacts without a strength, as unloaded ones of a Weibull law, do not count.
    endless = np.array([(1e-10, 1e-10, 5.0, np.inf), (1e-10, 1e-10, np.inf, np.inf)]).T
    assert Circuit(*endless, shape=2.0).first_break == 10.0
    assert Circuit(*np.array([(1e-10, 1e-10, np.inf, np.inf)]).T, shape=2.0).first_break == np.inf


LEAKING = np.array([[100e-12, 80e-12, 300e-12, 120e-12], [20e-12, 5e-12, 15e-12, 12e-12]])


def leaking(tau, frequency):
    inner, inner_oil, outer, outer_oil = LEAKING.T
    return leaking_admittance((inner, inner_oil), (outer, outer_oil), tau, np.array(frequency))


@pytest.mark.parametrize("tau", [1e-3, 20.0])
def test_leaking_contacts_by_kirchhoff(tau):
    """Rings at 1 V and 0, each element afloat between them: the currents of both contacts are one.

    A contact carries sigma times the oil's C/eps beside i omega of all of its C; sigma/eps is 1/tau.
    """
    for frequency in (0.01, 1.0 / tau, 1e5):
        total = 0.0
        for inner, inner_oil, outer, outer_oil in LEAKING:
            first = inner_oil / tau + 2j * np.pi * frequency * inner
            second = outer_oil / tau + 2j * np.pi * frequency * outer
            # Current and voltage of the element: first (1 - v) = i, second v = i.
            current, _ = np.linalg.solve(np.array([[1.0, first], [1.0, -second]]), np.array([first, 0.0]))
            total += current
        assert leaking(tau, [frequency])[0] == pytest.approx(total, rel=1e-9, abs=0.0)


def test_leaking_contacts_at_both_ends():
    """At rest the oil's resistances tau/C_oil alone, in series; at high frequency all capacitances.

    80 and 120 pF make 48, 5 and 12 make 60/17; 100 and 300 make 75, 20 and 15 make 60/7.
    """
    slow, fast = leaking(20.0, [0.0, 1e7])
    assert slow == pytest.approx((48e-12 + 60e-12 / 17.0) / 20.0, rel=1e-12, abs=0.0)
    assert fast == pytest.approx(2j * np.pi * 1e7 * (75e-12 + 60e-12 / 7.0), rel=1e-6, abs=0.0)
