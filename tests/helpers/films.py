"""Films of line contacts without their fields and smooth counterparts, and rigid surfaces."""

from dataclasses import replace

import numpy as np

from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import domain_of, film_problem
from ehlectric.film.deflection import LINE
from ehlectric.film.isothermal_film import solve_film
from ehlectric.surfaces.rough_surfaces import rough_surfaces

# A line contact whose surfaces do not deform.
RIGID_LINE = replace(LINE, influence=lambda nodes, _dx, _dy: np.zeros((nodes[0], 1)))


def film_alone(case):
    """Film of a case, equal to that of ``solve`` without ``refine``."""
    conditions = resolve(case)
    rough = rough_surfaces(case.roughness, domain_of(case, conditions))
    return solve_film(film_problem(case, conditions, rough))
