"""Numbers of bearings, gear pairs and axles at many points of operation, computed together."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.bearing import Columns, columns_of, many_of, required_quick_case
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import is_quantity, key_of_names
from ehlectric.contact import case_with_laws
from ehlectric.errors import InputError, for_all, shown
from ehlectric.quantities.inputs import BOTH, ENDS, REPLACED, end_and_replaced
from ehlectric.quantities.results import is_number_of_points, is_text_of_points
from ehlectric.sweep.axis_labels import label_of, result_keys
from ehlectric.sweep.points_of_cases import axle_columns, gear_columns
from ehlectric.version import __version__

if TYPE_CHECKING:
    import xarray as xr


def evaluate(
    case: BearingCase | DriveCase | AxleCase | GearCase, inputs: Mapping[str, Any], *, laws: object = None
) -> xr.Dataset:
    """Evaluate a bearing, both bearings of a drive, a gear pair or an axle at many points of operation: a
    thousand bearings a second on one core.

    Contacts are from the atlas of films, or from formulas if the case requests them; contacts of a case with
    solved contacts are from the atlas here. Every point has the numbers that ``solve_bearing``,
    ``solve_gear`` or ``solve_axle`` gives for it when called by itself, to 1e-8.

    Parameters
    ----------
    case : BearingCase, DriveCase, AxleCase or GearCase
        Bearing file, drive file, of which both bearings are evaluated, axle or gear file; its inputs hold at
        every point unless they are given anew.
    inputs : mapping
        Arrays or lists of equal length n by dotted key of the case: numbers in SI units, texts with units, or
        names. Points that share their names and whole numbers are computed together. Keys of a drive are
        ``drive.speed``, ``drive.temperature``, and keys of its bearings.
    laws : None
        Refused: only the contacts of ``solve``, ``solve_many`` and ``run_sweep`` take laws of your own.

    Returns
    -------
    xarray.Dataset
        Dataset over ``point`` in SI units. Its coordinates are the inputs; its variables are the numbers of
        the tables ``bearing``, ``lubricant``, ``mechanics`` and ``life``, or ``gear``, ``mesh`` and
        ``points``, of summary.json by dotted key, NaN where a point has none, but not results with the key of
        an input. An axle has the tables ``edge``, ``first``, ``elements`` and ``shafts``, with keys such as
        ``elements.rotor_1.voltage_ratio`` and ``elements.mesh_1.state``. ``converged`` is whether a point
        has a result, ``reason`` why it has none, and ``warning_codes`` has the codes of its warnings, joined
        by "; ". Variables of a drive begin with the end of their bearing, as in
        ``drive_end.bearing.capacitance``.

    Raises
    ------
    InputError
        If a key is unknown, a value is wrong, arrays differ in their length, or the bearing needs solved
        contacts, as with a Weibull law of the strength.

    Examples
    --------
    The capacitance falls with the speed, because the films become thicker:

    >>> case = BearingCase.of(
    ...     base="6208", radial_clearance="10 um", radial_load="1 kN", inner_speed="3000 rpm",
    ...     temperature="70 degC", composite_rq="0.03 um", film_factor="none",
    ...     lubricant={"base": "paper", "viscosity": "20 mPa s"},
    ... )
    >>> found = evaluate(case, {"bearing.inner_speed": ["1000 rpm", "3000 rpm"]})
    >>> found["converged"].values.tolist()
    [True, True]
    >>> bool(found["bearing.capacitance"][0] > found["bearing.capacitance"][1])
    True
    """
    if laws is not None:
        case_with_laws(case, laws)
    given: dict[str, Any] = {}
    for key, values in inputs.items():
        name = key_of_names(key, values)
        if name in given:
            raise InputError.worded(name, "is given twice")
        given[name] = _values(key, values)
    if not given:
        raise InputError("inputs", got="none", takes="at least one key with an array")
    lengths = {key: len(values) for key, values in given.items()}
    (first, number), *others = lengths.items()
    for key, length in others:
        if length != number:
            raise InputError(key, got=f"{length} values", takes=f"{number}, as many as {first}")
    if isinstance(case, DriveCase):
        return _of_drive(case, given, number)
    if isinstance(case, GearCase):
        return _dataset(case, *gear_columns(case, given, number))
    if isinstance(case, AxleCase):
        return _dataset(case, *axle_columns(case, given, number))
    columns, inputs_of_points = _columns(_quick(case), given, number)
    return _dataset(case, columns, inputs_of_points)


def _of_drive(case: DriveCase, given: Mapping[str, Any], number: int) -> xr.Dataset:
    """Dataset of both bearings of a drive, whose variables begin with the end of their bearing."""
    import xarray as xr

    for_all(case.check_not_replaced, given)
    parts: list[xr.Dataset] = []
    inputs_of_drive: dict[str, Any] = {}
    for end, bearing in zip(ENDS, case.bearings, strict=True):
        of_end = {key: _key_of_end(key, end) for key in given}
        inputs = {name: given[key] for key, name in of_end.items() if name is not None}
        columns, values = _columns(_quick(bearing), inputs, number)
        inputs_of_drive |= {key: values[name] for key, name in of_end.items() if name is not None}
        part = _dataset(bearing, columns, values).drop_vars(list(values))
        if "reason" in part:
            reasons = [_reason_of_end(case, end, str(reason)) for reason in part["reason"].values]
            part["reason"] = part["reason"].copy(data=np.array(reasons, dtype=part["reason"].dtype.kind))
        parts.append(part.rename_vars({name: f"{end}.{name}" for name in part.data_vars}))
    coordinates = {key: ("point", values) for key, values in inputs_of_drive.items()}
    attributes = parts[0].attrs | {"title": case.title or "Drive at many points", "case": case.to_toml()}
    return xr.merge(parts, combine_attrs="drop").assign_coords(coordinates).assign_attrs(attributes)


def _reason_of_end(case: DriveCase, end: str, reason: str) -> str:
    """Reason of a bearing with the key of the drive file; empty without a reason."""
    key, sign, text = reason.partition(": ")
    return f"{case.key_at(end, key)}: {text}" if sign else reason


def _key_of_end(key: str, end: str) -> str | None:
    """Key of a bearing file that a key of a drive stands for at one of its ends; None for the other end."""
    of, inner = end_and_replaced(key)
    if of not in (*ENDS, BOTH) or key == REPLACED["contacts"]:
        takes = "drive.speed, drive.temperature, or a key of drive_end, non_drive_end or bearings"
        raise InputError(key, got="a key of the drive itself", takes=takes)
    return inner if of in (BOTH, end) else None


def _values(key: str, values: Any) -> Any:
    if isinstance(values, np.ndarray) and values.ndim == 1 and values.size:
        return values
    if isinstance(values, str) or not isinstance(values, Sequence) or not len(values):
        raise InputError(key, got=shown(values), takes="an array or a list, with a value for each point")
    return values


def _quick(case: BearingCase) -> BearingCase:
    """Case whose contacts are not solved; an InputError where the bearing needs solved ones."""
    if not isinstance(case, BearingCase):
        raise InputError(
            "case", got=type(case).__name__, takes="a BearingCase, a DriveCase, an AxleCase or a GearCase"
        )
    quick, refused = required_quick_case(case)
    if refused is not None:
        raise refused
    return quick


def _columns(case: BearingCase, given: Mapping[str, Any], number: int) -> tuple[Columns, dict[str, Any]]:
    """Results of all points, and their inputs in SI units."""
    columns, inputs = Columns(number), {key: np.empty(number, dtype=object) for key in given}
    for points, names in _groups(given, number):
        named = case.replace(names) if names else case
        arrays = {key: _at(values, points) for key, values in given.items() if key not in names}
        many = many_of(named, arrays, points.size)
        columns.take(points, columns_of(many))
        of_group = names | many.arrays()
        for key, column in inputs.items():
            column[points] = of_group[key]
    return columns, {key: np.array(column.tolist()) for key, column in inputs.items()}


def _at(values: Any, points: IntArray) -> Any:
    """Values of some points."""
    return values[points] if isinstance(values, np.ndarray) else [values[k] for k in points.tolist()]


def _groups(given: Mapping[str, Any], number: int) -> Iterator[tuple[IntArray, dict[str, Any]]]:
    """Points that share their names and whole numbers, with these by key."""
    shared = [key for key in given if not is_quantity(key)]
    groups: dict[tuple[Any, ...], list[int]] = {}
    for point in range(number):
        groups.setdefault(tuple(given[key][point] for key in shared), []).append(point)
    for names, points in groups.items():
        yield np.array(points), dict(zip(shared, names, strict=True))


# Names of cases without a title.
_NAMES = {BearingCase: "Bearing", GearCase: "Gear pair", AxleCase: "Axle"}


# Tables of the numbers of points.
_TABLES = {
    BearingCase: ("bearing", "lubricant", "mechanics", "life"),
    GearCase: ("gear", "mesh", "points"),
    AxleCase: ("edge", "first", "elements", "shafts"),
}
_ROWS = ("elements", "shafts")


def _missing(case: BearingCase | GearCase | AxleCase, number: int) -> Iterator[tuple[str, Array]]:
    """Columns without a value, NaN or empty texts, of all results of a kind of case."""
    for key in result_keys(case):
        table, *rest = key.split(".")
        # Rows of an axle have the name of their element or shaft.
        if table not in _TABLES[type(case)] or (table in _ROWS and len(rest) < 2):
            continue
        if is_text_of_points(key):
            yield key, np.full(number, "", dtype=object)
        elif is_number_of_points(key):
            yield key, np.full(number, math.nan)


def _dataset(
    case: BearingCase | GearCase | AxleCase, columns: Columns, inputs: Mapping[str, Any]
) -> xr.Dataset:
    """Dataset of results over the points, with the inputs as coordinates."""
    import xarray as xr

    def entry(key: str, values: Any) -> tuple[str, Any, dict[str, str]]:
        label = label_of(key, case)
        return (
            "point",
            values,
            label.attributes(number=not is_text_of_points(key) and values.dtype.kind == "f"),
        )

    solved = columns.solved
    reasons = np.array([columns.reasons.get(k, "") for k in range(columns.size)], dtype=object)
    codes = np.array(["; ".join(about) for about in columns.codes_of()], dtype=object)
    about = {"converged": ("point", solved), "reason": ("point", reasons), "warning_codes": ("point", codes)}
    # What no point has is NaN or empty, so that the variables do not depend on the values.
    values = dict(_missing(case, columns.size)) | columns.values
    results = {key: entry(key, column) for key, column in values.items() if key not in inputs}
    return xr.Dataset(
        about | results,
        coords={key: entry(key, values) for key, values in inputs.items()},
        attrs={
            "Conventions": "CF-1.11",
            "title": case.title or f"{_NAMES[type(case)]} at many points of operation",
            "source": f"ehlectric {__version__}",
            "comment": "SI units; NaN where a point has no result; see warning_codes before a value is used",
            "case": case.to_toml(),
        },
    )
