"""X3P and AL3D that are unusual, wrong, broken or hostile: read as they are meant, or refused in one line."""

import os
import sys
import zipfile

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.surfaces.surface_files import read_surface
from tests.helpers.each import each
from tests.helpers.surface_writers import KINDS, MAP, al3d, plux, wsxm, x3p


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
    """Offset + Increment times an integer, and Offset + a float: iso5436_2.xsd of openGPS."""
    whole = kind in "IL"
    stored = np.round(MAP / 1e-10) if whole else MAP
    path = x3p(tmp_path / "a.x3p", stored, CZ_DataType=kind, CZ_Increment="1e-10", CZ_Offset="2e-6")
    surface = read_surface(path)
    np.testing.assert_allclose(surface.heights, MAP + 2e-6, rtol=1e-6, atol=0.5001e-10)
    assert [warning.code for warning in surface.warnings] == ([] if whole else ["increment-unused"])


def test_floats_that_are_no_metres_are_refused(tmp_path):
    """Counts as floats with an increment: metres by the standard, nanometres by the increment."""
    path = x3p(tmp_path / "a.x3p", np.round(MAP / 1e-10), CZ_Increment="1e-10")
    with pytest.raises(InputError, match=r"'1e-10'.*25178-72"):
        read_surface(path)


LISTED = {"PointDataLink": None, "CZ_DataType": "D"}


@each("form", ["{z!r}", "{column};{row};{z!r}", " {z:e} "])
@each("folder", ["", "sample/", "a/b/"])
def test_heights_as_a_list_in_any_folder(tmp_path, form, folder):
    """Items of DataList: the height, or X;Y;Z after iso5436_2.xsd; an empty item is a point without data."""
    rows, columns = MAP.shape
    items = [form.format(z=float(MAP[k]), row=k[0], column=k[1]) for k in np.ndindex(rows, columns)]
    items[40] = ""
    surface = read_surface(x3p(tmp_path / "a.x3p", MAP, items=items, folder=folder, **LISTED))
    expected = MAP.copy()
    expected.flat[40] = np.nan
    np.testing.assert_allclose(surface.heights, expected, rtol=1e-6)


def test_lists_that_are_wrong(tmp_path):
    items = [repr(float(z)) for z in MAP.ravel()]
    for wrong, message in (
        (items[:-1], "619 .* 620"),
        ([*items[:7], "word", *items[8:]], "item 8 .*'word'"),
        ([*items[:7], "0;0;1e-9", *items[8:]], "item 8 .*'0;0;1e-9'"),
    ):
        with pytest.raises(InputError, match=message):
            read_surface(x3p(tmp_path / "a.x3p", MAP, items=wrong, **LISTED))


@each("folder", ["sample/", "a\\b\\"])
@each("link", ["bindata/data.bin", "./bindata/data.bin", "bindata\\data.bin", "BinData/Data.bin"])
def test_blocks_in_a_folder(tmp_path, folder, link):
    path = x3p(tmp_path / "a.x3p", MAP, folder=folder, mask=b"\xff" * 78, PointDataLink=link)
    np.testing.assert_array_equal(read_surface(path).heights, MAP)


def test_an_archive_of_another_format(tmp_path, monkeypatch):
    """PLUX, Keyence and NMM are ZIP archives without main.xml: they are for SurfaceTopography."""
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)  # an import of it fails
    with zipfile.ZipFile(tmp_path / "a.plux", "w") as archive:
        archive.writestr("index.xml", "<a/>")
    with pytest.raises(InputError, match=r"ehlectric\[instruments\]"):
        read_surface(tmp_path / "a.plux")
    (tmp_path / "a.plux").rename(tmp_path / "a.x3p")
    with pytest.raises(InputError, match=r" X3P"):
        read_surface(tmp_path / "a.x3p")


def test_binary_heights_after_a_long_head_of_text(tmp_path, monkeypatch):
    """WSxM and Nanoscope: 5 kB of text, then integers."""
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)  # an import of it fails
    head = "WSxM file\n" + "".join(f"    Note {k}: none\n" for k in range(300))
    for counts in (np.arange(480, dtype="<i2"), np.full(480, 0x818D, "<u2")):
        (tmp_path / "a.stp").write_bytes(head.encode() + counts.tobytes())
        with pytest.raises(InputError, match=r"ehlectric\[instruments\]"):
            read_surface(tmp_path / "a.stp")


@each("form", ["plux", "wsxm"])
def test_other_formats_by_surface_topography(tmp_path, form):
    """24 x 20 points, 0.5 um apart, and the heights that were written."""
    pytest.importorskip("SurfaceTopography", exc_type=ImportError)
    rows, columns = np.indices((20, 24))
    heights = 2e-7 * np.sin(columns / 4) + 1e-8 * rows
    path = {"plux": plux, "wsxm": wsxm}[form](tmp_path / f"a.{form}", heights, 0.5e-6)
    surface = read_surface(path)
    assert surface.heights.shape == (20, 24)
    assert (surface.spacing_x, surface.spacing_y) == pytest.approx((0.5e-6, 0.5e-6), rel=1e-6)
    np.testing.assert_allclose(np.sort(surface.heights, axis=None), np.sort(heights, axis=None), atol=2e-11)


