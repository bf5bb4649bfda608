"""Voltages and discharges of a drive beside those of ngspice for the same circuit."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.bearing.circuit import Path
from ehlectric.drive.drive_record import CHARGE, ENERGY, FILM, ON, VOLTAGE
from tests.helpers.drives import arc, element, from_rest, march, motor, rotor_network, square
from tests.helpers.ngspice import waveform

# Ten periods of a 10 kHz carrier whose edges take 1 us: ngspice places their corners within 0.2 ns.
VOLTAGE_OF_LINK, PERIOD, RISE, PERIODS = 280.0, 1e-4, 1e-6, 10

INDUCTIVE = {
    "common_mode_inductance": "20 uH",
    "common_mode_resistance": "5 ohm",
    "ground_inductance": "2 uH",
    "ground_resistance": "1 ohm",
}
CABLE = {"cable_capacitance": "1 nF", "frame_earth_capacitance": "300 pF"}
COATED = Path(coating=2e-9, resistance=1e6, parallel=20e-12)

CIRCUITS = {
    "divider": (motor(), [element(), element(250e-12)]),
    "leaking": (motor(), [element(conductance=1e-6), element(conductance=2e-6)]),
    "ring": (motor(grounding_ring_resistance="2 kohm"), [element(), element()]),
    "coated": (motor(), [element(path=COATED, conductance=1e-7), element()]),
    "inductive": (motor(**INDUCTIVE), [element(), element()]),
    "cable": (motor(**INDUCTIVE, **CABLE), [element(path=COATED), element(conductance=1e-6)]),
}


def netlist(circuit, bearings, segments, *, switch=None):
    """Lines of a netlist of the same elements, with the source as points in time."""
    network = rotor_network(circuit, bearings, arc()).at_rest
    own, (positive, negative) = [*network.circuit()], network.ends
    times = np.concatenate([[0.0], np.cumsum(segments.duration)])
    values = np.append(segments.level, segments.level[-1])
    points = " ".join(f"{t:.12e} {v:.6e}" for t, v in zip(times, values, strict=True))
    lines = [f"Vsource {named(positive)} {named(negative)} PWL({points})"]
    for k, one in enumerate(own):
        ends = f"{named(one.first)} {named(one.second)}"
        if one.kind == "capacitor":
            lines.append(f"C{k} {ends} {one.value:.12e}")
        elif one.kind == "conductor":
            lines.append(f"R{k} {ends} {1.0 / one.value:.12e}")
        else:
            lines += [f"L{k} {named(one.first)} inner{k} {one.value:.12e}",
                      f"RL{k} inner{k} {named(one.second)} {max(one.resistance, 1e-9):.12e}"]  # fmt: skip
    first = network.equations
    start = -first.jump * segments.level[0]
    starts = dict(zip(first.nodes, start, strict=False))
    starts[positive] = starts.get(negative, 0.0) + segments.level[0]
    lines.append(".ic " + " ".join(f"v({named(n)})={v:.12e}" for n, v in starts.items()))
    return lines + (switch or [])


def named(node):
    return "0" if node == "frame" else node.replace(" ", "_")


def film_nodes(circuit, bearings):
    """Nodes between which the films of each bearing lie."""
    rotor = rotor_network(circuit, bearings, arc())
    return [(rotor.at_rest.nodes[each.first], rotor.at_rest.nodes[each.lower]) for each in rotor.films]


def film_vector(nodes):
    upper, lower = map(named, nodes)
    return f"v({upper})" if lower == "0" else f"v({upper})-v({lower})"


@pytest.mark.slow
@pytest.mark.parametrize("name", CIRCUITS)
def test_voltage_without_breakdown_is_that_of_ngspice(name, tmp_path):
    """Within 0.1 % of the largest voltage at every time of ten periods."""
    circuit, bearings = CIRCUITS[name]
    segments = square(VOLTAGE_OF_LINK, PERIOD, RISE, PERIODS)
    record = march(circuit, bearings, arc(), segments, highest=60.0, trace=np.inf)
    lines = netlist(circuit, bearings, segments)
    lines.append(".options reltol=1e-7 abstol=1e-12 vntol=1e-9 method=gear maxord=2")
    length = PERIOD * PERIODS
    # Films without a coating have the same voltage.
    for film, ends in enumerate(dict.fromkeys(film_nodes(circuit, bearings))):
        times, values = waveform(tmp_path, lines, f"tran 20n {length} 0 4n uic", film_vector(ends))
        theirs = np.interp(record.trace[:, 0], times, values)
        mine = record.trace[:, 2 + film]
        assert np.max(np.abs(mine)) > 5.0
        np.testing.assert_allclose(mine, theirs, rtol=0.0, atol=1e-3 * np.max(np.abs(theirs)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["divider", "leaking", "coated"])
def test_discharges_at_a_fixed_threshold_are_those_of_ngspice(name, tmp_path):
    """The same number of events; voltages, charges and energies within 1 %."""
    threshold, extinction, resistance = 6.0, 0.5, 10.0
    circuit, (first, second) = CIRCUITS[name]
    # A copy: the elements of the table are those of other tests.
    first = replace(first, breakdown=np.full_like(first.breakdown, threshold))
    bearings, breakdown = [first, second], arc(extinction_voltage=extinction, arc_resistance=resistance)
    segments = from_rest(square(VOLTAGE_OF_LINK, PERIOD, RISE, 4), RISE)
    record = march(circuit, bearings, breakdown, segments)
    upper, lower = map(named, film_nodes(circuit, bearings)[0])
    middle, half = 0.5 * (threshold + extinction), 0.5 * (threshold - extinction)
    switch = [
        f"Babs control 0 V=abs(v({upper},{lower}))",
        "Vsense " + upper + " arc 0",
        f"Sarc arc {lower} control 0 spark",
        f".model spark SW(vt={middle} vh={half} ron={resistance} roff=1e15)",
        ".options reltol=1e-5 abstol=1e-12 vntol=1e-7",
    ]
    lines = netlist(circuit, bearings, segments, switch=switch)
    times, current = waveform(tmp_path, lines, f"tran 1n {4 * PERIOD} 0 1n uic", "i(vsense)")
    burning = np.abs(current) > 0.5 * extinction / resistance
    begins = np.flatnonzero(np.diff(burning.astype(int)) == 1)
    events = record.events[record.events[:, FILM] == 0]
    assert len(events) == len(begins) >= 7
    np.testing.assert_allclose(events[:, VOLTAGE], np.copysign(threshold, events[:, VOLTAGE]), rtol=1e-9)
    ends = np.append(begins[1:], times.size - 1)
    for event, begin, end in zip(events, begins, ends, strict=True):
        near = slice(begin, end)
        charge = np.trapezoid(current[near], times[near])
        energy = np.trapezoid(resistance * current[near] ** 2, times[near])
        assert event[ON] == pytest.approx(times[begin], abs=2e-9)
        assert event[CHARGE] == pytest.approx(charge, rel=0.01)
        assert event[ENERGY] == pytest.approx(energy, rel=0.01)
