"""Answers about a bearing: at once from the atlas, complete a moment later, and with solved contacts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.app.charts.bearing_charts import (
    SPEED_HEADS,
    OverSpeed,
    breakdown_figure,
    capacitance_figure,
    ring_figure,
    speed_rows,
)
from ehlectric.app.compute.answer_parts import (
    UNUSABLE,
    at_operating_point,
    cards,
    case_of,
    gauge_text,
    lines_of,
    page_warnings_of,
    unknown,
)
from ehlectric.app.compute.duty_answers import shown_duty
from ehlectric.app.view_models import (
    PENDING,
    RANGE_FOLLOWS,
    BearingAnswer,
    Deciding,
    Difference,
    DutyAnswer,
    Figure,
    Gauge,
    Number,
    PageWarning,
    Table,
    concerning,
    limited_to,
)
from ehlectric.bearing import (
    BearingResult,
    CaseKey,
    MarginAnalysis,
    Speed,
    bearing_verdict,
    capacitance_is_bound,
    error_text,
    heat_by_formula,
    key_of,
    over_speed,
    quick_chance,
    run_duty,
    solve_bearing,
    summary_of,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import HOW, Contacts, quick_way
from ehlectric.errors import InputError
from ehlectric.figures.ring_panels import film_panel, largest_gap, load_panel
from ehlectric.quantities.formats import amount
from ehlectric.quantities.lubrication_states import is_shorted
from ehlectric.quantities.result_bounds import bearing_bounds
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.results import BEARING_BOOK
from ehlectric.quantities.rows import Row, value_at
from ehlectric.quantities.sheets import BEARING_CARDS, DIFFERENCES, PAGE_COLUMNS
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import capital, ratio_text, readable
from ehlectric.report.report_texts import TEXTS
from ehlectric.runs.by_kind import run_bearing
from ehlectric.runtime.files import plain
from ehlectric.runtime.progress import Progress
from ehlectric.runtime.worker_processes import cores
from ehlectric.tables.bearing_tables import contact_cells, contact_heads, total_rows
from ehlectric.tables.probability_rows import input_range

EFFECT_HEADS = ("one input changed", "lowest margin", "with", "highest margin", "with")

_CAPTION = "Margin if one input changes and all others stay, largest effect first; breakdown below 1"


def effects_table(summary: Mapping[str, Any]) -> Table | None:
    """Table of the inputs that change the margin, with the value of each that belongs to either end. Returns
    None without any effect.
    """
    effects = (summary.get("margin") or {}).get("effects")
    if not effects:
        return None
    bound = bearing_bounds(BEARING_BOOK, summary).get("margin.effects", "")
    return Table(_CAPTION, EFFECT_HEADS, tuple(tuple(_cells(effect, bound)) for effect in effects))


def _cells(effect: Mapping[str, Any], bound: str) -> Iterator[str]:
    # Both values with the unit that the range has.
    low, _, rest = input_range(effect).partition(" to ")
    high, _, unit = rest.partition(" ")
    ends = [
        (effect[f"{name}_margin"], f"{value} {unit}".rstrip())
        for name, value in (("low", low), ("high", high))
    ]
    yield effect["label"]
    for margin, value in sorted(ends, key=lambda end: end[0]):
        yield f"{bound} {ratio_text(margin)}".strip() if margin > 0.0 else "frequent asperity contact"
        yield value


# Warnings of voltages that are bounds, which do not belong next to missing numbers.
_BOUNDS = ("isothermal-film", "smooth-film")


def shown_numbers(
    summary: Mapping[str, Any], warnings: tuple[PageWarning, ...], *, whole: bool
) -> tuple[Number, ...]:
    """Main numbers of the page, with their warnings, and why some are missing.

    Without a ``whole`` answer the summary lacks the table ``margin``, which follows.
    """
    rows = {row.key: row for row in total_rows(summary)}
    missing = _missing(summary, rows, whole=whole)
    known = {number.key: number for number in cards(rows.values(), BEARING_CARDS)} | missing
    ranged = not whole and bool(summary["inputs"].get("ranges"))
    numbers = []
    for key in (key for key in BEARING_CARDS if key in known):
        follows = RANGE_FOLLOWS if ranged and key == "bearing.margin" else ""
        note = "; ".join(filter(None, [follows, known[key].note]))
        near = tuple(
            warning
            for warning in concerning(warnings, key)
            if known[key].known or warning.code not in _BOUNDS
        )
        number = replace(known[key], note=note, warnings=near)
        if number.known and not summary["converged"]:
            number = replace(number, bound="", note=UNUSABLE, known=False)
        numbers.append(number)
    return tuple(numbers)


def _missing(summary: Mapping[str, Any], rows: Mapping[str, Row], *, whole: bool) -> dict[str, Number]:
    """Numbers that have no value, with the reasons, by key."""
    totals, speed = summary["bearing"], "margin.critical_speed"
    if totals["element_breakdown"] is not None and summary["converged"]:
        # Ceramic elements have numbers of their own.
        return {}
    broken, shaft = _no_voltage(summary), _no_shaft(summary)
    reasons = {
        "bearing.first_break": broken,
        "bearing.shaft_voltage": shaft,
        "bearing.margin": broken if totals["first_break"] is None else shaft,
    }
    texts = {key: ("none", why) for key, why in reasons.items() if value_at(summary, key) is None}
    if totals["margin"] is None:
        texts[speed] = ("none", "there is no margin")
    elif not whole:
        texts[speed] = (PENDING, "being computed")
    elif speed not in rows:
        other = "margin.upper_critical_speed" in rows
        texts[speed] = ("none", "" if other else "no other speed could be computed")
    return {key: unknown(key, BEARING_BOOK[key], *text) for key, text in texts.items()}


def _no_voltage(summary: Mapping[str, Any]) -> str:
    """Reason why there is no breakdown voltage."""
    if not summary["converged"]:
        return "not converged"
    if is_shorted(summary):
        return "asperity contact is frequent: contacts discharge as they open; this is not safe"
    return "no dielectric strength is given"


def _no_shaft(summary: Mapping[str, Any]) -> str:
    """Reason why there is no shaft voltage."""
    return "asperity contact is frequent" if "motor" in summary["inputs"] else "no motor is given"


# Interval of the margin and probability of breakdown, and codes of statements and of a warning that
# the margin with these also states.
_WITHIN = ("uncertainty.margin_range", "uncertainty.breakdown_probability")
_SAID = (
    "bearing-voltages",
    "probability",
    "probability-between",
    "probability-rough",
    "probability-unknown",
    "probability-follows",
    "breakdown-expected",
)


def deciding(summary: Mapping[str, Any], *, probable: bool) -> Deciding:
    """Margin with its interval, which follows unless the answer is ``probable``. Without one the voltage that
    ceramic elements must insulate, or can; without a shaft voltage the first breakdown voltage. No number
    where there is none of them: the verdict says why.
    """
    totals = summary["bearing"]
    margin = totals["margin"] if summary["converged"] else None
    if margin is None:
        others = ("element_voltage", "element_breakdown", "first_break") if summary["converged"] else ()
        named = next((f"bearing.{key}" for key in others if totals[key] is not None), "")
        return Deciding(named, figure="breakdown")
    rows = {row.key: row for row in total_rows(summary)}
    facts = tuple(
        (BEARING_BOOK[key].label, rows[key].amount if probable else PENDING)
        for key in _WITHIN
        if key in rows or not probable
    )
    within = summary.get("uncertainty") or {}
    if within.get("failed"):
        # Points without a result leave the interval and its middle open.
        within = {}
    ends = (within["margin_low"], within["margin_high"]) if within else None
    median = [("median", ratio_text(within["margin_median"]))] if within else []
    label = gauge_text(margin, [*(facts if probable else ()), *median])
    gauge = Gauge(label, within.get("margin_median", margin), ends)
    return Deciding("bearing.margin", facts, gauge, "breakdown", _SAID)


def contacts_table(summary: Mapping[str, Any]) -> Table:
    """Table of the contacts of all elements with both rings."""
    return Table(
        "Contacts of all elements, with the cage at its first position",
        tuple(f"{name} {unit}".strip() for name, unit in contact_heads(summary, PAGE_COLUMNS)),
        tuple(tuple(contact_cells(row, PAGE_COLUMNS)) for row in summary["contacts"]),
    )


def differences(quick: Mapping[str, Any], solved: Mapping[str, Any]) -> tuple[Difference, ...]:
    """Differences of the numbers of a solved bearing from the quick ones, from their summaries."""
    before, after = ({row.key: row for row in total_rows(summary)} for summary in (quick, solved))
    pairs = ((before.get(key), after.get(key)) for key in DIFFERENCES)
    return tuple(_difference(*pair, quick["bearing"]["contacts"]) for pair in pairs if any(pair))


def _difference(quick: Row | None, solved: Row | None, way: Contacts) -> Difference:
    either = quick or solved
    assert either is not None
    before, after = (None if row is None else row.value for row in (quick, solved))
    if isinstance(before, float) and isinstance(after, float):
        change = f"{100.0 * (after / before - 1.0):+.1f} %"
    else:
        change = f"only {HOW[way]}" if isinstance(before, float) else "only solved"
    texts = ["none" if row is None else row.amount for row in (quick, solved)]
    return Difference(either.name, texts[0], texts[1], change, way)


_NO_VERDICT = "This page cannot say whether the bearing sparks."


def meaning_of(verdict: Verdict) -> str:
    """What a verdict means for the bearing, in plain words.

    Examples
    --------
    >>> meaning_of(Verdict("green", "breakdown-excluded"))
    'The computed film holds; a real film may be thinner and break down earlier.'
    """
    return str(TEXTS["meanings"]["bearing"].get(verdict.code, _NO_VERDICT))


def quick_verdict(result: BearingResult) -> Verdict:
    """Verdict without the analysis of the margin, which says that the range of the margin follows.

    It is not green then: the verdict without an analysis counts an unknown range as a doubt.
    """
    chance = quick_chance(result.solution)
    return bearing_verdict(result.solution, MarginAnalysis(), chance, follows=True, warnings=result.warnings)


def quick_summary(result: BearingResult) -> dict[str, Any]:
    """Summary without the analysis of the margin and the probability of breakdown."""
    return summary_of(result.solution, result.warnings)


# Sentences about the direction of the load.
_PULLS_DOWN = "The radial load on the inner ring points down."
_PULLS_ALONG = "The load is purely axial: it points out of this figure."


def bearing_case(table: Mapping[str, Any], contacts: str = "", session: Path | None = None) -> BearingCase:
    """Case of a bearing from tables as a person writes them; InputError if they are none."""
    case = case_of(table, session)
    if not isinstance(case, BearingCase):
        raise InputError.missing("bearing", "a table with the inputs of a bearing")
    return case.replace({"contacts": contacts}) if contacts else case


def without_cycle(table: Mapping[str, Any], session: Path | None) -> BearingCase:
    """Case of a bearing at its own operating point, which needs no file of a duty cycle."""
    return bearing_case(at_operating_point(table), session=session)


def quick_answer(table: Mapping[str, Any], session: Path | None = None) -> BearingAnswer:
    """Answer about a bearing without solving its contacts, and without what depends on other inputs.

    Contacts are from formulas if the tables request them, and otherwise from the atlas of films. A duty cycle
    has an answer of its own, ``duty_answer``.

    Raises InputError if the tables are no valid case, or neither the atlas nor a formula describes its films.
    """
    return _quick(_quick_key(without_cycle(table, session)))


def curves_answer(table: Mapping[str, Any], session: Path | None = None) -> BearingAnswer:
    """Answer about a bearing as ``quick_answer`` has it, with the curves over the speed."""
    key = _quick_key(without_cycle(table, session))
    result, quick = _solved(key), _quick(key)
    figures, left_out = _curves(result, quick_summary(result)) if result.converged else ({}, ())
    if left_out:
        # Numbers that the warnings concern have them.
        return answer_of(result, analysed=False)
    return replace(quick, has_curves=True, figures={**quick.figures, **figures})


def whole_quick_answer(table: Mapping[str, Any], session: Path | None = None) -> BearingAnswer:
    """Answer about a bearing as ``curves_answer`` has it, with critical speeds, effects of the inputs and the
    probability of breakdown.
    """
    return answer_of(solved_quickly(without_cycle(table, session)))


def duty_answer(table: Mapping[str, Any], session: Path | None = None) -> DutyAnswer:
    """Answer about the duty cycle of a bearing, which takes several seconds.

    Raises InputError if the tables are no valid case or name no cycle, or its file cannot be used.
    """
    case = bearing_case(table, session=session)
    duty = run_duty(case)
    if duty is None:
        raise InputError.missing("duty.file", "a file of a duty cycle")
    result = solved_quickly(case.model_copy(update={"duty": None}))
    summary = quick_summary(result) | {"duty": plain(duty.summary())}
    return shown_duty(duty, summary)


def solve_contacts(
    table: Mapping[str, Any], session: Path, folder: Path, progress: Progress
) -> BearingAnswer:
    """Whole answer about a bearing with solved contacts, by the run that the command uses. Raises
    InputError if the tables are no valid case, or the bearing cannot be solved; LostError where the process
    of a contact was killed four times.
    """

    def report(done: int, of: int, _: str) -> None:
        progress(done, of, "contacts")

    # A core is left for the pages.
    workers = max(1, cores() - 1)
    case = bearing_case(table, session=session)
    outcome = run_bearing(case, folder, report, contacts="solved", workers=workers)
    progress(0, 0, "speeds and ranges")
    return answer_of(outcome.result, changes=_changes(case, outcome.summary))


def _changes(case: BearingCase, solved: Mapping[str, Any]) -> tuple[Difference, ...]:
    """Differences from the quick numbers; none where neither the atlas nor a formula describes the films."""
    if not solved["converged"]:
        return ()
    try:
        quick = quick_summary(solved_quickly(case))
    except InputError:
        return ()
    return differences(quick, solved)


def solved_quickly(case: BearingCase) -> BearingResult:
    """Bearing with contacts from formulas if its case requests them, and otherwise from the atlas of films.

    Heat that would be solved, in many seconds, is taken from a formula.
    """
    return _solved(_quick_key(case))


def _quick_key(case: BearingCase) -> CaseKey:
    """Key of a case with contacts that are not solved."""
    changed = heat_by_formula(case).replace({"contacts": quick_way(case.contacts)})
    return key_of(changed, without_effect=())


@lru_cache(maxsize=4)
def _solved(key: CaseKey) -> BearingResult:
    """Bearing of a case, which the whole answer has again after the first one."""
    return solve_bearing(key.case, workers=1)


@lru_cache(maxsize=4)
def _quick(key: CaseKey) -> BearingAnswer:
    """Answer without curves and analysis, to which the curves are added."""
    return answer_of(_solved(key), analysed=False, curves=False)


def answer_of(
    result: BearingResult,
    *,
    analysed: bool = True,
    curves: bool = True,
    changes: tuple[Difference, ...] = (),
) -> BearingAnswer:
    """Answer of a solved bearing.

    An ``analysed`` answer has critical speeds, effects of the inputs and the probability of breakdown, which
    take a quarter of a second. ``curves`` adds the curves over the speed.
    """
    summary = result.summary() if analysed else quick_summary(result)
    verdict = result.verdict if analysed else quick_verdict(result)
    warnings = result.warnings
    if analysed and result.uncertainty is not None:
        warnings += result.uncertainty.warnings
    figures = _figures(result, summary) if result.converged else {}
    if curves and result.converged:
        further, left_out = _curves(result, summary)
        warnings, figures = (*warnings, *left_out), {**figures, **further}
    placed = limited_to(page_warnings_of(warnings), BEARING_CARDS)
    return BearingAnswer(
        title=result.case.title,
        contacts=result.case.contacts,
        whole=analysed and curves,
        has_curves=curves,
        analysed=analysed,
        converged=result.converged,
        verdict=verdict,
        meaning=meaning_of(verdict),
        how=_how(result),
        shown=shown_numbers(summary, placed, whole=analysed),
        deciding=deciding(summary, probable=analysed),
        numbers=summary["bearing"],
        margin=summary.get("margin"),
        contact_rows=tuple(summary["contacts"]),
        # Rows of a duty cycle stand with it.
        lines=lines_of(total_rows({**summary, "duty": None})),
        figures=figures,
        warnings=placed,
        seconds=summary["seconds"],
        differences=changes,
        effects=effects_table(summary),
        duty=shown_duty(result.duty, summary) if analysed and result.duty is not None else None,
    )


def _curves(
    result: BearingResult, summary: Mapping[str, Any]
) -> tuple[dict[str, Figure], tuple[ResultWarning, ...]]:
    """Figures over the speed, and warnings about speeds and voltages that they lack."""
    key = key_of(result.case, without_effect=())
    points, left_out = _over_speed(key, summary["bearing"]["lambda_ratio"])
    if len(points) < 2:
        return {}, tuple(left_out)
    over = OverSpeed.of(points, (result.case.bearing.inner_speed, dict(summary)))
    return _speed_figures(over, bound=capacitance_is_bound(result.solution)), tuple(left_out)


@lru_cache(maxsize=4)
def _over_speed(key: CaseKey, lambda_ratio: float) -> tuple[list[Speed], list[ResultWarning]]:
    """Numbers of a bearing at many speeds, which the whole answer has again after the curves."""
    return over_speed(key.case, ratio_of_case=lambda_ratio)


def _how(result: BearingResult) -> str:
    """Sentence about the contacts: how they were computed, and how far off they may be."""
    if result.case.contacts == "solved":
        return "Contacts solved: film, pressure and field of each contact are computed."
    how, off = HOW[result.case.contacts], error_text(result.solution)
    return f"Contacts {how}: films may be {off} off. Solving computes film and field."


def _figures(result: BearingResult, summary: Mapping[str, Any]) -> dict[str, Figure]:
    """Figures around the shaft."""
    rows, radial = summary["contacts"], result.case.bearing.radial_load > 0.0
    loads, films = load_panel(result), film_panel(result)
    table = contacts_table(summary)
    loaded = [row for row in rows if row["solved"]]
    most = max(loaded, key=lambda row: row["load"])
    least = min(loaded, key=lambda row: row["minimum_thickness"])
    load = (
        f"the largest is {readable(most['load'], 4)} N, {most['ring']} contact of element {most['element']}"
    )
    film = (
        f"the smallest is {readable(1e6 * least['minimum_thickness'], 4)} µm (λ "
        f"{readable(least['lambda_ratio'])}), "
        f"{least['ring']} contact of element {least['element']}"
    )
    return {
        "load": Figure(
            f"Load of the contacts [{loads.unit}]",
            f"Load of all contacts around the shaft: {load}",
            ring_figure(loads, radial=radial),
            table,
            _PULLS_DOWN if radial else _PULLS_ALONG,
        ),
        "film": Figure(
            f"Minimum film thickness [{films.unit}]",
            f"Minimum film of the loaded contacts around the shaft: {film}",
            ring_figure(films, radial=radial),
            table,
            _gaps(result),
        ),
    }


def _gaps(result: BearingResult) -> str:
    """Sentence about contacts without load, which have a gap instead of a film."""
    gaps = {name: largest_gap(result, name) for name in ("inner", "outer")}
    texts = [f"{name} ring up to {amount(gap, 'm')}" for name, gap in gaps.items() if gap is not None]
    if not texts:
        return "All elements are loaded by both rings."
    return f"Elements without load have a gap instead of a film, not drawn: {', '.join(texts)}."


def _speed_figures(over: OverSpeed, *, bound: bool) -> dict[str, Figure]:
    """Figures over the speed; voltages only where there is a breakdown or a shaft voltage at any speed."""
    how = ", scaled to the solved contacts" if _is_solved(over) else ""
    table = Table(f"Bearing over its speed, {over.contacts}{how}", SPEED_HEADS, tuple(speed_rows(over)))
    names = {"first_break": "first breakdown", "shaft_voltage": "shaft voltage"}
    drawn = {name: key for key, name in names.items() if np.any(np.isfinite(over.curves[key]))}
    figures = {}
    if drawn:
        breaks = "first breakdown" in drawn
        ideal = "bearing.first_break" in bearing_bounds(BEARING_BOOK, over.at_case[1])
        label = " and ".join(name.replace("breakdown", "breakdown voltage") for name in drawn)
        figures["breakdown"] = Figure(
            "Breakdown voltage over speed" if breaks else "Shaft voltage over speed",
            f"{capital(label)} over the speed of the inner ring",
            breakdown_figure(over),
            table,
            f"{'Breakdown voltages are upper bounds, with' if breaks and ideal else 'With'} "
            f"{over.contacts}{_scaled(over, drawn)}.",
        )
    figures["capacitance"] = Figure(
        "Capacitance over speed",
        "Capacitance over the speed of the inner ring, with its range from air to oil around the films",
        capacitance_figure(over),
        table,
        f"{'An upper bound, with' if bound else 'With'} {over.contacts}"
        f"{_scaled(over, {'capacitance': 'capacitance'})}.",
    )
    return figures


def _is_solved(over: OverSpeed) -> bool:
    return bool(over.at_case[1]["bearing"]["contacts"] == "solved")


def _scaled(over: OverSpeed, keys: Mapping[str, str]) -> str:
    """End of a sentence: the factors by which quick curves are scaled to solved contacts, by name."""
    if not _is_solved(over):
        return ""
    factors = [f"{readable(over.curves.scaled[key])} ({name})" for name, key in keys.items()]
    return f", scaled by {' and '.join(factors)} to the solved contacts (star)"
