"""Discharges of axles in time: numbers of a separate program, and balances."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from ehlectric.drive.discharges.films_and_source import Measuring, Segments
from ehlectric.drive.drive_record import ENERGY, FILM, OFF, ON, VOLTAGE
from ehlectric.drive.films_in_time import NetworkInTime, TimedFilm
from ehlectric.drive.network import HOUSING, WINDING, Film, Network
from ehlectric.errors import InputError
from tests.helpers.drives import arc, element, from_rest, square

NANO = 1e-9
SHAFTS = ("1", "2", "3")
ENDS = {
    "b1": ("1", HOUSING),
    "m12": ("1", "2"),
    "b2": ("2", HOUSING),
    "m23": ("2", "3"),
    "b3": ("3", HOUSING),
}
CAPACITANCES = {"b1": 0.5, "m12": 1.0, "b2": 5.0, "m23": 4.0, "b3": 11.0}
LIMITS = {"b1": 3.0, "m12": 1.8, "b2": 2.0, "m23": 0.74, "b3": 1.0}
PERIOD, RELAXATION, EDGE = 1e-4, 2e-4, 800.0 / 3.0


class Ideal(NetworkInTime):
    """Axle whose discharges take no time, and end at 0 V."""

    def films_in_time(self):
        films = super().films_in_time()
        return films._replace(arc=0.0 * films.arc, extinction=0.0 * films.extinction)


def axle(*, kind=Ideal, shafts=SHAFTS, conducting=(), without=(), scale=1.0, relaxation=RELAXATION,
         breakdown=None, **capacitances):  # fmt: skip
    """Three shafts with capacitances [nF] times a scale, and the time in which films discharge [s]."""
    values = {name: scale * NANO * value for name, value in (CAPACITANCES | capacitances).items()}
    fixed = [
        Film("winding", WINDING, "1", scale * 0.1 * NANO),
        Film("rotor and frame", "1", HOUSING, scale * 1.0 * NANO),
        *(Film(name, *ENDS[name], values[name], conducts=True) for name in conducting),
    ]
    films = [
        TimedFilm(
            name, *ends, element(values[name], breakdown=LIMITS[name], conductance=values[name] / relaxation)
        )
        for name, ends in ENDS.items()
        if name not in (*conducting, *without)
    ]
    return kind(Network(shafts, tuple(fixed)), tuple(films), breakdown or arc())


def axle_network(of):
    """Network with the capacitances of all films."""
    films = (Film(each.name, each.first, each.second, each.film.capacitance[0]) for each in of.films)
    return Network(of.network.shafts, (*of.network.elements, *films))


def steps(count):
    """Periods of the carrier with three steps up and three down, from 0 V on."""
    times = np.array([0.0, 0.10, 0.25, 0.40, 0.60, 0.75, 0.90, 1.0]) * PERIOD
    levels = EDGE * np.array([0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0])
    return Segments(np.tile(np.diff(times), count), np.tile(levels, count), np.zeros(7 * count),
                    np.zeros(7 * count, dtype=complex))  # fmt: skip


def march(of, *, before=10, measured=40, trace=0.0):
    measuring = Measuring(before * PERIOD, measured * PERIOD, 40.0, (1.0,), trace)
    chunks = [steps(count) for count in (before, measured) if count]
    return of.march(iter(chunks), measuring, 0)


def events_of(of, record):
    """Events in a period of the carrier, and their mean energy [nJ], by the names of the films."""
    numbers = np.sum(record.counts, axis=1) / 40.0
    with np.errstate(invalid="ignore"):
        energy = record.sums[:, ENERGY] / np.sum(record.counts, axis=1) / NANO
    names = [each.name for each in of.active]
    return dict(zip(names, numbers, strict=True)), dict(zip(names, energy, strict=True))


def hybrid(of):
    """The same axle with bearings of the rotor that do not break down."""
    none = np.array([np.inf])
    films = (
        replace(each, film=replace(each.film, breakdown=none)) if each.name == "b1" else each
        for each in of.films
    )
    return Ideal(of.network, tuple(films), of.breakdown)


@pytest.mark.parametrize(
    ("of", "expected", "energies"),
    [
        (axle(without=("m12", "m23")), {"b1": 6}, {"b1": 222.2222}),
        (axle(), {"b1": 0, "m12": 10, "b2": 0, "m23": 10, "b3": 4}, {"m12": 68.5959}),
        (hybrid(axle(b1=0.02)), {"b1": 0, "m12": 6, "b2": 0, "m23": 10, "b3": 6}, {"m12": 147.938}),
        (axle(conducting=("m12",)), {"b1": 0, "b2": 0, "m23": 10, "b3": 6}, {"m23": 14.8559}),
    ],
    ids=["without a gearbox", "insulating", "hybrid bearings", "conducting mesh"],
)
def test_discharges_of_a_separate_program(of, expected, energies):
    """Events in a period of the carrier, and mean energies [nJ], in the periods 10 to 49."""
    numbers, energy = events_of(of, march(of))
    assert {name: numbers[name] for name in expected} == expected
    for name, value in energies.items():
        assert energy[name] == pytest.approx(value, rel=5e-6)


def test_the_first_discharge_of_a_separate_program():
    """The first edge leaves 9.5181 V on the first mesh."""
    first = march(axle(), before=0, measured=1).events[0]
    assert [each.name for each in axle().active][int(first[FILM])] == "m12"
    assert first[VOLTAGE] == pytest.approx(9.5181, abs=5e-5)
    assert first[ON] == pytest.approx(0.1 * PERIOD, rel=1e-12)


@pytest.mark.parametrize("kind", [Ideal, NetworkInTime])
def test_the_energy_of_the_source_is_stored_or_discharged(kind):
    """Without leakage, to 1e-9: at each jump from V to W the winding takes a charge at (V + W)/2.

    Between jumps it gives the charge C_w dv of the potential v of the rotor at the voltage of the source.
    """
    of = axle(kind=kind, relaxation=np.inf)
    record = march(of, before=0, measured=3, trace=np.inf)
    capacitances = {each.name: each.film.capacitance[0] for each in of.films}
    winding, frame = 0.1 * NANO, 1.0 * NANO
    share = next(iter(axle_network(of).potentials(1.0).values()))
    given, before, rotor = 0.0, 0.0, 0.0
    for level in np.split(record.trace, 1 + np.flatnonzero(np.diff(record.trace[:, 1]))):
        source, jump = level[0, 1], level[0, 1] - before
        given += 0.5 * (source + before) * winding * jump * (1.0 - share)
        after = level[-1, -3]
        given -= source * winding * (after - rotor - share * jump)
        before, rotor = source, after
    last = record.trace[-1]
    volts = dict(zip((each.name for each in of.active), last[2:7], strict=True))
    stored = sum(0.5 * value * volts[name] ** 2 for name, value in capacitances.items())
    stored += 0.5 * frame * rotor**2 + 0.5 * winding * (before - rotor) ** 2
    assert len(record.events) > 20
    assert given == pytest.approx(stored + np.sum(record.sums[:, ENERGY]), rel=1e-9)


# Links with resistances: a ring, and a coupling between two shafts.
LINKS = (
    Film("ring", "2", HOUSING, 0.0, conductance=2e-4),
    Film("coupling", "2", "3", 0.2 * NANO, conductance=1e-4),
)


class Balance:
    """Energies of an axle while its source is constant, by modes of its capacitances and conductances."""

    def __init__(self, of):
        self.of, self.shafts = of, of.network.shafts
        films = [Film(each.name, each.first, each.second, each.film.capacitance[0],
                      conductance=each.film.conductance) for each in of.active]  # fmt: skip
        self.leaks = [*of.network.elements, *films]
        self.films = films
        self.capacitance = sum(each.capacitance * self.outer(each) for each in self.leaks)

    def across(self, each):
        """Signs of the shafts in the voltage of an element."""
        return np.array([float(shaft == each.first) - (shaft == each.second) for shaft in self.shafts])

    def outer(self, each):
        return np.outer(self.across(each), self.across(each))

    def passed(self, volts, duration, burning):
        """Voltages after a duration, and the energy in all leaks, with arcs in some films."""
        arc = 1.0 / self.of.breakdown.arc_resistance
        conductance = sum(each.conductance * self.outer(each) for each in self.leaks)
        conductance = conductance + sum(arc * self.outer(self.films[number]) for number in burning)
        rates, modes = eigh(conductance, self.capacitance)
        given = modes.T @ self.capacitance @ volts
        both = np.maximum(np.add.outer(rates, rates), 1e-30)
        weights = -np.expm1(-both * duration) / both
        parts = [(self.across(each) @ modes) * given for each in self.leaks]
        lost = sum(each.conductance * part @ weights @ part
                   for each, part in zip(self.leaks, parts, strict=True))  # fmt: skip
        return modes @ (given * np.exp(-rates * duration)), lost

    def stored(self, volts, source):
        return 0.5 * volts @ self.capacitance @ volts + 0.5 * WINDING_CAPACITANCE * (
            (source - volts[0]) ** 2 - volts[0] ** 2
        )


WINDING_CAPACITANCE = 0.1 * NANO


@pytest.mark.parametrize("kind", [Ideal, NetworkInTime])
def test_the_energy_of_the_source_is_stored_leaks_or_is_discharged(kind):
    """To 1e-9, with leaking films, a ring and a coupling with resistances; leaks by modes of another program.

    Between jumps the source gives a charge C_w dv at its voltage, and at a jump at the mean of both voltages.
    """
    plain = axle(kind=kind, relaxation=0.1 * RELAXATION)
    of = kind(Network(SHAFTS, (*plain.network.elements, *LINKS)), plain.films, plain.breakdown)
    record, balance = march(of, before=0, measured=3, trace=np.inf), Balance(of)
    rows = record.trace[:, [0, 1, -3, -2, -1]]
    times = np.append(rows[:, 0], record.duration)
    share = np.linalg.solve(balance.capacitance, [WINDING_CAPACITANCE, 0.0, 0.0])
    given, leaked, end, before = 0.0, 0.0, np.zeros(3), 0.0
    for k, (begin, source, *volts) in enumerate(rows):
        jump = source - before
        given += 0.5 * (source + before) * WINDING_CAPACITANCE * jump * (1.0 - share[0])
        given -= source * WINDING_CAPACITANCE * (volts[0] - end[0] - share[0] * jump)
        middle = 0.5 * (begin + times[k + 1])
        burns = (record.events[:, ON] < middle) & (middle < record.events[:, OFF])
        end, lost = balance.passed(
            np.array(volts), times[k + 1] - begin, record.events[burns, FILM].astype(int)
        )
        given -= source * WINDING_CAPACITANCE * (end[0] - volts[0])
        leaked, before = leaked + lost, source
    discharged = np.sum(record.sums[:, ENERGY])
    assert len(record.events) > 20
    assert leaked > 0.02 * discharged
    assert given == pytest.approx(balance.stored(end, before) + leaked + discharged, rel=1e-9)


def test_half_of_all_capacitances_is_half_of_all_energies():
    whole, half = (march(axle(scale=scale)) for scale in (1.0, 0.5))
    assert np.array_equal(whole.counts, half.counts)
    assert half.events[:, ENERGY] == pytest.approx(0.5 * whole.events[:, ENERGY], rel=1e-9)


def test_the_order_of_the_shafts_changes_nothing():
    plain, other = (march(axle(shafts=shafts)) for shafts in (SHAFTS, ("3", "1", "2")))
    assert other.events == pytest.approx(plain.events, rel=1e-9, abs=1e-20)
    assert other.shafts[[1, 2, 0]] == pytest.approx(plain.shafts, rel=1e-9, abs=1e-12)


def test_a_large_capacitance_is_a_conducting_mesh():
    """Its film never has a voltage at which it breaks down."""
    merged, coupled = axle(conducting=("m12",)), axle(m12=1e9, relaxation=RELAXATION)
    numbers, energy = events_of(merged, march(merged))
    others, energies = events_of(coupled, march(coupled))
    assert others == numbers | {"m12": 0}
    assert energies["m23"] == pytest.approx(energy["m23"], rel=1e-6)
    assert energies["b3"] == pytest.approx(energy["b3"], rel=1e-6)


def test_short_arcs_are_discharges_that_take_no_time():
    """A resistance of 0.1 ohm and an extinction at 1 mV: energies of the first events, to 1e-3."""
    breakdown = arc(arc_resistance=0.1, extinction_voltage=1e-3)
    films = tuple(replace(each, film=replace(each.film)) for each in axle().films)
    only_mesh = tuple(
        each if each.name == "m12" else replace(each, film=replace(each.film, breakdown=np.array([np.inf])))
        for each in films
    )
    network = axle().network
    ideal, short = (
        march(kind(network, only_mesh, breakdown), before=0, measured=5) for kind in (Ideal, NetworkInTime)
    )
    assert short.events[:, ENERGY] == pytest.approx(ideal.events[:, ENERGY], rel=1e-3)
    assert np.all(short.events[:, FILM] == 1)


def small_circuit(draw):
    """One or two shafts whose films may break down just above the voltage at which an arc goes out."""
    extinction = draw(st.floats(1e-3, 1.0))
    resistance = draw(st.sampled_from([1e-2, 1.0, 10.0, 1e3]))
    recovery = draw(st.sampled_from([0.0, 1e-9, 1e-7]))
    ends = [("1", HOUSING), ("1", HOUSING), *([("1", "2"), ("2", HOUSING)] if draw(st.booleans()) else [])]
    exponents, ratios = (
        draw(st.lists(st.floats(low, high), min_size=len(ends), max_size=len(ends)))
        for low, high in ((-12.0, -8.0), (1.001, 30.0))
    )
    films = tuple(
        TimedFilm(
            f"{number}", *of_film,
            element(10.0**exponent, breakdown=ratio * extinction, conductance=10.0**exponent / RELAXATION,
                    shape=draw(st.sampled_from([np.inf, 5.0, 1.0]))),
        )
        for number, (of_film, exponent, ratio) in enumerate(zip(ends, exponents, ratios, strict=True))
    )  # fmt: skip
    fixed = (Film("winding", WINDING, "1", 0.1 * NANO), Film("rotor and frame", "1", HOUSING, 0.5 * NANO))
    shafts = tuple(dict.fromkeys(shaft for of_film in ends for shaft in of_film if shaft != HOUSING))
    breakdown = arc(arc_resistance=resistance, extinction_voltage=extinction, recovery_time=recovery)
    return NetworkInTime(Network(shafts, fixed), films, breakdown)


@pytest.mark.slow
@given(st.data(), st.booleans())
@settings(max_examples=40, deadline=None)
def test_no_cascade_of_discharges_is_endless(data, ramps):
    """Each march ends, or is refused with the input to change; each discharge takes energy from the circuit.

    Recovery at once, and thresholds just above the extinction, give up to 1e5 discharges of one edge.
    """
    of = small_circuit(data.draw)
    source = from_rest(square(300.0, PERIOD, 1e-7, 2), 1e-7) if ramps else steps(2)
    try:
        record = of.march(iter([source]), Measuring(0.0, 2.0 * PERIOD, 40.0, (1.0,), 0.0), 0)
    except InputError as error:
        if error.key != "breakdown.recovery_time":
            raise
        return
    assert np.all(record.events[:, ENERGY] >= 0.0)
    assert np.all(record.events[:, OFF] >= record.events[:, ON])
    assert np.all(np.isfinite(record.shafts))
