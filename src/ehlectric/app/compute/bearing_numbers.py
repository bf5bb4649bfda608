"""Numbers of a bearing as its page shows them: with units, bounds and warnings, or why there is none."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.app.answers.bearing import PENDING, RANGE_FOLLOWS, Difference, Number, Table
from ehlectric.app.answers.told import Told, beside
from ehlectric.bearing.intermittency.duty import CAPACITIVE
from ehlectric.bearing.intermittency.words import time_text
from ehlectric.cases.bearings.ways import HOW
from ehlectric.discharge.verdict import ratio_text
from ehlectric.quantities.formats import amount
from ehlectric.quantities.rows import Row
from ehlectric.quantities.units import rpm_text
from ehlectric.tables.bearing import total_rows

# Names of the first breakdown and of the voltages with a coating.
FIRST = "First breakdown voltage"
FIRST_ON_SHAFT = "Shaft voltage of the first breakdown"

_CAPACITANCE, _LAMBDA, _REGIME = "bearing.capacitance", "bearing.lambda_ratio", "bearing.regime"

# Words of the state of lubrication.
STATES = {
    "conducting": "surfaces touch",
    "touching": "surfaces touch",
    "partial film": "surfaces may touch",
    "full film": "full film",
}


# Rows of speeds at which breakdown begins, with their bounds where the film is an ideal one.
_SPEED_BOUNDS = {"critical speed": "≥", "upper critical speed": "≤", "surfaces touch below": "≥"}

# Warnings of voltages that are bounds, which stand beside no number that is missing.
_BOUNDS = ("isothermal-film", "smooth-film")


def shown_numbers(summary: Mapping[str, Any], told: tuple[Told, ...], *, whole: bool) -> tuple[Number, ...]:
    """Numbers at the top of the page.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, with or without its table ``margin``, SI units.
    told : tuple of Told
        Warnings of the result.
    whole : bool
        Whether the summary has the table ``margin``.

    Returns
    -------
    tuple of Number
        Capacitance, first breakdown, shaft voltage, margin, lambda ratio, critical speed and regime.
    """
    found = (
        _capacitance(summary, told),
        _first_break(summary, told),
        _shaft_voltage(summary, told),
        _margin(summary, told),
        _lambda(summary, told),
        _critical_speed(summary, told, whole=whole),
        _regime(summary, told),
    )
    return found if summary["converged"] else tuple(map(_unusable, found))


def _unusable(number: Number) -> Number:
    """Number of films that are not converged, with words that say so."""
    if not number.known:
        return number
    note = "not converged: do not use this value"
    return Number(number.name, number.label, number.text, note=note, known=False, told=number.told)


def _capacitance(summary: Mapping[str, Any], told: tuple[Told, ...]) -> Number:
    totals = summary["bearing"]
    low, high = (amount(totals[f"capacitance_{fill}"], "F") for fill in ("air", "oil"))
    note = f"{low} with air around the films, {high} with oil"
    bound = "≤" if _has(told, "capacitance-bound") else ""
    note = f"upper bound; {note}" if bound else note
    text = amount(totals["capacitance"], "F")
    return Number("bearing.capacitance", "Capacitance", text, bound, note, told=beside(told, _CAPACITANCE))


def _first_break(summary: Mapping[str, Any], told: tuple[Told, ...]) -> Number:
    totals, name = summary["bearing"], "bearing.first_break"
    # With a coating, the films have only a part of the voltage on the shaft.
    coated = totals["coating_capacitance"] is not None
    label = FIRST_ON_SHAFT if coated else FIRST
    value, near = totals["shaft_first_break"], beside(told, name)
    if value is None:
        near = tuple(one for one in near if one.code not in _BOUNDS)
        return Number(name, label, "none", note=_no_voltage(summary), known=False, told=near)
    note = f"{_bound_words(told)}; at the {totals['first_break_at']}"
    if coated:
        across = amount(totals["first_break"], "V")
        note += f"; the first breakdown voltage of the films is ≤ {across}, and the coating has the rest"
    return Number(name, label, amount(value, "V"), "≤", note, told=near)


def _bound_words(told: tuple[Told, ...]) -> str:
    """Reason why breakdown voltages are upper bounds; smooth films always make them so."""
    films = "isothermal, fully flooded, smooth film" if _has(told, "isothermal-film") else "smooth film"
    more = [
        (", whose surfaces may touch", "partial-film"),
        (", at a probability of 63.2 %", "weibull-voltage"),
    ]
    return f"upper bound: {films}" + "".join(text for text, code in more if _has(told, code))


def _shaft_voltage(summary: Mapping[str, Any], told: tuple[Told, ...]) -> Number:
    value, name, label = summary["bearing"]["shaft_voltage"], "bearing.shaft_voltage", "Shaft voltage"
    near = beside(told, name)
    if value is None:
        return Number(name, label, "none", note=_no_shaft(summary, told), known=False, told=near)
    ratio = 100.0 * summary["bearing"]["bearing_voltage_ratio"]
    note = f"{ratio:.3g} % of the common-mode voltage"
    leaks = _has(told, "shaft-leaks")
    note = f"upper bound, the oil discharges it; {note}" if leaks else note
    return Number(name, label, amount(value, "V"), "≤" if leaks else "", note, told=near)


def _margin(summary: Mapping[str, Any], told: tuple[Told, ...]) -> Number:
    totals, name, label = summary["bearing"], "bearing.margin", "Margin"
    value, near = totals["margin"], beside(told, name)
    if value is None:
        why = _no_voltage(summary) if totals["shaft_first_break"] is None else _no_shaft(summary, told)
        near = tuple(one for one in near if one.code not in _BOUNDS)
        return Number(name, label, "none", note=why, known=False, told=near)
    analysis = summary.get("margin")
    note = "upper bound; first breakdown / shaft voltage, breakdown below 1"
    probability = totals.get("breakdown_probability")
    if probability is not None:
        note += f"; breakdown with a probability of {100.0 * probability:.2g} % while films insulate"
    if analysis is not None and analysis["low"] is not None:
        low, high = ratio_text(analysis["low"]), ratio_text(analysis["high"])
        note = f"{low} to {high} within the stated ranges; {note}"
    elif analysis is None and summary["inputs"].get("ranges"):
        note = f"{RANGE_FOLLOWS}; {note}"
    return Number(name, label, ratio_text(value), "≤", note, told=near)


def _lambda(summary: Mapping[str, Any], told: tuple[Told, ...]) -> Number:
    totals = summary["bearing"]
    least = amount(totals["lambda_ratio"] * summary["inputs"]["bearing"]["composite_rq"], "m")
    bound = "≤" if film_is_bound(summary) else ""
    film = f"minimum film {bound} {least}" if bound else f"minimum film {least}"
    note = f"{STATES[totals['lubrication']]}; {film}"
    text = f"{totals['lambda_ratio']:.3g}"
    return Number(
        "bearing.lambda_ratio",
        "Lambda ratio, minimum",
        text,
        bound,
        note,
        told=beside(told, _LAMBDA),
    )


def _regime(summary: Mapping[str, Any], told: tuple[Told, ...]) -> Number:
    """Electrical regime in one word, with the share of time in which contacts short the bearing."""
    totals = summary["bearing"]
    note = f"contacts short it {time_text(totals['contact_time_share'])}"
    if totals["contact_time_share"] == 0.0 and totals["touching_time_share"] > 0.0:
        note = "ceramic elements or a coating insulate"
    speed = (summary.get("margin") or {}).get("capacitive_speed")
    if speed is not None:
        # Thinner films touch up to higher speeds.
        bound = "≥ " if film_is_bound(summary) else ""
        seldom = f"shorted at most {100.0 * CAPACITIVE:g} % of the time"
        note += f"; capacitive ({seldom}) from {bound}{rpm_text(speed)} rpm"
    return Number("bearing.regime", "Regime", totals["regime"], note=note, told=beside(told, _REGIME))


def _critical_speed(summary: Mapping[str, Any], told: tuple[Told, ...], *, whole: bool) -> Number:
    name, label = "margin.critical_speed", "Critical speed"
    if summary["bearing"]["margin"] is None:
        return Number(name, label, "none", note="there is no margin", known=False)
    if not whole:
        return Number(name, label, PENDING, note="being computed", known=False)
    rows = [row for row in total_rows(summary) if row.name in _SPEED_BOUNDS]
    if not rows:
        return Number(name, label, "none", note="no other speed could be computed", known=False)
    first, *others = rows
    leaks = _has(told, "shaft-leaks")
    notes = [
        first.note.removeprefix("rpm").strip(" ,:"),
        *(f"{row.name} {row.text}" for row in others),
    ]
    text, note = f"{first.shown} rpm", "; ".join(filter(None, notes))
    return Number(name, label, text, speed_bound(first, summary, leaks=leaks), note)


def film_is_bound(summary: Mapping[str, Any]) -> bool:
    """Whether real films are thinner than those of a summary: fully flooded, and smooth.

    A film factor that is given stands for starvation and heat as well, and so does a supply for starvation.
    """
    bearing = summary["inputs"]["bearing"]
    heated = (
        bearing.get("film_factor") in ("inlet-shear", "solved")
        and bearing.get("supply", "flooded") == "flooded"
    )
    return bool(summary["bearing"]["film_factor"] == 1.0) or heated


def speed_bound(row: Row, summary: Mapping[str, Any], *, leaks: bool) -> str:
    """Bound of a critical speed; empty for other rows, and for words in place of a speed.

    A thinner film breaks down at higher speeds too, and touches at them. A shaft voltage that is an upper
    bound, because the oil ``leaks``, acts the other way.
    """
    if row.name not in _SPEED_BOUNDS or not row.shown.replace(".", "").isdigit():
        return ""
    if row.name == "surfaces touch below":
        return _SPEED_BOUNDS[row.name] if film_is_bound(summary) else ""
    return "" if leaks else _SPEED_BOUNDS[row.name]


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
    if _has(told, "capacitance-bound"):
        return "the capacitance of the ceramic elements is an upper bound only"
    return "the surfaces touch"


def _has(told: tuple[Told, ...], code: str) -> bool:
    return any(one.code == code for one in told)


CONTACT_HEADS = (
    "element",
    "ring",
    "position [°]",
    "load [N]",
    "Hertz pressure [GPa]",
    "h_min [µm]",
    "λ",
    "C [pF]",
    "breakdown [V]",
)


def contacts_table(rows: list[dict[str, Any]]) -> Table:
    """Table of the contacts of all elements with both rings."""
    return Table(
        "Contacts of all elements, with the cage at its first position",
        CONTACT_HEADS,
        tuple(tuple(_contact_cells(row)) for row in rows),
    )


def _contact_cells(row: Mapping[str, Any]) -> Iterator[str]:
    film = f"{1e6 * row['minimum_thickness']:.4g}"
    yield str(row["element"])
    yield row["ring"]
    yield f"{row['position'] * 57.29577951308232:.0f}"
    yield f"{row['load']:.4g}"
    yield _cell(row["max_pressure"], 1e-9, ".3f")
    yield film if row["solved"] else f"gap {film}"
    yield f"{row['lambda_ratio']:.3g}" if row["solved"] else "no load"
    yield _cell(row["capacitance"], 1e12, ".4g")
    yield _cell(row["breakdown_voltage"], 1.0, ".3g")


def _cell(value: float | None, factor: float, digits: str) -> str:
    return "none" if value is None else f"{value * factor:{digits}}"


def differences(quick: Mapping[str, Any], solved: Mapping[str, Any]) -> tuple[Difference, ...]:
    """Differences of the numbers of a solved bearing from the quick ones, from their summaries."""
    found, way = [], quick["bearing"]["contacts"]
    coated = solved["bearing"]["coating_capacitance"] is not None
    first = (FIRST_ON_SHAFT if coated else FIRST).lower()
    for name, key, unit in (
        ("capacitance", "capacitance", "F"),
        (first, "shaft_first_break", "V"),
        ("shaft voltage", "shaft_voltage", "V"),
        ("margin", "margin", ""),
        ("minimum film", "lambda_ratio", "m"),
    ):
        values = [summary["bearing"][key] for summary in (quick, solved)]
        if unit == "m":
            values = [value * solved["inputs"]["bearing"]["composite_rq"] for value in values]
        one, two = values
        if one is None and two is None:
            continue
        if one is None or two is None:
            change = f"only {HOW[way]}" if two is None else "only solved"
        else:
            change = f"{100.0 * (two / one - 1.0):+.1f} %"
        before, own = (_difference_text(value, unit) for value in values)
        found.append(Difference(name, before, own, change, way))
    return tuple(found)


def _difference_text(value: float | None, unit: str) -> str:
    if value is None:
        return "none"
    return amount(value, unit) if unit else ratio_text(value)
