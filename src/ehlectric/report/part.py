"""Content of a report that depends on the kind of its result."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from textwrap import shorten
from typing import Any

from ehlectric.bearing.result import BearingResult
from ehlectric.discharge.verdict import Verdict
from ehlectric.errors import ResultWarning, printable
from ehlectric.report.content import Block, Section
from ehlectric.report.limits import Limit, Reference

UNSOLVED = "NOT CONVERGED: this result is no solution. Do not use its numbers and figures."
NO_VERDICT = "This result has no verdict: it has no breakdown voltage, or no voltage to compare it with."


@dataclass(frozen=True, kw_only=True)
class Part:
    """Content of a report that depends on the kind of the result.

    Attributes
    ----------
    kind : str
        What the result is, in a few words.
    command : str
        Command that solves the input file.
    lead : str
        Main numbers in a sentence.
    failure : str
        What is not solved; empty where all is.
    verdict : Verdict or None
        Answer of the result; None where it has none.
    no_verdict : str
        Why it has none.
    warnings : tuple of ResultWarning
        Warnings of the result.
    before : tuple of Section
        Sections before the key numbers.
    numbers : tuple
        Tables of key numbers.
    pictures : tuple
        Figures.
    further : tuple of Section
        Sections after the figures.
    limits : tuple of Limit
        What the models leave out.
    references : tuple of Reference
        Publications behind the equations.
    details : dict
        What is known of the computation, by name.
    toml : str
        Input file.
    varied : tuple of str
        Dotted keys that a sweep varies.
    """

    kind: str
    command: str
    lead: str
    failure: str
    verdict: Verdict | None
    no_verdict: str = NO_VERDICT
    warnings: tuple[ResultWarning, ...]
    before: tuple[Section, ...] = ()
    numbers: tuple[Block, ...]
    pictures: tuple[Block, ...]
    further: tuple[Section, ...] = ()
    limits: tuple[Limit, ...]
    references: tuple[Reference, ...]
    details: dict[str, str]
    toml: str
    varied: tuple[str, ...] = ()


def details_of(summary: Mapping[str, Any], date: str) -> dict[str, str]:
    """Version, date and state of a computation, by name.

    Parameters
    ----------
    summary : mapping
        Summary of a result.
    date : str
        Date of the result; empty where it is not known.
    """
    return {
        "result computed by": f"ehlectric {summary['version']}",
        "date of the result": date,
        "converged": "yes" if summary["converged"] else "no",
        "computing time": _seconds(summary.get("seconds")),
    }


def _seconds(seconds: float | Mapping[str, float] | None) -> str:
    """Time as text; that of a contact is the sum of its parts."""
    if seconds is None:
        return ""
    total = sum(seconds.values()) if isinstance(seconds, Mapping) else seconds
    return f"{total:.3g} s"


def lead_of(result: Any) -> str:
    """Main numbers of a result: its representation without the name of its class, title and verdict.

    Parameters
    ----------
    result : object
        Result of a contact, of moving roughness, of a bearing, or of a sweep.
    """
    line = repr(result)[1:-1].partition(" ")[2]
    title = shorten(getattr(result, "title", "") or result.case.title, 60)
    line = re.sub(r", verdict \w+$", "", line.removeprefix(f"{title!r}: "))
    if isinstance(result, BearingResult) and result.case.bearing.base:
        # The name of a bearing keeps its letters.
        line = f"Bearing {line}"
    return printable(f"{line[:1].upper()}{line[1:]}.").replace("≤ ", "≤\xa0").replace("≥ ", "≥\xa0")
