"""The film in time: surfaces whose roughness moves, one time step after the other.

Dimensionless, with T = t u/b for the mean speed u of the surfaces:

    d(rho H)/dT + d(rho H)/dX - d/dX(eps dP/dX) - d/dY(eps dP/dY) = 0

The first two terms are one derivative along the lines X - T = const, on which oil travels: differenced there,
backwards over two steps, what is carried through the flat zone keeps its shape. With steps as long as the
grid spacing the feet of these lines are nodes, nothing is interpolated, and a film at rest is that of the
steady scheme of second order to the last digit. Where the film cavitates, its mass is what flows in, not what
the gap would hold.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.errors import ConvergenceError
from ehlectric.film.levels import SECOND_DIFFERENCE, Level, hierarchy
from ehlectric.film.newton import GridSolution, State, newton
from ehlectric.film.problem import FilmProblem
from ehlectric.film.reynolds import ALONG, Stencil

# A time step is solved to this residual, a pressure, far below what the step itself misses.
STEP_TOLERANCE = 1e-6

# Newton steps from the better of the extrapolated film and the last one, and from the other, before a time
# step is halved; and how often that may be.
FEW_ITERATIONS, MANY_ITERATIONS = 8, 30
MOST_HALVINGS = 6

# Part of the last smallest gap below which an extrapolated one is no start.
LEAST_START = 0.3

# Change of P in a step above which a spike passes a node, and nothing can be extrapolated there.
MOST_CHANGE = 0.1

# Grid spacings that oil may travel in a time step.
MOST_COURANT = 8.0

# Part of a grid spacing within which the foot of a line is a node.
_SAME_NODE = 1e-9
MovingGap = Callable[[float, Array, Array], Array]  # T, X (nx,), Y (ny,) -> G (nx, ny)


@dataclass(frozen=True)
class Instant:
    """The film at a time.

    Attributes
    ----------
    time : float
        T.
    state : State
        P, H00 and H.
    mass : ndarray, shape (nx, ny)
        rho H, where the film cavitates what there is of it.
    density : ndarray, shape (nx, ny)
        rho.
    free : ndarray of bool, shape (nx, ny)
        Where the film is full.
    """

    time: float
    state: State
    mass: Array
    density: Array
    free: Mask


@dataclass(frozen=True)
class Effort:
    """What a time step took: its Newton steps, their GMRES iterations, and how often it was halved."""

    newton: int = 0
    krylov: int = 0
    halvings: int = 0

    def __add__(self, other: Effort) -> Effort:
        return Effort(self.newton + other.newton, self.krylov + other.krylov, self.halvings + other.halvings)


@dataclass(frozen=True)
class History:
    """The last two instants, from which the next follows, and what the last step took."""

    now: Instant
    before: Instant
    effort: Effort = Effort()


class UnsteadyFilm:
    """The equations of a contact whose gap moves.

    Parameters
    ----------
    problem : FilmProblem
        The contact, the wedge of second order, with the gap that stands still alone in ``added_gap``.
    moving_gap : callable
        What roughness adds to the gap at a time, T, X (nx,), Y (ny,) -> (nx, ny); a peak adds a negative one.
    """

    def __init__(self, problem: FilmProblem, moving_gap: MovingGap) -> None:
        self.problem = problem
        self._moving_gap = moving_gap
        dry = problem.geometry.dry_gap
        standing = problem.added_gap
        self._levels = hierarchy(
            problem.nodes,
            inlet=problem.inlet,
            outlet=problem.outlet,
            geometry=problem.geometry
            if standing is None
            else replace(problem.geometry, dry_gap=lambda x, y: dry(x, y) + standing(x, y)),
            second_order=True,
            width=problem.width,
        )

    @property
    def level(self) -> Level:
        """The finest grid."""
        return self._levels[0]

    def start(self, steady: GridSolution, step: float) -> History:
        """The history of a film that has been steady, solved on the same grid.

        ``step`` is the time since the instant before.
        """
        full = steady.final.coefficients.density * steady.state.thickness
        mass = full.copy()
        empty = ~steady.final.free & self.level.mesh.inner & (self.level.mesh.x > 0.0)[:, np.newaxis]
        # What the pressure drives into a node, most of all into the first beyond the full film.
        driven = steady.level.wedge(full) - steady.final.reynolds
        for i in np.flatnonzero(empty.any(axis=1)):
            flowing = (4.0 * mass[i - 1] - mass[i - 2] + 2.0 * steady.level.mesh.dx * driven[i]) / 3.0
            mass[i] = np.where(empty[i], np.clip(flowing, 0.0, full[i]), full[i])
        mass[-1] = np.minimum(full[-1], mass[-2])
        density = steady.final.coefficients.density
        now = Instant(0.0, steady.state, mass, density, steady.final.free)
        return History(now, replace(now, time=-step))

    def advance(self, history: History, step: float) -> History:
        """The history one time step further; where that is not solved, by two halves of it, and so on.

        Parameters
        ----------
        history : History
            Up to now.
        step : float
            Of T, at most ``MOST_COURANT`` grid spacings.

        Returns
        -------
        History
            With what the step took.

        Raises
        ------
        ConvergenceError
            Where ``MOST_HALVINGS`` do not help.
        """
        return self._advance(replace(history, effort=Effort()), step, MOST_HALVINGS)

    def _advance(self, history: History, step: float, halvings: int) -> History:
        instant, effort = self._stepped(history, step)
        effort = history.effort + effort
        if instant is not None:
            return History(instant, history.now, effort)
        if not halvings:
            raise ConvergenceError(
                f"film not found at T = {history.now.time + step:.6g}, the step halved {MOST_HALVINGS} times"
            )
        halved = replace(history, effort=effort + Effort(halvings=1))
        for _ in range(2):
            halved = self._advance(halved, 0.5 * step, halvings - 1)
        return halved

    def _stepped(self, history: History, step: float) -> tuple[Instant | None, Effort]:
        """The instant a step further, None where Newton's method does not find it."""
        time = history.now.time + step
        levels = self._levels_at(history, step)
        effort = Effort()
        starts = self._starts(levels, history, step)
        limits = [FEW_ITERATIONS, MANY_ITERATIONS][-len(starts) :]
        for (start, spike), iterations in zip(starts, limits, strict=True):
            solution = newton(
                self.problem.fluid,
                levels,
                start,
                tolerance=max(self.problem.tolerance, STEP_TOLERANCE),
                max_iterations=iterations,
                min_iterations=1,
                eliminate_spike=spike,
            )
            krylov = sum(one.krylov_iterations for one in solution.steps)
            effort += Effort(len(solution.steps), krylov)
            if solution.status == "converged":
                return self._instant(time, solution), effort
        return None, effort

    def _starts(self, levels: list[Level], history: History, step: float) -> list[tuple[State, bool]]:
        """States to start from, each with whether a spike stands out: the extrapolated film and the last one.

        The one of the smaller residual first: where short waves pass, nothing goes on as it did.
        """
        now, before = history.now.state, history.before.state
        ratio = step / (history.now.time - history.before.time)
        ambient = self.problem.fluid.ambient_pressure
        change = ratio * (now.pressure - before.pressure)
        change[np.abs(change) > MOST_CHANGE] = 0.0
        pressure = np.maximum(now.pressure + change, ambient)
        h00 = now.h00 + ratio * (now.h00 - before.h00)
        least = LEAST_START * float(now.thickness.min())
        last = State.of(levels[0], now.pressure, now.h00).lifted(least)
        starts = [(last, self.problem.width is None)]
        extrapolated = State.of(levels[0], pressure, h00)
        if float(extrapolated.thickness.min()) >= least:
            starts.append((extrapolated, False))
        return sorted(starts, key=lambda start: self._missed(levels, start[0]))

    def _missed(self, levels: list[Level], state: State) -> float:
        """Residual of a state."""
        return newton(self.problem.fluid, levels, state, tolerance=0.0, max_iterations=0).final.norm

    def _levels_at(self, history: History, step: float) -> list[Level]:
        """All grids with the equation of one time step, backward differences over two along the lines X - T.

        Where the second foot lies before the inlet, over one.
        """
        finest, mesh = self._levels[0], self._levels[0].mesh
        last = history.now.time - history.before.time
        ratio = step / last
        here, one, two = (
            np.array([(1 + 2 * ratio) / (1 + ratio), 1 + ratio, -(ratio**2) / (1 + ratio)]) / step
        )
        first = carried(history.now.mass, step / mesh.dx)
        second = carried(history.before.mass, (step + last) / mesh.dx)
        outside = mesh.x - mesh.x[0] < (step + last) - _SAME_NODE * mesh.dx
        source = np.where(outside[:, np.newaxis], first / step, one * first + two * second)
        source[~mesh.inner] = 0.0
        added = self._moving_gap(history.now.time + step, mesh.x, mesh.y)
        levels = [in_time(level, here) for level in self._levels]
        levels[0].wedge.coefficients[2, outside] = 1.0 / step
        levels[0].wedge.coefficients[2, 0] = 0.0
        levels[0] = replace(levels[0], dry_gap=finest.dry_gap + added, source=source)
        return levels

    def _instant(self, time: float, solution: GridSolution) -> Instant:
        """What a solved step leaves; held nodes have the mass that flows in."""
        level, final = solution.level, solution.final
        density = final.coefficients.density
        mass = density * solution.state.thickness
        rate = level.wedge.coefficients[2]
        held = ~final.free & level.mesh.inner
        flowing = mass[held] - final.reynolds[held] / rate[held]
        mass[held] = np.clip(flowing, 0.0, mass[held])
        mass[-1] = np.minimum(mass[-1], mass[-2])
        return Instant(time, solution.state, mass, density, final.free)


