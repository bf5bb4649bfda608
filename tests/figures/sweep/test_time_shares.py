"""Maps and lines of the share of time in which contacts short a bearing."""

import math

import matplotlib.pyplot as plt
import numpy as np
import pytest

from ehlectric.figures.sweep_figures import of_slice
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import value_map
from ehlectric.figures.sweep_panels import TIME_SHARES, quantile_of, share_of
from ehlectric.sweep.points import Point
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import select_slice
from tests.helpers.bearings import BALLS, bearing_case

SPEED, TEMPERATURE, SHARE = "bearing.inner_speed", "bearing.temperature", "bearing.contact_time_share"
SPEEDS, TEMPERATURES = tuple(np.geomspace(10.0, 1000.0, 9).tolist()), (330.0, 350.0)
RPM = 30.0 / math.pi


def share_at(speed):
    """Share of time of one element with equal contacts, lambda = 1 at 100 rad/s and a power of the speed."""
    return math.erfc((speed / 100.0) ** 0.67) ** 2


@pytest.fixture
def results():
    rows = []
    for speed in SPEEDS:
        for temperature in TEMPERATURES:
            table = {"bearing": {"contact_time_share": share_at(speed), "lubrication": "partial film"}}
            if speed < 100.0:
                table |= {"warnings": ["thin"], "warning_codes": ["partial-film"]}
            inputs = {SPEED: speed, TEMPERATURE: temperature}
            rows.append(Point(len(rows), inputs, "solved", summary=table))
    axes = {SPEED: SPEEDS, TEMPERATURE: TEMPERATURES}
    return SweepResults(bearing_case(BALLS), "grid", axes, {}, 0, tuple(rows))


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def crossing(share):
    """Speed at which the bearing above has a share of time, by bisection."""
    low, high = 1e-3, 1e4
    for _ in range(200):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if share_at(middle) > share else (low, middle)
    return low


def test_quantiles_keep_shares_far_below_and_near_one():
    shares = np.array([1e-200, 1e-9, 0.01, 0.5, 0.999999])
    np.testing.assert_allclose(share_of(quantile_of(shares)), shares, rtol=1e-9)
    assert np.all(np.isfinite(quantile_of(np.array([0.0, 1.0]))))


def test_lines_of_a_map_are_where_the_shares_are(results):
    ax = value_map(results, SPEED, TEMPERATURE, SHARE)
    (lines,) = [
        found
        for found in ax.collections
        if found.get_facecolor().size == 0 and getattr(found, "levels", np.empty(0)).size in (3, 4)
    ]
    shown = {}
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):
        if path.vertices.size:
            shown[round(float(share_of(level)), 6)] = path.vertices[:, 0]
    assert set(shown) >= {0.01, 0.1, 0.5}
    for share, speeds in shown.items():
        # Nine speeds in two decades: between them the quantile is linear over the logarithm of the speed.
        np.testing.assert_allclose(speeds, crossing(share) * RPM, rtol=0.06)
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert "capacitive: contacts short it at most 1 % of the time" in texts
    assert "resistive: more than 99 %" in texts
    assert not any("less accurate" in text for text in texts)
    assert {"1 %", "10 %", "50 %"} <= {text.get_text() for text in ax.texts}


def test_the_curve_between_points_is_close_to_the_law(results):
    ax = value_lines(results, SPEED, TEMPERATURE, SHARE)
    assert ax.get_yscale() == "linear"
    curve = max(ax.lines, key=lambda line: len(line.get_xdata()))
    x, y = (np.asarray(data) for data in curve.get_data())
    law = np.array([share_at(one / RPM) for one in x])
    assert np.max(np.abs(y - law)) < 0.02


def test_the_title_names_the_ends(results):
    text = of_slice(results, select_slice(results, SPEED, TEMPERATURE, SHARE))
    assert (
        text == f"Contacts short the bearing less than 0.01 % to {100.0 * share_at(10.0):.3g} % of the time"
    )


def test_all_shares_of_time_are_drawn_like_this():
    from ehlectric.quantities.results import BEARING_KEYS, GEAR_KEYS

    assert all(key in BEARING_KEYS or key in GEAR_KEYS for key in TIME_SHARES)
