"""Nodes of the atlas of films: each is solved once and appended to a file, so that the work can be resumed.

python -m benchmarks.atlas_nodes FOLDER --kind points --part 0 --parts 2 --until 18:05
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import RectBivariateSpline, make_interp_spline

from ehlectric.arrays import Array
from ehlectric.film.atlas.atlas_films import MOST_HERTZ, OilGroups, reference_laws
from ehlectric.film.atlas.atlas_groups import SKEW, Groups, lubricant_coordinate
from ehlectric.film.atlas.atlas_problem import film_problem
from ehlectric.film.mesh import at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.newton import GridSolution
from ehlectric.film.patch import Patch
from ehlectric.film.problem import FilmProblem
from ehlectric.formulas.hertz import DryContact, line_gap, point_deflection
from ehlectric.runtime.threads import quiet_solution
from ehlectric.version import __version__


def groups_of(load_group: float, moes_l: float, ratio: float | None = None) -> Groups:
    """Groups of a contact from ``Groups.load_group``, L and the ratio of the semi-axes.

    Examples
    --------
    >>> round(groups_of(100.0, 10.0, 4.0).load_group, 9)
    100.0
    """
    unit = Groups(1.0, moes_l, ratio)
    return replace(unit, moes_m=load_group / unit.load_group)


@dataclass(frozen=True)
class Axes:
    """Nodes of a table of films: a tensor grid in ln N, ln Y and ln k.

    Attributes
    ----------
    load, lubricant : ndarray
        Load groups N, M for lines, and lubricant coordinates Y.
    ratio : ndarray or None
        Ratios k of the semi-axes; None for lines.
    """

    load: Array
    lubricant: Array
    ratio: Array | None = None

    @property
    def nodes(self) -> tuple[Array, ...]:
        """Nodes along each axis."""
        axes = (self.load, self.lubricant)
        return axes if self.ratio is None else (*axes, self.ratio)

    @property
    def shape(self) -> tuple[int, ...]:
        """Numbers of nodes."""
        return tuple(axis.size for axis in self.nodes)

    def groups(self, at: tuple[int, ...]) -> Groups:
        """Groups of the contact at a node."""
        load, lubricant = float(self.load[at[0]]), float(self.lubricant[at[1]])
        ratio = None if self.ratio is None else float(self.ratio[at[2]])
        return groups_of(load, lubricant / load**SKEW, ratio)

    def at(self, groups: Groups) -> tuple[int, ...] | None:
        """Indices of the node with these groups; None where the axes have no such node."""
        place = [groups.load_group, lubricant_coordinate(groups)]
        place += [] if self.ratio is None else [groups.ratio or 1.0]
        at = []
        for axis, value in zip(self.nodes, place, strict=True):
            index = int(np.argmin(np.abs(np.log(axis / value))))
            if abs(axis[index] / value - 1.0) > _ALIKE:
                return None
            at.append(index)
        return tuple(at)

    def order(self) -> list[tuple[int, ...]]:
        """Nodes to solve, the most wanted first; splines through these give the others."""
        ranked = [(_rank(self, at), at) for at in np.ndindex(*self.shape)]
        return [at for rank, at in sorted((rank, at) for rank, at in ranked if rank is not None)]


def _rank(axes: Axes, at: tuple[int, ...]) -> int | None:
    """Place of a node in the order of the computation; None for a node that is not solved."""
    if axes.ratio is None:
        return 0
    load, lubricant, ratio = (float(axis[index]) for axis, index in zip(axes.nodes, at, strict=True))
    between, ball = at[1] % 2 == 1, ratio in _BALLS
    if ratio in _SPARSE_LOADS:
        rank = None if between or load not in _SPARSE_LOADS[ratio] else 3
    elif between:
        # Only light contacts, and those near the largest Hertz pressure, change fast with Y.
        near = ball and (load <= _LIGHT or lubricant > _HIGH)
        rank = 4 if load <= _LIGHTEST else 2 if near else None
    else:
        # Of the heavy contacts of other ratios, every second load is enough.
        wanted = load <= _LIGHT or ball or at[0] % 2 == 0
        rank = (0 if ball else 1) if wanted else None
    # The thinnest films take longest.
    return None if rank is None else rank + 5 if load > _HEAVY else rank


# Load group up to which all loads and, for balls of bearings, all lubricant coordinates are solved, and that
# up to which they are for all ratios of the semi-axes; lubricant coordinate beyond which balls have all of
# them; load group beyond which films are thinnest; ratios of the semi-axes of balls.
_LIGHT, _LIGHTEST, _HIGH, _HEAVY, _BALLS = 130.0, 10.0, 70.0, 5000.0, (4.5, 9.5)

# Load groups that are solved for some ratios of the semi-axes. Films change slowly with the ratio, but the
# side lobes of heavily loaded contacts do not.
_FEW = (3.0, 5.5, 20.0, 130.0, 500.0, 2500.0, 12000.0)
_WIDE = (3.0, 5.5, 10.0, 20.0, 45.0, 130.0, 500.0, 2500.0)
_SPARSE_LOADS = {0.25: _WIDE, 0.5: _WIDE, 1.4: _FEW, 3.0: _FEW, 6.5: _FEW}

# Relative distance within which a contact is at a node.
_ALIKE = 1e-6

# Films change their regime at small load groups, where the nodes are closer; beyond, films follow powers.
_SMALL = 3.0, 4.0, 5.5, 7.4, 10.0, 14.0, 20.0, 30.0, 45.0, 75.0, 130.0
_LOADS = (*_SMALL, 250.0, 500.0, 1100.0, 2500.0, 5500.0, 12000.0)

POINTS = Axes(
    np.array(_LOADS),
    np.concatenate([[0.6, 1.0, 1.75, 2.9], np.geomspace(5.0, 112.0, 9), [175.0]]),
    np.array([0.25, 0.5, 1.0, 1.4, 2.0, 3.0, 4.5, 6.5, 9.5, 20.0]),
)
# The lower six Y go on from the others with the same ratio.
LINES = Axes(np.geomspace(0.2, 800.0, 25), 112.0 * (1.5 / 112.0) ** (np.arange(24, -1, -1) / 18.0))

_MIDDLE = np.zeros(())

# Points of the quadrature over the Hertz ellipse, and over the area outside.
_RADII, _ANGLES = 48, 96
_OUTSIDE = 241, 161


def measured(
    groups: Groups, problem: FilmProblem, solution: GridSolution, patch: Patch | None = None
) -> Array:
    """Numbers of a film on one grid, in the order of ``NAMES``.

    Parameters
    ----------
    groups : Groups
        Groups of the contact.
    problem : FilmProblem
        Problem of the film, for its fluid.
    solution : GridSolution
        Film over the whole domain, or inside a patch.
    patch : Patch, optional
        Patch that the film covers; its coarse film is outside.
    """
    mesh, maps = solution.level.mesh, _maps(problem, solution)
    if groups.ratio is None:
        return _of_line(groups, mesh.x, *(values[:, 0] for values in maps))
    if patch is None:
        return _of_point(groups, mesh.x, mesh.whole_y, [mesh.mirrored(values) for values in maps])
    joined, coarse = patch.join(mesh), _maps(problem, patch.coarse)
    whole = [joined(outer, inner) for outer, inner in zip(coarse, maps, strict=True)]
    return _of_point(groups, joined.x, joined.y, whole)


def _maps(problem: FilmProblem, solution: GridSolution) -> list[Array]:
    """Pressure, film thickness and density of a film, shape (nx, ny)."""
    pressure = solution.state.pressure
    density = np.asarray(problem.fluid.density(np.maximum(pressure, 0.0))[0])
    return [pressure, solution.state.thickness, density]


def _of_line(groups: Groups, x: Array, pressure: Array, thickness: Array, density: Array) -> Array:
    """Numbers of a line contact."""
    film, mass, p = (make_interp_spline(x, v, 3) for v in (thickness, density * thickness, pressure))
    at = np.linspace(-1.0, 1.0, 4001)
    i = int(np.argmin(thickness))
    fine = np.linspace(x[max(i - 2, 0)], x[min(i + 2, x.size - 1)], 401)
    least = fine[np.argmin(film(fine))]
    centre = float(film(0.0))
    before, behind = np.linspace(-4.0, -1.0, 3001), np.linspace(1.0, 2.0, 1001)
    outside = [
        float(np.trapezoid(1.0 / film(part), part) / np.trapezoid(1.0 / (centre + line_gap(part)), part))
        for part in (before, behind)
    ]
    unit = groups.thickness_unit
    mean = float(np.trapezoid(film(at), at)) / 2.0
    zone = float(mass(0.0)) * float(np.trapezoid(1.0 / mass(at), at)) / 2.0
    films = [unit * float(mass(0.0)), unit * float(film(least)), unit * mean]
    return np.array([*films, float(p(0.0)), zone, *outside, least, 0.0])


def _of_point(groups: Groups, x: Array, y: Array, maps: list[Array]) -> Array:
    """Numbers of a point contact from its pressure, film thickness and density (nx, ny)."""
    k, unit = groups.ratio, groups.thickness_unit
    assert k is not None
    pressure, thickness, density = maps
    film = RectBivariateSpline(x, y, np.log(thickness), s=0)
    mass = RectBivariateSpline(x, y, np.log(thickness * density), s=0)
    points, weights = np.polynomial.legendre.leggauss(_RADII)
    radius = np.sqrt(0.5 * (points[:, np.newaxis] + 1.0))
    angle = 2.0 * np.pi * np.arange(_ANGLES) / _ANGLES
    disc = (radius * np.cos(angle), k * radius * np.sin(angle))
    centre, mass_0 = math.exp(float(film.ev(_MIDDLE, _MIDDLE))), float(mass.ev(_MIDDLE, _MIDDLE))
    mean = 0.5 * float(weights @ np.exp(film.ev(*disc)).mean(axis=1))
    zone = 0.5 * float(weights @ np.exp(mass_0 - mass.ev(*disc)).mean(axis=1))
    least = _least(film, x, y, thickness)
    p_0 = float(RectBivariateSpline(x, y, pressure, s=0).ev(_MIDDLE, _MIDDLE))
    films = [unit * math.exp(mass_0), unit * least[0], unit * mean]
    outside = _outside(groups, film, centre)
    return np.array([*films, p_0, zone, *outside, least[1], abs(least[2]) / k])


def _least(film: RectBivariateSpline, x: Array, y: Array, thickness: Array) -> tuple[float, float, float]:
    """Smallest film thickness between the nodes and its place, by a spline of ln H."""
    i, j = map(int, np.unravel_index(np.argmin(thickness), thickness.shape))
    at_x = np.linspace(x[max(i - 1, 0)], x[min(i + 1, x.size - 1)], 41)
    at_y = np.linspace(y[max(j - 1, 0)], y[min(j + 1, y.size - 1)], 41)
    values = film(at_x, at_y)
    m, n = np.unravel_index(np.argmin(values), values.shape)
    return math.exp(float(values[m, n])), float(at_x[m]), float(at_y[n])


def _outside(groups: Groups, film: RectBivariateSpline, centre: float) -> list[float]:
    """Integrals of dA/h outside the Hertz ellipse over those of the dry gap, before and behind."""
    k = groups.ratio
    assert k is not None
    side = min(4.5, 1.6 + 1.4 / k) * k
    x, y = np.linspace(-4.5, 1.5, _OUTSIDE[0]), np.linspace(0.0, side, _OUTSIDE[1])
    unit = DryContact(semi_axis_x=1.0, semi_axis_y=k, max_pressure=1.0, approach=0.0)
    # H = h Rx/b^2; the deflection under p_h is p_h b/E' times a unit deflection, and p_h Rx/(b E') = ph_unit.
    load = (groups._q * groups.moes_m) ** (1.0 / 3.0)
    scale = 1.5 / math.pi / k * groups.moes_m ** (1.0 / 3.0) * groups._q ** (-2.0 / 3.0) / load
    opened = scale * point_deflection(x[:, np.newaxis], y, unit, 1.0)
    middle = scale * float(point_deflection(0.0, 0.0, unit, 1.0))
    rigid = 0.5 * (x[:, np.newaxis] ** 2 + y**2 / groups.radius_ratio)
    dry = centre + np.maximum(0.0, rigid + opened - middle)
    free = x[:, np.newaxis] ** 2 + (y / k) ** 2 > 1.0
    weights = np.ones_like(y)
    weights[[0, -1]] = 0.5
    ratios = []
    for part in (x < 0.0, x > 0.0):
        where = free & part[:, np.newaxis]
        inside = np.where(where, weights, 0.0)
        ratios.append(float(np.sum(inside * np.exp(-film(x, y))) / np.sum(inside / dry)))
    return ratios


# Nodes along and across a point contact, by the smallest film H = h R/b^2 down to which they serve.
_NODES = ((0.25, 129), (0.08, 193), (0.02, 257), (0.01, 385), (0.0, 513))
_LINE_NODES = 3201

# Change of the central film from the grid with half the intervals above which the intervals are doubled, and
# the number of nodes up to which they are.
_CHANGE, _MOST_DOUBLED = 0.02, 300

# Factors of the number of nodes with which a film that does not converge is tried again.
_TRIES = (1.0, 1.25, 0.8)

# Smallest film H = h R/b^2 that is solved for narrow contacts; thinner ones need thousands of nodes.
_LEAST_NARROW = 0.004

# Ratio of the semi-axes below which the side lobes of the film are so narrow that a thin film takes 1.5 times
# as many nodes.
_NARROW_RATIO, _THIN = 0.7, 0.1


def nodes_for(groups: Groups) -> int:
    """Number of nodes with which the film of a contact is solved."""
    if groups.ratio is None:
        return _LINE_NODES
    film = _film(groups)
    nodes = next(nodes for least, nodes in _NODES if film >= least)
    return 3 * nodes // 2 if groups.ratio < _NARROW_RATIO and film < _THIN else nodes


def record(groups: Groups, laws: tuple[Any, Any], alpha: float) -> dict[str, Any]:
    """Numbers of a contact on two grids, by the finer grid and the one with half as many intervals."""
    start, row = time.perf_counter(), {"m": groups.moes_m, "l": groups.moes_l, "k": groups.ratio}
    if _left_out(groups):
        return row | {"status": "left out", "nodes": 0, "seconds": 0.0, "date": _now()}
    first = nodes_for(groups)
    for factor in _TRIES:
        nodes = 2 * int(factor * first / 2.0) + 1
        problem = film_problem(groups, laws, alpha, nodes)
        with quiet_solution():
            solutions = nested_iteration(problem, None)
            while _is_coarse(problem, solutions):
                problem = problem.doubled()
                solutions = nested_iteration(problem, None, solutions)
            nodes, status = problem.nodes, solutions[-1].status
            if status == "converged":
                row |= _measures(groups, problem, solutions)
        if status == "converged":
            break
    made = {"status": status, "nodes": nodes, "seconds": round(time.perf_counter() - start, 2)}
    return row | made | {"version": __version__, "date": _now()}


def _is_coarse(problem: FilmProblem, solutions: list[GridSolution]) -> bool:
    """Whether the film in the middle of a point contact changes much from the grid with half the intervals.

    So do light contacts where the spike of the pressure passes the centre: their grids reach far ahead.
    """
    if problem.width is None or problem.nodes > _MOST_DOUBLED or solutions[-1].status != "converged":
        return False
    half = [s for s in solutions if s.level.nodes == problem.nodes // 2 + 1 and s.status == "converged"]
    films = [at_centre(s.level.mesh, s.state.thickness) for s in (*half[-1:], solutions[-1])]
    return abs(films[0] / films[-1] - 1.0) > _CHANGE


def _measures(groups: Groups, problem: FilmProblem, solutions: list[GridSolution]) -> dict[str, Any]:
    """Numbers on the finest grid and on those with half and a quarter of its intervals.

    The finest grid is a patch with half of the spacings where it is much smaller than the domain: it takes
    less than half of the time of the whole domain, and the minimum film needs it.
    """
    last, films = solutions[-1], []
    patch = Patch.around(problem, last)
    if patch is not None:
        inside = nested_iteration(patch.refined(2), None, solutions)[-1]
        if inside.status == "converged":
            films.append(measured(groups, problem, inside, patch).tolist())
    films.append(measured(groups, problem, last).tolist())
    half = [s for s in solutions if s.level.nodes == problem.nodes // 2 + 1 and s.status == "converged"]
    films += [measured(groups, problem, half[-1]).tolist()] if half else []
    patched = patch is not None and inside.status == "converged"
    return dict(zip(("fine", "coarse", "coarser"), [*films, None, None], strict=False)) | {"patched": patched}


def _left_out(groups: Groups) -> bool:
    """Whether a node is not solved, because no machine has it and it would take long."""
    if groups.ratio is None:
        return False
    thin = groups.ratio < _NARROW_RATIO and _film(groups) < _LEAST_NARROW
    return thin or groups.hertz_number > MOST_HERTZ


def _film(groups: Groups) -> float:
    """Expected film H = h R/b^2."""
    return groups.formula / groups.thickness_unit


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def rows_of(path: Path, kind: str, axes: Axes) -> Iterator[tuple[tuple[int, ...], dict[str, Any]]]:
    """Rows of a folder with their nodes; rows of contacts that are no nodes of the axes are left out."""
    for file in sorted(path.glob(f"{kind}-*.jsonl")):
        for line in file.read_text(encoding="utf-8").splitlines():
            row = json.loads(line)
            at = axes.at(Groups(row["m"], row["l"], row["k"]))
            if at is not None:
                yield at, row


def _remaining(path: Path, kind: str, part: int, parts: int) -> Iterator[tuple[int, ...]]:
    """Nodes of this part that no file of the folder has yet."""
    axes = POINTS if kind == "points" else LINES
    done = {at for at, _ in rows_of(path, kind, axes)}
    for number, at in enumerate(axes.order()):
        if number % parts == part and at not in done:
            yield at


def main() -> None:
    """Compute the nodes of the atlas that a folder does not have yet."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kind", choices=("points", "lines"), default="points")
    parser.add_argument("--part", type=int, default=0)
    parser.add_argument("--parts", type=int, default=1)
    parser.add_argument("--until", help="time of the day, UTC, at which to stop, such as 18:05")
    chosen = parser.parse_args()
    laws = reference_laws()
    oil, axes = OilGroups.of(*laws), POINTS if chosen.kind == "points" else LINES
    with (chosen.folder / f"{chosen.kind}-{chosen.part}of{chosen.parts}.jsonl").open("a") as file:
        for at in list(_remaining(chosen.folder, chosen.kind, chosen.part, chosen.parts)):
            if chosen.until and f"{datetime.now(UTC):%H:%M}" >= chosen.until:
                return
            row = record(axes.groups(at), laws, oil.alpha)
            file.write(json.dumps(row) + "\n")
            file.flush()


if __name__ == "__main__":
    main()
