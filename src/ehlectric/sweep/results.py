"""Results of a sweep: values, tables and figures of its points."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.table import nearest
from ehlectric.discharge.verdict import Verdict
from ehlectric.errors import InputError
from ehlectric.quantities.quantity import key_of
from ehlectric.runtime.display import Shown, headline
from ehlectric.sweep.columns import columns_of, dataset_of, numbers_of, unit_of_column
from ehlectric.sweep.labels import label_of, result_keys
from ehlectric.sweep.points import Point, Range, Spacing, Status, SweepPoints, as_number, flat
from ehlectric.sweep.verdict import sweep_verdict

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

__all__ = ["Point", "Range", "Spacing", "Status", "SweepResults", "as_number", "flat"]


@dataclass(frozen=True, eq=False, repr=False)
class SweepResults(Shown, SweepPoints):
    """Results of a sweep, complete or still in progress.

    Attributes
    ----------
    case : Case, BearingCase or DriveCase
        Base case of the sweep.
    design : str
        "grid", "paired" or "sobol".
    axes : mapping
        Values of each varied key in the order of the input, in SI units; empty for a "sobol" design.
    ranges : mapping
        Range of each varied key of a "sobol" design, in the order of the input; empty for other designs.
    samples : int
        Base samples n of a "sobol" design; 0 for other designs.
    points : tuple of Point
        All points in the order of the design; in a "grid" the last varied key varies fastest.
    seed : int
        Seed of the random numbers of a "sobol" design.
    title : str
        Title of the sweep, for figures.
    """

    def values(self, key: str) -> Array:
        """Value of a key of the summary at every point.

        Parameters
        ----------
        key : str
            Dotted key of the summary, such as "discharge.breakdown_voltage".

        Returns
        -------
        ndarray, shape (points,)
            Values in SI units, doubtful points included; NaN where a point is not solved, or its summary has
            no number at this key.

        Raises
        ------
        InputError
            If ``key`` is neither a varied key nor a key of the summary; the message has the nearest key.
        """
        if key in self.varied:
            return np.array([as_number(point.inputs.get(key)) for point in self.points])
        self._check(key)
        column = [flat(point.summary or {}).get(key) if point.solved else None for point in self.points]
        return np.array([as_number(value) for value in column])

    @cached_property
    def verdict(self) -> Verdict | None:
        """Verdict: at how many points breakdown is expected; None where no point has a margin."""
        return sweep_verdict(self)

    def _check(self, key: str) -> None:
        """Raise an InputError for a key that no summary has and that is not documented."""
        rows = [flat(point.summary) for point in self.points if point.solved and point.summary]
        if any(key in row for row in rows) or key_of(result_keys(self.case), key) is not None:
            return
        known = list(numbers_of(self)) or list(result_keys(self.case))
        table = key.partition(".")[0] + "."
        alike = [name for name in known if name.startswith(key) or name.endswith(f".{key}")]
        within = [name for name in known if name.startswith(table)]
        raise InputError.unknown(key, alike[0] if alike else nearest(key, within or known))

    def summary(self) -> dict[str, Any]:
        """Number of points of each status, and the design of the sweep.

        Returns
        -------
        dict
            ``title``, ``design``, ``varied``, ``points`` (number of all points), the numbers of points that
            are ``solved``, ``not converged``, ``failed`` and ``open``, and the time ``seconds`` [s].
        """
        counts = Counter(point.status for point in self.points)
        states: tuple[Status, ...] = ("solved", "not converged", "failed", "open")
        return {
            "title": self.title or self.case.title,
            "design": self.design,
            "varied": list(self.varied),
            "points": len(self.points),
            **{status: counts[status] for status in states},
            "seconds": sum(point.seconds for point in self.points),
        }

    def to_xarray(self) -> xr.Dataset:
        """Dataset of inputs and results, over the varied keys in a "grid" design, the same as sweep.nc."""
        return dataset_of(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Points as a table of pandas, a row for each.

        Returns
        -------
        pandas.DataFrame
            Columns by dotted key as in sweep.csv, SI units; NaN where a point is not solved.
            ``attrs["units"]`` has the unit of each column of numbers.
        """
        import pandas as pd

        columns = columns_of(self)
        units = {key: unit_of_column(self, key) for key in columns}
        frame = pd.DataFrame(columns)
        frame.attrs["units"] = {key: unit for key, unit in units.items() if unit is not None}
        return frame

    def _headline(self) -> str:
        """Title, number of points, varied keys and status on one line."""
        counts = self.summary()
        others = [f"{counts[status]} {status}" for status in ("not converged", "failed", "open")]
        return headline(
            str(counts["title"]),
            f"{self.design} of {len(self.points)} points over {', '.join(map(self._name, self.varied))}",
            f"{counts['solved']} solved",
            *(text for text in others if not text.startswith("0 ")),
            verdict=self.verdict,
        )

    def _name(self, key: str) -> str:
        return label_of(key, self.case).name
