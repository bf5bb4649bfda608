"""The solvers by the name a command takes."""

from __future__ import annotations

from ehlectric.cases.case import Case
from ehlectric.contact.solver import OWN, Solvers
from ehlectric.errors import InputError, shown
from ehlectric.paper import fas, sor


def _check(case: Case) -> None:
    """Refuse what the paper's methods are not made for."""
    if case.contact.geometry != "line":
        raise InputError.worded(
            "contact.geometry",
            f"got {case.contact.geometry!r}, the solver 'paper' takes 'line': its methods are "
            "those of line contacts",
            got=shown(case.contact.geometry),
            takes="'line'",
        )
    fas.grid_sizes(case.grid.nodes)


PAPER = Solvers("paper", fas.solve_film, sor.solve_field, check=_check)
SOLVERS = {solvers.name: solvers for solvers in (OWN, PAPER)}
