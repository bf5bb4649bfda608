"""Figures and animations of roughness that moves, of runs made by hand: what they show and leave out."""

import os
import stat
import sys
from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from PIL import Image

from ehlectric import Case, InputError, figure_names, save_figures
from ehlectric.figures import motion_figures as motion_beside
from ehlectric.figures import motion_figures as motion_history
from ehlectric.figures import motion_figures as motion_maps
from ehlectric.figures import style as drawing
from ehlectric.figures.animation import line_frames, map_frames, save_animation
from ehlectric.figures.figure_names import MOTION_FIGURE_FILES
from ehlectric.figures.motion_figures import comparison_with_stationary, history, maps
from ehlectric.figures.motion_panels import speed_text
from ehlectric.motion.stored_run import MotionRun, intervals_above
from ehlectric.quantities.palette import OUT_OF_RANGE, RED
from tests.helpers.each import each
from tests.helpers.titles import title_of

HISTORY, MAPS, BESIDE = MOTION_FIGURE_FILES
VOLTS, MEAN, SLIDE, STEPS = 2.0, 4.0, 0.5, 200
CONTACT = {
    "reduced_radius": "14.1 mm",
    "reduced_modulus": "226 GPa",
    "max_hertz_pressure": "1 GPa",
    "entrainment_speed": MEAN,
    "slide_to_roll_ratio": SLIDE,
}
BALL = {
    "geometry": "point",
    "radius_x": "10 mm",
    "radius_y": "10 mm",
    "reduced_modulus": "226 GPa",
    "load": "30 N",
    "entrainment_speed": MEAN,
}
WAVE = {"generator": "sinusoid", "amplitude": "50 nm", "wavelength": "100 um"}
# 4 p_h R/E', the half-width of the line contact (Hertz).
HALF_WIDTH = 4.0 * 1e9 * 14.1e-3 / 226e9
END = 12.0 * HALF_WIDTH / MEAN


def by_hand(*, contact=CONTACT, surfaces=(1,), frames=41, still=True, **attributes):
    """A run whose field is 1.1 times the voltage over its film, of a pressure that stays that of Hertz.

    The film is 0.5 um, and 8 um (r/b - 1)^2 more beyond the edge of the contact. From a third of the run on
    it swings by 0.1 um, with a tenth of the run as its period.
    """
    point = contact.get("geometry") == "point"
    table = {"contact": contact, "lubricant": {"base": "paper"}, "motion": {"passes": 2.0}}
    case = Case.from_dict(table | {"roughness": [{"surface": k} | WAVE for k in surfaces]})
    b = MotionRun.of(_one_instant(case)).conditions.half_width
    axes = {"x": b * np.linspace(-4.0, 2.0, 121)} | ({"y": b * np.linspace(-2.0, 2.0, 41)} if point else {})
    radius = np.sqrt(sum(np.square(axis) for axis in np.meshgrid(*axes.values(), indexing="ij"))) / b
    time = np.linspace(0.0, END, STEPS + 1)
    swing = np.where(time > END / 3.0, 0.1e-6 * np.sin(20.0 * np.pi * time / END), 0.0)
    kept = np.unique(np.round(np.linspace(0, STEPS, frames)).astype(int))
    along = np.where(time[kept] > END / 3.0, 1.0, 0.0)
    along = along.reshape(-1, *(1 for _ in axes)) * np.cos(6.0 * (axes["x"] / b).reshape(-1, *(1,) * point))
    film = 0.5e-6 + swing[kept].reshape(-1, *(1,) * radius.ndim) + 8e-6 * np.maximum(radius - 1.0, 0.0) ** 2
    strength = np.where(radius <= 1.25, 1.1 * VOLTS / film, np.nan)
    pressure = 1e9 * np.sqrt(np.maximum(1.0 - radius**2, 0.0)) + 0.0 * film
    least = 0.5e-6 + swing
    grid = tuple(axes)
    nodes = {
        "pressure": pressure,
        "thickness": film,
        "strength": strength,
        "roughness_1": 50e-9 * along + 0.0 * film,
        "roughness_2": 0.0 * film,
    }
    values = {name: (("frame", *grid), array) for name, array in nodes.items()}
    values |= {
        "time": ("step", time),
        "minimum_thickness": ("step", least),
        "thin_gap_strength": ("step", VOLTS / least),
        "minimum_x": ("step", 0.25 * b + 0.0 * time),
        "frame_step": ("frame", kept),
        "frame_time": ("frame", time[kept]),
        "max_strength": ("frame", 1.1 * VOLTS / least[kept]),
        "max_strength_x": ("frame", 0.5 * b + 0.0 * time[kept]),
    }
    if point:
        values["max_strength_y"] = ("frame", -0.75 * b + 0.0 * time[kept])
    if still:
        values |= {
            "stationary_thickness": (grid, film[0] + 0.2e-6),
            "stationary_pressure": (grid, 0.5 * pressure[0]),
            "stationary_strength": (grid, 0.5 * strength[0]),
        }
    plain = {"title": "By hand", "complete": 1, "covered_from": END / 2.0, "coincident": END / 4.0}
    return xr.Dataset(values, coords=axes, attrs={"case": case.to_toml()} | plain | attributes)


