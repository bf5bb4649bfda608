"""Full-approximation-scheme multigrid for the film: the paper's own method.

After C. H. Venner and A. A. Lubrecht, Multilevel Methods in Lubrication (Elsevier, 2000): changes of single
pressures (Gauss-Seidel) where eps/dX^2 is large, of dipoles where it is small, relaxed together along the
line; H00 by eq. (19) on the coarsest grid.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solve_banded

from ehlectric.elastic import LINE
from ehlectric.errors import InputError
from ehlectric.film import Film, film_status, inlet_deficit, richardson
from ehlectric.hertz import line_pressure
from ehlectric.nested import FIRST_GRID, NESTED_TOLERANCE, FilmProblem
from ehlectric.newton import ROUNDING, NewtonStep, Progress, Status
from ehlectric.paper.film_equations import NEIGHBOURS, Coefficients, FilmEquations, Iterate
from ehlectric.threads import one_blas_thread
from ehlectric.typing import Array, Mask

# Relaxations of a grid before and after its coarse-grid correction.
BEFORE, AFTER = 3, 2

# Nodes on each side whose pressures a relaxation changes together with a node's own.
HALF_BAND = 6

# No coarser grid than this: a thin film is nothing on fewer nodes.
COARSEST = 101
LARGEST_COARSEST = 201

# Largest change of a pressure in one relaxation.
CHANGE = 0.1

# Change of ln eps between neighbours above which their residual means nothing to a coarser grid.
UNRESOLVED = 1.5

# Damping factor c of eq. (19), negative: too little load must lower H00. The load of a Hertz contact falls by
# 4.5 when its H00 is raised by 1.
LOAD_DAMPING = -0.2

# Newton steps for P at a fixed H00, and changes of H00, on the coarsest grid of a cycle.
COARSE_STEPS, LOAD_STEPS = 2, 3

# Cycles on a grid on the way to the finest.
FIRST_CYCLES = 5

# Cycles after which a grid that is not solved is given up.
MOST_CYCLES = 60


@dataclass(frozen=True)
class _Cycled:
    """Where the cycles of one grid ended: residual before every cycle, and whether it diverged."""

    at: Iterate
    norms: tuple[float, ...]
    diverged: bool


def solve_film(problem: FilmProblem, *, progress: Progress | None = None) -> Film:
    """Film of a line contact by the paper's multigrid.

    Parameters
    ----------
    problem : FilmProblem
        The contact, dimensionless; only deflecting line contacts. Halving its intervals must lead to a grid
        of at most 201 nodes.
    progress : callable, optional
        Called with (nodes, cycle, residual) before every V-cycle of the finest grid.

    Returns
    -------
    Film
        As ``ehlectric.film.solve_film`` gives it; its ``newton_iterations`` are V-cycles.

    Raises
    ------
    InputError
        Where the grid cannot be halved to at most 201 nodes.
    ValueError
        Where the contact is not a deflecting line contact.

    Notes
    -----
    Eqs. (1) to (13), (19) of Morris et al. (2022), doi:10.3390/lubricants10050087. The coarse grids solve
    for the injected iterate and its correction, with the right sides L_H(I P) + R(f - L_h(P)) of the full
    approximation scheme; the film equation carries a right side too, the load equation its defect.
    """
    if problem.geometry is not LINE:
        raise ValueError("the paper's multigrid takes deflecting line contacts")
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
                tolerance, limit = _tolerance(problem, grids[0]), MOST_CYCLES
            cycled = _cycles(grids[k:], at, tolerance, limit, progress if k == 0 else None)
            if cycled.diverged:
                break
        return _film(problem, grids[0], cycled, coarser)


def _tolerance(problem: FilmProblem, finest: FilmEquations) -> float:
    return max(problem.tolerance, ROUNDING / finest.dx)


def grid_sizes(nodes: int) -> list[int]:
    """Nodes of the grids from the finest to the coarsest, each with every other node of the one before.

    Raises
    ------
    InputError
        Where halving ends above 201 nodes.

    Examples
    --------
    >>> grid_sizes(801)
    [801, 401, 201, 101]
    """
    sizes = [nodes]
    while sizes[-1] > COARSEST and sizes[-1] % 2 == 1:
        sizes.append(sizes[-1] // 2 + 1)
    if sizes[-1] > LARGEST_COARSEST:
        raise InputError(
            f"grid.nodes: got {nodes}, the paper's multigrid takes a number whose intervals can be halved "
            f"down to at most {LARGEST_COARSEST - 1}, such as 801, 1601 or 3201"
        )
    return sizes


def equations_of(problem: FilmProblem, nodes: int) -> FilmEquations:
    """The film equations of a problem on a grid of so many nodes, without right sides."""
    x = np.linspace(problem.inlet, problem.outlet, nodes)
    added = 0.0 if problem.added_gap is None else problem.added_gap(x)[:, 0]
    source = np.zeros(nodes)
    if problem.source is not None:
        # Eq. (7) has the opposite sign of the residual that the problem gives the source of.
        source[1:-1] = -problem.source(x)[1:-1, 0]
    return FilmEquations(
        fluid=problem.fluid,
        x=x,
        gap=0.5 * x**2 + added,
        source=source,
        load=LINE.load,
        second_order=problem.second_order,
    )


def _first_grid(problem: FilmProblem, grids: list[FilmEquations]) -> _Cycled:
    """Film on the first grid from the Hertz pressure, with the first-order wedge, which is monotone.

    H00 is such that the central film is that of a formula.
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
    """V-cycles on the first of ``grids`` until its residual is below the tolerance."""
    norms: list[float] = []
    while True:
        norm = residual_norm(grids[0], at)
        if not np.isfinite(norm):
            return _Cycled(at, tuple(norms), diverged=True)
        if norm <= tolerance or len(norms) == limit:
            return _Cycled(at, tuple(norms), diverged=False)
        if progress is not None:
            progress(grids[0].x.size, len(norms), norm)
        norms.append(norm)
        candidate = v_cycle(grids, at)
        if not np.isfinite(residual_norm(grids[0], candidate)):
            return _Cycled(at, tuple(norms), diverged=True)
        at = candidate


