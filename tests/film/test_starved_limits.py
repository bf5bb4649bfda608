"""Starved films against exact solutions, conservation of mass and published reductions of the film."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from ehlectric import Case
from ehlectric.film.face_flow import Fluid
from ehlectric.film.isothermal_film import solve_film
from ehlectric.film.mesh import at_centre
from ehlectric.film.problem import FilmProblem, OilSupply
from tests.film.martin import exit_angle, film_coefficient
from tests.helpers.films import RIGID_LINE
from tests.helpers.starved_films import flooded_flow, posed, supplied

pytestmark = pytest.mark.convergence

LINE = Case.line(
    reduced_radius="14.1 mm",
    reduced_modulus="226 GPa",
    max_hertz_pressure="1 GPa",
    entrainment_speed="4 m/s",
    lubricant="paper",
    grid={"nodes": 801},
)
CIRCLE = Case.point(
    radius_x="10 mm",
    radius_y="10 mm",
    reduced_modulus="226 GPa",
    load="20 N",
    entrainment_speed="2 m/s",
    lubricant="paper",
    grid={"nodes": 65, "nodes_y": 65},
)


def at_rest(found):
    """Mass rho H of a line contact where dP/dX = 0, at the place nearest to the centre."""
    mesh, state = found.last.level.mesh, found.last.state
    mass = (found.last.final.coefficients.density * state.thickness)[:, 0]
    slope = CubicSpline(mesh.x, state.pressure[:, 0]).derivative()
    place = min(slope.roots(extrapolate=False), key=abs)
    return float(CubicSpline(mesh.x, mass)(place))


@pytest.mark.slow
@pytest.mark.parametrize("part", [0.95, 0.7, 0.4, 0.1, 0.02])
def test_layer_of_oil_passes_a_line_contact(part):
    """What passes where no pressure drives oil is what came: rho h there is the layer, to 1e-6."""
    problem = posed(LINE)
    mass, _ = flooded_flow(problem)
    found = supplied(problem, part * mass)
    assert found.last.status == "converged"
    assert at_rest(found) == pytest.approx(part * mass, rel=1e-6)


def test_thick_layer_floods_a_line_contact():
    """The flooded film is the same to 1e-9; a layer 1 % thinner than what it takes starves it."""
    problem = posed(LINE)
    mass, _ = flooded_flow(problem)
    flooded = solve_film(problem)
    supply = OilSupply(layer=lambda y: np.full(y.shape, 1.05 * mass))
    thick = solve_film(replace(problem, supply=supply))
    np.testing.assert_allclose(thick.thickness, flooded.thickness, rtol=1e-9)
    assert thick.starvation.meniscus is None
    assert thick.starvation.film_ratio == 1.0
    thin = supplied(problem, 0.99 * mass)
    assert thin.starvation.film_ratio == pytest.approx(0.99, abs=1e-3)
    assert problem.inlet < thin.starvation.meniscus / problem.scales.length < -1.0


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("meniscus", [-3.0, -1.0, -0.5])
def test_rigid_line_from_its_meniscus(meniscus):
    """Martin's quadrature from the meniscus: film and meniscus follow from load and layer.

    h0 = k eta u R/w is H0 = k lambda/(6 pi), and the flow is H0/cos^2 of the exit angle.
    """
    film = 1.0
    layer = film / np.cos(exit_angle(meniscus)) ** 2
    constant, isoviscous = (lambda p: (np.ones_like(p), 0.0 * p)), (lambda p: (0.0 * p, 0.0 * p))
    fluid = Fluid(constant, isoviscous, 6.0 * np.pi * film / film_coefficient(meniscus), 0.0)
    problem = FilmProblem(fluid, 1601, -10.0, 5.0, thickness_guess=1.0, geometry=RIGID_LINE, wedge_order=3)
    found = supplied(problem, layer)
    assert found.last.status == "converged"
    assert float(found.last.state.thickness.min()) == pytest.approx(film, rel=2e-5)
    exact = meniscus * np.sqrt(2.0 * film)
    assert found.starvation.meniscus == pytest.approx(exact, abs=1.5 * found.last.level.mesh.dx)


@pytest.mark.slow
def test_starved_circle_between_the_published_exponents():
    """h_c/h_ff = r/(1 + r^gamma)^(1/gamma), gamma from 2 to 5 (Chevalier et al. 1998, second-hand)."""
    problem = posed(CIRCLE)
    mass, _ = flooded_flow(problem)
    ratios = []
    for part in (0.5, 1.0, 2.0):
        found = supplied(problem, part * mass)
        assert found.last.status == "converged"
        ratio = found.starvation.film_ratio
        low, high = (part / (1.0 + part**gamma) ** (1.0 / gamma) for gamma in (2.0, 5.0))
        assert low < ratio < high
        ratios.append(ratio)
    assert np.all(np.diff(ratios) > 0.0)


@pytest.mark.slow
@pytest.mark.gate
def test_mass_is_conserved_in_a_point_contact():
    """What enters through the inlet edge leaves through outlet and sides, to rounding."""
    problem = posed(CIRCLE)
    mass, _ = flooded_flow(problem)
    found = supplied(problem, 0.8 * mass)
    level, content = found.last.level, found.last.content
    mesh, flow = level.mesh, found.last.final.flow
    lines = mesh.inner[1]
    # The layer enters; no pressure drives oil through the first face, whose nodes are cavitated.
    entering = np.sum((mesh.weights_across * 0.8 * mass)[lines])
    assert not content.filled[:2, lines].any()
    # The last two nodes are cavitated, so that the mass is carried by the upstream difference.
    assert not content.filled[-2:, lines].any()
    leaving = np.sum((mesh.weights_across * content.mass[-2])[lines])
    beside = flow.across.flux[-1, 1:-1] * mesh.dy
    sideways = 2.0 * mesh.dx * float(np.sum(-beside))
    driven = float(np.sum((mesh.weights_across * flow.along.flux[-1])[lines])) * mesh.dx
    assert leaving + sideways - driven == pytest.approx(entering, rel=1e-9)


@pytest.mark.slow
def test_side_of_a_thin_layer_has_the_thinner_film():
    """A layer that is thinner at y > 0 starves that side; mirrored, the film is the mirror image."""
    problem = posed(CIRCLE)
    problem = replace(problem, width=replace(problem.width, symmetric=False, nodes=49), nodes=49)
    mass, _ = flooded_flow(problem)
    films = []
    for sign in (1.0, -1.0):
        found = supplied(problem, lambda y, sign=sign: mass * (0.6 - 0.3 * np.tanh(2.0 * sign * y)))
        assert found.last.status == "converged"
        films.append(found.last.state.thickness)
    np.testing.assert_allclose(films[0], films[1][:, ::-1], rtol=1e-6)
    mesh = found.last.level.mesh
    middle = int(np.argmin(np.abs(mesh.x)))
    thin, thick = (films[0][middle, (sign * mesh.y > 0.2) & (abs(mesh.y) < 0.7)] for sign in (1.0, -1.0))
    assert thin.mean() < 0.8 * thick.mean()
    assert at_centre(mesh, films[0]) < 0.7 * mass


def test_rough_line_takes_what_it_is_given():
    """Waviness below the film: the mean mass over the waves is the layer, and the film follows the waves."""
    waves = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "60 um"}
    case = LINE.replace({"grid.nodes": 1601})
    case = Case.from_dict({**case.to_dict(), "roughness": [waves]})
    problem = posed(case)
    mass, _ = flooded_flow(posed(LINE))
    found = supplied(problem, 0.5 * mass)
    assert found.last.status == "converged"
    content, mesh = found.last.content, found.last.level.mesh
    behind = content.mass[-2, 0]
    assert behind == pytest.approx(0.5 * mass, rel=1e-7)
    zone = np.abs(mesh.x) < 0.7
    inside = (found.last.final.coefficients.density * found.last.state.thickness)[zone, 0]
    assert inside.mean() == pytest.approx(0.5 * mass, rel=0.02)


@settings(max_examples=50, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.floats(0.3, 2.0), st.floats(np.log(0.3), np.log(20.0)), st.floats(np.log(0.01), np.log(1.2)))
@pytest.mark.slow
@pytest.mark.gate
def test_random_starved_lines_converge(pressure, log_speed, log_part):
    """Any layer from a hundredth of the flooded film on, at any load and speed."""
    changes = {
        "contact.max_hertz_pressure": pressure * 1e9,
        "contact.entrainment_speed": float(np.exp(log_speed)),
        "grid.nodes": 401,
    }
    problem = posed(LINE.replace(changes))
    mass, _ = flooded_flow(problem)
    found = supplied(problem, float(np.exp(log_part)) * mass)
    assert found.last.status == "converged"
    expected = min(1.0, float(np.exp(log_part)))
    assert at_rest(found) == pytest.approx(expected * mass, rel=5e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_circle_from_its_meniscus_is_near_the_published_one():
    """Hamrock and Dowson IV (1977): h_c/h_ff = [(m - 1)/(m* - 1)]^0.29, m* = 1 + 3.06 [(R/b)^2 H_c]^0.58.

    The constants are from memory. m is the distance of the meniscus in Hertz radii, H_c = h_ff/R. Their inlet
    is cut off by a straight line, and the meniscus under a uniform layer is curved.
    """
    problem = posed(CIRCLE)
    mass, flooded = flooded_flow(problem)
    # (R/b)^2 h/R is the dimensionless film thickness H.
    fully = 1.0 + 3.06 * flooded**0.58
    for part in (0.6, 0.9):
        found = supplied(problem, part * mass)
        distance = -found.starvation.meniscus / problem.scales.length
        expected = ((distance - 1.0) / (fully - 1.0)) ** 0.29
        assert found.starvation.film_ratio == pytest.approx(expected, rel=0.1)
