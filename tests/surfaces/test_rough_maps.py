"""The roughness of a point contact: files and generators on a map, what is refused, what is said of it."""

import numpy as np
import pytest

from ehlectric import Case, InputError
from ehlectric.cases.roughness_inputs import Roughness, check_geometry
from ehlectric.surfaces import generated_profiles as generators
from ehlectric.surfaces.generated_profiles import Domain
from ehlectric.surfaces.maps import Map, statistics
from ehlectric.surfaces.rough_surfaces import measured, measured_map, rough_maps, whole_map
from ehlectric.surfaces.surface_files import read_surface
from ehlectric.surfaces.surface_warnings import map_variance_beyond as variance_beyond
from ehlectric.surfaces.surface_warnings import surface_warnings
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each
from tests.helpers.surface_writers import MAP, al3d, x3p
from tests.surfaces.test_files import DATA, DEKTAK

AL3D, X3P = str(DATA / "al3d-1.al3d"), str(DATA / "x3p-2-half.x3p")
GAUSSIAN = {"surface": 1, "generator": "gaussian", "rq": "10 nm", "correlation_length": "10 um", "seed": 3}
SELF_AFFINE = {
    "surface": 1, "generator": "self-affine", "rq": "10 nm", "hurst": 0.8, "rolloff_wavelength": "50 um",
    "shortest_wavelength": "5 um", "seed": 3,
}  # fmt: skip
RIDGES = GAUSSIAN | {"correlation_length_y": "50 um", "orientation": "30 deg"}

# That of a circle of 0.1 mm.
DOMAIN = Domain(-4.5e-4, 1.5e-4, 3e-4)
X, Y = np.linspace(-4.5e-4, 1.5e-4, 201), np.linspace(-3e-4, 3e-4, 161)


def surfaces_of(*tables, domain=DOMAIN):
    return rough_maps([Roughness.from_dict(table) for table in tables], domain)


def texts_of(*tables, dx=2e-6, dy=2e-6, domain=DOMAIN):
    made = [Roughness.from_dict(table) for table in tables]
    return list(map(str, surface_warnings(made, rough_maps(made, domain), domain, dx, dy)))


@pytest.mark.slow
@pytest.mark.parametrize("table", [GAUSSIAN, SELF_AFFINE, RIDGES], ids=["gaussian", "self-affine", "ridges"])
def test_a_seed_is_one_surface_whatever_the_contact(table):
    (one,) = surfaces_of(table)
    assert one.height(X, Y).shape == (201, 161)
    for domain in (Domain(-5e-4, 3e-4, 3e-4), Domain(-4.5e-4, 1.5e-4, 4.4e-4)):
        (other,) = surfaces_of(table, domain=domain)
        np.testing.assert_allclose(other.height(X, Y), one.height(X, Y), rtol=0.0, atol=1e-12 * 1e-8)
    assert texts_of(table) == []


def test_shifts_move_a_surface_along_both_axes():
    for table in (GAUSSIAN, RIDGES):
        plain, moved = surfaces_of(table, table | {"shift": "0.2 mm", "shift_y": "-50 um"})
        expected = plain.height(X[120:] - 2e-4, Y[:100] + 5e-5)
        np.testing.assert_allclose(moved.height(X[120:], Y[:100]), expected, rtol=0.0, atol=1e-20)
    bump = {"surface": 2, "generator": "asperity", "height": 2e-8, "width": 1e-5, "position_y": "20 um"}
    (top,) = surfaces_of(bump | {"shift": "10 um", "shift_y": "30 um"})
    assert top.height(np.array([1e-5]), np.array([5e-5])) == pytest.approx(2e-8)


@pytest.mark.slow
@pytest.mark.parametrize("table", [RIDGES, RIDGES | {"orientation": -70.0}], ids=["30", "-70"])
def test_ridges_lie_across_their_orientation(table):
    """Autocorrelation exp(-d.A d), A of 1/l^2 in turned axes: 1/sqrt(A_xx) along x; the mean product of the
    slopes is 2 rq^2 A_xy, whose sign is that of the turn. Over n = area/(pi l l_y/2) heights."""
    angle = np.deg2rad(30.0 if table is RIDGES else -70.0)
    c, s = np.cos(angle), np.sin(angle)
    u, v = 1 / 10e-6**2, 1 / 50e-6**2
    domain = Domain(-1.2e-3, 1.2e-3, 1.2e-3)
    (surface,) = surfaces_of(table, domain=domain)
    x = np.arange(-1.2e-3, 1.2e-3, 2e-6)
    z = surface.height(x, x)
    found = statistics(Map(2e-6, 2e-6, z))
    spread = 4 / np.sqrt(2 * 2.4e-3**2 / (np.pi / 2 * 10e-6 * 50e-6))
    assert found.sq == pytest.approx(1e-8, rel=spread, abs=0.0)
    assert found.correlation_length_x == pytest.approx((c * c * u + s * s * v) ** -0.5, rel=0.04, abs=0.0)
    assert found.correlation_length_y == pytest.approx((s * s * u + c * c * v) ** -0.5, rel=0.04, abs=0.0)
    assert found.correlation_length == pytest.approx(10e-6, rel=0.04, abs=0.0)
    gx, gy = np.gradient(z, 2e-6)
    assert np.mean(gx * gy) == pytest.approx(2 * 1e-16 * c * s * (u - v), rel=2 * spread + 0.03, abs=0.0)


