"""Verdict on a bearing, taken apart for its page, and held back while its range is unknown."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ehlectric.app.answers.bearing import Judged
from ehlectric.bearing.margin.analysis import MarginAnalysis
from ehlectric.bearing.margin.verdict import bearing_verdict
from ehlectric.bearing.solution import BearingSolution
from ehlectric.discharge.verdict import Verdict
from ehlectric.report.light import light_of

# What a level means for a bearing, in plain words.
_MEANING: Mapping[str, str] = {
    "green": "Within what is assumed, the oil films withstand the shaft voltage.",
    "yellow": "Within what is uncertain, the oil films may or may not withstand the shaft voltage.",
    "red": "The oil films do not withstand the shaft voltage: the bearing sparks, and discharges mark its "
    "raceways.",
    "grey": "This page cannot say whether the bearing sparks.",
}
_TOUCHING = (
    "The surfaces touch at times, and current passes as they part: the bearing may spark at any voltage."
)

# End of a sentence; numbers such as 1.44 have no space behind their point.
_END = re.compile(r"(?<=[.!?]) (?=[A-Z])")

_OPEN_RANGE = "The range of the margin could not be computed from the stated ranges of inputs."
_FOLLOWS = "Margin by formula; its range follows."


def judged(verdict: Verdict) -> Judged:
    """Verdict taken apart.

    Examples
    --------
    >>> parts = judged(Verdict("green", "No breakdown expected: margin 1.4. Upper bound: smooth film."))
    >>> parts.lead, parts.bound
    ('No breakdown expected, as an upper bound', '≤')
    >>> parts.numbers, parts.assumptions
    ('Margin 1.4.', 'Upper bound: smooth film.')
    """
    first, *others = _END.split(verdict.text)
    lead, _, rest = first.partition(": ")
    assumptions = [text for text in others if text.startswith("Upper bound")]
    light = light_of(verdict.level, verdict.text)
    touches = lead == "Discharges likely"
    return Judged(
        level=verdict.level,
        lead=light.words,
        bound=light.bound,
        meaning=_TOUCHING if touches else _MEANING[verdict.level],
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
    text = verdict.text.replace(_OPEN_RANGE, _FOLLOWS)
    if _FOLLOWS not in text:
        text = f"{text} {_FOLLOWS}"
    return Verdict(verdict.level, text, verdict.margin)
