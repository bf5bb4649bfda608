"""Figures of a bearing, of contacts made by hand: what they show, and what they leave out."""

import re
from dataclasses import replace

import numpy as np
import pytest
import tomli_w
from matplotlib.figure import Figure
from matplotlib.text import Text
from typer.testing import CliRunner

import ehlectric
from ehlectric import solve_bearing
from ehlectric.app.charts.bearing_charts import ring_figure
from ehlectric.bearing.preparation import equilibria_of, resolve_bearing
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.ring_contacts import ContactCurve, RingContacts
from ehlectric.bearing.solution import BearingSolution, Position, ring_state
from ehlectric.bearing.speed_curves import critical_speed_of, curves_of, over_speed
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.commands.command_line import app
from ehlectric.figures import bearing_figures as bearing_circuit_plot
from ehlectric.figures import bearing_figures as bearing_impedance_plot
from ehlectric.figures import bearing_figures as bearing_pitch_plot
from ehlectric.figures import bearing_figures as bearing_polar
from ehlectric.figures import breakdown_over_speed as bearing_speed_plot
from ehlectric.figures.bearing_figure_files import (
    bearing_figures_of,
    figure,
    save_speed_figures,
    speed_figure,
)
from ehlectric.figures.figure_names import BEARING_FIGURE_FILES, SPEED_FIGURE_FILES
from ehlectric.figures.ring_panels import film_panel, load_panel
from ehlectric.quantities.palette import BLACK, BLUE, RED
from ehlectric.quantities.verdict import Verdict
from tests.helpers.bearings import BALLS, bearing_case, contact_solution
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES
from tests.helpers.titles import title_of

LOADS, CIRCUIT, PITCH, IMPEDANCE, MARGIN, _ = BEARING_FIGURE_FILES

TABLE = {
    "title": "By hand",
    "bearing": {
        "kind": "deep-groove ball",
        "elements": 9,
        "element_diameter": "11.906 mm",
        "pitch_diameter": "60 mm",
        "inner_groove": 0.52,
        "outer_groove": 0.52,
        "shoulder_height": 0.2,
        "radial_clearance": "10 um",
        "radial_load": "1800 N",
        "inner_speed": "3000 rpm",
        "temperature": "70 degC",
        "composite_rq": "0.03 um",
    },
    "motor": {
        "common_mode_voltage": "300 V",
        "winding_rotor_capacitance": "20 pF",
        "rotor_frame_capacitance": "1 nF",
    },
    "lubricant": {"base": "paper", "viscosity": "0.041 Pa s"},
    "discharge": {"dielectric_strength": "15 V/um", "conductivity": "1 nS/m"},
}

OF_BEARING = (
    bearing_polar.load_around,
    bearing_polar.film_around,
    bearing_circuit_plot.contact_capacitances,
    bearing_circuit_plot.breakdown_voltages,
    bearing_impedance_plot.impedance_magnitude,
    bearing_impedance_plot.impedance_phase,
    bearing_pitch_plot.capacitance_over_pitch,
    bearing_pitch_plot.breakdown_over_pitch,
)

# Factor from rad/s to revolutions per minute.
RPM = 30.0 / np.pi

OVER_SPEED = (bearing_speed_plot.capacitance_over_speed, bearing_speed_plot.breakdown_over_speed)


def contact(load, film, strength):
    """A contact of a film that thins with load^-0.07 and a capacitance that goes with load^0.4."""
    thickness = film * (load / 900.0) ** -0.07
    return contact_solution(
        load=load,
        max_pressure=1.9e9 * (load / 900.0) ** (1.0 / 3.0),
        semi_axis_x=1.5e-4,
        semi_axis_y=1.4e-3,
        minimum_thickness=thickness,
        central_thickness=1.1 * thickness,
        inside=8e-11 * (load / 900.0) ** 0.4,
        outside_oil=3e-11,
        outside_air=1.25e-11,
        plate=3e-11,
        strength_per_volt=1.0 / thickness,
        breakdown_voltage=np.inf if strength is None else strength * thickness,
        error=0.01,
        moes_m=1000.0,
        moes_l=10.0,
        mismatch=0.0,
        converged=True,
        warnings=(),
    )


def by_hand(*, film=0.2e-6, positions=2, **changes):
    """A result of two known contacts a ring; changes are of the file's tables, by their names."""
    table = dict(TABLE)
    for name, values in changes.items():
        if values is None:
            del table[name]
        else:
            table[name] = table[name] | values
    case = BearingCase.from_dict(table)
    conditions = resolve_bearing(case)
    strength = case.discharge.dielectric_strength
    rings = [RingContacts(conditions, inner, angle=0.0, speed=4.5) for inner in (True, False)]
    curves = [
        ContactCurve.of(tuple(contact(load, thick, strength) for load in (1.0, 900.0)))
        for thick in (film, 1.2 * film)
    ]
    states = []
    for at in equilibria_of(conditions, positions):
        of_rings = ((at.inner_load, at.inner_gap), (at.outer_load, at.outer_gap))
        both = [
            ring_state(ring, curve, load=load, gap=gap, room=at.inner_gap + at.outer_gap)
            for ring, curve, (load, gap) in zip(rings, curves, of_rings, strict=True)
        ]
        states.append(Position(at, *both))
    return BearingResult(BearingSolution(case, conditions, *rings, *curves, tuple(states), seconds=1.0))


