"""Setup of a contact: oil, potentials, grid and solver, without its operating conditions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.cases.discharge import Discharge
from ehlectric.cases.films.inlet import Inlet
from ehlectric.cases.grid import Electric, Grid, Solver
from ehlectric.cases.roughness import Roughness
from ehlectric.lubricant.oil import Oil


@dataclass(frozen=True)
class Setup:
    """Inputs of a contact other than its operating conditions.

    A ``Case`` has the same attributes. Functions that read only these attributes accept a case or a setup.

    Attributes
    ----------
    oil : Oil
        Oil at the temperature of the contact.
    grid : Grid
        Grid of the film and of the field; the grid of a point contact must have a ``field_side``.
    electric : Electric
        Potentials of the two surfaces.
    solver : Solver
        Tolerance and largest number of iterations of the film solver.
    discharge : Discharge or None
        Dielectric strength and other inputs of a discharge; None if no discharge is assessed.
    roughness : tuple of Roughness
        Tables of the rough surfaces; empty if both surfaces are smooth.
    title : str
        Title of files and figures.
    inlet : Inlet or None
        Oil that is supplied to a starved contact; None if the inlet is flooded.
    """

    oil: Oil
    grid: Grid
    electric: Electric = field(default_factory=Electric)
    solver: Solver = field(default_factory=Solver)
    discharge: Discharge | None = None
    roughness: tuple[Roughness, ...] = ()
    title: str = ""
    inlet: Inlet | None = None

    @property
    def first_grid(self) -> Grid:
        """Grid on which the film is solved first, with its number of nodes."""
        return self.grid.first(rough=bool(self.roughness))

    @classmethod
    def of(cls, case: Case | Setup) -> Setup:
        """Make the setup of a case, or a copy of a setup."""
        return cls(
            oil=case.oil,
            grid=case.grid,
            electric=case.electric,
            solver=case.solver,
            discharge=case.discharge,
            roughness=case.roughness,
            title=case.title,
            inlet=case.inlet,
        )

    def to_dict(self) -> dict[str, Any]:
        """Return all values that are set as nested tables, in SI units, with the keys of a case."""
        tables = {
            name: getattr(self, name).model_dump(mode="json", exclude_none=True)
            for name in ("electric", "grid", "solver")
        }
        for name, table in (("discharge", self.discharge), ("inlet", self.inlet)):
            if table is not None:
                tables[name] = table.model_dump(mode="json", exclude_none=True)
        rough = [table.model_dump(mode="json", exclude_none=True) for table in self.roughness]
        return {"title": self.title, "roughness": rough, "lubricant": dict(self.oil.inputs)} | tables
