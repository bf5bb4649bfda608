"""Duty cycle of a gear pair: states of its mesh, films, margins and losses over time, and their shares."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from typing import Any, ClassVar

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.bearing import (
    LEFT_OUT,
    MAYBE,
    SAMPLES_OF_ROW,
    STANDSTILL,
    Design,
    MarginCycle,
    MarginRows,
    PointValues,
    Stretch,
    Written,
    edges_of,
    file_warnings,
    largest_error,
    moves,
    places_to_compare,
    row_probabilities,
    values_of_rows,
    worst_stretches,
)
from ehlectric.cases.duty_inputs import Cycle, read_cycle
from ehlectric.cases.gear_case import GearCase, changed_pair
from ehlectric.cases.measurements import GEAR_CYCLE
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.errors import InputError
from ehlectric.gear.gear_verdict import state_at
from ehlectric.gear.solution import GearSolution
from ehlectric.gear.solving import solve_gear_pairs
from ehlectric.gear.uncertainty import chance_of, has_chance
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.lubrication_states import AT_TIMES, CONDUCTS, INSULATES
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning

# Numbers of the states of a mesh; rows at a standstill and rows without a result have other numbers.
CONDUCTING, CONDUCTING_AT_TIMES, INSULATING = 1, 2, 3
_NUMBERS = {CONDUCTS: CONDUCTING, AT_TIMES: CONDUCTING_AT_TIMES, INSULATES: INSULATING}

# Names of the states by their numbers.
STATES = ("standstill", CONDUCTS, AT_TIMES, INSULATES, "not computed")

# Keys of the inputs that columns of a cycle replace, and columns that follow from others or are not changed.
_KEYS = {name: column.key for name, column in GEAR_CYCLE.columns.items() if column.key}
_TORQUE, _SPEED, _FLANKS, _VOLTAGE = (
    _KEYS[name] for name in ("torque", "speed", "flank_temperature", "voltage")
)
_OIL = _KEYS["temperature"]

# SI unit and meaning of the columns of duty.csv.
COLUMNS: Mapping[str, Mapping[str, str]] = data_file("ehlectric.quantities", "measured_columns.toml")[
    "gear_duty_written"
]

# Quantities of a point: lambda ratio, capacitance [F], integral of -ln(1 - p) with the share p of time with
# metallic contact, dielectric strength [V/m], friction power for a coefficient of 1 and of asperities [W],
# and temperature of the flanks [K].
_NAMES = (
    "lambda_ratio", "capacitance", "exposure", "strength", "sliding_power", "asperity_loss",
    "flank_temperature",
)  # fmt: skip

# Ends of the exposure, between which it has a logarithm.
_LEAST_EXPOSURE, _MOST_EXPOSURE = 1e-300, 36.0


@dataclass(frozen=True, eq=False, repr=False)
class MeshRows(MarginRows):
    """Rows of a duty cycle with what the mesh is at each, SI units; NaN where a row has no value."""

    torque: Array = field(metadata=stored("duty_row", "N*m"))
    flank_temperature: Array = field(metadata=stored("duty_row", "K", MAYBE))
    voltage: Array = field(metadata=stored("duty_row", "V", MAYBE))  # NaN without a voltage
    contact_time_share: Array = field(metadata=stored("duty_row", "", MAYBE))
    # Smallest breakdown voltage: 0 where summits touch, NaN where the mesh conducts.
    breakdown_voltage: Array = field(metadata=stored("duty_row", "V", MAYBE))
    loss: Array = field(metadata=stored("duty_row", "W", MAYBE))
    asperity_loss: Array = field(metadata=stored("duty_row", "W", MAYBE))

    @property
    def touching(self) -> Mask:
        """Rows with touching summits under a voltage, whose mesh does not conduct, shape (n,)."""
        touching: Mask = (self.breakdown_voltage == 0.0) & (self.voltage > 0.0)
        return touching

    @property
    def deciding(self) -> int | None:
        """Row with the minimum lambda ratio of those whose summits touch under a voltage, else with the
        minimum margin, else with the minimum lambda ratio; None without.
        """
        touching = np.where(self.touching, self.lambda_ratio, math.nan)
        for values in (touching, self.margin, self.lambda_ratio):
            if np.any(np.isfinite(values)):
                return int(np.nanargmin(values))
        return None

    def mean(self, values: Array) -> float | None:
        """Mean over the time of all rows with a value; None without one."""
        known = np.isfinite(values)
        return float(np.average(values[known], weights=self.duration[known])) if np.any(known) else None

    def integral(self, values: Array) -> float | None:
        """Integral over the time of all rows with a value; None without one."""
        known = np.isfinite(values)
        return float(values[known] @ self.duration[known]) if np.any(known) else None


@dataclass(frozen=True, eq=False, repr=False)
class MeshDuty(MarginCycle[MeshRows]):
    """Result of the duty cycle of a gear pair; ``MarginCycle`` has its attributes."""

    written: ClassVar[Mapping[str, Mapping[str, str]]] = COLUMNS

    warnings: tuple[ResultWarning, ...] = ()

    @property
    def judges_breakdown(self) -> bool:
        """Whether any row has a breakdown voltage and a voltage between both gears."""
        return bool(np.any(np.isfinite(self.rows.breakdown_voltage) & (self.rows.voltage > 0.0)))

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``duty`` of summary.json, SI units; None for what is not known."""
        rows = self.rows
        shares = {
            "standstill": STANDSTILL,
            "conducting": CONDUCTING,
            "conducting_at_times": CONDUCTING_AT_TIMES,
            "insulating": INSULATING,
            "left_out": LEFT_OUT,
        }
        power = np.abs(rows.torque * rows.speed)
        energy, loss = rows.integral(power), rows.integral(rows.loss)
        return {
            **self.about(),
            **{f"{name}_share": rows.share(rows.state == state) for name, state in shares.items()},
            "contact_time_share": rows.mean(rows.contact_time_share),
            **self.margins(),
            **_extremes("lambda_ratio", rows, rows.lambda_ratio),
            **_extremes("breakdown_voltage", rows, _positive(rows.breakdown_voltage)),
            **_deciding(rows),
            "energy": energy,
            "loss_energy": loss,
            "asperity_loss_energy": rows.integral(rows.asperity_loss),
            "loss_share": None if loss is None or not energy else loss / energy,
            "stretches": [asdict(stretch) for stretch in self.stretches],
        }

    def columns(self) -> dict[str, Written]:
        """Columns of the rows with their units, the state of the mesh as a text; summits that touch have no
        breakdown voltage.
        """
        columns = super().columns()
        if "breakdown_voltage" in columns:
            columns["breakdown_voltage"] = "V", _positive(self.rows.breakdown_voltage)
        return columns | {"mesh_state": (None, mesh_states(self.rows))}


