"""Answers about a gear pair: at once with films of the atlas, and with solved films."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ehlectric.app.charts.gear_charts import film_figure, flank_figure, mesh_figure, path_figure
from ehlectric.app.compute.answer_parts import (
    at_operating_point,
    cards,
    gauge_text,
    gear_of,
    lines_of,
    page_warnings_of,
    with_warnings,
)
from ehlectric.app.compute.duty_answers import shown_mesh_duty
from ehlectric.app.view_models import (
    PENDING,
    WITHOUT_PROBABILITY,
    Deciding,
    DutyAnswer,
    Figure,
    Gauge,
    GearAnswer,
    Number,
    Table,
    limited_to,
)
from ehlectric.cases.defaults import HOW, quick_way
from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.figures.data import with_unit
from ehlectric.figures.gear_panels import (
    film_finding,
    flank_finding,
    has_voltage,
    last_colour_text,
    mesh_finding,
    path_finding,
)
from ehlectric.gear import GearResult, run_mesh_duty, solve_gear
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.results import GEAR_BOOK
from ehlectric.quantities.rows import Row, Summary, row_of
from ehlectric.quantities.sheets import GEAR, GEAR_CARDS
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import ratio_text, readable
from ehlectric.runs.by_kind import run_gear
from ehlectric.runtime.files import plain
from ehlectric.runtime.progress import Progress
from ehlectric.tables.gear_tables import gear_rows, point_rows

# Numbers that vary with the phase of the mesh.
_VARIES = ("mesh.breakdown_voltage", "mesh.capacitance")

_MEANINGS = data_file("ehlectric.app", "page_texts.toml")["gear"]["meanings"]


def gear_case(table: Mapping[str, Any], session: Path | None = None) -> GearCase:
    """Gear pair of the tables of a page. Raises InputError if they are no valid gear pair."""
    if "gear" not in table:
        raise InputError("gear", "missing", takes="the table [gear] of a gear pair")
    _check_both(table["gear"])
    return gear_of(table, session)


def _check_both(gear: Any) -> None:
    """Refuse a list whose value for one gear is still to be typed, by the key of the empty field."""
    table = gear if isinstance(gear, Mapping) else {}
    # A profile shift follows from the other one and the centre distance.
    whole = {"tip_diameter"} | (set() if "centre_distance" in table else {"profile_shift"})
    for name, values in table.items():
        if not isinstance(values, list) or not values:
            continue
        empty = next((n for n, value in enumerate(values, 1) if value == ""), None)
        if empty is None and name in whole and len(values) == 1:
            empty = 2
        if empty is not None:
            raise InputError.missing(f"gear.{name}.{empty}", "a value, as for the other gear")


def _alone(table: Mapping[str, Any], session: Path | None) -> GearCase:
    """Gear pair at its own operating point without solved films, which needs no file of a duty cycle."""
    case = gear_case(at_operating_point(table), session)
    return case.replace({"contacts": quick_way(case.contacts)})


def quick_answer(table: Mapping[str, Any], session: Path | None = None) -> GearAnswer:
    """Answer about a gear pair without solved films and without its probability of breakdown. Raises
    InputError if the tables are no valid gear pair, or its gears cannot run together.
    """
    return answer_of(solve_gear(_alone(table, session), probable=False))


def whole_answer(table: Mapping[str, Any], session: Path | None = None) -> GearAnswer:
    """Answer about a gear pair without solved films; see ``quick_answer``."""
    return answer_of(solve_gear(_alone(table, session)))


def duty_answer(table: Mapping[str, Any], session: Path | None = None) -> DutyAnswer:
    """Answer about the duty cycle of a gear pair, which takes several seconds. Raises InputError where the
    tables are no valid gear pair, or its cycle cannot be computed.
    """
    case = gear_case(table, session)
    duty = run_mesh_duty(case)
    if duty is None:
        raise InputError.missing("duty.file", "a file of a duty cycle")
    summary = solve_gear(_alone(table, session), probable=False).summary() | {"duty": plain(duty.summary())}
    return shown_mesh_duty(duty, summary, case.gear.summit_height)


def solve_pair(
    table: Mapping[str, Any], session: Path | None, folder: Path | str, progress: Progress
) -> GearAnswer:
    """Solve films as ``ehlectric gear --contacts solved`` does, with all files of the result. Raises
    InputError if the tables are no valid gear pair.
    """
    outcome = run_gear(gear_case(table, session), folder, progress, contacts="solved")
    progress(0, 0, "drawing")
    return answer_of(outcome.result)


def answer_of(result: GearResult) -> GearAnswer:
    """Answer of a solved gear pair."""
    summary, verdict = result.summary(), result.verdict
    duty = None if result.duty is None else shown_mesh_duty(result.duty, summary, _summits(result))
    # Rows of a duty cycle are with its result.
    rows = gear_rows({**summary, "duty": None})
    warnings = limited_to(page_warnings_of(result.warnings), GEAR_CARDS)
    return GearAnswer(
        title=result.case.title,
        verdict=verdict,
        meaning=meaning_of(verdict),
        how=_how(result),
        shown=with_warnings(_over_pitch(cards(rows, GEAR_CARDS), rows), warnings),
        deciding=deciding(summary, verdict, probable=result.probable),
        lines=lines_of(rows),
        warnings=warnings,
        figures=_figures(result, summary),
        seconds=summary["seconds"],
        whole=result.probable,
        solved=result.case.contacts == "solved",
        geometry=geometry_table(summary),
        points=points_table(summary),
        follows=follows(result),
        duty=duty,
    )


def _summits(result: GearResult) -> float:
    """Height of the highest summits in units of the composite Rq."""
    return float(result.case.gear.summit_height)


def _over_pitch(numbers: Iterable[Number], rows: Iterable[Row]) -> Iterator[Number]:
    """Numbers, with the range over one pitch in the notes of those that vary with the phase."""
    known = {row.key: row for row in rows}
    for number in numbers:
        low, high = (known.get(f"{number.key}_{end}") for end in ("low", "high"))
        if number.key in _VARIES and high is not None:
            first = number.text if low is None else low.shown
            number = replace(number, note=f"{first} to {high.amount} over one pitch")
        yield number


def meaning_of(verdict: Verdict) -> str:
    """What a verdict means for the mesh, in plain words.

    Examples
    --------
    >>> meaning_of(Verdict("green", "breakdown-excluded"))
    'The film holds the voltage between both gears.'
    """
    return str(_MEANINGS.get(verdict.code, _MEANINGS[verdict.level]))


def _how(result: GearResult) -> str:
    """Sentence on how films are computed, and how far off they may be."""
    films, off = HOW[result.case.contacts], readable(100.0 * result.solution.film_error, 2)
    return f"Films {films}: the minimum film may be {off} % off."


# Statements of the verdict that say no more than the margin with its voltages and its probability.
_SAID = ("mesh-voltages", "probability", "probability-between", "probability-rough", WITHOUT_PROBABILITY)

_PROBABILITY = "uncertainty.breakdown_probability"


def deciding(summary: Summary, verdict: Verdict, *, probable: bool) -> Deciding:
    """Margin with its interval and probability, which follow unless the answer is ``probable``; without a
    margin the breakdown voltage, and the lambda ratio if summits touch.
    """
    margin, interval = verdict.margin, verdict.interval
    if margin is None or interval is None:
        known = summary["mesh"]["breakdown_voltage"] is not None
        key = "mesh.breakdown_voltage" if known else "mesh.lambda_ratio"
        return Deciding(key, figure="film")
    keys = ("mesh.breakdown_voltage", "mesh.voltage")
    facts = [
        (GEAR_BOOK[key].label, row_of(key, GEAR_BOOK[key], summary["mesh"][key.partition(".")[2]]).amount)
        for key in keys
    ]
    within = PENDING
    if not probable:
        interval = None
        facts.append((GEAR_BOOK[_PROBABILITY].label, PENDING))
    elif (row := next((row for row in gear_rows(summary) if row.key == _PROBABILITY), None)) is not None:
        facts.append((row.name, row.amount))
    if interval is not None:
        within = " to ".join(map(ratio_text, interval))
    facts.append(("margin, within the ranges of the inputs", within))
    gauge = Gauge(gauge_text(margin, facts), margin, interval)
    return Deciding("mesh.margin", tuple(facts), gauge, "film", _SAID)


# Text instead of a number that needs a load.
_NO_LOAD = "–"


def points_table(summary: Summary) -> Table:
    """Table of the points A to E of the path of contact."""
    (_, *points, _), *rows = point_rows(summary)
    cells = tuple(
        (with_unit(name, unit), *(number or _NO_LOAD for number in numbers)) for name, *numbers, unit in rows
    )
    return Table("Gear 1 touches with its root at A, and with its tip at E", ("", *points), cells)


def geometry_table(summary: Summary) -> Table:
    """Table of the numbers of the geometry, as the command prints them."""
    (section,) = (section for section in GEAR if section.heading == "geometry")
    known: dict[str, Row] = {row.key: row for row in gear_rows(summary) if row.key}
    cells = tuple((known[key].name, known[key].amount) for key in section.keys if key in known)
    return Table("Geometry that follows from the drawing", ("", "value"), cells)


def follows(result: GearResult) -> dict[str, str]:
    """Values that follow from other inputs, by the keys of empty fields."""
    gear, pair = result.case.gear, result.solution.pair
    shifts = () if gear.profile_shift is None else gear.profile_shift
    texts: dict[str, str] = {}
    for number, (shift, tip) in enumerate(zip(pair.profile_shift, pair.tip_diameter, strict=True), 1):
        if len(shifts) < number:
            texts[f"gear.profile_shift.{number}"] = readable(shift)
        if gear.tip_diameter is None:
            texts[f"gear.tip_diameter.{number}"] = f"{readable(1e3 * abs(tip), 5)} mm"
    if gear.centre_distance is None:
        texts["gear.centre_distance"] = f"{readable(1e3 * abs(pair.centre_distance), 6)} mm"
    if gear.normal_backlash is None and pair.normal_backlash is not None:
        texts["gear.normal_backlash"] = f"{readable(1e6 * pair.normal_backlash)} um"
    return texts


def _figures(result: GearResult, summary: Summary) -> dict[str, Figure]:
    return dict(_drawn(result, summary))


def _drawn(result: GearResult, summary: Summary) -> Iterator[tuple[str, Figure]]:
    """Figures by name, each with its finding."""
    finding = film_finding(result)
    yield (
        "film",
        Figure(
            "Film along the path of contact",
            finding,
            film_figure(result),
            caption=f"{finding}. Dotted lines: points A to E.",
        ),
    )
    finding = flank_finding(result)
    yield (
        "flank",
        Figure(
            "Minimum film on the flank of gear 1",
            finding,
            flank_figure(result),
            caption=f"{finding}. The root is at A, and the tip is at E.{last_colour_text(result)}",
        ),
    )
    finding = mesh_finding(result)
    names = "Capacitance and breakdown voltage" if has_voltage(result) else "Capacitance and contact"
    yield "mesh", Figure(f"{names} over one pitch", finding, mesh_figure(result), caption=f"{finding}.")
    finding, table = path_finding(result), points_table(summary)
    title = "Radii, speeds, load and pressure along the path of contact"
    yield "path", Figure(title, finding, path_figure(result), table, caption=f"{finding}.")
