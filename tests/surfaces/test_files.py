"""Readers on real and made files: spacing, size, roughness, and what they refuse.

The real file is from the public repository ContactEngineering/SurfaceTopography, MIT licence.
"""

import sys
from types import ModuleType

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.surfaces.profiles import Processing, processed, statistics
from ehlectric.surfaces.surface_files import _read_other, read_surface
from tests.helpers.each import each
from tests.helpers.places import DEKTAK, SURFACES
from tests.helpers.surface_writers import MAP, al3d, x3p

DATA = SURFACES


def rq_after(surface, **steps):
    return statistics(processed(surface.line(), Processing(**steps))[-1][1]).rq


@pytest.mark.slow
def test_dektak_spacing_is_that_of_the_whole_length():
    """Its positions are rounded to 0.1 um: neighbours are 0.1 or 0.2 um apart, the truth is 0.15625."""
    surface = read_surface(DEKTAK)
    assert surface.heights.shape == (1, 9600)
    assert surface.spacing_x == pytest.approx(0.15625e-6, rel=1e-3, abs=0.0)
    assert surface.voids == 0.0
    assert surface.height_step is None or surface.height_step < 1e-10


# Computed by another reader and filter, and recorded with the file: nm.
@pytest.mark.slow
@pytest.mark.parametrize(
    ("steps", "rq"),
    [
        ({"form": "line"}, 94.0),
        ({"form": "parabola"}, 38.0),
        ({"form": "parabola", "cutoff_long": 80e-6}, 9.0),
        ({"form": "parabola", "cutoff_long": 250e-6}, 8.8),
    ],
)
def test_dektak_roughness(steps, rq):
    assert rq_after(read_surface(DEKTAK), **steps) * 1e9 == pytest.approx(rq, rel=0.02, abs=0.0)


def rq_of_line(surface, index, along, form="parabola"):
    return statistics(processed(surface.line(index, along=along), Processing(form=form))[-1][1]).rq * 1e9


# Sizes, spacings and roughness recorded with the files by another reader and filter: um and nm.
@pytest.mark.slow
@pytest.mark.parametrize(
    ("steps", "rq"),
    [
        ({"form": "line"}, 245.0),
        ({"form": "parabola"}, 138.0),
        ({"form": "parabola", "cutoff_long": 80e-6}, 13.2),
        ({"form": "parabola", "cutoff_long": 800e-6}, 22.6),
        ({"form": "parabola", "cutoff_long": 800e-6, "trim": 0.0}, 40.0),
    ],
)
def test_contour_file(steps, rq):
    surface = read_surface(DATA / "hfm-1.hfm")
    assert surface.heights.shape == (1, 9600)
    assert surface.spacing_x == pytest.approx(0.5e-6, rel=1e-6, abs=0.0)
    assert rq_after(surface, **steps) * 1e9 == pytest.approx(rq, rel=0.02, abs=0.0)
    # Heights in steps of 2 to 3 nm.
    assert 1.9e-9 < surface.height_step < 3.1e-9


def test_real_x3p():
    surface = read_surface(DATA / "x3p-2-half.x3p")
    assert surface.heights.shape == (325, 650)
    assert (surface.spacing_x, surface.spacing_y) == pytest.approx(
        (0.127657e-6, 0.314582e-6), rel=1e-5, abs=0.0
    )
    assert rq_of_line(surface, 162, "row") == pytest.approx(86.0, rel=0.02, abs=0.0)
    assert rq_of_line(surface, 325, "column") == pytest.approx(17.0, rel=0.02, abs=0.0)


def test_real_al3d():
    surface = read_surface(DATA / "al3d-1.al3d")
    assert surface.heights.shape == (296, 200)
    assert (surface.spacing_x, surface.spacing_y) == pytest.approx(
        (0.438027e-6, 0.438027e-6), rel=1e-6, abs=0.0
    )
    rows, columns = np.indices(surface.heights.shape).reshape(2, -1)
    plane = np.stack([np.ones(rows.size), rows, columns], axis=1)
    z = surface.heights.ravel()
    rest = z - plane @ np.linalg.lstsq(plane, z, rcond=None)[0]
    assert np.std(rest) == pytest.approx(290e-9, rel=0.02, abs=0.0)


@pytest.mark.parametrize("name", ["x3p-2-half.x3p", "al3d-1.al3d"])
def test_readers_agree_with_surface_topography(name):
    pytest.importorskip("SurfaceTopography", exc_type=ImportError)
    ours, (heights, spacing_x, *_) = read_surface(DATA / name), _read_other(DATA / name)
    assert ours.spacing_x == pytest.approx(spacing_x)
    differences = (ours.heights - np.nanmean(ours.heights)) - (heights - np.nanmean(heights))
    np.testing.assert_allclose(differences, 0.0, atol=1e-15)