@pytest.fixture(scope="module")
def result():
    return by_hand()


def at_speed(rpm, capacitance, first, shaft, *, lubrication="full film", fill="oil"):
    """Speed and summary, air a tenth below oil, the bearing broken through at 1.5 times its first break."""
    bearing = {
        "contacts": "formula",
        "capacitance": capacitance if fill == "oil" else 0.9 * capacitance,
        "capacitance_oil": capacitance,
        "capacitance_air": 0.9 * capacitance,
        "first_break": first,
        "ring_to_ring_breakdown": None if first is None else 1.5 * first,
        "shaft_voltage": shaft,
        "lubrication": lubrication,
        "lambda_ratio": {"conducting": 0.5, "partial film": 1.5, "full film": 6.0}[lubrication],
    }
    table = {"bearing": bearing, "converged": True, "inputs": {"bearing": {"fill": fill}}}
    return rpm * np.pi / 30.0, table


@pytest.fixture
def points():
    """Not in the order of their speeds."""
    return [
        at_speed(3000.0, 2.3e-10, 5.6, 4.0),
        at_speed(500.0, 6e-10, None, 3.5, lubrication="conducting"),
        at_speed(1000.0, 4e-10, 2.5, 3.7, lubrication="partial film"),
        at_speed(6000.0, 1.6e-10, 9.0, 4.2),
    ]


def said(drawn):
    """Whole title of a figure, also where its lines are broken."""
    return " ".join(title_of(drawn))


def line(ax, start):
    """The only line whose label starts so."""
    (found,) = [line for line in ax.get_lines() if line.get_label().startswith(start)]
    return found


@pytest.mark.slow
@each("draw", OF_BEARING)
def test_panels_say_their_unit_and_take_the_axes_given(result, draw):
    polar = draw in OF_BEARING[:2]
    ax = Figure().add_subplot(projection="polar" if polar else None)
    assert draw(result, ax) is ax
    text = ax.get_title() if polar else ax.get_ylabel()
    assert text.split()[-1] in {"[N]", "[µm]", "[pF]", "[V]", "[%]", "[Ω]", "[°]"}


@each("draw", OF_BEARING)
def test_panels_make_axes_of_their_own(result, draw):
    assert draw(result).has_data()


def test_load_points_down_and_elements_without_load_are_hollow(result):
    ax = bearing_polar.load_around(result)
    assert np.sin(ax.get_theta_offset()) == pytest.approx(-1.0)
    at = result.solution.positions[0].equilibrium
    free = at.inner_load == 0.0
    assert 0 < np.sum(free) < 9
    hollow = line(ax, "inner, unloaded")
    np.testing.assert_array_equal(hollow.get_xdata(), at.position[free])
    assert hollow.get_markerfacecolor() == "white"
    loads = line(ax, "outer contact").get_ydata()
    np.testing.assert_array_equal(loads, at.outer_load)
    # The centre of the axes is no load: the circle of no load has a radius, and marks on it are apart.
    assert ax.get_rorigin() < 0.0 == ax.get_rmin()


def test_film_shades_the_sector_without_load_and_shows_the_lambdas_that_are_near(result):
    """The gap there, of micrometres, is not on the scale of the films; the legend states it."""
    ax = bearing_polar.film_around(result)
    races = [position.inner for position in result.solution.positions]
    gap = 1e6 * max(race.gap[~race.solved].max() for race in races)
    legend = [text.get_text() for text in ax.get_legend().get_texts()]
    assert f"inner unloaded: gap to {gap:.2g} µm" in legend
    assert not [text for text in legend if text.startswith("outer unloaded")]
    films = np.concatenate([race.values.minimum_thickness[race.solved] for race in races])
    drawn = np.concatenate([found.get_ydata() for found in ax.get_lines() if found.get_color() == BLUE])
    assert np.nanmax(drawn) == pytest.approx(1e6 * films.max(), rel=1e-12)
    assert ax.get_ylim()[1] < gap
    # The sector has all angles at which the inner ring is unloaded, and none at which it loads an element.
    angles = np.concatenate([position.equilibrium.position for position in result.solution.positions])
    free = ~np.concatenate([race.solved for race in races])
    shaded = [np.mod(c.get_paths()[0].vertices[:, 0], 2.0 * np.pi) for c in ax.collections if c.get_paths()]
    ends = [(part.min(), part.max()) for part in shaded if len(part)]
    for angle, unloaded in zip(np.mod(angles, 2.0 * np.pi), free, strict=True):
        assert any(low <= angle <= high for low, high in ends) == unloaded
    # 0.2 um is lambda 6.7 of 0.03 um: a circle at lambda 3, 0.09 um, none at 1.
    np.testing.assert_allclose(line(ax, "λ = 3: mixed lubrication inside").get_ydata(), 0.09, rtol=1e-12)
    assert not [found for found in ax.get_lines() if found.get_label().startswith("λ = 1")]


