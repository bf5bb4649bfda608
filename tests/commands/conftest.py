import subprocess
import sys
from functools import partial

import pytest

from ehlectric.commands.command_line import exit_status
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
def typed(tmp_path, monkeypatch, capsys):
    """The command in this process, in an empty folder: quick where it computes little."""
    monkeypatch.chdir(tmp_path)

    def run(*words):
        words = [str(word) for word in words]
        capsys.readouterr()
        with monkeypatch.context() as patch:
            patch.setattr(sys, "argv", ["ehlectric", *words])
            try:
                status = exit_status()
            except SystemExit as stopped:
                status = stopped.code
        output, errors = capsys.readouterr()
        return subprocess.CompletedProcess(words, status, output, errors)

    return run


@pytest.fixture
def case_file(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path