def mesh_states(rows: MeshRows) -> Array:
    """State of the mesh at each row as a text, "standstill" or "not computed", shape (n,)."""
    names: Array = np.array(STATES, dtype=object)[rows.state.astype(int)]
    return names


def _positive(values: Array) -> Array:
    return np.where(values > 0.0, values, np.nan)


def _extremes(name: str, rows: MeshRows, values: Array) -> dict[str, float | None]:
    """Minimum, mean and maximum of a quantity over the time by their keys; None without a value."""
    if not np.any(np.isfinite(values)):
        return dict.fromkeys((f"{name}_low", f"{name}_mean", f"{name}_high"))
    ends = float(np.nanmin(values)), rows.mean(values), float(np.nanmax(values))
    return dict(zip((f"{name}_low", f"{name}_mean", f"{name}_high"), ends, strict=True))


def _deciding(rows: MeshRows) -> dict[str, float | None]:
    """Time and operating point of the row that decides the margin."""
    names = ("time", "torque", "speed", "flank_temperature", "lambda_ratio")
    row = rows.deciding
    if row is None:
        return {f"deciding_{name}": None for name in names}
    return {f"deciding_{name}": float(getattr(rows, name)[row]) for name in names}


def run_mesh_duty(case: GearCase, *, probable: bool = True) -> MeshDuty | None:
    """Result of the duty cycle of a gear file; None without one.

    Films are from the atlas, or from a formula if the case requests it. Each row of the cycle is a stationary
    mesh, and counts for the time from halfway to the row before to halfway to the next. ``probable``, whether
    rows have a probability of breakdown, which takes several seconds. Raises InputError where the file of the
    cycle cannot be used.
    """
    if case.duty is None:
        return None
    cycle = read_cycle(case.duty, GEAR_CYCLE)
    quick = _quick(case)
    given = _given(quick, cycle)
    rows, points = _rows(quick, cycle, given)
    chances = np.full((rows.time.size, 3), np.nan)
    if probable:
        chances = _probabilities(quick, rows, given)
    rows = replace(
        rows,
        breakdown_probability=chances[:, 0],
        breakdown_probability_low=chances[:, 1],
        breakdown_probability_high=chances[:, 2],
    )
    result = MeshDuty(
        rows=rows,
        stretches=tuple(_stretches(quick, rows, given)),
        source=cycle.source,
        contacts=quick.contacts,
        points=points.solved,
        interpolation_error=points.error,
    )
    return replace(result, warnings=tuple(_warnings(quick, cycle, points, result)))


