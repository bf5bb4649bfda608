"""Figures of a bearing, of contacts made by hand: what they show, and what they leave out."""

from dataclasses import replace

import numpy as np
import pytest
import tomli_w
from matplotlib.figure import Figure
from typer.testing import CliRunner

from ehlectric.bearing.contacts import ContactCurve
from ehlectric.bearing.preparation import equilibria_of, resolve_bearing
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.bearing.solution import BearingSolution, Position, ring_state
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.commands.app import app
from ehlectric.figures.bearing import circuit as bearing_circuit_plot
from ehlectric.figures.bearing import polar as bearing_polar
from ehlectric.figures.bearing import speeds as bearing_speed_plot
from ehlectric.figures.bearing.save import bearing_figures_of, save_bearing_figures, save_speed_figures
from ehlectric.figures.names import BEARING_FIGURE_FILES, SPEED_FIGURE_FILES
from tests.helpers.bearings import contact_solution
from tests.helpers.titles import title_of

LOADS, CIRCUIT, PITCH, IMPEDANCE = BEARING_FIGURE_FILES

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
    "lubricant": {"base": "paper"},
    "discharge": {"dielectric_strength": "15 V/um", "conductivity": "1 nS/m"},
}

OF_BEARING = (
    bearing_polar.load_around,
    bearing_polar.film_around,
    bearing_circuit_plot.contact_capacitances,
    bearing_circuit_plot.voltage_shares,
    bearing_circuit_plot.breakdown_voltages,
    bearing_circuit_plot.impedance_magnitude,
    bearing_circuit_plot.impedance_phase,
    bearing_circuit_plot.capacitance_over_pitch,
    bearing_circuit_plot.breakdown_over_pitch,
)
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
        ContactCurve(tuple(contact(load, thick, strength) for load in (1.0, 900.0)))
        for thick in (film, 1.2 * film)
    ]
    states = []
    for at in equilibria_of(conditions, positions):
        of_rings = ((at.inner_load, at.inner_gap), (at.outer_load, at.outer_gap))
        both = [
            ring_state(ring, curve, load=load, gap=gap)
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
        "through_breakdown": None if first is None else 1.5 * first,
        "shaft_voltage": shaft,
        "lubrication": lubrication,
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


def line(ax, start):
    """The only line whose label starts so."""
    (found,) = [line for line in ax.get_lines() if line.get_label().startswith(start)]
    return found


@pytest.mark.parametrize("draw", OF_BEARING)
def test_panels_say_their_unit_and_take_the_axes_given(result, draw):
    polar = draw in OF_BEARING[:2]
    ax = Figure().add_subplot(projection="polar" if polar else None)
    assert draw(result, ax) is ax
    text = ax.get_title() if polar else ax.get_ylabel()
    assert text.split()[-1] in {"[N]", "[µm]", "[pF]", "[V]", "[%]", "[Ω]", "[°]"}


@pytest.mark.parametrize("draw", OF_BEARING)
def test_panels_make_axes_of_their_own(result, draw):
    assert draw(result).has_data()


def test_load_points_down_and_elements_without_load_are_hollow(result):
    ax = bearing_polar.load_around(result)
    assert np.sin(ax.get_theta_offset()) == pytest.approx(-1.0)
    at = result.solution.positions[0].equilibrium
    free = at.inner_load == 0.0
    assert 0 < np.sum(free) < 9
    hollow = line(ax, "inner, not loaded")
    np.testing.assert_array_equal(hollow.get_xdata(), at.position[free])
    assert hollow.get_markerfacecolor() == "white"
    loads = line(ax, "outer contact").get_ydata()
    np.testing.assert_array_equal(loads, at.outer_load)
    # The centre of the axes is no load: the circle of no load has a radius, and marks on it are apart.
    assert ax.get_rorigin() < 0.0 == ax.get_rmin()


def test_film_shows_gaps_and_the_lambdas_that_are_near(result):
    ax = bearing_polar.film_around(result)
    inner = result.solution.positions[0].inner
    gaps = line(ax, "inner, not loaded: gap").get_ydata()
    np.testing.assert_allclose(gaps, 1e6 * inner.gap[~inner.solved], rtol=1e-12)
    # 0.2 um is lambda 6.7 of 0.03 um: a circle at lambda 3, 0.09 um, none at 1.
    np.testing.assert_allclose(line(ax, r"$\lambda$ = 3").get_ydata(), 0.09, rtol=1e-12)
    assert not [found for found in ax.get_lines() if found.get_label() == r"$\lambda$ = 1"]


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
    assert line(ax, "first break").get_ydata()[0] == result.breaks()["first_break"]
    assert line(ax, "shaft voltage").get_ydata()[0] == result.shaft_voltage


def test_bars_are_capacitances_and_shares(result):
    circuit = result.solution.circuits("oil")[0]
    heights = [bar.get_height() for bar in bearing_circuit_plot.contact_capacitances(result).patches]
    np.testing.assert_allclose(heights, 1e12 * np.concatenate([circuit.inner, circuit.outer]), rtol=1e-12)
    tops = [bar.get_y() + bar.get_height() for bar in bearing_circuit_plot.voltage_shares(result).patches[9:]]
    np.testing.assert_allclose(tops, 100.0, rtol=1e-12)


def test_a_pitch_ends_as_it_begins(result):
    ax = bearing_circuit_plot.capacitance_over_pitch(result)
    for fill in ("oil", "air"):
        angles, values = line(ax, fill).get_data()
        assert (angles[0], angles[-1]) == (0.0, pytest.approx(40.0))
        assert values[-1] == values[0]
        assert np.mean(values[:-1]) == pytest.approx(1e12 * result.capacitance(fill), rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "figures", "panels"),
    [
        ({}, (LOADS, CIRCUIT, PITCH, IMPEDANCE), (2, 3, 2, 2)),
        ({"motor": None}, (LOADS, CIRCUIT, PITCH, IMPEDANCE), (2, 3, 2, 2)),
        ({"discharge": None}, (LOADS, CIRCUIT, PITCH), (2, 2, 1)),
        ({"film": 0.02e-6}, (LOADS, CIRCUIT, PITCH), (2, 1, 1)),
        ({"bearing": {"element_material": "silicon-nitride"}}, (LOADS,), (2,)),
    ],
)
def test_what_has_no_meaning_is_not_drawn(changes, figures, panels):
    found = bearing_figures_of(by_hand(positions=1, **changes))
    assert tuple(found) == figures
    assert tuple(len(draws) for draws in found.values()) == panels