def _one_instant(case):
    zero = {name: ("step", [0.0]) for name in ("time", "minimum_thickness", "thin_gap_strength")}
    zero |= {name: ("frame", [0.0]) for name in ("frame_time", "thickness", "pressure", "strength")}
    return xr.Dataset(zero, attrs={"case": case.to_toml()})


@pytest.fixture(scope="module")
def run():
    return MotionRun.of(by_hand())


@pytest.fixture(scope="module")
def ball():
    return MotionRun.of(by_hand(contact=BALL))


def line(ax, start):
    """The only line whose label starts so."""
    (found,) = [line for line in ax.get_lines() if line.get_label().startswith(start)]
    return found


def mesh_of(ax):
    (mesh,) = ax.collections
    return mesh


def test_what_is_no_run_is_refused_in_one_line():
    with pytest.raises(InputError, match="'strength'") as caught:
        figure_names(by_hand().drop_vars("strength"))
    assert "\n" not in str(caught.value)


def test_speeds_are_those_of_rough_surfaces():
    # u (1 + S/2) and u (1 - S/2).
    assert MotionRun.of(by_hand(surfaces=(1, 2))).speeds == {1: pytest.approx(5.0), 2: pytest.approx(3.0)}
    assert MotionRun.of(by_hand(surfaces=(2,))).speeds == {2: pytest.approx(3.0)}


def test_speeds_are_said(run, ball):
    assert speed_text(run) == "surface 1 at 5 m/s, surface 2 at 3 m/s, surface 1 rough"
    assert speed_text(ball) == "pure rolling at 4 m/s, surface 1 rough"


@pytest.mark.slow
def test_steps_and_instants_without_a_time_are_left_out():
    dataset = by_hand(complete=0)
    dataset["time"][150:], dataset["frame_time"][30:] = np.nan, np.nan
    run = MotionRun.of(dataset)
    assert (run.dataset.sizes["step"], run.frames) == (150, 30)
    over = history(run).get_figure()._suptitle
    assert over.get_text().startswith("NOT COMPLETE, ends at ")
    assert over.get_color() == RED


def test_time_above_a_level_is_that_of_a_sine():
    # A sine is above 0.9 for (pi - 2 asin 0.9)/(2 pi) of its period; chords of 1000 points lose the square of
    # their length.
    time = np.linspace(0.0, 3.0, 3001)
    spans = intervals_above(time, np.sin(2.0 * np.pi * time), 0.9)
    assert spans.shape == (3, 2)
    np.testing.assert_allclose(np.diff(spans).ravel(), 0.5 - np.arcsin(0.9) / np.pi, atol=1e-5)


@pytest.mark.parametrize(("values", "length"), [([1.0, 1.0, 1.0], 2.0), ([0.0, 0.0, 0.0], 0.0)])
def test_time_above_a_level_may_be_all_or_none(values, length):
    assert np.sum(np.diff(intervals_above(np.arange(3.0), np.array(values), 0.5))) == length


def test_field_between_instants_goes_as_that_of_the_thin_gap(run):
    # It is 1.1 times that at the instants, so everywhere, also at those steps that no instant is near.
    np.testing.assert_allclose(run.field_history.strength, 1.1 * run.values("thin_gap_strength"), rtol=1e-12)


