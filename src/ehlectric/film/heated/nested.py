"""Film with heat and shear thinning on a sequence of grids, after the film without them."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ehlectric.arrays import Array
from ehlectric.film.accuracy.adaptive import RefinedSolution, refined_solution
from ehlectric.film.heated.accuracy import largest_rise, mid_film, rise_error
from ehlectric.film.heated.course import Course, HeatedGrid
from ehlectric.film.levels import Level
from ehlectric.film.nested import DIRECT, NESTED_TOLERANCE, interpolated_state, levels_of
from ehlectric.film.problem import FilmProblem
from ehlectric.film.sheared.profile import on_mesh
from ehlectric.film.sheared.traction import traction
from ehlectric.film.state import GridSolution, Progress, State, Status
from ehlectric.film.thermal.balance import energy_imbalance
from ehlectric.film.thermal.energy import Heat
from ehlectric.runtime.parallel.threads import quiet_solution

# Smallest number of nodes along x of the first grid with heat, in a line and in a point contact.
_FIRST, _FIRST_POINT = 151, 33

# The same for the careful way.
_FIRST_CAREFUL = 101

# Parts of the slip of a film that does not converge at once.
_SLIPS = (0.0, 0.03, 0.1, 0.3, 1.0)


@dataclass(frozen=True, eq=False)
class HeatedSolution:
    """Film with heat or shear thinning, and the film without both.

    Attributes
    ----------
    refined : RefinedSolution
        Film with heat and shear thinning on all of its grids.
    simple : RefinedSolution
        Isothermal Newtonian film on all of its grids.
    temperature : ndarray, shape (nz, nx, ny), or None
        Temperature [K] at the nodes across the film; None for an isothermal film.
    zeta : ndarray, shape (nz,)
        Positions z/h of these nodes.
    mid_temperature : ndarray, shape (nx, ny), or None
        Temperature at mid-film [K].
    max_temperature_rise, temperature_rise_error : float or None
        Largest rise of the mid-film temperature over that of the oil that enters [K], and the estimate of its
        error (``accuracy.rise_error``).
    shear_stress : ndarray, shape (nx, ny)
        Shear stress along x at mid-film [Pa].
    traction_coefficient, rolling_coefficient : float
        Traction coefficient of the slip, and that of rolling.
    power_loss : float
        Friction power, [W/m] in a line and [W] in a point contact.
    energy_imbalance : float or None
        Heat of the film that the bodies and the oil do not take up, over all heat.
    outer_iterations : int
        Number of outer loops on all grids.
    status : str
        "converged", "stalled" or "diverged".
    """

    refined: RefinedSolution
    simple: RefinedSolution
    temperature: Array | None
    zeta: Array
    mid_temperature: Array | None
    max_temperature_rise: float | None
    temperature_rise_error: float | None
    shear_stress: Array
    traction_coefficient: float
    rolling_coefficient: float
    power_loss: float
    energy_imbalance: float | None
    outer_iterations: int
    status: Status

    @property
    def surface_temperatures(self) -> Array | None:
        """Temperatures of both surfaces [K], shape (2, nx, ny); None for an isothermal film."""
        return None if self.temperature is None else self.temperature[[0, -1]]


def film_of(problem: FilmProblem, progress: Progress | None = None) -> HeatedSolution:
    """Solve the film with the physics of its problem, after the isothermal Newtonian film.

    Parameters
    ----------
    problem : FilmProblem
        Problem of the contact with its ``physics``.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every Newton step.

    Returns
    -------
    HeatedSolution
        Both films, the temperature, and the friction.

    Notes
    -----
    The grid is that on which the isothermal film reaches the ``target_error`` of the problem. The film with
    heat is then solved on all grids from coarse to fine. In a point contact, the lines along x do not heat
    one another through the bodies, so that a body with a Peclet number below about five gets too hot.
    """
    with quiet_solution():
        return _solved(problem, progress)


def _solved(problem: FilmProblem, progress: Progress | None) -> HeatedSolution:
    """Both films, with heat on all grids from coarse to fine."""
    assert problem.physics is not None
    simple = refined_solution(replace(problem, physics=None), progress)
    finest = _on(simple.problem if simple.patch is None else problem, simple.whole, problem)
    found = _on_grids(finest, simple, progress, careful=False)
    if not all(grid.converged for _, grid in found):
        # Very hot films take more grids and more exact loops.
        found = _on_grids(finest, simple, progress, careful=True)
    return _solution(simple, found)


def _on_grids(
    finest: FilmProblem, simple: RefinedSolution, progress: Progress | None, *, careful: bool
) -> list[tuple[Course, HeatedGrid]]:
    """Film with heat on all grids; the quick way ends with the first grid that it does not solve."""
    grids, least = [finest], _FIRST_CAREFUL if careful else _FIRST
    if finest.width is not None:
        least = _FIRST_POINT
    while len(grids) < 2 or grids[-1].nodes // 2 + 1 >= least:
        width = None if grids[-1].width is None else grids[-1].width.coarser()
        grids.append(replace(grids[-1], nodes=grids[-1].nodes // 2 + 1, width=width))
    found: list[tuple[Course, HeatedGrid]] = []
    for finer, posed in reversed(list(enumerate(grids))):
        course = replace(_course(posed, finer=finer, progress=progress), careful=careful)
        if careful:
            course, grid = _careful(course, simple, found)
        else:
            grid = course(*_start(course, simple, found), spike=True)
        found.append((course, grid))
        if not careful and not grid.converged:
            break
    return found


def _careful(
    course: Course, simple: RefinedSolution, found: list[tuple[Course, HeatedGrid]]
) -> tuple[Course, HeatedGrid]:
    """Film with heat on a grid by the first careful way that converges, that of the coarser grid first."""
    before = bool(found) and found[-1][0].held
    ways = [replace(course, held=held) for held in (before, not before)]
    state, heat = _start(course, simple, found)
    tried: list[tuple[Course, HeatedGrid]] = []
    for way in ways:
        tried.append((way, way(state, heat, spike=True)))
        if tried[-1][1].converged:
            return tried[-1]
    if course.physics.slide_to_roll_ratio != 0.0:
        for way in ways:
            tried.append((way, _by_slip(way, simple)))
            if tried[-1][1].converged:
                return tried[-1]
    return tried[0]


def _on(posed: FilmProblem, whole: GridSolution, problem: FilmProblem) -> FilmProblem:
    """Problem with heat on the grid of the isothermal film over the whole domain."""
    mesh, width = whole.level.mesh, posed.width
    if width is not None:
        across = mesh.whole_y.size if mesh.symmetric else mesh.y.size
        width = replace(width, nodes=across)
    return replace(posed, nodes=mesh.x.size, width=width, physics=problem.physics, wedge_order=3)


def _course(problem: FilmProblem, *, finer: int, progress: Progress | None) -> Course:
    """Outer iteration on the grid of a problem."""
    levels = levels_of(problem)
    direct = problem.width is None and problem.nodes <= DIRECT
    tolerance = problem.tolerance if finer == 0 else max(problem.tolerance, NESTED_TOLERANCE)
    return Course(problem, levels[:1] if direct else levels, tolerance, finer, progress)


def _by_slip(course: Course, simple: RefinedSolution) -> HeatedGrid:
    """Film with heat on a grid from rolling to its own slip in steps, which converges from farther."""
    first, second = course.physics.speeds
    mean = course.physics.mean_speed
    (state, heat), loops = _start(course, simple, []), 0
    for part in _SLIPS:
        speeds = mean + part * (first - mean), mean + part * (second - mean)
        problem = replace(course.problem, physics=replace(course.physics, speeds=speeds))
        grid = replace(course, problem=problem)(state, heat, spike=False)
        loops += grid.loops
        if grid.solution.status != "diverged":
            state, heat = grid.solution.state, grid.heat
    return replace(grid, loops=loops)


def _start(
    course: Course, simple: RefinedSolution, found: list[tuple[Course, HeatedGrid]]
) -> tuple[State, Heat | None]:
    """Initial guess: the film with heat on the coarser grid, or the isothermal film on the first grid."""
    level = course.levels[0]
    if found and found[-1][1].converged:
        coarse = found[-1][1]
        state = interpolated_state(level, coarse.solution)
        state = state.lifted(0.5 * float(coarse.solution.state.thickness.min()))
        return state, None if coarse.heat is None else _finer(coarse.heat, coarse.solution.level, level)
    for solution in reversed(simple.solutions):
        if solution.level.mesh.shape == level.mesh.shape and simple.patch is None:
            return solution.state, None
    return interpolated_state(level, simple.whole), None


def _finer(heat: Heat, coarse: Level, level: Level) -> Heat:
    """Temperature and fluxes on a finer grid, interpolated linearly."""
    return Heat(*(on_mesh(values, coarse.mesh, level.mesh) for values in vars(heat).values()))


def _solution(simple: RefinedSolution, found: list[tuple[Course, HeatedGrid]]) -> HeatedSolution:
    """Results of the film on its finest grid."""
    course, last = found[-1]
    problem, physics = course.problem, course.physics
    mesh, state = course.levels[0].mesh, last.solution.state
    columns, filled = course.columns(last.solution, last.flow)
    friction = traction(
        columns,
        state.thickness,
        mesh,
        load=course.levels[0].load,
        stress_ratio=course.stress_scale / problem.scales.pressure,
        filled=filled,
    )
    scales, level = problem.scales, course.levels[0]
    load = scales.pressure * scales.length ** (1 if mesh.dy is None else 2) * level.load
    heat = last.heat
    middle = None if heat is None else mid_film(heat.temperature)
    imbalance = None
    if heat is not None and physics.thermal is not None:
        stream = course.stream(last.solution, heat, columns, filled)
        imbalance = energy_imbalance(stream, heat, physics.thermal.inlet_temperature)
    return HeatedSolution(
        refined=RefinedSolution(problem, [grid.solution for _, grid in found]),
        simple=simple,
        temperature=None if heat is None else heat.temperature,
        zeta=columns.across.zeta,
        mid_temperature=middle,
        max_temperature_rise=largest_rise(course, last),
        temperature_rise_error=rise_error(found),
        shear_stress=course.stress_scale * columns.middle[0] * filled,
        traction_coefficient=friction.sliding,
        rolling_coefficient=friction.rolling,
        power_loss=friction.power_loss(
            load,
            entrainment_speed=physics.mean_speed,
            slide_to_roll_ratio=physics.slide_to_roll_ratio,
        ),
        energy_imbalance=imbalance,
        outer_iterations=sum(grid.loops for _, grid in found),
        status=last.solution.status,
    )
