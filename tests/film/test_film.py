"""Observed order of the film, and its iteration counts, over refined grids."""

from functools import cache
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric.film.face_flow import Fluid
from ehlectric.film.isothermal_film import PointFilm, solve_film
from ehlectric.film.problem import FilmProblem
from ehlectric.lubricant.density import incompressible
from ehlectric.lubricant.viscosity import constant_viscosity
from tests.film.martin import exit_angle, film_coefficient
from tests.helpers.films import RIGID_LINE, film_alone
from tests.helpers.gate import gated

pytestmark = pytest.mark.convergence

INLET = -10.0  # in sqrt(2 R h0)


def martin_film(nodes, *, wedge_order):
    """Rigid isoviscous contact whose exact H is 1 at X = 0.

    The load integral is pi/2, and w = k eta u R/h0 gives H0 = k lambda/(6 pi).
    """
    fluid = Fluid(
        density=incompressible,
        log_viscosity=constant_viscosity,
        velocity_parameter=6.0 * np.pi / film_coefficient(INLET),
        ambient_pressure=0.0,
    )
    problem = FilmProblem(
        fluid,
        nodes=nodes,
        inlet=INLET * np.sqrt(2.0),
        outlet=np.sqrt(2.0),
        thickness_guess=2.0,
        wedge_order=wedge_order,
        geometry=RIGID_LINE,
    )
    return solve_film(problem)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("wedge_order", "order"), [(1, 1.0), (2, 2.0), (3, 2.0)])
def test_rigid_isoviscous_film_converges_to_martin(slope, wedge_order, order):
    intervals = np.array([825, 1650, 3300, 6600])
    films = [martin_film(n + 1, wedge_order=wedge_order) for n in intervals]
    assert all(film.converged for film in films)
    errors = [abs(film.minimum_thickness - 1.0) for film in films]
    assert errors[-1] < (2e-3 if order == 1.0 else 1e-5)
    assert slope(1.0 / intervals, errors) == pytest.approx(order, abs=0.15)


def test_rigid_film_cavitates_where_martin_does():
    film = martin_film(6601, wedge_order=2)
    begin = film.x[1:][film.cavitated[1:]][0]
    exact = np.sqrt(2.0) * np.tan(exit_angle(INLET))
    assert begin == pytest.approx(exact, abs=2.0 * (film.x[1] - film.x[0]))


@pytest.mark.slow
@pytest.mark.parametrize(("wedge", "order"), [("first-order", 1.0), ("second-order", 2.0)])
def test_order_of_the_elastic_film(paper_case, slope, wedge, order):
    """From the differences between grids that double, at 1 GPa and 2 m/s."""
    case = paper_case.replace(
        {"contact.max_hertz_pressure": "1 GPa", "contact.entrainment_speed": 1.0, "grid.wedge": wedge}
    )
    nodes = np.array([801, 1601, 3201, 6401, 12801])
    central = np.array([film_alone(case.replace({"grid.nodes": int(n)})).central_thickness for n in nodes])
    assert slope(1.0 / (nodes[:-1] - 1), np.abs(np.diff(central))) == pytest.approx(order, abs=0.2)


@pytest.fixture(scope="module")
def fine_film(paper_case):
    """Film on sixteen times as many nodes, at a Hertz pressure."""

    @cache
    def solved(pressure):
        changes = {"contact.max_hertz_pressure": pressure, "grid.nodes": 51_201}
        return film_alone(paper_case.replace(changes))

    return solved


@pytest.mark.slow
@pytest.mark.parametrize("wedge", ["first-order", "second-order"])
@pytest.mark.parametrize("pressure", [pytest.param("1 GPa", marks=pytest.mark.gate), "2 GPa"])
def test_richardson_estimate_is_the_true_error(paper_case, fine_film, wedge, pressure):
    """Not below it, and within a factor 3, against a grid sixteen times as fine."""
    case = paper_case.replace(
        {"contact.max_hertz_pressure": pressure, "grid.wedge": wedge, "grid.nodes": 3201}
    )
    film, fine = film_alone(case), fine_film(pressure)
    true = max(
        abs(film.minimum_thickness / fine.minimum_thickness - 1.0),
        abs(film.central_thickness / fine.central_thickness - 1.0),
    )
    assert film.discretisation_error is not None
    assert true / 1.1 < film.discretisation_error < 3.0 * true


def krylov_iterations(film):
    finest = film.x.size
    return np.array([step.krylov_iterations for step in film.steps if step.nodes == finest])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("wedge", "load", "u_s"),
    gated(
        product(["first-order", "second-order"], ["1.57 MN/m", "392.5 kN/m"], [8.0, 1.0]),
        ("second-order", "1.57 MN/m", 8.0),
        ("second-order", "392.5 kN/m", 1.0),
    ),
)
def test_iterations_do_not_grow_with_the_grid(paper_case, wedge, load, u_s):
    case = paper_case.replace(
        {
            "contact.load_per_length": load,
            "contact.entrainment_speed": 0.5 * u_s,
            "grid.wedge": wedge,
        }
    )
    coarse, fine = (film_alone(case.replace({"grid.nodes": n})) for n in (3201, 102_401))
    for film in (coarse, fine):
        assert film.converged
        assert film.newton_iterations <= 8
        assert film.load_residual < 1e-10
    assert krylov_iterations(fine).mean() <= 1.5 * krylov_iterations(coarse).mean()


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("nodes", [65, 100, 101, 102, 200, 201, 202, 1000, 1603, 2048, 3200, 5000])
def test_any_number_of_nodes(paper_case, nodes):
    film = film_alone(paper_case.replace({"contact.max_hertz_pressure": "1 GPa", "grid.nodes": nodes}))
    assert film.converged
    assert film.x.size == nodes
    # Converged value as in line_contact_films.csv; the coarse grids are far off, and say so.
    assert film.central_thickness == pytest.approx(0.8450e-6, rel=2e-3, abs=0.0) or (
        film.discretisation_error is None or film.discretisation_error > 5e-4
    )


def test_a_bilinear_film_is_exact_between_its_nodes():
    """h = 3 + 2x - y + 5xy; by symmetry the mean over the ellipse is the central film of 3."""
    x, y = np.array([-1.5, -0.4, 0.3, 1.2]), np.array([-2.2, -0.7, 0.1, 0.9, 2.5])

    def height(x, y):
        return 3.0 + 2.0 * x - y + 5.0 * x * y

    film = object.__new__(PointFilm)
    vars(film).update(x=x, y=y, thickness=height(x[:, np.newaxis], y), scales=SimpleNamespace(length=1.0))
    vars(film).update(semi_axis_y=2.0)
    at = np.array([-1.0, 0.0, 0.9]), np.array([0.5, 0.0, -1.3])
    assert film._at(*at) == pytest.approx(height(*at), rel=1e-12)
    assert (film.central_thickness, film.mean_thickness) == pytest.approx((3.0, 3.0), rel=1e-12)