@pytest.mark.parametrize("style", ["screen", "journal"])
def test_legends_below_the_rings_lie_within_the_figure(style):
    """Both circles are drawn: their states have the longest names."""
    drawn = ehlectric.figure(by_hand(film=0.07e-6), "bearing_loads.png", style=style)
    drawn.canvas.draw()
    for ax in drawn.axes:
        box, page = ax.get_legend().get_window_extent(), drawn.bbox
        assert page.x0 <= box.x0 < box.x1 <= page.x1
        assert page.y0 <= box.y0 < box.y1 <= page.y1


def test_lines_go_once_around_through_all_positions(result):
    ax = bearing_polar.load_around(result)
    around = [found for found in ax.get_lines() if len(found.get_xdata()) == 2 * 9 + 1]
    assert len(around) == 4  # of each ring loaded and not
    for found in around:
        assert found.get_xdata()[-1] - found.get_xdata()[0] == pytest.approx(2.0 * np.pi)
        assert np.all(np.diff(found.get_xdata()) > 0.0)


def test_voltages_of_contacts_are_those_of_the_bearing(result):
    """V of a contact over its share; the least of them all is the first break of the position."""
    ax = bearing_circuit_plot.breakdown_voltages(result)
    inner, outer = (line(ax, f"{ring} contact").get_ydata() for ring in ("inner", "outer"))
    rows = result.contacts()
    expected = [row["breakdown_voltage"] / row["voltage_share"] for row in rows]
    np.testing.assert_allclose(inner, expected[::2], rtol=1e-12)
    np.testing.assert_allclose(outer, expected[1::2], rtol=1e-12)
    circuit = result.solution.circuits("oil")[0]
    assert min(*inner, *outer) == pytest.approx(circuit.first_break, rel=1e-12)
    assert line(ax, "first").get_ydata()[0] == result.breaks()["first_break"]
    assert line(ax, "shaft voltage").get_ydata()[0] == result.shaft_voltage
    # The numbers of the lines stand beside the axes, at their heights.
    beside = "\n".join(text.get_text() for text in ax.texts)
    assert f"{result.breaks()['first_break']:#.3g} V" in beside
    assert f"shaft voltage\n{result.shaft_voltage:#.3g} V" in beside


@pytest.mark.parametrize(("apart", "lines"), [(1.0, 1), (1.3, 2)])
def test_breakdowns_that_coincide_are_one_line_with_both_names(result, monkeypatch, apart, lines):
    found = result.breaks()
    changed = found | {"shaft_ring_to_ring_breakdown": apart * found["shaft_first_break"]}
    monkeypatch.setattr(BearingResult, "breaks", lambda _: changed)
    ax = bearing_circuit_plot.breakdown_voltages(result)
    names = {line.get_label() for line in ax.get_lines() if line.get_label().endswith("breakdown")}
    one, two = {"first and ring-to-ring breakdown"}, {"first breakdown", "ring-to-ring breakdown"}
    assert names == (one if lines == 1 else two)


def test_bars_are_capacitances(result):
    circuit = result.solution.circuits("oil")[0]
    heights = [bar.get_height() for bar in bearing_circuit_plot.contact_capacitances(result).patches]
    np.testing.assert_allclose(heights, 1e12 * np.concatenate([circuit.inner, circuit.outer]), rtol=1e-12)


def test_a_pitch_ends_as_it_begins(result):
    ax = bearing_pitch_plot.capacitance_over_pitch(result)
    for fill in ("oil", "air"):
        found = line(ax, fill)
        angles, values = found.get_data()
        assert (angles[0], angles[-1]) == (0.0, pytest.approx(40.0))
        assert values[-1] == values[0]
        assert np.mean(values[:-1]) == pytest.approx(0.0, abs=1e-9)
        own = [circuit.capacitance for circuit in result.solution.circuits(fill)]
        assert values[0] == pytest.approx(100.0 * (own[0] / np.mean(own) - 1.0), rel=1e-9)
        assert found.get_label().endswith(f"mean {1e12 * result.capacitance(fill):.4g} pF")


@pytest.mark.slow
def test_a_panel_over_a_pitch_is_drawn_where_its_quantity_varies(monkeypatch):
    """At one position nothing varies, and there is no figure; at 2 % there is."""
    bearing = by_hand(positions=2)
    for capacitance, first, panels in (
        (0.005, 0.005, ()),
        (0.02, 0.005, (bearing_pitch_plot.capacitance_over_pitch,)),
        (0.005, 0.02, (bearing_pitch_plot.breakdown_over_pitch,)),
    ):
        swing = np.array([-0.5, 0.5])
        of_all = {
            "capacitances": 1e-10 * (1.0 + capacitance * swing),
            "first_breakdowns": 5.0 + 5.0 * first * swing,
        }
        for name, values in of_all.items():
            monkeypatch.setattr(f"ehlectric.figures.bearing_figure_files.{name}", lambda *_, v=values: v)
        assert bearing_figures_of(bearing).get(PITCH, ()) == panels
    monkeypatch.undo()
    assert PITCH not in bearing_figures_of(by_hand(positions=1))


