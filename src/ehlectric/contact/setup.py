"""Setup of a contact: oil, potentials, grid and solver, without its operating conditions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.cases.discharge import Discharge
from ehlectric.cases.grid import Electric, Grid, Solver
from ehlectric.cases.lubricant import Lubricant
from ehlectric.cases.roughness import Roughness


@dataclass(frozen=True)
class Setup:
    """What a contact is solved with besides its operating conditions.

    A case has the same attributes: functions that read these alone take either.

    Attributes
    ----------
    lubricant : Lubricant
        Laws of the oil.
    grid : Grid
        Discretisation; that of a point contact has a ``field_side``.
    electric : Electric
        Potentials of the surfaces.
    solver : Solver
        When the iteration of the film stops.
    discharge : Discharge or None
        Strength of the film, where a discharge is assessed.
    roughness : tuple of Roughness
        Tables of the rough surfaces.
    title : str
        Heading of files and figures.
    """

    lubricant: Lubricant
    grid: Grid
    electric: Electric = field(default_factory=Electric)
    solver: Solver = field(default_factory=Solver)
    discharge: Discharge | None = None
    roughness: tuple[Roughness, ...] = ()
    title: str = ""

    @classmethod
    def of(cls, case: Case | Setup) -> Setup:
        """Setup of a case, or a copy of a setup."""
        return cls(
            lubricant=case.lubricant,
            grid=case.grid,
            electric=case.electric,
            solver=case.solver,
            discharge=case.discharge,
            roughness=case.roughness,
            title=case.title,
        )

    def to_dict(self) -> dict[str, Any]:
        """Nested tables of all values that are set, SI floats, with the keys of a case."""
        tables = {
            name: getattr(self, name).model_dump(mode="json", exclude_none=True)
            for name in ("lubricant", "electric", "grid", "solver")
        }
        if self.discharge is not None:
            tables["discharge"] = self.discharge.model_dump(mode="json", exclude_none=True)
        rough = [table.model_dump(mode="json", exclude_none=True) for table in self.roughness]
        return {"title": self.title, "roughness": rough} | tables