def in_time(level: Level, rate: float) -> Level:
    """A grid whose mass term is ``rate`` times the mass at the node itself."""
    coefficients = np.zeros((ALONG, *level.mesh.shape))
    coefficients[2, 1:-1] = rate
    return replace(level, wedge=Stencil(coefficients), rate=rate, distribution=SECOND_DIFFERENCE)


def carried(values: Array, distance: float) -> Array:
    """Nodal values (nx, ny) carried along x by some grid spacings: exact by whole ones, else by a cubic.

    What comes from beyond the ends is extrapolated by a parabola, as the gap there is about one.

    Examples
    --------
    >>> carried(np.arange(5.0)[:, np.newaxis] ** 2, 0.5)[:, 0]
    array([ 0.25,  0.25,  2.25,  6.25, 12.25])
    """
    whole = int(np.floor(distance + _SAME_NODE))
    part = distance - whole
    ghosts = whole + 2
    steps = np.arange(-ghosts, 0.0)[:, np.newaxis]
    v0, v1, v2 = values[0], values[1], values[2]
    before = v0 + steps * (-1.5 * v0 + 2.0 * v1 - 0.5 * v2) + steps**2 * (0.5 * v0 - v1 + 0.5 * v2)
    beyond = 3.0 * values[-1:] - 3.0 * values[-2:-1] + values[-3:-2]
    padded = np.concatenate([before, values, beyond])
    start, n = ghosts - whole, values.shape[0]
    if abs(part) <= _SAME_NODE:
        moved: Array = padded[start : start + n].copy()
        return moved
    # Lagrange's weights of the nodes two behind, one behind, at, and one ahead.
    weights = (
        (-2, (part + 1.0) * part * (part - 1.0) / 6.0),
        (-1, -(part + 1.0) * part * (part - 2.0) / 2.0),
        (0, (part + 1.0) * (part - 1.0) * (part - 2.0) / 2.0),
        (1, -part * (part - 1.0) * (part - 2.0) / 6.0),
    )
    return np.asarray(np.sum([w * padded[start + k : start + k + n] for k, w in weights], axis=0))
