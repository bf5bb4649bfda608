"""Verdict on a film: whether breakdown is expected, in sentences and as a colour."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ehlectric.arrays import Numbers
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.breakdown_rule import (
    STRENGTH_UNKNOWN,
    Level,
    doubted,
    lead_of,
    level_of,
    ratio_text,
    strength_interval,
)
from ehlectric.discharge.film_breakdown import Breakdown
from ehlectric.errors import CODES, Flag, ResultWarning
from ehlectric.quantities.quantity import data_file
from ehlectric.readable import readable


@dataclass(frozen=True)
class Verdict:
    """Answer to the question whether a film breaks down.

    Attributes
    ----------
    level : str
        "green": no breakdown expected; "yellow": breakdown is possible within what is uncertain; "red":
        breakdown expected, or surfaces that touch under a voltage; "grey": there is no voltage or no
        strength to judge by.
    text : str
        The answer in whole sentences, with the numbers that decide and the assumptions behind them.
    margin : float or None
        Breakdown voltage / applied voltage, dimensionless; None where there is none.
    interval : tuple of float or None
        Smallest and largest margin that are possible, dimensionless; None where none is stated.

    Examples
    --------
    >>> Verdict("green", "No breakdown expected: margin 1.44.", 1.44).level
    'green'
    """

    level: Level
    text: str
    margin: float | None = None
    interval: tuple[float, float] | None = None

    @property
    def lead(self) -> str:
        """First words of the answer, as "Breakdown likely"."""
        return self.text.partition(":")[0]

    def __str__(self) -> str:
        return self.text


# Codes of warnings of results whose margin may be lower than computed: no verdict is green with one of them.
DOUBTS: tuple[str, ...] = tuple(data_file("ehlectric.quantities", "warning_codes.toml")["doubts"])


def seldom_measured(strength: str) -> str:
    """Clause on a given strength: why an answer does not become certain with it."""
    return f"{strength} is an input that is seldom measured for films"


def strength_clause(discharge: Discharge, stated: tuple[float, float] | None = None) -> str:
    """Clause on the dielectric strength of the case; ``stated`` is the range of a constant one [V/m]."""
    strength, table = discharge.dielectric_strength, discharge.strength_table
    if strength is not None:
        between = (
            "" if stated is None else f" ({readable(stated[0] / 1e6)} to {readable(stated[1] / 1e6)} V/µm)"
        )
        return seldom_measured(f"dielectric strength {readable(strength / 1e6)} V/µm{between}")
    if table is not None:
        return seldom_measured(f"the table of dielectric strength over {table.over}")
    return seldom_measured("the Weibull law of the dielectric strength")


def strength_doubt(discharge: Discharge, margin: float) -> str:
    """Sentence for a margin that a change of the strength takes across 1; empty where none does.

    Examples
    --------
    >>> law = Discharge.from_dict({"dielectric_strength": "15 V/um"})
    >>> strength_doubt(law, 1.1), strength_doubt(law, 1.3)
    ('At a strength of 12 V/µm (20 % lower) the margin is 0.88.', '')
    """
    low, high = strength_interval(margin)
    if level_of(low, high) != "yellow":
        return ""
    above, strength = margin >= 1.0, discharge.dielectric_strength
    end, way = (low, "lower") if above else (high, "higher")
    change = f"{100.0 * STRENGTH_UNKNOWN:.0f} % {way}"
    at = f"strength that is {change}"
    if strength is not None:
        at = f"strength of {readable(strength * end / margin / 1e6)} V/µm ({change})"
    return f"At a {at} the margin is {ratio_text(end)}."


def doubts_of(warnings: Iterable[ResultWarning]) -> list[str]:
    """Sentences of warnings for which the margin may be lower than computed, each once."""
    codes = {warning.code for warning in warnings}
    return [CODES[code].meaning for code in DOUBTS if code in codes]


def unusable(warnings: Iterable[ResultWarning]) -> str:
    """Sentence that says why the numbers must not be used; empty where they may be used."""
    severe = [warning.code for warning in warnings if warning.severity == "severe"]
    return "" if not severe else f"No verdict: the numbers must not be used. {CODES[severe[0]].meaning}"


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
) -> Verdict:
    """Verdict on a solved contact.

    ``error`` and ``field_error`` are the estimated relative errors of the film and of the largest field
    strength, None where they are not known. The verdict is grey without a dielectric strength, or where the
    film must not be used.
    """
    warnings = tuple(warnings)
    refused = unusable(warnings)
    if refused:
        return Verdict("grey", refused)
    margin, at = breakdown.margin, breakdown.breakdown_voltage
    if margin is None or at is None:
        return Verdict(
            "grey",
            "No verdict: no dielectric strength given, no breakdown voltage. "
            f"The applied voltage is {readable(voltage)} V.",
        )
    of_film, of_field = error or 0.0, field_error or 0.0
    off = of_film + of_field
    low, doubts = margin * (1.0 - off), doubts_of(warnings)
    span, spread = "", ""
    lowest, highest = breakdown.breakdown_voltage_low, breakdown.breakdown_voltage_high
    if lowest is not None and highest is not None:
        low *= lowest / at
        span = f" at a probability of 63.2 %, {readable(lowest)} to {readable(highest)} V from 5 to 95 %"
        spread = f", {ratio_text(margin * lowest / at)} to {ratio_text(margin * highest / at)}"
    weakest, strongest = strength_interval(margin)
    interval = min(low, weakest), max(margin * (1.0 + off), strongest)
    level = level_of(*interval)
    level, lead = doubted(level, lead_of(level, likely=margin < 1.0), doubts=bool(doubts))
    doubts += filter(None, [strength_doubt(discharge, margin)])
    if level == "yellow" and off > 0.0 and abs(margin - 1.0) <= off:
        part, name = (of_film, "film") if of_film >= of_field else (of_field, "maximum field")
        doubts.insert(0, f"The {name} may be {readable(100.0 * part, 2)} % off on this grid.")
    bound = f"Upper bound: {'isothermal, ' if isothermal else ''}fully flooded film; " if flooded else ""
    last = f"{bound}{strength_clause(discharge)}."
    text = (
        f"{lead}: applied voltage {readable(voltage)} V, breakdown voltage {readable(at)} V{span} "
        f"(margin {ratio_text(margin)}{spread})."
    )
    return Verdict(level, " ".join([text, *doubts, last[0].upper() + last[1:]]), margin, interval)


def weibull_part(shape: float, probability: float) -> float:
    """Voltage of a Weibull law at a probability divided by that at 63.2 %, dimensionless.

    Examples
    --------
    >>> round(weibull_part(10.0, 0.05), 3)
    0.743
    """
    return math.pow(-math.log1p(-probability), 1.0 / shape)


def breakdown_flag(
    kind: str,
    voltage: Numbers | None,
    at: Callable[[], str],
    margin: Numbers | None,
    *,
    field: Numbers | None = None,
) -> Flag:
    """Warning of a margin below 1. ``voltage`` [V]; ``margin``, dimensionless, shape (...), or None;
    ``field``, maximum field strength at this voltage [V/m], which exceeds the dielectric strength.
    """
    below = False if margin is None else margin < 1.0

    def ratio() -> str:
        return ratio_text(margin)

    if field is None:
        return Flag.of(
            below, "breakdown-expected", "voltage", kind=kind, voltage=voltage, breakdown=at, margin=ratio
        )
    return Flag.of(
        below,
        "breakdown-expected",
        "field",
        kind=kind,
        voltage=voltage,
        breakdown=at,
        margin=ratio,
        field=field / 1e6,
    )