def test_ridges_of_any_length_are_a_profile():
    """A correlation length of a metre across: nothing changes along the ridges."""
    for orientation, axis in ((0.0, 1), (90.0, 0)):
        long = GAUSSIAN | {"correlation_length_y": "1 m", "orientation": orientation}
        (surface,) = surfaces_of(long)
        z = surface.height(X, Y)
        assert np.max(np.ptp(z, axis=axis)) < 1e-10
        assert np.std(z) == pytest.approx(1e-8, rel=4 / np.sqrt(2 * 6e-4 / (1e-5 * np.sqrt(np.pi / 2))))
    assert texts_of(GAUSSIAN | {"correlation_length_y": "1 m", "orientation": 45.0}) == []


@pytest.mark.parametrize(
    ("path", "size", "spacing"),
    [(AL3D, (200, 296), (0.438027e-6, 0.438027e-6)), (X3P, (650, 325), (0.127657e-6, 0.314582e-6))],
    ids=["al3d", "x3p"],
)
def test_real_maps_are_used_whole(path, size, spacing):
    """Size and spacing are recorded with the files; Sq after a plane by least squares of all points."""
    raw = read_surface(path).heights
    rows, columns = np.indices(raw.shape)
    terms = np.column_stack([np.ones(raw.size), rows.ravel(), columns.ravel()])
    plane = (terms @ np.linalg.lstsq(terms, raw.ravel() - raw.mean(), rcond=None)[0]).reshape(raw.shape)
    left = raw - raw.mean() - plane
    surface = measured_map(Roughness(surface=1, file=path, form="line"))
    told = surface.describe()
    assert told["size"] == list(raw.shape)
    assert [step["step"] for step in told["steps"]] == ["as read", "form: line"]
    last = told["steps"][-1]
    assert (last["points_x"], last["points_y"]) == size
    assert (last["spacing_x"], last["spacing_y"]) == pytest.approx(spacing, rel=1e-5, abs=0.0)
    assert last["sq"] == pytest.approx(np.sqrt(np.mean(left**2)), rel=1e-6, abs=0.0)
    # The heights are where they were: x along a row, y with the number of the row.
    x = (np.arange(raw.shape[1]) - 0.5 * (raw.shape[1] - 1)) * last["spacing_x"]
    y = (np.arange(raw.shape[0]) - 0.5 * (raw.shape[0] - 1)) * last["spacing_y"]
    np.testing.assert_allclose(surface.height(x, y), left.T, rtol=0.0, atol=1e-12)


def test_roughness_of_the_real_map_is_that_recorded_with_it():
    """Sq 290 nm after a plane."""
    (_, last) = measured_map(Roughness(surface=1, file=AL3D, form="line")).steps[-1]
    assert statistics(last).sq * 1e9 == pytest.approx(290.0, abs=0.5)


def test_along_turns_a_map_and_does_not_mirror_it(tmp_path):
    """Columns along x: what was at the end of a row is then at the side of negative y."""
    path = x3p(tmp_path / "a.x3p", MAP)
    by_rows, by_columns = (
        measured_map(Roughness(surface=1, file=str(path), along=along)) for along in ("row", "column")
    )
    x, y = by_rows.steps[-1][1].x, by_rows.steps[-1][1].y
    z = by_rows.height(x, y)
    np.testing.assert_allclose(z, MAP.T - MAP.mean(), rtol=0.0, atol=1e-20)
    # A quarter of a turn, clockwise: the height at (x, y) goes to (y, -x).
    np.testing.assert_allclose(by_columns.height(y, -x), z.T, rtol=0.0, atol=1e-20)


