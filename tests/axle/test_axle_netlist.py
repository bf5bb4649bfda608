"""Netlist of an axle, simulated by ngspice: the static divider, and voltages after a breakdown."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.signal import StateSpace, lsim

from ehlectric import AxleCase, InputError, write_axle_netlist
from ehlectric.axle.axle_discharges import _films_in_time
from ehlectric.axle.axle_netlist_files import AxleNetlist, _distinct, axle_netlist
from ehlectric.axle.solution import solve_films
from ehlectric.drive import write_files
from ehlectric.drive.discharges.films_and_source import Measuring, Segments
from ehlectric.drive.drive_netlist_files import source_points
from ehlectric.drive.films_in_time import NetworkInTime
from tests.axle.axles import two_stages
from tests.axle.test_films_in_time import axle
from tests.axle.test_solution import by_hand
from tests.helpers.drives import arc
from tests.helpers.ngspice import run_netlist, simulate
from tests.helpers.places import DATA

SHAFTS = ("rotor", "intermediate", "output")
ARC = {"arc_resistance": 2.0, "extinction_voltage": "0.1 V", "recovery_time": "100 ns"}

# Time in which the source rises to 300 V; an arc of 2 ohm ends within a thousandth of it.
RISE = 100e-6


def simulated(netlist, folder, source, analysis, commands):
    """Numbers that ngspice measures in an axle with a source at its winding."""
    write_files(netlist, folder / "axle.lib", None)
    lines = [
        '.include "axle.lib"',
        f"V_source winding 0 {source}",
        f"X_axle winding 0 {' '.join(SHAFTS)} axle",
    ]
    return simulate(folder, lines, analysis, *commands)


def after_an_edge(solution, folder):
    """Voltages of the shafts after a source has risen to 300 V."""
    points = [f"meas tran {shaft} find v({shaft}) at={1.5 * RISE}" for shaft in SHAFTS]
    source = f"PWL(0 0 {RISE} 300 {2.0 * RISE} 300)"
    return simulated(AxleNetlist(solution), folder, source, f"tran 1n {2.0 * RISE} 0 1n", points)


@pytest.mark.slow
@pytest.mark.reference
def test_without_breakdown_the_shafts_have_the_voltages_of_the_divider(tmp_path):
    """By hand: 30 (134, 15, 4)/333.4 V."""
    found = after_an_edge(by_hand(), tmp_path)
    assert [found[shaft] for shaft in SHAFTS] == pytest.approx(
        [30.0 * part / 333.4 for part in (134.0, 15.0, 4.0)], rel=1e-3
    )


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.reference
def test_leaking_films_discharge_the_shafts(tmp_path):
    """By the exponential of the matrices of the nodes: v(t) = exp(-C^-1 G t) v(0) after an edge, to 0.1 %."""
    solution = by_hand()
    films = {film.name: film for film in solution.network().elements}
    times = {"b1": 20e-6, "m12": 50e-6, "b2": 10e-6, "b3": 40e-6}
    leaks = {name: films[name].capacitance / time for name, time in times.items()}

    def matrix(values):
        total = np.zeros((3, 3))
        for name, value in values.items():
            ends = [films[name].first, films[name].second]
            across = np.array([float(shaft == ends[0]) - (shaft == ends[1]) for shaft in SHAFTS])
            total += value * np.outer(across, across)
        return total

    capacitance = matrix({name: film.capacitance for name, film in films.items()})
    edge = np.linalg.solve(capacitance, [300.0 * films["winding"].capacitance, 0.0, 0.0])
    moments = (5e-6, 15e-6, 30e-6)
    # A short edge, in whose middle the voltages of its end would begin to fall.
    rise, start = 10e-9, 1e-6
    commands = [
        f"meas tran {shaft}{k} find v({shaft}) at={start + 0.5 * rise + moment}"
        for shaft in SHAFTS
        for k, moment in enumerate(moments)
    ]
    source = f"PWL(0 0 {start} 0 {start + rise} 300 1m 300)"
    values = simulated(AxleNetlist(solution, leaks), tmp_path, source, "tran 5n 40u 0 5n", commands)
    for k, moment in enumerate(moments):
        volts = expm(-np.linalg.solve(capacitance, matrix(leaks)) * moment) @ edge
        assert [values[f"{shaft}{k}"] for shaft in SHAFTS] == pytest.approx(volts, rel=1e-3)


def test_elements_leak_as_in_the_simulation():
    """Conductances of a netlist are those of the films in time; oil without a conductivity does not leak."""
    case = two_stages(breakdown=ARC, **{"bearings.contact_resistance": 1.0, "discharge.conductivity": 1e-9})
    case = case.replace({"mesh.gear.contact.contact_resistance": 1.0})
    leaks = axle_netlist(case).leaks
    films = _films_in_time(solve_films(case), case.breakdown, set())
    assert {each.name for each in films} == {*leaks}
    for each in films:
        # A mesh over time has 8 phases.
        assert leaks[each.name] == pytest.approx(each.film.conductance, rel=1e-2), each.name
    assert not axle_netlist(two_stages()).leaks


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.reference
@pytest.mark.parametrize(("first", "limit"), [("m12", 10.0), ("b1", 11.0)])
def test_voltages_after_a_breakdown(first, limit, tmp_path):
    """The formula of a breakdown at its voltage, and the divider for the rest of the edge."""
    solution = by_hand(breakdown=ARC)
    limits = {"m12": 1e3, "b1": 1e3, "b2": 1e3, "m23": 1e3, "b3": 1e3, first: limit}
    elements = tuple(replace(each, breakdown_voltage=limits[each.name]) for each in solution.elements)
    solution = replace(solution, elements=elements)
    network, per_volt = solution.network(), solution.network().potentials(1.0)
    film = next(film for film in solution.films() if film.name == first)
    edge = limit / network.voltage(film, per_volt)
    before = {name: edge * value for name, value in per_volt.items()}
    after = network.breakdown(film, before, rest=0.1).potentials
    found = after_an_edge(solution, tmp_path)
    for shaft in SHAFTS:
        assert found[shaft] == pytest.approx(after[shaft] + (300.0 - edge) * per_volt[shaft], rel=0.01)


@pytest.mark.slow
@pytest.mark.reference
@pytest.mark.parametrize("resistance", [2.0, 10.0])
def test_discharges_agree_with_the_march(resistance, tmp_path):
    """Six edges of an inverter in 100 us, each with discharges of both meshes and of the last bearing; with
    10 ohm the arcs last as long as the edges.

    The circuit is the same: 1 nF of frame and of the first bearing. Voltages 7 us after each edge.
    """
    breakdown = ARC | {"arc_resistance": resistance}
    starts, signs, edge, rise = (10.0, 25.0, 40.0, 60.0, 75.0, 90.0), (1, 1, 1, -1, -1, -1), 800.0 / 3.0, 0.05
    times, volts = [0.0], [0.0]
    for start, sign in zip(starts, signs, strict=True):
        times += [start, start + rise]
        volts += [volts[-1], volts[-1] + sign * edge]
    times, volts = 1e-6 * np.array([*times, 100.0]), np.array([*volts, volts[-1]])
    moments = [1e-6 * (start + 7.0) for start in starts]

    breakdown_at_once = arc(**(breakdown | {"recovery_time": "0 s"}))
    of = axle(kind=NetworkInTime, relaxation=np.inf, b1=1.0, breakdown=breakdown_at_once)
    none = np.zeros(times.size - 1, dtype=complex)
    source = Segments(np.diff(times), volts[:-1], np.diff(volts) / np.diff(times), none)
    record = of.march(iter([source]), Measuring(0.0, 1e-4, 40.0, (1.0,), np.inf), 0)
    # Shafts are the last columns.
    trace = record.trace
    marched = {
        f"{shaft}{k}": np.interp(moment, trace[:, 0], trace[:, column])
        for column, shaft in zip((-3, -2, -1), SHAFTS, strict=True)
        for k, moment in enumerate(moments)
    }

    solution = by_hand(**{"circuit.rotor_frame_capacitance": "1 nF", "breakdown": breakdown})
    points = " ".join(f"{time:.12g} {volt:.12g}" for time, volt in zip(times, volts, strict=True))
    commands = [
        f"meas tran {shaft}{k} find v({shaft}) at={moment}"
        for shaft in SHAFTS
        for k, moment in enumerate(moments)
    ]
    found = simulated(AxleNetlist(solution), tmp_path, f"PWL({points})", "tran 0.2n 100u 0 0.2n", commands)
    assert len(record.events) >= 18
    for name, voltage in marched.items():
        assert found[name] == pytest.approx(voltage, rel=0.01, abs=1e-3), name


@pytest.mark.slow
def test_the_bench_of_an_axle_with_a_ring_and_conducting_meshes(tmp_path):
    """The highest voltage of the rotor is that of the static answer at the edge of the inverter."""
    case = AxleCase.from_toml(DATA / "axles" / "e_axle.toml")
    files = write_axle_netlist(case, tmp_path / "axle.lib", bench=tmp_path / "bench.cir")
    assert [file.name for file in files] == ["axle.lib", "bench.cir"]
    found = run_netlist(tmp_path / "bench.cir")
    assert found["winding_peak_to_peak"] == pytest.approx(800.0, rel=1e-6)
    potentials = axle_netlist(case).solution.potentials()
    for shaft in SHAFTS:
        assert found[f"{shaft}_highest"] == pytest.approx(potentials[shaft], rel=0.01)


# A choke and a ground connection, whose oscillations the source excites.
INDUCTIVE = {
    "winding_frame_capacitance": "5 nF",
    "common_mode_inductance": "1 mH",
    "common_mode_resistance": "200 ohm",
    "ground_inductance": "10 uH",
    "ground_resistance": "5 ohm",
    "cable_capacitance": "1 nF",
    "frame_earth_capacitance": "300 pF",
}


@pytest.mark.slow
@pytest.mark.parametrize("earthed", [True, False])
def test_the_bench_of_an_axle_with_inductances(earthed, tmp_path):
    """Voltages from peak to peak are those of the state equations, integrated by SciPy."""
    keys = {
        key: INDUCTIVE[key] for key in INDUCTIVE if earthed or not key.startswith(("cable", "frame_earth"))
    }
    case = two_stages(**{f"circuit.{key}": value for key, value in keys.items()}, breakdown=None, remedies=[])
    write_axle_netlist(case, tmp_path / "axle.lib", bench=tmp_path / "bench.cir")
    found = run_netlist(tmp_path / "bench.cir")
    network = axle_netlist(case).solution.network()
    system, points = network.equations, source_points(case.source.at_speed(case.drive.speed), None)[0]
    times = np.linspace(0.0, points[-1][0], 80_001)
    volts = np.interp(times, *np.array(points).T)
    states = np.eye(len(system.force))
    whole = StateSpace(system.rates, system.force[:, None], states, np.zeros((len(states), 1)))
    # Leaks hold the shafts at 0 V before, and the winding has the voltage of the source.
    start = system.jump * volts[0]
    start[: len(system.nodes)] += [volts[0] * (node == "winding") for node in system.nodes]
    _, at, _ = lsim(whole, volts, times, X0=start)
    voltages = at - np.outer(volts, system.jump)
    for shaft in SHAFTS:
        across = voltages @ system.potential(network.nodes[shaft])
        assert found[f"{shaft}_peak_to_peak"] == pytest.approx(np.ptp(across), rel=2e-3), shaft
    assert found["rotor_peak_to_peak"] > 1.2 * network.potentials(np.ptp(volts))["rotor"]


def test_elements_of_the_netlist(tmp_path):
    """Switches need the table [breakdown]; elements that conduct are resistances."""
    alone, with_arc = (
        "\n".join(AxleNetlist(by_hand(**changes)).lines()) for changes in ({}, {"breakdown": ARC})
    )
    assert ".subckt axle winding housing rotor intermediate output" in alone
    assert "X_b1 rotor housing insulator C_films={C_b1}" in alone
    assert "X_m12 rotor intermediate film C_films={C_m12} V_break={V_m12}" in with_arc
    closed = replace(by_hand(), elements=(replace(by_hand().elements[1], contact_time_share=1.0),))
    assert "R_m12 rotor intermediate {R_metal}" in "\n".join(AxleNetlist(closed).lines())
    assert _distinct(["housing", "a b", "a-b"], "shaft", ("housing",)) == ["housing_2", "a_b", "a_b_2"]
    with pytest.raises(InputError, match="at which the films of"):
        write_axle_netlist(two_stages(breakdown={**ARC, "extinction_voltage": "5 V"}), tmp_path / "axle.lib")
    assert not (tmp_path / "axle.lib").exists()
