"""Random contacts in which everything happens at once: starved, hot, sheared, rough, and touching.

Run by hand: ``python -m benchmarks.every_effect lines`` and ``... points``. Each contact is added to
``benchmarks/data/every_effect.csv`` as soon as it is solved, and a second run goes on where the first one
ended. The table at the end counts the films that converged, and the reasons of those that did not.

The design is a Sobol sequence over ln u from 0.05 to 20 m/s, the Hertz pressure from 0.5 to 2 GPa, the
slide-to-roll ratio from 0 to 2, ln of the layer of oil from 0.2 to 2 films of a formula, and ln lambda from
0.3 to 10, which gives the height of the roughness.
"""

from __future__ import annotations

import argparse
import csv
from collections import Counter
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from scipy.stats import qmc

from benchmarks.time_limit import GivenUpError, processor_limit
from ehlectric import Case
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.preparation import prepare
from ehlectric.contact.setup import Setup
from ehlectric.film.isothermal_film import solve_film, solve_point_film

DATA = Path(__file__).parent / "data" / "every_effect.csv"

# Contacts of each kind, nodes along entrainment, and seed of the design.
NUMBERS, NODES, SEED = {"lines": 300, "points": 60}, {"lines": 401, "points": 65}, 7

_STEEL = {"material": "steel", "density": 7850.0}
_OIL = {"base": "fva-3", "eyring_stress": "5 MPa", "thermal_conductivity": 0.134, "heat_capacity": 2000.0}
_ROUND = {"geometry": "point", "radius_x": "10 mm", "radius_y": "10 mm"}


def design(kind: str) -> list[dict[str, float]]:
    """Speed [m/s], pressure [Pa], slide-to-roll ratio, layer over the film, and lambda of each contact."""
    number = NUMBERS[kind]
    points = qmc.Sobol(5, seed=SEED).random(1 << (number - 1).bit_length())[:number]
    low = np.array([np.log(0.05), 0.5e9, 0.0, np.log(0.2), np.log(0.3)])
    high = np.array([np.log(20.0), 2.0e9, 2.0, np.log(2.0), np.log(10.0)])
    values = low + points * (high - low)
    values[:, [0, 3, 4]] = np.exp(values[:, [0, 3, 4]])
    names = ("speed", "pressure", "slide_to_roll_ratio", "layer_ratio", "lambda_ratio")
    return [dict(zip(names, row.tolist(), strict=True)) for row in values]


def case_of(kind: str, at: dict[str, float]) -> Case:
    """Contact of a row of the design; the film of the formula gives its layer and its roughness."""
    contact: dict[str, Any] = {
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": at["pressure"],
        "entrainment_speed": at["speed"],
        "slide_to_roll_ratio": at["slide_to_roll_ratio"],
        "temperature": "70 degC",
        "boundary_film": "2 nm",
        "boundary_friction": 0.12,
        "body_1": _STEEL,
        "body_2": _STEEL,
    }
    contact |= {"reduced_radius": "14 mm"} if kind == "lines" else _ROUND
    table: dict[str, Any] = {"contact": contact, "lubricant": _OIL, "grid": {"nodes": NODES[kind]}}
    if kind == "points":
        table["grid"]["nodes_y"] = NODES[kind]
    smooth = Case.from_dict(table)
    conditions = KINDS[smooth.contact.geometry].resolve(smooth)
    guess = prepare(smooth).film_problem(Setup.of(smooth)).thickness_guess
    film = guess * conditions.thickness_scale
    width = float(conditions.half_width)
    roughness = {
        "surface": 1,
        "generator": "gaussian",
        "rq": film / at["lambda_ratio"],
        "correlation_length": 0.06 * width,
        "cutoff_short": 0.12 * width,
        "seed": 3,
    }
    return Case.from_dict(
        table
        | {
            "film": {"thermal": True, "rheology": "eyring"},
            "inlet": {"oil_layer": at["layer_ratio"] * film},
            "roughness": [roughness],
        }
    )


def solved(kind: str, at: dict[str, float], limit: float) -> dict[str, Any]:
    """Row of the file: inputs, status of the film, and its numbers where it converged."""
    start = process_time()
    row: dict[str, Any] = {"kind": kind, **at}
    try:
        with processor_limit(limit):
            case = case_of(kind, at)
            problem = prepare(case).film_problem(Setup.of(case))
            film = (solve_film if kind == "lines" else solve_point_film)(problem)
    except GivenUpError:
        return row | {"status": "limit of time", "seconds": limit}
    row |= {"status": film.status, "seconds": process_time() - start}
    heated = film.heated
    if film.converged and heated is not None:
        row |= {
            "minimum": film.minimum_thickness,
            "central": film.central_thickness,
            "touching_nodes": int(film.contact.sum()),
            "temperature_rise": heated.max_temperature_rise,
            "traction": heated.traction_coefficient,
            "imbalance": heated.energy_imbalance,
            "mass_residual": film.mass_residual,
            "load_residual": film.load_residual,
        }
    return row


_COLUMNS = [
    *("kind", "number", "speed", "pressure", "slide_to_roll_ratio", "layer_ratio", "lambda_ratio", "status"),
    *("seconds", "minimum", "central", "touching_nodes", "temperature_rise", "traction", "imbalance"),
    *("mass_residual", "load_residual"),
]


def main() -> None:
    """Solve what is missing in the file, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=NUMBERS)
    parser.add_argument("--limit", type=float, default=120.0, help="processor time of a film [s]")
    parser.add_argument("--data", type=Path, default=DATA)
    asked = parser.parse_args()
    rows = list(csv.DictReader(asked.data.open())) if asked.data.exists() else []
    known = {int(row["number"]) for row in rows if row["kind"] == asked.kind}
    with asked.data.open("a", newline="") as file:
        writer = csv.DictWriter(file, _COLUMNS)
        if not rows:
            writer.writeheader()
        for number, at in enumerate(design(asked.kind)):
            if number not in known:
                row = solved(asked.kind, at, asked.limit) | {"number": number}
                writer.writerow(row)
                file.flush()
                rows.append({name: str(value) for name, value in row.items()})
    mine = [row for row in rows if row["kind"] == asked.kind]
    print(Counter(row["status"] for row in mine))
    converged = [row for row in mine if row["status"] == "converged"]
    for name in ("imbalance", "mass_residual", "load_residual", "seconds"):
        values = [float(row[name]) for row in converged if row[name] not in ("", "None")]
        print(f"{name:16s} largest {max(values):.2e}, median {np.median(values):.2e}")


if __name__ == "__main__":
    main()
