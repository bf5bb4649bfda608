"""What is to be known of the solved contacts of a bearing, each text once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ehlectric.bearing_contacts import ContactSolution


def contact_remarks(rings: Mapping[str, Sequence[ContactSolution]]) -> list[str]:
    """Warnings of contacts, those that say the same in one line.

    Parameters
    ----------
    rings : mapping of str to sequence of ContactSolution
        Contacts that were solved, by the name of their ring.

    Returns
    -------
    list of str
        In the order in which they come up. What all contacts share, as a doubt about their oil, names none
        of them; other texts name ring and load.
    """
    told: dict[str, dict[str, list[float]]] = {}
    for ring, contacts in rings.items():
        for contact in contacts:
            for text in dict.fromkeys(contact.warnings):
                told.setdefault(text, {}).setdefault(ring, []).append(contact.load)
    every = sum(map(len, rings.values()))
    return [
        text
        if sum(map(len, loads.values())) == every
        else ", ".join(_named(ring, those) for ring, those in loads.items()) + f": {text}"
        for text, loads in told.items()
    ]


def _named(ring: str, loads: Sequence[float]) -> str:
    """One contact or some of a ring, by their loads [N].

    Examples
    --------
    >>> _named("inner", [800.0]), _named("outer", [20.0, 40.0, 80.0])
    ('inner contact at 800 N', '3 outer contacts at 20 to 80 N')
    """
    if len(loads) == 1:
        return f"{ring} contact at {loads[0]:.4g} N"
    return f"{len(loads)} {ring} contacts at {min(loads):.4g} to {max(loads):.4g} N"
