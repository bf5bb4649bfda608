"""Titles of figures of contacts: their numbers are those of the summary; and the lines that decide."""

import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.text import Text

from ehlectric import Case, solve
from ehlectric.figures.contact_curves import breakdown, breakdown_voltages, limit_line, probability
from ehlectric.figures.contact_figure_files import drawings_of, figure
from ehlectric.figures.contact_findings import finding, has_spike, per_cent, place_text
from ehlectric.figures.line_figures import field_deviation, field_profiles, field_strength, film, roughness
from ehlectric.figures.point_figures import field_cut, field_sections
from ehlectric.figures.style import axes_or_new, length_axis
from ehlectric.quantities.palette import LIGHT_GREY, OUT_OF_RANGE
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each
from tests.helpers.point_pages import result_of, solved

OIL = {"base": "paper"}
STRENGTH = {"dielectric_strength": "15 V/um"}
WEIBULL = {"weibull": {"scale": "15 V/um", "shape": 10, "reference_area": "1 mm^2"}, "length": "10 mm"}
ROUGH = {"surface": 1, "generator": "gaussian", "rq": "20 nm", "correlation_length": "40 um", "seed": 1}


def line_case(volts=2.0, **tables):
    electric = {"potential_1": 0.0, "potential_2": volts}
    table = {"contact": PAPER_CONTACT, "lubricant": OIL, "grid": {"nodes": 401}, "electric": electric}
    return solve(Case.from_dict(table | tables))


@pytest.fixture(scope="module")
def below():
    return line_case(8.0, discharge=STRENGTH)


@pytest.fixture(scope="module")
def above():
    return line_case(20.0, discharge=STRENGTH)


@pytest.fixture(scope="module")
def rough():
    return line_case(roughness=[ROUGH | {"truncate": "30 nm"}])


def numbers(text):
    return [float(found.replace("−", "-")) for found in re.findall(r"[−]?\d+\.?\d*(?:e[+-]\d+)?", text)]


def test_the_film_is_that_of_the_summary(below):
    summary = below.summary()
    least, x, central = numbers(finding(below, "film.png"))
    assert least == pytest.approx(1e6 * summary["film"]["minimum_thickness"], rel=6e-3)
    assert central == pytest.approx(1e6 * below.film.central_thickness, rel=6e-3)
    assert x == pytest.approx(below.film.minimum_position / below.conditions.half_width, rel=6e-3)


def test_a_rough_film_is_compared_with_the_smooth_one(rough):
    text = finding(rough, "film.png")
    change = rough.film.minimum_thickness / rough.smooth.minimum_thickness - 1.0
    assert text.endswith("thinner than smooth") == (change < 0.0)
    assert numbers(text)[-1] == pytest.approx(100.0 * abs(change), rel=0.06)


def test_the_field_is_that_of_the_summary(below):
    """And the place of the maximum of a smooth contact is its constriction."""
    field = below.summary()["field"]
    text = finding(below, "field_strength.png")
    assert numbers(text)[0] == pytest.approx(1e-6 * field["max_strength"], rel=6e-3)
    assert "at the constriction (x/b = " in text
    strongest, used, limit, apart = numbers(finding(below, "field_profiles.png"))
    assert strongest == numbers(text)[0]
    assert limit == 15.0
    assert used == pytest.approx(100.0 * field["max_strength"] / 15e6, abs=0.6)
    sections = np.stack(
        [below.field.strength[:, 0], below.field.middle_strength, below.field.strength[:, -1]]
    )
    spread = (np.ptp(sections, axis=0) / sections.max(axis=0))[below.field.inner].max()
    assert apart == pytest.approx((1e3 if spread < 1e-3 else 1e2) * spread, rel=0.06)


@each("volts", [7.0, 8.0, 9.55, 10.0, 20.0])
def test_breakdown_is_said_as_by_the_verdict(volts):
    """At 9.55 V the margin is hardly above 1: the title must not read as safer than the verdict."""
    result = line_case(volts, discharge=STRENGTH)
    discharge = result.summary()["discharge"]
    text = finding(result, "breakdown.png")
    applied, breaking, _, margin, strength = numbers(text)
    assert text.partition(" at ")[0] == result.verdict.text.partition(":")[0]
    assert text.startswith("No breakdown expected at ") == (volts == 7.0)
    assert applied == result.field.voltage
    assert breaking == pytest.approx(discharge["breakdown_voltage"], rel=6e-3)
    assert margin == pytest.approx(discharge["margin"], rel=1.2e-2)
    assert strength == pytest.approx(15.0)


