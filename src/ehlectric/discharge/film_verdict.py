"""Verdict on a film: whether breakdown is expected, in sentences and as a colour."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

from ehlectric.arrays import Numbers
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.film_breakdown import Breakdown
from ehlectric.errors import CODES, Flag, ResultWarning
from ehlectric.quantities.quantity import data_file

# "green": no breakdown expected; "yellow": breakdown possible within what is uncertain; "red": breakdown
# expected, or surfaces that touch under a voltage; "grey": nothing to compare the breakdown voltage with.
Level = Literal["green", "yellow", "red", "grey"]


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


# Probabilities of breakdown below which it is not expected, below which it is possible, and above which it is
# expected; between the last two it is likely. The first one also is that at which a voltage of a Weibull law
# counts as safe.
UNLIKELY, EVEN, CERTAIN = 0.05, 0.5, 0.95

# Part of a dielectric strength by which it may be wrong either way where no range of it is stated:
# engineering judgement.
STRENGTH_UNKNOWN = 0.2

# Codes of warnings of results whose margin may be lower than computed: no verdict is green with one of them.
DOUBTS: tuple[str, ...] = tuple(data_file("ehlectric.quantities", "warning_codes.toml")["doubts"])


def level_of(low: float, high: float) -> Level:
    """Level of a verdict from the smallest and the largest margin that are possible.

    Examples
    --------
    >>> level_of(1.1, 1.5), level_of(0.8, 1.5), level_of(0.5, 0.8)
    ('green', 'yellow', 'red')
    """
    return "green" if low >= 1.0 else "red" if high < 1.0 else "yellow"


def lead_of(level: Level, *, likely: bool) -> str:
    """First words of a verdict with this level; ``likely``, whether breakdown is likelier than none."""
    if level == "yellow":
        return "Breakdown likely" if likely else "Breakdown possible"
    return "No breakdown expected" if level == "green" else "Breakdown expected"


# Sentence in place of the probability where only an estimate of it at once is known.
PROBABILITY_FOLLOWS = "The probability of breakdown follows."


@dataclass(frozen=True)
class Chance:
    """Probability of breakdown within what is uncertain, and what makes it so."""

    probability: float
    error: float  # sampling error of the probability
    # low, median and high: margin at 5 %, 50 % and 95 %, dimensionless; 0 where surfaces touch.
    low: float
    median: float
    high: float
    # Name of the input that spreads the margin most, and its share of the variance of the logarithm of the
    # margin; empty for an estimate at once, which leaves out what changes the films.
    first: str = ""
    share: float = 0.0

    @property
    def level(self) -> Level:
        """Level of a verdict by the probability."""
        if self.probability < UNLIKELY:
            return "green"
        return "yellow" if self.probability <= CERTAIN else "red"

    @property
    def lead(self) -> str:
        """First words of a verdict by the probability."""
        return lead_of(self.level, likely=self.probability > EVEN)

    @property
    def sentence(self) -> str:
        """Sentence about the probability, the interval of the margin, and the input to measure first.

        Examples
        --------
        >>> Chance(0.163, 0.016, 0.783, 1.474, 3.0, "rotor capacitance", 0.567).sentence
        'The probability of breakdown is 16 % (sampling error 1.6 %): within what is uncertain the margin is \
0.78 to 3.00 in 90 of 100 cases, 1.47 in the middle. Measure first: rotor capacitance, 57 % of the spread.'
        """
        if not self.first:
            return PROBABILITY_FOLLOWS
        low, median, high = map(ratio_text, (self.low, self.median, self.high))
        return (
            f"The probability of breakdown is {chance_text(self.probability, self.error)}: within what is "
            f"uncertain the margin is {low} to {high} in 90 of 100 cases, {median} in the middle. "
            f"Measure first: {self.first}, {100.0 * self.share:.0f} % of the spread."
        )


def chance_text(probability: float, error: float) -> str:
    """Probability with its sampling error as text.

    Examples
    --------
    >>> chance_text(0.163, 0.016), chance_text(0.0, 0.0009), chance_text(1.0, 0.0009)
    ('16 % (sampling error 1.6 %)', 'below 0.09 %', 'above 99.9 %')
    """
    if probability < error:
        return f"below {100.0 * (probability + error):.1g} %"
    if 1.0 - probability < error:
        return f"above {100.0 * (probability - error):.3g} %"
    return f"{100.0 * probability:.2g} % (sampling error {100.0 * error:.2g} %)"


def ratio_text(ratio: Numbers) -> str:
    """Ratio as text with two digits behind the point; more where it would be rounded to 1.

    Examples
    --------
    >>> ratio_text(1.4432), ratio_text(0.9981), ratio_text(0.0123), ratio_text(2345.6)
    ('1.44', '0.9981', '0.012', '2.3e+03')
    """
    if not 0.1 <= ratio < 100.0:
        return f"{ratio:.2g}"
    text = f"{ratio:.2f}"
    return f"{ratio:.4g}" if text == "1.00" else text


def assumption_of(discharge: Discharge, stated: tuple[float, float] | None = None) -> str:
    """Clause on the dielectric strength that is assumed; ``stated`` is the range of a constant one [V/m]."""
    strength, table = discharge.dielectric_strength, discharge.strength_table
    if strength is not None:
        between = "" if stated is None else f" ({stated[0] / 1e6:.3g} to {stated[1] / 1e6:.3g} V/µm)"
        return f"dielectric strength {strength / 1e6:.3g} V/µm{between} is an assumption"
    if table is not None:
        return f"the table of dielectric strength over {table.over} is an assumption"
    return "the Weibull law of the dielectric strength is an assumption"


def strength_interval(margin: float) -> tuple[float, float]:
    """Margins at the smallest and the largest strength that is possible where no range of it is stated.

    Every breakdown voltage is proportional to the strength.
    """
    return (1.0 - STRENGTH_UNKNOWN) * margin, (1.0 + STRENGTH_UNKNOWN) * margin


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
        at = f"strength of {strength * end / margin / 1e6:.3g} V/µm ({change})"
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
            f"The applied voltage is {voltage:.3g} V.",
        )
    of_film, of_field = error or 0.0, field_error or 0.0
    off = of_film + of_field
    low, doubts = margin * (1.0 - off), doubts_of(warnings)
    span, spread = "", ""
    lowest, highest = breakdown.breakdown_voltage_low, breakdown.breakdown_voltage_high
    if lowest is not None and highest is not None:
        low *= lowest / at
        span = f" at a probability of 63.2 %, {lowest:.3g} to {highest:.3g} V from 5 to 95 %"
        spread = f", {ratio_text(margin * lowest / at)} to {ratio_text(margin * highest / at)}"
    weakest, strongest = strength_interval(margin)
    interval = min(low, weakest), max(margin * (1.0 + off), strongest)
    level = level_of(*interval)
    doubts += filter(None, [strength_doubt(discharge, margin)])
    if doubts and level == "green":
        level = "yellow"
    if level == "yellow" and off > 0.0 and abs(margin - 1.0) <= off:
        part, name = (of_film, "film") if of_film >= of_field else (of_field, "maximum field")
        doubts.insert(0, f"The {name} may be {100.0 * part:.2g} % off on this grid.")
    bound = f"Upper bound: {'isothermal, ' if isothermal else ''}fully flooded film; " if flooded else ""
    last = f"{bound}{assumption_of(discharge)}."
    lead = lead_of(level, likely=margin < 1.0)
    text = (
        f"{lead}: applied voltage {voltage:.3g} V, breakdown voltage {at:.3g} V{span} "
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
