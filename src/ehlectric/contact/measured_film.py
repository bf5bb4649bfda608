"""Film factors of a contact from its measured film thickness: solved or from formulas, as a function of the
speed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.cases.defaults import Contacts
from ehlectric.cases.film_factors import (
    FilmFactors,
    fitted_columns,
    mean_factor,
    measurement_warnings,
    slope_of,
    temperature_warnings,
)
from ehlectric.cases.measurements import Measurement
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.solver import solve
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.film import contact_film
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runtime.progress import Progress, silent

T = TypeVar("T")

# Formula of the central film by the geometry of the contact: those that hold in all regimes.
FORMULA = {"line": "moes", "point": "nijenbanning_venner_moes"}

# Error of these formulas: they differ from solved films by up to 40 %.
_FORMULA_ERROR = 0.4

# Number of films that are solved: three, one more for each further ratio of the film, and at most seven.
_LEAST, _RATIO, _MOST = 3, 1.8, 7

# Quantities of a row that the film of a contact depends on, or that describe the row.
_USED = ("time", "entrainment_speed", "film", "temperature", "slide_to_roll_ratio")

# Largest number of different speeds.
MOST_POINTS = 5000


@dataclass(frozen=True, eq=False)
class _Films:
    """Computed central films of the rows of a measurement."""

    thickness: Array  # [m], shape (n,)
    error: float | None = None  # relative error; None for solved films
    solves: int = 0  # number of solved contacts
    warnings: tuple[ResultWarning, ...] = ()


def contact_factors(
    case: Case,
    measured: Measurement,
    *,
    contacts: Contacts = "solved",
    uncertainty: float | None = None,
    progress: Progress = silent,
) -> FilmFactors:
    """Film factors of a contact: measured over computed central film thickness, row by row, and their mean.

    ``contacts``, "solved" for films that are solved at three to seven speeds and interpolated between them,
    "atlas" for films from the atlas, and from formulas where it has none, or "formula" for the formulas of
    Nijenbanning, Venner and Moes (points) and of Moes (lines); ``uncertainty``, relative standard uncertainty
    of the film, where the measurement states none. Returns rows, mean with its interval, and warnings. Raises
    InputError where the measurement has no film, or too many different speeds; where the case moves;
    ConvergenceError where a film does not converge.
    """
    if case.motion is not None:
        raise InputError("motion", "is not used with a measurement", takes="a stationary contact")
    if case.inlet is not None:
        raise InputError("inlet", "is not used with a measurement", takes="a flooded contact")
    if not measured.has("film"):
        further = "; a traction coefficient gives no film factor" * measured.has("traction_coefficient")
        takes = f"a column 'film [nm]' with the entrainment speed{further}"
        raise InputError.missing(f"{measured.source}: film", takes)
    if measured.has("speed") and not measured.has("entrainment_speed"):
        raise InputError(
            f"{measured.source}: speed", got="a rotational speed", takes="a column 'entrainment speed [m/s]'"
        )
    measured = measured.only(*_USED, *(("load",) if case.contact.geometry == "point" else ()))
    smooth = case.model_copy(update={"roughness": ()})
    rows = _changes(smooth, measured)
    formula = _formula_films(smooth, rows, measured)
    if contacts == "solved":
        films = _solved(smooth, rows, formula, progress)
    elif contacts == "atlas":
        films = _atlas_films(smooth, rows, formula)
    else:
        name = FORMULA[case.contact.geometry].replace("_", " ")
        films = _Films(formula, _FORMULA_ERROR, warnings=(ResultWarning.of("formula-films", formula=name),))
    return _result(case, measured, contacts, uncertainty, rows, formula, films)


def _changes(case: Case, measured: Measurement) -> tuple[Mapping[str, Any], ...]:
    """Changes of the case that make each row; without a column, the slide-to-roll ratio of the case holds."""
    conditions = KINDS[case.contact.geometry].resolve(case)
    speeds = measured.values.get("entrainment_speed", np.full(measured.size, conditions.entrainment_speed))
    keys = {"contact.entrainment_speed": speeds}
    keys["contact.slide_to_roll_ratio"] = np.full(measured.size, conditions.slide_to_roll_ratio)
    of_columns = {f"contact.{name}": name for name in ("temperature", "load", "slide_to_roll_ratio")}
    keys |= {key: measured.values[name] for key, name in of_columns.items() if measured.has(name)}
    different = len(set(zip(*(values.tolist() for values in keys.values()), strict=True)))
    if different > MOST_POINTS:
        raise InputError(
            measured.source,
            f"has {different} different {', '.join(key.partition('.')[2] for key in keys)}".replace("_", " "),
            takes=f"at most {MOST_POINTS}; average neighbouring rows",
        )
    columns = (values.tolist() for values in keys.values())
    return tuple(dict(zip(keys, row, strict=True)) for row in zip(*columns, strict=True))


def _formula_films(case: Case, rows: Sequence[Mapping[str, Any]], measured: Measurement) -> Array:
    """Central film of each row from the film-thickness formulas [m], shape (n,). Raises InputError where a
    row is no case, for example at a temperature for which the oil has no data; with its line.
    """
    kind = KINDS[case.contact.geometry]
    formula = kind.formulas[FORMULA[case.contact.geometry]]

    def film(number: int) -> float:
        try:
            thickness = formula(kind.resolve(case.replace(rows[number])).contact).central_thickness
        except InputError as error:
            raise error.with_text(f"{measured.source}, line {measured.lines[number]}", str(error)) from None
        assert thickness is not None
        return float(thickness)

    return np.array(_once_each(rows, film))


def _once_each(rows: Sequence[Mapping[str, Any]], compute: Callable[[int], T]) -> list[T]:
    """Result for each row by its number, computed once for rows that are alike."""
    known: dict[tuple[Any, ...], T] = {}
    for number, row in enumerate(rows):
        key = tuple(row.values())
        if key not in known:
            known[key] = compute(number)
    return [known[tuple(row.values())] for row in rows]


def _atlas_films(case: Case, rows: Sequence[Mapping[str, Any]], formula: Array) -> _Films:
    """Central films of the rows from the atlas, or from formulas where it has none, and the largest error."""
    kind = KINDS[case.contact.geometry]

    def film(number: int) -> tuple[float, float]:
        changed = case.replace(rows[number])
        contact = kind.resolve(changed).contact
        try:
            by_formula = contact_film(contact, changed.oil)
        except InputError:
            return float(formula[number]), _FORMULA_ERROR
        return float(by_formula.central_thickness), float(by_formula.errors["central"])

    films, errors = zip(*_once_each(rows, film), strict=True)
    error = max(errors)
    warning = ResultWarning.of("atlas-contacts", "measured_film", percent=100.0 * error)
    return _Films(np.array(films), error, warnings=(warning,))


def _solved(case: Case, rows: Sequence[Mapping[str, Any]], formula: Array, progress: Progress) -> _Films:
    """Films solved at rows that are spread over the film thickness, and interpolated to the others.

    The ratio of solved films to formula films is interpolated over the formula film, in logarithms.
    Beyond the solved rows the ratio of the nearest solved row holds.
    """
    logs, ratios = [], []
    warnings: dict[str, ResultWarning] = {}
    places = _spread(formula)
    for number, place in enumerate(places):
        progress(number, len(places), "films at the measured speeds")
        result = solve(case.replace(rows[place]))
        if not result.converged:
            speed = rows[place]["contact.entrainment_speed"]
            raise ConvergenceError(f"the film at {readable(speed, 4)} m/s, {result.film.status}")
        logs.append(math.log(formula[place]))
        ratios.append(math.log(result.film.central_thickness / formula[place]))
        for warning in result.warnings:
            warnings.setdefault(warning.code, warning)
    progress(len(places), len(places), "films at the measured speeds")
    log_ratio: Array = np.full(formula.shape, ratios[0])
    if len(logs) > 1:
        log_ratio = scipy.interpolate.PchipInterpolator(logs, ratios)(
            np.clip(np.log(formula), logs[0], logs[-1])
        )
    thickness = formula * np.exp(log_ratio)
    return _Films(thickness, solves=len(places), warnings=tuple(warnings.values()))


def _spread(formula: Array) -> list[int]:
    """Places of rows whose films are about evenly spaced in their logarithm, by increasing film."""
    films, places = np.unique(formula, return_index=True)
    logs = np.log(films)
    number = min(_MOST, _LEAST + int((logs[-1] - logs[0]) / math.log(_RATIO)))
    levels = np.linspace(logs[0], logs[-1], number) if len(films) > number else logs
    return [int(places[k]) for k in np.unique([int(np.argmin(np.abs(logs - at))) for at in levels])]


def _result(
    case: Case,
    measured: Measurement,
    contacts: Contacts,
    relative: float | None,
    rows: Sequence[Mapping[str, Any]],
    formula: Array,
    films: _Films,
) -> FilmFactors:
    """Film factors with their mean and warnings, where the measurement has a ``relative`` uncertainty."""
    film = measured.values["film"]
    uncertainty = measured.uncertainties.get("film", None if relative is None else relative * film)
    factors, stated = film / films.thickness, None if uncertainty is None else uncertainty / film
    speeds = np.array([row["contact.entrainment_speed"] for row in rows])
    mean, trend = mean_factor(factors, stated), slope_of(speeds, factors, stated)
    given = {
        "line": np.array(measured.lines, dtype=float),
        "time": measured.values.get("time"),
        "entrainment_speed": speeds,
        "temperature": measured.values.get("temperature"),
        "film": film,
        "film_uncertainty": uncertainty,
        "computed": films.thickness,
        "formula": formula,
        "film_factor": factors,
        "factor_uncertainty": None if stated is None else stated * factors,
    }
    columns = {name: values for name, values in given.items() if values is not None}
    columns |= fitted_columns(film, factors, np.ones(len(factors)), mean)
    reasons = ("",) * measured.size
    return FilmFactors(
        title=case.title,
        source=measured.source,
        quantity="film",
        contacts=contacts,
        solves=films.solves,
        formula_error=films.error,
        background=None,
        columns=columns,
        reasons=reasons,
        mean=mean,
        slope=trend,
        warnings=(
            *(warning for warning in films.warnings if warning.code != "temperature-unused"),
            *temperature_warnings(measured, case.lubricant),
            *measurement_warnings(measured, reasons, mean, trend, "entrainment speed"),
        ),
    )
