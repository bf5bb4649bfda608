"""Figures of point contacts: what is drawn is the result's, marked where it is, and nothing is cut."""

import re

import numpy as np
import pytest
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from scipy.ndimage import binary_dilation, binary_erosion

from ehlectric.figures.contact_figure_files import drawings_of
from ehlectric.figures.contact_maps import film_window
from ehlectric.figures.figure_names import ALL_FIGURES, POINT_FIGURE_FILES
from ehlectric.figures.point_figures import (
    SECTIONS,
    cuts,
    field_cut,
    field_deviation,
    field_map,
    field_section,
    field_sections,
    film_cut,
    film_map,
    pressure_cut,
    pressure_map,
    roughness,
)
from ehlectric.quantities.palette import OUT_OF_RANGE, RED
from tests.helpers.each import each
from tests.helpers.point_pages import EVERY_KIND, KINDS, PIT, drawn, on_page, pages, result_of, solved
from tests.helpers.titles import title_of

NUMBER = re.compile(r"([\d.]+) (nm|GPa|V/µm|GV/m)")
UNITS = {"[nm]": 1e9, "[GPa]": 1e-9, "[V/µm]": 1e-6, "[GV/m]": 1e-9}
MAPS = [film_map, pressure_map, field_map]


def bars(ax):
    return [other.get_xlabel() or other.get_ylabel() for other in ax.figure.axes if other is not ax]


@pytest.mark.slow
def test_the_kinds_are_what_they_are_called():
    solved_ones = [result_of(kind) for kind in KINDS]
    assert [result.converged for result in solved_ones] == [kind != "unsolved" for kind in KINDS]
    ratios = [result.conditions.ratio for result in solved_ones]
    assert ratios == pytest.approx([1.0, 9.3, 0.144, 9.3, 1.0], rel=0.01)


@each(
    "draw, part, values, label",
    [
        (film_map, "film", "thickness", "film thickness $h$ [nm], thicker: grey"),
        (pressure_map, "film", "pressure", "pressure $p$ [GPa]"),
        (field_map, "field", "middle_strength", "field strength $|E|$, mid-film [V/µm]"),
    ],
)
@EVERY_KIND
def test_maps_are_of_the_result_to_scale(kind, draw, part, values, label):
    result = result_of(kind)
    of = getattr(result, part)
    if kind == "unsolved":  # films of tenths of a nanometre
        label = label.replace("V/µm", "GV/m")
    ax = drawn(kind, draw)
    factor = next(factor for unit, factor in UNITS.items() if unit in label)
    at, shown = at_nodes(result, ax.collections[0], of)
    expected = factor * getattr(of, values)[at]
    spike = draw is pressure_map and kind in ("circle", "along")
    if spike:  # smoothed, which changes little where the pressure is even
        x, y = (axis[part] / result.conditions.semi_axis_x for axis, part in zip(of.axes, at, strict=True))
        even = np.hypot(x, y / result.conditions.ratio) < 0.4
        shown, expected = shown[even], expected[even]
    np.testing.assert_allclose(shown, expected, rtol=3e-2 if spike else 1e-9, atol=1e-9)
    assert expected.size > 20
    assert bars(ax) == [label]


def at_nodes(result, mesh, of):
    """Nodes (i, j) that a map shows, and the values of the map at these nodes."""
    where = mesh.get_coordinates() * result.conditions.semi_axis_x
    x, y = (
        (where[:, 0, 1], where[0, :, 0])
        if result.conditions.ratio > 1.2
        else (where[:, 0, 0], where[0, :, 1])
    )
    nodes, places = [], []
    for axis, fine in ((of.x, x), (of.y, y)):
        near = np.argmin(np.abs(fine[:, np.newaxis] - axis), axis=0)
        there = np.abs(fine[near] - axis) < 1e-9 * np.ptp(axis)
        nodes.append(np.nonzero(there)[0])
        places.append(near[there])
    values = np.asarray(mesh.get_array()).reshape(where.shape[:2])
    return np.ix_(*nodes), values[np.ix_(*places)]


@EVERY_KIND
def test_films_beyond_the_colours_are_grey(kind):
    """Far from the contact the film is thicker than the colours show, and no colour of the map is grey."""
    mesh = drawn(kind, film_map).collections[0]
    thickest = mesh.to_rgba(2.0 * mesh.get_clim()[1])
    assert tuple(thickest) == pytest.approx(to_rgba(OUT_OF_RANGE))
    assert np.max(mesh.get_array()) > mesh.get_clim()[1]
    red, green, blue = mesh.to_rgba(mesh.get_clim()[1])[:3]
    assert max(red, green, blue) - min(red, green, blue) > 0.5


