"""Nodes of the atlas: load groups, lubricant coordinates and ratios of the semi-axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.atlas.groups import Groups, groups_of

# Largest Hertz pressure of points over 1/alpha: 5 GPa with 20 1/GPa. Higher ones converge slowly.
MOST_HERTZ = 100.0

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

    def at(self, groups: Groups) -> tuple[int, ...] | None:
        """Indices of the node with these groups; None where the axes have no such node."""
        place = [groups.load_group, lubricant_coordinate(groups)]
        place += [] if self.ratio is None else [groups.ratio or 1.0]
        at = []
        for axis, value in zip(self.nodes, place, strict=True):
            index = int(np.argmin(np.abs(np.log(axis / value))))
            if abs(axis[index] / value - 1.0) > _ALIKE:
                return None
            at.append(index)
        return tuple(at)

    def order(self) -> list[tuple[int, ...]]:
        """Nodes to solve, the most wanted first; splines through these give the others."""
        ranked = [(_rank(self, at), at) for at in np.ndindex(*self.shape)]
        return [at for rank, at in sorted((rank, at) for rank, at in ranked if rank is not None)]


def _rank(axes: Axes, at: tuple[int, ...]) -> int | None:
    """Place of a node in the order of the computation; None for a node that is not solved."""
    if axes.ratio is None:
        return 0
    load, lubricant, ratio = (float(axis[index]) for axis, index in zip(axes.nodes, at, strict=True))
    between, light, ball = at[1] % 2 == 1, load <= _LIGHT, ratio >= _BALLS
    if ratio < 1.0 or ratio in _SPARSE:
        return None if between or load not in _SPARSE_LOADS[ratio] else _SPARSE.get(ratio, 4)
    # Only light contacts, and those near the largest Hertz pressure, change fast with Y.
    if light:
        return 1 if ball and ratio < _NARROW else 5
    if between:
        return 8 if ball and lubricant > _HIGH else None
    # The thinnest films take longest.
    wide, narrow = not ball, ratio > _NARROW and lubricant > _LONG
    if load > _HEAVY and (lubricant < _LOW or (load > _HEAVIEST and (wide or narrow))):
        return 9
    return 4 if not ball else 6 if _HEAVY < load < _HEAVIEST else 0


# Load group up to which every lubricant coordinate is solved, and the coordinate beyond which this holds for
# all loads; least ratio of the semi-axes of the balls of bearings, which come first; lubricant coordinate
# below which no bearing is, and load groups beyond which films are thin, and thinnest; ratio above balls.
_LIGHT, _HIGH, _BALLS = 130.0, 70.0, 4.0
_LOW, _HEAVY, _HEAVIEST, _NARROW, _LONG = 9.0, 3000.0, 10000.0, 12.0, 50.0

# Ratios of the semi-axes that are solved for few load groups, with their rank, and these load groups. Films
# change slowly with the ratio, but the side lobes of heavily loaded contacts do not.
_SPARSE = {1.4: 4, 3.0: 0, 6.5: 0}
_FEW = (5.5, 20.0, 130.0, 500.0, 2500.0)
_WIDE = (3.0, 5.5, 10.0, 20.0, 45.0, 130.0, 500.0)
_SPARSE_LOADS = {0.25: _WIDE, 0.5: _WIDE, 1.4: _FEW, 3.0: _FEW, 6.5: (*_FEW, 12000.0)}

# Relative distance within which a contact is at a node.
_ALIKE = 1e-6

# Films change their regime at small load groups, where the nodes are closer; beyond, films follow powers.
_SMALL = 3.0, 4.0, 5.5, 7.4, 10.0, 14.0, 20.0, 30.0, 45.0, 75.0, 130.0
_LOADS = (*_SMALL, 250.0, 500.0, 1100.0, 2500.0, 5500.0, 12000.0)

POINTS = Axes(
    np.array(_LOADS),
    np.append(np.geomspace(5.0, 112.0, 9), 175.0),
    np.array([0.25, 0.5, 1.0, 1.4, 2.0, 3.0, 4.5, 6.5, 9.5, 20.0]),
)
LINES = Axes(np.geomspace(0.2, 800.0, 25), np.geomspace(1.5, 112.0, 19))
