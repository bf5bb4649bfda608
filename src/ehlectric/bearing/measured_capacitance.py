"""Film factors of a bearing from its measured capacitance: the model over film factor, and its inverse."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.bearing.impedance import meter_capacitance
from ehlectric.bearing.preparation import PreparedBearing, prepare_bearing, with_film_factor
from ehlectric.bearing.quick_contacts import is_quick, required_quick_case
from ehlectric.bearing.solution import BearingSolution, film_error, lambda_ratio
from ehlectric.bearing.solving import POSITIONS, solution_of_prepared
from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.film_factors import (
    FilmFactors,
    fitted_columns,
    mean_factor,
    measurement_warnings,
    slope_of,
    temperature_warnings,
)
from ehlectric.cases.input_ranges import InputRange
from ehlectric.cases.measurements import MeasuredCapacitance, Measurement, capacitance_of
from ehlectric.discharge.film_capacitance import LEAST_RATIO
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.quantities.formats import amount
from ehlectric.quantities.inputs import SPEED
from ehlectric.quantities.lubrication_states import BOUNDARY_LIMIT
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.rows import value_at
from ehlectric.readable import readable
from ehlectric.runtime.progress import Progress, silent

# Film factors that are looked at: a film of a hundredth, and of three times the flooded isothermal one.
LEAST, MOST = 0.01, 3.0

# Tolerance of the logarithm of a film factor, and the step of differences.
_TOLERANCE, _STEP = 1e-9, 0.01

# Step of the search below which the end of the films that can be computed counts as reached.
_CLOSE = 1e-3

# Places next to the first film factor that are tried where its film cannot be computed, in logarithms.
_SHIFTS = (0.0, 0.5, -0.5, 1.0, -1.0, -2.0, -3.0)

# Usual slope of ln(capacitance) over ln(film factor), with which the search starts.
_USUAL = 0.5


class NoFactorError(ValueError):
    """Error of a capacitance that no film factor explains; the text says why."""


def film_factor_of(capacitance: Callable[[float], float], target: float, guess: float = 1.0) -> float:
    """Film factor at which a capacitance has a value.

    ``capacitance``, film factor -> capacitance [F], falling; ``target``, capacitance that is looked for [F].
    Returns film factor between 0.01 and 3, dimensionless. Raises NoFactorError where the capacitance is above
    the capacitance of a film of a hundredth, or below the capacitance of a film three times as thick as the
    isothermal, fully flooded one; where the films cannot be computed.

    Examples
    --------
    >>> round(film_factor_of(lambda factor: 2e-10 * factor**-0.6, 2.5e-10), 6)
    0.689419
    >>> film_factor_of(lambda factor: 2e-10 * factor**-0.6, 1e-11)
    Traceback (most recent call last):
    ehlectric.bearing.measured_capacitance.NoFactorError: below 103.5 pF, the capacitance of a film 3 \
    times as thick as computed for isothermal, fully flooded oil
    """
    least, most = math.log(LEAST), math.log(MOST)

    def excess(x: float) -> float:
        return math.log(_computed(capacitance, x) / target)

    x = min(max(math.log(guess), least), most)
    x, y = _first(excess, x)
    step = 1.2 * abs(y) / _USUAL + 1e-4
    while y != 0.0:
        further = min(max(x + math.copysign(step, y), least), most)
        if further == x:
            raise NoFactorError(_out_of_reach(_computed(capacitance, x), x))
        try:
            other = excess(further)
        except NoFactorError:
            # A film between both may still be one that can be computed.
            step *= 0.5
            if step < _CLOSE:
                raise
            continue
        if (other < 0.0) != (y < 0.0) or other == 0.0:
            low, high = sorted((x, further))
            return math.exp(float(scipy.optimize.brentq(excess, low, high, xtol=_TOLERANCE, rtol=1e-12)))
        x, y, step = further, other, 2.0 * step
    return math.exp(x)


def _first(excess: Callable[[float], float], x: float) -> tuple[float, float]:
    """Place near ``x`` at which the film can be computed, and the value there."""
    failed: NoFactorError | None = None
    for shift in _SHIFTS:
        try:
            return x + shift, excess(x + shift)
        except NoFactorError as error:
            failed = failed or error
    assert failed is not None
    raise failed


def slope_at(capacitance: Callable[[float], float], factor: float) -> float:
    """Slope d ln(capacitance)/d ln(film factor) at a film factor, by a difference to one side.

    Examples
    --------
    >>> round(slope_at(lambda factor: 2e-10 * factor**-0.6, 0.7), 6)
    -0.6
    """
    further = _computed(capacitance, math.log(factor) + _STEP)
    return math.log(further / capacitance(factor)) / _STEP


def _computed(capacitance: Callable[[float], float], x: float) -> float:
    try:
        return capacitance(math.exp(x))
    except InputError as error:
        raise NoFactorError(f"its film cannot be computed: {error}") from None


def _out_of_reach(end: float, x: float) -> str:
    if x > 0.0:
        return (
            f"below {amount(end, 'F')}, the capacitance of a film {MOST:g} times as thick as computed for "
            "isothermal, fully flooded oil"
        )
    return (
        f"above {amount(end, 'F')}, the capacitance of a film of {LEAST:g} of the isothermal, fully "
        "flooded one"
    )


@dataclass(frozen=True)
class FilmState:
    """Bearing at one film factor."""

    # Capacitance that a meter reads, with rough films and a coating, but without what is in parallel [F].
    capacitance: float
    lambda_ratio: float  # smallest film thickness / composite roughness, dimensionless

    @classmethod
    def of(cls, solution: BearingSolution) -> FilmState:
        """State of a solved bearing. Raises InputError where its films are so thin that the roughness leaves
        their capacitance open.
        """
        capacitance, ratio = meter_capacitance(solution), float(lambda_ratio(solution))
        if capacitance is None:
            raise InputError.worded(
                "bearing.composite_rq",
                f"is more than 1/{LEAST_RATIO:g} of a central film (lambda ratio {readable(ratio, 2)}), "
                "at which asperities are in contact",
            )
        return cls(float(capacitance), ratio)


@dataclass(frozen=True, eq=False)
class OperatingPoint:
    """Bearing at one speed and temperature, whose film factor is free.

    Loads and speeds of the elements do not depend on the film factor, so they are computed once.
    """

    case: BearingCase  # case at this speed and temperature, with contacts from the atlas or formulas
    prepared: PreparedBearing  # equilibria and contacts, with the film factor of the case
    _known: dict[float, FilmState] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, case: BearingCase, changes: Mapping[str, Any]) -> OperatingPoint:
        """Operating point of a case with changed inputs, such as ``bearing.inner_speed`` [rad/s]. Raises
        InputError where the changed case is not valid, or its oil is neither in the atlas nor described by
        formulas.
        """
        # What is in parallel is taken off the measured values, and the measured factor contains the supply.
        alone = {"bearing.parallel_capacitance": None, "bearing.supply": "flooded"}
        changed, _ = required_quick_case(case.replace({**changes, **alone}), constant=True)
        return cls(changed, prepare_bearing(changed, POSITIONS))

    def at(self, factor: float) -> FilmState:
        """Bearing at a film factor. Raises InputError where the films are too thick for the bearing, or too
        thin to be computed.
        """
        if factor not in self._known:
            self._known[factor] = FilmState.of(self._solution(factor))
        return self._known[factor]

    def film_error(self, factor: float) -> float:
        """Relative error of the films at a film factor."""
        return float(film_error(self._solution(factor)))

    def _solution(self, factor: float) -> BearingSolution:
        return solution_of_prepared(self.case, with_film_factor(self.prepared, factor))


def check_films_measured(case: BearingCase) -> None:
    """Refuse a bearing whose capacitance does not depend on its films. Raises InputError for ceramic
    elements: they have nearly all of the voltage.
    """
    material = case.bearing.element_material
    if not library.solid(material)["conducting"]:
        raise InputError(
            "bearing.element_material",
            got=f"{material!r}, whose capacitance hides the capacitance of the films;",
            takes="elements that conduct, for a film factor from a measured capacitance",
        )


# Number of bearings that are solved: three, and one more for each factor of two in the capacitance.
_LEAST, _MOST = 3, 6

# Difference of the logarithms of two capacitances below which the later one replaces the earlier.
_SAME = 1e-4


@dataclass(frozen=True, eq=False)
class Correction:
    """Ratio of solved to estimated numbers as a function of the estimated capacitance."""

    # Logarithm of the estimated capacitance [F], increasing; empty without solved contacts, shape (k,).
    logs: Array
    ratios: Array  # logarithm of the ratio solved/quick of capacitance and of lambda ratio, shape (k, 2)
    solves: int = 0  # number of contacts that were solved

    @classmethod
    def none(cls) -> Correction:
        """Correction that leaves quick numbers as they are."""
        return cls(np.zeros(0), np.zeros((0, 2)))

    def of(self, state: FilmState) -> FilmState:
        """State with solved contacts from a quick state; beyond the table its end counts."""
        if not self.logs.size:
            return state
        at = float(np.clip(math.log(state.capacitance), self.logs[0], self.logs[-1]))
        single = self.logs.size == 1
        logs = (
            self.ratios[0]
            if single
            else scipy.interpolate.PchipInterpolator(self.logs, self.ratios, axis=0)(at)
        )
        capacity, ratio = np.exp(logs)
        return FilmState(state.capacitance * float(capacity), state.lambda_ratio * float(ratio))

    def extended(self, formula: FilmState, solution: BearingSolution) -> Correction:
        """Correction with one more solved bearing, whose quick state is known."""
        solved = FilmState.of(solution)
        log = math.log(formula.capacitance)
        ratio = solved.capacitance / formula.capacitance, solved.lambda_ratio / formula.lambda_ratio
        solves = self.solves + sum(int(np.count_nonzero(curve.used)) for curve in solution.curves)
        others = np.abs(self.logs - log) > _SAME
        logs = np.append(self.logs[others], log)
        ratios = np.vstack([self.ratios[others], np.log(ratio)])
        order = np.argsort(logs)
        return Correction(logs[order], ratios[order], solves)


def solved_correction(
    case: BearingCase,
    rows: Sequence[Mapping[str, Any]],
    targets: Array,
    progress: Progress,
    workers: int | None = None,
) -> Correction:
    """Solve a bearing at a few measured rows, and compare it with estimated contacts.

    ``rows``, changes of the case that make each row, its speed [rad/s] and temperature [K]; ``targets``,
    measured capacitances without background [F]; those that are not positive do not count, shape (n,).
    Returns table of two to six solved bearings. Raises InputError where the bearing cannot be solved, or
    estimated contacts reach none of the capacitances; ConvergenceError where a contact does not converge.

    Each bearing is solved at the speed of a row, with the film factor that explains it with estimated
    contacts and the table so far. Between these rows the ratio solved/estimated depends on the film, of which
    the capacitance is the measure, and very little on the speed.
    """
    correction, places = Correction.none(), _spread(targets)
    for number, place in enumerate(places, 1):
        text = f"solved bearing {number} of {len(places)}"
        point = OperatingPoint.of(case, rows[place])
        try:
            factor = film_factor_of(_capacitance(point, correction), float(targets[place]))
        except NoFactorError:
            continue
        prepared = with_film_factor(point.prepared, factor)
        solution = solution_of_prepared(
            # What is in parallel is taken off the measured values.
            case.replace({**rows[place], "contacts": "solved", "bearing.parallel_capacitance": None}),
            prepared,
            progress=partial(_bearing_progress, progress, text),
            workers=workers,
        )
        if not solution.converged:
            raise ConvergenceError(f"a contact of the bearing at film factor {readable(factor)}")
        correction = correction.extended(point.at(factor), solution)
    if not correction.logs.size:
        raise InputError("measured", "has no capacitance that films of the atlas or of a formula explain")
    return correction


def _bearing_progress(progress: Progress, text: str, done: int, of: int, _: str) -> None:
    """Progress of one of several bearings."""
    progress(done, of, text)


def _capacitance(point: OperatingPoint, correction: Correction) -> Callable[[float], float]:
    return lambda factor: correction.of(point.at(factor)).capacitance


def _spread(targets: Array) -> list[int]:
    """Places of rows that are spread over the logarithm of their capacitance; a single one counts twice.

    The second time its film factor is taken from the corrected table.
    """
    values, first = np.unique(np.where(targets > 0.0, targets, np.nan), return_index=True)
    known = np.isfinite(values)
    logs, first = np.log(values[known]), first[known]
    number = min(_MOST, _LEAST + int((logs[-1] - logs[0]) / math.log(2.0)))
    levels = np.linspace(logs[0], logs[-1], number) if len(logs) > number else logs
    places = [int(first[k]) for k in np.unique([int(np.argmin(np.abs(logs - at))) for at in levels])]
    return places if len(places) > 1 else 2 * places


# Key of what is in parallel: its range is one of the background.
PARALLEL = "bearing.parallel_capacitance"

# Number of rows at which the effect of a range is computed; it is interpolated over the speed between them.
_ROWS = 4

# Keys without effect on the capacitance at a film factor, or that the measurement itself replaces.
_WITHOUT = (
    *("discharge.", "motor.", SPEED, "bearing.film_factor", "bearing.supply"),
    PARALLEL,
)


def shared_effects(
    case: BearingCase,
    rows: Sequence[Mapping[str, Any]],
    factors: Array,
    slopes: Array,
    corrected: Callable[[FilmState], FilmState],
) -> tuple[dict[str, Array], tuple[ResultWarning, ...]]:
    """Change of ln(film factor) by one standard uncertainty of each input that has a range.

    ``rows``, changes of the case that make each row, its speed [rad/s] and temperature [K]; ``factors`` and
    ``slopes``, film factor of each row, and its d ln(capacitance)/d ln(factor), shape (n,). Returns
    ``effects``, effect of each range on every row, shape (n,); ``left_out``, warnings of ranges that were
    skipped, and why.
    """
    effects: dict[str, Array] = {}
    left_out: list[ResultWarning] = []
    if not rows:
        return effects, ()
    speeds = np.array([math.log(row[SPEED]) for row in rows])
    places = _spread_of_ranges(speeds)
    for entry in case.ranges or ():
        if entry.key.startswith(_WITHOUT):
            continue
        try:
            half = [_half_width(case, entry, rows[k], float(factors[k]), corrected) for k in places]
        except InputError as error:
            left_out.append(ResultWarning.of("range-left-out", key=entry.key, reason=error))
            continue
        order = np.argsort(speeds[places])
        change = np.interp(speeds, speeds[places][order], np.array(half)[order])
        effects[entry.key] = change / math.sqrt(3.0) / -slopes
    return effects, tuple(left_out)


def background_effect(case: BearingCase, targets: Array, slopes: Array) -> dict[str, Array]:
    """Change of ln(film factor) by one standard uncertainty of the parallel capacitance of a case.
    ``targets`` and ``slopes``, capacitance without background of each row [F], and its d ln(capacitance)/d
    ln(factor), shape (n,). Returns effect by the key; empty without a range of
    ``bearing.parallel_capacitance``, shape (n,).
    """
    ranges = [limits for limits in case.ranges or () if limits.key == PARALLEL]
    return {
        limits.key: 0.5 * (limits.high - limits.low) / math.sqrt(3.0) / targets / -slopes for limits in ranges
    }


def _spread_of_ranges(speeds: Array) -> list[int]:
    """Places of a few rows that are spread over the speed, each speed once."""
    order = np.argsort(speeds, kind="stable")
    chosen = order[np.unique(np.linspace(0, len(order) - 1, _ROWS).round().astype(int))]
    seen: dict[float, int] = {}
    for place in chosen:
        seen.setdefault(float(speeds[place]), int(place))
    return list(seen.values())


def _half_width(
    case: BearingCase,
    entry: InputRange,
    row: Mapping[str, Any],
    factor: float,
    corrected: Callable[[FilmState], FilmState],
) -> float:
    """Return half the difference in ln(capacitance) between both ends of a range, at the inputs of a row."""
    ends = []
    for end in (entry.low, entry.high):
        changes = dict(row)
        if entry.key in row:
            # A measured temperature keeps its own value; the range is the range of its error.
            end = float(row[entry.key]) + end - float(value_at(case.to_dict(), entry.key))
        changes[entry.key] = end
        ends.append(math.log(corrected(OperatingPoint.of(case, changes).at(factor)).capacitance))
    return 0.5 * (ends[1] - ends[0])


# Largest number of different speeds and temperatures, each of which takes a few tenths of a second.
MOST_POINTS = 1000

# Columns that the search fills; the slope is d ln(capacitance)/d ln(film factor).
_SEARCHED = ("computed", "film_factor", "slope", "lambda_ratio")


def _search(
    case: BearingCase,
    correction: Correction,
    rows: Sequence[Mapping[str, Any]],
    targets: Array,
    progress: Progress,
) -> tuple[dict[str, Array], tuple[str, ...]]:
    """Columns of the search for the film factors of rows, and reasons of rows without a factor."""
    n = len(rows)
    columns, reasons = {name: np.full(n, np.nan) for name in _SEARCHED}, [""] * n
    points: dict[tuple[Any, ...], OperatingPoint] = {}
    guess = 1.0
    for k, (row, target) in enumerate(zip(rows, targets.tolist(), strict=True)):
        progress(k, n, "film factors")
        key = tuple(row.values())
        try:
            if key not in points:
                points[key] = OperatingPoint.of(case, row)
            for name, value in _row(points[key], correction, target, guess):
                columns[name][k] = value
        except (InputError, NoFactorError) as error:
            reasons[k] = str(error)
        else:
            guess = columns["film_factor"][k]
    progress(n, n, "film factors")
    return columns, tuple(reasons)


def _row(
    point: OperatingPoint, correction: Correction, target: float, guess: float
) -> Iterator[tuple[str, float]]:
    """Names and values of the columns of a row; a NoFactorError says why a row has no film factor."""
    capacitance = _capacitance(point, correction)
    # The film at a film factor of 1 may be too thin or too thick, and the film of the row is not.
    with suppress(InputError):
        yield "computed", capacitance(1.0)
    if not target > 0.0:
        why = (
            "its phase is not the phase of a capacitor"
            if np.isnan(target)
            else "it is not above the background"
        )
        raise NoFactorError(why)
    factor = film_factor_of(capacitance, target, guess)
    slope = slope_at(capacitance, factor)
    ratio = float(correction.of(point.at(factor)).lambda_ratio)
    if ratio < BOUNDARY_LIMIT:
        raise NoFactorError(
            f"its film would have a lambda ratio of {readable(ratio, 2)}, boundary lubrication, in which "
            "asperity contacts conduct"
        )
    yield from (("film_factor", factor), ("slope", slope), ("lambda_ratio", ratio))


# Quantities of a row that are used.
_USED = ("time", "speed", "temperature", "capacitance", "impedance", "phase", "frequency")


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

    ``background``, capacitance [F] of leads, cage and fixture in parallel, which is taken off every row; by
    default ``bearing.parallel_capacitance`` of the case, where it has one; ``uncertainty``, relative standard
    uncertainty of the capacitance, where the measurement states none. Returns rows, mean with its interval,
    and warnings. Raises InputError where the measurement has no capacitance, or too many different speeds;
    where the bearing has ceramic elements, cannot be computed, or no row can be used; ConvergenceError where
    a solved contact does not converge.
    """
    check_films_measured(case)
    meter = capacitance_of(measured, uncertainty)
    fitted = background is None
    background = case.bearing.parallel_capacitance if background is None else background
    rows, off = _changes(case, measured), background or 0.0
    measured = measured.only(*_USED)
    targets = meter.value - off
    if not np.any(targets > 0.0):
        raise InputError(
            measured.source,
            f"has no capacitance above the background of {readable(1e12 * off, 4)} pF",
            takes="at least one row above it",
        )
    OperatingPoint.of(case, rows[0])
    correction = Correction.none()
    if case.contacts == "solved":
        correction = solved_correction(case, rows, targets, progress, workers)
    search = _search(case, correction, rows, targets, progress)
    return _result(case, measured, meter, (background, fitted), search, correction, rows)


