"""Capacitance of a contact over the size of its domain: a line's tends to a limit, a ball's does not."""

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric import Case, solve

pytestmark = pytest.mark.convergence

LUBRICANT = {"base": "paper"}


def ball(doublings):
    """The ball of the example on a domain doubled so often, nodes equally far apart."""
    size = 2**doublings
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "reduced_modulus": 226e9}
    contact |= {"load": 20.0, "entrainment_speed": 2.0}
    grid = {"inlet": -4.0 * size, "outlet": 2.0 * size, "side": 3.0 * size, "nodes": 64 * size + 1}
    lubricant = LUBRICANT | {"ambient_pressure": 0.0}
    case = {"contact": contact, "lubricant": lubricant, "discharge": {}, "grid": grid}
    return solve(Case.from_dict(case)).discharge


@pytest.mark.slow
@pytest.mark.gate
def test_capacitance_of_a_ball_grows_with_the_logarithm_of_its_domain():
    """Far out h = r^2/2R, so that doubling the domain adds 4 pi eps0 eps R ln 2, whatever its shape."""
    found = [ball(doublings).capacitance for doublings in range(3)]
    added = np.diff(found) / (4.0 * np.pi * epsilon_0 * 2.4 * 0.01 * np.log(2.0))
    assert added[1] == pytest.approx(1.0, abs=0.015)
    # The approach of the bodies narrows the gap by b^2/R, a part of it that falls fourfold a doubling.
    assert added[1] - 1.0 == pytest.approx(0.25 * (added[0] - 1.0), abs=2e-3)


def line(size):
    """The paper's first contact on a domain so many times as long, nodes equally far apart."""
    contact = {"reduced_radius": 14.1e-3, "reduced_modulus": 226e9, "load_per_length": 1.57e6}
    grid = {"inlet": -4.0 * size, "outlet": 2.0 * size, "nodes": 1600 * size + 1}
    case = {"contact": contact | {"entrainment_speed": 4.0}, "discharge": {}, "grid": grid}
    return solve(Case.from_dict(case | {"lubricant": LUBRICANT | {"ambient_pressure": 0.0}}))


def dry_gap(x, b):
    """Between cylinders under the Hertz pressure, outside the contact, over b^2/R."""
    return 0.5 * (x / b * np.sqrt((x / b) ** 2 - 1.0) - np.arccosh(x / b))


@pytest.mark.slow
@pytest.mark.gate
def test_capacitance_of_a_line_contact_tends_to_a_limit():
    """What a longer domain adds is that of the dry gap and the film; far out it goes with 1/x."""
    results = [line(size) for size in (1, 2, 4, 8)]
    found = [r.discharge.capacitance_inlet + r.discharge.capacitance_outlet for r in results]
    b, film = results[0].conditions.half_width, results[0].film.central_thickness

    def density(x):
        return epsilon_0 * 2.4 / (dry_gap(x, b) * b**2 / 14.1e-3 + film)

    for size, added in zip((1, 2, 4), np.diff(found), strict=True):
        parts = [quad(density, end * size * b, 2.0 * end * size * b)[0] for end in (4.0, 2.0)]
        # The film is 0.1 % thinner where the inlet is the shortest, and so is the gap that the domains share.
        assert added == pytest.approx(sum(parts), rel=1e-2, abs=0.0)
    assert np.diff(found)[2] / np.diff(found)[1] == pytest.approx(0.5, abs=0.03)
