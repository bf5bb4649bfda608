"""In no figure of any style does a text lie over another one, over a legend or a frame, or off the page, and
each has a contrast of at least 4.5 with what lies behind it.
"""

import numpy as np
import pytest

from ehlectric import (
    AxleCase,
    BearingCase,
    Case,
    DriveCase,
    figure,
    figure_names,
    film_factors,
    load,
    solve,
    solve_axle,
    solve_bearing,
    solve_drive,
)
from ehlectric.cases.oil_report import oil_report
from ehlectric.figures import oil_figures, surface_figures
from ehlectric.figures.animation import line_frames, map_frames
from ehlectric.figures.figure_names import STYLES, map_files
from ehlectric.figures.style import figure_of, legend_above, new_panels, style
from ehlectric.motion.stored_run import MotionRun
from ehlectric.paper.paper_contacts import CONTACTS, measured_profile
from ehlectric.paper.paper_figures import FIGURES as PAPER_FIGURES
from ehlectric.paper.study import Study
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Profile
from ehlectric.sweep.points import Range
from ehlectric.sweep.store import read_sweep
from tests.axle.axles import ALONE, two_stages
from tests.figures.motion.test_save import BALL as MOVING_BALL
from tests.figures.motion.test_save import by_hand
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case
from tests.helpers.contrasts import flaws
from tests.helpers.drives import drive_with_remedy
from tests.helpers.each import each
from tests.helpers.overlaps import overlaps
from tests.helpers.places import EXAMPLES, ROOT
from tests.helpers.share import share
from tests.helpers.sweep_models import LOAD, SPEED, breakdown, grid, sobol

STORED = ROOT / "tests" / "data" / "releases" / "1.0.0"


def bearing(file, **changes):
    """Bearing of an example, with contacts by formula."""
    case = BearingCase.from_toml(EXAMPLES / file)
    return solve_bearing(case.replace({"contacts": "formula"} | changes))


def drawn(names, draw, styles=STYLES):
    """Flaws of figures of some names, by name and style; empty where there is none."""
    found = {}
    for name in names:
        for look in styles:
            with style(look):
                if lines := flaws(draw(name)):
                    found[f"{name}, {look}"] = lines
    return found


def of_result(result, names=None):
    """Flaws of the figures of a result, by name and style."""
    found = {}
    for look in STYLES:
        for name in names or figure_names(result):
            if lines := flaws(figure(result, name, style=look)):
                found[f"{name}, {look}"] = lines
    return found


@pytest.mark.slow
def test_a_stored_contact():
    assert of_result(load(STORED / "line")) == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bearing", "rough", "hot", "starved", "touching", "drive", "motion"])
def test_other_stored_results(name):
    assert of_result(load(STORED / name)) == {}


@pytest.mark.slow
@pytest.mark.parametrize("file", ["bearing_6208.toml", "bearing_greased.toml"])
def test_bearings_over_speed(file):
    """Names of lines that end beside each other, shadings of three kinds, and speeds up to 24 000 rpm."""
    assert of_result(bearing(file), ["breakdown_over_speed"]) == {}


@pytest.mark.slow
@pytest.mark.parametrize(
    "make",
    [
        lambda: bearing("bearing_6208.toml"),
        lambda: bearing("bearing_thin_oil.toml"),
        lambda: bearing("bearing_greased.toml"),
        lambda: bearing("duty_wltc.toml"),
        lambda: solve_bearing(bearing_case(ROLLERS, contacts="formula")),
        lambda: solve_bearing(bearing_case(BALLS, contacts="atlas", bearing__inner_speed="60 rpm")),
    ],
    ids=["6208", "thin oil", "greased", "duty cycle", "rollers", "touching"],
)
def test_bearings(make):
    assert of_result(make()) == {}


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, {"drive.temperature": "40 degC"}], ids=["example", "cold"])
def test_drives(changes):
    result = solve_drive(drive_with_remedy(**changes), workers=1)
    assert of_result(result) == {}
    for name in figure_names(result):
        assert 25.4 * figure(result, name, style="journal").get_figwidth() == pytest.approx(84.0), name


# Links of an axle: several between two shafts, and one past a shaft.
LINKS = [
    {"between": ["rotor", "housing"], "kind": "ring", "resistance": 1.0},
    {"between": ["rotor", "output"], "kind": "ring", "resistance": 1e4},
    {"between": ["rotor", "intermediate"], "kind": "brush", "resistance": 3e3},
    {"between": ["intermediate", "output"], "kind": "seal", "resistance": 3e3},
]


@pytest.mark.slow
@pytest.mark.parametrize(
    "make",
    [
        two_stages,
        lambda: two_stages(link=LINKS),
        lambda: AxleCase.from_toml(ROOT / "tests" / "data" / "axles" / "e_axle.toml"),
        lambda: AxleCase.from_dict(ALONE),
    ],
    ids=["example", "links", "tapered", "alone"],
)
def test_axles(make):
    assert of_result(solve_axle(make(), remedies=False)) == {}


@pytest.mark.slow
def test_a_drive_over_a_duty_cycle():
    case = DriveCase.from_toml(EXAMPLES / "duty_drive.toml").replace({"drive.contacts": "formula"})
    assert of_result(solve_drive(case, workers=1), ["drive_duty"]) == {}


