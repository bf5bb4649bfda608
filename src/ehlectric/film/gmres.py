"""Flexible GMRES: linear systems whose preconditioner varies from iteration to iteration."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.arrays import Array

# Largest number of iterations per Newton step of a film.
KRYLOV_LIMIT = 60


def flexible_gmres(
    operator: Callable[[Array], Array],
    precondition: Callable[[Array], Array],
    right: Array,
    *,
    tolerance: float,
    limit: int,
) -> tuple[Array, int]:
    """Solution (n,) of a linear system by GMRES, and the number of iterations.

    The preconditioner may vary from iteration to iteration. It is on the right, so that the norm of the
    residual itself becomes smallest. The solution is the last iterate if the limit is reached.

    Y. Saad, SIAM J. Sci. Comput. 14 (1993) 461, doi:10.1137/0914028, algorithm 2.2.

    Examples
    --------
    >>> matrix = np.array([[2.0, 1.0], [0.0, 1.0]])
    >>> right = np.array([3.0, 1.0])
    >>> found, number = flexible_gmres(lambda v: matrix @ v, lambda v: v, right, tolerance=1e-12, limit=2)
    >>> bool(np.allclose(found, 1.0)), number
    (True, 2)
    """
    norm = float(np.linalg.norm(right))
    if norm == 0.0:
        return np.zeros_like(right), 0
    basis, changes = [right / norm], []
    # Columns of the triangular factor of the Hessenberg matrix, the rotations that make it triangular, and
    # the rotated right side, whose last entry is the norm of the residual.
    columns: list[Array] = []
    rotations: list[tuple[float, float]] = []
    rotated = [norm]
    iterations = 0
    while iterations < limit:
        iterations += 1
        changes.append(precondition(basis[-1]))
        image = operator(changes[-1])
        length = float(np.linalg.norm(image))
        column = np.zeros(limit + 1)
        for row, vector in enumerate(basis):
            column[row] = np.vdot(vector, image)
            image -= column[row] * vector
        after = float(np.linalg.norm(image))
        for row, (cos, sin) in enumerate(rotations):
            here, below = column[row], column[row + 1]
            column[row], column[row + 1] = cos * here + sin * below, cos * below - sin * here
        last = len(rotations)
        diagonal = float(np.hypot(column[last], after))
        if not diagonal > 0.0:
            changes.pop()
            break
        rotations.append((column[last] / diagonal, after / diagonal))
        column[last] = diagonal
        columns.append(column)
        cos, sin = rotations[-1]
        rotated[-1:] = [cos * rotated[-1], -sin * rotated[-1]]
        # The image of the last change may be one of those before, up to rounding.
        if not (abs(rotated[-1]) > tolerance * norm and after > np.finfo(float).eps * length):
            break
        basis.append(image / after)
    if not changes:
        return np.zeros_like(right), iterations
    triangle = np.stack(columns, axis=1)[: len(columns)]
    return np.asarray(np.linalg.solve(triangle, rotated[:-1]) @ changes), iterations
