"""Duty cycle of a bearing: states of lubrication and margins over time, their shares, and the worst times."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.bearing.bearing_discharges import voltage_ratio
from ehlectric.bearing.cycle_life import CycleLife, cycle_life, minimum_static_safety
from ehlectric.bearing.cycle_rows import (
    FULL_FILM,
    LEFT_OUT,
    MOST_STRETCHES,
    PARTIAL_FILM,
    STANDSTILL,
    TOUCHING,
    CycleRows,
    Written,
    duty_csv,
    edges_of,
    stretches_of,
    written_columns,
)
from ehlectric.bearing.duty_points import NAMES, PointValues, between_places, spread_places, values_at
from ehlectric.bearing.many_points import solved_parts
from ehlectric.bearing.many_uncertainties import spreads_of
from ehlectric.bearing.quick_contacts import required_quick_case
from ehlectric.bearing.solution import contact_limit, touches
from ehlectric.bearing.uncertainty import SEED, MarginSpread
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Motor
from ehlectric.cases.case_oil import viscosity_over_temperature
from ehlectric.cases.defaults import QUICK
from ehlectric.cases.duty_inputs import Cycle, read_cycle
from ehlectric.cases.measurements import CYCLE, void_rows
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.errors import InputError
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.quantities.formats import scale_of, speed_text
from ehlectric.quantities.lubrication_states import FREQUENT, FULL_FILM_LIMIT
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.statement import Statement
from ehlectric.quantities.units import RPM
from ehlectric.readable import ratio_text, readable
from ehlectric.runtime.display import Values
from ehlectric.runtime.files import Content

# Speed below which a shaft stands still: sensors and their filters read such speeds at rest [rad/s].
LEAST_SPEED = 0.1 * RPM

# Rows with a margin, and as many with touching surfaces, at which the probability of breakdown is computed,
# and points of the uncertain inputs at each of them, a power of 2.
_NODES, SAMPLES_OF_ROW = 32, 128

# Least and largest probability of a row without a result.
_NOT_KNOWN = (0.0, 1.0)

# Units in which inputs are written, by their SI units.
_SHOWN = {"K": "°C", "N": "N", "V": "V"}

_INPUTS = tuple(name for name in CYCLE.columns if name != "time")
_VOLTAGE = "common_mode_voltage"

# SI unit and meaning of the columns of duty.csv.
COLUMNS: Mapping[str, Mapping[str, str]] = data_file("ehlectric.quantities", "measured_columns.toml")[
    "duty_written"
]

_MAYBE = "not negative or NaN"

# Difference of bounds of a probability that is none.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class DutyRows(CycleRows):
    """Rows of a duty cycle with what the bearing is at each, SI units; NaN where a row has no value."""

    radial_load: Array = field(metadata=stored("duty_row", "N", "not negative"))
    axial_load: Array = field(metadata=stored("duty_row", "N", "not negative"))
    temperature: Array = field(metadata=stored("duty_row", "K", "positive"))
    common_mode_voltage: Array = field(metadata=stored("duty_row", "V", _MAYBE))  # NaN without a motor
    lambda_ratio: Array = field(metadata=stored("duty_row", "", _MAYBE))
    capacitance: Array = field(metadata=stored("duty_row", "F", _MAYBE))
    first_break: Array = field(metadata=stored("duty_row", "V", _MAYBE))
    shaft_voltage: Array = field(metadata=stored("duty_row", "V", _MAYBE))
    margin: Array = field(metadata=stored("duty_row", "", _MAYBE))
    # Probability of breakdown within the uncertain inputs, from 0 to 1: of a margin below 1, or surfaces that
    # touch. It is 0 without a voltage, and NaN at a standstill and where it is not known.
    breakdown_probability: Array = field(metadata=stored("duty_row", "", _MAYBE))
    state: Array = field(metadata=stored("duty_row", "", "whole"))  # number of the state in ``STATES``
    # Smallest and largest probability that rows and points without a result allow; NaN at a standstill. None
    # of a result of an earlier version.
    breakdown_probability_low: Array | None = field(
        default=None, metadata=stored("duty_row", "", _MAYBE, needed=False)
    )
    breakdown_probability_high: Array | None = field(
        default=None, metadata=stored("duty_row", "", _MAYBE, needed=False)
    )

    @property
    def has_margin(self) -> bool:
        """Whether any row has a margin."""
        return bool(np.any(np.isfinite(self.margin)))

    @property
    def turns(self) -> Mask:
        """Rows at which the shaft turns, shape (n,)."""
        turns: Mask = self.state != STANDSTILL
        return turns

    @property
    def breaks(self) -> Mask:
        """Rows at which breakdown is expected under a voltage: a margin below 1, or touching surfaces."""
        touching = (self.state == TOUCHING) & (self.common_mode_voltage > 0.0)
        breaks: Mask = (self.margin < 1.0) | touching
        return breaks

    @property
    def probabilities(self) -> tuple[Array, Array, Array]:
        """Probability of breakdown of each row, and its bounds, NaN at a standstill; shape (n,)."""
        middle, low, high = (
            self.breakdown_probability,
            self.breakdown_probability_low,
            self.breakdown_probability_high,
        )
        return middle, middle if low is None else low, middle if high is None else high


@dataclass(frozen=True)
class Stretch:
    """Stretch of a duty cycle with a margin below 1, or without margins with a lambda ratio below 3."""

    start: float = field(metadata=number())  # [s]
    end: float = field(metadata=number())  # [s]
    time: float = field(metadata=number())  # of the least margin, or of the least lambda ratio [s]
    least_margin: float | None = field(metadata=number())
    lambda_ratio: float = field(metadata=number())  # at this time
    speed: float = field(metadata=number())  # at this time [rad/s]
    why: str = field(metadata=number("text"))  # input that causes it, or that no single input does


@dataclass(frozen=True, eq=False, repr=False)
class DutyResult(Values):
    """Result of a duty cycle.

    Attributes
    ----------
    rows : DutyRows
        Inputs, lambda ratio, margin and state of each row.
    stretches : tuple of Stretch
        The worst stretches, at most ten, the worst first.
    source : str
        File of the duty cycle.
    contacts : str
        "atlas" or "formula": how the films of the cycle were computed.
    points : int
        Number of operating points that were solved.
    interpolation_error : float or None
        Largest relative error of lambda ratio and margin by interpolation; None where every point was solved.
    touching_ratio : float
        Lambda ratio up to which surfaces are called touching, as no voltage is computed for them.
    lives : tuple of CycleLife
        Rating lives over the cycle, one object.
    warnings : tuple of ResultWarning
        Warnings about the file and about rows that are not computed.
    """

    rows: DutyRows
    stretches: tuple[Stretch, ...]
    source: str = field(metadata=number("text"))
    contacts: str = field(metadata=number(QUICK))
    points: int = field(metadata=number("whole"))
    interpolation_error: float | None = field(metadata=number())
    touching_ratio: float = field(metadata=number("positive"))
    warnings: tuple[ResultWarning, ...] = ()
    lives: tuple[CycleLife, ...] = (CycleLife(),)

    @property
    def low(self) -> Mask:
        """Rows with a margin below 1, shape (n,)."""
        return self.rows.margin < 1.0

    @property
    def breakdown_probability(self) -> float | None:
        """Probability of breakdown at a random time of the cycle; None where no row has one.

        A standstill does not count as breakdown, and a row that is not known does not count at all.
        """
        return self._means(whole=True)[0]

    @property
    def turning_breakdown_probability(self) -> float | None:
        """Probability of breakdown at a random time at which the shaft turns; None where no row has one."""
        return self._means(whole=False)[0]

    def _means(self, *, whole: bool) -> tuple[float | None, float | None, float | None]:
        """Probability of breakdown and its bounds, means over the whole cycle or the time in which the shaft
        turns; None where no row has one.
        """
        rows = self.rows
        if not np.any(np.isfinite(rows.breakdown_probability)):
            return None, None, None
        still = 0.0 if whole else math.nan
        means = []
        for values in rows.probabilities:
            counted = np.where(rows.turns, values, still)
            known = np.isfinite(counted)
            means.append(float(np.average(counted[known], weights=rows.duration[known])))
        return means[0], means[1], means[2]

    @property
    def statement(self) -> Statement | None:
        """Statement on the cycle: probability of breakdown, share of time with breakdown; None without."""
        probability, low, high = self._means(whole=True)
        if probability is None or low is None or high is None:
            return None
        share = self.rows.share(self.rows.breaks)
        return Statement.of("cycle", probability=(probability, low, high), share=share)

    def _probabilities(self) -> dict[str, float | None]:
        """Probabilities of breakdown with their bounds by their keys."""
        ends = ("", "_low", "_high")
        return {
            f"{name}{end}": value
            for name, whole in (("turning_breakdown_probability", False), ("breakdown_probability", True))
            for end, value in zip(ends, self._means(whole=whole), strict=True)
        }

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``duty`` of summary.json, SI units; None for what is not known."""
        rows = self.rows
        worst = int(np.nanargmin(rows.margin)) if rows.has_margin else None
        return {
            "source": self.source,
            "rows": rows.time.size,
            "duration": float(np.sum(rows.duration)),
            "contacts": self.contacts,
            "points": self.points,
            "interpolation_error": self.interpolation_error,
            "standstill_share": rows.share(rows.state == STANDSTILL),
            "asperity_contact_share": rows.share(rows.state == TOUCHING),
            "mixed_lubrication_share": rows.share(rows.state == PARTIAL_FILM),
            "full_film_share": rows.share(rows.state == FULL_FILM),
            "left_out_share": rows.share(rows.state == LEFT_OUT),
            "breakdown_share": None if self.breakdown_probability is None else rows.share(rows.breaks),
            "low_margin_share": rows.share(self.low) if rows.has_margin else None,
            **self._probabilities(),
            "least_margin": None if worst is None else float(rows.margin[worst]),
            "least_margin_time": None if worst is None else float(rows.time[worst]),
            **self.lives[0].summary(),
            "stretches": [asdict(stretch) for stretch in self.stretches],
        }

    def contents(self) -> dict[str, Content]:
        """Content of duty.csv by its name."""
        return duty_csv(self.columns())

    def columns(self) -> dict[str, Written]:
        """Columns of the rows with their units, without columns in which no row has a value."""
        columns = {each.name: getattr(self.rows, each.name) for each in fields(self.rows)}
        # The state of a row ends its line.
        columns["state"] = columns.pop("state")
        given = {name: values for name, values in columns.items() if values is not None}
        known = {name: values for name, values in given.items() if np.any(np.isfinite(values))}
        return written_columns(known, COLUMNS)


