"""Figures: what they show and that they take the axes they are given."""

import pytest
from matplotlib.figure import Figure

from ehlectric.figures import line_figures as plot
from tests.helpers.each import each


@pytest.mark.slow
@each("name", plot.FIGURES)
def test_figures_have_labels_with_units(paper_result, name):
    ax = plot.FIGURES[name](paper_result)
    assert ax.get_xlabel() == "$x/b$   ($b$ = 499.4 µm)"
    assert any(unit in ax.get_ylabel() for unit in ("[GPa]", "[µm]", "[V/µm]", "[‰]"))


@each("name", plot.FIGURES)
def test_figures_draw_on_given_axes(paper_result, name):
    ax = Figure().subplots()
    assert plot.FIGURES[name](paper_result, ax) is ax
    assert ax.has_data()


def test_shaded_zone_is_the_high_field_zone(paper_result):
    ax = plot.field_profiles(paper_result)
    (zone,) = ax.patches
    b = paper_result.conditions.half_width
    assert zone.get_width() * b == pytest.approx(paper_result.field.high_field_width, rel=1e-9, abs=0.0)
