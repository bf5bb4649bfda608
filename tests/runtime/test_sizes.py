"""Files whose size, or whose values, are too large: they are refused before anything is read."""

import h5netcdf
import h5py
import numpy as np
import pytest

from ehlectric.errors import InputError
from ehlectric.runtime import sizes
from ehlectric.runtime.hdf5_guard import file_class
from ehlectric.runtime.netcdf import read_dataset
from ehlectric.runtime.reading import read_bytes
from ehlectric.runtime.sizes import check_netcdf_values, check_size


def compressed(path, values, *, chunk=10_000_000, group=""):
    """File with a compressed variable of so many values, none of which is written."""
    with h5netcdf.File(path, "w") as file:
        home = file.create_group(group) if group else file
        home.dimensions = {"x": values}
        home.create_variable("a", ("x",), "f8", compression="gzip", chunks=(min(chunk, values),))
    return path


@pytest.mark.slow
@pytest.mark.parametrize("group", ["", "inner"])
def test_a_small_file_of_five_gigabytes_of_values(tmp_path, group):
    path = compressed(tmp_path / "bomb.nc", 640_000_000, group=group)
    assert path.stat().st_size < 100_000
    with pytest.raises(InputError, match=r"bomb\.nc: holds 5\.12 GB of values in .* kB; expected at most 6"):
        read_dataset(path)


def test_a_chunk_is_larger_than_its_variable(tmp_path):
    """HDF5 decompresses a chunk as a whole, also for the few values that the variable has of it."""
    path = tmp_path / "chunk.nc"
    with h5py.File(path, "w") as file:
        file.create_dataset("a", (10,), "f8", maxshape=(None,), chunks=(400_000_000,), compression="gzip")
    with (
        h5netcdf.File(path, "r", phony_dims="sort") as file,
        pytest.raises(InputError, match=r"holds 3\.2 GB of values"),
    ):
        check_netcdf_values(path, file)


def test_texts_count_as_python_keeps_them(tmp_path):
    path = tmp_path / "texts.nc"
    with h5netcdf.File(path, "w") as file:
        file.dimensions = {"x": 50_000_000}
        file.create_variable("a", ("x",), h5py.string_dtype(), chunks=(1000,))
    with pytest.raises(InputError, match=r"holds 5 GB of values"):
        read_dataset(path)


@pytest.mark.slow
def test_values_of_ordinary_size_are_read(tmp_path):
    path = tmp_path / "map.nc"
    with h5netcdf.File(path, "w") as file:
        file.dimensions = {"x": 1000, "y": 1000}
        file.create_variable("a", ("x", "y"), "f8", data=np.zeros((1000, 1000)), compression="gzip")
    assert path.stat().st_size < 100_000
    assert read_dataset(path)["a"].shape == (1000, 1000)


def test_shapes_are_those_of_the_library(tmp_path):
    """Also of variables that are shorter than their dimension, which is as long as its longest variable."""
    path = tmp_path / "grown.nc"
    with h5netcdf.File(path, "w") as file:
        file.dimensions = {"step": None, "x": 3}
        inner = file.create_group("inner")
        inner.dimensions = {"step": None}
        for name, home, length in (("a", file, 2), ("b", file, 5), ("c", inner, 4), ("d", inner, 7)):
            home.create_variable(name, ("step", "x"), "f8")
            home.resize_dimension("step", length)
            home.variables[name][...] = np.full((length, 3), float(length))
    with h5py.File(path, "a") as file:
        file["a"].resize((1, 3))
    with h5netcdf.File(path, "r") as file, file_class()(path, "r") as read:
        assert read.variables["a"].shape == (5, 3)
        for name in ("a", "b", "inner/c", "inner/d"):
            expected, found = file[name], read[name]
            for _ in range(2):
                assert found.shape == expected.shape
                assert (found.chunks, found.dtype) == (expected.chunks, expected.dtype)
                assert np.array_equal(found[...], expected[...], equal_nan=True)


@pytest.mark.slow
def test_values_that_do_not_fit_into_the_memory(tmp_path, monkeypatch):
    """The second bound: the reader makes a copy of the values."""
    path = tmp_path / "large.nc"
    with h5netcdf.File(path, "w") as file:
        file.dimensions = {"x": 1_000_000}
        file.create_variable("a", ("x",), "f8", data=np.zeros(1_000_000))
    monkeypatch.setattr(sizes, "available_memory", lambda: 10e6)
    monkeypatch.setattr(sizes, "HARMLESS", 1_000_000)
    with pytest.raises(InputError) as error:
        read_dataset(path)
    assert error.value.text == (
        "holds 8 MB of values in 8.01 MB and needs 16 MB of memory; "
        "expected at most 10 MB, the memory of this machine"
    )


def test_a_file_is_measured_before_it_is_read(tmp_path, monkeypatch):
    path = tmp_path / "sparse"
    with path.open("wb") as file:
        file.truncate(20_000_000_000)
    with pytest.raises(InputError, match=r"sparse: has 20 GB; expected at most 5 MB$"):
        read_bytes(path, most=5_000_000)
    monkeypatch.setattr(sizes, "available_memory", lambda: 50e9)
    check_size(path, 20_000_000_000, 30_000_000_000)
    with pytest.raises(InputError, match=r"has 20 GB and needs 60 GB of memory; expected at most 50 GB"):
        read_bytes(path, most=30_000_000_000, copies=3.0)
