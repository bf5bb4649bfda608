"""The window around the pressure spike against the solution it is cut out of."""

import numpy as np

from ehlectric.film.face_flow import flow
from ehlectric.film.gap import Gap
from ehlectric.film.isothermal_film import solve_film
from ehlectric.film.levels import hierarchy
from ehlectric.film.reynolds import poiseuille_weight, residual
from ehlectric.film.spike import relax_spike
from tests.film import exact_film as exact


def relaxed(dent):
    """What the window makes of the solution of the manufactured film with a dent in its pressure."""
    problem = exact.problem(801, wedge_order=2)
    level, *_ = hierarchy(
        801, inlet=exact.INLET, outlet=exact.OUTLET, geometry=problem.geometry, wedge_order=2,
        source=problem.source,
    )  # fmt: skip
    film = solve_film(problem)
    solved, thickness = film.pressure[:, np.newaxis], film.thickness[:, np.newaxis]
    change = np.zeros_like(solved)
    change[400:405] = dent
    pressure, gap = solved + change, thickness + level.deflection(change)
    at_faces = flow(problem.fluid, pressure, gap, level.mesh)
    r = residual(at_faces, level.wedge, gap, level.mesh) - level.source
    diagonal = poiseuille_weight(at_faces, level.mesh) + 1.0
    return solved, relax_spike(
        problem.fluid,
        Gap(level, gap),
        pressure=pressure,
        full_film=~film.cavitated[:, np.newaxis],
        scaled_residual=r / diagonal,
    )


def test_dent_is_filled():
    solved, filled = relaxed(-0.1)
    np.testing.assert_allclose(filled, solved, atol=1e-4)


def test_what_is_smooth_is_left():
    _, nothing = relaxed(0.0)
    assert nothing is None
