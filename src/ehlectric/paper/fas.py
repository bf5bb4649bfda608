"""Film of a line contact by the paper's own method: multigrid with the full approximation scheme (FAS).

After C. H. Venner and A. A. Lubrecht, Multilevel Methods in Lubrication (Elsevier, 2000). The relaxation
changes single pressures (Gauss-Seidel) where eps/dX^2 is large, and dipoles of pressures where it is small,
all along the line together. The integration constant H00 is computed by eq. (19) on the coarsest grid.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.errors import InputError
from ehlectric.film import (
    LINE,
    NESTED_TOLERANCE,
    ROUNDING,
    UNKNOWN,
    Film,
    FilmProblem,
    Mesh,
    NewtonStep,
    Progress,
    State,
    Status,
    film_error,
    film_status,
    upstream_deficits,
)
from ehlectric.formulas.hertz import line_pressure
from ehlectric.paper.film_equations import FilmEquations, Iterate
from ehlectric.paper.paper_relaxation import relax, solve_coarsest
from ehlectric.runtime.threads import one_blas_thread

# Relaxations of a grid before and after its coarse-grid correction, as in the paper's V(3,2) cycles.
BEFORE, AFTER = 3, 2

# Number of nodes at or below which halving stops, because a coarser grid cannot resolve a thin film; and
# largest number of nodes of the coarsest grid.
COARSEST = 101
LARGEST_COARSEST = 201

# The nested iteration starts on the coarsest grid with at least this many nodes.
FIRST_GRID = 201

# Change of ln eps between neighbouring nodes above which their residuals are dropped on the coarser grid: it
# cannot resolve such a change.
UNRESOLVED = 1.5

# V-cycles on each grid that is coarser than the finest, in nested iteration.
FIRST_CYCLES = 5

# V-cycles allowed on the finest grid for each Newton step that a case allows: a cycle gains about one digit,
# a Newton step three.
CYCLES_A_STEP = 2


@dataclass(frozen=True)
class _Cycled:
    """Result of the V-cycles on one grid: iterate, residual before every cycle, and whether they diverged."""

    at: Iterate
    norms: tuple[float, ...]
    diverged: bool


def solve_film(problem: FilmProblem, *, progress: Progress | None = None) -> Film:
    """Film of a line contact by the paper's multigrid.

    ``problem``, dimensionless problem of a line contact of elastic bodies. Returns film in SI units, as from
    ``film.isothermal_film.solve_film``; its ``newton_iterations`` are V-cycles. Raises InputError where the
    grid cannot be halved to at most 201 nodes; ValueError where the problem is not a line contact of elastic
    bodies.

    Eqs. (1) to (13) and (19) of Morris et al. (2022), doi:10.3390/lubricants10050087. On a coarse grid H the
    unknown is the injected iterate plus its correction. The right side of its Reynolds equation is
    L_H(I P) + R(f - L_h(P)). Here I is the injection, R is the restriction, and L_h(P) = f is the equation of
    the finer grid h. The film equation also has a right side. The load equation contains the residual of
    the finer grid.
    """
    if problem.geometry is not LINE:
        raise ValueError("the paper's multigrid needs deflecting line contacts")
    film, unknown = _film_on_grid(problem, progress), 0
    while problem.target_error is not None and 2 * problem.nodes - 1 <= problem.most_nodes:
        error = film.discretisation_error
        unknown = unknown + 1 if error is None else 0
        if unknown >= UNKNOWN or (error is not None and error <= problem.target_error):
            break
        problem = problem.doubled()
        film = _film_on_grid(problem, progress)
    return film


def _film_on_grid(problem: FilmProblem, progress: Progress | None) -> Film:
    sizes = grid_sizes(problem.nodes)
    with one_blas_thread(), np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        grids = [equations_of(problem, n) for n in sizes]
        first = max((k for k, g in enumerate(grids) if g.x.size >= FIRST_GRID), default=0)
        cycled = _first_grid(problem, grids[first:])
        coarser: tuple[FilmEquations, Iterate] | None = None
        for k in reversed(range(first + 1)):
            at = cycled.at
            if k < first:
                coarser = grids[k + 1], at
                at = Iterate(np.interp(grids[k].x, grids[k + 1].x, at.pressure), at.h00)
            tolerance, limit = NESTED_TOLERANCE, FIRST_CYCLES
            if k == 0:
                tolerance, limit = _tolerance(problem, grids[0]), CYCLES_A_STEP * problem.max_iterations
            cycled = _cycles(grids[k:], at, tolerance, limit, progress if k == 0 else None)
            if cycled.diverged:
                break
        return _film(problem, grids[0], cycled, coarser)


def _tolerance(problem: FilmProblem, finest: FilmEquations) -> float:
    """Residual below which the film is converged: at least the rounding error of the finest grid."""
    return max(problem.tolerance, ROUNDING / finest.dx)


def grid_sizes(nodes: int) -> list[int]:
    """Numbers of nodes of the grids, from the finest to the coarsest; each has every other node of the last.
    Raises InputError where the halving ends at more than 201 nodes.

    Examples
    --------
    >>> grid_sizes(801)
    [801, 401, 201, 101]
    """
    sizes = [nodes]
    while sizes[-1] > COARSEST and sizes[-1] % 2 == 1:
        sizes.append(sizes[-1] // 2 + 1)
    if sizes[-1] > LARGEST_COARSEST:
        raise InputError.worded(
            "grid.nodes",
            f"got {nodes}; the paper's multigrid needs a number whose intervals can be halved "
            f"down to at most {LARGEST_COARSEST - 1}, such as 801, 1601 or 3201",
            got=nodes,
        )
    return sizes


def equations_of(problem: FilmProblem, nodes: int) -> FilmEquations:
    """Film equations of a problem on a grid with a number of nodes."""
    x = np.linspace(problem.inlet, problem.outlet, nodes)
    added = 0.0 if problem.added_gap is None else problem.added_gap(x, np.zeros(1))[:, 0]
    source = np.zeros(nodes)
    if problem.source is not None:
        # The source of the problem belongs to its residual, which has the opposite sign of eq. (7).
        source[1:-1] = -problem.source(x, np.zeros(1))[1:-1, 0]
    return FilmEquations(
        fluid=problem.fluid,
        x=x,
        gap=0.5 * x**2 + added,
        source=source,
        load=LINE.load,
        second_order=problem.wedge_order > 1,
    )


def _first_grid(problem: FilmProblem, grids: list[FilmEquations]) -> _Cycled:
    """Film on the first grid of the nested iteration, from the Hertz pressure as initial guess.

    The first-order wedge is used, because it is monotone. The initial H00 gives the central film thickness of
    a film formula.
    """
    first = grids[0]
    pressure = np.maximum(line_pressure(first.x), problem.fluid.ambient_pressure)
    dry = first.gap + first.deflection(pressure)
    at = Iterate(pressure, problem.thickness_guess - float(np.interp(0.0, first.x, dry)))
    monotone = [replace(grid, second_order=False) for grid in grids]
    return _cycles(monotone, at, NESTED_TOLERANCE, FIRST_CYCLES, None)


def _cycles(
    grids: list[FilmEquations], at: Iterate, tolerance: float, limit: int, progress: Progress | None
) -> _Cycled:
    """Run at most ``limit`` V-cycles on the first of ``grids``, until its residual is below the tolerance."""
    norms: list[float] = []
    norm = residual_norm(grids[0], at)
    while norm > tolerance and len(norms) < limit:
        if progress is not None:
            progress(grids[0].x.size, len(norms), norm)
        norms.append(norm)
        candidate = v_cycle(grids, at)
        norm = residual_norm(grids[0], candidate)
        if np.isfinite(norm):
            at = candidate
    return _Cycled(at, tuple(norms), diverged=not np.isfinite(norm))


def residual_norm(equations: FilmEquations, at: Iterate) -> float:
    """Residual of an iterate: the largest scaled residual of the Reynolds equation, or the residual of the
    load.

    The larger one counts; the residual of the load is ten times its relative error. The result is NaN if
    the film thickness is not positive at every node.
    """
    c = equations.coefficients(at)
    rows = np.abs(equations.scaled(at, c))
    load = 10.0 * abs(equations.carried(at.pressure) - equations.load) / LINE.load
    return float("nan") if np.min(c.thickness) <= 0.0 else max(float(np.max(rows)), load)


def v_cycle(grids: list[FilmEquations], at: Iterate) -> Iterate:
    """One V-cycle of the full approximation scheme. ``grids``, equations from the grid of ``at`` to the
    coarsest grid; of the coarser ones only the nodes are used. Returns new iterate, with a smaller residual
    if the cycles converge.
    """
    fine, *coarser = grids
    if not coarser:
        return solve_coarsest(fine, at)
    for _ in range(BEFORE):
        at = relax(fine, at)
    coarse, injected = _coarse_equations(fine, coarser[0], at)
    corrected = v_cycle([coarse, *coarser[1:]], injected)
    change = np.interp(fine.x, coarse.x, corrected.pressure - injected.pressure)
    ambient = fine.fluid.ambient_pressure
    # The coarse grid does not resolve the cavitation boundary to a fine node: cavitated nodes keep their
    # pressure.
    pressure = np.where(at.pressure > ambient, np.maximum(at.pressure + change, ambient), at.pressure)
    at = Iterate(pressure, corrected.h00)
    for _ in range(AFTER):
        at = relax(fine, at)
    return at


def _coarse_equations(
    fine: FilmEquations, coarse: FilmEquations, at: Iterate
) -> tuple[FilmEquations, Iterate]:
    """Equations of the coarser grid, with the right sides of the FAS, and the injected iterate."""
    c = fine.coefficients(at)
    residual = fine.residual(at, c)
    steep = np.abs(np.diff(np.log(c.eps))) > UNRESOLVED
    unknown = fine.free(at, residual)
    unknown[1:] &= ~steep
    unknown[:-1] &= ~steep
    residual = np.where(unknown, residual, 0.0)
    averaged = residual.copy()
    averaged[1:-1] = 0.25 * residual[:-2] + 0.5 * residual[1:-1] + 0.25 * residual[2:]

    injected = Iterate(at.pressure[::2].copy(), at.h00)
    defect = fine.load - fine.carried(at.pressure)
    film = c.thickness[::2] - at.h00 - coarse.deflection(injected.pressure)
    empty = replace(coarse, gap=film, source=np.zeros_like(film))
    of_injected = empty.operator(injected, empty.coefficients(injected))
    return (
        replace(
            empty,
            source=of_injected + averaged[::2],
            load=coarse.carried(injected.pressure) + defect,
        ),
        injected,
    )


def _film(
    problem: FilmProblem,
    finest: FilmEquations,
    cycled: _Cycled,
    coarser: tuple[FilmEquations, Iterate] | None,
) -> Film:
    """Film on the finest grid in SI units, also if the cycles diverged before they reached this grid."""
    at, scales, fluid = cycled.at, problem.scales, problem.fluid
    if at.pressure.size != finest.x.size:
        reached = np.linspace(finest.x[0], finest.x[-1], at.pressure.size)
        at = Iterate(np.interp(finest.x, reached, at.pressure), at.h00)
    c = finest.coefficients(at)
    norm = residual_norm(finest, at)
    status: Status = "converged" if norm <= _tolerance(problem, finest) else "stalled"
    if cycled.diverged:
        status = "diverged"
    error = None
    if coarser is not None and status == "converged":
        error = film_error(problem, _state_on(finest, at), _state_on(*coarser))
    cavitated = at.pressure <= fluid.ambient_pressure
    pressure = np.maximum(scales.pressure * at.pressure, scales.ambient_pressure)
    return Film(
        x=scales.length * finest.x,
        pressure=np.where(cavitated, scales.ambient_pressure, pressure),
        thickness=scales.thickness * c.thickness,
        deflection=scales.thickness * finest.deflection(at.pressure),
        density=c.density,
        cavitated=cavitated,
        reynolds_residual=finest.scaled(at, c),
        scales=scales,
        status=film_status(status, _mesh(finest), c.thickness[:, np.newaxis]),
        residual=norm,
        load_residual=abs(finest.carried(at.pressure) / finest.load - 1.0),
        newton_iterations=len(cycled.norms),
        steps=tuple(NewtonStep(problem.nodes, value, 0) for value in cycled.norms),
        discretisation_error=error,
        inlet_deficit=upstream_deficits(
            fluid,
            LINE,
            _mesh(finest),
            at.pressure[:, np.newaxis],
            (c.density * c.thickness)[:, np.newaxis],
        )[0],
    )


def _state_on(equations: FilmEquations, at: Iterate) -> tuple[Mesh, State]:
    """Mesh of one grid, and the state of the film on it."""
    thickness = equations.coefficients(at).thickness[:, np.newaxis]
    return _mesh(equations), State(at.pressure[:, np.newaxis], at.h00, thickness)


def _mesh(equations: FilmEquations) -> Mesh:
    """Mesh of the nodes of one grid."""
    return Mesh(equations.x, np.zeros(1))