@pytest.mark.slow
@each(
    "changes, figures, panels",
    [
        ({}, (LOADS, CIRCUIT, IMPEDANCE, MARGIN), (2, 2, 1, 1)),
        ({"motor": None}, (LOADS, CIRCUIT, IMPEDANCE), (2, 2, 1)),
        ({"discharge": None}, (LOADS, CIRCUIT), (2, 1)),
        ({"film": 0.02e-6}, (LOADS, CIRCUIT), (2, 1)),
        ({"bearing": {"element_material": "silicon-nitride"}}, (LOADS,), (2,)),
        # A conductive oil: its corner at 7.5 kHz is in the range, and the phase is no number there.
        ({"discharge": {"conductivity": "1 uS/m"}}, (LOADS, CIRCUIT, IMPEDANCE, MARGIN), (2, 2, 2, 1)),
    ],
)
def test_what_has_no_meaning_is_not_drawn(changes, figures, panels):
    found = bearing_figures_of(by_hand(positions=1, **changes))
    assert tuple(found) == figures
    assert tuple(len(draws) for draws in found.values()) == panels


@pytest.mark.slow
def test_the_margin_over_the_speed_has_its_band_and_the_bearing_itself():
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "atlas"})
    result = solve_bearing(case, workers=1)
    ax = bearing_speed_plot.margin_over_speed(result)
    band, lines = result.margin_band, [line.get_xydata() for line in ax.get_lines()]
    (star,) = (line for line in lines if len(line) == 1)
    assert star[0].tolist() == pytest.approx([case.bearing.inner_speed * RPM, result.margin])
    (median,) = (line for line in lines if len(line) == band.speed.size and not np.all(line[:, 1] == 1.0))
    # The axis ends at half of the least median, or at 0.05 where films break down for sure.
    least = max(0.5 * band.median.min(where=band.median > 0.0, initial=1.0), 0.05)
    shown = np.where(band.median > least, band.median, np.nan)
    np.testing.assert_allclose(median, np.stack([band.speed * RPM, shown], axis=-1))
    ends = np.concatenate([band.get_paths()[0].vertices[:, 1] for band in ax.collections[:2]])
    least = max(band.low.min(), least)
    assert (ends.min(), ends.max()) == pytest.approx((least, band.high.max()), rel=1e-6)
    # Round numbers are at most a factor of 2.5 apart: ticks reach as far as the band.
    assert max(ax.get_yticks()) > ends.max() / 2.5
    assert min(ax.get_yticks()) < 2.5 * ends.min()
    finding = " ".join(title_of(figure(result, MARGIN)))
    assert "probability" in finding
    assert "90 of 100 cases" in finding


def test_a_bearing_without_motor_has_no_shaft_voltage():
    ax = bearing_pitch_plot.breakdown_over_pitch(by_hand(positions=1, motor=None))
    assert not [found for found in ax.get_lines() if found.get_label().startswith("shaft")]


@pytest.mark.slow
def test_the_command_draws_unless_told_not_to(result, monkeypatch, tmp_path):
    """And takes the figures of an earlier bearing away."""
    file = tmp_path / "bearing.toml"
    file.write_text(tomli_w.dumps(TABLE), encoding="utf-8")
    monkeypatch.setattr("ehlectric.bearing.run.solve_bearing", lambda *_args, **_kwargs: result)
    drawn = *bearing_figures_of(result), *SPEED_FIGURE_FILES
    for option, figures in (("--plots", drawn), ("--no-plots", ())):
        done = CliRunner().invoke(app, ["bearing", str(file), "-o", str(tmp_path / "out"), "-q", option])
        assert done.exit_code == 0, done.output
        written = {path.name for path in (tmp_path / "out").iterdir()}
        assert written == {"summary.json", "contacts.csv", "impedance.csv", "bearing.nc", *figures}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({}, "isothermal, fully flooded film, minimum λ 6.7, contacts solved: voltages are upper bounds"),
        (
            {"film": 0.02e-6},
            ("isothermal, fully flooded film, minimum λ 0.67, contacts solved: boundary lubrication"),
        ),
        (
            {"bearing": {"film_factor": 0.6}},
            "film factor 0.6, minimum λ 6.7, contacts solved",
        ),
    ],
)
def test_titles_say_what_the_film_is_worth(changes, text):
    """0.2 um of film at 900 N, about the most loaded ball here, over 0.03 um of roughness."""
    found = by_hand(positions=1, **changes)
    titles = {name: said(figure(found, name)) for name in bearing_figures_of(found)}
    plain = text.removesuffix(": voltages are upper bounds")
    assert all(title.endswith((text, plain)) for title in titles.values())
    # The circuit shows voltages of breakdown; the others do not.
    bounds = [name for name, title in titles.items() if title.endswith("upper bounds")]
    assert bounds == ([CIRCUIT] if "upper bounds" in text else [])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("title", "line"),
    [
        ("By hand", "By hand, 1800 N radial, 3000 rpm, 70 °C"),
        ("6208, 3000 rpm, 70 °C", "6208, 3000 rpm, 70 °C, 1800 N radial"),
    ],
)
def test_titles_say_the_duty_once(title, line):
    found = by_hand(positions=1)
    solution = replace(found.solution, case=found.case.replace({"title": title}))
    assert title_of(figure(BearingResult(solution), LOADS))[1] == line


