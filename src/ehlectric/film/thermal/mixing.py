"""Anderson acceleration of a fixed-point iteration."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array

# Smallest eigenvalue of the matrix of the cosines between differences, over the largest one.
_DEPENDENT = 1e-12


class Mixing:
    """Anderson acceleration: the next iterate from the last few iterates and their images.

    The combination of the last images is taken whose change is smallest in a weighted norm of least squares.

    Parameters
    ----------
    depth : int
        Number of earlier iterates.
    weights : ndarray, shape (n,), or float
        Weights of the components in the norm.

    Notes
    -----
    D. G. Anderson, J. ACM 12 (1965) 547, doi:10.1145/321296.321305.

    Examples
    --------
    A linear map of two unknowns is solved after three images:

    >>> mixing, x = Mixing(depth=5), np.zeros(2)
    >>> for _ in range(4):
    ...     x = mixing(x, np.array([[0.5, 0.4], [-0.3, 0.9]]) @ x + 1.0)
    >>> bool(np.allclose(x, np.linalg.solve([[0.5, -0.4], [0.3, 0.1]], np.ones(2))))
    True
    """

    def __init__(self, depth: int = 5, weights: Array | float = 1.0) -> None:
        self._depth = depth
        self._weights = weights
        self._images: list[Array] = []
        self._changes: list[Array] = []

    def __call__(self, point: Array, image: Array) -> Array:
        """Next iterate from an iterate and its image, both (n,)."""
        change = image - point
        self._images.append(image)
        self._changes.append(change)
        del self._images[: -self._depth - 1], self._changes[: -self._depth - 1]
        if len(self._changes) == 1:
            return image
        differences = np.stack([change - other for other in self._changes[:-1]])
        differences *= self._weights
        # The differences shrink from iterate to iterate: they are compared by direction.
        lengths = np.maximum(np.linalg.norm(differences, axis=1), 1e-300)
        products = differences @ differences.T / np.outer(lengths, lengths)
        wanted = differences @ (self._weights * change) / lengths
        # Nearly dependent differences are left out: they would combine far iterates with large factors.
        factors = np.linalg.lstsq(products, wanted, rcond=_DEPENDENT)[0] / lengths
        following = np.array(image)
        for factor, other in zip(factors, self._images[:-1], strict=True):
            following -= factor * (image - other)
        return following

    def forget(self) -> None:
        """Start anew from the next iterate."""
        self._images.clear()
        self._changes.clear()
