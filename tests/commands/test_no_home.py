"""Drives of a user without a home, whose package cannot be written to: no compiled functions can be kept."""

import pytest

from tests.commands.test_drive_command import SHORT
from tests.helpers.no_home import package_without_folders, run_without_home
from tests.helpers.places import EXAMPLES


@pytest.mark.slow
def test_every_command_of_drives_works_and_the_simulation_says_it_once(tmp_path):
    packages = package_without_folders(tmp_path)
    (tmp_path / "bearing.toml").write_text((EXAMPLES / "bearing_6208.toml").read_text("utf-8"), "utf-8")
    (tmp_path / "drive.toml").write_text(SHORT)
    for words, lines in (
        (("check", "drive.toml"), 0),
        (("spice", "drive.toml", "-o", "drive.lib"), 0),
        (("drive", "drive.toml", "--no-plots"), 1),
        (("app", "--help"), 0),
    ):
        done = run_without_home(*words, packages=packages, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        assert "Traceback" not in done.stderr
        assert done.stderr.count("NUMBA_CACHE_DIR") == lines
