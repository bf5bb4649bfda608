"""Bounds: which numbers of a result are upper or lower bounds, as an ideal film is better than a real one.

The book says what an ideal film makes of each quantity. Whether that holds for a result follows from what its
film leaves out: starvation, heat, or roughness. A real film is thinner, so that its field is higher, and it
breaks down at a lower voltage.
"""

from __future__ import annotations

from ehlectric.quantities.quantity import Bound, Keys
from ehlectric.quantities.rows import Summary, value_at


def left_out(summary: Summary) -> tuple[str, ...]:
    """What the film of a contact leaves out: "isothermal", "fully flooded", "smooth".

    Examples
    --------
    >>> left_out({"film": {"thermal": True}})
    ('fully flooded', 'smooth')
    """
    film = summary.get("film", {})
    ideal = {
        "isothermal": not film.get("thermal"),
        "fully flooded": "oil_layer" not in film,
        "smooth": "roughness" not in summary,
    }
    return tuple(name for name, holds in ideal.items() if holds)


def bound_words(summary: Summary) -> str:
    """Why the breakdown voltage of a contact is an upper bound; empty where its film leaves nothing out.

    Examples
    --------
    >>> bound_words({"film": {"thermal": True}})
    'upper bound: fully flooded, smooth film'
    """
    ideal = left_out(summary)
    return f"upper bound: {', '.join(ideal)} film" if ideal else ""


def contact_bounds(book: Keys, summary: Summary) -> dict[str, Bound]:
    """Bounds of the numbers of a contact, by dotted key.

    Where surfaces touch, the maximum field is that of the boundary film, which its thickness gives. The
    resistance of spots that are ridges is an upper bound in any film.
    """
    always = {"asperities.resistance"}
    never = {"field.max_strength"} if value_at(summary, "asperities.spots") else set()
    ideal = bool(left_out(summary))
    return {
        key: about.bound
        for key, about in book.items()
        if about.bound and key not in never and (ideal or key in always)
    }


def ideal_bounds(book: Keys) -> dict[str, Bound]:
    """Bounds of the numbers of a drive or of a contact over time, by dotted key.

    Their films are ideal in any case: those of a drive are smooth, those of moving roughness isothermal.
    """
    return {key: about.bound for key, about in book.items() if about.bound}
