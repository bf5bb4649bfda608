"""Numbers of the guide about fits, from the file that it prints."""

import re
import tomllib

import pytest
from docs import pages

from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.tables.bearing_tables import input_rows
from tests.helpers.places import ROOT


def test_the_example_of_the_guide_has_the_numbers_of_the_guide():
    page = pages.page("bearing_file.md")
    section = page.partition("(bearing-fits)=")[2].partition("## \\[bearing.pair\\]")[0]
    (table,) = re.findall(r"^```toml\n(.*?)^```", section, flags=re.S | re.M)
    (printed,) = re.findall(r"^```text\n(.*?)^```", section, flags=re.S | re.M)
    rest = BearingCase.from_toml(ROOT / "examples" / "bearing_6208.toml").to_dict()
    warm = BearingCase.from_dict(rest | {"contacts": "formula"} | tomllib.loads(table))
    cold = warm.replace({"bearing.inner_ring_temperature": None})
    summaries = [summary_of(solve_bearing(case, workers=1).solution) for case in (warm, cold)]
    lines = [" ".join(line.split()) for line in printed.splitlines()]
    rows = [f"{row.name} {row.text}" for row in input_rows(summaries[0]) if "clearance" in row.name]
    assert rows == lines
    totals = summaries[0]["bearing"]
    fit = totals["unmounted_clearance"] - totals["mounted_clearance"]
    warmth = totals["mounted_clearance"] - totals["running_clearance"]
    # The comments name the runs of the numbers; a reader does not see them.
    text = " ".join(re.sub(r"<!--.*?-->", "", section).split())
    assert f"The fit takes {1e6 * fit:.3g} µm, {100.0 * fit / 13.5e-6:.0f} % of the interference" in text
    assert f"the temperatures take another {1e6 * warmth:.3g} µm" in text
    breaks = [summary["bearing"]["first_break"] for summary in summaries]
    assert f"is at {breaks[0]:.2f} V, and at {breaks[1]:.2f} V without the difference" in text
    given = cold.replace({"bearing.radial_clearance": totals["running_clearance"]})
    alone = summary_of(solve_bearing(given, workers=1).solution)["bearing"]["first_break"]
    assert alone == pytest.approx(breaks[1], rel=0.02)
    viscosities = summaries[0]["lubricant"]["inner_viscosity"] / summaries[0]["lubricant"]["viscosity"]
    assert 1.0 - viscosities == pytest.approx(1.0 / 3.0, abs=0.03)
    films = [min(row["minimum_thickness"] for row in each["contacts"]) for each in summaries]
    assert 1.0 - films[0] / films[1] == pytest.approx(0.25, abs=0.05)