def test_history_says_how_long_the_field_is_high():
    # From the middle of the run on, five periods of V/(h0 + a sin): at 41 instants the largest is found, as
    # four of them are in a period. It is above 0.9 of V/(h0 - a) where sin < (h0 - a)/(0.9 a) - h0/a.
    bound = (0.4 / 0.9 - 0.5) / 0.1
    share = 100.0 * (0.5 - np.arcsin(-bound) / np.pi)
    ax = motion_history.largest_field(MotionRun.of(by_hand()))
    text = line(ax, "90 % of the maximum").get_label()
    assert f"above it {share:.0f} % of the time from {1e3 * END / 2.0:.3g} ms on" in text
    (bars,) = ax.collections
    ends = np.array([path.vertices[:, 0] for path in bars.get_paths()])
    # Shaded are all of the run: seven periods begin in its last two thirds.
    assert len(ends) == 7
    np.testing.assert_allclose(np.ptp(ends, axis=1)[1:-1] / (1e3 * END / 10.0), share / 100.0, atol=0.01)


def test_history_has_the_film_before_and_held_still(run):
    ax = motion_history.least_film(run)
    assert line(ax, "before the motion").get_ydata()[0] == pytest.approx(0.5)
    assert line(ax, "stationary").get_ydata()[0] == pytest.approx(0.7)
    assert line(ax, "contact covered").get_xdata()[0] == pytest.approx(1e3 * END / 2.0)
    # Half of 1.1 V/h before the motion, in V/um.
    ax = motion_history.largest_field(run)
    assert line(ax, "stationary").get_ydata()[0] == pytest.approx(0.5 * 1.1 * VOLTS / 0.5)
    ax = motion_history.least_film(run)
    bare = motion_history.least_film(MotionRun.of(by_hand(still=False, covered_from=np.nan)))
    assert len(bare.get_lines()) == len(ax.get_lines()) - 2


def test_places_are_in_half_widths(run, ball):
    ax = motion_history.places(run)
    np.testing.assert_allclose(line(ax, "maximum field").get_ydata(), 0.5)
    ax = motion_history.places(ball)
    np.testing.assert_allclose(line(ax, "maximum field, $|y|/b$").get_ydata(), 0.75)


@pytest.mark.slow
def test_maps_have_time_upwards_and_the_film_of_the_contact_in_colours(run):
    ax = motion_maps.film_map(run)
    mesh = mesh_of(ax)
    shown = np.abs(run.x) <= 1.5
    np.testing.assert_allclose(mesh.get_array(), 1e6 * run.along("thickness")[:, shown])
    assert ax.get_ylim()[0] < ax.get_ylim()[1]
    low, high = mesh.get_clim()
    # The wave goes from 0.4 to 0.6 um; at -1.5 b the film is 2.5 um.
    assert low == pytest.approx(0.4)
    assert 0.55 < high <= 0.6 + 1e-9


def test_field_map_reaches_to_the_largest_field_and_shows_where_there_is_none(run):
    mesh = mesh_of(motion_maps.field_map(run))
    assert mesh.get_clim()[1] == pytest.approx(1.1 * VOLTS / 0.4e-6 * 1e-6)
    outside = np.abs(run.x[np.abs(run.x) <= 1.5]) > 1.25
    assert np.all(np.ma.getmaskarray(mesh.get_array())[:, outside])
    assert "field not solved" in [t.get_text() for t in maps(run).get_figure().legends[0].get_texts()]


@pytest.mark.slow
def test_lines_of_speeds_have_their_slopes():
    run = MotionRun.of(by_hand(surfaces=(1, 2)))
    ax = motion_maps.pressure_map(run)
    slopes = {line.get_label(): line.get_slope() for line in ax.get_lines()}
    # Times in ms over x/b, for 4, 5 and 3 m/s.
    expected = {"mean speed": 4.0, "speed of surface 1": 5.0, "speed of surface 2": 3.0}
    assert slopes == pytest.approx({name: 1e3 * HALF_WIDTH / speed for name, speed in expected.items()})


def test_lines_of_surfaces_against_entrainment_and_at_rest():
    back = MotionRun.of(by_hand(contact=CONTACT | {"slide_to_roll_ratio": -2.5}))
    assert line_slope(back, "speed of surface 1") == pytest.approx(-1e3 * HALF_WIDTH)
    rest = MotionRun.of(by_hand(contact=CONTACT | {"slide_to_roll_ratio": -2.0}, surfaces=(1, 2)))
    assert np.isinf(line_slope(rest, "speed of surface 1"))


def line_slope(run, name):
    """Of the lines of a speed, which are alike."""
    return next(at for at in motion_maps.film_map(run).get_lines() if at.get_label() == name).get_slope()


def test_waves_of_pure_rolling_have_one_line(ball):
    names = {at.get_label() for at in motion_maps.film_map(ball).get_lines()}
    assert names == {"mean speed, also of surface 1"}


