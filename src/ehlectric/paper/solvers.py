"""The solvers by the name a command takes."""

from __future__ import annotations

from ehlectric.paper import fas, sor
from ehlectric.solver import OWN, Solvers

PAPER = Solvers("paper", fas.solve_film, sor.solve_field, check=fas.grid_sizes)

SOLVERS = {solvers.name: solvers for solvers in (OWN, PAPER)}
