"""Film of a line contact without its field and its smooth counterpart, for tests that need neither."""

from ehlectric.contact.problems import film_problem, line_domain_of
from ehlectric.contact.resolve import resolve
from ehlectric.film.line import solve_film
from ehlectric.surfaces.rough_profiles import rough_surfaces


def film_alone(case):
    """Film of a case, equal to that of ``solve`` without ``refine``."""
    conditions = resolve(case)
    rough = rough_surfaces(case.roughness, line_domain_of(case, conditions))
    return solve_film(film_problem(case, conditions, rough))
