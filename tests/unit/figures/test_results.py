"""Figures of any result by name: in the style of the package, with the settings of matplotlib as before."""

import subprocess
import sys
import threading
import warnings

import matplotlib as mpl
import pytest
from matplotlib.figure import Figure
from PIL import Image

from ehlectric import Case, InputError, figure, read_motion, save_figures, solve, solve_bearing
from ehlectric.figures import names
from ehlectric.figures.bearing import save as of_bearings
from ehlectric.figures.contact.line import FIGURES
from ehlectric.figures.contact.point import POINT_FIGURES
from ehlectric.figures.motion import save as of_motions
from ehlectric.figures.results import draw_figures, figure_names
from ehlectric.figures.style import style
from ehlectric.figures.sweep import save as of_sweeps
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import MotionRun
from tests.conftest import PAPER_CONTACT
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.moving_cases import moving
from tests.helpers.sweep_models import LOAD, SPEED, breakdown, grid

OIL = {"base": "paper"}
ROUGH = {"surface": 1, "generator": "sinusoid", "amplitude": "5 nm", "wavelength": "100 um"}
BALL = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
BALL |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}


def contact(kind):
    table = {"line": dict(PAPER_CONTACT), "point": BALL}[kind]
    nodes = {"line": 401, "point": 65}[kind]
    return solve(
        Case.from_dict({"title": "By name", "contact": table, "lubricant": OIL, "grid": {"nodes": nodes}})
    )


@pytest.fixture(scope="module")
def bearing():
    return solve_bearing(bearing_case(BALLS, contacts="formula"))


@pytest.fixture(scope="module")
def motion(tmp_path_factory):
    folder = tmp_path_factory.mktemp("motion")
    run_motion(moving(motion={"passes": 0.375, "steps": 12, "record": 4}), folder)
    return read_motion(folder)


def titles(drawn):
    text = drawn.get_suptitle() + "".join(ax.get_title(loc="left") for ax in drawn.axes)
    return text.splitlines()


def test_names_are_those_of_the_tables_of_figures():
    assert tuple(FIGURES) == names.FIGURE_FILES
    assert tuple(POINT_FIGURES) == names.POINT_FIGURE_FILES
    assert tuple(of_bearings.FIGURES) == names.BEARING_FIGURE_FILES
    assert tuple(of_bearings.SPEED_FIGURES) == names.SPEED_FIGURE_FILES
    assert tuple(of_motions.FIGURES) == names.MOTION_FIGURE_FILES
    assert [name.partition("_")[0] for name in names.map_files("film.error")] == list(of_sweeps.FIGURES)


def test_names_need_no_matplotlib():
    code = "import sys, ehlectric.figures.names; print('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "False\n"


@pytest.mark.parametrize("kind", ["line", "point"])
def test_figures_of_a_contact(kind, tmp_path):
    result = contact(kind)
    expected = {"line": names.FIGURE_FILES, "point": names.POINT_FIGURE_FILES}[kind]
    assert tuple(figure_names(result)) == expected
    drawn = figure(result, expected[0])
    assert isinstance(drawn, Figure)
    assert titles(drawn)[0] == "By name"
    with pytest.raises(InputError, match=rf"^figure: got 'roughness\.png'; expected one of {expected[0]}, "):
        figure(result, "roughness.png")
    files = save_figures(result, tmp_path)
    assert tuple(file.name for file in files) == expected
    # As many pixels as the style's 300 an inch.
    with Image.open(files[0]) as image:
        assert image.size[0] == pytest.approx(300.0 * drawn.get_size_inches()[0], abs=1.0)


def test_the_roughness_is_among_the_figures_of_a_rough_contact():
    table = {"contact": PAPER_CONTACT, "lubricant": OIL, "roughness": [ROUGH], "grid": {"nodes": 401}}
    result = solve(Case.from_dict(table), beside_smooth=False)
    assert figure_names(result)[-1] == names.ROUGHNESS_FIGURE
    assert "Rq" in figure(result, "roughness.png").axes[0].get_legend().get_texts()[0].get_text()


def test_figures_of_a_bearing(bearing, tmp_path):
    assert tuple(figure_names(bearing)) == names.BEARING_FIGURE_FILES
    assert len(figure(bearing, "bearing_circuit.png").axes) == 3
    over_speed = figure(bearing, "capacitance_over_speed.png")
    assert over_speed.axes[0].get_xlabel().endswith("[rpm]")
    with pytest.raises(
        InputError, match=r"^figure: got 'film\.png'; expected one of bearing_loads.*speed\.png$"
    ):
        figure(bearing, "film.png")
    drawn = draw_figures(bearing, tmp_path)
    assert [file.name for file in drawn.files] == [*names.BEARING_FIGURE_FILES, *names.SPEED_FIGURE_FILES]
    assert all(file.is_file() for file in drawn.files)
    assert drawn.warnings == ()


def test_figures_of_a_motion(motion, tmp_path):
    """Of the dataset and of the run; it does not reach the instant that is compared."""
    assert figure_names(motion) == figure_names(MotionRun.of(motion)) == list(names.MOTION_FIGURE_FILES[:2])
    assert len(figure(motion, "motion_history.png").axes) >= 3
    with pytest.raises(InputError, match=r"^figure: got 'motion_beside_stationary\.png'; expected one of "):
        figure(motion, "motion_beside_stationary.png")
    assert len(save_figures(MotionRun.of(motion), tmp_path)) == 2


def test_figures_of_a_sweep(tmp_path):
    results = grid({SPEED: (1.0, 2.0, 4.0), LOAD: (1e5, 1e6)}, breakdown)
    value = "discharge.breakdown_voltage"
    drawn = figure(results, f"map_{value}.png", x=SPEED, y=LOAD)
    assert "entrainment speed" in drawn.axes[0].get_xlabel()
    lines = figure(results, f"lines_{value}.png", x=SPEED, at={LOAD: "1 MN/m"})
    assert "breakdown voltage" in lines.axes[0].get_ylabel()
    assert figure_names(results) == save_figures(results, tmp_path) == []
    with pytest.raises(
        InputError, match=r"^figure: got 'film\.png'; expected map_KEY\.png, lines_KEY\.png or "
    ):
        figure(results, "film.png")
    with pytest.raises(InputError, match=r"^y: missing; expected a varied key, for a map$"):
        figure(results, f"map_{value}.png", x=SPEED)


def test_a_figure_has_the_style_and_leaves_the_settings_as_they_are():
    result = contact("line")
    before, filters = dict(mpl.rcParams), list(warnings.filters)
    with mpl.rc_context({"font.size": 20.0, "lines.linewidth": 9.0}):
        own = dict(mpl.rcParams)
        drawn = figure(result, "film.png")
        assert dict(mpl.rcParams) == own
    assert dict(mpl.rcParams) == before
    assert list(warnings.filters) == filters
    assert drawn.axes[0].xaxis.label.get_size() == 9.0
    assert drawn.axes[0].get_lines()[0].get_linewidth() < 2.0


def test_threads_that_draw_take_turns():
    """Left in another order than entered, two contexts would leave the style of one behind."""
    before = dict(mpl.rcParams)
    entered, events = threading.Event(), []

    def draw():
        entered.set()
        with style():
            events.append("second")

    thread = threading.Thread(target=draw)
    with style():
        thread.start()
        entered.wait()
        thread.join(0.1)
        events.append("first")
    thread.join()
    assert events == ["first", "second"]
    assert dict(mpl.rcParams) == before
