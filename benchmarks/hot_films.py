"""Cost of films with heat over that of the isothermal Newtonian film, in one run.

Run by hand: ``python -m benchmarks.hot_films``. The contacts are those of the tests. Only ratios count, as
both films are solved one after the other on the same machine.
"""

from __future__ import annotations

from dataclasses import replace
from time import process_time

from tests.helpers.hot import ball, paper_line

from ehlectric.film.film_solver import refined_solution
from ehlectric.film.heated_solution import solve_heated_film
from ehlectric.film.shear_laws import Rheology
from ehlectric.runtime.threads import quiet_solution

EYRING = Rheology("eyring", {"eyring_stress": 5e6})
ROUNDS = 3


def ratio(problem):
    """Smallest time with heat over the smallest time without, and the outer loops with heat."""
    cold, hot, loops = [], [], 0
    for _ in range(ROUNDS):
        with quiet_solution():
            start = process_time()
            refined_solution(replace(problem, physics=None), None)
            cold.append(process_time() - start)
            start = process_time()
            loops = solve_heated_film(problem).outer_iterations
            hot.append(process_time() - start)
    return min(hot) / min(cold), loops


def main():
    """Print the table."""
    contacts = {
        "line, 801 nodes, pure rolling": paper_line(speed=5.0, nodes=801, rheology=EYRING),
        "line, 801 nodes, slip 1": paper_line(speed=5.0, nodes=801, slide_to_roll_ratio=1.0, rheology=EYRING),
        "point, 129 x 129, slip 0.1": ball(nodes=129, slide_to_roll_ratio=0.1, rheology=EYRING),
    }
    for name, problem in contacts.items():
        times, loops = ratio(problem)
        print(f"{name:32s} {times:6.1f} isothermal films, {loops} outer loops")


if __name__ == "__main__":
    main()
