"""Warnings about the points of a sweep."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ehlectric.errors import ResultWarning
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.sensitivity import Sensitivity
from ehlectric.version import __version__

# Half-width of a confidence interval above which a sensitivity index says little.
_WIDE = 0.1


def sweep_warnings(results: SweepResults) -> Iterator[ResultWarning]:
    """Warnings about solved points that have warnings of their own, and about points of other versions."""
    solved = [point for point in results.points if point.solved]
    warned, doubtful = sum(bool(point.warnings) for point in solved), sum(results.doubtful)
    where = "which the column warnings of sweep.csv has"
    if warned:
        text = f"{warned} of {len(solved)} solved points have warnings, {where}"
        yield ResultWarning("points-with-warnings", text)
    if doubtful:
        points = f"{doubtful} of {len(solved)} solved points have a film that is not to be used"
        text = f"{points}, as their warnings say: maps and lines leave them out"
        yield ResultWarning("points-not-usable", text)
    others = Counter(point.version for point in results.points if point.version not in ("", __version__))
    for version, count in others.items():
        kept = f"{count} points were solved by version {version} and are kept"
        text = f"{kept}; in a new folder {__version__} solves them"
        yield ResultWarning("points-of-another-version", text)


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