def test_walls_have_maps_of_their_own():
    field = result_of("gaussian").field
    for section in ("surface 1", "surface 2"):
        mesh = field_map(result_of("gaussian"), section=section).collections[0]
        strength = getattr(field, section.replace(" ", "_") + "_strength")
        np.testing.assert_allclose(mesh.get_array(), 1e-6 * strength, rtol=1e-12)
    assert not np.array_equal(field.surface_1_strength, field.surface_2_strength)


@EVERY_KIND
def test_colours_of_the_film_are_of_the_contact_and_not_of_the_inlet(kind):
    """All but two per cent of the films in the Hertz ellipse are within them, the gap around it is not."""
    result = result_of(kind)
    low, high = drawn(kind, film_map).collections[0].get_clim()
    x = result.film.x[:, np.newaxis] / result.conditions.semi_axis_x
    y = result.film.y / result.conditions.semi_axis_y
    thickness = 1e9 * result.film.thickness
    inside = thickness[x**2 + y**2 <= 1.0]
    assert low <= thickness.min()
    assert 0.97 < np.mean(inside <= high) <= 1.0
    assert high < 1.3 * np.percentile(inside, 98.0)


@EVERY_KIND
def test_lines_of_equal_film_are_at_round_steps_within_the_ellipse(kind):
    result = result_of(kind)
    ax = drawn(kind, film_map)
    found = [lines for lines in ax.collections if hasattr(lines, "levels")]
    assert bool(found) == (not result.rough)
    for lines in found:
        steps = np.diff(lines.levels)
        assert np.ptp(steps) < 1e-9 * steps[0]
        assert f"{steps[0]:.0e}"[0] in "125"
        assert 5 <= lines.levels.size <= 14
        assert lines.get_clip_path() is not None
        (bar,) = (other for other in ax.figure.axes if other is not ax)
        ticks = bar.get_xticks() if result.conditions.ratio != 1.0 else bar.get_yticks()
        np.testing.assert_allclose(ticks, lines.levels)


@each("draw", MAPS)
@EVERY_KIND
def test_extremes_are_marked_where_they_are(kind, draw):
    """With their mirror image beside smooth surfaces, and their value beside them."""
    result = result_of(kind)
    film, field = result.film, result.field
    position, value = {
        film_map: (film.minimum_position, 1e9 * film.minimum_thickness),
        pressure_map: (None, 1e-9 * film.max_pressure),
        field_map: (field.max_strength_position, 1e-6 * field.max_strength),
    }[draw]
    if position is None:
        i, j = np.unravel_index(np.argmax(film.pressure), film.pressure.shape)
        position = film.x[i], film.y[j]
    ax = drawn(kind, draw)
    (marker,) = (line for line in ax.lines if line.get_marker() == "x")
    x, y = position
    mirrored = {y} if kind == "gaussian" else {y, -y}
    expected = np.array([on_page(result, x, side) for side in sorted(mirrored)])
    np.testing.assert_allclose(marker.get_xydata(), expected, atol=1e-12)
    texts = {text.get_text() for text in ax.texts if NUMBER.fullmatch(text.get_text())}
    (text,) = (NUMBER.fullmatch(text) for text in texts)
    assert float(text[1]) * (1e3 if text[2] == "GV/m" else 1.0) == pytest.approx(value, rel=6e-3)


@each("draw", [*MAPS, field_deviation])
@EVERY_KIND
def test_hertz_ellipse_has_the_axes_of_the_dry_contact(kind, draw):
    result = result_of(kind)
    ax = drawn(kind, draw)
    (ellipse,) = ax.patches
    a, b = result.conditions.semi_axis_y, result.conditions.semi_axis_x
    assert (ellipse.width, ellipse.height) == pytest.approx(on_page(result, 2.0 * b, 2.0 * a))
    assert tuple(ellipse.center) == (0.0, 0.0)


