"""Files that are not as they were written: seals, files on which HDF5 fails, and rules for what they hold."""

import fcntl
import threading

import h5netcdf
import numpy as np
import pytest
import xarray as xr

from ehlectric import InputError, load
from ehlectric.errors import DamagedError
from ehlectric.runtime import hdf5_guard, netcdf
from ehlectric.runtime.file_rules import Rule, UnfitError, check_variables, json_of, number_of, refusing
from ehlectric.runtime.files import write
from ehlectric.runtime.hdf5_guard import seal_of, sealed
from ehlectric.runtime.netcdf import Draft, content_of, read_dataset
from tests.helpers.damage import seal
from tests.helpers.each import each
from tests.helpers.places import ROOT

# Content of a result without its seal.
CONTENT = (ROOT / "tests" / "data" / "releases" / "1.0.0" / "line" / "result.nc").read_bytes()
UNSEALED = CONTENT[: -len(seal_of([b""]))]


@pytest.fixture
def damaged(tmp_path):
    """Writes a result without a seal, with other bytes at a place."""

    def put(at, content):
        path, data = tmp_path / "result.nc", bytearray(UNSEALED)
        data[at : at + len(content)] = content
        path.write_bytes(data)
        return path

    return put


def test_a_seal_tells_every_changed_byte(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"thin film")
    assert not sealed(path)
    seal(path)
    assert sealed(path)
    content = path.read_bytes()
    assert content == b"thin film" + seal_of([b"thin film"])
    for k in range(len(b"thin film")):
        path.write_bytes(content[:k] + bytes([content[k] ^ 4]) + content[k + 1 :])
        with pytest.raises(
            DamagedError, match=r"is damaged: its bytes are not those that were written; compute"
        ):
            sealed(path)


@pytest.mark.slow
def test_a_seal_is_no_obstacle_to_other_programs(tmp_path):
    path, unsealed = tmp_path / "result.nc", tmp_path / "unsealed.nc"
    path.write_bytes(UNSEALED)
    unsealed.write_bytes(UNSEALED)
    seal(path)
    with xr.open_dataset(path, engine="h5netcdf") as dataset, xr.open_dataset(unsealed) as before:
        assert dataset.load().identical(before.load())
    with h5netcdf.File(path, "a") as file:
        file.attrs["comment"] = "changed on purpose"
    assert not sealed(path)
    assert read_dataset(path).attrs["comment"] == "changed on purpose"


@pytest.mark.slow
def test_a_file_without_a_seal_is_tried_once(tmp_path, monkeypatch):
    path = tmp_path / "result.nc"
    path.write_bytes(UNSEALED)
    started = []
    run = hdf5_guard.subprocess.run
    monkeypatch.setattr(hdf5_guard.subprocess, "run", lambda *a, **k: started.append(a) or run(*a, **k))
    assert read_dataset(path).identical(read_dataset(path))
    assert len(started) == 1
    seal(path)
    read_dataset(path)
    assert len(started) == 1


@pytest.mark.slow
def test_a_file_that_keeps_hdf5_busy_for_ever(damaged, monkeypatch):
    """Zeros in the texts of attributes: HDF5 looks for the next one without end, and no signal ends it."""
    monkeypatch.setattr(hdf5_guard, "_LIMIT", 1.0)
    path = damaged(UNSEALED.index(b"units of p/p_h") + 14, bytes(64))
    with pytest.raises(DamagedError, match=r"is damaged: HDF5 reads it without end; compute it again$"):
        read_dataset(path)


def test_a_file_on_which_hdf5_crashes(damaged, monkeypatch):
    monkeypatch.setattr(hdf5_guard, "_CODE", "import os; os.abort()")
    with pytest.raises(DamagedError, match=r"is damaged: HDF5 crashes on it; compute it again$"):
        read_dataset(damaged(0, b""))


@pytest.mark.slow
def test_a_file_that_is_held_open_by_others(damaged, monkeypatch):
    monkeypatch.setattr(netcdf, "_PATIENCE", 0.0)
    path = damaged(0, b"")
    with path.open("r+b") as holder:
        fcntl.flock(holder, fcntl.LOCK_EX)
        with pytest.raises(InputError, match=r"is held open by another program, which must close it$"):
            read_dataset(path)
    assert read_dataset(path).sizes["x"] == 101


@pytest.mark.slow
@pytest.mark.parametrize("in_thread", [False, True])
def test_nothing_of_the_library_is_printed(damaged, capfd, in_thread):
    path, caught = damaged(96, b"\xff" * 8), []

    def reads():
        try:
            load(path)
        except InputError as error:
            caught.append(str(error))

    if in_thread:
        thread = threading.Thread(target=reads)
        thread.start()
        thread.join()
    else:
        reads()
    assert caught == [f"{path}: is damaged: HDF5 cannot read it; compute it again"]
    assert capfd.readouterr() == ("", "")


