"""What is measured over time: histograms that widen by themselves, and the trace around a discharge."""

import numpy as np
import pytest
from scipy.linalg import expm

from ehlectric.bearing.circuit import Path
from ehlectric.drive.discharges.films_and_source import Segments
from ehlectric.drive.drive_record import FILM, ON, VOLTAGE
from tests.helpers.drives import arc, capacitive_divider, drive_system, element, march, motor, square

PERIOD = 1e-4


@pytest.mark.parametrize("highest", [0.01, 20.0, 5e4])
def test_a_triangle_is_at_all_of_its_voltages_for_the_same_time(highest):
    """Whatever voltage was expected: the first range is 2^-12 of it, and doubles up to the triangle's."""
    triangle = square(100.0, PERIOD, 0.5 * PERIOD, 20)
    record = march(motor(), [element(), element(100e-12)], arc(), triangle, highest=highest)
    reach, peak = record.edges[-1], record.peak
    assert reach >= max(peak)
    if highest < 1e4:
        assert reach < 2.0 * max(peak)
    width = record.edges[1] - record.edges[0]
    assert record.edges[0] == -reach
    for b in range(2):
        inside = np.abs(record.edges[:-1] + 0.5 * width) < peak[b] - width
        assert np.sum(inside) > 20
        assert record.histogram[b, inside] == pytest.approx(
            record.duration * width / (2.0 * peak[b]), rel=2e-3
        )
        assert np.sum(record.histogram[b]) == pytest.approx(record.duration)