def test_local_breakdown_voltages_are_of_a_uniform_gap(below):
    """Breakdown voltage of a gap by hand, strength times film, where the gap hardly changes."""
    film, field = below.film, below.field
    at = np.abs(field.x) < 0.5 * below.conditions.half_width
    by_hand = 15e6 * np.interp(field.x[at], film.x, film.thickness)
    np.testing.assert_allclose(breakdown_voltages(below)[at], by_hand, rtol=2e-3)
    assert breakdown_voltages(below).min() == pytest.approx(below.discharge.breakdown_voltage)


@pytest.mark.parametrize("name", ["below", "above"])
def test_what_breaks_down_is_shaded(name, request):
    result = request.getfixturevalue(name)
    ax = breakdown(result)
    voltage = next(line for line in ax.lines if line.get_label().startswith("applied"))
    assert set(voltage.get_ydata()) == {result.field.voltage}
    assert [area.get_label() for area in ax.collections] == (["breaks down"] if name == "above" else [])
    mark = next(line for line in ax.lines if line.get_label().startswith("minimum"))
    position = result.discharge.zone_position / result.conditions.half_width
    assert mark.get_xydata()[0] == pytest.approx([position, result.discharge.breakdown_voltage])


@pytest.mark.slow
def test_breakdown_of_a_point_contact_is_on_both_lines_through_the_weakest_place():
    result = solved(discharge=STRENGTH)
    panels = [ax for ax in figure(result, "breakdown.png").axes if ax.get_lines()]
    place = np.array(result.discharge.zone_position) / result.conditions.semi_axis_x
    for ax, at, other in zip(panels, place, place[::-1], strict=True):
        mark = next(line for line in ax.lines if line.get_label().startswith("minimum"))
        assert mark.get_xydata()[0] == pytest.approx([at, result.discharge.breakdown_voltage])
        assert numbers(ax.get_xlabel())[-1] == pytest.approx(other, rel=6e-3, abs=1e-9)
    assert figure(result, "cuts").axes[0].get_legend() is not None
    (strength,) = (line for line in field_cut(result).lines if np.ptp(line.get_ydata()) == 0.0)
    assert strength.get_ydata()[0] == 15.0


def test_a_weibull_law_has_its_probability():
    result = line_case(8.0, discharge=WEIBULL)
    chance, applied, _, breaking = numbers(finding(result, "breakdown.png"))
    discharge = result.discharge
    assert (chance, breaking) == pytest.approx(
        (100.0 * discharge.probability, discharge.breakdown_voltage), rel=0.06
    )
    assert applied == 8.0
    ax = probability(result)
    curve = next(line for line in ax.lines if line.get_label() == "probability")
    at_breakdown = np.interp(discharge.breakdown_voltage, *curve.get_data())
    assert at_breakdown == pytest.approx(100.0 * (1.0 - np.exp(-1.0)), abs=0.1)
    assert list(drawings_of(result))[-1] == "breakdown.png"


def test_without_a_strength_there_is_no_breakdown():
    result = line_case()
    assert "breakdown.png" not in drawings_of(result)
    assert "strength 1" not in finding(result, "field_profiles.png")
    with pytest.raises(ValueError, match="no dielectric strength"):
        breakdown_voltages(result)


def test_the_strength_is_drawn_where_it_is(below):
    ax = field_profiles(below)
    (line,) = (line for line in ax.lines if np.ptp(line.get_ydata()) == 0.0)
    assert line.get_ydata()[0] == 15.0
    assert ax.get_ylim()[1] > 15.0
    assert "dielectric strength 15 V/µm" in [text.get_text() for text in ax.texts]


def test_a_strength_far_above_the_field_is_named_and_not_drawn():
    ax = axes_or_new(None)
    assert limit_line(ax, np.linspace(-1.0, 1.0, 5), np.full(5, 100.0), 3.0, "V/µm") == 3.0
    assert not ax.lines
    assert ax.texts[0].get_text() == "dielectric strength 100 V/µm (above)"


def test_a_strength_near_zero_is_named_above_its_line():
    ax = axes_or_new(None)
    limit_line(ax, np.linspace(-1.0, 1.0, 5), np.full(5, 0.015), 2.0, "GV/m")
    assert ax.texts[0].get_va() == "bottom"
    limit_line(ax, np.linspace(-1.0, 1.0, 5), np.full(5, 1.5), 2.0, "GV/m")
    assert ax.texts[1].get_va() == "top"


