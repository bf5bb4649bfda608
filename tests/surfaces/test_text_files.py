"""Text profiles as instruments and spreadsheets write them: what is read, and what is refused for doubt."""

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.surfaces import text_maps
from ehlectric.surfaces.surface_files import read_surface
from tests.helpers.each import each
from tests.surfaces.test_files import DEKTAK

K = np.arange(200)
# Heights of a sine in nm, over steps of half a micrometre: every reading of the same numbers must give these.
X, Z = 0.5 * K, 12.3 * np.sin(K / 5)


def written(path, header, rows, code="utf-8"):
    path.write_bytes("\n".join([*header, *rows]).encode(code))
    return path


def assert_read(surface):
    assert surface.spacing_x == pytest.approx(0.5e-6, rel=1e-12, abs=0.0)
    np.testing.assert_allclose(surface.heights[0], 1e-9 * Z, rtol=0.0, atol=1e-13)


def rows_of(separator, point=".", x_digits=2, z_scale=1.0):
    lines = [f"{x:.{x_digits}f}{separator}{z_scale * z:.7f}" for x, z in zip(X, Z, strict=True)]
    return [line.replace(".", point) for line in lines]


@each("code", ["utf-8", "utf-8-sig", "cp1252", "latin-1", "utf-16"])
def test_micro_sign_in_any_code(tmp_path, code):
    """In Windows' codes it is the byte 0xB5, which is no UTF-8: the column is not in metres for that."""
    path = written(tmp_path / "a.txt", ["x [µm];z [µm]"], rows_of(";", z_scale=1e-3), code)
    assert_read(read_surface(path))


def test_no_text_of_any_kind(tmp_path):
    (tmp_path / "a.txt").write_bytes(b"\x81\x8d;\x90" * 100)
    with pytest.raises(InputError, match="UTF-8, UTF-16 or Windows-1252"):
        read_surface(tmp_path / "a.txt")


@each("separator", [";", "\t", " ", "   "])
@each("point", [".", ","])
def test_decimal_mark(tmp_path, separator, point):
    path = written(tmp_path / "a.txt", [], rows_of(separator, point))
    assert_read(read_surface(path, x_unit="um", z_unit="nm"))


def test_decimal_comma_beside_whole_numbers(tmp_path):
    """A row such as 0;0,0000 was once three columns."""
    rows = [f"{k};{z:.4f}".replace(".", ",") for k, z in zip(K, Z, strict=True)]
    surface = read_surface(written(tmp_path / "a.txt", ["x [um];z [nm]"], rows))
    assert surface.spacing_x == pytest.approx(1e-6)
    np.testing.assert_allclose(surface.heights[0], 1e-9 * Z, atol=1e-13)


VALIDITY = ["X;Y;valid", "[um];[nm];[1/0]"]

# Files that can be read in two ways, or are none, with a part of what they are told.
DOUBTFUL = [
    (
        ["x [um],z [um]"],
        [f"{k},{k + 5}" for k in K],
        "line 2 .*'0,5'",
    ),
    ([], [f"{k},{k % 7},{k},5" for k in K], " 4 columns"),
    ([], [*rows_of(";")[:-1], "99,50;1"], "decimal points and decimal commas"),
    ([], [*rows_of(";")[:-1], "1.234,5;1"], "two columns|line 200\\b"),
    (["x [um];z [nm];level"], [f"{x};0.0;{z:.4f}" for x, z in zip(X, Z, strict=True)], " 3 columns"),
    (["X;Y;invalid", "[um];[nm];[1/0]"], [line + ";0" for line in rows_of(";")], " 3 columns"),
    (["x;y;is it", "valid;or;not"], [line + ";1" for line in rows_of(";")], " 3 columns"),
    (
        VALIDITY,
        [*[line + ";1" for line in rows_of(";")[:-1]], "99.50;1"],
        "line 202 .*2 columns.* 3",
    ),
    (VALIDITY, [line + ";2" for line in rows_of(";")], "line 3 .*'2'.* 0 or 1"),
    (VALIDITY, [*[line + ";1" for line in rows_of(";")[:-1]], "99.50;1;"], "validity ''"),
    ([], [*rows_of(";")[:-1], "1e999;1"], "line 200\\b"),
    ([], [*rows_of(";")[:-1], "9e99;1"], " 10 m"),
    (["x [um];z [nm]", "0.00"], rows_of(";")[1:], "line 2 is '0.00'"),
    # The rows above a wrong one are no header.
    ([], [*rows_of(";")[:1], "0.50;WORD", *rows_of(";")[2:]], "line 2\\b.*'WORD'|line 2 is"),
    (["x [um];z [nm]"], [*rows_of(";")[:1], "0.50;WORD", *rows_of(";")[2:]], "line 3\\b.*'WORD'"),
]


