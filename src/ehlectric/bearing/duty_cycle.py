"""Duty cycle of a bearing: states of lubrication and margins over time, their shares, and the worst times."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from typing import Any, ClassVar

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.bearing.bearing_discharges import voltage_ratio
from ehlectric.bearing.cycle_life import CycleLife, cycle_life, minimum_static_safety
from ehlectric.bearing.cycle_rows import (
    FULL_FILM,
    LEFT_OUT,
    PARTIAL_FILM,
    STANDSTILL,
    TOUCHING,
    edges_of,
)
from ehlectric.bearing.duty_points import NAMES, PointValues, values_at
from ehlectric.bearing.many_points import solved_parts
from ehlectric.bearing.many_uncertainties import spreads_of
from ehlectric.bearing.margin_cycle import (
    MAYBE,
    SAMPLES_OF_ROW,
    MarginCycle,
    MarginRows,
    Stretch,
    moves,
    row_probabilities,
    worst_stretches,
)
from ehlectric.bearing.quick_contacts import required_quick_case
from ehlectric.bearing.solution import contact_limit, touches
from ehlectric.bearing.uncertainty import SEED, MarginSpread
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Motor
from ehlectric.cases.case_oil import Lubricant, viscosity_over_temperature
from ehlectric.cases.duty_inputs import Cycle, read_cycle
from ehlectric.cases.measurements import CYCLE, void_rows
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.errors import InputError
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.quantities.lubrication_states import FULL_FILM_LIMIT
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning

_INPUTS = tuple(name for name, column in CYCLE.columns.items() if column.key)
_VOLTAGE = "common_mode_voltage"

# SI unit and meaning of the columns of duty.csv.
COLUMNS: Mapping[str, Mapping[str, str]] = data_file("ehlectric.quantities", "measured_columns.toml")[
    "duty_written"
]


@dataclass(frozen=True, eq=False, repr=False)
class DutyRows(MarginRows):
    """Rows of a duty cycle with what the bearing is at each, SI units; NaN where a row has no value."""

    radial_load: Array = field(metadata=stored("duty_row", "N", "not negative"))
    axial_load: Array = field(metadata=stored("duty_row", "N", "not negative"))
    common_mode_voltage: Array = field(metadata=stored("duty_row", "V", MAYBE))  # NaN without a motor
    first_break: Array = field(metadata=stored("duty_row", "V", MAYBE))
    shaft_voltage: Array = field(metadata=stored("duty_row", "V", MAYBE))

    @property
    def touching(self) -> Mask:
        """Rows with touching surfaces under a voltage, shape (n,)."""
        touching: Mask = (self.state == TOUCHING) & (self.common_mode_voltage > 0.0)
        return touching


@dataclass(frozen=True, eq=False, repr=False)
class DutyResult(MarginCycle[DutyRows]):
    """Result of a duty cycle; ``MarginCycle`` has its other attributes.

    Attributes
    ----------
    touching_ratio : float
        Lambda ratio up to which surfaces are called touching, as no voltage is computed for them.
    lives : tuple of CycleLife
        Rating lives over the cycle, one object.
    """

    written: ClassVar[Mapping[str, Mapping[str, str]]] = COLUMNS

    touching_ratio: float = field(metadata=number("positive"))
    warnings: tuple[ResultWarning, ...] = ()
    lives: tuple[CycleLife, ...] = (CycleLife(),)

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``duty`` of summary.json, SI units; None for what is not known."""
        rows = self.rows
        return {
            **self.about(),
            "standstill_share": rows.share(rows.state == STANDSTILL),
            "asperity_contact_share": rows.share(rows.state == TOUCHING),
            "mixed_lubrication_share": rows.share(rows.state == PARTIAL_FILM),
            "full_film_share": rows.share(rows.state == FULL_FILM),
            "left_out_share": rows.share(rows.state == LEFT_OUT),
            **self.margins(),
            **self.lives[0].summary(),
            "stretches": [asdict(stretch) for stretch in self.stretches],
        }


def run_duty(case: BearingCase) -> DutyResult | None:
    """Result of the duty cycle of a bearing file; None without one.

    Contacts are from the atlas, or from formulas if the case requests them. Each row of the cycle is a
    stationary bearing, and stands for the time from halfway to the row before to halfway to the next. Raises
    InputError where the file of the cycle cannot be used, or the bearing has no estimated contacts.
    """
    if case.duty is None:
        return None
    cycle = read_cycle(case.duty)
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
    names = ("speed", "radial_load", "axial_load", "duration")
    given = {name: getattr(rows, name)[rows.turns] for name in names}
    lives = cycle_life(case, given, points.values, float(np.sum(rows.duration)))
    return replace(lives, static_safety=minimum_static_safety(case, rows.radial_load, rows.axial_load))


