"""Figures of any result by name: in the style of the package, with the settings of matplotlib as before."""

import re
import subprocess
import sys
import threading
import warnings
from typing import get_args
from xml.etree import ElementTree

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from ehlectric import (
    AxleResult,
    BearingCase,
    BearingResult,
    Calibration,
    Case,
    DriveResult,
    FilmFactors,
    GearResult,
    InputError,
    MotionResult,
    PointResult,
    Result,
    SweepResults,
    figure,
    read_motion,
    save_figures,
    solve,
    solve_bearing,
)
from ehlectric.figures import bearing_figure_files as of_bearings
from ehlectric.figures import figure_names as known
from ehlectric.figures import motion_figures as of_motions
from ehlectric.figures import result_figures
from ehlectric.figures import sweep_figures as of_sweeps
from ehlectric.figures.line_figures import FIGURES
from ehlectric.figures.point_figures import FIGURES as POINT_FIGURES
from ehlectric.figures.result_figures import draw_figures, figure_names
from ehlectric.figures.style import name_over, new_panels, style
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import MotionRun
from ehlectric.quantities.palette import RED
from ehlectric.runtime.display import ResultKind
from tests.conftest import PAPER_CONTACT
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.moving_cases import moving
from tests.helpers.sweep_models import LOAD, SPEED, breakdown, grid
from tests.helpers.titles import title_of

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


def test_names_are_those_of_the_tables_of_figures():
    assert tuple(FIGURES) == known.FIGURE_FILES
    assert tuple(POINT_FIGURES) == known.POINT_FIGURE_FILES
    assert tuple(of_bearings.FIGURES) == known.BEARING_FIGURE_FILES
    assert tuple(of_bearings.SPEED_FIGURES) == known.SPEED_FIGURE_FILES
    assert tuple(of_motions.FIGURES) == known.MOTION_FIGURE_FILES
    assert [name.partition("_")[0] for name in known.map_files("film.error")] == list(of_sweeps.FIGURES)


def test_each_class_of_results_has_its_figures():
    classes = [
        Result,
        PointResult,
        BearingResult,
        DriveResult,
        MotionResult,
        SweepResults,
        FilmFactors,
        GearResult,
        AxleResult,
        Calibration,
    ]
    assert {kind.result_kind for kind in [*classes, MotionRun]} == {*get_args(ResultKind)}
    for kind in get_args(ResultKind):
        assert callable(result_figures._KINDS[kind]().figure), kind


def test_a_subclass_of_a_result_has_its_figures(bearing):
    class Own(BearingResult):
        pass

    assert figure_names(Own(bearing.solution)) == figure_names(bearing)


@pytest.mark.parametrize("value", [5, "film", {"kind": "contact"}, BALL, Figure, np.float64(1.0)], ids=repr)
def test_what_is_no_result_is_refused(value):
    name = type(value).__name__
    with pytest.raises(InputError, match=f"^result: got '{name}'; expected a result of ehlectric$"):
        figure_names(value)


def test_names_need_no_matplotlib():
    code = "import sys, ehlectric.figures.figure_names; print('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "False\n"


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["line", "point"])
def test_figures_of_a_contact(kind, tmp_path):
    result = contact(kind)
    expected = {"line": known.FIGURE_FILES, "point": known.POINT_FIGURE_FILES}[kind]
    assert [f"{name}.png" for name in figure_names(result)] == list(expected)
    drawn = figure(result, expected[0])
    assert isinstance(drawn, Figure)
    assert "By name" in [*title_of(drawn), drawn.axes[0].get_title(loc="left")]
    with pytest.raises(InputError, match=rf"^figure: .*'roughness\.png'.* {expected[0][:-4]}, "):
        figure(result, "roughness.png")
    files = save_figures(result, tmp_path)
    assert tuple(file.name for file in files) == expected
    # As many pixels as the style's 300 an inch.
    with Image.open(files[0]) as image:
        assert image.size[0] == pytest.approx(300.0 * drawn.get_size_inches()[0], abs=1.0)


def test_the_roughness_is_among_the_figures_of_a_rough_contact():
    table = {"contact": PAPER_CONTACT, "lubricant": OIL, "roughness": [ROUGH], "grid": {"nodes": 401}}
    result = solve(Case.from_dict(table), beside_smooth=False)
    assert f"{figure_names(result)[-1]}.png" == known.ROUGHNESS_FIGURE
    assert "Rq" in figure(result, "roughness.png").axes[0].get_legend().get_texts()[0].get_text()


