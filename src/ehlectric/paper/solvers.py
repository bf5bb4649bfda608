"""Solvers of contacts by their names on the command line: methods of ehlectric and of the paper."""

from __future__ import annotations

from ehlectric.cases.case import Case
from ehlectric.contact.solver import OWN, Solvers
from ehlectric.errors import InputError, shown
from ehlectric.paper import fas, sor


def _check(case: Case) -> None:
    """Raise an InputError if the paper's methods cannot solve a case: no line contact, or unsuitable grid."""
    if case.contact.geometry != "line":
        raise InputError.worded(
            "contact.geometry",
            f"got {case.contact.geometry!r}; the solver 'paper' needs 'line': its methods are "
            "those of line contacts",
            got=shown(case.contact.geometry),
            takes="'line'",
        )
    fas.grid_sizes(case.grid.nodes)


PAPER = Solvers("paper", film={"line": fas.solve_film}, field={"line": sor.solve_field}, check=_check)
SOLVERS = {solvers.name: solvers for solvers in (OWN, PAPER)}