UNKNOWN = "# Width of the field 40 um x 24 um, heights in nm\n"
MATRIX = "# Channel: Height\n# Width: 40 um\n# Height: 24 um\n# Value units: nm\n"


def matrix_file(path, head=MATRIX):
    """Text matrix: 24 rows and 40 columns of heights, one node a micrometre."""
    rows, columns = np.indices((24, 40))
    heights = 10.0 * np.sin(0.3 * columns) + rows
    lines = ["\t".join(f"{z:.6e}" for z in row) for row in heights]
    path.write_text(head + "\n".join(lines))
    return path, 1e-9 * heights


class Topography:
    """Stand-in for a file of SurfaceTopography: heights (columns, rows) and the distances of its points."""

    def __init__(self, path):
        self._heights, self.pixel_size = np.loadtxt(path).T * 1e-9, (1e-6, 1e-6)
        self.channels, self.nb_grid_pts = [self], self._heights.shape

    def format(self):
        return "asc"

    def topography(self):
        return self

    def to_unit(self, unit):
        assert unit == "m"
        return self

    def heights(self):
        return self._heights


def test_text_matrix_goes_to_the_other_reader(tmp_path, monkeypatch):
    """By a stand-in for the package, which need not be installed."""
    package = ModuleType("SurfaceTopography")
    package.open_topography = Topography
    monkeypatch.setitem(sys.modules, "SurfaceTopography", package)
    path, heights = matrix_file(tmp_path / "matrix.txt", UNKNOWN)
    surface = read_surface(path)
    np.testing.assert_allclose(surface.heights, heights, atol=1e-14)
    assert (surface.spacing_x, surface.spacing_y) == (1e-6, 1e-6)
    assert surface.map().heights.shape == (40, 24)
    with pytest.raises(InputError, match=r"z_unit: .*'nm'"):
        read_surface(path, z_unit="nm")


def test_text_matrix_as_surface_topography_reads_it(tmp_path):
    pytest.importorskip("SurfaceTopography", exc_type=ImportError)
    path, heights = matrix_file(tmp_path / "matrix.txt")
    surface, other = read_surface(path), _read_other(path)
    np.testing.assert_allclose(surface.heights, heights, atol=1e-14)
    np.testing.assert_allclose(surface.heights, other.heights, atol=1e-14)
    spacings = surface.spacing_x, surface.spacing_y
    assert spacings == pytest.approx((1e-6, 1e-6), rel=1e-9, abs=0.0)
    assert (other.spacing_x, other.spacing_y) == pytest.approx(spacings, rel=1e-9, abs=0.0)


def test_text_matrix_without_the_package_says_what_reads_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)  # an import of it fails
    path, _ = matrix_file(tmp_path / "matrix.txt", UNKNOWN)
    with pytest.raises(InputError, match=r" 40 columns.*ehlectric\[ins"):
        read_surface(path)
    path.write_text(path.read_text().replace("1.000000e+00", "WORD"))
    with pytest.raises(InputError, match=r"line 3\b.*'WORD'"):
        read_surface(path, spacing=1e-6, z_unit="nm")


def text_file(path, *, header="x [um];z [nm]", rows=40, separator=";", change=lambda lines: lines):
    lines = [f"{0.5 * k:.1f}{separator}{10 * np.sin(k):.4f}" for k in range(rows)]
    path.write_text("\n".join([header, *change(lines)]))
    return path


@each("separator", [";", ",", "\t", " "])
def test_text_with_units_in_its_header(tmp_path, separator):
    header = separator.join(["x[um]", "z[nm]"])
    surface = read_surface(text_file(tmp_path / "a.txt", header=header, separator=separator))
    assert surface.spacing_x == pytest.approx(0.5e-6, rel=1e-12, abs=0.0)
    assert surface.heights[0, 1] == pytest.approx(10e-9 * np.sin(1), rel=1e-4, abs=0.0)


def test_units_may_be_given_and_must_not_contradict(tmp_path):
    bare = text_file(tmp_path / "bare.txt", header="position;height")
    with pytest.raises(InputError, match=r"^x_unit: "):
        read_surface(bare)
    assert read_surface(bare, x_unit="um", z_unit="nm").spacing_x == pytest.approx(0.5e-6)
    with pytest.raises(InputError, match=r"x_unit: .*'mm'.*'um'"):
        read_surface(text_file(tmp_path / "a.txt"), x_unit="mm")


