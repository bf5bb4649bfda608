"""Traction of a lubricated contact: friction by sliding and by rolling, and the power that it takes.

The shear stress in the film is tau = tau_m + (z - h/2) dp/dx. The mid-film stress tau_m drags both surfaces
in opposite directions, and vanishes in pure rolling. The rest, h/2 dp/dx on each surface, resists the motion
of both in the same direction. It remains in pure rolling, where the inlet has the larger film.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.mesh import Mesh
from ehlectric.film.sheared.columns import Columns


@dataclass(frozen=True)
class Traction:
    """Friction of a contact, over its load.

    Attributes
    ----------
    sliding : float
        Traction coefficient: integral of the mid-film stress along x over the load; positive where surface 2
        is faster.
    rolling : float
        Rolling coefficient: integral of h/2 dp/dx over the load, the resistance on each surface.
    """

    sliding: float
    rolling: float

    def power_loss(self, load: float, *, entrainment_speed: float, slide_to_roll_ratio: float) -> float:
        """Power that the motion of the surfaces takes, sliding and rolling together.

        Parameters
        ----------
        load : float
            Load of the contact [N], or load per length of a line contact [N/m].
        entrainment_speed : float
            Mean speed u_m of the surfaces [m/s].
        slide_to_roll_ratio : float
            (u_2 - u_1)/u_m.

        Returns
        -------
        float
            Power loss [W], or [W/m] of a line contact: the stress on each surface times its speed.

        Examples
        --------
        1 kN at a traction coefficient of 0.05, where the surfaces slide with 0.2 m/s:

        >>> speeds = {"entrainment_speed": 2.0, "slide_to_roll_ratio": 0.1}
        >>> round(Traction(0.05, 0.0).power_loss(1000.0, **speeds), 9)
        10.0
        """
        return load * entrainment_speed * (self.sliding * slide_to_roll_ratio + 2.0 * self.rolling)


def traction(
    columns: Columns,
    thickness: Array,
    mesh: Mesh,
    *,
    load: float,
    stress_ratio: float,
    filled: Array | float = 1.0,
) -> Traction:
    """Traction and rolling coefficients of a contact.

    Parameters
    ----------
    columns : Columns
        Stress in the film at the nodes.
    thickness : ndarray, shape (nx, ny)
        Film thickness H.
    mesh : Mesh
        Grid.
    load : float
        Dimensionless load, the integral of P.
    stress_ratio : float
        Stress scale over pressure scale, b/R.
    filled : ndarray, shape (nx, ny), or float
        Part of the gap that the oil fills; the stress of a cavitated film is this part of that of a full one.

    Returns
    -------
    Traction
        Coefficients, dimensionless.
    """
    weights = stress_ratio / load * mesh.weights
    sliding = np.sum(weights * filled * columns.middle[0])
    rolling = np.sum(weights * 0.5 * thickness * columns.gradient[0])
    return Traction(float(sliding), float(rolling))


def filled_part(full_film: Mask, mass: Array) -> Array:
    """Part of the gap that the oil fills behind the rupture of a stationary film.

    Parameters
    ----------
    full_film : ndarray of bool, shape (nx, ny)
        Nodes with a full film.
    mass : ndarray, shape (nx, ny)
        Mass rho H of a full film.

    Returns
    -------
    ndarray, shape (nx, ny)
        One at the nodes with a full film and before the first of them; behind the last of them the mass at
        the last full node over that of a full film, at most one.

    Examples
    --------
    >>> full = np.array([[False], [True], [True], [False]])
    >>> filled_part(full, np.array([[9.0], [2.0], [1.0], [4.0]]))[:, 0].tolist()
    [1.0, 1.0, 1.0, 0.25]
    """
    row = np.arange(len(mass))[:, np.newaxis]
    last = np.maximum.accumulate(np.where(full_film, row, -1), axis=0)
    carried = np.take_along_axis(mass, np.maximum(last, 0), axis=0)
    return np.where(full_film | (last < 0), 1.0, np.minimum(1.0, carried / mass))
