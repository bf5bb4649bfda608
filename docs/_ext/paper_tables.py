"""Tables of the paper's study, computed anew where the code is newer than they are."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

import numpy as np
from from_code import table_text
from scipy.constants import epsilon_0
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

import ehlectric
from ehlectric import solve
from ehlectric.paper.paper_contacts import CONTACTS
from ehlectric.paper.reproduce import reproduce
from ehlectric.runtime.worker_processes import cores


def _paper(app: Sphinx) -> None:
    """The paper's study, where the code is newer than what was made of it."""
    folder = Path(app.srcdir) / "_generated"
    page, times = folder / "extra" / "reproduced" / "report.html", folder / "paper_time.md"
    made_of = [Path(__file__), *Path(ehlectric.__file__).parent.rglob("*.*")]
    newest = max(path.stat().st_mtime for path in made_of)
    if page.exists() and page.stat().st_mtime > newest and times.exists():
        return
    begun, before = time.perf_counter(), _processor_time()
    made = reproduce(page.parent)
    seconds, worked = time.perf_counter() - begun, _processor_time() - before
    took = f"{seconds:.0f} s on {cores()} cores, with {worked:.0f} s of processor time"
    times.write_text(f"The run for this page took {took}.\n", encoding="utf-8")
    if not made.converged:
        raise ExtensionError("a film of the paper's study did not converge")
    tables = {
        f"paper_{name}": table_text(list(table.heads), table.shown) for name, table in made.tables.items()
    }
    for name, text in (tables | {"capacitances": _capacitances()}).items():
        page = folder / f"{name}.md"
        page.write_text("```{rst-class} paper\n```\n\n" + text, encoding="utf-8")


def _processor_time() -> float:
    """Time that this process and its processes have computed [s]."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def _capacitances() -> str:
    """Capacitance of the paper's eight contacts as a ratio to parallel plates, and its parts."""
    rows = []
    for contact in CONTACTS:
        case = contact.case(discharge={})
        result = solve(case, require_convergence=True)
        found = result.discharge
        steady = solve(case.replace({"lubricant.permittivity_law": "constant"})).discharge
        assert found is not None
        assert steady is not None
        filled = (found.capacitance_outlet_fingers, found.capacitance_outlet_layers)
        poorer = [found.capacitance - found.capacitance_outlet_full + outlet for outlet in filled]
        ratios = [c / found.capacitance_plate for c in (found.capacitance, *poorer)]
        ratios += [steady.capacitance_ratio, found.capacitance_ratio / steady.capacitance_ratio]
        ratios.append(found.capacitance_hertz / _uniform_film(result))
        rows.append(
            [
                contact.name.replace(" ", "\N{NO-BREAK SPACE}"),
                f"{found.capacitance * 1e9:.2f}",
                *(f"{r:.3f}" for r in ratios),
            ]
        )
    head = ["contact", "C [nF/m]", "C / plate value", "fingers", "layers", "constant ε_r"]
    head += ["effect of pressure on ε_r", "Hertzian zone / uniform film"]
    return table_text(head, rows)


def _uniform_film(result: Any) -> float:
    """Capacitance of a film of h(0) under the Hertzian pressure, in its zone [F/m].

    By the midpoint rule over t, with X = cos(t) and p = p_h sin(t).
    """
    sines = np.sin(np.pi * (np.arange(1000) + 0.5) / 1000)
    oil, b = result.case.oil, result.conditions.half_width
    pressure = result.conditions.max_pressure * sines
    permittivity = oil.permittivity(pressure, oil.density_ratio(pressure)[0])
    width = np.pi * b * float(np.mean(permittivity * sines))
    return float(epsilon_0 * width / result.film.central_thickness)


def setup(app: Sphinx) -> dict[str, Any]:
    """Written before anything is read."""
    app.connect("builder-inited", _paper, priority=100)
    return {"parallel_read_safe": True}
