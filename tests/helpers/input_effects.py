"""Answers of the program to files of every kind, the cheapest first, and whether two answers differ."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch
from zlib import crc32

import numpy as np

from ehlectric import AxleCase, Case, DriveCase, GearCase, Sweep, run_sweep, solve, solve_motion
from ehlectric.axle import solve_axle
from ehlectric.axle.axle_discharges import simulate_axle
from ehlectric.axle.summary import axle_summary
from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.calibration.models import model_of
from ehlectric.calibration.range_update import given_points
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.table import Table
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.gear import solved_points
from ehlectric.gear.result import solve_gear
from ehlectric.runs.preview import preview_of
from ehlectric.runtime.display import is_number
from tests.helpers.share import THOROUGH

MODELS: Mapping[str, type[Table]] = {
    "line": Case,
    "point": Case,
    "motion": Case,
    "bearing": BearingCase,
    "gear": GearCase,
    "drive": DriveCase,
    "axle": AxleCase,
    "sweep": Sweep,
}

# Parts of a summary that repeat the file or differ between runs, and texts that contain numbers of the file.
_NOT_COMPARED = ("inputs", "seconds", "version", "title", "warnings", "verdict", "verdict_reasons")

# Ends of the ranges of uncertain inputs, which repeat the input.
_OF_RANGES = re.compile(r"indices\.\d+\.(low|high)$")

# Warning about keys without an effect, after the name of a part such as a bearing.
_UNUSED = re.compile(r"(.*: )?(?P<names>[^:]+?)( of the \w+ file)? (is|are) not used")

# Solved films of a gear pair: at both ends of the path of contact only, on coarse grids.
_solved_everywhere = solved_points.solved_correction


def _solved_at_ends(case: GearCase, flanks: Any, atlas: Any) -> Any:
    return _solved_everywhere(case, flanks, atlas.some(np.argsort(atlas.places)[[0]]))


def solving_once(monkeypatch: Any) -> None:
    """Solve equal bearings of axles and drives once: files that differ in one key have most of them."""
    known: dict[str, Any] = {}

    def solved(case: BearingCase, **options: Any) -> Any:
        key = repr(case.to_dict())
        if key not in known:
            known[key] = solve_bearing(case, **options)
        return known[key]

    for room in ("axle.solution", "drive.preparation"):
        monkeypatch.setattr(f"ehlectric.{room}.solve_bearing", solved)


# Relative difference of numbers that is an effect, far above rounding.
_EFFECT = 1e-9


class Answer:
    """Answers to the tables of a file: stages, of which later ones take longer and contain more."""

    def __init__(self, kind: str, tables: Mapping[str, Any], folder: Path) -> None:
        self.kind = kind.removeprefix("duty of ")
        self.duty = self.kind != kind
        self.case: Any = MODELS[self.kind].from_dict(_with_files(tables, folder))
        self._folder = folder
        self._stages: dict[int, dict[str, Any]] = {}

    @cached_property
    def result(self) -> Any:
        """Result of the case, without the probabilities of a gear pair and an axle."""
        if self.kind == "motion":
            return solve_motion(self.case)
        if self.kind == "sweep":
            with TemporaryDirectory(dir=self._folder) as folder, ThreadPoolExecutor(1) as executor:
                return run_sweep(self.case, folder, executor)
        if self.kind in ("gear", "axle"):
            with patch.multiple(solved_points, solved_correction=_solved_at_ends, _ERROR=0.3):
                return (solve_gear if self.kind == "gear" else solve_axle)(self.case, probable=False)
        return solve(self.case, workers=1)

    @property
    def _ways(self) -> Sequence[Callable[[], Any]]:
        """Answers, the cheapest first; probabilities only of a case with ranges, as they take seconds."""
        case, kind = self.case, self.kind
        if getattr(case, "measured", None) is not None:
            return [lambda: _compared(case)]
        if self.duty:
            return [lambda: {"duty": self.result.duty.summary()}]
        if kind == "sweep":
            return [lambda: self.result.to_dataframe().to_dict("list")]
        whole = [lambda: self.result.summary()]
        if kind == "bearing":
            parts = [lambda: summary_of(self.result.solution), lambda: self.result.summary(probable=False)]
            return [*parts, lambda: _impedance(self.result.solution), *whole]
        if kind == "axle":
            parts = [lambda: axle_summary(self.result.solution), *whole]
            if case.drive.duration is not None:
                parts.append(lambda: _simulated(self.result.solution))
            whole = parts
        if kind in ("gear", "axle"):
            return [*whole, lambda: solve(case).summary()] if case.ranges else whole
        if kind == "drive":
            return whole
        quick = [lambda: preview_of(case).summary] if kind != "line" and not THOROUGH else []
        return [*quick, *whole, lambda: _arrays(self.result.to_xarray())]

    @property
    def count(self) -> int:
        """Number of the stages."""
        return len(self._ways)

    def stage(self, number: int) -> dict[str, Any]:
        """Values of a stage by dotted key, or the reason why there are none."""
        if number not in self._stages:
            try:
                values = self._ways[number]()
            except (InputError, ConvergenceError) as error:
                values = {"error": str(error)}
            self._stages[number] = dict(
                _leaves({k: v for k, v in values.items() if not k.startswith(_NOT_COMPARED)})
            )
        return self._stages[number]

    def naming(self, key: str) -> str:
        """Warning that names a key as one without an effect; empty without one."""
        for text in map(str, getattr(self.result, "warnings", ())):
            if found := _UNUSED.match(text):
                names = re.split(", | and ", found["names"])
                if any(f".{name}." in f".{key}." for name in names):
                    return text
        return ""

    @cached_property
    def given(self) -> dict[str, Any]:
        """Values of the case in SI units, by dotted key; none of a sweep."""
        return {} if self.kind == "sweep" else dict(_leaves(self.case.to_dict()))


def first_difference(first: Answer, second: Answer) -> str:
    """Key of a value that differs in two answers, and does not only repeat an input; empty without one."""
    repeated = [
        (first.given.get(key), second.given.get(key)) for key in first.given.keys() | second.given.keys()
    ]
    repeated = [pair for pair in repeated if pair[0] != pair[1]]
    for number in range(first.count):
        before, after = first.stage(number), second.stage(number)
        for key in sorted(before.keys() | after.keys()):
            pair = before.get(key), after.get(key)
            if (
                not _OF_RANGES.search(key)
                and not _same(*pair)
                and not any(_same_pair(pair, each) for each in repeated)
            ):
                return f"{key} of {pair[0]!r} is {pair[1]!r}"
    return ""


def _same_pair(first: tuple[Any, Any], second: tuple[Any, Any]) -> bool:
    return _same(first[0], second[0]) and _same(first[1], second[1])


def _impedance(solution: Any) -> dict[str, Any]:
    """Impedance of a bearing with and without closed contacts."""
    impedance = impedance_of(solution)
    pair = () if impedance is None else (impedance, impedance.mean)
    return {str(n): abs(each.values) for n, each in enumerate(pair) if each is not None}


def _simulated(solution: Any) -> dict[str, Any]:
    """Discharges of an axle over time; none if all shafts are connected to the housing."""
    discharges = simulate_axle(solution)
    return (
        {} if discharges is None else {"summary": discharges.summary(), "events": list(discharges.events())}
    )


def _compared(case: Any) -> dict[str, Any]:
    """Measured values that a calibration compares. Raises InputError for a value that it does not compute."""
    model = model_of(case)
    given = given_points(case, quantities=model.quantities)
    for value in given.values:
        if value.quantity not in model.quantities:
            raise InputError(f"measured.{value.quantity}", got="a value", takes=", ".join(model.quantities))
    values = [(value.quantity, value.value, value.uncertainty) for value in given.values]
    # A value in each range, as its ends repeat the file.
    inputs = [model.values(place, np.array([0.3])).tolist() for place in range(len(model.names()))]
    return {"points": given.points, "values": values, "ranges": inputs}


def _same(first: Any, second: Any) -> bool:
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return first.shape == second.shape and np.allclose(
            first, second, rtol=_EFFECT, atol=0.0, equal_nan=True
        )
    if is_number(first) and is_number(second):
        return abs(first - second) <= _EFFECT * abs(first) or (first != first and second != second)
    return type(first) is type(second) and bool(first == second)


def _leaves(values: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Values within nested tables and lists, by dotted key."""
    if isinstance(values, Mapping):
        for name, value in values.items():
            yield from _leaves(value, f"{key}.{name}" if key else str(name))
    elif isinstance(values, list | tuple):
        for place, value in enumerate(values):
            yield from _leaves(value, f"{key}.{place}" if key else str(place))
    else:
        yield key, values


def _arrays(dataset: Any) -> dict[str, Any]:
    """Numeric arrays of a dataset."""
    arrays = {name: dataset[name].values for name in dataset.variables}
    return {name: array for name, array in arrays.items() if array.dtype.kind == "f"}


def _with_files(table: Any, folder: Path) -> Any:
    """Nested tables in which a text of several lines is the path of a file with this text."""
    if isinstance(table, Mapping):
        return {key: _with_files(value, folder) for key, value in table.items()}
    if isinstance(table, list):
        return [_with_files(value, folder) for value in table]
    if isinstance(table, str) and "\n" in table:
        path = folder / f"{crc32(table.encode())}.csv"
        path.write_text(table)
        return str(path)
    return table
