"""What the guide to a whole bearing prints, as a user runs it."""

import re
import subprocess
import sys

import pytest
from docs import pages

from ehlectric.bearing.result import solve_bearing
from tests.helpers.bearings import ROLLERS, bearing_case
from tests.helpers.places import ROOT


@pytest.mark.slow
def test_the_script_of_the_guide_runs_as_a_file(tmp_path):
    """Interference presses all rollers nearly alike: few contacts to solve, and yet in several processes."""
    page = pages.page("python_bearings.md")
    (script,) = pages.blocks(page, "python")
    (named,) = re.findall(r'from_toml\("(.*?)"\)', script)
    assert (ROOT / named).is_file()
    changes = {"bearing__radial_clearance": "-20 um", "bearing__radial_load": "1 N"}
    case = bearing_case(ROLLERS, **changes)
    (tmp_path / named).parent.mkdir()
    (tmp_path / named).write_text(case.to_toml(), encoding="utf-8")
    (tmp_path / "script.py").write_text(script, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True, timeout=600
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    result = solve_bearing(case, workers=1)
    expected = result.capacitance("oil"), result.breaks()["first_break"]
    assert [float(text) for text in done.stdout.split()] == pytest.approx(expected, rel=1e-6, abs=0.0)