def check_mesh_duty(case: GearCase) -> None:
    """Refuse the duty cycle of a gear file that cannot be used, without its computation."""
    if case.duty is not None:
        read_cycle(case.duty, GEAR_CYCLE)


def _quick(case: GearCase) -> GearCase:
    """Case without its cycle, with films that are not solved."""
    case = case.model_copy(update={"duty": None})
    return case.replace({"contacts": "atlas"}) if case.contacts == "solved" else case


def _given(case: GearCase, cycle: Cycle) -> dict[str, Array]:
    """Inputs of all rows by the names of their columns, SI units, shape (n,); inputs of the case without a
    column. The temperature of the flanks is an input only with a column.
    """
    operation = case.gear.operation
    voltage = case.gear.contact.voltage
    constant = {
        "torque": operation.pinion_torque,
        "speed": operation.pinion_speed,
        "temperature": operation.oil_temperature,
        "voltage": math.nan if voltage is None else voltage,
    }
    given = {name: np.full(cycle.time.size, value) for name, value in constant.items()}
    return given | dict(cycle.values)


def _inputs(case: GearCase, given: Mapping[str, Array]) -> dict[str, Array]:
    """Inputs of the films by dotted key, SI units, shape (n,), from inputs of rows by column.

    No film depends on the gear that drives, nor on the direction of rotation. Flanks of a given temperature
    keep their difference from the oil.
    """
    operation = case.gear.operation
    inputs = {_TORQUE: np.abs(given["torque"]), _SPEED: np.abs(given["speed"])}
    if "flank_temperature" in given:
        return inputs | {_FLANKS: given["flank_temperature"]}
    if isinstance(operation.bulk_temperature, str):
        return inputs | {_OIL: given["temperature"]}
    return inputs | {_FLANKS: operation.bulk_temperature + given["temperature"] - operation.oil_temperature}


