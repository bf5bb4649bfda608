"""Duty cycle of a drive: expected discharges and their energy over time, from simulated points of operation.

Some rows of the cycle are simulated, and the rates of discharges of all rows are interpolated between them.
Each simulated row is also compared with the interpolation between rows of other groups: the mean difference
corrects the sums over the cycle, and its scatter is their error.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from functools import partial
from typing import Any

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.bearing import (
    FULL_FILM,
    LEFT_OUT,
    MOST_STRETCHES,
    PARTIAL_FILM,
    STANDSTILL,
    TOUCHING,
    CycleLife,
    CycleRows,
    DutyRows,
    Written,
    between_places,
    check_rows,
    contact_limit,
    duty_csv,
    edges_of,
    file_warnings,
    life_of,
    rows_of,
    stretches_of,
    written_columns,
)
from ehlectric.cases.axle_keys import LOADS
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.duty_inputs import Cycle, read_cycle
from ehlectric.cases.measurements import CYCLE
from ehlectric.drive.drive_record import CONFIDENCE, ENERGY, DriveSolution, event_rate
from ehlectric.drive.quick_estimate import quick_drive
from ehlectric.errors import InputError, within
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.quantities.formats import rpm_text
from ehlectric.quantities.former_keys import with_former_keys
from ehlectric.quantities.inputs import ENDS, key_of_drive
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.results import DRIVE_BOOK
from ehlectric.runtime.display import Values
from ehlectric.runtime.files import Content
from ehlectric.runtime.progress import Progress, silent

# Rows that are simulated, and groups of them that are omitted in turn.
SIMULATED, _GROUPS = 48, 8

# Least and longest time that a row is simulated [s]: whole periods of the fundamental in between.
LEAST_TIME, MOST_TIME = 0.02, 0.5

# Change of temperature that counts as much as films thicker by a factor of e [K]: the oil conducts better.
_WARMER = 25.0

_VOLTAGE = "common_mode_voltage"

# Inputs of a drive in whose place a column of the cycle stands.
_KEYS = {
    name: key_of_drive(column.key)
    for name, column in CYCLE.columns.items()
    if column.key and name != _VOLTAGE
}

# SI unit and meaning of the columns of duty.csv.
COLUMNS: Mapping[str, Mapping[str, str]] = data_file("ehlectric.quantities", "measured_columns.toml")[
    "drive_duty_written"
]

_MAYBE = "not negative or NaN"
_row = partial(stored, "duty_row")
_pair = partial(stored, "duty_row bearing")


@dataclass(frozen=True, eq=False, repr=False)
class DriveDutyRows(CycleRows):
    """Rows of a duty cycle with both films and their discharges, SI units; NaN where a row has no value.

    Numbers of both bearings have the shape (n, 2).
    """

    temperature: Array = field(metadata=_row("K", "positive"))
    common_mode_voltage: Array = field(metadata=_row("V", "not negative"))  # peak of the source
    lambda_ratio: Array = field(metadata=_pair("", _MAYBE))
    state: Array = field(metadata=_pair("", "whole"))  # number of the state in ``STATES``
    # Expected number of discharges in a second [1/s], and their energy in a second [W].
    discharge_rate: Array = field(metadata=_pair("1/s", _MAYBE))
    discharge_power: Array = field(metadata=_pair("W", _MAYBE))

    @property
    def known(self) -> Mask:
        """Rows with a rate of discharges, shape (n,)."""
        return np.isfinite(self.discharge_rate[:, 0])


@dataclass(frozen=True)
class Expected:
    """Expected sum over the cycle at one bearing, with the interval of 95 %."""

    value: float = field(metadata=number())
    low: float = field(metadata=number())
    high: float | None = field(metadata=number())  # None where nothing bounds it


@dataclass(frozen=True)
class DriveStretch:
    """Stretch of a duty cycle in which both bearings together discharge more often than in the mean."""

    start: float = field(metadata=number())  # [s]
    end: float = field(metadata=number())  # [s]
    discharges: float = field(metadata=number())  # expected number, both bearings
    energy: float = field(metadata=number())  # of these discharges [J]
    speed: float = field(metadata=number())  # mean over its time [rad/s]
    lambda_ratio: float = field(metadata=number())  # least of both bearings


@dataclass(frozen=True, eq=False, repr=False)
class DriveDuty(Values):
    """Duty cycle of a drive: rows, and the expected discharges of each bearing over all of them.

    Attributes
    ----------
    rows : DriveDutyRows
        Inputs, films and discharges of each row.
    discharges, energy : tuple of Expected
        Expected number of discharges, and their energy [J], of each bearing.
    stretches : tuple of DriveStretch
        The worst stretches, at most ten, the stretch with the most discharges first.
    source : str
        File of the duty cycle.
    points : int
        Number of simulated rows.
    simulated : float
        Time that was simulated at all of them together [s].
    touching_ratio : float
        Lambda ratio up to which the surfaces of either bearing are called touching.
    warnings : tuple of ResultWarning
        Warnings about the file and about rows that are not computed.
    lives : tuple of CycleLife
        Rating lives of each bearing over the cycle.
    """

    rows: DriveDutyRows
    discharges: tuple[Expected, Expected]
    energy: tuple[Expected, Expected]
    stretches: tuple[DriveStretch, ...]
    source: str = field(metadata=number("text"))
    points: int = field(metadata=number("whole"))
    simulated: float = field(metadata=number())
    touching_ratio: float = field(metadata=number("positive"))
    warnings: tuple[ResultWarning, ...] = ()
    lives: tuple[CycleLife, CycleLife] = (CycleLife(), CycleLife())

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``duty`` of summary.json, SI units; None for what is not known."""
        rows = self.rows
        return {
            "source": self.source,
            "rows": rows.time.size,
            "duration": float(np.sum(rows.duration)),
            "points": self.points,
            "simulated": self.simulated,
            "standstill_share": rows.share(rows.state[:, 0] == STANDSTILL),
            "left_out_share": rows.share(~rows.known),
            "discharges": sum(expected.value for expected in self.discharges),
            "energy": sum(expected.value for expected in self.energy),
            "stretches": [asdict(expected) for expected in self.stretches],
        }

    def end_summary(self, b: int) -> dict[str, Any]:
        """Values of the bearing at one end, as in its table of summary.json, SI units."""
        rows, state = self.rows, self.rows.state[:, b]
        shares = {
            "asperity_contact": TOUCHING,
            "mixed_lubrication": PARTIAL_FILM,
            "full_film": FULL_FILM,
        }
        sums = {"discharges": self.discharges[b], "energy": self.energy[b]}
        values: dict[str, Any] = {
            f"duty_{name}_share": rows.share(state == place) for name, place in shares.items()
        }
        for name, expected in sums.items():
            values |= {
                f"duty_{name}": expected.value,
                f"duty_{name}_low": expected.low,
                f"duty_{name}_high": expected.high,
            }
        values |= {f"duty_{name}": value for name, value in self.lives[b].summary().items()}
        return with_former_keys(values, "end", DRIVE_BOOK)

    def contents(self) -> dict[str, Content]:
        """Content of duty.csv by its name."""
        return duty_csv(self.columns())

    def columns(self) -> dict[str, Written]:
        """Columns of the rows with their units; a column of one bearing begins with its name."""
        columns: dict[str, Array] = {}
        for each in fields(self.rows):
            values = getattr(self.rows, each.name)
            if values.ndim == 1:
                columns[each.name] = values
            else:
                columns |= {f"{end}.{each.name}": values[:, b] for b, end in enumerate(ENDS)}
        return written_columns(columns, COLUMNS)


