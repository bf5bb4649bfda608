"""Sweeps of the pages: what may vary, their size, and their run into the database of the command."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ehlectric.app.answers.sweep import SweepChoices, SweepPlan, SweepPoint, Variable
from ehlectric.app.compute import cases
from ehlectric.app.compute.cases import run_case_of
from ehlectric.app.compute.drives import swept
from ehlectric.app.fields import BEARING_GROUPS
from ehlectric.app.inputs import Inputs
from ehlectric.app.ranges import number_of_text
from ehlectric.bearing.quick.ways import is_quick
from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.changes import flattened, set_keys
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.drives.swept import SweptCase, swept_case_of_dict
from ehlectric.cases.input_keys import kind_of, unit_of
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import input_at
from ehlectric.quantities.units import in_unit, rpm, split
from ehlectric.runs.by_kind import run_sweep
from ehlectric.runtime.values import is_number
from ehlectric.sweep.breakdown_keys import breakdown_of, ranked_value
from ehlectric.sweep.engine import solve_point
from ehlectric.sweep.inputs import Sweep
from ehlectric.sweep.labels import label_of
from ehlectric.sweep.plan import case_key
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.run import planned_points
from ehlectric.sweep.store import NAME, read_sweep
from ehlectric.sweep.tables import FILES, write_tables

# Most points of a sweep of a page: larger ones are for the command, which needs no open tab.
MOST_POINTS = 2500

# Tables whose numbers say how a case is computed, not what it is.
_OF_SOLUTION = ("solver", "grid", "ranges", "title")

# Inputs that are varied most often, in this order.
_COMMON = (
    "bearing.inner_speed",
    "bearing.radial_load",
    "bearing.temperature",
    "bearing.axial_load",
    "contact.entrainment_speed",
    "contact.load_per_length",
    "contact.load",
    "contact.max_hertz_pressure",
    "contact.temperature",
    *swept.COMMON,
)

# Results that are shown most often. The one by which inputs are ranked and the breakdown voltage of the case
# stand before them.
_RESULTS = {
    "bearing": (
        "bearing.margin",
        "bearing.capacitance",
        "bearing.shaft_voltage",
        "bearing.lambda_ratio",
        "bearing.contact_time_share",
        "bearing.through_breakdown",
        "bearing.max_strength",
        "bearing.discharge_energy",
        "bearing.through_margin",
    ),
    "contact": (
        "discharge.margin",
        "film.minimum_thickness",
        "film.central_thickness",
        "film.max_pressure",
        "field.max_strength",
        "discharge.capacitance",
    ),
    "drive": swept.RESULTS,
}


def sweep_of(table: Mapping[str, Any]) -> Sweep:
    """Sweep of the tables of a sweep file with its base case inside.

    Raises
    ------
    InputError
        If the tables are no valid sweep, name a file, or have more points than a page may solve.
    """
    case = table.get("case")
    if not isinstance(case, Mapping):
        raise InputError.missing("case", "a table with the inputs of a bearing, a drive or a contact")
    try:
        run_case_of(case)
    except InputError as error:
        raise error.under("case") from None
    sweep = cases.sweep_of(table)
    if sweep.size > MOST_POINTS:
        takes = f"at most {MOST_POINTS} on this page; ehlectric sweep solves more, with the file of this page"
        raise InputError("vary", got=f"{sweep.size} points", takes=takes)
    return sweep


def choices(table: Mapping[str, Any]) -> SweepChoices:
    """Inputs of a base case that a sweep can vary, and results that a map can show.

    Parameters
    ----------
    table : mapping
        Nested tables of a bearing, drive or contact file.

    Raises
    ------
    InputError
        If the tables are no valid case.
    """
    case = run_case_of(table)
    kind = next((name for name, one in _KINDS.items() if isinstance(case, one)), "contact")
    keys = dict.fromkeys(filter(None, (ranked_value(case), breakdown_of(case).value, *_RESULTS[kind])))
    return SweepChoices(kind, tuple(_variables(table, case)), {key: named(key, case) for key in keys})


# Classes of cases, and pages, by kind; a contact has another one.
_KINDS = {"bearing": BearingCase, "drive": DriveCase}
_PAGES = {"bearing": "/", "drive": "/drive", "contact": "/contact"}


def _variables(table: Mapping[str, Any], case: SweptCase) -> Iterator[Variable]:
    if isinstance(case, DriveCase):
        written, resolved = swept.texts_of(table, case), swept.values_of(case)
        fields = swept.fields()
    else:
        written, resolved = Inputs(table).flat(), flattened(case.to_dict())
        fields = {field.key: field for group in BEARING_GROUPS for field in group.fields}
    numbers = [
        key
        for key, value in resolved.items()
        if is_number(value) and kind_of(key) is not None and key.partition(".")[0] not in _OF_SOLUTION
    ]

    def rank(key: str) -> tuple[int, int, int]:
        common = _COMMON.index(key) if key in _COMMON else len(_COMMON)
        return common, key not in written, input_at(key) is None

    for key in sorted(numbers, key=rank):
        slider, text = fields.get(key), str(written.get(key, ""))
        if slider is not None and slider.kind != "number":
            slider = None
        ends = _ends(text, resolved[key], key)
        if ends is not None:
            yield Variable(key, named(key, case), *ends, log=slider is not None and slider.log)


def named(key: str, case: SweptCase) -> str:
    """Name of an input or a result; one without a name has the last part of its key."""
    name = _NAMES.get(key) or label_of(key, case).name
    if name == key:
        name = key.rpartition(".")[2].replace("_", " ")
    return name[0].upper() + name[1:]


# Names by which people look for a result.
_NAMES = {"bearing.lambda_ratio": "lambda ratio (minimum film / roughness)"}


def _ends(text: str, value: float, key: str) -> tuple[str, str] | None:
    """Valid ends of a range around a value, in the unit in which it is written; None where there are none."""
    found = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(.*)", text)
    number, unit = (float(found[1]), found[2]) if found is not None else _in_si(value, key)
    # An input that the file lacks is a dimension or a constant, which has less room than a load.
    wide = [3.0] if found is not None else []
    for ratio in (*wide, 1.2):
        low, high = _around(number, unit, ratio)
        for ends in ((low, high), (low, number), (number, high)):
            texts = [f"{_short(end, key)} {unit}".strip() for end in ends]
            if texts[0] != texts[1] and all(_is_valid(text, key) for text in texts):
                return texts[0], texts[1]
    return None


def _around(number: float, unit: str, ratio: float) -> tuple[float, float]:
    if unit in ("degC", "°C", "K"):
        return number - 10.0 * ratio, number + 10.0 * ratio
    low, high = sorted((number / ratio, number * ratio))
    return (low, high) if low < high else (0.0, 1.0)


def _is_valid(text: str, key: str) -> bool:
    kind = kind_of(key)
    try:
        if isinstance(kind, Count):
            kind.parse(int(text))
        elif kind is not None:
            kind.parse(number_of_text(text), written=True)
    except InputError:
        return False
    return True


def _short(number: float, key: str) -> str:
    """Number with two digits that count, in full up to a million; a whole number of a count."""
    if isinstance(kind_of(key), Count):
        return str(round(number))
    return f"{float(f'{number:.2g}'):g}"


def _in_si(value: float, key: str) -> tuple[float, str]:
    """Number and unit of an SI value that a file lacks; speeds and temperatures in the usual units."""
    unit = unit_of(key)
    if unit == "K":
        return value - 273.15, "degC"
    if unit == "rad/s":
        return rpm(value), "rpm"
    if unit == "m":
        return (value * 1e6, "um") if abs(value) < 1e-4 else (value * 1e3, "mm")
    return value, unit


def planned(table: Mapping[str, Any], workers: int) -> SweepPlan:
    """Size of a sweep, refused corners of its ranges, and its time where the contacts are not solved.

    The time is that of one of the corners, which is solved here.

    Raises
    ------
    InputError
        If the tables are no valid sweep, or no corner of the ranges is a valid case.
    """
    sweep = sweep_of(table)
    ends = {key: sorted({axis[0], axis[-1]}) for key, axis in sweep.axes.items()}
    corners = planned_points(Sweep.from_dict({"case": sweep.case, "vary": ends}))
    refused = [point.refused for point in corners if point.key is None]
    seconds = None
    if is_quick(sweep.case):
        inputs = next(point.inputs for point in corners if point.key is not None)
        seconds = _seconds(sweep.case.replace(inputs)) * sweep.size / workers
    return SweepPlan(sweep.size, seconds, workers, len(refused), len(corners), next(iter(refused), ""))


def _seconds(case: SweptCase) -> float:
    """Time of a point that is not solved [s]: the shortest of a few, as the first one takes longer."""
    table = case.to_dict()
    found = [solve_point(table).seconds]
    while len(found) < _TRIES and sum(found) < _LONGEST_TRIES:
        found.append(solve_point(table).seconds)
    return min(found)


# Most solutions that are timed for an estimate, and the time after which no other is begun [s].
_TRIES, _LONGEST_TRIES = 3, 1.0


def solved(
    table: Mapping[str, Any], folder: str, workers: int, progress: Callable[[int, int, str], None]
) -> Mapping[str, int]:
    """Solve the open points of a sweep into a folder, as ``ehlectric sweep`` does; numbers by status."""
    outcome = run_sweep(sweep_of(table), folder, progress, workers=workers)
    return {key: value for key, value in outcome.summary.items() if isinstance(value, int)}


def is_stored(results: SweepResults, table: Mapping[str, Any]) -> bool:
    """Whether the stored sweep is that of the tables, with the varied inputs in the same order."""
    asked = sweep_of(table)
    # A case compares by its file, whose numbers have all digits.
    same = (results.design, results.case.to_toml()) == (asked.design, asked.case.to_toml())
    axes = [[(key, list(axis)) for key, axis in one.axes.items()] for one in (results, asked)]
    return same and axes[0] == axes[1]


def point(folder: str, table: Mapping[str, Any], number: int) -> SweepPoint:
    """Address of the page that shows the case of a point.

    Parameters
    ----------
    folder : str
        Folder of the sweep.
    table : mapping
        Sweep as a person wrote it: the address keeps the texts of its base case, and the units of its ranges.
    number : int
        Number of the point.

    Raises
    ------
    InputError
        If there is no such sweep, or the inputs of the point are no valid case.
    """
    results = read_sweep(folder)
    if not is_stored(results, table):
        raise InputError("the sweep has been replaced by another one; run it again")
    if not 0 <= number < len(results.points):
        raise InputError("number", got=number, takes=f"from 0 to {len(results.points) - 1}")
    kind = next((name for name, one in _KINDS.items() if isinstance(results.case, one)), "contact")
    path = _PAGES[kind]
    inputs, vary = results.points[number].inputs, table.get("vary", {})
    units = {key: _written_unit(vary, key) for key in inputs}
    found = point_table(results.case, table["case"], inputs, units)
    return SweepPoint(number, path, Inputs(found).address())


def point_table(
    case: SweptCase,
    table: Mapping[str, Any],
    inputs: Mapping[str, Any],
    units: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Tables of a file with the case of a point.

    Its texts are those of the base case, where these make the same case; else all keys are in SI units.
    ``units`` are those in which the varied inputs are best read, by key.

    Raises
    ------
    InputError
        If the inputs of the point are no valid case.
    """
    wanted = case.replace(inputs)
    changed: dict[str, Any] = tomllib.loads(Inputs(table).toml())
    texts = {key: _text(key, value, (units or {}).get(key, "")) for key, value in inputs.items()}
    set_keys(changed, swept.in_tables(table, texts) if isinstance(case, DriveCase) else texts)
    try:
        if case_key(swept_case_of_dict(changed, written=True)) == case_key(wanted):
            return changed
    except InputError:
        # As where a load replaces a Hertz pressure: the file must not have both.
        pass
    return tomllib.loads(wanted.to_toml())


