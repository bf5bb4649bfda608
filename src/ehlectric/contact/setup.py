"""Inputs of a contact other than its operating conditions."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.film_inputs import Inlet
from ehlectric.cases.grid_inputs import Electric, Grid, Solver
from ehlectric.cases.roughness_inputs import Roughness
from ehlectric.lubricant.oil import Oil


@dataclass(frozen=True)
class Setup:
    """Inputs of a contact other than its operating conditions.

    A ``Case`` has the same attributes. Functions that read only these attributes accept a case or a setup.
    """

    oil: Oil
    grid: Grid  # grid of the film and of the field; the grid of a point contact must have a ``field_side``
    electric: Electric = field(default_factory=Electric)  # potentials of the two surfaces
    # Tolerance and largest number of iterations of the film solver.
    solver: Solver = field(default_factory=Solver)
    # Dielectric strength and other inputs of a discharge; None if no discharge is assessed.
    discharge: Discharge | None = None
    roughness: tuple[Roughness, ...] = ()  # tables of the rough surfaces; empty if both surfaces are smooth
    title: str = ""
    inlet: Inlet | None = None  # oil that is supplied to a starved contact; None if the inlet is flooded

    @property
    def first_grid(self) -> Grid:
        """Grid on which the film is solved first, with its number of nodes."""
        return self.grid.first(rough=bool(self.roughness))

    @classmethod
    def of(cls, case: Case | Setup) -> Setup:
        """Make the setup of a case, or a copy of a setup."""
        return cls(**{each.name: getattr(case, each.name) for each in fields(cls)})

    def to_dict(self) -> dict[str, Any]:
        """Return all values that are set as nested tables, in SI units, with the keys of a case."""
        tables = {
            name: table.model_dump(mode="json", exclude_none=True)
            for name in ("electric", "grid", "solver", "discharge", "inlet")
            if (table := getattr(self, name)) is not None
        }
        rough = [table.model_dump(mode="json", exclude_none=True) for table in self.roughness]
        return {"title": self.title, "roughness": rough, "lubricant": dict(self.oil.inputs)} | tables