@each("header, rows, message", DOUBTFUL)
def test_doubtful_files_are_refused(tmp_path, header, rows, message):
    path = written(tmp_path / "a.txt", header, rows)
    with pytest.raises(InputError, match=message):
        read_surface(path, x_unit="um", z_unit=None if "[nm]" in "".join(header) else "um")


def test_empty_fields_are_voids_in_their_column(tmp_path):
    rows = [line + ";1" for line in rows_of(";")]
    rows[50], rows[80] = "25.00;;0", "40.00;9.9;0"
    surface = read_surface(written(tmp_path / "a.txt", VALIDITY, rows))
    assert np.flatnonzero(np.isnan(surface.heights[0])).tolist() == [50, 80]
    rows = rows_of(";")
    rows[50] = "25.00;"
    surface = read_surface(written(tmp_path / "a.txt", ["x [um];z [nm]"], rows))
    assert np.flatnonzero(np.isnan(surface.heights[0])).tolist() == [50]
    # As the Dektak writes them, with separators at the end that separate nothing.
    rows = [line + ",," for line in rows_of(",")]
    assert_read(read_surface(written(tmp_path / "a.txt", ["Lateral um,Raw Nanometer,"], rows)))


HEADS = [
    (";", "x [um];z [nm]", (True, True)),
    (";", "# x/um; z in nm", (True, True)),
    (";", "Z1 (um);Z2 (nm)", (False, False)),
    (" ", "x [um] z [nm]", (True, True)),
    (" ", "x[um] z[nm]", (True, True)),
    (" ", "# Cutoff 0.8 mm, tip 2 um", (False, False)),
    (";", "Cutoff 0.8 mm; tip 2 um", (False, False)),
    (";", "Cutoff 0.8 [mm]; tip 2 [um]", (False, False)),
    (" ", "x z [nm]", (False, False)),
    (";", "x um or mm;z [nm]", (False, True)),
    (";", "x [um];z [V] nm", (True, False)),
    (";", "x;z", (False, False)),
    (";", "x [um];z [nm];remark", (False, False)),
]


@each("separator, head, stated", HEADS)
def test_units_are_those_of_their_own_column(tmp_path, separator, head, stated):
    """One unit for each column in their order, on the line above them, or none is believed."""
    path = written(tmp_path / "a.txt", [head], rows_of(separator))
    given = {"x_unit": "um", "z_unit": "nm"}
    for name, known in zip(given, stated, strict=True):
        rest = {other: unit for other, unit in given.items() if other != name}
        if known:
            assert_read(read_surface(path, **rest))
            with pytest.raises(InputError, match=f"{name}: .*'mm'"):
                read_surface(path, **rest, **{name: "mm"})
        else:
            with pytest.raises(InputError, match=f"^{name}: "):
                read_surface(path, **rest)
    assert_read(read_surface(path, **given))


@pytest.mark.slow
@each("unit", ["foo", "kg", "", "um; rm", "1", "1/um"])
def test_units_that_are_no_length(tmp_path, unit):
    path = written(tmp_path / "a.txt", [], rows_of(";"))
    with pytest.raises(InputError, match=r"z_unit: .*length"):
        read_surface(path, x_unit="um", z_unit=unit)


@pytest.mark.parametrize("unit", ["m", "pm"])
def test_spacings_that_are_none(tmp_path, unit):
    """Half a metre or half a picometre between points is no measurement."""
    path = written(tmp_path / "a.txt", [], rows_of(";"))
    with pytest.raises(InputError, match=r" 5e-.* m .* x| 10 m"):
        read_surface(path, x_unit=unit, z_unit="pm")


def positions(path, x):
    return written(path, ["x[um];z[nm]"], [f"{v};{np.sin(v / 90):.4f}" for v in x])


def test_samples_that_may_be_missing(tmp_path):
    """Where positions are whole spacings, a gap looks like rounding: it is said; elsewhere it is refused."""
    whole = read_surface(positions(tmp_path / "a.txt", np.delete(np.arange(200), 100)))
    assert len(whole.warnings) == 1
    assert [number in whole.warnings[0].text for number in ("1 of the 198", "point 99")] == [True, True]
    for step in (0.5, 10.0):
        with pytest.raises(InputError, match="not uniform"):
            read_surface(positions(tmp_path / "a.txt", step * np.delete(np.arange(200), 100)))