@pytest.mark.slow
def test_titles_say_the_finding(result):
    most = max(result.contacts(), key=lambda row: row["load"])
    thin = min(result.contacts(), key=lambda row: row["minimum_thickness"])
    least = 1e6 * thin["minimum_thickness"]
    text = said(figure(result, LOADS))
    assert text.startswith(f"Largest load {most['load']:.3g} N ({most['ring']}, element {most['element']}); ")
    film = f"minimum film {least:.3g} µm ({thin['ring']}, element {thin['element']}), λ {least / 0.03:.2g}"
    assert f"{film} By hand" in text
    found, shaft = result.breaks(), result.shaft_voltage
    assert said(figure(result, CIRCUIT)).startswith(
        f"Breakdown possible: margin {found['first_break'] / shaft:.3g} "
        f"(first breakdown {found['first_break']:#.3g} V / shaft voltage {shaft:#.3g} V)"
    )
    safe = by_hand(motor={"common_mode_voltage": "60 V"})
    assert said(figure(safe, CIRCUIT)).startswith("No breakdown expected: margin ")
    below = by_hand(motor={"common_mode_voltage": "3 kV"})
    assert said(figure(below, CIRCUIT)).startswith("Breakdown expected: margin 0.")
    alone = by_hand(motor=None)
    assert said(figure(alone, CIRCUIT)).startswith(f"First breakdown at {found['first_break']:#.3g} V: ")
    # Far above its corner the bearing is a capacitor, of 1/(2 pi f C).
    capacitance = result.capacitance("oil")
    text = said(figure(result, IMPEDANCE))
    assert text.startswith(f"A capacitor of {1e12 * capacitance:.3g} pF above 7.49 Hz: |Z| = ")
    assert f"{1e-3 / (2.0 * np.pi * 2e4 * capacitance):.3g} kΩ at 20 kHz" in text


def test_impedance_is_drawn_where_an_inverter_works(result):
    ax = bearing_impedance_plot.impedance_magnitude(result)
    assert ax.get_xlim() == (1e3, pytest.approx(1e7))
    (band,) = ax.patches
    assert (band.get_x(), band.get_x() + band.get_width()) == bearing_impedance_plot.INVERTER
    wet = by_hand(discharge={"conductivity": "1 uS/m"})
    ax = bearing_impedance_plot.impedance_magnitude(wet)
    corner = next(found for found in ax.get_lines() if found.get_linestyle() == "--").get_xdata()[0]
    assert ax.get_xlim()[0] == pytest.approx(0.1 * corner)
    assert "7.49 kHz" in "".join(text.get_text() for text in ax.texts)


def test_radii_are_named_where_no_mark_is():
    """Of an even number of elements one is at 180 degrees, at the top; of nine none is."""
    for elements, away in ((9, 0.0), (8, 22.5)):
        found = by_hand(positions=1, bearing={"elements": elements})
        for draw in OF_BEARING[:2]:
            angles = {np.degrees(text.get_position()[0]) for text in draw(found).texts}
            assert len(angles) == 1
            assert abs(angles.pop() - 180.0) == pytest.approx(away, abs=1e-9)


def test_a_bearings_capacitance_over_its_contacts_is_that_of_the_position_shown(result):
    """And of the mean over a pitch, which tables and summary have."""
    (text,) = bearing_circuit_plot.contact_capacitances(result).texts
    here, mean = result.solution.circuits("oil")[0].capacitance, result.capacitance("oil")
    assert f"{1e12 * here:.4g}" != f"{1e12 * mean:.4g}"
    assert text.get_text() == (
        f"bearing, oil fill: mean {1e12 * mean:.4g} pF\nat this cage position {1e12 * here:.4g} pF"
    )


@pytest.mark.slow
def test_a_bearing_that_did_not_converge_says_so(result):
    curve = result.solution.inner_curve
    failed = ContactCurve.of((replace(curve.solutions[0], converged=False), *curve.solutions[1:]))
    found = BearingResult(replace(result.solution, inner_curve=failed))
    for name in bearing_figures_of(found):
        drawn = figure(found, name)
        assert title_of(drawn)[0] == "NOT CONVERGED"
        assert drawn._suptitle.get_color() == RED


@pytest.mark.slow
@pytest.mark.parametrize("draw", OVER_SPEED)
def test_speeds_are_in_rpm_and_in_order(points, draw):
    ax = draw(points)
    assert "rpm" in ax.get_xlabel()
    dots = [found for found in ax.get_lines() if found.get_marker() == "o" and len(found.get_xdata()) > 1]
    assert dots
    for found in dots:
        np.testing.assert_allclose(found.get_xdata(), [500.0, 1000.0, 3000.0, 6000.0], rtol=1e-12)


