"""The subcircuit of a bearing, simulated by ngspice, against the numbers of the solved bearing."""

import math

import numpy as np
import pytest

from ehlectric import solve_bearing, write_netlist
from ehlectric.bearing.impedance import mean_admittance
from ehlectric.bearing.summary import summary_of
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.ngspice import run_netlist, simulate, waveform

ARC = {"arc_resistance": "1 ohm", "extinction_voltage": "1 V"}
COATED = {
    "bearing__coating": {
        "ring": "outer",
        "thickness": "200 um",
        "relative_permittivity": 9.0,
        "area": "4500 mm^2",
        "resistance": "50 Mohm",
    },
    "bearing__parallel_capacitance": "30 pF",
}


def solved(**changes):
    return solve_bearing(bearing_case(BALLS, contacts="formula", **changes), workers=1)


def totals(result):
    """Numbers of the bearing as in summary.json, without the analysis of its margin, which takes seconds."""
    return summary_of(result.solution)["bearing"]


@pytest.fixture(scope="module")
def plain():
    return solved()


@pytest.fixture(scope="module")
def coated():
    return solved(**COATED)


@pytest.fixture(scope="module")
def over_speed():
    return [solved(bearing__inner_speed=f"{speed} rpm") for speed in (3000, 1500, 2000, 4500, 6000, 9000)]


def written(result, folder, **options):
    """Line that includes the netlist of a result."""
    write_netlist(result, folder / "bearing.lib", **options)
    return '.include "bearing.lib"'


def capacitance_of(folder, include, instance="bearing"):
    """Capacitance at 1 MHz [F]."""
    lines = [include, "V1 a 0 AC 1", f"X1 a 0 {instance}"]
    found = simulate(folder, lines, "ac lin 1 1meg 1meg", "let cap = -imag(i(v1))/(2*pi*1e6)", "print cap")
    return found["cap"]


def resistance_of(folder, include, instance="bearing"):
    """Resistance for direct current [Ohm]."""
    lines = [include, "V1 a 0 DC 1", f"X1 a 0 {instance}"]
    # The current as a number of order one: ngspice ends its iteration at 1 pA.
    found = simulate(folder, lines, "option abstol=1e-20", "op", "let res = -1/i(v1)", "print res")
    return found["res"]


@pytest.mark.parametrize("name", ["plain", "coated"])
def test_the_capacitance_is_that_of_the_bearing(name, request, tmp_path):
    result = request.getfixturevalue(name)
    found = capacitance_of(tmp_path, written(result, tmp_path, **ARC))
    assert found == pytest.approx(totals(result)["shaft_capacitance"], rel=1e-4)


def test_the_leak_is_that_of_the_oil(plain, tmp_path):
    """Between rings with oil everywhere: relaxation time over capacitance."""
    expected = totals(plain)["relaxation_time"] / plain.capacitance()
    for options in ({}, ARC):
        found = resistance_of(tmp_path, written(plain, tmp_path, **options))
        assert found == pytest.approx(expected, rel=1e-4)


def test_the_leak_passes_the_coating(coated, tmp_path):
    expected = totals(coated)["relaxation_time"] / coated.capacitance() + 50e6
    assert resistance_of(tmp_path, written(coated, tmp_path)) == pytest.approx(expected, rel=1e-4)


def test_a_charge_decays_with_the_relaxation_time(tmp_path):
    result = solved(discharge__conductivity="1 uS/m")
    tau = totals(result)["relaxation_time"]
    lines = [written(result, tmp_path), "X1 a 0 bearing", ".ic v(a)=1"]
    times, values = waveform(tmp_path, lines, f"tran {tau / 500} {2 * tau} 0 {tau / 500} uic", "v(a)")
    for time in (tau, 2 * tau):
        assert np.interp(time, times, values) == pytest.approx(math.exp(-time / tau), rel=1e-4)


def ramp(folder, result, sign, resistance, instance="bearing", include=None, steps=4000):
    """Voltage of a ramp to 10 V and back behind a resistance, and across the bearing."""
    include = include or written(result, folder, **ARC)
    lines = [include, f"V1 s 0 PWL(0 0 1m {10 * sign} 2m 0)", f"R1 s a {resistance}", f"X1 a 0 {instance}"]
    return waveform(folder, lines, f"tran {2e-3 / steps} 2m 0 {2e-3 / steps}", "v(a)")


