"""Figures on the narrow pages of a journal: nothing lies over anything else."""

from itertools import pairwise

import numpy as np
import pytest

from ehlectric.figures.style import figure_of, new_panels, scale_axis, style
from ehlectric.paper import paper_figures


def extents(figure, artists):
    figure.canvas.draw()
    return [artist.get_window_extent(figure.canvas.get_renderer()) for artist in artists]


@pytest.mark.slow
def test_both_titles_of_a_panel_stand_apart():
    """Three panels beside each other are as wide as two with a colour bar."""
    with style("journal"):
        panels = new_panels(2, 3, (10.0, 6.8))
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
    assert first.x1 < second.x0
    assert min(first.x0, first.y0, second.y0) >= 0.0
    assert second.x1 <= figure.bbox.x1


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
