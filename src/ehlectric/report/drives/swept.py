"""Parts of a report about a sweep of drives: results that it shows, and points that discharge."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from ehlectric.cases.drives.case import ENDS, DriveCase
from ehlectric.discharge.verdict import Level, Verdict
from ehlectric.drive.verdict import drive_verdict
from ehlectric.quantities.formats import number_text
from ehlectric.quantities.inputs import end_and_key
from ehlectric.sweep.results import SweepResults

# Results of both bearings, and of one of them, that a report draws and lists.
_BOTH = ("drive.events_per_second", "drive.power")
_EACH = ("energy_mean", "peak_voltage")

# Columns of the table of points, for each bearing: with its bounds where both bearings are the same.
_RATE = "events_per_second"
_LISTED = (_RATE, "energy_mean", "peak_voltage")
_LISTED_OF_ONE = (_RATE, f"{_RATE}_low", f"{_RATE}_high", *_EACH, "breakdown_voltage")

_RULE = (
    "Points are judged as a single drive is: discharges are expected where a bearing discharges at least "
    "twenty times in the simulated time, and none where no bearing discharges, also with a strength that is "
    "20 % lower."
)
_WORDS: Mapping[Level, str] = {"yellow": "not certain", "green": "not expected"}
_LEADS = {
    "green": "No discharge at any point",
    "yellow": "Discharges at some points",
    "red": "Discharges at all points",
}


def swept_values(results: SweepResults) -> tuple[str, ...]:
    """Keys of the summary that a report of a sweep shows: of one end where both bearings are the same.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep of a drive.
    """
    return (*_BOTH, *(f"{end}.{key}" for key in _EACH for end in _ends(results)))


def listed_values(results: SweepResults) -> tuple[str, ...]:
    """Keys of the summary that the table of the points has: of equal bearings with the bounds of the rate.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep of a drive.
    """
    ends = _ends(results)
    keys = _LISTED_OF_ONE if len(ends) == 1 else _LISTED
    return ("drive.events_per_second", *(f"{end}.{key}" for end in ends for key in keys))


def _ends(results: SweepResults) -> tuple[str, ...]:
    """Ends whose numbers are shown: one where both bearings are the same at all points."""
    assert isinstance(results.case, DriveCase)
    first, second = results.case.bearings
    alike = first == second and not any(end_and_key(key)[0] in ENDS for key in results.varied)
    return ENDS[:1] if alike else ENDS


def swept_verdict(results: SweepResults) -> Verdict | None:
    """Verdict on a sweep of a drive from those of its points; None without a solved point.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep of a drive.

    Returns
    -------
    Verdict or None
        Green where no point is expected to discharge, red where all are, else yellow. Points that are not
        solved, or must not be used, leave neither green nor red.
    """
    assert isinstance(results.case, DriveCase)
    counts = Counter(
        drive_verdict(results.case, point.summary, point.warnings).level
        for point in results.points
        if point.solved and point.summary
    )
    known = sum(counts[level] for level in ("green", "yellow", "red"))
    if not known:
        return None
    missing = len(results.points) - known
    level: Level = "yellow"
    if not missing and max(counts["green"], counts["red"]) == known:
        level = "green" if counts["green"] else "red"
    lead = _LEADS[level]
    if level == "yellow" and not counts["red"]:
        lead = "Discharges possible"
    told = [f"expected at {counts['red']} of {known} points"]
    told += [f"{words} at {counts[one]}" for one, words in _WORDS.items() if counts[one]]
    sentences = [f"{lead}: {', '.join(told)}.", *_range(results), _RULE]
    if missing:
        more = "1 more point is" if missing == 1 else f"{missing} more points are"
        sentences.insert(1, f"{more} not solved, or must not be used.")
    return Verdict(level, " ".join(sentences))


def _range(results: SweepResults) -> list[str]:
    """Sentence with the smallest and the largest rate of discharges."""
    rates = [
        float(point.summary["drive"]["events_per_second"])
        for point in results.points
        if point.solved and not point.doubtful and point.summary
    ]
    if not rates:
        return []
    low, high = number_text(min(rates)), number_text(max(rates))
    return [f"Both bearings together discharge {low} to {high} times a second."]
