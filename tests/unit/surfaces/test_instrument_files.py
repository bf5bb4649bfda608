"""X3P and AL3D that are unusual, wrong, broken or hostile: read as they are meant, or refused in one line."""

import os
import zipfile

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.surfaces.files import read_surface
from tests.helpers.each import each
from tests.helpers.surface_writers import KINDS, MAP, al3d, x3p


def test_points_that_are_not_valid_are_voids(tmp_path):
    """One bit a point, the lowest of a byte first, in the order of the heights."""
    valid = np.ones(MAP.shape, bool)
    valid[3, 10:14] = False
    counts = np.round(MAP / 1e-10)
    counts[~valid] = -32768
    mask = np.packbits(valid.ravel(), bitorder="little").tobytes()
    path = x3p(tmp_path / "a.x3p", counts, mask=mask, CZ_DataType="I", CZ_Increment="1e-10")
    surface = read_surface(path)
    np.testing.assert_array_equal(np.isnan(surface.heights), ~valid)
    np.testing.assert_allclose(surface.heights[valid], MAP[valid], atol=0.5001e-10)
    assert surface.line_voids(3) == pytest.approx(4 / 31)
    assert surface.line_voids(11, along="column") == pytest.approx(1 / 20)
    assert np.max(np.abs(surface.line(3).heights)) < 5e-8


@each("kind", KINDS)
def test_increment_and_offset_of_heights(tmp_path, kind):
    """Offset + Increment times what is stored, as in the schema of openGPS."""
    path = x3p(
        tmp_path / "a.x3p", np.round(MAP / 1e-10), CZ_DataType=kind, CZ_Increment="1e-10", CZ_Offset="2e-3"
    )
    np.testing.assert_allclose(read_surface(path).heights, MAP + 2e-3, atol=0.5001e-10)


@pytest.mark.parametrize("increment", ["0", None, "1"])
def test_a_profile_has_no_second_spacing(tmp_path, increment):
    changes = {"FeatureType": "PRF", "CY_Increment": increment}
    surface = read_surface(x3p(tmp_path / "a.x3p", MAP.reshape(1, -1), **changes))
    assert (surface.spacing_x, surface.spacing_y) == (1.5e-7, None)
    np.testing.assert_array_equal(surface.line().heights, MAP.ravel())


WRONG_X3P = [
    ({"SizeZ": 2}, "has 2 heights at each point"),
    ({"CX_AxisType": "A"}, "axis CX is of type 'A'; expected 'I'"),
    ({"CY_AxisType": "A"}, "axis CY is of type 'A'; expected 'I'"),
    ({"CZ_AxisType": "I"}, "axis CZ is of type 'I'; expected 'A'"),
    ({"CX_AxisType": None}, "axis CX is of type ''"),
    ({"FeatureType": "PCL"}, "is of the type 'PCL'"),
    ({"CZ_DataType": "X"}, "heights are of type 'X'; expected one of D, F, L, I"),
    ({"CZ_DataType": "I"}, "CZ/Increment is ''; expected a number"),
    ({"CZ_Increment": "0"}, "increment of its heights is 0; expected a positive one"),
    ({"CZ_Increment": "nan"}, "CZ/Increment is 'nan'"),
    ({"CZ_Increment": "1e300"}, "expected up to 10 m"),
    ({"CX_Increment": None}, "CX/Increment is ''; expected a number"),
    ({"CX_Increment": "inf"}, "CX/Increment is 'inf'"),
    ({"CX_Increment": "0"}, "its points are 0 m apart along x"),
    ({"CY_Increment": "0"}, "its points are 0 m apart along y"),
    ({"CX_Increment": "-1e-7"}, "its points are -1e-07 m apart along x"),
    ({"CX_Increment": "1,5e-7"}, "CX/Increment is '1,5e-7'"),
    ({"SizeX": -31, "SizeY": -20}, "SizeX is '-31'; expected a whole number from 1"),
    ({"SizeX": 0}, "SizeX is '0'"),
    ({"SizeX": None}, "SizeX is ''; expected a whole number"),
    ({"SizeY": "1e1"}, "SizeY is '1e1'"),
    ({"SizeX": 10**12}, "SizeX is '1000000000000'"),
    ({"SizeX": 10**5, "SizeY": 10**5}, "expected at most 100000000"),
    ({"SizeX": 32}, "has 4960 bytes; expected 5120"),
    ({"data": b"\0" * 100_000, "pack": zipfile.ZIP_DEFLATED}, "has 100000 bytes; expected 4960"),
    ({"mask": b"\xff"}, "'bindata/valid.bin' has 1 bytes; expected 78"),
    ({"ValidPointsLink": "no.bin"}, "ValidPointsLink is 'no.bin', which cannot be read"),
    ({"PointDataLink": "no.bin"}, "PointDataLink is 'no.bin', which cannot be read"),
    ({"encoding": "foo"}, "is not a complete X3P"),
    ({"encoding": "gbk"}, "is not a complete X3P"),
    ({"FeatureType": "S" * 11_000_000, "pack": zipfile.ZIP_DEFLATED}, "is not a complete X3P"),
]  # fmt: skip