def run_duty(case: BearingCase) -> DutyResult | None:
    """Result of the duty cycle of a bearing file; None without one.

    Contacts are from the atlas, or from formulas if the case requests them. Each row of the cycle is a
    stationary bearing, and stands for the time from halfway to the row before to halfway to the next. Raises
    InputError where the file of the cycle cannot be used, or the bearing has no estimated contacts.
    """
    if case.duty is None:
        return None
    cycle = read_cycle(case.duty.file)
    quick, refused = required_quick_case(case)
    _check_cycle(quick, cycle)
    rows, points = rows_of(quick, cycle)
    probability, low, high = _probabilities(quick, rows).T
    rows = replace(
        rows,
        breakdown_probability=probability,
        breakdown_probability_low=low,
        breakdown_probability_high=high,
    )
    life = life_of(quick, rows, points)
    result = DutyResult(
        rows=rows,
        stretches=tuple(_stretches(quick, rows)),
        source=cycle.source,
        contacts=quick.contacts,
        points=points.solved,
        interpolation_error=points.error,
        touching_ratio=float(contact_limit(quick.bearing.summit_height)),
        lives=(life,),
    )
    warnings = _warnings(quick, cycle, points, refused, result)
    return replace(result, warnings=(*warnings, *life.warnings()))


def life_of(case: BearingCase, rows: DutyRows, points: PointValues) -> CycleLife:
    """Rating lives of a bearing over the rows of its cycle, from the values of the rows that move, and its
    minimum static safety over all rows.
    """
    moves = rows.state != STANDSTILL
    names = ("speed", "radial_load", "axial_load", "duration")
    given = {name: getattr(rows, name)[moves] for name in names}
    lives = cycle_life(case, given, points.values, float(np.sum(rows.duration)))
    return replace(lives, static_safety=minimum_static_safety(case, rows.radial_load, rows.axial_load))


