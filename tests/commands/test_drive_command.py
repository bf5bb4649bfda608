"""The command that simulates a drive: its tables, its files, its remedies, and what it refuses."""

import csv
import json

import numpy as np
import pytest

from ehlectric.figures.figure_names import (
    DRIVE_DUTY_FIGURE,
    DRIVE_FIGURE_FILES,
    DRIVE_FORCES_FIGURE,
    in_formats,
)
from tests.cases.test_drive import FILE
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES
from tests.helpers.readable import grouped
from tests.helpers.reports import Page

SHORT = FILE.replace(
    'speed = "1500 rpm"', 'speed = "1500 rpm"\ncontacts = "formula"\nduration = "20 ms"\nseed = 4'
)
SHORT = SHORT.replace('recovery_time = "100 ns"', 'recovery_time = "100 ns"\nweibull_shape = 5')
REMEDY = """
[[remedies]]
title = "Ceramic"
[remedies.changes]
"bearings.bearing.element_material" = "silicon-nitride"
"bearings.bearing.element_capacitance" = "5 pF"
"""


WITHOUT_CYCLE = [file for file in DRIVE_FIGURE_FILES if file not in (DRIVE_DUTY_FIGURE, DRIVE_FORCES_FIGURE)]


@pytest.fixture
def drive(tmp_path):
    (tmp_path / "bearing.toml").write_text((EXAMPLES / "bearing_6208.toml").read_text("utf-8"), "utf-8")
    path = tmp_path / "drive.toml"
    path.write_text(SHORT)
    return path


@pytest.mark.slow
@pytest.mark.gate
def test_a_drive_and_its_remedy(ehlectric, drive, tmp_path):
    drive.write_text(SHORT + REMEDY)
    done = ehlectric("drive", "drive.toml", "-o", "out", "--format", "svg")
    assert done.returncode == 0, done.stderr
    written = {path.name for path in (tmp_path / "out").iterdir()}
    figures = in_formats(WITHOUT_CYCLE, ["svg"])
    assert written == {"summary.json", "events.csv", "spectrum.csv", "drive.nc", *figures}
    for text in ("drive end", "non-drive end", "discharges per second", "as it is", "Ceramic"):
        assert text in done.stdout
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    for end in ("drive_end", "non_drive_end"):
        found = summary[end]
        assert found["events"] > 100
        low, high = found["events_per_second_low"], found["events_per_second_high"]
        assert low < found["events_per_second"] < high
        assert 0.5 * found["breakdown_voltage"] < found["voltage_mean"] < 1.5 * found["breakdown_voltage"]
        assert 0.0 < found["waveform_ratio"] <= 2.0 * found["voltage_ratio"]
        (remedy,) = summary["remedies"]
        assert remedy[end]["events"] == 0
        assert remedy[end]["breakdown_voltage"] is None
    with (tmp_path / "out" / "events.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == summary["drive"]["events"]
    times = [float(row["time [s]"]) for row in rows]
    assert times == sorted(times)
    assert 0.0 <= times[0] <= times[-1] <= 0.02
    with (tmp_path / "out" / "spectrum.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert float(rows[1]["frequency [Hz]"]) == pytest.approx(1.0 / 0.02)
    assert float(rows[-1]["frequency [Hz]"]) == pytest.approx(1e7)
    # Parseval's equation; edges of 100 ns have a part of their voltage above 10 MHz.
    squares = np.square([float(row["shaft_voltage [V]"]) for row in rows])
    assert 0.9 < np.sqrt(squares[0] + 0.5 * np.sum(squares[1:])) / found["rms_voltage"] < 1.0


@pytest.mark.slow
def test_a_stored_drive_is_drawn_again(ehlectric, drive, tmp_path):
    assert ehlectric("drive", drive, "-o", "out", "-q", "--no-plots").returncode == 0
    assert not list((tmp_path / "out").glob("*.png"))
    done = ehlectric("plot", "out")
    assert done.returncode == 0, done.stderr
    drawn = sorted(path.name for path in (tmp_path / "out").glob("*.png"))
    assert drawn == sorted(set(WITHOUT_CYCLE) - {"drive_remedies.png"})


@pytest.mark.slow
def test_a_stored_drive_has_a_report(ehlectric, drive, tmp_path):
    """As a page and on paper, with the numbers of summary.json; a damaged file is refused."""
    drive.write_text(SHORT + REMEDY)
    assert ehlectric("drive", "drive.toml", "-o", "out", "-q", "--no-plots").returncode == 0
    done = ehlectric("report", "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "written to out:\n  report.html, report.pdf\n"
    page = Page((tmp_path / "out" / "report.html").read_text("utf-8"))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    numbers = [grouped(summary[end]["events_per_second"]) for end in ("drive_end", "non_drive_end")]
    rates = f"discharges per second {' '.join(numbers)} 1/s".replace("\xa0", " ")
    for text in ("Discharges expected", rates, "Ceramic"):
        assert text in page.text, text
    assert len(page.of("img")) == len(WITHOUT_CYCLE)
    assert (tmp_path / "out" / "report.pdf").read_bytes().startswith(b"%PDF")
    file = tmp_path / "out" / "drive.nc"
    file.write_bytes(file.read_bytes()[:5000])
    done = ehlectric("report", "out")
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert "drive.nc" in done.stderr


@pytest.mark.slow
def test_a_seed_repeats_every_file(ehlectric, drive, tmp_path):
    for name in ("one", "two"):
        assert ehlectric("drive", drive, "-o", name, "-q", "--no-plots").returncode == 0
    one, two = ((tmp_path / name / "events.csv").read_bytes() for name in ("one", "two"))
    assert one == two


@each(
    "old, new, message",
    [
        ('file = "bearing.toml"', 'file = "no.toml"', "drive_end.file, no.toml: cannot be read"),
        ('modulation = "sinusoidal"', 'modulation = "sine"', "source.modulation: got 'sine'"),
        (
            'current = "10 mA"',
            'current = "10 A"',
            "breakdown.extinction_current: got 10 A through",
        ),
        (
            "[breakdown]",
            'grounding_ring_table = { speed = ["9 rpm", "0 rpm"], resistance = [5, 1] }\n[breakdown]',
            "circuit.grounding_ring_table.speed: got",
        ),
        ('.toml"', '.toml"\nbearing.composite_rq = "1 um"', "drive_end.bearing.contact_resistance: missing"),
    ],
)
def test_what_cannot_be_simulated_is_refused(typed, drive, tmp_path, old, new, message):
    drive.write_text(SHORT.replace(old, new))
    done = typed("drive", "drive.toml", "-o", "out")
    assert done.returncode == 2, done.stderr
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out" / "summary.json").exists()
