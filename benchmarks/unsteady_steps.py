"""Cost of a time step of a moving ridge: python -m benchmarks.unsteady_steps

Seconds are of the wall clock, and of the processor, which a busy machine does not change.
"""

from __future__ import annotations

import os
import time
from pathlib import Path

import numpy as np

from benchmarks import cases
from benchmarks.measure import processor
from ehlectric.film.mesh import at_centre
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.film.problem import FilmProblem
from ehlectric.film.unsteady import Effort
from ehlectric.runtime.threads import quiet_solution

# Problem, number of nodes, and number of time steps.
CONTACTS = (
    ("line contact", lambda nodes: cases.film_problem(nodes), 3201, 2000),
    ("ball contact", lambda nodes: cases.point_film_problem("ball_contact", nodes, "second-order"), 129, 60),
    ("ball contact", lambda nodes: cases.point_film_problem("ball_contact", nodes, "second-order"), 257, 20),
)


def no_gap(_: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Gap without roughness."""
    return np.zeros((x.size, y.size))


def resident() -> float:
    """Resident memory of this process [MB]."""
    status = Path("/proc/self/status").read_text().splitlines()
    return int(next(line for line in status if line.startswith("VmRSS")).split()[1]) * 1024 / 1e6


def measured(problem: FilmProblem, steps: int) -> tuple[str, ...]:
    """Time [ms] and iterations per step, and growth of memory [MB] in the second half of the steps.

    A transverse ridge of half the film moves at the mean speed from the inlet on, a spacing in a step.
    """
    with quiet_solution():
        steady = MovingFilm(problem, no_gap).steady
        mesh = steady.level.mesh
        height = 0.5 * at_centre(mesh, steady.state.thickness)

        def gap(moment: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
            bell = -height * np.exp(-(((x + 1.5 - moment) / 0.2) ** 2))
            return bell[:, np.newaxis] + np.zeros_like(y)

        moving, effort = MovingFilm(problem, gap), Effort()
        film, history = moving.film, moving.start(mesh.dx)
        wall, cpu = time.perf_counter(), time.process_time()
        for k in range(steps):
            history = film.advance(history, mesh.dx)
            effort += history.effort
            if k == steps // 2:
                memory = resident()
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    per_step = (1e3 * wall, 1e3 * cpu, effort.newton, effort.krylov)
    return (*(f"{value / steps:.2f}" for value in per_step), f"{resident() - memory:.1f}")


def main() -> None:
    """Print time, iterations and memory of each contact, for docs/validation/performance.md."""
    print(f"{processor()}, {len(os.sched_getaffinity(0))} cores, load {os.getloadavg()[0]:.1f}\n")
    print("| contact | nodes | steps | ms a step | of the processor | Newton | GMRES | MB more |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for name, problem, nodes, steps in CONTACTS:
        row = (name, str(nodes), str(steps), *measured(problem(nodes), steps))
        print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
