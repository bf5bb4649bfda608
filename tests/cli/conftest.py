from functools import partial

import pytest

from tests.helpers.commands import run_command

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
    return partial(run_command, cwd=tmp_path)


@pytest.fixture
def case_file(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path
