"""Numbers of a bearing that its page shows large, or why there are none, and differences of solved ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.answers.bearing import PENDING, RANGE_FOLLOWS, Difference, Table
from ehlectric.app.answers.number import Number
from ehlectric.app.answers.told import Told, beside
from ehlectric.app.compute.cards import card, cards
from ehlectric.cases.bearings.ways import HOW, Contacts
from ehlectric.quantities.bearing_results import BEARING_BOOK
from ehlectric.quantities.rows import Row, row_of, value_at
from ehlectric.quantities.sheets import BEARING_CARDS, DIFFERENCES, PAGE_COLUMNS
from ehlectric.tables.bearing import contact_cells, contact_heads, total_rows

# Warnings of voltages that are bounds, which stand beside no number that is missing.
_BOUNDS = ("isothermal-film", "smooth-film")


def shown_numbers(summary: Mapping[str, Any], told: tuple[Told, ...], *, whole: bool) -> tuple[Number, ...]:
    """Numbers at the top of the page, with their warnings, and why some are missing.

    Without a ``whole`` answer the summary lacks the table ``margin``, which follows.
    """
    rows = {row.key: row for row in total_rows(summary)}
    missing = _missing(summary, told, rows, whole=whole)
    known = {one.key: one for one in cards(rows.values(), [*BEARING_CARDS])} | missing
    found = []
    for key, further in BEARING_CARDS.items():
        if key not in known:
            continue
        follows = RANGE_FOLLOWS if key == "bearing.margin" and not whole and _ranges(summary) else ""
        beneath = (f"{rows[name].name} {rows[name].amount}" for name in further if name in rows)
        note = "; ".join(filter(None, [follows, known[key].note, *beneath]))
        near = tuple(one for one in beside(told, key) if known[key].known or one.code not in _BOUNDS)
        found.append(replace(known[key], note=note, told=near))
    return tuple(found) if summary["converged"] else tuple(map(_unusable, found))


def _ranges(summary: Mapping[str, Any]) -> bool:
    return bool(summary["inputs"].get("ranges"))


def _unusable(number: Number) -> Number:
    """Number of films that are not converged, with words that say so."""
    if not number.known:
        return number
    return replace(number, bound="", note="not converged: do not use this value", known=False)


def _missing(
    summary: Mapping[str, Any], told: tuple[Told, ...], rows: Mapping[str, Row], *, whole: bool
) -> dict[str, Number]:
    """Numbers that have no value, with the reasons, by key."""
    totals, speed = summary["bearing"], "margin.critical_speed"
    broken, shaft = _no_voltage(summary), _no_shaft(summary, told)
    reasons = {
        "bearing.first_break": broken,
        "bearing.shaft_voltage": shaft,
        "bearing.margin": broken if totals["first_break"] is None else shaft,
    }
    found = {key: _none(key, "none", why) for key, why in reasons.items() if value_at(summary, key) is None}
    if totals["margin"] is None:
        found[speed] = _none(speed, "none", "there is no margin")
    elif not whole:
        found[speed] = _none(speed, PENDING, "being computed")
    elif speed not in rows:
        other = "margin.upper_critical_speed" in rows
        found[speed] = _none(speed, "none", "" if other else "no other speed could be computed")
    return found


def _none(key: str, text: str, reason: str) -> Number:
    """Number without a value, with the label of its quantity."""
    return replace(card(row_of(key, BEARING_BOOK[key], text, reason)), known=False)


def _no_voltage(summary: Mapping[str, Any]) -> str:
    """Reason why there is no breakdown voltage."""
    if not summary["converged"]:
        return "not converged"
    state, discharge = summary["bearing"]["lubrication"], summary["inputs"].get("discharge", {})
    if state == "conducting":
        return "λ is below 1: contacts open and close, and discharge as they do; this is not safe"
    laws = ("dielectric_strength", "weibull", "strength_table")
    if not any(discharge.get(law) for law in laws):
        return "no dielectric strength is given"
    return "the ceramic elements insulate, and their own breakdown is not computed"


def _no_shaft(summary: Mapping[str, Any], told: tuple[Told, ...]) -> str:
    """Reason why there is no shaft voltage."""
    if "motor" not in summary["inputs"]:
        return "no motor is given"
    if any(one.code == "capacitance-bound" for one in told):
        return "the capacitance of the ceramic elements is an upper bound only"
    return "the surfaces touch"


def contacts_table(summary: Mapping[str, Any]) -> Table:
    """Table of the contacts of all elements with both rings."""
    return Table(
        "Contacts of all elements, with the cage at its first position",
        tuple(f"{name} {unit}".strip() for name, unit in contact_heads(summary, PAGE_COLUMNS)),
        tuple(tuple(contact_cells(row, PAGE_COLUMNS)) for row in summary["contacts"]),
    )


def differences(quick: Mapping[str, Any], solved: Mapping[str, Any]) -> tuple[Difference, ...]:
    """Differences of the numbers of a solved bearing from the quick ones, from their summaries."""
    before, after = ({row.key: row for row in total_rows(one)} for one in (quick, solved))
    found = ((before.get(key), after.get(key)) for key in DIFFERENCES)
    return tuple(_difference(*pair, quick["bearing"]["contacts"]) for pair in found if any(pair))


def _difference(quick: Row | None, solved: Row | None, way: Contacts) -> Difference:
    either = quick or solved
    assert either is not None
    before, after = (None if one is None else one.value for one in (quick, solved))
    if isinstance(before, float) and isinstance(after, float):
        change = f"{100.0 * (after / before - 1.0):+.1f} %"
    else:
        change = f"only {HOW[way]}" if isinstance(before, float) else "only solved"
    texts = ["none" if one is None else one.amount for one in (quick, solved)]
    return Difference(either.name, texts[0], texts[1], change, way)
