"""Nodes of the atlas: load groups, lubricant coordinates and ratios of the semi-axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.atlas.groups import Groups, groups_of

# Exponent of the load group in the lubricant coordinate Y = L N^(1/6). In bearings L falls and N rises with
# the viscosity and the speed, so that L and N are correlated, whereas Y and N are hardly so.
_SKEW = 1.0 / 6.0


def lubricant_coordinate(groups: Groups) -> float:
    """Coordinate Y = L N^(1/6) of a contact with the load group N, M for a line contact.

    Examples
    --------
    >>> lubricant_coordinate(Groups(64.0, 10.0))
    20.0
    """
    return float(groups.moes_l * groups.load_group**_SKEW)


@dataclass(frozen=True)
class Axes:
    """Nodes of a table of films: a tensor grid in ln N, ln Y and ln k.

    Attributes
    ----------
    load, lubricant : ndarray
        Load groups N, M for lines, and lubricant coordinates Y.
    ratio : ndarray or None
        Ratios k of the semi-axes; None for lines.
    """

    load: Array
    lubricant: Array
    ratio: Array | None = None

    @property
    def nodes(self) -> tuple[Array, ...]:
        """Nodes along each axis."""
        axes = (self.load, self.lubricant)
        return axes if self.ratio is None else (*axes, self.ratio)

    @property
    def shape(self) -> tuple[int, ...]:
        """Numbers of nodes."""
        return tuple(axis.size for axis in self.nodes)

    def groups(self, at: tuple[int, ...]) -> Groups:
        """Groups of the contact at a node."""
        load, lubricant = float(self.load[at[0]]), float(self.lubricant[at[1]])
        ratio = None if self.ratio is None else float(self.ratio[at[2]])
        return groups_of(load, lubricant / load**_SKEW, ratio)

    def order(self) -> list[tuple[int, ...]]:
        """All nodes: first k >= 1 below the largest load group, and of them every second one."""
        nodes = list(np.ndindex(*self.shape))
        return sorted(nodes, key=lambda at: (self._is_late(at), any(i % 2 for i in at), at))

    def _is_late(self, at: tuple[int, ...]) -> int:
        """2 for narrow contacts, 1 for the thinnest films, which take longest, 0 for all others."""
        if self.ratio is not None and self.ratio[at[2]] < 1.0:
            return 2
        return int(at[0] == self.load.size - 1)


# Films change their regime at small load groups, where the nodes are closer; beyond, films follow powers.
POINTS = Axes(
    np.array([3.0, 5.5, 10.0, 20.0, 45.0, 130.0, 500.0, 2500.0, 12000.0]),
    np.geomspace(5.0, 112.0, 5),
    np.array([0.25, 0.5, 1.0, 2.0, 4.5, 9.5, 20.0]),
)
LINES = Axes(np.geomspace(0.2, 800.0, 25), np.geomspace(1.5, 112.0, 19))
