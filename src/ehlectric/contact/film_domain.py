"""Ends of the domain of a film, from the lengths over which its pressure builds up.

Pressure builds up upstream of a contact, and at the sides of a point contact, over lengths sqrt(2 R h). In a
light contact with a thick film these are many half-widths. Contacts of files begin with the default domain,
and larger ones follow from the film that was solved; contacts of bearings have a domain that follows from a
formula for the film. Lengths are in half-widths or semi-axes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Numbers, as_float

# Distances of the ends of a domain from the middle of the contact: inlet, outlet and side.
Ends = tuple[Numbers, Numbers, Numbers]


@dataclass(frozen=True)
class DomainRule:
    """Ends of a domain in lengths over which the pressure builds up, and the largest ends."""

    upstream: float
    downstream: float
    most: Ends  # largest inlet, outlet and side
    sideways: float = 0.0  # beyond the end of the ellipse; 0 of a line contact
    # Inlet from which the lengths upstream are fewer, and their number there.
    far: float = math.inf
    upstream_far: float = 0.0

    def inlet(self, along: Numbers) -> Numbers:
        """Inlet that a film needs whose pressure builds up over a length ``along``."""
        return np.minimum(self.upstream * along, np.maximum(self.far, self.upstream_far * along))

    def side(self, across: Numbers) -> Numbers:
        """Side that a film needs whose pressure builds up over a length ``across``."""
        return 1.0 + self.sideways * across

    def ends(self, least: Ends, along: Numbers, across: Numbers = 0.0) -> Ends:
        """Ends that a film needs, at least ``least``; the largest ones if it needs more.

        ``along`` and ``across``, lengths over which its pressure builds up, shape (...).

        Examples
        --------
        >>> rule = DomainRule(upstream=10.0, downstream=2.0, most=(300.0, 300.0, 0.0))
        >>> rule.ends((4.0, 2.0, 0.0), 1.5), rule.ends((4.0, 2.0, 0.0), 200.0)
        ((15.0, 3.0, 0.0), (300.0, 300.0, 0.0))
        """
        needed = self.inlet(along), self.downstream * along, self.side(across)
        inlet, outlet, side = (
            as_float(np.maximum(near, np.minimum(end, most)))
            for near, end, most in zip(least, needed, self.most, strict=True)
        )
        return inlet, outlet, side

    def part_needed(self, along: Numbers, across: Numbers = 0.0) -> Numbers:
        """Inlet or side that a film needs over the largest one, the larger of both ratios."""
        inlet = self.inlet(along) / self.most[0]
        return np.maximum(inlet, self.side(across) / self.most[2]) if self.sideways else inlet


# Largest inlet and side of a grid. Films of contacts under very light loads often do not converge on longer
# grids.
FARTHEST_LINE, FARTHEST_POINT, WIDEST_POINT = 300.0, 48.0, 24.0

# Domains of contacts whose first domain was too small, by geometry.
LARGER = {
    "line": DomainRule(upstream=6.0, downstream=2.0, most=(FARTHEST_LINE, 0.5 * FARTHEST_LINE, 0.0)),
    "point": DomainRule(
        upstream=6.0,
        downstream=2.0,
        sideways=3.0,
        most=(FARTHEST_POINT, 0.5 * FARTHEST_POINT, WIDEST_POINT),
    ),
}
