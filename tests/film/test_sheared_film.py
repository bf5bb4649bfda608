"""Films of shear-thinning oils: limits, published numbers, and convergence from random conditions."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.across_film import Across
from ehlectric.film.mesh import Mesh, Width
from ehlectric.film.shear_flow import ShearedFlow, traction
from ehlectric.film.shear_laws import Rheology
from tests.film.sheared.contacts import (
    ALPHA,
    RADIUS,
    VISCOSITY,
    Warm,
    circular_contact,
    fluid_of,
    friction,
    line_contact,
    solved,
)
from tests.helpers.share import share

pytestmark = pytest.mark.convergence

EYRING = Rheology("eyring", {"eyring_stress": 5e6})


def central(solution):
    """Film thickness H at the centre of a line contact."""
    return float(np.interp(0.0, solution.level.mesh.x, solution.state.thickness[:, 0]))


@pytest.mark.slow
@pytest.mark.parametrize("contact", [pytest.param(line_contact, marks=pytest.mark.gate), circular_contact])
def test_large_eyring_stress_gives_the_newtonian_film(contact):
    """To 1e-9 at an Eyring stress of 1e14 Pa, with sliding."""
    problem = replace(contact(rheology=None), tolerance=1e-12)
    sliding = contact(ratio=0.5, rheology=Rheology("eyring", {"eyring_stress": 1e14}))
    newtonian, sheared = (solved(each) for each in (problem, replace(sliding, tolerance=1e-12)))
    difference = np.abs(sheared.state.thickness / newtonian.state.thickness - 1.0)
    assert np.max(difference) < 1e-9


@pytest.mark.parametrize(("ratio", "expected"), [(0.02, 0.0394), (0.1, 0.0485)])
def test_traction_of_an_eyring_film(ratio, expected):
    """Numbers of an independent dense solver for p_h = 1 GPa, u_m = 4 m/s and tau_0 = 5 MPa, within 3 %."""
    problem = line_contact(ratio=ratio, rheology=EYRING)
    assert friction(problem, solved(problem)).sliding == pytest.approx(expected, rel=0.03)


def test_traction_rises_with_the_logarithm_of_the_slip():
    """Per factor of slip by tau_0/p_mean ln(factor), p_mean = pi p_h/4: Eyring's law far above tau_0."""
    low, high = (
        friction(problem, solved(problem)).sliding
        for problem in (line_contact(ratio=ratio, rheology=EYRING) for ratio in (0.1, 0.5))
    )
    assert high - low == pytest.approx(5e6 / (0.25 * np.pi * 1e9) * np.log(5.0), rel=0.06)


@pytest.mark.parametrize(("width", "share"), [(None, 0.25 * np.pi), (Width(201, 1.0), 2.0 / 3.0)])
def test_traction_under_a_hertz_pressure(width, share):
    """Barus' viscosity and a film of constant thickness, at stresses far above tau_0.

    mu = alpha tau_0 + tau_0/p_mean ln(2 eta_0 du/(tau_0 h)), with p_mean the mean Hertz pressure.
    """
    max_pressure, half_width, thickness, speed, ratio = 1e9, 2e-4, 1e-7, 10.0, 1.0
    slope = ALPHA * max_pressure
    law = ShearedFlow(EYRING, max_pressure * half_width / RADIUS, max_pressure, ratio)
    fluid = fluid_of(max_pressure, half_width, speed, law)
    fluid = replace(fluid, log_viscosity=lambda p: (slope * p, slope + 0.0 * p))
    mesh = Mesh.over(801 if width is None else 201, -1.0, 1.0, width)
    squared = 1.0 - mesh.x[:, np.newaxis] ** 2 - mesh.y**2
    pressure = np.sqrt(np.maximum(squared, 0.0))
    film = np.full(mesh.shape, thickness * RADIUS / half_width**2)
    columns = law.columns(fluid, pressure, film, mesh)
    found = traction(
        columns,
        film,
        mesh,
        load=float(np.sum(mesh.weights * pressure)),
        stress_ratio=half_width / RADIUS,
        filled=np.where(squared > 0.0, 1.0, 0.0),
    )
    slip = np.log(2.0 * VISCOSITY * ratio * speed / (5e6 * thickness))
    expected = ALPHA * 5e6 + 5e6 / (share * max_pressure) * slip
    assert found.sliding == pytest.approx(expected, rel=3e-3)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("contact", "nodes"), [(line_contact, 401), (circular_contact, 33)])