def test_no_length_runs_into_the_name_of_its_axis(below):
    ax = axes_or_new(None)
    ax.set_xlim(-1.4, 1.4)
    length_axis(below, ax)
    (top,) = ax.child_axes
    left, right = 1e6 * below.conditions.half_width * np.array(ax.get_xlim())
    formatter = top.xaxis.get_major_formatter()
    ax.figure.draw_without_rendering()
    assert formatter(left + 0.01 * (right - left)) == ""
    assert formatter(left + 0.1 * (right - left))


def test_ticks_of_pressure_and_film_are_at_the_same_heights(below):
    left = film(below)
    (right,) = (ax for ax in left.figure.axes if ax is not left and ax.get_ylabel().startswith("film"))
    heights = [np.array(ax.get_yticks()) / ax.get_ylim()[1] for ax in (left, right)]
    np.testing.assert_allclose(*heights)
    assert left.get_ylim()[1] < 1.4e-9 * below.film.max_pressure
    mark = next(line for line in right.lines if line.get_label().startswith("minimum"))
    assert mark.get_ydata()[0] == pytest.approx(1e6 * below.film.minimum_thickness)


def test_lengths_are_on_the_upper_axis(below):
    ax = film(below)
    (top,) = (child for child in ax.child_axes if child.get_xlabel())
    ax.figure.draw_without_rendering()
    assert top.get_xlabel() == "$x$ [µm]"
    assert top.get_xlim()[1] == pytest.approx(1e6 * below.conditions.half_width * ax.get_xlim()[1])


def test_the_change_by_roughness_has_its_own_panel(rough):
    below = next(ax for ax in film(rough).figure.axes if ax.get_ylabel().startswith("change"))
    change = next(line for line in below.lines if "smooth" in line.get_label())
    np.testing.assert_allclose(change.get_ydata(), 1e9 * (rough.film.thickness - rough.smooth.thickness))


