"""Verdict on a film: whether breakdown is expected."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from ehlectric.arrays import Numbers
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.breakdown_rule import (
    STRENGTH_UNKNOWN,
    code_of,
    doubted,
    level_of,
    strength_interval,
)
from ehlectric.discharge.film_breakdown import Breakdown
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning, WarningCondition
from ehlectric.quantities.statement import Fact, Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import ratio_text

# Codes of warnings of results whose margin may be lower than computed: no verdict is green with one of them.
DOUBTS: tuple[str, ...] = tuple(data_file("ehlectric.quantities", "warning_codes.toml")["doubts"])


def strength_clause(discharge: Discharge, stated: tuple[float, float] | None = None) -> Statement:
    """Clause on the dielectric strength of the case; ``stated`` is the range of a constant one [V/m]."""
    strength, table = discharge.dielectric_strength, discharge.strength_table
    if strength is not None:
        between = None if stated is None else Statement.of("strength-range", low=stated[0], high=stated[1])
        return Statement.of("strength", strength=strength, range=between)
    if table is not None:
        return Statement.of("strength-table", over=table.over)
    return Statement.of("strength-weibull")


def strength_doubt(discharge: Discharge, margin: float) -> tuple[Statement, ...]:
    """Statement on a margin that a change of the strength takes across 1; none where none does.

    Examples
    --------
    >>> law = Discharge.from_dict({"dielectric_strength": "15 V/um"})
    >>> (one,) = strength_doubt(law, 1.1)
    >>> one.code, round(one.values["strength"]), round(one.values["margin"], 3), strength_doubt(law, 1.3)
    ('strength-decides', 12000000, 0.88, ())
    """
    low, high = strength_interval(margin)
    if level_of(low, high) != "yellow":
        return ()
    above, strength = margin >= 1.0, discharge.dielectric_strength
    end, way = (low, "lower") if above else (high, "higher")
    values = {"change": STRENGTH_UNKNOWN, "way": way, "margin": end}
    if strength is None:
        return (Statement.of("strength-law-decides", **values),)
    return (Statement.of("strength-decides", strength=strength * end / margin, **values),)


def doubts_of(warnings: Iterable[ResultWarning]) -> list[Statement]:
    """Statements of warnings for which the margin may be lower than computed, each once."""
    codes = {warning.code for warning in warnings}
    return [Statement.of("warning", code=code) for code in DOUBTS if code in codes]


def no_verdict(answer: Statement, *, code: str = "none") -> Verdict:
    """Verdict that states why there is none."""
    return Verdict("grey", code, answer)


def unusable(warnings: Iterable[ResultWarning]) -> Verdict | None:
    """Verdict that says why the numbers must not be used; None where they may be used."""
    severe = [warning.code for warning in warnings if warning.severity == "severe"]
    return no_verdict(Statement.of("not-to-be-used", code=severe[0])) if severe else None


def contact_verdict(
    discharge: Discharge,
    breakdown: Breakdown,
    voltage: float,
    *,
    warnings: Iterable[ResultWarning],
    error: float | None,
    flooded: bool,
    isothermal: bool = True,
    field_error: float | None = None,
    default_voltage: bool = False,
) -> Verdict:
    """Verdict on a solved contact, which states that a ``default_voltage`` was not given.

    ``error`` and ``field_error`` are the estimated relative errors of the film and of the largest field
    strength, None where they are not known. The verdict is grey without a dielectric strength, or where the
    film must not be used.
    """
    warnings = tuple(warnings)
    refused = unusable(warnings)
    if refused is not None:
        return refused
    margin, at = breakdown.margin, breakdown.breakdown_voltage
    if margin is None or at is None:
        return no_verdict(Statement.of("no-strength-contact", voltage=voltage))
    of_film, of_field = error or 0.0, field_error or 0.0
    off = of_film + of_field
    low, doubts = margin * (1.0 - off), doubts_of(warnings)
    lowest, highest = breakdown.breakdown_voltage_low, breakdown.breakdown_voltage_high
    spread: dict[str, Statement | None] = {"weibull": None, "margins": None}
    if lowest is not None and highest is not None:
        low *= lowest / at
        spread = {
            "weibull": Statement.of("weibull-voltages", low=lowest, high=highest),
            "margins": Statement.of("weibull-margins", low=margin * lowest / at, high=margin * highest / at),
        }
    weakest, strongest = strength_interval(margin)
    interval = min(low, weakest), max(margin * (1.0 + off), strongest)
    level = level_of(*interval)
    level, code = doubted(level, code_of(level, likely=margin < 1.0), doubts=bool(doubts))
    doubts += strength_doubt(discharge, margin)
    if level == "yellow" and off > 0.0 and abs(margin - 1.0) <= off:
        name, part = max((("film", of_film), ("field", of_field)), key=lambda pair: pair[1])
        doubts.insert(0, Statement.of(f"{name}-off-on-grid", part=part))
    return Verdict(
        level,
        code,
        Statement.of("contact-voltages", voltage=voltage, breakdown=at, margin=margin, **spread),
        facts=(Fact("discharge.breakdown_voltage", at), Fact("discharge.margin", margin, interval)),
        reasons=tuple(doubts),
        assumptions=(
            *ideal_films(flooded=flooded, isothermal=isothermal),
            strength_clause(discharge),
            *((Statement.of("default-voltage", voltage=voltage),) if default_voltage else ()),
        ),
        bound="upper" if flooded else "",
    )


def ideal_films(*, flooded: bool, isothermal: bool = True) -> tuple[Statement, ...]:
    """Clause on films without starvation and, where they are isothermal, heat; none for starved films."""
    if not flooded:
        return ()
    return (Statement.of("films", words=(*(["isothermal"] if isothermal else []), "fully flooded")),)


def weibull_part(shape: float, probability: float) -> float:
    """Voltage of a Weibull law at a probability divided by the voltage at 63.2 %, dimensionless.

    Examples
    --------
    >>> round(weibull_part(10.0, 0.05), 3)
    0.743
    """
    return math.pow(-math.log1p(-probability), 1.0 / shape)


def breakdown_warning_condition(
    kind: str,
    voltage: Numbers | None,
    at: Callable[[], str],
    margin: Numbers | None,
    *,
    field: Numbers | None = None,
) -> WarningCondition:
    """Warning of a margin below 1. ``voltage`` [V]; ``margin``, dimensionless, shape (...), or None;
    ``field``, maximum field strength at this voltage [V/m], which exceeds the dielectric strength.
    """
    below = False if margin is None else margin < 1.0

    def ratio() -> str:
        return ratio_text(margin)

    if field is None:
        return WarningCondition.of(
            below, "breakdown-expected", "voltage", kind=kind, voltage=voltage, breakdown=at, margin=ratio
        )
    return WarningCondition.of(
        below,
        "breakdown-expected",
        "field",
        kind=kind,
        voltage=voltage,
        breakdown=at,
        margin=ratio,
        field=field / 1e6,
    )
