"""Estimated errors of films beside their true ones: 500 lines, 134 points, 100 rough and 100 hot lines.

python -m benchmarks.error_estimates FOLDER [--kinds line point rough hot]

The contacts are those of the open benchmark, and more of each sequence. FOLDER has their films of
``benchmarks.open_benchmark``, which count as the truth, and gets those that it lacks. Each contact is solved
once more as users solve it, to an error of 1 %, and its estimate is compared.
"""

from __future__ import annotations

import argparse
import csv
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.open_benchmark import CLASSES, Table, case_of, class_of, drawn_of, good, stored
from ehlectric import ConvergenceError, solve

DATA = Path(__file__).parent / "data" / "error_estimates.csv"

# Contacts of each class, and the error of the film that a user asks for.
NUMBERS = {"line": 500, "point": 134, "rough": 100, "hot": 100}
ASKED = 1e-2

_FILMS = {"central": "central_thickness", "minimum": "minimum_thickness"}


def compared(name: str, table: Table, row: Table) -> dict[str, Any] | None:
    """Estimate of a film beside its true error; None where it did not converge or has no estimate."""
    try:
        result = solve(case_of(table, ASKED))
    except ConvergenceError:
        return None
    film = result.summary()["film"]
    if film["discretisation_error"] is None:
        return None
    # What the grid adds, and what the domain takes off.
    estimate = film["discretisation_error"] + result.film.domain_loss
    true = max(abs(film[key] / row[f"{short}_film"] - 1.0) for short, key in _FILMS.items())
    return {"name": name, "estimate": estimate, "true": true, "own": row["film_error"] + row["domain_error"]}


def report(kind: str, rows: list[dict[str, Any]]) -> str:
    """How often and by how much the true error exceeds its estimate, by more than that of the reference."""
    estimate, true, own = (np.array([float(row[key]) for row in rows]) for key in ("estimate", "true", "own"))
    beyond = np.maximum(true - own, 0.0) / estimate
    ratio = estimate / np.maximum(true, own)
    return (
        f"| {kind} | {len(rows)} | {100.0 * np.mean(beyond > 1.0):.1f} % | {np.max(beyond):.2f} | "
        f"{np.median(ratio):.2g} | {100.0 * np.median(true):.2g} %, {100.0 * np.max(true):.2g} % |"
    )


def main() -> None:
    """Solve what is missing, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kinds", nargs="+", choices=NUMBERS, default=list(NUMBERS))
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    asked.folder.mkdir(parents=True, exist_ok=True)
    known = list(csv.DictReader(DATA.open())) if DATA.exists() else []
    names = {row["name"] for row in known}
    with DATA.open("a", newline="") as file:
        writer = csv.DictWriter(file, ["name", "estimate", "true", "own"])
        if not known:
            writer.writeheader()
        for kind in asked.kinds:
            missing = (each for each in drawn_of(kind, NUMBERS[kind]) if each[0] not in names)
            for name, table in missing:
                row = stored(asked.folder, name, table)
                found = compared(name, table, row) if good(row, CLASSES[kind].error) else None
                if found is not None:
                    writer.writerow(found)
                    file.flush()
                    known.append(found)
    print("| class | films | exceeded | at most | estimate over error, median | error, median and largest |")
    for kind in NUMBERS:
        rows = [row for row in known if class_of(row["name"]) == kind]
        if rows:
            print(report(kind, rows))


if __name__ == "__main__":
    main()
