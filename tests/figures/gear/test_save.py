"""Figures of a gear pair: what they show, and what their titles state."""

import itertools
import math
from typing import get_args

import numpy as np
import pytest

from ehlectric import GearResult, InputError, figure, figure_names, save_figures, solve_gear
from ehlectric.cases.gear_case import GearCase
from ehlectric.figures.figure_names import FORMATS, GEAR_FIGURE_FILES, STYLES, in_formats
from ehlectric.figures.gear_figures import FIGURES
from ehlectric.figures.gear_panels import (
    flank_finding,
    flank_lines,
    flank_map,
    last_colour,
    mesh_finding,
)
from ehlectric.figures.result_figures import default_figure
from ehlectric.runtime.display import ResultKind
from tests.helpers.each import each
from tests.helpers.gears import RELIEVED, helical_case, spur_case
from tests.helpers.places import EXAMPLES
from tests.helpers.titles import title_of

WITHOUT_CYCLE = GEAR_FIGURE_FILES[:-1]
PATH, FILM, FLANK, MESH = (name.removesuffix(".png") for name in WITHOUT_CYCLE)

# Planet and ring, whose flank is concave.
RING = {"gear.teeth": [20, -70], "gear.centre_distance": None, "gear.profile_shift": None}
RING |= {"gear.tip_diameter": None, "gear.normal_backlash": None}


@pytest.fixture(scope="module")
def spur():
    return solve_gear(spur_case(), probable=False)


@pytest.fixture(scope="module")
def helical():
    """Gear pair with ground flanks, which conducts."""
    return solve_gear(helical_case(), probable=False)


@pytest.fixture(scope="module")
def relieved():
    """Gear pair whose flanks carry no load at their edges."""
    return solve_gear(spur_case(**RELIEVED), probable=False)


def curve(ax, name):
    """Line of an entry of the legend."""
    (line,) = (line for line in ax.get_lines() if line.get_label() == name)
    return line


def test_names_are_those_of_the_files(spur, tmp_path):
    assert tuple(FIGURES) == GEAR_FIGURE_FILES
    assert figure_names(spur) == [PATH, FILM, FLANK, MESH]
    assert default_figure(spur) == ("gear_flank.png", {})
    assert title_of(spur.plot()) == title_of(figure(spur, FLANK))
    assert GearResult.result_kind in get_args(ResultKind)
    with pytest.raises(InputError, match=r"\[duty\]"):
        figure(spur, GEAR_FIGURE_FILES[-1])
    with pytest.raises(InputError, match=r"^figure: .*'film'.* gear_path"):
        figure(spur, "film")
    files = save_figures(spur, tmp_path, FORMATS)
    assert [file.name for file in files] == list(in_formats(WITHOUT_CYCLE, FORMATS))
    assert all(file.is_file() for file in files)


def test_a_cycle_has_a_figure_with_bands(tmp_path):
    """A row at a standstill is a band; the speed and the torque are the numbers of the file."""
    (tmp_path / "cycle.csv").write_text("time [s],speed [rpm],torque [N m]\n0,0,0\n10,2000,50\n20,3000,-60\n")
    result = solve_gear(spur_case(**{"duty.file": str(tmp_path / "cycle.csv")}), probable=False)
    drawn = figure(result, "gear_duty")
    speed, torque, *_ = drawn.axes
    assert speed.get_lines()[-1].get_ydata().tolist() == pytest.approx([0.0, 2000.0, 3000.0])
    assert torque.get_lines()[-1].get_ydata().tolist() == [0.0, 50.0, -60.0]
    assert "standstill" in [area.get_label() for area in speed.collections]
    assert title_of(drawn)[0].startswith("The mesh insulates")


@pytest.mark.slow
@each("style", STYLES)
def test_every_pair_is_drawn_in_every_style(style, spur, helical, relieved):
    """Spur and helical pairs, ground flanks, flanks without a load in places, and a ring."""
    ring = solve_gear(spur_case(**RING), probable=False)
    for result in (spur, helical, relieved, ring):
        for name in figure_names(result):
            figure(result, name, style=style).draw_without_rendering()