def first_drop(values):
    return int(np.argmax(np.abs(values[1:]) < np.abs(values[:-1])))


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1, -1])
def test_the_switch_closes_at_the_breakdown_voltage(plain, sign, tmp_path):
    """Within a time step of the ramp of 10 V in 1 ms; behind 1 kOhm the arc cannot hold its voltage."""
    expected = plain.breaks()["ring_to_ring_breakdown"]
    _, values = ramp(tmp_path, plain, sign, 1e3)
    top = first_drop(values)
    step = 10.0 * 2e-3 / 4000 / 1e-3
    assert np.sign(values[top]) == sign
    assert abs(abs(values[top]) - expected) <= step
    # The arc goes out at its extinction voltage; the films charge again, and break down again.
    after = np.abs(values[top + 1 :])
    assert after.min() <= after[: after.size // 2].min() == pytest.approx(1.0, rel=0.1)
    assert after[np.argmin(after[: after.size // 2]) :].max() == pytest.approx(expected, rel=0.02)


def test_the_arc_stays_until_its_extinction_voltage(plain, tmp_path):
    """Behind 1 Ohm, an arc of 1 Ohm has half of the voltage of the source, down to 1 V."""
    expected = plain.breaks()["ring_to_ring_breakdown"]
    times, values = ramp(tmp_path, plain, 1, 1.0)
    source = 10.0 * np.minimum(times, 2e-3 - times) / 1e-3
    before = times < (expected - 0.02) * 1e-4
    burning = (times > (expected + 0.02) * 1e-4) & (times < 2e-3 - 2.02 * 1e-4)
    out = times > 2e-3 - 1.98 * 1e-4
    np.testing.assert_allclose(values[before], source[before], atol=1e-3)
    # The trapezoidal rule rings about the solution, where the step is much longer than the time constant.
    np.testing.assert_allclose(values[burning], 0.5 * source[burning], rtol=5e-3)
    np.testing.assert_allclose(values[out], source[out], atol=1e-3)


def test_a_coating_keeps_its_share_at_the_breakdown(coated, tmp_path):
    """A fast ramp: the films have C_c/(C_c + C) of the shaft voltage, as the capacitors divide it."""
    breakdown, share = coated.breaks()["ring_to_ring_breakdown"], totals(coated)["film_share"]
    include = written(coated, tmp_path, **ARC)
    shaft = breakdown / share
    lines = [include, f"V1 a 0 PWL(0 0 1u {1.2 * shaft})", "X1 a 0 bearing"]
    times, values = waveform(tmp_path, lines, "tran 0.2n 1u 0 0.2n", "v(x1.ring)")
    top = first_drop(values)
    assert values[top] == pytest.approx(breakdown, rel=1e-3)
    assert 1.2 * shaft * times[top] / 1e-6 == pytest.approx(shaft, rel=1e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_the_table_has_its_nodes(over_speed, tmp_path):
    include = written(over_speed, tmp_path, **ARC)
    assert capacitance_of(tmp_path, include) == pytest.approx(over_speed[0].capacitance(), rel=1e-6)
    for speed, at in ((1500, 1), (6000, 4), (9000, 5), (100, 1), (30000, 5)):
        instance = f"bearing speed={speed}"
        own = over_speed[at].capacitance()
        assert capacitance_of(tmp_path, include, instance) == pytest.approx(own, rel=1e-6), speed
        tau = totals(over_speed[at])["relaxation_time"]
        assert resistance_of(tmp_path, include, instance) == pytest.approx(tau / own, rel=1e-4), speed


@pytest.mark.slow
def test_between_its_nodes_the_table_is_near_the_bearing(over_speed, tmp_path):
    """At 2500 rpm, between nodes at 2000 and 3000 rpm, against the bearing that is solved there."""
    result, include = solved(bearing__inner_speed="2500 rpm"), written(over_speed, tmp_path, **ARC)
    found = capacitance_of(tmp_path, include, "bearing speed=2500")
    assert found == pytest.approx(result.capacitance(), rel=2e-3)
    _, values = ramp(tmp_path, None, 1, 1e3, "bearing speed=2500", include)
    expected = result.breaks()["ring_to_ring_breakdown"]
    assert abs(values[first_drop(values)]) == pytest.approx(expected, rel=4e-3)


MOTOR = {"motor__switching_frequency": "10 kHz", "motor__rise_time": "0.2 us"}


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        {},
        COATED,
        {"motor__second_bearing_capacitance": "100 pF"},
        # No path for direct current to the shaft other than those that stand for insulators.
        {**COATED, "discharge__conductivity": None, "bearing__coating__resistance": None},
    ],
    ids=["two-equal", "coated", "second", "insulated"],
)
def test_the_bench_has_the_bearing_voltage_ratio(changes, tmp_path):
    result = solved(**MOTOR, **changes)
    write_netlist(result, tmp_path / "bearing.lib", bench=tmp_path / "bench.cir")
    found = run_netlist(tmp_path / "bench.cir")
    ratio = found["shaft_peak_to_peak"] / found["common_mode_peak_to_peak"]
    assert ratio == pytest.approx(totals(result)["bearing_voltage_ratio"], rel=1e-4)
    assert found["common_mode_peak_to_peak"] == pytest.approx(600.0)
    assert found["shaft_highest"] == pytest.approx(result.shaft_voltage, rel=1e-3)
    assert found["shaft_lowest"] == pytest.approx(-result.shaft_voltage, rel=1e-3)


def test_the_bench_leaks_as_both_bearings_do(tmp_path):
    """After a period the shaft voltage is that of the solved bearing, with another second bearing."""
    changes = {"motor__second_bearing_capacitance": "100 pF", "discharge__conductivity": "1 uS/m"}
    result = solved(**MOTOR, **changes)
    write_netlist(result, tmp_path / "bearing.lib", bench=tmp_path / "bench.cir")
    # A single edge at the start, and then a whole period without another.
    bench = (tmp_path / "bench.cir").read_text().splitlines()
    own = [line for line in bench if line[:2] not in (".t", ".m", ".e", "V_") and "middle" not in line]
    lines = [*own, "V_bearing shaft inner 0", "V1 winding 0 PWL(0 0 1n {V_peak})"]
    times, values = waveform(tmp_path, lines, "tran 50n 100u 0 50n", "v(shaft)")
    expected = totals(result)["shaft_voltage_after_period"]
    assert np.interp(100e-6, times, values) == pytest.approx(expected, rel=1e-3)


def test_the_bench_discharges_where_breakdown_is_expected(tmp_path):
    """A common-mode voltage of 1 kV: the highest shaft voltage is the breakdown voltage, for both signs."""
    result = solved(motor__common_mode_voltage="1 kV", **MOTOR)
    write_netlist(result, tmp_path / "bearing.lib", bench=tmp_path / "bench.cir", **ARC)
    found = run_netlist(tmp_path / "bench.cir")
    limit = result.breaks()["ring_to_ring_breakdown"]
    assert result.shaft_voltage > limit
    # In a step of the edge of 0.2 us, a twentieth of it, the voltage rises by so much.
    step = 2.0 * result.shaft_voltage / 20.0
    assert abs(found["shaft_highest"] - limit) < step
    assert abs(found["shaft_lowest"] + limit) < step
    assert found["current_highest"] > 1.0


@pytest.mark.parametrize("own", ["3 pF", None])
def test_ceramic_elements_are_a_capacitance(own, tmp_path):
    result = solved(bearing__element_material="silicon-nitride", bearing__element_capacitance=own)
    include = written(result, tmp_path, **ARC)
    expected = result.capacitance() if own is None else 9 * 3e-12
    assert capacitance_of(tmp_path, include) == pytest.approx(expected, rel=1e-4)
    text = (tmp_path / "bearing.lib").read_text()
    assert ".model" not in text
    assert ("an upper bound of it" in " ".join(text.replace("\n*", " ").split())) == (own is None)


def test_surfaces_that_touch_are_a_resistance(tmp_path):
    """The mean conductance over time, against the mean admittance at a low frequency."""
    result = solved(bearing__inner_speed="50 rpm", bearing__contact_resistance="1 ohm")
    solution = result.solution
    mean = mean_admittance(solution, 1e9, np.array([1e-3]), 1.0)[0].real
    assert resistance_of(tmp_path, written(result, tmp_path, **ARC)) == pytest.approx(1.0 / mean, rel=1e-4)
    assert ".model" not in (tmp_path / "bearing.lib").read_text()
