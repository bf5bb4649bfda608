"""The command of a user who has no home and may not write into the package, such as that of a service."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import ehlectric

# Time after which a command that hangs is killed [s].
_PATIENCE = 900.0


def package_without_folders(folder):
    """Copy of the package in a folder, in which no compiled functions can be kept; its parent.

    Permissions do not bind root: a file is where the folder would be.
    """
    copy = folder / "packages" / "ehlectric"
    source = Path(ehlectric.__file__).parent
    shutil.copytree(source, copy, ignore=shutil.ignore_patterns("__pycache__"))
    (copy / "drive" / "discharges" / "__pycache__").touch()
    return copy.parent


def without_home(packages):
    """Environment of a user whose home cannot be made, not by root either, with such a package."""
    # Matplotlib says itself that it has no folder.
    own = {"HOME": "/proc/none", "PYTHONPATH": str(packages), "MPLCONFIGDIR": str(packages / "matplotlib")}
    return own | {"NUMBA_CACHE_DIR": ""}


def run_without_home(*words, packages, cwd):
    """Run the command of such a package in a folder, as a user without a home."""
    return subprocess.run(
        [sys.executable, "-B", "-m", "ehlectric", *map(str, words)],
        env=os.environ | without_home(packages),
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=_PATIENCE,
        check=False,
    )