def check_duty(case: BearingCase) -> None:
    """Refuse the duty cycle of a bearing file that cannot be used, without its computation."""
    if case.duty is not None:
        _check_cycle(case, read_cycle(case.duty.file))


def _check_cycle(case: BearingCase, cycle: Cycle) -> None:
    """Refuse a cycle that does not fit its bearing. Raises InputError for a voltage without a motor, and for
    a speed without a load.
    """
    if _VOLTAGE in cycle.values and case.motor is None:
        text = "has a common-mode voltage, and the bearing file has no [motor]"
        raise InputError(cycle.source, text, takes="[motor], with the capacitances of the motor")
    check_rows(case, cycle)


def check_rows(case: BearingCase, cycle: Cycle) -> None:
    """Refuse a cycle with a speed without a load. Raises InputError with its line."""
    given = _given(case, cycle)
    idle = (given["radial_load"] == 0.0) & (given["axial_load"] == 0.0) & _moves(given["speed"])
    if np.any(idle):
        line = cycle.lines[int(np.argmax(idle))]
        raise InputError(cycle.source, f"line {line}: got a speed without a load", takes="a load above 0")


def _moves(speed: Array) -> Mask:
    return np.abs(speed) >= LEAST_SPEED


def _given(case: BearingCase, cycle: Cycle) -> dict[str, Array]:
    """Inputs of all rows by the names of their columns, SI units, shape (n,); inputs of the case without a
    column.
    """
    bearing, motor = case.bearing, case.motor
    constant = {
        "speed": bearing.inner_speed,
        "radial_load": bearing.radial_load,
        "axial_load": bearing.axial_load,
        "temperature": bearing.oil_temperature,
        _VOLTAGE: math.nan if motor is None else motor.common_mode_voltage,
    }
    return {name: cycle.values.get(name, np.full(cycle.time.size, constant[name])) for name in _INPUTS}


