"""Named points of the path of contact with their loads and films, and the place that decides."""

from __future__ import annotations

from ehlectric.gear.solution import GearSolution

# Part of the path of contact within which a place is a point's.
_AT_POINT = 0.03

# Parts of the flanks that touch at both ends of the path of contact.
ENDS = {"A": "root of gear 1 and tip of gear 2", "E": "tip of gear 1 and root of gear 2"}


def weakest(solution: GearSolution) -> tuple[float, float]:
    """Place g on the path of contact and place y on the face of the smallest film [m]."""
    index = solution.thinnest
    return float(solution.films.places[index]), float(solution.loads.across[index])


def name_of_place(solution: GearSolution, place: float) -> str:
    """Name of a place g on the path of contact: a point, or the points between which it lies.

    Examples
    --------
    "A, root of gear 1 and tip of gear 2", or "between B and C".
    """
    points = solution.path.points
    near = min(points, key=lambda name: abs(points[name] - place))
    if abs(points[near] - place) <= _AT_POINT * solution.path.length:
        return f"{near}, {ENDS[near]}" if near in ENDS else near
    before = max((name for name in points if points[name] <= place), key=points.__getitem__, default="A")
    after = min((name for name in points if points[name] > place), key=points.__getitem__, default="E")
    return f"between {before} and {after}"
