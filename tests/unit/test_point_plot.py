"""Figures of point contacts: what is drawn is the result's, marked where it is, and nothing is cut."""

import re

import numpy as np
import pytest
from matplotlib.figure import Figure

from ehlectric import Case, figures, solve
from ehlectric.point_cuts import (
    Cut,
    cuts,
    field_cut,
    field_section,
    field_sections,
    film_cut,
    pressure_cut,
)
from ehlectric.point_plot import (
    SECTIONS,
    field_deviation,
    field_map,
    film_map,
    point_figures_of,
    pressure_map,
    roughness,
)
from ehlectric.store import ALL_FIGURES, POINT_FIGURE_FILES

CIRCLE = {
    "geometry": "point",
    "radius_x": "10 mm",
    "radius_y": "10 mm",
    "reduced_modulus": "226 GPa",
    "load": "20 N",
    "entrainment_speed": "2 m/s",
}
BEARING = {
    "load": "600 N",
    "entrainment_speed": "4 m/s",
    "radius_x": None,
    "radius_y": None,
    "body_1": {"radius_x": "24 mm", "radius_y": "-6.191 mm"},
    "body_2": {"radius_x": "5.953 mm", "radius_y": "5.953 mm"},
}
GAUSSIAN = {"surface": 1, "generator": "gaussian", "rq": "40 nm", "correlation_length": "40 um", "seed": 3}
PIT = {"surface": 2, "generator": "pit", "depth": "200 nm", "width": "60 um", "rim": "20 nm"}


def solved(contact=None, grid=None, solver=None, beside_smooth=True, **tables):
    contact = {key: value for key, value in (CIRCLE | (contact or {})).items() if value is not None}
    grid = {"nodes": 65, "nodes_y": 65, "field_degree": 4} | (grid or {})
    tables |= {"contact": contact, "grid": grid, "lubricant": {"base": "paper"}}
    case = Case.from_dict(tables | ({"solver": solver} if solver else {}))
    return solve(case, beside_smooth=beside_smooth)


@pytest.fixture(scope="module")
def results():
    """One result of every kind that is drawn in a way of its own."""
    return {
        "circle": solved(title="20 N"),
        "across": solved(BEARING, title="A ball of a deep groove ball bearing 6208"),
        "along": solved({"radius_x": "200 mm", "load": "60 N"}, {"nodes_y": 73}, title="Along"),
        "unsolved": solved(BEARING | {"entrainment_speed": "0.05 m/s"}, solver={"max_iterations": 2}),
        "gaussian": solved(grid={"nodes_y": 49}, roughness=[GAUSSIAN], title="Rough, $"),
    }


KINDS = ["circle", "across", "along", "unsolved", "gaussian"]
NUMBER = re.compile(r", ([\d.]+) (nm|GPa|V/µm|GV/m)")
UNITS = {"[nm]": 1e9, "[GPa]": 1e-9, "[V/µm]": 1e-6, "[GV/m]": 1e-9}
MAPS = [film_map, pressure_map, field_map]


@pytest.fixture(params=KINDS)
def kind(request):
    return request.param


@pytest.fixture
def result(results, kind):
    return results[kind]


@pytest.fixture(scope="module")
def pages(results, tmp_path_factory):
    """Figures of a kind by the names of their files, as they are saved, drawn once."""
    made = {}

    def of(kind):
        if kind not in made:
            saved = []
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(Figure, "savefig", lambda figure, _: saved.append(figure))
                files = figures.save_figures(results[kind], tmp_path_factory.mktemp(kind))
            made[kind] = dict(zip((path.name for path in files), saved, strict=True))
        return made[kind]

    return of


@pytest.fixture(scope="module")
def drawn(pages):
    """The first axes of a figure of a kind."""
    return lambda kind, draw: pages(kind)[f"{draw.__name__}.png"].axes[0]


def on_page(result, x, y):
    """Positions [m] as they are drawn: entrainment points down where the ellipse is long across it."""
    b = result.conditions.semi_axis_x
    return (y / b, x / b) if result.conditions.ratio > 1.2 else (x / b, y / b)


def bars(ax):
    return [other.get_xlabel() or other.get_ylabel() for other in ax.figure.axes if other is not ax]


def test_the_kinds_are_what_they_are_called(results):
    assert [result.converged for result in results.values()] == [kind != "unsolved" for kind in KINDS]
    ratios = [result.conditions.ratio for result in results.values()]
    assert ratios == pytest.approx([1.0, 9.3, 0.144, 9.3, 1.0], rel=0.01)


