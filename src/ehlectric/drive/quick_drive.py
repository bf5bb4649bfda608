"""Drive before its simulation: with bearings whose contacts are not solved, and what is expected of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.bearing.quick_contacts import quick_case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.discharge.breakdown_rule import STRENGTH_UNKNOWN, Level, ratio_text
from ehlectric.discharge.film_verdict import Verdict
from ehlectric.drive.drive_verdict import LEADS, SELDOM, most_by_law, weakest_part
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.readable import readable

_RING = (
    "The grounding ring leads the charge of the shaft away, which the divider leaves out: "
    "simulate the drive to see what is left."
)
_INDUCTANCE = (
    "An inductance and the capacitances of the machine ring together, which the divider leaves out: "
    "simulate the drive to see the voltage of the bearings."
)
_SCATTER = "Thresholds scatter, so that some films break down at lower voltages."
_RINGING = "The ringing of the source lifts the voltage above the divider's."


def quick_drive(case: DriveCase) -> tuple[DriveCase | None, str]:
    """Drive with quick contacts, and an empty text; or None and the key that needs solved contacts."""
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
    the peak of the source. It is grey with a grounding ring or an inductance, which the divider leaves out.
    """
    margins = {
        end: summary[end]["breakdown_voltage"] / max(summary[end]["voltage_at_peak"], 1e-30)
        for end in ENDS
        if summary[end]["breakdown_voltage"] is not None
    }
    touching = max(summary[end]["touching_time_share"] for end in ENDS)
    if not margins:
        return Verdict("green", "No discharge expected: the ceramic elements of both bearings insulate.")
    circuit = case.running_circuit
    if circuit.common_mode_inductance is not None or circuit.ground_inductance is not None:
        return Verdict("grey", f"No verdict without a simulation: {_INDUCTANCE}")
    end = min(margins, key=lambda name: margins[name])
    margin, about = margins[end], summary[end]
    numbers = (
        f"at the peak of the common-mode voltage the films of the {NAMES_OF_ENDS[end]} would have "
        f"{readable(about['voltage_at_peak'])} V by the capacitive divider, "
        f"{'above' if margin < 1.0 else 'below'} their breakdown voltage of at most "
        f"{readable(about['breakdown_voltage'])} V (ratio {ratio_text(margin)})."
    )
    if circuit.grounding_ring_resistance is not None:
        return Verdict("grey", f"No verdict without a simulation: {numbers} {_RING}", margin)
    level = _level(about, case)
    doubts = [_SCATTER] if level == "yellow" and margin >= 1.0 and about["weibull_shape"] else []
    if case.source.overshoot:
        doubts.append(_RINGING)
    if touching:
        doubts.append(f"Asperities close the films for {readable(100.0 * touching)} % of the time.")
    if doubts and level == "green":
        level = "yellow"
    return Verdict(level, " ".join([f"{LEADS[level]}: {numbers}", *doubts]), margin)


def _level(about: Mapping[str, Any], case: DriveCase) -> Level:
    """Level of a bearing from its voltage at the peak, within what is uncertain of its breakdown voltage."""
    part = weakest_part(case, formula=about["films"] == "formula")
    voltage, at = about["voltage_at_peak"], about["breakdown_voltage"]
    if voltage >= (1.0 + STRENGTH_UNKNOWN) * at:
        return "red"
    return "green" if most_by_law({**about, "peak_voltage": voltage}, part) <= SELDOM else "yellow"