@pytest.mark.slow
def test_figures_of_a_bearing(bearing, tmp_path):
    own = tuple(name for name in known.BEARING_FIGURE_FILES if name != known.DUTY_FIGURE)
    every = (*own, *known.SPEED_FIGURE_FILES)
    assert [f"{name}.png" for name in figure_names(bearing)] == list(every)
    assert len(figure(bearing, "bearing_circuit.png").axes) == 2
    over_speed = figure(bearing, "capacitance_over_speed.png")
    assert over_speed.axes[0].get_xlabel().endswith("[rpm]")
    with pytest.raises(InputError, match=r"^figure: .*'film\.png'.* bearing_loads.*_over_speed"):
        figure(bearing, "film.png")
    drawn = draw_figures(bearing, tmp_path)
    assert [file.name for file in drawn.files] == list(every)
    assert all(file.is_file() for file in drawn.files)
    assert drawn.warnings == ()


@pytest.mark.slow
def test_figures_of_a_motion(motion, tmp_path):
    """Of the dataset and of the run; it does not reach the instant that is compared."""
    expected = [name.removesuffix(".png") for name in known.MOTION_FIGURE_FILES[:2]]
    assert figure_names(motion) == figure_names(MotionRun.of(motion)) == expected
    assert len(figure(motion, "motion_history.png").axes) == 2
    with pytest.raises(InputError, match=r"^figure: .*'motion_beside_stationary\.png'"):
        figure(motion, "motion_beside_stationary.png")
    assert len(save_figures(MotionRun.of(motion), tmp_path)) == 2


def test_figures_of_a_sweep(tmp_path):
    results = grid({SPEED: (1.0, 2.0, 4.0), LOAD: (1e5, 1e6)}, breakdown)
    value = "discharge.breakdown_voltage"
    drawn = figure(results, f"map_{value}.png", x=SPEED, y=LOAD)
    assert "entrainment speed" in drawn.axes[0].get_xlabel()
    lines = figure(results, f"lines_{value}.png", x=SPEED, at={LOAD: "1 MN/m"})
    assert "breakdown voltage" in lines.axes[0].get_ylabel()
    assert save_figures(results, tmp_path) == []
    with pytest.raises(InputError, match=r"^figure: .*'film\.png'.* map_KEY\.png, lines_KEY\.png"):
        figure(results, "film.png")
    with pytest.raises(InputError, match=r"^y: "):
        figure(results, f"map_{value}.png", x=SPEED)


@pytest.mark.slow
def test_a_sweep_lists_figures_that_it_draws_without_further_options():
    results = grid({SPEED: (1.0, 2.0, 4.0), LOAD: (1e5, 1e6)}, breakdown)
    listed = figure_names(results)
    assert listed[:2] == ["map_film.minimum_thickness", "lines_film.minimum_thickness"]
    for name in listed:
        assert isinstance(results.plot(name), Figure)
    along_load = results.plot("lines_film.minimum_thickness", x=LOAD).axes[0].get_xlabel()
    assert "load per length" in along_load
    one = grid({SPEED: (1.0, 2.0, 4.0)}, breakdown)
    assert not [name for name in figure_names(one) if name.startswith("map")]
    match = r"^figure: .*'discharge\.margin'.* value='discharge\.margin'"
    with pytest.raises(InputError, match=match):
        results.plot("discharge.margin")


@pytest.mark.slow
def test_a_figure_that_a_bearing_lacks_is_told_with_its_cause_and_those_that_there_are(bearing):
    """Without a strength nothing breaks down; the circuit and the capacitance are drawn."""
    tables = bearing.case.to_dict()
    del tables["discharge"]
    silent = solve_bearing(BearingCase.from_dict(tables), workers=1)
    listed = figure_names(silent)
    assert "breakdown_over_speed" not in listed
    assert "capacitance_over_speed" in listed
    match = rf"^figure: .*'breakdown_over_speed'.* {', '.join(listed)};"
    with pytest.raises(InputError, match=match):
        silent.plot("breakdown_over_speed")
    with pytest.raises(InputError, match=r"; nearest is breakdown_over_speed$"):
        bearing.plot("breakdown_over_sped")


def test_options_that_a_figure_has_not_are_refused(bearing):
    with pytest.raises(InputError, match=r"^x: .*style"):
        bearing.plot("bearing_loads", x="bearing.inner_speed")
    results = grid({SPEED: (1.0, 2.0, 4.0)}, breakdown)
    with pytest.raises(InputError, match=r"^z: .* x, y, value,"):
        results.plot("lines_film.minimum_thickness", z=SPEED)


