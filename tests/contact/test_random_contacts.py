"""Contacts all over the Moes map: from isoviscous to several GPa, from the Hertz pressure, untuned."""

import itertools

import numpy as np
import pytest

from ehlectric import solve
from tests.helpers.share import share

pytestmark = pytest.mark.convergence

COUNT = 200
MODULUS, RADIUS, VISCOSITY, ALPHA = 226e9, 14.1e-3, 0.04, 22e-9


def random_contacts():
    """Load and speed of M log-uniform in [3, 300] and L uniform in [1, 20]; the corners come first."""
    random = np.random.default_rng(2022)
    groups = list(itertools.product((3.0, 300.0), (1.0, 20.0)))
    while len(groups) < COUNT:
        groups.append((np.exp(random.uniform(np.log(3.0), np.log(300.0))), random.uniform(1.0, 20.0)))
    for moes_m, moes_l in groups:
        speed_parameter = (moes_l / (ALPHA * MODULUS)) ** 4
        yield (
            moes_m * np.sqrt(speed_parameter) * MODULUS * RADIUS,
            0.5 * speed_parameter * MODULUS * RADIUS / VISCOSITY,
        )


@pytest.mark.slow
@pytest.mark.parametrize("wedge", ["first-order", pytest.param("second-order", marks=pytest.mark.gate)])
def test_every_contact_is_solved(paper_case, wedge):
    failed = []
    for load, speed in share(list(random_contacts()), 4):
        case = paper_case.replace(
            {
                "contact.load_per_length": load,
                "contact.entrainment_speed": speed,
                # Some films are thinner than a molecule: the oil carries them all the same.
                "contact.boundary_film": 0.0,
                "grid.nodes": 1601,
                "grid.wedge": wedge,
            }
        )
        film = solve(case).film
        solved = film.converged and film.residual <= 1e-8 and film.load_residual < 1e-10
        if not (solved and film.newton_iterations <= 8 and np.all(film.pressure >= 1e5)):
            failed.append((load, speed, film.status, film.residual, film.newton_iterations))
    assert not failed