def _written_unit(vary: Mapping[str, Any], key: str) -> str:
    """Unit in which a range or a list of values is written; empty without one."""
    value = vary.get(key, Inputs(vary).value(key))
    first = value.get("from") if isinstance(value, Mapping) else value
    first = first[0] if isinstance(first, list) and first else first
    found = split(first) if isinstance(first, str) else None
    return "" if found is None else found[1]


def _text(key: str, value: Any, unit: str = "") -> Any:
    """Value of an input with a unit, such that it reads back as the same number.

    The unit is the wanted one where a text in it has the same value to the last digit, else the SI unit.
    """
    si, kind = unit_of(key), kind_of(key)
    if not si or not isinstance(value, float):
        return value
    if unit and isinstance(kind, Amount):
        # The server reads units without the registry; an unknown one stays with the SI unit.
        number = in_unit(f"{value!r} {si.replace('**', '^')}", unit)
        for digits in () if number is None else (6, 9, 12):
            text = f"{repr(float(f'{number:.{digits}g}')).removesuffix('.0')} {unit}"
            if kind.parse(text, written=True) == value:
                return text
    return f"{value!r} {si}"


def files(folder: str) -> tuple[str, ...]:
    """Names of the files of a sweep, finished or not; its tables are those of the command.

    Raises
    ------
    InputError
        If there is no sweep, or its folder cannot be used.
    """
    place = Path(folder)
    results = read_sweep(place)
    if not all((place / name).exists() for name in FILES[:1]):
        write_tables(results, place)
    return tuple(name for name in (NAME, *FILES) if (place / name).exists())