def rows_of(case: BearingCase, cycle: Cycle) -> tuple[DutyRows, PointValues]:
    """Return the rows of a cycle for a bearing with estimated contacts, and the values of rows without
    standstill, with reasons by row.
    """
    given, time = _given(case, cycle), cycle.time
    moves = _moves(given["speed"])
    moving = {name: values[moves] for name, values in given.items()}
    points = _at(case, moving) if np.any(moves) else None
    values = {name: np.full(time.size, np.nan) for name in (*NAMES, "breakdown_probability")}
    if points is not None:
        for name in NAMES:
            values[name][moves] = points.values[name]
    ratio, height = values["lambda_ratio"], case.bearing.summit_height
    state = np.select(
        [~moves, np.isnan(ratio), touches(ratio, height), ratio < FULL_FILM_LIMIT],
        [STANDSTILL, LEFT_OUT, TOUCHING, PARTIAL_FILM],
        FULL_FILM,
    )
    edges = edges_of(time)
    rows = DutyRows(time=time, duration=np.diff(edges), **given, **values, state=state)
    if points is None:
        return rows, PointValues({}, {}, 0)
    places = np.flatnonzero(moves).tolist()
    return rows, replace(points, reasons={places[k]: why for k, why in points.reasons.items()})


def _at(case: BearingCase, given: Mapping[str, Array]) -> PointValues:
    """Quantities of rows from their inputs by column. Shaft voltage and margin follow the voltage of the
    motor, on which films do not depend. A row has no margin if its voltage is so small that the margin is
    above ``MOST_MARGIN``, as with an inverter that is off.
    """
    points = values_at(case, _inputs_of_films(case, given))
    if case.motor is None:
        return points
    factor = given[_VOLTAGE] / case.motor.common_mode_voltage
    values = dict(points.values)
    values["shaft_voltage"] = values["shaft_voltage"] * factor
    on = values["margin"] <= MOST_MARGIN * factor
    values["margin"] = np.where(on, values["margin"] / np.where(on, factor, 1.0), np.nan)
    return replace(points, values=values)


