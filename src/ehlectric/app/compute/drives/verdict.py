"""Verdicts on drives, taken apart for their page."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ehlectric.app.answers.bearing import Judged
from ehlectric.cases.drives.case import ENDS
from ehlectric.cases.row import amount
from ehlectric.discharge.verdict import Verdict
from ehlectric.drive.keys import NAMES_OF_ENDS

_MEANING = {
    "green": "Below the breakdown voltage no film breaks down, and the shaft voltage does no harm.",
    "yellow": "The voltage is near the breakdown voltage, within what is uncertain. Discharges can mark the "
    "raceways.",
    "red": "The voltage is above the breakdown voltage: the films break down, and discharges can mark the "
    "raceways.",
    "grey": "The divider alone cannot say whether this drive discharges.",
}
_NOT_SIMULATED = "How often, and with which energy, the simulation says."

_DISCHARGES = "Discharges can mark the raceways, and age the oil. Compare them with remedies."
_NO_DISCHARGE = "No film broke down in the simulated time; a longer time gives a lower bound of the rate."
_BURNING = "An arc burns on: the source feeds it, so that few discharges are counted."

# End of a sentence; numbers such as 1.44 have no space behind their point.
_END = re.compile(r"(?<=[.!?]) (?=[A-Z])")

# Share of time with a burning arc from which it is told.
_MOSTLY = 0.2


def judged_before(verdict: Verdict) -> Judged:
    """Verdict on a drive that is not simulated.

    Examples
    --------
    >>> parts = judged_before(Verdict("red", "Discharges expected: 12.9 V, above 4.63 V. More follows."))
    >>> parts.lead, parts.numbers, parts.reasons
    ('Discharges expected', '12.9 V, above 4.63 V.', ('More follows.',))
    """
    first, *others = _END.split(verdict.text)
    lead, _, rest = first.partition(": ")
    return Judged(
        level=verdict.level,
        lead=lead.rstrip("."),
        meaning=_MEANING[verdict.level],
        numbers=rest[:1].upper() + rest[1:],
        reasons=tuple(others),
        assumptions=_NOT_SIMULATED,
    )


def judged_after(summary: Mapping[str, Any]) -> Judged:
    """Verdict on a simulated drive, from its summary."""
    names = [name for end, name in NAMES_OF_ENDS.items() if summary[end]["events"]]
    burning = max(summary[end]["burning_time_share"] for end in ENDS) > _MOSTLY
    duration = amount(summary["drive"]["duration"], "s")
    if not summary["converged"]:
        return Judged(
            "grey", "No verdict", "A contact is not converged: do not use these numbers.", "", (), ""
        )
    if names:
        where = "both bearings" if len(names) > 1 else f"the {names[0]} bearing"
        level, lead, meaning = "red", f"Discharges in {where}", _DISCHARGES
    elif burning:
        level, lead, meaning = "red", "An arc burns on", _BURNING
    else:
        level, lead, meaning = "green", f"No discharge in {duration}", _NO_DISCHARGE
    told = summary["verdict"]
    reasons = (_BURNING,) if burning and names else ()
    return Judged(level, lead, meaning, f"{told[:1].upper()}{told[1:]}", reasons, "")