def residual_norm(equations: FilmEquations, at: Iterate) -> float:
    """Largest scaled residual of the Reynolds equation, and ten times the relative one of the load."""
    c = equations.coefficients(at)
    rows = np.abs(equations.scaled(at, c))
    load = 10.0 * abs(equations.carried(at.pressure) - equations.load) / LINE.load
    return float("nan") if np.min(c.thickness) <= 0.0 else max(float(np.max(rows)), load)


def v_cycle(grids: list[FilmEquations], at: Iterate) -> Iterate:
    """One V-cycle of the full approximation scheme.

    Parameters
    ----------
    grids : list of FilmEquations
        From the grid of ``at`` to the coarsest; of the coarser ones only the nodes are used.
    at : Iterate
        What to improve.

    Returns
    -------
    Iterate
        With a smaller residual, where the cycle converges.
    """
    fine, *coarser = grids
    if not coarser:
        return _solve_coarsest(fine, at)
    for _ in range(BEFORE):
        at = relax(fine, at)
    coarse, injected = _coarse_equations(fine, coarser[0], at)
    corrected = v_cycle([coarse, *coarser[1:]], injected)
    change = np.interp(fine.x, coarse.x, corrected.pressure - injected.pressure)
    ambient = fine.fluid.ambient_pressure
    # The coarse grid does not know where the film cavitates to the node: it moves no pressure there.
    pressure = np.where(at.pressure > ambient, np.maximum(at.pressure + change, ambient), at.pressure)
    at = Iterate(pressure, corrected.h00)
    for _ in range(AFTER):
        at = relax(fine, at)
    return at


def _coarse_equations(
    fine: FilmEquations, coarse: FilmEquations, at: Iterate
) -> tuple[FilmEquations, Iterate]:
    """Right sides of the full approximation scheme on every other node, and the injected iterate."""
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


def relax(equations: FilmEquations, at: Iterate) -> Iterate:
    """One relaxation of the line at a fixed H00.

    Where eps/dX^2 is large against 1/dX the unknowns are changes of single pressures, elsewhere of dipoles,
    +1 at a node and -1 at the one before. The changes of a line are solved for together, coupled to six
    neighbours on each side: point by point, the sweeps stall at the pressure spike.
    """
    c = equations.coefficients(at)
    residual = equations.residual(at, c)
    free = equations.free(at, residual)
    dipole = free & (equations.poiseuille(c) < 1.0 / equations.dx)
    dipole[1:] &= free[:-1]
    band = _band(equations, equations.derivatives(at, c), free, dipole)
    unknown = _solve_band(band, np.where(free, residual, 0.0))
    change = unknown.copy()
    change[:-1] -= np.where(dipole[1:], unknown[1:], 0.0)
    return _moved(equations, at, np.clip(change, -CHANGE, CHANGE))


