"""Duty cycle of an axle: first element, voltages and states of all elements over time, and their shares."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.axle.many_axles import solve_axles
from ehlectric.axle.solution import AxleSolution
from ehlectric.bearing import duty_csv, edges_of, file_warnings, moves
from ehlectric.cases.axle_case import AxleCase, changed_axle
from ehlectric.cases.duty_inputs import Cycle, Duty, read_cycle
from ehlectric.cases.measurements import AXLE_CYCLE
from ehlectric.drive import firsts, touches, voltage_ratios
from ehlectric.errors import InputError
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.lubrication_states import AT_TIMES, CONDUCTS, INSULATES
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.statement import Statement
from ehlectric.readable import readable
from ehlectric.runtime.files import Content

# Most operating points that are solved: about 100 s on one core.
_MOST_POINTS = 20_000

# Numbers of the states of an element: its summits touch, or as in a mesh; 0 without a result.
STATES = ("", CONDUCTS, AT_TIMES, INSULATES)


# Values at the rows of a cycle in a file.
_of_rows = partial(stored, rule="a number", dtype="f8")


@dataclass(frozen=True, eq=False)
class AxleDuty:
    """Rows of a duty cycle with what all elements are at each, SI units.

    Each row counts for the time from halfway to the row before to halfway to the next.
    """

    source: str  # path of the file
    names: tuple[str, ...]  # names of the elements
    keys: tuple[str, ...]  # keys of the elements in duty.csv
    time: Array = field(metadata=_of_rows("row"))  # [s], shape (n,)
    speed: Array = field(metadata=_of_rows("row"))  # of the rotor [rad/s], shape (n,)
    torque: Array = field(metadata=_of_rows("row"))  # of the rotor [N m], shape (n,)
    temperature: Array = field(metadata=_of_rows("row"))  # of the oil [K], shape (n,)
    # Voltages and breakdown voltages of all elements after an edge [V], shape (n, elements): NaN without a
    # result, and limits as in ``voltage_ratios``.
    voltages: Array = field(metadata=_of_rows("row element"))
    limits: Array = field(metadata=_of_rows("row element"))
    # Numbers of the states, shape (n, elements).
    states: IntArray = field(metadata=_of_rows("row element"))
    points: int  # number of operating points that were solved
    warnings: tuple[ResultWarning, ...] = ()

    @property
    def duration(self) -> Array:
        """Time for which each row counts [s], shape (n,)."""
        return np.diff(edges_of(self.time))

    @property
    def standing(self) -> Mask:
        """Rows at a standstill, shape (n,)."""
        return ~moves(self.speed)

    @property
    def known(self) -> Mask:
        """Rows with a result, shape (n,)."""
        return np.asarray(np.all(np.isfinite(self.voltages), axis=1))

    @property
    def ratios(self) -> Array:
        """U/V_b of all elements, shape (n, elements): infinite where summits touch, 0 if the element does not
        break down, and NaN without a result.
        """
        return voltage_ratios(self.voltages, self.limits)

    @property
    def touching(self) -> Mask:
        """Whether the summits of each element touch under a voltage, shape (n, elements)."""
        return touches(self.limits) & (self.voltages > 0.0)

    @property
    def first(self) -> IntArray:
        """Number of the element that discharges first at each row, -1 without one, shape (n,)."""
        return firsts(self.voltages, self.limits)

    def share(self, within: Mask) -> float:
        """Share of the time of some rows, from 0 to 1."""
        return float(np.sum(self.duration[within]) / np.sum(self.duration))

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``duty`` of summary.json, SI units; None for what is not known."""
        first, ratios = self.first, self.ratios
        return {
            "source": self.source,
            "rows": self.time.size,
            "duration": float(np.sum(self.duration)),
            "points": self.points,
            "standstill_share": self.share(self.standing),
            "left_out_share": self.share(~self.standing & ~self.known),
            "none_share": self.share(self.known & (first < 0)),
            "elements": [
                {
                    "element": name,
                    "first_share": self.share(first == number),
                    "breakdown_share": self.share(
                        self.known & ((ratios[:, number] >= 1.0) | self.touching[:, number])
                    ),
                    "touching_share": self.share(self.known & self.touching[:, number]),
                    **{
                        f"{key}_share": self.share(self.states[:, number] == STATES.index(state))
                        for key, state in _SHARES.items()
                    },
                    **self._largest(np.where(self.touching, 0.0, ratios)[:, number]),
                }
                for number, name in enumerate(self.names)
            ],
        }

    def _largest(self, ratios: Array) -> dict[str, float | None]:
        """Largest finite U/V_b of an element, with its row; None without one."""
        known = np.where(np.isfinite(ratios), ratios, 0.0)
        row = int(np.argmax(known))
        values = known[row], self.time[row], self.torque[row], self.speed[row]
        names = ("largest_ratio", "largest_time", "largest_torque", "largest_speed")
        return {
            name: float(value) if known[row] > 0.0 else None
            for name, value in zip(names, values, strict=True)
        }

    @property
    def statement(self) -> Statement | None:
        """Statement on the share of time that each element is the first, and of all other times; None if no
        element ever is.
        """
        shares = {name: self.share(self.first == number) for number, name in enumerate(self.names)}
        listed = sorted((name for name in shares if shares[name] > 0.0), key=lambda name: -shares[name])
        rest = {
            "no element": self.share(self.known & (self.first < 0)),
            "standstill": self.share(self.standing),
            "not computed": self.share(~self.standing & ~self.known),
        }
        known = [(name, shares[name]) for name in listed] + [each for each in rest.items() if each[1] > 0.0]
        texts = tuple(f"{name} {readable(100.0 * share, 2)} %" for name, share in known)
        return Statement.of("axle-duty", elements=texts) if listed else None

    def columns(self) -> dict[str, tuple[str | None, Array]]:
        """Columns of duty.csv with their units, None for texts."""
        first = np.array([*self.names, ""], dtype=object)[self.first]
        columns: dict[str, tuple[str | None, Array]] = {
            "time": ("s", self.time),
            "duration": ("s", self.duration),
            "speed": ("rad/s", self.speed),
            "torque": ("N*m", self.torque),
            "temperature": ("K", self.temperature),
            "first_element": (None, first),
        }
        for number, key in enumerate(self.keys):
            limits = self.limits[:, number]
            columns |= {
                f"{key}.voltage": ("V", self.voltages[:, number]),
                f"{key}.breakdown_voltage": (
                    "V",
                    np.where(np.isfinite(limits), np.maximum(limits, 0.0), math.nan),
                ),
                f"{key}.state": (None, np.array(STATES, dtype=object)[self.states[:, number]]),
            }
        return columns

    def contents(self) -> dict[str, Content]:
        """Content of duty.csv by its name."""
        return duty_csv(self.columns())


