"""Values that hold where a case file gives none, and ways to the contacts of a bearing; without arrays."""

from __future__ import annotations

from typing import Literal

# Relative error to which a film is refined, by whether the contact is a point contact.
DEFAULT_ERROR = {False: 0.01, True: 0.02}

# Thickness of the boundary film [m]: one layer of molecules of oil.
BOUNDARY_FILM = 1e-9


# Values of ``contacts`` of a bearing file.
Contacts = Literal["solved", "atlas", "formula"]

# Those that solve no film. The first one is taken where films are wanted at once.
QUICK: tuple[Contacts, ...] = ("atlas", "formula")

# How contacts and films are obtained, and such contacts, in words.
HOW = {"solved": "solved", "atlas": "from the atlas", "formula": "from the film-thickness formula"}
OF_CONTACTS = {
    "solved": "solved contacts",
    "atlas": "contacts from the atlas",
    "formula": "contacts from the film-thickness formula",
}

# Values of ``film_factor`` that are words; all except the first compute the heat.
FILM_FACTORS = ("none", "inlet-shear", "solved")

# The best estimate, which is the default where the viscosity of the oil follows its temperature, and the
# film factors without heat, whose films are upper bounds.
DEFAULT_FILM = "inlet-shear"
ISOTHERMAL = ("none", 1.0)

# Height of the highest summits divided by the composite Rq: contact of rolling surfaces was measured to begin
# at a lambda ratio of 2 (electrical contact resistance of discs, Clarke et al.).
DEFAULT_SUMMITS = 2.0


def quick_way(contacts: object) -> str:
    """Quick way of a bearing with contacts as its file has them: its own one, or the atlas.

    Examples
    --------
    >>> quick_way("formula"), quick_way("solved"), quick_way(None)
    ('formula', 'atlas', 'atlas')
    """
    return str(contacts) if contacts in QUICK else QUICK[0]