@each("seed", range(4))
def test_a_draft_is_a_file_that_grows(seed, tmp_path):
    """Random operations on a draft and on a file of the disk."""
    draw = np.random.default_rng(seed)
    paths = [tmp_path / f"{name} {seed}" for name in ("file", "draft")]
    with paths[0].open("w+b") as file, paths[1].open("w+b") as target:
        draft = Draft(target)
        for _ in range(200):
            some = draw.bytes(int(draw.integers(0, 50)))
            size = int(draw.integers(0, 200))
            name, value = [("seek", size), ("write", some), ("read", 20), ("truncate", size)][
                draw.integers(4)
            ]
            assert getattr(draft, name)(value) == getattr(file, name)(value), name
            assert draft.tell() == file.tell()
        file.flush()
        assert draft.failure is None
        assert paths[1].read_bytes() == paths[0].read_bytes()


def test_a_disk_that_is_full_is_told_after_hdf5_has_closed_the_file(tmp_path, monkeypatch):
    """An error within HDF5 would end the process; no disk has room for a file of 2**63 - 1 bytes."""
    writes = []

    class Large(Draft):
        def write(self, content):
            writes.append(content)
            place = self.tell()
            self.seek(2**63 - 1 if len(writes) == 3 else place)
            done = super().write(content)
            self.seek(place + done)
            return done

    monkeypatch.setattr(netcdf, "Draft", Large)
    with pytest.raises(InputError, match="cannot be written to"):
        write(tmp_path / "film.nc", content_of(FILM))
    assert len(writes) > 3
    assert not list(tmp_path.iterdir())


FILM = xr.Dataset(
    {"x": ("x", [0.0, 1.0, 2.0]), "h": ("x", [1.0, 2.0, 3.0], {"units": "m"}), "on": ("x", [0, 1, 1])}
)
RULES = {
    "x": Rule(("x",), "increasing"),
    "h": Rule(("x",), "positive", "m"),
    "on": Rule(("x",), "0 or 1"),
    "oil": Rule(("x",), "0 to 1", needed=False),
    "flow": Rule(("x",), "not negative", needed=False),
}


@each(
    "edited, says",
    [
        (FILM.drop_vars("h"), "h is missing"),
        (FILM.assign(h=("x", [1.0, np.nan, 3.0])), "h is not positive"),
        (FILM.assign(h=("x", [1.0, 0.0, 3.0])), "h is not positive"),
        (FILM.assign(h=("x", [1.0, 1e300, 3.0])), "h is not positive"),
        (FILM.assign(h=("x", ["1", "2", "3"])), "h is not numbers"),
        (FILM.assign(h=("x", [1.0, 2.0, 3.0], {"units": "um"})), "h is not in m"),
        (FILM.assign(h=(("x", "s"), np.ones((3, 2)))), "h is over (x, s), not (x)"),
        (FILM.assign(on=("x", [0, 2, 1])), "on is not 0 or 1"),
        (FILM.assign(oil=("x", [0.5, 1.0, 1.1])), "oil is not from 0 to 1, but 1.1"),
        (FILM.assign(oil=("x", [0.5, np.nan, 1.0])), "oil is not from 0 to 1"),
        (FILM.assign(flow=("x", [0.5, -4e-16, 1.0])), "flow is negative, -4e-16"),
        (FILM.assign_coords(x=[0.0, 2.0, 1.0]), "x is not increasing"),
        (FILM.isel(x=slice(0, 1)), "x has 1 values along x"),
    ],
)
def test_a_rule_names_the_variable_that_breaks_it(edited, says):
    check_variables(FILM, RULES, {"x": 2})
    with pytest.raises(UnfitError) as caught:
        check_variables(edited, RULES, {"x": 2})
    assert str(caught.value) == says


def test_texts_and_numbers_of_attributes(tmp_path):
    for attributes, says in (
        ({}, "seconds is missing"),
        ({"seconds": 3}, "seconds is not a text"),
        ({"seconds": "[1,"}, "seconds is no JSON"),
        ({"seconds": "[" * 100_000}, "seconds is no JSON"),
        ({"seconds": "7"}, "seconds is not as it was written"),
    ):
        with pytest.raises(UnfitError, match=f"^{says}$"):
            json_of(attributes, "seconds", lambda value: isinstance(value, list))
    wrong = (
        ("x", "not a number"),
        ([1.0, 2.0], "not a number"),
        (-1.0, "negative, -1"),
        (1e40, "not finite"),
    )
    for number, says in wrong:
        with pytest.raises(UnfitError, match=f"^seconds is {says}$"):
            number_of({"seconds": number}, "seconds")
    with (
        pytest.raises(DamagedError, match=r"^\S+: is damaged: its values do not fit together; compute"),
        refusing(tmp_path / "f"),
    ):
        _ = 1 / 0
