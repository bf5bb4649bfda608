"""Film and field of a contact as VTKHDF files, which ParaView and VTK read."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.contact.results import PointResult, Result
from ehlectric.errors import InputError
from ehlectric.motion.result import MotionResult
from ehlectric.runtime.netcdf import load_library
from ehlectric.version import __version__

if TYPE_CHECKING:
    import h5py
    import xarray as xr

# Version of the format, and numbers of its cells: quadrilaterals and hexahedra, by the dimensions of a grid.
_VERSION = (2, 1)
_CELLS = {1: 3, 2: 9, 3: 12}

# Largest number of points that are compressed together.
_CHUNK = 50_000


def vtkhdf_file(result: Any) -> bytes:
    """Content of a VTKHDF file in SI units: the blocks "film" and "field" of a contact, or a film over time.

    The film of a line contact is its upper surface as a line over x, with the film thickness as y; that of a
    point contact is a surface over x and y, with the film thickness as z. The field fills the gap between the
    deformed surfaces. Every array of the dataset that lies on one of both grids is a value of its points. The
    gap is thousands of times wider than high: scale its height in ParaView (Transform, Scale). With moving
    roughness the film has a time step for each recorded instant, and there is no field in the gap.

    Parameters
    ----------
    result : Result, PointResult or MotionResult
        Result of a contact.

    Raises
    ------
    InputError
        If the result is another one: it has no film and field on a grid.
    """
    if not isinstance(result, Result | PointResult | MotionResult):
        raise InputError(
            ".vtkhdf",
            "holds film and field of a contact",
            takes=".mat or .xlsx for results of bearings, drives and sweeps",
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
        own = tuple(map(str, dims))
        _grid(group, tuple(dataset.sizes[dim] for dim in own))[:] = _points(dataset, own, height)
        _values(group, dataset, own)
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
    for step, one in enumerate(film):
        points[number * step : number * (step + 1)] = _points(dataset, plane, one)
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
    """Write an unstructured grid of these sizes, and return its points, those of all instants in a row."""
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
            own = data.create_dataset(str(name), data=values.values.ravel(), compression="gzip", shuffle=True)
            own.attrs["units"] = str(values.attrs.get("units", ""))
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
    """Corners of all cells of a grid of points in the order of C, in the order of VTK.

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
