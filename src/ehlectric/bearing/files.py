"""Run of a bearing and the files of its result: summary.json, contacts.csv, impedance.csv and bearing.nc."""

from __future__ import annotations

import csv
import dataclasses
import json
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.contacts import ContactCurve, ContactSolution, ContactValues
from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.loads.kinematics import Speeds
from ehlectric.bearing.loads.rollers import RollerEquilibrium
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.bearing.solution import BearingSolution, Position, RingState
from ehlectric.bearing.solver import check_bearing, solve_bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from ehlectric.runtime.files import clear, prepare, whole, write_json
from ehlectric.runtime.netcdf import read_dataset
from ehlectric.runtime.outcome import RunOutcome
from ehlectric.runtime.progress import Progress, silent
from ehlectric.runtime.stored_warnings import texts_and_codes, warnings_of

if TYPE_CHECKING:
    import xarray as xr

SUMMARY, CONTACTS, IMPEDANCE, NETCDF = "summary.json", "contacts.csv", "impedance.csv", "bearing.nc"
FILES = (SUMMARY, CONTACTS, IMPEDANCE, NETCDF)

# Name and version of the layout of bearing.nc.
SCHEMA = "ehlectric.bearing.solution/1"

_RINGS = ("inner", "outer")
_EQUILIBRIA = {kind.__name__: kind for kind in (BallEquilibrium, RollerEquilibrium)}
_UNITS = {
    "load": "N", "gap": "m", "max_pressure": "Pa", "semi_axis_x": "m", "semi_axis_y": "m",
    "minimum_thickness": "m", "central_thickness": "m", "inside": "F", "outside_oil": "F", "outside_air": "F",
    "plate": "F", "strength_per_volt": "1/m", "breakdown_voltage": "V",
}  # fmt: skip


def run(
    case: BearingCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    others: Sequence[str] = (),
) -> RunOutcome[BearingResult]:
    """Solve a whole bearing, and write summary.json, contacts.csv, impedance.csv and bearing.nc.

    Parameters
    ----------
    case : BearingCase
        Bearing to solve.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    progress : callable, optional
        Called with the number of contacts done, the number of all contacts, and what is being done.
    workers : int, optional
        Number of processes; by default as many as there are cores.
    others : sequence of str, optional
        Names of other files in the folder that belong to its result, such as figures. Those of an earlier
        result are removed when the bearing is solved.

    Returns
    -------
    RunOutcome
        With a ``failure`` where a contact is not converged; its files are written all the same.

    Raises
    ------
    InputError
        Where the bearing cannot be solved, or the folder cannot be used.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> duty = {"radial_load": "1 kN", "inner_speed": "3000 rpm", "temperature": "70 degC"}
    >>> case = BearingCase.from_dict(
    ...     {
    ...         "contacts": "formula",
    ...         "bearing": duty | {"base": "6208", "radial_clearance": "10 um", "composite_rq": "0.03 um"},
    ...         "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
    ...     }
    ... )
    >>> with TemporaryDirectory() as folder:
    ...     outcome = run(case, folder)
    >>> outcome.converged, [path.name for path in outcome.files]
    (True, ['summary.json', 'contacts.csv', 'bearing.nc'])
    """
    check_bearing(case)
    names = (*FILES, *others)
    folder = prepare(folder, names)
    result = solve_bearing(case, progress=progress, workers=workers)
    clear(folder, names)
    files = save(result, folder)
    failure = None if result.converged else "not converged: a contact of the bearing"
    return RunOutcome(result, result.summary(), tuple(files), tuple(result.warnings()), failure)


def save(result: BearingResult, folder: str | Path) -> list[Path]:
    """Save the result of a bearing: summary.json, contacts.csv, bearing.nc and impedance.csv.

    The file impedance.csv is written only if the bearing has an impedance.

    Parameters
    ----------
    result : BearingResult
        Result of ``solve_bearing``.
    folder : str or Path
        Folder of the files; it is made if it does not exist.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        If the folder cannot be written to.
    """
    folder = prepare(folder, FILES)
    clear(folder, FILES)
    summary, impedance = result.summary(), impedance_of(result.solution)
    write_json(folder / SUMMARY, summary)
    rows = summary["contacts"]
    _write_table(folder / CONTACTS, list(rows[0]), (row.values() for row in rows))
    written = [SUMMARY, CONTACTS]
    if impedance is not None:
        columns = impedance.frequency.tolist(), impedance.magnitude.tolist(), impedance.phase.tolist()
        heads = ["frequency", "magnitude", "phase_degrees"]
        _write_table(folder / IMPEDANCE, heads, zip(*columns, strict=True))
        written.append(IMPEDANCE)
    with whole(folder / NETCDF) as path:
        _dataset(result.solution).to_netcdf(path, engine="h5netcdf")
    return [folder / name for name in (*written, NETCDF)]