def test_constant_maps_and_lines_are_refused(tmp_path):
    surface = read_surface(x3p(tmp_path / "a.x3p", np.full((20, 31), 5e-7)))
    for reading in (surface.line, surface.map):
        with pytest.raises(InputError, match=r"constant.* 5e-07"):
            reading()


@pytest.mark.parametrize("increment", ["0", None, "1"])
def test_a_profile_has_no_second_spacing(tmp_path, increment):
    changes = {"FeatureType": "PRF", "CY_Increment": increment}
    surface = read_surface(x3p(tmp_path / "a.x3p", MAP.reshape(1, -1), **changes))
    assert (surface.spacing_x, surface.spacing_y) == (1.5e-7, None)
    np.testing.assert_array_equal(surface.line().heights, MAP.ravel())


WRONG_X3P = [
    ({"SizeZ": 2}, " 2 heights"),
    ({"CX_AxisType": "A"}, "CX .*'A'.*'I'"),
    ({"CY_AxisType": "A"}, "CY .*'A'.*'I'"),
    ({"CZ_AxisType": "I"}, "CZ .*'I'.*'A'"),
    ({"CX_AxisType": None}, "CX .*''"),
    ({"FeatureType": "PCL"}, "'PCL'"),
    ({"CZ_DataType": "X"}, "'X'.*D, F, L, I"),
    ({"CZ_DataType": "I"}, "CZ/Increment .*''"),
    ({"CZ_Increment": "0"}, "increment .* 0;.*positive"),
    ({"CZ_Increment": "nan"}, "CZ/Increment .*'nan'"),
    ({"CZ_Increment": "1e300", "CZ_DataType": "L", "data": b"\1" * 2480}, " 10 m"),
    ({"CX_Increment": None}, "CX/Increment .*''"),
    ({"CX_Increment": "inf"}, "CX/Increment .*'inf'"),
    ({"CX_Increment": "0"}, " 0 m .* x"),
    ({"CY_Increment": "0"}, " 0 m .* y"),
    ({"CX_Increment": "-1e-7"}, " -1e-07 m .* x"),
    ({"CX_Increment": "1,5e-7"}, "CX/Increment .*'1,5e-7'"),
    ({"SizeX": -31, "SizeY": -20}, "SizeX .*'-31'.* 1"),
    ({"SizeX": 0}, "SizeX .*'0'"),
    ({"SizeX": None}, "SizeX .*''"),
    ({"SizeY": "1e1"}, "SizeY .*'1e1'"),
    ({"SizeX": 10**12}, "SizeX .*'1000000000000'"),
    ({"SizeX": 10**5, "SizeY": 10**5}, " 100000000\\b"),
    ({"SizeX": 32}, " 4960 .* 5120"),
    ({"data": b"\0" * 100_000, "pack": zipfile.ZIP_DEFLATED}, " 100000 .* 4960"),
    ({"mask": b"\xff"}, "'bindata/valid.bin' .*1 .* 78"),
    ({"ValidPointsLink": "no.bin"}, "ValidPointsLink .*'no.bin'"),
    ({"PointDataLink": "no.bin"}, "PointDataLink .*'no.bin'"),
    ({"encoding": "foo"}, " X3P"),
    ({"encoding": "gbk"}, " X3P"),
    ({"FeatureType": "S" * 300_000_000, "pack": zipfile.ZIP_DEFLATED}, " X3P"),
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
    with pytest.raises(InputError, match=" X3P"):
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
    ({"PixelSizeXMeter": "0"}, " 0 m .* x"),
    ({"PixelSizeXMeter": "nan"}, " nan m .* x"),
    ({"PixelSizeYMeter": "inf"}, " inf m .* y"),
    ({"DepthImageOffset": "-50"}, " -50\\b"),
    ({"Cols": "0"}, "20 x 0 points"),
    ({"Rows": "-1"}, "-1 x 31 points"),
    ({"Rows": "x"}, "header"),
]


@each("changes, message", WRONG_AL3D)
def test_wrong_al3d_is_refused_in_words(tmp_path, changes, message):
    with pytest.raises(InputError, match=message):
        read_surface(al3d(tmp_path / "a.al3d", **changes))


@pytest.mark.parametrize("name", ["x_unit", "z_unit"])
def test_units_of_files_that_have_their_own(tmp_path, name):
    for path in (x3p(tmp_path / "a.x3p", MAP), al3d(tmp_path / "a.al3d")):
        with pytest.raises(InputError, match=f"{name}: .*'um'"):
            read_surface(path, **{name: "um"})


def test_pipes_are_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    with pytest.raises(InputError, match=" pipe"):
        read_surface(tmp_path / "pipe.csv")
    with pytest.raises(InputError, match="directory"):
        read_surface(tmp_path)
    with pytest.raises(InputError, match="is not a path"):
        read_surface("a\0b")


PACKS = {
    "stored": zipfile.ZIP_STORED,
    "deflated": zipfile.ZIP_DEFLATED,
    "bzip2": zipfile.ZIP_BZIP2,
    "lzma": zipfile.ZIP_LZMA,
}


@pytest.mark.slow
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