def check_duty(case: BearingCase) -> None:
    """Refuse the duty cycle of a bearing file that cannot be used, without its computation."""
    if case.duty is not None:
        _check_cycle(case, read_cycle(case.duty))


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
    idle = (given["radial_load"] == 0.0) & (given["axial_load"] == 0.0) & moves(given["speed"])
    if np.any(idle):
        line = cycle.lines[int(np.argmax(idle))]
        raise InputError(cycle.source, f"line {line}: got a speed without a load", takes="a load above 0")


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
    turning = moves(given["speed"])
    moving = {name: values[turning] for name, values in given.items()}
    points = _at(case, moving) if np.any(turning) else None
    values = {name: np.full(time.size, np.nan) for name in (*NAMES, "breakdown_probability")}
    if points is not None:
        for name in NAMES:
            values[name][turning] = points.values[name]
    ratio, height = values["lambda_ratio"], case.bearing.summit_height
    state = np.select(
        [~turning, np.isnan(ratio), touches(ratio, height), ratio < FULL_FILM_LIMIT],
        [STANDSTILL, LEFT_OUT, TOUCHING, PARTIAL_FILM],
        FULL_FILM,
    )
    edges = edges_of(time)
    rows = DutyRows(time=time, duration=np.diff(edges), **given, **values, state=state)
    if points is None:
        return rows, PointValues({}, {}, 0)
    places = np.flatnonzero(turning).tolist()
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

    Rows are interpolated over margin and lambda ratio. Rows with touching surfaces have no margin: the lambda
    ratio divided by the shaft voltage replaces it.
    """
    if case.motor is None:
        return np.full((rows.time.size, 3), np.nan)
    driven = rows.turns & (rows.common_mode_voltage > 0.0)
    touching = driven & (rows.state == TOUCHING)
    in_place = np.divide(
        rows.lambda_ratio, _shaft_voltages(case.motor, rows), out=np.ones(rows.time.size), where=touching
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        groups = {
            name: (within, np.log(np.column_stack([margin, rows.lambda_ratio])))
            for name, within, margin in (
                ("margin", driven & (rows.margin > 0.0), rows.margin),
                ("touching", touching, in_place),
            )
        }
    return row_probabilities(rows, driven, groups, partial(_chances, case, rows))


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


def _chances(case: BearingCase, rows: DutyRows, places: IntArray) -> Array:
    """Probabilities of breakdown of some rows, and their bounds, shape (k, 3); NaN where a row has none."""
    given = {name: getattr(rows, name)[places] for name in _INPUTS}
    inputs = _inputs_of_films(case, given) | {CYCLE.columns[_VOLTAGE].key: given[_VOLTAGE]}
    chances = np.full((places.size, 3), np.nan)
    for part in solved_parts(case.with_arrays(inputs)):
        for place, spread in zip(part.points, spreads_of(part.solution, SAMPLES_OF_ROW, SEED), strict=True):
            if isinstance(spread, MarginSpread):
                chances[place] = spread.probability, *spread.bounds
    return chances


def _stretches(case: BearingCase, rows: DutyRows) -> Iterator[Stretch]:
    """Worst stretches of a cycle."""
    inputs = {column: getattr(rows, column) for column in _INPUTS}
    return worst_stretches(rows, inputs, lambda given: _at(case, given).values, CYCLE)


def file_warnings(cycle: Cycle, lubricant: Lubricant) -> Iterator[ResultWarning]:
    """Warnings about columns and rows of the file of a cycle that are not used."""
    yield from void_rows(cycle.read)
    if cycle.ignored:
        yield ResultWarning.of("columns-ignored", file=cycle.source, columns=", ".join(cycle.ignored))
    if "temperature" in cycle.values and viscosity_over_temperature(lubricant) is None:
        yield ResultWarning.of("temperature-unused", "duty", file=cycle.source)


def _warnings(
    case: BearingCase, cycle: Cycle, points: PointValues, refused: InputError | None, result: DutyResult
) -> Iterator[ResultWarning]:
    """Warnings about the file of a cycle and about what is not computed of it."""
    yield from file_warnings(cycle, case.lubricant)
    if refused is not None:
        yield ResultWarning.of("duty-without-margin", reason=refused)
    if points.reasons:
        place, reason = next(iter(points.reasons.items()))
        yield ResultWarning.of(
            "duty-left-out", "bearing", rows=len(points.reasons), line=cycle.lines[place], reason=reason
        )
    yield from result.bounds_warnings()
