"""Rows of the asperities of a bearing: regime, shares of time with contact, and load shares."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.bearing.intermittency.words import OF_TIME, SELDOM, time_text
from ehlectric.quantities.rows import Row
from ehlectric.quantities.units import rpm_text

# Laws of the share of time of a contact, in words.
_LAWS = {"clarke": "Clarke's fit over lambda", "greenwood_williamson": "the number of spots"}


def duty_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the asperities of a bearing; none of a result of an earlier version, which lacks the keys.

    Shares below a hundredth of a per cent have no rows of their own beside the regime.
    """
    totals = summary["bearing"]
    if totals.get("regime") is None:
        return
    share, touching = totals["contact_time_share"], totals["touching_time_share"]
    yield Row("asperities")
    note = f", contacts short it {time_text(share)}"
    if share == 0.0 and touching > 0.0:
        note = ", ceramic elements or a coating insulate"
    yield Row("electrical regime", totals["regime"], note=note, alarm=totals["regime"] != "capacitive")
    if touching >= SELDOM:
        inner, outer = (time_text(totals[f"{ring}_contact_time_share"]) for ring in ("inner", "outer"))
        law = _LAWS[totals["contact_model"]]
        yield Row(
            "contact at the inner, outer ring", f"{inner.removesuffix(OF_TIME)}, {outer}", note=f", by {law}"
        )
        if totals["contact_model"] != "clarke":
            yield Row("contacts short it by Clarke's fit", time_text(totals["clarke_time_share"]))
        yield Row("films carry a voltage", time_text(totals["insulating_time_share"]))
        low, high = (100.0 * totals[f"asperity_share_{end}"] for end in ("low", "high"))
        yield Row("asperity load share", f"{low:.2g} to {high:.2g}", "%", ", by the published laws")
    speed = (summary.get("margin") or {}).get("capacitive_speed")
    if speed is not None:
        yield Row("capacitive from", rpm_text(speed), "rpm", ", at this temperature")
