"""A discharge as a user asks for it: rows of the table, summary.json, a result that is read back."""

import json

import pytest

from ehlectric import load
from tests.commands.conftest import CASE

DISCHARGE = """\
[discharge]
dielectric_strength = "15 V/um"
conductivity = "1 pS/m"
external_capacitance = "1 nF"
length = "10 mm"
outlet = "fingers"
"""


@pytest.mark.slow
def test_run_with_a_discharge(ehlectric, case_file, tmp_path):
    case_file.write_text(CASE + DISCHARGE)
    done = ehlectric("run", case_file, "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    for text in (
        "breakdown voltage",
        "V, at 15 V/µm",
        "/ parallel plates",
        "nF/m, filling: fingers",
        "relaxation",
    ):
        assert text in " ".join(done.stdout.split())
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    found, film = summary["discharge"], summary["film"]
    assert summary["inputs"]["discharge"]["external_capacitance"] == 1e-9
    # V/h_min is the largest field to 1e-3.
    assert found["breakdown_voltage"] == pytest.approx(15e6 * film["minimum_thickness"], rel=1e-3, abs=0.0)
    assert f"{found['breakdown_voltage']:.4g}" in done.stdout
    together = 0.01 * found["capacitance"] + 1e-9
    assert found["discharge_energy"] == pytest.approx(0.5 * together * 2.0**2, rel=1e-12, abs=0.0)
    assert load(tmp_path / "out" / "result.nc").summary() == summary


def test_wrong_discharge_is_one_line(typed, case_file, tmp_path):
    case_file.write_text(CASE + DISCHARGE.replace('length = "10 mm"', ""))
    done = typed("run", case_file, "-o", "out")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert done.stderr.startswith("error: discharge.length: missing")
    assert "external_capacitance" in done.stderr
    assert not (tmp_path / "out").exists()
