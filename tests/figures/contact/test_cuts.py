"""Cuts and sections of point contacts: what is drawn is the result's, where its name says."""

import numpy as np
import pytest

from ehlectric.figures.contact_profiles import Cut
from ehlectric.figures.point_figures import cuts, field_sections, film_cut
from tests.helpers.each import each
from tests.helpers.point_pages import EVERY_KIND, drawn, result_of


@pytest.mark.slow
@pytest.mark.parametrize("along", ["x", "y"])
@EVERY_KIND
def test_cuts_are_of_the_result(kind, along):
    result = result_of(kind)
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


@pytest.mark.slow
def test_smooth_films_are_dotted_beside_rough_ones():
    result = result_of("gaussian")
    dotted = [line for line in film_cut(result).lines if line.get_linestyle() == ":"]
    j = np.argmin(np.abs(result.film.y - result.film.minimum_position[1]))
    np.testing.assert_allclose(dotted[1].get_ydata(), 1e9 * result.smooth.thickness[:, j])
    assert [text.get_text() for text in film_cut(result).get_legend().get_texts()] == ["smooth surfaces"]
    assert film_cut(result_of("circle")).get_legend() is None


@pytest.mark.slow
@EVERY_KIND
def test_lines_are_named_by_where_they_are(kind):
    result = result_of(kind)
    b, (x, y) = result.conditions.semi_axis_x, result.film.minimum_position
    for ax, axis, position in zip(drawn(kind, cuts).figure.axes, "yx", (y, x), strict=False):
        _, centre, least = (text.get_text() for text in ax.get_legend().get_texts())
        assert centre == f"centre, ${axis}/b$ = 0"
        name, number = least.replace("−", "-").split(" = ")
        assert name == f"minimum film, ${axis}/b$"
        assert float(number) == pytest.approx(position / b, rel=6e-3, abs=1e-12)


def test_cuts_pass_at_the_nearest_node():
    x, y = np.linspace(-3.0, 3.0, 4), np.linspace(0.0, 1.0, 11)
    values = x[:, np.newaxis] + y
    for along, position, line in (("x", 0.3, x + 0.3), ("y", 1.0, 1.0 + y)):
        cut = Cut.near(along, (1.4, 0.34), x, y)
        assert cut.position == pytest.approx(position)
        np.testing.assert_allclose(cut.of(values), line)


@each("along", ["x", "y"])
@EVERY_KIND
def test_sections_are_as_high_as_the_film(kind, along):
    """And smooth walls lie alike above and below, however far the film of unequal bodies is bent."""
    result = result_of(kind)
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


@pytest.mark.slow
def test_sections_keep_the_roughness_on_its_surface():
    """Equal bodies of which only surface 1 is rough: the middle of the film is half its height up."""
    result = result_of("gaussian")
    lower, upper = drawn("gaussian", field_sections).lines
    j = np.argmin(np.abs(result.film.y - result.field.max_strength_position[1]))
    x = result.film.x / result.conditions.semi_axis_x
    expected = 0.5e9 * np.interp(upper.get_xdata(), x, result.roughness[0][:, j])
    np.testing.assert_allclose(0.5 * (lower.get_ydata() + upper.get_ydata()), expected, atol=1e-6)
    assert np.ptp(expected) > 20.0
