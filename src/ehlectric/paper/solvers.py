"""Solvers of contacts by their names on the command line: methods of ehlectric and of the paper."""

from __future__ import annotations

from ehlectric.cases.case import Case
from ehlectric.contact.solver import OWN, Solvers
from ehlectric.errors import InputError, shown
from ehlectric.paper import fas, sor


def _accepted(case: Case) -> Case:
    """Case as the paper's methods solve it, which have no wedge of third order.

    Raises an InputError if they cannot solve it: no line contact, an unsuitable grid, or this wedge.
    """
    if case.contact.geometry != "line":
        raise InputError.worded(
            "contact.geometry",
            f"got {case.contact.geometry!r}; the solver 'paper' needs 'line': its methods are "
            "those of line contacts",
            got=shown(case.contact.geometry),
            takes="'line'",
        )
    if case.inlet is not None:
        raise InputError("inlet", got="[inlet] for the solver 'paper'", takes="the solver 'ehlectric'")
    if case.film is not None:
        raise InputError.worded("film", "is not solved by the solver 'paper', whose films are isothermal")
    grid = case.grid.fixed() if case.grid.error is None else case.grid
    fas.grid_sizes(grid.nodes_along)
    case = case.model_copy(update={"grid": grid})
    if case.grid.wedge != "third-order":
        return case
    if "wedge" in case.grid.model_fields_set:
        raise InputError(
            "grid.wedge",
            got="'third-order' for the solver 'paper'",
            takes="'second-order' or 'first-order', or no wedge",
        )
    return case.model_copy(update={"grid": case.grid.model_copy(update={"wedge": "second-order"})})


PAPER = Solvers("paper", film={"line": fas.solve_film}, field={"line": sor.solve_field}, accept=_accepted)
SOLVERS = {solvers.name: solvers for solvers in (OWN, PAPER)}
