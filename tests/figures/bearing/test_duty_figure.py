"""Figure of a duty cycle: bands of the states between the edges of rows, and the finding in its title."""

import numpy as np
import pytest

from ehlectric import solve_bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.figures.bearing_figure_files import figure
from ehlectric.figures.duty_panels import duty_panels, time_axis
from tests.helpers.bearings import BALLS
from tests.helpers.titles import title_of

# Seconds and rpm: at a standstill, with touching surfaces and with a full film.
ROWS = "0,0\n10,0\n20,30\n30,6000\n40,6000\n"


@pytest.fixture(scope="module")
def result(tmp_path_factory):
    file = tmp_path_factory.mktemp("duty") / "cycle.csv"
    file.write_text(f"time [s],speed [rpm]\n{ROWS}")
    return solve_bearing(BearingCase.from_dict({**BALLS, "contacts": "formula", "duty": {"file": str(file)}}))


@pytest.mark.slow
def test_panels(result):
    speed, ratio, margin = duty_panels(result.duty)
    assert [panel.title for panel in (speed, ratio, margin)] == ["speed", "lambda ratio", "margin"]
    assert speed.curves[-1].y == pytest.approx([0.0, 0.0, 30.0, 6000.0, 6000.0])
    assert np.isnan(ratio.curves[-1].y[:2]).all()
    assert time_axis(result.duty.rows).window == (0.0, 40.0)


@pytest.mark.slow
def test_bands_end_halfway_between_rows(result):
    speed, *_ = duty_panels(result.duty)
    ends = {area.name: area.x[area.within][[0, -1]].tolist() for area in speed.areas}
    assert ends == {"standstill": [0.0, 15.0], "boundary lubrication, λ < 1": [15.0, 25.0]}


@pytest.mark.slow
def test_title_is_the_finding(result):
    found = result.duty.summary()
    first, second, *_ = title_of(figure(result, "bearing_duty"))
    assert first == f"Breakdown expected for {100.0 * found['breakdown_share']:.3g} % of the time"
    assert second.startswith("full film 37.5 %")
