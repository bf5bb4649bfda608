"""Rows of a duty cycle with margins, of a bearing or a gear pair."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ehlectric.quantities.formats import speed_text
from ehlectric.quantities.quantity import Bound, Quantity
from ehlectric.quantities.rows import Row, Summary, value_at
from ehlectric.readable import readable
from ehlectric.tables.probability_rows import probability_value

# Probabilities of breakdown over a cycle.
_PROBABILITIES = ("duty.breakdown_probability", "duty.turning_breakdown_probability")

# Shares of the time that are alarming.
_ALARMING = ("duty.breakdown_share", "duty.low_margin_share")


def unless_zero(key: str) -> Callable[[Summary], Any]:
    """Value of a row that is omitted if its number is 0."""
    return lambda summary: value_at(summary, key) or None


def values_of_cycle() -> dict[str, Callable[[Summary], Any]]:
    """Values of the rows of a cycle that are no plain numbers, by their keys."""
    return {
        **{key: probability_value(key) for key in _PROBABILITIES},
        "duty.left_out_share": unless_zero("duty.left_out_share"),
    }


def alarms_of_cycle() -> dict[str, Callable[[Summary], bool]]:
    """Whether the rows of a cycle are alarming, by their keys."""

    def alarm(key: str) -> Callable[[Summary], bool]:
        return lambda summary: bool(value_at(summary, key))

    return {key: alarm(key) for key in _ALARMING}


def stretch_rows(
    book: Mapping[str, Quantity], summary: Summary, bounds: Mapping[str, Bound] | None = None
) -> Iterator[Row]:
    """Rows of the worst stretches of a duty cycle, the worst first; ``bounds``, signs of the values."""
    for place, stretch in enumerate((summary.get("duty") or {}).get("stretches", ())):
        name = "lambda_ratio" if stretch["least_margin"] is None else "least_margin"
        about = book[key := f"duty.stretches.{name}"]
        span = f"{about.label}, {readable(stretch['start'], 6)} to {readable(stretch['end'], 6)} s"
        at = f", {stretch['why']}" if stretch["why"] else f", at {speed_text(stretch['speed'])}"
        yield Row(
            span,
            stretch[name],
            note=at,
            digits=about.digits,
            bound=(bounds or {}).get(key, ""),
            key=f"duty.stretches.{place}.{name}",
        )
