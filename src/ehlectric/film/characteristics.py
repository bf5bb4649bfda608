"""Discretisation of the transient film equations along the lines X - T = const, which Couette flow follows.

Dimensionless, with T = t u/b for the mean speed u of the surfaces, the squeeze term and the wedge term are
one derivative along these lines:

    d(rho H)/dT + d(rho H)/dX = D(rho H)/DT

This derivative is discretised by a backward difference over two steps (BDF2). The mass of the last two
instants is carried along the lines to the nodes. A time step is therefore a Reynolds equation whose wedge
term is the mass at the node times a rate, and whose right side follows from the carried mass.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.levels import SECOND_DIFFERENCE, Level
from ehlectric.film.reynolds import ALONG, Stencil
from ehlectric.film.state import GridSolution

# Distance in grid spacings within which the foot of a line counts as a node.
SAME_NODE = 1e-9


def step_levels(
    levels: list[Level], masses: tuple[Array, Array], steps: tuple[float, float], added_gap: Array
) -> list[Level]:
    """Grids with the Reynolds equation of one time step.

    Parameters
    ----------
    levels : list of Level
        Grids of the stationary contact, from the finest to the coarsest.
    masses : tuple of ndarray, shape (nx, ny)
        Oil mass rho H on the finest grid at the last instant and at the instant before it.
    steps : tuple of float
        Time T from the last instant to the new instant, and from the instant before to the last instant.
    added_gap : ndarray, shape (nx, ny)
        Gap that moving roughness adds on the finest grid at the new instant. A peak adds a negative gap.

    Returns
    -------
    list of Level
        Grids in the order of ``levels``.

    Notes
    -----
    With r = step/last step, the BDF2 weights of the new, the last and the earlier mass are (1 + 2r)/(1 + r),
    -(1 + r) and r^2/(1 + r), all divided by the step. Where the line of the earlier mass begins upstream of
    the inlet, the difference is over one step only.
    """
    finest, mesh = levels[0], levels[0].mesh
    step, last = steps
    ratio = step / last
    here, one, two = np.array([(1 + 2 * ratio) / (1 + ratio), 1 + ratio, -(ratio**2) / (1 + ratio)]) / step
    first = carried(masses[0], step / mesh.dx)
    second = carried(masses[1], (step + last) / mesh.dx)
    outside = mesh.x - mesh.x[0] < (step + last) - SAME_NODE * mesh.dx
    source = np.where(outside[:, np.newaxis], first / step, one * first + two * second)
    source[~mesh.inner] = 0.0
    rates = np.where(outside, 1.0 / step, here)
    new = replace(
        in_time(finest, here), wedge=_mass_term(mesh.shape, rates), dry_gap=finest.dry_gap + added_gap
    )
    return [replace(new, source=source), *(in_time(level, here) for level in levels[1:])]


def in_time(level: Level, rate: float) -> Level:
    """Grid for a transient film, whose wedge term is ``rate`` times the mass at the node itself."""
    wedge = _mass_term(level.mesh.shape, np.full(level.nodes, rate))
    return replace(level, wedge=wedge, rate=rate, distribution=SECOND_DIFFERENCE)


def _mass_term(shape: tuple[int, int], rates: Array) -> Stencil:
    """Operator that multiplies the mass at each position x by its rate (nx,); the two end rows are zero."""
    coefficients = np.zeros((ALONG, *shape))
    coefficients[2, 1:-1] = rates[1:-1, np.newaxis]
    return Stencil(coefficients)


def carried(values: Array, distance: float) -> Array:
    """Nodal values after they have been carried downstream along x.

    Parameters
    ----------
    values : ndarray, shape (nx, ny)
        Values at the nodes.
    distance : float
        Distance in grid spacings, >= 0. For whole numbers the result is exact; otherwise the values are
        interpolated by a cubic.

    Returns
    -------
    ndarray, shape (nx, ny)
        Values at the nodes afterwards. Values from outside the domain are extrapolated by a parabola, which
        is about the shape of the gap there.

    Examples
    --------
    >>> carried(np.arange(5.0)[:, np.newaxis] ** 2, 0.5)[:, 0]
    array([ 0.25,  0.25,  2.25,  6.25, 12.25])
    """
    whole = int(np.floor(distance + SAME_NODE))
    part = distance - whole
    ghosts = whole + 2
    before = parabola_before(values, ghosts)
    beyond = 3.0 * values[-1:] - 3.0 * values[-2:-1] + values[-3:-2]
    padded = np.concatenate([before, values, beyond])
    start, n = ghosts - whole, values.shape[0]
    if abs(part) <= SAME_NODE:
        moved: Array = padded[start : start + n].copy()
        return moved
    weights = zip((-2, -1, 0, 1), lagrange_weights(part), strict=True)
    return np.asarray(np.sum([w * padded[start + k : start + k + n] for k, w in weights], axis=0))


def parabola_before(values: Array, number: int) -> Array:
    """Values at ``number`` nodes upstream of the domain, from the parabola of the first nodes of (nx, ny)."""
    steps = np.arange(-number, 0.0)[:, np.newaxis]
    v0, v1, v2 = values[0], values[1], values[2]
    before: Array = v0 + steps * (-1.5 * v0 + 2.0 * v1 - 0.5 * v2) + steps**2 * (0.5 * v0 - v1 + 0.5 * v2)
    return before


def lagrange_weights(part: float) -> tuple[float, float, float, float]:
    """Weights of the nodes -2, -1, 0 and 1 of a cubic at the position -``part``, between -1 and 0.

    Examples
    --------
    >>> lagrange_weights(0.5)
    (-0.0625, 0.5625, 0.5625, -0.0625)
    """
    return (
        (part + 1.0) * part * (part - 1.0) / 6.0,
        -(part + 1.0) * part * (part - 2.0) / 2.0,
        (part + 1.0) * (part - 1.0) * (part - 2.0) / 2.0,
        -part * (part - 1.0) * (part - 2.0) / 6.0,
    )


def mass_after(step: GridSolution) -> Array:
    """Oil mass rho H after a time step.

    At cavitated nodes it is the mass of the oil that is left, which does not fill the gap.

    Parameters
    ----------
    step : GridSolution
        Solution on the grids of ``step_levels``.

    Returns
    -------
    ndarray, shape (nx, ny)
        Oil mass, dimensionless, not negative.
    """
    level, final = step.level, step.final
    mass = final.coefficients.density * step.state.thickness
    rate = level.wedge.coefficients[2]
    cavitated = ~final.full_film & level.mesh.inner
    flowing = mass[cavitated] - final.reynolds[cavitated] / rate[cavitated]
    mass[cavitated] = np.clip(flowing, 0.0, mass[cavitated])
    mass[-1] = np.minimum(mass[-1], mass[-2])
    return mass


def stationary_mass(stationary: GridSolution) -> Array:
    """Oil mass rho H of a stationary film.

    At cavitated nodes behind X = 0 it is the mass of the oil that flows in.

    Parameters
    ----------
    stationary : GridSolution
        Stationary film with the wedge term of second order.

    Returns
    -------
    ndarray, shape (nx, ny)
        Oil mass, dimensionless, not negative.
    """
    level, final = stationary.level, stationary.final
    full = final.coefficients.density * stationary.state.thickness
    mass = full.copy()
    cavitated = ~final.full_film & level.mesh.inner & (level.mesh.x > 0.0)[:, np.newaxis]
    # Oil that the pressure gradient drives into a node, mainly into the first node behind the full film.
    driven = level.wedge(full) - final.reynolds
    for i in np.flatnonzero(cavitated.any(axis=1)):
        flowing = (4.0 * mass[i - 1] - mass[i - 2] + 2.0 * level.mesh.dx * driven[i]) / 3.0
        mass[i] = np.where(cavitated[i], np.clip(flowing, 0.0, full[i]), full[i])
    mass[-1] = np.minimum(full[-1], mass[-2])
    return mass