@pytest.mark.slow
def test_profiles_and_lines_are_extended_along_the_lay():
    dektak = {"surface": 1, "file": str(DEKTAK), "form": "parabola", "shift": "20 um", "shift_y": "70 um"}
    line = {"surface": 1, "file": AL3D, "form": "line", "line": 7}
    for table in (dektak, line, line | {"along": "column"}):
        across, along = surfaces_of(table, table | {"direction": "y"})
        profile = measured(Roughness.from_dict(table))
        z = profile.height(X)
        np.testing.assert_array_equal(across.height(X, Y), np.repeat(z[:, np.newaxis], Y.size, axis=1))
        moved = Y + (table.get("shift") is not None) * (20e-6 - 70e-6)
        expected = np.broadcast_to(profile.height(moved), (X.size, Y.size))
        np.testing.assert_allclose(along.height(X, Y), expected, rtol=0.0, atol=1e-20)
        assert across.describe() == profile.describe()
        assert (across.extent, along.extent[::-1]) == ((profile.extent, np.inf),) * 2


@pytest.mark.parametrize("extend", ["mirror", "repeat", "flat"])
def test_nothing_is_above_a_cut(extend):
    table = {"surface": 1, "file": AL3D, "form": "line", "truncate": "200 nm", "extend": extend}
    (surface,) = surfaces_of(table)
    heights = surface.height(np.linspace(-1e-4, 1e-4, 900), np.linspace(-1e-4, 1e-4, 800))
    assert np.max(np.abs(heights)) == 200e-9
    said = texts_of(table, dx=0.5e-6, dy=0.5e-6)
    share = np.mean(np.abs(surface.steps[1][1].heights) > 200e-9)
    assert f"truncate cuts {100 * share:.2g} % of the points of surface 1" in said[0]
    # 200 and 296 points: the domain reaches 0.45 mm and 0.3 mm from the middle.
    assert said[1] == (
        "surface 1 is 87.17 µm long along x, but the domain needs 900 µm (and is also too short along y). "
        f"The map was continued by extend = '{extend}'. Use a larger map, or change roughness.shift or raise "
        "grid.inlet."
    )


def test_voids_are_filled_and_said(tmp_path):
    """Heights of a saddle, which has no Laplacian: the filling is exact. A void border is left out."""
    rows, columns = np.indices((40, 60))
    whole = 1e-3 + 1e-9 * (rows - 7.0) * (columns - 11.0)
    held = whole.copy()
    held[10:15, 20:30] = held[30, 40] = np.nan
    held[:, :4] = np.nan
    path = x3p(tmp_path / "a.x3p", held, CY_Increment="1.5e-7")
    surface = measured_map(Roughness(surface=2, file=str(path)))
    assert surface.steps[0][1].heights.shape == (56, 40)
    np.testing.assert_allclose(surface.steps[0][1].heights, whole[:, 4:].T, rtol=0.0, atol=1e-14)
    void = (51 + 160) / 2400
    assert surface.describe()["voids"] == pytest.approx(void)
    assert (
        f"{100 * void:.2g} % of the map of surface 2 contained no data and was filled"
        in surface.warnings[0].text
    )


def holed(path, share, **kind):
    """A map whose inner points are void in part."""
    heights = 1e-9 * np.add.outer(np.arange(40.0), np.arange(50.0))
    heights[1:-1, 1:-1].flat[: round(share * 2000)] = kind.get("void", 1e30)
    return str(al3d(path / "a.al3d", heights))


def test_too_many_voids_are_refused(tmp_path):
    measured_map(Roughness(surface=1, file=holed(tmp_path, 0.2)))
    with pytest.raises(InputError, match=r" 1580 of 40 x 50 points.* 16"):
        measured_map(Roughness(surface=1, file=holed(tmp_path, 0.21)))


