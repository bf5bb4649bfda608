"""The lubricant film of a loaded contact: nested iteration, error estimate and the film in SI units."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.elastic import LINE, Geometry
from ehlectric.hertz import line_pressure
from ehlectric.multigrid import Level, hierarchy
from ehlectric.newton import GridSolution, NewtonStep, Progress, State, Status, newton
from ehlectric.reynolds import Fluid, wedge_stencil
from ehlectric.threads import one_blas_thread
from ehlectric.typing import Array, Mask

# The coarser grids are solved to this residual, far below their discretisation error.
NESTED_TOLERANCE = 1e-6

# The nested iteration starts from the Hertz pressure on the coarsest grid of at least this many nodes:
# a quarter of them do not resolve a thin film.
FIRST_GRID = 201

# Parts of the roughness it is raised by, first and least, and the residual on the way.
FIRST_RISE = 0.2
LEAST_RISE = 0.01
RISE_TOLERANCE = 1e-3

# Part of the central film below which a gap that was not solved for is no film.
COLLAPSED = 1e-2


@dataclass(frozen=True)
class Scales:
    """What makes the film dimensionless: x = X length, p = P pressure, h = H thickness, all SI.

    ``ambient_pressure`` is that of the fluid in Pa, where P times ``pressure`` would miss it by rounding.
    """

    length: float = 1.0
    pressure: float = 1.0
    thickness: float = 1.0
    ambient_pressure: float = 0.0


@dataclass(frozen=True)
class FilmProblem:
    """A line contact in dimensionless form, X = x/b, P = p/p_h, H = h R/b^2.

    Parameters
    ----------
    fluid : Fluid
        Laws over P, the velocity parameter lambda = 6 eta0 u_s R^2/(b^3 p_h) with u_s = u1 + u2, and the
        ambient pressure over p_h.
    nodes : int
        Nodes along x, at least 65.
    inlet, outlet : float
        Ends of the domain in half-widths, inlet < -1 and outlet > 1.
    thickness_guess : float
        Central H to start from; that of a film-thickness formula is near enough.
    second_order : bool
        Upstream wedge term of second order, else of first.
    tolerance : float
        Largest scaled residual of a solution.
    max_iterations : int
        Newton steps allowed on each grid.
    scales : Scales
        Length b [m], pressure p_h [Pa] and thickness b^2/R [m] of the result, and its ambient pressure [Pa].
    geometry : Geometry
        Kernel, dry gap and load of the contact.
    added_gap : callable, optional
        Gap that roughness adds, X (nx,) -> G (nx, ny); a peak adds a negative one.
    """

    fluid: Fluid
    nodes: int
    inlet: float
    outlet: float
    thickness_guess: float
    second_order: bool = True
    tolerance: float = 1e-9
    max_iterations: int = 30
    scales: Scales = Scales()
    geometry: Geometry = LINE
    added_gap: Callable[[Array], Array] | None = None


@dataclass(frozen=True)
class Film:
    """Film of a line contact in SI units, with how it was obtained.

    Attributes
    ----------
    x, pressure, thickness, deflection : ndarray, shape (nx,)
        Position along entrainment [m], pressure [Pa], film thickness [m], and the gap opened by the
        pressure [m] up to a rigid displacement.
    density : ndarray, shape (nx,)
        Density over that at zero pressure, dimensionless.
    cavitated : ndarray of bool, shape (nx,)
        Where the pressure is held at ambient; includes the two end nodes.
    reynolds_residual : ndarray, shape (nx,)
        d(rho H)/dX - d/dX(eps dP/dX) in units of P: zero in the full film, not negative where it
        cavitates.
    status : str
        "converged"; "stalled" (residual above the tolerance at the last step allowed); "diverged"; or
        "film collapsed": not converged, with gaps below a hundredth of the central film.
    residual, load_residual : float
        Largest scaled residual, and abs(integral P dX/(pi/2) - 1).
    newton_iterations : int
        On the finest grid. ``steps`` has those of all grids.
    discretisation_error : float or None
        Richardson's estimate, relative: the larger of that of the minimum and the central thickness.
    inlet_deficit : float
        Share of the reduced pressure that would be built up before the domain begins.
    """

    x: Array
    pressure: Array
    thickness: Array
    deflection: Array
    density: Array
    cavitated: Mask
    reynolds_residual: Array
    scales: Scales
    status: Status
    residual: float
    load_residual: float
    newton_iterations: int
    steps: tuple[NewtonStep, ...]
    discretisation_error: float | None
    inlet_deficit: float

    @property
    def converged(self) -> bool:
        """Whether the residual is below the tolerance."""
        return self.status == "converged"

    @property
    def minimum_thickness(self) -> float:
        """Film thickness of the lowest node [m]."""
        return float(np.min(self.thickness))

    @property
    def minimum_position(self) -> float:
        """Position of the lowest node [m]."""
        return float(self.x[np.argmin(self.thickness)])

    @property
    def central_thickness(self) -> float:
        """Film thickness at x = 0, interpolated [m]."""
        return float(np.interp(0.0, self.x, self.thickness))

    @property
    def mean_thickness(self) -> float:
        """Mean film thickness over the Hertz zone, by the trapezoidal rule [m]."""
        b = self.scales.length
        inside = np.abs(self.x) < b
        x = np.concatenate([[-b], self.x[inside], [b]])
        return float(np.trapezoid(np.interp(x, self.x, self.thickness), x) / (2.0 * b))

    @property
    def max_pressure(self) -> float:
        """Largest pressure of a node [Pa]."""
        return float(np.max(self.pressure))

    @property
    def collapsed_positions(self) -> Array:
        """Where a film that was not found has gaps below a hundredth of the central one [m]."""
        if self.status != "film collapsed":
            return np.empty(0)
        return self.x[self.thickness < COLLAPSED * self.central_thickness]

    @property
    def cavitates(self) -> bool:
        """Whether the film cavitates before the domain ends."""
        return bool(self.cavitated[-2])


def solve_film(problem: FilmProblem, *, progress: Progress | None = None) -> Film:
    """Solve the Reynolds, film and load equations of a line contact.

    Parameters
    ----------
    problem : FilmProblem
        The contact, dimensionless.
    progress : callable, optional
        Called with (nodes, Newton step, residual) before every Newton step.

    Returns
    -------
    Film
        Whatever was reached, with its status: nothing is raised where it is not a solution.

    Notes
    -----
    Eqs. (1) to (13) of Morris et al. (2022), doi:10.3390/lubricants10050087, and the complementarity
    condition for cavitation that they leave out. The nested iteration is that of full multigrid: every
    grid starts from the solution on the next coarser.

    Examples
    --------
    >>> import numpy as np
    >>> incompressible = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> isoviscous = lambda p: (np.zeros_like(p), np.zeros_like(p))
    >>> fluid = Fluid(incompressible, isoviscous, velocity_parameter=0.01, ambient_pressure=0.0)
    >>> solve_film(FilmProblem(fluid, 401, -4.0, 2.0, thickness_guess=0.1)).status
    'converged'
    """
    # An iterate may leave the numbers on its way to a status; it must not print about it.
    with one_blas_thread(), np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        solutions = _nested_iteration(problem, progress)
        return _film(problem, solutions)


def _nested_iteration(problem: FilmProblem, progress: Progress | None) -> list[GridSolution]:
    """Solutions from the coarsest grid used to the finest, which is the last.

    Where a grid is not solved, it and the next finer one start from the Hertz pressure.
    """
    levels = _levels(problem, roughness=1.0)
    first = max((k for k, level in enumerate(levels) if level.x.size >= FIRST_GRID), default=1)
    solutions: list[GridSolution] = []
    for k in range(max(first, 1), -1, -1):
        best = None
        if solutions and solutions[-1].status == "converged":
            best = _from_coarser(problem, levels[k:], solutions[-1], progress)
        # What is nearly solved is not worth starting again.
        if best is None or best.final.norm > NESTED_TOLERANCE:
            *warm_up, restarted = _from_hertz(problem, levels[k:], progress)
            solutions.extend(warm_up)
            attempts = [restarted] if best is None else [restarted, best]
            *others, best = sorted(attempts, key=lambda solution: -solution.final.norm)
            solutions.extend(others)
        solutions.append(best)
    if problem.added_gap is not None and solutions[-1].final.norm > NESTED_TOLERANCE:
        smooth = _nested_iteration(replace(problem, added_gap=None), progress)
        solutions += [*smooth, *_raise_roughness(problem, smooth[-1], progress)]
    return solutions


def _levels(problem: FilmProblem, *, roughness: float) -> list[Level]:
    """The grids, with a part of the roughness."""
    added, geometry = problem.added_gap, problem.geometry
    if added is not None:
        smooth = geometry.dry_gap
        geometry = replace(geometry, dry_gap=lambda x: smooth(x) + roughness * added(x))
    return hierarchy(
        problem.nodes,
        inlet=problem.inlet,
        outlet=problem.outlet,
        geometry=geometry,
        second_order=problem.second_order,
    )


def _raise_roughness(
    problem: FilmProblem, smooth: GridSolution, progress: Progress | None
) -> Iterator[GridSolution]:
    """Roughness raised from nothing to its height, each solution the start of the next.

    Gives up at the first part of the height that cannot be gone beyond.
    """
    best, reached, step = smooth, 0.0, FIRST_RISE
    while best.status == "converged" and reached < 1.0:
        part = min(1.0, reached + step)
        levels = _levels(problem, roughness=part)
        start = State.of(levels[0], best.state.pressure, best.state.h00)
        start = start.lifted(0.3 * float(best.state.thickness.min()))
        solution = _solve_grid(
            problem if part == 1.0 else replace(problem, tolerance=RISE_TOLERANCE),
            levels,
            start,
            progress,
            spike=True,
        )
        if solution.status == "converged":
            best, reached, step = solution, part, 1.5 * step
            yield solution
        elif step > LEAST_RISE:
            step *= 0.5
        else:
            yield solution
            return


def _solve_grid(
    problem: FilmProblem,
    levels: list[Level],
    state: State,
    progress: Progress | None,
    *,
    spike: bool,
) -> GridSolution:
    finest = levels[0].x.size == problem.nodes
    return newton(
        problem.fluid,
        levels,
        state,
        tolerance=problem.tolerance if finest else max(problem.tolerance, NESTED_TOLERANCE),
        max_iterations=problem.max_iterations,
        progress=progress,
        eliminate_spike=spike,
    )


def _from_coarser(
    problem: FilmProblem, levels: list[Level], coarse: GridSolution, progress: Progress | None
) -> GridSolution:
    """Start from the next coarser grid: a monotone cubic is smooth and does not overshoot."""
    level = levels[0]
    pressure = PchipInterpolator(coarse.level.x, coarse.state.pressure, axis=0)(level.x)
    state = State.of(level, pressure, coarse.state.h00)
    state = state.lifted(0.5 * float(coarse.state.thickness.min()))
    return _solve_grid(problem, levels, state, progress, spike=True)


def _from_hertz(
    problem: FilmProblem, levels: list[Level], progress: Progress | None
) -> Iterator[GridSolution]:
    """Start from the Hertz pressure: with the first-order wedge, then with the one asked for.

    The first-order scheme is monotone and converges from further away.
    """
    level = levels[0]
    hertz = line_pressure(level.x)[:, np.newaxis]
    state = State.of(level, np.maximum(hertz, problem.fluid.ambient_pressure), 0.0)
    centre = float(np.interp(0.0, level.x, state.thickness[:, 0]))
    state = State.of(level, state.pressure, problem.thickness_guess - centre)
    state = state.lifted(0.5 * problem.thickness_guess)
    if problem.second_order:
        monotone = [
            replace(level, wedge=wedge_stencil(level.weights.shape, level.dx, second_order=False))
            for level in levels
        ]
        start = _solve_grid(problem, monotone, state, progress, spike=False)
        yield start
        state = start.state if start.status == "converged" else state
    yield _solve_grid(problem, levels, state, progress, spike=False)


def _film(problem: FilmProblem, solutions: list[GridSolution]) -> Film:
    """The result on the finest grid, in SI units."""
    finest, scales = solutions[-1], problem.scales
    coarser = next((g for g in reversed(solutions) if g.level.x.size < problem.nodes), None)
    state, final, level = finest.state, finest.final, finest.level
    pressure = np.maximum(scales.pressure * state.pressure, scales.ambient_pressure)
    steps = tuple(step for solution in solutions for step in solution.steps)
    return Film(
        x=scales.length * level.x,
        pressure=np.where(final.free, pressure, scales.ambient_pressure)[:, 0],
        thickness=scales.thickness * state.thickness[:, 0],
        deflection=scales.thickness * level.deflection(state.pressure)[:, 0],
        density=final.coefficients.density[:, 0],
        cavitated=~final.free[:, 0],
        reynolds_residual=final.scaled[:, 0],
        scales=scales,
        status=_status(finest),
        residual=final.norm,
        load_residual=abs(final.load) / level.load,
        newton_iterations=sum(step.nodes == problem.nodes for step in steps),
        steps=steps,
        discretisation_error=_discretisation_error(problem, finest, coarser),
        inlet_deficit=_inlet_deficit(problem.fluid, finest),
    )


def _status(finest: GridSolution) -> Status:
    """Status, told apart where a film that was not found has a place without one."""
    gap = finest.state.thickness
    central = float(np.interp(0.0, finest.level.x, gap[:, 0]))
    if finest.status != "converged" and float(np.min(gap)) < COLLAPSED * central:
        return "film collapsed"
    return finest.status


def _discretisation_error(
    problem: FilmProblem, fine: GridSolution, coarse: GridSolution | None
) -> float | None:
    """Richardson's estimate: the larger relative error of the minimum and the central thickness."""
    if coarse is None or fine.status != "converged" or coarse.status != "converged":
        return None
    order = 2 if problem.second_order else 1
    gain = (coarse.level.dx / fine.level.dx) ** order - 1.0
    on_fine, on_coarse = (
        np.array([np.min(g.state.thickness), np.interp(0.0, g.level.x, g.state.thickness[:, 0])])
        for g in (fine, coarse)
    )
    return float(np.max(np.abs(on_fine - on_coarse) / (gain * on_fine)))


