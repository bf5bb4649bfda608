"""Figures of sweeps: what they show where points failed, where the film breaks down, and their units."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.collections import PathCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.tri import TriContourSet

from ehlectric import InputError
from ehlectric.figures.style import levels_of, round_numbers, style
from ehlectric.figures.sweep_figures import (
    distribution,
    figure,
    parts,
    save_maps,
    save_sensitivity,
    sensitivity_figure,
)
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import value_map
from ehlectric.figures.sweep_panels import LESS_ACCURATE
from ehlectric.quantities.result_warnings import CODES, ResultWarning, texts_and_codes
from ehlectric.sweep.points import Range
from ehlectric.sweep.sensitivity_indices import sensitivity
from tests.helpers.each import each
from tests.helpers.sweep_models import LOAD, POTENTIAL, SPEED, breakdown, doubtful_where, grid, paired, sobol
from tests.helpers.titles import title_of

VALUE = "discharge.breakdown_voltage"
SPEEDS, LOADS = (0.5, 1.0, 2.0, 4.0, 8.0), (2e5, 5e5, 1e6, 2e6)


def two(inputs):
    """A point that failed and one that did not converge."""
    return {(1.0, 5e5): "failed", (4.0, 1e6): "not converged"}.get((inputs[SPEED], inputs[LOAD]), "solved")


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def marks(ax, marker):
    """Positions of all marks of a shape."""
    found = [line.get_xydata() for line in ax.lines if line.get_marker() == marker]
    return np.concatenate(found) if found else np.empty((0, 2))


def line_of_breakdown(ax):
    """Vertices of the line at which the margin is 1."""
    (line,) = [c for c in ax.collections if isinstance(c, TriContourSet) and c.get_linewidths()[0] == 1.8]
    return np.concatenate([path.vertices for path in line.get_paths()])


def test_map_has_units_and_marks_every_point():
    ax = Figure().subplots()
    assert value_map(grid({SPEED: SPEEDS, LOAD: LOADS}, status=two), SPEED, LOAD, VALUE, ax=ax) is ax
    assert ax.get_xlabel() == "entrainment speed $(u_1 + u_2)/2$ [m/s]"
    assert ax.get_ylabel() == "load per length $w$ [MN/m]"
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    (bar,) = ax.child_axes
    assert bar.get_ylabel() == r"breakdown voltage $V_\mathrm{b}$ [V]"
    assert legend(ax)[:3] == ["18 points", "1 not converged", "1 failed"]
    assert marks(ax, "o").shape == (18, 2)
    np.testing.assert_allclose(marks(ax, "x"), [[1.0, 0.5]])
    np.testing.assert_allclose(marks(ax, "+"), [[4.0, 1.0]])


def filled(ax, x, y):
    """Whether some colour lies over a place, in the units of the axes."""
    return any(
        path.contains_point((x, y))
        for colours in ax.collections
        if isinstance(colours, TriContourSet) and colours.filled
        for path in colours.get_paths()
    )


def test_map_has_a_hole_around_what_is_not_solved():
    ax = value_map(grid({SPEED: SPEEDS, LOAD: LOADS}, status=two), SPEED, LOAD, VALUE)
    for x, y in ((1.0, 0.5), (0.6, 0.3), (1.9, 0.9), (4.0, 1.0), (7.0, 1.8), (3.0, 0.6)):
        assert not filled(ax, x, y)
    for x, y in ((0.7, 1.5), (3.0, 0.3), (7.0, 0.4)):
        assert filled(ax, x, y)


@pytest.mark.slow
def test_a_film_that_is_not_to_be_used_is_a_hole_with_its_mark():
    """As one that failed, but for its mark: no number of it is in the colours, the line or the curves."""

    def wrong(inputs):
        return (inputs[SPEED], inputs[LOAD]) == (1.0, 5e5)

    results = grid({SPEED: SPEEDS, LOAD: LOADS}, doubtful_where(wrong))
    ax = value_map(results, SPEED, LOAD, VALUE)
    assert legend(ax)[:2] == ["19 points", "1 must not be used"]
    np.testing.assert_allclose(marks(ax, "D"), [[1.0, 0.5]])
    assert not filled(ax, 1.0, 0.5)
    assert not filled(ax, 1.9, 0.9)
    assert filled(ax, 3.0, 0.6)
    lines = value_lines(results, SPEED, LOAD, VALUE)
    (mark,) = [line for line in lines.lines if line.get_marker() == "D"]
    assert list(mark.get_xdata()) == [1.0]
    assert [np.isnan(at_points(line.get_ydata())[1]) for line in curves(lines)] == [False, True, False, False]


def test_where_no_film_is_to_be_used_there_is_nothing_to_draw():
    results = grid({SPEED: SPEEDS}, doubtful_where(lambda _: True))
    with pytest.raises(InputError, match=r" 5 .* 5 "):
        value_lines(results, SPEED, None, VALUE)


def test_map_is_drawn_up_to_its_largest_value():
    """A probability of 1 has a colour as any other."""
    ax = value_map(grid({SPEED: SPEEDS, LOAD: LOADS}), SPEED, LOAD, "discharge.probability")
    assert filled(ax, 0.6, 0.3)
    assert filled(ax, 7.0, 0.3)


@pytest.mark.slow
def test_line_of_breakdown_is_where_it_is():
    """10 V (u/(4 m/s))^0.7 (w/(1 MN/m))^-0.1 is 5 V at u = 4 (0.5 (w/(1 MN/m))^0.1)^(1/0.7) m/s.

    Both axes are logarithmic, on which the logarithm of the model is linear, few points or many.
    """
    wide, few = np.geomspace(0.05, 8.0, 5), np.geomspace(0.5, 8.0, 3)
    values = (VALUE, "discharge.margin", "discharge.probability", "discharge.contact_energy")
    for value, speeds in ((value, speeds) for value in values for speeds in (wide, few)):
        ax = value_map(grid({SPEED: list(speeds), LOAD: LOADS}), SPEED, LOAD, value)
        x, y = line_of_breakdown(ax).T
        np.testing.assert_allclose(x, 4.0 * (0.5 * y**0.1) ** (1.0 / 0.7), rtol=2e-3)
        assert (y.min(), y.max()) == pytest.approx((0.2, 2.0))
        assert legend(ax)[1:] == ["margin 1 at 5 V", "below applied voltage"]
        assert "margin 1" in [text.get_text() for text in ax.texts]


def test_voltage_of_every_point_counts():
    """Where the voltage varies, V = V_2 + 1 V, so does the line: V_b(u) = V; for V_2 = 1 V, u is 0.4 m/s."""
    speeds = list(np.geomspace(0.5, 8.0, 60))
    ax = value_map(grid({SPEED: speeds, POTENTIAL: (1.0, 2.0, 4.0, 8.0)}), SPEED, POTENTIAL, VALUE)
    assert "margin 1 at 2 to 9 V" in legend(ax)
    on_nodes = [
        (x, y) for x, y in line_of_breakdown(ax) if any(abs(y - v) < 1e-9 for v in (1.0, 2.0, 4.0, 8.0))
    ]
    assert len(on_nodes) == 3
    for x, y in on_nodes:
        assert 10.0 * (x / 4.0) ** 0.7 == pytest.approx(y + 1.0, rel=1e-3)


@pytest.mark.parametrize(
    ("potential", "text"),
    [
        (0.01, "breakdown voltage above applied voltage 1.01 V"),
        (99.0, "breakdown voltage below applied voltage 100 V"),
    ],
)
def test_map_without_the_line_says_on_which_side_it_is(potential, text):
    results = grid({SPEED: SPEEDS, LOAD: LOADS, POTENTIAL: (potential,)})
    assert legend(value_map(results, SPEED, LOAD, VALUE))[-1] == text


@pytest.mark.slow
def test_film_has_no_line_of_breakdown():
    ax = value_map(grid({SPEED: SPEEDS, LOAD: LOADS}), SPEED, LOAD, "film.minimum_thickness")
    assert legend(ax) == ["20 points"]
    assert ax.child_axes[0].get_ylabel() == r"minimum film thickness $h_\mathrm{min}$ [µm]"


def test_wide_values_have_logarithmic_colours():
    """The speeds differ by a factor of 16."""

    def model(inputs):
        return {"film": {"minimum_thickness": inputs[SPEED], "central_thickness": inputs[SPEED] ** 2}}

    results = grid({SPEED: SPEEDS, LOAD: LOADS}, model)
    for name, wide in (("minimum", False), ("central", True)):
        ax = value_map(results, SPEED, LOAD, f"film.{name}_thickness")
        assert isinstance(ax.collections[0].norm, LogNorm) is wide
        lines = value_lines(results, SPEED, LOAD, f"film.{name}_thickness")
        assert (lines.get_yscale() == "log") is wide


def test_points_of_a_design_that_holds_nothing_are_coloured_by_themselves():
    span = {SPEED: Range(0.5, 8.0, "log"), LOAD: Range(2e5, 2e6, "log"), POTENTIAL: Range(1.0, 8.0)}
    results = sobol(span, 8, breakdown, status=lambda i: "failed" if i[SPEED] < 1.0 else "solved")
    ax = value_map(results, SPEED, LOAD, VALUE)
    scattered = [c for c in ax.collections if isinstance(c, PathCollection)]
    shown = np.sort(np.concatenate([c.get_array() for c in scattered]))
    values = results.values(VALUE)
    np.testing.assert_allclose(shown, np.sort(values[np.isfinite(values)]))
    assert not any(isinstance(c, TriContourSet) for c in ax.collections)
    assert len(marks(ax, "x")) == 40 - shown.size > 0


def test_scattered_points_of_two_keys_are_a_map():
    """Both axes are logarithmic, on which the logarithm of the model is linear."""
    loads = np.random.default_rng(2).permutation(np.geomspace(2e5, 2e6, 60))
    axes = {SPEED: list(np.geomspace(0.05, 8.0, 60)), LOAD: list(loads)}
    ax = value_map(paired(axes), SPEED, LOAD, VALUE)
    assert filled(ax, 4.0, 1.0)
    x, y = line_of_breakdown(ax).T
    np.testing.assert_allclose(10.0 * (x / 4.0) ** 0.7 * y**-0.1, 5.0, rtol=5e-3)


def curves(ax, style="-"):
    """Lines through the points and what lies between them."""
    return [
        line for line in ax.lines if line.get_linestyle() == style and len(line.get_xdata()) > len(SPEEDS)
    ]


def at_points(values):
    """Of a line over the speeds, its values there."""
    return values[:: (len(values) - 1) // (len(SPEEDS) - 1)]


def test_lines_end_where_points_are_not_solved():
    ax = Figure().subplots()
    results = grid({SPEED: SPEEDS, LOAD: LOADS}, status=two)
    assert value_lines(results, SPEED, LOAD, VALUE, ax=ax) is ax
    assert (ax.get_xlabel(), ax.get_ylabel()) == (
        "entrainment speed $(u_1 + u_2)/2$ [m/s]",
        r"breakdown voltage $V_\mathrm{b}$ [V]",
    )
    drawn = curves(ax)
    assert len(drawn) == len(LOADS)
    for load, line in zip(LOADS, drawn, strict=True):
        expected = [
            10.0 * (u / 4.0) ** 0.7 * (load / 1e6) ** -0.1
            if two({SPEED: u, LOAD: load}) == "solved"
            else np.nan
            for u in SPEEDS
        ]
        np.testing.assert_allclose(at_points(line.get_xdata()), SPEEDS, rtol=1e-12)
        np.testing.assert_allclose(at_points(line.get_ydata()), expected, rtol=1e-12)
    # Their crosses stand in the strip below the values, in the colours of their lines.
    (cross,) = [line for line in ax.lines if line.get_marker() == "x"]
    (plus,) = [line for line in ax.lines if line.get_marker() == "+"]
    for sign, speed, row in ((cross, 1.0, 1), (plus, 4.0, 2)):
        assert sign.get_xdata() == [speed]
        assert sign.get_color() == drawn[row].get_color()
        bottom, top = ax.get_ylim()
        assert bottom + (top - bottom) * sign.get_ydata()[0] < 0.0
    assert ax.get_yticklabels()[0].get_text() == "no value"
    assert legend(ax) == [
        *("18 points", "1 not converged", "1 failed"),
        *("applied voltage 5 V", "below applied voltage"),
    ]


def test_applied_voltage_is_a_level_or_a_line_for_each():
    (level,) = [
        line for line in value_lines(grid({SPEED: SPEEDS}), SPEED, None, VALUE).lines if line.get_ls() == "--"
    ]
    assert list(level.get_ydata()) == [5.0, 5.0]
    margin = value_lines(grid({SPEED: SPEEDS}), SPEED, None, "discharge.margin")
    assert [list(line.get_ydata()) for line in margin.lines if line.get_ls() == "--"] == [[1.0, 1.0]]
    ax = value_lines(grid({SPEED: SPEEDS, POTENTIAL: (1.0, 4.0)}), SPEED, POTENTIAL, VALUE)
    dashed = [at_points(line.get_ydata()) for line in curves(ax, "--")]
    np.testing.assert_allclose(dashed, [[2.0] * 5, [5.0] * 5])
    assert legend(ax)[-1] == "applied voltage 2 to 5 V"
    margin = value_lines(grid({POTENTIAL: (1.0, 2.0, 4.0)}), POTENTIAL, None, "discharge.margin")
    assert legend(margin)[1:] == ["margin 1 at 2 to 5 V", "below applied voltage"]
    chance = value_lines(grid({SPEED: SPEEDS}), SPEED, None, "discharge.probability")
    assert legend(chance) == ["5 points at the applied voltage 5 V"]


def test_points_without_lines_have_no_line_of_voltage_either():
    """Their voltages, V_2 + 1 V, are between 2 and 9 V: a band."""
    span = {SPEED: Range(0.5, 8.0, "log"), LOAD: Range(2e5, 2e6, "log"), POTENTIAL: Range(1.0, 8.0)}
    results = sobol(span, 16, breakdown)
    ax = value_lines(results, SPEED, LOAD, VALUE)
    assert not [line for line in ax.lines if line.get_ls() == "--"]
    (band,) = [found for found in ax.collections if str(found.get_label()).startswith("applied voltage")]
    volts = results.values("field.voltage")
    heights = band.get_paths()[0].vertices[:, 1]
    assert (heights.min(), heights.max()) == pytest.approx((volts.min(), volts.max()))


def test_lines_are_named_or_have_a_colour_bar():
    few = value_lines(grid({SPEED: SPEEDS, LOAD: LOADS}), SPEED, LOAD, VALUE)
    (named,) = [child for child in few.artists if hasattr(child, "get_title")]
    assert named.get_title().get_text() == "load per length\n$w$ [MN/m]"
    assert [text.get_text() for text in named.get_texts()] == ["2", "1", "0.5", "0.2"]
    many = value_lines(grid({SPEED: SPEEDS, LOAD: list(np.geomspace(2e5, 2e6, 12))}), SPEED, LOAD, VALUE)
    assert many.child_axes[0].get_ylabel() == "load per length $w$ [MN/m]"
    oils = value_lines(grid({SPEED: SPEEDS, "lubricant.base": ("b", "a")}), SPEED, "lubricant.base", VALUE)
    (named,) = [child for child in oils.artists if hasattr(child, "get_title")]
    assert [text.get_text() for text in named.get_texts()] == ["b", "a"]


@each("low, high", [(0.2, 2.0), (1.0, 8.0), (0.3, 1.85), (1e-3, 1e4), (0.20, 0.26)])
def test_ticks_are_round_and_enough(low, high):
    ticks = round_numbers(low, high)
    inside = ticks[(ticks >= low) & (ticks <= high)]
    assert 3 <= inside.size <= 12
    assert all(len(f"{tick:g}".replace("0.", "").strip("0")) <= 3 for tick in ticks)


@each("values", [[3.0, 9.5], [-2e-9, 7e-9], [5.0, 5.0], [0.0, 0.0], [1e-3, 40.0]])
def test_levels_hold_all_values(values):
    log = values[0] > 0.0 and values[1] > 20.0 * values[0]
    levels = levels_of(np.array([*values, np.nan]), log=log)
    assert levels[0] <= values[0] <= values[1] <= levels[-1]
    assert np.all(np.diff(levels) > 0.0)
    assert levels.size <= 30
    if values[0] < values[1]:
        assert levels[1] > values[0]
        assert levels[-2] < values[1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("y", "names"),
    [
        (LOAD, {f"map_{VALUE}.png", f"lines_{VALUE}.png"}),
        (None, {f"lines_{VALUE}.png"}),
        ("lubricant.base", {f"lines_{VALUE}.png"}),
    ],
)
def test_maps_are_saved(tmp_path, y, names):
    axes = {SPEED: SPEEDS} | ({y: LOADS if y == LOAD else ("paper", "gear")} if y else {})
    files = save_maps(
        grid(axes, status=lambda i: "solved" if i[SPEED] > 0.5 else "open"), SPEED, y, VALUE, tmp_path
    )
    assert {path.name for path in files} == names == {path.name for path in tmp_path.iterdir()}
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in files)


@pytest.mark.slow
@pytest.mark.parametrize(
    "status",
    [
        lambda i: "solved" if (i[SPEED], i[LOAD]) == (1.0, 5e5) else "failed",
        lambda i: "failed" if i[SPEED] == 1.0 else "solved",
    ],
)
def test_few_solved_points_are_shown_all_the_same(tmp_path, status):
    results = grid({SPEED: (0.5, 1.0, 2.0), LOAD: (2e5, 5e5, 1e6)}, status=status)
    ax = value_map(results, SPEED, LOAD, VALUE)
    values = results.values(VALUE)
    alone = [c for c in ax.collections if isinstance(c, PathCollection)]
    shown = np.sort(np.concatenate([c.get_array() for c in alone]))
    np.testing.assert_allclose(shown, np.sort(values[np.isfinite(values)]))
    # One point of 3.8 V or six of 2.5 to 7.2 V, at 5 V: those below have a mark of their own, and it is said.
    low = values < 5.0
    told = [text for text in legend(ax) if "below applied voltage 5 V" in text]
    assert (len(told), sum(len(c.get_array()) for c in alone[1:])) == (1, np.sum(low))
    assert len(save_maps(results, SPEED, LOAD, VALUE, tmp_path)) == 2


def test_figures_refuse_what_they_cannot_draw():
    with pytest.raises(InputError, match="numbers"):
        value_map(grid({SPEED: SPEEDS, "lubricant.base": ("a", "b")}), SPEED, "lubricant.base", VALUE)
    with pytest.raises(InputError, match=" 5 "):
        value_lines(grid({SPEED: SPEEDS}, status=lambda _: "failed"), SPEED, None, VALUE)


@pytest.fixture(scope="module")
def uncertain():
    span = {SPEED: Range(0.5, 8.0, "log"), LOAD: Range(2e5, 2e6, "log")}
    results = sobol(span, 64, breakdown, status=lambda i: "failed" if i[SPEED] > 7.0 else "solved")
    return results, sensitivity(results, VALUE)


def test_distribution_has_its_quantiles_and_the_voltage(uncertain):
    results, found = uncertain
    ax = distribution(results, found)
    curve = ax.lines[0]
    assert curve.get_ydata()[-1] == 1.0
    assert len(curve.get_xdata()) == found.spread.samples < 128
    (dots,) = [line for line in ax.lines if line.get_marker() == "o"]
    np.testing.assert_allclose(dots.get_xydata(), [[found.spread.quantiles[q], q] for q in (0.05, 0.5, 0.95)])
    (voltage,) = [line for line in ax.lines if line.get_ls() == "--"]
    assert list(voltage.get_xdata()) == [5.0, 5.0]
    # The samples that failed are below the voltage or not.
    below, failed = np.sum(curve.get_xdata() < 5.0), 128 - found.spread.samples
    low, high = (100.0 * count / 128 for count in (below, below + failed))
    assert legend(ax)[1] == "applied voltage 5 V"
    drawn = sensitivity_figure(results, found)
    most = max(found.indices, key=lambda index: index.total)
    assert title_of(drawn)[0] == (
        f"Entrainment speed has {100 * most.total:.0f} % of the variance; "
        f"{low:.3g} to {high:.3g} % of the samples are below the applied voltage"
    )


def test_bars_are_the_indices_with_their_intervals(uncertain):
    results, found = uncertain
    ax = parts(results, found)
    assert [label.get_text() for label in ax.get_yticklabels()] == ["load per length", "entrainment speed"]
    widths = sorted(bar.get_width() for bar in ax.patches)
    assert widths == sorted([i.total for i in found.indices] + [i.first_order for i in found.indices])
    ends = [np.sort(path.vertices[:, 0]) for c in ax.collections for path in c.get_paths()]
    wanted = [i.total_interval for i in found.indices] + [i.first_order_interval for i in found.indices]
    np.testing.assert_allclose(sorted(map(tuple, ends)), sorted(wanted), rtol=1e-9)


@pytest.mark.slow
def test_sensitivity_is_saved(tmp_path, uncertain):
    save_sensitivity(*uncertain, tmp_path / "sensitivity.png")
    assert (tmp_path / "sensitivity.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_line_of_breakdown_is_a_level_of_the_colours():
    """At one applied voltage: 6 V is a level here, and its line is where the margin is 1."""
    ax = value_map(grid({SPEED: SPEEDS, LOAD: LOADS, POTENTIAL: (5.0,)}), SPEED, LOAD, VALUE)
    (levels,) = [
        c for c in ax.collections if isinstance(c, TriContourSet) and not c.filled and len(c.levels) > 1
    ]
    (path,) = [p for p, level in zip(levels.get_paths(), levels.levels, strict=True) if level == 6.0]
    line = line_of_breakdown(ax)
    np.testing.assert_allclose(
        path.vertices[np.argsort(path.vertices[:, 1])], line[np.argsort(line[:, 1])], rtol=1e-9
    )


def test_points_whose_numbers_are_less_accurate_are_ringed():
    """A warning of all points tells none apart; one of an expected breakdown is no doubt about a number."""

    def warned(inputs):
        codes = ["law-range", "breakdown-expected", "regime"][: 1 if inputs[SPEED] < 3.0 else 3]
        codes += ["inlet-too-short"] if inputs[SPEED] == 8.0 else []
        return texts_and_codes([ResultWarning(code, code) for code in codes]) | breakdown(inputs)

    results = grid({SPEED: SPEEDS, LOAD: LOADS}, warned)
    for draw in (value_map, value_lines):
        ax = draw(results, SPEED, LOAD, VALUE)
        (rings,) = [line for line in ax.lines if line.get_markersize() == 6.5]
        assert set(rings.get_xdata()) == {8.0}
        # An edge of white would hide the curves around a ring.
        assert not rings.get_path_effects()
        assert "4 less accurate" in legend(ax)
        assert "20 points" in legend(ax)
    plain = value_map(grid({SPEED: SPEEDS, LOAD: LOADS}), SPEED, LOAD, VALUE)
    assert not [text for text in legend(plain) if "accurate" in text]


def test_codes_of_less_accurate_points_are_warnings_of_contacts():
    """Severe ones make a point a diamond, and notes and the codes of a whole sweep tell no point apart."""
    assert {CODES[code].severity for code in LESS_ACCURATE} == {"warning"}
    assert not {"breakdown-expected", "regime", "isothermal-film", "points-with-warnings"} & LESS_ACCURATE


def test_lines_of_a_map_have_their_values_in_free_places():
    ax = value_map(grid({SPEED: SPEEDS, LOAD: LOADS}), SPEED, LOAD, VALUE)
    points = ax.transData.transform([(u, w / 1e6) for u in SPEEDS for w in LOADS])
    labels = {text.get_text(): ax.transData.transform(text.get_position()) for text in ax.texts}
    lines = line_of_breakdown(ax)
    margin = labels.pop("margin 1")
    assert np.min(np.hypot(*(ax.transData.transform(lines) - margin).T)) < 2.0
    assert len(labels) > 3
    for text, at in (labels | {"margin 1": margin}).items():
        assert np.min(np.hypot(*(points - at).T)) > 10.0, text
        assert all(np.hypot(*(at - other)) > 10.0 for other in labels.values() if other is not at)
    # 10 V (u/(4 m/s))^0.7 (w/(1 MN/m))^-0.1 at the place of a label is its value.
    for text, at in labels.items():
        u, w = ax.transData.inverted().transform(at)
        assert 10.0 * (u / 4.0) ** 0.7 * w**-0.1 == pytest.approx(float(text), rel=0.01)


def test_the_colour_bar_of_a_journal_is_beside_its_map():
    """Though the legend above the map is wider than the map; and it has at most three lines."""

    def warned(inputs):
        codes = ["inlet-too-short"] if inputs[SPEED] == 8.0 else []
        return texts_and_codes([ResultWarning(code, code) for code in codes]) | breakdown(inputs)

    with style("journal"):
        name = f"map_{VALUE}.png"
        results = grid({SPEED: SPEEDS, LOAD: LOADS}, warned)
        drawn = figure(results, name, x=SPEED, y=LOAD)
        drawn.draw_without_rendering()
    (ax,) = drawn.axes
    (bar,) = ax.child_axes
    frame, beside = ax.get_window_extent(), bar.get_window_extent()
    assert 0.0 < beside.x0 - frame.x1 < 0.05 * frame.width
    entries = ax.get_legend()
    assert legend(ax) == ["20 points", "margin 1 at 5 V", "below applied voltage", "4 less accurate"]
    assert entries.get_window_extent().height < 4.0 * entries.get_texts()[0].get_window_extent().height
    for handle in entries.legend_handles:
        assert handle.get_visible()
        assert isinstance(handle, Patch) or handle.get_marker() != "None" or handle.get_linestyle() != "None"


@pytest.mark.slow
def test_titles_say_where_breakdown_is_expected():
    """The margin is 1 at u = 4 (0.5 (w/(1 MN/m))^0.1)^(1/0.7) m/s."""
    results = grid({SPEED: SPEEDS, LOAD: LOADS})
    ends = [4.0 * (0.5 * load**0.1) ** (1.0 / 0.7) for load in (0.2, 2.0)]
    text = f"Breakdown expected below {ends[0]:.3g} to {ends[1]:.3g} m/s, depending on load per length"
    for name in (f"map_{VALUE}.png", f"lines_{VALUE}.png", "lines_discharge.margin.png"):
        title = " ".join(title_of(figure(results, name, x=SPEED, y=LOAD)))
        assert title.startswith(f"{text} (applied voltage 5 V)")
    one = figure(grid({SPEED: SPEEDS}), f"lines_{VALUE}.png", x=SPEED)
    assert (
        title_of(one)[0] == f"Breakdown expected below {4.0 * 0.5 ** (1 / 0.7):.3g} m/s (applied voltage 5 V)"
    )
    fast = figure(grid({SPEED: (4.0, 8.0)}), f"lines_{VALUE}.png", x=SPEED)
    assert (
        title_of(fast)[0]
        == "No breakdown expected at all 2 points: minimum margin 2.00 (applied voltage 5 V)"
    )
    slow = figure(grid({SPEED: (0.5, 1.0)}), f"lines_{VALUE}.png", x=SPEED)
    margin = 2.0 * (1.0 / 4.0) ** 0.7
    text = f"Breakdown expected at all 2 points: maximum margin {margin:.2f} "
    assert title_of(slow)[0].startswith(text)
    film = figure(grid({SPEED: (4.0, 8.0)}), "lines_film.minimum_thickness.png", x=SPEED)
    thick = 10.0 / 15.0 * 2.0**0.7
    assert title_of(film)[0] == f"Minimum film thickness: {10 / 15:.3g} to {thick:.3g} µm"


@pytest.mark.slow
def test_lines_of_few_points_are_thin_and_their_points_stand_out():
    for speeds, few in ((SPEEDS, True), (tuple(np.geomspace(0.5, 8.0, 12)), False)):
        ax = value_lines(grid({SPEED: speeds}), SPEED, None, VALUE)
        (curve,) = [line for line in ax.lines if line.get_ls() == "-" and len(line.get_xdata()) > len(speeds)]
        (dots,) = [line for line in ax.lines if line.get_marker() == "o" and len(line.get_xdata()) > 1]
        assert (curve.get_linewidth() < 1.0) is few
        assert (dots.get_markersize() > 4.0) is few


def test_values_on_both_sides_of_zero_have_white_at_zero():
    def model(inputs):
        return {"film": {"minimum_thickness": inputs[SPEED] - 2.0}}

    ax = value_map(grid({SPEED: SPEEDS, LOAD: LOADS}, model), SPEED, LOAD, "film.minimum_thickness")
    colours = ax.collections[0]
    assert colours.get_cmap().name == "RdBu_r"
    assert colours.norm.vmin == -colours.norm.vmax
    np.testing.assert_allclose(colours.get_cmap()(colours.norm(0.0))[:3], 0.97, atol=0.02)


def test_an_index_of_nothing_has_no_interval(uncertain):
    results, found = uncertain
    tiny = [
        replace(
            i, total=0.001, first_order=-0.01, total_interval=(0.0, 0.002), first_order_interval=(-0.04, 0.02)
        )
        if i.key == LOAD
        else i
        for i in found.indices
    ]
    ax = parts(results, replace(found, indices=tuple(tiny)))
    assert [text.get_text() for text in ax.texts] == ["0", "0"]
    assert sum(len(c.get_paths()) for c in ax.collections) == 2