def _inputs_of_films(case: BearingCase, given: Mapping[str, Array]) -> dict[str, Array]:
    """Inputs of the films by dotted key, SI units, from inputs of rows by column."""
    bearing = case.bearing
    inputs = {CYCLE.columns["speed"].key: np.abs(given["speed"])}
    for name in ("radial_load", "axial_load"):
        if np.any(given[name] != getattr(bearing, name)):
            inputs[CYCLE.columns[name].key] = given[name]
    warmer = given["temperature"] - bearing.oil_temperature
    if np.any(warmer):
        # Rings and other parts that have their own temperature keep their difference from the oil.
        inputs |= {
            f"bearing.{key}": temperature + warmer for key, temperature in bearing.all_temperatures().items()
        }
    return inputs


def _probabilities(case: BearingCase, rows: DutyRows) -> Array:
    """Probability of breakdown of each row within the uncertain inputs, and its bounds, shape (n, 3).

    They are computed at rows that are spread over margin and lambda ratio, and interpolated between them.
    Rows with touching surfaces have no margin: the lambda ratio divided by the shaft voltage replaces it.
    """
    probability = np.full((rows.time.size, 3), np.nan)
    if case.motor is None:
        return probability
    voltage = rows.common_mode_voltage
    driven = rows.turns & (voltage > 0.0)
    touching = driven & (rows.state == TOUCHING)
    in_place = np.divide(
        rows.lambda_ratio, _shaft_voltages(case.motor, rows), out=np.ones(rows.time.size), where=touching
    )
    for within, margin in ((driven & (rows.margin > 0.0), rows.margin), (touching, in_place)):
        known = np.flatnonzero(within)
        if known.size:
            at = np.log(np.column_stack([margin[known], rows.lambda_ratio[known]]))
            probability[known] = _between_nodes(case, rows, known, at)
    if np.any(np.isfinite(probability)):
        probability[rows.turns & (voltage == 0.0)] = 0.0
        probability[np.ix_(driven & np.isnan(probability[:, 0]), [1, 2])] = _NOT_KNOWN
    return probability


def _shaft_voltages(motor: Motor, rows: DutyRows) -> Array:
    """Shaft voltages that the rows would have if their surfaces did not conduct, shape (n,) [V]."""
    capacitance = rows.capacitance
    second = motor.second_bearing_capacitance
    ratio = voltage_ratio(
        motor.winding_rotor_capacitance,
        motor.rotor_frame_capacitance,
        capacitance,
        capacitance if second is None else second,
    )
    return np.asarray(ratio * rows.common_mode_voltage)


def _between_nodes(case: BearingCase, rows: DutyRows, known: IntArray, at: Array) -> Array:
    """Probabilities of the rows at k places, shape (k, 3), interpolated between some of them over the
    coordinates ``at``, shape (k, d).
    """
    nodes = spread_places(at, _NODES)
    places = known[nodes]
    given = {name: getattr(rows, name)[places] for name in _INPUTS}
    inputs = _inputs_of_films(case, given) | {CYCLE.columns[_VOLTAGE].key: given[_VOLTAGE]}
    chances = np.full((places.size, 3), np.nan)
    for part in solved_parts(case.with_arrays(inputs)):
        for place, spread in zip(part.points, spreads_of(part.solution, SAMPLES_OF_ROW, SEED), strict=True):
            if isinstance(spread, MarginSpread):
                chances[place] = spread.probability, *spread.bounds
    return between_places(at[nodes], chances, at)


def _stretches(case: BearingCase, rows: DutyRows) -> Iterator[Stretch]:
    """Worst stretches of a cycle, with the least margins, or without margins with the least lambda ratios."""
    name, limit = ("margin", 1.0) if rows.has_margin else ("lambda_ratio", FULL_FILM_LIMIT)
    measure, edges = getattr(rows, name), edges_of(rows.time)
    spans = [
        (first, after, first + int(np.argmin(measure[first:after])))
        for first, after in stretches_of(measure < limit)
    ]
    spans = sorted(spans, key=lambda span: measure[span[2]])[:MOST_STRETCHES]
    reasons = _reasons(case, rows, name, [worst for *_, worst in spans])
    for (first, after, worst), why in zip(spans, reasons, strict=True):
        yield Stretch(
            start=float(edges[first]),
            end=float(edges[after]),
            time=float(rows.time[worst]),
            least_margin=float(rows.margin[worst]) if rows.has_margin else None,
            lambda_ratio=float(rows.lambda_ratio[worst]),
            speed=float(rows.speed[worst]),
            why=why,
        )