@pytest.mark.parametrize(
    ("draw", "part", "values", "label"),
    [
        (film_map, "film", "thickness", "film thickness $h$ [nm]"),
        (pressure_map, "film", "pressure", "pressure $p$ [GPa]"),
        (field_map, "field", "middle_strength", "$|E|$, mid-film [V/µm]"),
    ],
)
def test_maps_are_of_the_result_to_scale(results, drawn, kind, draw, part, values, label):
    result = results[kind]
    of = getattr(result, part)
    if kind == "unsolved":  # films of tenths of a nanometre
        label = label.replace("V/µm", "GV/m")
    ax = drawn(kind, draw)
    mesh = ax.collections[0]
    factor = UNITS[label.rpartition(" ")[2]]
    np.testing.assert_allclose(mesh.get_array(), factor * getattr(of, values), rtol=1e-12)
    x, y = np.meshgrid(of.x, of.y, indexing="ij")
    np.testing.assert_allclose(mesh.get_coordinates(), np.stack(on_page(result, x, y), axis=-1))
    assert bars(ax) == [label]


def test_walls_have_maps_of_their_own(results):
    field = results["gaussian"].field
    for section in ("surface 1", "surface 2"):
        mesh = field_map(results["gaussian"], section=section).collections[0]
        strength = getattr(field, section.replace(" ", "_") + "_strength")
        np.testing.assert_allclose(mesh.get_array(), 1e-6 * strength, rtol=1e-12)
    assert not np.array_equal(field.surface_1_strength, field.surface_2_strength)


def test_colours_of_the_film_are_of_the_contact_and_not_of_the_inlet(result, drawn, kind):
    """All but two per cent of the films in the Hertz ellipse are within them, the gap around it is not."""
    low, high = drawn(kind, film_map).collections[0].get_clim()
    x = result.film.x[:, np.newaxis] / result.conditions.semi_axis_x
    y = result.film.y / result.conditions.semi_axis_y
    thickness = 1e9 * result.film.thickness
    inside = thickness[x**2 + y**2 <= 1.0]
    assert low <= thickness.min()
    assert 0.97 < np.mean(inside <= high) <= 1.0
    assert high < 1.3 * np.percentile(inside, 98.0)


def test_lines_of_equal_film_are_at_round_steps_within_the_ellipse(result, drawn, kind):
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


@pytest.mark.parametrize("draw", MAPS)
def test_extremes_are_marked_where_they_are(result, drawn, kind, draw):
    """With their mirror image beside smooth surfaces, and their value in the legend."""
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
    (text,) = (found for entry in ax.get_legend().get_texts() if (found := NUMBER.search(entry.get_text())))
    assert float(text[1]) * (1e3 if text[2] == "GV/m" else 1.0) == pytest.approx(value, rel=6e-3)


@pytest.mark.parametrize("draw", [*MAPS, field_deviation])
def test_hertz_ellipse_has_the_axes_of_the_dry_contact(result, drawn, kind, draw):
    ax = drawn(kind, draw)
    (ellipse,) = ax.patches
    a, b = result.conditions.semi_axis_y, result.conditions.semi_axis_x
    assert (ellipse.width, ellipse.height) == pytest.approx(on_page(result, 2.0 * b, 2.0 * a))
    assert tuple(ellipse.center) == (0.0, 0.0)


@pytest.mark.parametrize("draw", MAPS)
def test_both_axes_have_one_scale_or_say_so(result, drawn, kind, draw):
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


@pytest.mark.parametrize("draw", MAPS)
def test_arrow_points_along_entrainment(result, drawn, kind, draw):
    """From the inlet to the outlet, as x grows on the page."""
    ax = drawn(kind, draw)
    (arrow,) = (text for text in ax.texts if getattr(text, "arrow_patch", None))
    tail = ax.transData.inverted().transform(arrow.anncoords.transform(arrow.xyann))
    tip = ax.transData.inverted().transform(arrow.xycoords.transform(arrow.xy))
    x, y = on_page(result, *(tip - tail)) if result.conditions.ratio <= 1.2 else (tip - tail)[::-1]
    assert x > 0.0
    assert abs(y) < 1e-9


def test_cavitated_film_is_hatched(results, drawn):
    result, ax = results["circle"], drawn("circle", pressure_map)
    (area,) = (area for area in ax.collections if getattr(area, "hatches", [None])[0])
    held = result.film.cavitated
    x, y = on_page(result, *np.meshgrid(result.film.x[2:-2], result.film.y[2:-2], indexing="ij"))
    inside = area.get_paths()[0].contains_points(np.column_stack([x.ravel(), y.ravel()]))
    np.testing.assert_array_equal(inside.reshape(x.shape), held[2:-2, 2:-2])
    assert 0.05 < np.mean(held) < 0.5


