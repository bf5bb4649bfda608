"""Range of the margin of a bearing from the stated ranges of its inputs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ehlectric.bearing.margin.quick_margins import QuickMargins
from ehlectric.bearing.margin.sensitivity import Effect
from ehlectric.errors import InputError


def margin_range(
    margins: QuickMargins, margin: float, effects: Iterable[Effect]
) -> tuple[float, float] | None:
    """Margin with all inputs of ``ranges`` at their unfavourable ends, and at their favourable ends.

    Parameters
    ----------
    margins : QuickMargins
        Margins of the bearing at changed inputs.
    margin : float
        Margin of the bearing, dimensionless.
    effects : iterable of Effect
        Effects of single inputs; those of the inputs with a range decide which end is unfavourable.

    Returns
    -------
    tuple of float or None
        Smallest and largest margin, dimensionless; the smallest is 0 where the surfaces touch. None without
        ranges.

    Raises
    ------
    InputError
        Where a range has no effect on contacts from the atlas, or one of the two cases cannot be computed.

    Notes
    -----
    The ends are found one input at a time, and then taken together: 2n + 2 bearings with contacts from
    the atlas for n ranges. This is the range of the margin where every input acts in one direction over
    its range. It is wider than an interval of confidence, because all inputs are seldom at their worst at
    once.
    """
    by_key = {effect.key: effect for effect in effects}
    ranges = margins.case.ranges or ()
    if not ranges:
        return None
    worst: dict[str, float] = {}
    best: dict[str, float] = {}
    for one in ranges:
        effect = by_key.get(one.key)
        if effect is None:
            raise InputError.worded(f"ranges.{one.key}", "its ends have no margin without solved contacts")
        ends = {one.low: effect.low_margin, one.high: effect.high_margin}
        # The value of the case counts as well, as it may lie outside of its range or at the top of a curve.
        worst |= _chosen(one.key, min(ends, key=ends.__getitem__), ends, margin, lowest=True)
        best |= _chosen(one.key, max(ends, key=ends.__getitem__), ends, margin, lowest=False)
    low = margins.at(worst).margin if worst else margin
    high = margins.at(best).margin if best else margin
    return min(low, margin), max(high, margin)


def _chosen(
    key: str, end: float, ends: Mapping[float, float], margin: float, *, lowest: bool
) -> dict[str, float]:
    """Change of a key to an end of its range; none where the value of the case is the more extreme one."""
    beyond = ends[end] < margin if lowest else ends[end] > margin
    return {key: end} if beyond else {}