@pytest.mark.slow
def test_rounded_positions_are_no_gap(tmp_path):
    """The Dektak writes 0.15625 um in steps of 0.1: neighbours are 0.1 or 0.2 apart, at three missing 0.3."""
    assert read_surface(DEKTAK).warnings == ()
    lines = DEKTAK.read_bytes().splitlines(keepends=True)
    (tmp_path / "a.csv").write_bytes(b"".join(lines[:5000] + lines[5001:]))
    with pytest.raises(InputError, match="not uniform"):
        read_surface(tmp_path / "a.csv")


def test_a_text_of_too_many_lines(tmp_path, monkeypatch):
    monkeypatch.setattr(text_maps, "MOST_LINES", 50)
    path = tmp_path / "a.csv"
    path.write_text("\n" * 51 + "1;2\n")
    with pytest.raises(InputError, match=r"a\.csv: .* 52 .* 50$"):
        read_surface(path)


@each(
    "head, metres",
    [
        ("x [mil];z [µin]", (25.4e-6, 25.4e-9)),
        ("x [㎛];z [㎚]", (1e-6, 1e-9)),
        ("x［um］;z［Å］", (1e-6, 1e-10)),
        ("x microns;z angstrom", (1e-6, 1e-10)),
    ],
)
def test_units_of_length_in_heads(tmp_path, head, metres):
    """Spacing 2 and heights -1 and 1 in the units of the head; an inch is 25.4 mm."""
    rows = [f"{2 * k};{(-1) ** k}" for k in range(40)]
    surface = read_surface(written(tmp_path / "a.txt", [head], rows))
    assert surface.spacing_x == pytest.approx(2.0 * metres[0])
    assert np.ptp(surface.heights) == pytest.approx(2.0 * metres[1])


@each(
    "void", ["", "NaN", "nan", "-nan", "N/A", "#N/A", "BAD", "bad", "***", "********", "-", "---", "NoData"]
)
def test_points_without_a_value_are_void(tmp_path, void):
    """As np.savetxt, pandas and spreadsheets write them, in every separator and at the end of the file."""
    for separator in (";", ",", "\t", " "):
        if void or separator != " ":
            rows = rows_of(separator)
            for place in (50, 80, 199):
                rows[place] = rows[place].partition(separator)[0] + separator + void
            surface = read_surface(
                written(tmp_path / "a.txt", ["x [um];z [nm]"], rows), x_unit="um", z_unit="nm"
            )
            found = surface.heights[0]
            assert np.flatnonzero(np.isnan(found[:199])).tolist() == [50, 80]
            assert found[:50] == pytest.approx(1e-9 * Z[:50], abs=1e-13)


def test_decimal_commas_with_voids_between_spaces(tmp_path):
    rows = rows_of(" ", ",")
    rows[-1] = rows[-1].partition(" ")[0] + " nan"
    surface = read_surface(written(tmp_path / "a.txt", ["x [um] z [nm]"], rows))
    assert surface.heights[0][:199] == pytest.approx(1e-9 * Z[:199], abs=1e-13)


def test_quoted_fields_of_a_spreadsheet(tmp_path):
    """Separators of thousands, and a head with the separator."""
    x = [f"{1000.0 * k + 0.5:,.1f}" for k in range(200)]
    rows = [f'"{a}","{z:.7f}"' for a, z in zip(x, Z, strict=True)]
    surface = read_surface(written(tmp_path / "a.csv", ['"x [nm]","z, filtered [nm]"'], rows))
    assert surface.spacing_x == pytest.approx(1e-6)
    np.testing.assert_allclose(surface.heights[0], 1e-9 * Z, atol=1e-13)
    commas = [f'"{0.5 * k}","{z:.7f}"'.replace(".", ",") for k, z in zip(K, Z, strict=True)]
    assert_read(read_surface(written(tmp_path / "b.csv", ['"x [um]","z [nm]"'], commas)))


@each(
    "above",
    [["SJ-410"], [f"{len(K)}"], [f"{len(K)}", "0.5"], ["0.5", f"{len(K)}"], ["Z", f"{len(K)}", "0.50"]],
)
def test_a_number_of_heights_above_them_is_no_height(tmp_path, above):
    """After Mitutoyo: the number of heights and their spacing in lines of their own."""
    path = written(tmp_path / "a.txt", above, [f"{z:.7f}" for z in Z])
    surface = read_surface(path, spacing=0.5e-6, z_unit="nm")
    np.testing.assert_allclose(surface.heights[0], 1e-9 * Z, atol=1e-13)