def _reasons(case: BearingCase, rows: DutyRows, name: str, places: list[int]) -> list[str]:
    """Input that makes a margin or a lambda ratio low at each of some rows: the one whose mean over the cycle
    would raise it most.
    """
    moves = _moves(rows.speed)
    inputs = {column: getattr(rows, column) for column in _INPUTS}
    means = {
        column: float(np.average(np.abs(values[moves]), weights=rows.duration[moves]))
        for column, values in inputs.items()
        if places and np.ptp(values[moves]) > 0.0
    }
    if not means:
        return [""] * len(places)
    changed = {column: np.repeat(values[places], len(means)) for column, values in inputs.items()}
    for k, (column, mean) in enumerate(means.items()):
        changed[column][k :: len(means)] = mean
    values = _at(case, changed).values
    results, ratios = (values[key].reshape(len(places), len(means)) for key in (name, "lambda_ratio"))
    texts = []
    for place, row, ratio in zip(places, results, ratios, strict=True):
        best = int(np.argmax(np.nan_to_num(row, nan=-1.0)))
        column = list(means)[best]
        raised = _raised(float(row[best]), touching=bool(np.isfinite(ratio[best])))
        texts.append(_reason(column, abs(float(inputs[column][place])), means[column], raised))
    return texts


def _raised(value: float, *, touching: bool) -> str:
    """Text of a margin or a lambda ratio, or why there is none: asperity contact is
    frequent, or the bearing has no result.

    >>> _raised(1.7, touching=False), _raised(math.nan, touching=True), _raised(math.nan, touching=False)
    ('1.70', 'frequent asperity contact', 'no result')
    """
    if math.isfinite(value):
        return ratio_text(value)
    return FREQUENT.name if touching else "no result"


def _reason(column: str, value: float, mean: float, raised: str) -> str:
    """Text: input of a row, and the margin or the lambda ratio that it would have with the mean of the input.

    >>> _reason("speed", 50.0 * RPM, 3000.0 * RPM, "1.70")
    'speed 50 rpm; 1.70 at the mean of 3000 rpm'
    """
    name = column.replace("_", " ").replace("common mode", "common-mode")
    return f"{name} {_text(column, value)}; {raised} at the mean of {_text(column, mean)}"


def _text(column: str, value: float) -> str:
    """Input of a column with its unit."""
    unit = CYCLE.columns[column].unit
    if unit == "rad/s":
        return speed_text(value)
    scale = scale_of(_SHOWN[unit])
    return f"{readable(scale.of(value), 4)} {scale.unit}"


def file_warnings(cycle: Cycle, case: BearingCase) -> Iterator[ResultWarning]:
    """Warnings about columns and rows of the file of a cycle that are not used."""
    yield from void_rows(cycle.read)
    if cycle.ignored:
        yield ResultWarning.of("columns-ignored", file=cycle.source, columns=", ".join(cycle.ignored))
    if "temperature" in cycle.values and viscosity_over_temperature(case.lubricant) is None:
        yield ResultWarning.of("temperature-unused", "duty", file=cycle.source)


def _warnings(
    case: BearingCase, cycle: Cycle, points: PointValues, refused: InputError | None, result: DutyResult
) -> Iterator[ResultWarning]:
    """Warnings about the file of a cycle and about what is not computed of it."""
    yield from file_warnings(cycle, case)
    if refused is not None:
        yield ResultWarning.of("duty-without-margin", reason=refused)
    if points.reasons:
        place, reason = next(iter(points.reasons.items()))
        yield ResultWarning.of(
            "duty-left-out", "bearing", rows=len(points.reasons), line=cycle.lines[place], reason=reason
        )
    known = result.summary()
    low, high = (known[f"breakdown_probability_{end}"] for end in ("low", "high"))
    if low is not None and high - low > _ROUNDING:
        yield ResultWarning.of("probability-bounded", "duty", low=100.0 * low, high=100.0 * high)