def _inlet_deficit(fluid: Fluid, solution: GridSolution) -> float:
    """Share of the reduced pressure that would be built up before the domain begins.

    The Reynolds equation integrated once, dP/dX = eta lambda (rho H - q)/(rho H^3) with the flow q,
    builds up the reduced pressure, the integral of dP/eta. Before the inlet P is about ambient and H
    about a parabola.
    """
    x, pressure = solution.level.x, solution.state.pressure[:, 0]
    mass = (solution.final.coefficients.density * solution.state.thickness)[:, 0]
    if not (np.all(np.isfinite(pressure)) and np.all(mass > 0.0)):
        return 0.0
    flow = float(mass[np.argmax(pressure)])
    fluidity = np.exp(-fluid.log_viscosity(np.maximum(pressure, fluid.ambient_pressure))[0])
    increments = 0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(pressure)
    inside = float(np.max(np.cumsum(increments)))
    # With X = inlet/t, 0 < t < 1, the integrand is smooth, about t^2.
    points, weights = np.polynomial.legendre.leggauss(40)
    t = 0.5 * (points + 1.0)
    gap = float(mass[0]) + 0.5 * float(x[0]) ** 2 * (1.0 / t**2 - 1.0)
    gradient = fluid.velocity_parameter * (gap - flow) / gap**3
    before = float(np.sum(0.5 * weights * gradient * abs(float(x[0])) / t**2))
    return before / (before + inside) if before > 0.0 else 0.0