def test_capacitance_over_speed_has_its_bounds(points):
    ax = bearing_speed_plot.capacitance_over_speed(points)
    for fill, expected in (("oil", [600.0, 400.0, 230.0, 160.0]), ("air", [540.0, 360.0, 207.0, 144.0])):
        at_speeds = np.interp([500.0, 1000.0, 3000.0, 6000.0], *line(ax, fill).get_data())
        np.testing.assert_allclose(at_speeds, expected)
    assert line(ax, "oil").get_linewidth() > line(ax, "air").get_linewidth()
    band = ax.collections[0]
    up = band.get_paths()[0].vertices[:, 1]
    heights = up.min(), up.max()
    np.testing.assert_allclose(heights, [0.9 * 160.0, 600.0])


# Between 1000 and 3000 rpm the margin is a power of the speed: 2.5/3.7 and 5.6/4.0 are the ends.
CROSSING = 1000.0 * 3.0 ** (np.log(3.7 / 2.5) / np.log((5.6 / 4.0) / (2.5 / 3.7)))


def test_the_crossing_is_marked_named_and_in_the_title(points):
    assert 1000.0 < CROSSING < 3000.0
    assert RPM * critical_speed_of(curves_of(points)) == pytest.approx(CROSSING, rel=1e-12)
    drawn = speed_figure(points, SPEED_FIGURE_FILES[1], "By hand")
    (ax,) = drawn.axes
    (mark,) = [found for found in ax.get_lines() if found.get_markerfacecolor() == "white"]
    (at,), (height,) = mark.get_data()
    assert at == pytest.approx(CROSSING, rel=1e-12)
    # Both drawn curves pass through it.
    for name in ("first", "shaft"):
        x, y = line(ax, name).get_data()
        known = np.isfinite(y)
        on_curve = np.exp(np.interp(np.log(at), np.log(x[known]), np.log(y[known])))
        assert on_curve == pytest.approx(height, rel=1e-4)
    named = f"{float(f'{CROSSING:.3g}'):g} rpm"
    assert named in [text.get_text().strip() for text in ax.texts]
    assert title_of(drawn) == [
        f"Margin below 1 up to about {named}; frequent asperity contact below 774 rpm",
        "By hand",
        "curves: contacts from the film-thickness formula",
    ]


def test_a_critical_speed_of_the_summary_is_that_of_the_figure(points):
    at_case = at_speed(3000.0, 2.3e-10, 5.6, 4.0)
    at_case[1]["margin"] = {"critical_speed": 1234.0 / RPM}
    drawn = speed_figure(points, SPEED_FIGURE_FILES[1], at_case=at_case)
    assert said(drawn).startswith(
        "Margin below 1 up to about 1230 rpm; frequent asperity contact below 774 rpm (margin 1.40"
    )
    (mark,) = [found for found in drawn.axes[0].get_lines() if found.get_markerfacecolor() == "white"]
    assert mark.get_xdata()[0] == pytest.approx(1234.0)


@pytest.mark.slow
def test_the_critical_speed_of_table_title_and_picture_is_one():
    """The table's is found by solving at more speeds; the drawn curves cross within a per cent of it."""
    motor = {
        "common_mode_voltage": "300 V",
        "winding_rotor_capacitance": "20 pF",
        "rotor_frame_capacitance": "1 nF",
    }
    found = solve_bearing(bearing_case(BALLS, contacts="formula").replace({"motor": motor}), workers=1)
    critical = found.margin_analysis.critical_speed
    assert critical is not None
    named = f"{float(f'{critical * RPM:.3g}'):g} rpm"
    drawn = figure(found, SPEED_FIGURE_FILES[1])
    assert said(drawn).startswith(f"Margin below 1 up to about {named} (margin ")
    assert named in [text.get_text().strip() for text in drawn.axes[0].texts]
    first, shaft = (line(drawn.axes[0], name).get_data() for name in ("first", "shaft"))
    at = np.argmin(np.abs(np.log(first[1] / shaft[1])))
    assert first[0][at] == pytest.approx(critical * RPM, rel=0.03)


@pytest.mark.slow
def test_a_doubtful_margin_is_no_promise(result, monkeypatch):
    for level, lead in (("yellow", "Breakdown possible: margin"), ("grey", "Margin")):
        verdict = Verdict(level, "breakdown-possible")
        monkeypatch.setattr(BearingResult, "verdict", property(lambda _, v=verdict: v))
        assert said(figure(result, CIRCUIT)).startswith(f"{lead} 1.")