def _write_table(path: Path, heads: Sequence[str], lines: Iterable[Iterable[Any]]) -> None:
    with whole(path) as beside, beside.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(heads)
        writer.writerows(lines)


def load(path: str | Path) -> BearingResult:
    """Load the result of a bearing from its NetCDF file.

    Parameters
    ----------
    path : str or Path
        Path of a bearing.nc.

    Returns
    -------
    BearingResult
        Result, equal to the one that was saved.

    Raises
    ------
    InputError
        If the file cannot be read, or is not the result of a bearing.
    """
    path = Path(path)
    return result_of(read_dataset(path), path)


def result_of(dataset: xr.Dataset, path: Path) -> BearingResult:
    """Result of a bearing from its dataset.

    Parameters
    ----------
    dataset : xarray.Dataset
        Contents of a bearing.nc.
    path : Path
        The file, named in the error.

    Returns
    -------
    BearingResult
        Result, equal to the one that was saved.

    Raises
    ------
    InputError
        Where the dataset is not the result of a bearing.
    """
    try:
        return BearingResult(_solution_of(dataset))
    except (InputError, ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
        raise InputError(path, "is not the result of a bearing of ehlectric, or damaged") from None


def _dataset(solution: BearingSolution) -> xr.Dataset:
    """Dataset of a solution: variables over loads, cage positions, rings and elements, SI units."""
    import xarray as xr

    variables: dict[str, tuple[tuple[str, ...], Array, dict[str, str]]] = {}
    for name, curve in zip(_RINGS, solution.curves, strict=True):
        variables |= _curve_variables(name, curve)
    states = [position.rings for position in solution.positions]
    for name in ("load", "gap", "solved"):
        variables[name] = _over_elements(name, [[getattr(ring, name) for ring in pair] for pair in states])
    for name in ContactValues.__dataclass_fields__:
        stack = [[getattr(ring.values, name) for ring in pair] for pair in states]
        variables[name] = _over_elements(name, stack)
    variables |= _equilibrium_variables([position.equilibrium for position in solution.positions])
    shape = solution.positions[0].shape
    return xr.Dataset(
        variables,
        coords={"ring": list(_RINGS)},
        attrs={
            "schema": SCHEMA,
            "version": solution.version,
            "case": solution.case.to_toml(),
            "seconds": solution.seconds,
            "equilibrium": type(solution.positions[0].equilibrium).__name__,
            "weibull_shape": "" if shape is None else repr(shape),
            "contact_angle": [ring.angle for ring in (solution.inner, solution.outer)],
            "entrainment_speed": [ring.speed for ring in (solution.inner, solution.outer)],
            "warnings": json.dumps(
                [[texts_and_codes(one.warnings) for one in curve.solutions] for curve in solution.curves]
            ),
        },
    )


def _over_elements(name: str, values: Any) -> tuple[tuple[str, ...], Array, dict[str, str]]:
    return ("cage_position", "ring", "element"), np.array(values), {"units": _UNITS.get(name, "")}


def _curve_variables(ring: str, curve: ContactCurve) -> dict[str, Any]:
    """Variables of the solved contacts with one ring over their load; NaN where an error is unknown."""
    solutions, dims = curve.solutions, (f"{ring}_load",)
    columns = dict(zip(ContactValues.__dataclass_fields__, curve.stack().columns(), strict=True))
    others = {
        "load": curve.loads,
        "error": np.array([np.nan if one.error is None else one.error for one in solutions]),
        "moes_m": np.array([one.moes_m for one in solutions]),
        "moes_l": np.array([one.moes_l for one in solutions]),
        "mismatch": np.array([one.mismatch for one in solutions]),
        "converged": np.array([one.converged for one in solutions]),
    }
    return {
        f"{ring}_curve_{name}": (dims, values, {"units": _UNITS.get(name, "")})
        for name, values in (columns | others).items()
    }


def _equilibrium_variables(equilibria: Sequence[Equilibrium]) -> dict[str, Any]:
    """Variables of the equilibria over the cage positions, each with its own further dimensions."""
    elements = equilibria[0].position.size
    variables = {}
    for name, values in _stacked(equilibria).items():
        sizes = {0: (), 1: ("element",) if values.shape[1:] == (elements,) else ("slice",)}
        dims = ("cage_position", *sizes.get(values.ndim - 1, ("element", "slice")))
        variables[f"equilibrium_{name}"] = (dims, values)
    return variables


def _stacked(equilibria: Sequence[Equilibrium]) -> dict[str, Array]:
    """Quantities of the equilibria by name, stacked over the cage positions; speeds have a prefix."""
    tables = []
    for at in equilibria:
        table = {field.name: getattr(at, field.name) for field in dataclasses.fields(at)}
        speeds = vars(table.pop("speeds"))
        tables.append(table | {f"speeds_{name}": value for name, value in speeds.items()})
    return {name: np.array([table[name] for table in tables]) for name in tables[0]}


def _solution_of(dataset: xr.Dataset) -> BearingSolution:
    """Solution of a dataset that ``_dataset`` made."""
    attributes = dataset.attrs
    if attributes["schema"] != SCHEMA:
        raise ValueError("another format")
    case = BearingCase.from_dict(tomllib.loads(attributes["case"]))
    conditions = resolve_bearing(case)
    stored = json.loads(attributes["warnings"])
    inner, outer = (
        RingContacts(conditions, name == "inner", float(angle), float(speed))
        for name, angle, speed in zip(
            _RINGS, attributes["contact_angle"], attributes["entrainment_speed"], strict=True
        )
    )
    inner_curve, outer_curve = (
        _curve_of(dataset, name, texts) for name, texts in zip(_RINGS, stored, strict=True)
    )
    shape = float(attributes["weibull_shape"]) if attributes["weibull_shape"] else None
    positions = tuple(
        Position(_equilibrium_of(dataset, k), _state_of(dataset, k, 0), _state_of(dataset, k, 1), shape)
        for k in range(dataset.sizes["cage_position"])
    )
    if not positions:
        raise ValueError("no position of the cage")
    return BearingSolution(
        case=case,
        conditions=conditions,
        inner=inner,
        outer=outer,
        inner_curve=inner_curve,
        outer_curve=outer_curve,
        positions=positions,
        seconds=float(attributes["seconds"]),
        version=str(attributes["version"]),
    )


def _curve_of(dataset: xr.Dataset, ring: str, stored: Sequence[Mapping[str, Any]]) -> ContactCurve:
    columns = {
        name: dataset[f"{ring}_curve_{name}"].values
        for name in (*ContactValues.__dataclass_fields__, "load", "error", "moes_m", "moes_l", "mismatch")
    }
    converged = dataset[f"{ring}_curve_converged"].values
    return ContactCurve(
        tuple(
            _contact_of(
                {name: float(column[k]) for name, column in columns.items()},
                texts,
                converged=bool(converged[k]),
            )
            for k, texts in enumerate(stored)
        )
    )


def _contact_of(
    numbers: Mapping[str, float], stored: Mapping[str, Any], *, converged: bool
) -> ContactSolution:
    error = numbers["error"]
    return ContactSolution(
        load=numbers["load"],
        values=ContactValues(**{name: numbers[name] for name in ContactValues.__dataclass_fields__}),
        error=None if np.isnan(error) else error,
        moes_m=numbers["moes_m"],
        moes_l=numbers["moes_l"],
        mismatch=numbers["mismatch"],
        converged=converged,
        warnings=warnings_of(stored),
    )


def _state_of(dataset: xr.Dataset, position: int, ring: int) -> RingState:
    def at(name: str) -> Array:
        return np.asarray(dataset[name].values[position, ring])

    return RingState(
        load=at("load"),
        gap=at("gap"),
        solved=at("solved").astype(bool),
        values=ContactValues(**{name: at(name) for name in ContactValues.__dataclass_fields__}),
    )


def _equilibrium_of(dataset: xr.Dataset, position: int) -> Equilibrium:
    kind = _EQUILIBRIA[dataset.attrs["equilibrium"]]

    def at(name: str) -> Any:
        values = dataset[f"equilibrium_{name}"].values[position]
        return values.item() if values.ndim == 0 else values

    speeds = Speeds(**{field.name: at(f"speeds_{field.name}") for field in dataclasses.fields(Speeds)})
    names = {field.name for field in dataclasses.fields(kind)} - {"speeds"}
    return kind(speeds=speeds, **{name: at(name) for name in names})
