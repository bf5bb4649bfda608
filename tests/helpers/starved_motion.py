"""Transient films with a layer of oil for tests: contacts, time steps, and the balance of their oil."""

from dataclasses import replace

import numpy as np

from ehlectric import Case
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.problems import film_problem, point_film_problem
from ehlectric.film.mesh import at_centre
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import OilSupply
from ehlectric.film.unsteady import sums
from ehlectric.runtime.threads import quiet_solution


def line(ratio, nodes=201, **contact):
    """Line contact whose layer of oil is ``ratio`` of the mass of the flooded film at its centre."""
    table = {"max_hertz_pressure": "0.8 GPa", "entrainment_speed": "1 m/s", **contact}
    case = Case.line(
        reduced_radius="14.1 mm",
        reduced_modulus="226 GPa",
        lubricant="paper",
        grid={"nodes": nodes, "inlet": -3.0, "outlet": 2.0},
        **table,
    )
    return _supplied(film_problem(case, resolve(case)), ratio)


def point(ratio, nodes=65, **contact):
    """Point contact whose layer of oil is ``ratio`` of the mass of the flooded film at its centre."""
    table = {"load": "20 N", "entrainment_speed": "2 m/s", **contact}
    case = Case.point(
        radius_x="10 mm",
        radius_y="10 mm",
        reduced_modulus="226 GPa",
        lubricant="paper",
        grid={"nodes": nodes},
        **table,
    )
    return _supplied(point_film_problem(case, resolve_point(case)), ratio)


def _supplied(problem, ratio):
    posed = replace(problem, wedge_order=2, tolerance=1e-12, target_error=None)
    with quiet_solution():
        flooded = nested_iteration(posed, None)[-1]
    mass = flooded.final.coefficients.density * flooded.state.thickness
    layer = ratio * at_centre(flooded.level.mesh, mass)
    return replace(posed, supply=OilSupply(layer=lambda y: np.full(y.shape, layer)))


def layer_of(problem):
    """Thickness H of the uniform layer of oil of a problem."""
    return float(problem.supply.layer(np.zeros(1))[0])


def smooth(_time, x, y):
    """Gap of no roughness."""
    return np.zeros((x.size, y.size))


def motion(problem, gap, steps, courant=1.0):
    """Solver, and histories after 0 to ``steps`` time steps from the stationary film."""
    moving = MovingFilm(problem, gap)
    with quiet_solution():
        step = courant * moving.steady.level.mesh.dx
        history = moving.start(step)
        yield moving, history
        for _ in range(steps):
            history = moving.film.advance(history, step)
            yield moving, history


def oil_sums(moving, history):
    """Sum W of mass and difference at all nodes, from which the next of equal steps starts."""
    dx = moving.film.level.mesh.dx
    last = (history.now.time - history.before.time) / dx
    return sums(history.now.oil, history.before.oil, last, 1.0)
