"""Warnings about the points of a sweep."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from ehlectric.quantities.result_warnings import CODES, ResultWarning
from ehlectric.quantities.rows import value_at
from ehlectric.runtime.display import is_number
from ehlectric.sweep.points import Point
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.sensitivity_indices import Sensitivity
from ehlectric.version import __version__

# Half-width of a confidence interval above which a sensitivity index says little.
_WIDE = 0.1


# Difference of two inlets in semi-axes up to which two domains are one: rounding.
_SAME_INLET = 1e-6


def sweep_warnings(results: SweepResults) -> Iterator[ResultWarning]:
    """Kinds of warnings and notes that solved points have, and warnings about points of other versions."""
    solved = [point for point in results.points if point.solved]
    doubtful = sum(results.doubtful)
    yield from _kinds(solved)
    if doubtful:
        yield ResultWarning.of("points-not-usable", doubtful=doubtful, solved=len(solved))
    inlets = [
        inlet
        for point in solved
        if is_number(inlet := value_at(point.summary or {}, "inputs.grid.inlet"))
        and value_at(point.summary or {}, "discharge.capacitance") is not None
    ]
    if inlets and "grid.inlet" not in results.varied and max(inlets) - min(inlets) > _SAME_INLET:
        yield ResultWarning.of("domains-differ", nearest=max(inlets), farthest=min(inlets))
    others = Counter(point.version for point in results.points if point.version not in ("", __version__))
    for version, count in others.items():
        yield ResultWarning.of("points-of-another-version", count=count, version=version, current=__version__)


def _kinds(solved: Sequence[Point]) -> Iterator[ResultWarning]:
    """One warning or note for each kind that solved points have, with their number; notes come last."""
    counts = Counter(code for point in solved for code in {warning.code for warning in point.warnings})
    for kind, count in sorted(counts.items(), key=lambda pair: (CODES[pair[0]].severity == "note", -pair[1])):
        cause = CODES[kind]
        code = "points-with-notes" if cause.severity == "note" else "points-with-warnings"
        meaning = cause.meaning[0].lower() + cause.meaning[1:].rstrip(".")
        yield ResultWarning.of(code, count=count, solved=len(solved), kind=kind, meaning=meaning)


def sensitivity_warnings(sensitivity: Sensitivity) -> Iterator[ResultWarning]:
    """Warnings about rows that sensitivity indices skip, and about wide confidence intervals."""
    if sensitivity.dropped:
        yield ResultWarning.of("rows-dropped", dropped=sensitivity.dropped, rows=sensitivity.rows)
    if sensitivity.doubtful:
        yield ResultWarning.of("rows-not-usable", doubtful=sensitivity.doubtful, used=sensitivity.used)
    ends = [end for i in sensitivity.indices for end in (i.first_order_interval, i.total_interval)]
    widest = max(0.5 * (high - low) for low, high in ends)
    if widest > _WIDE:
        yield ResultWarning.of("intervals-wide", widest=widest)