def test_maps_that_cannot_be_used(tmp_path, monkeypatch):
    few = str(x3p(tmp_path / "few.x3p", MAP[:15]))
    steep = str(x3p(tmp_path / "steep.x3p", 1e4 * MAP, CX_Increment="1e-6", CY_Increment="1e-6"))
    high = str(x3p(tmp_path / "high.x3p", np.outer(np.ones(20), 5e-7 * np.arange(20)), CY_Increment="1e-7"))
    for table, message in (
        ({"file": few}, " 465 of 15 x 31 points.* 16"),
        ({"file": steep}, "slopes .* 5;"),
        ({"file": high}, " 9.5e-06 m.* 2.85e-06 m"),
        ({"file": AL3D, "direction": "y"}, "direction: .*'y'.*along = 'column'"),
        ({"file": AL3D, "cutoff_long": "0.1 mm"}, "cutoff: .*100 µm"),
        ({"file": AL3D, "trim": "41 um"}, "trim: .*41 µm.* 12 x 108 .* 200 x 296"),
    ):
        with pytest.raises(InputError, match=message) as caught:
            surfaces_of({"surface": 1} | table)
        assert "\n" not in str(caught.value)
    for table, message in (
        ({"line": 3}, "line: .* 3 "),
        ({}, "profile.* map"),
    ):
        with pytest.raises(InputError, match=message):
            whole_map(Roughness(surface=1, file=str(DEKTAK), **table))
    monkeypatch.setattr("ehlectric.surfaces.surface_files.MOST_MAP_POINTS", 50_000)
    with pytest.raises(InputError, match=r" 5.92e\+04 points"):
        surfaces_of({"surface": 1, "file": AL3D})


SINUSOID = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm"}
PIT = {"surface": 1, "generator": "pit", "depth": "20 nm"}


def test_made_shapes_are_those_of_the_line_contact_along_x():
    (wave, pit) = surfaces_of(
        SINUSOID | {"wavelength": "50 um", "phase": 1.0}, PIT | {"width": "40 um", "rim": "4 nm"}
    )
    expected = generators.sinusoid(X, amplitude=2e-8, wavelength=5e-5, phase=1.0)
    np.testing.assert_allclose(wave.height(X, Y), np.repeat(expected[:, np.newaxis], Y.size, axis=1))
    expected = generators.pit(X, depth=2e-8, width=4e-5, rim=4e-9)
    np.testing.assert_allclose(pit.height(X, np.zeros(1))[:, 0], expected, rtol=0.0, atol=1e-22)
    assert wave.describe()["steps"] == []


WRONG = [
    (
        GAUSSIAN | {"correlation_length": "61 um"},
        "^roughness.correlation_length: .*6.1e-05 m",
    ),
    (
        SELF_AFFINE | {"rolloff_wavelength": "1 m"},
        "^roughness.rolloff_wavelength: .* 1 m.* 6e-05",
    ),
    (GAUSSIAN | {"correlation_length": "0.1 um"}, "^roughness.correlation_length: "),
    (SELF_AFFINE | {"shortest_wavelength": "0.1 um"}, "^roughness.shortest_wavelength: "),
    (PIT | {"width": "0.7 mm"}, "^roughness.width: .* 0.0007 m"),
    ({"surface": 1, "file": "nowhere.x3p"}, "nowhere.x3p: "),
]


@each("table, message", WRONG)
def test_what_does_not_fit_the_domain_is_refused(table, message):
    with pytest.raises(InputError, match=message) as caught:
        surfaces_of(table)
    assert "\n" not in str(caught.value)


FOR_POINTS = [
    (GAUSSIAN | {"correlation_length_y": 1e-5}, "correlation_length_y"),
    (SINUSOID | {"wavelength": 1e-5, "orientation": 0.0}, "orientation"),
    (PIT | {"width": 1e-5, "position_y": 0.0}, "position_y"),
    (GAUSSIAN | {"shift_y": 1e-5}, "shift_y"),
]


@each("table, key", FOR_POINTS)
def test_keys_of_point_contacts_are_refused_for_lines(table, key):
    with pytest.raises(InputError, match=f"^roughness.{key}: .*line contact"):
        Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "roughness": [table]})
    check_geometry([Roughness.from_dict(table)], "point")


def test_keys_of_line_contacts_are_refused_for_points():
    across = {"surface": 1, "file": "a", "direction": "y"}
    check_geometry([Roughness.from_dict(across)], "point")
    with pytest.raises(ValueError, match=r"roughness\.assume_transverse: .*point contact"):
        check_geometry([Roughness.from_dict(across | {"assume_transverse": True})], "point")
    with pytest.raises(InputError, match=r"orientation: .*30 deg"):
        Roughness.from_dict(GAUSSIAN | {"orientation": "30 deg"})
    with pytest.raises(InputError, match=r"orientation: .*'200 deg'"):
        Roughness.from_dict(RIDGES | {"orientation": "200 deg"})


