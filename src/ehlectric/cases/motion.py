"""Table ``motion`` of a case: duration, time steps and recorded instants of moving roughness."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.grid import Grid
from ehlectric.cases.table import Table
from ehlectric.errors import InputError


class Motion(Table):
    """Duration, time steps and recorded instants of a contact with moving roughness.

    Examples
    --------
    >>> Motion.from_dict({"duration": "2 ms"}).duration
    0.002
    """

    passes: (
        Annotated[float, Amount("", above=0.0, most=1e4, reason="lengths of the domain at the mean speed")]
        | None
    ) = None
    duration: Annotated[float, Amount("s", above=0.0, most=1e4, reason="of the motion")] | None = None
    steps: Annotated[int, Count(1, 100_000_000, "of time")] | None = None
    record: Annotated[int, Count(2, 100_000, "stored instants")] = 200

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.passes is None) == (self.duration is None):
            both = None if self.passes is None else "passes and duration together"
            raise InputError("passes", got=both, takes="either passes or duration")
        return self

    def check(self, grid: Grid, *, rough: bool) -> None:
        """Check that a case of moving roughness has a rough surface, and a grid that the motion can use.

        Parameters
        ----------
        grid : Grid
            Table ``grid`` of the case.
        rough : bool
            Whether a surface is rough.

        Raises
        ------
        InputError
            If no surface is rough, the wedge is of first order, or the grid is refined.
        """
        if not rough:
            raise InputError.worded("motion", "needs a rough surface: roughness is what moves")
        if grid.wedge == "first-order":
            raise InputError(
                "grid.wedge", got=f"{grid.wedge!r} beside motion", takes="'third-order' or 'second-order'"
            )
        for key in ("refine", "error", "most_nodes"):
            if getattr(grid, key) is not None:
                raise InputError.worded(
                    f"grid.{key}",
                    "is not used with [motion], which has a single grid; give grid.nodes",
                    takes="grid.nodes",
                )
