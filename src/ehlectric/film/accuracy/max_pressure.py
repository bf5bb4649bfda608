"""Error estimate of the maximum pressure: peaks over asperities and the pressure spike between the nodes."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import maximum_filter

from ehlectric.arrays import Array
from ehlectric.film.accuracy.between_grids import change_near, position
from ehlectric.film.mesh import Mesh
from ehlectric.film.state import GridSolution

# Part of the fourth difference by which a peak between the nodes may exceed its node. On 692 grids of random
# rough contacts the true error exceeded the estimate in 6 % with 0.33, in 4 % with 0.4, in 2.5 % with 0.5. On
# 1055 grids of random smooth contacts a spike that grew on finer grids exceeded it by 60 % with 0.4, and by
# 11 % with 0.5.
_PART = 0.5

# Smallest estimate, as maxima on two grids may agree by chance.
_LEAST_ESTIMATE = 5e-5

# Estimated relative error above which the grid does not resolve the maximum pressure.
UNRESOLVED = 0.3


def max_pressure_error(fine: GridSolution, coarse: GridSolution | None) -> float | None:
    """Relative error of the maximum pressure of a film.

    Parameters
    ----------
    fine : GridSolution
        Film on the grid of the problem.
    coarse : GridSolution or None
        Film on the next coarser grid for the same surfaces.

    Returns
    -------
    float or None
        Relative error, which may be above 1; a value above about 0.3 says that the grid does not resolve the
        highest peak of the pressure. None if there is no coarser grid, or if either solution did not
        converge.

    Notes
    -----
    The pressure does not converge as the film does. It is a derivative of the deflection, so that short waves
    of the roughness, which hardly change the film, are high peaks of the pressure. The pressure spike at the
    outlet is narrower than the spacing of most grids and grows with every finer grid. Its height on two grids
    may agree by chance, and it may exceed all other peaks on the next grid only.

    The estimate is therefore taken from one grid, too. Where the grid resolves a peak, the fourth difference
    of the pressure falls by 16 from grid to grid. At a spike or step from one node to the next it is several
    times the height of the step. Half of it is added to the pressure of every node. An eighth of the
    second difference is added too, by which the peak of a parabola exceeds three nodes at most. The estimate
    is what the largest sum exceeds the maximum, or the change of the maximum, or of the pressure near it,
    from the coarser grid, whichever is largest.
    """
    if coarse is None or fine.status != "converged" or coarse.status != "converged":
        return None
    grids = [(grid.level.mesh, np.maximum(grid.state.pressure, 0.0)) for grid in (fine, coarse)]
    peaks = [position(mesh, int(np.argmax(pressure))) for mesh, pressure in grids]
    highest, before = (float(np.max(pressure)) for _, pressure in grids)
    change = max(abs(highest - before), change_near(grids[0], grids[1], peaks))
    return max(change / highest, between_nodes(*grids[0]) / highest, _LEAST_ESTIMATE)


def between_nodes(mesh: Mesh, pressure: Array) -> float:
    """Amount by which the pressure between the nodes may exceed its largest nodal value.

    Parameters
    ----------
    mesh : Mesh
        Grid.
    pressure : ndarray, shape (nx, ny)
        Pressure P at the nodes, not negative.

    Returns
    -------
    float
        Excess over the largest nodal value, in the unit of the pressure, not negative.

    Examples
    --------
    A parabola exceeds its nodes by an eighth of its second difference; a step of 0.5 is not resolved:

    >>> import numpy as np
    >>> mesh = Mesh.over(101, -1.0, 1.0)
    >>> parabola = 1.0 - mesh.x[:, np.newaxis] ** 2
    >>> round(between_nodes(mesh, parabola), 6)
    0.0001
    >>> round(between_nodes(mesh, np.where(mesh.x[:, np.newaxis] < 0.01, 1.0, 0.5)), 4)
    0.8125
    """
    whole = mesh.mirrored(pressure)
    of_parabola, difference = np.zeros_like(whole), np.zeros_like(whole)
    for values, parabola, fourth in (
        (whole, of_parabola, difference),
        (whole.T, of_parabola.T, difference.T),
    ):
        if len(values) > 4:
            parabola[1:-1] += np.abs(np.diff(values, 2, axis=0)) / 8.0
            fourth[2:-2] = np.maximum(fourth[2:-2], np.abs(np.diff(values, 4, axis=0)))
    near = maximum_filter(difference, size=(3, 1 if whole.shape[1] == 1 else 3))
    return max(0.0, float(np.max(whole + of_parabola + _PART * near)) - float(np.max(whole)))
