"""Waviness that rolls through a starved line contact: film at the centre over time, and oil in the inlet.

python -m benchmarks.starved_motion    (minutes: writes the table of docs/data and its figure)
python -m benchmarks.starved_motion --figure    (figure from the existing table)
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ehlectric import Case
from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import film_problem
from ehlectric.film.mesh import at_centre
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem, OilSupply
from ehlectric.film.unsteady import History
from ehlectric.runtime.threads import quiet_solution

ROOT = Path(__file__).parents[1]
FILMS = ROOT / "docs/data/starved_motion.csv"
FIGURE = ROOT / "docs/figures/starved_motion.png"

Floats = NDArray[np.float64]

# Layers of oil over rho_c h_ff; amplitude and wavelength of the waviness [m]; time T of the runs.
PARTS = (np.inf, 0.7, 0.4, 0.2)
AMPLITUDE, WAVELENGTH, END = 100e-9, 50e-6, 7.0
NODES = 801

HEADER = """\
# Film thickness at the centre [m] over time T = t u_m/b, while waviness of 100 nm and 50 um rolls through a
# line contact of 1 GPa and 4 m/s, by benchmarks/starved_motion.py; columns by layer of oil over rho_c h_ff.
"""


def contact() -> tuple[FilmProblem, float, float]:
    """Film problem of the flooded contact, half-width [m] and scale of the film [m]."""
    case = Case.line(
        reduced_radius="14.1 mm",
        reduced_modulus="226 GPa",
        max_hertz_pressure="1 GPa",
        entrainment_speed="4 m/s",
        lubricant="paper",
        grid={"nodes": NODES},
    )
    conditions = resolve(case)
    problem = replace(film_problem(case, conditions), wedge_order=2)
    return problem, conditions.half_width, conditions.thickness_scale


def supplied(problem: FilmProblem, part: float) -> FilmProblem:
    """Problem with a layer of oil, as a part of what the flooded contact takes."""
    if np.isinf(part):
        return problem
    with quiet_solution():
        flooded = nested_iteration(problem, None)[-1]
    density = flooded.final.coefficients.density
    layer = part * at_centre(flooded.level.mesh, density * flooded.state.thickness) / float(density[0, 0])
    return replace(problem, supply=OilSupply(layer=lambda y: np.full(y.shape, layer)))


def films(part: float) -> tuple[Floats, Floats]:
    """Times T and film thicknesses at the centre [m]."""
    problem, b, scale = contact()
    inlet, length = problem.inlet, WAVELENGTH / b

    def gap(time: float, x: Floats, y: Floats) -> Floats:
        behind = np.clip(inlet + time - x, 0.0, 1.0)
        shape = np.sin(0.5 * np.pi * behind) ** 2 * np.sin(2.0 * np.pi * (x - time) / length)
        return -AMPLITUDE / scale * shape[:, np.newaxis] + np.zeros_like(y)

    moving = MovingFilm(supplied(problem, part), gap)
    step = moving.steady.level.mesh.dx
    found: list[tuple[float, float]] = []

    def note(history: History) -> None:
        found.append(
            (history.now.time, scale * at_centre(moving.steady.level.mesh, history.now.state.thickness))
        )

    history = moving.start(step)
    note(history)
    with quiet_solution():
        for _ in range(round(END / step)):
            history = moving.film.advance(history, step)
            note(history)
    times, thicknesses = np.array(found).T
    return times, thicknesses


def compute() -> None:
    """Solve all runs and write the table."""
    columns, time = [], np.empty(0)
    for part in PARTS:
        time, film = films(part)
        late = film[time > END - 2.0 * WAVELENGTH / contact()[1]]
        print(f"r = {part:g}: mean {np.mean(late):.4g} m, amplitude {0.5 * np.ptp(late):.3g} m", flush=True)
        columns.append(film)
    names = ",".join(["time", *("flooded" if np.isinf(part) else f"{part:g}" for part in PARTS)])
    table = np.column_stack([time, *columns])
    np.savetxt(FILMS, table, delimiter=",", fmt="%.5g", header=HEADER + names, comments="")


def draw() -> None:
    """Draw the film at the centre over time for each layer of oil."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    table = np.loadtxt(FILMS, delimiter=",", skiprows=HEADER.count("\n") + 1)
    figure, ax = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
    for number, part in enumerate(PARTS):
        label = "flooded" if np.isinf(part) else f"$r$ = {part:g}"
        ax.plot(table[:, 0], 1e6 * table[:, 1 + number], lw=1.2, label=label)
    ax.set_xlabel(r"time $T = t\, u_\mathrm{m}/b$")
    ax.set_ylabel("film thickness at the centre [µm]")
    ax.set_xlim(2.5, END)
    ax.set_ylim(bottom=0.0)
    ax.legend(fontsize=8, frameon=False, ncols=4, loc="upper left")
    ax.set_ylim(top=1.12)
    figure.savefig(FIGURE, dpi=150)


if __name__ == "__main__":
    if "--figure" not in sys.argv:
        compute()
    draw()
