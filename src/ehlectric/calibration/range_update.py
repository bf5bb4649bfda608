"""Calibration of a case: its uncertain inputs are updated by measured values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import MARGIN, is_factor
from ehlectric.calibration.causes import CauseSearch, ends_of
from ehlectric.calibration.models import Model, model_of, points_of
from ehlectric.calibration.posterior import (
    LEAST_EFFECTIVE,
    SEED,
    Posterior,
    equal_points,
    infer,
    weighted_quantiles,
    weights_of,
)
from ehlectric.calibration.result import (
    CalibratedInput,
    Calibration,
    Cause,
    Compared,
    Quantiles,
    Unexplained,
    row_text,
)
from ehlectric.cases.input_keys import unit_of
from ehlectric.cases.measured_inputs import (
    AxleMeasured,
    Measured,
    MeasuredPoints,
    MeasuredValue,
    measured_points,
)
from ehlectric.cases.measurements import (
    BACKGROUND,
    UNCERTAINTY,
    calibrated,
    parsed_option,
    quantity_text,
    void_rows,
)
from ehlectric.cases.table_edits import flattened
from ehlectric.discharge.breakdown_rule import INTERVAL, Chance, sampling_error
from ehlectric.drive import RECORDED, measured_shaft
from ehlectric.errors import InputError
from ehlectric.formulas.sobol import sobol_points
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.statement import Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.runtime.progress import Progress, silent

if TYPE_CHECKING:
    import pandas as pd

# Points of the design, of the posterior as a verdict takes it, and of polynomials.
_SAMPLES, _DRAWN, _DENSE = 512, 512, 8192

# Points at which the measured values of a file are checked.
_CHECKED = 64

# Number of operating points above which half of the design is computed, if polynomials need no more points.
_FEW_POINTS = 32

# Share of the variance of an input above which a measured value decides it, and above which its range in the
# calibrated file is the updated one.
_DECIDES = 0.05

# Removed variance in sampling errors above which it counts. Points of a Markov chain are not independent, so
# that three errors are about two.
_CERTAIN = 3.0

# End of the keys of a capacitance in parallel to a bearing.
_PARALLEL = "parallel_capacitance"

# Number of points at which predictions of one operating point are equal, and largest number of values that a
# note names.
_EQUAL, _NAMED = 16, 4

# Measured divided by computed value, or its inverse, between which a deviation is stated as a factor.
_AS_FACTOR, _MOST_FACTOR = 3.0, 1e9

# Largest number of quantities to measure next, and least margin of which the logarithm counts.
_NEXT, _LEAST_MARGIN = 3, 0.05


def calibrate(
    case: Any,
    measured: str | Path | pd.DataFrame | None = None,
    *,
    background: str | float | None = None,
    uncertainty: str | float | None = None,
    samples: int = _SAMPLES,
    seed: int = SEED,
    progress: Progress = silent,
) -> Calibration:
    """Update the uncertain inputs of a case by measured values, by Bayes' rule.

    Inputs are evenly distributed over their ranges before the measurement: ranges of the file, and the usual
    ranges of other inputs. Films are from the atlas or from formulas, also for a file with solved contacts.

    Parameters
    ----------
    case : BearingCase, DriveCase, GearCase or AxleCase
        Case with its ranges, and with the table ``measured`` unless a file or a table is given.
    measured : str, Path or pandas.DataFrame, optional
        File or table of measured operating points, such as the columns ``speed [rpm]``, ``capacitance [pF]``
        and ``uncertainty of capacitance [%]``. An uncertainty is one standard deviation. It replaces the file
        that the table ``measured`` names; the values of this table are used in addition.
    background : str or float, optional
        Capacitance of leads and fixture in parallel, such as "130 pF" or a number in farads, which is taken
        off each measured capacitance; not together with a ``parallel_capacitance`` of a bearing.
    uncertainty : str or float, optional
        Relative standard uncertainty, such as "5 %", of columns of the file without one.
    samples : int
        Number of points of the Sobol design, a power of 2. Half of them are computed for more than 32
        operating points if at most six inputs have an effect.
    seed : int
        Seed of all random numbers.
    progress : callable, optional
        Called with the number of parts done, the number of all parts, and a text.

    Returns
    -------
    Calibration
        Ranges before and after, measured next to computed values, probability of breakdown and verdict.
        ``explained`` is False, and no range is updated, if nothing within the ranges explains the
        measurement.

    Raises
    ------
    InputError
        If there is no measurement, the model does not compute a measured quantity, or a value has no
        uncertainty; if weights collapse and the extra "calibration" is not installed.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208.toml")).replace(
    ...     {"measured.capacitance": "250 pF +- 8 %", "measured.shaft_voltage": "4.6 V +- 10 %"}
    ... )
    >>> calibration = ehlectric.calibrate(case, samples=256)
    >>> calibration.explained, len(calibration.rows)
    (True, 2)
    """
    model = model_of(case)
    given = given_points(
        case, measured, background=background, uncertainty=uncertainty, quantities=model.quantities
    )
    _check(model, given)
    compared = _Compared(model, given, seed, progress)
    posterior = infer(
        compared.predict,
        len(model.names()),
        given_values(given),
        given_errors(given),
        samples=samples,
        seed=seed,
        errors=compared.errors,
        sparing=len(given.points) > _FEW_POINTS,
    )
    return compared.calibration(case, posterior)


def check_measured(case: Any) -> None:
    """Check the table ``measured`` of a case as ``calibrate`` does, at few points and without simulation.

    Raises InputError as ``calibrate``, for a value that the model does not compute.
    """
    model = model_of(case)
    given = given_points(case, quantities=model.quantities)
    _check(model, given)
    quick = replace(
        given, values=tuple(value for value in given.values if value.quantity in model.candidates)
    )
    if quick.values:
        _Compared(model, quick, SEED, silent).predict(sobol_points(len(model.names()), _CHECKED, SEED))


def given_points(
    case: Any,
    measured: str | Path | pd.DataFrame | None = None,
    *,
    background: str | float | None = None,
    uncertainty: str | float | None = None,
    quantities: Sequence[str] | None = None,
) -> MeasuredPoints:
    """Measured values of a case, and of a file or a table, with the arguments and errors of ``calibrate``.

    ``quantities``, names of the quantities that a record of the shaft voltage gives; None for all.
    """
    table: Measured | AxleMeasured | None = case.measured
    if measured is None and table is None:
        raise InputError.missing("measured", "a table [measured], or a file of measured operating points")
    off, part = 0.0, None
    if background is not None:
        stated = [
            key for key, value in flattened(case.to_dict()).items() if key.endswith(_PARALLEL) and value
        ]
        if stated:
            raise InputError("background", got=f"it together with {stated[0]}", takes="one of the two")
        off = parsed_option(BACKGROUND, "background", background)
    if uncertainty is not None:
        part = parsed_option(UNCERTAINTY, "uncertainty", uncertainty, takes='a part in per cent, as "2 %"')
    given = measured_points(table, points_of(case), measured, background=off, uncertainty=part)
    record = getattr(table, "shaft_record", None)
    if record is None:
        return given
    estimates, warnings = measured_shaft(record)
    pairs = {
        name: (estimate.value, estimate.uncertainty)
        for name, estimate in estimates.items()
        if quantities is None or name in quantities
    }
    given = given.with_record(pairs, warnings)
    if not given.values:
        takes = f"a record that determines one of {', '.join(RECORDED)}; {' '.join(map(str, warnings))}"
        raise InputError("measured.shaft_record", got="no quantity of this case", takes=takes)
    return given


def _check(model: Model, given: MeasuredPoints) -> None:
    """Refuse quantities that the model does not compute."""
    for value in given.values:
        if value.quantity not in model.quantities:
            takes = f"one of {', '.join(model.quantities)}"
            raise InputError(f"measured.{value.quantity}", got="a value", takes=takes)


def given_values(given: MeasuredPoints) -> Array:
    """Measured values, SI units, shape (m,)."""
    return np.array([value.value for value in given.values])


def given_errors(given: MeasuredPoints) -> Array:
    """Standard uncertainties of the measured values, SI units, shape (m,)."""
    return np.array([value.uncertainty for value in given.values])


@dataclass(frozen=True)
class _Compared:
    """Model next to measured values."""

    model: Model
    given: MeasuredPoints
    seed: int
    progress: Progress
    checked: list[int] = field(default_factory=list)  # points of the design, once they are computed

    def errors(self, at: Array) -> Array:
        """Standard deviations of the predictions at inputs from 0 to 1, shape (n, k) -> (n, m)."""
        names = tuple(dict.fromkeys(value.quantity for value in self.given.values))
        errors = self.model.errors(at, self.given.points, names)
        return np.stack([errors[value.quantity][:, value.point] for value in self.given.values], axis=-1)

    def predict(self, at: Array) -> Array:
        """Predictions of the measured values at inputs from 0 to 1, shape (n, k) -> (n, m)."""
        self.progress(0, 0, f"computing {len(at)} points")
        names = tuple(dict.fromkeys(value.quantity for value in self.given.values))
        numbers = self.model.numbers(at, self.given.points, names)
        columns = [numbers[value.quantity][:, value.point] for value in self.given.values]
        if not self.checked:
            # The points of the design: a chain may be where nothing is computed.
            self.checked.append(len(at))
            for value, column in zip(self.given.values, columns, strict=True):
                if not np.any(np.isfinite(column)):
                    raise _without_prediction(value, self.given)
        return np.stack(columns, axis=-1)

    def calibration(self, case: Any, posterior: Posterior) -> Calibration:
        """Result of the calibration of a case."""
        drawn = posterior.at[equal_points(posterior.weights, _DRAWN)]
        numbers = self.model.numbers(drawn, [{}], (*self.model.candidates, MARGIN))
        margins = numbers.pop(MARGIN)[:, 0]
        before = _chance(self.model.numbers(posterior.prior_at, [{}], (MARGIN,))[MARGIN][:, 0])
        after = _chance(margins, posterior.effective) if posterior.explained else None
        inputs = tuple(self._inputs(posterior))
        if after is not None:
            after = _with_first(after, inputs, drawn, margins)
        rows = tuple(self._rows(posterior))
        warnings = tuple(self._warnings(posterior))
        updated = self._updated(inputs) if posterior.explained else None
        following = tuple(self._following(numbers, margins)) if after is not None else ()
        unexplained = None if posterior.explained else self._unexplained(posterior)
        of_file = None if after is None else self._of_file(updated, posterior)
        verdict = self._verdict(updated, (before, after, of_file), rows, unexplained, following)
        return Calibration(
            title=case.title,
            source="[measured]" if self.given.read is None else self.given.read.source,
            inputs=inputs,
            correlation=posterior.correlation,
            rows=rows,
            unexplained=unexplained,
            before=before,
            after=after,
            of_file=of_file,
            following=following,
            effective=posterior.effective,
            chain=posterior.chain,
            samples=len(posterior.at),
            case=updated,
            verdict=verdict,
            warnings=warnings,
        )

    def _of_file(self, updated: Any, posterior: Posterior) -> Chance | None:
        """Chance of breakdown of the case with the updated ranges, whose inputs are independent."""
        model = model_of(updated)
        design = sobol_points(len(model.names()), len(posterior.prior_at), self.seed)
        return _chance(model.numbers(design, [{}], (MARGIN,))[MARGIN][:, 0])

    def _inputs(self, posterior: Posterior) -> Iterator[CalibratedInput]:
        """Inputs before and after the measurement."""
        quantiles = posterior.quantiles(INTERVAL)
        mean = posterior.weights @ posterior.at
        squares = np.square(posterior.at - mean)
        variance = posterior.weights @ squares
        # Standard deviation of a weighted mean of independent points.
        spread = np.sqrt(np.square(posterior.weights) @ np.square(squares - variance))
        reductions, spreads = 1.0 - 12.0 * variance, 12.0 * spread
        explained, names = posterior.explained, self.model.names()
        changed = posterior.active & (reductions > np.maximum(_DECIDES, _CERTAIN * spreads))
        for place, (name, after) in enumerate(zip(names, quantiles, strict=True)):
            low, high = ends_of(name)
            yield CalibratedInput(
                key=name.key,
                label=name.label,
                assumed=name.assumed,
                low=low,
                high=high,
                prior=self._values(place, np.array(INTERVAL)),
                posterior=self._values(place, after) if explained else None,
                reduction=float(reductions[place]) if explained else None,
                reduction_error=float(spreads[place]) if explained else None,
                updated=explained and bool(changed[place]),
            )

    def _values(self, place: int, parts: Array) -> Quantiles:
        """Values of an input at parts of its range, SI units."""
        low, median, high = self.model.values(place, parts).tolist()
        return low, median, high

    def _rows(self, posterior: Posterior) -> Iterator[Compared]:
        """Measured values next to computed ones."""
        decided, errors = self._decided(posterior), posterior.uncertainties
        even = np.full(len(posterior.prior_at), 1.0 / len(posterior.prior_at))
        for place, value in enumerate(self.given.values):
            column = posterior.predictions[:, place]
            after = _quantiles(column, posterior.weights) if posterior.explained else None
            nearest = float(posterior.nearest.predictions[place])
            if after is None:
                residual = float(posterior.residuals[place])
            else:
                mean = posterior.weights @ np.nan_to_num(column)
                spread = posterior.weights @ np.square(np.nan_to_num(column) - mean)
                residual = (value.value - after[1]) / float(np.hypot(errors[place], np.sqrt(spread)))
            key, share = decided[place]
            yield Compared(
                quantity=value.quantity,
                unit=calibrated(value.quantity).unit,
                point=value.point,
                line=value.line,
                measured=value.value,
                uncertainty=value.uncertainty,
                prior=_quantiles(posterior.prior_predictions[:, place], even),
                posterior=after,
                nearest=nearest,
                residual=residual,
                decided=key,
                decided_share=share,
            )

    def _decided(self, posterior: Posterior) -> list[tuple[str, float]]:
        """Input whose variance is reduced most by each measured value without the others, with the share."""
        if posterior.emulator is None:
            return [("", 0.0)] * len(self.given.values)
        names, width = self.model.names(), posterior.at.shape[1]
        low, high = posterior.emulator.low, posterior.emulator.high
        dense = low + (high - low) * sobol_points(width, _DENSE, self.seed)
        predictions = posterior.emulator.at(dense)
        spread = np.hypot(posterior.uncertainties, posterior.emulator.deviation(given_values(self.given)))
        decided = []
        for place, value in enumerate(self.given.values):
            weights = weights_of(np.square((predictions[:, place] - value.value) / spread[place]))
            variance = weights @ np.square(dense - weights @ dense)
            reduced = 1.0 - 12.0 * variance / np.square(high - low)
            best = int(np.argmax(reduced))
            share = float(reduced[best])
            decided.append((names[best].key, share) if share > _DECIDES else ("", 0.0))
        return decided

    def _following(self, numbers: dict[str, Array], margins: Array) -> Iterator[tuple[str, float]]:
        """Quantities to measure next, with the share of the variance of ln(margin) that each removes.

        For values that are jointly normal, a measured value with the variance s^2 of a quantity with the
        variance v removes r^2 v/(v + s^2), with the correlation r of the quantity and ln(margin).
        """
        logs = np.log(np.maximum(margins, _LEAST_MARGIN))
        parts = {}
        for name, values in numbers.items():
            column, known = values[:, 0], np.isfinite(values[:, 0]) & np.isfinite(logs)
            if np.count_nonzero(known) < 0.5 * known.size or not np.ptp(column[known]) or not np.ptp(logs):
                continue
            usual = calibrated(name)
            error = usual.relative * abs(float(np.mean(column[known]))) + usual.absolute
            variance = float(np.var(column[known]))
            r = float(np.corrcoef(column[known], logs[known])[0, 1])
            parts[name] = r**2 * variance / (variance + error**2)
        yield from sorted(parts.items(), key=lambda pair: -pair[1])[:_NEXT]

    def _updated(self, inputs: Sequence[CalibratedInput]) -> Any:
        """Case with the updated ranges of inputs that the measurement decided."""
        values, ranges = {}, {}
        for entry in inputs:
            if entry.posterior is not None and entry.updated:
                low, median, high = (float(f"{end:.6g}") for end in entry.posterior)
                values[entry.key], ranges[entry.key] = median, (low, high)
        return self.model.updated(values, ranges)

    def _verdict(
        self,
        updated: Any,
        chances: tuple[Chance | None, Chance | None, Chance | None],
        rows: Sequence[Compared],
        unexplained: Unexplained | None,
        following: Sequence[tuple[str, float]],
    ) -> Verdict:
        """Verdict with the updated probability; grey if nothing explains the measurement. ``chances``, of
        breakdown before and after the measurement, and with the ranges of the calibrated file.
        """
        if unexplained is not None:
            return _refused(rows, unexplained)
        before, after, of_file = chances
        verdict = self.model.verdict(updated, after)
        reasons = []
        if before is not None:
            reasons.append(Statement.of("before-measurement", probability=before.stated))
        if after is not None and of_file is not None and _differ(after, of_file):
            reasons.append(Statement.of("without-correlation", probability=of_file.stated))
        if following:
            name, part = following[0]
            reasons.append(Statement.of("measure-next", quantity=quantity_text(name), share=part))
        kept = (each for each in verdict.reasons if each.code != "measure-first")
        return replace(verdict, reasons=(*kept, *reasons))

    def _unexplained(self, posterior: Posterior) -> Unexplained:
        """What nothing within the ranges explains, and why."""
        values, errors, nearest = given_values(self.given), posterior.uncertainties, posterior.nearest
        far = np.flatnonzero(np.abs(posterior.residuals) > posterior.limit).tolist()
        alone = np.min(np.abs(posterior.prior_predictions - values) / errors, axis=0)
        rows = tuple(far or [int(np.argmax(np.abs(posterior.residuals)))])
        unreachable = [place for place in rows if alone[place] > posterior.limit]
        search = CauseSearch(self.model, self.given.values, self.predict, posterior, self.seed, self.progress)
        contradicting = () if unreachable or values.size < 2 else tuple(search.contradicting())
        causes = search.causes(contradicting)
        return Unexplained(rows, posterior.limit, nearest.p_value, causes, contradicting)

    def _warnings(self, posterior: Posterior) -> Iterator[ResultWarning]:
        """Warnings about the files, and about too few points."""
        yield from self.given.warnings
        read = self.given.read
        if read is not None:
            yield from void_rows(read)
            if read.ignored:
                yield ResultWarning.of("columns-ignored", file=read.source, columns=", ".join(read.ignored))
        for places in self._repeated(posterior):
            texts = " and ".join(row_text(self.given.values[place]) for place in places[:_NAMED])
            yield ResultWarning.of("measured-twice", values=texts)
        if posterior.widened > 1.0:
            yield ResultWarning.of("effective-samples-few", "widened", factor=posterior.widened)
        elif posterior.explained and posterior.effective < LEAST_EFFECTIVE:
            yield ResultWarning.of("effective-samples-few", effective=posterior.effective)

    def _repeated(self, posterior: Posterior) -> Iterator[list[int]]:
        """Places of the values of one quantity at one operating point, at which all predictions are equal."""
        groups: dict[object, list[int]] = {}
        for place, value in enumerate(self.given.values):
            column = posterior.prior_predictions[:_EQUAL, place]
            key = value.quantity, *(f"{number:.6g}" for number in column.tolist())
            groups.setdefault(key, []).append(place)
        yield from (places for places in groups.values() if len(places) > 1)


# What a case needs for its quantities.
_CONDUCTING = "and elements that conduct or have bearing.element_capacitance"
_NEEDS = {
    "first_breakdown_voltage": "a case with discharge.dielectric_strength, and elements that conduct",
    "breakdown_voltage": "a case with discharge.dielectric_strength, and elements that conduct",
    "shaft_voltage": f"a case with [motor], {_CONDUCTING}",
    "bearing_voltage_ratio": f"a case with [motor], {_CONDUCTING}",
    "capacitance": f"films without asperity contact, {_CONDUCTING}",
}


def _without_prediction(value: MeasuredValue, given: MeasuredPoints) -> InputError:
    """Error of a measured value that the model does not compute at any inputs within their ranges."""
    where = "" if given.read is None else f" in line {value.line} of {given.read.source}"
    got = f"a value{where if value.line else ''} that the model does not compute"
    takes = _NEEDS.get(
        value.quantity.rpartition(".")[2], "an operating point at which the model has a result"
    )
    return InputError(f"measured.{value.quantity}", got=got, takes=takes)


def _refused(rows: Sequence[Compared], unexplained: Unexplained) -> Verdict:
    """Verdict that nothing within the ranges explains the measurement, with its causes."""
    place = max(unexplained.rows, key=lambda k: abs(rows[k].residual))
    row = rows[place]
    values: dict[str, Any] = {
        "quantity": row_text(row),
        "measured": (row.measured, row.unit),
        "nearest": (row.nearest, row.unit),
    }
    factor = row.measured / row.nearest if row.nearest and row.measured and row.unit != "K" else 1.0
    if _AS_FACTOR < max(factor, 1.0 / factor) < _MOST_FACTOR:
        answer = Statement.of("unexplained-factor", factor=factor, **values)
    else:
        answer = Statement.of("unexplained", off=abs(row.residual), **values)
    reasons = [_cause(cause) for cause in unexplained.causes]
    if unexplained.contradicting:
        names = tuple(row_text(rows[k]) for k in unexplained.contradicting)
        reasons.append(Statement.of("measured-contradict", quantities=names))
    elif not reasons:
        reasons.append(Statement.of("cause-unknown"))
    return Verdict("grey", "measurement-unexplained", answer, reasons=tuple(reasons))


def _cause(cause: Cause) -> Statement:
    """Statement on a cause, with the largest deviation after its change."""
    values: dict[str, Any] = {"residual": cause.residual}
    if cause.kind == "factor":
        meaning = Statement.of(cause.meaning)
        values |= {"quantity": cause.label, "factor": cause.needed, "meaning": meaning}
        return Statement.of("cause-factor", **values)
    unit = "" if is_factor(cause.key) else unit_of(cause.key) if cause.kind == "input" else "F"
    low, high = ((end, unit) for end in cause.range or ())
    values |= {"needed": (cause.needed, unit), "low": low, "high": high}
    if cause.kind == "parallel":
        return Statement.of("cause-parallel", quantity=cause.label, **values)
    return Statement.of("input-leaves-range", input=cause.label, **values)


def _differ(first: Chance, second: Chance) -> bool:
    """Whether two probabilities differ by more than their sampling errors."""
    return abs(first.probability - second.probability) > first.error + second.error


def _chance(margins: Array, effective: float | None = None) -> Chance | None:
    """Chance of margins, shape (n,); None where no point has one. ``effective``, effective number of points,
    which gives the sampling errors.
    """
    known = np.isfinite(margins)
    if not np.any(known):
        return None
    chance = Chance.of(margins[known], int(np.count_nonzero(~known)))
    if effective is None:
        return chance
    number = max(round(effective), 1)
    wider = float(np.sqrt(margins.size / number))
    return replace(
        chance,
        error=sampling_error(chance.probability, number),
        margin_error=max(wider, 1.0) * chance.margin_error,
    )


def _with_first(chance: Chance, inputs: Sequence[CalibratedInput], at: Array, margins: Array) -> Chance:
    """Chance with the input whose correlation with ln(margin) is largest after the measurement."""
    known = np.isfinite(margins)
    logs = np.log(np.maximum(margins[known], _LEAST_MARGIN))
    if not np.ptp(logs):
        return chance
    varied = [k for k in range(len(inputs)) if np.ptp(at[known, k])]
    squares = {k: float(np.corrcoef(at[known, k], logs)[0, 1]) ** 2 for k in varied}
    first = max(squares, key=lambda k: squares[k])
    return replace(chance, first=inputs[first].label, share=squares[first])


def _quantiles(values: Array, weights: Array) -> Quantiles:
    """Quantiles of computed values; NaN where none has a weight."""
    known = np.isfinite(values) & (weights > 0.0)
    if not np.any(known):
        return (float("nan"),) * 3
    low, median, high = weighted_quantiles(values[known], weights[known] / np.sum(weights[known]), INTERVAL)
    return float(low), float(median), float(high)
