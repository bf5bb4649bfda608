"""The film of a line contact alone, for tests that look at neither its field nor its smooth counterpart."""

from ehlectric.contact.problems import film_problem, line_domain_of
from ehlectric.contact.resolve import resolve
from ehlectric.film.line import solve_film
from ehlectric.surfaces.rough_profiles import rough_surfaces


def film_alone(case):
    """The film that ``solve`` gives for a case without ``refine``."""
    conditions = resolve(case)
    rough = rough_surfaces(case.roughness, line_domain_of(case, conditions))
    return solve_film(film_problem(case, conditions, rough))