@each("changes, message", WRONG_X3P)
def test_wrong_x3p_is_refused_in_words(tmp_path, changes, message):
    with pytest.raises(InputError, match=message) as caught:
        read_surface(x3p(tmp_path / "a.x3p", MAP, **changes))
    assert "\n" not in str(caught.value)


def test_encrypted_and_text_that_begins_alike(tmp_path):
    content = bytearray(x3p(tmp_path / "a.x3p", MAP).read_bytes())
    content[content.find(b"PK\x03\x04") + 6] |= 1
    content[content.find(b"PK\x01\x02") + 8] |= 1
    (tmp_path / "a.x3p").write_bytes(content)
    with pytest.raises(InputError, match="not a complete X3P"):
        read_surface(tmp_path / "a.x3p")
    (tmp_path / "a.txt").write_text("PK 12\n" + "\n".join(f"{k};0" for k in range(20)))
    assert read_surface(tmp_path / "a.txt", x_unit="um", z_unit="nm").heights.shape == (1, 20)


def test_void_that_is_zero(tmp_path):
    """Only the very value is void, not all that is near to nothing in metres."""
    heights = MAP.copy()
    heights[2, 7] = 0.0
    surface = read_surface(al3d(tmp_path / "a.al3d", heights, InvalidPixelValue="0"))
    assert np.argwhere(np.isnan(surface.heights)).tolist() == [[2, 7]]


WRONG_AL3D = [
    ({"PixelSizeXMeter": "0"}, "points are 0 m apart along x"),
    ({"PixelSizeXMeter": "nan"}, "points are nan m apart along x"),
    ({"PixelSizeYMeter": "inf"}, "points are inf m apart along y"),
    ({"DepthImageOffset": "-50"}, "at the byte -50; expected positive"),
    ({"Cols": "0"}, "20 x 0 points"),
    ({"Rows": "-1"}, "-1 x 31 points"),
    ({"Rows": "x"}, "its header lacks"),
]


@each("changes, message", WRONG_AL3D)
def test_wrong_al3d_is_refused_in_words(tmp_path, changes, message):
    with pytest.raises(InputError, match=message):
        read_surface(al3d(tmp_path / "a.al3d", **changes))


@pytest.mark.parametrize("name", ["x_unit", "z_unit"])
def test_units_of_files_that_have_their_own(tmp_path, name):
    for path in (x3p(tmp_path / "a.x3p", MAP), al3d(tmp_path / "a.al3d")):
        with pytest.raises(InputError, match=f"{name}: got 'um', but .* has its own unit"):
            read_surface(path, **{name: "um"})


def test_pipes_are_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    with pytest.raises(InputError, match="it is a pipe, not a regular file"):
        read_surface(tmp_path / "pipe.csv")
    with pytest.raises(InputError, match="is a directory"):
        read_surface(tmp_path)
    with pytest.raises(InputError, match="is not a path"):
        read_surface("a\0b")


PACKS = {
    "stored": zipfile.ZIP_STORED,
    "deflated": zipfile.ZIP_DEFLATED,
    "bzip2": zipfile.ZIP_BZIP2,
    "lzma": zipfile.ZIP_LZMA,
}


@pytest.mark.parametrize("kind", [*PACKS, "al3d", "text"])
def test_any_changed_byte_is_read_or_refused(tmp_path, kind):
    """No file, whatever is in it, may end in a traceback."""
    path = tmp_path / {"al3d": "a.al3d", "text": "a.txt"}.get(kind, "a.x3p")
    if kind == "al3d":
        al3d(path)
    elif kind == "text":
        path.write_text("x [um];z [nm];valid\n" + "\n".join(f"{0.5 * k};{k % 3}.5;1" for k in range(99)))
    else:
        x3p(path, MAP, mask=b"\xff" * 78, pack=PACKS[kind], CZ_Offset="1e-6")
    whole = path.read_bytes()
    random = np.random.default_rng(5)
    head = min(len(whole), 1000)
    places = [*random.integers(len(whole), size=150), *random.integers(head, size=150), *range(-150, 0)]
    for place in places:
        changed = bytearray(whole)
        changed[place] = random.integers(256)
        path.write_bytes(changed)
        try:
            read_surface(path).line()
        except InputError as error:
            assert "\n" not in str(error)  # noqa: PT017