def test_a_bearing_without_motor_has_no_shaft_voltage():
    ax = bearing_circuit_plot.breakdown_over_pitch(by_hand(positions=1, motor=None))
    assert not [found for found in ax.get_lines() if found.get_label().startswith("shaft")]


def test_figures_are_saved(result, tmp_path):
    files = save_bearing_figures(result, tmp_path)
    assert [file.name for file in files] == list(BEARING_FIGURE_FILES)
    assert sorted(tmp_path.iterdir()) == sorted(files)
    assert all(file.read_bytes().startswith(b"\x89PNG") for file in files)


def test_the_command_draws_unless_told_not_to(result, monkeypatch, tmp_path):
    """And takes the figures of an earlier bearing away."""
    file = tmp_path / "bearing.toml"
    file.write_text(tomli_w.dumps(TABLE), encoding="utf-8")
    monkeypatch.setattr("ehlectric.bearing.files.solve_bearing", lambda *_args, **_kwargs: result)
    drawn = *BEARING_FIGURE_FILES, *SPEED_FIGURE_FILES
    for option, figures in (("--plots", drawn), ("--no-plots", ())):
        done = CliRunner().invoke(app, ["bearing", str(file), "-o", str(tmp_path / "out"), "-q", option])
        assert done.exit_code == 0, done.output
        written = {path.name for path in (tmp_path / "out").iterdir()}
        assert written == {"summary.json", "contacts.csv", "impedance.csv", "bearing.nc", *figures}


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({}, "isothermal film, least λ 6.7: voltages are upper bounds"),
        ({"film": 0.02e-6}, "isothermal film, least λ 0.67: surfaces touch"),
        ({"bearing": {"film_factor": 0.6}}, "film factor 0.6, least λ 6.7"),
        ({"bearing": {"radial_load": 0.0, "axial_load": "500 N"}}, "500 N axial, 3000 rpm, 70 °C"),
    ],
)
def test_titles_say_the_duty_and_what_the_film_is_worth(changes, text, monkeypatch, tmp_path):
    """0.2 um of film at 900 N, about the most loaded ball here, over 0.03 um of roughness."""
    named = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, *_, **__: named.append("\n".join(title_of(figure))))
    save_bearing_figures(by_hand(positions=1, **changes), tmp_path)
    assert named
    plain = text.removesuffix(": voltages are upper bounds")
    assert all(name.startswith("By hand\n") and plain in name for name in named)
    # Circuit and pitch, the second and third figure of four, show voltages of breakdown; the others do not.
    bounds = "upper bounds" in text or "axial" in text
    assert [k for k, name in enumerate(named) if "upper bounds" in name] == ([1, 2] if bounds else [])


