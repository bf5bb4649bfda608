"""Warnings of results as the pages tell them."""

from __future__ import annotations

from collections.abc import Iterable

from ehlectric.app.answers.told import SEVERITIES, Told
from ehlectric.errors import CODES, ResultWarning

_LIKELY = "The margin is below 1: breakdown is likely."


def told_of(warnings: Iterable[ResultWarning], level: str = "") -> tuple[Told, ...]:
    """Warnings of a result with the keys of the quantities that they concern, the severe ones first.

    Beside a verdict of the level "yellow", a margin below 1 means that breakdown is likely, as the verdict
    says.
    """
    meanings = {"breakdown-expected": _LIKELY} if level == "yellow" else {}
    found = [
        Told(
            one.code,
            one.severity,
            one.text,
            CODES[one.code].concerns,
            meanings.get(one.code, CODES[one.code].meaning),
        )
        for one in dict.fromkeys(warnings)
    ]
    return tuple(sorted(found, key=lambda told: SEVERITIES.index(told.severity)))
