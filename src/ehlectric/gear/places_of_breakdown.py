"""Places of the flank at which a mesh breaks down.

The strength of a film scatters from place to place by a Weibull law with the shape m. At a voltage U the
probability of a breakdown on the area dA is proportional to (U/gap)^m dA, so that the first breakdown is at a
place with the density

    gap^-m / (integral of gap^-m dA)        gap = h_min - k Rq

Each place of the plane of action is on a line of contact once in a phase of the mesh. The sum over the nodes
of all lines and phases, with their lengths and the weights of the phases, is the integral over this plane.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.gear.solution import GearSolution


@dataclass(frozen=True)
class DischargePlaces:
    """Nodes of the lines of contact with the probability that the mesh breaks down there."""

    films: Array  # minimum film thickness of the nodes, increasing [m], shape (n,)
    places: Array  # places g on the path of contact [m], shape (n,)
    areas: Array  # shares of the nodes in the loaded area of the flank, shape (n,)
    weights: Array  # probabilities of the nodes, shape (n,)

    def film_around(self, share: float) -> float:
        """Minimum film thickness [m] up to which a share of the breakdowns takes place."""
        return float(np.interp(share, _up_to(self.weights), self.films))

    def area_share(self, share: float) -> float:
        """Smallest part of the loaded flank on which a share of the breakdowns takes place."""
        return float(np.interp(share, _up_to(self.weights), _up_to(self.areas)))

    def before(self, place: float) -> float:
        """Probability of a breakdown before a place g [m], thus towards the root of gear 1."""
        return float(np.sum(self.weights[self.places <= place]))


def _up_to(shares: Array) -> Array:
    """Sums of shares up to the middle of each, shape (n,)."""
    return np.asarray(np.cumsum(shares) - 0.5 * shares)


def discharge_places(solution: GearSolution) -> DischargePlaces | None:
    """Distribution of the place of the first breakdown; None where summits touch."""
    films, loads = solution.films.minimum, solution.loads
    area, known = loads.weights[loads.phase] * loads.length, ~np.isnan(films)
    gap = solution.gap[known]
    if not np.min(gap) > 0.0:
        return None
    order = np.argsort(films[known])
    film, part = films[known][order], area[known][order]
    weights = part * (np.min(gap) / gap[order]) ** solution.case.gear.contact.weibull_shape
    return DischargePlaces(
        film, loads.places[known][order], part / np.sum(part), np.asarray(weights / np.sum(weights))
    )