def test_the_histogram_and_the_limits_agree():
    """Edges of bins that are limits have the same time above them."""
    bearings = [element(breakdown=6.0, shape=4.0), element(breakdown=9.0, shape=4.0)]
    wave = square(100.0, PERIOD, 1e-6, 200)
    edges = march(motor(), bearings, arc(), wave, seed=2).edges
    limits = tuple(float(edge) for edge in edges[edges.size // 2 + 1 :: 20])
    record = march(motor(), bearings, arc(), wave, seed=2, limits=limits)
    half = record.histogram.shape[1] // 2
    both = record.histogram[:, half:] + record.histogram[:, half - 1 :: -1]
    for k in range(len(limits)):
        assert np.sum(both[:, 1 + 20 * k :], axis=1) == pytest.approx(record.above[:, k], abs=1e-12)


def test_the_trace_is_around_one_of_the_first_discharges():
    """It is a part of the trace of the whole time, to the last bit, also in a later chunk of the source."""
    bearings = [element(breakdown=12.0, shape=4.0), element(breakdown=13.0, shape=4.0)]
    chunks = [square(50.0, PERIOD, 1e-6, 10), *(square(100.0, PERIOD, 1e-6, 10) for _ in range(3))]
    whole = march(motor(), bearings, arc(), chunks, seed=3, trace=np.inf)
    part = march(motor(), bearings, arc(), chunks, seed=3, trace=2.0 * PERIOD, at_event=True)
    assert np.array_equal(part.events, whole.events)
    assert np.array_equal(part.histogram, whole.histogram)
    begin, end = part.trace[0, 0], part.trace[-1, 0]
    assert PERIOD < end - begin <= 2.0 * PERIOD
    first = part.events[:5]
    seen = first[(first[:, ON] >= begin) & (first[:, ON] <= end)]
    assert len(seen)
    assert begin > 10.0 * PERIOD
    same = whole.trace[(whole.trace[:, 0] >= begin) & (whole.trace[:, 0] <= end)]
    assert np.array_equal(part.trace, same)
    # The voltage of a film is its threshold when the arc begins.
    at = part.trace[np.searchsorted(part.trace[:, 0], seen[0, ON])]
    assert seen[0, VOLTAGE] in at[2:]


def test_the_trace_is_at_the_begin_where_nothing_discharges():
    record = march(motor(), [element(), element()], arc(), square(100.0, PERIOD, 1e-6, 10),
                   trace=2.0 * PERIOD, at_event=True)  # fmt: skip
    assert record.trace[0, 0] == 0.0
    assert record.trace[-1, 0] < 2.0 * PERIOD


def sine(mean, amplitude, count, pieces=400):
    """Sine about a mean voltage, from its mean on, as straight pieces: ``count`` periods."""
    values = mean + amplitude * np.sin(2.0 * np.pi * np.arange(count * pieces + 1) / pieces)
    step = PERIOD / pieces
    none = np.zeros(count * pieces, dtype=complex)
    return Segments(np.full(none.size, step), values[:-1], np.diff(values) / step, none)


@pytest.mark.parametrize(("path", "part"), [(Path(), 1.0), (Path(coating=300e-12), 0.5)])
def test_a_sine_on_the_shaft_has_the_numbers_of_a_sine(path, part):
    """By hand: the divider times the mean m, sqrt(m^2 + A^2/2), and m + A and m - A of the source.

    A coating of the capacitance of the films leaves these half of the voltage of the shaft.
    """
    bearings = [element(300e-12, path=path) for _ in range(2)]
    circuit = motor()
    record = march(circuit, bearings, arc(), sine(30.0, 100.0, 20))
    ratio = capacitive_divider(circuit, bearings)[0] / part
    assert record.shaft_mean == pytest.approx(30.0 * ratio, rel=1e-6)
    assert record.shaft_rms == pytest.approx(np.sqrt(30.0**2 + 0.5 * 100.0**2) * ratio, rel=1e-4)
    assert record.shaft_highest == pytest.approx(130.0 * ratio, rel=1e-6)
    assert record.shaft_lowest == pytest.approx(-70.0 * ratio, rel=1e-6)
    assert (record.source_lowest, record.source_highest) == pytest.approx((-70.0, 130.0), rel=1e-9)


def test_the_shaft_has_the_numbers_of_its_waveform():
    """Those of numpy from the time at each voltage of a film without a coating, and from its trace."""
    bearings = [element(breakdown=8.0, shape=4.0), element(100e-12, breakdown=9.0, shape=4.0)]
    record = march(motor(), bearings, arc(), square(100.0, PERIOD, 1e-6, 20), seed=1, trace=np.inf)
    assert np.sum(record.counts) > 20
    assert len(record.trace) < 20_000
    source, volts = record.trace[:, 1], record.trace[:, 2]
    assert record.shaft_highest == pytest.approx(np.max(volts), rel=1e-6)
    assert record.shaft_lowest == pytest.approx(np.min(volts), rel=1e-6)
    middle, share = record.edges[:-1] + 0.5 * np.diff(record.edges), record.histogram[0] / record.duration
    assert record.shaft_mean == pytest.approx(np.sum(middle * share), abs=np.diff(record.edges)[0])
    assert record.shaft_rms == pytest.approx(np.sqrt(np.sum(middle**2 * share)), rel=2e-3)
    assert record.shaft_rms == pytest.approx(record.rms[0], rel=1e-6)
    assert record.source_highest - record.source_lowest == pytest.approx(np.ptp(source))


def test_discharges_of_both_signs_are_all_discharges():
    bearings = [element(breakdown=6.0, shape=4.0), element(breakdown=9.0, shape=4.0)]
    record = march(motor(), bearings, arc(), square(100.0, PERIOD, 1e-6, 200), seed=2)
    for b in range(2):
        own = record.events[record.events[:, FILM] == b, VOLTAGE]
        assert own.size == np.sum(record.counts[b]) > 20
        assert record.positive[b] == np.sum(own > 0.0)
        assert own.size - record.positive[b] == np.sum(own < 0.0) > 0


def random_circuit(seed):
    """Motor, bearings, arc and square wave, all drawn, and the time constant of the faster arc [s]."""
    random = np.random.default_rng(seed)
    inductances = {}
    if random.random() < 0.5:
        inductances = {"common_mode_inductance": random.uniform(1e-7, 1e-6), "common_mode_resistance": 10.0}
    circuit = motor(**inductances)
    bearings = [
        element(
            random.uniform(1e-10, 5e-10),
            breakdown=random.uniform(3.0, 6.0),
            conductance=random.uniform(0.0, 1e-4),
        )
        for _ in range(2)
    ]
    resistance = random.uniform(100.0, 1000.0)
    tau = resistance * 1e-9
    breakdown = arc(
        arc_resistance=resistance,
        extinction_voltage=random.uniform(0.1, 2.0),
        recovery_time=random.uniform(0.0, 0.5) * tau,
    )
    voltage = random.uniform(150.0, 400.0)
    return (
        circuit,
        bearings,
        breakdown,
        square(voltage, 20.0 * tau, random.integers(4, 24) * tau / 8.0, 2),
        tau,
    )


class Steps:
    """Voltages of both films in small steps of time, and arcs that begin and end at them."""

    def __init__(self, circuit, bearings, breakdown, dt):
        through_arc = 1.0 / breakdown.arc_resistance
        systems = [
            drive_system(circuit, bearings, (first, second))
            for first in (0.0, through_arc)
            for second in (0.0, through_arc)
        ]
        self.rotor = systems[0].potential("shaft rotor")
        self.jump = [system.jump for system in systems]
        self.breakdown, self.dt = breakdown, dt
        self.limits = [one.breakdown[0] for one in bearings]
        self.moves = []
        for system in systems:
            n = system.force.size
            whole = np.zeros((n + 2, n + 2))
            whole[:n, :n], whole[:n, n], whole[n, n + 1] = system.rates, system.force, 1.0
            self.moves.append(expm(whole * dt))

    def run(self, segments):
        """Absolute voltage of the rotor at all steps."""
        x, burning, recovers = np.zeros(self.rotor.size), [False, False], [np.inf, np.inf]
        found = []
        for duration, level, slope in zip(segments.duration, segments.level, segments.slope, strict=True):
            for k in range(round(duration / self.dt)):
                state = 2 * burning[0] + burning[1]
                u = level + slope * k * self.dt
                v = abs(self.rotor @ (x - self.jump[state] * u))
                found.append(v)
                for b in range(2):
                    self.switch(b, v, burning, recovers)
                move = self.moves[2 * burning[0] + burning[1]]
                x = (move @ np.concatenate([x, [u, slope]]))[: x.size]
        return np.array(found)

    def switch(self, b, v, burning, recovers):
        lowest = self.breakdown.lowest_voltage
        if not burning[b]:
            burning[b], recovers[b] = v >= max(self.limits[b], lowest), np.inf
        elif recovers[b] < np.inf:
            recovers[b] -= self.dt
            if recovers[b] <= 0.0:
                burning[b], recovers[b] = v > lowest, np.inf
        elif v <= lowest:
            recovers[b] = self.breakdown.recovery_time


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
def test_arcs_in_small_steps_of_time(seed):
    """Root mean square, time above limits and histogram beside steps of 1/4000 of the arc's time constant."""
    circuit, bearings, breakdown, wave, tau = random_circuit(seed)
    v = Steps(circuit, bearings, breakdown, tau / 4000.0).run(wave)
    limits = tuple(float(part) for part in np.array([0.1, 0.3, 0.6, 0.9]) * np.max(v))
    record = march(circuit, bearings, breakdown, wave, limits=limits)
    assert len(record.events) >= 3
    assert record.rms == pytest.approx(np.full(2, np.sqrt(np.mean(v**2))), rel=1e-3)
    for above in record.above:
        expected = [np.mean(v > limit) * record.duration for limit in limits]
        assert above == pytest.approx(expected, rel=1e-3, abs=1e-3 * tau)
    # Time below each edge of a bin, to 0.1 % of the time or of the highest voltage.
    half = record.histogram.shape[1] // 2
    below = np.cumsum(record.histogram[0, half:] + record.histogram[0, half - 1 :: -1]) / record.duration
    for edge, share in zip(record.edges[half + 1 :], below, strict=True):
        low, high = (np.mean(v < edge + sign * 1e-3 * np.max(v)) for sign in (-1.0, 1.0))
        assert low - 1e-3 <= share <= high + 1e-3
