"""Computation of the atlas: every node is solved once and appended to a file, so that it can be resumed.

python -m ehlectric.film.atlas.compute FOLDER --kind points --part 0 --parts 2 --until 18:05
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ehlectric.film.accuracy.patch import Patch
from ehlectric.film.atlas.coefficient import OilGroups, reference_laws
from ehlectric.film.atlas.grids import LINES, MOST_HERTZ, POINTS, Axes
from ehlectric.film.atlas.groups import Groups, film_problem
from ehlectric.film.atlas.measures import measured
from ehlectric.film.mesh import at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import GridSolution
from ehlectric.runtime.parallel.threads import quiet_solution
from ehlectric.version import __version__

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
_NARROW, _THIN = 0.7, 0.1


def nodes_for(groups: Groups) -> int:
    """Number of nodes with which the film of a contact is solved."""
    if groups.ratio is None:
        return _LINE_NODES
    film = _film(groups)
    nodes = next(nodes for least, nodes in _NODES if film >= least)
    return 3 * nodes // 2 if groups.ratio < _NARROW and film < _THIN else nodes


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
    thin = groups.ratio < _NARROW and _film(groups) < _LEAST_NARROW
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