def test_radii_are_named_where_no_mark_is():
    """Of an even number of elements one is at 180 degrees, at the top; of nine none is."""
    for elements, away in ((9, 0.0), (8, 22.5)):
        found = by_hand(positions=1, bearing={"elements": elements})
        for draw in OF_BEARING[:2]:
            angles = {np.degrees(text.get_position()[0]) for text in draw(found).texts}
            assert len(angles) == 1
            assert abs(angles.pop() - 180.0) == pytest.approx(away, abs=1e-9)


def test_a_bearings_capacitance_over_its_contacts_is_that_of_the_position_shown(result):
    """Not the mean over a pitch, which the summary has."""
    title = bearing_circuit_plot.contact_capacitances(result).get_title(loc="right")
    here, mean = result.solution.circuits("oil")[0].capacitance, result.capacitance("oil")
    assert f"{1e12 * here:.4g}" != f"{1e12 * mean:.4g}"
    assert title == f"bearing, cage as here: {1e12 * here:.4g} pF, oil fill"


def test_a_bearing_that_did_not_converge_says_so(result, monkeypatch, tmp_path):
    named = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, *_, **__: named.append("\n".join(title_of(figure))))
    curve = result.solution.inner_curve
    failed = replace(curve, solutions=(replace(curve.solutions[0], converged=False), *curve.solutions[1:]))
    save_bearing_figures(BearingResult(replace(result.solution, inner_curve=failed)), tmp_path)
    assert len(named) == 4
    assert all(text.startswith("NOT CONVERGED") for text in named)


@pytest.mark.parametrize("draw", OVER_SPEED)
def test_speeds_are_in_rpm_and_in_order(points, draw):
    ax = draw(points)
    assert "rpm" in ax.get_xlabel()
    for found in ax.get_lines():
        if found.get_transform() is ax.transData or len(found.get_xdata()) == 4:
            np.testing.assert_allclose(found.get_xdata(), [500.0, 1000.0, 3000.0, 6000.0], rtol=1e-12)


def test_capacitance_over_speed_has_its_bounds(points):
    ax = bearing_speed_plot.capacitance_over_speed(points)
    np.testing.assert_allclose(
        line(ax, "capacitance of the bearing, oil").get_ydata(), [600.0, 400.0, 230.0, 160.0]
    )
    (band,) = ax.collections
    up = band.get_paths()[0].vertices[:, 1]
    heights = up.min(), up.max()
    np.testing.assert_allclose(heights, [0.9 * 160.0, 600.0])


def test_breakdown_over_speed_shades_where_the_shaft_has_more(points):
    ax = bearing_speed_plot.breakdown_over_speed(points)
    np.testing.assert_array_equal(line(ax, "first").get_ydata(), [np.nan, 2.5, 5.6, 9.0])
    (band,) = ax.collections
    # Shaft 3.7 to 4.0 V and first break 2.5 to 5.6 V meet at (3.7 - 2.5)/(3.1 - 0.3) of 2000 rpm.
    across = band.get_paths()[0].vertices[:, 0]
    ends = across.min(), across.max()
    np.testing.assert_allclose(ends, [1000.0, 1000.0 + 2000.0 * 1.2 / 2.8])
    assert list(line(ax, r"$\lambda$ < 1").get_xdata()) == pytest.approx([500.0])
    assert list(line(ax, r"$\lambda$ from 1 to 3").get_xdata()) == pytest.approx([1000.0])


@pytest.mark.parametrize(
    ("draw", "heights"),
    [(OVER_SPEED[0], [180.0]), (OVER_SPEED[1], [9.0, 8.0])],
    ids=["capacitance", "breaks"],
)
def test_a_bearing_by_itself_is_marked_on_the_axes_of_the_others(points, draw, heights):
    own = at_speed(2000.0, 1.8e-10, 8.0, 5.0)
    own[1]["bearing"] |= {"through_breakdown": 9.0, "contacts": "solved"}
    plain, ax = draw(points), draw(points, own=own)
    star = line(ax, "at its own speed, contacts solved")
    np.testing.assert_allclose(star.get_xdata(), 2000.0, rtol=1e-12)
    np.testing.assert_allclose(star.get_ydata(), heights, rtol=1e-12)
    assert ax.get_yscale() == plain.get_yscale() == "linear"
    assert ax.get_ylim() == plain.get_ylim()


def test_figures_over_speed_are_saved(points, tmp_path):
    files = save_speed_figures(points, tmp_path, "By hand")
    assert [file.name for file in files] == list(SPEED_FIGURE_FILES)
    without = [at_speed(rpm, 2e-10, None, None) for rpm in (100.0, 1000.0, 10000.0)]
    folder = tmp_path / "without"
    folder.mkdir()
    assert [file.name for file in save_speed_figures(without, folder)] == [SPEED_FIGURE_FILES[0]]
