"""Figures and tables of the page on measurements, drawn from the data files and functions of the tests."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from sphinx.application import Sphinx

import ehlectric

ROOT = Path(__file__).parents[3]
if str(ROOT) not in sys.path:
    sys.path.insert(0, str(ROOT))

from measured_figures.breakdown import bearing_breakdown  # noqa: E402
from measured_figures.capacitances import ball_on_steel, chromium_disc, equation_of_state  # noqa: E402
from measured_figures.dent import dent_in_rolling, slow_dent  # noqa: E402
from measured_figures.films import fva_3, shc_320, thin_films  # noqa: E402

Rows = Iterable[Iterable[str]]
Drawn = tuple[Figure, list[str], Rows]

# Each draws a figure, and gives the head and the rows of its table.
FIGURES: dict[str, Callable[[], Drawn]] = {
    "fva_3": fva_3,
    "thin_films": thin_films,
    "shc_320": shc_320,
    "ball_on_steel": ball_on_steel,
    "chromium_disc": chromium_disc,
    "dent_in_rolling": dent_in_rolling,
    "slow_dent": slow_dent,
    "equation_of_state": equation_of_state,
    "bearing_breakdown": bearing_breakdown,
}
# What computes and reads their values.
_COMPUTED = (
    "bearing/bearing_breakdown",
    "contact/equation_of_state",
    "helpers/ball_on_disc",
    "helpers/measurements",
    "motion/microdent",
)
_LOOK = {
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "lines.linewidth": 1.2,
    "axes.linewidth": 0.7,
    "figure.constrained_layout.use": True,
}


def draw(name: str, folder: Path) -> None:
    """Write NAME.png and the table NAME.md into a folder."""
    with rc_context(_LOOK):
        figure, head, rows = FIGURES[name]()
        figure.savefig(folder / f"{name}.png", dpi=200, facecolor="white")
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    text = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    (folder / f"{name}.md").write_text(text + "\n", "utf-8")


def _write(app: Sphinx) -> None:
    """Draw what is missing or older than the program and the measurements."""
    folder = Path(app.srcdir) / "_generated" / "measurement"
    folder.mkdir(parents=True, exist_ok=True)
    sources = [
        *Path(ehlectric.__file__).parent.rglob("*.py"),
        *(ROOT / "tests" / "data" / "measured").iterdir(),
        *(ROOT / "tests" / f"{name}.py" for name in _COMPUTED),
        *Path(__file__).parent.glob("*.py"),
    ]
    newest = max(path.stat().st_mtime for path in sources if path.suffix != ".pyc")
    for name in FIGURES:
        table = folder / f"{name}.md"
        if not table.exists() or table.stat().st_mtime < newest:
            draw(name, folder)


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