@dataclass(frozen=True, eq=False)
class _Ready:
    """Drive with estimated contacts, its cycle, and both films at all rows."""

    case: DriveCase
    cycle: Cycle
    peak: float  # largest voltage of the source of the case [V]
    given: Mapping[str, Array]  # inputs of the rows by the names of their columns, SI units, shape (n,)
    ends: tuple[DutyRows, DutyRows]
    reasons: Mapping[int, str]  # why a row has no film, by its place
    lives: tuple[CycleLife, CycleLife]

    @property
    def computed(self) -> Mask:
        """Rows at a standstill or with the films of both bearings, shape (n,)."""
        known: Mask = np.all([end.state != LEFT_OUT for end in self.ends], axis=0)
        return known

    @property
    def runs(self) -> Mask:
        """Rows whose shaft turns, with a voltage and with films that are computed, shape (n,)."""
        turns: Mask = self.ends[0].state != STANDSTILL
        return self.computed & turns & (self.given[_VOLTAGE] > 0.0)


def check_drive_cycle(case: DriveCase) -> None:
    """Refuse the duty cycle of a drive file that cannot be used, without its computation."""
    if case.duty is not None:
        _check(case, read_cycle(case.duty))


def run_drive_cycle(
    case: DriveCase,
    peak: float,
    solve: Callable[[DriveCase], DriveSolution],
    progress: Progress = silent,
) -> DriveDuty | None:
    """Result of the duty cycle of a drive file; None without one.

    Contacts are from the atlas or from formulas. Each row is a stationary point of operation. A row at a
    standstill, or without a voltage, has no discharges. ``peak`` is the largest voltage of the source [V],
    and ``solve`` simulates a drive. Raises InputError where the file of the cycle cannot be used, a bearing
    needs solved contacts, or no row can be simulated.
    """
    if case.duty is None:
        return None
    ready = _ready(case, read_cycle(case.duty), peak)
    simulated = _simulated(ready, solve, progress)
    rows = _rows(ready, simulated.rates)
    return DriveDuty(
        rows=rows,
        discharges=(simulated.sums[0], simulated.sums[1]),
        energy=(simulated.sums[2], simulated.sums[3]),
        stretches=tuple(_stretches(rows)),
        source=ready.cycle.source,
        points=simulated.simulation.done,
        simulated=simulated.simulation.time,
        touching_ratio=max(float(contact_limit(bearing.bearing.summit_height)) for bearing in case.bearings),
        warnings=tuple(_warnings(ready, simulated)),
        lives=ready.lives,
    )


