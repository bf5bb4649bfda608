"""Answers about one contact: at once by formula, and solved as the command solves it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from ehlectric.app.answers import ContactCheck, ContactView, Shown
from ehlectric.app.charts.line_charts import Lengths, line_figures, spot_position
from ehlectric.app.charts.point_charts import point_cuts, point_figures, reach_of
from ehlectric.app.compute.answer_parts import cards, case_of, lines_of, page_warnings_of, with_warnings
from ehlectric.cases.case import Case
from ehlectric.contact.result import PointResult, Result
from ehlectric.contact.solver import solve
from ehlectric.discharge.film_verdict import STRENGTH_UNKNOWN, doubts_of, lead_of, level_of, ratio_text
from ehlectric.errors import InputError, ResultWarning
from ehlectric.quantities.sheets import CHECK_CARDS, CONTACT_CARDS, SPOT_CARDS, TOUCHING_CARDS
from ehlectric.runs.by_kind import run_contact
from ehlectric.runs.meaning import check
from ehlectric.runs.solve import load
from ehlectric.runtime.progress import Progress
from ehlectric.tables.contact_tables import result_rows

# Largest number of nodes of a smooth line contact that is solved in a fraction of a second.
_QUICK = 3201
_QUICK_ERROR = 1e-3

# Part by which a film of a formula may be off, as the command says.
_FORMULA = 0.4

# Formula by geometry whose films an answer shows large and compares with heights of roughness: the one of the
# breakdown voltage by formula.
FORMULA_BY_GEOMETRY = {"line": "pan_hamrock", "point": "chittenden"}


def contact_case(table: Mapping[str, Any], folder: str) -> Case:
    """Case of a contact of tables as a person writes them. ``folder``, folder of the session, where the files
    of roughness lie. Raises InputError if the tables are no valid case, or name a file that was not uploaded.
    """
    if "bearing" in table:
        raise InputError(
            "bearing", got="a table", takes="the inputs of one contact; the first page has bearings"
        )
    case = case_of(table, Path(folder))
    assert isinstance(case, Case)
    return case


def check_contact(table: Mapping[str, Any], folder: str) -> ContactCheck:
    """Answer about a contact before its film is solved, as of ``ehlectric check``. Raises InputError if the
    tables are no valid case of a contact.
    """
    case = contact_case(table, folder)
    meaning = check(case)
    level, text = verdict_by_formula(case, meaning.summary.get("breakdown_by_formula"), meaning.warnings)
    formula = FORMULA_BY_GEOMETRY[case.contact.geometry]
    keys = {key.replace("*", formula): below for key, below in CHECK_CARDS.items()}
    numbers, others = with_warnings(cards(meaning.rows, keys), page_warnings_of(meaning.warnings))
    return ContactCheck(
        title=meaning.title,
        geometry=case.contact.geometry,
        level=level,
        text=text,
        numbers=numbers,
        rows=lines_of(meaning.rows),
        warnings=others,
        summary=meaning.summary,
        quick=_is_quick(case),
    )


def _is_quick(case: Case) -> bool:
    plain, grid = not case.roughness and case.motion is None and case.film is None, case.grid
    quick = grid.nodes_along <= _QUICK and (grid.target is None or grid.target >= _QUICK_ERROR)
    return plain and quick and case.contact.geometry == "line"


_NO_STRENGTH = "No verdict: give a dielectric strength (group Voltage and breakdown) for a breakdown voltage."
_NOT_BY_FORMULA = "No verdict before solving: a dielectric strength over the pressure needs the solved film."
_NO_VOLTAGE = "No verdict: give a voltage (group Voltage and breakdown) for a margin."


def verdict_by_formula(
    case: Case, estimate: Mapping[str, Any] | None, warnings: Iterable[ResultWarning]
) -> tuple[str, str]:
    """Level and sentences of the verdict by formula, within the errors of film and strength."""
    if estimate is None:
        given = case.discharge is not None and case.discharge.has_strength
        return "grey", _NOT_BY_FORMULA if given else _NO_STRENGTH
    if estimate["margin"] is None:
        return "grey", _NO_VOLTAGE
    margin, voltage = estimate["margin"], estimate["applied_voltage"]
    # The film may be that much thinner or thicker than by the formula, and the strength is assumed.
    low = margin * (1.0 - STRENGTH_UNKNOWN) / (1.0 + _FORMULA)
    high = margin * (1.0 + STRENGTH_UNKNOWN) / (1.0 - _FORMULA)
    level, doubts = level_of(low, high), doubts_of(warnings)
    if doubts and level == "green":
        level = "yellow"
    last = " ".join([*doubts, "Upper bound: isothermal, fully flooded film."])
    return level, (
        f"{lead_of(level, likely=margin < 1.0)}, by formula: the film breaks down at "
        f"{estimate['breakdown_voltage']:.3g} V, {voltage:.3g} V are applied: margin {ratio_text(margin)}. "
        "The formula may be up to 40 % off, and the "
        f"dielectric strength {estimate['dielectric_strength'] / 1e6:.3g} V/µm is an assumption; "
        f"the margin may be from {ratio_text(low)} to {ratio_text(high)}. {last}"
    )


def solve_contact(table: Mapping[str, Any], session: str, folder: str, progress: Progress) -> ContactView:
    """Solve a contact as ``ehlectric run`` does, with all its files. Raises InputError if the tables are no
    valid case of a contact.
    """
    outcome = run_contact(contact_case(table, session), folder, progress)
    progress(0, 0, "drawing")
    return view_of(outcome.result)


def solve_at_once(table: Mapping[str, Any], folder: str) -> ContactView:
    """Solve a contact that takes a fraction of a second, without files; see ``solve_contact``. Raises
    InputError if the tables are no valid case of a contact.
    """
    return view_of(solve(contact_case(table, folder)))


def cuts_of(folder: str, x: float, y: float) -> tuple[Shown, ...]:
    """Cuts through a point of a solved point contact. Raises InputError if the folder has no result of a
    point contact that converged.
    """
    result = _stored(folder)
    if not isinstance(result, PointResult) or not result.converged:
        raise InputError(folder, "has no converged point contact", takes="one that can be cut")
    factor = Lengths.of(result).factor
    return point_cuts(result, x / factor, y / factor)


# A result is read once for many cuts.
@lru_cache(maxsize=4)
def _stored(folder: str) -> Result | PointResult:
    result = load(folder)
    if not isinstance(result, Result | PointResult):
        raise InputError(folder, "has another result", takes="that of a contact")
    return result


def view_of(result: Result | PointResult) -> ContactView:
    """Answer of a solved contact."""
    level, text = _verdict(result)
    rows, touching = result_rows(result), result.spots is not None
    large = TOUCHING_CARDS if touching else CONTACT_CARDS
    shown = cards(rows, large) if result.converged else []
    found, others = with_warnings([*shown, *cards(rows, SPOT_CARDS)], page_warnings_of(result.warnings))
    numbers, spots = found[: len(shown)], found[len(shown) :]
    whole = result if isinstance(result, PointResult) and result.converged else None
    return ContactView(
        title=result.case.title,
        geometry=result.conditions.geometry,
        converged=result.converged,
        level=level,
        text=text,
        numbers=numbers,
        spots=spots,
        rows=lines_of(rows),
        warnings=others,
        figures=point_figures(result) if isinstance(result, PointResult) else line_figures(result),
        cuts=() if whole is None else point_cuts(whole, *spot_position(whole)),
        reach=None if whole is None else reach_of(whole),
    )


def _verdict(result: Result | PointResult) -> tuple[str, str]:
    """Level and sentences of the verdict of the command."""
    if not result.converged:
        return "grey", f"Not converged ({result.film.status}): do not use this result."
    verdict = result.verdict
    if verdict is None:
        return "grey", _NO_STRENGTH
    return verdict.level, verdict.text
