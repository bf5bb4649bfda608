"""Verdict on a contact whose surfaces touch."""

from __future__ import annotations

from collections.abc import Iterable

from ehlectric.contact.spots.asperities import Asperities
from ehlectric.discharge.verdict import Verdict, unusable
from ehlectric.errors import ResultWarning

# First words of a verdict, which are its heading, and what the contact does.
_LEADS = {
    "resistive": "The spots conduct",
    "mixed": "Discharges expected",
    "capacitive": "Breakdown possible",
}
_ANSWERS = {
    "resistive": "the spots short the film at 10 kHz, and no voltage builds up while they are there",
    "mixed": "it conducts and insulates in turn, and discharges as the spots open",
    "capacitive": "only what lies on the spots insulates, and its own breakdown is not known",
}


def spots_verdict(found: Asperities, voltage: float, warnings: Iterable[ResultWarning]) -> Verdict:
    """Verdict on a contact whose surfaces touch under a voltage.

    Parameters
    ----------
    found : Asperities
        Asperities of the contact, with at least one spot.
    voltage : float
        Applied voltage [V].
    warnings : iterable of ResultWarning
        Warnings of the contact; a severe one leaves no verdict.

    Returns
    -------
    Verdict
        Red; yellow where a tribofilm insulates the spots; grey where the film must not be used.
    """
    refused = unusable(warnings)
    if refused:
        return Verdict("grey", refused)
    answer, number = found.electrical, found.spots.number
    spots = "1 spot" if number == 1 else f"{number} spots"
    text = f"{_LEADS[answer.behaviour]}: the surfaces touch in {spots} "
    text += f"at an applied voltage of {voltage:.3g} V. "
    text += f"The contact is {answer.behaviour}, {_ANSWERS[answer.behaviour]}."
    if answer.breakdown_5 is not None:
        text += f" Around the spots 5 % of the Hertz zone would break down at {answer.breakdown_5:.2g} V."
    if answer.breakdown_probability is not None:
        text += (
            " Around the spots the film would break down with a probability of "
            f"{100.0 * answer.breakdown_probability:.2g} %."
        )
    return Verdict("yellow" if answer.behaviour == "capacitive" else "red", text)
