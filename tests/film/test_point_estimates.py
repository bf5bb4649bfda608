"""A film too thin for its grid is known to be so: a ball of a 6208 bearing at 1000 rpm."""

import numpy as np
import pytest

from ehlectric import Case, solve
from ehlectric.contact.conditions import resolve_point
from ehlectric.contact.problems import point_film_problem
from ehlectric.film.isothermal_film import solve_point_film
from tests.helpers.places import EXAMPLES
from tests.helpers.share import share

pytestmark = pytest.mark.convergence

# Of the pitch circle and of the ball [m].
PITCH, BALL = 60e-3, 11.906e-3


def entrainment_speed(rpm):
    """Of a ball on its inner ring with the outer one at rest: omega (dm^2 - d^2)/(4 dm).

    The cage turns with omega (1 - d/dm)/2, and from it the raceway of radius (dm - d)/2 runs away with
    omega (1 + d/dm)/2; ball and raceway roll, and both surfaces have that speed.
    """
    return 2.0 * np.pi * rpm / 60.0 * (PITCH**2 - BALL**2) / (4.0 * PITCH)


def film(nodes, wedge="second-order"):
    changes = {"contact.entrainment_speed": entrainment_speed(1000.0), "grid.nodes": nodes}
    case = Case.from_toml(EXAMPLES / "ball_bearing.toml").replace(changes | {"grid.wedge": wedge})
    return solve(case)


def test_speed_by_hand():
    """104.72 rad/s, 60 mm less 11.906 mm times their ratio, over four: 1.509 m/s."""
    assert entrainment_speed(1000.0) == pytest.approx(1.509, abs=5e-4)


@pytest.mark.slow
@pytest.mark.parametrize("wedge", ["first-order", "second-order"])
def test_much_too_coarse_a_grid_is_said(wedge):
    """65 x 65 nodes give half of the film or less, or twice it; the next coarser grid gives none."""
    result = film(65, wedge)
    assert result.film.converged
    error = result.film.discretisation_error
    assert error is None or error > 0.3
    assert any("do not use" in text for text in map(str, result.warnings))


@pytest.mark.slow
def test_estimates_over_the_grids():
    """Against 513 x 513 nodes and their own estimate; where there is one within a factor 3."""
    fine = film(513).film
    assert fine.converged
    # h_min converges from below, with an order from 1.25 up.
    exact = fine.minimum_thickness * (1.0 + 0.5 * fine.discretisation_error)
    slack = 0.5 * fine.discretisation_error
    minima = []
    for nodes in (65, 129, 257):
        result = film(nodes)
        found = result.film
        minima.append(found.minimum_thickness)
        true = abs(found.minimum_thickness / exact - 1.0)
        error = found.discretisation_error
        if error is None:
            assert true > 0.3
        else:
            assert (true - slack) / 3.0 < error * found.minimum_thickness / exact < 3.0 * (true + slack)
        unusable = any("do not use" in text for text in map(str, result.warnings))
        assert unusable == (error is None or error > 0.1)
    assert np.all(np.diff([*minima, fine.minimum_thickness]) > 0.0)
    # An independent solver had 0.050, 0.100 and 0.111 um for a contact of such a bearing: a film as thin, on
    # grids as much too coarse for it.
    for ours, theirs, part in zip(minima, (0.050e-6, 0.100e-6, 0.111e-6), (0.4, 0.1, 0.1), strict=True):
        assert ours == pytest.approx(theirs, rel=part, abs=0.0)


def random_point_contacts(count):
    """M log-uniform in [5, 2000], L uniform in [2, 20], and Ry/Rx log-uniform in [0.3, 40]."""
    random = np.random.default_rng(5)
    modulus, viscosity, alpha, radius = 226e9, 0.04, 22e-9, 10e-3
    for _ in range(count):
        moes_m, ratio = (
            np.exp(random.uniform(np.log(low), np.log(high))) for low, high in ((5, 2000), (0.3, 40))
        )
        speed = (random.uniform(2.0, 20.0) / (alpha * modulus)) ** 4
        yield {
            "geometry": "point",
            "radius_x": radius,
            "radius_y": radius * ratio,
            "reduced_modulus": modulus,
            "load": moes_m * speed**0.75 * modulus * radius**2,
            "entrainment_speed": 0.5 * speed * modulus * radius / viscosity,
        }


@pytest.mark.slow
def test_third_order_errors_of_random_contacts():
    """Of 40 contacts, or of ten, on 129 x 129 nodes: the true error is above at most one estimate.

    The truth has 257 x 257 nodes.
    """
    ratios = []
    contacts = share(list(random_point_contacts(40)), 4)
    for contact in contacts:
        case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 129}})
        found, fine = (alone(case.replace({"grid.nodes": n})) for n in (129, 257))
        assert found.converged
        if found.discretisation_error is not None:
            pairs = (
                (getattr(f, key) for f in (found, fine)) for key in ("minimum_thickness", "central_thickness")
            )
            ratios.append(max(abs(a / b - 1.0) for a, b in pairs) / found.discretisation_error)
    assert len(ratios) > 0.75 * len(contacts)
    assert sum(ratio > 1.0 for ratio in ratios) <= 1
    assert max(ratios) < 2.0


def alone(case):
    """Film of a smooth point contact, without its field."""
    return solve_point_film(point_film_problem(case, resolve_point(case)))
