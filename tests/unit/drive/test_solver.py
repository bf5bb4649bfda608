"""Solved drives: what is measured, and what measured sources do."""

import numpy as np
import pytest

from ehlectric.cases.drives.case import ENDS, DriveCase
from ehlectric.drive.discharges.record import FILM, OFF, ON
from ehlectric.drive.result import solve_drive
from ehlectric.drive.solver import solve
from tests.helpers.places import EXAMPLES
from tests.unit.cases.test_drive import TABLE


@pytest.fixture(scope="module")
def case():
    from ehlectric import BearingCase

    bearing = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})
    return DriveCase.from_dict({**TABLE, "drive_end": bearing.to_dict()})


@pytest.mark.parametrize("fundamental", [50.0, 60.0, 61.7])
def test_all_of_the_duration_is_measured(case, fundamental):
    """Also where the carrier has no whole number of periods in one of the fundamental."""
    duration = 0.03
    record = solve(
        case.replace({"source.fundamental_frequency": fundamental, "drive.duration": duration}), workers=1
    ).record
    assert np.sum(record.histogram, axis=1) == pytest.approx(np.full(2, duration), rel=1e-9)
    assert np.all((record.events[:, 0] >= 0.0) & (record.events[:, 0] <= duration))
    assert np.sum(record.counts) == len(record.events)


def test_a_measured_square_wave_is_the_computed_one(case, tmp_path):
    """Voltage across the films of a strong oil: that of the divider."""
    times = np.arange(2001) * 1e-7
    volts = np.where((np.arange(2001) // 250) % 2 == 0, -200.0, 200.0)
    rows = "".join(f"{t:.9e},{v:.6f}\n" for t, v in zip(times, volts, strict=True))
    (tmp_path / "scope.csv").write_text("time (s),voltage (V)\n" + rows)
    table = case.replace({"bearings.discharge.dielectric_strength": "190 V/um"}).to_dict()
    measured = DriveCase.from_dict({**table, "source": {"file": str(tmp_path / "scope.csv")}})
    solution = solve(measured, workers=1)
    assert solution.highest_source == 200.0
    assert solution.record.duration == pytest.approx(2e-4)
    assert solution.record.peak == pytest.approx(200.0 * np.array(solution.divider), rel=1e-3)
    assert len(solution.record.events) == 0


def test_time_with_a_burning_arc_is_that_of_the_discharges(case):
    """Up to those that burn at the begin and at the end."""
    weak = case.replace({"bearings.discharge.dielectric_strength": "5 V/um", "drive.duration": "3 ms"})
    record = solve(weak, workers=1).record
    for b in range(2):
        own = record.events[record.events[:, FILM] == b]
        lasting = own[:, OFF] - own[:, ON]
        assert len(own) > 10
        assert record.burning[b] == pytest.approx(np.sum(lasting), abs=2.0 * np.max(lasting))


def test_an_arc_that_never_recovers_is_told(case):
    """Edges feed it again before its film insulates: there are hardly any discharges to be counted."""
    weak = {"bearings.discharge.dielectric_strength": "5 V/um", "drive.duration": "3 ms"}
    result = solve_drive(case.replace({**weak, "breakdown.recovery_time": "1 ms"}), workers=1)
    shares = [result.summary()[end]["burning_time_share"] for end in ENDS]
    assert max(shares) == pytest.approx(1.0, abs=0.05)
    assert result.summary()["drive"]["events"] < 10
    assert "arc-burns-on" in [warning.code for warning in result.warnings]
