"""Figures on the narrow pages of a journal: nothing lies over anything else."""

from itertools import pairwise

import numpy as np
import pytest
from matplotlib.text import Text

from ehlectric.figures.film_section import draw_section
from ehlectric.figures.style import figure_of, new_panels, scale_axis, style
from ehlectric.paper import paper_figures


def extents(figure, artists):
    figure.canvas.draw()
    return [artist.get_window_extent(figure.canvas.get_renderer()) for artist in artists]


def widths(panels):
    figure = figure_of(panels[0])
    return tuple(25.4 * figure.get_size_inches())


def test_panels_beside_each_other_stand_below_each_other_in_one_column():
    with style("journal"):
        for rows, columns, size in ((1, 2, (10.0, 3.6)), (2, 2, (10.0, 6.8)), (3, 2, (7.0, 6.6))):
            panels = new_panels(rows, columns, size)
            assert len(panels) == rows * columns
            wide, high = widths(panels)
            assert wide == pytest.approx(84.0)
            assert high <= 234.0
            boxes = extents(figure_of(panels[0]), panels)
            assert all(above.y0 > below.y1 for above, below in pairwise(boxes))
        assert widths(new_panels(4, 3, (10.0, 11.7)))[0] == pytest.approx(174.0), "too high for a page"
    with style("screen"):
        assert widths(new_panels(1, 2, (10.0, 3.6)))[0] == pytest.approx(254.0)


@pytest.mark.parametrize("number", [2, 3])
def test_the_models_of_the_paper_fit_in_a_column(number):
    """No text leaves the page or lies over another one."""
    with style("journal"):
        drawn = paper_figures.FIGURES[number].draw(None)
    assert 25.4 * drawn.get_figwidth() == pytest.approx(84.0)
    texts = [text for text in drawn.axes[0].texts if text.get_text()]
    boxes = extents(drawn, texts)
    assert min(box.x0 for box in boxes) >= 0.0
    assert max(box.x1 for box in boxes) <= drawn.bbox.x1
    over = [
        (one.get_text(), other.get_text())
        for k, (one, box) in enumerate(zip(texts, boxes, strict=True))
        for other, by in list(zip(texts, boxes, strict=True))[:k]
        if box.overlaps(by)
    ]
    assert not over


@pytest.mark.slow
def test_both_titles_of_a_panel_stand_apart():
    """Four sections below each other are as wide as two with a colour bar."""
    with style("journal"):
        panels = new_panels(2, 2, (10.0, 6.8))
        for ax in panels:
            ax.set_title("$V_{12}/h_\\mathrm{min}$ = 11.8 V/µm", loc="right")
            paper_figures._title(ax, "(a) M12L15, $u_1+u_2$ = 8 m/s")
        ax = panels[0]
        left, right = extents(figure_of(ax), (ax._left_title, ax._right_title))
    # The empty line below the left title is no text.
    below = left.height / 2.0 if "\n" in ax._left_title.get_text() else 0.0
    assert right.x0 > left.x1 or left.y0 + below > right.y1 - 0.2 * right.height


@pytest.mark.slow
def test_legends_of_two_panels_lie_in_their_figure():
    with style("journal"):
        panels = new_panels(1, 2, (10.0, 4.6))
        for ax in panels:
            for number in range(4):
                ax.plot([0.0, 1.0], [0.0, 1.0], label=f"M68L13 (M = 69.5), $u_1+u_2$ = {number} m/s")
            paper_figures._legend_of_readings(ax)
        figure = figure_of(panels[0])
        first, second = extents(figure, [ax.get_legend() for ax in panels])
        below = extents(figure, panels[1:])[0]
    assert first.y0 > below.y1
    assert min(first.x0, second.x0, second.y0) >= 0.0
    assert max(first.x1, second.x1) <= figure.bbox.x1


def test_labels_of_a_logarithmic_axis_do_not_touch():
    """At 300 to 24 000 rpm the labels 10000 and 20000 touched on one column of a journal."""
    with style("journal"):
        (ax,) = new_panels(1, 1, (6.3, 3.4))
        speeds = np.geomspace(300.0, 24e3, 30)
        ax.plot(speeds, speeds)
        scale_axis(ax.xaxis, "speed [rpm]", values=speeds, log=True)
        # As much room as the labels at the ends of the curves leave.
        figure_of(ax).set_layout_engine("none")
        ax.set_position((0.12, 0.15, 0.56, 0.7))
        boxes = extents(figure_of(ax), [label for label in ax.get_xticklabels() if label.get_text()])
    assert len(boxes) >= 3
    assert all(one.x1 < other.x0 for one, other in pairwise(boxes))


@pytest.mark.parametrize("name", ["screen", "journal"])
def test_the_enlargement_of_a_section_does_not_lie_on_the_film(name):
    """In one column of a journal, its second line reached the wall of a film that widens to the inlet."""
    x = np.linspace(-1.2, 1.2, 49)
    wall = 130.0 + 300.0 * np.clip(0.3 - x, 0.0, None) ** 2 / 1.5**2
    heights = np.column_stack([-wall, wall])
    with style(name):
        ax = new_panels(2, 1, (6.3, 5.6))[0]
        draw_section(
            ax, x, heights, heights, limits=(-430.0, 430.0), potentials=(-1.0, 1.0), units=(1e-4, 1e-9)
        )
        texts = [text for text in ax.texts if "surface 1" in text.get_text()]
        figure_of(ax).canvas.draw()
        texts += [text for text in ax.findobj(Text) if "heights" in text.get_text()]
        surface, enlarged = extents(figure_of(ax), texts)
        lowest = ax.transData.transform([(-1.2, -430.0)])[0, 1]
    assert enlarged.y1 < lowest - 4.0 * figure_of(ax).dpi / 72.0
    assert enlarged.x1 < surface.x0
