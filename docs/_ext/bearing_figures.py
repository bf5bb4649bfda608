"""Figures of the bearing of the examples, which the landing page and the guide show."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

import ehlectric

_SHOWN = ("breakdown_over_speed.png", "bearing_loads.png", "bearing_circuit.png")


def _write(app: Sphinx) -> None:
    """Run the command as a user does, where the code or the example is newer than the figures."""
    root = Path(app.srcdir).parent
    example, folder = (
        root / "examples" / "bearing_6208.toml",
        Path(app.srcdir) / "_generated" / "bearing_6208",
    )
    sources = [example, *Path(ehlectric.__file__).parent.rglob("*.py")]
    newest = max(path.stat().st_mtime for path in sources)
    if all((folder / name).exists() and (folder / name).stat().st_mtime > newest for name in _SHOWN):
        return
    shutil.rmtree(folder, ignore_errors=True)
    command = [sys.executable, "-m", "ehlectric", "bearing", str(example), "-o", str(folder), "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    missing = [name for name in _SHOWN if not (folder / name).exists()]
    if done.returncode or missing:
        raise ExtensionError(f"figures of the bearing {missing}: status {done.returncode}, {done.stderr}")


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
