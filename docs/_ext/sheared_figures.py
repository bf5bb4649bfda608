"""Figure of the traction of isothermal films over the slide-to-roll ratio, by the law of shear thinning."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]
if str(ROOT) not in sys.path:
    sys.path.insert(0, str(ROOT))

from measured_figures.look import decades, label, new  # noqa: E402
from tests.film.sheared.contacts import friction, line_contact, solved  # noqa: E402

from ehlectric.film.shear_laws import Rheology  # noqa: E402
from ehlectric.quantities.palette import BLUE, GREEN, MIDDLE_GREY, ORANGE  # noqa: E402
from ehlectric.runtime.files import prepare  # noqa: E402

LAWS = {
    "Newtonian": (Rheology(), MIDDLE_GREY),
    "Ree-Eyring, $\\tau_0$ = 5 MPa": (Rheology("eyring", {"eyring_stress": 5e6}), BLUE),
    "Carreau, $G$ = 6 MPa, $n$ = 0.5": (
        Rheology("carreau", {"carreau_stress": 6e6, "carreau_exponent": 0.5}),
        GREEN,
    ),
    "limiting stress, $\\Lambda$ = 0.05": (Rheology("limiting", {"limiting_coefficient": 0.05}), ORANGE),
}
RATIOS = (1e-4, 3e-4, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3)


def _write(app: Sphinx) -> None:
    figure, ax = new()
    for name, (law, colour) in LAWS.items():
        problems = [line_contact(ratio=ratio, rheology=law, nodes=201) for ratio in RATIOS]
        tractions = [friction(problem, solved(problem)).sliding for problem in problems]
        ax.loglog(100.0 * np.array(RATIOS), tractions, color=colour, label=name)
    label(ax, "slide-to-roll ratio [%]", "traction coefficient")
    ax.set_xlim(0.01, 30.0)
    ax.set_ylim(0.005, 10.0)
    decades(ax.xaxis, [0.01, 0.1, 1, 10])
    decades(ax.yaxis, [0.01, 0.1, 1, 10])
    ax.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    folder = prepare(Path(app.srcdir) / "_generated")
    figure.savefig(folder / "traction_laws.png", dpi=200, facecolor="white", bbox_inches="tight")


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
