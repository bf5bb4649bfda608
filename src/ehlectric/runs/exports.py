"""Results in the file formats of other programs: VTKHDF of ParaView, MAT files, and workbooks."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from io import BytesIO
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, cast

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray
from ehlectric.contact import PointResult, Result
from ehlectric.errors import InputError, shown
from ehlectric.motion.result import MotionResult
from ehlectric.readable import readable
from ehlectric.runs.result_folders import stored_result
from ehlectric.runs.solve import AnyResult, load
from ehlectric.runs.workbooks import workbook
from ehlectric.runtime.files import check_target as check_file
from ehlectric.runtime.files import write
from ehlectric.runtime.netcdf import load_library
from ehlectric.sweep import NAME as SWEEP
from ehlectric.sweep import SweepResults, read_sweep
from ehlectric.version import __version__

if TYPE_CHECKING:
    import h5py
    import xarray as xr


Exported: TypeAlias = AnyResult | SweepResults


# Version of the format, and numbers of its cells: quadrilaterals and hexahedra, by the dimensions of a grid.
_VERSION = (2, 1)
_CELLS = {1: 3, 2: 9, 3: 12}

# Largest number of points that are compressed together.
_CHUNK = 50_000


def vtkhdf_file(result: Any) -> bytes:
    """Content of a VTKHDF file in SI units: the blocks "film" and "field" of a contact, or a film over time.

    The film of a line contact is its upper surface as a line over x, with the film thickness as y; the film
    of a point contact is a surface over x and y, with the film thickness as z. The field fills the gap
    between the deformed surfaces. Every array of the dataset that lies on one of both grids is a value of its
    points. The gap is thousands of times wider than high: scale its height in ParaView (Transform, Scale).
    With moving roughness the film has a time step for each recorded instant, and there is no field in the
    gap.

    Raises InputError if the result is another one: it has no film and field on a grid.
    """
    if not isinstance(result, Result | PointResult | MotionResult):
        raise InputError(
            ".vtkhdf",
            "holds film and field of a contact",
            takes=".mat or .xlsx for results of bearings, gear pairs, drives, e-axles and sweeps",
        )
    load_library()
    import h5py

    dataset = result.to_xarray()
    file = BytesIO()
    with h5py.File(file, "w", track_order=True) as target:
        root = target.create_group("VTKHDF", track_order=True)
        root.attrs["Version"] = np.array(_VERSION)
        (_moving if isinstance(result, MotionResult) else _stationary)(root, dataset)
        target.attrs["source"] = f"ehlectric {__version__}, SI units"
        target.attrs["title"] = str(dataset.attrs.get("title", result.case.title))
    return file.getvalue()


def _stationary(root: h5py.Group, dataset: xr.Dataset) -> None:
    """Write film and field of a contact as two blocks."""
    import h5py

    plane = ("x",) if "y_field" not in dataset.dims else ("x", "y")
    heights = dataset["y" if len(plane) == 1 else "z"]
    blocks = {"film": (plane, dataset["thickness"]), "field": (heights.dims, heights)}
    _type(root, "PartitionedDataSetCollection")
    assembly = root.create_group("Assembly", track_order=True)
    for index, (name, (dims, height)) in enumerate(blocks.items()):
        group = root.create_group(name, track_order=True)
        group.attrs["Index"] = index
        group.attrs["Version"] = np.array(_VERSION)
        axes = tuple(map(str, dims))
        _grid(group, tuple(dataset.sizes[dim] for dim in axes))[:] = _points(dataset, axes, height)
        _values(group, dataset, axes)
        # A node of its own: VTK before 9.6 takes no names from the blocks themselves.
        assembly.create_group(name, track_order=True)[name] = h5py.SoftLink(f"/VTKHDF/{name}")


def _moving(root: h5py.Group, dataset: xr.Dataset) -> None:
    """Write the film at all recorded instants: the points of all of them, and their cells once."""
    plane = ("x",) if "y" not in dataset.dims else ("x", "y")
    film = dataset["thickness"].transpose("frame", *plane)
    times = dataset["frame_time"].values
    sizes = tuple(dataset.sizes[dim] for dim in plane)
    number = int(np.prod(sizes))
    points = _grid(root, sizes, len(times))
    for step, thickness in enumerate(film):
        points[number * step : number * (step + 1)] = _points(dataset, plane, thickness)
    steps = root.create_group("Steps", track_order=True)
    steps.attrs["NSteps"] = len(times)
    steps["Values"] = times
    steps["NumberOfParts"] = np.ones(len(times), dtype=np.int64)
    steps["PointOffsets"] = number * np.arange(len(times))
    steps["PartOffsets"] = np.zeros(len(times), dtype=np.int64)
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        steps[name] = np.zeros((len(times), 1), dtype=np.int64)
    offsets = steps.create_group("PointDataOffsets", track_order=True)
    for name in _values(root, dataset, ("frame", *plane)):
        offsets[name] = number * np.arange(len(times))


def _type(group: h5py.Group, name: str) -> None:
    """Type of a group, as text of a fixed length in ASCII, which VTK asks for."""
    import h5py

    group.attrs.create("Type", name.encode(), dtype=h5py.string_dtype("ascii", len(name)))


def _grid(group: h5py.Group, sizes: tuple[int, ...], instants: int = 1) -> h5py.Dataset:
    """Write an unstructured grid of these sizes, and return its points, of all instants in a row."""
    connected, number = cells(sizes), int(np.prod(sizes))
    _type(group, "UnstructuredGrid")
    group["NumberOfPoints"] = np.array([number])
    group["NumberOfCells"] = np.array([len(connected)])
    group["NumberOfConnectivityIds"] = np.array([connected.size])
    group["Connectivity"] = connected.ravel()
    group["Offsets"] = np.arange(0, connected.size + 1, connected.shape[1])
    group["Types"] = np.full(len(connected), _CELLS[len(sizes)], dtype=np.uint8)
    shape, chunk = (instants * number, 3), (min(number, _CHUNK), 3)
    return group.create_dataset("Points", shape, float, chunks=chunk, compression="gzip", shuffle=True)


def _values(group: h5py.Group, dataset: xr.Dataset, dims: tuple[str, ...]) -> list[str]:
    """Write all arrays of some dimensions as values of the points, and return their names."""
    data = group.create_group("PointData", track_order=True)
    for name, values in dataset.data_vars.items():
        if values.dims == dims and np.issubdtype(values.dtype, np.number):
            array = data.create_dataset(
                str(name), data=values.values.ravel(), compression="gzip", shuffle=True
            )
            array.attrs["units"] = str(values.attrs.get("units", ""))
    return list(data)


def _points(dataset: xr.Dataset, dims: tuple[str, ...], height: xr.DataArray) -> Array:
    """Positions of all points [m], shape (n, 3); a line contact has its height in y, a point contact in z."""
    lateral = (
        dataset[dim].broadcast_like(height).transpose(*height.dims).values for dim in dims if dim != "s"
    )
    axes = *lateral, height.values
    columns = [axis.ravel() for axis in axes]
    if len(columns) == 2:
        columns.append(np.zeros(columns[0].size))
    return np.column_stack(columns)


def cells(sizes: tuple[int, ...]) -> IntArray:
    """Return the corners of all cells in VTK order, for grid points in C order.

    Examples
    --------
    >>> cells((3,)).tolist(), cells((2, 2)).tolist()
    ([[0, 1], [1, 2]], [[0, 2, 3, 1]])
    """
    numbers = np.arange(int(np.prod(sizes))).reshape(sizes)
    # Around each cell in the first two dimensions, below and then above in the third.
    around = [(0, 0), (1, 0), (1, 1), (0, 1)]
    steps: Mapping[int, list[tuple[int, ...]]] = {
        1: [(0,), (1,)],
        2: [*around],
        3: [(*step, above) for above in (0, 1) for step in around],
    }
    corners = [
        numbers[tuple(slice(k, size - 1 + k) for k, size in zip(step, sizes, strict=True))]
        for step in steps[len(sizes)]
    ]
    return np.stack([corner.ravel() for corner in corners], axis=1)


class Tabled(Protocol):
    """Result with a dataset and a summary."""

    def to_xarray(self) -> xr.Dataset:
        """Dataset of all arrays."""

    def summary(self) -> dict[str, Any]:
        """Key figures as nested tables."""


# Longest name of a variable, and largest variable that version 5 of the format holds [bytes].
_LONGEST, _LARGEST = 63, 2**31 - 1

# Variables next to the arrays.
_RESERVED = ("summary", "units", "long_names", "dims", "keys", "about")

# Words of MATLAB that are no names.
_WORDS = frozenset(
    {"break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function", "global"}
    | {"if", "otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while"}
)


def mat_file(result: Tabled) -> bytes:
    """Content of a MAT file (version 5): all arrays of a result, and its summary as a struct.

    Each array of ``result.to_xarray()`` is a variable, with its dimensions in the same order. The structs
    ``units``, ``long_names``, ``dims`` and ``keys`` have a field for each array: unit, meaning, names of its
    dimensions, and its name in the dataset. A value of the summary that has no meaning is empty.

    Raises InputError if an array is larger than 2 GB.
    """
    dataset = result.to_xarray()
    names = matlab_names([str(key) for key in dataset.variables], taken=_RESERVED)
    about: dict[str, dict[str, str]] = {key: {} for key in ("units", "long_names", "dims", "keys")}
    arrays = {}
    for key, values in dataset.variables.items():
        name = names[str(key)]
        arrays[name] = _array(str(key), values.values)
        about["units"][name] = str(values.attrs.get("units", ""))
        about["long_names"][name] = str(values.attrs.get("long_name", ""))
        about["dims"][name] = ", ".join(map(str, values.dims))
        about["keys"][name] = str(key)
    title = str(dataset.attrs.get("title", ""))
    structs = {
        "summary": _value(result.summary()),
        "about": {"title": title, "source": f"ehlectric {__version__}, SI units"},
        **about,
    }
    file = BytesIO()
    scipy.io.savemat(
        cast("Any", file), arrays | structs, long_field_names=True, do_compression=True, oned_as="column"
    )
    return file.getvalue()


def matlab_names(keys: Iterable[str], taken: Iterable[str] = ()) -> dict[str, str]:
    """Names of variables and fields in MATLAB, by the keys that they stand for; all are different.

    Examples
    --------
    >>> list(matlab_names(["film.minimum_thickness", "0.5", "end", "a-b", "a b"]).values())
    ['film_minimum_thickness', 'x0_5', 'xEnd', 'a_b', 'a_b_2']
    """
    names: dict[str, str] = {}
    used = set(taken)
    for key in keys:
        bare = re.sub(r"[^0-9A-Za-z_]", "_", key) or "x"
        if bare in _WORDS:
            bare = f"x{bare.capitalize()}"
        elif not bare[0].isalpha():
            bare = f"x{bare}"
        name, number = bare[:_LONGEST], 2
        while name in used:
            end = f"_{number}"
            name, number = bare[: _LONGEST - len(end)] + end, number + 1
        used.add(name)
        names[key] = name
    return names


def _array(key: str, values: Any) -> Any:
    """Array as MATLAB has it: texts are a cell array, other numbers unchanged."""
    array = np.asarray(values)
    if array.nbytes > _LARGEST:
        takes = "at most 2 GB in a MAT file; MATLAB reads the NetCDF file of the result by ncread"
        raise InputError(key, got=f"{readable(array.nbytes / 1e9)} GB", takes=takes)
    if array.dtype.kind in "biufc":
        return array
    return np.vectorize(str, otypes=[object])(array) if array.size else np.empty((0, 0), dtype=object)


def _value(value: Any) -> Any:
    """Value of a summary as savemat takes it; None is an empty matrix."""
    if isinstance(value, Mapping):
        names = matlab_names(map(str, value))
        return {names[str(key)]: _value(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return _listed(value)
    return np.empty((0, 0)) if value is None else value


def _listed(values: list[Any] | tuple[Any, ...]) -> Any:
    """List of a summary: a row of numbers, in which None is NaN, or a cell array of anything else."""
    if all(item is None or (isinstance(item, int | float) and not isinstance(item, bool)) for item in values):
        return np.array([[np.nan if item is None else float(item) for item in values]])
    cells = np.empty((1, len(values)), dtype=object)
    for k, item in enumerate(values):
        cells[0, k] = _value(item)
    return cells


# Contents of a file by the ending of its name.
WRITERS: Mapping[str, Callable[[Exported], bytes]] = MappingProxyType(
    {".mat": mat_file, ".vtkhdf": vtkhdf_file, ".xlsx": workbook}
)


def export(result: Exported | str | Path, path: str | Path) -> Path:
    """Write a result into a file of another program; the ending of its name says which one.

    Parameters
    ----------
    result : any result, str or Path
        Result; or the folder of a result of any kind, or its result.nc, bearing.nc, gear.nc, drive.nc,
        axle.nc or motion.nc.
    path : str or Path
        File to write; an existing one is replaced. ``.mat`` for MATLAB and Octave has all arrays and the
        summary, ``.xlsx`` for spreadsheets the summary, the inputs and the table of the result, and
        ``.vtkhdf`` for ParaView the film and the field of a contact, or its film over time. Numbers are in
        SI units, and in a workbook also in usual units, such as rpm.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If the name ends otherwise, the result cannot be read or has no such form, its table is too long for a
        spreadsheet, a package is missing, or the file cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from scipy.io import loadmat
    >>> from ehlectric import solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> result = solve({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     file = export(result, Path(folder) / "contact.mat")
    ...     values = loadmat(file, squeeze_me=True)
    >>> bool((values["thickness"] == result.film.thickness).all()), str(values["units"]["thickness"])
    (True, 'm')
    """
    path = check_target(path)
    loaded = stored(result) if isinstance(result, str | Path) else result
    write(path, WRITERS[path.suffix.lower()](loaded))
    return path


def check_target(path: str | Path) -> Path:
    """Path of a file that can be exported to. Raises InputError if the ending of its name is none of the
    formats, or its folder does not exist.
    """
    path = Path(path)
    if path.suffix.lower() not in WRITERS:
        takes = f"a name that ends in {', '.join(WRITERS)}"
        raise InputError(path, got=shown(path.suffix or "no ending"), takes=takes)
    check_file(path)
    return path


def stored(path: str | Path) -> Exported:
    """Result of a file or a folder, also of a sweep. Raises InputError if there is no result, or it cannot be
    read.
    """
    file = stored_result(path)
    return read_sweep(file.parent) if file.name == SWEEP else load(file)
