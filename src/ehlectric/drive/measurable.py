"""Quantities of a drive that a user can measure, and the model that computes them at many inputs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import (
    FILMS,
    MARGIN,
    MOTOR,
    OF_TABLE,
    SHAFT_CAPACITANCE,
    BearingModel,
    Change,
    Names,
    at_point,
    between_places,
    spread_places,
    voltage_ratio,
)
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.input_keys import input_of
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.drive.drive_cycle import LEAST_TIME, SIMULATED
from ehlectric.drive.preparation import prepare
from ehlectric.drive.quick_estimate import expected, quick_drive
from ehlectric.drive.solver import solve
from ehlectric.drive.summary import checked_summary
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import BOTH, ENDS, REPLACED, key_of_drive
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.verdict import Verdict

# Quantities of the bearing at the drive end, and quantities of the circuit.
_OF_BEARING = (
    "capacitance",
    "first_breakdown_voltage",
    "breakdown_voltage",
    "conducting_share",
    "inner_ring_temperature",
    "outer_ring_temperature",
    "film",
)
_OF_CIRCUIT = ("shaft_voltage", "bearing_voltage_ratio")

# Key of the peak of the source at an operating point.
_PEAK = "motor.common_mode_voltage"

# Inputs of the circuit that are uncertain.
_CAPACITANCES = ("winding_rotor_capacitance", "rotor_frame_capacitance")

# Quantities of the drive over time, which are simulated: rms of the shaft voltage [V], and discharges of both
# bearings [1/s].
_SIMULATED = ("shaft_voltage_rms", "discharge_rate")

# Quantities of the bearings that the circuit needs.
_BOTH_BEARINGS = (SHAFT_CAPACITANCE, "breakdown_voltage")


@dataclass(frozen=True)
class _Input:
    """Uncertain input of a drive."""

    name: Names
    ends: tuple[float, float]
    places: Mapping[int, int]  # column of the model of a bearing, by the number of the bearing
    change: Change | None  # of an input of a bearing; None of the circuit and the films


@dataclass(frozen=True)
class DriveModel:
    """Drive before its simulation, at many values of its uncertain inputs: both bearings, and the capacitive
    divider of the machine.
    """

    case: DriveCase
    quick: DriveCase  # drive with estimated contacts
    bearings: tuple[BearingModel, BearingModel]
    inputs: tuple[_Input, ...]
    peak: float  # largest voltage of the source [V]
    divided: bool  # whether the capacitances divide the voltage: no grounding ring and no inductance
    _nodes: list[_Nodes] = field(default_factory=list, repr=False)  # simulated drives, when there are any

    @classmethod
    def of(cls, case: DriveCase) -> DriveModel:
        """Model of a drive file. Raises InputError where its contacts must be solved."""
        # Loads are uncertain inputs, which the calibrated file contains.
        case = case.with_given_loads
        quick, refused = quick_drive(case.model_copy(update={"remedies": (), "duty": None, "measured": None}))
        if quick is None:
            raise InputError.worded("measured", f"needs contacts from the atlas, but {refused} excludes them")
        first, second = quick.bearings
        models = BearingModel.of(first), BearingModel.of(second)
        circuit = quick.running_circuit
        led = (
            circuit.grounding_ring_resistance,
            circuit.common_mode_inductance,
            circuit.ground_inductance,
        )
        inputs = (*_of_bearings(quick, models), *_of_circuit(quick))
        divided = all(value is None for value in led)
        return cls(case, quick, models, inputs, prepare(quick).source.highest, divided)

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the measurable quantities."""
        return (*_OF_BEARING, *(_OF_CIRCUIT if self.divided else ()), *_SIMULATED)

    @property
    def candidates(self) -> tuple[str, ...]:
        """Quantities that can be compared as the next to measure: simulated ones only if drives are."""
        return tuple(name for name in self.quantities if name not in _SIMULATED or self._nodes)

    def names(self) -> tuple[Names, ...]:
        """Names of the uncertain inputs, in the order of the columns."""
        return tuple(entry.name for entry in self.inputs)

    def values(self, place: int, parts: Array) -> Array:
        """Values of an input at parts of its range, SI units, shape (n,)."""
        low, high = self.inputs[place].ends
        return low + (high - low) * parts

    def numbers(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Measurable quantities of the bearing at the drive end and the circuit, or the smaller margin of
        both bearings, at p operating points and n values for the k inputs.

        ``at``, inputs from 0 to 1, shape (n, k); ``points``, inputs of the operating points by key, SI units.
        Returns quantities in SI units, shape (n, p), NaN without a result.
        """
        peaks = np.array([point.get(_PEAK, self.peak) for point in points])
        places = [{key: value for key, value in point.items() if key != _PEAK} for point in points]
        circuit = {MARGIN, *_OF_CIRCUIT, *_SIMULATED} & set(quantities)
        of_first = tuple(dict.fromkeys((*quantities, *(_BOTH_BEARINGS if circuit else ()))))
        of_first = tuple(name for name in of_first if name not in (MARGIN, *_OF_CIRCUIT, *_SIMULATED))
        ends = [self.bearings[0].numbers(self._columns(0, at), places, of_first)]
        numbers = dict(ends[0])
        if circuit:
            ends.append(self.bearings[1].numbers(self._columns(1, at), places, _BOTH_BEARINGS))
            numbers |= self._circuit(at, ends, peaks)
        if circuit & set(_SIMULATED):
            features = _features(ends, numbers["shaft_voltage"], divided=self.divided)
            if not self._nodes:
                self._nodes.append(self._simulated(at, points, features))
            numbers |= self._nodes[0].at(features, numbers["shaft_voltage"])
        return {name: numbers[name] for name in quantities}

    def _columns(self, number: int, at: Array) -> Array:
        """Columns of the model of a bearing, shape (n, width)."""
        columns = {
            entry.places[number]: at[:, place]
            for place, entry in enumerate(self.inputs)
            if number in entry.places
        }
        return np.stack([columns[place] for place in sorted(columns)], axis=-1)

    def _circuit(self, at: Array, ends: Sequence[Mapping[str, Array]], peaks: Array) -> dict[str, Array]:
        """Voltages by the capacitive divider, and the margin, shape (n, p)."""
        known = {f"circuit.{key}": value for key, value in self.case.circuit.capacitances.items()}
        columns = {key: known[f"circuit.{key}"] for key in _CAPACITANCES}
        values: dict[str, Any] = dict(columns)
        for place, entry in enumerate(self.inputs):
            name = entry.name.key.partition(".")[2]
            if entry.name.key.startswith("circuit."):
                values[name] = self.values(place, at[:, place])[:, np.newaxis]
        first, second = (end[SHAFT_CAPACITANCE] for end in ends)
        winding, frame = (values[key] for key in _CAPACITANCES)
        ratio = voltage_ratio(winding, frame, first, second)
        # A voltage of 0 marks surfaces that touch, which short the shaft.
        breakdown = np.minimum(*(end["breakdown_voltage"] for end in ends))
        ratio = np.where(breakdown == 0.0, 0.0, ratio)
        shaft = ratio * peaks
        margin = np.where(breakdown == 0.0, 0.0, breakdown / np.where(shaft > 0.0, shaft, 1.0))
        if not self.divided:
            margin = np.full_like(margin, np.nan)
        return {"bearing_voltage_ratio": ratio, "shaft_voltage": shaft, MARGIN: margin}

    def errors(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Standard deviations of quantities due to the interpolation between simulated drives, SI units,
        shape (n, p), with the arguments of ``numbers``.
        """
        errors = dict.fromkeys(quantities, np.zeros((len(at), len(points))))
        if self._nodes and set(quantities) & set(_SIMULATED):
            features, shaft = self._features(at, points)
            errors |= self._nodes[0].errors(features, shaft)
        return {name: errors[name] for name in quantities}

    def _simulated(self, at: Array, points: Sequence[Mapping[str, float]], features: Array) -> _Nodes:
        """Simulated drives at some of the inputs and points, whose films have their computed thickness."""
        shape = features.shape
        places = spread_places(features.reshape(-1, shape[-1]), SIMULATED)
        sample, point = np.divmod(places, shape[1])
        films = [
            place
            for place, entry in enumerate(self.inputs)
            if entry.change is None and not entry.name.key.startswith("circuit.")
        ]
        nodes = at[sample].copy()
        for place in films:
            low, high = self.inputs[place].ends
            nodes[:, place] = (1.0 - low) / (high - low)
        values, rows = np.full((places.size, len(_SIMULATED)), np.nan), []
        for k, (row, number) in enumerate(zip(nodes, point.tolist(), strict=True)):
            of_row, of_shaft = self._features(row[np.newaxis], [points[number]])
            shaft = float(of_shaft[0, 0])
            rows.append(of_row[0, 0])
            with suppress(InputError):
                record = solve(self._drive_at(row, points[number], k)).record
                # Surfaces that touch short the shaft.
                part = record.shaft_rms / shaft if shaft > 0.0 else 0.0
                values[k] = part, np.sum(record.counts) / record.duration
        return _Nodes.of(np.array(rows), values)

    def _features(self, at: Array, points: Sequence[Mapping[str, float]]) -> tuple[Array, Array]:
        """Features of drives, shape (n, p, d), and their shaft voltages without discharges [V], shape
        (n, p).
        """
        places = [{key: value for key, value in point.items() if key != _PEAK} for point in points]
        ends = [
            model.numbers(self._columns(number, at), places, _BOTH_BEARINGS)
            for number, model in enumerate(self.bearings)
        ]
        peaks = np.array([point.get(_PEAK, self.peak) for point in points])
        shaft = self._circuit(at, ends, peaks)["shaft_voltage"]
        return _features(ends, shaft, divided=self.divided), shaft

    def _drive_at(self, row: Array, point: Mapping[str, float], seed: int) -> DriveCase:
        """Drive at inputs from 0 to 1, shape (k,), and at an operating point, simulated for a short time."""
        values = {
            entry.name.key: float(self.values(place, row[place : place + 1])[0])
            for place, entry in enumerate(self.inputs)
        }
        changes = self._changes(values)
        for key, given in point.items():
            if key == _PEAK:
                name = "scale" if self.quick.source.measured else "dc_link"
                changes[f"source.{name}"] = given / self.peak * getattr(self.quick.source, name)
                continue
            above = key_of_drive(key)
            written = [name for name in changes if name == above or name.endswith(f".{key}")]
            nominal = float(value_at(self.quick.bearings[0].to_dict(), key))
            changes |= {name: at_point(key, given, changes[name], nominal) for name in written} or {
                above: given
            }
        case = self.quick.replace({**changes, "drive.seed": self.quick.drive.seed + seed})
        frequency = case.running_source.fundamental_frequency
        duration = LEAST_TIME if frequency is None else math.ceil(LEAST_TIME * frequency) / frequency
        return case.replace({"drive.duration": duration})

    def updated(self, values: Mapping[str, float], ranges: Mapping[str, tuple[float, float]]) -> DriveCase:
        """Case with other values of some inputs, by the keys of the columns, and other ranges in the files of
        both bearings.
        """
        changes = self._changes(values)
        kept: dict[str, dict[str, Any]] = {end: {} for end in ENDS}
        for entry in self.inputs:
            if entry.name.key in values and entry.change is not None and entry.change.key != OF_TABLE:
                for number in entry.places:
                    kept[ENDS[number]][entry.change.key] = [*ranges[entry.name.key]]
        for end in ENDS:
            old = {span.key: [span.low, span.high] for span in getattr(self.case, end).ranges or ()}
            if old or kept[end]:
                changes[f"{end}.ranges"] = old | kept[end]
        return self.case.model_copy(update={"measured": None}).replace(changes)

    def _changes(self, values: Mapping[str, float]) -> dict[str, Any]:
        """Changes of the drive that give some inputs other values, by the keys of the columns."""
        changes: dict[str, Any] = {}
        for entry in self.inputs:
            key = entry.name.key
            if key not in values:
                continue
            if entry.change is None:
                changes |= {key: values[key]} if key.startswith("circuit.") else {}
                continue
            prefix = BOTH if len(entry.places) == len(ENDS) else ENDS[next(iter(entry.places))]
            if entry.change.key == OF_TABLE:
                strengths = value_at(self.case.bearings[next(iter(entry.places))].to_dict(), OF_TABLE)
                changes[f"{prefix}.{OF_TABLE}"] = [values[key] * strength for strength in strengths]
                continue
            for name, value in entry.change.changes(values[key]).items():
                changes[f"{prefix}.{name}"] = value
                if name in self.case.replaced:
                    changes[REPLACED[name]] = value
        return changes

    def verdict(self, case: DriveCase, chance: Chance | None) -> Verdict:
        """Verdict by the capacitive divider of a drive that is not simulated, with the probability of
        breakdown.
        """
        quick, _ = quick_drive(case)
        assert quick is not None
        verdict = expected(quick, checked_summary(prepare(quick)))
        stated = () if chance is None else chance.statements()
        return replace(verdict, reasons=(*verdict.reasons, *stated))


def _features(ends: Sequence[Mapping[str, Array]], shaft: Array, *, divided: bool) -> Array:
    """Places of drives between which simulated quantities are interpolated, shape (n, p, d).

    With x = ln(shaft voltage/breakdown voltage) of a bearing, they are x/(1 + abs(x)) of the bearing with the
    larger ratio, at which almost all discharges occur, and a part of it of the other bearing. If capacitances
    divide the voltage of the source, the discharges of a drive depend on no other ratio of voltages;
    otherwise they also depend on the capacitances.
    """
    limits = [end["breakdown_voltage"] for end in ends]
    touching = np.minimum(*limits) == 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = [np.clip(np.log(shaft / limit), -_FARTHEST, _FARTHEST) for limit in limits]
    logs = [np.where(touching, _FARTHEST, log) for log in logs]
    places = [log / (1.0 + np.abs(log)) for log in (np.maximum(*logs), np.minimum(*logs))]
    columns = [places[0], _OF_OTHER * places[1]]
    if not divided:
        columns += [np.log(end[SHAFT_CAPACITANCE]) for end in ends]
    return np.stack(columns, axis=-1)


# Largest logarithm of a ratio of voltages, which is also its value where surfaces touch; and weight of the
# bearing with the smaller ratio (both by trial).
_FARTHEST, _OF_OTHER = 100.0, 0.25


@dataclass(frozen=True)
class _Nodes:
    """Simulated drives, between which quantities over time are interpolated."""

    features: Array  # shape (m, d)
    # Rms of the shaft voltage divided by its peak without discharges, and discharges per second [1/s]; NaN
    # without a result, shape (m, 2).
    values: Array
    # Deviations of the values from the interpolation between other nodes, shape (m, 2).
    off: Array

    @classmethod
    def of(cls, features: Array, values: Array) -> _Nodes:
        """Nodes with their deviations from the interpolation without one of some groups of nodes."""
        group, off = np.arange(len(features)) % _GROUPS, np.full(values.shape, np.nan)
        for k in range(_GROUPS):
            outside, inside = group != k, group == k
            if np.any(inside) and np.any(np.isfinite(values[outside])):
                off[inside] = values[inside] - between_places(
                    features[outside], values[outside], features[inside]
                )
        return cls(features, values, off)

    def at(self, features: Array, shaft: Array) -> dict[str, Array]:
        """Quantities at drives with some features, shape (n, p, d), and shaft voltages without discharges
        [V], shape (n, p) -> (n, p).
        """
        rows = between_places(self.features, self.values, features.reshape(-1, features.shape[-1]))
        part, rate = (row.reshape(shaft.shape) for row in rows.T)
        return dict(zip(_SIMULATED, (part * shaft, rate), strict=True))

    def errors(self, features: Array, shaft: Array) -> dict[str, Array]:
        """Standard deviations of the quantities, interpolated between squared deviations of nodes, with the
        arguments of ``at``.
        """
        rows = between_places(self.features, np.square(self.off), features.reshape(-1, features.shape[-1]))
        part, rate = (np.sqrt(np.nan_to_num(row)).reshape(shaft.shape) for row in rows.T)
        return dict(zip(_SIMULATED, (part * shaft, rate), strict=True))


# Groups of simulated drives that are omitted in turn.
_GROUPS = 8


def _of_bearings(case: DriveCase, models: tuple[BearingModel, BearingModel]) -> Iterator[_Input]:
    """Inputs of both bearings: shared if the bearings are equal, or if the drive gives their value."""
    equal = case.bearings[0] == case.bearings[1]
    for number, model in enumerate(models[:1] if equal else models):
        changes: dict[str, Change] = {change.key: change for change in model.changes}
        for place, name in enumerate(model.names()):
            key, places = name.key, {number: place}
            shared = key in case.replaced and not equal
            if equal:
                places = {0: place, 1: place}
            elif shared:
                if number:
                    continue
                others = [other.key for other in models[1].names()]
                places = {0: place, 1: others.index(key)}
            drive_key = case.key_at(BOTH if equal else ENDS[number], key)
            ends = changes[key].ends if key in changes else model.design.films
            label = name.label if equal or shared else f"{name.label}, {ENDS[number].replace('_', ' ')}"
            known = FILMS if key == FILMS and equal else drive_key
            yield _Input(replace(name, key=known, label=label), ends, places, changes.get(key))


def _of_circuit(case: DriveCase) -> Iterator[_Input]:
    """Capacitances of the machine, which data sheets do not contain."""
    for name in _CAPACITANCES:
        value = case.circuit.capacitances[name]
        key = f"circuit.{name}"
        entry = input_of(key)
        label = key if entry is None else entry.label
        ends = (1.0 - MOTOR) * value, (1.0 + MOTOR) * value
        reason = "engineering judgement: data sheets do not have it, and few measure it"
        yield _Input(Names(key, label, *ends, assumed=True, reason=reason), ends, MappingProxyType({}), None)