def _changes(case: BearingCase, measured: Measurement) -> tuple[Mapping[str, Any], ...]:
    """Changes of the case that make each row: speed [rad/s], and temperature [K] where it was measured.

    A measured temperature is the temperature of the oil. Rings and other parts that have their own
    temperature in the case keep their difference from it.
    """
    if measured.has("entrainment_speed") and not measured.has("speed"):
        raise InputError(
            f"{measured.source}: entrainment_speed", got="a speed in m/s", takes="a column 'speed [rpm]'"
        )
    speeds = measured.values.get("speed", np.full(measured.size, case.bearing.inner_speed))
    keys = {SPEED: speeds}
    if measured.has("temperature"):
        warmer = measured.values["temperature"] - case.bearing.oil_temperature
        for key, temperature in case.bearing.all_temperatures().items():
            keys[f"bearing.{key}"] = temperature + warmer
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
    search: tuple[dict[str, Array], tuple[str, ...]],
    correction: Correction,
    rows: tuple[Mapping[str, Any], ...],
) -> FilmFactors:
    """Film factors with their uncertainties, mean and warnings."""
    (background, fitted_background), (searched, reasons) = taken_off, search
    factors, slopes = searched["film_factor"], searched["slope"]
    known, targets = np.isfinite(factors), meter.value - (background or 0.0)
    speeds = np.array([row[SPEED] for row in rows])
    stated = None if meter.uncertainty is None else meter.uncertainty / targets / -slopes
    used = tuple(row for row, usable in zip(rows, known, strict=True) if usable)
    shared, left_out = shared_effects(case, used, factors[known], slopes[known], correction.of)
    if fitted_background:
        shared |= background_effect(case, targets[known], slopes[known])
    error = _error(case, rows, factors) if is_quick(case) else None
    mean = trend = None
    if np.any(known):
        stated_known = None if stated is None else stated[known]
        mean = mean_factor(factors[known], stated_known, shared)
        trend = slope_of(speeds[known], factors[known], stated_known)
    columns: dict[str, Array | None] = {
        "line": np.array(measured.lines, dtype=float),
        "time": measured.values.get("time"),
        "speed": speeds,
        "temperature": measured.values.get("temperature"),
        "measured_capacitance": meter.value,
        "parallel_resistance": meter.resistance,
        "capacitance": targets,
        "capacitance_uncertainty": meter.uncertainty,
        "computed": searched["computed"],
        "film_factor": factors,
        "factor_uncertainty": None if stated is None else stated * factors,
        "factor_systematic": _systematic(shared, factors, known),
        **fitted_columns(targets, factors, slopes, mean),
        "minimum_thickness": searched["lambda_ratio"] * case.bearing.composite_rq,
        "lambda_ratio": searched["lambda_ratio"],
    }
    warnings = (
        *_film_warnings(case, error),
        *temperature_warnings(measured, case.lubricant),
        *left_out,
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
        columns={name: values for name, values in columns.items() if values is not None},
        reasons=reasons,
        mean=mean,
        slope=trend,
        warnings=warnings,
    )


def _systematic(shared: Mapping[str, Array], factors: Array, known: Array) -> Array | None:
    """Standard uncertainty of the factors from ranges of inputs; None without ranges."""
    if not shared:
        return None
    column = np.full(len(factors), np.nan)
    column[known] = factors[known] * np.sqrt(sum(change**2 for change in shared.values()))
    return column


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
    code = "formula-contacts" if case.contacts == "formula" else "atlas-contacts"
    return (ResultWarning.of(code, "measured_capacitance", percent=100.0 * error),)