@pytest.mark.slow
def test_a_measurement_beside_computed_values():
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    file = EXAMPLES / "measurements" / "bearing_6208_capacitance.csv"
    found = film_factors(case, file, background="12 pF", contacts="formula")
    assert of_result(found) == {}


@pytest.mark.slow
def test_a_contact_at_a_meter():
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    tables = {"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 65}}
    case = Case.from_dict(tables | {"meter": {"fill": "oil"}})
    assert of_result(solve(case)) == {}


@pytest.mark.slow
def test_sweeps_with_a_margin():
    """A map and lines with the line of margin 1 and their legend of four entries."""
    results = grid({SPEED: (0.5, 1.0, 2.0, 4.0, 8.0), LOAD: (2e5, 5e5, 1e6, 2e6)})
    assert of_result(results, map_files("discharge.margin")) == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sweep", "drives"])
def test_stored_sweeps(name):
    """Some maps and their lines: maps and lines of many values differ in their labels only."""
    results = read_sweep(STORED / name)
    names = figure_names(results)
    assert of_result(results, [*share(names[::8], 2), *share(names[1::8], 2)]) == {}


@pytest.mark.slow
def test_sensitivity():
    ranges = {SPEED: Range(1.0, 8.0, "log"), LOAD: Range(0.5e6, 2e6, "log")}
    ranges["lubricant.pressure_viscosity_coefficient"] = Range(20e-9, 24e-9)
    results = sobol(ranges, 64, breakdown)
    assert of_result(results, ["sensitivity"]) == {}
    assert 25.4 * figure(results, "sensitivity", style="journal").get_figwidth() == pytest.approx(84.0)


@pytest.mark.slow
def test_oils():
    draws = {"pressure": oil_figures.over_pressure, "temperature": oil_figures.over_temperature}
    report = oil_report("fva-3", ["40 degC", "80 degC"], ["1 GPa"])
    assert drawn(draws, lambda name: figure_of(draws[name](report)[0])) == {}


@pytest.mark.slow
def test_surfaces(monkeypatch, tmp_path):
    kept = []
    monkeypatch.setattr(surface_figures, "save_figure", lambda drawn, *_: kept.append(drawn))
    heights = 1e-8 * np.random.default_rng(0).standard_normal((60, 40))
    surfaces = {"map": Map(1e-6, 2e-6, heights), "profile": Profile(1e-6, heights.ravel())}

    def draw(name):
        surface_figures.save_surface([("as read", surfaces[name]), ("form: line", surfaces[name])], tmp_path)
        return kept.pop()

    assert drawn(surfaces, draw) == {}


@pytest.mark.slow
def test_frames_of_animations():
    runs = {"line": (line_frames, by_hand()), "point": (map_frames, by_hand(contact=MOVING_BALL))}
    assert (
        drawn(runs, lambda name: runs[name][0](MotionRun.of(runs[name][1])).figure, ["screen", "dark"]) == {}
    )
    for _, run in runs.values():
        assert of_result(run) == {}


@pytest.mark.slow
def test_figures_of_the_paper():
    """On coarse grids, whose films have the places and the sizes of those of the paper."""
    with measured_profile() as profile:
        study = Study(
            smooth={contact: solve(contact.case(nodes=401)) for contact in CONTACTS},
            rough={contact: solve(contact.rough_case(profile, nodes=801)) for contact in CONTACTS},
        )
    assert drawn(PAPER_FIGURES, lambda number: PAPER_FIGURES[number].draw(study)) == {}


def plain():
    """Axes with a curve in a small figure."""
    with style("journal"):
        (ax,) = new_panels(1, 1, (6.3, 3.4))
        ax.plot([0.0, 1.0], [0.0, 1.0], label="a curve")
    return ax


def over_each_other(ax):
    ax.text(0.5, 0.5, "one")
    ax.text(0.52, 0.52, "other")


def close_ticks(ax):
    ax.set_xticks([0.5, 0.51], ["10000", "20000"])


def title_in_legend(ax):
    legend_above(ax)
    ax.text(0.2, 1.04, "title", transform=ax.transAxes)


def two_narrow_panels(ax):
    ax.set_position((0.2, 0.2, 0.05, 0.7))


@pytest.mark.slow
@each(
    "spoil, told",
    [
        (lambda ax: ax.text(0.1, 0.5, "short"), []),
        (over_each_other, ["'one' touches 'other'"]),
        (close_ticks, ["'10000' touches '20000'"]),
        (title_in_legend, ["'title' touches 'a curve'", "'title' lies over the legend of 'a curve'"]),
        (lambda ax: ax.text(0.5, 0.9, "as long as this note is, it ends"), ["lies on a frame"]),
        (lambda ax: ax.set_xlabel("label " * 20), ["is out of the figure"]),
        (lambda ax: ax.legend(loc="lower left", bbox_to_anchor=(1.0, 0.0)), ["out of the figure"]),
        (two_narrow_panels, ["is a sliver"]),
        (lambda ax: legend_above(ax, labels=["_nolegend_"]), ["'_nolegend_' is no name for a reader"]),
    ],
)
def test_what_overlaps_is_found(spoil, told):
    ax = plain()
    figure_of(ax).set_layout_engine("none")
    ax.set_position((0.2, 0.2, 0.7, 0.6))
    spoil(ax)
    found = overlaps(figure_of(ax))
    assert all(any(text in line for line in found) for text in told)
    assert bool(found) == bool(told)
