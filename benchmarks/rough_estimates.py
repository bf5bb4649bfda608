"""Error estimates of rough films and of their maximum pressure, against films on much finer grids.

python -m benchmarks.rough_estimates    (some minutes: 120 line contacts)
python -m benchmarks.rough_estimates --seed 2 --contacts 200
python -m benchmarks.rough_estimates --measured FOLDER    (adds profiles from files in FOLDER)
python -m benchmarks.rough_estimates --point --contacts 12    (point contacts, five minutes)

Every contact has a random load, speed and roughness. One nested iteration on the finest grid solves it on all
coarser grids. The film on the finest grid counts as the truth. It has 4 to 16 times as many nodes along x in
a line contact, and 2 to 4 times as many in a point contact.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric import Case
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.preparation import prepare
from ehlectric.film.film_errors import discretisation_error, max_pressure_error, rough_film_error
from ehlectric.film.mesh import at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.newton import GridSolution
from ehlectric.film.problem import FilmProblem
from ehlectric.runtime.threads import quiet_solution

# Nodes along x of the finest grid and of the grids whose estimates are tested, by geometry.
GRIDS = {"line": (12801, (801, 1601, 3201)), "point": (257, (65, 129))}

RADIUS, MODULUS = 14.1e-3, 226e9


@dataclass(frozen=True)
class Estimates:
    """Estimates of one film on one grid beside the true errors, all relative."""

    nodes: int
    two_minima: float
    film: float
    true_film: float
    pressure: float
    true_pressure: float


def drawn(rng: np.random.Generator, geometry: str, measured: Path | None) -> dict[str, Any]:
    """Case of a random rough contact: load, speed, spectrum and height of the roughness."""
    gigapascals, speed = (float(10.0 ** rng.uniform(*np.log10(ends))) for ends in ((0.5, 2.5), (0.5, 8.0)))
    contact: dict[str, Any] = {"max_hertz_pressure": 1e9 * gigapascals, "entrainment_speed": speed}
    if geometry == "line":
        contact |= {"reduced_radius": RADIUS, "reduced_modulus": MODULUS}
        scale = 4.0 * 1e9 * gigapascals * RADIUS / MODULUS
        grid = {"inlet": -4.0 if gigapascals < 1.0 else -3.0, "outlet": 2.0}
        shortest = 0.006
    else:
        contact["max_hertz_pressure"] = 1e9 * min(gigapascals, 1.2)
        contact |= {"geometry": "point", "radius_x": RADIUS, "radius_y": RADIUS, "reduced_modulus": MODULUS}
        scale = np.pi * contact["max_hertz_pressure"] * RADIUS / MODULUS
        grid, shortest = {}, 0.05
    film = 0.75e-6 * (speed / 8.0) ** 0.7 * gigapascals**-0.25
    rq = film * float(10.0 ** rng.uniform(-1.7, -0.65))
    surface = _surface(rng, rq, scale, shortest, geometry, measured)
    nodes = GRIDS[geometry][0]
    return {
        "contact": contact,
        "lubricant": {"base": "paper"},
        "roughness": [{"surface": 1} | surface],
        "grid": {"nodes": nodes} | grid,
    }


def _surface(
    rng: np.random.Generator, rq: float, scale: float, shortest: float, geometry: str, measured: Path | None
) -> dict[str, Any]:
    """Roughness of a random kind; ``scale`` is the half-width of the contact [m]."""
    files = [] if measured is None or geometry == "point" else sorted(measured.glob("*.csv"))
    kind = str(rng.choice(["gaussian", "self-affine", "sinusoid", *["file"] * len(files[:1])]))
    length = scale * float(10.0 ** rng.uniform(np.log10(shortest), np.log10(0.4)))
    if kind == "sinusoid":
        phase = float(rng.uniform(0.0, 6.0))
        return {"generator": kind, "amplitude": 1.4 * rq, "wavelength": 2.0 * length, "phase": phase}
    seed = int(rng.integers(1, 10**6))
    if kind == "gaussian":
        return {"generator": kind, "rq": rq, "correlation_length": length, "seed": seed}
    if kind == "self-affine":
        spectrum = {
            "rolloff_wavelength": length,
            "shortest_wavelength": length / (5.0 if geometry == "point" else float(rng.choice([5, 20]))),
        }
        return {"generator": kind, "rq": rq, "hurst": float(rng.uniform(0.5, 1.0)), "seed": seed} | spectrum
    cutoff = float(rng.choice([1e-6, 2.5e-6, 8e-6]))
    steps = {"form": "parabola", "cutoff_long": 80e-6, "cutoff_short": cutoff, "truncate": 50e-9}
    shift = float(rng.uniform(-1e-4, 1e-4))
    return {"file": str(files[0]), "shift": shift, "rescale_rq": min(rq, 30e-9)} | steps


def estimates(case: dict[str, Any]) -> Iterator[Estimates]:
    """Estimates and true errors of one contact on the tested grids; none if it has no film."""
    prepared = prepare(Case.from_dict(case))
    conditions = prepared.conditions
    problem = KINDS[conditions.geometry].film_problem(prepared.case, conditions, prepared.rough)
    with quiet_solution():
        solutions = nested_iteration(problem, None)
        found = {s.level.mesh.x.size: s for s in solutions if s.status == "converged"}
        raised = sum(s.level.mesh.x.size == problem.nodes for s in solutions) > 1
        if problem.nodes not in found or raised:
            return
        for nodes in GRIDS[conditions.geometry][1]:
            fine, coarse, coarsest = (found.get((nodes - 1) // part + 1) for part in (1, 2, 4))
            if fine is not None and coarse is not None:
                coarser = [coarse] if coarsest is None else [coarse, coarsest]
                yield _compared(problem, fine, coarser, found[problem.nodes])


def _compared(
    problem: FilmProblem, fine: GridSolution, coarser: list[GridSolution], true: GridSolution
) -> Estimates:
    thicknesses = [
        np.array([np.min(s.state.thickness), at_centre(s.level.mesh, s.state.thickness)])
        for s in (fine, true)
    ]
    pressures = [float(np.max(s.state.pressure)) for s in (fine, true)]
    values = (
        discretisation_error(problem, fine, coarser),
        rough_film_error(problem, fine, coarser),
        float(np.max(np.abs(thicknesses[0] - thicknesses[1]) / thicknesses[0])),
        max_pressure_error(fine, coarser[0]),
        abs(pressures[0] - pressures[1]) / pressures[0],
    )
    return Estimates(fine.level.mesh.x.size, *(float(v if v is not None else np.nan) for v in values))


def report(name: str, estimate: np.ndarray, true: np.ndarray) -> None:
    """Print how often and by how much the true error exceeds its estimate."""
    ratio = true / estimate
    print(
        f"{name:34s} {len(ratio):5d} films, exceeded in {100 * np.mean(ratio > 1):4.1f} %, twofold in "
        f"{100 * np.mean(ratio > 2):4.1f} %; estimate / true error: median {np.median(1 / ratio):.3g}, "
        f"tenth to ninetieth percentile {np.percentile(1 / ratio, 10):.3g} to "
        f"{np.percentile(1 / ratio, 90):.3g}"
    )


def main() -> None:
    """Solve the contacts and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--contacts", type=int, default=120)
    parser.add_argument("--point", action="store_true")
    parser.add_argument("--measured", type=Path)
    arguments = parser.parse_args()
    geometry = "point" if arguments.point else "line"
    rows: list[Estimates] = []
    for number in range(arguments.contacts):
        rng = np.random.default_rng([arguments.seed, number])
        rows += estimates(drawn(rng, geometry, arguments.measured))
    print(f"seed {arguments.seed}, {arguments.contacts} {geometry} contacts")
    for nodes in (None, *GRIDS[geometry][1]):
        of = [row for row in rows if nodes in (None, row.nodes)]
        columns = {name: np.array([getattr(row, name) for row in of]) for name in vars(rows[0])}
        where = "all nodes" if nodes is None else f"{nodes} nodes"
        report(f"film by two minima, {where}", columns["two_minima"], columns["true_film"])
        report(f"film, {where}", columns["film"], columns["true_film"])
        report(f"maximum pressure, {where}", columns["pressure"], columns["true_pressure"])


if __name__ == "__main__":
    main()
