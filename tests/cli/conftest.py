import subprocess
import sys
from pathlib import Path

import pytest

COMMAND = Path(sys.executable).with_name("ehlectric")

CASE = """\
title = "Test"
[contact]
reduced_radius = "14.1 mm"
reduced_modulus = "226 GPa"
max_hertz_pressure = "1 GPa"
entrainment_speed = "2 m/s"
[lubricant]
base = "paper"
[grid]
nodes = 801
"""


@pytest.fixture
def ehlectric(tmp_path):
    """The command as a user types it, in an empty folder."""

    def run(*arguments):
        return subprocess.run(
            [COMMAND, *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True, timeout=120
        )

    return run


@pytest.fixture
def case_file(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path
