"""Drive before its simulation: with bearings whose contacts are not solved, and what is expected of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.bearing import quick_case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.discharge.breakdown_rule import STRENGTH_UNKNOWN
from ehlectric.discharge.film_verdict import no_verdict
from ehlectric.drive.verdict_rule import (
    CODES_OF_LEVELS,
    SELDOM,
    most_by_law,
    voltages_doubted,
    weakest_part,
)
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.quantities.statement import Fact, Level, Statement
from ehlectric.quantities.verdict import Verdict

# Code of a verdict that the divider cannot give.
_UNSIMULATED = "none-without-simulation"


def quick_drive(case: DriveCase) -> tuple[DriveCase | None, str]:
    """Drive with estimated contacts, and an empty text; or None and the key that needs solved contacts."""
    films = {}
    for end, bearing in zip(ENDS, case.bearings, strict=True):
        judged, refused = quick_case(bearing)
        if judged is None or refused is not None:
            return None, f"{end}.{'lubricant' if refused is None else refused.key}"
        films[end] = judged
    tables = {**case.to_dict(), **films}
    tables["drive"].pop("contacts", None)
    return DriveCase.from_dict(tables), ""


def expected(case: DriveCase, summary: Mapping[str, Any]) -> Verdict:
    """Verdict on a drive that is not simulated: the capacitive divider against the breakdown voltages.

    It is about the bearing that breaks down first; its margin is breakdown voltage over bearing voltage at
    the peak of the source. It is grey with a grounding ring or an inductance, which the divider neglects.
    """
    margins = {
        end: summary[end]["breakdown_voltage"] / max(summary[end]["voltage_at_peak"], 1e-30)
        for end in ENDS
        if summary[end]["breakdown_voltage"] is not None
    }
    touching = max(summary[end]["contact_time_share"] for end in ENDS)
    if not margins:
        return Verdict("green", CODES_OF_LEVELS["green"], Statement.of("ceramics-insulate"))
    circuit = case.running_circuit
    if circuit.inductive:
        return no_verdict(Statement.of("inductance"), code=_UNSIMULATED)
    end = min(margins, key=lambda name: margins[name])
    margin, about = margins[end], summary[end]
    numbers = Statement.of(
        "divider",
        end=NAMES_OF_ENDS[end],
        voltage=about["voltage_at_peak"],
        way="above" if margin < 1.0 else "below",
        breakdown=about["breakdown_voltage"],
        margin=margin,
    )
    facts = (Fact(f"{end}.voltage_at_peak", about["voltage_at_peak"]), Fact(f"{end}.margin", margin))
    if circuit.grounding_ring_resistance is not None:
        led_away = (Statement.of("ring-leads-away"),)
        return Verdict("grey", _UNSIMULATED, numbers, facts=facts, reasons=led_away)
    level = _level(about, case)
    scatter = level == "yellow" and margin >= 1.0 and about["weibull_shape"]
    doubts = [Statement.of("thresholds-scatter")] if scatter else []
    doubts += voltages_doubted(case, summary)
    if case.source.overshoot:
        doubts.append(Statement.of("source-rings"))
    if touching:
        doubts.append(Statement.of("asperities-close-at-peak", share=touching))
    if doubts and level == "green":
        level = "yellow"
    return Verdict(level, CODES_OF_LEVELS[level], numbers, facts=facts, reasons=tuple(doubts))


def _level(about: Mapping[str, Any], case: DriveCase) -> Level:
    """Level of a bearing from its voltage at the peak, within the uncertainty of its breakdown voltage."""
    part = weakest_part(case, formula=about["films"] == "formula")
    voltage, at = about["voltage_at_peak"], about["breakdown_voltage"]
    if voltage >= (1.0 + STRENGTH_UNKNOWN) * at:
        return "red"
    return "green" if most_by_law({**about, "peak_voltage": voltage}, part) <= SELDOM else "yellow"
