"""States of lubrication: one scale of the lambda ratio for contacts, bearings, drives, cycles and figures.

The lambda ratio is the minimum film thickness divided by the composite roughness Rq. ``limits`` returns the
only thresholds of this scale.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

# Lambda ratios below which lubrication is called boundary lubrication, and from which it is called full-film
# lubrication.
BOUNDARY_LIMIT, FULL_FILM_LIMIT = 1.0, 3.0


@dataclass(frozen=True)
class LubricationState:
    """State of lubrication of a contact or a bearing."""

    name: str
    meaning: str
    voltage: bool  # whether the film insulates, so that a breakdown voltage is computed


BOUNDARY = LubricationState(
    "boundary lubrication",
    "Asperities carry load almost all the time. Discharges are likely, and no breakdown voltage is computed.",
    voltage=False,
)
FREQUENT = LubricationState(
    "frequent asperity contact",
    "The film is at most as thick as the highest summits. Asperity contacts open and close. Discharges are "
    "likely, and no breakdown voltage is computed.",
    voltage=False,
)
MIXED = LubricationState(
    "mixed lubrication",
    "Asperities may be in contact for a part of the time. Breakdown voltages are upper bounds.",
    voltage=True,
)
FULL = LubricationState("full film", "The film separates the surfaces.", voltage=True)

# All states from the thinnest to the thickest film.
STATES = (BOUNDARY, FREQUENT, MIXED, FULL)

# Electrical states of a mesh.
CONDUCTS, AT_TIMES, INSULATES = "conducts", "conducts at times", "insulates"

# Words for elements of an axle without a ratio of their voltage to their breakdown voltage, which conduct as
# above, whose summits touch, or which have no breakdown voltage.
TOUCHES, NO_LIMIT = "touches", "no V_b"


def word_without_ratio(state: str, breakdown_voltage: float | None, *, touching: bool) -> str:
    """Return the word for the reason why an element of an axle has no ratio of its voltage to its breakdown
    voltage; empty if it has one.

    Examples
    --------
    >>> word_without_ratio("conducts", 1.0, touching=False)
    'conducts'
    >>> [word_without_ratio("insulates", None, touching=touching) for touching in (True, False)]
    ['touches', 'no V_b']
    """
    if state == CONDUCTS:
        return CONDUCTS
    if breakdown_voltage is None:
        return TOUCHES if touching else NO_LIMIT
    return ""


# State of an element without load, which has a gap and no film.
GAP = "gap"

# Words of former keys of summary.json by the state.
FORMER_WORDS: Mapping[str, str] = MappingProxyType(
    {
        BOUNDARY.name: "touching",
        FREQUENT.name: "partial film",
        MIXED.name: "partial film",
        FULL.name: "full film",
        GAP: GAP,
    }
)


def limits(summit_height: float = 0.0) -> tuple[float, float, float]:
    """Return the lambda ratios that separate the states, from boundary lubrication to a full film.

    ``summit_height`` is the height of the highest summits divided by the composite roughness. No breakdown
    voltage is computed up to the second limit.

    Examples
    --------
    >>> limits(), limits(2.0), limits(4.0)
    ((1.0, 1.0, 3.0), (1.0, 2.0, 3.0), (1.0, 4.0, 4.0))
    """
    contact = max(BOUNDARY_LIMIT, summit_height)
    return BOUNDARY_LIMIT, contact, max(FULL_FILM_LIMIT, contact)


def bands(summit_height: float = 0.0) -> Iterator[tuple[LubricationState, float, float, str]]:
    """Yield each state that exists with its lambda ratios, from and to, and a text of the range.

    Examples
    --------
    >>> [(state.name, text) for state, _, _, text in bands(2.0)][:2]
    [('boundary lubrication', 'λ < 1'), ('frequent asperity contact', '1 ≤ λ ≤ 2')]
    >>> [text for *_, text in bands()], [text for *_, text in bands(4.0)]
    (['λ < 1', '1 ≤ λ < 3', 'λ ≥ 3'], ['λ < 1', '1 ≤ λ ≤ 4', 'λ > 4'])
    """
    boundary, contact, full = limits(summit_height)
    closed = summit_height >= boundary
    yield BOUNDARY, 0.0, boundary, f"λ < {boundary:g}"
    if closed:
        yield FREQUENT, boundary, contact, f"{boundary:g} ≤ λ ≤ {contact:g}"
    if full > contact:
        yield MIXED, contact, full, f"{contact:g} {'<' if closed else '≤'} λ < {full:g}"
    yield FULL, full, float("inf"), f"λ {'≥' if full > contact else '>'} {full:g}"


def inner_states(summit_height: float = 0.0) -> Iterator[tuple[float, LubricationState]]:
    """Yield the lambda ratios below which asperity contact is frequent or possible, with the state below.

    Examples
    --------
    >>> [(ratio, state.name) for ratio, state in inner_states(2.0)]
    [(2.0, 'frequent asperity contact'), (3.0, 'mixed lubrication')]
    """
    below = {high: state for state, _, high, _ in bands(summit_height)}
    _, contact, full = limits(summit_height)
    for limit in dict.fromkeys((contact, full)):
        yield limit, below[limit]


def is_shorted(summary: Mapping[str, Any] | None) -> bool:
    """Return whether asperity contacts short the bearing or the mesh of a summary at times.

    No voltage is computed then.

    The state of lubrication is not sufficient: ceramic elements insulate in each state. A mesh that always
    conducts is not shorted at times.

    Examples
    --------
    >>> is_shorted({"bearing": {"lubrication": "conducting"}}), is_shorted(None)
    (True, False)
    >>> is_shorted({"mesh": {"state": "insulates", "lambda_ratio": 1.9, "smooth_breakdown_voltage": 0.5}})
    True
    """
    mesh = (summary or {}).get("mesh")
    if isinstance(mesh, Mapping):
        film, breakdown = (mesh.get(key) for key in ("smooth_breakdown_voltage", "breakdown_voltage"))
        return film is not None and breakdown is None and not conducts(summary)
    table = (summary or {}).get("bearing")
    # A former key, which this program reads without a warning.
    return isinstance(table, dict) and dict.get(table, "lubrication") == "conducting"


def conducts(summary: Mapping[str, Any] | None) -> bool:
    """Return whether the mesh of a summary conducts, so that it has no voltage to break down.

    Examples
    --------
    >>> conducts({"mesh": {"state": "conducts"}}), conducts({"mesh": {"state": "insulates"}}), conducts({})
    (True, False, False)
    """
    mesh = (summary or {}).get("mesh")
    return isinstance(mesh, Mapping) and mesh.get("state") == CONDUCTS
