"""Measure film and field of point contacts, and print them in tables beside their limits.

python benchmarks/point_contacts.py
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from benchmarks import cases
from benchmarks.measure import best, command, peak_memory
from ehlectric.field.point_field import PointField, solve_point_field
from ehlectric.film.isothermal_film import Film, solve_point_film
from ehlectric.film.newton import LINEAR_TOLERANCE

CONTACTS = {"20 N circle": "ball_contact", "6208 ball": "ball_bearing"}
WEDGES = {"20 N circle": ("second-order", "first-order"), "6208 ball": ("second-order",)}
REPEATS = {129: 7, 257: 5, 513: 3}  # by nodes along and across

# Limits of the solver: seconds by grid, GMRES iterations per Newton step, memory [GB], seconds for a field.
SECONDS = {129: 1.5, 257: 4.0, 513: 20.0}
ITERATIONS = 30
MEMORY = 3.0
FIELD_SECONDS = 3.0
FIELD_COLUMNS = 257


def iterations(film: Film, nodes: int) -> tuple[int, float]:
    """Largest and mean number of GMRES iterations per Newton step on one grid of a film."""
    taken = [step.krylov_iterations for step in film.steps if step.nodes == nodes]
    return max(taken), float(np.mean(taken))


def film_rows() -> Iterator[tuple[str, ...]]:
    """Rows of the film table by contact, wedge and grid: time, Newton steps, GMRES iterations, memory."""
    for contact, example in CONTACTS.items():
        for wedge in WEDGES[contact]:
            for nodes, limit in SECONDS.items():
                problem = cases.point_film_problem(example, nodes, wedge)
                film = solve_point_film(problem)
                seconds = best(lambda p=problem: solve_point_film(p), REPEATS[nodes])
                most, mean = iterations(film, nodes)
                _, memory = peak_memory(solve_point_film, cases.point_film_problem, example, nodes, wedge)
                yield (
                    f"{contact}, {wedge}",
                    f"{nodes} × {nodes}" + ("" if film.converged else f", {film.status}"),
                    f"{seconds:.2f}",
                    f"{limit:g}",
                    str(film.newton_iterations),
                    f"{most}, {mean:.1f}",
                    f"{memory:.2f}",
                )


def whole_field(example: str) -> PointField:
    """Field of a contact on both sides of its plane of symmetry."""
    field = solve_point_field(cases.point_field_problem(example, FIELD_COLUMNS))
    return field.mirrored() if field.y[0] == 0.0 else field


def field_rows() -> Iterator[tuple[str, ...]]:
    """Rows of the field table, one for each contact: time, conjugate-gradient iterations, memory."""
    for contact, example in CONTACTS.items():
        problem = cases.point_field_problem(example, FIELD_COLUMNS)
        solved = solve_point_field(problem)
        seconds = best(lambda p=problem: solve_point_field(p).mirrored(), 5)
        _, memory = peak_memory(solve_point_field, cases.point_field_problem, example, FIELD_COLUMNS)
        yield (
            f"field, {contact}, {FIELD_COLUMNS} × {FIELD_COLUMNS} columns, degree {problem.degree}",
            f"{seconds:.2f}",
            f"{FIELD_SECONDS:g}",
            str(solved.iterations),
            f"{memory:.2f}",
        )


def markdown(head: tuple[str, ...], rows: Iterator[tuple[str, ...]]) -> None:
    """Print a Markdown table: first column left-aligned, the others right-aligned."""
    print("| " + " | ".join(head) + " |")
    print("| --- |" + " ---: |" * (len(head) - 1))
    for row in rows:
        print("| " + " | ".join(row) + " |", flush=True)
    print()


def print_tables() -> None:
    """Print the tables of the point contacts."""
    gmres = f"GMRES iterations a step (relative tolerance {LINEAR_TOLERANCE:g}, limit {ITERATIONS})"
    memory = f"memory [GB] (limit {MEMORY:g})"
    markdown(
        ("film", "grid", "seconds", "limit", "Newton steps", f"{gmres}: most, mean", memory), film_rows()
    )
    markdown(("what", "seconds", "limit", "CG iterations", "memory [GB]"), field_rows())
    with tempfile.TemporaryDirectory() as folder:
        seconds = command("run", str(cases.EXAMPLES / "ball_contact.toml"), "-o", folder)
    print(f"`ehlectric run` of examples/ball_contact.toml, figures included: {seconds:.1f} s")


if __name__ == "__main__":
    print_tables()
