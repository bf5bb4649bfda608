"""Films that a run is resumed from: their layout in the file, as earlier versions wrote it, and checksum."""

import zlib

import h5netcdf
import h5py
import numpy as np
import pytest

from ehlectric.film.newton import State
from ehlectric.film.unsteady import History, Instant
from ehlectric.motion.storage import has_place, keep, kept, make_place

SHAPE = (5, 3)


def instant(seed):
    """An instant of random values."""
    random = np.random.default_rng(seed)
    state = State(random.random(SHAPE), float(random.random()), random.random(SHAPE))
    full = random.random(SHAPE) > 0.5
    return Instant(float(seed), state, random.random(SHAPE), random.random(SHAPE), full)


def history(frame):
    """History of the recorded instant of a number."""
    return History(now=instant(2 * frame + 1), before=instant(2 * frame))


@pytest.fixture
def path(tmp_path):
    with h5netcdf.File(tmp_path / "run.nc", "w") as file:
        make_place(file, history(0))
    return tmp_path / "run.nc"


def put(path, frame):
    """Keep the history of a recorded instant in a file that has room for it."""
    with h5py.File(path, "r+") as file:
        assert has_place(file, history(frame))
        keep(file, history(frame), frame)


def read(path, frames):
    """History that a file has kept, after a number of recorded instants."""
    with h5netcdf.File(path, "r") as file:
        return kept(file, frames)


def same(one, other):
    for name in ("mass", "density", "full_film"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    for name in ("pressure", "thickness", "h00"):
        np.testing.assert_array_equal(getattr(one.state, name), getattr(other.state, name))
    assert one.time == other.time
    assert one.full_film.dtype == bool


def test_what_is_kept_is_read_to_the_last_bit(path):
    put(path, 0)
    found = read(path, 1)
    same(found.now, history(0).now)
    same(found.before, history(0).before)


def test_the_films_before_stay_while_the_next_are_written(path):
    """Two places in turn: a torn write of frame 2 spoils that of frame 0, not that of frame 1."""
    for frame in range(3):
        put(path, frame)
    for frame in (1, 2):
        same(read(path, frame + 1).now, history(frame).now)
    with h5py.File(path, "r+") as file:
        variable = file["resume"]["mass"]
        variable[0] = variable[0] + 1.0
    assert read(path, 3) is None
    same(read(path, 2).now, history(1).now)


def test_nothing_is_kept_before_the_first_instant(path):
    put(path, 0)
    assert read(path, 0) is None


def test_the_layout_is_that_of_earlier_versions(path):
    """Names, types, dimensions and checksum, by hand: a run stopped before an update is resumed after it."""
    put(path, 0)
    with h5netcdf.File(path, "r") as file:
        check_layout(file.groups["resume"])


def check_layout(group):
    assert {name: size.size for name, size in group.dimensions.items()} == {
        "place": 2,
        "instant": 2,
        "along": 5,
        "across": 3,
    }
    maps = ("place", "instant", "along", "across")
    layout = {
        name: (variable.dimensions, variable.dtype.str[1:]) for name, variable in group.variables.items()
    }
    assert layout == {
        "pressure": (maps, "f8"),
        "thickness": (maps, "f8"),
        "mass": (maps, "f8"),
        "density": (maps, "f8"),
        "free": (maps, "i1"),
        "t": (maps[:2], "f8"),
        "h00": (maps[:2], "f8"),
        "checksum": (maps[:1], "i8"),
    }
    now, before = history(0).now, history(0).before
    total = 0
    for one, two in (
        (now.state.pressure, before.state.pressure),
        (now.state.thickness, before.state.thickness),
        (now.mass, before.mass),
        (now.density, before.density),
        (now.full_film.astype("i1"), before.full_film.astype("i1")),
        (now.time, before.time),
        (now.state.h00, before.state.h00),
    ):
        total = zlib.crc32(np.stack([one, two]).tobytes(), total)
    assert int(group.variables["checksum"][0]) == total
