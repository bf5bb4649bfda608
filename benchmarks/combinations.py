"""All sixteen combinations of starved, hot and sheared, touching and moving, of line and point contacts.

Run by hand: ``python -m benchmarks.combinations``. The contacts are those of
``tests/film/test_every_effect.py``; the table is that of the theory.
"""

from __future__ import annotations

import csv
from itertools import product
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from tests.film.test_every_effect import film_of, moving, posed

from ehlectric.errors import ConvergenceError
from ehlectric.runtime.threads import quiet_solution

DATA = Path(__file__).parent / "data" / "combinations.csv"

# Time steps of the moving films; the wave of a line reaches its contact after about eighty.
STEPS = {"line": 150, "point": 12}


def at_rest(geometry: str, effects: dict[str, bool]) -> dict[str, Any]:
    """Film of a combination at rest."""
    start = process_time()
    film = film_of(posed(geometry, **effects))
    heated = film.heated
    return {
        "status": film.status,
        "minimum": film.minimum_thickness,
        "central": film.central_thickness,
        "spot_nodes": int(film.contact.sum()),
        "temperature_rise": None if heated is None else heated.max_temperature_rise,
        "mass": film.mass_residual,
        "heat": None if heated is None else heated.energy_imbalance,
        "load": film.load_residual,
        "seconds": process_time() - start,
    }


def in_motion(geometry: str, effects: dict[str, bool]) -> dict[str, Any]:
    """Film of a combination after some time steps."""
    contact, film = moving(geometry, **effects)
    start, status = process_time(), "converged"
    with quiet_solution():
        history = film.start(contact.schedule.step)
        try:
            for _ in range(STEPS[geometry]):
                history = film.film.advance(history, contact.schedule.step)
        except ConvergenceError as error:
            status = str(error)
    now, scale, level = history.now, contact.problem.scales.thickness, film.film.level
    physics, rise = contact.problem.physics, None
    if now.warmth is not None and physics is not None and physics.thermal is not None:
        rise = float(np.max(now.warmth.middle)) - physics.thermal.inlet_temperature
    return {
        "status": status,
        "minimum": scale * float(np.min(now.state.thickness)),
        "spot_nodes": int(now.state.touching.sum()),
        "temperature_rise": rise,
        "load": abs(float(np.vdot(level.weights, now.state.pressure)) / level.load - 1.0),
        "seconds": process_time() - start,
    }


_COLUMNS = [
    *("geometry", "moving", "starved", "hot", "touching", "status", "minimum", "central", "spot_nodes"),
    *("temperature_rise", "mass", "heat", "load", "seconds"),
]


def main() -> None:
    """Solve all combinations, and write the table."""
    with DATA.open("w", newline="") as file:
        writer = csv.DictWriter(file, _COLUMNS)
        writer.writeheader()
        for geometry, moves in product(("line", "point"), (False, True)):
            for starved, hot, touching in product((False, True), repeat=3):
                effects = {"starved": starved, "hot": hot, "touching": touching}
                row = (in_motion if moves else at_rest)(geometry, effects)
                writer.writerow({"geometry": geometry, "moving": moves, **effects, **row})
                file.flush()
                print(geometry, "moving" if moves else "at rest", effects, row, flush=True)


if __name__ == "__main__":
    main()
