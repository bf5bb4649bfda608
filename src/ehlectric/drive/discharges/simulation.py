"""Simulation of a drive over time: chunks of the source, random numbers, and the record of what happened."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.circuit_equations import RATE_ROW
from ehlectric.drive.circuit_states import CircuitStates
from ehlectric.drive.discharges.compiled import compile_for
from ehlectric.drive.discharges.event_loop import (
    ARC,
    ARC_RESISTANCE,
    CHANGE,
    COUNTS,
    DRAW,
    EVENT,
    EXPONENT,
    EXTINCTION,
    FILLED,
    FIRST_MEAN,
    HIGH,
    HIGHEST_VOLTAGE,
    LEFT_EDGE,
    LOWEST_VOLTAGE,
    MEAN_RENEWAL,
    MEAN_TOUCH,
    MISSING,
    NEXT,
    NUMBERS,
    PHASE,
    PLACES,
    PLACES_OF_MARCH,
    POSITION,
    RECOVERING,
    RECOVERS,
    RECOVERY,
    RENEWAL,
    RIGHT_EDGE,
    ROUGH,
    ROW,
    SCALE,
    SEGMENT,
    SILENT,
    SINCE,
    SOURCE_HIGH,
    SOURCE_LOW,
    SPACING,
    SPECTRAL,
    SQUARE,
    STATE,
    STEP,
    SUM,
    SUM_OF_SQUARES,
    THRESHOLDS,
    TIME,
    TIMES,
    TOUCH,
    TOUCHED,
    TRACE_FROM,
    TRACE_TO,
    TRACED,
    USED,
    VOLT_ROWS,
    March,
    advance,
    empty_means,
    spectrum_of,
)
from ehlectric.drive.discharges.films_and_source import Films, Measuring, Segments
from ehlectric.drive.discharges.voltages_in_time import empty_piece, empty_series
from ehlectric.drive.drive_record import COLUMNS, FILM, KEPT, OFF, ON, VOLTAGE, Record
from ehlectric.errors import InputError
from ehlectric.readable import readable

# Events and random numbers that are held at once.
_EVENTS, _RANDOM = 4096, 16384

# Bins of the histograms, rows of the trace, and parts of the highest voltage: within which the voltage is
# straight between two times, and below which the ringing of the source is over.
BINS, TRACE = 400, 20_000
_ROUGH, _SILENT = 5e-4, 1e-4

# Voltage up to which a histogram reaches at first, over the highest one; it widens as voltages ask for.
_NARROWEST = 2.0**-12

# Relative difference of times that count as equal.
_SAME = 1e-9

# First events of which a typical one has the trace.
_FIRST = 5

# Number of blocks of time in which events are counted, from which their scatter follows.
BLOCKS = 40


# Number of discharges, and mean time between two of them [s], from which on a simulation is refused: films
# that insulate again at once discharge again and again while an edge lasts, for hours of computing time.
_TOO_MANY, _TOO_SOON = 100_000, 1e-8

# Arrays of a march that contain its state.
_STATE = ("film", "phases", "random", "x", "ring", "now", "at")


class _Random:
    """Random numbers of all films, for thresholds and for times, from two streams of each film."""

    def __init__(self, seed: int, films: Sequence[int | str]) -> None:
        seeds = (np.random.SeedSequence(seed, spawn_key=key) for film in films for key in _keys(film))
        self.streams = [np.random.Generator(np.random.PCG64(each)) for each in seeds]

    def fill(self, march: March) -> None:
        """Replace used numbers by new ones; those that are left come first."""
        for b in range(march.phases.shape[0]):
            for stream in range(2):
                used = int(march.phases[b, USED + stream])
                left = march.random[b, stream, used:].copy()
                march.random[b, stream, : left.size] = left
                march.random[b, stream, left.size :] = self.streams[2 * b + stream].standard_exponential(used)
                march.phases[b, USED + stream] = 0


def _keys(film: int | str) -> tuple[tuple[int, ...], ...]:
    """Keys of both streams of a film by its number or by its name."""
    if isinstance(film, int):
        return (2 * film,), (2 * film + 1,)
    named = zlib.crc32(film.encode())
    return (named, 0), (named, 1)


class _Log:
    """Events of a measured time: counts, sums, and the first of them one by one."""

    def __init__(self, duration: float, films: int) -> None:
        self.duration = duration
        self.kept: list[Array] = []
        self.number = 0
        self.counts = np.zeros((films, BLOCKS), dtype=np.int64)
        self.positive = np.zeros(films, dtype=np.int64)
        self.sums, self.largest = np.zeros((films, COLUMNS)), np.zeros((films, COLUMNS))
        self.burning = np.zeros(films)

    def add(self, events: Array, start: float) -> None:
        """Add events that began after a time [s], and all of the time for which arcs burnt after it."""
        films = self.burning.size
        lasting = events[:, OFF] - np.maximum(events[:, ON], start)
        self.burning += np.bincount(events[:, FILM].astype(int), np.maximum(lasting, 0.0), minlength=films)
        events = events[events[:, ON] >= start].copy()
        events[:, [ON, OFF]] -= start
        block = np.minimum((events[:, ON] / self.duration * BLOCKS).astype(int), BLOCKS - 1)
        for b in range(films):
            of_film = events[:, FILM] == b
            self.counts[b] += np.bincount(block[of_film], minlength=BLOCKS)
            self.positive[b] += np.count_nonzero(events[of_film, VOLTAGE] > 0.0)
            self.sums[b] += np.sum(np.abs(events[of_film]), axis=0)
            self.largest[b] = np.max(np.abs(events[of_film]), axis=0, initial=0.0).clip(self.largest[b])
        if self.number < KEPT:
            self.kept.append(events[: KEPT - self.number])
            self.number += self.kept[-1].shape[0]

    def end(self, march: March, start: float) -> None:
        """Add the time for which arcs have burnt that still burn at the end."""
        now = float(march.now[TIME])
        for b in range(self.burning.size):
            if march.phases[b, PHASE] in (ARC, RECOVERING):
                self.burning[b] += now - max(float(march.film[b, EVENT + ON]), start)


def simulate(
    circuits: CircuitStates,
    films: Films,
    chunks: Iterator[Segments],
    measuring: Measuring,
    seed: int,
    progress: Callable[[float], None] = lambda _: None,
    compiling: Callable[[str], None] = lambda _: None,
    streams: Sequence[int | str] | None = None,
) -> Record:
    """March through a source, and record what happens.

    A chunk of the source ends where measuring begins. ``progress`` is called with the simulated time [s], and
    ``compiling`` with a text where the march has to be compiled. The random numbers of a film depend on
    ``seed`` and on its entry of ``streams``, by default its number from 0. Raises InputError where discharges
    follow each other too fast.
    """
    random = _Random(seed, range(films.step.size) if streams is None else streams)
    march, begun = _at_rest(circuits, films, random, measuring), measuring.start == 0.0
    log = _Log(measuring.duration, films.step.size)
    trace: Array | None = None
    for chunk in chunks:
        if not begun and march.now[TIME] >= measuring.start * (1.0 - _SAME):
            march, begun = _measured_anew(march, measuring), True
        seeks = begun and measuring.at_event and trace is None
        before = deepcopy(({name: getattr(march, name) for name in _STATE}, random)) if seeks else None
        march = _through(chunk, march, circuits, random, log if begun else None, measuring.start, compiling)
        if before is not None and log.number:
            trace = _around(circuits, chunk, march, measuring, before, _typical(log))
        progress(float(march.now[TIME]))
    log.end(march, measuring.start)
    return _record(measuring, circuits, march, log, trace)


def _through(
    chunk: Segments,
    march: March,
    circuits: CircuitStates,
    random: _Random,
    log: _Log | None,
    start: float,
    compiling: Callable[[str], None] = lambda _: None,
) -> March:
    """March through a chunk of the source, and log the events after a time [s]. Raises InputError where
    discharges follow each other too fast.
    """
    begun, number = float(march.now[TIME]), 0
    march = march._replace(
        segments=np.array([chunk.duration, chunk.level, chunk.slope]), rings=np.ascontiguousarray(chunk.ring)
    )
    march.at[SEGMENT] = 0
    compile_for(advance, (march,), compiling)
    while march.at[SEGMENT] >= 0:
        advance(march)
        if march.at[MISSING] >= 0:
            circuits.make(*march.at[[STATE, MISSING, CHANGE]].tolist())
            march = march._replace(rows=circuits.rows, squares=circuits.squares, links=circuits.links)
            march.at[MISSING] = -1
            continue
        random.fill(march)
        if log is not None:
            log.add(march.events[: march.at[FILLED]], start)
        number += int(march.at[FILLED])
        march.at[FILLED] = 0
        _check_rate(number, float(march.now[TIME] + march.now[SINCE]) - begun)
    return march


def _check_rate(number: int, time: float) -> None:
    """Raise InputError where many discharges took place in a time [s]."""
    if number > _TOO_MANY and time < number * _TOO_SOON:
        raise InputError.worded(
            "breakdown.recovery_time",
            f"films insulate too soon after a discharge: {number} discharges follow each other in "
            f"{readable(1e6 * time, 3)} µs. Enter a longer recovery_time, or an extinction voltage or "
            "current further below the breakdown voltages",
        )


def _typical(log: _Log) -> float:
    """Time of the one of the first events whose voltage is the median of theirs [s]."""
    first = np.vstack(log.kept)[:_FIRST]
    order = np.argsort(np.abs(first[:, VOLTAGE]), kind="stable")
    return float(first[order[first.shape[0] // 2], ON])


def _around(
    circuits: CircuitStates,
    chunk: Segments,
    march: March,
    measuring: Measuring,
    before: tuple[dict[str, Any], _Random],
    event: float,
) -> Array:
    """Trace around the time of an event [s], by a second march from the start of its chunk."""
    march = march._replace(**before[0])
    start = float(march.now[TIME])
    ends = start + np.cumsum(chunk.duration)
    begin = min(measuring.start + event - 0.5 * measuring.trace, float(ends[-1]) - measuring.trace)
    begin = max(begin, start)
    last = int(np.searchsorted(ends, begin + measuring.trace)) + 1
    march = _measured_anew(march, measuring)
    march.now[[TRACE_FROM, TRACE_TO]] = begin, begin + measuring.trace
    part = Segments._make(values[:last] for values in chunk)
    return _traced(measuring, circuits, _through(part, march, circuits, before[1], None, 0.0))


def _at_rest(circuits: CircuitStates, films: Films, random: _Random, measuring: Measuring) -> March:
    """March at the start: only the source charges anything."""
    size, number, voltages = circuits.size, films.step.size, len(circuits.voltages)
    at = np.zeros(PLACES_OF_MARCH, dtype=np.int64)
    at[[NEXT, MISSING, SPECTRAL]] = number, -1, circuits.row_of_shaft[0]
    now = np.zeros(NUMBERS)
    now[[LEFT_EDGE, RIGHT_EDGE]] = _NARROWEST * np.array([-measuring.highest, measuring.highest])
    now[[ROUGH, SILENT]] = _ROUGH * measuring.highest, _SILENT * measuring.highest
    march = March(
        rows=circuits.rows,
        squares=circuits.squares,
        links=circuits.links,
        segments=np.zeros((3, 0)),
        rings=np.zeros(0, dtype=complex),
        film=np.zeros((number, SCALE + films.scale.shape[1])),
        phases=np.zeros((number, COUNTS), dtype=np.int64),
        random=np.zeros((number, 2, _RANDOM)),
        x=np.zeros(size),
        charges=np.zeros(size),
        ring=np.array([0.0, circuits.rows[0, RATE_ROW, -1]]),
        now=now,
        at=at,
        piece=empty_piece(size, voltages),
        series=empty_series(size, voltages),
        volts=np.zeros((VOLT_ROWS, voltages)),
        meter=np.zeros((voltages, 6)),
        histogram=np.zeros((circuits.film_voltages, BINS)),
        limits=np.array(measuring.limits),
        above=np.zeros((circuits.film_voltages, len(measuring.limits))),
        means=np.zeros(0),
        trace=np.zeros((TRACE, 2 + voltages)),
        events=np.zeros((_EVENTS, COLUMNS)),
    )
    _start_films(march, circuits, films, random)
    return _measured_anew(march, measuring)


def _start_films(march: March, circuits: CircuitStates, films: Films, random: _Random) -> None:
    """Write the properties of all films, set their clocks, and draw their first thresholds."""
    film, phases = march.film, march.phases
    columns: dict[int, Array | float] = {
        STEP: films.step,
        MEAN_RENEWAL: films.renewal,
        RECOVERS: films.recovery,
        MEAN_TOUCH: films.touch[:, 0],
        MEAN_TOUCH + 1: films.touch[:, 1],
        ARC_RESISTANCE: films.arc,
        EXTINCTION: films.extinction,
        EXPONENT: 1.0 / films.shape,
        POSITION: films.step,
        RECOVERY: math.inf,
    }
    for column, values in columns.items():
        film[:, column] = values
    film[:, SCALE:] = films.scale
    phases[:, PLACES], phases[:, ROW], phases[:, USED : USED + 2] = (
        films.positions,
        circuits.row_of_film,
        _RANDOM,
    )
    random.fill(march)
    for clock, mean in ((RENEWAL, MEAN_RENEWAL), (TOUCH, MEAN_TOUCH)):
        for b in range(phases.shape[0]):
            film[b, clock] = math.inf
            if math.isfinite(film[b, mean]):
                used = phases[b, USED + TIMES]
                film[b, clock] = film[b, mean] * march.random[b, TIMES, used]
                phases[b, USED + TIMES] = used + 1
    # One by one: powers of whole arrays are rounded otherwise than in the march.
    film[:, DRAW] = [
        float(number) ** float(exponent)
        for number, exponent in zip(march.random[:, THRESHOLDS, 0], film[:, EXPONENT], strict=True)
    ]
    phases[:, USED + THRESHOLDS] = film[:, EXPONENT] > 0.0


def _measured_anew(march: March, measuring: Measuring) -> March:
    """March with meters at zero."""
    means, meter, highest = empty_means(measuring.duration), np.zeros_like(march.meter), measuring.highest
    meter[:, LOWEST_VOLTAGE], meter[:, HIGHEST_VOLTAGE] = math.inf, -math.inf
    now, film = march.now.copy(), march.film.copy()
    now[[LEFT_EDGE, RIGHT_EDGE]] = _NARROWEST * np.array([-highest, highest])
    now[[SOURCE_LOW, SOURCE_HIGH]] = math.inf, -math.inf
    now[[FIRST_MEAN, SPACING]] = measuring.start, measuring.duration / means.size
    now[[TRACE_FROM, TRACE_TO]] = measuring.start * (1.0 - _SAME), measuring.start + measuring.trace
    film[:, TOUCHED] = 0.0
    at = march.at.copy()
    at[TRACED] = 0
    return march._replace(
        now=now,
        at=at,
        film=film,
        meter=meter,
        histogram=np.zeros_like(march.histogram),
        above=np.zeros_like(march.above),
        means=means,
        trace=np.zeros_like(march.trace),
    )


def _traced(measuring: Measuring, circuits: CircuitStates, march: March) -> Array:
    """Rows of the trace that are filled; times from the start of the measured time."""
    rows = march.trace[: int(march.at[TRACED])]
    columns = [*circuits.row_of_film, *circuits.row_of_shaft]
    trace: Array = rows[:, [0, 1, *(2 + row for row in columns)]]
    trace[:, 0] -= measuring.start
    return trace


def _record(
    measuring: Measuring, circuits: CircuitStates, march: March, log: _Log, trace: Array | None
) -> Record:
    films, now = circuits.row_of_film, march.now
    shafts = march.meter[circuits.row_of_shaft]
    shaft = shafts[0]
    return Record(
        duration=measuring.duration,
        events=np.vstack(log.kept) if log.kept else np.zeros((0, COLUMNS)),
        counts=log.counts,
        positive=log.positive.astype(float),
        sums=log.sums,
        largest=log.largest,
        edges=np.linspace(now[LEFT_EDGE], now[RIGHT_EDGE], BINS + 1),
        histogram=march.histogram[films],
        limits=march.limits,
        above=march.above[films],
        peak=march.meter[films, HIGH],
        spectrum=spectrum_of(march.means),
        shaft_mean=float(shaft[SUM] / measuring.duration),
        shaft_rms=math.sqrt(shaft[SUM_OF_SQUARES] / measuring.duration),
        shaft_lowest=float(shaft[LOWEST_VOLTAGE]),
        shaft_highest=float(shaft[HIGHEST_VOLTAGE]),
        source_lowest=float(now[SOURCE_LOW]),
        source_highest=float(now[SOURCE_HIGH]),
        touching=march.film[:, TOUCHED].copy(),
        rms=np.sqrt(march.meter[films, SQUARE] / measuring.duration),
        burning=log.burning,
        trace=_traced(measuring, circuits, march) if trace is None else trace,
        shafts=np.column_stack(
            [
                shafts[:, SUM] / measuring.duration,
                np.sqrt(shafts[:, SUM_OF_SQUARES] / measuring.duration),
                shafts[:, LOWEST_VOLTAGE],
                shafts[:, HIGHEST_VOLTAGE],
            ]
        ),
    )
