"""Verdicts on drives, taken apart for their page."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ehlectric.app.answers.bearing import Judged
from ehlectric.discharge.verdict import Verdict
from ehlectric.report.light import light_of

# What a verdict before a simulation means, and one after it.
_BEFORE: Mapping[str, str] = {
    "green": "The voltage by the divider stays below what breaks the films down.",
    "yellow": "The voltage is near the breakdown voltage, within what is uncertain.",
    "red": "The voltage is above the breakdown voltage: the films break down at edges of the source.",
    "grey": "The divider alone cannot say whether this drive discharges.",
}
_AFTER: Mapping[str, str] = {
    "green": "No film broke down, and none is expected to.",
    "yellow": "Discharges can mark the raceways and age the oil; they are not sure here.",
    "red": "Discharges can mark the raceways and age the oil. Compare remedies.",
    "grey": "These numbers must not be used.",
}
_NOT_SIMULATED = "How often, and with which energy, the simulation says."

# End of a sentence; numbers such as 1.44 have no space behind their point.
_END = re.compile(r"(?<=[.!?]) (?=[A-Z])")

# Beginnings of sentences on what is assumed.
_ASSUMED = ("Upper bound", "Dielectric strength", "The table of dielectric", "The Weibull law of")


def judged_before(verdict: Verdict) -> Judged:
    """Verdict on a drive that is not simulated.

    Examples
    --------
    >>> parts = judged_before(Verdict("red", "Discharges expected: 12.9 V, above 4.63 V. More follows."))
    >>> parts.lead, parts.numbers, parts.reasons
    ('Discharges expected', '12.9 V, above 4.63 V.', ('More follows.',))
    """
    first, *others = _END.split(verdict.text)
    return _judged(verdict, _BEFORE, first, others, _NOT_SIMULATED)


def judged_after(verdict: Verdict) -> Judged:
    """Verdict on a simulated drive, which is that of its report."""
    first, *others = _END.split(verdict.text)
    assumed = [text for text in others if text.startswith(_ASSUMED)]
    reasons = [text for text in others if text not in assumed]
    return _judged(verdict, _AFTER, first, reasons, " ".join(assumed))


def _judged(
    verdict: Verdict, meaning: Mapping[str, str], first: str, reasons: list[str], assumptions: str
) -> Judged:
    lead, _, rest = first.partition(": ")
    light = light_of(verdict.level, verdict.text)
    return Judged(
        level=verdict.level,
        lead=lead.rstrip("."),
        meaning=meaning[verdict.level],
        numbers=rest[:1].upper() + rest[1:],
        reasons=tuple(reasons),
        assumptions=assumptions,
        bound=light.bound,
    )