def test_radii_and_speeds_are_those_of_the_published_gears(spur):
    """FZG type C by hand: at C both flanks have the speed omega_1 g_C, and radii in the ratio of 16 to 24."""
    radii, speeds, load, pressure = figure(spur, PATH).axes
    path = spur.solution.path
    at = 1e3 * path.pitch_point
    first, second = (np.interp(at, *curve(radii, name).get_data()) for name in ("gear 1", "gear 2"))
    assert second / first == pytest.approx(24 / 16, rel=1e-6)
    one, two = (np.interp(at, *line.get_data()) for line in speeds.get_lines()[:2])
    assert one == pytest.approx(2250 * math.pi / 30 * path.pitch_point, rel=1e-6)
    assert two == pytest.approx(one, rel=1e-6)
    # Hertzian pressure at C, printed by FVA information sheet 54, for steel of 205 GPa; here it has 208 GPa.
    known = np.interp(at, *curve(pressure, "mean of all lines of contact").get_data())
    assert known == pytest.approx(1.3954 * math.sqrt(208 / 205), rel=2e-4)
    assert pressure.get_ylabel().endswith("[GPa]")
    assert load.get_ylabel().replace("\n", " ").endswith("[N/mm]")
    # The whole force at C: 2 T/(d_b1 b).
    force = 2 * 215.6 / (72e-3 * math.cos(math.radians(20.0))) / 14e-3
    assert np.interp(at, *load.get_lines()[0].get_data()) == pytest.approx(1e-3 * force, rel=1e-6)


def test_the_points_of_the_path_are_named(spur):
    for name in (PATH, FILM):
        top = figure(spur, name).axes[0].child_axes[0]
        assert [text.get_text() for text in top.get_xticklabels()] == list("ABCDE")
        assert top.get_xticks() == pytest.approx([1e3 * g for g in spur.solution.path.points.values()])


def test_the_curvature_of_a_ring_is_named():
    ring = solve_gear(spur_case(**RING), probable=False)
    drawn = figure(ring, PATH).axes[0]
    x, y = curve(drawn, "ring, concave").get_data()
    # T1T2 is negative: the distance of both radii is constant.
    assert y - x == pytest.approx(-1e3 * ring.solution.path.tangent_length)


def test_the_film_is_that_of_the_points(spur):
    film, ratio = figure(spur, FILM).axes
    for row in spur.points():
        if row["point"] in "BD":
            continue  # the load jumps
        shown = np.interp(1e3 * row["place"], *curve(film, "minimum film").get_data())
        assert shown == pytest.approx(1e9 * row["minimum_thickness"], rel=0.01)
    rq = math.sqrt(math.pi / 2.0) * 0.02e-6 * math.sqrt(2.0)  # Gaussian heights
    assert curve(film, f"highest summits, 2 Rq = {2e9 * rq:.3g} nm").get_ydata() == pytest.approx(2e9 * rq)
    smallest = spur.summary()["mesh"]["minimum_thickness"]
    assert np.min(ratio.get_lines()[0].get_ydata()) == pytest.approx(smallest / rq, rel=1e-3)
    assert title_of(figure(spur, FILM))[0] == (
        f"Minimum film {1e9 * smallest:.3g} nm at A: λ {smallest / rq:.3g}, above the highest summits of 2 Rq"
    )


def test_films_far_below_the_summits_are_seen(helical):
    """The axis of a film of a tenth of the summits is logarithmic."""
    film, ratio = figure(helical, FILM).axes
    assert film.get_yscale() == ratio.get_yscale() == "log"
    assert "below the highest summits" in title_of(figure(helical, FILM))[0]


def test_numbers_of_a_logarithmic_axis_do_not_touch():
    """Films of a quarter to a half of the summits, which need about eight round numbers."""
    case = spur_case(**{"gear.flank_ra": ["0.4 um"], "gear.contact.conduction": "never"})
    drawn = figure(solve_gear(case, probable=False), FILM)
    drawn.draw_without_rendering()
    for ax in drawn.axes:
        assert ax.get_yscale() == "log"
        boxes = [label.get_window_extent() for label in ax.get_yticklabels() if label.get_text()]
        assert len(boxes) > 2
        assert all(low.y1 < high.y0 for low, high in itertools.pairwise(boxes))


