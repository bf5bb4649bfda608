"""Polar panels of a bearing have room for long titles and legends."""

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from ehlectric.bearing.result import solve_bearing
from ehlectric.figures.bearing_figure_files import figure
from tests.helpers.bearings import BALLS, bearing_case


@pytest.mark.slow
def test_titles_and_legends_stay_in_the_figure():
    """At 60 rpm asperities are in contact: title and legend of the films need more room."""
    heights = []
    for speed in ("3000 rpm", "60 rpm"):
        title = "Ball bearing in a drive"
        case = bearing_case(BALLS, contacts="atlas", title=title, bearing__inner_speed=speed)
        drawn = figure(solve_bearing(case), "bearing_loads.png")
        canvas = FigureCanvasAgg(drawn)
        canvas.draw()
        renderer, lowest = canvas.get_renderer(), drawn.bbox.y1
        for ax in drawn.axes:
            assert ax.get_legend().get_window_extent(renderer).y0 >= 0.0
            lowest = min(lowest, drawn._suptitle.get_window_extent(renderer).y0)
            assert ax.title.get_window_extent(renderer).y1 <= lowest
        heights.append(drawn.get_figheight())
    assert heights[1] > heights[0]
