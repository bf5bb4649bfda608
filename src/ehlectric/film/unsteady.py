"""Transient film of a contact with moving roughness, computed in time steps.

Dimensionless, with T = t u/b for the mean speed u of the surfaces:

    d(rho H)/dT + d(rho H)/dX - d/dX(eps dP/dX) - d/dY(eps dP/dY) = 0

The squeeze term and the wedge term are one derivative along the lines X - T = const, on which the Couette
flow carries the oil (``ehlectric.film.characteristics``). It is discretised along these lines by a backward
difference over two steps. A film that is carried through the Hertz zone therefore keeps its shape. With time
steps as long as the grid spacing the lines begin at nodes, and nothing is interpolated. Without motion the
film is then equal to that of the stationary scheme of second order, to the last digit. Where the film is
cavitated, its mass is the oil that flows in, which does not fill the gap. With a layer of oil at the inlet
edge this is so ahead of the contact as well (``ehlectric.film.starved.motion``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.errors import ConvergenceError
from ehlectric.film.characteristics import mass_after, stationary_mass, step_levels
from ehlectric.film.levels import Level
from ehlectric.film.mixed.newton import mixed_newton
from ehlectric.film.nested import levels_of
from ehlectric.film.newton import assess, newton
from ehlectric.film.problem import FilmProblem
from ehlectric.film.starved.course import StarvedFilm
from ehlectric.film.starved.motion import Oil, oil_after, stationary_oil, supplied_step_levels
from ehlectric.film.state import GridSolution, State

# Tolerance of the residual in a time step, a pressure over p_h, far below the discretisation error of the
# step.
STEP_TOLERANCE = 1e-6

# Largest numbers of Newton steps before a time step is halved: from the better of two initial guesses, the
# extrapolated and the last film, and from the other one.
_FEW_ITERATIONS, _MANY_ITERATIONS = 8, 30

# Largest number of times that a time step is halved.
_MOST_HALVINGS = 6

# Smallest gap of an extrapolated film that may be an initial guess, as a fraction of the last smallest gap.
_LEAST_START = 0.3

# Change of P in a time step above which the pressure of a node is not extrapolated: a spike passes the node.
_MOST_CHANGE = 0.1

# Largest distance that oil travels in a time step, in grid spacings.
MOST_COURANT = 8.0

# Why a film with a layer of oil at the inlet is not solved where it is thinner than the boundary film: the
# solver of films that touch has no part of the gap without oil, and would make oil.
TOUCHING = (
    "it is thinner than contact.boundary_film in places, and surfaces that touch are not solved with [inlet]"
)

# Gap that moving roughness adds: function of T, X (nx,) and Y (ny,) -> (nx, ny).
MovingGap: TypeAlias = Callable[[float, Array, Array], Array]


@dataclass(frozen=True)
class Instant:
    """Transient film at one instant of time, dimensionless.

    Attributes
    ----------
    time : float
        Time T.
    state : State
        Pressure P, rigid displacement H00 and film thickness H.
    mass : ndarray, shape (nx, ny)
        Oil mass rho H; where the film is cavitated, the mass of the oil that is left.
    density : ndarray, shape (nx, ny)
        Density ratio rho/rho_0.
    full_film : ndarray of bool, shape (nx, ny)
        Nodes with a full film; on the inlet edge, those that a given layer of oil fills.
    """

    time: float
    state: State
    mass: Array
    density: Array
    full_film: Mask

    @property
    def oil(self) -> Oil:
        """Mass of oil, and the nodes that it fills."""
        return Oil(self.mass, self.full_film)

    @property
    def oil_fraction(self) -> Array:
        """Part of the gap that oil fills, 0 to 1, shape (nx, ny)."""
        part = self.mass / (self.density * self.state.thickness)
        return np.where(self.full_film, 1.0, np.clip(part, 0.0, 1.0))


@dataclass(frozen=True)
class Effort:
    """Computational work of a time step.

    Attributes
    ----------
    newton : int
        Number of Newton steps.
    krylov : int
        Number of GMRES iterations in all Newton steps.
    halvings : int
        Number of times that a step was halved.
    """

    newton: int = 0
    krylov: int = 0
    halvings: int = 0

    def __add__(self, other: Effort) -> Effort:
        return Effort(self.newton + other.newton, self.krylov + other.krylov, self.halvings + other.halvings)


@dataclass(frozen=True)
class History:
    """Last two instants of a transient film, from which the next follows.

    Attributes
    ----------
    now, before : Instant
        Last instant and the instant before it.
    effort : Effort
        Work of the last step.
    """

    now: Instant
    before: Instant
    effort: Effort = Effort()


class UnsteadyFilm:
    """Solver for the transient film of a contact with moving roughness.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact, with the wedge term of second order. Its ``added_gap`` is the
        roughness that does not move.
    moving_gap : callable
        Gap that moving roughness adds: function of T, X (nx,) and Y (ny,) -> (nx, ny). A peak adds a negative
        gap.
    layer : ndarray, shape (ny,), optional
        Thickness H of the layer of oil at the inlet edge; None for a flooded inlet.
    """

    def __init__(self, problem: FilmProblem, moving_gap: MovingGap, layer: Array | None = None) -> None:
        self.problem, self.layer = problem, layer
        self._moving_gap = moving_gap
        self._levels = levels_of(replace(problem, wedge_order=2))

    @property
    def level(self) -> Level:
        """Finest grid, with the operators of the stationary film."""
        return self._levels[0]

    def start(self, steady: GridSolution, step: float) -> History:
        """History that starts from a stationary film.

        Parameters
        ----------
        steady : GridSolution
            Stationary film on the same grid.
        step : float
            Time T between the two instants, > 0.

        Returns
        -------
        History
            The stationary film at T = 0 and at T = -step.
        """
        density = steady.final.coefficients.density
        now = Instant(0.0, steady.state, stationary_mass(steady), density, steady.final.full_film)
        return History(now, replace(now, time=-step))

    def start_supplied(self, steady: StarvedFilm, step: float) -> History:
        """History that starts from a stationary film with a layer of oil; see ``start``."""
        oil, final = stationary_oil(steady), steady.solution.final
        now = Instant(0.0, steady.solution.state, oil.mass, final.coefficients.density, oil.filled)
        return History(now, replace(now, time=-step))

    def advance(self, history: History, step: float) -> History:
        """Advance the film by one time step, which is halved until the film equations converge.

        Parameters
        ----------
        history : History
            Last two instants.
        step : float
            Length of the step in T, at most ``MOST_COURANT`` grid spacings.

        Returns
        -------
        History
            Last two instants after the step, with the work of the step.

        Raises
        ------
        ConvergenceError
            If the film equations do not converge after six halvings, or a film with a layer of oil is thinner
            than the boundary film somewhere.
        """
        return self._advance(replace(history, effort=Effort()), step, _MOST_HALVINGS)

    def _advance(self, history: History, step: float, halvings: int) -> History:
        instant, effort = self._stepped(history, step)
        effort = history.effort + effort
        if instant is not None:
            return History(instant, history.now, effort)
        if not halvings:
            raise ConvergenceError(
                f"film at T = {history.now.time + step:.6g}, although the time step was halved "
                f"{_MOST_HALVINGS} times"
            )
        halved = replace(history, effort=effort + Effort(halvings=1))
        for _ in range(2):
            halved = self._advance(halved, 0.5 * step, halvings - 1)
        return halved

    def _stepped(self, history: History, step: float) -> tuple[Instant | None, Effort]:
        """Instant one step later, or None if Newton's method does not converge, with the work."""
        time = history.now.time + step
        levels = self._levels_at(history, step)
        effort = Effort()
        starts = self._starts(levels, history, step)
        limits = [_FEW_ITERATIONS, _MANY_ITERATIONS][-len(starts) :]
        for (start, spike), iterations in zip(starts, limits, strict=True):
            if history.now.state.touching.any():
                break
            solution = newton(
                self.problem.fluid,
                levels,
                start,
                tolerance=max(self.problem.tolerance, STEP_TOLERANCE),
                max_iterations=iterations,
                min_iterations=1,
                eliminate_spike=spike,
                transient=True,
            )
            krylov = sum(one.krylov_iterations for one in solution.steps)
            effort += Effort(len(solution.steps), krylov)
            if solution.status == "converged":
                if float(solution.state.thickness.min()) < self.problem.boundary_film:
                    if self.layer is not None:
                        raise ConvergenceError(f"film at T = {time:.6g}: {TOUCHING}")
                    break
                return self._instant(time, solution), effort
        if self.problem.boundary_film > 0.0 and self.layer is None:
            solution = self._touching(levels, history)
            effort += Effort(len(solution.steps), sum(one.krylov_iterations for one in solution.steps))
            if solution.status == "converged":
                return self._instant(time, solution), effort
        return None, effort

    def _touching(self, levels: list[Level], history: History) -> GridSolution:
        """Film after a time step in which the surfaces touch or part, from the last film."""
        last = history.now.state
        return mixed_newton(
            self.problem.fluid,
            levels,
            State.of(levels[0], last.pressure, last.h00, last.contact_pressure),
            asperities=self.problem.asperities,
            tolerance=max(self.problem.tolerance, STEP_TOLERANCE),
            max_iterations=_MANY_ITERATIONS,
            first_damping=0.0,
        )

    def _starts(self, levels: list[Level], history: History, step: float) -> list[tuple[State, bool]]:
        """Initial guesses of a time step: the last film and, unless it is too thin, the extrapolated film.

        Each comes with a flag whether to solve the pressure spike separately. The guess with the smaller
        residual comes first. Where short waves pass, this is often the last film.
        """
        now, before = history.now.state, history.before.state
        ratio = step / (history.now.time - history.before.time)
        ambient = self.problem.fluid.ambient_pressure
        change = ratio * (now.pressure - before.pressure)
        change[np.abs(change) > _MOST_CHANGE] = 0.0
        pressure = np.maximum(now.pressure + change, ambient)
        h00 = now.h00 + ratio * (now.h00 - before.h00)
        least = _LEAST_START * float(now.thickness.min())
        last = State.of(levels[0], now.pressure, now.h00).lifted(least)
        starts = [(last, self.problem.width is None)]
        extrapolated = State.of(levels[0], pressure, h00)
        if float(extrapolated.thickness.min()) >= least:
            starts.append((extrapolated, False))
        return sorted(starts, key=lambda start: assess(self.problem.fluid, levels[0], start[0]).norm)

    def _levels_at(self, history: History, step: float) -> list[Level]:
        """All grids with the Reynolds equation of the next time step."""
        now, before = history.now, history.before
        mesh, steps = self.level.mesh, (step, now.time - before.time)
        added = self._moving_gap(now.time + step, mesh.x, mesh.y)
        if self.layer is not None:
            return supplied_step_levels(self._levels, (now.oil, before.oil), steps, added)
        return step_levels(self._levels, (now.mass, before.mass), steps, added)

    def _instant(self, time: float, solution: GridSolution) -> Instant:
        """Instant after a time step that was solved."""
        density = solution.final.coefficients.density
        if self.layer is None:
            mass, full_film = mass_after(solution), solution.final.full_film
        else:
            oil = oil_after(solution, density[0] * self.layer)
            mass, full_film = oil.mass, oil.filled
        return Instant(time, solution.state, mass, density, full_film)
