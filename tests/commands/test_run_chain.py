"""Way of a case from ``ehlectric run`` to Newton's method, as ``benchmarks.run_chain`` counts it."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

# Packages of other kinds of files than a contact at rest.
OTHERS = {"bearing", "drive", "motion", "sweep"}

LINE = """
[contact]
reduced_radius = "14.1 mm"
reduced_modulus = "226 GPa"
max_hertz_pressure = "1 GPa"
entrainment_speed = "4 m/s"

[lubricant]
base = "paper"

[discharge]
dielectric_strength = "20 V/um"

[grid]
error = "2 %"
"""


@pytest.fixture(scope="module")
def counts(tmp_path_factory):
    file = tmp_path_factory.mktemp("chain") / "line.toml"
    file.write_text(LINE)
    command = [sys.executable, "-m", "benchmarks.run_chain", file]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.slow
@pytest.mark.gate
def test_a_line_contact_with_figures_loads_no_modules_of_other_kinds(counts):
    assert counts["status"] == 0
    modules = [name.split(".") for name in counts["modules"]]
    assert ["ehlectric", "figures", "line_figures"] in modules
    assert [name for name in modules if OTHERS.intersection(name)] == []
    assert len(modules) <= 220


@pytest.mark.slow
@pytest.mark.gate
def test_newtons_method_is_twelve_functions_below_the_command(counts):
    assert counts["chain"][0] == "__main__.main"
    assert counts["chain"][-1] == "film.newton.newton"
    assert counts["frames"] <= 12


@pytest.mark.slow
@pytest.mark.gate
def test_a_file_is_read_and_its_contact_prepared_once(counts):
    assert (counts["opened"], counts["parsed"], counts["prepared"]) == (1, 1, 1)
