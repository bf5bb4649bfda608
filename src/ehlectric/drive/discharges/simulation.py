"""Simulation of a drive over time: chunks of the source, random numbers, and the record of what happened."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import compile_for
from ehlectric.drive.discharges.event_loop import (
    ARC,
    RECOVERING,
    Meters,
    State,
    advance,
    empty_means,
    spectrum_of,
    work_of,
)
from ehlectric.drive.discharges.films_and_source import Films, Segments
from ehlectric.drive.drive_record import COLUMNS, FILM, KEPT, OFF, ON, VOLTAGE, Record
from ehlectric.drive.motor_circuit import Modes

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


@dataclass(frozen=True)
class Measuring:
    """Settings of a measurement."""

    # start and duration: time from which on it is measured, and how long [s].
    start: float
    duration: float
    highest: float  # voltage that is about the highest one [V], of which tolerances are parts
    limits: tuple[float, ...]  # limits of the voltage [V]
    trace: float  # time that the trace covers [s]
    # Whether the trace is around a typical one of the first events, where there are any, and not at the
    # begin.
    at_event: bool = False


class _Random:
    """Random numbers of both films, for thresholds and for times, from four streams of one seed."""

    def __init__(self, seed: int) -> None:
        streams = np.random.SeedSequence(seed).spawn(4)
        self.streams = [np.random.Generator(np.random.PCG64(stream)) for stream in streams]

    def fill(self, state: State) -> None:
        """Replace used numbers by new ones; those that are left come first."""
        for b in range(2):
            for stream in range(2):
                used = int(state.used[b, stream])
                left = state.random[b, stream, used:].copy()
                state.random[b, stream, : left.size] = left
                state.random[b, stream, left.size :] = self.streams[2 * b + stream].standard_exponential(used)
                state.used[b, stream] = 0


class _Log:
    """Events of a measured time: counts, sums, and the first of them one by one."""

    def __init__(self, duration: float) -> None:
        self.duration = duration
        self.kept: list[Array] = []
        self.number = 0
        self.counts = np.zeros((2, BLOCKS), dtype=np.int64)
        self.positive = np.zeros(2, dtype=np.int64)
        self.sums, self.largest = np.zeros((2, COLUMNS)), np.zeros((2, COLUMNS))
        self.burning = np.zeros(2)

    def add(self, events: Array, start: float) -> None:
        """Add events that began after a time [s], and all of the time for which arcs burnt after it."""
        lasting = events[:, OFF] - np.maximum(events[:, ON], start)
        self.burning += np.bincount(events[:, FILM].astype(int), np.maximum(lasting, 0.0), minlength=2)
        events = events[events[:, ON] >= start].copy()
        events[:, [ON, OFF]] -= start
        block = np.minimum((events[:, ON] / self.duration * BLOCKS).astype(int), BLOCKS - 1)
        for b in range(2):
            of_film = events[:, FILM] == b
            self.counts[b] += np.bincount(block[of_film], minlength=BLOCKS)
            self.positive[b] += np.count_nonzero(events[of_film, VOLTAGE] > 0.0)
            self.sums[b] += np.sum(np.abs(events[of_film]), axis=0)
            self.largest[b] = np.max(np.abs(events[of_film]), axis=0, initial=0.0).clip(self.largest[b])
        if self.number < KEPT:
            self.kept.append(events[: KEPT - self.number])
            self.number += self.kept[-1].shape[0]

    def end(self, state: State, start: float) -> None:
        """Add the time for which arcs have burnt that still burn at the end."""
        now = float(np.sum(state.time))
        for b in range(2):
            if state.phase[b] in (ARC, RECOVERING):
                self.burning[b] += now - max(float(state.event[b, ON]), start)


def simulate(
    circuits: Modes,
    films: Films,
    chunks: Iterator[Segments],
    measuring: Measuring,
    seed: int,
    progress: Callable[[float], None] = lambda _: None,
    compiling: Callable[[str], None] = lambda _: None,
) -> Record:
    """March through a source, and record what happens.

    A chunk of the source ends where measuring begins. ``progress`` is called with the simulated time [s], and
    ``compiling`` with a text where the march has to be compiled.
    """
    state = _state(circuits.jump.shape[1])
    random = _Random(seed)
    random.fill(state)
    meters, log = _meters(measuring), _Log(measuring.duration)
    work, begun = work_of(state.x.size, _EVENTS), measuring.start == 0.0
    trace: Array | None = None
    for chunk in chunks:
        if not begun and state.time[0] >= measuring.start * (1.0 - _SAME):
            meters, begun = _meters(measuring), True
        state.cursor[:] = 0.0
        seeks = begun and measuring.at_event and trace is None
        before = deepcopy((state, random)) if seeks else None
        compile_for(advance, (circuits, films, chunk, state, meters, work), compiling)
        while state.cursor[0] >= 0.0:
            advance(circuits, films, chunk, state, meters, work)
            random.fill(state)
            if begun:
                log.add(work.events[: work.filled[0]], measuring.start)
        if before is not None and log.number:
            trace = _around(circuits, films, chunk, measuring, before, _typical(log))
        progress(float(state.time[0]))
    log.end(state, measuring.start)
    return _record(measuring, meters, log, trace)


def _typical(log: _Log) -> float:
    """Time of the one of the first events whose voltage is the median of theirs [s]."""
    first = np.vstack(log.kept)[:_FIRST]
    order = np.argsort(np.abs(first[:, VOLTAGE]), kind="stable")
    return float(first[order[first.shape[0] // 2], ON])


def _around(
    circuits: Modes,
    films: Films,
    chunk: Segments,
    measuring: Measuring,
    before: tuple[State, _Random],
    event: float,
) -> Array:
    """Trace around the time of an event [s], by a second march from the start of its chunk."""
    state, random = before
    start = float(state.time[0])
    ends = start + np.cumsum(chunk.duration)
    begin = min(measuring.start + event - 0.5 * measuring.trace, float(ends[-1]) - measuring.trace)
    begin = max(begin, start)
    last = int(np.searchsorted(ends, begin + measuring.trace)) + 1
    meters = _meters(measuring)._replace(until=np.array([begin, begin + measuring.trace]))
    work, part = work_of(state.x.size, _EVENTS), Segments._make(values[:last] for values in chunk)
    while state.cursor[0] >= 0.0:
        advance(circuits, films, part, state, meters, work)
        random.fill(state)
    return _traced(measuring, meters)


def _state(size: int) -> State:
    """State at the start: only the source charges anything."""
    return State(
        x=np.zeros(size),
        ring=np.zeros(1, dtype=complex),
        # The march sets the clocks.
        clocks=np.full((2, 4), math.nan),
        place=np.zeros(2, dtype=np.int64),
        phase=np.zeros(2, dtype=np.int64),
        draw=np.ones(2),
        event=np.zeros((2, COLUMNS)),
        time=np.zeros(2),
        cursor=np.zeros(3),
        random=np.zeros((2, 2, _RANDOM)),
        used=np.full((2, 2), _RANDOM),
    )


def _meters(measuring: Measuring) -> Meters:
    highest, limits = measuring.highest, np.array(measuring.limits)
    shaft = empty_means(measuring.duration)
    return Meters(
        edges=_NARROWEST * np.array([-highest, highest]),
        histogram=np.zeros((2, BINS)),
        limits=limits,
        above=np.zeros((2, limits.size)),
        peak=np.zeros(2),
        shaft=shaft,
        spaced=np.array([measuring.start, measuring.duration / shaft.size]),
        touching=np.zeros(2),
        square=np.zeros(2),
        of_shaft=np.zeros(2),
        ranges=np.array([[math.inf, -math.inf], [math.inf, -math.inf]]),
        trace=np.zeros((TRACE, 4)),
        traced=np.zeros(1, dtype=np.int64),
        until=np.array([measuring.start * (1.0 - _SAME), measuring.start + measuring.trace]),
        rough=np.array([_ROUGH * highest, _SILENT * highest]),
    )


def _traced(measuring: Measuring, meters: Meters) -> Array:
    """Rows of the trace that are filled; times from the start of the measured time."""
    trace: Array = meters.trace[: int(meters.traced[0])].copy()
    trace[:, 0] -= measuring.start
    return trace


def _record(measuring: Measuring, meters: Meters, log: _Log, trace: Array | None) -> Record:
    mean, square = meters.of_shaft / measuring.duration
    (lowest, highest), (source_lowest, source_highest) = meters.ranges.tolist()
    return Record(
        duration=measuring.duration,
        events=np.vstack(log.kept) if log.kept else np.zeros((0, COLUMNS)),
        counts=log.counts,
        positive=log.positive.astype(float),
        sums=log.sums,
        largest=log.largest,
        edges=np.linspace(meters.edges[0], meters.edges[1], BINS + 1),
        histogram=meters.histogram,
        limits=meters.limits,
        above=meters.above,
        peak=meters.peak,
        spectrum=spectrum_of(meters.shaft),
        shaft_mean=float(mean),
        shaft_rms=math.sqrt(square),
        shaft_lowest=lowest,
        shaft_highest=highest,
        source_lowest=source_lowest,
        source_highest=source_highest,
        touching=meters.touching,
        rms=np.sqrt(meters.square / measuring.duration),
        burning=log.burning,
        trace=_traced(measuring, meters) if trace is None else trace,
    )