def _rows(case: GearCase, cycle: Cycle, given: Mapping[str, Array]) -> tuple[MeshRows, PointValues]:
    """Rows of a cycle without probabilities, and the values of rows that turn, with reasons by row."""
    turning = moves(given["speed"])
    names = ("lambda_ratio", "capacitance", "margin", "breakdown_voltage", "contact_time_share")
    values = {
        name: np.full(cycle.time.size, np.nan)
        for name in (*names, "loss", "asperity_loss", "flank_temperature", "breakdown_probability")
    }
    state = np.where(turning, LEFT_OUT, STANDSTILL)
    points = PointValues({}, {}, 0)
    if np.any(turning):
        points = _at(case, {name: column[turning] for name, column in given.items()})
        for name in values.keys() & points.values.keys():
            values[name][turning] = points.values[name]
        state[turning] = points.values["state"]
    if "flank_temperature" in given:
        values["flank_temperature"] = given["flank_temperature"]
    places = np.flatnonzero(turning).tolist()
    known = {name: given[name] for name in ("torque", "speed", "temperature", "voltage")}
    rows = MeshRows(
        time=cycle.time, duration=np.diff(edges_of(cycle.time)), **known, **values, state=state.astype(float)
    )
    return rows, replace(points, reasons={places[k]: why for k, why in points.reasons.items()})


def _at(case: GearCase, given: Mapping[str, Array]) -> PointValues:
    """Quantities of rows that turn from their inputs by column.

    The breakdown voltage is the dielectric strength times the minimum film above the highest summits, E (h -
    k Rq) [V]. A row has no margin if its voltage is so small that the margin is above ``MOST_MARGIN``.
    """
    inputs, gear = _inputs(case, given), case.gear
    keys = tuple(inputs)
    points = values_of_rows(inputs, partial(_solved, case, keys), partial(_interpolated, case, keys))
    values = dict(points.values)
    ratio, share = values["lambda_ratio"], -np.expm1(-values["exposure"])
    names = [state_at(part, gear.contact.conduction) for part in share.tolist()]
    state = np.where(np.isnan(ratio), LEFT_OUT, [_NUMBERS[name] for name in names])
    film = gear.rq * np.maximum(ratio - gear.summit_height, 0.0)
    breakdown = np.where(state == CONDUCTING, np.nan, values["strength"] * film)
    with np.errstate(divide="ignore", invalid="ignore"):
        margin = breakdown / given["voltage"]
    friction = gear.operation.friction_coefficient
    values |= {
        "state": state,
        "contact_time_share": share,
        "breakdown_voltage": breakdown,
        "margin": np.where((margin > 0.0) & (margin <= MOST_MARGIN), margin, np.nan),
        "loss": (math.nan if friction is None else friction) * values["sliding_power"],
    }
    return replace(points, values=values)


def _solved(case: GearCase, keys: tuple[str, ...], table: Array) -> PointValues:
    """Quantities at the rows of a table with a column for each key, shape (n, keys)."""
    reasons: dict[int, str] = {}
    cases: dict[int, GearCase] = {}
    for place, row in enumerate(table.tolist()):
        try:
            cases[place] = changed_pair(case, dict(zip(keys, row, strict=True)))
        except InputError as error:
            reasons[place] = str(error)
    columns = np.full((len(_NAMES), len(table)), np.nan)
    for place, solution in zip(cases, solve_gear_pairs(cases.values(), unloaded=False), strict=True):
        if isinstance(solution, GearSolution):
            columns[:, place] = _numbers(solution)
        else:
            reasons[place] = str(solution)
    return PointValues(dict(zip(_NAMES, columns, strict=True)), reasons, len(table))


def _numbers(solution: GearSolution) -> tuple[float, ...]:
    """Quantities of a solved mesh in the order of ``_NAMES``; NaN for what it does not have."""
    share = solution.mean_contact_share
    exposure = -math.log1p(-share) if share < 1.0 else math.inf
    values = (
        solution.minimum_film / solution.rq,
        solution.loads.mean(solution.capacitance),
        min(max(exposure, _LEAST_EXPOSURE), _MOST_EXPOSURE),
        solution.strength,
        solution.sliding_power,
        solution.asperity_loss,
        solution.bulk_temperature,
    )
    return tuple(math.nan if value is None else value for value in values)