def test_column_of_validity(tmp_path):
    lines = [f"{0.5 * k:.4f};{1e-3 * np.sin(k):.6f};{int(k % 10 != 0)}" for k in range(60)]
    path = tmp_path / "contour.hfm"
    path.write_text("\n".join(["X;Y;valid", "[mm];[mm];[1/0]", *lines]))
    surface = read_surface(path)
    assert surface.spacing_x == pytest.approx(0.5e-3)
    assert surface.voids == pytest.approx(0.1)
    line = surface.line()
    assert np.all(np.isfinite(line.heights))
    assert line.heights.size == 59  # the void at the start is left out


BAD_TEXT = [
    ({"rows": 3}, " 3 points"),
    ({"change": lambda lines: [*lines[:20], "here; text", *lines[20:]]}, "line 22\\b.*'here'"),
    ({"change": lambda lines: [*lines[:20], "30;0", *lines[21:]]}, "do not increase"),
    ({"change": lambda lines: [*lines[:20], *lines[25:]]}, "not uniform"),
    ({"header": "x [nm];z [mm]"}, "largest slope"),
    (
        {"change": lambda lines: [f"{k};{3 * k}" for k in range(len(lines))], "header": "x [um];z [um]"},
        "heights range",
    ),
    ({"change": lambda lines: [*lines[:20], "10.0;inf", *lines[21:]]}, "line 22\\b.*'inf'"),
]


@each("made, message", BAD_TEXT)
def test_doubtful_text_is_refused(tmp_path, made, message):
    with pytest.raises(InputError, match=message):
        read_surface(text_file(tmp_path / "a.csv", **made)).line()


@pytest.mark.parametrize("kind", ["D", "F"])
def test_x3p(tmp_path, kind):
    surface = read_surface(x3p(tmp_path / "a.x3p", MAP, CZ_DataType=kind))
    np.testing.assert_allclose(surface.heights, MAP, rtol=1e-6)
    assert (surface.spacing_x, surface.spacing_y) == (1.5e-7, 3e-7)
    np.testing.assert_allclose(surface.line(3).heights, MAP[3], rtol=1e-6)
    column = surface.line(5, along="column")
    np.testing.assert_allclose(column.heights, MAP[:, 5], rtol=1e-6)
    assert column.spacing == 3e-7


def test_al3d_with_padding_and_voids(tmp_path):
    heights = MAP.copy()
    heights[2, 7:10] = 1e30
    surface = read_surface(al3d(tmp_path / "a.al3d", heights))
    assert surface.heights.shape == (20, 31)
    assert np.isnan(surface.heights[2, 7:10]).all()
    assert surface.voids == pytest.approx(3 / 620)
    assert np.isfinite(surface.line(2).heights).all()


def test_files_that_are_cut_or_wrong(tmp_path):
    whole = x3p(tmp_path / "a.x3p", MAP).read_bytes()
    (tmp_path / "cut.x3p").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "no.x3p").write_text("no zip")
    (tmp_path / "binary.opd").write_bytes(bytes(range(256)))
    (tmp_path / "words.csv").write_text("nothing but words\n" * 20)
    al3d(tmp_path / "short.al3d", MAP, Rows="4000")
    for name, message in (
        ("cut.x3p", " X3P"),
        ("no.x3p", " X3P"),
        ("binary.opd", "X3P or AL3D|SurfaceTopography"),
        ("words.csv", "two columns"),
        ("short.al3d", " 513000\\b"),
        ("nowhere.csv", "no such file"),
    ):
        with pytest.raises(InputError, match=message):
            read_surface(tmp_path / name)


@pytest.mark.parametrize("tag", [b"Cols", b"PixelSizeXMeter", b"DepthImageOffset"])
def test_al3d_without_a_tag(tmp_path, tag):
    path = al3d(tmp_path / "a.al3d", MAP)
    path.write_bytes(path.read_bytes().replace(tag, b"x" * len(tag)))
    with pytest.raises(InputError, match="header"):
        read_surface(path)


def test_lines_that_are_not_there(tmp_path):
    heights = MAP.copy()
    heights[4] = 1e30
    surface = read_surface(al3d(tmp_path / "a.al3d", heights))
    with pytest.raises(InputError, match=r"20.* 0 to 19"):
        surface.line(20)
    with pytest.raises(InputError, match=r"row 4 .* 0 of 31"):
        surface.line(4)
    with pytest.raises(InputError, match="column"):
        read_surface(DEKTAK).line(0, along="column")
