"""Answers about one contact: at once from formulas, and solved as the command solves it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from ehlectric.app.charts.line_charts import Lengths, line_figures, spot_position
from ehlectric.app.charts.point_charts import point_cuts, point_figures, reach_of
from ehlectric.app.compute.answer_parts import (
    cards,
    case_of,
    gauge_text,
    lines_of,
    page_warnings_of,
    with_warnings,
)
from ehlectric.app.view_models import ContactAnswer, Deciding, Figure, Gauge
from ehlectric.cases.case import Case
from ehlectric.contact import PointResult, Result, solve
from ehlectric.discharge.breakdown_rule import STRENGTH_UNKNOWN, code_of, doubted, level_of
from ehlectric.discharge.film_verdict import doubts_of, ideal_films, no_verdict
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.sheets import (
    BREAKDOWN_FORMULAS,
    CHECK_CARDS,
    CONTACT_CARDS,
    SPOT_CARDS,
    TOUCHING_CARDS,
)
from ehlectric.quantities.statement import Fact, Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import ratio_text, readable
from ehlectric.runs.by_kind import run_contact
from ehlectric.runs.preview import preview_of
from ehlectric.runs.result_folders import stored_result
from ehlectric.runs.solve import load
from ehlectric.runtime.progress import Progress
from ehlectric.tables.contact_tables import result_rows

# Largest number of nodes of a smooth line contact that is solved in a fraction of a second.
_QUICK = 3201
_QUICK_ERROR = 1e-3

# Part by which a film of a formula may be off, as the command says.
_FORMULA = 0.4


def contact_case(table: Mapping[str, Any], session: Path | str | None = None) -> Case:
    """Case of a contact of tables as a person writes them. ``session``, folder of the session, where the
    files of roughness lie; None where it has none. Raises InputError if the tables are no valid case, or name
    a file that was not uploaded.
    """
    if "bearing" in table:
        raise InputError(
            "bearing", got="a table", takes="the inputs of one contact; the first page has bearings"
        )
    case = case_of(table, None if session is None else Path(session))
    assert isinstance(case, Case)
    return case


def quick_answer(table: Mapping[str, Any], session: Path | str | None = None) -> ContactAnswer:
    """Answer about a contact: solved, without files, where that takes a fraction of a second, and from
    formulas otherwise. Raises InputError if the tables are no valid case of a contact.
    """
    case = contact_case(table, session)
    if not _is_quick(case):
        return by_formula(case)
    try:
        return answer_of(solve(case))
    except ConvergenceError as error:
        return replace(
            by_formula(case), how=f"From a film-thickness formula, because the film is not solved: {error}"
        )


def by_formula(case: Case) -> ContactAnswer:
    """Answer about a contact before its film is solved, as of ``ehlectric check``."""
    preview = preview_of(case)
    verdict = verdict_by_formula(case, preview.summary.get("breakdown_by_formula"), preview.warnings)
    formula = BREAKDOWN_FORMULAS[case.contact.geometry]
    keys = {key.replace("*", formula): below for key, below in CHECK_CARDS.items()}
    warnings = page_warnings_of(preview.warnings)
    moving = case.motion is not None
    return ContactAnswer(
        title=preview.title,
        verdict=verdict,
        meaning=meaning_of(verdict),
        how=_TEXTS["moving" if moving else "by_formula"],
        shown=with_warnings(cards(preview.rows, keys), warnings),
        deciding=deciding(deciding_by_formula(case, verdict), verdict, case.electric.voltage),
        lines=lines_of(preview.rows),
        warnings=warnings,
        solvable=not moving,
        solved=False,
    )


def _is_quick(case: Case) -> bool:
    plain, grid = not case.roughness and case.motion is None and case.film is None, case.grid
    quick = grid.nodes_along <= _QUICK and (grid.target is None or grid.target >= _QUICK_ERROR)
    return plain and quick and case.contact.geometry == "line"


_NO_STRENGTH = no_verdict(Statement.of("no-strength-page"))
_BEFORE_SOLVING = "none-before-solving"

_TEXTS = data_file("ehlectric.app", "page_texts.toml")["contact"]


def verdict_by_formula(
    case: Case, estimate: Mapping[str, Any] | None, warnings: Iterable[ResultWarning]
) -> Verdict:
    """Verdict from formulas, within the errors of film and strength."""
    if estimate is None:
        given = case.discharge is not None and case.discharge.has_strength
        return no_verdict(Statement.of("not-by-formula"), code=_BEFORE_SOLVING) if given else _NO_STRENGTH
    margin = estimate["margin"]
    if margin is None:
        return no_verdict(Statement.of("no-voltage-page"))
    if estimate["outside_range"]:
        why = {"formula": estimate["formula"], "reason": estimate["outside_range"]}
        return no_verdict(Statement.of("outside-formula", **why), code=_BEFORE_SOLVING)
    # The film may be that much thinner or thicker than by the formula, and so may be the strength.
    low = margin * (1.0 - STRENGTH_UNKNOWN) / (1.0 + _FORMULA)
    high = margin * (1.0 + STRENGTH_UNKNOWN) / (1.0 - _FORMULA)
    level, doubts = level_of(low, high), doubts_of(warnings)
    level, code = doubted(level, code_of(level, likely=margin < 1.0), doubts=bool(doubts))
    at, voltage = estimate["breakdown_voltage"], estimate["applied_voltage"]
    strength = Statement.of("strength", strength=estimate["dielectric_strength"], range=None)
    return Verdict(
        level,
        code,
        Statement.of("formula-voltages", breakdown=at, voltage=voltage, margin=margin),
        facts=(Fact("breakdown_by_formula.margin", margin, (low, high)),),
        reasons=tuple(doubts),
        assumptions=(*ideal_films(flooded=True), strength),
        bound="upper",
    )


def solve_contact(
    table: Mapping[str, Any], session: Path | str | None, folder: Path | str, progress: Progress
) -> ContactAnswer:
    """Solve a contact as ``ehlectric run`` does, with all its files. Raises InputError if the tables are no
    valid case of a contact.
    """
    outcome = run_contact(contact_case(table, session), folder, progress)
    progress(0, 0, "drawing")
    return answer_of(outcome.result)


def cuts_of(folder: str, x: float, y: float) -> dict[str, Figure]:
    """Cuts through a point of a solved point contact. Raises InputError if the folder has no result of a
    point contact that converged.
    """
    result = _stored(folder, stored_result(Path(folder)).stat().st_mtime_ns)
    if not isinstance(result, PointResult) or not result.converged:
        raise InputError(folder, "contains no converged point contact", takes="a point contact to cut")
    factor = Lengths.of(result).factor
    return point_cuts(result, x / factor, y / factor)


# A result is read once for many cuts, until its file changes.
@lru_cache(maxsize=4)
def _stored(folder: str, _changed: int) -> Result | PointResult:
    result = load(folder)
    if not isinstance(result, Result | PointResult):
        raise InputError(folder, "contains another result", takes="the result of a contact")
    return result


def answer_of(result: Result | PointResult) -> ContactAnswer:
    """Answer of a solved contact."""
    rows, verdict = result_rows(result), _verdict(result)
    large = TOUCHING_CARDS if result.spots is not None else CONTACT_CARDS
    warnings = page_warnings_of(result.warnings)
    shown = [*(cards(rows, large) if result.converged else ()), *cards(rows, SPOT_CARDS)]
    whole = result if isinstance(result, PointResult) and result.converged else None
    drawn = point_figures(result) if isinstance(result, PointResult) else line_figures(result)
    known = "film.minimum_thickness" if result.converged else ""
    if result.spots is not None:
        known = "asperities.electrical_behaviour"
    return ContactAnswer(
        title=result.case.title,
        verdict=verdict,
        meaning=meaning_of(verdict),
        how="Solved." if result.converged else "Not converged.",
        shown=with_warnings(shown, warnings),
        deciding=deciding(
            "discharge.margin" if verdict.interval else known,
            verdict,
            result.case.electric.voltage,
            next(iter(drawn), ""),
        ),
        lines=lines_of(rows),
        warnings=warnings,
        figures=drawn,
        solvable=False,
        solved=True,
        converged=result.converged,
        cuts={} if whole is None else point_cuts(whole, *spot_position(whole)),
        reach=None if whole is None else reach_of(whole),
    )


def _verdict(result: Result | PointResult) -> Verdict:
    if not result.converged:
        return no_verdict(Statement.of("status", status=result.film.status), code="not-converged")
    return result.verdict or _NO_STRENGTH


def meaning_of(verdict: Verdict) -> str:
    """What a verdict means for the contact, in plain words."""
    return str(_TEXTS["meanings"][verdict.level])


def deciding_by_formula(case: Case, verdict: Verdict) -> str:
    """Key of the number that decides before the film is solved: the margin, or the film without one."""
    if verdict.margin is not None:
        return "breakdown_by_formula.margin"
    return f"film_formulas.{BREAKDOWN_FORMULAS[case.contact.geometry]}.minimum_thickness"


# Codes of statements and of a warning that say no more than the margin with its voltages.
_SAID = ("contact-voltages", "formula-voltages", "breakdown-expected")


def deciding(key: str, verdict: Verdict, voltage: float, figure: str = "") -> Deciding:
    """Number of a key, the margin if there is one in the verdict, with the voltage [V] and the interval of a
    margin: its film may be off, and the strength may differ by 20 %.
    """
    if verdict.margin is None or verdict.interval is None:
        return Deciding(key, figure=figure)
    facts = (
        ("applied voltage", f"{readable(voltage)} V"),
        ("of this film, within its errors", " to ".join(map(ratio_text, verdict.interval))),
    )
    gauge = Gauge(gauge_text(verdict.margin, facts), verdict.margin, verdict.interval)
    return Deciding(key, facts, gauge, figure, _SAID)