@pytest.mark.slow
def test_point_contacts_are_mapped_on_their_middle_line(ball):
    # The run is symmetric in y, of which the middle node is 0.
    middle = ball.dataset["thickness"].values[:, :, 20]
    np.testing.assert_array_equal(ball.along("thickness"), middle)
    assert "$y$ = 0" in motion_maps.film_map(ball).get_xlabel()


def test_moving_lies_beside_stationary_where_their_films_differ_most(run):
    """The film swings by 0.1 um around 0.5 um, and the stationary one is 0.7 um: 0.4 um differs most."""
    frame = motion_beside.compared_frame(run)
    least = 1e6 * run.along("thickness")[frame].min()
    assert least == pytest.approx(0.4, rel=1e-6)
    assert run.frame_time[frame] >= run.field_history.settled_from
    ax = motion_beside.compared_film(run)
    np.testing.assert_allclose(line(ax, "moving").get_ydata(), 1e6 * run.along("thickness")[frame])
    still = line(ax, "stationary")
    np.testing.assert_allclose(still.get_ydata(), 1e6 * (run.along("thickness")[0] + 0.2e-6))
    assert still.get_label() == "stationary, min. 0.7 µm"
    field = motion_beside.compared_field(run)
    assert line(field, "stationary").get_label() == "stationary, max. 2.2 V/µm"
    title = " ".join(title_of(comparison_with_stationary(run).get_figure()))
    # 0.4 um is 43 % less than 0.7 um.
    assert title.startswith(
        "Minimum film 0.4 µm moving, 43 % thinner than with stationary roughness (0.7 µm)"
    )
    assert f"at t = {1e3 * run.frame_time[frame]:.4g} ms, where the minimum films differ most" in title


def test_roughness_below_is_that_of_the_instant_and_of_stationary_surfaces():
    run = MotionRun.of(by_hand(coincident=END / 2.0))
    lowest = comparison_with_stationary(run).get_figure().axes[3]
    frame, there = motion_beside.compared_frame(run), int(np.argmin(np.abs(run.frame_time - END / 2.0)))
    for name, at in (("surface 1", frame), ("surface 1, stationary", there)):
        (found,) = [of for of in lowest.get_lines() if of.get_label() == name]
        np.testing.assert_allclose(found.get_ydata(), 1e9 * run.along("roughness_1")[at])
        assert np.ptp(found.get_ydata()) == pytest.approx(100.0, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(("still", "text"), [(0.4, "as thick as with"), (0.3, "33 % thicker than with")])
def test_history_titles_the_film_beside_stationary_roughness(still, text):
    dataset = by_hand()
    dataset["stationary_thickness"] = dataset["stationary_thickness"] + 1e-6 * (still - 0.7)
    title = " ".join(title_of(history(MotionRun.of(dataset)).get_figure()))
    assert title.startswith(f"Minimum film 0.4 µm, {text} stationary roughness ({still:g} µm)")


def test_history_leaves_out_the_time_in_which_nothing_happens(run):
    """The film changes from a third of the run on; a twentieth of the run is shown before."""
    ax = motion_history.least_film(run)
    low, high = ax.get_xlim()
    assert low == pytest.approx(1e3 * (END / 3.0 - END / 20.0), abs=2e3 * END / STEPS)
    assert high == pytest.approx(1e3 * END)
    assert ax.get_xlabel().endswith(f"film unchanged before {low:.3g} ms")
    dataset = by_hand()
    time = dataset["time"].values
    dataset["minimum_thickness"] = ("step", 0.5e-6 + 0.1e-6 * np.sin(20.0 * np.pi * time / END))
    assert motion_history.least_film(MotionRun.of(dataset)).get_xlim()[0] == 0.0


@pytest.mark.slow
def test_what_is_one_number_is_no_panel_but_said(run):
    """The places of this run do not change; a field that stays near its maximum is not shaded."""
    assert not motion_history.places_vary(run)
    assert len(history(run).get_figure().axes) == 2
    dataset = by_hand()
    moved = dataset["max_strength_x"].values + 0.05 * HALF_WIDTH * np.arange(41) / 40.0
    dataset["max_strength_x"] = ("frame", moved)
    assert len(history(MotionRun.of(dataset)).get_figure().axes) == 3
    calm = by_hand()
    swing = 0.01e-6 * np.sin(20.0 * np.pi * calm["time"].values / END)
    calm["minimum_thickness"] = ("step", 0.5e-6 + swing)
    calm["thin_gap_strength"] = ("step", VOLTS / (0.5e-6 + swing))
    calm["max_strength"] = ("frame", 1.1 * VOLTS / (0.5e-6 + swing)[calm["frame_step"].values])
    calm_run = MotionRun.of(calm)
    ax = motion_history.largest_field(calm_run)
    assert not [found for found in ax.get_lines() if "90 %" in found.get_label()]
    assert not ax.collections
    level = 0.9 * 1e-6 * calm_run.field_history.strength[calm_run.values("time") >= END / 2.0].max()
    assert f"above 90 % of its largest value ({level:.3g} V/µm)" in " ".join(
        title_of(history(calm_run).get_figure())
    )


@pytest.mark.slow
def test_maps_say_the_extremes_and_are_grey_beyond_their_colours(run):
    title = " ".join(title_of(maps(run).get_figure()))
    at = 1e3 * run.values("time")[np.argmin(run.values("minimum_thickness"))]
    assert title.startswith(f"Minimum film 0.4 µm at t = {at:.3g} ms, maximum field 5.5 V/µm at t = ")
    colours = mesh_of(motion_maps.film_map(run)).get_cmap()
    np.testing.assert_allclose(colours(2.0), to_rgba(OUT_OF_RANGE))
    np.testing.assert_allclose(colours(-1.0), to_rgba(OUT_OF_RANGE))


@pytest.mark.slow
@pytest.mark.parametrize("contact", [CONTACT, BALL])
def test_figures_are_written(contact, tmp_path, monkeypatch):
    monkeypatch.setitem(drawing._SCREEN, "savefig.dpi", 60)
    files = save_figures(by_hand(contact=contact), tmp_path)
    assert [file.name for file in files] == [HISTORY, MAPS, BESIDE]
    assert sorted(tmp_path.iterdir()) == sorted(files)
    for file in files:
        with Image.open(file) as image:
            assert image.size[0] == 7.2 * 60


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "left"),
    [
        ({"coincident": np.nan}, [HISTORY, MAPS]),
        ({"coincident": 2.0 * END}, [HISTORY, MAPS]),
        ({"still": False}, [HISTORY, MAPS]),
        ({"frames": 1, "coincident": np.nan}, [HISTORY]),
    ],
)
def test_figures_with_nothing_to_show_are_left_out(changes, left, tmp_path, monkeypatch):
    monkeypatch.setattr("ehlectric.figures.style.save_figure", lambda _, path, *__: [path])
    assert [file.name for file in save_figures(by_hand(**changes), tmp_path)] == left


