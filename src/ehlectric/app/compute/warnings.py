"""Warnings of results as the pages tell them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ehlectric.app.answers.told import PLACES, SEVERITIES, Told
from ehlectric.errors import CODES, ResultWarning


def told_of(
    warnings: Iterable[ResultWarning], places: Mapping[str, tuple[str, ...]] = PLACES
) -> tuple[Told, ...]:
    """Warnings of a result with the numbers that they concern by ``places``, the severe ones first."""
    found = [
        Told(one.code, one.severity, one.text, places[one.code], CODES[one.code].meaning)
        for one in dict.fromkeys(warnings)
    ]
    return tuple(sorted(found, key=lambda told: SEVERITIES.index(told.severity)))
