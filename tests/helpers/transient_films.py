"""Transient films for tests: a contact, a moving ridge, and the time steps."""

from dataclasses import replace

import numpy as np

from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import film_problem
from ehlectric.film.nested import nested_iteration
from ehlectric.film.unsteady import UnsteadyFilm
from ehlectric.runtime.threads import quiet_solution


def problem_of(paper_case, nodes, **values):
    """Film problem of a line contact with the paper's oil, by default at 0.8 GPa, 1 m/s and -3 <= X <= 2."""
    contact = {"contact.max_hertz_pressure": "0.8 GPa", "contact.entrainment_speed": "1 m/s"}
    grid = {"grid.nodes": nodes, "grid.inlet": -3.0, "grid.outlet": 2.0}
    case = paper_case.replace(contact | grid | values)
    return replace(film_problem(case, resolve(case)), wedge_order=2)


def steady(problem):
    """Converged stationary film of a problem."""
    with quiet_solution():
        solution = nested_iteration(problem, None)[-1]
    assert solution.status == "converged"
    return solution


def ridge(height, width, start, speed=1.0):
    """Gap of a ridge of Gaussian shape, centred at X = start + speed T, its height in units of H."""

    def gap(time, x, y):
        bell = -height * np.exp(-(((x - start - speed * time) / width) ** 2))
        return bell[:, np.newaxis] + np.zeros_like(y)

    return gap


def histories(problem, gap, step, steps, start=None):
    """Histories after 0 to ``steps`` time steps, from a stationary film."""
    film = UnsteadyFilm(problem, gap)
    with quiet_solution():
        history = film.start(steady(problem) if start is None else start, step)
        yield history
        for _ in range(steps):
            history = film.advance(history, step)
            yield history


def last(*arguments, **keywords):
    """Instant after the last time step."""
    *_, history = histories(*arguments, **keywords)
    return history.now