@pytest.mark.slow
def test_figures_are_saved_into_a_folder_that_is_made(line, tmp_path):
    files = save_figures(line, tmp_path / "new" / "folder")
    assert files[0].parent == tmp_path / "new" / "folder"
    assert all(file.is_file() for file in files)


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


@pytest.fixture(scope="module")
def line():
    return contact("line")


@pytest.mark.slow
def test_files_of_each_format_are_whole_and_say_the_finding(line, tmp_path):
    """The title is in the metadata, no date is, and the same figure gives the same bytes again."""
    drawn = draw_figures(line, tmp_path, known.FORMATS)
    assert [file.name for file in drawn.files] == list(known.in_formats(known.FIGURE_FILES, known.FORMATS))
    png, svg, pdf = (tmp_path / name for name in known.in_formats(["film.png"], known.FORMATS))
    title = figure(line, "film").get_label()
    assert title.endswith("By name")
    with Image.open(png) as image:
        assert image.info["Title"] == title
    root = ElementTree.parse(svg).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert title in "".join(root.itertext())
    assert pdf.read_bytes().startswith(b"%PDF")
    assert b"/Type42" in pdf.read_bytes() or b"/FontFile2" in pdf.read_bytes()
    again = tmp_path / "again"
    again.mkdir()
    draw_figures(line, again, known.FORMATS)
    for file in (png, svg, pdf):
        assert (again / file.name).read_bytes() == file.read_bytes()
        assert b"Date" not in file.read_bytes()


@pytest.mark.slow
def test_a_journal_figure_is_a_column_wide_without_its_title(line, tmp_path):
    save_figures(line, tmp_path, ("pdf", "png"), "journal")
    box = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", (tmp_path / "film.pdf").read_bytes())
    assert float(box[1]) / 72.0 * 25.4 == pytest.approx(84.0, abs=0.01)
    with Image.open(tmp_path / "film.png") as image:
        assert image.size[0] / image.info["dpi"][0] * 25.4 == pytest.approx(84.0, abs=0.1)
    screen, journal = figure(line, "film.png"), figure(line, "film.png", style="journal")
    assert journal.get_label() == screen.get_label()
    assert title_of(screen)
    assert not title_of(journal)
    assert journal.axes[0].xaxis.label.get_size() == 8.0
    point = contact("point")
    for name in ("cuts.png", "field_deviation.png", "field_map.png"):
        drawn = figure(point, name, style="journal")
        assert drawn.get_figwidth() * 25.4 == pytest.approx(84.0), name
        assert drawn.get_figheight() * 25.4 <= 234.0, name


def test_an_unconverged_figure_says_so_in_a_journal_too():
    with style("journal"):
        ax = new_panels(1, 1, (6.3, 3.4))[0]
        name_over(ax, "NOT CONVERGED\nBy hand", converged=False)
    assert title_of(ax.figure) == ["NOT CONVERGED"]
    assert ax.figure._suptitle.get_color() == RED


def test_unknown_formats_and_styles_are_refused(line, tmp_path):
    with pytest.raises(InputError, match=r"^format: .*'jpg'.* png, svg, pdf$"):
        save_figures(line, tmp_path, ("jpg",))
    with pytest.raises(InputError, match=r"^style: .*'book'.* screen, journal, dark$"):
        save_figures(line, tmp_path, style="book")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_titles_are_not_broken_between_a_number_and_its_unit():
    """At every width of the page, "8 V" and "2.28 to 3.25 m/s" keep their units."""
    text = "Breakdown expected below 2.28 to 3.25 m/s at 12 °C and 70 % (applied voltage 8 V)"
    for width in np.arange(2.0, 6.0, 0.1):
        with style():
            ax = new_panels(1, 1, (width, 2.0))[0]
            name_over(ax, text)
        lines = title_of(ax.figure)
        assert " ".join(lines) == text
        assert not [line for line in lines if line.startswith(("m/s", "°C", "%", "V)"))]
    assert ax.figure.get_label() == text


def test_long_titles_are_broken_and_none_of_their_lines_is_lost():
    with style():
        ax = new_panels(1, 1, (3.0, 2.0))[0]
        name_over(ax, f"{'finding ' * 12}\n{'case ' * 20}")
    assert " ".join(title_of(ax.figure)) == f"{'finding ' * 12}{'case ' * 20}".strip()
    ax.figure.draw_without_rendering()
    assert ax.figure._suptitle.get_window_extent().x1 < ax.figure.bbox.x1
