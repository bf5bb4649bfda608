"""The command that writes a bearing as a netlist, and what ngspice makes of its files."""

import pytest

from ehlectric import BearingCase, solve_bearing
from tests.commands.test_mistakes_commands import BEARING
from tests.helpers.ngspice import run_netlist

DRIVE = 'switching_frequency = "10 kHz"\nrise_time = "0.2 us"\n'
ARC = ("--arc-resistance", "1 ohm", "--extinction-voltage", "1 V")


@pytest.fixture
def bearing(tmp_path):
    path = tmp_path / "bearing.toml"
    path.write_text(BEARING + DRIVE)
    return path


@pytest.mark.slow
@pytest.mark.gate
def test_a_bearing_and_its_bench_are_written(ehlectric, bearing, tmp_path):
    """The shaft voltage of the bench is that of the solved bearing."""
    (tmp_path / "sim").mkdir()
    done = ehlectric("spice", "bearing.toml", "-o", "film.lib", "--bench", "sim/bench.cir", *ARC)
    assert done.returncode == 0, done.stderr
    for text in ("bearing_6208 shaft housing", "C_films", "V_ext", "film.lib", "bench.cir"):
        assert text in done.stdout
    assert "note: the switch closes at the ring-to-ring breakdown voltage" in done.stderr
    assert "warning: the contacts use film-thickness formulas" in done.stderr
    assert '.include "../film.lib"' in (tmp_path / "sim" / "bench.cir").read_text()
    shaft = solve_bearing(BearingCase.from_toml(bearing), workers=1).shaft_voltage
    found = run_netlist(tmp_path / "sim" / "bench.cir")
    assert found["shaft_peak_to_peak"] == pytest.approx(2.0 * shaft, rel=1e-4)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.usefixtures("bearing")
def test_a_table_over_speed_is_written(ehlectric, tmp_path):
    done = ehlectric("spice", "bearing.toml", "--speeds", "1500 rpm : 6000 rpm : 3", "--bench", "bench.cir")
    assert done.returncode == 0, done.stderr
    for text in ("speed 3000 rpm", "at 1500 rpm", "at 6000 rpm"):
        assert text in " ".join(done.stdout.split())
    text = (tmp_path / "bearing.lib").read_text()
    assert "+ speed=3000 ; rpm" in text
    assert "n_4" not in text  # the middle of the range is the speed of the file
    assert run_netlist(tmp_path / "bench.cir")["common_mode_peak_to_peak"] == pytest.approx(600.0)


@pytest.mark.slow
@pytest.mark.usefixtures("bearing")
def test_nothing_is_said_when_quiet_and_files_are_replaced(ehlectric, tmp_path):
    for _ in range(2):
        done = ehlectric("spice", "bearing.toml", "-q")
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bearing.lib", "bearing.toml"]


@pytest.mark.slow
@pytest.mark.gate
def test_a_drive_is_written_with_its_inverter(ehlectric, tmp_path):
    """Both bearings, the arc of the drive, and a bench with its source and its circuit."""
    assert ehlectric("init", "drive.toml", "--kind", "drive", "--no-schema").returncode == 0
    done = ehlectric("spice", "drive.toml", "--contacts", "formula", "-o", "b.lib", "--bench", "bench.cir")
    assert done.returncode == 0, done.stderr
    for text in ("bearing_6208 shaft housing", "V_ext 100 mV", "R_arc 10 Ω", "b.lib, bench.cir"):
        assert text in " ".join(done.stdout.split())
    assert run_netlist(tmp_path / "bench.cir")["winding_peak_to_peak"] == pytest.approx(560.0, rel=1e-6)
    for words in (ARC[:2], ARC[2:], ("--speeds", "500 rpm")):
        done = ehlectric("spice", "drive.toml", *words)
        assert done.returncode == 2
        assert done.stderr.startswith(f"error: {words[0]}: got it with a drive file; expected ")


@pytest.mark.slow
def test_a_drive_without_its_bench_says_so(ehlectric):
    """Inverter and motor, for which a drive file is taken, stand in the bench alone."""
    assert ehlectric("init", "drive.toml", "--kind", "drive", "--no-schema").returncode == 0
    without = ehlectric("spice", "drive.toml", "--contacts", "formula", "-o", "b.lib")
    assert "--bench" in without.stderr
