"""Drafts of files: the same bytes as of a file, and all changes or none on the disk."""

import errno
import io
import os

import h5netcdf
import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.runtime import drafts, netcdf
from ehlectric.runtime.drafts import Draft, redo_file
from tests.helpers.each import each


@each("seed", range(8))
def test_a_draft_is_a_file(seed, tmp_path, monkeypatch):
    """Random operations on a draft and on Python's own file in memory."""
    monkeypatch.setattr(drafts, "_PAGE", 16)
    draw = np.random.default_rng(seed)
    content = draw.bytes(int(draw.integers(0, 100)))
    path = tmp_path / f"file {seed}"
    path.write_bytes(content)
    with path.open("r+b") as file:
        draft, expected = Draft(file.fileno()), io.BytesIO(content)
        for _ in range(200):
            match int(draw.integers(4)):
                case 0:
                    place = int(draw.integers(0, 120)), io.SEEK_SET
                    assert draft.seek(*place) == expected.seek(*place)
                case 1:
                    some = draw.bytes(int(draw.integers(0, 50)))
                    assert draft.write(some) == expected.write(some)
                case 2:
                    size = int(draw.integers(-1, 50))
                    assert draft.read(size) == expected.read(size)
                case _:
                    # The file in memory does not grow by truncation.
                    size = int(draw.integers(0, len(expected.getvalue()) + 1))
                    assert draft.truncate(size) == expected.truncate(size)
            assert draft.tell() == expected.tell()
            assert draft.seek(0, io.SEEK_END) == len(expected.getvalue())
            draft.seek(expected.tell())
        assert path.read_bytes() == content
        assert b"".join(draft.content()) == expected.getvalue()
        draft.apply()
    assert path.read_bytes() == expected.getvalue()


@pytest.fixture
def grown(tmp_path):
    """A file of a series of maps, and a function that adds a map to it."""
    path = tmp_path / "maps.nc"

    def lay_out(file):
        file.dimensions = {"frame": None, "x": 40_000}
        file.create_variable("map", ("frame", "x"), "f8", chunks=(1, 40_000))
        file.create_variable("time", ("frame",), "f8", chunks=(8,))

    netcdf.create(path, lay_out)

    def grow(frame):
        with netcdf.changed(path) as draft, netcdf.values_in(draft) as file:
            for name in ("frame", "map", "time"):
                file[name].resize(frame + 1, axis=0)
            file["map"][frame] = np.full(40_000, frame)
            file["time"][frame] = frame

    return path, grow


def frames(path):
    with h5netcdf.File(path, "r") as file:
        times = np.asarray(file.variables["time"][:])
        np.testing.assert_array_equal(np.asarray(file.variables["map"][:])[:, 0], times)
        return times.tolist()


def test_a_file_grows(grown):
    path, grow = grown
    for frame in range(20):
        grow(frame)
    assert frames(path) == list(range(20))


@pytest.mark.parametrize("room", [0, 1000, 70_000, 319_999])
def test_a_file_for_which_the_disk_has_no_room_stays_as_it_was(grown, monkeypatch, room):
    """A map has 320 000 bytes."""
    path, grow = grown
    grow(0)
    before, put = path.read_bytes(), os.write

    def limited(number, content):
        nonlocal room
        if not room:
            raise OSError(errno.ENOSPC, "No space left on device")
        written = put(number, memoryview(content)[:room])
        room -= written
        return written

    with monkeypatch.context() as patch:
        patch.setattr("os.write", limited)
        with pytest.raises(InputError, match=r"maps\.nc: cannot be written to, no space left on device; f"):
            grow(1)
    assert path.read_bytes() == before
    grow(1)
    assert frames(path) == [0, 1]


def test_a_file_is_read_where_a_kill_came_before_its_old_part_was_changed(grown, monkeypatch):
    """What makes the file longer is written first, and does not count yet."""
    path, grow = grown
    grow(0)

    class KilledError(BaseException):
        pass

    def kill(_number):
        raise KilledError

    with monkeypatch.context() as patch:
        patch.setattr(drafts, "flush", kill)
        with pytest.raises(KilledError):
            grow(1)
    assert frames(path) == [0]
    grow(1)
    assert frames(path) == [0, 1]


@pytest.mark.slow
@pytest.mark.gate
def test_a_kill_at_any_write_leaves_the_old_or_the_new_file(grown, monkeypatch):
    """Each write of a change is the last one in turn; the next reader finds the file before or after it."""
    path, grow = grown
    grow(0)
    before, seen = path.read_bytes(), []

    class KilledError(BaseException):
        pass

    for last in range(100):
        calls = iter(range(last))
        put = os.write

        def until(number, content, calls=calls, put=put):
            if next(calls, None) is None:
                put(number, memoryview(content)[: len(content) // 2])  # a part of it arrives
                raise KilledError
            return put(number, content)

        with monkeypatch.context() as patch:
            patch.setattr("os.write", until)
            try:
                grow(1)
            except KilledError:
                ended = False
            else:
                ended = True
        with netcdf.opened(path) as file:
            seen.append(np.asarray(file.variables["time"][:]).tolist())
            assert np.asarray(file.variables["map"][:])[:, 0].tolist() == seen[-1]
        assert [entry.name for entry in path.parent.iterdir()] == ["maps.nc"]
        if ended:
            break
        path.write_bytes(before)
    assert ended
    # First the file as it was; once the changes are written down, the new one.
    assert seen == sorted(seen)
    assert seen[0] == [0.0]
    assert seen[-2] == [0.0, 1.0]


def test_changes_of_a_file_that_was_replaced_are_forgotten(grown, monkeypatch):
    path, grow = grown
    grow(0)
    replaced = path.with_name("other.nc")
    replaced.write_bytes(path.read_bytes())
    monkeypatch.setattr(drafts, "make", lambda *_: None)  # a kill before the changes, but behind their list
    monkeypatch.setattr("ehlectric.runtime.netcdf.redo_file", lambda _: path.with_name("nothing"))
    path.with_name("nothing").touch()
    grow(1)
    monkeypatch.undo()
    assert redo_file(path).is_file()
    replaced.replace(path)
    with netcdf.opened(path) as file:
        assert np.asarray(file.variables["time"][:]).tolist() == [0.0]
    assert not redo_file(path).exists()


def test_a_disk_that_is_nearly_full_is_refused_before_anything_is_written(grown, monkeypatch):
    path, grow = grown
    usage = type("Usage", (), {"free": 300_000})
    monkeypatch.setattr("shutil.disk_usage", lambda _: usage)
    before = path.read_bytes()
    with pytest.raises(InputError, match=r"maps\.nc: cannot be written to, no space left"):
        grow(0)
    assert path.read_bytes() == before


def test_memory_that_runs_out_is_told_after_hdf5_has_closed_the_file(grown, monkeypatch):
    """An error within HDF5 would end the process."""
    path, _ = grown
    before = path.read_bytes()

    def exhausted(_self, _page):
        raise MemoryError

    monkeypatch.setattr(Draft, "_stored", exhausted)
    with path.open("r+b") as file:
        draft = Draft(file.fileno())
        draft.write(b"some")
        with pytest.raises(MemoryError):
            draft.apply()
    assert path.read_bytes() == before
