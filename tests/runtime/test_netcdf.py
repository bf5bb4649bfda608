"""NetCDF files that are written without xarray, against those that xarray writes of the same variables."""

import io
import tracemalloc

import numpy as np
import pytest

from ehlectric.runtime.files import write
from ehlectric.runtime.netcdf import Layout, Stack, content_of, opened, read_dataset

# Numbers with a missing one, whole numbers, truths, texts, a scalar, and a coordinate that is no dimension.
LAYOUT = Layout(
    {
        "x": ("x", np.array([0.0, 1.0, 2.0]), {"units": "m"}),
        "load": ("x", np.array([5.0, 6.0, 7.0]), {"units": "N", "long_name": "load"}),
        "y": ("y", np.array([1, 2], dtype=np.int64)),
        "film": (("x", "y"), np.array([[1.0, np.nan], [2.0, 3.0], [4.0, 5.0]]), {"units": "m"}),
        "single": ("x", np.array([1.0, 2.0, 3.0], dtype=np.float32)),
        "solved": ("x", np.array([True, False, True])),
        "names": ("x", np.array(["inner", "", "outer"], dtype=object)),
        "count": ((), 3),
        "none": ("empty", np.zeros(0)),
    },
    {"title": "A bearing", "schema": 4, "error": 0.25, "list": np.array([1.0, 2.0])},
    coordinates=("load",),
)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Paths of the file that the layout writes itself, and of that of its dataset."""
    paths = [tmp_path_factory.mktemp("netcdf") / name for name in ("own.nc", "xarray.nc")]
    for path, content in zip(paths, (LAYOUT, LAYOUT.dataset()), strict=True):
        target = io.BytesIO()
        content_of(content)(target)
        path.write_bytes(target.getvalue())
    return paths


def test_a_layout_is_read_as_the_dataset_of_xarray(files):
    own, other = map(read_dataset, files)
    assert own.identical(other)
    assert own.identical(LAYOUT.dataset())
    for name in own.variables:
        assert own[name].dtype == other[name].dtype, name


def test_a_layout_is_stored_as_xarray_stores_it(files):
    """Types, fill values and attributes of every variable are the same, which other programs read."""

    def stored(path):
        with opened(path) as file:
            return {
                name: (
                    variable.dimensions,
                    variable.dtype,
                    {key: np.asarray(value).tolist() for key, value in sorted(variable.attrs.items())},
                )
                for name, variable in file.variables.items()
            }

    own, other = map(stored, files)
    assert repr(own) == repr({name: other[name] for name in own})
    assert own.keys() == other.keys()


def test_a_stack_is_written_entry_by_entry(tmp_path):
    """Forty entries of a megabyte take the memory of a few of them; all of them arrive in their order."""
    entry = np.arange(250_000, dtype=np.float32)
    stack = Stack((40, entry.size), entry.dtype, lambda: (entry + k for k in range(40)))
    layout = Layout({"p": (("frame", "x"), stack)}, {}, storage={"p": {"chunks": (1, entry.size)}})
    write(tmp_path / "a.nc", content_of(LAYOUT))  # loads the libraries
    tracemalloc.start()
    try:
        write(tmp_path / "p.nc", content_of(layout))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 8 * entry.nbytes
    expected = entry + np.arange(40, dtype=np.float32)[:, np.newaxis]
    np.testing.assert_array_equal(read_dataset(tmp_path / "p.nc")["p"], expected)
    np.testing.assert_array_equal(layout.dataset()["p"], expected)