def _ready(case: DriveCase, cycle: Cycle, peak: float) -> _Ready:
    """Drive with estimated contacts at the rows of a cycle."""
    _check(case, cycle)
    quick, refused = quick_drive(case.model_copy(update={"remedies": (), "duty": None}))
    if quick is None:
        raise InputError.worded(
            "duty", f"needs bearings with contacts from the atlas, but {refused} excludes them"
        )
    drive_end, non_drive_end = quick.bearings
    first, reasons_1 = rows_of(drive_end, _of_bearing(cycle))
    second, reasons_2 = first, reasons_1
    if non_drive_end != drive_end:
        second, reasons_2 = rows_of(non_drive_end, _of_bearing(cycle))
    reasons = {**reasons_2.reasons, **reasons_1.reasons}
    constant = np.full(cycle.time.size, peak)
    given = {name: getattr(first, name) for name in _KEYS} | {_VOLTAGE: cycle.values.get(_VOLTAGE, constant)}
    lives = life_of(drive_end, first, reasons_1), life_of(non_drive_end, second, reasons_2)
    return _Ready(quick, cycle, peak, given, (first, second), reasons, lives)


def _check(case: DriveCase, cycle: Cycle) -> None:
    """Refuse a cycle that does not fit the bearings of its drive, or whose loads follow from the rotor."""
    loads = [name for name in LOADS if name in cycle.values]
    if case.rotor is not None and loads:
        text = f"has {' and '.join(loads)}, which follow from the tables rotor and force; remove one of them"
        raise InputError.worded("duty.file", text)
    for end, bearing in zip(ENDS, case.bearings, strict=True):
        with within(end):
            check_rows(bearing, _of_bearing(cycle))


def _of_bearing(cycle: Cycle) -> Cycle:
    """Cycle of a bearing, without the voltage, which belongs to the source of the drive."""
    return replace(cycle, values={key: values for key, values in cycle.values.items() if key != _VOLTAGE})


def _simulated(
    ready: _Ready, solve: Callable[[DriveCase], DriveSolution], progress: Progress
) -> _SimulatedRates:
    """Rates of discharges at all rows, and their sums over the cycle."""
    places, duration = np.flatnonzero(ready.runs), ready.ends[0].duration
    rates = np.where(ready.computed[:, np.newaxis], np.zeros(4), np.nan)
    simulation = _Simulation(ready, solve, progress)
    if not places.size:
        return _SimulatedRates(rates, [Expected(0.0, 0.0, 0.0)] * 4, simulation)
    at, drawn = _features(ready)[places], _drawn(duration[places], ready.case.drive.seed)
    drawn_rates = simulation.at(places[drawn])
    rates[places] = between_places(at[drawn], drawn_rates, at)
    known = np.isfinite(rates[places, 0])
    if not np.any(known):
        raise InputError.worded("duty", f"no row can be simulated: {next(iter(simulation.reasons.values()))}")
    usable = known[drawn] & np.isfinite(drawn_rates[:, 0])
    weights = duration[places[known]]
    means, off = _compared(at[known], weights / np.sum(weights), at[drawn[usable]], drawn_rates[usable])
    sums = _sums(means, off, float(np.sum(weights)), simulation)
    if not (np.all(known) and np.all(ready.computed)):
        # Nothing bounds the discharges in rows that are not known.
        sums = [replace(expected, high=None) for expected in sums]
    return _SimulatedRates(rates, sums, simulation)


