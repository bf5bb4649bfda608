"""Remedies of a drive: both bearings and their sums in every table, and the duty cycle with each remedy."""

from unittest import mock

import numpy as np
import pytest
from scipy.stats import chi2

from ehlectric import load, save, solve_drive
from ehlectric.cases.table_edits import flattened
from ehlectric.drive.run import result_of
from ehlectric.figures.drive_figures import figure
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import DRIVE_KEYS
from ehlectric.tables.drive_tables import remedied, remedy_cells, remedy_rates
from tests.helpers.drives import small_drive

# One bearing is insulated, so that the other one takes its discharges.
INSULATED = {
    "title": "insulated",
    "changes": {
        "drive_end.bearing.element_material": "silicon-nitride",
        "drive_end.bearing.element_capacitance": "40 pF",
    },
}
RING = {"title": "ring", "changes": {"circuit.grounding_ring_resistance": "5 ohm"}}


@pytest.fixture(scope="module")
def drive():
    return solve_drive(small_drive(remedies=[INSULATED, RING]), workers=1)


@pytest.mark.slow
def test_each_remedy_has_the_sums_of_both_bearings(drive):
    summary = drive.summary()
    for one in (summary, *summary["remedies"]):
        both, ends = one["drive"], [one[end] for end in ENDS]
        for key in ("events", "events_per_second", "power"):
            assert both[key] == pytest.approx(sum(end[key] for end in ends), rel=1e-12)
        # The interval contains Garwood's, of a Poisson process with this number of events.
        count, duration = both["events"], summary["drive"]["duration"]
        low = chi2.ppf(0.025, 2 * count) / 2 / duration if count else 0.0
        high = chi2.ppf(0.975, 2 * count + 2) / 2 / duration
        assert both["events_per_second_low"] <= low * (1.0 + 1e-9)
        assert both["events_per_second_high"] >= high * (1.0 - 1e-9)
    keys = {
        f"remedies.{table}.{key}"
        for table in ("drive", *ENDS)
        for key in flattened(summary["remedies"][0][table])
    }
    assert {key for key in keys if "time_above" not in key} <= set(DRIVE_KEYS)


@pytest.mark.slow
@pytest.mark.gate
def test_an_insulated_bearing_does_not_hide_the_other_one(drive):
    """Insulation of one bearing ends its discharges; the other bearing and the sum remain in the table."""
    summary = drive.summary()
    (first, second, *names), *rows = remedy_cells(remedied(summary))
    assert (first, second) == ("mitigation measure", "bearing")
    assert [row[:2] for row in rows] == [
        (title, place)
        for title in ("as it is", "insulated", "ring")
        for place in ("drive end", "non-drive end", "both")
    ]
    rate = 2 + next(k for k, name in enumerate(names) if name.startswith("discharges ["))
    for k, one in enumerate((summary, *summary["remedies"])):
        shown = [float("".join(row[rate].split())) for row in rows[3 * k : 3 * k + 3]]
        expected = [*(one[end]["events_per_second"] for end in ENDS), one["drive"]["events_per_second"]]
        assert shown == pytest.approx(expected, rel=5e-3)
    insulated = summary["remedies"][0]
    assert insulated["drive_end"]["events"] == 0
    assert insulated["non_drive_end"]["events"] > 0
    short = list(remedy_rates(summary))
    assert [row[0] for row in short[1:]] == ["as it is", "insulated", "ring"]
    assert [row[1:] for row in short[1:]] == [
        tuple(row[rate] for row in rows[3 * k : 3 * k + 3]) for k in range(3)
    ]


@pytest.mark.slow
def test_the_figure_of_remedies_has_the_sums(drive):
    (ax, _) = figure(drive, "drive_remedies").axes
    (marks,) = (line for line in ax.get_lines() if line.get_marker() == "D")
    summary = drive.summary()
    expected = [one["drive"]["events_per_second"] for one in (summary, *summary["remedies"])]
    assert marks.get_xdata() == pytest.approx([rate for rate in expected if rate])
    assert "both bearings" in " ".join(text.get_text() for text in ax.get_legend().get_texts())


@pytest.mark.slow
def test_the_cycle_of_a_remedy_is_the_cycle_of_the_changed_drive(tmp_path):
    """Equal to a drive file that has the change itself, in numbers, tables and the saved file."""
    file = tmp_path / "cycle.csv"
    rows = "\n".join(f"{time},{speed}" for time, speed in enumerate([0.0, *np.linspace(1500.0, 4500.0, 20)]))
    file.write_text(f"time [s],speed [rpm]\n{rows}\n")
    changes = {"bearings.bearing.contact_resistance": "10 ohm", "duty": {"file": str(file)}}
    case = small_drive(**changes, remedies=[INSULATED])
    with mock.patch("ehlectric.drive.drive_cycle.SIMULATED", 4):
        result = solve_drive(case, workers=1)
        changed = solve_drive(small_drive(**changes).replace(INSULATED["changes"]), workers=1)
    summary, expected = result.summary(), changed.summary()
    (remedy,) = summary["remedies"]
    assert remedy["duty"] == {key: expected["duty"][key] for key in remedy["duty"]}
    assert remedy["duty"]["discharges"] == sum(remedy[end]["duty_discharges"] for end in ENDS)
    for end in ENDS:
        own = {key: value for key, value in remedy[end].items() if key.startswith("duty_")}
        assert own == {key: value for key, value in expected[end].items() if key.startswith("duty_")}
        assert own
    heads, *cells = remedy_cells(remedied(summary))
    place = next(k for k, head in enumerate(heads) if head.startswith("discharges in the cycle"))
    assert float("".join(cells[5][place].split())) == pytest.approx(remedy["duty"]["discharges"], rel=5e-3)
    (*_, last), *short = remedy_rates(summary)
    assert last == "discharges in the cycle, both"
    assert float("".join(short[1][-1].split())) == pytest.approx(remedy["duty"]["discharges"], rel=5e-3)
    save(result, tmp_path)
    again = load(tmp_path)
    assert again == result
    assert again.summary() == summary
    # A file of version 1.0 has no cycle of a remedy.
    whole = result.to_xarray()
    earlier = whole.drop_vars([name for name in whole.variables if str(name).startswith("remedy_")])
    earlier.attrs = {key: value for key, value in whole.attrs.items() if not key.startswith("remedy_")}
    found = result_of(earlier, tmp_path / "drive.nc")
    assert "duty" not in found.summary()["remedies"][0]
    assert found.summary()["duty"] == summary["duty"]