def test_reversed_slip_gives_the_same_film(contact, nodes):
    """Equal bodies: the film is the same, the traction has the other sign."""
    films, tractions = [], []
    for ratio in (0.3, -0.3):
        problem = replace(contact(ratio=ratio, rheology=EYRING, nodes=nodes), tolerance=1e-11)
        solution = solved(problem)
        films.append(solution.state.thickness)
        tractions.append(friction(problem, solution))
    np.testing.assert_allclose(films[1], films[0], rtol=1e-8)
    assert tractions[1].sliding == pytest.approx(-tractions[0].sliding, rel=1e-8)
    assert tractions[1].rolling == pytest.approx(tractions[0].rolling, rel=1e-7)
    # Rolling resistance is far below the traction of a film under high pressure.
    assert 0.0 < tractions[0].rolling < 0.05 * tractions[0].sliding


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("exponent", "stress", "speed", "ratio"),
    [(0.5, 6e6, 4.0, 0.0), (0.5, 6e5, 4.0, 0.0), (0.7, 1e5, 4.0, 0.0), (0.8, 3e4, 4.0, 0.5)],
)
def test_carreau_film_is_thinner_after_bair(exponent, stress, speed, ratio):
    """S. Bair, Proc. IMechE J 219 (2005) 69, within 10 % where the film is thinned by less than 1.6.

    h_N/h = {1 + 0.79 [(1 + S) u eta_0/(h_N G)]^(1/(1 + 0.2 S))}^(3.6 (1 - n)^1.7)
    """
    law = Rheology("carreau", {"carreau_stress": stress, "carreau_exponent": exponent})
    newtonian = central(solved(line_contact(speed=speed)))
    thinned = central(solved(line_contact(speed=speed, ratio=ratio, rheology=law)))
    thickness = newtonian * line_contact().scales.thickness
    number = (1.0 + ratio) * speed * VISCOSITY / (thickness * stress)
    expected = (1.0 + 0.79 * number ** (1.0 / (1.0 + 0.2 * ratio))) ** (3.6 * (1.0 - exponent) ** 1.7)
    assert newtonian / thinned > 1.0
    assert newtonian / thinned == pytest.approx(expected, rel=0.1)


def test_traction_tends_to_the_limiting_coefficient():
    """It rises with slip towards Lambda, below which the inlet and the outlet keep it."""
    tractions = []
    for ratio in (0.01, 0.1, 1.0):
        law = Rheology("limiting", {"limiting_coefficient": 0.05})
        problem = line_contact(ratio=ratio, rheology=law)
        tractions.append(friction(problem, solved(problem)).sliding)
    assert np.all(np.diff(tractions) > 0.0)
    assert tractions[-1] == pytest.approx(0.05, rel=0.04)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("contact", "nodes"), [(line_contact, 401), (circular_contact, 33)])
def test_evenly_hot_film_is_that_of_a_thinner_oil(contact, nodes):
    """A temperature profile on all grids, the same everywhere, against an oil with these properties."""
    heat = 0.5
    problem = contact(ratio=0.3, rheology=EYRING, nodes=nodes)
    oil = problem.fluid

    def log_viscosity(p):
        value, slope = oil.log_viscosity(p)
        return value - heat, slope

    def density(p):
        value, slope = oil.density(p)
        part = 1.0 - 0.05 * heat * (1.0 - 0.1 * p)
        return value * part, slope * part + value * 0.005 * heat

    thinner = replace(oil, log_viscosity=log_viscosity, density=density)
    mesh = Mesh.over(nodes, problem.inlet, problem.outlet, problem.width)
    across = Across.of(6)
    profile = Warm(across, np.full((7, *mesh.shape), heat), mesh, oil, steepness=0.0)
    hot = replace(oil, flow=replace(oil.flow, profile=profile))
    exact = replace(problem, tolerance=1e-11)
    films = [solved(replace(exact, fluid=fluid)).state.thickness for fluid in (oil, thinner, hot)]
    assert np.min(films[1]) < 0.8 * np.min(films[0])
    np.testing.assert_allclose(films[2], films[1], rtol=1e-8)


@pytest.mark.slow
@pytest.mark.gate
def test_sheared_film_converges_with_second_order():
    """Differences of the central thickness on four grids fall by about four from grid to grid."""
    films = [
        central(solved(line_contact(ratio=0.3, rheology=EYRING, nodes=n))) for n in (201, 401, 801, 1601)
    ]
    changes = np.abs(np.diff(films))
    assert np.all(changes[:-1] / changes[1:] > 2.8)


def random_contacts(law, count, seed):
    """Conditions p_h [Pa], u_m [m/s] and slide-to-roll ratio, and the law with random constants."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        stress = rng.uniform(3e6, 10e6)
        constants = {
            "eyring": {"eyring_stress": stress},
            "carreau": {"carreau_stress": stress, "carreau_exponent": rng.uniform(0.3, 0.9)},
            "limiting": {"limiting_coefficient": rng.uniform(0.03, 0.08)},
        }[law]
        speed = np.exp(rng.uniform(np.log(0.5), np.log(20.0)))
        yield rng.uniform(0.5e9, 2e9), speed, rng.uniform(0.0, 2.0), Rheology(law, constants)


@pytest.mark.slow
@pytest.mark.parametrize("law", [pytest.param("eyring", marks=pytest.mark.gate), "carreau", "limiting"])
def test_random_line_contacts_converge(law):
    for conditions in random_contacts(law, 12, 7):
        solved(line_contact(*conditions))


@pytest.mark.slow
@pytest.mark.parametrize("nodes", [401, 1601])
def test_many_random_line_contacts_converge(nodes):
    for conditions in share(list(random_contacts("eyring", 200, 8)), 10):
        solved(line_contact(*conditions, nodes=nodes))


@pytest.mark.slow
@pytest.mark.parametrize("law", ["eyring", "carreau", "limiting"])
def test_random_circular_contacts_converge(law):
    """Slide-to-roll ratios up to 0.5."""
    for pressure, speed, ratio, rheology in share(list(random_contacts(law, 20, 9)), 5):
        solved(circular_contact(pressure, speed, 0.25 * ratio, rheology))
