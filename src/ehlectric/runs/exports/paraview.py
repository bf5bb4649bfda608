"""Film and field of a contact as VTKHDF files, which ParaView and VTK read."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.contact.results import PointResult, Result
from ehlectric.errors import InputError
from ehlectric.runtime.netcdf import load_library
from ehlectric.version import __version__

if TYPE_CHECKING:
    import h5py
    import xarray as xr

# Version of the format, and numbers of its cells: quadrilaterals and hexahedra, by the dimensions of a grid.
_VERSION = (2, 1)
_CELLS = {1: 3, 2: 9, 3: 12}


def vtkhdf_file(result: Any) -> bytes:
    """Content of a VTKHDF file: the blocks "film" and "field" of a contact, in SI units.

    The film of a line contact is its upper surface as a line over x, with the film thickness as y; that of a
    point contact is a surface over x and y, with the film thickness as z. The field fills the gap between the
    deformed surfaces. Every array of the dataset that lies on one of both grids is a value of its points. The
    gap is thousands of times wider than high: scale its height in ParaView (Transform, Scale).

    Parameters
    ----------
    result : Result or PointResult
        Result of a contact.

    Raises
    ------
    InputError
        If the result is another one: it has no film and field on a grid.
    """
    if not isinstance(result, Result | PointResult):
        raise InputError(
            ".vtkhdf",
            "holds film and field of a contact",
            takes=".mat or .xlsx for results of bearings, drives, sweeps and moving roughness",
        )
    load_library()
    import h5py

    dataset = result.to_xarray()
    plane = ("x",) if "y_field" not in dataset.dims else ("x", "y")
    heights = dataset["y" if len(plane) == 1 else "z"]
    blocks = {"film": (plane, dataset["thickness"]), "field": (heights.dims, heights)}
    file = BytesIO()
    with h5py.File(file, "w", track_order=True) as target:
        root = target.create_group("VTKHDF", track_order=True)
        root.attrs["Version"] = np.array(_VERSION)
        _type(root, "PartitionedDataSetCollection")
        assembly = root.create_group("Assembly", track_order=True)
        for index, (name, (dims, height)) in enumerate(blocks.items()):
            group = root.create_group(name, track_order=True)
            group.attrs["Index"] = index
            _grid(group, dataset, tuple(map(str, dims)), height)
            # A node of its own: VTK before 9.6 takes no names from the blocks themselves.
            assembly.create_group(name, track_order=True)[name] = h5py.SoftLink(f"/VTKHDF/{name}")
        target.attrs["source"] = f"ehlectric {__version__}, SI units"
        target.attrs["title"] = str(dataset.attrs.get("title", ""))
    return file.getvalue()


def _type(group: h5py.Group, name: str) -> None:
    """Type of a group, as text of a fixed length in ASCII, which VTK asks for."""
    import h5py

    group.attrs.create("Type", name.encode(), dtype=h5py.string_dtype("ascii", len(name)))


def _grid(group: h5py.Group, dataset: xr.Dataset, dims: tuple[str, ...], height: xr.DataArray) -> None:
    """Unstructured grid of all points of some dimensions, with the arrays that lie on them."""
    sizes = tuple(dataset.sizes[dim] for dim in dims)
    points = _points(dataset, dims, height)
    connected = cells(sizes)
    group.attrs["Version"] = np.array(_VERSION)
    _type(group, "UnstructuredGrid")
    group["NumberOfPoints"] = np.array([len(points)])
    group["NumberOfCells"] = np.array([len(connected)])
    group["NumberOfConnectivityIds"] = np.array([connected.size])
    group["Points"] = points
    group["Connectivity"] = connected.ravel()
    group["Offsets"] = np.arange(0, connected.size + 1, connected.shape[1])
    group["Types"] = np.full(len(connected), _CELLS[len(sizes)], dtype=np.uint8)
    data = group.create_group("PointData", track_order=True)
    for name, values in dataset.data_vars.items():
        if values.dims == dims and np.issubdtype(values.dtype, np.number):
            own = data.create_dataset(str(name), data=values.values.ravel(), compression="gzip", shuffle=True)
            own.attrs["units"] = str(values.attrs.get("units", ""))


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
