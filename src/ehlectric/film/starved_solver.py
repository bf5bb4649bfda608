"""Starved films on one grid, and flooded films that form again behind a cavity.

A flooded film may form again behind a cavity, as between the peaks of a rough surface. The wedge term of
``ehlectric.film.newton`` counts a cavitated gap as full. That is exact where no oil fills the gap any more
behind a cavity. Elsewhere it makes the oil that is missing in the cavity. There the content of oil is carried
through the cavity, as in a starved film (``ehlectric.film.oil_content``) whose inlet is flooded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.dry_contact import dry_contact
from ehlectric.film.levels import Level
from ehlectric.film.mesh import at_centre
from ehlectric.film.newton import Asperities, GridProblem, GridSolution, Guess, State
from ehlectric.film.oil_content import SCHEMES, USUAL, Carried, Scheme, Supply, carried_rows
from ehlectric.film.problem import FilmProblem
from ehlectric.film.touching_newton import touching_newton

# Largest number of Newton steps from a solution whose scheme has lower order at some nodes.
_AGAIN = 25

# Part of the tolerance to which it is solved then.
_CLOSER = 0.01


def forms_again(full_film: Mask) -> bool:
    """Whether oil fills a node behind a cavitated one on its line along entrainment, inside of the domain.

    Examples
    --------
    Behind the exit the film is cavitated up to the end of the domain; in the second film it forms again:

    >>> once = np.array([[False], [True], [True], [False], [False], [False]])
    >>> again = np.array([[False], [True], [False], [True], [False], [False]])
    >>> forms_again(once), forms_again(again)
    (False, True)
    """
    inner = full_film[1:-1]
    behind = np.logical_or.accumulate(~inner, axis=0)
    return bool(np.any(inner & behind))


# Damping of the first Newton step of a film that did not converge without damping.
FIRST_DAMPING = 1.0


def conserving_film(problem: GridProblem, start: tuple[State, Mask], order: int) -> GridSolution:
    """Last iterate, with its content of oil, of a film on one grid that conserves its oil.

    ``order`` is the order of the wedge term where oil fills the gap. The surfaces are apart. If Newton's
    method does not converge from the start, its first step is damped: over rough surfaces, a full step from
    the film of a coarser grid may empty valleys that take many steps to fill again.
    """
    state, filled = start
    guess = Guess(replace(state, contact_pressure=0.0), with_inlet(filled))
    apart, films = replace(problem, asperities=Asperities()), []
    # The last scheme differs only where surfaces may touch.
    for scheme in SCHEMES[:-1]:
        for damping in (0.0, FIRST_DAMPING):
            solved = isothermal(apart, first_damping=damping)
            films.append(solved(guess, flooded_inlet(problem.level, order, scheme)))
            if films[-1].status == "converged":
                return films[-1]
    return films[0]


def flooded_inlet(level: Level, order: int, scheme: Scheme = USUAL) -> Supply:
    """Supply of more oil than any gap takes, at the lines of a grid."""
    return Supply(np.full(level.mesh.y.size, np.inf), order, scheme=scheme)


def with_inlet(filled: Mask) -> Mask:
    """Mask of filled nodes (nx, ny) with the nodes of the inlet edge."""
    flooded = filled.copy()
    flooded[0] = True
    return flooded


def oil_fraction(solution: GridSolution, order: int) -> Array:
    """Part of the gap that oil fills, shape (nx, ny), also of a solution that does not carry it."""
    if solution.fraction is not None:
        return solution.fraction
    level, at_faces = solution.level, solution.final.flow
    full = at_faces.carried(solution.state.thickness, level.mesh.dx)
    filled = with_inlet(solution.final.full_film)
    carried = Carried(flooded_inlet(level, order), filled)
    _, mass = carried_rows(level, at_faces, solution.state.thickness, carried)
    return replace(carried, mass=mass).fraction(full)


# Multiple of the layer of oil above which the inlet of an initial guess is not filled.
_FILLED = 3.0

# Smallest gap of an initial guess over the layer of oil.
_LEAST_GAP = 0.5

# Films thinner than this part of the flooded one start from the pressure of the dry contact first.
_DRY = 0.15

# Factor of the layer between two steps: at first, and the one closest to 1 with which the steps end.
_FALL, _LEAST_FALL = 0.6, 0.97

# Largest number of films with a layer between the flooded film and the layer asked for.
_MOST_STEPS = 40


def of_full_order(problem: GridProblem, film: GridSolution, supply: Supply) -> GridSolution:
    """Solution whose nodes have no upwind difference that it does not need, and whose oil balances closely.

    Nodes that changed their state in turn got such a difference. A residual that is small as a pressure may
    be much oil where the gap is wide. The film is solved again under a supply without such differences, to a
    smaller residual first; where both miss their tolerance, the solution stays.
    """
    if film.status != "converged" or film.content is None:
        return film
    start, filled, steps = film.state, film.content.filled, film.steps
    for closer in (_CLOSER * problem.tolerance, problem.tolerance):
        posed = replace(problem, max_iterations=_AGAIN, tolerance=closer)
        again = touching_newton(posed, start, first_damping=0.0, carried=Carried(supply, filled))
        steps += again.steps
        if again.status == "converged":
            return replace(again, steps=steps)
        if min(again.final.norm, *(step.residual for step in again.steps)) > problem.tolerance:
            # The steps to the larger residual do not change.
            break
        if again.final.norm <= problem.tolerance and again.content is not None:
            start, filled = again.state, again.content.filled
    return film


# Film on one grid from an initial guess and a supply of oil.
Solver: TypeAlias = Callable[[Guess, Supply], GridSolution]


def isothermal(
    posed: GridProblem, *, full_order: bool = True, min_iterations: int = 0, first_damping: float = 0.0
) -> Solver:
    """Solver of films on one grid without heat; ``full_order`` as in ``of_full_order``.

    ``min_iterations`` and ``first_damping`` belong to the first solution, from the guess.
    """

    def film(guess: Guess, supply: Supply) -> GridSolution:
        of_first_order = touching_newton(
            posed,
            guess.state,
            first_damping=first_damping,
            carried=Carried(supply, guess.filled),
            min_iterations=min_iterations,
        )
        return of_full_order(posed, of_first_order, supply.of_full_order) if full_order else of_first_order

    return film


@dataclass(frozen=True)
class StarvedProblem:
    """Starved film to be solved on one grid, with the flooded film."""

    problem: FilmProblem  # problem with the number of nodes of the grid
    posed: GridProblem  # lubricant, grids, asperities and stopping rule
    flooded: GridSolution
    film: Solver
    # Film of another temperature with the same supply on this grid, from which the film starts; None without
    # one.
    known: GridSolution | None = None
    near_only: bool = False  # whether only guesses near the film are tried, as for a film with heat or shear
    scheme: Scheme = USUAL  # formulas of the mass at the faces
    careful: Solver | None = None  # slower solver, which is tried where ``film`` finds no film with heat
    most_steps: float = np.inf  # Newton steps after which no further guess is tried

    @property
    def order(self) -> int:
        """Order of the wedge term where the film is filled."""
        return self.problem.wedge_order

    @property
    def dry_pressure(self) -> Array:
        """Hertz pressure P, shape (nx, ny)."""
        mesh = self.level.mesh
        return np.broadcast_to(self.problem.geometry.dry_pressure(mesh.x, mesh.y), mesh.shape)

    @property
    def level(self) -> Level:
        """Grid to solve on."""
        return self.posed.level

    @property
    def flooded_mass(self) -> float:
        """Mass rho H of the flooded film at the centre."""
        density = self.flooded.final.coefficients.density
        return at_centre(self.level.mesh, density * self.flooded.state.thickness)

    def solved(self, layer: Array, near: Guess | None = None) -> GridSolution:
        """Starved film under a layer of oil (ny,), from one guess after the other until one converges.

        ``near`` is a guess that is likely to be close, as the film of a coarser grid.
        """
        best, steps = None, 0
        for film in self._attempts(layer, near):
            if best is None or film.final.norm < best.final.norm:
                best = film
            if film.status == "converged":
                return film
            steps += len(film.steps)
            if steps > self.most_steps:
                break
        assert best is not None
        return best

    def _attempts(self, layer: Array, near: Guess | None) -> Iterator[GridSolution]:
        """Films from all guesses by all solvers, the likeliest one first."""
        if self.near_only:
            yield from self._from_near(layer, near)
            return
        if near is not None:
            yield self._under(layer, near)
        guesses = [self._from_flooded, self._from_dry]
        scarce = at_centre_line(self.level, layer) < _DRY * self.flooded_mass
        for guess in reversed(guesses) if scarce else guesses:
            yield self._under(layer, guess(layer))
        if self.posed.asperities.boundary_film:
            yield self._under(layer, self._from_contact(layer))
        yield from self._in_steps(layer)
        if self.posed.asperities.boundary_film and self._taken.simpler is not None:
            yield from replace(self, scheme=self._taken.simpler)._attempts(layer, near)

    def _from_near(self, layer: Array, near: Guess | None) -> Iterator[GridSolution]:
        """Films from the guesses near the film, as one from further away takes long to fail.

        These are the film on the coarser grid, the film of another temperature, the dry contact, and the
        flooded film.
        """
        guesses = [] if near is None else [near]
        known, scheme = self.known, self
        if known is not None and known.status == "converged" and known.content is not None:
            # Both films pass nearly the same part of their layer.
            supplied = at_centre_line(self.level, known.content.supply.mass)
            ambient = self.posed.fluid.ambient_density
            fall = ambient * at_centre_line(self.level, layer) / supplied
            # The spots of a film on a coarser grid are others.
            guesses.insert(0 if known.touches else len(guesses), self._follow(known, fall))
            scheme = replace(self, scheme=known.content.supply.scheme)
        guesses.append(self._from_dry(layer))
        for solver in (self.film, self.careful):
            if solver is not None:
                for guess in guesses:
                    yield replace(scheme, film=solver)._under(layer, guess)
        if self.flooded.status == "converged":
            yield scheme._under(layer, self._from_flooded(layer))
            yield from scheme._in_steps(layer)

    def _under(self, layer: Array, guess: Guess) -> GridSolution:
        """Film under a layer of oil (ny,), from a guess."""
        ambient = self.posed.fluid.ambient_density
        return self.film(guess, Supply(ambient * layer, self.order, scheme=self._taken))

    @property
    def _taken(self) -> Scheme:
        """Scheme of the films: the filled nodes of smooth films are one region, where the flow may jump."""
        rough = self.problem.added_gap is not None
        return self.scheme if rough else replace(self.scheme, continuous=False)

    def _from_flooded(self, layer: Array) -> Guess:
        """Flooded film whose surfaces are brought together until its centre is as thick as the layer."""
        state, filled = self.flooded.state, self.flooded.final.full_film
        if self.flooded.touches:
            return self._guess(layer, state, filled)
        return self._lowered(layer, state, filled)

    def _from_dry(self, layer: Array) -> Guess:
        """Dry contact at a distance as large as the layer."""
        pressure = np.maximum(self.dry_pressure, self.posed.fluid.ambient_pressure)
        state = State.of(self.level, pressure, 0.0)
        return self._lowered(layer, state, self.level.mesh.inner)

    def _from_contact(self, layer: Array) -> Guess:
        """Dry contact of the rough surfaces, whose asperities carry the load."""
        ambient, least = self.posed.fluid.ambient_pressure, self.posed.asperities.boundary_film
        state = dry_contact(self.level, self.dry_pressure, least, ambient)
        return self._guess(layer, state, self.level.mesh.inner)

    def _lowered(self, layer: Array, state: State, filled: Mask) -> Guess:
        """State whose centre is as thick as the layer, or as the flooded film, and its filled nodes."""
        mesh, least = self.level.mesh, at_centre_line(self.level, layer)
        centre = at_centre(mesh, state.thickness)
        density = self.flooded_mass / at_centre(mesh, self.flooded.state.thickness)
        shift = min(least, self.flooded_mass) / density - centre
        state = state.shifted(shift).lifted(_LEAST_GAP * min(least, self.flooded_mass))
        return self._guess(layer, state, filled)

    def _guess(self, layer: Array, state: State, filled: Mask) -> Guess:
        """Guess whose wide gap ahead of the contact is not filled."""
        inlet = self.level.mesh.x[:, np.newaxis] < 0.0
        return Guess(state, filled & ~(inlet & (state.thickness > _FILLED * layer)), self.flooded)

    def _in_steps(self, layer: Array) -> Iterator[GridSolution]:
        """Films under a layer that falls from the layer of the flooded film to the requested layer."""
        least = float(np.min(layer))
        part = max(1.0, 0.9 * self.flooded_mass / max(least, 1e-300))
        fall: float = _FALL
        last: tuple[float, GridSolution] | None = None  # part of the layer, and its film
        steps = 0
        for _ in range(_MOST_STEPS):
            here = part * layer
            guess = self._from_flooded(here) if last is None else self._follow(last[1], part / last[0])
            film = self._under(here, guess)
            if film.status == "converged":
                if part == 1.0:
                    yield film
                    return
                last, fall = (part, film), fall**1.5
            else:
                part, fall = part / fall, fall**0.5
                if fall > _LEAST_FALL or last is None:
                    return
            steps += len(film.steps)
            if steps > self.most_steps:
                return
            part = max(1.0, fall * part)

    def _follow(self, last: GridSolution, fall: float) -> Guess:
        """Guess for a slightly thinner layer, ``fall`` times the layer of a converged film."""
        assert last.content is not None
        state = last.state
        if not last.touches:
            shift = (fall - 1.0) * at_centre(self.level.mesh, state.thickness)
            state = state.shifted(shift).lifted(_LEAST_GAP * fall * float(np.min(state.thickness)))
        return Guess(state, last.content.filled, last)


def at_centre_line(level: Level, layer: Array) -> float:
    """Thickness of a layer of oil (ny,) on the line Y = 0."""
    return float(np.interp(0.0, level.mesh.y, layer))


# Relative difference from the ratio asked for at which the search ends, and its largest number of films.
_CLOSE, _MOST_FILMS = 1e-4, 8

# Exponent of the start of the search, r/(1 + r^gamma)^(1/gamma), of a circle: between the exponents of light
# and heavy ones. From ellipses that are wide across entrainment almost no oil flows to the sides, so that
# their exponent grows with their width: a start with too thick a layer is a film that is starved only at its
# ends, which often does not converge. Lines, whose layer is the film, start with the ratio itself.
_EXPONENT = 3.0

# Largest factor between two layers of the search, and the ratio above which a film is flooded.
_MOST_FACTOR, _FLOODED = 4.0, 1.0 - 1e-9


def film_of_ratio(
    starved: StarvedProblem, ratio: float, near: Guess | None, last: Array | None
) -> tuple[Array | None, GridSolution | None]:
    """Uniform layer of oil (ny,) for a ratio of central films, and its starved film.

    Returns ``layer``, thickness H of the layer, shape (ny,); None where it is not known: for a flooded film
    that did not converge, and for the flooded film of a point contact, the minimum layer of which depends on
    the domain; ``film``, its film; None for the flooded film, also where that did not converge and has no
    parts; the ratio may be missed where a film did not converge. ``last`` (m,) is the layer of the coarser
    grid.

    Secant method for ln(film) over ln(layer), whose slope is between 0 and 1.
    """
    mesh = starved.level.mesh
    ambient = starved.posed.fluid.ambient_density
    if starved.flooded.status != "converged":
        return None, None
    if ratio >= _FLOODED:
        return (taken_layer(starved) if mesh.dy is None else None), None
    flooded = at_centre(mesh, starved.flooded.state.thickness)
    wide = None if mesh.dy is None else 1.5 * starved.problem.geometry.load / np.pi
    layer = first_layer(ratio, wide) * starved.flooded_mass / ambient
    if last is not None:
        layer = float(last[0])
    tried: list[tuple[float, float]] = []
    best: tuple[float, Array, GridSolution] | None = None
    for _ in range(_MOST_FILMS):
        here = np.full_like(mesh.y, layer)
        film = starved.solved(here, near)
        if film.status != "converged":
            break
        missed = float(np.log(at_centre(mesh, film.state.thickness) / (ratio * flooded)))
        if best is None or abs(missed) < best[0]:
            best = abs(missed), here, film
        if abs(missed) < _CLOSE:
            break
        tried.append((float(np.log(layer)), missed))
        assert film.content is not None
        near = Guess(film.state, film.content.filled, film)
        layer = float(np.exp(_next(tried)))
    return (here, film) if best is None else best[1:]


def taken_layer(starved: StarvedProblem) -> Array:
    """Thickness H (ny,) at ambient pressure of the oil that the flooded film takes through the inlet edge."""
    flooded, mesh = starved.flooded, starved.level.mesh
    flow = flooded.final.flow
    density = flow.coefficients.density
    mass = density * flooded.state.thickness
    edge = mass[0] if starved.order == 1 else 0.5 * (mass[0] + mass[1])
    taken: Array = (edge - mesh.dx * flow.along.flux[0]) / starved.posed.fluid.ambient_density
    return taken


def first_layer(ratio: float, width: float | None) -> float:
    """Mass of the first layer of a search divided by the mass of the flooded film at the centre. ``width``,
    semi-axis of the dry contact across entrainment divided by the semi-axis along it; None of a line.

    Examples
    --------
    >>> first_layer(0.5, None), round(first_layer(0.5, 1.0), 3), round(first_layer(0.5, 4.0), 3)
    (0.5, 0.523, 0.5)
    """
    if width is None:
        return ratio
    exponent = _EXPONENT * max(1.0, width)
    return float((ratio**-exponent - 1.0) ** (-1.0 / exponent))


def _next(tried: list[tuple[float, float]]) -> float:
    """Logarithm of the next layer, from the last layers and what their films miss."""
    at, missed = tried[-1]
    slope = 1.0
    if len(tried) > 1:
        before, before_missed = tried[-2]
        slope = min(1.0, max(0.05, (missed - before_missed) / (at - before))) if at != before else 1.0
    most = float(np.log(_MOST_FACTOR))
    return at - min(most, max(-most, missed / slope))