@pytest.mark.parametrize("kind", ["circle", "gaussian"])
def test_zone_of_high_field_is_that_of_the_summary(results, drawn, kind):
    """The area in the line around the maximum, by the shoelace formula, is the summary's."""
    result = results[kind]
    field, b = result.field, result.conditions.semi_axis_x
    ax = drawn(kind, field_map)
    (zone,) = (lines for lines in ax.collections if hasattr(lines, "levels"))
    assert zone.levels == pytest.approx([0.95 * np.max(field.middle_strength)])
    i, j = np.unravel_index(np.argmax(field.middle_strength), field.middle_strength.shape)
    (around,) = (
        part.vertices
        for part in zone.get_paths()[0]._iter_connected_components()
        if part.contains_point((field.x[i] / b, field.y[j] / b))
    )
    x, y = b * around.T
    area = 0.5 * abs(np.dot(x[:-1], y[1:]) - np.dot(x[1:], y[:-1]))
    # Of some twenty cells, in which the two interpolate by rules of their own.
    assert area == pytest.approx(field.high_field_area, rel=0.1)


@pytest.mark.parametrize("along", ["x", "y"])
def test_cuts_are_of_the_result(result, drawn, kind, along):
    film, field, b = result.film, result.field, result.conditions.semi_axis_x
    axis = 0 if along == "x" else 1

    def line_of(values, grid, position):
        other = grid.y if along == "x" else grid.x
        return np.take(values, np.argmin(np.abs(other - position[1 - axis])), axis=1 - axis)

    of_pressure, of_film, of_field = drawn(kind, cuts).figure.axes[axis::2]
    places = ((0.0, 0.0), film.minimum_position)
    at = (film.x, film.y)[axis] / b
    hertz, *pressures = of_pressure.lines
    for line, place in zip(pressures, places, strict=True):
        np.testing.assert_array_equal(line.get_xdata(), at)
        np.testing.assert_allclose(line.get_ydata(), 1e-9 * line_of(film.pressure, film, place))
    films = [line for line in of_film.lines if line.get_linestyle() != ":"]
    for line, place in zip(films, places, strict=True):
        np.testing.assert_allclose(line.get_ydata(), 1e9 * line_of(film.thickness, film, place))
    lines = of_field.lines
    factor = 1e-9 if field.max_strength >= 1e8 else 1e-6
    for pair, place in zip((lines[:2], lines[2:]), ((0.0, 0.0), field.max_strength_position), strict=True):
        on = line_of(field.inner, field, place)
        thin, middle = (
            factor * line_of(values, field, place)[on]
            for values in (field.thin_gap_strength, field.middle_strength)
        )
        np.testing.assert_allclose(pair[0].get_ydata(), thin)
        np.testing.assert_allclose(pair[1].get_ydata(), middle)
    # Half an ellipse: its area is pi/4 of its base times its height.
    area = np.trapezoid(hertz.get_ydata(), hertz.get_xdata())
    half = 1.0 if along == "x" else result.conditions.ratio
    assert area == pytest.approx(0.5e-9 * np.pi * half * result.conditions.max_pressure, rel=1e-3)


def test_smooth_films_are_dotted_beside_rough_ones(results):
    result = results["gaussian"]
    dotted = [line for line in film_cut(result).lines if line.get_linestyle() == ":"]
    j = np.argmin(np.abs(result.film.y - result.film.minimum_position[1]))
    np.testing.assert_allclose(dotted[1].get_ydata(), 1e9 * result.smooth.thickness[:, j])
    assert [text.get_text() for text in film_cut(result).get_legend().get_texts()] == ["smooth surfaces"]
    assert film_cut(results["circle"]).get_legend() is None


def test_names_of_cuts():
    x = np.array([-1e-4, 1e-21, 1e-4])
    cut = Cut.near("x", (0.0, 2e-5), x, x)
    assert (cut.index, cut.position) == (1, 1e-21)