@pytest.mark.slow
def test_the_field_map_marks_its_maximum_and_is_grey_below_its_colours(below):
    ax = field_strength(below)
    (mark,) = (line for line in ax.lines if line.get_marker() == "o")
    field = below.field
    # Nothing lies on the film: the enlargement is a panel of its own, with the same maximum.
    (bar,) = ax.child_axes
    assert bar.get_window_extent().x0 > ax.get_window_extent().x1
    _, zoom = ax.figure.axes
    (same,) = (line for line in zoom.lines if line.get_marker() == "o")
    assert zoom.get_xlim()[0] < same.get_xdata()[0] == mark.get_xdata()[0] < zoom.get_xlim()[1]
    assert mark.get_xdata()[0] == pytest.approx(field.max_strength_position / below.conditions.half_width)
    filled = ax.collections[0]
    low, high = filled.get_clim()
    inside = np.abs(field.x) <= below.conditions.half_width
    assert low <= 1e-6 * field.strength[inside].min()
    assert high == pytest.approx(1e-6 * field.max_strength)
    assert low > 0.5 * high
    assert f"film below {low:.4g} V/µm" in [text.get_text() for text in ax.get_legend().get_texts()]
    assert filled.cmap.get_under()[:3] == pytest.approx(
        [int(OUT_OF_RANGE[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    )


def test_the_largest_deviation_is_enlarged(below):
    ax = field_deviation(below)
    assert not ax.child_axes
    said = finding(below, "field_deviation.png").removeprefix("The estimate V12/h")
    error, x, ends = numbers(said)
    assert "on this grid" in said
    _, zoom = ax.figure.axes
    assert zoom.get_xlim()[0] < x < zoom.get_xlim()[1]
    on = below.field.inner
    sections = np.stack(
        [below.field.strength[:, 0], below.field.middle_strength, below.field.strength[:, -1]]
    )
    worst = np.abs(sections / below.field.thin_gap_strength - 1.0)[:, on].max()
    assert error == pytest.approx((1e3 if worst < 1e-3 else 1e2) * worst, rel=0.06)
    # The ends are left out of the curves, and the title says how far off they are.
    outside = np.abs(sections / below.field.thin_gap_strength - 1.0)[:, ~on].max()
    assert outside > worst
    assert ends == pytest.approx((1e3 if outside < 1e-3 else 1e2) * outside, rel=0.06)
    assert said.partition("not drawn, ")[2]


def test_fields_that_coincide_are_one_line_and_rough_ones_are_beside_the_smooth_one(below, rough):
    plain = [text.get_text() for text in field_profiles(below).get_legend().get_texts()]
    assert plain[0].startswith("walls and mid-film, equal within ")
    assert "mid-film" not in plain
    ax = field_profiles(rough)
    smooth = next(line for line in ax.lines if line.get_label().endswith("mid-film, smooth surfaces"))
    assert smooth.get_zorder() > max(line.get_zorder() for line in ax.lines if line is not smooth)
    np.testing.assert_array_equal(smooth.get_ydata(), 1e-6 * rough.smooth.middle_strength[rough.field.inner])
    # From the minimum of the Hertzian zone, with a tenth of the range below it.
    low, high = ax.get_ylim()
    hertz = np.abs(rough.field.x) <= rough.conditions.half_width
    least = 1e-6 * rough.field.strength[hertz].min()
    assert 0.0 < low < least < low + 0.2 * (high - low)
    change = 100.0 * (rough.field.max_strength / rough.smooth.middle_strength.max() - 1.0)
    title = finding(rough, "field_profiles.png")
    assert f"{abs(change):.2g}"[:3] in title
    assert title.partition(" smooth;")[0].endswith("above" if change > 0.0 else "below")


def test_films_are_told_apart_without_colours(below, rough):
    """Pressure, film and Hertz pressure have dashes of their own; smooth surfaces lie behind rough ones."""
    for result in (below, rough):
        left = film(result)
        right = next(ax for ax in left.figure.axes if ax.get_ylabel().startswith("film"))
        lines = {line.get_label(): line for ax in (left, right) for line in ax.lines}
        names = ("Hertzian pressure", "pressure", "film thickness")
        assert len({str(lines[name]._dash_pattern) for name in names}) == 3
    for ax, name in ((left, "pressure"), (right, "film thickness")):
        (smooth,) = (line for line in ax.lines if line.get_color() == LIGHT_GREY)
        assert smooth.get_zorder() < lines[name].get_zorder()
        assert smooth.get_linewidth() > lines[name].get_linewidth()


def test_cut_off_heights_are_explained(rough):
    text = finding(rough, "roughness.png")
    assert text.endswith("heights cut off at ±30 nm")
    assert numbers(text)[0] == pytest.approx(1e9 * rough.roughness_statistics.rq_1, rel=6e-3)
    ends = {line.get_ydata()[0] for line in roughness(rough).lines if np.ptp(line.get_ydata()) == 0.0}
    assert sorted(ends) == pytest.approx([-30.0, 30.0])


@pytest.mark.slow
def test_sections_have_one_scale_and_state_their_enlargement():
    result = result_of("across")
    along, across = (ax for ax in field_sections(result).figure.axes if ax.get_ylabel().startswith("height"))
    assert along.get_ylim() == across.get_ylim()
    along.figure.canvas.draw()
    for ax in (along, across):
        texts = [found for found in ax.get_children() if isinstance(found, Text)]
        (text,) = (found for found in texts if found.get_text().startswith("heights "))
        box, (left, right), (low, high) = ax.get_window_extent(), ax.get_xlim(), ax.get_ylim()
        metres_right = (right - left) * result.conditions.semi_axis_x / box.width
        metres_up = 1e-9 * (high - low) / box.height
        assert numbers(text.get_text())[0] == pytest.approx(metres_right / metres_up, rel=0.06)


@pytest.mark.slow
def test_the_spike_of_the_pressure_is_told_from_the_hertz_pressure():
    circle, across = result_of("circle"), result_of("across")
    assert has_spike(circle)
    assert not has_spike(across)
    assert finding(circle, "pressure_map.png").startswith("Pressure spike of ")
    for result in (circle, across):
        highest, hertz = numbers(finding(result, "pressure_map.png"))
        assert highest == pytest.approx(1e-9 * result.film.max_pressure, rel=6e-3)
        assert hertz == pytest.approx(1e-9 * result.conditions.max_pressure, rel=6e-3)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["circle", "across", "gaussian"])
def test_every_figure_of_a_point_contact_has_a_finding(kind):
    result = result_of(kind)
    texts = {name: finding(result, name) for name in drawings_of(result)}
    assert all(re.search(r"\d", text) for text in texts.values())
    assert not any("$" in text or "nan" in text for text in texts.values())


def test_places_of_smooth_contacts_leave_the_side_open():
    result = result_of("circle")
    b = result.conditions.semi_axis_x
    assert place_text(result, (0.5 * b, -0.25 * b)) == "x/b = 0.5, y/b = ±0.25"
    assert place_text(result, (-0.5 * b, 0.0)) == "x/b = −0.5, y/b = 0"
    assert place_text(replace(result, rough=({"surface": 1},)), (0.0, -0.25 * b)) == "x/b = 0, y/b = −0.25"


def test_shares_have_two_digits():
    assert [per_cent(part) for part in (2.0, 0.5, 0.0123, 1e-4)] == ["200 %", "50 %", "1.2 %", "0.10 ‰"]
