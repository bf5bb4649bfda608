"""The option --measured of the bearing and run commands, as a user types it."""

import json

import pytest

BEARING = """\
title = "Axial"
contacts = "formula"
[bearing]
base = "6208"
radial_clearance = "10 um"
axial_load = "500 N"
inner_speed = "3000 rpm"
temperature = "70 degC"
composite_rq = "0.03 um"
[lubricant]
base = "paper"
viscosity = "20 mPa s"
"""
BALL = """\
[contact]
geometry = "point"
radius_x = "10 mm"
radius_y = "10 mm"
reduced_modulus = "226 GPa"
load = "20 N"
entrainment_speed = "1 m/s"
[lubricant]
base = "paper"
[grid]
nodes = 65
"""
DATA = "# by hand\nspeed [rpm];capacitance [pF];remark\n1500;205,0;a\n3000;160,0;b\n6000;2;c\n"


@pytest.fixture
def files(tmp_path):
    (tmp_path / "bearing.toml").write_text(BEARING)
    (tmp_path / "ball.toml").write_text(BALL)
    (tmp_path / "data.csv").write_text(DATA)
    (tmp_path / "log.csv").write_text("entrainment speed [m/s],film [nm]\n0.5,160\n1,250\n")
    return tmp_path


@pytest.mark.slow
def test_a_bearing_is_solved_and_compared(ehlectric, files):
    done = ehlectric("bearing", "bearing.toml", "--measured", "data.csv", "--uncertainty", "2 %", "-o", "out")
    assert done.returncode == 0, done.stderr
    assert "mean film factor" in done.stdout
    assert "1 of 3 rows have no film factor: line 5 (" in done.stderr
    assert "data.csv: not used: remark. Rename" in done.stderr
    out = files / "out"
    assert {"summary.json", "bearing.nc", "measured.json", "measured.csv"} < {p.name for p in out.iterdir()}
    assert (out / "measured_and_computed.png").read_bytes()[:4] == b"\x89PNG"
    summary = json.loads((out / "measured.json").read_text(), parse_constant=pytest.fail)
    assert (summary["rows"], summary["rows_with_factor"]) == (3, 2)
    again = ehlectric("bearing", "bearing.toml", "-o", "out", "--no-plots")
    assert again.returncode == 0
    assert not [path.name for path in out.iterdir() if path.name.startswith("measured")]


@pytest.mark.slow
def test_a_contact_is_compared_with_a_log(ehlectric, files):
    done = ehlectric("run", "ball.toml", "--measured", "log.csv", "-o", "out", "--json")
    assert done.returncode == 0, done.stderr
    printed = json.loads(done.stdout, parse_constant=pytest.fail)
    assert printed["measured"] == json.loads((files / "out" / "measured.json").read_text())
    assert printed["measured"]["film_factor"]["basis"] == "scatter only"
    assert "only the scatter" in done.stderr
    assert "scatter-only" in printed["measured"]["warning_codes"]
