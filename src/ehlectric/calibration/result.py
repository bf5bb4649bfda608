"""Result of a calibration: ranges before and after the measurement, and what is behind them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from ehlectric.arrays import Array
from ehlectric.cases.measured_inputs import MeasuredValue
from ehlectric.cases.measurements import quantity_text
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.errors import printable
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.quantities.verdict import Verdict
from ehlectric.runtime.display import ResultKind, Shown, headline
from ehlectric.runtime.files import Content, column_head, csv_of, json_of, plain
from ehlectric.runtime.result_names import CALIBRATED, COMPARED, SUMMARY
from ehlectric.version import __version__

if TYPE_CHECKING:
    import pandas as pd

SCHEMA = "ehlectric.calibration/1"

# Values at 5, 50 and 95 %, SI units.
Quantiles = tuple[float, float, float]


@dataclass(frozen=True)
class CalibratedInput:
    """Uncertain input before and after the measurement."""

    key: str  # dotted key; "films" for the factor on all films by their error
    label: str
    assumed: bool  # whether the range is the usual one, as the file states none
    low: float  # ends of the range, SI units
    high: float
    prior: Quantiles
    posterior: Quantiles | None  # None where nothing within the ranges explains the measurement
    # Share of the variance of the input that the measurement removed, dimensionless; negative if it grew.
    reduction: float | None
    reduction_error: float | None  # sampling error of the reduction, one standard deviation
    # Whether the measurement changed the range by more than the sampling error: calibrated.toml then has the
    # updated range.
    updated: bool


@dataclass(frozen=True)
class Compared:
    """Measured value and its computed values, SI units."""

    quantity: str
    unit: str
    point: int  # place of the operating point
    line: int | None  # line of the file; None of a value in [measured]
    measured: float
    uncertainty: float
    prior: Quantiles  # computed before the measurement
    posterior: Quantiles | None  # computed after it
    nearest: float  # at the inputs within the ranges that are nearest to all measured values
    # residual: measured value minus the computed median after the measurement, or else minus the nearest
    # prediction, in standard deviations: of the measured value and, for the median, of the computed one.
    residual: float
    decided: str  # key of the input whose variance this value, without the others, reduces most; or empty
    decided_share: float  # share of its variance that this value, without the others, removes


@dataclass(frozen=True)
class Cause:
    """Change that explains all measured values, with inputs within their ranges."""

    # "input", an input outside of its range; "parallel", a capacitance in parallel that a meter reads in
    # addition; "factor", a factor on all values of a quantity.
    kind: Literal["input", "parallel", "factor"]
    key: str  # of the input, or name of the measured quantity
    label: str
    # Value of the input or parallel capacitance, SI units; measured divided by true values for a factor.
    needed: float
    # Range of the input in the file, or 90 % interval of the parallel capacitance, SI units; None for a
    # factor.
    range: tuple[float, float] | None
    residual: float  # largest deviation after the change, in standard uncertainties
    p_value: float  # probability of a larger sum of squared deviations after the change
    meaning: str = ""  # usual mistake that causes the factor, by its code


@dataclass(frozen=True)
class Unexplained:
    """Measured values that nothing within the ranges explains."""

    rows: tuple[int, ...]  # places of the measured values that are further away than the limit
    limit: float  # largest deviation that is explained, in standard uncertainties
    p_value: float  # probability of a larger sum of squared deviations if the model is right
    causes: tuple[Cause, ...]  # changes that explain all measured values, the most probable first
    contradicting: tuple[int, ...]  # places of measured values without which the others are explained


@dataclass(frozen=True, eq=False, repr=False)
class Calibration(Shown):
    """Uncertain inputs of a case, updated by measured values.

    Attributes
    ----------
    title : str
        Title of the case.
    inputs : tuple of CalibratedInput
        Inputs with their ranges before and after the measurement.
    correlation : ndarray, shape (k, k)
        Correlation of the inputs after the measurement.
    rows : tuple of Compared
        Measured values next to computed values.
    unexplained : Unexplained or None
        What nothing within the ranges explains; None if inputs within the ranges explain the measurement.
    before, after : Chance or None
        Probability of breakdown before and after the measurement; None without a margin.
    of_file : Chance or None
        Probability of breakdown with the ranges of the calibrated file, which contains no correlation of the
        inputs; None without a margin.
    following : tuple of (str, float)
        Quantities to measure next, and the share of the variance of the margin that each removes on average;
        the largest first.
    effective : float
        Effective number of points.
    chain : bool
        Whether a Markov chain drew the points.
    samples : int
        Number of points.
    case : case or None
        Case with the updated ranges; None if nothing explains the measurement.
    verdict : Verdict
        Verdict with the updated probability.
    warnings : tuple of ResultWarning
        Warnings about the measurement and the points.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208.toml"))
    >>> case = case.replace({"measured.capacitance": "250 pF +- 8 %"})
    >>> calibration = ehlectric.calibrate(case, samples=64)
    >>> calibration.explained, [row.quantity for row in calibration.rows]
    (True, ['capacitance'])
    """

    result_kind: ClassVar[ResultKind] = "calibration"

    title: str
    source: str
    inputs: tuple[CalibratedInput, ...]
    correlation: Array
    rows: tuple[Compared, ...]
    unexplained: Unexplained | None
    before: Chance | None
    after: Chance | None
    of_file: Chance | None
    following: tuple[tuple[str, float], ...]
    effective: float
    chain: bool
    samples: int
    case: Any = field(compare=False)
    verdict: Verdict = field(compare=False)
    warnings: tuple[ResultWarning, ...] = ()

    @property
    def explained(self) -> bool:
        """Whether inputs within the ranges explain the measurement."""
        return self.unexplained is None

    def summary(self) -> dict[str, Any]:
        """Return the values as in summary.json, SI units; None instead of NaN."""
        return dict(
            plain(
                {
                    "schema": SCHEMA,
                    "version": __version__,
                    "title": self.title,
                    "source": self.source,
                    "explained": self.explained,
                    **texts_and_codes(self.warnings),
                    **self.verdict.as_data(),
                    "inputs": [asdict(entry) for entry in self.inputs],
                    "correlation": self.correlation.tolist(),
                    "measured": [asdict(row) for row in self.rows],
                    "unexplained": None if self.unexplained is None else asdict(self.unexplained),
                    "before": _chance(self.before),
                    "after": _chance(self.after),
                    "of_file": _chance(self.of_file),
                    "next": [{"quantity": name, "reduction": part} for name, part in self.following],
                    "effective_samples": self.effective,
                    "samples": self.samples,
                    "chain": self.chain,
                }
            )
        )

    def to_dataframe(self) -> pd.DataFrame:
        """Return the measured values as a table of pandas, as in compared.csv.

        Returns
        -------
        pandas.DataFrame
            A row for each measured value, in the SI unit of its quantity.
        """
        import pandas as pd

        heads, rows = self._table()
        return pd.DataFrame(rows, columns=heads)

    def contents(self, text: str | None = None) -> dict[str, Content]:
        """Return the content of summary.json, compared.csv and, if the measurement is explained, the case
        file calibrated.toml by their names.

        ``text``, text of the updated case; by default all values in SI units.
        """
        contents: dict[str, Content] = {SUMMARY: json_of(self.summary()), COMPARED: csv_of(*self._table())}
        if self.case is not None:
            source = printable(self.source)
            heads = [f"# Ranges from 5 % to 95 % after the measurement in {source}, by ehlectric calibrate."]
            if self.after is not None and self.of_file is not None:
                heads += [
                    f"# Probability of breakdown after the measurement: {self.after.brief}.",
                    f"# With these ranges: {self.of_file.brief}. They contain no correlation of the inputs.",
                ]
            contents[CALIBRATED] = "\n".join([*heads, "", text or self.case.to_toml()]).encode()
        return contents

    def _table(self) -> tuple[list[str], list[list[Any]]]:
        """Heads and rows of compared.csv."""
        ends = ("5", "50", "95")
        heads = ["quantity", "unit", "point", "line", "measured", "uncertainty"]
        heads += [f"before_{end}" for end in ends] + [f"after_{end}" for end in ends]
        heads += ["nearest", column_head("residual", ""), "decided"]
        rows = []
        for row in self.rows:
            after = row.posterior or ("", "", "")
            first = [row.quantity, row.unit, row.point, "" if row.line is None else row.line]
            values = [row.measured, row.uncertainty, *row.prior, *after, row.nearest, row.residual]
            rows.append([*first, *values, row.decided])
        return heads, rows

    def _headline(self) -> str:
        """Title, number of measured values, and probabilities on one line."""
        count = f"{len(self.rows)} measured values"
        if not self.explained:
            return headline(self.title, count, "not explained")
        if self.before is None or self.after is None:
            return headline(self.title, count)
        change = f"probability of breakdown {self.before.brief} before, {self.after.brief} after"
        return headline(self.title, count, change)


def row_text(row: Compared | MeasuredValue) -> str:
    """Name of a measured value in words, with its line in the file."""
    return quantity_text(row.quantity) + ("" if row.line is None else f" in line {row.line}")


def _chance(chance: Chance | None) -> Mapping[str, Any] | None:
    """Probability of breakdown and margins as in summary.json."""
    if chance is None:
        return None
    return {
        "breakdown_probability": chance.probability,
        "breakdown_probability_error": chance.error,
        "margin_low": chance.low,
        "margin_median": chance.median,
        "margin_high": chance.high,
        "failed": chance.failed,
    }
