"""Figures of sweeps over bearings of which some touch: nothing there reads as safe."""

import pytest
from matplotlib.patches import Patch

from ehlectric.figures.sweep_figures import of_slice
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import value_map
from ehlectric.sweep.points import Point
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import select_slice
from tests.helpers.bearings import BALLS, bearing_case

SPEED, TEMPERATURE, MARGIN = "bearing.inner_speed", "bearing.temperature", "bearing.margin"
SPEEDS, TEMPERATURES = (100.0, 200.0, 400.0), (330.0, 340.0, 350.0)


@pytest.fixture
def rough():
    """Nine bearings; at 350 K the two slowest touch, and so does the slowest at 340 K."""
    rows = []
    for speed in SPEEDS:
        for temperature in TEMPERATURES:
            touches = (speed, temperature) in {(100.0, 350.0), (200.0, 350.0), (100.0, 340.0)}
            voltages = {"first_break": None, "margin": None, "shaft_voltage": None}
            if not touches:
                voltages = {"first_break": speed / 25.0, "margin": speed / 100.0, "shaft_voltage": 4.0}
            state = "conducting" if touches else "full film"
            table = {"bearing": voltages | {"lubrication": state}}
            rows.append(Point(len(rows), {SPEED: speed, TEMPERATURE: temperature}, "solved", summary=table))
    axes = {SPEED: SPEEDS, TEMPERATURE: TEMPERATURES}
    return SweepResults(bearing_case(BALLS), "grid", axes, {}, 0, tuple(rows))


def shaded(ax, x, y):
    """Whether a hatched area lies over a place, in the units of the axes."""
    return any(
        path.contains_point((x, y))
        for found in ax.collections
        if getattr(found, "hatches", [None]) == ["xxx"]
        for path in found.get_paths()
    )


def test_a_map_shades_where_contacts_open(rough):
    ax = value_map(rough, SPEED, TEMPERATURE, MARGIN)
    rpm = 30.0 / 3.14159265
    for speed, kelvin, there in ((120.0, 345.0, True), (150.0, 335.0, True), (300.0, 335.0, False)):
        assert shaded(ax, speed * rpm, kelvin - 273.15) == there
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert "3 frequent asperity contact: no voltage computed" in texts
    assert "frequent asperity contact there or nearby: discharges likely, no voltage computed" in texts
    assert any(isinstance(found, Patch) and found.get_hatch() for found in ax.get_legend().legend_handles)


def test_lines_mark_where_contacts_open(rough):
    ax = value_lines(rough, SPEED, TEMPERATURE, MARGIN)
    assert sum(len(line.get_xdata()) for line in ax.lines if line.get_marker() == "X") == 3


def test_the_title_says_how_many_touch(rough):
    text = of_slice(rough, select_slice(rough, SPEED, TEMPERATURE, MARGIN))
    assert text.startswith("No breakdown expected at all 6 points with a voltage: ")
    assert text.endswith("; at 3 more, asperity contact is frequent, discharges are likely")