@each("draw", MAPS)
@EVERY_KIND
def test_both_axes_have_one_scale_or_say_so(kind, draw):
    result = result_of(kind)
    ax = drawn(kind, draw)
    scale = ax.get_aspect()
    assert ("scale" in ax.get_ylabel()) == (scale != 1.0)
    if scale != 1.0:
        assert ax.get_ylabel().endswith(f"scale {scale:g}:1")
    # Only long ellipses are stretched, and to no more than half of a page.
    assert (scale == 1.0) == (0.2 < result.conditions.ratio < 4.0)
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    assert 0.3 < scale * abs(high - low) / (right - left) < 1.1
    assert ax.get_xlabel().endswith(f"($b$ = {1e6 * result.conditions.semi_axis_x:.4g} µm)")


@each("draw", MAPS)
@EVERY_KIND
def test_arrow_points_along_entrainment(kind, draw):
    """From the inlet to the outlet, as x grows on the page."""
    result = result_of(kind)
    ax = drawn(kind, draw)
    (arrow,) = (text for text in ax.texts if getattr(text, "arrow_patch", None))
    tail = ax.transData.inverted().transform(arrow.anncoords.transform(arrow.xyann))
    tip = ax.transData.inverted().transform(arrow.xycoords.transform(arrow.xy))
    x, y = on_page(result, *(tip - tail)) if result.conditions.ratio <= 1.2 else (tip - tail)[::-1]
    assert x > 0.0
    assert abs(y) < 1e-9


def test_cavitated_film_is_hatched():
    result, ax = result_of("circle"), drawn("circle", pressure_map)
    (area,) = (area for area in ax.collections if getattr(area, "hatches", [None])[0])
    held = result.film.cavitated
    x, y = on_page(result, *np.meshgrid(result.film.x[2:-2], result.film.y[2:-2], indexing="ij"))
    low, high = film_window(result)[0]
    window = (x > low) & (x < high) & (np.abs(y) < film_window(result)[1][1])
    # The edge is within a node of the edge of the cavitated nodes.
    sure, never = binary_erosion(held, border_value=1)[2:-2, 2:-2], ~binary_dilation(held)[2:-2, 2:-2]
    inside = area.get_paths()[0].contains_points(np.column_stack([x.ravel(), y.ravel()])).reshape(x.shape)
    assert np.all(inside[sure & window])
    assert not np.any(inside[never & window])
    assert np.count_nonzero(sure & window) > 100
    assert 0.05 < np.mean(held) < 0.5


def test_the_edge_of_the_cavitated_film_has_no_steps():
    """Along the grid, steps would give the edge of a slanting region only right angles."""
    area = next(
        area for area in drawn("circle", pressure_map).collections if getattr(area, "hatches", [None])[0]
    )
    edge = max(area.get_paths()[0].to_polygons(), key=len)
    turns = np.diff(np.unwrap(np.arctan2(*np.diff(edge, axis=0).T[::-1])))
    inner = np.abs(turns[np.all(np.abs(edge[1:-1]) < 1.4, axis=1)])
    assert inner.size > 50
    assert np.percentile(inner, 99.0) < 0.5


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["circle", "gaussian"])
def test_zone_of_high_field_is_that_of_the_summary(kind):
    """The area within the lines, by the shoelace formula, is the summary's."""
    result = result_of(kind)
    field, b = result.field, result.conditions.semi_axis_x
    ax = drawn(kind, field_map)
    (zone,) = (lines for lines in ax.collections if hasattr(lines, "levels"))
    assert zone.levels == pytest.approx([0.95 * np.max(field.middle_strength)])
    area = 0.0
    for around in zone.get_paths()[0].to_polygons():
        x, y = b * around.T
        area += 0.5 * abs(np.dot(x[:-1], y[1:]) - np.dot(x[1:], y[:-1]))
    # Of some twenty cells, in which the two interpolate by rules of their own.
    assert area == pytest.approx(field.high_field_area, rel=0.1)


@EVERY_KIND
def test_deviations_are_those_of_all_three_sections(kind):
    result = result_of(kind)
    field, first = result.field, drawn(kind, field_deviation)
    panels = [ax for ax in first.figure.axes if ax.texts]
    names = [ax.texts[0].get_text() for ax in panels]
    strengths = [field.surface_1_strength, field.middle_strength, field.surface_2_strength]
    if kind in ("gaussian", "unsolved") and len(panels) == 3:
        assert names == list(SECTIONS)
    else:
        assert names == ["surface 1, and 2 alike", "mid-film"]
        np.testing.assert_allclose(strengths[0], strengths.pop(), rtol=1e-4)
    x = field.x[:, np.newaxis] / result.conditions.semi_axis_x
    y = field.y / result.conditions.semi_axis_y
    shown = (x**2 + y**2 <= 1.0) & field.inner
    for ax, strength in zip(panels, strengths, strict=True):
        mesh = ax.collections[0]
        deviation = 1e3 * (strength * field.thin_gap_strength**-1.0 - 1.0)
        np.testing.assert_allclose(mesh.get_array(), deviation, atol=1e-9)
        assert mesh.get_clip_path() is not None
        low, high = mesh.get_clim()
        assert np.mean((deviation[shown] >= low) & (deviation[shown] <= high)) > 0.96
        # Zero is the middle of a diverging map, which is white.
        assert low == -high
        assert min(mesh.to_rgba(0.0)[:3]) > 0.95