def _drawn(duration: Array, seed: int) -> IntArray:
    """Places of rows at equal steps of time from a random begin, so that each has a chance by its duration
    [s].
    """
    part = (np.arange(SIMULATED) + np.random.default_rng(seed).random()) / SIMULATED
    ends = np.cumsum(duration)
    places: IntArray = np.minimum(np.searchsorted(ends, part * ends[-1]), duration.size - 1)
    return places


def _compared(at: Array, weights: Array, nodes: Array, values: Array) -> tuple[Array, Array]:
    """Mean over all rows of values interpolated without one group of nodes, mean of all groups, shape (4,);
    and differences of each node from the interpolation without its group, shape (m, 4).
    """
    group = np.arange(len(nodes)) % min(_GROUPS, len(nodes))
    means, off = [], np.empty_like(values)
    for k in range(min(_GROUPS, len(nodes))):
        outside, in_group = group != k, group == k
        if not np.any(outside):
            outside = in_group
        interpolated = between_places(nodes[outside], values[outside], np.concatenate([at, nodes[in_group]]))
        means.append(weights @ interpolated[: len(at)])
        off[in_group] = values[in_group] - interpolated[len(at) :]
    return np.mean(means, axis=0), off


@dataclass
class _Simulation:
    """Simulations of rows, each with its own random numbers."""

    ready: _Ready
    solve: Callable[[DriveCase], DriveSolution]
    progress: Progress
    done: int = 0  # number of simulated rows
    reasons: dict[int, str] = field(default_factory=dict)  # why a row has no result, by its place
    time: float = 0.0  # simulated time [s]
    counts: Array = field(default_factory=lambda: np.zeros(2))  # discharges of each bearing

    def at(self, places: IntArray) -> Array:
        """Discharges per second of both bearings, and their powers [W], at rows; NaN where one has none,
        shape (rows, 4).
        """
        rates = np.full((places.size, 4), np.nan)
        for k, place in enumerate(places.tolist()):
            self.progress(round(100.0 * k / places.size), 100, "simulating the duty cycle")
            try:
                record = self.solve(_at_row(self.ready, place, self.ready.case.drive.seed + k)).record
            except InputError as error:
                self.reasons[place] = str(error)
                continue
            counts = np.sum(record.counts, axis=1)
            self.done, self.time, self.counts = (
                self.done + 1,
                self.time + record.duration,
                self.counts + counts,
            )
            rates[k] = np.concatenate([counts, record.sums[:, ENERGY]]) / record.duration
        return rates


@dataclass(frozen=True, eq=False)
class _SimulatedRates:
    """Rates of discharges of both bearings and their powers at all rows, and what is behind them."""

    rates: Array  # [1/s] and [W], shape (n, 4)
    sums: list[Expected]  # discharges of both bearings, and their energies [J]
    simulation: _Simulation


def _at_row(ready: _Ready, place: int, seed: int) -> DriveCase:
    """Drive at a row of its cycle, with a time of whole periods of the fundamental."""
    given = {name: float(values[place]) for name, values in ready.given.items()}
    changes: dict[str, Any] = {key: given[name] for name, key in _KEYS.items() if name in ready.cycle.values}
    changes |= {"drive.seed": seed, _KEYS["speed"]: abs(given["speed"])}
    factor, source = given[_VOLTAGE] / ready.peak, ready.case.source
    if factor != 1.0:
        key = "scale" if source.measured else "dc_link"
        changes[f"source.{key}"] = factor * getattr(source, key)
    case = ready.case.replace(changes)
    frequency = case.running_source.fundamental_frequency
    if frequency is None:
        return case
    return case.replace({"drive.duration": min(math.ceil(LEAST_TIME * frequency) / frequency, MOST_TIME)})


def _features(ready: _Ready) -> Array:
    """Places of all rows, between which the rates of discharges are interpolated, shape (n, 7).

    These are logarithms of the lambda ratio, to which breakdown voltages are about proportional, and of the
    capacitance of both bearings, of the voltage of the source, and of the root of the speed; and the
    temperature, with which the oil conducts.
    """
    films = [
        np.log(getattr(values, name)) for values in ready.ends for name in ("lambda_ratio", "capacitance")
    ]
    given = {name: np.where(ready.runs, values, 1.0) for name, values in ready.given.items()}
    others = [np.log(given[_VOLTAGE]), 0.5 * np.log(np.abs(given["speed"])), given["temperature"] / _WARMER]
    return np.column_stack([*(math.sqrt(0.5) * values for values in films), *others])