def test_the_map_of_a_flank_has_the_films_of_its_lines(helical):
    """At the pitch point the film on the map is the film of any line that passes it."""
    g, y, films = flank_map(helical)
    solution = helical.solution
    assert films.shape == (g.size, y.size)
    assert np.nanmin(films) == pytest.approx(np.nanmin(solution.films.minimum), rel=1e-3)
    near = np.abs(solution.loads.places - solution.path.pitch_point) < 2e-5
    row = films[np.argmin(np.abs(g - solution.path.pitch_point))]
    assert np.mean(row) == pytest.approx(np.mean(solution.films.minimum[near]), rel=0.01)


def test_lines_of_contact_pass_the_minimum_film(helical):
    (ax,) = figure(helical, FLANK).axes
    mesh = helical.summary()["mesh"]
    (mark,) = (line for line in ax.get_lines() if line.get_label() == "minimum film")
    assert mark.get_xdata()[0] == pytest.approx(1e3 * mesh["minimum_across"])
    assert mark.get_ydata()[0] == pytest.approx(1e3 * mesh["minimum_place"])
    lines = [line.get_data() for line in ax.get_lines() if len(line.get_xdata()) > 5]
    path = helical.solution.path
    slope = math.tan(
        math.atan(math.tan(math.radians(25.0)) * math.cos(helical.solution.pair.transverse_pressure_angle))
    )
    heights = []
    for x, height in lines:
        assert np.diff(height) / np.diff(x) == pytest.approx(slope)
        heights.append(np.interp(1e3 * mesh["minimum_across"], x, height))
    assert np.diff(sorted(heights)) == pytest.approx(1e3 * path.base_pitch)
    assert min(abs(height - 1e3 * mesh["minimum_place"]) for height in heights) < 1e-9
    title = " ".join(title_of(figure(helical, FLANK)))
    assert "at A, the root of gear 1; the highest summits touch on the whole flank" in title