def test_frames_show_their_instant(run):
    frames = line_frames(run)
    frames.show(30)
    film, pressure, field, rough = frames.figure.axes
    np.testing.assert_allclose(film.get_lines()[1].get_ydata(), 1e6 * run.along("thickness")[30])
    np.testing.assert_allclose(pressure.get_lines()[1].get_ydata(), 1e-9 * run.along("pressure")[30])
    np.testing.assert_allclose(rough.get_lines()[0].get_ydata(), 1e9 * run.along("roughness_1")[30])
    largest = 1.1 * VOLTS / run.values("minimum_thickness")[5 * 30] * 1e-6
    assert field.get_lines()[2].get_ydata() == pytest.approx([largest])
    assert film.get_title(loc="right") == f"$t$ = {1e3 * END * 30 / 40:.2f} ms"


def test_frames_of_a_point_contact_are_maps_where_the_field_is(ball):
    frames = map_frames(ball)
    frames.show(30)
    film, field = frames.figure.axes[:2]
    assert film.get_xlim() == pytest.approx((-1.25, 1.25))
    values = 1e9 * ball.dataset["thickness"].values[30]
    x, y = ball.x, ball.values("y") / ball.conditions.half_width
    shown = values[np.ix_(np.abs(x) < 1.26, np.abs(y) < 1.26)]
    np.testing.assert_allclose(mesh_of(film).get_array().reshape(shown.shape), shown)
    (cross,) = field.get_lines()
    assert (cross.get_xdata()[0], cross.get_ydata()[0]) == pytest.approx((0.5, -0.75))


