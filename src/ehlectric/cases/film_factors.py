"""Film factors of a measurement: rows, mean with its interval, warnings, and the content of their files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.cases.case_oil import viscosity_over_temperature
from ehlectric.cases.measurements import Measurement, void_rows
from ehlectric.cases.oil_inputs import Properties
from ehlectric.quantities.quantity import Keys, Quantity, data_file
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.readable import readable
from ehlectric.runtime.display import ResultKind, Shown, headline
from ehlectric.runtime.files import Content, column_head, csv_of, json_of, plain
from ehlectric.runtime.result_names import MEASURED, MEASURED_ROWS
from ehlectric.version import __version__

if TYPE_CHECKING:
    import pandas as pd


CONFIDENCE = 0.95  # probability of an interval
# Degrees of freedom of a standard deviation that is known.
_KNOWN = 1e9

# Texts that say where the statistical part of an interval is from.
STATED, RAISED, SCATTER = "stated uncertainty", "stated uncertainty, raised to the scatter", "scatter only"

# Keys of a mean factor in measured.json that differ from its fields.
_MEAN_KEYS = {
    "value": "mean",
    "statistical": "statistical_uncertainty",
    "systematic": "systematic_uncertainty",
}


@dataclass(frozen=True)
class MeanFactor:
    """Weighted mean of film factors, and its 95 % interval."""

    value: float  # geometric mean, weighted with the reciprocal variances of the rows, dimensionless
    # low and high: ends of the 95 % interval; None for a single row without a stated uncertainty.
    low: float | None
    high: float | None
    # statistical and systematic: relative standard uncertainty of the mean from the rows, and from inputs
    # that all rows share.
    statistical: float | None
    systematic: float
    # Scatter of the rows divided by their stated uncertainty (Birge ratio), dimensionless. Without a stated
    # uncertainty: relative standard deviation of the rows. None for a single row.
    scatter: float | None
    # Origin of ``statistical``: "stated uncertainty", "stated uncertainty, raised to the scatter" or "scatter
    # only"
    basis: str
    rows: int

    def summary(self) -> dict[str, Any]:
        """Values as in measured.json."""
        return {_MEAN_KEYS.get(name, name): value for name, value in asdict(self).items()}


def mean_factor(
    factors: Array, stated: Array | None = None, shared: Mapping[str, Array] | None = None
) -> MeanFactor:
    """Mean of film factors in their logarithm. ``factors``, film factors of the rows, n >= 1, shape (n,);
    ``stated``, relative standard uncertainty of each factor from its measurement, independent of other rows,
    shape (n,); ``shared``, change of ln(factor) by one standard uncertainty of an input that all rows share,
    shape (n,).

    Examples
    --------
    >>> mean = mean_factor(np.array([0.69, 0.71]), np.array([0.03, 0.03]))
    >>> round(mean.value, 3), round(mean.low, 3), round(mean.high, 3), mean.basis
    (0.7, 0.671, 0.73, 'stated uncertainty')
    """
    logs, n = np.log(factors), len(factors)
    weights = np.ones(n) if stated is None else stated**-2.0
    weights = weights / np.sum(weights)
    mean = float(np.vdot(weights, logs))
    if stated is None:
        deviation = float(np.std(logs, ddof=1)) if n > 1 else None
        statistical = None if deviation is None else deviation / math.sqrt(n)
        scatter, basis, degrees = deviation, SCATTER, float(n - 1)
    else:
        stated_error = float(np.sum(stated**-2.0)) ** -0.5
        scatter = math.sqrt(float(np.sum(((logs - mean) / stated) ** 2)) / (n - 1)) if n > 1 else None
        raised = scatter is not None and scatter > 1.0
        statistical = stated_error * (scatter or 1.0) if raised else stated_error
        basis, degrees = RAISED if raised else STATED, _KNOWN
    parts = [float(np.vdot(weights, change)) for change in (shared or {}).values()]
    systematic = math.hypot(*parts) if parts else 0.0
    low, high = _interval(mean, statistical, systematic, degrees)
    return MeanFactor(math.exp(mean), low, high, statistical, systematic, scatter, basis, n)


def _interval(
    mean: float, statistical: float | None, systematic: float, degrees: float
) -> tuple[float | None, float | None]:
    """Ends of the interval of a mean in its logarithm; the systematic part is taken as normal."""
    if statistical is None:
        return None, None
    at = 0.5 * (1.0 + CONFIDENCE)
    wide, normal = (float(scipy.special.stdtrit(degree, at)) for degree in (degrees, _KNOWN))
    half = math.hypot(wide * statistical, normal * systematic)
    return math.exp(mean - half), math.exp(mean + half)


def slope_of(x: Array, factors: Array, stated: Array | None = None) -> tuple[float, float] | None:
    """Slope d ln(factor)/d ln(x) of film factors over a speed, and its standard uncertainty.

    ``x`` and ``factors``, speeds and film factors, above 0, shape (n,); ``stated``, relative standard
    uncertainties of the factors, as weights, shape (n,). Returns slope and its standard uncertainty from the
    scatter about the line, at least the stated one; None for fewer than three different speeds.

    Examples
    --------
    >>> u = np.array([1.0, 2.0, 4.0, 8.0])
    >>> slope, uncertainty = slope_of(u, u**-0.1)
    >>> round(slope, 6), uncertainty < 1e-9
    (-0.1, True)
    """
    if len(np.unique(x)) < 3:
        return None
    a, b = np.log(x), np.log(factors)
    weights = np.ones(len(x)) if stated is None else stated**-2.0
    a0, b0 = (float(np.average(values, weights=weights)) for values in (a, b))
    spread = float(np.sum(weights * (a - a0) ** 2))
    slope = float(np.sum(weights * (a - a0) * (b - b0))) / spread
    rest = float(np.sum(weights * (b - b0 - slope * (a - a0)) ** 2)) / (len(x) - 2)
    if stated is not None:
        rest = max(rest, 1.0)
    return slope, math.sqrt(rest / spread)


# Number of rows and of columns that a warning names.
_NAMED = 3

# Ratio of the scatter to the stated uncertainty above which a warning reports it.
_LARGE = 1.5

# Slope over the speed, and its ratio to its uncertainty, above which a film factor counts as no constant.
_STEEP, _CERTAIN = 0.02, 3.0


def measurement_warnings(
    measured: Measurement,
    reasons: Sequence[str],
    mean: MeanFactor | None,
    slope: tuple[float, float] | None,
    speed: str,
) -> Iterator[ResultWarning]:
    """Warnings about columns, rows, scatter and trend of a measurement."""
    yield from void_rows(measured)
    if measured.ignored:
        columns = _some(measured.ignored)
        yield ResultWarning.of("columns-ignored", file=measured.source, columns=columns)
    without = [(line, why) for line, why in zip(measured.lines, reasons, strict=True) if why]
    if without:
        lines = _some([f"line {line} ({why})" for line, why in without])
        yield ResultWarning.of("rows-without-factor", without=len(without), rows=len(reasons), lines=lines)
    if mean is None:
        return
    if mean.basis == SCATTER:
        yield ResultWarning.of("scatter-only")
    if mean.basis == RAISED and mean.scatter is not None and mean.scatter > _LARGE:
        yield ResultWarning.of("scatter-large", times=mean.scatter)
    if slope is None:
        return
    exponent, uncertainty = slope
    if abs(exponent) > max(_STEEP, _CERTAIN * uncertainty):
        yield ResultWarning.of("factor-varies", speed=speed, exponent=exponent, uncertainty=uncertainty)


def temperature_warnings(measured: Measurement, oil: Properties) -> Iterator[ResultWarning]:
    """Note about measured temperatures that do not change the films, because the viscosity is a given one."""
    if measured.has("temperature") and viscosity_over_temperature(oil) is None:
        yield ResultWarning.of("temperature-unused", "measurement", file=measured.source)


def _some(texts: Sequence[str]) -> str:
    more = len(texts) - _NAMED
    return ", ".join(texts[:_NAMED]) + (f" and {more} more" if more > 0 else "")


SCHEMA = "ehlectric.measured/1"

# SI unit and meaning of the columns of measured.csv.
COLUMNS: Keys = {
    name: Quantity(**column)
    for name, column in data_file("ehlectric.quantities", "measured_columns.toml")["written"].items()
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
        Relative error that films from formulas or from the atlas may have, which no interval contains; None
        for solved films.
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

    Examples
    --------
    >>> import ehlectric, pandas as pd
    >>> ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "20 N"}
    >>> case = ehlectric.Case.point(**ball, entrainment_speed="1 m/s", lubricant="paper")
    >>> log = pd.DataFrame({"entrainment speed [m/s]": [0.5, 1.0], "film [nm]": [151.0, 241.0]})
    >>> factors = ehlectric.film_factors(case, log, contacts="formula", uncertainty="3 %")
    >>> factors.mean.rows, round(factors.mean.value, 2)
    (2, 0.9)
    """

    result_kind: ClassVar[ResultKind] = "measurement"

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
        has_factor: Array = np.isfinite(self.columns["film_factor"])
        return has_factor

    @property
    def speed_key(self) -> str:
        """Name of the column of the speed."""
        return "speed" if self.quantity == "capacitance" else "entrainment_speed"

    def units(self) -> dict[str, str]:
        """SI unit of each column."""
        unit = "F" if self.quantity == "capacitance" else "m"
        return {name: unit if name in _OF_QUANTITY else COLUMNS[name].unit for name in self.columns}

    def summary(self) -> dict[str, Any]:
        """Return the values as in measured.json, SI units; None instead of NaN."""
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
        """Return the rows as a table of pandas, as in measured.csv.

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
        frame.attrs["descriptions"] = {name: COLUMNS[name].meaning for name in self.columns}
        return frame

    def contents(self) -> dict[str, Content]:
        """Return the content of measured.json and measured.csv by their names."""
        units = self.units()
        heads = [column_head(name, unit) for name, unit in units.items()]
        columns = [
            ["" if np.isnan(value) else int(value) if name == "line" else value for value in values.tolist()]
            for name, values in self.columns.items()
        ]
        rows = zip(*columns, self.reasons, strict=True)
        return {MEASURED: json_of(self.summary()), MEASURED_ROWS: csv_of([*heads, "reason"], rows)}

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
        return f"film factor {readable(mean.value)}, of one row without a stated uncertainty"
    scatter = ", from scatter only" if mean.basis == "scatter only" else ""
    return (
        f"film factor {readable(mean.value)} ({readable(mean.low)} to {readable(mean.high)}, 95 %{scatter})"
    )


def fitted_columns(values: Array, factors: Array, slopes: Array, mean: MeanFactor | None) -> dict[str, Array]:
    """Computed values of the rows at the mean film factor, and at both ends of its interval.

    ``values``, ``factors`` and ``slopes``, measured value of each row, the film factor at which the computed
    value equals it, and the slope d ln(value)/d ln(factor) there, shape (n,). Returns columns ``fitted``,
    ``fitted_low`` and ``fitted_high``; only the first without an interval, shape (n,).
    """
    if mean is None:
        return {}
    ends = {"fitted": mean.value, "fitted_low": mean.low, "fitted_high": mean.high}
    return {
        name: values * (factor / factors) ** slopes for name, factor in ends.items() if factor is not None
    }
