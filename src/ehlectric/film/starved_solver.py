"""Starved films on one grid, and flooded films that form again behind a cavity.

A flooded film may form again behind a cavity, as between the peaks of a rough surface. The wedge term of
``ehlectric.film.newton`` counts a cavitated gap as full. That is exact where no oil fills the gap any more
behind a cavity. Elsewhere it makes the oil that is missing in the cavity. There the content of oil is carried
through the cavity, as in a starved film (``ehlectric.film.starved_film``) whose inlet is flooded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mesh import at_centre
from ehlectric.film.newton import GridProblem, GridSolution, State
from ehlectric.film.starved_film import Content, Supply, assess_content, starved_newton

# Largest number of Newton steps from a solution whose scheme has lower order at some nodes.
_AGAIN = 15

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


def conserving_film(problem: GridProblem, start: tuple[State, Mask], order: int) -> GridSolution:
    """Last iterate, with its oil fraction, of a film on one grid that conserves its oil.

    ``order`` is that of the wedge term where oil fills the gap.
    """
    supply = flooded_inlet(problem.level, order)

    def solved(posed: GridProblem, state: State, filled: Mask) -> GridSolution:
        state = replace(state, contact_pressure=0.0)
        solution, content = starved_newton(posed, state, with_inlet(filled), supply)
        return replace(solution, fraction=content.fraction(solution.state.thickness))

    return of_full_order(problem, solved(problem, *start), solved)


def of_full_order(
    problem: GridProblem, found: GridSolution, solved: Callable[[GridProblem, State, Mask], GridSolution]
) -> GridSolution:
    """Solution whose nodes have no upwind difference that it does not need, and whose oil balances closely.

    Nodes that went round in circles got such a difference. A residual that is small as a pressure may be much
    oil where the gap is wide. ``solved`` solves the film again from a state and its filled nodes, to a
    smaller residual first; where both miss their tolerance, the solution stays.
    """
    if found.status != "converged":
        return found
    for closer in (_CLOSER * problem.tolerance, problem.tolerance):
        posed = replace(problem, max_iterations=_AGAIN, tolerance=closer)
        again = solved(posed, found.state, found.final.full_film)
        if again.status == "converged":
            return replace(again, steps=found.steps + again.steps)
        if min(again.final.norm, *(step.residual for step in again.steps)) > problem.tolerance:
            # The steps to the larger residual are the same.
            break
    return found


def flooded_inlet(level: Level, order: int, *, first_order: bool = False) -> Supply:
    """Supply of more oil than any gap takes, at the lines of a grid; ``first_order`` as in ``Supply``."""
    return Supply(np.full(level.mesh.y.size, np.inf), order, first_order=first_order)


def with_inlet(filled: Mask) -> Mask:
    """Mask of filled nodes (nx, ny) with the nodes of the inlet edge."""
    flooded = filled.copy()
    flooded[0] = True
    return flooded


def oil_fraction(fluid: Fluid, solution: GridSolution, order: int) -> Array:
    """Part of the gap that oil fills, shape (nx, ny), also of a solution that does not carry it."""
    if solution.fraction is not None:
        return solution.fraction
    level, state = solution.level, solution.state
    filled = with_inlet(solution.final.full_film)
    return assess_content(fluid, level, state, filled, flooded_inlet(level, order)).fraction(state.thickness)


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


@dataclass(frozen=True)
class StarvedFilm:
    """Starved film on one grid."""

    solution: GridSolution  # last iterate, with its status
    content: Content
    layer: Array  # thickness H of the layer of oil at the lines of the grid, shape (ny,)

    @property
    def fraction(self) -> Array:
        """Part of the gap that oil fills, shape (nx, ny)."""
        return self.content.fraction(self.solution.state.thickness)


@dataclass(frozen=True)
class StarvedProblem:
    """Starved film to be solved on one grid, with the flooded film."""

    posed: GridProblem  # lubricant, grids and stopping rule
    order: int  # order of the wedge term where the film is filled
    flooded: GridSolution
    dry_pressure: Array  # Hertz pressure P, shape (nx, ny)

    @property
    def level(self) -> Level:
        """Grid to solve on."""
        return self.posed.level

    @property
    def flooded_mass(self) -> float:
        """Mass rho H of the flooded film at the centre."""
        density = self.flooded.final.coefficients.density
        return at_centre(self.level.mesh, density * self.flooded.state.thickness)

    def solved(self, layer: Array, near: tuple[State, Mask] | None = None) -> StarvedFilm:
        """Starved film under a layer of oil (ny,), from one start after the other until one converges.

        ``near`` is a state with its filled nodes that is likely to be close, as that of a coarser grid.
        """
        best = None
        for film in self._attempts(layer, near):
            if best is None or film.solution.final.norm < best.solution.final.norm:
                best = film
            if film.solution.status == "converged":
                return film
        assert best is not None
        return best

    def _attempts(self, layer: Array, near: tuple[State, Mask] | None) -> Iterator[StarvedFilm]:
        """Films from all starts, the likeliest one first."""
        if near is not None:
            yield self._newton(layer, *near)
        starts = [self._from_flooded, self._from_dry]
        scarce = at_centre_line(self.level, layer) < _DRY * self.flooded_mass
        for start in reversed(starts) if scarce else starts:
            yield self._newton(layer, *start(layer))
        yield from self._in_steps(layer)

    def _newton(self, layer: Array, state: State, filled: Mask) -> StarvedFilm:
        supply = Supply(self.flooded.final.coefficients.density[0] * layer, self.order)
        return StarvedFilm(*starved_newton(self.posed, state, filled, supply), layer)

    def _from_flooded(self, layer: Array) -> tuple[State, Mask]:
        """Flooded film whose surfaces are brought together until its centre is as thick as the layer."""
        state = self.flooded.state
        return self._lowered(layer, replace(state, contact_pressure=0.0), self.flooded.final.full_film)

    def _from_dry(self, layer: Array) -> tuple[State, Mask]:
        """Dry contact at a distance as large as the layer."""
        pressure = np.maximum(self.dry_pressure, self.posed.fluid.ambient_pressure)
        state = State.of(self.level, pressure, 0.0)
        return self._lowered(layer, state, self.level.mesh.inner)

    def _lowered(self, layer: Array, state: State, filled: Mask) -> tuple[State, Mask]:
        """State whose centre is as thick as the layer, or as the flooded film, and its filled nodes."""
        mesh, least = self.level.mesh, at_centre_line(self.level, layer)
        centre = at_centre(mesh, state.thickness)
        density = self.flooded_mass / at_centre(mesh, self.flooded.state.thickness)
        shift = min(least, self.flooded_mass) / density - centre
        state = state.shifted(shift).lifted(_LEAST_GAP * min(least, self.flooded_mass))
        inlet = mesh.x[:, np.newaxis] < 0.0
        return state, filled & ~(inlet & (state.thickness > _FILLED * layer))

    def _in_steps(self, layer: Array) -> Iterator[StarvedFilm]:
        """Films under a layer that falls from that of the flooded film; the last one is that asked for."""
        least = float(np.min(layer))
        part = max(1.0, 0.9 * self.flooded_mass / max(least, 1e-300))
        fall, last = _FALL, None
        for _ in range(_MOST_STEPS):
            here = part * layer
            start = self._from_flooded(here) if last is None else self._follow(last, here)
            film = self._newton(here, *start)
            if film.solution.status == "converged":
                if part == 1.0:
                    yield film
                    return
                last, fall = film, fall**1.5
            else:
                part, fall = part / fall, fall**0.5
                if fall > _LEAST_FALL or last is None:
                    return
            part = max(1.0, fall * part)

    def _follow(self, last: StarvedFilm, layer: Array) -> tuple[State, Mask]:
        """Start for a slightly thinner layer from a converged film."""
        state = last.solution.state
        fall = at_centre_line(self.level, layer) / at_centre_line(self.level, last.layer)
        shift = (fall - 1.0) * at_centre(self.level.mesh, state.thickness)
        lowered = state.shifted(shift).lifted(_LEAST_GAP * fall * float(np.min(state.thickness)))
        return lowered, last.content.filled


def at_centre_line(level: Level, layer: Array) -> float:
    """Thickness of a layer of oil (ny,) on the line Y = 0."""
    return float(np.interp(0.0, level.mesh.y, layer))


# Relative difference from the ratio asked for at which the search ends, and its largest number of films.
_CLOSE, _MOST_FILMS = 1e-4, 8

# Exponent of the start of the search, r/(1 + r^gamma)^(1/gamma): between those of light and heavy circles.
# Lines, whose layer is the film, start with the ratio itself.
_EXPONENT = 3.0

# Largest factor between two layers of the search, and the ratio above which a film is flooded.
_MOST_FACTOR, _FLOODED = 4.0, 1.0 - 1e-9


def film_of_ratio(
    starved: StarvedProblem, ratio: float, near: tuple[State, Mask] | None, last: StarvedFilm | None
) -> tuple[Array | None, StarvedFilm | None]:
    """Uniform layer of oil (ny,) for a ratio of central films, and its starved film.

    Returns ``layer``, thickness H of the layer, shape (ny,); None where it is not known: for a flooded film
    that did not converge, and for that of a point contact, the least layer of which depends on the domain;
    ``film``, its film; None for the flooded film, also where that did not converge and has no parts; the
    ratio may be missed where a film did not converge.

    Secant method for ln(film) over ln(layer), whose slope is between 0 and 1.
    """
    lines, mesh = np.ones_like(starved.level.mesh.y), starved.level.mesh
    ambient = float(starved.flooded.final.coefficients.density[0, 0])
    if starved.flooded.status != "converged":
        return None, None
    if ratio >= _FLOODED:
        return (taken_layer(starved) if mesh.dy is None else None), None
    flooded = at_centre(mesh, starved.flooded.state.thickness)
    layer = first_layer(ratio, line=mesh.dy is None) * starved.flooded_mass / ambient
    if last is not None:
        layer = at_centre_line(last.solution.level, last.layer)
    found: list[tuple[float, float]] = []
    best: tuple[float, StarvedFilm] | None = None
    for _ in range(_MOST_FILMS):
        film = starved.solved(layer * lines, near)
        if film.solution.status != "converged":
            break
        missed = float(np.log(at_centre(mesh, film.solution.state.thickness) / (ratio * flooded)))
        if best is None or abs(missed) < best[0]:
            best = abs(missed), film
        if abs(missed) < _CLOSE:
            break
        found.append((float(np.log(layer)), missed))
        near = film.solution.state, film.content.filled
        layer = float(np.exp(_next(found)))
    chosen = film if best is None else best[1]
    return chosen.layer, chosen


def taken_layer(starved: StarvedProblem) -> Array:
    """Thickness H (ny,) at ambient pressure of the oil that the flooded film takes through the inlet edge."""
    flooded, mesh = starved.flooded, starved.level.mesh
    flow = flooded.final.flow
    density = flow.coefficients.density
    mass = density * flooded.state.thickness
    edge = mass[0] if starved.order == 1 else 0.5 * (mass[0] + mass[1])
    taken: Array = (edge - mesh.dx * flow.along.flux[0]) / density[0]
    return taken


def first_layer(ratio: float, *, line: bool) -> float:
    """Mass of the first layer of a search over that of the flooded film at the centre.

    Examples
    --------
    >>> first_layer(0.5, line=True), round(first_layer(0.5, line=False), 3)
    (0.5, 0.523)
    """
    return ratio if line else float((ratio**-_EXPONENT - 1.0) ** (-1.0 / _EXPONENT))


def _next(found: list[tuple[float, float]]) -> float:
    """Logarithm of the next layer, from those of the last layers and what their films miss."""
    at, missed = found[-1]
    slope = 1.0
    if len(found) > 1:
        before, before_missed = found[-2]
        slope = min(1.0, max(0.05, (missed - before_missed) / (at - before))) if at != before else 1.0
    most = float(np.log(_MOST_FACTOR))
    return at - min(most, max(-most, missed / slope))
