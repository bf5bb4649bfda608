"""Film factors of a measurement: rows, mean, warnings, and the content of their files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.measurements.average import MeanFactor
from ehlectric.errors import ResultWarning, texts_and_codes
from ehlectric.runtime.display import Shown, headline
from ehlectric.runtime.files import Content, json_of, plain
from ehlectric.runtime.tables import column_head, csv_of
from ehlectric.version import __version__

if TYPE_CHECKING:
    import pandas as pd

SUMMARY, ROWS = "measured.json", "measured.csv"
FILES = (SUMMARY, ROWS)
SCHEMA = "ehlectric.measured/1"

# SI unit and meaning of the columns of measured.csv.
COLUMNS: Mapping[str, tuple[str, str]] = {
    "line": ("", "line of the row in the file of the measurement"),
    "time": ("s", "time of the row"),
    "speed": ("rad/s", "speed of the inner ring"),
    "entrainment_speed": ("m/s", "entrainment speed of the contact"),
    "temperature": ("K", "temperature of the oil"),
    "measured_capacitance": ("F", "parallel capacitance as measured"),
    "parallel_resistance": ("ohm", "parallel resistance as measured"),
    "capacitance": ("F", "measured capacitance without the background"),
    "capacitance_uncertainty": ("F", "its standard uncertainty"),
    "film": ("m", "measured central film thickness"),
    "film_uncertainty": ("m", "its standard uncertainty"),
    "computed": ("", "computed value for isothermal, fully flooded films"),
    "formula": ("", "central film thickness by a formula"),
    "film_factor": ("", "film factor that explains the row"),
    "factor_uncertainty": ("", "its standard uncertainty from the measurement"),
    "factor_systematic": ("", "its standard uncertainty from the ranges of the case"),
    "fitted": ("", "computed value at the mean film factor"),
    "fitted_low": ("", "computed value at the low end of the mean film factor"),
    "fitted_high": ("", "computed value at the high end of the mean film factor"),
    "minimum_thickness": ("m", "smallest film of the bearing at the film factor of the row"),
    "lambda_ratio": ("", "this film over the composite roughness"),
}

# Columns in the unit of the measured quantity.
_OF_QUANTITY = ("computed", "formula", "fitted", "fitted_low", "fitted_high")


@dataclass(frozen=True, eq=False, repr=False)
class FilmFactors(Shown):
    """Film factors that explain a measurement, row by row, and their mean.

    Attributes
    ----------
    title : str
        Title of the case.
    source : str
        File of the measurement.
    quantity : str
        "capacitance" or "film": the measured quantity.
    contacts : str
        "atlas", "formula" or "solved": how the films of the case were computed.
    solves : int
        Number of contacts that were solved.
    formula_error : float or None
        Relative error that films by formula or from the atlas may have, which no interval contains; None for
        solved films.
    background : float or None
        Capacitance [F] that was taken off every row; None for films.
    columns : mapping of str to ndarray, shape (n,)
        Rows in SI units; NaN where a row has no value. ``COLUMNS`` has their units and meanings.
    reasons : tuple of str
        For each row "" or why it has no film factor.
    mean : MeanFactor or None
        Mean film factor of the rows; None where no row has one.
    slope : tuple of float or None
        Slope d ln(factor)/d ln(speed) and its standard uncertainty; None for fewer than three speeds.
    warnings : tuple of ResultWarning
        Warnings about the measurement and about the computed films.
    """

    title: str
    source: str
    quantity: Literal["capacitance", "film"]
    contacts: str
    solves: int
    formula_error: float | None
    background: float | None
    columns: Mapping[str, Array]
    reasons: tuple[str, ...]
    mean: MeanFactor | None
    slope: tuple[float, float] | None
    warnings: tuple[ResultWarning, ...] = ()

    @property
    def found(self) -> Array:
        """Whether each row has a film factor, shape (n,)."""
        found: Array = np.isfinite(self.columns["film_factor"])
        return found

    @property
    def speed_key(self) -> str:
        """Name of the column of the speed."""
        return "speed" if self.quantity == "capacitance" else "entrainment_speed"

    def units(self) -> dict[str, str]:
        """SI unit of each column."""
        unit = "F" if self.quantity == "capacitance" else "m"
        return {name: unit if name in _OF_QUANTITY else COLUMNS[name][0] for name in self.columns}

    def summary(self) -> dict[str, Any]:
        """Values as in measured.json, SI units; None in place of NaN."""
        slope, uncertainty = self.slope or (None, None)
        return {
            "schema": SCHEMA,
            "version": __version__,
            "title": self.title,
            "source": self.source,
            "quantity": self.quantity,
            "contacts": self.contacts,
            "solves": self.solves,
            "formula_error": self.formula_error,
            "background": self.background,
            "rows": len(self.reasons),
            "rows_with_factor": int(np.count_nonzero(self.found)),
            "film_factor": None if self.mean is None else plain(self.mean.summary()),
            "speed_exponent": {"value": slope, "uncertainty": uncertainty},
            **texts_and_codes(self.warnings),
        }

    def to_dataframe(self) -> pd.DataFrame:
        """Rows as a table of pandas, the same as measured.csv.

        Returns
        -------
        pandas.DataFrame
            Columns in SI units, and ``reason``: "" or why a row has no film factor. ``attrs["units"]`` and
            ``attrs["descriptions"]`` have the unit and the meaning of each column.
        """
        import pandas as pd

        frame = pd.DataFrame(dict(self.columns))
        frame["line"] = frame["line"].astype(int)
        frame["reason"] = list(self.reasons)
        frame.attrs["units"] = self.units()
        frame.attrs["descriptions"] = {name: COLUMNS[name][1] for name in self.columns}
        return frame

    def contents(self) -> dict[str, Content]:
        """Content of measured.json and measured.csv by their names."""
        units = self.units()
        heads = [column_head(name, unit) for name, unit in units.items()]
        columns = [
            ["" if np.isnan(value) else int(value) if name == "line" else value for value in values.tolist()]
            for name, values in self.columns.items()
        ]
        rows = zip(*columns, self.reasons, strict=True)
        return {SUMMARY: json_of(self.summary()), ROWS: csv_of([*heads, "reason"], rows)}

    def _headline(self) -> str:
        """Title, mean film factor with its interval, and number of rows on one line."""
        return headline(self.title, factor_text(self.mean), f"{np.count_nonzero(self.found)} rows")


def factor_text(mean: MeanFactor | None) -> str:
    """Mean film factor with its interval as text.

    Examples
    --------
    >>> factor_text(None)
    'no film factor'
    """
    if mean is None:
        return "no film factor"
    if mean.low is None or mean.high is None:
        return f"film factor {mean.value:.3g}, of one row without a stated uncertainty"
    scatter = ", from scatter only" if mean.basis == "scatter only" else ""
    return f"film factor {mean.value:.3g} ({mean.low:.3g} to {mean.high:.3g}, 95 %{scatter})"


def fitted_columns(values: Array, factors: Array, slopes: Array, mean: MeanFactor | None) -> dict[str, Array]:
    """Computed values of the rows at the mean film factor, and at both ends of its interval.

    Parameters
    ----------
    values, factors, slopes : ndarray, shape (n,)
        Measured value of each row, the film factor at which the computed value is the same, and the slope
        d ln(value)/d ln(factor) there. The computed value is a power of the film factor nearby.
    mean : MeanFactor or None
        Mean film factor.

    Returns
    -------
    dict of str to ndarray, shape (n,)
        Columns ``fitted``, ``fitted_low`` and ``fitted_high``; only the first without an interval.
    """
    if mean is None:
        return {}
    ends = {"fitted": mean.value, "fitted_low": mean.low, "fitted_high": mean.high}
    return {
        name: values * (factor / factors) ** slopes for name, factor in ends.items() if factor is not None
    }
