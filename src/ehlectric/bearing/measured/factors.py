"""Film factors of a bearing from a measurement of its capacitance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.accuracy import percent
from ehlectric.bearing.measured.forward import FilmState, OperatingPoint, check_films_measured
from ehlectric.bearing.measured.inverse import NoFactorError, film_factor_of, slope_at
from ehlectric.bearing.measured.ranges import background_effect, shared_effects
from ehlectric.bearing.measured.solved import Correction, solved_correction
from ehlectric.bearing.quick.ways import is_quick
from ehlectric.bearing.solution import CONDUCTING
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.ways import OF_CONTACTS
from ehlectric.cases.measurements.average import mean_factor, slope_of
from ehlectric.cases.measurements.factors import FilmFactors, fitted_columns
from ehlectric.cases.measurements.meter import MeasuredCapacitance, capacitance_of
from ehlectric.cases.measurements.notes import measurement_warnings, temperature_warnings
from ehlectric.cases.measurements.reading import Measurement
from ehlectric.errors import InputError, ResultWarning
from ehlectric.runtime.progress import Progress, silent

# Largest number of different speeds and temperatures, each of which takes some tenths of a second.
MOST_POINTS = 1000

# Columns that the measurement itself fills, and those that the search fills.
_SEARCHED = ("computed", "film_factor", "minimum_thickness", "lambda_ratio")


@dataclass(frozen=True, eq=False)
class _Search:
    """Search for the film factors of rows, with what all rows share."""

    case: BearingCase
    correction: Correction
    rows: tuple[Mapping[str, Any], ...]

    def found(self, targets: Array, progress: Progress) -> tuple[dict[str, Array], Array, tuple[str, ...]]:
        """Columns of the search, slopes d ln C/d ln f of the rows, and reasons of rows without a factor."""
        n = len(self.rows)
        columns = {name: np.full(n, np.nan) for name in _SEARCHED}
        slopes, reasons = np.full(n, np.nan), [""] * n
        points: dict[tuple[Any, ...], OperatingPoint] = {}
        guess = 1.0
        for k, (row, target) in enumerate(zip(self.rows, targets.tolist(), strict=True)):
            progress(k, n, "film factors")
            key = tuple(row.values())
            try:
                if key not in points:
                    points[key] = OperatingPoint.of(self.case, row)
                values = _row(points[key], self.correction, target, guess)
            except (InputError, NoFactorError) as error:
                reasons[k] = str(error)
                continue
            *searched, slopes[k], reasons[k] = values
            for name, value in zip(_SEARCHED, searched, strict=True):
                columns[name][k] = value
            guess = columns["film_factor"][k] if np.isfinite(columns["film_factor"][k]) else guess
        progress(n, n, "film factors")
        columns["minimum_thickness"] = columns["lambda_ratio"] * self.case.bearing.composite_rq
        return columns, slopes, tuple(reasons)


def _row(
    point: OperatingPoint, correction: Correction, target: float, guess: float
) -> tuple[float, float, float, float, float, str]:
    """Computed capacitance, film factor, film (filled later), lambda ratio, slope, and reason of a row."""

    def state(factor: float) -> FilmState:
        return correction.of(point.at(factor))

    def value(factor: float) -> float:
        return state(factor).capacitance

    none = float("nan")
    try:
        computed = value(1.0)
    except InputError:
        # The film at a film factor of 1 may be too thin or too thick, and that of the row is not.
        computed = none
    if not target > 0.0:
        why = "its phase is not that of a capacitor" if np.isnan(target) else "it is not above the background"
        return computed, none, none, none, none, why
    try:
        factor = film_factor_of(value, target, guess)
        slope = slope_at(value, factor)
    except NoFactorError as error:
        return computed, none, none, none, none, str(error)
    ratio = state(factor).lambda_ratio
    if ratio < CONDUCTING:
        why = f"its film would have a lambda ratio of {ratio:.2g}, at which surfaces touch and conduct"
        return computed, none, none, none, none, why
    return computed, factor, none, ratio, slope, ""


def bearing_factors(
    case: BearingCase,
    measured: Measurement,
    *,
    background: float | None = None,
    uncertainty: float | None = None,
    progress: Progress = silent,
    workers: int | None = None,
) -> FilmFactors:
    """Film factors of a bearing that explain its measured capacitance, row by row, and their mean.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing. Its speed and temperature stand for those that the measurement does not have;
        its film factor is not used.
    measured : Measurement
        Rows with a capacitance, or with magnitude, phase and frequency of an impedance.
    background : float, optional
        Capacitance [F] of leads, cage and fixture in parallel, which is taken off every row; by default
        ``bearing.parallel_capacitance`` of the case, where it has one.
    uncertainty : float, optional
        Relative standard uncertainty of the capacitance, where the measurement states none.
    progress : callable, optional
        Called with the number of parts done, the number of all parts, and a text.
    workers : int, optional
        Number of processes for solved contacts.

    Returns
    -------
    FilmFactors
        Rows, mean with its interval, and warnings.

    Raises
    ------
    InputError
        Where the measurement has no capacitance, or too many different speeds; where the bearing has ceramic
        elements, cannot be computed, or no row can be used.
    ConvergenceError
        Where a solved contact does not converge.
    """
    check_films_measured(case)
    meter = capacitance_of(measured, uncertainty)
    own = background is None
    background = case.bearing.parallel_capacitance if background is None else background
    rows, off = _changes(case, measured), background or 0.0
    targets = meter.value - off
    if not np.any(targets > 0.0):
        raise InputError(
            measured.source,
            f"has no capacitance above the background of {1e12 * off:.4g} pF",
            takes="at least one row above it",
        )
    OperatingPoint.of(case, rows[0])
    correction = Correction.none()
    if case.contacts == "solved":
        correction = solved_correction(case, rows, targets, progress, workers)
    columns, slopes, reasons = _Search(case, correction, rows).found(targets, progress)
    search = columns, slopes, reasons
    return _result(case, measured, meter, (background, own), search, correction, rows)


def _changes(case: BearingCase, measured: Measurement) -> tuple[Mapping[str, Any], ...]:
    """Changes of the case that make each row: speed [rad/s], and temperature [K] where it was measured.

    A measured temperature is that of the oil. Rings and other parts that have their own temperature in the
    case keep their difference from it.
    """
    if measured.has("entrainment_speed") and not measured.has("speed"):
        raise InputError(
            f"{measured.source}: entrainment_speed", got="a speed in m/s", takes="a column 'speed [rpm]'"
        )
    speeds = measured.values.get("speed", np.full(measured.size, case.bearing.inner_speed))
    keys = {"bearing.inner_speed": speeds}
    if measured.has("temperature"):
        warmer = measured.values["temperature"] - case.bearing.oil_temperature
        for key, own in case.bearing.all_temperatures().items():
            keys[f"bearing.{key}"] = own + warmer
    rows = tuple(dict(zip(keys, map(float, row), strict=True)) for row in zip(*keys.values(), strict=True))
    different = len({tuple(row.values()) for row in rows})
    if different > MOST_POINTS:
        raise InputError(
            measured.source,
            f"has {different} different speeds and temperatures",
            takes=f"at most {MOST_POINTS}; average neighbouring rows, or round their speed and temperature",
        )
    return rows


def _result(
    case: BearingCase,
    measured: Measurement,
    meter: MeasuredCapacitance,
    taken_off: tuple[float | None, bool],
    search: tuple[dict[str, Array], Array, tuple[str, ...]],
    correction: Correction,
    rows: tuple[Mapping[str, Any], ...],
) -> FilmFactors:
    """Film factors with their uncertainties, mean and warnings."""
    (background, own_background), (searched, slopes, reasons) = taken_off, search
    factors = searched["film_factor"]
    found, targets = np.isfinite(factors), meter.value - (background or 0.0)
    speeds = np.array([row["bearing.inner_speed"] for row in rows])
    stated = None if meter.uncertainty is None else meter.uncertainty / targets / -slopes
    used = tuple(row for row, one in zip(rows, found, strict=True) if one)
    shared, left_out = shared_effects(case, used, factors[found], slopes[found], correction.of)
    if own_background:
        shared |= background_effect(case, targets[found], slopes[found])
    error = _error(case, rows, factors) if is_quick(case) else None
    mean = trend = None
    if np.any(found):
        own = None if stated is None else stated[found]
        mean = mean_factor(factors[found], own, shared)
        trend = slope_of(speeds[found], factors[found], own)
    columns = _measured_columns(measured, meter, rows, targets) | {
        "computed": searched["computed"],
        "film_factor": factors,
        **({} if stated is None else {"factor_uncertainty": stated * factors}),
        **_systematic(shared, factors, found),
        **fitted_columns(targets, factors, slopes, mean),
        "minimum_thickness": searched["minimum_thickness"],
        "lambda_ratio": searched["lambda_ratio"],
    }
    warnings = (
        *_film_warnings(case, error),
        *temperature_warnings(measured, case.lubricant),
        *(
            ResultWarning("range-left-out", f"film factors leave out the range of {text}")
            for text in left_out
        ),
        *measurement_warnings(measured, reasons, mean, trend, "speed"),
    )
    return FilmFactors(
        title=case.title,
        source=measured.source,
        quantity="capacitance",
        contacts=case.contacts,
        solves=correction.solves,
        formula_error=error,
        background=background,
        columns=columns,
        reasons=reasons,
        mean=mean,
        slope=trend,
        warnings=warnings,
    )


def _measured_columns(
    measured: Measurement, meter: MeasuredCapacitance, rows: tuple[Mapping[str, Any], ...], targets: Array
) -> dict[str, Array]:
    """Columns with what was measured."""
    columns = {"line": np.array(measured.lines, dtype=float)}
    if measured.has("time"):
        columns["time"] = measured.values["time"]
    columns["speed"] = np.array([row["bearing.inner_speed"] for row in rows])
    if measured.has("temperature"):
        columns["temperature"] = measured.values["temperature"]
    columns["measured_capacitance"] = meter.value
    if meter.resistance is not None:
        columns["parallel_resistance"] = meter.resistance
    columns["capacitance"] = targets
    if meter.uncertainty is not None:
        columns["capacitance_uncertainty"] = meter.uncertainty
    return columns


def _systematic(shared: Mapping[str, Array], factors: Array, found: Array) -> dict[str, Array]:
    """Column with the standard uncertainty of the factors from ranges; none without ranges."""
    if not shared:
        return {}
    column = np.full(len(factors), np.nan)
    column[found] = factors[found] * np.sqrt(sum(change**2 for change in shared.values()))
    return {"factor_systematic": column}


def _error(case: BearingCase, rows: tuple[Mapping[str, Any], ...], factors: Array) -> float:
    """Relative error of films that are not solved, of the rows with the smallest and the largest factor."""
    places = np.flatnonzero(np.isfinite(factors))
    if not places.size:
        return OperatingPoint.of(case, rows[0]).film_error(1.0)
    ends = {int(places[np.argmin(factors[places])]), int(places[np.argmax(factors[places])])}
    return max(OperatingPoint.of(case, rows[k]).film_error(float(factors[k])) for k in ends)


def _film_warnings(case: BearingCase, error: float | None) -> tuple[ResultWarning, ...]:
    """Warning of films that are not solved, whose error is not in the interval of a film factor."""
    if error is None:
        return ()
    text = f"{OF_CONTACTS[case.contacts]}: films may be {percent(error)} off, and so may film factors"
    if case.contacts == "atlas":
        return (ResultWarning("atlas-contacts", text),)
    solved = 'contacts = "solved" takes minutes and has no such error'
    return (ResultWarning("formula-contacts", f"{text}; {solved}"),)
