"""Figures of an oil of the library, which the guide shows."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

from ehlectric.cases.oil_report import oil_report
from ehlectric.figures.oil_figures import save_oil
from ehlectric.runtime.files import prepare


def _write(app: Sphinx) -> None:
    """Draw the figures of the command ``oil`` for an oil whose law is capped in the range shown."""
    folder = prepare(Path(app.srcdir) / "_generated" / "oil_n100")
    save_oil(oil_report("n100", ["40 degC", "90 degC"], ["1 GPa"]), folder)


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
