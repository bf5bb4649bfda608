"""What a report says of a sweep of drives: the results that it shows, and at which points they discharge."""

from __future__ import annotations

from collections import Counter

from ehlectric.cases.drives.case import ENDS, DriveCase
from ehlectric.cases.input_keys import end_and_key
from ehlectric.discharge.verdict import Level, Verdict
from ehlectric.drive.statistics import number_text
from ehlectric.drive.verdict import drive_verdict
from ehlectric.sweep.results import SweepResults

# Results of both bearings, and of one of them, that a report draws and lists.
_BOTH = ("drive.events_per_second", "drive.power")
_EACH = ("energy_mean", "peak_voltage", "breakdown_voltage")

_RULE = (
    "Points are judged as a single drive is: discharges are expected where a bearing discharges at least "
    "twenty times in the simulated time, and none where no bearing discharges, also with a strength that is "
    "20 % lower."
)
_LEADS = {
    "green": "No discharge expected at any point",
    "yellow": "Discharges at some points",
    "red": "Discharges expected at all points",
    "grey": "No verdict",
}


def swept_values(results: SweepResults) -> tuple[str, ...]:
    """Keys of the summary that a report of a sweep shows: of one end where both bearings are the same.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep of a drive.
    """
    assert isinstance(results.case, DriveCase)
    first, second = results.case.bearings
    alike = first == second and not any(end_and_key(key)[0] in ENDS for key in results.varied)
    ends = ENDS[:1] if alike else ENDS
    return (*_BOTH, *(f"{end}.{key}" for key in _EACH for end in ends))


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
    told = [
        f"expected at {counts['red']} of {known} points",
        f"not certain at {counts['yellow']}",
        f"not expected at {counts['green']}",
    ]
    sentences = [f"{lead}: {', '.join(told)}.", *_range(results), _RULE]
    if missing:
        sentences.insert(1, f"{missing} more {'point is' if missing == 1 else 'points are'} not solved.")
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
