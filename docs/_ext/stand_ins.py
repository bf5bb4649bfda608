"""Stand-ins for the figures and tables that take minutes to compute, where pages are built without them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from PIL import Image
from sphinx.application import Sphinx

_MADE: list[Path] = []


def _write(app: Sphinx) -> None:
    """Write a file for every name that a page takes from ``_generated`` and that nothing has written."""
    root = Path(app.srcdir)
    for page in root.rglob("*.md"):
        for name in re.findall(r"_generated/([\w./-]+\.(?:md|png))", page.read_text(encoding="utf-8")):
            path = root / "_generated" / name
            if path.exists():
                continue
            path.parent.mkdir(parents=True, exist_ok=True)
            if path.suffix == ".png":
                Image.new("RGB", (16, 16), "white").save(path)
            else:
                path.write_text("This table is computed by `make docs`.\n", encoding="utf-8")
            _MADE.append(path)


def _remove(_app: Sphinx, _error: Exception | None) -> None:
    """Remove the stand-ins, which no other build may take for results."""
    for path in _MADE:
        path.unlink(missing_ok=True)


def setup(app: Sphinx) -> dict[str, Any]:
    """Written after everything else that is written before Sphinx reads the pages."""
    app.connect("builder-inited", _write, priority=900)
    app.connect("build-finished", _remove)
    return {"parallel_read_safe": True}
