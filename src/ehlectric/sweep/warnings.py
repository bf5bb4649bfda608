"""Warnings about the points of a sweep."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from ehlectric.errors import CODES, ResultWarning
from ehlectric.sweep.points import Point
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.sensitivity import Sensitivity
from ehlectric.version import __version__

# Half-width of a confidence interval above which a sensitivity index says little.
_WIDE = 0.1


def sweep_warnings(results: SweepResults) -> Iterator[ResultWarning]:
    """Kinds of warnings and notes that solved points have, and warnings about points of other versions."""
    solved = [point for point in results.points if point.solved]
    doubtful = sum(results.doubtful)
    yield from _kinds(solved)
    if doubtful:
        points = f"{doubtful} of {len(solved)} solved points have a film that is not to be used"
        text = f"{points}, as their warnings say: maps and lines leave them out"
        yield ResultWarning("points-not-usable", text)
    others = Counter(point.version for point in results.points if point.version not in ("", __version__))
    for version, count in others.items():
        kept = f"{count} points were solved by version {version} and are kept"
        text = f"{kept}; in a new folder {__version__} solves them"
        yield ResultWarning("points-of-another-version", text)


def _kinds(solved: Sequence[Point]) -> Iterator[ResultWarning]:
    """One warning or note for each kind that solved points have, with their number; notes come last."""
    counts = Counter(code for point in solved for code in {warning.code for warning in point.warnings})
    for code, count in sorted(counts.items(), key=lambda kind: (CODES[kind[0]].severity == "note", -kind[1])):
        meaning, have = CODES[code].meaning, f"{count} of {len(solved)} solved points have the"
        about = f"{code}: {meaning[0].lower()}{meaning[1:].rstrip('.')}"
        if CODES[code].severity == "note":
            yield ResultWarning("points-with-notes", f"{have} note {about}")
        else:
            yield ResultWarning("points-with-warnings", f"{have} warning {about}")


def sensitivity_warnings(sensitivity: Sensitivity) -> Iterator[ResultWarning]:
    """Warnings about rows that sensitivity indices leave out, and about wide confidence intervals."""
    if sensitivity.dropped:
        yield ResultWarning(
            "rows-dropped",
            f"{sensitivity.dropped} of {sensitivity.rows} rows have a point that is not solved and are left "
            "out: the numbers are those of the rest of the ranges",
        )
    if sensitivity.doubtful:
        yield ResultWarning(
            "rows-not-usable",
            f"{sensitivity.doubtful} of {sensitivity.used} rows that are used have a point whose film is not "
            "to be used, as its warnings in sweep.csv say: spread and indices count with them",
        )
    ends = [end for i in sensitivity.indices for end in (i.first_order_interval, i.total_interval)]
    widest = max(0.5 * (high - low) for low, high in ends)
    if widest > _WIDE:
        yield ResultWarning(
            "intervals-wide",
            f"confidence intervals reach up to {widest:.1g} either way; four times the samples halve that",
        )