# Shares of the time of states by the beginning of their keys.
_SHARES = {"conducting": CONDUCTS, "conducting_at_times": AT_TIMES, "insulating": INSULATES}


def check_axle_duty(case: AxleCase) -> None:
    """Refuse the duty cycle of an axle that cannot be used, without its computation."""
    if case.duty is not None:
        _points(_cycle_of(case, case.duty), case)


def run_axle_duty(case: AxleCase) -> AxleDuty | None:
    """Result of the duty cycle of an axle; None without one.

    Each row is a stationary axle right after an edge, with films from the atlas, or from a formula if the
    case requests it. Rows at a standstill have no result. Raises InputError where the file of the cycle
    cannot be used.
    """
    if case.duty is None:
        return None
    cycle = _cycle_of(case, case.duty)
    table, rows = _points(cycle, case)
    quick = {"drive.contacts": "atlas"} if case.solves_films else {}
    alone = case.replace({"remedies": [], **quick}).model_copy(update={"duty": None, "ranges": None})
    reasons: dict[int, str] = {}
    cases: dict[int, AxleCase] = {}
    for place, row in enumerate(table.tolist()):
        try:
            cases[place] = changed_axle(alone, dict(zip(_KEYS.values(), row, strict=True)))
        except InputError as error:
            reasons[place] = str(error)
    elements = case.keys_of_elements()
    count = len(elements)
    voltages, limits = (np.full((len(table) + 1, count), np.nan) for _ in range(2))
    states = np.zeros((len(table) + 1, count), dtype=int)
    for place, outcome in zip(cases, solve_axles(cases.values()), strict=True):
        if isinstance(outcome, AxleSolution):
            voltages[place], limits[place] = outcome.voltages_and_limits()
            states[place] = [STATES.index(element.state) for element in outcome.elements]
        else:
            reasons[place] = str(outcome)
    given = _given(cycle, case)
    return AxleDuty(
        source=cycle.source,
        names=tuple(elements.values()),
        keys=tuple(elements),
        time=cycle.time,
        speed=given["speed"],
        torque=given["torque"],
        temperature=given["temperature"],
        voltages=voltages[rows],
        limits=limits[rows],
        states=states[rows],
        points=len(table),
        warnings=tuple(_warnings(case, cycle, rows, reasons)),
    )


def _cycle_of(case: AxleCase, duty: Duty) -> Cycle:
    """Cycle of an axle, whose meshes have the ratio of the rotor to the shaft of the wheels."""
    ratio = None if duty.vehicle is None else case.ratio_to(duty.vehicle.shaft)
    return read_cycle(duty, AXLE_CYCLE, ratio)


# Keys of the case by the names of the columns.
_KEYS = {"speed": "drive.speed", "torque": "drive.torque", "temperature": "drive.temperature"}


def _given(cycle: Cycle, case: AxleCase) -> dict[str, Array]:
    """Inputs of all rows by the names of their columns, SI units; inputs of the case without a column."""
    constant = {name: np.full(cycle.time.size, getattr(case.drive, name)) for name in _KEYS}
    return constant | {name: values for name, values in cycle.values.items() if name in _KEYS}


def _points(cycle: Cycle, case: AxleCase) -> tuple[Array, IntArray]:
    """Distinct operating points of rows that turn, shape (m, 3), and the place of each row among them.

    A row at a standstill has the place m. Raises InputError for too many points.
    """
    given = _given(cycle, case)
    turning = moves(given["speed"])
    table = np.stack([given[name][turning] for name in _KEYS], axis=1)
    distinct, inverse = np.unique(table, axis=0, return_inverse=True)
    if len(distinct) > _MOST_POINTS:
        raise InputError(
            "duty.file",
            got=f"{len(distinct)} different operating points",
            takes=f"at most {_MOST_POINTS}; round the values, or take fewer rows",
        )
    rows = np.full(cycle.time.size, len(distinct))
    rows[turning] = inverse.ravel()
    return distinct, rows


def _warnings(
    case: AxleCase, cycle: Cycle, rows: IntArray, reasons: Mapping[int, str]
) -> Iterator[ResultWarning]:
    """Warnings about the file of a cycle and about what is not computed of it."""
    yield from file_warnings(cycle, case.lubricant)
    without = np.flatnonzero(np.isin(rows, [*reasons]))
    if without.size:
        line, reason = cycle.lines[int(without[0])], reasons[int(rows[without[0]])]
        yield ResultWarning.of("duty-left-out", "bearing", rows=without.size, line=line, reason=reason)