@pytest.mark.slow
@pytest.mark.parametrize("contact", [CONTACT, BALL])
def test_animation_has_every_instant(contact, tmp_path):
    done = []
    path = tmp_path / "run.gif"
    save_animation(
        by_hand(contact=contact, frames=5), path, fps=20.0, dpi=50, progress=lambda *at: done.append(at)
    )
    with Image.open(path) as image:
        assert image.n_frames == 5
        images = []
        for frame in range(5):
            image.seek(frame)
            assert image.info["duration"] == 50
            images.append(np.asarray(image.convert("RGB")))
    assert all(np.any(first != second) for first, second in pairwise(images))
    assert done == [(k, 5, "drawing") for k in range(1, 6)]


@pytest.mark.slow
def test_colours_of_a_point_contact_are_those_of_its_maps(tmp_path):
    path = tmp_path / "run.gif"
    save_animation(by_hand(contact=BALL, frames=2), path)
    with Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB")).reshape(-1, 3).astype(int)
    # Yellow, the end of viridis, is the film outside the contact: (253, 231, 37).
    assert np.mean(np.all(np.abs(pixels - [253, 231, 37]) <= 3, axis=1)) > 0.05


@pytest.mark.slow
def test_an_animation_stopped_on_its_way_leaves_what_was_there(tmp_path):
    path = tmp_path / "run.gif"
    path.write_text("the last one")

    def stop(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save_animation(by_hand(frames=3), path, dpi=50, progress=stop)
    assert path.read_text() == "the last one"
    assert list(tmp_path.iterdir()) == [path]


@each(
    "name, fps, said",
    [
        ("run.avi", 25.0, ["animation: ", "'run.avi'", ".gif or .mp4"]),
        ("run.mp4", 25.0, ["animation: ", "'run.mp4'", "ffmpeg", ".gif"]),
        ("run.gif", 0.0, ["fps: ", " 0;", "0.1 to 50"]),
        ("run.gif", 1e3, ["fps: ", " 1000;", "0.1 to 50"]),
    ],
)
def test_animations_that_cannot_be_made_are_refused(name, fps, said, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError) as caught:
        save_animation(by_hand(frames=2), tmp_path / name, fps=fps)
    assert str(caught.value).startswith(said[0])
    assert [part for part in said if part not in str(caught.value)] == []
    assert list(tmp_path.iterdir()) == []


def program(folder, text):
    """A program named ffmpeg, the first that is found."""
    folder.mkdir()
    file = folder / "ffmpeg"
    file.write_text(f"#!{sys.executable}\nimport shutil, sys\n{text}\n")
    file.chmod(file.stat().st_mode | stat.S_IXUSR)
    return f"{folder}{os.pathsep}{os.environ['PATH']}"


@pytest.mark.slow
def test_ffmpeg_is_given_every_pixel_of_every_instant(tmp_path, monkeypatch):
    copy = "with open(sys.argv[-1], 'wb') as file: shutil.copyfileobj(sys.stdin.buffer, file)"
    monkeypatch.setenv("PATH", program(tmp_path / "bin", copy))
    path = tmp_path / "run.mp4"
    save_animation(by_hand(frames=3), path, dpi=50)
    # 5.2 by 6.6 inches, of 50 pixels each, made even as its codec takes them; red, green, blue and opacity.
    assert path.stat().st_size == 3 * 260 * 330 * 4


@pytest.mark.slow
def test_ffmpeg_that_fails_is_said_in_one_line(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", program(tmp_path / "bin", "sys.exit(1 if len(sys.argv) > 2 else 0)"))
    path = tmp_path / "run.mp4"
    with pytest.raises(
        InputError, match=r"run\.mp4: cannot be written, ffmpeg failed; a \.gif needs no ffmpeg$"
    ):
        save_animation(by_hand(frames=3), path, dpi=50)
    assert not path.exists()
    assert [file.name for file in tmp_path.iterdir()] == ["bin"]


@each(
    "draw, unit",
    [
        (motion_history.least_film, "[µm]"),
        (motion_history.largest_field, "[V/µm]"),
        (motion_history.places, "$x/b$"),
        (motion_beside.compared_film, "[µm]"),
        (motion_beside.compared_pressure, "[GPa]"),
        (motion_beside.compared_field, "[V/µm]"),
        (motion_maps.film_map, "[ms]"),
        (motion_maps.pressure_map, "[ms]"),
        (motion_maps.field_map, "[ms]"),
    ],
)
def test_panels_say_their_unit_and_take_the_axes_given(run, draw, unit):
    ax = Figure().add_subplot()
    assert draw(run, ax) is ax
    assert ax.get_ylabel().endswith(unit)
    assert draw(run).has_data()
