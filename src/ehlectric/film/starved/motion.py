"""Time step of a film with a supply of oil: the oil of cavitated nodes is carried to the meniscus and kept.

A layer of oil travels at the mean speed u along the lines X - T = const until it fills the gap. Where the gap
is filled at the foot of a line, the derivative of the mass along the line is the backward difference over two
steps of ``ehlectric.film.characteristics``. The derivative of the mass at a meniscus is not bounded. Where
the gap is not filled at the foot, it is therefore the difference over one step. Both are differences of one
sum, which the row of the next node takes as it is:

    W = m + D,   D = r/(1 + r) (m - m at the foot) where the foot is filled, 0 elsewhere,
    W(X, T + dT) - W(X - dT, T) = dT [d/dX(eps dP/dX) + d/dY(eps dP/dY)]

Here r is the step over the last step. At the first filled node behind a meniscus, D is the same part of dT
times the slope of the mass to the next node at the last instant. With equal steps, r = 1, the sum of W over
the nodes changes by what crosses the ends of the domain alone. Between steps of different lengths the weight
of the differences in D changes, and the sum of W with it. A film that does not change fulfils the equations
of ``ehlectric.film.starved.content``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.characteristics import SAME_NODE, in_time, lagrange_weights, mass_after, parabola_before
from ehlectric.film.levels import Level
from ehlectric.film.reynolds import ALONG, Stencil
from ehlectric.film.starved.course import StarvedFilm
from ehlectric.film.state import GridSolution


@dataclass(frozen=True)
class Oil:
    """Oil at one instant, from which the next one takes it.

    Attributes
    ----------
    mass : ndarray, shape (nx, ny)
        Mass theta rho H of the oil.
    filled : ndarray of bool, shape (nx, ny)
        Nodes where oil fills the gap, on the inlet edge those where the layer of oil does.
    """

    mass: Array
    filled: Mask

    def at_feet(self, distance: float, values: Array | None = None) -> Array:
        """Mass, or other ``values`` (nx, ny), carried downstream over a distance in grid spacings.

        Where all nodes around the foot of a line are filled, the values are interpolated by a cubic, and
        elsewhere linearly. Both are differences of flows through the faces, so that the sum of the values
        changes by what crosses the ends alone. Upstream of the inlet edge a layer of oil is uniform.
        """
        values = self.mass if values is None else values
        whole, part = _split(distance)
        ghosts = whole + 2
        padded = self._padded(values, ghosts)
        start, n = ghosts - whole, values.shape[0]
        here = padded[start : start + n]
        if part <= SAME_NODE:
            return here.copy()
        filled = self._padded_mask(ghosts)
        (far, near, _, ahead) = lagrange_weights(part)
        # Flow through the face behind each node but the first and the last one, in one step.
        flow = part * padded[1:-1]
        cubic = far * padded[:-2] + (far + near) * padded[1:-1] - ahead * padded[2:]
        smooth = filled[:-2] & filled[1:-1] & filled[2:]
        flow = np.where(smooth, cubic, flow)
        return np.asarray(here - flow[start - 1 : start - 1 + n] + flow[start - 2 : start - 2 + n])

    def filled_feet(self, distance: float) -> Mask:
        """Whether all nodes are filled from which ``at_feet`` takes the value of a node, shape (nx, ny)."""
        whole, part = _split(distance)
        ghosts = whole + 2
        padded, n = self._padded_mask(ghosts), self.filled.shape[0]
        start = ghosts - whole
        around = (0,) if part <= SAME_NODE else (-2, -1, 0, 1)
        return np.asarray(np.all([padded[start + k : start + k + n] for k in around], axis=0))

    @property
    def first(self) -> Mask:
        """First nodes of two and more that are filled behind a node that is not, shape (nx, ny)."""
        first = np.zeros_like(self.filled)
        first[1:-1] = self.filled[1:-1] & self.filled[2:] & ~self.filled[:-2]
        return first

    @property
    def rise(self) -> Array:
        """Mass at the next node minus that at the node, shape (nx, ny)."""
        return np.append(np.diff(self.mass, axis=0), np.zeros_like(self.mass[:1]), axis=0)

    def _padded(self, values: Array, ghosts: int) -> Array:
        before = np.where(self.filled[0], parabola_before(values, ghosts), values[0])
        return np.concatenate([before, values, values[-1:]])

    def _padded_mask(self, ghosts: int) -> Mask:
        before = np.repeat(self.filled[:1], ghosts, axis=0)
        return np.concatenate([before, self.filled, self.filled[-1:]])


def _split(distance: float) -> tuple[int, float]:
    """Whole number of grid spacings in a distance, and the rest, which is 0 up to rounding or above."""
    whole = int(np.floor(distance + SAME_NODE))
    return whole, distance - whole


def sums(now: Oil, before: Oil, last: float, ratio: float) -> Array:
    """Sum W of mass and difference at the last instant, from which the next step starts, shape (nx, ny).

    ``last`` is the last step in grid spacings, and ``ratio`` the next step over the last step.
    """
    difference = np.where(before.filled_feet(last), now.mass - before.at_feet(last), 0.0)
    difference = np.where(before.first, last * before.rise, difference)
    return now.mass + ratio**2 / (1.0 + ratio) * difference


def supplied_step_levels(
    levels: list[Level], instants: tuple[Oil, Oil], steps: tuple[float, float], added_gap: Array
) -> list[Level]:
    """Grids with the Reynolds equation of one time step of a film with a supply of oil.

    Parameters
    ----------
    levels : list of Level
        Grids of the stationary contact, from the finest to the coarsest.
    instants : tuple of Oil
        Oil at the last instant and at the instant before it.
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
    On lines that are filled at the inlet edge the scheme is that of ``characteristics.step_levels``.
    """
    finest, mesh = levels[0], levels[0].mesh
    (now, before), (step, last) = instants, steps
    ratio, dx = step / last, mesh.dx
    second = ratio / (1.0 + ratio)
    feet, filled = now.at_feet(step / dx), now.filled_feet(step / dx)
    # A flooded line has no difference over two steps where its first foot lies upstream of the inlet.
    outside = (mesh.x - mesh.x[0] < (step + last) - SAME_NODE * dx)[:, np.newaxis] & now.filled[0]
    filled &= ~outside & ~now.first
    carried = now.at_feet(step / dx, sums(now, before, last / dx, ratio))
    carried = np.where(outside, feet, carried)
    rates = np.where(filled, 1.0 + second, 1.0) / step
    behind = np.where(now.first, -step / dx * now.rise, 0.0)
    source = (carried + second * np.where(filled, feet, behind)) / step
    source[~mesh.inner] = 0.0
    here = (1.0 + second) / step
    coefficients = np.zeros((ALONG, *mesh.shape))
    coefficients[2, 1:-1] = rates[1:-1]
    new = replace(
        in_time(finest, here),
        wedge=Stencil(coefficients),
        dry_gap=finest.dry_gap + added_gap,
        source=source,
    )
    return [new, *(in_time(level, here) for level in levels[1:])]


def oil_after(step: GridSolution, layer: Array) -> Oil:
    """Oil after a time step on the grids of ``supplied_step_levels``.

    ``layer`` (ny,) is the mass of the layer of oil that is supplied at the inlet edge.
    """
    return supplied(step, mass_after(step), layer)


def supplied(solution: GridSolution, mass: Array, layer: Array) -> Oil:
    """Oil of a solution with a known mass (nx, ny) inside the domain: on its edges there is the layer."""
    full = solution.final.coefficients.density * solution.state.thickness
    filled = solution.final.full_film.copy()
    filled[0] = layer >= full[0]
    layered = solution.level.mesh.edge.copy()
    layered[0], layered[-1] = ~filled[0], False
    mass = np.where(layered, np.minimum(full, layer), mass)
    mass[-1] = np.minimum(full[-1], mass[-2])
    return Oil(mass, filled)


def stationary_oil(film: StarvedFilm) -> Oil:
    """Oil of a stationary starved film, from which the time steps start."""
    content = film.content
    full = content.residual.coefficients.density * film.solution.state.thickness
    return Oil(np.clip(content.mass, 0.0, full), content.filled)