def _interpolated(case: GearCase, keys: tuple[str, ...], table: Array) -> PointValues:
    """Quantities at the rows of a table between the nodes of a design, and the error at some of the rows.
    Rows without a torque have no result.
    """
    loaded = np.flatnonzero(table[:, keys.index(_TORQUE)] > 0.0)
    part = table[loaded]
    design = Design.of(part, np.array([key in (_TORQUE, _SPEED) for key in keys]))
    nodes = _solved(case, keys, design.nodes)
    between = {name: design.between(column) for name, column in nodes.values.items()}
    compared = places_to_compare(len(part))
    exact = _solved(case, keys, np.concatenate([part[compared], np.delete(table, loaded, axis=0)[:1]]))
    of_loaded = {name: column[: compared.size] for name, column in exact.values.items()}
    error = largest_error(between, of_loaded, compared, ("lambda_ratio", "capacitance"))
    values = {name: np.full(len(table), np.nan) for name in between}
    for name, column in between.items():
        values[name][loaded] = column
    reason = next(iter({**nodes.reasons, **exact.reasons}.values()), "")
    unknown = np.flatnonzero(np.isnan(values["lambda_ratio"])).tolist()
    return PointValues(values, dict.fromkeys(unknown, reason), nodes.solved + exact.solved, error)


def _probabilities(case: GearCase, rows: MeshRows, given: Mapping[str, Array]) -> Array:
    """Probability of breakdown of each row within the uncertain inputs, and its bounds, shape (n, 3).

    Rows are interpolated over lambda ratio, voltage, and share of time with metallic contact.
    """
    driven = rows.turns & (rows.voltage > 0.0)
    known = driven & np.isfinite(rows.lambda_ratio)
    if not np.any(known) or not has_chance(_driven(case, float(rows.voltage[known][0]))):
        return np.full((rows.time.size, 3), np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        exposure = np.clip(-np.log1p(-rows.contact_time_share), _LEAST_SHOWN, _MOST_EXPOSURE)
        at = np.column_stack([np.log(rows.lambda_ratio), np.log(rows.voltage), np.log(exposure)])
    groups = {"mesh": (known, at)}
    return row_probabilities(rows, driven, groups, partial(_chances, case, rows, given))


# Exposure below which a mesh insulates at all times.
_LEAST_SHOWN = 1e-4


def _driven(case: GearCase, voltage: float) -> GearCase:
    """Case with a voltage between both gears."""
    contact = case.gear.contact.model_copy(update={"voltage": voltage})
    return case.model_copy(update={"gear": case.gear.model_copy(update={"contact": contact})})


def _chances(case: GearCase, rows: MeshRows, given: Mapping[str, Array], places: IntArray) -> Array:
    """Probabilities of breakdown of some rows, and their bounds, shape (k, 3); NaN where a row has none."""
    inputs = _inputs(case, {name: column[places] for name, column in given.items()})
    cases = [
        _driven(
            changed_pair(case, {key: float(column[k]) for key, column in inputs.items()}),
            float(rows.voltage[place]),
        )
        for k, place in enumerate(places.tolist())
    ]
    chances = np.full((places.size, 3), np.nan)
    for k, solution in enumerate(solve_gear_pairs(cases)):
        chance = chance_of(solution, SAMPLES_OF_ROW) if isinstance(solution, GearSolution) else None
        if chance is not None:
            chances[k] = chance
    return chances


def _stretches(case: GearCase, rows: MeshRows, given: Mapping[str, Array]) -> Iterator[Stretch]:
    """Worst stretches of a cycle."""
    without = "no breakdown voltage"
    yield from worst_stretches(rows, given, lambda inputs: _at(case, inputs).values, GEAR_CYCLE, without)


def _warnings(case: GearCase, cycle: Cycle, points: PointValues, result: MeshDuty) -> Iterator[ResultWarning]:
    """Warnings about the file of a cycle and about what is not computed of it."""
    yield from file_warnings(cycle, case.lubricant)
    if points.reasons:
        place, reason = next(iter(points.reasons.items()))
        yield ResultWarning.of(
            "duty-left-out", "bearing", rows=len(points.reasons), line=cycle.lines[place], reason=reason
        )
    yield from result.bounds_warnings()