def test_flanks_without_a_load_have_no_film(relieved):
    _, _, films = flank_map(relieved)
    assert np.isnan(films[0]).all()
    assert np.isnan(films[:, 0]).all()
    assert not np.isnan(films[films.shape[0] // 2, films.shape[1] // 2])
    (ax,) = figure(relieved, FLANK).axes
    assert "no load" in [text.get_text() for text in ax.get_legend().get_texts()]
    # Lines of contact end where the load ends.
    (line,) = (
        line for line in ax.get_lines() if len(line.get_xdata()) > 5 and not np.isnan(line.get_ydata()).all()
    )
    known = line.get_xdata()[~np.isnan(line.get_ydata())]
    assert 0.5 < known[0] < known[-1] < 13.5
    assert "films end at the last computed place with load" in " ".join(title_of(figure(relieved, FILM)))
    # The Hertzian pressure decreases to zero with the load.
    load, pressure = (panel.get_lines()[0].get_ydata() for panel in figure(relieved, PATH).axes[2:])
    assert pressure[load == 0.0] == pytest.approx(0.0)


def test_lines_of_contact_lie_within_the_loaded_part_of_the_map():
    """Each place of a line of a relieved helical pair is loaded, or next to a loaded place of the map."""
    result = solve_gear(GearCase.from_toml(EXAMPLES / "gear_pair.toml"), probable=False)
    g, y, films = flank_map(result)
    for across, places in flank_lines(result):
        drawn = ~np.isnan(places)
        rows = np.clip(np.searchsorted(g, places[drawn]), 1, g.size - 2)
        columns = np.clip(np.searchsorted(y, across[drawn]), 1, y.size - 2)
        for row, column in zip(rows, columns, strict=True):
            assert np.isfinite(films[row - 1 : row + 2, column - 1 : column + 2]).any()


def test_the_subtitle_states_why_the_line_of_breakdowns_is_absent(spur, helical):
    drawn = figure(spur, FLANK)
    assert "around 90 % of the breakdowns" in [
        text.get_text() for text in drawn.axes[0].get_legend().get_texts()
    ]
    assert "no places of breakdowns" not in " ".join(title_of(drawn))
    assert "no places of breakdowns: the highest summits touch" in " ".join(title_of(figure(helical, FLANK)))
    without = solve_gear(spur_case(**{"discharge.dielectric_strength": None}), probable=False)
    assert "no dielectric strength is given" in " ".join(title_of(figure(without, FLANK)))


def test_thick_films_at_the_edge_of_the_load_share_a_colour():
    """A twentieth of the places has the last colour; nearly equal films all differ."""
    most = np.concatenate([np.linspace(1e-7, 2e-7, 100), np.full(4, 5e-6)])
    assert last_colour(most) == pytest.approx(2e-7, rel=0.02)
    assert last_colour(np.array([1e-7, np.nan, 1.05e-7])) == 1.05e-7


def test_almost_all_and_almost_none_are_not_rounded_to_all_and_none(helical):
    """Summits between the two thinnest or the two thickest films of the phases, and of the flank."""
    solution = helical.solution
    phases = np.unique(solution.loads.least(solution.films.minimum)) / solution.rq
    flank = np.unique(flank_map(helical)[2]) / solution.rq

    def findings(height):
        case = helical_case(
            **{"gear.contact.conduction": "never", "gear.contact.voltage": "3 V"},
            **{"gear.summit_height": float(height)},
        )
        result = solve_gear(case, probable=False)
        return mesh_finding(result), flank_finding(result)

    # Summits touch at all phases except the one with the thickest film.
    assert " of the phases; breakdown voltage elsewhere up to" in findings(np.mean(phases[-2:]))[0]
    assert "touch on more than 99 % of the flank" in findings(np.mean(flank[-2:]))[1]
    assert "touch on less than 1 % of the flank" in findings(np.mean(flank[:2]))[1]
    for finding in findings(1.01 * flank[-1]):
        assert "%" not in finding
        assert " 0 " not in finding


def test_the_mesh_is_drawn_over_its_phase(spur):
    capacitance, voltage, share = figure(spur, MESH).axes
    phase = spur.over_phase()
    shown = np.interp(phase["phase"], *capacitance.get_lines()[0].get_data())
    assert shown == pytest.approx(1e12 * phase["capacitance"])
    assert capacitance.get_ylabel().endswith("[pF]")
    # Two pairs of teeth touch for the fractional part of the contact ratio, 0.4375.
    jump = phase["phase"][np.argmin(np.diff(phase["capacitance"]))]
    assert jump == pytest.approx(0.4375, abs=0.01)
    assert curve(voltage, "voltage between both gears").get_ydata() == pytest.approx(3.0)
    assert np.min(curve(voltage, "breakdown voltage").get_ydata()) == pytest.approx(
        spur.summary()["mesh"]["breakdown_voltage"]
    )
    assert share.get_lines()[0].get_ydata() == pytest.approx(0.0, abs=1e-3)
    title = title_of(figure(spur, MESH))[0]
    assert title.startswith(f"{spur.verdict.lead} at 3 V: margin 0.37; breakdown voltage 1.12 to 1.9")


@each(
    "changes, start, panels",
    [
        ({"gear.contact.voltage": None}, "The mesh insulates: breakdown voltage 1.12 to", 3),
        ({"gear.contact.voltage": "80 V"}, "Breakdown expected at 80 V: margin 0.014; breakdown voltage", 3),
        (
            {"discharge.dielectric_strength": None},
            "The mesh insulates: metallic contact less than 0.01 % of the time",
            2,
        ),
        (
            {"gear.flank_ra": ["0.06 um"], "discharge.dielectric_strength": None},
            "Discharges likely at 3 V: the highest summits touch at all phases",
            2,
        ),
        ({"gear.flank_ra": ["0.05 um"]}, "Discharges likely at 3 V: the highest summits touch at", 3),
        (
            {"gear.flank_ra": ["0.4 um"]},
            "The mesh conducts: metallic contact 99.",
            2,
        ),
        (
            {"gear.flank_ra": ["0.4 um"], "gear.contact.conduction": "never"},
            "Discharges likely at 3 V: the highest",
            2,
        ),
    ],
)
def test_titles_of_the_mesh(changes, start, panels):
    drawn = figure(solve_gear(spur_case(**changes), probable=False), MESH)
    assert " ".join(title_of(drawn)).startswith(start)
    assert len(drawn.axes) == panels


def test_titles_name_the_operating_point(helical):
    for name in figure_names(helical):
        lines = " ".join(title_of(figure(helical, name)))
        assert "First stage, 150 N m on gear 1, 12 000 rpm, flanks at 95 °C" in lines.replace("\xa0", " ")
        assert "load sharing by the stiffness of the teeth; films from the atlas, load factor 1" in lines