def _sums(means: Array, off: Array, time: float, simulation: _Simulation) -> list[Expected]:
    """Sums over a time [s] from means of interpolated values, and differences of simulated values from
    interpolated ones, shape (m, 4): discharges of both bearings, and their energies.

    If none was seen, the bound of a Poisson process limits their number, and nothing their energy.
    """
    count = len(off)
    mean = means + np.mean(off, axis=0)
    half = np.full(4, np.inf)
    if count > 1:
        student = float(scipy.special.stdtrit(count - 1, 0.5 * (1.0 + CONFIDENCE)))
        half = student * np.std(off, axis=0, ddof=1) / math.sqrt(count)
    most = mean + half
    seen = np.tile(simulation.counts > 0.0, 2)
    unseen = event_rate(np.zeros(1), simulation.time).high
    most = np.where(seen, most, [unseen, unseen, np.inf, np.inf])
    return [
        Expected(time * max(value, 0.0), time * max(value - error, 0.0), time * top if top < np.inf else None)
        for value, error, top in zip(mean.tolist(), half.tolist(), most.tolist(), strict=True)
    ]


def _rows(ready: _Ready, rates: Array) -> DriveDutyRows:
    """Rows of the cycle with both films and their rates."""
    first, given = ready.ends[0], ready.given
    return DriveDutyRows(
        time=first.time,
        duration=first.duration,
        speed=given["speed"],
        temperature=given["temperature"],
        common_mode_voltage=given[_VOLTAGE],
        lambda_ratio=np.column_stack([end.lambda_ratio for end in ready.ends]),
        state=np.column_stack([end.state for end in ready.ends]),
        discharge_rate=rates[:, :2],
        discharge_power=rates[:, 2:],
    )


def _stretches(rows: DriveDutyRows) -> Iterator[DriveStretch]:
    """Worst stretches of a cycle, in which both bearings discharge more often than in its mean."""
    rate = np.nan_to_num(np.sum(rows.discharge_rate, axis=1))
    power = np.nan_to_num(np.sum(rows.discharge_power, axis=1))
    often = rate > np.average(rate, weights=rows.duration)
    edges = edges_of(rows.time)
    stretches = []
    for first, after in stretches_of(often):
        part, time = slice(first, after), rows.duration[first:after]
        stretches.append(
            DriveStretch(
                start=float(edges[first]),
                end=float(edges[after]),
                discharges=float(rate[part] @ time),
                energy=float(power[part] @ time),
                speed=float(np.average(rows.speed[part], weights=time)),
                lambda_ratio=float(np.min(rows.lambda_ratio[part])),
            )
        )
    yield from sorted(stretches, key=lambda stretch: -stretch.discharges)[:MOST_STRETCHES]


def _warnings(ready: _Ready, simulated: _SimulatedRates) -> Iterator[ResultWarning]:
    """Warnings about the file of a cycle and about what is not computed of it."""
    yield from file_warnings(ready.cycle, ready.case.bearings[0].lubricant)
    yield from dict.fromkeys(warning for life in ready.lives for warning in life.warnings())
    yield from _of_ring(ready)
    left_out = np.flatnonzero(~np.isfinite(simulated.rates[:, 0]))
    if left_out.size:
        reasons = {**ready.reasons, **simulated.simulation.reasons}
        place, reason = next(iter(reasons.items()))
        line = ready.cycle.lines[place]
        yield ResultWarning.of("duty-left-out", "drive", rows=left_out.size, line=line, reason=reason)


def _of_ring(ready: _Ready) -> Iterator[ResultWarning]:
    """Note of speeds beyond the table of the grounding ring."""
    table = ready.case.circuit.grounding_ring_table
    if table is None or not np.any(ready.runs):
        return
    beyond = np.array([not table.covers(speed) for speed in ready.given["speed"].tolist()])
    time = ready.ends[0].duration * ready.runs
    if share := float(np.sum(time[beyond]) / np.sum(time)):
        first, last = (rpm_text(table.speed[place]) for place in (0, -1))
        yield ResultWarning.of("ring-table-exceeded", "duty", first=first, last=last, percent=100.0 * share)
