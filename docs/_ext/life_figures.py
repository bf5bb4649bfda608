"""Figure of the rating lives of a greased 6208 over its speed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from measured_figures.look import label, new
from sphinx.application import Sphinx

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.palette import BLUE, GREEN, MIDDLE_GREY, ORANGE
from ehlectric.quantities.units import rpm
from ehlectric.runtime.files import prepare
from ehlectric.sweep.evaluation import evaluate

LIVES = {
    "basic_life": ("basic rating life $L_{10}$", MIDDLE_GREY),
    "reference_modified_life": ("modified reference rating life $L_{nmr}$", BLUE),
    "film_reference_modified_life": ("modified reference life with the film", GREEN),
    "roughened_life": ("with the film and a roughness of 0.3 µm", ORANGE),
}
SPEEDS = np.geomspace(20.0, 1200.0, 40)


def _write(app: Sphinx) -> None:
    root = Path(app.srcdir).parent
    case = BearingCase.from_toml(root / "examples" / "bearing_greased.toml")
    found = evaluate(case, {"bearing.inner_speed": SPEEDS.tolist()})
    figure, ax = new()
    for key, (name, colour) in LIVES.items():
        ax.loglog(rpm(SPEEDS), found[f"life.{key}"].values / 3600.0, color=colour, label=name)
    label(ax, "speed of the inner ring [rpm]", "life [h]")
    ax.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    folder = prepare(root / "docs" / "_generated")
    figure.savefig(folder / "rating_lives.png", dpi=200, facecolor="white", bbox_inches="tight")


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
