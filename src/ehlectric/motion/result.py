"""Result of a contact with moving roughness, as ``solve_motion`` and ``load`` return it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.motion.stored_run import MotionRun
from ehlectric.motion.summary import summary_of
from ehlectric.quantities.formats import amount
from ehlectric.quantities.result_warnings import ResultWarning, warnings_of
from ehlectric.quantities.results import MOTION_BOOK
from ehlectric.runtime.display import Shown, headline

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


@dataclass(frozen=True, eq=False, repr=False)
class MotionResult(Shown, MotionRun):
    """Run of a contact with moving roughness, with its summary, tables and figures.

    Attributes
    ----------
    dataset : xarray.Dataset
        Values at the solved time steps and recorded instants, SI units.
    case : Case
        Case of the run.
    conditions : Conditions or PointConditions
        Operating conditions of the case.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.Case.from_toml(ehlectric.example("moving_roughness.toml"))
    >>> case = case.replace({"grid.nodes": 401, "motion.passes": 0.05, "motion.steps": 4, "motion.record": 4})
    >>> result = ehlectric.solve_motion(case)
    >>> result.dataset["thickness"].dims
    ('frame', 'x')
    """

    @property
    def converged(self) -> bool:
        """Whether all time steps of the run are solved."""
        return self.complete

    @property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about unreliable results, each with a code and a severity."""
        return warnings_of(self.summary())

    def summary(self) -> dict[str, Any]:
        """Return key figures in SI units, as nested tables with the keys of summary.json."""
        return summary_of(self.dataset)

    def to_xarray(self) -> xr.Dataset:
        """Return the dataset of all values with their units, as in motion.nc."""
        return self.dataset

    def to_dataframe(self) -> pd.DataFrame:
        """Return the time steps as a table of pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each time step with its time, minimum film, field estimate and residuals, SI units;
            ``attrs["units"]`` has the unit of each column.
        """
        names = [str(name) for name, values in self.dataset.variables.items() if values.dims == ("step",)]
        frame = self.dataset[names].to_dataframe()
        frame.attrs["units"] = {name: self.dataset[name].attrs.get("units", "") for name in names}
        return frame

    def key_numbers(self) -> tuple[str | None, ...]:
        """Return time steps, minimum film, maximum field and state as texts."""
        steps = self.dataset.sizes["step"] - 1
        strongest = amount(float(np.max(self.values("max_strength"))), "V/m")
        field = MOTION_BOOK[self.case.contact.geometry]["field.max_strength"]
        return (
            f"{self.case.contact.geometry} contact with moving roughness",
            f"{steps} time steps to {amount(float(self.values('time')[-1]), 's')}",
            f"minimum film {amount(float(np.min(self.values('minimum_thickness'))), 'm')}",
            f"maximum field {field.with_sign(strongest)}",
            "complete" if self.complete else "NOT COMPLETE",
        )

    def _headline(self) -> str:
        return headline(self.case.title, *self.key_numbers())
