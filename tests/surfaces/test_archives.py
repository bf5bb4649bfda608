"""Archives that state wrong sizes, and small ones that hold much: decompression ends at its bound."""

import struct
import tracemalloc
import zipfile

import numpy as np
import pytest

from ehlectric.errors import InputError
from ehlectric.runtime import sizes
from ehlectric.surfaces import surface_files
from ehlectric.surfaces.surface_files import member, opened, read_surface
from tests.helpers.each import each
from tests.helpers.surface_writers import MAP, description, x3p

PACKS = [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA]


def traced(call):
    """Result of a call, or its error, and the peak of the memory that it took [bytes]."""
    tracemalloc.start()
    try:
        result = call()
    except (InputError, zipfile.BadZipFile, ValueError) as error:
        result = error
    finally:
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    return result, peak


@each("pack", PACKS)
def test_members_are_those_of_pythons_reader(tmp_path, pack):
    path = x3p(tmp_path / "a.x3p", MAP, pack=pack)
    content = path.read_bytes()
    archive = opened(content)
    for name in archive.namelist():
        assert member(archive, content, name, 10_000) == archive.read(name)
    with pytest.raises(ValueError, match=r"main\.xml"):
        member(archive, content, "main.xml", 10)


@pytest.mark.slow
def test_a_small_file_of_a_hundred_million_points(tmp_path):
    """0.78 MB of zeros, 800 MB as numbers."""
    path = tmp_path / "bomb.x3p"
    table = description(np.zeros((1, 1)), SizeX=10_000, SizeY=10_000)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", table)
        with archive.open("bindata/data.bin", "w", force_zip64=True) as file:
            for _ in range(100):
                file.write(bytes(8_000_000))
    assert path.stat().st_size < 1_000_000
    error, peak = traced(lambda: read_surface(path))
    assert isinstance(error, InputError)
    assert "bomb.x3p: 'bindata/data.bin' holds 800 MB" in str(error)
    assert peak < 10e6


@pytest.mark.slow
@pytest.mark.parametrize("pack", PACKS[1:])
def test_a_member_that_is_larger_than_it_says(tmp_path, pack):
    """20 MB under the size of the map: the reader ends where the map is full, and refuses the rest."""
    path = x3p(tmp_path / "lies.x3p", MAP, pack=pack, data=bytes(20_000_000))
    content = bytearray(path.read_bytes())
    entry = content.rfind(b"PK\x01\x02")
    struct.pack_into("<I", content, entry + 24, MAP.size * 8)
    path.write_bytes(content)
    error, peak = traced(lambda: read_surface(path))
    assert isinstance(error, InputError)
    assert peak < 12e6  # the dictionary of LZMA takes 8 MB


def test_an_archive_of_too_many_members():
    with pytest.raises(zipfile.BadZipFile, match="too many"):
        opened(b"PK\x01\x02" * 10_001)


@each("name", ["sparse.csv", "sparse.x3p", "sparse.al3d", "sparse.nc", "sparse.npy"])
def test_a_sparse_file_of_twenty_gigabytes(tmp_path, name):
    path = tmp_path / name
    with path.open("wb") as file:
        file.write({"sparse.csv": b"x;z\n" * 2000, "sparse.npy": b"\x93NUMPY\0"}.get(name, b"\0"))
        file.truncate(20_000_000_000)
    most = "100 MB" if name == "sparse.csv" else "1 GB"
    error, peak = traced(lambda: read_surface(path))
    assert str(error).startswith(f"{path}: ")
    assert "20 GB" in str(error)
    assert str(error).endswith(most)
    assert peak < 1e6


def test_a_map_that_does_not_fit_into_the_memory(tmp_path, monkeypatch):
    path = x3p(tmp_path / "a.x3p", MAP)
    read_surface(path)
    monkeypatch.setattr(sizes, "available_memory", lambda: 10_000.0)
    with pytest.raises(InputError, match=r"20 x 31 .* 11\.2 kB .* 10 kB"):
        surface_files.read_x3p(path, path.read_bytes())