@pytest.mark.parametrize("along", ["x", "y"])
def test_sections_are_as_high_as_the_film(result, drawn, kind, along):
    """And smooth walls lie alike above and below, however far the film of unequal bodies is bent."""
    field, b = result.field, result.conditions.semi_axis_x
    lower, upper = drawn(kind, field_sections).figure.axes["xy".index(along)].lines
    x, y = field.max_strength_position
    i, j = np.argmin(np.abs(field.x - x)), np.argmin(np.abs(field.y - y))
    of = (slice(None), j) if along == "x" else (i, slice(None))
    on = field.inner[of]
    gap = field.z[(*of, -1)] - field.z[(*of, 0)]
    np.testing.assert_allclose(upper.get_xdata(), (field.x if along == "x" else field.y)[on] / b)
    np.testing.assert_allclose(upper.get_ydata() - lower.get_ydata(), 1e9 * gap[on], rtol=1e-9)
    if not result.rough:
        np.testing.assert_allclose(upper.get_ydata(), -lower.get_ydata(), rtol=1e-6, atol=1e-6)


def test_sections_keep_the_roughness_on_its_surface(results, drawn):
    """Equal bodies of which only surface 1 is rough: the middle of the film is half its height up."""
    result = results["gaussian"]
    lower, upper = drawn("gaussian", field_sections).lines
    j = np.argmin(np.abs(result.film.y - result.field.max_strength_position[1]))
    x = result.film.x / result.conditions.semi_axis_x
    expected = 0.5e9 * np.interp(upper.get_xdata(), x, result.roughness[0][:, j])
    np.testing.assert_allclose(0.5 * (lower.get_ydata() + upper.get_ydata()), expected, atol=1e-6)
    assert np.ptp(expected) > 20.0


def test_deviations_are_those_of_all_three_sections(result, drawn, kind):
    field, first = result.field, drawn(kind, field_deviation)
    panels = first.figure.axes[:3]
    assert [ax.texts[0].get_text() for ax in panels] == list(SECTIONS)
    strengths = (field.surface_1_strength, field.middle_strength, field.surface_2_strength)
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


def test_roughness_and_what_it_changes(results, drawn):
    result, first = results["gaussian"], drawn("gaussian", roughness)
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


def test_figures_by_their_files(result):
    names = list(point_figures_of(result))
    assert names == [*POINT_FIGURE_FILES, *(["roughness.png"] if result.rough else [])]
    assert set(names) <= set(ALL_FIGURES)
    assert len(set(ALL_FIGURES)) == len(ALL_FIGURES)


@pytest.mark.parametrize("draw", [*MAPS, pressure_cut, film_cut, field_cut, field_section])
def test_figures_draw_on_given_axes(results, draw):
    ax = Figure().subplots()
    assert draw(results["circle"], ax) is ax
    assert ax.has_data()


def test_panels_draw_on_given_axes(results):
    for draw, number in ((cuts, 6), (field_deviation, 3), (field_sections, 2), (roughness, 2)):
        axes = Figure().subplots(1, number)
        assert draw(results["gaussian"], axes) is axes[0]
        assert all(ax.has_data() for ax in axes)


@pytest.mark.parametrize("kind", ["across", "along", "gaussian"])
def test_nothing_is_cut_or_written_over(result, pages, kind):
    """All is on the page, nothing is over the title, and no legend is over its axes."""
    for name, figure in pages(kind).items():
        if kind != "gaussian" and name in ("cuts.png", "field_sections.png"):
            continue  # their page is the same for every contact
        figure.draw_without_rendering()
        width, height = figure.get_size_inches()
        (left, low), (right, high) = figure.get_tightbbox().get_points()
        assert 0.0 <= left < right <= width
        assert 0.0 <= low < high <= height
        title = figure._suptitle
        assert (title.get_text(), title.get_color()) == (result.case.title, "black")
        for ax in figure.axes:
            assert not ax.get_tightbbox().overlaps(title.get_window_extent())
            if legend := ax.get_legend():
                assert legend.get_window_extent().y0 > ax.get_window_extent().y1


def test_unsolved_figures_say_so(pages, tmp_path):
    for figure in pages("unsolved").values():
        assert (figure._suptitle.get_text(), figure._suptitle.get_color()) == ("NOT CONVERGED", "red")
    pages("unsolved")["pressure_map.png"].savefig(tmp_path / "map.png", dpi=30)
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


def test_a_flat_field_has_no_zone_of_its_own():
    """Over a range in which the field changes by less than 5 % there is no line to draw."""
    few = {"field_range": [-0.2, 0.2], "field_side": 0.2, "field_nodes": 17, "field_nodes_y": 17}
    result = solved(grid=few)
    assert result.field.middle_strength.min() > 0.95 * result.field.middle_strength.max()
    assert not [lines for lines in field_map(result).collections if hasattr(lines, "levels")]
    assert field_deviation(result).has_data()