# Nodes are 3 um apart along x and 2 um along y; eight of them are 24 and 16 um.
SHAPES = [
    (SINUSOID | {"wavelength": "23.9 um"}, "the sinusoid of surface 1, whose wavelength along x is 23.9 µm"),
    (SINUSOID | {"wavelength": "24.1 um"}, None),
    (SINUSOID | {"wavelength": "16.1 um", "orientation": 90.0}, None),
    (SINUSOID | {"wavelength": "15.9 um", "orientation": 90.0}, "whose wavelength along y is 15.9 µm"),
    (SINUSOID | {"wavelength": "20 um", "orientation": "45 deg"}, None),
    (PIT | {"width": "24.1 um"}, None),
    (PIT | {"width": "23.9 um"}, "the pit of surface 1, whose width is 23.9 µm"),
    (PIT | {"width": "24.1 um", "rim": "2 nm"}, "the rim of the pit of surface 1, whose width is 12.1 µm"),
    (PIT | {"width": "5 um", "position_y": "0.32 mm"}, None),
    (PIT | {"width": "5 um", "position_y": "0.32 mm", "shift_y": "-50 um"}, "the pit of surface 1"),
    (GAUSSIAN | {"correlation_length": "6.2 um"}, None),
    (GAUSSIAN | {"correlation_length": "5.5 um"}, "whose correlation length along x is 5"),
    (
        GAUSSIAN | {"correlation_length": "10 um", "correlation_length_y": "3 um"},
        "the map of surface 1, whose correlation length along y is 3",
    ),
]  # fmt: skip


@pytest.mark.slow
@each("table, message", SHAPES)
def test_shapes_finer_than_the_grid_are_said(table, message):
    said = texts_of(table, dx=3e-6, dy=2e-6)
    if message is None:
        assert said == []
    else:
        assert len(said) == 1
        assert f"does not resolve {message}" in said[0] or message in said[0]
        assert "error estimate is not meaningful" in said[0]


@pytest.mark.parametrize("orientation", [0.0, 90.0, 30.0])
def test_variance_that_the_grid_misses_is_measured(orientation):
    """Of two crossed waves 9 to 1 in power, the weaker counts where an axis of the grid cannot hold it."""
    x, y = 1e-7 * np.arange(900)[:, np.newaxis], 1e-7 * np.arange(800)
    surface = Map(1e-7, 1e-7, 3e-8 * np.sin(2e5 * y) + 1e-8 * np.sin(2 * np.pi * 8e5 * x))
    turn = np.deg2rad(orientation)
    # The weaker wave lies along the map's x axis, which is turned.
    fx, fy = 8e5 * abs(np.cos(turn)), 8e5 * abs(np.sin(turn))
    assert variance_beyond(surface, 1.1 * fx + 1e5, 1.1 * fy + 1e5, orientation) < 1e-5
    if fx > 1e5:
        assert variance_beyond(surface, 0.9 * fx, 1e7, orientation) == pytest.approx(0.1, rel=2e-2, abs=0.0)
    if fy > 1e5:
        assert variance_beyond(surface, 1e7, 0.9 * fy, orientation) == pytest.approx(0.1, rel=2e-2, abs=0.0)


@pytest.mark.slow
def test_variance_that_the_grid_misses_is_said():
    rough = SELF_AFFINE | {"hurst": 0.2, "rolloff_wavelength": "30 um", "shortest_wavelength": "2.5 um"}
    small = Domain(-2e-4, 2e-4, 2e-4)
    (said,) = texts_of(rough, domain=small)
    assert "the grid spacing of 2 x 2 µm misses" in said
    assert "of the variance of surface 1" in said
    assert "cutoff_short of at least 8 µm" in said
    # That cutoff does it.
    assert texts_of(rough | {"cutoff_short": "8 um"}, domain=small) == []
    assert texts_of(rough, dx=1e-6, dy=1e-6, domain=small) == []


def test_warnings_of_extended_profiles():
    """Lines go by the spacing across their ridges: nodes 0.4 um apart along x, or along y."""
    line = {"surface": 1, "file": X3P, "form": "line", "line": 100, "extend": "repeat"}
    fine, coarse = 0.05e-6, 3e-6
    across, along = line, line | {"direction": "y"}
    assert any("does not resolve the profile of surface 1" in t for t in texts_of(across, dx=coarse, dy=fine))
    assert any("does not resolve the profile of surface 1" in t for t in texts_of(along, dx=fine, dy=coarse))
    for table, grid in ((across, (fine, coarse)), (along, (coarse, fine))):
        (said,) = texts_of(table, dx=grid[0], dy=grid[1])
        assert "was continued by extend = 'repeat'" in said
    assert "µm long along y, but the domain needs 600 µm" in said


def test_one_seed_for_two_surfaces_is_said():
    (said,) = texts_of(GAUSSIAN, GAUSSIAN | {"surface": 2})
    assert "2 rough surfaces have the seed 3" in said
