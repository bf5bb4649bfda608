"""Sketches of the theory pages, drawn before every build: contact, grooves, circuit, oil laws, supply."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure
from sphinx.application import Sphinx

from sketches.breakdown import two_steps
from sketches.circuit import circuit
from sketches.contact import line_contact, point_contact
from sketches.groove import groove
from sketches.laws import laws
from sketches.supply import supply

SKETCHES: dict[str, Callable[[], Figure]] = {
    "line_contact": line_contact,
    "point_contact": point_contact,
    "groove": groove,
    "circuit": circuit,
    "breakdown": two_steps,
    "laws": laws,
    "supply": supply,
}
# The same bytes at every build, and a light ground that also reads on a dark page.
_SVG = {"svg.hashsalt": "ehlectric", "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans"}


def draw(folder: Path, *, suffix: str = "svg") -> None:
    """Write every sketch into a folder as sketch_NAME.svg."""
    with mpl.rc_context(_SVG):
        for name, sketch in SKETCHES.items():
            metadata = {"Date": None} if suffix == "svg" else None
            sketch().savefig(
                folder / f"sketch_{name}.{suffix}", facecolor="white", metadata=metadata, dpi=160
            )


def _write(app: Sphinx) -> None:
    folder = Path(app.srcdir) / "_generated"
    folder.mkdir(exist_ok=True)
    draw(folder)


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
