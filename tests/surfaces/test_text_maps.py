"""Maps and profiles as points X, Y, Z, as matrices and as arrays of NumPy: one surface in many spellings."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric import InputError
from ehlectric.surfaces.surface_files import read_surface
from tests.helpers.each import each
from tests.helpers.share import share_of

# 20 rows of 24 points, 0.5 um apart along x and 0.25 um along y; heights of two waves.
ROWS, COLUMNS = np.indices((20, 24))
HEIGHTS = 2e-7 * np.sin(COLUMNS / 4) + 3e-8 * np.cos(ROWS / 3)
STEP_X, STEP_Y = 0.5e-6, 0.25e-6
UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9}

GWYDDION = {
    "English": ("Channel", "Width", "Height", "Value units"),
    "German": ("Kanal", "Breite", "Höhe", "Werteinheiten"),
    "French": ("Canal", "Largeur", "Hauteur", "Unités des valeurs"),
    "Czech": ("Kanál", "Šířka", "Výška", "Jednotky hodnot"),
    "Russian": ("Канал", "Ширина", "Высота", "Единицы значений"),
}


def assert_map(surface, heights=HEIGHTS, atol=1e-12):
    assert surface.heights.shape == heights.shape
    assert (surface.spacing_x, surface.spacing_y) == pytest.approx((STEP_X, STEP_Y), rel=1e-6, abs=0.0)
    np.testing.assert_allclose(surface.heights, heights, atol=atol, rtol=0.0)


def saved(path, lines, code="utf-8", point="."):
    path.write_bytes("\n".join(line.replace(".", point) for line in lines).encode(code))
    return path


def points(separator=",", x_unit=1e-6, z_unit=1e-6, columns="xyz"):
    values = {"x": COLUMNS * STEP_X / x_unit, "y": ROWS * STEP_Y / x_unit, "z": HEIGHTS / z_unit}
    cells = {name: [f"{value:.9g}" for value in array.flat] for name, array in values.items()}
    return [separator.join(row) for row in zip(*(cells[name] for name in columns), strict=True)]


def matrix(separator="\t", z_unit=1e-9):
    return [separator.join(f"{z / z_unit:.9g}" for z in row) for row in HEIGHTS]


@each("separator, point", [(",", "."), (";", ","), ("\t", "."), (" ", ",")])
def test_points_without_a_head(tmp_path, separator, point):
    path = saved(tmp_path / "a.csv", points(separator), point=point)
    assert_map(read_surface(path, x_unit="um", z_unit="um"))
    with pytest.raises(InputError, match=r"^x_unit: "):
        read_surface(path, z_unit="um")


def test_points_in_any_order_with_voids(tmp_path):
    lines = np.array(points())
    np.random.default_rng(0).shuffle(lines)
    expected = HEIGHTS.copy()
    expected[3, 5] = expected[7, 0] = np.nan
    kept = [line for line in lines if not line.startswith("2.5,0.75,")]
    kept = [line.rpartition(",")[0] + ",***" if line.startswith("0,1.75,") else line for line in kept]
    assert len(kept) == 479
    assert_map(read_surface(saved(tmp_path / "a.csv", kept), x_unit="um", z_unit="um"), expected)


@each("columns", ["xyz", "yxz", "zxy", "zyx"])
def test_names_decide_the_order_of_columns(tmp_path, columns):
    head = ";".join({"x": "X [um]", "y": "Y [um]", "z": "Height [nm]"}[name] for name in columns)
    assert_map(read_surface(saved(tmp_path / "a.csv", [head, *points(";", z_unit=1e-9, columns=columns)])))


def test_a_profile_as_points(tmp_path):
    """Constant Y, or constant X: the number of points, and their distance."""
    for form in ("{x},0.5,{z}", "0.5,{x},{z}"):
        rows = [form.format(x=f"{0.0005 * k:.6f}", z=f"{np.sin(k / 9):.6f}") for k in range(200)]
        surface = read_surface(saved(tmp_path / "a.csv", ["X (mm),Y (mm),Z (um)", *rows]))
        assert surface.heights.shape == (1, 200)
        assert (surface.spacing_x, surface.spacing_y) == (pytest.approx(0.5e-6), None)
        np.testing.assert_allclose(surface.heights[0], 1e-6 * np.sin(np.arange(200) / 9), atol=1e-12)


def test_a_profile_with_its_columns_swapped(tmp_path):
    rows = [f"{np.sin(k / 9):.6f};{0.5 * k:.1f}" for k in range(200)]
    for names in ("Z [um];X [um]", "Height [um];Position [um]"):
        surface = read_surface(saved(tmp_path / "a.csv", [names, *rows]))
        assert surface.spacing_x == pytest.approx(0.5e-6)
        np.testing.assert_allclose(surface.heights[0], 1e-6 * np.sin(np.arange(200) / 9), atol=1e-12)


@each("language", GWYDDION)
@each("point", [".", ","])
def test_header_of_gwyddion(tmp_path, language, point):
    channel, width, height, value = GWYDDION[language]
    head = [f"# {channel}: Topo", f"# {width}: 12.0 µm", f"# {height}: 5.0 µm", f"# {value}: nm"]
    path = saved(tmp_path / "a.txt", [*head, *matrix()], point=point)
    assert_map(read_surface(path))
    assert_map(read_surface(path, z_unit="nm", spacing=0.5e-6))
    for key, value in (("spacing", 1e-6), ("z_unit", "um"), ("x_unit", "um")):
        with pytest.raises(InputError, match=f"^{key}: "):
            read_surface(path, **{key: value})


def test_header_of_gwyddion_with_another_decimal_mark(tmp_path):
    head = ["# Width: 12,0 um", "# Height: 5,0 um", "# Value units: nm"]
    with pytest.raises(InputError, match="12,0 um"):
        read_surface(saved(tmp_path / "a.txt", [*head, *matrix()]))


def test_matrix_with_a_given_spacing(tmp_path):
    path = saved(tmp_path / "a.csv", matrix(","))
    assert_map(read_surface(path, spacing=STEP_X, spacing_y=STEP_Y, z_unit="nm"))
    assert read_surface(path, spacing=STEP_X, z_unit="nm").spacing_y == STEP_X
    for missing, keys in (("spacing", {"z_unit": "nm"}), ("z_unit", {"spacing": STEP_X})):
        with pytest.raises(InputError, match=missing):
            read_surface(path, **keys)


def test_matrix_with_void_columns_at_its_ends(tmp_path):
    lines = [f"NaN,{line},NaN,NaN" for line in matrix(",")]
    surface = read_surface(saved(tmp_path / "a.csv", lines), spacing=STEP_X, spacing_y=STEP_Y, z_unit="nm")
    assert surface.heights.shape == (20, 27)
    np.testing.assert_allclose(surface.heights[:, 1:-2], HEIGHTS, atol=1e-12)
    assert surface.map().heights.shape == (24, 20)


@each("where", ["row", "column"])
def test_positions_are_no_heights(tmp_path, where):
    """A matrix with positions in its first row or column."""
    lines = matrix(",")
    if where == "row":
        lines = [",".join(f"{0.5 * k}" for k in range(24)), *lines]
    else:
        lines = [f"{0.5 * k},{line}" for k, line in enumerate(lines)]
    with pytest.raises(InputError, match=f"first {where}"):
        read_surface(saved(tmp_path / "a.csv", lines), spacing=STEP_X, z_unit="nm")


@each("digits", [1, 2, 4])
def test_decimal_commas_between_commas_are_refused(tmp_path, digits):
    lines = [",".join(f"{z * 1e9:.{digits}f}".replace(".", ",") for z in row) for row in HEIGHTS]
    with pytest.raises(InputError, match="decimal"):
        read_surface(saved(tmp_path / "a.csv", lines), spacing=STEP_X, z_unit="nm")


@each("offset", [-100, 100, 1000])
def test_whole_numbers_between_commas_are_heights(tmp_path, offset):
    counts = np.round(HEIGHTS * 1e9).astype(int) + offset
    path = saved(tmp_path / "a.csv", [",".join(map(str, row)) for row in counts])
    surface = read_surface(path, spacing=STEP_X, z_unit="nm")
    np.testing.assert_allclose(surface.heights, counts * 1e-9)


def test_heights_in_a_single_column(tmp_path):
    path = saved(tmp_path / "a.txt", ["z [nm]", *(f"{100 * np.sin(k / 9):.5f}" for k in range(200))])
    surface = read_surface(path, spacing=0.5e-6)
    assert surface.spacing_x == 0.5e-6
    np.testing.assert_allclose(surface.heights[0], 1e-7 * np.sin(np.arange(200) / 9), atol=1e-13)
    with pytest.raises(InputError, match=r"one column.*spacing"):
        read_surface(path)


@each("change, message", [
    (lambda rows: [*rows[:-1], rows[0]], "line 480 repeats"),
    (lambda rows: rows[:30] + rows[470:], "regular grid"),
    (lambda rows: ["0.1,0.1,0.3", *rows[1:]], "equally spaced|grid"),
    (lambda rows: [f"{k},{row}" for k, row in enumerate(rows)], "4 columns|spacing"),
])  # fmt: skip
def test_points_that_are_no_grid(tmp_path, change, message):
    with pytest.raises(InputError, match=message):
        read_surface(saved(tmp_path / "a.csv", change(points())), x_unit="um", z_unit="um")


@each("kind", ["f8", "f4", ">f8", "i4"])
def test_arrays_of_numpy(tmp_path, kind):
    stored = np.round(HEIGHTS * 1e12) if kind == "i4" else HEIGHTS * 1e9
    np.save(tmp_path / "a.npy", stored.astype(kind))
    unit = "pm" if kind == "i4" else "nm"
    surface = read_surface(tmp_path / "a.npy", spacing=STEP_X, spacing_y=STEP_Y, z_unit=unit)
    assert_map(surface, atol=1e-12)
    np.save(tmp_path / "b.npy", stored[3].astype(kind))
    line = read_surface(tmp_path / "b.npy", spacing=STEP_X, z_unit=unit)
    assert (line.heights.shape, line.spacing_y) == ((1, 24), None)
    np.save(tmp_path / "c.npy", np.asfortranarray(stored.astype(kind)))
    assert_map(read_surface(tmp_path / "c.npy", spacing=STEP_X, spacing_y=STEP_Y, z_unit=unit))


def test_arrays_that_are_no_surface(tmp_path):
    path = tmp_path / "a.npy"
    keys = {"spacing": STEP_X, "z_unit": "nm"}
    for array, message in (
        (np.zeros((2, 3, 4)), r"\(2, 3, 4\)"),
        (np.array(["a"]), "real numbers"),
        (np.array([1j]), "real numbers"),
        (np.array([{}], dtype=object), "real numbers"),
    ):
        np.save(path, array)
        with pytest.raises(InputError, match=message):
            read_surface(path, **keys)
    np.save(path, HEIGHTS)
    for missing in keys:
        with pytest.raises(InputError, match=f"^{missing}: missing"):
            read_surface(path, **{key: value for key, value in keys.items() if key != missing})
    whole = path.read_bytes()
    for broken in (whole[:-8], whole[:20], whole[:6], whole.replace(b"(20, 24)", b"(9**9,9)")):
        path.write_bytes(broken)
        with pytest.raises(InputError, match=r"a\.npy"):
            read_surface(path, **keys)


SPELLINGS = st.fixed_dictionaries({
    "kind": st.sampled_from(["profile", "matrix", "points"]),
    "separator": st.sampled_from([";", "\t", ",", " ", "; ", "   "]),
    "point": st.sampled_from([".", ","]),
    "code": st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]),
    "ends": st.sampled_from(["\n", "\r\n", "\r"]),
    "title": st.sampled_from(["", "# measured with the tip 2", "Sample A; Ra 0.2 µm", '"Profile 7"', "\n\n"]),
    "head": st.sampled_from(["", "names", "units", "both", "two lines"]),
    "order": st.permutations("xyz"),
    "x_unit": st.sampled_from(["mm", "um", "µm", "nm"]),
    "z_unit": st.sampled_from(["mm", "um", "µm", "nm"]),
    "digits": st.sampled_from(["{:.9g}", "{:.12f}", "{:+.9e}", "{:14.9f}"]),
    "last": st.sampled_from(["", "\n", "\n\n", ";"]),
    "given": st.booleans(),
})  # fmt: skip


def spelled(kind, separator, point, title, head, order, x_unit, z_unit, digits, last, **_):
    """Text of the same surface, and whether the order of its columns is as without names."""
    x, y, z = COLUMNS * STEP_X / UNITS[x_unit], ROWS * STEP_Y / UNITS[x_unit], HEIGHTS / UNITS[z_unit]
    columns = [name for name in order if kind == "points" or name != "y"]
    if kind == "matrix":
        rows, heads = z, []
    else:
        arrays = {"x": x, "y": y, "z": z}
        stop = None if kind == "points" else 24
        rows = zip(*(arrays[name].ravel()[:stop] for name in columns), strict=True)
        names = [name.upper() for name in columns]
        units = [z_unit if name == "z" else x_unit for name in columns]
        both = [f"{name} [{unit}]" for name, unit in zip(names, units, strict=True)]
        bare = [f"[{unit}]" for unit in units]
        heads = {"": [], "names": [names], "units": [bare], "both": [both], "two lines": [names, bare]}[head]
    body = [separator.join(digits.format(v).replace(".", point) for v in row) for row in rows]
    lines = [*([title] if title else []), *(separator.join(each) for each in heads), *body]
    return "\n".join(lines) + last, kind != "matrix" and head in ("", "units") and columns != sorted(columns)


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=share_of(900, 9), deadline=None)
@given(spelling=SPELLINGS)
def test_spellings_of_a_surface_give_it_or_are_refused(tmp_path_factory, spelling):
    """Whatever the spelling is: the heights that were written, or a refusal; never other heights."""
    text, swapped = spelled(**spelling)
    path = tmp_path_factory.getbasetemp() / "spelled.txt"
    path.write_bytes(text.replace("\n", spelling["ends"]).encode(spelling["code"]))
    keys = {"z_unit": spelling["z_unit"]} if spelling["given"] else {}
    if spelling["kind"] == "matrix":
        keys |= {"spacing": STEP_X, "spacing_y": STEP_Y}
    elif spelling["given"]:
        keys["x_unit"] = spelling["x_unit"]
    try:
        surface = read_surface(path, **keys)
    except InputError:
        return
    expected = HEIGHTS[:1] if spelling["kind"] == "profile" else HEIGHTS
    # Points without names in another order than X, Y, Z are the same grid with its axes exchanged.
    if swapped and spelling["kind"] == "points":
        expected = expected.T
    np.testing.assert_allclose(surface.heights, expected, atol=2e-12, rtol=0.0)


@each("kind", ["profile", "matrix", "points"])
def test_usual_spellings_are_read(tmp_path, kind):
    """Of the spellings above, the usual ones must be read, not refused."""
    for separator, point in ((";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", "."), (" ", ".")):
        for code in ("utf-8", "utf-8-sig", "utf-16", "cp1252"):
            spelling = {
                "kind": kind, "separator": separator, "point": point, "title": "", "head": "both",
                "order": "zxy", "x_unit": "µm", "z_unit": "nm", "digits": "{:.9g}", "last": "\n",
            }  # fmt: skip
            text, _ = spelled(**spelling)
            (tmp_path / "a.txt").write_bytes(text.encode(code))
            keys = {"spacing": STEP_X, "spacing_y": STEP_Y, "z_unit": "nm"} if kind == "matrix" else {}
            surface = read_surface(tmp_path / "a.txt", **keys)
            expected = HEIGHTS[:1] if kind == "profile" else HEIGHTS
            np.testing.assert_allclose(surface.heights, expected, atol=2e-12, rtol=0.0)


@each("number", ["-32768", "-9999", "1e10", "-999", "9999.0", "3.4028235e+38"])
def test_numbers_that_mark_points_without_data(tmp_path, number):
    """As in every format: three of 200 points of a profile, and one of a map."""
    heights = [f"{100 * np.sin(k / 9):.4f}" for k in range(200)]
    for place in (20, 21, 90):
        heights[place] = number
    rows = [f"{0.5 * k};{z}" for k, z in enumerate(heights)]
    profile = read_surface(saved(tmp_path / "a.csv", ["x [um];z [nm]", *rows]))
    assert np.flatnonzero(np.isnan(profile.heights[0])).tolist() == [20, 21, 90]
    assert [warning.code for warning in profile.warnings] == ["void-numbers"]
    column = read_surface(saved(tmp_path / "b.csv", heights), z_unit="nm", spacing=0.5e-6)
    np.testing.assert_array_equal(column.heights, profile.heights)
    lines = matrix(",")
    lines[3] = f"{number}{lines[3][lines[3].index(',') :]}"
    surface = read_surface(saved(tmp_path / "c.csv", lines), spacing=STEP_X, z_unit="nm")
    assert np.argwhere(np.isnan(surface.heights)).tolist() == [[3, 0]]
    stored = HEIGHTS * 1e9
    stored[3, 0] = float(number)
    np.save(tmp_path / "d.npy", stored)
    surface = read_surface(tmp_path / "d.npy", spacing=STEP_X, z_unit="nm")
    assert np.argwhere(np.isnan(surface.heights)).tolist() == [[3, 0]]


def test_repeated_heights_far_from_all_others_are_refused(tmp_path):
    """Zero at points without data, next to heights about 5 mm; a surface of two levels is read."""
    heights = [f"{5e6 + 100 * np.sin(k / 9):.4f}" for k in range(200)]
    heights[20] = heights[90] = "0"
    path = saved(tmp_path / "a.csv", heights)
    with pytest.raises(InputError, match=r"2 heights are 0 m.*NaN"):
        read_surface(path, z_unit="nm", spacing=1e-3)
    two = saved(tmp_path / "b.csv", [f"{k // 10 % 2}" for k in range(200)])
    assert read_surface(two, z_unit="nm", spacing=1e-6).voids == 0.0


def test_heights_below_atoms_are_refused(tmp_path):
    """100 nm in a file whose unit is taken as pm: a million times more is proposed."""
    path = saved(tmp_path / "a.csv", [f"{0.1414 * np.sin(k / 9):.6f}" for k in range(400)])
    with pytest.raises(InputError, match=r"9.95e-14 m.*1e-11 m.*1e\+06 times.* 99.5 nm"):
        read_surface(path, z_unit="pm", spacing=1e-6).line()
