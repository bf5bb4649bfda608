"""Named points of the path of contact with their loads and films, and the place that decides."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace

from ehlectric.gear.flank_films import FlankFilms
from ehlectric.gear.solution import GearSolution

# Part of the path of contact within which a place is a point's.
_AT_POINT = 0.03

# Parts of the flanks that touch at both ends of the path of contact.
ENDS = {"A": "root of gear 1 and tip of gear 2", "E": "tip of gear 1 and root of gear 2"}


@dataclass(frozen=True)
class PathPoint:
    """Point of the path of contact with the mean line load that passes it."""

    name: str
    place: float  # g [m]
    films: FlankFilms  # line contact at this place, arrays of shape (1,)


def path_points(solution: GearSolution) -> Iterator[PathPoint]:
    """Points A, B, C, D and E of the path of contact, with the mean over the phases of the load there."""
    films = solution.point_films
    numbers = [each.name for each in fields(films) if each.name != "atlas"]
    for k, (name, place) in enumerate(solution.path.points.items()):
        at = replace(films, **{number: getattr(films, number)[k : k + 1] for number in numbers})
        yield PathPoint(name, place, at)


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