def example_at(n):
    """The example with smooth films and contacts by formula at a speed [rpm]."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    changes = {"contacts": "formula", "bearing.inner_speed": f"{n} rpm", "bearing.summit_height": 0.0}
    return solve_bearing(case.replace(changes), workers=1)


@pytest.mark.slow
def test_curves_begin_where_the_surfaces_part():
    """At 100 rpm, lambda 0.65: voltages from a lambda ratio of 1 on, no speed without curve or hatch."""
    slow = example_at(100)
    points, left_out = over_speed(slow.case)
    assert left_out == []
    first = next(point for point in points if point[1]["bearing"]["first_break"] is not None)
    assert first[1]["bearing"]["lambda_ratio"] == pytest.approx(1.0, abs=5e-3)
    assert first[1]["bearing"]["lambda_ratio"] >= 1.0
    assert [at for at, _ in points] == sorted(at for at, _ in points)
    named = f"{float(f'{first[0] * RPM:.3g}'):g} rpm"
    drawn = speed_figure(
        points, SPEED_FIGURE_FILES[1], at_case=(slow.case.bearing.inner_speed, slow.summary())
    )
    whole = " ".join(title_of(drawn))
    assert whole.startswith(f"Margin below 1 at all speeds from {named} to 400 rpm;")
    assert f"below {named}" in said(drawn)
    # What the shading means stands above the axes, not on a curve.
    (ax,) = drawn.axes
    assert not [text for text in ax.texts if "expected" in text.get_text()]
    assert "margin below 1" in [text.get_text() for text in ax.get_legend().get_texts()]


@pytest.mark.slow
def test_title_and_verdict_name_one_range_of_speeds():
    """At 200 rpm, lambda 1.04, the margin is below 1 from the speed where surfaces part to 800 rpm."""
    result = example_at(200)
    low, high = re.search(r"below 1 at all speeds computed, (\d+) to (\d+) rpm", result.verdict.text).groups()
    text = f"Margin below 1 at all speeds from {low} rpm to {high} rpm; frequent asperity contact"
    assert said(figure(result, SPEED_FIGURE_FILES[1])).startswith(text)


@pytest.mark.slow
@each(
    "voltages, text",
    [
        ([(2.0, 1.0), (4.0, 1.0)], "Margin above 1 from 1000 rpm to 2000 rpm"),
        ([(2.0, 5.0), (4.0, 5.0)], "Margin below 1 at all speeds from 1000 rpm to 2000 rpm"),
        ([(2.0, 1.0), (4.0, 5.0)], "Margin below 1 above 1000 rpm"),
        ([(2.0, None), (4.0, None)], "First breakdown from 2.00 V at 1000 rpm to 4.00 V at 2000 rpm"),
        ([(6.0, 5.0), (4.0, 5.0), (10.0, 5.0)], "Margin below 1 at some speeds up to about 2210 rpm"),
    ],
)
def test_titles_say_at_which_speeds_breakdown_is_expected(voltages, text):
    """In the last row the margin is 0.8 at 2000 rpm and 2 at 3000 rpm: 2000 1.5^(ln 1.25/ln 2.5) rpm."""
    some = [at_speed(1000.0 * (k + 1), 2e-10, *pair) for k, pair in enumerate(voltages)]
    assert title_of(speed_figure(some, SPEED_FIGURE_FILES[1]))[0] == text


def test_breakdown_over_speed_shades_where_the_shaft_has_more(points):
    ax = bearing_speed_plot.breakdown_over_speed(points)
    first = line(ax, "first").get_ydata()
    np.testing.assert_allclose([first[0], *first[-1:]], [np.nan, 9.0])
    dots = next(f for f in ax.get_lines() if f.get_marker() == "o" and f.get_color() == BLACK)
    np.testing.assert_array_equal(dots.get_ydata(), [np.nan, 2.5, 5.6, 9.0])
    (band,) = (found for found in ax.collections if found.get_label() == "margin below 1")
    across = band.get_paths()[0].vertices[:, 0]
    np.testing.assert_allclose((across.min(), across.max()), [1000.0, CROSSING], rtol=2e-3)
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert [name.partition(":")[0] for name in names] == ["margin below 1", "λ < 1", "1 ≤ λ < 3"]


def test_speeds_at_which_contacts_open_are_shaded_and_in_the_title(points):
    """A lambda ratio of 0.5 at 500, 1.5 at 1000, 6 at 3000 rpm, and powers of the speed between them."""
    opening, parted = 500.0 * 2.0 ** (np.log(2.0) / np.log(3.0)), 1000.0 * 3.0**0.5
    for draw in (bearing_speed_plot.breakdown_over_speed, bearing_speed_plot.capacitance_over_speed):
        touching, partial = draw(points).collections[-2:]
        ends = [
            (
                float(np.min(band.get_paths()[0].vertices[:, 0])),
                float(np.max(band.get_paths()[0].vertices[:, 0])),
            )
            for band in (touching, partial)
        ]
        assert ends[0] == (pytest.approx(500.0), pytest.approx(opening, rel=0.03))
        assert ends[1] == (pytest.approx(opening, rel=0.03), pytest.approx(parted, rel=0.03))
        assert ends[0][1] >= ends[1][0]
        assert touching.get_hatch()
    assert f"frequent asperity contact below {float(f'{opening:.3g}'):g} rpm" in said(
        speed_figure(points, SPEED_FIGURE_FILES[1])
    )


def test_curves_are_scaled_to_a_bearing_of_solved_contacts(points):
    """5.6 V by formula and 5.0 V solved at 3000 rpm: the curve has 5.0 V there, and keeps its shape."""
    at_case = at_speed(3000.0, 1.8e-10, 5.0, 5.0)
    at_case[1]["bearing"] |= {"contacts": "solved", "ring_to_ring_breakdown": 5.0}
    curves = curves_of(points, at_case)
    np.testing.assert_allclose(curves["first_break"], np.array([np.nan, 2.5, 5.6, 9.0]) * 5.0 / 5.6)
    np.testing.assert_allclose(curves["shaft_voltage"], np.array([3.5, 3.7, 4.0, 4.2]) * 5.0 / 4.0)
    for name, key, height in zip(
        SPEED_FIGURE_FILES, ("capacitance", "first_break"), (180.0, 5.0), strict=True
    ):
        drawn = speed_figure(points, name, at_case=at_case)
        (star,) = [found for found in drawn.axes[0].get_lines() if found.get_marker() == "*"]
        np.testing.assert_allclose(star.get_data(), [[3000.0], [height]], rtol=1e-12)
        assert key in curves.values
        assert said(drawn).endswith(
            "curves: contacts from the film-thickness formula, "
            "scaled by 0.783 and 0.893 to the solved contacts at 3000 rpm (star)"
        )
    assert "margin 1" in [text.get_text() for text in drawn.axes[0].texts]
    assert RPM * critical_speed_of(curves) == pytest.approx(3000.0, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("first", [4.05, 4.3, 5.0, 8.0, 3.9, 2.0])
def test_no_curve_runs_through_the_label_of_the_margin(points, first):
    """Whether the first breakdown is far above the shaft voltage of 4 V, a little, or below it."""
    at_case = at_speed(3000.0, 1.8e-10, first, 4.0)
    at_case[1]["bearing"]["ring_to_ring_breakdown"] = first
    no_curve_in_labels(speed_figure(points, SPEED_FIGURE_FILES[1], at_case=at_case))


@pytest.mark.slow
@pytest.mark.parametrize("n", [300, 400])
def test_no_curve_runs_through_a_label_where_the_margin_is_below_one(n):
    """The first breakdown rises towards the shaft voltage on the right of the label."""
    no_curve_in_labels(figure(example_at(n), SPEED_FIGURE_FILES[1]))


def no_curve_in_labels(drawn):
    """No curve passes the label of the margin, and this lies within the axes."""
    drawn.draw_without_rendering()
    (ax,) = drawn.axes
    (label,) = (text for text in ax.texts if text.get_text().startswith("margin"))
    box = Text.get_window_extent(label)
    for curve in ax.get_lines():
        if curve.get_marker() in ("None", "o") and len(curve.get_xdata()) > 2:
            places = ax.transData.transform(curve.get_xydata())
            places = places[np.all(np.isfinite(places), axis=1)]
            x = np.linspace(box.x0, box.x1, 50)
            y = np.interp(x, *places.T, left=np.nan, right=np.nan)
            assert not np.any((y > box.y0) & (y < box.y1)), curve.get_label()
    assert ax.get_window_extent().y0 < box.y0
    assert box.y1 < ax.get_window_extent().y1


@pytest.mark.slow
def test_figures_over_speed_are_saved(points, tmp_path):
    files = save_speed_figures(points, tmp_path, "By hand")
    assert [file.name for file in files] == list(SPEED_FIGURE_FILES)
    without = [at_speed(rpm, 2e-10, None, None) for rpm in (100.0, 1000.0, 10000.0)]
    folder = tmp_path / "without"
    folder.mkdir()
    assert [file.name for file in save_speed_figures(without, folder)] == [SPEED_FIGURE_FILES[0]]


def test_page_and_file_show_the_same_loads_and_films(result):
    """Curves with their colours and values, sectors without load, units and ends of the radius."""
    for draw, panel in (
        (bearing_polar.load_around, load_panel(result)),
        (bearing_polar.film_around, film_panel(result)),
    ):
        ax, plot = draw(result), ring_figure(panel, radial=True)
        lines = [trace for trace in plot["data"] if "fill" not in trace]
        for drawn, trace in zip(ax.get_lines(), lines, strict=True):
            shown = np.array(trace["r"], dtype=float)
            np.testing.assert_allclose(np.asarray(drawn.get_ydata()), shown, rtol=1e-6)
            np.testing.assert_allclose(
                np.degrees(drawn.get_xdata()), np.array(trace["theta"], dtype=float), rtol=1e-6
            )
            assert (trace.get("line") or trace["marker"])["color"] == drawn.get_color()
        sectors = [trace["name"] for trace in plot["data"] if "fill" in trace]
        legend = [text.get_text() for text in ax.get_legend().get_texts()]
        assert [text for text in legend if "gap to" in text] == sectors
        ends = np.array(plot["layout"]["polar"]["radialaxis"]["range"])
        log = plot["layout"]["polar"]["radialaxis"]["type"] == "log"
        assert (10.0**ends if log else ends) == pytest.approx(ax.get_ylim())
        assert ax.get_title().split()[-1] == f"[{panel.unit}]"
