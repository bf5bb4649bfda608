"""Verdict on a bearing, taken apart for its page, and held back while its range is unknown."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ehlectric.app.answers.bearing import FOLLOWS, Judged
from ehlectric.bearing.margin.analysis import MarginAnalysis
from ehlectric.bearing.margin.verdict import bearing_verdict
from ehlectric.bearing.solution import BearingSolution
from ehlectric.discharge.verdict import Verdict
from ehlectric.report.light import light_of

# What the first words of a verdict mean for a bearing, in plain words: "expected" for red, "likely" and
# "possible" for yellow.
_MEANING: Mapping[str, str] = {
    "No breakdown expected": "The ideal film holds; a real film may be thinner and break down earlier.",
    "Breakdown possible": "The ideal film holds, but not beyond doubt. A real film may be thinner and break "
    "down earlier.",
    "Breakdown likely": "The ideal film breaks down, but by less than what is uncertain. Discharges are "
    "likely, and can mark the raceways.",
    "Breakdown expected": "Within what is assumed, discharges are expected, and can mark the raceways.",
    "Discharges likely": "The surfaces touch, and current passes as they part: discharges are likely at any "
    "voltage, and can mark the raceways.",
}
_NO_VERDICT = "This page cannot say whether the bearing sparks."

# End of a sentence; numbers such as 1.44 have no space behind their point.
_END = re.compile(r"(?<=[.!?]) (?=[A-Z])")

_OPEN_RANGE = "The range of the margin could not be computed from the stated ranges of inputs."


def judged(verdict: Verdict) -> Judged:
    """Verdict taken apart.

    Examples
    --------
    >>> parts = judged(Verdict("green", "No breakdown expected: margin 1.4. Upper bound: smooth film."))
    >>> parts.lead, parts.bound
    ('No breakdown expected in an ideal film', 'upper bound')
    >>> parts.numbers, parts.assumptions
    ('Margin 1.4.', 'Upper bound: smooth film.')
    """
    first, *others = _END.split(verdict.text)
    lead, _, rest = first.partition(": ")
    assumptions = [text for text in others if text.startswith("Upper bound")]
    light = light_of(verdict.level, verdict.text)
    return Judged(
        level=verdict.level,
        lead=light.words,
        bound=light.bound,
        meaning=_MEANING.get(lead, _NO_VERDICT),
        numbers=rest[:1].upper() + rest[1:],
        reasons=tuple(text for text in others if text not in assumptions),
        assumptions=" ".join(assumptions),
    )


def quick_verdict(solution: BearingSolution) -> Verdict:
    """Verdict without the analysis of the margin, which says that the range of the margin follows.

    It is not green then: the verdict without an analysis counts an unknown range as a doubt.
    """
    verdict = bearing_verdict(solution, MarginAnalysis())
    if verdict.margin is None or not solution.case.ranges:
        return verdict
    text = verdict.text.replace(_OPEN_RANGE, FOLLOWS)
    if FOLLOWS not in text:
        text = f"{text} {FOLLOWS}"
    return Verdict(verdict.level, text, verdict.margin)
