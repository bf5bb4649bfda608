"""Measure the solvers and their baselines in one run; print the numbers of docs/validation/performance.md.

python benchmarks/table.py
"""

from __future__ import annotations

import os
import platform
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy

sys.path.insert(0, str(Path(__file__).parents[1]))

from benchmarks import baselines, cases, point_contacts
from benchmarks.measure import best, command, peak_memory, processor
from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import field_problem, film_problem
from ehlectric.field.line_field import solve_field
from ehlectric.film.isothermal_film import solve_film
from ehlectric.paper import fas, sor
from ehlectric.paper.paper_contacts import CONTACTS


def paper_methods() -> list[tuple[str, ...]]:
    """Rows of our solvers and the paper's: film to the same residual, field on the same columns."""
    rows = []
    for contact in (CONTACTS[0], CONTACTS[7]):
        case = contact.case(wedge="first-order")
        conditions = resolve(case)
        problem = film_problem(case, conditions)
        ours, theirs = best(lambda p=problem: solve_film(p)), best(lambda p=problem: fas.solve_film(p), 3)
        cycles = fas.solve_film(problem).newton_iterations
        what = f"paper's multigrid, {cycles} V-cycles to the same residual, 1e-9"
        rows.append(_row(f"film, 3201 nodes, first order, {contact.name}", ours, what, theirs))
        field = field_problem(case, conditions, solve_film(problem), np.zeros((2, case.grid.nodes)))
        ours, reference = best(lambda f=field: solve_field(f)), solve_field(field).capacitance
        for lines in (8, 16):
            theirs = best(lambda f=field, n=lines: sor.solve_field(f, rows=n), 3)
            equations, start = sor.cartesian(field, lines)
            sweeps = sor.over_relax(equations, start, factor=sor.young_factor(equations.grid)).sweeps
            difference = abs(sor.solve_field(field, rows=lines).capacitance / reference - 1.0)
            what = f"paper's over-relaxation, {lines} rows in h_min, {sweeps} sweeps, capacitance equal to "
            rows.append(_row(f"field, {field.x.size} columns", ours, f"{what}{difference:.0e}", theirs))
    return rows


def _row(what: str, ours: float, against: str, theirs: float) -> tuple[str, ...]:
    return (what, f"{ours:.4f}", against, f"{theirs:.3f}", f"{theirs / ours:.0f}")


def main() -> None:
    """Print times and memory of line and point contacts, for docs/validation/performance.md."""
    rows = []
    film = {n: best(lambda n=n: solve_film(cases.film_problem(n))) for n in (801, 3201)}
    film |= {n: best(lambda n=n: solve_film(cases.film_problem(n)), 3) for n in (25_601, 102_401)}
    dense = {n: best(lambda n=n: baselines.solve_film_densely(cases.film_problem(n)), 1) for n in (801, 3201)}
    for n, seconds in film.items():
        ratio = f"{dense[n] / seconds:.0f}" if n in dense else ""
        slow = f"{dense[n]:.2f}" if n in dense else ""
        against = "nested dense Newton (LAPACK)" if n in dense else ""
        rows.append((f"film, {n} nodes", f"{seconds:.3f}", against, slow, ratio))
    rough = cases.rough_film_problem(12_801)
    smooth = replace(rough, added_gap=None)
    times = [best(lambda problem=problem: solve_film(problem), 3) for problem in (rough, smooth)]
    ratio = f"1/{times[0] / times[1]:.1f}"
    rows.append(("rough film, 12801 nodes", f"{times[0]:.3f}", "smooth film", f"{times[1]:.3f}", ratio))
    for n in (801, 3201):
        problem = cases.field_problem(n)
        ours = best(lambda problem=problem: solve_field(problem))
        theirs = best(lambda problem=problem: baselines.capacitance_by_superlu(problem), 3)
        difference = abs(baselines.capacitance_by_superlu(problem) / solve_field(problem).capacitance - 1)
        name = f"SuperLU, {n} x 65 linear elements, capacitance equal to {difference:.0e}"
        rows.append((f"field, {n} columns", f"{ours:.4f}", name, f"{theirs:.2f}", f"{theirs / ours:.0f}"))
    rows += paper_methods()
    rows.append(("`ehlectric --version`", f"{command('--version'):.2f}", "", "", ""))
    with tempfile.TemporaryDirectory() as folder:
        seconds = command("run", str(cases.EXAMPLE), "-o", folder)
    rows.append(("`ehlectric run` of the example, figures included", f"{seconds:.2f}", "", "", ""))
    with tempfile.TemporaryDirectory() as folder:
        seconds = command("reproduce", "-o", folder, repeats=1)
    rows.append(("`ehlectric reproduce`, 104 solutions and ten figures", f"{seconds:.1f}", "", "", ""))
    print(f"{processor()}, {len(os.sched_getaffinity(0))} cores, ", end="")
    print(f"Python {platform.python_version()}, NumPy {np.__version__}, SciPy {scipy.__version__}\n")
    print("| what | seconds | against | seconds | ratio |")
    print("| --- | ---: | --- | ---: | ---: |")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    memory, _ = peak_memory(solve_film, cases.film_problem, 102_401)
    print(f"\nPeak memory, film of 102 401 nodes: {memory:.2f} GB\n")
    point_contacts.print_tables()


if __name__ == "__main__":
    main()