def _band(equations: FilmEquations, derivatives: tuple[Array, Array], free: Mask, dipole: Mask) -> Array:
    """Band of dL over the unknowns of a relaxation, as LAPACK stores it; ones where a node is held."""
    n = equations.x.size
    by_p, by_h = derivatives

    def diagonal(offset: int) -> Array:
        """dL_i/dP_(i + offset)."""
        whole = np.zeros(n)
        for row, node in enumerate(NEIGHBOURS):
            whole += by_h[row] * equations.kernel[abs(offset - node)]
            if node == offset:
                whole += by_p[row]
        return whole

    band = np.zeros((2 * HALF_BAND + 1, n))
    before = diagonal(-HALF_BAND - 1)
    for offset in range(-HALF_BAND, HALF_BAND + 1):
        rows = slice(max(0, -offset), min(n, n - offset))
        columns = slice(max(0, offset), min(n, n + offset))
        here = diagonal(offset)
        entries = here[rows] - np.where(dipole[columns], before[rows], 0.0)
        band[HALF_BAND - offset, columns] = np.where(free[rows] & free[columns], entries, 0.0)
        before = here
    band[HALF_BAND, ~free] = 1.0
    return band


def _solve_band(band: Array, right: Array) -> Array:
    """Solution of a banded system; not a number where it has none."""
    if not np.all(np.isfinite(band)):
        return np.full_like(right, np.nan)
    try:
        solution: Array = solve_banded((HALF_BAND, HALF_BAND), band, right, check_finite=False)
    except np.linalg.LinAlgError:
        return np.full_like(right, np.nan)
    return solution


def _moved(equations: FilmEquations, at: Iterate, change: Array) -> Iterate:
    """Pressures changed, none below ambient, the two ends held."""
    change[0] = change[-1] = 0.0
    return replace(at, pressure=np.maximum(at.pressure + change, equations.fluid.ambient_pressure))


def _solve_coarsest(equations: FilmEquations, at: Iterate) -> Iterate:
    """Pressure by Newton's method at a fixed H00, and H00 by eq. (19), in turn."""
    for _ in range(LOAD_STEPS):
        for _ in range(COARSE_STEPS):
            at = newton_step(equations, at)
        missing = equations.load - equations.carried(at.pressure)
        at = replace(at, h00=at.h00 + LOAD_DAMPING * missing)
    return at


def newton_step(equations: FilmEquations, at: Iterate) -> Iterate:
    """One step of Newton's method for the pressure at a fixed H00, dense."""
    c = equations.coefficients(at)
    residual = equations.residual(at, c)
    free = equations.free(at, residual)
    by_p, by_h = equations.derivatives(at, c)
    jacobian = (dense(by_p) + dense(by_h) @ equations.kernel_matrix)[np.ix_(free, free)]
    change = np.zeros_like(residual)
    if np.all(np.isfinite(jacobian)):
        change[free] = np.linalg.solve(jacobian, residual[free])
    return _moved(equations, at, _limited(equations, c, change))


def dense(rows: Array) -> Array:
    """Rows over the nodes of NEIGHBOURS as a matrix (n, n)."""
    n = rows.shape[1]
    matrix = np.zeros((n, n))
    for row, node in zip(rows, NEIGHBOURS, strict=True):
        matrix += np.diag(row[max(0, -node) : n - max(0, node)], node)
    return matrix


def _limited(equations: FilmEquations, c: Coefficients, change: Array) -> Array:
    """A step no longer than 0.3 in pressure, and of no gap to less than 0.3 of itself."""
    gap = equations.deflection(change)
    closing = np.max(np.maximum(-gap, 0.0) / (0.7 * c.thickness))
    longest = max(1.0, float(np.max(np.abs(change))) / 0.3, float(closing))
    return change / longest


def _film(
    problem: FilmProblem,
    finest: FilmEquations,
    cycled: _Cycled,
    coarser: tuple[FilmEquations, Iterate] | None,
) -> Film:
    """The result on the finest grid, in SI units, whatever was reached."""
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
        order = 2 if problem.second_order else 1
        coarse = coarser[0].x, coarser[0].coefficients(coarser[1]).thickness
        error = richardson((finest.x, c.thickness), coarse, order=order)
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
        status=film_status(status, finest.x, c.thickness),
        residual=norm,
        load_residual=abs(finest.carried(at.pressure) / finest.load - 1.0),
        newton_iterations=len(cycled.norms),
        steps=tuple(NewtonStep(problem.nodes, value, 0) for value in cycled.norms),
        discretisation_error=error,
        inlet_deficit=inlet_deficit(fluid, finest.x, at.pressure, c.density * c.thickness),
    )
