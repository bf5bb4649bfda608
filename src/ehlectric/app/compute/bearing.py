"""Answers about a bearing: at once from the atlas, whole a moment later, and with solved contacts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.app.answers.bearing import BearingAnswer, Difference, Figure, Table
from ehlectric.app.answers.told import within
from ehlectric.app.compute.bearing_effects import effects_table
from ehlectric.app.compute.bearing_numbers import contacts_table, differences, shown_numbers
from ehlectric.app.compute.bearing_verdict import judged, quick_verdict
from ehlectric.app.compute.cases import case_of
from ehlectric.app.compute.lines import lines_of
from ehlectric.app.compute.warnings import told_of
from ehlectric.app.figures.bearing import Around, film_figure, load_figure
from ehlectric.app.figures.bearing_speeds import (
    SPEED_HEADS,
    OverSpeed,
    breakdown_figure,
    capacitance_figure,
    speed_rows,
)
from ehlectric.bearing.accuracy import error_text
from ehlectric.bearing.quick.ways import heat_by_formula
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import capacitance_is_bound
from ehlectric.bearing.solver import solve_bearing
from ehlectric.bearing.speeds import over_speed
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.ways import HOW, quick_way
from ehlectric.errors import InputError
from ehlectric.quantities.formats import amount
from ehlectric.quantities.sheets import BEARING_CARDS
from ehlectric.runs.by_kind import run_bearing
from ehlectric.runtime.parallel.workers import cores
from ehlectric.runtime.progress import Progress
from ehlectric.tables.bearing import total_rows

# Sentences about the direction of the load.
_PULLS_DOWN = "The radial load on the inner ring points down."
_PULLS_ALONG = "The load is purely axial: it points out of this figure."


def bearing_case(table: Mapping[str, Any], contacts: str = "", session: Path | None = None) -> BearingCase:
    """Case of tables as a person writes them.

    Parameters
    ----------
    table : mapping
        Nested tables of a bearing file.
    contacts : str
        "atlas", "formula" or "solved" in place of that of the tables.
    session : Path, optional
        Folder of the session, in which files that the case names lie; without it, the case may name none.

    Raises
    ------
    InputError
        If the tables are no valid case of a bearing.
    """
    case = case_of(table, session)
    if not isinstance(case, BearingCase):
        raise InputError.missing("bearing", "a table with the inputs of a bearing")
    return case.replace({"contacts": contacts}) if contacts else case


def quick_answer(table: Mapping[str, Any], session: Path | None = None) -> BearingAnswer:
    """Answer about a bearing without solving its contacts, and without what depends on other inputs.

    Contacts are by formula where the tables say so, and otherwise from the atlas of films.

    Parameters
    ----------
    table : mapping
        Nested tables of a bearing file.
    session : Path, optional
        Folder of the session.

    Raises
    ------
    InputError
        If the tables are no valid case, or neither the atlas nor a formula describes its films.
    """
    return answer_of(_quick(table, session), whole=False)


def whole_quick_answer(table: Mapping[str, Any], session: Path | None = None) -> BearingAnswer:
    """Answer about a bearing as ``quick_answer`` has it, with critical speeds and effects of the inputs."""
    return answer_of(_quick(table, session), whole=True)


def solve_contacts(
    table: Mapping[str, Any], session: Path, folder: Path, progress: Progress
) -> BearingAnswer:
    """Whole answer about a bearing with solved contacts, by the same run as that of the command.

    Parameters
    ----------
    table : mapping
        Nested tables of a bearing file.
    session : Path
        Folder of the session.
    folder : Path
        Folder of the result's files.
    progress : callable
        Called with the number of solved contacts, the number of all contacts, and a text.

    Raises
    ------
    InputError
        If the tables are no valid case, or the bearing cannot be solved.
    LostError
        Where the process of a contact was killed four times.
    """

    def told(done: int, of: int, _: str) -> None:
        progress(done, of, "contacts")

    # A core is left for the pages.
    workers = max(1, cores() - 1)
    case = bearing_case(table, session=session)
    outcome = run_bearing(case, folder, told, contacts="solved", workers=workers)
    progress(0, 0, "speeds and ranges")
    return answer_of(outcome.result, whole=True, changes=_changes(case, outcome.summary))


def _changes(case: BearingCase, solved: Mapping[str, Any]) -> tuple[Difference, ...]:
    """Differences from the quick numbers; none where neither the atlas nor a formula describes the films."""
    if not solved["converged"]:
        return ()
    try:
        quick = summary_of(solved_quickly(case).solution)
    except InputError:
        return ()
    return differences(quick, solved)


def _quick(table: Mapping[str, Any], session: Path | None) -> BearingResult:
    return solved_quickly(bearing_case(table, session=session))


def solved_quickly(case: BearingCase) -> BearingResult:
    """Bearing with contacts by formula where its case says so, and otherwise from the atlas of films.

    Heat that would be solved, in many seconds, is that of a formula.
    """
    changes = {"contacts": quick_way(case.contacts)}
    return solve_bearing(heat_by_formula(case).replace(changes), workers=1)


def answer_of(result: BearingResult, *, whole: bool, changes: tuple[Difference, ...] = ()) -> BearingAnswer:
    """Answer of a solved bearing; ``whole`` with the analysis of its margin, which takes a second or two."""
    summary = result.summary() if whole else summary_of(result.solution)
    verdict = result.verdict if whole else quick_verdict(result.solution)
    warnings = result.warnings
    figures = _figures(result, summary) if result.converged else {}
    if whole and result.converged:
        points, left_out = over_speed(result.case)
        warnings += tuple(left_out)
        own = (result.case.bearing.inner_speed, summary)
        bound = capacitance_is_bound(result.solution)
        over = OverSpeed.of(points, own, level=verdict.level)
        figures |= _speed_figures(over, bound=bound) if len(points) > 1 else {}
    told = within(told_of(warnings, verdict.level), BEARING_CARDS)
    return BearingAnswer(
        title=result.case.title,
        contacts=result.case.contacts,
        whole=whole,
        converged=result.converged,
        level=verdict.level,
        text=verdict.text,
        judged=judged(verdict),
        how=_how(result),
        shown=shown_numbers(summary, told, whole=whole),
        numbers=summary["bearing"],
        margin=summary.get("margin"),
        contact_rows=tuple(summary["contacts"]),
        lines=lines_of(total_rows(summary)),
        figures=figures,
        warnings=told,
        seconds=summary["seconds"],
        differences=changes,
        effects=effects_table(summary, verdict.level),
    )


def _how(result: BearingResult) -> str:
    """Sentence about the contacts: how they were computed, and how far off they may be."""
    if result.case.contacts == "solved":
        return "Contacts solved: film, pressure and field of each contact are computed."
    how, off = HOW[result.case.contacts], error_text(result.solution)
    return f"Contacts {how}: films may be {off} off. Solving computes film and field."


def _figures(result: BearingResult, summary: Mapping[str, Any]) -> dict[str, Figure]:
    """Figures around the shaft."""
    rows, around = summary["contacts"], _around(result)
    rq, radial = result.case.bearing.composite_rq, result.case.bearing.radial_load > 0.0
    table = contacts_table(summary)
    loaded = [row for row in rows if row["solved"]]
    most = max(loaded, key=lambda row: row["load"])
    least = min(loaded, key=lambda row: row["minimum_thickness"])
    load = f"the largest is {most['load']:.4g} N, {most['ring']} contact of element {most['element']}"
    film = (
        f"the smallest is {1e6 * least['minimum_thickness']:.4g} µm (λ {least['lambda_ratio']:.3g}), "
        f"{least['ring']} contact of element {least['element']}"
    )
    return {
        "load": Figure(
            "Load of the contacts [N]",
            f"Load of all contacts around the shaft: {load}",
            load_figure(rows, around, radial=radial),
            table,
            _PULLS_DOWN if radial else _PULLS_ALONG,
        ),
        "film": Figure(
            "Minimum film thickness [µm]",
            f"Minimum film of the loaded contacts around the shaft: {film}",
            film_figure(rows, around, rq, radial=radial),
            table,
            _gaps(around),
        ),
    }


def _gaps(around: Mapping[str, Around]) -> str:
    """Sentence about contacts without load, which have a gap in place of a film."""
    found = []
    for name, ring in around.items():
        gaps = [film for film, on in zip(ring.film, ring.loaded, strict=True) if not on]
        if gaps:
            found.append(f"{name} ring up to {amount(max(gaps), 'm')}")
    if not found:
        return "All elements are loaded by both rings."
    return f"Elements without load have a gap in place of a film, not drawn: {', '.join(found)}."


def _around(result: BearingResult) -> dict[str, Around]:
    """Contacts of all elements at all positions of the cage, by the name of the ring."""
    positions = result.solution.positions
    angle = np.mod(np.concatenate([one.equilibrium.position for one in positions]), 2.0 * np.pi)
    order = np.argsort(angle, kind="stable")
    found = {}
    for name in ("inner", "outer"):
        rings = [getattr(position, name) for position in positions]
        load, film, loaded = (
            np.concatenate(columns)[order].tolist()
            for columns in (
                [ring.load for ring in rings],
                [ring.values.minimum_thickness for ring in rings],
                [ring.solved for ring in rings],
            )
        )
        found[name] = Around(angle[order].tolist(), load, film, loaded)
    return found


def _speed_figures(over: OverSpeed, *, bound: bool) -> dict[str, Figure]:
    """Figures over the speed; voltages only where there is a breakdown or a shaft voltage at any speed."""
    how = ", scaled to the solved contacts" if _is_solved(over) else ""
    caption = f"Bearing over its speed, {over.contacts}{how}"
    table = Table(caption, SPEED_HEADS, tuple(speed_rows(over)))
    drawn = {
        name: key
        for name, key in (("first breakdown", "first_break"), ("shaft voltage", "shaft_voltage"))
        if np.any(np.isfinite(over.curves[key]))
    }
    found = {}
    if drawn:
        breaks = "first breakdown" in drawn
        names = " and ".join(name.replace("breakdown", "breakdown voltage") for name in drawn)
        found["breakdown"] = Figure(
            "Breakdown voltage over speed" if breaks else "Shaft voltage over speed",
            f"{names[0].upper()}{names[1:]} over the speed of the inner ring",
            breakdown_figure(over),
            table,
            ("Breakdown voltages are upper bounds, with" if breaks else "With")
            + f" {over.contacts}{_scaled(over, drawn)}.",
        )
    found["capacitance"] = Figure(
        "Capacitance over speed",
        "Capacitance over the speed of the inner ring, with its range from air to oil around the films",
        capacitance_figure(over),
        table,
        f"{'An upper bound, with' if bound else 'With'} {over.contacts}"
        f"{_scaled(over, {'capacitance': 'capacitance'})}.",
    )
    return found


def _is_solved(over: OverSpeed) -> bool:
    return bool(over.own[1]["bearing"]["contacts"] == "solved")


def _scaled(over: OverSpeed, keys: Mapping[str, str]) -> str:
    """End of a sentence: the factors by which quick curves are scaled to solved contacts, by name."""
    if not _is_solved(over):
        return ""
    factors = [f"{over.curves.scaled[key]:.3g} ({name})" for name, key in keys.items()]
    return f", scaled by {' and '.join(factors)} to the solved contacts (star)"
