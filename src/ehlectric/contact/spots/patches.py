"""Separate spots of a mask of nodes that touch: their number, sizes, places and loads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from ehlectric.arrays import Array, Mask
from ehlectric.field.zones import areas


@dataclass(frozen=True)
class Spots:
    """Spots of a contact, in the order of the nodes.

    Two nodes are in one spot if they are neighbours along an axis of the grid. Nodes that are neighbours
    along a diagonal only are two spots, as the film between them is connected. In a line contact a spot is a
    strip that is as long as the contact.

    Attributes
    ----------
    areas : ndarray, shape (n,)
        Area of each spot [m^2]; of a line contact its width [m].
    positions : ndarray, shape (n, d)
        Centre of the area of each spot (x,) or (x, y) [m].
    nodes : ndarray of int, shape (n,)
        Number of nodes of each spot.
    loads : ndarray, shape (n,)
        Load that each spot carries [N]; of a line contact per length [N/m].
    edge : float
        Largest error of the total area because edges of spots lie somewhere between two nodes [m^2] or [m].
    """

    areas: Array
    positions: Array
    nodes: NDArray[np.int_]
    loads: Array
    edge: float

    @classmethod
    def of(cls, axes: tuple[Array, ...], contact: Mask, pressure: Array) -> Spots:
        """Find the spots of a contact.

        Parameters
        ----------
        axes : tuple of ndarray
            Nodes along each axis [m].
        contact : ndarray of bool, shape (nx,) or (nx, ny)
            Nodes where the surfaces touch.
        pressure : ndarray, shape of ``contact``
            Contact pressure [Pa].

        Examples
        --------
        Three nodes in a row and one at a corner of them are two spots:

        >>> touching = np.array([[1, 1, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0]], dtype=bool)
        >>> spots = Spots.of((np.arange(3.0), np.arange(4.0)), touching, 2.0 * touching)
        >>> spots.nodes.tolist(), spots.areas.tolist(), spots.edge
        ([3, 1], [1.25, 0.5], 2.5)
        """
        weights = areas(axes)
        labels, count = ndimage.label(contact)
        each = np.arange(1, count + 1)
        own = _sum(weights, labels, each)
        places = np.meshgrid(*axes, indexing="ij")
        centres = [_sum(weights * place, labels, each) / own for place in places]
        return cls(
            areas=own,
            positions=np.stack(centres, axis=-1),
            nodes=_sum(contact.astype(float), labels, each).astype(int),
            loads=_sum(weights * pressure, labels, each),
            edge=_edge(axes, contact),
        )

    @property
    def number(self) -> int:
        """Number of spots."""
        return int(self.areas.size)

    @property
    def area(self) -> float:
        """Area of all spots [m^2]; of a line contact their width [m]."""
        return float(np.sum(self.areas))

    @property
    def relative_edge(self) -> float | None:
        """Largest relative error of ``area``; None without spots."""
        return self.edge / self.area if self.number else None

    @property
    def radii(self) -> Array:
        """Radii of circles with the areas of the spots of a point contact [m], shape (n,)."""
        radii: Array = np.sqrt(self.areas / np.pi)
        return radii


def _sum(values: Array, labels: NDArray[Any], each: NDArray[Any]) -> Array:
    return np.asarray(ndimage.sum_labels(values, labels, each), dtype=float).reshape(each.size)


def _edge(axes: tuple[Array, ...], contact: Mask) -> float:
    """Half the area of the cells between touching nodes and neighbours that do not touch [m^2] or [m]."""
    total = 0.0
    for k, axis in enumerate(axes):
        inside = np.moveaxis(contact, k, 0)
        crossed = (inside[1:] != inside[:-1]) * np.diff(axis).reshape(-1, *[1] * (contact.ndim - 1))
        others = [other for j, other in enumerate(axes) if j != k]
        weights = areas(tuple(others)) if others else np.float64(1.0)
        total += 0.5 * float(np.sum(crossed * weights))
    return total


def weighted_percentiles(values: Array, weights: Array, shares: ArrayLike) -> Array:
    """Values below which given shares of the weight lie.

    Parameters
    ----------
    values, weights : ndarray, shape (...)
        Values in any unit, and their weights, >= 0.
    shares : array_like, shape (n,)
        Shares from 0 to 1.

    Returns
    -------
    ndarray, shape (n,)
        Smallest value up to which at least each share of the weight lies.

    Examples
    --------
    >>> weighted_percentiles(np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 2.0]), [0.1, 0.5, 1.0]).tolist()
    [1.0, 2.0, 3.0]
    """
    order = np.argsort(values, axis=None)
    up_to = np.cumsum(weights.ravel()[order])
    places = np.searchsorted(up_to, np.asarray(shares) * up_to[-1] * (1.0 - 1e-12))
    found: Array = values.ravel()[order][np.minimum(places, order.size - 1)]
    return found
