"""Discharges over time: closed forms, balances, and what they must not depend on."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from ehlectric.drive.discharges.films_and_source import Segments
from ehlectric.drive.drive_record import CHARGE, ENERGY, FILM, OFF, ON, PEAK, VOLTAGE
from ehlectric.errors import InputError
from tests.helpers.drives import arc, drive_system, element, march, motor, square


def level(voltage, duration, count=1):
    """Constant source in equal segments."""
    whole = np.full(count, duration / count)
    return Segments(whole, np.full(count, voltage), np.zeros(count), np.zeros(count, dtype=complex))


def ramp(start, slope, duration, count=1):
    whole = np.full(count, duration / count)
    levels = start + slope * np.arange(count) * duration / count
    return Segments(whole, levels, np.full(count, slope), np.zeros(count, dtype=complex))


def total(circuit, bearings):
    """Capacitance of the rotor to everything, and the part of it to the winding [F]."""
    beside = circuit.winding_rotor_capacitance + circuit.rotor_frame_capacitance
    return beside + sum(float(one.capacitance[0]) for one in bearings), circuit.winding_rotor_capacitance


def test_voltage_of_the_divider():
    """C_wr/(C_wr + C_rf + C_DE + C_NDE) of the source, reached in the edge."""
    circuit, bearings = motor(), [element(), element(200e-12)]
    record = march(circuit, bearings, arc(), square(280.0, 1e-4, 1e-7, 3), highest=40.0)
    whole, winding = total(circuit, bearings)
    assert record.peak == pytest.approx(np.full(2, 280.0 * winding / whole), rel=1e-12)
    assert np.sum(record.histogram, axis=1) == pytest.approx(np.full(2, 3e-4), rel=1e-12)
    assert len(record.events) == 0


def test_a_step_into_a_leaking_film():
    """After a jump of the source the voltage falls as exp(-t G/C): rms by its integral."""
    circuit, conductance = motor(), 1e-6
    bearings = [element(conductance=conductance), element(200e-12)]
    whole, winding = total(circuit, bearings)
    jump = Segments(np.array([1e-6, 5e-3]), np.array([0.0, 100.0]), np.zeros(2), np.zeros(2, dtype=complex))
    record = march(circuit, bearings, arc(), jump, highest=20.0, limits=(1.0, 2.0))
    high, rate = 100.0 * winding / whole, conductance / whole
    assert record.peak[0] == pytest.approx(high, rel=1e-12)
    square_integral = high**2 * (1.0 - math.exp(-2.0 * rate * 5e-3)) / (2.0 * rate)
    assert record.rms[0] ** 2 * record.duration == pytest.approx(square_integral, rel=5e-3)
    for limit, time in zip((1.0, 2.0), record.above[0], strict=True):
        assert time == pytest.approx(min(math.log(high / limit) / rate, 5e-3), rel=5e-3)


def test_a_linear_ramp_breaks_down_at_its_time():
    """Without leak the film voltage follows the source; the time of the threshold is exact."""
    circuit, bearings = motor(), [element(breakdown=5.0), element(200e-12)]
    whole, winding = total(circuit, bearings)
    slope = 1e6
    record = march(circuit, bearings, arc(), ramp(0.0, slope, 1e-3, 7))
    assert record.events[0, ON] == pytest.approx(5.0 * whole / (winding * slope), rel=1e-12)
    assert record.events[0, VOLTAGE] == pytest.approx(5.0, rel=1e-12)


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=40)
@given(
    threshold=st.floats(1.0, 9.0),
    extinction=st.floats(0.01, 0.9),
    resistance=st.floats(0.1, 1e3),
    capacitance=st.floats(1e-12, 1e-8),
)
def test_charge_and_energy_of_an_arc_balance(threshold, extinction, resistance, capacitance):
    """At a constant source the arc takes the charge C (V - v) and the energy C (V^2 - v^2)/2, to 1e-9.

    C is that of the rotor to all else: the source keeps the winding at its potential, and what it gives is
    the same in both balances.
    """
    circuit, bearings = motor(), [element(capacitance, breakdown=threshold), element(1e-10)]
    whole, winding = total(circuit, bearings)
    # The source jumps to just above what the threshold needs, and stays.
    high = 1.0001 * threshold * whole / winding
    breakdown = arc(extinction_voltage=extinction * threshold, arc_resistance=resistance)
    jump = Segments(np.array([1e-6, 1e-3]), np.array([0.0, high]), np.zeros(2), np.zeros(2, dtype=complex))
    record = march(circuit, bearings, breakdown, jump)
    (event,) = record.events
    start, end = event[VOLTAGE], extinction * threshold
    assert start == pytest.approx(1.0001 * threshold, rel=1e-12)
    assert event[CHARGE] == pytest.approx(whole * (start - end), rel=1e-9)
    assert event[ENERGY] == pytest.approx(0.5 * whole * (start**2 - end**2), rel=1e-9)
    assert event[PEAK] == pytest.approx(start / resistance, rel=1e-12)
    assert event[OFF] - event[ON] == pytest.approx(resistance * whole * math.log(start / end), rel=1e-9)


@settings(max_examples=40)
@given(
    threshold=st.floats(1.0, 9.0),
    extinction=st.floats(0.01, 0.9),
    resistance=st.floats(0.1, 1e3),
    duration=st.floats(0.1, 100.0),
    limit=st.floats(0.05, 0.95),
)
def test_voltages_are_measured_while_an_arc_burns(threshold, extinction, resistance, duration, limit):
    """At a constant source the voltage falls as V exp(-t/(R C)) to that of extinction v, where it stays.

    Its square adds up to (V^2 - v^2) R C/2 and v^2 for the rest; it is above u for R C ln(V/u).
    """
    circuit, bearings = motor(), [element(breakdown=threshold), element(1e-10)]
    whole, winding = total(circuit, bearings)
    high = 1.0001 * threshold * whole / winding
    breakdown = arc(extinction_voltage=extinction * threshold, arc_resistance=resistance)
    tau, start, end = resistance * whole, 1.0001 * threshold, extinction * threshold
    burns = tau * math.log(start / end)
    jump = Segments(
        np.array([1e-9, (1.0 + duration) * burns]),
        np.array([0.0, high]),
        np.zeros(2),
        np.zeros(2, dtype=complex),
    )
    level = end + limit * (start - end)
    record = march(circuit, bearings, breakdown, jump, limits=(level,))
    square = 0.5 * tau * (start**2 - end**2) + end**2 * duration * burns
    assert record.rms[0] ** 2 * record.duration == pytest.approx(square, rel=5e-4)
    assert record.above[0, 0] == pytest.approx(tau * math.log(start / level), rel=1e-3, abs=1e-3 * tau)


@pytest.mark.slow
@pytest.mark.gate
def test_charge_and_energy_with_leak_and_inductance_balance():
    """Over the first event: what the arc takes is what the states say, by an independent integration."""
    from scipy.integrate import solve_ivp

    circuit = motor(common_mode_inductance="1 uH", common_mode_resistance="3 ohm")
    bearings = [element(breakdown=4.0, conductance=1e-5), element(conductance=1e-5)]
    breakdown = arc(extinction_voltage=0.1, recovery_time=2e-8)
    record = march(circuit, bearings, breakdown, ramp(0.0, 1e8, 2e-6, 5))
    event = record.events[0]
    before, burning = (drive_system(circuit, bearings, (arc, 0.0)) for arc in (0.0, 0.1))
    rotor = before.potential("shaft rotor")

    def rates(system):
        return lambda t, x: system.rates @ x + system.force * 1e8 * t

    def film(system, t, x):
        return rotor @ (x - system.jump * 1e8 * t)

    first = solve_ivp(
        rates(before), (0.0, event[ON]), np.zeros(before.force.size), method="Radau", rtol=1e-10, atol=1e-13
    )
    assert film(before, event[ON], first.y[:, -1]) == pytest.approx(4.0, rel=1e-6)

    def with_integrals(t, y):
        v = film(burning, t, y[:-2])
        return np.append(rates(burning)(t, y[:-2]), [v / 10.0, v * v / 10.0])

    start = np.append(first.y[:, -1], [0.0, 0.0])
    second = solve_ivp(with_integrals, (event[ON], event[OFF]), start, method="Radau", rtol=1e-10, atol=1e-16)
    assert event[CHARGE] == pytest.approx(second.y[-2, -1], rel=1e-6)
    assert event[ENERGY] == pytest.approx(second.y[-1, -1], rel=1e-6)


def test_both_polarities_discharge():
    record = march(motor(), [element(breakdown=5.0), element()], arc(), square(280.0, 1e-4, 1e-7, 10))
    assert np.any(record.events[:, VOLTAGE] > 0.0)
    assert np.any(record.events[:, VOLTAGE] < 0.0)
    # At the start the voltage is above the threshold at once.
    np.testing.assert_allclose(np.abs(record.events[1:, VOLTAGE]), 5.0, rtol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("renewal", ["slow", "fast"])
def test_rate_of_films_that_are_renewed(renewal):
    """A square wave, and films renewed at random with the rate nu; p is the chance that one breaks down.

    Slow source, nu much larger than the rate of edges: every plateau ends with a discharge, one an edge. Fast
    source, edges much more frequent than nu: a film that withstands does so until the next one, which breaks
    down with the chance p, and after each discharge the next threshold is drawn; the rate is nu p/(1 - p).
    """
    circuit = motor(winding_rotor_capacitance="100 pF")
    scale = 10.0 if renewal == "slow" else 58.0
    bearings = [element(breakdown=scale, shape=2.0), element()]
    whole, winding = total(circuit, bearings)
    swing = 280.0 * winding / whole  # amplitude of the film voltage
    period = 1e-3 if renewal == "slow" else 1e-5
    nu = 2e5 if renewal == "slow" else 200.0
    breakdown = arc(extinction_voltage=1e-3, renewal_time=1.0 / nu)
    count = 400 if renewal == "slow" else 100_000
    record = march(circuit, bearings, breakdown, square(280.0, period, 1e-8, count), seed=3, highest=60.0)
    events = record.events[record.events[:, FILM] == 0]
    rate = len(events) / record.duration
    if renewal == "slow":
        assert rate == pytest.approx(2.0 / period, rel=0.03)
    else:
        # After an arc the next edge swings to 2 s; films that break down below 2 s are the ones that fire.
        p = 1.0 - math.exp(-((2.0 * swing / scale) ** 2))
        assert 0.4 < p < 0.6
        assert rate == pytest.approx(nu * p / (1.0 - p), rel=0.25)


@pytest.mark.parametrize("chunks", [2, 17])
def test_events_do_not_depend_on_the_chunks(chunks):
    """The same source in one chunk and in many: the same events up to rounding of times."""
    circuit, breakdown = motor(), arc(renewal_time="50 us")
    bearings = [element(breakdown=6.0, shape=5.0), element(breakdown=7.0, shape=5.0)]
    whole = square(280.0, 1e-4, 1e-7, 200)
    parts = [Segments(*(np.ascontiguousarray(part) for part in ends))
             for ends in zip(*(np.array_split(column, chunks) for column in whole), strict=True)]  # fmt: skip
    one, many = (march(circuit, bearings, breakdown, source, seed=5) for source in (whole, parts))
    assert len(one.events) == len(many.events) > 100
    np.testing.assert_allclose(one.events, many.events, rtol=1e-6, atol=1e-12)


def test_events_do_not_depend_on_the_time_step():
    """Each piece of the source cut into ten: the same events."""
    circuit, breakdown = motor(), arc(renewal_time="50 us")
    bearings = [element(breakdown=6.0, shape=5.0), element(breakdown=7.0, shape=5.0)]
    whole = square(280.0, 1e-4, 1e-7, 100)
    steps = np.repeat(whole.duration / 10, 10)
    inside = np.tile(np.arange(10), whole.duration.size) * steps
    fine = Segments(steps, np.repeat(whole.level, 10) + np.repeat(whole.slope, 10) * inside,
                    np.repeat(whole.slope, 10), np.zeros(steps.size, dtype=complex))  # fmt: skip
    coarse_events, fine_events = (
        march(circuit, bearings, breakdown, s, seed=5).events for s in (whole, fine)
    )
    assert len(coarse_events) == len(fine_events) > 100
    np.testing.assert_allclose(coarse_events, fine_events, rtol=1e-6, atol=1e-12)


def test_a_seed_repeats_to_the_last_bit_and_another_does_not():
    circuit, breakdown = motor(), arc(renewal_time="50 us")
    bearings = [element(breakdown=6.0, shape=5.0), element(breakdown=7.0, shape=5.0)]
    source = square(280.0, 1e-4, 1e-7, 100)
    first, again, other = (march(circuit, bearings, breakdown, source, seed=s).events for s in (1, 1, 2))
    assert np.array_equal(first, again)
    assert not np.array_equal(first[:20], other[:20])


def test_thresholds_follow_weibulls_law():
    """Voltages of the first discharges on slow ramps: their mean is V Gamma(1 + 1/m)."""
    circuit, shape = motor(), 4.0
    bearings = [element(breakdown=5.0, shape=shape), element()]
    breakdown = arc(extinction_voltage=5e-3, renewal_time=1e6)
    record = march(circuit, bearings, breakdown, ramp(0.0, 1e6, 0.4, 400), seed=2, highest=60.0)
    voltages = np.abs(record.events[:, VOLTAGE])
    assert len(voltages) > 1000
    expected = 5.0 * math.gamma(1.0 + 1.0 / shape)
    scatter = 5.0 * math.sqrt(math.gamma(1.0 + 2.0 / shape) - math.gamma(1.0 + 1.0 / shape) ** 2)
    assert np.mean(voltages) == pytest.approx(expected, abs=4.0 * scatter / math.sqrt(len(voltages)))
    cumulated = quad(lambda v: 1.0 - math.exp(-((v / 5.0) ** shape)), 0.0, 5.0)[0]
    below = np.mean(np.maximum(5.0 - voltages, 0.0))
    assert below == pytest.approx(cumulated, rel=0.15)


def test_charge_stays_when_elements_move():
    """Capacitances at two positions: at a constant source v C + const stays, so that v jumps with 1/C."""
    circuit = motor()
    moving = element([300e-12, 500e-12], step=1e-5)
    bearings = [moving, element(200e-12)]
    record = march(circuit, bearings, arc(), level(100.0, 1e-4, 10), trace=1.0, highest=60.0)
    beside = circuit.winding_rotor_capacitance + circuit.rotor_frame_capacitance + 200e-12
    first = 100.0 * circuit.winding_rotor_capacitance / (beside + 300e-12)
    # Charge of the rotor node, with the part on the winding capacitance.
    charge = (beside + 300e-12) * first - circuit.winding_rotor_capacitance * 100.0
    second = (charge + circuit.winding_rotor_capacitance * 100.0) / (beside + 500e-12)
    seen = np.unique(np.round(record.trace[:, 2], 9))
    assert seen == pytest.approx(sorted([first, second]), rel=1e-9)


@pytest.mark.slow
@pytest.mark.gate
def test_touching_films_conduct_for_their_share_of_time():
    circuit = motor()
    bearings = [element(touching=0.3, touch_resistance=1.0, transit=1e-5), element()]
    record = march(circuit, bearings, arc(), level(100.0, 0.2, 2000), seed=1, limits=(1e-3,))
    # Once touched, the film has no voltage until the next edge.
    assert record.above[0, 0] / record.duration < 0.01
    square_wave = square(100.0, 2e-6, 1e-8, 50_000)
    record = march(circuit, bearings, arc(), square_wave, seed=1, limits=(0.5,))
    # While it insulates, the voltage swings between zero, at which contact left it, and twice the amplitude.
    assert record.above[0, 0] / record.duration == pytest.approx(0.5 * (1.0 - 0.3), abs=0.03)


def test_largest_voltage_while_asperities_touch():
    """Without edges it is the voltage at which they close: that of the divider, if nothing else happens."""
    circuit = motor()
    bearings = [element(touching=0.3, touch_resistance=1.0, transit=1e-5), element()]
    record = march(circuit, bearings, arc(), level(100.0, 1e-3, 10), seed=1)
    beside = circuit.winding_rotor_capacitance + circuit.rotor_frame_capacitance + 600e-12
    divider = 100.0 * circuit.winding_rotor_capacitance / beside
    assert record.touching == pytest.approx([divider, 0.0], rel=1e-9)


@pytest.mark.parametrize("resistance", [1e-2, 0.1])
def test_films_that_insulate_at_once_are_refused(resistance):
    """A film is charged from 10 mV to 10.01 mV in 0.2 ps of an edge of 50 V/us: 1e5 discharges in 20 ns.

    The source feeds 25 mA, which keep no arc of 0.1 ohm alive at 10 mV.
    """
    bearings = [element(3e-12, breakdown=10.01e-3), element(3e-12)]
    breakdown = arc(arc_resistance=resistance, extinction_voltage="10 mV", recovery_time=0.0)
    circuit = motor(winding_rotor_capacitance="500 pF", rotor_frame_capacitance="1 pF")
    with pytest.raises(InputError) as refused:
        march(circuit, bearings, breakdown, ramp(0.0, 5e7, 1e-5), highest=500.0)
    assert refused.value.key == "breakdown.recovery_time"
    assert "insulate too soon" in str(refused.value)