@pytest.mark.slow
def test_roughness_and_what_it_changes():
    result, first = result_of("gaussian"), drawn("gaussian", roughness)
    heights, change, bar = first.figure.axes
    np.testing.assert_allclose(heights.collections[0].get_array(), 1e9 * result.roughness.sum(axis=0))
    difference = 1e9 * (result.film.thickness - result.smooth.thickness)
    np.testing.assert_allclose(change.collections[0].get_array(), difference, atol=1e-9)
    assert heights.collections[0].get_clim() == change.collections[0].get_clim()
    assert bar.get_ylabel() == "height, change of the film [nm]"


def test_roughness_without_the_smooth_contact():
    result = solved(roughness=[PIT], beside_smooth=False)
    heights, bar = roughness(result).figure.axes
    np.testing.assert_allclose(heights.collections[0].get_array(), 1e9 * result.roughness[1])
    assert bar.get_ylabel() == "height [nm]"
    assert film_cut(result).get_legend() is None


@EVERY_KIND
def test_figures_by_their_files(kind):
    result = result_of(kind)
    names = list(drawings_of(result))
    assert names == [*POINT_FIGURE_FILES, *(["roughness.png"] if result.rough else [])]
    assert set(names) <= set(ALL_FIGURES)
    assert len(set(ALL_FIGURES)) == len(ALL_FIGURES)


@each("draw", [*MAPS, pressure_cut, film_cut, field_cut, field_section])
def test_figures_draw_on_given_axes(draw):
    ax = Figure().subplots()
    assert draw(result_of("circle"), ax) is ax
    assert ax.has_data()


@pytest.mark.slow
def test_panels_draw_on_given_axes():
    for draw, number in ((cuts, 6), (field_deviation, 3), (field_sections, 2), (roughness, 2)):
        axes = Figure().subplots(1, number)
        assert draw(result_of("gaussian"), axes) is axes[0]
        assert all(ax.has_data() for ax in axes)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["across", "along", "gaussian"])
def test_nothing_is_cut_or_written_over(kind):
    """All is on the page, nothing is over the title, and no legend is over its axes."""
    result = result_of(kind)
    for name, figure in pages(kind).items():
        if kind != "gaussian" and name in ("cuts.png", "field_sections.png"):
            continue  # their page is the same for every contact
        figure.draw_without_rendering()
        width, height = figure.get_size_inches()
        (left, low), (right, high) = figure.get_tightbbox().get_points()
        assert 0.0 <= left < right <= width
        assert 0.0 <= low < high <= height
        title = figure._suptitle
        assert (title.get_color(), title_of(figure)[-1]) == ("black", result.case.title)
        for ax in figure.axes:
            assert not ax.get_tightbbox().overlaps(title.get_window_extent())
            if legend := ax.get_legend():
                assert legend.get_window_extent().y0 > ax.get_window_extent().y1


@pytest.mark.slow
def test_unsolved_figures_say_so(tmp_path):
    for figure in pages("unsolved").values():
        assert title_of(figure)[0] == "NOT CONVERGED"
        assert figure._suptitle.get_color() == RED
    pages("unsolved")["pressure_map.png"].savefig(tmp_path / "map.png", dpi=30)
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


def test_a_flat_field_has_no_zone_of_its_own():
    """Over a range in which the field changes by less than 5 % there is no line to draw."""
    few = {"field_range": [-0.2, 0.2], "field_side": 0.2, "field_nodes": 17, "field_nodes_y": 17}
    result = solved(grid=few)
    assert result.field.middle_strength.min() > 0.95 * result.field.middle_strength.max()
    assert not [lines for lines in field_map(result).collections if hasattr(lines, "levels")]
    assert field_deviation(result).has_data()
